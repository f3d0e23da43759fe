"""Report and progress of the whole hand, read back from the PDF; the table of the sessions as CSV."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from carpus.core.results.measure import wrist_angle_index
from carpus.core.results.progress import compare_ranges, compute_progress
from carpus.core.results.ranges import progress_keys
from carpus.core.results.session_results import SessionResults
from carpus.ui.charts.progress import axis_top_deg, panel_keys
from carpus.ui.kit import numbers
from carpus.ui.kit.table import Cell, cell_text
from carpus.ui.report.session_page import build_session_report
from carpus.ui.words.finger_angles import FingerAngle, format_spread
from carpus.ui.words.fingers import finger_table, progress_choices, range_cell
from carpus.ui.words.progress import headline
from carpus.ui.words.session import hand_summary
from carpus.ui.words.terms import LEGAL_SENTENCE
from tests.results.days import with_ranges
from tests.ui.fakes import figures_once
from tests.ui.hand_fakes import FakeHandSessions, hand_session, without_hidden
from tests.ui.printed import count_pages, overlapping_words, read_words, write_session_report


@pytest.fixture(scope="module")
def store() -> FakeHandSessions:
    return FakeHandSessions(pictures=False)


def plain(text: str) -> str:
    return " ".join(text.replace(numbers.NARROW_GAP, " ").split())


def test_report_hand_page_has_fingers_totals_and_visibility(store: FakeHandSessions, tmp_path: Path) -> None:
    path = write_session_report(store.session("hand-7"), tmp_path / "h.pdf", history=store.history("x"))
    assert count_pages(path) == 2
    words = plain(read_words(path))
    figures = figures_once(store.session("hand-7"))
    for row in finger_table(figures, None).rows:
        for cell in row:
            assert plain(cell_text(cell)) in words
            assert isinstance(cell, str) or plain(cell.subtext) in words
    assert overlapping_words(path) == []
    for head in ("MCP", "PIP", "DIP", "TAM", "Flexion–extension", "Partly occluded", "DIP not measured"):
        assert head in words
    assert LEGAL_SENTENCE in words


@pytest.mark.parametrize("code", ["de", "it"])
def test_report_hand_table_cells_do_not_overlap(store: FakeHandSessions, tmp_path: Path, code: str) -> None:
    first = figures_once(store.session("hand-3"))
    made = build_session_report(store.session("hand-7"), history=store.history("x"), language=code)
    report = replace(made, motion=None, previous=first, other_hand=first)
    assert overlapping_words(write_session_report(report, tmp_path / "x.pdf")) == []


def test_hand_that_was_seen_all_time_is_judged_joint_by_joint() -> None:
    first, last = (figures_once(without_hidden(hand_session(share=share))) for share in (0.6, 1.0))
    compared = compare_ranges(first, last, [row for row in last.joint_ranges if row.subject == "MCP3_flexion"])
    arc = next(item for item in compared if item.after.quantity == "arc")
    assert (arc.verdict, arc.is_lower_bound) == ("improved", False)
    assert arc.limit_deg == pytest.approx(12.0 * 2**0.5)


def shown_of(figures: SessionResults, kind: str = "") -> list[str]:
    """The panels of the course of one session, of what is followed or else comes first."""
    kind = kind or progress_choices(figures)[0][0]
    return [key[0] for key in panel_keys(compute_progress([figures], None, progress_keys(kind)))]


def test_progress_follows_totals_first_and_one_finger_on_request_and_of_the_thumb_lift_and_spread(
    store: FakeHandSessions,
) -> None:
    history = store.history("x")
    last = history[-1]
    assert [value for value, _ in progress_choices(last)] == ["tam", "spread", "1", "2", "3", "4", "5", ""]
    assert shown_of(last) == ["TAM1", "TAM2", "TAM3", "TAM4", "TAM5"]
    assert "TAM" in headline(compute_progress(history, None, progress_keys("tam")))[0]
    assert shown_of(last, "4") == ["TAM4", "MCP4_flexion", "PIP4_flexion"]
    assert all(row.mean <= axis_top_deg((row.subject, "arc")) for row in last.joint_ranges if row.count)
    wrist = compute_progress(history, None, progress_keys(""))
    assert all(wrist_angle_index(of) >= 0 for of, _ in panel_keys(wrist))
    thumb = figures_once(hand_session(exercise="THUMB_OPP", motion="thumb"))
    assert shown_of(thumb) == ["CMC1_abduction", "CMC1_extension", "MCP1_flexion", "IP1_flexion"]


def test_report_hand_occlusion_is_measured_within_repetitions() -> None:
    made = hand_session(hidden=[(0.0, 99.0, "TIP5")])
    figures = figures_once(made)
    time_s = made.timestamp_s - made.timestamp_s[0]
    inside = np.zeros(len(time_s), dtype=bool)
    for rep in figures.repetitions:
        inside |= (time_s >= rep.start_s) & (time_s <= rep.end_s)
    assert 0.3 < inside.mean() < 1.0
    hidden = ~np.isfinite(made.markers.measured_px[..., 0])
    assert figures.quality.hidden_share == pytest.approx(hidden[inside].mean())
    assert figures.quality.hidden_share != pytest.approx(hidden.mean(), rel=1e-3)


def test_lower_bound_has_no_spread_and_headline_and_table_say_what_was_not_seen() -> None:
    figures = figures_once(hand_session())
    rows = [[cell_text(cell) for cell in row[1:6]] for row in finger_table(figures, None).rows]
    bounds = [words for row in rows for words in row if "≥" in words]
    assert bounds
    assert not any("±" in words for words in bounds)
    thumb, *fingers = rows
    assert [words.split()[0] for words in thumb[:3]] == ["MCP", "Palm.", "IP"], "no finger's joint"
    assert not any(words.startswith(("MCP", "Palm.", "IP")) for row in fingers for words in row)
    assert "of this movement was occluded" in hand_summary(figures, None, None)
    assert "was occluded" not in hand_summary(figures_once(hand_session(hides_beyond_deg=999.0)), None, None)


def test_hand_never_tracked_gives_honest_page(tmp_path: Path) -> None:
    path = write_session_report(hand_session(lost=[(0.0, 99.0)]), tmp_path / "h.pdf")
    words = plain(read_words(path))
    assert "index not visible" in words
    assert "0.0 % of" in words


def test_angle_beyond_straight_has_its_sign_and_spreading_its_side() -> None:
    figures = figures_once(hand_session())
    low = ("PIP3_flexion", "extension")
    beyond = with_ranges(figures, lambda row: {"mean": -3.2} if row.key == low else {})
    cell = range_cell(beyond, FingerAngle(3, "middle"))
    assert isinstance(cell, Cell)
    assert cell.subtext.startswith("−3° to ")
    spread = range_cell(figures, FingerAngle(4, "spread"))
    assert isinstance(spread, Cell)
    assert re.fullmatch(r"\d+°( add.| abd.)? to \d+°( add.| abd.)?", spread.subtext)
    assert format_spread(-2.0) == "2° add."
    assert format_spread(0.4) == "0°"
