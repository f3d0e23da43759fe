"""The table of the fingers in words, the same on the review screen and on the page."""

from __future__ import annotations

import math

from carpus.core.phrase import Phrase, phrase
from carpus.core.results.figures import SessionFigures
from carpus.core.results.measure import Measure, MeasureKey, is_total, turn_round
from carpus.core.results.norms import SHARE_OF_OTHER, grade_share, total_norm, total_shares
from carpus.core.results.progress import compare
from carpus.core.results.ranges import finger_keys, spread_keys, thumb_keys
from carpus.core.rounding import written
from carpus.ui import numbers, terms
from carpus.ui.figures import FINGERS, TOKENS, Figure, Row, figure_of, with_side
from carpus.ui.fonts import MEDIUM, REGULAR, SEMIBOLD
from carpus.ui.marker_words import finger_name
from carpus.ui.translate import inside, say, tr
from carpus.ui.verdicts import change_short, reason_words
from carpus.ui.words.further import short_words
from carpus.ui.words.ranges import is_deficit, mean_words
from carpus.ui.words.table import VERDICT_TOKENS, Cell, TableColumn, TableLine, TableWords

COLUMNS: tuple[Row, ...] = ("knuckle", "middle", "end", "spread", "tam")
AT_LEAST = "≥"
"""Before a range that a hidden joint may have exceeded; always explained beside the table."""


_GRADES = {
    "excellent": phrase("excellent"), "good": phrase("good"), "fair": phrase("fair"), "poor": phrase("poor"),
    None: phrase("not graded"),
}  # fmt: skip
_COMPARED = {
    "tam": (phrase("TAM"), phrase("TAM")), "spread": (phrase("spread"), phrase("Spreading")),
    "middle": (phrase("PIP"), phrase("Middle joints")),
}  # fmt: skip
"""What an exercise is about, in the head of a column and before a list of fingers."""
_OF_FINGERS = {
    "knuckle": phrase("knuckles of {fingers}"), "middle": phrase("middle joints of {fingers}"),
    "end": phrase("end joints of {fingers}"), "spread": phrase("spreading of {fingers}"),
}  # fmt: skip
_OF_THUMB: dict[Row, Phrase] = {"knuckle": phrase("MCP"), "middle": phrase("Lift"), "end": phrase("IP")}


_COLUMN = TableColumn(wraps=False)
FINGER_COLUMNS = (
    TableColumn(MEDIUM, wraps=False), *(_COLUMN,) * 6, TableColumn(wraps=False, scale=0.95),
    TableColumn(MEDIUM, "text2", least=15, scale=0.9),
)  # fmt: skip
"""Finger, five values, share of the total, last time, change."""


def finger_table(
    figures: SessionFigures, previous: SessionFigures | None, other: SessionFigures | None = None
) -> TableWords:
    """Thumb to little finger; last time and change are those of the total, of spreading or of the middle joint,
    whichever the exercise is about. ``other`` the other hand, of which a total is a share."""
    shares = {share.of: share for share in _find_shares(figures, other)}
    rows = (_line_of_finger(finger, figures, previous, shares.get(f"TAM{finger}")) for finger in FINGERS)
    return TableWords(FINGER_COLUMNS, _head_line(figures, previous, other), tuple(rows))


def _find_shares(figures: SessionFigures, other: SessionFigures | None) -> tuple[Measure, ...]:
    """Of every total, of the other hand's where that is known."""
    return total_shares(figures.joint_ranges, figures.exercise, () if other is None else other.joint_ranges)


def _head_line(figures: SessionFigures, previous: SessionFigures | None, other: SessionFigures | None) -> TableLine:
    """The joints with the colours of their curves, the share of the total, last time, the change."""
    day = numbers.since(previous.when, figures.when) if previous and trains_joints(figures) else ""
    compared = tr("lift") if trains_thumb(figures) else say(_COMPARED[compared_row(figures)][0])
    total = share = ""
    if has_totals(figures):
        shares = _find_shares(figures, other)
        of_other = bool(shares) and all(share.what == SHARE_OF_OTHER for share in shares)
        total, share = tr("Total (TAM)"), tr("Of other hand") if of_other else tr("Of usual")
    joints: tuple[tuple[Row, str], ...] = (
        ("knuckle", tr("Knuckle (MCP)")), ("middle", tr("Middle (PIP)")), ("end", tr("End (DIP)")), ("tam", total),
    )  # fmt: skip
    *bent, all_joints = (Cell(words, MEDIUM, "text2", mark=TOKENS[row]) for row, words in joints)
    last = tr("{what}, {day}").format(what=compared, day=day) if day else ""
    change = tr("Change since {day}").format(day=day) if day else ""
    return ("", *bent, tr("Spread"), all_joints, share, last, change)


def trains_joints(figures: SessionFigures) -> bool:
    """Whether a joint is what the exercise is about: then it is compared with last time."""
    return bool(figures.exercise.joint) or not figures.exercise.is_task


