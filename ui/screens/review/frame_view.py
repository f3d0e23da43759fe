"""Frame of the review with markers, paths, angle and buttons, and the image of the hand alone that is saved of it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt, QTimer, Signal
from PySide6.QtGui import QContextMenuEvent, QImage, QPainter, QResizeEvent
from PySide6.QtWidgets import QCheckBox, QWidget

from carpus.core.model.hand.exercises import Exercise
from carpus.core.model.types import ByteImage, FloatArray, TrackStatus
from carpus.core.results.hand_cutout import AngleOverlay, angle_overlay, cut_out_hand
from carpus.core.session.values import Session
from carpus.ui.kit import numbers
from carpus.ui.kit.background import Background
from carpus.ui.kit.button import Button
from carpus.ui.kit.dialog import Dialog
from carpus.ui.kit.field import ChoiceButton
from carpus.ui.kit.text import REGULAR, SEMIBOLD, Text
from carpus.ui.kit.theme import DARK, ON_PICTURE_LINE, Theme
from carpus.ui.kit.translate import tr
from carpus.ui.picture.overlay import ToScreen, draw_with_halo
from carpus.ui.picture.photo import label_size, paint_label
from carpus.ui.picture.session_frames import SessionFrameView, paint_trails
from carpus.ui.picture.view import FrameView, to_qimage
from carpus.ui.screens.review.reviewed_session import ReviewedSession

# Length of the fingertip paths.
TRAIL_S = 1.0


class ReviewFrameView(SessionFrameView):
    """Frame with floating buttons; a right click presses the one for corrections."""

    def __init__(self, theme: Theme, background: Background, read: Callable[[str, int], ByteImage | None]) -> None:
        super().__init__(theme, (480, 360), background, read)
        self._reviewed: ReviewedSession | None = None
        self._time_s, self._current, self._finger = 0.0, -1, 0
        self._has_video = True
        self.overlay = self._paint_overlay
        self.correct_button = Button(theme, self.tr("Correct markers…"), "plain", height_px=36)
        self.correct_button.setToolTip(self.tr("A marker is wrong or missing here (Shift+F10)"))
        self.angle_button = ChoiceButton(theme, self.tr("Angle"), height_px=36)
        self.angle_button.setToolTip(self.tr("The angle drawn on the frame (A)"))
        self.angle_button.toggled.connect(lambda _: self.update())
        self.angle_button.toggled.connect(lambda _: self._place_buttons())
        self.save_button = Button(theme, self.tr("Save…"), "plain", height_px=36)
        self.save_button.setToolTip(self.tr("Image of the hand alone (F)"))
        for button in (self.correct_button, self.angle_button, self.save_button):
            button.setParent(self)
            button.setProperty("floats", True)
            button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
            button.hide()
        theme.changed.connect(self._schedule_layout)

    def show_session(self, session: Session) -> None:
        """Show another session; its frames follow."""
        self._has_video = True  # until its first frame is found missing
        self.set_session(session)
        self.set_hand_area(session.calibration.clicks.pixel)
        self.correct_button.show()
        self.angle_button.show()
        self.save_button.hide()  # until there is a picture of it
        self._place_buttons()

    def show_repetition(self, reviewed: ReviewedSession, current: int, finger: int) -> None:
        """Set the session's results, the current repetition, and the finger (0 for all)."""
        self._reviewed, self._current, self._finger = reviewed, current, finger
        self.update()

    def show_time(self, time_s: float, row: int) -> None:
        self._time_s = time_s
        self.show_row(row)
        self.update()

    def show_stored_frame(self, picture: ByteImage | None) -> None:
        self._has_video = picture is not None
        if self._has_video:
            self.save_button.show()
        super().show_stored_frame(picture)

    def _schedule_layout(self) -> None:
        QTimer.singleShot(0, self, self._place_buttons)

    def _place_buttons(self) -> None:
        """Place the buttons at the foot, with shorter texts if there is little room."""
        buttons = (self.correct_button, self.angle_button, self.save_button)
        room = self.width() - 24
        words = self.tr("Correct markers…")
        shorter = self.tr("Correct…")
        for face, icon in ((words, ""), (shorter, ""), ("", "notebook-pen")):  # the sign alone where there is no room
            self.correct_button.set_label(face, icon=icon)
            for button in buttons:
                button.adjustSize()
            if sum(button.width() + 8 for button in buttons) <= room:
                break
        self.correct_button.setAccessibleName(words)
        top, right = self.height() - buttons[0].height() - 12, self.width() - 12
        for button in reversed(buttons[1:]):
            right -= button.width()
            button.move(right, top)
            right -= 8
        buttons[0].move(12, top)
        self.reserve_margins(16 + round(label_size(self._theme, words).height()), buttons[0].height() + 12)

    def resizeEvent(self, event: QResizeEvent) -> None:
        self._place_buttons()
        super().resizeEvent(event)

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        self.correct_button.click()

    # --- painting -----------------------------------------------------------------------------------------
    def _paint_overlay(self, painter: QPainter, picture: FrameView) -> None:
        reviewed = self._reviewed
        if reviewed is None or self.row < 0:
            return
        spots, seen = self.marker_pixels(reviewed.session)
        if reviewed.modelled_px is not None:
            self._paint_trails(painter, reviewed, reviewed.modelled_px)
        self.paint_markers(painter, reviewed.session, spots, seen, self._finger)
        text = self._paint_angle(painter, reviewed) if self.angle_button.isChecked() else ""
        self._paint_labels(painter, reviewed, text)

    def _paint_trails(self, painter: QPainter, reviewed: ReviewedSession, modelled_px: FloatArray) -> None:
        times, session = reviewed.curves.time_s, reviewed.session
        recent = slice(int(np.searchsorted(times, times[self.row] - TRAIL_S)), self.row + 1)
        seen = np.isfinite(session.markers.measured_px[recent, :, 0])
        paint_trails(painter, self, session.header.protocol, modelled_px[recent], seen, self._finger)

    def _paint_angle(self, painter: QPainter, reviewed: ReviewedSession) -> str:
        """Paint the trained angle; return its text, or why it is not drawn."""
        found = angle_overlay(reviewed.session, self.row, reviewed.results.exercise)
        if found is not None:
            paint_angle(painter, found, self.to_screen)
            return reviewed.angle_words(self.row) if reviewed.is_hand else ""
        if reviewed.session.status[self.row] != TrackStatus.TRACKED:
            return self.tr("Not measured here")
        return self.tr("Moves towards the camera: not drawn")

    def _paint_labels(self, painter: QPainter, reviewed: ReviewedSession, angle_text: str) -> None:
        """Paint repetition and time at the left, the status at the right or below, then the others."""
        plate = paint_label(painter, self._theme, self._clock_words(reviewed), 12, 12)
        words = reviewed.status_words(self.row, self._time_s)
        left, top = self.width() - label_size(self._theme, words).width() - 12, 12.0
        if left < plate.right() + 2:
            left, top = 12.0, plate.bottom() + 4
        if words:
            plate = paint_label(painter, self._theme, words, left, top)
        missing = "" if self._has_video else self.tr("No video was saved: markers only")
        for text in filter(None, (angle_text, missing)):
            plate = paint_label(painter, self._theme, text, 12, plate.bottom() + 4)

    def _clock_words(self, reviewed: ReviewedSession) -> str:
        """Return ``Repetition 3 of 8 · 00:12.0``, or the time alone between repetitions."""
        clock = numbers.format_clock_tenths(self._time_s)
        if self._current not in reviewed.find_repetitions(self._time_s):
            return clock
        pattern = self.tr("Repetition {number} of {count} · {time}")
        return pattern.format(number=self._current + 1, count=len(reviewed.results.repetitions), time=clock)


