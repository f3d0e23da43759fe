"""Fields: text, search, number, date and choices."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Sequence
from datetime import date

from PySide6.QtCore import QEvent, QObject, QSize, Qt, Signal
from PySide6.QtWidgets import (
    QAbstractSpinBox,
    QButtonGroup,
    QComboBox,
    QHBoxLayout,
    QLineEdit,
    QListWidget,
    QSizePolicy,
    QSpinBox,
    QStyle,
    QStyleOptionComboBox,
    QWidget,
)

from carpus.ui.kit import numbers
from carpus.ui.kit.button import Button
from carpus.ui.kit.fonts import font
from carpus.ui.kit.layouts import FlowLayout, column_layout, row_layout
from carpus.ui.kit.text import MEDIUM, SEMIBOLD, Icon, Text, caption
from carpus.ui.kit.theme import Theme


def add_inside(line: QLineEdit, *parts: QWidget | None, edge_px: int = 15) -> None:
    """Put widgets over a line edit; None is a stretch between them."""
    row = row_layout(margins=(edge_px, 0, edge_px, 0), parent=line)
    for part in parts:
        if part is None:
            row.addStretch(1)
        else:
            part.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
            row.addWidget(part)


class SearchField(QLineEdit):
    """Line with a magnifier before, and a key hint behind the text."""

    def __init__(self, theme: Theme, placeholder: str, hint: str) -> None:
        super().__init__()
        self._theme = theme
        shown = caption(theme, hint)
        add_inside(self, Icon(theme, "search", 18, (18, 20), "text2"), None, shown)
        self.textChanged.connect(lambda text: shown.setVisible(not text))
        self.setPlaceholderText(placeholder)
        self.setAccessibleName(placeholder)
        theme.changed.connect(self._apply_theme)
        self._apply_theme()

    def _apply_theme(self) -> None:
        self.setFont(font(16 * self._theme.text_scale))
        self.setTextMargins(self._theme.px(30), 0, self._theme.px(60), 0)
        self.setFixedHeight(self._theme.px(44))


class _WheelFilter(QObject):
    """Passes the wheel on to the page, which would otherwise change a field unseen."""

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() != QEvent.Type.Wheel:
            return False
        event.ignore()
        return True


def ignore_wheel(field: QAbstractSpinBox | QComboBox) -> None:
    """Make a field ignore the wheel."""
    field.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
    field.installEventFilter(_WheelFilter(field))


class Combo(QComboBox):
    """Combo box as wide as its longest choice, elided if there is less room; ignores the wheel."""

    def __init__(self) -> None:
        super().__init__()
        self.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToContents)
        ignore_wheel(self)

    def set_choices(self, choices: Iterable[tuple[object, str]], selected: object = None) -> None:
        """Replace all choices (value, text) and select one, without emitting a signal."""
        self.blockSignals(True)
        self.clear()
        for number, (value, words) in enumerate(choices):
            self.addItem(words, value)
            if value == selected:
                self.setCurrentIndex(number)
        self.blockSignals(False)

    def choose(self, value: object) -> None:
        self.setCurrentIndex(self.findData(value))

    def initStyleOption(self, option: QStyleOptionComboBox) -> None:
        super().initStyleOption(option)
        part = QStyle.SubControl.SC_ComboBoxEditField
        room = self.style().subControlRect(QStyle.ComplexControl.CC_ComboBox, option, part, self).width()
        option.currentText = self.fontMetrics().elidedText(option.currentText, Qt.TextElideMode.ElideRight, room)


COMPLETE_DATE = re.compile(r"\d\d?\D+\d\d?\D+(?:(?:19|20)\d\d|\d\d)|(?:19|20)\d\d\D+\d\d?\D+\d\d?")
"""Day, month and year are present, so an invalid date does not exist."""
MONTH_FIRST = re.compile(r"(?:0?\d|1[0-2])\D+(?:1[3-9]|[2-9]\d)\D")
"""Day and month are swapped: the order is wrong."""


class LabelledField(QWidget):
    """Field under its label, with widgets ``beside`` it and room for a message below."""

    def __init__(self, theme: Theme, label: str, field: QWidget, *beside: QWidget) -> None:
        super().__init__()
        self.name = name = Text(theme, label, 14, MEDIUM, "text2")
        name.setBuddy(field)
        field.setAccessibleName(label.replace("&", ""))
        column = column_layout(name, gap=4, margins=(0, 0, 0, 0), parent=self)
        if beside:
            column.addLayout(row_layout((field, 1), *beside, gap=6))
        else:
            column.addWidget(field)
        self.error = Text(theme, "", 14, SEMIBOLD, "bad", wrap=True)
        self.error.hide()
        column.addWidget(self.error)


def number_field(theme: Theme, maximum: int, suffix: str = "", empty_text: str = "", minimum: int = 0) -> QSpinBox:
    """Return a field for whole numbers; ``empty_text`` is shown for the minimum."""
    field = QSpinBox()
    ignore_wheel(field)
    field.setRange(minimum, maximum)
    field.setSuffix(suffix)
    field.setSpecialValueText(empty_text)
    theme.on_change(field, lambda: field.setFixedWidth(theme.px(110)))
    field.lineEdit().setTextMargins(10, 0, 10, 0)  # the style sheet's padding does not reach the text of a spin box
    return field


class DateField(QLineEdit):
    """Line for a past day as people type one; ``today`` is called each time."""

    def __init__(self, today: Callable[[], date]) -> None:
        super().__init__()
        self._today = today
        self.setPlaceholderText(self.tr("day month year"))

    def value(self) -> date | None:
        """Return the day, None for nothing, a coming day or anything else."""
        day = numbers.parse_date(self.text(), self._today())
        return day if day is not None and day <= self._today() else None

    @property
    def error(self) -> str:
        """Why the text is no past day; empty if it is one, or empty."""
        typed = self.text().strip()
        if not typed or self.value() is not None:
            return ""
        if numbers.parse_date(typed) is not None:
            return self.tr("The date is in the future")
        if COMPLETE_DATE.fullmatch(typed) and not MONTH_FIRST.match(typed):
            return self.tr("This date does not exist")
        return self.tr("Day, month, year")

    @property
    def is_complete(self) -> bool:
        """Whether a year was typed out, so that the date can be checked while typing."""
        return re.search(r"\D\d{4}$|^\d{4}\D+\d+\D+\d\d$", self.text().strip()) is not None

    def set_value(self, day: date | None) -> None:
        self.setText(numbers.format_date(day) if day is not None else "")


SHOWN_DIGITS = 6
"""Significant digits of a number in a field."""


def parse_number(text: str) -> float:
    """Return a number with decimal comma or point, NaN for anything else."""
    if "_" in text:  # Python's, nobody's
        return math.nan
    try:
        value = float(text.strip().removesuffix("°").strip().replace(",", ".").replace("\N{MINUS SIGN}", "-"))
    except ValueError:
        return math.nan
    return value if math.isfinite(value) else math.nan


class NumberField(QLineEdit):
    """Line for a number with decimal comma or point.

    An invalid number stays as it is; the outline marks it, and the tooltip says why.
    """

    def __init__(self, theme: Theme, width_px: int = 110, max_length: int = 12) -> None:
        super().__init__(maxLength=max_length)
        self._theme, self._width_px = theme, width_px
        self.textChanged.connect(lambda _: self._apply_theme())
        theme.changed.connect(self._apply_theme)

    @property
    def is_empty(self) -> bool:
        return not self.text().strip().removesuffix("°").strip()

    def value(self) -> float:
        """Return the number, NaN for nothing or anything else."""
        return parse_number(self.text())

    def set_value(self, value: float) -> None:
        """Show a number; NaN empties the field."""
        self.setText(
            numbers.format_significant(value, SHOWN_DIGITS).replace("-", "\N{MINUS SIGN}")
            if math.isfinite(value)
            else ""
        )

    @property
    def error(self) -> str:
        """Why the value is invalid; empty if it is valid."""
        return ""

    @property
    def warning(self) -> str:
        """Why the value is unusual; empty if it is not."""
        return ""

    def _apply_theme(self) -> None:
        self.setFixedWidth(self._theme.px(self._width_px))
        token = "bad" if self.error else "warn" if self.warning else ""
        edge = getattr(self._theme.tokens, token) if token else ""
        self.setStyleSheet(f"QLineEdit {{ border: 2px solid {edge}; }}" if edge else "")
        self.setToolTip(self.error or self.warning)
        self.setAccessibleDescription(self.error or self.warning)


class DegreesField(NumberField):
    """Angle above 0, or from a minimum, up to a maximum; ``direction`` is its hidden sign."""

    def __init__(self, theme: Theme, maximum: int, empty_text: str, direction: float = 1.0) -> None:
        super().__init__(theme)
        self._minimum, self._maximum, self.direction = 0, maximum, direction
        self.setPlaceholderText(empty_text)
        self.editingFinished.connect(lambda: self.set_value(self.value()) if math.isfinite(self.value()) else None)
        self._apply_theme()

    def value(self) -> float:
        value = super().value()
        is_possible = (value >= self._minimum if self._minimum else value > 0.0) and value <= self._maximum
        return self.direction * value if is_possible else math.nan

    def set_minimum(self, minimum: int) -> None:
        """Set the minimum; 0 requires a larger value."""
        self._minimum = minimum
        self._apply_theme()

    def set_value(self, value: float) -> None:
        super().set_value(self.direction * value)
        if not self.is_empty:
            self.setText(f"{self.text()}°")

    @property
    def error(self) -> str:
        if self.is_empty or math.isfinite(self.value()):
            return ""
        return self.tr("Up to {most}°, or empty").format(most=self._maximum)


class PageIndex(QListWidget):
    """Names of pages, one below the other, beside the page that is chosen; as wide as the longest name."""

    def __init__(self, names: Sequence[str]) -> None:
        super().__init__()
        self.addItems(names)
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Expanding)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)

    def sizeHint(self) -> QSize:
        return QSize(self.sizeHintForColumn(0) + 16, super().sizeHint().height())


class ChoiceRow(QWidget):
    """Exclusive choices side by side; Tab reaches the chosen one, arrow keys choose another."""

    chosen = Signal(object)

    def __init__(
        self, theme: Theme, options: Sequence[tuple[object, str]], current: object = None, *, wraps: bool = False
    ) -> None:
        """With ``wraps`` the choices take several lines if there is little room."""
        super().__init__()
        row = FlowLayout(8) if wraps else QHBoxLayout()
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(8)
        self.setLayout(row)
        self._group = QButtonGroup(self)
        self._values: list[object] = []
        for number, (value, text) in enumerate(options):
            button = ChoiceButton(theme, text)
            self._group.addButton(button, number)
            self._values.append(value)
            row.addWidget(button)
        if isinstance(row, QHBoxLayout):
            row.addStretch(1)
        self._group.idClicked.connect(lambda number: self.chosen.emit(self._values[number]))
        self._group.idToggled.connect(self._update_tab_stop)
        self.choose(current if current in self._values else self._values[0])

    def choose(self, value: object) -> None:
        """Choose a value; any other leaves none chosen."""
        if value in self._values:
            self._group.button(self._values.index(value)).setChecked(True)
            return
        self._group.setExclusive(False)
        for button in self.buttons():
            button.setChecked(False)
        self._group.setExclusive(True)

    def _update_tab_stop(self) -> None:
        """Let Tab reach the chosen button; Qt does so only after a button had the keyboard."""
        at = max(self._group.checkedId(), 0)
        for number, button in enumerate(self.buttons()):
            button.setFocusPolicy(Qt.FocusPolicy.StrongFocus if number == at else Qt.FocusPolicy.ClickFocus)

    def value(self) -> object:
        """Return the chosen value, None if there is none."""
        chosen = self._group.checkedId()
        return self._values[chosen] if chosen >= 0 else None

    def buttons(self) -> list[ChoiceButton]:
        return [self._group.button(number) for number in range(len(self._values))]  # type: ignore[misc]


class ChoiceButton(Button):
    """One of several choices, marked by outline, fill and a check; leaves Enter to the dialog."""

    def __init__(self, theme: Theme, text: str, *, height_px: int = 40) -> None:
        super().__init__(theme, text, "plain", height_px=height_px)
        self.on_enter = "pass"
        self.setCheckable(True)
        self.toggled.connect(lambda on: self.set_label(self.text(), icon="check" if on else ""))

    def _colors(self):  # type: ignore[no-untyped-def]
        if self.isChecked():
            color = self._theme.color
            return color("soft"), color("text"), color("accent"), color("text2")
        return super()._colors()
