"""Backup of a data folder: copied while Carpus runs, then read back and compared.

A backup folder holds ``objects/``, each content once under its SHA-256, and ``backups/``, one JSON per backup that maps
files to contents. Fourteen backups take little more space than one, and each of them is complete. The JSON is written
last, so an interrupted backup does not count. Nothing is compressed: with the JSON every file can be found without
Carpus. The store is copied first, in one transaction, and every session that it lists must be among the files, also
those on a share. Symbolic links are followed. One program at a time works in a backup folder.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import re
import sqlite3
import uuid
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from pathlib import Path, PureWindowsPath
from typing import NamedTuple

from carpus.core.model import errors
from carpus.core.model.phrase import phrase
from carpus.core.platform.durable import (
    TEMPORARY,
    exclusive_lock,
    find_free_name,
    make_private_folder,
    open_private,
    replace_text,
    sync_folder,
    write_fault,
)
from carpus.core.platform.version import __version__
from carpus.core.records.database import STORE_FILE, copy_to_memory
from carpus.core.records.session_list import PENDING_COPY_SUFFIX
from carpus.core.records.store import SESSIONS_FOLDER

FORMAT, FORMAT_VERSION = "carpus-backup", 1
OBJECTS, BACKUPS = "objects", "backups"
SETTINGS_PREFIX, SESSIONS_PREFIX = "@settings/", f"{SESSIONS_FOLDER}/"
LOCK_FILE = ".lock"
EXCLUDED_SUFFIXES = (".alive", TEMPORARY, "-wal", "-shm", "-journal", ".lock", PENDING_COPY_SUFFIX, ".reserve")
BLOCK_BYTES = 1 << 20
_SHA256 = re.compile(r"[0-9a-f]{64}")
_MAX_COUNT = 1 << 62

Progress = Callable[[int, int], None]


@dataclass(frozen=True, slots=True)
class BackupFile:
    """File of a backup; ``path`` is relative to the data folder, with slashes."""

    path: str
    sha256: str
    size: int
    modified_ns: int


@dataclass(frozen=True, slots=True)
class Backup:
    """One backup.

    ``missing_count`` counts files that could not be read. ``data_folder`` is empty in backups of Carpus 0.2.0.
    """

    name: str
    made: datetime
    files: tuple[BackupFile, ...]
    missing_count: int
    software_version: str
    data_folder: str

    @property
    def session_count(self) -> int:
        return sum(one.path.endswith(".h5") for one in self.files)

    @property
    def size_bytes(self) -> int:
        return sum(one.size for one in self.files)


class BackupSources(NamedTuple):
    """Sources of a backup: ``snapshot`` of the store (may be empty) and ``files``.

    Each file has its path in the backup, its source and its size; ``missing`` names what cannot be read.
    """

    snapshot: bytes
    files: list[tuple[str, Path, int]]
    missing: list[str]


def create_backup(
    data_folder: Path,
    backup_folder: Path,
    *,
    sessions_folder: Path | None = None,
    settings_folder: Path | None = None,
    copy_store: Callable[[], sqlite3.Connection] | None = None,
    now: datetime | None = None,
    progress: Progress = lambda _done, _total: None,
) -> Backup:
    """Copy new contents into the backup folder, verify all of them and write the backup's JSON.

    ``sessions_folder`` is given where the sessions lie on a share, ``copy_store`` where the store is no file of the
    data folder; settings files come from ``settings_folder``. ``progress`` receives bytes done and in all.

    Raises
    ------
    OutputBusy
        While another program writes into the backup folder.
    BackupFolderUnsuited, BackupMismatch, DiskFull, OutputNotWritable
        Earlier backups stay as they were.
    BackupIncomplete
        A file cannot be read, or a listed session has no file; all else is in the backup.
    """
    data, there = data_folder.resolve(), Path(os.path.realpath(backup_folder))
    if data == there or data in there.parents or there in data.parents:
        raise errors.BackupFolderUnsuited(backup_folder, phrase("inside the data folder, or containing it"))
    sources = collect_sources(data_folder, backup_folder, settings_folder, sessions_folder, copy_store)
    for folder in (backup_folder, backup_folder / OBJECTS, backup_folder / BACKUPS):
        make_private_folder(folder)
    with _lock(backup_folder):
        return _write_backup(data_folder, sources, backup_folder, now or datetime.now().astimezone(), progress)


def _write_backup(
    data_folder: Path, sources: BackupSources, backup_folder: Path, now: datetime, progress: Progress
) -> Backup:
    snapshot, found, lacking = sources
    before = list_backups(backup_folder)
    known = {one.path: one for one in before[0].files} if before else {}
    done, total = 0, 2 * (len(snapshot) + sum(size for _, _, size in found)) or 1
    files, of = list[BackupFile](), dict[str, Path]()
    if snapshot:
        files.append(_store_object(backup_folder, STORE_FILE, iter((snapshot,)), 0))
    for path, source, size in found:
        try:
            files.append(_back_up_file(path, source, backup_folder, known.get(path)))
            of[path] = source
        except (BackupSourceError, OSError) as fault:
            if not isinstance(fault.__cause__ or fault, FileNotFoundError):  # else taken away meanwhile
                lacking.append(path)
        done += size
        progress(done, total)
    for number, one in enumerate(files):
        try:
            _verify_file(backup_folder, one)
        except errors.BackupMismatch:  # kept from an earlier back-up, and damaged since
            if one.path not in of:
                raise
            with contextlib.suppress(BackupSourceError):
                files[number] = _store_object(backup_folder, one.path, _read_blocks(of[one.path]), one.modified_ns)
            _verify_file(backup_folder, files[number])
        done += one.size
        progress(min(done, total), total)
    when = now.replace(microsecond=0)
    name = find_free_name(
        backup_folder / BACKUPS / f"{when:%Y-%m-%dT%H%M%S}.json"
    ).stem  # two of one second are two all the same
    made = Backup(name, when, tuple(files), len(lacking), __version__, str(data_folder.absolute()))
    content = {
        "format": FORMAT,
        "format_version": FORMAT_VERSION,
        "made": when.isoformat(),
        "software_version": made.software_version,
        "data_folder": made.data_folder,
        "sessions": made.session_count,
        "size_bytes": made.size_bytes,
        "running": 0,  # Carpus 0.2.0 asks for it
        "lacking": made.missing_count,
        "files": [[one.path, one.sha256, one.size, one.modified_ns] for one in files],
    }
    replace_text(backup_folder / BACKUPS / f"{name}.json", json.dumps(content, indent=1))
    if lacking:
        raise errors.BackupIncomplete(lacking[0], str(len(lacking)))
    return made


def collect_sources(
    data_folder: Path,
    backup_folder: Path,
    settings_folder: Path | None,
    sessions_folder: Path | None = None,
    copy_store: Callable[[], sqlite3.Connection] | None = None,
) -> BackupSources:
    """List everything that a backup contains.

    Raises :class:`FolderMissing`, :class:`DataFolderMissing`, :class:`PatientListUnreadable` and
    :class:`BackupFolderUnsuited`.
    """
    if copy_store is None and not any((data_folder / one).exists() for one in (SESSIONS_FOLDER, STORE_FILE)):
        raise errors.DataFolderMissing(data_folder) if data_folder.is_dir() else errors.FolderMissing(data_folder)
    snapshot, wanted = _read_store(data_folder / STORE_FILE, copy_store)
    lacking: list[str] = []
    backup_folder = Path(os.path.realpath(backup_folder))  # a link to itself raises nothing
    there = dict(list_files(data_folder, backup_folder, lacking))
    if sessions_folder is not None and sessions_folder != data_folder / SESSIONS_FOLDER:
        there |= list_files(sessions_folder, backup_folder, lacking, SESSIONS_PREFIX)
    files = [
        (name, path)
        for name, path in sorted(there.items())
        if not (name.endswith(EXCLUDED_SUFFIXES) or name == STORE_FILE)
    ]
    lacking += sorted(f"{SESSIONS_PREFIX}{one}" for one in wanted if f"{SESSIONS_PREFIX}{one}" not in there)
    for path in sorted(settings_folder.glob("*.toml")) if settings_folder else ():
        files.append((f"{SETTINGS_PREFIX}{path.name}", path))
    sized = []
    for name, path in files:
        with contextlib.suppress(FileNotFoundError):
            sized.append((name, path, path.stat().st_size))
    return BackupSources(snapshot, sized, lacking)


def list_backups(backup_folder: Path) -> list[Backup]:
    """Return the readable backups of a folder, newest first."""
    return _read_backups(sorted((backup_folder / BACKUPS).glob("*.json")))


def _read_backups(paths: Iterable[Path]) -> list[Backup]:
    found = []
    for path in paths:
        with contextlib.suppress(errors.BackupUnreadable):
            found.append(read_backup(path))
    return sorted(found, key=lambda one: one.made, reverse=True)


def read_backup(path: Path) -> Backup:
    """Read a backup's JSON. Raises :class:`BackupUnreadable`."""
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
        if content["format"] != FORMAT:
            raise errors.BackupUnreadable(path.stem, phrase("not a backup"))
        if _parse_count(content["format_version"]) > FORMAT_VERSION:
            newer = "version {version}, but this version of Carpus reads up to {format_version}"
            raise errors.BackupUnreadable(
                path.stem, phrase(newer, version=content["format_version"], format_version=FORMAT_VERSION)
            )
        files = tuple(
            BackupFile(str(p), str(h), _parse_count(size), _parse_count(ns)) for p, h, size, ns in content["files"]
        )
        if not all(_is_safe_path(one.path) and _SHA256.fullmatch(one.sha256) for one in files):
            raise errors.BackupUnreadable(path.stem, phrase("paths outside the folder"))
        made = datetime.fromisoformat(content["made"])
        if made.tzinfo is None or not 2000 <= made.year < 9000 or len({one.path for one in files}) != len(files):
            raise ValueError("no such back-up was made")
        return Backup(
            path.stem,
            made,
            files,
            _parse_count(content["lacking"]),
            str(content["software_version"]),
            str(content.get("data_folder", "")),
        )
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError, OverflowError) as cause:
        raise errors.BackupUnreadable(path, str(cause)[:80]) from cause


