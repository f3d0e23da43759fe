"""Something that is wanted or not."""

from __future__ import annotations

from carpus.ui.controls.button import Button
from carpus.ui.theme import Theme


class Tick(Button):
    """A plus, and a check once it is wanted. Enter is not its own."""

    def __init__(self, theme: Theme, words: str) -> None:
        super().__init__(theme, words, "quiet", icon="plus", height_px=38)
        self.on_enter = "pass"
        self.setCheckable(True)
        self.toggled.connect(lambda on: self.set_face(words, icon="check" if on else "plus"))
