"""Re-analysed sessions: stored in a folder of their own until a person accepts or discards them."""

from __future__ import annotations

import shutil
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from datetime import datetime, timedelta
from functools import partial
from pathlib import Path
from uuid import uuid4

import numpy as np

from carpus.core.model.errors import CarpusFault, ConcurrentChange, OutputExists, SessionUnreadable
from carpus.core.model.hand.protocols import WRIST_ANGLES
from carpus.core.model.types import ByteImage, FloatArray
from carpus.core.platform.durable import (
    find_free_name,
    link_or_copy,
    make_private_folder,
    publish,
    replace_file,
    write_fault,
)
from carpus.core.records.changes import update_row
from carpus.core.records.data_folder import DataFolder, with_listed_exercise
from carpus.core.records.log import AuditAction
from carpus.core.records.recordings import has_session
from carpus.core.records.schema import SESSION
from carpus.core.records.session_list import PENDING_COPY_SUFFIX, PENDING_FOLDER, check_share
from carpus.core.records.session_records import choices_change
from carpus.core.records.session_setup import MARKERS_SUFFIX
from carpus.core.results.ranges import with_angle_order
from carpus.core.results.repetition_rows import RepetitionChoices, compute_repetitions
from carpus.core.results.valid_data import motion_estimate
from carpus.core.session.reader import read_detections, read_outline, read_session, rewrite_session
from carpus.core.session.values import DetectionTable, RepetitionRow, Session, SessionHeader

SESSION_SUFFIX = ".h5"


@dataclass(frozen=True, slots=True)
class PendingResult:
    """New result of a session that nobody has decided about."""

    session_id: str
    path: Path


@dataclass(frozen=True, slots=True)
class ResultDifference:
    """Difference between two results of one recording.

    ``changed_frames`` of the ``compared_frames`` differ by more than :data:`NOTICEABLE_RAD` in some angle, at most by
    ``max_difference_rad`` at ``max_difference_at_s`` in ``max_difference_angle``. ``recovered_frames`` have an angle
    that was unknown before; ``lost_markers`` are rarely seen any more. ``is_live``: live values are compared, since one
    of the two was not smoothed.
    """

    compared_frames: int
    changed_frames: int
    max_difference_rad: float
    max_difference_at_s: float
    recovered_frames: int
    max_difference_angle: str
    lost_markers: tuple[str, ...]
    is_live: bool


NOTICEABLE_RAD = np.radians(2.0)
MIN_SEEN_SHARE = 0.2
"""Markers seen in a smaller share of the frames before are not reported as lost."""


