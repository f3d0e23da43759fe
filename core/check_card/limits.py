"""How far off the card's figures may be: the fixed limits, or what the sensor states of itself where that is more.

What stays of a sensor's error as long as the card lies (its bumps, its pattern) no number of pictures takes away: of a
camera with wide bumps a right one is several degrees off on a face as small as the wedge's. Of a sensor whose
neighbours share the step to which depth is rounded, a part of that step stays too, since nothing moves.
"""

from __future__ import annotations

import numpy as np

from carpus.core.camera import Camera
from carpus.core.check_card.card import FIGURES, figures_of
from carpus.core.check_card.reading import MOST_ANGLE_DEG, MOST_LENGTH_MM
from carpus.core.types import FloatArray

LIMIT_SD = 3.0
"""A right camera is beyond this many standard deviations in one figure of 370."""
_ROUNDED_SHARE = 0.4
"""Of one reading's standard deviation: what rounding leaves of a disc that lies still (simulated, 120 pictures)."""
_STEP_M = 1e-5


def figures_sd(places_m: FloatArray, camera: Camera) -> FloatArray:
    """Standard deviation (6,) of the card's figures, degrees and millimetres, from what stays of the depth error of the
    discs at (6, 3) in camera axes."""
    depth_m = places_m[:, 2]
    rounded_m = 0.0 if camera.sensor.averages else _ROUNDED_SHARE * camera.sensor.reading_sd_m(depth_m)
    sd_m = np.hypot(camera.sensor.flat_stays_sd_m(depth_m), rounded_m)
    covariance = np.outer(sd_m, sd_m) * _alike(places_m, camera)
    rays = places_m / depth_m[:, None]
    right = figures_of(places_m)
    slope = np.empty((len(FIGURES), len(places_m)))
    for k, ray in enumerate(rays):
        moved = places_m.copy()
        moved[k] += _STEP_M * ray
        slope[:, k] = (figures_of(moved) - right) / _STEP_M
    return np.asarray(np.sqrt(np.einsum("ij,jk,ik->i", slope, covariance, slope)))


def limits_for(places_m: FloatArray, camera: Camera) -> tuple[float, float]:
    """Largest error of an angle (degrees) and of a length (millimetres) that a right camera may show."""
    sd = LIMIT_SD * figures_sd(places_m, camera)
    angles = max(sd[k] for k, figure in enumerate(FIGURES) if figure.kind == "angle")
    lengths = max(sd[k] for k, figure in enumerate(FIGURES) if figure.kind == "length")
    return max(MOST_ANGLE_DEG, float(angles)), max(MOST_LENGTH_MM, float(lengths))


def _alike(places_m: FloatArray, camera: Camera) -> FloatArray:
    """How far the error that stays is the same at two discs (6, 6): wholly at one place, not at all where they are
    further apart than the sensor says."""
    reach_px = camera.sensor.stays_px
    if reach_px <= 0.0:
        return np.eye(len(places_m))
    pixel = camera.project(places_m)
    apart_px = np.linalg.norm(pixel[:, None] - pixel[None], axis=-1)
    return np.asarray(np.exp(-2.0 * (apart_px / reach_px) ** 2))
