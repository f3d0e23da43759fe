"""The card with the control charts of a camera, angles over lengths."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QPainter

from carpus.core.calibration.card.chart import CardCheck
from carpus.ui.fonts import SEMIBOLD, font
from carpus.ui.plot.axes import Panel
from carpus.ui.plot.card import PlotCard
from carpus.ui.plot.control_chart import ControlMarks, ControlPlot, control_plots, paint_control_ground
from carpus.ui.plot.marks import Scales
from carpus.ui.plot.style import screen_style, write
from carpus.ui.theme import Theme

if TYPE_CHECKING:
    from carpus.ui.plot.canvas import Canvas

LEFT_PX, RIGHT_PX, HEAD_PX, FOOT_PX, EDGE_PX = 66, 150, 34, 26, 14


class ControlCharts(PlotCard):
    """Two panels; a sentence instead while there is nothing to show."""

    usual_px = (640, 480)

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme)
        self._plots: list[ControlPlot] = []
        self.empty_words = ""
        self.setAccessibleName(self.tr("Checks of this camera"))

    def show_checks(self, checks: Sequence[CardCheck], empty_words: str = "") -> None:
        self._plots, self.empty_words = control_plots(checks), empty_words
        self.forget()

    def minimumSizeHint(self) -> QSize:
        return QSize(self._theme.px(420), self._theme.px(380))

    def panels(self) -> list[Panel]:
        scale = self._theme.text_scale
        height = (self.height() - 2 * EDGE_PX) / 2
        boxes = [
            QRectF(
                LEFT_PX * scale, EDGE_PX + k * height + HEAD_PX * scale, self.width() - (LEFT_PX + RIGHT_PX) * scale,
                max(height - (HEAD_PX + FOOT_PX) * scale, 20.0),
            )
            for k in range(2)
        ]  # fmt: skip
        return [plot.panel(box) for plot, box in zip(self._plots, boxes, strict=False)]

    def lay_out(self, canvas: Canvas) -> None:
        canvas.lay_out(self.panels())

    def show_marks(self, canvas: Canvas) -> None:
        canvas.show_marks([[ControlMarks(plot)] for plot in self._plots])

    def paint_ground(self, painter: QPainter) -> None:
        scale, style = self._theme.text_scale, screen_style(self._theme)
        if not self._plots:
            painter.setFont(font(16 * scale))
            painter.setPen(self._theme.color("text2"))
            flags = int(Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap)
            painter.drawText(QRectF(self.rect()).adjusted(40, 40, -40, -40), flags, self.empty_words)
            return
        for plot, panel in zip(self._plots, self.panels(), strict=True):
            at = QPointF(panel.box.left(), panel.box.top() - 12 * scale)
            write(painter, at, plot.title, font(16 * scale, SEMIBOLD), style.color("text"))
            Scales().paint(painter, style, panel)
            paint_control_ground(painter, style, plot, panel)
