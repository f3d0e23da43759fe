"""The language is changed while the program runs: everything is put together again, at the same place."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from PySide6.QtWidgets import QSplashScreen
from pytestqt.qtbot import QtBot

from carpus.app.compose import Desktop
from carpus.app.settings import ScreenSettings, Settings, load_settings
from carpus.ui import language
from carpus.ui.controls.text import Text


@pytest.fixture
def desktop(open_desktop: Callable[..., Desktop]) -> Iterator[Desktop]:
    yield open_desktop(Settings(screen=ScreenSettings("light", language="en")))
    language.speak("en")


def texts(desktop: Desktop) -> set[str]:
    return {text.text() for text in desktop.keeper.screen.findChildren(Text)}


def test_another_language_at_the_same_place_and_none_while_something_is_at_work(
    qtbot: QtBot, desktop: Desktop, tmp_path: Path
) -> None:
    at_work = [True]
    desktop.keeper.keeps_language = lambda: "Not now." if at_work[0] else ""
    desktop.journey.way.show("settings")
    german = desktop.keeper.screen.language.buttons()[list(language.LANGUAGES).index("de")]
    german.click()
    assert "Not now." in texts(desktop)
    assert desktop.keeper.screen.language.value() == "en"
    assert desktop.why_no_other_language() == ""
    at_work[0] = False
    old = desktop.journey
    german.click()
    qtbot.waitUntil(lambda: desktop.journey is not old, timeout=60_000)
    assert desktop.journey.place == "settings"
    assert "Einstellungen" in texts(desktop)
    assert not desktop.closed
    assert desktop.shell.isVisible()
    assert load_settings(tmp_path / "settings").screen.language == "de"
    desktop.journey.way.back()
    assert desktop.journey.place == "patients"
    desktop.shell.close_surely()
    assert desktop.closed


def test_a_camera_that_waits_behind_the_review_keeps_no_language_and_a_window_that_cannot_be_built_no_picture(
    desktop: Desktop, monkeypatch: pytest.MonkeyPatch
) -> None:
    with monkeypatch.context() as waiting:
        waiting.setattr(desktop.journey.now, "source", object())
        for place, refused in (("review", False), ("sessions", False), ("markers", True), ("live", True)):
            waiting.setattr(type(desktop.journey.way), "behind", place)
            assert bool(desktop.why_no_other_language()) is refused, place

    def fails(*_: object, **__: object) -> Desktop:
        raise RuntimeError

    ended = list[int]()
    monkeypatch.setattr(desktop, "anew", fails)
    monkeypatch.setattr(desktop.application, "exit", ended.append)
    with pytest.raises(RuntimeError):
        desktop.speak_anew()
    assert ended == [1]
    shown = [widget for widget in desktop.application.topLevelWidgets() if isinstance(widget, QSplashScreen)]
    assert not any(widget.isVisible() for widget in shown)
