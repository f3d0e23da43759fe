"""Sentences about change and progress; a difference is a change only beyond the measurement error."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from datetime import datetime

from carpus.core.measures.change_limits import RetestStudy
from carpus.core.measures.motion_range import MIN_REPETITIONS_FOR_SD
from carpus.core.model.phrase import Phrase, phrase
from carpus.core.model.rounding import format_rounded
from carpus.core.results.measure import Measure, is_total_active_motion
from carpus.core.results.progress import Comparison, Progress, ProgressPoint
from carpus.core.results.session_results import SessionResults
from carpus.ui.kit import numbers
from carpus.ui.kit.translate import to_mid_sentence, tr, translate_phrase
from carpus.ui.words import terms
from carpus.ui.words.fault_words import finding_words
from carpus.ui.words.finger_angles import find_finger_angle
from carpus.ui.words.terms import long_finger_name

_VERDICTS: Mapping[str, Phrase] = {
    "improved": phrase("improved"), "worse": phrase("worse"), "no_change": phrase("no change beyond MDC"),
    "not_judged": phrase("not assessed"),
}  # fmt: skip
_REASONS: Mapping[str, Phrase] = {
    "side": phrase("the other hand"),
    "protocol": phrase("other markers"),
    "exercise": phrase("another exercise"),
    "few_repetitions_before": phrase("fewer than 3 repetitions"),
    "few_repetitions_after": phrase("fewer than 3 repetitions"),
    "unknown": phrase("not measured"),
    "simulated": phrase("a simulated hand"),
    "not_counted": phrase("excluded from analysis"),
    "doubtful": phrase("measured although the markers were uncertain"),
    "distance": phrase("the camera was at another distance"),
    "start_angle": phrase("another start angle was given"),
    "forearm_moved": phrase("the forearm moved"),
    "hidden": phrase("partly occluded"),
    "angle_order": phrase("angles in another order"),
    "only_passive": phrase("no active repetition"),
}


def verdict_word(verdict: str) -> str:
    """Return a verdict as shown in tables."""
    return translate_phrase(_VERDICTS.get(verdict, ""))


def reason_words(reasons: Sequence[str]) -> str:
    """Return why sessions are not compared, or one is excluded; empty without a reason."""
    return ", ".join(dict.fromkeys(translate_phrase(_REASONS[reason]) for reason in reasons))


def duplicate_result_words(earlier_results: int) -> str:
    """Say that only the newest result of a recording is analysed; empty without others."""
    if not earlier_results:
        return ""
    words = tr("Only the newest result of a recording is analysed: 1 earlier result is excluded.")
    if earlier_results > 1:
        words = tr("Only the newest result of a recording is analysed: {count} earlier results are excluded.")
    return words.format(count=earlier_results)


def error_limit_words(study: RetestStudy | None = None) -> str:
    """Explain the measurement error; ``study`` is the clinic's own."""
    if study is not None:
        return tr(
            "This clinic measured the MDC95 (measurement error) on {date} with {count} people. Where it was not "
            "measured, Carpus uses an expert default. The MDC applies to the same markers, side and set-up."
        ).format(date=numbers.format_date(datetime.fromisoformat(study.made)), count=study.people)
    return tr(
        "Until the clinic has measured its own MDC (measurement error), Carpus uses an expert default, not a "
        "published value. For a total arc, which has two ends, the MDC is √2 times as large. It applies to the same "
        "markers, side and set-up."
    )


def difference_words(change_deg: float) -> str:
    """Return ``23° more`` or ``3° less``; ``0°`` if it rounds to zero."""
    size = numbers.format_degrees(change_deg)
    if size == "0°":
        return size
    return (tr("{size} more") if change_deg > 0 else tr("{size} less")).format(size=size)


def change_since_first(verdict: str, change_deg: float) -> str:
    """Return the short form for the patient's card."""
    if verdict in ("improved", "worse"):
        return tr("{difference} since first session").format(difference=difference_words(change_deg))
    if verdict == "no_change":
        return verdict_word(verdict)
    return ""


def short_change_words(verdict: str, change_deg: float, limit_deg: float) -> str:
    """Return ``2° more, within MDC (10°)``."""
    if verdict == "not_judged" or change_deg != change_deg:
        return tr("not assessed") if verdict == "not_judged" else ""
    pattern = (
        tr("{difference}, within MDC ({limit})") if verdict == "no_change" else tr("{difference}, beyond MDC ({limit})")
    )
    return pattern.format(difference=difference_words(change_deg), limit=numbers.format_degrees(limit_deg))


