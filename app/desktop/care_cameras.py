"""The camera that is calibrated and checked: the one that is plugged in."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime
from pathlib import Path

from carpus.app.settings import Settings
from carpus.core.calibration.card.checks import CheckStatus, check_status, known_serials
from carpus.core.capture.calibrated import keep_name, with_given_name, with_stored_calibration
from carpus.core.capture.camera_info import read_camera_info
from carpus.core.capture.devices.cameras import name_to_open, open_camera
from carpus.core.capture.source import FrameSource, Notice
from carpus.core.pipeline.live import LiveSession


class CareCameras:
    """:class:`ui.camera_state.Cameras`."""

    def __init__(self, settings: Settings) -> None:
        self._settings = settings
        self._met = ""

    def name(self) -> str | None:
        """Of the camera that would be opened, empty where the system does not tell; None where none is there."""
        return name_to_open(self._settings.camera.uri)

    def folder(self) -> Path:
        """Where what is known of it is kept."""
        return self._settings.data_folder

    def for_board(self) -> LiveSession:
        """As the camera says itself, without what was calibrated before."""
        uri = self._settings.camera.uri
        return session_of(lambda notice: with_given_name(open_camera(uri, notice=notice), self.folder()))

    def for_card(self) -> LiveSession:
        """As a session would have it, with what was calibrated."""
        return session_of(self.live)

    def live(self, notice: Notice) -> FrameSource:
        """The camera with its name and what was calibrated; ``notice`` hears when it is away."""
        camera, folder = self._settings.camera, self._settings.data_folder
        measured = read_camera_info(Path(camera.intrinsics).expanduser()).camera if camera.intrinsics else None
        live = open_camera(camera.uri, camera=measured, notice=notice)
        return with_stored_calibration(with_given_name(live, folder), folder)

    def met(self, serial: str) -> None:
        """A camera was opened, and this is its number."""
        self._met = serial or self._met

    def keep_name(self, kind: str, name: str) -> str:
        """The name as it is kept."""
        return keep_name(self.folder(), kind, name)

    def status(self, now: datetime) -> CheckStatus:
        """What is known of the camera that was met last, or before of the only one that anything is known of; reads
        the disk."""
        known = {self._met} if self._met else known_serials(self.folder())
        return check_status(self.folder(), known.pop() if len(known) == 1 else "", now)


def session_of(camera: Callable[[Notice], FrameSource]) -> LiveSession:
    """A camera that tells the session when it is away."""
    heard: list[Notice] = [lambda _: None]  # until there is a session to be told
    session = LiveSession(camera(lambda fault: heard[-1](fault)))
    heard.append(session.notice)
    return session
