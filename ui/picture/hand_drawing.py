"""Small drawing of a hand from above with the marker positions; the next one to click is highlighted."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import Literal

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPainterPath, QPainterPathStroker, QPaintEvent, QPen, QTransform
from PySide6.QtWidgets import QSizePolicy, QWidget

from carpus.core.model.types import Side
from carpus.ui.kit.fonts import MEDIUM, SEMIBOLD, font
from carpus.ui.kit.icons import octagon, paint_state
from carpus.ui.kit.theme import CARD_RADIUS_PX, Theme

SIZE = (200.0, 290.0)
"""Unit of the drawing: a right hand from above, fingers up, thumb on the left."""
FINGERS = {
    1: ((72, 218), (50, 178), (36, 146), (22, 112)),
    2: ((87, 146), (80, 97), (75, 68), (70, 38)),
    3: ((114, 146), (113, 88), (112, 54), (112, 20)),
    4: ((136, 155), (144, 98), (148, 68), (151, 38)),
    5: ((157, 165), (168, 125), (176, 101), (184, 77)),
}
"""Per finger MCP, PIP, DIP, tip; the thumb's are base, MCP, IP and tip."""
WIDTHS = {1: 25.0, 2: 20.0, 3: 21.0, 4: 20.0, 5: 17.0}
PALM = (
    (84, 297), (84, 262), (80, 244), (66, 214), (58, 196), (72, 168), (84, 150), (112, 143), (140, 150), (156, 166),
    (160, 196), (154, 228), (146, 256), (145, 297),
)  # fmt: skip
MARKER_POSITIONS: dict[str, tuple[float, float]] = {"WRIST": (114, 254), "CMC1": (93, 236)}
MARKER_POSITIONS |= {
    f"{joint}{k}": FINGERS[k][n] for k in (2, 3, 4, 5) for n, joint in enumerate(("MCP", "PIP", "DIP", "TIP"))
}
MARKER_POSITIONS |= {"MCP1": FINGERS[1][1], "IP1": FINGERS[1][2], "TIP1": FINGERS[1][3]}

MarkerState = Literal["done", "next", "later", "proposed", "doubtful", "wrong"]


@lru_cache(maxsize=1)
def hand_outline() -> QPainterPath:
    """Return the outline of the right hand in the drawing's unit."""
    hand = QPainterPath(QPointF(*PALM[0]))
    for point in PALM[1:]:
        hand.lineTo(QPointF(*point))
    hand.closeSubpath()
    soft = QPainterPathStroker()
    soft.setWidth(14)
    soft.setJoinStyle(Qt.PenJoinStyle.RoundJoin)
    whole = hand.united(soft.createStroke(hand))
    for k, joints in FINGERS.items():
        bone = QPainterPath(QPointF(*joints[0]))
        bone.lineTo(QPointF(*joints[1]))
        bone.lineTo(QPointF(*joints[3]))
        around = QPainterPathStroker()
        around.setWidth(WIDTHS[k] * 1.15)
        around.setCapStyle(Qt.PenCapStyle.RoundCap)
        around.setJoinStyle(Qt.PenJoinStyle.RoundJoin)
        whole = whole.united(around.createStroke(bone))
    frame = QPainterPath()
    frame.addRect(QRectF(0, 0, SIZE[0], SIZE[1]))
    return whole.intersected(frame).simplified()


def placement(box: QRectF, side: Side) -> QTransform:
    """Return the transform from the drawing's unit into a box, mirrored for a left hand."""
    scale = min(box.width() / SIZE[0], box.height() / SIZE[1])
    to = QTransform()
    to.translate(box.center().x(), box.bottom() - SIZE[1] * scale)
    to.scale(scale if side == "right" else -scale, scale)
    to.translate(-SIZE[0] / 2, 0)
    return to


