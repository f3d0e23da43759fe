"""Comparison of sessions, progress over many, and proposed goals.

A goal is proposed, never set: the therapist accepts or changes it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from carpus.core.measures.change_limits import (
    ARC_LIMIT_FACTOR,
    DEFAULT_LIMITS,
    TOTAL_ACTIVE_MOTION,
    ErrorLimits,
    RetestStudy,
    change_limit_rad,
)
from carpus.core.measures.manual_measurements import ManualValue
from carpus.core.measures.motion_range import MIN_REPETITIONS_FOR_SD
from carpus.core.model.hand.exercises import DIRECTIONS, PRONOSUPINATION, Exercise
from carpus.core.model.hand.protocols import WRIST_ANGLES
from carpus.core.model.rounding import round_half_away
from carpus.core.model.types import Side
from carpus.core.results.measure import Measure, MeasureKey, is_total_active_motion
from carpus.core.results.session_results import SessionResults

Verdict = Literal["improved", "worse", "no_change", "not_judged"]
IncomparableReason = Literal[
    "side",
    "protocol",
    "exercise",
    "few_repetitions_before",
    "few_repetitions_after",
    "unknown",
    "simulated",
    "not_counted",
    "doubtful",
    "distance",
    "start_angle",
    "forearm_moved",
    "hidden",
    "angle_order",
    "only_passive",
]
INVALIDATING_FINDINGS = (
    "swapped",
    "shifted",
    "misnamed",
    "wrong_side",
    "other_length",
    "depth_off",
    "other_spot",
    "no_palm",
)
"""Calibration findings after which the angles may be wrong: such a session is never compared."""
MAX_DISTANCE_STEP_M = 0.10
MAX_START_ANGLE_STEP_DEG = 5.0
"""Beyond these limits two sessions were not set up alike."""


@dataclass(frozen=True, slots=True)
class Comparison:
    """One range in two sessions, ``after`` against ``before``."""

    before: Measure
    after: Measure
    limit_deg: float
    verdict: Verdict
    reasons: tuple[IncomparableReason, ...] = ()
    """Why the two are not compared; empty if they are."""

    @property
    def key(self) -> MeasureKey:
        return self.after.key

    @property
    def is_joint(self) -> bool:
        return self.after.wrist_angle < 0

    @property
    def difference_deg(self) -> float:
        return self.after.mean - self.before.mean

    @property
    def is_beyond_error(self) -> bool:
        """True if the means differ by more than the measurement error."""
        return self.verdict in ("improved", "worse")

    @property
    def lower_bounds(self) -> tuple[bool, bool]:
        """Which of the two values are lower bounds, since the joint was hidden in part."""
        return (self.before.is_lower_bound, self.after.is_lower_bound) if self.is_joint else (False, False)

    @property
    def is_lower_bound(self) -> bool:
        """True if the gain is a lower bound."""
        return self.lower_bounds == (False, True)

    @property
    def display_difference_deg(self) -> float:
        """Difference of the rounded means, so that the values on a page agree."""
        if not math.isfinite(self.difference_deg):
            return math.nan
        return float(round_half_away(self.after.mean) - round_half_away(self.before.mean))


@dataclass(frozen=True, slots=True)
class ProgressPoint:
    """Session in the progress; with ``reasons`` it is shown but not compared."""

    results: SessionResults
    reasons: tuple[IncomparableReason, ...]

    @property
    def is_comparable(self) -> bool:
        """True if it compares with the first session."""
        return not self.reasons


@dataclass(frozen=True, slots=True)
class Progress:
    """Sessions of one hand and exercise in order of time; the first and last comparable ones are compared.

    ``keys``: measures of the whole hand that are followed, empty for the wrist. ``superseded``: earlier results of
    re-analysed recordings, each of which counts once.
    """

    points: tuple[ProgressPoint, ...]
    comparisons: tuple[Comparison, ...]
    other_hand: SessionResults | None
    keys: tuple[MeasureKey, ...] = ()
    superseded: tuple[SessionResults, ...] = ()
    manual_measurements: tuple[ManualValue, ...] = ()
    """Included manual measurements of this hand and of the person, by day; never mixed with ours."""

    @property
    def earlier_results(self) -> int:
        """Number of earlier results of the same recordings."""
        return max(len(self.superseded), sum(point.results.earlier_results for point in self.points))

    @property
    def reference(self) -> SessionResults | None:
        """Session compared with: the first comparable one, else the first."""
        chosen = next((point for point in self.points if point.is_comparable), self.points[0] if self.points else None)
        return chosen.results if chosen is not None else None

    @property
    def current(self) -> SessionResults | None:
        """Last comparable session."""
        fair = [point.results for point in self.points if point.is_comparable]
        return fair[-1] if fair else None

    @property
    def study(self) -> RetestStudy | None:
        """The clinic's own test-retest study that sets the limits, None for the default limits."""
        return self.current.study if self.current is not None else None

    @property
    def main_comparison(self) -> Comparison | None:
        """Comparison of the trained arc, or the largest change beyond error."""
        beyond = [item for item in self.comparisons if item.is_beyond_error]
        arcs = [item for item in self.comparisons if item.after.quantity == "arc"]
        return next(iter((*(item for item in arcs if item in beyond), *beyond, *arcs)), None)


