"""The first screen: two key presses to a session, search, the form, and what it says of each patient."""

from __future__ import annotations

from dataclasses import replace
from datetime import date, datetime

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from carpus.core.model.names import MAX_NAME_CHARACTERS
from carpus.core.records.values import Patient
from carpus.ui.kit.numbers import (
    format_clock,
    format_clock_tenths,
    format_days_ago,
    format_degrees,
    format_ordinal,
    format_sd,
    format_with_sd,
)
from carpus.ui.kit.text import Text
from carpus.ui.kit.theme import Theme
from carpus.ui.screens.patients.patient_form import PatientForm
from carpus.ui.screens.patients.screen import PatientsScreen
from carpus.ui.words.terms import LEGAL_SENTENCE
from tests.ui.conftest import Show
from tests.ui.fakes import FakeStore
from tests.ui.geometry import shown_texts

TODAY = date(2026, 11, 20)


@pytest.fixture
def store() -> FakeStore:
    return FakeStore()


@pytest.fixture
def screen(theme: Theme, show: Show[PatientsScreen], store: FakeStore) -> PatientsScreen:
    screen = show(PatientsScreen(theme, store, lambda: TODAY), active=True)
    screen.set_camera_ready(True)
    screen.refresh()
    screen.search.setFocus()
    return screen


def test_patient_list_arrow_and_enter_in_search_start_a_session(qtbot: QtBot, screen: PatientsScreen) -> None:
    for _ in range(2):
        qtbot.keyClick(screen.search, Qt.Key.Key_Down)
    with qtbot.waitSignal(screen.start_requested) as started:
        qtbot.keyClick(screen.search, Qt.Key.Key_Return)
    assert started.args == ["maple"]


def test_patient_list_search_matches_pseudonym_real_name_and_exercise(
    qtbot: QtBot, screen: PatientsScreen, store: FakeStore
) -> None:
    store.rows[5] = replace(store.rows[5], name="Rosa Muster")
    screen.refresh()
    for typed, expected in (
        ("lind", ["linden"]),
        ("rosa", ["linden"]),
        ("pronation", ["heron", "juniper"]),
        ("plate fracture", ["linden", "juniper"]),
        ("ulnar", ["quartz"]),
    ):
        screen.search.clear()
        qtbot.keyClicks(screen.search, typed)
        shown = [screen.list.patient_model.row(k).patient_id for k in range(screen.list.patient_model.rowCount())]
        assert shown == expected


@pytest.mark.parametrize(
    ("typed", "is_shown"),
    [
        ("linden", False),
        ("wu", True),
        ("os", False),
        ("fracture mus", True),
    ],
)
def test_patient_list_real_name_is_shown_only_if_searched_for(
    qtbot: QtBot, screen: PatientsScreen, store: FakeStore, typed: str, is_shown: bool
) -> None:
    store.rows[5] = replace(store.rows[5], name="Rosa Muster Wu")
    screen.refresh("linden")
    qtbot.keyClicks(screen.search, typed)
    row = screen.list.patient_model.find_row("linden")
    assert (
        "Rosa Muster Wu · Wrist fracture" in screen.list.patient_model.row_cells(screen.list.patient_model.row(row))[2]
    ) == is_shown
    screen.list.setCurrentIndex(screen.list.patient_model.index(row))
    assert ("Name: Rosa Muster Wu" in shown_texts(screen.card)) == is_shown
    screen.search.clear()
    assert "Name: Rosa Muster Wu" not in shown_texts(screen.card)


def test_patient_form_name_in_use_is_refused(qtbot: QtBot, screen: PatientsScreen, store: FakeStore) -> None:
    screen.new_patient("  heron 17 ")
    screen.form.fields["side"].buttons()[0].click()
    screen.form.fields["dominance"].buttons()[0].click()
    qtbot.keyClick(screen.form.fields["pseudonym"], Qt.Key.Key_Return)
    assert screen.form.isVisible()
    assert not store.added
    screen.form.fields["pseudonym"].setText("Heron 18")
    screen.form.fields["name"].setText("R. M.")
    qtbot.keyClick(screen.form.fields["pseudonym"], Qt.Key.Key_Return)
    assert (store.added[0].pseudonym, store.added[0].name) == ("Heron 18", "R. M.")


def test_patient_list_shows_the_legal_notice_word_for_word(screen: PatientsScreen) -> None:
    assert LEGAL_SENTENCE in [label.text() for label in screen.findChildren(Text)]


def test_numbers_have_no_sign_and_show_unknown_values() -> None:
    assert format_degrees(-41.6) == "42°"
    assert format_degrees(float("nan")) == "–"
    assert format_sd(0.2) == "±\N{NO-BREAK SPACE}1°"
    assert format_sd(float("nan")) == ""
    assert format_with_sd(57.2, 2.4) == "57°\N{NO-BREAK SPACE}±\N{NO-BREAK SPACE}2°"
    assert format_with_sd(57.2, float("nan")) == "57°"
    assert (format_clock(84.9), format_clock(3661), format_clock_tenths(20.65)) == ("01:24", "1:01:01", "00:20.6")
    said = [format_ordinal(n) for n in (1, 2, 3, 4, 11, 12, 13, 21, 112)]
    assert said == ["1st", "2nd", "3rd", "4th", "11th", "12th", "13th", "21st", "112th"]
    assert format_days_ago(datetime(2026, 11, 19, 23, 0), TODAY) == "yesterday"


