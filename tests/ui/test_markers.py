"""The calibration screen by mouse and by keyboard, and what its verdict lets a person do."""

from __future__ import annotations

import math
import threading

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from pytestqt.qtbot import QtBot

from carpus.core.calibration.result import CalibrationFinding, Clicks
from carpus.core.hand.protocols import HAND21, WRIST6
from carpus.ui.background import Background
from carpus.ui.keys import Keys
from carpus.ui.language import speaking
from carpus.ui.markers.clicking import Clicking
from carpus.ui.markers.screen import MarkersScreen
from carpus.ui.ports import Judged, ProposedMarker
from carpus.ui.theme import Theme
from tests.ui.fakes import FakeCalibrator
from tests.ui.geometry import painted_texts


@pytest.fixture
def screen(qtbot: QtBot, theme: Theme) -> MarkersScreen:
    screen = MarkersScreen(theme, Keys(), Background())
    qtbot.addWidget(screen)
    screen.resize(1280, 720)
    screen.show()
    return screen


def place_of(screen: MarkersScreen, pixel: np.ndarray) -> QPoint:
    return screen.picture.to_screen(*map(float, pixel)).toPoint()


def click_all(qtbot: QtBot, screen: MarkersScreen, calibrator: FakeCalibrator, off_px: float = 2.0) -> None:
    for pixel in calibrator.disc_px:
        spot = place_of(screen, pixel + off_px)
        qtbot.mouseMove(screen.picture, spot)
        qtbot.mouseClick(screen.picture, Qt.MouseButton.LeftButton, pos=spot)


def wait_for_verdict(qtbot: QtBot, screen: MarkersScreen) -> None:
    qtbot.waitUntil(lambda: screen.clicking is not None and screen.clicking.complete and screen.primary.isEnabled())


def test_clicks_snap_to_the_discs_in_the_order_of_the_protocol(qtbot: QtBot, screen: MarkersScreen) -> None:
    calibrator = FakeCalibrator()
    screen.begin(calibrator)
    click_all(qtbot, screen, calibrator)
    wait_for_verdict(qtbot, screen)
    np.testing.assert_allclose(calibrator.judged[-1].pixel, calibrator.disc_px)
    assert calibrator.judged[-1].protocol.markers == WRIST6.markers
    with qtbot.waitSignal(screen.naming.started):
        qtbot.keyClick(screen.focusWidget(), Qt.Key.Key_Return)
    assert calibrator.begun is not None


def test_the_whole_way_by_keyboard_alone(qtbot: QtBot, screen: MarkersScreen) -> None:
    calibrator = FakeCalibrator()
    screen.begin(calibrator)
    qtbot.keyClick(screen.picture, Qt.Key.Key_Left)
    for pixel in calibrator.disc_px:
        cursor = screen.picture.cursor_px
        assert cursor is not None
        steps = np.round(pixel - cursor).astype(int)
        for axis, (less, more) in enumerate(((Qt.Key.Key_Left, Qt.Key.Key_Right), (Qt.Key.Key_Up, Qt.Key.Key_Down))):
            tens, ones = divmod(abs(int(steps[axis])), 10)
            key = more if steps[axis] > 0 else less
            for _ in range(tens):
                qtbot.keyClick(screen.picture, key, Qt.KeyboardModifier.ShiftModifier)
            for _ in range(ones):
                qtbot.keyClick(screen.picture, key)
        np.testing.assert_allclose(screen.picture.cursor_px, cursor + steps)
        qtbot.keyClick(screen.picture, Qt.Key.Key_Space)
    wait_for_verdict(qtbot, screen)
    np.testing.assert_allclose(calibrator.judged[-1].pixel, calibrator.disc_px)
    with qtbot.waitSignal(screen.naming.started):
        qtbot.keyClick(screen.focusWidget(), Qt.Key.Key_Return)


