"""Sentences of the printed page."""

from __future__ import annotations

import math
from collections.abc import Sequence
from datetime import datetime

from carpus.core.hand.exercises import SIDES, STILL_NAMES, STILL_RADIUS_MM
from carpus.core.measures.by_hand import HandValue
from carpus.core.results.figures import SessionFigures
from carpus.core.results.measure import Measure, is_total
from carpus.core.results.progress import Comparison, compare
from carpus.core.rounding import written
from carpus.ui import numbers, terms
from carpus.ui.fault_words import finding_words
from carpus.ui.figures import Figure
from carpus.ui.marker_words import finger_name
from carpus.ui.translate import inside, say, tr
from carpus.ui.verdicts import counted_once_words, limit_words, reason_words
from carpus.ui.words.fingers import (
    AT_LEAST,
    compared_figures,
    find_compared_ranges,
    name_compared_joints,
    range_words,
    trains_joints,
    trains_thumb,
)
from carpus.ui.words.further import main_words
from carpus.ui.words.ranges import is_deficit, prints_spread, speed_words


def summary(figures: SessionFigures, previous: SessionFigures | None, first: SessionFigures | None) -> str:
    """Today's figures, then what may be said of change."""
    free = figures.exercise.angle is None
    rows = [row for row in figures.wrist_ranges if row.what == "arc" or not free][:3]
    today = ", ".join(
        f"{inside(terms.deficit_name(row.what))} {numbers.degrees(-row.mean)}"
        if is_deficit(row)
        else f"{_name(row, figures)} {terms.end_words(row.mean, row.what)}"
        for row in rows
    )
    if not today:
        return tr("No range could be measured.") if not figures.has_passive else tr("No active range was measured.")
    parts = [f"{today[0].upper()}{today[1:]}."]
    return " ".join([*parts, *since_sessions(figures, previous, first)])


def hand_summary(figures: SessionFigures, previous: SessionFigures | None, first: SessionFigures | None) -> str:
    """Today's value of every finger, then what may be said of change; of reaches what they were like."""
    main = main_words(figures)
    if main and not trains_joints(figures):
        return f"{main}."
    shown, what = compared_figures(figures), name_compared_joints(figures)
    if trains_thumb(figures):
        shown = tuple(Figure(1, row) for row in ("middle", "spread", "knuckle", "end"))
    today, bounds = [], 0
    for figure in shown:
        row = figures.find(figure.joint, "arc")
        words = range_words(row, spread=False) if row is not None and row.count else tr("not seen")
        name = figure.row_name if trains_thumb(figures) else finger_name(str(figure.finger))
        today.append(f"{inside(name)} {words}")
        bounds += bool(row is not None and row.count and row.at_least)
    parts = [f"{main}."] if main else []
    parts.append(tr("{what}: {fingers}.").format(what=what, fingers=", ".join(today)))
    if bounds:
        parts.append(tr("{sign}: the camera did not see the end of that movement.").format(sign=AT_LEAST))
    return " ".join([*parts, *since_sessions(figures, previous, first)])


def since_sessions(figures: SessionFigures, previous: SessionFigures | None, first: SessionFigures | None) -> list[str]:
    """What may be said of change since last time, and since the first session where that is another one."""
    found = []
    if previous is not None:
        found.append(since_words(figures, previous, numbers.day_beside(previous.when, figures.when)))
    if first is not None and (previous is None or first.session_id != previous.session_id):
        day = numbers.day_beside(first.when, figures.when)
        found.append(since_words(figures, first, tr("the first session on {day}").format(day=day)))
    return [words for words in found if words]


def since_words(figures: SessionFigures, before: SessionFigures, when: str) -> str:
    """What may be said of change since a session, of the error once where it is the same; empty without anything to
    compare."""
    changes = compare(before, figures, find_compared_ranges(figures))
    judged = [item for item in changes if item.verdict != "not_judged"]
    if not judged:
        why = reason_words([reason for item in changes for reason in item.reasons])
        return tr("Change since {when} is not judged: {why}.").format(when=when, why=why) if changes else ""
    beyond = [item for item in judged if item.is_beyond]
    said = tr("No change proven since {when}.").format(when=when)
    if beyond:
        limits = [numbers.degrees(item.limit_deg) for item in beyond]
        once = len(set(limits)) == 1
        words = ", ".join(
            _describe_change(item, "" if once else limit) for item, limit in zip(beyond, limits, strict=True)
        )
        pattern = tr("Since {when}: {changes} (error {limit}).") if once else tr("Since {when}: {changes}.")
        said = pattern.format(when=when, changes=words, limit=limits[0])
    hidden = bool(figures.joint_ranges) and len(judged) < len(changes)
    return f"{said} {tr('What was hidden in part is not judged.')}" if hidden else said


