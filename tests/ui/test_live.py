"""The live screen: what it shows of each state, what each key does, and that nothing flickers or lies."""

from __future__ import annotations

import math
import time
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot

from carpus.core.model.hand.exercises import get_exercise
from carpus.core.model.hand.protocols import WRIST6
from carpus.core.model.types import Detections, TrackedFrame, TrackStatus
from carpus.core.pipeline.live_values import StartMode
from carpus.ui.charts.history import History
from carpus.ui.screens.live import recording as live_recording
from carpus.ui.screens.live.recording import COUNTDOWN_S, STILL_DEG, STILL_S, RepetitionCounter, StartTrigger
from carpus.ui.screens.live.status_light import StatusLight, SteadyLight, marker_light
from tests.moments import with_moment
from tests.ui.conftest import Live, TriedLive
from tests.ui.fakes import FakeFeed, LateFeed, simulated, tracked_frames

MARKERS = ("WRIST", "CMC1", "MCP2", "MCP3", "MCP4", "MCP5")


def test_number_and_speeds_are_those_of_the_frame_shown(live: Live) -> None:
    tried = live(FakeFeed(), 5.0)
    curves, moved = tried.screen.curves, tried.feed.current_view().tracked.kinematics
    shown = math.degrees(float(moved.angles_rad[1]))
    assert tried.reading().value_deg == pytest.approx(shown)
    assert tried.screen.number_card.movement_name() == ("Flexion" if shown > 0 else "Extension")
    assert tried.screen.controls.light_view.status_light.rank == "good"
    tried.press(Qt.Key.Key_F4)
    assert len(curves.panels()) == 2
    speed_mm_s, turning_deg_s = curves._history.speeds
    assert speed_mm_s == pytest.approx(1000.0 * math.hypot(*moved.velocity_m_s))
    assert turning_deg_s == pytest.approx(math.degrees(math.hypot(*moved.angular_velocity_rad_s)))
    tried.press(Qt.Key.Key_F4)
    assert (len(curves.panels()), curves.is_showing_speeds) == (3, False)


def test_live_keys_during_recording(qtbot: QtBot, live: Live) -> None:
    tried = live(FakeFeed(), 1.0)
    tried.record()
    screen, recording = tried.screen, tried.screen.recording
    assert recording.state == "recording"
    tried.run(2.0)
    tried.press(Qt.Key.Key_F7)
    assert recording.state == "paused"
    tried.run(3.0)
    tried.press(Qt.Key.Key_F7)
    tried.run(2.0)
    assert recording.duration_s == pytest.approx(4.0, abs=0.4), "a pause is not recorded time"
    tried.press(Qt.Key.Key_F5)
    assert screen.note_dialog.isVisible()
    qtbot.keyClicks(screen.note_dialog.line, "strap loose")
    qtbot.keyClick(screen.note_dialog.line, Qt.Key.Key_Return)
    tried.press(Qt.Key.Key_F6)
    qtbot.keyClick(screen.pain_dialog.buttons[0], Qt.Key.Key_3)
    assert tried.feed.noted == [("note", "strap loose"), ("pain", "3")]
    assert not screen.pain_dialog.isVisible()
    with qtbot.waitSignal(recording.stopped) as stopped:
        tried.press(Qt.Key.Key_Space)
    assert stopped.args == ["session-7"]
    assert recording.state == "off"


def test_repetitions_and_best_are_counted_from_recorded_frames_only(live: Live) -> None:
    tried = live(FakeFeed(seconds=32.0), 6.0)
    tried.record()
    tried.run(24.0)
    count, feed = tried.screen.recording.counter, tried.feed
    assert count.update_count() in (3, 4)
    assert 1 <= len(feed.told) <= count.repetitions, "each that is counted is told to the network, at its end"
    assert {kind for kind, _ in feed.told} == {"repetition"}
    assert all(count._times[0] < at_s <= count._times[-1] for _, at_s in feed.told)
    since = [one for one in feed.frames[: feed.place + 1] if one.timestamp_s >= count._times[0] - 1e-9]
    recorded_deg = np.degrees([one.kinematics.angles_rad[1] for one in since])
    reading = tried.reading()
    best_deg = reading.best_positive_deg, reading.best_negative_deg
    assert best_deg == pytest.approx((recorded_deg.max(), recorded_deg.min()))


