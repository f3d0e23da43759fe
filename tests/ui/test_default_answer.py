"""One rule for Enter, held over every card and dialog of the program.

Each is opened as the program opens it. The keyboard is in a field or on the default button; "Enter" stands on that
button alone; Enter presses it and nothing else; and it is the answer that loses nothing.
"""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Callable
from datetime import date
from typing import TypeVar

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QAbstractSpinBox, QComboBox, QLineEdit, QPlainTextEdit, QPushButton, QSpinBox, QWidget
from pytestqt.qtbot import QtBot

import carpus.app
import carpus.ui
from carpus.core.model.fault_text import MessageText
from carpus.core.records.session_setup import DEFAULT_SETS
from carpus.ui.kit.button import ENTER_KEY, Button, is_enter_handler
from carpus.ui.kit.dialog import Dialog
from carpus.ui.kit.field import SearchField
from carpus.ui.kit.text import Text
from carpus.ui.kit.theme import Theme
from carpus.ui.screens.correct.flow import ResultsDialog
from carpus.ui.screens.export.dialog import ExportDialog
from carpus.ui.screens.live.controls import NoteDialog, PainDialog
from carpus.ui.screens.markers.guidance import StartAngleDialog
from carpus.ui.screens.patients.patient_form import PatientForm
from carpus.ui.screens.records.deletion import DeleteDialog
from carpus.ui.screens.records.lock import LockScreen, PinDialog
from carpus.ui.screens.records.record_lists import ListedRecord, LogDialog, RecordsDialog
from carpus.ui.screens.report.dialogs import HomeDialog, LetterDialog
from carpus.ui.screens.review.frame_view import HandImageDialog
from carpus.ui.screens.review.screen import ExclusionDialog
from carpus.ui.screens.sessions.dialogs import ChoiceDialog, ExcludeDialog
from carpus.ui.screens.settings.retest_dialog import RetestDialog
from carpus.ui.screens.setup.set_dialog import SetDialog
from carpus.ui.shell.camera_session import CameraNameDialog
from carpus.ui.shell.messages import Answer, MessageDialog
from tests.ui.fakes import NOW, FakeStore, home_report, retest_studies
from tests.ui.gallery import ERASED_SESSION, LAST_BACKUP, TODAY

FIELDS = (QLineEdit, QPlainTextEdit, QComboBox, QSpinBox)
DialogT = TypeVar("DialogT", bound=Dialog)
Opened = tuple[Dialog, str]
"""A dialog that is open, and the answer that loses nothing."""


def _opened(
    kind: Callable[..., DialogT], show: Callable[..., object], answer: str, *given: object, **named: object
) -> Callable[..., Opened]:
    def open_it(host: QWidget, theme: Theme) -> Opened:
        dialog = kind(host, theme)
        show(dialog, *given, **named)
        return dialog, answer

    return open_it


def _patient(host: QWidget, theme: Theme) -> Opened:
    dialog = PatientForm(host, theme, FakeStore(), date.today)
    dialog.edit_patient(None, frozenset())
    for choices in (dialog.fields["side"], dialog.fields["dominance"]):
        choices.buttons()[0].click()
    return dialog, "Add patient"


def _home(host: QWidget, theme: Theme) -> Opened:
    dialog = HomeDialog(host, theme)
    dialog.open_form(home_report().report, NOW.date())
    return dialog, "Show the sheet"


def _card(host: QWidget, theme: Theme) -> Opened:
    card = MessageDialog(host, theme)
    answers = (Answer("Discard", lambda: None, "L", is_risky=True), Answer("Back to the form", lambda: None))
    card.show_words(MessageText("Leave without saving?", "", ""), answers, is_alarm=False)
    return card, "Back to the form"


DIALOGS: dict[type[Dialog], Callable[[QWidget, Theme], Opened]] = {
    MessageDialog: _card,
    PatientForm: _patient,
    CameraNameDialog: _opened(CameraNameDialog, CameraNameDialog.request_name, "Continue", "Window"),
    ResultsDialog: _opened(ResultsDialog, ResultsDialog.open, ""),
    ExportDialog: _opened(ExportDialog, ExportDialog.request_formats, "Choose folder…"),
    NoteDialog: _opened(NoteDialog, NoteDialog.open_note, "Save note"),
    PainDialog: _opened(PainDialog, PainDialog.open, "Close"),
    StartAngleDialog: _opened(StartAngleDialog, StartAngleDialog.open_angles, "Use these angles", np.zeros(3)),
    DeleteDialog: _opened(
        DeleteDialog, DeleteDialog.show_plan, "Archive instead", ERASED_SESSION, 10, LAST_BACKUP, TODAY
    ),
    RecordsDialog: _opened(
        RecordsDialog,
        RecordsDialog.show_records,
        "Done",
        "Archive",
        "",
        [ListedRecord("a", "Heron 17", "1 session", True)],
    ),
    LogDialog: _opened(LogDialog, LogDialog.show_entries, "Done", []),
    LockScreen: _opened(LockScreen, LockScreen.lock, "Unlock", "", is_session_saved=True),
    PinDialog: _opened(PinDialog, PinDialog.request_pin, "Set PIN", is_set=True),
    HomeDialog: _home,
    LetterDialog: _opened(LetterDialog, LetterDialog.open_form, "Show the letter", ["Dr A"], has_name=True),
    RetestDialog: _opened(RetestDialog, RetestDialog.show_studies, "Cancel", retest_studies(), 0, date(2026, 11, 27)),
    HandImageDialog: _opened(HandImageDialog, HandImageDialog.open_form, "Cancel"),
    ExclusionDialog: _opened(ExclusionDialog, ExclusionDialog.open_form, "Keep included", 3),
    ExcludeDialog: _opened(ExcludeDialog, ExcludeDialog.request_reason, "Cancel"),
    ChoiceDialog: _opened(
        ChoiceDialog, ChoiceDialog.request_choice, "Cancel", "To whom?", "", "Move", [("a", "Heron 17")]
    ),
    SetDialog: _opened(SetDialog, SetDialog.open_sets, "Save the set", DEFAULT_SETS, "wrist6"),
}
"""Every dialog of the program, opened with something in it."""


