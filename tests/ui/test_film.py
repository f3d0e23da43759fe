"""A repetition as a film: the hand alone, opened by another reader; the angle where it lies in the picture."""

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
from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.qtbot import QtBot

from carpus.core.errors import OutputNotWritable
from carpus.core.formats.film import write_film
from carpus.core.hand.exercises import exercise_named
from carpus.core.results.hand_cutout import FLAT, box_of, cut_out, drawn_angle
from carpus.core.results.repetition_rows import PASSIVE
from carpus.core.session.values import Session
from carpus.core.types import SIMULATED, ByteImage, TrackStatus
from carpus.ui.background import Background
from carpus.ui.review.film import STILL, FilmWanted, film_pictures
from carpus.ui.review.flow import ReviewFlow
from carpus.ui.theme import Theme
from tests.ui.conftest import Reviewing
from tests.ui.contexts import Told, a_context
from tests.ui.fakes import FakeSessions, session

ROWS = range(30, 90)
FACE = (255, 0, 255)


def room(_: int = 0) -> ByteImage:
    """A picture that is a face all over, so that whatever of it stays is seen."""
    return np.full((480, 640, 3), FACE, np.uint8)


@pytest.fixture(scope="module")
def side() -> Session:
    return session(exercise="WRIST_RU", motion="deviation", seconds=20.0, speed_hz=0.16)


def test_only_what_is_near_the_hand_stays(side: Session) -> None:
    box = box_of(side, ROWS)
    left, top, right, foot = box
    assert (right - left) % 2 == 0
    assert (foot - top) % 2 == 0
    for row in ROWS[::10]:
        alone = cut_out(room(), side, row, box)
        kept = (alone == FACE).all(axis=2)
        assert (alone[~kept] == FLAT).all()
        discs = np.round(side.markers.measured_px[row] - (left, top)).astype(int)
        assert kept[discs[:, 1], discs[:, 0]].all(), "the hand is there"
        far = np.argwhere(kept)[:, ::-1] + (left, top)
        reach = np.linalg.norm(far[:, None] - side.markers.measured_px[row][None], axis=2).min(axis=1)
        palm = float(np.linalg.norm(side.markers.measured_px[row][3] - side.markers.measured_px[row][0]))
        assert reach.max() < 2.2 * palm, "no more of the room than fingers may reach"
        assert kept.sum() < 0.5 * room().shape[0] * room().shape[1]
    status = np.array(side.status)
    status[ROWS[0]] = TrackStatus.LOST
    assert (cut_out(room(), replace(side, status=status), ROWS[0], box) == FLAT).all(), "a lost hand shows nothing"


def test_the_angle_on_the_picture_is_the_one_that_was_measured(side: Session) -> None:
    exercise = exercise_named("WRIST_RU")
    for row in ROWS[::7]:
        drawn = drawn_angle(side, row, exercise)
        zero, hand = drawn.zero - drawn.vertex, drawn.hand - drawn.vertex
        shown = math.degrees(math.atan2(zero[0] * hand[1] - zero[1] * hand[0], float(zero @ hand)))
        assert abs(abs(shown) - abs(math.degrees(side.motion.angles_rad[row][0]))) < 4.0
    bending = session(seconds=20.0, speed_hz=0.16)
    assert drawn_angle(bending, 60, exercise_named("WRIST_FE")) is None, "towards the camera it would look too small"


def test_the_film_is_opened_by_another_reader(qapp: QApplication, side: Session, theme: Theme, tmp_path: Path) -> None:
    wanted = FilmWanted(side, "s", 4, ROWS, 15.0, exercise_named("WRIST_RU"), lambda row: f"{row}")
    made, within = tmp_path / "made", tmp_path / "within"
    made.mkdir()
    within.mkdir()
    path = write_film(made / "film.mp4", film_pictures(theme, wanted, room), wanted.rate_hz, within)
    assert path.read_bytes()[4:8] == b"ftyp"
    film = cv2.VideoCapture(str(path))
    assert film.isOpened()
    left, top, right, foot = box_of(side, ROWS)
    assert film.get(cv2.CAP_PROP_FPS) == pytest.approx(15.0)
    count, size = 0, (0, 0)
    while (read := film.read())[0]:
        count, size = count + 1, read[1].shape[:2]
    assert count == len(ROWS)
    assert size[0] % (foot - top) == size[1] % (right - left) == 0
    assert [one.name for one in made.iterdir()] == ["film.mp4"], "nothing half-written beside it"
    with pytest.raises(OutputNotWritable):
        write_film(made / "none.mp4", iter(()), 15.0, within)
    assert not (made / "none.mp4").exists()
    assert not list(within.iterdir())


