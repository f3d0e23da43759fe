"""Curves of a whole session with its repetitions, wrist or fingers, for screen and paper."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QFontMetricsF, QPainter

from carpus.core.model.hand.exercises import FLEXION, PRONOSUPINATION, Exercise
from carpus.core.model.hand.forearm_rotation import axis_limits_deg, is_counted_from_thumb_up
from carpus.core.model.hand.kinematics import DIP_PER_PIP
from carpus.core.model.rounding import format_rounded
from carpus.core.model.types import FloatArray, TrackStatus
from carpus.core.results.repetition_rows import RepetitionResult
from carpus.core.results.valid_data import JointCurves, WristCurves
from carpus.ui.charts import axes
from carpus.ui.charts.axes import Panel, Scale
from carpus.ui.charts.chart import (
    GROUND,
    AxisLabel,
    ChartText,
    Curves,
    Hatching,
    HoverLabel,
    Plot,
    fit_font,
    scale_labels,
    span_html,
)
from carpus.ui.charts.series import Curve, Series, decimate, find_max_step_s, slice_time
from carpus.ui.charts.style import PlotStyle
from carpus.ui.charts.zoom_chart import ZoomChart
from carpus.ui.kit import numbers
from carpus.ui.kit.fonts import MEDIUM, REGULAR, SEMIBOLD, font
from carpus.ui.kit.theme import CURVE_TOKENS, Theme
from carpus.ui.kit.translate import tr
from carpus.ui.words import terms
from carpus.ui.words.finger_angles import FINGERS, AngleKind, FingerAngle, format_spread, spread_labels
from carpus.ui.words.terms import finger_name

# Shown before the first and after the last repetition when zoomed to them.
MARGIN_S = 1.0
# A repetition cannot be made shorter.
MIN_REPETITION_S = 0.2
MIN_POINTS = 200
FLEXION_KINDS: tuple[AngleKind, ...] = ("knuckle", "middle", "end")


def add_targets(plot: Plot, positive_deg: float, negative_deg: float) -> None:
    """Add the lines of the targets that exist, in degrees of their own direction.

    Their labels lie beyond the line, where no curve comes from.
    """
    words = tr("Goal {angle}")
    for value, way in ((positive_deg, 1), (negative_deg, -1)):
        text = words.format(angle=numbers.format_signed_degrees(way * value)) if math.isfinite(value) else ""
        plot.add_horizontal_line(value, "accent", (6.0, 4.0), text, below=way < 0)


def add_panel_name(plot: Plot, words: str, *, above: bool = False) -> None:
    """Write the name of a panel at its left; with ``above`` beside its upper end."""
    look, box = plot.plot_style, plot.panel.box
    scale = look.end_label_font.pixelSize() / 12.0
    item = plot.chart.add_text(words, look.end_label_font, "text", (0.0, 0.5))
    left = plot.chart.area.left() if plot.chart.is_printing else box.left() - 102 * scale
    item.setPos(left, box.top() + 6 * scale if above else box.center().y())


def add_limits(plot: Plot, exercise: Exercise, key: int, *, is_first: bool) -> None:
    """Add the band that an untrained angle should stay in, or say where forearm rotation is counted from."""
    limit = exercise.trick_limit_deg
    if not is_first and math.isfinite(limit):
        plot.add_band(-limit, limit, "norm")
        room = float(plot.panel.y(limit)) - plot.panel.box.top()
        if room >= QFontMetricsF(plot.plot_style.end_label_font).height():  # a low panel has the band alone
            plot.add_label(limit, tolerance_words(limit, key))
    elif key == PRONOSUPINATION:
        is_from_thumb_up = is_counted_from_thumb_up(exercise)
        words = tr("0° = thumb up") if is_from_thumb_up else tr("rotation from the start, + = thumb side up")
        plot.add_label(0.0, words, small=True)


def missing_value_words() -> str:
    """Return the text for an unknown value."""
    return tr("no value")


def angle_group_names() -> tuple[str, str]:
    """Return the names of the two groups of finger angles."""
    return tr("Flexion"), tr("Abduction")


def tolerance_words(limit_deg: float, key: int) -> str:
    """Say that an angle should hardly move."""
    within = tr("should stay within {angle}").format(angle=numbers.format_degrees(limit_deg))
    return within if key != PRONOSUPINATION else tr("from the start, + = thumb side up; {within}").format(within=within)


@dataclass(frozen=True, slots=True)
class Value:
    """Value of one curve at a time in degrees; NaN in a gap."""

    name: str
    token: str
    value_deg: float
    sd_deg: float
    is_occluded: bool = False

    @property
    def display_text(self) -> str:
        """Text such as ``42° ± 2°``."""
        return numbers.format_with_sd(self.value_deg, self.sd_deg)


@dataclass(frozen=True, slots=True)
class SessionPlot:
    """Wrist angles of a session with its exercise, repetitions and the current one (-1 for none)."""

    curves: WristCurves
    exercise: Exercise
    repetitions: Sequence[RepetitionResult]
    current: int = -1
    target_positive_deg: float = math.nan
    target_negative_deg: float = math.nan
    # Visible time span; None for all of it.
    window_s: tuple[float, float] | None = None

    @property
    def visible_s(self) -> tuple[float, float]:
        return self.window_s or (0.0, self.end_s)

    @property
    def repetition_span_s(self) -> tuple[float, float]:
        """Time span of the repetitions with a margin; the whole session if there are none."""
        if not self.repetitions:
            return 0.0, self.end_s
        start_s, end_s = self.repetitions[0].start_s, max(repetition.end_s for repetition in self.repetitions)
        return max(start_s - MARGIN_S, 0.0), min(end_s + MARGIN_S, self.end_s)

    @property
    def end_s(self) -> float:
        return max(float(self.curves.time_s[-1]), 1.0) if len(self.curves.time_s) else 1.0

    def panel_order(self) -> list[int]:
        first = FLEXION if self.exercise.angle is None else self.exercise.angle
        return [first, *[k for k in (FLEXION, 0, PRONOSUPINATION) if k != first]]

    def series(self, column: int) -> Series:
        curves = self.curves
        return Series(
            curves.time_s,
            curves.angles_deg[:, column],
            curves.sds_deg[:, column],
            curves.status == TrackStatus.PREDICTED,
            find_max_step_s(curves.time_s),
        )

    # --- what is drawn ------------------------------------------------------------------------------------
    def panels(self, box: QRectF, between: float, *, single: bool = False) -> list[tuple[Panel, int]]:
        """Return three panels with the column of each, the trained angle twice as high; or that one alone."""
        order = self.panel_order()[: 1 if single else 3]
        unit = (box.height() - between * (len(order) - 1)) / (len(order) + 1)
        top, out = box.top(), []
        for place, column in enumerate(order):
            height = unit * (2 if place == 0 else 1)
            names = terms.direction_names(column, self.exercise)
            scale = axes.angle_scale(*axis_limits_deg(column, self.exercise), *names, is_sparse=place > 0)
            out.append((Panel(QRectF(box.left(), top, box.width(), height), scale, *self.visible_s), column))
            top += height + between
        return out

    def add_background(self, plot: Plot, place: int, key: int) -> None:
        """Add what lies behind the curves of a panel."""
        add_limits(plot, self.exercise, key, is_first=place == 0)
        plot.add_grid()
        if place == 0:
            add_targets(plot, self.target_positive_deg, self.target_negative_deg)

    def visible_curves(self, key: int, points: int) -> list[Curve]:
        """Return the curves of a panel over the visible time, of about ``points`` points each."""
        return self._curves(self.series(key), CURVE_TOKENS[key], points)

    def _curves(self, series: Series, token: str, points: int) -> list[Curve]:
        """Return a curve in its colour during the repetitions, and what is visible before and after them in grey."""
        start_s, end_s = self.visible_s
        first_s, last_s = start_s, end_s
        if self.repetitions:
            first_s, last_s = self.repetitions[0].start_s, max(repetition.end_s for repetition in self.repetitions)
        parts = (start_s, min(first_s, end_s), "border"), (max(last_s, start_s), end_s, "border")
        return [
            Curve(decimate(slice_time(series, low_s, high_s), max(MIN_POINTS, points)), shown)
            for low_s, high_s, shown in (*parts, (max(first_s, start_s), min(last_s, end_s), token))
            if low_s < high_s
        ]

    def read_values(self, key: int, time_s: float) -> list[Value]:
        value, sd = read_wrist_angle(self.curves, key, time_s)
        name = terms.direction_name(key, value, self.exercise) if math.isfinite(value) else missing_value_words()
        return [Value(name, CURVE_TOKENS[key], value, sd)]


@dataclass(frozen=True, slots=True)
class HandPlot(SessionPlot):
    """Session plot of the finger joints; ``finger`` 1 to 5, or 0 for all of them."""

    joints: JointCurves | None = None
    finger: int = 0
    # Of :meth:`joint_series`, which is called at every step of the wheel.
    _series_cache: dict[FingerAngle, tuple[JointCurves, Series | None]] = field(
        default_factory=dict, repr=False, compare=False
    )

    def panel_angles(self, panel: int) -> list[FingerAngle]:
        if self.finger and panel == 1:
            return [FingerAngle(self.finger, "spread")]
        return [FingerAngle(self.finger or FINGERS[panel], row) for row in FLEXION_KINDS]

    def joint_series(self, angle: FingerAngle) -> Series | None:
        """Return a joint's series, dashed where occluded; None if it is neither measured nor coupled."""
        joints = self.joints
        assert joints is not None
        cached_joints, found = self._series_cache.get(angle, (None, None))
        if cached_joints is not joints:
            found = _joint_series(joints, angle)
            self._series_cache[angle] = joints, found
        return found

    def is_coupled(self, angle: FingerAngle) -> bool:
        return self.joints is not None and angle.joint not in self.joints.names

    def panels(self, box: QRectF, between: float, *, single: bool = False) -> list[tuple[Panel, int]]:
        """Return a panel for each finger, or flexion over spreading; ``single`` omits the spreading."""
        weights = (2.0, 1.0)[: 1 if single else 2] if self.finger else (1.0,) * len(FINGERS)
        unit = (box.height() - between * (len(weights) - 1)) / sum(weights)
        top, out = box.top(), []
        for place, weight in enumerate(weights):
            spread = bool(self.finger) and place == 1
            area = QRectF(box.left(), top, box.width(), unit * weight)
            ticks = (90.0, 45.0, 0.0) if self.finger else (90.0, 0.0)
            labels = tuple((value, f"{format_rounded(value)}°") for value in ticks)
            scale = Scale(-15.0, 115.0, ticks, labels, bold_ends=False)
            if spread:
                scale = Scale(-32.0, 32.0, (20.0, 0.0, -20.0), spread_labels(20.0, self.finger), bold_ends=False)
            out.append((Panel(area, scale, *self.visible_s), place))
            top += unit * weight + between
        return out

    def add_background(self, plot: Plot, place: int, key: int) -> None:
        plot.add_grid()
        words = angle_group_names()[key] if self.finger else finger_name(str(FINGERS[key]))
        add_panel_name(plot, words, above=bool(self.finger) and key == 0)

    def visible_curves(self, key: int, points: int) -> list[Curve]:
        """Return the joints of a panel; those coupled or never visible only in the view of one finger."""
        out = []
        for figure in self.panel_angles(key):
            series = self.joint_series(figure)
            series = None if series is None else slice_time(series, *self.visible_s)
            if series is None or (not self.finger and bool(series.predicted[np.isfinite(series.value)].all())):
                continue
            out += self._curves(series, figure.token, points)
        return out

    def read_values(self, key: int, time_s: float) -> list[Value]:
        """Return the joints that have a value beside the panel."""
        angles = [figure for figure in self.panel_angles(key) if self.joint_series(figure) is not None]
        shown = angles if self.finger else [figure for figure in angles if not self.is_coupled(figure)]
        return [Value(figure.kind_name, figure.token, *read_joint_angle(self, figure, time_s)) for figure in shown]


