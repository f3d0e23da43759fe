"""Texts of the comparison. A difference counts only beyond the measurement error."""

from __future__ import annotations

import math

import numpy as np

from carpus.core.model.hand.exercises import DIRECTIONS
from carpus.core.model.types import FloatArray
from carpus.core.results.measure import Measure, MeasureKey, negate_measure, wrist_angle_index
from carpus.core.results.progress import Comparison, Progress, ProgressPoint
from carpus.core.results.session_results import SessionResults
from carpus.core.results.side_by_side import SessionPair
from carpus.core.results.valid_data import motion_estimate
from carpus.core.session.values import Session
from carpus.ui.kit import numbers
from carpus.ui.kit.fonts import MEDIUM, REGULAR, SEMIBOLD
from carpus.ui.kit.icons import State
from carpus.ui.kit.table import Cell, TableColumn, TableContent, TableRow
from carpus.ui.kit.translate import tr
from carpus.ui.words import terms
from carpus.ui.words.finger_angles import FINGERS, FingerAngle, find_finger_angle, format_spread
from carpus.ui.words.fingers import is_thumb_exercise, main_kind, progress_choices, progress_keys
from carpus.ui.words.progress import (
    comparison_name,
    difference_words,
    error_limit_words,
    reason_words,
    short_change_words,
    uncertainty_words,
)
from carpus.ui.words.progress import headline as progress_headline
from carpus.ui.words.ranges import LOWER_BOUND, is_deficit, mean_head, mean_words, repetition_words

_VALUE = TableColumn(SEMIBOLD, scale=1.14)
# Movement, both sessions, difference.
COLUMNS = (TableColumn(MEDIUM), _VALUE, _VALUE, TableColumn())


def session_name(results: SessionResults, other: SessionResults) -> str:
    """Return what tells a session from the other: hand, day, or both."""
    day = numbers.format_distinct_day(results.when, other.when)
    if results.side == other.side:
        if results.when == other.when and results.exercise.id != other.exercise.id:
            return terms.exercise_name(results.exercise.id)
        return day
    if results.when.date() == other.when.date():
        return terms.side_name(results.side)
    return tr("{side}, {day}").format(side=terms.side_name(results.side), day=day)


def picture_words(results: SessionResults, other: SessionResults, affected: str, *, is_mirrored: bool) -> str:
    """Return the label of a frame, such as ``Left, unaffected · mirrored`` or ``20 Nov``."""
    name = session_name(results, other)
    if results.side != other.side and affected in ("right", "left"):
        pattern = tr("{name}, affected") if results.side == affected else tr("{name}, unaffected")
        name = pattern.format(name=name)
    return tr("{name} · mirrored").format(name=name) if is_mirrored else name


def angle_words(session: Session, joint: str, value_deg: FloatArray, row: int) -> str:
    """Return the trained angle at a row, such as ``Flexion 37° ± 2°``."""
    value = float(value_deg[row]) if 0 <= row < len(value_deg) else math.nan
    if not math.isfinite(value):
        return tr("not visible")
    angle = wrist_angle_index(joint)
    if angle < 0:
        figure = find_finger_angle(joint)
        value *= figure.sign  # from the angle in every file to the one that is spoken of
        text = format_spread(value, figure.finger) if figure.kind == "spread" else numbers.format_signed_degrees(value)
        return f"{figure.long_name} {text}"
    sd = float(np.degrees(motion_estimate(session).angles_sd_rad[row, angle]))
    return f"{terms.movement_name(DIRECTIONS[angle][0 if value >= 0 else 1])} {numbers.format_with_sd(value, sd)}"


def headline(pair: SessionPair) -> tuple[str, str]:
    """Return the result in one sentence, and the values behind it."""
    main = pair.main_comparison
    if not pair.is_comparable:
        return tr("The sessions are shown side by side, but not compared."), ""
    if main is None:
        return tr("Not compared: the two sessions share no movement."), ""
    if pair.relation == "dates":
        return progress_headline(_to_progress(pair))
    if main.verdict == "not_judged":
        why = reason_words(main.reasons) or tr("not measured")
        return tr("Not compared: {why}.").format(why=why), tr("Frames with occluded joints are not analysed.")
    note = tr("The other hand is a comparison, not a norm: left and right differ in healthy people too.")
    if not main.is_beyond_error:
        return tr("No difference beyond measurement error between right and left."), note
    size = _format_bound(main, numbers.format_degrees(main.display_difference_deg))
    pattern = {
        (True, True): tr("{movement}: {size} less on the right than on the left."),
        (True, False): tr("{movement}: {size} more on the right than on the left."),
        (False, True): tr("{movement}: {size} less on the left than on the right."),
        (False, False): tr("{movement}: {size} more on the left than on the right."),
    }[pair.first.side == "right", main.difference_deg < 0.0]
    return pattern.format(movement=comparison_name(main, pair.ranges), size=size), note


