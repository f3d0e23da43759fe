"""Texts of the comparison. A difference counts only beyond the measurement error."""

from __future__ import annotations

import math

from carpus.core.results.measure import Measure, MeasureKey, negate_measure
from carpus.core.results.progress import Comparison, Progress, ProgressPoint
from carpus.core.results.session_results import SessionResults
from carpus.core.results.side_by_side import SessionPair
from carpus.ui.kit import numbers
from carpus.ui.kit.cells import Cell, TableColumn, TableContent, TableRow
from carpus.ui.kit.fonts import MEDIUM, REGULAR, SEMIBOLD
from carpus.ui.kit.icons import State
from carpus.ui.kit.theme import CURVE_TOKENS
from carpus.ui.kit.translate import tr
from carpus.ui.words import terms
from carpus.ui.words.finger_angles import FINGERS, FingerAngle
from carpus.ui.words.fingers import LOWER_BOUND, is_thumb_exercise, main_kind, progress_choices, progress_keys
from carpus.ui.words.progress import comparison_name, range_name, uncertainty_words
from carpus.ui.words.progress import headline as progress_headline
from carpus.ui.words.ranges import is_deficit, mean_words, repetition_words
from carpus.ui.words.verdicts import difference_words, reason_words, verdict_word

_VALUE = TableColumn(SEMIBOLD, scale=1.14)
COLUMNS = (
    TableColumn(MEDIUM),
    _VALUE,
    _VALUE,
    TableColumn(is_right_aligned=True, is_wrapped=False),
    TableColumn(token="text2", is_right_aligned=True),
    TableColumn(),
)
"""Movement, both sessions, difference, MDC95, assessment."""


def session_name(figures: SessionResults, other: SessionResults) -> str:
    """Return what tells a session from the other: hand, day, or both."""
    day = numbers.format_distinct_day(figures.when, other.when)
    if figures.side == other.side:
        if figures.when == other.when and figures.exercise.id != other.exercise.id:
            return terms.exercise_name(figures.exercise.id)
        return day
    if figures.when.date() == other.when.date():
        return terms.side_name(figures.side)
    return tr("{side}, {day}").format(side=terms.side_name(figures.side), day=day)


def picture_words(figures: SessionResults, other: SessionResults, affected: str, *, mirrored: bool) -> str:
    """Return the label over a frame, such as ``Left, unaffected · mirrored`` or ``20 Nov``."""
    name = session_name(figures, other)
    if figures.side != other.side and affected in ("right", "left"):
        pattern = tr("{name}, affected") if figures.side == affected else tr("{name}, unaffected")
        name = pattern.format(name=name)
    return tr("{name} · mirrored").format(name=name) if mirrored else name


def headline(comparison: SessionPair) -> tuple[str, str]:
    """Return the result in one sentence, and the values behind it."""
    main = comparison.main_comparison
    if not comparison.is_comparable:
        return tr("Shown side by side, without a comparison."), ""
    if main is None:
        return tr("Not compared: the two sessions share no movement."), ""
    if comparison.relation == "dates":
        return progress_headline(_to_progress(comparison))
    if main.verdict == "not_judged":
        why = reason_words(main.reasons) or tr("not measured")
        return tr("Not compared: {why}.").format(why=why), tr("Occluded frames are not analysed.")
    if not main.is_beyond_error:
        return tr("No difference beyond measurement error between right and left."), _basis(main)
    size = numbers.format_degrees(main.display_difference_deg)
    if _is_bound(main):
        size = tr("at least {size}").format(size=size)
    pattern = {
        (True, True): tr("{movement}: {size} less on the right than on the left."),
        (True, False): tr("{movement}: {size} more on the right than on the left."),
        (False, True): tr("{movement}: {size} less on the left than on the right."),
        (False, False): tr("{movement}: {size} more on the left than on the right."),
    }[comparison.first.side == "right", main.difference_deg < 0.0]
    return pattern.format(movement=comparison_name(main, comparison.ranges), size=size), _basis(main)