def test_a_disc_that_has_a_name_is_refused_at_once(qtbot: QtBot, screen: MarkersScreen) -> None:
    calibrator = FakeCalibrator()
    screen.begin(calibrator)
    spot = place_of(screen, calibrator.disc_px[0])
    qtbot.mouseMove(screen.picture, spot)
    qtbot.mouseClick(screen.picture, Qt.MouseButton.LeftButton, pos=spot)
    for _ in range(3):
        qtbot.keyClick(screen.picture, Qt.Key.Key_Space)
        assert screen.clicking is not None
        assert set(screen.clicking.pixel) == {"WRIST"}
        assert screen.clicking.current == "CMC1"
        assert screen.picture.no_marker_words == "Already the wrist"


def test_the_cursor_of_the_last_picture_is_forgotten(qtbot: QtBot, screen: MarkersScreen) -> None:
    calibrator = FakeCalibrator()
    screen.begin(calibrator)
    qtbot.mouseMove(screen.picture, place_of(screen, calibrator.disc_px[0]))
    qtbot.keyClick(screen.picture, Qt.Key.Key_Right)
    assert screen.picture.cursor_px is not None
    screen.begin(FakeCalibrator())
    assert screen.picture.cursor_px is None
    qtbot.keyClick(screen.picture, Qt.Key.Key_Space)
    assert screen.clicking is not None
    assert not screen.clicking.pixel


def test_markers_of_the_last_source_are_not_judged_on_the_next(qtbot: QtBot, screen: MarkersScreen) -> None:
    calibrator = FakeCalibrator()
    screen.begin(calibrator)
    click_all(qtbot, screen, calibrator)
    wait_for_verdict(qtbot, screen)
    screen.end()
    following = FakeCalibrator()
    screen.begin(following)
    assert screen.clicking is None or not screen.clicking.pixel
    qtbot.wait(50)
    assert not following.judged


def test_what_is_still_worked_out_of_one_picture_measures_no_other(
    qtbot: QtBot, screen: MarkersScreen, monkeypatch: pytest.MonkeyPatch
) -> None:
    calibrator, asked, worked_out = FakeCalibrator(is_live=True), threading.Event(), threading.Event()
    calibrator.not_found = ()

    def judge(clicks: Clicks, angles: np.ndarray) -> Judged:
        asked.set()
        worked_out.wait(60.0)
        return FakeCalibrator().judge(clicks, angles)

    monkeypatch.setattr(calibrator, "judge", judge)
    screen.begin(calibrator)
    screen.accept()
    qtbot.waitUntil(lambda: screen.clicking is not None and bool(screen.clicking.proposed))
    screen.primary.click()
    qtbot.waitUntil(asked.is_set)
    screen.preview()
    worked_out.set()
    qtbot.waitUntil(lambda: not screen.naming._background.busy)
    assert screen.naming.work == "aiming"
    assert calibrator.begun is None


def test_a_click_beside_every_disc_sets_nothing_and_says_so(qtbot: QtBot, screen: MarkersScreen) -> None:
    screen.begin(FakeCalibrator())
    qtbot.mouseClick(screen.picture, Qt.MouseButton.LeftButton, pos=QPoint(30, 30))
    assert screen.clicking is not None
    assert not screen.clicking.pixel
    assert "No blue marker" in screen.picture.no_marker_words
    with painted_texts(screen) as painted:
        screen.grab()
    shift, loupe = screen.picture.mapTo(screen, QPoint()), screen.picture.loupe_box()
    told = [one for one in painted if one.text in screen.picture.no_marker_words]
    assert " ".join(one.text for one in told) == screen.picture.no_marker_words
    assert all(loupe.translated(shift).contains(one.box) for one in told), "within the loupe"


