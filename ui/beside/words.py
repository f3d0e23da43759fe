"""Sentences and cells of two sessions side by side. A difference is one only beyond measurement error."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from carpus.core.results.figures import SessionFigures
from carpus.core.results.progress import Progress, ProgressPoint
from carpus.core.results.ranges import RangeRow, RowKey
from carpus.core.results.side_by_side import ComparedRange, SideBySide
from carpus.ui import numbers, terms
from carpus.ui.figures import FINGERS, Figure, figure_of
from carpus.ui.icons import State
from carpus.ui.theme import CURVE_TOKENS
from carpus.ui.translate import tr
from carpus.ui.verdicts import difference, no_change_words, reason_words
from carpus.ui.words.fingers import AT_LEAST, compared_row, followed_keys, followed_kinds, trains_thumb
from carpus.ui.words.progress import comparison_name, doubt_words
from carpus.ui.words.progress import headline as progress_headline
from carpus.ui.words.ranges import is_deficit, mean_words, repetition_words, turned


@dataclass(frozen=True, slots=True)
class BesideRow:
    """Movement, both figures, their difference, the error it must exceed, and what may be said; ``strong`` where the
    difference is beyond error."""

    movement: str
    first: str
    second: str
    difference: str
    error: str
    words: str
    token: str = ""
    state: State = "none"
    strong: bool = False


def name_of(figures: SessionFigures, other: SessionFigures) -> str:
    """What tells one of the two from the other: the hand, or the day; both where both differ."""
    day = numbers.day_beside(figures.when, other.when)
    if figures.side == other.side:
        if figures.when == other.when and figures.exercise.id != other.exercise.id:
            return terms.exercise_name(figures.exercise.id)
        return day
    if figures.when.date() == other.when.date():
        return terms.side_name(figures.side)
    return tr("{side}, {day}").format(side=terms.side_name(figures.side), day=day)


def picture_words(figures: SessionFigures, other: SessionFigures, affected: str, *, mirrored: bool) -> str:
    """``Right, affected``, ``Left, healthy · mirrored``, ``20 Nov``: over a picture."""
    name = name_of(figures, other)
    if figures.side != other.side and affected in ("right", "left"):
        pattern = tr("{name}, affected") if figures.side == affected else tr("{name}, healthy")
        name = pattern.format(name=name)
    return tr("{name} · mirrored").format(name=name) if mirrored else name


def headline(both: SideBySide) -> tuple[str, str]:
    """The answer in one sentence, and the figures behind it."""
    main = both.main
    if not both.fair:
        return tr("Shown beside each other, not judged."), ""
    if main is None:
        return tr("Not judged: there is no movement that both have."), ""
    if both.relation == "dates":
        return progress_headline(_as_progress(both))
    if not main.beyond and main.comparison.verdict == "not_judged":
        why = reason_words(main.comparison.reasons) or tr("not measured")
        return tr("Not judged: {why}.").format(why=why), tr("What is hidden does not count.")
    if not main.beyond:
        return tr("No difference beyond measurement error between right and left."), _basis(main)
    size = numbers.degrees(main.comparison.shown_difference_deg)
    if main.at_least:
        size = tr("at least {size}").format(size=size)
    pattern = {
        (True, True): tr("{movement}: {size} less on the right than on the left."),
        (True, False): tr("{movement}: {size} more on the right than on the left."),
        (False, True): tr("{movement}: {size} less on the left than on the right."),
        (False, False): tr("{movement}: {size} more on the left than on the right."),
    }[both.first.side == "right", main.comparison.difference_deg < 0.0]
    return pattern.format(movement=row_name(main, both.ranges), size=size), _basis(main)


def _basis(one: ComparedRange) -> str:
    pattern = (
        tr("{movement} {first} against {second}: more than the measurement error of {limit}.")
        if one.beyond
        else tr("{movement} {first} against {second}: within the measurement error of {limit}.")
    )
    return pattern.format(
        movement=row_name(one, ()), first=_end(one.first), second=_end(one.second),
        limit=numbers.degrees(one.comparison.limit_deg),
    )  # fmt: skip


def _end(row: RangeRow) -> str:
    sign = f"{AT_LEAST}{numbers.NARROW_GAP}" if row.limited and row.joint else ""
    return f"{sign}{numbers.degrees(row.mean_deg) if row.joint else terms.end_words(row.mean_deg, row.movement)}"


def row_name(one: ComparedRange, among: Sequence[ComparedRange]) -> str:
    """``Whole arc``, ``Flexion``, ``Ring finger, TAM``."""
    return comparison_name(one.comparison, [other.comparison for other in among])


def unfair_words(both: SideBySide) -> str:
    """Why nothing is judged; empty for a fair pair."""
    if both.fair:
        return ""
    return tr("Not a fair pair: {why}. Figures are shown, nothing is judged.").format(why=reason_words(both.reasons))


def doubts(both: SideBySide) -> list[str]:
    """What was doubtful about the sessions of a fair pair."""
    if not both.fair:
        return []
    course = _as_progress(both)
    return [words for point in course.points if (words := doubt_words(point, course))]


def _as_progress(both: SideBySide) -> Progress:
    """The pair as the progress shows two sessions."""
    points = (ProgressPoint(both.second, ()), ProgressPoint(both.first, ()))
    return Progress(points, tuple(one.comparison for one in both.ranges), None)


def facts_words(both: SideBySide) -> str:
    """What was compared, and what is left out of it."""
    first, second = both.first, both.second
    days = abs((first.when.date() - second.when.date()).days)
    if not both.fair:
        parts = []
    elif not days:
        parts = [tr("same exercise, same day, same set-up")]
    elif days == 1:
        parts = [tr("same exercise, same set-up, 1 day apart")]
    else:
        parts = [tr("same exercise, same set-up, {count} days apart").format(count=days)]
    names = (name_of(first, second), name_of(second, first))
    for name, figures in zip(names, (first, second), strict=True):
        parts.append(tr("{name}: {what}").format(name=name, what=repetition_words(figures)))
    return "; ".join(parts)


def heads(both: SideBySide) -> tuple[str, ...]:
    """Heads of the table's columns."""
    pattern = tr("{name}, mean ± sd")
    first, second = name_of(both.first, both.second), name_of(both.second, both.first)
    return (
        tr("Movement"), pattern.format(name=first), pattern.format(name=second), tr("Difference"), tr("Error"),
        tr("In words"),
    )  # fmt: skip


