"""The whole journey through the real application: by mouse, from a file, and when things go wrong."""

from __future__ import annotations

import math
import shutil
import time
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QApplication, QFileDialog, QWidget
from pytestqt.qtbot import QtBot

from carpus.app.desktop.main_controller import MainController
from carpus.app.desktop.maintenance_cameras import MaintenanceCameras
from carpus.app.desktop.source_factory import RECENT_FRAMES
from carpus.app.desktop.window import Desktop
from carpus.core.model.errors import CameraLost, CameraReturned, DiskFull
from carpus.core.pipeline import measurement
from carpus.core.pipeline.smoothing import SmoothingProcess
from carpus.core.records.recordings import spool_folder
from carpus.core.records.session_setup import MARKERS_SUFFIX, PRACTICE_PATIENT
from carpus.core.records.values import Patient
from carpus.core.session.reader import read_session
from carpus.ui.shell.current_selection import SourceChoice
from carpus.ui.shell.messages import MessageDialog, NoticeStrip
from tests.journeys.conftest import Open
from tests.journeys.takes import RANGE_DEG, SPEED, read_take_clicks
from tests.session.samples import make_header, write_journal
from tests.ui.printed import read_words

PATIENCE_MS = 60_000
"""Only a failing test ever waits that long."""


def wait_until(qtbot: QtBot, condition: Any) -> None:
    qtbot.waitUntil(condition, timeout=PATIENCE_MS)


def click(qtbot: QtBot, widget: QWidget, spot: QPoint | None = None) -> None:
    """A left click on the middle of what can be seen, or on a place."""
    assert widget.isVisible()
    assert widget.isEnabled()
    qtbot.mouseMove(widget, spot or widget.rect().center())
    qtbot.mouseClick(widget, Qt.MouseButton.LeftButton, pos=spot or widget.rect().center())


def wait_for_place(qtbot: QtBot, journey: MainController, place: str) -> None:
    wait_until(qtbot, lambda: journey.place == place)


def wait_for_still_hand(qtbot: QtBot, desktop: Desktop) -> None:
    """Half a second of the still hand has been seen."""
    wait_for_place(qtbot, desktop.controller, "markers")
    source = desktop.controller.current.source
    wait_until(qtbot, lambda: len(source.measuring.feed.recent_frames(RECENT_FRAMES)) == RECENT_FRAMES)
    wait_until(qtbot, lambda: desktop.controller.markers.screen.picture.image is not None)


def click_discs(qtbot: QtBot, desktop: Desktop, take: Path) -> None:
    picture = desktop.controller.markers.screen.picture
    for u, v in read_take_clicks(take):
        QApplication.processEvents()  # what came or went beside the picture has made it larger or smaller
        click(qtbot, picture, picture.to_screen(float(u), float(v)).toPoint())
    wait_until(qtbot, desktop.controller.markers.screen.primary_button.isEnabled)


def get_reviewed_file(qtbot: QtBot, desktop: Desktop) -> Path:
    """The session file of the review that is shown."""
    wait_for_place(qtbot, desktop.controller, "review")
    wait_until(qtbot, lambda: desktop.controller.review.screen.is_loaded)
    return desktop.library.entry(desktop.controller.current.session_id).path


def check_file(path: Path, subject: str) -> None:
    """The stored session, read by plain h5py, holds the movement that the patient made."""
    with h5py.File(path) as file:
        assert file.attrs["complete"]
        assert file.attrs["subject_id"] == subject
        assert file.attrs["exercise"] == "WRIST_FE"
        times, status = file["frames/timestamp"][:], file["frames/status"][:]
        flexion_deg = np.degrees(file["wrist/angles"][:, 1])
        smooth_deg = np.degrees(file["smoothed/wrist/angles"][:, 1])
    assert len(times) > 40
    assert np.all(np.diff(times) > 0.0)
    assert np.mean(status == 0) > 0.8
    for angles in (flexion_deg[status == 0], smooth_deg[status == 0]):
        assert angles.max() == pytest.approx(0.97 * RANGE_DEG, abs=4.0)
        assert angles.min() == pytest.approx(-0.97 * RANGE_DEG, abs=4.0)


