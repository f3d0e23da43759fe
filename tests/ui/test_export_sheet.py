"""Formats are ticked, a folder is asked for, the sheet shows how far it is, and Stop ends it."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFileDialog, QWidget
from pytestqt.qtbot import QtBot

from carpus.core.formats.formats import FORMATS
from carpus.core.formats.new_output import FOR_PROGRAMS, TableForm
from carpus.ui.background import Background
from carpus.ui.export.flow import Exporting
from carpus.ui.last_places import LastPlaces
from carpus.ui.theme import Theme
from tests.ui.contexts import Told, a_context

Parts = tuple[Exporting, "Stored", Told]


class Stored:
    """Writes nothing, and waits where it is told to until it is stopped."""

    def __init__(self) -> None:
        self.calls: list[tuple[Sequence[str], bool]] = []
        self.forms: list[TableForm] = []
        self.waits = threading.Event()
        self.waits.set()

    def export(
        self, session_id: str, folder: str, formats: Sequence[str], progress: Callable[[int, int], None],
        cancelled: Callable[[], bool], deidentified: bool, form: TableForm,
    ) -> Sequence[str]:  # fmt: skip
        self.calls.append((formats, deidentified))
        self.forms.append(form)
        progress(1, 2)
        while not self.waits.wait(0.005):
            if cancelled():
                return []
        progress(2, 2)
        return ["s.wrist.csv"]


@pytest.fixture
def parts(
    theme: Theme, host: QWidget, background: Background, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Parts:
    stored, told = Stored(), Told()
    monkeypatch.setattr(QFileDialog, "getExistingDirectory", lambda *_: str(tmp_path))
    exporting = Exporting(a_context(theme, host, told, background, library=stored, places=LastPlaces(tmp_path)))
    return exporting, stored, told


def test_every_format_is_offered_and_what_is_ticked_is_written(qtbot: QtBot, parts: Parts) -> None:
    exporting, stored, told = parts
    exporting.ask("s1")
    assert set(exporting.formats.boxes) == set(FORMATS)
    assert exporting.formats.formats == ["csv"]
    exporting.formats.boxes["csv"].click()
    assert not exporting.formats.take.isEnabled(), "nothing to write"
    exporting.formats.boxes["c3d"].click()
    exporting.formats.nobody.click()
    exporting.formats.take.click()
    qtbot.waitUntil(lambda: bool(told.asked))
    assert stored.calls == [(["c3d"], True)]
    assert not exporting.formats.isVisible()
    assert not told.faults


def test_tables_have_the_form_of_the_region_that_is_chosen(qtbot: QtBot, parts: Parts) -> None:
    exporting, stored, told = parts
    choice = exporting.formats.tables_for
    for words, form in (("1,5", TableForm(";", ",", has_mark=True)), ("programs", FOR_PROGRAMS)):
        exporting.ask("s1")
        choice.setCurrentIndex(next(k for k in range(choice.count()) if words in choice.itemText(k)))
        before = len(told.asked)
        exporting.formats.take.click()
        qtbot.waitUntil(lambda before=before: len(told.asked) > before)
        assert stored.forms[-1] == form


def test_enter_goes_on_and_changes_no_choice(qtbot: QtBot, parts: Parts) -> None:
    exporting, stored, told = parts
    exporting.ask("s1")
    exporting.formats.boxes["trc"].click()
    qtbot.keyClick(exporting.formats.boxes["trc"], Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: bool(told.asked))
    assert stored.calls == [(["csv", "trc"], False)]


def test_it_shows_how_far_it_is_and_stops(qtbot: QtBot, parts: Parts, background: Background) -> None:
    exporting, stored, told = parts
    stored.waits.clear()
    exporting.ask("s1")
    exporting.formats.take.click()
    qtbot.waitUntil(lambda: exporting.formats.bar.value() == 1)
    assert exporting.formats.bar.maximum() == 2
    assert not exporting.formats.take.isVisible()
    qtbot.keyClick(exporting.formats, Qt.Key.Key_Escape)
    qtbot.waitUntil(lambda: not exporting.formats.isVisible())
    assert background.wait()
    assert not told.asked, "nothing was written, so nothing is said to be"
