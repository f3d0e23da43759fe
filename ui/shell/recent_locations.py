"""Where a person last opened and saved things, and where the window was."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path
from typing import Literal

from PySide6.QtCore import QByteArray, QRect, QStandardPaths, Qt
from PySide6.QtGui import QGuiApplication, QScreen
from PySide6.QtWidgets import QFileDialog, QWidget

from carpus.core.model.errors import CarpusFault
from carpus.core.records.clinic_records import read_last_place, save_place

FolderKind = Literal["recordings", "reports", "exports"]


class RecentLocations:
    """A folder for each kind of thing, kept for this computer; only a convenience, so nothing here is a fault."""

    def __init__(self, data_folder: Path) -> None:
        self._data_folder = data_folder

    def folder(self, kind: FolderKind) -> str:
        """Where to begin looking: the last place if it is still there, else documents, else home."""
        for candidate in (self._load(kind), documents_folder()):
            if candidate and Path(candidate).is_dir():
                return candidate
        return str(Path.home())

    def save_folder(self, kind: FolderKind, folder: str) -> None:
        self._save(kind, folder)

    def choose_save_path(self, window: QWidget, kind: FolderKind, name: str, title: str, kinds: str) -> Path | None:
        """Ask for a file to write, beginning at the last place, and remember that; None when the person changed their
        mind. The system's own dialog asks whether an old file may go."""
        path, _ = QFileDialog.getSaveFileName(window, title, str(Path(self.folder(kind)) / name), kinds)
        if not path:
            return None
        self.save_folder(kind, str(Path(path).parent))
        return Path(path)

    def window_geometry(self) -> str:
        """The window's place as it was kept, empty before the first time."""
        return self._load("window")

    def save_window_geometry(self, geometry: str) -> None:
        self._save("window", geometry)

    def _save(self, name: str, value: str) -> None:
        with suppress(CarpusFault):  # a full or read-only disk tells elsewhere
            save_place(self._data_folder, name, value)

    def _load(self, name: str) -> str:
        with suppress(CarpusFault):
            return read_last_place(self._data_folder, name)
        return ""


def documents_folder() -> str:
    """Where a person keeps papers."""
    return QStandardPaths.writableLocation(QStandardPaths.StandardLocation.DocumentsLocation)


TITLE_BAR_PX = 40
"""Room for a title bar, whose height nobody knows before it is there."""


def restore_window(window: QWidget, geometry: str) -> None:
    """Give a window its place of last time (as :func:`encode_geometry` told it), or its first size; larger than the
    screen it
    fills the screen."""
    if geometry:
        window.restoreGeometry(QByteArray.fromBase64(geometry.encode("ascii", "ignore")))
    screen: QScreen | None = window.screen()  # none while a display comes or goes
    screen = screen if screen is not None else QGuiApplication.primaryScreen()
    if screen is None:
        return
    room = screen.availableGeometry()
    if not window.isMaximized():
        fits, whole = fit_on_screen(window.geometry(), room)
        window.setGeometry(fits)
        if not whole:
            window.setWindowState(window.windowState() | Qt.WindowState.WindowMaximized)


def fit_on_screen(place: QRect, screen_area: QRect) -> tuple[QRect, bool]:
    """A place moved and shrunk into the room of a screen, below a title bar; whether it kept its size."""
    inside = screen_area.adjusted(0, TITLE_BAR_PX, 0, 0)
    width, height = min(place.width(), inside.width()), min(place.height(), inside.height())
    left = min(max(place.left(), inside.left()), inside.right() + 1 - width)
    top = min(max(place.top(), inside.top()), inside.bottom() + 1 - height)
    return QRect(left, top, width, height), (width, height) == (place.width(), place.height())


def encode_geometry(window: QWidget) -> str:
    """The window's place as a text."""
    return bytes(window.saveGeometry().toBase64().data()).decode("ascii")
