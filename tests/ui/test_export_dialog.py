"""Formats are ticked, a folder is asked for, the dialog shows how far it is, and Stop ends it."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFileDialog, QWidget
from pytestqt.qtbot import QtBot

from carpus.core.formats.export import FORMATS
from carpus.core.formats.output_files import TableDialect
from carpus.ui.kit.background import Background
from carpus.ui.kit.theme import Theme
from carpus.ui.screens.export.flow import ExportController
from carpus.ui.shell.recent_locations import RecentLocations
from tests.ui.contexts import RecordingMessages, make_context

Parts = tuple[ExportController, "Stored", RecordingMessages]


class Stored:
    """Writes nothing, and waits where it is messages to until it is stopped."""

    def __init__(self) -> None:
        self.calls: list[tuple[Sequence[str], bool]] = []
        self.forms: list[TableDialect] = []
        self.waits = threading.Event()
        self.waits.set()

    def export(
        self, session_id: str, folder: str, formats: Sequence[str], progress: Callable[[int, int], None],
        cancelled: Callable[[], bool], deidentified: bool, form: TableDialect,
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
    stored, messages = Stored(), RecordingMessages()
    monkeypatch.setattr(QFileDialog, "getExistingDirectory", lambda *_: str(tmp_path))
    exporting = ExportController(
        make_context(theme, host, messages, background, library=stored, recent_locations=RecentLocations(tmp_path))
    )
    return exporting, stored, messages


def test_export_dialog_offers_every_format_and_exports_the_ticked(qtbot: QtBot, parts: Parts) -> None:
    exporting, stored, messages = parts
    exporting.choose_formats("s1")
    assert set(exporting.dialog.format_ticks) == set(FORMATS)
    assert exporting.dialog.formats == ["csv"]
    exporting.dialog.format_ticks["csv"].click()
    assert not exporting.dialog.folder_button.isEnabled(), "nothing to write"
    exporting.dialog.format_ticks["c3d"].click()
    exporting.dialog.deidentify_tick.click()
    exporting.dialog.folder_button.click()
    qtbot.waitUntil(lambda: bool(messages.asked))
    assert stored.calls == [(["c3d"], True)]
    assert not exporting.dialog.isVisible()
    assert not messages.faults


def test_export_dialog_running_shows_progress_and_stops(qtbot: QtBot, parts: Parts, background: Background) -> None:
    exporting, stored, messages = parts
    stored.waits.clear()
    exporting.choose_formats("s1")
    exporting.dialog.folder_button.click()
    qtbot.waitUntil(lambda: exporting.dialog.bar.value() == 1)
    assert exporting.dialog.bar.maximum() == 2
    assert not exporting.dialog.folder_button.isVisible()
    qtbot.keyClick(exporting.dialog, Qt.Key.Key_Escape)
    qtbot.waitUntil(lambda: not exporting.dialog.isVisible())
    assert background.join()
    assert not messages.asked, "nothing was written, so nothing is said to be"
