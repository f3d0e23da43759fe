"""Sessions tracked again with corrected markers: tried in a folder of their own, taken into the list when wanted."""

from __future__ import annotations

import shutil
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from datetime import datetime, timedelta
from pathlib import Path
from uuid import uuid4

import numpy as np

from carpus.core.durable import link_or_copy, make_private, replace_file, write_fault
from carpus.core.errors import CarpusFault, ChangedMeanwhile, OutputExists, SessionUnreadable
from carpus.core.hand.protocols import WRIST_ANGLES
from carpus.core.records.changes import changed
from carpus.core.records.library import Library, as_listed
from carpus.core.records.of_sessions import change_of
from carpus.core.records.schema import SESSION
from carpus.core.records.session_list import COPY_SUFFIX, TRIALS_FOLDER, look_for_share
from carpus.core.records.set_up import MARKERS_SUFFIX
from carpus.core.results.ranges import in_order
from carpus.core.results.repetition_rows import RepetitionChoices, repetitions_of
from carpus.core.results.seen import best_motion
from carpus.core.session.disk import free_name, publish
from carpus.core.session.reader import read_detections, read_outline, read_session, write_anew
from carpus.core.session.values import DetectionTable, RepetitionRow, Session, SessionHeader
from carpus.core.types import ByteImage, FloatArray

SESSION_SUFFIX = ".h5"


@dataclass(frozen=True, slots=True)
class Waiting:
    """A new result that nobody has decided about yet: of which session, and where it lies."""

    session_id: str
    trial: Path


@dataclass(frozen=True, slots=True)
class Difference:
    """How a new result differs: of ``common`` pictures that both know, ``changed`` differ by more than
    :data:`NOTICED_RAD` in some angle of the wrist or a finger; the most is ``most_rad`` at ``at_s``; ``found`` have an
    angle now that had none. ``most_at`` names that angle. ``lost`` are markers that are hardly seen any more.
    ``live``: as measured, since one of the two was not looked back at."""

    common: int
    changed: int
    most_rad: float
    at_s: float
    found: int
    most_at: str
    lost: tuple[str, ...]
    live: bool


NOTICED_RAD = np.radians(2.0)
LEAST_SEEN = 0.2
"""A marker that was seen in fewer of the pictures has nothing to lose."""


