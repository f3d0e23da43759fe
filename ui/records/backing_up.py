"""Back-ups by themselves and when told, the reminder, and the way back from one."""

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

from carpus.core.disks import on_same_disk
from carpus.core.errors import BackupMissing
from carpus.core.records.backup import (
    Backup,
    back_up,
    backups,
    is_due,
    thin_out,
)
from carpus.core.records.of_clinic import LastBackup, last_backup, note_backup
from carpus.core.records.restoring import RestorePlan, plan_restore, read_past, restore
from carpus.core.records.values import BackupSettings, unless_away
from carpus.core.rounding import written
from carpus.core.words import Words
from carpus.ui import numbers
from carpus.ui.background import Background
from carpus.ui.flow import ScreenContext
from carpus.ui.messages.messages import Answer
from carpus.ui.records.cards import BackupCard, BackupFacts
from carpus.ui.sessions.sheets import ChooseSheet
from carpus.ui.translate import tr

LOOK_MS = 60_000
T = TypeVar("T")


class BackingUp(QObject):
    """``stepped`` carries the percent done, from another thread."""

    stepped = Signal(int)
    backed_up = Signal()

    def __init__(
        self,
        context: ScreenContext,
        settings: BackupSettings,
        settings_folder: Path,
        *,
        keep: Callable[[BackupSettings], None],
    ) -> None:
        super().__init__(context.shell)
        self._context, self._library, self._settings = context, context.library, settings
        self._settings_folder, self._keep = settings_folder, keep
        self._background = Background()  # its own: a back-up of gigabytes holds up nothing else
        self._running = False
        self.last: LastBackup | None = None
        self.restored = False
        """Whether a back-up lies beside the data folder, which takes its place when the window has closed."""
        self._there: tuple[Path, dict[str, Backup]] = (Path(), {})
        self.choice = ChooseSheet(context.shell.stage, context.theme)
        self.choice.chosen.connect(self._plan)
        self.card = BackupCard(context.theme, settings.hour)
        self.card.now_button.clicked.connect(self.back_up)
        self.card.restore_button.clicked.connect(self.ask_restore)
        self.card.place_button.clicked.connect(self._choose_place)
        self.card.hours.chosen.connect(lambda hour: self._change(replace(self._settings, hour=hour)))
        self.stepped.connect(self.card.show_progress)
        self._clock = QTimer(self, interval=LOOK_MS)
        self._clock.timeout.connect(self.look)
        self._clock.start()
        self.look_again()

    @property
    def is_at_work(self) -> bool:
        return self._background.busy

    def end(self) -> None:
        """The window closes; a back-up that runs is waited for."""
        self._clock.stop()
        self._background.wait(600_000)

    def look_again(self) -> None:
        store = self._library.store

        def show(last: LastBackup | None) -> None:
            self.last = last
            self.card.show_facts(self._facts())

        self._background.run(
            lambda: unless_away(lambda: last_backup(store), None), show, self._context.messages.fault, self
        )

    def _facts(self) -> BackupFacts:
        return backup_facts(self.last, self._settings, self._library.folder, _now(), can_back_up=not self._running)

    def is_old(self) -> bool:
        """Whether a person should be reminded: back-ups are wanted, there is something to lose, and the last one is old
        or not there yet."""
        if self.last is None and not self._settings.folder:
            return False  # nobody has asked for back-ups; the settings say that there is none
        sessions = sum(record.session_count for record in self._library.patients.listed())
        return sessions > 0 and is_due(self.last.made if self.last else None, self._settings.remind_days, _now())

    def remind(self, place: QVBoxLayout) -> None:
        """A strip above the patients, once at the start, where the last back-up is old."""
        self.last = unless_away(lambda: last_backup(self._library.store), None)
        if self._library.store.is_away or not self.is_old():
            return
        facts = self._facts()
        words = Words(facts.headline, facts.detail, self.tr("Plug the disk for back-ups in, and back up."))
        to_settings = partial(self._context.way.show, "settings", "safety")
        strip = self._context.messages.strip(place, words, self.tr("To the settings"), to_settings)
        self.backed_up.connect(strip.later)

    def look(self) -> None:
        settings, now = self._settings, _now()
        if settings.hour < 0 or not settings.folder or now.hour < settings.hour or self._context.way.is_recording():
            return
        if self.last is not None and self.last.made.astimezone(now.tzinfo).date() >= now.date():
            return
        if Path(settings.folder).is_dir():
            self.back_up()

    def back_up(self) -> None:
        """Now, beside whatever the window does. Without a folder it is asked for first, and then backed up to."""
        if self._running or not (self._settings.folder or self._choose_place()):
            return
        place, settings = Path(self._settings.folder), self._settings
        self._begin(lambda: self._work(place, settings), self._done)

    def _begin(self, work: Callable[[], T], done: Callable[[T], None]) -> None:
        """One thing at a time; not niced: a thread shares the program's priority."""
        self._running = True
        self.card.show_progress(0)
        self._background.run(work, done, self._failed, self)

    def _work(self, place: Path, settings: BackupSettings) -> Backup:
        store = self._library.store
        made = back_up(
            self._library.folder,
            place,
            sessions=store.sessions_folder,
            copy=store.copied if store.server is not None else None,
            settings_folder=self._settings_folder,
            progress=self._step,
        )
        note_backup(store, made.made, str(place), made.sessions, made.size_bytes)
        self._library.notes.program("backed_up", sessions=made.sessions)
        thin_out(place, settings.keep, settings.months, _now())
        return made

    def _step(self, done: int, total: int) -> None:
        self.stepped.emit(100 * done // total)

    def _done(self, _: Backup) -> None:
        self._end()
        self.backed_up.emit()
        self.look_again()

    def _failed(self, fault: Exception) -> None:
        self._end()
        self._context.messages.fault(fault)

    def _end(self) -> None:
        self._running = False
        self.card.show_progress(None)

    def _choose_place(self) -> bool:
        """Ask for the folder; whether one was chosen."""
        title = self.tr("Folder for back-ups, on another disk")
        folder = QFileDialog.getExistingDirectory(self.card.window(), title, self._settings.folder)
        if folder:
            self._change(replace(self._settings, folder=folder))
        return bool(folder)

    def _change(self, settings: BackupSettings) -> None:
        self._settings = settings
        self._keep(settings)
        self.card.show_facts(self._facts())

    # --- the way back -------------------------------------------------------------------------------------
    def ask_restore(self) -> None:
        """Choose a folder with back-ups and one of them; what it would change is shown first."""
        title = self.tr("Folder that holds the back-ups")
        folder = QFileDialog.getExistingDirectory(self.card.window(), title, self._settings.folder)
        if folder:
            place = Path(folder)
            self._background.run(
                lambda: _backups_of(place), lambda there: self._choose_backup(place, there), self._failed, self
            )

    def _choose_backup(self, place: Path, there: Sequence[Backup]) -> None:
        self._there = (place, {one.name: one for one in there})
        if len(there) == 1:
            self._plan(there[0].name)
            return
        line = self.tr("{when}: {n} session files")
        self.choice.begin(
            self.tr("Which back-up is to be restored?"),
            self.tr("What it changes is shown before anything is done."),
            self.tr("Restore…"),
            [(one.name, line.format(when=numbers.report_date(one.made.astimezone()), n=one.sessions)) for one in there],
        )

    def _plan(self, name: str) -> None:
        """What a back-up would change; then it is asked about."""
        (place, there), library = self._there, self._library
        backup = there[name]

        def read() -> RestorePlan:
            return plan_restore(backup, place, library.folder, read_past(place, library.store))

        self._background.run(read, lambda plan: self._ask(place, backup, plan), self._failed, self)

    def _ask(self, place: Path, backup: Backup, plan: RestorePlan) -> None:
        what = self.tr(
            "Restore the back-up of {when}? Session files added: {come}, changed: {change}, taken away: {go}."
        )
        when = numbers.report_date(backup.made.astimezone())
        happened = what.format(when=when, come=len(plan.added), change=len(plan.replaced), go=len(plan.lost))
        if plan.erased:
            stays = self.tr("Patients and sessions that were erased since then stay erased: {n}.").format(n=plan.erased)
            happened = f"{happened} {stays}"
        self._context.messages.ask(
            Words(
                happened,
                self.tr("The folder of what is here now is kept beside the new one."),
                self.tr("Carpus closes when it is done. Start it again then."),
            ),
            (
                Answer(self.tr("Restore it"), lambda: self._restore(place, backup), "R", risky=True),
                Answer(self.tr("Leave it as it is"), lambda: None),
            ),
            icon="rotate-ccw",
        )

    def _restore(self, place: Path, backup: Backup) -> None:
        if self._running:
            return
        folder, store = self._library.folder, self._library.store

        def work() -> int:
            return restore(backup, place, folder, read_past(place, store), progress=self._step, replaces=True)

        def done(_: int) -> None:
            self._running = False
            self.restored = True
            self._close_when_idle()

        self._begin(work, done)

    def _close_when_idle(self) -> None:
        """No recording is ended for it."""
        if self._context.way.is_recording():
            QTimer.singleShot(LOOK_MS // 60, self, self._close_when_idle)
        else:
            self._context.shell.close_surely()


def _now() -> datetime:
    return datetime.now().astimezone()


def backup_facts(
    last: LastBackup | None, settings: BackupSettings, data_folder: Path, now: datetime, *, can_back_up: bool
) -> BackupFacts:
    """How it stands, in words."""
    place = settings.folder
    there = bool(place) and Path(place).is_dir()
    place_words, place_state = tr("not chosen yet"), "none"
    if place:
        place_state = "good" if there else "warn"
        place_words = tr("not there now")
        if there:
            free = shutil.disk_usage(place).free / 1e9
            place_words = tr("{free} GB free").format(free=written(free))
            if on_same_disk(Path(place), data_folder):
                place_state, place_words = "warn", tr("on the same disk as the data")
    if last is None:
        headline, detail, more = tr("There is no back-up yet."), "", ""
        old, beside = True, False
    else:
        days = (now.date() - last.made.astimezone(now.tzinfo).date()).days
        age = numbers.days_ago(last.made.astimezone(now.tzinfo), now.date())
        missing = {0: tr("Every session is in it."), 1: tr("1 session file is not in it.")}
        rest = missing.get(last.missing, tr("{n} session files are not in it.").format(n=last.missing))
        old = is_due(last.made, settings.remind_days, now)
        beside = on_same_disk(Path(last.place), data_folder)
        first = tr("The last back-up is {days} days old.").format(days=days)
        headline = f"{first if days > 1 else tr('The last back-up is of {day}.').format(day=age)} {rest}"
        facts = tr("{when} · {n} session files, {size} GB · read back and compared: all equal")
        if last.sessions == 1:
            facts = tr("{when} · 1 session file, {size} GB · read back and compared: all equal")
        size = numbers.fixed(last.size_bytes / 1e9, 2) if last.size_bytes < 1e10 else written(last.size_bytes / 1e9)
        detail = facts.format(when=numbers.report_date(last.made.astimezone()), n=last.sessions, size=size)
        more = tr("Reminder after {days} days.").format(days=settings.remind_days)
        if beside:
            more = tr("It lies on the disk that holds the data: if that disk breaks, both are lost.")
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


def _backups_of(place: Path) -> Sequence[Backup]:
    there = backups(place)
    if not there:
        raise BackupMissing(place)
    return there