def check_pictures(desktop: Desktop, path: Path) -> None:
    """The pictures that were kept show the discs where the session says."""
    assert path.with_suffix(".carpusraw").exists()
    session = desktop.library.session(session_id := desktop.controller.current.session_id)
    for row in (0, len(session) - 1):
        picture = desktop.library.read_frame(session_id, row)
        assert picture.shape == (480, 640, 3)
        known = np.isfinite(session.markers.measured_px[row, :, 0])
        u, v = np.round(session.markers.measured_px[row][known][0]).astype(int)
        red, _, blue = picture[v, u].astype(int)
        assert blue > red + 30


def test_whole_journey_by_mouse(
    qtbot: QtBot, open_desktop: Open, take: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    journey = (desktop := open_desktop()).controller
    click(qtbot, journey.patients.screen.new_button)
    for chips in (journey.patients.screen.form.fields["side"], journey.patients.screen.form.fields["dominance"]):
        click(qtbot, chips.buttons()[0])
    click(qtbot, journey.patients.screen.form.save_button)
    name = journey.patients.screen.list.patient_model.row(0).pseudonym
    wait_until(qtbot, lambda: journey.patients.screen.card.start_button.isVisible())
    click(qtbot, journey.patients.screen.card.start_button)
    wait_for_place(qtbot, desktop.controller, "exercise")
    click(qtbot, journey.exercise.screen.exercises.option("WRIST_FE"))
    journey.exercise.screen.form["stores_frames"].choose(True)
    click(qtbot, journey.exercise.screen.primary_button)
    wait_for_place(qtbot, desktop.controller, "camera")
    click(qtbot, journey.camera.screen.sources.option("practice"))
    click(qtbot, journey.camera.screen.primary_button)
    wait_for_still_hand(qtbot, desktop)
    click(qtbot, journey.markers.screen.primary_button)
    click_discs(qtbot, desktop, take)
    assert journey.markers.screen.guidance.verdict_panel.lines[0][0].state == "good"
    click(qtbot, journey.markers.screen.primary_button)
    wait_for_place(qtbot, desktop.controller, "live")
    assert desktop.shell.banner.text == f"This is a simulated hand, not {name}. It is excluded from analysis."
    live = journey.live.screen
    wait_until(qtbot, lambda: not live.recording.is_hand_resting())
    can_move, live.recording.is_hand_resting = live.recording.is_hand_resting, lambda: True
    wait_until(qtbot, lambda: "Preparing" in live.controls.light_view.status_light.state)
    assert not journey.messages.is_busy, "a card would take Space from the recording"
    click(qtbot, live.controls.main_button)
    assert live.recording.state == "off", "a still hand is not recorded"
    live.recording.is_hand_resting = can_move
    click(qtbot, journey.live.screen.controls.main_button)
    wait_until(qtbot, lambda: journey.live.screen.recording.state == "recording")
    wait_until(qtbot, lambda: desktop.shell.top_bar.recording_pill.state == "recording")
    wait_until(qtbot, lambda: journey.live.screen.recording.repetitions >= 2)
    click(qtbot, journey.live.screen.controls.main_button)
    path = get_reviewed_file(qtbot, desktop)
    assert read_session(path).header.is_simulated
    assert desktop.shell.banner.isVisible()
    assert any("imulated" in line for line in journey.top_bar.banner_lines())
    check_file(path, name)
    check_pictures(desktop, path)
    before, counted = path.read_bytes(), journey.review.screen.results.repetition_count
    journey.review.screen._exclude_repetition(journey.review.screen.current + 1, "pain", and_after=False)
    wait_until(qtbot, lambda: not journey.background.is_busy)
    assert path.read_bytes() == before, "what was left out is stored beside the session"
    assert path.is_relative_to(desktop.library.store.sessions_folder)
    assert desktop.shell.top_bar.recording_pill.state == "off"
    click(qtbot, desktop.shell.top_bar.navigation_buttons[2])
    wait_for_place(qtbot, desktop.controller, "progress")
    click(qtbot, desktop.shell.top_bar.navigation_buttons[1])
    get_reviewed_file(qtbot, desktop)
    click(qtbot, desktop.shell.top_bar.navigation_buttons[2])
    wait_for_place(qtbot, desktop.controller, "progress")
    wait_until(qtbot, lambda: bool(journey.progress.screen.chart.points()))
    spot = journey.progress.screen.chart.points()[0][2].toPoint()
    qtbot.mouseClick(journey.progress.screen.chart.mouse_target, Qt.MouseButton.LeftButton, pos=spot)
    get_reviewed_file(qtbot, desktop)
    click(qtbot, journey.review.screen.card.report_button)
    wait_for_place(qtbot, desktop.controller, "report")
    pdf = tmp_path / "report.pdf"
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(pdf), ""))
    with qtbot.waitSignal(journey.report.screen.saved, timeout=PATIENCE_MS):
        click(qtbot, journey.report.screen.save_button)
    assert name in read_words(pdf)
    click(qtbot, desktop.shell.top_bar.back_button)
    wait_for_place(qtbot, desktop.controller, "review")
    click(qtbot, desktop.shell.top_bar.back_button)
    wait_for_place(qtbot, desktop.controller, "patients")
    row = journey.patients.screen.list.patient_model.row(0)
    assert (row.pseudonym, row.session_count) == (name, 0), "a simulated hand counts nowhere"
    assert journey.patients.screen._store.card(row.patient_id).has_sessions
    assert [folder.stat().st_mode & 0o777 for folder in (desktop.library.folder, path.parent)] == [0o700, 0o700]
    journey.exercise.open(row.patient_id)
    click(qtbot, journey.exercise.screen.primary_button)
    wait_for_place(qtbot, journey, "camera")
    assert journey.camera.screen.sources.value() == "camera", "a simulated hand is chosen each time"
    desktop.close()
    again = open_desktop()
    (entry,) = again.library.sessions(row.patient_id)
    stored = again.library.results(entry)
    assert stored.repetition_count == counted - 1
    assert stored.repetition_count == 0 or math.isfinite(stored.wrist_ranges[0].mean)


