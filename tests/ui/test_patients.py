"""The first screen: two key presses to a session, search, the form, and what it says of each patient."""

from __future__ import annotations

from dataclasses import replace
from datetime import date, datetime, timedelta

import pytest
from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtWidgets import QPushButton, QWidget
from pytestqt.qtbot import QtBot

from carpus.core.model.names import MAX_NAME_CHARACTERS
from carpus.core.records.session_setup import PRACTICE_PATIENT
from carpus.core.records.values import Patient
from carpus.ui.kit.language import LANGUAGES, use_language
from carpus.ui.kit.numbers import (
    format_clock,
    format_clock_tenths,
    format_days_ago,
    format_degrees,
    format_ordinal,
    format_recording_time,
    format_sd,
    format_with_sd,
)
from carpus.ui.kit.text import Text
from carpus.ui.kit.theme import Theme
from carpus.ui.picture.photo import fit_box
from carpus.ui.screens.patients.patient_form import PatientForm
from carpus.ui.screens.patients.patient_list import row_cells
from carpus.ui.screens.patients.screen import PatientsScreen
from carpus.ui.shell.view_models import MAX_LISTED_PATIENTS
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


def test_patient_list_diagnosis_and_onset_are_in_row_and_card(
    qtbot: QtBot, screen: PatientsScreen, store: FakeStore
) -> None:
    assert row_cells(store.rows[5], TODAY)[2:4] == ("Wrist fracture, plate", "13 weeks")
    assert row_cells(store.rows[3], TODAY)[2:4] == ("Rheumatoid arthritis", "")
    screen.refresh("linden")
    expected = {"Wrist fracture, plate", "operated on 21 Aug 2026", "13 weeks"}
    qtbot.waitUntil(lambda: expected <= set(shown_texts(screen.card)))
    screen.refresh("cobalt")
    assert not any("weeks" in text for text in shown_texts(screen.card))


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


def test_patient_form_opened_takes_the_focus_and_returns_it(qtbot: QtBot, screen: PatientsScreen) -> None:
    bar = screen.form._scroll.verticalScrollBar()
    screen.new_patient()
    bar.setRange(0, 100)
    bar.setValue(80)
    screen.new_patient()
    assert bar.value() == 0
    for _ in range(25):
        qtbot.keyClick(screen.focusWidget(), Qt.Key.Key_Tab)
        assert screen.form.isAncestorOf(screen.focusWidget())
    qtbot.keyClick(screen.form.fields["pseudonym"], Qt.Key.Key_Escape)
    assert not screen.form.isVisible()
    assert screen.search.hasFocus()


def test_patient_card_buttons_emit_their_signals(qtbot: QtBot, screen: PatientsScreen, store: FakeStore) -> None:
    card = screen.card
    screen.refresh("linden")
    pairs = (
        (card.review_button, screen.review_requested), (card.progress_button, screen.progress_requested),
        (card.change_button, screen.setup_requested),
    )  # fmt: skip
    for button, signal in pairs:
        with qtbot.waitSignal(signal) as sent:
            button.click()
        assert sent.args == ["linden"]
    qtbot.mouseClick(card.edit_button, Qt.MouseButton.LeftButton)
    screen.form.fields["pseudonym"].setText("Linden 43")
    qtbot.keyClick(screen.form.fields["pseudonym"], Qt.Key.Key_Return)
    assert [row.pseudonym for row in store.rows if row.patient_id == "linden"] == ["Linden 43"]
    screen.set_camera_ready(False)
    assert "no camera" in card.start_button.text()
    last = screen.list.patient_model.row(screen.list.patient_model.rowCount() - 1)
    assert last.patient_id == PRACTICE_PATIENT
    screen.refresh(PRACTICE_PATIENT)
    assert card.start_button.text() == "Start practice"
    assert not card.review_button.isEnabled()


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


def test_patient_list_search_without_result_moves_nothing(qtbot: QtBot, screen: PatientsScreen) -> None:
    before = screen.search.geometry(), screen.new_button.geometry()
    qtbot.keyClicks(screen.search, "Fir 12")
    qtbot.waitUntil(lambda: not screen.card.isVisible())
    screen.layout().activate()
    assert (screen.search.geometry(), screen.new_button.geometry()) == before


def test_patient_card_long_name_moves_no_button(qtbot: QtBot, screen: PatientsScreen, store: FakeStore) -> None:
    screen.refresh("linden")
    screen.layout().activate()
    edit, card = screen.card.edit_button, screen.card
    before = edit.geometry(), card.geometry(), screen.list.geometry()
    place = next(n for n, row in enumerate(store.rows) if row.patient_id == "linden")
    store.rows[place] = replace(store.rows[place], pseudonym="Blue Hummingbird Mountain 42 and more of it")
    screen.refresh("linden")
    screen.layout().activate()
    qtbot.wait(1)
    assert (edit.geometry(), card.geometry(), screen.list.geometry()) == before
    assert card._name.visible_text.startswith("Blue Humm")
    assert card._name.visible_text.endswith("…")
    assert "and more of it" in card._name.toolTip()


