"""Calibrating the camera with a printed board: before it is shown, while it is shown, and the result."""

from __future__ import annotations

from typing import cast

import numpy as np
from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QBoxLayout, QDoubleSpinBox, QStackedWidget, QWidget

from carpus.core.calibration.camera.board import Pattern
from carpus.core.calibration.camera.sheet import RULER_MM, Paper
from carpus.ui.camera_calibration.maps import LandingMap
from carpus.ui.camera_calibration.showing import BoardShowing
from carpus.ui.camera_name_sheet import CameraNameSheet
from carpus.ui.controls.button import ENTER, Button
from carpus.ui.controls.card import Card, Line
from carpus.ui.controls.field import Choices, leave_wheel
from carpus.ui.controls.layouts import (
    STRETCH,
    Fitted,
    ScrollArea,
    ScrolledColumn,
    empty,
    fill,
    in_column,
    in_grid,
    in_line,
)
from carpus.ui.controls.text import MEDIUM, REGULAR, SEMIBOLD, Sign, Text, caption, heading
from carpus.ui.keys import Keys, bind
from carpus.ui.theme import GAP_PX, MARGIN_PX, Theme
from carpus.ui.words.camera_calibration import BoardChoice, BoardResult, effect_rows, headline, kept_words, result_rows


class BoardScreen(QWidget):
    """Three parts, one at a time; what they ask for is told by their own signals. ``turned`` to another part."""

    turned = Signal()

    def __init__(self, theme: Theme, keys: Keys) -> None:
        super().__init__()
        self.beginning = BoardBeginning(theme)
        self.showing = BoardShowing(theme, keys)
        self.result = BoardResultView(theme)
        self._parts = QStackedWidget()
        for part in (self.beginning, self.showing, self.result):
            self._parts.addWidget(part)
        in_column(self._parts, margins=(0, 0, 0, 0), within=self)
        self.name_sheet = CameraNameSheet(self, theme)
        bind(self, keys, "report", self._print)

    def _print(self) -> None:
        """Ctrl+P: the board before it is shown, the page after."""
        part = self._parts.currentWidget()
        if part is self.beginning:
            self.beginning.print_button.click()
        elif part is self.result:
            self.result.page_button.click()

    @property
    def is_showing(self) -> bool:
        return self._parts.currentWidget() is self.showing

    @property
    def shows_simulated(self) -> bool:
        if self._parts.currentWidget() is self.result:
            return self.result.result is not None and self.result.result.simulated
        return self.is_showing and self.showing.simulated

    @property
    def is_beginning(self) -> bool:
        return self._parts.currentWidget() is self.beginning

    def show_beginning(self) -> None:
        self._show(self.beginning)

    def show_showing(self, *, simulated: bool) -> None:
        self.showing.begin(simulated=simulated)
        self._show(self.showing)

    def show_result(self, result: BoardResult) -> None:
        self.result.show_result(result)
        self._show(self.result)

    def _show(self, part: QWidget) -> None:
        self._parts.setCurrentWidget(part)
        self.first().setFocus(Qt.FocusReason.OtherFocusReason)
        self.turned.emit()

    def first(self) -> QWidget:
        if self.is_showing:
            return self.showing.picture
        return self.result.first() if self._parts.currentWidget() is self.result else self.beginning.first()


RULER_RANGE_MM = (80.0, 120.0)
MOST_WIDE_PX = 900


