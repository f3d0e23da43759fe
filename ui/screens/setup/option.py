"""A large exclusive choice: name, description, mark."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QButtonGroup, QPushButton, QSizePolicy, QWidget

from carpus.ui.kit.icons import State
from carpus.ui.kit.layouts import column_layout, grid_layout
from carpus.ui.kit.text import REGULAR, SEMIBOLD, Icon, StateText, Text
from carpus.ui.kit.theme import Theme


class Option(QPushButton):
    """One option; ``accepted`` when Enter continues with the choice."""

    accepted = Signal()

    def __init__(self, theme: Theme, name: str, sentence: str) -> None:
        super().__init__()
        self._mark, self._state = Icon(theme, "open", 22, (22, 22)), StateText(theme, 14, REGULAR)
        self._sentence = Text(theme, sentence, 14, REGULAR, "text2", wrap=True)
        grid = grid_layout(18, 2, stretches=(0, 1), margins=(18, 14, 22, 14), parent=self)
        grid.addWidget(self._mark, 0, 0)
        grid.setRowStretch(1, 1)
        grid.addWidget(Text(theme, name, 16, SEMIBOLD), 0, 1)
        grid.addWidget(self._state, 0, 2)
        grid.addWidget(self._sentence, 1, 1, 1, 2)
        for part in self.findChildren(QWidget):
            part.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self._sentence.setObjectName("sentence")
        self.on_enter = "pass"
        self.setCheckable(True)
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        self.setAccessibleName(name)
        self.setAccessibleDescription(sentence)
        policy = QSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Minimum)
        policy.setHeightForWidth(True)
        self.setSizePolicy(policy)
        self.toggled.connect(lambda on: self._mark.show_icon("chosen" if on else "open", size_px=22))

    def show_sentence(self, sentence: str, state: State = "none", words: str = "") -> None:
        self._sentence.setText(sentence)
        self._state.show_state(state, words, token="text")
        self.setAccessibleDescription(" ".join(part for part in (sentence, words) if part))
        self.updateGeometry()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Let Enter accept; Qt's group moves the choice with the arrows."""
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self.accepted.emit()
        else:
            super().keyPressEvent(event)

    def heightForWidth(self, width: int) -> int:
        layout = self.layout()
        return layout.totalHeightForWidth(width) if layout is not None else -1

    def sizeHint(self) -> QSize:
        return QSize(600, self.heightForWidth(600))

    def minimumSizeHint(self) -> QSize:
        return QSize(200, self.heightForWidth(self.width() or 600))


class Options(QWidget):
    """Exclusive options in a column."""

    chosen = Signal(object)
    accepted = Signal()

    def __init__(self, theme: Theme, options: Sequence[tuple[object, str, str]]) -> None:
        super().__init__()
        column = column_layout(gap=12, margins=(0, 0, 0, 0), parent=self)
        self._group = QButtonGroup(self)
        self._values: list[object] = []
        for number, (value, name, sentence) in enumerate(options):
            option = Option(theme, name, sentence)
            option.accepted.connect(self.accepted)
            self._group.addButton(option, number)
            self._values.append(value)
            column.addWidget(option)
        column.addStretch(1)
        self._group.idToggled.connect(lambda number, on: self.chosen.emit(self._values[number]) if on else None)
        self.choose(self._values[0])

    def choose(self, value: object) -> None:
        self._group.button(self._values.index(value)).setChecked(True)

    def value(self) -> object:
        return self._values[self._group.checkedId()]

    def option(self, value: object) -> Option:
        return self._group.button(self._values.index(value))  # type: ignore[return-value]

    def current(self) -> Option:
        return self._group.checkedButton()  # type: ignore[return-value]
