"""The live screen: what it shows of each state, what each key does, and that nothing flickers or lies."""

from __future__ import annotations

import math
import threading
import time
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from carpus.core.errors import DiskFull
from carpus.core.hand.protocols import WRIST6
from carpus.core.types import Detections, TrackStatus
from carpus.ui.background import Background
from carpus.ui.keys import Keys
from carpus.ui.live import recording as live_recording
from carpus.ui.live.doubt import Doubt, SteadyDoubt, doubt_lamp, doubt_of
from carpus.ui.live.light import Lamp, SteadyLight, lamp_for
from carpus.ui.live.number_card import NumberCard, Reading
from carpus.ui.live.screen import LiveScreen
from carpus.ui.picture.overlay import axis_pixels, ellipse, within
from carpus.ui.plot.history import KEPT_S, History
from carpus.ui.plot.live_curves import LiveCurves
from carpus.ui.theme import Theme
from tests.moments import with_moment
from tests.ui.fakes import FakeFeed, FakeMeasuring, LateFeed, set_up, with_other_spot

MARKERS = ("WRIST", "CMC1", "MCP2", "MCP3", "MCP4", "MCP5")


def live(qtbot: QtBot, theme: Theme, feed: FakeFeed) -> tuple[LiveScreen, FakeMeasuring]:
    screen = LiveScreen(theme, Keys(), Background())
    qtbot.addWidget(screen)
    screen.resize(1280, 744)
    screen.show()
    screen.activateWindow()
    qtbot.waitUntil(screen.isActiveWindow)
    measuring = FakeMeasuring(feed)
    screen.begin(measuring, set_up())
    screen._timer.stop()
    feed.picture_number = 0
    return screen, measuring


def run(screen: LiveScreen, feed: FakeFeed, seconds: float) -> None:
    for _ in range(round(seconds * 30 / 2)):
        feed.step(2)
        screen.tick()


KEYS = {
    "Space": Qt.Key.Key_Space,
    "F4": Qt.Key.Key_F4,
    "F5": Qt.Key.Key_F5,
    "F6": Qt.Key.Key_F6,
    "F7": Qt.Key.Key_F7,
}


def key(qtbot: QtBot, screen: QWidget, name: str) -> None:
    qtbot.keyClick(screen, KEYS[name])


def record(qtbot: QtBot, screen: LiveScreen, measuring: FakeMeasuring) -> None:
    key(qtbot, screen, "Space")
    qtbot.waitUntil(lambda: screen.recording.count is not None)
    screen.recording._begun_at_s -= live_recording.HASTY_S  # a moment ago
    assert measuring.feed.recording


def test_the_number_is_that_of_the_picture_shown(qtbot: QtBot, theme: Theme) -> None:
    feed = FakeFeed()
    screen, _ = live(qtbot, theme, feed)
    run(screen, feed, 5.0)
    shown = math.degrees(float(feed.newest().tracked.moment.angles_rad[1]))  # type: ignore[union-attr]
    screen._show_values()
    assert screen.number.reading.value_deg == pytest.approx(shown)
    assert screen.number.movement() == ("Flexion" if shown > 0 else "Extension")
    assert screen.controls.light.lamp.rank == "good"


def test_space_records_and_space_stops_and_leads_to_the_session(qtbot: QtBot, theme: Theme) -> None:
    feed = FakeFeed()
    screen, measuring = live(qtbot, theme, feed)
    run(screen, feed, 1.0)
    record(qtbot, screen, measuring)
    assert screen.recording.state == "recording"
    run(screen, feed, 4.0)
    assert screen.recording.recorded_s == pytest.approx(4.0, abs=0.2)
    with qtbot.waitSignal(screen.recording.stopped) as stopped:
        key(qtbot, screen, "Space")
    assert stopped.args == ["session-7"]
    assert screen.recording.state == "off"


def test_the_large_view_leaves_the_figure_the_light_and_the_keys(qtbot: QtBot, theme: Theme) -> None:
    feed = FakeFeed()
    screen, measuring = live(qtbot, theme, feed)
    run(screen, feed, 1.0)
    record(qtbot, screen, measuring)
    height_px = screen.number.height()
    qtbot.keyClick(screen, Qt.Key.Key_F11)
    qtbot.waitUntil(lambda: screen.number.height() > 2 * height_px)
    run(screen, feed, 0.5)
    assert screen.controls.light.isVisible()
    assert not any(part.isVisible() for part in (screen.picture, screen.curves, screen.path, screen.controls.note))
    key(qtbot, screen, "F5")
    assert screen.note_sheet.isVisible()
    screen.note_sheet.close_sheet()
    qtbot.keyClick(screen, Qt.Key.Key_F11)
    qtbot.waitUntil(lambda: screen.number.height() == height_px)
    assert screen.picture.isVisible()


