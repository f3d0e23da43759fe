"""A card over a dimmed screen, for what must be answered or typed before the screen goes on."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, Qt, Signal
from PySide6.QtGui import QColor, QKeyEvent, QPainter, QPaintEvent
from PySide6.QtWidgets import QHBoxLayout, QVBoxLayout, QWidget
from shiboken6 import isValid

from ui.controls.card import Card
from ui.theme import Theme

DIM_ALPHA = {"light": 110, "dark": 170}


class Sheet(QWidget):
    """Covers ``host`` while open; keeps Tab inside; Esc closes when ``may_close``."""

    closed = Signal()

    def __init__(
        self, host: QWidget, theme: Theme, width_px: int = 560, *, may_close: bool = True, low: bool = False
    ) -> None:
        """``low``: near the lower edge and without dimming, over a screen that must stay readable."""
        super().__init__(host)
        self._theme, self._may_close, self._dims = theme, may_close, not low
        self._width_px = width_px
        self._focus_before: QWidget | None = None
        self.card = Card(theme, 24)
        across = QHBoxLayout()
        across.addStretch(1)
        across.addWidget(self.card)
        across.addStretch(1)
        down = QVBoxLayout(self)
        down.addStretch(12 if low else 2)
        down.addLayout(across)
        down.addStretch(1 if low else 3)
        host.installEventFilter(self)
        theme.changed.connect(self._take_theme)
        self._take_theme()
        self.hide()

    def _take_theme(self) -> None:
        self.card.setFixedWidth(self._theme.px(self._width_px))
        self.update()

    def open(self, first: QWidget | None = None) -> None:
        """Show over the host and give the keyboard to ``first``."""
        self._focus_before = self.window().focusWidget()
        self.setGeometry(self.parentWidget().rect())
        self.show()
        self.raise_()
        (first or self).setFocus(Qt.FocusReason.OtherFocusReason)

    def close_sheet(self) -> None:
        """Hide and give the keyboard back."""
        if self.isVisibleTo(self.parentWidget()):
            self.hide()
            before = self._focus_before
            if before is not None and isValid(before) and before.isVisible():  # a card's own old button is gone
                before.setFocus(Qt.FocusReason.OtherFocusReason)
            self.closed.emit()

    def leave(self) -> None:
        """What Esc does: close where this may be left without an answer."""
        if self._may_close:
            self.close_sheet()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape:
            self.leave()
        else:
            event.accept()

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
        if event.type() == QEvent.Type.Resize and watched is self.parentWidget():
            self.setGeometry(self.parentWidget().rect())
        return False

    def paintEvent(self, event: QPaintEvent) -> None:
        if self._dims:
            QPainter(self).fillRect(self.rect(), QColor(0, 0, 0, DIM_ALPHA[self._theme.name]))
