"""One rule for Enter in the whole program.

A card, sheet or screen has at most one default button: its answer loses nothing. "Enter" stands on it exactly while
Enter presses it: with the keyboard on it, or in a field that leaves Enter alone. Another button that has the keyboard
is what Enter presses then; the ring is around it, and no button says "Enter".
"""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QPushButton, QWidget

ENTER = "Enter"
"""The key hint of a default button."""


def is_enter(event: QKeyEvent) -> bool:
    """Whether Enter was pressed, of either block of keys: alone, or with Ctrl, as from a field of several lines."""
    left_alone = Qt.KeyboardModifier.KeypadModifier | Qt.KeyboardModifier.ControlModifier
    return not event.modifiers() & ~left_alone and event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter)


def takes_enter(widget: QWidget | None) -> bool:
    """Whether a widget that has the keyboard keeps Enter to itself, as buttons do."""
    return isinstance(widget, QPushButton) and getattr(widget, "on_enter", "press") != "pass"


def says_enter(button: QPushButton) -> bool:
    """Whether Enter would press a default button now."""
    now: QWidget | None = button.window().focusWidget()
    return button.isEnabled() and (now is button or not takes_enter(now))


def press(button: QPushButton | None) -> bool:
    """Press the default button; whether there was one that can be pressed."""
    if button is None or not button.isVisible() or not button.isEnabled():
        return False
    button.click()
    return True
