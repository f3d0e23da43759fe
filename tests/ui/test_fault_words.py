"""What the cards say of files has room on a card."""

from __future__ import annotations

from dataclasses import replace
from datetime import datetime

import pytest
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from carpus.core.model.errors import DiskFull
from carpus.core.records.new_sessions import RecoveredSession
from carpus.core.records.session_setup import PRACTICE_PATIENT
from carpus.ui.kit.language import use_language
from carpus.ui.kit.theme import Theme
from carpus.ui.shell.messages import Messages
from carpus.ui.words.fault_words import fault_words


@pytest.mark.parametrize("root", ["/home/someone/.local/share/carpus", "C:\\Users\\Some One\\AppData\\carpus"])
def test_long_path_is_reported_by_its_end(root: str) -> None:
    stroke = "\\" if "\\" in root else "/"
    name = "Blue-Hummingbird-Mountain-42_2026-11-21_154533_WRIST_FE_right.h5"
    words = fault_words(DiskFull(stroke.join((root, "sessions", "Blue-Hummingbird-Mountain-42", name)), "full"))
    assert max(len(part) for part in words.summary.split("/")) < 48
    assert "someone" not in words.summary
    assert "right.h5" in words.summary


def test_recovered_practice_session_names_patient_in_persons_language(qtbot: QtBot) -> None:
    host = QWidget()
    qtbot.addWidget(host)
    messages = Messages(host, Theme("light"))
    found = RecoveredSession(PRACTICE_PATIENT, "s1", "Practice patient", datetime(2026, 11, 26, 1, 41), 11.0)
    with use_language("de"):
        assert "Testpatient" in messages.recovery_words(found).summary
        assert "Linde" in messages.recovery_words(replace(found, patient_id="p1", pseudonym="Linde")).summary
