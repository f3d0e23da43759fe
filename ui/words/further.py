"""What an exercise has beside its ranges, in words: reaches, finger tips, moving together, tremor."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from carpus.core.measures.together import TREMOR_LEAST_FPS
from carpus.core.results.figures import SessionFigures
from carpus.core.results.further_measures import FurtherMeasure
from carpus.core.rounding import written
from carpus.ui import numbers
from carpus.ui.translate import say, tr

_WAYS = {"reach": "return", "thumb across": "thumb back"}
"""Of each way out the way back, which stands beside it."""


@dataclass(frozen=True, slots=True)
class FurtherRow:
    """One figure: what it is, today's value and last time's; empty where there is none."""

    name: str
    today: str
    last: str = ""


def further_rows(figures: SessionFigures, previous: SessionFigures | None = None) -> list[FurtherRow]:
    """All of them in the order in which they are read, two to a line: the way out beside the way back."""
    before = {} if previous is None else {(item.name, item.of): item for item in previous.further}
    return [
        FurtherRow(measure_name(item), value_words(item), _last(before.get((item.name, item.of))))
        for item in _paired(figures.further)
        if math.isfinite(item.mean) or _worth_saying(item)
    ]


def _worth_saying(item: FurtherMeasure) -> bool:
    """Whether a figure that is not known has a line: of ways that were hidden the first one says it for all."""
    hidden_way = item.unknown == "hidden" and item.of in {*_WAYS, *_WAYS.values()}
    return bool(item.unknown) and (not hidden_way or item.name == "movement time")


def _paired(further: Sequence[FurtherMeasure]) -> list[FurtherMeasure]:
    """Ways out and back in turns; the rest as it comes."""
    back = {(item.name, item.of): item for item in further if item.of in _WAYS.values()}
    out = []
    for item in further:
        if item.of in _WAYS:
            beside = back.pop((item.name, _WAYS[item.of]), None)
            out += [item] if beside is None else [item, beside]
        elif item.of not in _WAYS.values() or (item.name, item.of) in back:
            out.append(item)
    return out


def _last(item: FurtherMeasure | None) -> str:
    if item is None or not math.isfinite(item.mean):
        return ""
    shown = _value(item, item.mean)
    return shown.replace(tr("extension"), tr("ext.")).replace(tr("flexion"), tr("flex."))


def measure_name(item: FurtherMeasure) -> str:
    """``Path length, out``; ``Thumb to ring finger, nearest``."""
    way = {
        "reach": tr("{name}, out"), "return": tr("{name}, back"), "thumb across": tr("{name}, across"),
        "thumb back": tr("{name}, back"),
    }.get(item.of)  # fmt: skip
    name = {
        "movement time": tr("Movement time"),
        "peak speed": tr("Peak speed"),
        "time to peak": tr("Peak reached after"),
        "path length": tr("Length of the way"),
        "straightness": tr("Way / straight line"),
        "movement units": tr("Peaks of speed"),
        "smoothness": tr("Smoothness (SPARC)"),
        "largest aperture": tr("Widest opening, thumb–index"),
        "wrist extension at grasp": tr("Wrist at the grasp"),
        "hand span": tr("Hand span, thumb–little"),
        "thumb hidden": tr("Thumb hidden"),
        "coherent though hidden": tr("Its pose coherent meanwhile"),
        "known though hidden": tr("Its pose known to 15° meanwhile"),
        "jump when seen again": tr("Jump when seen again"),
        "synergy": tr("All fingers as one movement"),
        "tremor 3-12 Hz": tr("Tremor, 3 to 12 Hz (rms)"),
        "repetitions": tr("Repetitions"),
        "ranges": tr("Range of motion"),
        "ranges of joints": tr("Range of motion, fingers"),
        "other movements": tr("Movement of the other angles"),
        "speed": tr("Speed and smoothness"),
        "quality": tr("Quality of the recording"),
        "grades": tr("Grades"),
        "reaches": tr("Reaching movements"),
        "opposition": tr("Thumb opposition"),
    }.get(item.name, item.name)
    if way is not None:
        return way.format(name=name)
    if item.name in ("co-flexion", "lag", "enslaving", "tip span", "least distance", "touches"):
        return _of_two(item)
    return name


def _of_two(item: FurtherMeasure) -> str:
    short = {"1": tr("thumb"), "2": tr("index"), "3": tr("middle"), "4": tr("ring"), "5": tr("little")}
    one, other = (short.get(part[3:4], part) for part in item.of.replace(", ", "-").split("-"))
    pattern = {
        "co-flexion": tr("Bend together, {one}–{other} (r)"),
        "lag": tr("Lag of {other} after {one}"),
        "enslaving": tr("How far {other} moves with {one}"),
        "tip span": tr("Widest span, {one}–{other}"),
        "least distance": tr("Nearest, {one}–{other}"),
        "touches": tr("Touches, {one}–{other}"),
    }[item.name]
    return pattern.format(one=one, other=other)


def value_words(item: FurtherMeasure) -> str:
    """``0.87 ± 0.05 s``: the mean, and the spread of three or more; single values have none."""
    if item.unknown:
        return {
            "too_slow": tr("too slow to judge"),
            "hidden": tr("hidden from the camera"),
            "few_frames": tr("not available: fewer than {count} frames a second").format(count=round(TREMOR_LEAST_FPS)),
        }.get(item.unknown, tr("not available: it could not be computed"))
    shown = _value(item, item.mean)
    if not math.isfinite(item.sd) or item.unit in ("share", "deg"):
        return shown
    number, gap, unit = shown.partition(numbers.NARROW_GAP)
    return f"{number}{numbers.NARROW_GAP}±{numbers.NARROW_GAP}{numbers.fixed(item.sd, _decimals(item))}{gap}{unit}"


def _decimals(item: FurtherMeasure) -> int:
    return {"s": 2, "mm/s": 0, "mm": 0, "length/chord": 2, "1": 1, "SPARC": 2, "deg": 0, "r": 2}.get(item.unit, 0)


def _value(item: FurtherMeasure, value: float) -> str:
    gap, decimals = numbers.NARROW_GAP, _decimals(item)
    if item.name == "wrist extension at grasp":
        side = tr("extension") if value >= 0 else tr("flexion")
        return f"{numbers.degrees(value)} {side}"
    if item.unit == "share":
        return f"{written(100.0 * value)}{gap}%"
    if item.name == "touches":
        return written(value)
    if item.name == "tremor 3-12 Hz":
        return f"{numbers.fixed(value, 1)}°"
    number = numbers.fixed(value, decimals).replace("-", "\N{MINUS SIGN}")
    unit = {"deg": "°", "length/chord": "", "1": "", "SPARC": "", "r": ""}.get(item.unit, f"{gap}{item.unit}")
    return f"{number}{unit}"


def main_words(figures: SessionFigures) -> str:
    """What is said of a reach or of opposition in a line: ``out in 1.19 s at 548 mm/s``; empty for other exercises."""
    named = _known(figures)

    def of(name: str, what: str) -> str:
        item = named.get((name, what))
        return numbers.UNKNOWN if item is None else _value(item, item.mean)

    if figures.exercise.is_task and ("movement time", "reach") in named:
        words = tr("Out in {time}, fastest {speed}, way {straight} of straight, opened {opening}, wrist {wrist}")
        return words.format(
            time=of("movement time", "reach"), speed=of("peak speed", "reach"),
            straight=of("straightness", "reach"), opening=of("largest aperture", "TIP1-TIP2"),
            wrist=of("wrist extension at grasp", "wrist"),
        )  # fmt: skip
    touches = _touches(figures)
    if touches:
        words = tr("The thumb touched {met} of {all} finger tips").format(met=_met(touches), all=len(touches))
        hidden = sum(bool(item.unknown) for item in touches)
        if hidden == len(touches):
            return tr("Whether the thumb touched the finger tips was hidden from the camera")
        return (
            tr("{words}; of {hidden} the camera did not see it").format(words=words, hidden=hidden) if hidden else words
        )
    return ""


def short_words(figures: SessionFigures) -> str:
    """The same for a narrow column: ``Out in 1.19 s``, ``Touched 3 of 4``; empty for other exercises."""
    named = _known(figures)
    reach = named.get(("movement time", "reach"))
    if figures.exercise.is_task and reach is not None:
        return tr("Out in {time}").format(time=_value(reach, reach.mean))
    touches = _touches(figures)
    if touches:
        if any(item.unknown for item in touches):
            return tr("Touches hidden")
        return tr("Touched {met} of {all}").format(met=_met(touches), all=len(touches))
    return ""


def _known(figures: SessionFigures) -> dict[tuple[str, str], FurtherMeasure]:
    return {(item.name, item.of): item for item in figures.further if math.isfinite(item.mean)}


def _touches(figures: SessionFigures) -> list[FurtherMeasure]:
    return [item for item in figures.further if item.name == "touches"]


def _met(touches: Sequence[FurtherMeasure]) -> int:
    return sum(item.mean > 0.0 for item in touches)


def further_title(figures: SessionFigures) -> str:
    """What the figures are about."""
    return say(figures.exercise.further_title)
