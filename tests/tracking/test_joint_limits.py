"""Limits pull like measurements and never clip."""

from __future__ import annotations

import math

import numpy as np
import pytest

from carpus.core.model.hand.anatomy import HARD_LIMITS_RAD
from carpus.core.tracking.filter.digit_filter import (
    ANATOMY,
    LIMIT_SD_RAD,
    apply_soft_limits,
)
from carpus.core.tracking.filter.hand_geometry import N_DIGITS, N_SLOTS
from carpus.core.tracking.filter.mixture_filter import ModeMixture

SIZE = ANATOMY.stop
INDEX, PIP = 1, 2


def estimate(pip_deg: float, sd_deg: float) -> ModeMixture:
    """All joints surely at 20 degrees but one: PIP of the index finger."""
    mean = np.zeros((N_DIGITS, 1, SIZE))
    mean[..., 1:3] = math.radians(20.0)
    covariance = np.broadcast_to(1e-8 * np.eye(SIZE), (N_DIGITS, 1, SIZE, SIZE)).copy()
    mean[INDEX, 0, PIP] = math.radians(pip_deg)
    covariance[INDEX, 0, PIP, PIP] = math.radians(sd_deg) ** 2
    return ModeMixture(mean, covariance, np.ones((N_DIGITS, 1)))


def apply_to_angle(pip_deg: float, sd_deg: float) -> tuple[float, float]:
    """PIP and its standard deviation after the limits, degrees."""
    before = estimate(pip_deg, sd_deg)
    after = apply_soft_limits(before, before.mean[:, 0, :N_SLOTS])
    sd = math.sqrt(after.covariance[INDEX, 0, PIP, PIP])
    return math.degrees(after.mean[INDEX, 0, PIP]), math.degrees(sd)


def test_joint_limits_unknown_angle_stays_within_range() -> None:
    low, high = (math.degrees(bound) for bound in HARD_LIMITS_RAD["PIP2_flexion"])
    angle, sd = apply_to_angle(120.0, 40.0)
    assert low + sd < angle < high - 0.5 * sd
    assert 10.0 < sd < (high - low) / math.sqrt(12.0)


def test_joint_limits_moments_match_sampling() -> None:
    """Mean and variance of a Gaussian times a soft step, by a million samples."""
    rng = np.random.default_rng(3)
    mean, sd, limit, soft = 120.0, 12.0, 125.0, math.degrees(LIMIT_SD_RAD)
    sample = rng.normal(mean, sd, 1_000_000)
    kept = sample[sample < limit + rng.normal(0.0, soft, sample.size)]
    angle, after_sd = apply_to_angle(mean, sd)
    assert angle == pytest.approx(float(kept.mean()), abs=0.1)
    assert after_sd == pytest.approx(float(kept.std()), rel=0.02)
