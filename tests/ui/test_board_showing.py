"""The keyboard stays with the board while the calibration is worked out."""

from __future__ import annotations

from PySide6.QtWidgets import QPushButton, QVBoxLayout, QWidget
from pytestqt.qtbot import QtBot

from carpus.ui.camera_calibration.showing import BoardShowing
from carpus.ui.theme import Theme


def test_the_keyboard_stays_with_the_board_while_it_is_worked_out(qtbot: QtBot) -> None:
    window = QWidget()
    qtbot.addWidget(window)
    back, showing = QPushButton("back", window), BoardShowing(Theme("light"))
    row = QVBoxLayout(window)
    row.addWidget(back)
    row.addWidget(showing)
    window.show()
    showing.primary.setEnabled(True)
    showing.primary.setFocus()
    assert window.focusWidget() is showing.primary
    showing.work()
    assert window.focusWidget() is showing.picture, "a key more would go back, and the pictures would be lost"
