"""Back-ups by themselves and when told, the reminder, and the way back from one."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from datetime import datetime
from functools import partial
from pathlib import Path
from typing import TypeVar

from PySide6.QtCore import QObject, QStandardPaths, QTimer, Signal
from PySide6.QtWidgets import QFileDialog, QLineEdit, QVBoxLayout, QWidget

from carpus.core.disks import on_same_disk
from carpus.core.errors import BackupMissing
from carpus.core.names import is_passphrase
from carpus.core.records.backup import (
    Backup,
    Content,
    RestorePlan,
    back_up,
    backups,
    content_of,
    is_due,
    plan_restore,
    restore,
    thin_out,
)
from carpus.core.records.of_clinic import LastBackup, last_backup, note_backup
from carpus.core.records.sealed import ENDING, open_sealed, seal_backup
from carpus.core.records.staging import Staged
from carpus.core.records.values import BackupSettings
from carpus.core.words import Words
from carpus.ui import numbers
from carpus.ui.background import Background
from carpus.ui.controls.button import Button
from carpus.ui.controls.field import Labelled
from carpus.ui.controls.layouts import fill
from carpus.ui.controls.sheet import Sheet
from carpus.ui.controls.text import SEMIBOLD, Text
from carpus.ui.flow import ScreenContext
from carpus.ui.messages.messages import Answer
from carpus.ui.records.cards import BackupCard, BackupFacts
from carpus.ui.theme import Theme
from carpus.ui.translate import tr

LOOK_MS = 60_000
T = TypeVar("T")


class BackingUp(QObject):
    """``stepped`` carries the percent done, from another thread."""

    stepped = Signal(int)

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
        self.restored: Staged | None = None
        """A back-up that lies beside the data folder and takes its place when the window has closed."""
        self.card = BackupCard(context.theme, settings.hour)
        self.card.now_button.clicked.connect(self.back_up)
        self.card.restore_button.clicked.connect(self.ask_restore)
        self.card.seal_button.clicked.connect(self.seal)
        self.card.unseal_button.clicked.connect(self.ask_restore_sealed)
        self.passphrase = PassphraseSheet(context.shell.stage, context.theme)
        self.card.place_button.clicked.connect(self._choose_place)
        self.card.hours.chosen.connect(lambda hour: self._change(BackupSettings(self._settings.folder, hour)))
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

        self._background.run(lambda: last_backup(store), show, self._context.messages.fault, self)

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
        self.last = last_backup(self._library.store)
        if not self.is_old():
            return
        facts = self._facts()
        words = Words(facts.headline, facts.detail, self.tr("Plug the disk for back-ups in, and back up."))
        to_settings = partial(self._context.way.show, "settings", "safety")
        self._context.messages.strip(place, words, self.tr("To the settings"), to_settings)

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
        made = back_up(
            self._library.folder,
            place,
            software_version=self._context.version,
            sessions=self._library.store.sessions_folder,
            settings_folder=self._settings_folder,
            progress=self._step,
        )
        note_backup(self._library.store, made.made, str(place), made.sessions, made.size_bytes)
        self._library.notes.program("backed_up", sessions=made.sessions)
        thin_out(place, settings.keep, settings.months, _now())
        return made

    def _step(self, done: int, total: int) -> None:
        self.stepped.emit(100 * done // total)

    def _done(self, _: Backup) -> None:
        self._end()
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
            self._change(BackupSettings(folder, self._settings.hour))
        return bool(folder)

    def _change(self, settings: BackupSettings) -> None:
        self._settings = settings
        self._keep(settings)
        self.card.show_facts(self._facts())

    # --- the way back -------------------------------------------------------------------------------------
    def ask_restore(self) -> None:
        """Choose a folder with back-ups; what the newest would change is shown first."""
        title = self.tr("Folder that holds the back-ups")
        folder = QFileDialog.getExistingDirectory(self.card.window(), title, self._settings.folder)
        if folder:
            self._read(lambda: _newest(Path(folder)))

    def ask_restore_sealed(self) -> None:
        title = self.tr("Sealed back-up")
        folder = str(_sealed_in(self._settings.folder))
        name, _ = QFileDialog.getOpenFileName(self.card.window(), title, folder, self.tr("Sealed files (*.age)"))
        if name:
            self.passphrase.begin(lambda typed: self._read(lambda: open_sealed(Path(name), typed)), seals=False)

    def _read(self, found: Callable[[], tuple[Backup, Content]]) -> None:
        """A back-up, and what it would change; then it is asked about."""

        def read() -> tuple[Backup, Content, RestorePlan]:
            backup, content = found()
            return backup, content, plan_restore(backup, self._library.folder)

        self._background.run(read, lambda known: self._ask(*known), self._failed, self)

    def _ask(self, backup: Backup, content: Content, plan: RestorePlan) -> None:
        what = self.tr(
            "Restore the back-up of {when}? Session files added: {come}, changed: {change}, taken away: {go}."
        )
        when = numbers.report_date(backup.made.astimezone())
        self._context.messages.ask(
            Words(
                what.format(when=when, come=len(plan.added), change=len(plan.replaced), go=len(plan.lost)),
                self.tr("The folder of what is here now is kept beside the new one."),
                self.tr("Carpus closes when it is done. Start it again then."),
            ),
            (
                Answer(self.tr("Restore it"), lambda: self._restore(backup, content), "R", risky=True),
                Answer(self.tr("Leave it as it is"), lambda: None),
            ),
            icon="rotate-ccw",
        )

    def _restore(self, backup: Backup, content: Content) -> None:
        if self._running:
            return

        def work() -> Staged:
            staged = restore(backup, content, self._library.folder, progress=self._step, replaces=True)
            self._library.notes.program("restored", sessions=backup.sessions)
            return staged

        def done(staged: Staged) -> None:
            self._running = False
            self.restored = staged
            self._context.shell.close_surely()

        self._begin(work, done)

    # --- as one file --------------------------------------------------------------------------------------
    def seal(self) -> None:
        """Everything as one file with a passphrase, to be carried away."""
        if self._running:
            return
        name = str(_sealed_in(self._settings.folder) / f"carpus-{_now():%Y-%m-%d}{ENDING}")
        title = self.tr("Seal into one file")
        chosen, _ = QFileDialog.getSaveFileName(self.card.window(), title, name, self.tr("Sealed files (*.age)"))
        if chosen:
            self.passphrase.begin(lambda typed: self._seal(Path(chosen), typed), seals=True)

    def _seal(self, chosen: Path, passphrase: str) -> None:
        path = chosen if chosen.suffix == Path(ENDING).suffix else chosen.with_name(f"{chosen.name}{ENDING}")
        self.card.show_sealed("")

        def work() -> Backup:
            if path == chosen:
                path.unlink(missing_ok=True)  # the dialog has asked
            made = seal_backup(
                self._library.folder, path, passphrase, software_version=self._context.version,
                sessions=self._library.store.sessions_folder, settings_folder=self._settings_folder,
                progress=self._step,
            )  # fmt: skip
            self._library.notes.program("backed_up", sessions=made.sessions, sealed=1)
            return made

        def done(made: Backup) -> None:
            self._done(made)
            words = self.tr("Sealed: {name}, {size} MB. Whoever has the passphrase can open it.")
            size = numbers.fixed(path.stat().st_size / 1e6, 1)
            self.card.show_sealed(words.format(name=path.name, size=size))

        self._begin(work, done)


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
            place_words = tr("{free} GB free").format(free=f"{free:.0f}")
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
        size = numbers.fixed(last.size_bytes / 1e9, 2) if last.size_bytes < 1e10 else f"{last.size_bytes / 1e9:.0f}"
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


def _newest(place: Path) -> tuple[Backup, Content]:
    there = backups(place)
    if not there:
        raise BackupMissing(place)
    return there[0], content_of(place)


def _sealed_in(folder: str) -> Path:
    """Where a sealed file is looked for: beside the back-ups, else where a person keeps documents."""
    documents = QStandardPaths.writableLocation(QStandardPaths.StandardLocation.DocumentsLocation)
    return Path(folder) if folder and Path(folder).is_dir() else Path(documents)


class PassphraseSheet(Sheet):
    """Asks, and hands what was typed to whoever asked."""

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 560)
        self.head()
        self.first, self.again = QLineEdit(), QLineEdit()
        for line in (self.first, self.again):
            line.setEchoMode(QLineEdit.EchoMode.Password)
        self._again_row = Labelled(theme, self.tr("The same &again"), self.again)
        self.said = Text(theme, "", 14, SEMIBOLD, "bad", wrap=True)
        self.go = Button(theme, "", "primary")
        self.go.clicked.connect(self._take)
        fill(self.card.body, Labelled(theme, self.tr("&Passphrase"), self.first), self._again_row, self.said)
        self.answer_row(self.go, gap=None)
        self._chosen: Callable[[str], None] = lambda _: None
        self._seals = True

    def begin(self, chosen: Callable[[str], None], *, seals: bool) -> None:
        self._chosen, self._seals = chosen, seals
        self.title.setText(self.tr("Seal into one file") if seals else self.tr("Open the sealed file"))
        self.go.set_face(self.tr("Seal it") if seals else self.tr("Open it"))
        self.words.setText(
            self.tr("Ten signs or more, best four words. Write it down: without it nobody can open the file.")
            if seals
            else self.tr("As it was typed when the file was sealed.")
        )
        self._again_row.setVisible(seals)
        for line in (self.first, self.again):
            line.clear()
        self.said.hide()
        self.open(self.first)

    def _take(self) -> None:
        typed = self.first.text()
        words = ""
        if self._seals and not is_passphrase(typed):
            words = self.tr("A passphrase has ten signs or more.")
        elif self._seals and typed != self.again.text():
            words = self.tr("The two are not the same.")
        self.said.say(words)
        if not words and typed:
            self.first.clear()
            self.again.clear()
            self.close_sheet()
            self._chosen(typed)
