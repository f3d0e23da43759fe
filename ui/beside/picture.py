"""The picture of one of two sessions, mirrored where that makes the hands alike, with discs and angle."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtGui import QFontMetricsF, QPainter

from carpus.core.session.values import Session
from carpus.core.types import ByteImage, FloatArray
from carpus.ui.background import Background
from carpus.ui.fonts import SEMIBOLD, font
from carpus.ui.picture.photo import label_size, paint_label
from carpus.ui.picture.view import HAND_ROOM, PALM_ROOM, PictureView
from carpus.ui.playback.pictures import SessionPicture, plain_ground
from carpus.ui.theme import Theme

EDGE_PX = 10


class BesidePicture(SessionPicture):
    """A row of one of the two, with its words in the corners."""

    def __init__(self, theme: Theme, background: Background, read: Callable[[str, int], ByteImage | None]) -> None:
        super().__init__(theme, (324, 243), background, read)
        self._picture_rgb: ByteImage | None = None
        self.mirrored = False
        self.name = self.repetition = self.value = ""
        self.overlay = self._paint_over

    def open(self, session: Session | None, words: str = "") -> None:
        self._picture_rgb = None
        self.name = self.repetition = self.value = ""
        super().open(session, words)
        self._look_at_hand()

    def set_mirrored(self, mirrored: bool) -> None:
        if mirrored != self.mirrored:
            self.mirrored = mirrored
            self._look_at_hand()
            self._show()

    def show_words(self, name: str, repetition: str, value: str) -> None:
        if (name, repetition, value) != (self.name, self.repetition, self.value):
            self.name, self.repetition, self.value = name, repetition, value
            self.setAccessibleDescription(" · ".join(part for part in (name, repetition, value) if part))
            self.update()

    def show_stored(self, picture: ByteImage | None) -> None:
        if picture is None and self.image is None and self.session is not None:
            picture = plain_ground(self.session.camera)
        if picture is not None:
            self._picture_rgb = picture
            self._show()

    def _show(self) -> None:
        if self._picture_rgb is not None:
            turned = self._picture_rgb[:, ::-1] if self.mirrored else self._picture_rgb
            self.show_frame(np.ascontiguousarray(turned))

    def _look_at_hand(self) -> None:
        if self.session is None:
            self.set_hand_area(None)
            return
        room = HAND_ROOM if self.session.header.joint_names else PALM_ROOM
        self.set_hand_area(self._turned(self.session.calibration.clicks.pixel, self.session), room)

    def _turned(self, pixel: FloatArray, session: Session) -> FloatArray:
        """Pixels (..., 2) as they are shown."""
        if not self.mirrored:
            return pixel
        out = pixel.copy()
        out[..., 0] = session.camera.width_px - 1.0 - out[..., 0]
        return out

    def _fitting(self, words: str) -> str:
        """As much of a label as there is room for; the accessible description has all of it."""
        metrics = QFontMetricsF(font(12 * self._theme.text_scale, SEMIBOLD))
        return metrics.elidedText(words, Qt.TextElideMode.ElideRight, self.width() - 2 * EDGE_PX - 12)

    def _paint_over(self, painter: QPainter, picture: PictureView) -> None:
        session = self.session
        if session is not None and 0 <= self.row < len(session):
            spots, seen = self.spots_px(session)
            self.paint_discs(painter, session, self._turned(spots, session), seen)
        theme = self._theme
        if self.name:
            paint_label(painter, theme, self._fitting(self.name), EDGE_PX, EDGE_PX)
        bottom = self.height() - EDGE_PX - label_size(theme, "0").height()
        if self.repetition:
            paint_label(painter, theme, self.repetition, EDGE_PX, bottom)
        if self.value:
            right = self.width() - EDGE_PX - label_size(theme, self.value).width()
            over = EDGE_PX + label_size(theme, self.repetition).width() + 6 if self.repetition else EDGE_PX
            if right < over:  # large text: one above the other
                bottom -= label_size(theme, "0").height() + 4
                right = max(EDGE_PX, right)
            paint_label(painter, theme, self.value, right, bottom)