def _describe_change(item: Comparison, limit: str) -> str:
    """``whole arc 34° better (error 14°)``, ``index at least 20° better``."""
    of, what = item.key
    name = inside(finger_name(of[3:4]) if item.is_of_joint else terms.movement_long_name(what))
    size = numbers.degrees(item.shown_difference_deg)
    size = tr("at least {size}").format(size=size) if item.at_least else size
    pattern = tr("{name} {size} better") if item.verdict == "improved" else tr("{name} {size} less")
    words = pattern.format(name=tr("whole arc") if what == "arc" and not item.is_of_joint else name, size=size)
    return f"{words} {tr('(error {limit})').format(limit=limit)}" if limit else words


def _name(row: Measure, figures: SessionFigures) -> str:
    if row.what == "arc":
        return tr("whole arc") if figures.exercise.angle is not None else inside(terms.arc_name(row.angle))
    return inside(terms.movement_long_name(row.what))


def method(figures: SessionFigures, markers: int, *, compared: bool, by_hand: Sequence[HandValue] = ()) -> str:
    """How it was measured, in three lines; ``compared``: the page speaks of measurement error, which is explained."""
    quality = figures.quality
    distance = (
        f"{written(100 * quality.distance_m)}{numbers.NARROW_GAP}cm"
        if math.isfinite(quality.distance_m)
        else numbers.UNKNOWN
    )
    given = terms.start_angle_words(figures.start_angles_deg * math.pi / 180.0)
    zero = tr("zero is the neutral hand")
    order = tr("Angles in the order deviation, flexion, pro/supination; {zero}.")
    if figures.angle_order == "isb":
        order = tr("Angles in the order of the ISB: flexion, deviation, pro/supination; {zero}.")
    if figures.joint_ranges:
        order = tr("Fingers: zero is straight, below it bent back. Wrist: {zero}.")
    if any(is_total(row.of) for row in figures.joint_ranges):
        order = tr(
            "Fingers: zero is straight, below it bent back; TAM is bending less what is missing to straight. "
            "Wrist: {zero}."
        )
    if given:
        zero = tr("zero is straight by the therapist’s goniometer: the hand started at {angles}").format(angles=given)
    sentences = [
        tr("Method: {markers} markers, colour and depth camera, {distance} away.").format(
            markers=markers, distance=distance
        ),
        order.format(zero=zero),
        zero_words(figures, by_hand),
        tr("The wrist’s angles are in the order of the ISB.")
        if figures.joint_ranges and figures.angle_order == "isb"
        else "",
        camera_words(figures),
        _sd_words(figures).format(sd=numbers.spread(quality.angle_sd_deg))
        if math.isfinite(quality.angle_sd_deg)
        else "",
        limit_words(figures.study) if compared else "",
        counted_once_words(figures.earlier_results),
        tr("Carpus measures the hand in the room: it is the wrist only while the forearm rests."),
    ]
    return " ".join(filter(None, sentences))


def zero_words(figures: SessionFigures, by_hand: Sequence[HandValue] = ()) -> str:
    """Where pronation and supination are counted from, where there are any, measured or entered by hand."""
    named = {row.what for row in figures.wrist_ranges} | {one.measure.lower() for one in by_hand}
    return terms.thumb_up_words() if named & set(terms.FOREARM) else ""


def camera_words(figures: SessionFigures) -> str:
    """Which calibration of the camera was used, and how old it was; empty where nobody knows which camera it was."""
    camera = figures.camera
    if not camera.serial:
        return ""
    if not camera.calibrated:
        return tr("Camera not calibrated with a board.")
    day = numbers.day_of_year(datetime.fromisoformat(camera.calibrated))
    if not math.isfinite(camera.age_days):
        return tr("Camera calibrated {day}.").format(day=day)
    return tr("Camera calibrated {day}, {days} days before.").format(day=day, days=int(camera.age_days))


def _sd_words(figures: SessionFigures) -> str:
    """Whose standard deviation stands behind the ±: of the repetitions, or of the tracker where there are too few."""
    spreads = {prints_spread(row) for row in figures.group("range") if row.count and not row.at_least}
    if spreads == {True}:
        return tr("± is the spread between repetitions; each angle itself is known to about {sd} where seen.")
    if spreads == {True, False}:
        return tr(
            "± is the spread between repetitions, of fewer than 3 the tracker’s own sd of one value; each angle itself "
            "is known to about {sd} where seen."
        )
    return tr("± is the tracker’s own sd of one value: there was no spread to give; each angle is known to about {sd}.")


def warnings(figures: SessionFigures) -> list[str]:
    """What must be read before any figure: that it is simulated, doubtful, cut short, is not to count, is an older
    result, or was measured with a camera that was out."""
    lines = []
    if figures.simulated:
        lines.append(tr("Simulated hand: nobody’s movement was measured."))
    if figures.findings:
        said = " ".join(finding_words(finding).happened for finding in figures.findings)
        lines.append(tr("Measured although doubtful: {findings}").format(findings=said))
    if figures.not_counted:
        lines.append(tr("This session is marked as not counting."))
    if figures.older:
        lines.append(tr("An older result: there is a newer one of the same recording."))
    if figures.recovered:
        lines.append(tr("This recording was cut short and recovered."))
    return lines


