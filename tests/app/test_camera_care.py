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

from carpus.app.compose import Desktop
from carpus.app.desktop import care_cameras
from carpus.core.calibration.camera import views
from carpus.core.calibration.card import measure
from carpus.core.calibration.card.chart import add_check, chart_path, read_checks
from carpus.core.camera import Camera
from carpus.core.capture.calibrated import stored_calibration
from carpus.core.capture.source import FrameSource, Notice
from carpus.core.errors import CameraLost
from carpus.core.simulation import practice_camera
from carpus.ui.camera_calibration import flow
from carpus.ui.messages.messages import StopCard
from carpus.ui.settings.camera_card import CameraCard
from tests.ui.camera_fakes import board_result, camera_checks

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
    monkeypatch.setattr(practice_camera, "FPS", 1.0)
    monkeypatch.setattr(practice_camera, "_STILL_FRAMES", 1)
    monkeypatch.setattr(practice_camera, "_MOST_PICTURES", 6)
    monkeypatch.setattr(practice_camera, "_between", lambda one, other: other)
    monkeypatch.setitem(views.ASKED_VIEWS, "chessboard", FEW)
    monkeypatch.setattr(measure, "CHECK_S", 6.0)
    monkeypatch.setattr(measure, "_LONGEST_GAP_S", 1e9)
    monkeypatch.setattr(measure, "FEWEST_PICTURES", 2)


def press(qtbot: QtBot, key: Qt.Key, modifier: Qt.KeyboardModifier = Qt.KeyboardModifier.NoModifier) -> None:
    at = QApplication.focusWidget()
    assert at is not None
    qtbot.keyClick(at, key, modifier)


def test_from_the_settings_over_board_and_card_to_their_pages(
    qtbot: QtBot, desktop: Desktop, data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    journey, board, card = desktop.journey, desktop.journey.board.screen, desktop.journey.card.screen
    practice = data / "practice"

    def saved_as(name: str) -> Path:
        path = tmp_path / name
        monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(path), ""))
        return path

    journey.way.show("settings")
    settings_card = desktop.shell.findChild(CameraCard)
    settings_card.calibrate_button.click()
    assert journey.place == "board"
    assert not board.beginning.begin_button.isEnabled(), "no camera is plugged in here"
    pdf = saved_as("board.pdf")
    board.beginning.print_button.click()
    qtbot.waitUntil(pdf.exists)
    board.beginning.camera.buttons()[1].click()
    board.beginning.begin_button.click()
    assert not board.showing.primary.isEnabled()
    qtbot.waitUntil(lambda: board.showing.progress is not None)
    assert "nothing here is of a real one" in desktop.shell.sign.text
    press(qtbot, Qt.Key.Key_Escape)
    assert board.is_beginning, "left half-way"
    board.beginning.begin_button.click()
    qtbot.waitUntil(board.showing.primary.isEnabled, timeout=240_000)
    board.showing.primary.click()
    qtbot.waitUntil(lambda: board.result.result is not None)
    result = board.result.result
    assert result.simulated
    assert "The camera is calibrated" in board.result.answer.text()
    page = saved_as("calibration.pdf")
    press(qtbot, Qt.Key.Key_P, Qt.KeyboardModifier.ControlModifier)
    qtbot.waitUntil(page.exists)
    board.result.use_button.click()
    qtbot.waitUntil(lambda: journey.place == "card")
    kept = stored_calibration(practice, practice_camera.PRACTICE_SERIAL)
    assert kept is not None
    assert not (data / "cameras").exists(), "a simulated camera is never kept among real ones"
    assert card.checks.simulated
    card.check_button.click()
    qtbot.waitUntil(lambda: card.progress is not None and card.progress.pixel is not None)
    qtbot.waitUntil(lambda: card.checks.newest is not None and not card.is_measuring)
    assert card.answer.text() == "The camera measures right."
    page = saved_as("check.pdf")
    card.page_button.click()
    qtbot.waitUntil(page.exists)
    card.check_button.click()
    qtbot.waitUntil(lambda: journey.card.hand._session is not None)
    journey.card.hand.failed.emit(CameraLost("simulated"))
    assert not card.is_measuring
    told = [one for one in desktop.shell.findChildren(StopCard) if one.isVisible()]
    assert told
    desktop.close()
    assert len(read_checks(chart_path(practice, practice_camera.PRACTICE_SERIAL))) == 1


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


def test_the_top_bar_and_the_settings_say_that_the_camera_was_out(
    qtbot: QtBot, desktop: Desktop, data: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    journey = desktop.journey
    monkeypatch.setattr(journey.context.cameras, "name", lambda: "Xtion PRO LIVE")
    journey.camera_state.look()
    last = camera_checks(out=True).checks[-1]
    add_check(chart_path(data, "77"), replace(last, serial="77", when=datetime.now().astimezone().isoformat()))
    journey.camera_state.read()
    qtbot.waitUntil(lambda: journey.camera_state.standing.is_out)
    assert desktop.shell.bar.camera.text() == "Camera out: check it"
    journey.way.show("settings")
    card = desktop.shell.findChild(CameraCard)
    assert "out of its limits" in card._state.text()
    disk, answers = care_cameras.known_serials, threading.Event()
    monkeypatch.setattr(care_cameras, "known_serials", lambda folder: disk(folder) if answers.wait(600) else set())
    journey.card.show()
    assert (journey.place, journey.card.screen.checks.newest) == ("card", None), (
        "a disk that hangs does not hold the window"
    )
    answers.set()
    qtbot.waitUntil(lambda: journey.card.screen.checks.verdict == "out")
    assert journey.card.screen.check_button.text() == "Check once more"
    heard: list[Notice] = []

    def opened(_uri: str, *, camera: Camera | None = None, notice: Notice) -> FrameSource:
        heard.append(notice)
        return practice_camera.card_camera(20.0)

    monkeypatch.setattr(care_cameras, "open_camera", opened)
    journey.card.screen.check_button.click()
    qtbot.waitUntil(lambda: journey.card.hand._session is not None)
    told: list[object] = []
    journey.card.hand.lost.connect(told.append)
    heard[0](CameraLost("Xtion PRO LIVE", "unplugged"))
    qtbot.waitUntil(lambda: bool(told))


def test_a_camera_without_a_number_is_asked_for_its_name_before_the_check(
    qtbot: QtBot, desktop: Desktop, data: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    journey, card = desktop.journey, desktop.journey.card.screen
    monkeypatch.setattr(journey.context.cameras, "name", lambda: "Xtion PRO LIVE")
    journey.camera_state.look()

    def opened(_uri: str, *, camera: Camera | None = None, notice: Notice) -> FrameSource:
        made = practice_camera.card_camera(20.0)
        made.info = replace(made.info, name="Xtion", settings={})
        return made

    monkeypatch.setattr(care_cameras, "open_camera", opened)
    journey.card.show()
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
    qtbot.waitUntil(lambda: card.checks.newest is not None, timeout=240_000)
    assert [one.serial for one in read_checks(chart_path(data, "room 3"))] == ["room 3"]
    card.check_button.click()
    qtbot.waitUntil(card.name_sheet.isVisible)
    assert card.name_sheet.line.text() == "room 3"
    assert "room 3" in card.name_sheet.title.text()
    press(qtbot, Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: card.progress is not None and card.progress.pixel is not None)
    journey.card.back()
    desktop.close()
