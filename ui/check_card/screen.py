"""The check card: one glance says whether the camera measures right; half a minute of looking adds a check."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QPainter
from PySide6.QtWidgets import QBoxLayout, QStackedWidget, QWidget

from carpus.core.calibration.card.card import CHECK_S
from carpus.core.types import ByteImage
from carpus.ui.camera_calibration.name_sheet import CameraNameSheet
from carpus.ui.camera_calibration.overlay import paint_discs
from carpus.ui.controls.button import ENTER, Button
from carpus.ui.controls.card import Card, Line
from carpus.ui.controls.field import Choices
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
    scrolled,
)
from carpus.ui.controls.progress_bar import ThinBar
from carpus.ui.controls.text import MEDIUM, REGULAR, SEMIBOLD, Sign, Text, caption, heading
from carpus.ui.keys import Keys, bind
from carpus.ui.picture.photo import label_size, paint_label
from carpus.ui.picture.view import PictureView
from carpus.ui.plot.control_view import ControlCharts
from carpus.ui.theme import GAP_PX, MARGIN_PX, Theme
from carpus.ui.translate import tr
from carpus.ui.words.check_card import CameraChecks, CardProgress, cause_words, check_day, figure_rows, headline, hint

COLUMN_PX = 352
MOST_PX = 16777215
"""Qt's own greatest width."""


