"""Texts of the task measures: reach, fingertips, coordination and tremor."""

from __future__ import annotations

import math
from collections.abc import Sequence

from carpus.core.measures.coordination import MIN_TREMOR_FPS
from carpus.core.model.phrase import phrase
from carpus.core.model.rounding import format_rounded
from carpus.core.results.measure import Measure
from carpus.core.results.session_results import SessionResults
from carpus.core.results.task_measures import QUANTITIES
from carpus.ui.kit import numbers
from carpus.ui.kit.fonts import SEMIBOLD
from carpus.ui.kit.table import TableColumn, TableContent, TableRow
from carpus.ui.kit.translate import tr, translate_phrase

# The return stroke beside each outward one.
_RETURN_STROKES = {"reach": "return", "thumb across": "thumb back"}
_STROKE_NAMES = {
    "reach": phrase("{name}, outward"), "return": phrase("{name}, return"),
    "thumb across": phrase("{name}, across the palm"), "thumb back": phrase("{name}, return"),
}  # fmt: skip
_DIGITS = {
    "1": phrase("thumb"), "2": phrase("index"), "3": phrase("middle"), "4": phrase("ring"), "5": phrase("little"),
}  # fmt: skip
_UNKNOWN = {
    "too_slow": phrase("too slow to assess"),
    "hidden": phrase("occluded"),
    "few_frames": phrase("not available: fewer than {count} frames a second", count=round(MIN_TREMOR_FPS)),
    "failed": phrase("not available: the calculation failed"),
}
# Units that are not shown as they stand in files.
_UNITS = {"deg": "°", "deg/s": "°/s", "1": "", "r": "", "SPARC": "", "length/chord": ""}

# Name, today's value and last time's, twice.
TASK_COLUMNS = (TableColumn(token="text2"), TableColumn(SEMIBOLD), TableColumn(is_right_aligned=True, is_wrapped=False))


def task_table(
    results: SessionResults, previous: SessionResults | None = None, *, is_for_research: bool = True
) -> TableContent:
    """Return the task measures, two to a line: SPARC and opposition's paths are for research."""
    cells: list[TableRow] = [
        (measure_name(item), value_words(item), _last_value(item, previous))
        for item in _pair_strokes(results.measures_in_group("task"))
        if (math.isfinite(item.mean) or _is_listed(item))
        and (is_for_research or ("thumb " not in item.subject and item.quantity != "smoothness"))
    ]
    cells += [("", "", "")] * (len(cells) % 2)
    day = numbers.format_distinct_day(previous.when, results.when) if previous is not None else ""
    rows = tuple((*one, *other) for one, other in zip(cells[::2], cells[1::2], strict=True))
    return TableContent(TASK_COLUMNS * 2, ("", "", day) * 2, rows)


def _is_listed(item: Measure) -> bool:
    """Return whether an unknown measure has a line: of occluded strokes only the first one."""
    hidden_way = item.unknown_reason == "hidden" and item.subject in _STROKE_NAMES
    return bool(item.unknown_reason) and (not hidden_way or item.quantity == "movement time")


def _pair_strokes(measures: Sequence[Measure]) -> list[Measure]:
    back = {item.key: item for item in measures if item.subject in _RETURN_STROKES.values()}
    out = []
    for item in measures:
        if item.subject in _RETURN_STROKES:
            beside = back.pop((_RETURN_STROKES[item.subject], item.quantity), None)
            out += [item] if beside is None else [item, beside]
        elif item.subject not in _RETURN_STROKES.values() or item.key in back:
            out.append(item)
    return out


def _last_value(item: Measure, previous: SessionResults | None) -> str:
    before = None if previous is None else previous.find(*item.key)
    if before is None or not math.isfinite(before.mean):
        return ""
    return _value(before).replace(tr("extension"), tr("ext.")).replace(tr("flexion"), tr("flex."))


