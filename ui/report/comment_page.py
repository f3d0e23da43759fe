"""Pages of a comment that is too long for the first: all of it, never cut."""

from __future__ import annotations

from PySide6.QtGui import QPainter, QPicture

from carpus.ui.fonts import SEMIBOLD
from carpus.ui.report.page import Page
from carpus.ui.report.session_page import (
    COMMENT_LEADING_PT,
    LOWEST_PT,
    SessionReport,
    comment_lines,
    is_short,
    paint_comment_lines,
    paint_head,
    what_words,
)
from carpus.ui.terms import LEGAL_SENTENCE
from carpus.ui.translate import tr

FIRST_PT, LEGAL_PT = 118.0, 40.0
LINES_ON_A_PAGE = int((LOWEST_PT - LEGAL_PT - FIRST_PT) / COMMENT_LEADING_PT)


def comment_pages(report: SessionReport) -> list[list[str]]:
    """The lines of each page; none where the comment has room on the first page of the report."""
    if not report.comment.strip():
        return []
    nowhere = QPicture()
    painter = QPainter(nowhere)
    try:
        page = Page(painter, 1.0)
        lines = [] if is_short(page, report.comment) else comment_lines(page, report.comment)
    finally:
        painter.end()
    return [lines[start : start + LINES_ON_A_PAGE] for start in range(0, len(lines), LINES_ON_A_PAGE)]


def paint_comment_page(page: Page, report: SessionReport, lines: list[str]) -> None:
    """One page of the comment."""
    y = paint_head(page, tr("Session report"), report.pseudonym, what_words(report))
    page.title(tr("Comment of the therapist"), y + 18)
    paint_comment_lines(page, lines, FIRST_PT)
    page.said(LEGAL_SENTENCE, LOWEST_PT - 30, 8.0, SEMIBOLD)