def test_repetitions_and_best_are_counted_from_recorded_frames_only(qtbot: QtBot, theme: Theme) -> None:
    feed = FakeFeed(seconds=32.0)
    screen, measuring = live(qtbot, theme, feed)
    run(screen, feed, 6.0)
    record(qtbot, screen, measuring)
    run(screen, feed, 24.0)
    count = screen.recording.count
    assert count is not None
    assert count.count() in (3, 4)
    assert 1 <= len(feed.told) <= count.repetitions, "each that is counted is told to the network, at its end"
    assert {kind for kind, _ in feed.told} == {"repetition"}
    assert all(count._times[0] < at_s <= count._times[-1] for _, at_s in feed.told)
    recorded = np.degrees(
        [
            f.moment.angles_rad[1]
            for f in feed.frames
            if f.timestamp_s >= screen.recording.count._times[0] - 1e-9 and f.index <= feed.place
        ]
    )
    screen._show_values()
    assert screen.number.reading.best_positive_deg == pytest.approx(recorded.max())
    assert screen.number.reading.best_negative_deg == pytest.approx(recorded.min())


def test_frames_from_before_the_recording_that_are_drawn_late_do_not_count(qtbot: QtBot, theme: Theme) -> None:
    feed = FakeFeed()
    screen, measuring = live(qtbot, theme, feed)
    feed.step(90)
    feed.first_recorded = 80
    record(qtbot, screen, measuring)
    screen.tick()
    assert screen.recording.recorded_s == pytest.approx(10 / 30, abs=0.05)


def test_a_pause_is_not_recorded_time(qtbot: QtBot, theme: Theme) -> None:
    feed = FakeFeed()
    screen, measuring = live(qtbot, theme, feed)
    run(screen, feed, 1.0)
    record(qtbot, screen, measuring)
    run(screen, feed, 2.0)
    key(qtbot, screen, "F7")
    assert screen.recording.state == "paused"
    run(screen, feed, 3.0)
    key(qtbot, screen, "F7")
    run(screen, feed, 2.0)
    assert screen.recording.recorded_s == pytest.approx(4.0, abs=0.4)


def test_note_and_pain_are_stored_by_keyboard(qtbot: QtBot, theme: Theme) -> None:
    feed = FakeFeed()
    screen, measuring = live(qtbot, theme, feed)
    run(screen, feed, 1.0)
    record(qtbot, screen, measuring)
    screen.controls.refresh()
    key(qtbot, screen, "F5")
    assert screen.note_sheet.isVisible()
    qtbot.keyClicks(screen.note_sheet.line, "strap loose")
    qtbot.keyClick(screen.note_sheet.line, Qt.Key.Key_Return)
    key(qtbot, screen, "F6")
    qtbot.keyClick(screen.pain_sheet.buttons[0], Qt.Key.Key_3)
    assert feed.noted == [("note", "strap loose"), ("pain", "3")]
    assert not screen.pain_sheet.isVisible()


def test_a_recording_that_cannot_start_tells_its_fault_and_shows_no_recording(qtbot: QtBot, theme: Theme) -> None:
    feed = FakeFeed()
    screen, measuring = live(qtbot, theme, feed)
    run(screen, feed, 1.0)
    measuring.fault = DiskFull("disk")
    with qtbot.waitSignal(screen.told) as told:
        key(qtbot, screen, "Space")
    assert isinstance(told.args[0], DiskFull)
    assert screen.recording.state == "off"


def test_lost_frames_show_no_number_and_a_red_light(qtbot: QtBot, theme: Theme) -> None:
    feed = FakeFeed(lost=[(3.0, 20.0)])
    screen, _ = live(qtbot, theme, feed)
    run(screen, feed, 5.0)
    screen._show_values()
    assert math.isnan(screen.number.reading.value_deg)
    assert screen.controls.light.lamp.rank == "bad"
    assert screen.history.angle(1).gaps_s()


