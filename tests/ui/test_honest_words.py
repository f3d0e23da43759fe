"""What the screens and pages say of their own figures: counted once, whose limits, whose sd, what lacks."""

from __future__ import annotations

import ast
import math
from dataclasses import replace
from datetime import timedelta
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from carpus.core.measures.change_limits import ErrorLimits, MeasuredLimit, RetestStudy
from carpus.core.measures.repetitions import NoRepetitionReason
from carpus.core.model import so3
from carpus.core.model.errors import SessionUnreadable, SettingsInvalid
from carpus.core.model.hand.exercises import get_exercise
from carpus.core.model.hand.protocols import WRIST6
from carpus.core.model.types import TrackedFrame
from carpus.core.records.clinic_records import LIMITS_FILE, save_limits
from carpus.core.records.data_folder import DataFolder
from carpus.core.records.new_sessions import recover_sessions
from carpus.core.results.progress import compute_progress
from carpus.core.results.session_results import SessionResults
from carpus.ui.charts.history import History
from carpus.ui.charts.progress import panel_scale
from carpus.ui.kit.background import Background
from carpus.ui.kit.text import StateText, Text
from carpus.ui.kit.theme import Theme
from carpus.ui.screens.patients.card import PatientCardView
from carpus.ui.screens.patients.patient_store import PatientCard
from carpus.ui.screens.progress.screen import ProgressScreen
from carpus.ui.shell.current_selection import NameDisplay
from carpus.ui.words.finger_angles import find_finger_angle
from carpus.ui.words.fingers import main_angles, main_result_words
from carpus.ui.words.progress import change_since_first, difference_words, value_pair, verdict_word
from carpus.ui.words.ranges import repetition_words
from carpus.ui.words.session import method_words
from tests.moments import with_moment
from tests.results.days import with_ranges
from tests.sources import SOURCES, modules, nodes
from tests.ui.fakes import NOW, FakeFeed, FakeSessions, FakeStore, figures_once, session
from tests.ui.hand_fakes import hand_session


def said(widget: QWidget) -> str:
    """All words of a widget."""
    return " ".join(text.text() for kind in (Text, StateText) for text in widget.findChildren(kind))


def not_reaching(figures_deg: tuple[float, float] = (20.0, 60.0), **header: object) -> SessionResults:
    """A wrist that bends between two angles of flexion and never comes back to neutral."""
    made = session(**header)  # type: ignore[arg-type]
    angles = made.motion.angles_rad.copy()
    low, high = np.nanpercentile(angles[:, 1], (2, 98))
    span = figures_deg[1] - figures_deg[0]
    angles[:, 1] = np.radians(figures_deg[0] + (angles[:, 1] - low) / (high - low) * span)
    return figures_once(replace(made, motion=replace(made.motion, angles_rad=angles)))


# --- a recording counts once ------------------------------------------------------------------------------


