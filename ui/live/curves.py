"""Ten running seconds of the three angles, or of the two speeds, on fixed scales."""

from __future__ import annotations

import math

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize
from PySide6.QtGui import QFontMetricsF, QPainter, QPaintEvent, QPixmap, QResizeEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from core.output.exercises import AXIS_LIMIT_DEG, AXIS_TICK_DEG, FLEXION, PRONOSUPINATION, SIDES, Exercise
from ui import numbers, terms
from ui.fonts import MEDIUM, REGULAR, SEMIBOLD, font
from ui.live.history import SHOWN_S, History
from ui.plot import axes
from ui.plot.axes import Panel, Scale
from ui.plot.series import paint_point, paint_series
from ui.plot.style import CURVE_TOKENS, screen_style
from ui.theme import CARD_RADIUS_PX, Theme

LEFT_PX, RIGHT_PX, TOP_PX, BOTTOM_PX, BETWEEN_PX = 132, 112, 24, 28, 30
SPEED_TOP_MM_S, SPEED_TOP_DEG_S = 400.0, 400.0
ZERO_BAND_DEG = 0.5
"""Within this of zero the word for the direction stays as it was, so that it does not flutter."""


class LiveCurves(QWidget):
    """Paints the history it is given; the still parts are kept as a picture."""

    def __init__(self, theme: Theme, history: History) -> None:
        super().__init__()
        self._theme, self._history = theme, history
        self._exercise = Exercise("FREE", None, 0, math.nan, False)
        self._targets_deg = (math.nan, math.nan)
        self._speeds = False
        self._single = False
        self._still: QPixmap | None = None
        self._values: list[tuple[str, str, str]] = []
        self._words = [SIDES[k][0] for k in range(3)]
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setAccessibleName(self.tr("Curves of the last ten seconds"))
        theme.changed.connect(self._forget_still)

    def set_exercise(self, exercise: Exercise, target_positive_deg: float, target_negative_deg: float) -> None:
        """Which angle is trained, its targets, and what should stay within limits."""
        self._exercise = exercise
        self._targets_deg = (target_positive_deg, target_negative_deg)
        self._forget_still()

    def show_speeds(self, on: bool) -> None:
        """Linear and angular speed instead of the angles."""
        if on != self._speeds:
            self._speeds = on
            self.refresh_values()
            self._forget_still()

    def show_single(self, on: bool) -> None:
        """Only the trained angle, where large text leaves no room for three."""
        if on != self._single:
            self._single = on
            self._forget_still()

    @property
    def shows_speeds(self) -> bool:
        """Whether the speeds are shown."""
        return self._speeds

    def refresh_values(self) -> None:
        """Take the figures at the right anew; called at most ten times a second."""
        if self._speeds:
            linear, angular = self._history.speeds if not self._history.waiting else (math.nan, math.nan)
            words = (self.tr("Turning"), numbers.speed(angular), ""), (self.tr("Moving"), _mm_s(linear), "")
            self._values = list(words)
            return
        angles, sds = self._history.angles_deg, self._history.sds_deg
        self._values = []
        for k in range(3):
            if math.isfinite(angles[k]) and abs(angles[k]) > ZERO_BAND_DEG:
                self._words[k] = SIDES[k][0 if angles[k] > 0 else 1]
            known = math.isfinite(angles[k]) and not self._history.waiting
            name = terms.movement_name(self._words[k]) if known else self.tr("no value")
            if known and abs(angles[k]) < ZERO_BAND_DEG:
                name = terms.movement_at_zero(k)
            self._values.append(
                (name, numbers.degrees(angles[k]) if known else "", numbers.spread(sds[k]) if known else "")
            )

    def _forget_still(self) -> None:
        self._still = None
        self.update()

    def sizeHint(self) -> QSize:
        return QSize(696, 396)

    def minimumSizeHint(self) -> QSize:
        return QSize(420, 260)

    def resizeEvent(self, event: QResizeEvent) -> None:
        self._forget_still()

    def panels(self) -> list[tuple[Panel, int]]:
        """The panels with the column each shows; the trained angle is twice as high and first."""
        now = self._history.now_s if math.isfinite(self._history.now_s) else 0.0
        scale = self._theme.text_scale
        left, right = LEFT_PX * scale, RIGHT_PX * scale
        width = self.width() - left - right
        order: list[tuple[int, Scale, float]]
        if self._speeds:
            order = [
                (1, axes.rising_scale(SPEED_TOP_DEG_S, 100.0, "°/s", self.tr("Turning")), 1.0),
                (0, axes.rising_scale(SPEED_TOP_MM_S, 100.0, " mm/s", self.tr("Moving")), 1.0),
            ][: 1 if self._single else 2]
        else:
            order = [(k, self._angle_scale(k), 2.0 if k == self._first() else 1.0) for k in self._order()]
        between = BETWEEN_PX * scale
        height = self.height() - (TOP_PX + BOTTOM_PX) * scale - between * (len(order) - 1)
        unit = height / sum(share for _, _, share in order)
        top = TOP_PX * scale
        out = []
        for column, panel_scale, share in order:
            box = QRectF(left, top, width, unit * share)
            out.append((Panel(box, panel_scale, now - SHOWN_S, now), column))
            top += unit * share + between
        return out

    def _first(self) -> int:
        return FLEXION if self._exercise.angle is None else self._exercise.angle

    def _order(self) -> list[int]:
        first = self._first()
        return [first] if self._single else [first, *[k for k in (FLEXION, 0, PRONOSUPINATION) if k != first]]

    def _angle_scale(self, k: int) -> Scale:
        upper, lower = (terms.movement_name(name) for name in SIDES[k])
        return axes.angle_scale(AXIS_TICK_DEG[k], AXIS_LIMIT_DEG[k], upper, lower, tight=k != self._first())

    def paintEvent(self, event: QPaintEvent) -> None:
        panels = self.panels()
        if self._still is None:
            self._still = self._paint_still(panels)
        painter = QPainter(self)
        painter.drawPixmap(0, 0, self._still)
        style = screen_style(self._theme)
        for (panel, column), value in zip(panels, self._values_in(panels), strict=True):
            series = self._history.speed(column) if self._speeds else self._history.angle(column)
            token = "curve_c" if self._speeds else CURVE_TOKENS[column]
            painter.save()
            painter.setClipRect(panel.box.adjusted(0, -1, 7, 1).toAlignedRect())
            paint_series(painter, style, panel, series, token)
            painter.restore()
            if self._history.waiting and len(series.value):
                left = float(np.clip(panel.x(float(series.time_s[-1])), panel.box.left(), panel.box.right()))
                axes.hatch(painter, style, QRectF(left, panel.box.top(), panel.box.right() - left, panel.box.height()))
            elif len(series.value):
                paint_point(painter, style, panel, float(series.time_s[-1]), float(series.value[-1]), token)
            self._paint_value(painter, panel, *value)

    def _values_in(self, panels: list[tuple[Panel, int]]) -> list[tuple[str, str, str]]:
        if not self._values:
            return [("", "", "")] * len(panels)
        return self._values[: len(panels)] if self._speeds else [self._values[column] for _, column in panels]

    def _paint_value(self, painter: QPainter, panel: Panel, name: str, value: str, spread: str) -> None:
        theme, scale = self._theme, self._theme.text_scale
        left = panel.box.right() + 14 * scale
        middle = panel.box.center().y()
        painter.setFont(font(14 * scale, REGULAR))
        painter.setPen(theme.color("text2"))
        painter.drawText(QPointF(left, middle - 5 * scale), name)
        painter.setFont(font(20 * scale, SEMIBOLD))
        painter.setPen(theme.color("text"))
        painter.drawText(QPointF(left, middle + 18 * scale), value)
        advance = QFontMetricsF(painter.font()).horizontalAdvance(value)
        painter.setFont(font(14 * scale, MEDIUM))
        painter.setPen(theme.color("text2"))
        painter.drawText(QPointF(left + advance + 5 * scale, middle + 18 * scale), spread)

    def _paint_still(self, panels: list[tuple[Panel, int]]) -> QPixmap:
        ratio = self.devicePixelRatioF()
        picture = QPixmap(round(self.width() * ratio), round(self.height() * ratio))
        picture.setDevicePixelRatio(ratio)
        picture.fill(self._theme.color("canvas"))
        painter = QPainter(picture)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(self._theme.color("line"))
        painter.setBrush(self._theme.color("surface"))
        frame = QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5)
        painter.drawRoundedRect(frame, CARD_RADIUS_PX, CARD_RADIUS_PX)
        style = screen_style(self._theme)
        for panel, column in panels:
            if not self._speeds:
                self._paint_limits(painter, panel, column)
            axes.paint_scale(painter, style, panel)
            if not self._speeds and column == self._first():
                for value in self._targets_deg:
                    if math.isfinite(value):
                        words = self.tr("Target {angle}").format(angle=numbers.degrees(value))
                        axes.paint_target(painter, style, panel, value, words)
        last = panels[-1][0]
        labels = [(last.end_s - ago, str(ago)) for ago in (8, 6, 4, 2)]
        labels += [(last.start_s + 0.55, self.tr("10 s ago")), (last.end_s, self.tr("now"))]
        axes.paint_times(painter, style, last, last.box.bottom() + 9 * self._theme.text_scale, labels)
        painter.end()
        return picture

    def _paint_limits(self, painter: QPainter, panel: Panel, column: int) -> None:
        style = screen_style(self._theme)
        limit = self._exercise.trick_limit_deg
        if column != self._first() and math.isfinite(limit):
            words = self.tr("should stay within {angle}").format(angle=numbers.degrees(limit))
            if column == PRONOSUPINATION:
                words = self.tr("0° = palm down; stay within {angle}").format(angle=numbers.degrees(limit))
            axes.paint_stay_within(painter, style, panel, limit, words)
        elif column == PRONOSUPINATION:
            painter.setFont(style.label)
            painter.setPen(style.color("text2"))
            painter.drawText(QPointF(panel.box.left() + 6, float(panel.y(0.0)) - 5), self.tr("0° = palm down"))


def _mm_s(value: float) -> str:
    return f"{round(value)}{numbers.NARROW_GAP}mm/s" if np.isfinite(value) else numbers.UNKNOWN
