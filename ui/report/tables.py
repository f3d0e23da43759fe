"""The range-of-motion table in words, the same on the review screen and on the page."""

from __future__ import annotations

import math
from dataclasses import dataclass

from core.output.range_rows import RangeRow
from core.output.report_content import Comparison, SessionFigures, compare, usual_deg
from ui import numbers, terms
from ui.plot.style import CURVE_TOKENS
from ui.translate import tr
from ui.verdicts import change_short, change_with_limit, reason_words


@dataclass(frozen=True, slots=True)
class TableRow:
    """One movement as the columns show it; ``token`` colours its mark, empty for none."""

    movement: str
    today: str
    best: str
    other_hand: str
    usual: str
    last: str
    change: str
    short_change: str = ""
    token: str = ""
    verdict: str = ""


def column_names(figures: SessionFigures, previous: SessionFigures | None, other: SessionFigures | None) -> TableRow:
    """Heads of the columns; a column without content has an empty head."""
    day = numbers.day_beside(previous.when, figures.when) if previous else ""
    return TableRow(
        movement=tr("Movement"),
        today=tr("Today, mean ± sd"),
        best=tr("Best"),
        other_hand=terms.hand_name(other.side) if other else "",
        usual=tr("Usual (adults)"),
        last=day,
        change=tr("Change since {day}").format(day=day) if day else "",
    )


def table_rows(
    figures: SessionFigures, previous: SessionFigures | None, other: SessionFigures | None
) -> list[TableRow]:
    """Arc first, then its two ends, what should have stayed still, and the speed."""
    changes = {(item.movement, item.angle): item for item in compare(previous, figures)} if previous else {}
    out = [_range_row(row, figures, previous, other, changes.get((row.movement, row.angle))) for row in figures.rows]
    for angle in (0, 1, 2):
        if math.isfinite(figures.trick_deg[angle]):
            out.append(_trick_row(angle, figures, previous))
    if figures.peak_speed.count:
        out.append(_speed_row(figures, previous, other))
    return out


def repetition_words(figures: SessionFigures) -> str:
    """``mean of 9 repetitions; number 7 left out: pain``: always n and what is left out."""
    if not figures.repetitions:
        return tr("one range over the whole recording; no repetitions")
    counted = figures.counted
    words = tr("1 repetition") if counted == 1 else tr("mean of {count} repetitions").format(count=counted)
    parts = [words]
    for number, repetition in enumerate(figures.repetitions, 1):
        if repetition.reason:
            parts.append(tr("number {number} left out: {reason}").format(number=number, reason=repetition.reason))
        elif repetition.too_hidden:
            parts.append(tr("number {number} left out: not seen well enough").format(number=number))
    return "; ".join(parts)


def mean_words(row: RangeRow) -> str:
    """``57° ± 2°``; single values listed where there are fewer than three."""
    if 1 < row.count < 3:
        return ", ".join(numbers.degrees(value) for value in row.values_deg)
    return numbers.with_spread(row.mean_deg, row.sd_deg)


def _range_row(
    row: RangeRow, figures: SessionFigures, previous: SessionFigures | None, other: SessionFigures | None,
    change: Comparison | None,
) -> TableRow:  # fmt: skip
    name = terms.movement_name(row.movement)
    if figures.exercise.angle is None and row.movement == "arc":
        name = terms.arc_name(row.angle)
    before, beside = (item.row(row.movement, row.angle) if item else None for item in (previous, other))
    words = ""
    if change is not None:
        words = change_with_limit(change.verdict, change.shown_difference_deg, change.limit_deg)
        words = words or tr("not judged: {why}").format(why=reason_words(change.reasons))
    short = "" if change is None else change_short(change.verdict, change.shown_difference_deg, change.limit_deg)
    if row.limited:
        words = "; ".join(part for part in (words, tr("limited by the camera's view")) if part)
        short = "; ".join(part for part in (short, tr("limited by view")) if part)
    usual = usual_deg(row.movement, row.angle)
    return TableRow(
        movement=name,
        today=mean_words(row),
        best=numbers.degrees(row.best_deg),
        other_hand=numbers.degrees(beside.mean_deg) if beside else "",
        usual=numbers.UNKNOWN if usual is None else _range(*usual),
        last=numbers.degrees(before.mean_deg) if before else "",
        change=words,
        short_change=short or words,
        token="" if row.movement == "arc" else CURVE_TOKENS[row.angle],
        verdict=change.verdict if change else "",
    )


def _trick_row(angle: int, figures: SessionFigures, previous: SessionFigures | None) -> TableRow:
    limit = figures.exercise.trick_limit_deg
    value = float(figures.trick_deg[angle])
    inside = value <= limit
    names = {0: tr("Side movement"), 1: tr("Up and down"), 2: tr("Turning")}
    before = float(previous.trick_deg[angle]) if previous else math.nan
    return TableRow(
        movement=names[angle],
        today=tr("{angle} at most").format(angle=numbers.degrees(value)),
        best="",
        other_hand="",
        usual=tr("under {angle}").format(angle=numbers.degrees(limit)),
        last=numbers.degrees(before) if math.isfinite(before) else "",
        change=tr("as asked: the hand stays in line") if inside else tr("more than asked: watch the exercise"),
        token=CURVE_TOKENS[angle],
        verdict="" if inside else "warn",
    )


def _speed_row(figures: SessionFigures, previous: SessionFigures | None, other: SessionFigures | None) -> TableRow:
    speed = figures.peak_speed
    spread = f"{numbers.NARROW_GAP}±{numbers.NARROW_GAP}{speed.sd:.0f}" if math.isfinite(speed.sd) else ""
    return TableRow(
        movement=tr("Peak speed"),
        today=f"{speed.mean:.0f}{spread}°/s",
        best=numbers.speed(speed.best),
        other_hand=numbers.speed(other.peak_speed.mean) if other else "",
        usual=numbers.UNKNOWN,
        last=numbers.speed(previous.peak_speed.mean) if previous else "",
        change=tr("not judged: no error limit is known") if previous else "",
        short_change=tr("not judged") if previous else "",
    )


def _range(low: float, high: float) -> str:
    return f"{low:.0f}°" if low == high else f"{low:.0f}–{high:.0f}°"