def _joint_series(joints: JointCurves, angle: FingerAngle) -> Series | None:
    name, share, bound = angle.joint, angle.sign, False
    if name not in joints.names and angle.kind == "end":
        name, share, bound = f"PIP{angle.finger}_flexion", DIP_PER_PIP, True
    if name not in joints.names:
        return None
    column = joints.names.index(name)
    value, sd = share * joints.angles_deg[:, column], abs(share) * joints.sds_deg[:, column]
    hidden = np.isfinite(value) & (bound | ~joints.is_valid[:, column])
    return Series(joints.time_s, value, sd, hidden, find_max_step_s(joints.time_s))


def repetition_label(number: int, repetition: RepetitionResult) -> str:
    """Return a repetition's number, and why it is not analysed."""
    if repetition.is_passive:
        return tr("{number} (passive)").format(number=number)
    return str(number) if repetition.is_counted else tr("{number} (excluded)").format(number=number)


def read_wrist_angle(curves: WristCurves, column: int, time_s: float) -> tuple[float, float]:
    """Return angle and SD in degrees at the frame nearest to a time; NaN in a gap."""
    if not len(curves.time_s):
        return math.nan, math.nan
    row = find_nearest_row(curves.time_s, time_s)
    if abs(float(curves.time_s[row]) - time_s) > find_max_step_s(curves.time_s):
        return math.nan, math.nan
    return float(curves.angles_deg[row, column]), float(curves.sds_deg[row, column])


