"""Card of the settings with the clinic's therapists."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QAbstractItemView, QTableWidget, QTableWidgetItem

from carpus.core.records.values import MAX_INITIALS, Therapist
from carpus.ui.kit.card import Card
from carpus.ui.kit.fonts import font
from carpus.ui.kit.text import REGULAR
from carpus.ui.kit.theme import Theme

ROW_PX, INITIALS_PX, SPARE_ROWS = 36, 140, 2


class TherapistCard(Card):
    """Table of initials and names.

    Signals: ``changed`` with the list of :class:`Therapist`.
    """

    changed = Signal(object)

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme, 24)
        words = self.tr(
            "Sessions, reports, letters and the log carry the therapist’s initials. Choose the therapist "
            "in the top bar. Clear the initials to remove a therapist."
        )
        self.table = QTableWidget(0, 2)
        self.table.setHorizontalHeaderLabels((self.tr("Initials"), self.tr("Name")))
        self.table.setAccessibleName(self.tr("Therapists"))
        self.table.verticalHeader().hide()
        self.table.horizontalHeader().setDefaultAlignment(Qt.AlignmentFlag.AlignLeft)
        self.table.horizontalHeader().setStretchLastSection(True)
        self.table.setEditTriggers(QAbstractItemView.EditTrigger.AllEditTriggers)
        self.table.setTabKeyNavigation(False)
        self.table.cellChanged.connect(self._on_edited)
        self.add_heading(self.tr("Therapists"), words)
        self.body.addWidget(self.table)
        theme.changed.connect(self._fit)

    def show_therapists(self, therapists: Sequence[Therapist]) -> None:
        """Show the list, with rows for further ones."""
        self.table.blockSignals(True)
        self.table.setRowCount(0)
        self.table.setRowCount(len(therapists) + SPARE_ROWS)
        for number, one in enumerate(therapists):
            for column, text in enumerate((one.initials, one.name)):
                self.table.setItem(number, column, QTableWidgetItem(text))
        self.table.blockSignals(False)
        self._fit()

    def _on_edited(self, row: int) -> None:
        """Report the list; no row moves while the next cell is typed."""
        self.table.setRowCount(max(self.table.rowCount(), row + 1 + SPARE_ROWS))
        self._fit()
        self.changed.emit(self.therapists())

    def therapists(self) -> list[Therapist]:
        model = self.table.model()
        rows = [
            [" ".join(str(model.index(number, column).data() or "").split()) for column in range(2)]
            for number in range(self.table.rowCount())
        ]
        return [Therapist(initials[:MAX_INITIALS], name) for initials, name in rows if initials]

    def _fit(self) -> None:
        theme, rows = self._theme, self.table.rowCount()
        self.table.setStyleSheet(f"QTableWidget {{ gridline-color: {theme.tokens.line}; }}")
        self.table.setFont(font(14 * theme.text_scale, REGULAR))
        self.table.verticalHeader().setDefaultSectionSize(theme.px(ROW_PX))
        self.table.setColumnWidth(0, theme.px(INITIALS_PX))
        self.table.setFixedHeight(self.table.horizontalHeader().sizeHint().height() + theme.px(ROW_PX) * rows + 4)
