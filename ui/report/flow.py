"""The flow of reports: gathered beside the window, shown; letters and sheets for home made of them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TypeVar

from PySide6.QtCore import QLocale, QObject
from PySide6.QtWidgets import QWidget

from carpus.core.errors import CarpusFault
from carpus.core.records import of_clinic, patients
from carpus.core.records.of_clinic import keep_form, read_form
from carpus.core.records.values import unless_away
from carpus.core.results.report_form import ReportForm, usual_paper
from carpus.ui.flow import Flow, ScreenContext
from carpus.ui.report.gather import session_report
from carpus.ui.report.home_page import HomeReport, own_way
from carpus.ui.report.letter_page import LetterReport
from carpus.ui.report.pages import Report
from carpus.ui.report.progress_page import ProgressReport
from carpus.ui.report.screen import ReportScreen
from carpus.ui.report.session_page import SessionReport
from carpus.ui.report.sheets import HomeSheet, LetterSheet
from carpus.ui.settings.report_card import ReportCard

T = TypeVar("T")


class ReportFlow(Flow):
    """One report of a session, of the progress."""

    place, guide = "report", "figures"
    screen: ReportScreen

    def __init__(self, context: ScreenContext) -> None:
        super().__init__(context, ReportScreen(context.theme, context.background))
        screen = self.screen
        self.forms = ReportForms(context)
        self._research = True
        self._sessions: Sequence[str] = ()
        self._letter_of: SessionReport | None = None
        self.letter = LetterSheet(context.shell, context.theme)
        self.letter.wanted.connect(self._show_letter)
        self.home = HomeSheet(context.shell, context.theme)
        self.home.wanted.connect(self._show_home)
        screen.letter_wanted.connect(self._ask_letter)
        screen.home_wanted.connect(self._ask_home)
        screen.told.connect(context.messages.fault)
        screen.panel.form_kept.connect(self.forms.keep)
        screen.panel.comment_kept.connect(
            lambda session_id, text: self._tried(lambda: context.library.keep_comment(session_id, text))
        )
        screen.saved.connect(self._saved)

    def show(self, of: str | ProgressReport, sessions: Sequence[str] = ()) -> None:
        """Of a session, by its identity; or one that is made, and the ``sessions`` that went into it."""
        if isinstance(of, str):
            self._show_session(of)
        else:
            self._sessions = sessions
            self._begin(replace(of, form=self.forms.form))
            self.context.way.go("report")

    def first(self) -> QWidget:
        return self.screen.save_button

    def up(self) -> None:
        self.to_session()

    def show_research(self, *, on: bool) -> None:
        self._research = on

    def server_back(self) -> None:
        self.forms.look_again()

    def _show_session(self, session_id: str) -> None:
        row, stored, name = self.context.now.patient, self.context.library, self.context.now.name
        assert row is not None

        def gather() -> SessionReport:
            session = stored.session(session_id)
            report = session_report(
                session,
                choices=stored.choices(session_id),
                history=stored.history(row.patient_id),
                pseudonym=name,
                dominance=row.dominance,
                therapist=self.context.report.therapist,
                by_hand=stored.by_hand(row.patient_id),
                comment=stored.comment(session_id),
                form=self.forms.form,
            )
            report = replace(report, diagnosis=row.diagnosis, onset=row.onset, onset_day=row.onset_day)
            return report if self._research else replace(report, motion=None)

        def show(report: SessionReport) -> None:
            self._sessions = [session_id]
            self._begin(report)
            self.context.way.go("report")

        self.run(gather, show)

    def _begin(self, report: Report) -> None:
        self.screen.begin(report, self.context.places.folder("reports"))

    def _saved(self, path: str) -> None:
        self.context.library.made([Path(path)], "report", self._sessions)
        self.context.places.keep("reports", str(Path(path).parent))

    def _tried(self, ask: Callable[[], T]) -> T | None:
        """What the store answers; a fault of it is told."""
        try:
            return ask()
        except CarpusFault as fault:
            self.context.messages.fault(fault)
            return None

    # --- made of a report -----------------------------------------------------------------------------------
    def _ask_letter(self, report: SessionReport) -> None:
        row = self.context.now.patient
        if row is not None:
            self._letter_of = report
            self.letter.begin(
                self._tried(lambda: of_clinic.recipients(self.context.library.store)) or [],
                has_name=bool(row.name),
            )

    def _show_letter(self, recipient: str, language: str, named: bool) -> None:
        """The real name goes no further than the letter's page."""
        row, report = self.context.now.patient, self._letter_of
        if row is None or report is None:
            return
        if recipient:
            self._tried(lambda: of_clinic.remember_recipient(self.context.library.store, recipient))
        self._begin(LetterReport(report, recipient, self.context.today(), row.name if named else "", language))

    def _ask_home(self, report: SessionReport) -> None:
        row = self.context.now.patient
        if row is not None:
            last = (
                self._tried(lambda: patients.home_plan(self.context.library.store, row.patient_id))
                if row.patient_id
                else None
            )
            self.home.begin(report, self.context.today(), last)

    def _show_home(self, home: HomeReport) -> None:
        """With the patient's own way where there is something good to say; what is on it is remembered with the
        patient."""
        row, stored = self.context.now.patient, self.context.library
        if row is None:
            return
        if row.patient_id:
            self._tried(lambda: patients.keep_home_plan(stored.store, row.patient_id, home.plan))

        def gather() -> HomeReport:
            history, goals = stored.history(row.patient_id), patients.goals(stored.store, row.patient_id)
            return replace(home, way=own_way(home.report.figures, history, goals))

        self.run(gather, self._begin)


class ReportForms(QObject):
    """The clinic's form of reports, kept in the store: ``form`` is what holds now; ``card`` is for the settings."""

    def __init__(self, context: ScreenContext) -> None:
        super().__init__(context.shell)
        self._store, self._told = context.library.store, context.messages.fault
        self._usual = usual_paper(QLocale.territoryToCode(QLocale.system().territory()))
        self.form = self._read()
        self.card = ReportCard(context.theme, self.form)
        self.card.changed.connect(self.keep)

    def _read(self) -> ReportForm:
        return unless_away(lambda: read_form(self._store, self._usual), ReportForm(paper=self._usual))

    def look_again(self) -> None:
        """The clinic's server is back."""
        self.form = self._read()
        self.card.show_form(self.form)

    def keep(self, form: ReportForm) -> None:
        """Store it for all reports from now on; where somebody else has changed it meanwhile, theirs is shown."""
        before, self.form = self.form, form
        try:
            keep_form(self._store, form, before)
        except CarpusFault as fault:
            self.form = self._read()
            self._told(fault)
        self.card.show_form(self.form)