def test_backspace_takes_back_one_marker_and_asks_for_it_again(qtbot: QtBot, screen: MarkersScreen) -> None:
    calibrator = FakeCalibrator()
    screen.begin(calibrator)
    for pixel in calibrator.disc_px[:3]:
        qtbot.mouseClick(screen.picture, Qt.MouseButton.LeftButton, pos=place_of(screen, pixel))
    assert screen.clicking is not None
    assert screen.clicking.current == WRIST6.markers[3]
    qtbot.keyClick(screen.picture, Qt.Key.Key_Backspace)
    assert screen.clicking.current == WRIST6.markers[2]
    assert set(screen.clicking.pixel) == set(WRIST6.markers[:2])
    assert "index knuckle" in screen.guidance.title.text()


def test_tab_chooses_which_marker_is_clicked_next(qtbot: QtBot, screen: MarkersScreen) -> None:
    calibrator = FakeCalibrator()
    screen.begin(calibrator)
    qtbot.keyClick(screen.picture, Qt.Key.Key_Tab)
    qtbot.mouseClick(screen.picture, Qt.MouseButton.LeftButton, pos=place_of(screen, calibrator.disc_px[1]))
    assert screen.clicking is not None
    assert list(screen.clicking.pixel) == ["CMC1"]
    assert screen.clicking.missing[0] == "WRIST"


def test_a_marker_can_be_dragged_to_another_disc(qtbot: QtBot, screen: MarkersScreen) -> None:
    calibrator = FakeCalibrator()
    screen.begin(calibrator)
    qtbot.mouseClick(screen.picture, Qt.MouseButton.LeftButton, pos=place_of(screen, calibrator.disc_px[1]))
    assert screen.clicking is not None
    np.testing.assert_allclose(screen.clicking.pixel["WRIST"], calibrator.disc_px[1])
    qtbot.mousePress(screen.picture, Qt.MouseButton.LeftButton, pos=place_of(screen, calibrator.disc_px[1]))
    qtbot.mouseRelease(screen.picture, Qt.MouseButton.LeftButton, pos=place_of(screen, calibrator.disc_px[0]))
    np.testing.assert_allclose(screen.clicking.pixel["WRIST"], calibrator.disc_px[0])


def test_swapped_markers_are_exchanged_by_enter_and_judged_again(qtbot: QtBot, screen: MarkersScreen) -> None:
    calibrator = FakeCalibrator()
    calibrator.findings = (CalibrationFinding("swapped", ("MCP2", "MCP3")),)
    screen.begin(calibrator)
    click_all(qtbot, screen, calibrator)
    wait_for_verdict(qtbot, screen)
    assert screen.guidance.panel.states()[0] == "bad"
    assert screen.picture.wrong == {"MCP2", "MCP3"}
    calibrator.findings = ()
    qtbot.keyClick(screen.focusWidget(), Qt.Key.Key_Return)
    wait_for_verdict(qtbot, screen)
    np.testing.assert_allclose(calibrator.judged[-1].pixel[2:4], calibrator.disc_px[[3, 2]])
    assert calibrator.begun is None


def test_shifted_names_are_clicked_again_and_nothing_starts_from_them(qtbot: QtBot, screen: MarkersScreen) -> None:
    calibrator = FakeCalibrator()
    names = calibrator.protocol.markers
    calibrator.findings = (CalibrationFinding("shifted", names),)
    screen.begin(calibrator)
    click_all(qtbot, screen, calibrator)
    wait_for_verdict(qtbot, screen)
    assert screen.guidance.panel.states()[0] == "bad"
    assert screen.guidance.step.text() == "Cannot start yet"
    assert not screen.second.isVisible()
    started: list[bool] = []
    screen.naming.started.connect(lambda: started.append(True))
    screen.start_doubtful()
    qtbot.keyClick(screen.focusWidget(), Qt.Key.Key_Return)
    assert not started
    assert screen.clicking is not None
    assert screen.clicking.missing == names


