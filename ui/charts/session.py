"""Curves of a whole session with its repetitions, wrist or fingers, for screen and paper."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from html import escape
from typing import Any

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QFontMetricsF, QPainter

from carpus.core.model.hand.exercises import FLEXION, PRONOSUPINATION, Exercise
from carpus.core.model.hand.forearm_rotation import axis_limits_deg, is_counted_from_thumb_up
from carpus.core.model.hand.kinematics import DIP_PER_PIP
from carpus.core.model.rounding import format_rounded
from carpus.core.model.types import TrackStatus
from carpus.core.results.repetition_rows import RepetitionResult
from carpus.core.results.valid_data import JointCurves, WristCurves
from carpus.ui.charts.chart import (
    GROUND,
    AxisLabel,
    ChartText,
    Curves,
    Hatching,
    HoverLabel,
    Plot,
    fit_font,
)
from carpus.ui.charts.panel import Panel, Scale, angle_scale, stack_boxes, time_labels
from carpus.ui.charts.series import Curve, Series, decimate, find_max_step_s, slice_time
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
            words = tr("should stay within {angle}").format(angle=numbers.format_degrees(limit))
            if key == PRONOSUPINATION:
                words = tr("from the start, + = thumb side up; {within}").format(within=words)
            plot.add_label(limit, words)
    elif key == PRONOSUPINATION:
        is_from_thumb_up = is_counted_from_thumb_up(exercise)
        words = tr("0° = thumb up") if is_from_thumb_up else tr("rotation from the start, + = thumb side up")
        plot.add_label(0.0, words, small=True)


def wrist_panels(
    exercise: Exercise, box: QRectF, between: float, span_s: tuple[float, float], *, single: bool = False
) -> list[tuple[Panel, int]]:
    """Return three panels with the column of each, the trained angle first and twice as high; or that one alone."""
    first = FLEXION if exercise.angle is None else exercise.angle
    order = [first] if single else [first, *(k for k in (FLEXION, 0, PRONOSUPINATION) if k != first)]
    out = []
    for k, area in zip(order, stack_boxes(box, (2.0, 1.0, 1.0)[: len(order)], between), strict=True):
        limits, names = axis_limits_deg(k, exercise), terms.direction_names(k, exercise)
        out.append((Panel(area, angle_scale(*limits, *names, is_sparse=k != first), *span_s), k))
    return out


def wrist_series(curves: WristCurves, column: int) -> Series:
    """Return the series of a wrist angle."""
    predicted = curves.status == TrackStatus.PREDICTED
    values, sds = curves.angles_deg[:, column], curves.sds_deg[:, column]
    return Series(curves.time_s, values, sds, predicted, find_max_step_s(curves.time_s))


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

    # --- what is drawn ------------------------------------------------------------------------------------
    def panels(
        self, box: QRectF, between: float, span_s: tuple[float, float], *, single: bool = False
    ) -> list[tuple[Panel, int]]:
        """Return the panels in a box over a time span, with the key of each; ``single`` for the first alone."""
        return wrist_panels(self.exercise, box, between, span_s, single=single)

    def add_background(self, plot: Plot, place: int, key: int) -> None:
        """Add what lies behind the curves of a panel."""
        add_limits(plot, self.exercise, key, is_first=place == 0)
        plot.add_grid()
        if place == 0:
            add_targets(plot, self.target_positive_deg, self.target_negative_deg)

    def visible_curves(self, key: int, points: int, span_s: tuple[float, float]) -> list[Curve]:
        """Return the curves of a panel over a time span, of about ``points`` points each."""
        return self._curves(wrist_series(self.curves, key), CURVE_TOKENS[key], points, span_s)

    def _curves(self, series: Series, token: str, points: int, span_s: tuple[float, float]) -> list[Curve]:
        """Return a curve in its colour during the repetitions, and what is visible before and after them in grey."""
        start_s, end_s = first_s, last_s = span_s
        if self.repetitions:
            first_s, last_s = self.repetitions[0].start_s, max(repetition.end_s for repetition in self.repetitions)
        parts = (start_s, min(first_s, end_s), "border"), (max(last_s, start_s), end_s, "border")
        return [
            Curve(decimate(slice_time(series, low_s, high_s), max(MIN_POINTS, points)), shown)
            for low_s, high_s, shown in (*parts, (max(first_s, start_s), min(last_s, end_s), token))
            if low_s < high_s
        ]

    def read_values(self, key: int, time_s: float) -> list[Value]:
        """Return what is written beside a panel."""
        value, sd, _ = wrist_series(self.curves, key).read_value(time_s)
        name = terms.direction_name(key, value, self.exercise) if math.isfinite(value) else tr("no value")
        return [Value(name, CURVE_TOKENS[key], value, sd)]


@dataclass(frozen=True, slots=True)
class HandPlot(SessionPlot):
    """Session plot of the finger joints; ``finger`` 1 to 5, or 0 for all of them."""

    joints: JointCurves | None = None
    finger: int = 0
    # Of :meth:`joint_series`, which is called at every step of the wheel.
    _series: dict[FingerAngle, Series | None] = field(default_factory=dict, repr=False, compare=False)

    def panel_angles(self, panel: int) -> list[FingerAngle]:
        if self.finger and panel == 1:
            return [FingerAngle(self.finger, "spread")]
        return [FingerAngle(self.finger or FINGERS[panel], row) for row in FLEXION_KINDS]

    def joint_series(self, angle: FingerAngle) -> Series | None:
        """Return a joint's series, dashed where occluded; None if it is neither measured nor coupled."""
        if angle not in self._series:
            assert self.joints is not None
            self._series[angle] = _joint_series(self.joints, angle)
        return self._series[angle]

    def panels(
        self, box: QRectF, between: float, span_s: tuple[float, float], *, single: bool = False
    ) -> list[tuple[Panel, int]]:
        """Return a panel for each finger, or flexion over spreading; ``single`` omits the spreading."""
        weights = (2.0, 1.0)[: 1 if single else 2] if self.finger else (1.0,) * len(FINGERS)
        ticks = (90.0, 45.0, 0.0) if self.finger else (90.0, 0.0)
        labels = tuple((value, f"{format_rounded(value)}°") for value in ticks)
        flexion = Scale(-15.0, 115.0, ticks, labels, bold_ends=False)
        spread = Scale(-32.0, 32.0, (20.0, 0.0, -20.0), spread_labels(20.0, self.finger), bold_ends=False)
        return [
            (Panel(area, spread if self.finger and place == 1 else flexion, *span_s), place)
            for place, area in enumerate(stack_boxes(box, weights, between))
        ]

    def add_background(self, plot: Plot, place: int, key: int) -> None:
        plot.add_grid()
        words = (tr("Flexion"), tr("Abduction"))[key] if self.finger else finger_name(str(FINGERS[key]))
        add_panel_name(plot, words, above=bool(self.finger) and key == 0)

    def visible_curves(self, key: int, points: int, span_s: tuple[float, float]) -> list[Curve]:
        """Return the joints of a panel; those coupled or never visible only in the view of one finger."""
        out = []
        for figure in self.panel_angles(key):
            series = self.joint_series(figure)
            series = None if series is None else slice_time(series, *span_s)
            if series is None or (not self.finger and bool(series.predicted[np.isfinite(series.value)].all())):
                continue
            out += self._curves(series, figure.token, points, span_s)
        return out

    def read_values(self, key: int, time_s: float) -> list[Value]:
        """Return the joints that have a value beside the panel; those coupled only in the view of one finger."""
        assert self.joints is not None
        out = []
        for angle in self.panel_angles(key):
            series = self.joint_series(angle)
            if series is not None and (self.finger or angle.joint in self.joints.names):
                out.append(Value(angle.kind_name, angle.token, *series.read_value(time_s)))
        return out


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


