"""Archive or erase: what would go is worked out, shown, and done only when it was confirmed; what was done is said."""

from __future__ import annotations

from collections.abc import Callable
from datetime import date, datetime
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QVBoxLayout, QWidget

from carpus.core.records.erasure import ErasurePlan
from carpus.core.records.keeping import Records, kept_until
from carpus.core.words import Words
from carpus.ui import numbers
from carpus.ui.records.erase_sheet import EraseSheet
from carpus.ui.records.ports import ErasureFacts
from carpus.ui.theme import Theme

if TYPE_CHECKING:
    from carpus.app.desktop.journey import Journey


class Erasing(QObject):
    """One sheet for sessions and patients. ``years`` of retention and the ``last_backup`` are asked for each time."""

    def __init__(
        self,
        journey: Journey,
        stage: QWidget,
        theme: Theme,
        records: Records,
        today: Callable[[], date],
        years: Callable[[], int] = lambda: 0,
        last_backup: Callable[[], datetime | None] = lambda: None,
    ) -> None:
        super().__init__(journey)
        self._journey, self._records, self._today = journey, records, today
        self._years, self._last_backup = years, last_backup
        self.sheet = EraseSheet(stage, theme)
        self._plan: ErasurePlan | None = None
        journey.sessions.erase_wanted.connect(self.ask_session)
        journey.patients.erase_wanted.connect(self.ask_patient)
        journey.sessions.moved.connect(self._moved)
        self.sheet.erase.connect(self._erase)
        self.sheet.archive.connect(self._archive)

    def ask_session(self, session_id: str) -> None:
        """Show what goes with a session."""
        self._ask(lambda: self._records.plan_session(session_id))

    def ask_patient(self, patient_id: str) -> None:
        """Show what goes with a patient."""
        self._ask(lambda: self._records.plan_patient(patient_id))

    def _ask(self, work: Callable[[], ErasurePlan]) -> None:
        self._journey.background.run(work, self._show, self._journey.messages.fault, self)

    def _show(self, plan: ErasurePlan) -> None:
        self._plan = plan
        years = self._years()
        last = max((entry.recorded for entry in plan.results), default=None)
        single = plan.kind == "session" and last is not None
        patient = self._journey.patient
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
                today=self._today(),
            )
        )

    def _erase(self) -> None:
        plan, self._plan = self._plan, None
        if plan is not None:
            self._journey.background.run(
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
        place = self._journey.sessions.notice_place if single else self._journey.patients.notice_place
        self._say(place, Words(what, count, ""), "trash-2")

    def _moved(self, name: str) -> None:
        words = Words(self.tr("The session is now one of {name}.").format(name=name), "", "")
        self._say(self._journey.sessions.notice_place, words, "arrow-right")

    def _say(self, place: QVBoxLayout, words: Words, icon: str) -> None:
        """What was done, until it is closed or left."""
        strip = self._journey.messages.strip(place, words, "", lambda: None, icon=icon, later=self.tr("Close"))
        self._journey.way.leaving.connect(strip.later)

    def _archive(self) -> None:
        plan, self._plan = self._plan, None
        if plan is not None:
            single = plan.kind == "session"
            act = self._records.archive_session if single else self._records.archive_patient

            def done(_: object) -> None:
                self._gone(single)
                self._offer_undo(plan, plan.identity)

            self._journey.background.run(lambda: act(plan.identity), done, self._journey.messages.fault, self)

    def _offer_undo(self, plan: ErasurePlan, archived: str) -> None:
        """What was archived is said where it was, and comes back by one press."""
        journey = self._journey
        if plan.kind == "session":
            what = self.tr("The session of {day} is in the archive.").format(
                day=numbers.report_date(plan.results[0].recorded)
            )
            place = journey.sessions.notice_place
        else:
            what = self.tr("{name} is in the archive.").format(name=plan.pseudonym)
            place = journey.patients.notice_place
        words = Words(what, self.tr("Nothing is lost. It counts nowhere until it is brought back."), "")
        strip = journey.messages.strip(
            place, words, self.tr("&Undo"), lambda: self._bring_back(archived), icon="archive", later=self.tr("Close")
        )
        journey.way.leaving.connect(strip.later)  # elsewhere it is said no more; the archive has it

    def _bring_back(self, identity: str) -> None:
        self._journey.background.run(
            lambda: self._records.bring_back(identity),
            lambda _: self.show_again(identity),
            self._journey.messages.fault,
            self,
        )

    def show_again(self, chosen: str = "") -> None:
        """The list that is shown, with what is in it now; ``chosen`` the patient or session that is to be chosen."""
        journey = self._journey
        journey.sessions.changed.emit()
        if journey.place == "sessions" and journey.patient is not None:
            journey.now.session_id = chosen or journey.now.session_id
            journey.viewing.open_sessions(journey.patient.patient_id)
        elif journey.place == "patients":
            journey.patients.refresh(chosen)

    def _refused(self, single: bool, fault: Exception) -> None:
        """Some of it may be gone all the same."""
        self._gone(single)
        self._journey.messages.fault(fault)

    def _gone(self, single: bool) -> None:
        """The list from which it was chosen, without it."""
        journey = self._journey
        journey.sessions.changed.emit()
        if single and journey.patient is not None:
            journey.viewing.open_sessions(journey.patient.patient_id)
        else:
            journey.show_patients()
