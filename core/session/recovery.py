"""Finds sessions that were cut short, and has them finished (:func:`core.session.rewriting.finish_part`); which
of them are still being recorded, a heartbeat tells.

File locks do not work on many network shares, and clocks of two computers differ. So who wants to know watches whether
a file changes: ``NAME.part.alive`` says which computer and process write, and a number that rises.
"""

from __future__ import annotations

import contextlib
import json
import os
import socket
import threading
import time
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from carpus.core.errors import CarpusFault, RecordingMissing, SessionUnreadable
from carpus.core.phrase import phrase
from carpus.core.session import reader
from carpus.core.session.disk import below, is_being_written, target_of_part

SUFFIX = ".alive"
BEAT_S = 0.8
WATCH_S = 4.0
"""Longer than a beat, a slow share and a busy computer take together."""


class Heartbeat:
    """Beats beside a part file until :meth:`end`, in a thread of its own; ``watch`` is called with each beat and may
    return what is wrong, which :attr:`trouble` then holds."""

    def __init__(self, part: Path, watch: Callable[[], CarpusFault | None] = lambda: None) -> None:
        self.path = alive_path(part)
        self.trouble: CarpusFault | None = None
        self._watch = watch
        self._ending = threading.Event()
        self._count = 0
        self._beat()
        self._thread = threading.Thread(target=self._run, name="heartbeat", daemon=True)
        self._thread.start()

    def end(self) -> None:
        """Stop, and take the file away; may be called twice."""
        self._ending.set()
        self._thread.join()
        with contextlib.suppress(OSError):
            self.path.unlink(missing_ok=True)

    def _run(self) -> None:
        while not self._ending.wait(BEAT_S):
            self.trouble = self.trouble or self._watch()
            if self.trouble is None:
                self._beat()

    def _beat(self) -> None:
        self._count += 1
        content = json.dumps(
            {"host": _host(), "process": os.getpid(), "began": _began(os.getpid()), "beat": self._count}
        )
        with contextlib.suppress(OSError):  # the folder is full, read-only or gone: the recording itself tells
            descriptor = os.open(self.path, os.O_WRONLY | os.O_CREAT, 0o600)
            try:
                os.pwrite(descriptor, content.ljust(200).encode(), 0)
            finally:
                os.close(descriptor)


def alive_path(part: Path) -> Path:
    """Where the heartbeat of a part file is."""
    return part.with_name(part.name + SUFFIX)


def still_beating(parts: Sequence[Path], wait: Callable[[float], None] = time.sleep) -> set[Path]:
    """Those of some part files that somebody is recording; waits up to :data:`WATCH_S` where only watching tells."""
    first = {part: content for part in parts if (content := _content(part))}
    beating = {part for part, content in first.items() if _runs_here(content) is True}
    unsure = {part for part, content in first.items() if _runs_here(content) is None}
    waited_s = 0.0
    while unsure and waited_s < WATCH_S:
        wait(BEAT_S / 4)
        waited_s += BEAT_S / 4
        changed = {part for part in unsure if _content(part) not in (first[part], b"")}
        beating |= changed
        unsure -= changed
    return beating


def remove(part: Path) -> None:
    """Take away what a recorder that ended without warning left behind."""
    with contextlib.suppress(OSError):
        alive_path(part).unlink(missing_ok=True)


def take_away(part: Path) -> bool:
    """Take away what a process that died left of a session which can be made again; False for one that is being
    written."""
    with contextlib.suppress(FileNotFoundError):  # it became the session meanwhile, or only its heartbeat is left
        if part in still_beating([part]) or is_being_written(part):
            return False
    with contextlib.suppress(OSError):  # who writes the session next is told why it cannot be
        part.unlink(missing_ok=True)
    remove(part)
    return True


def _content(part: Path) -> bytes:
    try:
        with alive_path(part).open("rb") as file:
            return file.read(1000)
    except OSError:
        return b""


def _runs_here(content: bytes) -> bool | None:
    """Whether the process that wrote this runs on this computer; None where that cannot be known."""
    try:
        said = json.loads(content)
        host, process, began = said["host"], said["process"], said["began"]
    except (ValueError, KeyError, TypeError, RecursionError):
        return None
    if host != _host() or not isinstance(process, int) or not began:
        return None
    return bool(_began(process) == began)


def _host() -> str:
    """This computer since it was last started; a name alone is not enough, many are called the same."""
    with contextlib.suppress(OSError):
        return f"{socket.gethostname()} {Path('/proc/sys/kernel/random/boot_id').read_text().strip()}"
    return ""


def _began(process: int) -> str:
    """When a process of this computer began, in the system's own ticks; empty where none runs or nobody says."""
    with contextlib.suppress(OSError, IndexError):
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[19]
    return ""


@dataclass(frozen=True, slots=True)
class Recovery:
    """``recovered`` the files finished; ``busy`` part files still being written; ``faults`` one for each file left;
    ``empty`` part files in which nothing had been stored yet."""

    recovered: tuple[Path, ...]
    busy: tuple[Path, ...]
    faults: tuple[CarpusFault, ...]
    empty: tuple[Path, ...] = ()


def interrupted_sessions(folder: Path) -> list[Path]:
    """The part files of a folder and the folders in it, also of sessions that are running."""
    return sorted(path for path in below(folder, ".part") if target_of_part(path) is not None)


def recover_folder(folder: Path, now: datetime | None = None, given_up: Collection[Path] = ()) -> Recovery:
    """Finish every interrupted session of a folder and the folders in it; what cannot be finished stays as it is,
    and the part files ``given_up`` are not looked at.

    Raises :class:`RecordingMissing` when there is no such folder.
    """
    if not folder.is_dir():
        raise RecordingMissing(folder)
    when = (now or datetime.now().astimezone()).isoformat(timespec="seconds")
    recovered, busy, faults, empty = [], [], [], []
    parts = [part for part in interrupted_sessions(folder) if part not in given_up]
    beating = still_beating(parts)
    for part in parts:
        try:
            if part in beating or is_being_written(part):
                busy.append(part)
                continue
            target = reader.finish_part(part, when)
            remove(part)
            if target is None:
                empty.append(part)
            else:
                recovered.append(target)
        except CarpusFault as fault:
            faults.append(fault)
        except OSError as cause:
            faults.append(SessionUnreadable(part, cause.strerror or phrase("cannot be opened")))
    return Recovery(tuple(recovered), tuple(busy), tuple(faults), tuple(empty))
