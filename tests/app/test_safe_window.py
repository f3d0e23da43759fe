"""The whole window on a data folder of its own: what keeps, hides, erases and brings back."""

from __future__ import annotations

import gc
import shutil
import sys
import threading
import weakref
from collections.abc import Callable
from contextlib import closing
from dataclasses import replace
from datetime import date, datetime, timedelta
from functools import partial
from pathlib import Path

import pytest
from PySide6.QtCore import QObject, Qt
from PySide6.QtWidgets import QAbstractItemView, QLabel, QPushButton, QWidget
from pytestqt.qtbot import QtBot

from carpus.app.desktop.window import Desktop, GarbageCollector
from carpus.app.settings import RecordingSettings, ReportSettings, Settings, load_valid_settings
from carpus.core.records.changes import fingerprint
from carpus.core.records.clinic_records import read_therapists, save_therapists
from carpus.core.records.data_folder import DataFolder
from carpus.core.records.erasure import ErasurePlan
from carpus.core.records.log import read_log
from carpus.core.records.pin import Pin
from carpus.core.records.restoring import activate_restored
from carpus.core.records.values import BackupSettings, Patient, Therapist
from carpus.ui.shell.messages import NoticeStrip
from tests.app.test_library import set_up, store
from tests.records.samples import traces

Open = Callable[..., Desktop]


