"""Automatic and manual backups, the reminder, and restoring."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Sequence
from dataclasses import replace
from datetime import datetime
from functools import partial
from pathlib import Path
from typing import TypeVar

from PySide6.QtCore import QObject, QTimer, Signal
from PySide6.QtWidgets import QFileDialog, QVBoxLayout

from carpus.core.model.errors import BackupMissing
from carpus.core.model.fault_text import MessageText
from carpus.core.model.rounding import format_rounded
from carpus.core.platform.disks import is_same_disk
from carpus.core.records.backup import Backup, create_backup, is_backup_due, list_backups, prune_backups
from carpus.core.records.clinic_records import BackupRecord, read_last_backup, save_backup_record
from carpus.core.records.restoring import RestorePlan, plan_restore, read_history, restore
from carpus.core.records.values import BackupSettings, read_or_default
from carpus.ui.kit import numbers
from carpus.ui.kit.background import Background
from carpus.ui.kit.translate import tr
from carpus.ui.screens.records.cards import BackupCard, BackupFacts
from carpus.ui.screens.sessions.dialogs import ChoiceDialog
from carpus.ui.shell.flow import ScreenContext
from carpus.ui.shell.messages import Answer

CHECK_INTERVAL_MS = 60_000
T = TypeVar("T")


class BackupController(QObject):
    """Controller of backups.

    Signals: ``progress_changed`` with the percent done, from another thread; ``backup_finished``.
    """

    progress_changed = Signal(int)
    backup_finished = Signal()

    def __init__(
        self,
        context: ScreenContext,
        settings: BackupSettings,
        settings_folder: Path,
        *,
        save_settings: Callable[[BackupSettings], None],
    ) -> None:
        super().__init__(context.window)
        self._context, self._library, self._settings = context, context.library, settings
        self._settings_folder, self._save_settings = settings_folder, save_settings
        self._background = Background()  # a backup of gigabytes must not delay other tasks
        self._is_running = False
        self.last_backup: BackupRecord | None = None
        self.is_restored = False
        """Whether a restored folder lies next to the data folder and replaces it after closing."""
        self._available_backups: tuple[Path, dict[str, Backup]] = (Path(), {})
        self.choice_dialog = ChoiceDialog(context.window.screen_stack, context.theme)
        self.choice_dialog.chosen.connect(self._plan_restore)
        self.card = BackupCard(context.theme, settings.hour)
        self.card.now_button.clicked.connect(self.start_backup)
        self.card.restore_button.clicked.connect(self.choose_restore_folder)
        self.card.folder_button.clicked.connect(self._choose_folder)
        self.card.schedule.chosen.connect(lambda hour: self._apply_settings(replace(self._settings, hour=hour)))
        self.progress_changed.connect(self.card.show_progress)
        self._clock = QTimer(self, interval=CHECK_INTERVAL_MS)
        self._clock.timeout.connect(self.run_if_due)
        self._clock.start()
        self.refresh()

    @property
    def is_busy(self) -> bool:
        return self._background.is_busy

    def shut_down(self) -> None:
        """Wait for a running backup."""
        self._clock.stop()
        self._background.join(600_000)

    def refresh(self) -> None:
        store = self._library.store

        def show_last(last: BackupRecord | None) -> None:
            self.last_backup = last
            self.card.show_facts(self._facts())

        self._background.run(
            lambda: read_or_default(lambda: read_last_backup(store), None),
            show_last,
            self._context.messages.show_fault,
            self,
        )

    def _facts(self) -> BackupFacts:
        return backup_facts(
            self.last_backup, self._settings, self._library.folder, _current_time(), can_back_up=not self._is_running
        )

    def is_overdue(self) -> bool:
        """Return whether to remind: backups are wanted, there are sessions, and the last backup is old or missing."""
        if self.last_backup is None and not self._settings.folder:
            return False  # backups were never set up; the settings say so
        sessions = sum(record.session_count for record in self._library.patients.search())
        return sessions > 0 and is_backup_due(
            self.last_backup.made if self.last_backup else None, self._settings.remind_days, _current_time()
        )

    def show_reminder(self, layout: QVBoxLayout) -> None:
        """Show a notice above the patients if the last backup is old."""
        self.last_backup = read_or_default(lambda: read_last_backup(self._library.store), None)
        if self._library.store.is_server_away or not self.is_overdue():
            return
        facts = self._facts()
        words = MessageText(facts.headline, facts.detail, self.tr("Connect the backup disk and back up."))
        to_settings = partial(self._context.navigator.open_screen, "settings", "safety")
        strip = self._context.messages.show_notice(layout, words, self.tr("Open settings"), to_settings)
        self.backup_finished.connect(strip.postponed)

    def run_if_due(self) -> None:
        settings, now = self._settings, _current_time()
        if (
            settings.hour < 0
            or not settings.folder
            or now.hour < settings.hour
            or self._context.navigator.is_recording()
        ):
            return
        if self.last_backup is not None and self.last_backup.made.astimezone(now.tzinfo).date() >= now.date():
            return
        if Path(settings.folder).is_dir():
            self.start_backup()

    def start_backup(self) -> None:
        """Back up in the background; ask for the folder first if there is none."""
        if self._is_running or not (self._settings.folder or self._choose_folder()):
            return
        place, settings = Path(self._settings.folder), self._settings
        self._start_task(lambda: self._create_backup(place, settings), self._on_backup_finished)

    def _start_task(self, work: Callable[[], T], on_done: Callable[[T], None]) -> None:
        """Run one task at a time. It is not niced, because a thread shares the program's priority."""
        self._is_running = True
        self.card.show_progress(0)
        self._background.run(work, on_done, self._on_failed, self)

    def _create_backup(self, folder: Path, settings: BackupSettings) -> Backup:
        store = self._library.store
        made = create_backup(
            self._library.folder,
            folder,
            sessions_folder=store.sessions_folder,
            copy_store=store.copy_to_memory if store.server is not None else None,
            settings_folder=self._settings_folder,
            progress=self._report_progress,
        )
        save_backup_record(store, made.made, str(folder), made.session_count, made.size_bytes)
        self._library.audit_log.log_program("backed_up", sessions=made.session_count)
        prune_backups(folder, settings.keep, settings.months, _current_time())
        return made

    def _report_progress(self, done: int, total: int) -> None:
        self.progress_changed.emit(100 * done // total)

    def _on_backup_finished(self, _: Backup) -> None:
        self._finish_task()
        self.backup_finished.emit()
        self.refresh()

    def _on_failed(self, fault: Exception) -> None:
        self._finish_task()
        self._context.messages.show_fault(fault)

    def _finish_task(self) -> None:
        self._is_running = False
        self.card.show_progress(None)

    def _choose_folder(self) -> bool:
        """Ask for the folder; return whether one was chosen."""
        title = self.tr("Backup folder, on another disk")
        folder = QFileDialog.getExistingDirectory(self.card.window(), title, self._settings.folder)
        if folder:
            self._apply_settings(replace(self._settings, folder=folder))
        return bool(folder)

    def _apply_settings(self, settings: BackupSettings) -> None:
        self._settings = settings
        self._save_settings(settings)
        self.card.show_facts(self._facts())

    # --- the way back -------------------------------------------------------------------------------------
    def choose_restore_folder(self) -> None:
        """Ask for a folder with backups, then for one of them; its changes are shown first."""
        title = self.tr("Folder with the backups")
        folder = QFileDialog.getExistingDirectory(self.card.window(), title, self._settings.folder)
        if folder:
            place = Path(folder)
            self._background.run(
                lambda: _list_backups(place), lambda found: self._choose_backup(place, found), self._on_failed, self
            )

    def _choose_backup(self, folder: Path, found: Sequence[Backup]) -> None:
        self._available_backups = (folder, {one.name: one for one in found})
        if len(found) == 1:
            self._plan_restore(found[0].name)
            return
        line = self.tr("{when}: {n} session files")
        self.choice_dialog.request_choice(
            self.tr("Which backup should be restored?"),
            self.tr("Carpus shows the changes before it restores anything."),
            self.tr("Restore…"),
            [
                (one.name, line.format(when=numbers.format_date_time(one.made.astimezone()), n=one.session_count))
                for one in found
            ],
        )

    def _plan_restore(self, name: str) -> None:
        """Find out what a backup would change, then ask."""
        (folder, backups), library = self._available_backups, self._library
        backup = backups[name]

        def make_plan() -> RestorePlan:
            return plan_restore(backup, folder, library.folder, read_history(folder, library.store))

        self._background.run(make_plan, lambda plan: self._confirm_restore(folder, backup, plan), self._on_failed, self)

    def _confirm_restore(self, folder: Path, backup: Backup, plan: RestorePlan) -> None:
        what = self.tr("Restore the backup of {when}? Session files added: {come}, changed: {change}, removed: {go}.")
        when = numbers.format_date_time(backup.made.astimezone())
        happened = what.format(when=when, come=len(plan.added), change=len(plan.replaced), go=len(plan.removed))
        if plan.erased_count:
            stays = self.tr("Patients and sessions deleted since then stay deleted: {n}.").format(n=plan.erased_count)
            happened = f"{happened} {stays}"
        self._context.messages.show_question(
            MessageText(
                happened,
                self.tr("The current data folder is kept next to the restored one."),
                self.tr("Carpus closes afterwards. Start it again then."),
            ),
            (
                Answer(self.tr("Restore"), lambda: self._restore(folder, backup), "R", is_risky=True),
                Answer(self.tr("Cancel"), lambda: None),
            ),
            icon="rotate-ccw",
        )

    def _restore(self, backup_folder: Path, backup: Backup) -> None:
        if self._is_running:
            return
        folder, store = self._library.folder, self._library.store

        def work() -> int:
            known = read_history(backup_folder, store)
            return restore(backup, backup_folder, folder, known, progress=self._report_progress, overwrite=True)

        def on_restored(_: int) -> None:
            self._is_running = False
            self.is_restored = True
            self._close_when_idle()

        self._start_task(work, on_restored)

    def _close_when_idle(self) -> None:
        """Close the window once no recording is running."""
        if self._context.navigator.is_recording():
            QTimer.singleShot(CHECK_INTERVAL_MS // 60, self, self._close_when_idle)
        else:
            self._context.window.close_without_prompt()


def _current_time() -> datetime:
    return datetime.now().astimezone()


def backup_facts(
    last: BackupRecord | None, settings: BackupSettings, data_folder: Path, now: datetime, *, can_back_up: bool
) -> BackupFacts:
    """Return the state of backups in words."""
    place = settings.folder
    there = bool(place) and Path(place).is_dir()
    place_words, place_state = tr("not chosen yet"), "none"
    if place:
        place_state = "good" if there else "warn"
        place_words = tr("not connected")
        if there:
            free = shutil.disk_usage(place).free / 1e9
            place_words = tr("{free} GB free").format(free=format_rounded(free))
            if is_same_disk(Path(place), data_folder):
                place_state, place_words = "warn", tr("on the same disk as the data")
    if last is None:
        headline, detail, more = tr("There is no backup yet."), "", ""
        old, beside = True, False
    else:
        days = (now.date() - last.made.astimezone(now.tzinfo).date()).days
        age = numbers.format_days_ago(last.made.astimezone(now.tzinfo), now.date())
        missing = {0: tr("The backup contains every session."), 1: tr("1 session file is missing from the backup.")}
        rest = missing.get(
            last.later_sessions, tr("{n} session files are missing from the backup.").format(n=last.later_sessions)
        )
        old = is_backup_due(last.made, settings.remind_days, now)
        beside = is_same_disk(Path(last.place), data_folder)
        first = tr("The last backup is {days} days old.").format(days=days)
        headline = f"{first if days > 1 else tr('Last backup: {day}.').format(day=age)} {rest}"
        facts = tr("{when} · {n} session files, {size} GB · verified")
        if last.sessions == 1:
            facts = tr("{when} · 1 session file, {size} GB · verified")
        size = (
            numbers.format_fixed(last.size_bytes / 1e9, 2)
            if last.size_bytes < 1e10
            else format_rounded(last.size_bytes / 1e9)
        )
        detail = facts.format(when=numbers.format_date_time(last.made.astimezone()), n=last.sessions, size=size)
        more = tr("Reminder after {days} days.").format(days=settings.remind_days)
        if beside:
            more = tr("The backup is on the same disk as the data. If that disk fails, both are lost.")
    return BackupFacts(
        "warn" if old or beside else "good",
        headline,
        detail,
        more,
        place,
        place_state,  # type: ignore[arg-type]
        place_words,
        can_back_up,
    )


def _list_backups(folder: Path) -> Sequence[Backup]:
    there = list_backups(folder)
    if not there:
        raise BackupMissing(folder)
    return there
