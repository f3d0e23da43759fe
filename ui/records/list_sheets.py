"""Lists over the settings: what is due or archived, and the log."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QAbstractItemView, QTableWidget, QTableWidgetItem, QWidget

from carpus.ui import numbers
from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Line
from carpus.ui.controls.column import ScrolledColumn, scroll_area
from carpus.ui.controls.host import host_of
from carpus.ui.controls.layouts import empty, fill, in_column, in_line
from carpus.ui.controls.sheet import Sheet
from carpus.ui.controls.text import MEDIUM, REGULAR, SEMIBOLD, Text
from carpus.ui.fonts import font
from carpus.ui.theme import Theme


@dataclass(frozen=True, slots=True)
class ListedRecord:
    """A line of what is due or archived: ``identity`` of what the buttons act on."""

    identity: str
    title: str
    detail: str
    archived: bool


@dataclass(frozen=True, slots=True)
class DeedLine:
    """A line of the log, in words."""

    number: int
    when: datetime
    who: str
    what: str
    of_whom: str
    detail: str


class RecordsSheet(Sheet):
    """What is due or archived; ``back_wanted``, ``archive_wanted`` and ``erase_wanted`` carry the identity."""

    back_wanted = Signal(str)
    archive_wanted = Signal(str)
    erase_wanted = Signal(str)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 800)
        self.title = Text(theme, "", 20, SEMIBOLD)
        self.words = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.rows = in_column(gap=8, margins=(0, 0, 8, 0))
        self._inside = ScrolledColumn()
        self._inside.setLayout(self.rows)
        self._scroll = scroll_area(self._inside)
        self.done = Button(theme, self.tr("Done"), "primary", height_px=44)
        self.done.clicked.connect(self.close_sheet)
        self.set_default(self.done)
        self.card.body.setSpacing(12)
        fill(self.card.body, self.title, self.words, self._scroll, (self.done, 0, Qt.AlignmentFlag.AlignRight))
        self.buttons: list[Button] = []

    def begin(self, title: str, words: str, records: Sequence[ListedRecord]) -> None:
        """Show them."""
        self.title.setText(title)
        self.words.setText(words)
        self.buttons = []
        empty(self.rows)
        for record in records:
            self.rows.addWidget(self._row(record))
            self.rows.addWidget(Line(self._theme))
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
        self.title = Text(theme, self.tr("Log"), 20, SEMIBOLD)
        words = self.tr(
            "Only ever added to, which protects against mistakes, not against the owner of the computer: a back-up "
            "kept elsewhere shows a later change. Names are put to it here, as long as they are in the list."
        )
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
        self.card.body.setSpacing(10)
        fill(
            self.card.body,
            self.title,
            Text(theme, words, 14, REGULAR, "text2", wrap=True),
            self.table,
            (self.done, 0, Qt.AlignmentFlag.AlignRight),
        )

    def begin(self, deeds: Sequence[DeedLine]) -> None:
        """Show the deeds."""
        self.title.setText(self.tr("Log: {n} lines").format(n=len(deeds)))
        self.table.setRowCount(len(deeds))
        for row, deed in enumerate(reversed(deeds)):
            when = numbers.report_date(deed.when)
            for column, text in enumerate((when, deed.who or numbers.UNKNOWN, deed.what, deed.of_whom, deed.detail)):
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
