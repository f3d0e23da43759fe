"""The sheet of a patient's facts."""

from __future__ import annotations

from datetime import date

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from carpus.core.names import MOST_CHARACTERS
from carpus.core.records.values import PatientEntry
from carpus.ui.language import LANGUAGES, speaking
from carpus.ui.patients.entry import PatientForm
from carpus.ui.theme import Theme
from tests.ui.fakes import FakeStore

TODAY = date(2026, 11, 20)


@pytest.mark.parametrize("letters", [5, MOST_CHARACTERS])
def test_what_is_typed_is_kept_whole_however_long_it_is(qtbot: QtBot, theme: Theme, letters: int) -> None:
    host = QWidget()
    qtbot.addWidget(host)
    host.resize(1280, 800)
    host.show()
    form = PatientForm(host, theme, FakeStore(), lambda: TODAY)
    given: list[PatientEntry] = []
    form.accepted.connect(given.append)
    form.begin(PatientEntry("n" * letters, "left", "right"), frozenset())
    form.save.click()
    assert [entry.pseudonym for entry in given] == ["n" * letters]
    too_long = "m" * (MOST_CHARACTERS + 5)
    for line in (form.name, form.real_name, form.diagnosis):
        form.begin(given[0], frozenset())
        line.setText(too_long)
        assert (line.text(), form.save.isEnabled()) == (too_long, False), "nothing is cut"
        assert form.save.text().endswith("5 letters too many")
    form.close_sheet()


def test_no_hand_is_chosen_by_itself(qtbot: QtBot, theme: Theme) -> None:
    host = QWidget()
    qtbot.addWidget(host)
    host.show()
    form = PatientForm(host, theme, FakeStore(), lambda: TODAY)
    given: list[PatientEntry] = []
    form.accepted.connect(given.append)
    form.begin(None, frozenset())
    qtbot.keyClick(form.name, Qt.Key.Key_Return)
    assert (given, form.save.isEnabled(), form.save.text()) == ([], False, "Which hand is affected?")
    assert form.focusWidget() is form.side.buttons()[0], "Enter leads to what is asked"
    form.side.buttons()[1].click()
    assert form.save.text() == "Which hand writes?"
    form.dominance.buttons()[2].click()
    qtbot.keyClick(form.name, Qt.Key.Key_Return)
    assert [(one.side, one.dominance) for one in given] == [("left", "unknown")]


def test_a_diagnosis_with_its_date_is_typed_or_chosen_and_the_clinics_list_kept(qtbot: QtBot, theme: Theme) -> None:
    host = QWidget()
    qtbot.addWidget(host)
    host.resize(1280, 800)
    host.show()
    store = FakeStore()
    form = PatientForm(host, theme, store, lambda: TODAY)
    given: list[PatientEntry] = []
    form.accepted.connect(given.append)
    form.begin(PatientEntry("Fir 12", "left", "right"), frozenset())
    assert (form.listed.isVisible(), form.save.isEnabled()) == (False, True), "nobody must say why a patient comes"
    qtbot.keyClicks(form.diagnosis, "Mallet  finger")
    assert not form.listed.isChecked()
    form.listed.click()
    assert store.listed[-1] == "Mallet finger"
    form.listed.click()
    assert (form.listed.isChecked(), "Mallet finger" in store.listed) == (False, False)
    for typed, asked in (("21.8.", "Since"), ("20.12.2026", "Since when? It"), ("21.8.2026", "Operation or injury?")):
        form.onset_day.setText(typed)
        assert form.save.text().startswith(asked), typed
        assert not form.save.isEnabled()
    form.onset.buttons()[1].click()
    assert form.since.text() == "13 weeks"
    form.save.click()
    assert given == [
        PatientEntry("Fir 12", "left", "right", diagnosis="Mallet finger", onset="injury", onset_day=date(2026, 8, 21))
    ]
    form.begin(given[0], frozenset())
    form.onset_day.clear()
    form.save.click()
    assert (given[1].onset, given[1].onset_day) == ("injury", None), "no date, no weeks"


