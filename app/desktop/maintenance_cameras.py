"""Opens the connected camera for calibration and check."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING

from carpus.app.settings import Settings
from carpus.core.calibration.card.checks import CheckStatus, check_status, find_camera_serials
from carpus.core.capture.calibrated_source import save_camera_name, with_given_name, with_stored_calibration
from carpus.core.capture.camera_info import read_camera_info
from carpus.core.capture.devices.cameras import find_camera_name, open_camera
from carpus.core.capture.source import FrameSource, NoticeHandler
from carpus.core.pipeline.live import LiveSession

if TYPE_CHECKING:
    from carpus.core.capture.devices.process_camera import ProcessCamera


class MaintenanceCameras:
    """Implementation of :class:`ui.shell.camera_state.CameraAccess`."""

    def __init__(self, settings: Settings) -> None:
        self._settings = settings
        self._last_serial = ""

    def name(self) -> str | None:
        return find_camera_name(self._settings.camera.uri)

    def folder(self) -> Path:
        return self._settings.data_folder

    def open_for_calibration(self) -> LiveSession:
        uri = self._settings.camera.uri
        return start_live_session(lambda notice: with_given_name(open_camera(uri, notice=notice), self.folder()))

    def open_for_check(self) -> LiveSession:
        return start_live_session(lambda notice: open_chosen_camera(self._settings, notice)[1])

    def set_serial(self, serial: str) -> None:
        self._last_serial = serial or self._last_serial

    def save_name(self, kind: str, name: str) -> str:
        return save_camera_name(self.folder(), kind, name)

    def status(self, now: datetime) -> CheckStatus:
        """Read the status of the camera opened last, or of the only known one, from the disk."""
        known = {self._last_serial} if self._last_serial else find_camera_serials(self.folder())
        return check_status(self.folder(), known.pop() if len(known) == 1 else "", now)


def open_chosen_camera(settings: Settings, notice: NoticeHandler) -> tuple[ProcessCamera, FrameSource]:
    """Open the camera of the settings; return it, and as a source with its given name and stored calibration."""
    intrinsics, folder = settings.camera.intrinsics, settings.data_folder
    measured = read_camera_info(Path(intrinsics).expanduser()).camera if intrinsics else None
    camera = open_camera(settings.camera.uri, camera=measured, notice=notice)
    return camera, with_stored_calibration(with_given_name(camera, folder), folder)


def start_live_session(open_source: Callable[[NoticeHandler], FrameSource]) -> LiveSession:
    """Return a live session that receives the faults of its camera."""
    handlers: list[NoticeHandler] = [lambda _: None]  # until the session exists
    session = LiveSession(open_source(lambda fault: handlers[-1](fault)))
    handlers.append(session.handle_notice)
    return session
