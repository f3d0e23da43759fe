"""Which samples of an angle may be measured (clinical reference 7.4 and 1.2)."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from carpus.core.measures.signals import LONGEST_GAP_S, BoolArray, stretches
from carpus.core.types import FloatArray, TrackStatus

FEWEST_PALM_MARKERS = 4
STEEPEST_VIEW_RAD = math.radians(70.0)
"""Tilt of the back of the hand to the camera's axis beyond which a disc is a sliver."""
SETTLING_S = 0.09
"""Some three pictures."""
LARGEST_SD_RAD = math.radians(8.0)
"""An angle less sure than this says nothing about a range (our choice, about half of the change limits)."""
ZYX_FLEXION_LIMIT_RAD = math.radians(75.0)
"""Beyond this flexion deviation and pro/supination are ill-conditioned: noise gain 1/cos above 3.9."""


def view_tilt_rad(rotation_w2_w0: FloatArray, rotation_w0_cam: FloatArray) -> FloatArray:
    """Angle (N,) between the back of the hand's normal and the direction to the camera, rotation (N, 3, 3)."""
    normal_cam = rotation_w2_w0[..., :, 2] @ rotation_w0_cam.T
    return np.asarray(np.arccos(np.clip(-normal_cam[..., 2], -1.0, 1.0)), dtype=np.float64)


def valid_view(
    status: NDArray[np.integer],
    palm_measured_px: FloatArray,
    rotation_w2_w0: FloatArray,
    rotation_w0_cam: FloatArray,
) -> BoolArray:
    """Frames (N,) that the camera saw well enough: tracked, 4 palm markers or more, tilt up to 70 degrees.

    ``palm_measured_px`` (N, P, 2) the blobs taken for the palm's markers, NaN where none.
    """
    seen = np.isfinite(palm_measured_px).all(axis=2).sum(axis=1) >= FEWEST_PALM_MARKERS
    with np.errstate(invalid="ignore"):
        facing = view_tilt_rad(rotation_w2_w0, rotation_w0_cam) <= STEEPEST_VIEW_RAD
    return np.asarray((status == TrackStatus.TRACKED) & seen & facing, dtype=np.bool_)


def settled(view: BoolArray, time_s: FloatArray) -> BoolArray:
    """Frames (N,) of a view without those just before a hand goes out of it for longer than a gap that is filled, and
    just after it is back: what is told of them rests on few discs at the edge, and may be tens of degrees off."""
    out = view.copy()
    for part in stretches(~view):
        before, after = max(part.start - 1, 0), min(part.stop, len(view) - 1)
        if time_s[after] - time_s[before] > LONGEST_GAP_S:
            out &= (time_s < time_s[part.start] - SETTLING_S) | (time_s > time_s[part.stop - 1] + SETTLING_S)
    return out


def valid_angle(view: BoolArray, angle_rad: FloatArray, angle_sd_rad: FloatArray) -> BoolArray:
    """Samples of one angle (N,) that are known and sure enough, among the frames that were seen."""
    with np.errstate(invalid="ignore"):
        return np.asarray(view & np.isfinite(angle_rad) & (angle_sd_rad <= LARGEST_SD_RAD), dtype=np.bool_)


def valid_wrist_angles(view: BoolArray, angles_rad: FloatArray, angles_sd_rad: FloatArray) -> BoolArray:
    """Valid samples (N, 3) of deviation, flexion, pro/supination; the outer two only where flexion is below 75."""
    valid = np.column_stack([valid_angle(view, angles_rad[:, k], angles_sd_rad[:, k]) for k in range(3)])
    with np.errstate(invalid="ignore"):
        conditioned = np.abs(angles_rad[:, 1]) <= ZYX_FLEXION_LIMIT_RAD
    valid[:, 0] &= conditioned
    valid[:, 2] &= conditioned
    return valid