def test_a_doubtful_calibration_starts_only_by_its_own_button(qtbot: QtBot, screen: MarkersScreen) -> None:
    calibrator = FakeCalibrator()
    calibrator.findings = (CalibrationFinding("tilt", (), 19.0, 15.0, "deg"),)
    screen.begin(calibrator)
    click_all(qtbot, screen, calibrator)
    wait_for_verdict(qtbot, screen)
    assert screen.second.isVisible()
    started: list[bool] = []
    screen.naming.started.connect(lambda: started.append(True))
    for _ in range(3):
        qtbot.keyClick(screen.focusWidget(), Qt.Key.Key_Return)
    assert not started
    assert screen.clicking is not None
    assert screen.clicking.complete, "Enter wipes no name"
    qtbot.mouseClick(screen.second, Qt.MouseButton.LeftButton)
    assert started
    assert calibrator.begun is not None


def test_what_blocks_cannot_be_started_at_all(qtbot: QtBot, screen: MarkersScreen) -> None:
    calibrator = FakeCalibrator()
    calibrator.findings = (CalibrationFinding("no_depth", ("CMC1",), blocks=True),)
    screen.begin(calibrator)
    click_all(qtbot, screen, calibrator)
    wait_for_verdict(qtbot, screen)
    assert not screen.second.isVisible()
    qtbot.mouseClick(screen.primary, Qt.MouseButton.LeftButton)
    assert calibrator.begun is None
    assert screen.clicking is not None
    assert screen.clicking.missing == ("CMC1",)


def test_a_given_start_angle_reaches_the_calibration_with_its_sign(qtbot: QtBot, screen: MarkersScreen) -> None:
    calibrator = FakeCalibrator()
    screen.begin(calibrator)
    qtbot.mouseClick(screen.start_angle, Qt.MouseButton.LeftButton)
    direction, value = screen.angle_sheet.fields[1]
    direction.buttons()[1].click()
    value.setValue(20)
    screen.angle_sheet.kept.emit(screen.angle_sheet.angles_rad())
    screen.angle_sheet.close_sheet()
    click_all(qtbot, screen, calibrator)
    wait_for_verdict(qtbot, screen)
    np.testing.assert_allclose(calibrator.angles[-1], [0.0, math.radians(-20.0), 0.0])
    assert "Extension 20°" in screen.start_angle.text()


def test_a_live_camera_shows_pictures_until_one_is_taken(qtbot: QtBot, screen: MarkersScreen) -> None:
    calibrator = FakeCalibrator(is_live=True)
    screen.begin(calibrator)
    assert screen.clicking is None
    qtbot.keyClick(screen.picture, Qt.Key.Key_Space)
    assert screen.clicking is not None
    qtbot.mouseClick(screen.new_picture, Qt.MouseButton.LeftButton)
    assert screen.clicking is None


def test_undo_walks_back_through_any_order() -> None:
    clicking = Clicking(WRIST6, "right")
    for name in ("MCP4", "WRIST", "MCP2"):
        clicking.current = name
        clicking.place(np.zeros(2), 9.0)
    assert [clicking.undo() for _ in range(4)] == ["MCP2", "WRIST", "MCP4", ""]


# --- names proposed by the program ------------------------------------------------------------------------
def proposed(
    qtbot: QtBot, screen: MarkersScreen, *, doubtful: tuple[str, ...] = (), not_found: tuple[str, ...] = ()
) -> FakeCalibrator:
    calibrator = FakeCalibrator("fist", protocol="hand21")
    calibrator.doubtful, calibrator.not_found = doubtful, not_found
    screen.begin(calibrator)
    qtbot.waitUntil(lambda: screen.clicking is not None and bool(screen.clicking.proposed))
    return calibrator


def drag(qtbot: QtBot, screen: MarkersScreen, start: np.ndarray, end: np.ndarray) -> None:
    qtbot.mousePress(screen.picture, Qt.MouseButton.LeftButton, pos=place_of(screen, start))
    qtbot.mouseRelease(screen.picture, Qt.MouseButton.LeftButton, pos=place_of(screen, end))


