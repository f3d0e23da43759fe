"""The palm's model: its motion, its line of sight, its soft tissue, against finite differences and other filters."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from filterpy.kalman import MerweScaledSigmaPoints, UnscentedKalmanFilter

from carpus.core.compiled.mixture import predict_palm_modes
from carpus.core.model import so3
from carpus.core.model.types import FloatArray
from carpus.core.tracking.filter.mixture_filter import Linearisation, ModeMixture, UnscentedParameters
from carpus.core.tracking.filter.motion import (
    MotionNoise,
    PalmMotion,
    find_unobserved_turns,
    palm_transition,
)
from carpus.core.tracking.filter.palm_state import (
    POSE,
    POSITION,
    RATE,
    RELIEF,
    RIGID_MOTION,
    SHAPE,
    SIZE,
    SKIN,
    SOFT_TISSUE,
    TURN,
    VELOCITY,
    InitialSd,
    PalmEstimate,
    PalmView,
    initial_estimate,
    reset_error,
)
from carpus.core.tracking.filter.predicted_measurement import predict_measurement
from carpus.core.tracking.filter.soft_tissue import (
    HOME,
    SoftTissue,
    joint_driven_modes,
    resting_and_moving_modes,
    single_moving_mode,
    stationary_covariance,
)
from carpus.core.tracking.smoother.palm_smoother import FilterStep, smooth_palm
from tests.tracking.hands import CAMERA, FROM_ABOVE, MIDDLE_M, RIGHT_PALM_M

MOTION = PalmMotion(MotionNoise(), single_moving_mode(SoftTissue()), np.array([0.5, 4.0]))
FOLLOWING = PalmMotion(MotionNoise(), joint_driven_modes(SoftTissue()), np.array([0.5, 4.0]))
RESTING = PalmMotion(MotionNoise(), resting_and_moving_modes(SoftTissue()), np.array([0.5, 4.0]))
NO_HIDDEN = np.zeros((6, 18))
VIEW = PalmView(CAMERA, FROM_ABOVE, MIDDLE_M, RIGHT_PALM_M, NO_HIDDEN)


def moving(seed: int = 0) -> PalmEstimate:
    rng = np.random.default_rng(seed)
    value = np.zeros(SIZE)
    value[POSITION], value[VELOCITY], value[RATE] = 0.02 * rng.normal(size=(3, 3))
    value[RATE] *= 100.0
    value[SHAPE], value[SKIN] = 0.001 * rng.normal(size=(2, 18))
    root = rng.normal(size=(SIZE, SIZE))
    scale = np.full(SIZE, 1e-3)
    scale[TURN] = scale[RATE] = scale[VELOCITY] = 0.02
    covariance = (root @ root.T / SIZE + 0.1 * np.eye(SIZE)) * np.outer(scale, scale)
    return PalmEstimate(so3.exp(0.3 * rng.normal(size=3)), value, covariance)


def linearised_about(estimate: PalmEstimate, view: PalmView, scaling: UnscentedParameters) -> Linearisation:
    """H about an estimate, of one mode without errors."""
    mixture = ModeMixture.from_gaussian(np.zeros((1, SIZE)), estimate.covariance[None], 1)
    return predict_measurement(estimate, mixture, view, scaling).linearised


def coasting(estimate: PalmEstimate, dt_s: float) -> PalmEstimate:
    """The motion written out: constant velocities; what skin and relief do is the modes'."""
    value = estimate.value.copy()
    value[TURN] = 0.0
    value[POSITION] = estimate.position_m + dt_s * estimate.velocity_m_s
    return PalmEstimate(estimate.rotation_w2_w0 @ so3.exp(dt_s * estimate.rate_rad_s), value, estimate.covariance)


@pytest.mark.parametrize("dt_s", [0.005, 1.0 / 30.0, 0.5])
def test_palm_transition_is_the_derivative_of_the_motion(dt_s: float) -> None:
    estimate, step = moving(), 1e-5
    found = palm_transition(estimate.rate_rad_s, MOTION, dt_s)
    after = found.propagate(estimate, dt_s)
    assert np.allclose(after.compute_error(coasting(estimate, dt_s)), 0.0, atol=1e-12)
    forward = np.eye(SIZE)
    forward[RIGID_MOTION, RIGID_MOTION] = found.moving
    for i in range(SIZE):
        error = np.zeros(SIZE)
        error[i] = step
        ahead, back = (
            after.compute_error(coasting(estimate.add_error(sign * error, estimate.covariance), dt_s))
            for sign in (1.0, -1.0)
        )
        assert np.allclose(forward[:, i], (ahead - back) / (2.0 * step), atol=1e-6), i


