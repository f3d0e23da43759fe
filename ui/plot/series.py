"""A curve with its band: solid where measured, dashed where predicted, open where nothing is known."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from functools import lru_cache
from itertools import pairwise

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QImage, QPaintEngine, QPainter, QPen, QPolygonF

from carpus.core.types import FloatArray
from carpus.ui.plot.axes import Panel, hatch
from carpus.ui.plot.polygon import polygon, runs
from carpus.ui.plot.style import PlotStyle
from carpus.ui.theme import BAND_ALPHA

LONGEST_STEP_S = 0.2
"""Neighbouring samples further apart than this are not joined: a gap stays a gap."""

DENSE = 1.5
"""A curve of as many samples as pixels is drawn by columns where it goes so far up and down for each of them."""
PIECE = 32
"""Points of the pieces in which a line goes onto a picture of pixels."""
DASH_COLUMNS = 4
"""Pixels of a dash in such a curve."""
FINER = 3
"""Columns to a pixel of the screen in such a curve, so that its steep parts are as smooth as a stroked line."""


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

    def from_time(self, start_s: float) -> Series:
        """The same with times counted from ``start_s``."""
        return replace(self, time_s=self.time_s - start_s)

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
    pens = pens_of(style.color(token), style.line_width)
    x, y = panel.x(series.time_s), panel.y(series.value)
    band = None
    if series.sd is not None:
        width = np.where(np.isfinite(series.sd), series.sd, 0.0)
        band = panel.y(series.value + width), panel.y(series.value - width)
    for start, stop in [(0, len(x))] if whole else series.stretches():
        part = slice(start, stop)
        edges = None if band is None else (band[0][part], band[1][part])
        columns = (x[stop - 1] - x[start]) / style.unit
        if stop - start > columns and np.abs(np.diff(y[part])).sum() > (DENSE * columns + 200.0) * style.unit:
            _paint_dense(painter, pens, x[part], y[part], edges, series.predicted[part], style.unit)
        else:
            paint_stretch(painter, pens, x[part], y[part], edges, series.predicted[part])
    _paint_beyond(painter, style, panel, series, pens.solid.color(), drawn.numbers)


@dataclass(frozen=True, slots=True)
class Pens:
    """Fill of a band, pens of what is measured and of what is predicted."""

    fill: QColor
    solid: QPen
    dashed: QPen


def pens_of(color: QColor, width: float) -> Pens:
    """How a curve of a colour is drawn."""
    fill = QColor(color)
    fill.setAlpha(BAND_ALPHA)
    # Flat and bevelled: round joins double the cost of a curve and are not seen at this width.
    solid = QPen(color, width, Qt.PenStyle.SolidLine, Qt.PenCapStyle.FlatCap, Qt.PenJoinStyle.BevelJoin)
    dashed = QPen(solid)
    dashed.setDashPattern([2.2, 2.2])
    return Pens(fill, solid, dashed)


def paint_stretch(
    painter: QPainter,
    pens: Pens,
    x: FloatArray,
    y: FloatArray,
    band: tuple[FloatArray, FloatArray] | None,
    predicted: np.ndarray,
    arc: FloatArray | None = None,
    ratio: float = 1.0,
) -> None:
    """A curve without gaps and its ``band`` (upper, lower), all (n,) in painter units: the one way a curve is drawn.

    ``arc`` (n,) is the way along the curve from where dashes begin, for a curve that is drawn bit by bit; ``ratio``
    device pixels to one of the pens' units.
    """
    if band is not None:
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(pens.fill)
        # Without antialiasing: a third of the cost, and the band's edge is translucent anyway.
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        _fill_between(painter, x, *band)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
    painter.setBrush(Qt.BrushStyle.NoBrush)
    for flag, pen in ((False, pens.solid), (True, pens.dashed)):
        of_one_kind = predicted.all() if flag else not predicted.any()
        for first, last in [(0, len(x))] if of_one_kind else runs(predicted == flag):
            # One sample of the other kind closes the join, or each change would leave a hole.
            begin = max(0, first - 1)
            own = pen
            if arc is not None or ratio != 1.0:
                own = QPen(pen)
                own.setWidthF(pen.widthF() * ratio)
                if flag and arc is not None:
                    own.setDashOffset(float(arc[begin]) / own.widthF())
            painter.setPen(own)
            _draw_line(painter, x[begin:last], y[begin:last], whole=flag or arc is not None)


def _on_pixels(painter: QPainter) -> bool:
    return painter.paintEngine().type() == QPaintEngine.Type.Raster


def _draw_line(painter: QPainter, x: FloatArray, y: FloatArray, *, whole: bool) -> None:
    """A line with the painter's pen, on pixels in pieces unless it must be ``whole``: with dashes, or bit by bit.

    To stroke one of many points takes five to ten times as long as its pieces do. These share a segment: an end has
    no join.
    """
    if whole or len(x) <= PIECE or not _on_pixels(painter):
        painter.drawPolyline(polygon(x, y))
        return
    for start in range(0, len(x) - 2, PIECE):
        painter.drawPolyline(polygon(x[start : start + PIECE + 2], y[start : start + PIECE + 2]))


def _fill_between(painter: QPainter, x: FloatArray, upper: FloatArray, lower: FloatArray) -> None:
    """Fill with the painter's brush, on pixels in pieces as a line; without antialiasing these fit without a seam."""
    piece = PIECE if _on_pixels(painter) else len(x)
    for start in range(0, max(len(x) - 1, 1), piece):
        part = slice(start, start + piece + 1)
        painter.drawPolygon(
            polygon(np.concatenate((x[part], x[part][::-1])), np.concatenate((upper[part], lower[part][::-1])))
        )