def test_recording_is_measured_from_its_first_frame_to_its_last_in_real_time(
    qtbot: QtBot, open_desktop: Open, take: Path
) -> None:
    journey = (desktop := open_desktop()).controller
    journey.camera.open(PRACTICE_PATIENT)
    wait_for_place(qtbot, desktop.controller, "markers")
    journey.navigator.navigate_back()
    wait_for_place(qtbot, desktop.controller, "camera")
    journey.camera.screen.set_path(str(take))
    click(qtbot, journey.camera.screen.primary_button)
    wait_for_place(qtbot, desktop.controller, "markers")
    assert not journey.markers.screen.new_frame_button.isVisible()
    click_discs(qtbot, desktop, take)
    assert not journey.messages.is_busy
    qtbot.keyClick(desktop.shell.focusWidget(), Qt.Key.Key_Return)
    wait_for_place(qtbot, desktop.controller, "live")
    assert journey.live.screen.recording.state == "off", "it waits for the key, as every source does"
    qtbot.keyClick(desktop.shell.focusWidget(), Qt.Key.Key_Space)
    begun_s = time.monotonic()
    path = get_reviewed_file(qtbot, desktop)  # recorded, played to its end and stopped by itself
    assert not journey.review.screen.card.repeat_button.isVisible()
    check_file(path, "practice")
    stored = [float(line.split()[0]) for line in (take / "rgb.txt").read_text().splitlines() if line[:1] != "#"]
    with h5py.File(path) as file:
        times = file["frames/timestamp"][:]
        assert len(times) + int(file["quality/dropped_frames"][:].sum()) == len(stored)
    assert time.monotonic() - begun_s > 0.9 * (times[-1] - times[0]) / SPEED
    assert set(np.round(times, 6)) <= set(stored)
    assert (times[0], times[-1]) == (pytest.approx(stored[0]), pytest.approx(stored[-1]))


