"""What an exercise has beside its ranges, two figures to a line, or one where the text is large."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QFontMetricsF, QPainter, QPaintEvent, QPen, QResizeEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from carpus.ui.fonts import MEDIUM, REGULAR, SEMIBOLD, font
from carpus.ui.report.further_rows import FurtherRow
from carpus.ui.theme import Theme

ROW_PX, HEAD_PX = 28, 30
TWO_FROM_PX = 900
"""Width, at usual text, from which two figures stand side by side."""
NAME_SHARE, TODAY_SHARE = 0.50, 0.30
BETWEEN_PX = 32


class FurtherTable(QWidget):
    """Name, today's value, last time's."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._title = self._day = ""
        self._rows: tuple[FurtherRow, ...] = ()
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        theme.changed.connect(self.updateGeometry)

    def show_rows(self, title: str, day: str, rows: Sequence[FurtherRow]) -> None:
        """Replace the figures; ``day`` is when the last ones were taken, empty for none."""
        self._title, self._day, self._rows = title, day, tuple(rows)
        self.setAccessibleName("; ".join(f"{row.name} {row.today}" for row in rows))
        self.setVisible(bool(rows))
        self.updateGeometry()
        self.update()

    @property
    def rows(self) -> tuple[FurtherRow, ...]:
        """What is shown."""
        return self._rows

    @property
    def _columns(self) -> int:
        return 2 if self.width() >= TWO_FROM_PX * self._theme.text_scale else 1

    def sizeHint(self) -> QSize:
        lines = -(-len(self._rows) // self._columns)
        return QSize(900, self._theme.px(HEAD_PX + ROW_PX * lines + 6))

    def minimumSizeHint(self) -> QSize:
        return QSize(420, self.sizeHint().height())

    def resizeEvent(self, event: QResizeEvent) -> None:
        if event.size().width() != event.oldSize().width():
            self.updateGeometry()

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        scale, color = self._theme.text_scale, self._theme.color
        columns = self._columns
        width = (self.width() - BETWEEN_PX * (columns - 1)) / columns
        painter.setFont(font(14 * scale, SEMIBOLD))
        painter.setPen(color("text"))
        head = QRectF(0, 0, self.width(), HEAD_PX * scale)
        painter.drawText(head, int(Qt.AlignmentFlag.AlignVCenter), self._title)
        painter.setFont(font(12 * scale, MEDIUM))
        painter.setPen(color("text2"))
        for column in range(columns if self._day else 0):
            box = QRectF(column * (width + BETWEEN_PX), 0, width, HEAD_PX * scale)
            painter.drawText(box, int(Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignRight), self._day)
        for place, row in enumerate(self._rows):
            left = (place % columns) * (width + BETWEEN_PX)
            top = (HEAD_PX + ROW_PX * (place // columns)) * scale
            painter.setPen(QPen(color("line"), 1))
            painter.drawLine(QPointF(left, round(top) + 0.5), QPointF(left + width, round(top) + 0.5))
            self._text(painter, row.name, QRectF(left, top, NAME_SHARE * width - 8, ROW_PX * scale), REGULAR, "text2")
            today = QRectF(left + NAME_SHARE * width, top, TODAY_SHARE * width, ROW_PX * scale)
            self._text(painter, row.today, today, SEMIBOLD, "text")
            last = QRectF(today.right(), top, width - (NAME_SHARE + TODAY_SHARE) * width, ROW_PX * scale)
            self._text(painter, row.last, last, REGULAR, "text", Qt.AlignmentFlag.AlignRight)

    def _text(
        self, painter: QPainter, text: str, box: QRectF, weight: int, token: str,
        side: Qt.AlignmentFlag = Qt.AlignmentFlag.AlignLeft,
    ) -> None:  # fmt: skip
        """Smaller where it is too long: a figure is never cut."""
        size = 14.0 * self._theme.text_scale
        while size > 9.0 and QFontMetricsF(font(size, weight)).horizontalAdvance(text) > box.width():
            size -= 0.5
        painter.setFont(font(size, weight))
        painter.setPen(self._theme.color(token))
        painter.drawText(box, int(Qt.AlignmentFlag.AlignVCenter | side), text)
