"""Frame of the review with markers, fingertip paths, angle and buttons."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QContextMenuEvent, QPainter, QResizeEvent

from carpus.core.model.types import ByteImage, FloatArray, TrackStatus
from carpus.core.results.hand_cutout import angle_overlay
from carpus.core.session.values import Session
from carpus.ui.kit import numbers
from carpus.ui.kit.background import Background
from carpus.ui.kit.button import Button
from carpus.ui.kit.field import ChoiceButton
from carpus.ui.kit.theme import Theme
from carpus.ui.picture.photo import label_size, paint_label
from carpus.ui.picture.session_frames import SessionFrameView, paint_trails
from carpus.ui.picture.view import FrameView
from carpus.ui.screens.review.hand_image import paint_angle
from carpus.ui.screens.review.reviewed_session import ReviewedSession

# Length of the fingertip paths.
TRAIL_S = 1.0


class ReviewFrameView(SessionFrameView):
    """Emits ``correction_requested`` for the frame that is shown."""

    correction_requested = Signal()

    def __init__(self, theme: Theme, background: Background, read: Callable[[str, int], ByteImage | None]) -> None:
        super().__init__(theme, (480, 360), background, read)
        self._reviewed: ReviewedSession | None = None
        self._time_s, self._current, self._finger = 0.0, -1, 0
        self.overlay = self._paint_overlay
        self.correct_button = Button(theme, self.tr("Correct markers…"), "plain", height_px=36)
        self.correct_button.setToolTip(self.tr("A marker is wrong or missing here (Shift+F10)"))
        self.correct_button.clicked.connect(self.correction_requested)
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
        if picture is not None:
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
        self.correction_requested.emit()

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
        """Paint repetition and time at the left, the status at the right or below, then ``angle_text``."""
        plate = paint_label(painter, self._theme, self._clock_words(reviewed), 12, 12)
        words = reviewed.status_words(self.row, self._time_s)
        left, top = self.width() - label_size(self._theme, words).width() - 12, 12.0
        if left < plate.right() + 2:
            left, top = 12.0, plate.bottom() + 4
        if words:
            plate = paint_label(painter, self._theme, words, left, top)
        if angle_text:
            paint_label(painter, self._theme, angle_text, 12, plate.bottom() + 4)

    def _clock_words(self, reviewed: ReviewedSession) -> str:
        """Return ``Repetition 3 of 8 · 00:12.0``, or the time alone between repetitions."""
        clock = numbers.format_clock_tenths(self._time_s)
        if self._current not in reviewed.find_repetitions(self._time_s):
            return clock
        pattern = self.tr("Repetition {number} of {count} · {time}")
        return pattern.format(number=self._current + 1, count=len(reviewed.results.repetitions), time=clock)
