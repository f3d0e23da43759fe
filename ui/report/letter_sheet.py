"""To whom a letter goes, in which language, and whether it names the patient."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QComboBox, QPlainTextEdit, QWidget

from carpus.ui.controls.button import Button, Tick
from carpus.ui.controls.field import Choices, Labelled
from carpus.ui.controls.layouts import STRETCH, in_line
from carpus.ui.controls.sheet import Sheet
from carpus.ui.controls.text import REGULAR, SEMIBOLD, Text
from carpus.ui.language import LANGUAGES, spoken
from carpus.ui.report.letter_page import MOST_ADDRESS_LINES, address_lines
from carpus.ui.theme import Theme

ADDRESS_PX = 84


class LetterSheet(Sheet):
    """``wanted`` carries the recipient, the language by two letters, and whether the real name is printed."""

    wanted = Signal(str, str, bool)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 560)
        body = self.card.body
        body.setSpacing(8)
        body.addWidget(Text(theme, self.tr("Letter to the doctor"), 20, SEMIBOLD))
        words = self.tr("One page, with the figures of this session and your comment. Addresses stay in your list.")
        body.addWidget(Text(theme, words, 14, REGULAR, "text2", wrap=True))
        self.known = QComboBox()
        self.known.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.known.setPlaceholderText(self.tr("Written to before"))
        self.known.setAccessibleName(self.tr("Written to before"))
        body.addWidget(self.known)
        self.recipient = QPlainTextEdit()
        self.recipient.setTabChangesFocus(True)
        self.recipient.textChanged.connect(self._check)
        theme.follow(self.recipient, lambda: self.recipient.setFixedHeight(theme.px(ADDRESS_PX)))
        caption = self.tr("Name and address, up to {count} lines").format(count=MOST_ADDRESS_LINES)
        body.addWidget(Labelled(theme, caption, self.recipient))
        words = self.tr("Name and address, up to {count} lines").format(count=MOST_ADDRESS_LINES)
        self.too_long = Text(theme, words, 14, SEMIBOLD, "bad", wrap=True)
        self.too_long.hide()
        body.addWidget(self.too_long)
        body.addWidget(Text(theme, self.tr("Language of the letter"), 14, REGULAR, "text2"))
        self.language = Choices(theme, list(LANGUAGES.items()), "en")
        body.addWidget(self.language)
        self.names = Tick(theme, self.tr("Print the patient’s real name"))
        body.addWidget(self.names)
        words = self.tr("The name goes into this letter only. Anybody who gets the file can read it.")
        self.names_note = Text(theme, words, 14, SEMIBOLD, "warn", wrap=True)
        body.addWidget(self.names_note)
        row = in_line(STRETCH, gap=10)
        self.close_button = Button(theme, self.tr("Cancel"), "plain", hint=self.tr("Esc"), height_px=44)
        self.take = Button(theme, self.tr("Show the letter"), "primary", height_px=44)
        row.addWidget(self.close_button)
        row.addWidget(self.take)
        body.addLayout(row)
        self._language = ""
        self._addresses: Sequence[str] = ()
        self.known.activated.connect(lambda place: self.recipient.setPlainText(self._addresses[place]))
        self.language.chosen.connect(self._take_language)
        self.names.toggled.connect(self.names_note.setVisible)
        self.close_button.clicked.connect(self.close_sheet)
        self.take.clicked.connect(self._take)
        self.set_default(self.take)

    def begin(self, known: Sequence[str], *, has_name: bool) -> None:
        """Ask; the name is never ticked by itself."""
        self._addresses = known
        self.known.clear()
        self.known.addItems([", ".join(address_lines(one)) for one in known])
        self.known.setCurrentIndex(-1)
        self.known.setVisible(bool(known))
        self.names.setChecked(False)
        self.names.setVisible(has_name)
        self.names_note.hide()
        self._language = self._language or spoken()
        self.language.choose(self._language)
        self.open(self.recipient)

    def _check(self) -> None:
        lines = [line for line in self.recipient.toPlainText().splitlines() if line.strip()]
        self.too_long.setVisible(len(lines) > MOST_ADDRESS_LINES)

    def _take_language(self, code: object) -> None:
        self._language = str(code)

    def _take(self) -> None:
        self.close_sheet()
        text = "\n".join(address_lines(self.recipient.toPlainText()))
        self.wanted.emit(text, self._language, self.names.isChecked() and not self.names.isHidden())
