"""The camera calibrated with the board and checked with the card, in the real application on the simulated camera."""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import replace
from datetime import datetime
from pathlib import Path
from types import SimpleNamespace

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QFileDialog
from pytestqt.qtbot import QtBot

from carpus.app.desktop import maintenance_cameras
from carpus.app.desktop.window import Desktop
from carpus.core.calibration.camera import board_views
from carpus.core.calibration.camera.board import CHESSBOARD
from carpus.core.calibration.card import measure
from carpus.core.calibration.card.checks import add_check, checks_path, read_checks
from carpus.core.capture.calibrated_source import load_stored_calibration
from carpus.core.capture.source import FrameSource, NoticeHandler
from carpus.core.model.camera import Camera
from carpus.core.model.errors import CameraLost
from carpus.ui.screens.camera_calibration import flow
from carpus.ui.screens.settings.camera_card import CameraCard
from carpus.ui.shell.messages import MessageDialog
from tests import studio
from tests.ui.camera_fakes import board_result, checked

FEW = 12
pytestmark = pytest.mark.timeout(600)


@pytest.fixture
def data(tmp_path: Path) -> Path:
    """The data folder."""
    return tmp_path / "data"


@pytest.fixture
def desktop(open_desktop: Callable[..., Desktop]) -> Desktop:
    return open_desktop(speed=20.0)


