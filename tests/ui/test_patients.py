"""The first screen: two key presses to a session, search, the form, and what it says of each patient."""

from __future__ import annotations

import itertools
from dataclasses import replace
from datetime import date, timedelta

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from carpus.core.model.errors import PatientListBusy, PseudonymTaken
from carpus.core.model.names import MAX_NAME_CHARACTERS
from carpus.core.records.values import Patient
from carpus.ui.kit.text import Text
from carpus.ui.kit.theme import Theme
from carpus.ui.picture.photo import crop_to_markers
from carpus.ui.screens.patients.patient_form import PatientForm
from carpus.ui.screens.patients.patient_store import MAX_LISTED_PATIENTS
from carpus.ui.screens.patients.screen import PatientsScreen
from carpus.ui.shell.current_selection import NameDisplay
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
    screen = show(PatientsScreen(theme, store, lambda: TODAY, NameDisplay()), active=True)
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
    assert LEGAL_SENTENCE in shown_texts(screen)


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


ROSA = {"name": "Rosa Muster", "birth_day": date(1981, 3, 12), "record_number": "PR-4711", "sex": "female"}


def test_patient_search_states_the_matching_field_only(qtbot: QtBot, screen: PatientsScreen, store: FakeStore) -> None:
    store.rows[5] = replace(store.rows[5], **ROSA)
    model = screen.list.patient_model
    for (typed, found_by, hidden_words), is_hidden in itertools.product(
        (
            ("linden", "", ""),
            ("mus", "", "found by name"),
            ("4711", "No. PR-4711", "found by record number"),
            ("12.3.1981", "born 12 Mar 1981", "found by birth date"),
            ("fracture 12.3.81", "born 12 Mar 1981", "found by birth date"),
        ),
        (False, True),
    ):
        screen._names.set_hidden(is_hidden)
        screen.refresh("linden")
        screen.search.setText(typed)
        words, row = hidden_words if is_hidden else found_by, model.find_row("linden")
        screen.list.setCurrentIndex(model.index(row))
        about = model.row_cells(model.row(row))[2].split(" · ")
        assert about == [*([words] if words else []), "Wrist fracture, plate"], typed
        shown = " ".join([*shown_texts(screen.card), str(model.data(model.index(row)))])
        assert words in shown
        for text in ("Rosa Muster", "born 12 Mar 1981", "PR-4711", "female"):
            assert (text in shown) is not is_hidden, (typed, text)
    screen.search.setText("13.3.1981")
    assert model.rowCount() == 0


def test_patient_list_namesakes_are_told_apart(qtbot: QtBot, screen: PatientsScreen, store: FakeStore) -> None:
    store.rows[5] = replace(store.rows[5], **ROSA)
    screen.refresh("linden")
    model = screen.list.patient_model
    assert model.name_parts(store.rows[5]) == ("Rosa Muster", "")
    store.rows[4] = replace(store.rows[4], name="rosa muster", record_number="77")
    screen.refresh("linden")
    assert [model.name_parts(store.rows[number])[1] for number in (4, 5)] == ["77", "12 Mar 1981"]


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
        ("20.12.2026", "Since: The date"),
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


def error_of(form: PatientForm, name: str) -> Text:
    """The message below a field."""
    return form.fields.labelled_widgets[name].error


