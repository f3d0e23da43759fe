"""What review, progress and report say of a session, as figures; the words and the page are the screen's.

Here they are put together to one table of measures (``measure``), with how sure they are and the strokes' speed. The
rest is made in the file of its topic, on a session as :mod:`core.results.seen` has it, by the bare mathematics of
:mod:`core.measures`, which knows no session: ``ranges``, ``repetition_rows``, ``further_measures``, ``norms``; what
changed between sessions in ``progress`` and ``side_by_side``. Degrees, degrees per second, millimetres and seconds,
since people read them. NaN is unknown.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import datetime

import numpy as np

from carpus.core.calibration.result import CalibrationFinding
from carpus.core.hand.exercises import STILL_RADIUS_MM, Exercise
from carpus.core.hand.forearm_rotation import read_targets_deg
from carpus.core.hand.protocols import WRIST_ANGLES
from carpus.core.measures.change import DEFAULT_LIMITS, ErrorLimits, RetestStudy
from carpus.core.measures.fingers import JointTrack
from carpus.core.measures.forearm import WristCentre, rotation_in_place, wrist_centre
from carpus.core.measures.repetitions import Uncounted, what_was_not_counted
from carpus.core.measures.signals import even_signal, low_pass
from carpus.core.measures.speed import StrokeMeasures
from carpus.core.results.camera_said import UNKNOWN_CAMERA, CameraSaid, camera_said
from carpus.core.results.further_measures import Attempts, further_measures
from carpus.core.results.measure import Group, Measure, MeasureKey, Unknown, measure_values
from carpus.core.results.norms import total_shares
from carpus.core.results.ranges import joint_ranges, measure_still_angles, wrist_ranges
from carpus.core.results.repetition_rows import (
    ACTIVE,
    PASSIVE,
    Measured,
    RepetitionChoices,
    ShownRepetition,
    Trained,
    measured_repetitions,
    shown_repetitions,
    trained_angle,
    without_passive,
)
from carpus.core.results.seen import SeenSession, best_motion
from carpus.core.session.marker_doubts import CorrectedFrom, corrected_from
from carpus.core.session.values import AngleOrder, Session
from carpus.core.types import FloatArray, Side, TrackStatus

Best = Callable[[Sequence[float]], float] | None
SPEEDS: tuple[tuple[str, str, str, Best], ...] = (
    ("peak speed", "deg/s", "peak_speed_rad_s", max), ("smoothness", "SPARC", "sparc", max),
    ("mean speed", "deg/s", "mean_speed_rad_s", max), ("movement time", "s", "movement_time_s", min),
    ("time to peak", "share", "time_to_peak_share", None), ("movement units", "1", "peaks", min),
    ("jerk", "LDLJ", "ldlj", max), ("pauses", "1", "pauses", min), ("pause time", "s", "pause_s", min),
)  # fmt: skip
"""Name, unit and attribute of what is measured of every stroke, and which is its best."""


def speed_measures(of: str, strokes: Sequence[StrokeMeasures]) -> tuple[Measure, ...]:
    """Summarise the strokes that count; of those whose speed or smoothness the tracker's noise hides nothing is
    known."""
    slow: dict[str, Unknown] = {
        "peak speed": "too_slow" if any(one.too_slow for one in strokes) else "",
        "smoothness": "too_slow" if any(one.too_slow_to_be_smooth for one in strokes) else "",
    }
    out = []
    for what, unit, name, best in SPEEDS:
        read = math.degrees if unit == "deg/s" else float
        sds = [math.degrees(one.peak_speed_sd_rad_s) for one in strokes] if what == "peak speed" else ()
        values = [read(getattr(one, name)) for one in strokes]
        out.append(measure_values("speed", of, what, unit, values, sds=sds, best=best, unknown=slow.get(what, "")))
    return tuple(out) if strokes else ()


STILLNESS_CUTOFF_HZ = 3.0
"""A forearm does not move faster than this; noise does."""


@dataclass(frozen=True, slots=True)
class Quality:
    """How sure the figures are. Shares 0 to 1 of all frames; ``hidden_share`` of all looks at markers."""

    frames: int
    measured_share: float
    hidden_share: float
    dropped: int
    forearm_mm: float
    angle_sd_deg: float
    tilt_deg: float
    distance_m: float
    residual_mm: float
    centre_mm: tuple[float, float, float] = (math.nan,) * 3
    centre_residual_mm: float = math.nan
    """Where the wrist turns, from the WRIST disc in the hand's axes, and how well that fits."""

    @classmethod
    def unknown(cls, frames: int) -> Quality:
        """Of a session of which nothing of this could be computed."""
        return cls(frames, math.nan, math.nan, 0, *(math.nan,) * 5)

    @property
    def forearm_moved(self) -> bool:
        """Whether the wrist's centre left the ball it must stay in."""
        return self.forearm_mm > STILL_RADIUS_MM


