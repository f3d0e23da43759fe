"""How errors and noise travel over a step, by finite differences of the motion itself; density, not steps."""

from __future__ import annotations

import numpy as np
import pytest

from core import so3
from core.tracking import modes
from core.tracking.modes import ModeBank
from core.tracking.motion import MotionNoise, advance, predict, process_covariance, transition
from core.tracking.state import Belief, InitialSd, StateLayout, resting_belief
from core.types import FloatArray

NOISE = MotionNoise(2.0, 8.0, 1.5, 12.0, 2.5)
LAYOUTS = [StateLayout(3, True, 4), StateLayout(3, False, 4), StateLayout(0, True, 0)]


def moving(layout: StateLayout, seed: int = 0) -> Belief:
    rng = np.random.default_rng(seed)
    rates = layout.has_rates
    root = rng.normal(size=(layout.size, layout.size))
    return Belief(
        rng.normal(size=3),
        rng.normal(size=3),
        so3.exp(rng.normal(size=3)),
        2.0 * rng.normal(size=3) if rates else np.zeros(3),
        rng.normal(size=layout.joint_count),
        rng.normal(size=layout.joint_count) if rates else np.zeros(layout.joint_count),
        rng.normal(size=layout.shape_count),
        1e-4 * (root @ root.T / layout.size + np.eye(layout.size)),
    )


def still(layout: StateLayout) -> FloatArray:
    return np.zeros(6 + layout.joint_count)


@pytest.mark.parametrize("layout", LAYOUTS)
def test_moved_and_error_to_are_inverse(layout: StateLayout) -> None:
    belief = moving(layout)
    error = 0.3 * np.random.default_rng(1).normal(size=layout.size)
    assert np.allclose(belief.error_to(belief.moved(error, layout), layout), error, atol=1e-12)


@pytest.mark.parametrize("dt_s", [0.005, 1.0 / 30.0, 0.5])
@pytest.mark.parametrize("layout", LAYOUTS)
def test_transition_is_the_derivative_of_the_motion(layout: StateLayout, dt_s: float) -> None:
    belief, step = moving(layout), 1e-5
    after = advance(belief, still(layout), dt_s, layout)
    f = transition(belief, dt_s, layout)
    for i in range(layout.size):
        error = np.zeros(layout.size)
        error[i] = step
        ahead, back = (
            after.error_to(advance(belief.moved(sign * error, layout), still(layout), dt_s, layout), layout)
            for sign in (1.0, -1.0)
        )
        assert np.allclose(f[:, i], (ahead - back) / (2.0 * step), atol=1e-7)


@pytest.mark.parametrize("dt_s", [0.005, 1.0 / 30.0, 0.5])
@pytest.mark.parametrize("layout", LAYOUTS)
def test_process_covariance_is_that_of_the_noise_inputs(layout: StateLayout, dt_s: float) -> None:
    """Q = G diag(sd^2) G' with G by finite differences, for a hand in the middle of a turn."""
    belief, step = moving(layout), 1e-4
    after = advance(belief, still(layout), dt_s, layout)
    sd = NOISE.per_step(layout, dt_s)
    g = np.empty((layout.size, sd.size))
    for i in range(sd.size):
        noise = still(layout)
        noise[i] = step
        ahead, back = (after.error_to(advance(belief, s * noise, dt_s, layout), layout) for s in (1.0, -1.0))
        g[:, i] = (ahead - back) / (2.0 * step)
    expected = (g * sd**2) @ g.T
    assert np.allclose(process_covariance(belief, NOISE, dt_s, layout), expected, rtol=1e-6, atol=1e-9 * expected.max())


@pytest.mark.parametrize("layout", LAYOUTS)
def test_a_second_brings_the_same_uncertainty_at_any_frame_rate(layout: StateLayout) -> None:
    belief = resting_belief(layout, InitialSd(), shape_covariance=1e-6 * np.eye(layout.shape_count))
    ends = []
    for steps in (10, 30, 200):
        now = belief
        for _ in range(steps):
            now = predict(now, NOISE, 1.0 / steps, layout)
        # By Euler's rule, as in eq. (5), the place lags a step behind the velocity: there steps do count.
        ends.append(np.diag(now.covariance)[0 if layout.has_rates else 3 :])
    assert np.allclose(ends[0], ends[1], rtol=0.02)
    assert np.allclose(ends[2], ends[1], rtol=0.02)


def test_at_thirty_pictures_a_second_noise_is_the_papers_per_sample() -> None:
    layout = StateLayout(2, False)
    assert np.allclose(NOISE.per_step(layout, 1.0 / 30.0), [2.0] * 3 + [1.5] * 3 + [2.5] * 2)


def test_equation_5_step_by_step() -> None:
    """T + v dt, v + eta_v dt, R Exp(eta_omega dt)."""
    layout, dt_s = StateLayout(0, False), 0.03
    belief = moving(layout)
    noise = np.array([1.0, -2.0, 0.5, 3.0, -1.0, 2.0])
    after = advance(belief, noise, dt_s, layout)
    assert np.allclose(after.position_m, belief.position_m + belief.velocity_m_s * dt_s)
    assert np.allclose(after.velocity_m_s, belief.velocity_m_s + noise[:3] * dt_s)
    assert np.allclose(after.rotation_w2_w0, belief.rotation_w2_w0 @ so3.exp(noise[3:] * dt_s))


def test_constant_rate_turns_on_with_its_rate() -> None:
    layout = StateLayout(1, True)
    belief = moving(layout)
    now = belief
    for _ in range(10):
        now = advance(now, still(layout), 0.02, layout)
    assert np.allclose(now.rotation_w2_w0, belief.rotation_w2_w0 @ so3.exp(0.2 * belief.rate_rad_s))
    assert np.allclose(now.position_m, belief.position_m + 0.2 * belief.velocity_m_s)
    assert np.allclose(now.joints_rad, belief.joints_rad + 0.2 * belief.joint_rates_rad_s)


@pytest.mark.parametrize("layout", LAYOUTS)
def test_bank_of_modes_is_predicted_as_each_mode_alone(layout: StateLayout) -> None:
    belief = moving(layout)
    rng = np.random.default_rng(2)
    error = 1e-3 * rng.normal(size=(3, layout.size))
    scales, dt_s = np.array([0.5, 1.0, 4.0]), 0.04
    covariance = np.stack([belief.covariance * s for s in (1.0, 2.0, 0.7)])
    bank = ModeBank(belief, error, covariance, np.array([0.2, 0.5, 0.3]))
    after = modes.predicted(bank, NOISE, scales, dt_s, layout)
    for k, scale in enumerate(scales):
        alone = predict(belief.moved(error[k], layout, covariance[k]), NOISE.scaled(scale), dt_s, layout)
        mode = after.nominal.moved(after.error[k], layout)
        # The modes' differences travel by the nominal belief's derivative: right to first order.
        assert np.abs(mode.error_to(alone, layout)).max() < 1e-5
        sd = np.sqrt(np.diag(alone.covariance))
        assert np.abs((after.covariance[k] - alone.covariance) / np.outer(sd, sd)).max() < 1e-3
