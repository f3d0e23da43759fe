"""Files that appear complete or not at all: temporary names, reserved space, publishing."""

from __future__ import annotations

import contextlib
import glob
import os
import re
import secrets
import shutil
import struct
import sys
import time
from collections.abc import Iterator
from pathlib import Path

from carpus.core.model.errors import DiskFull, OutputExists
from carpus.core.model.phrase import phrase
from carpus.core.model.rounding import format_rounded
from carpus.core.platform.durable import DISK_FULL_ERRNOS, sync_folder, write_fault

if sys.platform != "win32":
    import fcntl

_SUPERBLOCK = struct.Struct("<8sB4xB10xQ8xQ")
"""Start of an HDF5 file: signature, version, size of addresses, base address, end-of-file address."""
_END_OF_FILE_AT = _SUPERBLOCK.size - 8
TEMPORARY = ".tmp"
STALE_AFTER_S = 60.0
"""A file in progress is written every few seconds; without file locks an older one counts as left over."""
_PART = re.compile(r"(?P<target>.+)\.[0-9a-f]{8}\.part")


def temporary_path(target: Path) -> Path:
    """Return a hidden temporary name beside the target."""
    return target.with_name(f".{target.name}.{secrets.token_hex(4)}{TEMPORARY}")


def remove_leftovers(target: Path, min_age_s: float = STALE_AFTER_S) -> None:
    """Remove what killed programs left of a file in progress."""
    for left in target.parent.glob(f".{glob.escape(target.name)}.*{TEMPORARY}"):
        with contextlib.suppress(OSError):  # another program removes it, or it may not be removed
            if time.time() - left.stat().st_mtime >= min_age_s and not is_being_written(left):
                left.unlink()


def find_part_target(part: Path) -> Path | None:
    """Return the final name of a part file of Carpus 0.2.0; None for any other file."""
    match = _PART.fullmatch(part.name)
    return part.with_name(match["target"]) if match else None


def reserve_space(descriptor: int, path: Path, begin: int, length: int) -> None:
    """Reserve ``length`` bytes after ``begin``, or raise :class:`DiskFull`.

    HDF5 writes its index in many small steps; if the disk fills between two of them the file is lost.
    """
    try:
        if hasattr(os, "posix_fallocate"):
            os.posix_fallocate(descriptor, begin, length)
            return
    except OSError as cause:
        if cause.errno in DISK_FULL_ERRNOS:
            raise DiskFull(
                path, phrase("no space for another {length} MB", length=format_rounded(length / 1000000.0, 1))
            ) from cause
        # this file system cannot reserve: ask how much is free instead
    if shutil.disk_usage(path.parent).free < length:
        raise DiskFull(path, phrase("no space for another {length} MB", length=format_rounded(length / 1000000.0, 1)))


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


def repair_file_end(part: Path) -> None:
    """Set the end-of-file address to the file's true length.

    HDF5 writes that address last. After a kill before it, HDF5 refuses to read good data behind an end that is too
    early; space was reserved in advance, so the true length always covers them.
    """
    try:
        with part.open("r+b") as file:
            start = file.read(_SUPERBLOCK.size)
            length = file.seek(0, 2)
            if len(start) < _SUPERBLOCK.size:
                return
            *kind, end = _SUPERBLOCK.unpack(start)
            if kind == [b"\x89HDF\r\n\x1a\n", 0, 8, 0] and end < length:
                file.seek(_END_OF_FILE_AT)
                file.write(struct.pack("<Q", length))
    except OSError as cause:
        raise write_fault(part, cause) from cause


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
