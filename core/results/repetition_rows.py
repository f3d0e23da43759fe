"""The repetitions of a session with what each of them measures: the one account that the file, review, report and
every export have. A person's choices (left out, moved) come on top and stay outside of the file."""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from carpus.core.hand.exercises import PRONOSUPINATION, exercise_named
from carpus.core.hand.forearm_rotation import pronosupination_from_palm_down
from carpus.core.hand.protocols import WRIST_ANGLES
from carpus.core.measures.fingers import joint_range
from carpus.core.measures.motion_range import LEAST_VALID_SHARE, MotionRange, motion_range
from carpus.core.measures.noise import HIGHEST_CUTOFF_HZ
from carpus.core.measures.repetitions import (
    COUNTING_CUTOFF_HZ,
    Cut,
    FoundRepetitions,
    Repetition,
    Stroke,
    find_repetitions,
)
from carpus.core.measures.signals import Signal, low_pass, stretches
from carpus.core.measures.speed import PLACE_SHARE, StrokeMeasures, measure_stroke
from carpus.core.results.seen import SeenSession
from carpus.core.session.values import RepetitionRow, Repetitions, Session
from carpus.core.types import TrackStatus

HELD_SHARE = 0.98
"""Of the way out: who stays beyond it holds the peak, and which moment of a hold is the highest only noise says."""
Unmeasured = Literal["", "hidden"] | Cut
HIDDEN: Unmeasured = "hidden"
"""Why a repetition does not count that was not seen well enough to be measured."""
PASSIVE = "passive"
"""Why a repetition counts apart: somebody else moved the hand. Also the event since which that was so."""
ACTIVE = "active"
"""The event since which the hand moved by itself again."""


@dataclass(frozen=True, slots=True)
class RepetitionChoices:
    """A person's corrections, by the number of the repetition as found (from 0).

    ``left_out`` reasons in words, :data:`PASSIVE` for one that was helped, empty for one that counts whatever was said
    while it was measured; ``edges_s`` start and end in seconds after the first frame; ``not_counted``: the
    whole session is shown, and compared with none.
    """

    left_out: Mapping[int, str] = field(default_factory=dict)
    edges_s: Mapping[int, tuple[float, float]] = field(default_factory=dict)
    not_counted: bool = False
    not_counted_reason: str = ""