class BoardBeginning(QWidget):
    """What is chosen before the board is shown."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self.pattern = Choices(
            theme,
            [
                ("chessboard", self.tr("Chessboard")),
                ("charuco", self.tr("ChArUco: may be partly hidden, takes longer")),
            ],
            "chessboard",
        )  # fmt: skip
        self.paper = Choices(theme, [("a4", "A4"), ("letter", "Letter")], "a4")
        self.print_button = Button(theme, self.tr("&Print the board…"), icon="file-text")
        self.ruler = QDoubleSpinBox()
        leave_wheel(self.ruler)
        self.ruler.setRange(*RULER_RANGE_MM)
        self.ruler.setDecimals(1)
        self.ruler.setSingleStep(0.5)
        self.ruler.setValue(RULER_MM)
        self.ruler.setSuffix("\N{NO-BREAK SPACE}mm")
        self.ruler.setAccessibleName(self.tr("The ruler on the print measures"))
        self.ruler.lineEdit().setTextMargins(10, 0, 10, 0)
        self.camera = Choices(
            theme, [(False, self.tr("The camera")), (True, self.tr("Simulated camera, to practise"))], False
        )
        self.camera_words = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.begin_button = Button(theme, self.tr("Begin"), "primary", icon="camera", hint=ENTER)
        self._lay_out()
        self.camera.chosen.connect(lambda _: self._show_camera())
        self._camera_there = False
        theme.changed.connect(self._fit)
        self._fit()
        self.show_standing("", camera_there=False)

    def _lay_out(self) -> None:
        theme = self._theme
        body = in_column(gap=GAP_PX, margins=(4, 4, 12, 4))
        self._now = Text(theme, "", 16, REGULAR, "text2", wrap=True)
        words = self.tr(
            "Five minutes: how the lens sees, how far off the depth is, and whether depth lies on colour. Do it once "
            "for each camera, after a knock, and when the check card says so."
        )
        body.addWidget(heading(theme, self.tr("Calibrate the camera"), wrap=True))
        fill(body, Text(theme, words, 16, REGULAR, "text2", wrap=True), self._now)
        board = self._card(self.tr("1  Print the board"))
        fill(board.body, self.pattern, in_line(self.paper, self.print_button, STRETCH, gap=12))
        words = self.tr(
            "Print at 100 % (“actual size”) on plain paper and glue it flat onto something stiff, such as glass or a "
            "thick board. Then measure the ruler under it."
        )
        board.body.addWidget(Text(theme, words, 14, REGULAR, "text2", wrap=True))
        row = in_line(Text(theme, self.tr("The ruler on the print measures"), 14), self.ruler, STRETCH, gap=12)
        board.body.addLayout(row)
        body.addWidget(board)
        show = self._card(self.tr("2  Show it to the camera"))
        words = self.tr(
            "Even light, no reflections. The screen says where to hold the board; pictures are taken by themselves "
            "when it is still, sharp and in a new place. Nothing is changed before you say so."
        )
        fill(show.body, Text(theme, words, 14, REGULAR, "text2", wrap=True), self.camera, self.camera_words)
        show.body.addWidget(self.begin_button, 0, Qt.AlignmentFlag.AlignLeft)
        fill(body, show, caption(theme, self.tr("No picture of the board is stored."), wrap=True), STRETCH)
        self._host = ScrolledColumn()
        self._host.setLayout(body)
        whole = in_line(margins=(MARGIN_PX - 4, GAP_PX, MARGIN_PX - 8, GAP_PX), within=self)
        self._scroll = ScrollArea(self._host)
        whole.addWidget(self._scroll, 1)

    def _card(self, title: str) -> Card:
        card = Card(self._theme, 24)
        card.body.setSpacing(12)
        card.body.addWidget(Text(self._theme, title, 20, SEMIBOLD))
        return card

    def _fit(self) -> None:
        self.ruler.setFixedWidth(self._theme.px(130))
        self._host.setMaximumWidth(self._theme.px(MOST_WIDE_PX))

    @property
    def choice(self) -> BoardChoice:
        return BoardChoice(
            cast("Pattern", self.pattern.value()),
            cast("Paper", self.paper.value()),
            self.ruler.value(),
            bool(self.camera.value()),
        )

    def show_standing(self, words: str, *, camera_there: bool) -> None:
        self._now.say(words)
        self._camera_there = camera_there
        self._show_camera()

    def set_camera_there(self, there: bool) -> None:
        if there != self._camera_there:
            self._camera_there = there
            self._show_camera()

    def offer_simulated(self) -> None:
        """No other camera than the simulated one, as in a demo."""
        self.camera.choose(True)
        self.camera.hide()
        self._show_camera()

    def _show_camera(self) -> None:
        practice = bool(self.camera.value())
        words = self.tr("A simulated board before a simulated camera, both clearly marked; kept apart from real ones.")
        if not practice:
            words = self.tr("It is plugged in.") if self._camera_there else self.tr("No camera is plugged in.")
        self.camera_words.setText(words)
        self.begin_button.setEnabled(practice or self._camera_there)
        self.begin_button.set_face(
            self.tr("Begin") if practice or self._camera_there else self.tr("Begin · plug the camera in")
        )

    def first(self) -> QWidget:
        return self.begin_button if self.begin_button.isEnabled() else self.print_button


class BoardResultView(Fitted):
    """What was found, to be used, printed, or made again."""

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

    def _lay_out(self) -> None:
        theme = self._theme
        where = Card(theme, 20)
        where.body.addWidget(Text(theme, self.tr("Where lines land, enlarged 50 times"), 16, SEMIBOLD, wrap=True))
        where.body.addWidget(self.map, 1)
        host = ScrolledColumn()
        self._columns = QBoxLayout(QBoxLayout.Direction.LeftToRight, host)
        self._columns.setContentsMargins(0, 0, 0, 0)
        self._columns.setSpacing(GAP_PX)
        left = in_column((where, 1), self._effect, gap=GAP_PX)
        fill(self._columns, (left, 3), (self._table, 4))
        foot = in_line(self.again_button, self.page_button, (self._next, 1), self.use_button, gap=12)
        whole = in_column(
            self.answer, 2, self.basis, 12, gap=0, margins=(MARGIN_PX, GAP_PX - 4, MARGIN_PX, GAP_PX), within=self
        )
        fill(whole, (ScrollArea(host), 1), 12, foot)
        self._theme.changed.connect(self._fit)

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
        grid = in_grid(12, 5, shares=(0, 30, 22, 26, 30), margins=(0, 0, 0, 0), within=table)
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
        fill(body, table, 8, Text(theme, kept_words(result), 14, REGULAR, "text2", wrap=True), STRETCH)

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
        row = in_line((Text(theme, name, 14, REGULAR, wrap=True), 1), margins=(0, 0, 0, 0), within=self)
        row.addWidget(Text(theme, value, 14, SEMIBOLD))
