"""What review, progress and report say of a session, as figures and verdicts; the words and the page are the screen's.

Degrees, degrees per second, millimetres and seconds, since people read them. NaN is unknown.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import datetime
from typing import Literal

import numpy as np

from carpus.core.by_hand.values import HandValue
from carpus.core.calibration.result import CalibrationFinding
from carpus.core.hand.sites import WRIST_ANGLES
from carpus.core.measures.change import ARC_LIMIT_FACTOR, TOTAL_ACTIVE_MOTION, MeasuredMean, Obstacle, change_between
from carpus.core.measures.error_limits import DEFAULT_LIMITS, ErrorLimits, RetestStudy
from carpus.core.measures.fingers import JointTrack
from carpus.core.measures.forearm import WristCentre, rotation_in_place, wrist_centre
from carpus.core.measures.motion_range import FEWEST_FOR_SPREAD, MotionRange, motion_range
from carpus.core.measures.noise import HIGHEST_CUTOFF_HZ
from carpus.core.measures.repetitions import FoundRepetitions, Repetition, Uncounted, what_was_not_counted
from carpus.core.measures.signals import Signal, even_signal, low_pass
from carpus.core.measures.speed import StrokeMeasures
from carpus.core.output.camera_said import UNKNOWN_CAMERA, CameraSaid, camera_said
from carpus.core.output.exercises import SIDES, STILL_RADIUS_MM, Exercise, Movement, exercise_named
from carpus.core.output.further_measures import (
    FurtherMeasure,
    GradedTotal,
    further_measures,
    graded_totals,
    held_tremor,
)
from carpus.core.output.joint_content import joint_rows, joint_tracks
from carpus.core.output.range_rows import RangeRow, RowKey, best_motion, is_total, range_row
from carpus.core.output.repetition_rows import (
    ACTIVE,
    HIDDEN,
    PASSIVE,
    Measured,
    Unmeasured,
    measured_repetitions,
    passive_stretches,
    seen_well,
    trained_angle,
    wrist_signals,
)
from carpus.core.output.repetition_rows import RepetitionChoices as RepetitionChoices
from carpus.core.session.corrected import CorrectedFrom, corrected_from
from carpus.core.session.values import AngleOrder, RepetitionRow, Session
from carpus.core.types import FloatArray, Side, TrackStatus

Verdict = Literal["improved", "worse", "no_change", "not_judged"]
Unfairness = Literal[
    Obstacle,
    "simulated",
    "not_counted",
    "doubtful",
    "distance",
    "start_angle",
    "forearm_moved",
    "incomplete",
    "hidden",
    "angle_order",
    "only_passive",
]
NAMES_DOUBTED = ("swapped", "shifted", "misnamed", "wrong_side", "other_length", "depth_off", "other_spot", "no_palm")
"""Findings at the calibration after which the angles may be something else: such a session never compares."""

FREE_ORDER = (1, 0, 2)
"""Bending first where no angle is trained."""
TREMOR_NOISE_RAD = math.radians(0.25)
"""What the tracker shows between 3 and 12 Hz of a hand that lies still: the sd that moves from frame to frame."""
STILLNESS_CUTOFF_HZ = 3.0
"""A forearm does not move faster than this; noise does."""
LARGEST_DISTANCE_STEP_M = 0.10
LARGEST_START_ANGLE_STEP_DEG = 5.0
"""Beyond these two sessions were not set up alike."""


@dataclass(frozen=True, slots=True)
class ShownRepetition:
    """One repetition, seconds after the first frame. ``reason`` says why it is left out, empty when it counts.

    From where it left one turning place to where it reached the last, as its ``row`` with all its measures says.
    ``unmeasured`` why it cannot count, whoever wants it: too little of it was seen, or a piece alone.
    """

    start_s: float
    end_s: float
    reason: str
    unmeasured: Unmeasured = ""
    row: RepetitionRow | None = None

    @property
    def helped(self) -> bool:
        """Whether it counts among those in which somebody else moved the hand."""
        return self.reason == PASSIVE and not self.unmeasured

    @property
    def counts(self) -> bool:
        """Whether the figures include it."""
        return not self.reason and not self.unmeasured

    @property
    def is_whole(self) -> bool:
        """Whether the recording has all of it, seen or not."""
        return self.unmeasured in ("", HIDDEN)


@dataclass(frozen=True, slots=True)
class StrokeSpread:
    """A quantity over strokes or repetitions; ``best`` the quickest or smoothest, NaN where neither way is better;
    ``measurement_sd`` of one of them by the tracker's noise, NaN unknown."""

    mean: float
    sd: float
    best: float
    count: int
    measurement_sd: float = math.nan


