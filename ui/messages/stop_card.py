"""Rank one: a card that must be answered. What happened, are the data safe, what to do."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent, QKeySequence
from PySide6.QtWidgets import QWidget

from carpus.core.words import Words
from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Line
from carpus.ui.controls.layouts import empty, in_column, in_line
from carpus.ui.controls.sheet import Sheet
from carpus.ui.controls.text import REGULAR, SEMIBOLD, Sign, Text
from carpus.ui.theme import Theme

WIDTH_PX = 720


@dataclass(frozen=True, slots=True)
class Answer:
    """A button that says what it does; ``key`` a letter that presses it. ``risky`` where something would be lost, or be
    kept that may be wrong: never the default."""

    text: str
    action: Callable[[], object]
    key: str = ""
    risky: bool = False


class StopCard(Sheet):
    """Shows :class:`Words` with up to two answers; the last one is the primary, has the keyboard, and
    loses nothing: where the other one is risky, Esc gives it too."""

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, WIDTH_PX, may_close=False)
        self.what = Text(theme, "", 28, SEMIBOLD, wrap=True)
        self.detail = Text(theme, "", 16, REGULAR, "text2", wrap=True)
        self.safe = Text(theme, "", 20, SEMIBOLD, wrap=True)
        self.safe_detail = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.todo = Text(theme, "", 20, SEMIBOLD, wrap=True)
        self.todo_detail = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.waiting = Text(theme, "", 14, REGULAR, "text2")
        self._icon, self._icon_safe, onward = (
            Sign(theme, name, 26, (44, 40), lean=0.5) for name in ("unplug", "good", "chevron-right")
        )
        self._buttons = in_line(gap=12)
        self._answers: list[tuple[Button, Answer]] = []
        body = self.card.body
        body.setContentsMargins(32, 24, 32, 24)
        body.setSpacing(14)
        rows = (
            (self._icon, self.what, self.detail),
            (self._icon_safe, self.safe, self.safe_detail),
            (onward, self.todo, self.todo_detail),
        )
        for icon, head, detail in rows:
            row = in_line((icon, 0, Qt.AlignmentFlag.AlignVCenter), gap=24)
            row.addLayout(in_column(head, detail, gap=2), 1)
            body.addLayout(row)
            body.addWidget(Line(theme))
        body.addLayout(in_line((self.waiting, 1), self._buttons))

    def show_words(
        self, words: Words, answers: Sequence[Answer], *, icon: str = "", detail: str = "", safe_detail: str = "",
        data_safe: bool = True, alarm: bool = True,
    ) -> None:  # fmt: skip
        """Open with the three answers; details are what only the moment knows (times, counts). Without ``alarm``
        nothing went wrong: a question, or good news, and no red."""
        self._set_row(self.what, self.detail, words.happened.rstrip("."), detail)
        self._set_row(self.safe, self.safe_detail, words.safe, safe_detail)
        self._set_row(self.todo, self.todo_detail, words.do, "")
        self._icon.show_sign(icon or ("bad" if alarm else "circle-help"), "bad" if alarm else "accent", 36)
        self._icon_safe.show_sign("good" if data_safe else "warn", size_px=26)
        self.waiting.setText("")
        self.card.set_colors("surface", *(("bad", 2.0) if alarm else ("line", 1.0)))
        self.setAccessibleName(" ".join((words.happened, detail, words.safe, safe_detail, words.do)))
        if answers and answers[-1].risky:
            raise ValueError(f"what Enter answers loses nothing: {answers[-1].text}")
        empty(self._buttons)
        self._answers = []
        for number, answer in enumerate(answers):
            primary = number == len(answers) - 1
            button = Button(self._theme, answer.text, "primary" if primary else "plain", hint=answer.key, height_px=48)
            button.clicked.connect(lambda _=False, answer=answer: self._take(answer))
            self._buttons.addWidget(button)
            self._answers.append((button, answer))
        if self._answers:
            self.set_default(self._answers[-1][0])
        self.open()

    def _set_row(self, head: Text, small: Text, text: str, detail: str) -> None:
        head.setText(text)
        small.setText(detail)
        small.setVisible(bool(detail))

    def set_waiting(self, words: str) -> None:
        """What is being waited for, at the left of the answers."""
        self.waiting.setText(words)

    @property
    def answers(self) -> list[Button]:
        return [button for button, _ in self._answers]

    def _take(self, answer: Answer) -> None:
        self.close_sheet()
        answer.action()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape and any(answer.risky for _, answer in self._answers):
            self._answers[-1][0].click()
            return
        pressed = QKeySequence(event.key())
        for button, answer in self._answers:
            if answer.key and pressed.matches(QKeySequence(answer.key)) == QKeySequence.SequenceMatch.ExactMatch:
                button.click()
                return
        super().keyPressEvent(event)
