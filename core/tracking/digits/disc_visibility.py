"""How far the discs of the digits are turned from the camera, and how likely each is to be seen."""

from __future__ import annotations

import math

import numpy as np

from carpus.core.model.types import FloatArray
from carpus.core.tracking.filter.digit_filter import DigitLinearisation, DigitView
from carpus.core.tracking.filter.hand_geometry import N_DIGITS, N_DISCS, N_SLOTS

HIDDEN_S, SHOWN_S = 0.4, 3.0  # so long a disc stays hidden or seen on average
STEEPEST_RAD, STEEPEST_SD_RAD = 1.22, 0.15  # the tilt at which discs vanish, give or take
MIN_SEEN, MAX_SEEN = 1e-4, 0.98  # between these the probability stays that a disc is to be seen
MIN_FACING = 0.15  # tilted discs show no less of themselves
LOGISTIC_PER_SD = 1.7  # slope of the logistic function that is nearest to the normal integral

# Slots (5, 5) that tilt the discs past them: a finger's flexions, and the thumb's at MCP and IP, not at CMC.
_TILTING = np.array([[0.0, 0.0, 1.0, 0.0, 1.0], *([0.0, 1.0, 1.0, 1.0, 0.0],) * (N_DIGITS - 1)])


def compute_tilts(
    normal: FloatArray, covariance: FloatArray, linearised: DigitLinearisation, view: DigitView
) -> tuple[FloatArray, FloatArray]:
    """Compute the tilt (5, 3) of the discs to the line of sight in rad, and its variance (5, 3).

    ``normal`` (5, 3, 3) of the discs in W; ``covariance`` (5, n, n) of the states, whose joints are taken to err
    independently.
    """
    centre = linearised.centre_m
    cosine = -np.vecdot(normal.reshape(-1, 3) @ view.rotation.T, centre.reshape(-1, 3)).reshape(N_DIGITS, N_DISCS)
    cosine /= np.sqrt(np.vecdot(centre, centre))
    variance = covariance.diagonal(axis1=1, axis2=2)[:, :N_SLOTS] * _TILTING
    return np.arccos(np.minimum(np.maximum(cosine, -1.0), 1.0)), np.cumsum(variance, axis=1)[:, -N_DISCS:]


def compute_visibility(visible: FloatArray, tilt: FloatArray, variance: FloatArray, dt_s: float) -> FloatArray:
    """Compute the probability (5, 3) that each disc is to be seen, which was ``visible`` (5, 3) ``dt_s`` ago.

    A disc stays hidden or seen for some time, and vanishes when it is turned away, by its ``tilt`` (5, 3) with
    ``variance`` (5, 3).
    """
    stays, comes = math.exp(-dt_s / SHOWN_S), -math.expm1(-dt_s / HIDDEN_S)
    past_sd = LOGISTIC_PER_SD * (tilt - STEEPEST_RAD) / np.sqrt(variance + STEEPEST_SD_RAD**2)
    facing = 1.0 / (1.0 + np.exp(np.minimum(np.maximum(past_sd, -30.0), 30.0)))
    by_time = visible * stays + (1.0 - visible) * comes
    return np.asarray(np.minimum(np.maximum(by_time * facing, MIN_SEEN), MAX_SEEN))


def compute_disc_scale(tilt: FloatArray, linearised: DigitLinearisation, view: DigitView) -> FloatArray:
    """Compute the pixels (5, 3) that each square metre of a disc with a ``tilt`` (5, 3) covers."""
    per_m = view.camera.fx_px / linearised.centre_m[..., 2]
    return np.asarray(np.maximum(np.cos(tilt), MIN_FACING) * per_m * per_m)