@dataclass(frozen=True, slots=True)
class SpeedFigures:
    """Strokes in figures beside their peak speed and SPARC: degrees per second, seconds, shares, dimensionless.

    ``too_slow`` strokes of ``count`` whose speed is lost in the tracker's noise, ``too_slow_to_be_smooth`` those whose
    smoothness is: of them nothing is said.
    """

    count: int
    too_slow: int
    too_slow_to_be_smooth: int
    mean_speed: StrokeSpread
    movement_time: StrokeSpread
    time_to_peak: StrokeSpread
    peaks: StrokeSpread
    ldlj: StrokeSpread
    pauses: StrokeSpread
    pause_time: StrokeSpread

    @classmethod
    def of(cls, strokes: Sequence[StrokeMeasures]) -> SpeedFigures:
        """Of the strokes that count."""
        return cls(
            len(strokes),
            sum(stroke.too_slow for stroke in strokes),
            sum(stroke.too_slow_to_be_smooth for stroke in strokes),
            _spread([math.degrees(stroke.mean_speed_rad_s) for stroke in strokes]),
            _spread([stroke.movement_time_s for stroke in strokes], best=min),
            _spread([stroke.time_to_peak_share for stroke in strokes], best=None),
            _spread([stroke.peaks for stroke in strokes], best=min),
            _spread([stroke.ldlj for stroke in strokes]),
            _spread([stroke.pauses for stroke in strokes], best=min),
            _spread([stroke.pause_s for stroke in strokes], best=min),
        )


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

    @property
    def forearm_moved(self) -> bool:
        """Whether the wrist's centre left the ball it must stay in."""
        return self.forearm_mm > STILL_RADIUS_MM


@dataclass(frozen=True, slots=True)
class ReportCurves:
    """Angles over the session as they are drawn: ``time_s`` (N,) after the first frame, the rest (N, 3)."""

    time_s: FloatArray
    angles_deg: FloatArray
    sds_deg: FloatArray
    status: FloatArray


@dataclass(frozen=True, slots=True)
class SessionFigures:
    """One session in figures. ``trick_deg`` (3,) largest other angles, NaN for the trained one and without a limit."""

    session_id: str
    subject_id: str
    when: datetime
    side: Side
    protocol: str
    exercise: Exercise
    duration_s: float
    complete: bool
    recovered: bool
    smoothed: bool
    software_version: str
    start_angles_deg: FloatArray
    repetitions: tuple[ShownRepetition, ...]
    rows: tuple[RangeRow, ...]
    trick_deg: FloatArray
    peak_speed: StrokeSpread
    smoothness: StrokeSpread
    quality: Quality
    pain: tuple[int, ...]
    notes: tuple[tuple[float, str], ...]
    joint_rows: tuple[RangeRow, ...] = ()
    """Of the whole hand: arc, most bent and least bent of every joint, and the TAM of every finger."""
    findings: tuple[CalibrationFinding, ...] = ()
    """What was doubtful at the calibration, and measured all the same."""
    simulated: bool = False
    """Whether a simulated hand was measured: nobody's movement."""
    not_counted: bool = False
    """Whether a person decided that the session shall not count."""
    targets_deg: tuple[float, float] = (math.nan, math.nan)
    """Targets of the trained angle, of its positive and its negative direction, signed; NaN for none."""
    pain_s: tuple[float, ...] = ()
    """When each of ``pain`` was said, after the first frame."""
    further: tuple[FurtherMeasure, ...] = ()
    """Reaches, finger tips, moving together, tremor: what the exercise has beside its ranges."""
    grades: tuple[GradedTotal, ...] = ()
    speed: SpeedFigures | None = None
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
    passive: SessionFigures | None = None
    """The same of the repetitions in which somebody else moved the hand; None without any. Never in the others."""
    without_passive: bool = False
    """Whether ranges over the whole recording leave out stretches in which somebody else moved the hand."""

    @property
    def study(self) -> RetestStudy | None:
        """The clinic's own test and retest of such sessions, None where the default limits hold."""
        return self.error_limits.study(self.protocol, self.exercise.id, self.angle_order)

    @property
    def counted(self) -> int:
        """Repetitions that count."""
        return sum(repetition.counts for repetition in self.repetitions)

    def row(self, movement: Movement, angle: int, joint: str = "") -> RangeRow | None:
        """The row of one movement of one angle of the wrist, or of a joint (``angle`` is -1 then)."""
        rows = self.joint_rows if joint else self.rows
        return next((row for row in rows if row.key == (joint, movement, angle)), None)