def test_palm_prediction_covariance_is_independent_of_frame_rate() -> None:
    """White acceleration has a density: it matters not into how many steps the time is cut."""
    start = initial_estimate(InitialSd(), 1e-6 * np.eye(21)).covariance
    ends = []
    for steps in (1, 10, 200):
        found = palm_transition(np.zeros(3), RESTING, 1.0 / steps)
        mixture = ModeMixture.from_gaussian(np.zeros((1, SIZE)), start[None], RESTING.modes)
        for _ in range(steps):
            mixture = ModeMixture(*predict_palm_modes(mixture, found, np.zeros(SIZE), None))
        ends.append(mixture.covariance)
    assert np.allclose(ends[0], ends[2], rtol=1e-6, atol=1e-12)
    assert np.allclose(ends[1], ends[2], rtol=1e-6, atol=1e-12)


def test_soft_tissue_reaches_its_stationary_covariance() -> None:
    stationary = stationary_covariance(SoftTissue())
    tissue = np.r_[SKIN, RELIEF]
    assert np.linalg.eigvalsh(stationary[np.ix_(tissue, tissue)]).min() > 0.0
    found = palm_transition(np.zeros(3), MOTION, 0.1)
    mixture = ModeMixture.from_gaussian(np.zeros((1, SIZE)), np.zeros((1, SIZE, SIZE)), 2)
    for _ in range(600):
        mixture = ModeMixture(*predict_palm_modes(mixture, found, np.zeros(SIZE), None))
    now = mixture.covariance[0, 0]
    assert np.allclose(now[np.ix_(tissue, tissue)], stationary[np.ix_(tissue, tissue)], rtol=1e-3, atol=1e-12)
    sd_mm = 1e3 * np.sqrt(np.diag(stationary[SKIN, SKIN])).reshape(6, 3)
    assert sd_mm[5, 2] > sd_mm[4, 2] > 2.0 * sd_mm[3, 2], "the little knuckle sinks most, the middle one hardly"
    assert (sd_mm[2:, 0] > sd_mm[2:, 1]).all(), "skin glides along the ray more than across"


def test_tissue_noise_coming_home_is_driven() -> None:
    home, away = (int(np.flatnonzero((FOLLOWING.tissue_of == HOME) == is_home)[0]) for is_home in (True, False))
    stayed, came = np.zeros((2, FOLLOWING.modes, FOLLOWING.modes))
    stayed[home, home] = came[away, home] = 1.0
    step = palm_transition(np.zeros(3), FOLLOWING, 1.0 / 30.0)
    rest, push = (FOLLOWING.tissue_noise(went, step) for went in (stayed, came))
    np.testing.assert_allclose(push - rest, stationary_covariance(SoftTissue())[SOFT_TISSUE, SOFT_TISSUE], atol=1e-15)


def test_palm_measurement_is_filterpys_unscented_transform() -> None:
    """Mean, covariance and cross-covariance of what is seen, as filterpy's own sigma points of the pose give them."""
    estimate = moving(5)
    wide = estimate.covariance.copy()
    wide[SHAPE] = wide[SKIN] = wide[:, SHAPE] = wide[:, SKIN] = 0.0
    estimate = replace(estimate, covariance=wide)
    pose = wide[np.ix_(POSE, POSE)]
    spread = UnscentedParameters()
    points = MerweScaledSigmaPoints(POSE.size, alpha=spread.alpha, beta=spread.beta, kappa=spread.kappa)

    def seen(offset: FloatArray) -> FloatArray:
        error = np.zeros(SIZE)
        error[POSE] = offset
        discs = VIEW.discs_cam_m(estimate.add_error(error, wide))
        return np.column_stack((CAMERA.project(discs), discs[:, 2])).ravel()

    other = UnscentedKalmanFilter(POSE.size, 18, 1.0, seen, lambda x, dt: x, points)
    other.P = pose + 1e-14 * np.eye(POSE.size)
    other.Q, other.R = np.zeros((POSE.size, POSE.size)), 1e-9 * np.eye(18)
    other.predict()
    other.sigmas_f = points.sigma_points(np.zeros(POSE.size), other.P)
    other.update(seen(np.zeros(POSE.size)))
    linearised = linearised_about(estimate, VIEW, spread)
    slope = linearised.slope[0][:, POSE]
    assert np.allclose(slope @ pose @ slope.T + linearised.error[0], other.S - other.R, rtol=1e-6, atol=1e-6)
    image = np.array([seen(point) for point in other.sigmas_f])
    assert np.allclose(linearised.value[0], other.Wm @ image, atol=1e-9)