class CardScreen(Fitted):
    """``turned`` when another camera's checks are shown; what its buttons do is the flow's affair."""

    turned = Signal()

    def __init__(self, theme: Theme, keys: Keys) -> None:
        super().__init__()
        self._theme = theme
        self.checks = CameraChecks("", "")
        self.progress: CardProgress | None = None
        self._camera_there = False
        self.overview, self.measuring = QWidget(), QWidget()
        self.camera = Choices(theme, [(False, self.tr("The camera")), (True, self.tr("Simulated camera"))], False)
        self.answer = heading(theme, wrap=True)
        self.basis = Text(theme, "", 16, REGULAR, "text2", wrap=True)
        self.check_button = Button(theme, "", "primary", icon="play", hint=ENTER)
        self.charts = ControlCharts(theme)
        self._figures, self._out = Card(theme, 16), _what_to_do(theme)
        self.paper = Choices(theme, [("a4", "A4"), ("letter", "Letter")], "a4")
        self.print_button = Button(theme, self.tr("Print &card…"), icon="file-text")
        self.page_button = Button(theme, self.tr("One page…"), hint="Ctrl+P")
        self.calibrate_button = Button(theme, self.tr("Cali&brate the camera…"))
        self.picture = PictureView(theme, (832, 624))
        self.picture.show_whole(True)
        self.picture.overlay = self._paint_over
        self.left_s = Text(theme, "", 44, SEMIBOLD)
        self.hint = Text(theme, "", 20, SEMIBOLD, wrap=True)
        self.bar = ThinBar(theme, self.tr("How far the check is"))
        self.leave_button = Button(theme, self.tr("Stop"), hint=self.tr("Esc"))
        self._parts = QStackedWidget()
        self._lay_out_overview()
        self._lay_out_measuring()
        for part in (self.overview, self.measuring):
            self._parts.addWidget(part)
        in_column(self._parts, margins=(0, 0, 0, 0), within=self)
        self.name_sheet = CameraNameSheet(self, theme)
        bind(self.overview, keys, "report", self.page_button.click)
        theme.changed.connect(self._fit)
        self.show_checks(self.checks)

    def _lay_out_overview(self) -> None:
        theme = self._theme
        texts = in_column(self.answer, self.basis, gap=2)
        head = in_line((texts, 1), (self.check_button, 0, Qt.AlignmentFlag.AlignTop), gap=GAP_PX)
        right = in_column(self._figures, self._out, gap=12)
        row = in_line(self.paper, self.print_button, gap=12)
        fill(right, row, self.page_button, self.calibrate_button)
        words = self.tr("Usual: mean of the first 7 checks after a calibration, + 3 sd. Limits are fixed.")
        fill(right, caption(theme, words, wrap=True), STRETCH)
        self._side_scroll = scrolled(right)
        host = ScrolledColumn()
        self._columns = QBoxLayout(QBoxLayout.Direction.LeftToRight, host)
        self._columns.setContentsMargins(0, 0, 8, 0)
        self._columns.setSpacing(GAP_PX)
        fill(self._columns, (self.charts, 1), self._side_scroll)
        whole = in_column(
            self.camera, head, gap=12, margins=(MARGIN_PX, GAP_PX - 4, MARGIN_PX - 8, GAP_PX), within=self.overview
        )
        whole.addWidget(ScrollArea(host), 1)

    def _lay_out_measuring(self) -> None:
        theme = self._theme
        column = in_column(
            Text(theme, self.tr("Checking"), 28, SEMIBOLD), self.left_s, self.bar, gap=12, margins=(0, 0, 0, 0)
        )
        column.addWidget(self.hint)
        words = self.tr("Its ruler must be 100 mm long, the wedge glued onto the dashed field. Nothing is held.")
        fill(column, Text(theme, words, 14, REGULAR, "text2", wrap=True), STRETCH, self.leave_button)
        self._side = QWidget()
        self._side.setLayout(column)
        whole = in_line(
            (self.picture, 1), gap=MARGIN_PX, margins=(MARGIN_PX, GAP_PX, MARGIN_PX, GAP_PX), within=self.measuring
        )
        whole.addWidget(self._side)

    def _fit(self) -> None:
        scale = self._theme.text_scale
        narrow = self.width() < 1000 * scale
        directions = QBoxLayout.Direction
        self._columns.setDirection(directions.TopToBottom if narrow else directions.LeftToRight)
        wide = self._theme.px(COLUMN_PX)
        # Beside the charts the column scrolls by itself; under them the whole page does.
        side = self._side_scroll.widget()
        assert side is not None
        self._side_scroll.setMaximumWidth(MOST_PX if narrow else wide)
        self._side_scroll.setMinimumWidth(0 if narrow else wide)
        across = max(self.width() - 2 * MARGIN_PX, 1)
        self._side_scroll.setMinimumHeight(max(side.heightForWidth(across), side.sizeHint().height()) if narrow else 0)
        self._side.setFixedWidth(min(wide, round(0.4 * max(self.width(), 640))))

    # --- states -------------------------------------------------------------------------------------------
    @property
    def is_measuring(self) -> bool:
        return self._parts.currentWidget() is self.measuring

    @property
    def shows_simulated(self) -> bool:
        return self.checks.simulated

    def set_camera_there(self, there: bool) -> None:
        self._camera_there = there
        self._show_button()

    def show_checks(self, checks: CameraChecks) -> None:
        self.checks = checks
        self.camera.choose(checks.simulated)
        answer, basis = headline(checks)
        self.answer.setText(answer)
        self.basis.setText(basis)
        empty = self.tr("Each check is a point here: a camera that drifts is seen before it is out.")
        self.charts.show_checks(checks.checks, empty)
        self.page_button.setEnabled(checks.newest is not None)
        self._show_button()
        self._fill_figures()
        is_out = checks.verdict == "out" and not checks.recalibrated
        self._out.set_colors("surface", "bad" if is_out else "line", 2.0 if is_out else 1.0)
        self._show(self.overview)
        self.turned.emit()

    def _show_button(self) -> None:
        ready = self.checks.simulated or self._camera_there
        again = self.checks.verdict in ("out", "unusual") and not self.checks.recalibrated
        words = self.tr("Check once more") if again else self.tr("Check now, 30 seconds")
        self.check_button.setEnabled(ready)
        self.check_button.set_face(words if ready else self.tr("Check · plug the camera in"))

    def begin_measuring(self) -> None:
        self.progress = None
        self.picture.clear(self.tr("The camera is being opened."))
        self.left_s.setText(self.tr("{seconds} s").format(seconds=round(CHECK_S)))
        self.hint.setText(self.tr("The camera is being opened."))
        self.bar.begin()
        self._show(self.measuring)

    def show_frame(self, color_rgb: ByteImage) -> None:
        self.picture.show_frame(color_rgb)

    def show_lost(self, words: str) -> None:
        self.picture.clear(words)
        self.hint.setText(words)

    def show_progress(self, now: CardProgress | None) -> None:
        """What the newest picture showed; None while nothing has been looked at."""
        self.progress = now
        seconds = 0.0 if now is None else now.seconds
        self.left_s.setText(self.tr("{seconds} s").format(seconds=max(round(CHECK_S - seconds), 0)))
        self.bar.show_progress(round(10 * min(seconds, CHECK_S)), round(10 * CHECK_S))
        self.hint.setText(hint(now))
        self.picture.update()

    def _show(self, part: QWidget) -> None:
        changed = self._parts.currentWidget() is not part
        self._parts.setCurrentWidget(part)
        if changed and self.isVisible():
            self.first().setFocus(Qt.FocusReason.OtherFocusReason)

    def first(self) -> QWidget:
        if self.is_measuring:
            return self.leave_button
        return self.check_button if self.check_button.isEnabled() else self.print_button

    def _fill_figures(self) -> None:
        body, theme, last = self._figures.body, self._theme, self.checks.newest
        empty(body)
        self._figures.setVisible(last is not None)
        if last is None:
            return
        title = Text(theme, check_day(last), 16, SEMIBOLD, wrap=True)
        body.addWidget(title)
        table = QWidget()
        grid = in_grid(8, 3, shares=(0, 46, 32, 22), margins=(0, 0, 0, 0), within=table)
        right = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        for column, words in enumerate((self.tr("On the card"), self.tr("Measured"), self.tr("Off by")), 1):
            grid.addWidget(caption(theme, words), 0, column, right if column > 1 else Qt.AlignmentFlag.AlignLeft)
        for number, (state, name, measured, off) in enumerate(figure_rows(last), 1):
            row = 2 * number
            grid.addWidget(Line(theme), row - 1, 0, 1, 4)
            grid.addWidget(Sign(theme, state), row, 0)
            grid.addWidget(Text(theme, name, 14, wrap=True), row, 1)
            grid.addWidget(Text(theme, measured, 14), row, 2, right)
            grid.addWidget(Text(theme, off, 14, SEMIBOLD), row, 3, right)
        body.addWidget(table)
        body.addWidget(caption(theme, cause_words(self.checks), wrap=True))

    def _paint_over(self, painter: QPainter, view: PictureView) -> None:
        if self.checks.simulated:
            words = self.tr("Simulated camera and card")
            left = view.width() - label_size(self._theme, words).width() - 12.0
            paint_label(painter, self._theme, words, left, 12.0)
        now = self.progress
        if now is not None and now.pixel is not None:
            paint_discs(painter, view, self._theme, now.pixel)


def _what_to_do(theme: Theme) -> Card:
    """Where a camera is out."""
    card = Card(theme, 16)
    card.body.addWidget(Text(theme, tr("If it is out"), 16, SEMIBOLD))
    steps = (
        (tr("Check once more"), tr("card flat, 60 cm away, its ruler 100 mm long")),
        (tr("Calibrate the camera again"), tr("with the board, five minutes")),
        (tr("Still out: do not measure"), tr("sessions near this check say that they are not sure")),
    )
    for number, (what, how) in enumerate(steps, 1):
        fill(card.body, Text(theme, f"{number}  {what}", 14, MEDIUM, wrap=True), caption(theme, how, wrap=True))
    return card
