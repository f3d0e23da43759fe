"""The camera as the window knows it: whether it is plugged in, and what its last check said."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime
from pathlib import Path
from typing import Protocol

from PySide6.QtCore import QObject, QTimer, Signal

from carpus.core.calibration.card.checks import CheckStatus
from carpus.core.pipeline.live import LiveSession
from carpus.ui.kit.background import Background

CHECK_INTERVAL_MS = 2000


class CameraAccess(Protocol):
    """What opens cameras, which no window does, and where what is known of them is kept."""

    def name(self) -> str | None:
        """Of the camera that would be opened, empty where the system does not tell; None where none is there."""
        ...

    def open_for_calibration(self) -> LiveSession:
        """The camera that looks at the board, as it says itself, without what was calibrated before."""
        ...

    def open_for_check(self) -> LiveSession:
        """The camera that looks at the card, as a session would have it."""
        ...

    def folder(self) -> Path:
        """Where what is known of it is kept."""
        ...

    def set_serial(self, serial: str) -> None:
        """The number of the camera that is there."""
        ...

    def save_name(self, kind: str, name: str) -> str:
        """What cameras of a kind that tell no number are called from now on: the name as it is kept."""
        ...

    def status(self, now: datetime) -> CheckStatus:
        """What is known of the camera; reads the disk."""
        ...


class CameraState(QObject):
    """``availability_checked`` when it was looked whether one is there; ``status_changed`` when it was read what is
    known of it."""

    availability_checked = Signal()
    status_changed = Signal()

    def __init__(
        self, cameras: CameraAccess, background: Background, now: Callable[[], datetime], parent: QObject, *,
        is_demo: bool = False,
    ) -> None:  # fmt: skip
        """In a demo the simulated camera is the camera: nobody looks whether another is plugged in, or says so."""
        super().__init__(parent)
        self._cameras, self._background, self._now, self._is_demo = cameras, background, now, is_demo
        self.is_connected, self.name = False, ""
        self.status = CheckStatus("")
        self._timer = QTimer(self, interval=CHECK_INTERVAL_MS)
        self._timer.timeout.connect(self.check_connection)

    def start(self) -> None:
        self._timer.start()
        self.check_connection()
        self.refresh_status()

    def notify_availability(self, callback: Callable[[], object]) -> None:
        self.availability_checked.connect(callback)
        callback()

    def stop(self) -> None:
        self._timer.stop()

    def check_connection(self) -> None:
        name = "" if self._is_demo else self._cameras.name()
        self.is_connected, self.name = name is not None, name or ""
        self.availability_checked.emit()

    def refresh_status(self) -> None:
        """Read anew what is kept of the camera; a disk that does not answer keeps nobody waiting."""
        cameras, now = self._cameras, self._now()
        self._background.run(lambda: cameras.status(now), self._on_status, lambda _: None, self)

    def set_serial(self, serial: str) -> None:
        """A camera was opened: from now on it is the one that is spoken of."""
        self._cameras.set_serial(serial)
        self.refresh_status()

    def _on_status(self, status: CheckStatus) -> None:
        self.status = status
        self.status_changed.emit()
