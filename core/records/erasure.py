"""A session, or a patient, deleted with everything: rows are marked, then files go, then the rows.

An erasure that is cut short is finished when the store is opened next. Only files in the folder of the sessions, and
what Carpus keeps beside it, are touched: by relative paths without links; where a link leads elsewhere, nothing is
begun. What lies outside the patient's folder and is no session's stays and is listed for a person, and so are reports
and exports that were saved elsewhere; back-ups stay. What is deleted is overwritten in the store; what the disk itself
keeps of deleted files only its encryption protects.
"""

from __future__ import annotations

import contextlib
import glob
import re
import shutil
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from sqlalchemy import delete, select

from carpus.core.errors import ChangedMeanwhile, DiskFull, ErasureLeadsOut, ErasureUnfinished, FolderMissing
from carpus.core.names import folded
from carpus.core.records.changes import ERASED, RowChange, changed, dropped, fingerprint, is_identity
from carpus.core.records.database import STORE_FILE
from carpus.core.records.log import Kind, Log
from carpus.core.records.of_clinic import forget_places
from carpus.core.records.of_sessions import made_from
from carpus.core.records.patients import Patients
from carpus.core.records.reserve import free_reserve
from carpus.core.records.schema import DIAGNOSIS, PATIENT, RECIPIENT, SEEN, SESSION
from carpus.core.records.session_list import (
    COPY,
    IS_THERE,
    TRIALS_FOLDER,
    FilesOfSessions,
    ListedSessions,
    look_for_share,
    remembered,
    trials_of,
)
from carpus.core.records.store import Store
from carpus.core.records.values import SessionEntry
from carpus.core.session.disk import below


@dataclass(frozen=True, slots=True)
class ErasurePlan:
    """What would go. ``sessions`` counts recordings; ``files`` lie in the data folder; ``made`` are files that Carpus
    made elsewhere and does not touch; ``outside`` lies in no patient's folder, and a person has to look at it."""

    kind: Kind
    identity: str
    patient_id: str
    pseudonym: str
    results: tuple[SessionEntry, ...]
    sessions: int
    files: tuple[Path, ...]
    size_bytes: int
    made: tuple[Path, ...]
    outside: tuple[Path, ...]


def plan_session(store: Store, session_id: str) -> ErasurePlan:
    """One recording with all its results, also those copied in since the last look. Raises KeyError for a session that
    is not in the store, :class:`ErasureLeadsOut`, :class:`FolderMissing` for a share that is away."""
    FilesOfSessions(store).take_in(tells=False)
    sessions = ListedSessions(store)
    return _plan(store, "session", session_id, sessions.owner(session_id), sessions.results_of(session_id))


def plan_patient(store: Store, patient_id: str) -> ErasurePlan:
    """A patient with all sessions, also those copied in since the last look. Raises KeyError for one that is not in the
    store, :class:`ErasureLeadsOut`, :class:`FolderMissing`."""
    FilesOfSessions(store).take_in(tells=False)
    Patients(store).one(patient_id)
    results = ListedSessions(store).of_patient(patient_id, archived=True)
    return _plan(store, "patient", patient_id, patient_id, results)


def _plan(store: Store, kind: Kind, identity: str, patient_id: str, results: Sequence[SessionEntry]) -> ErasurePlan:
    going, sessions = [patient_id] if kind == "patient" else [], [one.session_id for one in results]
    if results:
        look_for_share(store)
    links = _links(store, going, sessions)
    if links:
        raise ErasureLeadsOut(links[0])
    files = sorted(_files(store, going, sessions))
    return ErasurePlan(
        kind, identity, patient_id, Patients(store).one(patient_id).pseudonym if patient_id else "",
        tuple(results), len({one.recording_id for one in results}), tuple(files),
        sum(path.lstat().st_size for path in files), tuple(made_from(store, sessions)),
        _outside(store, patient_id) if kind == "patient" else (),
    )  # fmt: skip


def erase(store: Store, plan: ErasurePlan, log: Log) -> int:
    """Do it; how many files went. What cannot be deleted now is tried again whenever the store is opened. Of a patient
    also what came since it was planned. On a full disk the room that is kept for it is used.

    Raises :class:`ErasureUnfinished` where files are left, :class:`OutputNotWritable` or :class:`DiskFull` where it
    could not be logged and so was not begun.
    """
    try:
        return _erase(store, plan, log)
    except DiskFull:
        if not free_reserve(store.folder):
            raise
        return _erase(store, plan, log)


