"""A note or a pain score while measuring: typed or clicked in a few seconds, the screen stays readable."""

from __future__ import annotations

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QHBoxLayout, QLineEdit, QWidget

from carpus.ui.controls.button import Button
from carpus.ui.controls.layouts import STRETCH, fill, in_line
from carpus.ui.controls.sheet import Sheet
from carpus.ui.controls.text import SEMIBOLD, Text
from carpus.ui.theme import Theme

MOST_PAIN = 10
SECOND_DIGIT_MS = 700
"""After a 1 a 0 may follow."""


class NoteSheet(Sheet):
    """One line; Enter keeps it with the time of the picture. ``moved`` says who moves the hand from now on: whether
    somebody else does."""

    kept = Signal(str)
    moved = Signal(bool)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 720, low=True)
        self.line = QLineEdit(placeholderText=self.tr("What happened? No names."))
        self.line.setAccessibleName(self.tr("Note"))
        keep = Button(theme, self.tr("Keep note"), "primary", height_px=44)
        close = Button(theme, self.tr("Close"), "plain", hint=self.tr("Esc"))
        self.card.body.addWidget(Text(theme, self.tr("Note at this moment"), 16, SEMIBOLD))
        self.card.body.addLayout(in_line((self.line, 1), close, keep))
        quick = QHBoxLayout()
        for words in (
            self.tr("Stopped for pain"),
            self.tr("Strap loosened"),
            self.tr("Rest"),
        ):
            button = Button(theme, words, "plain", height_px=36)
            button.clicked.connect(lambda _=False, words=words: self._keep(words))
            quick.addWidget(button)
        self._passive = False
        self.way = Button(theme, "", "plain", height_px=36)
        self.way.clicked.connect(self._change_way)
        fill(quick, self.way, STRETCH)
        self.card.body.addLayout(quick)
        keep.clicked.connect(lambda: self._keep(self.line.text()))
        close.clicked.connect(self.close_sheet)
        self.set_default(keep)

    def begin(self, *, passive: bool = False) -> None:
        """Open empty; ``passive`` whether somebody else moves the hand now."""
        self._passive = passive
        self.way.set_face(self.tr("Active from here") if passive else self.tr("Passive from here"))
        self.line.clear()
        self.open(self.line)

    def _keep(self, words: str) -> None:
        self.close_sheet()
        if words.strip():
            self.kept.emit(words.strip())

    def _change_way(self) -> None:
        self.close_sheet()
        self.moved.emit(not self._passive)


class PainSheet(Sheet):
    """Pain from 0 to 10: a click, a digit, or arrows and Enter."""

    kept = Signal(int)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 720, low=True)
        self.card.body.addWidget(Text(theme, self.tr("Pain now, 0 (none) to 10 (worst)"), 16, SEMIBOLD))
        row = in_line(gap=6)
        self.buttons: list[Button] = []
        for score in range(MOST_PAIN + 1):
            button = Button(theme, str(score), "plain", height_px=48)
            button.clicked.connect(lambda _=False, score=score: self._keep(score))
            row.addWidget(button)
            self.buttons.append(button)
        self.card.body.addLayout(row)
        below = QHBoxLayout()
        advice = self.tr("At 5 or more, or 2 more than before: stop the exercise. Keys: 0 to 9; 1 and 0 for 10.")
        below.addWidget(Text(theme, advice, 14, token="text2", wrap=True), 1)
        close = Button(theme, self.tr("Close"), "quiet", height_px=36)
        close.clicked.connect(self.close_sheet)
        self.set_default(close)
        below.addWidget(close)
        self.card.body.addLayout(below)
        self._one = QTimer(self, singleShot=True, interval=SECOND_DIGIT_MS)
        self._one.timeout.connect(lambda: self._keep(1))
        self.closed.connect(self._one.stop)

    def begin(self) -> None:
        """Open; nothing is chosen until a person does."""
        self.open()

    def _keep(self, score: int) -> None:
        self.close_sheet()
        self.kept.emit(score)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        step = {Qt.Key.Key_Left: -1, Qt.Key.Key_Right: 1}.get(Qt.Key(event.key()), 0)
        digit = event.text() if event.text() in "0123456789" else ""
        if digit and self._one.isActive():
            self._keep(MOST_PAIN if digit == "0" else int(digit))
        elif digit == "1":
            self.buttons[1].setFocus(Qt.FocusReason.TabFocusReason)
            self._one.start()
        elif digit:
            self._keep(int(digit))
        elif step:
            now = self.window().focusWidget()
            place = self.buttons.index(now) if now in self.buttons else -1 if step > 0 else 0
            self.buttons[(place + step) % len(self.buttons)].setFocus(Qt.FocusReason.TabFocusReason)
        else:
            super().keyPressEvent(event)
