"""The parts that Carpus is made of and their licences, to be read and copied."""

from __future__ import annotations

from PySide6.QtWidgets import QDialog, QPlainTextEdit, QWidget

from carpus.ui.controls.layouts import in_column
from carpus.ui.theme import MARGIN_PX, Theme


class LicencesWindow(QDialog):
    """A window of its own with a long text; Esc closes it."""

    def __init__(self, parent: QWidget, theme: Theme, text: str) -> None:
        super().__init__(parent)
        self.setWindowTitle(self.tr("Parts and their licences"))
        self.text = QPlainTextEdit(text)
        self.text.setReadOnly(True)
        self.text.setAccessibleName(self.windowTitle())
        in_column(self.text, margins=(MARGIN_PX, MARGIN_PX, MARGIN_PX, MARGIN_PX), within=self)
        self.resize(theme.px(860), theme.px(600))
