"""Drawings of the guide: where the markers go, and camera, arm and light from the side."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QFontMetricsF, QPainter, QPen

from carpus.core.model.hand.protocols import PALM_MARKERS, SITES
from carpus.core.model.types import Side
from carpus.ui.kit.fonts import MEDIUM, SEMIBOLD, font
from carpus.ui.kit.language import current_language
from carpus.ui.kit.theme import LIGHT
from carpus.ui.picture.hand_drawing import MARKER_POSITIONS, SIZE, hand_outline, placement
from carpus.ui.words.terms import marker_title

MARKER_COLOR = "#2B4FB0"
MARKER_MM, HAND_MM = 12.0, 190.0
_CAPTIONS = {
    "en": ("70 to 80 cm,", "at least 60 cm", "camera, straight down", "safety cord", "forearm rests, still",
           "plain table, nothing blue"),
    "de": ("70 bis 80 cm,", "mindestens 60 cm", "Kamera, senkrecht", "Sicherungsschnur", "Unterarm liegt ruhig",
           "heller Tisch, nichts Blaues"),
    "it": ("da 70 a 80 cm,", "almeno 60 cm", "telecamera, verticale", "cordino", "avambraccio fermo",
           "tavolo chiaro, niente di blu"),
}  # fmt: skip
"""Distances, camera, cord, forearm and table, by language."""


def paint_marker_map(painter: QPainter, box: QRectF, side: Side, *, whole_hand: bool, unit: float) -> None:
    """Draw a hand with its markers and their names; ``unit`` is a design pixel in the painter's unit."""
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    inner = box.adjusted(0.24 * box.width(), 0, -0.24 * box.width(), 0)
    to = placement(inner, side)
    painter.save()
    painter.setTransform(to, True)
    painter.setPen(QPen(QColor(LIGHT.border), 1.2))
    painter.setBrush(QColor("#F3E3D8"))
    painter.drawPath(hand_outline())
    painter.restore()
    scale = to.map(QPointF(0, 1)).y() - to.map(QPointF(0, 0)).y()
    radius = max(0.5 * MARKER_MM / HAND_MM * SIZE[1] * scale * 0.9, 2.0 * unit)
    for name in SITES if whole_hand else PALM_MARKERS:
        at = to.map(QPointF(*MARKER_POSITIONS[name]))
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(MARKER_COLOR))
        size = radius * (0.8 if name.startswith(("TIP", "DIP")) else 1.0)
        painter.drawEllipse(at, size, size)
    named = ("WRIST", "CMC1", "MCP5", "PIP5", "DIP5", "TIP5", "MCP1", "IP1", "TIP1") if whole_hand else PALM_MARKERS
    sign, text = 1 if side == "right" else -1, font(14 * unit, SEMIBOLD)
    rows: dict[int, list[tuple[float, str, QPointF]]] = {-1: [], 1: []}
    for name in named:
        at, is_outer = to.map(QPointF(*MARKER_POSITIONS[name])), name[-1] == "5" or name in ("WRIST", "MCP3", "MCP4")
        rows[sign if is_outer else -sign].append((at.y(), marker_title(name), at))
    for where, names in rows.items():
        _paint_names(painter, box, where, sorted(names, key=lambda one: one[0]), text, unit)


def _paint_names(
    painter: QPainter, box: QRectF, side: int, names: list[tuple[float, str, QPointF]], text: QFont, unit: float
) -> None:
    """Draw the names of one side below each other, each with a line to its marker."""
    painter.setFont(text)
    metrics = QFontMetricsF(text)
    least = metrics.height() * 1.25
    y = -1e9
    for wanted, words, at in names:
        y = max(wanted, y + least)
        width = metrics.horizontalAdvance(words)
        left = box.right() - width if side > 0 else box.left()
        edge = left - 6 * unit if side > 0 else left + width + 6 * unit
        painter.setPen(QPen(QColor(LIGHT.border), 1.2 * unit))
        painter.drawLine(QPointF(edge, y), at)
        painter.setPen(QColor(LIGHT.text))
        painter.drawText(QPointF(left, y + 0.35 * metrics.ascent()), words)


