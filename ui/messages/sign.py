"""A line under the top bar that stays as long as something must not be forgotten: simulated, or doubtful."""

from __future__ import annotations

from collections.abc import Sequence

from carpus.ui.controls.card import Surface
from carpus.ui.controls.layouts import in_line
from carpus.ui.controls.text import MEDIUM, Sign, Text
from carpus.ui.theme import MARGIN_PX, Theme


class AmberLine(Surface):
    """Amber, with a triangle; hidden while there is nothing to say."""

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme, "warn_soft", under="warn")
        self._words = Text(theme, "", 14, MEDIUM, wrap=True)
        in_line(Sign(theme, "warn"), (self._words, 1), gap=10, margins=(MARGIN_PX, 5, MARGIN_PX, 5), within=self)
        self.show_lines(())

    @property
    def text(self) -> str:
        """What it says, empty while it is hidden."""
        return self._words.text()

    def show_lines(self, lines: Sequence[str]) -> None:
        """Say these sentences, or hide."""
        words = " ".join(lines)
        self._words.setText(words)
        self.setAccessibleName(words)
        self.setVisible(bool(words))
