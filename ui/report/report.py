"""What a report is, and its pages."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from carpus.core.records.values import Patient
from carpus.core.results.report_form import ReportForm
from carpus.core.results.session_results import SessionResults
from carpus.ui.kit.language import use_language
from carpus.ui.kit.translate import tr
from carpus.ui.report.page import Body, Page


class Report(Protocol):
    """Report that can be shown, printed and saved."""

    @property
    def form(self) -> ReportForm: ...

    @property
    def language(self) -> str:
        """Language by two letters; empty for the window's."""

    @property
    def kind(self) -> str:
        """Kind in a word, for the file name."""

    @property
    def pseudonym(self) -> str: ...

    @property
    def printed_patient(self) -> Patient | None:
        """Patient whose real name is printed beside the pseudonym; None for the pseudonym alone."""

    @property
    def sessions(self) -> Sequence[SessionResults]: ...

    def bodies(self) -> Sequence[Body]: ...


def layout_pages(report: Report) -> list[Page]:
    """Lay the pages out in the report's language; call it in the window's thread only."""
    with use_language(report.language):
        bodies, simulated = report.bodies(), any(results.is_simulated for results in report.sessions)
        pages = []
        for number, body in enumerate(bodies, 1):
            words = tr("page {number} of {count}").format(number=number, count=len(bodies)) if len(bodies) > 1 else ""
            pages.append(Page(report.form, body(words), simulated=simulated))
        return pages
