"""The camera as the window knows it: whether it is plugged in, and what its last check said."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime
from pathlib import Path
from typing import Protocol

from PySide6.QtCore import QObject, QTimer, Signal

from carpus.core.calibration.card.checks import CheckStatus
from carpus.core.pipeline.live import LiveSession
from carpus.ui.background import Background

LOOK_EVERY_MS = 2000


class Cameras(Protocol):
    """What opens cameras, which no window does, and where what is known of them is kept."""

    def name(self) -> str | None:
        """Of the camera that would be opened, empty where the system does not tell; None where none is there."""
        ...

    def for_board(self) -> LiveSession:
        """The camera that looks at the board, as it says itself, without what was calibrated before."""
        ...

    def for_card(self) -> LiveSession:
        """The camera that looks at the card, as a session would have it."""
        ...

    def folder(self) -> Path:
        """Where what is known of it is kept."""
        ...

    def met(self, serial: str) -> None:
        """The number of the camera that is there."""
        ...

    def keep_name(self, kind: str, name: str) -> str:
        """What cameras of a kind that tell no number are called from now on: the name as it is kept."""
        ...

    def status(self, now: datetime) -> CheckStatus:
        """What is known of the camera; reads the disk."""
        ...


class CameraState(QObject):
    """``looked`` when it was looked whether one is there; ``changed`` when it was read what is known of it."""

    looked = Signal()
    changed = Signal()

    def __init__(
        self, cameras: Cameras, background: Background, now: Callable[[], datetime], parent: QObject, *,
        is_demo: bool = False,
    ) -> None:  # fmt: skip
        """In a demo the simulated camera is the camera: nobody looks whether another is plugged in, or says so."""
        super().__init__(parent)
        self._cameras, self._background, self._now, self._is_demo = cameras, background, now, is_demo
        self.there, self.name = False, ""
        self.status = CheckStatus("")
        self._timer = QTimer(self, interval=LOOK_EVERY_MS)
        self._timer.timeout.connect(self.look)

    def start(self) -> None:
        self._timer.start()
        self.look()
        self.read()

    def when_looked(self, show: Callable[[], object]) -> None:
        self.looked.connect(show)
        show()

    def stop(self) -> None:
        self._timer.stop()

    def look(self) -> None:
        name = "" if self._is_demo else self._cameras.name()
        self.there, self.name = name is not None, name or ""
        self.looked.emit()

    def read(self) -> None:
        """Read anew what is kept of the camera; a disk that does not answer keeps nobody waiting."""
        cameras, now = self._cameras, self._now()
        self._background.run(lambda: cameras.status(now), self._take, lambda _: None, self)

    def met(self, serial: str) -> None:
        """A camera was opened: from now on it is the one that is spoken of."""
        self._cameras.met(serial)
        self.read()

    def _take(self, status: CheckStatus) -> None:
        self.status = status
        self.changed.emit()
