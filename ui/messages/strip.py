"""Rank three: a strip above the list that stays until it is answered."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QWidget

from carpus.core.words import Words
from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Card
from carpus.ui.controls.layouts import in_column, in_line
from carpus.ui.controls.text import REGULAR, SEMIBOLD, Sign, Text
from carpus.ui.theme import Theme


class NoticeStrip(Card):
    """``answered`` by the button, ``later`` by the other one or Esc; without words on the button it only tells."""

    answered = Signal()
    later = Signal()

    def __init__(self, theme: Theme, words: Words, button: str, icon: str = "history", later: str = "") -> None:
        super().__init__(theme, 0, "soft", "accent")
        self.words = words
        texts = in_column(Text(theme, words.happened, 20, SEMIBOLD, wrap=True), gap=4)
        for line in (words.safe, words.do):
            if line:
                texts.addWidget(Text(theme, line, 14, REGULAR, wrap=True))
        self.button = Button(theme, button, "plain", height_px=40)
        self.button.setVisible(bool(button))
        self.later_button = Button(theme, later or self.tr("Later"), "quiet", hint=self.tr("Esc"), height_px=36)
        buttons = in_column(self.button, (self.later_button, 0, Qt.AlignmentFlag.AlignHCenter), gap=4)
        row = in_line(
            (Sign(theme, icon, 24, (26, 32)), 0, Qt.AlignmentFlag.AlignTop),
            (texts, 1),
            buttons,
            gap=20,
            margins=(24, 14, 18, 12),
        )
        row.setAlignment(buttons, Qt.AlignmentFlag.AlignTop)  # a stretch here would pull it open on an empty list
        self.body.addLayout(row)
        self.setAccessibleName(" ".join((words.happened, words.safe, words.do)))
        self.button.clicked.connect(self.answered)
        self.later_button.clicked.connect(self.later)


def put_off_last(screen: QWidget) -> bool:
    """Answer the last strip that is shown on a screen by Later, as Esc does; whether there was one."""
    strips = [strip for strip in screen.findChildren(NoticeStrip) if strip.isVisible()]
    if strips:
        strips[-1].later.emit()
    return bool(strips)
