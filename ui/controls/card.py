"""Surfaces: the white card, the separator line, and the row of key caps."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QFontMetricsF, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QVBoxLayout, QWidget

from carpus.ui.fonts import MEDIUM, font
from carpus.ui.keys import key_name
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


class KeyCaps(QWidget):
    """Keys and what they do, in one line: ``[("Space", "accept"), ...]``."""

    def __init__(self, theme: Theme, keys: Sequence[tuple[str, str]], gap_px: int = 16) -> None:
        super().__init__()
        self._theme, self._gap_px = theme, gap_px
        self._keys: tuple[tuple[str, str], ...] = ()
        self.set_keys(keys)
        self.setSizePolicy(QSizePolicy.Policy.Maximum, QSizePolicy.Policy.Fixed)
        theme.changed.connect(self.updateGeometry)

    def set_keys(self, keys: Sequence[tuple[str, str]]) -> None:
        """Show others."""
        self._keys = tuple((key_name(cap), word) for cap, word in keys)
        self.updateGeometry()
        self.update()

    def minimumSizeHint(self) -> QSize:
        return QSize(0, self.sizeHint().height())

    def sizeHint(self) -> QSize:
        metrics = self._metrics()
        width = sum(
            metrics.horizontalAdvance(cap) + 12 + 7 + metrics.horizontalAdvance(word) for cap, word in self._keys
        )
        return QSize(round(width + self._gap_px * (len(self._keys) - 1)) + 2, round(metrics.height()) + 8)

    def _metrics(self) -> QFontMetricsF:
        return QFontMetricsF(font(12 * self._theme.text_scale, MEDIUM))

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setFont(font(12 * self._theme.text_scale, MEDIUM))
        metrics = self._metrics()
        left = 0.5
        for cap, word in self._keys:
            width = metrics.horizontalAdvance(cap) + 12
            if left + width + 7 + metrics.horizontalAdvance(word) > self.width() + 1:
                break  # what does not fit is left out whole; the help names every key
            key = QRectF(left, 1.5, width, self.height() - 3)
            painter.setPen(QPen(self._theme.color("border"), 1))
            painter.setBrush(self._theme.color("surface"))
            painter.drawRoundedRect(key, 4, 4)
            painter.setPen(self._theme.color("text"))
            painter.drawText(key, Qt.AlignmentFlag.AlignCenter, cap)
            left += width + 7
            painter.setPen(self._theme.color("text2"))
            painter.drawText(QRectF(left, 0, 400, self.height()), Qt.AlignmentFlag.AlignVCenter, word)
            left += metrics.horizontalAdvance(word) + self._gap_px
