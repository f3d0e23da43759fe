"""Two sessions of one person side by side: order, comparison, and synchronised playback.

The comparison is that of the progress, with the same limits and reasons. Degrees; NaN is unknown.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from carpus.core.model.types import FloatArray, Side
from carpus.core.results.measure import MeasureKey
from carpus.core.results.progress import (
    Comparison,
    IncomparableReason,
    Verdict,
    compare_ranges,
    find_other_hand,
    incomparable_reasons,
    is_same_task,
    select_latest_versions,
)
from carpus.core.results.repetition_rows import RepetitionResult
from carpus.core.results.session_results import SessionResults

Relation = Literal["hands", "dates"]


@dataclass(frozen=True, slots=True)
class SessionPair:
    """Two sessions: the ``first`` is in question, the ``second`` is the healthy hand or the earlier date.

    ``ranges`` compare the first with the second; for two hands a verdict only says that they differ beyond error.
    ``reasons``: why they are not compared.
    """

    first: SessionResults
    second: SessionResults
    relation: Relation
    ranges: tuple[Comparison, ...]
    reasons: tuple[IncomparableReason, ...]

    @property
    def is_comparable(self) -> bool:
        return not self.reasons

    @property
    def main_comparison(self) -> Comparison | None:
        """The trained arc if it differs, else the largest other difference, else the arc."""
        arcs = [one for one in self.ranges if one.after.quantity == "arc"]
        trained = [one for one in arcs if (one.after.subject if one.is_joint else "") == self.first.exercise.joint]
        largest = sorted((one for one in self.ranges if one.is_beyond_error), key=lambda one: -abs(one.difference_deg))
        return next(iter((*(one for one in trained if one.is_beyond_error), *largest, *trained, *arcs)), None)


def order_pair(
    one: SessionResults, other: SessionResults, affected: Side | Literal["both", ""] = ""
) -> tuple[SessionResults, SessionResults]:
    """Return two sessions in order: the affected (else right) hand, or the newer date, first."""
    if one.side != other.side:
        asked = affected if affected in ("right", "left") else "right"
        return (one, other) if one.side == asked else (other, one)
    return (one, other) if (one.when, one.session_id) >= (other.when, other.session_id) else (other, one)


def compare_pair(first: SessionResults, second: SessionResults, keys: Sequence[MeasureKey] = ()) -> SessionPair:
    """Compare two sessions; ``keys`` choose measures of the whole hand, without them the wrist's."""
    relation: Relation = "hands" if first.side != second.side else "dates"
    # That it is the other hand is the question here, no obstacle to an answer.
    alike = replace(second, side=first.side)
    rows = [row for row in (first.find(*key) for key in keys) if row is not None] if keys else list(first.wrist_ranges)
    ranges = list(compare_ranges(alike, first, rows))
    if relation == "hands":  # neither hand comes first: what is sure of the one way is sure of the other
        turned = {item.key: item.verdict for item in compare_ranges(first, alike, [one.before for one in ranges])}
        opposite: dict[str, Verdict] = {"improved": "worse", "worse": "improved"}
        for number, item in enumerate(ranges):
            if item.verdict == "not_judged" and turned.get(item.key) in opposite:
                ranges[number] = replace(item, verdict=opposite[turned[item.key]], reasons=())
    return SessionPair(first, second, relation, tuple(ranges), pair_incomparable_reasons(first, second))


def pair_incomparable_reasons(first: SessionResults, second: SessionResults) -> tuple[IncomparableReason, ...]:
    """Return why two sessions do not compare, whatever hand they are of."""
    obstacles: list[IncomparableReason] = []
    if first.protocol != second.protocol:
        obstacles.append("protocol")
    if first.exercise.id != second.exercise.id:
        obstacles.append("exercise")
    if any(not one.repetition_count and not one.has_passive for one in (first, second)):
        obstacles.append("few_repetitions_after")
    return tuple(
        dict.fromkeys((*obstacles, *incomparable_reasons(second, second), *incomparable_reasons(second, first)))
    )


