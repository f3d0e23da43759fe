"""A recording begins with no hand at the keyboard: over a still hand, counted down, and taken back by one key."""

from __future__ import annotations

import math

import numpy as np
import pytest
from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot

from carpus.core.pipeline.live_values import StartMode
from carpus.ui.live.recording import COUNT_S, STILL_DEG, STILL_S, Beginning
from carpus.ui.live.screen import LiveScreen
from carpus.ui.theme import Theme
from tests.ui.fakes import FakeFeed, FakeMeasuring
from tests.ui.test_live import live, run

FPS = 30.0


def begun(beginning: Beginning, angle_deg, until_s: float, from_s: float = 0.0) -> float:  # type: ignore[no-untyped-def]
    """When it says that the recording begins; NaN for never."""
    for number in range(round(from_s * FPS), round(until_s * FPS)):
        now_s = number / FPS
        value = angle_deg(now_s)
        if beginning.take(None if value is None else np.array([value, 1.0, math.nan]), now_s):
            return now_s
    return math.nan


def test_a_hand_begins_only_once_it_lies_still_and_is_counted_down() -> None:
    beginning = Beginning()
    assert math.isnan(begun(beginning, lambda _: 0.0, 60.0)), "nobody asked for it"
    noise = np.random.default_rng(7).normal(0.0, 0.5, 2000)
    beginning.wait()
    at_s = begun(beginning, lambda t: 30.0 * math.sin(t) if t < 10.0 else 20.0 + noise[round(t * FPS)], 60.0)
    assert at_s == pytest.approx(10.0 + STILL_S + COUNT_S, abs=0.5)
    assert (beginning.waits, beginning.counts, beginning.left_s(at_s)) == (False, False, 0)


@pytest.mark.parametrize("what", ["moves", "lost"])
def test_a_hand_that_moves_or_goes_while_it_is_counted_waits_again(what: str) -> None:
    beginning = Beginning()
    beginning.wait()
    assert math.isnan(begun(beginning, lambda _: 0.0, STILL_S + 1.0))
    assert beginning.left_s(STILL_S + 1.0) == 3 - 1
    disturbed = 4.0 * STILL_DEG if what == "moves" else None
    assert math.isnan(begun(beginning, lambda _: disturbed, STILL_S + 1.2, STILL_S + 1.0))
    assert (beginning.waits, beginning.counts) == (True, False)
    assert begun(beginning, lambda _: 0.0, 60.0, STILL_S + 1.2) >= 2.0 * STILL_S + COUNT_S


def test_after_the_key_it_is_counted_whatever_the_hand_does() -> None:
    beginning = Beginning()
    beginning.count(5.0)
    assert [beginning.left_s(time_s) for time_s in (5.0, 6.5, 7.9)] == [3, 2, 1]
    assert begun(beginning, lambda t: 40.0 * math.sin(3.0 * t), 60.0, 5.0) == pytest.approx(5.0 + COUNT_S, abs=0.05)


def shown(qtbot: QtBot, theme: Theme, mode: StartMode) -> tuple[LiveScreen, FakeFeed]:
    feed = FakeFeed(speed_hz=0.01)  # all but still
    screen, measuring = live(qtbot, theme, feed)
    screen.recording.start_mode = mode
    screen.begin(measuring, screen.recording.set_up)  # type: ignore[arg-type]
    screen._timer.stop()
    return screen, feed


@pytest.mark.parametrize("key", [Qt.Key.Key_Space, Qt.Key.Key_PageDown])
def test_the_key_or_a_pedal_counts_down_and_takes_back(qtbot: QtBot, theme: Theme, key: Qt.Key) -> None:
    screen, feed = shown(qtbot, theme, "countdown")
    run(screen, feed, 1.0)
    qtbot.keyClick(screen, key)
    assert screen.controls.main.text() == "Starts in 3: not yet"
    run(screen, feed, 1.5)
    assert (screen.controls.main.text(), screen.glance().starts_s) == ("Starts in 2: not yet", 2)
    qtbot.keyClick(screen, key)
    run(screen, feed, 6.0)
    assert (screen.controls.main.text(), feed.recording) == ("Record", False)
    qtbot.keyClick(screen, key)
    run(screen, feed, COUNT_S + 0.2)
    qtbot.waitUntil(lambda: feed.recording, timeout=60_000)


def test_over_a_still_hand_a_recording_begins_by_itself_but_in_no_rest(qtbot: QtBot, theme: Theme) -> None:
    screen, feed = shown(qtbot, theme, "still")
    screen.recording.rest(on=True)
    run(screen, feed, 6.0)
    assert not screen.recording.beginning.waits
    screen.recording.rest(on=False)
    run(screen, feed, 1.0)
    assert "Starts by itself when the hand lies still" in screen.controls.light.lamp.remedy
    run(screen, feed, STILL_S + COUNT_S)
    qtbot.waitUntil(lambda: feed.recording and screen.recording.count is not None, timeout=60_000)
    assert screen.controls.main.text() == "Stop and review"


def test_a_stored_recording_is_played_at_once(qtbot: QtBot, theme: Theme, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(FakeMeasuring, "starts_with_recording", True)
    screen, feed = shown(qtbot, theme, "countdown")
    run(screen, feed, 1.0)
    qtbot.keyClick(screen, Qt.Key.Key_Space)
    qtbot.waitUntil(lambda: feed.recording, timeout=60_000)
