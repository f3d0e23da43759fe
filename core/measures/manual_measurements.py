"""Manual measurements: what can be measured, the values entered, and their change.

Questionnaires under licence are entered as totals only. ``min_real_change`` is specific to the way of measuring and not
to Carpus; NaN where no published value was found, then changes are not assessed.
"""

from __future__ import annotations

import math
import statistics
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from datetime import date, datetime
from typing import Literal

from carpus.core.model.phrase import phrase
from carpus.core.model.types import Side

Kind = Literal["angle", "finger", "force", "size", "score"]
Better = Literal["more", "less", ""]
Unit = Literal["deg", "kg", "cm", "ml", "points"]
Mode = Literal["active", "passive", ""]

GONIOMETER_DEG = 10.0
"""Commonly required change per joint; 12 to 30 degrees were found over two days (reference 6.3, C30)."""
ANGLE_SOURCE = "commonly quoted for one rater"
FINGER_JOINTS = {
    1: ("MCP1", "IP1"),
    **{finger: (f"MCP{finger}", f"PIP{finger}", f"DIP{finger}") for finger in range(2, 6)},
}
"""Joints that flex a finger, base first."""
KAPANDJI = "KAPANDJI"
SCORE_SOURCE = "Sorensen 2013"
_DEFAULT_IDS = {
    *("FLEXION", "EXTENSION", "RADIAL", "ULNAR"),
    *("GRIP", "KEY_PINCH", "WRIST_ROUND", "PRWE", "PAIN_AT_REST"),
}


@dataclass(frozen=True, slots=True)
class ManualMeasure:
    """Quantity that can be measured manually.

    Attributes
    ----------
    min_value, max_value : limits of an entry
    usual_range : outside it the person is asked to check the value
    trial_count : number of trials that are averaged
    session_measure : (angle or joint, movement) that Carpus measures too
    name : empty for angles, whose name follows from the id
    """

    id: str
    kind: Kind
    unit: Unit
    min_value: float
    max_value: float
    usual_range: tuple[float, float]
    better_direction: Better
    min_real_change: float
    source: str
    modes: tuple[Mode, ...] = ("",)
    trial_count: int = 1
    session_measure: tuple[str, str] | None = None
    decimals: int = 1
    name: str = ""

    @property
    def is_per_hand(self) -> bool:
        """True for a measure of one hand, False for one of the person."""
        return self.kind != "score" or self.id == KAPANDJI

    @property
    def is_default(self) -> bool:
        """True if it is on the form without being chosen."""
        return self.id in _DEFAULT_IDS


BOTH_MODES: tuple[Mode, ...] = ("active", "passive")


def _angle_measure(
    id: str, usual_max: float, session_measure: tuple[str, str] | None, kind: Kind = "angle", usual_min: float = -20.0
) -> ManualMeasure:
    limits, modes = (-90.0, 180.0, (usual_min, usual_max)), BOTH_MODES
    return ManualMeasure(
        id, kind, "deg", *limits, "more", GONIOMETER_DEG, ANGLE_SOURCE, modes, 1, session_measure, decimals=0
    )


def _force_measure(
    id: str, name: str, usual_max: float, min_real_change: float = math.nan, source: str = ""
) -> ManualMeasure:
    limits = (0.0, 150.0, (0.0, usual_max))
    return ManualMeasure(id, "force", "kg", *limits, "more", min_real_change, source, trial_count=3, name=name)


def _size_measure(
    id: str, name: str, min_value: float, max_value: float, usual_range: tuple[float, float], unit: Unit = "cm",
    decimals: int = 1,
) -> ManualMeasure:  # fmt: skip
    limits = (min_value, max_value, usual_range)
    return ManualMeasure(id, "size", unit, *limits, "", math.nan, "", decimals=decimals, name=name)


def _score_measure(
    id: str, name: str, max_value: float, better: Better, min_real_change: float = math.nan, source: str = ""
) -> ManualMeasure:
    limits = (0.0, max_value, (0.0, max_value))
    return ManualMeasure(id, "score", "points", *limits, better, min_real_change, source, name=name)


