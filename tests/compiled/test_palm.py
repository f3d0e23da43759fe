"""The palm's motion, sight and reset, compiled, against NumPy."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from carpus.core.compiled import palm as compiled
from carpus.core.model import so3
from carpus.core.tracking.filter.mixture_filter import ModeMixture
from carpus.core.tracking.filter.motion import MotionNoise, PalmMotion
from carpus.core.tracking.filter.palm_state import SIZE, PalmEstimate, PalmView
from carpus.core.tracking.filter.soft_tissue import (
    DigitSpeeds,
    SoftTissue,
    TissueModes,
    joint_driven_modes,
    resting_and_moving_modes,
    single_moving_mode,
)
from carpus.core.tracking.filter.unscented import UnscentedParameters, compute_weights
from tests.compiled.comparing import LAYOUTS, assert_same, laid_out
from tests.compiled.oracle import palm as oracle
from tests.tracking.hands import CAMERA, FROM_ABOVE, MIDDLE_M, RIGHT_PALM_M
from tests.tracking.test_palm_filter import moving

SPEEDS, WEIGHTS = DigitSpeeds(0.7, 1.3), compute_weights(6, UnscentedParameters())
TISSUES = (single_moving_mode, resting_and_moving_modes, joint_driven_modes)


def view_of(rng: np.random.Generator) -> PalmView:
    turned = FROM_ABOVE @ so3.exp(0.2 * rng.normal(size=3))
    return PalmView(CAMERA, turned, MIDDLE_M, RIGHT_PALM_M, 0.3 * rng.normal(size=(6, 18)))


def mixture_about(estimate: PalmEstimate, rng: np.random.Generator, modes: int) -> ModeMixture:
    probability = rng.uniform(0.1, 1.0, size=(1, modes))
    return ModeMixture(
        0.01 * rng.normal(size=(1, modes, SIZE)),
        estimate.covariance * rng.uniform(0.5, 2.0, size=(1, modes, 1, 1)),
        probability / probability.sum(),
    )


def motion_of(tissue: Callable[[SoftTissue], TissueModes], scales: tuple[float, ...]) -> PalmMotion:
    return PalmMotion(MotionNoise(), tissue(SoftTissue()), np.array(scales))


@pytest.mark.parametrize("tissue", TISSUES)
@pytest.mark.parametrize("scales", [(1.0,), (0.5, 4.0)])
@pytest.mark.parametrize("dt_s", [0.0, 0.033, 3.0])
def test_step_of_any_motion_is_the_oracles(
    tissue: Callable[[SoftTissue], TissueModes], scales: tuple[float, ...], dt_s: float
) -> None:
    motion, along = motion_of(tissue, scales), np.random.default_rng(13).normal(size=3)
    unseen = np.outer(along, along) / (along @ along)
    for rate, hidden in ((moving(1).rate_rad_s, None), (moving(2).rate_rad_s, unseen), (np.zeros(3), None)):
        found = compiled.compute_palm_transition(motion, rate, dt_s, hidden, SPEEDS)
        assert_same(found, oracle.move_palm(motion, rate, dt_s, hidden, SPEEDS))
        assert np.allclose(found[4].sum(axis=1), 1.0)


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("modes", [1, 8])
def test_sight_and_reset_of_any_palm_are_the_oracles(seed: int, modes: int) -> None:
    rng = np.random.default_rng(seed)
    estimate, view = moving(seed), view_of(rng)
    mixture = mixture_about(estimate, rng, modes)
    assert_same(
        compiled.predict_palm_measurement(estimate, mixture, view, WEIGHTS),
        oracle.see_palm(estimate, mixture, view, WEIGHTS),
    )
    assert_same(compiled.reset_errors(estimate, mixture), oracle.reset_errors(estimate, mixture))


@pytest.mark.parametrize("layout", LAYOUTS)
def test_arrays_stored_otherwise_are_read_as_they_are(layout: Callable[[np.ndarray], np.ndarray]) -> None:
    rng, motion = np.random.default_rng(4), motion_of(joint_driven_modes, (0.5, 4.0))
    estimate, view = moving(4), view_of(rng)
    mixture, unseen = mixture_about(estimate, rng, 3), np.diag([1.0, 0.0, 0.0])
    palm, modes = laid_out(estimate, layout), laid_out(mixture, layout)
    seen = replace(view, palm_m=layout(view.palm_m), depth_bias=layout(view.depth_bias))
    assert_same(
        compiled.predict_palm_measurement(palm, modes, seen, WEIGHTS), oracle.see_palm(estimate, mixture, view, WEIGHTS)
    )
    assert_same(compiled.reset_errors(palm, modes), oracle.reset_errors(estimate, mixture))
    found = compiled.compute_palm_transition(motion, layout(estimate.rate_rad_s), 0.03, layout(unseen), SPEEDS)
    assert_same(found, oracle.move_palm(motion, estimate.rate_rad_s, 0.03, unseen, SPEEDS))


def test_unknown_number_is_unknown_where_oracles_is() -> None:
    rng = np.random.default_rng(5)
    estimate, view = moving(5), view_of(rng)
    mixture = mixture_about(estimate, rng, 2)
    estimate.value[SIZE - 5] = mixture.mean[0, 1, 7] = np.nan
    shaky = replace(estimate, value=moving(5).value, covariance=estimate.covariance.copy())
    shaky.covariance[-1, :3] = shaky.covariance[:3, -1] = np.nan
    for palm, part in ((estimate, 3), (shaky, 4)):
        found = compiled.predict_palm_measurement(palm, mixture, view, WEIGHTS)
        assert np.isnan(found[part]).any()
        assert_same(found, oracle.see_palm(palm, mixture, view, WEIGHTS))
    assert_same(compiled.reset_errors(estimate, mixture), oracle.reset_errors(estimate, mixture))


@pytest.mark.parametrize("sign", [-1.0, np.nan])
def test_palm_that_is_not_known_at_all_is_no_covariance(sign: float) -> None:
    rng, estimate = np.random.default_rng(0), moving()
    broken = replace(estimate, covariance=sign * estimate.covariance)
    with pytest.raises(np.linalg.LinAlgError):
        compiled.predict_palm_measurement(broken, mixture_about(estimate, rng, 2), view_of(rng), WEIGHTS)


def test_sizes_and_types_that_do_not_fit_are_refused() -> None:
    rng, estimate, motion = np.random.default_rng(6), moving(6), motion_of(resting_and_moving_modes, (0.5, 4.0))
    view, mixture = view_of(rng), mixture_about(estimate, rng, 2)
    for palm, modes, seen in (
        (replace(estimate, value=estimate.value[:-1]), mixture, view),
        (replace(estimate, covariance=estimate.covariance[:, :-1]), mixture, view),
        (replace(estimate, rotation_w2_w0=np.eye(2)), mixture, view),
        (replace(estimate, value=estimate.value.astype(np.float32)), mixture, view),
        (estimate, replace(mixture, mean=mixture.mean[0]), view),
        (estimate, replace(mixture, probability=mixture.probability[:, :1]), view),
        (estimate, mixture, replace(view, depth_bias=view.depth_bias[:5])),
    ):
        with pytest.raises(ValueError, match=r"where|dtype"):
            compiled.predict_palm_measurement(palm, modes, seen, WEIGHTS)
    with pytest.raises(ValueError, match="where"):
        compiled.reset_errors(replace(estimate, value=estimate.value[:-1]), mixture)
    for rate, unseen in ((np.zeros(2), None), (np.zeros(3), np.eye(2))):
        with pytest.raises(ValueError, match="where"):
            compiled.compute_palm_transition(motion, rate, 0.03, unseen, SPEEDS)
