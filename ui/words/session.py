"""Sentences of the session report."""

from __future__ import annotations

import math
from collections.abc import Sequence
from datetime import datetime

from carpus.core.measures.manual_measurements import ManualValue
from carpus.core.model.hand.exercises import DIRECTIONS, STILL_NAMES, STILL_RADIUS_MM
from carpus.core.model.rounding import format_rounded
from carpus.core.results.measure import Measure, is_total_active_motion
from carpus.core.results.progress import Comparison, compare_ranges
from carpus.core.results.session_results import SessionResults
from carpus.ui.kit import numbers
from carpus.ui.kit.translate import to_mid_sentence, tr, translate_phrase
from carpus.ui.words import terms
from carpus.ui.words.fault_words import finding_words
from carpus.ui.words.finger_angles import FingerAngle
from carpus.ui.words.fingers import (
    find_main_ranges,
    is_joint_exercise,
    is_thumb_exercise,
    main_angles,
    main_kind_name,
    range_words,
)
from carpus.ui.words.progress import duplicate_result_words, error_limit_words, reason_words
from carpus.ui.words.ranges import LOWER_BOUND, has_sd, is_deficit
from carpus.ui.words.task_measures import task_summary
from carpus.ui.words.terms import finger_name


def wrist_summary(results: SessionResults, previous: SessionResults | None, first: SessionResults | None) -> str:
    """Return today's values, then the changes."""
    free = results.exercise.angle is None
    rows = [row for row in results.wrist_ranges if row.quantity == "arc" or not free][:3]
    today = ", ".join(
        f"{to_mid_sentence(terms.deficit_name(row.quantity))} {numbers.format_degrees(-row.mean)}"
        if is_deficit(row)
        else f"{_range_name(row, results)} {terms.end_words(row.mean, row.quantity)}"
        for row in rows
    )
    if not today:
        return (
            tr("No range of motion could be measured.")
            if not results.has_passive
            else tr("No active range of motion was measured.")
        )
    parts = [f"{today[0].upper()}{today[1:]}."]
    return " ".join([*parts, *change_sentences(results, previous, first)])


def hand_summary(results: SessionResults, previous: SessionResults | None, first: SessionResults | None) -> str:
    """Return today's value of every finger or the results of a task, then the changes."""
    main = task_summary(results)
    if main and not is_joint_exercise(results):
        return f"{main}."
    shown, what = main_angles(results), main_kind_name(results)
    if is_thumb_exercise(results):
        shown = tuple(FingerAngle(1, row) for row in ("middle", "spread", "knuckle", "end"))
    today, bounds = [], 0
    for figure in shown:
        row = results.find(figure.joint, "arc")
        words = range_words(row, has_sd=False) if row is not None and row.count else tr("not visible")
        name = figure.kind_name if is_thumb_exercise(results) else finger_name(str(figure.finger))
        today.append(f"{to_mid_sentence(name)} {words}")
        bounds += bool(row is not None and row.count and row.is_lower_bound)
    parts = [f"{main}."] if main else []
    parts.append(tr("{what}: {fingers}.").format(what=what, fingers=", ".join(today)))
    if bounds:
        parts.append(tr("{sign}: the end of this movement was occluded.").format(sign=LOWER_BOUND))
    return " ".join([*parts, *change_sentences(results, previous, first)])


def change_sentences(
    results: SessionResults, previous: SessionResults | None, first: SessionResults | None
) -> list[str]:
    """Return the changes since last time, and since the first session if that is another one."""
    found = []
    if previous is not None:
        found.append(change_sentence(results, previous, numbers.format_distinct_day(previous.when, results.when)))
    if first is not None and (previous is None or first.session_id != previous.session_id):
        day = numbers.format_distinct_day(first.when, results.when)
        found.append(change_sentence(results, first, tr("the first session on {day}").format(day=day)))
    return [words for words in found if words]