class Corrections:
    """Where a new result lies until a person wants it."""

    def __init__(self, library: Library) -> None:
        self._library = library
        self._table: tuple[Path, DetectionTable] | None = None

    @property
    def are_there(self) -> bool:
        return any(self._folder.glob("*"))

    def clear_unfinished(self) -> None:
        """Before anything is tracked again: what is left of a result that was not finished goes."""
        for path in self._folder.glob("*"):
            if path.suffix != SESSION_SUFFIX:
                with suppress(OSError):
                    path.unlink()

    def waiting(self) -> Sequence[Waiting]:
        """The new results that wait for a decision, the oldest first. One of a session that is no more is deleted."""
        found: list[tuple[str, Waiting]] = []
        for path in sorted(self._folder.glob(f"*{SESSION_SUFFIX}")):
            with suppress(CarpusFault, OSError):  # cannot be read, a full share, or one that is away: it stays
                header = read_outline(path).header
                if self._library.is_listed(
                    header.session_id
                ):  # decided: a program was killed before the file had its name
                    self.use(header.origin, path)
                    continue
                self._clear_copies(header)
                if self._is_known(header.origin):
                    found.append((header.created, Waiting(header.origin, path)))
                else:
                    path.unlink()
        return [one for _, one in sorted(found, key=lambda one: (one[0], one[1].trial))]

    def _is_known(self, session_id: str) -> bool:
        """Raises :class:`FolderMissing` while a session that is in no list may come yet."""
        library = self._library
        if session_id in library.elsewhere or self._library.is_listed(session_id):
            return True
        look_for_share(library.store)
        return False

    @property
    def _folder(self) -> Path:
        return self._library.folder / TRIALS_FOLDER

    def trial_path(self, session_id: str) -> Path:
        make_private(self._folder)
        return free_name(self._folder / self._library.entry(session_id).path.name)

    def moment(self, session_id: str, row: int) -> tuple[ByteImage | None, FloatArray]:
        """The picture of a row, None where none were kept, and the middles (S, 2) of its blue spots."""
        path = self._library.entry(session_id).path
        if self._table is None or self._table[0] != path:
            self._table = (path, read_detections(path))
        return self._library.picture(session_id, row), self._table[1].of_frame(row).pixel

    def both(self, session_id: str, trial: Path) -> tuple[Session, Session]:
        """The session and its new result, to be looked at beside each other."""
        return read_session(self._library.entry(session_id).path), read_session(trial)

    def use(self, session_id: str, trial: Path, *, is_copy: bool = False) -> str:
        """Take a new result into the patient's list, where it counts from now on; its identity. The old one stays.

        It lies beside the old one before it is listed, in one step with what was left out of that one, and then the
        file gets its name: a fault or a kill leaves all as it was, or what :meth:`waiting` goes on with.
        """
        library, header = self._library, read_outline(trial).header
        look_for_share(library.store)
        is_listed = self._library.is_listed(header.session_id)
        entry = library.entry(header.session_id if is_listed else session_id)
        place = entry.path if is_listed else free_name(entry.path)
        copy = _copy_beside(entry.path, header)
        try:
            if not _holds(place, header.session_id):  # a program was killed before it could delete what it had copied
                copy.unlink(missing_ok=True)
                link_or_copy(trial, copy)  # the sessions may lie on a share, which is another disk
                if not is_listed:
                    choices = library.choices(session_id) if is_copy else self._that_hold(session_id, trial)
                    also = [change_of(header.session_id, choices)] if choices is not None else []
                    library.index.enter(place, library.owner(session_id), entry.by, trial, entry.exercise, also)
                    if choices is not None:
                        library.notes.session("set_aside" if choices.not_counted else "changed", header.session_id)
                try:
                    publish(copy, place)
                except OutputExists:  # since it was looked for
                    if not _holds(place, header.session_id):  # else a look for what waits has taken this one meanwhile
                        place = free_name(place)
                        library.store.do([changed(SESSION, header.session_id, path=library.index.stored_path(place))])
                        publish(copy, place)
            self._copy_markers(place, header.session_id)
            self._clear_copies(header)
            trial.unlink(missing_ok=True)
        except OSError as cause:
            raise write_fault(trial, cause) from cause
        finally:
            with suppress(OSError):
                copy.unlink(missing_ok=True)
        return header.session_id

    def _copy_markers(self, place: Path, session_id: str) -> None:
        """The picture of the markers is that of the recording."""
        own = place.with_suffix(MARKERS_SUFFIX)
        there = [one.path.with_suffix(MARKERS_SUFFIX) for one in self._library.results_of(session_id)]
        beside = next((one for one in there if one.is_file()), None)
        if beside is not None and not own.exists():
            replace_file(own, lambda part: shutil.copyfile(beside, part))

    def _clear_copies(self, header: SessionHeader) -> None:
        """What a program that was killed had copied of a result goes."""
        for one in self._library.index.of_recording(header.recording_id):
            with suppress(OSError):
                _copy_beside(one.path, header).unlink(missing_ok=True)

    def _that_hold(self, session_id: str, trial: Path) -> RepetitionChoices | None:
        """What was said of the old result and is as true of the new one; None for nothing."""
        library = self._library
        choices = library.choices(session_id)
        moved = dict[int, str]()
        if choices.left_out:  # pain, help: as true of the same moments, and nothing counts again unasked
            with suppress(SessionUnreadable):
                new = in_order(as_listed(read_session(trial), library.entry(session_id)), library.angle_order())
                moved = _found_again(choices.left_out, library.session(session_id), new)
        # Edges are those of repetitions that are found anew.
        return replace(choices, left_out=moved, edges_s={}) if choices.not_counted or moved else None

    def use_again(self, session_id: str) -> str:
        """Let an older result count again: written once more, with all its choices, it is the newest one, whatever the
        clocks of other computers say; its identity. It was not tracked again, so its origin is that of the older one.
        Raises what reading and writing raise; then nothing is left."""
        trial, newest = self.trial_path(session_id), self._library.results_of(session_id)[-1].created
        made = max(datetime.now().astimezone(), newest + timedelta(seconds=1.0)).isoformat()
        write_anew(self._library.entry(session_id).path, trial, session_id=str(uuid4()), created=made)
        try:
            return self.use(session_id, trial, is_copy=True)
        except CarpusFault:
            with suppress(CarpusFault, OSError):
                self.drop(trial)
            raise

    def drop(self, trial: Path) -> None:
        """Delete a new result that is not wanted. Raises :class:`ChangedMeanwhile` for one that is listed: it counts,
        and :meth:`waiting` goes on with it; and :class:`SessionUnreadable`."""
        if trial.exists():
            if self._library.is_listed(read_outline(trial).header.session_id):
                raise ChangedMeanwhile(SESSION.name)
            trial.unlink()


