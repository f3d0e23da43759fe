"""Repetitions of a session and what each measures: the same for file, review, report and exports.

A person's choices come on top and are not part of the file.
"""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from statistics import fmean
from typing import Literal

import numpy as np

from carpus.core.measures.motion_range import MIN_VALID_SHARE, MotionRange, joint_range, motion_range
from carpus.core.measures.noise import MAX_CUTOFF_HZ
from carpus.core.measures.repetitions import (
    COUNTING_CUTOFF_HZ,
    CutReason,
    Repetition,
    RepetitionAnalysis,
    Stroke,
    find_repetitions,
)
from carpus.core.measures.signals import Signal, find_runs, low_pass
from carpus.core.measures.speed import TURNING_BAND_SHARE, StrokeMeasures, measure_stroke
from carpus.core.model.hand.exercises import PRONOSUPINATION, get_exercise
from carpus.core.model.hand.forearm_rotation import pronosupination_from_palm_down
from carpus.core.model.hand.protocols import WRIST_ANGLES
from carpus.core.model.types import TrackStatus
from carpus.core.results.valid_data import MeasurableSession
from carpus.core.session.values import RepetitionRow, Repetitions, Session

HOLD_SHARE = 0.98
"""Share of the excursion beyond which the hand holds the peak; within a hold the maximum is noise."""
UnmeasuredReason = Literal["", "hidden"] | CutReason
HIDDEN: UnmeasuredReason = "hidden"
"""Reason of a repetition that was not seen well enough to be measured."""
PASSIVE = "passive"
"""Reason of a repetition in which somebody else moved the hand; also the event that starts that."""
ACTIVE = "active"
"""Event from which the hand moves by itself again."""


@dataclass(frozen=True, slots=True)
class RepetitionChoices:
    """A person's corrections, by the number of the repetition (from 0).

    ``excluded``: reasons in words, :data:`PASSIVE` if the hand was moved, empty to include it. ``edges_s``: start and
    end after the first frame. ``is_session_excluded``: the session is shown but not compared.
    """

    excluded: Mapping[int, str] = field(default_factory=dict)
    edges_s: Mapping[int, tuple[float, float]] = field(default_factory=dict)
    is_session_excluded: bool = False
    session_exclusion_reason: str = ""