def move_edge(repetitions: Sequence[RepetitionResult], number: int, edge: str, time_s: float) -> RepetitionResult:
    """Return a repetition with its ``start`` or ``end`` moved, as far as its other edge and its neighbours allow."""
    one = repetitions[number]
    if edge == "start":
        least = repetitions[number - 1].end_s if number else 0.0
        return replace(one, start_s=min(max(time_s, min(least, one.start_s)), one.end_s - MIN_REPETITION_S))
    most = repetitions[number + 1].start_s if number + 1 < len(repetitions) else math.inf
    return replace(one, end_s=max(min(time_s, max(most, one.end_s)), one.start_s + MIN_REPETITION_S))


# Left, top, right and bottom; on paper without the room for the readings of the screen.
SCREEN_MARGINS, PAPER_MARGINS = (122.0, 38.0, 108.0, 30.0), (106.0, 26.0, 8.0, 22.0)
HAND_BETWEEN, PAPER_BETWEEN, SCREEN_BETWEEN, NUMBERS_ABOVE = 8, 12, 18, 10
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

    def __init__(self, theme: Theme, plot: SessionPlot | None = None) -> None:
        """Show a session, zoomed to its repetitions; nothing until one is given."""
        super().__init__(theme, "curves")
        self._plot = plot
        self._time_s = 0.0
        # What is dragged: an edge (``start``, ``end``), the ``cursor``, or nothing.
        self._drag_target = ""
        self._single = False
        self._curves: list[Curves] = []
        self._cursors: list[Any] = []
        self._readings: list[ChartText] = []
        self.setAccessibleName(self.tr("Curves of the session"))
        self.show_repetitions()

    def show_plot(self, plot: SessionPlot) -> None:
        """Draw a session, or the same one with other repetitions, keeping the visible time span."""
        self._plot = plot
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
            share = 1 if self.is_printing else 2  # of the points that a panel has room for: all of them on paper
            for curves in self._curves:
                points = int(curves.plot.panel.box.width() / self.plot_style.unit / share)
                curves.set_curves(self._plot.visible_curves(curves.plot.key, points, self.x_range()))
            self._show_time()

    # --- what is in it ------------------------------------------------------------------------------------
    def build(self) -> None:
        plot = self._plot
        self.menu_button.setVisible(plot is not None)
        self._curves, self._cursors, self._readings = [], [], []
        if plot is None:
            return
        area, scale, margins = QRectF(self.rect()), self._theme.text_scale, SCREEN_MARGINS
        between = SCREEN_BETWEEN
        if self.is_printing:
            area, scale, margins, between = self.area, self.plot_style.unit, PAPER_MARGINS, PAPER_BETWEEN
        between = HAND_BETWEEN if isinstance(plot, HandPlot) else between
        left, top, right, bottom = (scale * margin for margin in margins)
        box = area.adjusted(left, top, -right, -bottom)
        for place, (panel, key) in enumerate(plot.panels(box, between * scale, self.x_range(), single=self._single)):
            own = self.add_plot(panel, key)
            self._add_repetitions(own, plot)
            plot.add_background(own, place, key)
            self._curves.append(own.add_curves())
        self.add_axis(self.plots[0], "top", lambda *_: self._repetition_labels(), NUMBERS_ABOVE)
        self.add_axis(self.plots[-1], "bottom", lambda *ends: [AxisLabel(*one) for one in time_labels(*ends)[::-1]], 6)
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
            painter.drawText(QPointF(20, SCREEN_MARGINS[1] * scale - NUMBERS_ABOVE), self.tr("Repetitions"))
        words = self.tr("Ctrl+wheel: zoom")
        if 10 + painter.fontMetrics().horizontalAdvance(words + "0") < self.plots[-1].panel.box.left():
            painter.drawText(QPointF(10, self.height() - 10 * scale), words)  # before the times

    # --- read-out -----------------------------------------------------------------------------------------
    def _show_time(self) -> None:
        plot, time_s = self._plot, self._time_s
        if plot is None or not self._cursors:
            return
        start_s, end_s = self.x_range()
        is_shown = start_s <= time_s <= end_s
        values_of = [plot.read_values(own.key, time_s) if is_shown else [] for own in self.plots]
        dots = [
            (own.visible_panel.point(time_s, value.value_deg), pg.mkBrush(self.plot_style.color(value.token)))
            for own, values in zip(self.plots, values_of, strict=True)
            for value in values
            if not value.is_occluded and math.isfinite(value.value_deg)
        ]
        self._dots.setData(
            x=[at.x() for at, _ in dots], y=[at.y() for at, _ in dots], brush=[brush for _, brush in dots]
        )
        most = max(map(len, values_of))
        for own, line, item, values in zip(self.plots, self._cursors, self._readings, values_of, strict=True):
            line.setVisible(is_shown)
            line.setValue(time_s)
            item.show_rich(self._reading_html(plot, own.key, values, most))

    def _reading_html(self, plot: SessionPlot, key: int, values: Sequence[Value], most: int) -> str:
        """Return the values beside a panel: one with its name, several as a list or in one line."""
        if not values:
            return ""
        scale = self._theme.text_scale

        def span(words: str, token: str, size: float, weight: int) -> str:
            color, size_px = self.plot_style.color(token).name(), round(size * scale)
            style = f"color:{color};font-size:{size_px}px;font-weight:{int(weight)}"
            return f'<span style="{style}">{escape(words)}</span>'

        if not isinstance(plot, HandPlot):
            (value,) = values
            face = fit_font(font(14 * scale, REGULAR), value.name, (SCREEN_MARGINS[2] - 16) * scale)
            named = span(value.name, "text2", face.pixelSize() / scale, REGULAR)
            if not math.isfinite(value.value_deg):
                return named
            angle = span(numbers.format_degrees(value.value_deg), "text", 20, SEMIBOLD)
            return f"{named}<br>{angle} {span(numbers.format_sd(value.sd_deg), 'text2', 14, MEDIUM)}"
        pitch = self.plots[1].panel.box.top() - self.plots[0].panel.box.top() if len(self.plots) > 1 else math.inf
        in_a_line = not plot.finger and 18.0 * scale * most > pitch
        out = []
        for value in values:
            weight, token = (MEDIUM, "text2") if value.is_occluded else (SEMIBOLD, "text")
            if in_a_line:
                out.append(span(numbers.format_degrees(value.value_deg), value.token, 12, weight))
                continue
            is_spread = plot.finger and key == 1
            words = format_spread(value.value_deg, plot.finger) if is_spread else value.display_text
            stroke = span("- -" if value.is_occluded else "\N{EM DASH}", value.token, 14, SEMIBOLD)
            out.append(f"{stroke} {span(words, token, 14, weight)}")
            if is_spread and math.isfinite(value.value_deg):
                out.append(span(numbers.format_sd(value.sd_deg), token, 12, MEDIUM))
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
                line.setValue(self._visible_panel.to_time(shown.x()))
        self._hover_label.show_lines(shown, self.describe_values(shown) if shown is not None else ())
        over_edge = position is not None and self._find_edge(position) != ""
        pans = inside and self._window is not None
        shape = Qt.CursorShape.SizeHorCursor if over_edge else Qt.CursorShape.OpenHandCursor
        self.mouse_target.setCursor(shape if over_edge or pans else Qt.CursorShape.ArrowCursor)

    def describe_values(self, position: QPointF) -> list[str]:
        plot = self._plot
        assert plot is not None
        time_s = self._visible_panel.to_time(position.x())
        lines = [numbers.format_clock_tenths(time_s)]
        for own in self.plots:
            if own.panel.box.contains(position):
                for value in plot.read_values(own.key, time_s):
                    hidden = self.tr("occluded") if value.is_occluded else ""
                    is_known = math.isfinite(value.value_deg)
                    lines.append(f"{value.name} {value.display_text} {hidden}".strip() if is_known else value.name)
        return lines

    # --- mouse --------------------------------------------------------------------------------------------
    def _find_edge(self, point: QPointF) -> str:
        """Return ``start`` or ``end`` of the current repetition if the mouse is on its handle, or an empty string."""
        plot = self._plot
        if plot is None or not 0 <= plot.current < len(plot.repetitions):
            return ""
        panel = self._visible_panel
        if abs(point.y() - panel.box.center().y()) > GRIP_PX:
            return ""
        repetition = plot.repetitions[plot.current]
        away = {
            "start": abs(point.x() - float(panel.x(repetition.start_s))),
            "end": abs(point.x() - float(panel.x(repetition.end_s))),
        }
        nearest = min(away, key=lambda edge: away[edge])
        return nearest if away[nearest] <= GRIP_PX else ""

    @property
    def _visible_panel(self) -> Panel:
        return self.plots[0].visible_panel

    def click(self, event: Any) -> None:
        """Move the cursor; a double click toggles between the repetitions and the whole session."""
        if self._plot is None:
            return
        if event.double():
            if self._window is None:
                self.show_repetitions()
            else:
                self.show_all()
        elif not self._find_edge(event.scenePos()):
            self.cursor_moved.emit(self._visible_panel.to_time(event.scenePos().x()))

    def drag(self, event: Any) -> bool:
        """Drag an edge or the cursor; return False to let the plot pan."""
        if self._plot is None or event.button() != Qt.MouseButton.LeftButton:
            return False
        if event.isStart():
            at = event.buttonDownScenePos()
            at_cursor = abs(float(self._visible_panel.x(self._time_s)) - at.x()) <= GRIP_PX
            self._drag_target = self._find_edge(at) or ("cursor" if at_cursor or self._window is None else "")
            self.hover(None)
        held, time_s = self._drag_target, self._visible_panel.to_time(event.scenePos().x())
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
