"""Two sessions beside each other: playing in step, and what may be said of the difference."""

from __future__ import annotations

from dataclasses import replace
from datetime import timedelta

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from carpus.core.results.motion_curves import visible_angle_deg
from carpus.core.results.ranges import progress_keys
from carpus.core.results.repetition_rows import RepetitionChoices, RepetitionResult
from carpus.core.results.session_results import SessionResults
from carpus.core.results.side_by_side import (
    align_playback,
    compare_pair,
    find_partner,
    order_pair,
    pair_incomparable_reasons,
)
from tests.results.days import days_ago, repetition
from tests.ui.fakes import NOW, figures_once, session
from tests.ui.hand_fakes import hand_session

lengths = st.lists(st.tuples(st.floats(0.0, 3.0), st.floats(0.4, 8.0)), max_size=6)


def repetitions(parts: list[tuple[float, float]], rest_s: float = 1.5) -> tuple[list[RepetitionResult], float]:
    """Repetitions with pauses before them, and how long the recording is."""
    at, out = 0.0, []
    for pause_s, length_s in parts:
        out.append(repetition(at + pause_s, at + pause_s + length_s))
        at += pause_s + length_s
    return out, at + rest_s


# --- in step --------------------------------------------------------------------------------------------------
@given(lengths, lengths)
def test_align_playback_never_goes_back(mine: list[tuple[float, float]], other: list[tuple[float, float]]) -> None:
    (first, first_s), (second, second_s) = repetitions(mine), repetitions(other, 2.5)
    together = align_playback(first, second, (first_s, second_s))
    assert (np.diff(together.player_s) > 0.0).all()
    assert (np.diff(together.first_s) >= 0.0).all()
    assert (np.diff(together.second_s) >= 0.0).all()
    assert together.recording_times(0.0) == (0.0, 0.0)
    assert together.recording_times(together.end_s) == pytest.approx((first_s, second_s))
    assert len(together.starts_s) == min(len(first), len(second))


@given(lengths, lengths, st.floats(0.0, 1.0))
def test_align_playback_same_part_of_repetitions(
    mine: list[tuple[float, float]], other: list[tuple[float, float]], share: float
) -> None:
    (first, first_s), (second, second_s) = repetitions(mine), repetitions(other)
    together = align_playback(first, second, (first_s, second_s))
    for start_s, a, b in zip(together.starts_s, first, second, strict=False):
        length_s = a.end_s - a.start_s
        at_first, at_second = together.recording_times(start_s + share * length_s)  # the first runs at its own speed
        assert at_first == pytest.approx(a.start_s + share * length_s)
        assert at_second == pytest.approx(b.start_s + share * (b.end_s - b.start_s))


def test_align_playback_crossed_edges_and_empty_recording() -> None:
    crossed = [repetition(1.0, 4.0), repetition(3.0, 5.0)]
    plain, plain_s = repetitions([(1.0, 2.0), (0.0, 2.0)])
    together = align_playback(crossed, plain, (6.0, plain_s))
    assert (np.diff(together.first_s) >= 0.0).all()
    assert together.recording_times(together.end_s) == pytest.approx((6.0, plain_s))
    nothing = align_playback([], [], (0.0, 0.0))
    assert nothing.recording_times(0.0) == nothing.recording_times(nothing.end_s) == (0.0, 0.0)


# --- what is said ---------------------------------------------------------------------------------------------
@pytest.fixture(scope="module")
def figures() -> SessionResults:
    return figures_once(session())


@pytest.fixture(scope="module")
def left() -> SessionResults:
    return figures_once(session(NOW, 1.25, session_id="left", side="left"))


def test_compare_pair_mirrored_hand_is_equal() -> None:
    right, left = session(), session(session_id="left", side="left")
    both = compare_pair(figures_once(right), figures_once(left))
    assert both.relation == "hands"
    assert both.is_comparable
    for one in both.ranges:
        assert one.difference_deg == pytest.approx(0.0, abs=1.0)
        assert one.verdict == "no_change"


