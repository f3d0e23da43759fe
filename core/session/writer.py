"""Writes a session while it runs: flushed twice a second, given its name only when it is whole."""

from __future__ import annotations

import contextlib
import os
import time
import uuid
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Self

import numpy as np

from carpus.core.calibration.result import Calibration
from carpus.core.camera import Camera
from carpus.core.durable import Writing
from carpus.core.errors import (
    CarpusFault,
    EndStalled,
    FolderGone,
    OutputExists,
    OutputNotWritable,
    RecordingMoved,
    TimesUnordered,
)
from carpus.core.phrase import phrase
from carpus.core.session import schema
from carpus.core.session.disk import free_name, part_path, publish
from carpus.core.session.part_file import FileBeginning, HeldRows, PartFile
from carpus.core.session.values import Event, Motion, RawPictures, Repetitions, Session, SessionHeader
from carpus.core.types import TrackedFrame

FLUSH_EVERY_S = 0.5
"""A kill loses what came since the last flush; with the flush itself on a busy computer that stays below a second."""
ROWS_HELD = 1024
"""Rows held in memory at most, when frames come faster than the clock (tracking a stored recording)."""


@dataclass(frozen=True, slots=True)
class Fallback:
    """Where a recording goes on when its folder goes away: ``folder`` names (and makes) the place, ``told`` hears of it
    as :class:`RecordingMoved`, in the writing thread."""

    folder: Callable[[], Path]
    told: Callable[[CarpusFault], None]


