"""Which result of a recording is shown, where it was tracked more than once."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QWidget

from carpus.ui.controls.button import Button
from carpus.ui.controls.layouts import in_line
from carpus.ui.controls.text import MEDIUM, Text
from carpus.ui.numbers import short_date
from carpus.ui.ports import StoredResult
from carpus.ui.theme import Theme


class ResultChoice(QWidget):
    """``chosen`` carries the identity of another result. Hidden while there is one only; the newest counts."""

    chosen = Signal(str)

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._row = in_line(gap=8, margins=(0, 0, 0, 0), within=self)
        self.buttons: list[Button] = []
        self.hide()

    def show_results(self, results: Sequence[StoredResult], current: str) -> None:
        """All results of the recording, the first one first."""
        while (item := self._row.takeAt(0)) is not None:
            if (widget := item.widget()) is not None:
                widget.hide()
                widget.deleteLater()
        self.buttons = []
        if len(results) > 1:
            self._row.addWidget(Text(self._theme, self.tr("Results of this recording"), 14, MEDIUM))
            for number, result in enumerate(results, 1):
                words = self.tr("{number} · {day}").format(number=number, day=short_date(result.created))
                if number == len(results):
                    words = self.tr("{result}, counts").format(result=words)
                button = Button(self._theme, words, "well", height_px=32)
                button.setCheckable(True)
                button.setChecked(result.session_id == current)
                button.setEnabled(result.session_id != current)
                button.clicked.connect(lambda _=False, one=result: self.chosen.emit(one.session_id))
                self._row.addWidget(button)
                self.buttons.append(button)
            self._row.addStretch(1)
        self.setVisible(len(results) > 1)