def headline(progress: Progress) -> tuple[str, str]:
    """Return the answer in one sentence, and the values behind it."""
    if not progress.points:
        return tr("No sessions of this exercise yet."), ""
    first, last, main = progress.reference, progress.current, progress.main_comparison
    compared = [point for point in progress.points if not point.reasons]
    if len(compared) < 2 and len(progress.points) > 1:
        out = len(progress.points) - len(compared)
        is_kept = tr("1 session is excluded.") if out == 1 else tr("{count} sessions are excluded.").format(count=out)
        reason = tr("Excluded sessions and sessions with another set-up are not compared.")
        return tr("Nothing to compare: {left_out}").format(left_out=is_kept), reason
    if first is None or last is None or main is None or first is last:
        return tr("At least two sessions are needed to show progress."), tr(
            "Compare after the next session of the same kind."
        )
    day = numbers.format_distinct_day(first.when, last.when)
    name = _subject(main)
    size = numbers.format_degrees(main.display_difference_deg)
    if main.is_lower_bound:
        size = tr("at least {size}").format(size=size)
    gained = [
        item
        for item in progress.comparisons
        if is_total_active_motion(item.after.subject) and item.verdict == "improved"
    ]
    if len(gained) > 1 and main.verdict == "improved":
        pattern = tr("TAM has improved in {count} of {all} fingers since {day}.")
        answer = pattern.format(count=len(gained), all=len(progress.comparisons), day=day)
        return answer, " ".join(_change_sentence(item) for item in progress.comparisons if item.is_beyond_error)
    if main.verdict == "improved":
        answer = tr("{name} has improved by {size} since {day}.").format(name=name, size=size, day=day)
    elif main.verdict == "worse":
        answer = tr("{name} has decreased by {size} since {day}.").format(name=name, size=size, day=day)
    elif main.verdict == "no_change":
        answer = tr("No change beyond measurement error since {day}.").format(day=day)
    elif main.is_joint and min(first.repetition_count, last.repetition_count) >= MIN_REPETITIONS_FOR_SD:
        return tr("Not assessed: the joints were partly occluded."), tr("Frames with occluded joints are not analysed.")
    else:
        reason = reason_words(main.reasons)
        return tr("Not assessed: {why}.").format(why=reason or tr("too few repetitions to compare")), ""
    others = [item for item in progress.comparisons if item is not main and item.verdict != "not_judged"]
    if main.is_joint:  # of many joints only those that changed
        others = [item for item in others if item.is_beyond_error]
    turned = any(item.after.quantity in terms.FOREARM for item in progress.comparisons)
    zero = [terms.thumb_up_words()] if turned else []
    return answer, " ".join([_basis(main), *(_change_sentence(item) for item in others), *zero])


def comparison_name(item: Comparison, comparisons: Sequence[Comparison] = ()) -> str:
    """Return the name of a compared measure, distinct from the other ``comparisons``."""
    return range_name(item.after, names_arc=sum(one.after.quantity == "arc" for one in comparisons) > 1)


def range_name(row: Measure, *, names_arc: bool) -> str:
    """Return the name of a range; ``names_arc`` says of which angle an arc is."""
    if row.wrist_angle < 0:
        return find_finger_angle(row.subject).long_name
    return terms.arc_name(row.wrist_angle) if names_arc and row.quantity == "arc" else terms.movement_name(row.quantity)


def _subject(item: Comparison) -> str:
    if item.is_joint:
        figure = find_finger_angle(item.after.subject)
        finger = to_mid_sentence(long_finger_name(str(figure.finger)))
        return tr("{joint} of the {finger}").format(joint=figure.kind_name, finger=finger)
    what = item.after.quantity
    return tr("The total arc") if what == "arc" else terms.movement_long_name(what)


def _basis(item: Comparison) -> str:
    before, after = _end_values(item)
    limit = numbers.format_degrees(item.limit_deg)
    if item.is_beyond_error:
        pattern = tr("From {before} to {after}: more than the measurement error of {limit}.")
    else:
        pattern = tr("From {before} to {after}: within the measurement error of {limit}.")
    return pattern.format(before=before, after=after, limit=limit)


def _change_sentence(item: Comparison) -> str:
    name = _subject(item) if item.is_joint else terms.movement_long_name(item.after.quantity)
    if item.is_beyond_error:
        return tr("{name}: {change}.").format(name=name, change=_size_of_change(item))
    return tr("{name}: no change beyond measurement error.").format(name=name)