def read_joint_angle(plot: HandPlot, angle: FingerAngle, time_s: float) -> tuple[float, float, bool]:
    """Return angle, SD and whether occluded at the frame nearest to a time; NaN in a gap."""
    series = plot.joint_series(angle)
    if series is None or not len(series.time_s):
        return math.nan, math.nan, True
    row = find_nearest_row(plot.curves.time_s, time_s)
    if abs(float(series.time_s[row]) - time_s) > series.max_step_s or series.sd is None:
        return math.nan, math.nan, True
    return float(series.value[row]), float(series.sd[row]), bool(series.predicted[row])


def find_nearest_row(time_s: FloatArray, at_s: float) -> int:
    """Return the row of the frame nearest to a time, -1 if there are none."""
    return int(np.abs(time_s - at_s).argmin()) if len(time_s) else -1


def move_edge(repetitions: Sequence[RepetitionResult], number: int, edge: str, time_s: float) -> RepetitionResult:
    """Return a repetition with its ``start`` or ``end`` moved, as far as its other edge and its neighbours allow."""
    one = repetitions[number]
    if edge == "start":
        least = repetitions[number - 1].end_s if number else 0.0
        return replace(one, start_s=min(max(time_s, min(least, one.start_s)), one.end_s - MIN_REPETITION_S))
    most = repetitions[number + 1].start_s if number + 1 < len(repetitions) else math.inf
    return replace(one, end_s=max(min(time_s, max(most, one.end_s)), one.start_s + MIN_REPETITION_S))


