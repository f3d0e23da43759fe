"""Camera calibration screen: set-up, capture, result."""

from __future__ import annotations

from typing import cast

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDoubleSpinBox, QStackedWidget, QWidget

from carpus.core.calibration.camera.printed_sheet import RULER_MM, Paper
from carpus.ui.kit.button import ENTER_KEY, Button
from carpus.ui.kit.card import Card, Separator, progress_bar
from carpus.ui.kit.field import ChoiceRow, ignore_wheel
from carpus.ui.kit.keys import bind_key
from carpus.ui.kit.layouts import (
    STRETCH,
    FittedWidget,
    ScrollArea,
    ScrolledColumn,
    clear_layout,
    column_layout,
    fill,
    grid_layout,
    row_layout,
    scroll_column,
)
from carpus.ui.kit.text import MEDIUM, REGULAR, SEMIBOLD, Icon, StateText, Text, heading
from carpus.ui.kit.theme import GAP_PX, MARGIN_PX, Theme
from carpus.ui.kit.translate import translate_phrase
from carpus.ui.picture.view import FrameView
from carpus.ui.shell.camera_session import CameraNameDialog
from carpus.ui.words.camera_calibration import (
    BoardChoice,
    BoardProgress,
    BoardResult,
    button_words,
    headline,
    progress_rows,
    result_rows,
    storage_words,
    view_fault_words,
)


class CameraCalibrationScreen(QWidget):
    """Three views, one at a time; the flow connects their buttons."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self.setup_view = BoardSetupView(theme)
        self.capture_view = BoardCaptureView(theme)
        self.result_view = BoardResultView(theme)
        self._view_stack = QStackedWidget()
        for part in (self.setup_view, self.capture_view, self.result_view):
            self._view_stack.addWidget(part)
        column_layout(self._view_stack, margins=(0, 0, 0, 0), parent=self)
        self.name_dialog = CameraNameDialog(self, theme)
        bind_key(self.setup_view, "report", self.setup_view.print_button.click)

    @property
    def is_setup_shown(self) -> bool:
        return self._view_stack.currentWidget() is self.setup_view

    def show_setup(self) -> None:
        self._show_view(self.setup_view)

    def show_capture(self) -> None:
        self.capture_view.reset()
        self._show_view(self.capture_view)

    def show_result(self, result: BoardResult) -> None:
        self.result_view.show_result(result)
        self._show_view(self.result_view)

    def _show_view(self, part: QWidget) -> None:
        self._view_stack.setCurrentWidget(part)
        self.initial_focus().setFocus(Qt.FocusReason.OtherFocusReason)

    def initial_focus(self) -> QWidget:
        part = self._view_stack.currentWidget()
        if part is self.capture_view:
            return self.capture_view.frame_view
        return self.result_view.initial_focus() if part is self.result_view else self.setup_view.initial_focus()


RULER_RANGE_MM = (80.0, 120.0)
COLUMN_PX = 376
MAX_WIDTH_PX = 900


class BoardSetupView(QWidget):
    """Choices before the capture."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self.paper = ChoiceRow(theme, [("a4", "A4"), ("letter", "Letter")], "a4")
        self.print_button = Button(theme, self.tr("&Print the board…"), icon="file-text")
        self.ruler_field = QDoubleSpinBox()
        ignore_wheel(self.ruler_field)
        self.ruler_field.setRange(*RULER_RANGE_MM)
        self.ruler_field.setDecimals(1)
        self.ruler_field.setSingleStep(0.5)
        self.ruler_field.setValue(RULER_MM)
        self.ruler_field.setSuffix("\N{NO-BREAK SPACE}mm")
        self.ruler_field.setAccessibleName(self.tr("Length of the printed ruler"))
        self.ruler_field.lineEdit().setTextMargins(10, 0, 10, 0)
        self.camera_text = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.start_button = Button(theme, self.tr("Start"), "primary", icon="camera", hint=ENTER_KEY)
        self._build_layout()
        theme.changed.connect(self._fit)
        self._fit()
        self.set_camera_connected(False)

    def _build_layout(self) -> None:
        theme = self._theme
        body = column_layout(gap=GAP_PX, margins=(4, 4, 12, 4))
        self._status_text = Text(theme, "", 16, REGULAR, "text2", wrap=True)
        words = self.tr(
            "Calibration takes five minutes. It measures the lens, the depth error and the alignment of depth and "
            "colour. Do it once for each camera, and again if the camera was knocked or is out of tolerance."
        )
        body.addWidget(heading(theme, self.tr("Calibrate the camera"), wrap=True))
        fill(body, Text(theme, words, 16, REGULAR, "text2", wrap=True), self._status_text)
        board = self._make_card(self.tr("1  Print the board"))
        board.body.addLayout(row_layout(self.paper, self.print_button, STRETCH, gap=12))
        words = self.tr(
            "Print at 100 % (“actual size”) on plain paper. Glue the print flat onto something stiff, such as glass "
            "or thick cardboard. Then measure the printed ruler."
        )
        board.body.addWidget(Text(theme, words, 14, REGULAR, "text2", wrap=True))
        row = row_layout(Text(theme, self.tr("Length of the printed ruler"), 14), self.ruler_field, STRETCH, gap=12)
        board.body.addLayout(row)
        body.addWidget(board)
        show = self._make_card(self.tr("2  Show it to the camera"))
        words = self.tr(
            "Use even light without reflections. The screen shows where to hold the board. Images are taken "
            "automatically when it is still, sharp and in a new position. No image is saved, and nothing changes "
            "until you confirm."
        )
        fill(show.body, Text(theme, words, 14, REGULAR, "text2", wrap=True), self.camera_text)
        show.body.addWidget(self.start_button, 0, Qt.AlignmentFlag.AlignLeft)
        fill(body, show, STRETCH)
        self._column = ScrolledColumn()
        self._column.setLayout(body)
        whole = row_layout(margins=(MARGIN_PX - 4, GAP_PX, MARGIN_PX - 8, GAP_PX), parent=self)
        self._scroll = ScrollArea(self._column)
        whole.addWidget(self._scroll, 1)

    def _make_card(self, title: str) -> Card:
        card = Card(self._theme, 24)
        card.body.setSpacing(12)
        card.body.addWidget(Text(self._theme, title, 20, SEMIBOLD))
        return card

    def _fit(self) -> None:
        self.ruler_field.setFixedWidth(self._theme.px(130))
        self._column.setMaximumWidth(self._theme.px(MAX_WIDTH_PX))

    @property
    def choice(self) -> BoardChoice:
        return BoardChoice(cast("Paper", self.paper.value()), self.ruler_field.value())

    def show_status(self, words: str) -> None:
        """Show the camera's current status."""
        self._status_text.show_text(words)

    def set_camera_connected(self, is_connected: bool) -> None:
        self.camera_text.setText(
            self.tr("The camera is connected.") if is_connected else self.tr("No camera is connected.")
        )
        self.start_button.setEnabled(is_connected)
        self.start_button.set_label(self.tr("Start") if is_connected else self.tr("Start · connect the camera"))

    def initial_focus(self) -> QWidget:
        return self.start_button if self.start_button.isEnabled() else self.print_button


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
        self.bar = progress_bar(self.tr("Progress"))
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
        self.bar.setRange(0, 0)
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
        self.bar.setRange(0, 0)

    def show_shortfall(self, words: str) -> None:
        """Show why the images are not enough; they stay."""
        self.bar.hide()
        self._shortfall = words
        self.hint.setText(words)
        self.primary_button.setEnabled(True)


