"""The card with the chart of the sessions."""

from __future__ import annotations

from PySide6.QtCore import QRectF, QSize
from PySide6.QtGui import QImage, QPainter, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from core.output.report_content import Progress
from ui.controls.card import paint_card
from ui.plot.style import screen_style
from ui.progress.chart_painter import paint_chart
from ui.theme import Theme


class ProgressChart(QWidget):
    """The card with the chart."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._progress = Progress((), (), None)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setAccessibleName(self.tr("Range over the sessions"))
        theme.changed.connect(self.update)

    def show_progress(self, progress: Progress) -> None:
        """Draw another course."""
        self._progress = progress
        self.update()

    def sizeHint(self) -> QSize:
        return QSize(864, 560)

    def minimumSizeHint(self) -> QSize:
        return QSize(480, 320)

    def picture(self, width_px: int = 1728, height_px: int = 1134) -> QImage:
        """The chart as a picture for other programs."""
        image = QImage(width_px, height_px, QImage.Format.Format_RGB32)
        image.fill(self._theme.color("surface"))
        painter = QPainter(image)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.scale(2.0, 2.0)
        box = QRectF(0, 0, width_px / 2, height_px / 2).adjusted(20, 16, -16, -14)
        paint_chart(painter, screen_style(self._theme), box, self._progress)
        painter.end()
        return image

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        frame = paint_card(painter, self._theme, QRectF(self.rect()))
        paint_chart(painter, screen_style(self._theme), frame.adjusted(20, 16, -16, -14), self._progress)
