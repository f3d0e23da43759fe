"""The calibration screen by mouse and by keyboard, and what its verdict lets a person do."""

from __future__ import annotations

import math
import threading

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from pytestqt.qtbot import QtBot

from carpus.core.calibration.calibrate import MeasuredHand
from carpus.core.calibration.hand_calibrator import FoundMarker
from carpus.core.calibration.result import CalibrationFinding, Clicks
from carpus.core.model.hand.protocols import HAND21, WRIST6
from carpus.ui.kit.background import Background
from carpus.ui.kit.theme import Theme
from carpus.ui.screens.markers.labelling import LabelState
from carpus.ui.screens.markers.marker_frame import MarkerFrameView
from carpus.ui.screens.markers.screen import MarkersScreen
from tests.ui.conftest import Show
from tests.ui.fakes import FakeCalibrator
from tests.ui.geometry import painted_texts


def walk(qtbot: QtBot, picture: MarkerFrameView, pixel: np.ndarray) -> None:
    """Lead the cursor to a place by the arrow keys, by tens with Shift."""
    assert picture.cursor_px is not None
    arrows = ((Qt.Key.Key_Left, Qt.Key.Key_Right), (Qt.Key.Key_Up, Qt.Key.Key_Down))
    for step, keys in zip(np.round(pixel - picture.cursor_px).astype(int), arrows, strict=True):
        tens, ones = divmod(abs(int(step)), 10)
        for _ in range(tens):
            qtbot.keyClick(picture, keys[int(step > 0)], Qt.KeyboardModifier.ShiftModifier)
        for _ in range(ones):
            qtbot.keyClick(picture, keys[int(step > 0)])


class Marking:
    """The markers screen as a person uses it."""

    def __init__(self, qtbot: QtBot, screen: MarkersScreen) -> None:
        self.screen, self._qtbot = screen, qtbot
        self.started: list[bool] = []
        screen.labelling.started.connect(lambda: self.started.append(True))

    @property
    def clicking(self) -> LabelState:
        return self.screen.labels

    def begin(self, *findings: CalibrationFinding, is_live: bool = False) -> FakeCalibrator:
        """Six discs that a person names: nothing is proposed."""
        self.calibrator = FakeCalibrator(is_live=is_live)
        self.calibrator.findings = findings
        self.screen.open_calibrator(self.calibrator)
        self._qtbot.waitUntil(lambda: not self.screen.labelling._background.is_busy)
        return self.calibrator

    def propose(
        self, protocol: str = "hand21", *, doubtful: tuple[str, ...] = (), not_found: tuple[str, ...] = ()
    ) -> FakeCalibrator:
        """Discs that are proposed with their names."""
        self.calibrator = FakeCalibrator("fist" if protocol == "hand21" else "flexion", protocol=protocol)
        self.calibrator.doubtful, self.calibrator.not_found = doubtful, not_found
        self.screen.open_calibrator(self.calibrator)
        self._qtbot.waitUntil(lambda: self.clicking is not None and bool(self.clicking.proposals))
        return self.calibrator

    def disc_px(self, name: str) -> np.ndarray:
        return self.calibrator.disc_px[self.calibrator.protocol.markers.index(name)]

    def at(self, pixel: np.ndarray) -> QPoint:
        return self.screen.picture.to_screen(*map(float, pixel)).toPoint()

    def click(self, *pixels: np.ndarray) -> None:
        for pixel in pixels:
            self._qtbot.mouseMove(self.screen.picture, self.at(pixel))
            self._qtbot.mouseClick(self.screen.picture, Qt.MouseButton.LeftButton, pos=self.at(pixel))

    def drag(self, start: np.ndarray, end: np.ndarray) -> None:
        self._qtbot.mousePress(self.screen.picture, Qt.MouseButton.LeftButton, pos=self.at(start))
        self._qtbot.mouseRelease(self.screen.picture, Qt.MouseButton.LeftButton, pos=self.at(end))

    def press(self, key: Qt.Key) -> None:
        """On the picture, as while it is clicked in."""
        self._qtbot.keyClick(self.screen.picture, key)

    def enter(self) -> None:
        self._qtbot.keyClick(self.screen.focusWidget(), Qt.Key.Key_Return)

    def judge(self) -> Clicks:
        """Wait for the verdict; what was judged."""
        self._qtbot.waitUntil(
            lambda: self.clicking is not None and self.clicking.is_complete and self.screen.primary_button.isEnabled()
        )
        return self.calibrator.judged[-1]

    def judge_all(self, off_px: float = 2.0) -> Clicks:
        """Click every disc, and wait."""
        self.click(*(self.calibrator.disc_px + off_px))
        return self.judge()


@pytest.fixture
def screen(theme: Theme, show: Show[MarkersScreen]) -> MarkersScreen:
    return show(MarkersScreen(theme, Background()))