class HandDrawing(QWidget):
    """Card with the hand and the state of each marker."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._side: Side = "right"
        self._states: dict[str, MarkerState] = {}
        self._order: tuple[str, ...] = ()
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        theme.changed.connect(self.update)

    def show_markers(self, side: Side, states: Mapping[str, MarkerState]) -> None:
        self._side, self._states, self._order = side, dict(states), tuple(states)
        self.setAccessibleName(self.tr("Hand from above"))
        self.update()

    def sizeHint(self) -> QSize:
        return QSize(376, 290)

    def minimumSizeHint(self) -> QSize:
        return QSize(200, 150)

    def paintEvent(self, event: QPaintEvent) -> None:
        theme = self._theme
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        frame = QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5)
        card = QPainterPath()
        card.addRoundedRect(frame, CARD_RADIUS_PX, CARD_RADIUS_PX)
        painter.fillPath(card, theme.color("surface"))
        to = placement(frame.adjusted(8, 8, -8, 0), self._side)
        painter.setClipPath(card)
        painter.setPen(QPen(theme.color("border"), 1.3))
        painter.setBrush(theme.color("sunken"))
        painter.drawPath(to.map(hand_outline()))
        painter.setClipping(False)
        painter.setPen(QPen(theme.color("line"), 1))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawPath(card)
        painter.setFont(font(12 * theme.text_scale, MEDIUM))
        painter.setPen(theme.color("text2"))
        words = self.tr("Right hand,\nfrom above") if self._side == "right" else self.tr("Left hand,\nfrom above")
        flag = Qt.AlignmentFlag.AlignLeft if self._side == "right" else Qt.AlignmentFlag.AlignRight
        painter.drawText(frame.adjusted(16, 14, -16, 0), int(flag), words)
        mark_scale = min(1.0, 1.2 * to.m22())  # in a small drawing the marks of the fingertips would lie on each other
        for number, name in sorted(enumerate(self._order), key=lambda item: self._states[item[1]] == "next"):
            painter.save()
            painter.translate(to.map(QPointF(*MARKER_POSITIONS[name])))
            painter.scale(mark_scale, mark_scale)
            self._paint_marker(painter, QPointF(), self._states[name], number + 1)
            painter.restore()

    def _paint_marker(self, painter: QPainter, at: QPointF, state: MarkerState, number: int) -> None:
        color = self._theme.color
        if state == "done":
            paint_state(
                painter, "good", QRectF(at.x() - 8.5, at.y() - 8.5, 17, 17), color("accent"), color("on_accent")
            )
        elif state == "next":
            halo = QColor(color("accent", 60))
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(halo)
            painter.drawEllipse(at, 16, 16)
            painter.setBrush(color("accent"))
            painter.setPen(QPen(color("surface"), 1.5))
            painter.drawEllipse(at, 12, 12)
            self._paint_number(painter, at, number, "on_accent", 14)
        elif state == "later":
            painter.setPen(QPen(color("border"), 1.3))
            painter.setBrush(color("surface"))
            painter.drawEllipse(at, 8.5, 8.5)
            self._paint_number(painter, at, number, "text2", 12)
        elif state in ("proposed", "doubtful"):
            shape, token = ("predicted", "accent") if state == "proposed" else ("warn", "warn")
            box = QRectF(at.x() - 9, at.y() - 9, 18, 18)
            paint_state(painter, shape, box, color(token), color("surface"))  # type: ignore[arg-type]
        elif state == "wrong":
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.setPen(QPen(color("bad"), 1.6))
            painter.drawPolygon(octagon(at, 15))
            paint_state(painter, "bad", QRectF(at.x() - 10, at.y() - 10, 20, 20), color("bad"), color("surface"))

    def _paint_number(self, painter: QPainter, at: QPointF, number: int, token: str, size: int) -> None:
        painter.setFont(font(size, SEMIBOLD))
        painter.setPen(self._theme.color(token))
        painter.drawText(QRectF(at.x() - 14, at.y() - 14, 28, 28), Qt.AlignmentFlag.AlignCenter, str(number))
