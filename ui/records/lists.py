"""What is due, the archive and the log, from the settings."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeVar

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtWidgets import QAbstractItemView, QTableWidget, QTableWidgetItem, QWidget

from carpus.core.records.keeping import RETENTION_YEARS, Archived, Due, Records
from carpus.core.records.log import LoggedDeed
from carpus.ui import numbers, terms
from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Line
from carpus.ui.controls.layouts import ScrollArea, ScrolledColumn, empty, fill, host_of, in_column, in_line
from carpus.ui.controls.sheet import Sheet
from carpus.ui.controls.text import MEDIUM, REGULAR, Text
from carpus.ui.flow import ScreenContext
from carpus.ui.fonts import font
from carpus.ui.patients.screen import PatientsScreen
from carpus.ui.records.cards import RecordsCard
from carpus.ui.records.erasing import Erasing
from carpus.ui.sessions.screen import SessionsScreen
from carpus.ui.theme import Theme

T = TypeVar("T")


def _everything(_: Archived) -> bool:
    return True


class RecordLists(QObject):
    """Each list is read when it is asked for."""

    def __init__(
        self,
        context: ScreenContext,
        records: Records,
        erasing: Erasing,
        sessions: Callable[[], SessionsScreen],
        patients: PatientsScreen,
        *,
        years: int,
        keep_years: Callable[[int], None],
    ) -> None:
        super().__init__(context.shell)
        self._context, self._records, self._erasing = context, records, erasing
        self.years, self._keep_years = years, keep_years
        self._sessions: dict[str, str] = {}
        self._shown: Callable[[Archived], bool] = _everything
        self.card = RecordsCard(context.theme, years, RETENTION_YEARS)
        self.sheet = RecordsSheet(context.shell.stage, context.theme)
        self.log_sheet = LogSheet(context.shell.stage, context.theme)
        self.card.years.chosen.connect(self._take_years)
        self.card.due_button.clicked.connect(self.show_due)
        self.card.archive_button.clicked.connect(lambda: self.show_archive())
        patients.archive_button.clicked.connect(lambda: self.show_archive(lambda one: one.recorded is None))
        context.way.when_made("sessions", lambda: sessions().archive_wanted.connect(self._show_archive_of))
        self.card.log_button.clicked.connect(self.show_log)
        self.sheet.back_wanted.connect(self._bring_back)
        self.sheet.archive_wanted.connect(self._archive)
        self.sheet.erase_wanted.connect(self._erase)

    def _take_years(self, years: int) -> None:
        self.years = years
        self._keep_years(years)

    def _run(self, work: Callable[[], T], done: Callable[[T], None]) -> None:
        self._context.background.run(work, done, self._context.messages.fault, self)

    def show_due(self) -> None:
        """Patients of whom nothing need be kept any more."""
        self._run(lambda: self._records.due(self.years, self._context.today()), self._show_due)

    def _show_due(self, found: list[Due]) -> None:
        words = self.tr("Nothing is due: no patient’s last session is so old.")
        if not self.years:
            words = self.tr("Say first how many years records must be kept.")
        elif found:
            words = self.tr("Their last session is more than {n} years ago. Nothing goes by itself.")
        listed = [
            ListedRecord(
                one.patient_id,
                one.pseudonym,
                (
                    self.tr("1 session, on {last}; had to be kept until {until}")
                    if one.sessions == 1
                    else self.tr("{n} sessions, the last on {last}; had to be kept until {until}")
                ).format(n=one.sessions, last=numbers.day_of_year(one.last), until=numbers.day_of_year(one.until)),
                one.archived,
            )
            for one in found
        ]
        self.sheet.begin(self.tr("What is due"), words.format(n=self.years), listed)

    def show_archive(self, shown: Callable[[Archived], bool] | None = None) -> None:
        """What can be brought back; all of it, or what ``shown`` says."""
        self._shown = shown or _everything
        self._run(self._records.archived, self._show_archive)

    def _show_archive_of(self, patient_id: str) -> None:
        self.show_archive(lambda one: one.recorded is not None and one.patient_id == patient_id)

    def _show_archive(self, there: list[Archived]) -> None:
        listed = []
        found = [one for one in there if self._shown(one)]
        for one in found:
            what = self.tr("1 session") if one.sessions == 1 else self.tr("{n} sessions").format(n=one.sessions)
            if one.recorded is not None:
                what = self.tr("session of {day}").format(day=numbers.report_date(one.recorded))
            since = self.tr("archived on {day}").format(day=numbers.day_of_year(one.since))
            listed.append(ListedRecord(one.identity, one.pseudonym, f"{what}, {since}", True))
        self._sessions = {one.identity: one.session_id for one in found if one.session_id}
        words = self.tr("In no list and no count. Everything can be brought back.")
        self.sheet.begin(self.tr("Archive"), words if found else self.tr("The archive is empty."), listed)

    def _bring_back(self, identity: str) -> None:
        def done(_: object) -> None:
            self._erasing.show_again()
            self.show_archive(self._shown)

        self._run(lambda: self._records.bring_back(identity), done)

    def _archive(self, patient_id: str) -> None:
        self._run(lambda: self._records.archive_patient(patient_id), lambda _: self.show_due())

    def _erase(self, identity: str) -> None:
        self.sheet.close_sheet()
        session_id = self._sessions.get(identity, "")
        if session_id:
            self._erasing.ask_session(session_id)
        else:
            self._erasing.ask_patient(identity)

    def show_log(self) -> None:
        self._run(lambda: (self._records.log(), self._records.names()), self._show_log)

    def _show_log(self, found: tuple[Sequence[LoggedDeed], dict[str, str]]) -> None:
        entries, names = found
        self.log_sheet.begin([self._deed(entry, names) for entry in entries])

    def _deed(self, entry: LoggedDeed, names: dict[str, str]) -> tuple[str, ...]:
        """When, who, what, of whom, details."""
        of_whom = names.get(entry.subject, entry.subject[:8])
        by = self.tr("by command") if entry.by == "command" else ""
        facts = ", ".join(filter(None, (self._fact(name, value) for name, value in entry.facts.items())))
        detail = " · ".join(part for part in (facts, by) if part)
        when = numbers.report_date(entry.when.astimezone())
        return when, entry.who or numbers.UNKNOWN, self._words(entry.did), of_whom, detail

    def _fact(self, name: str, value: object) -> str:
        """What is known of a deed, in words; empty for what says nothing to a person."""
        if name == "exercise":
            return terms.exercise_name(str(value).upper())
        one, many = {
            "files": (self.tr("1 file"), self.tr("{n} files")),
            "sessions": (self.tr("1 session"), self.tr("{n} sessions")),
            "values": (self.tr("1 value"), self.tr("{n} values")),
            "left": (self.tr("1 left"), self.tr("{n} left")),
            "limits": (self.tr("1 study"), self.tr("{n} studies")),
            "idle": (self.tr("nobody was there"), ""),
            "deidentified": (self.tr("without what identifies"), ""),
            "late": (self.tr("finished later"), ""),
            "set": (self.tr("with a PIN"), ""),
        }.get(name, ("", ""))
        return one if value == 1 else many.format(n=value) if value or name == "left" else ""

    def _words(self, did: str) -> str:
        words = {
            "opened": self.tr("opened"), "recorded": self.tr("recorded"), "added": self.tr("added"),
            "changed": self.tr("changed"), "exported": self.tr("exported"), "reported": self.tr("report saved"),
            "set_aside": self.tr("set aside"), "taken_back": self.tr("taken back"), "moved": self.tr("moved"),
            "renamed": self.tr("exercise changed"), "tracked_again": self.tr("tracked again"),
            "recovered": self.tr("recovered"), "archived": self.tr("archived"),
            "brought_back": self.tr("brought back"), "erase_begun": self.tr("erasing begun"),
            "erased": self.tr("erased"), "backed_up": self.tr("backed up"),
            "backup_compared": self.tr("back-up compared"), "restored": self.tr("restored"),
            "locked": self.tr("locked"), "unlocked": self.tr("unlocked"), "pin_refused": self.tr("PIN refused"),
            "pin_changed": self.tr("PIN changed"), "read_log": self.tr("log read"),
            "entered_by_hand": self.tr("values by hand entered"),
        }  # fmt: skip
        return words.get(did, did)


@dataclass(frozen=True, slots=True)
class ListedRecord:
    """A line of what is due or archived: ``identity`` of what the buttons act on."""

    identity: str
    title: str
    detail: str
    archived: bool


class RecordsSheet(Sheet):
    """What is due or archived; ``back_wanted``, ``archive_wanted`` and ``erase_wanted`` carry the identity."""

    back_wanted = Signal(str)
    archive_wanted = Signal(str)
    erase_wanted = Signal(str)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 800)
        self.head()
        self.rows = in_column(gap=8, margins=(0, 0, 8, 0))
        self._inside = ScrolledColumn()
        self._inside.setLayout(self.rows)
        self._scroll = ScrollArea(self._inside)
        self.done = Button(theme, self.tr("Done"), "primary", height_px=44)
        self.done.clicked.connect(self.close_sheet)
        self.set_default(self.done)
        fill(self.card.body, self._scroll, (self.done, 0, Qt.AlignmentFlag.AlignRight))
        self.buttons: list[Button] = []

    def begin(self, title: str, words: str, records: Sequence[ListedRecord]) -> None:
        self.title.setText(title)
        self.words.setText(words)
        self.buttons = []
        empty(self.rows)
        for record in records:
            fill(self.rows, self._row(record), Line(self._theme))
        self.rows.addStretch(1)
        self.open()

    def _take_room(self) -> None:
        super()._take_room()
        if hasattr(self, "_scroll"):
            column = self.rows.totalHeightForWidth(self.card.width() - 60) if self.buttons else 8
            self._scroll.setFixedHeight(max(min(column, host_of(self).height() - self._theme.px(240)), 8))

    def _row(self, record: ListedRecord) -> QWidget:
        row = QWidget()
        line = in_line(gap=12, margins=(0, 2, 0, 2), within=row)
        line.addLayout(
            in_column(
                Text(self._theme, record.title, 14, MEDIUM, wrap=True),
                Text(self._theme, record.detail, 12, REGULAR, "text2", wrap=True),
                gap=2,
            ),
            1,
        )
        first = Button(self._theme, self.tr("Bring back") if record.archived else self.tr("Archive"), height_px=36)
        signal = self.back_wanted if record.archived else self.archive_wanted
        first.clicked.connect(lambda _=False, one=record.identity: signal.emit(one))
        erase = Button(self._theme, self.tr("Erase…"), "plain", icon="trash-2", height_px=36)
        erase.clicked.connect(lambda _=False, one=record.identity: self.erase_wanted.emit(one))
        for button in (first, erase):
            button.setAccessibleName(f"{button.text()} {record.title}")
            line.addWidget(button)
        self.buttons += [first, erase]
        return row


class LogSheet(Sheet):
    """The log, newest first."""

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 1080)
        words = self.tr(
            "Only ever added to, which protects against mistakes, not against the owner of the computer: a back-up "
            "kept elsewhere shows a later change. Names are put to it here, as long as they are in the list."
        )
        self.head(self.tr("Log"), words, gap=10)
        self.table = QTableWidget(0, 5)
        heads = (self.tr("When"), self.tr("Who"), self.tr("What"), self.tr("Of whom"), self.tr("Details"))
        self.table.setHorizontalHeaderLabels(heads)
        self.table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.table.verticalHeader().hide()
        self.table.horizontalHeader().setDefaultAlignment(Qt.AlignmentFlag.AlignLeft)
        self.table.horizontalHeader().setStretchLastSection(True)
        self.table.setShowGrid(False)
        self.table.setAccessibleName(self.tr("Log"))
        self.done = Button(theme, self.tr("Done"), "primary", height_px=44)
        self.done.clicked.connect(self.close_sheet)
        self.set_default(self.done)
        fill(self.card.body, self.table, (self.done, 0, Qt.AlignmentFlag.AlignRight))

    def begin(self, deeds: Sequence[Sequence[str]]) -> None:
        self.title.setText(self.tr("Log: {n} lines").format(n=len(deeds)))
        self.table.setRowCount(len(deeds))
        for row, deed in enumerate(reversed(deeds)):
            for column, text in enumerate(deed):
                self.table.setItem(row, column, QTableWidgetItem(text))
        self.open()

    def _take_room(self) -> None:
        super()._take_room()
        if not hasattr(self, "table"):
            return  # the sheet is being made
        self.table.setFont(font(14 * self._theme.text_scale, REGULAR))
        self.table.verticalHeader().setDefaultSectionSize(self._theme.px(32))
        self.table.setFixedHeight(max(host_of(self).height() - self._theme.px(250), 80))
        self.table.resizeColumnsToContents()
        for column in range(4):
            self.table.setColumnWidth(column, self.table.columnWidth(column) + self._theme.px(20))
