"""Every test here runs without a display and with the bundled fonts only."""

from __future__ import annotations

import os

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

from collections.abc import Callable, Iterator
from typing import TypeVar

import pytest
from PySide6.QtCore import QLocale, Qt
from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.qtbot import QtBot

from carpus.core.records.session_setup import SessionSetup
from carpus.ui.kit.background import Background
from carpus.ui.kit.dialog import Dialog
from carpus.ui.kit.fonts import load_fonts
from carpus.ui.kit.style import apply_style
from carpus.ui.kit.theme import Theme
from carpus.ui.screens.live.number_card import Reading
from carpus.ui.screens.live.recording import MIN_RECORDING_S
from carpus.ui.screens.live.screen import LiveScreen
from carpus.ui.screens.review.screen import ReviewScreen
from tests.ui.fakes import FakeFeed, FakeMeasuring, FakeSessions, figures_once, set_up


class TriedLive:
    """The live screen on a simulated feed, whose time passes only in :meth:`run`."""

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


WidgetT = TypeVar("WidgetT", bound=QWidget)
Show = Callable[..., WidgetT]
"""What :func:`show` gives: a widget, and whether it is ``active``."""
Live = Callable[..., TriedLive]
"""What :func:`live` gives: a feed, and seconds of it."""
Reviewing = Callable[[FakeSessions, str], ReviewScreen]
"""What :func:`review` gives: a store, and a session of it."""


@pytest.fixture(autouse=True)
def _bundled_fonts(qapp: QApplication) -> None:
    qapp.setStyle("Fusion")
    QLocale.setDefault(QLocale(QLocale.Language.English, QLocale.Country.UnitedKingdom))
    load_fonts()


@pytest.fixture(autouse=True)
def _figures_made_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every screen and page of a session works out its figures anew, as each is shown once; here the same few are shown
    hundreds of times."""
    screens = ("screens.review.reviewed_session", "screens.correct.screen")
    for place in ("report.session_page", *screens):
        monkeypatch.setattr(f"carpus.ui.{place}.compute_session_results", figures_once)


@pytest.fixture
def theme(qapp: QApplication) -> Theme:
    """The light theme at 100 %, applied."""
    chosen = Theme("light")
    apply_style(qapp, chosen)
    return chosen


@pytest.fixture
def background(qtbot: QtBot) -> Iterator[Background]:
    """Idle before the screens go, as the program waits before it ends."""
    background = Background()
    yield background
    qtbot.waitUntil(lambda: not background.is_busy)


@pytest.fixture
def show(qtbot: QtBot) -> Show[WidgetT]:
    """Shows a screen as large as a window of 1280x800 leaves it; ``active``, it has the keyboard."""

    def show_one(widget: WidgetT, *, active: bool = False) -> WidgetT:
        qtbot.addWidget(widget)
        widget.resize(1280, 744)
        widget.show()
        if active:
            widget.activateWindow()
            qtbot.waitUntil(widget.isActiveWindow)
        return widget

    return show_one


@pytest.fixture
def host(show: Show[QWidget]) -> Iterator[QWidget]:
    """What sheets lie over, which go with it."""
    widget = show(QWidget(), active=True)
    yield widget
    for sheet in widget.findChildren(Dialog):
        sheet.close_dialog()


@pytest.fixture
def live(qtbot: QtBot, theme: Theme, show: Show[LiveScreen]) -> Live:
    """The live screen on a feed of which some seconds have passed: flexion, or a full fist of the whole hand."""

    def one(feed: FakeFeed, seconds: float = 0.0) -> TriedLive:
        screen = show(LiveScreen(theme, Background()), active=True)
        whole_hand = feed.pictures.spec.protocol == "hand21"
        tried = TriedLive(qtbot, screen, feed, set_up("FIST_COMPOSITE", 90.0) if whole_hand else set_up())
        tried.run(seconds)
        return tried

    return one


@pytest.fixture
def review(qtbot: QtBot, theme: Theme, show: Show[ReviewScreen], background: Background) -> Iterator[Reviewing]:
    """The review of a session with its first picture, stopped at the end."""
    screens: list[ReviewScreen] = []

    def one(store: FakeSessions, session_id: str) -> ReviewScreen:
        screens.append(screen := show(ReviewScreen(theme, background, store), active=True))
        screen.load_session("linden", session_id)
        qtbot.waitUntil(lambda: screen.is_loaded and screen.frame_view.image is not None)
        return screen

    yield one
    for screen in screens:
        screen.playing.stop()
