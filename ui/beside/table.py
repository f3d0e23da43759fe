"""The card of the differences between two sessions: what is compared, and a table of it."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QWidget

from carpus.core.results.side_by_side import SideBySide
from carpus.ui.beside.words import BesideRow, facts_words, heads, kinds, other_hand_words, table_rows
from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Card, Line, named_by_color
from carpus.ui.controls.field import Combo
from carpus.ui.controls.layouts import empty, fill, in_column, in_grid, in_line
from carpus.ui.controls.text import REGULAR, SEMIBOLD, ElidedText, Sign, Text, caption, plain_tooltip
from carpus.ui.keys import KEYS
from carpus.ui.theme import Theme
from carpus.ui.verdicts import limit_words

COLUMN_SHARES = (20, 17, 17, 13, 8, 34)
RIGHT = (3, 4)
"""Columns whose figures end at the right."""


class DifferencesCard(Card):
    """``followed`` chooses what of the whole hand is compared, ``mirror_button`` how a left hand is shown."""

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme, 20)
        self._theme = theme
        self.rows: tuple[BesideRow, ...] = ()
        self._facts = ElidedText(theme, "", 14, REGULAR, "text2")
        self.followed = Combo()
        self.followed.setAccessibleName(self.tr("What is compared"))
        self.followed.setFocusPolicy(Qt.FocusPolicy.TabFocus)  # a click leaves Space and the arrows to the player
        self.mirror_button = Button(theme, self.tr("&Mirror"), "quiet", hint=KEYS["mirror"])
        self.mirror_button.setCheckable(True)
        self.mirror_button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.mirror_button.setToolTip(self.tr("Show the left hand as it would look as a right one"))
        self._table = QWidget()
        self._grid = in_grid(16, 5, shares=COLUMN_SHARES, margins=(0, 0, 0, 0), within=self._table)
        self._limits = caption(theme, wrap=True)
        named = in_column(Text(theme, self.tr("Differences"), 20, SEMIBOLD), self._facts, gap=0)
        fill(self.body, in_line((named, 1), self.followed, self.mirror_button, gap=12), self._table, self._limits)

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
        self._show_rows(heads(both), table_rows(both))
        words = [limit_words(both.first.study), *([other_hand_words()] if both.relation == "hands" else [])]
        self._limits.setText(" ".join(words))

    def _show_rows(self, heads: Sequence[str], rows: Sequence[BesideRow]) -> None:
        empty(self._grid)
        self.rows = tuple(rows)
        for column, head in enumerate(heads):
            self._grid.addWidget(caption(self._theme, head, wrap=True), 0, column, _side(column))
        for number, row in enumerate(rows):
            self._grid.addWidget(Line(self._theme), 2 * number + 1, 0, 1, len(COLUMN_SHARES))
            for column, cell in enumerate(self._cells(row)):
                side = _side(column) if column in RIGHT else Qt.AlignmentFlag(0)
                self._grid.addWidget(cell, 2 * number + 2, column, side)
        said = "; ".join(f"{row.movement} {row.first} {row.second} {row.words}" for row in rows)
        self._table.setAccessibleName(said)

    def _cells(self, row: BesideRow) -> tuple[QWidget, ...]:
        theme, weight, token = self._theme, SEMIBOLD if row.strong else REGULAR, "text" if row.strong else "text2"
        said = QWidget()
        sign = (Sign(theme, row.state), 0, Qt.AlignmentFlag.AlignVCenter)
        in_line(sign, (Text(theme, row.words, 14, weight, token, wrap=True), 1), margins=(0, 0, 0, 0), within=said)
        return (
            named_by_color(theme, row.movement, row.token), Text(theme, row.first, 16, SEMIBOLD, wrap=True),
            Text(theme, row.second, 16, SEMIBOLD, wrap=True), Text(theme, row.difference, 14, weight, token),
            Text(theme, row.error, 14, REGULAR, "text2"), said,
        )  # fmt: skip


def _side(column: int) -> Qt.AlignmentFlag:
    across = Qt.AlignmentFlag.AlignRight if column in RIGHT else Qt.AlignmentFlag(0)
    return across | Qt.AlignmentFlag.AlignVCenter
