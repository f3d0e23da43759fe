"""The help, with the keys in use."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QGridLayout, QHBoxLayout, QScrollArea, QVBoxLayout, QWidget

from ui import terms
from ui.controls.button import Button
from ui.controls.card import Card, KeyCaps
from ui.controls.column import scroll_area
from ui.controls.text import SEMIBOLD, Text, heading
from ui.help.guide import chapters
from ui.keys import DEFAULT_KEYS, Keys, action_words
from ui.theme import GAP_PX, MARGIN_PX, Theme


def actions_by_key(keys: Keys) -> dict[str, list[str]]:
    """What each key does; one key may do different things on different screens."""
    found: dict[str, list[str]] = {}
    for name in DEFAULT_KEYS:
        found.setdefault(keys[name], []).append(action_words(name))
    return found


class HelpScreen(QWidget):
    """``done`` leads back to where the person was."""

    done = Signal()

    def __init__(self, theme: Theme, keys: Keys) -> None:
        super().__init__()
        self.back = Button(theme, self.tr("Back"), "primary", hint=self.tr("Esc"))
        self.back.clicked.connect(self.done)
        left = QVBoxLayout()
        left.setContentsMargins(0, 4, 8, 4)
        left.setSpacing(GAP_PX)
        for title, paragraphs in chapters():
            card = Card(theme, 24)
            card.body.addWidget(Text(theme, title, 20, SEMIBOLD))
            for paragraph in paragraphs:
                card.body.addWidget(Text(theme, paragraph, 14, wrap=True))
            left.addWidget(card)
        left.addWidget(Text(theme, terms.LEGAL_SENTENCE, 12, token="text2", wrap=True))
        left.addStretch(1)
        texts = self._scrolled(left)
        table = Card(theme, 24)
        table.body.addWidget(Text(theme, self.tr("Keys"), 20, SEMIBOLD))
        grid = QGridLayout()
        grid.setVerticalSpacing(6)
        for row, (key, words) in enumerate(actions_by_key(keys).items()):
            grid.addWidget(KeyCaps(theme, [(key, "")]), row, 0)
            grid.addWidget(Text(theme, "\n".join(words), 14, wrap=True), row, 1)
        grid.setColumnStretch(1, 1)
        table.body.addLayout(grid)
        table.body.addStretch(1)
        right = QVBoxLayout()
        right.setContentsMargins(4, 4, 8, 4)
        right.addWidget(table)
        head = QHBoxLayout()
        head.setContentsMargins(0, 0, 8, 0)
        head.addWidget(heading(theme, self.tr("Help")), 1)
        head.addWidget(self.back)
        columns = QHBoxLayout()
        columns.setSpacing(GAP_PX)
        columns.addWidget(texts, 3)
        columns.addWidget(self._scrolled(right), 2)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(MARGIN_PX, GAP_PX, MARGIN_PX - 8, GAP_PX)
        whole.setSpacing(12)
        whole.addLayout(head)
        whole.addLayout(columns, 1)

    def _scrolled(self, column: QVBoxLayout) -> QScrollArea:
        host = QWidget()
        host.setLayout(column)
        return scroll_area(host, Qt.FocusPolicy.StrongFocus)
