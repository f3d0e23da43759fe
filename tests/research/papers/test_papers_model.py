"""The papers' filter, motion (1), Euler angles, hand and association."""

from __future__ import annotations

import numpy as np
import pytest
from filterpy.kalman import MerweScaledSigmaPoints, UnscentedKalmanFilter
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation
from scipy.stats import multivariate_normal

from carpus.core.calibration.neutral_pose import with_w0_from_markers
from carpus.core.model.hand.anatomy_prior import Gaussian
from carpus.core.model.hand.kinematics import joint_centres
from carpus.core.model.hand.protocols import HAND21, SITES
from carpus.core.model.types import FloatArray
from carpus.core.research.papers.hand_model import PaperSettings, calibrate_as_written, measure_hand, model_palm
from carpus.core.research.papers.tracker import (
    PaperMotion,
    assign_blobs,
    euler_from_rotation,
    log_posteriors,
    predict_outputs,
    predict_state,
    rotation_from_euler,
    update_state,
)
from carpus.core.tracking.filter.mixture_filter import UnscentedParameters
from tests.research.papers.hands import MIDDLE_M, calibration, hand_calibration, straight_hand
from tests.tracking.hands import CAMERA, FROM_ABOVE, RIGHT_PALM_M

DT_S = 1.0 / 30.0
SETTINGS = PaperSettings(acceleration_m_s2=2.0, turn_rate_rad_s=1.5, joint_rate_rad_s=0.7)


def test_state_moves_by_equation_1() -> None:
    rng = np.random.default_rng(2)
    state, noise = rng.normal(size=(4, 26)), rng.normal(size=(4, 23))
    out = PaperMotion(SETTINGS, 17).build_transition(DT_S)(state, noise)
    for before, eta, after in zip(state, noise, out, strict=True):
        turned = Rotation.from_euler("ZYX", before[6:9]) * Rotation.from_rotvec(1.5 * eta[3:6] * DT_S)
        assert np.allclose(after[:3], before[:3] + before[3:6] * DT_S)
        assert np.allclose(after[3:6], before[3:6] + 2.0 * eta[:3] * DT_S)
        assert np.allclose(Rotation.from_euler("ZYX", after[6:9]).as_matrix(), turned.as_matrix())
        assert np.allclose(after[9:], before[9:] + 0.7 * eta[6:] * DT_S)


def test_euler_angles_there_and_back_without_a_jump() -> None:
    rng = np.random.default_rng(5)
    near = rng.uniform(-1.2, 1.2, (50, 3)) + np.array([4.0 * np.pi, 0.0, 0.0])
    there = near + 0.1 * rng.normal(size=near.shape)
    assert np.allclose(euler_from_rotation(rotation_from_euler(there), near), there)
    assert np.allclose(rotation_from_euler(there), Rotation.from_euler("ZYX", there).as_matrix())


@pytest.mark.parametrize("mirror", [1.0, -1.0])
def test_flat_palm_keeps_lengths_and_angles(mirror: float) -> None:
    palm = RIGHT_PALM_M * [1.0, mirror, 1.0]
    flat = model_palm(palm, "flat")
    assert not flat[:, 2].any()
    assert np.allclose(np.linalg.norm(flat, axis=1), np.linalg.norm(palm, axis=1))
    for disc, laid in zip(palm[1:], flat[1:], strict=True):
        angle = [
            np.arccos(d @ m / np.linalg.norm(d) / np.linalg.norm(m)) for d, m in ((disc, palm[3]), (laid, flat[3]))
        ]
        assert angle[0] == pytest.approx(angle[1], abs=1e-7)
    assert np.array_equal(np.sign(flat[:, 1]), np.sign(palm[:, 1]))
    assert model_palm(palm, "measured") is palm


def test_straight_hand_is_found_as_it_is() -> None:
    anatomy, _ = straight_hand()
    hand = measure_hand(hand_calibration(FROM_ABOVE), CAMERA, "flat")
    bent = np.linspace(-0.2, 0.6, 17)
    thumb_apart = np.r_[0:21][
        ~np.isin(np.arange(21), (3, 4))
    ]  # its bones are not in one line at zero, ours are told so
    assert np.allclose(hand.discs_m(bent)[thumb_apart], joint_centres(anatomy, bent)[thumb_apart], atol=1e-9)
    assert np.allclose(hand.discs_m(bent), joint_centres(anatomy, bent), atol=1e-9)


def test_marker_without_depth_is_as_far_as_one_before() -> None:
    whole = hand_calibration(FROM_ABOVE)
    lost = whole.marker_position_w0_m.copy()
    tip = SITES.index("TIP3")
    lost[tip] = np.nan
    holed = calibration(whole.marker_position_w0_m, HAND21)
    object.__setattr__(holed, "marker_position_w0_m", lost)
    flat, measured = measure_hand(holed, CAMERA, "flat"), measure_hand(whole, CAMERA, "flat")
    assert np.allclose(flat.discs_m(np.zeros(17)), measured.discs_m(np.zeros(17)), atol=1e-6)
    assert np.isnan(calibrate_as_written(holed, CAMERA, "flat").marker_position_w0_m[tip]).all(), (
        "what is unknown stays unknown"
    )