@dataclass(frozen=True, slots=True)
class Trained:
    """The angle that an exercise trains: ``found`` in it, ``seen`` and its sd where it may be measured, ``tracked``
    where repetitions are counted, ``range_of`` some of them. Times after the first frame, rad."""

    name: str
    found: FoundRepetitions
    seen: Signal
    seen_sd: Signal
    tracked: Signal
    looked_back: bool
    range_of: Callable[[Sequence[Repetition]], MotionRange]
    from_thumb_up: bool = False
    """Whether it is supination as a clinician reads it; rows have it from the palm down, as every file."""
    passive_s: tuple[tuple[float, float], ...] = ()
    """Stretches of which was said, while they were measured, that somebody else moves the hand."""
    smooth: Signal = field(init=False, repr=False, compare=False)
    """What is tracked, as smooth as repetitions are counted in."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "smooth", low_pass(self.tracked, COUNTING_CUTOFF_HZ))


@dataclass(frozen=True, slots=True)
class Measured:
    """One repetition: ``window`` over which its range is measured, holds included, its strokes, and its row with times
    after the first frame; ``unmeasured`` why it cannot count, ``left_out`` why a person does not let it."""

    window: Repetition
    unmeasured: Unmeasured
    strokes: tuple[StrokeMeasures, ...]
    row: RepetitionRow
    left_out: str = ""


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


def repetitions_of(session: Session) -> Repetitions:
    """What ``/repetitions`` of a session holds, on the clock of its frames."""
    trained = trained_angle(SeenSession.of(session, (exercise_named(session.header.exercise).joint,)))
    if trained is None:
        return Repetitions("", ())
    start_s = float(session.timestamp_s[0])
    rows = (one.row for one in measured_repetitions(trained, RepetitionChoices()))
    return Repetitions(trained.name, tuple(on_clock(row, start_s) for row in rows))


def shown_repetitions(measured: Sequence[Measured]) -> tuple[ShownRepetition, ...]:
    """As review and report show them."""
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


def trained_name(session: Session) -> str:
    """Name of the angle whose repetitions are counted, as in every file; empty where none is."""
    exercise = exercise_named(session.header.exercise)
    if exercise.joint in session.header.joint_names:
        return exercise.joint
    return "" if exercise.angle is None else WRIST_ANGLES[exercise.angle]


def on_clock(row: RepetitionRow, start_s: float) -> RepetitionRow:
    """A row whose times count from the first frame, on the clock on which that was at ``start_s``."""
    return replace(row, start_s=row.start_s + start_s, peak_s=row.peak_s + start_s, end_s=row.end_s + start_s)


def trained_angle(seen: SeenSession) -> Trained | None:
    """None where no angle is trained, or nothing was seen of it."""
    exercise, looked_back, passive_s = seen.exercise, seen.session.smoothed is not None, passive_stretches(seen.session)
    track = seen.tracks.get(exercise.joint)
    if track is not None and track.known:
        return Trained(
            exercise.joint, find_repetitions(track.tracked), track.seen, track.seen_sd, track.tracked, looked_back,
            lambda some: joint_range(track, some), passive_s=passive_s,
        )  # fmt: skip
    if exercise.angle is None or not len(seen.signals[exercise.angle].time_s):
        return None
    signal = seen.signals[exercise.angle]
    angle, smooth = signal.column(0), low_pass(signal, HIGHEST_CUTOFF_HZ).column(0)
    return Trained(
        WRIST_ANGLES[exercise.angle], find_repetitions(angle), angle, signal.column(1), angle, looked_back,
        lambda some: motion_range(smooth, signal.column(1), tuple(some), smoothed=looked_back),
        exercise.angle == PRONOSUPINATION, passive_s,
    )  # fmt: skip


def passive_stretches(session: Session) -> tuple[tuple[float, float], ...]:
    """From when to when somebody else moved the hand, as was said while it was measured: seconds after the first
    frame, the last to the end."""
    start_s = float(session.timestamp_s[0]) if len(session) else 0.0
    said = [(one.time_s - start_s, one.kind) for one in session.events if one.kind in (PASSIVE, ACTIVE)]
    ends = [*(time_s for time_s, _ in said[1:]), math.inf]
    return tuple((time_s, end_s) for (time_s, kind), end_s in zip(said, ends, strict=False) if kind == PASSIVE)


def without_passive(session: Session, measured: Sequence[Measured]) -> Session:
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


def measured_repetitions(trained: Trained, choices: RepetitionChoices) -> tuple[Measured, ...]:
    """Every repetition with its measures, counted or not."""
    strokes = [
        measure_stroke(trained.seen, stroke, trained.seen_sd, smoothed=trained.looked_back)
        for stroke in trained.found.strokes
    ]
    every = sorted((*trained.found.repetitions, *trained.found.cut), key=lambda rep: rep.start_s)
    return tuple(
        _measured(trained, rep, strokes, choices.edges_s.get(number), choices.left_out.get(number, _said(trained, rep)))
        for number, rep in enumerate(every)
    )


def _said(trained: Trained, rep: Repetition) -> str:
    """How a repetition was moved as was said while it was measured, by its middle."""
    middle_s = 0.5 * (rep.start_s + rep.end_s)
    return PASSIVE if any(start <= middle_s < end for start, end in trained.passive_s) else ""


def _measured(
    trained: Trained,
    rep: Repetition,
    strokes: Sequence[StrokeMeasures],
    edges_s: tuple[float, float] | None,
    left_out: str,
) -> Measured:
    window = rep if edges_s is None else _moved(trained, rep, *edges_s)
    # Motion cut in the middle is cut within strokes: each belongs where it ends, unless a person cut there.
    belongs_s = _end_s if edges_s is None else _middle_s
    first = bisect_left(strokes, window.start_s, key=_end_s)
    beside = strokes[first : bisect_right(strokes, window.end_s, key=_start_s)]
    own = tuple(one for one in beside if window.start_s < belongs_s(one) <= window.end_s)
    start_s, end_s = edges_s or _left_and_reached(trained.smooth, rep, own)
    turns_high = own[0].stroke.rising if own and edges_s is None else None
    peak_s, is_high = _furthest(trained.smooth, window, turns_high)
    measured = trained.range_of((window,))
    known = measured.repetitions == 1 and len(measured.arc.values) == 1 and not window.cut
    whole = () if window.cut else own
    # Half a way from rest is slower, and small beside its noise: it says nothing of how quick or smooth the hand is.
    full = [one for one in whole if not one.stroke.half]
    why: Unmeasured = window.cut or (HIDDEN if window.valid_share < LEAST_VALID_SHARE else "")
    turned = (measured.maximum if is_high else measured.minimum).values
    if trained.from_thumb_up:
        turned = pronosupination_from_palm_down(turned)
    return Measured(
        window,
        why,
        own,
        RepetitionRow(
            start_s=start_s,
            peak_s=peak_s,
            end_s=end_s,
            angle_rad=float(turned[0]) if known else math.nan,
            arc_rad=float(measured.arc.values[0]) if known else math.nan,
            arc_sd_rad=measured.arc.measurement_sd if known else math.nan,
            peak_speed_rad_s=_over(full, "peak_speed_rad_s", max),
            peak_speed_sd_rad_s=_over(full, "peak_speed_sd_rad_s", max),
            movement_time_s=_moving_s(window, beside) if whole else math.nan,
            sparc=_over(full, "sparc", _mean),
            movement_units=_over(whole, "peaks", math.fsum),
            pauses=_over(whole, "pauses", math.fsum),
            pause_s=_over(whole, "pause_s", math.fsum),
            at_least=known and (measured.top_limited or measured.bottom_limited),
            counted=not left_out and not why,
            reason=left_out or why,
        ),
        left_out,
    )


def _moved(trained: Trained, rep: Repetition, start_s: float, end_s: float) -> Repetition:
    """With edges that a person chose: seen as well as what is between them, and whole where that leaves out the cut."""
    part = trained.tracked.between(start_s, end_s).finite
    one = Repetition(start_s, end_s, float(part.mean()) if len(part) else 0.0)
    return replace(one, cut=rep.cut, cut_s=rep.cut_s) if start_s <= rep.cut_s <= end_s else one


def _moving_s(window: Repetition, strokes: Sequence[StrokeMeasures]) -> float:
    """How long the hand was on its way within a repetition, pauses included; NaN where that of one way is not known."""
    within = [one for one in strokes if one.stroke.start_s < window.end_s and window.start_s < one.stroke.end_s]
    on_way_s = [min(one.offset_s, window.end_s) - max(one.onset_s, window.start_s) for one in within]
    return math.fsum(max(0.0, time_s) for time_s in on_way_s) if all(map(math.isfinite, on_way_s)) else math.nan


def _start_s(stroke: StrokeMeasures) -> float:
    return stroke.stroke.start_s


def _end_s(stroke: StrokeMeasures) -> float:
    return stroke.stroke.end_s


def _middle_s(stroke: StrokeMeasures) -> float:
    return 0.5 * (stroke.stroke.start_s + stroke.stroke.end_s)


def _left_and_reached(smooth: Signal, rep: Repetition, strokes: Sequence[StrokeMeasures]) -> tuple[float, float]:
    """When the first stroke left its turning place and the last reached its own; NaN where a gap hides that. Where
    the repetition is cut, or begins or ends at no turning place, it has its own start and end."""
    start_s, end_s = rep.start_s, rep.end_s
    if strokes and abs(strokes[0].stroke.start_s - start_s) <= 1e-6 and rep.cut_s != start_s:
        first = strokes[0]
        start_s = first.onset_s if first.onset_s >= start_s else _edge_of_place(smooth, first.stroke, leaving=True)
    if strokes and abs(strokes[-1].stroke.end_s - end_s) <= 1e-6 and rep.cut_s != end_s:
        last = strokes[-1]
        end_s = last.offset_s if last.offset_s <= end_s else _edge_of_place(smooth, last.stroke, leaving=False)
    return start_s, end_s


def _edge_of_place(smooth: Signal, stroke: Stroke, *, leaving: bool) -> float:
    """When a stroke whose speed does not say it left its first turning place, or reached its last, told from the angle
    alone; NaN where the sample beyond that edge was not seen."""
    part = smooth.between(stroke.start_s, stroke.end_s)
    way = stroke.toward * part.value
    if not part.finite.any():
        return math.nan
    low, high = float(np.nanmin(way)), float(np.nanmax(way))
    near = PLACE_SHARE * (high - low)
    edge = int(np.flatnonzero(way >= high - near)[0])
    if leaving:
        edge = int(np.flatnonzero(way[: edge + 1] <= low + near)[-1])
    beyond = edge + (1 if leaving else -1)
    seen = 0 <= beyond < len(way) and math.isfinite(way[beyond])
    return float(part.time_s[edge]) if seen else math.nan


def _furthest(smooth: Signal, window: Repetition, turns_high: bool | None) -> tuple[float, bool]:
    """When the angle was furthest on its way there, in the middle of a hold, and whether it was high there; furthest
    from where it began where it is not known which way that was. NaN where a gap, or what cut the repetition, begins
    or ends there: it may have been further where it was not seen."""
    part = smooth.between(window.start_s, window.end_s)
    known = part.value[part.finite]
    if not len(known):
        return math.nan, True
    away = part.value - known[0]
    if turns_high is None:
        turns_high = bool(away[int(np.nanargmax(np.abs(away)))] >= 0.0)
    away = away if turns_high else -away
    at = int(np.nanargmax(away))
    held = next(run for run in stretches(away >= HELD_SHARE * away[at]) if run.start <= at < run.stop)
    first_s, last_s = float(part.time_s[held.start]), float(part.time_s[held.stop - 1])
    near_s = 1.5 / part.rate_hz
    cut = min(abs(first_s - window.cut_s), abs(last_s - window.cut_s)) <= near_s
    if cut or not part.finite[max(held.start - 1, 0) : held.stop + 1].all():
        return math.nan, turns_high
    return float(part.time_s[held].mean()), turns_high


def _over(strokes: Sequence[StrokeMeasures], name: str, join: Callable[[Sequence[float]], float]) -> float:
    """A figure of all strokes together; not known where that of one is not."""
    values = [getattr(stroke, name) for stroke in strokes]
    return join(values) if values and all(map(math.isfinite, values)) else math.nan


def _mean(values: Sequence[float]) -> float:
    return math.fsum(values) / len(values)
