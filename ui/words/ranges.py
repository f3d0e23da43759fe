"""The range-of-motion table in words, the same on the review screen and on the page."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from carpus.core.hand.exercises import STILL_NAMES
from carpus.core.measures.repetitions import Uncounted
from carpus.core.phrase import Phrase, phrase
from carpus.core.results.figures import SessionFigures
from carpus.core.results.measure import Measure, turn_round
from carpus.core.results.norms import wrist_norm
from carpus.core.results.progress import Comparison, compare
from carpus.core.results.repetition_rows import PASSIVE
from carpus.core.rounding import written
from carpus.ui import numbers, terms
from carpus.ui.theme import CURVE_TOKENS
from carpus.ui.translate import say, tr
from carpus.ui.verdicts import change_short, change_with_limit, reason_words

_UNMEASURED: Mapping[str, Phrase] = {
    "hidden": phrase("not seen well enough"),
    "cut_by_start": phrase("the recording began in it"),
    "cut_by_gap": phrase("the hand went out of sight in it"),
    "cut_by_end": phrase("the recording ended in it"),
}
_UNCOUNTED: Mapping[Uncounted, Phrase] = {
    "too_short": phrase("it is too short"),
    "nothing_seen": phrase("what is trained was not seen"),
    "small_range": phrase("less than 10° of movement"),
    "cut_by_gap": phrase("the hand went out of sight during the movement"),
    "no_return": phrase("it never went there and back"),
    "too_quick": phrase("each was quicker than 0.4 s"),
}


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
    changes = {item.key: item for item in compare(previous, figures)} if previous else {}
    out = [_range_row(row, figures, previous, other, changes.get(row.key)) for row in figures.wrist_ranges]
    out += [_row_of_still_angle(row, figures, previous) for row in figures.group("still")]
    speed = figures.speed("peak speed")
    if speed is not None and (speed.count or speed.unknown):
        out.append(_speed_row(speed, figures, previous, other))
    return out


def norm_words(figures: SessionFigures) -> str:
    """Where the usual values are from and whom they cover; empty where none is shown."""
    norms = [wrist_norm(row.what, row.angle, figures.exercise) for row in figures.wrist_ranges]
    return next((say(norm.sentence()) for norm in norms if norm is not None), "")


def repetition_words(figures: SessionFigures) -> str:
    """``mean of 9 repetitions; number 7 left out: pain``: always n and what is left out."""
    if not any(repetition.is_whole for repetition in figures.repetitions):
        ways = [len(item.values) for item in figures.group("task") if item.what == "movement time"]
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
    for number, repetition in enumerate(figures.repetitions, 1):
        if not (repetition.counts or repetition.helped):
            said = "" if repetition.reason == PASSIVE else repetition.reason
            reason = said or say(_UNMEASURED[repetition.unmeasured])
            parts.append(tr("number {number} left out: {reason}").format(number=number, reason=reason))
    return _with_unseen(parts, figures)


def _without_passive(figures: SessionFigures) -> list[str]:
    return [tr("without what was passive")] if figures.without_passive else []


def _why_none(figures: SessionFigures) -> str:
    whole = tr("one range over the whole recording; no repetitions")
    return f"{whole}: {say(_UNCOUNTED[figures.uncounted])}" if figures.uncounted else whole


def _with_unseen(parts: list[str], figures: SessionFigures) -> str:
    """Nothing is counted where nothing was seen for long: that much of the recording is not in the number."""
    if figures.exercise.counts and figures.unseen_s >= 1.0:
        seconds = written(figures.unseen_s)
        parts = [*parts, tr("{seconds} s not seen and not counted").format(seconds=seconds)]
    return "; ".join(parts)


def mean_words(row: Measure) -> str:
    """``57° ± 2°``: the spread between repetitions, of a single one the tracker's own; two are listed."""
    is_forearm = row.what in terms.FOREARM
    if 1 < row.count < 3:
        degrees = numbers.signed_degrees if is_forearm else numbers.degrees
        return ", ".join(degrees(value) for value in row.values)
    words = numbers.with_spread(row.mean, row.sd if prints_spread(row) else row.measurement_sd)
    is_short = is_forearm and numbers.signed_degrees(row.mean) != numbers.degrees(row.mean)
    return f"\N{MINUS SIGN}{words}" if is_short else words


