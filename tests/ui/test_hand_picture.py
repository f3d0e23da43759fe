"""A frame as a picture of the hand alone, opened by another reader; the angle where it lies in the image plane."""

from __future__ import annotations

import json
import math
import re
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import cv2
import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from carpus.core.model.errors import OutputNotWritable
from carpus.core.model.hand.exercises import get_exercise
from carpus.core.model.types import SIMULATED, ByteImage, TrackStatus
from carpus.core.results.hand_cutout import BACKGROUND_GREY, angle_overlay, cut_out_hand
from carpus.core.results.repetition_rows import PASSIVE
from carpus.core.session.values import Session
from carpus.ui.kit.background import Background
from carpus.ui.kit.theme import Theme
from carpus.ui.screens.review.flow import ReviewFlow
from carpus.ui.screens.review.frame_view import HandImage, build_hand_image
from tests.ui.conftest import Reviewing
from tests.ui.contexts import RecordingMessages, make_context
from tests.ui.fakes import FakeSessions, session
from tests.ui.geometry import painted_texts

ROWS = range(30, 90)
FACE = (255, 0, 255)


def room(_: int = 0) -> ByteImage:
    """A picture that is a face all over, so that whatever of it stays is seen."""
    return np.full((480, 640, 3), FACE, np.uint8)


@pytest.fixture(scope="module")
def side() -> Session:
    return session(exercise="WRIST_RU", motion="deviation", seconds=20.0, speed_hz=0.16)


def test_hand_picture_is_cropped_to_hand(side: Session) -> None:
    for row in ROWS[::10]:
        alone = cut_out_hand(room(), side, row)
        left, top = alone.left_px, alone.top_px
        kept = (alone.image == FACE).all(axis=2)
        assert (alone.image[~kept] == BACKGROUND_GREY).all()
        discs = np.round(side.markers.measured_px[row] - (left, top)).astype(int)
        assert kept[discs[:, 1], discs[:, 0]].all(), "the hand is there"
        far = np.argwhere(kept)[:, ::-1] + (left, top)
        reach = np.linalg.norm(far[:, None] - side.markers.measured_px[row][None], axis=2).min(axis=1)
        palm = float(np.linalg.norm(side.markers.measured_px[row][3] - side.markers.measured_px[row][0]))
        assert reach.max() < 2.2 * palm, "no more of the room than fingers may reach"
        assert kept.sum() < 0.5 * room().shape[0] * room().shape[1]
    status = np.array(side.status)
    status[ROWS[0]] = TrackStatus.LOST
    assert cut_out_hand(room(), replace(side, status=status), ROWS[0]) is None, "a lost hand shows nothing"


def test_angle_on_frame_is_one_that_was_measured(side: Session) -> None:
    exercise = get_exercise("WRIST_RU")
    for row in ROWS[::7]:
        drawn = angle_overlay(side, row, exercise)
        zero, hand = drawn.zero - drawn.vertex, drawn.hand - drawn.vertex
        shown = math.degrees(math.atan2(zero[0] * hand[1] - zero[1] * hand[0], float(zero @ hand)))
        assert abs(abs(shown) - abs(math.degrees(side.motion.angles_rad[row][0]))) < 4.0
    bending = session(seconds=20.0, speed_hz=0.16)
    assert angle_overlay(bending, 60, get_exercise("WRIST_FE")) is None, "towards the camera it would look too small"


def test_hand_picture_needs_frames_and_consent_and_says_whose_angle_it_is(qtbot: QtBot, review: Reviewing) -> None:
    screen = review(FakeSessions(pictures=False), "session-7")
    assert screen.frame_view.save_button.isHidden()
    with painted_texts(screen) as painted:
        screen.frame_view.grab()
    assert "No video was saved: markers only" in [one.text for one in painted]
    screen.open_hand_image_dialog()
    assert not screen.hand_image_dialog.isVisible()
    screen = review(FakeSessions(), "session-7")
    wanted: list[HandImage] = []
    screen.hand_image_requested.connect(wanted.append)
    screen.select_repetition(3)
    qtbot.mouseClick(screen.frame_view.save_button, Qt.MouseButton.LeftButton)
    sheet = screen.hand_image_dialog
    assert sheet.isVisible()
    assert not sheet.accept_button.isEnabled()
    qtbot.keyClick(sheet, Qt.Key.Key_Return)
    assert not wanted
    screen.open_hand_image_dialog()
    sheet.consent_check.click()
    qtbot.keyClick(sheet, Qt.Key.Key_Return)
    assert wanted[0].row == screen.frame_view.row
    assert wanted[0].words.endswith("°")
    screen.open_hand_image_dialog()
    assert not sheet.consent_check.isChecked(), "agreement is given each time"
    sheet.open_form(refused=True)
    assert not sheet.consent_check.isEnabled()
    sheet.close_dialog()
    row, time_s = screen.frame_view.row, screen.playing.time_s
    screen._exclude_repetition(screen.current + 1, PASSIVE, and_after=False)
    reviewed = screen.reviewed
    assert build_hand_image(reviewed, row, time_s).words.endswith("°, passive")
    header = replace(reviewed.session.header, parameters=json.dumps({"source": {SIMULATED: "yes"}}))
    simulated = replace(reviewed, session=replace(reviewed.session, header=header))
    assert build_hand_image(simulated, row, time_s).words.endswith("°, passive · Simulated hand")


def test_saved_frame_shows_hand_alone_is_reported_and_noted(
    qtbot: QtBot, theme: Theme, host: QWidget, background: Background, side: Session, tmp_path: Path
) -> None:
    made: list[tuple[str, object]] = []
    frames: dict[int, ByteImage] = {ROWS[0]: room()}

    class Pictures:
        @staticmethod
        def read_frame(session_id: str, row: int) -> ByteImage | None:
            return frames.get(row)

        @staticmethod
        def register_output_files(paths: list[Path], kind: str, sessions: list[str]) -> None:
            assert kind == "export"
            made.extend((str(path), sessions) for path in paths)

    asked: list[tuple[object, ...]] = []
    places = SimpleNamespace(choose_save_path=lambda *given: asked.append(given) or tmp_path / "x")
    messages = RecordingMessages()
    flow = ReviewFlow(make_context(theme, host, messages, background, library=Pictures(), recent_locations=places))
    qtbot.addWidget(flow.screen)
    flow.save_hand_image(HandImage(side, ROWS[0], get_exercise("WRIST_RU"), "24°"))
    qtbot.waitUntil(lambda: bool(made))
    assert re.search(r"_\d{4}-\d\d-\d\d_\d\d-\d\d_wrist-ru_right_30.png$", str(asked[0][2]))
    assert made == [(str(tmp_path / "x.png"), [side.header.session_id])]
    assert messages.asked
    picture = cv2.imread(str(tmp_path / "x.png"))
    assert (picture == BACKGROUND_GREY).all(axis=2).mean() > 0.2, "room is cut away"
    assert max(picture.shape) > 320, "a small hand is shown larger"
    assert (tmp_path / "x.png").stat().st_mode & 0o077 == 0
    (tmp_path / "x.png").unlink()
    flow.save_hand_image(HandImage(side, ROWS[1], get_exercise("WRIST_RU"), ""))
    qtbot.waitUntil(lambda: bool(messages.faults))
    assert isinstance(messages.faults[0], OutputNotWritable)
    assert not list(tmp_path.iterdir())
