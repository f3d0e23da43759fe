"""Two sessions beside each other: the mean repetition, playing in step, and what may be said of the difference."""

from __future__ import annotations

import math
from dataclasses import replace
from datetime import timedelta
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from carpus.core.measures.signals import LONGEST_GAP_S
from carpus.core.results.figures import SessionFigures
from carpus.core.results.motion_curves import mean_repetition, seen_angles
from carpus.core.results.ranges import finger_keys
from carpus.core.results.repetition_rows import RepetitionChoices, ShownRepetition
from carpus.core.results.side_by_side import Step, in_step, ordered, pair_reasons, partner_of, side_by_side
from tests.results.days import days_ago
from tests.ui.fakes import NOW, figures_once, session
from tests.ui.hand_fakes import hand_session

RATE_HZ = 30.0
lengths = st.lists(st.tuples(st.floats(0.0, 3.0), st.floats(0.4, 8.0)), max_size=6)


def repetitions(parts: list[tuple[float, float]], rest_s: float = 1.5) -> tuple[list[ShownRepetition], float]:
    """Repetitions with pauses before them, and how long the recording is."""
    at, out = 0.0, []
    for pause_s, length_s in parts:
        out.append(ShownRepetition(at + pause_s, at + pause_s + length_s, ""))
        at += pause_s + length_s
    return out, at + rest_s


# --- in step --------------------------------------------------------------------------------------------------
@given(lengths, lengths, st.sampled_from(["part", "start", "time"]))
def test_neither_recording_ever_goes_back_and_both_are_played_whole(
    mine: list[tuple[float, float]], other: list[tuple[float, float]], step: Step
) -> None:
    (first, first_s), (second, second_s) = repetitions(mine), repetitions(other, 2.5)
    together = in_step(first, second, (first_s, second_s), step)
    assert (np.diff(together.player_s) > 0.0).all()
    assert (np.diff(together.first_s) >= 0.0).all()
    assert (np.diff(together.second_s) >= 0.0).all()
    assert together.at(0.0) == (0.0, 0.0)
    assert together.at(together.end_s) == pytest.approx((first_s, second_s))
    assert len(together.starts_s) == (0 if step == "time" else min(len(first), len(second)))


@given(lengths, lengths, st.floats(0.0, 1.0))
def test_by_part_both_are_at_the_same_part_of_every_repetition(
    mine: list[tuple[float, float]], other: list[tuple[float, float]], share: float
) -> None:
    (first, first_s), (second, second_s) = repetitions(mine), repetitions(other)
    together = in_step(first, second, (first_s, second_s), "part")
    for start_s, a, b in zip(together.starts_s, first, second, strict=False):
        length_s = a.end_s - a.start_s
        at_first, at_second = together.at(start_s + share * length_s)  # the first runs at its own speed
        assert at_first == pytest.approx(a.start_s + share * length_s)
        assert at_second == pytest.approx(b.start_s + share * (b.end_s - b.start_s))


@given(lengths, lengths, st.floats(0.0, 1.0), st.sampled_from(["part", "start", "time"]))
def test_a_place_in_a_recording_is_found_again(
    mine: list[tuple[float, float]], other: list[tuple[float, float]], share: float, step: Step
) -> None:
    (first, first_s), (second, second_s) = repetitions(mine), repetitions(other)
    together = in_step(first, second, (first_s, second_s), step)
    assert together.at(together.when_first(share * first_s))[0] == pytest.approx(share * first_s, abs=1e-6)
    assert together.at(together.when_second(share * second_s))[1] == pytest.approx(share * second_s, abs=1e-6)


def test_by_start_both_run_at_their_own_speed_and_wait_for_the_next_start() -> None:
    first, first_s = repetitions([(1.0, 2.0), (0.0, 2.0)])
    second, second_s = repetitions([(2.0, 3.0), (0.5, 2.0)])
    together = in_step(first, second, (first_s, second_s), "start")
    assert together.starts_s == pytest.approx((2.0, 5.5))
    assert together.at(3.0) == pytest.approx((2.0, 3.0))
    assert together.at(5.0) == pytest.approx((3.0, 5.0)), "the first waits for its second start"
    assert together.at(6.0) == pytest.approx((3.5, 6.0))
    by_time = in_step(first, second, (first_s, second_s), "time")
    assert by_time.at(4.0) == (4.0, 4.0)
    assert by_time.at(9.0) == (first_s, second_s)


@pytest.mark.parametrize("step", ["part", "start", "time"])
def test_edges_that_a_person_moved_over_each_other_and_an_empty_recording_can_be_played(step: Step) -> None:
    crossed = [ShownRepetition(1.0, 4.0, ""), ShownRepetition(3.0, 5.0, "")]
    plain, plain_s = repetitions([(1.0, 2.0), (0.0, 2.0)])
    together = in_step(crossed, plain, (6.0, plain_s), step)
    assert (np.diff(together.first_s) >= 0.0).all()
    assert together.at(together.end_s) == pytest.approx((6.0, plain_s))
    nothing = in_step([], [], (0.0, 0.0), step)
    assert nothing.at(0.0) == nothing.at(nothing.end_s) == (0.0, 0.0)