# --- the sheet of a patient's facts ----------------------------------------------------------------------


Given = list[Patient]


@pytest.fixture
def form(host: QWidget, theme: Theme, store: FakeStore) -> PatientForm:
    return PatientForm(host, theme, store, lambda: TODAY)


@pytest.fixture
def given(store: FakeStore) -> Given:
    """What was kept."""
    return store.added


@pytest.mark.parametrize("letters", [5, MAX_NAME_CHARACTERS])
def test_patient_form_long_entry_is_not_cut(form: PatientForm, given: Given, letters: int) -> None:
    form.edit_patient(Patient("n" * letters, "left", "right"), frozenset())
    form.save_button.click()
    assert [entry.pseudonym for entry in given] == ["n" * letters]
    too_long = "m" * (MAX_NAME_CHARACTERS + 5)
    for line in (form.fields["pseudonym"], form.fields["name"], form.fields["diagnosis"]):
        form.edit_patient(given[0], frozenset())
        line.setText(too_long)
        assert (line.text(), form.save_button.isEnabled()) == (too_long, False), "nothing is cut"
        assert form.save_button.text().endswith("5 characters too long")
    form.close_dialog()


def test_patient_form_new_patient_has_no_hand_preselected(qtbot: QtBot, form: PatientForm, given: Given) -> None:
    form.edit_patient(None, frozenset())
    qtbot.keyClick(form.fields["pseudonym"], Qt.Key.Key_Return)
    assert (given, form.save_button.isEnabled(), form.save_button.text()) == ([], False, "Which hand is affected?")
    assert form.focusWidget() is form.fields["side"].buttons()[0], "Enter leads to what is asked"
    form.fields["side"].buttons()[1].click()
    assert form.save_button.text() == "Which hand writes?"
    form.fields["dominance"].buttons()[2].click()
    qtbot.keyClick(form.fields["pseudonym"], Qt.Key.Key_Return)
    assert [(one.side, one.dominance) for one in given] == [("left", "unknown")]


def test_patient_form_diagnosis_with_date_is_saved_and_listed(
    qtbot: QtBot, form: PatientForm, given: Given, store: FakeStore
) -> None:
    form.edit_patient(Patient("Fir 12", "left", "right"), frozenset())
    assert (form.listed_tick.isVisible(), form.save_button.isEnabled()) == (False, True), (
        "nobody must say why a patient comes"
    )
    qtbot.keyClicks(form.fields["diagnosis"], "Mallet  finger")
    assert not form.listed_tick.isChecked()
    form.listed_tick.click()
    assert store.listed[-1] == "Mallet finger"
    form.listed_tick.click()
    assert (form.listed_tick.isChecked(), "Mallet finger" in store.listed) == (False, False)
    for typed, asked in (
        ("21.8.", "Since"),
        ("20.12.2026", "Since when? The date"),
        ("21.8.2026", "Operation or injury?"),
    ):
        form.fields["onset_day"].setText(typed)
        assert form.save_button.text().startswith(asked), typed
        assert not form.save_button.isEnabled()
    form.fields["onset"].buttons()[1].click()
    assert form.weeks_text.text() == "13 weeks"
    form.save_button.click()
    assert given == [
        Patient("Fir 12", "left", "right", diagnosis="Mallet finger", onset="injury", onset_day=date(2026, 8, 21))
    ]
    form.edit_patient(given[0], frozenset())
    form.fields["onset_day"].clear()
    form.save_button.click()
    assert (given[1].onset, given[1].onset_day) == ("injury", None), "no date, no weeks"


def test_patient_form_invisible_character_is_reported_and_entries_stay(
    form: PatientForm, given: Given, store: FakeStore
) -> None:
    form.edit_patient(Patient("Fir 12", "left", "right"), frozenset())
    form.fields["note"].setPlainText("a long note")
    form.fields["diagnosis"].setText("Radius\u00adfracture")
    before = list(store.listed)
    form.listed_tick.click()
    assert store.listed == before
    form.save_button.click()
    assert form.isVisible()
    assert "soft hyphen" in form._error_text.text()
    assert form.fields["note"].toPlainText() == "a long note"
    for typed in ("21.8.99999999999", "21.8.202"):
        form.fields["onset_day"].setText(typed)
        assert not form.save_button.isEnabled(), typed
    form.fields["onset_day"].clear()
    form.fields["diagnosis"].setText("Radius fracture")
    form.save_button.click()
    assert [one.diagnosis for one in given] == ["Radius fracture"]


@pytest.mark.parametrize(
    ("searched", "is_real"), [("Maier", True), ("Anna Maier", True), ("Heron 17", False), (" heron 17 ", False)]
)
def test_patient_form_searched_name_becomes_the_real_name(screen: PatientsScreen, searched: str, is_real: bool) -> None:
    screen.new_patient(searched)
    names = screen.form.fields["pseudonym"].text().strip(), screen.form.fields["name"].text().strip()
    if is_real:
        assert names[0] not in ("", searched)
        assert names[1] == searched
    else:
        assert names == (searched.strip(), "")
