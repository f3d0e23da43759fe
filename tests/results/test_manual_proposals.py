"""What sessions propose for the form of manual measurements."""

from __future__ import annotations

import math
from dataclasses import replace
from datetime import timedelta

import pytest

from carpus.core.model.hand.exercises import get_exercise
from carpus.core.results.manual_proposals import find_measured_values, propose_kapandji
from carpus.core.results.measure import Group, Measure
from carpus.core.results.session_results import SessionResults
from tests.ui.fakes import figures_once, session


def measure(group: Group, subject: str, quantity: str, value: float) -> Measure:
    return Measure(group, subject, quantity, "", (value,), value)


def make_results(exercise: str, *measures: Measure) -> SessionResults:
    made = figures_once(session())
    return replace(made, exercise=get_exercise(exercise), measures=measures, is_simulated=False)


def make_opposition(*touches: float) -> SessionResults:
    """Touches of index to little finger."""
    subjects = [f"TIP1-TIP{finger}" for finger in range(2, 6)]
    return make_results(
        "THUMB_OPP", *(measure("task", *one) for one in zip(subjects, ["touches"] * 4, touches, strict=True))
    )


@pytest.mark.parametrize(
    ("touches", "score"), [((2, 0, 0, 0), 3), ((2, 1, 1, 0), 5), ((0, 0, 0, 1), 6), ((2, math.nan, 0, math.nan), 3)]
)
def test_kapandji_proposal_is_the_farthest_fingertip_that_was_touched(touches: tuple[float, ...], score: int) -> None:
    seen = make_opposition(*touches)
    assert propose_kapandji([seen], seen.side, seen.when.date()) == (score, seen.when)


def test_kapandji_proposal_without_touch_other_hand_simulated_or_excluded_is_none() -> None:
    seen = make_opposition(2, 1, 1, 1)
    day = seen.when.date()
    assert propose_kapandji([make_opposition(0, 0, math.nan, 0)], seen.side, day) is None
    other = replace(seen, side="left" if seen.side == "right" else "right")
    for one in (other, replace(seen, is_simulated=True), replace(seen, is_excluded=True)):
        assert propose_kapandji([one], seen.side, day) is None
    worse = replace(make_opposition(1, 0, 0, 0), when=seen.when + timedelta(minutes=5))
    assert propose_kapandji([worse, seen], seen.side, day) == (3, worse.when), "the last one counts"


def test_measured_values_are_of_the_day_and_count_hyperextension_above_zero() -> None:
    ends = (measure("range", "PIP3_flexion", "flexion", 90.0), measure("range", "PIP3_flexion", "extension", 20.0))
    seen = make_results("FIST_COMPOSITE", *ends)
    day = seen.when.date()
    found = find_measured_values([seen], seen.side, day)
    assert {key: one.mean for key, one in found.items()} == {
        ("PIP3_FLEXION", "active"): 90.0,
        ("PIP3_EXTENSION", "active"): -20.0,
    }
    uncounted = replace(seen, is_simulated=True), replace(seen, is_excluded=True)
    for one in (*uncounted, *(make_results(exercise, *ends) for exercise in ("FINGER_ABAD", "FREE_HAND"))):
        assert find_measured_values([one], seen.side, day) == {}
    assert find_measured_values([seen], seen.side, day + timedelta(days=1)) == {}