def test_predicted_frames_are_marked_and_do_not_count_as_best(qtbot: QtBot, theme: Theme) -> None:
    hidden = [(2.0, 20.0, name) for name in MARKERS[:4]]
    feed = FakeFeed(hidden=hidden)
    screen, measuring = live(qtbot, theme, feed)
    run(screen, feed, 3.0)
    record(qtbot, screen, measuring)
    run(screen, feed, 6.0)
    screen._show_values()
    assert screen.number.reading.predicted
    assert math.isnan(screen.number.reading.best_positive_deg)
    assert screen.controls.light.lamp.rank == "warn"


def test_a_lost_camera_leaves_no_old_picture_and_no_old_number(qtbot: QtBot, theme: Theme) -> None:
    feed = FakeFeed()
    screen, measuring = live(qtbot, theme, feed)
    run(screen, feed, 2.0)
    record(qtbot, screen, measuring)
    screen.set_camera_lost(True)
    screen.tick()
    screen._show_values()
    assert screen.picture.image is None
    assert math.isnan(screen.number.reading.value_deg)
    assert screen.controls.light.lamp.state == "No picture"
    assert screen.recording.state == "paused"


@pytest.mark.parametrize(
    ("since_s", "drawing_ms", "drawn"),
    [
        (math.inf, 5.0, True),
        (-1000.0, 5.0, False),  # too soon after the last drawing
        (1000.0, 4e6, False),  # drawing takes so long that tracking would have no time left
    ],
)
def test_a_new_picture_is_drawn_at_once_but_drawing_never_takes_all_the_time(
    qtbot: QtBot, theme: Theme, since_s: float, drawing_ms: float, drawn: bool
) -> None:
    feed = FakeFeed()
    screen, _ = live(qtbot, theme, feed)
    run(screen, feed, 0.5)
    feed.step(2)
    screen._ticked_at_s, screen._drawing_ms = time.monotonic() - since_s, drawing_ms
    screen.look()
    assert (screen.history.last_index == feed.place) == drawn


def test_f4_changes_between_angles_and_speeds(qtbot: QtBot, theme: Theme) -> None:
    feed = FakeFeed()
    screen, _ = live(qtbot, theme, feed)
    run(screen, feed, 2.0)
    key(qtbot, screen, "F4")
    assert screen.curves.shows_speeds
    assert len(screen.curves.panels()) == 2
    key(qtbot, screen, "F4")
    assert len(screen.curves.panels()) == 3


def test_large_text_on_a_small_screen_keeps_what_is_read_from_afar(qtbot: QtBot, theme: Theme) -> None:
    feed = FakeFeed()
    screen, _ = live(qtbot, theme, feed)
    theme.choose(text_scale=1.5)
    run(screen, feed, 1.0)
    assert not screen.path.isVisible()
    assert screen.number.isVisible()
    assert screen.controls.light.isVisible()


def test_pain_of_ten_is_typed_and_escape_closes_the_card(qtbot: QtBot, theme: Theme) -> None:
    screen, _ = live(qtbot, theme, FakeFeed())
    kept: list[int] = []
    screen.pain_sheet.kept.connect(kept.append)
    for typed, score in (("10", 10), ("7", 7), ("13", 3), ("0", 0)):
        screen.pain_sheet.begin()
        for digit in typed:
            qtbot.keyClick(screen.focusWidget(), digit)
        assert kept[-1] == score
    screen.pain_sheet.begin()
    qtbot.keyClick(screen.focusWidget(), "1")
    qtbot.waitUntil(lambda: kept[-1] == 1)
    screen.pain_sheet.begin()
    qtbot.keyClick(screen.focusWidget(), Qt.Key.Key_Escape)
    assert not screen.pain_sheet.isVisible()
    assert kept == [10, 7, 3, 0, 1]


def test_nothing_offers_to_go_on_while_there_is_no_camera(qtbot: QtBot, theme: Theme) -> None:
    feed = FakeFeed()
    screen, measuring = live(qtbot, theme, feed)
    run(screen, feed, 1.0)
    record(qtbot, screen, measuring)
    screen.set_camera_lost(True)
    assert not screen.controls.pause.isEnabled()
    assert screen.controls.pause.text() == "Pause"
    screen.recording.toggle_pause()
    assert not feed.paused
    screen.set_camera_lost(False)
    assert screen.controls.pause.isEnabled()


@pytest.mark.parametrize(
    ("value_deg", "word"), [(0.4, "Straight"), (-0.4, "Straight"), (0.6, "Flexion"), (-0.6, "Extension")]
)
def test_zero_degrees_name_no_side(qtbot: QtBot, theme: Theme, value_deg: float, word: str) -> None:
    card = NumberCard(theme)
    qtbot.addWidget(card)
    card.show_reading(Reading(angle=1, value_deg=value_deg, sd_deg=1.0))
    assert card.movement() == word