def verify_backup(backup_folder: Path, backup: Backup, progress: Progress = lambda _done, _total: None) -> None:
    """Read every content of a backup. Raises :class:`BackupMismatch` at the first that differs."""
    for number, one in enumerate(backup.files, 1):
        _verify_file(backup_folder, one)
        progress(number, len(backup.files))


def prune_backups(backup_folder: Path, keep: int, months: int, now: datetime) -> int:
    """Keep the newest backups and one of each month; return how many were deleted.

    Backups dated after ``now`` (a clock ran ahead) stay and do not count. Contents that no backup needs are deleted,
    unless a backup cannot be read: then nobody knows what is needed. Symbolic links are not touched, and nothing at all
    while another program writes a backup. Raises :class:`BackupUnreadable`.
    """
    with contextlib.suppress(errors.OutputBusy), _lock(backup_folder):
        try:
            listed = [path for path in (backup_folder / BACKUPS).iterdir() if path.suffix == ".json"]
        except OSError as cause:
            raise errors.BackupUnreadable(backup_folder / BACKUPS, cause.strerror or "") from cause
        there = _read_backups(listed)  # read once: a fault between two readings would cost what it hides
        sure = [one for one in there if one.made <= now]
        kept = {one.name for one in there if one not in sure} | {one.name for one in sure[:keep]}
        for month in {(one.made.year, one.made.month) for one in sure}:
            newest = max((one for one in sure if (one.made.year, one.made.month) == month), key=lambda one: one.made)
            if newest.made > now - timedelta(days=31 * months):
                kept.add(newest.name)
        gone = [one for one in there if one.name not in kept]
        for one in gone:
            (backup_folder / BACKUPS / f"{one.name}.json").unlink(missing_ok=True)
        for path in (backup_folder / BACKUPS).glob(".*.json.part"):
            path.unlink(missing_ok=True)
        if there and len(there) == len(listed):
            needed = {one.sha256 for backup in there if backup.name in kept for one in backup.files}
            for path in _find_objects(backup_folder):
                if path.name not in needed:
                    path.unlink(missing_ok=True)
        return len(gone)
    return 0