def value_pair(item: Comparison) -> str:
    """Return ``34° → 57°``, with ``≥`` before a value limited by occlusion."""
    signs = [f"≥{numbers.NARROW_GAP}" if limited else "" for limited in item.lower_bounds]
    before, after = _end_values(item)
    return f"{signs[0]}{before} → {signs[1]}{after}"


def _end_values(item: Comparison) -> tuple[str, str]:
    before, after = item.before, item.after
    if item.is_joint:
        return numbers.format_degrees(before.mean), numbers.format_degrees(after.mean)
    return terms.end_words(before.mean, after.quantity), terms.end_words(after.mean, after.quantity)


def change_line(item: Comparison) -> str:
    """Return ``23° more, MDC 10°``; of an occluded joint at most a lower bound."""
    if item.is_joint and item.verdict == "not_judged":
        return tr("partly occluded, or too few")
    return tr("{change}, MDC {limit}").format(
        change=_size_of_change(item), limit=numbers.format_degrees(item.limit_deg)
    )


def _size_of_change(item: Comparison) -> str:
    change = difference_words(item.display_difference_deg)
    return tr("at least {change}").format(change=change) if item.is_lower_bound else change


def _day_text(point: ProgressPoint, progress: Progress) -> str:
    return numbers.format_distinct_day(point.results.when, *(other.results.when for other in progress.points))


def uncertainty_words(point: ProgressPoint, progress: Progress) -> str:
    """Say what was uncertain about a session that is compared; empty if nothing."""
    text = " ".join(finding_words(finding).summary for finding in point.results.findings)
    if not text or not point.is_comparable:
        return ""
    words = tr("{day}: measured although uncertain. {findings}")
    return words.format(day=_day_text(point, progress), findings=text)


def exclusion_words(point: ProgressPoint, progress: Progress) -> str:
    """Say why a session is excluded, and that its ring shows so if anything was measured."""
    first = progress.reference
    reasons = []
    for reason in point.reasons:
        step_cm = 100 * (point.results.quality.distance_m - first.quality.distance_m) if first else math.nan
        pattern = tr("camera {step} cm further away") if step_cm > 0 else tr("camera {step} cm nearer")
        words = {
            "distance": pattern.format(step=format_rounded(abs(step_cm))),
            "forearm_moved": tr("the forearm moved {distance}").format(
                distance=numbers.format_millimetres(point.results.quality.forearm_movement_mm)
            ),
        }
        reasons.append(words.get(reason) or reason_words((reason,)))
    day = _day_text(point, progress)
    has_ring = point.results.measures_in_group("range")
    pattern = (
        tr("{day}: {reasons}. Excluded (shown as an open circle).") if has_ring else tr("{day}: {reasons}. Excluded.")
    )
    return pattern.format(day=day, reasons=", ".join(reasons))


def compared_words(progress: Progress) -> str:
    """Return days and repetitions of the sessions that are compared; empty without any."""
    first, last = progress.reference, progress.current
    if first is None or last is None or not progress.comparisons:
        return ""
    days = tr("{first} and {last}").format(
        first=numbers.format_distinct_day(first.when, last.when),
        last=numbers.format_distinct_day(last.when, first.when),
    )
    counts = tr("{before} and {after} repetitions").format(before=first.repetition_count, after=last.repetition_count)
    return f"{days} · {counts}"


def comparability_lines(progress: Progress, most: int | None = None) -> list[tuple[str, str]]:
    """Return text and colour: ``most`` exclusions and doubts, or that all sessions were set up alike."""
    unfair = [exclusion_words(point, progress) for point in progress.points if not point.is_comparable]
    doubts = [words for point in progress.points if (words := uncertainty_words(point, progress))]
    lines = [(words, "text") for words in unfair[:most]] + [(words, "warn") for words in doubts[:most]]
    if not unfair:
        lines.append((tr("All sessions used the same set-up."), "text"))
    if once := duplicate_result_words(progress.earlier_results):
        lines.append((once, "text"))
    return lines


def correction_words(results: SessionResults) -> str:
    """Say when and by whom markers were corrected after the recording; empty if never."""
    text = results.correction
    if text is None:
        return ""
    day, at = numbers.format_date(text.corrected_at), numbers.format_clock_tenths(text.first_corrected_s)
    if text.initials:
        return tr("Corrected on {day}, from {time}, by {who}.").format(day=day, time=at, who=text.initials)
    return tr("Corrected on {day}, from {time}.").format(day=day, time=at)
