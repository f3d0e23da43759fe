"""Table of the wrist's range of motion, for the review and the report."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping

from carpus.core.measures.repetitions import NoRepetitionReason
from carpus.core.model.hand.exercises import STILL_NAMES
from carpus.core.model.hand.protocols import WRIST_ANGLES
from carpus.core.model.phrase import Phrase, phrase
from carpus.core.model.rounding import format_rounded
from carpus.core.results.measure import Measure, negate_measure
from carpus.core.results.norms import Norm, Person, wrist_norm
from carpus.core.results.progress import Comparison, compare_ranges
from carpus.core.results.repetition_rows import PASSIVE
from carpus.core.results.session_results import SessionResults
from carpus.ui.kit import numbers
from carpus.ui.kit.fonts import MEDIUM, SEMIBOLD
from carpus.ui.kit.table import VERDICT_TOKENS, Cell, TableColumn, TableContent, TableRow
from carpus.ui.kit.theme import CURVE_TOKENS
from carpus.ui.kit.translate import tr, translate_phrase
from carpus.ui.words import terms
from carpus.ui.words.progress import reason_words, short_change_words

_UNMEASURED: Mapping[str, Phrase] = {
    "hidden": phrase("not visible enough"),
    "cut_by_start": phrase("cut off at the start of the recording"),
    "cut_by_gap": phrase("the hand left the camera’s view"),
    "cut_by_end": phrase("cut off at the end of the recording"),
}
_UNCOUNTED: Mapping[NoRepetitionReason, Phrase] = {
    "too_short": phrase("too short"),
    "nothing_seen": phrase("the exercised joint was not visible"),
    "small_range": phrase("less than 10° of movement"),
    "cut_by_gap": phrase("the hand left the camera’s view during the movement"),
    "no_return": phrase("no complete movement cycle"),
    "too_quick": phrase("each movement was shorter than 0.4 s"),
}


# Before a range that an occluded joint may have exceeded; always explained beside the table.
LOWER_BOUND = "≥"
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
    person: Person | None = None,
) -> TableContent:
    """Return arc, both ends, and angles that should stay still.

    The other hand's value has today's share of it behind. ``person`` chooses the reference. ``on_paper`` omits still
    angles and unknown values, which another part of the page has, and uses shorter texts.
    """
    day = numbers.format_time_or_day(previous.when, results.when) if previous else ""
    heads = (
        tr("Movement"), mean_head(tr("Today"), results.wrist_ranges), tr("Best"),
        tr("{hand}, %").format(hand=terms.hand_name(other_hand.side)) if other_hand else "",
        tr("Reference (adults)") if _find_norm(results) == _find_norm(results, person) else tr("Reference (age group)"),
        day, tr("Change since {day}").format(day=day) if day else "",
    )  # fmt: skip
    changes = {item.key: item for item in compare_ranges(previous, results)} if previous else {}
    rows = [
        _line_of_range(row, results, previous, other_hand, changes.get(row.key), on_paper, person)
        for row in results.wrist_ranges
    ]
    if not on_paper:
        rows += [_line_of_still_angle(row, results, previous) for row in results.measures_in_group("still")]
    return TableContent(RANGE_COLUMNS, heads, tuple(rows))


def reference_words(results: SessionResults, person: Person | None = None) -> str:
    """Return the source of the reference values and whom they cover; empty if none is shown."""
    norm = _find_norm(results, person)
    return "" if norm is None else translate_phrase(norm.sentence())


def _find_norm(results: SessionResults, person: Person | None = None) -> Norm | None:
    """Return the first reference range that is shown."""
    norms = (wrist_norm(row.quantity, row.wrist_angle, results.exercise, person) for row in results.wrist_ranges)
    return next((norm for norm in norms if norm is not None), None)


def repetition_words(results: SessionResults) -> str:
    """Return the number of repetitions, which are excluded and why, and whose edges a person moved."""
    excluded_passive = [tr("passive repetitions excluded")] if results.excludes_passive else []
    strokes = [len(item.values) for item in results.measures_in_group("task") if item.quantity == "movement time"]
    parts = []
    if any(repetition.is_whole for repetition in results.repetitions):
        count = results.repetition_count
        words = tr("mean of {count} repetitions").format(count=count) if count else tr("no active repetition")
        parts.append(tr("1 repetition") if count == 1 else words)
    elif strokes:
        words = tr("{count} movement cycles; range over the whole recording").format(count=sum(strokes))
        return "; ".join([words, *excluded_passive])
    else:
        words = tr("range over the whole recording; no repetitions")
        if results.no_repetitions_reason:
            words = f"{words}: {translate_phrase(_UNCOUNTED[results.no_repetitions_reason])}"
        parts += [words, *excluded_passive]
    if passive := sum(repetition.is_passive for repetition in results.repetitions):
        parts.append(tr("plus 1 passive") if passive == 1 else tr("plus {count} passive").format(count=passive))
    # before the exclusions: a small window cuts the end of the line
    chosen = [str(number) for number, one in enumerate(results.repetitions, 1) if one.has_chosen_edges]
    if chosen:
        parts.append(tr("start or end set manually: repetition {numbers}").format(numbers=", ".join(chosen)))
    for number, repetition in enumerate(results.repetitions, 1):
        if not (repetition.is_counted or repetition.is_passive):
            text = "" if repetition.exclusion_reason == PASSIVE else repetition.exclusion_reason
            reason = text or translate_phrase(_UNMEASURED[repetition.unmeasured_reason])
            parts.append(tr("repetition {number} excluded: {reason}").format(number=number, reason=reason))
    if results.exercise.has_repetitions and results.occluded_s >= 1.0:
        # Movements without a visible hand are not in the number of repetitions.
        parts.append(tr("{seconds} s occluded and not analysed").format(seconds=format_rounded(results.occluded_s)))
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


def mean_head(name: str, rows: Iterable[Measure]) -> str:
    """Return ``Today, mean ± sd`` over a column of means, the name alone over single values."""
    return tr("{name}, mean ± SD").format(name=name) if any(has_sd(row) for row in rows) else name


_SFTR_ENDS = (("F", "radial", "ulnar"), ("S", "extension", "flexion"), ("R", "supination", "pronation"))
"""Plane and both ends of each wrist angle in the order of the neutral-zero method."""
_HYPHEN = "\N{NON-BREAKING HYPHEN}"


def neutral_zero_words(results: SessionResults, angle: int) -> str:
    """Return ``S 55-0-52`` of a wrist angle: extension, neutral and flexion; empty if an end is unknown.

    Neutral-zero method in SFTR notation (Gerhardt and Russe 1975): where neutral is not reached, 0 stands outside.
    """
    plane, *movements = _SFTR_ENDS[angle]
    ends = [results.find(WRIST_ANGLES[angle], movement) for movement in movements]
    first, second = (math.nan if end is None else end.mean for end in ends)
    if not math.isfinite(first + second):
        return ""
    texts = [_neutral_zero_end(end) for end in ends if end is not None]
    if first < 0.0:
        texts = ["0", *texts]
    elif second < 0.0:
        texts = [*texts, "0"]
    else:
        texts.insert(1, "0")
    return f"{plane} {_HYPHEN.join(texts)}"


def _neutral_zero_end(end: Measure) -> str:
    """Return an end without its sign; of a hidden one that lacks degrees to neutral it is known how many at most."""
    sign = "\N{LESS-THAN OR EQUAL TO}" if end.mean < 0.0 else "\N{GREATER-THAN OR EQUAL TO}"
    return f"{sign if end.is_lower_bound else ''}{format_rounded(abs(end.mean))}"


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
    change: Comparison | None, is_short: bool, person: Person | None,
) -> TableRow:  # fmt: skip
    name = terms.movement_name(row.quantity)
    before, beside = (item.find(*row.key) if item else None for item in (previous, other_hand))
    share = _share_words(row, beside) if beside else ""
    if is_deficit(row):
        name, row = terms.deficit_name(row.quantity), negate_measure(row)
    if results.exercise.angle is None and row.quantity == "arc":
        name = terms.arc_name(row.wrist_angle)
    text = ""
    if change is not None:
        text = short_change_words(change.verdict, change.display_difference_deg, change.limit_deg)
        if change.verdict == "not_judged" and not is_short:
            text = tr("not assessed: {why}").format(why=reason_words(change.reasons))
    limited = tr("partly occluded") if row.is_lower_bound else ""
    words, verdict = "; ".join(filter(None, (text, limited))), change.verdict if change else ""
    norm = wrist_norm(row.quantity, row.wrist_angle, results.exercise, person)
    if row.quantity == "arc" and (neutral_zero := neutral_zero_words(results, row.wrist_angle)):
        name = f"{name}, {neutral_zero}"
    return (
        name if row.quantity == "arc" else Cell(name, MEDIUM, mark_token=CURVE_TOKENS[row.wrist_angle]),
        mean_words(row),
        terms.end_words(row.best, row.quantity),
        f"{terms.end_words(beside.mean, row.quantity)}{share}" if beside else "",
        numbers.UNKNOWN if norm is None else numbers.format_degree_range(norm.low_deg, norm.high_deg),
        terms.end_words(before.mean, row.quantity) if before else "",
        Cell(words, MEDIUM, VERDICT_TOKENS[verdict]) if verdict in VERDICT_TOKENS else words,
    )


def _share_words(row: Measure, other: Measure) -> str:
    """Return `` (92 %)`` of the other hand's range; empty if either is not known or lacks degrees to neutral."""
    if other.is_lower_bound or not (row.mean > 0.0 and other.mean > 0.0):
        return ""
    at_least = f"{LOWER_BOUND}{numbers.NARROW_GAP}" if row.is_lower_bound else ""
    return f" ({at_least}{format_rounded(100.0 * row.mean / other.mean)}{numbers.NARROW_GAP}%)"


def _line_of_still_angle(row: Measure, results: SessionResults, previous: SessionResults | None) -> TableRow:
    limit = results.exercise.trick_limit_deg
    before = previous.find(*row.key) if previous else None
    change: str | Cell = tr("as intended: the hand stays straight")
    if row.mean > limit:
        change = Cell(tr("more than intended: check the exercise technique"), MEDIUM, VERDICT_TOKENS["warn"])
    return (
        Cell(translate_phrase(STILL_NAMES[row.wrist_angle]), MEDIUM, mark_token=CURVE_TOKENS[row.wrist_angle]),
        tr("{angle} at most").format(angle=numbers.format_degrees(row.mean)),
        "",
        "",
        tr("under {angle}").format(angle=numbers.format_degrees(limit)),
        "" if before is None else numbers.format_degrees(before.mean),
        change,
    )