def has_totals(figures: SessionFigures) -> bool:
    """Whether the exercise asks for a fist, of which there is a total."""
    return figures.exercise.total


def compared_row(figures: SessionFigures) -> Row:
    """What of a finger the exercise is about."""
    if has_totals(figures):
        return "tam"
    return figure_of(figures.exercise.joint).row


def name_compared_joints(figures: SessionFigures) -> str:
    """What of a finger the exercise is about, before a list of fingers."""
    return tr("Thumb") if trains_thumb(figures) else say(_COMPARED[compared_row(figures)][1])


def trains_thumb(figures: SessionFigures) -> bool:
    """Whether the exercise is the thumb's alone."""
    return bool(figures.exercise.joint) and figure_of(figures.exercise.joint).finger == 1


def compared_figures(figures: SessionFigures) -> tuple[Figure, ...]:
    """What is compared with last time: of the fingers that the exercise trains, or of the thumb alone."""
    fingers = (1,) if trains_thumb(figures) else figures.exercise.digits or FINGERS
    return tuple(Figure(finger, compared_row(figures)) for finger in fingers)


def find_compared_ranges(figures: SessionFigures) -> tuple[Measure, ...]:
    """The ranges whose change is said: of the wrist all, of the whole hand what the exercise is about."""
    if not figures.joint_ranges:
        return figures.wrist_ranges
    found = (figures.find(figure.joint, "arc") for figure in compared_figures(figures))
    return tuple(row for row in found if row is not None)


def limits_words(figures: SessionFigures) -> str:
    """Which figures the camera's view limits, in words; empty when none."""
    limited: dict[Row, list[str]] = {row: [] for row in COLUMNS}
    unseen: list[str] = []
    lifted: list[str] = []
    for finger in FINGERS:
        for row in COLUMNS:
            found = figures.find(Figure(finger, row).joint, "arc")
            if found is None or row == "tam":
                continue
            if not found.count:
                unseen.append(Figure(finger, row).long_name)
            elif found.at_least and finger == 1 and row == "middle":
                lifted.append(tr("lift of the thumb"))
            elif found.at_least:
                limited[row].append(inside(finger_name(str(finger))))
    parts = []
    for row, names in limited.items():
        if names:
            who = tr("all fingers") if len(names) == len(FINGERS) else ", ".join(names)
            parts.append(say(_OF_FINGERS[row]).format(fingers=who))
    parts += lifted
    words = []
    if parts:
        pattern = tr("Limited by the camera’s view ({sign}: at least): {parts}. Hidden stretches do not count.")
        words.append(pattern.format(sign=AT_LEAST, parts="; ".join(parts)))
    if unseen:
        words.append(tr("Not seen: {joints}.").format(joints="; ".join(unseen)))
    return " ".join([*words, *total_words(figures)])


def total_words(figures: SessionFigures) -> list[str]:
    """What TAM is, or why there is none."""
    totals = [row for row in figures.joint_ranges if is_total(row.of)]
    if not totals:
        return []
    words = [tr("Total active motion (TAM): the largest sum of a finger’s bending in one moment, all its joints seen.")]
    if not any(row.count for row in totals):
        words = [tr("No total active motion (TAM): no finger’s joints were all seen at once.")]
    elif any(not row.count for row in totals):
        words.append(tr("It is missing where a finger’s joints were never all seen at once."))
    if any(row.inferred for row in totals):
        words.append(tr("DIP not measured: TAM takes it as two thirds of PIP."))
    norm = total_norm(2, figures.exercise)
    if any(row.count for row in totals) and norm is not None:
        words.append(
            tr(
                "Share of the other hand’s TAM, else of the usual 260° (thumb 140°): excellent from 100 %, good above "
                "75 %, fair above 50 %, else poor (ASSH)."
            )
        )
        words.append(say(norm.sentence()))
    return words


def cell_of(figures: SessionFigures, figure: Figure) -> str | Cell:
    """The range of one joint or finger, over the ends that it went to. A thumb has no middle joint, and none of its
    angles may be copied as a finger's PIP or DIP: its joints have their names."""
    row = figures.find(figure.joint, "arc")
    if row is None and figure.row == "tam":
        return ""
    words, ends = tr("not seen"), ""
    if row is None:
        words = tr("not measured") if figure.row == "end" else numbers.UNKNOWN
    elif row.count:
        words, ends = range_words(row), _ends(figures, figure)
    joint = say(_OF_THUMB.get(figure.row, "")) if figure.finger == 1 else ""
    shown = f"{joint} {words}" if joint else words
    return Cell(shown, SEMIBOLD, below=ends) if ends else Cell(shown, REGULAR, "text2")


