"""Before the board is shown: which board, on which paper, printed and measured; which camera."""

from __future__ import annotations

from typing import cast

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QDoubleSpinBox, QHBoxLayout, QVBoxLayout, QWidget

from carpus.core.calibration.camera.board import Pattern
from carpus.core.calibration.camera.sheet import RULER_MM, Paper
from carpus.ui.camera_calibration.values import BoardChoice
from carpus.ui.controls.button import ENTER, Button
from carpus.ui.controls.card import Card
from carpus.ui.controls.field import Choices
from carpus.ui.controls.layouts import ScrolledColumn, scroll_area
from carpus.ui.controls.text import REGULAR, SEMIBOLD, Text, caption, heading
from carpus.ui.theme import GAP_PX, MARGIN_PX, Theme

RULER_RANGE_MM = (80.0, 120.0)
MOST_WIDE_PX = 900


class BoardBeginning(QWidget):
    """``begun`` and ``printed`` carry the :class:`BoardChoice`."""

    begun = Signal(object)
    printed = Signal(object)

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
        self.print_button.clicked.connect(lambda: self.printed.emit(self.choice))
        self.begin_button.clicked.connect(lambda: self.begun.emit(self.choice))
        self.camera.chosen.connect(lambda _: self._show_camera())
        self._camera_there = False
        theme.changed.connect(self._fit)
        self._fit()
        self.show_standing("", camera_there=False)

    def _lay_out(self) -> None:
        theme = self._theme
        body = QVBoxLayout()
        body.setContentsMargins(4, 4, 12, 4)
        body.setSpacing(GAP_PX)
        self._now = Text(theme, "", 16, REGULAR, "text2", wrap=True)
        words = self.tr(
            "Five minutes: how the lens sees, how far off the depth is, and whether depth lies on colour. Do it once "
            "for each camera, after a knock, and when the check card says so."
        )
        body.addWidget(heading(theme, self.tr("Calibrate the camera"), wrap=True))
        body.addWidget(Text(theme, words, 16, REGULAR, "text2", wrap=True))
        body.addWidget(self._now)
        board = self._card(self.tr("1  Print the board"))
        board.body.addWidget(self.pattern)
        row = QHBoxLayout()
        row.setSpacing(12)
        row.addWidget(self.paper)
        row.addWidget(self.print_button)
        row.addStretch(1)
        board.body.addLayout(row)
        words = self.tr(
            "Print at 100 % (“actual size”) on plain paper and glue it flat onto something stiff, such as glass or a "
            "thick board. Then measure the ruler under it."
        )
        board.body.addWidget(Text(theme, words, 14, REGULAR, "text2", wrap=True))
        row = QHBoxLayout()
        row.setSpacing(12)
        row.addWidget(Text(theme, self.tr("The ruler on the print measures"), 14))
        row.addWidget(self.ruler)
        row.addStretch(1)
        board.body.addLayout(row)
        body.addWidget(board)
        show = self._card(self.tr("2  Show it to the camera"))
        words = self.tr(
            "Even light, no reflections. The screen says where to hold the board; pictures are taken by themselves "
            "when it is still, sharp and in a new place. Nothing is changed before you say so."
        )
        show.body.addWidget(Text(theme, words, 14, REGULAR, "text2", wrap=True))
        show.body.addWidget(self.camera)
        show.body.addWidget(self.camera_words)
        show.body.addWidget(self.begin_button, 0, Qt.AlignmentFlag.AlignLeft)
        body.addWidget(show)
        body.addWidget(caption(theme, self.tr("No picture of the board is stored."), wrap=True))
        body.addStretch(1)
        self._host = ScrolledColumn()
        self._host.setLayout(body)
        whole = QHBoxLayout(self)
        whole.setContentsMargins(MARGIN_PX - 4, GAP_PX, MARGIN_PX - 8, GAP_PX)
        self._scroll = scroll_area(self._host)
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
        """What is known of the camera today, and whether one is plugged in."""
        self._now.setText(words)
        self._now.setVisible(bool(words))
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
