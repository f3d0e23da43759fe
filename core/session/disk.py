"""Files that appear whole or not at all: the part file, room on the disk, and the last step to the final name."""

from __future__ import annotations

import errno
import os
import re
import shutil
import sys
from pathlib import Path

from core.errors import CarpusFault, DiskFull, OutputExists, OutputNotWritable

if sys.platform != "win32":
    import fcntl

_FULL = {errno.ENOSPC, errno.EDQUOT, errno.EFBIG}
_PART = re.compile(r"(?P<target>.+)\.[0-9a-f]{8}\.part")


def part_path(target: Path, session_id: str) -> Path:
    """Where a session is written until it is whole: beside its target, under a name of its own."""
    return target.with_name(f"{target.name}.{session_id.replace('-', '')[:8]}.part")


def target_of_part(part: Path) -> Path | None:
    """The name that a part file was to get; None for any other file."""
    match = _PART.fullmatch(part.name)
    return part.with_name(match["target"]) if match else None


def reserve(descriptor: int, path: Path, begin: int, length: int) -> None:
    """Make sure that ``length`` bytes after ``begin`` can be written, or raise :class:`DiskFull` before any is.

    HDF5 writes its index in many small steps; if the disk fills between two of them the file is lost.
    """
    try:
        if hasattr(os, "posix_fallocate"):
            os.posix_fallocate(descriptor, begin, length)
            return
    except OSError as cause:
        if cause.errno in _FULL:
            raise DiskFull(path, f"no room for another {length / 1e6:.1f} MB") from cause
        # this file system cannot reserve: ask how much is free instead
    if shutil.disk_usage(path.parent).free < length:
        raise DiskFull(path, f"no room for another {length / 1e6:.1f} MB")


def is_being_written(path: Path) -> bool:
    """Whether this or another process has the HDF5 file open for writing."""
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


def write_fault(path: Path, cause: OSError | RuntimeError) -> CarpusFault:
    """The fault behind an exception of a write; h5py hides some error numbers in the text."""
    found = re.search(r"errno = (\d+)", str(cause))
    number = getattr(cause, "errno", None) or (int(found[1]) if found else None)
    if number in _FULL:
        return DiskFull(path, os.strerror(number))
    return OutputNotWritable(path, os.strerror(number) if number else "")


def publish(part: Path, target: Path) -> None:
    """Give a closed part file its final name; a file that has the name already is kept, and so is the part."""
    try:
        if sys.platform == "win32":
            part.rename(target)  # refuses an existing target there
        else:
            _rename_to_free_name(part, target)
    except FileExistsError as cause:
        raise OutputExists(target) from cause
    except OSError as cause:
        raise write_fault(target, cause) from cause
    sync_folder(target.parent)


def _rename_to_free_name(part: Path, target: Path) -> None:
    try:
        os.link(part, target)
    except FileExistsError:
        raise
    except OSError:  # no hard links here (FAT, some network shares): take the name first, then replace it
        os.close(os.open(target, os.O_CREAT | os.O_EXCL | os.O_WRONLY))
        part.replace(target)
    else:
        part.unlink()


def sync_folder(folder: Path) -> None:
    """Bring a new name to the disk, where the system can (Windows cannot open a folder)."""
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