def test_enter_takes_all_proposed_names_and_enter_starts(qtbot: QtBot, screen: MarkersScreen) -> None:
    calibrator = proposed(qtbot, screen)
    assert not calibrator.judged
    qtbot.keyClick(screen.picture, Qt.Key.Key_Return)
    wait_for_verdict(qtbot, screen)
    np.testing.assert_allclose(calibrator.judged[-1].pixel, calibrator.disc_px)
    with qtbot.waitSignal(screen.naming.started):
        qtbot.keyClick(screen.focusWidget(), Qt.Key.Key_Return)


def test_doubtful_names_are_said_in_words_and_one_click_settles_each(qtbot: QtBot, screen: MarkersScreen) -> None:
    calibrator = proposed(qtbot, screen, doubtful=("TIP4", "DIP4"))
    assert screen.clicking is not None
    assert "Ring finger end joint, ring tip" in screen.guidance.place.text()
    markers = screen.clicking.order
    for name in ("DIP4", "TIP4"):
        spot = place_of(screen, calibrator.disc_px[markers.index(name)])
        qtbot.mouseClick(screen.picture, Qt.MouseButton.LeftButton, pos=spot)
    assert set(screen.clicking.pixel) == {"DIP4", "TIP4"}
    assert not screen.clicking.doubtful


def test_a_wrong_proposal_is_dragged_to_its_disc_and_names_change_places(qtbot: QtBot, screen: MarkersScreen) -> None:
    calibrator = proposed(qtbot, screen)
    assert screen.clicking is not None
    markers = screen.clicking.order
    tip, other = (calibrator.disc_px[markers.index(name)] for name in ("TIP2", "TIP3"))
    drag(qtbot, screen, tip, other)
    np.testing.assert_allclose(screen.clicking.pixel["TIP2"], other)
    screen.clicking.current = "TIP3"
    screen.clicking.place(tip, 10.0)
    assert {"TIP2", "TIP3"} <= set(screen.clicking.pixel)
    screen.clicking.current = "TIP2"
    screen.clicking.place(tip, 10.0)  # onto a disc that has a name: the two change places
    np.testing.assert_allclose(screen.clicking.pixel["TIP3"], other)


def test_a_marker_that_was_not_found_is_asked_for(qtbot: QtBot, screen: MarkersScreen) -> None:
    calibrator = proposed(qtbot, screen, not_found=("TIP1",))
    assert screen.clicking is not None
    assert "thumb tip" in screen.guidance.title.text()
    qtbot.keyClick(screen.picture, Qt.Key.Key_Return)
    assert screen.clicking.missing == ("TIP1",)
    spot = place_of(screen, calibrator.disc_px[screen.clicking.order.index("TIP1")])
    qtbot.mouseClick(screen.picture, Qt.MouseButton.LeftButton, pos=spot)
    wait_for_verdict(qtbot, screen)
    np.testing.assert_allclose(calibrator.judged[-1].pixel, calibrator.disc_px)


def test_six_discs_are_proposed_as_twenty_one_are_and_one_enter_takes_them(qtbot: QtBot, screen: MarkersScreen) -> None:
    calibrator = FakeCalibrator()
    calibrator.not_found = ()
    screen.begin(calibrator)
    qtbot.waitUntil(lambda: screen.clicking is not None and len(screen.clicking.proposed) == 6)
    assert screen.primary.text() == "Names are right"
    assert screen.primary.shown_key == "Enter"
    qtbot.keyClick(screen.picture, Qt.Key.Key_Return)
    wait_for_verdict(qtbot, screen)
    np.testing.assert_allclose(calibrator.judged[-1].pixel, calibrator.disc_px)
    assert screen.primary.text() == "Start measuring"


