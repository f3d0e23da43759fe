"""The card with the ways of a session in the three planes of the papers, up to the player's time."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QPainter

from carpus.ui.fonts import SEMIBOLD, font
from carpus.ui.plot.axes import Panel
from carpus.ui.plot.card import PlotCard
from carpus.ui.plot.style import screen_style, write
from carpus.ui.plot.ways import WayPlot, paint_planes, plane_marks, side_by_side
from carpus.ui.theme import Theme

if TYPE_CHECKING:
    from carpus.ui.plot.canvas import Canvas

EDGE_PX, HEAD_PX, BETWEEN_PX = 20, 34, 14


class WaysView(PlotCard):
    """Three panels: the way of the wrist with the hand's axes, or the ways of finger joints."""

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme)
        self._plot: WayPlot | None = None
        self._title = ""
        self._time_s = math.nan
        self.setAccessibleName(self.tr("Ways in three planes"))

    def show_plot(self, plot: WayPlot, title: str) -> None:
        self._plot, self._title = plot, title
        self.forget()

    def set_time(self, time_s: float) -> None:
        self._time_s = time_s
        self.draw()

    # --- places -------------------------------------------------------------------------------------------
    def panels(self) -> list[Panel]:
        head = HEAD_PX * self._theme.text_scale
        box = QRectF(self.rect()).adjusted(EDGE_PX, head, -EDGE_PX, -10)
        return side_by_side(screen_style(self._theme), box, BETWEEN_PX)

    # --- what is in it ------------------------------------------------------------------------------------
    def lay_out(self, canvas: Canvas) -> None:
        canvas.lay_out(self.panels() if self._plot is not None else [])

    def show_marks(self, canvas: Canvas) -> None:
        if self._plot is not None:
            canvas.show_marks(plane_marks(self._plot, self._time_s))

    def paint_ground(self, painter: QPainter) -> None:
        if self._plot is None:
            return
        scale, style = self._theme.text_scale, screen_style(self._theme)
        at, face = QPointF(EDGE_PX, 24 * scale), font(14 * scale, SEMIBOLD)
        write(painter, at, self._title, face, style.color("text"))
        paint_planes(painter, style, self._plot, self.panels())