def test_full_disk_prevents_recording_and_closing_keeps_storing(
    qtbot: QtBot, open_desktop: Open, take: Path, caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    desktop, journey = to_live(qtbot, open_desktop(), take)
    source, card, folder = journey.current.source, journey.messages.dialog, desktop.library.folder
    assert source is not None
    usage = shutil.disk_usage(folder)
    with monkeypatch.context() as full:
        full.setattr(measurement.shutil, "disk_usage", lambda _: usage._replace(free=20_000_000))
        journey.live.screen.recording.toggle()
        wait_until(qtbot, card.isVisible)
    assert "20 MB free" in card.details.full_text()
    assert journey.live.screen.recording.state == "off"
    assert list(folder.rglob("*.h5*")) == []
    click(qtbot, card.answers[-1][0])
    caplog.clear()
    kept: list[object] = []
    real = SmoothingProcess.join

    def looked_back(looking_back: SmoothingProcess) -> None:
        kept.append(source.measuring._pipeline.on_steps)
        real(looking_back)

    monkeypatch.setattr(SmoothingProcess, "join", looked_back)
    journey.live.screen.recording.toggle()
    wait_until(qtbot, lambda: journey.live.screen.recording.duration_s > 0.5)
    journey.live.screen.recording.stop()
    assert journey.live.screen.recording.is_storing
    desktop.shell.close_without_prompt()
    assert not [record for record in caplog.records if record.name != "carpus.core.pipeline.measurement"]
    assert kept
    assert kept[0] is None, "while it is waited for no more comes to be looked back at"
    assert len(open_desktop().library.sessions(PRACTICE_PATIENT)) == 1


def to_live(qtbot: QtBot, desktop: Desktop, take: Path) -> tuple[Desktop, MainController]:
    desktop.controller.camera.open(PRACTICE_PATIENT)
    wait_for_still_hand(qtbot, desktop)
    desktop.controller.markers.screen.accept()
    click_discs(qtbot, desktop, take)
    click(qtbot, desktop.controller.markers.screen.primary_button)
    wait_for_place(qtbot, desktop.controller, "live")
    return desktop, desktop.controller


def test_question_during_recording_loses_no_frame(
    qtbot: QtBot, open_desktop: Open, take: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    desktop, journey = to_live(qtbot, open_desktop(), take)
    shell, live = desktop.shell, journey.live.screen
    recording, feed = live.recording, journey.current.source.measuring.feed

    def card() -> MessageDialog:
        return journey.messages.dialog  # another one on another screen

    def goes_on(key: Qt.Key) -> None:
        assert card().isVisible()
        qtbot.keyClick(shell.focusWidget(), key)
        assert (card().isVisible(), recording.state) == (False, "recording")

    def record() -> None:
        shell.activateWindow()
        qtbot.keyClick(shell.focusWidget(), Qt.Key.Key_Space)
        wait_until(qtbot, lambda: recording.duration_s > 0.5)

    record()
    shell.close()
    assert card().isVisible(), "it asks first"
    whole = live.picture.is_whole
    for key in (Qt.Key.Key_F7, Qt.Key.Key_F9, Qt.Key.Key_F5, Qt.Key.Key_F1):
        qtbot.keyClick(shell.focusWidget(), key)
    assert (card().isVisible(), recording.state) == (True, "recording"), "a card takes every key"
    assert (live.picture.is_whole, journey.place) == (whole, "live")
    live.setFocus()  # as a click beside the card would
    assert card().isAncestorOf(shell.focusWidget())
    qtbot.mouseClick(live.controls.main_button, Qt.MouseButton.LeftButton)
    goes_on(Qt.Key.Key_Space)  # "Continue measuring"
    qtbot.keyClick(shell.focusWidget(), Qt.Key.Key_Escape)  # leaves no recording either
    goes_on(Qt.Key.Key_Escape)  # the answer that loses nothing
    monkeypatch.setattr("carpus.ui.screens.live.recording.MIN_RECORDING_S", 3600.0)
    recording.toggle()
    goes_on(Qt.Key.Key_Return)
    feed.handle_notice(CameraLost("Xtion", "unplugged"))
    wait_until(qtbot, lambda: card().isVisible())
    assert "has stopped sending images" in card().happened.text()
    assert "saved" in card().safe_detail.text()
    feed.handle_notice(CameraReturned("Xtion", "3 s"))
    wait_until(qtbot, lambda: not card().isVisible())
    recording.toggle()
    click(qtbot, card().answers[0][0])  # "Stop and review"
    assert journey.place == "live"
    journey.messages.show_fault(DiskFull("x"))
    first = get_reviewed_file(qtbot, desktop)
    assert card().isVisible(), "a message moves with the screen"
    assert "disk" in card().happened.text()
    click(qtbot, card().answers[-1][0])
    assert not journey.messages.is_busy
    with h5py.File(first) as file:
        assert {"camera_lost", "camera_back"} <= set(file["events/kind"].asstr()[:])
    click(qtbot, journey.review.screen.card.repeat_button)
    wait_for_place(qtbot, journey, "live")
    record()
    shell.close()
    recording.stop()  # as the end of the source does
    second = get_reviewed_file(qtbot, desktop)
    assert not journey.messages.is_busy, "the question has answered itself"
    click(qtbot, journey.review.screen.card.repeat_button)
    wait_for_place(qtbot, journey, "live")
    record()
    shell.close()
    click(qtbot, card().answers[0][0])  # "Stop, save and close"
    assert not shell.isVisible()
    again = open_desktop()
    entries = again.library.sessions(PRACTICE_PATIENT)
    (last,) = (entry for entry in entries if entry.path not in (first, second))
    assert len(entries) == 3
    assert last.duration_s > 0.4
    assert last.path.with_suffix(MARKERS_SUFFIX).is_file()
    assert again.controller.patients.screen.findChildren(NoticeStrip) == []


def cut_short(data_folder: Path) -> None:
    """What is left of a session when the program is killed, or the disk was too full to finish it."""
    folder = spool_folder(data_folder) / "someone"
    folder.mkdir(parents=True)
    write_journal(folder / "cut.journal", 60).abandon()


def test_camera_that_is_ready_is_opened_without_a_question_after_the_exercise(
    qtbot: QtBot, open_desktop: Open, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(MaintenanceCameras, "name", lambda _: "Depth camera")
    journey = (desktop := open_desktop()).controller
    wait_until(qtbot, lambda: journey.camera_state.is_connected)
    opened: list[SourceChoice] = []
    monkeypatch.setattr(journey.opener, "open", opened.append)
    journey.exercise.open(desktop.library.patients.add(Patient("Linden 42", "right")))
    click(qtbot, journey.exercise.screen.primary_button)
    assert opened == [SourceChoice("camera")]
    journey.camera.open()  # back from the markers: another source may be wanted
    assert len(opened) == 1


def test_interrupted_session_is_reported_at_next_start_and_can_be_reviewed(qtbot: QtBot, open_desktop: Open) -> None:
    first = open_desktop()
    first.close()
    cut_short(first.library.folder)
    second = open_desktop()
    (strip,) = second.controller.patients.screen.findChildren(NoticeStrip)
    assert make_header().subject_id in strip.words.summary
    assert "safe" in strip.words.data_safety
    click(qtbot, strip.button)
    path = get_reviewed_file(qtbot, second)
    assert (path.name, path.parent.parent) == ("cut.h5", first.library.store.sessions_folder)
    assert second.controller.current.patient.pseudonym == make_header().subject_id
