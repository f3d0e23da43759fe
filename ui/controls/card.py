"""Surfaces: the white card, the separator line, and the row of key caps."""

from __future__ import annotations

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QPainter, QPen
from PySide6.QtWidgets import QVBoxLayout, QWidget

from carpus.ui.theme import CARD_PADDING_PX, CARD_RADIUS_PX, Theme


def paint_card(
    painter: QPainter, theme: Theme, box: QRectF, fill: str = "surface", edge: str = "line", edge_px: float = 1.0
) -> QRectF:
    """The surface of a card that fills ``box``; the rectangle of its line."""
    half = edge_px / 2
    frame = box.adjusted(half, half, -half, -half)
    painter.setPen(QPen(theme.color(edge), edge_px))
    painter.setBrush(theme.color(fill))
    painter.drawRoundedRect(frame, CARD_RADIUS_PX, CARD_RADIUS_PX)
    return frame


class Surface(QWidget):
    """A plain ground of one token, for bars; the application's style sheet paints it."""

    def __init__(self, theme: Theme, fill: str = "surface", edge: str = "", under: str = "") -> None:
        """``edge`` is the token of a line about it, ``under`` of one at its lower end."""
        super().__init__()
        self._theme = theme
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setProperty("under", under)
        self.set_colors(fill, edge)

    @property
    def edge(self) -> str:
        """Token of its outline."""
        return str(self.property("edge"))

    def set_colors(self, fill: str, edge: str = "", edge_px: float = 1.0) -> None:
        """Change the surface, as a message of another rank does."""
        for name, value in (("fill", fill), ("edge", edge), ("thick", edge_px > 1.0)):
            self.setProperty(name, value)
        self.style().unpolish(self)
        self.style().polish(self)


class Card(Surface):
    """A rounded surface with a 1 px line; its layout is vertical and already there as ``body``."""

    def __init__(
        self, theme: Theme, padding_px: int = CARD_PADDING_PX, fill: str = "surface", edge: str = "line"
    ) -> None:
        super().__init__(theme, fill, edge)
        self.body = QVBoxLayout(self)
        self.body.setContentsMargins(padding_px, padding_px, padding_px, padding_px)
        self.body.setSpacing(8)


class Line(Surface):
    """A 1 px separator."""

    def __init__(self, theme: Theme, token: str = "line", *, vertical: bool = False) -> None:
        super().__init__(theme, token)
        if vertical:
            self.setFixedWidth(1)
        else:
            self.setFixedHeight(1)
