"""Sessions that were cut short, and files that came from elsewhere: finished, and taken into the store."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime
from functools import partial
from pathlib import Path

from carpus.core.errors import CarpusFault, FilesSetApart, FolderMissing
from carpus.core.phrase import phrase
from carpus.core.records.changes import is_identity
from carpus.core.records.coming_home import bring_home
from carpus.core.records.library import Library
from carpus.core.records.log import was_erased
from carpus.core.records.session_list import FilesOfSessions, look_for_share
from carpus.core.records.set_up import PRACTICE_PATIENT
from carpus.core.session.reader import read_outline
from carpus.core.session.recovery import recover_folder

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
