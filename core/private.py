"""Files for their owner only, whatever the system's habit is."""

from __future__ import annotations

import contextlib
import os
from pathlib import Path

from carpus.core.errors import OutputNotWritable


def private(name: str, flags: int) -> int:
    """An opener for :func:`open`: a file that it opens to write can be read and written by its owner alone, whatever
    the umask takes or gives."""
    descriptor = os.open(name, flags, 0o600)
    if flags & os.O_CREAT and hasattr(os, "fchmod"):
        with contextlib.suppress(OSError):  # a disk without rights, or another's file that may be written
            os.fchmod(descriptor, 0o600)
    return descriptor


def make_private(folder: Path) -> None:
    """Make a folder that only its owner may enter. Raises :class:`OutputNotWritable`."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        folder.chmod(0o700)
    except OSError as cause:
        raise OutputNotWritable(folder, cause.strerror or "") from cause


def make_private_file(path: Path) -> None:
    """An empty file for its owner only, unless it is there already. Raises :class:`OutputNotWritable`."""
    try:
        os.close(os.open(path, os.O_RDWR | os.O_CREAT, 0o600))
        path.chmod(0o600)
    except OSError as cause:
        raise OutputNotWritable(path, cause.strerror or "") from cause


def is_still_there(descriptor: int, path: Path) -> bool:
    """Whether a path is still the file that was opened: folders are removed, renamed and unplugged meanwhile."""
    try:
        here, there = os.fstat(descriptor), path.stat()
    except OSError:
        return False
    return os.name == "nt" or (here.st_dev, here.st_ino) == (there.st_dev, there.st_ino)


def copy_open_file(descriptor: int, path: Path) -> None:
    """Copy what is behind an open file, which may have no name any more, to a new private file, and bring it to the
    disk. Raises OSError."""
    size, done = os.fstat(descriptor).st_size, 0
    with open(path, "xb", opener=private) as copy:
        while done < size and (block := os.pread(descriptor, min(1 << 22, size - done), done)):
            copy.write(block)
            done += len(block)
        copy.flush()
        os.fsync(copy.fileno())