class SessionWriter(Writing):
    """One session file in the making; used by one thread, from :meth:`create` to :meth:`close`.

    Rows are held in memory and written, flushed and synchronised together, so that between two flushes the file
    does not change. The file lies beside its target as
    ``NAME.xxxxxxxx.part`` and gets its name in :meth:`close`; nothing is ever overwritten. After a fault the part
    file stays, and :mod:`core.session.recovery` finishes it.

    Where the part file is gone, or cannot be written any more, the recording goes on in the ``fallback``'s folder, with
    all that was recorded where that can still be read.
    """

    def __init__(
        self, path: Path, beginning: FileBeginning, clock: Callable[[], float], fallback: Fallback | None
    ) -> None:
        if os.path.lexists(path):
            raise OutputExists(path)
        self.path = path
        self._beginning, self._clock, self._fallback = beginning, clock, fallback
        self._part = PartFile.begun(part_path(path, beginning.header.session_id), beginning)
        self._held = HeldRows()
        self._last_time_s = -np.inf
        self._flushed_at_s = clock()

    @classmethod
    def create(
        cls,
        path: Path,
        header: SessionHeader,
        camera: Camera,
        calibration: Calibration,
        *,
        raw_depth_unit_m: float | None = None,
        clock: Callable[[], float] = time.monotonic,
        fallback: Fallback | None = None,
    ) -> Self:
        """Begin a session that is to become ``path``. With ``raw_depth_unit_m`` every frame brings its pictures.

        Raises :class:`OutputExists`, :class:`OutputNotWritable` or :class:`DiskFull`; then nothing is left behind.
        """
        return cls(path, FileBeginning(header, camera, calibration, raw_depth_unit_m), clock, fallback)

    @property
    def part_path(self) -> Path:
        """Where the file is until it gets its name."""
        return self._part.path

    def __len__(self) -> int:
        """Frames taken so far; those since it began again, where what was recorded before could not be taken along."""
        return self.stored + len(self._held.frames)

    @property
    def stored(self) -> int:
        """Frames of those taken that are in the file."""
        return self._part.rows(schema.FRAME_FIELDS[0].path)

    @property
    def smoothed(self) -> int:
        """Frames of those taken whose smoothed motion was taken too."""
        return self._part.rows(schema.SMOOTHED_FIELDS[0].path) + self._held.smoothed_rows

    def append(self, tracked: TrackedFrame, raw: RawPictures | None = None) -> None:
        """Take one frame; writes when a flush is due. Never drops: it raises :class:`DiskFull` instead."""
        self._check_open()
        if tracked.timestamp_s <= self._last_time_s:
            raise TimesUnordered(
                self.path,
                phrase(
                    "{timestamp_s} s after {last_time_s} s",
                    timestamp_s=f"{tracked.timestamp_s:.6f}",
                    last_time_s=f"{self._last_time_s:.6f}",
                ),
            )
        if (raw is not None) != self._part.keeps_pictures:
            raise ValueError("pictures come with every frame or with none")
        self._last_time_s = tracked.timestamp_s
        self._held.frames.append(tracked)
        if raw is not None:
            self._held.pictures.append(raw)
        self._flush_when_due()

    def add_event(self, time_s: float, kind: str, text: str = "") -> None:
        """Note something that happened at a time of the recording."""
        self._check_open()
        self._held.add_event(time_s, kind, text)
        self._flush_when_due()

    def flush(self) -> None:
        """Bring everything taken so far to the disk, or to another where this one cannot be reached any more."""
        self._check_open()
        if self._part.trouble is not None:
            self._move(self._part.trouble)
        try:
            self._flush()
        except OutputNotWritable as fault:
            self._move(fault)
            self._flush()

    def _flush(self) -> None:
        held = self._held
        if held.smoothed:
            self._part.begin_smoothed()
        blocks = held.blocks(self._part.layout, self._part.rows)
        self._flushed_at_s = self._clock()
        if blocks:
            self._part.add(blocks)
            self._held = HeldRows()

    def add_smoothed(self, motion: Motion) -> None:
        """Take the smoother's result for the next frames, from the first appended on; written with the next flush."""
        self._check_open()
        if self.smoothed + len(motion.position_m) > len(self):
            raise ValueError("/smoothed got more rows than there are frames")
        self._held.smoothed.append(motion)

    def write_smoothed(self, motion: Motion) -> None:
        """Store the smoother's result, one row for every frame appended."""
        if len(motion.position_m) != len(self):
            raise ValueError(f"/smoothed got {len(motion.position_m)} rows for {len(self)} frames")
        self.add_smoothed(motion)
        self.flush()

    def drop_smoothed(self) -> None:
        """Leave the smoother's result out: it does not come to all frames."""
        self.flush()
        self._part.drop_smoothed()

    def read_back(self) -> Session:
        """What is in the file so far, as :func:`core.session.reader.read_session` gives it."""
        self.flush()
        return self._part.session()

    def write_repetitions(self, repetitions: Repetitions) -> None:
        """Store what was counted, once all frames are there."""
        self.flush()
        self._part.write_repetitions(repetitions)

    def close(self) -> None:
        """Finish: mark the file complete and give it its name. Does nothing when closed, or after a fault."""
        if not self._part.is_open:
            return
        if self._part.fault is not None:
            self.abandon()
            return
        try:
            self._part.look()
            self.flush()
            try:
                self._part.seal()
            except OutputNotWritable as fault:
                self._move(fault)
                self._part.seal()
        finally:
            self._part.close()
        publish(self._part.path, self.path)

    def abandon(self) -> None:
        """Stop without finishing; what was taken stays in the part file."""
        if self._part.is_open and self._part.fault is None:
            with contextlib.suppress(CarpusFault, ValueError):  # the exception on its way tells more
                self.flush()
        self._part.close()

    def discard(self) -> None:
        """Stop and remove the part file: for work that can be done again from its recording."""
        self._part.close()
        self._part.path.unlink(missing_ok=True)

    def _move(self, fault: CarpusFault) -> None:
        """Go on elsewhere, with all that was recorded if it can still be read, else with what was not yet written."""
        lost, stored = self._part, self.stored
        if self._fallback is None:
            lost.fault = lost.fault or fault
            raise fault
        path = free_name(self._fallback.folder() / self.path.name)
        copy = lost.copied(part_path(path, self._beginning.header.session_id))
        if copy is None:
            old, self._beginning = self._beginning, _begun_anew(self._beginning)
            self._part = PartFile.begun(part_path(path, self._beginning.header.session_id), self._beginning)
            self._held.smoothed = []
            if self._held.frames:
                self._held.events.insert(0, _goes_on(old, stored, self._held))
        else:
            self._part = copy
        self.path = path
        told, self._fallback = self._fallback.told, None  # one disaster at a time
        told(RecordingMoved(path, "" if copy is not None else _stays(stored, lost.path.parent)))

    def go_on_elsewhere(self) -> Self:
        """A new file in the fallback's folder with what this one has not stored, for another thread while the one that
        writes hangs in the disk. What was stored stays there and is finished once the disk answers.

        Raises :class:`FolderGone` where there is no other place, :class:`EndStalled` where all is stored.
        """
        folder, begun = self._part.path.parent, self._beginning
        if self._fallback is None:
            raise FolderGone(folder)
        fallback, self._fallback = self._fallback, None
        now = self._held  # once: the writer that hangs may come back and take another
        held = HeldRows(list(now.frames), list(now.pictures), list(now.events))
        stored = self.stored
        if stored and not held.frames:
            raise EndStalled(folder)
        path = free_name(fallback.folder() / self.path.name)
        writer = type(self)(path, _begun_anew(begun) if stored else begun, self._clock, None)
        if stored:
            held.events.insert(0, _goes_on(begun, stored, held))
        writer._held, writer._last_time_s = held, self._last_time_s
        fallback.told(RecordingMoved(path, _stays(stored, folder) if stored else ""))
        return writer

    def _flush_when_due(self) -> None:
        if self._part.trouble is not None:
            self.flush()
        if self._clock() - self._flushed_at_s >= FLUSH_EVERY_S or len(self._held.frames) >= ROWS_HELD:
            self.flush()

    def _check_open(self) -> None:
        if self._part.fault is not None:
            raise self._part.fault
        if not self._part.is_open:
            raise ValueError("the session is closed")


def _begun_anew(beginning: FileBeginning) -> FileBeginning:
    """With an identity of its own: two halves, not two results of one recording."""
    new_id = str(uuid.uuid4())
    return replace(beginning, header=replace(beginning.header, session_id=new_id, recording_id=new_id))


def _goes_on(beginning: FileBeginning, stored: int, held: HeldRows) -> Event:
    """Says in a file that has the rest where the beginning is."""
    text = f"goes on from session {beginning.header.session_id}, {stored} rows of which are elsewhere"
    return Event(held.frames[0].timestamp_s, "moved", text)


def _stays(stored: int, folder: Path) -> str:
    return phrase("the first {stored} rows stay in {lost_folder}", stored=stored, lost_folder=folder)
