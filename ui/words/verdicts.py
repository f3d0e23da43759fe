"""Sentences about change; a difference is a change only beyond the measurement error."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from datetime import datetime

from carpus.core.measures.change_limits import RetestStudy
from carpus.core.model.phrase import Phrase, phrase
from carpus.ui.kit import numbers
from carpus.ui.kit.translate import tr, translate_phrase

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
    """Return ``2° more, within MDC (10°)``, for paper."""
    if verdict == "not_judged" or change_deg != change_deg:
        return tr("not assessed") if verdict == "not_judged" else ""
    pattern = (
        tr("{difference}, within MDC ({limit})") if verdict == "no_change" else tr("{difference}, beyond MDC ({limit})")
    )
    return pattern.format(difference=difference_words(change_deg), limit=numbers.format_degrees(limit_deg))


def long_change_words(verdict: str, change_deg: float, limit_deg: float) -> str:
    """Return ``2° more: within MDC (10°)``, for tables."""
    if verdict == "not_judged" or change_deg != change_deg:
        return ""
    pattern = (
        tr("{difference}: within MDC ({limit})") if verdict == "no_change" else tr("{difference}: beyond MDC ({limit})")
    )
    return pattern.format(difference=difference_words(change_deg), limit=numbers.format_degrees(limit_deg))