@pytest.fixture
def marking(qtbot: QtBot, screen: MarkersScreen) -> Marking:
    return Marking(qtbot, screen)


TILT = CalibrationFinding("tilt", (), 19.0, 15.0, "deg")


def test_whole_way_by_keyboard_alone(qtbot: QtBot, marking: Marking) -> None:
    calibrator, picture = marking.begin(), marking.screen.picture
    marking.press(Qt.Key.Key_Left)
    for pixel in calibrator.disc_px:
        cursor = picture.cursor_px
        assert cursor is not None
        walk(qtbot, picture, pixel)
        np.testing.assert_allclose(picture.cursor_px, cursor + np.round(pixel - cursor))
        marking.press(Qt.Key.Key_Space)
    np.testing.assert_allclose(marking.judge().pixel, calibrator.disc_px)
    assert not marking.screen.guidance.straight_fingers.isVisible(), "a wrist is not asked for its fingers"
    marking.enter()
    assert marking.started
    assert calibrator.begun is not None


def test_markers_pending_result_is_dropped_for_new_frame(
    qtbot: QtBot, screen: MarkersScreen, monkeypatch: pytest.MonkeyPatch
) -> None:
    calibrator, asked, worked_out = FakeCalibrator(is_live=True), threading.Event(), threading.Event()
    calibrator.not_found = ()

    def judge(clicks: Clicks, angles: np.ndarray) -> MeasuredHand:
        asked.set()
        worked_out.wait(60.0)
        return FakeCalibrator().assess(clicks, angles)

    monkeypatch.setattr(calibrator, "assess", judge)
    screen.open_calibrator(calibrator)
    screen.accept()
    qtbot.waitUntil(lambda: screen.labels is not None and bool(screen.labels.proposals))
    screen.primary_button.click()
    qtbot.waitUntil(asked.is_set)
    screen.preview()
    worked_out.set()
    qtbot.waitUntil(lambda: not screen.labelling._background.is_busy)
    assert screen.labelling.stage == "aiming"
    assert calibrator.begun is None


@pytest.mark.parametrize(
    ("finding", "rank", "primary", "second", "missing"),
    [
        (CalibrationFinding("swapped", ("MCP2", "MCP3")), "bad", "Swap the two", "Correct labels", ()),
        (CalibrationFinding("shifted", WRIST6.markers), "bad", "Click the marker again", "", WRIST6.markers),
        (CalibrationFinding("no_depth", ("CMC1",), blocks=True), "bad", "Click the marker again", "", ("CMC1",)),
        (CalibrationFinding("misnamed", ("MCP4",)), "bad", "Correct labels", "Start anyway (&uncertain)", ()),
        (TILT, "good", "Correct labels", "Start anyway (&uncertain)", ()),
    ],
)
def test_markers_problem_offers_its_remedy_and_enter_does_not_start(
    marking: Marking, finding: CalibrationFinding, rank: str, primary: str, second: str, missing: tuple[str, ...]
) -> None:
    calibrator, screen = marking.begin(finding), marking.screen
    marking.judge_all()
    assert screen.guidance.verdict_panel.lines[0][0].state == rank
    assert screen.picture.wrong_labels == finding.markers
    assert screen.primary_button.text() == primary
    assert (screen.second_button.text() if screen.second_button.isVisible() else "") == second
    assert screen.start_anyway_button.isVisible() is (finding.kind == "swapped")
    assert (screen.guidance.step_label.text() == "Cannot start yet") is bool(missing)
    if missing:
        screen.start_anyway_button.click()
    calibrator.findings = () if finding.kind == "swapped" else (finding,)
    marking.enter()
    assert not marking.started
    assert marking.clicking.missing == missing
    if finding.kind == "swapped":
        np.testing.assert_allclose(marking.judge().pixel[2:4], calibrator.disc_px[[3, 2]])
        assert calibrator.begun is None
    elif second:
        assert screen.picture.hasFocus(), "labels can be dragged"
        screen.second_button.click()
        assert marking.started
        assert calibrator.begun is not None


def test_given_start_angle_reaches_calibration_with_its_sign(qtbot: QtBot, marking: Marking) -> None:
    calibrator, screen = marking.begin(), marking.screen
    qtbot.mouseClick(screen.start_angle_button, Qt.MouseButton.LeftButton)
    direction, value = screen.angle_dialog.fields[1]
    direction.buttons()[1].click()
    value.setValue(20)
    screen.angle_dialog.angles_entered.emit(screen.angle_dialog.angles_rad())
    screen.angle_dialog.close_dialog()
    np.testing.assert_allclose(marking.judge_all().pixel, calibrator.disc_px)  # clicked a little beside
    np.testing.assert_allclose(calibrator.angles[-1], [0.0, math.radians(-20.0), 0.0])
    assert "Extension 20°" in screen.start_angle_button.text()


