"""Range of motion over the sessions: error bars, error band, reference range, other hand and goals."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QFontMetricsF

from carpus.core.measures.manual_measurements import ManualValue, find_manual_measure
from carpus.core.model.hand.exercises import EXERCISES, PRONOSUPINATION
from carpus.core.model.rounding import format_rounded
from carpus.core.results.measure import Measure, MeasureKey, is_total_active_motion, wrist_angle_index
from carpus.core.results.norms import total_norm, wrist_norm
from carpus.core.results.progress import Progress, goal_measure
from carpus.ui.charts.chart import LINES, HoverLabel, Plot, date_labels
from carpus.ui.charts.manual_values import add_manual_values, day_timestamp
from carpus.ui.charts.panel import Panel, PlotStyle, Scale
from carpus.ui.charts.zoom_chart import ZoomChart
from carpus.ui.kit import numbers
from carpus.ui.kit.fonts import SEMIBOLD, font
from carpus.ui.kit.theme import CURVE_TOKENS, Theme
from carpus.ui.kit.translate import tr
from carpus.ui.words import terms
from carpus.ui.words.finger_angles import find_finger_angle
from carpus.ui.words.progress import correction_words, exclusion_words, uncertainty_words
from carpus.ui.words.terms import end_words

STEP_DEG = 30.0
# The caps of an error bar reach beyond the dot, so that one of 1° still shows.
DOT_RADIUS, CAP_REACH = 3.5, 7.0
MAX_PANELS = 3
# Minimum width of a panel whose first and last point carry their values, in em.
MIN_VALUED_WIDTH_EM = 12.0
# Minimum distance between both values in em; below it only the last one is written.
MIN_VALUE_DISTANCE_EM = 4.0
# Share of the time span left free at both ends.
PADDING_FRACTION = 1 / 15
# Time span around a single session.
SINGLE_SESSION_SPAN_S = 86_400.0


def panel_keys(progress: Progress) -> list[MeasureKey]:
    """Return the measures that are drawn: arc and ends of one angle, all arcs, or the chosen finger measures."""
    if not progress.points:
        return []
    if progress.keys:
        seen = {row.key for point in progress.points for row in point.results.joint_ranges if row.count}
        return [key for key in progress.keys if key in seen]
    # Of the newest session first, then what only older ones have.
    found = dict.fromkeys(row.key for point in reversed(progress.points) for row in point.results.wrist_ranges)
    arcs = [key for key in found if key[1] == "arc"]
    ends = [key for key in found if key[1] != "arc"]
    return (arcs + ends if len(arcs) == 1 else arcs)[:MAX_PANELS]


def axis_top_deg(key: MeasureKey) -> float:
    """Return the fixed top of an axis, the same for both directions."""
    subject, movement = key
    angle = wrist_angle_index(subject)
    if angle < 0:
        if is_total_active_motion(subject):
            return 180.0 if subject == "TAM1" else 300.0
        return 60.0 if find_finger_angle(subject).kind == "spread" else 120.0
    if movement == "arc":
        return {0: 90.0, 1: 180.0, 2: 180.0}[angle]
    return 60.0 if angle == 0 else 90.0


def panel_scale(progress: Progress, key: MeasureKey) -> Scale:
    """Return the scale of a panel, from zero or from below it where neutral was not reached."""
    movement, angle = key[1], wrist_angle_index(key[0])
    top_deg = axis_top_deg(key)
    step = STEP_DEG if top_deg <= 90 else 2 * STEP_DEG if top_deg <= 180 else 100.0
    rows = [find_session_measure(progress, number, key) for number in range(len(progress.points))]
    lacks = angle >= 0 and any(row is not None and row.mean < 0.0 for row in rows)
    low_deg = -step if lacks else 0.0
    if angle == PRONOSUPINATION and movement != "arc":
        # From thumb up a palm that looks down is at 90 degrees of pronation: supination may begin as far below zero.
        step, top_deg, low_deg = 2 * STEP_DEG, 120.0, -120.0 if lacks else 0.0
    ticks = tuple(np.arange(low_deg, top_deg + 1e-6, step).tolist())
    labels = tuple((tick, end_words(tick, movement)) for tick in ticks)
    return Scale(ticks[0] - (0.3 * step if lacks else 0.0), top_deg, ticks, labels, bold_ends=False)


def extent_s(progress: Progress) -> tuple[float, float]:
    """Return the ends of the time axis.

    Manual values widen it by at most half the time between first and last session.
    """
    when = [point.results.when for point in progress.points]
    times = sorted(one.timestamp() for one in when)
    by_hand = [
        day_timestamp(one.day, when) for key in panel_keys(progress) for one in select_manual_values(progress, key)
    ]
    if len(times) > 1 and by_hand:
        maximum = 0.5 * (times[-1] - times[0])
        first, last = max(min(by_hand), times[0] - maximum), min(max(by_hand), times[-1] + maximum)
        times = sorted([*times, first, last])
    else:
        times = sorted([*times, *by_hand])
    pad = (
        PADDING_FRACTION * (times[-1] - times[0])
        if len(times) > 1 and times[-1] > times[0]
        else SINGLE_SESSION_SPAN_S / 2
    )
    return times[0] - pad, times[-1] + pad


def select_manual_values(progress: Progress, key: MeasureKey) -> list[ManualValue]:
    """Return the active manual values of the same measure."""
    return [
        one
        for one in progress.manual_measurements
        if one.mode == "active" and find_manual_measure(one.measure).session_measure == key
    ]


def place_panels(
    progress: Progress, style: PlotStyle, box: QRectF, key_lines: int, span_s: tuple[float, float]
) -> list[tuple[Panel, MeasureKey]]:
    """Place all panels over one time axis, in one column or, if there are many, in two."""
    keys, unit = panel_keys(progress), style.unit
    if not keys:
        return []
    line = QFontMetricsF(style.end_label_font).height()
    title = line + 14 * unit
    foot = line * (1 + key_lines) + 26 * unit
    columns = 1 if len(keys) <= MAX_PANELS else 2
    lines = math.ceil(len(keys) / columns)
    height, width = (box.height() - foot) / lines, box.width() / columns
    # Room for the longest label beside a line; every panel has the same.
    longest = tr("Reference, adults {span}").format(span="120–150°")
    words = max(QFontMetricsF(style.end_label_font).horizontalAdvance(longest), 1.0)
    out = []
    for place, key in enumerate(keys):
        edge = box.left() + (place // lines) * width
        left, right = edge + 56 * unit, edge + width - words - 16 * unit
        top = box.top() + (place % lines) * height + title
        area = QRectF(left, top, right - left, height - title - 10 * unit)
        out.append((Panel(area, panel_scale(progress, key), *span_s), key))
    return out


def find_session_measure(progress: Progress, number: int, key: MeasureKey) -> Measure | None:
    """Return what session ``number`` measured, or None."""
    row = progress.points[number].results.find(*key)
    return row if row is not None and row.count else None


def panel_title(progress: Progress, key: MeasureKey) -> str:
    """Return the title of a panel."""
    movement, angle = key[1], wrist_angle_index(key[0])
    if angle < 0:
        return find_finger_angle(key[0]).long_name
    if movement == "arc" and progress.points[-1].results.exercise.angle is None:
        return terms.arc_name(angle)
    return tr("Total arc") if movement == "arc" else terms.movement_long_name(movement)


def add_background(plot: Plot, progress: Progress, key: MeasureKey) -> None:
    """Add reference range, error band, grid, other hand and goals behind the points."""
    subject, movement = key
    angle = wrist_angle_index(subject)
    labels: list[tuple[float, str, str]] = []
    exercise = progress.points[-1].results.exercise if progress.points else EXERCISES[-1]
    norm = total_norm(int(subject[-1]), exercise) if is_total_active_motion(subject) else None
    if angle >= 0:
        norm = wrist_norm(movement, angle, exercise)
    if norm is not None:
        low, high = norm.low_deg, norm.high_deg
        span = numbers.format_degree_range(low, high)
        plot.add_band(low, high, "norm")
        labels.append((0.5 * (low + high), tr("Reference, adults {span}").format(span=span), "text2"))
    first = progress.reference.find(*key) if progress.reference else None
    limit = next((c.limit_deg for c in progress.comparisons if c.key == key), math.nan)
    if first is not None and first.count and math.isfinite(limit):
        plot.add_band(first.mean - limit, first.mean + limit, "soft", "accent")
        words = tr("Measurement error ±{gap}{limit}").format(
            gap=numbers.NARROW_GAP, limit=numbers.format_degrees(limit)
        )
        labels.append((first.mean, words, "accent"))
    plot.add_grid()
    other = progress.other_hand.find(*key) if progress.other_hand else None
    if other is not None and other.count and progress.other_hand is not None:
        plot.add_horizontal_line(other.mean, "text2")
        shown = numbers.format_degrees(other.mean) if angle < 0 else end_words(other.mean, movement)
        words = f"{terms.hand_name(progress.other_hand.side)} {shown}"
        labels.append((other.mean, words, "text2"))
    if goals := goals_deg(progress, key):
        starts = [point.results.when.timestamp() for point in progress.points]
        ends = [*starts[1:], extent_s(progress)[1]]
        known = [
            (start, end, goal) for start, end, goal in zip(starts, ends, goals, strict=True) if math.isfinite(goal)
        ]
        x, y = [at for start, end, _ in known for at in (start, end)], [goal for _, _, goal in known for _ in range(2)]
        plot.add_line(x, y, "accent", 2.0, (5.0, 3.0), "pairs", LINES)
        shown = numbers.format_degrees(goals[-1]) if angle < 0 else end_words(goals[-1], movement)
        labels.append((goals[-1], tr("Goal {angle}").format(angle=shown), "accent"))
    plot.chart.add_end_labels(plot, labels)


def goals_deg(progress: Progress, key: MeasureKey) -> list[float]:
    """Return the goal of each session, NaN for none; empty if the newest session has none."""
    out = []
    for point in progress.points:
        results, goal = point.results, math.nan
        for target, direction in zip(results.targets_deg, (1, -1), strict=True):
            row = goal_measure(results, results.exercise, direction)
            if row is not None and row.key == key:
                goal = direction * target
                break
        out.append(goal)
    return out if out and math.isfinite(out[-1]) else []


def point_token(key: MeasureKey) -> str:
    """Return the colour of a panel's points."""
    subject, movement = key
    angle = wrist_angle_index(subject)
    if angle < 0 and not is_total_active_motion(subject):
        return find_finger_angle(subject).token
    return "text" if movement == "arc" else CURVE_TOKENS[angle]


