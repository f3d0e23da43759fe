"""How sessions come into the store: those measured now, with what the last one said of the hand; those that were cut
short; those from elsewhere; and recordings that went on in another folder when theirs went away."""

from __future__ import annotations

import contextlib
import hashlib
import shutil
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from datetime import datetime
from functools import partial
from pathlib import Path

import numpy as np
import platformdirs

from carpus.core.calibration.result import ALL_STRAIGHT
from carpus.core.capture.files.raw import SUFFIX as RAW_SUFFIX
from carpus.core.durable import make_private, sync_folder, write_fault
from carpus.core.errors import (
    CarpusFault,
    DiskFull,
    FilesSetApart,
    FolderMissing,
    OutputNotWritable,
    RecordingMoved,
    RecordingReturned,
    SessionUnreadable,
    WaitingErased,
)
from carpus.core.phrase import phrase
from carpus.core.records.changes import is_identity
from carpus.core.records.kept_sets import keep_set_up
from carpus.core.records.library import Library
from carpus.core.records.log import was_erased
from carpus.core.records.session_list import FilesOfSessions, free_path, look_for_share
from carpus.core.records.set_up import MARKERS_SUFFIX, PRACTICE_PATIENT, SetUp
from carpus.core.records.values import entry_of
from carpus.core.results.progress import NAMES_DOUBTED
from carpus.core.session.disk import free_name
from carpus.core.session.reader import read_outline, read_session
from carpus.core.session.recovery import recover_folder


def fallback_place(data_folder: Path) -> Path:
    """On the disk of this computer, one folder for each data folder; nothing is made."""
    name = hashlib.sha256(str(data_folder.absolute()).encode()).hexdigest()[:12]
    return Path(platformdirs.user_state_dir("carpus", appauthor=False)) / "recorded-elsewhere" / name


def bring_home(data_folder: Path, folder_of: Callable[[str, str], Path | None]) -> list[CarpusFault]:
    """Finish what was recorded elsewhere and move it among the sessions, into the folder of each patient, by identity
    and pseudonym; of whom there is none, it is erased. Tells of each, and of what could not be."""
    place = fallback_place(data_folder)
    if not place.is_dir():
        return []
    found = recover_folder(place)
    told: list[CarpusFault] = []
    erased = [one for one in sorted(place.iterdir()) if one.is_dir() and folder_of(one.name, "") is None]
    for folder in erased if not found.busy else ():
        try:
            shutil.rmtree(folder)  # also what cannot be read, and pictures without a session
            told.append(WaitingErased())
        except OSError as cause:
            told.append(write_fault(place, cause))
    told += [fault for fault in found.faults if not any(Path(fault.subject).is_relative_to(one) for one in erased)]
    for path in sorted(place.rglob("*.h5")):
        try:
            home = folder_of(path.parent.name, read_outline(path).header.subject_id)
            told.append(WaitingErased() if home is None else RecordingReturned(_home(path, home)))
            for suffix in (".h5", RAW_SUFFIX, MARKERS_SUFFIX):
                path.with_suffix(suffix).unlink(missing_ok=True)
            if path.parent != place:
                with contextlib.suppress(OSError):  # another recording waits in it
                    path.parent.rmdir()
        except CarpusFault as fault:
            told.append(fault)
        except OSError as cause:
            told.append(write_fault(data_folder, cause))
    return told


def _home(path: Path, folder: Path) -> Path:
    make_private(folder)
    target = free_name(folder / path.name)
    for suffix in (RAW_SUFFIX, MARKERS_SUFFIX, ".h5"):  # the session last: what goes with it is there when it comes
        source = path.with_suffix(suffix)
        if source.is_file():
            part = target.with_suffix(suffix + ".arriving")
            shutil.copyfile(source, part)
            part.chmod(0o600)
            part.rename(target.with_suffix(suffix))
    sync_folder(folder)
    return target


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
    if not library.store.sessions_folder.is_dir():  # a share: it is neither made nor taken for empty
        return [], [*faults, FolderMissing(library.store.sessions_folder)]
    try:
        look_for_share(library.store)
    except FolderMissing as fault:
        return [], [*faults, fault]
    if library.store.knows_all():  # who was erased meanwhile is brought back by nothing
        faults += bring_home(library.folder, partial(_folder_of, library))
    files = FilesOfSessions(library.store)
    recovery = recover_folder(library.store.sessions_folder, given_up=files.given_up())
    apart = [*files.first_told(recovery.faults), *files.take_in().faults]
    found: list[Recovered] = []
    for path in recovery.recovered:
        outline = read_outline(path)
        header = outline.header
        library.notes.session("recovered", header.session_id)
        owner = library.owner(header.session_id)
        pseudonym = library.patients.one(owner).entry.pseudonym if owner else header.subject_id
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
        owner = patient_id
    return library.store.sessions_folder / (owner or "unknown")


class NewSessions:
    """Where sessions that are measured go in a data folder, and who hears of a finished one."""

    def __init__(self, library: Library) -> None:
        self._library = library

    def new_path(self, set_up: SetUp) -> Path:
        """A free path for a session that begins now: on this computer while a share is away, which is told."""
        library = self._library
        about = set_up.pseudonym, set_up.exercise.id, set_up.side, datetime.now().astimezone()
        try:
            return library.index.new_path(set_up.patient_id, *about)
        except (FolderMissing, OutputNotWritable, DiskFull) as fault:
            if not library.store.on_share:
                raise
            path = free_path(self.fallback_folder(set_up.patient_id), *about)
            library.log_fault(RecordingMoved(path, fault.detail or phrase("not there now")))
            return path

    def entered(self, set_up: SetUp, path: Path) -> str:
        """Take a finished session into the store, and remember how it was set up."""
        library = self._library
        if path.is_relative_to(fallback_place(library.folder)):  # the store is where the data folder is: gone
            entry = entry_of(path, read_outline(path))
            library.elsewhere[entry.session_id] = entry
            return entry.session_id
        keep_set_up(library.store, set_up)
        session_id = library.index.enter(path, set_up.patient_id, library.who()).session_id
        library.notes.session("recorded", session_id)
        return session_id

    def fallback_folder(self, patient_id: str) -> Path:
        """Where a patient's recording goes on when the data folder goes away."""
        folder = fallback_place(self._library.folder) / patient_id
        make_private(folder)
        return folder

    def last_hand_length_mm(self, set_up: SetUp, *, simulated: bool) -> float:
        """Length of this hand of the patient as the last session of the kind measured it; NaN before the first."""
        for entry in self._library.sessions(set_up.patient_id):
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
            for entry in self._library.sessions_alike(set_up.patient_id, set_up):
                with suppress(SessionUnreadable):
                    return read_session(entry.path).calibration.straight_fingers
        return ALL_STRAIGHT

    def cut_short(self) -> None:
        """Finish what a fault left behind, as far as possible."""
        with suppress(CarpusFault):
            recover(self._library)
