"""How sessions come into the store: those measured now, with what the last one said of the hand; those that were cut
short; and those that waited on this computer."""

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
from carpus.core.durable import make_private, write_fault
from carpus.core.errors import (
    CarpusFault,
    ChangedMeanwhile,
    FilesSetApart,
    FolderMissing,
    OutputNotWritable,
    RecordingWaits,
    ServerGone,
    SessionUnreadable,
    WaitingErased,
)
from carpus.core.phrase import phrase
from carpus.core.records.changes import is_identity
from carpus.core.records.erasure import delete_left_behind
from carpus.core.records.kept_sets import keep_set_up
from carpus.core.records.library import Library
from carpus.core.records.log import was_erased
from carpus.core.records.recordings import (
    bring_home,
    copy_session,
    recordings_folder,
    recover_recordings,
    remove_published,
)
from carpus.core.records.session_list import FilesOfSessions, free_path, look_for_share
from carpus.core.records.set_up import PRACTICE_PATIENT, SetUp
from carpus.core.records.values import entry_of, unless_away
from carpus.core.results.progress import NAMES_DOUBTED
from carpus.core.session.reader import read_outline, read_session

_MOVING = threading.Lock()
"""Held by who moves sessions from this computer: what Stop is publishing is not brought home as well, as when the
server comes back at that moment."""
MOST_TOLD = 3
"""Files that are told one by one when the program starts; more are told together."""


@dataclass(frozen=True, slots=True)
class Recovered:
    """A session that had been cut short and has been finished; ``kept_s`` of it are there."""

    patient_id: str
    session_id: str
    pseudonym: str
    when: datetime
    kept_s: float


def recover(library: Library) -> tuple[Sequence[Recovered], Sequence[CarpusFault]]:
    """Finish interrupted sessions; take these, and files that were copied in, into the store."""
    faults = [*library.told, *library.store.told]
    library.told, library.store.told = [], []
    try:
        library.finish_erasing()
    except ServerGone as fault:  # all of this when it is back
        return [], [*faults, fault]
    if not library.store.sessions_folder.is_dir():  # a share: it is neither made nor taken for empty
        return [], [*faults, FolderMissing(library.store.sessions_folder)]
    try:
        look_for_share(library.store)
    except FolderMissing as fault:
        return [], [*faults, fault]
    recovered, told = list[Path](), list[CarpusFault]()
    if _MOVING.acquire(blocking=False):  # else another thread is at it
        try:
            recovered, told = bring_home(library.folder, partial(_folder_of, library))
        finally:
            _MOVING.release()
    faults += [*told, *([WaitingErased()] * delete_left_behind(library.store))]
    files = FilesOfSessions(library.store)
    of_before = recover_recordings(library.store.sessions_folder, given_up=files.given_up())
    apart = [*files.first_told(of_before.faults), *files.take_in().faults]
    library.elsewhere = {
        key: one for key, one in library.elsewhere.items() if one.path.exists() and not library.is_listed(key)
    }
    found: list[Recovered] = []
    for path in (*recovered, *of_before.recovered):
        outline = read_outline(path)
        header = outline.header
        library.notes.session("recovered", header.session_id)
        owner = library.owner(header.session_id)
        pseudonym = library.patients.one(owner).pseudonym if owner else header.subject_id
        found.append(Recovered(owner, header.session_id, pseudonym, header.when, outline.duration_s))
    if len(apart) > MOST_TOLD:
        names = ", ".join(Path(fault.subject).name for fault in apart[:MOST_TOLD])
        apart = [FilesSetApart(f"{names}, …", phrase("{count} files", count=len(apart)))]
    return found, [*faults, *apart]


def _folder_of(library: Library, patient_id: str, subject_id: str) -> Path | None:
    """Where recordings of a patient lie, or of a pseudonym; None for a patient who was erased."""
    owner = PRACTICE_PATIENT if subject_id == PRACTICE_PATIENT else library.patients.called(subject_id)
    if is_identity(patient_id):
        if was_erased(library.store, patient_id):
            return None
        if not owner or library.patients.has(patient_id):  # else given while the server was away
            owner = patient_id
    return library.store.sessions_folder / (owner or "unknown")


