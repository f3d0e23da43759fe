"""A large exclusive choice: a name, a sentence, and the mark of being chosen."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QRectF, QSize, Qt, Signal
from PySide6.QtGui import QFont, QFontMetricsF, QKeyEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QAbstractButton, QButtonGroup, QSizePolicy, QVBoxLayout, QWidget

from carpus.ui.fonts import REGULAR, SEMIBOLD, font
from carpus.ui.icons import State, paint_state
from carpus.ui.theme import CARD_RADIUS_PX, Theme

LEFT_PX, RIGHT_PX = 60, 24


class Option(QAbstractButton):
    """One of several; ``state`` puts a state icon with its word at the right."""

    def __init__(self, theme: Theme, name: str, sentence: str) -> None:
        super().__init__()
        self._theme, self._sentence = theme, sentence
        self._state: State = "none"
        self._state_words = ""
        self.setText(name)
        self.setCheckable(True)
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        self.setAccessibleName(name)
        self.setAccessibleDescription(sentence)
        policy = QSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Minimum)
        policy.setHeightForWidth(True)
        self.setSizePolicy(policy)
        theme.changed.connect(self.updateGeometry)

    def show_sentence(self, sentence: str, state: State = "none", words: str = "") -> None:
        """Change what is said of it."""
        self._sentence, self._state, self._state_words = sentence, state, words
        self.setAccessibleDescription(" ".join(part for part in (sentence, words) if part))
        self.updateGeometry()
        self.update()

    @property
    def state_words(self) -> str:
        """The word beside the state icon."""
        return self._state_words

    def _name_font(self) -> QFont:
        return font(16 * self._theme.text_scale, SEMIBOLD)

    def _sentence_font(self) -> QFont:
        return font(14 * self._theme.text_scale, REGULAR)

    def heightForWidth(self, width: int) -> int:
        room = QRectF(0, 0, max(width - LEFT_PX - RIGHT_PX, 100), 10_000)
        words = QFontMetricsF(self._sentence_font()).boundingRect(room, int(Qt.TextFlag.TextWordWrap), self._sentence)
        return round(QFontMetricsF(self._name_font()).height() + words.height()) + 36

    def sizeHint(self) -> QSize:
        return QSize(600, self.heightForWidth(600))

    def minimumSizeHint(self) -> QSize:
        return QSize(200, self.heightForWidth(self.width() or 600))

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        color, chosen = self._theme.color, self.isChecked()
        edge = 2.0 if chosen else 1.0
        painter.setPen(QPen(color("accent" if chosen else "line"), edge))
        painter.setBrush(color("soft" if chosen else "canvas" if self.underMouse() else "surface"))
        box = QRectF(self.rect()).adjusted(edge / 2, edge / 2, -edge / 2, -edge / 2)
        painter.drawRoundedRect(box, CARD_RADIUS_PX, CARD_RADIUS_PX)
        name = QFontMetricsF(self._name_font())
        size = float(self._theme.px(22))
        mark = QRectF(20, 18 + (name.height() - size) / 2, size, size)
        if chosen:
            paint_state(painter, "good", mark, color("accent"), color("on_accent"))
        else:
            painter.setPen(QPen(color("border"), 1.5))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawEllipse(mark.adjusted(1, 1, -1, -1))
        painter.setPen(color("text"))
        painter.setFont(self._name_font())
        line = QRectF(LEFT_PX, 18, self.width() - LEFT_PX - RIGHT_PX, name.height())
        painter.drawText(line, int(Qt.AlignmentFlag.AlignVCenter), self.text())
        if self._state_words:
            self._paint_state(painter, line)
        painter.setFont(self._sentence_font())
        painter.setPen(color("text2"))
        below = QRectF(LEFT_PX, line.bottom() + 2, line.width(), self.height() - line.bottom() - 10)
        painter.drawText(below, int(Qt.TextFlag.TextWordWrap), self._sentence)

    def _paint_state(self, painter: QPainter, line: QRectF) -> None:
        painter.setFont(self._sentence_font())
        width = QFontMetricsF(self._sentence_font()).horizontalAdvance(self._state_words)
        size = float(self._theme.px(18))
        right = line.right()
        icon = QRectF(right - width - 8 - size, line.center().y() - size / 2, size, size)
        token = {"good": "good", "warn": "warn", "bad": "bad"}.get(self._state, "text2")
        paint_state(painter, self._state, icon, self._theme.color(token), self._theme.color("surface"))
        painter.setPen(self._theme.color("text"))
        painter.drawText(
            QRectF(right - width, line.top(), width + 2, line.height()),
            int(Qt.AlignmentFlag.AlignVCenter),
            self._state_words,
        )


class Options(QWidget):
    """Exclusive options under each other; arrow keys move the choice, Enter accepts it."""

    chosen = Signal(object)
    accepted = Signal()

    def __init__(self, theme: Theme, options: Sequence[tuple[object, str, str]]) -> None:
        super().__init__()
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(12)
        self._group = QButtonGroup(self)
        self._values: list[object] = []
        for number, (value, name, sentence) in enumerate(options):
            option = _Option(theme, name, sentence)
            option.accepted.connect(self.accepted)
            self._group.addButton(option, number)
            self._values.append(value)
            column.addWidget(option)
        column.addStretch(1)
        self._group.idToggled.connect(lambda number, on: self.chosen.emit(self._values[number]) if on else None)
        self.choose(self._values[0])

    def choose(self, value: object) -> None:
        """Select one."""
        self._group.button(self._values.index(value)).setChecked(True)

    def value(self) -> object:
        """What is chosen."""
        return self._values[self._group.checkedId()]

    def option(self, value: object) -> Option:
        """The button of a value."""
        return self._group.button(self._values.index(value))  # type: ignore[return-value]

    def current(self) -> Option:
        """The chosen button, which takes the keyboard."""
        return self._group.checkedButton()  # type: ignore[return-value]


class _Option(Option):
    accepted = Signal()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Enter goes on with what is chosen; Qt's group moves the choice with the arrows."""
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self.accepted.emit()
        else:
            super().keyPressEvent(event)
