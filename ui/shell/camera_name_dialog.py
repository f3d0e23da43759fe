"""Dialog that asks for the name of a camera without a serial number."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QLineEdit, QWidget

from carpus.ui.kit.button import Button
from carpus.ui.kit.dialog import Dialog
from carpus.ui.kit.theme import Theme

MAX_NAME_LENGTH = 40


class CameraNameDialog(Dialog):
    """Name of a camera that reports no serial number.

    Signals: ``name_entered`` with the name, ``cancelled``.
    """

    name_entered = Signal(str)
    cancelled = Signal()

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 600)
        self._is_dismissed = False
        self.add_heading()
        self.name_field = QLineEdit(maxLength=MAX_NAME_LENGTH, placeholderText=self.tr("Camera name"))
        self.name_field.setAccessibleName(self.tr("Camera name"))
        self.name_field.setMinimumHeight(theme.px(44))
        self.accept_button = Button(theme, self.tr("Continue"), "primary", height_px=44)
        self.card.body.addWidget(self.name_field)
        self.cancel_button = self.add_buttons(self.accept_button, cancel_text=self.tr("Cancel"), gap=None)
        self.name_field.textChanged.connect(lambda text: self.accept_button.setEnabled(bool(text.strip())))
        self.accept_button.clicked.connect(self._accept)
        self.closed.connect(self._on_closed)

    def request_name(self, previous_name: str) -> None:
        """Open with the name of the last such camera, empty if there was none."""
        self.title.setText(
            self.tr("Is this still the camera “{name}”?").format(name=previous_name)
            if previous_name
            else self.tr("What is this camera called?")
        )
        words = self.tr(
            "This camera has no readable serial number. Name it and label it: calibrations and checks are "
            "saved under that name. Carpus treats every camera of this type without a number as this one."
        )
        if previous_name:
            words = self.tr(
                "This camera has no readable serial number. If it is a different one, enter its name: calibrations "
                "and checks are saved under that name."
            )
        self.words.setText(words)
        self.name_field.setText(previous_name)
        self.name_field.selectAll()
        self.accept_button.setEnabled(bool(previous_name))
        self.open(self.name_field)

    def close_silently(self) -> None:
        """Close without ``cancelled``, when the name is no longer needed."""
        self._is_dismissed = True
        self.close_dialog()
        self._is_dismissed = False

    def _accept(self) -> None:
        name = " ".join(self.name_field.text().split())
        if name:
            self.close_silently()
            self.name_entered.emit(name)

    def _on_closed(self) -> None:
        if not self._is_dismissed:
            self.cancelled.emit()
