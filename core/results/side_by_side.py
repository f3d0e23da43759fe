"""Two sessions of one person beside each other: which stands first, whether they compare, and what may be said.

The judgement is that of the progress: the same limits, the same reasons for none. Degrees; NaN is unknown.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

from carpus.core.measures.change import Obstacle
from carpus.core.results.figures import SessionFigures
from carpus.core.results.progress import (
    Comparison,
    Unfairness,
    compare_rows,
    newest_results,
    other_hand_of,
    unfair_reasons,
)
from carpus.core.results.ranges import RangeRow, RowKey
from carpus.core.types import Side

Relation = Literal["hands", "dates"]
JUST_BEYOND = 1.1
"""Up to so many times its limit a difference is only just beyond error."""


@dataclass(frozen=True, slots=True)
class ComparedRange:
    """One movement of both sessions. ``comparison`` is of the first against the second; its verdict says of two dates
    whether it improved, of two hands only whether the difference is beyond error."""

    first: RangeRow
    second: RangeRow
    comparison: Comparison

    @property
    def beyond(self) -> bool:
        """Whether the two differ by more than error."""
        return self.comparison.verdict in ("improved", "worse")

    @property
    def at_least(self) -> bool:
        """Whether that difference is a lower bound, since one of the two was hidden in part."""
        return self.beyond and bool(self.first.joint) and self.first.limited != self.second.limited

    @property
    def just_beyond(self) -> bool:
        """Whether that difference is hardly larger than error."""
        return (
            self.beyond
            and not self.at_least
            and abs(self.comparison.shown_difference_deg) <= JUST_BEYOND * self.comparison.limit_deg
        )


@dataclass(frozen=True, slots=True)
class SideBySide:
    """The ``first`` session is the one in question, the ``second`` what it is held against: the healthy hand, or the
    earlier date. ``alone`` what only one of the two has, with whether that is the first. ``reasons`` why nothing is
    judged; empty where the pair is fair."""

    first: SessionFigures
    second: SessionFigures
    relation: Relation
    ranges: tuple[ComparedRange, ...]
    reasons: tuple[Unfairness, ...]
    alone: tuple[tuple[RangeRow, bool], ...] = ()

    @property
    def fair(self) -> bool:
        """Whether the two compare at all."""
        return not self.reasons

    @property
    def main(self) -> ComparedRange | None:
        """What answers the question: the trained arc where it differs, the largest other difference, else the arc."""
        beyond = [one for one in self.ranges if one.beyond]
        arcs = [one for one in self.ranges if one.first.movement == "arc"]
        trained = [one for one in arcs if one.first.joint == self.first.exercise.joint]
        largest = sorted(beyond, key=lambda one: -abs(one.comparison.difference_deg))
        best: list[ComparedRange | None] = [*(one for one in trained if one in beyond), *largest, *trained, *arcs, None]
        return best[0]


def ordered(
    one: SessionFigures, other: SessionFigures, affected: Side | Literal["both", ""] = ""
) -> tuple[SessionFigures, SessionFigures]:
    """Which of two stands first: of two hands the affected one, else the right; of two dates the newer."""
    if one.side != other.side:
        asked = affected if affected in ("right", "left") else "right"
        return (one, other) if one.side == asked else (other, one)
    return (one, other) if (one.when, one.session_id) >= (other.when, other.session_id) else (other, one)


def side_by_side(first: SessionFigures, second: SessionFigures, keys: Sequence[RowKey] = ()) -> SideBySide:
    """Compare two sessions; ``keys`` choose what of the whole hand is looked at, without them it is the wrist."""
    relation: Relation = "hands" if first.side != second.side else "dates"
    # That it is the other hand is the question here, no obstacle to an answer.
    alike = replace(second, side=first.side)
    rows = [row for key in keys for row in first.joint_rows if row.key == key] if keys else list(first.rows)
    found = {item_key(item): item for item in compare_rows(alike, first, rows)}
    reverse = {}
    if relation == "hands":  # neither hand comes first: what is sure of the one way is sure of the other
        beside_them = [other for row in rows for other in _rows_of(alike, row.key)]
        reverse = {item_key(item): item for item in compare_rows(first, alike, beside_them)}
    ranges = []
    for row in rows:
        item, beside = found.get(row.key), next(iter(_rows_of(alike, row.key)), None)
        if item is None or beside is None:
            continue
        turned = reverse.get(row.key)
        if item.verdict == "not_judged" and turned is not None and turned.verdict in ("improved", "worse"):
            item = replace(item, verdict="worse" if turned.verdict == "improved" else "improved", reasons=())
        ranges.append(ComparedRange(row, beside, item))
    shared = {one.first.key for one in ranges}
    others = [row for key in keys for row in second.joint_rows if row.key == key] if keys else list(second.rows)
    alone = [(row, True) for row in rows if row.key not in shared]
    alone += [(row, False) for row in others if row.key not in shared]
    return SideBySide(first, second, relation, tuple(ranges), pair_reasons(first, second), tuple(alone))


def item_key(item: Comparison) -> RowKey:
    """What a comparison is of."""
    return item.joint, item.movement, item.angle


def pair_reasons(first: SessionFigures, second: SessionFigures) -> tuple[Unfairness, ...]:
    """Why two sessions do not compare, whatever hand they are of; empty where they do."""
    obstacles: list[Obstacle] = []
    if first.protocol != second.protocol:
        obstacles.append("protocol")
    if first.exercise.id != second.exercise.id:
        obstacles.append("exercise")
    if any(not one.counted and one.passive is None for one in (first, second)):
        obstacles.append("few_repetitions_after")
    return tuple(dict.fromkeys((*obstacles, *unfair_reasons(second, second), *unfair_reasons(second, first))))


def partner_of(history: Sequence[SessionFigures], figures: SessionFigures) -> SessionFigures | None:
    """What a session is best held against: the other hand of the same day, else the last earlier session that
    compares, else the other hand of another day, else the nearest session of the same kind; None without any."""
    other = other_hand_of(history, figures)
    same_day = [one for one in newest_results(history) if one.side != figures.side and _alike(one, figures)]
    same_day = [one for one in same_day if one.when.date() == figures.when.date()]
    if same_day:
        fair = [one for one in same_day if not pair_reasons(figures, one)]
        return (fair or same_day)[-1]
    mine = [one for one in newest_results(history) if one.side == figures.side and _alike(one, figures)]
    earlier = [one for one in mine if one.when < figures.when]
    fair_earlier = [one for one in earlier if not pair_reasons(figures, one)]
    later = [one for one in mine if one.when > figures.when]
    best: list[SessionFigures | None] = [*fair_earlier[-1:], other, *earlier[-1:], *later[:1], None]
    return next((one for one in best if one is not None), None)


def _alike(one: SessionFigures, other: SessionFigures) -> bool:
    same = (one.exercise.id, one.protocol, one.simulated) == (other.exercise.id, other.protocol, other.simulated)
    return same and one.session_id != other.session_id and not one.not_counted


def _rows_of(figures: SessionFigures, key: RowKey) -> list[RangeRow]:
    joint, movement, angle = key
    row = figures.row(movement, angle, joint)
    return [] if row is None else [row]
