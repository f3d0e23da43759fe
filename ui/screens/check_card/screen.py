"""Camera check screen: the frame, and the last result or an instruction."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QPainter, QPen
from PySide6.QtWidgets import QWidget

from carpus.core.calibration.card.card import CHECK_S, DISCS
from carpus.core.model.rounding import round_half_away
from carpus.ui.kit.button import ENTER_KEY, Button
from carpus.ui.kit.card import progress_bar
from carpus.ui.kit.field import ChoiceRow
from carpus.ui.kit.icons import State
from carpus.ui.kit.layouts import STRETCH, FittedWidget, column_layout, fill, row_layout, scroll_column
from carpus.ui.kit.text import REGULAR, SEMIBOLD, StateText, Text, caption
from carpus.ui.kit.theme import GAP_PX, MARGIN_PX, ON_PICTURE_PROPOSED, Theme
from carpus.ui.picture.photo import paint_label
from carpus.ui.picture.view import FrameView
from carpus.ui.shell.camera_session import CameraNameDialog
from carpus.ui.words.camera_check import CardProgress, card_hint, check_words

if TYPE_CHECKING:  # a window loads nothing that reads files
    from carpus.core.calibration.card.checks import CheckStatus

COLUMN_PX = 372


class CheckCardScreen(FittedWidget):
    """Camera check; the flow connects its buttons."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._verdict: tuple[State, str, str] = ("none", "", "")
        self.progress: CardProgress | None = None
        self.frame_view = FrameView(theme, (832, 624))
        self.frame_view.set_whole(True)
        self.frame_view.overlay = self._paint_overlay
        self.verdict = StateText(theme)
        self.instruction = Text(theme, "", 18, SEMIBOLD, wrap=True)
        self.countdown = Text(theme, "", 44, SEMIBOLD)
        self.bar = progress_bar(self.tr("Progress of the check"))
        self.check_button = Button(theme, "", "primary", icon="play", hint=ENTER_KEY)
        self.stop_button = Button(theme, self.tr("Stop"), hint=self.tr("Esc"))
        self.paper = ChoiceRow(theme, [("a4", "A4"), ("letter", "Letter")], "a4")
        self.print_button = Button(theme, self.tr("Print &card…"), icon="file-text")
        self.calibrate_button = Button(theme, self.tr("Cali&brate the camera…"))
        self._measuring_widgets: tuple[QWidget, ...] = (self.countdown, self.bar, self.stop_button)
        self._build_layout()
        self.name_dialog = CameraNameDialog(self, theme)
        theme.changed.connect(self._fit)
        self.set_camera_connected(False)
        self.end_measuring()

    def _build_layout(self) -> None:
        theme = self._theme
        column = column_layout(self.verdict, self.instruction, self.countdown, self.bar, gap=12)
        fill(column, self.check_button, self.stop_button, 12)
        card = self.tr(
            "Print both pages at 100 %: each ruler must be 100 mm long. Glue the first page flat onto stiff card. "
            "Fold the wedge and glue it onto the dashed field."
        )
        fill(column, Text(theme, card, 14, REGULAR, "text2", wrap=True))
        fill(column, row_layout(self.paper, self.print_button, gap=12), self.calibrate_button, STRETCH)
        limits = self.tr(
            "A check is valid for one week. If all lengths are wrong by the same percentage, the depth or the print "
            "size is wrong."
        )
        fill(column, caption(theme, limits, wrap=True))
        self._side = scroll_column(column)
        margins = (MARGIN_PX, GAP_PX, MARGIN_PX, GAP_PX)
        row_layout((self.frame_view, 1), self._side, gap=GAP_PX, margins=margins, parent=self)

    def _fit(self) -> None:
        self._side.setFixedWidth(min(self._theme.px(COLUMN_PX), round(0.45 * max(self.width(), 640))))

    @property
    def is_measuring(self) -> bool:
        return not self.stop_button.isHidden()

    def set_camera_connected(self, is_connected: bool) -> None:
        self.check_button.setEnabled(is_connected)
        face = self.tr("Check now, 30 seconds") if is_connected else self.tr("Check · connect the camera")
        self.check_button.set_label(face)

    def show_status(self, status: CheckStatus) -> None:
        """Show the result of the last check."""
        state, words = check_words(status)
        names = {
            "good": self.tr("Within tolerance"),
            "warn": self.tr("Check again"),
            "bad": self.tr("Out of tolerance"),
        }
        self._verdict = state, names.get(state, self.tr("Not checked yet")), words
        if not self.is_measuring:
            self._show_verdict()

    def _show_verdict(self) -> None:
        state, name, words = self._verdict
        self.verdict.show_state(state, name)
        self.instruction.setText(words)

    def begin_measuring(self) -> None:
        self._set_measuring(is_measuring=True)
        self.show_no_frames(self.tr("Opening the camera…"))
        self.show_progress(None)

    def end_measuring(self) -> None:
        self._set_measuring(is_measuring=False)
        self.frame_view.clear(card_hint(None))
        self._show_verdict()

    def _set_measuring(self, *, is_measuring: bool) -> None:
        for shown, widgets in (
            (is_measuring, self._measuring_widgets),
            (not is_measuring, (self.check_button, self.verdict)),
        ):
            for widget in widgets:
                widget.setVisible(shown)
        self.progress = None
        if self.isVisible():
            self.initial_focus().setFocus(Qt.FocusReason.OtherFocusReason)

    def show_no_frames(self, words: str) -> None:
        self.frame_view.clear(words)
        self.instruction.setText(words)

    def show_progress(self, now: CardProgress | None) -> None:
        """Show the progress; None before the first frame."""
        self.progress = now
        seconds = 0.0 if now is None else now.seconds
        self.countdown.setText(self.tr("{seconds} s").format(seconds=max(round_half_away(CHECK_S - seconds), 0)))
        self.bar.setRange(0, round(10 * CHECK_S))
        self.bar.setValue(round(10 * min(seconds, CHECK_S)))
        self.instruction.setText(card_hint(now))
        self.frame_view.update()

    def initial_focus(self) -> QWidget:
        if self.is_measuring:
            return self.stop_button
        return self.check_button if self.check_button.isEnabled() else self.print_button

    def _paint_overlay(self, painter: QPainter, view: FrameView) -> None:
        """Draw a ring and a letter at each disc of the card."""
        if self.progress is None or self.progress.disc_px is None:
            return
        for letter, (u, v) in zip(DISCS, self.progress.disc_px.tolist(), strict=True):
            at = view.to_screen(u, v)
            painter.setBrush(Qt.BrushStyle.NoBrush)
            for color, width in ((QColor(0, 0, 0, 150), 4.0), (QColor(ON_PICTURE_PROPOSED), 2.0)):
                painter.setPen(QPen(color, width))
                painter.drawEllipse(at, 12.0, 12.0)
            paint_label(painter, self._theme, letter, at.x() + 12.0, at.y() - 26.0)
