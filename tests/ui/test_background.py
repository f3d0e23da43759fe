"""Work beside the window's thread."""

from __future__ import annotations

import gc
import weakref

import pytest
from pytestqt.qtbot import QtBot

from carpus.ui.kit.background import Background


@pytest.mark.parametrize("fails", [False, True])
def test_background_releases_answered_callers(qtbot: QtBot, background: Background, *, fails: bool) -> None:
    """A window that stands open for days asks ten thousand times."""

    def ask() -> weakref.ref[Asks]:
        asks = Asks()
        background.run(lambda: 1 // (not fails), asks.take, asks.take)
        qtbot.waitUntil(lambda: asks.answered is not None)
        assert isinstance(asks.answered, ZeroDivisionError if fails else int)
        return weakref.ref(asks)

    kept = ask()

    def is_gone() -> bool:
        gc.collect()
        return kept() is None

    qtbot.waitUntil(is_gone)


class Asks:
    answered: object = None

    def take(self, answer: object) -> None:
        self.answered = answer