class Corrections:
    """Pending results of a data folder."""

    def __init__(self, library: DataFolder) -> None:
        self._library = library
        self._detections: tuple[Path, DetectionTable] | None = None

    @property
    def has_pending(self) -> bool:
        return any(self._folder.glob("*"))

    def delete_unfinished(self) -> None:
        """Delete what remains of results that were not finished, before the next analysis."""
        for path in self._folder.glob("*"):
            if path.suffix != SESSION_SUFFIX:
                with suppress(OSError):
                    path.unlink()

    def list_pending(self) -> Sequence[PendingResult]:
        """Return the pending results, oldest first; those of deleted sessions are deleted."""
        library, found = self._library, list[tuple[str, PendingResult]]()
        for path in sorted(self._folder.glob(f"*{SESSION_SUFFIX}")):
            with suppress(CarpusFault, OSError):  # unreadable, or the share is full or away: it stays
                header = read_outline(path).header
                if library.is_listed(header.session_id):  # a program was killed before the file had its name
                    self.accept(header.origin, path)
                    continue
                self._delete_copies(header)
                if header.origin in library.unlisted or library.is_listed(header.origin):
                    found.append((header.created, PendingResult(header.origin, path)))
                else:
                    check_share(library.store)  # else the session may be on a share that is away
                    path.unlink()
        return [one for _, one in sorted(found, key=lambda one: (one[0], one[1].path))]

    @property
    def _folder(self) -> Path:
        return self._library.folder / PENDING_FOLDER

    def new_pending_path(self, session_id: str) -> Path:
        make_private_folder(self._folder)
        return find_free_name(self._folder / self._library.entry(session_id).path.name)

    def read_frame(self, session_id: str, row: int) -> tuple[ByteImage | None, FloatArray]:
        """Return the colour frame of a row (None if not stored) and its blobs' centres (S, 2) in pixels."""
        path = self._library.entry(session_id).path
        if self._detections is None or self._detections[0] != path:
            self._detections = (path, read_detections(path))
        return self._library.read_frame(session_id, row), self._detections[1].get_frame(row).pixel

    def read_both(self, session_id: str, pending_path: Path) -> tuple[Session, Session]:
        """Return the session and its pending result."""
        return read_session(self._library.entry(session_id).path), read_session(pending_path)

    def accept(self, session_id: str, pending_path: Path, *, is_copy: bool = False) -> str:
        """Add a pending result to the patient's sessions; return its id. The old result stays.

        The file is copied beside the old one, listed together with the exclusions that still apply, and then renamed.
        After a fault or a kill all is as it was, or :meth:`list_pending` continues.
        """
        library, header = self._library, read_outline(pending_path).header
        new_id = header.session_id
        check_share(library.store)
        is_listed = library.is_listed(new_id)
        entry = library.entry(new_id if is_listed else session_id)
        path = entry.path if is_listed else find_free_name(entry.path)
        copy = _copy_path(entry.path, header)
        try:
            if not has_session(path, new_id):  # else a program was killed before it deleted what it had copied
                copy.unlink(missing_ok=True)
                link_or_copy(pending_path, copy)  # the sessions may lie on a share, which is another disk
                if not is_listed:
                    choices = library.choices(session_id)
                    kept = choices if is_copy else self._transferable_choices(session_id, choices, pending_path)
                    also = [choices_change(new_id, kept)] if kept is not None else []
                    owner_id = library.owner_id(session_id)
                    library.session_list.add(path, owner_id, entry.initials, pending_path, entry.exercise, also)
                    if kept is not None:
                        action: AuditAction = "set_aside" if kept.is_session_excluded else "changed"
                        library.audit_log.log_session(action, new_id)
                try:
                    publish(copy, path)
                except OutputExists:  # since the name was found free
                    if not has_session(path, new_id):  # else another program has accepted this result
                        path = find_free_name(path)
                        stored_path = library.session_list.relative_path(path)
                        library.store.apply([update_row(SESSION, new_id, path=stored_path)])
                        publish(copy, path)
            photos = (one.path.with_suffix(MARKERS_SUFFIX) for one in library.result_versions(new_id))
            photo = next((one for one in photos if one.is_file()), None)
            if photo is not None and not path.with_suffix(MARKERS_SUFFIX).exists():
                replace_file(path.with_suffix(MARKERS_SUFFIX), partial(shutil.copyfile, photo))
            self._delete_copies(header)
            pending_path.unlink(missing_ok=True)
        except OSError as cause:
            raise write_fault(pending_path, cause) from cause
        finally:
            with suppress(OSError):
                copy.unlink(missing_ok=True)
        return new_id

    def _delete_copies(self, header: SessionHeader) -> None:
        """Delete copies that a killed program left."""
        for one in self._library.session_list.recording_versions(header.recording_id):
            with suppress(OSError):
                _copy_path(one.path, header).unlink(missing_ok=True)

    def _transferable_choices(
        self, session_id: str, choices: RepetitionChoices, pending_path: Path
    ) -> RepetitionChoices | None:
        """Return the choices of the old result that also apply to the new one.

        Edges belong to repetitions, which are found anew.
        """
        library, excluded = self._library, dict[int, str]()
        if choices.excluded:
            with suppress(SessionUnreadable):
                new = with_listed_exercise(read_session(pending_path), library.entry(session_id))
                before = compute_repetitions(library.session(session_id)).rows
                after = compute_repetitions(with_angle_order(new, library.get_angle_order())).rows
                excluded = match_exclusions(choices.excluded, before, after)
        return replace(choices, excluded=excluded, edges_s={}) if choices.is_session_excluded or excluded else None

    def restore_version(self, session_id: str) -> str:
        """Make an older result the newest version again, with its choices; return the new id.

        The file is written again with a later date of creation, whatever the clocks of other computers say. Its origin
        stays, since it was not re-analysed. After a fault nothing is left.
        """
        path, newest = self.new_pending_path(session_id), self._library.result_versions(session_id)[-1].created
        made = max(datetime.now().astimezone(), newest + timedelta(seconds=1.0)).isoformat()
        rewrite_session(self._library.entry(session_id).path, path, session_id=str(uuid4()), created=made)
        try:
            return self.accept(session_id, path, is_copy=True)
        except CarpusFault:
            with suppress(CarpusFault, OSError):
                self.discard(path)
            raise

    def discard(self, pending_path: Path) -> None:
        """Delete a pending result.

        Raises :class:`ConcurrentChange` if it is listed already, and :class:`SessionUnreadable`.
        """
        if pending_path.exists():
            if self._library.is_listed(read_outline(pending_path).header.session_id):
                raise ConcurrentChange(SESSION.name)
            pending_path.unlink()


def _copy_path(path: Path, header: SessionHeader) -> Path:
    """Return the path of a new result beside its session until it is listed.

    Backups leave it out, and it is erased with that session.
    """
    return path.with_name(f".{path.stem}.{header.session_id[:8]}{PENDING_COPY_SUFFIX}")


def match_exclusions(
    reasons: Mapping[int, str], before: Sequence[RepetitionRow], after: Sequence[RepetitionRow]
) -> dict[int, str]:
    """Return reasons of excluded repetitions by their number among the new ones.

    A reason such as pain belongs to a moment: it goes to repetitions that share half of the shorter one, since one may
    be found as two, or two as one.
    """
    excluded = {}
    for number, new in enumerate(after):
        for earlier, reason in reasons.items():
            if earlier < len(before):
                old = before[earlier]
                common_s = min(old.end_s, new.end_s) - max(old.start_s, new.start_s)
                if common_s >= 0.5 * min(old.end_s - old.start_s, new.end_s - new.start_s):
                    excluded[number] = reason
    return excluded


def compare_results(old: Session, new: Session) -> ResultDifference:
    """Compare two results of one recording; smoothed values only if both are smoothed."""
    live = old.smoothed is None or new.smoothed is None
    before, after = (old.motion, new.motion) if live else (motion_estimate(old), motion_estimate(new))
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
    gone = (seen[0] > MIN_SEEN_SHARE) & (seen[1] < 0.5 * seen[0])
    lost = tuple(name for name, is_gone in zip(old.header.protocol.markers, gone, strict=True) if is_gone)
    return ResultDifference(
        compared_frames=int(both.sum()),
        changed_frames=int((size > NOTICEABLE_RAD).any(axis=1).sum()),
        max_difference_rad=float(size.max(initial=0.0)),
        max_difference_at_s=at_s,
        recovered_frames=int(found.sum()),
        max_difference_angle=(*WRIST_ANGLES, *old.header.joint_names)[which],
        lost_markers=lost,
        is_live=live,
    )
