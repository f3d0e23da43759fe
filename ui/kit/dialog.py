"""Dialog as a card over the dimmed window."""

from __future__ import annotations

from PySide6.QtCore import QCoreApplication, QEvent, QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent, QKeySequence, QResizeEvent
from PySide6.QtWidgets import (
    QAbstractButton,
    QApplication,
    QLabel,
    QLineEdit,
    QPlainTextEdit,
    QVBoxLayout,
    QWidget,
)
from shiboken6 import isValid

from carpus.ui.kit.button import ENTER_KEY, Button, is_enter_key, press_default
from carpus.ui.kit.card import Card
from carpus.ui.kit.field import SearchField
from carpus.ui.kit.layouts import STRETCH, fill, require_parent, row_layout
from carpus.ui.kit.text import REGULAR, SEMIBOLD, Text
from carpus.ui.kit.theme import Theme

# Open dialogs, the topmost last.
_open_dialogs: list[Dialog] = []


def has_open_dialog(window: QWidget) -> bool:
    """Return whether a dialog is open in a window."""
    return any(isValid(sheet) and sheet.isVisible() and sheet.window() is window for sheet in _open_dialogs)


_MOUSE_EVENTS = (QEvent.Type.MouseButtonPress, QEvent.Type.MouseButtonRelease, QEvent.Type.MouseButtonDblClick)
# Events that a dialog keeps from the window below; all others pass without being looked at.
_FILTERED_EVENTS = frozenset((QEvent.Type.ShortcutOverride, QEvent.Type.KeyPress, QEvent.Type.FocusIn, *_MOUSE_EVENTS))


