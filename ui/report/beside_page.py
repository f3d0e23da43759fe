"""Two sessions side by side on one page: the answer, the mean repetitions, the table, what makes the pair fair."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from carpus.core.results.figures import SessionFigures
from carpus.core.results.mean_repetition import Quantity
from carpus.core.results.report_form import USUAL_FORM, ReportForm
from carpus.ui import numbers, terms
from carpus.ui.beside.rows import BesideRow
from carpus.ui.beside.shown import Shown
from carpus.ui.beside.words import doubts, other_hand_words, quantity_name, unfair_words
from carpus.ui.fonts import MEDIUM, REGULAR, SEMIBOLD
from carpus.ui.report.page import A4_PT, MARGIN_PT, Page
from carpus.ui.report.session_page import paint_head, paint_watermark, painted_on_nothing
from carpus.ui.translate import tr
from carpus.ui.verdicts import limit_words

EDGES = (0.0, 0.185, 0.335, 0.575, 0.635, 0.66)
"""Movement and both figures at their left, difference and error at their right, words at their left."""
LEAST_CURVES_PT, MOST_CURVES_PT = 110.0, 210.0
MOST_CURVES = 2


@dataclass(frozen=True, slots=True)
class BesideReport:
    """All that is on the page; ``quantity`` the curves that were on the screen."""

    shown: Shown
    quantity: Quantity
    pseudonym: str
    therapist: str = ""
    made_by: str = ""
    """Version and revision of the program that makes the report."""
    form: ReportForm = USUAL_FORM
    language: str = ""
    """The language it is painted in, by two letters; empty for the window's."""

    @property
    def sessions(self) -> tuple[SessionFigures, SessionFigures]:
        """Both sessions."""
        return self.shown.both.first, self.shown.both.second


def paint_beside_page(page: Page, report: BesideReport) -> None:
    """Paint everything from the upper to the lower margin, smaller where the table is long."""
    if any(figures.simulated for figures in report.sessions):
        paint_watermark(page)
    share = min(1.0, (A4_PT[1] - MARGIN_PT - 48.0) / painted_on_nothing(page, lambda trial: _paint(trial, report)))
    page.painter.save()
    page.painter.translate(0.5 * (1.0 - share) * A4_PT[0] * page.point, 0.0)
    page.painter.scale(share, share)
    _paint(page, report)
    page.painter.restore()
    width, foot = page.right - page.left, A4_PT[1] - MARGIN_PT
    page.paragraph(terms.LEGAL_SENTENCE, page.left, foot - 34, width, 8.0, SEMIBOLD)
    words = _made_of(report)
    page.text(words, page.left, foot + 8, min(8.0, 7.9 * width / page.width_of(words, 8.0)), REGULAR, "text2")


def _paint(page: Page, report: BesideReport) -> float:
    """All but the foot; returns the lower edge."""
    shown, (first, second) = report.shown, report.sessions
    y = paint_head(page, tr("Side by side"), report.pseudonym, terms.exercise_name(first.exercise.id))
    y = _paint_facts(page, report, y)
    width = page.right - page.left
    answer, basis = shown.head
    y = page.paragraph(answer, page.left, y + 8, width, 14.0, SEMIBOLD)
    if basis:
        y = page.paragraph(basis, page.left, y + 1, width, 9.5, REGULAR, "text2")
    if words := unfair_words(shown.both):
        y = page.paragraph(words, page.left, y + 2, width, 9.5, SEMIBOLD, "warn")
    for words in doubts(shown.both):
        y = page.paragraph(words, page.left, y + 2, width, 9.0, REGULAR, "warn")
    chosen = _curves(report)
    height = MOST_CURVES_PT if len(chosen) == 1 else LEAST_CURVES_PT
    aside = tr("solid: {first}, band ± sd; dashed: {second}").format(first=shown.names[0], second=shown.names[1])
    for quantity in chosen:
        page.title(tr("Mean repetition: {angle}").format(angle=quantity_name(quantity)), y + 20, aside)
        shown.plot(quantity).paint(page.painter, page.style, page.box(page.left, y + 28, width, height))
        y += 28 + height
    page.title(tr("Differences"), y + 20)
    y = page.paragraph(shown.facts, page.left, y + 24, width, 8.5, REGULAR, "text2")
    y = _paint_table(page, shown.heads, shown.rows, y + 10)
    words = f"{tr('± is the spread between repetitions.')} {limit_words(first.study)}"
    if first.side != second.side:
        words += f" {other_hand_words()}"
    return page.paragraph(words, page.left, y + 6, width, 8.0, REGULAR, "text2")


def _curves(report: BesideReport) -> list[Quantity]:
    """The curve on the screen, and that of the answer where it is another."""
    return list(dict.fromkeys((report.quantity, report.shown.main_quantity)))[:MOST_CURVES]


def _paint_facts(page: Page, report: BesideReport, top: float) -> float:
    pairs = [
        (
            name,
            tr("{hand}, {date}").format(hand=terms.hand_name(figures.side), date=numbers.report_date(figures.when)),
        )
        for name, figures in zip((tr("First, solid"), tr("Second, dashed")), report.sessions, strict=True)
    ]
    pairs.append((tr("Therapist"), report.therapist or numbers.UNKNOWN))
    page.facts(pairs, top + 5, (0.0, 0.4, 0.8))
    page.rule(top + 36)
    return top + 36


def _paint_table(page: Page, heads: Sequence[str], rows: Sequence[BesideRow], top: float) -> float:
    _paint_row(page, tuple(heads), top + 8, 8.5, [MEDIUM] * 6, "text2")
    y = top + 12
    for row in rows:
        page.rule(y)
        strong = SEMIBOLD if row.strong else REGULAR
        cells = (row.movement, row.first, row.second, row.difference, row.error, row.words)
        y = _paint_row(page, cells, y + 11, 9.0, [MEDIUM, SEMIBOLD, SEMIBOLD, strong, REGULAR, strong], "text") + 4.5
    page.rule(y)
    return y


def _paint_row(
    page: Page, cells: Sequence[str], baseline: float, size: float, weights: Sequence[int], token: str
) -> float:
    """One row; long words at the end take a second line. Returns the last baseline."""
    width = page.right - page.left
    last = baseline
    for column, text in enumerate(cells):
        edge = page.left + EDGES[column] * width
        if column in (3, 4):
            page.text_right(text, edge, baseline, size, weights[column], token)
        elif column == 5:
            low = page.paragraph(text, edge, baseline - size, page.right - edge, size, weights[column], token)
            last = max(last, low - 0.45 * size)
        else:
            room = (EDGES[column + 1] - EDGES[column]) * width - 6
            fitting = size
            while fitting > 6.0 and page.width_of(text, fitting, weights[column]) > room:
                fitting -= 0.25
            page.text(text, edge, baseline, fitting, weights[column], token)
    return last


def _made_of(report: BesideReport) -> str:
    """``Made by Carpus 0.1.0 (1a2b3c4) of 2 sessions: 0b1c2d3e, …``."""
    first, second = report.sessions
    return " · ".join(
        (
            tr("Made by Carpus {version}").format(version=report.made_by),
            tr("{count} sessions: {ids}").format(count=2, ids=f"{first.session_id[:8]}, {second.session_id[:8]}"),
            tr("measured by Carpus {versions}").format(
                versions=", ".join(sorted({first.software_version, second.software_version}))
            ),
        )
    )
