"""Where a person last opened and saved things, and where the window was."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path
from typing import Literal

from PySide6.QtCore import QByteArray, QRect, QStandardPaths, Qt
from PySide6.QtGui import QGuiApplication, QScreen
from PySide6.QtWidgets import QFileDialog, QWidget

from carpus.core.errors import CarpusFault
from carpus.core.records.of_clinic import keep_place, last_place

Kind = Literal["recordings", "reports", "exports"]


class LastPlaces:
    """A folder for each kind of thing, kept for this computer; only a convenience, so nothing here is a fault."""

    def __init__(self, data_folder: Path) -> None:
        self._data_folder = data_folder

    def folder(self, kind: Kind) -> str:
        """Where to begin looking: the last place if it is still there, else documents, else home."""
        for candidate in (self._kept(kind), documents()):
            if candidate and Path(candidate).is_dir():
                return candidate
        return str(Path.home())

    def keep(self, kind: Kind, folder: str) -> None:
        self._keep(kind, folder)

    def ask_where_to_save(self, window: QWidget, kind: Kind, name: str, title: str, kinds: str) -> Path | None:
        """Ask for a file to write, beginning at the last place, and remember that; None when the person changed their
        mind. The system's own dialog asks whether an old file may go."""
        path, _ = QFileDialog.getSaveFileName(window, title, str(Path(self.folder(kind)) / name), kinds)
        if not path:
            return None
        self.keep(kind, str(Path(path).parent))
        return Path(path)

    def window(self) -> str:
        """The window's place as it was kept, empty before the first time."""
        return self._kept("window")

    def keep_window(self, place: str) -> None:
        self._keep("window", place)

    def _keep(self, name: str, value: str) -> None:
        with suppress(CarpusFault):  # a full or read-only disk tells elsewhere
            keep_place(self._data_folder, name, value)

    def _kept(self, name: str) -> str:
        with suppress(CarpusFault):
            return last_place(self._data_folder, name)
        return ""


def documents() -> str:
    """Where a person keeps papers."""
    return QStandardPaths.writableLocation(QStandardPaths.StandardLocation.DocumentsLocation)


TITLE_PX = 40
"""Room for a title bar, whose height nobody knows before it is there."""


def put_in_place(window: QWidget, kept: str) -> None:
    """Give a window its place of last time (as :func:`place_of` told it), or its first size; larger than the screen it
    fills the screen."""
    if kept:
        window.restoreGeometry(QByteArray.fromBase64(kept.encode("ascii", "ignore")))
    screen: QScreen | None = window.screen()  # none while a display comes or goes
    screen = screen if screen is not None else QGuiApplication.primaryScreen()
    if screen is None:
        return
    room = screen.availableGeometry()
    if not window.isMaximized():
        fits, whole = fitted(window.geometry(), room)
        window.setGeometry(fits)
        if not whole:
            window.setWindowState(window.windowState() | Qt.WindowState.WindowMaximized)


def fitted(place: QRect, room: QRect) -> tuple[QRect, bool]:
    """A place moved and shrunk into the room of a screen, below a title bar; whether it kept its size."""
    inside = room.adjusted(0, TITLE_PX, 0, 0)
    width, height = min(place.width(), inside.width()), min(place.height(), inside.height())
    left = min(max(place.left(), inside.left()), inside.right() + 1 - width)
    top = min(max(place.top(), inside.top()), inside.bottom() + 1 - height)
    return QRect(left, top, width, height), (width, height) == (place.width(), place.height())


def place_of(window: QWidget) -> str:
    """The window's place as a text."""
    return bytes(window.saveGeometry().toBase64().data()).decode("ascii")
