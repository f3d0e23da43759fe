"""Where a person says that markers are in a stored picture, and where the others expect them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from carpus.core import so3
from carpus.core.session.values import Session
from carpus.core.types import FloatArray

SAME_SPOT_PX = 6.0
"""A place this near to a blob means the blob."""
FEWEST_FOR_PALM = 3
MISFIT_M = 0.004
_NOWHERE = np.full(2, np.nan)


@dataclass(frozen=True, slots=True)
class Correction:
    """What a person said of picture ``row``: places (u, v) by marker, None for one that is not to be seen there."""

    row: int
    places: Mapping[str, tuple[float, float] | None]


def expected_px(session: Session, row: int, places: FloatArray, number: int) -> FloatArray:
    """Where (2,) in picture ``row`` the other discs of the palm at ``places`` (M, 2) expect marker ``number``.

    The palm as calibrated is laid on the others by their depths; of a disc on a finger, and where fewer than three
    others have a depth, it is where the model has it. NaN where nothing is known.
    """
    camera, markers = session.camera, session.markers
    model_m = markers.position_cam_m[row]
    own = camera.distort(camera.project(model_m[number][None]))[0] if np.isfinite(model_m[number]).all() else _NOWHERE
    palm = list(session.header.protocol.palm)
    if number not in palm:
        return own
    others = [k for k in palm if k != number and np.isfinite(places[k]).all()]
    depth_m = np.array([_depth_m(session, row, k) for k in others])
    known = np.isfinite(depth_m)
    if np.count_nonzero(known) < FEWEST_FOR_PALM:
        return own
    seen_m = camera.back_project(camera.undistort(places[others][known]), depth_m[known])
    shape_m = session.calibration.marker_position_w0_m
    at_m = _laid_on(shape_m[np.array(others)[known]], seen_m, shape_m[number])
    return np.asarray(camera.distort(camera.project(at_m[None]))[0])


def _laid_on(shape_m: FloatArray, seen_m: FloatArray, point_m: FloatArray) -> FloatArray:
    """Where a point (3,) of the shape lies when its discs (K, 3) are laid on what is seen of them (K, 3). One disc that
    none of the others agrees with is left out: it has a wrong place itself."""
    rotation, shift, misfit_m = _fit(shape_m, seen_m)
    count = len(shape_m)
    if misfit_m > MISFIT_M and count > FEWEST_FOR_PALM:
        without = [_fit(shape_m[np.arange(count) != k], seen_m[np.arange(count) != k]) for k in range(count)]
        best = min(without, key=lambda one: one[2])
        if best[2] < 0.5 * misfit_m:
            rotation, shift, _ = best
    return np.asarray(rotation @ point_m + shift)


def _fit(shape_m: FloatArray, seen_m: FloatArray) -> tuple[FloatArray, FloatArray, float]:
    """Rotation and shift that lay a shape on what is seen, and the root mean square of what is left, metres."""
    seen_middle, shape_middle = seen_m.mean(axis=0), shape_m.mean(axis=0)
    rotation = so3.nearest_rotation((seen_m - seen_middle).T @ (shape_m - shape_middle))
    shift = seen_middle - rotation @ shape_middle
    left_m = shape_m @ rotation.T + shift - seen_m
    return rotation, shift, float(np.sqrt((left_m**2).sum(axis=1).mean()))


def laid_on_misfit_m(shape_m: FloatArray, seen_m: FloatArray) -> float:
    """Root mean square, metres, of what is left when a shape (K, 3) is laid on what is seen of it (K, 3)."""
    return _fit(shape_m, seen_m)[2]


def _depth_m(session: Session, row: int, number: int) -> float:
    measured = float(session.markers.measured_depth_m[row, number])
    return measured if np.isfinite(measured) else float(session.markers.position_cam_m[row, number, 2])