@pytest.mark.parametrize("scale", [1.0, 1.5])
@pytest.mark.parametrize("named", [0, 1, 3, 6])
def test_no_name_covers_a_disc_that_is_to_be_clicked(
    qtbot: QtBot, screen: MarkersScreen, theme: Theme, named: int, scale: float
) -> None:
    theme.choose(text_scale=scale)
    calibrator = FakeCalibrator()
    screen.begin(calibrator)
    picture = screen.picture
    qtbot.waitUntil(lambda: picture.width() > 400)
    discs = [picture.to_screen(*map(float, pixel)) for pixel in calibrator.disc_px]
    assert screen.clicking is not None
    rings = []
    for name, pixel, at in zip(calibrator.protocol.markers[:named], calibrator.disc_px, discs, strict=False):
        screen.clicking.pixel[name], screen.clicking.widths_px[name] = pixel, 10.0
        rings.append((name, at, 13.0))
    plates = picture.name_plates(rings, "")
    assert [one.name for one in plates] == list(calibrator.protocol.markers[:named]), "every name has its place"
    for one in plates:
        assert not any(one.plate.adjusted(-8, -8, 8, 8).contains(at) for at in discs), one.name
        assert not any(one.plate.intersects(other.plate) for other in plates if other is not one)


def test_where_the_names_are_long_a_knuckle_has_its_fingers_name(
    qtbot: QtBot, screen: MarkersScreen, theme: Theme
) -> None:
    theme.choose(text_scale=1.5)
    calibrator = FakeCalibrator()
    screen.begin(calibrator)
    picture = screen.picture
    qtbot.waitUntil(lambda: picture.width() > 400, timeout=60_000)
    picture.resize(560, 452)
    picture.discs_px = np.empty((0, 2))
    # the hand as the simulated camera shows it enlarged, from wrist and thumb to the little finger
    at = [(280, 361), (242, 335), (225, 189), (271, 185), (311, 193), (341, 211)]
    rings = [(name, QPointF(*one), 17.0) for name, one in zip(calibrator.protocol.markers, at, strict=True)]
    with speaking("de"):
        plates = picture.name_plates(rings, "")
    assert [one.name for one in plates] == list(calibrator.protocol.markers), "every name has its place"
    assert plates[-1].words == "Kleinfinger"


def test_all_markers_can_still_be_clicked_by_hand(qtbot: QtBot, screen: MarkersScreen) -> None:
    calibrator = proposed(qtbot, screen)
    qtbot.mouseClick(screen.second, Qt.MouseButton.LeftButton)
    assert screen.clicking is not None
    assert not screen.clicking.proposed
    click_all(qtbot, screen, calibrator, off_px=1.0)
    wait_for_verdict(qtbot, screen)
    np.testing.assert_allclose(calibrator.judged[-1].pixel, calibrator.disc_px)


def test_a_bad_picture_is_taken_again_by_enter_and_wrong_names_are_not(qtbot: QtBot, screen: MarkersScreen) -> None:
    calibrator = FakeCalibrator(is_live=True)
    calibrator.findings = (CalibrationFinding("tilt", (), 19.0, 15.0, "deg"),)
    screen.begin(calibrator)
    qtbot.keyClick(screen.picture, Qt.Key.Key_Space)
    click_all(qtbot, screen, calibrator)
    wait_for_verdict(qtbot, screen)
    assert screen.primary.text() == "New picture"
    assert screen.click_all.isVisible()
    qtbot.keyClick(screen.focusWidget(), Qt.Key.Key_Return)
    assert screen.clicking is None
    calibrator.findings = (CalibrationFinding("misnamed", ("MCP4",)),)
    qtbot.keyClick(screen.picture, Qt.Key.Key_Space)
    click_all(qtbot, screen, calibrator)
    wait_for_verdict(qtbot, screen)
    assert screen.primary.text() == "Correct names"
    assert screen.picture.wrong == {"MCP4"}
    qtbot.keyClick(screen.focusWidget(), Qt.Key.Key_Return)
    assert screen.picture.hasFocus()
    assert screen.clicking is not None
    assert screen.clicking.complete


