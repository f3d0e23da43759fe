"""The real application, put together as for a user, in a data folder of the test's own."""

from __future__ import annotations

import os

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import pytest
from PySide6.QtCore import QCoreApplication, QEvent, QLocale
from PySide6.QtWidgets import QApplication

from app.compose import Desktop, application, compose
from app.settings import RecordingSettings, ScreenSettings, Settings
from tests.journeys.takes import render, take_of

SPEED = 1.5
"""How much faster than recorded everything plays."""
Open = Callable[[], Desktop]


@pytest.fixture(scope="session")
def take(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder of the short take."""
    return render(tmp_path_factory.mktemp("take") / "flexion")


@pytest.fixture
def data(tmp_path: Path) -> Path:
    """The data folder."""
    return tmp_path / "data"


@pytest.fixture
def open_desktop(qapp: QApplication, take: Path, data: Path, tmp_path: Path) -> Iterator[Open]:
    """Puts the application together; may be called again after closing. Whatever is open is closed at the end."""
    QLocale.setDefault(QLocale(QLocale.Language.English, QLocale.Country.UnitedKingdom))
    settings = replace(Settings(), screen=ScreenSettings("light"), recording=RecordingSettings(folder=str(data)))
    opened: list[Desktop] = []

    def open_one() -> Desktop:
        desktop = compose(
            application([]), settings, take=take_of(take), speed=SPEED, settings_folder=tmp_path / "settings"
        )
        opened.append(desktop)
        desktop.show()
        return desktop

    yield open_one
    for desktop in opened:
        desktop.close()
    let_go(qapp)


def let_go(qapp: QApplication) -> None:
    """Delete all windows: left alive, they would make every later change of style as slow as all of them together."""
    for widget in qapp.topLevelWidgets():
        widget.deleteLater()
    qapp.processEvents()
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete.value)