def _erase(store: Store, plan: ErasurePlan, log: Log) -> int:
    log.note("erase_begun", plan.kind, plan.identity, files=len(plan.files))
    FilesOfSessions(store).take_in(tells=False)
    marked = [changed(SESSION, one.session_id, erasing=1) for one in plan.results]
    of = PATIENT if plan.kind == "patient" else SESSION
    try:
        store.do([*marked, *([changed(PATIENT, plan.patient_id, erasing=1)] if of is PATIENT else [])])
    except ChangedMeanwhile:
        if store.row(select(of.c.id).where(of.c.id == plan.identity)):
            raise  # else another program has erased it meanwhile, which is what was asked for
    left = go_on(store)
    if left:
        log.note("erase_begun", plan.kind, plan.identity, left=len(left))
        raise ErasureUnfinished(left[0].name, f"{len(left)}")
    log.note("erased", plan.kind, plan.identity, files=len(plan.files))
    return len(plan.files)


def finish_erasing(store: Store, log: Log) -> frozenset[str]:
    """What an erasure that was cut short has left; called when the store is opened. Of patients who are gone by it, the
    pseudonyms, folded."""
    people = frozenset(str(row[0]) for row in store.rows(select(PATIENT.c.folded).where(PATIENT.c.erasing == 1)))
    left: list[Path] = []
    if people or store.row(select(SESSION.c.id).where(SESSION.c.erasing == 1)):
        left = go_on(store)
        log.note("erase_begun" if left else "erased", "everything", late=1, left=len(left))
    store.leave_no_trace()  # of a program that was killed before it did so
    return frozenset() if left else people


def delete_left_behind(store: Store) -> int:
    """Delete the folders of patients who were erased on another computer; how many. Raises :class:`FolderMissing` for a
    share that is away."""
    look_for_share(store)
    gone = {str(row[0]) for row in store.rows(ERASED)}
    there = [one for one in store.sessions_folder.iterdir() if one.is_dir() and not one.is_symlink()]
    there = [one for one in there if is_identity(one.name) and fingerprint(one.name) in gone]
    known = {str(row[0]) for row in store.rows(select(PATIENT.c.id))} if there else set()
    used = {Path(row.path).parts[0] for row in store.rows(select(SESSION.c.path))} if there else set()
    left = [one for one in there if one.name not in known | used]
    for folder in left:
        shutil.rmtree(folder, ignore_errors=True)  # what is held open goes at the next start
    return len(left)


def go_on(store: Store) -> list[Path]:
    """Delete the files of what is marked, then its rows; files that could not be deleted."""
    people = store.rows(select(PATIENT).where(PATIENT.c.erasing == 1))
    patients = [str(row.id) for row in people]
    mine = (SESSION.c.erasing == 1) | SESSION.c.patient_id.in_(patients)
    rows = store.rows(select(SESSION.c.id, SESSION.c.path).where(mine))
    if not people and not rows:
        return []
    sessions = [str(row.id) for row in rows]
    if rows and _is_away(store):
        return [store.sessions_folder]
    files = _files(store, patients, sessions)
    left = [*_links(store, patients, sessions), *(path for path in sorted(files) if not _gone(path))]
    if rows and _is_away(store):  # since then: nobody knows what was found and is gone
        return [store.sessions_folder]
    emptied = {folder for path in files for folder in path.parents} | set(_folders(store, patients))
    for folder in sorted(emptied, reverse=True):
        if folder.is_relative_to(store.sessions_folder) and folder != store.sessions_folder:
            with contextlib.suppress(OSError):  # another patient's session is in it
                folder.rmdir()
    if left:
        return left
    said = (one for row in people for one in (row.folded, row.name, *row.former.split("\n")))
    names = [folded(one) for one in said if one]
    # What leads here goes first: as long as the rows are marked, a kill in between is made good.
    root = store.sessions_folder
    paths = [path.relative_to(root).as_posix() for path in files if path.is_relative_to(root)]
    forget_places(store.folder, names)
    store.own(
        *(delete(SEEN).where(SEEN.c.path == path) for path in [*paths, *(str(row.path) for row in rows)]),
        *(delete(SEEN).where(SEEN.c.reason.endswith(str(row.path), autoescape=True)) for row in rows),
    )
    naming = _naming(store, names)
    store.do([*(dropped(SESSION, one) for one in sessions), *(dropped(PATIENT, one) for one in patients), *naming])
    return [] if store.leave_no_trace() else [store.folder / f"{STORE_FILE}-wal"]


def _naming(store: Store, names: Sequence[str]) -> list[RowChange]:
    """What belongs to the clinic and has the name of one of these as a word: an address of letters, a diagnosis of the
    clinic's list. A number names nobody there: it is a street's, or a zone's."""
    named = [name for name in names if any(map(str.isalpha, name))]
    if not named:
        return []
    addresses, listed = store.rows(select(RECIPIENT)), store.rows(select(DIAGNOSIS))
    words = "|".join(map(re.escape, named))
    word = re.compile(rf"(?<![^\W_])(?:{words})(?![^\W_])")
    return [
        *(dropped(RECIPIENT, row.id) for row in addresses if word.search(folded(row.address))),
        *(dropped(DIAGNOSIS, row.id) for row in listed if word.search(folded(row.words))),
    ]


