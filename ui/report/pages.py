"""A report page by page, the same on the screen and on paper."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from carpus.ui.language import speaking
from carpus.ui.report.beside_page import BesideReport, paint_beside_page
from carpus.ui.report.comment_page import comment_pages, paint_comment_page
from carpus.ui.report.framed import paint_framed
from carpus.ui.report.home_page import HomeReport, paint_home_page
from carpus.ui.report.letter_page import LetterReport, paint_letter_page
from carpus.ui.report.motion_page import paint_motion_page
from carpus.ui.report.page import Page
from carpus.ui.report.progress_page import ProgressReport, paint_progress_page
from carpus.ui.report.session_page import SessionReport, paint_session_page, paint_watermark

Report = SessionReport | ProgressReport | BesideReport | LetterReport | HomeReport


def pages_of(report: Report) -> list[Callable[[Page], None]]:
    """What paints each page, on the paper and in the language of the report; the painter is as it was when a page is
    done."""
    paints: list[Callable[[Page], None]] = []
    if isinstance(report, ProgressReport):
        paints = [lambda page: paint_progress_page(page, report)]
    elif isinstance(report, BesideReport):
        paints = [lambda page: paint_beside_page(page, report)]
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
