"""Formats are ticked, a folder is asked for, the sheet shows how far it is, and Stop ends it."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFileDialog, QWidget
from pytestqt.qtbot import QtBot

from carpus.app.desktop.printing import Printing
from carpus.app.desktop.report_forms import ReportForms
from carpus.core.formats.formats import FORMATS
from carpus.core.records.store import Store
from carpus.ui.background import Background
from carpus.ui.keys import Keys
from carpus.ui.last_places import LastPlaces
from carpus.ui.report.screen import ReportScreen
from carpus.ui.theme import Theme


class Told:
    """What the person was told and asked."""

    def __init__(self) -> None:
        self.faults: list[Exception] = []
        self.asked: list[object] = []

    def fault(self, fault: Exception) -> None:
        self.faults.append(fault)

    def ask(self, words: object, answers: object, *, icon: str = "") -> None:
        self.asked.append(words)


class Stored:
    """Writes nothing, and waits where it is told to until it is stopped."""

    def __init__(self) -> None:
        self.calls: list[tuple[Sequence[str], bool]] = []
        self.waits = threading.Event()
        self.waits.set()

    def export(
        self, session_id: str, folder: str, formats: Sequence[str], progress: Callable[[int, int], None],
        cancelled: Callable[[], bool], deidentified: bool, software_version: str,
    ) -> Sequence[str]:  # fmt: skip
        self.calls.append((formats, deidentified))
        progress(1, 2)
        while not self.waits.wait(0.005):
            if cancelled():
                return []
        progress(2, 2)
        return ["s.wrist.csv"]


@pytest.fixture
def parts(
    qtbot: QtBot, theme: Theme, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Iterator[tuple[Printing, Stored, Told, Background]]:
    window = QWidget()
    qtbot.addWidget(window)
    window.resize(1280, 800)
    background, stored, told = Background(), Stored(), Told()
    screen = ReportScreen(theme, Keys({}), background)
    qtbot.addWidget(screen)
    monkeypatch.setattr(QFileDialog, "getExistingDirectory", lambda *_: str(tmp_path))
    store = Store(tmp_path)
    printing = Printing(
        window, screen, None, told, None, stored, LastPlaces(store), background,  # type: ignore[arg-type]
        theme=theme, therapist=lambda: "", forms=ReportForms(window, theme, store, told.fault),
    )  # fmt: skip
    window.show()
    yield printing, stored, told, background
    store.close()


def test_every_format_is_offered_and_what_is_ticked_is_written(qtbot: QtBot, parts: tuple) -> None:  # type: ignore[type-arg]
    printing, stored, told, _ = parts
    printing.export("s1")
    assert set(printing.formats.boxes) == set(FORMATS)
    assert printing.formats.formats == ["csv"]
    printing.formats.boxes["csv"].click()
    assert not printing.formats.take.isEnabled(), "nothing to write"
    printing.formats.boxes["c3d"].click()
    printing.formats.nobody.click()
    printing.formats.take.click()
    qtbot.waitUntil(lambda: bool(told.asked))
    assert stored.calls == [(["c3d"], True)]
    assert not printing.formats.isVisible()
    assert not told.faults


def test_enter_goes_on_and_changes_no_choice(qtbot: QtBot, parts: tuple) -> None:  # type: ignore[type-arg]
    printing, stored, told, _ = parts
    printing.export("s1")
    printing.formats.boxes["trc"].click()
    qtbot.keyClick(printing.formats.boxes["trc"], Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: bool(told.asked))
    assert stored.calls == [(["csv", "trc"], False)]


def test_it_shows_how_far_it_is_and_stops(qtbot: QtBot, parts: tuple) -> None:  # type: ignore[type-arg]
    printing, stored, told, background = parts
    stored.waits.clear()
    printing.export("s1")
    printing.formats.take.click()
    qtbot.waitUntil(lambda: printing.formats.bar.value() == 1)
    assert printing.formats.bar.maximum() == 2
    assert not printing.formats.take.isVisible()
    qtbot.keyClick(printing.formats, Qt.Key.Key_Escape)
    qtbot.waitUntil(lambda: not printing.formats.isVisible())
    assert background.wait()
    assert not told.asked, "nothing was written, so nothing is said to be"
