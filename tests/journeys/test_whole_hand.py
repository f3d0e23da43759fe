"""Twenty-one discs through the real application: set up, named, tracked live, recorded, read back."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
import pytest
from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot

from carpus.app.settings import Settings
from carpus.core.model.hand.protocols import HAND21, joint_angle_names
from carpus.core.pipeline.track import retrack_session
from carpus.core.records.session_setup import PRACTICE_PATIENT
from carpus.core.session.reader import read_session
from carpus.core.simulation.recording import TRUTH_FILE
from tests.journeys.conftest import Open
from tests.journeys.takes import build_take, read_take_clicks
from tests.journeys.test_journey import click, get_reviewed_file, wait_for_place, wait_for_still_hand, wait_until
from tests.rendered import WHOLE_HAND as SPEC
from tests.rendered import Rendered


@pytest.fixture(scope="module")
def hand_take(rendered: Rendered) -> Path:
    return rendered(SPEC)


def test_whole_hand_from_set_up_to_session_file(
    qtbot: QtBot, open_desktop: Open, hand_take: Path, tmp_path: Path
) -> None:
    desktop = open_desktop(practice_renderer=build_take(hand_take, SPEC.fps), speed=1.0)
    journey = desktop.controller
    markers, live = journey.markers.screen, journey.live.screen
    journey.exercise.open(PRACTICE_PATIENT)
    wait_for_place(qtbot, desktop.controller, "exercise")
    click(qtbot, journey.exercise.screen.protocol.buttons()[1])
    click(qtbot, journey.exercise.screen.exercises.option("FIST_COMPOSITE"))
    click(qtbot, journey.exercise.screen.primary_button)  # the practice patient's camera is ready: it opens at once
    wait_for_still_hand(qtbot, desktop)
    click(qtbot, markers.primary_button)
    assert markers.labels.protocol.markers == HAND21.markers
    wait_until(qtbot, lambda: bool(markers.labels and markers.labels.proposals))
    assert not markers.labels.open_markers
    qtbot.keyClick(markers.picture, Qt.Key.Key_Return)  # the names proposed are right
    np.testing.assert_allclose(markers.labels.clicks().pixel, read_take_clicks(hand_take), atol=4.0)
    wait_until(qtbot, lambda: markers.labelling.outcome is not None)
    qtbot.keyClick(desktop.shell.focusWidget(), Qt.Key.Key_Return)
    wait_for_place(qtbot, desktop.controller, "live")
    wait_until(qtbot, lambda: "seen" in live.history.marker_visibility().values())
    qtbot.keyClick(live, Qt.Key.Key_Space)
    wait_until(qtbot, lambda: live.recording.duration_s > 3.0)
    qtbot.keyClick(live, Qt.Key.Key_Space)
    path = get_reviewed_file(qtbot, desktop)
    is_the_movement(path, hand_take)
    looked_back_as_tracking_it_again(path, tmp_path / "again.h5")
    assert not journey.messages.is_busy


def is_the_movement(path: Path, hand_take: Path) -> None:
    """The session file, read by plain h5py, holds the fist that was made."""
    with h5py.File(path) as file:
        assert (file.attrs["protocol"], file.attrs["exercise"]) == ("hand21", "FIST_COMPOSITE")
        names = [str(name) for name in file["joints/angles"].attrs["names"]]
        status, angles_deg = file["frames/status"][:], np.degrees(file["joints/angles"][:])
        seen = np.isfinite(file["markers/measured"][:, :, 0]).sum(axis=1)
    assert names == list(joint_angle_names())
    assert np.mean(status == 0) > 0.8
    assert seen.max() >= 20
    with h5py.File(hand_take / TRUTH_FILE) as file:
        true_deg = np.degrees(file["joints/angles"][:])
    for joint in ("MCP3_flexion", "PIP3_flexion", "PIP2_flexion"):
        column = names.index(joint)
        assert np.nanmax(angles_deg[:, column]) == pytest.approx(true_deg[:, column].max(), abs=13.0)
        assert np.nanmin(angles_deg[:, column]) == pytest.approx(true_deg[:, column].min(), abs=13.0)


def looked_back_as_tracking_it_again(path: Path, again: Path) -> None:
    """What the running session was looked back at is what ``carpus track SESSION.h5`` makes of its detections."""
    retrack_session(path, again, Settings().track)
    live, offline = read_session(path), read_session(again)
    assert not live.events
    assert live.smoothed is not None
    assert offline.smoothed is not None
    for name in ("angles", "joint_angles"):
        sd_rad, live_sd_rad = getattr(offline.smoothed, f"{name}_sd_rad"), getattr(live.smoothed, f"{name}_sd_rad")
        apart_rad = np.abs(getattr(live.smoothed, f"{name}_rad") - getattr(offline.smoothed, f"{name}_rad"))
        assert np.isfinite(apart_rad).mean() > 0.95
        # Live, more was seen before the recording: that tissue lay at home, and how far the calibrated back of the hand
        # is off. Two that know the same but for that differ by what one is surer than the other, and hardly by more.
        surer_rad = np.sqrt(np.maximum(sd_rad**2 - live_sd_rad**2, 0.0) + (0.15 * sd_rad) ** 2)
        assert np.nanmedian(apart_rad / surer_rad) < 1.0
        assert np.nanmax(apart_rad / sd_rad) < 1.0
