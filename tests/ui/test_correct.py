"""Markers put right by mouse and by keys: what the screen hands on is what the person did."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot

from carpus.core.records.corrections import ResultDifference
from carpus.ui.kit.background import Background
from carpus.ui.kit.theme import Theme
from carpus.ui.screens.correct.flow import difference_words
from carpus.ui.screens.correct.frame_view import MarkerEdits
from carpus.ui.screens.correct.screen import CorrectionScreen
from tests.ui.conftest import Show
from tests.ui.fakes import FakeCorrections, FakeSessions, session

ROW = 620


@pytest.fixture(scope="module")
def sessions() -> FakeSessions:
    return FakeSessions()


@pytest.fixture
def screen(
    qtbot: QtBot, theme: Theme, show: Show[CorrectionScreen], sessions: FakeSessions, background: Background
) -> CorrectionScreen:
    shown = show(CorrectionScreen(theme, background, FakeCorrections(sessions, pictures=False)))
    shown.show_session("session-7", sessions.session("session-7"), ROW)
    qtbot.waitUntil(lambda: not background.is_busy and shown.frame_view.image is not None)
    return shown


def drag(qtbot: QtBot, screen: CorrectionScreen, *way_px: np.ndarray) -> None:
    left, picture = Qt.MouseButton.LeftButton, screen.frame_view
    start, end = (picture.to_screen(*map(float, pixel)).toPoint() for pixel in way_px)
    qtbot.mousePress(picture, left, pos=start)
    qtbot.mouseMove(picture, end)
    qtbot.mouseRelease(picture, left, pos=end)


def test_correction_label_dragged_near_a_blob_snaps_to_its_centre(qtbot: QtBot, screen: CorrectionScreen) -> None:
    assert not screen.primary_button.isEnabled()
    drag(qtbot, screen, screen.edits.original_px(ROW)[3], np.array([423.0, 118.0]))
    (one,) = screen.edits.corrections()
    assert (one.row, one.places["MCP3"]) == (ROW, (420.0, 120.0))
    screen.undo()
    screen.select_marker("MCP3")
    screen.hide_current()
    with qtbot.waitSignal(screen.reanalysis_requested) as asked:
        qtbot.keyClick(screen, Qt.Key.Key_Return)
    assert asked.args == ["session-7", screen.edits.corrections()]


def test_correction_keys_do_the_same_as_the_mouse(qtbot: QtBot, screen: CorrectionScreen) -> None:
    before = screen.edits.original_px(ROW).copy()
    screen.rows["MCP4"].click()
    qtbot.keyClick(screen.rows["MCP4"], Qt.Key.Key_Right)
    qtbot.keyClick(screen.rows["MCP4"], Qt.Key.Key_Up, Qt.KeyboardModifier.ShiftModifier)
    np.testing.assert_allclose(screen.edits.current_px(ROW)[4], before[4] + [1.0, -10.0], atol=1e-9)
    qtbot.keyClick(screen, "h")
    assert screen.edits.corrections()[0].places["MCP4"] is None
    for _ in range(3):
        qtbot.keyClick(screen, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert screen.edits.corrections() == ()


def test_correction_occluded_marker_clicked_on_a_blob_moves_there(qtbot: QtBot, screen: CorrectionScreen) -> None:
    number = screen.edits.markers.index("MCP3")
    whole = screen.edits.session
    measured_px = whole.markers.measured_px.copy()
    measured_px[ROW, number] = np.nan
    screen.edits.session = replace(whole, markers=replace(whole.markers, measured_px=measured_px))
    spot = screen.edits.model_px(ROW)[number]
    screen.frame_view.blob_px = np.vstack((screen.frame_view.blob_px, spot))
    drag(qtbot, screen, spot, spot)
    (one,) = screen.edits.corrections()
    np.testing.assert_allclose(one.places["MCP3"], spot, atol=6.0)


def test_correction_residual_flags_the_wrong_marker_only(sessions: FakeSessions) -> None:
    places = MarkerEdits(sessions.session("session-7"))
    assert all(places.residual_mm(ROW, name) < 3.0 for name in places.markers)
    places.place_marker(ROW, "MCP3", places.current_px(ROW)[3] + [40.0, 10.0], np.empty((0, 2)))
    assert places.residual_mm(ROW, "MCP3") > 30.0
    assert all(places.residual_mm(ROW, name) < 6.0 for name in places.markers if name != "MCP3")
    assert places.undo() == ROW
    assert places.undo() == -1


def test_correction_frames_are_corrected_independently_in_a_shorter_session(
    qtbot: QtBot, screen: CorrectionScreen, background: Background
) -> None:
    assert "No video was saved" in screen.hint.text()
    assert len(screen.frame_view.blob_px) == 7
    screen.place_marker("MCP3", screen.edits.original_px(ROW)[3])
    screen.step_frames(5)
    qtbot.waitUntil(lambda: screen.frame_view.row == ROW + 5)
    screen.place_marker("MCP2", screen.edits.original_px(ROW + 5)[2])
    assert [one.row for one in screen.edits.corrections()] == [ROW, ROW + 5]
    assert "00:20.6" in screen.primary_button.text()
    screen.show_session("session-7", session(seconds=0.5 * ROW / 30.0), ROW // 4)
    assert screen.hint.text() == "", "its picture is being read"
    qtbot.waitUntil(lambda: not background.is_busy)
    assert screen.row == ROW // 4


def test_new_result_names_live_labels_it_does_not_have() -> None:
    words = difference_words(ResultDifference(620, 0, 0.0, 0.0, 0, "", (), is_live=False), (), live_labels=2)
    assert words.startswith("Labels given while measuring (2) are not part of the new result.")
