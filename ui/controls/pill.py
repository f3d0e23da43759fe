"""The recording pill: told by shape, word, colour and time at once."""

from __future__ import annotations

from typing import Literal

from PySide6.QtCore import QSize, Signal
from PySide6.QtWidgets import QHBoxLayout, QSizePolicy

from carpus.ui import numbers
from carpus.ui.controls.card import Surface
from carpus.ui.controls.text import SEMIBOLD, Sign, Text
from carpus.ui.theme import Theme

PillState = Literal["off", "recording", "paused"]


class RecordingPill(Surface):
    """Hidden while nothing is recorded; as wide whatever the time. ``resized`` when it needs other room."""

    resized = Signal()

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme)
        self.state: PillState = "off"
        self._dot, self._bars = Surface(theme, "on_band_bad"), Sign(theme, "pause", 16, (16, 20), "text")
        self._dot.setObjectName("dot")
        self._dot.setFixedSize(13, 13)
        self._words = Text(theme, "", 20, SEMIBOLD)
        row = QHBoxLayout(self)
        row.setContentsMargins(14, 0, 16, 0)
        row.setSpacing(8)
        row.addWidget(self._dot)
        row.addWidget(self._bars)
        row.addWidget(self._words)
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        self.hide()

    def show_state(self, state: PillState, seconds: float) -> None:
        """Set state and recorded time."""
        pattern = self.tr("Recording {time}") if state == "recording" else self.tr("Paused at {time}")
        text = pattern.format(time=numbers.clock(seconds)) if state != "off" else ""
        if (state, text) != (self.state, self._words.text()):
            resize = state != self.state or len(text) != len(self._words.text())
            self._words.setText(text)
            self.setAccessibleName(text)
            self.setVisible(state != "off")
            if state != self.state:
                self.state = state
                recording = state == "recording"
                self.set_colors(*(("band_bad",) if recording else ("surface", "text")))
                self._words.set_look("on_band_bad" if recording else "text", SEMIBOLD)
                self._dot.setVisible(recording)
                self._bars.setVisible(not recording)
            if resize:
                self.updateGeometry()
                self.resized.emit()

    def sizeHint(self) -> QSize:
        return QSize(super().sizeHint().width(), self._theme.px(40))