def find_partner(history: Sequence[SessionResults], figures: SessionResults) -> SessionResults | None:
    """Return the best session to compare with, None without any.

    The other hand of the same day, else the last earlier comparable session, else the other hand of another day, else
    the nearest session of the same kind.
    """
    alike = [one for one in select_latest_versions(history) if is_same_task(one, figures)]
    same_day = [one for one in alike if one.side != figures.side and one.when.date() == figures.when.date()]
    if same_day:
        fair = [one for one in same_day if not pair_incomparable_reasons(figures, one)]
        return (fair or same_day)[-1]
    mine = [one for one in alike if one.side == figures.side]
    earlier = [one for one in mine if one.when < figures.when]
    fair_earlier = [one for one in earlier if not pair_incomparable_reasons(figures, one)]
    later = [one for one in mine if one.when > figures.when]
    other = find_other_hand(history, figures)
    best = (*fair_earlier[-1:], *(() if other is None else (other,)), *earlier[-1:], *later[:1])
    return best[0] if best else None


@dataclass(frozen=True, slots=True)
class PlaybackTimeline:
    """Knots (K,) of a piecewise linear playback: ``player_s`` rises, the recordings' times never fall.

    ``starts_s``: player times at which each pair of repetitions begins.
    """

    player_s: FloatArray
    first_s: FloatArray
    second_s: FloatArray
    starts_s: tuple[float, ...]

    @property
    def end_s(self) -> float:
        """Duration of the playback."""
        return float(self.player_s[-1])

    def recording_times(self, player_s: float) -> tuple[float, float]:
        """Return the time in the first and in the second recording."""
        both = (np.interp(player_s, self.player_s, side) for side in (self.first_s, self.second_s))
        first, second = (float(value) for value in both)
        return first, second


def align_playback(
    first: Sequence[RepetitionResult], second: Sequence[RepetitionResult], durations_s: tuple[float, float]
) -> PlaybackTimeline:
    """Align the repetitions of two recordings pair by pair.

    The first recording runs at its own speed, the second so that both are at the same part of their repetition. Both
    reach the first repetition together; after the last common one, and without repetitions, each runs at its own speed.
    """
    rows = [(0.0, 0.0, 0.0)]

    def advance(by_s: float, to_first_s: float, to_second_s: float) -> None:
        """Add a knot; time never goes back."""
        player_s, first_s, second_s = rows[-1]
        if player_s + by_s > player_s:
            rows.append((player_s + by_s, max(to_first_s, first_s), max(to_second_s, second_s)))

    starts: list[float] = []
    pairs = zip(_repetition_edges(first, durations_s[0]), _repetition_edges(second, durations_s[1]))  # noqa: B905
    for mine, other in pairs:
        ways_s = (max(mine[0] - rows[-1][1], 0.0), max(other[0] - rows[-1][2], 0.0))
        if starts:  # together over a pause
            advance(max(ways_s), mine[0], other[0])
        else:  # whoever has the shorter way to the first one waits
            advance(max(ways_s) - min(ways_s), mine[0] - min(ways_s), other[0] - min(ways_s))
            advance(min(ways_s), mine[0], other[0])
        starts.append(rows[-1][0])
        advance(mine[1] - mine[0] or other[1] - other[0], mine[1], other[1])
    _, first_s, second_s = rows[-1]
    shorter_s, longer_s = sorted((max(durations_s[0] - first_s, 0.0), max(durations_s[1] - second_s, 0.0)))
    advance(shorter_s, first_s + shorter_s, second_s + shorter_s)
    advance(longer_s - shorter_s, *durations_s)
    knots = np.array(rows if len(rows) > 1 else [*rows, (1e-3, 0.0, 0.0)])
    return PlaybackTimeline(knots[:, 0], knots[:, 1], knots[:, 2], tuple(starts))


def _repetition_edges(repetitions: Sequence[RepetitionResult], duration_s: float) -> list[tuple[float, float]]:
    """Return start and end of each whole repetition, in order and inside the recording."""
    out: list[tuple[float, float]] = []
    last = 0.0
    for repetition in (one for one in repetitions if one.is_whole):
        start = min(max(repetition.start_s, last), duration_s)
        last = min(max(repetition.end_s, start), duration_s)
        out.append((start, last))
    return out
