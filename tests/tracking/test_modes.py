"""Motion modes side by side: moments of mixtures, Bayes' rule, and filterpy's IMM on a linear model."""

from __future__ import annotations

import numpy as np
import pytest
from filterpy.kalman import IMMEstimator, KalmanFilter
from hypothesis import given, settings
from hypothesis import strategies as st

from core import so3
from core.tracking import modes
from core.tracking.measurement import forecast_augmented, forecast_reduced, update
from core.tracking.modes import ModeBank
from core.tracking.state import StateLayout
from core.tracking.unscented import Spread
from core.types import FloatArray
from tests.tracking.test_linear_oracle import JOINTS, NOISE, SHAPES, LinearView, as_vector, by_hand, linear_view, start

LAYOUT = StateLayout(JOINTS, True, SHAPES)


def random_bank(count: int, seed: int = 0, turn_sd: float = 0.05) -> ModeBank:
    rng = np.random.default_rng(seed)
    nominal = start(LAYOUT, rng, yaw_rate=0.5)
    n = LAYOUT.size
    roots = rng.normal(size=(count, n, n)) / np.sqrt(n)
    error = rng.normal(size=(count, n))
    error[:, LAYOUT.turn] *= turn_sd
    probability = rng.uniform(0.1, 1.0, count)
    return ModeBank(nominal, error, roots @ np.swapaxes(roots, 1, 2), probability / probability.sum())


