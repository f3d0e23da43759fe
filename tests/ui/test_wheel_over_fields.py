"""A turn of the wheel over a field scrolls its page and changes no value."""

from __future__ import annotations

from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.qtbot import QtBot

from carpus.ui.kit.field import Combo, number_field
from carpus.ui.kit.theme import Theme
from carpus.ui.screens.by_hand.screen import ManualMeasurementsScreen
from tests.ui.gallery import TODAY


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


def test_wheel_changes_no_number_and_no_day(qtbot: QtBot, theme: Theme) -> None:
    number, record = number_field(theme, 20), ManualMeasurementsScreen(theme, lambda: TODAY)
    number.setValue(7)
    for field in (number, record.day_field):
        qtbot.addWidget(field)
        field.show()
        field.setFocus()
        assert not turned(field)
    assert number.value() == 7
    assert record.day_field.date().toPython() == TODAY
