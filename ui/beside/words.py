"""Sentences and cells of two sessions side by side. A difference is one only beyond measurement error."""

from __future__ import annotations

import math

from carpus.core.results.figures import SessionFigures
from carpus.core.results.measure import Measure, MeasureKey, turn_round
from carpus.core.results.progress import Comparison, Progress, ProgressPoint
from carpus.core.results.side_by_side import SideBySide
from carpus.ui import numbers, terms
from carpus.ui.figures import FINGERS, Figure
from carpus.ui.fonts import MEDIUM, REGULAR, SEMIBOLD
from carpus.ui.icons import State
from carpus.ui.theme import CURVE_TOKENS
from carpus.ui.translate import tr
from carpus.ui.verdicts import difference, no_change_words, reason_words
from carpus.ui.words.fingers import AT_LEAST, compared_row, followed_keys, followed_kinds, trains_thumb
from carpus.ui.words.progress import comparison_name, doubt_words, range_name
from carpus.ui.words.progress import headline as progress_headline
from carpus.ui.words.ranges import is_deficit, mean_words, repetition_words
from carpus.ui.words.table import Cell, TableColumn, TableLine, TableWords

_VALUE = TableColumn(SEMIBOLD, scale=1.14)
COLUMNS = (
    TableColumn(MEDIUM), _VALUE, _VALUE, TableColumn(ends=True, wraps=False), TableColumn(token="text2", ends=True),
    TableColumn(),
)  # fmt: skip
"""Movement, both sessions, the difference, its error, what is said of it."""


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
    if main.verdict == "not_judged":
        why = reason_words(main.reasons) or tr("not measured")
        return tr("Not judged: {why}.").format(why=why), tr("What is hidden does not count.")
    if not main.is_beyond:
        return tr("No difference beyond measurement error between right and left."), _basis(main)
    size = numbers.degrees(main.shown_difference_deg)
    if _is_bound(main):
        size = tr("at least {size}").format(size=size)
    pattern = {
        (True, True): tr("{movement}: {size} less on the right than on the left."),
        (True, False): tr("{movement}: {size} more on the right than on the left."),
        (False, True): tr("{movement}: {size} less on the left than on the right."),
        (False, False): tr("{movement}: {size} more on the left than on the right."),
    }[both.first.side == "right", main.difference_deg < 0.0]
    return pattern.format(movement=comparison_name(main, both.ranges), size=size), _basis(main)


def _basis(one: Comparison) -> str:
    pattern = (
        tr("{movement} {first} against {second}: more than the measurement error of {limit}.")
        if one.is_beyond
        else tr("{movement} {first} against {second}: within the measurement error of {limit}.")
    )
    return pattern.format(
        movement=comparison_name(one), first=_end(one.after), second=_end(one.before),
        limit=numbers.degrees(one.limit_deg),
    )  # fmt: skip


def _end(row: Measure) -> str:
    if row.angle >= 0:
        return terms.end_words(row.mean, row.what)
    return f"{f'{AT_LEAST}{numbers.NARROW_GAP}' if row.at_least else ''}{numbers.degrees(row.mean)}"


def _is_bound(one: Comparison) -> bool:
    """Whether a difference is a lower bound, since one of the two was hidden in part."""
    return one.is_beyond and one.are_bounds[0] != one.are_bounds[1]


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
    return Progress(points, both.ranges, None)


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


def difference_table(both: SideBySide) -> TableWords:
    """The ranges that both have, then what only one has."""
    pattern = tr("{name}, mean ± sd")
    first, second = name_of(both.first, both.second), name_of(both.second, both.first)
    heads = (
        tr("Movement"), pattern.format(name=first), pattern.format(name=second), tr("Difference"), tr("Error"),
        Cell(tr("In words"), MEDIUM, "text2", sign="none"),  # as far in as the words below it
    )  # fmt: skip
    rows = [_line_of_both(one, both) for one in both.ranges]
    rows += [_line_of_one(row, both, is_first=is_first) for row, is_first in both.alone if row.count]
    return TableWords(COLUMNS, heads, tuple(rows))


