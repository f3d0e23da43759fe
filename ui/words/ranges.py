"""Table of the wrist's range of motion, for the review and the report."""

from __future__ import annotations

import math
from collections.abc import Mapping

from carpus.core.measures.repetitions import NoRepetitionReason
from carpus.core.model.hand.exercises import STILL_NAMES
from carpus.core.model.phrase import Phrase, phrase
from carpus.core.model.rounding import format_rounded
from carpus.core.results.measure import Measure, negate_measure
from carpus.core.results.norms import wrist_norm
from carpus.core.results.progress import Comparison, compare_ranges
from carpus.core.results.repetition_rows import PASSIVE
from carpus.core.results.session_results import SessionResults
from carpus.ui.kit import numbers
from carpus.ui.kit.cells import VERDICT_TOKENS, Cell, TableColumn, TableContent, TableRow
from carpus.ui.kit.fonts import MEDIUM, SEMIBOLD
from carpus.ui.kit.theme import CURVE_TOKENS
from carpus.ui.kit.translate import tr, translate_phrase
from carpus.ui.words import terms
from carpus.ui.words.verdicts import long_change_words, reason_words, short_change_words

_UNMEASURED: Mapping[str, Phrase] = {
    "hidden": phrase("not seen well enough"),
    "cut_by_start": phrase("the recording began in it"),
    "cut_by_gap": phrase("the hand went out of sight in it"),
    "cut_by_end": phrase("the recording ended in it"),
}
_UNCOUNTED: Mapping[NoRepetitionReason, Phrase] = {
    "too_short": phrase("it is too short"),
    "nothing_seen": phrase("what is trained was not seen"),
    "small_range": phrase("less than 10° of movement"),
    "cut_by_gap": phrase("the hand went out of sight during the movement"),
    "no_return": phrase("it never went there and back"),
    "too_quick": phrase("each was quicker than 0.4 s"),
}


_VALUE, _CHANGE = TableColumn(is_right_aligned=True, is_wrapped=False), TableColumn(MEDIUM, "text2", min_letters=15)
# Movement, today, best, other hand, reference, last time, change.
RANGE_COLUMNS = (
    TableColumn(MEDIUM), TableColumn(SEMIBOLD, is_wrapped=False, scale=1.1), _VALUE, _VALUE,
    TableColumn(token="text2", is_right_aligned=True, is_wrapped=False), _VALUE, _CHANGE,
)  # fmt: skip


def range_table(
    results: SessionResults,
    previous: SessionResults | None,
    other_hand: SessionResults | None,
    *,
    on_paper: bool = False,
) -> TableContent:
    """Return arc, both ends, angles that should stay still, and speed.

    ``on_paper`` omits still angles and unknown values, which another part of the page has, and uses shorter texts.
    """
    day = numbers.format_time_or_day(previous.when, results.when) if previous else ""
    heads = (
        tr("Movement"), tr("Today, mean ± sd"), tr("Best"), terms.hand_name(other_hand.side) if other_hand else "",
        tr("Usual (adults)"), day, tr("Change since {day}").format(day=day) if day else "",
    )  # fmt: skip
    changes = {item.key: item for item in compare_ranges(previous, results)} if previous else {}
    rows = [
        _line_of_range(row, results, previous, other_hand, changes.get(row.key), on_paper)
        for row in results.wrist_ranges
    ]
    if not on_paper:
        rows += [_line_of_still_angle(row, results, previous) for row in results.measures_in_group("still")]
    speed = results.speed_measure("peak speed")
    if speed is not None and (speed.count or (speed.unknown_reason and not on_paper)):
        rows.append(_line_of_speed(speed, previous, other_hand, on_paper))
    return TableContent(RANGE_COLUMNS, heads, tuple(rows))


def reference_words(results: SessionResults) -> str:
    """Return the source of the reference values and whom they cover; empty if none is shown."""
    norms = [wrist_norm(row.quantity, row.wrist_angle, results.exercise) for row in results.wrist_ranges]
    return next((translate_phrase(norm.sentence()) for norm in norms if norm is not None), "")


def repetition_words(results: SessionResults) -> str:
    """Return the number of repetitions and which are excluded, and why."""
    if not any(repetition.is_whole for repetition in results.repetitions):
        ways = [len(item.values) for item in results.measures_in_group("task") if item.quantity == "movement time"]
        if ways:
            words = tr("{count} ways out and back; ranges over the whole recording").format(count=sum(ways))
            return "; ".join([words, *_without_passive(results)])
        words = "; ".join([_missing_repetition_words(results), *_without_passive(results)])
    else:
        counted = results.repetition_count
        words = tr("mean of {count} repetitions").format(count=counted) if counted else tr("no active repetition")
        if counted == 1:
            words = tr("1 repetition")
    parts = [words]
    if helped := sum(repetition.is_passive for repetition in results.repetitions):
        parts.append(tr("1 passive beside it") if helped == 1 else tr("{count} passive beside it").format(count=helped))
    for number, repetition in enumerate(results.repetitions, 1):
        if not (repetition.is_counted or repetition.is_passive):
            said = "" if repetition.exclusion_reason == PASSIVE else repetition.exclusion_reason
            reason = said or translate_phrase(_UNMEASURED[repetition.unmeasured_reason])
            parts.append(tr("number {number} left out: {reason}").format(number=number, reason=reason))
    return _add_occlusion(parts, results)


def _without_passive(results: SessionResults) -> list[str]:
    return [tr("without what was passive")] if results.excludes_passive else []


