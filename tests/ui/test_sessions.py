"""The list of sessions by hand: what is shown, opened, set aside, moved, renamed, deleted."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QFontMetricsF
from pytestqt.qtbot import QtBot

from carpus.ui.kit.background import Background
from carpus.ui.kit.fonts import MEDIUM, font
from carpus.ui.kit.theme import Theme
from carpus.ui.screens.sessions import session_list
from carpus.ui.screens.sessions.screen import SessionsScreen
from carpus.ui.screens.sessions.session_list import row_cells
from tests.ui.conftest import Show
from tests.ui.fake_stored_sessions import FakeStoredSessions


@pytest.fixture
def sessions() -> FakeStoredSessions:
    return FakeStoredSessions()


@pytest.fixture
def screen(
    qtbot: QtBot, theme: Theme, show: Show[SessionsScreen], background: Background, sessions: FakeStoredSessions
) -> SessionsScreen:
    screen = show(SessionsScreen(theme, background, sessions))
    screen.show_patient("linden", "Linden 42", "s1")
    qtbot.waitUntil(lambda: all(line.main_value or line.is_damaged for line in screen.list.session_model.lines))
    return screen


def chosen(screen: SessionsScreen) -> str:
    line = screen.current_line()
    return line.entry.session_id


def test_session_list_enter_or_double_click_opens_a_session(qtbot: QtBot, screen: SessionsScreen) -> None:
    opened: list[str] = []
    screen.open_requested.connect(opened.append)
    assert chosen(screen) == "s1"
    assert "Flexion 54°" in screen.value_text.text()
    screen.list.setFocus()
    qtbot.keyClick(screen.list, Qt.Key.Key_Down)
    qtbot.keyClick(screen.list, Qt.Key.Key_Return)
    assert opened == ["s2"]
    screen.list.setCurrentIndex(screen.list.session_model.index(4))
    assert not screen.open_button.isEnabled()
    qtbot.keyClick(screen.list, Qt.Key.Key_Return)
    assert opened == ["s2"], "a damaged file is not opened"


def test_session_list_session_is_excluded_with_a_reason_and_included_again(
    qtbot: QtBot, screen: SessionsScreen, sessions: FakeStoredSessions
) -> None:
    screen.exclude_button.click()
    screen.exclude_dialog.reason_field.setText("splint on")
    qtbot.keyClick(screen.exclude_dialog.reason_field, Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: sessions.done == [("aside", "s1", "splint on")])
    qtbot.waitUntil(lambda: "splint on" in screen.remark_text.text())
    assert row_cells(screen.list.session_model.lines[1])[4] == "excluded: splint on"
    assert chosen(screen) == "s1"
    screen.exclude_button.click()
    qtbot.waitUntil(lambda: sessions.done[-1] == ("aside", "s1", ""))


def test_session_list_session_is_renamed_moved_and_deleted(
    qtbot: QtBot, screen: SessionsScreen, sessions: FakeStoredSessions
) -> None:
    wanted: list[str] = []
    screen.delete_requested.connect(wanted.append)
    screen.delete_button.click()
    screen.list.setFocus()
    qtbot.keyClick(screen.list, Qt.Key.Key_Delete)
    assert wanted == ["s1", "s1"], "it is asked for by button and key"
    screen.rename_button.click()
    offered = {
        screen.exercise_dialog.choice_field.itemData(row) for row in range(screen.exercise_dialog.choice_field.count())
    }
    assert "WRIST_RU" in offered
    assert not offered & {"WRIST_FE", "FIST_COMPOSITE"}, "only exercises with the same discs"
    screen.exercise_dialog.choice_field.setCurrentIndex(screen.exercise_dialog.choice_field.findData("WRIST_RU"))
    screen.exercise_dialog.accept_button.click()
    qtbot.waitUntil(lambda: sessions.done == [("rename", "s1", "WRIST_RU")])
    screen.move_button.click()
    screen.move_dialog.choice_field.setCurrentIndex(1)
    screen.move_dialog.accept_button.click()
    qtbot.waitUntil(lambda: sessions.done[-1] == ("move", "s1", "alder"))
    qtbot.waitUntil(lambda: screen.list.session_model.find_row("s1") < 0)


def test_session_list_without_sessions_says_so(
    theme: Theme, show: Show[SessionsScreen], background: Background
) -> None:
    screen = show(SessionsScreen(theme, background, FakeStoredSessions(0)))
    screen.show_patient("fir", "Fir 12")
    assert screen.empty_text.isVisible()
    assert not screen.open_button.isVisible()


def test_session_list_small_window_shows_date_and_remark_uncut(theme: Theme, qtbot: QtBot) -> None:
    rooms = session_list._cell_boxes(QRectF(0, 0, 846, session_list.ROW_PX), theme, has_remark=True)
    metrics = QFontMetricsF(font(14, MEDIUM))
    for number, text in ((0, "Wed 28 Sep 08:48"), (3, "10 / 10"), (4, "excluded: simulated")):
        assert metrics.elidedText(text, Qt.TextElideMode.ElideRight, rooms[number].width()) == text


def test_session_list_narrow_value_is_elided_in_its_name_only(theme: Theme) -> None:
    metrics = QFontMetricsF(font(16, MEDIUM))
    shown = session_list.elide_value("Supination −50° ± 1°", metrics, metrics.horizontalAdvance("Supination −50°"))
    assert shown.startswith("Sup")
    assert shown.endswith("… −50° ± 1°")
    assert metrics.horizontalAdvance(shown) <= metrics.horizontalAdvance("Supination −50°")
