"""The chart of one measure taken by hand, as a widget."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import datetime

from PySide6.QtCore import QRectF, QSize
from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from carpus.core.by_hand.measures import HandMeasure
from carpus.core.by_hand.values import HandValue
from carpus.ui.by_hand.names import measure_name
from carpus.ui.plot.by_hand import paint_course
from carpus.ui.plot.style import screen_style
from carpus.ui.theme import Theme


class HandChart(QWidget):
    """One measure over the days."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self.measure: HandMeasure | None = None
        self._values: Sequence[HandValue] = ()
        self._ours: Sequence[tuple[datetime, float]] = ()
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        theme.changed.connect(self.updateGeometry)

    def show_course(
        self, measure: HandMeasure, values: Sequence[HandValue], ours: Sequence[tuple[datetime, float]]
    ) -> None:
        """Draw the values that count of one hand, and Carpus's own by day."""
        self.measure, self._values, self._ours = measure, values, ours
        self.setAccessibleName(self.tr("{name} over the days").format(name=measure_name(measure)))
        self.update()

    def sizeHint(self) -> QSize:
        return QSize(400, self._theme.px(250))

    def minimumSizeHint(self) -> QSize:
        return QSize(260, self.sizeHint().height())

    def paintEvent(self, event: QPaintEvent) -> None:
        if self.measure is None:
            return
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        paint_course(painter, screen_style(self._theme), QRectF(self.rect()), self.measure, self._values, self._ours)
