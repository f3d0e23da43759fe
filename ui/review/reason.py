"""What a repetition is, if it does not count: passive, or left out for one of a few reasons or a few words."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QLineEdit, QWidget

from carpus.core.results.repetition_rows import PASSIVE
from carpus.ui.controls.button import Button
from carpus.ui.controls.layouts import STRETCH, fill
from carpus.ui.controls.sheet import Sheet
from carpus.ui.controls.text import SEMIBOLD, Text
from carpus.ui.theme import Theme


class ReasonSheet(Sheet):
    """Emits ``kept`` with the reason, and whether it is that of all repetitions after it as well."""

    kept = Signal(str, bool)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 560)
        self._title = Text(theme, "", 20, SEMIBOLD)
        body = self.card.body
        body.setSpacing(12)
        body.addWidget(self._title)
        words = self.tr("Passive: somebody else moved the hand. It counts apart, beside the active ones.")
        body.addWidget(Text(theme, words, 14, token="text2", wrap=True))
        helped = QHBoxLayout()
        self.passive = Button(theme, self.tr("Passive"), "plain", height_px=40)
        self.passive.clicked.connect(lambda: self._keep(PASSIVE))
        self.passive_on = Button(theme, self.tr("Passive, and all after it"), "plain", height_px=40)
        self.passive_on.clicked.connect(lambda: self._keep(PASSIVE, and_after=True))
        fill(helped, self.passive, self.passive_on, STRETCH)
        body.addLayout(helped)
        words = self.tr(
            "Left out: it stays in the recording and on the curves, and counts no longer. The report says so."
        )
        body.addWidget(Text(theme, words, 14, token="text2", wrap=True))
        quick = QHBoxLayout()
        self.buttons: list[Button] = []
        for reason in (self.tr("pain"), self.tr("other movement"), self.tr("trial")):
            button = Button(theme, reason, "plain", height_px=40)
            button.clicked.connect(lambda _=False, reason=reason: self._keep(reason))
            quick.addWidget(button)
            self.buttons.append(button)
        quick.addStretch(1)
        body.addLayout(quick)
        row = QHBoxLayout()
        self.line = QLineEdit()
        self.line.setPlaceholderText(self.tr("Another reason"))
        self.line.setAccessibleName(self.tr("Another reason"))
        self.line.textChanged.connect(self._written)
        self._take = Button(theme, self.tr("Leave it out"), "plain")
        self._take.clicked.connect(lambda: self._keep(self.line.text().strip()))
        self._close = Button(theme, self.tr("Keep it in"), "plain")
        self._close.clicked.connect(self.close_sheet)
        fill(row, (self.line, 1), self._take, self._close)
        body.addLayout(row)

    def begin(self, number: int) -> None:
        self._title.setText(self.tr("Is repetition {number} passive, or left out?").format(number=number))
        self.line.clear()
        self._written("")
        self.open()

    def _written(self, text: str) -> None:
        """Who writes a reason means it; without one nothing is left out by Enter."""
        self._take.setEnabled(bool(text.strip()))
        self.set_default(self._take if text.strip() else self._close)

    def _keep(self, reason: str, *, and_after: bool = False) -> None:
        if reason:
            self.close_sheet()
            self.kept.emit(reason, and_after)