def change_sentence(results: SessionResults, earlier: SessionResults, since: str) -> str:
    """Return the changes since a session with their error; empty if nothing is comparable."""
    changes = compare_ranges(earlier, results, find_main_ranges(results))
    judged = [item for item in changes if item.verdict != "not_judged"]
    if not judged:
        why = reason_words([reason for item in changes for reason in item.reasons])
        return tr("Change since {when} is not assessed: {why}.").format(when=since, why=why) if changes else ""
    beyond = [item for item in judged if item.is_beyond_error]
    text = tr("No change beyond measurement error since {when}.").format(when=since)
    if beyond:
        limits = [numbers.format_degrees(item.limit_deg) for item in beyond]
        once = len(set(limits)) == 1
        words = ", ".join(
            _describe_change(item, "" if once else limit) for item, limit in zip(beyond, limits, strict=True)
        )
        pattern = tr("Since {when}: {changes} (MDC {limit}).") if once else tr("Since {when}: {changes}.")
        text = pattern.format(when=since, changes=words, limit=limits[0])
    hidden = bool(results.joint_ranges) and len(judged) < len(changes)
    return f"{text} {tr('Partly occluded joints are not assessed.')}" if hidden else text


def _describe_change(item: Comparison, limit: str) -> str:
    """Return ``total arc improved by 34° (MDC 14°)``."""
    subject, what = item.key
    name = to_mid_sentence(finger_name(subject[3:4]) if item.is_joint else terms.movement_long_name(what))
    size = numbers.format_degrees(item.display_difference_deg)
    size = tr("at least {size}").format(size=size) if item.is_lower_bound else size
    pattern = tr("{name} improved by {size}") if item.verdict == "improved" else tr("{name} decreased by {size}")
    words = pattern.format(name=tr("total arc") if what == "arc" and not item.is_joint else name, size=size)
    return f"{words} {tr('(MDC {limit})').format(limit=limit)}" if limit else words


def _range_name(row: Measure, results: SessionResults) -> str:
    if row.quantity == "arc":
        return (
            tr("total arc") if results.exercise.angle is not None else to_mid_sentence(terms.arc_name(row.wrist_angle))
        )
    return to_mid_sentence(terms.movement_long_name(row.quantity))


def method_words(
    results: SessionResults, markers: int, *, compared: bool, manual_values: Sequence[ManualValue] = ()
) -> str:
    """Describe the method; with ``compared`` also the measurement error."""
    quality = results.quality
    distance = (
        f"{format_rounded(100 * quality.distance_m)}{numbers.NARROW_GAP}cm"
        if math.isfinite(quality.distance_m)
        else numbers.UNKNOWN
    )
    given = terms.start_angle_words(results.start_angles_deg * math.pi / 180.0)
    zero = tr("0° = neutral position")
    order = tr("Angles in the order deviation, flexion, pronation–supination; {zero}.")
    if results.angle_order == "isb":
        order = tr("Angles in the order of the ISB: flexion, deviation, pronation–supination; {zero}.")
    if results.joint_ranges:
        order = tr("Fingers: 0° = straight; negative = hyperextension. Wrist: {zero}.")
    if any(is_total_active_motion(row.subject) for row in results.joint_ranges):
        order = tr(
            "Fingers: 0° = straight; negative = hyperextension. TAM = total flexion minus extension deficit. Wrist: "
            "{zero}."
        )
    if given:
        zero = tr("0° set by goniometer, start position {angles}").format(angles=given)
    sentences = [
        tr("Method: {markers} markers, colour and depth camera, {distance} away.").format(
            markers=markers, distance=distance
        ),
        order.format(zero=zero),
        zero_words(results, manual_values),
        tr("The wrist angles are in the order of the ISB (flexion first).")
        if results.joint_ranges and results.angle_order == "isb"
        else "",
        camera_words(results),
        _sd_words(results).format(sd=numbers.format_sd(quality.angle_sd_deg))
        if math.isfinite(quality.angle_sd_deg)
        else "",
        error_limit_words(results.study) if compared else "",
        duplicate_result_words(results.earlier_results),
        tr("Angles are relative to the room. They equal wrist angles only while the forearm is still."),
    ]
    return " ".join(filter(None, sentences))


