"""Opening a source: what is prepared beforehand gives way to what a person waits for, and there is one bar."""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

from pytestqt.qtbot import QtBot

from carpus.app.desktop.opening import Opener
from carpus.core.library.set_up import SetUp
from carpus.core.output.exercises import exercise_named
from carpus.ui.setup.choice import SourceChoice
from tests.ui.fakes import set_up


class SlowSources:
    """Renders when told; an opening of the take that was rendered is there at once."""

    def __init__(self) -> None:
        self.begun = threading.Event()
        self.go_on = threading.Event()
        self.prepared = 0

    def prepare_practice(self, _: SetUp, progress: Callable[[int, int], None]) -> None:
        for done in range(100):
            progress(done, 1000)
            self.begun.set()
            self.go_on.wait(5.0)
            self.prepared = done

    def open(self, choice: SourceChoice, set_up: SetUp, progress: Callable[[int, int], None]) -> Any:
        progress(7, 10)
        return SimpleNamespace(name=choice.kind)


def begun(qtbot: QtBot) -> tuple[Opener, SlowSources, list[int]]:
    sources = SlowSources()
    opener = Opener(sources)  # type: ignore[arg-type]
    seen: list[int] = []
    opener.progressed.connect(lambda done, total: seen.append(round(1000 * done / total)))
    opener.prepare(set_up("FIST_COMPOSITE"))
    assert sources.begun.wait(5.0)
    qtbot.waitUntil(lambda: seen == [0])
    return opener, sources, seen


def test_opening_something_else_ends_the_preparation_and_the_bar_is_its_own(qtbot: QtBot) -> None:
    opener, sources, seen = begun(qtbot)
    with qtbot.waitSignal(opener.opened):
        opener.open(SourceChoice("camera"), set_up("FIST_COMPOSITE"))
        seen.clear()
        sources.go_on.set()
    assert sources.prepared == 0
    assert seen == [700]


def test_opening_what_is_prepared_waits_for_it(qtbot: QtBot) -> None:
    opener, sources, _ = begun(qtbot)
    with qtbot.waitSignal(opener.opened):
        opener.open(SourceChoice("practice"), set_up("FIST_COMPOSITE"))
        sources.go_on.set()
    assert sources.prepared == 99


def test_another_exercise_or_hand_is_another_take(qtbot: QtBot) -> None:
    for other in (
        replace(set_up("FIST_COMPOSITE"), exercise=exercise_named("FIST_HOOK")),
        replace(set_up("FIST_COMPOSITE"), side="left" if set_up("FIST_COMPOSITE").side == "right" else "right"),
    ):
        opener, sources, _ = begun(qtbot)
        with qtbot.waitSignal(opener.opened):
            opener.open(SourceChoice("practice"), other)
            sources.go_on.set()
        assert sources.prepared == 0