def test_patient_list_empty_offers_one_way_to_a_new_patient(screen: PatientsScreen, store: FakeStore) -> None:
    store.rows.clear()
    screen.refresh()
    offered = [button for button in screen.findChildren(QPushButton) if "New patient" in button.text()]
    assert [button for button in offered if button.isVisible()] == [screen.new_button]


def test_disk_space_is_formatted_in_fitting_units() -> None:
    assert [format_recording_time(minutes) for minutes in (0.0, 8.4, 599.0, 1020.0, 60_000.0)] == [
        "0 min", "8 min", "599 min", "17 h", "more than 99 h",
    ]  # fmt: skip


def test_photo_keeps_its_aspect_ratio_uncut() -> None:
    for size, room in ((QSize(300, 280), QRectF(0, 0, 465, 185)), (QSize(300, 280), QRectF(3, 3, 152, 112))):
        box = fit_box(size, room)
        assert room.contains(box)
        assert box.width() / box.height() == pytest.approx(300 / 280)
        assert box.width() == pytest.approx(room.width()) or box.height() == pytest.approx(room.height())


def test_patient_list_after_midnight_updates_the_date(theme: Theme, store: FakeStore) -> None:
    day = [TODAY]
    screen = PatientsScreen(theme, store, lambda: day[0])
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


def test_patient_form_both_hands_dominant_stays_when_edited(form: PatientForm, given: Given) -> None:
    form.edit_patient(Patient("Fir 12", "left", "both"), frozenset())
    assert form.save_button.isEnabled()
    form.fields["note"].setPlainText("plate out")
    form.save_button.click()
    assert [(one.dominance, one.note) for one in given] == [("both", "plate out")]


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


def test_patient_form_invalid_date_is_reported_once_complete(qtbot: QtBot, form: PatientForm, host: QWidget) -> None:
    form.edit_patient(None, frozenset())  # no hand is chosen yet: the button asks for that first
    form.fields["diagnosis"].setFocus()
    qtbot.keyClicks(form.fields["diagnosis"], "Mallet finger")
    form.focusNextPrevChild(True)
    assert (form.listed_tick.isVisible(), host.focusWidget()) == (True, form.fields["onset_day"])
    none = "Since when? This date does not exist"
    order = "Since when? Day, month, year"
    for typed, told in (
        ("31.2.2026", none), ("20.12.2026", "in the future"), ("2026-02-31", none), ("12/20/2026", order),
        ("13/20/2026", none),
    ):  # fmt: skip
        form.fields["onset_day"].setFocus()
        form.fields["onset_day"].selectAll()
        for sign in typed[:-1]:
            qtbot.keyClicks(form.fields["onset_day"], sign)
            assert not form._error_text.isVisible(), "not while it is typed"
        qtbot.keyClicks(form.fields["onset_day"], typed[-1])
        assert form._error_text.isVisible()
        assert told in form._error_text.text()
    form.fields["onset_day"].selectAll()
    qtbot.keyClicks(form.fields["onset_day"], "31.2")
    form.focusNextPrevChild(True)
    assert form._error_text.isVisible(), "half a day is told on leaving its field"
    form.fields["onset_day"].setFocus()
    form.fields["onset_day"].selectAll()
    qtbot.keyClick(form.fields["onset_day"], Qt.Key.Key_Delete)
    form.focusNextPrevChild(True)
    assert not form._error_text.isVisible()


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


def test_patient_form_mnemonic_focuses_its_field(qtbot: QtBot, form: PatientForm, host: QWidget) -> None:
    form.edit_patient(None, frozenset())
    for letter, field in (
        (Qt.Key.Key_D, form.fields["diagnosis"]),
        (Qt.Key.Key_S, form.fields["onset_day"]),
        (Qt.Key.Key_N, form.fields["pseudonym"]),
    ):
        qtbot.keyClick(host.focusWidget(), letter, Qt.KeyboardModifier.AltModifier)
        assert host.focusWidget() is field


@pytest.mark.parametrize("code", LANGUAGES)
def test_patient_form_fields_are_not_cut(qtbot: QtBot, host: QWidget, code: str) -> None:
    with use_language(code):
        form = PatientForm(host, Theme("dark", 1.5), FakeStore(), lambda: TODAY)
        form.edit_patient(
            Patient("Fir 12", "both", "left", diagnosis="Radius", onset="injury", onset_day=TODAY), frozenset()
        )
        qtbot.waitUntil(lambda: form._form_page.width() > 0)
        assert form._form_page.minimumSizeHint().width() <= form._scroll.viewport().width()
        form.close_dialog()


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
