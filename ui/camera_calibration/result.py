"""The result of a calibration: in words, in figures, as a map; use it, or take the pictures again."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QBoxLayout, QGridLayout, QHBoxLayout, QVBoxLayout, QWidget

from carpus.ui.camera_calibration.maps import LandingMap
from carpus.ui.camera_calibration.values import BoardResult
from carpus.ui.camera_calibration.words import effect_rows, headline, kept_words, result_rows
from carpus.ui.controls.button import ENTER, Button
from carpus.ui.controls.card import Card, Line
from carpus.ui.controls.layouts import ScrolledColumn, empty, scroll_area
from carpus.ui.controls.text import MEDIUM, REGULAR, SEMIBOLD, Sign, Text, caption, heading
from carpus.ui.theme import GAP_PX, MARGIN_PX, Theme


class BoardResultView(QWidget):
    """``use`` it, take the pictures ``again``, ``page`` asks for the one-page PDF."""

    use = Signal()
    again = Signal()
    page = Signal()

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self.result: BoardResult | None = None
        self.answer = heading(theme, wrap=True)
        self.basis = Text(theme, "", 16, REGULAR, "text2", wrap=True)
        self.map = LandingMap(theme)
        self.again_button = Button(theme, self.tr("Take &again"), icon="rotate-ccw")
        self.page_button = Button(theme, self.tr("One page…"), "quiet", hint="Ctrl+P")
        self.use_button = Button(theme, self.tr("Use this calibration"), "primary", icon="check", hint=ENTER)
        self._table, self._effect = Card(theme, 20), Card(theme, 20)
        self._next = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self._lay_out()
        self.use_button.clicked.connect(self.use)
        self.again_button.clicked.connect(self.again)
        self.page_button.clicked.connect(self.page)

    def _lay_out(self) -> None:
        theme = self._theme
        where = Card(theme, 20)
        where.body.addWidget(Text(theme, self.tr("Where lines land, enlarged 50 times"), 16, SEMIBOLD, wrap=True))
        where.body.addWidget(self.map, 1)
        host = ScrolledColumn()
        self._columns = QBoxLayout(QBoxLayout.Direction.LeftToRight, host)
        self._columns.setContentsMargins(0, 0, 0, 0)
        self._columns.setSpacing(GAP_PX)
        left = QVBoxLayout()
        left.setSpacing(GAP_PX)
        left.addWidget(where, 1)
        left.addWidget(self._effect)
        self._columns.addLayout(left, 3)
        self._columns.addWidget(self._table, 4)
        foot = QHBoxLayout()
        foot.setSpacing(12)
        foot.addWidget(self.again_button)
        foot.addWidget(self.page_button)
        foot.addWidget(self._next, 1)
        foot.addWidget(self.use_button)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(MARGIN_PX, GAP_PX - 4, MARGIN_PX, GAP_PX)
        whole.setSpacing(0)
        whole.addWidget(self.answer)
        whole.addSpacing(2)
        whole.addWidget(self.basis)
        whole.addSpacing(12)
        whole.addWidget(scroll_area(host), 1)
        whole.addSpacing(12)
        whole.addLayout(foot)
        self._theme.changed.connect(self._fit)

    def resizeEvent(self, event: QResizeEvent) -> None:
        self._fit()

    def _fit(self) -> None:
        narrow = self.width() < 1000 * self._theme.text_scale
        directions = QBoxLayout.Direction
        self._columns.setDirection(directions.TopToBottom if narrow else directions.LeftToRight)
        self._next.setVisible(not narrow)

    def show_result(self, result: BoardResult) -> None:
        self.result = result
        answer, basis = headline(result)
        self.answer.setText(answer)
        self.basis.setText(basis)
        self.map.show_map(np.asarray(result.effect.map_px))
        usable = result.made.is_usable and result.may_use
        self.use_button.setVisible(usable)
        self._next.setText(self.tr("Next: 30 seconds with the check card show it on known angles.") if usable else "")
        self._fill_table(result)
        self._fill_effect(result)

    def first(self) -> QWidget:
        return self.use_button if self.use_button.isVisibleTo(self) else self.again_button

    def _fill_table(self, result: BoardResult) -> None:
        body, theme = self._table.body, self._theme
        empty(body)
        table = QWidget()
        grid = QGridLayout(table)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setHorizontalSpacing(12)
        grid.setVerticalSpacing(5)
        for column, stretch in enumerate((0, 30, 22, 26, 30)):
            grid.setColumnStretch(column, stretch)
        before = self.tr("Before ({day})").format(day=result.since) if result.since else self.tr("Before (maker)")
        for column, words in enumerate((self.tr("What"), before, self.tr("Now"), self.tr("In words")), 1):
            grid.addWidget(caption(theme, words, wrap=True), 0, column)
        for number, (state, *cells) in enumerate(result_rows(result), 1):
            row = 2 * number
            grid.addWidget(Line(theme), row - 1, 0, 1, 5)
            grid.addWidget(Sign(theme, state), row, 0)
            styles = ((MEDIUM, "text"), (REGULAR, "text2"), (SEMIBOLD, "text"), (REGULAR, "text2"))
            for column, (cell, (weight, token)) in enumerate(zip(cells, styles, strict=True), 1):
                grid.addWidget(Text(theme, cell, 14, weight, token, wrap=True), row, column)
        body.addWidget(table)
        body.addSpacing(8)
        body.addWidget(Text(theme, kept_words(result), 14, REGULAR, "text2", wrap=True))
        body.addStretch(1)

    def _fill_effect(self, result: BoardResult) -> None:
        body, theme = self._effect.body, self._theme
        empty(body)
        body.addWidget(Text(theme, self.tr("What this means for a hand"), 16, SEMIBOLD, wrap=True))
        for name, value in effect_rows(result):
            body.addWidget(_Pair(theme, name, value))
        words = self.tr("Estimated from the change of the camera’s values, not measured on hands.")
        body.addWidget(caption(theme, words, wrap=True))


class _Pair(QWidget):
    """A name and its value at the right."""

    def __init__(self, theme: Theme, name: str, value: str) -> None:
        super().__init__()
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(Text(theme, name, 14, REGULAR, wrap=True), 1)
        row.addWidget(Text(theme, value, 14, SEMIBOLD))
