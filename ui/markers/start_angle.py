"""The angle a hand already has when it cannot lie neutral: said by the therapist, marked as given."""

from __future__ import annotations

import math

import numpy as np
from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QSpinBox, QWidget

from carpus.core.hand.exercises import SIDES
from carpus.core.types import FloatArray
from carpus.ui import terms
from carpus.ui.controls.button import Button
from carpus.ui.controls.field import Choices, number_field
from carpus.ui.controls.sheet import Sheet
from carpus.ui.controls.text import SEMIBOLD, Text
from carpus.ui.theme import Theme

LARGEST_DEG = 80
ORDER = (1, 0, 2)
"""Flexion first, as it is the one that contractures limit most."""


class StartAngleSheet(Sheet):
    """Three angles with the word for their direction; emits ``kept`` with (3,) radians."""

    kept = Signal(object)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 620)
        body = self.card.body
        body.setSpacing(16)
        body.addWidget(Text(theme, self.tr("The wrist cannot lie straight"), 20, SEMIBOLD))
        words = self.tr(
            "Measure with a goniometer how far the wrist is from straight as it lies now. Carpus adds these "
            "angles to all it measures of the wrist and says so in the report. Bent fingers are fine as they are: zero "
            "of a finger joint is the straight finger, whatever the picture."
        )
        body.addWidget(Text(theme, words, 14, token="text2", wrap=True))
        self.fields: dict[int, tuple[Choices, QSpinBox]] = {}
        for column in ORDER:
            direction = Choices(theme, [(name, terms.movement_name(name)) for name in SIDES[column]], SIDES[column][0])
            value = number_field(theme, LARGEST_DEG, "°")
            value.setAlignment(Qt.AlignmentFlag.AlignRight)
            value.setAccessibleName(terms.movement_name(SIDES[column][0]))
            row = QHBoxLayout()
            row.addWidget(direction, 1)
            row.addWidget(value)
            body.addLayout(row)
            self.fields[column] = (direction, value)
        buttons = QHBoxLayout()
        straight = Button(theme, self.tr("It lies straight"), "plain", height_px=52)
        straight.clicked.connect(lambda: self._keep(np.zeros(3)))
        keep = Button(theme, self.tr("Use these angles"), "primary")
        keep.clicked.connect(lambda: self._keep(self.angles_rad()))
        self.set_default(keep)
        buttons.addStretch(1)
        buttons.addWidget(straight)
        buttons.addWidget(keep)
        body.addLayout(buttons)

    def begin(self, angles_rad: FloatArray) -> None:
        for column, (direction, value) in self.fields.items():
            direction.choose(SIDES[column][0 if angles_rad[column] >= 0 else 1])
            value.setValue(round(abs(math.degrees(angles_rad[column]))))
        self.open(self.fields[ORDER[0]][1])
        self.fields[ORDER[0]][1].selectAll()

    def angles_rad(self) -> FloatArray:
        """Deviation, flexion, pro/supination (3,) as entered."""
        out = np.zeros(3)
        for column, (direction, value) in self.fields.items():
            sign = 1.0 if direction.value() == SIDES[column][0] else -1.0
            out[column] = sign * math.radians(value.value())
        return out

    def _keep(self, angles_rad: FloatArray) -> None:
        self.close_sheet()
        self.kept.emit(angles_rad)
