"""The patient's view, read from two or three metres: task, hand, way to the goal, repetitions.

Drawn on a plane 1080 high and at least 1440 wide, scaled to the window.
"""

from __future__ import annotations

import math

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPainterPath, QPaintEvent, QPen, QTransform
from PySide6.QtWidgets import QWidget

from carpus.core.model.hand.exercises import FLEXION, PRONOSUPINATION, Exercise
from carpus.core.records.session_setup import SessionSetup
from carpus.ui.kit import numbers
from carpus.ui.kit.fonts import SEMIBOLD, font
from carpus.ui.kit.icons import paint_icon, paint_state
from carpus.ui.kit.theme import Theme
from carpus.ui.picture.hand_pose import Arc, DrawnPose, build_free_pose, build_pose, find_arc
from carpus.ui.picture.movement_guide import GuideScene
from carpus.ui.words.patient import Audience, PatientWords, next_task_words, patient_words, remaining_rest_words

HEIGHT, MIN_WIDTH = 1080.0, 1440.0
MARGIN = 96.0
TASK_PX, STATE_PX, SMALL_PX = 64.0, 128.0, 44.0
MIN_TEXT_PX = 36.0
ARC_WIDTH, ARC_WIDTH_CHILD = 46.0, 58.0
MAX_MARKS = 20
MAX_ARC_DEG = 80.0
"""End of the path without a goal."""


