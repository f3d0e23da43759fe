"""Changes of values measured by hand, as rows of a card."""

from __future__ import annotations

from collections.abc import Iterable

from PySide6.QtWidgets import QVBoxLayout

from carpus.core.measures.manual_measurements import ManualChange, MeasureKey
from carpus.ui.kit.card import Separator
from carpus.ui.kit.text import REGULAR, SEMIBOLD, StateText, Text
from carpus.ui.kit.theme import Theme
from carpus.ui.words.manual_values import change_words, full_name, verdict_words


def add_change_rows(body: QVBoxLayout, theme: Theme, found: Iterable[tuple[MeasureKey, ManualChange]]) -> None:
    """Add each change with its assessment, then both values."""
    for key, change in found:
        body.addWidget(Separator(theme))
        state, verdict = verdict_words(change)
        sign = StateText(theme, 14, SEMIBOLD, 16)
        sign.show_state(state, f"{full_name(key)}: {verdict}", token="text")  # type: ignore[arg-type]
        body.addWidget(sign)
        body.addWidget(Text(theme, change_words(change), 14, REGULAR, "text2", wrap=True))