# --- pieces -----------------------------------------------------------------------------------------------
def test_history_keeps_ten_seconds_whatever_comes() -> None:
    feed = FakeFeed()
    history = History(WRIST6)
    history.append(feed.frames)
    history.append(feed.frames)
    series = history.angle(0)
    assert series.time_s[-1] - series.time_s[0] <= KEPT_S
    assert np.all(np.diff(series.time_s) > 0)


def test_the_arm_is_said_to_have_moved_only_outside_the_ball() -> None:
    feed = FakeFeed()
    frames = [with_moment(frame, position_m=np.zeros(3)) for frame in feed.frames[:30]]
    history = History(WRIST6)
    history.append(frames)
    for distance_m, moved in ((0.0149, False), (0.0151, True)):
        step = np.array([0.0, 0.0, distance_m])
        there = with_moment(frames[0], position_m=step)
        history.append([replace(there, index=history.last_index + 1, timestamp_s=history.now_s + 0.03)])
        assert history.forearm_moved() is moved


@pytest.mark.parametrize(("rank", "delay_s"), [("warn", 0.3), ("good", 0.5)])
def test_the_light_changes_only_after_its_delay(rank: str, delay_s: float) -> None:
    other = {"warn": "good", "good": "warn"}[rank]
    light = SteadyLight()
    light.show(Lamp(other, "a", ""), 0.0)  # type: ignore[arg-type]
    wanted = Lamp(rank, "b", "")  # type: ignore[arg-type]
    assert light.show(wanted, 1.0).rank == other
    assert light.show(wanted, 1.0 + delay_s - 0.05).rank == other
    assert light.show(wanted, 1.0 + delay_s) == wanted


def test_a_flicker_never_reaches_the_light_and_red_does_at_once() -> None:
    light = SteadyLight()
    good, warn = Lamp("good", "a", ""), Lamp("warn", "b", "")
    light.show(good, 0.0)
    for step in range(40):
        assert light.show(warn if step % 4 == 0 else good, 1.0 + 0.05 * step) == good
    assert light.show(Lamp("bad", "c", ""), 4.0).rank == "bad"


def test_the_light_names_the_one_hidden_marker_and_its_remedy() -> None:
    frame = FakeFeed(hidden=[(0.0, 99.0, "CMC1")]).frames[10]
    lamp = lamp_for(frame, MARKERS, False)
    assert lamp.state == "Thumb base hidden"
    assert lamp.remedy == "Turn the thumb side up"
    assert lamp_for(replace(frame, status=TrackStatus.LOST), MARKERS, False).rank == "bad"
    assert lamp_for(FakeFeed().frames[10], MARKERS, True).state == "Arm moved"


def test_curves_scroll_on_fixed_scales(qtbot: QtBot, theme: Theme) -> None:
    feed = FakeFeed()
    history = History(WRIST6)
    curves = LiveCurves(theme, history)
    qtbot.addWidget(curves)
    curves.resize(696, 396)
    scales = []
    for end in (60, 200, 590):
        history.append(feed.frames[:end])
        scales.append([(panel.scale.low, panel.scale.high, panel.box) for panel, _ in curves.panels()])
    assert scales[0] == scales[1] == scales[2]


def test_axes_point_along_the_hand_in_the_picture() -> None:
    measuring = FakeMeasuring(FakeFeed())
    frame = measuring.feed.frames[0]
    assert measuring.calibration is not None
    origin, x_end, y_end, _ = axis_pixels(frame, measuring.calibration, measuring.camera)
    discs = measuring.calibration.clicks.pixel
    along = (discs[3] - discs[0]) / np.linalg.norm(discs[3] - discs[0])
    assert np.allclose(origin, discs[0], atol=4.0)
    assert (x_end - origin) @ along > 0.98 * np.linalg.norm(x_end - origin)
    assert (y_end - origin) @ (discs[2] - discs[5]) > 0


def test_the_ellipse_is_two_standard_deviations_of_any_covariance() -> None:
    rng = np.random.default_rng(3)
    for _ in range(20):
        root = rng.normal(0, 6, (2, 2))
        covariance = root @ root.T + 9 * np.eye(2)
        longer, shorter, turn_deg = ellipse(covariance)
        turn = math.radians(turn_deg)
        axes = np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])
        rebuilt = axes @ np.diag([(longer / 2) ** 2, (shorter / 2) ** 2]) @ axes.T
        np.testing.assert_allclose(rebuilt, covariance, rtol=1e-9)


