"""Calibrating the camera with a printed board: before it is shown, while it is shown, and the result."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QStackedWidget, QVBoxLayout, QWidget

from carpus.ui.camera_calibration.begin import BoardBeginning
from carpus.ui.camera_calibration.name_sheet import CameraNameSheet
from carpus.ui.camera_calibration.result import BoardResultView
from carpus.ui.camera_calibration.showing import BoardShowing
from carpus.ui.camera_calibration.values import BoardResult
from carpus.ui.keys import Keys, bind
from carpus.ui.theme import Theme


class BoardScreen(QWidget):
    """Three parts, one at a time; what they ask for is told by their own signals. ``turned`` to another part."""

    turned = Signal()

    def __init__(self, theme: Theme, keys: Keys) -> None:
        super().__init__()
        self.beginning = BoardBeginning(theme)
        self.showing = BoardShowing(theme, keys)
        self.result = BoardResultView(theme)
        self._parts = QStackedWidget()
        for part in (self.beginning, self.showing, self.result):
            self._parts.addWidget(part)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(0, 0, 0, 0)
        whole.addWidget(self._parts)
        self.name_sheet = CameraNameSheet(self, theme)
        bind(self, keys, "report", self._print)

    def _print(self) -> None:
        """Ctrl+P: the board before it is shown, the page after."""
        part = self._parts.currentWidget()
        if part is self.beginning:
            self.beginning.print_button.click()
        elif part is self.result:
            self.result.page_button.click()

    @property
    def is_showing(self) -> bool:
        return self._parts.currentWidget() is self.showing

    @property
    def shows_simulated(self) -> bool:
        """Whether what is shown, or was worked out, is of the simulated camera."""
        if self._parts.currentWidget() is self.result:
            return self.result.result is not None and self.result.result.simulated
        return self.is_showing and self.showing.simulated

    @property
    def is_beginning(self) -> bool:
        return self._parts.currentWidget() is self.beginning

    def show_beginning(self) -> None:
        self._show(self.beginning)

    def show_showing(self, *, simulated: bool) -> None:
        self.showing.begin(simulated=simulated)
        self._show(self.showing)

    def show_result(self, result: BoardResult) -> None:
        self.result.show_result(result)
        self._show(self.result)

    def _show(self, part: QWidget) -> None:
        self._parts.setCurrentWidget(part)
        self.first().setFocus(Qt.FocusReason.OtherFocusReason)
        self.turned.emit()

    def first(self) -> QWidget:
        if self.is_showing:
            return self.showing.picture
        return self.result.first() if self._parts.currentWidget() is self.result else self.beginning.first()
