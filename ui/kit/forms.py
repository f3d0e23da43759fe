"""Forms declared as tables: each field has an attribute name, a label, a widget and a validator."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import takewhile
from typing import Any

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtWidgets import QCheckBox, QHBoxLayout, QLineEdit, QPlainTextEdit, QSpinBox, QWidget

from carpus.ui.kit.field import ChoiceRow, Combo, LabelledField
from carpus.ui.kit.layouts import row_layout
from carpus.ui.kit.theme import Theme

Validator = Callable[[Any], str]
"""Returns the error message for a value, empty if it is valid."""


@dataclass(frozen=True, slots=True, eq=False)
class Field:
    """A row of the form, or a part of one.

    ``name`` is the attribute, ``trailing`` are widgets behind the widget. A field that ``continues_row`` stands in
    the row of the one before. ``stretch`` is its share of the row.
    """

    name: str
    label: str
    widget: QWidget
    validator: Validator = lambda _: ""
    trailing: Sequence[QWidget] = ()
    continues_row: bool = False
    stretch: int = 0
    change_signal: str = ""
    """Signal of a change, if it is not the usual one of the widget."""


def require_choice(message: str) -> Validator:
    """Return a validator that reports ``message`` while nothing is chosen."""
    return lambda value: message if value is None else ""


def limit_length(max_length: int, message: str) -> Validator:
    """Return a validator for texts longer than ``max_length``; ``message`` names the excess as ``{count}``.

    Typed text is never cut.
    """
    return lambda text: message.format(count=len(text) - max_length) if len(text) > max_length else ""


_WIDGET_ACCESS: Sequence[tuple[type[QWidget], Callable[[Any], Any], Callable[[Any, Any], object], str]] = (
    (ChoiceRow, ChoiceRow.value, ChoiceRow.choose, "chosen"),
    (Combo, Combo.currentData, Combo.choose, "currentIndexChanged"),
    (QCheckBox, QCheckBox.isChecked, QCheckBox.setChecked, "toggled"),
    (QSpinBox, QSpinBox.value, QSpinBox.setValue, "valueChanged"),
    (QLineEdit, lambda line: " ".join(line.text().split()), QLineEdit.setText, "textChanged"),
    (QPlainTextEdit, lambda text: text.toPlainText().strip(), QPlainTextEdit.setPlainText, "textChanged"),
)
"""How each kind of widget is read and written, and its signal of a change. A widget of our own may have ``value`` and
``set_value``."""


class Form(QObject):
    """Widgets of a table of fields, by field name.

    Signals: ``changed`` when a value changes.
    """

    changed = Signal()

    def __init__(self, theme: Theme, fields: Sequence[Field]) -> None:
        super().__init__()
        self._fields = {field.name: field for field in fields}
        self._accessors: dict[str, tuple[Callable[[], Any], Callable[[Any], object]]] = {}
        self.labelled_widgets: dict[str, Any] = {}
        """Each field's widget under its label; the bare widget if it has none."""
        for number, field in enumerate(fields):
            widget = field.widget
            read, show, tells = next(kind[1:] for kind in _WIDGET_ACCESS if isinstance(widget, kind[0]))
            read, show = getattr(type(widget), "value", read), getattr(type(widget), "set_value", show)
            self._accessors[field.name] = partial(read, widget), partial(show, widget)
            getattr(widget, field.change_signal or tells).connect(lambda *_: self.changed.emit())
            if field.label:
                behind = takewhile(lambda one: one.continues_row and not one.label, fields[number + 1 :])
                beside = [part for one in behind for part in (one.widget, *one.trailing)]
                self.labelled_widgets[field.name] = LabelledField(
                    theme, field.label, field.widget, *field.trailing, *beside
                )
            elif not field.continues_row:
                self.labelled_widgets[field.name] = field.widget

    def layout_rows(self) -> list[QHBoxLayout]:
        """Return the rows of the form, from top to bottom."""
        lines: list[QHBoxLayout] = []
        for name, part in self.labelled_widgets.items():
            if not self._fields[name].continues_row:
                lines.append(row_layout(gap=24))
            lines[-1].addWidget(part, self._fields[name].stretch, Qt.AlignmentFlag.AlignTop)  # above a fault's text
        for line in lines:
            if line.count() > 1 and not any(line.stretch(place) for place in range(line.count())):
                line.addStretch(1)
        return lines

    def __getitem__(self, name: str) -> Any:
        """Return the widget of a field."""
        return self._fields[name].widget

    def fill(self, value: object) -> None:
        """Show the attributes of ``value`` in the widgets."""
        for name, (_, show) in self._accessors.items():
            show(getattr(value, name))

    def values(self) -> dict[str, Any]:
        """Return the values of all widgets, by field name."""
        return {name: read() for name, (read, _) in self._accessors.items()}

    def show_error(self, name: str = "", message: str = "") -> None:
        """Show a message below the field ``name``, and none below any other."""
        for other, labelled in self.labelled_widgets.items():
            if isinstance(labelled, LabelledField):
                labelled.error.show_text(message if other == name else "")

    def find_error(self) -> tuple[QWidget | None, str]:
        """Return the widget of the first invalid field and its message; (None, "") if all are valid."""
        for name, value in self.values().items():
            if words := self._fields[name].validator(value):
                return self[name], words
        return None, ""
