"""Table of the fingers, for the review and the report."""

from __future__ import annotations

import math

from carpus.core.model.phrase import Phrase, phrase
from carpus.core.model.rounding import format_rounded
from carpus.core.results.measure import Measure, is_total_active_motion, negate_measure
from carpus.core.results.norms import SHARE_OF_OTHER, compute_total_shares, grade_share, total_norm
from carpus.core.results.progress import compare_ranges
from carpus.core.results.session_results import SessionResults
from carpus.ui.kit import numbers
from carpus.ui.kit.fonts import MEDIUM, REGULAR, SEMIBOLD
from carpus.ui.kit.table import VERDICT_TOKENS, Cell, TableColumn, TableContent, TableRow
from carpus.ui.kit.translate import to_mid_sentence, tr, translate_phrase
from carpus.ui.words import terms
from carpus.ui.words.finger_angles import (
    FINGERS,
    KIND_TOKENS,
    AngleKind,
    FingerAngle,
    find_finger_angle,
    format_spread,
)
from carpus.ui.words.progress import reason_words, short_change_words
from carpus.ui.words.ranges import LOWER_BOUND, is_deficit, mean_words
from carpus.ui.words.task_measures import short_task_summary
from carpus.ui.words.terms import finger_name

COLUMNS: tuple[AngleKind, ...] = ("knuckle", "middle", "end", "spread", "tam")


_GRADES = {
    "excellent": phrase("excellent"), "good": phrase("good"), "fair": phrase("fair"), "poor": phrase("poor"),
    None: phrase("not graded"),
}  # fmt: skip
# What an exercise trains, in the head of a column and before a list of fingers.
_MAIN_NAMES = {
    "tam": (phrase("TAM"), phrase("TAM")), "spread": (phrase("abduction"), phrase("Abduction")),
    "middle": (phrase("PIP"), phrase("PIP joints")),
}  # fmt: skip
_FINGER_GROUPS = {
    "knuckle": phrase("MCP of {fingers}"), "middle": phrase("PIP of {fingers}"),
    "end": phrase("DIP of {fingers}"), "spread": phrase("abduction of {fingers}"),
}  # fmt: skip
_THUMB_NAMES: dict[AngleKind, Phrase] = {
    "knuckle": phrase("MCP"),
    "middle": phrase("Palm. abd."),
    "end": phrase("IP"),
}


_COLUMN = TableColumn(is_wrapped=False)
# Finger, five values, share of the total, last time, change.
FINGER_COLUMNS = (
    TableColumn(MEDIUM, is_wrapped=False), *(_COLUMN,) * 6, TableColumn(is_wrapped=False, scale=0.95),
    TableColumn(MEDIUM, "text2", min_letters=15, scale=0.9),
)  # fmt: skip


def finger_table(
    results: SessionResults, previous: SessionResults | None, other_hand: SessionResults | None = None
) -> TableContent:
    """Return the table of all fingers.

    Last time and change are those of the total, of spread or of the PIP joint, whichever the exercise trains. The
    total is given as a share of that of ``other_hand``.
    """
    shares = {share.subject: share for share in _find_shares(results, other_hand)}
    rows = (_line_of_finger(finger, results, previous, shares.get(f"TAM{finger}")) for finger in FINGERS)
    return TableContent(FINGER_COLUMNS, _head_line(results, previous, other_hand), tuple(rows))


def _find_shares(results: SessionResults, other_hand: SessionResults | None) -> tuple[Measure, ...]:
    return compute_total_shares(
        results.joint_ranges, results.exercise, () if other_hand is None else other_hand.joint_ranges
    )


def _head_line(results: SessionResults, previous: SessionResults | None, other_hand: SessionResults | None) -> TableRow:
    day = numbers.format_time_or_day(previous.when, results.when) if previous and is_joint_exercise(results) else ""
    compared = tr("palm. abd.") if is_thumb_exercise(results) else translate_phrase(_MAIN_NAMES[main_kind(results)][0])
    total = share = ""
    if has_totals(results):
        shares = _find_shares(results, other_hand)
        of_other = bool(shares) and all(share.quantity == SHARE_OF_OTHER for share in shares)
        total, share = tr("Total (TAM)"), tr("% of other hand") if of_other else tr("% of reference")
    joints: tuple[tuple[AngleKind, str], ...] = (
        ("knuckle", tr("MCP")), ("middle", tr("PIP")), ("end", tr("DIP")), ("tam", total),
    )  # fmt: skip
    *bent, all_joints = (Cell(words, MEDIUM, "text2", mark_token=KIND_TOKENS[row]) for row, words in joints)
    last = tr("{what}, {day}").format(what=compared, day=day) if day else ""
    change = tr("Change since {day}").format(day=day) if day else ""
    return ("", *bent, tr("Abduction"), all_joints, share, last, change)