def test_a_letter_outside_the_picture_moves_to_the_nearest_place_inside() -> None:
    box = QRectF(16, 16, 100, 50)
    assert within(QPointF(40, 40), box) == QPointF(40, 40)
    assert within(QPointF(200, 40), box) == QPointF(116, 40)
    assert within(QPointF(0, 500), box) == QPointF(16, 66)


@pytest.mark.parametrize("stored", [False, True])
def test_one_key_starts_and_stops_on_every_source_and_a_hasty_end_asks(
    qtbot: QtBot, theme: Theme, monkeypatch: pytest.MonkeyPatch, stored: bool
) -> None:
    feed = FakeFeed()
    screen, measuring = live(qtbot, theme, feed)
    measuring.starts_with_recording = stored
    asked: list[bool] = []
    screen.recording.hasty.connect(lambda: asked.append(True))
    clock_s = [100.0]
    monkeypatch.setattr(live_recording.time, "monotonic", lambda: clock_s[0])
    key(qtbot, screen, "Space")
    qtbot.waitUntil(lambda: feed.recording and not screen.recording.under_way)
    clock_s[0] += 2.9
    key(qtbot, screen, "Space")
    assert asked == [True]
    assert feed.recording
    assert not screen.recording.under_way
    clock_s[0] += 0.2
    key(qtbot, screen, "Space")
    qtbot.waitUntil(lambda: not feed.recording)
    assert asked == [True]


def test_a_spot_in_plain_sight_is_asked_about_before_its_marker_is_called_hidden(qtbot: QtBot, theme: Theme) -> None:
    feed = FakeFeed()
    screen, measuring = live(qtbot, theme, feed)
    run(screen, feed, 1.0)
    view = feed.newest()
    assert view is not None
    frame = view.tracked
    measured = frame.marker_measured_px.copy()
    measured[3] = np.nan
    hidden = replace(frame, marker_measured_px=measured)
    beside = hidden.marker_predicted_px[3] + [0.0, 15.0]
    pixel = np.vstack((measured[np.isfinite(measured[:, 0])], beside))
    spots = Detections(pixel, *(np.ones((4, len(pixel)))))
    doubt = doubt_of(replace(hidden, detections=spots), MARKERS, measuring.camera)
    assert doubt is not None
    assert (doubt.marker, doubt.hidden, doubt.has_spot) == ("MCP3", True, True)
    np.testing.assert_allclose(doubt.spot_px, beside)
    assert doubt_lamp(doubt).state == "Another blue spot is here"
    assert "middle knuckle" in doubt_lamp(doubt).remedy
    far = replace(spots, pixel=np.vstack((spots.pixel[:-1], beside + 80.0)))
    assert doubt_of(replace(hidden, detections=far), MARKERS, measuring.camera) is None
    questioned = replace(frame, doubted=np.arange(6) == 3, status=TrackStatus.DOUBTFUL)
    doubt = doubt_of(replace(questioned, detections=Detections.none()), MARKERS, measuring.camera)
    assert doubt is not None
    assert (doubt.marker, doubt.hidden, doubt.has_spot) == ("MCP3", False, False)


