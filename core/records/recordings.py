"""Recordings on this computer: from the journal to the session file, and from there to the data folder."""

from __future__ import annotations

import filecmp
import hashlib
import logging
import os
import shutil
import time
from collections.abc import Callable, Collection
from contextlib import closing, suppress
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

import platformdirs

from carpus.core.capture.files.raw import SUFFIX as RAW_SUFFIX
from carpus.core.model import errors
from carpus.core.model.errors import CarpusFault
from carpus.core.model.phrase import phrase
from carpus.core.platform.durable import (
    STALE_AFTER_S,
    find_free_name,
    is_being_written,
    iter_paths,
    lock_file,
    make_private_folder,
    open_private,
    publish,
    remove_leftovers,
    sync_folder,
    temporary_path,
    write_fault,
)
from carpus.core.records.session_setup import MARKERS_SUFFIX
from carpus.core.results.repetition_rows import compute_repetitions
from carpus.core.session import reader
from carpus.core.session.journal import SUFFIX as JOURNAL_SUFFIX
from carpus.core.session.journal import JournalReader, unpack_arrays
from carpus.core.session.reader import read_outline
from carpus.core.session.rewriting import find_part_target
from carpus.core.session.writer import SessionWriter

log = logging.getLogger(__name__)

_SUFFIXES = (RAW_SUFFIX, MARKERS_SUFFIX, ".h5")
"""Files of a recording in the order of publishing: the session last, when its companions are there."""


def spool_folder(data_folder: Path) -> Path:
    """Return the local folder of a data folder's recordings, with a folder per patient; none is made."""
    name = hashlib.sha256(str(data_folder.absolute()).encode()).hexdigest()[:12]
    return Path(platformdirs.user_state_dir("carpus", appauthor=False)) / "recorded-elsewhere" / name


def write_session(journal: Path, recovered: str = "") -> Path | None:
    """Write the session of a journal beside it; return its path, None without a frame.

    ``recovered`` is the time at which an interrupted recording is completed (ISO 8601). The journal stays. Raises the
    faults of writing and :class:`SessionUnreadable`; then nothing is left behind.
    """
    draft = SessionDraft(journal)
    try:
        draft.read()
        return draft.finish(recovered)
    finally:
        draft.discard()


class SessionDraft:
    """Session file being written from a journal, also while that grows, so that the end is quick.

    All comes from the journal, so after a kill it starts again.
    """

    def __init__(self, journal: Path) -> None:
        self._journal = JournalReader(journal)
        self._target = journal.with_suffix(".h5")
        self._is_written = has_session(self._target, self._journal.session_id)
        """A program was killed after the session got its name and before the journal was deleted."""
        self._writer: SessionWriter | None = None

    def read(self) -> None:
        """Read what the journal has by now."""
        image = self._journal.empty_session
        if image is None or self._is_written:
            return
        for kind, content in self._journal.read():
            if kind not in (b"ROWS", b"SMOO"):
                continue
            try:
                blocks = unpack_arrays(content)
            except ValueError:  # of another Carpus; what is whole counts
                continue
            if self._writer is None:
                self._writer = SessionWriter(find_free_name(self._target), image)
            (self._writer.add_blocks if kind == b"ROWS" else self._writer.add_motion_blocks)(blocks)

    @property
    def frame_count(self) -> int:
        """Number of frames read so far."""
        return len(self._writer) if self._writer is not None else 0

    def flush(self) -> None:
        """Write all that was read; no more frames follow."""
        if self._writer is not None:
            self._writer.flush()

    def finish(self, recovered: str = "") -> Path | None:
        """Write the rest; return the file's path, None without a frame."""
        if self._is_written:
            return self._target
        self.read()
        writer = self._writer
        if writer is None or not len(writer):
            return None
        if writer.smoother_row_count != len(writer):  # half of a smoother's result is none
            writer.drop_motion()
        try:
            writer.write_repetitions(compute_repetitions(writer.read_session()))
        except (ArithmeticError, ValueError, IndexError):  # what is reckoned from the rows never costs the rows
            log.warning("the repetitions could not be counted", exc_info=True)
        writer.close(recovered)
        return writer.path

    def discard(self) -> None:
        """Close the journal and delete an unfinished file. May be called twice."""
        self._journal.close()
        if self._writer is not None:
            self._writer.abandon()


def has_session(path: Path, session_id: str) -> bool:
    """Return whether a file is the session with this id."""
    with suppress(errors.SessionUnreadable):
        return path.exists() and read_outline(path).header.session_id == session_id
    return False


@dataclass(frozen=True, slots=True)
class RecoveryResult:
    """Completed files, recordings still in progress, one fault per file left, and empty recordings."""

    recovered: tuple[Path, ...]
    in_progress: tuple[Path, ...]
    faults: tuple[CarpusFault, ...]
    empty: tuple[Path, ...] = ()


def recover_recordings(folder: Path, now: datetime | None = None, ignored: Collection[Path] = ()) -> RecoveryResult:
    """Complete interrupted recordings below a folder: journals, and part files of Carpus 0.2.0.

    Files that cannot be completed stay as they are. Raises :class:`RecordingMissing` without a folder.
    """
    if not folder.is_dir():
        raise errors.RecordingMissing(folder)
    when = (now or datetime.now().astimezone()).isoformat(timespec="seconds")
    recovered: list[Path] = []
    busy: list[Path] = []
    empty: list[Path] = []
    faults: list[CarpusFault] = []
    for path in sorted(iter_paths(folder)):
        is_part = find_part_target(path) is not None
        if path in ignored or not (is_part or path.suffix == JOURNAL_SUFFIX):
            continue
        try:
            target = _recover_part(path, when) if is_part else _recover_journal(path, when, faults)
            (busy if target is path else recovered if target else empty).append(target or path)
        except CarpusFault as fault:
            faults.append(fault)
        except OSError as cause:
            faults.append(errors.SessionUnreadable(path, cause.strerror or ""))
    return RecoveryResult(tuple(recovered), tuple(busy), tuple(faults), tuple(empty))


