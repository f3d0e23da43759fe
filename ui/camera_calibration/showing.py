"""The board is shown: large picture, one instruction, where the board has been, what is there and what is missing."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QPainter
from PySide6.QtWidgets import QGridLayout, QWidget

from carpus.core.types import Frame
from carpus.ui.camera_calibration.maps import FieldMap
from carpus.ui.camera_calibration.overlay import paint_corners, paint_target
from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Card, KeyCaps, Line
from carpus.ui.controls.layouts import STRETCH, Fitted, fill, in_column, in_line, scrolled
from carpus.ui.controls.progress_bar import ThinBar
from carpus.ui.controls.text import MEDIUM, REGULAR, SEMIBOLD, StateText, Text, caption
from carpus.ui.keys import Keys, bind
from carpus.ui.picture.photo import label_size, paint_label
from carpus.ui.picture.view import PictureView
from carpus.ui.theme import GAP_PX, MARGIN_PX, Theme
from carpus.ui.words.camera_calibration import (
    BoardProgress,
    Row,
    check_rows,
    lack_words,
    side_name,
    step_words,
    to_go_words,
)

COLUMN_PX = 376
EMPTY: Row = ("open", "", "", "")
RINGS_LAST_S = 0.6
"""A picture that was looked at longer ago gives way to the newest one, without rings: the search for corners takes its
time where there are none."""
CHECKS = 5
"""Rows of what is there and what is missing."""


class BoardShowing(Fitted):
    """``take`` a picture by hand, ``undo`` the last one."""

    take = Signal()
    undo = Signal()

    def __init__(self, theme: Theme, keys: Keys) -> None:
        super().__init__()
        self._theme = theme
        self.progress: BoardProgress | None = None
        self.simulated = False
        self.has_rings = False
        self._note = ""
        self.picture = PictureView(theme, (832, 624))
        self.picture.show_whole(True)
        self.picture.overlay = self._paint_over
        self.picture.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.count = StateText(theme)
        self.what = Text(theme, "", 28, SEMIBOLD, wrap=True)
        self.how = Text(theme, "", 16, REGULAR, "text2", wrap=True)
        self.fields = FieldMap(theme)
        self._field_count = Text(theme, "", 14, SEMIBOLD)
        self._grid = QGridLayout()
        self.primary = Button(theme, "", "primary")
        self.undo_button = Button(theme, self.tr("Undo"), "quiet", hint=keys["undo"], height_px=40)
        self.leave_button = Button(theme, self.tr("Stop"), "quiet", hint=self.tr("Esc"), height_px=40)
        self.bar = ThinBar(theme, self.tr("How far it is"))
        self._keys = KeyCaps(theme, [(keys["accept"], self.tr("take this picture")), (keys["undo"], self.tr("undo"))])
        self._lay_out()
        self.undo_button.clicked.connect(self.undo)
        bind(self.picture, keys, "accept", self.take.emit)
        bind(self, keys, "undo", self.undo.emit)
        theme.changed.connect(self._fit)
        self.begin()

    def _lay_out(self) -> None:
        theme = self._theme
        words = self.tr("Pictures are taken by themselves when the board is still, sharp and in a new place.")
        self._by_itself = Text(theme, words, 14, REGULAR, "text2", wrap=True)
        foot = in_line(self._keys, STRETCH, self.undo_button, self.leave_button, gap=12)
        left = in_column((self.picture, 1), foot, self._by_itself, gap=8)
        been = Card(theme)
        title = Text(theme, self.tr("Where the board has been"), 16, SEMIBOLD, wrap=True)
        fill(been.body, in_line((title, 1), self._field_count), self.fields)
        checks = Card(theme)
        self._fill_grid()
        checks.body.addLayout(self._grid)
        column = in_column(self.count, self.what, self.how, been, checks, STRETCH, gap=12)
        self._right = QWidget()
        in_column((scrolled(column), 1), self.bar, self.primary, gap=12, margins=(0, 0, 0, 0), within=self._right)
        margins = (MARGIN_PX, GAP_PX, MARGIN_PX, GAP_PX)
        in_line((left, 1), self._right, gap=MARGIN_PX, margins=margins, within=self)

    def _fill_grid(self) -> None:
        theme = self._theme
        self._grid.setHorizontalSpacing(10)
        self._grid.setVerticalSpacing(4)
        for column, stretch in enumerate((0, 30, 36, 34)):
            self._grid.setColumnStretch(column, stretch)
        self._cells: list[tuple[StateText, Text, Text, Text]] = []
        for number in range(CHECKS):
            cells = (
                StateText(theme), Text(theme, "", 14, REGULAR, wrap=True), Text(theme, "", 14, MEDIUM, wrap=True),
                caption(theme, "", wrap=True),
            )  # fmt: skip
            if number:
                self._grid.addWidget(Line(theme), 2 * number, 0, 1, 4)
            for place, cell in enumerate(cells):
                self._grid.addWidget(cell, 2 * number + 1, place)
            self._cells.append(cells)

    def _fit(self) -> None:
        """Large text must leave the picture its half."""
        self._right.setFixedWidth(min(self._theme.px(COLUMN_PX), round(0.44 * max(self.width(), 640))))

    # --- states -------------------------------------------------------------------------------------------
    def begin(self, *, simulated: bool = False) -> None:
        self.progress, self._note, self.simulated = None, "", simulated
        self.picture.clear(self.tr("The camera is being opened."))
        self.what.setText(self.tr("One moment"))
        self.how.setText(self.tr("The camera is being opened."))
        self.bar.show()
        self.bar.begin()
        self.primary.setEnabled(False)
        self.primary.set_face(to_go_words(None))
        self.count.show_state("open", self.tr("No picture yet"))
        self._fill()

    def opened(self) -> None:
        self.bar.hide()
        self.what.setText(self.tr("Hold the board in the picture"))
        self.how.setText(self.tr("All of it, flat towards the camera, about 60 cm away."))
        self.picture.setFocus(Qt.FocusReason.OtherFocusReason)

    def show_frame(self, newest: Frame) -> None:
        """The newest picture; while the board is found, the one that it was found in, so that rings lie on corners."""
        now = self.progress
        shown = newest
        if now is not None and now.look.found is not None and newest.timestamp_s - now.frame.timestamp_s < RINGS_LAST_S:
            shown = now.frame
        self.has_rings = now is not None and now.look.found is not None and shown is now.frame
        self.picture.show_frame(shown.color_rgb)

    def show_lost(self, words: str) -> None:
        """The camera sends nothing: why, and what to do; what was taken stays."""
        self.picture.clear(words)
        self.what.setText(self.tr("No pictures from the camera"))
        self.how.setText(words)

    def show_progress(self, now: BoardProgress) -> None:
        self.progress = now
        judged = now.judgement
        what, how = step_words(now.step)
        lack = lack_words(now.look.lack)
        self.what.setText(what)
        self.how.setText(self._note or (lack if now.look.lack in ("dark", "too_tilted", "blurred") else how))
        words = self.tr("1 picture") if judged.views == 1 else self.tr("{count} pictures")
        self.count.show_state("good" if now.step.kind == "done" else "partly", words.format(count=judged.views))
        self.primary.set_face(to_go_words(now))
        self.primary.setEnabled(judged.views >= now.asked and not judged.missing)
        if now.look.kept:
            self._note = ""
        self._fill()
        self.picture.update()

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

    def _fill(self) -> None:
        now = self.progress
        if now is None:
            self._field_count.setText("")
            self.fields.show_corners(self.fields.nothing, None)
        else:
            corners = now.judgement.corners_in_field
            self._field_count.setText(self.tr("{count} of {all}").format(count=now.judgement.fields, all=corners.size))
            self.fields.show_corners(corners, now.step.field)
        rows = [] if now is None else check_rows(now)
        for (sign, name, value, limit), row in zip(self._cells, rows or [EMPTY] * CHECKS, strict=True):
            sign.show_state(row[0], "")
            for text, said in zip((name, value, limit), row[1:], strict=True):
                text.setText(said)

    # --- over the picture ---------------------------------------------------------------------------------
    def _paint_over(self, painter: QPainter, view: PictureView) -> None:
        top = 12.0
        if self.simulated:
            words = self.tr("Simulated camera and board")
            size = label_size(self._theme, words)
            left, low = view.width() - size.width() - 12.0, view.height() - size.height() - 12.0
            paint_label(painter, self._theme, words, left, low)
        now = self.progress
        if now is None:
            return
        found = now.look.found if self.has_rings else None
        if now.target is not None:
            side = now.step.side if now.step.kind in ("place", "tilt") else None
            words = self.tr("Hold it here")
            if side is not None:
                words = self.tr("Hold it here, {side} nearer").format(side=side_name(side))
            paint_target(painter, view, self._theme, now.target, found, words)
        seen = lack_words(now.look.lack)
        if found is not None:  # what is lacking stands beside the picture
            paint_corners(painter, view, found.pixel)
            seen = self.tr("{count} of {all} corners found").format(count=len(found.pixel), all=now.corner_count)
        if seen:
            paint_label(painter, self._theme, seen, 12.0, top)
