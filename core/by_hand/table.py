"""Values by hand as a table: what they are called in files, and their rows."""

from __future__ import annotations

from collections.abc import Iterable
from datetime import date

from carpus.core.by_hand.measures import measure_named
from carpus.core.by_hand.values import HandValue

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