def test_two_fingers_named_for_each_other_change_places_by_one_key(qtbot: QtBot, screen: MarkersScreen) -> None:
    fingers = [tuple(f"{joint}{k}" for joint in ("MCP", "PIP", "DIP", "TIP")) for k in (3, 4)]
    calibrator = proposed(qtbot, screen)
    calibrator.findings = (CalibrationFinding("swapped", (*fingers[0], *fingers[1])),)
    qtbot.keyClick(screen.picture, Qt.Key.Key_Return)
    wait_for_verdict(qtbot, screen)
    calibrator.findings = ()
    qtbot.keyClick(screen.focusWidget(), Qt.Key.Key_S)
    wait_for_verdict(qtbot, screen)
    rows = [screen.clicking.order.index(name) for finger in fingers for name in finger]  # type: ignore[union-attr]
    np.testing.assert_allclose(calibrator.judged[-1].pixel[rows], calibrator.disc_px[[*rows[4:], *rows[:4]]])


def test_enter_never_takes_a_doubtful_name_unseen(qtbot: QtBot, screen: MarkersScreen) -> None:
    calibrator = proposed(qtbot, screen, doubtful=("TIP4", "DIP4"))
    assert screen.clicking is not None
    assert screen.primary.text() != "Names are right"
    for name in ("DIP4", "TIP4"):
        at = calibrator.disc_px[screen.clicking.order.index(name)]
        np.testing.assert_allclose(screen.picture.cursor_px, at)  # in the loupe
        qtbot.keyClick(screen.picture, Qt.Key.Key_Return)
        np.testing.assert_allclose(screen.clicking.pixel[name], at)
        assert len(screen.clicking.pixel) <= 2
    assert screen.primary.text() == "Names are right"
    assert not screen.take_rest.isVisible()


def test_a_proposed_name_dropped_on_a_taken_disc_changes_places_with_it() -> None:
    clicking = Clicking(HAND21, "right")
    places = {name: np.array([20.0 * i, 0.0]) for i, name in enumerate(HAND21.markers)}
    clicking.propose({name: ProposedMarker(at, 9.0, True) for name, at in places.items()})
    clicking.current = "TIP3"
    clicking.place(places["TIP4"], 9.0)
    np.testing.assert_allclose(clicking.pixel["TIP3"], places["TIP4"])
    np.testing.assert_allclose(clicking.proposed["TIP4"].pixel, places["TIP3"])
    clicking.take_all()
    clicking.current = "TIP2"
    clicking.place(places["PIP2"], 9.0)
    np.testing.assert_allclose(clicking.pixel["PIP2"], places["TIP2"])
    assert clicking.complete


def test_what_is_proposed_is_not_said_to_be_done(qtbot: QtBot, screen: MarkersScreen) -> None:
    proposed(qtbot, screen)
    assert "21 of 21 found" in [cells[2].text() for cells in screen.guidance.panel._lines]
    assert screen.guidance.panel.states()[0] == "open"


def test_the_loupe_keeps_off_the_discs(qtbot: QtBot, screen: MarkersScreen) -> None:
    calibrator = proposed(qtbot, screen)
    assert screen.clicking is not None
    for pixel in calibrator.disc_px:
        screen.picture.set_cursor(pixel)
        at = screen.picture.to_screen(*map(float, pixel))
        assert not screen.picture.loupe_box().adjusted(-30, -20, 30, 20).contains(at)


def test_another_spot_that_may_be_the_disc_is_shown_and_enter_takes_it(qtbot: QtBot, screen: MarkersScreen) -> None:
    calibrator = FakeCalibrator()
    spot = tuple(map(float, calibrator.disc_px[3] + 25.0))
    calibrator.findings = (CalibrationFinding("other_spot", ("MCP3",), spot_px=spot),)
    screen.begin(calibrator)
    click_all(qtbot, screen, calibrator)
    wait_for_verdict(qtbot, screen)
    assert screen.guidance.step.text().startswith("Doubtful")
    assert screen.picture.spots == [(spot, "MCP3")]
    assert "Take that spot" in screen.primary.text()
    calibrator.findings = ()
    qtbot.keyClick(screen.primary, Qt.Key.Key_Return)
    wait_for_verdict(qtbot, screen)
    assert tuple(calibrator.judged[-1].pixel[3]) == spot
    assert screen.picture.spots == []


