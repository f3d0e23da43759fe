"""The table of the fingers in words, the same on the review screen and on the page."""

from __future__ import annotations

import math
from dataclasses import dataclass

from carpus.core.phrase import Phrase, phrase
from carpus.core.results.figures import SessionFigures
from carpus.core.results.measure import Measure, MeasureKey, is_total, turn_round
from carpus.core.results.norms import SHARE_OF_OTHER, Grade, grade_share, total_norm, total_shares
from carpus.core.results.progress import compare
from carpus.core.results.ranges import finger_keys, spread_keys, thumb_keys
from carpus.core.rounding import written
from carpus.ui import numbers, terms
from carpus.ui.figures import FINGERS, Figure, Row, figure_of, with_side
from carpus.ui.marker_words import finger_name
from carpus.ui.translate import inside, say, tr
from carpus.ui.verdicts import change_short, reason_words
from carpus.ui.words.further import main_words, short_words
from carpus.ui.words.ranges import is_deficit, mean_words
from carpus.ui.words.session import since_sessions

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


@dataclass(frozen=True, slots=True)
class FingerCell:
    """One figure: the range with its spread, and from where to where. ``joint`` is set where the column's head is not
    its name: a thumb has no middle joint, and none of its angles may be copied as a finger's PIP or DIP."""

    main: str
    small: str = ""
    limited: bool = False
    joint: str = ""

    @property
    def shown(self) -> str:
        """``Lift 18° ± 2°``."""
        return f"{self.joint} {self.main}" if self.joint else self.main


@dataclass(frozen=True, slots=True)
class FingerRow:
    """One finger: a cell per column of :data:`COLUMNS`, last time's figure, and what may be said of the change."""

    finger: int
    name: str
    cells: tuple[FingerCell, ...]
    share: FingerCell
    """Of the TAM of the other hand, or of the usual one, with its grade; empty where there is none."""
    last: str
    change: str
    verdict: str


def finger_rows(
    figures: SessionFigures, previous: SessionFigures | None, other: SessionFigures | None = None
) -> list[FingerRow]:
    """Thumb to little finger; last time and change are those of the total, of spreading or of the middle joint,
    whichever the exercise is about. ``other`` the other hand, of which a total is a share."""
    shares = {share.of: share for share in _shares(figures, other)}
    return [_finger_row(finger, figures, previous, shares.get(f"TAM{finger}")) for finger in FINGERS]


def _shares(figures: SessionFigures, other: SessionFigures | None) -> tuple[Measure, ...]:
    """Of every total, of the other hand's where that is known."""
    return total_shares(figures.joint_ranges, figures.exercise, () if other is None else other.joint_ranges)


def grade_words(grade: Grade | None) -> str:
    """``good``; a total that was not seen whole has no grade."""
    return say(_GRADES[grade])


def _share_cell(share: Measure | None) -> FingerCell:
    if share is None:
        return FingerCell("")
    words = f"{written(100.0 * share.mean)}{numbers.NARROW_GAP}%"
    at_least = f"{AT_LEAST}{numbers.NARROW_GAP}" if share.at_least else ""
    return FingerCell(f"{at_least}{words}", grade_words(grade_share(share)))


def of_other_hand(figures: SessionFigures, other: SessionFigures | None) -> bool:
    """Whether totals are shares of the other hand's, not of the usual ones."""
    shares = _shares(figures, other)
    return bool(shares) and all(share.what == SHARE_OF_OTHER for share in shares)


def column_heads(
    figures: SessionFigures, previous: SessionFigures | None, other: SessionFigures | None = None
) -> list[str]:
    """Heads after the finger's name: the columns, the share of the total, last time, the change."""
    day = numbers.since(previous.when, figures.when) if previous else ""
    compared = tr("lift") if trains_thumb(figures) else say(_COMPARED[compared_row(figures)][0])
    if not trains_joints(figures):
        day = ""
    return [
        tr("Knuckle (MCP)"), tr("Middle (PIP)"), tr("End (DIP)"), tr("Spread"),
        tr("Total (TAM)") if has_totals(figures) else "",
        (tr("Of other hand") if of_other_hand(figures, other) else tr("Of usual")) if has_totals(figures) else "",
        tr("{what}, {day}").format(what=compared, day=day) if day else "",
        tr("Change since {day}").format(day=day) if day else "",
    ]  # fmt: skip


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


