"""Rings lie on the corners of the picture that they were found in, however fast the board moves and new ones come."""

from __future__ import annotations

from dataclasses import replace

import pytest
from PySide6.QtWidgets import QPushButton, QVBoxLayout, QWidget
from pytestqt.qtbot import QtBot

from carpus.core.types import ByteImage
from carpus.ui.camera_calibration.showing import RINGS_LAST_S, BoardShowing
from carpus.ui.keys import Keys
from carpus.ui.theme import Theme
from tests.ui.camera_fakes import board_progress


def test_rings_are_drawn_on_their_own_picture_or_not_at_all(qtbot: QtBot, monkeypatch: pytest.MonkeyPatch) -> None:
    showing = BoardShowing(Theme("light"), Keys({}))
    qtbot.addWidget(showing)
    shown: list[ByteImage] = []
    monkeypatch.setattr(showing.picture, "show_frame", shown.append)
    frame, progress = board_progress()
    showing.show_frame(frame)
    assert not showing.has_rings, "nothing was looked at yet"
    showing.show_progress(progress)
    newer = replace(frame, timestamp_s=frame.timestamp_s + 0.5 * RINGS_LAST_S, color_rgb=frame.color_rgb.copy())
    showing.show_frame(newer)
    assert showing.has_rings
    assert shown[-1] is progress.frame.color_rgb, "the newest picture has its corners elsewhere"
    late = replace(newer, timestamp_s=frame.timestamp_s + 2.0 * RINGS_LAST_S)
    showing.show_frame(late)
    assert not showing.has_rings
    assert shown[-1] is late.color_rgb
    lost = replace(progress, look=replace(progress.look, found=None))
    showing.show_progress(lost)
    showing.show_frame(newer)
    assert not showing.has_rings
    assert shown[-1] is newer.color_rgb


def test_the_keyboard_stays_with_the_board_while_it_is_worked_out(qtbot: QtBot) -> None:
    window = QWidget()
    qtbot.addWidget(window)
    back, showing = QPushButton("back", window), BoardShowing(Theme("light"), Keys({}))
    row = QVBoxLayout(window)
    row.addWidget(back)
    row.addWidget(showing)
    window.show()
    showing.primary.setEnabled(True)
    showing.primary.setFocus()
    assert window.focusWidget() is showing.primary
    showing.work()
    assert window.focusWidget() is showing.picture, "a key more would go back, and the pictures would be lost"