def test_predicted_frames_are_marked_and_do_not_count_as_best(live: Live) -> None:
    tried = live(FakeFeed(hidden=[(2.0, 20.0, name) for name in MARKERS[:4]]), 3.0)
    tried.record()
    tried.run(6.0)
    reading = tried.reading()
    assert reading.is_predicted
    assert math.isnan(reading.best_positive_deg)
    assert tried.screen.controls.light_view.status_light.rank == "warn"


def test_live_lost_camera_clears_frame_and_values(live: Live) -> None:
    tried = live(FakeFeed(), 2.0)
    tried.record()
    screen = tried.screen
    screen.draw()
    assert not screen.exercise_snapshot().is_late
    screen.set_camera_lost(True)
    assert screen.exercise_snapshot().is_late, "the patient's view shows no old number either"
    screen.draw()
    assert math.isnan(tried.reading().value_deg)
    assert screen.picture.image is None
    assert screen.controls.light_view.status_light.state == "No image"
    assert screen.recording.state == "paused"
    assert (screen.controls.pause_button.isEnabled(), screen.controls.pause_button.text()) == (False, "Pause")
    screen.recording.toggle_pause()
    assert not tried.feed.is_paused
    screen.set_camera_lost(False)
    assert screen.controls.pause_button.isEnabled()


def test_live_drawing_leaves_time_for_input(live: Live) -> None:
    tried = live(FakeFeed(), 0.5)
    for since_s, drawing_ms, drawn in (
        (math.inf, 5.0, True),
        (-1000.0, 5.0, False),  # too soon after the last drawing
        (1000.0, 4e6, False),  # drawing takes so long that tracking would have no time left
    ):
        tried.feed.step(2)
        tried.screen._drawn_at_s, tried.screen._drawing_ms = time.monotonic() - since_s, drawing_ms
        tried.screen.draw_if_due()
        assert (tried.screen.history.last_index == tried.feed.place) == drawn


def test_pain_of_ten_is_typed_and_escape_closes_the_card(qtbot: QtBot, live: Live) -> None:
    screen = live(FakeFeed()).screen
    kept: list[int] = []
    screen.pain_dialog.pain_entered.connect(kept.append)
    for typed, score in (("10", 10), ("7", 7), ("13", 3), ("0", 0)):
        screen.pain_dialog.open()
        for digit in typed:
            qtbot.keyClick(screen.focusWidget(), digit)
        assert kept[-1] == score
    screen.pain_dialog.open()
    qtbot.keyClick(screen.focusWidget(), "1")
    qtbot.waitUntil(lambda: kept[-1] == 1)
    screen.pain_dialog.open()
    qtbot.keyClick(screen.focusWidget(), Qt.Key.Key_Escape)
    assert not screen.pain_dialog.isVisible()
    assert kept == [10, 7, 3, 0, 1]


def test_live_start_stop_key_works_and_early_stop_asks(
    qtbot: QtBot, live: Live, monkeypatch: pytest.MonkeyPatch
) -> None:
    tried = live(FakeFeed(), 0.5)
    feed, recording = tried.feed, tried.screen.recording
    asked: list[bool] = []
    recording.early_stop_requested.connect(lambda: asked.append(True))
    clock_s = [100.0]
    monkeypatch.setattr(live_recording.time, "monotonic", lambda: clock_s[0])
    tried.press(Qt.Key.Key_Space)
    qtbot.waitUntil(lambda: feed.is_recording and not recording.is_busy)
    clock_s[0] += 2.9
    tried.press(Qt.Key.Key_Space)
    assert asked == [True]
    assert feed.is_recording
    assert not recording.is_busy
    clock_s[0] += 0.2
    tried.press(Qt.Key.Key_Space)
    qtbot.waitUntil(lambda: not feed.is_recording and not recording.is_busy)
    assert asked == [True]
    tried.measuring.is_playback, recording.start_mode = True, "countdown"
    tried.press(Qt.Key.Key_Space)
    qtbot.waitUntil(lambda: feed.is_recording)  # what is stored is played at once