@dataclass(frozen=True, slots=True)
class Comparison:
    """One movement in two sessions; ``difference_deg`` after - before of the means, against ``limit_deg``."""

    movement: Movement
    angle: int
    before_deg: float
    after_deg: float
    difference_deg: float
    limit_deg: float
    verdict: Verdict
    joint: str = ""
    limited: tuple[bool, bool] = (False, False)
    """Whether the figure before and the one after are lower bounds, since the joint was hidden in part."""
    reasons: tuple[Unfairness, ...] = ()
    """Why the two are not judged; empty when they are."""

    @property
    def at_least(self) -> bool:
        """Whether the gain is a lower bound."""
        return self.limited == (False, True)

    @property
    def shown_difference_deg(self) -> float:
        """Difference of the rounded means, so that the figures on a page agree with each other."""
        if not math.isfinite(self.difference_deg):
            return math.nan
        return float(math.floor(self.after_deg + 0.5) - math.floor(self.before_deg + 0.5))


@dataclass(frozen=True, slots=True)
class ProgressPoint:
    """One session on the way; not ``fair`` means that it is shown but not compared, for ``reasons``."""

    figures: SessionFigures
    reasons: tuple[Unfairness, ...]

    @property
    def fair(self) -> bool:
        """Whether it compares with the first session."""
        return not self.reasons


@dataclass(frozen=True, slots=True)
class Progress:
    """Sessions of one hand and exercise in order of time; first and last fair ones compared, arc first.

    ``keys`` what of the whole hand is followed, of any session; empty for the wrist. ``replaced`` earlier results of
    recordings that were tracked again: a recording counts once, by its newest result.
    """

    points: tuple[ProgressPoint, ...]
    comparisons: tuple[Comparison, ...]
    other_hand: SessionFigures | None
    keys: tuple[RowKey, ...] = ()
    replaced: tuple[SessionFigures, ...] = ()
    by_hand: tuple[HandValue, ...] = ()
    """What counts of what was measured by hand, of this hand and of the person, by day; beside ours, never in it."""

    @property
    def earlier_results(self) -> int:
        """How many earlier results of the same recordings there are, read or not."""
        return max(len(self.replaced), sum(point.figures.earlier_results for point in self.points))

    @property
    def first(self) -> SessionFigures | None:
        """The session compared with: the first that is fair in itself, else the first of all."""
        chosen = next((point for point in self.points if point.fair), self.points[0] if self.points else None)
        return chosen.figures if chosen is not None else None

    @property
    def last(self) -> SessionFigures | None:
        """The last one that compares."""
        fair = [point.figures for point in self.points if point.fair]
        return fair[-1] if fair else None

    @property
    def study(self) -> RetestStudy | None:
        """The clinic's own test and retest by which changes are judged, None for the default limits."""
        return self.last.study if self.last is not None else None

    @property
    def headline(self) -> Comparison | None:
        """The comparison that answers the question: of the trained arc, or the largest change beyond error."""
        beyond = [item for item in self.comparisons if item.verdict in ("improved", "worse")]
        arcs = [item for item in self.comparisons if item.movement == "arc"]
        best: list[Comparison | None] = [*(item for item in arcs if item in beyond), *beyond, *arcs, None]
        return best[0]


def session_curves(session: Session) -> ReportCurves:
    """Angles ready to draw."""
    motion = best_motion(session)
    time_s = session.timestamp_s - session.timestamp_s[0] if len(session) else np.empty(0)
    return ReportCurves(
        time_s, np.degrees(motion.angles_rad), np.degrees(motion.angles_sd_rad), np.asarray(session.status)
    )


