"""A card with plots as a widget: what all of them share. The scene, and pyqtgraph with it, comes when it is shown."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtCore import QRectF, QSize
from PySide6.QtGui import QPainter, QPaintEvent, QResizeEvent, QShowEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from carpus.ui.controls.card import paint_card
from carpus.ui.plot.style import PlotStyle, screen_style
from carpus.ui.theme import Theme

if TYPE_CHECKING:
    from carpus.ui.plot.canvas import Canvas


class PlotCard(QWidget):
    """A subclass says what is in it: :meth:`lay_out`, :meth:`paint_ground` and :meth:`show_marks`."""

    usual_px, least_px = (736, 360), (420, 200)
    """Width and height."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._canvas: Canvas | None = None
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        theme.changed.connect(self.forget)

    # --- for a subclass -----------------------------------------------------------------------------------
    def lay_out(self, canvas: Canvas) -> None:
        """Put panels and layers in their places for the present size and theme."""
        raise NotImplementedError

    def paint_ground(self, painter: QPainter) -> None:
        """Paint what stays: grid, words, limits. The card's surface is there already."""
        raise NotImplementedError

    def show_marks(self, canvas: Canvas) -> None:
        """Hand the panels what moves in them."""
        raise NotImplementedError

    def furnish(self, canvas: Canvas) -> None:
        """Add layers to the new scene."""

    def sizeHint(self) -> QSize:
        return QSize(*self.usual_px)

    def minimumSizeHint(self) -> QSize:
        return QSize(*self.least_px)

    # --- life ---------------------------------------------------------------------------------------------
    @property
    def canvas(self) -> Canvas:
        """The scene; made on first need."""
        if self._canvas is None:
            from carpus.ui.plot.canvas import Canvas

            self._canvas = Canvas(self._theme, self._paint_card, self)
            self._canvas.setGeometry(self.rect())
            self._canvas.lower()
            self._canvas.show()
            self.furnish(self._canvas)
        return self._canvas

    @property
    def face(self) -> QWidget:
        """What is painted on, and what the mouse meets."""
        port: QWidget = self.canvas.viewport()
        return port

    def forget(self) -> None:
        """What stays has changed: lay out and paint everything anew, once it is seen."""
        if self._canvas is not None and self.isVisible():
            self.lay_out(self._canvas)
            self.show_marks(self._canvas)

    def draw(self) -> None:
        """What moves has changed."""
        if self._canvas is not None and self.isVisible():
            self.show_marks(self._canvas)

    def showEvent(self, event: QShowEvent) -> None:
        self.lay_out(self.canvas)
        self.show_marks(self.canvas)

    def resizeEvent(self, event: QResizeEvent) -> None:
        if self._canvas is not None:
            self._canvas.setGeometry(self.rect())
            self.forget()

    def _paint_card(self, painter: QPainter) -> None:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        paint_card(painter, self._theme, QRectF(self.rect()))
        self.paint_ground(painter)


class StillPlot(QWidget):
    """``painted`` paints into the whole of it, in the screen's style; without one nothing is shown."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._painted: Callable[[QPainter, PlotStyle, QRectF], None] | None = None

    def show_painted(self, painted: Callable[[QPainter, PlotStyle, QRectF], None] | None) -> None:
        self._painted = painted
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        if self._painted is not None:
            painter = QPainter(self)
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            self._painted(painter, screen_style(self._theme), QRectF(self.rect()))
