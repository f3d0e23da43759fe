"""The range-of-motion table in words, the same on the review screen and on the page."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from carpus.core.results.figures import SessionFigures
from carpus.core.results.norms import wrist_norm
from carpus.core.results.progress import Comparison, compare
from carpus.core.results.ranges import RangeRow
from carpus.core.results.repetition_rows import PASSIVE
from carpus.core.rounding import written
from carpus.ui import numbers, terms
from carpus.ui.theme import CURVE_TOKENS
from carpus.ui.translate import say, tr
from carpus.ui.verdicts import change_short, change_with_limit, reason_words


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
    day = numbers.since(previous.when, figures.when) if previous else ""
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
    if figures.speed.peak_speed.count or too_slow(figures):
        out.append(_speed_row(figures, previous, other))
    return out


def norm_words(figures: SessionFigures) -> str:
    """Where the usual values are from and whom they cover; empty where none is shown."""
    norms = [wrist_norm(row.movement, row.angle, figures.exercise) for row in figures.rows]
    return next((say(norm.sentence()) for norm in norms if norm is not None), "")


def too_slow(figures: SessionFigures) -> bool:
    """Whether there are strokes, and of all of them the speed is lost in the tracker's noise."""
    return figures.speed.too_slow > 0 and not figures.speed.peak_speed.count


def repetition_words(figures: SessionFigures) -> str:
    """``mean of 9 repetitions; number 7 left out: pain``: always n and what is left out."""
    if not any(repetition.is_whole for repetition in figures.repetitions):
        ways = [len(item.values) for item in figures.further if item.name == "movement time"]
        if ways:
            words = tr("{count} ways out and back; ranges over the whole recording").format(count=sum(ways))
            return "; ".join([words, *_without_passive(figures)])
        words = "; ".join([_why_none(figures), *_without_passive(figures)])
    else:
        counted = figures.counted
        words = tr("mean of {count} repetitions").format(count=counted) if counted else tr("no active repetition")
        if counted == 1:
            words = tr("1 repetition")
    parts = [words]
    if helped := sum(repetition.helped for repetition in figures.repetitions):
        parts.append(tr("1 passive beside it") if helped == 1 else tr("{count} passive beside it").format(count=helped))
    unmeasured = {
        "hidden": tr("not seen well enough"),
        "cut_by_start": tr("the recording began in it"),
        "cut_by_gap": tr("the hand went out of sight in it"),
        "cut_by_end": tr("the recording ended in it"),
    }
    for number, repetition in enumerate(figures.repetitions, 1):
        if not (repetition.counts or repetition.helped):
            said = "" if repetition.reason == PASSIVE else repetition.reason
            reason = said or unmeasured[repetition.unmeasured]
            parts.append(tr("number {number} left out: {reason}").format(number=number, reason=reason))
    return _with_unseen(parts, figures)


def _without_passive(figures: SessionFigures) -> list[str]:
    return [tr("without what was passive")] if figures.without_passive else []


def _why_none(figures: SessionFigures) -> str:
    whole = tr("one range over the whole recording; no repetitions")
    why = {
        "too_short": tr("it is too short"),
        "nothing_seen": tr("what is trained was not seen"),
        "small_range": tr("less than 10° of movement"),
        "cut_by_gap": tr("the hand went out of sight during the movement"),
        "no_return": tr("it never went there and back"),
        "too_quick": tr("each was quicker than 0.4 s"),
        None: "",
    }[figures.uncounted]
    return f"{whole}: {why}" if why else whole


def _with_unseen(parts: list[str], figures: SessionFigures) -> str:
    """Nothing is counted where nothing was seen for long: that much of the recording is not in the number."""
    if figures.exercise.counts and figures.unseen_s >= 1.0:
        seconds = written(figures.unseen_s)
        parts = [*parts, tr("{seconds} s not seen and not counted").format(seconds=seconds)]
    return "; ".join(parts)


def mean_words(row: RangeRow) -> str:
    """``57° ± 2°``: the spread between repetitions, of a single one the tracker's own; two are listed."""
    if 1 < row.count < 3:
        degrees = numbers.signed_degrees if row.movement in terms.FOREARM else numbers.degrees
        return ", ".join(degrees(value) for value in row.values_deg)
    words = numbers.with_spread(row.mean_deg, row.sd_deg if prints_spread(row) else row.measurement_sd_deg)
    is_short = row.movement in terms.FOREARM and numbers.signed_degrees(row.mean_deg) != numbers.degrees(row.mean_deg)
    return f"\N{MINUS SIGN}{words}" if is_short else words


def prints_spread(row: RangeRow) -> bool:
    """Whether what stands after its ± is the spread between repetitions, not the tracker's sd."""
    return math.isfinite(row.sd_deg)


def is_deficit(row: RangeRow) -> bool:
    """Whether an end of the wrist's movement was never reached: the other one does not come back to neutral. A forearm
    that does not come to thumb up has a value below zero."""
    return not row.joint and row.movement not in ("arc", *terms.FOREARM) and row.mean_deg < 0.0


def turned(row: RangeRow) -> RangeRow:
    """A deficit counted upwards."""
    values = tuple(-value for value in row.values_deg)
    return replace(row, mean_deg=-row.mean_deg, best_deg=-row.best_deg, values_deg=values)


def _range_row(
    row: RangeRow, figures: SessionFigures, previous: SessionFigures | None, other: SessionFigures | None,
    change: Comparison | None,
) -> TableRow:  # fmt: skip
    name = terms.movement_name(row.movement)
    if is_deficit(row):
        name, row = terms.deficit_name(row.movement), turned(row)
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
    norm = wrist_norm(row.movement, row.angle, figures.exercise)
    return TableRow(
        movement=name,
        today=mean_words(row),
        best=terms.end_words(row.best_deg, row.movement),
        other_hand=terms.end_words(beside.mean_deg, row.movement) if beside else "",
        usual=numbers.UNKNOWN if norm is None else _range(norm.low_deg, norm.high_deg),
        last=terms.end_words(before.mean_deg, row.movement) if before else "",
        change=words,
        short_change=short or words,
        token="" if row.movement == "arc" else CURVE_TOKENS[row.angle],
        verdict=change.verdict if change else "",
    )


def _trick_row(angle: int, figures: SessionFigures, previous: SessionFigures | None) -> TableRow:
    limit = figures.exercise.trick_limit_deg
    value = float(figures.trick_deg[angle])
    inside = value <= limit
    names = {0: tr("Side movement"), 1: tr("Up and down"), 2: tr("Rotation from the start")}
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
    speed = figures.speed.peak_speed
    spread = f"{numbers.NARROW_GAP}±{numbers.NARROW_GAP}{written(speed.sd)}" if math.isfinite(speed.sd) else ""
    return TableRow(
        movement=tr("Peak speed"),
        today=tr("too slow to judge") if too_slow(figures) else f"{written(speed.mean)}{spread}°/s",
        best="" if too_slow(figures) else numbers.speed(speed.best),
        other_hand=numbers.speed(other.speed.peak_speed.mean) if other else "",
        usual=numbers.UNKNOWN,
        last=numbers.speed(previous.speed.peak_speed.mean) if previous else "",
        change=tr("not judged: no error limit is known") if previous else "",
        short_change=tr("not judged") if previous else "",
    )


def _range(low: float, high: float) -> str:
    return f"{written(low)}°" if low == high else f"{written(low)}–{written(high)}°"