def quality_of(seen: SeenSession, repetitions: Sequence[ShownRepetition]) -> Quality:
    """Of a session with these repetitions."""
    session, motion, verdict = seen.session, best_motion(seen.session), seen.session.calibration.verdict
    time_s = session.timestamp_s - session.timestamp_s[:1]
    centre = wrist_centre(motion.position_m, rotation_in_place(motion.rotation_w2_w0, motion.w0_turn_rad), seen.view)
    within = [one for one in repetitions if one.counts] if seen.tracks else ()
    return Quality(
        frames=len(session),
        measured_share=float(np.mean(session.status == TrackStatus.TRACKED)) if len(session) else math.nan,
        hidden_share=_hidden_share(session, time_s, within),
        dropped=int(np.maximum(session.quality.dropped_before, 0).sum()),
        forearm_mm=_forearm_mm(time_s, centre),
        centre_mm=tuple((1e3 * centre.centre_w2_m).tolist()),
        centre_residual_mm=1e3 * centre.residual_m,
        angle_sd_deg=_typical_joint_sd(seen.tracks) if seen.tracks else _typical_sd(session, seen.exercise),
        tilt_deg=verdict.tilt_deg,
        distance_m=verdict.distance_m,
        residual_mm=float(np.nanmax(verdict.residual_mm)) if np.isfinite(verdict.residual_mm).any() else math.nan,
    )


def _hidden_share(session: Session, time_s: FloatArray, within: Sequence[ShownRepetition]) -> float:
    """Share of all looks at markers in which one was hidden, within repetitions if any: rest hides none."""
    inside = np.ones(len(time_s), dtype=bool)
    if within:
        inside = np.any([(time_s >= rep.start_s) & (time_s <= rep.end_s) for rep in within], axis=0)
    seen = np.isfinite(session.markers.measured_px[inside, :, 0])
    return float(np.mean(~seen)) if seen.size else math.nan


def _forearm_mm(time_s: FloatArray, centre: WristCentre) -> float:
    """How far the forearm went: what the centre of the wrist's turning moved, without a frame's noise."""
    known = np.isfinite(centre.moved_m)
    if int(known.sum()) < 2:
        return math.nan
    moved = low_pass(even_signal(time_s, centre.moved_m, known), STILLNESS_CUTOFF_HZ).value
    return 1000.0 * float(np.nanmax(moved)) if np.isfinite(moved).any() else math.nan


def _typical_sd(session: Session, exercise: Exercise) -> float:
    sds_deg = np.degrees(best_motion(session).angles_sd_rad)
    columns = sds_deg if exercise.angle is None else sds_deg[:, [exercise.angle]]
    known = columns[(np.asarray(session.status) == TrackStatus.TRACKED)[:, None] & np.isfinite(columns)]
    return float(np.median(known)) if known.size else math.nan


def _typical_joint_sd(tracks: Mapping[str, JointTrack]) -> float:
    known = [track.seen_sd.value[track.seen_sd.finite] for track in tracks.values() if track.known]
    return math.degrees(float(np.median(np.concatenate(known)))) if known else math.nan


