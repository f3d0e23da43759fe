"""Scroll areas, and what lies in them and holds wrapped texts."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import QScrollArea, QVBoxLayout, QWidget

RING_PX = 5


class ScrolledColumn(QWidget):
    """As high as its texts need at the width they have; Qt's own guess is for narrower texts and scrolls too soon."""

    def minimumSizeHint(self) -> QSize:
        whole, layout = super().minimumSizeHint(), self.layout()
        # Where nothing wraps just now Qt asks for no height at a width, and would press everything together instead.
        wraps = layout is None or layout.hasHeightForWidth()
        return QSize(whole.width(), 0) if wraps else whole


def scroll_area(host: QWidget, focus: Qt.FocusPolicy = Qt.FocusPolicy.NoFocus) -> QScrollArea:
    """Scrolls what it holds up and down, never aside; Tab passes it by unless ``focus`` says otherwise."""
    area = QScrollArea()
    area.setWidget(host)
    area.setWidgetResizable(True)
    area.setFocusPolicy(focus)
    area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
    return area


def scrolled(layout: QVBoxLayout) -> QScrollArea:
    """A column that scrolls where large text leaves no room; at its edges there is room for the focus ring."""
    layout.setContentsMargins(RING_PX, RING_PX, RING_PX, RING_PX)
    host = ScrolledColumn()
    host.setLayout(layout)
    return scroll_area(host)