def _format_bound(one: Comparison, size: str) -> str:
    """Say of a difference that it is a lower bound, because one of the two was partly occluded."""
    is_bound = one.is_beyond_error and one.lower_bounds[0] != one.lower_bounds[1]
    return tr("at least {size}").format(size=size) if is_bound else size


def warning_words(pair: SessionPair) -> str:
    """Return why the sessions are not comparable, or what was uncertain about them."""
    if not pair.is_comparable:
        words = tr("Not comparable: {why}. Values are shown without an assessment.")
        return words.format(why=reason_words(pair.reasons))
    course = _to_progress(pair)
    return " ".join(words for point in course.points if (words := uncertainty_words(point, course)))


def _to_progress(pair: SessionPair) -> Progress:
    """Return the pair as a progress of two sessions."""
    return Progress((ProgressPoint(pair.second, ()), ProgressPoint(pair.first, ())), pair.ranges, None)


def facts_words(pair: SessionPair) -> str:
    """Return of how many repetitions each value is the mean, and what the measurement error is."""
    first, second = pair.first, pair.second
    counts = [
        tr("{name}: {what}").format(name=session_name(one, other), what=repetition_words(one))
        for one, other in ((first, second), (second, first))
    ]
    return f"{'; '.join(counts)}. {error_limit_words(first.study)}"


def difference_table(pair: SessionPair) -> TableContent:
    """Return the measures that both sessions share."""
    first = mean_head(session_name(pair.first, pair.second), [one.after for one in pair.ranges])
    second = mean_head(session_name(pair.second, pair.first), [one.before for one in pair.ranges])
    difference = Cell(tr("Difference"), MEDIUM, "text2", state="none")  # as far in as the words below it
    heads = (tr("Movement"), first, second, difference)
    return TableContent(COLUMNS, heads, tuple(_make_row(one, pair) for one in pair.ranges))


def _make_row(one: Comparison, pair: SessionPair) -> TableRow:
    look = (SEMIBOLD, "text") if one.is_beyond_error else (REGULAR, "text2")
    state: State = "none"
    if one.verdict != "not_judged":
        words = _format_bound(one, short_change_words(one.verdict, one.display_difference_deg, one.limit_deg))
        beyond: State = "warn" if pair.relation == "hands" else "good" if one.verdict == "improved" else "bad"
        state = beyond if one.is_beyond_error else "open"
    elif pair.is_comparable:
        words = tr("not compared: {why}").format(why=reason_words(one.reasons) or tr("not measured"))
    else:  # the strip says why
        known = math.isfinite(one.difference_deg) and not any(one.lower_bounds)
        words = difference_words(one.display_difference_deg) if known else numbers.UNKNOWN
    name = comparison_name(one, pair.ranges)
    return name, _value_words(one.after), _value_words(one.before), Cell(words, *look, state=state)


def _value_words(row: Measure) -> str:
    """Return ``57° ± 2°``, ``≥ 57°`` if partly occluded, ``5° deficit`` if an end was not reached."""
    if not row.count:
        return tr("not visible")
    if row.is_lower_bound and row.wrist_angle < 0:
        return f"{LOWER_BOUND}{numbers.NARROW_GAP}{numbers.format_degrees(row.mean)}"
    return terms.deficit_words(mean_words(negate_measure(row))) if is_deficit(row) else mean_words(row)


def compared_keys(first: SessionResults, second: SessionResults) -> tuple[MeasureKey, ...]:
    """Return the measures of a whole hand that its exercise trains; none for the wrist."""
    if not (first.joint_ranges and second.joint_ranges):
        return ()
    if main_kind(first) == "middle" and not is_thumb_exercise(first):  # no finger stands for the others
        return tuple((FingerAngle(finger, "middle").joint, "arc") for finger in FINGERS[1:])
    return progress_keys(progress_choices(first)[0][0])