def compare_ranges(
    before: SessionResults, after: SessionResults, rows: Sequence[Measure] | None = None
) -> tuple[Comparison, ...]:
    """Compare the means of ranges in both sessions: ``rows`` of the later one, or its wrist ranges.

    A change within the measurement error is none. A hidden joint is not assessed, except for a certain gain. Sessions
    that the progress excludes are not assessed here either.
    """
    unfair = tuple(dict.fromkeys((*incomparable_reasons(before, before), *incomparable_reasons(before, after))))
    out = []
    for row in after.wrist_ranges if rows is None else rows:
        other = before.find(*row.key)
        if other is None:
            continue
        item = Comparison(other, row, change_limit_deg(after, row, is_arc_change=True), "not_judged")
        difference, is_beyond = item.difference_deg, abs(item.difference_deg) > item.limit_deg
        # A lower bound that lies beyond the error above a figure fully seen is a gain; nothing else is known of it.
        sure_gain = row.quantity == "arc" and item.is_lower_bound and is_beyond and difference > 0.0
        reasons = tuple(dict.fromkeys((*unfair, *_range_obstacles(before, other, after, row))))
        if not reasons and any(item.lower_bounds) and not sure_gain:
            reasons = ("hidden",)
        verdict: Verdict = "not_judged"
        if not reasons:
            better = difference < 0.0 if item.is_joint and row.quantity == "extension" else difference > 0.0
            verdict = "no_change" if not is_beyond else "improved" if better else "worse"
        out.append(replace(item, verdict=verdict, reasons=reasons))
    return tuple(out)


def _range_obstacles(
    before: SessionResults, old: Measure, after: SessionResults, new: Measure
) -> Iterator[IncomparableReason]:
    """Yield reasons why two ranges do not compare, besides those of their sessions."""
    if before.side != after.side:
        yield "side"
    if before.protocol != after.protocol:
        yield "protocol"
    if before.exercise.id != after.exercise.id:
        yield "exercise"
    if not before.repetition_count or old.count < MIN_REPETITIONS_FOR_SD:
        yield "few_repetitions_before"
    if not after.repetition_count or new.count < MIN_REPETITIONS_FOR_SD:
        yield "few_repetitions_after"
    if not math.isfinite(new.mean - old.mean):
        yield "unknown"


