"""A session tracked again after a person has put markers right, from the blobs that it stored.

What a person says of one picture holds from that picture on: a spot that is no disc is followed and left out, a disc
that was not found is added, and where a disc of the palm had the wrong place the hand is looked for anew among the
named ones. What comes before the first correction is tracked as it was. The old file is never changed.
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

from carpus.core.child_process import ChildProcess, lower_priority
from carpus.core.errors import CarpusFault, NotCorrectable, NotCorrected, OutputExists
from carpus.core.phrase import phrase
from carpus.core.pipeline.told_settings import settings_told
from carpus.core.pipeline.track import (
    Progress,
    TrackSettings,
    is_of_other_filter,
    learnt_again,
    notes_in,
    tracked_again,
    write_tracked,
    writer_again,
)
from carpus.core.session.marker_doubts import CORRECTED, SAME_SPOT_PX, Correction, said_of
from carpus.core.session.reader import read_detections, read_session
from carpus.core.session.values import DetectionTable, Event, Session
from carpus.core.tracking.operator_hints import SAME_PX, RecentSpots
from carpus.core.tracking.tracker import Tracker
from carpus.core.types import BoolArray, Detections, FloatArray, Moment, SpotAnswer, TrackedFrame

STEP_PX, HELD_WITHIN_S = 7.0, 0.5
"""A disc moves no further than this from picture to picture; so soon after a correction its name must have held."""


@dataclass(frozen=True, slots=True)
class CorrectionTask:
    """A session with its blobs, where the new one goes, and what was put right; ``by`` the initials of who did."""

    session: Session
    table: DetectionTable
    output: Path
    corrections: tuple[Correction, ...]
    by: str = ""


def task_of(origin: Path, output: Path, corrections: Sequence[Correction], by: str = "") -> CorrectionTask:
    """Read what is needed. Raises :class:`NotCorrectable` for a session without stored blobs, or tracked by another
    filter."""
    session, table = read_session(origin), read_detections(origin)
    if not len(table.frame):
        raise NotCorrectable(origin, phrase("it stored no blue spots"))
    if is_of_other_filter(session.header.parameters):
        raise NotCorrectable(origin, phrase("another filter than Carpus’ own tracked it"))
    return CorrectionTask(session, table, output, tuple(corrections), by)


def correct(task: CorrectionTask, progress: Progress | None = None) -> None:
    """Track again and store. When it cannot be done there is no output."""
    if task.output.exists():
        raise OutputExists(task.output)
    session, settings = task.session, _settings(task.session)
    ordered = _by_picture(task)
    retracking = _Retracking(session, task.table, settings, ordered)
    writer = writer_again(
        session, task.output, settings, retracking.learnt, session.calibration, {"corrected": "yes"},
    )  # fmt: skip
    said = [Event(float(session.timestamp_s[one.row]), CORRECTED, said_of(one, task.by)) for one in ordered]
    write_tracked(
        writer, retracking.frames(), retracking.looked_back if settings.smooth else None, session.calibration.verdict,
        len(session), progress, [*notes_in(session), *said],
    )  # fmt: skip


def _by_picture(task: CorrectionTask) -> list[Correction]:
    """The corrections in the order of their pictures, one of each: what was said last of a marker counts.

    Raises :class:`NotCorrectable` for a picture or a marker that is not there, or a place that is none.
    """
    session, origin = task.session, task.output.name
    places: dict[int, dict[str, tuple[float, float] | None]] = {}
    for one in task.corrections:
        if not 0 <= one.row < len(session):
            raise NotCorrectable(origin, phrase("it has no picture {number}", number=one.row + 1))
        for name, place in one.places.items():
            if name not in session.header.protocol.markers:
                raise NotCorrectable(origin, phrase("it has no marker {name}", name=name))
            size = (session.camera.width_px, session.camera.height_px)
            if place is not None and not all(0 <= at <= most for at, most in zip(place, size, strict=True)):
                raise NotCorrectable(origin, phrase("a marker was put beside the picture"))
        places.setdefault(one.row, {}).update(one.places)
    return [Correction(row, places[row]) for row in sorted(places)]


def _settings(session: Session) -> TrackSettings:
    told = settings_told(session.header.parameters)
    return told.settings if told is not None else TrackSettings()


def not_held(session: Session, table: DetectionTable, corrections: Sequence[Correction]) -> tuple[str, ...]:
    """Markers that the new result, with its spots, does not have where the person put them, nor soon after."""
    markers = list(session.header.protocol.markers)
    out = []
    for correction in corrections:
        begin = correction.row
        end = int(np.searchsorted(session.timestamp_s, session.timestamp_s[begin] + HELD_WITHIN_S)) + 1
        for name, place in correction.places.items():
            at = session.markers.measured_px[begin:end, markers.index(name)]
            if place is None:
                held = not np.isfinite(at[0]).all()
            else:
                spots, held = RecentSpots(STEP_PX), False
                for row, measured_px in enumerate(at, begin):
                    spots.keep(row, table.of_frame(row).pixel)
                    spot_px = spots.now_px(begin, np.array(place))
                    held |= spot_px is not None and bool(np.linalg.norm(measured_px - spot_px) < SAME_PX)
            if not held:
                out.append(name)
    return tuple(dict.fromkeys(out))


class _Retracking:
    """The way through the stored blobs, with the corrections on its way."""

    def __init__(
        self, session: Session, table: DetectionTable, settings: TrackSettings, corrections: Sequence[Correction]
    ) -> None:
        self._session, self._table, self._settings = session, table, settings
        self.learnt = learnt_again(session, settings)
        self._by_row = {correction.row: correction for correction in corrections}
        self._moments: list[Moment] = []
        own = self.learnt.applied(settings.tracker)
        self._tracker = Tracker(session.calibration, session.camera, own, keep_history=settings.smooth)

    def frames(self) -> Iterator[TrackedFrame]:
        return tracked_again(self._session, self._tracker, self.learnt, self._blobs_of)

    def looked_back(self) -> list[Moment]:
        self._take_moments()
        return self._moments

    def _take_moments(self) -> None:
        if self._settings.smooth:
            self._moments += self._tracker.smoothed()

    def _blobs_of(self, row: int) -> Detections:
        blobs, correction = self._table.of_frame(row), self._by_row.get(row)
        return blobs if correction is None else self._put_right(correction, blobs)

    def _put_right(self, correction: Correction, blobs: Detections) -> Detections:
        """The blobs of the corrected picture: the named ones, and what else may be a disc."""
        session = self._session
        markers = session.header.protocol.markers
        before = session.markers.measured_px[correction.row]
        now = {
            name: tuple(before[number]) for number, name in enumerate(markers) if np.isfinite(before[number]).all()
        } | dict(correction.places)
        named = np.array([place for place in now.values() if place is not None]).reshape(-1, 2)
        blobs = with_places(blobs, named)
        palm = [markers[number] for number in session.header.protocol.palm]
        if any(name in palm for name in correction.places):
            self._look_anew(float(session.timestamp_s[correction.row]))
            if not session.header.protocol.has_fingers:
                blobs = blobs.only(_nearest(blobs, named))
        for name, place in correction.places.items():
            old = before[markers.index(name)]
            is_false = np.isfinite(old).all() and not _near(named, old)
            shown = None if name in palm else place  # the palm is found anew, its discs where they are on it
            if is_false or shown is not None:
                not_px = ((float(old[0]), float(old[1])),) if is_false else ()
                self._tracker.hear(SpotAnswer(correction.row, name, shown, not_px), is_asked_again=False)
        return blobs

    def _look_anew(self, time_s: float) -> None:
        """From here on the hand is looked for, and what came before is not looked back at from there."""
        self._take_moments()
        self._tracker.begin_anywhere(time_s)
        self._tracker.hand_over()  # taken already


def with_places(blobs: Detections, places: FloatArray) -> Detections:
    """The blobs, and one more for each place (P, 2) that none of them is at: its depth is unknown."""
    missing = np.array([place for place in places if not _near(blobs.pixel, place)]).reshape(-1, 2)
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


def _near(pixels: FloatArray, place: FloatArray) -> bool:
    return bool(len(pixels)) and float(np.linalg.norm(pixels - place, axis=1).min()) <= SAME_SPOT_PX


def _nearest(blobs: Detections, places: FloatArray) -> BoolArray:
    """Which blobs (D,) are at one of the places (P, 2)."""
    if not len(blobs) or not len(places):
        return np.zeros(len(blobs), dtype=np.bool_)
    between = np.linalg.norm(blobs.pixel[:, None] - places[None], axis=-1)
    kept: BoolArray = between.min(axis=1) <= SAME_SPOT_PX
    return kept


LOOK_EVERY_S = 0.2
TELL_EVERY = 15
"""Frames."""


def correct_in_process(task: CorrectionTask, progress: Callable[[int, int], None], stopping: threading.Event) -> bool:
    """Carry a task out in a process of its own and wait for it: whether it was done; False if ``stopping`` came first.

    Raises what went wrong there; :class:`NotCorrected` where the process died.
    """
    child = ChildProcess(correct_as_child, task, name="correcting")
    try:
        while not stopping.is_set():
            if not child.link.poll(LOOK_EVERY_S):
                continue
            said: tuple[int, int] | CarpusFault | None = child.link.recv()
            if said is None:
                return True
            if isinstance(said, CarpusFault):
                raise said
            progress(*said)
        return False
    except (EOFError, BrokenPipeError, ConnectionResetError):
        raise NotCorrected(task.output.name, phrase("its process ended")) from None
    finally:
        child.end()
        _clear(task)


def correct_as_child(link: Connection, task: CorrectionTask) -> None:
    """Carry a task out in the child: frames done and in all are sent now and then, then None, or the fault."""
    lower_priority()

    def tell(done: int, total: int | None) -> None:
        if done % TELL_EVERY == 0:
            link.send((done, total or 0))

    said: CarpusFault | None = None
    try:
        correct(task, tell)
    except CarpusFault as fault:
        said = fault
    except Exception as cause:  # the one catch of this process: told, not printed
        said = NotCorrected("", f"{type(cause).__name__}: {cause}")
    with suppress(OSError):  # the owner may be gone, which may be the cause
        link.send(said)


def _clear(task: CorrectionTask) -> None:
    """A process that was killed leaves a part behind: the session it was made from is still there."""
    name = glob.escape(task.output.name)
    for path in task.output.parent.glob(f"{name}.????????.part*"):
        path.unlink(missing_ok=True)