def _share_cell(share: Measure | None) -> str | Cell:
    """Its grade under it; a total that was not seen whole has none."""
    if share is None:
        return ""
    at_least = f"{AT_LEAST}{numbers.NARROW_GAP}" if share.at_least else ""
    words = f"{at_least}{written(100.0 * share.mean)}{numbers.NARROW_GAP}%"
    return Cell(words, SEMIBOLD, below=say(_GRADES[grade_share(share)]))


def _line_of_finger(
    finger: int, figures: SessionFigures, previous: SessionFigures | None, share: Measure | None
) -> TableLine:
    compared = Figure(finger, compared_row(figures))
    today = before = None
    if compared in compared_figures(figures) and trains_joints(figures):
        today = figures.find(compared.joint, "arc")
        before = previous.find(compared.joint, "arc") if previous else None
    change, verdict = "", ""
    if previous is not None and today is not None and (found := compare(previous, figures, [today])):
        verdict = found[0].verdict
        change = change_short(verdict, found[0].shown_difference_deg, found[0].limit_deg)
        if found[0].at_least:
            change = tr("at least {change}").format(change=change)
        if verdict == "not_judged":
            change = tr("not judged: {why}").format(why=reason_words(found[0].reasons))
    return (
        finger_name(str(finger)),
        *(cell_of(figures, Figure(finger, row)) for row in COLUMNS),
        _share_cell(share),
        range_words(before, spread=False) if before is not None and before.count else "",
        Cell(change, MEDIUM, VERDICT_TOKENS.get(verdict, "text2")),
    )


def range_words(row: Measure, *, spread: bool = True) -> str:
    """``57° ± 2°``, or ``≥ 57°`` where the end of the movement was not seen."""
    sd = row.sd if math.isfinite(row.sd) else row.measurement_sd
    if row.at_least:  # a spread would be that of where the joint went out of sight
        return f"{AT_LEAST}{numbers.NARROW_GAP}{numbers.degrees(row.mean)}"
    return numbers.with_spread(row.mean, sd) if spread else numbers.degrees(row.mean)


def _ends(figures: SessionFigures, figure: Figure) -> str:
    """``3° to 87°``; ``−3° to 87°`` where it bends back beyond straight; spreading with its sides."""
    low, high = (figures.find(figure.joint, end) for end in ("extension", "flexion"))
    if low is None or high is None:
        return ""
    if figure.row == "tam":
        return tr("bends {full}, lacks {missing}").format(
            full=numbers.degrees(high.mean), missing=numbers.degrees(low.mean)
        )
    ends = sorted((figure.sign * low.mean, figure.sign * high.mean))
    if figure.row == "spread":
        low_words, high_words = (with_side(end, figure.finger) for end in ends)
    else:
        low_words, high_words = (numbers.signed_degrees(end) for end in ends)
    return tr("{low} to {high}").format(low=low_words, high=high_words)


def followed_kinds(figures: SessionFigures) -> list[tuple[str, str]]:
    """What of the whole hand can be followed over the sessions, as value and words; what is trained first.

    Empty for the wrist alone; the last choice (an empty value) is the wrist of a whole hand.
    """
    if not figures.joint_ranges:
        return []
    kinds = [("tam", tr("TAM of all fingers"))] if compared_row(figures) == "tam" else []
    kinds.append(("spread", tr("Spreading of all fingers")))
    kinds += [(str(finger), _whole_name(finger)) for finger in FINGERS]
    if trains_thumb(figures):
        return [("lift", tr("Lift and spread of the thumb")), *kinds[1:], kinds[0], ("", tr("Wrist"))]
    if compared_row(figures) == "middle":
        kinds = [*kinds[1:], kinds[0]]
    return [*kinds, ("", tr("Wrist"))]


def followed_keys(what: str) -> tuple[MeasureKey, ...]:
    """What a choice of :func:`followed_kinds` follows."""
    if what == "spread":
        return spread_keys()
    if what == "lift":
        return thumb_keys()
    return finger_keys(0 if what == "tam" else int(what)) if what else ()


def _whole_name(finger: int) -> str:
    name = finger_name(str(finger))
    return name if finger == 1 else tr("{finger} finger").format(finger=name)


def main_figure(figures: SessionFigures) -> str:
    """The figure that a therapist looks for first: the best of the trained movement, or the first joint."""
    about = short_words(figures)
    if about:
        return about
    if figures.joint_ranges:
        trained = figure_of(figures.exercise.joint).finger
        for figure in sorted(compared_figures(figures), key=lambda one: one.finger != trained):
            row = figures.find(figure.joint, "arc")
            if row is not None and row.count:
                return f"{figure.long_name} {range_words(row)}"
        return ""
    rows = [row for row in figures.wrist_ranges if row.what != "arc" and row.count] or [*figures.wrist_ranges]
    if not rows:
        return ""
    if is_deficit(rows[0]):
        return f"{terms.deficit_name(rows[0].what)} {mean_words(turn_round(rows[0]))}"
    return f"{terms.movement_name(rows[0].what)} {mean_words(rows[0])}"