_WRIST = (
    _angle_measure("FLEXION", 100.0, ("flexion", "flexion")),
    _angle_measure("EXTENSION", 95.0, ("flexion", "extension")),
    _angle_measure("RADIAL", 40.0, ("deviation", "radial")),
    _angle_measure("ULNAR", 55.0, ("deviation", "ulnar")),
    _angle_measure("PRONATION", 100.0, ("pronosupination", "pronation")),
    _angle_measure("SUPINATION", 105.0, ("pronosupination", "supination")),
)
_USUAL_MAX_DEG = {"MCP1": 80.0, "IP": 100.0, "MCP": 100.0, "PIP": 125.0, "DIP": 100.0}


def _finger_measures(finger: int, joints: tuple[str, ...]) -> Iterator[ManualMeasure]:
    """Yield both ends of each joint, TAM, and of the long fingers the distance from fingertip to palm.

    Extension is counted above zero in hyperextension, below it for a deficit.
    """
    for joint in joints:
        usual_max = _USUAL_MAX_DEG.get(joint, _USUAL_MAX_DEG.get(joint[:-1], 0.0))
        yield _angle_measure(f"{joint}_FLEXION", usual_max, (f"{joint}_flexion", "flexion"), "finger")
        # The smallest angle that Carpus measures is no extension of a single joint, so the two are not compared.
        yield _angle_measure(f"{joint}_EXTENSION", 45.0, None, "finger", -90.0)
    limits = (-90.0 * len(joints), 180.0 * len(joints), (-90.0 * len(joints), 360.0))
    yield ManualMeasure(
        f"TAM{finger}", "finger", "deg", *limits, "more", math.nan, "", BOTH_MODES, 1, (f"TAM{finger}", "arc"), 0
    )
    if finger > 1:
        limits = (0.0, 20.0, (0.0, 12.0))
        yield ManualMeasure(f"TIP_TO_PALM{finger}", "finger", "cm", *limits, "less", math.nan, "", ("active",))


_FINGERS = tuple(measure for finger, joints in FINGER_JOINTS.items() for measure in _finger_measures(finger, joints))

MEASURES: tuple[ManualMeasure, ...] = (
    *_WRIST,
    _force_measure("GRIP", phrase("Grip"), 80.0, 6.5, "Kim 2014, Bohannon 2019"),
    _force_measure("KEY_PINCH", phrase("Key pinch"), 15.0),
    _force_measure("THREE_POINT_PINCH", phrase("Three-point pinch"), 15.0),
    _force_measure("TIP_PINCH", phrase("Tip pinch"), 12.0),
    _size_measure("WRIST_ROUND", phrase("Wrist circumference"), 5.0, 40.0, (11.0, 25.0)),
    _size_measure("PALM_ROUND", phrase("Palm circumference (MCP level)"), 5.0, 50.0, (14.0, 30.0)),
    _size_measure("FIGURE_OF_EIGHT", phrase("Figure-of-eight (hand oedema)"), 10.0, 80.0, (30.0, 60.0)),
    _size_measure("VOLUME", phrase("Volume of the hand"), 50.0, 1500.0, (200.0, 800.0), "ml", 0),
    _score_measure("PRWE", "PRWE", 100.0, "less", 14.0, SCORE_SOURCE),
    _score_measure("QUICK_DASH", "QuickDASH", 100.0, "less", 14.0, SCORE_SOURCE),
    _score_measure("DASH", "DASH", 100.0, "less", 10.0, SCORE_SOURCE),
    _score_measure("MHQ", "MHQ", 100.0, "more"),
    _score_measure("PAIN_AT_REST", phrase("Pain at rest"), 10.0, "less", 2.0, "Farrar 2001"),
    _score_measure("PAIN_MOVING", phrase("Pain on movement"), 10.0, "less", 2.0, "Farrar 2001"),
    _score_measure(KAPANDJI, phrase("Kapandji score"), 10.0, "more"),
    *_FINGERS,
)
_BY_ID = {measure.id: measure for measure in MEASURES}


