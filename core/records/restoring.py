"""Restoring a backup: what would change, and a data folder that is complete before it takes its place.

A restore writes ``.NAME.restoring`` beside the data folder. Complete and verified it is ``.NAME.restored``, and takes
the name once no program has the folder open: at once or at the next start. The old folder is kept beside it. What was
erased since the backup stays erased, and the log continues.
"""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any

from sqlalchemy import Select, insert, select, update

from carpus.core.model.errors import BackupMismatch, OutputExists, PatientListUnreadable
from carpus.core.platform.durable import make_private_folder, sync_folder, write_fault
from carpus.core.records.backup import (
    BLOCK_BYTES,
    SESSIONS_PREFIX,
    SETTINGS_PREFIX,
    Backup,
    BackupFile,
    Progress,
    hash_file,
    list_backups,
    list_files,
    object_path,
    write_hashed,
)
from carpus.core.records.changes import ERASED_SUBJECTS, fingerprint
from carpus.core.records.database import STORE_FILE, copy_to_memory
from carpus.core.records.erasure import resume_erasures
from carpus.core.records.log import AuditLogWriter
from carpus.core.records.schema import AUDIT_LOG, PATIENT, SESSION
from carpus.core.records.store import Store


@dataclass(frozen=True, slots=True)
class LogHistory:
    """Log entries up to now, and fingerprints of what was erased."""

    entries: tuple[Mapping[str, Any], ...] = ()
    erased: frozenset[str] = frozenset()


@dataclass(frozen=True, slots=True)
class RestorePlan:
    """Paths of session files that a restore adds, replaces and removes.

    ``erased_count`` patients and single sessions of the backup were erased since and do not come back.
    """

    added: tuple[str, ...]
    replaced: tuple[str, ...]
    removed: tuple[str, ...]
    erased_count: int


def read_history(backup_folder: Path, store: Store | None) -> LogHistory:
    """Read the log of the present store and of the newest backup."""
    known = _fingerprints(store) if store is not None else set[str]()
    past = [_store_history(store)] if store is not None else []
    with (
        suppress(BackupMismatch, PatientListUnreadable),
        _open_backup_store(next(iter(list_backups(backup_folder)), None), backup_folder) as newest,
    ):
        past += [_store_history(newest)] if newest is not None else []
    deeds = {deed["id"]: deed for one in reversed(past) for deed in one.entries}
    return LogHistory(tuple(deeds.values()), frozenset().union(*(one.erased for one in past)) - known)


def _store_history(store: Store) -> LogHistory:
    deeds = tuple(dict(row._mapping) for row in store.rows(select(AUDIT_LOG)))
    return LogHistory(deeds, frozenset(store.scalars(ERASED_SUBJECTS)) - _fingerprints(store))


def plan_restore(backup: Backup, backup_folder: Path, data_folder: Path, history: LogHistory) -> RestorePlan:
    """Compare the sessions of a backup with those that are there."""
    with _open_backup_store(backup, backup_folder) as store:
        people, paths = _find_erased(store, history) if store else ([], {})
    going = (*(f"{SESSIONS_PREFIX}{one}/" for one in people), *(f"{SESSIONS_PREFIX}{one}" for one in paths.values()))
    wanted = (one for one in backup.files if one.path.endswith(".h5") and not one.path.startswith(going))
    old = {one.path: one for one in wanted}
    now = {name: path for name, path in list_files(data_folder, None, []) if name.endswith(".h5")}
    changed = (path for path in old.keys() & now.keys() if hash_file(now[path]) != old[path].sha256)
    return RestorePlan(
        tuple(sorted(old.keys() - now.keys())), tuple(sorted(changed)), tuple(sorted(now.keys() - old.keys())),
        len(people) + len(paths),
    )  # fmt: skip


def restore(
    backup: Backup,
    backup_folder: Path,
    target: Path,
    history: LogHistory,
    *,
    settings_folder: Path | None = None,
    progress: Progress = lambda _done, _total: None,
    overwrite: bool = False,
) -> int:
    """Write a verified backup beside ``target``; :func:`activate_restored` renames it.

    Returns how many patients and sessions, erased since, were left out. Settings are written only where there are none.
    Raises :class:`OutputExists` for a folder with content unless ``overwrite``, :class:`BackupMismatch`,
    :class:`DiskFull`, :class:`OutputNotWritable`; then nothing is left.
    """
    if not overwrite and target.exists() and (not target.is_dir() or any(target.iterdir())):
        raise OutputExists(target)
    folder, parts = _sibling(target, "restoring"), dict[Path, Path]()
    try:
        for left in (folder, _sibling(target, "restored")):
            shutil.rmtree(left, ignore_errors=True)
        make_private_folder(folder)
        done, total = 0, backup.size_bytes or 1
        for one in backup.files:
            if not one.path.startswith(SETTINGS_PREFIX):
                into = folder / one.path
            elif settings_folder is None or (own := settings_folder / one.path.removeprefix(SETTINGS_PREFIX)).exists():
                continue
            else:
                into = parts[own] = own.with_name(f".{own.name}.new")
                into.unlink(missing_ok=True)  # of a program that was killed
            _restore_file(backup_folder, one, into)
            done += one.size
            progress(done, total)
        gone = _apply_history(folder, history)
        for own, part in parts.items():
            part.replace(own)
        folder.rename(_sibling(target, "restored"))
    except BaseException as cause:
        shutil.rmtree(folder, ignore_errors=True)
        for part in parts.values():
            part.unlink(missing_ok=True)
        if isinstance(cause, OSError):
            raise write_fault(target, cause) from cause
        raise
    return gone


