"""The range-of-motion card: header with n, buttons, one row per movement."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QFont, QFontMetricsF, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from carpus.ui.fonts import MEDIUM, REGULAR, SEMIBOLD, font
from carpus.ui.report.tables import TableRow
from carpus.ui.review.hand_table import fitting
from carpus.ui.theme import Theme

ROW_PX, HEAD_PX = 35, 30
COLUMNS = (0.0, 0.170, 0.322, 0.424, 0.525, 0.628, 0.678)
"""Left edge of movement and today, right edge of the next four, left edge of the change, as shares of the width."""


class RangeTable(QWidget):
    """Paints rows; the text under the mouse is the tooltip when it had to be cut."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._head: TableRow | None = None
        self._rows: tuple[TableRow, ...] = ()
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        theme.changed.connect(self.updateGeometry)

    def show_rows(self, head: TableRow, rows: Sequence[TableRow]) -> None:
        """Replace the table."""
        self._head, self._rows = head, tuple(rows)
        spoken = "; ".join(f"{row.movement} {row.today} {row.change}".strip() for row in rows)
        self.setAccessibleName(spoken)
        self.setToolTip("")
        self.updateGeometry()
        self.update()

    @property
    def rows(self) -> tuple[TableRow, ...]:
        """What is shown."""
        return self._rows

    def sizeHint(self) -> QSize:
        return QSize(900, self._theme.px(HEAD_PX + ROW_PX * max(1, len(self._rows))))

    def minimumSizeHint(self) -> QSize:
        return QSize(500, self.sizeHint().height())

    def paintEvent(self, event: QPaintEvent) -> None:
        if self._head is None:
            return
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        scale = self._theme.text_scale
        small = font(12 * scale, MEDIUM)
        self._paint_row(painter, self._head, 0.0, HEAD_PX * scale, [small] * 7, ["text2"] * 7)
        top = HEAD_PX * scale
        body, strong = font(14 * scale, REGULAR), font(16 * scale, SEMIBOLD)
        faces = [font(14 * scale, MEDIUM), strong, body, body, body, body, body]
        for row in self._rows:
            painter.setPen(QPen(self._theme.color("line"), 1))
            painter.drawLine(QPointF(0, round(top) + 0.5), QPointF(self.width(), round(top) + 0.5))
            change = {"improved": "good", "worse": "bad", "warn": "warn"}.get(row.verdict, "text2")
            self._paint_row(
                painter, row, top, ROW_PX * scale, faces, ["text", "text", "text", "text", "text2", "text", change]
            )
            top += ROW_PX * scale

    def _paint_row(
        self, painter: QPainter, row: TableRow, top: float, height: float, faces: Sequence[QFont], tokens: Sequence[str]
    ) -> None:
        width = self.width()
        if row.token:
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(self._theme.color(row.token))
            painter.drawRoundedRect(QRectF(0, top + height / 2 - 7, 5, 14), 2.5, 2.5)
        texts = (row.movement, row.today, row.best, row.other_hand, row.usual, row.last, row.change)
        for column, text in enumerate(texts):
            left_sided = column in (0, 1, 6)
            edge = COLUMNS[column] * width + (16 if column == 0 else 0)
            following = COLUMNS[column + 1] * width if column < 6 else width
            room = (following - edge - 8) if left_sided else (edge - COLUMNS[column - 1] * width - 8)
            if column == 1:  # as much as the figure leaves that ends at the next edge
                taken = max(52 * self._theme.text_scale, QFontMetricsF(faces[2]).horizontalAdvance(texts[2]) + 14)
                room = COLUMNS[2] * width - taken - edge
            box = QRectF(edge, top, room, height) if left_sided else QRectF(edge - room, top, room, height)
            if column == 6 and row.short_change and QFontMetricsF(faces[6]).horizontalAdvance(text) > room:
                text = row.short_change  # with its limit, rather than without its end
            if row is self._head and QFontMetricsF(faces[column]).horizontalAdvance(text) > room:
                text = text.rpartition(", ")[2]
            face = fitting(faces[column], text, max(room, 20.0))
            painter.setFont(face)
            painter.setPen(self._theme.color(tokens[column]))
            shown = QFontMetricsF(face).elidedText(text, Qt.TextElideMode.ElideRight, max(room, 20.0))
            side = Qt.AlignmentFlag.AlignLeft if left_sided else Qt.AlignmentFlag.AlignRight
            painter.drawText(box, int(Qt.AlignmentFlag.AlignVCenter | side), shown)
