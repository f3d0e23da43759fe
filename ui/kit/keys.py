"""All keyboard shortcuts in one table."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QWidget

from carpus.ui.kit.translate import tr

KEYS = {
    "help": "F1", "settings": "Ctrl+,", "lock": "Ctrl+L", "hide_names": "Ctrl+D",
    "search": "Ctrl+F", "new_patient": "Ctrl+N",
    "report": "Ctrl+P", "home_sheet": "Ctrl+H",
    "export": "Ctrl+E", "back": "Esc", "quit": "Ctrl+Q",
    "record": "Space", "pedal": "PgDown", "note": "F5", "pain": "F6", "pause": "F7",
    "whole_picture": "F9",
    "patient_view": "Shift+F11",
    "speeds": "F4", "next_angle": "F2", "next_finger": "F3",
    "accept": "Space", "undo": "Backspace", "next_marker": "Tab", "swap": "S",
    "new_picture": "N", "last_picture": "M", "click_again": "C",
    "finger_1": "1", "finger_2": "2", "finger_3": "3", "finger_4": "4", "finger_5": "5",
    "play": "Space", "frame_back": "Left", "frame_on": "Right", "repetition_back": "[", "repetition_on": "]",
    "leave_out": "X", "edge_back": ",", "edge_on": ".", "review_undo": "Ctrl+Z",
    "plot_in": "+", "plot_out": "-", "plot_all": "0", "point_back": "Left", "point_on": "Right",
    "point_open": "Return",
    "correct": "Shift+F10", "correct_back": ",", "correct_on": ".", "correct_hide": "H", "correct_undo": "Ctrl+Z",
    "correct_doubtful": "D",
    "angle": "A", "hand_picture": "F",
    "tick": "Space", "compare_ticked": "C", "comparison": "B",
}  # fmt: skip
"""While measuring only Space, the pedal's key and function keys are used: they work in every keyboard layout."""


def bind_key(
    host: QWidget,
    name: str,
    action: Callable[[], object],
    context: Qt.ShortcutContext = Qt.ShortcutContext.WidgetWithChildrenShortcut,
) -> QShortcut:
    """Make a shortcut work while ``host`` or one of its children has the focus."""
    shortcut = QShortcut(QKeySequence(KEYS[name]), host)
    shortcut.setContext(context)
    shortcut.setAutoRepeat(name in ("frame_back", "frame_on", "edge_back", "edge_on", "plot_in", "plot_out"))
    shortcut.activated.connect(action)
    return shortcut


def bind_screen_keys(host: QWidget, actions: Mapping[str, Callable[[], object]]) -> dict[str, QShortcut]:
    """Bind shortcuts of a screen that takes the focus itself, without a focus ring."""
    host.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
    host.setProperty("shows_own_focus", True)
    return {name: bind_key(host, name, action) for name, action in actions.items()}


def key_name(key: str) -> str:
    """Return a key sequence in the names of the user's keyboard: ``Ctrl+P`` is ``Strg+P``.

    Words that are no key are returned unchanged.
    """
    names = {
        "Ctrl": tr("Ctrl"), "Alt": tr("Alt"), "Shift": tr("Shift"), "Space": tr("Space"), "Enter": tr("Enter"),
        "Return": tr("Enter"), "Backspace": tr("Backspace"), "Esc": tr("Esc"), "Tab": tr("Tab"),
    }  # fmt: skip
    return "+".join(names.get(part, part) for part in key.split("+")) if len(key) > 1 else key


def mnemonic_key(text: str) -> str:
    """Return the mnemonic of a button text, such as ``Alt+H``; empty if it has none."""
    at = text.replace("&&", "  ").find("&")
    return f"Alt+{text[at + 1].upper()}" if 0 <= at < len(text) - 1 else ""


def action_words(name: str) -> str:
    """Return what a shortcut does, for the help."""
    words = {
        "help": tr("Help"), "settings": tr("Settings"), "lock": tr("Lock"),
        "hide_names": tr("Hide or show names"), "search": tr("Search for a patient"),
        "new_patient": tr("New patient"), "report": tr("Report"), "home_sheet": tr("Home exercise sheet"),
            "export": tr("Export"),
        "back": tr("Back"), "quit": tr("Close Carpus"), "note": tr("Note"),
        "record": tr("Start recording, or stop and review"),
        "pedal": tr("Pedal: continue, record, stop"),
        "pain": tr("Pain score"), "pause": tr("Pause or resume"),
        "whole_picture": tr("Show the whole image or only the hand"),
        "speeds": tr("Show speeds or angles"), "patient_view": tr("Open or close the patient’s view"),
        "next_angle": tr("Show the next angle as the large number"),
        "next_finger": tr("Show the next finger as the large number"),
        "accept": tr("Accept the proposed marker"),
        "undo": tr("Undo the last click"), "next_marker": tr("Next marker"),
        "swap": tr("Swap two labels"), "new_picture": tr("New image"),
        "last_picture": tr("Enlarge the image of the last session"), "click_again": tr("Click the marker again"),
        "finger_1": tr("Thumb cannot fully extend"), "finger_2": tr("Index finger cannot fully extend"),
        "finger_3": tr("Middle finger cannot fully extend"), "finger_4": tr("Ring finger cannot fully extend"),
        "finger_5": tr("Little finger cannot fully extend"),
        "play": tr("Play or stop"),
        "frame_back": tr("Previous frame"), "frame_on": tr("Next frame"),
        "repetition_back": tr("Previous repetition"), "repetition_on": tr("Next repetition"),
        "leave_out": tr("Exclude or include a repetition"),
        "edge_back": tr("Move the start or end of the repetition earlier"),
        "edge_on": tr("Move the start or end of the repetition later"),
        "review_undo": tr("Undo the last change of a repetition"),
        "plot_in": tr("Zoom in on the curves"), "plot_out": tr("Zoom out of the curves"),
        "plot_all": tr("Show the whole recording"), "point_back": tr("Select the previous session"),
        "point_on": tr("Select the next session"), "point_open": tr("Open the selected session"),
        "correct": tr("Correct a marker"), "correct_back": tr("Previous frame (correction)"),
        "correct_on": tr("Next frame (correction)"), "correct_hide": tr("Marker not visible here"),
        "correct_undo": tr("Undo the last step"), "correct_doubtful": tr("Next uncertain frame"),
        "angle": tr("Draw the angle on the frame"), "hand_picture": tr("Save an image of the hand only"),
            "tick": tr("Tick a session for comparison"), "compare_ticked": tr("Compare the two ticked sessions"),
        "comparison": tr("Compare with the other hand or another day"),
    }  # fmt: skip
    return words[name]
