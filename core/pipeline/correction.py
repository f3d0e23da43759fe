"""Re-tracking of a session from its stored detections with corrected markers.

A correction holds from its frame on: a false marker is excluded, a missing one is added, and after a correction of the
palm the hand is reacquired from the labelled blobs. Frames before the first correction are tracked as before. The old
file is never changed.
"""

from __future__ import annotations

import glob
import math
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from multiprocessing.connection import Connection
from pathlib import Path

import numpy as np

from carpus.core.model.errors import CarpusFault, MarkersNotCorrectable, OutputExists, ReanalysisFailed
from carpus.core.model.phrase import phrase
from carpus.core.model.types import Detections, FloatArray, KinematicState, TrackedFrame
from carpus.core.pipeline.stored_settings import settings_from_json
from carpus.core.pipeline.track import (
    Progress,
    TrackSettings,
    create_retrack_writer,
    is_of_other_filter,
    retrack_frames,
    session_noise,
    session_notes,
    write_tracked,
)
from carpus.core.platform.child_process import ChildProcess, lower_priority
from carpus.core.session.label_checks import CORRECTED, SAME_BLOB_PX, Correction, correction_to_json
from carpus.core.session.reader import read_detections, read_session
from carpus.core.session.values import DetectionTable, Event, Session
from carpus.core.tracking.association.operator_labels import SAME_POSITION_PX, follow_blob
from carpus.core.tracking.tracker import Tracker

HOLD_TIME_S = 0.5
"""Largest movement of a marker between two frames; time within which the tracker must confirm a corrected label."""


@dataclass(frozen=True, slots=True)
class CorrectionTask:
    """Session with its detections, the output file, the corrections, and the initials of who made them."""

    session: Session
    table: DetectionTable
    output: Path
    corrections: tuple[Correction, ...]
    initials: str = ""


def load_task(origin: Path, output: Path, corrections: Sequence[Correction], initials: str = "") -> CorrectionTask:
    """Read the session to be corrected.

    Raises :class:`MarkersNotCorrectable` if it has no stored detections or another filter tracked it.
    """
    session, table = read_session(origin), read_detections(origin)
    if not len(table.frame):
        raise MarkersNotCorrectable(origin, phrase("no saved blue spots"))
    if is_of_other_filter(session.header.parameters):
        raise MarkersNotCorrectable(origin, phrase("not tracked with the Carpus filter"))
    return CorrectionTask(session, table, output, tuple(corrections), initials)


def correct(task: CorrectionTask, progress: Progress | None = None) -> None:
    """Track the session again and store it; after a fault there is no output."""
    if task.output.exists():
        raise OutputExists(task.output)
    session, stored = task.session, settings_from_json(task.session.header.parameters)
    settings = TrackSettings() if stored is None else stored.settings
    ordered = _merge_corrections(task)
    retracker = _Retracker(session, task.table, settings, ordered)
    writer = create_retrack_writer(
        session, task.output, settings, retracker.noise, session.calibration, {"corrected": "yes"},
    )  # fmt: skip
    events = [
        Event(float(session.timestamp_s[each.row]), CORRECTED, correction_to_json(each, task.initials))
        for each in ordered
    ]
    write_tracked(
        writer, retracker.frames(), retracker.smooth if settings.smooth else None, session.calibration.verdict,
        len(session), progress, [*session_notes(session), *events],
    )  # fmt: skip


def _merge_corrections(task: CorrectionTask) -> list[Correction]:
    """Return the corrections by frame, one for each; the last one of a marker counts.

    Raises :class:`MarkersNotCorrectable` for an unknown frame or marker, or a place outside the image.
    """
    session, origin = task.session, task.output.name
    places: dict[int, dict[str, tuple[float, float] | None]] = {}
    for correction in task.corrections:
        if not 0 <= correction.row < len(session):
            raise MarkersNotCorrectable(origin, phrase("no frame {number}", number=correction.row + 1))
        for name, place in correction.places.items():
            if name not in session.header.protocol.markers:
                raise MarkersNotCorrectable(origin, phrase("no marker {name}", name=name))
            size = (session.camera.width_px, session.camera.height_px)
            if place is not None and not all(0 <= at <= most for at, most in zip(place, size, strict=True)):
                raise MarkersNotCorrectable(origin, phrase("a marker was placed outside the image"))
        places.setdefault(correction.row, {}).update(correction.places)
    return [Correction(row, places[row]) for row in sorted(places)]


def find_lost_corrections(
    session: Session, table: DetectionTable, corrections: Sequence[Correction]
) -> tuple[str, ...]:
    """Return the markers that the new result does not have at their corrected places, nor soon after."""
    markers = list(session.header.protocol.markers)
    lost = []
    for correction in corrections:
        begin = correction.row
        end = int(np.searchsorted(session.timestamp_s, session.timestamp_s[begin] + HOLD_TIME_S)) + 1
        for name, place in correction.places.items():
            at = session.markers.measured_px[begin:end, markers.index(name)]
            if place is None:
                held = not np.isfinite(at[0]).all()
            else:
                spot_px, held = np.array(place), False
                for row, measured_px in enumerate(at, begin):
                    spot_px, is_seen = follow_blob(spot_px, table.get_frame(row).pixel)
                    held |= is_seen and bool(np.linalg.norm(measured_px - spot_px) < SAME_POSITION_PX)
            if not held:
                lost.append(name)
    return tuple(dict.fromkeys(lost))