def prints_spread(row: Measure) -> bool:
    """Whether what stands after its ± is the spread between repetitions, not the tracker's sd."""
    return math.isfinite(row.sd)


def is_deficit(row: Measure) -> bool:
    """Whether an end of the wrist's movement was never reached: the other one does not come back to neutral. A forearm
    that does not come to thumb up has a value below zero."""
    return row.angle >= 0 and row.what not in ("arc", *terms.FOREARM) and row.mean < 0.0


def _range_row(
    row: Measure, figures: SessionFigures, previous: SessionFigures | None, other: SessionFigures | None,
    change: Comparison | None,
) -> TableRow:  # fmt: skip
    name = terms.movement_name(row.what)
    if is_deficit(row):
        name, row = terms.deficit_name(row.what), turn_round(row)
    if figures.exercise.angle is None and row.what == "arc":
        name = terms.arc_name(row.angle)
    before, beside = (item.find(*row.key) if item else None for item in (previous, other))
    words = ""
    if change is not None:
        words = change_with_limit(change.verdict, change.shown_difference_deg, change.limit_deg)
        words = words or tr("not judged: {why}").format(why=reason_words(change.reasons))
    short = "" if change is None else change_short(change.verdict, change.shown_difference_deg, change.limit_deg)
    if row.at_least:
        words = "; ".join(part for part in (words, tr("limited by the camera's view")) if part)
        short = "; ".join(part for part in (short, tr("limited by view")) if part)
    norm = wrist_norm(row.what, row.angle, figures.exercise)
    return TableRow(
        movement=name,
        today=mean_words(row),
        best=terms.end_words(row.best, row.what),
        other_hand=terms.end_words(beside.mean, row.what) if beside else "",
        usual=numbers.UNKNOWN if norm is None else _range(norm.low_deg, norm.high_deg),
        last=terms.end_words(before.mean, row.what) if before else "",
        change=words,
        short_change=short or words,
        token="" if row.what == "arc" else CURVE_TOKENS[row.angle],
        verdict=change.verdict if change else "",
    )


def _row_of_still_angle(row: Measure, figures: SessionFigures, previous: SessionFigures | None) -> TableRow:
    limit = figures.exercise.trick_limit_deg
    inside = row.mean <= limit
    before = previous.find(*row.key) if previous else None
    return TableRow(
        movement=say(STILL_NAMES[row.angle]),
        today=tr("{angle} at most").format(angle=numbers.degrees(row.mean)),
        best="",
        other_hand="",
        usual=tr("under {angle}").format(angle=numbers.degrees(limit)),
        last="" if before is None else numbers.degrees(before.mean),
        change=tr("as asked: the hand stays in line") if inside else tr("more than asked: watch the exercise"),
        token=CURVE_TOKENS[row.angle],
        verdict="" if inside else "warn",
    )


def speed_words(speed: Measure) -> str:
    """``190 ± 7°/s``."""
    spread = f"{numbers.NARROW_GAP}±{numbers.NARROW_GAP}{written(speed.sd)}" if math.isfinite(speed.sd) else ""
    return f"{written(speed.mean)}{spread}°/s" if speed.count else tr("too slow to judge")


def mean_speed_words(figures: SessionFigures) -> str:
    """``190°/s``, the mean peak speed of a session; a dash where none is known."""
    speed = figures.speed("peak speed")
    return numbers.speed(math.nan if speed is None else speed.mean)


def _speed_row(
    speed: Measure, figures: SessionFigures, previous: SessionFigures | None, other: SessionFigures | None
) -> TableRow:
    return TableRow(
        movement=tr("Peak speed"),
        today=speed_words(speed),
        best=numbers.speed(speed.best) if speed.count else "",
        other_hand=mean_speed_words(other) if other else "",
        usual=numbers.UNKNOWN,
        last=mean_speed_words(previous) if previous else "",
        change=tr("not judged: no error limit is known") if previous else "",
        short_change=tr("not judged") if previous else "",
    )


def _range(low: float, high: float) -> str:
    return f"{written(low)}°" if low == high else f"{written(low)}–{written(high)}°"
