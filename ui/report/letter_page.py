"""The letter to the referring doctor: one page, whatever stands in it.

Where it does not fit it is painted smaller, down to :data:`SMALLEST`. Then these go, in this order: the figures of the
other hand and of last time, the change since the first session, the comment, in whose place stands where it is.
"""

from __future__ import annotations

from dataclasses import dataclass
from datetime import date
from functools import partial

from carpus.ui import numbers, terms
from carpus.ui.fonts import MEDIUM, REGULAR, SEMIBOLD
from carpus.ui.marker_words import finger_name
from carpus.ui.report.framed import BODY_FOOT_PT
from carpus.ui.report.page import MARGIN_PT, Page, PageColumn, paint_to_fit, painted_on_nothing
from carpus.ui.report.session_page import OfSession, SessionReport, comment_lines
from carpus.ui.translate import inside, tr
from carpus.ui.words.fingers import AT_LEAST, compared_figures, hand_since_words, range_words, trains_thumb
from carpus.ui.words.progress import corrected_words
from carpus.ui.words.ranges import table_rows
from carpus.ui.words.session import method, since_compared, since_sessions, warnings

SMALLEST = 0.82
OMISSIONS = 3
MOST_ADDRESS_LINES, MOST_ADDRESS = 6, 80
SIZE_PT, LEADING_PT = 10.0, 14.5
FOOT_PT = 84.0
TABLE = (
    PageColumn(0.0, size_pt=9.5), PageColumn(0.30, SEMIBOLD, size_pt=9.5), PageColumn(0.62, size_pt=9.5),
    PageColumn(0.84, size_pt=9.5),
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class LetterReport(OfSession):
    """All that is on the page: what the report has, to whom it goes and when. ``real_name`` is printed where it is not
    empty, beside the made-up one."""

    recipient: str
    day: date
    real_name: str = ""
    language: str = ""


def paint_letter_page(page: Page, letter: LetterReport) -> None:
    """Paint everything on one page."""
    room, omitted = BODY_FOOT_PT - FOOT_PT, 0
    while omitted < OMISSIONS and room < SMALLEST * painted_on_nothing(page, partial(_paint, letter, omitted)):
        omitted += 1
    paint_to_fit(page, room, partial(_paint, letter, omitted))
    _paint_foot(page, letter)


def _paint(letter: LetterReport, omitted: int, page: Page) -> float:
    """All but the foot, without what is omitted; returns the lower edge."""
    report, figures = letter.report, letter.report.figures
    y = MARGIN_PT
    page.text_right(numbers.day_of_year(letter.day), page.right, y + SIZE_PT, SIZE_PT)
    for line in address_lines(letter.recipient):
        page.text(line, page.left, y + SIZE_PT, SIZE_PT)
        y += LEADING_PT
    y += 24
    who = f"{letter.real_name} ({letter.pseudonym})" if letter.real_name else letter.pseudonym
    subject = tr("Movement measured by camera: {who}").format(who=who)
    y = page.said(subject, y, 12.0, SEMIBOLD) + 10
    y = page.said(tr("Dear colleague,"), y, SIZE_PT) + 6
    said = tr("On {day} we measured: {exercise}, {hand}. Repetitions that count: {count}.").format(
        day=numbers.day_of_year(figures.when),
        exercise=terms.exercise_name(figures.exercise.id),
        hand=inside(terms.hand_name(figures.side)),
        count=figures.counted,
    )
    y = page.said(said, y, SIZE_PT)
    for words in [*warnings(figures), *filter(None, [corrected_words(figures)])]:
        y = page.said(words, y + 3, SIZE_PT, SEMIBOLD, "warn")
    y = _paint_figures(page, report, y + 8, beside=omitted < 1)
    if any(cell.startswith(AT_LEAST) for row in figure_rows(report) for cell in row):
        said = tr("{sign}: the camera did not see the end of that movement.").format(sign=AT_LEAST)
        y = page.said(said, y + 3, 8.5, REGULAR, "text2")
    since = since_compared if report.joints is None else hand_since_words
    for words in since_sessions(figures, report.previous, report.first if omitted < 2 else None, since):
        y = page.said(words, y + 4, SIZE_PT)
    if report.comment.strip():
        y += 6
        if omitted < 3:
            for line in comment_lines(page, report.comment):
                page.text(line, page.left, y + SIZE_PT, 9.0)
                y += 12.5
        else:
            y = page.said(tr("The comment is too long for this letter; it is in the report."), y, SIZE_PT, MEDIUM)
    y = page.said(tr("Kind regards,"), y + 10, SIZE_PT) + 34
    page.rule(y, page.left, page.left + 200)
    signed = ", ".join(filter(None, [report.therapist, letter.form.letterhead.name]))
    page.text(signed or tr("Signature"), page.left, y + 12, 9.0, REGULAR, "text2")
    return y + 18


def _paint_figures(page: Page, report: SessionReport, top: float, *, beside: bool) -> float:
    """The main figures, with those of the other hand and of last time beside them."""
    rows = figure_rows(report)
    if not rows:
        return page.said(tr("No range could be measured."), top, SIZE_PT)
    heads = ["", tr("Mean ± sd"), "", ""]
    if beside and report.other_hand is not None:
        heads[2] = terms.hand_name(report.other_hand.side)
    if beside and report.previous is not None:
        heads[3] = numbers.day_beside(report.previous.when, report.figures.when)
    shown = [[cell if column < 2 or heads[column] else "" for column, cell in enumerate(row)] for row in rows]
    return page.table(TABLE, shown, top + 2, heads=heads, head_pt=9.5, pitch_pt=16.0) + 3.5


def figure_rows(report: SessionReport) -> list[tuple[str, str, str, str]]:
    """Name, mean with its spread, the other hand's and last time's; a figure that is not known is said to be so."""
    figures = report.figures
    if report.joints is None:
        rows = [row for row in table_rows(figures, report.previous, report.other_hand) if row.best]
        return [(row.movement, row.today, row.other_hand, row.last) for row in rows]
    found = []
    for figure in compared_figures(figures):
        cells = []
        for shown in (figures, report.other_hand, report.previous):
            row = None if shown is None else shown.find(figure.joint, "arc")
            cells.append(range_words(row) if row is not None and row.count else tr("not measured"))
        name = figure.row_name if trains_thumb(figures) else f"{finger_name(str(figure.finger))}, {figure.row_name}"
        found.append((name, cells[0], cells[1], cells[2]))
    return found


def _paint_foot(page: Page, letter: LetterReport) -> None:
    """How it was measured, in what it can be wrong, and by which program: never left out."""
    report, figures = letter.report, letter.report.figures
    width = page.right - page.left
    made_by = f" ({report.revision[:7]})" if report.revision else ""
    origin = f"Carpus {figures.software_version}{made_by} · " + tr("Session {id}").format(id=figures.session_id[:8])
    parts = [(method(figures, report.markers, compared=True), REGULAR), (terms.LEGAL_SENTENCE, SEMIBOLD)]
    parts.append((origin, REGULAR))
    lines: list[tuple[str, int]] = []
    size = 7.5
    for words, weight in parts:
        lines += [(line, weight) for line in page.lines(words, width, size, weight)]
    leading = min(10.4, (FOOT_PT - 4.0) / len(lines))
    size = min(size, leading / 1.15)
    top = BODY_FOOT_PT - FOOT_PT + 4.0
    page.rule(top - 3.0)
    for line, weight in lines:
        top += leading
        page.text(line, page.left, top - 0.2 * leading, size, weight, "text2" if weight == REGULAR else "text")


def address_lines(recipient: str) -> list[str]:
    """The recipient as it is printed.

    >>> address_lines(" Dr A \\n\\n Vienna")
    ['Dr A', 'Vienna']
    """
    lines = [line.strip()[:MOST_ADDRESS] for line in recipient.splitlines()]
    return [line for line in lines if line][:MOST_ADDRESS_LINES]
