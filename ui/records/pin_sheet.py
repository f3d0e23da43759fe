"""Set, change or take away the PIN."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QLineEdit, QWidget

from carpus.ui.controls.button import Button
from carpus.ui.controls.field import Labelled
from carpus.ui.controls.layouts import STRETCH, fill, in_line
from carpus.ui.controls.sheet import Sheet
from carpus.ui.controls.text import REGULAR, SEMIBOLD, Text
from carpus.ui.records.lock_sheet import MOST_SIGNS
from carpus.ui.theme import Theme

LEAST_SIGNS = 4


class PinSheet(Sheet):
    """``chosen`` carries the old PIN (empty for none) and the new one, empty to take it away."""

    chosen = Signal(str, str)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 560)
        self.title = Text(theme, "", 20, SEMIBOLD)
        self.old, self.new, self.again = QLineEdit(), QLineEdit(), QLineEdit()
        for line in (self.old, self.new, self.again):
            line.setEchoMode(QLineEdit.EchoMode.Password)
            line.setMaxLength(MOST_SIGNS)
        self._old_row = Labelled(theme, self.tr("&PIN until now"), self.old)
        self.said = Text(theme, "", 14, SEMIBOLD, "bad", wrap=True)
        self.keep = Button(theme, self.tr("Keep this PIN"), "primary")
        self.remove = Button(theme, self.tr("&Take the PIN away"), "plain", height_px=52)
        cancel = Button(theme, self.tr("Cancel"), "plain", hint=self.tr("Esc"), height_px=52)
        self.keep.clicked.connect(self._keep)
        self.set_default(self.keep)
        self.remove.clicked.connect(lambda: self.chosen.emit(self.old.text(), ""))
        cancel.clicked.connect(self.close_sheet)
        words = self.tr(
            "Four signs or more, digits or letters. It hides names and pictures from those who pass by; files are "
            "readable for whoever has this computer’s account or disk."
        )
        self.card.body.setSpacing(12)
        fill(
            self.card.body,
            self.title,
            Text(theme, words, 14, REGULAR, "text2", wrap=True),
            self._old_row,
            Labelled(theme, self.tr("&New PIN"), self.new),
            Labelled(theme, self.tr("The same &again"), self.again),
            self.said,
        )
        self.card.body.addLayout(in_line(self.remove, STRETCH, cancel, self.keep))

    def begin(self, *, is_set: bool) -> None:
        """Ask; the old one first where there is one."""
        self.title.setText(self.tr("Change the PIN") if is_set else self.tr("Set a PIN"))
        self._old_row.setVisible(is_set)
        self.remove.setVisible(is_set)
        for line in (self.old, self.new, self.again):
            line.clear()
        self.said.hide()
        self.open(self.old if is_set else self.new)

    def say(self, words: str) -> None:
        """What keeps it from being changed."""
        self.said.setText(words)
        self.said.show()

    def _keep(self) -> None:
        if len(self.new.text()) < LEAST_SIGNS:
            self.say(self.tr("A PIN has four signs or more."))
        elif self.new.text() != self.again.text():
            self.say(self.tr("The two are not the same."))
        else:
            self.chosen.emit(self.old.text(), self.new.text())
