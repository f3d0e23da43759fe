"""The live screen on a simulated feed, as a test lets time pass on it and presses its keys."""

from __future__ import annotations

from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot

from carpus.core.records.session_setup import SessionSetup
from carpus.ui.screens.live.number_card import Reading
from carpus.ui.screens.live.recording import MIN_RECORDING_S
from carpus.ui.screens.live.screen import LiveScreen
from tests.ui.fakes import FakeFeed, FakeMeasuring


class TriedLive:
    """A shown screen whose time passes only in :meth:`run`."""

    def __init__(self, qtbot: QtBot, screen: LiveScreen, feed: FakeFeed, set_up: SessionSetup) -> None:
        self.screen, self.feed = screen, feed
        self._qtbot = qtbot
        self.measuring = FakeMeasuring(feed)
        feed.picture_number = 0
        self.begin(set_up)

    def begin(self, set_up: SessionSetup) -> None:
        self.screen.open_source(self.measuring, set_up)
        self.screen._timer.stop()

    def run(self, seconds: float) -> None:
        for _ in range(round(seconds * 30 / 2)):
            self.feed.step(2)
            self.screen.draw()

    def press(self, key: Qt.Key) -> None:
        self._qtbot.keyClick(self.screen, key)

    def record(self) -> None:
        """A recording that began a moment ago."""
        self.press(Qt.Key.Key_Space)
        self._qtbot.waitUntil(lambda: self.screen.recording.counter is not None)
        self.screen.recording._started_at_s -= MIN_RECORDING_S
        assert self.feed.is_recording

    def reading(self) -> Reading:
        """The large number now."""
        self.screen._show_values()
        return self.screen.number_card.reading
