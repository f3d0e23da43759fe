"""Range over the sessions: points with error bars, error band about the first, norm band, other hand."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QFontMetricsF, QPainter, QPen

from carpus.core.hand.exercises import EXERCISES, PRONOSUPINATION
from carpus.core.measures.by_hand import HandValue, measure_named
from carpus.core.results.measure import Measure, MeasureKey, is_total, wrist_column
from carpus.core.results.norms import total_norm, wrist_norm
from carpus.core.results.progress import Progress, row_aimed_at
from carpus.core.rounding import written
from carpus.ui import numbers, terms
from carpus.ui.figures import figure_of
from carpus.ui.fonts import SEMIBOLD, font
from carpus.ui.plot.axes import Panel, Scale
from carpus.ui.plot.by_hand import Key, Squares, day_s, paint_at_least
from carpus.ui.plot.marks import Across, EndLabels, Level, Mark, Scales, Times
from carpus.ui.plot.polygon import polygon
from carpus.ui.plot.style import PlotStyle, dashed, write
from carpus.ui.terms import end_words
from carpus.ui.theme import CURVE_TOKENS
from carpus.ui.translate import tr

STEP_DEG = 30.0
DOT_RADIUS, CAP_REACH = 3.5, 7.0
"""The caps of an error bar reach beyond the dot, so that a spread of one or two degrees still shows."""
MOST_PANELS = 3
ROOMY_EM = 12.0
"""Width of a panel, in sizes of its letters, from which its first and last point carry their figures."""
VALUES_APART_EM = 4.0
"""Between first and last point, in the same, from which both figures have room; else only the last one stands."""
PAD_SHARE = 1 / 15
"""Of the time from the first to the last session, left free before and after."""
ALONE_S = 86_400.0
"""What is shown about a session that is the only one."""


def panels_of(progress: Progress) -> list[MeasureKey]:
    """What is drawn, arc first; of free movement the three arcs; of the whole hand what was chosen and ever seen."""
    if not progress.points:
        return []
    if progress.keys:
        seen = {row.key for point in progress.points for row in point.figures.joint_ranges if row.count}
        return [key for key in progress.keys if key in seen]
    rows = progress.points[-1].figures.wrist_ranges
    arcs = [row.key for row in rows if row.what == "arc"]
    ends = [row.key for row in rows if row.what != "arc"]
    return (arcs + ends if len(arcs) == 1 else arcs)[:MOST_PANELS]


def axis_top_deg(key: MeasureKey) -> float:
    """Fixed top of the axis: the same for both ends, whatever was measured."""
    of, movement = key
    angle = wrist_column(of)
    if angle < 0:
        return 180.0 if of == "TAM1" else 300.0 if is_total(of) else 60.0 if _is_spread(of) else 120.0
    if movement == "arc":
        return {0: 90.0, 1: 180.0, 2: 180.0}[angle]
    return 60.0 if angle == 0 else 90.0


def scale_of(progress: Progress, key: MeasureKey) -> Scale:
    """The fixed axis of a panel, from zero; below it where an end was never reached, by one step of what lacks."""
    movement, angle = key[1], wrist_column(key[0])
    top_deg = axis_top_deg(key)
    step = STEP_DEG if top_deg <= 90 else 2 * STEP_DEG if top_deg <= 180 else 100.0
    rows = [row_of(progress, number, key) for number in range(len(progress.points))]
    lacks = angle >= 0 and any(row is not None and row.mean < 0.0 for row in rows)
    low_deg = -step if lacks else 0.0
    if angle == PRONOSUPINATION and movement != "arc":
        # From thumb up a palm that looks down is at 90 degrees of pronation: supination may begin as far below zero.
        step, top_deg, low_deg = 2 * STEP_DEG, 120.0, -120.0 if lacks else 0.0
    ticks = tuple(np.arange(low_deg, top_deg + 1e-6, step).tolist())
    labels = tuple((tick, end_words(tick, movement)) for tick in ticks)
    return Scale(ticks[0] - (0.3 * step if lacks else 0.0), top_deg, ticks, labels, strong_ends=False)


def extent_s(progress: Progress) -> tuple[float, float]:
    """Ends of the time axis, to scale, with room beside the first and the last session.

    Values by hand widen it by at most half the time of the sessions on either side, which keep half of the width.
    """
    when = [point.figures.when for point in progress.points]
    times = sorted(one.timestamp() for one in when)
    by_hand = [day_s(one.day, when) for key in panels_of(progress) for one in by_hand_of(progress, key)]
    if len(times) > 1 and by_hand:
        most = 0.5 * (times[-1] - times[0])
        first, last = max(min(by_hand), times[0] - most), min(max(by_hand), times[-1] + most)
        times = sorted([*times, first, last])
    else:
        times = sorted([*times, *by_hand])
    pad = PAD_SHARE * (times[-1] - times[0]) if len(times) > 1 and times[-1] > times[0] else ALONE_S / 2
    return times[0] - pad, times[-1] + pad


def by_hand_of(progress: Progress, key: MeasureKey) -> list[HandValue]:
    """What was measured by hand of the same, moved by the patient."""
    return [one for one in progress.by_hand if one.way == "active" and measure_named(one.measure).figure == key]


def place_panels(
    progress: Progress, style: PlotStyle, box: QRectF, shown_s: tuple[float, float] | None = None
) -> list[tuple[Panel, MeasureKey]]:
    """All panels over one time axis, in one column or, if there are many, in two."""
    keys, unit = panels_of(progress), style.unit
    if not keys:
        return []
    line = QFontMetricsF(style.end_label).height()
    title = line + 14 * unit
    foot = line * (1 + len(_key(progress).lines(style, box))) + 26 * unit
    columns = 1 if len(keys) <= MOST_PANELS else 2
    lines = math.ceil(len(keys) / columns)
    height, width = (box.height() - foot) / lines, box.width() / columns
    # Room for the longest label beside a line; every panel has the same.
    longest = tr("Usual, adults {span}").format(span="120–150°")
    words = max(QFontMetricsF(style.end_label).horizontalAdvance(longest), 1.0)
    out = []
    for place, key in enumerate(keys):
        edge = box.left() + (place // lines) * width
        left, right = edge + 56 * unit, edge + width - words - 16 * unit
        top = box.top() + (place % lines) * height + title
        area = QRectF(left, top, right - left, height - title - 10 * unit)
        out.append((Panel(area, scale_of(progress, key), *(shown_s or extent_s(progress))), key))
    return out


def row_of(progress: Progress, number: int, key: MeasureKey) -> Measure | None:
    """What a session measured of it; None for nothing."""
    row = progress.points[number].figures.find(*key)
    return row if row is not None and row.count else None


def name_of(progress: Progress, key: MeasureKey) -> str:
    """Title of a panel."""
    movement, angle = key[1], wrist_column(key[0])
    if angle < 0:
        return figure_of(key[0]).long_name
    if movement == "arc" and progress.points[-1].figures.exercise.angle is None:
        return terms.arc_name(angle)
    return tr("Whole arc") if movement == "arc" else terms.movement_long_name(movement)


def still(progress: Progress, key: MeasureKey) -> list[Mark]:
    """What lies behind the points of a panel: usual, error band, grid, the other hand, and their words."""
    of, movement = key
    angle = wrist_column(of)
    out: list[Mark] = []
    labels: list[tuple[float, str, str]] = []
    exercise = progress.points[-1].figures.exercise if progress.points else EXERCISES[-1]
    norm = total_norm(int(of[-1]), exercise) if is_total(of) else None
    if angle >= 0:
        norm = wrist_norm(movement, angle, exercise)
    if norm is not None:
        low, high = norm.low_deg, norm.high_deg
        span = f"{written(low)}°" if low == high else f"{written(low)}–{written(high)}°"
        out.append(Across(low, high, "norm"))
        labels.append((0.5 * (low + high), tr("Usual, adults {span}").format(span=span), "text2"))
    first = progress.first.find(*key) if progress.first else None
    limit = next((c.limit_deg for c in progress.comparisons if c.key == key), math.nan)
    if first is not None and first.count and math.isfinite(limit):
        out.append(Across(first.mean - limit, first.mean + limit, "soft", "accent"))
        words = tr("Error band ±{gap}{limit}").format(gap=numbers.NARROW_GAP, limit=numbers.degrees(limit))
        labels.append((first.mean, words, "accent"))
    out.append(Scales())
    other = progress.other_hand.find(*key) if progress.other_hand else None
    if other is not None and other.count and progress.other_hand is not None:
        out.append(Level(other.mean, "text2"))
        shown = numbers.degrees(other.mean) if angle < 0 else end_words(other.mean, movement)
        words = f"{terms.hand_name(progress.other_hand.side)} {shown}"
        labels.append((other.mean, words, "text2"))
    goals = Goals(progress, key)
    if math.isfinite(goals.newest_deg):
        out.append(goals)
        shown = numbers.degrees(goals.newest_deg) if angle < 0 else end_words(goals.newest_deg, movement)
        words = tr("Goal {angle}").format(angle=shown)
        labels.append((goals.newest_deg, words, "accent"))
    return [*out, EndLabels(labels)]


@dataclass(frozen=True, slots=True)
class Goals:
    """The target that each session had, as a dashed step from one session to the next."""

    progress: Progress
    key: MeasureKey

    def goal_deg(self, number: int) -> float:
        """Of one session, that way; NaN for none."""
        figures = self.progress.points[number].figures
        for target, direction in zip(figures.targets_deg, (1, -1), strict=True):
            row = row_aimed_at(figures, figures.exercise, direction)
            if row is not None and row.key == self.key:
                return direction * target
        return math.nan

    @property
    def newest_deg(self) -> float:
        return self.goal_deg(len(self.progress.points) - 1)

    def paint(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        painter.setPen(dashed(style.color("accent"), 2 * style.unit, (5, 3)))
        starts = [float(panel.x(point.figures.when.timestamp())) for point in self.progress.points]
        ends = [*starts[1:], panel.box.right()]
        painter.save()
        painter.setClipRect(panel.box, Qt.ClipOperation.IntersectClip)
        for number, (left, right) in enumerate(zip(starts, ends, strict=True)):
            goal = self.goal_deg(number)
            if math.isfinite(goal):
                y = float(panel.y(goal))
                painter.drawLine(QPointF(left, y), QPointF(right, y))
        painter.restore()


@dataclass(frozen=True, slots=True)
class Points:
    """Mean of each session with its spread; those that compare are joined, the others are rings."""

    progress: Progress
    key: MeasureKey
    chosen: int = -1

    def places(self, panel: Panel) -> list[tuple[int, QPointF]]:
        """Number of the session and where its point is, of those that measured it."""
        out = []
        for number, point in enumerate(self.progress.points):
            row = row_of(self.progress, number, self.key)
            if row is not None:
                out.append((number, panel.at(point.figures.when.timestamp(), row.mean)))
        return out

    def paint(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        of, movement = self.key
        angle = wrist_column(of)
        unit, token = style.unit, "text" if movement == "arc" else CURVE_TOKENS[angle]
        if angle < 0 and not is_total(of):
            token = figure_of(of).token
        found = [(number, at, row_of(self.progress, number, self.key)) for number, at in self.places(panel)]
        rows = [(number, at.x(), row) for number, at, row in found if row is not None]
        fair = [(x, row) for number, x, row in rows if self.progress.points[number].fair]
        painter.setPen(QPen(style.color(token), style.line_width))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        if len(fair) > 1:
            line = np.array([x for x, _ in fair]), panel.y(np.array([row.mean for _, row in fair]))
            painter.save()
            painter.setClipRect(panel.box, Qt.ClipOperation.IntersectClip)
            painter.drawPolyline(polygon(*line))
            painter.restore()
        for number, x, row in rows:
            if not panel.box.left() - 1 <= x <= panel.box.right() + 1:
                continue  # zoomed away
            is_fair = self.progress.points[number].fair
            color = style.color(token if is_fair else "text2")
            middle = float(panel.y(row.mean))
            sd = row.sd if math.isfinite(row.sd) else row.measurement_sd
            top = middle
            if math.isfinite(sd):
                top, bottom = float(panel.y(row.mean + sd)), float(panel.y(row.mean - sd))
                painter.setPen(QPen(color, 1.4 * unit))
                for edge in (top, bottom):
                    painter.drawLine(QPointF(x - CAP_REACH * unit, edge), QPointF(x + CAP_REACH * unit, edge))
                painter.drawLine(QPointF(x, top), QPointF(x, bottom))
            painter.setPen(QPen(color, 2 * unit) if not is_fair else Qt.PenStyle.NoPen)
            painter.setBrush(style.color("surface") if not is_fair else color)
            reach = DOT_RADIUS * unit
            painter.drawEllipse(QPointF(x, middle), reach, reach)
            if angle < 0 and row.at_least:
                paint_at_least(painter, x, top - 4 * unit, unit)
            if number == self.chosen:
                painter.setPen(QPen(style.color("accent"), 2 * unit))
                painter.setBrush(Qt.BrushStyle.NoBrush)
                painter.drawEllipse(QPointF(x, middle), 9 * unit, 9 * unit)
        roomy = panel.box.width() >= ROOMY_EM * style.end_label.pixelSize()  # else they cover what is beside them
        apart = len(fair) > 1 and fair[-1][0] - fair[0][0] >= VALUES_APART_EM * style.end_label.pixelSize()
        for x, row in (fair[:1] if apart else []) + fair[-1:] if roomy else []:
            if panel.box.left() - 1 <= x <= panel.box.right() + 1:
                self._paint_value(painter, style, panel, x, row)

    def _paint_value(self, painter: QPainter, style: PlotStyle, panel: Panel, x: float, row: Measure) -> None:
        """The figure of the first and of the last session that compare."""
        unit = style.unit
        face = font(style.end_label.pixelSize() * 1.17, SEMIBOLD, display=False)
        metrics = QFontMetricsF(face)
        text = numbers.degrees(row.mean) if row.angle < 0 else end_words(row.mean, row.what)
        sd = row.sd if math.isfinite(row.sd) else 0.0
        baseline = float(panel.y(row.mean + sd)) - 8 * unit
        if row.angle < 0 and row.at_least:
            baseline -= 10 * unit
            text = f"≥{numbers.NARROW_GAP}{text}"
        hand = self.progress.other_hand
        other = hand.find(*self.key) if hand else None
        if other is not None and other.count:
            line = float(panel.y(other.mean)) + 2 * unit
            if baseline - metrics.ascent() < line < baseline + 4 * unit:
                baseline = float(panel.y(row.mean - sd)) + 8 * unit + metrics.ascent()
        width = metrics.horizontalAdvance(text)
        left = min(x - width / 2, panel.box.right() + 4 * unit - width)  # beside it stands what the bands are
        write(painter, QPointF(left, baseline), text, face, style.color("text"))


def paint_behind(
    painter: QPainter, style: PlotStyle, box: QRectF, progress: Progress, panels: Sequence[tuple[Panel, MeasureKey]]
) -> None:
    """Everything but the points: titles, bands, grid, dates, and what the signs mean."""
    when = [point.figures.when for point in progress.points]
    face = font(style.end_label.pixelSize() * 1.25, SEMIBOLD, display=False)
    for panel, key in panels:
        at = QPointF(panel.box.left(), panel.box.top() - 9 * style.unit)
        write(painter, at, name_of(progress, key), face, style.color("text"))
        for mark in (*still(progress, key), Squares(by_hand_of(progress, key), sessions=when)):
            mark.paint(painter, style, panel)
    one_day = len({day.date() for day in when}) == 1
    words = [numbers.day_beside(day, *when) if one_day else numbers.day_month(day) for day in when]
    days = Times([(day.timestamp(), said) for day, said in zip(when, words, strict=True)], 14.0, days=True)
    for panel in {panel.box.left(): panel for panel, _ in panels}.values():  # the lowest of each column
        days.paint(painter, style, panel)
    if panels:
        _key(progress).paint(painter, style, box)


def paint_chart(painter: QPainter, style: PlotStyle, box: QRectF, progress: Progress) -> None:
    """The whole chart at once, as on paper."""
    panels = place_panels(progress, style, box)
    paint_behind(painter, style, box, progress, panels)
    for panel, key in panels:
        Points(progress, key).paint(painter, style, panel)


def _is_spread(joint: str) -> bool:
    return figure_of(joint).row == "spread"


def _key(progress: Progress) -> Key:
    """What the signs mean."""
    entries = [("dot", tr("mean, ± sd between repetitions"), "text"), ("ring", tr("not compared"), "text2")]
    entries += [("arrow", tr("at least: hidden in part"), "text2")] if progress.keys else []
    if any(by_hand_of(progress, key) for key in panels_of(progress)):
        entries.append(("square", tr("by hand, active"), "text"))
    return Key(entries)
