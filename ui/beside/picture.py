"""The picture of one of two sessions, mirrored where that makes the hands alike, with discs and angle."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtGui import QFontMetricsF, QPainter

from carpus.core.session.values import Session
from carpus.core.types import ByteImage, FloatArray
from carpus.ui.fonts import SEMIBOLD, font
from carpus.ui.picture.photo import label_size, paint_label
from carpus.ui.picture.view import HAND_ROOM, PALM_ROOM, PictureView
from carpus.ui.review.skeleton import modelled_px, paint_palm, paint_skeleton
from carpus.ui.theme import Theme

SIZE_PX = (324, 243)
EDGE_PX = 10
GROUND = 34
"""Grey under the marks where no pictures were kept, as in the review."""


class BesidePicture(PictureView):
    """Shows a row of a session: :meth:`ask` is called for its picture."""

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme, SIZE_PX)
        self._session: Session | None = None
        self._picture_rgb: ByteImage | None = None
        self._mirrored = False
        self.row = -1
        self.name = self.repetition = self.value = ""
        self.overlay = self._paint_over

    @property
    def session(self) -> Session | None:
        """Whose picture is shown."""
        return self._session

    @property
    def mirrored(self) -> bool:
        """Whether left and right are exchanged."""
        return self._mirrored

    def begin(self, session: Session | None, words: str = "") -> None:
        """Another session; None while it is read, with what is said meanwhile."""
        self._session, self._picture_rgb, self.row = session, None, -1
        self.name = self.repetition = self.value = ""
        self.clear(words)
        self._look_at_hand()

    def set_mirrored(self, mirrored: bool) -> None:
        """Exchange left and right, or not."""
        if mirrored != self._mirrored:
            self._mirrored = mirrored
            self._look_at_hand()
            self._show()

    def show_row(self, row: int) -> None:
        """The marks of a row; its picture follows."""
        if row != self.row:
            self.row = row
            self.update()

    def show_words(self, name: str, repetition: str, value: str) -> None:
        """What stands in the corners."""
        if (name, repetition, value) != (self.name, self.repetition, self.value):
            self.name, self.repetition, self.value = name, repetition, value
            self.setAccessibleDescription(" · ".join(part for part in (name, repetition, value) if part))
            self.update()

    def show_picture(self, picture_rgb: ByteImage | None) -> None:
        """The stored picture; None where none was kept: a plain ground under the marks."""
        if picture_rgb is None and self._session is not None:
            camera = self._session.camera
            picture_rgb = np.full((camera.height_px, camera.width_px, 3), GROUND, np.uint8)
        self._picture_rgb = picture_rgb
        self._show()

    def _show(self) -> None:
        if self._picture_rgb is not None:
            turned = self._picture_rgb[:, ::-1] if self._mirrored else self._picture_rgb
            self.show_frame(np.ascontiguousarray(turned))

    def _look_at_hand(self) -> None:
        if self._session is None:
            self.set_hand_area(None)
            return
        room = HAND_ROOM if self._session.header.joint_names else PALM_ROOM
        self.set_hand_area(self._turned(self._session.calibration.clicks.pixel), room)

    def _turned(self, pixel: FloatArray) -> FloatArray:
        """Pixels (..., 2) as they are shown."""
        if not self._mirrored or self._session is None:
            return pixel
        out = pixel.copy()
        out[..., 0] = self._session.camera.width_px - 1.0 - out[..., 0]
        return out

    def _fitting(self, words: str) -> str:
        """As much of a label as there is room for; the accessible description has all of it."""
        metrics = QFontMetricsF(font(12 * self._theme.text_scale, SEMIBOLD))
        return metrics.elidedText(words, Qt.TextElideMode.ElideRight, self.width() - 2 * EDGE_PX - 12)

    def _paint_over(self, painter: QPainter, picture: PictureView) -> None:
        session = self._session
        if session is not None and 0 <= self.row < len(session):
            measured = session.markers.measured_px[self.row]
            seen = np.isfinite(measured[:, 0])
            modelled = modelled_px(session.camera, session.markers.position_cam_m[self.row])
            spots = self._turned(np.where(seen[:, None], measured, modelled))
            if session.header.joint_names:
                paint_skeleton(painter, picture, session.header.protocol, spots, seen)
            else:
                paint_palm(painter, picture, spots, seen)
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
