"""Locked: no name, no picture, no figure, until the PIN is typed."""

from __future__ import annotations

from datetime import datetime

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QKeyEvent, QResizeEvent
from PySide6.QtWidgets import QHBoxLayout, QLineEdit, QWidget

from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Line, Surface
from carpus.ui.controls.layouts import fill, in_line
from carpus.ui.controls.sheet import Sheet
from carpus.ui.controls.text import MEDIUM, REGULAR, SEMIBOLD, Sign, StateText, Text
from carpus.ui.theme import Theme

MOST_SIGNS = 64


class LockSheet(Sheet):
    """Covers the whole window. ``tried`` carries what was typed; the answer comes by :meth:`refuse` or by closing."""

    tried = Signal(str)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 480, may_close=False)
        self._pause_s = 0
        self._says_why = False
        self.badge = Surface(theme, "soft")
        self.badge.setObjectName("badge")
        QHBoxLayout(self.badge).addWidget(Sign(theme, "lock", 32, (50, 50), lean=0.5))
        self._bar = Surface(theme, under="line")
        self._bar.setParent(self)
        in_line(
            Sign(theme, "carpus", 22, (26, 32)),
            (Text(theme, "Carpus", 16, SEMIBOLD), 1),
            gap=6,
            margins=(20, 0, 0, 0),
            within=self._bar,
        )
        self.title = Text(theme, self.tr("Locked"), 28, SEMIBOLD)
        self.why = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.line = QLineEdit()
        self.line.setEchoMode(QLineEdit.EchoMode.Password)
        self.line.setMaxLength(MOST_SIGNS)
        self.line.setAccessibleName(self.tr("PIN"))
        self.said = Text(theme, "", 14, SEMIBOLD, "bad", wrap=True)
        self.unlock = Button(theme, self.tr("Unlock"), "primary")
        self.unlock.clicked.connect(self._try)
        self.set_default(self.unlock)
        self.safe = StateText(theme, 14, MEDIUM)
        self.hidden = StateText(theme, 14, REGULAR)
        self.forgotten = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        body = self.card.body
        body.setContentsMargins(36, 20, 36, 16)
        body.setSpacing(8)
        middle = Qt.AlignmentFlag.AlignHCenter
        body.addWidget(self.badge, 0, middle)
        body.addWidget(self.title, 0, middle)
        self.why.setAlignment(middle)
        fill(
            body,
            self.why,
            8,
            Text(theme, self.tr("PIN"), 14, REGULAR, "text2"),
            self.line,
            self.said,
            self.unlock,
            4,
            Line(theme),
            self.safe,
            self.hidden,
            self.forgotten,
        )
        self._clock = QTimer(self)
        self._clock.setInterval(1000)
        self._clock.timeout.connect(self._count)

    def begin(self, why: str, *, stored: bool) -> None:
        """Cover the window; ``stored`` whether a session was open, which is."""
        self.why.setText(why)
        words = self.tr("Nothing is lost. The open session is stored.") if stored else self.tr("Nothing is lost.")
        self.safe.show_state("good", words, token="text")
        self.hidden.show_state("none", self.tr("Names, pictures and figures are hidden."), icon="eye-off")
        self._say_forgotten(help_shown=False)
        self.said.hide()
        self.line.clear()
        self.line.setEnabled(True)
        self.unlock.setEnabled(True)
        self.open(self.line)

    def reason(self, when: datetime, minutes: int) -> str:
        """Why it is locked: by key, or after so many minutes."""
        if minutes:
            words = self.tr("Locked by itself at {time}, after {minutes} minutes without a key.")
            return words.format(time=f"{when:%H:%M}", minutes=minutes)
        return self.tr("Locked at {time}.").format(time=f"{when:%H:%M}")

    def refuse(self, left: int, pause_s: int) -> None:
        """The PIN was not the one: how many tries are left, or how long to wait."""
        self.line.clear()
        self._pause_s = pause_s
        if pause_s:
            self.line.setEnabled(False)
            self.unlock.setEnabled(False)
            self._clock.start()
            self._show_pause()
        else:
            words = self.tr("Not this PIN. 1 more try, then a pause of 1 minute.")
            if left != 1:
                words = self.tr("Not this PIN. {left} more tries, then a pause of 1 minute.").format(left=left)
            self.said.setText(words)
            self.line.setFocus(Qt.FocusReason.OtherFocusReason)
        self.said.show()

    def say(self, words: str) -> None:
        self.line.clear()
        self.said.setText(words)
        self.said.show()
        self.line.setFocus(Qt.FocusReason.OtherFocusReason)

    def pause(self, pause_s: int) -> None:
        """Nothing is tried for so long; what was said stays."""
        self._says_why, self._pause_s = True, pause_s
        self.line.setEnabled(False)
        self.unlock.setEnabled(False)
        self._clock.start()

    def _show_pause(self) -> None:
        if self._says_why:
            return
        self.said.setText(self.tr("Too many tries. The next one in {seconds} s.").format(seconds=self._pause_s))

    def _count(self) -> None:
        self._pause_s = max(0, self._pause_s - 1)
        if self._pause_s:
            self._show_pause()
            return
        self._clock.stop()
        self._says_why = False
        self.said.hide()
        self.line.setEnabled(True)
        self.unlock.setEnabled(True)
        self.line.setFocus(Qt.FocusReason.OtherFocusReason)

    def _try(self) -> None:
        if self.line.text():
            self.tried.emit(self.line.text())

    def close_sheet(self) -> None:
        self._clock.stop()
        self.line.clear()
        super().close_sheet()

    def _say_forgotten(self, *, help_shown: bool) -> None:
        words = self.tr("PIN forgotten? F1 says what can be done.")
        if help_shown:
            words = self.tr(
                "Whoever looks after this computer takes the file pin.json out of the data folder and starts Carpus "
                "again: nothing is lost. A PIN hides; it does not protect the files."
            )
        self.forgotten.setText(words)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_F1:
            self._say_forgotten(help_shown=True)
        super().keyPressEvent(event)

    def resizeEvent(self, event: QResizeEvent) -> None:
        self._bar.setGeometry(0, 0, self.width(), self._theme.px(56) + 1)
        super().resizeEvent(event)
