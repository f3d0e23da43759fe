"""Erasing asks twice: the pseudonym is typed, Enter never erases, the archive is what Enter takes."""

from __future__ import annotations

from dataclasses import replace
from datetime import date

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from carpus.ui.records.erasing import EraseSheet
from carpus.ui.theme import Theme
from tests.ui.gallery import ERASED_SESSION


@pytest.fixture
def sheet(qtbot: QtBot, theme: Theme) -> EraseSheet:
    host = QWidget()
    qtbot.addWidget(host)
    host.resize(1280, 744)
    host.show()
    sheet = EraseSheet(host, theme)
    sheet.host = host  # type: ignore[attr-defined]
    sheet.done = []  # type: ignore[attr-defined]
    sheet.erase.connect(lambda: sheet.done.append("erase"))  # type: ignore[attr-defined]
    sheet.archive.connect(lambda: sheet.done.append("archive"))  # type: ignore[attr-defined]
    sheet.begin(ERASED_SESSION)
    return sheet


def done(sheet: EraseSheet) -> list[str]:
    return sheet.done  # type: ignore[attr-defined, no-any-return]


def test_enter_archives(qtbot: QtBot, sheet: EraseSheet) -> None:
    qtbot.keyClick(sheet.instead, Qt.Key.Key_Return)
    assert done(sheet) == ["archive"]
    assert not sheet.isVisible()


def test_the_name_typed_as_asked_presses_nothing(qtbot: QtBot, sheet: EraseSheet) -> None:
    """Keys go to whatever has the keyboard, as a person's do: the space of the name is a letter."""
    for letter in "Linden 42":
        focused = sheet.window().focusWidget()
        assert focused is sheet.line
        qtbot.keyClicks(focused, letter)
    assert done(sheet) == []
    assert sheet.isVisible()
    assert sheet.for_good.isEnabled()
    qtbot.keyClick(sheet.line, Qt.Key.Key_Return)
    assert done(sheet) == ["archive"], "Enter is what the button that bears it says"


def test_only_the_pseudonym_lets_it_be_erased_and_never_enter(qtbot: QtBot, sheet: EraseSheet) -> None:
    assert not sheet.for_good.isEnabled()
    qtbot.keyClicks(sheet.line, "Linden 4")
    assert not sheet.for_good.isEnabled()
    qtbot.keyClicks(sheet.line, "2")
    assert sheet.for_good.isEnabled()
    sheet.for_good.setFocus()
    qtbot.keyClick(sheet.for_good, Qt.Key.Key_Return)
    assert done(sheet) == []
    sheet.for_good.click()
    assert done(sheet) == ["erase"]
    sheet.begin(ERASED_SESSION)
    assert not sheet.for_good.isEnabled(), "the next one is asked anew"


def test_esc_does_nothing(qtbot: QtBot, sheet: EraseSheet) -> None:
    qtbot.keyClick(sheet.instead, Qt.Key.Key_Escape)
    assert not sheet.isVisible()
    assert done(sheet) == []


def test_it_says_what_goes_what_stays_and_what_comes_too_early(sheet: EraseSheet) -> None:
    assert "4 files, 38 MB" in sheet.goes.text()
    assert "delete them yourself (1): /home/clinic/Reports/L.pdf" in sheet.stays.text()
    assert "The other 8 sessions." in sheet.stays.text()
    assert "15 Nov" in sheet.stays.text()
    assert "before that day" in sheet.ends.text()
    sheet.begin(replace(ERASED_SESSION, kept_until=date(2026, 11, 19), made=tuple(map(str, range(5)))))
    assert "before that day" not in sheet.ends.text()
    assert "(5): 0, 1, 2, …" in sheet.stays.text()
    sheet.begin(replace(ERASED_SESSION, when=None, kept_until=None, sessions=9, files=31))
    assert "9 sessions" in sheet.goes.text()
    sheet.begin(replace(ERASED_SESSION, when=None, kept_until=None, sessions=1, files=31))
    assert "1 session with" in sheet.goes.text()
    sheet.begin(replace(ERASED_SESSION, when=None, kept_until=None, sessions=9, files=31))
    assert "real name" in sheet.goes.text()
    assert sheet.ends.text() == "Nobody can bring it back."
