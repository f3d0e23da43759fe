"""The figures of every angle of a comparison, one row each."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QGridLayout, QWidget

from carpus.ui.agreement.words import angle_name, angle_token, interval, judgement_words, limits, share, signed, tenths
from carpus.ui.controls.card import Line
from carpus.ui.controls.layouts import empty
from carpus.ui.controls.text import REGULAR, SEMIBOLD, Sign, Text, caption, named_by_color
from carpus.ui.icons import State
from carpus.ui.theme import Theme

if TYPE_CHECKING:  # a window loads nothing that reads files
    from carpus.core.agreement.compare import Compared, Pairs

COLUMNS = 7
STRETCH = (20, 18, 20, 7, 15, 9, 21)
STATE_TOKEN = {"good": "good", "warn": "warn", "bad": "bad"}


class AgreementTable(QWidget):
    """Rows of texts; the interval of a figure stands below it."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setHorizontalSpacing(12)
        self._grid.setVerticalSpacing(3)
        for column, stretch in enumerate(STRETCH):
            self._grid.setColumnStretch(column, stretch)

    def show_compared(self, compared: Compared, limit_deg: float) -> None:
        """Replace all rows."""
        empty(self._grid)
        heads = (
            self.tr("Angle"), self.tr("Mean difference"), self.tr("Limits of agreement"), self.tr("RMSE"),
            self.tr("ICC(2,1)"), self.tr("Curve match"), self.tr("In words"),
        )  # fmt: skip
        for column, head in enumerate(heads):
            self._grid.addWidget(caption(self._theme, head, wrap=True), 0, column)
        for number, pairs in enumerate(compared.pairs):
            row = 3 * number + 1
            self._grid.addWidget(Line(self._theme), row, 0, 1, COLUMNS)
            self._add_row(row + 1, pairs, limit_deg, readings=compared.shift is None)

    def _add_row(self, row: int, pairs: Pairs, limit_deg: float, *, readings: bool) -> None:
        theme, name, figures = self._theme, pairs.name, pairs.figures_deg
        state, words = judgement_words(pairs, limit_deg, readings=readings)
        first = (
            named_by_color(theme, angle_name(name), angle_token(name)),
            Text(theme, signed(figures.bias, name), 14, SEMIBOLD, wrap=True),
            Text(theme, limits(figures, name), 14, REGULAR, wrap=True),
            Text(theme, tenths(figures.rmse), 14, SEMIBOLD),
            Text(theme, share(figures.icc), 14, SEMIBOLD),
            Text(theme, share(figures.cmc), 14, REGULAR),
            _Judged(theme, state, words),
        )
        low, high = figures.icc_interval
        icc = self.tr("{low} to {high}").format(low=share(low), high=share(high)) if low == low else ""
        second = {1: interval(figures.bias_interval, name), 4: icc}
        for column, widget in enumerate(first):
            spans = 1 if column in second else 2
            self._grid.addWidget(widget, row, column, spans, 1, Qt.AlignmentFlag.AlignVCenter)
        for column, text in second.items():
            self._grid.addWidget(caption(theme, f"({text})" if text else "", wrap=True), row + 1, column)


class _Judged(QWidget):
    """Sign and words, which may need two lines."""

    def __init__(self, theme: Theme, state: State, words: str) -> None:
        super().__init__()
        row = QGridLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setHorizontalSpacing(8)
        row.addWidget(Sign(theme, state), 0, 0, Qt.AlignmentFlag.AlignTop)
        row.addWidget(Text(theme, words, 14, SEMIBOLD, STATE_TOKEN.get(state, "text2"), wrap=True), 0, 1)
        row.setColumnStretch(1, 1)
