"""A report page by page, the same on the screen and on paper."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from carpus.ui.fonts import SEMIBOLD
from carpus.ui.language import speaking
from carpus.ui.report.framed import paint_framed
from carpus.ui.report.home_page import HomeReport, paint_home_page
from carpus.ui.report.letter_page import LetterReport, paint_letter_page
from carpus.ui.report.motion_page import paint_motion_page
from carpus.ui.report.page import Page, on_nothing
from carpus.ui.report.progress_page import ProgressReport, paint_progress_page
from carpus.ui.report.session_page import (
    COMMENT_LEADING_PT,
    LOWEST_PT,
    SessionReport,
    comment_lines,
    is_short,
    paint_comment_lines,
    paint_head,
    paint_session_page,
    paint_watermark,
    what_words,
)
from carpus.ui.terms import LEGAL_SENTENCE
from carpus.ui.translate import tr

Report = SessionReport | ProgressReport | LetterReport | HomeReport


def pages_of(report: Report) -> list[Callable[[Page], None]]:
    """What paints each page, on the paper and in the language of the report; the painter is as it was when a page is
    done."""
    paints: list[Callable[[Page], None]] = []
    if isinstance(report, ProgressReport):
        paints = [lambda page: paint_progress_page(page, report)]
    elif isinstance(report, LetterReport):
        paints = [lambda page: paint_letter_page(page, report)]
    elif isinstance(report, HomeReport):
        paints = [lambda page: paint_home_page(page, report)]
    else:
        paints = [lambda page: paint_session_page(page, report)]
        if report.motion is not None and report.form.has("motion"):
            paints.append(lambda page: paint_motion_page(page, report))
        paints += [
            lambda page, lines=lines: paint_comment_page(page, report, lines)  # type: ignore[misc]
            for lines in comment_pages(report)
        ]
    return [partial(_painted, report, number, len(paints), paint) for number, paint in enumerate(paints, start=1)]


def _painted(report: Report, number: int, count: int, paint: Callable[[Page], None], page: Page) -> None:
    def body(framed: Page) -> None:
        if any(figures.simulated for figures in report.sessions):
            paint_watermark(framed)
        paint(framed)

    page.painter.save()
    with speaking(report.language):
        paint_framed(page, report.form, number, count, body)
    page.painter.restore()


FIRST_PT, LEGAL_PT = 118.0, 40.0
LINES_ON_A_PAGE = int((LOWEST_PT - LEGAL_PT - FIRST_PT) / COMMENT_LEADING_PT)


def comment_pages(report: SessionReport) -> list[list[str]]:
    """The lines of each page; none where the comment has room on the first page of the report."""
    if not report.comment.strip():
        return []
    lines = on_nothing(1.0, lambda page: [] if is_short(page, report.comment) else comment_lines(page, report.comment))
    return [lines[start : start + LINES_ON_A_PAGE] for start in range(0, len(lines), LINES_ON_A_PAGE)]


def paint_comment_page(page: Page, report: SessionReport, lines: list[str]) -> None:
    """One page of the comment."""
    y = paint_head(page, tr("Session report"), report.pseudonym, what_words(report))
    page.title(tr("Comment of the therapist"), y + 18)
    paint_comment_lines(page, lines, FIRST_PT)
    page.said(LEGAL_SENTENCE, LOWEST_PT - 30, 8.0, SEMIBOLD)
