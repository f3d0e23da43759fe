"""The first step of the set-up: targets as they are written, and the hand of a patient with two."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest
from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot

from carpus.core.records.values import Patient
from carpus.ui.kit.theme import Theme
from carpus.ui.screens.setup.exercise import ExerciseScreen
from tests.ui.conftest import Show
from tests.ui.fakes import set_up

LINDEN = Patient("Linden 42", "right", patient_id="linden")


@pytest.fixture
def screen(show: Show[ExerciseScreen]) -> ExerciseScreen:
    screen = ExerciseScreen(Theme())
    screen.show_patient(LINDEN, None, "right", False)
    return show(screen)


def test_target_invalid_is_marked_and_prevents_continuing(qtbot: QtBot, screen: ExerciseScreen) -> None:
    sent: list[object] = []
    screen.set_up_chosen.connect(sent.append)
    for typed in ("-200", "200", "0", "abc", "4o", "1e3", "nan"):
        screen.target_fields[1].clear()
        qtbot.keyClicks(screen.target_fields[1], typed)
        assert screen.target_fields[1].text() == typed
        assert screen.problem_label.isVisible()
        assert "90°" in screen.problem_label.text()
        assert not screen.primary_button.isEnabled()
        qtbot.keyClick(screen.exercises.current(), Qt.Key.Key_Return)
        assert not sent
    screen.target_fields[1].clear()
    qtbot.keyClicks(screen.target_fields[1], "35")
    assert not screen.problem_label.isVisible()
    qtbot.keyClick(screen.exercises.current(), Qt.Key.Key_Return)
    assert sent


def test_targets_are_recalled_for_the_same_patient_only(screen: ExerciseScreen) -> None:
    last = replace(set_up(), target_positive_deg=37.5, target_negative_deg=-20.0)
    screen.show_patient(LINDEN, last, "right", False)
    assert [field.value() for field in screen.target_fields] == [37.5, -20.0]
    screen.show_patient(Patient("Fir 12", "left", patient_id="fir"), None, "left", False)
    assert all(math.isnan(field.value()) for field in screen.target_fields)


def test_target_is_taken_as_it_is_written(qtbot: QtBot, screen: ExerciseScreen) -> None:
    for typed, degrees in (("37,5", 37.5), ("37.5", 37.5), ("40", 40.0), ("40°", 40.0), (" ", math.nan)):
        screen.target_fields[0].clear()
        qtbot.keyClicks(screen.target_fields[0], typed)
        assert screen.primary_button.isEnabled()
        assert screen.set_up().target_positive_deg == pytest.approx(degrees, nan_ok=True)
