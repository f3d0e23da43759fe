"""The camera that is calibrated and checked: the one that is plugged in."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime
from pathlib import Path

from carpus.app.settings import Settings
from carpus.core.calibration.card.checks import CheckStatus, check_status, find_camera_serials
from carpus.core.capture.calibrated_source import save_camera_name, with_given_name, with_stored_calibration
from carpus.core.capture.camera_info import read_camera_info
from carpus.core.capture.devices.cameras import find_camera_name, open_camera
from carpus.core.capture.source import FrameSource, NoticeHandler
from carpus.core.pipeline.live import LiveSession


class MaintenanceCameras:
    """:class:`ui.shell.camera_state.CameraAccess`."""

    def __init__(self, settings: Settings) -> None:
        self._settings = settings
        self._last_serial = ""

    def name(self) -> str | None:
        """Of the camera that would be opened, empty where the system does not tell; None where none is there."""
        return find_camera_name(self._settings.camera.uri)

    def folder(self) -> Path:
        """Where what is known of it is kept."""
        return self._settings.data_folder

    def open_for_calibration(self) -> LiveSession:
        """As the camera says itself, without what was calibrated before."""
        uri = self._settings.camera.uri
        return start_live_session(lambda notice: with_given_name(open_camera(uri, notice=notice), self.folder()))

    def open_for_check(self) -> LiveSession:
        """As a session would have it, with what was calibrated."""
        return start_live_session(self.live)

    def live(self, notice: NoticeHandler) -> FrameSource:
        """The camera with its name and what was calibrated; ``notice`` hears when it is away."""
        camera, folder = self._settings.camera, self._settings.data_folder
        measured = read_camera_info(Path(camera.intrinsics).expanduser()).camera if camera.intrinsics else None
        live = open_camera(camera.uri, camera=measured, notice=notice)
        return with_stored_calibration(with_given_name(live, folder), folder)

    def set_serial(self, serial: str) -> None:
        """A camera was opened, and this is its number."""
        self._last_serial = serial or self._last_serial

    def save_name(self, kind: str, name: str) -> str:
        """The name as it is kept."""
        return save_camera_name(self.folder(), kind, name)

    def status(self, now: datetime) -> CheckStatus:
        """What is known of the camera that was met last, or before of the only one that anything is known of; reads
        the disk."""
        known = {self._last_serial} if self._last_serial else find_camera_serials(self.folder())
        return check_status(self.folder(), known.pop() if len(known) == 1 else "", now)


def start_live_session(open_source: Callable[[NoticeHandler], FrameSource]) -> LiveSession:
    """A camera that tells the session when it is away."""
    heard: list[NoticeHandler] = [lambda _: None]  # until there is a session to be told
    session = LiveSession(open_source(lambda fault: heard[-1](fault)))
    heard.append(session.handle_notice)
    return session
