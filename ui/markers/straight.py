"""Whole hand, once the names are given: do the fingers lie straight? One click for each that cannot."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QGridLayout, QVBoxLayout, QWidget

from carpus.core.calibration.result import ALL_STRAIGHT
from carpus.ui.controls.button import Button
from carpus.ui.controls.text import REGULAR, SEMIBOLD, Text
from carpus.ui.marker_words import finger_name
from carpus.ui.theme import Theme


class StraightFingers(QWidget):
    """``changed`` carries the answer, thumb to little: True where the finger lies straight. All do until clicked."""

    changed = Signal(object)

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._question = Text(theme, self.tr("Do the fingers lie straight?"), 14, SEMIBOLD)
        self._said = Text(theme, "", 12, REGULAR, "text2", wrap=True)
        self.buttons: list[Button] = []
        grid = QGridLayout()
        grid.setSpacing(4)
        for number in range(1, 6):
            button = Button(theme, finger_name(str(number)), "well", height_px=32)
            button.setCheckable(True)
            button.setFocusPolicy(Qt.FocusPolicy.NoFocus)  # the keys 1 to 5 do it; Enter goes on
            button.clicked.connect(self._clicked)
            grid.addWidget(button, (number - 1) // 3, (number - 1) % 3)
            self.buttons.append(button)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(4)
        column.addWidget(self._question)
        column.addLayout(grid)
        column.addWidget(self._said)
        self.show_answer(ALL_STRAIGHT)

    @property
    def answer(self) -> tuple[bool, ...]:
        """Thumb to little, True where the finger lies straight."""
        return tuple(not button.isChecked() for button in self.buttons)

    def show_answer(self, straight: tuple[bool, ...]) -> None:
        """Show an answer without telling it."""
        for number, (button, lies_straight) in enumerate(zip(self.buttons, straight, strict=True), start=1):
            button.setChecked(not lies_straight)
            self._name(button, number)
        self._say()

    def toggle(self, number: int) -> None:
        """The finger, 1 thumb to 5 little, cannot lie straight, or can after all."""
        self.buttons[number - 1].click()

    def _clicked(self) -> None:
        for number, button in enumerate(self.buttons, start=1):
            self._name(button, number)
        self._say()
        self.changed.emit(self.answer)

    def _name(self, button: Button, number: int) -> None:
        finger = finger_name(str(number))
        face = self.tr("{finger} bent").format(finger=finger) if button.isChecked() else finger
        button.set_face(face)

    def _say(self) -> None:
        bent = self.answer.count(False)
        self._said.setText(
            self.tr("Click a finger that cannot lie straight (keys 1 to 5).")
            if not bent
            else self.tr("A bent finger is measured from its own rest, and less surely.")
        )
