"""Chart that zooms and pans along a shared axis, with a menu to copy and save it at print size on white."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from PySide6.QtCore import (
    QBuffer,
    QByteArray,
    QEvent,
    QIODevice,
    QObject,
    QPoint,
    QPointF,
    QRectF,
    QSizeF,
    Qt,
    Signal,
)
from PySide6.QtGui import QColor, QContextMenuEvent, QGuiApplication, QImage, QPaintDevice, QPainter, QResizeEvent
from PySide6.QtSvg import QSvgGenerator
from PySide6.QtWidgets import QFileDialog, QMenu

from carpus.core.model.errors import CarpusFault
from carpus.ui.charts.chart import Chart, Plot
from carpus.ui.charts.panel import Panel, paper_style
from carpus.ui.kit.button import icon_button
from carpus.ui.kit.table_file import save_private
from carpus.ui.kit.theme import LIGHT, Theme

# Factor of a notch of the wheel, or of a key.
ZOOM_STEP = 1.25
# Width of a page's text, at print resolution.
WIDTH_MM, DPI = 170.0, 300.0
SVG_UNITS_PER_POINT = 10.0
MARGIN_PT = 8.0
POINTS_PER_MM = 72.0 / 25.4


class ZoomChart(Chart):
    """Chart with one shared axis; its ``_window`` is the visible part, None for all."""

    # Shortest visible part of the axis.
    min_span = 1.0

    def __init__(self, theme: Theme, file_name: str) -> None:
        super().__init__(theme)
        self._window: tuple[float, float] | None = None
        self.menu = PlotMenu(self, file_name)
        self.scene().sigMouseMoved.connect(self.hover)
        self.viewport().grabGesture(Qt.GestureType.PinchGesture)
        self.menu_button = icon_button(theme, "ellipsis", self.tr("Zoom, copy and save"))
        self.menu_button.setParent(self)
        self.menu_button.setProperty("floats", True)  # over a corner in which nothing is written
        self.menu_button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.menu_button.clicked.connect(
            lambda: self.menu.open(self.menu_button.mapToGlobal(QPoint(0, self.menu_button.height())))
        )

    # --- for a subclass -----------------------------------------------------------------------------------
    def extent(self) -> tuple[float, float] | None:
        """Return the ends of the shared axis, None while there is no data."""
        raise NotImplementedError

    def zoom_center(self) -> float:
        """Return the value that stays in place when zooming by key."""
        return sum(self.x_range()) / 2

    def drag(self, event: Any) -> bool:
        """Handle a drag; return False to let the plot pan."""
        return False

    def click(self, event: Any) -> None:
        pass

    def hover(self, position: QPointF | None) -> None:
        """Handle a mouse position, None when the mouse has left."""

    def update_range(self) -> None:
        """Update what depends on the visible range."""

    # --- window -------------------------------------------------------------------------------------------
    def x_range(self) -> tuple[float, float]:
        """Return both ends of the visible range."""
        return self._window or self.extent() or (0.0, 1.0)

    def show_window(self, window: tuple[float, float] | None) -> None:
        """Show a part of the axis, None for all; pyqtgraph keeps it within the limits."""
        if self.plots and self.isVisible():  # those of a hidden chart may be another session's
            self.plots[0].setXRange(*(window or self.extent() or (0.0, 1.0)), padding=0.0)
        else:
            self._window = window

    def zoom(self, factor: float, center: float) -> None:
        """Show ``factor`` times as much, keeping ``center`` in place."""
        if self.plots:
            self.plots[0].scaleBy(x=factor, center=(center, 0.0))

    def zoom_in(self) -> None:
        self.zoom(1.0 / ZOOM_STEP, self._visible_zoom_center())

    def zoom_out(self) -> None:
        self.zoom(ZOOM_STEP, self._visible_zoom_center())

    def show_all(self) -> None:
        self.show_window(None)

    def _visible_zoom_center(self) -> float:
        start, end = self.x_range()
        return min(max(self.zoom_center(), start), end)

    def add_plot(self, panel: Panel, key: Any = None) -> Plot:
        """Add a plot whose visible range is linked to the others'."""
        plot, extent = super().add_plot(panel, key), self.extent()
        if extent is None or self.is_printing:
            return plot
        plot.setLimits(xMin=extent[0], xMax=extent[1], minXRange=min(self.min_span, extent[1] - extent[0]))
        plot.enable_mouse(self)
        if plot is self.plots[0]:
            plot.sigXRangeChanged.connect(lambda _, ends: self._set_window(extent, *ends))
        else:
            plot.setXLink(self.plots[0])
        return plot

    def _set_window(self, extent: tuple[float, float], start: float, end: float) -> None:
        whole = extent[1] - extent[0]
        self._window = None if end - start >= whole * (1.0 - 1e-9) else (start, end)
        self.update_range()

    def viewportEvent(self, event: QEvent) -> bool:
        """Zoom by a pinch gesture."""
        if event.type() == QEvent.Type.Gesture and self.plots:
            pinch = event.gesture(Qt.GestureType.PinchGesture)  # type: ignore[attr-defined]
            if pinch is not None and pinch.scaleFactor() > 0.0:
                at = self.viewport().mapFromGlobal(pinch.centerPoint().toPoint())
                self.zoom(1.0 / pinch.scaleFactor(), float(self.plots[0].mapSceneToView(QPointF(at)).x()))
                return True
        if event.type() == QEvent.Type.Leave:
            self.hover(None)
        return bool(super().viewportEvent(event))

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        self.menu.open(event.globalPos())

    def resizeEvent(self, event: QResizeEvent | None) -> None:
        if event is not None:
            self.menu_button.adjustSize()  # where a layout is in the card Qt leaves this to us
            self.menu_button.move(self.width() - self.menu_button.width() - 6, 2)
        super().resizeEvent(event)