def zero_words(results: SessionResults, manual_values: Sequence[ManualValue] = ()) -> str:
    """Say where pronation and supination are counted from, if there are any."""
    named = {row.quantity for row in results.wrist_ranges} | {one.measure.lower() for one in manual_values}
    return terms.thumb_up_words() if named & set(terms.FOREARM) else ""


def camera_words(results: SessionResults) -> str:
    """Say which camera calibration was used; empty if the camera is unknown."""
    camera = results.camera
    if not camera.serial:
        return ""
    if not camera.calibrated_at:
        return tr("Camera not calibrated with a board.")
    day = numbers.format_date(datetime.fromisoformat(camera.calibrated_at))
    if not math.isfinite(camera.age_days):
        return tr("Camera calibrated {day}.").format(day=day)
    return tr("Camera calibrated {day}, {days} days before.").format(day=day, days=int(camera.age_days))


def _sd_words(results: SessionResults) -> str:
    """Say what the ± is: SD between repetitions, or the tracker's."""
    spreads = {has_sd(row) for row in results.measures_in_group("range") if row.count and not row.is_lower_bound}
    if spreads == {True}:
        return tr("± = SD between repetitions. The SD of a visible angle is about {sd}.")
    if spreads == {True, False}:
        return tr(
            "± = SD between repetitions (with fewer than 3: SD of the estimate). The SD of a visible angle "
            "is about {sd}."
        )
    return tr("± = SD of the estimate, as there are too few repetitions. The SD of an angle is about {sd}.")


def warning_lines(results: SessionResults) -> list[str]:
    """Return what must be read before any value."""
    lines = []
    if results.is_simulated:
        lines.append(tr("Simulated data: no patient was measured."))
    if results.findings:
        text = " ".join(finding_words(finding).summary for finding in results.findings)
        lines.append(tr("Measured although uncertain: {findings}").format(findings=text))
    if results.is_excluded:
        lines.append(tr("This session is excluded from analysis."))
    if results.is_superseded:
        lines.append(tr("An older result: there is a newer one of the same recording."))
    if results.is_recovered:
        lines.append(tr("This recording was cut short and recovered."))
    return lines


def target_words(results: SessionResults) -> str:
    """Return the targets, such as ``Flexion 40°, Extension 35°``; empty without any."""
    angle = results.exercise.angle
    if angle is None:
        return ""
    named = zip(DIRECTIONS[angle], results.targets_deg, (1.0, -1.0), strict=True)
    return ", ".join(
        f"{terms.movement_name(movement)} {terms.end_words(direction * value, movement)}"
        for movement, value, direction in named
        if math.isfinite(value)
    )


