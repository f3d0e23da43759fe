"""What the screens and pages say of their own figures: counted once, whose limits, whose sd, what lacks."""

from __future__ import annotations

import ast
import math
from dataclasses import replace
from datetime import timedelta
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QRectF
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from carpus.core.measures.change_limits import ErrorLimits, MeasuredLimit, RetestStudy
from carpus.core.measures.repetitions import NoRepetitionReason
from carpus.core.model import so3
from carpus.core.model.errors import SessionUnreadable, SettingsInvalid
from carpus.core.model.hand.exercises import get_exercise
from carpus.core.model.hand.protocols import WRIST6
from carpus.core.model.types import TrackedFrame
from carpus.core.records.library import Library
from carpus.core.records.limits_file import LIMITS_FILE, save_limits
from carpus.core.records.new_sessions import recover_sessions
from carpus.core.results.measure import summarise_values
from carpus.core.results.progress import compute_progress
from carpus.core.results.session_results import SessionResults
from carpus.core.results.valid_data import joint_curves, wrist_curves
from carpus.ui.charts.history import History
from carpus.ui.charts.progress import place_panels
from carpus.ui.charts.session import HandPlot
from carpus.ui.charts.style import screen_style
from carpus.ui.kit.background import Background
from carpus.ui.kit.cells import cell_text
from carpus.ui.kit.text import StateText, Text
from carpus.ui.kit.theme import Theme
from carpus.ui.report.builders import build_session_report
from carpus.ui.screens.patients.card import PatientCardView
from carpus.ui.screens.progress.screen import ProgressScreen
from carpus.ui.screens.report.screen import default_file_name
from carpus.ui.screens.settings.limits_card import limit_rows
from carpus.ui.screens.settings.screen import SettingsScreen
from carpus.ui.shell.view_models import PatientCard, Preferences
from carpus.ui.words.finger_angles import find_finger_angle, spread_labels
from carpus.ui.words.fingers import finger_table, limitation_words, main_angles, main_result_words
from carpus.ui.words.progress import value_pair
from carpus.ui.words.ranges import range_table, repetition_words
from carpus.ui.words.session import change_sentence, method_words, speed_pain_lines
from carpus.ui.words.verdicts import (
    change_since_first,
    difference_words,
    error_limit_words,
    verdict_word,
)
from tests.moments import with_moment
from tests.results.days import with_ranges
from tests.sources import SOURCES, modules, nodes
from tests.ui.fakes import NOW, FakeFeed, FakeSessions, FakeStore, figures_once, session
from tests.ui.hand_fakes import hand_session

BOX = QRectF(0.0, 0.0, 800.0, 500.0)
ONCE = "Only the newest result of a recording is analysed"


@pytest.mark.parametrize("of_hand", [False, True])
def test_method_where_no_angle_is_known_says_nothing_of_its_sd(of_hand: bool) -> None:
    made = hand_session(lost=[(0.0, 99.0)]) if of_hand else session(lost=[(0.0, 99.0)])
    figures = figures_once(made)
    assert math.isnan(figures.quality.angle_sd_deg)
    assert "known to about" not in method_words(figures, 6, compared=False)
    sure = replace(figures, quality=replace(figures.quality, angle_sd_deg=1.0))
    assert "known to about ±" in method_words(sure, 6, compared=False)


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
@pytest.mark.parametrize("earlier", [0, 1, 3])
def test_card_says_that_recording_counts_once_where_one_was_tracked_again(theme: Theme, earlier: int) -> None:
    row = replace(FakeStore().rows[5], session_count=6, result_count=6 + earlier)
    card = PatientCardView(theme, NOW.date)
    card.show_card(PatientCard(row, has_sessions=True), is_camera_ready=True)
    assert (ONCE in said(card)) is (earlier > 0)
    if earlier:
        assert str(earlier) in said(card).split(ONCE)[1]


class TrackedAgain(FakeSessions):
    """Sessions of which one recording has two earlier results."""

    def history(self, patient_id: str) -> list[SessionResults]:
        return [replace(f, earlier_results=2) if n == 1 else f for n, f in enumerate(super().history(patient_id))]


@pytest.mark.parametrize("kind", [FakeSessions, TrackedAgain])
def test_progress_and_report_say_it_too(
    theme: Theme, background: Background, qtbot: QtBot, kind: type[FakeSessions]
) -> None:
    store = kind()
    screen = ProgressScreen(theme, background, store)
    screen.load_patient("linden")
    qtbot.waitUntil(lambda: not background.is_busy)
    again = kind is TrackedAgain
    assert (ONCE in said(screen)) is again
    history = store.history("linden")
    key = history[1].session_id
    report = build_session_report(store.session(key), history=history)
    assert (ONCE in method_words(report.results, 6, compared=False)) is again


