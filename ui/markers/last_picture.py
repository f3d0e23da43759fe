"""The picture of the last session's markers in the corner, so that they come to the same places."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, QPointF, QRectF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QWidget

from carpus.core.types import ByteImage
from carpus.ui.controls.host import host_of
from carpus.ui.picture.photo import Photo, label_size
from carpus.ui.theme import Theme

SMALL_PX, LARGE_PX = (158, 138), (420, 335)


class LastPicture(Photo):
    """Lies on the lower left of its host; a click or M makes it large and small."""

    def __init__(self, theme: Theme, host: QWidget) -> None:
        super().__init__(theme)
        self.setParent(host)
        self._large = False
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        host.installEventFilter(self)
        theme.changed.connect(self._fit)
        self.hide()

    def show_picture(self, color_rgb: ByteImage | None, day: str) -> None:
        """Set the picture; without one nothing is shown."""
        super().show_picture(color_rgb, self.tr("Last time, {day}").format(day=day))
        self._large = False
        self._fit()

    def toggle(self) -> None:
        """Large or small."""
        self._large = not self._large
        self._fit()

    def _fit(self) -> None:
        scale = 1.0 if self._large else min(self._theme.text_scale, host_of(self).width() / 832)
        width, height = (round(scale * size) for size in (LARGE_PX if self._large else SMALL_PX))
        width = max(width, round(label_size(self._theme, self._label).width()) + 24)
        self.setGeometry(13, host_of(self).height() - height - 13, width, height)

    def place(self) -> tuple[QRectF, QPointF]:
        """The picture above its label."""
        room = QRectF(self.rect()).adjusted(3, 3, -3, -self._theme.px(23))
        return room, QPointF(3, self.height() - self._theme.px(22))

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.Resize:
            self._fit()
        return False

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self.toggle()
