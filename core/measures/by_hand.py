"""What can be measured by hand, one line each; what was entered, what counts of it, and whether a change is one.

Licensed questionnaires are entered as their totals only. ``real_change`` is what a change must exceed to be called one;
it is of that way of measuring, and says nothing of ours. NaN where no figure was found: then nothing is judged.
"""

from __future__ import annotations

import math
import statistics
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from datetime import date, datetime
from typing import Literal

from carpus.core.phrase import phrase
from carpus.core.types import Side

Kind = Literal["angle", "force", "size", "score"]
Better = Literal["more", "less", ""]
Unit = Literal["deg", "kg", "cm", "ml", "points"]
Way = Literal["active", "passive", ""]

GONIOMETER_DEG = 10.0
"""A change commonly asked for per joint; two days apart 12 to 30 degrees were found (clinical reference 6.3, C30)."""
ANGLE_SOURCE = "commonly quoted for one rater"
SCORE_SOURCE = "Sorensen 2013"


@dataclass(frozen=True, slots=True)
class HandMeasure:
    """One thing that can be measured by hand.

    ``least`` and ``most`` can be entered at all; outside ``usual`` the person is asked to look again. ``tries`` are
    averaged. ``of_hand``: it is of one hand, else of the person. ``name`` is empty of angles: it follows from the id.
    ``figure`` is what Carpus measures of the same: angle or joint, and movement. ``usual_form``: on the form without
    being asked for.
    """

    id: str
    kind: Kind
    unit: Unit
    least: float
    most: float
    usual: tuple[float, float]
    better: Better
    real_change: float
    source: str
    ways: tuple[Way, ...] = ("",)
    tries: int = 1
    of_hand: bool = True
    figure: tuple[str, str] | None = None
    usual_form: bool = False
    decimals: int = 0
    name: str = ""


def _angle(name: str, most: float, figure: tuple[str, str] | None, *, usual_form: bool = False) -> HandMeasure:
    return HandMeasure(
        name, "angle", "deg", -90.0, 180.0, (-20.0, most), "more", GONIOMETER_DEG, ANGLE_SOURCE,
        ways=("active", "passive"), figure=figure, usual_form=usual_form,
    )  # fmt: skip


def _force(
    id: str, name: str, most: float, real_change: float, source: str, *, usual_form: bool = False
) -> HandMeasure:
    return HandMeasure(
        id, "force", "kg", 0.0, 150.0, (0.0, most), "more", real_change, source, tries=3, usual_form=usual_form,
        decimals=1, name=name,
    )  # fmt: skip


def _size(
    id: str, name: str, least: float, most: float, usual: tuple[float, float], *, usual_form: bool = False
) -> HandMeasure:
    return HandMeasure(
        id, "size", "cm", least, most, usual, "", math.nan, "", usual_form=usual_form, decimals=1, name=name
    )  # fmt: skip


def _score(
    id: str, name: str, most: float, better: Better, real_change: float, source: str, *, usual_form: bool = False
) -> HandMeasure:
    return HandMeasure(
        id, "score", "points", 0.0, most, (0.0, most), better, real_change, source, of_hand=False,
        usual_form=usual_form, decimals=1, name=name,
    )  # fmt: skip


_WRIST = (
    _angle("FLEXION", 100.0, ("flexion", "flexion"), usual_form=True),
    _angle("EXTENSION", 95.0, ("flexion", "extension"), usual_form=True),
    _angle("RADIAL", 40.0, ("deviation", "radial"), usual_form=True),
    _angle("ULNAR", 55.0, ("deviation", "ulnar"), usual_form=True),
    _angle("PRONATION", 100.0, ("pronosupination", "pronation")),
    _angle("SUPINATION", 105.0, ("pronosupination", "supination")),
)
_THUMB_MOST = {"MCP": 80.0, "IP": 100.0}
_FINGER_MOST = {"MCP": 100.0, "PIP": 125.0, "DIP": 100.0}
_JOINTS = tuple(
    measure
    for finger in (1, 2, 3, 4, 5)
    for joint, most in (_THUMB_MOST if finger == 1 else _FINGER_MOST).items()
    for measure in (
        _angle(f"{joint}{finger}_FLEXION", most, (f"{joint}{finger}_flexion", "flexion")),
        # Carpus's least bent angle is no extension of the joint by itself: the two do not stand beside each other.
        _angle(f"{joint}{finger}_EXTENSION", 45.0, None),
    )
)

MEASURES: tuple[HandMeasure, ...] = (
    *_WRIST,
    _force("GRIP", phrase("Grip"), 80.0, 6.5, "Kim 2014, Bohannon 2019", usual_form=True),
    _force("KEY_PINCH", phrase("Key pinch"), 15.0, math.nan, "", usual_form=True),
    _force("THREE_POINT_PINCH", phrase("Three-point pinch"), 15.0, math.nan, ""),
    _force("TIP_PINCH", phrase("Tip pinch"), 12.0, math.nan, ""),
    _size("WRIST_ROUND", phrase("Round the wrist"), 5.0, 40.0, (11.0, 25.0), usual_form=True),
    _size("PALM_ROUND", phrase("Round the palm"), 5.0, 50.0, (14.0, 30.0)),
    _size("FIGURE_OF_EIGHT", phrase("Figure of eight"), 10.0, 80.0, (30.0, 60.0)),
    HandMeasure(
        "VOLUME", "size", "ml", 50.0, 1500.0, (200.0, 800.0), "", math.nan, "", name=phrase("Volume of the hand")
    ),
    _score("PRWE", "PRWE", 100.0, "less", 14.0, SCORE_SOURCE, usual_form=True),
    _score("QUICK_DASH", "QuickDASH", 100.0, "less", 14.0, SCORE_SOURCE),
    _score("DASH", "DASH", 100.0, "less", 10.0, SCORE_SOURCE),
    _score("MHQ", "MHQ", 100.0, "more", math.nan, ""),
    _score("PAIN_AT_REST", phrase("Pain at rest"), 10.0, "less", 2.0, "Farrar 2001", usual_form=True),
    _score("PAIN_MOVING", phrase("Pain when moving"), 10.0, "less", 2.0, "Farrar 2001"),
    *_JOINTS,
)


def measure_named(name: str) -> HandMeasure:
    """A measure by its id. Raises KeyError for one that this Carpus does not know."""
    for measure in MEASURES:
        if measure.id == name:
            return measure
    raise KeyError(name)


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