@dataclass(frozen=True, slots=True)
class TrainedAngle:
    """Trained angle of a session in rad, times after the first frame.

    ``detected``: its repetitions; ``measured`` and its sd: where it may be measured; ``tracked``: where repetitions are
    counted; ``measure_range`` measures some of them.
    """

    name: str
    detected: RepetitionAnalysis
    measured: Signal
    measured_sd: Signal
    tracked: Signal
    is_smoothed: bool
    measure_range: Callable[[Sequence[Repetition]], MotionRange]
    is_from_thumb_up: bool = False
    """It is clinical supination; rows count from palm down, as files do."""
    passive_s: tuple[tuple[float, float], ...] = ()
    """Stretches during which somebody else moved the hand."""
    counting_signal: Signal = field(init=False, repr=False, compare=False)
    """``tracked``, low-pass filtered as for counting."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "counting_signal", low_pass(self.tracked, COUNTING_CUTOFF_HZ))


@dataclass(frozen=True, slots=True)
class RepetitionResult:
    """One repetition, in seconds after the first frame.

    It lasts from leaving the first turning point to reaching the last; ``window`` is that of its range, with holds.
    ``unmeasured_reason``: too little was seen, or it was cut; ``exclusion_reason``: why a person excluded it, empty if
    it is included; ``has_chosen_edges``: a person moved its start or end.
    """

    start_s: float
    end_s: float
    window: Repetition
    row: RepetitionRow
    unmeasured_reason: UnmeasuredReason = ""
    exclusion_reason: str = ""
    strokes: tuple[StrokeMeasures, ...] = ()
    has_chosen_edges: bool = False

    @property
    def is_passive(self) -> bool:
        """True if somebody else moved the hand."""
        return self.exclusion_reason == PASSIVE and not self.unmeasured_reason

    @property
    def is_counted(self) -> bool:
        """True if the results include it."""
        return not self.exclusion_reason and not self.unmeasured_reason

    @property
    def is_whole(self) -> bool:
        """True if the recording has all of it, seen or not."""
        return self.unmeasured_reason in ("", HIDDEN)


def compute_repetitions(session: Session) -> Repetitions:
    """Compute the content of ``/repetitions``, on the clock of the frames."""
    trained = find_trained_angle(
        MeasurableSession.from_session(session, (get_exercise(session.header.exercise).joint,))
    )
    if trained is None:
        return Repetitions("", ())
    start_s = float(session.timestamp_s[0])
    rows = (one.row for one in measure_repetitions(trained, RepetitionChoices()))
    return Repetitions(trained.name, tuple(with_time_offset(row, start_s) for row in rows))


def trained_angle_name(session: Session) -> str:
    """Return the name of the trained angle in files, empty if there is none."""
    exercise = get_exercise(session.header.exercise)
    if exercise.joint in session.header.joint_names:
        return exercise.joint
    return "" if exercise.angle is None else WRIST_ANGLES[exercise.angle]


def with_time_offset(row: RepetitionRow, start_s: float) -> RepetitionRow:
    """Return a row with its times moved by ``start_s``."""
    return replace(row, start_s=row.start_s + start_s, peak_s=row.peak_s + start_s, end_s=row.end_s + start_s)


def find_trained_angle(seen: MeasurableSession) -> TrainedAngle | None:
    """Return the trained angle, None if there is none or it was never seen."""
    exercise, is_smoothed, passive_s = seen.exercise, seen.session.smoothed is not None, passive_stretches(seen.session)
    track = seen.tracks.get(exercise.joint)
    if track is not None and track.is_known:
        return TrainedAngle(
            exercise.joint,
            find_repetitions(track.tracked),
            track.visible,
            track.visible_sd,
            track.tracked,
            is_smoothed,
            lambda some: joint_range(track, some),
            passive_s=passive_s,
        )
    if exercise.angle is None or not len(seen.signals[exercise.angle].time_s):
        return None
    signal = seen.signals[exercise.angle]
    angle, smooth = signal.column(0), low_pass(signal, MAX_CUTOFF_HZ).column(0)
    return TrainedAngle(
        WRIST_ANGLES[exercise.angle], find_repetitions(angle), angle, signal.column(1), angle, is_smoothed,
        lambda some: motion_range(smooth, signal.column(1), tuple(some), smoothed=is_smoothed),
        exercise.angle == PRONOSUPINATION, passive_s,
    )  # fmt: skip


def passive_stretches(session: Session) -> tuple[tuple[float, float], ...]:
    """Return start and end of stretches in which somebody else moved the hand, after the first frame."""
    start_s = float(session.timestamp_s[0]) if len(session) else 0.0
    changes = [(one.time_s - start_s, one.kind) for one in session.events if one.kind in (PASSIVE, ACTIVE)]
    ends = [*(time_s for time_s, _ in changes[1:]), math.inf]
    return tuple((time_s, end_s) for (time_s, kind), end_s in zip(changes, ends, strict=False) if kind == PASSIVE)


def mask_passive(session: Session, measured: Sequence[RepetitionResult]) -> Session:
    """Return the session with the passive stretches marked as lost."""
    time_s = session.timestamp_s - session.timestamp_s[:1]
    is_passive = np.zeros(len(time_s), dtype=bool)
    for start_s, end_s in passive_stretches(session):
        is_passive |= (start_s <= time_s) & (time_s < end_s)
    for one in sorted(measured, key=lambda one: one.row.counted):  # what counts has the last word
        if one.row.counted or one.exclusion_reason == PASSIVE:
            is_passive[(one.window.start_s <= time_s) & (time_s <= one.window.end_s)] = not one.row.counted
    if not is_passive.any():
        return session
    motion, smoothed = (
        one
        if one is None
        else replace(one, joint_angles_rad=np.where(is_passive[:, None], math.nan, one.joint_angles_rad))
        for one in (session.motion, session.smoothed)
    )
    status = np.where(is_passive, TrackStatus.LOST, session.status)
    return replace(session, status=status, motion=motion or session.motion, smoothed=smoothed)


def measure_repetitions(trained: TrainedAngle, choices: RepetitionChoices) -> tuple[RepetitionResult, ...]:
    """Measure every repetition, included or not."""
    strokes = [
        measure_stroke(trained.measured, stroke, trained.measured_sd, smoothed=trained.is_smoothed)
        for stroke in trained.detected.strokes
    ]

    def is_passive(rep: Repetition) -> bool:
        middle_s = 0.5 * (rep.start_s + rep.end_s)
        return any(start_s <= middle_s < end_s for start_s, end_s in trained.passive_s)

    every = sorted((*trained.detected.repetitions, *trained.detected.partial_repetitions), key=lambda rep: rep.start_s)
    return tuple(
        _measure_repetition(
            trained,
            rep,
            strokes,
            choices.edges_s.get(number),
            choices.excluded.get(number, PASSIVE if is_passive(rep) else ""),
        )
        for number, rep in enumerate(every)
    )


def _measure_repetition(
    trained: TrainedAngle,
    rep: Repetition,
    strokes: Sequence[StrokeMeasures],
    edges_s: tuple[float, float] | None,
    exclusion_reason: str,
) -> RepetitionResult:
    window = rep if edges_s is None else _with_edges(trained, rep, *edges_s)
    # Motion cut in the middle is cut within strokes: each belongs where it ends, unless a person cut there.
    first = bisect_left(strokes, window.start_s, key=lambda one: one.stroke.end_s)
    beside = strokes[first : bisect_right(strokes, window.end_s, key=lambda one: one.stroke.start_s)]
    ends_s = [one.stroke.end_s if edges_s is None else 0.5 * (one.stroke.start_s + one.stroke.end_s) for one in beside]
    own = tuple(one for one, end_s in zip(beside, ends_s, strict=True) if window.start_s < end_s <= window.end_s)
    start_s, end_s = edges_s or _onset_and_offset_s(trained.counting_signal, rep, own)
    turns_high = own[0].stroke.is_rising if own and edges_s is None else None
    peak_s, is_high = _find_peak(trained.counting_signal, window, turns_high, is_chosen=edges_s is not None)
    measured = trained.measure_range((window,))
    known = measured.repetitions == 1 and len(measured.arc.values) == 1 and not window.cut
    whole = () if window.cut else own
    # Half a way from rest is slower, and small beside its noise: it says nothing of how quick or smooth the hand is.
    full = [one for one in whole if not one.stroke.is_half]
    why: UnmeasuredReason = window.cut or (HIDDEN if window.valid_share < MIN_VALID_SHARE else "")
    turned = (measured.maximum if is_high else measured.minimum).values
    if trained.is_from_thumb_up:
        turned = pronosupination_from_palm_down(turned)
    row = RepetitionRow(
        start_s=start_s,
        peak_s=peak_s,
        end_s=end_s,
        angle_rad=float(turned[0]) if known else math.nan,
        arc_rad=float(measured.arc.values[0]) if known else math.nan,
        arc_sd_rad=measured.arc.measurement_sd if known else math.nan,
        peak_speed_rad_s=_combine_strokes(full, "peak_speed_rad_s", max),
        peak_speed_sd_rad_s=_combine_strokes(full, "peak_speed_sd_rad_s", max),
        movement_time_s=_movement_time_s(window, beside) if whole else math.nan,
        sparc=_combine_strokes(full, "sparc", fmean),
        movement_units=_combine_strokes(whole, "peaks", math.fsum),
        pauses=_combine_strokes(whole, "pauses", math.fsum),
        pause_s=_combine_strokes(whole, "pause_s", math.fsum),
        at_least=known and (measured.top_limited or measured.bottom_limited),
        counted=not exclusion_reason and not why,
        reason=exclusion_reason or why,
    )
    first_s = start_s if math.isfinite(start_s) else window.start_s
    last_s = end_s if math.isfinite(end_s) else window.end_s
    return RepetitionResult(first_s, last_s, window, row, why, exclusion_reason, own, edges_s is not None)


def _with_edges(trained: TrainedAngle, rep: Repetition, start_s: float, end_s: float) -> Repetition:
    """Return a repetition with edges chosen by a person; it is whole if they exclude the cut."""
    part = trained.tracked.crop(start_s, end_s).is_finite
    one = Repetition(start_s, end_s, float(part.mean()) if len(part) else 0.0)
    return replace(one, cut=rep.cut, cut_s=rep.cut_s) if start_s <= rep.cut_s <= end_s else one


def _movement_time_s(window: Repetition, strokes: Sequence[StrokeMeasures]) -> float:
    """Return the time in motion within a repetition, pauses included; NaN if a stroke's is unknown."""
    within = [one for one in strokes if one.stroke.start_s < window.end_s and window.start_s < one.stroke.end_s]
    on_way_s = [min(one.offset_s, window.end_s) - max(one.onset_s, window.start_s) for one in within]
    return math.fsum(max(0.0, time_s) for time_s in on_way_s) if all(map(math.isfinite, on_way_s)) else math.nan


