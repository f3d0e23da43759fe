"""Export of a chart: PNG and SVG at print size on white."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QBuffer, QByteArray, QIODevice, QRectF, QSize
from PySide6.QtGui import QColor, QImage, QPainter
from PySide6.QtSvg import QSvgGenerator

from carpus.ui.charts.style import paper_style
from carpus.ui.kit.table_file import save_private
from carpus.ui.kit.theme import LIGHT

if TYPE_CHECKING:
    from carpus.ui.charts.chart import Chart

# Width of a page's text, at print resolution.
WIDTH_MM, DPI = 170.0, 300.0
SVG_UNITS_PER_POINT = 10.0
MARGIN_PT = 8.0
POINTS_PER_MM = 72.0 / 25.4


def _size_pt(chart: Chart) -> tuple[float, float]:
    width_pt = WIDTH_MM * POINTS_PER_MM
    return width_pt, width_pt * min(max(chart.height() / max(chart.width(), 1), 0.4), 1.4)


def _paint(painter: QPainter, chart: Chart, point: float) -> None:
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    width_pt, height_pt = _size_pt(chart)
    margin = MARGIN_PT * point
    box = QRectF(0.0, 0.0, width_pt * point, height_pt * point)
    chart.render_on_paper(painter, paper_style(point), box.adjusted(margin, margin, -margin, -margin))


def render_image(chart: Chart) -> QImage:
    """Return the chart as an image, 170 mm wide at 300 dpi."""
    point = DPI / 72.0
    width_pt, height_pt = _size_pt(chart)
    image = QImage(round(width_pt * point), round(height_pt * point), QImage.Format.Format_RGB32)
    image.setDotsPerMeterX(round(DPI / 0.0254))
    image.setDotsPerMeterY(round(DPI / 0.0254))
    image.fill(QColor(LIGHT.surface))
    painter = QPainter(image)
    _paint(painter, chart, point)
    painter.end()
    return image


def render_svg(chart: Chart) -> bytes:
    """Return the chart as SVG."""
    point = SVG_UNITS_PER_POINT
    width_pt, height_pt = _size_pt(chart)
    store = QByteArray()
    buffer = QBuffer(store)
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    generator = QSvgGenerator()
    generator.setOutputDevice(buffer)
    generator.setResolution(round(72.0 * point))
    generator.setSize(QSize(round(width_pt * point), round(height_pt * point)))
    generator.setViewBox(QRectF(0.0, 0.0, width_pt * point, height_pt * point))
    painter = QPainter(generator)
    _paint(painter, chart, point)
    painter.end()
    buffer.close()
    return bytes(store.data())


def save_chart(chart: Chart, path: Path) -> None:
    """Save the chart in the format of the file's suffix.

    Raises
    ------
    OutputNotWritable
            If the file cannot be written.
    """
    if path.suffix.lower() == ".svg":
        content = render_svg(chart)
    else:
        store = QByteArray()
        buffer = QBuffer(store)
        buffer.open(QIODevice.OpenModeFlag.WriteOnly)
        render_image(chart).save(buffer, "PNG")  # type: ignore[call-overload]
        content = bytes(store.data())
    save_private(path, content)
