"""The graphics scene of a card with plots, on pyqtgraph: a view box for each panel, marks as items in it.

Only loaded when a plot is first shown: pyqtgraph takes a quarter of a second.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any, Protocol

import pyqtgraph as pg
from PySide6.QtCore import QEvent, QObject, QPoint, QPointF, QRectF, Qt
from PySide6.QtGui import QContextMenuEvent, QPainter
from PySide6.QtWidgets import QFrame, QPinchGesture, QWidget

from carpus.ui.plot.axes import Panel
from carpus.ui.plot.marks import Mark
from carpus.ui.plot.style import screen_style
from carpus.ui.theme import Theme

pg.setConfigOptions(mouseRateLimit=-1)  # Qt joins movements itself; the last one of a quick drag must not be lost

Paint = Callable[[QPainter], None]
WHEEL_FACTOR = -math.log(1.25) / math.log(1.02) / 120.0
"""In the terms of pyqtgraph: a notch shows a quarter more or less."""
BEYOND_PX = 48.0
"""So far about its panel a mark may reach, such as the figure of a point at its edge; curves end at the edge."""
ALONG_SHARE = 0.1
"""A notch sideways goes on by this part of what is shown."""


class Menu(Protocol):
    """What can be done with the plot."""

    def open(self, at: QPoint) -> None: ...


class Hands(Protocol):
    """Who takes what is done with the mouse in the panels; positions are those of the card."""

    def drag(self, event: Any) -> bool: ...

    def click(self, event: Any) -> None: ...

    def hover(self, at: QPointF | None) -> None: ...

    @property
    def menu(self) -> Menu: ...

    def zoom(self, factor: float, about: float) -> None: ...

    def take_range(self, start: float, end: float) -> None: ...


class PanelBox(pg.ViewBox):
    """A panel with a fixed scale upwards. Nothing moves it by mouse before it is given ``hands``."""

    hands: Hands | None = None

    def __init__(self, panel: Panel) -> None:
        super().__init__(enableMenu=False, enableMouse=False, defaultPadding=0.0)
        # Curves cut themselves at its edge; figures of points may reach over it.
        self.setFlag(self.GraphicsItemFlag.ItemClipsChildrenToShape, False)
        self.panel = panel
        self.show_panel(panel)

    def show_panel(self, panel: Panel) -> None:
        self.setGeometry(panel.box)
        across, up = self.viewRange()  # each setting costs as much as a curve, so only what is new is set
        if tuple(across) != (panel.start_s, panel.end_s):
            self.setXRange(panel.start_s, panel.end_s, padding=0.0)
        if tuple(up) != (panel.scale.low, panel.scale.high):
            self.setYRange(panel.scale.low, panel.scale.high, padding=0.0)
        self.panel = panel

    def unlock(self, hands: Hands) -> None:
        """Let the mouse move it along its one free axis."""
        self.hands = hands
        self.setMouseEnabled(x=True, y=False)
        self.state["wheelScaleFactor"] = WHEEL_FACTOR

    def wheelEvent(self, event: Any, axis: int | None = None) -> None:
        """With Ctrl longer or shorter about the mouse; sideways, or with Shift, along the axis; else the page."""
        if self.hands is None:
            event.ignore()
        elif event.orientation() == Qt.Orientation.Horizontal or event.modifiers() & Qt.KeyboardModifier.ShiftModifier:
            (start, end), _ = self.viewRange()
            self.translateBy(x=-event.delta() / 120.0 * ALONG_SHARE * (end - start))
            event.accept()
        elif event.modifiers() & Qt.KeyboardModifier.ControlModifier:
            self.childTransform()  # brings it up to date, also before the next painting
            super().wheelEvent(event, 0)
        else:
            event.ignore()

    def mouseDragEvent(self, event: Any, axis: int | None = None) -> None:
        if self.hands is not None:
            event.accept()
            if not self.hands.drag(event):
                self.childTransform()
                super().mouseDragEvent(event, 0)

    def mouseClickEvent(self, event: Any) -> None:
        if self.hands is not None and event.button() == Qt.MouseButton.LeftButton:
            event.accept()
            self.hands.click(event)

    @property
    def own(self) -> Panel:
        """The panel in the box's own pixels, as it is ranged now."""
        (start_s, end_s), _ = self.viewRange()
        return Panel(QRectF(self.rect()), self.panel.scale, start_s, end_s)


class MarksItem(pg.GraphicsObject):
    """Marks in a view box, drawn in its pixels."""

    def __init__(self, box: PanelBox, theme: Theme, *, kept: bool = False) -> None:
        """``kept`` as a picture between changes, where a cursor goes over it more often than it changes."""
        super().__init__(box)
        if kept:
            self.setCacheMode(self.CacheMode.DeviceCoordinateCache)
        self._box, self._theme = box, theme
        self._marks: Sequence[Mark] = ()

    def set_marks(self, marks: Sequence[Mark]) -> None:
        self._marks = marks
        self.update()

    def boundingRect(self) -> QRectF:
        return QRectF(self._box.rect()).adjusted(-BEYOND_PX, -BEYOND_PX, BEYOND_PX, BEYOND_PX)

    def paint(self, painter: QPainter, option: object, widget: QWidget | None = None) -> None:
        style, panel = screen_style(self._theme), self._box.own
        for mark in self._marks:
            mark.paint(painter, style, panel)


