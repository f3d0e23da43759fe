"""Encrypt everything that is stored, or make it readable again: what it does and does not, the PIN, the code."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QLineEdit, QWidget

from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Card
from carpus.ui.controls.field import Labelled
from carpus.ui.controls.sheet import Sheet
from carpus.ui.controls.text import REGULAR, SEMIBOLD, StateText, Text
from carpus.ui.records.lock_sheet import MOST_SIGNS
from carpus.ui.theme import Theme

LEAST_SIGNS = 10


class EncryptionCard(Card):
    """How it stands, and the way to change it."""

    wanted = Signal()

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme, 24)
        self.body.addWidget(Text(theme, self.tr("Encryption"), 20, SEMIBOLD))
        self.state = StateText(theme, 16, SEMIBOLD)
        self.words = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.button = Button(theme, "", icon="lock", height_px=40)
        self.button.clicked.connect(self.wanted)
        self.body.addWidget(self.state)
        self.body.addWidget(self.words)
        row = QHBoxLayout()
        row.addWidget(self.button)
        row.addStretch(1)
        self.body.addLayout(row)

    def show_state(self, *, is_on: bool, is_ending: bool) -> None:
        """On, off, or on the way to off."""
        if is_ending:
            self.state.show_state("warn", self.tr("Not everything is readable again yet"))
            self.words.setText(self.tr("Some files are still encrypted. The PIN stays until they are not."))
            self.button.set_face(self.tr("Try again…"))
        elif is_on:
            self.state.show_state("good", self.tr("Encrypted on the disk"))
            self.words.setText(
                self.tr(
                    "Patients, sessions and pictures can only be read with the PIN, also from back-ups made since. Not "
                    "protected: a recording until it is stored, names of files (pseudonym, exercise, date), the log, "
                    "exports and reports, and everything while Carpus is open. PIN and recovery code lost, the data "
                    "are lost for good."
                )
            )
            self.button.set_face(self.tr("Make it readable again…"))
        else:
            self.state.show_state("none", self.tr("Off: files are readable"))
            self.words.setText(
                self.tr(
                    "Whoever has this computer’s account or its disk can read patients and sessions. Encryption makes "
                    "them readable with a PIN only, which must be typed at every start."
                )
            )
            self.button.set_face(self.tr("Encrypt…"))


class EncryptSheet(Sheet):
    """``on_wanted`` carries the PIN until now (empty for none) and the new one; ``off_wanted`` the PIN."""

    on_wanted = Signal(str, str)
    off_wanted = Signal(str)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 640, may_close=False)
        self._turning_on = True
        self.title = Text(theme, "", 20, SEMIBOLD)
        self.words = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.old, self.new, self.again = QLineEdit(), QLineEdit(), QLineEdit()
        for line in (self.old, self.new, self.again):
            line.setEchoMode(QLineEdit.EchoMode.Password)
            line.setMaxLength(MOST_SIGNS)
            line.returnPressed.connect(self._go)
        self._old_row = Labelled(theme, self.tr("&PIN until now"), self.old)
        self._new_row = Labelled(theme, self.tr("&New PIN, ten signs or more; four words are good"), self.new)
        self._again_row = Labelled(theme, self.tr("The same &again"), self.again)
        self.said = Text(theme, "", 14, SEMIBOLD, "bad", wrap=True)
        self.progress = Text(theme, "", 16, SEMIBOLD)
        self.code = Text(theme, "", 20, SEMIBOLD)
        self.code_words = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.go = Button(theme, "", "primary", hint=self.tr("Enter"))
        self.cancel = Button(theme, self.tr("Cancel"), "plain", height_px=52)
        self.done = Button(theme, "", "primary")
        self.go.clicked.connect(self._go)
        self.cancel.clicked.connect(self.close_sheet)
        self.done.clicked.connect(self.close_sheet)
        self.card.body.setSpacing(12)
        self._asking = (self.words, self._new_row, self._again_row, self.go, self.cancel)
        for widget in (
            self.title, self.words, self._old_row, self._new_row, self._again_row, self.said, self.progress,
            self.code_words, self.code,
        ):  # fmt: skip
            self.card.body.addWidget(widget)
        buttons = QHBoxLayout()
        buttons.addStretch(1)
        for button in (self.cancel, self.go, self.done):
            buttons.addWidget(button)
        self.card.body.addLayout(buttons)

    def begin(self, *, turning_on: bool, has_pin: bool) -> None:
        """Say what it means, and ask."""
        self._turning_on = turning_on
        if turning_on:
            self.title.setText(self.tr("Encrypt what is stored"))
            self.words.setText(
                self.tr(
                    "Protects patients, sessions, pictures and new back-ups from whoever takes the computer or a disk. "
                    "Does not protect: a recording until it is stored, names of files (pseudonym, exercise, date), "
                    "the log, exports, back-ups made before, and everything while Carpus is open.\n\n"
                    "The PIN is asked for at every start. Without it and without the recovery code that is shown "
                    "next, the data are lost for good, and nobody can help. Make a back-up first."
                )
            )
            self.go.set_face(self.tr("Encrypt"))
        else:
            self.title.setText(self.tr("Make it readable again"))
            self.words.setText(self.tr("Every file is decrypted. From then on whoever has the disk can read it."))
            self.go.set_face(self.tr("Decrypt"))
        for line in (self.old, self.new, self.again):
            line.clear()
        for widget in self._asking:
            widget.show()
        self._old_row.setVisible(has_pin)
        self._new_row.setVisible(turning_on)
        self._again_row.setVisible(turning_on)
        for text in (self.said, self.progress, self.code, self.code_words):
            text.hide()
        self.done.hide()
        self.open(self.old if has_pin else self.new)

    def say(self, words: str) -> None:
        """What keeps it from being done."""
        self.said.setText(words)
        self.said.show()

    def show_progress(self, percent: int) -> None:
        """While it runs nothing can be asked or closed."""
        for widget in (*self._asking, self._old_row, self.said):
            widget.hide()
        verb = self.tr("Encrypting, {percent} %") if self._turning_on else self.tr("Decrypting, {percent} %")
        self.progress.setText(verb.format(percent=percent))
        self.progress.show()

    def show_code(self, code: str) -> None:
        """Done: the recovery code, this once."""
        self.progress.setText(self.tr("Everything that is stored is encrypted."))
        self.code_words.setText(
            self.tr(
                "Recovery code: it opens everything when the PIN is forgotten. Write it down now and keep it away from "
                "this computer; it is not shown again."
            )
        )
        self.code.setText(code)
        self.done.set_face(self.tr("I have written it down"))
        for widget in (self.progress, self.code_words, self.code, self.done):
            widget.show()
        self.done.setFocus()

    def _go(self) -> None:
        if not self._turning_on:
            self.off_wanted.emit(self.old.text())
        elif len(self.new.text()) < LEAST_SIGNS:
            self.say(self.tr("Files can be carried away and tried: ten signs or more."))
        elif self.new.text() != self.again.text():
            self.say(self.tr("The two are not the same."))
        else:
            self.on_wanted.emit(self.old.text(), self.new.text())
