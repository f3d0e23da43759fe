"""Every screen stands in the table of places: it has a page of the guide, and whoever leads to it names it as it is. It
is made when it is first gone to, and is then as if it had been there from the start."""

from __future__ import annotations

import re
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from PySide6.QtCore import QEvent, QObject
from PySide6.QtWidgets import QLabel, QPushButton, QWidget
from pytestqt.qtbot import QtBot

from carpus.app.desktop import window
from carpus.app.desktop.screens import PLACES, SLOW_CORE_MODULES, load_core, load_screens
from carpus.app.desktop.window import Desktop
from carpus.ui.screens.help import guide
from carpus.ui.shell.flow import OVERLAYS, PATIENT_TABS, SETUP_STEPS
from tests.ui.gallery import STATES

ROOT = Path(__file__).parents[2]
OPENED = r'(?:way|navigator)\.(?:open_screen|open_overlay|switch_screen|open_under_overlay)\(\s*"(\w+)"'
NAMED = re.compile(OPENED + r'|\b(?:place|screen_name) (?:==|!=) "(\w+)"')
LED = re.compile(OPENED)

Looks = dict[tuple[str, str], set[tuple[int, str]]]


def seen(desktop: Desktop, *places: str) -> dict[str, Looks]:
    """Size and ground of each text of each screen, or of some, brought to the front; missing ones are made."""
    navigator = desktop.controller.navigator
    every = places or sorted({*navigator.factories} - {"patients"})
    return {place: looks(desktop, navigator.flow(place).screen) for place in every}


def looks(desktop: Desktop, screen: QWidget) -> Looks:
    desktop.shell.show_screen(screen)
    desktop.application.processEvents()
    out: Looks = {}
    for one in (screen, *screen.findChildren(QWidget)):
        if one is screen or one.isVisibleTo(screen):
            text = one.text() if isinstance(one, QLabel | QPushButton) else one.accessibleName()
            look = one.font().pixelSize(), one.palette().window().color().name()
            out.setdefault((type(one).__name__, text), set()).add(look)
    return out


def same(some: Looks, others: Looks) -> bool:
    """Whether what both show looks the same; how much room there is decides of some parts whether they are shown."""
    both = some.keys() & others.keys()
    return len(both) > 0.6 * len(some) and all(some[one] == others[one] for one in both)


class ShownWindows(QObject):
    """Takes down what comes up as a window."""

    def __init__(self) -> None:
        super().__init__()
        self.seen: list[str] = []

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802  (Qt's name)
        if event.type() == QEvent.Type.Show and isinstance(watched, QWidget) and watched.isWindow():
            self.seen.append(type(watched).__name__)
        return False


def test_start_makes_no_screen_but_first_and_loads_others_in_windows_thread(
    open_desktop: Callable[..., Desktop], qtbot: QtBot, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """Two threads that name classes of Qt for the first time at once end the process."""
    loaded: dict[str, threading.Thread] = {}

    def noted(real: Callable[[], Iterator[str]]) -> Iterator[str]:
        for one in real():
            loaded[one] = threading.current_thread()
            yield one

    monkeypatch.setattr(window, "load_core", lambda: noted(load_core))
    monkeypatch.setattr(window, "load_screens", lambda: noted(load_screens))
    desktop = open_desktop()
    assert set(desktop.controller.navigator.flows) == {"patients"}
    desktop._preload()
    qtbot.waitUntil(lambda: {*SLOW_CORE_MODULES, *PLACES} <= set(loaded))
    assert {loaded[place] for place in PLACES} == {threading.main_thread()}
    assert threading.main_thread() not in {loaded[module] for module in SLOW_CORE_MODULES}
    desktop.close()
    assert set(desktop.controller.navigator.flows) == {"patients"}
    code = (
        f"import sys, importlib; [importlib.import_module(one) for one in {SLOW_CORE_MODULES!r}]; print(*sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert not [one for one in done.stdout.split() if one.startswith(("PySide6", "carpus.ui"))]


CHOSEN = {"theme": "dark", "text_scale": 1.25, "research": True, "start": "still", "patient_sound": True}


def choose(desktop: Desktop, **chosen: Any) -> None:
    desktop.preferences.apply(replace(desktop.preferences.screen.preferences, **chosen))


def all_made(desktop: Desktop) -> None:
    """Every screen has a page of the guide and a picture, and every place that is named is there."""
    windows, way = ShownWindows(), desktop.controller.navigator
    assert {*SETUP_STEPS, *PATIENT_TABS, *OVERLAYS, "patients"} <= set(way.factories)
    desktop.application.installEventFilter(windows)
    flows = [way.flow(place) for place in way.factories]
    desktop.application.removeEventFilter(windows)
    assert windows.seen == [], "parts of a screen that come up as windows while it is made"
    assert {flow.screen_name: flow for flow in flows} == way.flows
    assert {flow.guide_page for flow in flows} <= set(guide.PAGES)
    assert {flow.parent_tab for flow in flows} <= {*PATIENT_TABS, ""}
    sources = [path.read_text("utf-8") for part in ("app", "ui") for path in (ROOT / part).rglob("*.py")]
    named = {one for text in sources for found in NAMED.findall(text) for one in found if one}
    assert "review" in named
    assert named <= set(way.factories)
    led = {one for text in sources for one in LED.findall(text)} | {*SETUP_STEPS, *PATIENT_TABS}
    assert set(way.factories) - led == set(), "screens that nobody leads to"
    shown = {place for place in way.factories for state in STATES if f"{state}_".startswith(f"{place}_")}
    assert set(way.factories) - shown == set(), "screens without a picture"


def test_preferences_reach_screens_created_later(open_desktop: Callable[..., Desktop]) -> None:
    early, late = open_desktop(), open_desktop()
    all_made(early)
    before = seen(early, "settings", "sessions", "live")
    for desktop in (early, late):
        choose(desktop, **CHOSEN)
    after = seen(early)
    assert not any(same(after[place], looks) for place, looks in before.items())
    assert "live" not in late.controller.navigator.flows
    made_later = seen(late)
    assert [place for place in after if not same(after[place], made_later[place])] == []
    for desktop in (early, late):
        assert desktop.controller.live.screen.recording.start_mode == "still"
