"""Flow of reports: built in the background, shown, and made into letters and home exercise sheets."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TypeVar

from PySide6.QtCore import QLocale, QObject
from PySide6.QtWidgets import QWidget

from carpus.core.model.errors import CarpusFault
from carpus.core.records import clinic_records, patients
from carpus.core.records.clinic_records import read_form, save_form
from carpus.core.records.values import Patient, read_or_default
from carpus.core.results.report_form import ReportForm, default_paper
from carpus.ui.report.home_page import HomeReport, build_home_progress
from carpus.ui.report.letter_page import LetterReport
from carpus.ui.report.page import Report
from carpus.ui.report.progress_page import ProgressReport
from carpus.ui.report.session_page import SessionReport, build_session_report
from carpus.ui.screens.report.dialogs import HomeDialog, LetterDialog
from carpus.ui.screens.report.screen import ReportScreen
from carpus.ui.screens.settings.report_card import ReportCard
from carpus.ui.shell.flow import Flow, ScreenContext

T = TypeVar("T")


class ReportFlow(Flow):
    """Flow of session and progress reports."""

    screen_name, guide_page = "report", "figures"
    screen: ReportScreen

    def __init__(self, context: ScreenContext) -> None:
        super().__init__(context, ReportScreen(context.theme, context.background))
        screen = self.screen
        self.form_store = ReportFormStore(context)
        self._research = True
        self._sessions: Sequence[str] = ()
        self._letter_source: SessionReport | None = None
        self.letter_dialog = LetterDialog(context.window, context.theme)
        self.letter_dialog.requested.connect(self._show_letter)
        self.home_dialog = HomeDialog(context.window, context.theme)
        self.home_dialog.requested.connect(self._show_home)
        screen.letter_requested.connect(self._open_letter_dialog)
        screen.home_sheet_requested.connect(self._open_home_dialog)
        screen.fault_raised.connect(context.messages.show_fault)
        screen.panel.form_saved.connect(self.form_store.save)
        screen.panel.comment_saved.connect(
            lambda session_id, text: self._run_or_report(lambda: context.library.save_comment(session_id, text))
        )
        screen.saved.connect(self._register_file)
        screen.saved.connect(lambda path: context.recent_locations.save("reports", str(Path(path).parent)))
        screen.sent.connect(self._register_file)

    def open(self, report: str | ProgressReport, sessions: Sequence[str] = ()) -> None:
        """Show the report of a session id, or one that was made of ``sessions``."""
        if isinstance(report, str):
            self._show_session(report)
        else:
            self._sessions = sessions
            therapist = self._therapist_words(self.context.report_settings.therapist)
            self._show_report(
                replace(report, form=self.form_store.form, therapist=therapist, printed_patient=self._printed_patient())
            )
            self.context.navigator.switch_screen("report")

    def initial_focus(self) -> QWidget:
        return self.screen.save_button

    def navigate_back(self) -> None:
        self.return_to_session()

    def show_research(self, *, on: bool) -> None:
        self._research = on

    def on_server_reconnected(self) -> None:
        self.form_store.reload()

    def _show_session(self, session_id: str) -> None:
        row, stored, name = self.context.current.patient, self.context.library, self.context.current.patient_name
        printed_patient, current = self._printed_patient(), self.context.report_settings.therapist
        assert row is not None

        def build_report() -> SessionReport:
            session = stored.session(session_id)
            report = build_session_report(
                session,
                choices=stored.choices(session_id),
                history=stored.history(row.patient_id),
                pseudonym=name,
                dominance=row.dominance,
                therapist=self._therapist_words(stored.entry(session_id).initials or current),
                manual_values=stored.manual_measurements(row.patient_id),
                comment=stored.comment(session_id),
                form=self.form_store.form,
            )
            report = replace(
                report,
                printed_patient=printed_patient,
                diagnosis=row.diagnosis,
                onset=row.onset,
                onset_day=row.onset_day,
            )
            return report if self._research else replace(report, motion=None)

        def show_report(report: SessionReport) -> None:
            self._sessions = [session_id]
            self._show_report(report)
            self.context.navigator.switch_screen("report")

        self.run(build_report, show_report)

    def _printed_patient(self) -> Patient | None:
        """Return the patient if reports print the name and it is not hidden."""
        is_printed = self.form_store.form.prints_names and not self.context.names.is_hidden
        return self.context.current.patient if is_printed else None

    def _therapist_words(self, initials: str) -> str:
        return read_or_default(lambda: clinic_records.therapist_words(self.context.library.store, initials), initials)

    def _show_report(self, report: Report) -> None:
        self.screen.show_report(report, self.context.recent_locations.folder("reports"))

    def _register_file(self, path: str) -> None:
        self.context.library.register_output_files([Path(path)], "report", self._sessions)

    def _run_or_report(self, action: Callable[[], T]) -> T | None:
        """Return the action's result, or report its fault and return None."""
        try:
            return action()
        except CarpusFault as fault:
            self.context.messages.show_fault(fault)
            return None

    # --- made of a report -----------------------------------------------------------------------------------
    def _open_letter_dialog(self, report: SessionReport) -> None:
        row = self.context.current.patient
        if row is not None:
            self._letter_source = report
            self.letter_dialog.open_form(
                self._run_or_report(lambda: clinic_records.read_recipients(self.context.library.store)) or [],
                has_name=bool(self.context.names.real_name(row)),
                prints_name=report.printed_patient is not None,
            )

    def _show_letter(self, recipient: str, language: str, has_real_name: bool) -> None:
        """Show the letter; a real name chosen for it goes no further than its page."""
        row, report = self.context.current.patient, self._letter_source
        if row is None or report is None:
            return
        if recipient:
            self._run_or_report(lambda: clinic_records.save_recipient(self.context.library.store, recipient))
        self._show_report(
            LetterReport(
                replace(report, therapist=self._therapist_words(self.context.report_settings.therapist)),
                recipient,
                self.context.today(),
                row if has_real_name else None,
                language,
            )
        )

    def _open_home_dialog(self, report: SessionReport) -> None:
        row = self.context.current.patient
        if row is not None:
            last = (
                self._run_or_report(lambda: patients.read_home_plan(self.context.library.store, row.patient_id))
                if row.patient_id
                else None
            )
            self.home_dialog.open_form(report, self.context.today(), last)

    def _show_home(self, home: HomeReport) -> None:
        """Store the plan with the patient, and show the sheet with the progress if it is good."""
        row, stored = self.context.current.patient, self.context.library
        if row is None:
            return
        if row.patient_id:
            self._run_or_report(lambda: patients.save_home_plan(stored.store, row.patient_id, home.plan))

        def add_progress() -> HomeReport:
            history, goals = stored.history(row.patient_id), patients.read_goals(stored.store, row.patient_id)
            return replace(home, progress=build_home_progress(home.report.results, history, goals))

        self.run(add_progress, self._show_report)


class ReportFormStore(QObject):
    """The clinic's report form: ``form`` is current, ``card`` edits it in the settings."""

    def __init__(self, context: ScreenContext) -> None:
        super().__init__(context.window)
        self._store, self._report_fault = context.library.store, context.messages.show_fault
        self._default_paper = default_paper(QLocale.territoryToCode(QLocale.system().territory()))
        self.form = self._read()
        self.card = ReportCard(context.theme, self.form)
        self.card.changed.connect(self.save)

    def _read(self) -> ReportForm:
        return read_or_default(
            lambda: read_form(self._store, self._default_paper), ReportForm(paper=self._default_paper)
        )

    def reload(self) -> None:
        """Read the form again, when the clinic's server is back."""
        self.form = self._read()
        self.card.show_form(self.form)

    def save(self, form: ReportForm) -> None:
        """Save the form for all reports; show the other one if somebody else has changed it."""
        before, self.form = self.form, form
        try:
            save_form(self._store, form, before)
        except CarpusFault as fault:
            self.form = self._read()
            self._report_fault(fault)
        self.card.show_form(self.form)
