"""The clinic's form of reports: read once, chosen in the settings and beside a report, kept in the data folder."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from PySide6.QtCore import QLocale, QObject

from carpus.core.errors import CarpusFault
from carpus.core.library.clinic_form import keep_form, read_form
from carpus.core.output.report_form import ReportForm, usual_paper
from carpus.ui.settings.report_card import ReportCard
from carpus.ui.theme import Theme


class ReportForms(QObject):
    """``form`` is what holds now; ``card`` is for the settings."""

    def __init__(self, parent: QObject, theme: Theme, folder: Path, told: Callable[[CarpusFault], None]) -> None:
        super().__init__(parent)
        self._folder, self._told = folder, told
        usual = usual_paper(QLocale.territoryToCode(QLocale.system().territory()))
        try:
            self.form = read_form(folder, usual)
        except CarpusFault as fault:
            told(fault)
            self.form = ReportForm(paper=usual)
            with suppress(CarpusFault):  # only the logo is gone: name and address are not
                self.form = read_form(folder, usual, with_logo=False)
        self.card = ReportCard(theme, self.form)
        self.card.changed.connect(self.keep)

    def keep(self, form: ReportForm) -> None:
        """Store it for all reports from now on."""
        self.form = form
        self.card.show_form(form)
        try:
            keep_form(self._folder, form)
        except CarpusFault as fault:
            self._told(fault)
