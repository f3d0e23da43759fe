"""Review and progress: cursor, repetitions, corrections that are stored, and the course over sessions."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from pytestqt.qtbot import QtBot

from carpus.ui.charts.progress import panel_keys
from carpus.ui.charts.zoom_chart import render_image
from carpus.ui.kit.background import Background
from carpus.ui.kit.theme import Theme
from carpus.ui.screens.progress.screen import ProgressScreen
from carpus.ui.screens.review.screen import ReviewScreen
from carpus.ui.words.ranges import repetition_words
from tests.ui.conftest import Reviewing, Show
from tests.ui.fakes import FakeSessions
from tests.ui.test_plots import drag


@pytest.fixture
def store() -> FakeSessions:
    return FakeSessions()


@pytest.fixture
def screen(review: Reviewing, store: FakeSessions) -> ReviewScreen:
    return review(store, "session-7")


def test_keys_and_mouse_go_to_pictures_and_repetitions(qtbot: QtBot, screen: ReviewScreen) -> None:
    playing = screen.playing
    playing.set_time(10.0)
    before = playing.time_s
    qtbot.keyClick(screen, Qt.Key.Key_Right)
    assert playing.time_s - before == pytest.approx(1 / 30, abs=0.02)
    qtbot.keyClick(screen, Qt.Key.Key_Left)
    assert playing.time_s == pytest.approx(before, abs=0.02)
    playing.set_time(5.0)
    qtbot.keyClick(screen, Qt.Key.Key_Space)
    qtbot.waitUntil(lambda: playing.time_s > 5.1)
    qtbot.keyClick(screen, Qt.Key.Key_Space)
    stopped = playing.time_s
    qtbot.waitUntil(lambda: not screen.frame_view.reader.is_busy)
    assert playing.time_s == stopped
    panel = screen.charts.curves.plots[1].visible_panel
    spot = QPoint(round(float(panel.x(40.0))), round(panel.box.center().y()))
    qtbot.mouseClick(screen.charts.curves.mouse_target, Qt.MouseButton.LeftButton, pos=spot)
    assert playing.time_s == pytest.approx(40.0, abs=0.2)
    screen.select_repetition(0)
    for _ in range(2):
        qtbot.keyClick(screen, Qt.Key.Key_BracketRight)
    assert screen.current == 2
    assert playing.time_s == pytest.approx(screen.results.repetitions[2].start_s)
    qtbot.keyClick(screen, Qt.Key.Key_BracketLeft)
    assert screen.current == 1


def test_review_unreadable_session_is_reported(qtbot: QtBot, screen: ReviewScreen, store: FakeSessions) -> None:
    gone = store.sessions.pop("session-6")
    with qtbot.waitSignal(screen.fault_raised) as told:
        screen.load_session("linden", "session-6")
    assert isinstance(told.args[0], KeyError)
    assert screen.frame_view.empty_text == "This session cannot be read. Go back, or choose another one."
    assert not screen.is_loaded
    store.sessions["session-6"] = gone
    screen.load_session("linden", "session-6")
    qtbot.waitUntil(lambda: screen.is_loaded and screen.frame_view.image is not None)


def test_review_repetition_is_excluded_and_included(qtbot: QtBot, screen: ReviewScreen, store: FakeSessions) -> None:
    screen.select_repetition(3)
    qtbot.keyClick(screen, Qt.Key.Key_X)
    assert screen.exclusion_dialog.isVisible()
    screen.exclusion_dialog.reason_buttons[0].click()
    qtbot.waitUntil(lambda: "session-7" in store.kept)
    assert store.kept["session-7"].excluded == {3: "pain"}
    assert "repetition 4 excluded: pain" in screen.card.count_text.text()
    assert "mean of 8 repetitions" in screen.card.count_text.text()
    screen.select_repetition(3)
    qtbot.keyClick(screen, Qt.Key.Key_X)
    qtbot.waitUntil(lambda: not store.kept["session-7"].excluded)
    assert "mean of 9 repetitions" in screen.card.count_text.text()
    screen.select_repetition(7)
    qtbot.mouseClick(screen.player.repetition_button, Qt.MouseButton.LeftButton)
    assert screen.exclusion_dialog.isVisible()
    qtbot.mouseClick(screen.exclusion_dialog.passive_onwards_button, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: bool(store.kept["session-7"].excluded))
    assert set(store.kept["session-7"].excluded.items()) >= {(7, "passive"), (8, "passive")}
    assert screen.card.count_text.text().startswith("mean of 7 repetitions; plus 2 passive")
    assert screen.card.tables.passive_table.isVisible()
    assert [row[0].text for row in screen.card.tables.passive_table.rows] == ["Total arc", "Flexion", "Extension"]
    screen.select_repetition(7)
    qtbot.keyClick(screen, Qt.Key.Key_X)
    qtbot.waitUntil(lambda: store.kept["session-7"].excluded[7] == "")
    assert screen.results.repetitions[7].is_counted


def test_edges_of_repetition_are_moved_by_keys_and_dragged_by_mouse(
    qtbot: QtBot, screen: ReviewScreen, store: FakeSessions
) -> None:
    screen.select_repetition(2)
    before = screen.results.repetitions[2]
    qtbot.keyClick(screen, Qt.Key.Key_Period)  # the nearer edge
    after = screen.results.repetitions[2]
    assert after.start_s == pytest.approx(before.start_s + 0.1)
    assert after.end_s == before.end_s
    qtbot.waitUntil(lambda: "session-7" in store.kept)
    panel = screen.charts.curves.plots[0].visible_panel
    start = QPoint(round(float(panel.x(after.end_s))), round(panel.box.center().y()))
    drag(qtbot, screen.charts.curves.mouse_target, QPointF(start), -12)
    assert screen.results.repetitions[2].end_s < after.end_s - 0.5
    assert screen.results.repetitions[2].start_s == after.start_s
    assert "start or end set manually: repetition 3" in repetition_words(screen.results)
    qtbot.keyClick(screen, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert screen.results.repetitions[2].end_s == after.end_s
    qtbot.keyClick(screen, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert screen.results.repetitions[2] == before
    assert "manually" not in repetition_words(screen.results)
    qtbot.waitUntil(lambda: not store.kept["session-7"].edges_s)
    beside = QPointF(float(panel.x(before.end_s)), panel.box.bottom() - 2.0)  # the line, but not its handle
    drag(qtbot, screen.charts.curves.mouse_target, beside, -12)
    assert screen.results.repetitions[2] == before


def test_progress_answers_with_the_arc_and_rings_what_is_unfair(
    qtbot: QtBot, theme: Theme, show: Show[ProgressScreen], store: FakeSessions, background: Background
) -> None:
    screen = show(ProgressScreen(theme, background, store))
    screen.load_patient("linden", "session-7")
    qtbot.waitUntil(lambda: len(screen.progress.points) == 7)
    assert screen.answer_text.text().startswith("The total arc has improved by")
    assert [point.is_comparable for point in screen.progress.points].count(False) == 1
    assert panel_keys(screen.progress)[0][1] == "arc"
    assert screen.exercise_choice.count() == 2
    with qtbot.waitSignal(screen.report_requested) as asked:
        screen.report_button.click()
    assert len(asked.args[0]) == 7
    assert not render_image(screen.chart).isNull()
    screen.exercise_choice.setCurrentIndex(1 - screen.exercise_choice.currentIndex())
    assert screen.answer_text.text() == "At least two sessions are needed to show progress."
    assert screen._side.isHidden(), "nothing would stand beside the curves"


def test_review_hides_previous_session_while_loading(qtbot: QtBot, screen: ReviewScreen) -> None:
    """It may be another patient's."""
    card, places = screen.card, (screen.card.tables.geometry(), screen.card.report_button.geometry())
    shown = (card.title, card.count_text, card.tables)
    acts = (card.include_button, card.export_button, card.report_button, card.compare_button)
    assert all(widget.isVisible() for widget in shown)
    screen.toggle_excluded()
    assert screen.exclusion_dialog.isVisible()
    screen.load_session("linden", "session-6", whole_hand=False)
    assert screen.reviewed is None
    assert not screen.exclusion_dialog.isVisible()
    assert not any(widget.isVisible() for widget in shown)
    assert not any(button.isEnabled() for button in acts)
    assert "00:00" in screen.player.time.text()
    assert (card.tables.geometry(), card.report_button.geometry()) == places, "nothing jumps"
    qtbot.waitUntil(lambda: screen.is_loaded)
    assert all(widget.isVisible() for widget in shown)
    assert all(button.isEnabled() for button in acts[:3])


def test_session_can_be_set_aside_and_taken_back(qtbot: QtBot, screen: ReviewScreen, store: FakeSessions) -> None:
    qtbot.mouseClick(screen.card.include_button, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: "session-7" in store.kept and store.kept["session-7"].is_session_excluded)
    assert screen.results.is_excluded
    assert screen.card.include_button.text() == "Include again"
    screen.toggle_excluded()
    screen._exclude_repetition(screen.current + 1, "pain", and_after=False)
    assert screen.results.is_excluded, "other corrections leave it"
    qtbot.mouseClick(screen.card.include_button, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: not store.kept["session-7"].is_session_excluded)
    assert not screen.results.is_excluded
    assert screen.results.repetitions[screen.current].exclusion_reason == "pain"