def session_figures(
    session: Session, choices: RepetitionChoices | None = None, error_limits: ErrorLimits = DEFAULT_LIMITS
) -> SessionFigures:
    """All figures of one session, with a person's corrections to its repetitions."""
    choices = choices or RepetitionChoices()
    exercise = exercise_named(session.header.exercise)
    motion, looked_back = best_motion(session), session.smoothed is not None
    curves = session_curves(session)
    view = seen_well(session)
    signals = wrist_signals(session, view)
    centre = wrist_centre(motion.position_m, rotation_in_place(motion.rotation_w2_w0, motion.w0_turn_rad), view)
    tracks = joint_tracks(session)
    trained = trained_angle(exercise, signals, tracks, session)
    found = trained.found if trained is not None else FoundRepetitions((), ())
    measured = measured_repetitions(trained, choices) if trained is not None else ()
    repetitions = _shown(measured)
    counted = tuple(one.window for one in measured if one.row.counted)
    own = _by_itself(session, measured)
    own_view, own_signals, own_tracks = view, signals, tracks
    if own is not session:
        own_view, own_tracks = seen_well(own), joint_tracks(own)
        own_signals = wrist_signals(own, own_view)
    angles: tuple[int, ...] = FREE_ORDER if exercise.angle is None else (exercise.angle,)
    all_left_out = not counted and any(one.is_whole for one in repetitions)
    if all_left_out:
        angles = ()  # all were left out: nothing is measured, least of all the whole recording
    of_all = signals if counted else own_signals
    rows = [row for k in angles for row in _rows(k, of_all[k], counted, looked_back)]
    shown_joints = () if all_left_out else joint_rows(tracks if counted else own_tracks, counted, exercise)
    shaken = held_tremor(own, 1 if exercise.angle is None else exercise.angle, TREMOR_NOISE_RAD)
    further = (*further_measures(own, exercise, own_tracks, own_view), *([shaken] if shaken is not None else []))
    strokes = [stroke for one in measured if one.row.counted for stroke in one.strokes if not stroke.stroke.half]
    uncounted = what_was_not_counted(trained.seen, found) if trained is not None else None
    verdict = session.calibration.verdict
    pains = [event for event in session.events if event.kind == "pain" and event.text.isdigit()]
    start_s = float(session.timestamp_s[0]) if len(session) else math.nan
    return SessionFigures(
        session_id=session.header.session_id,
        subject_id=session.header.subject_id,
        when=session.header.when,
        side=session.header.hand,
        protocol=session.header.protocol.name,
        exercise=exercise,
        duration_s=float(curves.time_s[-1]) if len(curves.time_s) else 0.0,
        complete=session.complete,
        recovered=bool(session.recovered),
        smoothed=session.smoothed is not None,
        software_version=session.header.software_version,
        start_angles_deg=np.degrees(session.calibration.start_angles_rad),
        repetitions=repetitions,
        rows=tuple(rows),
        trick_deg=_tricks(own_signals, exercise),
        peak_speed=_spread(
            [math.degrees(stroke.peak_speed_rad_s) for stroke in strokes],
            [math.degrees(stroke.peak_speed_sd_rad_s) for stroke in strokes],
        ),
        smoothness=_spread([stroke.sparc for stroke in strokes]),
        speed=SpeedFigures.of(strokes),
        uncounted="nothing_seen" if exercise.counts and trained is None and _trains(exercise, tracks) else uncounted,
        unseen_s=sum(end - start for start, end in found.unseen_s),
        quality=Quality(
            frames=len(session),
            measured_share=float(np.mean(session.status == TrackStatus.TRACKED)) if len(session) else math.nan,
            hidden_share=_hidden_share(
                session, curves.time_s, [one for one in repetitions if one.counts] if tracks else ()
            ),
            dropped=int(np.maximum(session.quality.dropped_before, 0).sum()),
            forearm_mm=_forearm_mm(curves.time_s, centre),
            centre_mm=tuple((1e3 * centre.centre_w2_m).tolist()),
            centre_residual_mm=1e3 * centre.residual_m,
            angle_sd_deg=_typical_joint_sd(tracks) if tracks else _typical_sd(curves, exercise),
            tilt_deg=verdict.tilt_deg,
            distance_m=verdict.distance_m,
            residual_mm=float(np.nanmax(verdict.residual_mm)) if np.isfinite(verdict.residual_mm).any() else math.nan,
        ),
        pain=tuple(int(event.text) for event in pains),
        pain_s=tuple(event.time_s - start_s for event in pains),
        notes=tuple(
            (event.time_s - start_s, event.text)
            for event in session.events
            if event.kind == "note" and event.text and len(session)
        ),
        joint_rows=shown_joints,
        further=further,
        grades=graded_totals(shown_joints, exercise),
        findings=verdict.findings,
        simulated=session.header.simulated,
        not_counted=choices.not_counted,
        targets_deg=session.header.targets_deg,
        recording_id=session.header.recording_id,
        created=datetime.fromisoformat(session.header.created),
        angle_order=session.angle_order,
        error_limits=error_limits,
        camera=camera_said(session.header.parameters),
        corrected=corrected_from(session),
        passive=_of_passive(session, choices, measured, error_limits),
        without_passive=not counted and own is not session,
    )


