"""Capture of board images: frame, instruction, and what is still missing."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QWidget

from carpus.core.model.types import ByteImage
from carpus.ui.kit.button import Button
from carpus.ui.kit.card import Card
from carpus.ui.kit.layouts import STRETCH, FittedWidget, column_layout, row_layout, scroll_column
from carpus.ui.kit.progress_bar import ThinProgressBar
from carpus.ui.kit.text import REGULAR, SEMIBOLD, StateText, Text
from carpus.ui.kit.theme import GAP_PX, MARGIN_PX, Theme
from carpus.ui.kit.translate import translate_phrase
from carpus.ui.picture.view import FrameView
from carpus.ui.words.camera_calibration import BoardProgress, button_words, progress_rows, view_fault_words

COLUMN_PX = 376


class BoardCaptureView(FittedWidget):
    """Capture view; the flow connects its buttons."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme, self._shortfall = theme, ""
        self.progress: BoardProgress | None = None
        self.frame_view = FrameView(theme, (832, 624))
        self.frame_view.set_whole(True)
        self.frame_view.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.frame_count = StateText(theme)
        self.instruction = Text(theme, "", 28, SEMIBOLD, wrap=True)
        self.hint = Text(theme, "", 16, REGULAR, "text2", wrap=True)
        self._condition_texts = [StateText(theme) for _ in range(3)]
        self.primary_button = Button(theme, "", "primary")
        self.stop_button = Button(theme, self.tr("Stop"), "quiet", hint=self.tr("Esc"), height_px=40)
        self.bar = ThinProgressBar(theme, self.tr("Progress"))
        words = self.tr("Images are taken automatically when the board is still, sharp and in a new position.")
        conditions = Card(theme)
        conditions.body.addLayout(column_layout(*self._condition_texts, gap=8))
        column = column_layout(self.frame_count, self.instruction, self.hint, conditions, gap=12)
        column.addWidget(Text(theme, words, 14, REGULAR, "text2", wrap=True))
        column.addStretch(1)
        self._side_column = QWidget()
        foot = row_layout(STRETCH, self.stop_button)
        margins = (0, 0, 0, 0)
        column_layout(
            (scroll_column(column), 1),
            self.bar,
            self.primary_button,
            foot,
            gap=12,
            margins=margins,
            parent=self._side_column,
        )
        margins = (MARGIN_PX, GAP_PX, MARGIN_PX, GAP_PX)
        row_layout((self.frame_view, 1), self._side_column, gap=MARGIN_PX, margins=margins, parent=self)
        theme.changed.connect(self._fit)
        self.reset()

    def _fit(self) -> None:
        """Leave the frame at least half of the width with large text."""
        self._side_column.setFixedWidth(min(self._theme.px(COLUMN_PX), round(0.44 * max(self.width(), 640))))

    def reset(self) -> None:
        self.progress, self._shortfall = None, ""
        self.frame_view.clear(self.tr("Opening the camera…"))
        self.instruction.setText(self.tr("Please wait"))
        self.hint.setText(self.tr("Opening the camera…"))
        self.bar.show()
        self.bar.show_busy()
        self.primary_button.setEnabled(False)
        self.primary_button.set_label(button_words(None))
        self.frame_count.show_state("open", self.tr("No image yet"))
        for line in self._condition_texts:
            line.show_state("none", "")

    def show_opened(self) -> None:
        self.bar.hide()
        self.instruction.setText(self.tr("Hold the board in view"))
        self.hint.setText(self.tr("Show the whole board, facing the camera, about 60 cm away."))
        self.frame_view.setFocus(Qt.FocusReason.OtherFocusReason)

    def show_frame(self, color_rgb: ByteImage) -> None:
        self.frame_view.show_frame(color_rgb)

    def show_no_frames(self, words: str) -> None:
        """Show why the camera sends no frames; captured images stay."""
        self.frame_view.clear(words)
        self.instruction.setText(self.tr("No frames from the camera"))
        self.hint.setText(words)

    def show_progress(self, now: BoardProgress) -> None:
        self.progress = now
        views = now.judgement.view_count
        self.instruction.setText(translate_phrase(now.step) if now.step else self.tr("Enough images"))
        done = self.tr("Press “Calculate”, or add more images to improve the result.")
        self.hint.setText(
            self._shortfall or view_fault_words(now.lack) or (self.tr("Then hold it still.") if now.step else done)
        )
        words = self.tr("1 image") if views == 1 else self.tr("{count} images")
        self.frame_count.show_state("partly" if now.step else "good", words.format(count=views))
        self.primary_button.set_label(button_words(now))
        self.primary_button.setEnabled(not now.judgement.missing_view_count and not now.judgement.missing_text)
        if not now.lack:  # this picture counts
            self._shortfall = ""
        for line, row in zip(self._condition_texts, progress_rows(now.judgement), strict=True):
            line.show_state(*row)

    def show_calculating(self) -> None:
        self.instruction.setText(self.tr("Calculating…"))
        self.hint.setText(self.tr("This takes a few seconds. You can put the board down."))
        self.frame_view.setFocus(Qt.FocusReason.OtherFocusReason)  # else on the way back, where a key more would leave
        self.primary_button.setEnabled(False)
        self.bar.show()
        self.bar.show_busy()

    def show_shortfall(self, words: str) -> None:
        """Show why the images are not enough; they stay."""
        self.bar.hide()
        self._shortfall = words
        self.hint.setText(words)
        self.primary_button.setEnabled(True)
