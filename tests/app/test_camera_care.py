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

from carpus.app.desktop import care_cameras
from carpus.app.desktop.window import Desktop
from carpus.core.calibration.camera import views
from carpus.core.calibration.camera.board import CHESSBOARD
from carpus.core.calibration.card import measure
from carpus.core.calibration.card.checks import add_check, checks_path, read_checks
from carpus.core.camera import Camera
from carpus.core.capture.calibrated import stored_calibration
from carpus.core.capture.source import FrameSource, Notice
from carpus.core.errors import CameraLost
from carpus.ui.camera_calibration import flow
from carpus.ui.messages.messages import StopCard
from carpus.ui.settings.camera_card import CameraCard
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
    monkeypatch.setitem(views.ASKED_VIEWS, "chessboard", FEW)
    monkeypatch.setattr(measure, "CHECK_S", 6.0)
    monkeypatch.setattr(measure, "_LONGEST_GAP_S", 1e9)
    monkeypatch.setattr(measure, "FEWEST_PICTURES", 2)


def press(qtbot: QtBot, key: Qt.Key, modifier: Qt.KeyboardModifier = Qt.KeyboardModifier.NoModifier) -> None:
    at = QApplication.focusWidget()
    assert at is not None
    qtbot.keyClick(at, key, modifier)


def test_from_the_settings_over_the_board_to_the_card(
    qtbot: QtBot, desktop: Desktop, data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    journey, board = desktop.journey, desktop.journey.board.screen
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(tmp_path / "board.pdf"), ""))
    monkeypatch.setattr(care_cameras, "open_camera", lambda *_, **__: studio.board_camera(CHESSBOARD, 20.0))
    journey.way.show("settings")
    desktop.shell.findChild(CameraCard).calibrate_button.click()
    assert journey.place == "board"
    assert not board.beginning.begin_button.isEnabled(), "no camera is plugged in here"
    board.beginning.print_button.click()
    qtbot.waitUntil((tmp_path / "board.pdf").exists)
    monkeypatch.setattr(journey.context.cameras, "name", lambda: "Xtion PRO LIVE")
    journey.camera_state.look()
    board.beginning.begin_button.click()
    assert not board.showing.primary.isEnabled()
    qtbot.waitUntil(lambda: board.showing.progress is not None)
    press(qtbot, Qt.Key.Key_Escape)
    assert board.is_beginning, "left half-way"
    board.beginning.begin_button.click()
    qtbot.waitUntil(board.showing.primary.isEnabled, timeout=240_000)
    board.showing.primary.click()
    qtbot.waitUntil(lambda: board.result.result is not None)
    assert "The camera is calibrated" in board.result.answer.text()
    board.result.use_button.click()
    qtbot.waitUntil(lambda: journey.place == "card")
    assert stored_calibration(data, studio.SERIAL) is not None
    desktop.close()


def test_who_left_while_a_calibration_is_written_is_not_sent_to_the_card(
    qtbot: QtBot, desktop: Desktop, monkeypatch: pytest.MonkeyPatch
) -> None:
    """There whoever is open is closed, and what is recorded of them ends."""
    journey, written = desktop.journey, threading.Event()
    monkeypatch.setattr(flow, "keep_calibration", lambda *_: written.wait(60.0))
    journey.board.show()
    monkeypatch.setattr(journey.board, "_session", SimpleNamespace(info=SimpleNamespace(settings={})))
    journey.board.screen.show_result(board_result())
    journey.board.screen.result.use_button.click()
    journey.patients.show()
    written.set()
    qtbot.waitUntil(lambda: not journey.background.busy)
    assert journey.place == "patients"


