"""Charts of the motion page: position, speed and ZYZ angles over time, and paths in three planes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QFontMetricsF, QPen
from PySide6.QtWidgets import QGraphicsLineItem, QGraphicsRectItem

from carpus.core.model.rounding import format_rounded
from carpus.core.model.types import FloatArray, Side
from carpus.core.results.motion_curves import MotionCurves
from carpus.ui.charts.chart import CURVES, FRONT, LINES, Chart, Plot
from carpus.ui.charts.panel import Panel, Scale, stack_boxes
from carpus.ui.charts.series import Curve, Series, find_max_step_s
from carpus.ui.charts.session import SessionPlot, add_panel_name
from carpus.ui.kit import numbers
from carpus.ui.kit.theme import Theme
from carpus.ui.kit.translate import tr
from carpus.ui.words.finger_angles import FINGERS
from carpus.ui.words.terms import finger_name

MotionKind = Literal["place", "zyz"]
# Possible ends of an axis: the smallest that holds the whole session, so that it does not change.
AXIS_LIMITS = (10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0, 5000.0)
# Each axis has the colour of its angle: X pronation-supination, Y flexion, Z deviation.
AXIS_TOKENS = ("rotation", "flexion", "deviation")
MINUS = "\N{MINUS SIGN}"


@dataclass(frozen=True, slots=True)
class MotionPlot(SessionPlot):
    """Position, linear and angular velocity along three axes (``place``), or the ZYZ angles (``zyz``)."""

    motion: MotionCurves | None = None
    kind: MotionKind = "place"

    def quantity(self, key: int) -> FloatArray:
        """Return position, linear or angular velocity (N, 3)."""
        assert self.motion is not None
        return (self.motion.position_mm, self.motion.velocity_mm_s, self.motion.angular_velocity_deg_s)[key]

    def panels(
        self, box: QRectF, between: float, span_s: tuple[float, float], *, single: bool = False
    ) -> list[tuple[Panel, int]]:
        """Return three panels of the same height."""
        boxes = stack_boxes(box, (1.0, 1.0, 1.0), between)
        return [(Panel(area, self._scale(key), *span_s), key) for key, area in enumerate(boxes)]

    def _scale(self, key: int) -> Scale:
        if self.kind == "zyz" and key == 1:
            return Scale(-20.0, 110.0, (90.0, 45.0, 0.0), ((90.0, "90°"), (0.0, "0°")), bold_ends=False)
        if self.kind == "zyz":
            labels = ((180.0, "+180°"), (-180.0, f"{MINUS}180°"))
            return Scale(-250.0, 250.0, (180.0, 90.0, 0.0, -90.0, -180.0), labels, bold_ends=False)
        maximum = float(np.nanmax(np.abs(self.quantity(key)), initial=0.0))
        top = next((step for step in AXIS_LIMITS if step >= maximum), AXIS_LIMITS[-1])
        unit = (f"{numbers.NARROW_GAP}mm", f"{numbers.NARROW_GAP}mm/s", "°/s")[key]
        number = format_rounded(top)
        ends = ((top, f"+{number}{unit}"), (0.0, "0"), (-top, f"{MINUS}{number}{unit}"))
        return Scale(-1.4 * top, 1.4 * top, (top, 0.0, -top), ends)

    def add_background(self, plot: Plot, place: int, key: int) -> None:
        plot.add_grid()
        names = ("α", "β", "γ, α+γ") if self.kind == "zyz" else (tr("Position"), tr("Speed"), tr("Rotation"))
        add_panel_name(plot, names[key])

    def visible_curves(self, key: int, points: int, span_s: tuple[float, float]) -> list[Curve]:
        """Return the three axes of a quantity, or a ZYZ angle with what stays known where it is not."""
        motion = self.motion
        assert motion is not None
        lines: list[tuple[str, FloatArray, FloatArray | None]]
        if self.kind == "zyz":
            token = ("deviation", "flexion", "deviation")[key]
            lines = [(token, motion.zyz_deg[:, key], motion.zyz_sd_deg[:, key])]
            lines += [("rotation", motion.zyz_sum_deg, None)] if key == 2 else []
        else:
            lines = [(token, values, None) for token, values in zip(AXIS_TOKENS, self.quantity(key).T, strict=True)]
        step_s, out = find_max_step_s(motion.time_s), list[Curve]()
        for token, values, sds in lines:
            out += self._curves(Series(motion.time_s, values, sds, motion.is_predicted, step_s), token, points, span_s)
        return out


def zyz_words(motion: MotionCurves) -> str:
    """Say for how much of the time the ZYZ angles are known."""
    known = np.isfinite(motion.zyz_deg[:, 0])
    share = f"{format_rounded(100.0 * float(known.mean()))}{numbers.NARROW_GAP}%" if len(known) else numbers.UNKNOWN
    return tr(
        "α and γ are shown only where their SD is below 30° ({share} of the time). Near the neutral position, only β "
        "and α + γ can be measured."
    ).format(share=share)


# --- paths ------------------------------------------------------------------------------------------------
BAR_LENGTHS_MM = (5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0)
# The view is never narrower, also of a still hand.
MIN_SPAN_MM = 40.0
MAX_BAR_FRACTION = 0.3
VIEW_MARGIN = 1.3
# So many times the hand's axes are drawn along a path, evenly in time.
AXES_COUNT = 9
AXIS_FRACTION, AXIS_ALPHA = 0.075, 170
UP = (0, 2, 2)
ACROSS = (1, 0, 1)
# Seen from above and from the fingers, Y of W0 points to the left on both hands.
ACROSS_SIGN = (-1.0, 1.0, -1.0)


@dataclass(frozen=True, slots=True)
class PathLine:
    """One path: positions (N, 3) in W0, colour, name, and where its marker was visible (N,)."""

    position_mm: FloatArray
    token: str
    name: str
    is_visible: np.ndarray


def wrist_path(curves: MotionCurves) -> list[PathLine]:
    """Return the path of the WRIST marker (wrist paper, figures 3 and 5)."""
    return [PathLine(curves.position_mm, "accent", "", ~curves.is_predicted)]


def finger_paths(curves: MotionCurves) -> list[PathLine]:
    """Return the paths of all fingertips (hand paper, figures 2 and 3)."""
    paths = []
    for finger in FINGERS:
        if (name := f"TIP{finger}") in curves.joint_names:
            k = curves.joint_names.index(name)
            token = "text" if finger == 1 else "flexion" if finger % 2 else "deviation"
            paths.append(PathLine(curves.joint_mm[:, k], token, finger_name(str(finger)), curves.is_joint_seen[:, k]))
    return paths


def plane_names(side: Side) -> tuple[tuple[str, str, str], ...]:
    """Return upward label, horizontal label and title of each plane."""
    thumb = tr("thumb ←") if side == "right" else tr("thumb →")
    return (
        (f"XY · {tr('fingers ↑')}", thumb, tr("From above")),
        (f"ZX · {tr('up ↑')}", tr("fingers →"), tr("From the side")),
        (f"ZY · {tr('up ↑')}", thumb, tr("From the fingers")),
    )


class PathsChart(Chart):
    """Paths in the three planes, with the axes of the hand (N, 3, 3) along the first one if they are given."""

    def __init__(self, theme: Theme, paths: Sequence[PathLine], side: Side, axes: FloatArray | None = None) -> None:
        super().__init__(theme)
        self._paths, self._side, self._axes = paths, side, axes

    def build(self) -> None:
        look, line = self.plot_style, QFontMetricsF(self.plot_style.label_font).height() + 4 * self.plot_style.unit
        gap, every = 16 * look.unit, np.concatenate([path.position_mm for path in self._paths] or [np.empty((0, 3))])
        known = every[np.isfinite(every).all(axis=1)] if np.isfinite(every).all(axis=1).any() else np.zeros((1, 3))
        low_mm, high_mm = known.min(axis=0), known.max(axis=0)
        width = math.floor((self.area.width() - 2 * gap) / 3)
        height = math.floor(min(width, self.area.height() - 2 * line))
        top = self.area.top() + line + 0.5 * (self.area.height() - 2 * line - height)
        needs = np.maximum(VIEW_MARGIN * (high_mm - low_mm), MIN_SPAN_MM)
        mm = float(min(width / needs[list(ACROSS)].max(), height / needs[list(UP)].max()))
        middle, half_width, half_height = 0.5 * (low_mm + high_mm), 0.5 * width / mm, 0.5 * height / mm
        for plane, (up, across, title) in enumerate(plane_names(self._side)):
            box = QRectF(QRectF(self.area.left() + plane * (width + gap), top, width, height).toRect())
            x, y, sign = middle[ACROSS[plane]], middle[UP[plane]], ACROSS_SIGN[plane]
            ends = float(x - sign * half_width), float(x + sign * half_width)
            plot = self.add_plot(Panel(box, Scale(y - half_height, y + half_height, (), ()), *ends), plane)
            plot.setBorder(plot.pen("line", look.grid_width / look.unit))
            self._add_paths(plot, mm)
            self.add_text(up, look.label_font, "text2", (0.0, 0.5)).setPos(box.left(), box.top() - line / 2)
            self.add_text(across, look.label_font, "text2", (1.0, 0.5)).setPos(box.right(), box.top() - line / 2)
            self.add_text(title, look.end_label_font, "text", (0.0, 0.5)).setPos(box.left(), box.bottom() + line / 2)
            self._add_bar(plot, mm)
            self._add_names(plot, QRectF(box.left(), box.bottom() - 1.6 * line, 0.32 * box.width(), 1.6 * line))

    def _add_paths(self, plot: Plot, mm: float) -> None:
        """Add the axes of the hand and the paths: solid if visible, dashed if occluded."""
        across, up, look = ACROSS[plot.key], UP[plot.key], self.plot_style
        if self._axes is not None:
            place_mm = self._paths[0].position_mm
            known = np.flatnonzero(np.isfinite(place_mm).all(axis=1) & np.isfinite(self._axes).all(axis=(1, 2)))
            evenly = np.linspace(0, len(known) - 1, AXES_COUNT if len(known) else 0).round().astype(np.int64)
            length_mm = plot.panel.box.height() * AXIS_FRACTION / mm
            for row in known[np.unique(evenly)].tolist():
                for token, axis in zip(AXIS_TOKENS, self._axes[row].T, strict=True):
                    ends = np.array((place_mm[row], place_mm[row] + length_mm * axis))
                    (x0, x1), (y0, y1) = plot.to_item_x(ends[:, across]), plot.to_item_y(ends[:, up])
                    line = plot.add_to_layer(QGraphicsLineItem(x0, y0, x1, y1), CURVES)
                    line.setPen(QPen(look.color(token, AXIS_ALPHA), look.unit, c=Qt.PenCapStyle.RoundCap))
        for path in self._paths:
            x, y = path.position_mm[:, across], path.position_mm[:, up]
            is_known = np.isfinite(x) & np.isfinite(y)
            for is_seen, dash in ((True, ()), (False, (3.2, 1.2))):
                shown = np.zeros(len(x), dtype=np.int32)
                shown[:-1] = is_known[:-1] & is_known[1:] & (path.is_visible[1:] == is_seen)
                if len(rows := np.flatnonzero(shown | np.roll(shown, 1))):
                    width = 0.5 * look.line_width / look.unit
                    plot.add_line(x[rows], y[rows], path.token, width, dash, shown[rows])

    def _add_names(self, plot: Plot, occupied_box: QRectF) -> None:
        """Write the names at the outermost free points of their paths; omit one without room."""
        box, face, unit, occupied = plot.panel.box, self.plot_style.end_label_font, self.plot_style.unit, [occupied_box]
        metrics = QFontMetricsF(face)
        for path in self._paths:
            x, y = plot.panel.x(path.position_mm[:, ACROSS[plot.key]]), plot.panel.y(path.position_mm[:, UP[plot.key]])
            known = np.flatnonzero(np.isfinite(x) & np.isfinite(y))
            if not path.name or not len(known):
                continue
            width, height = metrics.horizontalAdvance(path.name), metrics.height()
            ends = (0, int(np.argmin(y[known])), int(np.argmax(y[known])), int(np.argmax(x[known])))
            places = [
                QRectF(left, float(y[row]) - height / 2, width, height)
                for row in known[list(ends)].tolist()
                for left in (float(x[row]) + 5 * unit, float(x[row]) - width - 5 * unit)
            ]
            inside = box.adjusted(2, 2, -2, -2)
            free = (one for one in places if inside.contains(one) and not any(map(one.intersects, occupied)))
            if (place := next(free, None)) is not None:
                occupied.append(place)
                plate = self.add_item(QGraphicsRectItem(place.adjusted(-1.0, 2.0, 1.0, -2.0)))
                plate.setPen(pg.mkPen(None))
                plate.setBrush(self.plot_style.color("surface", 200))
                plate.setZValue(FRONT)
                self.add_text(path.name, face, path.token).setPos(place.topLeft())

    def _add_bar(self, plot: Plot, mm: float) -> None:
        """Add the scale bar in the lower left corner: the longest round one within a third of the panel."""
        panel, look, unit = plot.panel, self.plot_style, self.plot_style.unit
        maximum = MAX_BAR_FRACTION * panel.box.width() / mm
        length = max((length for length in BAR_LENGTHS_MM if length <= maximum), default=BAR_LENGTHS_MM[0])
        start, y = panel.to_time(panel.box.left() + 8 * unit), panel.scale.low + 8 * unit / mm
        plot.add_line([start, start + ACROSS_SIGN[plot.key] * length], [y, y], "border", 1.5, layer=LINES)
        words = self.add_text(f"{format_rounded(length)}{numbers.NARROW_GAP}mm", look.label_font, "text2", (0.0, 1.0))
        words.setPos(QPointF(panel.box.left() + 8 * unit, panel.box.bottom() - 10 * unit))
