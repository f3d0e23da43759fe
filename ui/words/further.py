"""What an exercise has beside its ranges, in words: reaches, finger tips, moving together, tremor."""

from __future__ import annotations

import math
from collections.abc import Sequence

from carpus.core.measures.together import TREMOR_LEAST_FPS
from carpus.core.phrase import phrase
from carpus.core.results.figures import SessionFigures
from carpus.core.results.further_measures import QUANTITIES
from carpus.core.results.measure import Measure
from carpus.core.rounding import written
from carpus.ui import numbers
from carpus.ui.fonts import SEMIBOLD
from carpus.ui.translate import say, tr
from carpus.ui.words.table import TableColumn, TableLine, TableWords

_BACK_OF = {"reach": "return", "thumb across": "thumb back"}
"""Of each way out the way back, which stands beside it."""
_WAYS = {
    "reach": phrase("{name}, out"), "return": phrase("{name}, back"),
    "thumb across": phrase("{name}, across"), "thumb back": phrase("{name}, back"),
}  # fmt: skip
_DIGITS = {
    "1": phrase("thumb"), "2": phrase("index"), "3": phrase("middle"), "4": phrase("ring"), "5": phrase("little"),
}  # fmt: skip
_UNKNOWN = {
    "too_slow": phrase("too slow to judge"),
    "hidden": phrase("hidden from the camera"),
    "few_frames": phrase("not available: fewer than {count} frames a second", count=round(TREMOR_LEAST_FPS)),
    "failed": phrase("not available: it could not be computed"),
}


FURTHER_COLUMNS = (TableColumn(token="text2"), TableColumn(SEMIBOLD), TableColumn(ends=True, wraps=False))
"""Name, today's value and last time's, twice."""


def further_table(figures: SessionFigures, previous: SessionFigures | None = None) -> TableWords:
    """All of them in the order in which they are read, two to a line: the way out beside the way back."""
    cells: list[TableLine] = [
        (measure_name(item), value_words(item), _last(item, previous))
        for item in _paired(figures.group("task"))
        if math.isfinite(item.mean) or _worth_saying(item)
    ]
    cells += [("", "", "")] * (len(cells) % 2)
    day = numbers.day_beside(previous.when, figures.when) if previous is not None else ""
    rows = tuple((*one, *other) for one, other in zip(cells[::2], cells[1::2], strict=True))
    return TableWords(FURTHER_COLUMNS * 2, ("", "", day) * 2, rows)


def _worth_saying(item: Measure) -> bool:
    """Whether a measure that is not known has a line: of ways that were hidden the first one says it for all."""
    hidden_way = item.unknown == "hidden" and item.of in _WAYS
    return bool(item.unknown) and (not hidden_way or item.what == "movement time")


def _paired(further: Sequence[Measure]) -> list[Measure]:
    """Ways out and back in turns; the rest as it comes."""
    back = {item.key: item for item in further if item.of in _BACK_OF.values()}
    out = []
    for item in further:
        if item.of in _BACK_OF:
            beside = back.pop((_BACK_OF[item.of], item.what), None)
            out += [item] if beside is None else [item, beside]
        elif item.of not in _BACK_OF.values() or item.key in back:
            out.append(item)
    return out


def _last(item: Measure, previous: SessionFigures | None) -> str:
    before = None if previous is None else previous.find(*item.key)
    if before is None or not math.isfinite(before.mean):
        return ""
    return _value(before).replace(tr("extension"), tr("ext.")).replace(tr("flexion"), tr("flex."))


def measure_name(item: Measure) -> str:
    """``Path length, out``; ``Thumb to ring finger, nearest``."""
    name = say(QUANTITIES[item.what].name)
    if item.of in _WAYS:
        return say(_WAYS[item.of]).format(name=name)
    if "{one}" in name:
        one, other = (say(_DIGITS[part[3:4]]) for part in item.of.replace(", ", "-").split("-"))
        return name.format(one=one, other=other)
    return name


def value_words(item: Measure) -> str:
    """``0.87 ± 0.05 s``: the mean, and the spread of three or more; single values have none."""
    if item.unknown:
        return say(_UNKNOWN[item.unknown])
    shown = _value(item)
    if not math.isfinite(item.sd) or item.unit in ("share", "deg"):
        return shown
    number, gap, unit = shown.partition(numbers.NARROW_GAP)
    spread = numbers.fixed(item.sd, QUANTITIES[item.what].decimals)
    return f"{number}{numbers.NARROW_GAP}±{numbers.NARROW_GAP}{spread}{gap}{unit}"


def _value(item: Measure) -> str:
    value, gap = item.mean, numbers.NARROW_GAP
    if item.what == "wrist extension at grasp":
        return f"{numbers.degrees(value)} {tr('extension') if value >= 0 else tr('flexion')}"
    if item.unit == "share":
        return f"{written(100.0 * value)}{gap}%"
    number = numbers.fixed(value, QUANTITIES[item.what].decimals).replace("-", "\N{MINUS SIGN}")
    unit = {"deg": "°", "s": f"{gap}s", "mm": f"{gap}mm", "mm/s": f"{gap}mm/s"}.get(item.unit, "")
    return f"{number}{unit}"


def main_words(figures: SessionFigures) -> str:
    """What is said of a reach or of opposition in a line: ``out in 1.19 s at 548 mm/s``; empty for other exercises."""

    def describe(of: str, what: str) -> str:
        item = _known(figures, of, what)
        return numbers.UNKNOWN if item is None else _value(item)

    if figures.exercise.is_task and _known(figures, "reach", "movement time") is not None:
        words = tr("Out in {time}, fastest {speed}, way {straight} of straight, opened {opening}, wrist {wrist}")
        return words.format(
            time=describe("reach", "movement time"), speed=describe("reach", "peak speed"),
            straight=describe("reach", "straightness"), opening=describe("TIP1-TIP2", "largest aperture"),
            wrist=describe("wrist", "wrist extension at grasp"),
        )  # fmt: skip
    touches = _touches(figures)
    hidden = sum(bool(item.unknown) for item in touches)
    if not touches:
        return ""
    if hidden == len(touches):
        return tr("Whether the thumb touched the finger tips was hidden from the camera")
    words = tr("The thumb touched {met} of {all} finger tips").format(met=_met(touches), all=len(touches))
    return tr("{words}; of {hidden} the camera did not see it").format(words=words, hidden=hidden) if hidden else words


def short_words(figures: SessionFigures) -> str:
    """The same for a narrow column: ``Out in 1.19 s``, ``Touched 3 of 4``; empty for other exercises."""
    reach, touches = _known(figures, "reach", "movement time"), _touches(figures)
    if figures.exercise.is_task and reach is not None:
        return tr("Out in {time}").format(time=_value(reach))
    if any(item.unknown for item in touches):
        return tr("Touches hidden")
    return tr("Touched {met} of {all}").format(met=_met(touches), all=len(touches)) if touches else ""


def _known(figures: SessionFigures, of: str, what: str) -> Measure | None:
    item = figures.find(of, what)
    return item if item is not None and math.isfinite(item.mean) else None


def _touches(figures: SessionFigures) -> list[Measure]:
    return [item for item in figures.group("task") if item.what == "touches"]


def _met(touches: Sequence[Measure]) -> int:
    return sum(item.mean > 0.0 for item in touches)


def further_title(figures: SessionFigures) -> str:
    """What the measures are about."""
    return say(figures.exercise.further_title)
