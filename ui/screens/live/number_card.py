"""The large number: movement, angle, standard deviation, repetitions, and how they are read."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QFontMetricsF, QPainter, QPainterPath, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from carpus.core.model.hand.exercises import PRONOSUPINATION, Exercise, get_exercise
from carpus.core.model.hand.forearm_rotation import axis_limits_deg, is_counted_from_thumb_up
from carpus.core.model.rounding import format_rounded
from carpus.core.model.types import TrackStatus
from carpus.core.records.session_setup import SessionSetup
from carpus.ui.charts.history import History
from carpus.ui.charts.panel import draw_hatching, screen_style
from carpus.ui.kit import numbers
from carpus.ui.kit.card import paint_card
from carpus.ui.kit.fonts import MEDIUM, REGULAR, SEMIBOLD, font
from carpus.ui.kit.icons import paint_state
from carpus.ui.kit.theme import CURVE_TOKENS, Theme
from carpus.ui.kit.translate import to_mid_sentence
from carpus.ui.screens.live.recording import RecordingController
from carpus.ui.words import terms
from carpus.ui.words.finger_angles import FINGER_ANGLES, FINGERS, FingerAngle, spread_side

NUMBER_PX, NUMBER_WIDE_PX = 128, 160
WIDE_FROM_PX = 900
MAX_DOTS = 12
SPREAD_PX = 44
MIN_NUMBER_PX = 72.0
RIGHT_PX, NARROW_RIGHT_PX, NARROW_BELOW_PX = 230, 182, 640
MAX_SHRINK_PX = 26
"""Height that the card may lose with large text: the dots of the repetitions disappear."""


@dataclass(frozen=True, slots=True)
class Reading:
    """What the card shows.

    ``angle`` is the wrist's column, unless ``figure`` names a finger angle. Best values are NaN until something was
    measured.
    """

    angle: int = 1
    figure: FingerAngle | None = None
    value_deg: float = math.nan
    sd_deg: float = math.nan
    is_predicted: bool = False
    is_doubtful: bool = False
    """Measured, but contradicted by visible markers: not counted."""
    repetitions_done: int = 0
    repetitions_asked: int = 0
    is_repetition_running: bool = False
    best_positive_deg: float = math.nan
    best_negative_deg: float = math.nan
    is_best_lower_bound: bool = False
    """True if the joint moved further than the best value while it was hidden."""
    target_positive_deg: float = math.nan
    target_negative_deg: float = math.nan

    def with_next_angle(self) -> Reading:
        if self.figure is None:
            return Reading(angle=(self.angle + 1) % 3)
        own = [figure for figure in FINGER_ANGLES if figure.finger == self.figure.finger]
        return Reading(figure=own[(own.index(self.figure) + 1) % len(own)])

    def with_next_finger(self) -> Reading:
        figure = self.figure
        return self if figure is None else Reading(figure=FingerAngle(figure.finger % len(FINGERS) + 1, figure.kind))

    def with_targets(self, set_up: SessionSetup | None) -> Reading:
        """Return the reading with the goals of the exercise, if it trains the angle shown."""
        figure = self.figure
        if set_up is None or (
            figure.joint != set_up.exercise.joint if figure is not None else self.angle != set_up.exercise.angle
        ):
            return self
        return replace(
            self, target_positive_deg=set_up.target_positive_deg, target_negative_deg=set_up.target_negative_deg
        )


def current_reading(shown: Reading, history: History, recording: RecordingController) -> Reading:
    """Return the present values of the angle that is shown."""
    figure, count, lost = shown.figure, recording.counter, recording.camera_lost
    if figure is not None:
        column = FINGER_ANGLES.index(figure)
        value, sd, measured = history.angle_value(column)
        inferred = history.is_inferred(column)
        known, own = (measured or inferred) and not lost, count is not None and count.joint == figure.joint
        reading = Reading(figure=figure, is_predicted=known and inferred)
    else:
        angle, status = shown.angle, history.status
        value, sd = float(history.angles_deg[angle]), float(history.sds_deg[angle])
        known, own = not lost, count is not None and count.angle == angle
        doubtful = known and status == TrackStatus.DOUBTFUL
        reading = Reading(angle=angle, is_predicted=known and status == TrackStatus.PREDICTED, is_doubtful=doubtful)
    asked = recording.set_up.repetitions if recording.set_up else 0
    reading = replace(
        reading, value_deg=value if known else math.nan, sd_deg=sd if known else math.nan,
        repetitions_done=recording.repetitions, repetitions_asked=asked,
        is_repetition_running=recording.state == "recording" and recording.repetitions < asked,
    )  # fmt: skip
    if count is not None and own:
        backwards_deg = count.best_negative_deg if figure is None else math.nan  # no joint trains beyond straight
        reading = replace(
            reading, best_positive_deg=count.best_positive_deg, best_negative_deg=backwards_deg,
            is_best_lower_bound=count.is_best_lower_bound,
        )  # fmt: skip
    return reading.with_targets(recording.set_up)


class NumberCard(QWidget):
    """Paints a :class:`Reading` in fixed places."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self.reading = Reading()
        self.exercise: Exercise = get_exercise("")
        self._direction = 1.0
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Maximum)
        theme.changed.connect(self.updateGeometry)

    def show_reading(self, reading: Reading) -> None:
        """Show new values; the word for the direction stays while the angle is about zero."""
        if reading.angle != self.reading.angle:
            self._direction = 1.0
        if math.isfinite(reading.value_deg) and abs(reading.value_deg) > 0.5:
            self._direction = reading.value_deg
        if reading != self.reading:
            self.reading = replace(reading)
            self.setAccessibleName(
                f"{self.movement_name()} {numbers.format_with_sd(reading.value_deg, reading.sd_deg)}"
            )
            self.update()

    def movement_name(self) -> str:
        """Return the name of the present movement, or of the finger and its joint."""
        figure = self.reading.figure
        if figure is not None and figure.kind == "tam":
            return self.tr("{finger}, total active motion (TAM)").format(finger=figure.long_name.split(",")[0])
        if (
            figure is not None
            and figure.kind == "spread"
            and (side := spread_side(self.reading.value_deg, figure.finger))
        ):
            return self.tr("{joint}, {side}").format(joint=figure.long_name, side=side)
        if figure is not None:
            return figure.long_name
        value = self.reading.value_deg
        if math.isfinite(value) and abs(value) < 0.5:
            return terms.neutral_name(self.reading.angle, self.exercise)
        return terms.direction_long_name(self.reading.angle, self._direction, self.exercise)

    def _is_supination_only(self) -> bool:
        """Tell whether only supination from palm down is trained, without a goal for pronation."""
        turns = self.reading.angle == PRONOSUPINATION and is_counted_from_thumb_up(self.exercise)
        return turns and not math.isfinite(self.reading.target_negative_deg)

    def _gauge_range(self) -> tuple[float, float, str, str]:
        figure = self.reading.figure
        if figure is not None:
            return *figure.range_deg, *figure.range_end_names
        top_deg, _ = axis_limits_deg(self.reading.angle, self.exercise)
        upper, lower = terms.direction_names(self.reading.angle, self.exercise)
        return -top_deg, top_deg, f"{lower} {format_rounded(top_deg)}°", f"{upper} {format_rounded(top_deg)}°"

    def _number_px(self) -> float:
        """Return the size of the number: as designed, or smaller if the widest value needs it."""
        if self.width() >= WIDE_FROM_PX * self._theme.text_scale:
            return float(NUMBER_WIDE_PX)
        return max(MIN_NUMBER_PX, min(NUMBER_PX, self._max_number_px()))

    def _max_number_px(self) -> float:
        """Return the size at which the widest value fits beside its spread and the right column."""
        widest = numbers.format_degrees(round(max(abs(end) for end in self._gauge_range()[:2]), -1))
        needed = QFontMetricsF(font(NUMBER_PX, SEMIBOLD)).horizontalAdvance(widest)
        spread = QFontMetricsF(font(SPREAD_PX, MEDIUM)).horizontalAdvance(numbers.format_sd(10.0))
        room = self.width() - 24 - self._right_px() - spread - 20
        return NUMBER_PX * room / needed

    def _right_px(self) -> float:
        narrow = self.width() < NARROW_BELOW_PX * self._theme.text_scale
        return (NARROW_RIGHT_PX if narrow else RIGHT_PX) * self._theme.text_scale

    def sizeHint(self) -> QSize:
        return QSize(696, round(236 + max(self._number_px() - NUMBER_PX, 0.0) + 130 * (self._theme.text_scale - 1)))

    def minimumSizeHint(self) -> QSize:
        whole = self.sizeHint().height()
        return QSize(520, whole - (MAX_SHRINK_PX if self._theme.text_scale > 1.0 else 0))

    def _shrink_px(self) -> float:
        """Return the height that the card has lost to large text."""
        return min(max(self.sizeHint().height() - self.height(), 0.0), MAX_SHRINK_PX)

    def resizeEvent(self, event) -> None:  # type: ignore[no-untyped-def]
        self.updateGeometry()

    def paintEvent(self, event: QPaintEvent) -> None:
        theme, scale, reading = self._theme, self._theme.text_scale, self.reading
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        paint_card(painter, theme, QRectF(self.rect()))
        token = CURVE_TOKENS[reading.angle] if reading.figure is None else reading.figure.token
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(theme.color(token))
        painter.drawRoundedRect(QRectF(24, 24, 6, 20 * scale), 3, 3)
        room = self.width() - self._right_px() - 52
        size = 28 * scale
        while size > 20 and QFontMetricsF(font(size, SEMIBOLD)).horizontalAdvance(self.movement_name()) > room:
            size -= 1
        painter.setFont(font(size, SEMIBOLD))
        painter.setPen(theme.color("text"))
        painter.drawText(QRectF(40, 14, room, 40 * scale), int(Qt.AlignmentFlag.AlignVCenter), self.movement_name())
        if reading.is_doubtful:
            self._paint_doubtful(
                painter, 40 + QFontMetricsF(painter.font()).horizontalAdvance(self.movement_name()), room
            )
        self._paint_number(painter, 24.0, 36 * scale + 20)
        self._paint_right(painter)
        self._paint_gauge(painter, QRectF(24, self.height() - 42 * scale, self.width() - 48, 12), token)

    def _paint_doubtful(self, painter: QPainter, left: float, room: float) -> None:
        """Paint the warning beside the movement, shorter if space is short."""
        theme, scale = self._theme, self._theme.text_scale
        painter.setFont(font(16 * scale, SEMIBOLD))
        metrics, sign = QFontMetricsF(painter.font()), 20 * scale
        for words in (self.tr("uncertain, excluded"), self.tr("uncertain")):
            if left + 20 + sign + 8 + metrics.horizontalAdvance(words) <= 40 + room:
                box = QRectF(left + 20, 14 + 20 * scale - sign / 2, sign, sign)
                paint_state(painter, "warn", box, theme.color("warn"), theme.color("surface"))
                painter.setPen(theme.color("warn"))
                place = QRectF(box.right() + 8, 14, room, 40 * scale)
                painter.drawText(place, int(Qt.AlignmentFlag.AlignVCenter), words)
                return

    def _paint_number(self, painter: QPainter, left: float, top: float) -> None:
        theme, scale, reading = self._theme, self._theme.text_scale, self.reading
        size = self._number_px()
        painter.setFont(font(size, SEMIBOLD))
        metrics = QFontMetricsF(painter.font())
        baseline = top + QFontMetricsF(font(max(size, NUMBER_PX), SEMIBOLD)).capHeight() + 16
        text = numbers.format_degrees(reading.value_deg)
        known = math.isfinite(reading.value_deg)
        painter.setPen(theme.color("text2" if reading.is_predicted or reading.is_doubtful or not known else "text"))
        painter.drawText(QPointF(left - 0.035 * size, baseline), text)
        beside = left + metrics.horizontalAdvance(text) + 8
        if not known:
            # A dash of this size alone reads as a bar or a minus sign: the word says what it is.
            painter.setFont(font(28 * scale, SEMIBOLD))
            painter.setPen(theme.color("text2"))
            painter.drawText(QPointF(beside + 4, baseline - 0.16 * size), self.tr("no value"))
        elif reading.is_predicted:
            swatch = QRectF(beside + 4, baseline - 30 * scale, 28 * scale, 28 * scale)
            draw_hatching(painter, screen_style(theme), swatch)
            painter.setFont(font(28 * scale, SEMIBOLD))
            painter.setPen(theme.color("text2"))
            words = self.tr("predicted") if reading.figure is None else self.tr("inferred from PIP")
            painter.drawText(QPointF(swatch.right() + 10, baseline), words)
        else:
            painter.setFont(font(SPREAD_PX, MEDIUM))
            painter.setPen(theme.color("text2"))
            painter.drawText(QPointF(beside + 4, baseline), numbers.format_sd(reading.sd_deg))

    def _paint_right(self, painter: QPainter) -> None:
        theme, scale, reading = self._theme, self._theme.text_scale, self.reading
        left = self.width() - self._right_px()
        y = 16.0
        if reading.repetitions_asked:
            self._paint_text(painter, self.tr("Repetitions"), left, y, 14, REGULAR, "text2")
            number = min(reading.repetitions_done, 99)  # the running one is a half dot: it may turn out to be none
            painter.setFont(font(44, SEMIBOLD))
            metrics = QFontMetricsF(painter.font())
            baseline = y + 22 * scale + metrics.capHeight() + 6
            painter.setPen(theme.color("text"))
            painter.drawText(QPointF(left, baseline), str(number))
            across = left + metrics.horizontalAdvance(str(number)) + 8
            painter.setFont(font(28 * min(scale, 1.25), MEDIUM))
            painter.setPen(theme.color("text2"))
            painter.drawText(QPointF(across, baseline), self.tr("of {asked}").format(asked=reading.repetitions_asked))
            if self._shrink_px() < 8.0:  # the number says as much
                self._paint_dots(painter, left, baseline + 19)
        y = 114 * (0.65 + 0.35 * scale) + max(self._number_px() - NUMBER_PX, 0.0) / 3 - self._shrink_px()
        positive = reading.figure is not None or self._direction > 0.0 or self._is_supination_only()
        best = reading.best_positive_deg if positive else reading.best_negative_deg
        words = self.tr("Best today")
        if reading.figure is None:
            movement = terms.direction_names(reading.angle, self.exercise)[0 if positive else 1]
            words = self.tr("Best {movement}").format(movement=to_mid_sentence(movement))
        self._paint_text(painter, words, left, y, 14, REGULAR, "text2")
        bound = reading.is_best_lower_bound and math.isfinite(best)
        shown = numbers.format_signed_degrees(best if positive else -best)
        shown = f"≥{numbers.NARROW_GAP}{shown}" if bound else shown
        self._paint_text(painter, shown, left, y + 21 * scale, 20, SEMIBOLD, "text")

    def _paint_text(
        self, painter: QPainter, text: str, left: float, top: float, size: int, weight: int, token: str
    ) -> None:
        painter.setFont(font(size * self._theme.text_scale, weight))
        painter.setPen(self._theme.color(token))
        painter.drawText(QPointF(left, top + QFontMetricsF(painter.font()).ascent()), text)

    def _paint_dots(self, painter: QPainter, left: float, middle: float) -> None:
        reading, color = self.reading, self._theme.color
        count = min(reading.repetitions_asked, MAX_DOTS)
        step = min(20.5, (self.width() - left - 30) / max(count, 1))
        for number in range(count):
            center = QPointF(left + 6 + number * step, middle)
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(color("accent"))
            if number < reading.repetitions_done:
                painter.drawEllipse(center, 6, 6)
                continue
            painter.setBrush(Qt.BrushStyle.NoBrush)
            running = number == reading.repetitions_done and reading.is_repetition_running
            painter.setPen(QPen(color("accent" if running else "border"), 1.3))
            painter.drawEllipse(center, 5.4, 5.4)
            if running:
                half = QPainterPath(QPointF(center.x(), center.y() - 5.4))
                half.arcTo(QRectF(center.x() - 5.4, center.y() - 5.4, 10.8, 10.8), 90, 180)
                half.closeSubpath()
                painter.fillPath(half, color("accent"))

    def _paint_gauge(self, painter: QPainter, box: QRectF, token: str) -> None:
        theme, scale, reading = self._theme, self._theme.text_scale, self.reading
        low_deg, high_deg, lower, upper = self._gauge_range()

        def x(value_deg: float) -> float:
            share = (value_deg - low_deg) / (high_deg - low_deg)
            return box.left() + max(0.0, min(1.0, share)) * box.width()

        zero_x = x(0.0)

        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(theme.color("sunken"))
        painter.drawRoundedRect(box, 6, 6)
        middle = box.center().y()
        if math.isfinite(reading.value_deg):
            value_x = x(reading.value_deg)
            bar = QRectF(min(value_x, zero_x), box.top(), abs(value_x - zero_x), box.height())
            if reading.is_predicted:
                draw_hatching(painter, screen_style(theme), bar, token, 200)
            else:
                painter.fillRect(bar, theme.color(token))
            painter.fillRect(QRectF(value_x - 1.5, middle - 10, 3, 20), theme.color("text"))
        for best in (reading.best_positive_deg, reading.best_negative_deg):
            if math.isfinite(best) and abs(best) > 1.0:
                painter.fillRect(QRectF(x(best) - 1, middle - 7, 2, 14), theme.color("text2"))
        painter.fillRect(QRectF(zero_x - 0.5, box.top(), 1, box.height()), theme.color("border"))
        for target, way in ((reading.target_positive_deg, 1), (reading.target_negative_deg, -1)):
            if math.isfinite(target):
                painter.fillRect(QRectF(x(target) - 1.5, middle - 14, 3, 28), theme.color("accent"))
                words = self.tr("Goal {angle}").format(angle=numbers.format_signed_degrees(way * target))
                painter.setFont(font(16 * scale, SEMIBOLD))
                width = QFontMetricsF(painter.font()).horizontalAdvance(words)
                left = max(box.left(), min(box.right() - width, x(target) - width + 8 if target > 0 else x(target) - 8))
                painter.setPen(theme.color("accent"))
                painter.drawText(QPointF(left, middle - 17), words)
        painter.setFont(font(12 * scale, MEDIUM))
        painter.setPen(theme.color("text2"))
        under = QRectF(box.left(), box.bottom() + 6, box.width(), 18 * scale)
        painter.drawText(under, int(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignTop), lower)
        if low_deg < 0.0:
            painter.drawText(under, int(Qt.AlignmentFlag.AlignHCenter | Qt.AlignmentFlag.AlignTop), "0°")
        painter.drawText(under, int(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignTop), upper)