def test_live_free_blob_is_offered_for_an_occluded_marker() -> None:
    feed = FakeFeed()
    frame, camera = feed.frames[30], feed.pictures.truth.camera
    measured = frame.marker_measured_px.copy()
    measured[3] = np.nan
    hidden = replace(frame, marker_measured_px=measured)
    beside = hidden.marker_predicted_px[3] + [0.0, 15.0]
    pixel = np.vstack((measured[np.isfinite(measured[:, 0])], beside))
    spots = Detections(pixel, *(np.ones((4, len(pixel)))))
    light = marker_light(replace(hidden, detections=spots), MARKERS, camera)
    assert (light.state, light.remedy) == ("Another blue spot is here", "Is it the middle finger MCP?")
    far = replace(spots, pixel=np.vstack((spots.pixel[:-1], beside + 80.0)))
    assert marker_light(replace(hidden, detections=far), MARKERS, camera).rank == "good"
    questioned = replace(frame, doubted=np.arange(6) == 3, status=TrackStatus.DOUBTFUL)
    light = marker_light(replace(questioned, detections=Detections.none()), MARKERS, camera)
    assert (light.state, light.remedy) == ("Uncertain", "Check the middle finger MCP")


def test_live_lag_shows_the_newest_frame_and_the_delay(live: Live) -> None:
    tried = live(LateFeed(), 1.0)
    tried.record()
    feed, screen = tried.feed, tried.screen
    shown: list[object] = []
    feed.ahead_s, feed.dropped = 4.0, 3  # dropped before it was recorded
    screen._show_counters()
    tried.run(0.5)
    screen._show_values()
    late = StatusLight("idle", "Values are 4 s behind", "The computer is busy; every frame is saved")
    assert screen.controls.light_view.status_light == late
    assert (math.isnan(screen.exercise_snapshot().value_deg), screen.exercise_snapshot().is_late) == (True, True)
    newest = feed.current_frame()
    feed.current_frame = lambda: newest  # type: ignore[method-assign]
    screen.picture.show_frame = shown.append  # type: ignore[method-assign, assignment]
    screen.draw()
    assert shown[-1] is newest.color_rgb
    del feed.current_frame
    del screen.picture.show_frame
    feed.dropped = 8
    screen._show_counters()
    screen.draw()
    screen._show_values()
    assert screen.controls.light_view.status_light.rank == "warn"
    assert screen.controls.light_view.status_light.remedy.startswith("5 frames are missing")
    feed.ahead_s = 0.0
    tried.run(0.5)
    screen._show_values()
    assert "late" not in screen.controls.light_view.status_light.state


def test_live_arm_movement_is_reported_beyond_its_limit() -> None:
    feed = FakeFeed()
    frames = [with_moment(frame, position_m=np.zeros(3)) for frame in feed.frames[:30]]
    history = History(WRIST6)
    history.append(frames)
    for distance_m, moved in ((0.0149, False), (0.0151, True)):
        step = np.array([0.0, 0.0, distance_m])
        there = with_moment(frames[0], position_m=step)
        history.append([replace(there, index=history.last_index + 1, timestamp_s=history.end_s + 0.03)])
        assert history.has_forearm_moved() is moved


