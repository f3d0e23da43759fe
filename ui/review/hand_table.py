"""The table of the fingers: one row each, range and ends of every joint, total, change."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QFont, QFontMetricsF, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from carpus.ui.figures import FINGERS, TOKENS
from carpus.ui.fonts import MEDIUM, REGULAR, SEMIBOLD, font
from carpus.ui.report.hand_rows import COLUMNS, FingerRow
from carpus.ui.theme import Theme

ROW_PX, HEAD_PX = 37, 26
EDGES = (0.0, 0.062, 0.178, 0.294, 0.406, 0.530, 0.672, 0.750, 0.832)
"""Left edge of the finger's name, the five figures, the share of the total, last time and the change, as shares."""
TIGHT_EDGES = (0.0, 0.078, 0.186, 0.296, 0.396, 0.508, 0.650, 0.750, 0.835)
"""The same for large text in a narrow window."""
TIGHT_BELOW_PX = 1000
SMALLEST_PX = 10


def fitting(face: QFont, text: str, room: float) -> QFont:
    """A smaller face where a text is too long for its place: a figure is rather small than cut."""
    size = face.pixelSize()
    while size > SMALLEST_PX and QFontMetricsF(face).horizontalAdvance(text) > room:
        size -= 1
        face = QFont(face)
        face.setPixelSize(size)
    return face


class HandTable(QWidget):
    """Paints the rows; what is too long for its column is smaller, and cut only where it would be unreadable."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._heads: tuple[str, ...] = ()
        self._rows: tuple[FingerRow, ...] = ()
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        theme.changed.connect(self.updateGeometry)

    def show_rows(self, heads: Sequence[str], rows: Sequence[FingerRow]) -> None:
        """Replace the table."""
        self._heads, self._rows = tuple(heads), tuple(rows)
        lines = [
            f"{row.name}: "
            + ", ".join(f"{cell.joint or head} {cell.main}" for head, cell in zip(heads, row.cells, strict=False))
            for row in rows
        ]
        self.setAccessibleName("; ".join(lines))
        self.updateGeometry()
        self.update()

    @property
    def rows(self) -> tuple[FingerRow, ...]:
        """What is shown."""
        return self._rows

    def sizeHint(self) -> QSize:
        return QSize(900, self._theme.px(HEAD_PX + ROW_PX * len(FINGERS)))

    def minimumSizeHint(self) -> QSize:
        return QSize(500, self.sizeHint().height())

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        scale, color = self._theme.text_scale, self._theme.color
        small = font(12 * scale, MEDIUM)
        for column, head in enumerate(self._heads, 1):
            token = TOKENS[COLUMNS[column - 1]] if column <= len(COLUMNS) - 1 else ""
            left = 0.0
            if token and COLUMNS[column - 1] != "spread":
                painter.setPen(Qt.PenStyle.NoPen)
                painter.setBrush(color(token))
                middle = HEAD_PX * scale / 2
                painter.drawRoundedRect(QRectF(self._edge(column), middle - 2, 12, 4), 2, 2)
                left = 18.0
            self._text(painter, head, column, 0.0, HEAD_PX * scale, small, "text2", left)
        top = HEAD_PX * scale
        for row in self._rows:
            painter.setPen(QPen(color("line"), 1))
            painter.drawLine(QPointF(0, round(top) + 0.5), QPointF(self.width(), round(top) + 0.5))
            self._paint_row(painter, row, top, ROW_PX * scale)
            top += ROW_PX * scale

    def _paint_row(self, painter: QPainter, row: FingerRow, top: float, height: float) -> None:
        scale = self._theme.text_scale
        body, strong, small = font(14 * scale, REGULAR), font(14 * scale, SEMIBOLD), font(12 * scale, REGULAR)
        self._text(painter, row.name, 0, top, height, font(14 * scale, MEDIUM), "text")
        upper, lower = top + 2 * scale, top + 0.5 * height
        for column, cell in enumerate(row.cells, 1):
            face, token = (strong, "text") if cell.small else (body, "text2")
            if cell.small:
                self._text(painter, cell.shown, column, upper, 0.5 * height, face, token)
                self._text(painter, cell.small, column, lower - scale, 0.45 * height, small, "text2")
            else:
                self._text(painter, cell.shown, column, top, height, face, token)
        if row.share.small:
            self._text(painter, row.share.main, 6, upper, 0.5 * height, strong, "text")
            self._text(painter, row.share.small, 6, lower - scale, 0.45 * height, small, "text2")
        self._text(painter, row.last, 7, top, height, body, "text")
        token = {"improved": "good", "worse": "bad"}.get(row.verdict, "text2")
        self._text(painter, row.change, 8, top, height, small, token)

    def _edge(self, column: int) -> float:
        return self._edges[column] * self.width()

    @property
    def _edges(self) -> tuple[float, ...]:
        return TIGHT_EDGES if self.width() < TIGHT_BELOW_PX * self._theme.text_scale else EDGES

    def _text(
        self, painter: QPainter, text: str, column: int, top: float, height: float, face: QFont, token: str,
        indent: float = 0.0,
    ) -> None:  # fmt: skip
        left = self._edge(column) + indent
        end = self._edge(column + 1) if column + 1 < len(EDGES) else float(self.width())
        if end == left - indent:
            return
        room = max(end - left - 6, 20.0)
        face = fitting(face, text, room)
        painter.setFont(face)
        painter.setPen(self._theme.color(token))
        shown = QFontMetricsF(face).elidedText(text, Qt.TextElideMode.ElideRight, room)
        painter.drawText(QRectF(left, top, room, height), int(Qt.AlignmentFlag.AlignVCenter), shown)