def is_backup_due(made: datetime | None, days: int, now: datetime) -> bool:
    """Return whether a reminder is due: no backup for so many days."""
    return made is None or now.astimezone(UTC) - made.astimezone(UTC) > timedelta(days=days)


def list_files(
    folder: Path, backup_folder: Path | None, missing: list[str], prefix: str = ""
) -> Iterator[tuple[str, Path]]:
    """Yield every file by its path with slashes; links are followed, each folder once.

    Unreadable folders and dangling links are added to ``missing``.
    """
    seen: set[tuple[int, int]] = set()
    waiting = [(prefix, folder)]
    while waiting:
        name, here = waiting.pop()
        try:
            state = here.stat()
            entries = sorted(os.scandir(here), key=lambda one: one.name)
        except OSError:
            missing.append(name.rstrip("/"))
            continue
        if backup_folder is not None and backup_folder.is_relative_to(here.resolve()):
            raise errors.BackupFolderUnsuited(backup_folder, phrase("inside the data folder, or containing it"))
        if (state.st_dev, state.st_ino) in seen:
            continue
        seen.add((state.st_dev, state.st_ino))
        for entry in entries:
            path = f"{name}{entry.name}"
            if entry.is_dir():
                waiting.append((f"{path}/", Path(entry.path)))
            elif entry.is_file():
                yield path, Path(entry.path)
            elif entry.is_symlink():
                missing.append(path)


