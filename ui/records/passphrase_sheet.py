"""The passphrase of a file that leaves the computer: chosen twice to seal it, typed once to open it."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtWidgets import QLineEdit, QWidget

from carpus.core.names import is_passphrase
from carpus.ui.controls.button import Button
from carpus.ui.controls.field import Labelled
from carpus.ui.controls.layouts import STRETCH, fill, in_line
from carpus.ui.controls.sheet import Sheet
from carpus.ui.controls.text import REGULAR, SEMIBOLD, Text
from carpus.ui.theme import Theme


class PassphraseSheet(Sheet):
    """Asks, and hands what was typed to whoever asked."""

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 560)
        self.title = Text(theme, "", 20, SEMIBOLD)
        self.words = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.first, self.again = QLineEdit(), QLineEdit()
        for line in (self.first, self.again):
            line.setEchoMode(QLineEdit.EchoMode.Password)
        self._again_row = Labelled(theme, self.tr("The same &again"), self.again)
        self.said = Text(theme, "", 14, SEMIBOLD, "bad", wrap=True)
        self.go = Button(theme, "", "primary")
        cancel = Button(theme, self.tr("Cancel"), "plain", hint=self.tr("Esc"), height_px=52)
        self.go.clicked.connect(self._take)
        cancel.clicked.connect(self.close_sheet)
        body = self.card.body
        body.setSpacing(12)
        fill(
            body,
            self.title,
            self.words,
            Labelled(theme, self.tr("&Passphrase"), self.first),
            self._again_row,
            self.said,
        )
        body.addLayout(in_line(STRETCH, cancel, self.go))
        self.set_default(self.go)
        self._chosen: Callable[[str], None] = lambda _: None
        self._seals = True

    def begin(self, chosen: Callable[[str], None], *, seals: bool) -> None:
        """Ask for a new one where a file is to be sealed, else for that of a file."""
        self._chosen, self._seals = chosen, seals
        self.title.setText(self.tr("Seal into one file") if seals else self.tr("Open the sealed file"))
        self.go.set_face(self.tr("Seal it") if seals else self.tr("Open it"))
        self.words.setText(
            self.tr("Ten signs or more, best four words. Write it down: without it nobody can open the file.")
            if seals
            else self.tr("As it was typed when the file was sealed.")
        )
        self._again_row.setVisible(seals)
        for line in (self.first, self.again):
            line.clear()
        self.said.hide()
        self.open(self.first)

    def _take(self) -> None:
        typed = self.first.text()
        words = ""
        if self._seals and not is_passphrase(typed):
            words = self.tr("A passphrase has ten signs or more.")
        elif self._seals and typed != self.again.text():
            words = self.tr("The two are not the same.")
        self.said.setText(words)
        self.said.setVisible(bool(words))
        if not words and typed:
            self.first.clear()
            self.again.clear()
            self.close_sheet()
            self._chosen(typed)