def _missing_repetition_words(results: SessionResults) -> str:
    whole = tr("one range over the whole recording; no repetitions")
    return (
        f"{whole}: {translate_phrase(_UNCOUNTED[results.no_repetitions_reason])}"
        if results.no_repetitions_reason
        else whole
    )


def _add_occlusion(parts: list[str], results: SessionResults) -> str:
    """Add the time without a visible hand, whose movements are not counted."""
    if results.exercise.has_repetitions and results.occluded_s >= 1.0:
        seconds = format_rounded(results.occluded_s)
        parts = [*parts, tr("{seconds} s not seen and not counted").format(seconds=seconds)]
    return "; ".join(parts)


def mean_words(row: Measure) -> str:
    """Return ``57° ± 2°``: SD between repetitions, or of a single one the tracker's; two values are listed."""
    is_forearm = row.quantity in terms.FOREARM
    if 1 < row.count < 3:
        degrees = numbers.format_signed_degrees if is_forearm else numbers.format_degrees
        return ", ".join(degrees(value) for value in row.values)
    words = numbers.format_with_sd(row.mean, row.sd if has_sd(row) else row.measurement_sd)
    is_short = is_forearm and numbers.format_signed_degrees(row.mean) != numbers.format_degrees(row.mean)
    return f"\N{MINUS SIGN}{words}" if is_short else words


def has_sd(row: Measure) -> bool:
    """Return whether the ± is the SD between repetitions, not the tracker's."""
    return math.isfinite(row.sd)


def is_deficit(row: Measure) -> bool:
    """Return whether the movement did not come back to neutral.

    Not for the forearm: if it does not reach thumb-up, its value is negative.
    """
    return row.wrist_angle >= 0 and row.quantity not in ("arc", *terms.FOREARM) and row.mean < 0.0


def _line_of_range(
    row: Measure, results: SessionResults, previous: SessionResults | None, other_hand: SessionResults | None,
    change: Comparison | None, is_short: bool,
) -> TableRow:  # fmt: skip
    name = terms.movement_name(row.quantity)
    if is_deficit(row):
        name, row = terms.deficit_name(row.quantity), negate_measure(row)
    if results.exercise.angle is None and row.quantity == "arc":
        name = terms.arc_name(row.wrist_angle)
    before, beside = (item.find(*row.key) if item else None for item in (previous, other_hand))
    said = ""
    if change is not None and is_short:
        said = short_change_words(change.verdict, change.display_difference_deg, change.limit_deg)
    elif change is not None:
        said = long_change_words(change.verdict, change.display_difference_deg, change.limit_deg)
        said = said or tr("not judged: {why}").format(why=reason_words(change.reasons))
    limited = (tr("limited by view") if is_short else tr("limited by the camera's view")) if row.is_lower_bound else ""
    words, verdict = "; ".join(filter(None, (said, limited))), change.verdict if change else ""
    norm = wrist_norm(row.quantity, row.wrist_angle, results.exercise)
    return (
        name if row.quantity == "arc" else Cell(name, MEDIUM, mark_token=CURVE_TOKENS[row.wrist_angle]),
        mean_words(row),
        terms.end_words(row.best, row.quantity),
        terms.end_words(beside.mean, row.quantity) if beside else "",
        numbers.UNKNOWN if norm is None else _span(norm.low_deg, norm.high_deg),
        terms.end_words(before.mean, row.quantity) if before else "",
        Cell(words, MEDIUM, VERDICT_TOKENS[verdict]) if verdict in VERDICT_TOKENS else words,
    )


def _line_of_still_angle(row: Measure, results: SessionResults, previous: SessionResults | None) -> TableRow:
    limit = results.exercise.trick_limit_deg
    before = previous.find(*row.key) if previous else None
    change: str | Cell = tr("as asked: the hand stays in line")
    if row.mean > limit:
        change = Cell(tr("more than asked: watch the exercise"), MEDIUM, VERDICT_TOKENS["warn"])
    return (
        Cell(translate_phrase(STILL_NAMES[row.wrist_angle]), MEDIUM, mark_token=CURVE_TOKENS[row.wrist_angle]),
        tr("{angle} at most").format(angle=numbers.format_degrees(row.mean)),
        "",
        "",
        tr("under {angle}").format(angle=numbers.format_degrees(limit)),
        "" if before is None else numbers.format_degrees(before.mean),
        change,
    )


def speed_words(speed: Measure) -> str:
    """Return ``190 ± 7°/s``."""
    spread = f"{numbers.NARROW_GAP}±{numbers.NARROW_GAP}{format_rounded(speed.sd)}" if math.isfinite(speed.sd) else ""
    return f"{format_rounded(speed.mean)}{spread}°/s" if speed.count else tr("too slow to judge")


def mean_speed_words(results: SessionResults) -> str:
    """Return the mean peak speed of a session, a dash if unknown."""
    speed = results.speed_measure("peak speed")
    return numbers.format_speed(math.nan if speed is None else speed.mean)


def _line_of_speed(
    speed: Measure, previous: SessionResults | None, other_hand: SessionResults | None, is_short: bool
) -> TableRow:
    change = tr("not judged") if is_short else tr("not judged: no error limit is known")
    return (
        tr("Peak speed"),
        speed_words(speed),
        numbers.format_speed(speed.best) if speed.count else "",
        mean_speed_words(other_hand) if other_hand else "",
        numbers.UNKNOWN,
        mean_speed_words(previous) if previous else "",
        change if previous else "",
    )


def _span(low: float, high: float) -> str:
    return f"{format_rounded(low)}°" if low == high else f"{format_rounded(low)}–{format_rounded(high)}°"
