"""The sheet of a patient's facts."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from carpus.ui.patients.entry import MOST_LETTERS, PatientForm
from carpus.ui.ports import PatientEntry
from carpus.ui.theme import Theme


@pytest.mark.parametrize("letters", [5, MOST_LETTERS, 3 * MOST_LETTERS])
def test_a_name_is_kept_whole_however_long_it_is(qtbot: QtBot, theme: Theme, letters: int) -> None:
    host = QWidget()
    qtbot.addWidget(host)
    host.resize(1280, 800)
    host.show()
    form = PatientForm(host, theme, lambda: "Fir 12")
    given: list[PatientEntry] = []
    form.accepted.connect(given.append)
    form.begin(PatientEntry("n" * letters, "left", "right"), frozenset())
    form.save.click()
    assert [entry.pseudonym for entry in given] == ["n" * letters]
    form.begin(None, frozenset())
    form.name.clear()
    qtbot.keyClicks(form.name, "m" * (MOST_LETTERS + 5))
    assert form.name.text() == "m" * MOST_LETTERS


def test_no_hand_is_chosen_by_itself(qtbot: QtBot, theme: Theme) -> None:
    host = QWidget()
    qtbot.addWidget(host)
    host.show()
    form = PatientForm(host, theme, lambda: "Fir 12")
    given: list[PatientEntry] = []
    form.accepted.connect(given.append)
    form.begin(None, frozenset())
    qtbot.keyClick(form.name, Qt.Key.Key_Return)
    assert (given, form.save.isEnabled(), form.save.text()) == ([], False, "Which hand is affected?")
    form.side.buttons()[1].click()
    assert form.save.text() == "Which hand writes?"
    form.dominance.buttons()[2].click()
    qtbot.keyClick(form.name, Qt.Key.Key_Return)
    assert [(one.side, one.dominance) for one in given] == [("left", "unknown")]
