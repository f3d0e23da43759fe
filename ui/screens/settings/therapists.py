"""Therapists of the clinic: their list in the settings, and who works now."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtWidgets import QAbstractItemView, QTableWidget, QTableWidgetItem

from carpus.core.model.errors import CarpusFault
from carpus.core.records.clinic_records import read_therapists, save_therapists
from carpus.core.records.values import MAX_INITIALS, Therapist, read_or_default
from carpus.ui.kit.card import Card
from carpus.ui.kit.fonts import font
from carpus.ui.kit.text import REGULAR
from carpus.ui.kit.theme import Theme
from carpus.ui.shell.flow import ScreenContext

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


class TherapistController(QObject):
    """The list in the store, and the initials of who works now, which the top bar and the lock ask for."""

    def __init__(self, context: ScreenContext, initials: Callable[[], str], choose: Callable[[str], None]) -> None:
        """Put the initials of earlier settings into an empty list; a therapist removed elsewhere is chosen no more.

        ``initials`` returns who works, ``choose`` saves it.
        """
        super().__init__(context.window)
        self._context, self.initials, self._choose = context, initials, choose
        self.card = TherapistCard(context.theme)
        self.card.changed.connect(self._save)
        self._button = context.window.top_bar.therapist_button
        self._button.menu().aboutToShow.connect(self._fill_menu)
        self._shown: Sequence[Therapist] = ()
        with suppress(CarpusFault):
            listed = [one.initials for one in read_therapists(context.library.store)]
            if initials() and not listed:
                save_therapists(context.library.store, [Therapist(initials())])
            elif initials() and initials() not in listed:
                choose("")
        context.navigator.screen_changed.connect(lambda name: self._show_list() if name == "settings" else None)
        context.window.top_bar.show_therapist(initials())

    def list_therapists(self) -> list[Therapist]:
        """Return all therapists; none while the clinic's server is away."""
        return read_or_default(lambda: read_therapists(self._context.library.store), [])

    def choose(self, initials: str) -> None:
        """Set who works now."""
        if initials != self.initials():
            self._choose(initials)
            self._context.window.top_bar.show_therapist(initials)

    def _show_list(self) -> None:
        self._shown = self.list_therapists()
        self.card.show_therapists(self._shown)

    def _fill_menu(self) -> None:
        menu = self._button.menu()
        menu.clear()
        for one in self.list_therapists():
            action = menu.addAction(" · ".join(part for part in (one.initials, one.name) if part))
            action.setCheckable(True)
            action.setChecked(one.initials == self.initials())
            action.triggered.connect(lambda _=False, initials=one.initials: self.choose(initials))
        menu.addSeparator()
        menu.addAction(self.tr("Edit the list…")).triggered.connect(
            lambda: self._context.navigator.open_screen("settings", "report")
        )

    def _save(self, therapists: Sequence[Therapist]) -> None:
        """Save the list; the only one in it works now."""
        try:
            save_therapists(self._context.library.store, therapists, self._shown)
        except CarpusFault as fault:
            self._context.messages.show_fault(fault)
            return
        self._shown = therapists
        listed = [one.initials for one in self.list_therapists()]
        if len(listed) == 1 or self.initials() not in listed:
            self.choose(listed[0] if len(listed) == 1 else "")
