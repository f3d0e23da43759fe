"""The window: top bar, one screen at a time, and what may lie over it."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QCloseEvent, QKeySequence, QShortcut
from PySide6.QtWidgets import QApplication, QStackedWidget, QVBoxLayout, QWidget

from carpus.ui.controls.focus_ring import FocusRing
from carpus.ui.messages.sign import AmberLine
from carpus.ui.style import apply_style
from carpus.ui.theme import Theme
from carpus.ui.topbar import TopBar

FIRST_SIZE_PX = (1280, 800)
LEAST_SIZE_PX = (1024, 700)


class Shell(QWidget):
    """``key`` carries the name of a shell-wide key that was pressed; what it does is the journey's affair."""

    key = Signal(str)
    closing = Signal()

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self.bar = TopBar(theme)
        self.sign = AmberLine(theme)
        self.stage = QStackedWidget()
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self.bar)
        column.addWidget(self.sign)
        column.addWidget(self.stage, 1)
        self.ring = FocusRing(self)
        self.setWindowTitle("Carpus")
        self.resize(*FIRST_SIZE_PX)
        self.setMinimumSize(*LEAST_SIZE_PX)
        self._shortcuts: dict[str, QShortcut] = {}
        self._surely = False
        self.asks_before_closing: Callable[[], bool] = lambda: False
        """Asks the person where something would end with the window; False where nothing does."""
        theme.ground_changed.connect(self._take_theme)
        self._take_theme()

    def set_keys(self, keys: dict[str, str]) -> None:
        """Bind the shell-wide keys: name to key sequence, such as ``{"help": "F1"}``."""
        for name, sequence in keys.items():
            shortcut = self._shortcuts.get(name)
            if shortcut is None:
                shortcut = QShortcut(self)
                shortcut.activated.connect(lambda name=name: self.key.emit(name))
                self._shortcuts[name] = shortcut
            shortcut.setKey(QKeySequence(sequence))

    def show_screen(self, screen: QWidget, first: QWidget | None = None) -> None:
        """Bring a screen to the front and give the keyboard to its first control."""
        if self.stage.indexOf(screen) < 0:
            self.stage.addWidget(screen)
        self.stage.setCurrentWidget(screen)
        (first or screen).setFocus(Qt.FocusReason.OtherFocusReason)

    def _take_theme(self) -> None:
        application = QApplication.instance()
        if isinstance(application, QApplication):
            apply_style(application, self._theme)

    def close_surely(self) -> None:
        """Close without asking: the person has answered, or the system ends."""
        self._surely = True
        self.close()

    def closeEvent(self, event: QCloseEvent) -> None:
        if not self._surely and self.asks_before_closing():
            event.ignore()
            return
        self.closing.emit()
        event.accept()