def target_words(figures: SessionFigures) -> str:
    """``Flexion 40°, Extension 35°``; empty without targets."""
    angle = figures.exercise.angle
    if angle is None:
        return ""
    named = zip(SIDES[angle], figures.targets_deg, (1.0, -1.0), strict=True)
    return ", ".join(
        f"{terms.movement_name(movement)} {terms.end_words(direction * value, movement)}"
        for movement, value, direction in named
        if math.isfinite(value)
    )


def quality_lines(figures: SessionFigures) -> list[tuple[str, str, bool]]:
    """Name, value, and whether it is as it should be."""
    quality = figures.quality
    measured = f"{numbers.fixed(100 * quality.measured_share, 1)}{numbers.NARROW_GAP}%"
    missed = tr("{share} of {frames}; {dropped} missed").format(
        share=measured, frames=f"{quality.frames:,}".replace(",", numbers.NARROW_GAP), dropped=quality.dropped
    )
    pattern = tr("{share} % of the time")
    if figures.joint_ranges and figures.counted:
        pattern = tr("{share} % of the repetitions")
    hidden = pattern.format(share=numbers.fixed(100 * quality.hidden_share, 1))
    lines = [
        (tr("Pictures measured"), missed, quality.measured_share > 0.9),
        (tr("Markers hidden"), hidden, quality.hidden_share < 0.1),
    ]
    arcs = [row for row in figures.joint_ranges if row.what == "arc"]
    if arcs:
        bounds = sum(row.at_least or not row.count for row in arcs)
        words = tr("{count} of {all} figures").format(count=bounds, all=len(arcs)) if bounds else tr("none")
        lines.append((tr("At least (≥) or not seen"), words, not bounds))
    if figures.exercise.pure_wrist and math.isfinite(quality.forearm_mm):
        words = tr("{distance} (limit {limit})").format(
            distance=numbers.millimetres(quality.forearm_mm), limit=numbers.millimetres(STILL_RADIUS_MM)
        )
        lines.append((tr("Forearm moved"), words, not quality.forearm_moved))
        if math.isfinite(quality.centre_residual_mm):
            words = tr("{depth} under its disc (scatter {residual})").format(
                depth=numbers.millimetres(-quality.centre_mm[2]),
                residual=f"{numbers.fixed(quality.centre_residual_mm, 1)}{numbers.NARROW_GAP}mm",
            )
            lines.append((tr("Point the wrist turns about"), words, True))
    limit = figures.exercise.trick_limit_deg
    for row in figures.group("still"):
        words = tr("{angle} at most (limit {limit})")
        words = words.format(angle=numbers.degrees(row.mean), limit=numbers.degrees(limit))
        lines.append((say(STILL_NAMES[row.angle]), words, row.mean <= limit))
    if warnings(figures):
        lines.append((tr("Warning"), tr("at the top of the page"), False))
    return lines


def other_lines(figures: SessionFigures) -> list[tuple[str, str]]:
    """Speed, smoothness, pain."""
    speed, smooth = figures.speed("peak speed"), figures.speed("smoothness")
    pauses, pause_time = figures.speed("pauses"), figures.speed("pause time")
    lines = []
    if speed is not None and (speed.count or speed.unknown):
        lines.append((tr("Peak speed, mean ± sd"), speed_words(speed)))
    if smooth is not None and smooth.unknown:
        lines.append((tr("Smoothness (SPARC; 0 is smoothest)"), tr("too slow to judge")))
    if smooth is not None and smooth.count:
        spread = (
            f"{numbers.NARROW_GAP}±{numbers.NARROW_GAP}{numbers.fixed(smooth.sd, 1)}"
            if math.isfinite(smooth.sd)
            else ""
        )
        value = numbers.fixed(smooth.mean, 1).replace("-", "\N{MINUS SIGN}")
        lines.append((tr("Smoothness (SPARC; 0 is smoothest)"), f"{value}{spread}"))
    if pauses is not None and pause_time is not None and pauses.count:
        words = tr("{count} per stroke, {seconds} s in all") if pauses.mean else tr("none")
        count, seconds = numbers.fixed(pauses.mean, 1), numbers.fixed(pause_time.mean, 1)
        lines.append((tr("Stops on the way, mean"), words.format(count=count, seconds=seconds)))
    if targets := target_words(figures):
        lines.append((tr("Target"), targets))
    if len(figures.pain) > 1:
        lines.append((tr("Pain first / last (0–10)"), f"{figures.pain[0]} / {figures.pain[-1]}"))
    else:
        lines.append((tr("Pain (0–10)"), _single_pain(figures)))
    return lines


def _single_pain(figures: SessionFigures) -> str:
    """``3 at 01:14``."""
    if not figures.pain:
        return tr("not asked")
    said, when = figures.pain[0], (*figures.pain_s, math.nan)[0]
    return tr("{pain} at {time}").format(pain=said, time=numbers.clock(when)) if math.isfinite(when) else str(said)
