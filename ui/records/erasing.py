"""Archive or erase: what would go is worked out, shown, and done only when it was confirmed; what was done is said."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QVBoxLayout

from carpus.core.records.erasure import ErasurePlan
from carpus.core.records.keeping import Records, kept_until
from carpus.core.words import Words
from carpus.ui import numbers
from carpus.ui.flow import ScreenContext
from carpus.ui.patients.screen import PatientsScreen
from carpus.ui.records.erase_sheet import EraseSheet, ErasureFacts
from carpus.ui.sessions.screen import SessionsScreen


class Erasing(QObject):
    """One sheet for sessions and patients. ``years`` of retention and the ``last_backup`` are asked for each time."""

    def __init__(
        self,
        context: ScreenContext,
        records: Records,
        sessions: Callable[[], SessionsScreen],
        patients: PatientsScreen,
        years: Callable[[], int] = lambda: 0,
        last_backup: Callable[[], datetime | None] = lambda: None,
    ) -> None:
        super().__init__(context.shell)
        self._context, self._records, self._sessions, self._patients = context, records, sessions, patients
        self._years, self._last_backup = years, last_backup
        self.sheet = EraseSheet(context.shell.stage, context.theme)
        self._plan: ErasurePlan | None = None
        patients.erase_wanted.connect(self.ask_patient)
        context.way.when_made("sessions", self._connect_sessions)
        self.sheet.erase.connect(self._erase)
        self.sheet.archive.connect(self._archive)

    def _connect_sessions(self) -> None:
        self._sessions().erase_wanted.connect(self.ask_session)
        self._sessions().moved.connect(self._moved)

    def ask_session(self, session_id: str) -> None:
        """Show what goes with a session."""
        self._ask(lambda: self._records.plan_session(session_id))

    def ask_patient(self, patient_id: str) -> None:
        """Show what goes with a patient."""
        self._ask(lambda: self._records.plan_patient(patient_id))

    def _ask(self, work: Callable[[], ErasurePlan]) -> None:
        self._context.background.run(work, self._show, self._context.messages.fault, self)

    def _show(self, plan: ErasurePlan) -> None:
        self._plan = plan
        years = self._years()
        last = max((entry.recorded for entry in plan.results), default=None)
        single = plan.kind == "session" and last is not None
        patient = self._context.now.patient
        self.sheet.begin(
            ErasureFacts(
                pseudonym=patient.pseudonym if patient is not None and single else plan.pseudonym,
                when=last if single else None,
                exercise=plan.results[0].exercise if plan.results else "",
                side=plan.results[0].hand if plan.results else "",
                sessions=plan.sessions,
                files=len(plan.files),
                size_mb=plan.size_bytes / 1e6,
                made=tuple(str(one.path) for one in plan.made),
                others=plan.others,
                by_hand=self._records.values_by_hand(plan.patient_id) if plan.kind == "patient" else 0,
                last_backup=self._last_backup(),
                kept_until=kept_until(last, years) if last is not None else None,
                retention_years=years,
                today=self._context.today(),
            )
        )

    def _erase(self) -> None:
        plan, self._plan = self._plan, None
        if plan is not None:
            self._context.background.run(
                lambda: self._records.erase(plan),
                lambda files: self._erased(plan, files),
                lambda fault: self._refused(plan.kind == "session", fault),
                self,
            )

    def _erased(self, plan: ErasurePlan, files: int) -> None:
        """Said where it was, without its name."""
        single = plan.kind == "session"
        self._gone(single)
        what = self.tr("The session is erased.") if single else self.tr("The patient is erased.")
        count = self.tr("1 file went.") if files == 1 else self.tr("{count} files went.").format(count=files)
        place = self._sessions().notice_place if single else self._patients.notice_place
        self._say(place, Words(what, count, ""), "trash-2")

    def _moved(self, name: str) -> None:
        words = Words(self.tr("The session is now one of {name}.").format(name=name), "", "")
        self._say(self._sessions().notice_place, words, "arrow-right")

    def _say(self, place: QVBoxLayout, words: Words, icon: str) -> None:
        """What was done, until it is closed or left."""
        strip = self._context.messages.strip(place, words, "", lambda: None, icon=icon, later=self.tr("Close"))
        self._context.way.leaving.connect(strip.later)

    def _archive(self) -> None:
        plan, self._plan = self._plan, None
        if plan is not None:
            single = plan.kind == "session"
            act = self._records.archive_session if single else self._records.archive_patient

            def done(_: object) -> None:
                self._gone(single)
                self._offer_undo(plan, plan.identity)

            self._context.background.run(lambda: act(plan.identity), done, self._context.messages.fault, self)

    def _offer_undo(self, plan: ErasurePlan, archived: str) -> None:
        """What was archived is said where it was, and comes back by one press."""
        if plan.kind == "session":
            what = self.tr("The session of {day} is in the archive.").format(
                day=numbers.report_date(plan.results[0].recorded)
            )
            place = self._sessions().notice_place
        else:
            what = self.tr("{name} is in the archive.").format(name=plan.pseudonym)
            place = self._patients.notice_place
        words = Words(what, self.tr("Nothing is lost. It counts nowhere until it is brought back."), "")
        strip = self._context.messages.strip(
            place, words, self.tr("&Undo"), lambda: self._bring_back(archived), icon="archive", later=self.tr("Close")
        )
        self._context.way.leaving.connect(strip.later)  # elsewhere it is said no more; the archive has it

    def _bring_back(self, identity: str) -> None:
        self._context.background.run(
            lambda: self._records.bring_back(identity),
            lambda _: self.show_again(identity),
            self._context.messages.fault,
            self,
        )

    def show_again(self, chosen: str = "") -> None:
        """The list that is shown, with what is in it now; ``chosen`` the patient or session that is to be chosen."""
        now, way = self._context.now, self._context.way
        self._sessions().changed.emit()
        if way.place == "sessions" and now.patient is not None:
            now.session_id = chosen or now.session_id
            way.show("sessions", now.patient.patient_id)
        elif way.place == "patients":
            self._patients.refresh(chosen)

    def _refused(self, single: bool, fault: Exception) -> None:
        """Some of it may be gone all the same."""
        self._gone(single)
        self._context.messages.fault(fault)

    def _gone(self, single: bool) -> None:
        """The list from which it was chosen, without it."""
        self._sessions().changed.emit()
        patient = self._context.now.patient
        if single and patient is not None:
            self._context.way.show("sessions", patient.patient_id)
        else:
            self._context.way.show("patients")
