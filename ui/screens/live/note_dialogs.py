"""Dialogs for a note or a pain score while measuring."""

from __future__ import annotations

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QHBoxLayout, QLineEdit, QWidget

from carpus.ui.kit.button import Button
from carpus.ui.kit.dialog import Dialog
from carpus.ui.kit.layouts import STRETCH, fill, row_layout
from carpus.ui.kit.text import SEMIBOLD, Text
from carpus.ui.kit.theme import Theme

MAX_PAIN = 10
SECOND_DIGIT_MS = 700
"""After a 1, a 0 may follow."""


class NoteDialog(Dialog):
    """One line of text, stored with the time of the frame.

    ``passive_changed`` carries True if somebody else moves the hand from now on.
    """

    note_entered = Signal(str)
    passive_changed = Signal(bool)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 720, is_low=True)
        self.line = QLineEdit(placeholderText=self.tr("What happened? Enter no names."))
        self.line.setAccessibleName(self.tr("Note"))
        keep = Button(theme, self.tr("Save note"), "primary", height_px=44)
        close = Button(theme, self.tr("Close"), "plain", hint=self.tr("Esc"))
        self.card.body.addWidget(Text(theme, self.tr("Note at this moment"), 16, SEMIBOLD))
        self.card.body.addLayout(row_layout((self.line, 1), close, keep))
        quick = QHBoxLayout()
        for words in (
            self.tr("Stopped for pain"),
            self.tr("Strap loosened"),
            self.tr("Rest"),
        ):
            button = Button(theme, words, "plain", height_px=36)
            button.clicked.connect(lambda _=False, words=words: self._enter(words))
            quick.addWidget(button)
        self._is_passive = False
        self.passive_button = Button(theme, "", "plain", height_px=36)
        self.passive_button.clicked.connect(self._toggle_passive)
        fill(quick, self.passive_button, STRETCH)
        self.card.body.addLayout(quick)
        keep.clicked.connect(lambda: self._enter(self.line.text()))
        close.clicked.connect(self.close_dialog)
        self.set_default(keep)

    def open_note(self, *, passive: bool = False) -> None:
        """Open empty; ``passive`` tells whether somebody else moves the hand now."""
        self._is_passive = passive
        self.passive_button.set_label(self.tr("Active from here on") if passive else self.tr("Passive from here on"))
        self.line.clear()
        self.open(self.line)

    def _enter(self, words: str) -> None:
        self.close_dialog()
        if words.strip():
            self.note_entered.emit(words.strip())

    def _toggle_passive(self) -> None:
        self.close_dialog()
        self.passive_changed.emit(not self._is_passive)


class PainDialog(Dialog):
    """Pain from 0 to 10 by click, digit, or arrows and Enter."""

    pain_entered = Signal(int)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 720, is_low=True)
        self.card.body.addWidget(Text(theme, self.tr("Pain now, 0 (none) to 10 (worst)"), 16, SEMIBOLD))
        row = row_layout(gap=6)
        self.buttons: list[Button] = []
        for score in range(MAX_PAIN + 1):
            button = Button(theme, str(score), "plain", height_px=48)
            button.clicked.connect(lambda _=False, score=score: self._enter(score))
            row.addWidget(button)
            self.buttons.append(button)
        self.card.body.addLayout(row)
        below = QHBoxLayout()
        advice = self.tr(
            "If pain is 5 or more, or has risen by 2, stop the exercise. Keys: 0 to 9. For 10, press 1, then 0."
        )
        below.addWidget(Text(theme, advice, 14, token="text2", wrap=True), 1)
        close = Button(theme, self.tr("Close"), "quiet", height_px=36)
        close.clicked.connect(self.close_dialog)
        self.set_default(close)
        below.addWidget(close)
        self.card.body.addLayout(below)
        self._digit_timer = QTimer(self, singleShot=True, interval=SECOND_DIGIT_MS)
        self._digit_timer.timeout.connect(lambda: self._enter(1))
        self.closed.connect(self._digit_timer.stop)

    def open_pain(self) -> None:
        """Open without a choice."""
        self.open()

    def _enter(self, score: int) -> None:
        self.close_dialog()
        self.pain_entered.emit(score)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        step = {Qt.Key.Key_Left: -1, Qt.Key.Key_Right: 1}.get(Qt.Key(event.key()), 0)
        digit = event.text() if event.text() in "0123456789" else ""
        if digit and self._digit_timer.isActive():
            self._enter(MAX_PAIN if digit == "0" else int(digit))
        elif digit == "1":
            self.buttons[1].setFocus(Qt.FocusReason.TabFocusReason)
            self._digit_timer.start()
        elif digit:
            self._enter(int(digit))
        elif step:
            now = self.window().focusWidget()
            place = self.buttons.index(now) if now in self.buttons else -1 if step > 0 else 0
            self.buttons[(place + step) % len(self.buttons)].setFocus(Qt.FocusReason.TabFocusReason)
        else:
            super().keyPressEvent(event)