def is_joint_exercise(results: SessionResults) -> bool:
    """Return whether the exercise trains a joint, which is then compared with last time."""
    return bool(results.exercise.joint) or not results.exercise.is_task


def has_totals(results: SessionResults) -> bool:
    """Return whether the exercise includes a fist, which has total active motion."""
    return results.exercise.has_total_motion


def main_kind(results: SessionResults) -> AngleKind:
    """Return the kind of angle that the exercise trains."""
    if has_totals(results):
        return "tam"
    return find_finger_angle(results.exercise.joint).kind


def main_kind_name(results: SessionResults) -> str:
    """Return the name of what the exercise trains."""
    return tr("Thumb") if is_thumb_exercise(results) else translate_phrase(_MAIN_NAMES[main_kind(results)][1])


def is_thumb_exercise(results: SessionResults) -> bool:
    """Return whether the exercise trains the thumb alone."""
    return bool(results.exercise.joint) and find_finger_angle(results.exercise.joint).finger == 1


def main_angles(results: SessionResults) -> tuple[FingerAngle, ...]:
    """Return the angles that are compared with last time."""
    fingers = (1,) if is_thumb_exercise(results) else results.exercise.digits or FINGERS
    return tuple(FingerAngle(finger, main_kind(results)) for finger in fingers)


def find_main_ranges(results: SessionResults) -> tuple[Measure, ...]:
    """Return the ranges whose change is reported."""
    if not results.joint_ranges:
        return results.wrist_ranges
    found = (results.find(figure.joint, "arc") for figure in main_angles(results))
    return tuple(row for row in found if row is not None)


def limitation_words(results: SessionResults) -> str:
    """Say which ranges were limited by occlusion; empty if none."""
    limited: dict[AngleKind, list[str]] = {row: [] for row in COLUMNS}
    unseen: list[str] = []
    lifted: list[str] = []
    for finger in FINGERS:
        for row in COLUMNS:
            found = results.find(FingerAngle(finger, row).joint, "arc")
            if found is None or row == "tam":
                continue
            if not found.count:
                unseen.append(FingerAngle(finger, row).long_name)
            elif found.is_lower_bound and finger == 1 and row == "middle":
                lifted.append(tr("palmar abduction of the thumb"))
            elif found.is_lower_bound:
                limited[row].append(to_mid_sentence(finger_name(str(finger))))
    parts = []
    for row, names in limited.items():
        if names:
            patient = tr("all fingers") if len(names) == len(FINGERS) else ", ".join(names)
            parts.append(translate_phrase(_FINGER_GROUPS[row]).format(fingers=patient))
    parts += lifted
    words = []
    if parts:
        pattern = tr("Partly occluded ({sign} = minimum): {parts}. Frames with occluded joints are not analysed.")
        words.append(pattern.format(sign=LOWER_BOUND, parts="; ".join(parts)))
    if unseen:
        words.append(tr("Not visible: {joints}.").format(joints="; ".join(unseen)))
    return " ".join([*words, *total_words(results)])


def total_words(results: SessionResults) -> list[str]:
    """Explain TAM, or say why there is none."""
    totals = [row for row in results.joint_ranges if is_total_active_motion(row.subject)]
    if not totals:
        return []
    words = [
        tr("Total active motion (TAM): a finger’s largest total flexion minus its smallest, with all joints visible.")
    ]
    if not any(row.count for row in totals):
        words = [tr("No total active motion (TAM): no finger had all joints visible at once.")]
    elif any(not row.count for row in totals):
        words.append(tr("TAM is missing for fingers whose joints were never all visible at once."))
    if any(row.is_inferred for row in totals):
        words.append(tr("DIP not measured: TAM uses two thirds of the PIP flexion."))
    norm = total_norm(2, results.exercise)
    if any(row.count for row in totals) and norm is not None:
        words.append(
            tr(
                "Percentage of the other hand’s TAM or, if not known, of the reference value of 260° (thumb 140°). "
                "ASSH: excellent from 100 %, good above 75 %, fair above 50 %, otherwise poor."
            )
        )
        words.append(translate_phrase(norm.sentence()))
    return words


def range_cell(results: SessionResults, angle: FingerAngle) -> str | Cell:
    """Return the cell of a joint's range with its ends.

    The thumb's cells name their joint, so that none is copied as a finger's PIP or DIP.
    """
    row = results.find(angle.joint, "arc")
    if row is None and angle.kind == "tam":
        return ""
    words, ends = tr("not visible"), ""
    if row is None:
        words = tr("not measured") if angle.kind == "end" else numbers.UNKNOWN
    elif row.count:
        words, ends = range_words(row), _range_ends(results, angle)
    joint = translate_phrase(_THUMB_NAMES.get(angle.kind, "")) if angle.finger == 1 else ""
    shown = f"{joint} {words}" if joint else words
    return Cell(shown, SEMIBOLD, subtext=ends) if ends else Cell(shown, REGULAR, "text2")