def _paint_dense(
    painter: QPainter,
    pens: Pens,
    x: FloatArray,
    y: FloatArray,
    band: tuple[FloatArray, FloatArray] | None,
    predicted: np.ndarray,
    unit: float,
) -> None:
    """As :func:`paint_stretch` where a curve goes up and down within a few pixels: column by column, from its least to
    its greatest value there.

    To stroke a line that goes to and fro in every pixel takes tens of milliseconds, to fill its columns one.
    """
    if not _on_pixels(painter):
        _paint_bars(painter, pens, x, y, band, predicted, unit)
        return
    painter.save()
    painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform, False)
    ratio = abs(painter.deviceTransform().m22())  # device pixels to one of the painter's; all below is in them
    x_px = ratio * x
    left, right = math.floor(x_px[0]) - 1, math.ceil(x_px[-1]) + 1
    if band is not None:
        edges = np.arange(left, right + 1, dtype=np.float64)
        upper, lower = (_within_columns(x_px, ratio * edge, edges) for edge in band)
        inside = (edges[1:] > x_px[0]) & (edges[:-1] < x_px[-1])
        _draw_columns(painter, left, np.where(inside, upper[0], 0.0), np.where(inside, lower[1], 0.0), pens.fill, ratio)
    edges = left + np.arange(FINER * (right - left) + 1) / FINER
    low, high = _within_columns(x_px, ratio * y, edges)
    half = ratio * pens.solid.widthF() / 2
    reach = max(round(FINER * half - 0.5), 0)
    # What the pen adds above and below, which is more on a slope, and to the sides of what is steep.
    above = half * np.hypot(1.0, np.minimum(FINER * (high - low), 1.0))
    low, high = np.minimum(low - above, _least(low, reach)), np.maximum(high + above, -_least(-high, reach))
    middle = 0.5 * (edges[1:] + edges[:-1])
    dash = np.floor(middle / (ratio * unit * DASH_COLUMNS)) % 2 == 1
    nearest = np.minimum(np.searchsorted(x_px, middle), len(x_px) - 1)
    shown = (edges[1:] > x_px[0]) & (edges[:-1] < x_px[-1]) & ~(predicted[nearest] & dash)
    _draw_columns(
        painter, left, np.where(shown, low, 0.0), np.where(shown, high, 0.0), pens.solid.color(), ratio, FINER
    )
    painter.restore()


