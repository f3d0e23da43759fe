"""State of the camera: connected or not, and the result of its last check."""

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
    """Access to cameras and their stored calibrations; implemented by ``app``."""

    def name(self) -> str | None:
        """Return the name of the connected camera, empty if unknown, None if there is none."""

    def open_for_calibration(self) -> LiveSession:
        """Open the camera without its stored calibration."""

    def open_for_check(self) -> LiveSession:
        """Open the camera as a session would."""

    def folder(self) -> Path:
        """Return the folder of calibrations and checks."""

    def set_serial(self, serial: str) -> None:
        """Note the serial number of the connected camera."""

    def save_name(self, kind: str, name: str) -> str:
        """Save the name of cameras of a type without serial numbers; return it as saved."""

    def status(self, now: datetime) -> CheckStatus:
        """Read the calibration and check status from the disk."""


class CameraState(QObject):
    """Connection and check status of the camera.

    Signals: ``availability_checked``, ``status_changed``.
    """

    availability_checked = Signal()
    status_changed = Signal()

    def __init__(
        self, cameras: CameraAccess, background: Background, now: Callable[[], datetime], parent: QObject, *,
        is_demo: bool = False,
    ) -> None:  # fmt: skip
        """In a demo the simulated camera is the camera; connected ones are ignored."""
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
        """Read the status in the background."""
        cameras, now = self._cameras, self._now()
        self._background.run(lambda: cameras.status(now), self._on_status, lambda _: None, self)

    def set_serial(self, serial: str) -> None:
        """Note the camera that was opened and read its status."""
        self._cameras.set_serial(serial)
        self.refresh_status()

    def _on_status(self, status: CheckStatus) -> None:
        self.status = status
        self.status_changed.emit()