def _basis(one: Comparison) -> str:
    pattern = (
        tr("{movement}: {first} versus {second}, above the measurement error of {limit}.")
        if one.is_beyond_error
        else tr("{movement}: {first} versus {second}, within the measurement error of {limit}.")
    )
    return pattern.format(
        movement=comparison_name(one), first=_format_end(one.after), second=_format_end(one.before),
        limit=numbers.format_degrees(one.limit_deg),
    )  # fmt: skip


def _format_end(row: Measure) -> str:
    if row.wrist_angle >= 0:
        return terms.end_words(row.mean, row.quantity)
    return f"{f'{LOWER_BOUND}{numbers.NARROW_GAP}' if row.is_lower_bound else ''}{numbers.format_degrees(row.mean)}"


def _is_bound(one: Comparison) -> bool:
    """Return whether a difference is a lower bound, because one measure was partly occluded."""
    return one.is_beyond_error and one.lower_bounds[0] != one.lower_bounds[1]


def unfair_words(comparison: SessionPair) -> str:
    """Return why the sessions are not comparable; empty if they are."""
    if comparison.is_comparable:
        return ""
    return tr("Not comparable: {why}. Values are shown without an assessment.").format(
        why=reason_words(comparison.reasons)
    )


def doubts(comparison: SessionPair) -> list[str]:
    """Return what was uncertain about comparable sessions."""
    if not comparison.is_comparable:
        return []
    course = _to_progress(comparison)
    return [words for point in course.points if (words := uncertainty_words(point, course))]


def _to_progress(both: SessionPair) -> Progress:
    """Return the pair as a progress of two sessions."""
    points = (ProgressPoint(both.second, ()), ProgressPoint(both.first, ()))
    return Progress(points, both.ranges, None)


def facts_words(comparison: SessionPair) -> str:
    """Return what was compared, and what is excluded."""
    first, second = comparison.first, comparison.second
    days = abs((first.when.date() - second.when.date()).days)
    if not comparison.is_comparable:
        parts = []
    elif not days:
        parts = [tr("same exercise, same day, same set-up")]
    elif days == 1:
        parts = [tr("same exercise, same set-up, 1 day apart")]
    else:
        parts = [tr("same exercise, same set-up, {count} days apart").format(count=days)]
    names = (session_name(first, second), session_name(second, first))
    for name, figures in zip(names, (first, second), strict=True):
        parts.append(tr("{name}: {what}").format(name=name, what=repetition_words(figures)))
    return "; ".join(parts)


def difference_table(comparison: SessionPair) -> TableContent:
    """Return the measures that both share, then those of one session only."""
    pattern = tr("{name}, mean ± SD")
    first, second = session_name(comparison.first, comparison.second), session_name(comparison.second, comparison.first)
    heads = (
        tr("Movement"), pattern.format(name=first), pattern.format(name=second), tr("Difference"), tr("MDC95"),
        Cell(tr("Assessment"), MEDIUM, "text2", state="none"),  # as far in as the words below it
    )  # fmt: skip
    rows = [_make_shared_row(one, comparison) for one in comparison.ranges]
    rows += [_make_single_row(row, comparison, is_first=is_first) for row, is_first in comparison.unpaired if row.count]
    return TableContent(COLUMNS, heads, tuple(rows))


def value_words(row: Measure) -> str:
    """Return a measure: ``57° ± 2°``, ``≥ 57°`` if partly occluded, ``5° deficit`` if an end was not reached."""
    if not row.count:
        return tr("not visible")
    if row.is_lower_bound and row.wrist_angle < 0:
        return f"{LOWER_BOUND}{numbers.NARROW_GAP}{numbers.format_degrees(row.mean)}"
    return terms.deficit_words(mean_words(negate_measure(row))) if is_deficit(row) else mean_words(row)


