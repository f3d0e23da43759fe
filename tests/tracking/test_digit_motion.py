"""How thumb and fingers may move between two pictures, and which of their joints stay near where they belong."""

from __future__ import annotations

import numpy as np
import pytest

from carpus.core.tracking.filter.digit_filter import DIGIT_SIZE, DigitMotion
from carpus.core.tracking.filter.hand_geometry import N_CONSTANTS, N_DIGITS, N_SLOTS
from carpus.core.tracking.filter.mixture_filter import ModeMixture

STRAYS_RAD, SETTLES_S = 0.1, 1.0
END_JOINT = 3
SCALES = np.array([0.5, 4.0])


def motion() -> DigitMotion:
    density = np.full((N_DIGITS, N_SLOTS), 2.0)
    density[1:, END_JOINT] = 0.0
    stationary2 = np.zeros((N_DIGITS, N_SLOTS))
    stationary2[1:, END_JOINT] = STRAYS_RAD**2
    return DigitMotion(density, SCALES, np.zeros((N_DIGITS, N_CONSTANTS)), stationary2, SETTLES_S)


def predict_variance(seconds: float, dt_s: float) -> ModeMixture:
    """What is believed of an end joint 0.3 rad from where it belongs, surely, after that time without a picture."""
    mean = np.zeros((N_DIGITS, DIGIT_SIZE))
    mean[:, END_JOINT] = 0.3
    mixture = ModeMixture.from_gaussian(
        mean, np.broadcast_to(1e-12 * np.eye(DIGIT_SIZE), (N_DIGITS, DIGIT_SIZE, DIGIT_SIZE)), SCALES.size
    )
    moves = motion()
    for _ in range(round(seconds / dt_s)):
        mixture = moves.predict(mixture, dt_s, None)
    return mixture


@pytest.mark.parametrize("dt_s", [1.0 / 30.0, 0.1])
def test_digit_motion_coupled_dip_returns_to_pip_with_its_scatter(dt_s: float) -> None:
    soon, late = predict_variance(SETTLES_S, dt_s), predict_variance(10.0 * SETTLES_S, dt_s)
    assert soon.mean[1:, :, END_JOINT] == pytest.approx(0.3 / np.e, rel=1e-2)
    assert late.mean[1:, :, END_JOINT] == pytest.approx(0.0, abs=1e-3)
    variance = late.covariance[1:, :, END_JOINT, END_JOINT]
    assert np.sqrt(variance) == pytest.approx(STRAYS_RAD, rel=1e-3), "in every mode alike, however often it is asked"
