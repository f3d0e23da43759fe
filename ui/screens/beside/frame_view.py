"""Frame of one of the compared sessions, mirrored if that makes the hands alike."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtGui import QFontMetricsF, QPainter

from carpus.core.model.types import ByteImage, FloatArray
from carpus.core.session.values import Session
from carpus.ui.kit.background import Background
from carpus.ui.kit.fonts import SEMIBOLD, font
from carpus.ui.kit.theme import Theme
from carpus.ui.picture.photo import label_size, paint_label
from carpus.ui.picture.session_frames import SessionFrameView, blank_frame
from carpus.ui.picture.view import HAND_AREA_FACTOR, PALM_AREA_FACTOR, FrameView

LABEL_MARGIN_PX = 10


class ComparisonFrameView(SessionFrameView):
    """Frame of one session with its labels in the corners."""

    def __init__(self, theme: Theme, background: Background, read: Callable[[str, int], ByteImage | None]) -> None:
        super().__init__(theme, (324, 243), background, read)
        self._frame_rgb: ByteImage | None = None
        self.is_mirrored = False
        self.session_name = self.repetition = self.value = ""
        self.overlay = self._paint_overlay

    def set_session(self, session: Session | None, words: str = "") -> None:
        self._frame_rgb = None
        self.session_name = self.repetition = self.value = ""
        super().set_session(session, words)
        self._fit_hand_area()

    def set_mirrored(self, is_mirrored: bool) -> None:
        if is_mirrored != self.is_mirrored:
            self.is_mirrored = is_mirrored
            self._fit_hand_area()
            self._show()

    def show_words(self, name: str, repetition: str, value: str) -> None:
        if (name, repetition, value) != (self.session_name, self.repetition, self.value):
            self.session_name, self.repetition, self.value = name, repetition, value
            self.setAccessibleDescription(" · ".join(part for part in (name, repetition, value) if part))
            self.update()

    def show_stored_frame(self, picture: ByteImage | None) -> None:
        if picture is None and self.image is None and self.session is not None:
            picture = blank_frame(self.session.camera)
        if picture is not None:
            self._frame_rgb = picture
            self._show()

    def _show(self) -> None:
        if self._frame_rgb is not None:
            turned = self._frame_rgb[:, ::-1] if self.is_mirrored else self._frame_rgb
            self.show_frame(np.ascontiguousarray(turned))

    def _fit_hand_area(self) -> None:
        if self.session is None:
            self.set_hand_area(None)
            return
        room = HAND_AREA_FACTOR if self.session.header.joint_names else PALM_AREA_FACTOR
        self.set_hand_area(self._mirror_pixels(self.session.calibration.clicks.pixel, self.session), room)

    def _mirror_pixels(self, pixel: FloatArray, session: Session) -> FloatArray:
        """Return pixels (..., 2) as shown."""
        if not self.is_mirrored:
            return pixel
        out = pixel.copy()
        out[..., 0] = session.camera.width_px - 1.0 - out[..., 0]
        return out

    def _elide_label(self, words: str) -> str:
        """Shorten a label to the width; the accessible description has all of it."""
        metrics = QFontMetricsF(font(12 * self._theme.text_scale, SEMIBOLD))
        return metrics.elidedText(words, Qt.TextElideMode.ElideRight, self.width() - 2 * LABEL_MARGIN_PX - 12)

    def _paint_overlay(self, painter: QPainter, picture: FrameView) -> None:
        session = self.session
        if session is not None and 0 <= self.row < len(session):
            spots, seen = self.marker_pixels(session)
            self.paint_markers(painter, session, self._mirror_pixels(spots, session), seen)
        theme = self._theme
        if self.session_name:
            paint_label(painter, theme, self._elide_label(self.session_name), LABEL_MARGIN_PX, LABEL_MARGIN_PX)
        bottom = self.height() - LABEL_MARGIN_PX - label_size(theme, "0").height()
        if self.repetition:
            paint_label(painter, theme, self.repetition, LABEL_MARGIN_PX, bottom)
        if self.value:
            right = self.width() - LABEL_MARGIN_PX - label_size(theme, self.value).width()
            over = (
                LABEL_MARGIN_PX + label_size(theme, self.repetition).width() + 6 if self.repetition else LABEL_MARGIN_PX
            )
            if right < over:  # large text: one above the other
                bottom -= label_size(theme, "0").height() + 4
                right = max(LABEL_MARGIN_PX, right)
            paint_label(painter, theme, self.value, right, bottom)
