"""The field for one number of a measure, with its unit inside."""

from __future__ import annotations

import math

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QLineEdit

from carpus.core.measures.by_hand import HandMeasure, is_unusual
from carpus.ui import numbers
from carpus.ui.by_hand.names import unit_name, value_words
from carpus.ui.controls.field import lay_inside
from carpus.ui.controls.text import caption
from carpus.ui.theme import Theme


class ValueField(QLineEdit):
    """A number with a decimal comma or point, empty for not measured. Enter goes to the next field.

    ``problem`` says what cannot be kept, ``doubt`` what should be looked at again; both mark the edge and stand in the
    tooltip."""

    onward = Signal()

    def __init__(self, theme: Theme, measure: HandMeasure, name: str, width_px: int) -> None:
        super().__init__()
        self._theme, self._measure, self._width_px = theme, measure, width_px
        lay_inside(self, None, caption(theme, unit_name(measure)), edge_px=9)
        self.setAccessibleName(name)
        self.setMaxLength(8)
        self.textChanged.connect(lambda _: self._take_theme())
        theme.changed.connect(self._take_theme)
        self._take_theme()

    def value(self) -> float:
        """In the measure's unit; NaN where nothing, or no number, is written."""
        text = self.text().strip().removesuffix("°").strip().replace(",", ".").replace("−", "-")
        try:
            value = float(text)
        except ValueError:
            return math.nan
        return value if math.isfinite(value) else math.nan

    def set_value(self, value: float) -> None:
        """Show a number; NaN empties the field."""
        self.setText(numbers.figures(value, 6) if math.isfinite(value) else "")

    @property
    def is_empty(self) -> bool:
        """Whether nothing is written."""
        return not self.text().strip()

    @property
    def problem(self) -> str:
        """Why it cannot be kept; empty when it can."""
        of, value = self._measure, self.value()
        if self.is_empty or of.least <= value <= of.most:
            return ""
        pattern = self.tr("A number from {least} to {most}, or empty")
        return pattern.format(least=numbers.figures(of.least, 6), most=value_words(of, of.most))

    @property
    def doubt(self) -> str:
        """``180°? Usual is up to 100°``; empty where nothing is unusual."""
        of, value = self._measure, self.value()
        if self.problem or not math.isfinite(value) or not is_unusual(of, value):
            return ""
        low, high = (value_words(of, end) for end in of.usual)
        return self.tr("{value}? Usual is {low} to {high}").format(value=value_words(of, value), low=low, high=high)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        plain = event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier == Qt.KeyboardModifier.NoModifier
        if plain and event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self.onward.emit()
        else:
            super().keyPressEvent(event)

    def _take_theme(self) -> None:
        unit_px = 46 if self._measure.unit == "points" else 26
        self.setTextMargins(0, 0, self._theme.px(unit_px), 0)
        self.setFixedWidth(self._theme.px(self._width_px))
        token = "bad" if self.problem else "warn" if self.doubt else ""
        edge = getattr(self._theme.tokens, token) if token else ""
        self.setStyleSheet(f"QLineEdit {{ border: 2px solid {edge}; }}" if edge else "")
        self.setToolTip(self.problem or self.doubt)
        self.setAccessibleDescription(self.problem or self.doubt)
