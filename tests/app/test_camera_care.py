"""The camera calibrated with the board, in the real application on the simulated camera."""

from __future__ import annotations

import itertools
import threading
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QFileDialog
from pytestqt.qtbot import QtBot

from carpus.app.desktop import maintenance_cameras
from carpus.app.desktop.window import Desktop
from carpus.core.calibration.camera.board import CHESSBOARD, create_board_sheet
from carpus.core.capture.calibrated_source import load_stored_calibration
from carpus.core.capture.source import SERIAL as SAID_SERIAL
from carpus.core.capture.source import SourceInfo
from carpus.core.model.camera import DEFAULT_CAMERA
from carpus.core.model.types import SIMULATED, Frame
from carpus.ui.screens.settings.screen import CameraCard
from tests.studio import LENS, Studio, poses, render_texture

SERIAL = "studio"
pytestmark = pytest.mark.timeout(600)


@pytest.fixture
def data(tmp_path: Path) -> Path:
    """The data folder."""
    return tmp_path / "data"


@pytest.fixture
def desktop(open_desktop: Callable[..., Desktop]) -> Desktop:
    return open_desktop(speed=20.0)


class BoardCamera:
    """Shows the board in another pose in each frame, long after the last, so that none must be still."""

    def __init__(self) -> None:
        settings = {SAID_SERIAL: SERIAL, SIMULATED: "yes"}
        self.info = SourceInfo("Simulated camera", DEFAULT_CAMERA, True, None, 1.0, settings)
        self._closed = threading.Event()

    def frames(self) -> Iterator[Frame]:
        studio, texture = Studio(LENS, 21, 0.03), render_texture(create_board_sheet(CHESSBOARD, "a4"))
        for index, placed in enumerate(itertools.cycle(poses(texture, 60))):
            if self._closed.wait(0.05):
                return
            yield studio.frame([placed], index, float(index))

    def close(self) -> None:
        self._closed.set()


def test_camera_calibration_leads_from_settings_to_card(
    qtbot: QtBot, desktop: Desktop, data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    journey, board = desktop.controller, desktop.controller.board.screen
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(tmp_path / "board.pdf"), ""))
    monkeypatch.setattr(maintenance_cameras, "open_camera", lambda *_, **__: BoardCamera())
    monkeypatch.setattr("carpus.core.calibration.camera.board.WANTED_VIEWS", 12)
    journey.navigator.open_screen("settings")
    desktop.shell.findChild(CameraCard).calibrate_button.click()
    assert journey.place == "board"
    assert not board.setup_view.start_button.isEnabled(), "no camera is plugged in here"
    board.setup_view.print_button.click()
    qtbot.waitUntil((tmp_path / "board.pdf").exists)
    monkeypatch.setattr(journey.context.cameras, "name", lambda: "Xtion PRO LIVE")
    journey.camera_state.check_connection()
    board.setup_view.start_button.click()
    assert not board.capture_view.primary_button.isEnabled()
    qtbot.waitUntil(lambda: board.capture_view.progress is not None)
    qtbot.keyClick(QApplication.focusWidget(), Qt.Key.Key_Escape)
    assert board.is_setup_shown, "left half-way"
    board.setup_view.start_button.click()
    qtbot.waitUntil(board.capture_view.primary_button.isEnabled, timeout=240_000)
    board.capture_view.primary_button.click()
    qtbot.waitUntil(lambda: board.result_view.result is not None)
    assert "The camera is calibrated" in board.result_view.headline_text.text()
    board.result_view.use_button.click()
    qtbot.waitUntil(lambda: journey.place == "card")
    assert load_stored_calibration(data, SERIAL) is not None
    desktop.close()