def test_reset_error_moves_the_nominal_and_keeps_the_modes() -> None:
    rng, estimate = np.random.default_rng(9), moving(9)
    apart = 0.01 * rng.normal(size=(1, 2, SIZE))
    both = np.stack((estimate.covariance, 2 * estimate.covariance))[None]
    mixture = ModeMixture(apart, both, np.array([[0.3, 0.7]]))
    after, apart = reset_error(estimate, mixture)
    assert np.allclose(apart.merge()[0], 0.0, atol=1e-4)
    for k in range(2):
        there = estimate.add_error(mixture.mean[0, k], estimate.covariance)
        again = after.add_error(apart.mean[0, k], estimate.covariance)
        assert np.allclose(there.compute_error(again), 0.0, atol=2e-6)


def test_palm_smoother_gap_is_a_straight_line() -> None:
    """Known well at both ends and not at all between, a steadily turning hand was halfway in the middle."""
    wide, sharp = np.eye(SIZE) * 1e-2, np.eye(SIZE) * 1e-8
    steps = []
    for k in range(11):
        value = np.zeros(SIZE)
        value[RATE] = [0.0, 1.0, 0.0]
        angle = 0.1 * k if k in (0, 10) else 0.1 * k + 0.05
        rotation = so3.exp(np.array([0.0, angle, 0.0]))
        steps.append(
            FilterStep(
                0.1 * k, PalmEstimate(rotation, value, sharp if k in (0, 10) else wide), np.array([1.0, 0.0]), k > 0
            )
        )
    found = smooth_palm(steps, MOTION)
    middle = found[5]
    assert middle is not None
    assert so3.log(middle.rotation_w2_w0)[1] == pytest.approx(0.5, abs=0.02)
    for estimate in found:
        assert estimate is not None
        assert np.linalg.eigvalsh(estimate.covariance).min() > 0.0


def test_palm_smoother_resting_tissue_is_not_averaged_away() -> None:
    """What displaced tissue has wrong comes again in every picture: looking back states more than if all were new, in
    the same proportion everywhere, never more than live, and reads the same angles."""
    steps = [FilterStep(k / 30.0, moving(1), RESTING.initial_probability, k > 0) for k in range(30)]
    as_new = replace(RESTING, tissue=replace(RESTING.tissue, variance_factor=1.0))
    live = float(np.trace(moving(1).covariance[TURN, TURN]))
    for found, bold in zip(smooth_palm(steps, RESTING)[:-1], smooth_palm(steps, as_new)[:-1], strict=True):
        assert found is not None
        assert bold is not None
        assert np.array_equal(found.value, bold.value)
        assert np.array_equal(found.rotation_w2_w0, bold.rotation_w2_w0)
        own, new = (float(np.trace(one.covariance[TURN, TURN])) for one in (found, bold))
        assert own == pytest.approx(max(new, min(RESTING.tissue.variance_factor * new, live)))
        assert own > 1.1 * new or own == pytest.approx(live)
        assert np.allclose(found.covariance / own, bold.covariance / new)
    assert smooth_palm(steps, RESTING)[-1] is steps[-1].estimate


# --- turns that nothing shows -----------------------------------------------------------------------------
PALM_M = np.array(
    [[0.0, 0.0, 0.0], [-0.012, 0.016, 0.001], [-0.03, 0.08, 0.003], [-0.008, 0.083, 0.006], [0.012, 0.079, 0.004],
     [0.03, 0.07, 0.0]]
)  # fmt: skip


def test_unobserved_turns_knuckles_alone_hide_turn_about_their_line() -> None:
    assert find_unobserved_turns(PALM_M) is None
    assert find_unobserved_turns(PALM_M[[0, 2, 3]]) is None
    unseen = find_unobserved_turns(PALM_M[2:])
    assert unseen is not None
    np.testing.assert_allclose(unseen @ unseen, unseen, atol=1e-12)
    linearised = PALM_M[5, :2] - PALM_M[2, :2]
    assert (
        abs(unseen[:2, :2] @ (linearised / np.linalg.norm(linearised)) @ (linearised / np.linalg.norm(linearised)))
        > 0.98
    )
    assert np.trace(unseen) == pytest.approx(1.0)