def _onset_and_offset_s(smooth: Signal, rep: Repetition, strokes: Sequence[StrokeMeasures]) -> tuple[float, float]:
    """Return when the first stroke left its turning point and the last reached its own.

    NaN where a gap hides that. A repetition that is cut, or has no turning point there, keeps its own edge.
    """
    start_s, end_s = rep.start_s, rep.end_s
    if strokes and abs(strokes[0].stroke.start_s - start_s) <= 1e-6 and rep.cut_s != start_s:
        first = strokes[0]
        start_s = first.onset_s if first.onset_s >= start_s else _place_edge_s(smooth, first.stroke, is_leaving=True)
    if strokes and abs(strokes[-1].stroke.end_s - end_s) <= 1e-6 and rep.cut_s != end_s:
        last = strokes[-1]
        end_s = last.offset_s if last.offset_s <= end_s else _place_edge_s(smooth, last.stroke, is_leaving=False)
    return start_s, end_s


def _place_edge_s(smooth: Signal, stroke: Stroke, *, is_leaving: bool) -> float:
    """Return when a stroke left or reached its turning point, from the angle alone.

    NaN if the sample beyond that edge was not seen.
    """
    part = smooth.crop(stroke.start_s, stroke.end_s)
    way = stroke.direction * part.value
    if not part.is_finite.any():
        return math.nan
    low, high = float(np.nanmin(way)), float(np.nanmax(way))
    near = TURNING_BAND_SHARE * (high - low)
    edge = int(np.flatnonzero(way >= high - near)[0])
    if is_leaving:
        edge = int(np.flatnonzero(way[: edge + 1] <= low + near)[-1])
    beyond = edge + (1 if is_leaving else -1)
    seen = 0 <= beyond < len(way) and math.isfinite(way[beyond])
    return float(part.time_s[edge]) if seen else math.nan