def test_neutral_pose_is_least_squares_one_of_palm_as_modelled() -> None:
    before = calibration(RIGHT_PALM_M)
    after = calibrate_as_written(before, CAMERA, "flat")
    flat = model_palm(RIGHT_PALM_M, "flat")
    point = RIGHT_PALM_M @ FROM_ABOVE.T + MIDDLE_M
    assert np.allclose(after.marker_position_w0_m @ after.rotation_w0_cam.T + after.translation_w0_cam_m, point)

    def cost(turn: np.ndarray, shift: np.ndarray) -> float:
        placed = flat @ (after.rotation_w0_cam @ Rotation.from_rotvec(turn).as_matrix()).T
        placed = placed + after.translation_w0_cam_m + shift
        pixels = (CAMERA.project(placed) - CAMERA.project(point)) / 0.3
        return float(np.sum(pixels**2) + np.sum(((placed - point)[:, 2] / 0.002) ** 2))

    least = cost(np.zeros(3), np.zeros(3))
    for axis in np.eye(3):
        for sign in (1.0, -1.0):
            assert cost(sign * 1e-4 * axis, np.zeros(3)) > least
            assert cost(np.zeros(3), sign * 1e-5 * axis) > least
    again = with_w0_from_markers(after)
    assert np.allclose(
        again.marker_position_w0_m[[0, 3]], [[0.0, 0.0, 0.0], [np.linalg.norm(RIGHT_PALM_M[3]), 0.0, 0.0]]
    )
    assert np.allclose(again.marker_position_w0_m @ again.rotation_w0_cam.T + again.translation_w0_cam_m, point)


RESOLUTION = 640.0 * 480.0


@given(st.integers(0, 10_000), st.integers(0, 12), st.integers(1, 8), st.floats(0.01, 0.9))
def test_association_takes_largest_posterior_per_blob(seed: int, blobs: int, markers: int, clutter: float) -> None:
    rng = np.random.default_rng(seed)
    predicted = rng.uniform(200, 260, (markers, 2))
    root = rng.normal(size=(markers, 2, 2)) * 4.0
    covariance = root @ np.swapaxes(root, 1, 2) + np.eye(2)
    pixel = rng.uniform(190, 270, (blobs, 2))

    wanted: dict[int, tuple[float, int]] = {}
    for blob in range(blobs):
        density = [multivariate_normal.pdf(pixel[blob] - predicted[j], cov=covariance[j]) for j in range(markers)]
        weight = [clutter / RESOLUTION] + [each * (1.0 - clutter) / markers for each in density]
        choice = int(np.argmax(weight))
        if choice and weight[choice] > wanted.get(choice - 1, (0.0, -1))[0]:
            wanted[choice - 1] = (weight[choice], blob)

    found = log_posteriors(pixel, predicted, covariance, clutter, RESOLUTION)
    assert found.shape == (blobs, 1 + markers)
    assert assign_blobs(found).tolist() == [wanted.get(j, (0.0, -1))[1] for j in range(markers)]


SCALINGS = [UnscentedParameters(1.0, 2.0, 0.0), UnscentedParameters(0.25, 2.0, 0.0), UnscentedParameters(0.5, 0.0, 1.0)]


def some_covariance(rng: np.random.Generator, n: int) -> FloatArray:
    root = rng.normal(size=(n, n))
    return root @ root.T + 0.1 * np.eye(n)


def moved(state: FloatArray, noise: FloatArray) -> FloatArray:
    """A motion into which the noise does not enter as a sum."""
    x, y, heading = state[..., 0], state[..., 1], state[..., 2] + noise[..., 0]
    pace = 1.0 + 0.3 * noise[..., 1] ** 2 + 0.2 * np.sin(x)
    return np.stack((x + pace * np.cos(heading), y + pace * np.sin(heading), heading), axis=-1)


def project_state(state: FloatArray) -> FloatArray:
    x, y = state[..., 0], state[..., 1]
    return np.stack((np.hypot(x + 4.0, y), np.arctan2(y, x + 4.0)), axis=-1)


@pytest.mark.parametrize("scaling", SCALINGS)
@pytest.mark.parametrize("seed", range(3))
def test_predict_and_update_are_filterpys(scaling: UnscentedParameters, seed: int) -> None:
    rng = np.random.default_rng(seed)
    x, p, q = rng.normal(size=3), 0.02 * some_covariance(rng, 3), 0.03 * some_covariance(rng, 2)
    r, y = np.array([0.04, 0.01]), project_state(x) + 0.2 * rng.normal(size=2)

    points = MerweScaledSigmaPoints(5, scaling.alpha, scaling.beta, scaling.kappa)
    oracle = UnscentedKalmanFilter(
        5, 2, 1.0, lambda s: project_state(s[:3]), lambda s, _dt: np.concatenate((moved(s[:3], s[3:]), s[3:])), points
    )
    oracle.x, oracle.P = np.concatenate((x, np.zeros(2))), np.zeros((5, 5))
    oracle.P[:3, :3], oracle.P[3:, 3:] = p, q
    oracle.Q, oracle.R = np.zeros((5, 5)), np.diag(r)
    oracle.compute_process_sigmas(1.0)
    predicted_points = oracle.sigmas_f.copy()
    oracle.predict()
    ahead = predict_state(Gaussian(x, p), q, moved, scaling)
    assert np.allclose(ahead.state.mean, oracle.x[:3], rtol=1e-9, atol=1e-12)
    assert np.allclose(ahead.state.covariance, oracle.P[:3, :3], rtol=1e-9, atol=1e-12)

    oracle.sigmas_f = predicted_points  # it draws new ones; (9) goes on with those that were moved
    oracle.update(y)
    after, _ = update_state(ahead, predict_outputs(ahead, project_state(ahead.points)), y, r)
    assert np.allclose(after.mean, oracle.x[:3], rtol=1e-8, atol=1e-10)
    assert np.allclose(after.covariance, oracle.P[:3, :3], rtol=1e-8, atol=1e-10)
    assert np.linalg.norm(after.mean - ahead.state.mean) > 1e-3
