"""Files for their owner only, whatever the system's habit is."""

from __future__ import annotations

import os
from pathlib import Path


def private(name: str, flags: int) -> int:
    """An opener for :func:`open`: a file that it makes can be read and written by its owner alone."""
    return os.open(name, flags, 0o600)


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
