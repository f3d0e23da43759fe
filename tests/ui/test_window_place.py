"""The window comes up whole on the screen, at first and where it was last time."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QRect
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from carpus.ui.shell.recent_locations import TITLE_BAR_PX, encode_geometry, fit_on_screen, restore_window

ROOM = QRect(0, 0, 1280, 800)


@pytest.mark.parametrize(
    ("place", "whole"),
    [
        (QRect(0, 0, 1280, 800), False), (QRect(-300, 700, 1100, 700), True), (QRect(5000, 5000, 1024, 700), True),
        (QRect(100, 60, 1024, 700), True), (QRect(0, 0, 3000, 2000), False),
    ],
)  # fmt: skip
def test_window_position_stays_on_screen(place: QRect, whole: bool) -> None:
    fits, kept_size = fit_on_screen(place, ROOM)
    assert ROOM.adjusted(0, TITLE_BAR_PX, 0, 0).contains(fits)
    assert kept_size == whole


def test_window_remembers_its_place(qtbot: QtBot) -> None:
    first, second = QWidget(), QWidget()
    for window in (first, second):
        qtbot.addWidget(window)
    first.setGeometry(40, 60, 500, 400)
    restore_window(second, encode_geometry(first))
    assert second.size() == first.size()
    restore_window(second, "not a place")
    assert second.size() == first.size()
