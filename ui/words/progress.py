"""Sentences of the progress screen and report. A change is one only beyond measurement error."""

from __future__ import annotations

import math
from collections.abc import Sequence

from carpus.core.measures.motion_range import FEWEST_FOR_SPREAD
from carpus.core.results.figures import SessionFigures
from carpus.core.results.measure import Measure, is_total
from carpus.core.results.progress import Comparison, Progress, ProgressPoint
from carpus.core.rounding import written
from carpus.ui import numbers, terms
from carpus.ui.fault_words import finding_words
from carpus.ui.figures import figure_of
from carpus.ui.marker_words import long_finger_name
from carpus.ui.translate import inside, tr
from carpus.ui.verdicts import difference, reason_words


def headline(progress: Progress) -> tuple[str, str]:
    """The answer in one sentence, and the figures behind it."""
    if not progress.points:
        return tr("No sessions of this exercise yet."), ""
    first, last, main = progress.first, progress.last, progress.headline
    compared = [point for point in progress.points if not point.reasons]
    if len(compared) < 2 and len(progress.points) > 1:
        out = len(progress.points) - len(compared)
        kept = tr("1 session is left out.") if out == 1 else tr("{count} sessions are left out.").format(count=out)
        why = tr("What is left out, or was measured otherwise, is not compared.")
        return tr("Nothing to compare: {left_out}").format(left_out=kept), why
    if first is None or last is None or main is None or first is last:
        return tr("One session does not make a course."), tr("Compare after the next session of the same kind.")
    day = numbers.day_beside(first.when, last.when)
    name = _subject(main)
    size = numbers.degrees(main.shown_difference_deg)
    if main.at_least:
        size = tr("at least {size}").format(size=size)
    gained = [item for item in progress.comparisons if is_total(item.after.of) and item.verdict == "improved"]
    if len(gained) > 1 and main.verdict == "improved":
        pattern = tr("TAM has improved in {count} of {all} fingers since {day}.")
        answer = pattern.format(count=len(gained), all=len(progress.comparisons), day=day)
        return answer, " ".join(_rest(item) for item in progress.comparisons if item.is_beyond)
    if main.verdict == "improved":
        answer = tr("{name} has improved by {size} since {day}.").format(name=name, size=size, day=day)
    elif main.verdict == "worse":
        answer = tr("{name} has lost {size} since {day}.").format(name=name, size=size, day=day)
    elif main.verdict == "no_change":
        answer = tr("No change proven since {day}.").format(day=day)
    elif main.is_of_joint and min(first.counted, last.counted) >= FEWEST_FOR_SPREAD:
        return tr("Not judged: the joints were hidden in part."), tr("What is hidden does not count.")
    else:
        why = reason_words(main.reasons)
        return tr("Not judged: {why}.").format(why=why or tr("too few repetitions to compare")), ""
    others = [item for item in progress.comparisons if item is not main and item.verdict != "not_judged"]
    if main.is_of_joint:  # of many joints only those that changed
        others = [item for item in others if item.is_beyond]
    turned = any(item.after.what in terms.FOREARM for item in progress.comparisons)
    zero = [terms.thumb_up_words()] if turned else []
    return answer, " ".join([_basis(main), *(_rest(item) for item in others), *zero])


def comparison_name(item: Comparison, among: Sequence[Comparison] = ()) -> str:
    """``Whole arc``, ``Flexion``, or ``Ring finger, TAM``; ``among`` others that are whole arcs too it says of what."""
    return range_name(item.after, several=sum(one.after.what == "arc" for one in among) > 1)


def range_name(row: Measure, *, several: bool) -> str:
    """As :func:`comparison_name`, of one range."""
    if row.angle < 0:
        return figure_of(row.of).long_name
    return terms.arc_name(row.angle) if several and row.what == "arc" else terms.movement_name(row.what)


def _subject(item: Comparison) -> str:
    if item.is_of_joint:
        figure = figure_of(item.after.of)
        finger = inside(long_finger_name(str(figure.finger)))
        return tr("{joint} of the {finger}").format(joint=figure.row_name, finger=finger)
    what = item.after.what
    return tr("The whole arc") if what == "arc" else terms.movement_long_name(what)


