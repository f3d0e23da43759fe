"""The clinic's page: the table, a patient opened by mouse and by keyboard, the page read back."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from datetime import timedelta
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot

from carpus.app.compose import Desktop
from carpus.core.records.library import Library
from carpus.ui.clinic.screen import ClinicScreen, write_clinic_page
from carpus.ui.keys import Keys
from carpus.ui.last_places import LastPlaces
from carpus.ui.theme import Theme
from tests.records.samples import LINDEN, T0, record
from tests.ui.conftest import Show
from tests.ui.fakes import clinic
from tests.ui.printed import reach_of, words_of


def test_a_patient_is_opened_from_the_list_and_weeks_are_turned(
    qtbot: QtBot, theme: Theme, show: Show[ClinicScreen]
) -> None:
    screen = show(ClinicScreen(theme, Keys()))
    week = clinic()
    screen.show_week(week)
    patients, weeks, pages = [], [], []
    screen.patient.connect(patients.append)
    screen.week.connect(weeks.append)
    screen.save.clicked.connect(lambda: pages.append(True))
    qtbot.mouseClick(screen.due.buttons[1], Qt.MouseButton.LeftButton)
    qtbot.keyClick(screen.due.buttons[0], Qt.Key.Key_Return)
    assert patients == [week.due[1].patient_id, week.due[0].patient_id]
    qtbot.mouseClick(screen.before, Qt.MouseButton.LeftButton)
    screen.before.click()  # though the first is still read
    assert weeks == [week.monday - timedelta(days=7), week.monday - timedelta(days=14)]
    screen.save.click()
    assert pages
    (everybody, first, *_) = screen.sessions.rows
    assert everybody[0] == "All"
    assert [int(cell) for cell in everybody[1:8] if cell.isdigit()] == [count for count in week.everybody.days if count]
    assert first[0] == week.therapists[0].by


def test_the_page_says_the_same(tmp_path: Path) -> None:
    week = clinic()
    words = words_of(write_clinic_page(tmp_path / "clinic.pdf", week))
    assert f"{sum(week.everybody.days)} sessions of {week.patients} patients" in words
    assert all(one.pseudonym in words for one in week.due)
    assert "16 days overdue" in words
    assert f"{week.monday.year}" in words
    assert "without simulated sessions" in words
    assert "°" not in words, "no measured value"


def test_the_page_says_how_many_it_has_no_room_for(tmp_path: Path) -> None:
    week = clinic()
    due = tuple(replace(week.due[0], pseudonym=f"Aspen {number}") for number in range(90))
    therapists = tuple(replace(week.therapists[0], by=f"T{number}") for number in range(20))
    path = write_clinic_page(tmp_path / "clinic.pdf", replace(week, due=due, therapists=therapists))
    words = words_of(path)
    shown = words.count("Aspen ")
    assert shown > 10
    assert f"{90 - shown} more on the screen" in words
    assert reach_of(path)[3] < 842 - 28


def test_in_the_window_from_the_patients_to_who_is_due_and_back(
    qtbot: QtBot, open_desktop: Callable[..., Desktop], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    library = Library(tmp_path / "data")
    linden = library.patients.add(LINDEN)
    path = library.index.new_path(linden, LINDEN.pseudonym, "WRIST_FE", "right", T0)
    library.index.enter(record(path, LINDEN.pseudonym, T0), linden, "AB")
    library.close()
    desktop = open_desktop(today=(T0 + timedelta(days=30)).date())
    journey = desktop.journey
    qtbot.mouseClick(journey.patients.screen.clinic_button, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: journey.place == "clinic")
    assert journey.clinic.screen.due.rows[0][-1] == "2 days overdue"
    page = tmp_path / "clinic.pdf"
    monkeypatch.setattr(LastPlaces, "ask_where_to_save", lambda *_: page)
    journey.clinic.screen.save.click()
    qtbot.waitUntil(lambda: journey.messages.busy)
    assert page.is_file(), "and it is said"
    qtbot.keyClick(desktop.shell.focusWidget(), Qt.Key.Key_Return)
    assert not journey.messages.busy
    qtbot.keyClick(journey.clinic.screen.due.buttons[0], Qt.Key.Key_Return)
    assert journey.place == "patients"
    assert journey.patients.screen.card.isVisible()