@dataclass(frozen=True, slots=True)
class SessionFigures:
    """What is said of one session: its ``measures``, and what makes them comparable or doubtful."""

    session_id: str
    subject_id: str
    when: datetime
    side: Side
    protocol: str
    exercise: Exercise
    duration_s: float
    recovered: bool
    smoothed: bool
    software_version: str
    start_angles_deg: FloatArray
    repetitions: tuple[ShownRepetition, ...]
    measures: tuple[Measure, ...]
    quality: Quality
    pain: tuple[int, ...]
    notes: tuple[tuple[float, str], ...]
    findings: tuple[CalibrationFinding, ...] = ()
    """What was doubtful at the calibration, and measured all the same."""
    simulated: bool = False
    """Whether a simulated hand was measured: nobody's movement."""
    not_counted: bool = False
    """Whether a person decided that the session shall not count."""
    older: bool = False
    """Whether there is a result of the same recording that was made later."""
    targets_deg: tuple[float, float] = (math.nan, math.nan)
    """Targets of the trained angle, of its positive and its negative direction, signed; NaN for none."""
    pain_s: tuple[float, ...] = ()
    """When each of ``pain`` was said, after the first frame."""
    uncounted: Uncounted | None = None
    """Why there is no repetition, None where there are some or none are counted."""
    unseen_s: float = 0.0
    """How long nothing was seen, each time for longer than can be counted across."""
    recording_id: str = ""
    created: datetime | None = None
    """Which recording it is a result of, and when that result was made."""
    angle_order: AngleOrder = "zyx"
    earlier_results: int = 0
    """Results of the same recording that were made before this one: they do not count."""
    error_limits: ErrorLimits = DEFAULT_LIMITS
    """Against which its changes are judged."""
    camera: CameraSaid = UNKNOWN_CAMERA
    """Which camera it was measured with, and its calibration."""
    corrected: CorrectedFrom | None = None
    """Since when it stands with markers that a person put right; None as measured."""
    without_passive: bool = False
    """Whether ranges over the whole recording leave out stretches in which somebody else moved the hand."""
    _by_key: Mapping[MeasureKey, Measure] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "_by_key", {one.key: one for one in self.measures if not one.passive})

    @property
    def study(self) -> RetestStudy | None:
        """The clinic's own test and retest of such sessions, None where the default limits hold."""
        return self.error_limits.study(self.protocol, self.exercise.id, self.angle_order)

    @property
    def counted(self) -> int:
        return sum(repetition.counts for repetition in self.repetitions)

    @property
    def main_angle(self) -> str:
        """The joint or the wrist's angle that the exercise trains; empty where it trains none."""
        exercise = self.exercise
        return exercise.joint or ("" if exercise.angle is None else WRIST_ANGLES[exercise.angle])

    @property
    def has_passive(self) -> bool:
        """Whether there are repetitions in which somebody else moved the hand."""
        return any(repetition.helped for repetition in self.repetitions)

    def find(self, of: str, what: str) -> Measure | None:
        """The measure of an angle, joint or way, without what was passive."""
        return self._by_key.get((of, what))

    def group(self, group: Group) -> tuple[Measure, ...]:
        """All measures of a group, without what was passive."""
        return tuple(one for one in self.measures if one.group == group and not one.passive)

    @property
    def wrist_ranges(self) -> tuple[Measure, ...]:
        return tuple(one for one in self.group("range") if one.angle >= 0)

    @property
    def joint_ranges(self) -> tuple[Measure, ...]:
        """Of the whole hand: arc, most bent and least bent of every joint, and the TAM of every finger."""
        return tuple(one for one in self.group("range") if one.angle < 0)

    def speed(self, what: str) -> Measure | None:
        """One of :data:`SPEEDS`; None where no stroke was measured."""
        return next((one for one in self.group("speed") if one.what == what), None)

    def as_passive(self) -> SessionFigures | None:
        """The session as if the repetitions in which somebody else moved the hand were all of it; None without any."""
        if not self.has_passive:
            return None
        repetitions = (replace(one, reason="" if one.helped else one.reason or ACTIVE) for one in self.repetitions)
        measures = (replace(one, passive=False) for one in self.measures if one.passive)
        return replace(self, repetitions=tuple(repetitions), measures=tuple(measures))