def _copy_beside(path: Path, header: SessionHeader) -> Path:
    """Where a new result lies beside the session at ``path`` until it is listed: no back-up takes it, and it is erased
    with that session."""
    return path.with_name(f".{path.stem}.{header.session_id[:8]}{COPY_SUFFIX}")


def _holds(path: Path, session_id: str) -> bool:
    with suppress(SessionUnreadable):
        return path.exists() and read_outline(path).header.session_id == session_id
    return False


def _found_again(said: Mapping[int, str], old: Session, new: Session) -> dict[int, str]:
    """What was said of repetitions, by the numbers of those of a new result that are mostly the same moments."""
    before = repetitions_of(old).rows
    return {
        number: why
        for number, row in enumerate(repetitions_of(new).rows)
        for earlier, why in said.items()
        if earlier < len(before) and _mostly_same(before[earlier], row)
    }


def _mostly_same(one: RepetitionRow, other: RepetitionRow) -> bool:
    """Whether half of the shorter one lies in the longer: one may be found as two, or two as one."""
    both_s = min(one.end_s, other.end_s) - max(one.start_s, other.start_s)
    return both_s >= 0.5 * min(one.end_s - one.start_s, other.end_s - other.start_s)


def difference(old: Session, new: Session) -> Difference:
    """How two results of one recording differ, looked back at if both are: else all that looking back betters would
    be told as put right."""
    live = old.smoothed is None or new.smoothed is None
    before, after = (old.motion, new.motion) if live else (best_motion(old), best_motion(new))
    angles = [np.concatenate((motion.angles_rad, motion.joint_angles_rad), axis=1) for motion in (before, after)]
    if angles[0].shape != angles[1].shape:
        angles = [before.angles_rad, after.angles_rad]
    size = np.abs(angles[1] - angles[0])
    known = np.isfinite(size)
    size = np.where(known, size, 0.0)
    found = (np.isfinite(angles[1]) & ~np.isfinite(angles[0])).any(axis=1)
    both = known.any(axis=1)
    worst, which = divmod(int(size.argmax()), size.shape[1]) if size.size else (0, 0)
    at_s = float(old.timestamp_s[worst] - old.timestamp_s[0]) if size.size else 0.0
    seen = [np.isfinite(one.markers.measured_px[..., 0]).mean(axis=0) for one in (old, new)]
    gone = (seen[0] > LEAST_SEEN) & (seen[1] < 0.5 * seen[0])
    lost = tuple(name for name, is_gone in zip(old.header.protocol.markers, gone, strict=True) if is_gone)
    return Difference(
        common=int(both.sum()),
        changed=int((size > NOTICED_RAD).any(axis=1).sum()),
        most_rad=float(size.max(initial=0.0)),
        at_s=at_s,
        found=int(found.sum()),
        most_at=(*WRIST_ANGLES, *old.header.joint_names)[which],
        lost=lost,
        live=live,
    )
