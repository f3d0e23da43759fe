"""Card of the settings with the folders that are shared with a practice system."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QCheckBox, QFileDialog

from carpus.ui.kit.button import Button
from carpus.ui.kit.card import Card
from carpus.ui.kit.layouts import STRETCH, fill, row_layout
from carpus.ui.kit.text import SEMIBOLD, Text
from carpus.ui.kit.theme import Theme


class PracticeSystemCard(Card):
    """Folders for GDT files of patients and of results.

    Signals: ``changed`` with both folders and whether results are written as FHIR too; ``test_requested``.
    """

    changed = Signal(str, str, bool)
    test_requested = Signal()

    def __init__(self, theme: Theme, requests: str, results: str, fhir: bool, *, is_demo: bool = False) -> None:
        super().__init__(theme, 24)
        words = self.tr(
            "The clinic software writes a patient as a GDT 2.1 file into the first folder, and Carpus opens the "
            "patient. “Send to clinic software” next to a report writes its values and the PDF into the second "
            "folder. These files contain real names."
        )
        self._folders = [requests, results]
        self._texts = [Text(theme, "", 14, wrap=True) for _ in self._folders]
        self.folder_buttons = [Button(theme, self.tr("Change…"), height_px=40) for _ in self._folders]
        self.clear_buttons = [Button(theme, self.tr("Turn off"), "quiet", height_px=40) for _ in self._folders]
        self.test_button = Button(theme, self.tr("Test the folders"), height_px=40)
        self.test_text = Text(theme, "", 14, SEMIBOLD, wrap=True)
        self.add_heading(self.tr("Clinic software (GDT)"), words)
        if is_demo:
            note = self.tr("The demo does not read patients from the clinic software.")
            self.body.addWidget(Text(theme, note, 14, SEMIBOLD, "warn", wrap=True))
        titles = (self.tr("Patients from the clinic software"), self.tr("Results for the clinic software"))
        for number, title in enumerate(titles):
            row = row_layout(self.folder_buttons[number], self.clear_buttons[number], STRETCH, gap=8)
            fill(self.body, 8, Text(theme, title, 14, SEMIBOLD, wrap=True), self._texts[number], row)
            self.folder_buttons[number].setAccessibleName(f"{title}: {self.tr('Change…')}")
            self.clear_buttons[number].setAccessibleName(f"{title}: {self.tr('Turn off')}")
            self.folder_buttons[number].clicked.connect(lambda _=False, number=number: self._choose(number))
            self.clear_buttons[number].clicked.connect(lambda _=False, number=number: self._set(number, ""))
        self.fhir_check = QCheckBox(self.tr("Write results as FHIR R4 (JSON) too"))
        self.fhir_check.setChecked(fhir)
        self.fhir_check.toggled.connect(self._emit_changed)
        fill(self.body, self.fhir_check, 8, row_layout(self.test_button, (self.test_text, 1), gap=16))
        self.test_button.clicked.connect(self.test_requested)
        self._show()

    def show_test(self, words: str) -> None:
        """Show what a test of the folders found."""
        self.test_text.setText(words)

    def _choose(self, number: int) -> None:
        path = QFileDialog.getExistingDirectory(self, self.tr("Choose a folder"), self._folders[number])
        if path:
            self._set(number, path)

    def _set(self, number: int, folder: str) -> None:
        self._folders[number] = folder
        self._show()
        self._emit_changed()

    def _emit_changed(self) -> None:
        self.changed.emit(*self._folders, self.fhir_check.isChecked())

    def _show(self) -> None:
        for folder, text, clear in zip(self._folders, self._texts, self.clear_buttons, strict=True):
            text.setText(folder or self.tr("No folder chosen"))
            clear.setVisible(bool(folder))
        self.fhir_check.setEnabled(bool(self._folders[1]))
        self.test_button.setEnabled(any(self._folders))
        self.test_text.setText("")
