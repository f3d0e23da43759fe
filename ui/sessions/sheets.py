"""What is asked before a session is set aside, moved, renamed or deleted."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QLineEdit, QWidget

from carpus.ui.controls.button import Button
from carpus.ui.controls.field import Combo
from carpus.ui.controls.layouts import STRETCH, in_line
from carpus.ui.controls.sheet import Sheet
from carpus.ui.theme import Theme


class SetAsideSheet(Sheet):
    """Emits ``kept`` with the reason."""

    kept = Signal(str)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 600)
        words = self.tr("It stays in the list and can be opened, but counts nowhere. It can be taken back.")
        self.head(self.tr("Set this session aside?"), words)
        quick = QHBoxLayout()
        self.buttons: list[Button] = []
        for reason in (self.tr("wrong exercise"), self.tr("trial"), self.tr("discs lost"), self.tr("pain")):
            button = Button(theme, reason, "plain", height_px=40)
            button.clicked.connect(lambda _=False, reason=reason: self._keep(reason))
            quick.addWidget(button)
            self.buttons.append(button)
        quick.addStretch(1)
        self.card.body.addLayout(quick)
        self.line = QLineEdit(placeholderText=self.tr("Another reason"))
        self.line.setAccessibleName(self.tr("Another reason"))
        self.take = Button(theme, self.tr("Set it aside"), "plain")
        self.take.clicked.connect(lambda: self._keep(self.line.text().strip()))
        self.line.textChanged.connect(self._written)
        self.card.body.addWidget(self.line)
        self.close_button = Button(theme, self.tr("Let it count"), "plain")
        self.close_button.clicked.connect(self.close_sheet)
        self.card.body.addLayout(in_line(STRETCH, self.take, self.close_button))

    def begin(self) -> None:
        self.line.clear()
        self._written("")
        self.open()

    def _written(self, text: str) -> None:
        """Who writes a reason means it; without one nothing is set aside by Enter."""
        self.take.setEnabled(bool(text.strip()))
        self.set_default(self.take if text.strip() else self.close_button)

    def _keep(self, reason: str) -> None:
        if reason:
            self.close_sheet()
            self.kept.emit(reason)


class ChooseSheet(Sheet):
    """A list to choose one from; emits ``chosen`` with its key. Used for the right patient and the exercise."""

    chosen = Signal(str)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 600)
        self.head()
        self.box = Combo()
        self.box.setAccessibleName(self.tr("Choice"))
        self.card.body.addWidget(self.box)
        self.take = Button(theme, "", "primary", height_px=44)
        self.take.clicked.connect(self._take)
        close = Button(theme, self.tr("Leave it as it is"), "plain", height_px=44)
        close.clicked.connect(self.close_sheet)
        self.set_default(close)
        self.card.body.addLayout(in_line(STRETCH, self.take, close))

    def begin(self, title: str, words: str, take: str, choices: Sequence[tuple[str, str]]) -> None:
        """Ask for one of the (key, text); ``take`` is what the button says."""
        self.title.setText(title)
        self.words.setText(words)
        self.take.set_face(take)
        self.box.offer(choices)
        self.take.setEnabled(bool(choices))
        self.open(self.box if self.take.isEnabled() else None)

    def _take(self) -> None:
        key = self.box.currentData()
        self.close_sheet()
        self.chosen.emit(str(key))
