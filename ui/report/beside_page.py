"""Two sessions side by side on one page: the answer, the mean repetitions, the table, what makes the pair fair."""

from __future__ import annotations

from dataclasses import dataclass

from carpus.core.results.figures import SessionFigures
from carpus.core.results.motion_curves import Quantity
from carpus.core.results.report_form import USUAL_FORM, ReportForm
from carpus.ui import numbers, terms
from carpus.ui.fonts import MEDIUM, REGULAR, SEMIBOLD
from carpus.ui.report.beside_shown import Shown
from carpus.ui.report.beside_words import (
    doubts,
    facts_words,
    headline,
    heads,
    other_hand_words,
    quantity_name,
    table_rows,
    unfair_words,
)
from carpus.ui.report.page import A4_PT, MARGIN_PT, Page, PageColumn, paint_to_fit
from carpus.ui.report.progress_page import paint_made_of
from carpus.ui.report.session_page import paint_head
from carpus.ui.translate import tr
from carpus.ui.verdicts import limit_words

TABLE = (
    PageColumn(0.0, MEDIUM, room=0.173), PageColumn(0.185, SEMIBOLD, room=0.138),
    PageColumn(0.335, SEMIBOLD, room=0.13), PageColumn(0.575, ends=True), PageColumn(0.635, ends=True),
    PageColumn(0.66, wraps=True),
)  # fmt: skip
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
        return self.shown.both.first, self.shown.both.second


def paint_beside_page(page: Page, report: BesideReport) -> None:
    """Paint everything from the upper to the lower margin, smaller where the table is long."""
    paint_to_fit(page, A4_PT[1] - MARGIN_PT - 48.0, lambda trial: _paint(trial, report))
    paint_made_of(page, report.made_by, report.sessions)


def _paint(page: Page, report: BesideReport) -> float:
    """All but the foot; returns the lower edge."""
    shown, (first, second) = report.shown, report.sessions
    y = paint_head(page, tr("Side by side"), report.pseudonym, terms.exercise_name(first.exercise.id))
    y = _paint_facts(page, report, y)
    width = page.right - page.left
    answer, basis = headline(shown.both)
    y = page.said(answer, y + 8, 14.0, SEMIBOLD)
    if basis:
        y = page.said(basis, y + 1, 9.5, REGULAR, "text2")
    if words := unfair_words(shown.both):
        y = page.said(words, y + 2, 9.5, SEMIBOLD, "warn")
    for words in doubts(shown.both):
        y = page.said(words, y + 2, 9.0, REGULAR, "warn")
    chosen = _curves(report)
    height = MOST_CURVES_PT if len(chosen) == 1 else LEAST_CURVES_PT
    aside = tr("solid: {first}, band ± sd; dashed: {second}").format(first=shown.names[0], second=shown.names[1])
    for quantity in chosen:
        page.title(tr("Mean repetition: {angle}").format(angle=quantity_name(quantity)), y + 20, aside)
        shown.plot(quantity).paint(page.painter, page.style, page.box(page.left, y + 28, width, height))
        y += 28 + height
    page.title(tr("Differences"), y + 20)
    y = page.said(facts_words(shown.both), y + 24, 8.5, REGULAR, "text2")
    rows = []
    for row in table_rows(shown.both, whole_hand=bool(shown.followed)):
        strong = SEMIBOLD if row.strong else REGULAR
        judged = [(words, strong, "text") for words in (row.difference, row.words)]
        rows.append((row.movement, row.first, row.second, judged[0], row.error, judged[1]))
    y = page.table(TABLE, rows, y + 10, heads=heads(shown.both))
    words = f"{tr('± is the spread between repetitions.')} {limit_words(first.study)}"
    if first.side != second.side:
        words += f" {other_hand_words()}"
    return page.said(words, y + 6, 8.0, REGULAR, "text2")


def _curves(report: BesideReport) -> list[Quantity]:
    """The curve on the screen, and that of the answer where it is another."""
    return list(dict.fromkeys((report.quantity, report.shown.main_quantity)))[:MOST_CURVES]


def _paint_facts(page: Page, report: BesideReport, top: float) -> float:
    made = [figures.when for figures in report.sessions]
    pairs = [
        (
            name,
            tr("{hand}, {date}").format(
                hand=terms.hand_name(figures.side), date=numbers.report_date(figures.when, *made)
            ),
        )
        for name, figures in zip((tr("First, solid"), tr("Second, dashed")), report.sessions, strict=True)
    ]
    pairs.append((tr("Therapist"), report.therapist or numbers.UNKNOWN))
    page.facts(pairs, top + 5, (0.0, 0.4, 0.8))
    page.rule(top + 36)
    return top + 36