def quality_lines(results: SessionResults) -> list[tuple[str, str, bool]]:
    """Return name, value, and whether acceptable, of each quality measure."""
    quality = results.quality
    measured = f"{numbers.format_fixed(100 * quality.measured_share, 1)}{numbers.NARROW_GAP}%"
    missed = tr("{share} of {frames}; {dropped} dropped").format(
        share=measured, frames=f"{quality.frames:,}".replace(",", numbers.NARROW_GAP), dropped=quality.dropped_frames
    )
    pattern = tr("{share} % of the time")
    if results.joint_ranges and results.repetition_count:
        pattern = tr("{share} % of the repetition time")
    hidden = pattern.format(share=numbers.format_fixed(100 * quality.hidden_share, 1))
    lines = [
        (tr("Frames measured"), missed, quality.measured_share > 0.9),
        (tr("Markers occluded"), hidden, quality.hidden_share < 0.1),
    ]
    arcs = [row for row in results.joint_ranges if row.quantity == "arc"]
    if arcs:
        bounds = sum(row.is_lower_bound or not row.count for row in arcs)
        words = tr("{count} of {all} values").format(count=bounds, all=len(arcs)) if bounds else tr("none")
        lines.append((tr("Minimum (≥) or not visible"), words, not bounds))
    if results.exercise.is_forearm_fixed and math.isfinite(quality.forearm_movement_mm):
        words = tr("{distance} (limit {limit})").format(
            distance=numbers.format_millimetres(quality.forearm_movement_mm),
            limit=numbers.format_millimetres(STILL_RADIUS_MM),
        )
        lines.append((tr("Forearm moved"), words, not quality.has_forearm_moved))
    limit = results.exercise.trick_limit_deg
    for row in results.measures_in_group("still"):
        words = tr("{angle} at most (limit {limit})")
        words = words.format(angle=numbers.format_degrees(row.mean), limit=numbers.format_degrees(limit))
        lines.append((translate_phrase(STILL_NAMES[row.wrist_angle]), words, row.mean <= limit))
    if warning_lines(results):
        lines.append((tr("Warning"), tr("at the top of the page"), False))
    return lines


def research_lines(results: SessionResults) -> list[tuple[str, str]]:
    """Return name and value of speed, smoothness, pauses and the wrist's rotation centre."""
    speed, smooth = results.speed_measure("peak speed"), results.speed_measure("smoothness")
    pauses, pause_time = results.speed_measure("pauses"), results.speed_measure("pause time")
    gap, quality, lines = numbers.NARROW_GAP, results.quality, []
    if speed is not None and speed.count:
        spread = f"{gap}±{gap}{format_rounded(speed.sd)}" if math.isfinite(speed.sd) else ""
        lines.append((tr("Peak speed, mean ± SD"), f"{format_rounded(speed.mean)}{spread}°/s"))
    if smooth is not None and smooth.count:
        spread = f"{gap}±{gap}{numbers.format_fixed(smooth.sd, 1)}" if math.isfinite(smooth.sd) else ""
        value = numbers.format_fixed(smooth.mean, 1).replace("-", "\N{MINUS SIGN}")
        lines.append((tr("Smoothness (SPARC; closer to 0 is smoother)"), f"{value}{spread}"))
    if pauses is not None and pause_time is not None and pauses.count:
        words = tr("{count} per movement, {seconds} s in total") if pauses.mean else tr("none")
        count, seconds = numbers.format_fixed(pauses.mean, 1), numbers.format_fixed(pause_time.mean, 1)
        lines.append((tr("Pauses during a movement, mean"), words.format(count=count, seconds=seconds)))
    if results.exercise.is_forearm_fixed and math.isfinite(quality.centre_residual_mm):
        words = tr("{depth} below the wrist marker (scatter {residual})").format(
            depth=numbers.format_millimetres(-quality.centre_mm[2]),
            residual=f"{numbers.format_fixed(quality.centre_residual_mm, 1)}{gap}mm",
        )
        lines.append((tr("Wrist rotation centre"), words))
    return lines


def pain_lines(results: SessionResults) -> list[tuple[str, str]]:
    """Return name and value of targets and pain."""
    lines = []
    if targets := target_words(results):
        lines.append((tr("Goal"), targets))
    if len(results.pain_scores) > 1:
        lines.append((tr("Pain first / last (0–10)"), f"{results.pain_scores[0]} / {results.pain_scores[-1]}"))
    else:
        lines.append((tr("Pain (0–10)"), _single_pain(results)))
    return lines


def _single_pain(results: SessionResults) -> str:
    """Return ``3 at 01:14``."""
    if not results.pain_scores:
        return tr("not asked")
    text, when = results.pain_scores[0], (*results.pain_times_s, math.nan)[0]
    return (
        tr("{pain} at {time}").format(pain=text, time=numbers.format_clock(when)) if math.isfinite(when) else str(text)
    )