PUBLISHED_WITHIN_S = 10.0
"""A share that hangs is waited for so long; the session then waits on this computer, where it can be reviewed."""


def _published(path: Path, folder_for: Callable[[], Path]) -> Path:
    """As :func:`publish_session`, for a person who waits. What arrives later than that is found at the next look."""
    done: list[Path | CarpusFault] = []

    def work() -> None:
        try:
            done.append(copy_session(path, folder_for()))
        except CarpusFault as fault:
            done.append(fault)
        except OSError as cause:
            done.append(write_fault(path, cause))

    thread = threading.Thread(target=work, name="publishing", daemon=True)
    if _MOVING.acquire(timeout=PUBLISHED_WITHIN_S):
        try:
            thread.start()
            thread.join(PUBLISHED_WITHIN_S)
            if done and isinstance(done[0], Path):
                remove_published(path)
        finally:
            _MOVING.release()
    if not done:
        raise OutputNotWritable(path, phrase("no answer for {seconds} s", seconds=f"{PUBLISHED_WITHIN_S:.0f}"))
    if isinstance(done[0], CarpusFault):
        raise done[0]
    return done[0]


class NewSessions:
    """Where sessions that are measured go in a data folder, and who hears of a finished one."""

    def __init__(self, library: Library) -> None:
        self._library = library

    def new_path(self, set_up: SetUp) -> Path:
        """A free path on this computer for a session that begins now, whatever the data folder does meanwhile. Raises
        :class:`OutputNotWritable`."""
        folder = recordings_folder(self._library.folder) / set_up.patient_id
        make_private(folder)
        return free_path(folder, set_up.pseudonym, set_up.exercise.id, set_up.side, datetime.now().astimezone())

    def entered(self, set_up: SetUp, path: Path) -> str:
        """Put a finished session into the data folder and the store, and remember how it was set up. Where one of them
        cannot be reached it waits on this computer, which is told."""
        library = self._library
        try:
            path = _published(path, partial(library.index.folder_for, set_up.patient_id))
            keep_set_up(library.store, set_up)
            session_id = library.index.enter(path, set_up.patient_id, library.who()).session_id
        except CarpusFault as fault:
            entry = entry_of(path, read_outline(path))
            library.elsewhere[entry.session_id] = entry
            if not isinstance(fault, (ServerGone, ChangedMeanwhile)):  # else it is listed when the server is back
                library.log_fault(RecordingWaits(path, fault.detail or phrase("not there now")))
            return entry.session_id
        library.notes.session("recorded", session_id)
        return session_id

    def last_hand_length_mm(self, set_up: SetUp, *, simulated: bool) -> float:
        """Length of this hand of the patient as the last session of the kind measured it; NaN before the first."""
        for entry in unless_away(lambda: self._library.sessions(set_up.patient_id), ()):
            if entry.hand != set_up.side:
                continue
            with suppress(SessionUnreadable):
                session = read_session(entry.path)
                verdict = session.calibration.verdict
                # Another length that was accepted is the hand's from now on; only wrong names measured no hand.
                doubted = any(
                    finding.kind in NAMES_DOUBTED for finding in verdict.findings if finding.kind != "other_length"
                )
                if session.header.simulated == simulated and not doubted and np.isfinite(verdict.hand_length_mm):
                    return verdict.hand_length_mm
        return float("nan")

    def last_straight_fingers(self, set_up: SetUp) -> tuple[bool, ...]:
        """What the last session with these discs said of the hand's fingers, thumb to little; straight before one."""
        if set_up.protocol.has_fingers:
            for entry in unless_away(lambda: self._library.sessions_alike(set_up.patient_id, set_up), ()):
                with suppress(SessionUnreadable):
                    return read_session(entry.path).calibration.straight_fingers
        return ALL_STRAIGHT

    def cut_short(self) -> None:
        """Finish what a fault left behind, as far as possible."""
        with suppress(CarpusFault):
            recover(self._library)
