"""The numbers beside the curves of a session: what each of them is under the cursor."""

from __future__ import annotations

import math
from collections.abc import Sequence

from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QFontMetricsF, QPainter, QPen

from carpus.ui import numbers
from carpus.ui.figures import with_side
from carpus.ui.fonts import MEDIUM, REGULAR, SEMIBOLD, font
from carpus.ui.plot.axes import Panel
from carpus.ui.plot.marks import Dot, fitted, room_at
from carpus.ui.plot.session import HandPlot, SessionPlot, Value
from carpus.ui.plot.style import PlotStyle


def paint_readings(
    painter: QPainter, style: PlotStyle, plot: SessionPlot, panels: Sequence[tuple[Panel, int]], time_s: float
) -> None:
    """Dots on the curves under the cursor and their numbers at the right; a hidden joint in the second colour."""
    shown = [plot.values(key, time_s) for _, key in panels]
    for (panel, _), values in zip(panels, shown, strict=True):
        for value in values:
            if not value.hidden:
                Dot(time_s, value.value_deg, value.token).paint(painter, style, panel)
    if plot.has_readings:
        for (panel, _), values in zip(panels, shown, strict=True):
            _paint_in_rows(painter, style, panel, values, 18.0 * _scale(style), spreads=0)
        return
    if not isinstance(plot, HandPlot):
        for (panel, _), values in zip(panels, shown, strict=True):
            _paint_named(painter, style, panel, values[0])
        return
    scale, most = _scale(style), max(map(len, shown))
    for (panel, key), values in zip(panels, shown, strict=True):
        step = (20.0 if plot.finger else 15.0) * scale
        if not plot.finger and step * most > _pitch(panels):
            _paint_in_one_line(painter, style, panel, values)
        else:
            spreads = plot.finger if key == 1 else 0
            _paint_in_rows(painter, style, panel, values, step, spreads=spreads)


def _scale(style: PlotStyle) -> float:
    return style.end_label.pixelSize() / 12.0


def _pitch(panels: Sequence[tuple[Panel, int]]) -> float:
    """From one panel to the next."""
    return panels[1][0].box.top() - panels[0][0].box.top() if len(panels) > 1 else math.inf


def _paint_named(painter: QPainter, style: PlotStyle, panel: Panel, value: Value) -> None:
    """The movement's name over its angle."""
    scale = _scale(style)
    left, middle = panel.box.right() + 14 * scale, panel.box.center().y()
    painter.setFont(font(14 * scale, REGULAR))
    painter.setPen(style.color("text2"))
    painter.setFont(fitted(painter.font(), value.name, room_at(painter, left)))
    painter.drawText(QPointF(left, middle - 4 * scale), value.name)
    if not math.isfinite(value.value_deg):
        return
    angle = numbers.degrees(value.value_deg)
    painter.setFont(font(20 * scale, SEMIBOLD))
    painter.setPen(style.color("text"))
    painter.drawText(QPointF(left, middle + 19 * scale), angle)
    across = left + QFontMetricsF(painter.font()).horizontalAdvance(angle) + 5
    painter.setFont(font(14 * scale, MEDIUM))
    painter.setPen(style.color("text2"))
    painter.drawText(QPointF(across, middle + 19 * scale), numbers.spread(value.sd_deg))


def _paint_in_rows(
    painter: QPainter, style: PlotStyle, panel: Panel, values: Sequence[Value], step: float, *, spreads: int
) -> None:
    """One under the other, each after a stroke of its curve; ``spreads``: the finger whose spreading it is, or 0."""
    scale = _scale(style)
    left, line = panel.box.right() + 12 * scale, panel.box.center().y() - step * (len(values) - 1) / 2
    for value in values:
        painter.setPen(_stroke(style, value, 2.5))
        painter.drawLine(QPointF(left, line), QPointF(left + 12 * scale, line))
        painter.setFont(font(14 * scale, MEDIUM if value.hidden else SEMIBOLD))
        painter.setPen(style.color("text2" if value.hidden else "text"))
        at = QPointF(left + 18 * scale, line + 5 * scale)
        if spreads:  # with its side, and so with no room beside it
            painter.drawText(at, with_side(value.value_deg, spreads))
            painter.setFont(font(12 * scale, MEDIUM))
            words = numbers.spread(value.sd_deg) if math.isfinite(value.value_deg) else ""
            painter.drawText(at + QPointF(0.0, 16 * scale), words)
        else:
            painter.drawText(at, value.words)
        line += step


def _paint_in_one_line(painter: QPainter, style: PlotStyle, panel: Panel, values: Sequence[Value]) -> None:
    """Side by side, each over a stroke of its curve, where there is no room for a row each."""
    scale = _scale(style)
    left, middle = panel.box.right() + 12 * scale, panel.box.center().y()
    for value in values:
        painter.setFont(font(12 * scale, MEDIUM if value.hidden else SEMIBOLD))
        painter.setPen(style.color("text2" if value.hidden else "text"))
        painter.drawText(QPointF(left, middle + 3 * scale), numbers.degrees(value.value_deg))
        painter.setPen(_stroke(style, value, 2.0))
        painter.drawLine(QPointF(left, middle + 8 * scale), QPointF(left + 22 * scale, middle + 8 * scale))
        left += 32.0 * scale


def _stroke(style: PlotStyle, value: Value, width: float) -> QPen:
    pen = QPen(style.color(value.token), width * style.unit)
    pen.setCapStyle(Qt.PenCapStyle.FlatCap)
    if value.hidden:
        pen.setDashPattern([1.6, 1.4])
    return pen
