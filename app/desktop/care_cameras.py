"""The cameras that are calibrated and checked: the one that is plugged in, or the simulated one, kept apart."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path

from carpus.app.settings import Settings
from carpus.core.calibration.camera.board import Board
from carpus.core.calibration.card.standing import Standing, known_serials, standing_of
from carpus.core.capture.calibrated import with_stored_calibration
from carpus.core.capture.camera_info import read_camera_info
from carpus.core.capture.devices.cameras import open_camera
from carpus.core.capture.given_name import with_given_name
from carpus.core.capture.source import FrameSource, Notice

PRACTICE_FOLDER = "practice"
"""Inside the data folder: what is known of the simulated camera, which no session of a real one ever reads."""


class CareCameras:
    """Opens them, and knows where what is known of them is kept; ``speed`` above 1 plays the simulated one faster."""

    def __init__(self, settings: Settings, speed: float = 1.0) -> None:
        self._settings, self._speed = settings, speed
        self._met = ""

    def folder(self, *, practice: bool) -> Path:
        """Where what is known of it is kept."""
        folder = self._settings.data_folder
        return folder / PRACTICE_FOLDER if practice else folder

    def for_board(self, board: Board, notice: Notice, *, practice: bool) -> FrameSource:
        """As the camera says itself, without what was calibrated before; ``notice`` hears when it is away."""
        folder = self.folder(practice=practice)
        if practice:
            from carpus.core.simulation.practice_camera import board_camera

            return board_camera(board, self._speed)
        return with_given_name(open_camera(self._settings.camera.uri, notice=notice), folder)

    def for_card(self, notice: Notice, *, practice: bool) -> FrameSource:
        """As a session would have it, with what was calibrated; ``notice`` hears when it is away."""
        folder = self.folder(practice=practice)
        if practice:
            from carpus.core.simulation.practice_camera import card_camera

            return with_stored_calibration(card_camera(self._speed), folder)
        named = self._settings.camera.intrinsics
        camera = read_camera_info(Path(named).expanduser()).camera if named else None
        live = open_camera(self._settings.camera.uri, camera=camera, notice=notice)
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

    def standing(self, now: datetime) -> Standing:
        """What is known of the camera; reads the disk."""
        return standing_of(self._settings.data_folder, self.serial(practice=False), now)