def _recover_journal(path: Path, when: str, faults: list[CarpusFault]) -> Path | None:
    """Return the completed session, the journal itself while it is recorded, None without a frame.

    A journal with damaged bytes holds more than was read: it is kept under another name.
    """
    with path.open("r+b") as own:
        try:
            lock_file(own)
        except OSError:  # another program writes it
            return path
        for name in (path.with_suffix(".h5"), find_free_name(path.with_suffix(".h5"))):
            remove_leftovers(name, min_age_s=0.0)
        target = write_session(path, when)
        with closing(JournalReader(path)) as journal:
            is_damaged = journal.is_damaged()
    if is_damaged and target is None:
        raise errors.SessionUnreadable(path, phrase("damaged"))
    if is_damaged:
        aside = path.rename(find_free_name(path.with_suffix(".damaged")))
        faults.append(errors.SessionUnreadable(aside, phrase("damaged")))
    path.unlink(missing_ok=True)
    sync_folder(path.parent)
    return target


def _recover_part(part: Path, when: str) -> Path | None:
    """Complete a part file, which an older Carpus, perhaps on another computer, may still write."""
    if is_being_written(part) or abs(time.time() - part.stat().st_mtime) < STALE_AFTER_S:
        return part
    target = reader.finish_part(part, when)
    part.with_name(f"{part.name}.alive").unlink(missing_ok=True)
    return target


def publish_session(path: Path, folder: Path) -> Path:
    """Move a finished session and its companions to a folder, perhaps on another disk; return its path.

    Raises :class:`OutputNotWritable` and :class:`DiskFull`; then it is still here.
    """
    target = copy_session(path, folder)
    remove_published(path)
    return target


def remove_published(path: Path) -> None:
    """Delete the local files of a published recording, the session last."""
    for suffix in _SUFFIXES:
        path.with_suffix(suffix).unlink(missing_ok=True)


def copy_session(path: Path, folder: Path) -> Path:
    """Copy a finished session and its companions to a folder; continues after a kill."""
    make_private_folder(folder)
    there = [suffix for suffix in _SUFFIXES if path.with_suffix(suffix).is_file()]
    target, number = folder / path.name, 1
    try:
        while any(_is_different_file(path.with_suffix(suffix), target.with_suffix(suffix)) for suffix in there):
            number += 1
            target = folder / f"{path.stem}-{number}{path.suffix}"
        for suffix in there:
            _place_file(path.with_suffix(suffix), target.with_suffix(suffix))
        sync_folder(folder)
    except OSError as cause:
        raise write_fault(target, cause) from cause
    return target


def _is_different_file(source: Path, target: Path) -> bool:
    return os.path.lexists(target) and not (target.is_file() and filecmp.cmp(source, target, shallow=False))


def _place_file(source: Path, target: Path) -> None:
    if os.path.lexists(target):
        return
    with suppress(OSError):  # another disk, or one without hard links
        os.link(source, target)
        return
    remove_leftovers(target, min_age_s=0.0)
    part = temporary_path(target)
    try:
        with source.open("rb") as file, open(part, "xb", opener=open_private) as copy:
            lock_file(copy)
            shutil.copyfileobj(file, copy, 1 << 20)
            copy.flush()
            os.fsync(copy.fileno())
        publish(part, target)
    finally:
        part.unlink(missing_ok=True)


def import_spooled(
    data_folder: Path, find_folder: Callable[[str, str], Path | None]
) -> tuple[list[Path], list[CarpusFault]]:
    """Complete interrupted local recordings and publish waiting ones to their patients' folders.

    ``find_folder`` takes a patient's id and pseudonym and returns None for an erased patient, whose recordings are
    deleted. Returns the new paths of the interrupted sessions, and faults to report.
    """
    place = spool_folder(data_folder)
    if not place.is_dir():
        return [], []
    found = recover_recordings(place)
    recovered: list[Path] = []
    faults: list[CarpusFault] = [errors.RecordingTooShort(path.name) for path in found.empty]
    erased = [one for one in sorted(place.iterdir()) if one.is_dir() and find_folder(one.name, "") is None]
    for folder in erased if not found.in_progress else ():
        try:
            shutil.rmtree(folder)  # also what cannot be read, and pictures without a session
            faults.append(errors.SpooledSessionErased())
        except OSError as cause:
            faults.append(errors.OutputNotWritable(place, cause.strerror or ""))
    faults += [fault for fault in found.faults if not any(Path(fault.subject).is_relative_to(one) for one in erased)]
    for path in sorted(one for one in place.rglob("*.h5") if not one.name.startswith(".")):
        try:
            home = find_folder(path.parent.name, read_outline(path).header.subject_id)
            if home is None:
                faults.append(errors.SpooledSessionErased())
                remove_published(path)
            else:
                arrived = publish_session(path, home)
                if path in found.recovered:
                    recovered.append(arrived)
                else:
                    faults.append(errors.SpooledSessionMoved(arrived))
            if path.parent != place:
                with suppress(OSError):  # another recording waits in it
                    path.parent.rmdir()
        except CarpusFault as fault:
            faults.append(fault)
        except OSError as cause:
            faults.append(errors.OutputNotWritable(data_folder, cause.strerror or ""))
    return recovered, faults