def _files(store: Store, patients: Sequence[str], sessions: Sequence[str]) -> set[Path]:
    """Every file of these: the sessions' own with what lies beside them, their copies and new results that wait, and
    all that is left in the folders of the patients; but nothing that lies beside another session under its name."""
    rows, root, going = store.rows(select(SESSION.c.id, SESSION.c.path)), store.sessions_folder, set(sessions)
    mine, files = [str(row.path) for row in rows if row.id in going], FilesOfSessions(store)
    others = {f"{root / row.path}".removesuffix(".h5") for row in rows if row.id not in going}
    own = {path for stored in mine if (path := _inside(root, stored)) is not None and path.exists()}
    found = {path for stored in mine for path in _beside(store, stored)}
    found |= {path for stored in mine for path in files.copies_of(stored) if path.is_file()}
    found |= {path for folder in _folders(store, patients) for path in _plain_files(folder)}
    found |= set(trials_of(store, going))
    return own | {path for path in found if not _is_beside(path, others)}


def _outside(store: Store, patient_id: str) -> tuple[Path, ...]:
    """What lies in no patient's folder and beside no session that is listed, folders and stores that were set aside:
    nobody but a person can tell whose it is. What is named like the patient comes first."""
    root, seen = store.sessions_folder, remembered(store)
    listed = {f"{root / row.path}".removesuffix(".h5") for row in store.rows(select(SESSION.c.path))}
    copies = {root / path for path, one in seen.items() if one.reason.startswith(COPY)}
    found = {
        path
        for path in _plain_files(root)
        if not is_identity(path.relative_to(root).parts[0]) and path.name != IS_THERE and not _is_beside(path, listed)
    } - copies
    sessions = [str(row.id) for row in store.rows(select(SESSION.c.id))]
    found |= set(_plain_files(store.folder / TRIALS_FOLDER)) - set(trials_of(store, sessions))
    stem, suffix = STORE_FILE.split(".")
    found |= set(store.folder.glob(f"{stem}.*-*.{suffix}"))
    found |= set(store.folder.parent.glob(f"{glob.escape(store.folder.name)}.before-restore-*"))
    names = [_joined(one) for one in _names_of(store, patient_id)]
    return tuple(sorted(found, key=lambda path: (not any(one in _joined(f"{path}") for one in names), path)))


def _joined(text: str) -> str:
    """A text as it may stand in names of files."""
    return re.sub(r"\W+", "-", folded(text))


def _names_of(store: Store, patient_id: str) -> list[str]:
    row = store.row(select(PATIENT).where(PATIENT.c.id == patient_id))
    return [one for one in (row.pseudonym, row.name, *row.former.split("\n")) if one] if row is not None else []


def _beside(store: Store, stored: str) -> set[Path]:
    """A session's file and all that lies beside it under its name; nothing for a path that leads elsewhere."""
    path = _inside(store.sessions_folder, stored)
    return set() if path is None else {
        one
        for hidden in ("", ".")
        for one in path.parent.glob(f"{hidden}{glob.escape(path.stem)}.*")
        if one.is_file() or one.is_symlink()
    }  # fmt: skip


def _is_beside(path: Path, stems: Collection[str]) -> bool:
    """Whether a file lies beside one of these under its name."""
    parts = path.name.split(".")
    return any(str(path.with_name(".".join(parts[:end]))) in stems for end in range(2 - bool(parts[0]), len(parts)))


def _is_away(store: Store) -> bool:
    """Whether the clinic's share is not there: the files would come back with it."""
    try:
        look_for_share(store)
    except FolderMissing:
        return True
    return False


def _links(store: Store, patients: Sequence[str], sessions: Sequence[str]) -> list[Path]:
    """Links on the way to what is to go: nobody knows what else lies behind them."""
    root = store.sessions_folder
    ways = {folder / "_" for folder in _folders(store, patients)}
    for row in store.rows(select(SESSION.c.path).where(SESSION.c.id.in_(sessions))):
        ways |= {root / row.path} if ".." not in Path(row.path).parts else set()
    on_way = {one for way in ways for one in (way, *way.parents) if one != root and one.is_relative_to(root)}
    return sorted(one for one in on_way if one.is_symlink())


def _folders(store: Store, patients: Sequence[str]) -> list[Path]:
    """Of these patients; an identity that this program did not give names none, for it could lead anywhere."""
    return [store.sessions_folder / one for one in patients if is_identity(one)]


def _inside(folder: Path, stored: str) -> Path | None:
    """The path below a folder, None where it would lead out of it, by its name or by a link on its way."""
    path = folder / stored
    parts = Path(stored).parts
    if not parts or Path(stored).is_absolute() or ".." in parts:
        return None
    return None if any(one.is_symlink() for one in [*path.parents][: len(parts) - 1]) else path


def _plain_files(folder: Path) -> Iterator[Path]:
    if not folder.is_symlink():
        yield from (path for path in below(folder) if path.is_symlink() or path.is_file())


def _gone(path: Path) -> bool:
    try:
        path.unlink(missing_ok=True)
    except OSError:
        return False
    return True