def _by_itself(session: Session, measured: Sequence[Measured]) -> Session:
    """A session in which nothing was seen while somebody else moved the hand: what is measured over all of it."""
    time_s = session.timestamp_s - session.timestamp_s[:1]
    helped = np.zeros(len(time_s), dtype=bool)
    for start_s, end_s in passive_stretches(session):
        helped |= (start_s <= time_s) & (time_s < end_s)
    for one in sorted(measured, key=lambda one: one.row.counted):  # what counts has the last word
        if one.row.counted or one.left_out == PASSIVE:
            helped[(one.window.start_s <= time_s) & (time_s <= one.window.end_s)] = not one.row.counted
    if not helped.any():
        return session
    motion, smoothed = (
        one if one is None else replace(one, joint_angles_rad=np.where(helped[:, None], math.nan, one.joint_angles_rad))
        for one in (session.motion, session.smoothed)
    )
    status = np.where(helped, TrackStatus.LOST, session.status)
    return replace(session, status=status, motion=motion or session.motion, smoothed=smoothed)


def _of_passive(
    session: Session, choices: RepetitionChoices, measured: Sequence[Measured], error_limits: ErrorLimits
) -> SessionFigures | None:
    """The figures of what was helped alone: all else is left out of them."""
    if not any(one.left_out == PASSIVE and not one.unmeasured for one in measured):
        return None
    others = {n: "" if one.left_out == PASSIVE else one.left_out or ACTIVE for n, one in enumerate(measured)}
    return session_figures(session, replace(choices, left_out=others), error_limits)


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


def compare(before: SessionFigures, after: SessionFigures) -> tuple[Comparison, ...]:
    """Means of the movements that both sessions have, arc first; nothing is a change within measurement error."""
    return compare_rows(before, after, after.rows)


def compare_rows(before: SessionFigures, after: SessionFigures, rows: Sequence[RangeRow]) -> tuple[Comparison, ...]:
    """As :func:`compare`, of some rows of the later session. A hidden joint is not judged, but for a sure gain.

    Sessions that the progress leaves out are not judged here either: there is one judgement, wherever it is shown.
    """
    unfair = tuple(dict.fromkeys((*unfair_reasons(before, before), *unfair_reasons(before, after))))
    study = after.study
    out = []
    for row in rows:
        other = before.row(row.movement, row.angle, row.joint)
        if other is None:
            continue
        name = TOTAL_ACTIVE_MOTION if is_total(row.joint) else row.joint or WRIST_ANGLES[row.angle]
        change = change_between(_mean(before, other), _mean(after, row), name)
        factor = ARC_LIMIT_FACTOR if row.movement == "arc" and not is_total(row.joint) else 1.0
        own = study.limit_deg(row.joint or name, row.movement) if study is not None else None
        limit = math.degrees(change.limit_rad) * factor if own is None else own
        difference = row.mean_deg - other.mean_deg
        verdict: Verdict = "not_judged"
        limited = (other.limited, row.limited) if row.joint else (False, False)
        # A lower bound that lies beyond the error above a figure fully seen is a gain; nothing else is known of it.
        sure_gain = row.movement == "arc" and limited == (False, True) and difference > limit
        reasons: tuple[Unfairness, ...] = tuple(dict.fromkeys((*unfair, *change.obstacles)))
        if not reasons and any(limited) and not sure_gain:
            reasons = ("hidden",)
        if not reasons:
            beyond = abs(difference) > limit
            better = difference > 0 if row.joint == "" or row.movement != "extension" else difference < 0
            verdict = "no_change" if not beyond else "improved" if better else "worse"
        out.append(
            Comparison(
                row.movement,
                row.angle,
                other.mean_deg,
                row.mean_deg,
                difference,
                limit,
                verdict,
                row.joint,
                limited,
                reasons,
            )
        )
    return tuple(out)


