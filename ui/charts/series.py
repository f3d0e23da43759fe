"""Curves with a band: solid where measured, dashed where predicted, open in gaps."""

from __future__ import annotations

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
from carpus.ui.charts.axes import Panel, draw_hatching, x_px, y_px
from carpus.ui.charts.style import PlotStyle
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


def find_max_step_s(time_s: FloatArray) -> float:
    """Return how far apart two frames (N,) may lie without a frame missing between them."""
    return max(MAX_STEP_S, MAX_STEP_FRAMES * float(np.median(np.diff(time_s)))) if len(time_s) > 1 else MAX_STEP_S


@dataclass(frozen=True, slots=True)
class Curve:
    """Quantity over time with its band: solid if measured, dashed if predicted, hatched if lost."""

    series: Series
    token: str
    # False leaves gaps open.
    is_hatched: bool = True


def find_runs(flag: np.ndarray) -> list[tuple[int, int]]:
    """Return first and past-the-end index of each run of True."""
    wide = np.zeros(len(flag) + 2, dtype=np.bool_)
    wide[1:-1] = flag
    edges = np.flatnonzero(wide[1:] != wide[:-1]).tolist()
    return list(zip(edges[::2], edges[1::2], strict=True))


class CurveDrawing:
    """Curves of several panels in painter units, computed in one pass.

    Segment k joins samples k and k + 1: ``_joined`` (n - 1,) says which exist, ``_ends`` (n - 1, 4) where;
    ``_dashes`` (m, 4) are the dashes of the segments ``_dash_of`` (m,).
    """

    def __init__(self, style: PlotStyle, placed: Sequence[tuple[Panel, Sequence[Curve]]]) -> None:
        self._panels = [panel for panel, _ in placed]
        self._curves = [[curve for curve in curves if len(curve.series.value)] for _, curves in placed]
        series_list = [curve.series for own in self._curves for curve in own]
        if not series_list:
            return
        sizes = [len(one.value) for one in series_list]
        past = np.cumsum(sizes)
        self._segments = [slice(end - size, end - 1) for end, size in zip(past.tolist(), sizes, strict=True)]
        time_s = np.concatenate([one.time_s for one in series_list])
        value = np.concatenate([one.value for one in series_list])
        width = np.concatenate([np.zeros(len(one.value)) if one.sd is None else one.sd for one in series_list])
        width[~np.isfinite(width)] = 0.0
        known = np.isfinite(value)
        longest_s = np.repeat([one.max_step_s for one in series_list], sizes)
        self._joined = known[:-1] & known[1:] & (np.diff(time_s) <= longest_s[1:])
        self._joined[past[:-1] - 1] = False  # no curve goes on as the next
        panels = [panel for panel, own in zip(self._panels, self._curves, strict=True) for _ in own]
        across, down = (
            np.repeat(np.array(edges).T, sizes, axis=1)
            for edges in ([panel.x_parameters() for panel in panels], [panel.y_parameters() for panel in panels])
        )
        self._x, y = x_px(time_s, *across), y_px(value, *down)
        self._upper, self._lower = y_px(value + width, *down), y_px(value - width, *down)
        self._ends = np.array((self._x[:-1], y[:-1], self._x[1:], y[1:])).T
        predicted = np.concatenate([one.predicted for one in series_list])[1:]
        self._solid, dashed = self._joined & ~predicted, np.flatnonzero(self._joined & predicted)
        from_px = x_px(np.repeat([-one.start_s for one in series_list], sizes), *across)[dashed]
        self._dashes, segment = _compute_dashes(self._ends[dashed], from_px, DASH_PX * style.unit)
        self._dash_of = dashed[segment]

    def paint(self, painter: QPainter, style: PlotStyle, number: int) -> list[QRectF]:
        """Paint gaps, bands and lines of one panel.

        A value beyond the scale is an arrow at the edge, with its number where that covers no other.

        Returns
        -------
        list
                Rectangles of the written numbers.
        """
        curves, panel = self._curves[number], self._panels[number]
        numbers: list[QRectF] = []
        if not curves:
            return numbers
        before = sum(len(own) for own in self._curves[:number])
        placed = list(zip(curves, self._segments[before : before + len(curves)], strict=True))
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        gaps: set[tuple[int, int]] = set()
        for curve, own in placed:
            if curve.is_hatched and not self._joined[own].all():
                _paint_gaps(painter, style, panel, curve.series, gaps)
        self._paint_bands(painter, style, placed)
        self._paint_lines(painter, style, placed)
        for curve in curves:
            _paint_out_of_range(painter, style, panel, curve, numbers)
        return numbers

    def _paint_bands(self, painter: QPainter, style: PlotStyle, placed: Sequence[tuple[Curve, slice]]) -> None:
        """Paint the bands, on pixels in pieces without antialiasing: a third of the time, and seamless."""
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        longest = BAND_PIECE_POINTS if _is_raster(painter) else len(self._x)
        for curve, own in placed:
            if curve.series.sd is None:
                continue
            painter.setBrush(style.color(curve.token, BAND_ALPHA))
            for first, past in find_runs(self._joined[own]):
                for start in range(own.start + first, own.start + past, longest):
                    part = slice(start, min(start + longest, own.start + past) + 1)
                    x, around = self._x[part], np.concatenate((self._upper[part], self._lower[part][::-1]))
                    painter.drawPolygon(arrayToQPolygonF(np.concatenate((x, x[::-1])), around))
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)

    def _paint_lines(self, painter: QPainter, style: PlotStyle, placed: Sequence[tuple[Curve, slice]]) -> None:
        """Paint the lines, on pixels segment by segment: stroking a long polyline takes 5 to 70 times as long."""
        painter.setBrush(Qt.BrushStyle.NoBrush)
        pen = QPen(Qt.PenStyle.SolidLine)
        pen.setCapStyle(Qt.PenCapStyle.SquareCap)
        pen.setJoinStyle(Qt.PenJoinStyle.BevelJoin)
        on_pixels = _is_raster(painter)
        for curve, own in placed:
            pen.setColor(style.color(curve.token))
            pen.setWidthF(style.line_width)
            painter.setPen(pen)
            dashes = self._dashes[slice(*np.searchsorted(self._dash_of, (own.start, own.stop)))]
            solid = self._solid[own]
            if on_pixels:
                dashes = np.concatenate((self._ends[own][solid], dashes))
            else:
                for first, past in find_runs(solid):
                    ends = self._ends[own.start + first : own.start + past]
                    painter.drawPolyline(
                        arrayToQPolygonF(np.append(ends[0, 0], ends[:, 2]), np.append(ends[0, 1], ends[:, 3]))
                    )
            if len(dashes):  # no Python object per line: Qt reads the array, row by row
                dashes = np.ascontiguousarray(dashes)
                painter.drawLines(_wrapped(dashes.ctypes.data, QLineF), len(dashes))


