"""A back-up of everything in a data folder, made while Carpus runs, read back and compared.

A folder for back-ups holds ``objects/``, every content once under its SHA-256, and ``backups/``, one JSON for each
back-up that says which file has which content. So fourteen back-ups take little more room than one, and any of them is
whole. The JSON is written last: a back-up that was cut short is none. Nothing is compressed or hidden: with the JSON
beside it every file can be found again without Carpus. The store is taken first, as of one moment, and every session
that it knows must be among the files, also those on a share. Linked folders and files are followed. One program at a
time works in such a folder.
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
from typing import Any

from carpus.core.durable import hold, make_private, private, replace_text, sync_folder, write_fault
from carpus.core.errors import (
    BackupIncomplete,
    BackupPlaceUnsuited,
    BackupUnequal,
    BackupUnreadable,
    OutputBusy,
    RegisterUnreadable,
)
from carpus.core.phrase import phrase
from carpus.core.records.database import STORE_FILE, copied
from carpus.core.records.reserve import RESERVE_FILE
from carpus.core.records.session_list import COPY_SUFFIX
from carpus.core.records.store import SESSIONS_FOLDER, look_for_store
from carpus.core.session.disk import TEMPORARY, free_name
from carpus.core.version import __version__

FORMAT, FORMAT_VERSION = "carpus-backup", 1
OBJECTS, BACKUPS = "objects", "backups"
SETTINGS_PREFIX, SESSIONS_PREFIX = "@settings/", f"{SESSIONS_FOLDER}/"
PLACE_LOCK = ".lock"
LEFT_OUT = (".alive", TEMPORARY, "-wal", "-shm", "-journal", ".lock", COPY_SUFFIX, RESERVE_FILE)
BLOCK = 1 << 20
_SHA256 = re.compile(r"[0-9a-f]{64}")
_MOST = 1 << 62

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
    """One back-up. ``sessions`` counts session files,
    ``lacking`` what should be in it and could not be read; ``data_folder`` whose it is, empty where that is not
    known."""

    name: str
    made: datetime
    files: tuple[Kept, ...]
    sessions: int
    size_bytes: int
    lacking: int
    software_version: str
    data_folder: str


@dataclass(frozen=True, slots=True)
class BackupSources:
    """What a back-up is made of: ``snapshot`` of the store, empty for none; path in the back-up, file and size of all
    else; names of what is missing or cannot be read."""

    snapshot: bytes
    files: tuple[tuple[str, Path, int], ...]
    lacking: tuple[str, ...]

    @property
    def size_bytes(self) -> int:
        return len(self.snapshot) + sum(size for _, _, size in self.files)


def back_up(
    data_folder: Path,
    place: Path,
    *,
    sessions: Path | None = None,
    settings_folder: Path | None = None,
    copy: Callable[[], sqlite3.Connection] | None = None,
    now: datetime | None = None,
    progress: Progress = lambda _done, _total: None,
) -> Backup:
    """Copy everything that is not in the place yet, read all of it back, and write down what is where. ``sessions`` is
    the folder of the sessions where that is a share.

    Raises :class:`OutputBusy` while another back-up into the place runs, :class:`BackupPlaceUnsuited`,
    :class:`BackupUnequal` where what is read back differs, :class:`DiskFull` and :class:`OutputNotWritable`; the
    back-ups that were there before are as they were. Raises :class:`BackupIncomplete` where a file cannot be read or a
    session that the store knows has none; all else is backed up then.
    """
    check_place(data_folder, place)
    sources = gather(data_folder, place, settings_folder, sessions, copy)
    for folder in (place, place / OBJECTS, place / BACKUPS):
        make_private(folder)
    with _alone(place):
        return _back_up(data_folder, sources, place, now or datetime.now().astimezone(), progress)


def _back_up(data_folder: Path, sources: BackupSources, place: Path, now: datetime, progress: Progress) -> Backup:
    before = backups(place)
    known = {one.path: one for one in before[0].files} if before else {}
    done, total = 0, 2 * sources.size_bytes or 1
    files, lacking, of = list[Kept](), list(sources.lacking), dict[str, Path]()
    if sources.snapshot:
        files.append(_stored(place, STORE_FILE, iter((sources.snapshot,)), 0))
    for path, source, size in sources.files:
        try:
            files.append(_kept(path, source, place, known.get(path)))
            of[path] = source
        except SourceGone:
            pass  # taken away meanwhile
        except SourceFails:
            lacking.append(path)
        done += size
        progress(done, total)
    for number, one in enumerate(files):
        try:
            _compare(place, one)
        except BackupUnequal:  # kept from an earlier back-up, and damaged since
            if one.path not in of:
                raise
            with contextlib.suppress(SourceFails):
                files[number] = _stored(place, one.path, _blocks(of[one.path]), one.changed_ns)
            _compare(place, files[number])
        done += one.size
        progress(min(done, total), total)
    when = now.replace(microsecond=0)
    name = free_name(place / BACKUPS / f"{when:%Y-%m-%dT%H%M%S}.json").stem  # two of one second are two all the same
    made = Backup(
        name, when, tuple(files), sum(one.path.endswith(".h5") for one in files), sum(one.size for one in files),
        len(lacking), __version__, str(data_folder.absolute()),
    )  # fmt: skip
    replace_text(place / BACKUPS / f"{made.name}.json", json.dumps(told(made), indent=1))
    if lacking:
        raise BackupIncomplete(lacking[0], str(len(lacking)))
    return made


def gather(
    data_folder: Path,
    place: Path,
    settings_folder: Path | None,
    sessions: Path | None = None,
    copy: Callable[[], sqlite3.Connection] | None = None,
) -> BackupSources:
    """Everything that a back-up of a data folder holds, the ``sessions`` of a share too. Raises :class:`FolderMissing`,
    :class:`NoDataFolder`, :class:`RegisterUnreadable` for a store that cannot be read, :class:`BackupPlaceUnsuited` for
    a place that a link leads into."""
    if copy is None and not (data_folder / SESSIONS_FOLDER).exists():
        look_for_store(data_folder)
    snapshot, wanted = _of_store(data_folder / STORE_FILE, copy)
    lacking: list[str] = []
    place = _led_to(place)
    there = dict(walk_files(data_folder, place, lacking))
    if sessions is not None and sessions != data_folder / SESSIONS_FOLDER:
        there |= walk_files(sessions, place, lacking, SESSIONS_PREFIX)
    files = [
        (name, path) for name, path in sorted(there.items()) if not (name.endswith(LEFT_OUT) or name == STORE_FILE)
    ]
    lacking += sorted(f"{SESSIONS_PREFIX}{one}" for one in wanted if f"{SESSIONS_PREFIX}{one}" not in there)
    for path in sorted(settings_folder.glob("*.toml")) if settings_folder else ():
        files.append((f"{SETTINGS_PREFIX}{path.name}", path))
    sized = []
    for name, path in files:
        with contextlib.suppress(FileNotFoundError):
            sized.append((name, path, path.stat().st_size))
    return BackupSources(snapshot, tuple(sized), tuple(lacking))


def backups(place: Path) -> list[Backup]:
    """The back-ups of a place that can be read, newest first."""
    return _readable(sorted((place / BACKUPS).glob("*.json")))


def _readable(paths: Iterable[Path]) -> list[Backup]:
    found = []
    for path in paths:
        with contextlib.suppress(BackupUnreadable):
            found.append(read_backup(path))
    return sorted(found, key=lambda one: one.made, reverse=True)


def read_backup(path: Path) -> Backup:
    """One back-up by its JSON. Raises :class:`BackupUnreadable`, also for one of a newer Carpus."""
    try:
        return parsed(path.stem, path.read_text(encoding="utf-8"))
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError, OverflowError) as cause:
        raise BackupUnreadable(path, str(cause)[:80]) from cause


def parsed(name: str, text: str) -> Backup:
    """A back-up as it was written down. Raises :class:`BackupUnreadable` for one of a newer Carpus or with paths that
    lead out of the folder, and whatever else a wrong JSON makes Python raise."""
    said = json.loads(text)
    if said["format"] != FORMAT:
        raise BackupUnreadable(name, phrase("not a back-up"))
    if _count(said["format_version"]) > FORMAT_VERSION:
        newer = "version {version}, this Carpus reads up to {format_version}"
        raise BackupUnreadable(name, phrase(newer, version=said["format_version"], format_version=FORMAT_VERSION))
    files = tuple(Kept(str(p), str(h), _count(size), _count(ns)) for p, h, size, ns in said["files"])
    if not all(_is_inside(one.path) and _SHA256.fullmatch(one.sha256) for one in files):
        raise BackupUnreadable(name, phrase("paths that lead out of the folder"))
    made = datetime.fromisoformat(said["made"])
    if made.tzinfo is None or not 2000 <= made.year < 9000 or len({one.path for one in files}) != len(files):
        raise ValueError("no such back-up was made")
    return Backup(
        name, made, files, _count(said["sessions"]), _count(said["size_bytes"]), _count(said["lacking"]),
        str(said["software_version"]),
        str(said.get("data_folder", "")),
    )  # fmt: skip


def compare(place: Path, backup: Backup, progress: Progress = lambda _done, _total: None) -> None:
    """Read every content of a back-up. Raises :class:`BackupUnequal` at the first that is not what it was."""
    for number, one in enumerate(backup.files, 1):
        _compare(place, one)
        progress(number, len(backup.files))


def thin_out(place: Path, keep: int, months: int, now: datetime) -> int:
    """Keep the newest ``keep`` back-ups and the newest of each month for so many months; how many were taken away. What
    a clock that ran ahead has dated after ``now`` stays too, and takes none of their places.
    Every content that no back-up needs goes, and what a killed one left; none where a back-up cannot be read or none
    is found, since nobody knows what is needed then. Nothing is touched that a link leads to, nor what is no content,
    nor anything while a back-up into the place runs. Raises :class:`BackupUnreadable` where the back-ups cannot be
    listed."""
    with contextlib.suppress(OutputBusy), _alone(place):
        return _thin_out(place, keep, months, now)
    return 0


def _thin_out(place: Path, keep: int, months: int, now: datetime) -> int:
    try:
        listed = [path for path in (place / BACKUPS).iterdir() if path.suffix == ".json"]
    except OSError as cause:
        raise BackupUnreadable(place / BACKUPS, cause.strerror or "") from cause
    there = _readable(listed)  # read once: a fault between two readings would cost what it hides
    sure = [one for one in there if one.made <= now]
    kept = {one.name for one in there if one not in sure} | {one.name for one in sure[:keep]}
    for month in {(one.made.year, one.made.month) for one in sure}:
        newest = max((one for one in sure if (one.made.year, one.made.month) == month), key=lambda one: one.made)
        if newest.made > now - timedelta(days=31 * months):
            kept.add(newest.name)
    gone = [one for one in there if one.name not in kept]
    for one in gone:
        (place / BACKUPS / f"{one.name}.json").unlink(missing_ok=True)
    for path in (place / BACKUPS).glob(".*.json.part"):
        path.unlink(missing_ok=True)
    if there and len(there) == len(listed):
        needed = {one.sha256 for backup in there if backup.name in kept for one in backup.files}
        for path in _objects(place):
            if path.name not in needed:
                path.unlink(missing_ok=True)
    return len(gone)


def is_due(made: datetime | None, days: int, now: datetime) -> bool:
    """Whether a person should be reminded: no back-up for so many days although there is something to lose."""
    return made is None or now.astimezone(UTC) - made.astimezone(UTC) > timedelta(days=days)


def told(made: Backup) -> dict[str, Any]:
    """A back-up as it is written down."""
    return {
        "format": FORMAT,
        "format_version": FORMAT_VERSION,
        "made": made.made.isoformat(),
        "software_version": made.software_version,
        "data_folder": made.data_folder,
        "sessions": made.sessions,
        "size_bytes": made.size_bytes,
        "running": 0,  # Carpus 0.2.0 asks for it
        "lacking": made.lacking,
        "files": [[one.path, one.sha256, one.size, one.changed_ns] for one in made.files],
    }


def check_place(data_folder: Path, place: Path) -> None:
    """Raise :class:`BackupPlaceUnsuited` for a place in the data folder, or around it."""
    data, there = data_folder.resolve(), _led_to(place)
    if data == there or data in there.parents or there in data.parents:
        raise BackupPlaceUnsuited(place, phrase("in the data folder, or around it"))


def _led_to(place: Path) -> Path:
    """Where links lead; one to itself, for which ``Path.resolve`` raises, leads to itself: no folder, which is told."""
    return Path(os.path.realpath(place))


def walk_files(folder: Path, place: Path | None, lacking: list[str], prefix: str = "") -> Iterator[tuple[str, Path]]:
    """Every file by its path with slashes, links followed, each folder once; what leads nowhere or cannot be read is
    added to ``lacking``."""
    seen: set[tuple[int, int]] = set()
    waiting = [(prefix, folder)]
    while waiting:
        name, here = waiting.pop()
        try:
            state = here.stat()
            entries = sorted(os.scandir(here), key=lambda one: one.name)
        except OSError:
            lacking.append(name.rstrip("/"))
            continue
        if place is not None and place.is_relative_to(here.resolve()):
            raise BackupPlaceUnsuited(place, phrase("in the data folder, or around it"))
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
                lacking.append(path)


def _of_store(path: Path, copy: Callable[[], sqlite3.Connection] | None) -> tuple[bytes, list[str]]:
    """The store as it is between two transactions, whoever has it open, and the paths of the sessions that it knows."""
    if copy is None and not path.exists():
        return b"", []
    with contextlib.closing(copied(path) if copy is None else copy()) as taken:
        try:
            wanted = [str(one) for (one,) in taken.execute("SELECT path FROM session WHERE erasing = 0")]
        except sqlite3.Error as cause:
            raise RegisterUnreadable(path, str(cause) if path.stat().st_size else phrase("empty file")) from cause
        return taken.serialize(), wanted


class SourceFails(Exception):
    """A file of the data folder that cannot be read."""


class SourceGone(SourceFails):
    """A file of the data folder that is there no more."""


@contextlib.contextmanager
def _alone(place: Path) -> Iterator[None]:
    """While no other program writes into a place. Raises :class:`OutputBusy` and the faults of writing."""
    try:
        lock = open(place / PLACE_LOCK, "ab", opener=private)  # noqa: SIM115  # closed below
    except OSError as cause:
        raise write_fault(place, cause) from cause
    with lock:
        try:
            hold(lock)
        except OSError as cause:
            raise OutputBusy(place) from cause
        yield


def _blocks(source: Path) -> Iterator[bytes]:
    try:
        with source.open("rb") as file:
            while block := file.read(BLOCK):
                yield block
    except FileNotFoundError as cause:
        raise SourceGone from cause
    except OSError as cause:
        raise SourceFails from cause


def _kept(path: str, source: Path, place: Path, before: Kept | None) -> Kept:
    """The content of a file, copied unless it is there already."""
    try:
        state = source.stat()
    except FileNotFoundError as cause:
        raise SourceGone from cause
    except OSError as cause:
        raise SourceFails from cause
    changed_ns = max(0, state.st_mtime_ns)
    same = before is not None and (before.size, before.changed_ns) == (state.st_size, changed_ns)
    if before is not None and same and find_object(place, before.sha256).is_file():
        return before
    return _stored(place, path, _blocks(source), changed_ns)


def _stored(place: Path, path: str, blocks: Iterator[bytes], changed_ns: int) -> Kept:
    part = place / OBJECTS / f".{uuid.uuid4().hex}"
    try:
        sha256, size = write_hashed(part, blocks)
        target = find_object(place, sha256)
        make_private(target.parent)
        part.replace(target)
        sync_folder(target.parent)
    except OSError as cause:
        raise write_fault(place, cause) from cause
    finally:
        part.unlink(missing_ok=True)
    return Kept(path, sha256, size, changed_ns)


def write_hashed(into: Path, blocks: Iterator[bytes]) -> tuple[str, int]:
    """A new private file on the disk; its SHA-256 and size."""
    digest, size = hashlib.sha256(), 0
    with open(into, "xb", opener=private) as copy:
        for block in blocks:
            digest.update(block)
            copy.write(block)
            size += len(block)
        copy.flush()
        os.fsync(copy.fileno())
    return digest.hexdigest(), size


def find_object(place: Path, sha256: str) -> Path:
    """Where a content lies in a place for backups."""
    return place / OBJECTS / sha256[:2] / sha256


def _objects(place: Path) -> Iterator[Path]:
    """Contents that lie in the place itself, and parts of a back-up that was killed."""
    root = place / OBJECTS
    for folder in () if root.is_symlink() else root.iterdir():
        if folder.is_dir() and not folder.is_symlink():
            yield from (one for one in folder.iterdir() if _SHA256.fullmatch(one.name) and not one.is_symlink())
        elif re.fullmatch(r"\.[0-9a-f]{32}", folder.name):
            yield folder


def _compare(place: Path, one: Kept) -> None:
    if hash_of(find_object(place, one.sha256), afresh=True) != one.sha256:
        raise BackupUnequal(one.sha256[:12], Path(one.path).suffix)


def hash_of(path: Path, *, afresh: bool = False) -> str:
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
    absolute = Path(path).is_absolute() or (os.name == "nt" and bool(PureWindowsPath(path).drive))
    return not absolute and not {"", ".", ".."} & set(parts) and "\\" not in path and "\0" not in path


def _count(value: object) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or not 0 <= value <= _MOST:
        raise ValueError("no count")
    return value
