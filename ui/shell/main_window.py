"""Main window: top bar, banner, one screen at a time, and the focus ring."""

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

from carpus.ui.kit.card import Surface
from carpus.ui.kit.keys import KEYS
from carpus.ui.kit.layouts import column_layout, require_parent, row_layout
from carpus.ui.kit.style import apply_style
from carpus.ui.kit.text import MEDIUM, Icon, Text
from carpus.ui.kit.theme import FOCUS_OUTSIDE_PX, MARGIN_PX, Theme
from carpus.ui.shell.top_bar import TopBar

DEFAULT_SIZE_PX = (1280, 800)
MIN_SIZE_PX = (1024, 700)


class MainWindow(QWidget):
    """Main window.

    Signals: ``key_pressed`` with the name of a global shortcut, ``closing``.
    """

    key_pressed = Signal(str)
    closing = Signal()

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self.top_bar = TopBar(theme)
        self.banner = Banner(theme)
        self.screen_stack = QStackedWidget()
        column_layout(self.top_bar, self.banner, (self.screen_stack, 1), gap=0, margins=(0, 0, 0, 0), parent=self)
        FocusRing(self)
        self.setWindowTitle("Carpus")
        self.resize(*DEFAULT_SIZE_PX)
        self.setMinimumSize(*MIN_SIZE_PX)
        self._is_close_confirmed = False
        self.prompt_before_close: Callable[[], bool] = lambda: False
        """Asks the user if closing would lose something; returns whether he was asked."""
        theme.palette_changed.connect(self._apply_theme)
        self._apply_theme()

    def bind_keys(self, names: Sequence[str]) -> None:
        """Bind global shortcuts, which work wherever the focus is."""
        for name in names:
            QShortcut(QKeySequence(KEYS[name]), self).activated.connect(partial(self.key_pressed.emit, name))

    def show_screen(self, screen: QWidget, focus: QWidget | None = None) -> None:
        if self.screen_stack.indexOf(screen) < 0:
            self.screen_stack.addWidget(screen)
        self.screen_stack.setCurrentWidget(screen)
        (focus or screen).setFocus(Qt.FocusReason.OtherFocusReason)

    def _apply_theme(self) -> None:
        application = QApplication.instance()
        if isinstance(application, QApplication):
            apply_style(application, self._theme)

    def close_without_prompt(self) -> None:
        """Close without asking: the user has answered, or the system shuts down."""
        self._is_close_confirmed = True
        self.close()

    def closeEvent(self, event: QCloseEvent) -> None:
        if not self._is_close_confirmed and self.prompt_before_close():
            event.ignore()
            return
        self.closing.emit()
        event.accept()


OWN_FOCUS_BORDER = (QLineEdit, QPlainTextEdit, QAbstractSpinBox)
"""Text fields show the focus by their own border."""


class FocusRing(QWidget):
    """Ring around the focused control, transparent to the mouse."""

    def __init__(self, window: QWidget) -> None:
        super().__init__(window)
        self._target: QWidget | None = None
        self._watched_widgets: list[QWidget] = []
        for attribute in (Qt.WidgetAttribute.WA_TransparentForMouseEvents, Qt.WidgetAttribute.WA_StyledBackground):
            self.setAttribute(attribute)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.hide()
        application = QApplication.instance()
        assert isinstance(application, QApplication)
        application.focusChanged.connect(self._follow_focus)

    def _follow_focus(self, old: QWidget | None, new: QWidget | None) -> None:
        for widget in self._watched_widgets:
            if isValid(widget):
                widget.removeEventFilter(self)
        wanted = (
            new is not None
            and not isinstance(new, OWN_FOCUS_BORDER)
            and new.focusPolicy() != Qt.FocusPolicy.NoFocus
            and not new.property("shows_own_focus")
            and require_parent(self).isAncestorOf(new)
        )
        self._target = new if wanted else None
        self._watched_widgets = self._target_and_ancestors()
        for widget in self._watched_widgets:
            widget.installEventFilter(self)
        self._update_geometry()

    def _target_and_ancestors(self) -> list[QWidget]:
        """Return the target and its ancestors: any of them may move it, as scrolling does."""
        found, widget = [], self._target
        while widget is not None and widget is not self.parentWidget():
            found.append(widget)
            widget = widget.parentWidget()
        return found

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() in (QEvent.Type.Move, QEvent.Type.Resize, QEvent.Type.Show, QEvent.Type.Hide):
            self._update_geometry()
        return False

    def _update_geometry(self) -> None:
        target = self._target
        if target is None or not isValid(target) or not target.isVisible():
            self.hide()
            return
        corner = target.mapTo(require_parent(self), QPoint(0, 0))
        grow = FOCUS_OUTSIDE_PX + 2
        place = QRect(corner, target.size()).adjusted(-grow, -grow, grow, grow)
        seen = place
        for holder in self._watched_widgets[1:]:
            area = holder.parentWidget()
            if isinstance(area, QAbstractScrollArea) and area.viewport() is holder:
                port = QRect(holder.mapTo(require_parent(self), QPoint(0, 0)), holder.size())
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


class Banner(Surface):
    """Amber line with a warning triangle, hidden while empty."""

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme, "warn_soft", bottom_edge="warn")
        self._words = Text(theme, "", 14, MEDIUM, wrap=True)
        row_layout(Icon(theme, "warn"), (self._words, 1), gap=10, margins=(MARGIN_PX, 5, MARGIN_PX, 5), parent=self)
        self.show_lines(())

    @property
    def text(self) -> str:
        """Text of the banner, empty while it is hidden."""
        return self._words.text()

    def show_lines(self, lines: Sequence[str]) -> None:
        words = " ".join(lines)
        self._words.setText(words)
        self.setAccessibleName(words)
        self.setVisible(bool(words))