class _Retracker:
    """Tracker over the stored detections that applies the corrections at their frames."""

    def __init__(
        self, session: Session, table: DetectionTable, settings: TrackSettings, corrections: Sequence[Correction]
    ) -> None:
        self._session, self._table, self._settings = session, table, settings
        self.noise = session_noise(session, settings)
        self._corrections = {correction.row: correction for correction in corrections}
        self._smoothed: list[KinematicState] = []
        tracker_settings = self.noise.adapt_settings(settings.tracker)
        self._tracker = Tracker(session.calibration, session.camera, tracker_settings, keep_history=settings.smooth)

    def frames(self) -> Iterator[TrackedFrame]:
        return retrack_frames(self._session, self._tracker, self.noise, self._frame_detections)

    def smooth(self) -> list[KinematicState]:
        self._collect_smoothed()
        return self._smoothed

    def _collect_smoothed(self) -> None:
        if self._settings.smooth:
            self._smoothed += self._tracker.smooth()

    def _frame_detections(self, row: int) -> Detections:
        """Return the detections of a frame; of a corrected one the labelled blobs, and others that may be markers."""
        blobs, correction = self._table.get_frame(row), self._corrections.get(row)
        if correction is None:
            return blobs
        session = self._session
        markers = session.header.protocol.markers
        before = session.markers.measured_px[correction.row]
        now = {
            name: tuple(before[number]) for number, name in enumerate(markers) if np.isfinite(before[number]).all()
        } | dict(correction.places)
        named = np.array([place for place in now.values() if place is not None]).reshape(-1, 2)
        blobs = with_added_detections(blobs, named)
        palm = [markers[number] for number in session.header.protocol.palm]
        if any(name in palm for name in correction.places):
            self._collect_smoothed()  # frames from here on are smoothed separately
            self._tracker.drop_track(float(session.timestamp_s[correction.row]))
            self._tracker.pop_steps()  # collected already
            if not session.header.protocol.has_fingers:
                blobs = blobs.subset(np.array([_is_near(named, pixel) for pixel in blobs.pixel], dtype=np.bool_))
        for name, place in correction.places.items():
            marker = markers.index(name)
            if np.isfinite(before[marker]).all() and not _is_near(named, before[marker]):
                self._tracker.labels.reject(marker, before[marker])
            if place is not None and name not in palm:  # the palm is reacquired, with its markers
                self._tracker.labels.add(marker, np.array(place))
        return blobs


def with_added_detections(blobs: Detections, places: FloatArray) -> Detections:
    """Return the detections with one more for each place (P, 2) that has none; its depth is unknown."""
    missing = np.array([place for place in places if not _is_near(blobs.pixel, place)]).reshape(-1, 2)
    if not len(missing):
        return blobs
    count = len(missing)
    unknown = np.full(count, math.nan)
    area = float(np.median(blobs.area_px)) if len(blobs) else math.nan
    return replace(
        blobs,
        pixel=np.concatenate((blobs.pixel, missing)),
        depth_m=np.concatenate((blobs.depth_m, unknown)),
        depth_sd_m=np.concatenate((blobs.depth_sd_m, unknown)),
        area_px=np.concatenate((blobs.area_px, np.full(count, area))),
        similarity=np.concatenate((blobs.similarity, np.ones(count))),
    )


def _is_near(pixels: FloatArray, place: FloatArray) -> bool:
    return bool(len(pixels)) and float(np.linalg.norm(pixels - place, axis=1).min()) <= SAME_BLOB_PX


POLL_S = 0.2
PROGRESS_EVERY_FRAMES = 15
"""Frames."""


def correct_in_process(task: CorrectionTask, progress: Callable[[int, int], None], stopping: threading.Event) -> bool:
    """Correct a session in a process of its own; return False if ``stopping`` came first.

    Raises the fault of the process, or one if the process died.
    """
    child = ChildProcess(correct_as_child, task, name="correcting")
    try:
        while not stopping.is_set():
            if not child.link.poll(POLL_S):
                continue
            message: tuple[int, int] | CarpusFault | None = child.link.recv()
            if message is None:
                return True
            if isinstance(message, CarpusFault):
                raise message
            progress(*message)
        return False
    except (EOFError, BrokenPipeError, ConnectionResetError):
        raise ReanalysisFailed(task.output.name, phrase("process ended")) from None
    finally:
        child.end()
        # remove the part files of a killed process; the original session still exists
        name = glob.escape(task.output.name)
        for path in task.output.parent.glob(f"{name}.????????.part*"):
            path.unlink(missing_ok=True)


def correct_as_child(link: Connection, task: CorrectionTask) -> None:
    """Correct a session in the child process: send progress, then None or the fault."""
    lower_priority()

    def report_progress(done: int, total: int | None) -> None:
        if done % PROGRESS_EVERY_FRAMES == 0:
            link.send((done, total or 0))

    message: CarpusFault | None = None
    try:
        correct(task, report_progress)
    except CarpusFault as fault:
        message = fault
    except Exception as cause:  # reported to the owner, not printed
        message = ReanalysisFailed("", f"{type(cause).__name__}: {cause}")
    with suppress(OSError):  # the owner may have died, which may be the cause
        link.send(message)
