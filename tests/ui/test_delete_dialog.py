"""Erasing asks twice: the pseudonym is typed, Enter never erases, the archive is what Enter takes."""

from __future__ import annotations

from dataclasses import replace
from datetime import date
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from carpus.ui.kit.theme import Theme
from carpus.ui.screens.records.deletion import DeleteDialog
from tests.ui.gallery import ERASED_PATIENT, ERASED_SESSION, LAST_BACKUP, TODAY


@pytest.fixture
def dialog(host: QWidget, theme: Theme) -> DeleteDialog:
    dialog = DeleteDialog(host, theme)
    dialog.show_plan(ERASED_SESSION, 10, LAST_BACKUP, TODAY)
    return dialog


@pytest.fixture
def done(dialog: DeleteDialog) -> list[str]:
    """What was answered."""
    answers: list[str] = []
    dialog.delete_confirmed.connect(lambda: answers.append("erase"))
    dialog.archive_confirmed.connect(lambda: answers.append("archive"))
    return answers


def test_delete_dialog_deletes_only_by_its_button_and_after_the_pseudonym(
    qtbot: QtBot, dialog: DeleteDialog, done: list[str]
) -> None:
    """Keys go to whatever has the keyboard, as a person's do: the space of the name is a letter."""
    for letter in "Linden 42":
        assert not dialog.delete_button.isEnabled()
        assert dialog.window().focusWidget() is dialog.confirm_field
        qtbot.keyClicks(dialog.confirm_field, letter)
    dialog.delete_button.setFocus()
    qtbot.keyClick(dialog.delete_button, Qt.Key.Key_Return)
    assert done == []
    dialog.delete_button.click()
    assert done == ["erase"]
    dialog.show_plan(ERASED_SESSION, 10, LAST_BACKUP, TODAY)
    assert not dialog.delete_button.isEnabled(), "the next one is asked anew"


def test_delete_dialog_states_what_is_deleted_kept_and_too_early(dialog: DeleteDialog) -> None:
    assert "38 MB, files: 4" in dialog.deleted_text.text()
    assert (
        "Delete reports and exports saved elsewhere yourself (1): /home/clinic/Reports/L.pdf" in dialog.kept_text.text()
    )
    assert "The patient’s other sessions." in dialog.kept_text.text()
    assert "15 Nov" in dialog.kept_text.text()
    assert "before that date" in dialog.consequence_text.text()
    many = replace(ERASED_SESSION, output_files=tuple(Path(str(number)) for number in range(5)))
    dialog.show_plan(many, 10, LAST_BACKUP, date(2036, 10, 10))
    assert dialog.consequence_text.text() == "Deleted data cannot be restored, not even from a backup."
    assert "(5): 0, 1, 2, …" in dialog.kept_text.text()
    dialog.show_plan(ERASED_PATIENT, 0, None, TODAY)
    assert "notes (412 MB, files: 31)" in dialog.deleted_text.text()
    assert "real name" in dialog.deleted_text.text()
    assert "All sessions (9)" in dialog.deleted_text.text()
    assert "other sessions" not in dialog.kept_text.text()
    assert dialog.consequence_text.text() == "Deleted data cannot be restored."
