"""A drawn hand with the visibility of each marker, and what would show more of them."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QFontMetricsF, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from carpus.core.model.hand.protocols import SITES
from carpus.core.model.types import Side
from carpus.ui.charts.history import MarkerVisibility
from carpus.ui.kit.card import paint_card
from carpus.ui.kit.fonts import MEDIUM, REGULAR, SEMIBOLD, font
from carpus.ui.kit.icons import paint_state
from carpus.ui.kit.theme import Theme
from carpus.ui.picture.hand_drawing import MARKER_POSITIONS, hand_outline, placement
from carpus.ui.screens.live.status_light import hand_map_words

RADIUS_PX = 7.0
WORDS_PX = 172
MAX_LINES = 4.2
"""Lines of the sentence beside the map, below which the keys have room."""


class HandMap(QWidget):
    """Shows the visibility of all markers."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._side: Side = "right"
        self.visibility: dict[str, MarkerVisibility] = {}
        self._dip_inferred = False
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        theme.changed.connect(self.update)

    def set_side(self, side: Side) -> None:
        self._side = side
        self.update()

    def show_visibility(self, visibility: dict[str, MarkerVisibility], *, dip_inferred: bool = False) -> None:
        """Change the visibility; screen readers get the sentence."""
        if (visibility, dip_inferred) != (self.visibility, self._dip_inferred):
            self.visibility, self._dip_inferred = visibility, dip_inferred
            self.setAccessibleName(self.summary())
            self.update()

    def summary(self) -> str:
        return hand_map_words(self.visibility, dip_inferred=self._dip_inferred) if self.visibility else ""

    def sizeHint(self) -> QSize:
        return QSize(440, 300)

    def minimumSizeHint(self) -> QSize:
        return QSize(340, 210)

    def paintEvent(self, event: QPaintEvent) -> None:
        theme, scale = self._theme, self._theme.text_scale
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        frame = paint_card(painter, theme, QRectF(self.rect()))
        words_left = self.width() - max(WORDS_PX * scale, self._words_width_px()) - 16 * scale
        to = placement(QRectF(12, 8, words_left - 24, self.height() - 9), self._side)
        painter.setClipRect(frame)
        painter.setPen(QPen(theme.color("border"), 1.3))
        painter.setBrush(theme.color("sunken"))
        painter.drawPath(to.map(hand_outline()))
        painter.setClipping(False)
        for name in self.visibility or SITES:
            self._paint_marker(painter, to.map(QPointF(*MARKER_POSITIONS[name])), self.visibility.get(name, "hidden"))
        self._paint_words(painter, words_left)

    def _words_width_px(self) -> float:
        """Return the width of the words beside the counts, at most half of the map."""
        metrics = QFontMetricsF(font(14 * self._theme.text_scale, REGULAR))
        longest = max(metrics.horizontalAdvance(words) for _, words in self._legend())
        return min(18 + 24 * self._theme.text_scale + 7 + longest + 4, 0.5 * self.width())

    def _legend(self) -> tuple[tuple[MarkerVisibility, str], ...]:
        return (
            ("seen", self.tr("visible")),
            ("partly", self.tr("partly visible")),
            ("hidden", self.tr("occluded, predicted")),
        )

    def _paint_marker(self, painter: QPainter, at: QPointF, state: MarkerVisibility) -> None:
        color = self._theme.color
        if state == "seen":
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(color("accent"))
            painter.drawEllipse(at, RADIUS_PX - 0.5, RADIUS_PX - 0.5)
            return
        outer = RADIUS_PX + 1
        box = QRectF(at.x() - outer, at.y() - outer, 2 * outer, 2 * outer)
        shape, token = ("partly", "warn") if state == "partly" else ("predicted", "text2")
        paint_state(painter, shape, box, color(token), color("surface"))  # type: ignore[arg-type]

    def _paint_words(self, painter: QPainter, left: float) -> None:
        theme, scale = self._theme, self._theme.text_scale
        painter.setFont(font(16 * scale, SEMIBOLD))
        painter.setPen(theme.color("text"))
        y = 16.0
        painter.drawText(QPointF(left, y + QFontMetricsF(painter.font()).ascent()), self.tr("Markers"))
        y += 34 * scale
        for state, words in self._legend():
            self._paint_marker(painter, QPointF(left + 8, y + 9 * scale), state)
            count = sum(one == state for one in self.visibility.values())
            painter.setFont(font(14 * scale, SEMIBOLD))
            painter.setPen(theme.color("text"))
            box = QRectF(left + 18, y, 24 * scale, 18 * scale)
            painter.drawText(box, int(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter), str(count))
            painter.setFont(font(14 * scale, REGULAR))
            flags = int(Qt.AlignmentFlag.AlignVCenter)
            painter.drawText(QRectF(box.right() + 7, y, self.width() - box.right() - 10, 18 * scale), flags, words)
            y += 28 * scale
        painter.setPen(QPen(theme.color("line"), 1))
        painter.drawLine(QPointF(left, round(y) + 0.5), QPointF(self.width() - 16, round(y) + 0.5))
        y += 12 * scale
        painter.setPen(theme.color("text"))
        keys = self.tr("F2 next joint · F3 next finger\nShift+F8 from the side")
        small = font(12 * scale, REGULAR)
        keys_px = max(QFontMetricsF(small).horizontalAdvance(line) for line in keys.split("\n"))
        below = QFontMetricsF(small).height() * 2 + 12
        room = QRectF(left, y, self.width() - left - 14, self.height() - y - 8)
        painter.setFont(font(14 * scale, MEDIUM))
        wrapped = QFontMetricsF(painter.font()).boundingRect(room, int(Qt.TextFlag.TextWordWrap), self.summary())
        if wrapped.height() > room.height():  # a language that says it in more words
            painter.setFont(font(12 * scale, MEDIUM))
        painter.drawText(room, int(Qt.TextFlag.TextWordWrap), self.summary())
        lines_px = max(QFontMetricsF(painter.font()).height() * MAX_LINES, wrapped.height())
        if self.height() - below > y + lines_px and keys_px <= self.width() - left - 8:
            painter.setFont(small)
            painter.setPen(theme.color("text2"))
            painter.drawText(QRectF(left, self.height() - below, self.width() - left - 8, below), 0, keys)
