"""The card with the plot of an agreement: zoom, pictures and values as every other plot."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QRectF, QSize
from PySide6.QtGui import QPainter

from carpus.ui.plot import axes
from carpus.ui.plot.agreement import AgreementPlot
from carpus.ui.plot.axes import Panel
from carpus.ui.plot.style import PlotStyle, screen_style
from carpus.ui.plot.zoom_card import ZoomCard
from carpus.ui.theme import Theme

if TYPE_CHECKING:
    from carpus.ui.plot.canvas import Canvas

HEAD_PX = 52
"""Room at the top for the controls of the screen that lie over the card."""


class AgreementChart(ZoomCard):
    """Shows one angle of a comparison, or nothing."""

    usual_px = (864, 340)

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme, "agreement")
        self.plot: AgreementPlot | None = None
        self.setAccessibleName(self.tr("Difference of the two measurements"))

    def show_plot(self, plot: AgreementPlot | None) -> None:
        self.plot, self._window = plot, None
        self.forget()

    def minimumSizeHint(self) -> QSize:
        return QSize(420, self._theme.px(HEAD_PX) + self._theme.px(180))

    # --- window -------------------------------------------------------------------------------------------
    def extent(self) -> tuple[float, float] | None:
        return None if self.plot is None else self.plot.extent()

    def panel(self) -> Panel | None:
        if self.plot is None:
            return None
        box = QRectF(self.rect()).adjusted(16.5, self._theme.px(HEAD_PX) + 0.5, -16.5, -8.5)
        panel = self.plot.panel(screen_style(self._theme), box, self._window)
        return replace(panel, box=axes.crisp(panel.box))

    # --- what is in it ------------------------------------------------------------------------------------
    def lay_out(self, canvas: Canvas) -> None:
        panel = self.panel()
        self.more.setVisible(panel is not None)
        canvas.lay_out([panel] if panel is not None else [], self.extent(), self.shortest)

    def show_marks(self, canvas: Canvas) -> None:
        canvas.show_marks([self.plot.moving()] if self.plot is not None else [])

    def paint_ground(self, painter: QPainter) -> None:
        panel, style = self.panel(), screen_style(self._theme)
        if panel is not None and self.plot is not None:
            for mark in self.plot.ground():
                mark.paint(painter, style, panel)
            self.plot.beside(painter, style, panel)

    # --- for other programs -------------------------------------------------------------------------------
    def paint_on(self, painter: QPainter, style: PlotStyle, box: QRectF) -> None:
        if self.plot is not None:
            self.plot.paint(painter, style, box)

    def table(self) -> tuple[Sequence[str], Iterable[Sequence[str]]]:
        """Every pair of what is shown, not only those that are drawn."""
        plot = self.plot
        head = ["angle", "time_s", "carpus_deg", "reference_deg", "difference_deg"]
        if plot is None:
            return head, []
        start, end = self.shown()
        rows = np.flatnonzero((plot.along >= start) & (plot.along <= end))
        return head, [
            [
                plot.pairs.name, f"{plot.pairs.time_s[k]:.4f}", f"{plot.measured_deg[k]:.3f}",
                f"{plot.reference_deg[k]:.3f}", f"{plot.measured_deg[k] - plot.reference_deg[k]:.3f}",
            ]
            for k in rows
        ]  # fmt: skip
