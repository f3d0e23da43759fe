"""What is written stays: a new name brought to the disk, and the fault behind a write that failed."""

from __future__ import annotations

import errno
import os
import re
from collections.abc import Callable
from pathlib import Path

from carpus.core.errors import CarpusFault, DiskFull, OutputNotWritable

FULL = {errno.ENOSPC, errno.EDQUOT, errno.EFBIG}


def write_fault(path: Path, cause: OSError | RuntimeError) -> CarpusFault:
    """The fault behind an exception of a write; h5py hides some error numbers in the text."""
    found = re.search(r"errno = (\d+)", str(cause))
    number = getattr(cause, "errno", None) or (int(found[1]) if found else None)
    if number in FULL:
        return DiskFull(path, os.strerror(number))
    return OutputNotWritable(path, os.strerror(number) if number else "")


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


def replace_file(path: Path, write: Callable[[Path], object]) -> None:
    """Have a file written beside an old one and put it in its place, so that a fault never costs the old one.

    Raises what ``write`` raises, and :class:`DiskFull` or :class:`OutputNotWritable`.
    """
    part = path.with_name(f".{path.name}.part")
    try:
        part.unlink(missing_ok=True)  # of a program that was killed
        write(part)
        part.chmod(0o600)
        part.replace(path)
    except OSError as cause:
        raise write_fault(path, cause) from cause