def trains_thumb(figures: SessionFigures) -> bool:
    """Whether the exercise is the thumb's alone."""
    return bool(figures.exercise.joint) and figure_of(figures.exercise.joint).finger == 1


def compared_figures(figures: SessionFigures) -> tuple[Figure, ...]:
    """What is compared with last time: of the fingers that the exercise trains, or of the thumb alone."""
    fingers = (1,) if trains_thumb(figures) else figures.exercise.digits or FINGERS
    return tuple(Figure(finger, compared_row(figures)) for finger in fingers)


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


def hand_summary(figures: SessionFigures, previous: SessionFigures | None, first: SessionFigures | None) -> str:
    """Today's figure of every finger, then what may be said of change; of reaches what they were like."""
    main = main_words(figures)
    if main and not trains_joints(figures):
        return f"{main}."
    compared = compared_row(figures)
    what = say(_COMPARED[compared][1])
    shown = compared_figures(figures)
    if trains_thumb(figures):
        what = tr("Thumb")
        shown = tuple(Figure(1, row) for row in ("middle", "spread", "knuckle", "end"))
    today, bounds = [], 0
    for figure in shown:
        row = figures.find(figure.joint, "arc")
        known = row is not None and row.count
        words = range_words(row, spread=False) if row is not None and known else tr("not seen")
        name = figure.row_name if trains_thumb(figures) else finger_name(str(figure.finger))
        today.append(f"{inside(name)} {words}")
        bounds += bool(known and row is not None and row.at_least)
    parts = [f"{main}."] if main else []
    parts.append(tr("{what}: {fingers}.").format(what=what, fingers=", ".join(today)))
    if bounds:
        parts.append(tr("{sign}: the camera did not see the end of that movement.").format(sign=AT_LEAST))
    return " ".join([*parts, *since_sessions(figures, previous, first, hand_since_words)])


def hand_since_words(figures: SessionFigures, before: SessionFigures, when: str) -> str:
    """What may be said of change of the fingers since a day."""
    keys = [figure.joint for figure in compared_figures(figures)]
    rows = [row for row in figures.joint_ranges if row.of in keys and row.what == "arc"]
    changes = compare(before, figures, rows)
    judged = [item for item in changes if item.verdict != "not_judged"]
    beyond = [item for item in judged if item.verdict != "no_change"]
    if not judged:
        why = reason_words([reason for item in changes for reason in item.reasons])
        return tr("Change since {when} is not judged: {why}.").format(when=when, why=why) if changes else ""
    rest = tr("What was hidden in part is not judged.") if len(judged) < len(changes) else ""
    if not beyond:
        return f"{tr('No change proven since {when}.').format(when=when)} {rest}".strip()
    words = []
    for item in beyond:
        size = numbers.degrees(item.shown_difference_deg)
        if item.at_least:
            size = tr("at least {size}").format(size=size)
        pattern = tr("{finger} {size} better") if item.verdict == "improved" else tr("{finger} {size} less")
        words.append(pattern.format(finger=inside(finger_name(item.after.of[3:4])), size=size))
    limit = numbers.degrees(beyond[0].limit_deg)
    said = tr("Since {when}: {changes} (error {limit}).").format(when=when, changes=", ".join(words), limit=limit)
    return f"{said} {rest}".strip()


def cell_of(figures: SessionFigures, figure: Figure) -> FingerCell:
    """The range of one joint or finger in words."""
    row = figures.find(figure.joint, "arc")
    joint = say(_OF_THUMB.get(figure.row, "")) if figure.finger == 1 else ""
    if row is None and figure.row == "tam":
        return FingerCell("")
    if row is None:
        return FingerCell(tr("not measured") if figure.row == "end" else numbers.UNKNOWN, joint=joint)
    if not row.count:
        return FingerCell(tr("not seen"), limited=True, joint=joint)
    return FingerCell(range_words(row), _ends(figures, figure), row.at_least, joint)


def _finger_row(
    finger: int, figures: SessionFigures, previous: SessionFigures | None, share: Measure | None
) -> FingerRow:
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
    return FingerRow(
        finger,
        finger_name(str(finger)),
        tuple(cell_of(figures, Figure(finger, row)) for row in COLUMNS),
        _share_cell(share),
        range_words(before, spread=False) if before is not None and before.count else "",
        change,
        verdict,
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