def _make_shared_row(one: Comparison, both: SessionPair) -> TableRow:
    known = math.isfinite(one.difference_deg) and (one.is_beyond_error or not any(one.lower_bounds))
    in_part = not one.is_joint and (one.after.is_lower_bound or one.before.is_lower_bound)
    limited = tr("partly occluded") if in_part else ""
    words = "; ".join(part for part in (_judgement(one, both), limited) if part)
    difference = difference_words(one.display_difference_deg) if known else numbers.UNKNOWN
    if _is_bound(one):
        difference = tr("≥ {difference}").format(difference=difference)
    look = (SEMIBOLD, "text") if one.is_beyond_error else (REGULAR, "text2")
    sign: State = "none" if one.verdict == "not_judged" else _state(one, both)
    return (
        _name_cell(one.after, comparison_name(one, both.ranges)), value_words(one.after), value_words(one.before),
        Cell(difference, *look), numbers.format_degrees(one.limit_deg) if both.is_comparable else numbers.UNKNOWN,
        Cell(words, *look, state=sign),
    )  # fmt: skip


def _make_single_row(row: Measure, both: SessionPair, *, is_first: bool) -> TableRow:
    cells = [value_words(row), numbers.UNKNOWN]
    words = tr("not compared: in one session only") if both.is_comparable else tr("not compared")
    return (
        _name_cell(row, range_name(row, names_arc=True)), *(cells if is_first else cells[::-1]),
        Cell(numbers.UNKNOWN, REGULAR, "text2"), numbers.UNKNOWN, Cell(words, REGULAR, "text2", state="none"),
    )  # fmt: skip


def _name_cell(row: Measure, name: str) -> str | Cell:
    """Return the movement with the colour of its curve."""
    return (
        name
        if row.wrist_angle < 0 or row.quantity == "arc"
        else Cell(name, MEDIUM, mark_token=CURVE_TOKENS[row.wrist_angle])
    )


def _state(one: Comparison, both: SessionPair) -> State:
    if not one.is_beyond_error:
        return "open"
    if both.relation == "hands":
        return "warn"
    return "good" if one.verdict == "improved" else "bad"


def _judgement(one: Comparison, both: SessionPair) -> str:
    if one.verdict == "not_judged":
        if not both.is_comparable:  # the strip says why
            return tr("not compared")
        return tr("not compared: {why}").format(why=reason_words(one.reasons) or tr("not measured"))
    if both.relation == "dates":
        if not one.is_beyond_error:
            return verdict_word("no_change")
        return tr("improved (above MDC)") if one.verdict == "improved" else tr("worse (above MDC)")
    if not one.is_beyond_error:
        return tr("no difference beyond MDC")
    less, than_left = one.difference_deg < 0.0, both.second.side == "left"
    return {
        (True, True): tr("less than left (above MDC)"),
        (True, False): tr("less than right (above MDC)"),
        (False, True): tr("more than left (above MDC)"),
        (False, False): tr("more than right (above MDC)"),
    }[less, than_left]


def hand_comparison_note() -> str:
    """Return the note on comparing with the other hand."""
    return tr("The other hand is a comparison, not a norm: left and right differ in healthy people too.")


MIDDLE_JOINTS = "middle"
"""Choice of the PIP joints of all fingers."""


def comparison_choices(first: SessionResults, second: SessionResults) -> list[tuple[str, str]]:
    """Return the measures of the whole hand that can be compared, as (value, words)."""
    if not (first.joint_ranges and second.joint_ranges):
        return []
    found = progress_choices(first)
    if main_kind(first) == "middle" and not is_thumb_exercise(first):
        return [(MIDDLE_JOINTS, tr("PIP joints of all fingers")), *found]  # no finger stands for the others
    return found


def measure_keys(choice: str) -> tuple[MeasureKey, ...]:
    """Return the measures of a choice; none for the wrist."""
    if choice == MIDDLE_JOINTS:
        return tuple((FingerAngle(finger, "middle").joint, "arc") for finger in FINGERS[1:])
    return progress_keys(choice)