def test_status_light_delays_all_but_red() -> None:
    good, warn = StatusLight("good", "a", ""), StatusLight("warn", "b", "")
    for before, wanted, delay_s in ((good, warn, 0.3), (warn, good, 0.5)):
        light = SteadyLight()
        light.update(before, 0.0)
        for at_s, shown in ((1.0, before), (1.0 + delay_s - 0.05, before), (1.0 + delay_s, wanted)):
            assert light.update(wanted, at_s) == shown
    light = SteadyLight()
    light.update(good, 0.0)
    for step in range(40):
        assert light.update(warn if step % 4 == 0 else good, 1.0 + 0.05 * step) == good
    assert light.update(StatusLight("bad", "c", ""), 4.0).rank == "bad"


# --- begun with no hand at the keyboard: over a still hand, counted down, taken back by one key ----------
FPS = 30.0


def begun(beginning: StartTrigger, angle_deg, until_s: float, from_s: float = 0.0) -> float:  # type: ignore[no-untyped-def]
    """When it says that the recording begins; NaN for never."""
    for number in range(round(from_s * FPS), round(until_s * FPS)):
        now_s = number / FPS
        value = angle_deg(now_s)
        if beginning.update(None if value is None else np.array([value, 1.0, math.nan]), now_s):
            return now_s
    return math.nan


def test_live_start_waits_for_a_still_hand_and_counts_down() -> None:
    beginning = StartTrigger()
    assert math.isnan(begun(beginning, lambda _: 0.0, 60.0)), "nobody asked for it"
    noise = np.random.default_rng(7).normal(0.0, 0.5, 2000)
    beginning.start_waiting()
    at_s = begun(beginning, lambda t: 30.0 * math.sin(t) if t < 10.0 else 20.0 + noise[round(t * FPS)], 60.0)
    assert at_s == pytest.approx(10.0 + STILL_S + COUNTDOWN_S, abs=0.5)
    assert (beginning.is_waiting, beginning.is_counting, beginning.remaining_s(at_s)) == (False, False, 0)


@pytest.mark.parametrize("what", ["moves", "lost"])
def test_live_countdown_restarts_when_the_hand_moves(what: str) -> None:
    beginning = StartTrigger()
    beginning.start_waiting()
    assert math.isnan(begun(beginning, lambda _: 0.0, STILL_S + 1.0))
    assert beginning.remaining_s(STILL_S + 1.0) == 3 - 1
    disturbed = 4.0 * STILL_DEG if what == "moves" else None
    assert math.isnan(begun(beginning, lambda _: disturbed, STILL_S + 1.2, STILL_S + 1.0))
    assert (beginning.is_waiting, beginning.is_counting) == (True, False)
    assert begun(beginning, lambda _: 0.0, 60.0, STILL_S + 1.2) >= 2.0 * STILL_S + COUNTDOWN_S


def waiting(live: Live, mode: StartMode) -> TriedLive:
    tried = live(FakeFeed(speed_hz=0.01))  # all but still
    tried.screen.recording.start_mode = mode
    tried.begin(tried.screen.recording.set_up)
    return tried


def test_live_key_and_pedal_start_and_cancel_the_countdown(qtbot: QtBot, live: Live) -> None:
    tried = waiting(live, "countdown")
    screen, feed = tried.screen, tried.feed
    tried.run(1.0)
    for counts, takes_back in ((Qt.Key.Key_Space, Qt.Key.Key_PageDown), (Qt.Key.Key_PageDown, Qt.Key.Key_Space)):
        tried.press(counts)
        assert screen.controls.main_button.text() == "Starting in 3 (cancel)"
        tried.run(1.5)
        assert (screen.controls.main_button.text(), screen.exercise_snapshot().countdown_s) == (
            "Starting in 2 (cancel)",
            2,
        )
        tried.press(takes_back)
        tried.run(4.0)
        assert (screen.controls.main_button.text(), feed.is_recording) == ("Record", False)
    tried.press(Qt.Key.Key_Space)
    tried.run(COUNTDOWN_S + 0.2)
    qtbot.waitUntil(lambda: feed.is_recording)