def _find_peak(smooth: Signal, window: Repetition, turns_high: bool | None, *, is_chosen: bool) -> tuple[float, bool]:
    """Return the time of the peak, the middle of a hold, and whether it is a maximum.

    NaN where a gap, the cut, or an edge of a window that a person has chosen borders on it: the angle may have gone
    further. Without ``turns_high`` the peak is furthest from the start.
    """
    part = smooth.crop(window.start_s, window.end_s)
    known = part.value[part.is_finite]
    if not len(known):
        return math.nan, True
    away = part.value - known[0]
    if turns_high is None:
        turns_high = bool(away[int(np.nanargmax(np.abs(away)))] >= 0.0)
    away = away if turns_high else -away
    at = int(np.nanargmax(away))
    held = next(run for run in find_runs(away >= HOLD_SHARE * away[at]) if run.start <= at < run.stop)
    first_s, last_s = float(part.time_s[held.start]), float(part.time_s[held.stop - 1])
    near_s = 1.5 / part.rate_hz
    cut = min(abs(first_s - window.cut_s), abs(last_s - window.cut_s)) <= near_s
    if is_chosen and (held.start == 0 or held.stop == len(away)):
        return math.nan, turns_high
    if cut or not part.is_finite[max(held.start - 1, 0) : held.stop + 1].all():
        return math.nan, turns_high
    return float(part.time_s[held].mean()), turns_high


def _combine_strokes(
    strokes: Sequence[StrokeMeasures], name: str, combine: Callable[[Sequence[float]], float]
) -> float:
    """Combine a value of all strokes; NaN if one is unknown."""
    values = [getattr(stroke, name) for stroke in strokes]
    return combine(values) if values and all(map(math.isfinite, values)) else math.nan