@dataclass(frozen=True, slots=True)
class Questionnaire:
    """Items of a questionnaire by number; their texts are under licence and stay on paper.

    ``part`` is the number of items that count twice as much as the rest; 0 where the score is the mean from 0 to 100.
    """

    item_count: int
    min_answer: int
    max_answer: int
    min_answered: int
    part: int = 0

    def parse_answers(self, text: str) -> list[float] | None:
        """Return the answers typed so far, NaN for ``-``; None if one is impossible.

        >>> QUESTIONNAIRES["QUICK_DASH"].parse_answers("12-")
        [1.0, 2.0, nan]
        """
        words = text.split() if self.max_answer > 9 else "".join(text.split())
        possible = {"-", *map(str, range(self.min_answer, self.max_answer + 1))}
        if len(words) > self.item_count or not possible.issuperset(words):
            return None
        return [math.nan if word == "-" else float(word) for word in words]

    def compute_score(self, answers: Sequence[float]) -> float:
        """Return the score; NaN if items lack or too few are answered.

        >>> QUESTIONNAIRES["QUICK_DASH"].compute_score([5.0] * 10 + [math.nan])
        100.0
        """
        answered = [one for one in answers if math.isfinite(one)]
        if len(answers) != self.item_count or len(answered) < self.min_answered:
            return math.nan
        if self.part:
            return sum(answers[: self.part]) + sum(answers[self.part :]) / 2.0
        return 25.0 * (statistics.fmean(answered) - 1.0)


QUESTIONNAIRES: Mapping[str, Questionnaire] = {
    "QUICK_DASH": Questionnaire(11, 1, 5, 10),
    "DASH": Questionnaire(30, 1, 5, 27),
    "PRWE": Questionnaire(15, 0, 10, 15, 5),
}
"""Published scoring: DASH and QuickDASH (sum / n - 1) x 25; PRWE pain (5 items) plus half of function (10 items)."""


def find_manual_measure(measure_id: str) -> ManualMeasure:
    """Return a measure by its id. Raises KeyError for an unknown one."""
    return _BY_ID[measure_id]


ChangeVerdict = Literal["improved", "worse", "within_error", "not_judged"]
MAX_LOCATION_LENGTH = 60
"""Characters of the place where a size was measured."""
MeasureKey = tuple[str, Mode, str]
"""Measure, mode and hand (empty for a measure of the person)."""


@dataclass(frozen=True, slots=True)
class ManualValue:
    """One entry, in the measure's unit; without trials it withdraws an earlier entry.

    ``side`` is empty for a measure of the person. ``day`` is when it was measured, ``entered_at`` when it was written.
    """

    measure: str
    mode: Mode
    side: Side | Literal[""]
    day: date
    trials: tuple[float, ...]
    location: str = ""
    rater: str = ""
    entered_at: datetime | None = None

    def __post_init__(self) -> None:
        measure = find_manual_measure(self.measure)
        has_wrong_side = bool(self.side) != measure.is_per_hand
        if self.mode not in measure.modes or has_wrong_side or len(self.trials) > measure.trial_count:
            raise ValueError(f"{self.measure}: way {self.mode!r}, side {self.side!r}, {len(self.trials)} tries")
        if not all(measure.min_value <= one <= measure.max_value for one in self.trials):
            raise ValueError(f"{self.measure}: {self.trials} is outside {measure.min_value:g} to {measure.max_value:g}")
        if len(self.location) > MAX_LOCATION_LENGTH:
            raise ValueError(f"{self.measure}: where is longer than {MAX_LOCATION_LENGTH} letters")

    @property
    def key(self) -> MeasureKey:
        return self.measure, self.mode, self.side

    @property
    def value(self) -> float:
        """Mean of the trials; NaN for a withdrawn entry."""
        return statistics.fmean(self.trials) if self.trials else math.nan


@dataclass(frozen=True, slots=True)
class ManualChange:
    """Change between two days; ``min_real_change`` is what it had to exceed, NaN if unknown."""

    first: ManualValue
    last: ManualValue
    min_real_change: float
    verdict: ChangeVerdict


def current_values(entries: Iterable[ManualValue]) -> list[ManualValue]:
    """Return the latest entry of each measure, mode, hand and day, sorted by day, without withdrawn ones.

    With them the TAM (TPM if passive) of each finger whose joints were all measured. ``entries`` are in the order in
    which they were entered.
    """
    latest = {at: entry for at, entry in find_latest_entries(entries).items() if entry.trials}
    latest |= {(total.key, total.day): total for total in _compute_totals(latest.values())}
    return sorted(latest.values(), key=lambda entry: entry.day)