def test_while_sessions_are_read_nothing_of_the_patient_before_is_shown_or_can_be_made(
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


def test_earlier_results_that_were_read_are_counted_as_replaced() -> None:
    newest = figures_once(session())
    older = replace(newest, session_id="older", created=(newest.created or NOW) - timedelta(days=1))
    assert compute_progress([newest, older]).earlier_results == 1


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
def test_lamp_judges_forearm_by_point_that_wrist_turns_about(moved_mm: float) -> None:
    history, seen = History(WRIST6), []
    for frame in turning(FakeFeed(seconds=20.0).frames[:500], moved_mm):
        history.append([frame])
        seen.append(history.has_forearm_moved())
    discs_m = np.array([frame.kinematics.position_m for frame in turning(FakeFeed(seconds=20.0).frames[:420], 0.0)])
    assert np.linalg.norm(discs_m - discs_m[0], axis=1).max() > 0.015, "the disc itself leaves the ball"
    assert not any(seen[:420])
    assert all(seen[440:]) is (moved_mm > 0.0)


# --- what lacks -------------------------------------------------------------------------------------------
def test_side_that_was_not_reached_lacks_something_wherever_it_is_shown(theme: Theme) -> None:
    before = not_reaching((30.0, 60.0), when=NOW - timedelta(days=20), session_id="before")
    course = compute_progress([before, not_reaching((10.0, 60.0), session_id="after")])
    item = next(item for item in course.comparisons if item.after.quantity == "extension")
    assert item.verdict == "improved"
    assert value_pair(item).count("deficit") == 2
    panel = next(panel for panel, key in place_panels(course, screen_style(theme), BOX, 1) if key[1] == "extension")
    assert panel.scale.low < item.before.mean + 5.0
    card = PatientCardView(theme, NOW.date)
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


def test_error_that_all_changes_share_is_reported_once_and_else_with_each() -> None:
    made = figures_once(session())
    before = with_ranges(replace(made, session_id="before"), lambda row: {"mean": row.mean - 40.0})
    assert change_sentence(made, before, "then").count("(MDC ") == 3, "an arc has two ends"
    ends = replace(made, measures=tuple(row for row in made.measures if row.quantity != "arc"))
    said = change_sentence(ends, before, "then")
    assert said.endswith("(MDC 10°).")
    assert said.count("improved by 40°") == 2
    assert said.count("(MDC ") == 1


def test_error_limits_are_nobody_s_published_figures_and_those_of_arcs_are_larger(
    theme: Theme, background: Background, qtbot: QtBot
) -> None:
    words = error_limit_words()
    assert "expert default" in words
    assert "not a published value" in words
    assert "√2" in words
    assert words in method_words(figures_once(session()), 6, compared=True)
    screen = ProgressScreen(theme, background, FakeSessions())
    screen.load_patient("linden")
    qtbot.waitUntil(lambda: not background.is_busy)
    assert words in said(screen)
    assert words in said(SettingsScreen(theme, Preferences()))
    limits = dict(limit_rows())
    assert limits["Flexion, extension"] == "10°"
    assert limits["Flexion–extension, total arc"] == "14°"
    assert limits["Total active motion (TAM)"] == "22°"


def test_middle_finger_spreads_radially_and_ulnarly() -> None:
    assert [words for _, words in spread_labels(20.0, 3)] == ["Radial 20°", "0°", "Ulnar 20°"]
    assert spread_labels(20.0, 2)[0][1] == "Out 20°"
    made = hand_session()
    figures = figures_once(made)
    plot = HandPlot(wrist_curves(made), figures.exercise, (), joints=joint_curves(made), finger=3)
    assert "Radial 20°" in [text for _, text in plot.panels(BOX, 8.0)[1][0].scale.labels]


@pytest.mark.parametrize("exercise", ["THUMB_OPP", "FIST_HOOK"])
def test_report_shows_tam_for_fist_exercises_only(exercise: str) -> None:
    figures = figures_once(hand_session(exercise=exercise))
    assert "TAM" not in " ".join(map(cell_text, finger_table(figures, None).heads)) + limitation_words(
        figures
    ) + method_words(figures, 21, compared=True)


@pytest.mark.parametrize(
    ("uncounted", "words"),
    [
        ("nothing_seen", "the exercised joint was not visible"), ("too_short", "it is too short"),
        ("small_range", "less than 10° of movement"), ("no_return", "no complete movement cycle"),
        ("too_quick", "each was quicker than 0.4 s"),
    ],
)  # fmt: skip
def test_report_states_why_no_repetition_counted(uncounted: NoRepetitionReason, words: str) -> None:
    made = replace(figures_once(session()), repetitions=(), no_repetitions_reason=uncounted)
    assert repetition_words(made) == f"range over the whole recording; no repetitions: {words}"
    free = replace(figures_once(session(exercise="FREE")), no_repetitions_reason=None)
    assert repetition_words(free) == "range over the whole recording; no repetitions"


def test_report_states_occlusion_and_speed_below_noise() -> None:
    made = figures_once(session())
    assert repetition_words(replace(made, occluded_s=6.2)).endswith("6 s occluded and not analysed")
    assert "not visible" not in repetition_words(replace(made, occluded_s=0.0))
    lost = summarise_values("speed", made.main_angle, "peak speed", "deg/s", (math.nan,), unknown_reason="too_slow")
    slow = replace(made, measures=tuple(lost if row.key == lost.key else row for row in made.measures))
    assert next(row for row in range_table(slow, None, None).rows if row[0] == "Peak speed")[1] == ("too slow to judge")
    assert dict(speed_pain_lines(slow))["Peak speed, mean ± sd"] == "too slow to judge"
    assert "too slow" not in dict(speed_pain_lines(made))["Peak speed, mean ± sd"]


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


def test_list_s_value_is_of_joint_that_is_trained_and_says_at_least() -> None:
    figures = figures_once(hand_session())
    trained = find_finger_angle(figures.exercise.joint).finger
    rows = {figure.finger: figures.find(figure.joint, "arc") for figure in main_angles(figures)}
    row = rows[trained]
    words = main_result_words(figures)
    assert words.startswith(next(one.long_name for one in main_angles(figures) if one.finger == trained))
    assert ("≥" in words) == row.is_lower_bound
    assert get_exercise(figures.exercise.id).joint == figures.exercise.joint


def test_sessions_of_same_day_have_distinct_names() -> None:
    fist = build_session_report(hand_session())
    wrist = replace(fist, results=replace(fist.results, exercise=get_exercise("WRIST_FE")))
    later = replace(fist, results=replace(fist.results, when=fist.results.when + timedelta(hours=1)))
    assert len({default_file_name(one) for one in (fist, wrist, later)}) == 3


# --- the clinic's own error limits -----------------------------------------------------------------------
ARC = MeasuredLimit("flexion", "arc", 12, 2.4, (1.7, 3.9), 6.6, (4.7, 10.8))
STUDY = RetestStudy("wrist6", "WRIST_FE", "zyx", "2026-11-27", 12, 24, 2, (ARC, replace(ARC, movement="extension")))


def test_they_are_named_with_their_date_and_people(theme: Theme) -> None:
    words = error_limit_words(STUDY)
    assert "measured by this clinic on 27 Nov 2026 with 12 people" in words
    assert words in method_words(figures_once(session(), None, ErrorLimits((STUDY,))), 6, compared=True)
    few = replace(STUDY, limits=(replace(ARC, people=9),))
    assert error_limit_words() in method_words(figures_once(session(), None, ErrorLimits((few,))), 6, compared=True)
    shown = said(SettingsScreen(theme, Preferences(), ErrorLimits((STUDY,))))
    for piece in (
        "On 27 Nov 2026 with 12 people in 24 sessions",
        "Used in progress and reports",
        "SEM 2.4°",
        "7° (4.7° – 10.8°)",
        "Extension",
    ):
        assert piece in shown
    assert "Not used: at least 10 people" in said(SettingsScreen(theme, Preferences(), ErrorLimits((few,))))
    assert "Measured by this clinic" not in said(SettingsScreen(theme, Preferences()))


@pytest.mark.parametrize("text", ["", "{}", None])
def test_window_reads_them_from_data_folder_and_tells_damaged_file(tmp_path: Path, text: str | None) -> None:
    if text is None:
        save_limits(tmp_path, [STUDY])
    else:
        (tmp_path / LIMITS_FILE).write_text(text, encoding="utf-8")
    library = Library(tmp_path)
    if text is None:
        assert library.error_limits.study("wrist6", "WRIST_FE", "zyx") == STUDY
    else:
        assert library.error_limits == ErrorLimits(), "the default limits hold"
        assert [type(fault) for fault in recover_sessions(library)[1]] == [SettingsInvalid]
    library.close()
