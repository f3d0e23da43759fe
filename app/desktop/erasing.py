"""Archive or erase: what would go is worked out, shown, and done only when it was confirmed."""

from __future__ import annotations

from collections.abc import Callable
from datetime import date, datetime
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QWidget

from carpus.core.library.records import Records
from carpus.core.safekeeping.erasure import ErasurePlan
from carpus.core.safekeeping.retention import kept_until
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
        self.sheet.erase.connect(self._erase)
        self.sheet.archive.connect(self._archive)

    def ask_session(self, session_id: str) -> None:
        """Show what goes with a session."""
        self._ask(lambda: self._records.plan_session(session_id))

    def ask_patient(self, patient_id: str) -> None:
        """Show what goes with a patient."""
        self._ask(lambda: self._records.plan_patient(patient_id))

    def _ask(self, work: Callable[[], ErasurePlan]) -> None:
        self._journey.background.run(work, self._show, self._journey.teller.fault, self)

    def _show(self, plan: ErasurePlan) -> None:
        self._plan = plan
        years = self._years()
        last = max((entry.recorded for entry in plan.results), default=None)
        single = plan.kind == "session" and last is not None
        patient = self._journey.patient
        name = self._records.names().get(plan.patient_id, "")
        self.sheet.begin(
            ErasureFacts(
                pseudonym=patient.pseudonym if patient is not None and single else name,
                when=last if single else None,
                exercise=plan.results[0].exercise if plan.results else "",
                side=plan.results[0].hand if plan.results else "",
                sessions=plan.sessions,
                files=len(plan.files),
                size_mb=plan.size_bytes / 1e6,
                exports=sum(one.kind == "export" for one in plan.made_going),
                reports=sum(one.kind == "report" for one in plan.made_going),
                changed=sum(one.state == "changed" for one in plan.made),
                not_found=sum(one.state == "not_found" for one in plan.made),
                others=plan.others,
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
                lambda _: self._gone(plan.kind == "session"),
                lambda fault: self._refused(plan.kind == "session", fault),
                self,
            )

    def _archive(self) -> None:
        plan, self._plan = self._plan, None
        if plan is not None:
            single = plan.kind == "session"
            act = self._records.archive_session if single else self._records.archive_patient
            self._journey.background.run(
                lambda: act(plan.identity), lambda _: self._gone(single), self._journey.teller.fault, self
            )

    def _refused(self, single: bool, fault: Exception) -> None:
        """Some of it may be gone all the same."""
        self._gone(single)
        self._journey.teller.fault(fault)

    def _gone(self, single: bool) -> None:
        """The list from which it was chosen, without it."""
        journey = self._journey
        journey.sessions.changed.emit()
        if single and journey.patient is not None:
            journey.viewing.open_sessions(journey.patient.patient_id)
        else:
            journey.show_patients()