def unfair_reasons(first: SessionFigures, other: SessionFigures) -> tuple[Unfairness, ...]:
    """Why a session does not compare with the first one; with itself: why it compares with none."""
    reasons: list[Unfairness] = []
    if other.simulated != first.simulated:
        reasons.append("simulated")
    if other.angle_order != first.angle_order:
        reasons.append("angle_order")
    if any(finding.kind in NAMES_DOUBTED for finding in other.findings):
        reasons.append("doubtful")
    if other.not_counted:
        reasons.append("not_counted")
    if abs(first.quality.distance_m - other.quality.distance_m) > LARGEST_DISTANCE_STEP_M:
        reasons.append("distance")
    if float(np.abs(first.start_angles_deg - other.start_angles_deg).max()) > LARGEST_START_ANGLE_STEP_DEG:
        reasons.append("start_angle")
    if other.exercise.pure_wrist and other.quality.forearm_moved:
        reasons.append("forearm_moved")
    if not other.complete and not other.recovered:
        reasons.append("incomplete")
    if other.passive is not None and not other.counted:
        reasons.append("only_passive")
    elif 0 < other.counted < FEWEST_FOR_SPREAD or (other.exercise.counts and not other.counted):
        reasons.append("few_repetitions_after")
    return tuple(reasons)


def progress(
    sessions: Sequence[SessionFigures], other_hand: SessionFigures | None = None, keys: Sequence[RowKey] = ()
) -> Progress:
    """Sessions of one hand, protocol and exercise over time, compared with the first one that is fair in itself.

    ``keys`` choose what of the whole hand is followed; without them it is the wrist.
    """
    ordered = newest_results(sessions)
    real = [figures for figures in ordered if not figures.simulated]
    first = next((figures for figures in real or ordered if not unfair_reasons(figures, figures)), None)
    points = tuple(ProgressPoint(figures, unfair_reasons(first or figures, figures)) for figures in ordered)
    fair = [point.figures for point in points if point.fair]
    comparisons: tuple[Comparison, ...] = ()
    if len(fair) > 1:
        wanted = [row for key in keys for row in fair[-1].joint_rows if row.key == key]
        comparisons = compare_rows(fair[0], fair[-1], wanted if keys else fair[-1].rows)
    replaced = tuple(figures for figures in sessions if all(figures is not kept for kept in ordered))
    return Progress(points, comparisons, other_hand, tuple(keys), replaced)


def newest_results(sessions: Sequence[SessionFigures]) -> list[SessionFigures]:
    """Of every recording its newest result, in order of when the hand moved."""
    newest: dict[str, SessionFigures] = {}
    for figures in sorted(sessions, key=lambda figures: figures.created or figures.when):
        newest[figures.recording_id or figures.session_id] = figures
    return sorted(newest.values(), key=lambda figures: figures.when)


def previous_of(history: Sequence[SessionFigures], figures: SessionFigures) -> SessionFigures | None:
    """The last earlier session of the same hand, protocol and exercise that counts."""
    alike = [other for other in newest_results(history) if _alike(other, figures) and other.side == figures.side]
    return max((other for other in alike if other.when < figures.when), key=lambda other: other.when, default=None)


def limits_of(history: Sequence[SessionFigures]) -> ErrorLimits:
    """Against which the figures of a patient are judged; of nobody the default ones."""
    return history[0].error_limits if history else DEFAULT_LIMITS


def other_hand_of(history: Sequence[SessionFigures], figures: SessionFigures) -> SessionFigures | None:
    """The last session of the other hand in the same protocol and exercise."""
    alike = [other for other in newest_results(history) if _alike(other, figures) and other.side != figures.side]
    return max(alike, key=lambda other: other.when, default=None)


def _alike(one: SessionFigures, other: SessionFigures) -> bool:
    same_kind = (one.exercise.id, one.protocol, one.simulated) == (other.exercise.id, other.protocol, other.simulated)
    return same_kind and bool(one.rows or one.joint_rows) and not one.not_counted and not _same_recording(one, other)


def _same_recording(one: SessionFigures, other: SessionFigures) -> bool:
    return bool(one.recording_id) and one.recording_id == other.recording_id


def _shown(measured: Sequence[Measured]) -> tuple[ShownRepetition, ...]:
    return tuple(
        ShownRepetition(
            one.row.start_s if math.isfinite(one.row.start_s) else one.window.start_s,
            one.row.end_s if math.isfinite(one.row.end_s) else one.window.end_s,
            one.left_out,
            one.unmeasured,
            one.row,
        )
        for one in measured
    )


