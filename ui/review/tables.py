"""The tables of the review: what movements and joints of fingers reach, and what is counted beside."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Generic, TypeVar

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QFont, QFontMetricsF, QPainter, QPaintEvent, QPen, QResizeEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from carpus.ui.figures import FINGERS, TOKENS
from carpus.ui.fonts import MEDIUM, REGULAR, SEMIBOLD, font
from carpus.ui.theme import Theme
from carpus.ui.words.fingers import COLUMNS, FingerRow
from carpus.ui.words.further import FurtherRow
from carpus.ui.words.ranges import TableRow

SMALLEST_PX = 10
LEFT, RIGHT = Qt.AlignmentFlag.AlignLeft, Qt.AlignmentFlag.AlignRight
VERDICT_TOKENS = {"improved": "good", "worse": "bad", "warn": "warn"}


Row = TypeVar("Row")


class _Table(QWidget, Generic[Row]):
    """Paints its rows; what is too long for its place is smaller, and cut only where it would be unreadable."""

    least_px = 500

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self.rows: tuple[Row, ...] = ()
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        theme.changed.connect(self.updateGeometry)

    def _show(self, rows: Sequence[Row], spoken: Sequence[str]) -> None:
        self.rows = tuple(rows)
        self.setAccessibleName("; ".join(spoken))
        self.updateGeometry()
        self.update()

    # --- for a subclass -----------------------------------------------------------------------------------
    def _height_px(self) -> float:
        """At usual text."""
        raise NotImplementedError

    def _paint(self, painter: QPainter) -> None:
        raise NotImplementedError

    @property
    def _wraps(self) -> bool:
        """Whether what is too long goes on in the next line, while there is room for it."""
        return False

    # --- what they share ----------------------------------------------------------------------------------
    def sizeHint(self) -> QSize:
        return QSize(900, self._theme.px(self._height_px()))

    def minimumSizeHint(self) -> QSize:
        return QSize(self.least_px, self.sizeHint().height())

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        self._paint(painter)

    def _face(self, size_px: float, weight: int) -> QFont:
        return font(size_px * self._theme.text_scale, weight)

    def _line(self, painter: QPainter, top: float, left: float = 0.0, right: float = 0.0) -> None:
        painter.setPen(QPen(self._theme.color("line"), 1))
        painter.drawLine(QPointF(left, round(top) + 0.5), QPointF(right or self.width(), round(top) + 0.5))

    def _bar(self, painter: QPainter, token: str, box: QRectF) -> None:
        """The colour of a curve."""
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(self._theme.color(token))
        reach = min(box.width(), box.height()) / 2
        painter.drawRoundedRect(box, reach, reach)

    def _write(
        self, painter: QPainter, text: str, box: QRectF, face: QFont, token: str, side: Qt.AlignmentFlag = LEFT
    ) -> None:
        flags, wraps = int(Qt.AlignmentFlag.AlignVCenter | side), self._wraps
        if wraps:
            flags |= Qt.TextFlag.TextWordWrap

        def fits() -> bool:
            metrics = QFontMetricsF(face)
            return (
                box.contains(metrics.boundingRect(box, flags, text))
                if wraps
                else (metrics.horizontalAdvance(text) <= box.width())
            )

        size = face.pixelSize()
        while size > SMALLEST_PX and not fits():
            size -= 1
            face = QFont(face)
            face.setPixelSize(size)
        painter.setFont(face)
        painter.setPen(self._theme.color(token))
        if not fits():
            text = QFontMetricsF(face).elidedText(text, Qt.TextElideMode.ElideRight, box.width())
        painter.drawText(box, flags, text)


class RangeTable(_Table[TableRow]):
    """A head, and one row per movement."""

    ROW_PX, HEAD_PX = 35, 30
    EDGES = (0.0, 0.170, 0.322, 0.424, 0.525, 0.628, 0.678)
    """Left edge of movement and today, right edge of the next four, left edge of the change, as shares of the width."""
    _head: TableRow | None = None

    def show_rows(self, head: TableRow, rows: Sequence[TableRow]) -> None:
        self._head = head
        self._show(rows, [f"{row.movement} {row.today} {row.change}".strip() for row in rows])

    def _height_px(self) -> float:
        return self.HEAD_PX + self.ROW_PX * max(1, len(self.rows))

    def _paint(self, painter: QPainter) -> None:
        if self._head is None:
            return
        top, height = self.HEAD_PX * self._theme.text_scale, self.ROW_PX * self._theme.text_scale
        self._paint_row(painter, self._head, 0.0, top, [self._face(12, MEDIUM)] * 7, ["text2"] * 7)
        faces = [self._face(14, MEDIUM), self._face(16, SEMIBOLD), *[self._face(14, REGULAR)] * 5]
        for row in self.rows:
            self._line(painter, top)
            change = VERDICT_TOKENS.get(row.verdict, "text2")
            self._paint_row(painter, row, top, height, faces, ["text"] * 4 + ["text2", "text", change])
            top += height

    def _paint_row(
        self, painter: QPainter, row: TableRow, top: float, height: float, faces: Sequence[QFont], tokens: Sequence[str]
    ) -> None:
        if row.token:
            self._bar(painter, row.token, QRectF(0, top + height / 2 - 7, 5, 14))
        texts = (row.movement, row.today, row.best, row.other_hand, row.usual, row.last, row.change)
        edges = [share * self.width() for share in (*self.EDGES, 1.0)]
        for column, text in enumerate(texts):
            left_sided = column in (0, 1, 6)
            edge = edges[column] + (16 if column == 0 else 0)
            room = (edges[column + 1] - edge - 8) if left_sided else (edge - edges[column - 1] - 8)
            width_px = QFontMetricsF(faces[column]).horizontalAdvance
            if column == 1:  # as much as the figure leaves that ends at the next edge
                taken = max(52 * self._theme.text_scale, QFontMetricsF(faces[2]).horizontalAdvance(texts[2]) + 14)
                room = edges[2] - taken - edge
            if column == 6 and row.short_change and width_px(text) > room:
                text = row.short_change  # with its limit, rather than without its end
            if row is self._head and width_px(text) > room:
                text = text.rpartition(", ")[2]
            room = max(room, 20.0)
            box = QRectF(edge if left_sided else edge - room, top, room, height)
            self._write(painter, text, box, faces[column], tokens[column], LEFT if left_sided else RIGHT)


class HandTable(_Table[FingerRow]):
    """One row for each finger: range and ends of every joint, total, change."""

    ROW_PX, HEAD_PX, TIGHT_ROW_PX, TIGHT_HEAD_PX = 37, 26, 64, 32
    EDGES = (0.0, 0.062, 0.178, 0.294, 0.406, 0.530, 0.672, 0.750, 0.832, 1.0)
    """Left edge of the finger's name, the five figures, the share of the total, last time and the change, as shares."""
    TIGHT_EDGES = (0.0, 0.104, 0.202, 0.300, 0.411, 0.513, 0.627, 0.729, 0.827, 1.0)
    """The same for large text in a narrow window, where words go on in the next line."""
    TIGHT_BELOW_PX = 1000
    _heads: Sequence[str] = ()

    def show_rows(self, heads: Sequence[str], rows: Sequence[FingerRow]) -> None:
        self._heads = tuple(heads)
        spoken = []
        for row in rows:
            cells = zip(heads, row.cells, strict=False)
            spoken.append(f"{row.name}: " + ", ".join(f"{cell.joint or head} {cell.main}" for head, cell in cells))
        self._show(rows, spoken)

    def _height_px(self) -> float:
        head, row = self._heights_px()
        return head + row * len(FINGERS)

    @property
    def _wraps(self) -> bool:
        return self.width() < self.TIGHT_BELOW_PX * self._theme.text_scale

    def _heights_px(self) -> tuple[int, int]:
        return (self.TIGHT_HEAD_PX, self.TIGHT_ROW_PX) if self._wraps else (self.HEAD_PX, self.ROW_PX)

    def resizeEvent(self, event: QResizeEvent) -> None:
        self.updateGeometry()

    def _paint(self, painter: QPainter) -> None:
        top, height = (self._theme.text_scale * px for px in self._heights_px())
        for column, head in enumerate(self._heads, 1):
            box = self._box(column, 0.0, top)
            if column < len(COLUMNS) and COLUMNS[column - 1] != "spread":
                self._bar(painter, TOKENS[COLUMNS[column - 1]], QRectF(box.left(), top / 2 - 2, 12, 4))
                box.setLeft(box.left() + 18.0)
            self._write(painter, head, box, self._face(12, MEDIUM), "text2")
        for row in self.rows:
            self._line(painter, top)
            self._paint_row(painter, row, top, height)
            top += height

    def _paint_row(self, painter: QPainter, row: FingerRow, top: float, height: float) -> None:
        body, small = self._face(14, REGULAR), self._face(12, REGULAR)
        self._write(painter, row.name, self._box(0, top, height), self._face(14, MEDIUM), "text")
        parts = [(cell.shown, cell.small) for cell in row.cells]
        parts += [(row.share.main if row.share.small else "", row.share.small)]
        for column, (shown, below) in enumerate(parts, 1):
            if below:
                scale = self._theme.text_scale
                upper, lower = top + 2 * scale, top + 0.5 * height - scale
                self._write(painter, shown, self._box(column, upper, 0.5 * height), self._face(14, SEMIBOLD), "text")
                self._write(painter, below, self._box(column, lower, 0.45 * height), small, "text2")
            else:
                self._write(painter, shown, self._box(column, top, height), body, "text2")
        self._write(painter, row.last, self._box(7, top, height), body, "text")
        token = VERDICT_TOKENS.get(row.verdict, "text2")
        self._write(painter, row.change, self._box(8, top, height), small, token)

    def _box(self, column: int, top: float, height: float) -> QRectF:
        edges = self.TIGHT_EDGES if self._wraps else self.EDGES
        left, end = (share * self.width() for share in edges[column : column + 2])
        return QRectF(left, top, max(end - left - 6, 20.0), height)


