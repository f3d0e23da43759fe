"""A curve with its band: solid where measured, dashed where predicted, open where nothing is known."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPen, QPolygonF

from carpus.core.types import FloatArray
from carpus.ui.plot.axes import Panel, hatch
from carpus.ui.plot.polygon import polygon, runs
from carpus.ui.plot.style import PlotStyle
from carpus.ui.theme import BAND_ALPHA

LONGEST_STEP_S = 0.2
"""Neighbouring samples further apart than this are not joined: a gap stays a gap."""

DENSE = 7.0
"""How far up and down a curve goes for each pixel along, from which on it is drawn by columns."""
DASH_COLUMNS = 4
"""Pixels of a dash in such a curve."""


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


def paint_series(
    painter: QPainter, style: PlotStyle, panel: Panel, series: Series, token: str, numbered: list[QRectF] | None = None
) -> None:
    """Gaps, band, line; measured values beyond the scale stay at its edge with an arrow, and their number where it
    covers none of ``numbered``, the numbers that stand in the panel already."""
    if not len(series.value):
        return
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    whole = series.is_whole()
    if not whole:
        _paint_gaps(painter, style, panel, series)
    pens = pens_of(style.color(token), style.line_width)
    x, y = panel.x(series.time_s), panel.y(series.value)
    band = None
    if series.sd is not None:
        width = np.where(np.isfinite(series.sd), series.sd, 0.0)
        band = panel.y(series.value + width), panel.y(series.value - width)
    for start, stop in [(0, len(x))] if whole else series.stretches():
        part = slice(start, stop)
        edges = None if band is None else (band[0][part], band[1][part])
        if np.abs(np.diff(y[part])).sum() > DENSE * (x[stop - 1] - x[start]) + 500.0 * style.unit:
            _paint_dense(painter, pens, x[part], y[part], edges, series.predicted[part], style.unit)
        else:
            paint_stretch(painter, pens, x[part], y[part], edges, series.predicted[part])
    _paint_beyond(painter, style, panel, series, pens.solid.color(), [] if numbered is None else numbered)


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
        painter.drawPolygon(polygon(np.concatenate((x, x[::-1])), np.concatenate((band[0], band[1][::-1]))))
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
            painter.drawPolyline(polygon(x[begin:last], y[begin:last]))


def _paint_dense(
    painter: QPainter,
    pens: Pens,
    x: FloatArray,
    y: FloatArray,
    band: tuple[FloatArray, FloatArray] | None,
    predicted: np.ndarray,
    unit: float,
) -> None:
    """As :func:`paint_stretch` where there are more samples than pixels: from the least to the greatest of each column.

    To stroke a line that goes to and fro in every pixel takes tens of milliseconds, to fill its columns one or two.
    """
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


def _paint_gaps(painter: QPainter, style: PlotStyle, panel: Panel, series: Series) -> None:
    for start_s, end_s in series.gaps_s():
        left, right = np.clip(panel.x(np.array([start_s, end_s])), panel.box.left(), panel.box.right())
        if right - left > 2 * style.unit:
            hatch(painter, style, QRectF(float(left), panel.box.top(), float(right - left), panel.box.height()))


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