def _share_cell(share: Measure | None) -> str | Cell:
    if share is None:
        return ""
    at_least = f"{LOWER_BOUND}{numbers.NARROW_GAP}" if share.is_lower_bound else ""
    words = f"{at_least}{format_rounded(100.0 * share.mean)}{numbers.NARROW_GAP}%"
    return Cell(words, SEMIBOLD, subtext=translate_phrase(_GRADES[grade_share(share)]))


def _line_of_finger(
    finger: int, results: SessionResults, previous: SessionResults | None, share: Measure | None
) -> TableRow:
    compared = FingerAngle(finger, main_kind(results))
    today = before = None
    if compared in main_angles(results) and is_joint_exercise(results):
        today = results.find(compared.joint, "arc")
        before = previous.find(compared.joint, "arc") if previous else None
    change, verdict = "", ""
    if previous is not None and today is not None and (found := compare_ranges(previous, results, [today])):
        verdict = found[0].verdict
        change = short_change_words(verdict, found[0].display_difference_deg, found[0].limit_deg)
        if found[0].is_lower_bound:
            change = tr("at least {change}").format(change=change)
        if verdict == "not_judged":
            change = tr("not assessed: {why}").format(why=reason_words(found[0].reasons))
    return (
        finger_name(str(finger)),
        *(range_cell(results, FingerAngle(finger, row)) for row in COLUMNS),
        _share_cell(share),
        range_words(before, has_sd=False) if before is not None and before.count else "",
        Cell(change, MEDIUM, VERDICT_TOKENS.get(verdict, "text2")),
    )


def range_words(row: Measure, *, has_sd: bool = True) -> str:
    """Return ``57° ± 2°``, or ``≥ 57°`` if the end of the movement was occluded."""
    sd = row.sd if math.isfinite(row.sd) else row.measurement_sd
    if row.is_lower_bound:  # a spread would be that of where the joint went out of sight
        return f"{LOWER_BOUND}{numbers.NARROW_GAP}{numbers.format_degrees(row.mean)}"
    return numbers.format_with_sd(row.mean, sd) if has_sd else numbers.format_degrees(row.mean)


def _range_ends(results: SessionResults, angle: FingerAngle) -> str:
    """Return both ends of a range, such as ``−3° to 87°``."""
    low, high = (results.find(angle.joint, end) for end in ("extension", "flexion"))
    if low is None or high is None:
        return ""
    if angle.kind == "tam":
        return tr("flexion {full}, deficit {missing}").format(
            full=numbers.format_degrees(high.mean), missing=numbers.format_degrees(low.mean)
        )
    ends = sorted((angle.sign * low.mean, angle.sign * high.mean))
    if angle.kind == "spread":
        low_words, high_words = (format_spread(end, angle.finger) for end in ends)
    else:
        low_words, high_words = (numbers.format_signed_degrees(end) for end in ends)
    return tr("{low} to {high}").format(low=low_words, high=high_words)


def progress_choices(results: SessionResults) -> list[tuple[str, str]]:
    """Return what can be followed over the sessions of a whole hand, as value and text; the trained one first.

    Empty for the wrist alone. An empty value stands for the wrist of a whole hand.
    """
    if not results.joint_ranges:
        return []
    kinds = [("tam", tr("TAM of all fingers"))] if main_kind(results) == "tam" else []
    kinds.append(("spread", tr("Abduction of all fingers")))
    kinds.append(("1", finger_name("1")))
    kinds += [(str(k), tr("{finger} finger").format(finger=finger_name(str(k)))) for k in FINGERS[1:]]
    if is_thumb_exercise(results):
        return [("lift", tr("Palmar and radial abduction of the thumb")), *kinds[1:], kinds[0], ("", tr("Wrist"))]
    if main_kind(results) == "middle":
        kinds = [*kinds[1:], kinds[0]]
    return [*kinds, ("", tr("Wrist"))]


def main_result_words(results: SessionResults) -> str:
    """Return the main result of a session in a few words."""
    about = short_task_summary(results)
    if about:
        return about
    if results.joint_ranges:
        trained = find_finger_angle(results.exercise.joint).finger
        for figure in sorted(main_angles(results), key=lambda one: one.finger != trained):
            row = results.find(figure.joint, "arc")
            if row is not None and row.count:
                return f"{figure.long_name} {range_words(row)}"
        return ""
    rows = [row for row in results.wrist_ranges if row.quantity != "arc" and row.count] or [*results.wrist_ranges]
    if not rows:
        return ""
    if is_deficit(rows[0]):
        return f"{terms.deficit_name(rows[0].quantity)} {mean_words(negate_measure(rows[0]))}"
    return f"{terms.movement_name(rows[0].quantity)} {mean_words(rows[0])}"
