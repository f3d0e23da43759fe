"""What is drawn over the live frame: markers, skeleton, and a question about a marker."""

from __future__ import annotations

from PySide6.QtCore import QRectF
from PySide6.QtGui import QPainter

from carpus.core.model.types import TrackedFrame
from carpus.core.pipeline.live_values import TrackedView
from carpus.ui.kit.theme import Theme
from carpus.ui.picture import overlay, skeleton
from carpus.ui.picture.view import FrameView
from carpus.ui.screens.live.marker_doubt import find_doubt
from carpus.ui.screens.live.question import MarkerQuestion, paint_question
from carpus.ui.screens.live.recording import RecordingController


class FrameOverlay:
    """Draws ``tracked_view``, None for nothing."""

    def __init__(
        self, theme: Theme, picture: FrameView, question: MarkerQuestion, recording: RecordingController
    ) -> None:
        self._theme, self._picture, self._question, self._recording = theme, picture, question, recording
        self.tracked_view: TrackedView | None = None
        self.is_late = False
        """True if the frame is newer than the tracked view."""
        picture.overlay = self._paint

    def _paint(self, painter: QPainter, picture: FrameView) -> None:
        measuring, set_up = self._recording.measuring, self._recording.set_up
        if self.tracked_view is None or measuring is None or set_up is None or self.is_late:
            return
        frame, camera = self.tracked_view.tracked, measuring.camera
        if set_up.protocol.has_fingers:
            skeleton.paint_skeleton(painter, frame, set_up.protocol, camera, picture.to_screen)
        else:
            overlay.paint_palm_links(painter, frame, camera, picture.to_screen)
            overlay.paint_markers(painter, frame, picture.to_screen)
        self._paint_question(painter, picture, frame)

    def _paint_question(self, painter: QPainter, picture: FrameView, frame: TrackedFrame) -> None:
        asked, measuring = self._question.asked_doubt, self._recording.measuring
        if asked is None or measuring is None or measuring.calibration is None:
            return
        now = find_doubt(frame, measuring.calibration.clicks.protocol.markers, measuring.camera)
        if now is not None and now.marker == asked.marker and now.has_other and now.is_hidden == asked.is_hidden:
            paint_question(painter, self._theme, now, picture, QRectF(self._question.geometry()))
