"""Rank three: a strip above the list that stays until it is answered."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QVBoxLayout

from carpus.core.words import Words
from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Card
from carpus.ui.controls.text import REGULAR, SEMIBOLD, Sign, Text
from carpus.ui.theme import Theme


class NoticeStrip(Card):
    """``answered`` by the button, ``later`` by the other one or Esc; without words on the button it only tells."""

    answered = Signal()
    later = Signal()

    def __init__(self, theme: Theme, words: Words, button: str, icon: str = "history", later: str = "") -> None:
        super().__init__(theme, 0, "soft", "accent")
        self.words = words
        texts = QVBoxLayout()
        texts.setSpacing(4)
        texts.addWidget(Text(theme, words.happened, 20, SEMIBOLD, wrap=True))
        for line in (words.safe, words.do):
            if line:
                texts.addWidget(Text(theme, line, 14, REGULAR, wrap=True))
        self.button = Button(theme, button, "plain", height_px=40)
        self.button.setVisible(bool(button))
        self.later_button = Button(theme, later or self.tr("Later"), "quiet", hint=self.tr("Esc"), height_px=36)
        buttons = QVBoxLayout()
        buttons.setSpacing(4)
        buttons.addWidget(self.button)
        buttons.addWidget(self.later_button, 0, Qt.AlignmentFlag.AlignHCenter)
        row = QHBoxLayout()
        row.setContentsMargins(24, 14, 18, 12)
        row.setSpacing(20)
        row.addWidget(Sign(theme, icon, 24, (26, 32)), 0, Qt.AlignmentFlag.AlignTop)
        row.addLayout(texts, 1)
        row.addLayout(buttons)
        row.setAlignment(buttons, Qt.AlignmentFlag.AlignTop)  # a stretch here would pull it open on an empty list
        self.body.addLayout(row)
        self.setAccessibleName(" ".join((words.happened, words.safe, words.do)))
        self.button.clicked.connect(self.answered)
        self.later_button.clicked.connect(self.later)
