"""Still photo in a rounded frame, uncut, with a label."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, QSizeF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QImage, QPainter, QPainterPath, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from carpus.core.model.types import ByteImage
from carpus.ui.kit.fonts import SEMIBOLD, font
from carpus.ui.kit.icons import paint_state
from carpus.ui.kit.theme import CARD_RADIUS_PX, LIGHT, ON_PICTURE_LABEL, Theme
from carpus.ui.picture.view import to_qimage

LABEL_ALPHA = 180
# A marker's blue is so much above its red and green; the photo reaches so many times the markers' extent from their
# middle.
MIN_BLUE_EXCESS, MARGIN_EXTENTS = 40, 1.2
MIN_BLUE_PIXELS = 30


def crop_to_markers(color_rgb: ByteImage) -> ByteImage:
    """Return the part of a photo around its blue markers, in its aspect ratio; all of it without markers."""
    red, green, blue = np.moveaxis(color_rgb.astype(np.int16), -1, 0)
    rows, columns = np.nonzero(blue - np.maximum(red, green) > MIN_BLUE_EXCESS)
    if len(rows) < MIN_BLUE_PIXELS:
        return color_rgb
    height, width = blue.shape
    (top, bottom), (left, right) = (np.percentile(places, (2, 98)) for places in (rows, columns))
    high = min(2.0 * MARGIN_EXTENTS * max(bottom - top, right - left), height)
    wide = high * width / height
    first_row = int(np.clip((top + bottom - high) / 2, 0, height - high))
    first_column = int(np.clip((left + right - wide) / 2, 0, width - wide))
    return color_rgb[first_row : first_row + int(high), first_column : first_column + int(wide)]


def fit_box(size: QSize, bounds: QRectF) -> QRectF:
    """Return the largest box with the image's aspect ratio, centred in ``bounds``."""
    box = QRectF(QPointF(), QSizeF(size).scaled(bounds.size(), Qt.AspectRatioMode.KeepAspectRatio))
    box.moveCenter(bounds.center())
    return box


def label_size(theme: Theme, text: str) -> QSizeF:
    """Return the size that :func:`paint_label` needs."""
    metrics = QFontMetricsF(font(12 * theme.text_scale, SEMIBOLD))
    return QSizeF(metrics.horizontalAdvance(text) + 12, metrics.height() + 5)


def paint_label(painter: QPainter, theme: Theme, text: str, left: float, top: float) -> QRectF:
    """Draw white text on a dark plate and return the plate."""
    painter.setFont(font(12 * theme.text_scale, SEMIBOLD))
    plate = QRectF(QPointF(left, top), label_size(theme, text))
    color = QColor(ON_PICTURE_LABEL)
    color.setAlpha(LABEL_ALPHA)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(color)
    painter.drawRoundedRect(plate, 4, 4)
    painter.setPen(QColor("#FFFFFF"))
    painter.drawText(plate, Qt.AlignmentFlag.AlignCenter, text)
    return plate


def paint_wrong_label(painter: QPainter, theme: Theme, text: str, plate: QRectF) -> None:
    """Draw dark red text with an octagon on a light plate, for a wrong mark."""
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(QColor(LIGHT.bad_soft))
    painter.drawRoundedRect(plate, 4, 4)
    size = plate.height() - 8
    sign = QRectF(plate.left() + 6, plate.top() + 4, size, size)
    paint_state(painter, "bad", sign, QColor(LIGHT.bad), QColor(LIGHT.bad_soft))
    painter.setFont(font(12 * theme.text_scale, SEMIBOLD))
    painter.setPen(QColor(LIGHT.bad))
    painter.drawText(plate.adjusted(size + 10, 0, 0, 0), int(Qt.AlignmentFlag.AlignVCenter), text)


class Photo(QWidget):
    """View of one still photo."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._image: QImage | None = None
        self._label = ""
        self._has_room = True
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)

    def show_picture(self, color_rgb: ByteImage | None, label: str) -> None:
        """Show the part of a photo around the markers; without one the widget is hidden."""
        self._image = None if color_rgb is None else to_qimage(crop_to_markers(color_rgb))
        self._label = label
        self.setVisible(self._image is not None and self._has_room)
        self.setAccessibleName(label)
        self.update()

    def set_has_room(self, has_room: bool) -> None:
        """Show the photo only if there is room for it."""
        self._has_room = has_room
        self.setVisible(self._image is not None and has_room)

    def sizeHint(self) -> QSize:
        return QSize(280, 250)

    def layout_boxes(self) -> tuple[QRectF, QPointF]:
        """Return the box of the photo and the position of its label."""
        return QRectF(self.rect()), QPointF(10, 10)

    def paintEvent(self, event: QPaintEvent) -> None:
        if self._image is None:
            return
        room, label = self.layout_boxes()
        painter = QPainter(self)
        painter.setRenderHints(QPainter.RenderHint.Antialiasing | QPainter.RenderHint.SmoothPixmapTransform)
        frame = QPainterPath()
        frame.addRoundedRect(QRectF(self.rect()), CARD_RADIUS_PX, CARD_RADIUS_PX)
        painter.setClipPath(frame)
        painter.fillRect(self.rect(), QColor(ON_PICTURE_LABEL))
        painter.drawImage(fit_box(self._image.size(), room), self._image)
        if self._label:
            paint_label(painter, self._theme, self._label, label.x(), label.y())