@pytest.fixture
def card_camera(desktop: Desktop, monkeypatch: pytest.MonkeyPatch) -> list[Notice]:
    """A camera is plugged in that looks at the card and tells no number; what hears of it being away."""
    heard: list[Notice] = []

    def opened(_uri: str, *, camera: Camera | None = None, notice: Notice) -> FrameSource:
        heard.append(notice)
        made = studio.card_camera(20.0)
        made.info = replace(made.info, name="Xtion", settings={})
        return made

    monkeypatch.setattr(care_cameras, "open_camera", opened)
    monkeypatch.setattr(desktop.journey.context.cameras, "name", lambda: "Xtion PRO LIVE")
    desktop.journey.camera_state.look()
    return heard


def test_settings_of_a_camera_that_was_out_say_so_with_the_date(qtbot: QtBot, desktop: Desktop, data: Path) -> None:
    journey, last = desktop.journey, checked(out=True).check
    assert last is not None
    when = datetime.now().astimezone().isoformat()
    add_check(checks_path(data, "77"), replace(last, serial="77", when=when))
    journey.way.show("settings")
    card = desktop.shell.findChild(CameraCard)
    disk, answers = care_cameras.known_serials, threading.Event()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(care_cameras, "known_serials", lambda folder: disk(folder) if answers.wait(600) else set())
        card.check_button.click()
        assert journey.place == "card", "a disk that hangs does not hold the window"
        assert "not been checked" in journey.card.screen.words.text()
        answers.set()
        qtbot.waitUntil(lambda: journey.camera_state.status.is_out)
    assert "all lengths are 2.6 % too long" in journey.card.screen.words.text()
    assert "Checked" in card._state.text()
    assert "2.6 % too long" in card._state.text()
    for expected in ("settings", "patients"):
        journey.way.back()
        assert journey.place == expected, "back the way one came"


def test_a_check_of_a_camera_without_a_number_is_kept_under_its_name(
    qtbot: QtBot, desktop: Desktop, data: Path, tmp_path: Path, card_camera: list[Notice],
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    journey, card = desktop.journey, desktop.journey.card.screen
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(tmp_path / "card.pdf"), ""))
    journey.card.show()
    card.print_button.click()
    qtbot.waitUntil((tmp_path / "card.pdf").exists)
    card.check_button.click()
    qtbot.waitUntil(card.name_sheet.isVisible)
    assert not card.name_sheet.take.isEnabled()
    press(qtbot, Qt.Key.Key_Escape)
    assert not card.is_measuring, "not named, not measured"
    card.check_button.click()
    qtbot.waitUntil(card.name_sheet.isVisible)
    card.name_sheet.named.emit("left")
    journey.card.back()  # while the name is being kept
    qtbot.waitUntil(lambda: (data / "cameras" / "names.json").exists() and not desktop.journey.background.busy)
    assert not card.is_measuring, "the camera is opened after everybody left"
    (data / "cameras" / "names.json").unlink()
    card.check_button.click()
    qtbot.waitUntil(card.name_sheet.isVisible)
    assert card.progress is None
    qtbot.keyClicks(card.name_sheet.line, "room 3")
    press(qtbot, Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: card.progress is not None and card.progress.pixel is not None)
    told: list[object] = []
    journey.card.hand.lost.connect(told.append)
    card_camera[-1](CameraLost("Xtion PRO LIVE", "unplugged"))
    qtbot.waitUntil(lambda: bool(told))
    qtbot.waitUntil(lambda: journey.camera_state.status.check is not None, timeout=240_000)
    assert [one.serial for one in read_checks(checks_path(data, "room 3"))] == ["room 3"]
    assert "too long" in card.words.text(), "its depth is off, and it was never calibrated"
    assert not card.is_measuring
    card.check_button.click()
    qtbot.waitUntil(card.name_sheet.isVisible)
    assert card.name_sheet.line.text() == "room 3"
    assert "room 3" in card.name_sheet.title.text()
    press(qtbot, Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: journey.card.hand._session is not None)
    journey.card.hand.failed.emit(CameraLost("simulated"))
    assert not card.is_measuring
    assert [one for one in desktop.shell.findChildren(StopCard) if one.isVisible()]
    desktop.close()
