"""The real application, put together as for a user, in a data folder of the test's own."""

from __future__ import annotations

import os

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from carpus.app.desktop.appearance import create_application
from carpus.app.desktop.window import Desktop
from carpus.app.settings import RecordingSettings, ScreenSettings, Settings
from carpus.core.pipeline import smoothing
from carpus.ui.screens.live import recording as live_recording
from carpus.ui.screens.live import screen as live_screen
from carpus.ui.screens.markers import screen as markers_screen
from tests.journeys.takes import SPEED, build_take
from tests.rendered import REPEATED_FLEXION, Rendered

DRAWN_EVERY_MS = 200
Open = Callable[..., Desktop]


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """One after the other: each keeps two cores busy in real time, and the take is rendered once."""
    for item in items:
        if item.path.parent == Path(__file__).parent:
            item.add_marker(pytest.mark.xdist_group("journeys"))


@pytest.fixture(autouse=True)
def patience(monkeypatch: pytest.MonkeyPatch) -> None:
    """A loaded computer may take long to start a process; whether it is done in time is not what is tested. Nor is how
    smoothly it is drawn: a core that draws thirty times a second is one less for all that is waited for."""
    monkeypatch.setattr(smoothing, "FINISH_TIMEOUT_S", 150.0)
    monkeypatch.setattr(live_recording, "MIN_RECORDING_S", 0.0)  # a take is over in a few seconds
    monkeypatch.setattr(live_screen, "MIN_DRAW_INTERVAL_MS", DRAWN_EVERY_MS)
    monkeypatch.setattr(live_screen, "MAX_TICK_INTERVAL_MS", DRAWN_EVERY_MS)
    monkeypatch.setattr(markers_screen, "PREVIEW_EVERY_MS", DRAWN_EVERY_MS)


@pytest.fixture(scope="session")
def take(rendered: Rendered) -> Path:
    """Folder of the short take."""
    return rendered(REPEATED_FLEXION)


@pytest.fixture
def data(tmp_path: Path) -> Path:
    """The data folder."""
    return tmp_path / "data"


@pytest.fixture
def open_desktop(open_desktop: Open, take: Path) -> Open:
    """As that of all tests, with the take in the simulated patient's place; may be called again after closing."""
    create_application([])
    usual = Settings(screen=ScreenSettings("light"), recording=RecordingSettings(keep_pictures=False))

    def open_one(settings: Settings = usual, **options: Any) -> Desktop:
        return open_desktop(settings, **{"practice_renderer": build_take(take), "speed": SPEED} | options)

    return open_one
