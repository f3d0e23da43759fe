"""Durable writing of files: synchronised, for their owner only, and complete under their name or not at all."""

from __future__ import annotations

import contextlib
import errno
import glob
import os
import re
import secrets
import shutil
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from types import TracebackType
from typing import IO, Self

from carpus.core.model.errors import CarpusFault, DiskFull, OutputExists, OutputNotWritable
from carpus.core.model.phrase import phrase
from carpus.core.model.rounding import format_rounded

if sys.platform == "win32":
    import msvcrt
else:
    import fcntl

DISK_FULL_ERRNOS = {errno.ENOSPC, errno.EDQUOT, errno.EFBIG}
TEMPORARY = ".tmp"
STALE_AFTER_S = 60.0
"""A file in progress is written every few seconds; without file locks an older one counts as left over."""


class FileWriter:
    """Writer of a file: closed at the end of its block, abandoned after a fault with what was written."""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, fault: BaseException | None, _: TracebackType | None) -> None:
        if kind is None:
            self.close()
        else:
            self.abandon()

    def close(self) -> None:
        raise NotImplementedError

    def abandon(self) -> None:
        raise NotImplementedError


def write_fault(path: Path, cause: OSError | RuntimeError) -> CarpusFault:
    """Return the fault for an exception of a write; h5py hides some error numbers in the text."""
    found = re.search(r"errno = (\d+)", str(cause))
    number = getattr(cause, "errno", None) or (int(found[1]) if found else None)
    if number in DISK_FULL_ERRNOS:
        return DiskFull(path, os.strerror(number))
    return OutputNotWritable(path, os.strerror(number) if number else "")


def is_disk_full(folder: Path) -> bool:
    """Return whether the disk of a folder is full."""
    try:
        with tempfile.TemporaryFile(dir=folder) as file:
            file.write(bytes(1 << 16))
            file.flush()
            os.fsync(file.fileno())
    except OSError as cause:
        return cause.errno in DISK_FULL_ERRNOS
    return False


def sync_folder(folder: Path) -> None:
    """Synchronise a folder with a new name, if the system can (Windows cannot open a folder)."""
    try:
        descriptor = os.open(folder, os.O_RDONLY)
    except OSError:
        return
    try:
        os.fsync(descriptor)
    except OSError:
        pass  # some network shares refuse; the file itself has been synchronised
    finally:
        os.close(descriptor)


def replace_file(path: Path, write: Callable[[Path], object]) -> None:
    """Write a file beside an old one, synchronise it and replace the old one, which no fault can damage.

    Raises what ``write`` raises, and :class:`DiskFull` or :class:`OutputNotWritable`; then nothing is left.
    """
    part = path.with_name(f".{path.name}.part")
    try:
        part.unlink(missing_ok=True)  # of a program that was killed
        try:
            write(part)
            part.chmod(0o600)
            with part.open("r+b") as written:
                os.fsync(written.fileno())
            part.replace(path)
        finally:
            part.unlink(missing_ok=True)
    except OSError as cause:
        raise write_fault(path, cause) from cause
    sync_folder(path.parent)


def replace_text(path: Path, text: str) -> None:
    """Replace a file by a text that is never readable by others, as :func:`replace_file` does."""

    def write(part: Path) -> None:
        with open(part, "x", encoding="utf-8", opener=open_private) as file:
            file.write(text)

    replace_file(path, write)


def open_private(name: str, flags: int) -> int:
    """Open a file so that only its owner can read and write it, whatever the umask (an opener for :func:`open`)."""
    descriptor = os.open(name, flags, 0o600)
    if flags & os.O_CREAT and hasattr(os, "fchmod"):
        with contextlib.suppress(OSError):  # a disk without rights, or another's file that may be written
            os.fchmod(descriptor, 0o600)
    return descriptor


