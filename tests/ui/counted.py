"""What each screen of the main way shows and asks, as a table: ``python -m tests.ui.counted``.

Words: all that is written. Controls: what can be pressed, typed into or chosen now. Asked: what a person may settle,
each row of choices, field, list and tick once. Counted in English, light, 1280x800, from the gallery's states.
"""

from __future__ import annotations

import os
import re

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractSpinBox,
    QApplication,
    QComboBox,
    QLineEdit,
    QPlainTextEdit,
    QWidget,
)

STATES = {
    "patients": "patients", "set-up": "exercise", "camera": "camera", "picture": "markers_clicking",
    "names": "markers_proposed", "checks": "markers_ready", "live": "live", "review": "review", "report": "report",
}  # fmt: skip


def words_of(texts: list[str]) -> int:
    """How many words and figures are written."""
    return sum(len(re.findall(r"\w[\w.,:°%–-]*", text)) for text in texts)


def counts_of(window: QWidget, texts: list[str]) -> tuple[int, int, int]:
    """Words, controls, and what is asked."""
    kinds = (QAbstractButton, QAbstractSpinBox, QComboBox, QLineEdit, QPlainTextEdit)
    shown = [one for one in window.findChildren(QWidget) if one.isVisible() and one.isEnabled()]
    controls = [one for one in shown if isinstance(one, kinds) and not isinstance(one.parentWidget(), kinds)]
    asked = [one for one in controls if not isinstance(one, QAbstractButton) and not getattr(one, "isReadOnly", bool)()]
    ticks = [one for one in controls if isinstance(one, QAbstractButton) and one.isCheckable()]
    groups = {one.group() if one.group() is not None else one.parentWidget() for one in ticks}
    return words_of(texts), len(controls), len(asked) + len(groups)


def main() -> None:
    """Print a line for each screen."""
    from carpus.ui.kit.fonts import load_fonts
    from tests.ui.gallery import Gallery
    from tests.ui.geometry import _labels, painted_texts

    application = QApplication.instance() or QApplication(["carpus"])
    assert isinstance(application, QApplication)
    application.setStyle("Fusion")
    load_fonts()
    gallery = Gallery(application, "light", (1280, 800))
    print("| screen | words | controls | asked |\n|---|---|---|---|")
    for name, state in STATES.items():
        gallery.show_state(state)
        for screen in gallery.shell.findChildren(QWidget):
            if hasattr(screen, "show_research"):
                screen.show_research(on=False)  # as the window opens it
        gallery.settle()
        with painted_texts(gallery.shell) as painted:
            gallery.shell.grab()
        texts = [one.text for one in (*painted, *_labels(gallery.shell))]
        words, controls, asked = counts_of(gallery.shell, texts)
        print(f"| {name} | {words} | {controls} | {asked} |")
    gallery.close()


if __name__ == "__main__":
    main()
