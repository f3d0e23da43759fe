"""The chart of one measure taken by hand, as a widget."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import datetime

from PySide6.QtCore import QSize
from PySide6.QtWidgets import QSizePolicy

from carpus.core.measures.by_hand import HandMeasure, HandValue
from carpus.ui.by_hand.names import measure_name
from carpus.ui.plot.by_hand import paint_course
from carpus.ui.plot.still import StillPlot
from carpus.ui.theme import Theme


class HandChart(StillPlot):
    """One measure over the days."""

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme)
        self.measure: HandMeasure | None = None
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        theme.changed.connect(self.updateGeometry)

    def show_course(
        self, measure: HandMeasure, values: Sequence[HandValue], ours: Sequence[tuple[datetime, float]]
    ) -> None:
        """Draw the values that count of one hand, and Carpus's own by day."""
        self.measure = measure
        self.setAccessibleName(self.tr("{name} over the days").format(name=measure_name(measure)))
        self.show_painted(lambda painter, style, box: paint_course(painter, style, box, measure, values, ours))

    def sizeHint(self) -> QSize:
        return QSize(400, self._theme.px(250))

    def minimumSizeHint(self) -> QSize:
        return QSize(260, self.sizeHint().height())