def value_words(row: Measure) -> str:
    """``57° ± 2°``; ``≥ 57°`` of a joint that was hidden; ``lacks 5°`` of an end that was never reached."""
    if not row.count:
        return tr("not seen")
    if row.at_least and row.angle < 0:
        return f"{AT_LEAST}{numbers.NARROW_GAP}{numbers.degrees(row.mean)}"
    return terms.lacking(mean_words(turn_round(row))) if is_deficit(row) else mean_words(row)


def _line_of_both(one: Comparison, both: SideBySide) -> TableLine:
    known = math.isfinite(one.difference_deg) and (one.is_beyond or not any(one.are_bounds))
    in_part = not one.is_of_joint and (one.after.at_least or one.before.at_least)
    limited = tr("limited by the camera's view") if in_part else ""
    words = "; ".join(part for part in (_judgement(one, both), limited) if part)
    said = difference(one.shown_difference_deg) if known else numbers.UNKNOWN
    if _is_bound(one):
        said = tr("at least {difference}").format(difference=said)
    look = (SEMIBOLD, "text") if one.is_beyond else (REGULAR, "text2")
    sign: State = "none" if one.verdict == "not_judged" else _state(one, both)
    return (
        _name_cell(one.after, comparison_name(one, both.ranges)), value_words(one.after), value_words(one.before),
        Cell(said, *look), numbers.degrees(one.limit_deg) if both.fair else numbers.UNKNOWN,
        Cell(words, *look, sign=sign),
    )  # fmt: skip


def _line_of_one(row: Measure, both: SideBySide, *, is_first: bool) -> TableLine:
    """What only one of the two has."""
    cells = [value_words(row), numbers.UNKNOWN]
    words = tr("not judged: only one of the two has it") if both.fair else tr("not judged")
    return (
        _name_cell(row, range_name(row, several=True)), *(cells if is_first else cells[::-1]),
        Cell(numbers.UNKNOWN, REGULAR, "text2"), numbers.UNKNOWN, Cell(words, REGULAR, "text2", sign="none"),
    )  # fmt: skip


def _name_cell(row: Measure, name: str) -> str | Cell:
    """A movement with the colour of its curve."""
    return name if row.angle < 0 or row.what == "arc" else Cell(name, MEDIUM, mark=CURVE_TOKENS[row.angle])


def _state(one: Comparison, both: SideBySide) -> State:
    if not one.is_beyond:
        return "open"
    if both.relation == "hands":
        return "warn"
    return "good" if one.verdict == "improved" else "bad"


def _judgement(one: Comparison, both: SideBySide) -> str:
    if one.verdict == "not_judged":
        if not both.fair:  # the strip says why
            return tr("not judged")
        return tr("not judged: {why}").format(why=reason_words(one.reasons) or tr("not measured"))
    if both.relation == "dates":
        if not one.is_beyond:
            return no_change_words()
        return tr("improved, beyond error") if one.verdict == "improved" else tr("worse, beyond error")
    if not one.is_beyond:
        return tr("no difference beyond error")
    less, than_left = one.difference_deg < 0.0, both.second.side == "left"
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
    if not (first.joint_ranges and second.joint_ranges):
        return []
    found = followed_kinds(first)
    if compared_row(first) == "middle" and not trains_thumb(first):
        return [(MIDDLE, tr("Middle joints of all fingers")), *found]  # no finger stands for the others
    return found


def keys_of(followed: str) -> tuple[MeasureKey, ...]:
    """What a choice of :func:`kinds` compares; nothing for the wrist."""
    if followed == MIDDLE:
        return tuple((Figure(finger, "middle").joint, "arc") for finger in FINGERS[1:])
    return followed_keys(followed)