class FurtherTable(_Table[FurtherRow]):
    """What an exercise has beside its ranges: name, today's value, last time's; two to a line, or one where the text is
    large."""

    ROW_PX, HEAD_PX = 28, 30
    TWO_FROM_PX = 900
    """Width, at usual text, from which two figures stand side by side."""
    NAME_SHARE, TODAY_SHARE = 0.50, 0.30
    BETWEEN_PX = 32
    least_px = 420
    _title = _day = ""

    def show_rows(self, title: str, day: str, rows: Sequence[FurtherRow]) -> None:
        """Replace the figures; ``day`` is when the last ones were taken, empty for none."""
        self._title, self._day = title, day
        self._show(rows, [f"{row.name} {row.today}" for row in rows])
        self.setVisible(bool(rows))

    @property
    def _columns(self) -> int:
        return 2 if self.width() >= self.TWO_FROM_PX * self._theme.text_scale else 1

    def _height_px(self) -> float:
        return self.HEAD_PX + self.ROW_PX * -(-len(self.rows) // self._columns) + 6

    def resizeEvent(self, event: QResizeEvent) -> None:
        if event.size().width() != event.oldSize().width():
            self.updateGeometry()

    def _paint(self, painter: QPainter) -> None:
        scale, columns = self._theme.text_scale, self._columns
        width = (self.width() - self.BETWEEN_PX * (columns - 1)) / columns
        head, height = self.HEAD_PX * scale, self.ROW_PX * scale
        self._write(painter, self._title, QRectF(0, 0, self.width(), head), self._face(14, SEMIBOLD), "text")
        for column in range(min(columns, len(self.rows))):
            box = QRectF(column * (width + self.BETWEEN_PX), 0, width, head)
            self._write(painter, self._day, box, self._face(12, MEDIUM), "text2", RIGHT)
        for place, row in enumerate(self.rows):
            left = (place % columns) * (width + self.BETWEEN_PX)
            top = head + height * (place // columns)
            self._line(painter, top, left, left + width)
            name = QRectF(left, top, self.NAME_SHARE * width - 8, height)
            share = self.TODAY_SHARE if row.last else 1 - self.NAME_SHARE  # words may take the place of last time's
            today = QRectF(left + self.NAME_SHARE * width, top, share * width, height)
            last = QRectF(today.right(), top, left + width - today.right(), height)
            self._write(painter, row.name, name, self._face(14, REGULAR), "text2")
            self._write(painter, row.today, today, self._face(14, SEMIBOLD), "text")
            self._write(painter, row.last, last, self._face(14, REGULAR), "text", RIGHT)