def test_without_agreement_or_pictures_there_is_no_film(qtbot: QtBot, review: Reviewing) -> None:
    def take() -> FilmWanted:
        """With agreement; what is wanted then."""
        qtbot.mouseClick(sheet.agreed, Qt.MouseButton.LeftButton)
        qtbot.keyClick(sheet, Qt.Key.Key_Return)
        return wanted[-1]

    screen = review(FakeSessions(pictures=False), "session-7")
    assert screen.picture.film_button.isHidden()
    screen.ask_film()
    assert not screen.film_sheet.isVisible()
    screen = review(FakeSessions(), "session-7")
    wanted: list[FilmWanted] = []
    screen.film.connect(wanted.append)
    screen.go_to_repetition(3)
    qtbot.mouseClick(screen.picture.film_button, Qt.MouseButton.LeftButton)
    sheet = screen.film_sheet
    assert sheet.isVisible()
    assert not sheet.take.isEnabled()
    qtbot.keyClick(sheet, Qt.Key.Key_Return)
    assert not wanted
    screen.ask_film()
    film = take()
    assert film.number == 4
    one = screen.figures.repetitions[3]  # type: ignore[union-attr]
    assert len(film.rows) == pytest.approx(30 * (one.end_s - one.start_s), abs=2)
    assert film.rate_hz == pytest.approx(15.0, rel=0.05), "half as fast as it was"
    assert "°" in film.words(film.rows[len(film.rows) // 2])
    screen.ask_film()
    sheet.speed.choose(STILL)
    film = take()
    assert (film.rate_hz, len(film.rows)) == (0.0, 1)
    assert "passive" not in film.words(film.rows[0])
    screen._leave_out(screen.current + 1, PASSIVE, and_after=False)
    qtbot.waitUntil(lambda: screen.figures.repetitions[3].helped)  # type: ignore[union-attr]
    screen.ask_film()
    sheet.speed.choose(STILL)
    film = take()
    assert film.words(film.rows[0]).endswith("°, passive"), "no figure passes for the patient's own"
    reviewed = screen.reviewed
    header = replace(reviewed.session.header, parameters=json.dumps({"source": {SIMULATED: "yes"}}))
    screen.reviewed = replace(reviewed, session=replace(reviewed.session, header=header))
    screen._film(STILL)
    assert wanted[-1].words(wanted[-1].rows[0]).endswith("°, passive · Simulated hand"), "nor a drawing for a patient"
    screen.reviewed = reviewed
    screen.ask_film()
    assert not sheet.agreed.isChecked(), "agreement is given anew each time"
    sheet.begin(4, doubtful=True)
    assert not sheet.agreed.isEnabled()
    sheet.close_sheet()
    screen.picture.angle_button.click()
    qtbot.waitUntil(lambda: not screen.picture.reader.busy)


def test_a_saved_film_is_told_and_noted(
    qtbot: QtBot, theme: Theme, host: QWidget, background: Background, side: Session, tmp_path: Path
) -> None:
    made: list[tuple[str, object]] = []

    class Pictures:
        folder = tmp_path / "data"

        @staticmethod
        def picture(session_id: str, row: int) -> ByteImage:
            return room(row)

        @staticmethod
        def made(paths: list[Path], kind: str, sessions: list[str]) -> None:
            assert kind == "export"
            made.extend((str(path), sessions) for path in paths)

    Pictures.folder.mkdir()
    asked: list[tuple[object, ...]] = []
    places = SimpleNamespace(ask_where_to_save=lambda *given: asked.append(given) or tmp_path / "x")
    told = Told()
    flow = ReviewFlow(a_context(theme, host, told, background, library=Pictures(), places=places))
    qtbot.addWidget(flow.screen)
    flow.save_film(FilmWanted(side, "s7", 4, ROWS[:6], 30.0, exercise_named("WRIST_RU"), lambda _: ""))
    qtbot.waitUntil(lambda: bool(made))
    assert re.search(r"_\d{4}-\d\d-\d\d_\d\d-\d\d_wrist-ru_right_4.mp4$", str(asked[0][2]))
    assert made == [(str(tmp_path / "x.mp4"), ["s7"])]
    assert (tmp_path / "x.mp4").stat().st_mode & 0o077 == 0
    assert told.asked
    flow.save_film(FilmWanted(side, "s7", 4, ROWS[:1], 0.0, exercise_named("WRIST_RU"), lambda _: "24°"))
    qtbot.waitUntil(lambda: len(made) == 2)
    picture = cv2.imread(str(tmp_path / "x.png"))
    assert picture is not None
    assert (picture == FLAT).all(axis=2).mean() > 0.2, "room is cut away"
    assert (tmp_path / "x.png").stat().st_mode & 0o077 == 0
    assert not list(Pictures.folder.iterdir())
