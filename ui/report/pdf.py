"""Pages to PDF: vector curves and embedded fonts by Qt's own writer. Works without a window."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from PySide6.QtCore import QBuffer, QByteArray, QIODevice, QMarginsF, QPointF, QRectF, QSizeF, Qt
from PySide6.QtGui import QColor, QPageLayout, QPageSize, QPainter, QPdfWriter, QPen
from PySide6.QtWidgets import QApplication

from carpus.core.calibration.camera.sheet import Disc, PrintedSheet, SheetBox, SheetLine, SheetText
from carpus.core.formats.new_output import look_for_folder, new_bytes
from carpus.core.results.report_form import PAPER_PT
from carpus.ui.fonts import REGULAR, SEMIBOLD, load_fonts
from carpus.ui.report.page import Page
from carpus.ui.report.pages import Report, pages_of
from carpus.ui.translate import say

TITLE = "Carpus report"
"""What a viewer writes above its window and a mail program into its list: nobody's name."""
RESOLUTION_DPI = 1200
POINTS_PER_INCH = 72.0
MM_PER_PT = 25.4 / POINTS_PER_INCH


def ensure_application() -> QApplication:
    """The running Qt application, or one without a screen: fonts and charts need one. Keep the result while writing."""
    running = QApplication.instance()
    application = running if isinstance(running, QApplication) else QApplication(["carpus", "-platform", "offscreen"])
    load_fonts()
    return application


def write_sheets(output_path: Path, sheets: Sequence[PrintedSheet], title: str) -> Path:
    """Write sheets to print, each in its own size, in millimetres as drawn; faults as of :func:`write_report`."""
    pages = [(QSizeF(sheet.width_mm, sheet.height_mm), _painting(sheet)) for sheet in sheets]
    return _write_pages(output_path, pages, title)


def _painting(sheet: PrintedSheet) -> Callable[[Page], None]:
    return lambda page: paint_sheet(page, sheet)


def write_report(report: Report, output_path: Path) -> Path:
    """Write a report of any kind.

    Raises :class:`OutputExists`, :class:`OutputNotWritable` or :class:`DiskFull`; nothing half-written stays.
    """
    width_pt, height_pt = PAPER_PT[report.form.paper]
    paper = None if report.form.paper == "a4" else QSizeF(width_pt * MM_PER_PT, height_pt * MM_PER_PT)
    return _write_pages(output_path, [(paper, paint) for paint in pages_of(report)], TITLE)


def _write_pages(output_path: Path, pages: Sequence[tuple[QSizeF | None, Callable[[Page], None]]], title: str) -> Path:
    application = ensure_application()
    store = QByteArray()
    buffer = QBuffer(store)
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    writer = QPdfWriter(buffer)
    writer.setResolution(RESOLUTION_DPI)
    writer.setPageLayout(_layout(pages[0][0]))
    writer.setTitle(title)
    writer.setCreator("Carpus")
    painter = QPainter(writer)
    try:
        for number, (size, paint) in enumerate(pages):
            if number:
                writer.setPageLayout(_layout(size))
                writer.newPage()
            paint(Page(painter, RESOLUTION_DPI / POINTS_PER_INCH))
    finally:
        painter.end()  # a writer that goes while it is painted on ends the program
    buffer.close()
    del application
    look_for_folder(output_path)
    with new_bytes(output_path) as file:
        file.write(bytes(store.data()))
    return output_path


def _layout(size_mm: QSizeF | None) -> QPageLayout:
    """A page without margins; A4 where no size is named."""
    size = (
        QPageSize(QPageSize.PageSizeId.A4)
        if size_mm is None
        else QPageSize(size_mm, QPageSize.Unit.Millimeter, "", QPageSize.SizeMatchPolicy.ExactMatch)
    )
    return QPageLayout(size, QPageLayout.Orientation.Portrait, QMarginsF(0, 0, 0, 0))


POINTS_PER_MM = 72.0 / 25.4
_LINE_PT = 0.5


def paint_sheet(page: Page, sheet: PrintedSheet) -> None:
    """All marks of a sheet, edges as sharp as the printer has them."""
    painter, mm = page.painter, page.point * POINTS_PER_MM
    # Half-covered edge pixels would make two squares that meet at a corner leak into each other.
    painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
    for mark in sheet.marks:
        if isinstance(mark, SheetBox):
            box = QRectF(mark.left_mm * mm, mark.top_mm * mm, mark.width_mm * mm, mark.height_mm * mm)
            painter.fillRect(box, QColor(mark.color))
        elif isinstance(mark, Disc):
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(QColor(mark.color))
            radius = mark.radius_mm * mm
            painter.drawEllipse(QPointF(mark.x_mm * mm, mark.y_mm * mm), radius, radius)
            painter.setBrush(Qt.BrushStyle.NoBrush)
        elif isinstance(mark, SheetLine):
            style = Qt.PenStyle.DashLine if mark.dashed else Qt.PenStyle.SolidLine
            painter.setPen(QPen(QColor("#000000"), _LINE_PT * page.point, style))
            ends = [QPointF(x * mm, y * mm) for x, y in (mark.from_mm, mark.to_mm)]
            painter.drawLine(*ends)
        elif isinstance(mark, SheetText):
            place = mark.x_mm * POINTS_PER_MM, mark.y_mm * POINTS_PER_MM
            weight, words = SEMIBOLD if mark.bold else REGULAR, say(mark.text)
            room = (sheet.width_mm - mark.x_mm) * POINTS_PER_MM - 12.0
            size = mark.size_pt * min(1.0, room / max(page.width_of(words, mark.size_pt, weight), 1.0))
            page.text(words, *place, size, weight)
