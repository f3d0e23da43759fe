"""What lies in a scroll area and holds wrapped texts."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import QScrollArea, QVBoxLayout, QWidget

RING_PX = 5


class ScrolledColumn(QWidget):
    """As high as its texts need at the width they have; Qt's own guess is for narrower texts and scrolls too soon."""

    def minimumSizeHint(self) -> QSize:
        return QSize(super().minimumSizeHint().width(), 0)


def scrolled(layout: QVBoxLayout) -> QScrollArea:
    """A column that scrolls where large text leaves no room; at its edges there is room for the focus ring."""
    layout.setContentsMargins(RING_PX, RING_PX, RING_PX, RING_PX)
    host = ScrolledColumn()
    host.setLayout(layout)
    area = QScrollArea()
    area.setWidget(host)
    area.setWidgetResizable(True)
    area.setFocusPolicy(Qt.FocusPolicy.NoFocus)
    area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
    return area
