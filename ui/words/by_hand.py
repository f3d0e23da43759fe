"""Words for what is measured by hand, its units and ways, and whether it changed."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from carpus.core.measures.by_hand import (
    MEASURES,
    HandChange,
    HandMeasure,
    HandValue,
    Key,
    change_of,
    course_of,
    measure_named,
)
from carpus.ui import numbers, terms
from carpus.ui.marker_words import long_finger_name
from carpus.ui.translate import inside, say, tr
from carpus.ui.verdicts import no_change_words


def measure_name(measure: HandMeasure) -> str:
    """``Wrist, flexion``, ``Grip``, ``Ring finger, PIP flexion``."""
    if measure.name:
        return say(measure.name)
    joint, _, movement = measure.id.rpartition("_")
    if not joint:
        name = terms.movement_long_name(movement.lower())
        return (
            name if movement in ("PRONATION", "SUPINATION") else tr("Wrist, {movement}").format(movement=inside(name))
        )
    finger = int(joint[-1])
    row = {"MCP": tr("knuckle"), "PIP": tr("middle joint"), "DIP": tr("end joint"), "IP": tr("end joint")}[joint[:-1]]
    name = long_finger_name(str(finger))
    return tr("{finger}, {joint}, {movement}").format(
        finger=name, joint=row, movement=tr("straight") if movement == "EXTENSION" else tr("bent")
    )


def way_name(way: str) -> str:
    """How it was moved; empty where there is one way only."""
    return {"active": tr("active"), "passive": tr("passive")}.get(way, "")


def unit_name(measure: HandMeasure) -> str:
    """The unit behind a number."""
    if measure.unit == "points":
        return tr("of {most}").format(most=numbers.figures(measure.most, 6))
    return {"deg": "°", "kg": "kg", "cm": "cm", "ml": "ml"}[measure.unit]


def value_words(measure: HandMeasure, value: float) -> str:
    """``45°``, ``5.3 kg``; nothing measured is a dash."""
    if not math.isfinite(value):
        return "–"
    decimals = 0 if measure.unit == "points" and value == int(value) else measure.decimals
    text = numbers.fixed(value, decimals)
    if measure.unit == "deg":
        return f"{text}°".replace("-", "−")
    return text if measure.unit == "points" else f"{text} {unit_name(measure)}"


def group_names() -> dict[str, str]:
    """Headings of the form, by kind, in its order."""
    return {
        "angle": tr("Goniometer"), "force": tr("Force"), "size": tr("Size"), "score": tr("Scores"),
    }  # fmt: skip


def direction_words(measure: HandMeasure) -> str:
    """Which way is better, of a score."""
    return {"less": tr("less is better"), "more": tr("more is better"), "": ""}[measure.better]


def full_name(key: Key) -> str:
    """``Wrist, flexion, active``."""
    return ", ".join(filter(None, (measure_name(measure_named(key[0])), way_name(key[1]))))


def verdict_words(change: HandChange) -> tuple[str, str]:
    """State of a sign and its word, of a change by one way of measuring."""
    if change.verdict == "not_judged":
        return "none", tr("not judged")
    if change.verdict == "within_error":
        return "none", no_change_words()
    return ("good", tr("improved")) if change.verdict == "improved" else ("bad", tr("worse"))


def change_words(change: HandChange) -> str:
    """``45° → 58° since 2 Oct (error 10°)``."""
    of = measure_named(change.first.measure)
    words = tr("{before} → {after} since {day}").format(
        before=value_words(of, change.first.value), after=value_words(of, change.last.value),
        day=numbers.day_month(change.first.day),
    )  # fmt: skip
    if math.isfinite(change.real_change):
        words += " " + tr("(error {size})").format(size=value_words(of, change.real_change))
    return words


def keys_in_order(values: Iterable[HandValue]) -> list[Key]:
    """What was measured, in the order of the form."""
    order = {measure.id: number for number, measure in enumerate(MEASURES)}
    return sorted({value.key for value in values}, key=lambda key: (order[key[0]], key[1], key[2]))


def day_words(values: Sequence[HandValue]) -> str:
    """What counts, newest of each, in one line: ``Wrist, flexion 45° active, 58° passive; Grip 18 kg``."""
    by_measure: dict[str, list[HandValue]] = {}
    for key in keys_in_order(values):
        by_measure.setdefault(key[0], []).append(course_of(values, key)[-1])
    words = []
    for name, found in by_measure.items():
        of = measure_named(name)
        said = ", ".join(" ".join(filter(None, (value_words(of, v.value), way_name(v.way), v.where))) for v in found)
        unit = f" {unit_name(of)}" if of.unit == "points" else ""
        words.append(f"{measure_name(of)} {said}{unit}")
    return "; ".join(words)


def changes(values: Sequence[HandValue]) -> list[tuple[Key, HandChange]]:
    """First and last of all that was measured on two days or more; ``values`` are those that count, of one hand."""
    found = [(key, change_of(course_of(values, key))) for key in keys_in_order(values)]
    return [(key, change) for key, change in found if change is not None]