def test_patient_form_identity_is_saved_and_failed_save_keeps_entries(
    qtbot: QtBot, form: PatientForm, given: Given, store: FakeStore, monkeypatch: pytest.MonkeyPatch
) -> None:
    form.edit_patient(Patient("Fir 12", "left", "right"), frozenset())
    for name, typed in (("name", "Rosa  Muster"), ("birth_day", "12.3.81"), ("record_number", "PR-4711")):
        qtbot.keyClicks(form.fields[name], typed)
    form.fields["sex"].buttons()[0].click()
    save = store.save
    for fault, name in ((PseudonymTaken("Fir 12"), "pseudonym"), (PatientListBusy("x", "locked"), "")):
        monkeypatch.setattr(store, "save", lambda _, fault=fault: (_ for _ in ()).throw(fault))
        form.save_button.click()
        assert form.isVisible(), "nothing is closed that is not saved"
        assert (error_of(form, name) if name else form._error_text).isVisible()
        assert error_of(form, "pseudonym").isVisible() is bool(name)
    monkeypatch.setattr(store, "save", save)
    form.save_button.click()
    assert given == [Patient("Fir 12", "left", "right", **ROSA)]
    form.edit_patient(given[0], frozenset())
    assert form.fields["birth_day"].text() == "12 Mar 1981"
    form.fields["birth_day"].setText("13.13.1981")
    assert (form.save_button.text(), form.save_button.isEnabled()) == ("Birth date: This date does not exist", False)


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
    assert "soft hyphen" in error_of(form, "diagnosis").text()
    assert form.fields["note"].toPlainText() == "a long note"
    for typed in ("21.8.99999999999", "21.8.202"):
        form.fields["onset_day"].setText(typed)
        assert not form.save_button.isEnabled(), typed
    form.fields["onset_day"].clear()
    form.fields["diagnosis"].setText("Radius fracture")
    form.save_button.click()
    assert [one.diagnosis for one in given] == ["Radius fracture"]


def test_patient_list_unknown_name_is_created_with_enter(
    qtbot: QtBot, screen: PatientsScreen, store: FakeStore
) -> None:
    qtbot.keyClicks(screen.search, "Fir 12")
    qtbot.keyClick(screen.search, Qt.Key.Key_Return)
    assert screen.form.isVisible()
    assert screen.form.fields["pseudonym"].text() == "Fir 12"
    screen.form.fields["side"].buttons()[1].click()
    screen.form.fields["dominance"].buttons()[0].click()
    qtbot.keyClick(screen.form.fields["pseudonym"], Qt.Key.Key_Return)
    assert (store.added[0].pseudonym, store.added[0].side) == ("Fir 12", "left")
    assert screen.list.patient_model.row(screen.list.currentIndex().row()).pseudonym == "Fir 12"
    assert screen.search.text() == ""


def test_patient_list_after_midnight_updates_the_date(theme: Theme, store: FakeStore) -> None:
    day = [TODAY]
    screen = PatientsScreen(theme, store, lambda: day[0], NameDisplay())
    screen.refresh()
    shown, row = screen.date_text.text(), screen.list.patient_model.index(0)
    ago = row.data()
    day[0] = TODAY + timedelta(days=1)
    screen.refresh_date()
    assert screen.date_text.text() != shown
    assert row.data() != ago


def test_patient_list_of_very_many_shows_the_first_and_finds_the_others(
    screen: PatientsScreen, store: FakeStore
) -> None:
    store.rows = [
        replace(store.rows[0], pseudonym=f"Oak {n}", patient_id=str(n)) for n in range(MAX_LISTED_PATIENTS + 200)
    ]
    screen.refresh()
    assert screen.list.patient_model.rowCount() == MAX_LISTED_PATIENTS + 1
    screen.search.setText(f"oak {MAX_LISTED_PATIENTS + 150}")
    assert [screen.list.patient_model.row(0).pseudonym] == [f"Oak {MAX_LISTED_PATIENTS + 150}"]


def test_photo_is_cropped_to_its_markers_in_its_aspect_ratio() -> None:
    picture = np.full((120, 160, 3), 128, np.uint8)
    assert crop_to_markers(picture) is picture, "without markers all of it"
    picture[60:70, 100:110] = picture[60:70, 130:140] = (20, 40, 160)
    cropped = crop_to_markers(picture)
    height, width, _ = cropped.shape
    assert height < 120
    assert width / height == pytest.approx(4 / 3, abs=0.05)
    assert np.count_nonzero(cropped[..., 2] == 160) == 200, "all markers are in it"
