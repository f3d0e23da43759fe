"""What the window knows of the camera's calibration and check: told in the top bar, over a session, in the settings."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime

from PySide6.QtCore import QObject, Signal

from carpus.app.desktop.care_cameras import CareCameras
from carpus.core.check_card.chart import chart_path, read_checks
from carpus.core.check_card.standing import Standing, unsure_of
from carpus.core.output.report_content import SessionFigures
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
        self._unsure: dict[str, tuple[bool, bool]] = {}

    def look(self) -> None:
        """Read anew what is kept of the camera; a disk that does not answer keeps nobody waiting."""
        cameras, now = self._cameras, self._now()
        self._unsure.clear()
        self._background.run(lambda: cameras.standing(now), self._take, lambda _: None, self)

    def met(self, serial: str) -> None:
        """A camera was opened: from now on it is the one that is spoken of."""
        self._cameras.met(serial)
        self.look()

    def unsure(self, figures: SessionFigures) -> tuple[bool, bool]:
        """Whether lengths and angles of a session are not sure, as a check near it was out; told by ``changed`` once
        the checks were read."""
        known = self._unsure.get(figures.session_id)
        camera, when = figures.camera, figures.when
        if known is None and camera.serial and not figures.simulated:
            self._unsure[figures.session_id] = (False, False)
            path = chart_path(self._cameras.folder(practice=False), camera.serial)
            self._background.run(
                lambda: unsure_of(read_checks(path), when, camera.calibrated),
                lambda found: self._take_unsure(figures.session_id, found), lambda _: None, self,
            )  # fmt: skip
        return known or (False, False)

    def _take_unsure(self, session_id: str, found: tuple[bool, bool]) -> None:
        self._unsure[session_id] = found
        if any(found):
            self.changed.emit()

    def _take(self, standing: Standing) -> None:
        if standing != self.standing:
            self.standing = standing
            self.changed.emit()
