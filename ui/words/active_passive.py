"""Active and passive range beside each other, with what a person measured of the same; for the screen and the page."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import compress

from carpus.core.measures.by_hand import MEASURES, HandValue
from carpus.core.results.figures import SessionFigures
from carpus.core.results.measure import Measure, MeasureKey, is_total, turn_round, wrist_column
from carpus.core.results.progress import Comparison, compare
from carpus.ui import numbers, terms
from carpus.ui.figures import FINGERS, Figure, Row
from carpus.ui.marker_words import finger_name
from carpus.ui.translate import inside, tr
from carpus.ui.verdicts import reason_words
from carpus.ui.words.by_hand import value_words
from carpus.ui.words.fingers import AT_LEAST, has_totals, range_words
from carpus.ui.words.progress import range_name
from carpus.ui.words.ranges import is_deficit, mean_words
from carpus.ui.words.table import TableColumn, TableWords

BY_HAND = "\N{WHITE SQUARE}"
"""Before what a person measured, here as in every chart."""
_JOINTS: tuple[Row, ...] = ("knuckle", "middle", "end")


@dataclass(frozen=True, slots=True)
class ActivePassive:
    """A sentence, the table, whose heads may have two lines, and what explains it."""

    said: str
    table: TableWords
    note: str


def active_passive(figures: SessionFigures, by_hand: Sequence[HandValue]) -> ActivePassive | None:
    """The table of a session; None where nothing was passive and nothing of it was measured by hand that day."""
    helped = figures.as_passive()
    if helped is None and not _is_beside(figures, by_hand):
        return None
    of_fingers = figures.joint_ranges or (helped is not None and helped.joint_ranges)
    heads, rows = (_of_fingers if of_fingers else _of_wrist)(figures, helped, by_hand)
    known = [column == 0 or any(row[column] for row in rows) for column in range(len(heads))]
    note = []
    if figures.joint_ranges:
        note.append(tr("Each joint where it was bent most; ± is the spread between repetitions."))
    if any(AT_LEAST in cell for row in rows for cell in row):
        note.append(tr("{sign}: at least, the camera did not see the end of that movement.").format(sign=AT_LEAST))
    if _is_beside(figures, by_hand):
        said = tr("{sign}: measured by hand that day, active / passive; never averaged with the rest.")
        note.append(said.format(sign=BY_HAND))
    shown = tuple(tuple(compress(row, known)) for row in rows if any(row[1:]))
    table = TableWords((TableColumn(),) * sum(known), tuple(compress(heads, known)), shown)
    return ActivePassive("" if helped is None else _sentence(figures, helped), table, " ".join(note))


def _is_beside(figures: SessionFigures, by_hand: Sequence[HandValue]) -> bool:
    """Whether a person measured any of what the table shows."""
    return any(_by_hand(row.key, by_hand) for row in figures.group("range"))


def _by_hand(key: MeasureKey, by_hand: Sequence[HandValue]) -> str:
    """``□ 70° / 90°``: active and passive, of the same figure."""
    measure = next((one for one in MEASURES if one.figure == key), None)
    if measure is None:
        return ""
    found = {value.way: value_words(measure, value.value) for value in by_hand if value.measure == measure.id}
    both = " / ".join(found.get(way, numbers.UNKNOWN) for way in measure.ways)
    return f"{BY_HAND} {both}" if found else ""


def _of_wrist(
    figures: SessionFigures, helped: SessionFigures | None, by_hand: Sequence[HandValue]
) -> tuple[list[str], list[list[str]]]:
    heads = [tr("Movement"), tr("Active"), tr("Passive"), tr("Passive goes further"), tr("By hand")]
    gaps = {} if helped is None else {item.key: item for item in compare(figures, helped, helped.wrist_ranges)}
    keys = dict.fromkeys(row.key for row in (*figures.wrist_ranges, *(() if helped is None else helped.wrist_ranges)))
    rows = []
    for key in keys:
        several = key[1] == "arc" and figures.exercise.angle is None
        name = terms.arc_name(wrist_column(key[0])) if several else terms.movement_name(key[1])
        cells = [_words(one.find(*key)) if one is not None else "" for one in (figures, helped)]
        rows.append([name, *cells, _gap(gaps.get(key)), _by_hand(key, by_hand)])
    return heads, rows


def _of_fingers(
    figures: SessionFigures, helped: SessionFigures | None, by_hand: Sequence[HandValue]
) -> tuple[list[str], list[list[str]]]:
    heads = [tr("Finger")]
    for name in (tr("Knuckle"), tr("Middle joint"), tr("End joint")):
        heads += [f"{name}\n{words}" for words in (tr("active"), tr("passive"), BY_HAND)]
    heads += [f"TAM\n{tr('active')}", f"TPM\n{tr('passive')}"] if has_totals(figures) else []
    rows = []
    for finger in FINGERS:
        cells = [finger_name(str(finger))]
        for joint in _JOINTS:
            of = "" if finger == 1 and joint == "middle" else Figure(finger, joint).joint  # a thumb has none
            key: MeasureKey = (of, "flexion")
            cells += [_of_joint(one, key) if of else "" for one in (figures, helped)]
            cells.append(_by_hand(key, by_hand) if of else "")
        if has_totals(figures):
            cells += [_of_joint(one, (f"TAM{finger}", "arc")) for one in (figures, helped)]
        rows.append(cells)
    return heads, rows


def _of_joint(figures: SessionFigures | None, key: MeasureKey) -> str:
    row = None if figures is None else figures.find(*key)
    return range_words(row, spread=not is_total(key[0])) if row is not None and row.count else ""


def _words(row: Measure | None) -> str:
    if row is None:
        return ""
    words = mean_words(row)
    if is_deficit(row):
        words = f"\N{MINUS SIGN}{mean_words(turn_round(row))}"
    return f"{AT_LEAST}{numbers.NARROW_GAP}{words}" if row.at_least else words


def _gap(item: Comparison | None) -> str:
    """``21° (error 10°)``, below zero where less was reached; a gap within the error is none."""
    if item is None:
        return ""
    if item.verdict == "not_judged":
        return tr("not judged: {why}").format(why=reason_words(item.reasons))
    if item.verdict == "no_change":
        return tr("within the error")
    limit = numbers.degrees(item.limit_deg)
    return tr("{gap} (error {limit})").format(gap=numbers.signed_degrees(item.shown_difference_deg), limit=limit)


def _sentence(figures: SessionFigures, helped: SessionFigures) -> str:
    """The largest gap beyond error, in a sentence."""
    bent = [row for row in helped.joint_ranges if row.what == "flexion" and row.of.endswith("_flexion")]
    rows = bent if helped.joint_ranges else helped.wrist_ranges
    gaps = compare(figures, helped, rows)
    beyond = [item for item in gaps if item.verdict == "improved"]
    if beyond:
        most = max(beyond, key=lambda item: item.difference_deg)
        name = range_name(most.after, several=False)
        words = tr("{name}: {active} by itself, {passive} when helped. The {gap} between them are more than the error.")
        return words.format(
            name=name, active=numbers.signed_degrees(most.before.mean), passive=numbers.signed_degrees(most.after.mean),
            gap=numbers.degrees(most.shown_difference_deg),
        )  # fmt: skip
    if any(item.verdict != "not_judged" for item in gaps):
        return tr("Passive range does not exceed active range by more than the measurement error.")
    why = reason_words([reason for item in gaps for reason in item.reasons])
    return tr("Active and passive are shown, not judged: {why}.").format(why=inside(why)) if why else ""