def _basis(item: Comparison) -> str:
    before, after = _ends(item)
    limit = numbers.degrees(item.limit_deg)
    if item.is_beyond:
        pattern = tr("From {before} to {after}: more than the measurement error of {limit}.")
    else:
        pattern = tr("From {before} to {after}: within the measurement error of {limit}.")
    return pattern.format(before=before, after=after, limit=limit)


def _rest(item: Comparison) -> str:
    name = _subject(item) if item.is_of_joint else terms.movement_long_name(item.after.what)
    if item.is_beyond:
        change = difference(item.shown_difference_deg)
        if item.at_least:
            change = tr("at least {change}").format(change=change)
        return tr("{name}: {change}.").format(name=name, change=change)
    return tr("{name}: no change proven.").format(name=name)


def before_after(item: Comparison) -> str:
    """``34° → 57°``; ``≥`` before a figure that a hidden joint may have exceeded."""
    signs = [f"≥{numbers.NARROW_GAP}" if limited else "" for limited in item.are_bounds]
    before, after = _ends(item)
    return f"{signs[0]}{before} → {signs[1]}{after}"


def _ends(item: Comparison) -> tuple[str, str]:
    """Both means; of the wrist a side that was not reached lacks something."""
    before, after = item.before, item.after
    if item.is_of_joint:
        return numbers.degrees(before.mean), numbers.degrees(after.mean)
    return terms.end_words(before.mean, after.what), terms.end_words(after.mean, after.what)


def change_line(item: Comparison) -> str:
    """``23° more, error 10°``; a joint that was hidden has no difference, at most a least one."""
    if item.is_of_joint and item.verdict == "not_judged":
        return tr("hidden in part, or too few")
    if item.at_least:
        return tr("at least {change}, error {limit}").format(
            change=difference(item.shown_difference_deg), limit=numbers.degrees(item.limit_deg)
        )
    return tr("{change}, error {limit}").format(
        change=difference(item.shown_difference_deg), limit=numbers.degrees(item.limit_deg)
    )


def _day_of(point: ProgressPoint, progress: Progress) -> str:
    return numbers.day_beside(point.figures.when, *(other.figures.when for other in progress.points))


def doubt_words(point: ProgressPoint, progress: Progress) -> str:
    """What was doubtful about a session that is compared all the same; empty for nothing."""
    said = " ".join(finding_words(finding).happened for finding in point.figures.findings)
    if not said or not point.fair:
        return ""
    words = tr("{day}: measured although doubtful. {findings}")
    return words.format(day=_day_of(point, progress), findings=said)


def unfair_words(point: ProgressPoint, progress: Progress) -> str:
    """``23 Oct: camera 12 cm further. Shown as a ring and left out.``; a ring only where something was measured."""
    first = progress.first
    reasons = []
    for reason in point.reasons:
        step_cm = 100 * (point.figures.quality.distance_m - first.quality.distance_m) if first else math.nan
        pattern = tr("camera {step} cm further away") if step_cm > 0 else tr("camera {step} cm nearer")
        words = {
            "distance": pattern.format(step=written(abs(step_cm))),
            "forearm_moved": tr("the forearm moved {distance}").format(
                distance=numbers.millimetres(point.figures.quality.forearm_mm)
            ),
        }
        reasons.append(words.get(reason) or reason_words((reason,)))
    day = _day_of(point, progress)
    has_ring = point.figures.group("range")
    pattern = tr("{day}: {reasons}. Shown as a ring and left out.") if has_ring else tr("{day}: {reasons}. Left out.")
    return pattern.format(day=day, reasons=", ".join(reasons))


def corrected_words(figures: SessionFigures) -> str:
    """``Corrected on 22 Nov 2026, from 00:31.4, by MK.``: markers were put right after the recording; empty as
    measured."""
    said = figures.corrected
    if said is None:
        return ""
    day, at = numbers.day_of_year(said.when), numbers.clock_tenths(said.from_s)
    if said.by:
        return tr("Corrected on {day}, from {time}, by {who}.").format(day=day, time=at, who=said.by)
    return tr("Corrected on {day}, from {time}.").format(day=day, time=at)