class PatientView(QWidget):
    """Paints a :class:`GuideScene` of one exercise."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._set_up: SessionSetup | None = None
        self.audience: Audience = "adult"
        self.sound_on = False
        self.scene = GuideScene()
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        theme.changed.connect(self.update)

    def sizeHint(self) -> QSize:
        return QSize(1280, 720)

    def show_set_up(self, set_up: SessionSetup | None) -> None:
        self._set_up = set_up
        self.audience = "child" if set_up is not None and set_up.for_child else "adult"
        self.show_scene(GuideScene())

    def show_scene(self, scene: GuideScene) -> None:
        if scene != self.scene:
            self.scene = scene
            words = self.words()
            self.setAccessibleName(" ".join(part for part in (words.task, words.state) if part))
            self.update()

    def words(self) -> PatientWords:
        return patient_words(self._set_up.exercise.id if self._set_up else "", self.scene, self.audience)

    # --- painting -----------------------------------------------------------------------------------------
    def _write(
        self,
        painter: QPainter,
        box: QRectF,
        words: str,
        size: float,
        token: str,
        aligned: Qt.AlignmentFlag = Qt.AlignmentFlag.AlignLeft,
    ) -> None:
        """Draw a text, smaller only if it would not fit into two lines."""
        flags, size = int(aligned | Qt.TextFlag.TextWordWrap), size * self._theme.text_scale
        while True:
            face = font(size, SEMIBOLD)
            needed = QFontMetricsF(face).boundingRect(QRectF(0, 0, box.width(), 10_000), flags, words)
            if size <= MIN_TEXT_PX or (needed.height() <= box.height() and needed.width() <= box.width()):
                break
            size -= 4.0
        painter.setFont(face)
        painter.setPen(self._theme.color(token))
        painter.drawText(box, flags, words)

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.fillRect(self.rect(), self._theme.color("canvas"))
        scale = min(self.width() / MIN_WIDTH, self.height() / HEIGHT)
        if scale <= 0.0:
            return
        painter.scale(scale, scale)
        width, height = self.width() / scale, self.height() / scale
        painter.translate(0, (height - HEIGHT) / 2)
        shown = self._set_up is not None and self.scene.phase not in ("away", "done", "paused", "rest")
        if shown and self._set_up is not None:
            self._paint_exercise(painter, self._set_up, width)
        self._paint_words(painter, width, shown)
        if self.sound_on:
            paint_icon(painter, "volume-2", QRectF(width - MARGIN - 36, 984, 44, 44), self._theme.color("text2"))

    def _paint_words(self, painter: QPainter, width: float, shown: bool) -> None:
        words, scene = self.words(), self.scene
        if not shown:
            box = QRectF(MARGIN, 300, width - 2 * MARGIN, 220)
            self._write(painter, box, words.state, STATE_PX, "text")
            self._write(painter, box.translated(0, 210), words.task, TASK_PX, "text2")
            if scene.asked and scene.phase in ("done", "rest"):
                self._paint_marks(painter, QPointF(MARGIN, 800), 0.45 * width)
            if scene.phase == "rest":
                self._paint_rest(painter, width)
            return
        self._write(painter, QRectF(MARGIN, 72, 0.5 * width, 170), words.task, TASK_PX, "text2")
        token = "good" if scene.phase == "there" else "text"
        bottom = Qt.AlignmentFlag.AlignBottom
        self._write(painter, QRectF(MARGIN, 840, width * 0.5, 190), words.state, STATE_PX, token, bottom)
        if scene.asked:
            self._paint_marks(painter, QPointF(MARGIN, 760), 0.4 * width)

    def _paint_rest(self, painter: QPainter, width: float) -> None:
        """Paint a ring that runs down in ten steps."""
        scene, color = self.scene, self._theme.color
        ring = QRectF(0.73 * width - 220, 230, 440, 440)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        for token, share in (("norm", 1.0), ("accent", scene.rest_share)):
            painter.setPen(QPen(color(token), 44, Qt.PenStyle.SolidLine, Qt.PenCapStyle.FlatCap))
            painter.drawArc(ring, 90 * 16, round(-360 * 16 * share))
        box = QRectF(0.73 * width - 0.24 * width, 740, 0.48 * width, 100)
        middle = Qt.AlignmentFlag.AlignHCenter
        self._write(painter, box, remaining_rest_words(scene.rest_s), TASK_PX, "text", middle)
        if self._set_up is not None:
            words = next_task_words(self._set_up.exercise.id, self.audience)
            self._write(painter, box.translated(0, 110), words, SMALL_PX, "text2", middle)

    def _paint_marks(self, painter: QPainter, at: QPointF, room: float) -> None:
        """Paint repetitions as checks or flowers; many as a number."""
        scene, color = self.scene, self._theme.color
        size = 52.0 if self.audience == "child" else 44.0
        if scene.asked > MAX_MARKS:
            words = self.tr("{done} of {asked}").format(done=scene.done, asked=scene.asked)
            self._write(painter, QRectF(at.x(), at.y(), room, 70), words, SMALL_PX, "text2")
            return
        in_row = max(1, min(scene.asked, int(room // (size + 14))))
        rows = -(-scene.asked // in_row)
        for number in range(scene.asked):
            row, column = divmod(number, in_row)
            box = QRectF(at.x() + column * (size + 14), at.y() - (rows - 1 - row) * (size + 14), size, size)
            if self.audience == "child" and number < scene.done:
                paint_flower(painter, self._theme, box.center(), size / 2, open_share=1.0)
            else:
                is_done = number < scene.done
                token = "accent" if is_done else "border"
                paint_state(painter, "good" if is_done else "open", box, color(token), color("on_accent"))

    def _paint_exercise(self, painter: QPainter, set_up: SessionSetup, width: float) -> None:
        exercise, scene = set_up.exercise, self.scene
        to = _placement(exercise, width, mirrored=set_up.side == "left")
        hand: DrawnPose | None = None
        if scene.phase == "free":
            if all(math.isfinite(value) for value in scene.wrist_deg):
                hand = build_free_pose(exercise, scene.wrist_deg, scene.mean_flexion_deg)
            self._paint_hand(painter, to, hand)
            return
        if math.isfinite(scene.value_deg):
            hand = build_pose(exercise, scene.value_deg)
        self._paint_arc(painter, to, find_arc(exercise))
        goal = build_pose(exercise, scene.goal_deg) if math.isfinite(scene.goal_deg) else None
        if goal is not None and scene.phase != "there":
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.setPen(QPen(self._theme.color("accent"), 4, Qt.PenStyle.DashLine))
            painter.drawPath(to.map(goal.hand))
        self._paint_hand(painter, to, hand, arm=build_pose(exercise, 0.0))
        self._paint_goal(painter, to, exercise)

    def _paint_hand(
        self, painter: QPainter, to: QTransform, hand: DrawnPose | None, arm: DrawnPose | None = None
    ) -> None:
        """Paint the arm, and the hand if its pose is known; it fades while it is not visible."""
        color, line = self._theme.color, 8.0 if self.audience == "child" else 5.0
        painter.setPen(QPen(color("border"), line))
        painter.setBrush(color("sunken"))
        rest = hand or arm
        if rest is not None:
            painter.drawPath(to.map(rest.arm))
        if hand is None:
            return
        painter.save()
        painter.setOpacity(self.scene.opacity)
        painter.setPen(
            QPen(color("text2"), line, Qt.PenStyle.SolidLine, Qt.PenCapStyle.RoundCap, Qt.PenJoinStyle.RoundJoin)
        )
        painter.setBrush(color("warn_soft" if self.audience == "child" else "soft"))
        for path in (hand.hand_and_arm, *hand.digits):
            painter.drawPath(to.map(path))
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(color("flexion"))
        for dot in hand.dots:
            painter.drawEllipse(to.map(dot), hand.dot_radius, hand.dot_radius)
        painter.restore()

    def _paint_arc(self, painter: QPainter, to: QTransform, arc: Arc) -> None:
        scene, color = self.scene, self._theme.color
        child = self.audience == "child"
        wide = ARC_WIDTH_CHILD if child else ARC_WIDTH
        if math.isfinite(scene.goal_deg):
            self._stroke(painter, to.map(arc.path(0.0, scene.goal_deg)), wide, color("norm"))
        if not math.isfinite(scene.value_deg):
            return
        end = abs(scene.goal_deg) if math.isfinite(scene.goal_deg) else MAX_ARC_DEG
        along = min(max(scene.direction * scene.value_deg, 0.0), end)
        way = to.map(arc.path(0.0, scene.direction * along))
        painter.save()
        painter.setOpacity(scene.opacity)
        if child:
            self._stroke(painter, way, wide, color("good"))  # a stem
            ahead = to.map(arc.point(scene.direction * (along + 1.0))) - to.map(arc.point(scene.direction * along))
            paint_climber(painter, self._theme, to.map(arc.point(scene.direction * along)), ahead, 0.85 * wide)
        else:
            token = "good" if scene.phase == "there" else "accent"
            self._stroke(painter, way, wide, color(token))
            painter.setPen(QPen(color(token), 8))
            painter.setBrush(color("surface"))
            painter.drawEllipse(to.map(arc.point(scene.direction * along)), 0.8 * wide, 0.8 * wide)
        painter.restore()

    def _paint_goal(self, painter: QPainter, to: QTransform, exercise: Exercise) -> None:
        scene, color, arc = self.scene, self._theme.color, find_arc(exercise)
        if not math.isfinite(scene.goal_deg):
            return
        at = to.map(arc.point(scene.goal_deg))
        reached = scene.phase == "there"
        if self.audience == "child":
            paint_flower(painter, self._theme, at, 78.0, open_share=1.0 if reached else 0.45)
            return
        if reached:
            paint_state(painter, "good", QRectF(at.x() - 62, at.y() - 62, 124, 124), color("good"), color("surface"))
        else:
            painter.setPen(QPen(color("accent"), 8))
            for radius, token in ((62.0, "surface"), (32.0, "surface"), (9.0, "accent")):
                painter.setBrush(color(token))
                painter.drawEllipse(at, radius, radius)
        painter.setFont(font(SMALL_PX * min(self._theme.text_scale, 1.25), SEMIBOLD))
        painter.setPen(color("good" if reached else "accent"))
        words = self.tr("Goal {angle}").format(angle=numbers.format_degrees(scene.goal_deg))
        if exercise.angle == PRONOSUPINATION:  # drawn from palm down, while its number counts from thumb up
            words = self.tr("Goal")
        metrics = QFontMetricsF(painter.font())
        beyond = to.map(arc.point(1.05 * scene.goal_deg)) - at
        # Away from the joint, unless the way comes from there.
        aside = beyond if abs(beyond.x()) > abs(beyond.y()) else at - to.map(arc.pivot)
        left = at.x() + 84 if aside.x() > 0 else at.x() - 84 - metrics.horizontalAdvance(words)
        painter.drawText(QPointF(left, at.y() + 0.36 * metrics.capHeight()), words)

    @staticmethod
    def _stroke(painter: QPainter, path: QPainterPath, wide: float, color: QColor) -> None:
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setPen(QPen(color, wide, Qt.PenStyle.SolidLine, Qt.PenCapStyle.RoundCap))
        painter.drawPath(path)


def _placement(exercise: Exercise, width: float, *, mirrored: bool) -> QTransform:
    """Return the transform of the figure to the right of the texts."""
    to = QTransform()
    if exercise.angle == PRONOSUPINATION:
        at, scale = QPointF(0.66 * width, 560.0), 0.95
    elif exercise.angle == FLEXION:
        at, scale = QPointF((0.60 if mirrored else 0.50) * width, 470.0), 0.98
    elif (
        exercise.angle is not None
        or not exercise.digits
        or (exercise.joint.startswith("MCP") and exercise.joint.endswith("abduction"))
    ):  # seen from above
        at, scale = QPointF(0.68 * width, 790.0), 1.3
    else:
        at, scale = QPointF((0.84 if mirrored else 0.40) * width, 400.0), 1.5
    to.translate(at.x(), at.y())
    to.scale(-scale if mirrored else scale, scale)
    return to


PETALS = 7


def paint_climber(painter: QPainter, theme: Theme, at: QPointF, ahead: QPointF, half: float) -> None:
    """Paint a ladybird, its head ahead."""
    painter.save()
    painter.translate(at)
    painter.rotate(math.degrees(math.atan2(ahead.y(), ahead.x())))
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(theme.color("text"))
    painter.drawEllipse(QPointF(0.85 * half, 0), 0.5 * half, 0.5 * half)
    painter.setBrush(theme.color("deviation"))
    painter.setPen(QPen(theme.color("text"), 5))
    painter.drawEllipse(QPointF(0, 0), half, 0.9 * half)
    painter.drawLine(QPointF(-half, 0), QPointF(0.6 * half, 0))
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(theme.color("text"))
    for x, y in ((-0.45, 0.45), (-0.45, -0.45), (0.25, 0.48), (0.25, -0.48)):
        painter.drawEllipse(QPointF(x * half, y * half), 0.17 * half, 0.17 * half)
    painter.restore()


def paint_flower(painter: QPainter, theme: Theme, at: QPointF, half: float, *, open_share: float) -> None:
    """Paint a flower; closed petals are nearer to its middle."""
    painter.save()
    painter.translate(at)
    painter.setPen(QPen(theme.color("surface"), max(2.0, 0.05 * half)))
    painter.setBrush(theme.color("deviation" if open_share >= 1.0 else "border"))
    reach = half * (0.3 + 0.32 * open_share)
    for number in range(PETALS):
        painter.save()
        painter.rotate(360.0 * number / PETALS)
        painter.drawEllipse(QRectF(reach - 0.36 * half, -0.26 * half, 0.72 * half, 0.52 * half))
        painter.restore()
    painter.setBrush(theme.color("band_warn"))
    painter.drawEllipse(QPointF(0, 0), 0.3 * half, 0.3 * half)
    painter.restore()
