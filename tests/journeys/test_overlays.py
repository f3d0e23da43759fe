"""What goes for all screens of the window: Esc takes away what lies over one, colours change everywhere."""

from __future__ import annotations

from dataclasses import asdict

from PySide6.QtCore import Qt
from PySide6.QtGui import QPalette
from PySide6.QtWidgets import QLabel
from pytestqt.qtbot import QtBot

from carpus.app.desktop.window import Desktop
from carpus.core.model.errors import DiskFull
from carpus.ui.kit.dialog import Dialog
from carpus.ui.shell.messages import MessageDialog
from tests.journeys.conftest import Open


def press_escape(qtbot: QtBot, desktop: Desktop) -> None:
    qtbot.keyClick(desktop.shell.focusWidget() or desktop.shell, Qt.Key.Key_Escape)


def test_esc_closes_any_sheet_leaves_its_screen_and_answers_no_message(qtbot: QtBot, open_desktop: Open) -> None:
    desktop = open_desktop()
    journey = desktop.controller
    desktop.shell.activateWindow()
    seen: list[str] = []
    for place, screen in (
        ("patients", journey.patients.screen), ("markers", journey.markers.screen), ("live", journey.live.screen),
        ("review", journey.review.screen),
    ):  # fmt: skip
        journey.navigator.switch_screen(place)  # type: ignore[arg-type]
        for sheet in screen.findChildren(Dialog):
            if isinstance(sheet, MessageDialog):
                continue
            sheet.open()
            assert sheet.isVisible()
            press_escape(qtbot, desktop)
            assert not sheet.isVisible(), type(sheet).__name__
            assert journey.place == place
            seen.append(type(sheet).__name__)
    assert set(seen) >= {"PatientForm", "StartAngleDialog", "NoteDialog", "PainDialog", "ExclusionDialog"}
    journey.navigator.switch_screen("patients")
    journey.messages.show_fault(DiskFull("x"))
    press_escape(qtbot, desktop)
    assert journey.messages.dialog.isVisible()
    journey.messages.dialog.answer_buttons[-1].click()
    assert not journey.messages.is_busy


def test_theme_change_reaches_all_labels_and_keeps_recording_keys(qtbot: QtBot, open_desktop: Open) -> None:
    desktop = open_desktop()
    journey, theme = desktop.controller, desktop.theme

    def check_all() -> None:
        labels = 0
        for place in ("markers", "live", "review", "help", "settings", "progress", "report", "patients"):
            journey.navigator.switch_screen(place)  # type: ignore[arg-type]
            for label in desktop.shell.findChildren(QLabel):
                if label.isVisible() and label.text():
                    shown = label.palette().color(QPalette.ColorRole.WindowText).name().upper()
                    assert shown in set(asdict(theme.tokens).values()), (place, label.text())
                    labels += 1
        assert labels > 15, labels

    theme.choose("dark")
    check_all()
    theme.choose("light")
    check_all()
    bar = desktop.shell.top_bar
    bar.lock_overlays(True)
    for button in (bar.help_button, bar.settings_button):
        qtbot.mouseClick(button, Qt.MouseButton.LeftButton)
        assert not button.hasFocus(), "it would take the keys and the pedal from a running recording"
        assert "recording" in button.toolTip()
    bar.lock_overlays(False)
    assert bar.settings_button.isEnabled()
    assert "recording" not in bar.settings_button.toolTip()
