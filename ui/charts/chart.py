"""Chart base class on pyqtgraph's scene, for the screen, paper and image files."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pyqtgraph as pg
from numpy.typing import ArrayLike
from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import (
    QFont,
    QFontMetricsF,
    QPainter,
    QPainterPath,
    QPen,
    QResizeEvent,
    QShowEvent,
    QTransform,
)
from PySide6.QtWidgets import QFrame, QGraphicsScene, QGraphicsView, QSizePolicy, QWidget

from carpus.core.model.types import FloatArray
from carpus.ui.charts.panel import Panel, PlotStyle, Scale, draw_hatching, draw_text, screen_style
from carpus.ui.charts.series import Curve, draw_curves
from carpus.ui.kit.card import paint_card
from carpus.ui.kit.theme import Theme

pg.setConfigOptions(antialias=True, mouseRateLimit=-1)  # Qt joins movements itself; the last of a drag must not be lost

# In pyqtgraph's terms: a notch of the wheel shows a quarter more or less.
WHEEL_FACTOR = -math.log(1.25) / math.log(1.02) / 120.0
# A notch sideways moves by this share of the visible range.
PAN_FRACTION = 0.1
SYMBOLS = pg.graphicsItems.ScatterPlotItem.Symbols
# Drawing order within a panel.
GROUND, BAND, GRID, LINES, CURVES, FRONT = -30, -20, -10, -5, 0, 10


@dataclass(frozen=True, slots=True)
class AxisLabel:
    """Text at a value of an axis."""

    value: float
    text: str
    token: str = "text2"
    is_bold: bool = False


class Plot(pg.ViewBox):
    """Panel with a fixed vertical scale; the mouse moves it only after :meth:`enable_mouse`."""

    mouse_handler: Any = None

    def __init__(self, chart: Chart, panel: Panel, key: Any) -> None:
        super().__init__(enableMenu=False, enableMouse=False, defaultPadding=0.0)
        self.disableAutoRange()
        self.setFlag(self.GraphicsItemFlag.ItemHasNoContents)
        self.setBorder(QPen(Qt.PenStyle.NoPen))
        self.chart, self.panel, self.key, self.plot_style = chart, panel, key, chart.plot_style
        chart.add_item(self)
        self.setGeometry(panel.box)
        x, y = (panel.start_s, panel.end_s), (panel.scale.low, panel.scale.high)
        if chart.is_printing:
            self.invertY()
            x, y = (0.0, panel.box.width()), (0.0, panel.box.height())
        self.setRange(xRange=x, yRange=y, padding=0.0)

    @property
    def visible_panel(self) -> Panel:
        """Panel in the chart, over the range that is visible now: that of the first, which the others follow."""
        if self.chart.is_printing:
            return self.panel
        start, end = self.chart.plots[0].viewRange()[0]
        return replace(self.panel, start_s=start, end_s=end)

    @property
    def local_panel(self) -> Panel:
        """Panel in its own pixels, over the range that is visible now."""
        return replace(self.visible_panel, box=QRectF(QPointF(), self.panel.box.size()))

    def to_item_x(self, times: ArrayLike) -> FloatArray:
        """Return the x of times for an item in the panel.

        On paper it is in paper units and clipped to the panel: a pyqtgraph line that is stretched by a scale has no
        width there, and an SVG or PDF painter ignores clipping.
        """
        times = np.asarray(times, dtype=np.float64)
        return np.clip(self.local_panel.x(times), 0.0, self.panel.box.width()) if self.chart.is_printing else times

    def to_item_y(self, value: ArrayLike) -> FloatArray:
        """Return the y of values for an item in the panel; see :meth:`to_item_x`."""
        value = np.asarray(value, dtype=np.float64)
        return self.local_panel.y(value) if self.chart.is_printing else value

    def add_to_layer(self, item: Any, layer: int) -> Any:
        """Add a pyqtgraph item at a drawing order."""
        item.setZValue(layer)
        item.setAcceptedMouseButtons(Qt.MouseButton.NoButton)
        if not self.chart.is_printing and GROUND < layer < CURVES:  # what stays, and is no larger than the panel
            item.setCacheMode(item.CacheMode.DeviceCoordinateCache)
        self.addItem(item, ignoreBounds=True)
        return item

    # --- what is in it ------------------------------------------------------------------------------------
    def pen(self, token: str, width: float = 1.0, dash: Sequence[float] = ()) -> QPen:
        """Return a pen ``width`` design pixels wide at any scale."""
        pen = QPen(self.plot_style.color(token), width * self.plot_style.unit)
        if dash:
            pen.setDashPattern(dash)
        pen.setCosmetic(not self.chart.is_printing)
        pen.setCapStyle(Qt.PenCapStyle.FlatCap)
        return pen

    def add_grid(self, *, has_labels: bool = True) -> None:
        """Add a line at each tick, with labels at the left."""
        self.add_to_layer(Grid(self), GRID)
        if has_labels:
            self.chart.add_axis(self, "left", scale_labels(self.panel.scale), 12)

    def add_bars(self, stretches: Sequence[tuple[float, float]], token: str) -> None:
        """Add coloured time spans with a seam.

        pyqtgraph draws bars of several colours as images, which paper shows in another size.
        """
        if stretches:
            start, end = np.array(stretches).T
            low, high = self.to_item_y((self.panel.scale.low, self.panel.scale.high)).tolist()
            brush, pen = pg.mkBrush(self.plot_style.color(token)), self.pen("surface", 2.0)
            x0, x1 = self.to_item_x(start), self.to_item_x(end)
            self.add_to_layer(pg.BarGraphItem(x0=x0, x1=x1, y0=low, y1=high, brush=brush, pen=pen), GROUND)

    def add_band(self, low: float, high: float, token: str, hatched: str = "") -> None:
        """Fill values from ``low`` to ``high``, hatched in a second colour if ``hatched`` names one."""
        brush = pg.mkBrush(self.plot_style.color(token))
        ends = self.to_item_y((low, high)).tolist()
        self.add_to_layer(pg.LinearRegionItem(ends, "horizontal", brush, QPen(Qt.PenStyle.NoPen), movable=False), BAND)
        if hatched:
            self.add_to_layer(Hatching(self, [(-math.inf, math.inf, low, high)], hatched, 90), BAND)

    def add_horizontal_line(
        self, value: float, token: str, dash: Sequence[float] = (8.0, 6.0), words: str = "", *, below: bool = False
    ) -> None:
        """Add a line at a value with words at its left end; nothing if the value is NaN."""
        if math.isfinite(value):
            pen = self.pen(token, 1.5, dash)
            self.add_to_layer(pg.InfiniteLine(float(self.to_item_y(value)), angle=0, pen=pen), LINES)
            if words:
                self.add_label(value, words, token, below=below)

    def add_label(
        self, value: float, words: str, token: str = "text2", *, below: bool = False, small: bool = False
    ) -> None:
        """Add words at the left end, just above or below a value."""
        unit = self.plot_style.unit
        face = self.plot_style.label_font if small else self.plot_style.end_label_font
        item = self.chart.add_text(words, face, token, (0.0, 0.0 if below else 1.0))
        panel = self.panel
        item.setPos(panel.box.left() + 6 * unit, float(panel.y(value)) + (3 * unit if below else -2 * unit))

    def add_line(
        self, x: ArrayLike, y: ArrayLike, token: str, width: float = 0.0, dash: Sequence[float] = (),
        connect: str | np.ndarray = "all", layer: int = CURVES,
    ) -> None:  # fmt: skip
        """Add a line through points, as wide as curves unless ``width`` is given."""
        pen = self.pen(token, width or self.plot_style.line_width / self.plot_style.unit, dash)
        self.add_to_layer(pg.PlotCurveItem(self.to_item_x(x), self.to_item_y(y), pen=pen, connect=connect), layer)

    def add_curves(self, *, is_cached: bool = True) -> Curves:
        """Add an empty set of curves; cache it as an image if it changes less often than a cursor moves over it."""
        return self.add_to_layer(Curves(self, is_cached=is_cached), CURVES)  # type: ignore[no-any-return]

    def add_cursor(self, time: float, token: str = "text", width: float = 1.5) -> Any:
        return self.add_to_layer(pg.InfiniteLine(time, angle=90, pen=self.pen(token, width)), FRONT)

    # --- mouse --------------------------------------------------------------------------------------------
    def enable_mouse(self, handler: Any) -> None:
        """Let the mouse zoom and pan along the time axis."""
        self.mouse_handler = handler
        self.setMouseEnabled(x=True, y=False)
        self.state["wheelScaleFactor"] = WHEEL_FACTOR

    def wheelEvent(self, event: Any, axis: int | None = None) -> None:
        """Zoom with Ctrl, pan sideways or with Shift; otherwise leave the wheel to the page."""
        if self.mouse_handler is None:
            event.ignore()
        elif event.orientation() == Qt.Orientation.Horizontal or event.modifiers() & Qt.KeyboardModifier.ShiftModifier:
            (start, end), _ = self.viewRange()
            self.translateBy(x=-event.delta() / 120.0 * PAN_FRACTION * (end - start))
            event.accept()
        elif event.modifiers() & Qt.KeyboardModifier.ControlModifier:
            self.childTransform()  # brings it up to date, also before the next painting
            super().wheelEvent(event, 0)
        else:
            event.ignore()

    def mouseDragEvent(self, event: Any, axis: int | None = None) -> None:
        if self.mouse_handler is not None:
            event.accept()
            if not self.mouse_handler.drag(event):
                self.childTransform()
                super().mouseDragEvent(event, 0)

    def mouseClickEvent(self, event: Any) -> None:
        if self.mouse_handler is not None and event.button() == Qt.MouseButton.LeftButton:
            event.accept()
            self.mouse_handler.click(event)


class PixelItem(pg.GraphicsObject):
    """Item of a panel that is drawn in the panel's pixels."""

    def __init__(self, plot: Plot, *, is_cached: bool = True) -> None:
        super().__init__()
        self.plot = plot
        if is_cached and not plot.chart.is_printing:
            self.setCacheMode(self.CacheMode.DeviceCoordinateCache)

    def boundingRect(self) -> QRectF:
        return QRectF(self.plot.viewRect())

    def viewRangeChanged(self, *_: object) -> None:
        self.prepareGeometryChange()
        self.update()

    def paint(self, painter: QPainter, option: object, widget: QWidget | None = None) -> None:
        inverse, _ = self.plot.childTransform().inverted()
        painter.setTransform(inverse, True)
        at = painter.transform()  # what rounding leaves of a scale makes Qt four times slower
        painter.setTransform(QTransform(round(at.m11(), 9), 0.0, 0.0, round(at.m22(), 9), at.dx(), at.dy()))
        self.paint_pixels(painter, self.plot.plot_style, self.plot.local_panel)

    def paint_pixels(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        raise NotImplementedError


class Grid(PixelItem):
    """A line at each tick, the one at zero stronger."""

    def paint_pixels(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        for value in panel.scale.ticks:
            y = float(panel.y(value))
            y = round(y) + 0.5 if style.unit == 1.0 else y
            painter.setPen(QPen(style.color("line" if value else "border"), style.grid_width))
            painter.drawLine(QPointF(panel.box.left(), y), QPointF(panel.box.right(), y))


class Curves(PixelItem):
    """All curves of a panel with their bands and gaps; :func:`draw_curves` says why pyqtgraph's are not used."""

    curves: Sequence[Curve] = ()

    def set_curves(self, curves: Sequence[Curve]) -> None:
        self.curves = curves
        self.update()

    def paint_pixels(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        draw_curves(painter, style, panel, self.curves)


class Hatching(PixelItem):
    """Diagonal lines over stretches (start, end, low, high) of a panel.

    pyqtgraph has none: a patterned brush is stretched by the scale and becomes dots on paper.
    """

    def __init__(
        self,
        plot: Plot,
        stretches: Sequence[tuple[float, float, float, float]],
        token: str = "border",
        alpha: int = 130,
    ) -> None:
        super().__init__(plot)
        self.stretches, self._token, self._alpha = stretches, token, alpha

    def set_stretches(self, stretches: Sequence[tuple[float, float, float, float]]) -> None:
        self.stretches = stretches
        self.update()

    def paint_pixels(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        for start, end, low, high in self.stretches:
            left, right = (float(panel.x(at)) for at in np.clip((start, end), panel.start_s, panel.end_s))
            top, bottom = float(panel.y(high)), float(panel.y(low))
            if right > left:
                draw_hatching(
                    painter, style, QRectF(left, top, right - left, bottom - top), self._token, self._alpha, phase=0.5
                )


class PaintedLayer(pg.GraphicsObject):
    """Something painted over the panels and cached until it is updated.

    For what changes ten times a second: as pyqtgraph items, each would cost as much as a curve.
    """

    def __init__(
        self, chart: Chart, area: QRectF, paint: Callable[[QPainter], None], *, is_cached: bool = True
    ) -> None:
        super().__init__()
        self._paint, self._area = paint, area
        self.setAcceptedMouseButtons(Qt.MouseButton.NoButton)
        self.setZValue(FRONT)
        if is_cached:
            self.setCacheMode(self.CacheMode.DeviceCoordinateCache)
        chart.add_item(self)

    def boundingRect(self) -> QRectF:
        return self._area

    def paint(self, painter: QPainter, option: object, widget: QWidget | None = None) -> None:
        self._paint(painter)


class Symbols(pg.ScatterPlotItem):
    """Symbols over the panels.

    On paper they are drawn here: pyqtgraph omits those beyond the widget and uses the device's unit.
    """

    chart: Chart

    def viewRect(self) -> QRectF:
        return self.chart.area

    def paint(self, painter: QPainter, option: object, widget: QWidget | None = None) -> None:
        if not self.chart.is_printing:
            super().paint(painter, option, widget)
            return
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        for spot in self.points():
            pen = QPen(spot.pen())
            pen.setCosmetic(False)
            painter.setPen(pen)
            painter.setBrush(spot.brush())
            x, y, size = spot.pos().x(), spot.pos().y(), spot.size()
            painter.drawPath(QTransform(size, 0.0, 0.0, size, x, y).map(SYMBOLS[spot.symbol()]))

    def mouseClickEvent(self, event: Any) -> None:
        event.ignore()  # it is the panel's


class ChartText(pg.TextItem):
    """Text over the panels, placed by ``setPos``; rich text by :meth:`show_rich`."""

    _rich = ""

    def __init__(self, chart: Chart, words: str, face: QFont, token: str, anchor: tuple[float, float]) -> None:
        super().__init__(anchor=anchor, color=chart.plot_style.color(token))
        self.textItem.document().setDocumentMargin(0.0)
        self.setFont(face)
        self.setText(words)
        if not chart.is_printing:
            self.textItem.setCacheMode(self.CacheMode.DeviceCoordinateCache)
            self.setFlag(self.GraphicsItemFlag.ItemHasNoContents)
        self.setAcceptedMouseButtons(Qt.MouseButton.NoButton)
        self.setZValue(20)
        chart.add_item(self)

    def show_rich(self, html: str) -> None:
        if html != self._rich:  # pyqtgraph compares with what Qt makes of it, which differs always
            self._rich = html
            self.textItem.setHtml(html)
            self.updateTextPos()


class Axis(pg.AxisItem):
    """Labels beside a panel; a label that would touch an earlier one is omitted.

    pyqtgraph's axis has one font and colour for all, and lets labels touch or omits all of them.
    """

    def __init__(
        self,
        plot: Plot,
        side: str,
        labels: Callable[[float, float], Iterable[AxisLabel]],
        gap: float,
        room: float = math.inf,
    ) -> None:
        """Place labels ``gap`` design pixels from the panel, in a smaller font if they are wider than ``room``."""
        super().__init__(side)
        self.plot, self._labels, self._gap, self._room = plot, labels, gap, room
        if not plot.chart.is_printing:
            self.setCacheMode(self.CacheMode.DeviceCoordinateCache)
        plot.chart.add_item(self)
        self.linkToView(plot)
        self.linkedViewChanged(plot)
        self.setZValue(1)

    def boundingRect(self) -> QRectF:
        box, style, area = self.plot.panel.box, self.plot.plot_style, self.plot.chart.area
        height = QFontMetricsF(style.end_label_font).height()
        if self.orientation == "left":
            return QRectF(area.left(), box.top() - height, box.left() - area.left(), box.height() + 2 * height)
        top = box.bottom() if self.orientation == "bottom" else box.top() - self._gap * style.unit - 1.5 * height
        return QRectF(area.left(), top, area.width(), 1.6 * height + self._gap * style.unit)

    def shape(self) -> QPainterPath:
        return QPainterPath()

    def paint(self, painter: QPainter, option: object, widget: QWidget | None = None) -> None:
        style, panel, unit = self.plot.plot_style, self.plot.visible_panel, self.plot.plot_style.unit
        occupied: list[tuple[float, float]] = []
        for label in self._labels(panel.start_s, panel.end_s):
            face = style.end_label_font if label.is_bold else style.label_font
            metrics = QFontMetricsF(face)
            width, gap = metrics.horizontalAdvance(label.text), self._gap * unit
            if self.orientation == "left":
                middle, least = float(panel.y(label.value)), metrics.capHeight() + 5 * unit
                low, high, apart = middle - least / 2, middle + least / 2, 0.0
            else:
                middle = float(panel.x(label.value))
                area = self.plot.chart.area  # what is beyond it is not painted, or only half
                low = max(min(middle - width / 2, area.right() - width), area.left())
                high = low + width
                apart = metrics.height() if self.orientation == "bottom" else 4 * unit
                if not panel.box.left() - 0.5 <= middle <= panel.box.right() + 0.5:
                    continue
            if any(low < other_high + apart and high > other_low - apart for other_low, other_high in occupied):
                continue
            occupied.append((low, high))
            color = style.color(label.token)
            if self.orientation == "left":
                height, right = metrics.height(), panel.box.left() - gap
                at = QRectF(right - 300 * unit, middle - height / 2, 300 * unit, height)
                side = Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignRight
                draw_text(painter, at, label.text, fit_font(face, label.text, self._room), color, side)
            else:
                below = self.orientation == "bottom"
                base = panel.box.bottom() + gap + metrics.ascent() if below else panel.box.top() - gap
                draw_text(painter, QPointF(low, base), label.text, face, color)


def date_labels(labels: Sequence[tuple[float, str]]) -> Callable[[float, float], list[AxisLabel]]:
    """Return a function that orders visible dates: last, first, then the others from the newest back."""

    def select_labels(start: float, end: float) -> list[AxisLabel]:
        some = [label for label in labels if start <= label[0] <= end]
        ends = [some[-1], *some[:1][: len(some) - 1]] if some else []
        return [
            *(AxisLabel(*one, "text", is_bold=True) for one in ends),
            *(AxisLabel(*one, is_bold=True) for one in some[::-1]),
        ]

    return select_labels


def fit_font(face: QFont, text: str, room_px: float) -> QFont:
    """Return the font, reduced to at least half its size if the text is wider than the room."""
    width = QFontMetricsF(face).horizontalAdvance(text)
    if width <= room_px or width <= 0.0:
        return face
    smaller = QFont(face)
    smaller.setPixelSize(max(int(face.pixelSize() * room_px / width), face.pixelSize() // 2, 1))
    return smaller


def scale_labels(scale: Scale) -> list[AxisLabel]:
    """Return the labels of a fixed scale, its ends first."""
    ends = (max(scale.ticks), min(scale.ticks)) if scale.ticks else ()
    out = []
    for value, text in sorted(scale.labels, key=lambda one: one[0] not in ends):
        strong = scale.bold_ends and value in ends and value != 0.0
        out.append(AxisLabel(value, text, "text" if strong else "text2", strong))
    return out


class Chart(pg.GraphicsView):
    """Card with panels; a subclass adds them in :meth:`build` for the present ``plot_style`` and ``area``."""

    # Width and height.
    default_px, min_px = (736, 360), (420, 200)
    is_card = True

    def __init__(self, theme: Theme) -> None:
        super().__init__(background=None)
        self._theme = theme
        self.plot_style = screen_style(theme)
        self.area = QRectF()
        self.is_printing = False
        self.plots: list[Plot] = []
        # The scene does not keep its items alive.
        self._items: list[Any] = []
        self.setCentralWidget(None)
        # Items of pyqtgraph say too late for an index that they have another size.
        self.scene().setItemIndexMethod(QGraphicsScene.ItemIndexMethod.NoIndex)
        self.setAntialiasing(True)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setViewportUpdateMode(self.ViewportUpdateMode.BoundingRectViewportUpdate)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        theme.changed.connect(self.refresh)

    # --- for a subclass -----------------------------------------------------------------------------------
    def build(self) -> None:
        raise NotImplementedError

    def paint_background(self, painter: QPainter) -> None:
        """Paint what lies under everything, on the screen only."""

    def sizeHint(self) -> QSize:
        return QSize(*self.default_px)

    def minimumSizeHint(self) -> QSize:
        return QSize(*self.min_px)

    # --- building -----------------------------------------------------------------------------------------
    def add_plot(self, panel: Panel, key: Any = None) -> Plot:
        """Add a panel, on the screen with its edges between pixels; ``key`` says what it shows."""
        if not self.is_printing:
            panel = replace(panel, box=QRectF(panel.box.toRect()))
        plot = Plot(self, panel, key)
        self.plots.append(plot)
        return plot

    def add_item(self, item: Any) -> Any:
        self._items.append(item)
        self.scene().addItem(item)
        return item

    def remove_item(self, item: Any) -> None:
        self._items.remove(item)
        self.scene().removeItem(item)

    def add_axis(
        self,
        plot: Plot,
        side: str,
        labels: Callable[[float, float], Iterable[AxisLabel]] | Iterable[AxisLabel],
        gap: float,
    ) -> Axis:
        """Add labels left of, under or over a plot: a fixed list, or a function of the visible range."""
        select_labels = labels if callable(labels) else lambda *_, fixed=tuple(labels): fixed
        room = math.inf if self.is_printing else plot.panel.box.left() - gap * self.plot_style.unit - 2.0
        return Axis(plot, side, select_labels, gap, room)

    def add_text(
        self, words: str, face: QFont, token: str = "text", anchor: tuple[float, float] = (0.0, 0.0)
    ) -> ChartText:
        """Add words over the panels; the caller places them by ``setPos``."""
        return ChartText(self, words, face, token, anchor)

    def add_symbols(
        self, symbol: str = "o", size: float = 10.0, pen: QPen | None = None, fill: str = "",
        positions: Sequence[QPointF] = (), alpha: int = 255,
    ) -> Any:  # fmt: skip
        """Add symbols at positions of the chart, ``size`` design pixels wide, with a seam unless ``pen`` is given."""
        unit = self.plot_style.unit
        pen = pg.mkPen(self.plot_style.color("surface"), width=1.5 * unit) if pen is None else pen
        symbols = Symbols(
            x=[one.x() for one in positions],
            y=[one.y() for one in positions],
            symbol=symbol,
            size=size * unit,
            pen=pen,
            brush=pg.mkBrush(self.plot_style.color(fill, alpha) if fill else None),
        )
        symbols.chart = self
        symbols.setZValue(FRONT)
        return self.add_item(symbols)

    def add_end_labels(self, plot: Plot, labels: Sequence[tuple[float, str, str]]) -> None:
        """Add labels (value, text, token) at the right ends of lines, moved apart where they would touch."""
        panel, unit, face = plot.panel, self.plot_style.unit, self.plot_style.end_label_font
        height = QFontMetricsF(face).height()
        occupied, lowest = -math.inf, panel.box.bottom() + height / 2 - len(labels) * height
        for middle, text, token in sorted((float(panel.y(value)), text, token) for value, text, token in labels):
            top, lowest = max(min(middle - height / 2, lowest), occupied), lowest + height
            occupied = top + height
            self.add_text(text, face, token).setPos(panel.box.right() + 12 * unit, top)

    def legend_lines(
        self, entries: Sequence[tuple[str, str, str]], width: float
    ) -> list[list[tuple[float, str, str, str]]]:
        """Break legend entries (symbol, text, token) into lines, each entry with its left end."""
        metrics, unit = QFontMetricsF(self.plot_style.end_label_font), self.plot_style.unit
        lines: list[list[tuple[float, str, str, str]]] = [[]]
        across = 8 * unit
        for sign, words, token in entries:
            needs = 17 * unit + metrics.horizontalAdvance(words)
            if lines[-1] and across + needs > width:
                lines.append([])
                across = 8 * unit
            lines[-1].append((across, sign, words, token))
            across += needs + 18 * unit
        return lines

    def add_legend(self, entries: Sequence[tuple[str, str, str]], box: QRectF) -> None:
        """Add a legend at the lower end of a box; ``O`` is a filled disc.

        pyqtgraph's legend has one column, or several of equal width.
        """
        unit, face = self.plot_style.unit, self.plot_style.end_label_font
        height = QFontMetricsF(face).height()
        for number, line in enumerate(reversed(self.legend_lines(entries, box.width()))):
            middle = box.bottom() - 10 * unit - number * height
            for left, sign, words, token in line:
                pen = pg.mkPen(self.plot_style.color(token), width=1.6 * unit)
                fill = token if sign == "O" else "surface"
                self.add_symbols(sign.lower(), 9.0, pen, fill, [QPointF(box.left() + left + 5 * unit, middle)])
                self.add_text(words, face, "text2", (0.0, 0.5)).setPos(box.left() + left + 17 * unit, middle)

    def refresh(self) -> None:
        """Rebuild the chart if it is visible."""
        if self.isVisible():
            self.plot_style = screen_style(self._theme)
            self.area = QRectF(self.rect())
            self._rebuild()
            self.resetCachedContent()
            self.viewport().update()

    def _rebuild(self) -> None:
        for item in self._items:
            self.scene().removeItem(item)
        self._items, self.plots = [], []
        self.build()

    # --- life ---------------------------------------------------------------------------------------------
    @property
    def mouse_target(self) -> QWidget:
        """Widget that receives the mouse events."""
        port: QWidget = self.viewport()
        return port

    def close(self) -> bool:
        """Hide the chart; pyqtgraph's own ``close`` would take the scene apart."""
        return QGraphicsView.close(self)

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        self.refresh()

    def resizeEvent(self, event: QResizeEvent | None) -> None:
        super().resizeEvent(event)
        if event is not None:
            self.refresh()

    def drawBackground(self, painter: QPainter, area: QRectF) -> None:
        if self.is_printing:
            return
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        # A chart that is no card itself lies on one.
        painter.fillRect(area, self._theme.color("canvas" if self.is_card else "surface"))
        if self.is_card:
            paint_card(painter, self._theme, QRectF(self.rect()))
        self.paint_background(painter)

    # --- on paper -----------------------------------------------------------------------------------------
    def render_on_paper(self, painter: QPainter, style: PlotStyle, box: QRectF) -> None:
        """Rebuild the chart for a painter in any unit, render it as vectors, then rebuild it for the screen."""
        self.plot_style, self.area, self.is_printing = style, QRectF(0.0, 0.0, box.width(), box.height()), True
        self.setSceneRect(self.area)
        try:
            self._rebuild()
            self.scene().render(painter, box, self.area)
        finally:
            self.is_printing = False
            self.plot_style = screen_style(self._theme)
            self.resizeEvent(None)
            self.refresh()


class HoverLabel(pg.TextItem):
    """Framed lines of text beside a point, kept within the chart."""

    def __init__(self, chart: Chart) -> None:
        look = chart.plot_style
        super().__init__(color=look.color("text"), border=look.color("border"), fill=look.color("surface"))
        self._chart = chart
        self.textItem.document().setDocumentMargin(6.0)
        self.setFont(look.end_label_font)
        self.setZValue(30)
        self.setAcceptedMouseButtons(Qt.MouseButton.NoButton)
        chart.add_item(self)

    def show_lines(self, position: QPointF | None, lines: Sequence[str]) -> None:
        """Show lines beside a position; hide the label if it is None."""
        self.setVisible(position is not None)
        if position is None:
            return
        self.setText("\n".join(lines))
        box, area = self.textItem.boundingRect(), QRectF(self._chart.rect()).adjusted(4, 4, -4, -4)
        beside = position.x() + 12
        left = beside if beside + box.width() <= area.right() else position.x() - 12 - box.width()
        left = min(max(left, area.left()), max(area.right() - box.width(), area.left()))
        self.setPos(left, min(max(position.y() - 12 - box.height(), area.top()), area.bottom() - box.height()))