def test_marker_that_was_not_found_is_asked_for(marking: Marking) -> None:
    calibrator = marking.propose(not_found=("TIP1",))
    assert "thumb tip" in marking.screen.guidance.title_label.text()
    marking.press(Qt.Key.Key_Return)
    assert marking.clicking.missing == ("TIP1",)
    marking.click(marking.disc_px("TIP1"))
    np.testing.assert_allclose(marking.judge().pixel, calibrator.disc_px)


def test_enter_never_takes_a_doubtful_name_unseen(marking: Marking) -> None:
    marking.propose(doubtful=("TIP4", "DIP4"))
    screen = marking.screen
    assert screen.primary_button.text() != "Labels are correct"
    for name in ("DIP4", "TIP4"):
        np.testing.assert_allclose(screen.picture.cursor_px, marking.disc_px(name))  # in the loupe
        marking.press(Qt.Key.Key_Return)
        np.testing.assert_allclose(marking.clicking.confirmed_px[name], marking.disc_px(name))
        assert len(marking.clicking.confirmed_px) <= 2
    assert screen.primary_button.text() == "Labels are correct"
    assert not screen.accept_all_button.isVisible()


def test_proposed_name_dropped_on_taken_marker_changes_places_with_it() -> None:
    clicking = LabelState(HAND21, "right")
    places = {name: np.array([20.0 * i, 0.0]) for i, name in enumerate(HAND21.markers)}
    clicking.set_proposals({name: FoundMarker(at, 9.0, True) for name, at in places.items()})
    clicking.current = "TIP3"
    assert clicking.set_label(places["TIP4"], 9.0), "the two change places"
    np.testing.assert_allclose(clicking.confirmed_px["TIP3"], places["TIP4"])
    np.testing.assert_allclose(clicking.proposals["TIP4"].pixel, places["TIP3"])
    clicking.accept_all()
    clicking.current = "TIP2"
    clicking.set_label(places["PIP2"], 9.0)
    np.testing.assert_allclose(clicking.confirmed_px["PIP2"], places["TIP2"])
    assert clicking.is_complete
    clicking = LabelState(HAND21, "right")
    clicking.set_proposals({"WRIST": FoundMarker(places["WRIST"], 9.0, True)})
    assert not clicking.set_label(places["WRIST"], 9.0), "one that was nowhere takes the disc: names are asked for anew"


def test_markers_alternative_blob_is_shown_and_accepted(qtbot: QtBot, marking: Marking) -> None:
    spot = tuple(map(float, FakeCalibrator().disc_px[3] + 25.0))
    calibrator = marking.begin(CalibrationFinding("other_spot", ("MCP3",), spot_px=spot))
    marking.judge_all()
    screen = marking.screen
    assert screen.guidance.step_label.text().startswith("Uncertain")
    assert screen.picture.questioned_blobs == [(spot, "MCP3")]
    assert "Use that spot" in screen.primary_button.text()
    calibrator.findings = ()
    qtbot.keyClick(screen.primary_button, Qt.Key.Key_Return)
    assert tuple(marking.judge().pixel[3]) == spot
    assert screen.picture.questioned_blobs == []


def test_markers_right_labels_lead_to_measuring(qtbot: QtBot, marking: Marking) -> None:
    calibrator = marking.propose("wrist6")
    marking.enter()
    qtbot.waitUntil(lambda: marking.started == [True])
    calibrator.findings = (TILT,)
    marking.screen.open_calibrator(calibrator)
    qtbot.waitUntil(lambda: marking.clicking is not None and bool(marking.clicking.proposals))
    marking.enter()
    marking.judge()
    assert marking.started == [True], "what is doubtful is looked at first"


def test_markers_fingers_are_straight_unless_chosen(qtbot: QtBot, marking: Marking) -> None:
    calibrator, screen = marking.propose(), marking.screen
    straight = screen.guidance.straight_fingers
    assert not straight.isVisible()
    screen.labelling.accept_all()
    assert marking.judge().straight_fingers == (True,) * 5
    assert straight.isVisible()
    qtbot.mouseClick(straight.buttons[3], Qt.MouseButton.LeftButton)
    assert marking.judge().straight_fingers == (True, True, True, False, True)
    screen.activateWindow()
    qtbot.keyClick(screen.focusWidget(), Qt.Key.Key_5)
    qtbot.keyClick(screen.focusWidget(), Qt.Key.Key_4)
    qtbot.waitUntil(lambda: calibrator.judged[-1].straight_fingers == (True, True, True, True, False))
    marking.judge()
    marking.enter()
    assert marking.started