def change_limit_deg(figures: SessionResults, row: Measure, *, is_arc_change: bool = False) -> float:
    """Return the limit that a change must exceed: the clinic's own, else the default.

    The default is that of one end, unless ``is_arc_change``: both ends of an arc may be off.
    """
    own = figures.study.limit_deg(row.subject, row.quantity) if figures.study is not None else None
    is_total = is_total_active_motion(row.subject)
    both_ends = is_arc_change and row.quantity == "arc" and not is_total
    default_rad = change_limit_rad(TOTAL_ACTIVE_MOTION if is_total else row.subject)
    default = math.degrees(default_rad) * (ARC_LIMIT_FACTOR if both_ends else 1.0)
    return default if own is None else own


def incomparable_reasons(first: SessionResults, other: SessionResults) -> tuple[IncomparableReason, ...]:
    """Return why a session does not compare with the first; with itself: with any."""
    reasons: list[IncomparableReason] = []
    if other.is_simulated != first.is_simulated:
        reasons.append("simulated")
    if other.angle_order != first.angle_order:
        reasons.append("angle_order")
    if any(finding.kind in INVALIDATING_FINDINGS for finding in other.findings):
        reasons.append("doubtful")
    if other.is_excluded:
        reasons.append("not_counted")
    if abs(first.quality.distance_m - other.quality.distance_m) > MAX_DISTANCE_STEP_M:
        reasons.append("distance")
    if float(np.abs(first.start_angles_deg - other.start_angles_deg).max()) > MAX_START_ANGLE_STEP_DEG:
        reasons.append("start_angle")
    if other.exercise.is_forearm_fixed and other.quality.has_forearm_moved:
        reasons.append("forearm_moved")
    if other.has_passive and not other.repetition_count:
        reasons.append("only_passive")
    elif 0 < other.repetition_count < MIN_REPETITIONS_FOR_SD or (
        other.exercise.has_repetitions and not other.repetition_count
    ):
        reasons.append("few_repetitions_after")
    return tuple(reasons)


def compute_progress(
    sessions: Sequence[SessionResults], other_hand: SessionResults | None = None, keys: Sequence[MeasureKey] = ()
) -> Progress:
    """Compare sessions of one hand, protocol and exercise with the first comparable one.

    ``keys`` choose measures of the whole hand; without them the wrist is followed.
    """
    ordered = select_latest_versions(sessions)
    real = [figures for figures in ordered if not figures.is_simulated]
    first = next((figures for figures in real or ordered if not incomparable_reasons(figures, figures)), None)
    points = tuple(ProgressPoint(figures, incomparable_reasons(first or figures, figures)) for figures in ordered)
    fair = [point.results for point in points if point.is_comparable]
    comparisons: tuple[Comparison, ...] = ()
    if len(fair) > 1:
        wanted = [row for row in (fair[-1].find(*key) for key in keys) if row is not None] if keys else None
        comparisons = compare_ranges(fair[0], fair[-1], wanted)
    replaced = tuple(figures for figures in sessions if all(figures is not kept for kept in ordered))
    return Progress(points, comparisons, other_hand, tuple(keys), replaced)


def select_latest_versions(sessions: Sequence[SessionResults]) -> list[SessionResults]:
    """Return the newest result of each recording, in order of time."""
    newest: dict[str, SessionResults] = {}
    for figures in sorted(sessions, key=lambda figures: figures.created or figures.when):
        newest[figures.recording_id or figures.session_id] = figures
    return sorted(newest.values(), key=lambda figures: figures.when)


def find_previous(history: Sequence[SessionResults], figures: SessionResults) -> SessionResults | None:
    """Return the last earlier included session of the same hand, protocol and exercise."""
    alike = [other for other in select_latest_versions(history) if other.side == figures.side]
    earlier = [one for one in alike if one.when < figures.when and _is_same_measured_task(one, figures)]
    return earlier[-1] if earlier else None


def error_limits(history: Sequence[SessionResults]) -> ErrorLimits:
    """Return the error limits of a patient's results, the default ones without any."""
    return history[0].error_limits if history else DEFAULT_LIMITS


