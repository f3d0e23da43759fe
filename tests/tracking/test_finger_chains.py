"""The quick chains of the filter against the plain ones of ``core.model.hand``, their slopes, and limits that pull."""

from __future__ import annotations

import math

import numpy as np
import pytest

from carpus.core.compiled.digits import BENT, OTHER, place_digits
from carpus.core.model.camera import Camera
from carpus.core.model.hand.anatomy import HARD_LIMITS_RAD, HandAnatomy, anatomy_from_size
from carpus.core.model.hand.anatomy_prior import constants_from_anatomy
from carpus.core.model.hand.kinematics import DIP_PER_PIP, disc_centres, joint_centres, segment_frames
from carpus.core.model.hand.protocols import SITE_CHAINS, joint_angle_names
from carpus.core.model.types import FloatArray
from carpus.core.tracking.filter.digit_filter import (
    ANATOMY,
    DIGIT_SIZE,
    LIMIT_SD_RAD,
    OBSERVED,
    RATES,
    DigitView,
    apply_soft_limits,
    draw_sigma_points,
    linearise_digits,
)
from carpus.core.tracking.filter.hand_geometry import (
    N_DIGITS,
    N_SLOTS,
    JointAngleMap,
)
from carpus.core.tracking.filter.mixture_filter import ModeMixture, UnscentedParameters

DIGIT_MARKERS = np.array(SITE_CHAINS)[:, 2:]


def to_slots(angles_rad: FloatArray) -> FloatArray:
    """Slots (..., 5, 5) of 17 or 21 joint angles (..., J)."""
    lead, per_finger = angles_rad.shape[:-1], (angles_rad.shape[-1] - 5) // 4
    slots = np.zeros((*lead, N_DIGITS, N_SLOTS))
    slots[..., 0, :] = angles_rad[..., :5]
    slots[..., 1:, :per_finger] = angles_rad[..., 5:].reshape(*lead, 4, per_finger)
    if per_finger == 4:
        slots[..., 1:, 3] -= DIP_PER_PIP * slots[..., 1:, 2]
    return slots


def hand(seed: int) -> HandAnatomy:
    rng = np.random.default_rng(seed)
    return anatomy_from_size(float(rng.uniform(0.14, 0.2)), arch=float(rng.uniform(0.5, 1.2)), nail_discs=True)


def angles(seed: int, dip_free: bool) -> FloatArray:
    """Joints anywhere in their range."""
    rng = np.random.default_rng(100 + seed)
    return np.array(
        [
            np.radians(rng.uniform(-15.0, 15.0) if "abduction" in name else rng.uniform(-10.0, 90.0))
            for name in joint_angle_names(dip_free)
        ]
    )


def to_state(anatomy: HandAnatomy, joints: FloatArray) -> FloatArray:
    return np.concatenate((to_slots(joints), constants_from_anatomy(anatomy)), axis=1)


@pytest.mark.parametrize("dip_free", [False, True])
@pytest.mark.parametrize("seed", range(5))
def test_digit_discs_and_joints_match_plain_chains(seed: int, dip_free: bool) -> None:
    anatomy, joints = hand(seed), angles(seed, dip_free)
    state, roots = to_state(anatomy, joints), anatomy.palm_disc_m[1:]
    bone, normal, chain, disc_m = place_digits(state, roots)
    assert np.allclose(disc_m, disc_centres(anatomy, joints)[DIGIT_MARKERS], atol=1e-12)
    plain = joint_centres(anatomy, joints)
    assert np.allclose(chain[:, 1:], plain[DIGIT_MARKERS], atol=1e-12)
    assert np.allclose(chain[:, 0], plain[DIGIT_MARKERS[:, 0] - 1], atol=1e-12)
    bones = segment_frames(anatomy, joints)
    direction = (bones.end_m - bones.start_m)[1:].reshape(N_DIGITS, 3, 3)
    direction /= np.linalg.norm(direction, axis=-1, keepdims=True)
    assert np.allclose(bone, direction, atol=1e-12)
    assert np.allclose(np.linalg.norm(normal, axis=-1), 1.0, atol=1e-12)
    assert np.allclose(normal[:, 2], bones.dorsal_normal[1:].reshape(N_DIGITS, 3, 3)[:, 2], atol=1e-12)


