"""What goes for all screens of the window: Esc takes away what lies over one, colours change everywhere."""

from __future__ import annotations

from PySide6.QtCore import Qt
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