def paint_camera_setup(painter: QPainter, box: QRectF, unit: float) -> None:
    """Draw table, arm and camera from the side with the distances."""
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    width, height = box.width(), box.height()

    def to_page(x: float, y: float) -> QPointF:
        return QPointF(box.left() + x * width, box.top() + y * height)

    line = QPen(QColor(LIGHT.text), 3 * unit, Qt.PenStyle.SolidLine, Qt.PenCapStyle.RoundCap)
    painter.setPen(line)
    painter.drawLine(to_page(0.08, 0.84), to_page(0.92, 0.84))
    painter.drawLine(to_page(0.14, 0.84), to_page(0.14, 0.98))
    painter.drawLine(to_page(0.86, 0.84), to_page(0.86, 0.98))
    painter.drawLine(to_page(0.84, 0.84), to_page(0.84, 0.10))
    painter.drawLine(to_page(0.84, 0.10), to_page(0.50, 0.10))
    painter.setBrush(QColor(LIGHT.text))
    painter.drawRoundedRect(QRectF(to_page(0.41, 0.10), to_page(0.59, 0.17)), 4 * unit, 4 * unit)
    cone = QPen(QColor(LIGHT.accent), 1.6 * unit, Qt.PenStyle.DashLine)
    painter.setPen(cone)
    for x in (0.26, 0.74):
        painter.drawLine(to_page(0.50, 0.17), to_page(x, 0.82))
    painter.setPen(QPen(QColor(LIGHT.border), 1.4 * unit))
    painter.setBrush(QColor("#F3E3D8"))
    painter.drawRoundedRect(QRectF(to_page(0.16, 0.765), to_page(0.50, 0.835)), 12 * unit, 12 * unit)
    painter.drawRoundedRect(QRectF(to_page(0.48, 0.785), to_page(0.70, 0.835)), 10 * unit, 10 * unit)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(QColor(MARKER_COLOR))
    for x in (0.49, 0.57, 0.60):
        painter.drawEllipse(to_page(x, 0.775), 5 * unit, 2.5 * unit)
    painter.setPen(QPen(QColor(LIGHT.text2), 1.6 * unit))
    painter.drawLine(to_page(0.30, 0.17), to_page(0.30, 0.76))
    for y, turn in ((0.17, 1), (0.76, -1)):
        painter.drawLine(to_page(0.30, y), to_page(0.285, y + 0.025 * turn))
        painter.drawLine(to_page(0.30, y), to_page(0.315, y + 0.025 * turn))
    painter.setFont(font(15 * unit, SEMIBOLD))
    painter.setPen(QColor(LIGHT.text))
    words = _CAPTIONS[current_language()]
    _paint_caption(painter, to_page(0.28, 0.42), words[0], -1)
    _paint_caption(painter, to_page(0.28, 0.48), words[1], -1)
    painter.setFont(font(13 * unit, MEDIUM))
    painter.setPen(QColor(LIGHT.text2))
    _paint_caption(painter, to_page(0.62, 0.145), words[2], 1)
    _paint_caption(painter, to_page(0.62, 0.195), words[3], 1)
    _paint_caption(painter, to_page(0.33, 0.91), words[4], 0)
    _paint_caption(painter, to_page(0.64, 0.91), words[5], 0)


def _paint_caption(painter: QPainter, at: QPointF, words: str, side: int) -> None:
    """Draw words right (1) or left (-1) of a point, or centred (0)."""
    width = QFontMetricsF(painter.font()).horizontalAdvance(words)
    left = at.x() if side > 0 else at.x() - width if side < 0 else at.x() - width / 2
    painter.drawText(QPointF(left, at.y()), words)