class Layer(pg.GraphicsObject):
    """Something over the panels that changes more seldom or more often than they do; ``kept`` as a picture between."""

    def __init__(self, paint: Paint, *, kept: bool = False) -> None:
        super().__init__()
        self._paint, self._area = paint, QRectF()
        self.setAcceptedMouseButtons(Qt.MouseButton.NoButton)
        if kept:
            self.setCacheMode(self.CacheMode.DeviceCoordinateCache)

    def cover(self, area: QRectF) -> None:
        """Where it may draw."""
        if area != self._area:
            self.prepareGeometryChange()
            self._area = area

    def boundingRect(self) -> QRectF:
        return self._area

    def paint(self, painter: QPainter, option: object, widget: QWidget | None = None) -> None:
        self._paint(painter)


class Watch(QObject):
    """Sees pinches on a canvas, and that the mouse leaves it."""

    def __init__(self, canvas: Canvas) -> None:
        super().__init__(canvas)
        self._canvas = canvas

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.Leave:
            self._canvas.left()
        if event.type() != QEvent.Type.Gesture:
            return False
        pinch = event.gesture(Qt.GestureType.PinchGesture)  # type: ignore[attr-defined]
        if pinch is not None:
            self._canvas.pinch(pinch)
        return pinch is not None


class Canvas(pg.GraphicsView):
    """Panels over a ground that is painted once and kept; scene and widget share their pixels."""

    _hands: Hands | None = None

    def __init__(self, theme: Theme, ground: Paint, parent: QWidget) -> None:
        super().__init__(parent, background=None)
        self._theme, self._ground = theme, ground
        self.setCentralWidget(None)
        self.setAntialiasing(True)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setViewportUpdateMode(self.ViewportUpdateMode.BoundingRectViewportUpdate)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)

        self._placing = False
        self.boxes: list[PanelBox] = []
        self._items: list[MarksItem] = []

    def drawBackground(self, painter: QPainter, area: QRectF) -> None:
        painter.fillRect(area, self._theme.color("canvas"))
        self._ground(painter)

    def lay_out(
        self, panels: Sequence[Panel], extent: tuple[float, float] | None = None, shortest: float = 0.0
    ) -> None:
        """Put the panels in their places and paint the ground anew.

        ``extent`` is how far they go by mouse, ``shortest`` the least they show.
        """
        self._placing = True
        while len(self.boxes) > len(panels):
            self._items.pop()
            self.scene().removeItem(self.boxes.pop())
        for panel in panels[len(self.boxes) :]:
            box = PanelBox(panel)
            self.scene().addItem(box)
            if self._hands is not None:
                self._unlock(box)
            self.boxes.append(box)
            self._items.append(MarksItem(box, self._theme, kept=self._hands is not None))
        for box, panel in zip(self.boxes, panels, strict=True):
            if extent is not None:
                box.setLimits(xMin=extent[0], xMax=extent[1], minXRange=min(shortest, extent[1] - extent[0]))
            box.show_panel(panel)
        self._placing = False
        self.repaint_ground()

    def unlock(self, hands: Hands) -> None:
        """Let the panels be looked into by mouse, touch and menu; all of them go along together."""
        self._hands = hands
        self.scene().sigMouseMoved.connect(hands.hover)
        self.viewport().grabGesture(Qt.GestureType.PinchGesture)
        self._watch = Watch(self)
        self.viewport().installEventFilter(self._watch)

    def _unlock(self, box: PanelBox) -> None:
        assert self._hands is not None
        box.unlock(self._hands)
        if self.boxes:
            box.setXLink(self.boxes[0])
        else:
            box.sigXRangeChanged.connect(lambda _, ends: self._take_range(ends))

    def _take_range(self, ends: Sequence[float]) -> None:
        if self._hands is not None and not self._placing:
            self._hands.take_range(float(ends[0]), float(ends[1]))

    def left(self) -> None:
        if self._hands is not None:
            self._hands.hover(None)

    def pinch(self, pinch: QPinchGesture) -> None:
        """Two fingers go apart or together on the panels."""
        if self._hands is not None and self.boxes and pinch.scaleFactor() > 0.0:
            at = self.viewport().mapFromGlobal(pinch.centerPoint().toPoint())
            about = float(self.boxes[0].mapSceneToView(QPointF(at)).x())
            self._hands.zoom(1.0 / pinch.scaleFactor(), about)

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        if self._hands is not None:
            self._hands.menu.open(event.globalPos())

    def repaint_ground(self) -> None:
        """What does not move has changed."""
        self.resetCachedContent()
        self.viewport().update()

    def show_marks(self, marks: Sequence[Sequence[Mark]]) -> None:
        """What is in each panel, from top to bottom."""
        for item, own in zip(self._items, marks, strict=True):
            item.set_marks(own)

    def add_layer(self, paint: Paint, *, kept: bool = False) -> Layer:
        layer = Layer(paint, kept=kept)
        self.scene().addItem(layer)
        return layer
