"""Card of the settings about the camera's calibration and check."""

from __future__ import annotations

from carpus.ui.kit.button import Button
from carpus.ui.kit.card import Card
from carpus.ui.kit.icons import State
from carpus.ui.kit.layouts import STRETCH, fill, row_layout
from carpus.ui.kit.text import SEMIBOLD, Icon, Text
from carpus.ui.kit.theme import Theme


class CameraCard(Card):
    """Status of the camera, with buttons to check and calibrate it."""

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme, 24)
        self._theme = theme
        words = self.tr(
            "A printed board calibrates the camera. A printed card checks in 30 seconds whether the camera is still "
            "within tolerance."
        )
        self.add_heading(self.tr("Camera"), words)
        self._row = row_layout(gap=10)
        self._sign = Icon(theme, "none")
        self._state = Text(theme, "", 14, SEMIBOLD, wrap=True)
        fill(self._row, self._sign, (self._state, 1))
        self.body.addLayout(self._row)
        buttons = row_layout(gap=12)
        self.check_button = Button(theme, self.tr("Chec&k card…"), height_px=40)
        self.calibrate_button = Button(theme, self.tr("Cali&brate the camera…"), height_px=40)
        fill(buttons, self.check_button, self.calibrate_button, STRETCH)
        self.body.addLayout(buttons)

    def show_status(self, state: State, words: str) -> None:
        sign = Icon(self._theme, state)
        self._row.replaceWidget(self._sign, sign)
        self._sign.hide()
        self._sign.deleteLater()
        self._sign = sign
        self._state.setText(words)

    def show_demo(self) -> None:
        """Show that a simulated camera needs no calibration."""
        for button in (self.check_button, self.calibrate_button):
            button.hide()
        self._sign.hide()  # an empty sign would set the words in
        self._state.setText(self.tr("In the demo the camera is simulated. It needs no calibration."))
