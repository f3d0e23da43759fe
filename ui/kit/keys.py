"""All keyboard shortcuts in one table."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QWidget

from carpus.ui.kit.translate import tr

KEYS = {
    "help": "F1", "settings": "Ctrl+,", "lock": "Ctrl+L", "search": "Ctrl+F", "new_patient": "Ctrl+N",
    "report": "Ctrl+P", "home_sheet": "Ctrl+H",
    "export": "Ctrl+E", "back": "Esc", "quit": "Ctrl+Q",
    "record": "Space", "pedal": "PgDown", "note": "F5", "pain": "F6", "pause": "F7", "overlay": "F8",
    "whole_picture": "F9",
    "patient_view": "Shift+F11", "large_view": "F11",
    "speeds": "F4", "next_angle": "F2", "next_finger": "F3", "side_view": "Shift+F8",
    "answer_first": "F2", "answer_second": "F3", "answer_none": "F12",
    "accept": "Space", "undo": "Backspace", "next_marker": "Tab", "zoom_in": "+", "zoom_out": "-", "swap": "S",
    "new_picture": "N", "last_picture": "M", "click_again": "C",
    "finger_1": "1", "finger_2": "2", "finger_3": "3", "finger_4": "4", "finger_5": "5",
    "play": "Space", "frame_back": "Left", "frame_on": "Right", "repetition_back": "[", "repetition_on": "]",
    "leave_out": "X", "next_view": "V", "edge_back": ",", "edge_on": ".",
    "plot_in": "+", "plot_out": "-", "plot_all": "0", "point_back": "Left", "point_on": "Right",
    "point_open": "Return",
    "correct": "Shift+F10", "correct_back": ",", "correct_on": ".", "correct_hide": "H", "correct_undo": "Z",
    "correct_doubtful": "D",
    "angle": "A", "hand_picture": "F",
    "tick": "Space", "compare_ticked": "C", "beside": "B", "mirror": "M",
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
        "help": tr("Help"), "settings": tr("Settings"), "lock": tr("Lock"), "search": tr("Search for a patient"),
        "new_patient": tr("New patient"), "report": tr("Report"), "home_sheet": tr("Sheet for home"),
            "export": tr("Export"),
        "back": tr("Go back"), "quit": tr("Close Carpus"), "note": tr("Note"),
        "record": tr("Record, and stop and review"),
        "pedal": tr("Pedal: go on, record, stop"),
        "pain": tr("Pain score"), "pause": tr("Pause and go on"),
        "overlay": tr("Hide or show the marks on the picture"),
        "whole_picture": tr("Whole picture or hand area"), "speeds": tr("Speeds or angles"),
        "patient_view": tr("Open and close the patient’s view"),
        "large_view": tr("One figure large, or all"),
        "next_angle": tr("Next angle as big number"), "next_finger": tr("Next finger as big number"),
        "side_view": tr("One finger from the side"),
        "answer_first": tr("Answer about a blue spot: disc 1, or yes"),
        "answer_second": tr("Answer about a blue spot: spot 2"),
        "answer_none": tr("Answer about a blue spot: neither, or no"),
        "accept": tr("Accept the marker found"),
        "undo": tr("Undo the last marker"), "next_marker": tr("Next marker"),
        "zoom_in": tr("Larger loupe"), "zoom_out": tr("Smaller loupe"),
        "swap": tr("Swap two markers"), "new_picture": tr("New picture"),
        "last_picture": tr("Last time's picture larger"), "click_again": tr("Click again"),
        "finger_1": tr("Thumb cannot lie straight"), "finger_2": tr("Index finger cannot lie straight"),
        "finger_3": tr("Middle finger cannot lie straight"), "finger_4": tr("Ring finger cannot lie straight"),
        "finger_5": tr("Little finger cannot lie straight"),
        "play": tr("Play and stop"),
        "frame_back": tr("Previous picture"), "frame_on": tr("Next picture"),
        "repetition_back": tr("Previous repetition"), "repetition_on": tr("Next repetition"),
        "leave_out": tr("Leave a repetition out, or take it back"),
        "next_view": tr("Angles, path, speeds, ZYZ in turn"),
        "edge_back": tr("Move the repetition's edge back"),
        "edge_on": tr("Move the repetition's edge on"),
        "plot_in": tr("Less time of the curves, larger"), "plot_out": tr("More time of the curves"),
        "plot_all": tr("All of the curves"), "point_back": tr("Point at the session before"),
        "point_on": tr("Point at the next session"), "point_open": tr("Open the session pointed at"),
        "correct": tr("Put a marker right"), "correct_back": tr("Previous picture to put right"),
        "correct_on": tr("Next picture to put right"), "correct_hide": tr("Marker not to be seen here"),
        "correct_undo": tr("Take a step back"), "correct_doubtful": tr("Next doubtful picture"),
        "angle": tr("The angle drawn on the picture"), "hand_picture": tr("This picture with the hand alone"),
            "tick": tr("Tick a session to be compared"), "compare_ticked": tr("Compare the two that are ticked"),
        "beside": tr("Beside the other hand, or another day"),
        "mirror": tr("Mirror the left hand"),
    }  # fmt: skip
    return words[name]
