"""What a camera is called that does not tell its number: asked before it is calibrated or checked."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QLineEdit, QWidget

from carpus.ui.controls.button import Button
from carpus.ui.controls.sheet import Sheet
from carpus.ui.theme import Theme

MOST_LETTERS = 40


class CameraNameSheet(Sheet):
    """``named`` carries the name, ``refused`` that none was given."""

    named = Signal(str)
    refused = Signal()

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 600)
        self._silent = False
        self.head()
        self.line = QLineEdit(maxLength=MOST_LETTERS, placeholderText=self.tr("Name of the camera"))
        self.line.setAccessibleName(self.tr("Name of the camera"))
        self.line.setMinimumHeight(theme.px(44))
        self.take = Button(theme, self.tr("Go on"), "primary", height_px=44)
        self.card.body.addWidget(self.line)
        self.stop = self.answer_row(self.take, words=self.tr("Stop"), gap=None)
        self.line.textChanged.connect(lambda text: self.take.setEnabled(bool(text.strip())))
        self.take.clicked.connect(self._take)
        self.closed.connect(self._closed)

    def begin(self, known: str) -> None:
        """Ask; ``known`` is how such a camera was called last time, empty where it never was."""
        self.title.setText(
            self.tr("Is this still the camera called “{name}”?").format(name=known)
            if known
            else self.tr("What is this camera called?")
        )
        words = self.tr(
            "It does not tell its number. Give it a name and write that on it: calibrations and checks are kept under "
            "the name, and from now on every camera of this kind without a number is taken for this one."
        )
        if known:
            words = self.tr(
                "It does not tell its number. If it is another one, type that one’s name: calibrations and checks are "
                "kept under the name."
            )
        self.words.setText(words)
        self.line.setText(known)
        self.line.selectAll()
        self.take.setEnabled(bool(known))
        self.open(self.line)

    def dismiss(self) -> None:
        """Close without an answer: what it was asked for is over."""
        self._silent = True
        self.close_sheet()
        self._silent = False

    def _take(self) -> None:
        name = " ".join(self.line.text().split())
        if name:
            self.dismiss()
            self.named.emit(name)

    def _closed(self) -> None:
        if not self._silent:
            self.refused.emit()
