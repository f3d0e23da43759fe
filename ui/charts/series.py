"""Curves with a band: solid where measured, dashed where predicted, open in gaps."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np
import shiboken6
from pyqtgraph.functions import arrayToQPolygonF
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QFontMetricsF, QPaintEngine, QPainter, QPen, QPolygonF

from carpus.core.model.rounding import format_rounded
from carpus.core.model.types import FloatArray
from carpus.ui.charts.panel import Panel, PlotStyle, draw_hatching
from carpus.ui.kit.theme import BAND_ALPHA

# Samples further apart than this are not joined.
MAX_STEP_S = 0.2
# The same for recordings of low frame rate, in frame intervals.
MAX_STEP_FRAMES = 1.75

# A band is drawn on pixels in pieces of so many points.
BAND_PIECE_POINTS = 256
# Length of a dash and of its gap on a level curve, in design pixels.
DASH_PX = 4.0
MAX_HALVINGS = 4
# A shorter rest of a dash, left by rounding, would show as a blot.
MIN_DASH_PX = 1e-6

_wrapped: Any = shiboken6.wrapInstance


@dataclass(frozen=True, slots=True)
class Series:
    """Samples of one quantity over time.

    Parameters
    ----------
    time_s, value, sd
            Arrays (n,); NaN where unknown. ``sd`` is None for a quantity without one.
    predicted
            True where the value was not measured (n,).
    max_step_s
            Samples further apart are not joined.
    start_s
            Time that ``time_s`` counts from.
    """

    time_s: FloatArray
    value: FloatArray
    sd: FloatArray | None
    predicted: np.ndarray
    max_step_s: float = MAX_STEP_S
    start_s: float = 0.0

    def shift_time(self, start_s: float) -> Series:
        """Return the series with times counted from ``start_s``."""
        return replace(self, time_s=self.time_s - start_s, start_s=start_s)

    def select_rows(self, rows: slice | np.ndarray) -> Series:
        sd = None if self.sd is None else self.sd[rows]
        return replace(self, time_s=self.time_s[rows], value=self.value[rows], sd=sd, predicted=self.predicted[rows])

    def gaps_s(self) -> list[tuple[float, float]]:
        """Return start and end of each gap."""
        known = np.flatnonzero(np.isfinite(self.value))
        if len(self.time_s) == 0:
            return []
        times = np.concatenate(([self.time_s[0]], self.time_s[known], [self.time_s[-1]]))
        return [(float(a), float(b)) for a, b in pairwise(times) if b - a > self.max_step_s]

    def read_value(self, time_s: float) -> tuple[float, float, bool]:
        """Return value, SD and whether it was not measured at the nearest sample; NaN in a gap."""
        row = find_nearest_row(self.time_s, time_s)
        if row < 0 or self.sd is None or abs(float(self.time_s[row]) - time_s) > self.max_step_s:
            return math.nan, math.nan, True
        return float(self.value[row]), float(self.sd[row]), bool(self.predicted[row])


def find_nearest_row(time_s: FloatArray, at_s: float) -> int:
    """Return the row of the frame nearest to a time, -1 if there are none."""
    return int(np.abs(time_s - at_s).argmin()) if len(time_s) else -1


def find_max_step_s(time_s: FloatArray) -> float:
    """Return how far apart two frames (N,) may lie without a frame missing between them."""
    return max(MAX_STEP_S, MAX_STEP_FRAMES * float(np.median(np.diff(time_s)))) if len(time_s) > 1 else MAX_STEP_S


@dataclass(frozen=True, slots=True)
class Curve:
    """Quantity over time with its band: solid if measured, dashed if predicted, hatched if lost."""

    series: Series
    token: str


def find_runs(flag: np.ndarray) -> list[tuple[int, int]]:
    """Return first and past-the-end index of each run of True."""
    wide = np.zeros(len(flag) + 2, dtype=np.bool_)
    wide[1:-1] = flag
    edges = np.flatnonzero(wide[1:] != wide[:-1]).tolist()
    return list(zip(edges[::2], edges[1::2], strict=True))


class _PlacedCurve:
    """Curve in painter units.

    Segment k joins samples k and k + 1: ``joined`` (n - 1,) says which exist, ``ends`` (n - 1, 4) where, ``solid``
    (n - 1,) which of them were measured; ``dashes`` (m, 4) are those of the others.
    """

    def __init__(self, style: PlotStyle, panel: Panel, curve: Curve) -> None:
        self.curve, series = curve, curve.series
        known = np.isfinite(series.value)
        self.joined = known[:-1] & known[1:] & (np.diff(series.time_s) <= series.max_step_s)
        self.x, y = panel.x(series.time_s), panel.y(series.value)
        self.ends = np.array((self.x[:-1], y[:-1], self.x[1:], y[1:])).T
        self.solid, dashed = self.joined & ~series.predicted[1:], self.joined & series.predicted[1:]
        self.dashes = _compute_dashes(self.ends[dashed], float(panel.x(-series.start_s)), DASH_PX * style.unit)
        if series.sd is not None:
            half = np.where(np.isfinite(series.sd), series.sd, 0.0)
            self.upper, self.lower = panel.y(series.value + half), panel.y(series.value - half)


def draw_curves(painter: QPainter, style: PlotStyle, panel: Panel, curves: Sequence[Curve]) -> None:
    """Draw gaps, bands and lines of the curves of a panel.

    A value beyond the scale is an arrow at the edge, with its number where that covers no other.
    """
    placed = [_PlacedCurve(style, panel, curve) for curve in curves if len(curve.series.value)]
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    gaps, numbers = set[tuple[int, int]](), list[QRectF]()
    for one in placed:
        if not one.joined.all():
            _paint_gaps(painter, style, panel, one.curve.series, gaps)
    _paint_bands(painter, style, placed)
    _paint_lines(painter, style, placed)
    for one in placed:
        _paint_out_of_range(painter, style, panel, one.curve, numbers)


def _paint_bands(painter: QPainter, style: PlotStyle, placed: Sequence[_PlacedCurve]) -> None:
    """Paint the bands, on pixels in pieces without antialiasing: a third of the time, and seamless."""
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
    for one in placed:
        if one.curve.series.sd is None:
            continue
        painter.setBrush(style.color(one.curve.token, BAND_ALPHA))
        longest = BAND_PIECE_POINTS if _is_raster(painter) else len(one.x)
        for first, past in find_runs(one.joined):
            for start in range(first, past, longest):
                part = slice(start, min(start + longest, past) + 1)
                x, around = one.x[part], np.concatenate((one.upper[part], one.lower[part][::-1]))
                painter.drawPolygon(arrayToQPolygonF(np.concatenate((x, x[::-1])), around))
    painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)


def _paint_lines(painter: QPainter, style: PlotStyle, placed: Sequence[_PlacedCurve]) -> None:
    """Paint the lines, on pixels segment by segment: stroking a long polyline takes 5 to 70 times as long."""
    painter.setBrush(Qt.BrushStyle.NoBrush)
    pen = QPen(Qt.PenStyle.SolidLine)
    pen.setCapStyle(Qt.PenCapStyle.SquareCap)
    pen.setJoinStyle(Qt.PenJoinStyle.BevelJoin)
    for one in placed:
        pen.setColor(style.color(one.curve.token))
        pen.setWidthF(style.line_width)
        painter.setPen(pen)
        lines = one.dashes
        if _is_raster(painter):
            lines = np.concatenate((one.ends[one.solid], lines))
        else:
            for first, past in find_runs(one.solid):
                ends = one.ends[first:past]
                painter.drawPolyline(
                    arrayToQPolygonF(np.append(ends[0, 0], ends[:, 2]), np.append(ends[0, 1], ends[:, 3]))
                )
        if len(lines):  # no Python object per line: Qt reads the array, row by row
            lines = np.ascontiguousarray(lines)
            painter.drawLines(_wrapped(lines.ctypes.data, QLineF), len(lines))


def _is_raster(painter: QPainter) -> bool:
    return painter.paintEngine().type() == QPaintEngine.Type.Raster


def _compute_dashes(ends: FloatArray, from_px: float, dash: float) -> FloatArray:
    """Return both ends (m, 4) of the dashes of segments.

    Parameters
    ----------
    ends
            Both ends of each segment (n, 4) in px.
    from_px
            x from which dashes are counted.
    dash
            Length of a dash on a level line; it is halved for steep segments.
    """
    x0, y0, x1, y1 = ends.T
    steep = (y1 - y0) / np.maximum(x1 - x0, 1e-9)
    width = dash / 2.0 ** np.clip(np.round(0.5 * np.log2(1.0 + steep**2)), 0, MAX_HALVINGS)
    first = np.floor((x0 - from_px) / width)
    count = np.maximum(np.ceil((x1 - from_px) / width) - first, 0.0).astype(np.int64)
    segment = np.repeat(np.arange(len(ends)), count)
    cell = first[segment] + np.arange(len(segment)) - np.repeat(np.cumsum(count) - count, count)
    left = np.maximum(from_px + cell * width[segment], x0[segment])
    right = np.minimum(from_px + (cell + 1) * width[segment], x1[segment])
    shown = (cell % 2 == 0) & (right - left > MIN_DASH_PX)
    segment, left, right = segment[shown], left[shown], right[shown]
    down, x0, y0 = steep[segment], x0[segment], y0[segment]
    return np.array((left, y0 + down * (left - x0), right, y0 + down * (right - x0))).T


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
            draw_hatching(painter, style, QRectF(left, panel.box.top(), right - left, panel.box.height()))


def _paint_out_of_range(
    painter: QPainter, style: PlotStyle, panel: Panel, curve: Curve, numbered: list[QRectF]
) -> None:
    """Mark each measured excursion beyond the scale by an arrow with its extreme value."""
    series, color = curve.series, style.color(curve.token)
    low, high = float(np.fmin.reduce(series.value)), float(np.fmax.reduce(series.value))
    if panel.scale.low <= low and high <= panel.scale.high:
        return
    with np.errstate(invalid="ignore"):
        above, below = series.value > panel.scale.high, series.value < panel.scale.low
    above, below = above & ~series.predicted, below & ~series.predicted
    for beyond, up in ((above, True), (below, False)):
        for start, stop in find_runs(beyond):
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
            painter.setFont(style.end_label_font)
            painter.setPen(color)
            metrics = QFontMetricsF(style.end_label_font)
            baseline = edge + inward + (metrics.ascent() if up else -metrics.descent())
            text = f"{format_rounded(abs(series.value[extreme]))}°"
            left = x + 6 * style.unit
            if left + metrics.horizontalAdvance(text) > panel.box.right():
                left = x - 6 * style.unit - metrics.horizontalAdvance(text)
            place = QRectF(left, baseline - metrics.ascent(), metrics.horizontalAdvance(text), metrics.height())
            if not any(place.adjusted(-4, 0, 4, 0).intersects(other) for other in numbered):
                numbered.append(place)
                painter.drawText(QPointF(left, baseline), text)


POINTS_PER_COLUMN = 2


# Kept samples lie up to two stretches apart, slightly more where frames are missing.
MAX_STRETCHES = 3.0


def decimate(series: Series, columns: int) -> Series:
    """Keep at most the smallest and the largest sample of each of ``columns`` equal stretches.

    A stretch without a value keeps one NaN, so that gaps stay; the widest band of a stretch is kept.
    """
    count = len(series.time_s)
    if count <= POINTS_PER_COLUMN * columns:
        return series
    stretch_s = float(np.median(np.diff(series.time_s))) * count / columns
    series = _insert_gaps(series)
    count = len(series.time_s)
    size = -(-count // columns)
    rows = -(-count // size)
    first = size * np.arange(rows)
    flat = np.full(rows * size, np.nan)
    flat[:count] = series.value
    value = flat.reshape(rows, size)
    known = np.isfinite(value)
    inside = np.arange(rows * size).reshape(rows, size) < count
    some, gap = known.any(axis=1), (~known & inside).any(axis=1)
    lowest = first + np.where(known, value, np.inf).argmin(axis=1)
    highest = first + np.where(known, value, -np.inf).argmax(axis=1)
    unknown = first + (~known & inside).argmax(axis=1)
    is_kept = np.zeros(count, dtype=bool)
    for index in (
        lowest[some], highest[some], unknown[gap & some], first[~some], np.minimum(first + size, count)[~some] - 1,
    ):  # fmt: skip
        is_kept[index] = True
    index = np.flatnonzero(is_kept)
    sd = None
    if series.sd is not None:
        spread = np.full(rows * size, -np.inf)
        spread[:count] = np.where(np.isfinite(series.sd), series.sd, -np.inf)
        widest = spread.reshape(rows, size).max(axis=1)[index // size]
        sd = np.where(np.isfinite(widest), widest, np.nan)
    longest_s = max(series.max_step_s, MAX_STRETCHES * stretch_s)
    return replace(series.select_rows(index), sd=sd, max_step_s=longest_s)


def slice_time(series: Series, start_s: float, end_s: float) -> Series:
    """Return the samples of a time span, with one beyond each end so that lines reach the edge."""
    first = max(int(np.searchsorted(series.time_s, start_s)) - 1, 0)
    last = int(np.searchsorted(series.time_s, end_s, side="right")) + 1
    if first == 0 and last >= len(series.time_s):
        return series
    return series.select_rows(slice(first, last))


def _insert_gaps(series: Series) -> Series:
    """Insert a NaN sample in the middle of each step that is too long to be joined."""
    before = np.flatnonzero(np.diff(series.time_s) > series.max_step_s)
    if not len(before):
        return series
    middle_s = 0.5 * (series.time_s[before] + series.time_s[before + 1])
    sd = None if series.sd is None else np.insert(series.sd, before + 1, np.nan)
    time_s, value = np.insert(series.time_s, before + 1, middle_s), np.insert(series.value, before + 1, np.nan)
    return replace(series, time_s=time_s, value=value, sd=sd, predicted=np.insert(series.predicted, before + 1, False))