def moments(weight: FloatArray, mean: FloatArray, covariance: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Mean and covariance of a mixture, summed up one by one."""
    total = sum(w * m for w, m in zip(weight, mean, strict=True))
    spread = sum(w * (c + np.outer(m - total, m - total)) for w, m, c in zip(weight, mean, covariance, strict=True))
    return np.asarray(total), np.asarray(spread)


@settings(deadline=None)
@given(st.integers(1, 5), st.floats(0.01, 5.0), st.floats(0.001, 2.0))
def test_switching_keeps_probability_and_the_dwell(count: int, dwell_s: float, dt_s: float) -> None:
    switch = modes.switching(count, dwell_s, dt_s)
    assert np.allclose(switch.sum(axis=1), 1.0)
    assert (switch >= 0.0).all()
    if count > 1:
        assert np.allclose(np.diag(switch), np.exp(-dt_s / dwell_s))


@pytest.mark.parametrize("count", [2, 3])
def test_merged_bank_has_the_moments_of_the_mixture(count: int) -> None:
    bank = random_bank(count)
    merged = modes.merged(bank, LAYOUT)
    mean, covariance = moments(bank.probability, bank.error, bank.covariance)
    assert np.allclose(bank.nominal.error_to(merged.nominal, LAYOUT), mean, atol=1e-12)
    assert np.allclose(merged.nominal.covariance, covariance, rtol=1e-12, atol=1e-14)
    assert np.array_equal(merged.probability, bank.probability)
    # Every mode stays where it was, only told from another place: turns to second order in a twentieth radian.
    for k in range(count):
        before = bank.nominal.moved(bank.error[k], LAYOUT)
        after = merged.nominal.moved(merged.error[k], LAYOUT)
        error = before.error_to(after, LAYOUT)
        assert np.abs(np.delete(error, np.arange(6, 9))).max() < 1e-12
        assert np.linalg.norm(error[LAYOUT.turn]) < 2e-4
        apart = bank.nominal.moved(mean, LAYOUT).error_to(before, LAYOUT)[LAYOUT.turn]
        assert np.linalg.norm(apart) > 1e-2, "the modes do differ"


def test_turns_told_from_another_rotation_to_second_order() -> None:
    """Halving the turns makes the slip eight times smaller: the first term left out is of third order."""
    slips = []
    for turn_sd in (0.2, 0.1):
        bank = random_bank(3, seed=4, turn_sd=turn_sd)
        merged = modes.merged(bank, LAYOUT)
        slips.append(
            max(
                float(
                    np.linalg.norm(
                        so3.log(
                            bank.nominal.moved(bank.error[k], LAYOUT).rotation_w2_w0.T
                            @ merged.nominal.moved(merged.error[k], LAYOUT).rotation_w2_w0
                        )
                    )
                )
                for k in range(3)
            )
        )
    assert slips[0] / slips[1] == pytest.approx(8.0, rel=0.25)


@pytest.mark.parametrize("count", [1, 2, 3])
def test_mixed_modes_have_the_moments_of_what_may_have_switched_to_them(count: int) -> None:
    bank = random_bank(count, seed=1)
    switch = modes.switching(count, 0.5, 0.1)
    mixed = modes.mixed(bank, switch)
    for k in range(count):
        arriving = bank.probability * switch[:, k]
        mean, covariance = moments(arriving / arriving.sum(), bank.error, bank.covariance)
        assert mixed.probability[k] == pytest.approx(arriving.sum())
        assert np.allclose(mixed.error[k], mean, atol=1e-12)
        assert np.allclose(mixed.covariance[k], covariance, atol=1e-12)


def test_mixing_does_not_change_what_is_known_on_the_whole() -> None:
    bank = random_bank(3, seed=2)
    mixed = modes.mixed(bank, modes.switching(3, 0.2, 0.1))
    before = moments(bank.probability, bank.error, bank.covariance)
    after = moments(mixed.probability, mixed.error, mixed.covariance)
    assert np.allclose(after[0], before[0], atol=1e-12)
    assert np.allclose(after[1], before[1], atol=1e-12)


def test_reweighing_is_bayes_rule_and_leaves_no_mode_for_dead() -> None:
    prior, likelihood = np.array([0.2, 0.5, 0.3]), np.array([4.0, 1.0, 0.5])
    assert np.allclose(modes.reweighed(prior, np.log(likelihood)), prior * likelihood / (prior @ likelihood))
    # A constant in all log-likelihoods, however large, changes nothing.
    assert np.allclose(modes.reweighed(prior, np.log(likelihood) - 5000.0), modes.reweighed(prior, np.log(likelihood)))
    crushed = modes.reweighed(prior, np.array([0.0, -1000.0, 0.0]))
    assert crushed[1] > 0.0
    assert crushed.sum() == pytest.approx(1.0)


def test_slowed_bank_keeps_places_and_slows_every_mode() -> None:
    bank = random_bank(2, seed=3)
    slowed = modes.slowed(bank, 0.5, LAYOUT)
    for k in range(2):
        before = bank.nominal.moved(bank.error[k], LAYOUT)
        after = slowed.nominal.moved(slowed.error[k], LAYOUT)
        assert np.allclose(after.position_m, before.position_m)
        assert np.allclose(after.rotation_w2_w0, before.rotation_w2_w0)
        assert np.allclose(after.velocity_m_s, 0.5 * before.velocity_m_s)
        assert np.allclose(after.rate_rad_s, 0.5 * before.rate_rad_s)
        assert np.allclose(after.joint_rates_rad_s, 0.5 * before.joint_rates_rad_s)
        # Halved with all that is known of them: an unseen hand's velocity cannot become anything.
        halved = np.ones(LAYOUT.size)
        halved[np.r_[3:6, 9:12, 15:18]] = 0.5
        assert np.allclose(slowed.covariance[k], np.diag(halved) @ bank.covariance[k] @ np.diag(halved))


@pytest.mark.parametrize("form", ["reduced", "augmented"])
def test_modes_are_filterpys_imm_on_a_linear_model(form: str) -> None:
    rng = np.random.default_rng(11)
    view: LinearView = linear_view(rng, 0.0)
    belief = start(LAYOUT, rng, yaw_rate=0.0)
    scales, dwell_s, dt_s = np.array([0.5, 4.0]), 0.3, 1.0 / 30.0
    rows = np.array([0, 1, 2, 4, 5, 6, 8, 11])
    noise = rng.uniform(0.05, 0.3, rows.size) ** 2
    h = view.matrix(LAYOUT)[rows]
    filters = []
    for scale in scales:
        f, q = by_hand(LAYOUT, dt_s)
        kalman = KalmanFilter(LAYOUT.size, rows.size)
        kalman.x, kalman.P = as_vector(belief, LAYOUT)[:, None], belief.covariance.copy()
        kalman.F, kalman.Q, kalman.H, kalman.R = f, scale**2 * q, h, np.diag(noise)
        filters.append(kalman)
    switch = modes.switching(2, dwell_s, dt_s)
    oracle = IMMEstimator(filters, np.array([0.5, 0.5]), switch)
    bank = ModeBank.of(belief, 2)
    build = forecast_reduced if form == "reduced" else forecast_augmented
    weights = []
    # Of the turn nothing is seen here: in a second it may be anything, and a full circle is not linear.
    linear = np.r_[0:6, 12 : LAYOUT.size]
    for step in range(30):
        truth = as_vector(bank.nominal, LAYOUT)
        y = h @ truth + (0.1 if step < 15 else 0.22) * rng.normal(size=rows.size)
        ahead = build(modes.mixed(bank, switch), NOISE, scales, dt_s, LAYOUT, view, Spread())  # type: ignore[arg-type]
        after, innovation = update(ahead, rows, y, noise)
        bank = modes.merged(
            ModeBank(
                after.nominal, after.error, after.covariance,
                modes.reweighed(after.probability, innovation.log_likelihood),
            ),
            LAYOUT,
        )  # fmt: skip
        oracle.predict()
        oracle.update(y[:, None])
        assert bank.probability.min() > 2e-6, "above the floor, where Bayes' rule is all there is"
        assert np.allclose(bank.probability, oracle.mu, rtol=0.0, atol=1e-8)
        assert np.allclose(as_vector(bank.nominal, LAYOUT)[linear], oracle.x.ravel()[linear], rtol=0.0, atol=1e-8)
        both = np.ix_(linear, linear)
        assert np.allclose(bank.nominal.covariance[both], oracle.P[both], rtol=0.0, atol=1e-9)
        weights.append(bank.probability[1])
    assert max(weights) > 0.8
    assert min(weights) < 0.5
