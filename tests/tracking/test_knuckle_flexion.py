"""Where a finger's discs are hidden, depth says how far it is bent: by where it is, and by where it is not."""

from __future__ import annotations

import math

import numpy as np
import pytest

from carpus.core.model.types import FINGER_SAMPLE_STEP_PX, FloatArray, SurfaceSamples
from carpus.core.tracking.digits.knuckle_flexion import (
    FLEXION_SLOT,
    KnuckleFlexion,
    estimate_knuckle_flexion,
    update_by_knuckle_flexion,
)
from carpus.core.tracking.filter.digit_filter import DIGIT_SIZE, DigitView
from carpus.core.tracking.filter.hand_geometry import N_DIGITS, N_SLOTS
from carpus.core.tracking.filter.mixture_filter import ModeMixture
from tests.tracking.hands import CAMERA, FROM_ABOVE, MIDDLE_M, RIGHT_PALM_M

INDEX = 1
LENGTH_M, HEIGHT_M, DEPTH_M = 0.044, 0.0075, 0.011
TABLE_M = 0.06
VIEW = DigitView(FROM_ABOVE, MIDDLE_M, CAMERA)


def states() -> FloatArray:
    mean = np.zeros((N_DIGITS, DIGIT_SIZE))
    anatomy = 2 * N_SLOTS
    mean[:, anatomy], mean[:, anatomy + 7], mean[:, anatomy + 8] = LENGTH_M, DEPTH_M, HEIGHT_M
    return mean


def readings(flexion_deg: float, breadth_m: float = 0.008) -> SurfaceSamples:
    """A hand as flat as its knuckles before a table, and one finger as a plate bent at its knuckle."""
    u, v = np.meshgrid(np.arange(240, 420, FINGER_SAMPLE_STEP_PX), np.arange(160, 300, FINGER_SAMPLE_STEP_PX))
    pixel = np.column_stack((u.ravel(), v.ravel())).astype(float)
    in_w = (CAMERA.backproject(pixel, np.full(len(pixel), MIDDLE_M[2])) - MIDDLE_M) @ FROM_ABOVE
    height = np.where(in_w[:, 0] < RIGHT_PALM_M[2, 0], 0.0, -TABLE_M)
    angle = math.radians(flexion_deg)
    knuckle = RIGHT_PALM_M[2] + np.array([0.0, 0.0, -DEPTH_M])
    for share in np.linspace(0.0, 1.3, 400):
        reach = share * LENGTH_M
        x = knuckle[0] + reach * math.cos(angle) + HEIGHT_M * math.sin(angle)
        z = knuckle[2] - reach * math.sin(angle) + HEIGHT_M * math.cos(angle)
        on = (np.abs(in_w[:, 0] - x) < 0.0028) & (np.abs(in_w[:, 1] - knuckle[1]) < breadth_m)
        height[on] = np.maximum(height[on], z)
    return SurfaceSamples(pixel, MIDDLE_M[2] - height)


def bends(samples: SurfaceSamples) -> KnuckleFlexion:
    """What the readings say of the index finger."""
    return estimate_knuckle_flexion([INDEX], states(), RIGHT_PALM_M[1:], VIEW, samples)


def test_knuckle_flexion_update_is_weak_and_leaves_other_digits() -> None:
    covariance = np.broadcast_to(0.3**2 * np.eye(DIGIT_SIZE), (N_DIGITS, DIGIT_SIZE, DIGIT_SIZE))
    mixture = ModeMixture.from_gaussian(states(), covariance, 2)
    found = bends(readings(60.0))
    once = update_by_knuckle_flexion(mixture, found)
    many = once
    for _ in range(30):
        many = update_by_knuckle_flexion(many, found)
    first, last = (math.degrees(one.merge()[0][INDEX, FLEXION_SLOT]) for one in (once, many))
    assert 5.0 < first < 45.0
    assert last == pytest.approx(math.degrees(found.value_rad[INDEX]), abs=4.0)
    others = np.delete(np.arange(N_DIGITS), INDEX)
    assert np.allclose(once.mean[others], mixture.mean[others])
    assert np.allclose(once.covariance[others], mixture.covariance[others])


def cover_readings(at: float, off_m: float) -> SurfaceSamples:
    """A finger bent by 50 degrees, its end beyond a share of its length read ``off_m`` too far."""
    bare = readings(50.0)
    in_w = (CAMERA.backproject(bare.pixel, np.full(len(bare.pixel), MIDDLE_M[2])) - MIDDLE_M) @ FROM_ABOVE
    reach = RIGHT_PALM_M[2, 0] + at * LENGTH_M * math.cos(math.radians(50.0))
    hit = (in_w[:, 0] > reach) & (np.abs(in_w[:, 1] - RIGHT_PALM_M[2, 1]) < 0.008)
    return SurfaceSamples(bare.pixel, bare.depth_m + off_m * hit)


def test_knuckle_flexion_free_space_excludes_a_finger() -> None:
    past, before = (bends(cover_readings(0.75, off_m)) for off_m in (0.03, -0.03))
    assert math.degrees(past.value_rad[INDEX]) > 70.0, "so it is bent out of the way"
    assert not before.is_any
