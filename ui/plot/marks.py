"""What a plot is made of: curve, band, target, repetition, cursor, dot. Each knows its values and how it is drawn.

A mark draws by any painter in any unit: in a view box of the window, on the printed page, into a picture or an SVG.
There is one of each, so that screen and paper cannot differ.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from PySide6.QtCore import QObject, QPointF, QRectF, Qt
from PySide6.QtGui import QFont, QFontMetricsF, QPaintDevice, QPainter, QPen

from carpus.core.results.repetition_rows import ShownRepetition
from carpus.ui.plot import axes
from carpus.ui.plot.axes import Panel
from carpus.ui.plot.series import Curve, Drawing
from carpus.ui.plot.style import PlotStyle, dashed, write
from carpus.ui.translate import tr

NUMBERS_ABOVE = 10.0
"""Design pixels between the numbers of repetitions and their panel."""


def repetition_words(number: int, repetition: ShownRepetition) -> str:
    """What stands at a repetition: its number, and why where it does not count."""
    if repetition.helped:
        return tr("{number} passive").format(number=number)
    return str(number) if repetition.counts else tr("{number} out").format(number=number)


class Mark(Protocol):
    """Anything that can be drawn into a panel."""

    def paint(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        """Draw it, in the painter's unit."""


@dataclass(frozen=True, slots=True)
class Scales:
    """Grid lines and the words left of them."""

    def paint(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        end_values = {max(panel.scale.ticks), min(panel.scale.ticks)}
        for value in panel.scale.ticks:
            y = float(panel.y(value))
            y = round(y) + 0.5 if style.unit == 1.0 else y
            painter.setPen(QPen(style.color("border" if value == 0.0 else "line"), style.grid_width))
            painter.drawLine(QPointF(panel.box.left(), y), QPointF(panel.box.right(), y))
        metrics = QFontMetricsF(style.label)
        height, least = metrics.height(), metrics.capHeight() + 5 * style.unit
        taken: list[float] = []
        # The ends first: where a panel is low, one between them gives way.
        for value, text in sorted(panel.scale.labels, key=lambda label: label[0] not in end_values):
            middle = float(panel.y(value))
            if value not in end_values and any(abs(middle - other) < least for other in taken):
                continue
            taken.append(middle)
            strong = panel.scale.strong_ends and value in end_values and value != 0.0
            painter.setFont(style.end_label if strong else style.label)
            painter.setPen(style.color("text" if strong else "text2"))
            right = panel.box.left() - 12 * style.unit
            box = QRectF(right - 300 * style.unit, middle - height / 2, 300 * style.unit, height)
            if _is_widget(painter.device()) and right > 0.0:  # a word that is longer than its room gets smaller
                painter.setFont(fitted(painter.font(), text, right - 2.0))
            painter.drawText(box, int(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter), text)


def fitted(face: QFont, text: str, room_px: float) -> QFont:
    """The font, or one as small as half of it, with which a text has room."""
    width = QFontMetricsF(face).horizontalAdvance(text)
    if width <= room_px or width <= 0.0:
        return face
    smaller = QFont(face)
    smaller.setPixelSize(max(int(face.pixelSize() * room_px / width), face.pixelSize() // 2, 1))
    return smaller


def room_at(painter: QPainter, left: float) -> float:
    """What is left of a widget right of a place; all there may be elsewhere, as on paper."""
    device = painter.device()
    return device.width() - left - 3.0 if _is_widget(device) else math.inf


@dataclass(frozen=True, slots=True)
class Times:
    """Words under the panel at times (s, text) it shows, ``below`` design pixels under it: the last ones first, and one
    that would touch another is left out. Of ``days`` the first comes second, and both ends are strong."""

    labels: Sequence[tuple[float, str]]
    below: float = 6.0
    days: bool = False

    def paint(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        face = style.end_label if self.days else style.label
        painter.setFont(face)
        metrics = QFontMetricsF(face)
        gap = metrics.height()  # a blank would make one label of two
        baseline = panel.box.bottom() + self.below * style.unit + metrics.ascent()
        taken: list[tuple[float, float]] = []
        shown = [label for label in self.labels if panel.start_s <= label[0] <= panel.end_s]
        ends = [shown[-1], shown[0]] if self.days and shown else []
        for time_s, text in [*ends, *reversed(shown)]:
            width = metrics.horizontalAdvance(text)
            left = float(panel.x(time_s)) - width / 2
            if all(left > right + gap or left + width < other - gap for other, right in taken):
                painter.setPen(style.color("text" if len(taken) < len(ends) else "text2"))
                taken.append((left, left + width))
                painter.drawText(QPointF(left, baseline), text)


@dataclass(frozen=True, slots=True)
class StayWithin:
    """The band about zero in which a trick movement should stay."""

    limit: float
    words: str

    def paint(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        top, bottom = float(panel.y(self.limit)), float(panel.y(-self.limit))
        painter.fillRect(QRectF(panel.box.left(), top, panel.box.width(), bottom - top), style.color("norm"))
        if top - QFontMetricsF(style.end_label).height() >= panel.box.top():  # a low panel has the band alone
            _note(painter, style, panel, top, self.words, "text2")


@dataclass(frozen=True, slots=True)
class Target:
    """A dashed line in the accent with its words."""

    value: float
    words: str = ""
    is_below: bool = False
    """Where its words stand."""

    def paint(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        y = float(panel.y(self.value))
        pen = dashed(style.color("accent"), 1.5 * style.grid_width, (6, 4))
        pen.setCapStyle(Qt.PenCapStyle.FlatCap)
        painter.setPen(pen)
        painter.drawLine(QPointF(panel.box.left(), y), QPointF(panel.box.right(), y))
        self.paint_words(painter, style, panel)

    def paint_words(self, painter: QPainter, style: PlotStyle, panel: Panel, ground: str = "") -> None:
        """The words alone; on a ``ground`` over what else is drawn."""
        y, height = float(panel.y(self.value)), QFontMetricsF(style.end_label).height()
        if self.words:
            bottom = y + height + 4 * style.unit if self.is_below else y
            _note(painter, style, panel, bottom, self.words, "accent", ground)


@dataclass(frozen=True, slots=True)
class Remark:
    """Small words at the left end just above a value."""

    value: float
    words: str

    def paint(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        at = QPointF(panel.box.left() + 6 * style.unit, float(panel.y(self.value)) - 5)
        write(painter, at, self.words, style.label, style.color("text2"))


@dataclass(frozen=True, slots=True)
class Hatch:
    """A stretch of time in which nothing is known."""

    start_s: float
    end_s: float

    def paint(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        left = max(float(panel.x(self.start_s)), panel.box.left())
        right = min(float(panel.x(self.end_s)), panel.box.right())
        if right > left:
            axes.hatch(painter, style, QRectF(left, panel.box.top(), right - left, panel.box.height()))


@dataclass(frozen=True, slots=True)
class Curves:
    """All curves of a panel: numbers beyond the scale cover none of each other, a gap of several is hatched once."""

    curves: Sequence[Curve]

    def paint(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        DrawnCurves(Drawing(style, [(panel, self.curves)]), 0).paint(painter, style, panel)


@dataclass(frozen=True, slots=True)
class DrawnCurves:
    """The same of one of many panels, of which the curves are worked out at once."""

    drawing: Drawing
    number: int

    def paint(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        painter.save()
        painter.setClipRect(panel.box.adjusted(0, -2, 0, 2).toAlignedRect(), Qt.ClipOperation.IntersectClip)
        self.drawing.paint(painter, style, self.number)
        painter.restore()


def paint_dot(painter: QPainter, style: PlotStyle, at: QPointF, token: str, radius: float) -> None:
    """A disc with a seam, ``radius`` design pixels."""
    painter.setPen(QPen(style.color("surface"), 1.5 * style.unit))
    painter.setBrush(style.color(token))
    painter.drawEllipse(at, radius * style.unit, radius * style.unit)


@dataclass(frozen=True, slots=True)
class Dot:
    """One value, such as the newest or the one under the cursor."""

    time_s: float
    value: float
    token: str

    def paint(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        if math.isfinite(self.value):
            paint_dot(painter, style, panel.at(self.time_s, self.value), self.token, 5.0)


@dataclass(frozen=True, slots=True)
class Name:
    """What a panel is called, at its left; ``above`` beside its upper end."""

    words: str
    above: bool = False

    def paint(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        scale = style.end_label.pixelSize() / 12.0
        left = panel.box.left() - 102 * scale
        middle = panel.box.top() + 6 * scale if self.above else panel.box.center().y()
        box = QRectF(left, middle - 12 * scale, 70 * scale, 24 * scale)
        write(painter, box, self.words, style.end_label, style.color("text"))


@dataclass(frozen=True, slots=True)
class RepetitionMarks:
    """Shaded stretches with their numbers; the current one in its own colour, one that is left out hatched."""

    shown: Sequence[ShownRepetition]
    current: int = -1

    def paint(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        for number, repetition in enumerate(self.shown):
            left, right = float(panel.x(repetition.start_s)), float(panel.x(repetition.end_s))
            box = QRectF(left + style.unit, panel.box.top(), right - left - 2 * style.unit, panel.box.height())
            box = box.intersected(panel.box)
            if box.isEmpty():
                continue
            painter.fillRect(box, style.color("soft" if number == self.current else "sunken"))
            if not repetition.counts:
                axes.hatch(painter, style, box)

    def paint_numbers(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        """The numbers over the first panel; where they would touch, some are left out, never the current one."""
        metrics = QFontMetricsF(style.end_label)
        baseline = panel.box.top() - NUMBERS_ABOVE * style.unit
        taken: list[tuple[float, float]] = []
        for number, repetition in sorted(enumerate(self.shown), key=lambda one: one[0] != self.current):
            text = repetition_words(number + 1, repetition)
            middle = float(panel.x(0.5 * (repetition.start_s + repetition.end_s)))
            width = metrics.horizontalAdvance(text)
            if not panel.box.left() <= middle <= panel.box.right():
                continue
            left, right = middle - width / 2, middle + width / 2 + 4 * style.unit
            if any(left < other and start < right for start, other in taken):
                continue
            taken.append((left, right))
            token = "text" if number == self.current else "warn" if not repetition.counts else "text2"
            write(painter, QPointF(left, baseline), text, style.end_label, style.color(token))


@dataclass(frozen=True, slots=True)
class Edges:
    """Lines with grips at the two ends of a stretch that can be dragged."""

    start_s: float
    end_s: float

    def paint(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        for time_s in (self.start_s, self.end_s):
            x = float(panel.x(time_s))
            if not panel.box.left() - 1 <= x <= panel.box.right() + 1:
                continue
            painter.setPen(QPen(style.color("accent"), 1.5 * style.unit))
            painter.drawLine(QPointF(x, panel.box.top()), QPointF(x, panel.box.bottom()))
            painter.setBrush(style.color("surface"))
            painter.drawRoundedRect(QRectF(x - 4, panel.box.center().y() - 12, 8, 24), 4, 4)


@dataclass(frozen=True, slots=True)
class Cursor:
    """A line at one time, in a panel that shows it."""

    time_s: float
    token: str = "text"
    width: float = 1.5

    def paint(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        x = float(panel.x(self.time_s))
        if panel.box.left() <= x <= panel.box.right():
            painter.setPen(QPen(style.color(self.token), self.width * style.unit))
            painter.drawLine(QPointF(x, panel.box.top() - 2), QPointF(x, panel.box.bottom() + 2))


@dataclass(frozen=True, slots=True)
class MouseReadout:
    """Lines of words in a small frame beside a point, within an area: what is under the mouse."""

    lines: Sequence[str]
    at: QPointF
    within: QRectF

    def paint(self, painter: QPainter, style: PlotStyle, panel: Panel | None = None) -> None:
        metrics = QFontMetricsF(style.end_label)
        pad, gap = 8 * style.unit, 12 * style.unit
        width = max(metrics.horizontalAdvance(line) for line in self.lines) + 2 * pad
        height = metrics.height() * len(self.lines) + pad
        left = self.at.x() + gap
        if left + width > self.within.right():
            left = self.at.x() - gap - width
        left = min(max(left, self.within.left()), max(self.within.right() - width, self.within.left()))
        top = min(max(self.at.y() - gap - height, self.within.top()), self.within.bottom() - height)
        painter.setPen(QPen(style.color("border"), style.grid_width))
        painter.setBrush(style.color("surface"))
        painter.drawRoundedRect(QRectF(left, top, width, height), 6 * style.unit, 6 * style.unit)
        for number, line in enumerate(self.lines):
            at = QPointF(left + pad, top + pad / 2 + metrics.ascent() + number * metrics.height())
            write(painter, at, line, style.end_label, style.color("text"))


@dataclass(frozen=True, slots=True)
class Across:
    """A band of values over the whole time, filled, and hatched in a second token where there is one."""

    low: float
    high: float
    token: str
    hatched: str = ""

    def paint(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        top = float(panel.y(self.high))
        bottom = max(float(panel.y(self.low)), top + 2 * style.unit)
        band = QRectF(panel.box.left(), top, panel.box.width(), bottom - top)
        painter.fillRect(band, style.color(self.token))
        if self.hatched:
            axes.hatch(painter, style, band, self.hatched, 90)


@dataclass(frozen=True, slots=True)
class Level:
    """A line at one value, dashed unless ``dash`` is empty; none where it is unknown."""

    value: float
    token: str
    dash: Sequence[float] = (8.0, 6.0)

    def paint(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        if not math.isfinite(self.value):
            return
        painter.setPen(dashed(style.color(self.token), 1.5 * style.unit, self.dash))
        y = float(panel.y(self.value))
        painter.drawLine(QPointF(panel.box.left(), y), QPointF(panel.box.right(), y))


@dataclass(frozen=True, slots=True)
class EndLabels:
    """Words (value, text, token) at the right ends of their lines, pushed apart where they would touch, and kept above
    what stands under the panel."""

    labels: Sequence[tuple[float, str, str]]

    def paint(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        height = QFontMetricsF(style.end_label).height()
        taken, lowest = -math.inf, panel.box.bottom() + height / 2 - len(self.labels) * height
        for middle, text, token in sorted((float(panel.y(value)), text, token) for value, text, token in self.labels):
            top, lowest = max(min(middle - height / 2, lowest), taken), lowest + height
            taken = top + height
            box = QRectF(panel.box.right() + 12 * style.unit, top, 400 * style.unit, height)
            write(painter, box, text, style.end_label, style.color(token))


def _note(
    painter: QPainter, style: PlotStyle, panel: Panel, bottom: float, text: str, token: str, ground: str = ""
) -> None:
    """Words inside the panel at its left end."""
    metrics = QFontMetricsF(style.end_label)
    at = QPointF(panel.box.left() + 6 * style.unit, bottom - metrics.descent() - 1 * style.unit)
    if ground:
        painter.fillRect(metrics.boundingRect(text).translated(at), style.color(ground))
    write(painter, at, text, style.end_label, style.color(token))


def _is_widget(device: QPaintDevice) -> bool:
    """Whether it is on the screen; printing needs no module of widgets for the question."""
    return isinstance(device, QObject) and device.isWidgetType()
