"""Curves of the fingers over a session: one panel for each finger, or bending and spreading of a single one."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QPainter, QPen

from core.output.joint_content import JointCurves
from ui import numbers
from ui.figures import FINGERS, Figure, Row, spread_labels, with_side
from ui.fonts import MEDIUM, SEMIBOLD, font
from ui.marker_words import finger_name
from ui.plot import axes
from ui.plot.axes import Panel, Scale
from ui.plot.series import LONGEST_STEP_S, Series, paint_point, paint_series
from ui.plot.style import PlotStyle
from ui.plot.thin import thinned, within
from ui.review.curves import SessionPlot, paint_repetitions, row_at, time_labels
from ui.translate import tr

BENDING: tuple[Row, ...] = ("knuckle", "middle", "end")
_BEND_LOW_DEG, _BEND_HIGH_DEG, _SPREAD_DEG = -15.0, 115.0, 32.0
DIP_PER_PIP = 2.0 / 3.0


@dataclass(frozen=True, slots=True)
class HandPlot(SessionPlot):
    """As a session of the wrist, with the joints; ``finger`` 1 to 5, or 0 for all of them."""

    joints: JointCurves | None = None
    finger: int = 0

    def figures(self, panel: int) -> list[Figure]:
        """What is drawn in a panel."""
        if self.finger and panel == 1:
            return [Figure(self.finger, "spread")]
        return [Figure(self.finger or FINGERS[panel], row) for row in BENDING]

    def joint_series(self, figure: Figure) -> Series | None:
        """A joint as it is drawn, dashed where it was not seen; None for one that is neither measured nor bound."""
        joints = self.joints
        assert joints is not None
        name, share, bound = figure.joint, figure.sign, False
        if name not in joints.names and figure.row == "end":
            name, share, bound = f"PIP{figure.finger}_flexion", DIP_PER_PIP, True
        if name not in joints.names:
            return None
        column = joints.names.index(name)
        value, sd = share * joints.angles_deg[:, column], abs(share) * joints.sds_deg[:, column]
        hidden = np.isfinite(value) & (bound | ~joints.seen[:, column])
        return Series(joints.time_s, value, sd, hidden)


def place_hand_panels(plot: HandPlot, box: QRectF, between: float, *, single: bool = False) -> list[tuple[Panel, int]]:
    """One panel for each finger, or bending over spreading; ``single`` leaves the spreading out."""
    weights = (2.0, 1.0)[: 1 if single else 2] if plot.finger else (1.0,) * len(FINGERS)
    unit = (box.height() - between * (len(weights) - 1)) / sum(weights)
    top, out = box.top(), []
    for place, weight in enumerate(weights):
        spread = bool(plot.finger) and place == 1
        area = QRectF(box.left(), top, box.width(), unit * weight)
        out.append((Panel(area, _spread_scale() if spread else _bend_scale(plot.finger > 0), *plot.shown_s), place))
        top += unit * weight + between
    return out


def _bend_scale(roomy: bool) -> Scale:
    inner = (45.0,) if roomy else ()
    ticks = (90.0, *inner, 0.0)
    labels = tuple((value, f"{value:.0f}°") for value in ticks)
    return Scale(_BEND_LOW_DEG, _BEND_HIGH_DEG, ticks, labels, strong_ends=False)


def _spread_scale() -> Scale:
    return Scale(-_SPREAD_DEG, _SPREAD_DEG, (20.0, 0.0, -20.0), spread_labels(20.0), strong_ends=False)


def paint_hand_session(
    painter: QPainter, style: PlotStyle, plot: HandPlot, panels: Sequence[tuple[Panel, int]]
) -> None:
    """Everything that does not move."""
    paint_repetitions(painter, style, plot, [panel for panel, _ in panels])
    for panel, place in panels:
        axes.paint_scale(painter, style, panel)
        _paint_name(painter, style, plot, panel, place)
        painter.save()
        painter.setClipRect(panel.box.adjusted(0, -2, 0, 2).toAlignedRect(), Qt.ClipOperation.IntersectClip)
        numbered: list[QRectF] = []
        for figure in plot.figures(place):
            series = plot.joint_series(figure)
            series = None if series is None else within(series, *plot.shown_s)
            if series is None or (not plot.finger and bool(series.predicted[np.isfinite(series.value)].all())):
                continue  # bound to another joint, or never seen: only where there is room for it
            most = max(200, int(panel.box.width() / style.unit))
            paint_series(painter, style, panel, thinned(series, most), figure.token, numbered)
        painter.restore()
    last = panels[-1][0]
    axes.paint_times(painter, style, last, last.box.bottom() + 6 * style.unit, time_labels(*plot.shown_s))


def _paint_name(painter: QPainter, style: PlotStyle, plot: HandPlot, panel: Panel, place: int) -> None:
    words = (tr("Bending"), tr("Spreading"))[place] if plot.finger else finger_name(str(FINGERS[place]))
    painter.setFont(style.end_label)
    painter.setPen(style.color("text"))
    scale = style.end_label.pixelSize() / 12.0
    left = panel.box.left() - 102 * scale
    middle = panel.box.top() + 6 * scale if plot.finger and place == 0 else panel.box.center().y()
    box = QRectF(left, middle - 12 * scale, 70 * scale, 24 * scale)
    painter.drawText(box, int(Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft), words)


def joint_at(plot: HandPlot, figure: Figure, time_s: float) -> tuple[float, float, bool]:
    """Angle, deviation and whether it was hidden at the frame nearest to a time; NaN in a gap."""
    series = plot.joint_series(figure)
    if series is None or not len(series.time_s):
        return math.nan, math.nan, True
    row = row_at(plot.curves, time_s)
    if abs(float(series.time_s[row]) - time_s) > LONGEST_STEP_S or series.sd is None:
        return math.nan, math.nan, True
    return float(series.value[row]), float(series.sd[row]), bool(series.predicted[row])


def paint_hand_cursor(
    painter: QPainter, style: PlotStyle, plot: HandPlot, panels: Sequence[tuple[Panel, int]], time_s: float
) -> None:
    """Dots on the curves under the cursor and their numbers at the right; a hidden joint in the second colour."""
    scale = style.end_label.pixelSize() / 12.0
    shown = [_with_numbers(plot, place) for _, place in panels]
    most = max(map(len, shown))
    for (panel, _), figures in zip(panels, shown, strict=True):
        step = (20.0 if plot.finger else 15.0) * scale
        if not plot.finger and step * most > _pitch(panels):
            _paint_in_one_line(painter, style, plot, panel, figures, time_s)
            continue
        line = panel.box.center().y() - step * (len(figures) - 1) / 2
        for figure in figures:
            value, sd, hidden = joint_at(plot, figure, time_s)
            if not hidden:
                paint_point(painter, style, panel, time_s, value, figure.token)
            left = panel.box.right() + 12 * scale
            pen = QPen(style.color(figure.token), 2.5 * style.unit)
            if hidden:
                pen.setDashPattern([1.6, 1.4])
            pen.setCapStyle(Qt.PenCapStyle.FlatCap)
            painter.setPen(pen)
            painter.drawLine(QPointF(left, line), QPointF(left + 12 * scale, line))
            painter.setFont(font(14 * scale, SEMIBOLD if not hidden else MEDIUM))
            painter.setPen(style.color("text" if not hidden else "text2"))
            at = QPointF(left + 18 * scale, line + 5 * scale)
            if figure.row == "spread":  # with its side, and so with no room beside it
                painter.drawText(at, with_side(value))
                painter.setFont(font(12 * scale, MEDIUM))
                painter.drawText(at + QPointF(0.0, 16 * scale), numbers.spread(sd) if math.isfinite(value) else "")
            else:
                painter.drawText(at, numbers.with_spread(value, sd))
            line += step


def _with_numbers(plot: HandPlot, place: int) -> list[Figure]:
    """The figures of a panel that have a number beside it."""
    figures = [figure for figure in plot.figures(place) if plot.joint_series(figure) is not None]
    return figures if plot.finger else [figure for figure in figures if not _is_bound(plot, figure)]


def _pitch(panels: Sequence[tuple[Panel, int]]) -> float:
    """From one panel to the next."""
    return panels[1][0].box.top() - panels[0][0].box.top() if len(panels) > 1 else math.inf


def _paint_in_one_line(
    painter: QPainter, style: PlotStyle, plot: HandPlot, panel: Panel, figures: Sequence[Figure], time_s: float
) -> None:
    """The numbers side by side, each over a line in its colour, where there is no room for a row each."""
    scale = style.end_label.pixelSize() / 12.0
    left, middle = panel.box.right() + 12 * scale, panel.box.center().y()
    room = 32.0 * scale
    for figure in figures:
        value, _, hidden = joint_at(plot, figure, time_s)
        if not hidden:
            paint_point(painter, style, panel, time_s, value, figure.token)
        painter.setFont(font(12 * scale, SEMIBOLD if not hidden else MEDIUM))
        painter.setPen(style.color("text" if not hidden else "text2"))
        painter.drawText(QPointF(left, middle + 3 * scale), numbers.degrees(value))
        pen = QPen(style.color(figure.token), 2.0 * style.unit)
        pen.setCapStyle(Qt.PenCapStyle.FlatCap)
        if hidden:
            pen.setDashPattern([1.6, 1.4])
        painter.setPen(pen)
        painter.drawLine(QPointF(left, middle + 8 * scale), QPointF(left + 22 * scale, middle + 8 * scale))
        left += room


def _is_bound(plot: HandPlot, figure: Figure) -> bool:
    return plot.joints is not None and figure.joint not in plot.joints.names