# --- mean repetition ------------------------------------------------------------------------------------------
def swings(count: int = 6, period_s: float = 4.0) -> tuple[np.ndarray, np.ndarray, list[ShownRepetition]]:
    time_s = np.arange(0.0, count * period_s + 0.5 / RATE_HZ, 1.0 / RATE_HZ)
    found = [ShownRepetition(k * period_s, (k + 1) * period_s, "") for k in range(count)]
    return time_s, 40.0 * np.sin(2 * math.pi * time_s / period_s), found


@given(st.lists(st.floats(0.6, 6.0), min_size=3, max_size=6))
def test_repetitions_of_any_speed_have_one_mean(periods_s: list[float]) -> None:
    """The same movement faster and slower is one curve, without a spread."""
    edges = np.concatenate(([0.0], np.cumsum(periods_s)))
    time_s = np.arange(0.0, edges[-1] + 0.005, 0.01)
    part = np.interp(time_s, edges, np.arange(len(edges), dtype=float))
    found = [ShownRepetition(float(a), float(b), "") for a, b in pairwise(edges)]
    mean = mean_repetition(time_s, 40.0 * np.sin(2 * math.pi * part), found)
    assert mean.mean_deg == pytest.approx(40.0 * np.sin(2 * math.pi * mean.share), abs=1.5)
    assert mean.sd_deg[2:-2].max() < 0.2, "but for the joins, where the sampled curve turns a corner"


def test_what_is_left_out_is_not_in_the_mean() -> None:
    time_s, value, found = swings()
    inside = (time_s >= found[2].start_s) & (time_s <= found[2].end_s)
    wild = np.where(inside, 500.0, value)
    left_out = [*found[:2], replace(found[2], reason="pain"), *found[3:]]
    with_it, without = mean_repetition(time_s, wild, found), mean_repetition(time_s, wild, left_out)
    assert np.abs(with_it.mean_deg).max() > 80.0
    assert without.count == 5
    middle = slice(2, -2)  # the edges are shared with the neighbours
    assert without.mean_deg[middle] == pytest.approx(mean_repetition(time_s, value, found).mean_deg[middle], abs=0.1)
    hidden = [*found[:2], replace(found[2], unmeasured="hidden"), *found[3:]]
    np.testing.assert_array_equal(mean_repetition(time_s, wild, hidden).mean_deg, without.mean_deg)


def test_what_was_not_seen_is_a_gap_and_never_filled_in() -> None:
    time_s, value, found = swings()
    share = (time_s % 4.0) / 4.0
    unseen = np.where((share > 0.4) & (share < 0.6), np.nan, value)
    mean = mean_repetition(time_s, unseen, found)
    assert np.isnan(mean.mean_deg[43:58]).all()
    assert np.isfinite(mean.mean_deg[:40]).all()
    assert np.isfinite(mean.mean_deg[61:]).all()
    few = np.where((share > 0.4) & (share < 0.6) & (time_s > 8.0), np.nan, value)  # seen in two of six
    assert np.isnan(mean_repetition(time_s, few, found).mean_deg[43:58]).all()
    most = np.where((share > 0.4) & (share < 0.6) & (time_s > 16.0), np.nan, value)  # seen in four of six
    found_of_four = mean_repetition(time_s, most, found)
    assert np.isfinite(found_of_four.mean_deg).all()
    assert (found_of_four.seen[43:58] == 4).all()
    blink = np.where(np.abs(share - 0.5) < LONGEST_GAP_S / 4.0 / 2.5, np.nan, value)  # as long as a gap that is filled
    assert np.isfinite(mean_repetition(time_s, blink, found).mean_deg).all()


def test_two_repetitions_have_no_spread_and_none_no_mean() -> None:
    time_s, value, found = swings()
    two = mean_repetition(time_s, value, found[:2])
    assert two.known
    assert np.isnan(two.sd_deg).all()
    none = mean_repetition(time_s, value, [])
    assert (none.known, none.count) == (False, 0)
    assert not mean_repetition(np.empty(0), np.empty(0), found).known


# --- what is said ---------------------------------------------------------------------------------------------
@pytest.fixture(scope="module")
def figures() -> SessionFigures:
    return figures_once(session())


@pytest.fixture(scope="module")
def left() -> SessionFigures:
    return figures_once(session(NOW, 1.25, session_id="left", side="left"))


def test_a_session_beside_itself_shows_no_difference(figures: SessionFigures) -> None:
    both = side_by_side(figures, figures)
    assert both.fair
    assert both.ranges
    for one in both.ranges:
        assert one.comparison.difference_deg == 0.0
        assert one.comparison.verdict == "no_change"
        assert not one.beyond


