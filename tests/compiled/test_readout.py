"""What is read off the palm, compiled, against NumPy."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from carpus.core.compiled import readout as compiled
from carpus.core.model import so3
from carpus.core.model.hand.clinical_angles import ZYZ_MIN_BETA_RAD, side_sign, wrist_axes_sensitivity
from carpus.core.model.types import FloatArray, Side
from carpus.core.tracking.filter.palm_state import SIZE, PalmEstimate
from carpus.core.tracking.filter.readout import METACARPAL_M, WristAxes
from tests.compiled.comparing import LAYOUTS, assert_same, laid_out
from tests.compiled.oracle import readout as oracle
from tests.compiled.test_palm import view_of
from tests.tracking.hands import RIGHT_PALM_M
from tests.tracking.test_palm_filter import moving

START, STAYS = so3.exp(np.array([0.1, 0.9, -0.2])), 1e-4 * np.diag([1.0, 2.0, 3.0])
SIDES: tuple[Side, ...] = ("right", "left")


def axes_for(seed: int) -> WristAxes:
    shape = 1e-4 * np.random.default_rng(seed).normal(size=18)
    return WristAxes(*wrist_axes_sensitivity(RIGHT_PALM_M + shape.reshape(6, 3), np.array([0.0, 0.0, 1.0])), shape)


def read(
    known: WristAxes, estimate: PalmEstimate, start: FloatArray | None, stays: FloatArray | None, side: Side
) -> Any:
    sign = side_sign(side)
    return compiled.read_wrist(known, RIGHT_PALM_M, estimate, start, stays, sign, ZYZ_MIN_BETA_RAD)


@pytest.mark.parametrize("side", SIDES)
@pytest.mark.parametrize("seed", range(3))
def test_reading_of_any_palm_is_the_oracles(side: Side, seed: int) -> None:
    known, estimate, view = axes_for(seed), moving(seed), view_of(np.random.default_rng(seed))
    if seed == 2:
        estimate = replace(estimate, rotation_w2_w0=np.eye(3))  # where ZYZ angles are not defined
    for start, stays in ((None, None), (START, None), (None, STAYS), (START, STAYS)):
        expected = oracle.read_wrist(known, RIGHT_PALM_M, estimate, start, stays, side)
        assert np.isnan(expected[6]).all() == (seed == 2 and start is None)
        assert_same(read(known, estimate, start, stays, side), expected)
    found = compiled.compute_finger_base(known, RIGHT_PALM_M, estimate, view, side_sign(side), METACARPAL_M)
    assert_same(found, oracle.seat_fingers(known, RIGHT_PALM_M, estimate, view, side, METACARPAL_M))


@pytest.mark.parametrize("layout", LAYOUTS)
def test_arrays_stored_otherwise_are_read_as_they_are(layout: Callable[[np.ndarray], np.ndarray]) -> None:
    known, estimate, view = axes_for(0), moving(0), view_of(np.random.default_rng(0))
    palm, axes = laid_out(estimate, layout), laid_out(known, layout)
    found = read(axes, palm, layout(START), layout(STAYS), "right")
    assert_same(found, oracle.read_wrist(known, RIGHT_PALM_M, estimate, START, STAYS, "right"))
    found = compiled.compute_finger_base(axes, layout(RIGHT_PALM_M), palm, view, 1.0, METACARPAL_M)
    assert_same(found, oracle.seat_fingers(known, RIGHT_PALM_M, estimate, view, "right", METACARPAL_M))


def test_an_unknown_number_is_unknown_where_the_oracles_is() -> None:
    known, estimate, view = axes_for(1), moving(1), view_of(np.random.default_rng(1))
    estimate.covariance[6, 12] = estimate.covariance[12, 6] = estimate.value[SIZE - 5] = np.nan
    found = read(known, estimate, None, None, "right")
    assert np.isnan(found[5]).all()
    assert_same(found, oracle.read_wrist(known, RIGHT_PALM_M, estimate, None, None, "right"))
    found = compiled.compute_finger_base(known, RIGHT_PALM_M, estimate, view, 1.0, METACARPAL_M)
    assert np.isnan(found[8]).all()
    assert_same(found, oracle.seat_fingers(known, RIGHT_PALM_M, estimate, view, "right", METACARPAL_M))


def test_sizes_and_types_that_do_not_fit_are_refused() -> None:
    known, estimate, view = axes_for(0), moving(0), view_of(np.random.default_rng(0))
    for axes, palm, start, stays in (
        (replace(known, sensitivity=known.sensitivity[:2]), estimate, None, None),
        (replace(known, shape_m=known.shape_m[:-1]), estimate, None, None),
        (replace(known, axes=known.axes[0]), estimate, None, None),
        (known, replace(estimate, value=estimate.value[:-1]), None, None),
        (known, replace(estimate, covariance=estimate.covariance.astype(np.float32)), None, None),
        (known, estimate, np.eye(2), None),
        (known, estimate, None, np.eye(4)),
    ):
        with pytest.raises(ValueError, match=r"where|dtype"):
            read(axes, palm, start, stays, "right")
        if start is None and stays is None:
            with pytest.raises(ValueError, match=r"where|dtype"):
                compiled.compute_finger_base(axes, RIGHT_PALM_M, palm, view, 1.0, METACARPAL_M)