def _trains(exercise: Exercise, tracks: Mapping[str, JointTrack]) -> bool:
    """Whether the angle that an exercise trains is one of this session's."""
    return exercise.angle is not None or exercise.joint in tracks


def _rows(angle: int, signal: Signal, counted: tuple[Repetition, ...], looked_back: bool) -> list[RangeRow]:
    """Arc, positive and negative direction of one angle. A direction that was never reached is below zero: by so much
    the other one does not come back to neutral (a deficit). Without repetitions it is left out."""
    if not len(signal.time_s):
        return []
    smooth = low_pass(signal, HIGHEST_CUTOFF_HZ)
    measured: MotionRange = motion_range(smooth.column(0), signal.column(1), counted, smoothed=looked_back)
    positive, negative = SIDES[angle]
    turned = replace(measured.minimum, values=-measured.minimum.values, best=-measured.minimum.best)
    rows = [
        range_row("arc", angle, measured.arc, measured.top_limited or measured.bottom_limited),
        range_row(positive, angle, measured.maximum, measured.top_limited),
        range_row(negative, angle, turned, measured.bottom_limited),
    ]
    least = -math.inf if counted else 0.0
    return [row for row in rows if row.count and (row.movement == "arc" or row.mean_deg > least)]


def _spread(
    values: Sequence[float], sds: Sequence[float] = (), best: Callable[[Sequence[float]], float] | None = max
) -> StrokeSpread:
    known = np.array([value for value in values if math.isfinite(value)])
    if not len(known):
        return StrokeSpread(math.nan, math.nan, math.nan, 0)
    stated = np.array([sd for value, sd in zip(values, sds, strict=False) if math.isfinite(value + sd)])
    sd = float(known.std(ddof=1)) if len(known) >= FEWEST_FOR_SPREAD else math.nan
    measurement_sd = float(np.sqrt(np.mean(stated**2))) if len(stated) else math.nan
    the_best = math.nan if best is None else float(best(known.tolist()))
    return StrokeSpread(float(known.mean()), sd, the_best, len(known), measurement_sd)


def _hidden_share(session: Session, time_s: FloatArray, within: Sequence[ShownRepetition]) -> float:
    """Share of all looks at markers in which one was hidden, within repetitions if any: rest hides none."""
    inside = np.ones(len(time_s), dtype=bool)
    if within:
        inside = np.any([(time_s >= rep.start_s) & (time_s <= rep.end_s) for rep in within], axis=0)
    seen = np.isfinite(session.markers.measured_px[inside, :, 0])
    return float(np.mean(~seen)) if seen.size else math.nan


def _tricks(signals: Sequence[Signal], exercise: Exercise) -> FloatArray:
    out = np.full(3, math.nan)
    if math.isfinite(exercise.trick_limit_deg):
        for k in range(3):
            if k != exercise.angle and len(signals[k].time_s):
                value = low_pass(signals[k].column(0)).value
                if np.isfinite(value).any():
                    out[k] = math.degrees(float(np.nanmax(np.abs(value))))
    return out


def _forearm_mm(time_s: FloatArray, centre: WristCentre) -> float:
    """How far the forearm went: what the centre of the wrist's turning moved, without a frame's noise."""
    known = np.isfinite(centre.moved_m)
    if int(known.sum()) < 2:
        return math.nan
    moved = low_pass(even_signal(time_s, centre.moved_m, known), STILLNESS_CUTOFF_HZ).value
    return 1000.0 * float(np.nanmax(moved)) if np.isfinite(moved).any() else math.nan


def _typical_sd(curves: ReportCurves, exercise: Exercise) -> float:
    columns = curves.sds_deg if exercise.angle is None else curves.sds_deg[:, [exercise.angle]]
    known = columns[(curves.status == TrackStatus.TRACKED)[:, None] & np.isfinite(columns)]
    return float(np.median(known)) if known.size else math.nan


def _typical_joint_sd(tracks: Mapping[str, JointTrack]) -> float:
    known = [track.seen_sd.value[track.seen_sd.finite] for track in tracks.values() if track.known]
    return math.degrees(float(np.median(np.concatenate(known)))) if known else math.nan


def _mean(figures: SessionFigures, row: RangeRow) -> MeasuredMean:
    """A session without repetitions (free movement) has one range; it is never judged."""
    count = row.count if figures.counted else 0
    return MeasuredMean(math.radians(row.mean_deg), count, figures.side, figures.protocol, figures.exercise.id)
