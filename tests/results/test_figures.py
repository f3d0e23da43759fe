"""What is said of a session, against plain arithmetic on the angles it was made from."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from datetime import timedelta
from typing import Any

import numpy as np
import pytest

from carpus.core.calibration.result import CalibrationFinding
from carpus.core.model.hand.exercises import get_exercise
from carpus.core.results.norms import total_norm, wrist_norm
from carpus.core.results.progress import (
    compare_ranges,
    compute_progress,
    find_other_hand,
    find_previous,
    incomparable_reasons,
)
from carpus.core.results.repetition_rows import RepetitionChoices
from carpus.core.results.session_results import SessionResults, compute_data_digest, compute_session_results
from carpus.core.session.values import Event
from carpus.ui.words.task_measures import measure_name, value_words
from tests.results.days import days_ago, with_ranges
from tests.ui.fakes import NOW, figures_once, session


@pytest.fixture(scope="module")
def figures() -> SessionResults:
    return figures_once(session())


def test_range_means_are_of_extremes_of_each_repetition(figures: SessionResults) -> None:
    stored = session()
    angle = np.degrees(stored.motion.angles_rad[:, 1])
    time = stored.timestamp_s - stored.timestamp_s[0]
    inside = [(time >= rep.start_s) & (time <= rep.end_s) for rep in figures.repetitions]
    tops, bottoms = [angle[part].max() for part in inside], [angle[part].min() for part in inside]
    flexion, extension, arc = (figures.find("flexion", name) for name in ("flexion", "extension", "arc"))  # type: ignore[arg-type]
    # A repetition begins where the hand leaves its turning place: the extreme itself may lie just before.
    assert flexion.mean == pytest.approx(np.mean(tops), abs=0.5)
    assert extension.mean == pytest.approx(-np.mean(bottoms), abs=0.3)
    assert arc.mean == pytest.approx(flexion.mean + extension.mean, abs=1e-9)
    assert flexion.sd == pytest.approx(np.std(tops, ddof=1), abs=0.3)
    assert flexion.count == figures.repetition_count == 9


def test_range_excluded_repetition_leaves_mean(figures: SessionResults) -> None:
    arc = figures.find("flexion", "arc")
    without = figures_once(session(), RepetitionChoices({6: "pain"}))
    assert without.repetition_count == 8
    assert without.repetitions[6].exclusion_reason == "pain"
    assert without.find("flexion", "arc").mean == pytest.approx((sum(arc.values) - arc.values[6]) / 8)
    nothing = figures_once(session(), RepetitionChoices(dict.fromkeys(range(9), "trial")))
    assert nothing.wrist_ranges == ()
    assert nothing.speed_measure("peak speed") is None


def test_range_moved_edge_changes_that_repetition_only(figures: SessionResults) -> None:
    rep = figures.repetitions[3]
    middle = 0.5 * (rep.start_s + rep.end_s)
    moved = figures_once(session(), RepetitionChoices({}, {3: (rep.start_s, middle - 1.5)}))
    before, after = figures.find("flexion", "arc"), moved.find("flexion", "arc")
    assert after.values[3] < before.values[3] - 10
    assert after.values[:3] == pytest.approx(before.values[:3])


def test_range_hidden_repetition_does_not_count(figures: SessionResults) -> None:
    names = ("CMC1", "MCP2", "MCP3", "MCP4")
    rep = figures.repetitions[2]
    covered = session(hidden=[(rep.start_s, rep.end_s, name) for name in names])
    seen = figures_once(covered)
    assert any(r.unmeasured_reason == "hidden" for r in seen.repetitions) or len(seen.repetitions) < len(
        figures.repetitions
    )
    assert seen.quality.measured_share < 0.95
    assert seen.quality.hidden_share == pytest.approx(4 / 6 * (1 - seen.quality.measured_share), abs=0.01)


def test_free_movement_has_every_angle_and_is_never_compared() -> None:
    free = figures_once(session(exercise="FREE", motion="mixed"))
    assert [row.wrist_angle for row in free.wrist_ranges if row.quantity == "arc"] == [1, 0, 2]
    assert {item.verdict for item in compare_ranges(free, replace(free, when=NOW + timedelta(days=1)))} == {
        "not_judged"
    }


@pytest.mark.parametrize("difference_deg", [9.9, 10.1, -10.1, 40.0])
def test_compare_ranges_change_only_beyond_limit(figures: SessionResults, difference_deg: float) -> None:
    before = replace(figures, when=NOW - timedelta(days=7))
    after = with_ranges(figures, lambda row: {"mean": row.mean + difference_deg})
    verdicts = {item.after.quantity: item.verdict for item in compare_ranges(before, after)}
    sign = "improved" if difference_deg > 0 else "worse"
    assert verdicts["flexion"] == ("no_change" if abs(difference_deg) <= 10 else sign)
    assert verdicts["arc"] == ("no_change" if abs(difference_deg) <= 10 * math.sqrt(2) else sign)


@pytest.mark.parametrize(
    ("changes", "reason"),
    [
        ({"side": "left"}, "side"),
        ({"protocol": "hand21"}, "protocol"),
        ({"exercise": get_exercise("WRIST_RU")}, "exercise"),
        ({"repetitions": ()}, "few_repetitions_after"),
        ({"measures": "unknown"}, "unknown"),
    ],
)
def test_compare_ranges_unlike_sessions_are_not_judged(
    figures: SessionResults, changes: dict[str, Any], reason: str
) -> None:
    other = days_ago(with_ranges(figures, lambda row: {"mean": row.mean + 30}), -1)
    if "measures" in changes:
        changes = {"measures": with_ranges(figures, lambda _: {"mean": math.nan}).measures}
    found = compare_ranges(figures, replace(other, **changes))
    assert found
    assert all(reason in item.reasons and item.verdict == "not_judged" for item in found)


@pytest.mark.parametrize(
    ("farther_m", "turned_deg", "reasons"),
    [(0.099, 4.9, ()), (-0.101, 0.0, ("distance",)), (0.0, 5.1, ("start_angle",)), (0.0, -5.1, ("start_angle",))],
)
def test_incomparable_reasons_beyond_distance_or_start_angle(
    figures: SessionResults, farther_m: float, turned_deg: float, reasons: tuple[str, ...]
) -> None:
    quality = replace(figures.quality, distance_m=figures.quality.distance_m + farther_m)
    other = replace(figures, quality=quality, start_angles_deg=figures.start_angles_deg + np.array([0, turned_deg, 0]))
    assert incomparable_reasons(figures, other) == reasons


@pytest.mark.parametrize("reason", ["forearm_moved", "doubtful", "not_counted", "simulated", "distance"])
@pytest.mark.parametrize("which", ["before", "after"])
def test_compare_ranges_excluded_session_is_not_judged(figures: SessionResults, reason: str, which: str) -> None:
    quality = figures.quality
    unfair = {
        "forearm_moved": {"quality": replace(quality, forearm_movement_mm=25.0)},
        "doubtful": {"findings": (CalibrationFinding("swapped", ("MCP2", "MCP3")),)},
        "not_counted": {"is_excluded": True},
        "simulated": {"is_simulated": True},
        "distance": {"quality": replace(quality, distance_m=quality.distance_m + 0.2)},
    }[reason]
    before, after = figures, days_ago(with_ranges(figures, lambda row: {"mean": row.mean + 30}), -1)
    assert {item.verdict for item in compare_ranges(before, after)} == {"improved"}
    headline = compute_progress([before, after]).main_comparison
    assert (headline.after.quantity, headline.verdict) == ("arc", "improved"), "the answer is about the arc first"
    spoilt = (replace(before, **unfair), after) if which == "before" else (before, replace(after, **unfair))
    changes = compare_ranges(*spoilt)
    assert {item.verdict for item in changes} == {"not_judged"}
    assert all(reason in item.reasons for item in changes)
    assert not compute_progress(spoilt).comparisons


def test_incomparable_reasons_harmless_finding_is_none(figures: SessionResults) -> None:
    near = replace(figures, findings=(CalibrationFinding("distance", (), 0.5, 0.6, "m"),))
    assert incomparable_reasons(figures, near) == ()


def test_progress_simulated_compare_with_simulated_only(figures: SessionResults) -> None:
    sessions = [days_ago(figures, day, is_simulated=True) for day in (9, 6, 3, 0)]
    assert all(point.is_comparable for point in compute_progress(sessions).points)
    sessions[2] = replace(sessions[2], is_simulated=False)
    course = compute_progress(sessions)
    assert [point.is_comparable for point in course.points] == [False, False, True, False]
    assert course.reference is sessions[2]
    assert find_previous(sessions, sessions[3]) is sessions[1]


def test_session_results_keep_source_targets_and_findings() -> None:
    stored, doubted = session(seconds=26.0), CalibrationFinding("tilt", (), 22.0, 15.0, "deg")
    parameters = json.dumps({"source": {"simulated": "yes"}, "set_up": {"targets_deg": [40.0, None]}})
    verdict = replace(stored.calibration.verdict, findings=(doubted,))
    found, plain = (
        figures_once(one)
        for one in (
            replace(
                stored,
                header=replace(stored.header, parameters=parameters),
                calibration=replace(stored.calibration, verdict=verdict),
            ),
            stored,
        )
    )
    assert (found.is_simulated, found.findings) == (True, (doubted,))
    assert found.targets_deg == pytest.approx((40.0, np.nan), nan_ok=True)
    assert not plain.is_simulated
    assert np.isnan(plain.targets_deg).all()


def test_find_previous_and_other_hand_return_last_included(figures: SessionResults) -> None:
    history = [days_ago(figures, days) for days in (9, 5, -1)]
    history += [days_ago(figures, days, side="left") for days in (3, 2)] + [figures]
    assert (find_previous(history, figures).session_id, find_other_hand(history, figures).session_id) == ("5", "2")
    assert find_previous([history[0], replace(history[1], is_excluded=True)], figures) is history[0]
    first = history[4]
    again = replace(first, session_id="again", created=figures.created + timedelta(days=1))
    assert find_other_hand([first, again], figures) is find_other_hand([again, first], figures) is again


def test_session_results_pain_and_notes_from_events() -> None:
    start = float(session().timestamp_s[0])
    stored = session(
        events=(Event(start + 1, "pain", "2"), Event(start + 5, "note", "rest"), Event(start + 9, "pain", "4"))
    )
    figures = figures_once(stored)
    assert figures.pain_scores == (2, 4)
    assert figures.pain_times_s == pytest.approx((1.0, 9.0))
    assert figures.notes == ((pytest.approx(5.0), "rest"),)


def test_norms_cover_and_name_their_source() -> None:
    fist, wrist = get_exercise("FIST_COMPOSITE"), get_exercise("WRIST_FE")
    assert wrist_norm("flexion", 1, get_exercise("FREE")) is None
    assert total_norm(3, get_exercise("FIST_HOOK")) is None, "the source speaks of a fist"
    for norm in (wrist_norm("flexion", 1, wrist), total_norm(3, fist)):
        assert all(said in norm.sentence() for said in (norm.source, "adults", "women and men"))


def test_data_digest_differs_between_measurements() -> None:
    assert compute_data_digest(session()) == compute_data_digest(session())
    assert compute_data_digest(session()) != compute_data_digest(session(scale=0.999))


def test_display_difference_agrees_with_rounded_means(figures: SessionResults) -> None:
    for step in np.linspace(-20, 20, 17):
        after = with_ranges(figures, lambda row, step=float(step): {"mean": row.mean + step})  # type: ignore[misc]
        for item in compare_ranges(figures, after):
            assert item.display_difference_deg == math.floor(item.after.mean + 0.5) - math.floor(item.before.mean + 0.5)


def test_speed_measures_best_is_quickest_and_smoothest() -> None:
    figures = figures_once(session())
    speed = {row.quantity: row for row in figures.measures_in_group("speed")}
    assert speed["movement time"].count >= 3
    assert speed["movement time"].best < speed["movement time"].mean
    assert speed["mean speed"].best > speed["mean speed"].mean
    assert speed["movement units"].best == 1.0
    assert speed["smoothness"].best >= speed["smoothness"].mean
    assert math.isnan(speed["time to peak"].best), "neither way is better"


def test_session_results_low_frame_rate_are_complete() -> None:
    stored = session(seconds=26.0)
    few = replace(stored, timestamp_s=stored.timestamp_s[0] + np.arange(len(stored)) / 1.5, repetitions=())
    found = compute_session_results(few)
    assert {row.quantity for row in found.wrist_ranges} >= {"flexion", "extension", "arc"}
    assert found.quality.frames == len(stored)
    assert not [one.quantity for one in found.measures_in_group("task") if one.unknown_reason == "failed"]


@pytest.mark.parametrize(
    "broken", ["task_measures.measure_tremor", "session_results.measure_still_angles", "session_results.assess_quality"]
)
def test_session_results_failing_measure_leaves_others(
    broken: str, figures: SessionResults, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object) -> None:
        raise ZeroDivisionError

    monkeypatch.setattr(f"carpus.core.results.{broken}", fail)
    found = compute_session_results(session())
    assert repr(found.wrist_ranges) == repr(figures.wrist_ranges), "by repr: a NaN equals no NaN"
    assert repr(found.measures_in_group("speed")) == repr(figures.measures_in_group("speed"))
    (missing,) = (one for one in found.measures_in_group("task") if one.unknown_reason == "failed")
    assert value_words(missing) == "not available: the calculation failed"
    assert measure_name(missing)[0].isupper()