def test_a_question_about_a_spot_is_answered_while_measuring_goes_on(qtbot: QtBot, theme: Theme) -> None:
    feed = FakeFeed()
    with_other_spot(feed, 3, 1.5, taken=False, off_px=(20.0, 0.0))
    screen, measuring = live(qtbot, theme, feed)
    record(qtbot, screen, measuring)
    run(screen, feed, 1.5)
    parts = (screen.picture, screen.path, screen.number, screen.curves, screen.controls.light)
    places = [widget.geometry() for widget in parts]
    assert screen.question.isHidden()
    angle = screen.number.reading.angle
    for _ in range(12):  # whatever the rhythm in which values are shown
        run(screen, feed, 0.1)
        if screen.question.isVisible():
            break
    assert screen.question.words.text() == "Is this blue spot the middle knuckle?"
    assert [button.text() for button in screen.question.buttons.values() if button.isVisible()] == ["Yes", "No"]
    assert screen.controls.light.lamp == Lamp("warn", "Another blue spot is here", "Is it the middle knuckle?")
    qtbot.keyClick(screen, Qt.Key.Key_F2)
    assert not measuring.answers, "a key that was meant for something else a moment ago"
    run(screen, feed, 0.6)
    qtbot.keyClick(screen, Qt.Key.Key_F2)
    shown = feed.newest()
    assert shown is not None
    (answer,) = measuring.answers
    assert (answer.marker, answer.not_px) == ("MCP3", ())
    told = feed.frames[answer.index]
    np.testing.assert_allclose(answer.place_px or (), told.detections.pixel[-1])
    assert shown.tracked.index - answer.index <= 6, "of a picture shown a moment ago"
    assert screen.question.isHidden()
    assert feed.recording
    assert screen.number.reading.angle == angle
    assert [widget.geometry() for widget in parts] == places, "nothing jumps"
    run(screen, feed, 1.2)
    qtbot.mouseClick(screen.question.buttons["none"], Qt.MouseButton.LeftButton)
    assert measuring.answers[-1].place_px is None
    assert len(measuring.answers[-1].not_px) == 1
    feed.frames[feed.place + 1 :] = feed.frames[:10]
    qtbot.keyClick(screen, Qt.Key.Key_F2)
    assert screen.number.reading.angle != angle, "without a question the key does what it did"


def test_a_question_stands_only_after_it_has_lasted() -> None:
    steady, unknown = SteadyDoubt(), np.full(2, np.nan)
    doubt = Doubt("MCP3", unknown, np.array([1.0, 2.0]))
    shown = [steady.show(doubt if 0.1 <= t < 0.3 or t >= 1.0 else None, t) is not None for t in np.arange(0, 2, 0.05)]
    assert not any(shown[:25])
    assert all(shown[27:])
    gone = [steady.show(None, t) is not None for t in np.arange(2, 2.6, 0.05)]
    assert gone[:5] == [True] * 5
    assert not gone[-1]


def test_a_busy_computer_shows_the_newest_picture_and_says_how_late_the_figures_are(qtbot: QtBot, theme: Theme) -> None:
    feed = LateFeed()
    screen, measuring = live(qtbot, theme, feed)
    shown: list[object] = []
    run(screen, feed, 1.0)
    record(qtbot, screen, measuring)
    feed.ahead_s, feed.dropped = 4.0, 3  # dropped before it was recorded
    screen._show_slow()
    run(screen, feed, 0.5)
    screen._show_values()
    late = Lamp("idle", "The figures are 4 s late", "The computer is busy; every picture is kept")
    assert screen.controls.light.lamp == late
    assert math.isnan(screen.glance().value_deg)
    newest = feed.newest_frame()
    feed.newest_frame = lambda: newest  # type: ignore[method-assign]
    screen.picture.show_frame = shown.append  # type: ignore[method-assign, assignment]
    screen.tick()
    assert newest is not None
    assert shown[-1] is newest.color_rgb
    del feed.newest_frame
    del screen.picture.show_frame
    feed.dropped = 8
    screen._show_slow()
    screen.tick()
    screen._show_values()
    assert screen.controls.light.lamp.rank == "warn"
    assert screen.controls.light.lamp.remedy.startswith("5 pictures are missing")
    feed.ahead_s = 0.0
    run(screen, feed, 0.5)
    screen._show_values()
    assert "late" not in screen.controls.light.lamp.state


def test_a_stop_says_how_long_catching_up_takes(qtbot: QtBot, theme: Theme) -> None:
    feed = LateFeed()
    screen, measuring = live(qtbot, theme, feed)
    run(screen, feed, 1.0)
    record(qtbot, screen, measuring)
    caught_up = threading.Event()
    measuring.stop_recording = lambda: "session-7" if caught_up.wait(60.0) else ""  # type: ignore[method-assign]
    feed.waiting = 1200
    with qtbot.waitSignal(screen.recording.stopped, timeout=60_000):
        screen.recording.stop()
        screen._show_values()
        assert screen.controls.main.text() == "Catching up: 12 s left"
        assert screen.catching_up.isVisible()
        assert not screen.controls.note.isEnabled()
        assert not screen.controls.pause.isEnabled()
        feed.waiting = 300
        screen._show_values()
        assert screen.controls.main.text() == "Catching up: 3 s left"
        assert (screen.catching_up.value(), screen.catching_up.maximum()) == (900, 1200)
        feed.waiting = 0
        screen._show_values()
        assert screen.controls.main.text() == "Storing…"
        caught_up.set()
    assert not screen.catching_up.isVisible()