def test_live_still_hand_starts_the_recording_except_at_rest(qtbot: QtBot, live: Live) -> None:
    tried = waiting(live, "still")
    screen, feed = tried.screen, tried.feed
    screen.recording.set_resting(resting=True)
    tried.run(6.0)
    assert not screen.recording.start_trigger.is_waiting
    screen.recording.set_resting(resting=False)
    tried.run(1.0)
    assert "Starts automatically when the hand is still" in screen.controls.light_view.status_light.remedy
    tried.run(STILL_S + COUNTDOWN_S)
    qtbot.waitUntil(lambda: feed.is_recording and screen.recording.counter is not None)
    assert screen.controls.main_button.text() == "Stop and review"


# --- the live count --------------------------------------------------------------------------------------
def bending(time_s: np.ndarray, flexion_deg: np.ndarray) -> list[TrackedFrame]:
    """Frames of a wrist that bends so."""
    frame = with_moment(FakeFeed(seconds=1.0).frames[20], angles_sd_rad=np.radians([0.5, 0.7, 1.2]))
    return [
        replace(with_moment(frame, angles_rad=np.radians([0.0, angle, 0.0])), timestamp_s=float(at_s))
        for at_s, angle in zip(time_s, flexion_deg, strict=True)
    ]


def test_live_passive_movement_is_not_counted() -> None:
    time_s = np.arange(0.0, 30.0, 1.0 / FPS)
    frames = bending(time_s, np.where(time_s < 15.0, 30.0, 60.0) * np.sin(2.0 * np.pi * 0.4 * time_s))
    half, running = len(frames) // 2, RepetitionCounter(get_exercise("WRIST_FE"))
    running.append(frames[:half])
    by_itself = running.update_count()
    running.set_passive(frames[half - 1].timestamp_s, passive=True)
    running.append(frames[half:-60])
    assert running.update_count() <= by_itself + 1, "the one that had begun"
    assert running.best_positive_deg < 31.0
    running.set_passive(frames[-60].timestamp_s, passive=False)
    running.append(frames[-60:])
    assert running.best_positive_deg > 31.0, "by itself again"
    done = running.update_count()
    running.set_passive(0.0, passive=True)
    assert (running.update_count(), running.found_count) == (done, 0), "what was done stays done"
    hidden = RepetitionCounter(get_exercise("WRIST_FE"))
    hidden.append([replace(frame, status=TrackStatus.PREDICTED) for frame in frames])
    assert hidden.update_count() == 0, "predicted alone"


def test_live_values_and_bests_of_the_forearm_count_from_thumb_up() -> None:
    frames, exercise = tracked_frames(simulated("palm_up", 12.0, 0.25, "left")), get_exercise("FOREARM_PS")
    stored_deg = np.degrees([frame.kinematics.angles_rad[2] for frame in frames])
    history, count = History(WRIST6), RepetitionCounter(exercise)
    history.clear(WRIST6, exercise)
    history.append(frames)
    count.append(frames)
    assert history.angles_deg[2] == pytest.approx(stored_deg[-1] - 90.0)
    assert history.angle_series(2).value[-1] == pytest.approx(stored_deg[-1] - 90.0)
    assert count.best_positive_deg == pytest.approx(stored_deg.max() - 90.0, abs=0.5)
    assert count.best_negative_deg == pytest.approx(stored_deg.min() - 90.0, abs=0.5)
    assert count.update_count() >= 2


def test_live_countdown_after_the_key_ignores_the_hand() -> None:
    beginning = StartTrigger()
    beginning.start_countdown(5.0)
    assert [beginning.remaining_s(time_s) for time_s in (5.0, 6.5, 7.9)] == [3, 2, 1]
    assert begun(beginning, lambda t: 40.0 * math.sin(3.0 * t), 60.0, 5.0) == pytest.approx(5.0 + COUNTDOWN_S, abs=0.05)
