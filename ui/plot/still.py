"""A widget for a plot that is painted whole: what changes in it, changes all of it."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QRectF
from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import QWidget

from carpus.ui.plot.style import PlotStyle, screen_style
from carpus.ui.theme import Theme


class StillPlot(QWidget):
    """``painted`` paints into the whole of it, in the screen's style; without one nothing is shown."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._painted: Callable[[QPainter, PlotStyle, QRectF], None] | None = None

    def show_painted(self, painted: Callable[[QPainter, PlotStyle, QRectF], None] | None) -> None:
        """Show another one."""
        self._painted = painted
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        if self._painted is not None:
            painter = QPainter(self)
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            self._painted(painter, screen_style(self._theme), QRectF(self.rect()))
