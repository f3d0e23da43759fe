"""Values measured by hand: what was entered, what counts of it, and whether a change is one.

They are entered by a person and never joined, averaged or subtracted with what Carpus measures.
"""

from __future__ import annotations

import math
import statistics
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from datetime import date, datetime
from typing import Literal

from carpus.core.by_hand.measures import HandMeasure, Way, measure_named
from carpus.core.types import Side

Verdict = Literal["improved", "worse", "within_error", "not_judged"]
MOST_WHERE = 60
"""Letters of where a size was taken."""
Key = tuple[str, Way, str]
"""Measure, way and hand (empty: of the person)."""


@dataclass(frozen=True, slots=True)
class HandValue:
    """One entry. ``tries`` in the measure's unit, none when an earlier entry was taken back; ``side`` empty for what is
    of the person; ``by`` initials, ``entered`` when it was written down, which is not when it was measured: ``day``."""

    measure: str
    way: Way
    side: Side | Literal[""]
    day: date
    tries: tuple[float, ...]
    where: str = ""
    by: str = ""
    entered: datetime | None = None

    def __post_init__(self) -> None:
        of = measure_named(self.measure)
        if self.way not in of.ways or bool(self.side) != of.of_hand or len(self.tries) > of.tries:
            raise ValueError(f"{self.measure}: way {self.way!r}, side {self.side!r}, {len(self.tries)} tries")
        if not all(of.least <= one <= of.most for one in self.tries):
            raise ValueError(f"{self.measure}: {self.tries} is outside {of.least:g} to {of.most:g}")
        if len(self.where) > MOST_WHERE:
            raise ValueError(f"{self.measure}: where is longer than {MOST_WHERE} letters")

    @property
    def key(self) -> Key:
        """What it is a value of."""
        return self.measure, self.way, self.side

    @property
    def value(self) -> float:
        """Mean of the tries; NaN where it was taken back."""
        return statistics.fmean(self.tries) if self.tries else math.nan


@dataclass(frozen=True, slots=True)
class HandChange:
    """Between two days, by one way: ``real_change`` what it had to exceed, NaN for nobody knows."""

    first: HandValue
    last: HandValue
    real_change: float
    verdict: Verdict


def counted(entries: Iterable[HandValue]) -> list[HandValue]:
    """Of every measure, way, hand and day what was entered last, by day; without what was taken back.

    ``entries`` are in the order in which they were entered.
    """
    return sorted((entry for entry in newest(entries).values() if entry.tries), key=lambda entry: entry.day)


def newest(entries: Iterable[HandValue]) -> dict[tuple[Key, date], HandValue]:
    """Of every measure, way, hand and day what was entered last, also where that took it back."""
    return {(entry.key, entry.day): entry for entry in entries}


def of_session(entries: Iterable[HandValue], side: Side, day: date) -> tuple[HandValue, ...]:
    """What counts of one day, of one hand and of the person."""
    return tuple(one for one in counted(entries) if one.day == day and one.side in (side, ""))


def course_of(entries: Iterable[HandValue], key: Key) -> list[HandValue]:
    """What counts of one measure, way and hand, by day."""
    return [entry for entry in counted(entries) if entry.key == key]


def before(entries: Iterable[HandValue], key: Key, day: date) -> HandValue | None:
    """What was measured last before a day."""
    return next((entry for entry in reversed(course_of(entries, key)) if entry.day < day), None)


def on_day(entries: Iterable[HandValue], key: Key, day: date) -> HandValue | None:
    """What counts of one day."""
    found = newest(entries).get((key, day))
    return found if found is not None and found.tries else None


def replaced(entries: Sequence[HandValue], key: Key, day: date) -> list[HandValue]:
    """What was entered for the same before, in order; it stays readable."""
    return [entry for entry in entries if entry.key == key and entry.day == day][:-1]


def change_of(course: Sequence[HandValue]) -> HandChange | None:
    """First to last of one course, judged by what that way of measuring must exceed; None with fewer than two."""
    if len(course) < 2:
        return None
    first, last = course[0], course[-1]
    of = measure_named(first.measure)
    gain = (last.value - first.value) * (-1.0 if of.better == "less" else 1.0)
    verdict: Verdict = "not_judged"
    if of.better and math.isfinite(of.real_change):
        verdict = "within_error" if abs(gain) <= of.real_change else "improved" if gain > 0.0 else "worse"
    return HandChange(first, last, of.real_change, verdict)


def is_unusual(measure: HandMeasure, value: float) -> bool:
    """Whether a person should look at a number again before it is kept."""
    low, high = measure.usual
    return not low <= value <= high


COLUMNS = {
    "day": "when it was measured; empty where days are nobody's business",
    "hand": "right or left; empty for what is of the person",
    "measure": "what was measured, by a person and not by Carpus",
    "way": "active: moved by the patient; passive: moved by somebody else",
    "unit": "deg, kg, cm, ml or points, of value and tries",
    "value": "mean of the tries",
    "tries": "each of them, a blank between",
    "where": "where a size was taken, in a person's words",
    "by": "initials of who measured",
    "entered": "when it was written down",
}


def rows_of(values: Iterable[HandValue]) -> list[list[str]]:
    """One row of texts for each value, in the order of :data:`COLUMNS`."""
    return [
        [
            "" if one.day == date.min else one.day.isoformat(), one.side, one.measure, one.way,
            measure_named(one.measure).unit, f"{one.value:g}", " ".join(f"{number:g}" for number in one.tries),
            one.where, one.by, one.entered.isoformat() if one.entered else "",
        ]
        for one in values
    ]  # fmt: skip
