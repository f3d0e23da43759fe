"""What lies in a scroll area and holds wrapped texts."""

from __future__ import annotations

from PySide6.QtCore import QSize
from PySide6.QtWidgets import QWidget


class ScrolledColumn(QWidget):
    """As high as its texts need at the width they have; Qt's own guess is for narrower texts and scrolls too soon."""

    def minimumSizeHint(self) -> QSize:
        return QSize(super().minimumSizeHint().width(), 0)
