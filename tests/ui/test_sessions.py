"""The list of sessions by hand: what is shown, opened, set aside, moved, renamed, deleted."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot

from carpus.ui.kit.background import Background
from carpus.ui.kit.theme import Theme
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
