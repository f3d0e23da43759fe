"""Sentences and cells of two sessions side by side. A difference is one only beyond measurement error."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from carpus.core.hand.exercises import SIDES
from carpus.core.hand.protocols import WRIST_ANGLES
from carpus.core.results.figures import SessionFigures
from carpus.core.results.motion_curves import Quantity
from carpus.core.results.progress import Progress, ProgressPoint
from carpus.core.results.ranges import RangeRow, is_total
from carpus.core.results.side_by_side import ComparedRange, SideBySide
from carpus.ui import numbers, terms
from carpus.ui.figures import figure_of
from carpus.ui.icons import State
from carpus.ui.plot.style import CURVE_TOKENS
from carpus.ui.report.hand_rows import AT_LEAST
from carpus.ui.report.tables import is_deficit, mean_words, repetition_words, too_slow, turned
from carpus.ui.translate import tr
from carpus.ui.verdicts import difference, no_change_words, reason_words
from carpus.ui.words.progress import comparison_name, doubt_words
from carpus.ui.words.progress import headline as progress_headline


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
    verdict: str
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
    right = both.first.side == "right"
    beyond = [one for one in both.ranges if one.beyond]
    if not beyond and main.comparison.verdict == "not_judged":
        why = reason_words(main.comparison.reasons) or tr("not measured")
        return tr("Not judged: {why}.").format(why=why), tr("What is hidden does not count.")
    if not beyond:
        return tr("No difference beyond measurement error between right and left."), _basis(main)
    less = main.comparison.difference_deg < 0.0
    if main.first.joint and len(beyond) > 1:
        return _of_many(beyond, len(both.ranges), right=right), " ".join(_basis(one) for one in beyond[:2])
    size = numbers.degrees(main.comparison.shown_difference_deg)
    if main.at_least:
        size = tr("at least {size}").format(size=size)
    if main.first.joint or main.first.movement != "arc":
        pattern = {
            (True, True): tr("{movement}: {size} less on the right than on the left."),
            (True, False): tr("{movement}: {size} more on the right than on the left."),
            (False, True): tr("{movement}: {size} less on the left than on the right."),
            (False, False): tr("{movement}: {size} more on the left than on the right."),
        }[right, less]
        return pattern.format(movement=row_name(main, both.ranges), size=size), _basis(main)
    if main.first.angle == 2:
        pattern = {
            (True, True): tr("The right forearm turns {size} less than the left."),
            (True, False): tr("The right forearm turns {size} more than the left."),
            (False, True): tr("The left forearm turns {size} less than the right."),
            (False, False): tr("The left forearm turns {size} more than the right."),
        }[right, less]
    else:
        pattern = {
            (True, True): tr("The right wrist moves {size} less than the left."),
            (True, False): tr("The right wrist moves {size} more than the left."),
            (False, True): tr("The left wrist moves {size} less than the right."),
            (False, False): tr("The left wrist moves {size} more than the right."),
        }[right, less]
    return pattern.format(size=size), _basis(main)


def _of_many(beyond: Sequence[ComparedRange], every: int, *, right: bool) -> str:
    """How many of the fingers or joints differ, and which way where it is one way."""
    signs = {one.comparison.difference_deg < 0.0 for one in beyond}
    total = all(is_total(one.first.joint) for one in beyond)
    if len(signs) > 1:
        pattern = (
            tr("TAM differs between the hands in {count} of {all} fingers.")
            if total
            else tr("{count} of {all} ranges differ between the hands.")
        )
    elif total:
        pattern = {
            (True, True): tr("TAM is less on the right than on the left in {count} of {all} fingers."),
            (True, False): tr("TAM is more on the right than on the left in {count} of {all} fingers."),
            (False, True): tr("TAM is less on the left than on the right in {count} of {all} fingers."),
            (False, False): tr("TAM is more on the left than on the right in {count} of {all} fingers."),
        }[right, signs.pop()]
    else:
        pattern = {
            (True, True): tr("{count} of {all} ranges are less on the right than on the left."),
            (True, False): tr("{count} of {all} ranges are more on the right than on the left."),
            (False, True): tr("{count} of {all} ranges are less on the left than on the right."),
            (False, False): tr("{count} of {all} ranges are more on the left than on the right."),
        }[right, signs.pop()]
    return pattern.format(count=len(beyond), all=every)


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
    return f"{sign}{numbers.degrees(row.mean_deg) if row.joint else terms.end_words(row.mean_deg)}"


def row_name(one: ComparedRange, among: Sequence[ComparedRange]) -> str:
    """``Whole arc``, ``Flexion``, ``Ring finger, TAM``."""
    return comparison_name(one.comparison, [other.comparison for other in among])


def quantity_name(quantity: Quantity) -> str:
    """What a curve shows: ``Flexion – extension``, ``Ring finger, TAM``."""
    joint, angle = quantity
    if joint:
        return figure_of(joint).long_name
    more, less = (terms.movement_name(side) for side in SIDES[angle])
    return tr("{more} – {less}").format(more=more, less=less)


def unfair_words(both: SideBySide) -> str:
    """Why nothing is judged; empty for a fair pair."""
    if both.fair:
        return ""
    return tr("Not a fair pair: {why}. Curves and figures are shown, nothing is judged.").format(
        why=reason_words(both.reasons)
    )


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


def table_rows(both: SideBySide, *, whole_hand: bool) -> list[BesideRow]:
    """The ranges, what should have stayed still, and the speed."""
    rows = [_range_row(one, both) for one in both.ranges]
    rows += [_alone_row(row, both, is_first=is_first) for row, is_first in both.alone if row.count]
    if not whole_hand:
        rows += [row for angle in (0, 1, 2) if (row := _largest_row(angle, both)) is not None]
    if (
        both.first.speed.peak_speed.count
        or both.second.speed.peak_speed.count
        or too_slow(both.first)
        or too_slow(both.second)
    ):
        rows.append(_speed_row(both))
    return rows


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
        numbers.degrees(item.limit_deg) if both.fair else numbers.UNKNOWN, words, item.verdict, token,
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
        "not_judged", "" if row.joint or row.movement == "arc" else CURVE_TOKENS[row.angle],
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
        if one.just_beyond:
            return tr("improved, just beyond error") if item.verdict == "improved" else tr("worse, just beyond error")
        return tr("improved, beyond error") if item.verdict == "improved" else tr("worse, beyond error")
    if not one.beyond:
        return tr("no difference beyond error")
    less, than_left = item.difference_deg < 0.0, both.second.side == "left"
    if one.just_beyond:
        return {
            (True, True): tr("less than the left, just beyond error"),
            (True, False): tr("less than the right, just beyond error"),
            (False, True): tr("more than the left, just beyond error"),
            (False, False): tr("more than the right, just beyond error"),
        }[less, than_left]
    return {
        (True, True): tr("less than the left, beyond error"),
        (True, False): tr("less than the right, beyond error"),
        (False, True): tr("more than the left, beyond error"),
        (False, False): tr("more than the right, beyond error"),
    }[less, than_left]


def _largest_row(angle: int, both: SideBySide) -> BesideRow | None:
    """The most of an angle that should have stayed still."""
    values = [float(figures.trick_deg[angle]) for figures in (both.first, both.second)]
    if not all(math.isfinite(value) for value in values):
        return None
    names = {0: tr("Side movement"), 1: tr("Up and down"), 2: tr("Turning")}
    at_most = tr("{angle} at most")
    first, second = (at_most.format(angle=numbers.degrees(value)) for value in values)
    off = math.floor(values[0] + 0.5) - math.floor(values[1] + 0.5)
    return BesideRow(
        names[angle], first, second, difference(off), numbers.UNKNOWN, no_limit_words(both), "not_judged",
        CURVE_TOKENS[angle],
    )  # fmt: skip


def _speed_row(both: SideBySide) -> BesideRow:
    cells: list[str] = []
    for figures in (both.first, both.second):
        speed = figures.speed.peak_speed
        spread = f"{numbers.NARROW_GAP}±{numbers.NARROW_GAP}{speed.sd:.0f}" if math.isfinite(speed.sd) else ""
        known = f"{speed.mean:.0f}{spread}°/s" if speed.count else numbers.UNKNOWN
        cells.append(tr("too slow to judge") if too_slow(figures) else known)
    off = both.first.speed.peak_speed.mean - both.second.speed.peak_speed.mean
    words = numbers.UNKNOWN
    if math.isfinite(off):
        size = numbers.speed(off)
        words = (
            size
            if size == numbers.speed(0.0)
            else (tr("{size} more") if off > 0 else tr("{size} less")).format(size=size)
        )
    return BesideRow(tr("Peak speed"), cells[0], cells[1], words, numbers.UNKNOWN, no_limit_words(both), "not_judged")


def other_hand_words() -> str:
    """What the other hand is to be taken for."""
    return tr("The other hand is a comparison, not a norm: hands of one person differ by themselves.")


def middle_words() -> str:
    """Of all fingers what a hook trains."""
    return tr("Middle joints of all fingers")


def no_limit_words(both: SideBySide) -> str:
    """Why a figure without an error limit is not judged; of an unfair pair the strip says why."""
    return tr("not judged: no error limit is known") if both.fair else tr("not judged")


def step_words() -> tuple[tuple[str, str], ...]:
    """The ways to play two sessions in step."""
    return (
        ("part", tr("part of the repetition")), ("start", tr("start of the repetition")), ("time", tr("time")),
    )  # fmt: skip


def column_of(quantity: Quantity) -> str:
    """The name of an angle in every file."""
    joint, angle = quantity
    return joint or WRIST_ANGLES[angle]
