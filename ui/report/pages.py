"""A report page by page, the same on the screen and on paper."""

from __future__ import annotations

from collections.abc import Callable

from carpus.ui.report.beside_page import BesideReport, paint_beside_page
from carpus.ui.report.motion_page import paint_motion_page
from carpus.ui.report.page import Page
from carpus.ui.report.progress_page import ProgressReport, paint_progress_page
from carpus.ui.report.session_page import SessionReport, paint_session_page

Report = SessionReport | ProgressReport | BesideReport


def pages_of(report: Report) -> list[Callable[[Page], None]]:
    """What paints each page; the painter is as it was when a page is done."""
    paints: list[Callable[[Page], None]] = []
    if isinstance(report, ProgressReport):
        paints = [lambda page: paint_progress_page(page, report)]
    elif isinstance(report, BesideReport):
        paints = [lambda page: paint_beside_page(page, report)]
    else:
        paints = [lambda page: paint_session_page(page, report)]
        if report.motion is not None:
            paints.append(lambda page: paint_motion_page(page, report))
    return [_kept(paint) for paint in paints]


def _kept(paint: Callable[[Page], None]) -> Callable[[Page], None]:
    def painted(page: Page) -> None:
        page.painter.save()
        paint(page)
        page.painter.restore()

    return painted