def _is_raster(painter: QPainter) -> bool:
    return painter.paintEngine().type() == QPaintEngine.Type.Raster


def _compute_dashes(ends: FloatArray, from_px: FloatArray, dash: float) -> tuple[FloatArray, np.ndarray]:
    """Compute the dashes of segments.

    Parameters
    ----------
    ends
            Both ends of each segment (n, 4) in px.
    from_px
            x from which dashes are counted (n,).
    dash
            Length of a dash on a level line; it is halved for steep segments.

    Returns
    -------
    tuple
            Both ends of each dash (m, 4), and the segment of each (m,).
    """
    x0, y0, x1, y1 = ends.T
    steep = (y1 - y0) / np.maximum(x1 - x0, 1e-9)
    width = dash / 2.0 ** np.clip(np.round(0.5 * np.log2(1.0 + steep**2)), 0, MAX_HALVINGS)
    first = np.floor((x0 - from_px) / width)
    count = np.maximum(np.ceil((x1 - from_px) / width) - first, 0.0).astype(np.int64)
    segment = np.repeat(np.arange(len(ends)), count)
    cell = first[segment] + np.arange(len(segment)) - np.repeat(np.cumsum(count) - count, count)
    left = np.maximum(from_px[segment] + cell * width[segment], x0[segment])
    right = np.minimum(from_px[segment] + (cell + 1) * width[segment], x1[segment])
    shown = (cell % 2 == 0) & (right - left > MIN_DASH_PX)
    segment, left, right = segment[shown], left[shown], right[shown]
    down = steep[segment]
    return np.array(
        (left, y0[segment] + down * (left - x0[segment]), right, y0[segment] + down * (right - x0[segment]))
    ).T, segment


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
