"""Files that appear whole or not at all: names until then, room on the disk, and the last step to the final name."""

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
"""A file in the making is written to every few seconds; where locks do not work, one that is older is nobody's."""
_PART = re.compile(r"(?P<target>.+)\.[0-9a-f]{8}\.part")


def temporary_path(target: Path) -> Path:
    """Where a file is written until it is whole: beside its target, under a hidden name of its own."""
    return target.with_name(f".{target.name}.{secrets.token_hex(4)}{TEMPORARY}")


def remove_leftovers(target: Path, min_age_s: float = STALE_AFTER_S) -> None:
    """Take away what killed programs left of a file in the making."""
    for left in target.parent.glob(f".{glob.escape(target.name)}.*{TEMPORARY}"):
        with contextlib.suppress(OSError):  # another program takes it away, or it is nobody's to take
            if time.time() - left.stat().st_mtime >= min_age_s and not is_being_written(left):
                left.unlink()


def find_part_target(part: Path) -> Path | None:
    """The name that a part file of Carpus 0.2.0 was to get; None for any other file."""
    match = _PART.fullmatch(part.name)
    return part.with_name(match["target"]) if match else None


def reserve_space(descriptor: int, path: Path, begin: int, length: int) -> None:
    """Make sure that ``length`` bytes after ``begin`` can be written, or raise :class:`DiskFull` before any is.

    HDF5 writes its index in many small steps; if the disk fills between two of them the file is lost.
    """
    try:
        if hasattr(os, "posix_fallocate"):
            os.posix_fallocate(descriptor, begin, length)
            return
    except OSError as cause:
        if cause.errno in DISK_FULL_ERRNOS:
            raise DiskFull(
                path, phrase("no room for another {length} MB", length=format_rounded(length / 1000000.0, 1))
            ) from cause
        # this file system cannot reserve: ask how much is free instead
    if shutil.disk_usage(path.parent).free < length:
        raise DiskFull(path, phrase("no room for another {length} MB", length=format_rounded(length / 1000000.0, 1)))


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


def publish(whole: Path, target: Path) -> None:
    """Give a finished file its final name; a file that has the name already is kept, and so is the other."""
    try:
        if sys.platform == "win32":
            whole.rename(target)  # refuses an existing target there
        else:
            _rename_to_free_name(whole, target)
    except FileExistsError as cause:
        raise OutputExists(target) from cause
    except OSError as cause:
        raise write_fault(target, cause) from cause
    sync_folder(target.parent)


def _rename_to_free_name(whole: Path, target: Path) -> None:
    try:
        os.link(whole, target)
    except FileExistsError:
        raise
    except OSError:  # no hard links here (FAT, some network shares); a name taken first would stay after a kill
        if os.path.lexists(target):
            raise FileExistsError(target) from None
        whole.rename(target)
    else:
        whole.unlink()


def repair_file_end(part: Path) -> None:
    """Set the end-of-file address to the file's true length.

    HDF5 writes that address last. A kill before it left good data behind an end that is too early, which HDF5
    then refuses to read; room was reserved in advance, so the true length always covers them.
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
    """The name itself, or with a number where a file has it."""
    candidate, number = target, 1
    while candidate.exists() or candidate.is_symlink():
        number += 1
        candidate = target.with_name(f"{target.stem}-{number}{target.suffix}")
    return candidate


def iter_paths(folder: Path, ending: str = "") -> Iterator[Path]:
    """All that lies below a folder under a name with that ending, links not followed. What another program takes away
    meanwhile, as it erases a patient, is passed over, where ``rglob`` fails. Raises OSError for what else keeps it from
    being seen."""

    def handle_error(fault: OSError) -> None:
        if not isinstance(fault, FileNotFoundError | PermissionError):
            raise fault

    for here, folders, files in os.walk(folder, onerror=handle_error):
        yield from (Path(here, name) for name in (*folders, *files) if name.endswith(ending))
