"""A session, or a patient, deleted with everything: files, raw pictures, exports, rows, and the old lists kept aside.

What shall go is written into the register before the first file goes, so that an erasure that is cut short ends at the
next start. Carpus reaches its data folder and the files it made elsewhere; back-ups and copies it cannot reach. What is
deleted is overwritten in the register; what the disk itself keeps of deleted files only encryption protects.
"""

from __future__ import annotations

import contextlib
import glob
import re
import sqlite3
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from carpus.core.by_hand import kept as by_hand
from carpus.core.errors import ErasureUnfinished
from carpus.core.safekeeping.audit import AuditLog, Kind
from carpus.core.session import made_files, out_of_sight, seen_files
from carpus.core.session.database import complaint_kinds, connect
from carpus.core.session.made_files import MadeFile
from carpus.core.session.register import REGISTER_FILE, PatientRegister, SessionEntry

_TAILS = ("-wal", "-shm")


@dataclass(frozen=True, slots=True)
class ErasurePlan:
    """What would go. ``sessions`` counts recordings; ``files`` lie in the data folder; ``made`` are files that Carpus
    made elsewhere, each with what has become of it; ``others`` counts the patient's recordings that stay."""

    kind: Kind
    identity: str
    patient_id: str
    results: tuple[SessionEntry, ...]
    sessions: int
    files: tuple[Path, ...]
    size_bytes: int
    made: tuple[MadeFile, ...]
    others: int = 0

    @property
    def made_going(self) -> tuple[MadeFile, ...]:
        """Those that are as Carpus made them: they go too."""
        return tuple(one for one in self.made if one.state == "as_made")


@dataclass(frozen=True, slots=True)
class Erased:
    """What went: files of the data folder, and files made elsewhere."""

    files: int
    made: int


def plan_session(register: PatientRegister, session_id: str) -> ErasurePlan:
    """One recording with all its results. Raises KeyError for a session that is not in the register."""
    entry = register.session(session_id)
    results = register.results_of_recording(entry.recording_id)
    patient_id = register.owner(session_id)
    others = {one.recording_id for one in register.sessions(patient_id, archived=True)} - {entry.recording_id}
    return _plan(register, "session", session_id, patient_id, results, (), len(others))


def plan_patient(register: PatientRegister, patient_id: str) -> ErasurePlan:
    """A patient with all sessions. Raises KeyError for one that is not in the register."""
    pseudonym = register.patient(patient_id).entry.pseudonym
    results = register.sessions(patient_id, archived=True)
    folder = register.sessions_folder / re.sub(r"\W+", "-", pseudonym).strip("-")
    mine = {one.path for one in results}
    others = _others_files(register, mine)
    left_over = [one for one in _plain_files(folder) if one not in others] if folder != register.sessions_folder else []
    return _plan(register, "patient", patient_id, patient_id, results, left_over, 0)


def erase(register: PatientRegister, plan: ErasurePlan, log: AuditLog) -> Erased:
    """Do it. What cannot be deleted now is tried again whenever the register is opened.

    Raises :class:`ErasureUnfinished` where files are left, :class:`OutputNotWritable` where it could not be logged and
    so was not begun.
    """
    going = [*plan.files, *(one.path for one in plan.made_going)]
    log.note("erase_begun", plan.kind, plan.identity, files=len(plan.files), made=len(plan.made_going))
    recordings = {one.recording_id for one in plan.results}
    with register.database.transaction() as database:
        out_of_sight.begin_erasing(database, (_stored(path, register.sessions_folder) for path in going))
        _delete_rows(database, [one.session_id for one in plan.results], plan.patient_id if _whole(plan) else "")
        seen_files.forget(database, (_stored(path, register.sessions_folder) for path in plan.files))
        made_files.forget(database, (one.path for one in plan.made))
        out_of_sight.bring_back(database, {*recordings, *([plan.patient_id] if _whole(plan) else [])})
    with register.database.transaction() as database:
        gone, left = out_of_sight.go_on_erasing(database, register.sessions_folder)
    for folder in {path.parent for path in plan.files} - {register.sessions_folder}:
        with contextlib.suppress(OSError):  # another patient's session is in it
            folder.rmdir()
    _erase_from_old_lists(register.sessions_folder.parent, plan)
    register.database.leave_no_trace()
    if left:
        log.note("erase_begun", plan.kind, plan.identity, files=gone, left=len(left))
        raise ErasureUnfinished(f"{left[0].name}", f"{len(left)}")
    log.note("erased", plan.kind, plan.identity, files=len(plan.files), made=len(plan.made_going))
    return Erased(len(plan.files), len(plan.made_going))


