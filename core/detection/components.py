"""Connected components of paper colour, touching discs taken apart."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from carpus.core.detection.touching import TouchingSettings, split_touching
from carpus.core.types import ByteImage, FloatArray


@dataclass(frozen=True, slots=True)
class Components:
    """``labels`` (H, W), 0 where there is no blob; per blob its ``label`` (B,), ``centre_px`` (B, 2) and
    ``area_px`` (B,) of whole pixels, and the ``radius_px`` (B,) of a disc at its depth."""

    labels: NDArray[np.uint16]
    label: NDArray[np.uint16]
    centre_px: FloatArray
    area_px: FloatArray
    radius_px: FloatArray


def components(
    mask: ByteImage, radius_at: Callable[[FloatArray], FloatArray], touching: TouchingSettings
) -> Components:
    """Blobs of a mask; ``radius_at`` gives the radius (B,) of a disc facing the camera at pixels (B, 2)."""
    # 16-bit labels are three times quicker than the default.
    count, found, table, middle = cv2.connectedComponentsWithStats(mask, connectivity=8, ltype=cv2.CV_16U)
    labels = np.asarray(found, dtype=np.uint16)
    stats = np.asarray(table, dtype=np.int32)[:count]
    centre = np.asarray(middle, dtype=np.float64)[:count]
    centre[0] = 0.0  # the background has no place
    radius = radius_at(centre)
    label = np.arange(count, dtype=np.uint16)
    area = stats[:, cv2.CC_STAT_AREA].astype(np.float64)
    split = split_touching(labels, stats, radius, touching)
    for whole, _, facts in split:
        centre[whole], area[whole] = facts[0, :2], facts[0, 2]
    if split:
        added = np.concatenate([facts[1:] for _, _, facts in split])
        centre, area = np.concatenate((centre, added[:, :2])), np.concatenate((area, added[:, 2]))
        radius = np.concatenate((radius, *(np.full(len(own) - 1, radius[whole]) for whole, own, _ in split)))
        label = np.arange(count + len(added), dtype=np.uint16)
    return Components(labels, label[1:], centre[1:], area[1:], radius[1:])
