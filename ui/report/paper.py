"""A report on a printer's paper, by the painters that make the PDF."""

from __future__ import annotations

from PySide6.QtCore import QMarginsF
from PySide6.QtGui import QPageLayout, QPageSize, QPainter
from PySide6.QtPrintSupport import QPrinter

from carpus.core.results.report_form import PAPER_PT
from carpus.ui.report.page import Page
from carpus.ui.report.pages import Report, pages_of

POINTS_PER_INCH = 72.0
SIZES = {"a4": QPageSize.PageSizeId.A4, "letter": QPageSize.PageSizeId.Letter}
NAME = "Carpus report"
"""What a printer's list of jobs shows: nobody's name."""


def printer_for(report: Report) -> QPrinter:
    """The usual printer, set to the paper of the report."""
    printer = QPrinter(QPrinter.PrinterMode.HighResolution)
    size = QPageSize(SIZES[report.form.paper])
    printer.setPageLayout(QPageLayout(size, QPageLayout.Orientation.Portrait, QMarginsF(0, 0, 0, 0)))
    printer.setFullPage(True)
    printer.setDocName(NAME)
    pages = len(pages_of(report))
    printer.setFromTo(1, pages)
    return printer


def print_on(printer: QPrinter, report: Report) -> None:
    """Print the pages that were asked for, smaller where the printer has other paper than the report."""
    first = max(printer.fromPage(), 1)
    last = printer.toPage() or len(pages_of(report))
    printer.setFullPage(True)
    there = printer.pageLayout().pageSize().size(QPageSize.Unit.Point)
    width, height = PAPER_PT[report.form.paper]
    share = min(1.0, there.width() / (width - 1.0), there.height() / (height - 1.0))
    painter = QPainter()
    if not painter.begin(printer):
        return
    try:
        for number, paint in enumerate(pages_of(report)[first - 1 : last]):
            if number:
                printer.newPage()
            point = printer.resolution() / POINTS_PER_INCH
            paint(Page(painter, point * share))
    finally:
        painter.end()