def _read_store(path: Path, copy_store: Callable[[], sqlite3.Connection] | None) -> tuple[bytes, list[str]]:
    """Return a snapshot of the store and the paths of its sessions."""
    if copy_store is None and not path.exists():
        return b"", []
    with contextlib.closing(copy_to_memory(path) if copy_store is None else copy_store()) as taken:
        try:
            wanted = [str(one) for (one,) in taken.execute("SELECT path FROM session WHERE erasing = 0")]
        except sqlite3.Error as cause:
            raise errors.PatientListUnreadable(
                path, str(cause) if path.stat().st_size else phrase("empty file")
            ) from cause
        return taken.serialize(), wanted


class BackupSourceError(Exception):
    """File of the data folder that cannot be read; the cause says whether it no longer exists."""


def _lock(backup_folder: Path) -> contextlib.AbstractContextManager[None]:
    """Lock a backup folder. Raises :class:`OutputBusy` and the faults of writing."""
    return exclusive_lock(backup_folder / LOCK_FILE, lambda _: errors.OutputBusy(backup_folder))


def _read_blocks(source: Path) -> Iterator[bytes]:
    try:
        with source.open("rb") as file:
            while block := file.read(BLOCK_BYTES):
                yield block
    except OSError as cause:
        raise BackupSourceError from cause


def _back_up_file(path: str, source: Path, backup_folder: Path, previous: BackupFile | None) -> BackupFile:
    state = source.stat()
    changed_ns = max(0, state.st_mtime_ns)
    same = previous is not None and (previous.size, previous.modified_ns) == (state.st_size, changed_ns)
    if previous is not None and same and object_path(backup_folder, previous.sha256).is_file():
        return previous
    return _store_object(backup_folder, path, _read_blocks(source), changed_ns)


def _store_object(backup_folder: Path, path: str, blocks: Iterator[bytes], changed_ns: int) -> BackupFile:
    part = backup_folder / OBJECTS / f".{uuid.uuid4().hex}"
    try:
        sha256, size = write_hashed(part, blocks)
        target = object_path(backup_folder, sha256)
        make_private_folder(target.parent)
        part.replace(target)
        sync_folder(target.parent)
    except OSError as cause:
        raise write_fault(backup_folder, cause) from cause
    finally:
        part.unlink(missing_ok=True)
    return BackupFile(path, sha256, size, changed_ns)


def write_hashed(target: Path, blocks: Iterator[bytes]) -> tuple[str, int]:
    """Write a new private file; return its SHA-256 and size in bytes."""
    digest, size = hashlib.sha256(), 0
    with open(target, "xb", opener=open_private) as copy:
        for block in blocks:
            digest.update(block)
            copy.write(block)
            size += len(block)
        copy.flush()
        os.fsync(copy.fileno())
    return digest.hexdigest(), size


def object_path(backup_folder: Path, sha256: str) -> Path:
    """Return the path of a content in a backup folder."""
    return backup_folder / OBJECTS / sha256[:2] / sha256


def _find_objects(backup_folder: Path) -> Iterator[Path]:
    """Yield contents, and temporary files of a killed backup; no links."""
    root = backup_folder / OBJECTS
    for folder in () if root.is_symlink() else root.iterdir():
        if folder.is_dir() and not folder.is_symlink():
            yield from (one for one in folder.iterdir() if _SHA256.fullmatch(one.name) and not one.is_symlink())
        elif re.fullmatch(r"\.[0-9a-f]{32}", folder.name):
            yield folder


def _verify_file(backup_folder: Path, file: BackupFile) -> None:
    if hash_file(object_path(backup_folder, file.sha256)) != file.sha256:
        raise errors.BackupMismatch(file.sha256[:12], Path(file.path).suffix)


def hash_file(path: Path) -> str:
    """Return a file's SHA-256, empty if it cannot be read; from the disk, where the system can drop cached pages."""
    try:
        with path.open("rb") as file:
            if hasattr(os, "posix_fadvise"):
                os.posix_fadvise(file.fileno(), 0, 0, os.POSIX_FADV_DONTNEED)
            return hashlib.file_digest(file, "sha256").hexdigest()
    except OSError:
        return ""


def _is_safe_path(path: str) -> bool:
    parts = path.removeprefix(SETTINGS_PREFIX).split("/")
    absolute = Path(path).is_absolute() or (os.name == "nt" and bool(PureWindowsPath(path).drive))
    return not absolute and not {"", ".", ".."} & set(parts) and "\\" not in path and "\0" not in path


def _parse_count(value: object) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or not 0 <= value <= _MAX_COUNT:
        raise ValueError("no count")
    return value