def test_a_day_that_is_none_is_told_on_leaving_its_field_and_the_list_is_no_stop_of_tab(
    qtbot: QtBot, theme: Theme
) -> None:
    host = QWidget()
    qtbot.addWidget(host)
    host.resize(1280, 800)
    host.show()
    with qtbot.waitActive(host, timeout=60_000):
        host.activateWindow()
    form = PatientForm(host, theme, FakeStore(), lambda: TODAY)
    form.begin(None, frozenset())  # no hand is chosen yet: the button asks for that first
    form.diagnosis.setFocus()
    qtbot.keyClicks(form.diagnosis, "Mallet finger")
    form.focusNextPrevChild(True)
    assert (form.listed.isVisible(), host.focusWidget()) == (True, form.onset_day)
    for typed, told in (("31.2.2026", "Since when? Day, month, year"), ("20.12.2026", "yet to come")):
        form.onset_day.setFocus()
        form.onset_day.selectAll()
        qtbot.keyClicks(form.onset_day, typed)
        assert not form._fault.isVisible(), "not while it is typed"
        form.focusNextPrevChild(True)
        assert form._fault.isVisible()
        assert told in form._fault.text()
    form.onset_day.setFocus()
    form.onset_day.selectAll()
    qtbot.keyClick(form.onset_day, Qt.Key.Key_Delete)
    form.focusNextPrevChild(True)
    assert not form._fault.isVisible()


def test_a_sign_that_cannot_be_seen_is_told_in_the_form_and_nothing_typed_is_lost(qtbot: QtBot, theme: Theme) -> None:
    host = QWidget()
    qtbot.addWidget(host)
    host.resize(1280, 800)
    host.show()
    store = FakeStore()
    form = PatientForm(host, theme, store, lambda: TODAY)
    given: list[PatientEntry] = []
    form.accepted.connect(given.append)
    form.begin(PatientEntry("Fir 12", "left", "right"), frozenset())
    form.note.setPlainText("a long note")
    form.diagnosis.setText("Radius\u00adfracture")
    before = list(store.listed)
    form.listed.click()
    assert store.listed == before
    form.save.click()
    assert form.isVisible()
    assert "soft hyphen" in form._fault.text()
    assert form.note.toPlainText() == "a long note"
    for typed in ("21.8.99999999999", "21.8.202"):
        form.onset_day.setText(typed)
        assert not form.save.isEnabled(), typed
    form.onset_day.clear()
    form.diagnosis.setText("Radius fracture")
    form.save.click()
    assert [one.diagnosis for one in given] == ["Radius fracture"]


def test_the_letter_of_a_field_leads_to_it(qtbot: QtBot, theme: Theme) -> None:
    host = QWidget()
    qtbot.addWidget(host)
    host.show()
    form = PatientForm(host, theme, FakeStore(), lambda: TODAY)
    form.begin(None, frozenset())
    for letter, field in ((Qt.Key.Key_D, form.diagnosis), (Qt.Key.Key_S, form.onset_day), (Qt.Key.Key_N, form.name)):
        qtbot.keyClick(host.focusWidget(), letter, Qt.KeyboardModifier.AltModifier)
        assert host.focusWidget() is field


@pytest.mark.parametrize("scale", [1.0, 1.5])
@pytest.mark.parametrize("code", LANGUAGES)
def test_no_field_is_cut_at_its_right(qtbot: QtBot, code: str, scale: float) -> None:
    host = QWidget()
    qtbot.addWidget(host)
    host.resize(1280, 800)
    host.show()
    with speaking(code):
        form = PatientForm(host, Theme("dark", scale), FakeStore(), lambda: TODAY)
        form.begin(
            PatientEntry("Fir 12", "both", "left", diagnosis="Radius", onset="injury", onset_day=TODAY), frozenset()
        )
        qtbot.waitUntil(lambda: form._fields.width() > 0, timeout=60_000)
        assert form._fields.minimumSizeHint().width() <= form._scroll.viewport().width()
        form.close_sheet()
