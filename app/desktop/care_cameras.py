"""The cameras that are calibrated and checked: the one that is plugged in, or the simulated one, kept apart."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime
from pathlib import Path

from carpus.app.settings import Settings
from carpus.core.calibration.camera.board import Board
from carpus.core.calibration.card.checks import CheckStatus, check_status, known_serials
from carpus.core.capture.calibrated import keep_name, stored_calibration, with_given_name, with_stored_calibration
from carpus.core.capture.camera_info import read_camera_info
from carpus.core.capture.devices.cameras import name_to_open, open_camera
from carpus.core.capture.source import FrameSource, Notice
from carpus.core.pipeline.live import LiveSession

PRACTICE_FOLDER = "practice"
"""Inside the data folder: what is known of the simulated camera, which no session of a real one ever reads."""


class CareCameras:
    """:class:`ui.camera_state.Cameras`; ``speed`` above 1 plays the simulated one faster."""

    def __init__(self, settings: Settings, speed: float = 1.0) -> None:
        self._settings, self._speed = settings, speed
        self._met = ""

    def name(self) -> str | None:
        """Of the camera that would be opened, empty where the system does not tell; None where none is there."""
        return name_to_open(self._settings.camera.uri)

    def folder(self, *, practice: bool) -> Path:
        """Where what is known of it is kept."""
        folder = self._settings.data_folder
        return folder / PRACTICE_FOLDER if practice else folder

    def for_board(self, board: Board, *, practice: bool) -> LiveSession:
        """As the camera says itself, without what was calibrated before."""
        folder = self.folder(practice=practice)
        if practice:
            from carpus.core.simulation.practice_camera import board_camera

            return LiveSession(board_camera(board, self._speed))
        uri = self._settings.camera.uri
        return session_of(lambda notice: with_given_name(open_camera(uri, notice=notice), folder))

    def for_card(self) -> LiveSession:
        """As a session would have it, with what was calibrated."""
        return session_of(self.live)

    def live(self, notice: Notice) -> FrameSource:
        """The camera with its name and what was calibrated; ``notice`` hears when it is away."""
        camera, folder = self._settings.camera, self._settings.data_folder
        measured = read_camera_info(Path(camera.intrinsics).expanduser()).camera if camera.intrinsics else None
        live = open_camera(camera.uri, camera=measured, notice=notice)
        return with_stored_calibration(with_given_name(live, folder), folder)

    def serial(self, *, practice: bool) -> str:
        """The number of the camera that was met last; before, of the only one that anything is known of."""
        if practice:
            from carpus.core.simulation.practice_camera import PRACTICE_SERIAL

            return PRACTICE_SERIAL
        if self._met:
            return self._met
        known = known_serials(self._settings.data_folder)
        return known.pop() if len(known) == 1 else ""

    def met(self, serial: str) -> None:
        """A camera was opened, and this is its number."""
        self._met = serial or self._met

    def calibrated(self, serial: str, *, practice: bool) -> datetime | None:
        """When it was calibrated last."""
        kept = stored_calibration(self.folder(practice=practice), serial)
        made = kept.calibration if kept is not None else None
        return datetime.fromisoformat(made.calibrated) if made is not None else None

    def keep_name(self, kind: str, name: str, *, practice: bool) -> str:
        """The name as it is kept."""
        return keep_name(self.folder(practice=practice), kind, name)

    def status(self, now: datetime) -> CheckStatus:
        """What is known of the camera; reads the disk."""
        return check_status(self._settings.data_folder, self.serial(practice=False), now)


def session_of(camera: Callable[[Notice], FrameSource]) -> LiveSession:
    """A camera that tells the session when it is away."""
    heard: list[Notice] = [lambda _: None]  # until there is a session to be told
    session = LiveSession(camera(lambda fault: heard[-1](fault)))
    heard.append(session.notice)
    return session
