"""Tools for painting a page of paper: everything in points from its upper left corner."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeVar

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QFontMetricsF, QPainter, QPen, QPicture

from carpus.ui.fonts import MEDIUM, REGULAR, SEMIBOLD, font
from carpus.ui.plot.style import PlotStyle, paper_style
from carpus.ui.theme import LIGHT

A4_PT = (595.28, 841.89)
DISPLAY_FROM_PT = 20.0
MARGIN_PT = 42.52
"""15 mm."""
LEAST_PT, LINE_PT = 5.0, 9.5
"""Of the words of a table: the smallest, and a line's height where they have several."""


T = TypeVar("T")
Place = tuple[float, float]
Cell = str | tuple[str, int, str]
"""Words of a table, with a weight and a colour of their own or without."""


@dataclass(frozen=True, slots=True)
class PageColumn:
    """Where a column of a table begins, as a share of the page's width, or ends (``ends``). What is wider than
    ``room``, a share too, is written smaller, or on several lines where it ``wraps``."""

    at: float
    weight: int = REGULAR
    ends: bool = False
    room: float = 1.0
    wraps: bool = False
    size_pt: float = 9.0
    token: str = "text"


@dataclass(slots=True)
class Page:
    """A painter with ``point`` painter units per point. Text methods return where the text ends."""

    painter: QPainter
    point: float
    number: str = ""
    """Which page of how many, in words, for its head; empty where that is not known."""
    is_trial: bool = False
    """Nobody sees it: plots, whose height is given, may be left out."""

    def __post_init__(self) -> None:
        self.painter.setRenderHint(QPainter.RenderHint.Antialiasing)

    @property
    def style(self) -> PlotStyle:
        return paper_style(self.point)

    @property
    def left(self) -> float:
        return MARGIN_PT

    @property
    def right(self) -> float:
        return A4_PT[0] - MARGIN_PT

    def box(self, left: float, top: float, width: float, height: float) -> QRectF:
        return QRectF(left * self.point, top * self.point, width * self.point, height * self.point)

    def at(self, x: float, y: float) -> QPointF:
        return QPointF(x * self.point, y * self.point)

    def face(self, size_pt: float, weight: int = REGULAR) -> QFont:
        """A font of a size in points."""
        return font(size_pt * self.point, weight, display=size_pt >= DISPLAY_FROM_PT)

    def width_of(self, text: str, size_pt: float, weight: int = REGULAR) -> float:
        """Width of a text in points."""
        return QFontMetricsF(self.face(size_pt, weight)).horizontalAdvance(text) / self.point

    def text(
        self, text: str, left: float, baseline: float, size_pt: float = 9.0, weight: int = REGULAR, token: str = "text"
    ) -> float:
        """One line; returns its right end."""
        self.painter.setFont(self.face(size_pt, weight))
        self.painter.setPen(QColor(getattr(LIGHT, token)))
        self.painter.drawText(self.at(left, baseline), text)
        return left + self.width_of(text, size_pt, weight)

    def text_right(
        self, text: str, right: float, baseline: float, size_pt: float = 9.0, weight: int = REGULAR, token: str = "text"
    ) -> None:
        """One line that ends at ``right``."""
        self.text(text, right - self.width_of(text, size_pt, weight), baseline, size_pt, weight, token)

    def paragraph(
        self,
        text: str,
        left: float,
        top: float,
        width: float,
        size_pt: float,
        weight: int = REGULAR,
        token: str = "text",
    ) -> float:
        """Wrapped text; returns its lower edge."""
        self.painter.setFont(self.face(size_pt, weight))
        self.painter.setPen(QColor(getattr(LIGHT, token)))
        metrics = QFontMetricsF(self.painter.font())
        leading = 1.45 * size_pt
        top_pt = top
        for line in self._lines(text, metrics, width * self.point):
            self.painter.drawText(self.at(left, top_pt + size_pt), line)
            top_pt += leading
        return top_pt

    def lines(self, text: str, width: float, size_pt: float, weight: int = REGULAR) -> list[str]:
        """A text as it is broken into lines of a width in points; a word that is wider than a line is broken too."""
        metrics = QFontMetricsF(self.face(size_pt, weight))
        found = []
        for line in self._lines(text, metrics, width * self.point):
            while len(line) > 1 and metrics.horizontalAdvance(line) > width * self.point:
                fits = len(line) - 1
                while fits > 1 and metrics.horizontalAdvance(line[:fits]) > width * self.point:
                    fits -= 1
                found.append(line[:fits])
                line = line[fits:]
            found.append(line)
        return found

    def _lines(self, text: str, metrics: QFontMetricsF, width: float) -> list[str]:
        lines, line = [], ""
        for word in text.split(" "):
            longer = f"{line} {word}" if line else word
            if line and metrics.horizontalAdvance(longer) > width:
                lines.append(line)
                line = word
            else:
                line = longer
        return [*lines, line]

    def fitting(self, text: str, room: float, size_pt: float, weight: int = REGULAR, least_pt: float = 6.0) -> float:
        """The size at which a line is no wider than ``room`` points; never below the least one."""
        while size_pt > least_pt and self.width_of(text, size_pt, weight) > room:
            size_pt -= 0.25
        return size_pt

    def said(self, text: str, top: float, size_pt: float = 9.0, weight: int = REGULAR, token: str = "text") -> float:
        """A paragraph as wide as the page; returns its lower edge."""
        return self.paragraph(text, self.left, top, self.right - self.left, size_pt, weight, token)

    def small_line(self, text: str, baseline: float, size_pt: float = 8.0) -> None:
        room = 0.99 * (self.right - self.left)
        size_pt *= min(1.0, room / max(self.width_of(text, size_pt), 1.0))
        self.text(text, self.left, baseline, size_pt, REGULAR, "text2")

    def table(
        self, columns: Sequence[PageColumn], rows: Sequence[Sequence[Cell]], top: float, *, heads: Sequence[str] = (),
        head_pt: float = 8.5, pitch_pt: float = 15.5, drop_pt: float = 4.5,
    ) -> float:  # fmt: skip
        """Heads, then rows with a line above and below each, ``drop_pt`` under their words; the lower edge."""
        y = top
        if heads:
            y = self._row(columns, [(head, MEDIUM, "text2") for head in heads], y + 8, head_pt) + drop_pt
        for cells in rows:
            self.rule(y)
            y = self._row(columns, cells, y + pitch_pt - drop_pt) + drop_pt
        self.rule(y)
        return y

    def _row(
        self, columns: Sequence[PageColumn], cells: Sequence[Cell], baseline: float, size_pt: float = 0.0
    ) -> float:
        """One row; returns its last baseline."""
        width, last = self.right - self.left, baseline
        for column, cell in zip(columns, cells, strict=True):
            text, weight, token = (cell, column.weight, column.token) if isinstance(cell, str) else cell
            edge, size = self.left + column.at * width, size_pt or column.size_pt
            if column.wraps and not size_pt:
                low = self.paragraph(text, edge, baseline - size, self.right - edge, size, weight, token)
                last = max(last, low - 0.45 * size)
                continue
            for number, line in enumerate(text.split("\n")):
                fits = self.fitting(line, column.room * width, size, weight, LEAST_PT)
                left = edge - self.width_of(line, fits, weight) if column.ends else edge
                self.text(line, left, baseline + LINE_PT * number, fits, weight, token)
                last = max(last, baseline + LINE_PT * number)
        return last

    def rule(self, y: float, left: float | None = None, right: float | None = None) -> None:
        self.line((self.left if left is None else left, y), (self.right if right is None else right, y))

    def line(self, start: Place, end: Place, token: str = "line", width: float = 0.6) -> None:
        self.painter.setPen(QPen(QColor(getattr(LIGHT, token)), width * self.point))
        self.painter.drawLine(self.at(*start), self.at(*end))

    def fill(self, left: float, top: float, width: float, height: float, token: str, radius: float = 6.0) -> None:
        """A rectangle of one colour with round corners."""
        self.painter.setPen(Qt.PenStyle.NoPen)
        self.painter.setBrush(QColor(getattr(LIGHT, token)))
        self.painter.drawRoundedRect(self.box(left, top, width, height), radius * self.point, radius * self.point)

    def card(self, left: float, top: float, width: float, height: float) -> None:
        self.painter.setPen(QPen(QColor(LIGHT.line), 0.8 * self.point))
        self.painter.setBrush(Qt.BrushStyle.NoBrush)
        self.painter.drawRoundedRect(self.box(left, top, width, height), 6 * self.point, 6 * self.point)

    def facts(self, pairs: Sequence[tuple[str, str]], top: float, shares: Sequence[float]) -> None:
        """Small names over values, side by side; what is too wide for its share moves the next ones to the right."""
        end = self.left
        for (name, value), share in zip(pairs, shares, strict=True):
            left = max(self.left + share * (self.right - self.left), end)
            named = self.text(name, left, top + 9, 8.5, REGULAR, "text2")
            end = max(named, self.text(value, left, top + 23, 10.0, MEDIUM)) + 8.0

    def title(self, text: str, baseline: float, aside: str = "") -> float:
        """Title of a section, with a small remark at the right or, where it is too long, below; returns how much lower
        that is."""
        end = self.text(text, self.left, baseline, 11.5, SEMIBOLD)
        if end + 12.0 + self.width_of(aside, 8.5) <= self.right:
            self.text_right(aside, self.right, baseline, 8.5, REGULAR, "text2")
            return 0.0
        return self.said(aside, baseline + 3.0, 8.5, REGULAR, "text2") - baseline - 3.0


def on_nothing(point: float, paint: Callable[[Page], T]) -> T:
    """What painting gives where nobody sees it."""
    nowhere = QPicture()
    with QPainter(nowhere) as painter:
        return paint(Page(painter, point, is_trial=True))


def painted_on_nothing(page: Page, paint: Callable[[Page], float]) -> float:
    """The lower edge that painting would have, in points."""
    return on_nothing(page.point, paint)


def paint_to_fit(page: Page, lowest_pt: float, paint: Callable[[Page], float]) -> None:
    """Paint something no lower than that, smaller and in the middle where it would go further."""
    share = min(1.0, lowest_pt / painted_on_nothing(page, paint))
    page.painter.save()
    page.painter.translate(0.5 * (1.0 - share) * A4_PT[0] * page.point, 0.0)
    page.painter.scale(share, share)
    paint(page)
    page.painter.restore()
