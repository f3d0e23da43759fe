"""What is drawn over the live frame: markers, skeleton, axes, and a question about a marker."""

from __future__ import annotations

from PySide6.QtCore import QRectF
from PySide6.QtGui import QPainter

from carpus.core.model.types import TrackedFrame, TrackStatus
from carpus.core.pipeline.live_values import TrackedView
from carpus.ui.kit.theme import Theme
from carpus.ui.kit.translate import to_mid_sentence, tr
from carpus.ui.picture import overlay, skeleton
from carpus.ui.picture.view import FrameView
from carpus.ui.screens.live.marker_doubt import find_doubt
from carpus.ui.screens.live.question import MarkerQuestion, paint_question
from carpus.ui.screens.live.recording import RecordingController
from carpus.ui.words.finger_angles import FingerAngle
from carpus.ui.words.marker_words import long_finger_name


class FrameOverlay:
    """Draws ``tracked_view`` (None for nothing), with a side view of the finger of ``figure``."""

    def __init__(
        self, theme: Theme, picture: FrameView, question: MarkerQuestion, recording: RecordingController
    ) -> None:
        self._theme, self._picture, self._question, self._recording = theme, picture, question, recording
        self.tracked_view: TrackedView | None = None
        self.figure: FingerAngle | None = None
        self.is_late = False
        """True if the frame is newer than the tracked view."""
        self.shows_research = True
        self._is_on, self._shows_side = True, False
        picture.overlay = self._paint

    def toggle(self) -> None:
        self._is_on = not self._is_on
        self._picture.update()

    def toggle_side(self) -> None:
        self._shows_side = not self._shows_side
        self._picture.update()

    def _paint(self, painter: QPainter, picture: FrameView) -> None:
        if not self._question.is_at_head:
            picture.paint_area_label(painter)
        measuring, set_up = self._recording.measuring, self._recording.set_up
        if not self._is_on or self.tracked_view is None or measuring is None or set_up is None or self.is_late:
            return
        frame, camera, calibration = self.tracked_view.tracked, measuring.camera, measuring.calibration
        if set_up.protocol.has_fingers:
            skeleton.paint_skeleton(painter, frame, set_up.protocol, camera, picture.to_screen, picture.scale)
            if self._shows_side and self.figure is not None:
                name = _side_view_words(str(self.figure.finger))
                skeleton.paint_finger_side(
                    painter, self._theme, frame, set_up.protocol, self.figure.finger, name, QRectF(picture.rect()),
                    set_up.side,
                )  # fmt: skip
        else:
            overlay.paint_palm_links(painter, frame, camera, picture.to_screen)
            overlay.paint_markers(painter, frame, picture.to_screen, picture.scale)
            asked = self._question.asked_doubt is not None  # then the discs are what is to be looked at
            if self.shows_research and calibration is not None and frame.status != TrackStatus.LOST and not asked:
                shown = QRectF(picture.rect())
                overlay.paint_axes(painter, self._theme, frame, calibration, camera, picture.to_screen, shown)
        self._paint_question(painter, picture, frame)

    def _paint_question(self, painter: QPainter, picture: FrameView, frame: TrackedFrame) -> None:
        asked, measuring = self._question.asked_doubt, self._recording.measuring
        if asked is None or measuring is None or measuring.calibration is None:
            return
        now = find_doubt(frame, measuring.calibration.clicks.protocol.markers, measuring.camera)
        if now is not None and now.marker == asked.marker and now.has_other and now.is_hidden == asked.is_hidden:
            paint_question(painter, self._theme, now, picture, QRectF(self._question.geometry()))


def _side_view_words(finger: str) -> str:
    return tr("Side · {finger}").format(finger=to_mid_sentence(long_finger_name(finger)))