def test_progress_while_reading_hides_the_previous_patient(
    theme: Theme, background: Background, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    store = FakeSessions()
    screen = ProgressScreen(theme, background, store)
    acts = (screen.report_button, screen.picture_button, screen.table_button)
    screen.load_patient("linden")
    qtbot.waitUntil(lambda: not background.is_busy)
    assert screen.progress.points
    assert all(button.isEnabled() for button in acts)

    screen.load_patient("linden")
    screen.load_patient("nobody")  # asked for before the answer to the first
    shown: list[int] = []
    monkeypatch.setattr(screen.chart, "show_progress", lambda course: shown.append(len(course.points)))
    screen._background.run(lambda: None, lambda _: None, lambda _: None)
    qtbot.waitUntil(lambda: not background.is_busy)
    assert len(shown) == 1, "the answer to the first is of another patient by now"
    monkeypatch.undo()
    screen.load_patient("linden")
    qtbot.waitUntil(lambda: not background.is_busy)

    def gone(_: str) -> list[SessionResults]:
        raise SessionUnreadable("session-1", "")

    monkeypatch.setattr(store, "history", gone)
    screen.load_patient("birch")
    assert screen.answer_text.text() == "Reading the sessions…"
    for read in (False, True):
        if read:
            qtbot.waitUntil(lambda: not background.is_busy)
        assert not screen.progress.points
        assert not any(button.isEnabled() for button in acts)
    assert screen.answer_text.text() == "The sessions cannot be read."


# --- the forearm ------------------------------------------------------------------------------------------
def turning(frames: list[TrackedFrame], moved_mm: float) -> list[TrackedFrame]:
    """The disc goes round a centre 15 mm beneath it, 70 degrees to both sides; the forearm moves at the end."""
    centre_m = np.array([0.0, 0.0, -0.015])
    out = []
    for k, frame in enumerate(frames):
        rotation = so3.exp(np.array([0.0, math.radians(70.0) * math.sin(2.0 * math.pi * max(k - 30, 0) / 120.0), 0.0]))
        forearm_m = np.array([0.0, 1e-3 * moved_mm if k > 420 else 0.0, 0.0])
        place = centre_m - rotation @ centre_m + forearm_m
        out.append(with_moment(frame, position_m=place, rotation_w2_w0=rotation, w0_turn_rad=np.zeros(3)))
    return out


@pytest.mark.parametrize("moved_mm", [0.0, 22.0])
def test_forearm_lamp_uses_the_wrist_centre(moved_mm: float) -> None:
    history, seen = History(WRIST6), []
    for frame in turning(FakeFeed(seconds=20.0).frames[:500], moved_mm):
        history.append([frame])
        seen.append(history.has_forearm_moved())
    discs_m = np.array([frame.kinematics.position_m for frame in turning(FakeFeed(seconds=20.0).frames[:420], 0.0)])
    assert np.linalg.norm(discs_m - discs_m[0], axis=1).max() > 0.015, "the disc itself leaves the ball"
    assert not any(seen[:420])
    assert all(seen[440:]) is (moved_mm > 0.0)


# --- what lacks -------------------------------------------------------------------------------------------
def test_unreached_side_is_a_deficit_everywhere(theme: Theme) -> None:
    before = not_reaching((30.0, 60.0), when=NOW - timedelta(days=20), session_id="before")
    course = compute_progress([before, not_reaching((10.0, 60.0), session_id="after")])
    item = next(item for item in course.comparisons if item.after.quantity == "extension")
    assert item.verdict == "improved"
    assert value_pair(item).count("deficit") == 2
    assert panel_scale(course, item.after.key).low < item.before.mean + 5.0
    card = PatientCardView(theme, NOW.date, NameDisplay())
    row = replace(item.after, mean=-20.0)
    card.show_card(PatientCard(FakeStore().rows[5], ((row, None),), has_sessions=True), is_camera_ready=True)
    assert "1° deficit" in said(card)


# --- whose figures ----------------------------------------------------------------------------------------
def test_footnote_names_sd_that_is_printed() -> None:
    many = figures_once(session())
    assert "SD between repetitions." in method_words(many, 6, compared=False)
    assert "SD of the estimate" not in method_words(many, 6, compared=False)
    single = with_ranges(many, lambda row: {"sd": math.nan, "values": row.values[:1]})
    assert "SD of the estimate" in method_words(single, 6, compared=False)
    assert "SD between repetitions." not in method_words(single, 6, compared=False)
    mixed = with_ranges(many, lambda row: {} if row.quantity == "arc" else {"sd": math.nan, "values": row.values[:1]})
    assert "with fewer than 3: SD of the estimate" in method_words(mixed, 6, compared=False)


@pytest.mark.parametrize(
    ("uncounted", "words"),
    [
        ("nothing_seen", "the exercised joint was not visible"), ("too_short", "too short"),
        ("small_range", "less than 10° of movement"), ("no_return", "no complete movement cycle"),
        ("too_quick", "each movement was shorter than 0.4 s"),
    ],
)  # fmt: skip
def test_report_states_why_no_repetition_counted(uncounted: NoRepetitionReason, words: str) -> None:
    made = replace(figures_once(session()), repetitions=(), no_repetitions_reason=uncounted)
    assert repetition_words(made) == f"range over the whole recording; no repetitions: {words}"
    free = replace(figures_once(session(exercise="FREE")), no_repetitions_reason=None)
    assert repetition_words(free) == "range over the whole recording; no repetitions"


# --- what is not beyond the error ------------------------------------------------------------------------
@SOURCES
def test_change_text_never_claims_no_change() -> None:
    assert verdict_word("no_change") == change_since_first("no_change", 2.0) == "no change beyond MDC"
    assert difference_words(0.2) == "0°"
    said = []
    for path in modules("ui", "app", "core"):
        for node in nodes(path):
            if isinstance(node, ast.Call) and getattr(node.func, "attr", getattr(node.func, "id", "")) in ("tr",):
                said += [one.value for one in node.args if isinstance(one, ast.Constant)]
    claims = [words for words in said if isinstance(words, str) and "no change " in words.casefold()]
    assert claims
    assert all("no change beyond m" in words.casefold() for words in claims), claims


def test_session_list_value_is_of_the_trained_joint() -> None:
    figures = figures_once(hand_session())
    trained = find_finger_angle(figures.exercise.joint).finger
    rows = {figure.finger: figures.find(figure.joint, "arc") for figure in main_angles(figures)}
    row = rows[trained]
    words = main_result_words(figures)
    assert words.startswith(next(one.long_name for one in main_angles(figures) if one.finger == trained))
    assert ("≥" in words) == row.is_lower_bound
    assert get_exercise(figures.exercise.id).joint == figures.exercise.joint


# --- the clinic's own error limits -----------------------------------------------------------------------
ARC = MeasuredLimit("flexion", "arc", 12, 2.4, (1.7, 3.9), 6.6, (4.7, 10.8))
STUDY = RetestStudy("wrist6", "WRIST_FE", "zyx", "2026-11-27", 12, 24, 2, (ARC, replace(ARC, movement="extension")))


@pytest.mark.parametrize("text", ["", "{}", None])
def test_window_reads_them_from_data_folder_and_tells_damaged_file(tmp_path: Path, text: str | None) -> None:
    if text is None:
        save_limits(tmp_path, [STUDY])
    else:
        (tmp_path / LIMITS_FILE).write_text(text, encoding="utf-8")
    library = DataFolder(tmp_path)
    if text is None:
        assert library.error_limits.study("wrist6", "WRIST_FE", "zyx") == STUDY
    else:
        assert library.error_limits == ErrorLimits(), "the default limits hold"
        assert [type(fault) for fault in recover_sessions(library)[1]] == [SettingsInvalid]
    library.close()