LEFT_PX, RIGHT_PX, TOP_PX, BOTTOM_PX, BETWEEN_PX = 122, 108, 38, 30, 18
# Left, top, right and bottom margin on paper, without the room for readings of the screen.
PAPER_MARGINS = (106.0, 26.0, 8.0, 22.0)
HAND_BETWEEN, PAPER_BETWEEN, NUMBERS_ABOVE = 8, 12, 10
# Half the size of the drag target around the handle of an edge or around the cursor.
GRIP_PX = 16
# Shortest visible time span.
MIN_SPAN_S = 2.0


class SessionChart(ZoomChart):
    """Card with a session's curves: cursor, draggable repetition edges, and zoom along the time.

    Emits ``cursor_moved`` (seconds) and ``edges_moved`` (repetition, start, end).
    """

    default_px, min_px = (736, 360), (420, 240)
    min_span = MIN_SPAN_S

    cursor_moved = Signal(float)
    edges_moved = Signal(int, float, float)

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme, "curves")
        self._plot: SessionPlot | None = None
        self._time_s = 0.0
        # What is dragged: an edge (``start``, ``end``), the ``cursor``, or nothing.
        self._drag_target = ""
        self._single = False
        self._curves: list[tuple[Curves, int]] = []
        self._cursors: list[Any] = []
        self._readings: list[ChartText] = []
        self.setAccessibleName(self.tr("Curves of the session"))

    def show_plot(self, plot: SessionPlot) -> None:
        """Draw a session, or the same one with other repetitions, keeping the visible time span."""
        self._plot = replace(plot, window_s=self._window)
        self.refresh()

    def clear(self) -> None:
        self._plot = self._window = None
        self.refresh()

    def show_repetitions(self) -> None:
        """Zoom to the repetitions; what lies before and after them is reached by panning or zooming out."""
        if self._plot is not None:
            self.show_window(self._plot.repetition_span_s)

    def show_single(self, on: bool) -> None:
        """Show the trained angle alone, for large text."""
        if on != self._single:
            self._single = on
            self.refresh()

    def set_time(self, time_s: float) -> None:
        """Move the cursor, and scroll if it leaves the visible time span."""
        self._time_s = time_s
        if self._window is not None and self._plot is not None and not self._drag_target:
            start_s, end_s = self._window
            if not start_s <= time_s <= end_s:
                begin_s = time_s - 0.1 * (end_s - start_s)
                self.show_window((begin_s, begin_s + end_s - start_s))
        self._show_time()

    # --- window -------------------------------------------------------------------------------------------
    def extent(self) -> tuple[float, float] | None:
        return None if self._plot is None else (0.0, self._plot.end_s)

    def zoom_center(self) -> float:
        return self._time_s

    def update_range(self) -> None:
        if self._plot is not None:
            self._plot = replace(self._plot, window_s=self._window)
            for curves, key in self._curves:
                curves.set_curves(
                    self._plot.visible_curves(
                        key, int(curves.plot.panel.box.width() / self.plot_style.unit / self._share)
                    )
                )
            self._show_time()

    @property
    def _share(self) -> int:
        """Return the share of points that a panel has room for: all of them on paper."""
        return 1 if self.is_printing else 2

    # --- places -------------------------------------------------------------------------------------------
    def panels(self) -> list[tuple[Panel, int]]:
        assert self._plot is not None
        hand, area = isinstance(self._plot, HandPlot), self.area if self.is_printing else QRectF(self.rect())
        scale = self.plot_style.unit if self.is_printing else self._theme.text_scale
        left, top, right, bottom = PAPER_MARGINS if self.is_printing else (LEFT_PX, TOP_PX, RIGHT_PX, BOTTOM_PX)
        between = HAND_BETWEEN if hand else PAPER_BETWEEN if self.is_printing else BETWEEN_PX
        box = area.adjusted(left * scale, top * scale, -right * scale, -bottom * scale)
        placed = self._plot.panels(box, between * scale, single=self._single)
        return (
            placed
            if self.is_printing
            else [(replace(panel, box=axes.align_to_pixels(panel.box)), key) for panel, key in placed]
        )

    # --- what is in it ------------------------------------------------------------------------------------
    def build(self) -> None:
        plot = self._plot
        self.menu_button.setVisible(plot is not None)
        self._curves, self._cursors, self._readings = [], [], []
        if plot is None:
            return
        for place, (panel, key) in enumerate(self.panels()):
            own = self.add_plot(panel)
            self._add_repetitions(own, plot)
            plot.add_background(own, place, key)
            self.add_axis(own, "left", scale_labels(panel), 12)
            self._curves.append((own.add_curves(), key))
        self.add_axis(self.plots[0], "top", lambda *_: self._repetition_labels(), NUMBERS_ABOVE)
        self.add_axis(
            self.plots[-1], "bottom", lambda *ends: [AxisLabel(*one) for one in reversed(axes.time_labels(*ends))], 6
        )
        if not self.is_printing:
            self._add_readings(plot)
        self.update_range()

    def _add_repetitions(self, own: Plot, plot: SessionPlot) -> None:
        """Add shaded time spans; the current one coloured, excluded ones hatched."""
        shown = plot.repetitions
        if not shown:
            return
        low, high = own.panel.scale.low, own.panel.scale.high
        for token, some in (
            ("sunken", [one for k, one in enumerate(shown) if k != plot.current]),
            ("soft", shown[plot.current : plot.current + 1] if plot.current >= 0 else ()),
        ):
            own.add_bars([(one.start_s, one.end_s) for one in some], token)
        left_out = [(one.start_s, one.end_s, low, high) for one in shown if not one.is_counted]
        if left_out:
            own.add_to_layer(Hatching(own, left_out), GROUND + 1)

    def _repetition_labels(self) -> list[AxisLabel]:
        """Return the repetition numbers, the current one first so that it is never omitted."""
        assert self._plot is not None
        current, out = self._plot.current, []
        for number, one in sorted(enumerate(self._plot.repetitions), key=lambda one: one[0] != current):
            token = "text" if number == current else "text2" if one.is_counted else "warn"
            words = repetition_label(number + 1, one)
            out.append(AxisLabel(0.5 * (one.start_s + one.end_s), words, token, is_bold=True))
        return out

    def _add_readings(self, plot: SessionPlot) -> None:
        """Add what follows the cursor and the mouse: lines, edges, dots, values and the hover label."""
        first, scale = self.plots[0], self._theme.text_scale
        if 0 <= plot.current < len(plot.repetitions):
            one = plot.repetitions[plot.current]
            for at in (one.start_s, one.end_s):
                first.add_cursor(at, "accent").addMarker("o", 0.5, 10.0)
        self._cursors = [own.add_cursor(self._time_s) for own in self.plots]
        self._hover_lines = [own.add_cursor(0.0, "text2", 1.0) for own in self.plots]
        self._dots = self.add_symbols()
        for own in self.plots:
            item = self.add_text("", font(14 * scale, MEDIUM), "text2", (0.0, 0.5))
            item.setPos(own.panel.box.right() + 12 * scale, own.panel.box.center().y())
            self._readings.append(item)
        self._hover_label = HoverLabel(self)
        self.hover(None)

    def paint_background(self, painter: QPainter) -> None:
        plot, look, scale = self._plot, self.plot_style, self._theme.text_scale
        if plot is None:
            return
        painter.setFont(look.label_font)
        painter.setPen(look.color("text2"))
        if plot.repetitions:
            painter.drawText(QPointF(20, TOP_PX * scale - NUMBERS_ABOVE), self.tr("Repetitions"))
        words = self.tr("Ctrl+wheel: zoom")
        if 10 + painter.fontMetrics().horizontalAdvance(words + "0") < self.panels()[-1][0].box.left():
            painter.drawText(QPointF(10, self.height() - 10 * scale), words)  # before the times

    # --- read-out -----------------------------------------------------------------------------------------
    def _show_time(self) -> None:
        plot, time_s = self._plot, self._time_s
        if plot is None or not self._cursors:
            return
        start_s, end_s = plot.visible_s
        is_shown = start_s <= time_s <= end_s
        placed = self.panels()
        series_list = [plot.read_values(key, time_s) if is_shown else [] for _, key in placed]
        dots = [
            (panel.point(time_s, value.value_deg), pg.mkBrush(self.plot_style.color(value.token)))
            for (panel, _), values in zip(placed, series_list, strict=True)
            for value in values
            if not value.is_occluded and math.isfinite(value.value_deg)
        ]
        self._dots.setData(
            x=[at.x() for at, _ in dots], y=[at.y() for at, _ in dots], brush=[brush for _, brush in dots]
        )
        for line, item, (_, key), values in zip(self._cursors, self._readings, placed, series_list, strict=True):
            line.setVisible(is_shown)
            line.setValue(time_s)
            item.show_rich(self._reading_html(plot, key, values, len(placed), max(map(len, series_list))))

    def _reading_html(self, plot: SessionPlot, key: int, values: Sequence[Value], panels: int, most: int) -> str:
        """Return the values beside a panel: one with its name, several as a list or in one line."""
        scale = self._theme.text_scale
        if values and not isinstance(plot, HandPlot):
            (value,) = values
            face = fit_font(font(14 * scale, REGULAR), value.name, (RIGHT_PX - 16) * scale)
            named = span_html(value.name, self.plot_style, "text2", face.pixelSize(), REGULAR)
            if not math.isfinite(value.value_deg):
                return named
            angle = span_html(numbers.format_degrees(value.value_deg), self.plot_style, "text", 20 * scale, SEMIBOLD)
            sd = span_html(numbers.format_sd(value.sd_deg), self.plot_style, "text2", 14 * scale, MEDIUM)
            return f"{named}<br>{angle} {sd}"
        finger = plot.finger if isinstance(plot, HandPlot) else 0
        pitch = self.plots[1].panel.box.top() - self.plots[0].panel.box.top() if panels > 1 else math.inf
        in_a_line = isinstance(plot, HandPlot) and not finger and 18.0 * scale * most > pitch
        out = []
        for value in values:
            weight, token = (MEDIUM, "text2") if value.is_occluded else (SEMIBOLD, "text")
            stroke = span_html(
                "- -" if value.is_occluded else "\N{EM DASH}", self.plot_style, value.token, 14 * scale, SEMIBOLD
            )
            if in_a_line:
                text, stroke = numbers.format_degrees(value.value_deg), ""
                out.append(span_html(text, self.plot_style, value.token, 12 * scale, weight))
            elif finger and key == 1:
                text = format_spread(value.value_deg, finger)
                below = f"<br>{span_html(numbers.format_sd(value.sd_deg), self.plot_style, token, 12 * scale, MEDIUM)}"
                below = below if math.isfinite(value.value_deg) else ""
                out.append(f"{stroke} {span_html(text, self.plot_style, token, 14 * scale, weight)}{below}")
            else:
                out.append(f"{stroke} {span_html(value.display_text, self.plot_style, token, 14 * scale, weight)}")
        return ("&nbsp; " if in_a_line else "<br>").join(out)

    def hover(self, position: QPointF | None) -> None:
        """Show a line through all panels and the values of the panel under the mouse."""
        if self._plot is None or not self._cursors:
            return
        inside = position is not None and any(own.panel.box.contains(position) for own in self.plots)
        shown = position if inside and not self._drag_target else None
        for line in self._hover_lines:
            line.setVisible(shown is not None)
            if shown is not None:
                line.setValue(self.to_time(shown.x()))
        self._hover_label.show_lines(shown, self.describe_values(shown) if shown is not None else ())
        over_edge = position is not None and self._find_edge(position) != ""
        pans = inside and self._window is not None
        shape = Qt.CursorShape.SizeHorCursor if over_edge else Qt.CursorShape.OpenHandCursor
        self.mouse_target.setCursor(shape if over_edge or pans else Qt.CursorShape.ArrowCursor)

    def describe_values(self, position: QPointF) -> list[str]:
        plot = self._plot
        assert plot is not None
        time_s = self.to_time(position.x())
        lines = [numbers.format_clock_tenths(time_s)]
        for panel, key in self.panels():
            if panel.box.contains(position):
                for value in plot.read_values(key, time_s):
                    hidden = self.tr("occluded") if value.is_occluded and math.isfinite(value.value_deg) else ""
                    named = (
                        value.name
                        if not math.isfinite(value.value_deg)
                        else f"{value.name} {value.display_text} {hidden}"
                    )
                    lines.append(named.strip())
        return lines

    # --- mouse --------------------------------------------------------------------------------------------
    def _find_edge(self, point: QPointF) -> str:
        """Return ``start`` or ``end`` of the current repetition if the mouse is on its handle, or an empty string."""
        plot = self._plot
        if plot is None or not 0 <= plot.current < len(plot.repetitions):
            return ""
        panel = self.panels()[0][0]
        if abs(point.y() - panel.box.center().y()) > GRIP_PX:
            return ""
        repetition = plot.repetitions[plot.current]
        away = {
            "start": abs(point.x() - float(panel.x(repetition.start_s))),
            "end": abs(point.x() - float(panel.x(repetition.end_s))),
        }
        nearest = min(away, key=lambda edge: away[edge])
        return nearest if away[nearest] <= GRIP_PX else ""

    def to_time(self, x: float) -> float:
        panel = self.panels()[0][0]
        share = (x - panel.box.left()) / max(panel.box.width(), 1.0)
        return panel.start_s + min(max(share, 0.0), 1.0) * (panel.end_s - panel.start_s)

    def click(self, event: Any) -> None:
        """Move the cursor; a double click toggles between the repetitions and the whole session."""
        if self._plot is None:
            return
        if event.double():
            if self._plot.window_s is None:
                self.show_repetitions()
            else:
                self.show_all()
        elif not self._find_edge(event.scenePos()):
            self.cursor_moved.emit(self.to_time(event.scenePos().x()))

    def drag(self, event: Any) -> bool:
        """Drag an edge or the cursor; return False to let the plot pan."""
        if self._plot is None or event.button() != Qt.MouseButton.LeftButton:
            return False
        if event.isStart():
            at = event.buttonDownScenePos()
            panel = self.panels()[0][0]
            at_cursor = abs(float(panel.x(self._time_s)) - at.x()) <= GRIP_PX
            self._drag_target = self._find_edge(at) or ("cursor" if at_cursor or self._window is None else "")
            self.hover(None)
        held, time_s = self._drag_target, self.to_time(event.scenePos().x())
        if held == "cursor":
            self.cursor_moved.emit(time_s)
        elif held:
            self._move_edge(held, time_s, is_finished=event.isFinish())
        if event.isFinish():
            self._drag_target = ""
        return bool(held)

    def _move_edge(self, edge: str, time_s: float, *, is_finished: bool) -> None:
        plot = self._plot
        assert plot is not None
        moved = move_edge(plot.repetitions, plot.current, edge, time_s)
        shown = list(plot.repetitions)
        shown[plot.current] = moved
        self.show_plot(replace(plot, repetitions=shown))
        if is_finished:
            self.edges_moved.emit(plot.current, moved.start_s, moved.end_s)


def paint_session(painter: QPainter, style: PlotStyle, plot: SessionPlot, box: QRectF) -> None:
    """Paint the chart into a box on paper."""
    chart = SessionChart(Theme("light"))
    chart.show_plot(plot)
    chart.show_repetitions()
    chart.render_on_paper(painter, style, box)
    chart.deleteLater()
