"""Printable cards: marker positions, and set-up of camera, arm and light."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QBuffer, QByteArray, QIODevice, QMarginsF, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QFontMetricsF, QPageLayout, QPageSize, QPainter, QPdfWriter, QPen

from carpus.core.formats.output_files import open_new_file
from carpus.core.model.hand.protocols import PALM_MARKERS, SITES
from carpus.core.model.rounding import format_rounded
from carpus.core.model.types import Side
from carpus.ui.kit.fonts import MEDIUM, REGULAR, SEMIBOLD, font
from carpus.ui.kit.theme import LIGHT
from carpus.ui.kit.translate import tr
from carpus.ui.picture.hand_drawing import MARKER_POSITIONS, SIZE, hand_outline, placement
from carpus.ui.words.marker_words import marker_title
from carpus.ui.words.terms import LEGAL_SENTENCE

FILE_NAME = "carpus-cards.pdf"
DPI = 300
MM = DPI / 25.4
PX = DPI / 96.0
"""A design pixel on paper."""
WIDTH_MM, HEIGHT_MM = 180.0, 267.0


def write_cards(path: Path) -> None:
    """Write both cards as a PDF of two A4 pages.

    Raises :class:`DiskFull` or :class:`OutputNotWritable`; then an old file stays.
    """
    store = QByteArray()
    buffer = QBuffer(store)
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    writer = QPdfWriter(buffer)
    writer.setResolution(DPI)
    writer.setCreator("Carpus")
    writer.setTitle(tr("Carpus: markers and set-up"))
    page, upright = QPageSize(QPageSize.PageSizeId.A4), QPageLayout.Orientation.Portrait
    writer.setPageLayout(QPageLayout(page, upright, QMarginsF(15.0, 15.0, 15.0, 15.0), QPageLayout.Unit.Millimeter))
    painter = QPainter(writer)
    try:
        _paint_marker_card(painter)
        writer.newPage()
        _paint_setup_card(painter)
    finally:
        painter.end()
    buffer.close()
    with open_new_file(path, overwrite=True) as file:
        file.write(store.data())


def _paint_marker_card(painter: QPainter) -> None:
    y = _paint_title(painter, tr("Where the markers go"), tr("Blue matt paper, 12 mm, on clean dry skin"))
    paint_marker_map(painter, QRectF(8 * MM, y, 164 * MM, 86 * MM), "right", whole_hand=False, unit=PX)
    y += 90 * MM
    lines = (
        tr("1. Wrist: middle of the dorsal side, over the crease of the extended wrist."),
        tr("2. Thumb base (CMC): on the bony edge, one thumb’s width from the wrist marker."),
        tr("3. MCP joints: on the back of the hand, just proximal to each MCP joint."),
        tr("Whole hand: also over the crease of each finger joint and on the nails. Small fingers: 8 mm."),
    )
    y = _paint_lines(painter, y, lines)
    paint_marker_map(painter, QRectF(8 * MM, y + 2 * MM, 116 * MM, 78 * MM), "right", whole_hand=True, unit=0.8 * PX)
    _paint_rulers(painter, QPointF(132 * MM, y + 12 * MM))
    _paint_lines(
        painter,
        y + 84 * MM,
        (
            tr("The left hand is the mirror image."),
            tr("Place them where they were last time, never on wounds, dressings or fragile skin."),
            tr("Keep everything else blue out of view: sleeves, pens, rings, nails."),
        ),
    )
    _paint_footer(painter)


def _paint_rulers(painter: QPainter, at: QPointF) -> None:
    """Draw markers in true size and a length to check the print."""
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(QColor(MARKER_COLOR))
    for place, size_mm in enumerate((MARKER_MM, 8.0)):
        radius = size_mm * MM / 2
        center = at + QPointF(10 * MM, (8 + 20 * place) * MM)
        painter.drawEllipse(center, radius, radius)
        painter.save()
        painter.setPen(QColor(LIGHT.text))
        painter.setFont(font(13 * PX, SEMIBOLD))
        painter.drawText(center + QPointF(10 * MM, 1.5 * MM), tr("{size} mm").format(size=format_rounded(size_mm)))
        painter.restore()
    painter.setPen(QPen(QColor(LIGHT.text), 1.2 * PX))
    left = at + QPointF(0, 46 * MM)
    painter.drawLine(left, left + QPointF(40 * MM, 0))
    for end_mm in (0, 40):
        painter.drawLine(left + QPointF(end_mm * MM, -2 * MM), left + QPointF(end_mm * MM, 2 * MM))
    painter.setFont(font(11 * PX, REGULAR))
    painter.drawText(left + QPointF(0, 7 * MM), tr("40 mm, if printed at 100 %"))


def _paint_setup_card(painter: QPainter) -> None:
    y = _paint_title(painter, tr("Setting up"), tr("Camera, arm, light, image"))
    paint_camera_setup(painter, QRectF(8 * MM, y, 164 * MM, 112 * MM), PX)
    _paint_lines(
        painter,
        y + 118 * MM,
        (
            tr(
                "1. Camera 70 to 80 cm above the table, pointing straight down, secured with a cord and "
                "connected directly."
            ),
            tr("2. Even light from the ceiling. No sun and no shadow of the camera arm on the hand."),
            tr("3. The forearm rests and stays still. A towel under it lets the wrist flex over the edge."),
            tr("4. Remove everything blue from the table. Roll up blue sleeves."),
            tr("5. Choose the patient and press Enter. Lay the hand flat and still and press Space."),
            tr("6. Click the markers in the order of the drawing. For the whole hand, check the labels."),
            tr(
                "7. When all checks are green, press Enter. Space starts the recording, and ends it and opens "
                "the review."
            ),
            tr("Stop at pain of 5 or more, at 2 more than before, at numbness, swelling or dizziness."),
        ),
    )
    _paint_footer(painter)


def _paint_title(painter: QPainter, words: str, under: str) -> float:
    painter.setPen(QColor(LIGHT.text))
    painter.setFont(font(34 * PX, SEMIBOLD))
    painter.drawText(QPointF(0, 11 * MM), words)
    painter.setPen(QColor(LIGHT.text2))
    painter.setFont(font(18 * PX, REGULAR))
    painter.drawText(QPointF(0, 19 * MM), under)
    return 26 * MM


def _paint_lines(painter: QPainter, y: float, lines: tuple[str, ...]) -> float:
    painter.setPen(QColor(LIGHT.text))
    painter.setFont(font(16 * PX, REGULAR))
    metrics = QFontMetricsF(painter.font())
    for words in lines:
        room = QRectF(0, y, WIDTH_MM * MM, 40 * MM)
        flags = int(Qt.TextFlag.TextWordWrap | Qt.AlignmentFlag.AlignLeft)
        painter.drawText(room, flags, words)
        y += metrics.boundingRect(room, flags, words).height() + 2.2 * MM
    return y


def _paint_footer(painter: QPainter) -> None:
    painter.setPen(QColor(LIGHT.text2))
    painter.setFont(font(10 * PX, REGULAR))
    room = QRectF(0, (HEIGHT_MM - 12) * MM, WIDTH_MM * MM, 12 * MM)
    painter.drawText(room, int(Qt.TextFlag.TextWordWrap | Qt.AlignmentFlag.AlignBottom), LEGAL_SENTENCE)


MARKER_COLOR = "#2B4FB0"
MARKER_MM, HAND_MM = 12.0, 190.0
_LABELS = {
    "WRIST": (1, 0.35), "CMC1": (-1, 0.05), "MCP2": (-1, -0.28), "MCP3": (1, -0.52), "MCP4": (1, -0.52),
    "MCP5": (1, -0.28),
}  # fmt: skip
"""Side of a label, and its height from the middle of the hand in halves of the drawing."""


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
    named = dict.fromkeys(PALM_MARKERS, "")
    if whole_hand:
        named = {
            "WRIST": "",
            "CMC1": "",
            "MCP5": "",
            "PIP5": "",
            "DIP5": "",
            "TIP5": "",
            "MCP1": "",
            "IP1": "",
            "TIP1": "",
        }
    sign = 1.0 if side == "right" else -1.0
    text = font(14 * unit, SEMIBOLD)
    rows: dict[int, list[tuple[float, str, QPointF]]] = {-1: [], 1: []}
    for name in named:
        at = to.map(QPointF(*MARKER_POSITIONS[name]))
        where = _LABELS.get(name, (1 if name[-1] == "5" else -1, 0.0))[0]
        if whole_hand and name == "CMC1":
            where = -1
        rows[int(where * sign)].append((at.y(), marker_title(name), at))
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
    _paint_caption(painter, to_page(0.28, 0.42), tr("70 to 80 cm,"), -1)
    _paint_caption(painter, to_page(0.28, 0.48), tr("at least 60 cm"), -1)
    painter.setFont(font(13 * unit, MEDIUM))
    painter.setPen(QColor(LIGHT.text2))
    _paint_caption(painter, to_page(0.62, 0.145), tr("camera, straight down"), 1)
    _paint_caption(painter, to_page(0.62, 0.195), tr("safety cord"), 1)
    _paint_caption(painter, to_page(0.33, 0.91), tr("forearm rests, still"), 0)
    _paint_caption(painter, to_page(0.64, 0.91), tr("plain table, nothing blue"), 0)


def _paint_caption(painter: QPainter, at: QPointF, words: str, side: int) -> None:
    """Draw words right (1) or left (-1) of a point, or centred (0)."""
    width = QFontMetricsF(painter.font()).horizontalAdvance(words)
    left = at.x() if side > 0 else at.x() - width if side < 0 else at.x() - width / 2
    painter.drawText(QPointF(left, at.y()), words)
