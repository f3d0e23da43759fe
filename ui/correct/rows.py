"""One marker of the picture in the list: its name, and how far it is from where the others expect it."""

from __future__ import annotations

import math

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QPushButton, QSizePolicy

from carpus.ui import numbers
from carpus.ui.controls.layouts import in_line
from carpus.ui.controls.text import MEDIUM, REGULAR, SEMIBOLD, ElidedText, Sign, Text
from carpus.ui.theme import Theme

ROW_PX = 34
MOVES = (Qt.Key.Key_Left, Qt.Key.Key_Right, Qt.Key.Key_Up, Qt.Key.Key_Down)


class MarkerRow(QPushButton):
    """``nudged`` carries an arrow key, and whether Shift was held."""

    nudged = Signal(int, bool)

    def __init__(self, theme: Theme, name: str) -> None:
        super().__init__()
        self._theme, self._name = theme, name
        self._sign = Sign(theme, "good", 18, (18, 20))
        self._said, self._value = ElidedText(theme, name, 14, MEDIUM), Text(theme, "", 14, REGULAR)
        self._value.setObjectName("value")
        row = in_line(gap=10, margins=(8, 0, 8, 0), within=self)
        for part in (self._sign, self._said, self._value):
            part.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
            row.addWidget(part, int(part is self._said))
        self.on_enter = "pass"
        self.setCheckable(True)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        theme.changed.connect(self.updateGeometry)

    def show_line(
        self, off_mm: float, was_mm: float, *, seen: bool, changed: bool, chosen: bool, far_mm: float
    ) -> None:
        """``off_mm`` from its place now, ``was_mm`` before a change; NaN where nobody knows."""
        now = self.tr("{size} mm").format(size=numbers.fixed(off_mm, 1)) if math.isfinite(off_mm) else "–"
        if not seen:
            now = self.tr("hidden")
        if changed and math.isfinite(was_mm):
            now = self.tr("{now}, was {size} mm").format(now=now, size=f"{was_mm:.0f}")
        far = seen and math.isfinite(off_mm) and off_mm > far_mm
        self._sign.show_sign("warn" if far else "predicted" if changed else "partly" if not seen else "good")
        self._value.setText(now)
        self._said.set_look("text", SEMIBOLD if chosen else MEDIUM)
        self.setChecked(chosen)
        self.setAccessibleName(f"{self._name}, {now}")
        self.setToolTip(f"{self._name}, {now}")

    def sizeHint(self) -> QSize:
        return QSize(300, self._theme.px(ROW_PX))

    def minimumSizeHint(self) -> QSize:
        return QSize(200, self._theme.px(ROW_PX))

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() in MOVES and self.isChecked():
            self.nudged.emit(event.key(), bool(event.modifiers() & Qt.KeyboardModifier.ShiftModifier))
        elif event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            event.ignore()  # Enter tracks again, wherever the keyboard is
        else:
            super().keyPressEvent(event)