class PlotMenu(QObject):
    """Context menu of a chart; emits ``fault_raised`` if saving fails, ``saved`` with the path."""

    fault_raised = Signal(object)
    saved = Signal(str)

    def __init__(self, card: ZoomChart, file_name: str) -> None:
        super().__init__(card)
        self._card, self._file_name = card, file_name
        # Where the file dialog opens.
        self.start_folder = ""

    def open(self, position: QPoint) -> None:
        card = self._card
        if card.extent() is None:
            return
        menu = QMenu(card)
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        menu.addAction(self.tr("Show all") + "\t0", card.show_all)
        menu.addAction(self.tr("Zoom in") + "\t+", card.zoom_in)
        menu.addAction(self.tr("Zoom out") + "\t-", card.zoom_out)
        menu.addSeparator()
        menu.addAction(self.tr("Copy image"), self.copy_picture)
        menu.addAction(self.tr("Save image (PNG)…"), self.save_picture)
        menu.addAction(self.tr("Save drawing (SVG)…"), lambda: self._save_with_dialog("svg", "SVG (*.svg)"))
        menu.popup(position)

    def copy_picture(self) -> None:
        QGuiApplication.clipboard().setImage(render_image(self._card))

    def save_picture(self) -> None:
        self._save_with_dialog("png", "PNG (*.png)")

    def _save_with_dialog(self, kind: str, filter_words: str) -> None:
        start = str(Path(self.start_folder) / f"{self._file_name}.{kind}")
        path, _ = QFileDialog.getSaveFileName(self._card, self.tr("Save"), start, filter_words)
        if path:
            self.save(Path(path))

    def save(self, path: Path) -> None:
        """Save an image or a drawing by the file's suffix."""
        try:
            save_chart(self._card, path)
        except CarpusFault as fault:
            self.fault_raised.emit(fault)
        else:
            self.saved.emit(str(path))


def _paint(chart: Chart, device: QPaintDevice, point: float) -> None:
    with QPainter(device) as painter:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        margin = MARGIN_PT * point
        box = QRectF(QPointF(), _size_pt(chart) * point).adjusted(margin, margin, -margin, -margin)
        chart.render_on_paper(painter, paper_style(point), box)


def _size_pt(chart: Chart) -> QSizeF:
    width_pt = WIDTH_MM * POINTS_PER_MM
    return QSizeF(width_pt, width_pt * min(max(chart.height() / max(chart.width(), 1), 0.4), 1.4))


def render_image(chart: Chart) -> QImage:
    """Return the chart as an image, 170 mm wide at 300 dpi."""
    point = DPI / 72.0
    image = QImage((_size_pt(chart) * point).toSize(), QImage.Format.Format_RGB32)
    image.setDotsPerMeterX(round(DPI / 0.0254))
    image.setDotsPerMeterY(round(DPI / 0.0254))
    image.fill(QColor(LIGHT.surface))
    _paint(chart, image, point)
    return image


def save_chart(chart: Chart, path: Path) -> None:
    """Save the chart as an image or, by the file's suffix, as SVG.

    Raises
    ------
    OutputNotWritable
            If the file cannot be written.
    """
    store = QByteArray()
    buffer = QBuffer(store)
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    if path.suffix.lower() == ".svg":
        generator, size = QSvgGenerator(), _size_pt(chart) * SVG_UNITS_PER_POINT
        generator.setOutputDevice(buffer)
        generator.setResolution(round(72.0 * SVG_UNITS_PER_POINT))
        generator.setSize(size.toSize())
        generator.setViewBox(QRectF(QPointF(), size))
        _paint(chart, generator, SVG_UNITS_PER_POINT)
    else:
        render_image(chart).save(buffer, "PNG")  # type: ignore[call-overload]
    buffer.close()
    save_private(path, bytes(store.data()))
