"""Connected components of paper colour, touching discs separated."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from carpus.core.compiled.blobs import find_blobs
from carpus.core.model.types import ByteImage, FloatArray


@dataclass(frozen=True, slots=True)
class Components:
    """Blobs of a mask.

    ``labels`` (H, W), 0 where there is no blob; per blob its ``label`` (B,), ``centre_px`` (B, 2) and ``area_px`` (B,)
    of whole pixels, and the ``radius_px`` (B,) of a disc at its depth.
    """

    labels: NDArray[np.int32]
    label: NDArray[np.int32]
    centre_px: FloatArray
    area_px: FloatArray
    radius_px: FloatArray

    def subset(self, indices: NDArray[np.int64]) -> Components:
        """Return the blobs at these indices."""
        return Components(
            self.labels, self.label[indices], self.centre_px[indices], self.area_px[indices], self.radius_px[indices]
        )


def find_components(
    mask: ByteImage,
    estimate_radius: Callable[[FloatArray], FloatArray],
    min_share: float = 0.0,
    max_share: float = math.inf,
) -> Components:
    """Find the blobs of a mask, touching discs separated.

    ``estimate_radius`` gives the radius (N,) in pixels of a disc facing the camera at pixels (N, 2). A blob has
    ``min_share`` to ``max_share`` of such a disc's area.
    """
    return Components(*find_blobs(mask, estimate_radius, min_share, max_share))
