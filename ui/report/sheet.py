"""Sheets to print in their own size, such as calibration boards, as PDF."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path

from PySide6.QtCore import QPointF, QRectF, QSizeF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPen

from carpus.core.calibration.camera.printed_sheet import PrintedSheet, SheetBox, SheetDisc, SheetLine, SheetText
from carpus.ui.kit.fonts import REGULAR, SEMIBOLD, font
from carpus.ui.kit.theme import LIGHT
from carpus.ui.kit.translate import translate_phrase
from carpus.ui.report.page import DISPLAY_FROM_PT, POINTS_PER_MM, ensure_application, pdf_bytes, save_pdf

_LINE_PT = 0.5


def write_sheets(output_path: Path, sheets: Sequence[PrintedSheet], title: str) -> Path:
    """Write sheets to print, each in its own size in millimetres.

    Raises the faults of :func:`write_report`.
    """
    application = ensure_application()
    pages = [(QSizeF(sheet.width_mm, sheet.height_mm), partial(paint_sheet, sheet=sheet)) for sheet in sheets]
    content = pdf_bytes(pages, title)
    del application
    return save_pdf(output_path, content)


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
