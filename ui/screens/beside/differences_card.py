"""Card with the differences between two sessions."""

from __future__ import annotations

from PySide6.QtCore import Qt

from carpus.core.results.side_by_side import SessionPair
from carpus.ui.kit.button import Button
from carpus.ui.kit.card import Card
from carpus.ui.kit.field import Combo
from carpus.ui.kit.keys import KEYS
from carpus.ui.kit.layouts import column_layout, fill, row_layout
from carpus.ui.kit.table import Table
from carpus.ui.kit.text import REGULAR, SEMIBOLD, ElidedText, Text, caption, plain_tooltip
from carpus.ui.kit.theme import Theme
from carpus.ui.screens.beside.words import comparison_choices, difference_table, facts_words, hand_comparison_note
from carpus.ui.words.verdicts import error_limit_words


class DifferencesCard(Card):
    """Table of differences.

    ``measure_choice`` selects what is compared, ``mirror_button`` mirrors the left hand.
    """

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme, 20)
        self._theme = theme
        self._facts = ElidedText(theme, "", 14, REGULAR, "text2")
        self.measure_choice = Combo()
        self.measure_choice.setAccessibleName(self.tr("Value to compare"))
        self.measure_choice.setFocusPolicy(Qt.FocusPolicy.TabFocus)  # a click leaves Space and the arrows to the player
        self.mirror_button = Button(theme, self.tr("&Mirror"), "quiet", hint=KEYS["mirror"])
        self.mirror_button.setCheckable(True)
        self.mirror_button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.mirror_button.setToolTip(self.tr("Show the left hand as it would look as a right one"))
        self.table = Table(theme, gap=16)
        self._limits = caption(theme, wrap=True)
        named = column_layout(Text(theme, self.tr("Differences"), 20, SEMIBOLD), self._facts, gap=0)
        fill(
            self.body, row_layout((named, 1), self.measure_choice, self.mirror_button, gap=12), self.table, self._limits
        )

    def show_choices(self, comparison: SessionPair) -> None:
        """Offer what both sessions share, and mirroring if one is of a left hand."""
        found = comparison_choices(comparison.first, comparison.second)
        self.measure_choice.set_choices(found)
        self.measure_choice.setVisible(bool(found))
        self.mirror_button.setVisible("left" in (comparison.first.side, comparison.second.side))
        self.mirror_button.setChecked(comparison.first.side != comparison.second.side)

    def show_differences(self, comparison: SessionPair) -> None:
        facts = facts_words(comparison)
        self._facts.setText(facts)
        self._facts.setToolTip(plain_tooltip(facts))
        self.table.show_rows(*difference_table(comparison))
        words = [
            error_limit_words(comparison.first.study),
            *([hand_comparison_note()] if comparison.relation == "hands" else []),
        ]
        self._limits.setText(" ".join(words))
