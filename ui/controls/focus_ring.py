"""The focus mark of the whole window: a 2 px accent ring 3 px outside the control that has the keyboard."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, QPoint, QRect, Qt
from PySide6.QtWidgets import QAbstractScrollArea, QAbstractSpinBox, QApplication, QLineEdit, QPlainTextEdit, QWidget
from shiboken6 import isValid

from carpus.ui.controls.host import host_of
from carpus.ui.theme import FOCUS_OUTSIDE_PX

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