def session_figures(
    session: Session, choices: RepetitionChoices | None = None, error_limits: ErrorLimits = DEFAULT_LIMITS
) -> SessionFigures:
    """All figures of one session, with a person's corrections to its repetitions."""
    choices, header, attempts = choices or RepetitionChoices(), session.header, Attempts()
    seen = SeenSession.of(session)
    trained = attempts.compute("repetitions", lambda: trained_angle(seen), None)
    measured: tuple[Measured, ...] = ()
    if trained is not None:
        measured = attempts.compute("repetitions", lambda: measured_repetitions(trained, choices), ())
    repetitions = shown_repetitions(measured)
    counted = tuple(one.window for one in measured if one.row.counted)
    helped = tuple(one.window for one in measured if one.left_out == PASSIVE and not one.unmeasured)
    active = without_passive(session, measured)
    own = seen if active is session else SeenSession.of(active)
    over = seen if counted else own
    rows = attempts.compute("ranges", lambda: wrist_ranges(over, counted), ())
    rows += attempts.compute("ranges of joints", lambda: joint_ranges(over.tracks, counted, over.exercise), ())
    if not counted and any(one.is_whole for one in repetitions):
        rows = ()  # all were left out: nothing is measured, least of all the whole recording
    passive: tuple[Measure, ...] = ()
    if helped:
        passive = attempts.compute("ranges", lambda: wrist_ranges(seen, helped), ())
        passive += attempts.compute("ranges of joints", lambda: joint_ranges(seen.tracks, helped, seen.exercise), ())
    strokes = [stroke for one in measured if one.row.counted for stroke in one.strokes if not stroke.stroke.half]
    still = attempts.compute("other movements", lambda: measure_still_angles(own), ())
    speeds: tuple[Measure, ...] = ()
    if trained is not None:
        speeds = attempts.compute("speed", lambda: speed_measures(trained.name, strokes), ())
    quality = attempts.compute("quality", lambda: quality_of(seen, repetitions), Quality.unknown(len(session)))
    shares = attempts.compute("grades", lambda: total_shares(rows, seen.exercise), ())
    uncounted = attempts.compute("repetitions", lambda: _why_none(seen, trained), None)
    task = (*further_measures(own), *attempts.as_measures())
    pains = [(time_s, int(text)) for time_s, text in _told(session, "pain") if text.isdigit()]
    return SessionFigures(
        session_id=header.session_id,
        subject_id=header.subject_id,
        when=header.when,
        side=header.hand,
        protocol=header.protocol.name,
        exercise=seen.exercise,
        duration_s=float(session.timestamp_s[-1] - session.timestamp_s[0]) if len(session) else 0.0,
        recovered=bool(session.recovered),
        smoothed=session.smoothed is not None,
        software_version=header.software_version,
        start_angles_deg=np.degrees(session.calibration.start_angles_rad),
        repetitions=repetitions,
        measures=(*rows, *(replace(one, passive=True) for one in passive), *task, *shares, *speeds, *still),
        quality=quality,
        uncounted=uncounted,
        unseen_s=sum(end - start for start, end in trained.found.unseen_s) if trained is not None else 0.0,
        pain=tuple(score for _, score in pains),
        pain_s=tuple(time_s for time_s, _ in pains),
        notes=tuple(said for said in _told(session, "note") if said[1] and len(session)),
        findings=session.calibration.verdict.findings,
        simulated=header.simulated,
        not_counted=choices.not_counted,
        targets_deg=read_targets_deg(header.targets_deg, seen.exercise),
        recording_id=header.recording_id,
        created=datetime.fromisoformat(header.created),
        angle_order=session.angle_order,
        error_limits=error_limits,
        camera=camera_said(header.parameters),
        corrected=corrected_from(session),
        without_passive=not counted and own is not seen,
    )


def data_digest(session: Session) -> str:
    """SHA-256 over times, status and angles as stored: two reports with the same digest show the same measurement."""
    digest = hashlib.sha256()
    motion = best_motion(session)
    for array in (
        session.timestamp_s,
        np.asarray(session.status, dtype=np.int64),
        motion.angles_rad,
        motion.angles_sd_rad,
    ):
        digest.update(np.ascontiguousarray(array).tobytes())
    return digest.hexdigest()


def _told(session: Session, kind: str) -> list[tuple[float, str]]:
    """When after the first frame something of a kind was told, and what."""
    start_s = float(session.timestamp_s[0]) if len(session) else math.nan
    return [(event.time_s - start_s, event.text) for event in session.events if event.kind == kind]


def _why_none(seen: SeenSession, trained: Trained | None) -> Uncounted | None:
    """Why there is no repetition of an angle that is one of this session's."""
    if trained is not None:
        return what_was_not_counted(trained.seen, trained.found)
    return "nothing_seen" if seen.exercise.angle is not None or seen.exercise.joint in seen.tracks else None
