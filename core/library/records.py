"""Erasing, archiving and what is due, of the whole data folder: what must know patients and practice patient alike."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import date, datetime

from carpus.core.errors import SessionUnreadable
from carpus.core.library.corrections import Corrections
from carpus.core.library.library import Library
from carpus.core.library.set_up import PRACTICE_PATIENT
from carpus.core.phrase import phrase
from carpus.core.safekeeping import erasure
from carpus.core.safekeeping.audit import AuditReading, read_audit
from carpus.core.safekeeping.backup import log_was_cut
from carpus.core.safekeeping.erasure import Erased, ErasurePlan
from carpus.core.safekeeping.retention import Due, due


@dataclass(frozen=True, slots=True)
class Archived:
    """A patient or a session in the archive: ``identity`` brings it back; ``recorded`` None for a patient."""

    identity: str
    pseudonym: str
    since: datetime
    sessions: int
    recorded: datetime | None = None
    session_id: str = ""


class Records:
    """Plans are made first and shown; what a plan says is what goes."""

    def __init__(self, library: Library) -> None:
        self._library = library

    def plan_session(self, session_id: str) -> ErasurePlan:
        """What goes with a session. Raises :class:`SessionUnreadable` for one that is not there."""
        return erasure.plan_session(self._library.register_of(session_id), session_id)

    def plan_patient(self, patient_id: str) -> ErasurePlan:
        """What goes with a patient. Raises :class:`SessionUnreadable` for one that is not there."""
        try:
            return erasure.plan_patient(self._library.clinic, patient_id)
        except KeyError:
            raise SessionUnreadable(patient_id, phrase("not in the list of patients")) from None

    def erase(self, plan: ErasurePlan) -> Erased:
        """Do what a plan says. Raises what :func:`erasure.erase` does."""
        library = self._library
        register = library.register_of(plan.identity) if plan.kind == "session" else library.clinic
        if plan.kind == "patient":
            library.forget_set_up(plan.identity)
        for one in plan.results:
            library.forget_figures(one.session_id)
        library.forget_pictures()
        try:
            return erasure.erase(register, plan, library.audit)
        finally:
            Corrections(library).waiting()  # new results of what is gone go with it

    def archive_session(self, session_id: str) -> None:
        """Out of every list and count."""
        register = self._library.register_of(session_id)
        register.archive(register.session(session_id).recording_id)
        self._library.note_session("archived", session_id)

    def archive_patient(self, patient_id: str) -> None:
        """Out of every list and count."""
        self._library.clinic.archive(patient_id)
        self._library.note_patient("archived", patient_id)

    def bring_back(self, identity: str) -> None:
        """A patient or a session, by :attr:`Archived.identity`."""
        self._library.clinic.bring_back(identity)
        sessions = self._library.clinic.results_of_recording(identity)
        if sessions:
            self._library.note_session("brought_back", sessions[0].session_id)
        else:
            self._library.note_patient("brought_back", identity)

    def archived(self) -> list[Archived]:
        """What can be brought back, last archived first."""
        clinic = self._library.clinic
        found = []
        for identity, since in clinic.archived().items():
            results = clinic.results_of_recording(identity)
            try:
                patient_id = clinic.owner(results[0].session_id) if results else identity
                pseudonym = clinic.patient(patient_id).entry.pseudonym
            except KeyError:
                continue
            recordings = {one.recording_id for one in (results or clinic.sessions(identity, archived=True))}
            recorded = results[0].recorded if results else None
            session_id = results[0].session_id if results else ""
            found.append(Archived(identity, pseudonym, since, len(recordings), recorded, session_id))
        return sorted(found, key=lambda one: one.since, reverse=True)

    def due(self, years: int, today: date) -> list[Due]:
        """Patients of whom nothing need be kept any more."""
        return due(self._library.clinic, years, today)

    def audit_was_cut(self) -> bool:
        """Whether lines were taken off the end of the log that the last back-up knew."""
        return log_was_cut(self._library.folder, read_audit(self._library.folder))

    def audit(self) -> AuditReading:
        """The log of what was done; that it was read is in it too, after what is returned."""
        reading = read_audit(self._library.folder)
        self._library.note("read_log")
        return reading

    def names(self) -> dict[str, str]:
        """Pseudonyms of the patients, and of those whose sessions there are, by identity: of who was erased there is
        none."""
        clinic = self._library.clinic
        known = {record.patient_id: record.entry.pseudonym for record in clinic.patients(archived=True)}
        for patient_id, pseudonym in [*known.items()]:
            for entry in clinic.sessions(patient_id, archived=True):
                known[entry.session_id] = f"{pseudonym}, {entry.recorded:%Y-%m-%d %H:%M}"
        known[PRACTICE_PATIENT] = "practice"
        return known
