"""What the window knows of the camera's calibration and check: told in the top bar, over a session, in the settings."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime

from PySide6.QtCore import QObject, Signal

from carpus.app.desktop.care_cameras import CareCameras
from carpus.core.calibration.card.standing import Standing
from carpus.ui.background import Background


class CameraCare(QObject):
    """``changed`` when something else is known of the camera."""

    changed = Signal()

    def __init__(
        self, parent: QObject, cameras: CareCameras, background: Background, now: Callable[[], datetime]
    ) -> None:
        super().__init__(parent)
        self._cameras, self._background, self._now = cameras, background, now
        self.standing = Standing("")

    def look(self) -> None:
        """Read anew what is kept of the camera; a disk that does not answer keeps nobody waiting."""
        cameras, now = self._cameras, self._now()
        self._background.run(lambda: cameras.standing(now), self._take, lambda _: None, self)

    def met(self, serial: str) -> None:
        """A camera was opened: from now on it is the one that is spoken of."""
        self._cameras.met(serial)
        self.look()

    def _take(self, standing: Standing) -> None:
        if standing != self.standing:
            self.standing = standing
            self.changed.emit()