def test_compare_pair_hands_differ_beyond_error_either_way(figures: SessionResults, left: SessionResults) -> None:
    both, turned = compare_pair(figures, left), compare_pair(left, figures)
    arc = next(one for one in both.ranges if one.after.quantity == "arc")
    assert both.main_comparison is arc
    assert arc.is_beyond_error
    assert arc.difference_deg < -arc.limit_deg
    for one, other in zip(both.ranges, turned.ranges, strict=True):
        assert one.difference_deg == pytest.approx(-other.difference_deg)
        assert one.is_beyond_error == other.is_beyond_error
        assert one.limit_deg == other.limit_deg


def test_compare_pair_incomparable_states_reason(figures: SessionResults, left: SessionResults) -> None:
    far = replace(left, quality=replace(left.quality, distance_m=0.95))
    both = compare_pair(figures, far)
    assert both.reasons == ("distance",)
    assert {one.verdict for one in both.ranges} == {"not_judged"}
    other = figures_once(session(exercise="WRIST_RU", motion="deviation", session_id="other"))
    assert "exercise" in compare_pair(figures, other).reasons
    apart = compare_pair(figures, other)
    assert apart.main_comparison is None, "they have no movement in common"
    few = figures_once(session(session_id="few"), RepetitionChoices(dict.fromkeys(range(7), "pain")))
    assert (
        pair_incomparable_reasons(figures, few) == pair_incomparable_reasons(few, figures) == ("few_repetitions_after",)
    )
    assert "angle_order" in pair_incomparable_reasons(figures, replace(left, angle_order="isb"))


def test_order_pair_affected_hand_or_newer_first(figures: SessionResults, left: SessionResults) -> None:
    for pair in ((figures, left), (left, figures)):
        assert [one.side for one in order_pair(*pair)] == ["right", "left"]
        assert [one.side for one in order_pair(*pair, "left")] == ["left", "right"]
    older = replace(figures, when=NOW - timedelta(days=7), session_id="older")
    assert order_pair(older, figures) == order_pair(figures, older) == (figures, older)


def test_find_partner_prefers_other_hand_of_day(figures: SessionResults, left: SessionResults) -> None:
    older, oldest, before = days_ago(figures, 7), days_ago(figures, 30), days_ago(left, 20)
    far = replace(older, quality=replace(older.quality, distance_m=0.95))
    assert find_partner([figures, left, older], figures) == left
    assert find_partner([figures, before, older, oldest], figures) == older
    assert find_partner([figures, before, far, oldest], figures) == oldest, "the last that compares"
    assert find_partner([figures, before], figures) == before
    assert find_partner([figures, older], older) == figures
    assert find_partner([figures], figures) is None
    assert find_partner([figures, replace(older, is_excluded=True)], figures) is None


def test_compare_pair_fingers() -> None:
    stored, other = (
        hand_session(hides_beyond_deg=200.0),
        hand_session(share=0.6, session_id="left", side="left", hides_beyond_deg=200.0),
    )
    first, second = figures_once(other), figures_once(stored)
    both = compare_pair(first, second, progress_keys("tam"))
    assert [one.after.subject for one in both.ranges] == [f"TAM{k}" for k in (1, 2, 3, 4, 5)]
    assert both.main_comparison.is_beyond_error
    assert both.main_comparison.difference_deg < 0.0
    assert np.nanmax(visible_angle_deg(stored, "TAM3")) == pytest.approx(second.find("TAM3", "arc").best, abs=12.0)
    assert np.isnan(visible_angle_deg(stored, "no such joint")).all()
    assert np.isnan(visible_angle_deg(session(), "TAM3")).all()


def test_compare_pair_hidden_end_judged_only_if_certain() -> None:
    """A lower bound beyond error above a figure fully seen is a difference, whichever hand has it."""
    hidden = figures_once(hand_session(hides_beyond_deg=62.0))
    small = figures_once(hand_session(share=0.3, session_id="left", side="left", hides_beyond_deg=200.0))
    for pair in ((hidden, small), (small, hidden)):
        both = compare_pair(*pair, progress_keys("3"))
        middle = next(one for one in both.ranges if one.after.subject == "PIP3_flexion")
        sides = {one.is_lower_bound for one in (middle.before, middle.after)}
        assert sides == {True, False}
        assert middle.is_beyond_error
        assert (middle.difference_deg > 0.0) == (middle.verdict == "improved")
