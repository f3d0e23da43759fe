"""Active and passive range in one session: apart in every figure, beside each other in the table and on the page."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from carpus.core.formats.measures_table import build_measure_rows
from carpus.core.results.repetition_rows import ACTIVE, PASSIVE, RepetitionChoices
from carpus.core.results.session_results import SessionResults
from carpus.core.session.values import Event, Session
from carpus.ui.report.session_page import build_session_report
from carpus.ui.words.active_passive import MANUAL_SIGN, build_active_passive
from carpus.ui.words.ranges import repetition_words
from tests.results.days import with_ranges
from tests.ui.fakes import figures_once, hand_values_today, session
from tests.ui.hand_fakes import FakeHandSessions
from tests.ui.printed import page_words

HELPED_S = 35.0


@cache
def helped_session(*events: tuple[float, str]) -> Session:
    """Of nine repetitions the first ones go six tenths as far as those after :data:`HELPED_S`."""
    made = session()
    share = np.where(made.timestamp_s - made.timestamp_s[0] < HELPED_S, 0.6, 1.0)
    motion = replace(made.motion, angles_rad=made.motion.angles_rad * share[:, None])
    start_s = float(made.timestamp_s[0])
    said = tuple(Event(start_s + time_s, kind, "") for time_s, kind in events)
    return replace(made, motion=motion, events=said)


def mean_of(figures: SessionResults | None) -> float:
    return figures.find("flexion", "flexion").mean


def test_passive_repetitions_never_count_as_active() -> None:
    figures = figures_once(helped_session((HELPED_S, PASSIVE)))
    helped = [number for number, one in enumerate(figures.repetitions) if one.is_passive]
    assert figures.repetition_count >= 3
    assert figures.passive_results().repetition_count == len(helped) >= 3
    assert figures.repetition_count + len(helped) == len(
        [one for one in figures.repetitions if not one.unmeasured_reason]
    )
    assert mean_of(figures) < 0.75 * mean_of(figures.passive_results())
    left_out = RepetitionChoices(dict.fromkeys(helped, "pain"))
    assert mean_of(figures) == mean_of(figures_once(helped_session(), left_out)), "as if it had been left out"
    rows = {row.of for row in build_measure_rows(figures, "s")}
    assert {"flexion", "flexion, passive"} <= rows


@pytest.mark.parametrize("exercise", ["FREE", "REACH_GRASP"])
def test_passive_range_without_repetitions_is_unknown(exercise: str) -> None:
    def free(*events: tuple[float, str]) -> SessionResults:
        made = helped_session(*events)
        return figures_once(replace(made, header=replace(made.header, exercise=exercise)))

    assert free((HELPED_S, PASSIVE)).find("flexion", "flexion").best < 0.75 * free().find("flexion", "flexion").best
    assert not free((0.0, PASSIVE)).wrist_ranges, "nothing was active"
    assert repetition_words(free((HELPED_S, PASSIVE))).endswith("passive repetitions excluded")
    assert "passive" not in repetition_words(free())


def test_fist_measures_exclude_passive_repetitions() -> None:
    made = FakeHandSessions().session("hand-7")
    assert figures_once(made).measures_in_group("task")
    helped = replace(made, events=(Event(float(made.timestamp_s[0]), PASSIVE, ""),))
    everything = figures_once(helped)
    assert everything.has_passive
    assert not everything.measures_in_group("task"), "nothing was active"
    assert figures_once(
        helped, RepetitionChoices(dict.fromkeys(range(len(everything.repetitions)), ""))
    ).measures_in_group("task")


def test_person_has_last_word_and_active_again_ends_stretch() -> None:
    made = helped_session((HELPED_S, PASSIVE))
    helped = [number for number, one in enumerate(figures_once(made).repetitions) if one.is_passive]
    taken_back = figures_once(made, RepetitionChoices({helped[0]: ""}))
    assert taken_back.repetitions[helped[0]].is_counted
    assert not figures_once(helped_session((0.0, PASSIVE), (0.5, ACTIVE))).has_passive
    everything = figures_once(helped_session((0.0, PASSIVE)))
    assert everything.repetition_count == 0
    assert not everything.wrist_ranges, "nothing was active"
    assert everything.has_passive
    assert build_active_passive(everything, ()) is not None


def test_table_lower_bound_shows_the_manual_value() -> None:
    figures = figures_once(FakeHandSessions().session("hand-7"))
    found = build_active_passive(figures, hand_values_today())
    ring = next(row for row in found.table.rows if row[0] == "Ring")
    assert f"{MANUAL_SIGN} 70° / 90°" in ring
    assert any(cell.startswith("≥") for row in found.table.rows for cell in row)
    assert not any(head.endswith("passive") for head in found.table.heads), "nothing was passive: no column of it"


def test_report_prints_both_and_what_was_measured_manually() -> None:
    words = page_words(build_session_report(helped_session((HELPED_S, PASSIVE)), manual_values=hand_values_today()))
    assert "Active and passive" in words
    assert f"{MANUAL_SIGN} 48° / 60°" in words
    assert "passive" in words


def test_passive_range_below_active_is_reported_with_sign() -> None:
    found = build_active_passive(figures_once(helped_session((0.0, PASSIVE), (HELPED_S, ACTIVE))), ())
    arc = next(row for row in found.table.rows if row[0] == "Total arc")
    assert arc[3].startswith("\N{MINUS SIGN}")
    assert "MDC" in arc[3]
    figures = figures_once(helped_session((HELPED_S, PASSIVE)))
    made = with_ranges(figures, lambda row: {"mean": -12.0} if row.quantity == "flexion" and not row.is_passive else {})
    assert "active \N{MINUS SIGN}12°" in build_active_passive(made, ()).sentence, "it does not reach neutral"