class BoardResultView(QWidget):
    """Result of the calibration, to be used or repeated."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self.result: BoardResult | None = None
        self.headline_text = heading(theme, wrap=True)
        self.basis_text = Text(theme, "", 16, REGULAR, "text2", wrap=True)
        self.again_button = Button(theme, self.tr("&Repeat"), icon="rotate-ccw")
        self.use_button = Button(theme, self.tr("Use this calibration"), "primary", icon="check", hint=ENTER_KEY)
        self._table = Card(theme, 20)
        foot = row_layout(self.use_button, self.again_button, STRETCH, gap=12)
        self._column = ScrolledColumn()
        parts = (self.headline_text, self.basis_text, 12, self._table, 12, foot, STRETCH)
        column_layout(*parts, gap=2, margins=(4, 4, 12, 4), parent=self._column)
        row_layout((ScrollArea(self._column), 1), margins=(MARGIN_PX - 4, GAP_PX, MARGIN_PX - 8, GAP_PX), parent=self)
        theme.changed.connect(self._fit)
        self._fit()

    def _fit(self) -> None:
        self._column.setMaximumWidth(self._theme.px(MAX_WIDTH_PX))

    def show_result(self, result: BoardResult) -> None:
        self.result = result
        answer, basis = headline(result.calibration)
        self.headline_text.setText(answer)
        self.basis_text.setText(basis)
        self.use_button.setVisible(result.is_usable)
        body, theme = self._table.body, self._theme
        clear_layout(body)
        table = QWidget()
        grid = grid_layout(12, 8, stretches=(0, 30, 30, 40), margins=(0, 0, 0, 0), parent=table)
        for number, (state, name, value, words) in enumerate(result_rows(result.calibration)):
            if number:
                grid.addWidget(Separator(theme), 2 * number - 1, 0, 1, 4)
            cells = (
                Icon(theme, state), Text(theme, name, 16, MEDIUM, wrap=True), Text(theme, value, 16, SEMIBOLD),
                Text(theme, words, 16, REGULAR, "text2", wrap=True),
            )  # fmt: skip
            for column, cell in enumerate(cells):
                grid.addWidget(cell, 2 * number, column)
        fill(body, table, 8, Text(theme, storage_words(result), 14, REGULAR, "text2", wrap=True))

    def initial_focus(self) -> QWidget:
        return self.use_button if self.use_button.isVisibleTo(self) else self.again_button
