"""The card of the differences between two sessions: what is compared, and a table of it."""

from __future__ import annotations

from PySide6.QtCore import Qt

from carpus.core.results.side_by_side import SideBySide
from carpus.ui.beside.words import difference_table, facts_words, kinds, other_hand_words
from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Card
from carpus.ui.controls.field import Combo
from carpus.ui.controls.layouts import fill, in_column, in_line
from carpus.ui.controls.table import Table
from carpus.ui.controls.text import REGULAR, SEMIBOLD, ElidedText, Text, caption, plain_tooltip
from carpus.ui.keys import KEYS
from carpus.ui.theme import Theme
from carpus.ui.verdicts import limit_words


class DifferencesCard(Card):
    """``followed`` chooses what of the whole hand is compared, ``mirror_button`` how a left hand is shown."""

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme, 20)
        self._theme = theme
        self._facts = ElidedText(theme, "", 14, REGULAR, "text2")
        self.followed = Combo()
        self.followed.setAccessibleName(self.tr("What is compared"))
        self.followed.setFocusPolicy(Qt.FocusPolicy.TabFocus)  # a click leaves Space and the arrows to the player
        self.mirror_button = Button(theme, self.tr("&Mirror"), "quiet", hint=KEYS["mirror"])
        self.mirror_button.setCheckable(True)
        self.mirror_button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.mirror_button.setToolTip(self.tr("Show the left hand as it would look as a right one"))
        self.table = Table(theme, gap=16)
        self._limits = caption(theme, wrap=True)
        named = in_column(Text(theme, self.tr("Differences"), 20, SEMIBOLD), self._facts, gap=0)
        fill(self.body, in_line((named, 1), self.followed, self.mirror_button, gap=12), self.table, self._limits)

    def begin(self, both: SideBySide) -> None:
        """What can be looked at of two sessions, and whether one of them can be mirrored."""
        found = kinds(both.first, both.second)
        self.followed.offer(found)
        self.followed.setVisible(bool(found))
        self.mirror_button.setVisible("left" in (both.first.side, both.second.side))
        self.mirror_button.setChecked(both.first.side != both.second.side)

    def show_differences(self, both: SideBySide) -> None:
        facts = facts_words(both)
        self._facts.setText(facts)
        self._facts.setToolTip(plain_tooltip(facts))
        self.table.show_rows(*difference_table(both))
        words = [limit_words(both.first.study), *([other_hand_words()] if both.relation == "hands" else [])]
        self._limits.setText(" ".join(words))
