"""The card with the mean repetitions of both sessions."""

from __future__ import annotations

from dataclasses import replace

from PySide6.QtCore import QRectF, QSize, Qt, Signal
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QComboBox, QSizePolicy

from carpus.core.results.motion_curves import Quantity
from carpus.ui.beside.shown import Shown
from carpus.ui.beside.words import quantity_name
from carpus.ui.controls.card import Card
from carpus.ui.controls.layouts import STRETCH, in_line
from carpus.ui.controls.text import SEMIBOLD, Text
from carpus.ui.plot.beside import BesidePlot
from carpus.ui.plot.card import StillPlot
from carpus.ui.plot.style import screen_style
from carpus.ui.theme import Theme


class MeanCard(Card):
    """``chosen``: another angle; ``sought`` carries a share of the repetition that was pointed at."""

    chosen = Signal()
    sought = Signal(float)

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme, 0)
        self._shown: Shown | None = None
        self.title = Text(theme, self.tr("Mean repetition, ± sd"), 14, SEMIBOLD)
        self._quantities = QComboBox()
        self._quantities.setAccessibleName(self.tr("Angle"))
        self._quantities.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToContents)
        self._quantities.setFocusPolicy(Qt.FocusPolicy.TabFocus)  # a click leaves Space and the arrows to the player
        self._quantities.setSizePolicy(QSizePolicy.Policy.Maximum, QSizePolicy.Policy.Fixed)
        self.curves = MeanCurves(theme)
        head = in_line(self.title, STRETCH, self._quantities, gap=12)
        self.body.setContentsMargins(20, 8, 16, 10)
        self.body.setSpacing(4)
        self.body.addLayout(head)
        self.body.addWidget(self.curves, 1)
        self.curves.sought.connect(self.sought)
        self._quantities.currentIndexChanged.connect(lambda _: self._choose())

    @property
    def quantity(self) -> Quantity:
        assert self._shown is not None
        return self._shown.quantities[max(self._quantities.currentIndex(), 0)]

    def show_means(self, now: Shown | None) -> None:
        """What can be chosen of two sessions, and the curves of their main angle; nothing while they are read."""
        self._shown = now
        self._quantities.setEnabled(now is not None)
        self._quantities.blockSignals(True)
        self._quantities.clear()
        if now is not None:
            for quantity in now.quantities:
                self._quantities.addItem(quantity_name(quantity), quantity)
            self._quantities.setCurrentIndex(now.quantities.index(now.main_quantity))
        self._quantities.blockSignals(False)
        self.curves.show_plot(None if now is None else now.plot(self.quantity))

    def _choose(self) -> None:
        if self._shown is not None:
            self.curves.show_plot(self._shown.plot(self.quantity))
            self.chosen.emit()


class MeanCurves(StillPlot):
    """Paints one plot, or nothing."""

    sought = Signal(float)

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme)
        self.plot: BesidePlot | None = None
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setAccessibleName(self.tr("Mean repetition of both sessions"))
        theme.changed.connect(self.update)

    def show_plot(self, plot: BesidePlot | None) -> None:
        self.plot = plot
        self.show_painted(None if plot is None else plot.paint)

    def show_shares(self, shares: tuple[float, float]) -> None:
        """Where the player is in the repetition of each."""
        if self.plot is not None and shares != self.plot.shares:
            self.show_plot(replace(self.plot, shares=shares))

    def sizeHint(self) -> QSize:
        return QSize(540, 200)

    def minimumSizeHint(self) -> QSize:
        return QSize(self._theme.px(300), self._theme.px(104))

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if self.plot is not None and event.button() == Qt.MouseButton.LeftButton:
            panel = self.plot.panel(screen_style(self._theme), QRectF(self.rect()))
            share = (event.position().x() - panel.box.left()) / max(panel.box.width(), 1.0)
            if -0.02 <= share <= 1.02:
                self.sought.emit(min(max(share, 0.0), 1.0))