def table_rows(both: SideBySide) -> list[BesideRow]:
    """The ranges that both have, then what only one has."""
    rows = [_range_row(one, both) for one in both.ranges]
    return rows + [_alone_row(row, both, is_first=is_first) for row, is_first in both.alone if row.count]


def value_words(row: RangeRow) -> str:
    """``57° ± 2°``; ``≥ 57°`` of a joint that was hidden; ``lacks 5°`` of an end that was never reached."""
    if not row.count:
        return tr("not seen")
    if row.limited and row.joint:
        return f"{AT_LEAST}{numbers.NARROW_GAP}{numbers.degrees(row.mean_deg)}"
    return terms.lacking(mean_words(turned(row))) if is_deficit(row) else mean_words(row)


def _range_row(one: ComparedRange, both: SideBySide) -> BesideRow:
    item, row = one.comparison, one.first
    hidden = any(side.limited for side in (one.first, one.second)) and bool(row.joint)
    known = math.isfinite(item.difference_deg) and not (hidden and not one.beyond)
    token = "" if row.joint or row.movement == "arc" else CURVE_TOKENS[row.angle]
    limited = "" if row.joint or not (one.first.limited or one.second.limited) else tr("limited by the camera's view")
    words = "; ".join(part for part in (_judgement(one, both), limited) if part)
    said = difference(item.shown_difference_deg) if known else numbers.UNKNOWN
    if one.at_least:
        said = tr("at least {difference}").format(difference=said)
    return BesideRow(
        row_name(one, both.ranges), value_words(one.first), value_words(one.second),
        said,
        numbers.degrees(item.limit_deg) if both.fair else numbers.UNKNOWN, words, token,
        "none" if item.verdict == "not_judged" else _state(one, both), one.beyond,
    )  # fmt: skip


def _alone_row(row: RangeRow, both: SideBySide, *, is_first: bool) -> BesideRow:
    """What only one of the two has."""
    many = row.movement == "arc" and not row.joint
    name = terms.arc_name(row.angle) if many else terms.movement_name(row.movement)
    cells = [value_words(row), numbers.UNKNOWN]
    first, second = cells if is_first else cells[::-1]
    words = tr("not judged: only one of the two has it") if both.fair else tr("not judged")
    return BesideRow(
        figure_of(row.joint).long_name if row.joint else name, first, second, numbers.UNKNOWN, numbers.UNKNOWN, words,
        "" if row.joint or row.movement == "arc" else CURVE_TOKENS[row.angle],
    )  # fmt: skip


def _state(one: ComparedRange, both: SideBySide) -> State:
    if not one.beyond:
        return "open"
    if both.relation == "hands":
        return "warn"
    return "good" if one.comparison.verdict == "improved" else "bad"


def _judgement(one: ComparedRange, both: SideBySide) -> str:
    item = one.comparison
    if item.verdict == "not_judged":
        if not both.fair:  # the strip says why
            return tr("not judged")
        return tr("not judged: {why}").format(why=reason_words(item.reasons) or tr("not measured"))
    if both.relation == "dates":
        if not one.beyond:
            return no_change_words()
        return tr("improved, beyond error") if item.verdict == "improved" else tr("worse, beyond error")
    if not one.beyond:
        return tr("no difference beyond error")
    less, than_left = item.difference_deg < 0.0, both.second.side == "left"
    return {
        (True, True): tr("less than the left, beyond error"),
        (True, False): tr("less than the right, beyond error"),
        (False, True): tr("more than the left, beyond error"),
        (False, False): tr("more than the right, beyond error"),
    }[less, than_left]


def other_hand_words() -> str:
    """What the other hand is to be taken for."""
    return tr("The other hand is a comparison, not a norm: hands of one person differ by themselves.")


MIDDLE = "middle"
"""The middle joints of all fingers."""


def kinds(first: SessionFigures, second: SessionFigures) -> list[tuple[str, str]]:
    """What of the whole hand can be compared, as value and words; nothing unless both are of fingers."""
    if not (first.joint_rows and second.joint_rows):
        return []
    found = followed_kinds(first)
    if compared_row(first) == "middle" and not trains_thumb(first):
        return [(MIDDLE, tr("Middle joints of all fingers")), *found]  # no finger stands for the others
    return found


def keys_of(followed: str) -> tuple[RowKey, ...]:
    """What a choice of :func:`kinds` compares; nothing for the wrist."""
    if followed == MIDDLE:
        return tuple((Figure(finger, "middle").joint, "arc", -1) for finger in FINGERS[1:])
    return followed_keys(followed)