def _within_columns(x: FloatArray, y: FloatArray, edges: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Least and greatest value (n,) of a line through the points between each two neighbours of ``edges`` (n + 1,)."""
    at_edge = np.interp(edges, x, y)
    low, high = np.minimum(at_edge[:-1], at_edge[1:]), np.maximum(at_edge[:-1], at_edge[1:])
    column = np.minimum(((x - edges[0]) / (edges[1] - edges[0])).astype(np.int64), len(low) - 1)
    first = np.flatnonzero(np.diff(column, prepend=-1))
    own = column[first]
    low[own] = np.minimum(low[own], np.minimum.reduceat(y, first))
    high[own] = np.maximum(high[own], np.maximum.reduceat(y, first))
    return low, high


def _least(value: FloatArray, reach: int) -> FloatArray:
    """The least of each value and its neighbours up to ``reach`` away."""
    out = value.copy()
    for step in range(1, reach + 1):
        np.minimum(out[step:], value[:-step], out=out[step:])
        np.minimum(out[:-step], value[step:], out=out[:-step])
    return out


def _draw_columns(
    painter: QPainter, left: int, low: FloatArray, high: FloatArray, color: QColor, ratio: float, finer: int = 1
) -> None:
    """Fill columns of device pixels from ``low`` to ``high``, so many of these to a pixel; none where both are 0."""
    filled = high > low
    if not filled.any():
        return
    top, bottom = math.floor(low[filled].min()), math.ceil(high[filled].max())
    low32, high32 = (np.where(filled, edge - top, 0.0).astype(np.float32) for edge in (low, high))
    row = np.arange(bottom - top, dtype=np.float32)[:, None]
    columns = len(low) // finer
    share = np.zeros((len(row), columns), dtype=np.float32)  # of each pixel
    for part in range(finer):
        covered = np.minimum(high32[part::finer], row + 1.0)
        covered -= np.maximum(low32[part::finer], row)
        share += np.clip(covered, 0.0, 1.0, out=covered)
    shade = (share * (255.0 / finer)).astype(np.uint8)
    picture = QImage(shade.data, columns, len(row), columns, QImage.Format.Format_Indexed8)
    picture.setColorTable(_shades(color.rgba()))
    place = QRectF(left / ratio, top / ratio, columns / ratio, len(row) / ratio)
    painter.drawImage(place, picture, QRectF(0.0, 0.0, columns, len(row)))


@lru_cache(maxsize=64)
def _shades(rgba: int) -> list[int]:
    """A colour from nothing to what it is, in 256 steps."""
    return [(rgba & 0xFFFFFF) | (round((rgba >> 24) * step / 255.0) << 24) for step in range(256)]


def _paint_bars(
    painter: QPainter,
    pens: Pens,
    x: FloatArray,
    y: FloatArray,
    band: tuple[FloatArray, FloatArray] | None,
    predicted: np.ndarray,
    unit: float,
) -> None:
    """Columns as rectangles, where vectors are wanted."""
    column = np.floor(x / unit).astype(np.int64)
    first = np.flatnonzero(np.diff(column, prepend=column[0] - 1))
    left = np.asarray(unit * column[first], dtype=np.float64)
    painter.save()
    painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
    painter.setPen(Qt.PenStyle.NoPen)
    if band is not None:
        painter.setBrush(pens.fill)
        _fill_bars(painter, left, np.minimum.reduceat(band[0], first), np.maximum.reduceat(band[1], first), unit)
    half = pens.solid.widthF() / 2
    upper, lower = np.minimum.reduceat(y, first) - half, np.maximum.reduceat(y, first) + half
    upper[:-1] = np.minimum(upper[:-1], y[first[1:]] - half)  # so that one column goes over into the next
    lower[:-1] = np.maximum(lower[:-1], y[first[1:]] + half)
    shown = ~(np.logical_and.reduceat(predicted, first) & (column[first] // DASH_COLUMNS % 2 == 1))
    painter.setBrush(pens.solid.color())
    _fill_bars(painter, left[shown], upper[shown], lower[shown], unit)
    painter.restore()


def _fill_bars(painter: QPainter, left: FloatArray, upper: FloatArray, lower: FloatArray, unit: float) -> None:
    bars = zip(left.tolist(), upper.tolist(), (lower - upper).tolist(), strict=True)
    painter.drawRects([QRectF(x, y, unit, height) for x, y, height in bars])


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