class Dialog(QWidget):
    """Card that covers ``host`` while open.

    All keys go to the topmost dialog. Esc closes a dismissible one, with a warning if something was typed; Enter
    presses ``default_button``. A dialog that is not dismissible takes the mouse as well.
    """

    closed = Signal()

    def __init__(
        self, host: QWidget, theme: Theme, width_px: int = 560, *, is_dismissible: bool = True, is_low: bool = False
    ) -> None:
        """With ``is_low`` the card is near the lower edge, over a screen that stays readable."""
        super().__init__(host)
        self._theme, self._is_dismissible = theme, is_dismissible
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground, not is_low)
        self._width_px = width_px
        self._previous_focus: QWidget | None = None
        self._focus_widget: QWidget | None = None
        self.default_button: Button | None = None
        self._initial_texts: list[str] = []
        self._warning: Text | None = None
        self.card = Card(theme, 24)
        across = row_layout(STRETCH, self.card, STRETCH)
        down = QVBoxLayout(self)
        down.addStretch(12 if is_low else 2)
        down.addLayout(across)
        down.addStretch(1 if is_low else 3)
        host.installEventFilter(self)
        theme.changed.connect(self._fit_card)
        self.hide()

    def _fit_card(self) -> None:
        self.card.setFixedWidth(min(self._theme.px(self._width_px), max(require_parent(self).width() - 48, 200)))

    def resizeEvent(self, event: QResizeEvent) -> None:
        self._fit_card()
        super().resizeEvent(event)

    def add_heading(self, title: str = "", words: str = "", *, gap: int = 12) -> None:
        """Add title and explanation; ``gap`` is that between all parts of the card."""
        self.title = Text(self._theme, title, 20, SEMIBOLD, wrap=True)
        self.words = Text(self._theme, words, 14, REGULAR, "text2", wrap=True)
        self.card.body.setSpacing(gap)
        fill(self.card.body, self.title, self.words)

    def add_buttons(self, accept: Button, *others: Button, cancel_text: str = "", gap: int | None = 10) -> Button:
        """Add the last row: ``others`` at the left, then the returned cancel button, and ``accept``."""
        close = Button(
            self._theme, cancel_text or self.tr("Cancel"), "plain", hint=self.tr("Esc"), height_px=accept.height_px
        )
        close.clicked.connect(self.close_dialog)
        self.set_default(accept)
        self.card.body.addLayout(row_layout(*others, STRETCH, close, accept, gap=gap))
        return close

    def set_default(self, button: Button) -> None:
        """Set the button that Enter presses; it must lose nothing."""
        if self.default_button is not None and self.default_button is not button and isValid(self.default_button):
            self.default_button.set_label(self.default_button.text(), hint="")
        self.default_button = button
        button.set_label(button.text(), hint=ENTER_KEY)

    def open(self, focus: QWidget | None = None) -> None:
        """Show the dialog and give the keyboard to ``focus``, or else to the default button."""
        focus = focus or self.default_button
        now: QWidget | None = self.window().focusWidget()
        if now is None or not self.isAncestorOf(now):
            self._previous_focus = now
        self._focus_widget = focus
        self._initial_texts = self._field_texts()
        self._clear_warning()
        self.setGeometry(require_parent(self).rect())
        self._fit_card()
        self.show()
        self.raise_()
        _open_dialogs[:] = [other for other in _open_dialogs if isValid(other) and other is not self] + [self]
        application = QCoreApplication.instance()
        assert application is not None
        application.installEventFilter(self)
        self._grab_focus()

    def _grab_focus(self) -> None:
        first = self._focus_widget
        (first if first is not None and isValid(first) else self).setFocus(Qt.FocusReason.OtherFocusReason)

    def close_dialog(self) -> None:
        """Hide the dialog and return the keyboard to where it was."""
        if self.isVisibleTo(require_parent(self)):
            self.hide()
            application = QCoreApplication.instance()
            if application is not None:
                application.removeEventFilter(self)
            if self in _open_dialogs:
                _open_dialogs.remove(self)
            before = self._previous_focus
            if before is not None and isValid(before) and before.isVisible():  # a card's own old button is gone
                before.setFocus(Qt.FocusReason.OtherFocusReason)
            self.closed.emit()

    def dismiss(self) -> None:
        """Close on Esc; typed text needs a second Esc."""
        if not self._is_dismissible:
            return
        typed = self._field_texts()
        if typed == self._initial_texts:
            self.close_dialog()
            return
        self._initial_texts = typed
        self._clear_warning()
        words = self.tr("Your entries are not saved yet. Press Esc again to close without saving.")
        self._warning = Text(self._theme, words, 14, SEMIBOLD, "bad", wrap=True)
        self.card.body.insertWidget(max(self.card.body.count() - 1, 0), self._warning)  # above the answers

    def _clear_warning(self) -> None:
        if self._warning is not None:
            self._warning.hide()
            self._warning.deleteLater()
            self._warning = None

    def _field_texts(self) -> list[str]:
        """Return the texts of all fields but searches and secrets."""
        lines = [
            one.text()
            for one in self.card.findChildren(QLineEdit)
            if not isinstance(one, SearchField) and one.echoMode() == QLineEdit.EchoMode.Normal
        ]
        return lines + [one.toPlainText() for one in self.card.findChildren(QPlainTextEdit)]

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape:
            self.dismiss()
        elif is_enter_key(event):
            press_default(self.default_button)
        else:
            self._press_mnemonic(event)
        event.accept()  # nothing goes through to what lies below

    def _press_mnemonic(self, event: QKeyEvent) -> bool:
        """Press the button, or focus the field, of an Alt key; return False if there is none."""
        if event.modifiers() != Qt.KeyboardModifier.AltModifier:
            return False
        pressed = QKeySequence(event.keyCombination())
        for button in self.findChildren(QAbstractButton):
            if button.isVisible() and button.isEnabled() and QKeySequence.mnemonic(button.text()) == pressed:
                button.click()
                return True
        for label in self.findChildren(QLabel):
            field: QWidget | None = label.buddy()
            if field is not None and label.isVisible() and QKeySequence.mnemonic(label.text()) == pressed:
                field.setFocus(Qt.FocusReason.ShortcutFocusReason)
                return True
        return False

    def focusNextPrevChild(self, forward: bool) -> bool:
        stops = [
            child
            for child in self.findChildren(QWidget)
            if child.isVisible() and child.isEnabled() and child.focusPolicy() & Qt.FocusPolicy.TabFocus
        ]
        if not stops:
            return True
        now = self.window().focusWidget()
        place = stops.index(now) if now in stops else -1
        step = 1 if forward else -1
        stops[(place + step) % len(stops)].setFocus(
            Qt.FocusReason.TabFocusReason if forward else Qt.FocusReason.BacktabFocusReason
        )
        return True

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        kind = event.type()
        if kind == QEvent.Type.Resize and watched is self.parentWidget():
            self.setGeometry(require_parent(self).rect())
        if kind not in _FILTERED_EVENTS:
            return False
        if kind == QEvent.Type.ShortcutOverride:
            if self._is_topmost(watched.window() if isinstance(watched, QWidget) else QApplication.activeWindow()):
                event.accept()  # no shortcut of the window fires; the key itself goes to who has the keyboard
        elif isinstance(watched, QWidget) and watched is not self and self._is_topmost(watched.window()):
            outside = not self.isAncestorOf(watched) and watched is not self.window()
            if kind == QEvent.Type.KeyPress and self._press_mnemonic(event):  # type: ignore[arg-type]
                return True  # a line to type in would take the letter
            if kind == QEvent.Type.KeyPress and outside:
                self._grab_focus()
                self.keyPressEvent(event)  # type: ignore[arg-type]
                return True
            if kind in _MOUSE_EVENTS and outside and not self._is_dismissible:
                return True
            if kind == QEvent.Type.FocusIn and outside:
                self._grab_focus()
                return True
        return False

    def _is_topmost(self, window: QWidget | None) -> bool:
        shown = [sheet for sheet in _open_dialogs if isValid(sheet) and sheet.isVisible() and sheet.window() is window]
        return bool(shown) and shown[-1] is self
