"""A curve with its band: solid where measured, dashed where predicted, open where nothing is known."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPen, QPolygonF

from core.types import FloatArray
from ui.plot.axes import Panel, hatch
from ui.plot.polygon import polygon, runs
from ui.plot.style import PlotStyle
from ui.theme import BAND_ALPHA

LONGEST_STEP_S = 0.2
"""Neighbouring samples further apart than this are not joined: a gap stays a gap."""


@dataclass(frozen=True, slots=True)
class Series:
    """Samples of one quantity: ``time_s``, ``value``, ``sd`` (n,) with NaN where unknown; ``predicted`` bool (n,).

    Samples further apart than ``longest_step_s`` are not joined.
    """

    time_s: FloatArray
    value: FloatArray
    sd: FloatArray | None
    predicted: np.ndarray
    longest_step_s: float = LONGEST_STEP_S

    def gaps_s(self) -> list[tuple[float, float]]:
        """Times without a value, between and inside samples."""
        known = np.flatnonzero(np.isfinite(self.value))
        if len(self.time_s) == 0:
            return []
        times = np.concatenate(([self.time_s[0]], self.time_s[known], [self.time_s[-1]]))
        return [(float(a), float(b)) for a, b in pairwise(times) if b - a > self.longest_step_s]


def paint_series(
    painter: QPainter, style: PlotStyle, panel: Panel, series: Series, token: str, numbered: list[QRectF] | None = None
) -> None:
    """Gaps, band, line; measured values beyond the scale stay at its edge with an arrow, and their number where it
    covers none of ``numbered``, the numbers that stand in the panel already."""
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    _paint_gaps(painter, style, panel, series)
    color = style.color(token)
    known = np.isfinite(series.value)
    joined = np.concatenate(([False], np.diff(series.time_s) <= series.longest_step_s)) if len(series.time_s) else known
    x, y = panel.x(series.time_s), panel.y(series.value)
    # Flat and bevelled: round joins double the cost of a curve and are not seen at this width.
    solid_pen = QPen(color, style.line_width, Qt.PenStyle.SolidLine, Qt.PenCapStyle.FlatCap, Qt.PenJoinStyle.BevelJoin)
    predicted_pen = QPen(solid_pen)
    predicted_pen.setDashPattern([2.2, 2.2])
    for start, stop in _stretches(known, joined):
        part = slice(start, stop)
        if series.sd is not None:
            _paint_band(painter, panel, x[part], series.value[part], series.sd[part], color)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        for flag, pen in ((False, solid_pen), (True, predicted_pen)):
            painter.setPen(pen)
            for first, last in runs(series.predicted[part] == flag):
                # One sample of the other kind closes the join, or each change would leave a hole.
                a, b = start + max(0, first - 1), min(stop, start + last)
                painter.drawPolyline(polygon(x[a:b], y[a:b]))
    _paint_beyond(painter, style, panel, series, color, [] if numbered is None else numbered)


def _stretches(known: np.ndarray, joined: np.ndarray) -> list[tuple[int, int]]:
    """Runs of known samples, cut where the time between two is too long."""
    out: list[tuple[int, int]] = []
    for start, stop in runs(known):
        cuts = [start, *(start + 1 + np.flatnonzero(~joined[start + 1 : stop])).tolist(), stop]
        out += [(int(a), int(b)) for a, b in pairwise(cuts)]
    return out


def _paint_band(
    painter: QPainter, panel: Panel, x: FloatArray, value: FloatArray, sd: FloatArray, color: QColor
) -> None:
    width = np.where(np.isfinite(sd), sd, 0.0)
    upper, lower = panel.y(value + width), panel.y(value - width)
    fill = QColor(color)
    fill.setAlpha(BAND_ALPHA)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(fill)
    # Without antialiasing: a third of the cost, and the band's edge is translucent anyway.
    painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
    painter.drawPolygon(polygon(np.concatenate((x, x[::-1])), np.concatenate((upper, lower[::-1]))))
    painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)


def _paint_gaps(painter: QPainter, style: PlotStyle, panel: Panel, series: Series) -> None:
    for start_s, end_s in series.gaps_s():
        left, right = np.clip(panel.x(np.array([start_s, end_s])), panel.box.left(), panel.box.right())
        if right - left > 2 * style.unit:
            hatch(painter, style, QRectF(float(left), panel.box.top(), float(right - left), panel.box.height()))


def _paint_beyond(
    painter: QPainter, style: PlotStyle, panel: Panel, series: Series, color: QColor, numbered: list[QRectF]
) -> None:
    """Each measured excursion past the scale: an arrow at the edge with the extreme value."""
    with np.errstate(invalid="ignore"):
        above, below = series.value > panel.scale.high, series.value < panel.scale.low
    above, below = above & ~series.predicted, below & ~series.predicted
    for beyond, up in ((above, True), (below, False)):
        for start, stop in runs(beyond):
            part = series.value[start:stop]
            extreme = start + int(np.argmax(part) if up else np.argmin(part))
            x = float(np.clip(panel.x(series.time_s[extreme]), panel.box.left() + 8, panel.box.right() - 8))
            edge = panel.box.top() if up else panel.box.bottom()
            inward = (7 if up else -7) * style.unit
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(color)
            half = 4.5 * style.unit
            painter.drawPolygon(
                QPolygonF([QPointF(x, edge), QPointF(x - half, edge + inward), QPointF(x + half, edge + inward)])
            )
            painter.setFont(style.end_label)
            painter.setPen(color)
            metrics = QFontMetricsF(style.end_label)
            baseline = edge + inward + (metrics.ascent() if up else -metrics.descent())
            text = f"{abs(series.value[extreme]):.0f}°"
            left = x + 6 * style.unit
            if left + metrics.horizontalAdvance(text) > panel.box.right():
                left = x - 6 * style.unit - metrics.horizontalAdvance(text)
            place = QRectF(left, baseline - metrics.ascent(), metrics.horizontalAdvance(text), metrics.height())
            if not any(place.adjusted(-4, 0, 4, 0).intersects(other) for other in numbered):
                numbered.append(place)
                painter.drawText(QPointF(left, baseline), text)


def paint_point(painter: QPainter, style: PlotStyle, panel: Panel, time_s: float, value: float, token: str) -> None:
    """The newest value, or the one under the cursor, as a dot with a rim."""
    if np.isfinite(value):
        painter.setPen(QPen(style.color("surface"), 1.5 * style.unit))
        painter.setBrush(style.color(token))
        center = QPointF(float(panel.x(time_s)), float(panel.y(value)))
        painter.drawEllipse(center, 5 * style.unit, 5 * style.unit)
