"""Letter to the referring doctor, always on one page.

A long letter is printed smaller, down to :data:`MIN_SCALE`. Then are omitted, in this order: the values of the other
hand and of last time, the change since the first session, and the comment, in whose place stands where it is.
"""

from __future__ import annotations

from dataclasses import dataclass
from datetime import date
from typing import ClassVar

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLayout, QVBoxLayout

from carpus.core.model.phrase import Phrase, phrase
from carpus.core.records.values import Patient
from carpus.ui.kit import numbers
from carpus.ui.kit.layouts import STRETCH, Item, Part
from carpus.ui.kit.table import TableColumn, cell_text
from carpus.ui.kit.text import MEDIUM, REGULAR, SEMIBOLD
from carpus.ui.kit.translate import to_mid_sentence, tr
from carpus.ui.report.page import (
    PAPER,
    body_size,
    column,
    fit_parts,
    label,
    legal_line,
    line,
    paragraph,
    rule,
    table,
)
from carpus.ui.report.session_page import DerivedReport, SessionReport, comment_lines, comment_text
from carpus.ui.words import terms
from carpus.ui.words.fingers import is_thumb_exercise, main_angles, range_words
from carpus.ui.words.progress import correction_words
from carpus.ui.words.ranges import LOWER_BOUND, mean_head, range_table
from carpus.ui.words.session import change_sentences, method_words, warning_lines
from carpus.ui.words.terms import finger_name, printed_name

MIN_SCALE = 0.8
MAX_OMISSIONS = 3
MAX_ADDRESS_LINES, MAX_ADDRESS_LENGTH = 6, 80
SIZE_PT = 10.0


@dataclass(frozen=True, slots=True)
class LetterReport(DerivedReport):
    """Letter made of a session report; ``printed_patient`` is the patient whose real name is printed."""

    kind: ClassVar[Phrase] = phrase("letter")
    recipient: str
    day: date
    printed_patient: Patient | None = None
    language: str = ""

    def head(self, number: str) -> None:
        return None

    def pages(self) -> list[QVBoxLayout]:
        """Return the page with as little omitted as it has room for."""
        omitted = 0
        while omitted < MAX_OMISSIONS and fit_parts(_parts(self, omitted), *body_size(self.form))[1] < MIN_SCALE:
            omitted += 1
        return [_parts(self, omitted)]


def _parts(letter: LetterReport, omitted: int) -> QVBoxLayout:
    report, results = letter.report, letter.report.results
    patient = (
        f"{printed_name(letter.printed_patient)} ({letter.pseudonym})"
        if letter.printed_patient is not None
        else letter.pseudonym
    )
    measured = tr("On {day} we measured: {exercise}, {hand}. Repetitions analysed: {count}.").format(
        day=numbers.format_date(results.when),
        exercise=terms.exercise_name(results.exercise.id),
        hand=to_mid_sentence(terms.hand_name(results.side)),
        count=results.repetition_count,
    )
    parts: list[Part | float] = [
        line(column(*(paragraph(one, SIZE_PT) for one in address_lines(letter.recipient)), gap=3.0), STRETCH,
             (label(numbers.format_date(letter.day), SIZE_PT), 0, Qt.AlignmentFlag.AlignTop)),
        14.0,
        paragraph(tr("Movement measured by camera: {who}").format(who=patient), 12.0, SEMIBOLD),
        3.0,
        paragraph(tr("Dear colleague,"), SIZE_PT),
        paragraph(measured, SIZE_PT),
    ]  # fmt: skip
    warned = [*warning_lines(results), *filter(None, [correction_words(results)])]
    parts += [paragraph(words, SIZE_PT, SEMIBOLD, "warn") for words in warned]
    parts.append(_result_table(report, has_comparison=omitted < 1))
    if any(cell.startswith(LOWER_BOUND) for row in letter_rows(report) for cell in row):
        words = tr("{sign}: the end of this movement was occluded.").format(sign=LOWER_BOUND)
        parts.append(paragraph(words, 8.5, REGULAR, "text2"))
    first = report.first if omitted < 2 else None
    parts += [paragraph(words, SIZE_PT) for words in change_sentences(results, report.previous, first)]
    if report.comment.strip():
        has_room = omitted < MAX_OMISSIONS
        said_of_it = tr("The comment is too long for this letter. It is in the report.")
        parts.append(
            comment_text(comment_lines(report.comment)) if has_room else paragraph(said_of_it, SIZE_PT, MEDIUM)
        )
    signature, signed = rule(), ", ".join(filter(None, [report.therapist, letter.form.letterhead.name]))
    signature.setFixedWidth(PAPER.px(200.0))
    parts += [paragraph(tr("Kind regards,"), SIZE_PT), 26.0, signature]
    parts += [paragraph(signed or tr("Signature"), 9.0, REGULAR, "text2"), STRETCH, _foot(report)]
    return column(*parts, gap=6.5)


def _result_table(report: SessionReport, *, has_comparison: bool) -> Item:
    rows = letter_rows(report)
    if not rows:
        return paragraph(tr("No range of motion could be measured."), SIZE_PT)
    heads = ["", mean_head(tr("Today"), report.results.measures_in_group("range")), "", ""]
    if has_comparison and report.other_hand is not None:
        heads[2] = terms.hand_name(report.other_hand.side)
    if has_comparison and report.previous is not None:
        heads[3] = numbers.format_distinct_day(report.previous.when, report.results.when)
    shown = [[cell if column < 2 or heads[column] else "" for column, cell in enumerate(row)] for row in rows]
    return table((TableColumn(), TableColumn(SEMIBOLD), TableColumn(), TableColumn()), heads, shown, size=9.5)


def letter_rows(report: SessionReport) -> list[tuple[str, str, str, str]]:
    """Return name, mean ± SD, the other hand's and last time's value of each main measure."""
    results = report.results
    if report.joints is None:
        shown = range_table(results, report.previous, report.other_hand, on_paper=True)
        lines = [[cell_text(cell) for cell in row] for row in shown.rows]
        return [(name, today, beside, last) for name, today, _, beside, _, last, _ in lines]
    found = []
    for figure in main_angles(results):
        cells = []
        for one in (results, report.other_hand, report.previous):
            row = None if one is None else one.find(figure.joint, "arc")
            cells.append(range_words(row) if row is not None and row.count else tr("not measured"))
        name = (
            figure.kind_name if is_thumb_exercise(results) else f"{finger_name(str(figure.finger))}, {figure.kind_name}"
        )
        found.append((name, cells[0], cells[1], cells[2]))
    return found


def _foot(report: SessionReport) -> QLayout:
    results = report.results
    made_by = f" ({report.revision[:7]})" if report.revision else ""
    origin = f"Carpus {results.software_version}{made_by} · " + tr("Session {id}").format(id=results.session_id[:8])
    how = paragraph(method_words(results, report.markers, compared=True), 7.5, REGULAR, "text2")
    return column(rule(), how, legal_line(), paragraph(origin, 7.5, REGULAR, "text2"), gap=2.0)


def address_lines(recipient: str) -> list[str]:
    """Return the recipient as printed.

    >>> address_lines(" Dr A \\n\\n Vienna")
    ['Dr A', 'Vienna']
    """
    lines = [line.strip()[:MAX_ADDRESS_LENGTH] for line in recipient.splitlines()]
    return [line for line in lines if line][:MAX_ADDRESS_LINES]