def has_restored_folder(target: Path) -> bool:
    """Return whether a complete restored folder waits for its name."""
    return _sibling(target, "restored").is_dir()


def delete_unfinished(target: Path) -> None:
    """Delete what a killed restore left."""
    shutil.rmtree(_sibling(target, "restoring"), ignore_errors=True)


def activate_restored(target: Path, now: datetime) -> Path | None:
    """Rename a restored folder to ``target``, which no program may have open.

    Returns where the old folder is now. Raises :class:`OutputNotWritable`.
    """
    aside = None
    try:
        if target.exists():
            if any(target.iterdir()):
                aside = target.with_name(f"{target.name}.before-restore-{now:%Y%m%d-%H%M%S}")
                target.rename(aside)
            else:
                target.rmdir()
        try:
            _sibling(target, "restored").rename(target)
        except OSError:
            if aside is not None:
                aside.rename(target)
            raise
    except OSError as cause:
        raise write_fault(target, cause) from cause
    sync_folder(target.parent)
    return aside


def _sibling(target: Path, label: str) -> Path:
    return target.with_name(f".{target.name}.{label}")


def _restore_file(backup_folder: Path, file: BackupFile, target: Path) -> None:
    wrong = BackupMismatch(file.sha256[:12], Path(file.path).suffix)
    for above in reversed([one for one in target.parents if not one.exists()]):
        make_private_folder(above)
    try:
        with object_path(backup_folder, file.sha256).open("rb") as stored:
            sha256, _ = write_hashed(target, iter(lambda: stored.read(BLOCK_BYTES), b""))
        with suppress(OverflowError):
            os.utime(target, ns=(file.modified_ns, file.modified_ns))
    except FileNotFoundError as cause:
        raise wrong from cause
    if sha256 != file.sha256:
        raise wrong


def _apply_history(folder: Path, history: LogHistory) -> int:
    """Erase again what was erased since the backup, and add the later log entries."""
    left = [one for one in (folder / SESSIONS_PREFIX).glob("*") if fingerprint(one.name) in history.erased]
    for one in left:
        shutil.rmtree(one)
    if not (folder / STORE_FILE).is_file():  # the rows are on the clinic's server
        return len(left)
    with Store(folder) as store:
        known = {row.id for row in store.rows(select(AUDIT_LOG.c.id))}
        names = {column.name for column in AUDIT_LOG.c}
        rows = [{k: v for k, v in one.items() if k in names} for one in history.entries if one["id"] not in known]
        people, sessions = _find_erased(store, history)
        store.execute_local(
            *(insert(AUDIT_LOG).values(**row) for row in rows),
            update(PATIENT).where(PATIENT.c.id.in_(people)).values(erasing=1),
            update(SESSION).where(SESSION.c.id.in_(sessions)).values(erasing=1),
        )
        resume_erasures(store, AuditLogWriter(store, "command"))
    return len(people) + len(sessions)


def _find_erased(store: Store, history: LogHistory) -> tuple[list[str], dict[str, str]]:
    """Return erased patients of a store, and erased sessions of the others with their paths."""
    people = [str(row.id) for row in store.rows(select(PATIENT.c.id)) if fingerprint(row.id) in history.erased]
    rows = store.rows(select(SESSION.c.id, SESSION.c.patient_id, SESSION.c.recording_id, SESSION.c.path))
    recordings = {row.recording_id for row in rows if fingerprint(row.id) in history.erased}
    gone = (row for row in rows if row.recording_id in recordings and row.patient_id not in people)
    return people, {str(row.id): str(row.path) for row in gone}


def _fingerprints(store: Store) -> set[str]:
    """Return fingerprints of all patients and sessions that are not being erased."""
    queries: list[Select[Any]] = [select(table.c.id).where(table.c.erasing == 0) for table in (PATIENT, SESSION)]
    return {fingerprint(row.id) for query in queries for row in store.rows(query)}


@contextmanager
def _open_backup_store(backup: Backup | None, backup_folder: Path) -> Iterator[Store | None]:
    """Open the store of a backup in memory. Raises :class:`BackupMismatch`, :class:`PatientListUnreadable`."""
    found = next((one for one in (backup.files if backup else ()) if one.path == STORE_FILE), None)
    if found is None:
        yield None
        return
    path = object_path(backup_folder, found.sha256)
    if hash_file(path) != found.sha256:
        raise BackupMismatch(found.sha256[:12], path.suffix)
    with Store(backup_folder, copy=copy_to_memory(path)) as store:
        yield store