@pytest.mark.parametrize("seed", range(3))
def test_digit_slope_by_constants_matches_finite_differences(seed: int) -> None:
    anatomy, joints = hand(seed), angles(seed, dip_free=True)
    state, roots = to_state(anatomy, joints), anatomy.palm_disc_m[1:]
    mean = np.zeros((N_DIGITS, DIGIT_SIZE))
    mean[:, OBSERVED] = state
    covariance = np.broadcast_to(np.eye(DIGIT_SIZE), (N_DIGITS, DIGIT_SIZE, DIGIT_SIZE))
    slope = draw_sigma_points(mean, covariance, roots, UnscentedParameters()).by_constants
    step = 1e-6
    for column, constant in enumerate(OTHER):
        ahead, back = state.copy(), state.copy()
        ahead[:, constant] += step
        back[:, constant] -= step
        by_difference = (place_digits(ahead, roots)[3] - place_digits(back, roots)[3]) / (2.0 * step)
        assert np.allclose(slope[..., column], by_difference, atol=1e-8), constant


def test_digit_linearisation_of_a_sure_state_is_the_projection() -> None:
    """As the covariance goes to nothing, the statistical line becomes the tangent."""
    anatomy, joints = hand(1), angles(1, dip_free=True)
    roots = anatomy.palm_disc_m[1:]
    mean = np.zeros((N_DIGITS, DIGIT_SIZE))
    mean[:, OBSERVED] = to_state(anatomy, joints)
    covariance = np.broadcast_to(1e-8 * np.eye(DIGIT_SIZE), (N_DIGITS, DIGIT_SIZE, DIGIT_SIZE))
    down = np.array([[0.0, -1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, -1.0]])
    view = DigitView(down, np.array([0.01, 0.02, 0.7]), Camera(525.0, 530.0, 319.5, 239.5))
    linearised = linearise_digits(
        draw_sigma_points(mean, covariance, roots, UnscentedParameters()), view, UnscentedParameters()
    )

    def images(about: FloatArray) -> FloatArray:
        point = place_digits(about[:, OBSERVED], roots)[3] @ down.T + view.translation_m
        z = point[..., 2]
        return np.stack(
            (525.0 * point[..., 0] / z + 319.5, 530.0 * point[..., 1] / z + 239.5, z), axis=-1
        ).reshape(N_DIGITS, 9)  # fmt: skip

    assert np.allclose(linearised.value, images(mean), atol=1e-3)
    for slot in OBSERVED[BENT]:  # the roll among them
        ahead, back = mean.copy(), mean.copy()
        ahead[:, slot] += 1e-5
        back[:, slot] -= 1e-5
        by_difference = (images(ahead) - images(back)) / 2e-5
        assert np.allclose(linearised.slope[:, :, slot], by_difference, rtol=1e-3, atol=0.05), slot
    assert np.allclose(linearised.slope[:, :, RATES], 0.0)
    by_slope = linearised.slope @ covariance @ np.swapaxes(linearised.slope, 1, 2)
    assert np.allclose(linearised.image_covariance, by_slope, rtol=1e-2, atol=1e-4)


@pytest.mark.parametrize("dip_free", [False, True])
def test_joint_angle_map_inverts_the_slots(dip_free: bool) -> None:
    joints = angles(7, dip_free)
    reading = JointAngleMap.from_digits(dip_free)
    assert np.allclose(reading.compute_angles(to_slots(joints)), joints, atol=1e-14)
    variance = reading.compute_variances(
        np.broadcast_to(np.diag([1.0, 2.0, 3.0, 4.0, 5.0]), (N_DIGITS, N_SLOTS, N_SLOTS))
    )
    by_name = dict(zip(joint_angle_names(dip_free), variance, strict=True))
    assert by_name["IP1_flexion"] == pytest.approx(5.0)
    assert by_name["PIP4_flexion"] == pytest.approx(3.0)
    if dip_free:
        assert by_name["DIP4_flexion"] == pytest.approx(4.0 / 9.0 * 3.0 + 4.0)


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
