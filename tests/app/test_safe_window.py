"""The whole window on a data folder of its own: what keeps, hides, erases and brings back."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from dataclasses import replace
from datetime import date, datetime, timedelta
from pathlib import Path

import pytest
from PySide6.QtCore import QLocale, Qt, QTimer
from PySide6.QtWidgets import QAbstractItemView, QApplication, QLabel, QPushButton, QWidget
from pytestqt.qtbot import QtBot

from carpus.app import compose
from carpus.app.desktop.encrypting import AskPin
from carpus.app.settings import BackupSettings, RecordingSettings, RecordsSettings, ScreenSettings, Settings
from carpus.core.encryption import keys
from carpus.core.library.library import Library
from carpus.core.safekeeping.audit import AUDIT_FILE, read_audit
from carpus.core.safekeeping.backup import backups, put_in_place
from carpus.core.safekeeping.pin import Pin
from carpus.core.session.register import PatientEntry
from carpus.ui.messages.strip import NoticeStrip
from tests.app.test_library import set_up, store
from tests.safekeeping.samples import traces

Open = Callable[..., compose.Desktop]


@pytest.fixture
def data(tmp_path: Path) -> Path:
    """Two patients, the first with two sessions."""
    library = Library(tmp_path / "data")
    try:
        linden = library.clinic.add(PatientEntry("Linden 42", "right", name="Erika Mustermann"))
        library.clinic.add(PatientEntry("Heron 17", "left"))
        for _ in range(2):
            store(library, set_up(linden, "Linden 42"))
    finally:
        library.close()
    return library.folder


@pytest.fixture
def opened(qapp: QApplication, qtbot: QtBot, data: Path, tmp_path: Path) -> Iterator[Open]:
    QLocale.setDefault(QLocale(QLocale.Language.English, QLocale.Country.UnitedKingdom))
    desktops: list[compose.Desktop] = []

    def open_it(settings: Settings | None = None) -> compose.Desktop:
        settings = settings or Settings()
        settings = replace(settings, screen=ScreenSettings("light"), recording=RecordingSettings(folder=str(data)))
        desktop = compose.compose(qapp, settings, settings_folder=tmp_path / "settings", today=date(2026, 11, 20))
        desktops.append(desktop)
        desktop.show()
        return desktop

    yield open_it
    for desktop in desktops:
        desktop.close()
        qtbot.waitUntil(lambda desktop=desktop: not desktop.journey.background.busy)  # type: ignore[misc]


def linden(desktop: compose.Desktop) -> str:
    return next(one.patient_id for one in desktop.library.clinic.patients() if one.entry.pseudonym == "Linden 42")


def visible_words(window: QWidget) -> set[str]:
    """Every text that can be read in a window, of lists too."""
    words = {label.text() for label in window.findChildren(QLabel) if label.isVisible()}
    words |= {button.text().replace("&", "") for button in window.findChildren(QPushButton) if button.isVisible()}
    for view in window.findChildren(QAbstractItemView):
        if view.isVisible() and view.model() is not None:
            model = view.model()
            words |= {str(model.index(row, 0).data()) for row in range(model.rowCount())}
    return words


def test_a_session_is_archived_or_erased_from_the_list(qtbot: QtBot, opened: Open) -> None:
    desktop = opened()
    journey = desktop.journey
    journey.viewing.open_sessions(linden(desktop))
    sheet = desktop.safe.erasing.sheet
    for answer in (sheet.instead, sheet.for_good):
        before = len(journey.sessions.list.rows.lines)
        journey.sessions.erase_button.click()
        qtbot.waitUntil(sheet.isVisible)
        sheet.line.setText("Linden 42")
        qtbot.mouseClick(answer, Qt.MouseButton.LeftButton)
        qtbot.waitUntil(lambda before=before: len(journey.sessions.list.rows.lines) == before - 1)  # type: ignore[misc]
    assert len(desktop.library.clinic.archived()) == 1
    assert [entry.did for entry in read_audit(desktop.library.folder).entries][-3:] == [
        "archived", "erase_begun", "erased",
    ]  # fmt: skip


def test_a_patient_is_erased_from_the_form(qtbot: QtBot, opened: Open, data: Path) -> None:
    desktop = opened()
    patients, sheet = desktop.journey.patients, desktop.safe.erasing.sheet
    patients.change_patient(linden(desktop))
    assert patients.form.remove.isVisible()
    patients.form.remove.click()
    qtbot.waitUntil(sheet.isVisible)
    assert "2 sessions" in sheet.goes.text()
    qtbot.keyClicks(sheet.line, "Linden 42")
    sheet.for_good.click()
    qtbot.waitUntil(lambda: [one.entry.pseudonym for one in desktop.library.clinic.patients()] == ["Heron 17"])
    qtbot.waitUntil(lambda: desktop.journey.place == "patients" and not desktop.journey.background.busy)
    assert traces(data, "Linden", "Mustermann") == []
    patients.new_patient()
    assert not patients.form.remove.isVisible()


def test_a_window_with_a_pin_shows_nothing_before_it(
    qtbot: QtBot, opened: Open, data: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    Pin(data).set("4821")
    desktop = opened()
    shell, locking = desktop.shell, desktop.safe.locking
    assert locking.locked
    assert visible_words(shell) & {"Linden 42", "Heron 17", "Patients"} == set()
    assert "Linden" not in shell.windowTitle()
    qtbot.keyClicks(locking.sheet.line, "0000")
    qtbot.keyClick(locking.sheet.line, Qt.Key.Key_Return)
    assert locking.locked
    assert "4 more tries" in locking.sheet.said.text()
    for key in (Qt.Key.Key_Escape, Qt.Key.Key_F1):
        qtbot.keyClick(locking.sheet.line, key)
    assert locking.locked
    with monkeypatch.context() as missing:
        missing.setitem(sys.modules, "argon2", None)
        qtbot.keyClicks(locking.sheet.line, "4821")
        qtbot.keyClick(locking.sheet.line, Qt.Key.Key_Return)
        assert locking.locked
        assert "argon2 is missing" in locking.sheet.said.text()
        assert locking.sheet.line.isEnabled()
    qtbot.keyClicks(locking.sheet.line, "4821")
    qtbot.keyClick(locking.sheet.line, Qt.Key.Key_Return)
    assert not locking.locked
    assert "Patients" in visible_words(shell)
    done = [entry.did for entry in read_audit(data).entries]
    assert done[-3:] == ["locked", "pin_refused", "unlocked"]


def test_it_locks_by_key_and_by_itself_but_never_over_a_recording(
    qtbot: QtBot, opened: Open, data: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    Pin(data).set("4821")
    desktop = opened()
    locking, journey = desktop.safe.locking, desktop.journey
    locking.sheet.tried.emit("4821")
    assert not locking.locked
    assert 0 < locking.idle.left_ms <= 11 * 60_000  # a coarse clock
    journey.viewing.open_sessions(linden(desktop))
    journey.sessions.rename_button.click()
    assert journey.sessions.rename_sheet.isVisible()
    monkeypatch.setattr(type(journey.live), "recording_state", "recording")
    locking.lock_by_key()
    locking.idle.passed.emit()
    assert not locking.locked
    assert 0 < locking.idle.left_ms <= 66_000, "it waits for the recording to end"
    monkeypatch.setattr(type(journey.live), "recording_state", "off")
    locking.idle.passed.emit()
    assert locking.locked
    assert "after 10 minutes" in locking.sheet.why.text()
    assert not any("Linden" in word for word in visible_words(desktop.shell))
    locking.sheet.tried.emit("4821")
    assert journey.sessions.rename_sheet.isVisible(), "what was open is open again"


def test_a_pin_is_set_changed_and_taken_away_in_the_settings(qtbot: QtBot, opened: Open, data: Path) -> None:
    desktop = opened()
    locking = desktop.safe.locking
    locking.lock_by_key()
    assert desktop.journey.place == "settings", "without a PIN the key leads to where one is set"
    sheet = locking.pin_sheet
    for new, again, is_set in (("4821", "4822", False), ("99", "99", False), ("4821", "4821", True)):
        locking.card.pin_button.click()
        sheet.new.setText(new)
        sheet.again.setText(again)
        sheet.keep.click()
        assert Pin(data).is_set == is_set
        sheet.close_sheet()
    locking.card.pin_button.click()
    locking.pin_sheet.old.setText("0000")
    locking.pin_sheet.remove.click()
    assert Pin(data).is_set
    locking.pin_sheet.old.setText("4821")
    locking.pin_sheet.remove.click()
    assert not Pin(data).is_set


def test_back_up_now_reminder_and_restore(
    qtbot: QtBot, opened: Open, data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    disk = tmp_path / "disk"
    desktop = opened(replace(Settings(), backup=BackupSettings(folder=str(disk))))
    backing, journey = desktop.safe.backing_up, desktop.journey
    strips = journey.patients.findChildren(NoticeStrip)
    assert ["There is no back-up yet." in strip.words.what for strip in strips] == [True]
    disk.mkdir()
    backing.back_up()
    qtbot.waitUntil(lambda: backing.last is not None and backing.card.now_button.isEnabled())
    assert "Every session is in it." in backing.card.headline.text()
    assert read_audit(data).entries[-1].did == "backed_up"
    erased = linden(desktop)
    desktop.safe.erasing._records.erase(desktop.safe.erasing._records.plan_patient(erased))
    monkeypatch.setattr("PySide6.QtWidgets.QFileDialog.getExistingDirectory", lambda *_: str(disk))
    backing.card.restore_button.click()
    qtbot.waitUntil(lambda: journey.teller.busy)
    assert any("2 sessions come, 0 change, 0 go" in word for word in visible_words(desktop.shell))
    button = next(one for one in journey.teller.card.findChildren(QPushButton) if "Restore it" in one.text())
    button.click()
    qtbot.waitUntil(lambda: backing.restored is not None)
    assert backing.restored is not None
    desktop.close()
    old = put_in_place(backing.restored.staged, backing.restored.data_folder, datetime(2026, 11, 20, 18, 0))
    assert len(backups(disk)) == 2, "what was there is backed up first"
    assert old.is_dir()
    restored = Library(data)
    try:
        assert {one.entry.pseudonym for one in restored.clinic.patients()} == {"Linden 42", "Heron 17"}
    finally:
        restored.close()


def test_it_backs_up_by_itself_once_a_day_and_not_over_a_recording(
    qtbot: QtBot, opened: Open, data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    disk = tmp_path / "disk"
    desktop = opened(replace(Settings(), backup=BackupSettings(folder=str(disk), hour=12)))
    backing = desktop.safe.backing_up
    today = datetime.now().astimezone().replace(hour=13)
    monkeypatch.setattr(backing, "_now", lambda: today)
    backing.look()
    assert not backing._running, "the disk is not there"
    disk.mkdir()
    monkeypatch.setattr(backing, "_is_recording", lambda: True)
    backing.look()
    assert not backing._running
    monkeypatch.setattr(backing, "_is_recording", lambda: False)
    backing.look()
    qtbot.waitUntil(lambda: backing.last is not None and not backing._running)
    backing.look()
    assert not backing._running, "once a day"
    monkeypatch.setattr(backing, "_now", lambda: today + timedelta(days=1))
    backing.look()
    assert backing._running
    qtbot.waitUntil(lambda: not backing._running)


def test_lists_of_records_and_the_log(qtbot: QtBot, opened: Open, data: Path) -> None:
    desktop = opened(replace(Settings(), records=RecordsSettings(10)))
    lists = desktop.safe.lists
    lists._today = lambda: date(2040, 1, 1)
    lists.card.due_button.click()
    qtbot.waitUntil(lists.sheet.isVisible)
    assert [button.accessibleName() for button in lists.sheet.buttons] == ["Archive Linden 42", "Erase… Linden 42"]
    lists.sheet.buttons[0].click()
    qtbot.waitUntil(lambda: [one.text() for one in lists.sheet.buttons] == ["Bring back", "Erase…"])
    lists.sheet.close_sheet()
    lists.card.archive_button.click()
    qtbot.waitUntil(lists.sheet.isVisible)
    lists.sheet.buttons[0].click()
    qtbot.waitUntil(lambda: lists.sheet.buttons == [])
    lists.sheet.close_sheet()
    lists.card.log_button.click()
    qtbot.waitUntil(lists.log_sheet.isVisible)
    table = lists.log_sheet.table
    assert [table.item(row, 2).text() for row in range(2)] == ["brought back", "archived"]
    assert table.item(0, 3).text() == "Linden 42"
    assert lists.log_sheet.state.state == "good"
    lists.log_sheet.close_sheet()
    log = data / AUDIT_FILE
    log.write_bytes(log.read_bytes().replace(b'"did": "archived"', b'"did": "opened"'))
    lists.show_log()
    qtbot.waitUntil(lists.log_sheet.isVisible)
    assert lists.log_sheet.state.state == "bad"


def test_what_is_looked_at_is_logged(qtbot: QtBot, opened: Open) -> None:
    desktop = opened()
    desktop.journey.viewing.open_sessions(linden(desktop))
    chosen = desktop.journey.sessions.chosen()
    assert chosen is not None
    desktop.journey.sessions.open_chosen()
    qtbot.waitUntil(lambda: desktop.journey.review.shown)
    last = read_audit(desktop.library.folder).entries[-1]
    assert (last.did, last.kind, last.identity) == ("opened", "session", chosen.session_id)


def test_encryption_is_switched_on_in_the_settings_asked_for_at_the_start_and_switched_off(
    opened: Open, data: Path, qapp: QApplication, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(keys, "_ARGON2", (1, 8, 1))
    pin = "four words of mine"
    desktop = opened()
    encryption = desktop.safe.encryption
    assert "Off" in encryption.card.state.text()
    desktop.journey.settings_wanted.emit()
    encryption.card.button.click()
    sheet = encryption.sheet
    sheet.new.setText("4821")
    sheet.again.setText("4821")
    sheet.go.click()
    assert "ten signs" in sheet.said.text()
    sheet.new.setText(pin)
    sheet.again.setText(pin)
    sheet.go.click()
    qtbot.waitUntil(lambda: not sheet.code.isHidden(), timeout=60_000)
    code = sheet.code.text()
    sheet.done.click()
    assert "Encrypted" in encryption.card.state.text()
    assert traces(data, "Mustermann") == []
    assert desktop.library.clinic.patients("mustermann"), "the window goes on"
    desktop.safe.locking.lock_by_key()
    desktop.safe.locking.sheet.tried.emit(pin)
    assert not desktop.safe.locking.locked
    desktop.close()

    keys.use_only(None)
    settings = replace(Settings(), recording=RecordingSettings(folder=str(data)))
    for typed in (pin, code):
        keys.use_only(None)
        ask = AskPin(desktop.theme, data)
        QTimer.singleShot(0, ask.shell, lambda ask=ask: ask.sheet.tried.emit("another one"))
        QTimer.singleShot(0, ask.shell, lambda ask=ask, typed=typed: ask.sheet.tried.emit(typed))
        assert ask.ask()
    assert compose.ask_for_pin(qapp, settings)

    desktop = opened()
    assert not desktop.safe.locking.locked, "it was typed a moment ago"
    encryption = desktop.safe.encryption
    encryption.card.button.click()
    encryption.sheet.old.setText("another one")
    encryption.sheet.go.click()
    assert "another one" in encryption.sheet.said.text()
    encryption.sheet.old.setText(pin)
    encryption.sheet.go.click()
    qtbot.waitUntil(lambda: not keys.has_key(data), timeout=60_000)
    qtbot.waitUntil(lambda: "Off" in encryption.card.state.text())
    assert "patients.sqlite3" in traces(data, "Mustermann")[0]
    did = [entry.did for entry in read_audit(data).entries]
    assert "encrypted" in did
    assert "decrypted" in did
