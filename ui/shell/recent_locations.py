"""Folders used last, and the window's last geometry."""

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
    """Last folder for each kind of file, and the window's geometry, kept for this computer; failures are ignored."""

    def __init__(self, data_folder: Path) -> None:
        self._data_folder = data_folder

    def folder(self, kind: FolderKind) -> str:
        """Return the last folder if it exists, else the documents folder, else home."""
        documents = QStandardPaths.writableLocation(QStandardPaths.StandardLocation.DocumentsLocation)
        for candidate in (self.load(kind), documents):
            if candidate and Path(candidate).is_dir():
                return candidate
        return str(Path.home())

    def choose_save_path(self, window: QWidget, kind: FolderKind, name: str, title: str, kinds: str) -> Path | None:
        """Ask for a file to write and remember its folder; None if cancelled.

        The system's dialog asks before a file is replaced.
        """
        path, _ = QFileDialog.getSaveFileName(window, title, str(Path(self.folder(kind)) / name), kinds)
        if not path:
            return None
        self.save(kind, str(Path(path).parent))
        return Path(path)

    def save(self, name: FolderKind | Literal["window"], value: str) -> None:
        with suppress(CarpusFault):  # a full or read-only disk tells elsewhere
            save_place(self._data_folder, name, value)

    def load(self, name: FolderKind | Literal["window"]) -> str:
        """Return what was saved; empty before the first time."""
        with suppress(CarpusFault):
            return read_last_place(self._data_folder, name)
        return ""


TITLE_BAR_PX = 40
"""Room for a title bar, whose height is not known before it exists."""


def restore_window(window: QWidget, geometry: str) -> None:
    """Restore a geometry of :func:`encode_geometry`; maximise a window larger than the screen."""
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
    """Move and shrink a rectangle into the screen, below a title bar; return it and whether its size was kept."""
    inside = screen_area.adjusted(0, TITLE_BAR_PX, 0, 0)
    width, height = min(place.width(), inside.width()), min(place.height(), inside.height())
    left = min(max(place.left(), inside.left()), inside.right() + 1 - width)
    top = min(max(place.top(), inside.top()), inside.bottom() + 1 - height)
    return QRect(left, top, width, height), (width, height) == (place.width(), place.height())


def encode_geometry(window: QWidget) -> str:
    """Encode the window's geometry as text."""
    return bytes(window.saveGeometry().toBase64().data()).decode("ascii")