def find_other_hand(history: Sequence[SessionResults], figures: SessionResults) -> SessionResults | None:
    """Return the last session of the other hand in the same protocol and exercise."""
    others = [other for other in select_latest_versions(history) if other.side != figures.side]
    alike = [one for one in others if _is_same_measured_task(one, figures)]
    return alike[-1] if alike else None


def is_same_task(one: SessionResults, other: SessionResults) -> bool:
    """Return whether ``one`` is an included session of another recording with the task of ``other``."""
    same = (one.exercise.id, one.protocol, one.is_simulated) == (other.exercise.id, other.protocol, other.is_simulated)
    is_same_recording = bool(one.recording_id) and one.recording_id == other.recording_id
    return same and one.session_id != other.session_id and not is_same_recording and not one.is_excluded


def _is_same_measured_task(one: SessionResults, other: SessionResults) -> bool:
    return is_same_task(one, other) and bool(one.measures_in_group("range"))


Goals = Mapping[tuple[str, Side], tuple[float, float]]
"""Accepted goals by exercise and hand: targets of the positive and negative direction, signed, NaN for none."""

GOAL_SESSIONS = 3
"""Enough that one good day is no goal, few enough that the hand is still the same."""
MAX_GOAL_STEP_DEG = 5.0
"""Above the sessions' mean: close enough to be reached on the same day."""
MAX_GOAL_DEG = 90.0


@dataclass(frozen=True, slots=True)
class GoalProposal:
    """Proposed goal for one direction, counted in that direction (supination from thumb up).

    ``basis_deg`` is the mean of the last ``sessions``. A gain exceeds the measurement error from
    ``detectable_from_deg`` on; the goal (whole degrees) is never above it.
    """

    direction: int
    basis_deg: float
    sessions: int
    goal_deg: float
    detectable_from_deg: float


def propose_goals(
    history: Sequence[SessionResults], exercise: Exercise, side: Side, protocol: str
) -> tuple[GoalProposal, ...]:
    """Propose goals for both directions of the wrist, or for the one of a joint.

    Uses sessions of this exercise, hand and protocol that compare with the newest of them.
    """
    same = [one for one in history if (one.exercise.id, one.side, one.protocol) == (exercise.id, side, protocol)]
    newest_first = sorted(same, key=lambda one: one.when, reverse=True)
    sound = [one for one in newest_first if not incomparable_reasons(one, one)]
    recent = [one for one in sound if not incomparable_reasons(sound[0], one)][:GOAL_SESSIONS]
    found = (_propose_goal(recent, exercise, direction) for direction in (1, -1))
    return tuple(one for one in found if one is not None)


def goal_measure(figures: SessionResults, exercise: Exercise, direction: int) -> Measure | None:
    """Return the range whose end is a direction's target, None if there is none."""
    if exercise.angle is not None:
        return figures.find(WRIST_ANGLES[exercise.angle], DIRECTIONS[exercise.angle][0 if direction > 0 else 1])
    return figures.find(exercise.joint, "flexion") if exercise.joint and direction > 0 else None


def _propose_goal(recent: Sequence[SessionResults], exercise: Exercise, direction: int) -> GoalProposal | None:
    rows = [(one, goal_measure(one, exercise, direction)) for one in recent]
    known = [(one, row) for one, row in rows if row is not None and row.count and not row.is_lower_bound]
    means = [row.mean for _, row in known if math.isfinite(row.mean)]
    if not means:
        return None
    basis = sum(means) / len(means)
    limit = change_limit_deg(*known[0])
    told_from = math.ceil(basis + limit)
    goal = min(math.floor(basis + min(MAX_GOAL_STEP_DEG, limit)), MAX_GOAL_DEG)
    least = 1.0 if exercise.angle != PRONOSUPINATION else -MAX_GOAL_DEG  # a palm turns up from 90 degrees of pronation
    if goal < least or (goal == MAX_GOAL_DEG and goal < basis):  # no step up is left
        return None
    return GoalProposal(direction, basis, len(means), float(goal), float(told_from))