def test_markers_undo_reverses_any_order() -> None:
    clicking = LabelState(WRIST6, "right")
    for name in ("MCP4", "WRIST", "MCP2"):
        clicking.current = name
        clicking.set_label(np.zeros(2), 9.0)
    assert [clicking.undo() for _ in range(4)] == ["MCP2", "WRIST", "MCP4", ""]


def test_markers_labels_are_placed_undone_and_dragged(marking: Marking) -> None:
    discs_px = marking.begin().disc_px
    marking.click(*discs_px[:3])
    assert marking.clicking.current == WRIST6.markers[3]
    marking.press(Qt.Key.Key_Backspace)
    assert (marking.clicking.current, set(marking.clicking.confirmed_px)) == (
        WRIST6.markers[2],
        set(WRIST6.markers[:2]),
    )
    assert "index MCP" in marking.screen.guidance.title_label.text(), "it is asked for again"
    for _ in range(2):
        marking.press(Qt.Key.Key_Backspace)
    assert marking.clicking.current == "WRIST"
    marking.press(Qt.Key.Key_Tab)
    marking.click(discs_px[1])
    assert list(marking.clicking.confirmed_px) == ["CMC1"], "Tab chooses which is clicked next"
    assert marking.clicking.missing[0] == "WRIST"
    marking.press(Qt.Key.Key_Backspace)
    marking.clicking.current = "WRIST"
    marking.click(discs_px[1])
    np.testing.assert_allclose(marking.clicking.confirmed_px["WRIST"], discs_px[1])
    marking.drag(discs_px[1], discs_px[0])
    np.testing.assert_allclose(marking.clicking.confirmed_px["WRIST"], discs_px[0])
    marking.screen.picture.set_cursor(discs_px[0])
    for _ in range(3):
        marking.press(Qt.Key.Key_Space)
        assert (set(marking.clicking.confirmed_px), marking.clicking.current) == ({"WRIST"}, "CMC1")
        assert marking.screen.picture.no_marker_words == "Already the wrist"


def test_markers_label_dragged_by_its_text_moves(qtbot: QtBot, marking: Marking) -> None:
    discs_px, picture = marking.begin().disc_px, marking.screen.picture
    marking.click(*discs_px[:3])
    picture.grab()
    name, free = WRIST6.markers[1], discs_px[4]
    on_label = picture._label_boxes[name].center().toPoint()
    qtbot.mouseClick(picture, Qt.MouseButton.LeftButton, pos=on_label)
    np.testing.assert_allclose(marking.clicking.confirmed_px[name], discs_px[1])
    assert marking.clicking.current == name, "a click on a label only selects its marker"
    qtbot.mousePress(picture, Qt.MouseButton.LeftButton, pos=on_label)
    qtbot.mouseMove(picture, marking.at(free))
    picture.set_cursor(free)  # offscreen, a moved mouse may say nothing
    with painted_texts(marking.screen) as painted:
        picture.grab()
    assert "Thumb CMC?" in [one.text for one in painted]
    qtbot.mouseRelease(picture, Qt.MouseButton.LeftButton, pos=marking.at(free))
    np.testing.assert_allclose(marking.clicking.confirmed_px[name], free)


def test_markers_of_the_last_source_are_not_judged_on_the_next(qtbot: QtBot, marking: Marking) -> None:
    marking.begin()
    marking.judge_all()
    marking.screen.close_calibrator()
    following = marking.begin()
    assert marking.clicking is None or not marking.clicking.confirmed_px
    qtbot.wait(50)
    assert not following.judged


def test_markers_click_beside_all_blobs_is_reported(qtbot: QtBot, marking: Marking) -> None:
    marking.begin()
    screen = marking.screen
    qtbot.mouseClick(screen.picture, Qt.MouseButton.LeftButton, pos=QPoint(30, 30))
    assert not screen.labels.confirmed_px
    assert "No blue marker" in screen.picture.no_marker_words
    with painted_texts(screen) as painted:
        screen.grab()
    shift, loupe = screen.picture.mapTo(screen, QPoint()), screen.picture.loupe_box()
    told = [one for one in painted if one.text in screen.picture.no_marker_words]
    assert " ".join(one.text for one in told) == screen.picture.no_marker_words
    assert all(loupe.translated(shift).contains(one.box) for one in told), "within the loupe"


def test_markers_enter_retakes_a_bad_live_frame(marking: Marking) -> None:
    calibrator, screen = marking.begin(TILT, is_live=True), marking.screen
    marking.press(Qt.Key.Key_Space)
    marking.judge_all()
    assert screen.primary_button.text() == "New image"
    assert screen.click_again_button.isVisible()
    marking.enter()
    assert screen.labels is None
    calibrator.findings = (TILT, CalibrationFinding("misnamed", ("MCP4",)))
    marking.press(Qt.Key.Key_Space)
    marking.judge_all()
    assert screen.primary_button.text() == "Correct labels", "wrong labels come before a bad image"
