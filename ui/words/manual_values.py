"""Names, units, values and changes of manual measurements."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from carpus.core.measures.manual_measurements import (
    MEASURES,
    ManualChange,
    ManualMeasure,
    ManualValue,
    MeasureKey,
    compute_change,
    find_manual_measure,
    value_history,
)
from carpus.ui.kit import numbers
from carpus.ui.kit.translate import to_mid_sentence, tr, translate_phrase
from carpus.ui.words import terms
from carpus.ui.words.marker_words import long_finger_name
from carpus.ui.words.verdicts import verdict_word


def measure_name(measure: ManualMeasure) -> str:
    """Return the name of a measure, such as ``Grip`` or ``Ring finger, PIP flexion``."""
    if measure.name:
        return translate_phrase(measure.name)
    joint, _, movement = measure.id.rpartition("_")
    if not joint:
        name = terms.movement_long_name(movement.lower())
        return (
            name
            if movement in ("PRONATION", "SUPINATION")
            else tr("Wrist, {movement}").format(movement=to_mid_sentence(name))
        )
    finger = int(joint[-1])
    row = {"MCP": tr("MCP"), "PIP": tr("PIP"), "DIP": tr("DIP"), "IP": tr("IP")}[joint[:-1]]
    name = long_finger_name(str(finger))
    return tr("{finger}, {joint}, {movement}").format(
        finger=name, joint=row, movement=tr("extension") if movement == "EXTENSION" else tr("flexion")
    )


def mode_name(way: str) -> str:
    """Return active or passive; empty for a measure with one mode."""
    return {"active": tr("active"), "passive": tr("passive")}.get(way, "")


def unit_name(measure: ManualMeasure) -> str:
    """Return the unit behind a number."""
    if measure.unit == "points":
        return tr("of {most}").format(most=numbers.format_significant(measure.max_value, 6))
    return {"deg": "°", "kg": "kg", "cm": "cm", "ml": "ml"}[measure.unit]


def value_words(measure: ManualMeasure, value: float) -> str:
    """Return a value with its unit, such as ``5.3 kg``; a dash if unknown."""
    if not math.isfinite(value):
        return "–"
    decimals = 0 if measure.unit == "points" and value == int(value) else measure.decimals
    text = numbers.format_fixed(value, decimals)
    if measure.unit == "deg":
        return f"{text}°".replace("-", "−")
    return text if measure.unit == "points" else f"{text} {unit_name(measure)}"


def group_names() -> dict[str, str]:
    """Return the headings of the form by kind, in order."""
    return {
        "angle": tr("Goniometer"), "force": tr("Force"), "size": tr("Circumference and volume"), "score": tr("Scores"),
    }  # fmt: skip


def direction_words(measure: ManualMeasure) -> str:
    """Say which direction of a score is better."""
    return {"less": tr("lower is better"), "more": tr("higher is better"), "": ""}[measure.better_direction]


def full_name(key: MeasureKey) -> str:
    """Return measure and mode, such as ``Wrist, flexion, active``."""
    return ", ".join(filter(None, (measure_name(find_manual_measure(key[0])), mode_name(key[1]))))


def verdict_words(change: ManualChange) -> tuple[str, str]:
    """Return state and text of a change."""
    if change.verdict == "not_judged":
        return "none", tr("not assessed")
    if change.verdict == "within_error":
        return "none", verdict_word("no_change")
    return ("good", tr("improved")) if change.verdict == "improved" else ("bad", tr("worse"))


def change_words(change: ManualChange) -> str:
    """Return ``45° → 58° since 2 Oct (MDC 10°)``."""
    manual_measure = find_manual_measure(change.first.measure)
    words = tr("{before} → {after} since {day}").format(
        before=value_words(manual_measure, change.first.value), after=value_words(manual_measure, change.last.value),
        day=numbers.format_day_month(change.first.day),
    )  # fmt: skip
    if math.isfinite(change.min_real_change):
        words += " " + tr("(MDC {size})").format(size=value_words(manual_measure, change.min_real_change))
    return words


def sort_keys(values: Iterable[ManualValue]) -> list[MeasureKey]:
    """Return the keys of the values in the order of the form."""
    order = {measure.id: number for number, measure in enumerate(MEASURES)}
    return sorted({value.key for value in values}, key=lambda key: (order[key[0]], key[1], key[2]))


def day_words(values: Sequence[ManualValue]) -> str:
    """Return the newest value of each measure in one line."""
    by_measure: dict[str, list[ManualValue]] = {}
    for key in sort_keys(values):
        by_measure.setdefault(key[0], []).append(value_history(values, key)[-1])
    words = []
    for name, found in by_measure.items():
        manual_measure = find_manual_measure(name)
        text = ", ".join(
            " ".join(filter(None, (value_words(manual_measure, v.value), mode_name(v.mode), v.location))) for v in found
        )
        unit = f" {unit_name(manual_measure)}" if manual_measure.unit == "points" else ""
        words.append(f"{measure_name(manual_measure)} {text}{unit}")
    return "; ".join(words)


def find_changes(values: Sequence[ManualValue]) -> list[tuple[MeasureKey, ManualChange]]:
    """Return first and last value of each measure that was taken on two days or more."""
    found = [(key, compute_change(value_history(values, key))) for key in sort_keys(values)]
    return [(key, change) for key, change in found if change is not None]
