"""Erasure of a session or patient: rows are marked, files deleted, then the rows.

An interrupted erasure is finished when the store is opened next. Only files in the session folder and beside it are
deleted, by relative paths without links; if a link leads elsewhere, nothing is started. Files outside the patient's
folder that belong to no session, and reports and exports saved elsewhere, are listed for a person; backups stay. The
store overwrites what it deletes; on the disk only its encryption protects deleted files.
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

from carpus.core.model import errors
from carpus.core.model.names import fold_name
from carpus.core.platform.durable import iter_paths
from carpus.core.records.changes import ERASED_SUBJECTS, RowChange, delete_row, fingerprint, is_patient_id, update_row
from carpus.core.records.clinic_records import clear_places
from carpus.core.records.database import STORE_FILE
from carpus.core.records.log import AuditLogWriter, SubjectKind
from carpus.core.records.patients import Patients
from carpus.core.records.schema import DIAGNOSIS, FILE_STATE, PATIENT, RECIPIENT, SESSION
from carpus.core.records.session_list import (
    COPY_REASON,
    PENDING_FOLDER,
    SHARE_MARKER,
    SessionFileScanner,
    SessionList,
    check_share,
    find_pending_results,
    read_file_states,
)
from carpus.core.records.session_records import find_output_files
from carpus.core.records.store import Store
from carpus.core.records.values import SessionEntry


@dataclass(frozen=True, slots=True)
class ErasurePlan:
    """What an erasure would delete.

    ``files`` lie in the data folder, ``output_files`` were made elsewhere and stay, ``unassigned_files`` lie in no
    patient's folder and must be checked by a person.
    """

    kind: SubjectKind
    subject_id: str
    patient_id: str
    pseudonym: str
    results: tuple[SessionEntry, ...]
    recording_count: int
    files: tuple[Path, ...]
    size_bytes: int
    output_files: tuple[Path, ...]
    unassigned_files: tuple[Path, ...]


def plan_session(store: Store, session_id: str) -> ErasurePlan:
    """Plan the erasure of a recording with all its results, also those copied in since.

    Raises :class:`SessionUnreadable` without such a session, :class:`ErasureBlockedByLink`, and :class:`FolderMissing`
    while the share is away.
    """
    SessionFileScanner(store).scan(reports_faults=False)
    sessions = SessionList(store)
    return _build_plan(
        store, "session", session_id, sessions.owner_id(session_id), sessions.result_versions(session_id)
    )


def plan_patient(store: Store, patient_id: str) -> ErasurePlan:
    """Plan the erasure of a patient with all sessions, also those copied in since.

    Raises :class:`SessionUnreadable` without such a patient, :class:`ErasureBlockedByLink`, :class:`FolderMissing`.
    """
    SessionFileScanner(store).scan(reports_faults=False)
    Patients(store).get(patient_id)
    results = SessionList(store).patient_sessions(patient_id, include_archived=True)
    return _build_plan(store, "patient", patient_id, patient_id, results)


def _build_plan(
    store: Store, kind: SubjectKind, subject_id: str, patient_id: str, results: Sequence[SessionEntry]
) -> ErasurePlan:
    going, sessions = [patient_id] if kind == "patient" else [], [one.session_id for one in results]
    if results:
        check_share(store)
    links = _symlinks_on_path(store, going, sessions)
    if links:
        raise errors.ErasureBlockedByLink(links[0])
    files = sorted(_files_to_delete(store, going, sessions))
    return ErasurePlan(
        kind, subject_id, patient_id, Patients(store).get(patient_id).pseudonym if patient_id else "",
        tuple(results), len({one.recording_id for one in results}), tuple(files),
        sum(path.lstat().st_size for path in files), tuple(find_output_files(store, sessions)),
        _find_unassigned_files(store, patient_id) if kind == "patient" else (),
    )  # fmt: skip


def erase(store: Store, plan: ErasurePlan, log: AuditLogWriter) -> int:
    """Erase as planned; return the number of files.

    Files that cannot be deleted are tried again when the store is opened. A patient's sessions added since the plan go
    too. Raises :class:`ErasureUnfinished` if files are left, and :class:`OutputNotWritable` or :class:`DiskFull` if it
    could not be logged and so was not started.
    """
    log.write_entry("erase_begun", plan.kind, plan.subject_id, files=len(plan.files))
    SessionFileScanner(store).scan(reports_faults=False)
    marked = [update_row(SESSION, one.session_id, erasing=1) for one in plan.results]
    of = PATIENT if plan.kind == "patient" else SESSION
    try:
        store.apply([*marked, *([update_row(PATIENT, plan.patient_id, erasing=1)] if of is PATIENT else [])])
    except errors.ConcurrentChange:
        if store.row(select(of.c.id).where(of.c.id == plan.subject_id)):
            raise  # else another program has erased it meanwhile, which is what was asked for
    remaining = delete_marked(store)
    if remaining:
        log.write_entry("erase_begun", plan.kind, plan.subject_id, left=len(remaining))
        raise errors.ErasureUnfinished(remaining[0].name, f"{len(remaining)}")
    log.write_entry("erased", plan.kind, plan.subject_id, files=len(plan.files))
    return len(plan.files)


def resume_erasures(store: Store, log: AuditLogWriter) -> frozenset[str]:
    """Finish interrupted erasures; return the folded pseudonyms of patients erased by it."""
    people = frozenset(store.scalars(select(PATIENT.c.pseudonym_key).where(PATIENT.c.erasing == 1)))
    remaining: list[Path] = []
    if people or store.row(select(SESSION.c.id).where(SESSION.c.erasing == 1)):
        remaining = delete_marked(store)
        log.write_entry("erase_begun" if remaining else "erased", "everything", late=1, left=len(remaining))
    store.purge_deleted()  # of a program that was killed before it did so
    return frozenset() if remaining else people


def delete_orphan_folders(store: Store) -> int:
    """Delete folders of patients erased on another computer; return how many.

    Raises :class:`FolderMissing` while the share is away.
    """
    check_share(store)
    gone = store.scalars(ERASED_SUBJECTS)
    there = [one for one in store.sessions_folder.iterdir() if one.is_dir() and not one.is_symlink()]
    there = [one for one in there if is_patient_id(one.name) and fingerprint(one.name) in gone]
    known = store.scalars(select(PATIENT.c.id)) if there else set()
    used = {Path(row.path).parts[0] for row in store.rows(select(SESSION.c.path))} if there else set()
    remaining = [one for one in there if one.name not in known | used]
    for folder in remaining:
        shutil.rmtree(folder, ignore_errors=True)  # what is held open goes at the next start
    return len(remaining)


def delete_marked(store: Store) -> list[Path]:
    """Delete the files of marked rows, then the rows; return files that could not be deleted."""
    people = store.rows(select(PATIENT).where(PATIENT.c.erasing == 1))
    patients = [str(row.id) for row in people]
    is_erased = (SESSION.c.erasing == 1) | SESSION.c.patient_id.in_(patients)
    rows = store.rows(select(SESSION.c.id, SESSION.c.path).where(is_erased))
    if not people and not rows:
        return []
    sessions = [str(row.id) for row in rows]
    if rows and _is_share_away(store):
        return [store.sessions_folder]
    files = _files_to_delete(store, patients, sessions)
    remaining = _symlinks_on_path(store, patients, sessions)
    for path in sorted(files):
        try:
            path.unlink(missing_ok=True)
        except OSError:
            remaining.append(path)
    if rows and _is_share_away(store):  # since then: nobody knows what was found and is gone
        return [store.sessions_folder]
    folders = {folder for path in files for folder in path.parents} | set(_patient_folders(store, patients))
    for folder in sorted(folders, reverse=True):
        if folder.is_relative_to(store.sessions_folder) and folder != store.sessions_folder:
            with contextlib.suppress(OSError):  # another patient's session is in it
                folder.rmdir()
    if remaining:
        return remaining
    stored_names = (one for row in people for one in (row.pseudonym_key, row.name, *row.former_pseudonyms.split("\n")))
    names = [fold_name(one) for one in stored_names if one]
    # What leads here goes first: as long as the rows are marked, a kill in between is made good.
    root = store.sessions_folder
    paths = [path.relative_to(root).as_posix() for path in files if path.is_relative_to(root)]
    clear_places(store.folder, names)
    store.execute_local(
        *(delete(FILE_STATE).where(FILE_STATE.c.path == path) for path in [*paths, *(str(row.path) for row in rows)]),
        *(delete(FILE_STATE).where(FILE_STATE.c.reason.endswith(str(row.path), autoescape=True)) for row in rows),
    )
    naming = _clinic_rows_naming(store, names)
    store.apply(
        [*(delete_row(SESSION, one) for one in sessions), *(delete_row(PATIENT, one) for one in patients), *naming]
    )
    return [] if store.purge_deleted() else [store.folder / f"{STORE_FILE}-wal"]


def _clinic_rows_naming(store: Store, names: Sequence[str]) -> list[RowChange]:
    """Return deletions of addresses and listed diagnoses that contain one of the names as a word.

    Names without letters are left out: a number may be that of a street.
    """
    named = [name for name in names if any(map(str.isalpha, name))]
    if not named:
        return []
    addresses, listed = store.rows(select(RECIPIENT)), store.rows(select(DIAGNOSIS))
    words = "|".join(map(re.escape, named))
    word = re.compile(rf"(?<![^\W_])(?:{words})(?![^\W_])")
    return [
        *(delete_row(RECIPIENT, row.id) for row in addresses if word.search(fold_name(row.address))),
        *(delete_row(DIAGNOSIS, row.id) for row in listed if word.search(fold_name(row.words))),
    ]


def _files_to_delete(store: Store, patients: Sequence[str], sessions: Sequence[str]) -> set[Path]:
    """Return the sessions' files with companions, copies and pending results, and the patients' folders' files.

    Companions of other sessions are left out.
    """
    rows, root, erased = store.rows(select(SESSION.c.id, SESSION.c.path)), store.sessions_folder, set(sessions)
    other_stems = {f"{root / row.path}".removesuffix(".h5") for row in rows if row.id not in erased}
    session_files, found, states = set[Path](), set[Path](), read_file_states(store)
    for stored in (str(row.path) for row in rows if row.id in erased):
        copies = (root / path for path, one in states.items() if one.reason == f"{COPY_REASON}{stored}")
        found |= {path for path in copies if path.is_file()}
        if (path := _resolve_inside(root, stored)) is not None:
            session_files |= {path} if path.exists() else set()
            beside = [
                *path.parent.glob(f"{glob.escape(path.stem)}.*"),
                *path.parent.glob(f".{glob.escape(path.stem)}.*"),
            ]
            found |= {one for one in beside if one.is_file() or one.is_symlink()}
    found |= {path for folder in _patient_folders(store, patients) for path in _list_files(folder)}
    found |= set(find_pending_results(store, erased))
    return session_files | {path for path in found if not _is_companion(path, other_stems)}


def _find_unassigned_files(store: Store, patient_id: str) -> tuple[Path, ...]:
    """Return files in no patient's folder and beside no listed session, and stores set aside.

    Those named like the patient come first.
    """
    root, seen = store.sessions_folder, read_file_states(store)
    listed = {f"{root / row.path}".removesuffix(".h5") for row in store.rows(select(SESSION.c.path))}
    copies = {root / path for path, one in seen.items() if one.reason.startswith(COPY_REASON)}
    found = {
        path
        for path in _list_files(root)
        if not is_patient_id(path.relative_to(root).parts[0])
        and path.name != SHARE_MARKER
        and not _is_companion(path, listed)
    } - copies
    sessions = [str(row.id) for row in store.rows(select(SESSION.c.id))]
    found |= set(_list_files(store.folder / PENDING_FOLDER)) - set(find_pending_results(store, sessions))
    stem, suffix = STORE_FILE.split(".")
    found |= set(store.folder.glob(f"{stem}.*-*.{suffix}"))
    found |= set(store.folder.parent.glob(f"{glob.escape(store.folder.name)}.before-restore-*"))

    def to_file_name(text: str) -> str:
        return re.sub(r"\W+", "-", fold_name(text))

    patient = store.row(select(PATIENT).where(PATIENT.c.id == patient_id))
    names = [patient.pseudonym, patient.name, *patient.former_pseudonyms.split("\n")] if patient is not None else []
    stems = [to_file_name(name) for name in names if name]
    return tuple(sorted(found, key=lambda path: (not any(one in to_file_name(f"{path}") for one in stems), path)))


def _is_companion(path: Path, stems: Collection[str]) -> bool:
    """Return whether a file lies beside one of these stems with its name."""
    parts = path.name.split(".")
    return any(str(path.with_name(".".join(parts[:end]))) in stems for end in range(2 - bool(parts[0]), len(parts)))


def _is_share_away(store: Store) -> bool:
    try:
        check_share(store)
    except errors.FolderMissing:
        return True
    return False


def _symlinks_on_path(store: Store, patients: Sequence[str], sessions: Sequence[str]) -> list[Path]:
    """Return links on the paths to delete: what lies behind them is not known."""
    root = store.sessions_folder
    ways = {folder / "_" for folder in _patient_folders(store, patients)}
    for row in store.rows(select(SESSION.c.path).where(SESSION.c.id.in_(sessions))):
        ways |= {root / row.path} if ".." not in Path(row.path).parts else set()
    on_way = {one for way in ways for one in (way, *way.parents) if one != root and one.is_relative_to(root)}
    return sorted(one for one in on_way if one.is_symlink())


def _patient_folders(store: Store, patients: Sequence[str]) -> list[Path]:
    """Return the patients' folders; ids that this program did not give could lead anywhere."""
    return [store.sessions_folder / one for one in patients if is_patient_id(one)]


def _resolve_inside(folder: Path, relative_path: str) -> Path | None:
    """Return the path below a folder, None if it leads out of it by name or link."""
    path = folder / relative_path
    parts = Path(relative_path).parts
    if not parts or Path(relative_path).is_absolute() or ".." in parts:
        return None
    return None if any(one.is_symlink() for one in [*path.parents][: len(parts) - 1]) else path


def _list_files(folder: Path) -> Iterator[Path]:
    if not folder.is_symlink():
        yield from (path for path in iter_paths(folder) if path.is_symlink() or path.is_file())
