"""The board is shown: large picture, one instruction, what is there and what is missing."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QWidget

from carpus.core.types import ByteImage
from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Card
from carpus.ui.controls.layouts import STRETCH, Fitted, in_column, in_line, scrolled
from carpus.ui.controls.progress_bar import ThinBar
from carpus.ui.controls.text import REGULAR, SEMIBOLD, StateText, Text
from carpus.ui.picture.view import PictureView
from carpus.ui.theme import GAP_PX, MARGIN_PX, Theme
from carpus.ui.translate import say
from carpus.ui.words.camera_calibration import BoardProgress, lack_words, there_rows, to_go_words

COLUMN_PX = 376


class BoardShowing(Fitted):
    """What its buttons do is the flow's affair."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme, self._note = theme, ""
        self.progress: BoardProgress | None = None
        self.picture = PictureView(theme, (832, 624))
        self.picture.show_whole(True)
        self.picture.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.count = StateText(theme)
        self.what = Text(theme, "", 28, SEMIBOLD, wrap=True)
        self.how = Text(theme, "", 16, REGULAR, "text2", wrap=True)
        self._there = [StateText(theme) for _ in range(3)]
        self.primary = Button(theme, "", "primary")
        self.leave_button = Button(theme, self.tr("Stop"), "quiet", hint=self.tr("Esc"), height_px=40)
        self.bar = ThinBar(theme, self.tr("How far it is"))
        words = self.tr("Pictures are taken by themselves when the board is still, sharp and in a new place.")
        there = Card(theme)
        in_there = in_column(*self._there, gap=8)
        there.body.addLayout(in_there)
        column = in_column(self.count, self.what, self.how, there, gap=12)
        column.addWidget(Text(theme, words, 14, REGULAR, "text2", wrap=True))
        column.addStretch(1)
        self._right = QWidget()
        foot = in_line(STRETCH, self.leave_button)
        margins = (0, 0, 0, 0)
        in_column((scrolled(column), 1), self.bar, self.primary, foot, gap=12, margins=margins, within=self._right)
        margins = (MARGIN_PX, GAP_PX, MARGIN_PX, GAP_PX)
        in_line((self.picture, 1), self._right, gap=MARGIN_PX, margins=margins, within=self)
        theme.changed.connect(self._fit)
        self.begin()

    def _fit(self) -> None:
        """Large text must leave the picture its half."""
        self._right.setFixedWidth(min(self._theme.px(COLUMN_PX), round(0.44 * max(self.width(), 640))))

    def begin(self) -> None:
        self.progress, self._note = None, ""
        self.picture.clear(self.tr("The camera is being opened."))
        self.what.setText(self.tr("One moment"))
        self.how.setText(self.tr("The camera is being opened."))
        self.bar.show()
        self.bar.begin()
        self.primary.setEnabled(False)
        self.primary.set_face(to_go_words(None))
        self.count.show_state("open", self.tr("No picture yet"))
        for line in self._there:
            line.show_state("none", "")

    def opened(self) -> None:
        self.bar.hide()
        self.what.setText(self.tr("Hold the board in the picture"))
        self.how.setText(self.tr("All of it, flat towards the camera, about 60 cm away."))
        self.picture.setFocus(Qt.FocusReason.OtherFocusReason)

    def show_frame(self, color_rgb: ByteImage) -> None:
        self.picture.show_frame(color_rgb)

    def show_lost(self, words: str) -> None:
        """The camera sends nothing: why, and what to do; what was taken stays."""
        self.picture.clear(words)
        self.what.setText(self.tr("No pictures from the camera"))
        self.how.setText(words)

    def show_progress(self, now: BoardProgress) -> None:
        self.progress = now
        views = now.judgement.views
        self.what.setText(say(now.step) if now.step else self.tr("That is enough"))
        done = self.tr("Press “Work out”, or show more: it only gets better.")
        self.how.setText(self._note or lack_words(now.lack) or (self.tr("Then hold still.") if now.step else done))
        words = self.tr("1 picture") if views == 1 else self.tr("{count} pictures")
        self.count.show_state("partly" if now.step else "good", words.format(count=views))
        self.primary.set_face(to_go_words(now))
        self.primary.setEnabled(views >= now.asked and not now.judgement.missing)
        if not now.lack:  # this picture counts
            self._note = ""
        for line, row in zip(self._there, there_rows(now.judgement), strict=True):
            line.show_state(*row)

    def work(self) -> None:
        self.what.setText(self.tr("Working it out"))
        self.how.setText(self.tr("A few seconds; put the board down."))
        self.picture.setFocus(Qt.FocusReason.OtherFocusReason)  # else on the way back, where a key more would leave
        self.primary.setEnabled(False)
        self.bar.show()
        self.bar.begin()

    def more(self, words: str) -> None:
        """It was not enough: why, in words; the pictures so far stay."""
        self.bar.hide()
        self._note = words
        self.how.setText(words)
        self.primary.setEnabled(True)
