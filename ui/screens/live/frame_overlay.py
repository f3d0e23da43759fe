"""What is drawn over the live frame: markers and skeleton."""

from __future__ import annotations

from PySide6.QtGui import QPainter

from carpus.core.pipeline.live_values import TrackedView
from carpus.ui.picture import overlay, skeleton
from carpus.ui.picture.view import FrameView
from carpus.ui.screens.live.recording import RecordingController


class FrameOverlay:
    """Draws ``tracked_view``, None for nothing."""

    def __init__(self, picture: FrameView, recording: RecordingController) -> None:
        self._recording = recording
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