# Radius of the arc as a share of the lines.
ARC_FRACTION = 0.55
# A small hand is enlarged by whole factors up to this size.
MIN_SIDE_PX = 640


@dataclass(frozen=True, slots=True)
class HandImage:
    """Frame of a session to be saved as an image, and the words on it."""

    session: Session
    row: int
    exercise: Exercise
    words: str


def build_hand_image(reviewed: ReviewedSession, row: int, time_s: float) -> HandImage:
    """Return the image of a frame; its words say if the movement was passive or simulated."""
    words, results = reviewed.angle_words(row), reviewed.results
    if words and any(results.repetitions[number].is_passive for number in reviewed.find_repetitions(time_s)):
        words = tr("{angle}, passive").format(angle=words)
    if reviewed.session.header.is_simulated:
        words = " · ".join(filter(None, (words, tr("Simulated hand"))))
    return HandImage(reviewed.session, row, results.exercise, words)


def paint_angle(painter: QPainter, angle: AngleOverlay, to_screen: ToScreen) -> None:
    """Paint a dashed line at zero, a thick one at the angle, and the arc between them."""
    vertex, zero, hand = (to_screen(*map(float, point)) for point in (angle.vertex, angle.zero, angle.hand))
    draw_with_halo(painter, ON_PICTURE_LINE, 2.0, lambda: painter.drawLine(vertex, zero), dash=True)
    draw_with_halo(painter, DARK.deviation, 4.0, lambda: painter.drawLine(vertex, hand))
    lines = [point - vertex for point in (zero, hand)]
    radius = ARC_FRACTION * min(float(np.hypot(line.x(), line.y())) for line in lines)
    start, end = (float(np.degrees(np.arctan2(-line.y(), line.x()))) for line in lines)
    span = (end - start + 180.0) % 360.0 - 180.0
    box = QRectF(vertex.x() - radius, vertex.y() - radius, 2 * radius, 2 * radius)
    draw_with_halo(painter, DARK.deviation, 2.0, lambda: painter.drawArc(box, round(16 * start), round(16 * span)))


