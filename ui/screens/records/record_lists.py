"""Records past retention, archive and log, opened from the settings."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtWidgets import QAbstractItemView, QTableWidget, QTableWidgetItem, QWidget

from carpus.core.records.log import AuditEntry
from carpus.core.records.retention import RETENTION_YEARS, ArchivedItem, DuePatient, RecordRetention, find_due_patients
from carpus.ui.kit import numbers
from carpus.ui.kit.button import Button
from carpus.ui.kit.card import Separator
from carpus.ui.kit.dialog import Dialog
from carpus.ui.kit.fonts import font
from carpus.ui.kit.layouts import (
    ScrollArea,
    ScrolledColumn,
    clear_layout,
    column_layout,
    fill,
    require_parent,
    row_layout,
)
from carpus.ui.kit.text import MEDIUM, REGULAR, Text
from carpus.ui.kit.theme import Theme
from carpus.ui.screens.patients.screen import PatientsScreen
from carpus.ui.screens.records.cards import RecordsCard
from carpus.ui.screens.records.deletion import DeletionController
from carpus.ui.screens.sessions.screen import SessionsScreen
from carpus.ui.shell.flow import ScreenContext
from carpus.ui.words import terms


class RecordListsController(QObject):
    """Controller of these lists; each is read when it is opened."""

    def __init__(
        self,
        context: ScreenContext,
        records: RecordRetention,
        deletion: DeletionController,
        sessions: Callable[[], SessionsScreen],
        patients: PatientsScreen,
        *,
        retention_years: int,
        save_years: Callable[[int], None],
    ) -> None:
        super().__init__(context.window)
        self._context, self._records, self._deletion = context, records, deletion
        self.retention_years, self._save_years = retention_years, save_years
        self._session_ids: dict[str, str] = {}
        self._archive_filter: Callable[[ArchivedItem], bool] = lambda _: True
        self.card = RecordsCard(context.theme, retention_years, RETENTION_YEARS)
        self.records_dialog = RecordsDialog(context.window.screen_stack, context.theme)
        self.log_dialog = LogDialog(context.window.screen_stack, context.theme)
        self.card.years.chosen.connect(self._set_years)
        self.card.due_button.clicked.connect(self.show_due)
        self.card.archive_button.clicked.connect(lambda: self.show_archive())
        patients.archive_button.clicked.connect(lambda: self.show_archive(lambda one: one.recorded is None))
        context.navigator.run_when_created(
            "sessions", lambda: sessions().archive_requested.connect(self._show_patient_archive)
        )
        self.card.log_button.clicked.connect(self.show_log)
        self.records_dialog.restore_requested.connect(self._restore)
        self.records_dialog.archive_requested.connect(
            lambda patient_id: self._context.run(
                self, lambda: records.archive_patient(patient_id), lambda _: self.show_due()
            )
        )
        self.records_dialog.delete_requested.connect(self._delete)

    def _set_years(self, years: int) -> None:
        self.retention_years = years
        self._save_years(years)

    def show_due(self) -> None:
        """Show patients past their retention period."""
        store, years, today = self._context.library.store, self.retention_years, self._context.today()
        self._context.run(self, lambda: find_due_patients(store, years, today), self._show_due)

    def _show_due(self, found: list[DuePatient]) -> None:
        words = self.tr("No record is past its retention period.")
        if not self.retention_years:
            words = self.tr("Set the retention period first.")
        elif found:
            words = self.tr("The last session was more than {n} years ago. Nothing is deleted automatically.")
        listed = [
            ListedRecord(
                one.patient_id,
                one.pseudonym,
                (
                    self.tr("1 session on {last}, retention until {until}")
                    if one.sessions == 1
                    else self.tr("{n} sessions, the last on {last}, retention until {until}")
                ).format(
                    n=one.sessions,
                    last=numbers.format_date(one.last_session),
                    until=numbers.format_date(one.keep_until),
                ),
                one.is_archived,
            )
            for one in found
        ]
        self.records_dialog.show_records(
            self.tr("Records past their retention period"), words.format(n=self.retention_years), listed
        )

    def show_archive(self, is_shown: Callable[[ArchivedItem], bool] | None = None) -> None:
        """Show archived items, all or those that ``is_shown`` accepts."""
        self._archive_filter = is_shown or (lambda _: True)
        self._context.run(self, self._records.list_archived, self._show_archive)

    def _show_patient_archive(self, patient_id: str) -> None:
        self.show_archive(lambda one: one.recorded is not None and one.patient_id == patient_id)

    def _show_archive(self, there: list[ArchivedItem]) -> None:
        listed = []
        found = [one for one in there if self._archive_filter(one)]
        for one in found:
            what = self.tr("1 session") if one.sessions == 1 else self.tr("{n} sessions").format(n=one.sessions)
            if one.recorded is not None:
                what = self.tr("session of {day}").format(day=numbers.format_date_time(one.recorded))
            since = self.tr("archived on {day}").format(day=numbers.format_date(one.since))
            listed.append(ListedRecord(one.item_id, one.pseudonym, f"{what}, {since}", True))
        self._session_ids = {one.item_id: one.session_id for one in found if one.session_id}
        words = self.tr("Excluded from all lists and results. Everything can be restored.")
        self.records_dialog.show_records(
            self.tr("Archive"), words if found else self.tr("The archive is empty."), listed
        )

    def _restore(self, identity: str) -> None:
        def on_restored(_: object) -> None:
            self._deletion.refresh_lists()
            self.show_archive(self._archive_filter)

        self._context.run(self, lambda: self._records.unarchive(identity), on_restored)

    def _delete(self, identity: str) -> None:
        self.records_dialog.close_dialog()
        session_id = self._session_ids.get(identity, "")
        if session_id:
            self._deletion.plan_session_deletion(session_id)
        else:
            self._deletion.plan_patient_deletion(identity)

    def show_log(self) -> None:
        self._context.run(self, lambda: (self._records.read_log(), self._records.subject_names()), self._show_log)

    def _show_log(self, found: tuple[Sequence[AuditEntry], dict[str, str]]) -> None:
        entries, names = found
        self.log_dialog.show_entries([self._format_log_entry(entry, names) for entry in entries])

    def _format_log_entry(self, entry: AuditEntry, names: dict[str, str]) -> tuple[str, ...]:
        """Return time, user, action, patient and details."""
        of_whom = names.get(entry.subject, entry.subject[:8])
        by = self.tr("from the command line") if entry.source == "command" else ""
        facts = ", ".join(filter(None, (self._format_fact(name, value) for name, value in entry.facts.items())))
        detail = " · ".join(part for part in (facts, by) if part)
        when = numbers.format_date_time(entry.when.astimezone())
        return when, entry.initials or numbers.UNKNOWN, self._action_words(entry.action), of_whom, detail

    def _format_fact(self, name: str, value: object) -> str:
        """Return a fact of a log entry in words; empty if it does not concern the user."""
        if name == "exercise":
            return terms.exercise_name(str(value).upper())
        one, many = {
            "files": (self.tr("1 file"), self.tr("{n} files")),
            "sessions": (self.tr("1 session"), self.tr("{n} sessions")),
            "values": (self.tr("1 value"), self.tr("{n} values")),
            "left": (self.tr("1 remaining"), self.tr("{n} remaining")),
            "limits": (self.tr("1 study"), self.tr("{n} studies")),
            "idle": (self.tr("automatic"), ""),
            "deidentified": (self.tr("de-identified"), ""),
            "late": (self.tr("completed later"), ""),
            "set": (self.tr("with a PIN"), ""),
        }.get(name, ("", ""))
        return one if value == 1 else many.format(n=value) if value or name == "left" else ""

    def _action_words(self, action: str) -> str:
        words = {
            "opened": self.tr("opened"), "recorded": self.tr("recorded"), "added": self.tr("added"),
            "changed": self.tr("changed"), "exported": self.tr("exported"), "reported": self.tr("report saved"),
            "set_aside": self.tr("excluded"), "taken_back": self.tr("included again"), "moved": self.tr("moved"),
            "renamed": self.tr("exercise changed"), "tracked_again": self.tr("re-analysed"),
            "recovered": self.tr("recovered"), "archived": self.tr("archived"),
            "brought_back": self.tr("restored from archive"), "erase_begun": self.tr("deletion started"),
            "erased": self.tr("deleted"), "backed_up": self.tr("backed up"),
            "backup_compared": self.tr("backup verified"), "restored": self.tr("backup restored"),
            "locked": self.tr("locked"), "unlocked": self.tr("unlocked"), "pin_refused": self.tr("wrong PIN"),
            "pin_changed": self.tr("PIN changed"), "read_log": self.tr("log read"),
            "entered_by_hand": self.tr("manual values entered"),
        }  # fmt: skip
        return words.get(action, action)


@dataclass(frozen=True, slots=True)
class ListedRecord:
    """Row of a list; ``identity`` is what its buttons act on."""

    identity: str
    title: str
    detail: str
    is_archived: bool


class RecordsDialog(Dialog):
    """Records past retention, or the archive.

    Signals carry the id: ``restore_requested``, ``archive_requested``, ``delete_requested``.
    """

    restore_requested = Signal(str)
    archive_requested = Signal(str)
    delete_requested = Signal(str)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 800)
        self.add_heading()
        self.rows = column_layout(gap=8, margins=(0, 0, 8, 0))
        self._inside = ScrolledColumn()
        self._inside.setLayout(self.rows)
        self._scroll = ScrollArea(self._inside)
        self.done_button = Button(theme, self.tr("Done"), "primary", height_px=44)
        self.done_button.clicked.connect(self.close_dialog)
        self.set_default(self.done_button)
        fill(self.card.body, self._scroll, (self.done_button, 0, Qt.AlignmentFlag.AlignRight))
        self.buttons: list[Button] = []

    def show_records(self, title: str, words: str, records: Sequence[ListedRecord]) -> None:
        self.title.setText(title)
        self.words.setText(words)
        self.buttons = []
        clear_layout(self.rows)
        for record in records:
            fill(self.rows, self._make_row(record), Separator(self._theme))
        self.rows.addStretch(1)
        self.open()

    def _fit_card(self) -> None:
        super()._fit_card()
        column = self.rows.totalHeightForWidth(self.card.width() - 60) if self.buttons else 8
        self._scroll.setFixedHeight(max(min(column, require_parent(self).height() - self._theme.px(240)), 8))

    def _make_row(self, record: ListedRecord) -> QWidget:
        row = QWidget()
        line = row_layout(gap=12, margins=(0, 2, 0, 2), parent=row)
        line.addLayout(
            column_layout(
                Text(self._theme, record.title, 14, MEDIUM, wrap=True),
                Text(self._theme, record.detail, 12, REGULAR, "text2", wrap=True),
                gap=2,
            ),
            1,
        )
        first = Button(self._theme, self.tr("Restore") if record.is_archived else self.tr("Archive"), height_px=36)
        signal = self.restore_requested if record.is_archived else self.archive_requested
        first.clicked.connect(lambda _=False, one=record.identity: signal.emit(one))
        erase = Button(self._theme, self.tr("Delete…"), "plain", icon="trash-2", height_px=36)
        erase.clicked.connect(lambda _=False, one=record.identity: self.delete_requested.emit(one))
        for button in (first, erase):
            button.setAccessibleName(f"{button.text()} {record.title}")
            line.addWidget(button)
        self.buttons += [first, erase]
        return row


class LogDialog(Dialog):
    """Audit log, newest entry first."""

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 1080)
        words = self.tr(
            "Entries are added and never changed. The log protects against mistakes, not against someone with full "
            "access to this computer. It stores no names: those shown here come from the patient list."
        )
        self.add_heading(self.tr("Log"), words, gap=10)
        self.table = QTableWidget(0, 5)
        heads = (self.tr("When"), self.tr("Who"), self.tr("What"), self.tr("Patient"), self.tr("Details"))
        self.table.setHorizontalHeaderLabels(heads)
        self.table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.table.verticalHeader().hide()
        self.table.horizontalHeader().setDefaultAlignment(Qt.AlignmentFlag.AlignLeft)
        self.table.horizontalHeader().setStretchLastSection(True)
        self.table.setShowGrid(False)
        self.table.setAccessibleName(self.tr("Log"))
        self.done_button = Button(theme, self.tr("Done"), "primary", height_px=44)
        self.done_button.clicked.connect(self.close_dialog)
        self.set_default(self.done_button)
        fill(self.card.body, self.table, (self.done_button, 0, Qt.AlignmentFlag.AlignRight))

    def show_entries(self, entries: Sequence[Sequence[str]]) -> None:
        self.title.setText(self.tr("Log: {n} entries").format(n=len(entries)))
        self.table.setRowCount(len(entries))
        for row, deed in enumerate(reversed(entries)):
            for column, text in enumerate(deed):
                self.table.setItem(row, column, QTableWidgetItem(text))
        self.open()

    def _fit_card(self) -> None:
        super()._fit_card()
        self.table.setFont(font(14 * self._theme.text_scale, REGULAR))
        self.table.verticalHeader().setDefaultSectionSize(self._theme.px(32))
        self.table.setFixedHeight(max(require_parent(self).height() - self._theme.px(250), 80))
        self.table.resizeColumnsToContents()
        for column in range(4):
            self.table.setColumnWidth(column, self.table.columnWidth(column) + self._theme.px(20))
