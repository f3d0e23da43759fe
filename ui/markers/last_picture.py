"""The picture of the last session's markers in the corner, so that they come to the same places."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, QRectF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QImage, QMouseEvent, QPainter, QPainterPath, QPaintEvent
from PySide6.QtWidgets import QWidget

from carpus.core.types import ByteImage
from carpus.ui.controls.host import host_of
from carpus.ui.fonts import SEMIBOLD, font
from carpus.ui.picture.convert import image_of
from carpus.ui.picture.photo import fitted, paint_label
from carpus.ui.theme import CARD_RADIUS_PX, ON_PICTURE_LABEL, Theme

SMALL_PX, LARGE_PX = (158, 138), (420, 335)


class LastPicture(QWidget):
    """Lies on the lower left of its host; a click or M makes it large and small."""

    def __init__(self, theme: Theme, host: QWidget) -> None:
        super().__init__(host)
        self._theme = theme
        self._image: QImage | None = None
        self._label = ""
        self._large = False
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        host.installEventFilter(self)
        theme.changed.connect(self._place)
        self.hide()

    def show_picture(self, color_rgb: ByteImage | None, day: str) -> None:
        """Set the picture; without one nothing is shown."""
        self._image = None if color_rgb is None else image_of(color_rgb)
        self._label = self.tr("Last time, {day}").format(day=day)
        self.setAccessibleName(self._label)
        self._large = False
        self.setVisible(self._image is not None)
        self._place()

    def toggle(self) -> None:
        """Large or small."""
        self._large = not self._large
        self._place()

    def _place(self) -> None:
        scale = 1.0 if self._large else min(self._theme.text_scale, host_of(self).width() / 832)
        width, height = (round(scale * size) for size in (LARGE_PX if self._large else SMALL_PX))
        said = QFontMetricsF(font(12 * self._theme.text_scale, SEMIBOLD)).horizontalAdvance(self._label)
        width = max(width, round(said) + 36)
        self.setGeometry(13, host_of(self).height() - height - 13, width, height)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.Resize:
            self._place()
        return False

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self.toggle()

    def paintEvent(self, event: QPaintEvent) -> None:
        if self._image is None:
            return
        painter = QPainter(self)
        painter.setRenderHints(QPainter.RenderHint.Antialiasing | QPainter.RenderHint.SmoothPixmapTransform)
        frame = QPainterPath()
        frame.addRoundedRect(QRectF(self.rect()), CARD_RADIUS_PX, CARD_RADIUS_PX)
        painter.fillPath(frame, QColor(ON_PICTURE_LABEL))
        room = QRectF(self.rect()).adjusted(3, 3, -3, -self._theme.px(23))
        painter.drawImage(fitted(self._image.size(), room), self._image)
        paint_label(painter, self._theme, self._label, 3, self.height() - self._theme.px(22))
