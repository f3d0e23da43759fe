"""Registration of sessions: new ones, interrupted ones and those that waited on this computer."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from datetime import datetime
from functools import partial
from pathlib import Path

import numpy as np

from carpus.core.calibration.result import ALL_STRAIGHT
from carpus.core.model import errors
from carpus.core.model.errors import CarpusFault
from carpus.core.model.phrase import phrase
from carpus.core.platform.durable import make_private_folder, write_fault
from carpus.core.records.changes import ERASED_SUBJECTS, fingerprint, is_patient_id
from carpus.core.records.data_folder import DataFolder
from carpus.core.records.erasure import delete_orphan_folders
from carpus.core.records.patients import save_setup
from carpus.core.records.recordings import (
    copy_session,
    import_spooled,
    recover_recordings,
    remove_published,
    spool_folder,
)
from carpus.core.records.session_list import SessionFileScanner, check_share, free_session_path
from carpus.core.records.session_setup import PRACTICE_PATIENT, SessionSetup
from carpus.core.records.values import entry_from_outline, read_or_default
from carpus.core.results.progress import INVALIDATING_FINDINGS
from carpus.core.session.reader import read_outline, read_session

_MOVE_LOCK = threading.Lock()
"""Keeps a session that is being published from being imported at the same time."""
MAX_LISTED_FILES = 3
"""More unreadable files are reported together."""


@dataclass(frozen=True, slots=True)
class RecoveredSession:
    """Interrupted session that was completed; ``duration_s`` of it are saved."""

    patient_id: str
    session_id: str
    pseudonym: str
    when: datetime
    duration_s: float


def recover_sessions(library: DataFolder) -> tuple[Sequence[RecoveredSession], Sequence[CarpusFault]]:
    """Complete interrupted sessions, and list them and files that were copied in."""
    faults = [*library.startup_faults, *library.store.startup_faults]
    library.startup_faults, library.store.startup_faults = [], []
    try:
        library.resume_erasures()
        if not library.store.sessions_folder.is_dir():  # a share: it is neither made nor taken for empty
            raise errors.FolderMissing(library.store.sessions_folder)
        check_share(library.store)
    except (errors.ServerUnavailable, errors.FolderMissing) as fault:  # all of this when it is back
        return [], [*faults, fault]
    recovered, spool_faults = list[Path](), list[CarpusFault]()
    if _MOVE_LOCK.acquire(blocking=False):  # else another thread is at it
        try:
            recovered, spool_faults = import_spooled(library.folder, partial(_session_folder, library))
        finally:
            _MOVE_LOCK.release()
    faults += [*spool_faults, *([errors.SpooledSessionErased()] * delete_orphan_folders(library.store))]
    files = SessionFileScanner(library.store)
    part_files = recover_recordings(library.store.sessions_folder, ignored=files.unrecoverable_parts())
    file_faults = [*files.filter_new_faults(part_files.faults), *files.scan().faults]
    library.unlisted = {
        key: one for key, one in library.unlisted.items() if one.path.exists() and not library.is_listed(key)
    }
    found: list[RecoveredSession] = []
    for path in (*recovered, *part_files.recovered):
        outline = read_outline(path)
        header = outline.header
        library.audit_log.log_session("recovered", header.session_id)
        owner = library.owner_id(header.session_id)
        pseudonym = library.patients.get(owner).pseudonym if owner else header.subject_id
        found.append(RecoveredSession(owner, header.session_id, pseudonym, header.recording_time, outline.duration_s))
    if len(file_faults) > MAX_LISTED_FILES:
        names = ", ".join(Path(fault.subject).name for fault in file_faults[:MAX_LISTED_FILES])
        file_faults = [errors.SessionFilesIgnored(f"{names}, …", phrase("{count} files", count=len(file_faults)))]
    return found, [*faults, *file_faults]


def _session_folder(library: DataFolder, patient_id: str, subject_id: str) -> Path | None:
    """Return the session folder of a patient or pseudonym, None for an erased patient."""
    owner = PRACTICE_PATIENT if subject_id == PRACTICE_PATIENT else library.patients.id_of_pseudonym(subject_id)
    if is_patient_id(patient_id):
        if fingerprint(patient_id) in library.store.scalars(ERASED_SUBJECTS):
            return None
        if not owner or library.patients.has(patient_id):  # else given while the server was away
            owner = patient_id
    return library.store.sessions_folder / (owner or "unknown")


PUBLISH_TIMEOUT_S = 10.0
"""After that the session stays on this computer for now, where it can be reviewed."""


def _publish(path: Path, get_folder: Callable[[], Path]) -> Path:
    """Publish a session with a time limit; a late copy is found by the next scan."""
    done: list[Path | CarpusFault] = []

    def copy() -> None:
        try:
            done.append(copy_session(path, get_folder()))
        except CarpusFault as fault:
            done.append(fault)
        except OSError as cause:
            done.append(write_fault(path, cause))

    thread = threading.Thread(target=copy, name="publishing", daemon=True)
    if _MOVE_LOCK.acquire(timeout=PUBLISH_TIMEOUT_S):
        try:
            thread.start()
            thread.join(PUBLISH_TIMEOUT_S)
            if done and isinstance(done[0], Path):
                remove_published(path)
        finally:
            _MOVE_LOCK.release()
    if not done:
        raise errors.OutputNotWritable(path, phrase("no answer for {seconds} s", seconds=f"{PUBLISH_TIMEOUT_S:.0f}"))
    if isinstance(done[0], CarpusFault):
        raise done[0]
    return done[0]


class SessionIntake:
    """Paths and registration of new sessions."""

    def __init__(self, library: DataFolder) -> None:
        self._library = library

    def new_path(self, set_up: SessionSetup) -> Path:
        """Return a free path on this computer, whatever happens to the data folder.

        Raises :class:`OutputNotWritable`.
        """
        folder = spool_folder(self._library.folder) / set_up.patient_id
        make_private_folder(folder)
        return free_session_path(folder, set_up.pseudonym, set_up.exercise.id, set_up.side, datetime.now().astimezone())

    def register(self, set_up: SessionSetup, path: Path) -> str:
        """Publish and list a finished session and save its set-up; return its id.

        If the folder or the store cannot be reached, it waits on this computer and a fault is reported.
        """
        library = self._library
        try:
            path = _publish(path, partial(library.session_list.patient_folder, set_up.patient_id))
            save_setup(library.store, set_up)
            session_id = library.session_list.add(path, set_up.patient_id, library.get_initials()).session_id
        except CarpusFault as fault:
            entry = entry_from_outline(path, read_outline(path))
            library.unlisted[entry.session_id] = entry
            if not isinstance(
                fault, (errors.ServerUnavailable, errors.ConcurrentChange)
            ):  # else it is listed when the server is back
                library.on_fault(errors.SessionSpooled(path, fault.detail or phrase("not available now")))
            return entry.session_id
        library.audit_log.log_session("recorded", session_id)
        return session_id

    def last_hand_length_mm(self, set_up: SessionSetup, *, simulated: bool) -> float:
        """Return the length of this hand in the last session of the kind, NaN before the first."""
        for entry in read_or_default(lambda: self._library.sessions(set_up.patient_id), ()):
            if entry.hand != set_up.side:
                continue
            with suppress(errors.SessionUnreadable):
                session = read_session(entry.path)
                verdict = session.calibration.verdict
                # Another length that was accepted is the hand's from now on; only wrong names measured no hand.
                doubted = any(
                    finding.kind in INVALIDATING_FINDINGS
                    for finding in verdict.findings
                    if finding.kind != "other_length"
                )
                if session.header.is_simulated == simulated and not doubted and np.isfinite(verdict.hand_length_mm):
                    return verdict.hand_length_mm
        return float("nan")

    def last_straight_fingers(self, set_up: SessionSetup) -> tuple[bool, ...]:
        """Return which fingers (thumb to little) were straight at the last calibration with these markers."""
        if set_up.protocol.has_fingers:
            for entry in read_or_default(lambda: self._library.matching_sessions(set_up.patient_id, set_up), ()):
                with suppress(errors.SessionUnreadable):
                    return read_session(entry.path).calibration.straight_fingers
        return ALL_STRAIGHT

    def recover_interrupted(self) -> None:
        with suppress(CarpusFault):
            recover_sessions(self._library)
