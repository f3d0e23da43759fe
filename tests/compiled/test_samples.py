"""Depth readings on a lattice, compiled, against NumPy."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from carpus.core.compiled import samples as compiled
from tests.compiled.comparing import LAYOUTS
from tests.compiled.oracle import samples as oracle

RAW = (
    np.random.default_rng(7).integers(3500, 3550, (240, 320))
    * (np.random.default_rng(8).uniform(size=(240, 320)) < 0.8)
).astype(np.uint16)
CORNERS = np.array([[160.3, 190.2], [128.6, 172.8], [124.1, 100.7], [146.8, 92.4]])
DISCS = np.random.default_rng(9).uniform((120.0, 80.0), (220.0, 190.0), (15, 2))
UNIT_M = 2e-4


def outline(raw: np.ndarray, corner_px: np.ndarray, most: int = 112, step: int = 3, twin: Any = compiled) -> Any:
    return twin.sample_outline(raw, UNIT_M, corner_px, 1.2, 4.0, step, most)


def discs(raw: np.ndarray, disc_px: np.ndarray, most: int = 352, step: int = 4, twin: Any = compiled) -> Any:
    return twin.sample_discs(raw, UNIT_M, disc_px, 12.0, step, most)


def same(read: Callable[..., Any], raw: np.ndarray, place_px: np.ndarray, **how: int) -> Any:
    """What is read, after the oracle's was found to be the same to the last bit."""
    found, expected = read(raw, place_px, **how), read(raw, place_px, **how, twin=oracle)
    assert (found is None) == (expected is None)
    for one, other in zip(found or (), expected or (), strict=True):
        np.testing.assert_array_equal(one, other)
    return found


@pytest.mark.parametrize("shift_px", [0.0, -135.5, 140.0, -90.25, 1e4, -1e4, 1e12, -1e12])
@pytest.mark.parametrize("most", [1, 3, 40, 5000])
def test_readings_anywhere_are_the_oracles(shift_px: float, most: int) -> None:
    for read, places in ((outline, CORNERS), (discs, DISCS)):
        found = same(read, RAW, places + shift_px, most=most)
        assert (found is None) == (abs(shift_px) > 1e3)


@pytest.mark.parametrize("corners", [1, 2, 3, 9])
def test_readings_of_any_outline_and_step_are_the_oracles(corners: int) -> None:
    for seed in range(20):
        rng = np.random.default_rng(seed)
        places = rng.uniform(-60.0, 360.0, (corners, 2))
        step = int(rng.integers(1, 40))
        same(outline, RAW, places, step=step)
        same(discs, RAW, places, step=step)


def test_readings_as_far_from_a_disc_as_others_are_taken_row_by_row() -> None:
    found = same(discs, RAW, np.full((4, 2), 160.0), most=10)
    assert len(found[1]) == 10


def test_frame_without_readings_gives_none() -> None:
    assert not len(same(outline, np.zeros_like(RAW), CORNERS)[1])
    assert same(discs, np.zeros_like(RAW), DISCS) is None


@pytest.mark.parametrize("unknown", [np.nan, np.inf, -np.inf])
def test_places_that_are_not_known_give_nothing(unknown: float) -> None:
    for read, places in ((outline, CORNERS), (discs, DISCS)):
        places = places.copy()
        places[2, 1] = unknown
        assert same(read, RAW, places) is None


@pytest.mark.parametrize("layout", LAYOUTS)
def test_arrays_stored_otherwise_give_the_same(layout: Callable[[np.ndarray], np.ndarray]) -> None:
    for read, places in ((outline, CORNERS), (discs, DISCS)):
        for one, other in zip(read(layout(RAW), layout(places)), read(RAW, places), strict=True):
            np.testing.assert_array_equal(one, other)


def test_samples_invalid_request_is_refused() -> None:
    for read, places in ((outline, CORNERS), (discs, DISCS)):
        for raw, place, how in (
            (RAW.astype(np.int32), places, {}),
            (RAW[0], places, {}),
            (RAW, places[0], {}),
            (RAW, places[:, :1], {}),
            (RAW, places[:0], {}),
            (RAW, places.astype(np.float32), {}),
            (RAW, places, {"step": 0}),
            (RAW, places, {"most": 0}),
        ):
            with pytest.raises(ValueError, match=r"dtype|dimensions|places|lattice"):
                read(raw, place, **how)
