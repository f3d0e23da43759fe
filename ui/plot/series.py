"""A curve with its band: solid where measured, dashed where predicted, open where nothing is known."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import Any

import numpy as np
import shiboken6
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPaintEngine, QPainter, QPen, QPolygonF

from carpus.core.types import FloatArray
from carpus.ui.plot.axes import Panel, hatch
from carpus.ui.plot.polygon import polygon, runs
from carpus.ui.plot.style import PlotStyle
from carpus.ui.theme import BAND_ALPHA

LONGEST_STEP_S = 0.2
"""Neighbouring samples further apart than this are not joined: a gap stays a gap."""

PIECE = 32
"""Points of the pieces in which a band goes onto a picture of pixels."""
DASH_PX = 4.0
"""Design pixels of a dash, and of what is left open after it, where a curve is level."""
MOST_HALVINGS = 4

_ALL = slice(None)
_wrapped: Any = shiboken6.wrapInstance


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
    start_s: float = 0.0
    """What times are counted from."""

    def from_time(self, start_s: float) -> Series:
        """The same with times counted from ``start_s``."""
        return replace(self, time_s=self.time_s - start_s, start_s=start_s)

    def is_whole(self) -> bool:
        """Whether every value is known and every two neighbours are joined, as in most of what is drawn."""
        steps = self.time_s[1:] - self.time_s[:-1]
        return bool(np.isfinite(self.value).all()) and (not len(steps) or float(steps.max()) <= self.longest_step_s)

    def gaps_s(self) -> list[tuple[float, float]]:
        """Times without a value, between and inside samples."""
        known = np.flatnonzero(np.isfinite(self.value))
        if len(self.time_s) == 0:
            return []
        times = np.concatenate(([self.time_s[0]], self.time_s[known], [self.time_s[-1]]))
        return [(float(a), float(b)) for a, b in pairwise(times) if b - a > self.longest_step_s]

    def stretches(self) -> list[tuple[int, int]]:
        """First and one-past-last index of each run of known samples, cut where the time between two is too long."""
        known = np.isfinite(self.value)
        joined = np.concatenate(([False], np.diff(self.time_s) <= self.longest_step_s)) if len(known) else known
        out: list[tuple[int, int]] = []
        for start, stop in runs(known):
            cuts = [start, *(start + 1 + np.flatnonzero(~joined[start + 1 : stop])).tolist(), stop]
            out += [(int(a), int(b)) for a, b in pairwise(cuts)]
        return out


@dataclass(frozen=True, slots=True)
class Drawn:
    """What stands in a panel already: numbers beyond its scale, and gaps by their first and last pixel."""

    numbers: list[QRectF] = field(default_factory=list)
    gaps: set[tuple[int, int]] = field(default_factory=set)


def paint_series(
    painter: QPainter, style: PlotStyle, panel: Panel, series: Series, token: str, drawn: Drawn | None = None
) -> None:
    """Gaps, band, line; measured values beyond the scale stay at its edge with an arrow, and their number where it
    covers none that is ``drawn``."""
    if not len(series.value):
        return
    drawn = Drawn() if drawn is None else drawn
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    whole = series.is_whole()
    if not whole:
        _paint_gaps(painter, style, panel, series, drawn.gaps)
    color, from_px = style.color(token), float(panel.x(-series.start_s))
    x, y = panel.x(series.time_s), panel.y(series.value)
    band = None
    if series.sd is not None:
        width = np.where(np.isfinite(series.sd), series.sd, 0.0)
        band = panel.y(series.value + width), panel.y(series.value - width)
    for start, stop in [(0, len(x))] if whole else series.stretches():
        part = slice(start, stop)
        edges = None if band is None else (band[0][part], band[1][part])
        _paint_stretch(painter, style, color, x[part], y[part], edges, series.predicted[part], from_px)
    _paint_beyond(painter, style, panel, series, color, drawn.numbers)


def _paint_stretch(
    painter: QPainter,
    style: PlotStyle,
    color: QColor,
    x: FloatArray,
    y: FloatArray,
    band: tuple[FloatArray, FloatArray] | None,
    predicted: np.ndarray,
    from_px: float,
) -> None:
    """A curve without gaps and its ``band`` (upper, lower), all (n,) in painter units; dashes are counted from
    ``from_px``, so that they go along with a curve that runs through its panel."""
    if band is not None:
        fill = QColor(color)
        fill.setAlpha(BAND_ALPHA)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(fill)
        # Without antialiasing: a third of the cost, and the band's edge is translucent anyway.
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        _fill_between(painter, x, *band)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(
        QPen(color, style.line_width, Qt.PenStyle.SolidLine, Qt.PenCapStyle.SquareCap, Qt.PenJoinStyle.BevelJoin)
    )
    dash = DASH_PX * style.unit
    for flag in (False, True):
        for first, last in runs(predicted == flag):
            # One sample of the other kind closes the join, or each change would leave a hole.
            part = slice(max(0, first - 1), last)
            if flag:
                _draw_dashes(painter, x[part], y[part], from_px, dash)
            elif _on_pixels(painter):
                _draw_segments(painter, x[part], y[part])
            else:
                painter.drawPolyline(polygon(x[part], y[part]))


def _on_pixels(painter: QPainter) -> bool:
    return painter.paintEngine().type() == QPaintEngine.Type.Raster


def _draw_segments(painter: QPainter, x: FloatArray, y: FloatArray, shown: np.ndarray | slice = _ALL) -> None:
    """A line piece by piece, as pyqtgraph draws it on pixels: to stroke one of many points takes five times as long,
    of one that goes to and fro in every pixel seventy times. No Python object per piece: Qt reads the array."""
    ends = np.ascontiguousarray(np.array((x[:-1], y[:-1], x[1:], y[1:])).T[shown])
    if len(ends):
        painter.drawLines(_wrapped(ends.ctypes.data, QLineF), len(ends))


def _draw_dashes(painter: QPainter, x: FloatArray, y: FloatArray, from_px: float, dash: float) -> None:
    """Every second of the stretches that are ``dash`` wide, or a half, a quarter ... of it where it is steep."""
    if len(x) < 2:
        return
    steep = np.diff(y) / np.maximum(np.diff(x), 1e-9)
    finer = 2.0 ** np.clip(np.round(0.5 * np.log2(1.0 + steep**2)), 0, MOST_HALVINGS)
    least = dash / finer.max()
    edges = from_px + least * np.arange(np.ceil((x[0] - from_px) / least), np.ceil((x[-1] - from_px) / least))
    at = np.sort(np.concatenate((x, edges)))
    middle = 0.5 * (at[1:] + at[:-1])
    own = finer[np.minimum(np.searchsorted(x, middle), len(finer)) - 1]
    shown = np.floor((middle - from_px) * own / dash) % 2 == 0
    _draw_segments(painter, at, np.interp(at, x, y), shown)


def _fill_between(painter: QPainter, x: FloatArray, upper: FloatArray, lower: FloatArray) -> None:
    """Fill with the painter's brush; on pixels in pieces, which takes half as long and without antialiasing fits."""
    piece = PIECE if _on_pixels(painter) else len(x)
    for start in range(0, max(len(x) - 1, 1), piece):
        part = slice(start, start + piece + 1)
        painter.drawPolygon(
            polygon(np.concatenate((x[part], x[part][::-1])), np.concatenate((upper[part], lower[part][::-1])))
        )


def _paint_gaps(
    painter: QPainter, style: PlotStyle, panel: Panel, series: Series, hatched: set[tuple[int, int]]
) -> None:
    gaps_s = series.gaps_s()
    if not gaps_s:
        return
    for left, right in np.clip(panel.x(np.array(gaps_s)), panel.box.left(), panel.box.right()).tolist():
        pixels = round(left / style.unit), round(right / style.unit)
        if right - left > 2 * style.unit and pixels not in hatched:
            hatched.add(pixels)
            hatch(painter, style, QRectF(left, panel.box.top(), right - left, panel.box.height()))


def _paint_beyond(
    painter: QPainter, style: PlotStyle, panel: Panel, series: Series, color: QColor, numbered: list[QRectF]
) -> None:
    """Each measured excursion past the scale: an arrow at the edge with the extreme value."""
    low, high = float(np.fmin.reduce(series.value)), float(np.fmax.reduce(series.value))
    if panel.scale.low <= low and high <= panel.scale.high:
        return
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