@pytest.fixture(scope="module")
def prepared(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two patients, the first with two sessions."""
    with closing(DataFolder(tmp_path_factory.mktemp("prepared") / "data")) as library:
        linden = library.patients.add(Patient("Linden 42", "right", name="Erika Mustermann"))
        library.patients.add(Patient("Heron 17", "left"))
        for _ in range(2):
            store(library, set_up(linden, "Linden 42"))
    return library.folder


@pytest.fixture
def data(prepared: Path, tmp_path: Path) -> Path:
    return Path(shutil.copytree(prepared, tmp_path / "data"))


@pytest.fixture
def opened(open_desktop: Open, data: Path) -> Open:
    return partial(open_desktop, today=date(2026, 11, 20))


def patient(desktop: Desktop, pseudonym: str) -> str:
    return next(one.patient_id for one in desktop.library.patients.search() if one.pseudonym == pseudonym)


def linden(desktop: Desktop) -> str:
    return patient(desktop, "Linden 42")


def names(desktop: Desktop) -> list[str]:
    return [one.pseudonym for one in desktop.library.patients.search()]


def visible_words(window: QWidget) -> set[str]:
    """Every text that can be read in a window, of lists too."""
    words = {label.text() for label in window.findChildren(QLabel) if label.isVisible()}
    words |= {button.text().replace("&", "") for button in window.findChildren(QPushButton) if button.isVisible()}
    for view in window.findChildren(QAbstractItemView):
        if view.isVisible() and view.model() is not None:
            model = view.model()
            words |= {str(model.index(row, 0).data()) for row in range(model.rowCount())}
    return words


def test_session_is_looked_at_given_away_archived_and_deleted_from_list(qtbot: QtBot, opened: Open) -> None:
    desktop = opened()
    journey, sheet = desktop.controller, desktop.data_protection.erasing.dialog
    rows = journey.sessions.screen.list.session_model
    journey.sessions.open(linden(desktop))
    screen = journey.sessions.screen
    chosen = screen.current_line()
    screen.exclude_button.click()
    screen.exclude_dialog.reason_field.setText("splint on")
    qtbot.keyClick(screen.exclude_dialog.reason_field, Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: "excluded: splint on" in screen.remark_text.text())
    assert screen.current_line().entry == chosen.entry
    screen.exclude_button.click()
    qtbot.waitUntil(lambda: "splint on" not in screen.remark_text.text())
    for is_damaged in (True, False):
        screen._on_figures(screen._request_number, replace(screen.current_line(), is_damaged=is_damaged))
        assert journey.place == "sessions", "a damaged file is not opened"
        qtbot.keyClick(screen.list, Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: journey.review.screen.is_loaded)
    last = read_log(desktop.library.store)[-1]
    assert (last.action, last.kind, last.subject) == ("opened", "session", fingerprint(chosen.entry.session_id))

    heron = patient(desktop, "Heron 17")
    journey.sessions.open(linden(desktop))
    journey.sessions.screen.move_dialog.chosen.emit(heron)
    said = "The session now belongs to Heron 17."
    qtbot.waitUntil(lambda: said in visible_words(desktop.shell))
    assert len(desktop.library.sessions(heron)) == 1
    journey.navigator.switch_screen("patients")
    assert said not in visible_words(desktop.shell)

    for who, pseudonym, answer in (
        (linden(desktop), "Linden 42", sheet.archive_button), (heron, "Heron 17", sheet.delete_button),
    ):  # fmt: skip
        journey.sessions.open(who)
        assert len(rows.lines) == 1
        journey.sessions.screen.delete_button.click()
        qtbot.waitUntil(sheet.isVisible)
        sheet.confirm_field.setText(pseudonym)
        qtbot.mouseClick(answer, Qt.MouseButton.LeftButton)
        qtbot.waitUntil(lambda: len(rows.lines) == 0)
    assert len(desktop.library.session_list.list_archived()) == 1
    assert [entry.action for entry in read_log(desktop.library.store)][-3:] == [
        "archived", "erase_begun", "erased",
    ]  # fmt: skip


def test_patient_is_deleted_from_form(qtbot: QtBot, opened: Open, data: Path) -> None:
    desktop = opened()
    patients, sheet = desktop.controller.patients.screen, desktop.data_protection.erasing.dialog
    patients.change_patient(linden(desktop))
    assert patients.form.remove_button.isVisible()
    patients.form.remove_button.click()
    qtbot.waitUntil(sheet.isVisible)
    assert "sessions (2)" in sheet.deleted_text.text()
    qtbot.keyClicks(sheet.confirm_field, "Linden 42")
    sheet.delete_button.click()
    qtbot.waitUntil(lambda: names(desktop) == ["Heron 17"])
    qtbot.waitUntil(lambda: desktop.controller.place == "patients" and not desktop.controller.background.is_busy)
    assert traces(data, "Linden", "Mustermann") == []
    qtbot.waitUntil(lambda: "The patient was deleted." in visible_words(desktop.shell), timeout=60_000)
    patients.new_patient()
    assert not patients.form.remove_button.isVisible()


def test_deleting_patient_keeps_other_patient_open(qtbot: QtBot, opened: Open, monkeypatch: pytest.MonkeyPatch) -> None:
    desktop = opened()
    journey, records = desktop.controller, desktop.data_protection.erasing._records
    goes_on, erase = threading.Event(), records.erase
    heron = patient(desktop, "Heron 17")

    def slow(plan: ErasurePlan) -> int:
        goes_on.wait(60.0)
        return erase(plan)

    monkeypatch.setattr(records, "erase", slow)
    journey.patients.screen.change_patient(linden(desktop))
    journey.patients.screen.form.remove_button.click()
    sheet = desktop.data_protection.erasing.dialog
    qtbot.waitUntil(sheet.isVisible)
    qtbot.keyClicks(sheet.confirm_field, "Linden 42")
    sheet.delete_button.click()
    journey.sessions.open(heron)
    goes_on.set()
    qtbot.waitUntil(lambda: names(desktop) == ["Heron 17"])
    qtbot.waitUntil(lambda: not journey.background.is_busy)
    assert journey.place == "sessions"
    assert journey.current.patient is not None
    assert journey.current.patient.patient_id == heron


def test_window_with_pin_is_blank_until_unlocked_and_never_locks_while_recording(
    qtbot: QtBot, opened: Open, data: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    Pin(data).set("4821")
    desktop = opened()
    shell, locking = desktop.shell, desktop.data_protection.locking
    assert locking.is_locked
    assert visible_words(shell) & {"Linden 42", "Heron 17", "Patients"} == set()
    assert "Linden" not in shell.windowTitle()
    qtbot.keyClicks(locking.lock_screen.pin_field, "0000")
    qtbot.keyClick(locking.lock_screen.pin_field, Qt.Key.Key_Return)
    assert locking.is_locked
    assert "4 attempts left" in locking.lock_screen.error_text.text()
    for key in (Qt.Key.Key_Escape, Qt.Key.Key_F1):
        qtbot.keyClick(locking.lock_screen.pin_field, key)
    assert locking.is_locked
    with monkeypatch.context() as missing:
        missing.setitem(sys.modules, "argon2", None)
        qtbot.keyClicks(locking.lock_screen.pin_field, "4821")
        qtbot.keyClick(locking.lock_screen.pin_field, Qt.Key.Key_Return)
        assert locking.is_locked
        assert "argon2 is missing" in locking.lock_screen.error_text.text()
        assert locking.lock_screen.pin_field.isEnabled()
    qtbot.keyClicks(locking.lock_screen.pin_field, "4821")
    qtbot.keyClick(locking.lock_screen.pin_field, Qt.Key.Key_Return)
    assert not locking.is_locked
    assert "Patients" in visible_words(shell)
    done = [entry.action for entry in read_log(desktop.library.store)]
    assert done[-3:] == ["locked", "pin_refused", "unlocked"]

    assert 0 < locking.idle_timer.remainingTime() <= 11 * 60_000  # a coarse clock
    journey = desktop.controller
    journey.sessions.open(linden(desktop))
    journey.sessions.screen.rename_button.click()
    assert journey.sessions.screen.exercise_dialog.isVisible()
    monkeypatch.setattr(type(journey.live.screen.recording), "state", "recording")
    locking.lock_or_set_pin()
    locking.idle_timer.timeout.emit()
    assert not locking.is_locked
    assert 0 < locking.idle_timer.remainingTime() <= 66_000, "it waits for the recording to end"
    monkeypatch.setattr(type(journey.live.screen.recording), "state", "off")
    locking.idle_timer.timeout.emit()
    assert locking.is_locked
    assert "after 10 minutes" in locking.lock_screen.reason_text.text()
    assert not any("Linden" in word for word in visible_words(desktop.shell))
    locking.lock_screen.pin_entered.emit("4821")
    assert journey.sessions.screen.exercise_dialog.isVisible(), "what was open is open again"


def test_back_up_now_reminder_and_restore(
    qtbot: QtBot, opened: Open, data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    disk = tmp_path / "disk"
    desktop = opened(replace(Settings(), backup=BackupSettings(folder=str(disk))))
    backing, journey = desktop.data_protection.backing_up, desktop.controller
    strips = journey.patients.screen.findChildren(NoticeStrip)
    assert ["There is no backup yet." in strip.words.summary for strip in strips] == [True]
    disk.mkdir()
    backing.start_backup()
    qtbot.waitUntil(lambda: backing.last_backup is not None and backing.card.now_button.isEnabled())
    assert "The backup contains every session." in backing.card.headline.text()
    assert read_log(desktop.library.store)[-1].action == "backed_up"
    erased = linden(desktop)
    desktop.data_protection.erasing._records.erase(desktop.data_protection.erasing._records.plan_patient(erased))
    monkeypatch.setattr("PySide6.QtWidgets.QFileDialog.getExistingDirectory", lambda *_: str(disk))
    backing.card.restore_button.click()
    qtbot.waitUntil(lambda: journey.messages.is_busy)
    asked = " ".join(visible_words(desktop.shell))
    assert "Session files added: 0, changed: 0, removed: 0" in asked
    assert "deleted since then stay deleted: 1" in asked
    button = next(one for one in journey.messages.dialog.findChildren(QPushButton) if "Restore" in one.text())
    with monkeypatch.context() as patched:
        patched.setattr(journey.navigator, "is_recording", lambda: True)
        button.click()
        qtbot.waitUntil(lambda: backing.is_restored)
        assert desktop.shell.isVisible(), "a recording goes on"
    qtbot.waitUntil(lambda: desktop.is_closed)
    old = activate_restored(data, datetime(2026, 11, 20, 18, 0))
    assert old is not None, "what was there is kept"
    assert old.is_dir()
    with closing(DataFolder(data)) as restored:
        assert {one.pseudonym for one in restored.patients.search()} == {"Heron 17"}


def test_automatic_backup_runs_daily_and_not_during_recording(
    qtbot: QtBot, opened: Open, data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    disk = tmp_path / "disk"
    desktop = opened(replace(Settings(), backup=BackupSettings(folder=str(disk), hour=12)))
    backing = desktop.data_protection.backing_up
    today = datetime.now().astimezone().replace(hour=13)
    monkeypatch.setattr("carpus.ui.screens.records.backup._current_time", lambda: today)
    backing.run_if_due()
    assert not backing._is_running, "the disk is not there"
    disk.mkdir()
    monkeypatch.setattr(desktop.controller.navigator, "is_recording", lambda: True)
    backing.run_if_due()
    assert not backing._is_running
    monkeypatch.setattr(desktop.controller.navigator, "is_recording", lambda: False)
    backing.run_if_due()
    qtbot.waitUntil(lambda: backing.last_backup is not None and not backing._is_running)
    backing.run_if_due()
    assert not backing._is_running, "once a day"
    monkeypatch.setattr("carpus.ui.screens.records.backup._current_time", lambda: today + timedelta(days=1))
    backing.run_if_due()
    assert backing._is_running
    qtbot.waitUntil(lambda: not backing._is_running)


def test_garbage_is_collected_in_the_windows_thread_once_the_first_picture_is_there(opened: Open, qtbot: QtBot) -> None:
    frozen = gc.get_freeze_count()
    desktop = opened()
    qtbot.waitUntil(lambda: gc.get_freeze_count() > frozen + 1000, timeout=60_000)
    assert desktop.application.findChild(GarbageCollector) is not None
    assert not gc.isenabled(), "it would run in any thread"
    item = QObject()
    item.itself = item  # type: ignore[attr-defined]
    gone = weakref.ref(item)
    del item
    others: list[list[int]] = []
    qtbot.waitUntil(lambda: others.extend([] for _ in range(2000)) is None and gone() is None)


def test_pin_is_set_changed_and_removed_in_settings(qtbot: QtBot, opened: Open, data: Path) -> None:
    desktop = opened()
    locking = desktop.data_protection.locking
    locking.lock_or_set_pin()
    assert desktop.controller.place == "settings", "without a PIN the key leads to where one is set"
    sheet = locking.pin_dialog
    for new, again, is_set in (("4821", "4822", False), ("99", "99", False), ("4821", "4821", True)):
        locking.card.pin_button.click()
        sheet.form["new"].setText(new)
        sheet.form["repeated"].setText(again)
        sheet.save_button.click()
        assert Pin(data).is_set == is_set
        sheet.close_dialog()
    locking.card.pin_button.click()
    locking.pin_dialog.form["current"].setText("0000")
    locking.pin_dialog.remove_button.click()
    assert Pin(data).is_set
    locking.pin_dialog.form["current"].setText("4821")
    locking.pin_dialog.remove_button.click()
    assert not Pin(data).is_set


@pytest.mark.parametrize(("listed", "expected", "chosen"), [((), ["AB"], "AB"), ((Therapist("KB"),), ["KB"], "")])
def test_initials_of_earlier_settings_are_listed_but_not_those_of_a_removed_therapist(
    opened: Open, data: Path, listed: tuple[Therapist, ...], expected: list[str], chosen: str
) -> None:
    with closing(DataFolder(data)) as library:
        save_therapists(library.store, listed)
    desktop = opened(Settings(recording=RecordingSettings(folder=str(data)), report=ReportSettings(therapist="AB")))
    assert [one.initials for one in read_therapists(desktop.library.store)] == expected
    assert desktop.preferences.settings.report.therapist == chosen


def test_lock_hides_names_and_asks_who_works(opened: Open, data: Path, tmp_path: Path, qtbot: QtBot) -> None:
    with closing(DataFolder(data)) as library:
        save_therapists(library.store, [Therapist("AB"), Therapist("KB", "Katrin Berger")])
    Pin(data).set("1234")
    desktop = opened(Settings(recording=RecordingSettings(folder=str(data)), report=ReportSettings(therapist="AB")))
    lock, bar = desktop.data_protection.locking.lock_screen, desktop.shell.top_bar
    assert (lock.isVisible(), lock.therapist.currentData()) == (True, "AB")
    lock.therapist.choose("KB")
    lock.pin_field.setText("1234")
    lock.unlock_button.click()
    assert not lock.isVisible()
    assert [(one.action, one.initials) for one in read_log(desktop.library.store)][-1] == ("unlocked", "KB")
    assert bar.therapist_button.text() == "KB"
    assert load_valid_settings(tmp_path / "settings")[0].report.therapist == "KB", "it is kept"
    desktop.controller.patients.screen.refresh(linden(desktop))
    for hides in (True, False):
        words = " ".join(visible_words(desktop.shell))
        assert ("Linden 42" in words, "Erika Mustermann" in words) == (True, not hides)
        desktop.controller.navigator.open_screen("progress", linden(desktop))
        assert ("Erika" in bar.patient_name.text()) is not hides
        desktop.controller.navigator.open_screen("patients", linden(desktop))
        bar.names_button.click()
