"""Calibrating the camera with a printed board: before it is shown, while it is shown, and the result."""

from __future__ import annotations

from typing import cast

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDoubleSpinBox, QStackedWidget, QWidget

from carpus.core.calibration.camera.board import Pattern
from carpus.core.calibration.camera.sheet import RULER_MM, Paper
from carpus.ui.camera_calibration.showing import BoardShowing
from carpus.ui.camera_name_sheet import CameraNameSheet
from carpus.ui.controls.button import ENTER, Button
from carpus.ui.controls.card import Card, Line
from carpus.ui.controls.field import Choices, leave_wheel
from carpus.ui.controls.layouts import (
    STRETCH,
    ScrollArea,
    ScrolledColumn,
    empty,
    fill,
    in_column,
    in_grid,
    in_line,
)
from carpus.ui.controls.text import MEDIUM, REGULAR, SEMIBOLD, Sign, Text, heading
from carpus.ui.keys import bind
from carpus.ui.theme import GAP_PX, MARGIN_PX, Theme
from carpus.ui.words.camera_calibration import BoardChoice, BoardResult, headline, kept_words, result_rows


class BoardScreen(QWidget):
    """Three parts, one at a time; what their buttons do is the flow's affair."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self.beginning = BoardBeginning(theme)
        self.showing = BoardShowing(theme)
        self.result = BoardResultView(theme)
        self._parts = QStackedWidget()
        for part in (self.beginning, self.showing, self.result):
            self._parts.addWidget(part)
        in_column(self._parts, margins=(0, 0, 0, 0), within=self)
        self.name_sheet = CameraNameSheet(self, theme)
        bind(self.beginning, "report", self.beginning.print_button.click)

    @property
    def is_beginning(self) -> bool:
        return self._parts.currentWidget() is self.beginning

    def show_beginning(self) -> None:
        self._show(self.beginning)

    def show_showing(self) -> None:
        self.showing.begin()
        self._show(self.showing)

    def show_result(self, result: BoardResult) -> None:
        self.result.show_result(result)
        self._show(self.result)

    def _show(self, part: QWidget) -> None:
        self._parts.setCurrentWidget(part)
        self.first().setFocus(Qt.FocusReason.OtherFocusReason)

    def first(self) -> QWidget:
        part = self._parts.currentWidget()
        if part is self.showing:
            return self.showing.picture
        return self.result.first() if part is self.result else self.beginning.first()


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
        self.camera_words = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.begin_button = Button(theme, self.tr("Begin"), "primary", icon="camera", hint=ENTER)
        self._lay_out()
        theme.changed.connect(self._fit)
        self._fit()
        self.set_camera_there(False)

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
            "when it is still, sharp and in a new place. No picture of the board is stored, and nothing is changed "
            "before you say so."
        )
        fill(show.body, Text(theme, words, 14, REGULAR, "text2", wrap=True), self.camera_words)
        show.body.addWidget(self.begin_button, 0, Qt.AlignmentFlag.AlignLeft)
        fill(body, show, STRETCH)
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
        )

    def show_status(self, words: str) -> None:
        """What is known of the camera so far."""
        self._now.say(words)

    def set_camera_there(self, there: bool) -> None:
        self.camera_words.setText(self.tr("It is plugged in.") if there else self.tr("No camera is plugged in."))
        self.begin_button.setEnabled(there)
        self.begin_button.set_face(self.tr("Begin") if there else self.tr("Begin · plug the camera in"))

    def first(self) -> QWidget:
        return self.begin_button if self.begin_button.isEnabled() else self.print_button


class BoardResultView(QWidget):
    """What was found, to be used or made again."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self.result: BoardResult | None = None
        self.answer = heading(theme, wrap=True)
        self.basis = Text(theme, "", 16, REGULAR, "text2", wrap=True)
        self.again_button = Button(theme, self.tr("Take &again"), icon="rotate-ccw")
        self.use_button = Button(theme, self.tr("Use this calibration"), "primary", icon="check", hint=ENTER)
        self._table = Card(theme, 20)
        foot = in_line(self.use_button, self.again_button, STRETCH, gap=12)
        self._column = ScrolledColumn()
        parts = (self.answer, self.basis, 12, self._table, 12, foot, STRETCH)
        in_column(*parts, gap=2, margins=(4, 4, 12, 4), within=self._column)
        in_line((ScrollArea(self._column), 1), margins=(MARGIN_PX - 4, GAP_PX, MARGIN_PX - 8, GAP_PX), within=self)
        theme.changed.connect(self._fit)
        self._fit()

    def _fit(self) -> None:
        self._column.setMaximumWidth(self._theme.px(MOST_WIDE_PX))

    def show_result(self, result: BoardResult) -> None:
        self.result = result
        answer, basis = headline(result.made)
        self.answer.setText(answer)
        self.basis.setText(basis)
        self.use_button.setVisible(result.is_usable)
        body, theme = self._table.body, self._theme
        empty(body)
        table = QWidget()
        grid = in_grid(12, 8, shares=(0, 30, 30, 40), margins=(0, 0, 0, 0), within=table)
        for number, (state, name, value, words) in enumerate(result_rows(result.made)):
            if number:
                grid.addWidget(Line(theme), 2 * number - 1, 0, 1, 4)
            cells = (
                Sign(theme, state), Text(theme, name, 16, MEDIUM, wrap=True), Text(theme, value, 16, SEMIBOLD),
                Text(theme, words, 16, REGULAR, "text2", wrap=True),
            )  # fmt: skip
            for column, cell in enumerate(cells):
                grid.addWidget(cell, 2 * number, column)
        fill(body, table, 8, Text(theme, kept_words(result), 14, REGULAR, "text2", wrap=True))

    def first(self) -> QWidget:
        return self.use_button if self.use_button.isVisibleTo(self) else self.again_button
