"""Erasing asks twice: the pseudonym is typed, Enter never erases, the archive is what Enter takes."""

from __future__ import annotations

from dataclasses import replace
from datetime import date
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from carpus.ui.kit.theme import Theme
from carpus.ui.screens.records.deletion import DeleteDialog, DeletionController
from tests.ui.gallery import ERASED_PATIENT, ERASED_SESSION, LAST_BACKUP, TODAY


@pytest.fixture
def sheet(host: QWidget, theme: Theme) -> DeleteDialog:
    sheet = DeleteDialog(host, theme)
    sheet.show_plan(ERASED_SESSION, 10, LAST_BACKUP, TODAY)
    return sheet


@pytest.fixture
def done(sheet: DeleteDialog) -> list[str]:
    """What was answered."""
    answers: list[str] = []
    sheet.delete_confirmed.connect(lambda: answers.append("erase"))
    sheet.archive_confirmed.connect(lambda: answers.append("archive"))
    return answers


def test_enter_archives(qtbot: QtBot, sheet: DeleteDialog, done: list[str]) -> None:
    qtbot.keyClick(sheet.archive_button, Qt.Key.Key_Return)
    assert done == ["archive"]
    assert not sheet.isVisible()


def test_the_name_typed_as_asked_presses_nothing(qtbot: QtBot, sheet: DeleteDialog, done: list[str]) -> None:
    """Keys go to whatever has the keyboard, as a person's do: the space of the name is a letter."""
    for letter in "Linden 42":
        focused = sheet.window().focusWidget()
        assert focused is sheet.confirm_field
        qtbot.keyClicks(focused, letter)
    assert done == []
    assert sheet.isVisible()
    assert sheet.delete_button.isEnabled()
    qtbot.keyClick(sheet.confirm_field, Qt.Key.Key_Return)
    assert done == ["archive"], "Enter is what the button that bears it says"


def test_only_the_pseudonym_lets_it_be_erased_and_never_enter(
    qtbot: QtBot, sheet: DeleteDialog, done: list[str]
) -> None:
    assert not sheet.delete_button.isEnabled()
    qtbot.keyClicks(sheet.confirm_field, "Linden 4")
    assert not sheet.delete_button.isEnabled()
    qtbot.keyClicks(sheet.confirm_field, "2")
    assert sheet.delete_button.isEnabled()
    sheet.delete_button.setFocus()
    qtbot.keyClick(sheet.delete_button, Qt.Key.Key_Return)
    assert done == []
    sheet.delete_button.click()
    assert done == ["erase"]
    sheet.show_plan(ERASED_SESSION, 10, LAST_BACKUP, TODAY)
    assert not sheet.delete_button.isEnabled(), "the next one is asked anew"


def test_esc_does_nothing(qtbot: QtBot, sheet: DeleteDialog, done: list[str]) -> None:
    qtbot.keyClick(sheet.archive_button, Qt.Key.Key_Escape)
    assert not sheet.isVisible()
    assert done == []


def test_it_says_what_goes_what_stays_and_what_comes_too_early(sheet: DeleteDialog) -> None:
    assert "38 MB, files: 4" in sheet.deleted_text.text()
    assert (
        "Delete yourself: reports and exports saved elsewhere (1): /home/clinic/Reports/L.pdf" in sheet.kept_text.text()
    )
    assert "The patient’s other sessions." in sheet.kept_text.text()
    assert "15 Nov" in sheet.kept_text.text()
    assert "before that date" in sheet.consequence_text.text()
    many = replace(ERASED_SESSION, output_files=tuple(Path(str(number)) for number in range(5)))
    sheet.show_plan(many, 10, LAST_BACKUP, date(2036, 10, 10))
    assert sheet.consequence_text.text() == "It cannot be restored, not even from a backup."
    assert "(5): 0, 1, 2, …" in sheet.kept_text.text()
    sheet.show_plan(ERASED_PATIENT, 0, None, TODAY)
    assert "notes (412 MB, files: 31)" in sheet.deleted_text.text()
    assert "real name" in sheet.deleted_text.text()
    assert "All sessions (9)" in sheet.deleted_text.text()
    assert "other sessions" not in sheet.kept_text.text()
    assert sheet.consequence_text.text() == "It cannot be restored."


@pytest.mark.parametrize(
    ("kind", "open_patient", "behind", "is_recording", "shown"),
    [
        ("patient", None, "patients", False, ("patients",)),
        ("patient", "erased", "live", False, ("patients",)),
        ("patient", "erased", "live", True, None),
        ("patient", "other", "live", False, None),
        ("session", "erased", "sessions", False, ("sessions", "erased")),
        ("session", "erased", "review", False, ("sessions", "erased")),
        ("session", "erased", "live", False, None),
        ("session", "other", "sessions", False, None),
    ],
)
def test_what_is_shown_when_it_is_gone_takes_nobody_from_measuring_or_another_patient(
    kind: str, open_patient: str | None, behind: str, is_recording: bool, shown: tuple[str, ...] | None
) -> None:
    ways: list[tuple[str, ...]] = []
    navigator = SimpleNamespace(
        underlying_screen=behind, is_recording=lambda: is_recording, open_screen=lambda *to: ways.append(to)
    )
    patient = None if open_patient is None else SimpleNamespace(patient_id=open_patient)
    context = SimpleNamespace(navigator=navigator, current=SimpleNamespace(patient=patient))
    lists = SimpleNamespace(sessions_changed=SimpleNamespace(emit=lambda: None))
    own, plan = (
        SimpleNamespace(_context=context, _sessions=lambda: lists),
        SimpleNamespace(kind=kind, patient_id="erased"),
    )
    DeletionController._refresh_after_removal(cast("Any", own), cast("Any", plan))
    assert ways == ([] if shown is None else [shown])
