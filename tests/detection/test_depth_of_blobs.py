"""When the depth under a disc is believed, and how much (clinical reference 7.2)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from carpus.core.detection.appearance import DetectionSettings, disc_mask, learn_appearance
from carpus.core.detection.detector import Detector
from carpus.core.model.types import Detections, FloatArray
from tests.detection.pictures import CAMERA, DISTANCE_M, PALM_PX, RADIUS_PX, Look, depth_picture, frame, picture

SETTINGS = DetectionSettings()
DISC = 3
"""The disc on whose depth is played."""


def detect_blobs(depth_m: FloatArray) -> Detections:
    """The blobs of a picture with this depth, in the order of the discs; colours learnt with good depth."""
    rng = np.random.default_rng(0)
    looks, _ = learn_appearance(frame(picture(PALM_PX, Look(), rng), depth_picture()), PALM_PX, CAMERA, SETTINGS)
    found = Detector(looks, CAMERA, SETTINGS).detect(frame(picture(PALM_PX, Look(), rng), depth_m))
    order = np.linalg.norm(found.pixel[None] - PALM_PX[:, None], axis=-1).argmin(axis=1)
    return Detections(
        *(getattr(found, name)[order] for name in ("pixel", "depth_m", "depth_sd_m", "area_px", "similarity"))
    )


def on_disc() -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    rows, columns = np.nonzero(disc_mask((240, 320), PALM_PX[DISC], 1.2 * RADIUS_PX))
    return rows, columns


def test_depth_of_blob_good_readings_are_used() -> None:
    found = detect_blobs(depth_picture())
    assert found.area_px == pytest.approx(np.pi * RADIUS_PX**2, rel=0.1)
    assert found.depth_m == pytest.approx(DISTANCE_M, abs=2e-4)
    # By the book the reading has 1.425e-3 z^2, and readings a few pixels apart are one.
    assert found.depth_sd_m[DISC] == pytest.approx(1.425e-3 * DISTANCE_M**2, rel=0.05)


@pytest.mark.parametrize(("share_missing", "is_believed"), [(0.5, True), (0.85, False), (1.0, False)])
def test_depth_of_blob_tolerates_holes_up_to_seven_tenths(share_missing: float, is_believed: bool) -> None:
    depth = depth_picture()
    rows, columns = on_disc()
    holes = np.random.default_rng(1).permutation(len(rows))[: round(share_missing * len(rows))]
    depth[rows[holes], columns[holes]] = 0.0
    found = detect_blobs(depth)
    assert np.isfinite(found.depth_m[DISC]) == is_believed
    assert np.isfinite(found.depth_sd_m[DISC]) == is_believed
    if is_believed:
        assert found.depth_m[DISC] == pytest.approx(DISTANCE_M, abs=5e-4)
    assert np.isfinite(np.delete(found.depth_m, DISC)).all()


def test_depth_of_blob_tolerates_few_readings_of_what_lies_behind() -> None:
    """A seventh of the readings do not shift it; of half of them nobody knows which are the disc's."""
    rows, columns = on_disc()
    few = np.isin(np.arange(len(rows)), np.random.default_rng(2).permutation(len(rows))[: len(rows) // 7])
    for behind, expected in ((few, DISTANCE_M), (columns > PALM_PX[DISC, 0], np.nan)):
        depth = depth_picture()
        depth[rows[behind], columns[behind]] += 0.05
        found = detect_blobs(depth)
        assert found.depth_m[DISC] == pytest.approx(expected, abs=1e-3, nan_ok=True)
        assert np.isfinite(np.delete(found.depth_m, DISC)).all()


def slope_depth(depth: FloatArray) -> None:
    rows, columns = on_disc()
    depth[rows, columns] += 0.0011 * (columns - PALM_PX[DISC, 0])


def at_the_edge_of_the_surface(depth: FloatArray) -> None:
    u, v = (round(float(x)) for x in PALM_PX[DISC])
    depth[v - 14 : v + 15, u + 4 : u + 14] += 0.05


@pytest.mark.parametrize(("lies", "times"), [(slope_depth, 1.2), (at_the_edge_of_the_surface, 1.3)])
def test_depth_of_blob_on_a_slope_has_a_larger_sd(lies: Callable[[FloatArray], None], times: float) -> None:
    depth = depth_picture()
    lies(depth)
    flat, found = detect_blobs(depth_picture()), detect_blobs(depth)
    assert found.depth_m[DISC] == pytest.approx(DISTANCE_M, abs=1e-3)
    assert found.depth_sd_m[DISC] > times * flat.depth_sd_m[DISC]
