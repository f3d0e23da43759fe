"""The window: top bar, one screen at a time, what may lie over it, and the ring about what has the keyboard."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

from PySide6.QtCore import QEvent, QObject, QPoint, QRect, Qt, Signal
from PySide6.QtGui import QCloseEvent, QKeySequence, QShortcut
from PySide6.QtWidgets import (
    QAbstractScrollArea,
    QAbstractSpinBox,
    QApplication,
    QLineEdit,
    QPlainTextEdit,
    QStackedWidget,
    QWidget,
)
from shiboken6 import isValid

from carpus.ui.controls.card import Surface
from carpus.ui.controls.layouts import host_of, in_column, in_line
from carpus.ui.controls.text import MEDIUM, Sign, Text
from carpus.ui.keys import KEYS
from carpus.ui.style import apply_style
from carpus.ui.theme import FOCUS_OUTSIDE_PX, MARGIN_PX, Theme
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
        in_column(self.bar, self.sign, (self.stage, 1), gap=0, margins=(0, 0, 0, 0), within=self)
        self.ring = FocusRing(self)
        self.setWindowTitle("Carpus")
        self.resize(*FIRST_SIZE_PX)
        self.setMinimumSize(*LEAST_SIZE_PX)
        self._surely = False
        self.asks_before_closing: Callable[[], bool] = lambda: False
        """Asks the person where something would end with the window; False where nothing does."""
        theme.ground_changed.connect(self._take_theme)
        self._take_theme()

    def bind_keys(self, names: Sequence[str]) -> None:
        """Let keys work wherever the keyboard is; ``key`` carries the name of one that is pressed."""
        for name in names:
            QShortcut(QKeySequence(KEYS[name]), self).activated.connect(partial(self.key.emit, name))

    def show_screen(self, screen: QWidget, first: QWidget | None = None) -> None:
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


MARKS_ITSELF = (QLineEdit, QPlainTextEdit, QAbstractSpinBox)
"""Text fields show focus by their own border."""


class FocusRing(QWidget):
    """Lies over a window, lets the mouse through, follows the focused control."""

    def __init__(self, window: QWidget) -> None:
        super().__init__(window)
        self._target: QWidget | None = None
        self._watched: list[QWidget] = []
        for attribute in (Qt.WidgetAttribute.WA_TransparentForMouseEvents, Qt.WidgetAttribute.WA_StyledBackground):
            self.setAttribute(attribute)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.hide()
        application = QApplication.instance()
        assert isinstance(application, QApplication)
        application.focusChanged.connect(self._follow)

    def _follow(self, old: QWidget | None, new: QWidget | None) -> None:
        for widget in self._watched:
            if isValid(widget):
                widget.removeEventFilter(self)
        wanted = (
            new is not None
            and not isinstance(new, MARKS_ITSELF)
            and new.focusPolicy() != Qt.FocusPolicy.NoFocus
            and not new.property("shows_own_focus")
            and host_of(self).isAncestorOf(new)
        )
        self._target = new if wanted else None
        self._watched = self._with_what_holds_it()
        for widget in self._watched:
            widget.installEventFilter(self)
        self._place()

    def _with_what_holds_it(self) -> list[QWidget]:
        """The target and all it lies in up to the window: any of them may move it, as scrolling does."""
        found, widget = [], self._target
        while widget is not None and widget is not self.parentWidget():
            found.append(widget)
            widget = widget.parentWidget()
        return found

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() in (QEvent.Type.Move, QEvent.Type.Resize, QEvent.Type.Show, QEvent.Type.Hide):
            self._place()
        return False

    def _place(self) -> None:
        target = self._target
        if target is None or not isValid(target) or not target.isVisible():
            self.hide()
            return
        corner = target.mapTo(host_of(self), QPoint(0, 0))
        grow = FOCUS_OUTSIDE_PX + 2
        place = QRect(corner, target.size()).adjusted(-grow, -grow, grow, grow)
        seen = place
        for holder in self._watched[1:]:
            area = holder.parentWidget()
            if isinstance(area, QAbstractScrollArea) and area.viewport() is holder:
                port = QRect(holder.mapTo(host_of(self), QPoint(0, 0)), holder.size())
                seen = seen.intersected(port.adjusted(-grow, -grow, grow, grow))
        if min(seen.width(), seen.height()) <= 2 * grow:  # scrolled away
            self.hide()
            return
        self.setGeometry(place)
        if seen == place:
            self.clearMask()
        else:
            self.setMask(seen.translated(-place.topLeft()))
        self.show()
        self.raise_()


class AmberLine(Surface):
    """Amber, with a triangle; hidden while there is nothing to say."""

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme, "warn_soft", under="warn")
        self._words = Text(theme, "", 14, MEDIUM, wrap=True)
        in_line(Sign(theme, "warn"), (self._words, 1), gap=10, margins=(MARGIN_PX, 5, MARGIN_PX, 5), within=self)
        self.show_lines(())

    @property
    def text(self) -> str:
        """What it says, empty while it is hidden."""
        return self._words.text()

    def show_lines(self, lines: Sequence[str]) -> None:
        words = " ".join(lines)
        self._words.setText(words)
        self.setAccessibleName(words)
        self.setVisible(bool(words))