def _whole(plan: ErasurePlan) -> bool:
    return plan.kind == "patient"


def _plan(
    register: PatientRegister,
    kind: Kind,
    identity: str,
    patient_id: str,
    results: Sequence[SessionEntry],
    more: Iterable[Path],
    others: int,
) -> ErasurePlan:
    files = {path for one in results for path in _beside(one.path)} | set(more)
    copies = {f"{seen_files.COPY}{_stored(one.path, register.sessions_folder)}" for one in results}
    files |= {path for path, reason in register.set_apart() if reason in copies and path.is_file()}
    with register.database.transaction() as database:
        made = made_files.made_from(database, (one.session_id for one in results))
    return ErasurePlan(
        kind,
        identity,
        patient_id,
        tuple(results),
        len({one.recording_id for one in results}),
        tuple(sorted(files)),
        sum(path.stat().st_size for path in files),
        tuple(one for one in made if one.path not in files),
        others,
    )


def _beside(path: Path) -> set[Path]:
    """A session's file and all that lies beside it under its name."""
    return {one for one in path.parent.glob(f"{glob.escape(path.stem)}.*") if one.is_file() or one.is_symlink()}


def _plain_files(folder: Path) -> list[Path]:
    return [path for path in folder.rglob("*") if path.is_file() or path.is_symlink()] if folder.is_dir() else []


def _others_files(register: PatientRegister, mine: set[Path]) -> set[Path]:
    """Files of sessions that are not to go: some may lie in the same folder, since sessions can be moved."""
    with register.database.transaction() as database:
        known = [register.sessions_folder / path for (path,) in database.execute("SELECT path FROM session")]
    return {beside for path in known if path not in mine for beside in _beside(path)}


def _stored(path: Path, folder: Path) -> str:
    return path.relative_to(folder).as_posix() if path.is_relative_to(folder) else str(path)


def _delete_rows(database: sqlite3.Connection, session_ids: Iterable[str], patient_id: str) -> None:
    database.executemany("DELETE FROM session WHERE id = ?", [(one,) for one in session_ids])
    if patient_id:
        database.execute("DELETE FROM session WHERE patient_id = ?", (patient_id,))
        by_hand.forget(database, patient_id)
        database.execute("DELETE FROM patient WHERE id = ?", (patient_id,))


def _erase_from_old_lists(folder: Path, plan: ErasurePlan) -> None:
    """Lists of before, kept when they were brought up to date or set aside: one that cannot be opened goes whole."""
    stem, suffix = REGISTER_FILE.split(".")
    for path in folder.glob(f"{stem}.*.{suffix}"):
        try:
            with contextlib.closing(connect(path)) as copy:
                copy.execute("PRAGMA secure_delete = ON")
                with copy:
                    _delete_rows(
                        copy, [one.session_id for one in plan.results], plan.patient_id if _whole(plan) else ""
                    )
                    names = {_stored(path, folder / "sessions") for path in plan.files}
                    if copy.execute("SELECT 1 FROM sqlite_master WHERE name = 'seen'").fetchone():
                        copy.executemany("DELETE FROM seen WHERE path = ?", [(name,) for name in names])
                copy.execute("VACUUM")
                copy.execute("PRAGMA wal_checkpoint(TRUNCATE)")
        except complaint_kinds():
            for old in (path, *(path.with_name(path.name + tail) for tail in _TAILS)):
                with contextlib.suppress(OSError):
                    old.unlink(missing_ok=True)