def make_private_folder(folder: Path) -> None:
    """Create a folder that only its owner may enter; raises :class:`OutputNotWritable`."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        folder.chmod(0o700)
    except OSError as cause:
        raise write_fault(folder, cause) from cause


def make_private_file(path: Path) -> None:
    """Create an empty file for its owner only, unless it exists; raises :class:`OutputNotWritable`."""
    try:
        os.close(os.open(path, os.O_RDWR | os.O_CREAT, 0o600))
        path.chmod(0o600)
    except OSError as cause:
        raise write_fault(path, cause) from cause


def link_or_copy(path: Path, target: Path) -> None:
    """Link a file under another name, or make a private, synchronised copy; raises OSError."""
    try:
        os.link(path, target)
    except OSError:  # no hard links here, or another disk
        shutil.copyfile(path, target)
        target.chmod(0o600)
        with target.open("r+b") as copy:
            os.fsync(copy.fileno())


def lock_file(file: IO[bytes]) -> None:
    """Lock a file until it is closed or the program ends; raises OSError if another program holds it."""
    if sys.platform == "win32":
        file.seek(1 << 40)  # beyond what anybody reads
        msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)
        file.seek(0)
        return
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise
    except OSError:
        pass  # a disk without locks


@contextlib.contextmanager
def exclusive_lock(path: Path, busy: Callable[[str], CarpusFault], timeout_s: float = 0.0) -> Iterator[None]:
    """Hold a lock file, which stays; raises ``busy`` if another program holds it until a timeout, and write faults."""
    make_private_file(path)
    end_s = time.monotonic() + timeout_s
    with path.open("r+b") as file:
        while True:
            try:
                lock_file(file)
                break
            except OSError as cause:
                if time.monotonic() >= end_s:
                    raise busy(cause.strerror or "") from cause
                time.sleep(0.02)
        yield


def is_being_written(path: Path) -> bool:
    """Return whether any process has the HDF5 file open for writing."""
    if sys.platform == "win32":
        try:
            path.rename(path)  # an open file cannot be renamed there
        except PermissionError:
            return True
        return False
    with path.open("rb") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)  # HDF5 holds the exclusive lock while it writes
        except BlockingIOError:
            return True
        except OSError:  # a disk without locks
            return False
    return False


def temporary_path(target: Path) -> Path:
    """Return a hidden temporary name beside the target."""
    return target.with_name(f".{target.name}.{secrets.token_hex(4)}{TEMPORARY}")


def remove_leftovers(target: Path, min_age_s: float = STALE_AFTER_S) -> None:
    """Remove what killed programs left of a file in progress."""
    for left in target.parent.glob(f".{glob.escape(target.name)}.*{TEMPORARY}"):
        with contextlib.suppress(OSError):  # another program removes it, or it may not be removed
            if time.time() - left.stat().st_mtime >= min_age_s and not is_being_written(left):
                left.unlink()


def reserve_space(descriptor: int, path: Path, begin: int, length: int) -> None:
    """Reserve ``length`` bytes after ``begin``, or raise :class:`DiskFull`.

    HDF5 writes its index in many small steps; if the disk fills between two of them the file is lost.
    """
    try:
        os.posix_fallocate(descriptor, begin, length)
    except (AttributeError, OSError) as cause:  # Windows and some file systems cannot: ask how much is free
        if getattr(cause, "errno", 0) in DISK_FULL_ERRNOS or shutil.disk_usage(path.parent).free < length:
            text = phrase("no space for another {length} MB", length=format_rounded(length / 1e6, 1))
            raise DiskFull(path, text) from cause


def publish(whole: Path, target: Path) -> None:
    """Give a complete file its final name; if that is taken, both files are kept."""
    try:
        if sys.platform == "win32":
            whole.rename(target)  # refuses an existing target there
        else:
            try:
                os.link(whole, target)
            except FileExistsError:
                raise
            except OSError:  # no hard links (FAT, some network shares); a name taken first would stay after a kill
                if os.path.lexists(target):
                    raise FileExistsError(target) from None
                whole.rename(target)
            else:
                whole.unlink()
    except FileExistsError as cause:
        raise OutputExists(target) from cause
    except OSError as cause:
        raise write_fault(target, cause) from cause
    sync_folder(target.parent)


def find_free_name(target: Path) -> Path:
    """Return the name, with a number if it is taken."""
    candidate, number = target, 1
    while candidate.exists() or candidate.is_symlink():
        number += 1
        candidate = target.with_name(f"{target.stem}-{number}{target.suffix}")
    return candidate


def iter_paths(folder: Path, ending: str = "") -> Iterator[Path]:
    """Yield all paths below a folder whose names have an ending; links are not followed.

    Files that another program removes meanwhile are skipped, unlike in ``rglob``. Raises OSError for other failures.
    """

    def handle_error(fault: OSError) -> None:
        if not isinstance(fault, FileNotFoundError | PermissionError):
            raise fault

    for here, folders, files in os.walk(folder, onerror=handle_error):
        yield from (Path(here, name) for name in (*folders, *files) if name.endswith(ending))
