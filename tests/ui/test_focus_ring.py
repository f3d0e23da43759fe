"""The mark of the keyboard lies around its control, also when what holds the control moves."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QPoint, QRect
from PySide6.QtWidgets import QPushButton, QScrollArea, QVBoxLayout, QWidget
from pytestqt.qtbot import QtBot

from carpus.ui.shell import FocusRing
from carpus.ui.theme import Theme


@pytest.fixture
def parts(qtbot: QtBot, theme: Theme) -> tuple[QWidget, QScrollArea, list[QPushButton], FocusRing]:
    window = QWidget()
    qtbot.addWidget(window)
    window.resize(300, 200)
    inside = QWidget()
    column = QVBoxLayout(inside)
    buttons = [QPushButton(str(number)) for number in range(20)]
    for button in buttons:
        column.addWidget(button)
    area = QScrollArea()
    area.setWidgetResizable(True)
    area.setWidget(inside)
    QVBoxLayout(window).addWidget(area)
    ring = FocusRing(window)
    with qtbot.waitExposed(window):
        window.show()
    ring._follow(None, buttons[2])  # without a window manager nothing has the keyboard
    return window, area, buttons, ring


def around(window: QWidget, button: QPushButton) -> QRect:
    return QRect(button.mapTo(window, QPoint(0, 0)), button.size())


def test_it_follows_what_is_scrolled(parts: tuple[QWidget, QScrollArea, list[QPushButton], FocusRing]) -> None:
    window, area, buttons, ring = parts
    before = ring.geometry()
    assert before.contains(around(window, buttons[2]))
    area.verticalScrollBar().setValue(15)
    assert ring.geometry() == before.translated(0, -15)
    assert ring.geometry().contains(around(window, buttons[2]))


def test_it_goes_with_what_is_scrolled_away_and_comes_back(
    parts: tuple[QWidget, QScrollArea, list[QPushButton], FocusRing],
) -> None:
    _, area, _, ring = parts
    area.verticalScrollBar().setValue(area.verticalScrollBar().maximum())
    assert not ring.isVisible()
    area.verticalScrollBar().setValue(0)
    assert ring.isVisible()
    assert ring.mask().isEmpty()
