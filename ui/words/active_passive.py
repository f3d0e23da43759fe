"""Table of active and passive range with the manual values of the same measures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import compress

from carpus.core.measures.manual_measurements import MEASURES, ManualValue
from carpus.core.results.measure import Measure, MeasureKey, is_total_active_motion, negate_measure, wrist_angle_index
from carpus.core.results.progress import Comparison, compare_ranges
from carpus.core.results.session_results import SessionResults
from carpus.ui.kit import numbers
from carpus.ui.kit.table import TableColumn, TableContent
from carpus.ui.kit.translate import to_mid_sentence, tr
from carpus.ui.words import terms
from carpus.ui.words.finger_angles import FINGERS, AngleKind, FingerAngle
from carpus.ui.words.fingers import has_totals, range_words
from carpus.ui.words.manual_values import value_words
from carpus.ui.words.progress import range_name, reason_words
from carpus.ui.words.ranges import LOWER_BOUND, is_deficit, mean_words
from carpus.ui.words.terms import finger_name

# Before a manual value, here as in every chart.
MANUAL_SIGN = "\N{WHITE SQUARE}"
_JOINTS: tuple[AngleKind, ...] = ("knuckle", "middle", "end")


@dataclass(frozen=True, slots=True)
class ActivePassiveTable:
    """A sentence, the table, and a note that explains it."""

    sentence: str
    table: TableContent
    note: str


def build_active_passive(results: SessionResults, manual_values: Sequence[ManualValue]) -> ActivePassiveTable | None:
    """Return the table of a session, None without passive repetitions and manual values of that day."""
    passive = results.passive_results()
    if passive is None and not _has_manual_values(results, manual_values):
        return None
    of_fingers = results.joint_ranges or (passive is not None and passive.joint_ranges)
    heads, rows = (_finger_rows if of_fingers else _wrist_rows)(results, passive, manual_values)
    known = [column == 0 or any(row[column] for row in rows) for column in range(len(heads))]
    note = []
    if results.joint_ranges:
        note.append(tr("Largest flexion of each joint; ± is the SD between repetitions."))
    if any(LOWER_BOUND in cell for row in rows for cell in row):
        note.append(tr("{sign} = minimum: the end of this movement was occluded.").format(sign=LOWER_BOUND))
    if _has_manual_values(results, manual_values):
        text = tr("{sign}: manual measurement of that day, active / passive. It is not combined with the other values.")
        note.append(text.format(sign=MANUAL_SIGN))
    shown = tuple(tuple(compress(row, known)) for row in rows if any(row[1:]))
    table = TableContent((TableColumn(),) * sum(known), tuple(compress(heads, known)), shown)
    return ActivePassiveTable("" if passive is None else _sentence(results, passive), table, " ".join(note))


def _has_manual_values(results: SessionResults, manual_values: Sequence[ManualValue]) -> bool:
    return any(_manual_cell(row.key, manual_values) for row in results.measures_in_group("range"))


def _manual_cell(key: MeasureKey, manual_values: Sequence[ManualValue]) -> str:
    """Return ``□ 70° / 90°``: the active and the passive manual value of a measure."""
    measure = next((one for one in MEASURES if one.session_measure == key), None)
    if measure is None:
        return ""
    found = {value.mode: value_words(measure, value.value) for value in manual_values if value.measure == measure.id}
    both = " / ".join(found.get(way, numbers.UNKNOWN) for way in measure.modes)
    return f"{MANUAL_SIGN} {both}" if found else ""


def _wrist_rows(
    results: SessionResults, passive: SessionResults | None, manual_values: Sequence[ManualValue]
) -> tuple[list[str], list[list[str]]]:
    heads = [tr("Movement"), tr("Active"), tr("Passive"), tr("Passive minus active"), tr("Manual")]
    gaps = (
        {} if passive is None else {item.key: item for item in compare_ranges(results, passive, passive.wrist_ranges)}
    )
    keys = dict.fromkeys(row.key for row in (*results.wrist_ranges, *(() if passive is None else passive.wrist_ranges)))
    rows = []
    for key in keys:
        several = key[1] == "arc" and results.exercise.angle is None
        name = terms.arc_name(wrist_angle_index(key[0])) if several else terms.movement_name(key[1])
        cells = [_range_cell(one.find(*key)) if one is not None else "" for one in (results, passive)]
        rows.append([name, *cells, _gap_cell(gaps.get(key)), _manual_cell(key, manual_values)])
    return heads, rows


def _finger_rows(
    results: SessionResults, passive: SessionResults | None, manual_values: Sequence[ManualValue]
) -> tuple[list[str], list[list[str]]]:
    heads = [tr("Finger")]
    for name in (tr("MCP"), tr("PIP"), tr("DIP (thumb: IP)")):
        heads += [f"{name}\n{words}" for words in (tr("active"), tr("passive"), MANUAL_SIGN)]
    if has_totals(results):
        heads += [f"TAM\n{tr('active')}", f"TPM\n{tr('passive')}", f"TAM\n{MANUAL_SIGN}"]
    rows = []
    for finger in FINGERS:
        cells = [finger_name(str(finger))]
        for joint in _JOINTS:
            subject = "" if finger == 1 and joint == "middle" else FingerAngle(finger, joint).joint  # a thumb has none
            key: MeasureKey = (subject, "flexion")
            cells += [_joint_cell(one, key) if subject else "" for one in (results, passive)]
            cells.append(_manual_cell(key, manual_values) if subject else "")
        if has_totals(results):
            total: MeasureKey = (f"TAM{finger}", "arc")
            cells += [*(_joint_cell(one, total) for one in (results, passive)), _manual_cell(total, manual_values)]
        rows.append(cells)
    return heads, rows


def _joint_cell(results: SessionResults | None, key: MeasureKey) -> str:
    row = None if results is None else results.find(*key)
    return range_words(row, has_sd=not is_total_active_motion(key[0])) if row is not None and row.count else ""


def _range_cell(row: Measure | None) -> str:
    if row is None:
        return ""
    words = mean_words(row)
    if is_deficit(row):
        words = f"\N{MINUS SIGN}{mean_words(negate_measure(row))}"
    return f"{LOWER_BOUND}{numbers.NARROW_GAP}{words}" if row.is_lower_bound else words


def _gap_cell(item: Comparison | None) -> str:
    """Return ``21° (MDC 10°)``, negative where passive is less; a gap within the error is not given."""
    if item is None:
        return ""
    if item.verdict == "not_judged":
        return tr("not assessed: {why}").format(why=reason_words(item.reasons))
    if item.verdict == "no_change":
        return tr("within MDC")
    limit = numbers.format_degrees(item.limit_deg)
    return tr("{gap} (MDC {limit})").format(gap=numbers.format_signed_degrees(item.display_difference_deg), limit=limit)


def _sentence(results: SessionResults, passive: SessionResults) -> str:
    """Return a sentence on the largest gap beyond the measurement error."""
    bent = [row for row in passive.joint_ranges if row.quantity == "flexion" and row.subject.endswith("_flexion")]
    rows = bent if passive.joint_ranges else passive.wrist_ranges
    gaps = compare_ranges(results, passive, rows)
    beyond = [item for item in gaps if item.verdict == "improved"]
    if beyond:
        maximum = max(beyond, key=lambda item: item.difference_deg)
        name = range_name(maximum.after, names_arc=False)
        words = tr(
            "{name}: active {active}, passive {passive}. The difference of {gap} is beyond the measurement error."
        )
        return words.format(
            name=name,
            active=numbers.format_signed_degrees(maximum.before.mean),
            passive=numbers.format_signed_degrees(maximum.after.mean),
            gap=numbers.format_degrees(maximum.display_difference_deg),
        )
    if any(item.verdict != "not_judged" for item in gaps):
        return tr("Passive range does not exceed active range by more than the measurement error.")
    why = reason_words([reason for item in gaps for reason in item.reasons])
    return (
        tr("Active and passive range are shown without an assessment: {why}.").format(why=to_mid_sentence(why))
        if why
        else ""
    )
