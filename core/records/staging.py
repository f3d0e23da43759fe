"""A folder that is being restored: beside its place under a name of its own until it is whole, and gone if it never is.

A file beside it is locked while its program lives. What a killed program left is removed when the same place is next
restored to or opened; a restore that was killed between the two names of its last step is finished then.
"""

from __future__ import annotations

import contextlib
import glob
import os
import shutil
import uuid
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import IO, Self

from carpus.core.durable import make_private, private, sync_folder, write_fault

MARK, LOCK, WHOLE = ".restoring-", ".lock", b"whole"


@dataclass(eq=False)
class Staged:
    """``folder`` is written, then takes the name ``target``."""

    folder: Path
    target: Path
    _lock: IO[bytes]

    @classmethod
    def begin(cls, target: Path) -> Self:
        """An empty folder beside a place. Raises :class:`DiskFull`, :class:`OutputNotWritable`."""
        folder = target.with_name(f".{target.name}{MARK}{uuid.uuid4().hex[:8]}")
        make_private(target.parent) if not target.parent.exists() else None
        lock: IO[bytes] | None = None
        try:
            lock = open(_lock_of(folder), "xb", opener=private)  # noqa: SIM115  # until it is in its place
            hold(lock)
            make_private(folder)
        except OSError as cause:
            raise write_fault(target, cause) from cause
        return cls(folder, target, lock)

    def complete(self) -> None:
        """All is in it and on the disk."""
        self._lock.write(WHOLE)
        self._lock.flush()
        os.fsync(self._lock.fileno())

    def put_in_place(self, now: datetime) -> Path | None:
        """Give it the name, which no program may have open; where a folder with something in it lies now that had it.

        Raises :class:`OutputNotWritable`.
        """
        aside = None
        try:
            if self.target.exists():
                if any(self.target.iterdir()):
                    aside = self.target.with_name(f"{self.target.name}.before-restore-{now:%Y%m%d-%H%M%S}")
                    self.target.rename(aside)
                else:
                    self.target.rmdir()
            try:
                self.folder.rename(self.target)
            except OSError:
                if aside is not None:
                    aside.rename(self.target)
                raise
        except OSError as cause:
            raise write_fault(self.target, cause) from cause
        sync_folder(self.target.parent)
        self._let_go()
        return aside

    def drop(self) -> None:
        shutil.rmtree(self.folder, ignore_errors=True)
        self._let_go()

    def _let_go(self) -> None:
        self._lock.close()
        _lock_of(self.folder).unlink(missing_ok=True)


def remove_left_behind(target: Path) -> None:
    """What killed programs left beside a place; of a whole one that only lacked the name it is given now."""
    for lock in sorted(target.parent.glob(f".{glob.escape(target.name)}{MARK}*{LOCK}")):
        folder = lock.with_name(lock.name.removesuffix(LOCK))
        is_whole = _is_whole(lock)
        if is_whole is None:
            continue
        if is_whole and folder.is_dir() and not target.exists():
            with contextlib.suppress(OSError):
                folder.rename(target)
        shutil.rmtree(folder, ignore_errors=True)
        with contextlib.suppress(OSError):
            lock.unlink(missing_ok=True)


def _is_whole(lock: Path) -> bool | None:
    """Whether its folder is whole; None where a program that lives holds it."""
    try:
        with lock.open("r+b") as file:
            hold(file)
            return file.read(len(WHOLE)) == WHOLE
    except OSError:
        return None


def hold(file: IO[bytes]) -> None:
    """Until it is closed, or the program dies. Raises OSError where another program holds it."""
    if os.name == "nt":
        import msvcrt

        file.seek(1 << 20)
        msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)  # type: ignore[attr-defined]
        file.seek(0)
    else:
        import fcntl

        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise
        except OSError:
            pass  # a disk without locks


def _lock_of(folder: Path) -> Path:
    return folder.with_name(f"{folder.name}{LOCK}")
