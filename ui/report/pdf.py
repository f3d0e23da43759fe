"""PDF output by Qt's writer: vector curves and embedded fonts, without a display."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

from PySide6.QtCore import QBuffer, QByteArray, QIODevice, QMarginsF, QPointF, QRectF, QSizeF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QGuiApplication, QPageLayout, QPageSize, QPainter, QPdfWriter, QPen
from PySide6.QtWidgets import QApplication

from carpus.core.calibration.camera.printed_sheet import PrintedSheet, SheetBox, SheetDisc, SheetLine, SheetText
from carpus.core.formats.output_files import open_new_file, require_folder
from carpus.ui.kit.fonts import REGULAR, SEMIBOLD, font, load_fonts
from carpus.ui.kit.theme import LIGHT
from carpus.ui.kit.translate import translate_phrase
from carpus.ui.report.page import DISPLAY_FROM_PT, Page, Report, layout_pages

# Shown by PDF viewers and mail programs, so without a name.
TITLE = "Carpus report"
RESOLUTION_DPI = 1200
POINTS_PER_INCH = 72.0
POINTS_PER_MM = POINTS_PER_INCH / 25.4
# Paints a page, given painter units per point.
PaintPage = Callable[[QPainter, float], None]


def ensure_application() -> QApplication:
    """Return the running Qt application, or a new one without a screen; keep it while writing."""
    running = QGuiApplication.instance()
    application = running if isinstance(running, QApplication) else QApplication(["carpus", "-platform", "offscreen"])
    load_fonts()
    return application


def write_sheets(output_path: Path, sheets: Sequence[PrintedSheet], title: str) -> Path:
    """Write sheets to print, each in its own size in millimetres.

    Raises the faults of :func:`write_report`.
    """
    application = ensure_application()
    pages = [(QSizeF(sheet.width_mm, sheet.height_mm), partial(paint_sheet, sheet=sheet)) for sheet in sheets]
    content = pdf_bytes(pages, title)
    del application
    return save_pdf(output_path, content)


def write_report(report: Report, output_path: Path) -> Path:
    """Write a report of any kind as PDF.

    Raises
    ------
    OutputExists, OutputNotWritable, DiskFull
            If the file cannot be written; no partial file is left.
    """
    application = ensure_application()
    content = report_pdf(layout_pages(report))
    del application
    return save_pdf(output_path, content)


def report_pdf(pages: Sequence[Page]) -> bytes:
    """Return pages as a PDF; call it in the window's thread only."""
    return pdf_bytes([(page.size_mm, page.paint) for page in pages], TITLE)


def save_pdf(output_path: Path, content: bytes) -> Path:
    """Save a PDF's content; raises the faults of :func:`write_report`."""
    require_folder(output_path)
    with open_new_file(output_path) as file:
        file.write(content)
    return output_path


def pdf_bytes(pages: Sequence[tuple[QSizeF | None, PaintPage]], title: str) -> bytes:
    """Return the PDF of pages (size in mm or None for A4, paint function)."""
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
            paint(painter, RESOLUTION_DPI / POINTS_PER_INCH)
    finally:
        painter.end()  # a writer that goes while it is painted on ends the program
    buffer.close()
    return bytes(store.data())


def _layout(size_mm: QSizeF | None) -> QPageLayout:
    size = (
        QPageSize(QPageSize.PageSizeId.A4)
        if size_mm is None
        else QPageSize(size_mm, QPageSize.Unit.Millimeter, "", QPageSize.SizeMatchPolicy.ExactMatch)
    )
    return QPageLayout(size, QPageLayout.Orientation.Portrait, QMarginsF(0, 0, 0, 0))


_LINE_PT = 0.5


def paint_sheet(painter: QPainter, point: float, sheet: PrintedSheet) -> None:
    """Paint all marks of a sheet."""
    mm = point * POINTS_PER_MM
    # Half-covered edge pixels would make two squares that meet at a corner leak into each other.
    painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
    for mark in sheet.items:
        if isinstance(mark, SheetBox):
            box = QRectF(mark.left_mm * mm, mark.top_mm * mm, mark.width_mm * mm, mark.height_mm * mm)
            painter.fillRect(box, QColor(mark.color))
        elif isinstance(mark, SheetDisc):
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(QColor(mark.color))
            radius = mark.radius_mm * mm
            painter.drawEllipse(QPointF(mark.x_mm * mm, mark.y_mm * mm), radius, radius)
            painter.setBrush(Qt.BrushStyle.NoBrush)
        elif isinstance(mark, SheetLine):
            style = Qt.PenStyle.DashLine if mark.dashed else Qt.PenStyle.SolidLine
            painter.setPen(QPen(QColor("#000000"), _LINE_PT * point, style))
            ends = [QPointF(x * mm, y * mm) for x, y in (mark.from_mm, mark.to_mm)]
            painter.drawLine(*ends)
        elif isinstance(mark, SheetText):
            weight, words = SEMIBOLD if mark.bold else REGULAR, translate_phrase(mark.text)
            face = font(mark.size_pt * point, weight, display=mark.size_pt >= DISPLAY_FROM_PT)
            room = (sheet.width_mm - mark.x_mm) * mm - 12.0 * point
            wide = QFontMetricsF(face).horizontalAdvance(words)
            face.setPixelSize(round(face.pixelSize() * min(1.0, room / max(wide, 1.0))))
            painter.setFont(face)
            painter.setPen(QColor(LIGHT.text))
            painter.drawText(QPointF(mark.x_mm * mm, mark.y_mm * mm), words)
