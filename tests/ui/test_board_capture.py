"""The keyboard stays with the board while the calibration is worked out."""

from __future__ import annotations

from PySide6.QtWidgets import QPushButton, QVBoxLayout, QWidget
from pytestqt.qtbot import QtBot

from carpus.ui.kit.theme import Theme
from carpus.ui.screens.camera_calibration.capture_view import BoardCaptureView


def test_board_capture_calculating_keeps_the_focus(qtbot: QtBot) -> None:
    window = QWidget()
    qtbot.addWidget(window)
    back, showing = QPushButton("back", window), BoardCaptureView(Theme("light"))
    row = QVBoxLayout(window)
    row.addWidget(back)
    row.addWidget(showing)
    window.show()
    showing.primary_button.setEnabled(True)
    showing.primary_button.setFocus()
    assert window.focusWidget() is showing.primary_button
    showing.show_calculating()
    assert window.focusWidget() is showing.frame_view, "a key more would go back, and the pictures would be lost"