def half_error_bar(row: Measure) -> float:
    """Return the SD between repetitions, or that of the measurement for a single one."""
    return row.sd if math.isfinite(row.sd) else row.measurement_sd


def error_bar_top(row: Measure) -> float:
    """Return the upper end of a point's error bar."""
    sd = half_error_bar(row)
    return row.mean + (sd if math.isfinite(sd) else 0.0)


def legend_entries(progress: Progress) -> list[tuple[str, str, str]]:
    """Return symbol, text and colour of each legend entry."""
    out = [("O", tr("mean ± SD of the repetitions"), "text"), ("o", tr("not compared"), "text2")]
    out += [("t1", tr("≥: partly occluded"), "text2")] if progress.keys else []
    if any(select_manual_values(progress, key) for key in panel_keys(progress)):
        out.append(("s", tr("manual, active"), "text"))
    return out


# Half the width of a point's click target.
TARGET_RADIUS_PX = 16
DAY_S = 86_400.0
# Characters of a line of the hover label.
MAX_LINE_LENGTH = 60


NO_PROGRESS = Progress((), (), None)


class ProgressChart(ZoomChart):
    """Chart of the sessions; ``session_chosen`` when a point is clicked or chosen by key."""

    default_px, min_px = (864, 560), (480, 320)
    min_span = DAY_S

    session_chosen = Signal(str)

    def __init__(self, theme: Theme, progress: Progress = NO_PROGRESS) -> None:
        super().__init__(theme, "progress")
        self._progress = progress
        # What is rebuilt whenever another time span is visible.
        self._zoomed_items: list[Any] = []
        self._ring: Any = None
        self._hover_label: HoverLabel | None = None
        # Session number and panel of the point under the mouse or chosen by key.
        self._current: tuple[int, MeasureKey] | None = None
        self.setAccessibleName(self.tr("Range of motion over the sessions"))

    def show_progress(self, progress: Progress) -> None:
        self._progress = progress
        self._window = None
        self._current = None
        self.refresh()

    @property
    def current_session(self) -> int:
        """Number of the session under the mouse or chosen by key, -1 for none."""
        return -1 if self._current is None else self._current[0]

    def step(self, offset: int) -> None:
        found = [at for at in self.points() if at[1] == next(iter(panel_keys(self._progress)), None)]
        if not found:
            return
        numbers_of = [number for number, _, _ in found]
        current = self.current_session
        now = numbers_of.index(current) if current in numbers_of else -1 if offset > 0 else len(numbers_of)
        number, key, _ = found[min(max(now + offset, 0), len(found) - 1)]
        self._set_current_point((number, key))

    def choose_current(self) -> None:
        if self._current is not None:
            self.session_chosen.emit(self._progress.points[self._current[0]].results.session_id)

    # --- window -------------------------------------------------------------------------------------------
    def extent(self) -> tuple[float, float] | None:
        return extent_s(self._progress) if panel_keys(self._progress) else None

    def zoom_center(self) -> float:
        if self._current is not None:
            return self._progress.points[self._current[0]].results.when.timestamp()
        return super().zoom_center()

    def update_range(self) -> None:
        for item in self._zoomed_items:
            self.remove_item(item)
        self._zoomed_items = []
        before = len(self._items)
        for plot in self.plots:
            self._add_points(plot, plot.key)
        self._zoomed_items = self._items[before:]
        self._update_highlight()

    # --- places -------------------------------------------------------------------------------------------
    def visible_points(self, plot: Plot) -> list[tuple[int, QPointF, Measure]]:
        """Return session number, position and measure of each visible point of a panel."""
        out, panel = [], plot.visible_panel
        for number, point in enumerate(self._progress.points):
            row, at_s = find_session_measure(self._progress, number, plot.key), point.results.when.timestamp()
            if row is not None and panel.start_s <= at_s <= panel.end_s:
                out.append((number, panel.point(at_s, row.mean), row))
        return out

    def points(self) -> list[tuple[int, MeasureKey, QPointF]]:
        return [(number, plot.key, at) for plot in self.plots for number, at, _ in self.visible_points(plot)]

    def find_point(self, position: QPointF) -> tuple[int, MeasureKey] | None:
        near = [(QLineF(at, position).length(), number, key) for number, key, at in self.points()]
        away, number, key = min(near, default=(math.inf, 0, ("", "arc")))
        return (number, key) if away <= TARGET_RADIUS_PX else None

    # --- what is in it ------------------------------------------------------------------------------------
    def build(self) -> None:
        progress, look, entries = self._progress, self.plot_style, legend_entries(self._progress)
        area = self.area if self.is_printing else QRectF(self.rect()).adjusted(20.5, 16.5, -16.5, -14.5)
        lines = len(self.legend_lines(entries, area.width()))
        placed = place_panels(progress, look, area, lines, self.x_range())
        self.menu_button.setVisible(bool(placed))
        self._zoomed_items, self._ring, self._hover_label = [], None, None
        face = font(look.end_label_font.pixelSize() * 1.25, SEMIBOLD, display=False)
        for panel, key in placed:
            plot = self.add_plot(panel, key)
            add_background(plot, progress, key)
            title = self.add_text(panel_title(progress, key), face, "text", (0.0, 1.0))
            title.setPos(plot.panel.box.left(), plot.panel.box.top() - 5 * look.unit)
            joined = [  # those that compare
                (point.results.when.timestamp(), row.mean)
                for number, point in enumerate(progress.points)
                if point.is_comparable and (row := find_session_measure(progress, number, key)) is not None
            ]
            if len(joined) > 1:
                plot.add_line([at for at, _ in joined], [value for _, value in joined], point_token(key))
        if not placed:
            return
        when = [point.results.when for point in progress.points]
        one_day = len({day.date() for day in when}) == 1
        words = [numbers.format_distinct_day(day, *when) if one_day else numbers.format_day_month(day) for day in when]
        days = date_labels([(day.timestamp(), text) for day, text in zip(when, words, strict=True)])
        for plot in {plot.panel.box.left(): plot for plot in self.plots}.values():  # the lowest of each column
            self.add_axis(plot, "bottom", days, 14)
        self.add_legend(entries, area)
        if not self.is_printing:
            self._ring = self.add_symbols("o", 18.0, pg.mkPen(look.color("accent"), width=2.0))
            self._hover_label = HoverLabel(self)
        self.update_range()

    def _add_points(self, plot: Plot, key: MeasureKey) -> None:
        """Add means with error bars, rings for sessions that are not compared, and the first and last value."""
        progress, look, unit, panel = self._progress, self.plot_style, self.plot_style.unit, plot.panel
        found = self.visible_points(plot)
        for is_fair, token in ((True, point_token(key)), (False, "text2")):
            some = [one for one in found if progress.points[one[0]].is_comparable == is_fair]
            pen = plot.pen(token, 1.4 if is_fair else 2.0)
            bars = [(at, sd) for _, at, row in some if math.isfinite(sd := half_error_bar(row))]
            if bars:
                y = np.array([at.y() for at, _ in bars])
                deg = float(panel.y(0.0) - panel.y(1.0))
                high, beam = 2.0 * deg * np.array([sd for _, sd in bars]), 2.0 * CAP_REACH * unit
                along = np.array([at.x() for at, _ in bars])
                self.add_item(pg.ErrorBarItem(x=along, y=y, height=high, beam=beam, pen=pen))
            places = [at for _, at, _ in some]
            ring = pg.mkPen(None) if is_fair else pen
            self.add_symbols("o", 2 * DOT_RADIUS, ring, token if is_fair else "surface", places)
            least = [at for _, at, row in some if row.wrist_angle < 0 and row.is_lower_bound]
            tops = [
                QPointF(at.x(), float(panel.y(error_bar_top(row))) - 8 * unit) for _, at, row in some if at in least
            ]
            self.add_symbols("t1", 8.0, pen, token if is_fair else "surface", tops)
        fair = [(at.x(), row) for number, at, row in found if progress.points[number].is_comparable]
        em = look.end_label_font.pixelSize()
        apart = len(fair) > 1 and fair[-1][0] - fair[0][0] >= MIN_VALUE_DISTANCE_EM * em
        if panel.box.width() >= MIN_VALUED_WIDTH_EM * em:
            for x, row in (fair[:1] if apart else []) + fair[-1:]:
                self._add_value(plot, key, x, row)
        add_manual_values(plot, select_manual_values(progress, key), [point.results.when for point in progress.points])

    def _add_value(self, plot: Plot, key: MeasureKey, x: float, row: Measure) -> None:
        """Write a value above its point, or below it where the other hand's line would cross it."""
        unit, panel = self.plot_style.unit, plot.panel
        face = font(self.plot_style.end_label_font.pixelSize() * 1.17, SEMIBOLD, display=False)
        metrics = QFontMetricsF(face)
        text = numbers.format_degrees(row.mean) if row.wrist_angle < 0 else end_words(row.mean, row.quantity)
        sd = row.sd if math.isfinite(row.sd) else 0.0
        baseline = float(panel.y(row.mean + sd)) - 8 * unit
        if row.wrist_angle < 0 and row.is_lower_bound:
            baseline -= 10 * unit
            text = f"≥{numbers.NARROW_GAP}{text}"
        hand = self._progress.other_hand
        other = hand.find(*key) if hand else None
        if other is not None and other.count:
            line = float(panel.y(other.mean)) + 2 * unit
            if baseline - metrics.ascent() < line < baseline + 4 * unit:
                baseline = float(panel.y(row.mean - sd)) + 8 * unit + metrics.ascent()
        width = metrics.horizontalAdvance(text)
        left = min(x - width / 2, panel.box.right() + 4 * unit - width)  # beside it stands what the bands are
        self.add_text(text, face).setPos(left, baseline - metrics.ascent())

    # --- a point ------------------------------------------------------------------------------------------
    def describe_point(self, number: int, key: MeasureKey) -> list[str]:
        point = self._progress.points[number]
        results, row = point.results, find_session_measure(self._progress, number, key)
        assert row is not None
        least = f"≥{numbers.NARROW_GAP}" if row.wrist_angle < 0 and row.is_lower_bound else ""
        value = f"{least}{numbers.format_with_sd(row.mean, row.sd)}"
        if row.wrist_angle >= 0:
            value = terms.end_words(row.mean, row.quantity, row.sd)
        named = self.tr("{name} {value}, {count} repetitions")
        lines = [
            numbers.format_date_time(results.when),
            named.format(name=panel_title(self._progress, key), value=value, count=row.count),
        ]
        quality = results.quality
        if math.isfinite(quality.distance_m):
            lines.append(self.tr("Camera {distance} cm away").format(distance=format_rounded(100 * quality.distance_m)))
        if not point.is_comparable:
            lines.append(exclusion_words(point, self._progress))
        elif sentence := uncertainty_words(point, self._progress):
            lines.append(sentence)
        if sentence := correction_words(results):
            lines.append(sentence)
        lines += [f"“{text}”" for _, text in results.notes[:1]]
        lines.append(self.tr("Click to open the session"))
        return [line if len(line) <= MAX_LINE_LENGTH else f"{line[: MAX_LINE_LENGTH - 1].rstrip()}…" for line in lines]

    def _set_current_point(self, found: tuple[int, MeasureKey] | None) -> None:
        if found != self._current:
            self._current = found
            self._update_highlight()

    def _update_highlight(self) -> None:
        if self._ring is None or self._hover_label is None:
            return
        rings = [at for number, _, at in self.points() if number == self.current_session]
        self._ring.setData(x=[at.x() for at in rings], y=[at.y() for at in rings])
        at = next((at for number, key, at in self.points() if (number, key) == self._current), None)
        self._hover_label.show_lines(
            at, self.describe_point(*self._current) if at is not None and self._current is not None else ()
        )

    # --- mouse --------------------------------------------------------------------------------------------
    def hover(self, position: QPointF | None) -> None:
        found = None if position is None else self.find_point(position)
        self._set_current_point(found)
        inside = position is not None and any(plot.panel.box.contains(position) for plot in self.plots)
        pans = Qt.CursorShape.OpenHandCursor if inside and self._window is not None else Qt.CursorShape.ArrowCursor
        self.mouse_target.setCursor(pans if found is None else Qt.CursorShape.PointingHandCursor)

    def click(self, event: Any) -> None:
        if event.double():
            self.show_all()
            return
        found = self.find_point(event.scenePos())
        self._set_current_point(found)
        if found is not None:
            self.choose_current()
