"""No word is cut: every label and button of every screen has the room it asks for, at 100 and at 150 %."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from PySide6.QtCore import QLocale, QPoint
from PySide6.QtGui import QFontMetricsF
from PySide6.QtWidgets import QApplication, QLabel, QPushButton, QScrollArea, QWidget

from tests.ui.gallery import Gallery

SCALES = (1.0, 1.5)
STATES = (
    "patients", "patients_empty", "patients_not_found", "patients_recovered", "patient_form", "exercise",
    "exercise_hand", "camera",
    "markers_clicking", "markers_ready", "markers_swapped", "markers_doubtful", "markers_start_angle",
    "markers_proposed", "markers_proposed_doubtful", "markers_proposed_incomplete", "live",
    "live_speeds", "live_marker_hidden", "live_hand_lost", "live_hand", "live_hand_thumb_hidden", "live_hand_fist",
    "live_hand_not_found", "live_arm_moved", "live_disk_full", "live_note", "live_pain", "live_camera_lost", "review",
    "review_hand", "review_hand_finger", "progress", "progress_hand", "report", "report_hand", "report_progress",
    "settings", "help",
)  # fmt: skip


@pytest.fixture(scope="module", params=SCALES)
def gallery(request: pytest.FixtureRequest, qapp: QApplication) -> Iterator[Gallery]:
    QLocale.setDefault(QLocale(QLocale.Language.English, QLocale.Country.UnitedKingdom))
    shown = Gallery(qapp, "light", (1280, 800), request.param)
    yield shown
    shown.close()


def in_scroll_area(widget: QWidget) -> bool:
    parent = widget.parentWidget()
    while parent is not None:
        if isinstance(parent, QScrollArea):
            return True
        parent = parent.parentWidget()
    return False


def cut_words(window: QWidget) -> list[str]:
    """Texts of visible labels and buttons that do not fit, or reach out of the window."""
    out = []
    for widget in window.findChildren(QWidget):
        if not widget.isVisible() or not isinstance(widget, QLabel | QPushButton):
            continue
        text = widget.text().replace("&", "")
        if not text:
            continue
        if isinstance(widget, QLabel) and widget.wordWrap():
            fits = widget.height() + 1 >= widget.heightForWidth(widget.width())
        elif isinstance(widget, QLabel):
            fits = widget.width() + 2 >= QFontMetricsF(widget.font()).horizontalAdvance(text)
        else:
            fits = widget.width() + 2 >= widget.sizeHint().width()
        corner = widget.mapTo(window, QPoint(0, 0))
        inside = corner.x() >= 0 and corner.x() + widget.width() <= window.width() + 1
        if not in_scroll_area(widget):
            inside = inside and corner.y() + widget.height() <= window.height() + 1
        if not (fits and inside):
            out.append(f"{text!r} {widget.width()}x{widget.height()} at {corner.x()},{corner.y()}")
    return out


@pytest.mark.parametrize("state", STATES)
def test_no_word_is_cut(gallery: Gallery, state: str) -> None:
    assert state in gallery.states()
    gallery.states()[state]()
    assert gallery.shell.size().width() == 1280
    assert cut_words(gallery.shell) == []


def test_every_state_is_looked_at(gallery: Gallery) -> None:
    assert set(gallery.states()) == set(STATES)
