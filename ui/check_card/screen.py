"""The check card: the camera’s picture, and beside it the verdict of the last check or what to do with the card."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QPainter, QPen
from PySide6.QtWidgets import QWidget

from carpus.core.calibration.card.card import CHECK_S, DISCS
from carpus.core.rounding import rounded
from carpus.core.types import ByteImage
from carpus.ui.camera_name_sheet import CameraNameSheet
from carpus.ui.controls.button import ENTER, Button
from carpus.ui.controls.field import Choices
from carpus.ui.controls.layouts import STRETCH, Fitted, fill, in_column, in_line, scrolled
from carpus.ui.controls.progress_bar import ThinBar
from carpus.ui.controls.text import REGULAR, SEMIBOLD, StateText, Text, caption
from carpus.ui.icons import State
from carpus.ui.picture.photo import paint_label
from carpus.ui.picture.view import PictureView
from carpus.ui.theme import GAP_PX, MARGIN_PX, ON_PICTURE_PROPOSED, Theme
from carpus.ui.words.camera_check import CardProgress, card_hint, check_words

if TYPE_CHECKING:  # a window loads nothing that reads files
    from carpus.core.calibration.card.checks import CheckStatus

COLUMN_PX = 372


class CardScreen(Fitted):
    """What its buttons do is the flow's affair."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._verdict: tuple[State, str, str] = ("none", "", "")
        self.progress: CardProgress | None = None
        self.picture = PictureView(theme, (832, 624))
        self.picture.show_whole(True)
        self.picture.overlay = self._paint_over
        self.verdict = StateText(theme)
        self.words = Text(theme, "", 18, SEMIBOLD, wrap=True)
        self.left_s = Text(theme, "", 44, SEMIBOLD)
        self.bar = ThinBar(theme, self.tr("How far the check is"))
        self.check_button = Button(theme, "", "primary", icon="play", hint=ENTER)
        self.stop_button = Button(theme, self.tr("Stop"), hint=self.tr("Esc"))
        self.paper = Choices(theme, [("a4", "A4"), ("letter", "Letter")], "a4")
        self.print_button = Button(theme, self.tr("Print &card…"), icon="file-text")
        self.calibrate_button = Button(theme, self.tr("Cali&brate the camera…"))
        self._of_check: tuple[QWidget, ...] = (self.left_s, self.bar, self.stop_button)
        self._lay_out()
        self.name_sheet = CameraNameSheet(self, theme)
        theme.changed.connect(self._fit)
        self.set_camera_there(False)
        self.end_measuring()

    def _lay_out(self) -> None:
        theme = self._theme
        column = in_column(self.verdict, self.words, self.left_s, self.bar, gap=12)
        fill(column, self.check_button, self.stop_button, 12)
        card = self.tr(
            "Print both pages at 100 %: each ruler must be 100 mm long. Glue the first flat onto stiff card, fold the "
            "wedge and glue it onto the dashed field."
        )
        fill(column, Text(theme, card, 14, REGULAR, "text2", wrap=True))
        fill(column, in_line(self.paper, self.print_button, gap=12), self.calibrate_button, STRETCH)
        limits = self.tr("A check is good for a week. All lengths off by one share: the depth, or the print’s size.")
        fill(column, caption(theme, limits, wrap=True))
        self._side = scrolled(column)
        margins = (MARGIN_PX, GAP_PX, MARGIN_PX, GAP_PX)
        in_line((self.picture, 1), self._side, gap=GAP_PX, margins=margins, within=self)

    def _fit(self) -> None:
        self._side.setFixedWidth(min(self._theme.px(COLUMN_PX), round(0.45 * max(self.width(), 640))))

    @property
    def is_measuring(self) -> bool:
        return not self.stop_button.isHidden()

    def set_camera_there(self, there: bool) -> None:
        self.check_button.setEnabled(there)
        face = self.tr("Check now, 30 seconds") if there else self.tr("Check · plug the camera in")
        self.check_button.set_face(face)

    def show_status(self, status: CheckStatus) -> None:
        """What the last check said."""
        state, words = check_words(status)
        names = {"good": self.tr("Right"), "warn": self.tr("Check it again"), "bad": self.tr("Out")}
        self._verdict = state, names.get(state, self.tr("Not checked yet")), words
        if not self.is_measuring:
            self._show_verdict()

    def _show_verdict(self) -> None:
        state, name, words = self._verdict
        self.verdict.show_state(state, name)
        self.words.setText(words)

    def begin_measuring(self) -> None:
        self._turn(measuring=True)
        self.show_lost(self.tr("The camera is being opened."))
        self.show_progress(None)

    def end_measuring(self) -> None:
        self._turn(measuring=False)
        self.picture.clear(card_hint(None))
        self._show_verdict()

    def _turn(self, *, measuring: bool) -> None:
        for shown, widgets in ((measuring, self._of_check), (not measuring, (self.check_button, self.verdict))):
            for widget in widgets:
                widget.setVisible(shown)
        self.progress = None
        if self.isVisible():
            self.first().setFocus(Qt.FocusReason.OtherFocusReason)

    def show_frame(self, color_rgb: ByteImage) -> None:
        self.picture.show_frame(color_rgb)

    def show_lost(self, words: str) -> None:
        self.picture.clear(words)
        self.words.setText(words)

    def show_progress(self, now: CardProgress | None) -> None:
        """What the newest picture showed; None while nothing has been looked at."""
        self.progress = now
        seconds = 0.0 if now is None else now.seconds
        self.left_s.setText(self.tr("{seconds} s").format(seconds=max(rounded(CHECK_S - seconds), 0)))
        self.bar.show_progress(round(10 * min(seconds, CHECK_S)), round(10 * CHECK_S))
        self.words.setText(card_hint(now))
        self.picture.update()

    def first(self) -> QWidget:
        if self.is_measuring:
            return self.stop_button
        return self.check_button if self.check_button.isEnabled() else self.print_button

    def _paint_over(self, painter: QPainter, view: PictureView) -> None:
        """A ring and a letter at each disc."""
        if self.progress is None or self.progress.pixel is None:
            return
        for letter, (u, v) in zip(DISCS, self.progress.pixel.tolist(), strict=True):
            at = view.to_screen(u, v)
            painter.setBrush(Qt.BrushStyle.NoBrush)
            for color, width in ((QColor(0, 0, 0, 150), 4.0), (QColor(ON_PICTURE_PROPOSED), 2.0)):
                painter.setPen(QPen(color, width))
                painter.drawEllipse(at, 12.0, 12.0)
            paint_label(painter, self._theme, letter, at.x() + 12.0, at.y() - 26.0)
