"""A back-up of everything in a data folder, made while Carpus runs, read back and compared, and restored.

A folder for back-ups holds ``objects/``, every content once under its SHA-256, and ``backups/``, one JSON for each
back-up that says which file has which content. So fourteen back-ups take little more room than one, and any of them is
whole. The JSON is written last: a back-up that was cut short is none. Nothing is compressed or hidden: with the JSON
beside it every file can be found again without Carpus.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import uuid
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

from carpus.core.durable import sync_folder, write_fault
from carpus.core.encryption.content import UNDERWAY
from carpus.core.errors import (
    BackupPlaceUnsuited,
    BackupUnequal,
    BackupUnreadable,
    FolderMissing,
    OutputExists,
    OutputNotWritable,
)
from carpus.core.phrase import phrase
from carpus.core.private import private
from carpus.core.safekeeping.audit import AuditReading, holds_chain, read_audit
from carpus.core.session import heartbeat
from carpus.core.session.database import complaint_kinds, connect, make_private
from carpus.core.session.disk import is_being_written
from carpus.core.session.register import REGISTER_FILE

FORMAT, FORMAT_VERSION = "carpus-backup", 1
OBJECTS, BACKUPS = "objects", "backups"
LAST_FILE = "last_backup.json"
"""In the data folder: what the last back-up was, so that its age is known also while its disk is away."""
SETTINGS_PREFIX = "@settings/"
LEFT_OUT = (".alive", "-wal", "-shm", ".lock", ".new", *UNDERWAY)
BLOCK = 1 << 20

Progress = Callable[[int, int], None]


@dataclass(frozen=True, slots=True)
class Kept:
    """A file of a back-up: ``path`` in the data folder, with slashes."""

    path: str
    sha256: str
    size: int
    changed_ns: int


@dataclass(frozen=True, slots=True)
class Backup:
    """One back-up. ``sessions`` counts session files, ``audit_chain`` says how the log ended, ``running`` how many
    recordings ran and are not in it."""

    name: str
    made: datetime
    files: tuple[Kept, ...]
    sessions: int
    size_bytes: int
    audit_chain: str
    running: int
    software_version: str


@dataclass(frozen=True, slots=True)
class LastBackup:
    """The last back-up of a data folder, as it remembers it; ``missing`` counts sessions made since."""

    made: datetime
    place: str
    sessions: int
    size_bytes: int
    missing: int


@dataclass(frozen=True, slots=True)
class RestorePlan:
    """What a restore would change: session files that come, change and go, by their paths."""

    added: tuple[str, ...]
    replaced: tuple[str, ...]
    lost: tuple[str, ...]


def back_up(
    data_folder: Path,
    place: Path,
    *,
    software_version: str,
    settings_folder: Path | None = None,
    now: datetime | None = None,
    progress: Progress = lambda _done, _total: None,
) -> Backup:
    """Copy everything that is not in the place yet, read all of it back, and write down what is where.

    Raises :class:`BackupPlaceUnsuited`, :class:`BackupUnequal` where what is read back differs, :class:`DiskFull` and
    :class:`OutputNotWritable`; the back-ups that were there before are as they were.
    """
    if not data_folder.is_dir():
        raise FolderMissing(data_folder)
    _check_place(data_folder, place)
    for folder in (place, place / OBJECTS, place / BACKUPS):
        make_private(folder)
    before = backups(place)
    known = {one.path: one for one in before[0].files} if before else {}
    sources, running = _sources(data_folder, settings_folder)
    total = 2 * sum(size for _, _, size in sources) or 1
    done = 0
    files: list[Kept] = []
    for path, source, size in sources:
        with contextlib.suppress(FileNotFoundError):  # taken away meanwhile
            files.append(_kept(path, source, place, known.get(path)))
        done += size
        progress(done, total)
    for one in files:
        _compare(place, one)
        done += one.size
        progress(min(done, total), total)
    when = (now or datetime.now().astimezone()).replace(microsecond=0)
    made = Backup(
        _free_name(place, f"{when:%Y-%m-%dT%H%M%S}"),
        when,
        tuple(files),
        sum(one.path.endswith(".h5") for one in files),
        sum(one.size for one in files),
        read_audit(data_folder).chain,
        running,
        software_version,
    )
    _write(place / BACKUPS / f"{made.name}.json", _told(made))
    _write(data_folder / LAST_FILE, _told(made) | {"place": str(place)})
    return made


def backups(place: Path) -> list[Backup]:
    """The back-ups of a place that can be read, newest first."""
    found = []
    for path in sorted((place / BACKUPS).glob("*.json")):
        with contextlib.suppress(BackupUnreadable):
            found.append(read_backup(path))
    return sorted(found, key=lambda one: one.made, reverse=True)


def read_backup(path: Path) -> Backup:
    """One back-up by its JSON. Raises :class:`BackupUnreadable`, also for one of a newer Carpus."""
    try:
        told = json.loads(path.read_text(encoding="utf-8"))
        version = told["format_version"]
        if told["format"] != FORMAT:
            raise BackupUnreadable(path, phrase("not a back-up"))
        if version > FORMAT_VERSION:
            raise BackupUnreadable(
                path,
                phrase(
                    "version {version}, this Carpus reads up to {format_version}",
                    version=version,
                    format_version=FORMAT_VERSION,
                ),
            )
        files = tuple(Kept(str(p), str(h), int(size), int(ns)) for p, h, size, ns in told["files"])
        if not all(_is_inside(one.path) and len(one.sha256) == 64 and one.sha256.isalnum() for one in files):
            raise BackupUnreadable(path, phrase("paths that lead out of the folder"))
        return Backup(
            path.stem,
            datetime.fromisoformat(told["made"]),
            files,
            int(told["sessions"]),
            int(told["size_bytes"]),
            str(told["audit_chain"]),
            int(told["running"]),
            str(told["software_version"]),
        )
    except (OSError, ValueError, KeyError, TypeError, RecursionError) as cause:
        raise BackupUnreadable(path, str(cause)[:80]) from cause


def compare(place: Path, backup: Backup, progress: Progress = lambda _done, _total: None) -> None:
    """Read every content of a back-up. Raises :class:`BackupUnequal` at the first that is not what it was."""
    for number, one in enumerate(backup.files, 1):
        _compare(place, one)
        progress(number, len(backup.files))


def last_backup(data_folder: Path) -> LastBackup | None:
    """What the data folder remembers of its last back-up; None before the first."""
    try:
        path = data_folder / LAST_FILE
        made, place = read_backup(path), str(json.loads(path.read_text(encoding="utf-8"))["place"])
    except (BackupUnreadable, OSError, ValueError, KeyError):
        return None
    inside = {one.path for one in made.files}
    there = {path.relative_to(data_folder).as_posix() for path in data_folder.rglob("*.h5")}
    return LastBackup(made.made, place, made.sessions, made.size_bytes, len(there - inside))


def thin_out(place: Path, keep: int, months: int, now: datetime) -> int:
    """Keep the newest ``keep`` back-ups and the newest of each month for so many months; how many were taken away,
    with every content that no back-up needs."""
    there = backups(place)
    kept = {one.name for one in there[:keep]}
    for month in {(one.made.year, one.made.month) for one in there}:
        newest = max((one for one in there if (one.made.year, one.made.month) == month), key=lambda one: one.made)
        if newest.made > now - timedelta(days=31 * months):
            kept.add(newest.name)
    gone = [one for one in there if one.name not in kept]
    for one in gone:
        (place / BACKUPS / f"{one.name}.json").unlink(missing_ok=True)
    if gone and not _unreadable(place):
        needed = {one.sha256 for backup in backups(place) for one in backup.files}
        for path in (place / OBJECTS).glob("*/*"):
            if path.name not in needed:
                path.unlink(missing_ok=True)
    return len(gone)


def plan_restore(backup: Backup, data_folder: Path) -> RestorePlan:
    """What of the sessions that are there now would be different."""
    old = {one.path: one for one in backup.files if one.path.endswith(".h5")}
    now = {path.relative_to(data_folder).as_posix(): path for path in data_folder.rglob("*.h5")}
    changed = (path for path in old.keys() & now.keys() if _hash(now[path]) != old[path].sha256)
    return RestorePlan(
        tuple(sorted(old.keys() - now.keys())), tuple(sorted(changed)), tuple(sorted(now.keys() - old.keys()))
    )


def restore(
    place: Path,
    backup: Backup,
    target: Path,
    *,
    settings_folder: Path | None = None,
    progress: Progress = lambda _done, _total: None,
) -> None:
    """Write a back-up into a folder that is not there yet or is empty, as on a new computer; every content is checked
    on its way, and the folder gets its name last. Settings come only where there are none.

    Raises :class:`OutputExists` for a folder with something in it, :class:`BackupUnequal`, :class:`DiskFull`,
    :class:`OutputNotWritable`.
    """
    if target.exists() and (not target.is_dir() or any(target.iterdir())):
        raise OutputExists(target)
    part = target.with_name(f".{target.name}.restoring-{uuid.uuid4().hex[:8]}")
    make_private(part)
    done, total = 0, backup.size_bytes or 1
    for one in backup.files:
        if one.path.startswith(SETTINGS_PREFIX):
            into = settings_folder / one.path.removeprefix(SETTINGS_PREFIX) if settings_folder else None
            if into is None or into.exists():
                continue
        else:
            into = part / one.path
        for folder in reversed(into.relative_to(part).parents if into.is_relative_to(part) else ()):
            make_private(part / folder)
        make_private(into.parent)
        _fetch(place, one, into)
        done += one.size
        progress(done, total)
    try:
        if target.exists():
            target.rmdir()
        part.rename(target)
    except OSError as cause:
        raise OutputNotWritable(target, cause.strerror or "") from cause
    sync_folder(target.parent)


def put_in_place(restored: Path, data_folder: Path, now: datetime) -> Path:
    """Give a restored folder the name of the data folder, which no program may have open; where the old one is now."""
    aside = data_folder.with_name(f"{data_folder.name}.before-restore-{now:%Y%m%d-%H%M%S}")
    try:
        data_folder.rename(aside)
        try:
            restored.rename(data_folder)
        except OSError:
            aside.rename(data_folder)
            raise
    except OSError as cause:
        raise OutputNotWritable(data_folder, cause.strerror or "") from cause
    return aside


def _check_place(data_folder: Path, place: Path) -> None:
    data, there = data_folder.resolve(), place.resolve()
    if data == there or data in there.parents or there in data.parents:
        raise BackupPlaceUnsuited(place, phrase("in the data folder, or around it"))


def _sources(data_folder: Path, settings_folder: Path | None) -> tuple[list[tuple[str, Path, int]], int]:
    """Path in the back-up, file and size of everything; and how many recordings run, which are left out."""
    parts = [path for path in data_folder.rglob("*.part") if path.is_file()]
    beating = heartbeat.still_beating(parts)
    busy = {path for path in parts if path in beating or _is_written(path)}
    stems = {path.name.split(".")[0] for path in busy}
    found = []
    for path in sorted(data_folder.rglob("*")):
        is_file = path.is_file() and not path.is_symlink()
        of_running = path.name.split(".")[0] in stems
        if is_file and not path.name.endswith(LEFT_OUT) and path.name != LAST_FILE and not of_running:
            found.append((path.relative_to(data_folder).as_posix(), path, path.stat().st_size))
    for path in sorted(settings_folder.glob("*.toml")) if settings_folder else ():
        found.append((f"{SETTINGS_PREFIX}{path.name}", path, path.stat().st_size))
    return found, len(busy)


def _is_written(part: Path) -> bool:
    try:
        return is_being_written(part)
    except OSError:
        return True


def _kept(path: str, source: Path, place: Path, before: Kept | None) -> Kept:
    """The content of a file, copied unless it is there already."""
    state = source.stat()
    is_register = source.name == REGISTER_FILE
    same = before is not None and (before.size, before.changed_ns) == (state.st_size, state.st_mtime_ns)
    if before is not None and same and not is_register and _object(place, before.sha256).is_file():
        return before
    part = place / OBJECTS / f".{uuid.uuid4().hex}"
    try:
        with _of_register(source, part) if is_register else contextlib.nullcontext(source) as readable:
            digest, size = hashlib.sha256(), 0
            with readable.open("rb") as file, open(part, "wb", opener=private) as copy:
                while block := file.read(BLOCK):
                    digest.update(block)
                    copy.write(block)
                    size += len(block)
                copy.flush()
                os.fsync(copy.fileno())
        target = _object(place, digest.hexdigest())
        make_private(target.parent)
        part.replace(target)
        sync_folder(target.parent)
    except FileNotFoundError:
        part.unlink(missing_ok=True)
        raise
    except OSError as cause:
        part.unlink(missing_ok=True)
        raise write_fault(place, cause) from cause
    return Kept(path, digest.hexdigest(), size, state.st_mtime_ns)


@contextlib.contextmanager
def _of_register(source: Path, part: Path) -> Iterator[Path]:
    """The register as it is between two transactions, whoever has it open."""
    copy = part.with_name(f"{part.name}.sqlite3")
    try:
        os.close(os.open(copy, os.O_CREAT | os.O_EXCL | os.O_RDWR, 0o600))
        with contextlib.closing(connect(source)) as old, contextlib.closing(connect(copy, like=source)) as new:
            old.backup(new)
            new.execute("PRAGMA journal_mode = DELETE")
        yield copy
    except complaint_kinds() as cause:
        raise OutputNotWritable(source, str(cause)) from cause
    finally:
        for tail in ("", "-wal", "-shm", "-journal"):
            copy.with_name(copy.name + tail).unlink(missing_ok=True)


def _object(place: Path, sha256: str) -> Path:
    return place / OBJECTS / sha256[:2] / sha256


def _compare(place: Path, one: Kept) -> None:
    if _hash(_object(place, one.sha256), afresh=True) != one.sha256:
        raise BackupUnequal(one.sha256[:12], Path(one.path).suffix)


def _fetch(place: Path, one: Kept, into: Path) -> None:
    digest = hashlib.sha256()
    try:
        with _object(place, one.sha256).open("rb") as file, open(into, "xb", opener=private) as copy:
            while block := file.read(BLOCK):
                digest.update(block)
                copy.write(block)
            copy.flush()
            os.fsync(copy.fileno())
        os.utime(into, ns=(one.changed_ns, one.changed_ns))
    except FileNotFoundError as cause:
        raise BackupUnequal(one.sha256[:12], Path(one.path).suffix) from cause
    except OSError as cause:
        raise write_fault(into, cause) from cause
    if digest.hexdigest() != one.sha256:
        into.unlink(missing_ok=True)
        raise BackupUnequal(one.sha256[:12], Path(one.path).suffix)


def _hash(path: Path, *, afresh: bool = False) -> str:
    """SHA-256 of a file, ``afresh`` from the disk and not from memory where the system can; empty without one."""
    try:
        with path.open("rb") as file:
            if afresh and hasattr(os, "posix_fadvise"):
                os.posix_fadvise(file.fileno(), 0, 0, os.POSIX_FADV_DONTNEED)
            return hashlib.file_digest(file, "sha256").hexdigest()
    except OSError:
        return ""


def _is_inside(path: str) -> bool:
    parts = path.removeprefix(SETTINGS_PREFIX).split("/")
    return not Path(path).is_absolute() and not {"", ".", ".."} & set(parts) and "\\" not in path and "\0" not in path


def _unreadable(place: Path) -> bool:
    """Whether there is a back-up that cannot be read: then nobody knows which contents it needs."""
    return len(backups(place)) != len(list((place / BACKUPS).glob("*.json")))


def _free_name(place: Path, name: str) -> str:
    """Two back-ups of one second are two all the same."""
    candidate, number = name, 1
    while (place / BACKUPS / f"{candidate}.json").exists():
        number += 1
        candidate = f"{name}-{number}"
    return candidate


def _told(made: Backup) -> dict[str, Any]:
    return {
        "format": FORMAT,
        "format_version": FORMAT_VERSION,
        "made": made.made.isoformat(),
        "software_version": made.software_version,
        "sessions": made.sessions,
        "size_bytes": made.size_bytes,
        "audit_chain": made.audit_chain,
        "running": made.running,
        "files": [[one.path, one.sha256, one.size, one.changed_ns] for one in made.files],
    }


def _write(path: Path, content: dict[str, Any]) -> None:
    part = path.with_name(f".{path.name}.new")
    try:
        with open(part, "w", encoding="utf-8", opener=private) as file:
            json.dump(content, file, indent=1)
            file.flush()
            os.fsync(file.fileno())
        part.replace(path)
        sync_folder(path.parent)
    except OSError as cause:
        raise write_fault(path, cause) from cause


def log_was_cut(data_folder: Path, reading: AuditReading) -> bool:
    """Whether lines were taken off the end of the log that the last back-up knew."""
    try:
        chain = read_backup(data_folder / LAST_FILE).audit_chain
    except BackupUnreadable:
        return False
    return not holds_chain(reading, data_folder, chain)


def is_due(last: LastBackup | None, days: int, now: datetime) -> bool:
    """Whether a person should be reminded: no back-up for so many days although there is something to lose."""
    return last is None or now.astimezone(UTC) - last.made.astimezone(UTC) > timedelta(days=days)