@pytest.fixture(autouse=True)
def hurry(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each picture of the board another pose and long after the last, so that none must be still; few are asked for.
    A busy computer misses pictures: then two of the card will do, whatever lies between them."""
    monkeypatch.setattr(studio, "FPS", 1.0)
    monkeypatch.setattr(studio, "_STILL_FRAMES", 1)
    monkeypatch.setattr(studio, "_MOST_PICTURES", 6)
    monkeypatch.setattr(studio, "_between", lambda one, other: other)
    monkeypatch.setitem(board_views.WANTED_VIEWS, "chessboard", FEW)
    monkeypatch.setattr(measure, "CHECK_S", 6.0)
    monkeypatch.setattr(measure, "_MAX_GAP_S", 1e9)
    monkeypatch.setattr(measure, "MIN_FRAMES", 2)


def press(qtbot: QtBot, key: Qt.Key, modifier: Qt.KeyboardModifier = Qt.KeyboardModifier.NoModifier) -> None:
    at = QApplication.focusWidget()
    assert at is not None
    qtbot.keyClick(at, key, modifier)


def test_camera_calibration_leads_from_settings_to_card(
    qtbot: QtBot, desktop: Desktop, data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    journey, board = desktop.controller, desktop.controller.board.screen
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(tmp_path / "board.pdf"), ""))
    monkeypatch.setattr(maintenance_cameras, "open_camera", lambda *_, **__: studio.board_camera(CHESSBOARD, 20.0))
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
    press(qtbot, Qt.Key.Key_Escape)
    assert board.is_setup_shown, "left half-way"
    board.setup_view.start_button.click()
    qtbot.waitUntil(board.capture_view.primary_button.isEnabled, timeout=240_000)
    board.capture_view.primary_button.click()
    qtbot.waitUntil(lambda: board.result_view.result is not None)
    assert "The camera is calibrated" in board.result_view.headline_text.text()
    board.result_view.use_button.click()
    qtbot.waitUntil(lambda: journey.place == "card")
    assert load_stored_calibration(data, studio.SERIAL) is not None
    desktop.close()


def test_leaving_during_calibration_save_does_not_open_card(
    qtbot: QtBot, desktop: Desktop, monkeypatch: pytest.MonkeyPatch
) -> None:
    """There whoever is open is closed, and what is recorded of them ends."""
    journey, written = desktop.controller, threading.Event()
    monkeypatch.setattr(flow, "save_calibration", lambda *_: written.wait(60.0))
    journey.board.open()
    monkeypatch.setattr(journey.board, "_session", SimpleNamespace(info=SimpleNamespace(settings={})))
    journey.board.screen.show_result(board_result())
    journey.board.screen.result_view.use_button.click()
    journey.patients.open()
    written.set()
    qtbot.waitUntil(lambda: not journey.background.is_busy)
    assert journey.place == "patients"


@pytest.fixture
def card_camera(desktop: Desktop, monkeypatch: pytest.MonkeyPatch) -> list[NoticeHandler]:
    """A camera is plugged in that looks at the card and tells no number; what hears of it being away."""
    heard: list[NoticeHandler] = []

    def opened(_uri: str, *, camera: Camera | None = None, notice: NoticeHandler) -> FrameSource:
        heard.append(notice)
        made = studio.card_camera(20.0)
        made.info = replace(made.info, name="Xtion", settings={})
        return made

    monkeypatch.setattr(maintenance_cameras, "open_camera", opened)
    monkeypatch.setattr(desktop.controller.context.cameras, "name", lambda: "Xtion PRO LIVE")
    desktop.controller.camera_state.check_connection()
    return heard


def test_settings_of_a_camera_that_was_out_say_so_with_the_date(qtbot: QtBot, desktop: Desktop, data: Path) -> None:
    journey, last = desktop.controller, checked(out=True).last_check
    assert last is not None
    when = datetime.now().astimezone().isoformat()
    add_check(checks_path(data, "77"), replace(last, serial="77", checked_at=when))
    journey.navigator.open_screen("settings")
    card = desktop.shell.findChild(CameraCard)
    disk, answers = maintenance_cameras.find_camera_serials, threading.Event()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(
            maintenance_cameras, "find_camera_serials", lambda folder: disk(folder) if answers.wait(600) else set()
        )
        card.check_button.click()
        assert journey.place == "card", "a disk that hangs does not hold the window"
        assert "not been checked" in journey.card.screen.instruction.text()
        answers.set()
        qtbot.waitUntil(lambda: journey.camera_state.status.is_out_of_tolerance)
    assert "all lengths are 2.6 % too long" in journey.card.screen.instruction.text()
    assert "Checked" in card._state.text()
    assert "2.6 % too long" in card._state.text()
    for expected in ("settings", "patients"):
        journey.navigator.navigate_back()
        assert journey.place == expected, "back the way one came"


def test_check_of_camera_without_number_is_kept_under_its_name(
    qtbot: QtBot, desktop: Desktop, data: Path, tmp_path: Path, card_camera: list[NoticeHandler],
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    journey, card = desktop.controller, desktop.controller.card.screen
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(tmp_path / "card.pdf"), ""))
    journey.card.open()
    card.print_button.click()
    qtbot.waitUntil((tmp_path / "card.pdf").exists)
    card.check_button.click()
    qtbot.waitUntil(card.name_dialog.isVisible)
    assert not card.name_dialog.accept_button.isEnabled()
    press(qtbot, Qt.Key.Key_Escape)
    assert not card.is_measuring, "not named, not measured"
    card.check_button.click()
    qtbot.waitUntil(card.name_dialog.isVisible)
    card.name_dialog.name_entered.emit("left")
    journey.card.return_to_start()  # while the name is being kept
    qtbot.waitUntil(lambda: (data / "cameras" / "names.json").exists() and not desktop.controller.background.is_busy)
    assert not card.is_measuring, "the camera is opened after everybody left"
    (data / "cameras" / "names.json").unlink()
    card.check_button.click()
    qtbot.waitUntil(card.name_dialog.isVisible)
    assert card.progress is None
    qtbot.keyClicks(card.name_dialog.name_field, "room 3")
    press(qtbot, Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: card.progress is not None and card.progress.disc_px is not None)
    told: list[object] = []
    journey.card.camera_session.camera_lost.connect(told.append)
    card_camera[-1](CameraLost("Xtion PRO LIVE", "unplugged"))
    qtbot.waitUntil(lambda: bool(told))
    qtbot.waitUntil(lambda: journey.camera_state.status.last_check is not None, timeout=240_000)
    assert [one.serial for one in read_checks(checks_path(data, "room 3"))] == ["room 3"]
    assert "too long" in card.instruction.text(), "its depth is off, and it was never calibrated"
    assert not card.is_measuring
    card.check_button.click()
    qtbot.waitUntil(card.name_dialog.isVisible)
    assert card.name_dialog.name_field.text() == "room 3"
    assert "room 3" in card.name_dialog.title.text()
    press(qtbot, Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: journey.card.camera_session._session is not None)
    journey.card.camera_session.failed.emit(CameraLost("simulated"))
    assert not card.is_measuring
    assert [one for one in desktop.shell.findChildren(MessageDialog) if one.isVisible()]
    desktop.close()