def test_a_picture_without_discs_says_so(screen: MarkersScreen, monkeypatch: pytest.MonkeyPatch) -> None:
    calibrator = FakeCalibrator()
    monkeypatch.setattr(calibrator, "discs_seen", lambda: 0)
    screen.begin(calibrator)
    assert "No blue disc" in screen.guidance.title.text()
    monkeypatch.setattr(calibrator, "discs_seen", lambda: 6)
    screen.hold()
    assert "No blue disc" not in screen.guidance.title.text()


def test_names_that_are_right_lead_straight_to_measuring_where_all_is_good(qtbot: QtBot, screen: MarkersScreen) -> None:
    calibrator = FakeCalibrator()
    calibrator.not_found = ()
    screen.begin(calibrator)
    qtbot.waitUntil(lambda: screen.clicking is not None and bool(screen.clicking.proposed), timeout=60_000)
    with qtbot.waitSignal(screen.naming.started, timeout=60_000):
        qtbot.keyClick(screen.focusWidget(), Qt.Key.Key_Return)
    calibrator.findings = (CalibrationFinding("tilt", (), 19.0, 15.0, "deg"),)
    started: list[bool] = []
    screen.naming.started.connect(lambda: started.append(True))
    screen.begin(calibrator)
    qtbot.waitUntil(lambda: screen.clicking is not None and bool(screen.clicking.proposed), timeout=60_000)
    qtbot.keyClick(screen.focusWidget(), Qt.Key.Key_Return)
    wait_for_verdict(qtbot, screen)
    assert not started, "what is doubtful is looked at first"


def test_fingers_lie_straight_until_one_is_said_not_to(qtbot: QtBot, screen: MarkersScreen) -> None:
    calibrator = FakeCalibrator("fist", protocol="hand21")
    screen.begin(calibrator)
    qtbot.waitUntil(lambda: screen.clicking is not None and bool(screen.clicking.proposed))
    assert not screen.guidance.straight.isVisible()
    screen.naming.take_all()
    wait_for_verdict(qtbot, screen)
    assert screen.guidance.straight.isVisible()
    assert calibrator.judged[-1].straight_fingers == (True,) * 5
    qtbot.mouseClick(screen.guidance.straight.buttons[3], Qt.MouseButton.LeftButton)
    wait_for_verdict(qtbot, screen)
    assert calibrator.judged[-1].straight_fingers == (True, True, True, False, True)
    screen.activateWindow()
    qtbot.keyClick(screen.focusWidget(), Qt.Key.Key_5)
    qtbot.keyClick(screen.focusWidget(), Qt.Key.Key_4)
    qtbot.waitUntil(lambda: calibrator.judged[-1].straight_fingers == (True, True, True, True, False))
    wait_for_verdict(qtbot, screen)
    with qtbot.waitSignal(screen.naming.started):
        qtbot.keyClick(screen.focusWidget(), Qt.Key.Key_Return)


def test_a_wrist_is_not_asked_for_its_fingers(qtbot: QtBot, screen: MarkersScreen) -> None:
    calibrator = FakeCalibrator()
    screen.begin(calibrator)
    click_all(qtbot, screen, calibrator)
    wait_for_verdict(qtbot, screen)
    assert not screen.guidance.straight.isVisible()


def test_only_what_a_person_named_is_missed(qtbot: QtBot, screen: MarkersScreen) -> None:
    calibrator = FakeCalibrator()
    calibrator.not_found = ()
    screen.begin(calibrator)
    qtbot.waitUntil(lambda: screen.clicking is not None and len(screen.clicking.proposed) == 6)
    assert not screen.has_names, "proposals come back by themselves"
    qtbot.keyClick(screen.picture, Qt.Key.Key_Return)
    assert screen.has_names