def test_a_mirrored_hand_equals_the_other() -> None:
    right, left = session(), session(session_id="left", side="left")
    both = side_by_side(figures_once(right), figures_once(left))
    assert both.relation == "hands"
    assert both.fair
    for one in both.ranges:
        assert one.comparison.difference_deg == pytest.approx(0.0, abs=1.0)
    means = []
    for stored in (right, left):
        seen = seen_angles(stored)
        means.append(mean_repetition(seen.time_s, seen.of(("", 1)), figures_once(stored).repetitions))
    assert means[0].mean_deg == pytest.approx(means[1].mean_deg, abs=2.0)


def test_two_hands_differ_only_beyond_error_and_neither_way_round_matters(
    figures: SessionFigures, left: SessionFigures
) -> None:
    both, turned = side_by_side(figures, left), side_by_side(left, figures)
    arc = next(one for one in both.ranges if one.first.movement == "arc")
    assert both.main is arc
    assert arc.beyond
    assert arc.comparison.difference_deg < -arc.comparison.limit_deg
    for one, other in zip(both.ranges, turned.ranges, strict=True):
        assert one.comparison.difference_deg == pytest.approx(-other.comparison.difference_deg)
        assert one.beyond == other.beyond
        assert one.comparison.limit_deg == other.comparison.limit_deg


def test_an_unfair_pair_is_not_judged_and_says_why(figures: SessionFigures, left: SessionFigures) -> None:
    far = replace(left, quality=replace(left.quality, distance_m=0.95))
    both = side_by_side(figures, far)
    assert both.reasons == ("distance",)
    assert {one.comparison.verdict for one in both.ranges} == {"not_judged"}
    other = figures_once(session(exercise="WRIST_RU", motion="deviation", session_id="other"))
    assert "exercise" in side_by_side(figures, other).reasons
    apart = side_by_side(figures, other)
    assert apart.main is None, "they have no movement in common"
    assert len(apart.alone) == len(figures.rows) + len(other.rows), "what each has is shown all the same"
    few = figures_once(session(session_id="few"), RepetitionChoices(dict.fromkeys(range(7), "pain")))
    assert pair_reasons(figures, few) == pair_reasons(few, figures) == ("few_repetitions_after",)
    assert "angle_order" in pair_reasons(figures, replace(left, angle_order="isb"))


def test_the_affected_hand_and_the_newer_date_stand_first(figures: SessionFigures, left: SessionFigures) -> None:
    for pair in ((figures, left), (left, figures)):
        assert [one.side for one in ordered(*pair)] == ["right", "left"]
        assert [one.side for one in ordered(*pair, "left")] == ["left", "right"]
    older = replace(figures, when=NOW - timedelta(days=7), session_id="older")
    assert ordered(older, figures) == ordered(figures, older) == (figures, older)


def test_a_partner_is_the_other_hand_of_the_day_then_the_last_fair_session(
    figures: SessionFigures, left: SessionFigures
) -> None:
    older, oldest, before = days_ago(figures, 7), days_ago(figures, 30), days_ago(left, 20)
    far = replace(older, quality=replace(older.quality, distance_m=0.95))
    assert partner_of([figures, left, older], figures) == left
    assert partner_of([figures, before, older, oldest], figures) == older
    assert partner_of([figures, before, far, oldest], figures) == oldest, "the last that compares"
    assert partner_of([figures, before], figures) == before
    assert partner_of([figures, older], older) == figures
    assert partner_of([figures], figures) is None
    assert partner_of([figures, replace(older, not_counted=True)], figures) is None


def test_of_the_whole_hand_the_fingers_compare() -> None:
    stored, other = (
        hand_session(hides_beyond_deg=200.0),
        hand_session(share=0.6, session_id="left", side="left", hides_beyond_deg=200.0),
    )
    first, second = figures_once(other), figures_once(stored)
    both = side_by_side(first, second, finger_keys(0))
    assert [one.first.joint for one in both.ranges] == [f"TAM{k}" for k in (1, 2, 3, 4, 5)]
    assert both.main.beyond
    assert both.main.comparison.difference_deg < 0.0
    seen = seen_angles(stored)
    total = mean_repetition(seen.time_s, seen.of(("TAM3", -1)), second.repetitions)
    row = second.row("arc", -1, "TAM3")
    assert np.nanmax(total.mean_deg) == pytest.approx(row.mean_deg, abs=12.0)
    assert not seen.of(("no such joint", -1)).any() or np.isnan(seen.of(("no such joint", -1))).all()
    assert np.isnan(seen_angles(session()).of(("TAM3", -1))).all()


def test_a_hidden_end_of_either_hand_is_judged_only_where_it_is_sure() -> None:
    """A lower bound beyond error above a figure fully seen is a difference, whichever hand has it."""
    hidden = figures_once(hand_session(hides_beyond_deg=62.0))
    small = figures_once(hand_session(share=0.3, session_id="left", side="left", hides_beyond_deg=200.0))
    for pair in ((hidden, small), (small, hidden)):
        both = side_by_side(*pair, finger_keys(3))
        middle = next(one for one in both.ranges if one.first.joint == "PIP3_flexion")
        sides = {one.limited for one in (middle.first, middle.second)}
        assert sides == {True, False}
        assert middle.beyond
        assert (middle.comparison.difference_deg > 0.0) == (middle.comparison.verdict == "improved")
