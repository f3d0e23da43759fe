"""Finds sessions that were cut short, and has them finished (:func:`core.session.rewriting.finish_part`)."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from carpus.core.errors import CarpusFault, RecordingMissing, SessionUnreadable
from carpus.core.phrase import phrase
from carpus.core.session import heartbeat, reader
from carpus.core.session.disk import is_being_written, target_of_part


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
    return sorted(path for path in folder.rglob("*.part") if target_of_part(path) is not None)


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
    beating = heartbeat.still_beating(parts)
    for part in parts:
        try:
            if part in beating or is_being_written(part):
                busy.append(part)
                continue
            target = reader.finish_part(part, when)
            heartbeat.remove(part)
            if target is None:
                empty.append(part)
            else:
                recovered.append(target)
        except CarpusFault as fault:
            faults.append(fault)
        except OSError as cause:
            faults.append(SessionUnreadable(part, cause.strerror or phrase("cannot be opened")))
    return Recovery(tuple(recovered), tuple(busy), tuple(faults), tuple(empty))