def _all_dialogs() -> set[type[Dialog]]:
    """Every kind that can be opened, of every module of the window."""
    for package in (carpus.ui, carpus.app):
        for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
            if not module.name.endswith("__main__"):
                importlib.import_module(module.name)
    found, waiting = set(), [Dialog]
    while waiting:
        for kind in waiting.pop().__subclasses__():
            waiting.append(kind)
            if kind.__module__.startswith("carpus.") and not kind.__name__.startswith("_"):
                found.add(kind)
    return found


def test_dialogs_are_all_in_the_table() -> None:
    assert _all_dialogs() == set(DIALOGS)


def _pressed(dialog: Dialog) -> list[str]:
    """What is pressed from now on."""
    said: list[str] = []
    for button in dialog.findChildren(QPushButton):
        button.clicked.connect(lambda _=False, button=button: said.append(button.text()))
    return said


@pytest.mark.parametrize("kind", DIALOGS, ids=lambda kind: kind.__name__)
def test_dialog_enter_presses_the_marked_default_only(
    qtbot: QtBot, theme: Theme, host: QWidget, kind: type[Dialog]
) -> None:
    dialog, answer = DIALOGS[kind](host, theme)
    focused = host.focusWidget()
    if answer:
        assert dialog.default_button.text() == answer
    assert focused is dialog.default_button or isinstance(focused, FIELDS) or not is_enter_handler(focused)
    marked = [one.text() for one in dialog.findChildren(Button) if one.isVisible() and one.visible_key == ENTER_KEY]
    assert marked == [dialog.default_button.text()]
    several_lines = isinstance(focused, QPlainTextEdit)  # takes Enter alone for a new line
    with_key = Qt.KeyboardModifier.ControlModifier if several_lines else Qt.KeyboardModifier.NoModifier
    said = _pressed(dialog)
    qtbot.keyClick(focused, Qt.Key.Key_Return, with_key)
    assert said == [marked[0]]


@pytest.mark.parametrize("kind", DIALOGS, ids=lambda kind: kind.__name__)
def test_dialog_esc_after_typing_warns_first(qtbot: QtBot, theme: Theme, host: QWidget, kind: type[Dialog]) -> None:
    def esc(dialog: Dialog) -> None:
        qtbot.keyClick(host.focusWidget() or dialog, Qt.Key.Key_Escape)

    dialog, _ = DIALOGS[kind](host, theme)
    esc(dialog)
    if dialog.isVisible():
        return  # it must be answered
    for field in (QLineEdit, QPlainTextEdit):
        dialog, _ = DIALOGS[kind](host, theme)
        typed = [one for one in dialog.findChildren(field) if one.isVisible() and not isinstance(one, SearchField)]
        typed = [one for one in typed if isinstance(one, QPlainTextEdit) or one.echoMode() == QLineEdit.EchoMode.Normal]
        for one in [one for one in typed if not isinstance(one.parent(), QAbstractSpinBox)][:1]:
            before = dialog.card.findChildren(Text)
            qtbot.keyClick(one, Qt.Key.Key_7)
            esc(dialog)
            assert dialog.isVisible(), "one key throws nothing away"
            assert len(dialog.card.findChildren(Text)) == len(before) + 1, "and it is said"
            qtbot.keyClick(one, Qt.Key.Key_8)
            esc(dialog)
            assert dialog.isVisible(), "what was typed since is new"
            esc(dialog)
            assert not dialog.isVisible()
        dialog.close_dialog()


def test_message_dialog_risky_default_is_refused(theme: Theme, host: QWidget) -> None:
    with pytest.raises(ValueError, match="Erase it"):
        MessageDialog(host, theme).show_words(
            MessageText("", "", ""), [Answer("Erase it", lambda: None, is_risky=True)]
        )
