"""The language is changed while the program runs: the window closes, to be opened again."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from pytestqt.qtbot import QtBot

from carpus.app.desktop.window import Desktop
from carpus.app.settings import ScreenSettings, Settings, load_settings
from carpus.ui.kit import language
from carpus.ui.kit.text import Text


@pytest.fixture
def desktop(open_desktop: Callable[..., Desktop]) -> Iterator[Desktop]:
    yield open_desktop(Settings(screen=ScreenSettings("light", language="en")))
    language.set_window_language("en")


def texts(desktop: Desktop) -> set[str]:
    return {text.text() for text in desktop.preferences.screen.findChildren(Text)}


def test_language_changes_only_while_nothing_is_at_work(qtbot: QtBot, desktop: Desktop, tmp_path: Path) -> None:
    at_work = [True]
    desktop.preferences.find_language_obstacle = lambda: "Not now." if at_work[0] else ""
    desktop.controller.navigator.open_screen("settings")
    german = desktop.preferences.screen.form["language"].buttons()[list(language.LANGUAGES).index("de")]
    german.click()
    assert "Not now." in texts(desktop)
    assert desktop.preferences.screen.form["language"].value() == "en"
    assert desktop.find_language_obstacle() == ""
    at_work[0] = False
    german.click()
    qtbot.waitUntil(lambda: desktop.is_closed)
    assert desktop.must_reopen
    assert load_settings(tmp_path / "settings").screen.language == "de"


def test_camera_that_waits_behind_the_review_keeps_no_language(
    desktop: Desktop, monkeypatch: pytest.MonkeyPatch
) -> None:
    with monkeypatch.context() as waiting:
        waiting.setattr(desktop.controller.current, "source", object())
        for place, refused in (("review", False), ("sessions", False), ("markers", True), ("live", True)):
            waiting.setattr(type(desktop.controller.navigator), "underlying_screen", place)
            assert bool(desktop.find_language_obstacle()) is refused, place