def compute_total_deg(finger: int, angles_deg: Mapping[str, float]) -> float:
    """Return a finger's TAM, or TPM, from its joints' angles by measure; NaN if one is missing.

    Sum of flexion less the deficits of extension; hyperextension counts as 0 (ASSH, clinical reference 4.3).

    >>> flexion = {"MCP1_FLEXION": 50.0, "IP1_FLEXION": 60.0}
    >>> compute_total_deg(1, {**flexion, "MCP1_EXTENSION": 10.0, "IP1_EXTENSION": -20.0})
    90.0
    """
    joints = FINGER_JOINTS[finger]
    flexion = sum(angles_deg.get(f"{joint}_FLEXION", math.nan) for joint in joints)
    extension = [angles_deg.get(f"{joint}_EXTENSION", math.nan) for joint in joints]
    return flexion + sum(0.0 if end > 0.0 else end for end in extension)


def _compute_totals(values: Iterable[ManualValue]) -> Iterator[ManualValue]:
    by_way: dict[tuple[Mode, Side | Literal[""], date], dict[str, float]] = {}
    for one in values:
        by_way.setdefault((one.mode, one.side, one.day), {})[one.measure] = one.value
    for (mode, side, day), angles_deg in by_way.items():
        for finger in FINGER_JOINTS:
            total_deg = compute_total_deg(finger, angles_deg)
            if math.isfinite(total_deg):
                yield ManualValue(f"TAM{finger}", mode, side, day, (total_deg,))


def find_latest_entries(entries: Iterable[ManualValue]) -> dict[tuple[MeasureKey, date], ManualValue]:
    """Return the latest entry of each measure, mode, hand and day, also if it withdraws the value."""
    return {(entry.key, entry.day): entry for entry in entries}


def session_values(entries: Iterable[ManualValue], side: Side, day: date) -> tuple[ManualValue, ...]:
    """Return the current values of one day, of one hand and of the person."""
    return tuple(one for one in current_values(entries) if one.day == day and one.side in (side, ""))


def value_history(entries: Iterable[ManualValue], key: MeasureKey) -> list[ManualValue]:
    """Return the current values of one measure, mode and hand, sorted by day."""
    return [entry for entry in current_values(entries) if entry.key == key]


def previous_value(entries: Iterable[ManualValue], key: MeasureKey, day: date) -> ManualValue | None:
    """Return the last value before a day."""
    return next((entry for entry in reversed(value_history(entries, key)) if entry.day < day), None)


def value_on_day(entries: Iterable[ManualValue], key: MeasureKey, day: date) -> ManualValue | None:
    """Return the current value of one day."""
    found = find_latest_entries(entries).get((key, day))
    return found if found is not None and found.trials else None


def find_superseded_entries(entries: Sequence[ManualValue], key: MeasureKey, day: date) -> list[ManualValue]:
    """Return the earlier entries of the same day, in order."""
    return [entry for entry in entries if entry.key == key and entry.day == day][:-1]


def compute_change(history: Sequence[ManualValue]) -> ManualChange | None:
    """Assess the change from the first to the last value; None with fewer than two."""
    if len(history) < 2:
        return None
    first, last = history[0], history[-1]
    measure = find_manual_measure(first.measure)
    gain = (last.value - first.value) * (-1.0 if measure.better_direction == "less" else 1.0)
    verdict: ChangeVerdict = "not_judged"
    if measure.better_direction and math.isfinite(measure.min_real_change):
        verdict = "within_error" if abs(gain) <= measure.min_real_change else "improved" if gain > 0.0 else "worse"
    return ManualChange(first, last, measure.min_real_change, verdict)


def is_unusual(measure: ManualMeasure, value: float) -> bool:
    """Return whether a person should check the value before it is saved."""
    low, high = measure.usual_range
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


def to_rows(values: Iterable[ManualValue]) -> list[list[str]]:
    """Return one row of texts for each value, in the order of :data:`COLUMNS`."""
    return [
        [
            "" if one.day == date.min else one.day.isoformat(), one.side, one.measure, one.mode,
            find_manual_measure(one.measure).unit, f"{one.value:g}", " ".join(f"{number:g}" for number in one.trials),
            one.location, one.rater, one.entered_at.isoformat() if one.entered_at else "",
        ]
        for one in values
    ]  # fmt: skip
