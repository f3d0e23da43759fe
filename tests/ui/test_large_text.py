"""What is read with German words at 150 %: tables, curves and names are there in whole, and the page scrolls."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtWidgets import QApplication, QScrollArea, QStyleOptionComboBox, QWidget
from pytestqt.qtbot import QtBot

from carpus.ui.kit.field import Combo, number_field
from carpus.ui.kit.layouts import ScrollArea
from carpus.ui.kit.theme import Theme
from carpus.ui.screens.by_hand.screen import ManualMeasurementsScreen
from carpus.ui.screens.markers.screen import MarkersScreen
from carpus.ui.screens.patients.screen import PatientsScreen
from carpus.ui.screens.progress.screen import ProgressScreen
from carpus.ui.screens.records.lock import LockScreen
from carpus.ui.screens.review.screen import ReviewScreen
from tests.ui import pseudo
from tests.ui.gallery import TODAY, Gallery

LEAST_PLOT_PX = 240


@pytest.fixture(scope="module")
def gallery(qapp: QApplication) -> Iterator[Gallery]:
    with pseudo.spoken("de"):
        shown = Gallery(qapp, "dark", (1280, 800), 1.5)
        yield shown
        shown.close()


def is_whole(area: QScrollArea) -> bool:
    held = area.widget()
    return held is not None and area.viewport().height() >= held.height()


def test_curves_of_every_finger_are_wide_and_no_choice_is_cut(gallery: Gallery) -> None:
    gallery.progress_hand()
    gallery.settle()
    screen = gallery.shown(ProgressScreen)
    assert min(panel.box.width() for panel, _ in screen.chart.panels()) >= LEAST_PLOT_PX
    for box in (screen.exercise_choice, screen.measure_choice):
        assert box.width() >= box.sizeHint().width()
    assert is_whole(screen._side)


def test_tables_are_read_whole_and_no_finger_loses_the_end_of_its_name(gallery: Gallery) -> None:
    def has_whole(tables: QScrollArea, screen: QWidget) -> None:
        assert is_whole(tables)
        (page,) = (area for area in screen.findChildren(ScrollArea) if area.parent() is screen)
        assert page.verticalScrollBar().maximum() > 0

    gallery.review_hand()
    review = gallery.shown(ReviewScreen)
    has_whole(review.card.tables, review)
    shown = [button for button in review.charts.finger.buttons() if button.isVisible()]
    assert len(shown) == 6
    assert [button.visible_text for button in shown] == [button.text() for button in shown]


def test_tables_are_as_high_on_a_window_of_another_size_before_as_on_one_that_was_so(gallery: Gallery) -> None:
    def heights_px(*sizes: tuple[int, int]) -> list[int]:
        gallery.review_hand()
        screen = gallery.shown(ReviewScreen)
        heights = []
        for size in sizes:
            gallery.shell.resize(*size)
            gallery.settle()
            heights.append(screen.card.tables.height())
        gallery.shell.resize(1280, 800)
        return heights

    _, small_px, _, large_px = heights_px((1280, 720), (1024, 700), (1280, 800), (1600, 1040))
    assert heights_px((1024, 700)) == [small_px]
    assert heights_px((1600, 1040)) == [large_px]


def test_large_text_keeps_room_for_patient_reminder(gallery: Gallery) -> None:
    gallery.patients_recovered()
    gallery.settle()
    screen = gallery.shown(PatientsScreen)
    assert screen.card._summary.height() >= screen.card._diagnosis_card.geometry().bottom()
    assert screen.card.height() >= screen.card.minimumSizeHint().height()


@pytest.mark.parametrize(("state", "is_guided"), [("markers_ready", True), ("markers_swapped", False)])
def test_checks_are_read_whole_and_the_guide_gives_way(gallery: Gallery, state: str, is_guided: bool) -> None:
    getattr(gallery, state)()
    screen = gallery.shown(MarkersScreen)
    screen.bubble.show_bubble("check")
    gallery.settle()
    assert screen.bubble.isVisible() is is_guided
    for _, *texts in screen.guidance.verdict_panel._lines:
        assert all(text.height() >= text.minimumSizeHint().height() for text in texts)


def test_lock_stands_below_its_bar(gallery: Gallery) -> None:
    gallery.locked()
    sheet = gallery.over[-1]
    assert isinstance(sheet, LockScreen)
    above, below = sheet.card.y() - sheet._bar.height(), sheet.height() - sheet.card.geometry().bottom()
    assert above >= below // 2


def test_choice_without_room_ends_in_dots(theme: Theme, qapp: QApplication) -> None:
    host = QWidget()
    box = Combo()
    box.setParent(host)
    box.addItem("Faustschluss · Rechte Hand")
    for width, whole in ((box.sizeHint().width() + 10, True), (120, False)):
        box.resize(width, 40)
        option = QStyleOptionComboBox()
        box.initStyleOption(option)
        assert (option.currentText == box.currentText()) is whole
        assert option.currentText.endswith("…") is not whole


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
