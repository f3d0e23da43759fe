"""Names, units, values and changes of manual measurements."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from datetime import date

from carpus.core.measures.manual_measurements import (
    BOTH_MODES,
    FINGER_JOINTS,
    MEASURES,
    ManualChange,
    ManualMeasure,
    ManualValue,
    MeasureKey,
    Mode,
    compute_change,
    find_manual_measure,
    find_superseded_entries,
    is_unusual,
    value_history,
)
from carpus.ui.kit import numbers
from carpus.ui.kit.translate import to_mid_sentence, tr, translate_phrase
from carpus.ui.words import terms
from carpus.ui.words.progress import verdict_word
from carpus.ui.words.terms import long_finger_name


def measure_name(measure: ManualMeasure) -> str:
    """Return the name of a measure, such as ``Grip`` or ``Ring finger, PIP flexion``."""
    if measure.name:
        return translate_phrase(measure.name)
    if measure.id.startswith("TAM"):
        return tr("{finger}, TAM").format(finger=long_finger_name(measure.id[-1]))
    if measure.unit == "cm":
        return tr("{finger}, fingertip to palm").format(finger=long_finger_name(measure.id[-1]))
    joint, _, movement = measure.id.rpartition("_")
    if not joint:
        name = terms.movement_long_name(movement.lower())
        return (
            name
            if movement in ("PRONATION", "SUPINATION")
            else tr("Wrist, {movement}").format(movement=to_mid_sentence(name))
        )
    return tr("{finger}, {joint}, {movement}").format(
        finger=long_finger_name(joint[-1]),
        joint=_joint_name(joint),
        movement=tr("extension") if movement == "EXTENSION" else tr("flexion"),
    )


def _joint_name(joint: str) -> str:
    return {"MCP": tr("MCP"), "PIP": tr("PIP"), "DIP": tr("DIP"), "IP": tr("IP")}[joint[:-1]]


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
        "angle": tr("Goniometer"), "finger": tr("Finger joints, goniometer (°)"), "force": tr("Force"),
        "size": tr("Circumference and volume"), "score": tr("Scores"),
    }  # fmt: skip


def entry_error(measure: ManualMeasure, value: float) -> str:
    """Say which numbers are possible; empty for one of them."""
    if measure.min_value <= value <= measure.max_value:
        return ""
    pattern = tr("Enter a number from {least} to {most}, or leave it empty")
    return pattern.format(
        least=numbers.format_significant(measure.min_value, 6), most=value_words(measure, measure.max_value)
    )


def entry_warning(measure: ManualMeasure, value: float) -> str:
    """Return ``180°? Typical range: …`` for an unusual value; empty for any other."""
    if entry_error(measure, value) or not is_unusual(measure, value):
        return ""
    low, high = (value_words(measure, end) for end in measure.usual_range)
    return tr("{value} is unusual. Typical range: {low} to {high}").format(
        value=value_words(measure, value), low=low, high=high
    )


def history_words(values: Sequence[ManualValue], keys: Sequence[MeasureKey], day: date) -> str:
    """Return the earlier entries of a day and their authors, line by line; empty without any."""
    lines = []
    for key in keys:
        measure = find_manual_measure(key[0])
        for one in find_superseded_entries(values, key, day):
            when = numbers.format_date_time(one.entered_at.astimezone()) if one.entered_at else ""
            parts = (value_words(measure, one.value) if one.trials else tr("removed"), mode_name(one.mode))
            lines.append(" · ".join(filter(None, (" ".join(filter(None, parts)), one.rater, when))))
    return tr("Previous entries for this day:") + "\n" + "\n".join(lines) if lines else ""


def kapandji_stages() -> tuple[str, ...]:
    """Return what the tip of the thumb reaches at each Kapandji score, from 0 (Kapandji 1986)."""
    return (
        tr("no opposition"), tr("index finger, side of the middle phalanx"),
        tr("index finger, side of the distal phalanx"), tr("tip of the index finger"), tr("tip of the middle finger"),
        tr("tip of the ring finger"), tr("tip of the little finger"), tr("little finger, DIP crease"),
        tr("little finger, PIP crease"), tr("little finger, proximal crease"), tr("distal palmar crease"),
    )  # fmt: skip


def direction_words(measure: ManualMeasure) -> str:
    """Say which direction of a score is better."""
    return {"less": tr("lower is better"), "more": tr("higher is better"), "": ""}[measure.better_direction]


def full_name(key: MeasureKey) -> str:
    """Return measure and mode, such as ``Wrist, flexion, active`` or ``Ring finger, TPM``."""
    if key[0].startswith("TAM"):
        return f"{long_finger_name(key[0][-1])}, {_total_name(key[1])}"
    return ", ".join(filter(None, (measure_name(find_manual_measure(key[0])), mode_name(key[1]))))


def _total_name(mode: str) -> str:
    return "TPM" if mode == "passive" else "TAM"


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
    """Return the newest value of each measure in one line, finger joints as in :func:`_joint_words`."""
    by_measure: dict[str, list[ManualValue]] = {}
    for key in sort_keys(values):
        by_measure.setdefault(key[0], []).append(value_history(values, key)[-1])
    words = []
    for name, found in by_measure.items():
        manual_measure = find_manual_measure(name)
        if manual_measure.kind == "finger":
            continue
        text = ", ".join(
            " ".join(filter(None, (value_words(manual_measure, v.value), mode_name(v.mode), v.location))) for v in found
        )
        unit = f" {unit_name(manual_measure)}" if manual_measure.unit == "points" else ""
        words.append(f"{measure_name(manual_measure)} {text}{unit}")
    newest = {(one.measure, one.mode): one.value for found in by_measure.values() for one in found}
    joints = (_joint_words(finger, mode, newest) for finger in FINGER_JOINTS for mode in BOTH_MODES)
    return "; ".join([*words, *filter(None, joints)])


def _joint_words(finger: int, mode: Mode, values: Mapping[tuple[str, Mode], float]) -> str:
    """Return ``Ring finger, active: MCP 0/85, PIP −20/90, TAM 225°``: extension and flexion; empty without any."""
    parts = []
    for joint in FINGER_JOINTS[finger]:
        ends = [values.get((f"{joint}_{end}", mode), math.nan) for end in ("EXTENSION", "FLEXION")]
        if any(map(math.isfinite, ends)):
            both = "/".join(numbers.format_signed_degrees(end).removesuffix("°") for end in ends)
            parts.append(f"{_joint_name(joint)} {both}")
    if (total := values.get((f"TAM{finger}", mode))) is not None:
        parts.append(f"{_total_name(mode)} {numbers.format_degrees(total)}")
    if (gap_cm := values.get((f"TIP_TO_PALM{finger}", mode))) is not None:
        gap = value_words(find_manual_measure(f"TIP_TO_PALM{finger}"), gap_cm)
        parts.append(tr("fingertip to palm {distance}").format(distance=gap))
    who = f"{long_finger_name(str(finger))}, {mode_name(mode)}"
    return f"{who}: {', '.join(parts)}" if parts else ""


def find_changes(values: Sequence[ManualValue]) -> list[tuple[MeasureKey, ManualChange]]:
    """Return first and last value of each measure that was taken on two days or more.

    The total of a finger stands for its joints.
    """
    changes = {key: compute_change(value_history(values, key)) for key in sort_keys(values)}
    found = {key: change for key, change in changes.items() if change is not None}
    return [(key, change) for key, change in found.items() if _total_key(key) not in found]


def list_other_values(values: Sequence[ManualValue], shown: Iterable[MeasureKey]) -> list[ManualValue]:
    """Return the values whose measure, and whose finger's total, is not shown."""
    keys = set(shown)
    return [one for one in values if not keys & {one.key, _total_key(one.key)}]


def _total_key(key: MeasureKey) -> MeasureKey | None:
    """Return the key of the total that a finger joint is part of, None for any other measure."""
    joint = key[0].partition("_")[0]
    return (f"TAM{joint[-1]}", *key[1:]) if any(joint in joints for joints in FINGER_JOINTS.values()) else None