def measure_name(item: Measure) -> str:
    """Return the name of a measure, such as ``Path length, outward``."""
    name = translate_phrase(QUANTITIES[item.quantity].name)
    if item.subject in _STROKE_NAMES:
        return translate_phrase(_STROKE_NAMES[item.subject]).format(name=name)
    digits = [_DIGITS.get(part[3:4]) for part in item.subject.replace(", ", "-").split("-")]
    one, other = (numbers.UNKNOWN if digit is None else translate_phrase(digit) for digit in (digits * 2)[:2])
    return name.format(one=one, other=other)


def value_words(item: Measure) -> str:
    """Return ``0.87 ± 0.05 s``: the mean, and the SD of three values or more."""
    if item.unknown_reason:
        return translate_phrase(_UNKNOWN[item.unknown_reason])
    quantity = QUANTITIES[item.quantity]
    if not math.isfinite(item.sd) or item.unit == "share" or quantity.directions:
        return _value(item)
    gap, unit = numbers.NARROW_GAP, _unit(item)
    number, spread = (numbers.format_fixed(value, quantity.decimals) for value in (item.mean, item.sd))
    number = number.replace("-", "\N{MINUS SIGN}")
    return f"{number}{unit if item.unit == 'deg' else ''}{gap}±{gap}{spread}{unit}"


def _unit(item: Measure) -> str:
    return _UNITS.get(item.unit, f"{numbers.NARROW_GAP}{item.unit}")


def _value(item: Measure) -> str:
    value, quantity = item.mean, QUANTITIES[item.quantity]
    if quantity.directions:
        return f"{numbers.format_degrees(value)} {translate_phrase(quantity.directions[value < 0])}"
    if item.unit == "share":
        return f"{format_rounded(100.0 * value)}{numbers.NARROW_GAP}%"
    return numbers.format_fixed(value, quantity.decimals).replace("-", "\N{MINUS SIGN}") + _unit(item)


def task_summary(results: SessionResults) -> str:
    """Return the results of a reach or of opposition in a sentence; empty for other exercises."""

    def describe(of: str, what: str) -> str:
        item = _find_value(results, of, what)
        return numbers.UNKNOWN if item is None else _value(item)

    if results.exercise.is_task and _find_value(results, "reach", "movement time") is not None:
        words = tr("Reach {time}, peak speed {speed}, path ratio {straight}, grip aperture {opening}, wrist {wrist}")
        return words.format(
            time=describe("reach", "movement time"), speed=describe("reach", "peak speed"),
            straight=describe("reach", "straightness"), opening=describe("TIP1-TIP2", "largest aperture"),
            wrist=describe("wrist", "wrist extension at grasp"),
        )  # fmt: skip
    touches = _touches(results)
    hidden = sum(bool(item.unknown_reason) for item in touches)
    if not touches:
        return ""
    if hidden == len(touches):
        return tr("Thumb contact was occluded")
    words = tr("The thumb touched {met} of {all} fingertips").format(met=_count_touches(touches), all=len(touches))
    return tr("{words}; {hidden} occluded").format(words=words, hidden=hidden) if hidden else words


def short_task_summary(results: SessionResults) -> str:
    """Return the same for a narrow column, such as ``Touched 3 of 4``."""
    reach, touches = _find_value(results, "reach", "movement time"), _touches(results)
    if results.exercise.is_task and reach is not None:
        return tr("Reach {time}").format(time=_value(reach))
    if any(item.unknown_reason for item in touches):
        return tr("Thumb contact occluded")
    return (
        tr("Touched {met} of {all} fingertips").format(met=_count_touches(touches), all=len(touches)) if touches else ""
    )


def _find_value(results: SessionResults, of: str, what: str) -> Measure | None:
    item = results.find(of, what)
    return item if item is not None and math.isfinite(item.mean) else None


def _touches(results: SessionResults) -> list[Measure]:
    return [item for item in results.measures_in_group("task") if item.quantity == "touches"]


def _count_touches(touches: Sequence[Measure]) -> int:
    return sum(item.mean > 0.0 for item in touches)


def task_title(results: SessionResults) -> str:
    """Return the title of the task measures."""
    return translate_phrase(results.exercise.task_title)
