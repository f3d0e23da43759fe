"""Paints a sheet to print: a camera board or a check card, true to the millimetre."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen

from carpus.core.calibration.camera.sheet import Disc, PrintedSheet, SheetBox, SheetLine, SheetText
from carpus.ui.fonts import REGULAR, SEMIBOLD
from carpus.ui.report.page import Page
from carpus.ui.translate import say

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
