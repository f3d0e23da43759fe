"""Where the window was last time, and where it is at first: always whole on a screen."""

from __future__ import annotations

from PySide6.QtCore import QByteArray, QRect, Qt
from PySide6.QtGui import QGuiApplication, QScreen
from PySide6.QtWidgets import QWidget

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
