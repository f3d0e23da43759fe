"""View of a camera frame, fixed on the hand area or whole, with an overlay."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QImage, QPainter, QPainterPath, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from carpus.core.model.types import ByteImage, FloatArray
from carpus.ui.kit.theme import CARD_RADIUS_PX, Theme

Overlay = Callable[[QPainter, "FrameView"], None]
PALM_AREA_FACTOR, HAND_AREA_FACTOR = 2.0, 1.3
"""Size of the hand area relative to the box of the palm's or the whole hand's markers, with room to move."""


def to_qimage(color_rgb: ByteImage) -> QImage:
    """Return a QImage that owns its pixels; one over the array would outlive it."""
    picture = np.ascontiguousarray(color_rgb)
    height, width = picture.shape[:2]
    borrowed = QImage(picture.data, width, height, 3 * width, QImage.Format.Format_RGB888)
    # The other format makes it a copy, and is drawn three times as fast.
    return borrowed.convertToFormat(QImage.Format.Format_RGB32)


class FrameView(QWidget):
    """View of the newest frame; ``overlay`` paints on it through :meth:`to_screen`."""

    def __init__(self, theme: Theme, hint_px: tuple[int, int] = (520, 390)) -> None:
        super().__init__()
        self._theme, self._hint_px = theme, hint_px
        self.image: QImage | None = None
        self._shown_area: QRectF | None = None
        # Whether the whole frame is shown, or the hand area.
        self.is_whole = False
        self._top_margin_px, self._bottom_margin_px = 0, 0
        # Screen pixels per frame pixel, and where the frame's corner is.
        self.scale, self._offset = 1.0, QPointF(0, 0)
        self.overlay: Overlay | None = None
        self.empty_text = ""
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setAccessibleName(self.tr("Camera image"))
        theme.changed.connect(self.update)

    def show_frame(self, color_rgb: ByteImage) -> None:
        """Copy and show a frame."""
        first = self.image is None or self.image.width() != color_rgb.shape[1]
        self.image = to_qimage(color_rgb)
        if first:
            self._update_transform()
        self.update()

    def clear(self, words: str = "") -> None:
        """Show black with a reason, never an old frame as if it were current."""
        self.image = None
        self.empty_text = words
        self.update()

    def set_hand_area(self, pixel: FloatArray | None, area_factor: float = PALM_AREA_FACTOR) -> None:
        """Fix the view on the markers (M, 2) in pixels, or on the whole frame."""
        self._shown_area = None
        if pixel is not None and np.isfinite(pixel).any():
            low, high = np.nanmin(pixel, axis=0), np.nanmax(pixel, axis=0)
            width, height = (high - low) * area_factor + 40.0
            center = (low + high) / 2
            above = 0.5
            if area_factor == PALM_AREA_FACTOR:  # the fingers lie beyond the palm's markers, the thumb beside them
                above, width = 0.6, 1.3 * width
            self._shown_area = QRectF(center[0] - width / 2, center[1] - height * above, width, height)
        self._update_transform()

    def reserve_margins(self, top_px: int, bottom_px: int) -> None:
        """Keep the hand area between what covers the top and the bottom."""
        if (top_px, bottom_px) != (self._top_margin_px, self._bottom_margin_px):
            self._top_margin_px, self._bottom_margin_px = top_px, bottom_px
            self._update_transform()

    def set_whole(self, is_whole: bool) -> None:
        """Show the whole frame, or the hand area."""
        self.is_whole = is_whole
        self._update_transform()

    def to_screen(self, u: float, v: float) -> QPointF:
        """Return the widget position of a frame pixel's centre."""
        return QPointF((u + 0.5) * self.scale + self._offset.x(), (v + 0.5) * self.scale + self._offset.y())

    def to_pixel(self, point: QPointF) -> FloatArray:
        """Return the frame pixel (2,) at a widget position."""
        u = (point.x() - self._offset.x()) / self.scale - 0.5
        v = (point.y() - self._offset.y()) / self.scale - 0.5
        return np.array([u, v])

    def _update_transform(self) -> None:
        """Fit the area into the widget, never smaller than needed to cover it."""
        if self.image is None or not self.width():
            return
        width, height = float(self.image.width()), float(self.image.height())
        cover = max(self.width() / width, self.height() / height)
        area, above = self._shown_area, 0.5 * self.height()
        if self.is_whole or area is None:
            self.scale = min(self.width() / width, self.height() / height) if self.is_whole else cover
            middle = QPointF(width / 2, height / 2)
        else:
            free = self.height() - self._top_margin_px - self._bottom_margin_px
            above = self._top_margin_px + 0.5 * free
            self.scale = max(cover, min(self.width() / area.width(), free / area.height()))
            middle = area.center()
        shown_w, shown_h = self.width() / self.scale, self.height() / self.scale
        left = (width - shown_w) / 2 if shown_w >= width else min(max(middle.x() - shown_w / 2, 0), width - shown_w)
        top = (
            (height - shown_h) / 2
            if shown_h >= height
            else min(max(middle.y() - above / self.scale, 0), height - shown_h)
        )
        self._offset = QPointF(-left * self.scale, -top * self.scale)
        self.update()

    def sizeHint(self) -> QSize:
        return QSize(*self._hint_px)

    def minimumSizeHint(self) -> QSize:
        return QSize(320, 240)

    def resizeEvent(self, event) -> None:  # type: ignore[no-untyped-def]
        self._update_transform()

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        frame = QPainterPath()
        frame.addRoundedRect(QRectF(self.rect()), CARD_RADIUS_PX, CARD_RADIUS_PX)
        painter.setClipPath(frame)
        painter.fillRect(self.rect(), QColor("#10181A"))
        if self.image is None:
            painter.setPen(QColor("#A9B6B9"))
            place = int(Qt.AlignmentFlag.AlignCenter) | int(Qt.TextFlag.TextWordWrap)
            painter.drawText(self.rect().adjusted(12, 0, -12, 0), place, self.empty_text)
        else:
            self._paint_image(painter, self.image)
        if self.hasFocus() and self.property("shows_own_focus"):
            painter.setPen(QPen(self._theme.color("accent"), 2))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawRoundedRect(QRectF(self.rect()).adjusted(1, 1, -1, -1), CARD_RADIUS_PX, CARD_RADIUS_PX)

    def _paint_image(self, painter: QPainter, image: QImage) -> None:
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
        size = image.size()
        target = QRectF(self._offset.x(), self._offset.y(), size.width() * self.scale, size.height() * self.scale)
        visible = target.intersected(QRectF(self.rect()))
        source = QRectF(
            (visible.left() - target.left()) / self.scale, (visible.top() - target.top()) / self.scale,
            visible.width() / self.scale, visible.height() / self.scale,
        )  # fmt: skip
        painter.drawImage(visible, image, source)
        if self.overlay is not None:
            painter.save()
            self.overlay(painter, self)
            painter.restore()
