"""Cards to print, one page each: where the discs go, and how camera, arm and light are set up."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QMarginsF, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPageLayout, QPageSize, QPainter, QPdfWriter, QPen

from carpus.core.errors import OutputNotWritable
from carpus.ui.fonts import REGULAR, SEMIBOLD, font
from carpus.ui.help.drawings import DISC, DISC_MM, paint_camera, paint_discs
from carpus.ui.terms import LEGAL_SENTENCE
from carpus.ui.theme import LIGHT
from carpus.ui.translate import tr

FILE_NAME = "carpus-cards.pdf"
DPI = 300
MM = DPI / 25.4
PX = DPI / 96.0
"""A pixel of the design on paper."""
WIDTH_MM, HEIGHT_MM = 180.0, 267.0


def write_cards(path: Path) -> None:
    """Both cards, A4, two pages. Raises :class:`OutputNotWritable`."""
    try:
        path.touch()
    except OSError as cause:
        raise OutputNotWritable(path, cause.strerror or "") from cause
    writer = QPdfWriter(str(path))
    writer.setResolution(DPI)
    writer.setCreator("Carpus")
    writer.setTitle(tr("Carpus: discs and set-up"))
    page, upright = QPageSize(QPageSize.PageSizeId.A4), QPageLayout.Orientation.Portrait
    writer.setPageLayout(QPageLayout(page, upright, QMarginsF(15.0, 15.0, 15.0, 15.0), QPageLayout.Unit.Millimeter))
    painter = QPainter()
    if not painter.begin(writer):
        raise OutputNotWritable(path)
    try:
        _discs(painter)
        writer.newPage()
        _set_up(painter)
    finally:
        painter.end()


def _discs(painter: QPainter) -> None:
    y = _title(painter, tr("Where the discs go"), tr("Blue matt paper, 12 mm, on clean dry skin"))
    paint_discs(painter, QRectF(8 * MM, y, 164 * MM, 86 * MM), "right", whole_hand=False, unit=PX)
    y += 90 * MM
    lines = (
        tr("1. Wrist: middle of the back of the wrist, over the crease of the lifted hand."),
        tr("2. Thumb base: on the bony edge, a thumb's width from the wrist disc."),
        tr("3. Knuckles: on the back of the hand just behind each knuckle."),
        tr("Whole hand: also on the creases of every joint, and on the nails. Small fingers: 8 mm."),
    )
    y = _lines(painter, y, lines)
    paint_discs(painter, QRectF(8 * MM, y + 2 * MM, 116 * MM, 78 * MM), "right", whole_hand=True, unit=0.8 * PX)
    _rulers(painter, QPointF(132 * MM, y + 12 * MM))
    _lines(
        painter,
        y + 84 * MM,
        (
            tr("The left hand is the mirror image."),
            tr("Put them where they were last time. Never on wounds, dressings or fragile skin."),
            tr("Nothing else blue in the picture: no sleeve, pen, ring or nail."),
        ),
    )
    _foot(painter)


def _rulers(painter: QPainter, at: QPointF) -> None:
    """Discs in their true size, and a length to check the print by."""
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(QColor(DISC))
    for place, size_mm in enumerate((DISC_MM, 8.0)):
        radius = size_mm * MM / 2
        center = at + QPointF(10 * MM, (8 + 20 * place) * MM)
        painter.drawEllipse(center, radius, radius)
        painter.save()
        painter.setPen(QColor(LIGHT.text))
        painter.setFont(font(13 * PX, SEMIBOLD))
        painter.drawText(center + QPointF(10 * MM, 1.5 * MM), tr("{size} mm").format(size=f"{size_mm:.0f}"))
        painter.restore()
    painter.setPen(QPen(QColor(LIGHT.text), 1.2 * PX))
    left = at + QPointF(0, 46 * MM)
    painter.drawLine(left, left + QPointF(40 * MM, 0))
    for end_mm in (0, 40):
        painter.drawLine(left + QPointF(end_mm * MM, -2 * MM), left + QPointF(end_mm * MM, 2 * MM))
    painter.setFont(font(11 * PX, REGULAR))
    painter.drawText(left + QPointF(0, 7 * MM), tr("40 mm, if printed at 100 %"))


def _set_up(painter: QPainter) -> None:
    y = _title(painter, tr("Setting up"), tr("Camera, arm, light, picture"))
    paint_camera(painter, QRectF(8 * MM, y, 164 * MM, 112 * MM), PX)
    _lines(
        painter,
        y + 118 * MM,
        (
            tr("1. Camera 70 to 80 cm above the table, straight down, tied with a cord. Plug it straight in."),
            tr("2. No sun on the hand; even light from the ceiling; no shadow of the camera's arm."),
            tr("3. The forearm rests and stays still. A towel under it lets the hand bend down over the edge."),
            tr("4. Clear the table of everything blue. Roll up a blue sleeve."),
            tr("5. Choose the patient, Enter. Lay the hand flat and still, Space takes the picture."),
            tr("6. Click the discs in the order of the drawing; check the names of the whole hand."),
            tr("7. All checks green: Enter. Space records, Space stops and opens the review."),
            tr("Stop at pain of 5 or more, at 2 more than before, at numbness, swelling or dizziness."),
        ),
    )
    _foot(painter)


def _title(painter: QPainter, words: str, under: str) -> float:
    painter.setPen(QColor(LIGHT.text))
    painter.setFont(font(34 * PX, SEMIBOLD))
    painter.drawText(QPointF(0, 11 * MM), words)
    painter.setPen(QColor(LIGHT.text2))
    painter.setFont(font(18 * PX, REGULAR))
    painter.drawText(QPointF(0, 19 * MM), under)
    return 26 * MM


def _lines(painter: QPainter, y: float, lines: tuple[str, ...]) -> float:
    painter.setPen(QColor(LIGHT.text))
    painter.setFont(font(16 * PX, REGULAR))
    metrics = QFontMetricsF(painter.font())
    for words in lines:
        room = QRectF(0, y, WIDTH_MM * MM, 40 * MM)
        flags = int(Qt.TextFlag.TextWordWrap | Qt.AlignmentFlag.AlignLeft)
        painter.drawText(room, flags, words)
        y += metrics.boundingRect(room, flags, words).height() + 2.2 * MM
    return y


def _foot(painter: QPainter) -> None:
    painter.setPen(QColor(LIGHT.text2))
    painter.setFont(font(10 * PX, REGULAR))
    room = QRectF(0, (HEIGHT_MM - 12) * MM, WIDTH_MM * MM, 12 * MM)
    painter.drawText(room, int(Qt.TextFlag.TextWordWrap | Qt.AlignmentFlag.AlignBottom), LEGAL_SENTENCE)
