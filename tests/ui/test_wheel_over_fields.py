"""A turn of the wheel over a field scrolls its page and changes no value."""

from __future__ import annotations

from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.qtbot import QtBot

from carpus.ui.kit.field import Combo


def turned(field: QWidget) -> bool:
    """Whether a field takes a turn of the wheel over it."""
    turn = QWheelEvent(
        QPointF(5, 5), field.mapToGlobal(QPointF(5, 5)), QPoint(), QPoint(0, -120), Qt.MouseButton.NoButton,
        Qt.KeyboardModifier.NoModifier, Qt.ScrollPhase.NoScrollPhase, False,
    )  # fmt: skip
    QApplication.sendEvent(field, turn)
    return turn.isAccepted()


def test_wheel_chooses_nothing_in_list_of_choices(qtbot: QtBot) -> None:
    choice = Combo()
    choice.set_choices([(1, "one"), (2, "two")])
    qtbot.addWidget(choice)
    choice.show()
    choice.setFocus()
    assert not turned(choice)
    assert choice.currentIndex() == 0