def draw_hand_image(theme: Theme, hand_image: HandImage, frame: ByteImage) -> QImage | None:
    """Draw the hand with its angle and words; None without a visible hand."""
    found = cut_out_hand(frame, hand_image.session, hand_image.row)
    if found is None:
        return None
    alone = to_qimage(found.image)
    scale = max(1, MIN_SIDE_PX // max(alone.width(), alone.height()))
    image = alone.scaled(alone.size() * scale, mode=Qt.TransformationMode.SmoothTransformation)
    painter = QPainter(image)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    angle = angle_overlay(hand_image.session, hand_image.row, hand_image.exercise)
    if angle is not None:
        corner = QPointF(found.left_px - 0.5, found.top_px - 0.5)
        paint_angle(painter, angle, lambda u, v: (QPointF(u, v) - corner) * scale)
    if hand_image.words:
        paint_label(painter, theme, hand_image.words, 8, 8)
    painter.end()
    return image


class HandImageDialog(Dialog):
    """Emits ``accepted`` once the patient's consent is ticked."""

    accepted = Signal()

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 560)
        body = self.card.body
        words = self.tr(
            "The image shows only the hand and its angle. Face, room and name are removed. If the hand does not move "
            "in the image plane, the angle is only written, not drawn."
        )
        self.add_heading(self.tr("Image of the hand"), words)
        words = self.tr("Carpus cannot protect the saved file: anyone who has it can open it. The export is logged.")
        body.addWidget(Text(theme, words, 14, REGULAR, "text2", wrap=True))
        words = self.tr("The hand is not visible here, or its marker labels are uncertain. Choose another moment.")
        self._refusal = Text(theme, words, 14, SEMIBOLD, "warn", wrap=True)
        body.addWidget(self._refusal)
        self.consent_check = QCheckBox(self.tr("The patient has agreed"))
        body.addWidget(self.consent_check)
        self.accept_button = Button(theme, self.tr("Save…"), "primary", height_px=44)
        self.close_button = self.add_buttons(self.accept_button)
        self.consent_check.toggled.connect(self._check)
        self.accept_button.clicked.connect(self._accept)

    def open_form(self, *, refused: bool = False) -> None:
        """Ask for consent, each time again; ``refused`` for a frame without a certain hand."""
        self._refusal.setVisible(refused)
        self.consent_check.setDisabled(refused)
        self.consent_check.setChecked(False)
        self._check(False)
        self.open()

    def _check(self, agreed: bool) -> None:
        """Without consent nothing can be saved, not even by Enter."""
        self.accept_button.setEnabled(agreed)
        answer = self.accept_button if agreed else self.close_button
        self.set_default(answer)
        if self.isVisible():
            answer.setFocus(Qt.FocusReason.OtherFocusReason)

    def _accept(self) -> None:
        self.close_dialog()
        self.accepted.emit()
