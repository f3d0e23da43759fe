"""The clinic's form of reports: read once, chosen in the settings and beside a report, kept in the store."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QLocale, QObject

from carpus.core.errors import CarpusFault
from carpus.core.records.of_clinic import keep_form, read_form
from carpus.core.records.store import Store
from carpus.core.results.report_form import ReportForm, usual_paper
from carpus.ui.settings.report_card import ReportCard
from carpus.ui.theme import Theme


class ReportForms(QObject):
    """``form`` is what holds now; ``card`` is for the settings."""

    def __init__(self, parent: QObject, theme: Theme, store: Store, told: Callable[[CarpusFault], None]) -> None:
        super().__init__(parent)
        self._store, self._told = store, told
        self._usual = usual_paper(QLocale.territoryToCode(QLocale.system().territory()))
        self.form = read_form(store, self._usual)
        self.card = ReportCard(theme, self.form)
        self.card.changed.connect(self.keep)

    def keep(self, form: ReportForm) -> None:
        """Store it for all reports from now on; where somebody else has changed it meanwhile, theirs is shown."""
        before, self.form = self.form, form
        try:
            keep_form(self._store, form, before)
        except CarpusFault as fault:
            self.form = read_form(self._store, self._usual)
            self._told(fault)
        self.card.show_form(self.form)
