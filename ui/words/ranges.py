"""The range-of-motion table in words, the same on the review screen and on the page."""

from __future__ import annotations

import math
from collections.abc import Mapping

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
from carpus.ui.fonts import MEDIUM, SEMIBOLD
from carpus.ui.theme import CURVE_TOKENS
from carpus.ui.translate import say, tr
from carpus.ui.verdicts import change_short, change_with_limit, reason_words
from carpus.ui.words.table import VERDICT_TOKENS, Cell, TableColumn, TableLine, TableWords

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


_VALUE, _CHANGE = TableColumn(ends=True, wraps=False), TableColumn(MEDIUM, "text2", least=15)
RANGE_COLUMNS = (
    TableColumn(MEDIUM), TableColumn(SEMIBOLD, wraps=False, scale=1.1), _VALUE, _VALUE,
    TableColumn(token="text2", ends=True, wraps=False), _VALUE, _CHANGE,
)  # fmt: skip
"""Movement, today, best, other hand, reference, last time, change."""


def range_table(
    figures: SessionFigures, previous: SessionFigures | None, other: SessionFigures | None, *, on_paper: bool = False
) -> TableWords:
    """Arc first, then its two ends, what should have stayed still, and the speed; ``on_paper``, where another box has
    them, without what stayed still or is not known, in shorter words."""
    day = numbers.since(previous.when, figures.when) if previous else ""
    heads = (
        tr("Movement"), tr("Today, mean ± sd"), tr("Best"), terms.hand_name(other.side) if other else "",
        tr("Usual (adults)"), day, tr("Change since {day}").format(day=day) if day else "",
    )  # fmt: skip
    changes = {item.key: item for item in compare(previous, figures)} if previous else {}
    rows = [
        _line_of_range(row, figures, previous, other, changes.get(row.key), on_paper) for row in figures.wrist_ranges
    ]
    if not on_paper:
        rows += [_line_of_still_angle(row, figures, previous) for row in figures.group("still")]
    speed = figures.speed("peak speed")
    if speed is not None and (speed.count or (speed.unknown and not on_paper)):
        rows.append(_line_of_speed(speed, previous, other, on_paper))
    return TableWords(RANGE_COLUMNS, heads, tuple(rows))


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


def _line_of_range(
    row: Measure, figures: SessionFigures, previous: SessionFigures | None, other: SessionFigures | None,
    change: Comparison | None, is_short: bool,
) -> TableLine:  # fmt: skip
    name = terms.movement_name(row.what)
    if is_deficit(row):
        name, row = terms.deficit_name(row.what), turn_round(row)
    if figures.exercise.angle is None and row.what == "arc":
        name = terms.arc_name(row.angle)
    before, beside = (item.find(*row.key) if item else None for item in (previous, other))
    said = ""
    if change is not None and is_short:
        said = change_short(change.verdict, change.shown_difference_deg, change.limit_deg)
    elif change is not None:
        said = change_with_limit(change.verdict, change.shown_difference_deg, change.limit_deg)
        said = said or tr("not judged: {why}").format(why=reason_words(change.reasons))
    limited = (tr("limited by view") if is_short else tr("limited by the camera's view")) if row.at_least else ""
    words, verdict = "; ".join(filter(None, (said, limited))), change.verdict if change else ""
    norm = wrist_norm(row.what, row.angle, figures.exercise)
    return (
        name if row.what == "arc" else Cell(name, MEDIUM, mark=CURVE_TOKENS[row.angle]),
        mean_words(row),
        terms.end_words(row.best, row.what),
        terms.end_words(beside.mean, row.what) if beside else "",
        numbers.UNKNOWN if norm is None else _span(norm.low_deg, norm.high_deg),
        terms.end_words(before.mean, row.what) if before else "",
        Cell(words, MEDIUM, VERDICT_TOKENS[verdict]) if verdict in VERDICT_TOKENS else words,
    )


def _line_of_still_angle(row: Measure, figures: SessionFigures, previous: SessionFigures | None) -> TableLine:
    limit = figures.exercise.trick_limit_deg
    before = previous.find(*row.key) if previous else None
    change: str | Cell = tr("as asked: the hand stays in line")
    if row.mean > limit:
        change = Cell(tr("more than asked: watch the exercise"), MEDIUM, VERDICT_TOKENS["warn"])
    return (
        Cell(say(STILL_NAMES[row.angle]), MEDIUM, mark=CURVE_TOKENS[row.angle]),
        tr("{angle} at most").format(angle=numbers.degrees(row.mean)),
        "",
        "",
        tr("under {angle}").format(angle=numbers.degrees(limit)),
        "" if before is None else numbers.degrees(before.mean),
        change,
    )


def speed_words(speed: Measure) -> str:
    """``190 ± 7°/s``."""
    spread = f"{numbers.NARROW_GAP}±{numbers.NARROW_GAP}{written(speed.sd)}" if math.isfinite(speed.sd) else ""
    return f"{written(speed.mean)}{spread}°/s" if speed.count else tr("too slow to judge")


def mean_speed_words(figures: SessionFigures) -> str:
    """``190°/s``, the mean peak speed of a session; a dash where none is known."""
    speed = figures.speed("peak speed")
    return numbers.speed(math.nan if speed is None else speed.mean)


def _line_of_speed(
    speed: Measure, previous: SessionFigures | None, other: SessionFigures | None, is_short: bool
) -> TableLine:
    change = tr("not judged") if is_short else tr("not judged: no error limit is known")
    return (
        tr("Peak speed"),
        speed_words(speed),
        numbers.speed(speed.best) if speed.count else "",
        mean_speed_words(other) if other else "",
        numbers.UNKNOWN,
        mean_speed_words(previous) if previous else "",
        change if previous else "",
    )


def _span(low: float, high: float) -> str:
    return f"{written(low)}°" if low == high else f"{written(low)}–{written(high)}°"
