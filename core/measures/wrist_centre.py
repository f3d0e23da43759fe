"""Wrist centre of rotation, and how far it moved: whether the forearm lay still.

The WRIST marker lies on the skin above the joint and moves by 15 mm and more in full flexion. The centre is the point
of the hand that stays in place when the hand turns; its remaining movement is the forearm's.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from carpus.core.measures.signals import BoolArray
from carpus.core.model import so3
from carpus.core.model.types import FloatArray

DEFAULT_CENTRE_M = np.array([0.0, 0.0, -0.015])
"""Centre of rotation below its marker, in W2 (reference 2)."""
CENTRE_SD_M = 0.015
"""Prior standard deviation of the centre, for hands that hardly turn."""
POSITION_SD_M = 0.002
_MAX_ITERATIONS = 8
_TRIM_FACTOR = 2.5


@dataclass(frozen=True, slots=True)
class WristCentre:
    """Centre of rotation from the WRIST marker in W2, with its movement.

    ``displacement_m`` is (N,) its distance from its mean place, ``residual_m`` the root mean square of that.
    """

    centre_w2_m: FloatArray
    residual_m: float
    displacement_m: FloatArray


def rotation_in_w0(rotation_w2_w0: FloatArray, w0_turn_rad: FloatArray) -> FloatArray:
    """Express rotations (N, 3, 3) of W2 in the axes of the stored W0; an unknown turn counts as none."""
    return np.asarray(so3.exp(np.nan_to_num(w0_turn_rad)) @ rotation_w2_w0)


def estimate_wrist_centre(position_m: FloatArray, rotation_w2_w0: FloatArray, valid: BoolArray) -> WristCentre:
    """Fit the centre of rotation to positions (N, 3) and rotations (N, 3, 3) of the wrist.

    Robust least squares over the ``valid`` samples (N,): outliers of a moving forearm are excluded. NaN below two
    samples.
    """
    good = np.asarray(valid, dtype=bool) & np.isfinite(position_m).all(axis=1) & np.isfinite(rotation_w2_w0).all((1, 2))
    if int(good.sum()) < 2:
        return WristCentre(np.full(3, math.nan), math.nan, np.full(len(position_m), math.nan))
    turned, at = rotation_w2_w0[good], position_m[good]
    used = np.ones(len(at), dtype=bool)
    centre, place = DEFAULT_CENTRE_M, np.median(at + turned @ DEFAULT_CENTRE_M, axis=0)
    for _ in range(_MAX_ITERATIONS):
        centre, place = _fit_centre(at[used], turned[used])
        off = np.linalg.norm(at + turned @ centre - place, axis=1)
        kept = off <= max(_TRIM_FACTOR * float(np.median(off)), POSITION_SD_M)
        if (kept == used).all():
            break
        used = kept
    off = np.linalg.norm(at + turned @ centre - place, axis=1)
    moved = np.full(len(position_m), math.nan)
    moved[good] = off
    return WristCentre(centre, float(np.sqrt(np.mean(off[used] ** 2))), moved)


def _fit_centre(position_m: FloatArray, rotation: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Solve for centre and place by least squares, with the default centre as a prior."""
    count = len(position_m)
    rows = np.concatenate((rotation, np.broadcast_to(-np.eye(3), rotation.shape)), axis=2).reshape(3 * count, 6)
    prior = np.hstack((np.eye(3), np.zeros((3, 3)))) * (POSITION_SD_M / CENTRE_SD_M) * math.sqrt(min(count, 30))
    found, *_ = np.linalg.lstsq(
        np.vstack((rows, prior)), np.concatenate((-position_m.ravel(), prior[:, :3] @ DEFAULT_CENTRE_M)), rcond=None
    )
    return found[:3], found[3:]
