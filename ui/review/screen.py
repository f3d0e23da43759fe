"""The review: picture and curves in step, repetitions to correct, range of motion, on to the report."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QLineEdit, QWidget

from carpus.core.results.figures import SessionFigures
from carpus.core.results.repetition_rows import PASSIVE, RepetitionChoices
from carpus.core.types import TrackStatus
from carpus.ui.background import Background
from carpus.ui.controls.button import Button
from carpus.ui.controls.layouts import STRETCH, Fitted, in_column, in_line, page
from carpus.ui.controls.sheet import Sheet
from carpus.ui.controls.text import Text
from carpus.ui.keys import bind_screen
from carpus.ui.playback.transport import Playing
from carpus.ui.plot.session import row_at
from carpus.ui.review.card import ReviewCard
from carpus.ui.review.charts import Player, ReviewCharts
from carpus.ui.review.hand_picture import HandPicture, HandPictureSheet, hand_picture
from carpus.ui.review.picture import ReviewPicture
from carpus.ui.review.reviewed import Reviewed
from carpus.ui.theme import GAP_PX, MARGIN_PX, Theme, is_tight
from carpus.ui.tour.bubble import LEAST_SCREEN_PX, BubbleView

if TYPE_CHECKING:
    from carpus.core.records.library import Library

EDGE_STEP_S = 0.1


class ReviewScreen(Fitted):
    """``report`` and ``export`` carry the session's identity, ``beside`` with it that of the session to be held against
    it; ``told`` a fault; ``again`` asks for another set; ``arrived`` when a session is on the screen; ``correct``
    carries the session and the row whose markers are to be put right, ``result`` another result of the recording,
    ``result_wanted`` one that is to count again, ``hand_picture_wanted`` a frame to be saved as a
    picture."""

    report = Signal(str)
    beside = Signal(str, str)
    export = Signal(str)
    again = Signal()
    correct = Signal(str, object, int)
    result = Signal(str)
    result_wanted = Signal(str)
    hand_picture_wanted = Signal(HandPicture)
    told = Signal(object)
    arrived = Signal()

    def __init__(self, theme: Theme, background: Background, store: Library) -> None:
        super().__init__()
        self._theme, self._background, self._store = theme, background, store
        self._session_id = ""
        self._whole_hand = self._tight = False
        self.reviewed: Reviewed | None = None
        self.current = -1
        """The chosen repetition, from 0; -1 for none."""
        self.playing = Playing(self)
        self.picture = ReviewPicture(theme, background, store.picture)
        self.charts = ReviewCharts(theme)
        self.player = Player(theme, self.playing)
        self.card = ReviewCard(theme)
        self.bubble = BubbleView(theme, wide=True)
        self.reason = ReasonSheet(self, theme)
        self.hand_picture = HandPictureSheet(self, theme)
        self._column = in_column(
            (in_line((self.picture, 480), (self.charts, 736), gap=GAP_PX), 1),
            self.player,
            self.bubble,
            self.card,
            gap=12,
            margins=(MARGIN_PX, GAP_PX, MARGIN_PX, GAP_PX),
        )
        self._page = page(self._column)
        in_column(self._page, margins=(0, 0, 0, 0), within=self)
        self._connect()
        self._bind()
        theme.changed.connect(self._fit)
        theme.changed.connect(self._fit_soon)

    def _fit(self) -> None:
        self.bubble.give_room(self.height() >= LEAST_SCREEN_PX * self._theme.text_scale)
        tight = is_tight(self, self._theme)
        if tight != self._tight:  # once more, and not with every size: what is fitted again may come out otherwise
            self._tight = tight
            self._fit_soon()
        if self.charts.fit(self.reviewed, above=self._column if tight else None):
            self._refresh()
        else:
            self.card.fit(self._column, self.height(), tight=tight, whole_hand=self._whole_hand)

    def _connect(self) -> None:
        curves, card = self.charts.curves, self.card
        self.playing.moved.connect(self._show_time)
        self.picture.failed.connect(self.told)
        self.picture.correct.connect(self.correct_here)
        self.picture.save_button.clicked.connect(self.ask_hand_picture)
        curves.cursor_moved.connect(self.playing.seek)
        curves.edges_moved.connect(lambda *edges: self._choose(lambda one: one.with_edges(*edges)))
        curves.menu.told.connect(self.told)
        self.charts.chosen.connect(self._refresh)
        self.player.transport.stepped.connect(self.step)
        self.player.view_chosen.connect(lambda _: self._refresh())
        self.player.repetition_wanted.connect(self.toggle_left_out)
        self.reason.kept.connect(self._leave_out)
        self.hand_picture.accepted.connect(self._save_hand_picture)
        card.report_button.clicked.connect(lambda: self.report.emit(self._session_id))
        card.export_button.clicked.connect(lambda: self.export.emit(self._session_id))
        card.again_button.clicked.connect(self.again)
        card.count_button.clicked.connect(self.toggle_counted)
        card.beside_wanted.connect(lambda other: self.beside.emit(self._session_id, other))
        card.tables.results.chosen.connect(self.result)
        card.tables.results.wanted.connect(self.result_wanted)

    def _bind(self) -> None:
        curves, card = self.charts.curves, self.card
        actions: dict[str, Callable[[], object]] = {
            "play": self.playing.toggle, "frame_back": lambda: self.step(-1), "frame_on": lambda: self.step(1),
            "repetition_back": lambda: self.go_to_repetition(self.current - 1),
            "repetition_on": lambda: self.go_to_repetition(self.current + 1),
            "leave_out": self.toggle_left_out, "next_view": self.player.next_view,
            "edge_back": lambda: self.nudge_edge(-EDGE_STEP_S), "edge_on": lambda: self.nudge_edge(EDGE_STEP_S),
            "report": card.report_button.click, "export": card.export_button.click, "plot_in": curves.zoom_in,
            "plot_out": curves.zoom_out, "plot_all": curves.show_all, "correct": self.correct_here,
            "beside": card.beside_button.click, "angle": self.picture.angle_button.click,
            "hand_picture": self.ask_hand_picture,
        }  # fmt: skip
        bind_screen(self, actions)

    # --- life ---------------------------------------------------------------------------------------------
    def begin(
        self, patient_id: str, session_id: str, *, may_repeat: bool = False, whole_hand: bool | None = None
    ) -> None:
        """Read a session in the background, then show it. ``whole_hand`` where that is known: then everything has its
        place at once."""
        self._session_id, self.reviewed = session_id, None
        for sheet in (self.reason, self.hand_picture):
            sheet.close_sheet()  # what they ask about was of the session before
        self.playing.open(-1.0)
        self.charts.curves.clear()
        self.player.show_nothing()
        self.card.show_reading(on=True)
        self._page.verticalScrollBar().setValue(0)
        if whole_hand is not None:
            self._whole_hand = whole_hand
            self.charts.finger.setVisible(whole_hand)
            self.card.tables.show_places(whole_hand=whole_hand)
            self._fit()
        self.card.again_button.setVisible(may_repeat)
        self.picture.open(None, self.tr("Reading the session…"))
        store = self._store

        def failed(fault: Exception) -> None:
            if session_id == self._session_id:
                self.picture.open(None, self.tr("This session cannot be read. Go back, or choose another one."))
            self.told.emit(fault)

        self._background.run(lambda: Reviewed.read(store, patient_id, session_id), self._show, failed, self)
        self.setFocus(Qt.FocusReason.OtherFocusReason)

    @property
    def shown(self) -> bool:
        return self.reviewed is not None

    @property
    def figures(self) -> SessionFigures | None:
        return None if self.reviewed is None else self.reviewed.figures

    def _show(self, reviewed: Reviewed) -> None:
        if reviewed.id != self._session_id:
            return  # another one was asked for meanwhile
        self.reviewed, self._whole_hand = reviewed, reviewed.is_hand
        self.playing.open(float(reviewed.curves.time_s[-1]) if len(reviewed.curves.time_s) else -1.0)
        self.charts.finger.setVisible(reviewed.is_hand)
        self.card.tables.show_places(whole_hand=reviewed.is_hand)
        self.picture.show_session(reviewed.session)
        self.card.tables.results.show_results(reviewed.results, self._session_id)
        all_of_them = reviewed.figures.repetitions
        counted = (n for n, repetition in enumerate(all_of_them) if repetition.counts)
        self.current = next(counted, 0 if all_of_them else -1)  # also where all are passive
        self._refresh()
        self.playing.seek(all_of_them[self.current].start_s if all_of_them else 0.0)
        self.arrived.emit()

    def _refresh(self) -> None:
        reviewed = self.reviewed
        if reviewed is None:
            return
        plot = self.charts.show_plot(reviewed, str(self.player.view.currentData()), self.current)
        self.player.show_session(plot.end_s, reviewed.figures.repetitions, self.current)
        self.picture.show_repetition(reviewed, self.current, max(self.charts.number, 0))
        self.card.show_session(reviewed)
        self._fit()

    # --- time ---------------------------------------------------------------------------------------------
    def _show_time(self, time_s: float) -> None:
        """The repetition under the cursor becomes the current one."""
        if self.reviewed is None:
            return
        under = self.reviewed.under(time_s)
        if under and self.current not in under:
            self.current = under[0]
            self._refresh()
        self.charts.set_time(time_s)
        self.picture.show_time(time_s, row_at(self.reviewed.curves.time_s, time_s))

    def step(self, frames: int) -> None:
        if self.reviewed is not None and len(times := self.reviewed.curves.time_s):
            row = row_at(times, self.playing.time_s) + frames
            self.playing.seek(float(times[np.clip(row, 0, len(times) - 1)]))

    def go_to_repetition(self, number: int) -> None:
        if self.reviewed is not None and 0 <= number < len(self.reviewed.figures.repetitions):
            self.current = number
            self._refresh()
            self.playing.seek(self.reviewed.figures.repetitions[number].start_s)

    def correct_here(self) -> None:
        if self.reviewed is not None and self.picture.row >= 0:
            self.playing.stop()
            self.correct.emit(self._session_id, self.reviewed.session, self.picture.row)

    # --- picture of the hand ------------------------------------------------------------------------------
    def ask_hand_picture(self) -> None:
        """Ask whether this frame becomes a picture; only where frames were kept."""
        reviewed = self.reviewed
        if reviewed is None or self.picture.save_button.isHidden():
            return
        self.playing.stop()
        status = reviewed.curves.status[self.picture.row]
        self.hand_picture.begin(refused=status in (TrackStatus.LOST, TrackStatus.DOUBTFUL))

    def _save_hand_picture(self) -> None:
        if self.reviewed is not None:
            self.hand_picture_wanted.emit(hand_picture(self.reviewed, self.picture.row, self.playing.time_s))

    # --- corrections --------------------------------------------------------------------------------------
    def toggle_left_out(self) -> None:
        """Leave the current repetition out or let it count as passive (asks which), or take that back."""
        if self.reviewed is None or self.current < 0:
            return
        if self.reviewed.figures.repetitions[self.current].reason:
            self._choose(lambda one: one.counting(self.current))
        else:
            self.playing.stop()  # what is asked about stays the current one
            self.reason.begin(self.current + 1)

    def _leave_out(self, number: int, reason: str, and_after: bool) -> None:
        self._choose(lambda one: one.left_out(number - 1, reason, and_after=and_after))

    def nudge_edge(self, by_s: float) -> None:
        """Move the edge of the current repetition that is nearer to the cursor."""
        if self.current >= 0:
            self._choose(lambda one: one.nudged(self.current, self.playing.time_s, by_s))

    def toggle_counted(self) -> None:
        if self.reviewed is not None:
            self._choose(lambda one: replace(one.choices, not_counted=not one.choices.not_counted))
            self.arrived.emit()

    def _choose(self, choices_of: Callable[[Reviewed], RepetitionChoices]) -> None:
        if self.reviewed is None:
            return
        choices = choices_of(self.reviewed)
        self.reviewed = self.reviewed.chosen(choices)
        self._refresh()
        store, session_id = self._store, self._session_id
        self._background.run(lambda: store.keep_choices(session_id, choices), lambda _: None, self.told.emit, self)


class ReasonSheet(Sheet):
    """Emits ``kept`` with the repetition's number, from 1, the reason, and whether it is that of all after it too."""

    kept = Signal(int, str, bool)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 560)
        self._number = 0
        self.head(words=self.tr("Passive: somebody else moved the hand. It counts apart, beside the active ones."))
        body = self.card.body
        self.passive = Button(theme, self.tr("Passive"), "plain", height_px=40)
        self.passive.clicked.connect(lambda: self._keep(PASSIVE))
        self.passive_on = Button(theme, self.tr("Passive, and all after it"), "plain", height_px=40)
        self.passive_on.clicked.connect(lambda: self._keep(PASSIVE, and_after=True))
        body.addLayout(in_line(self.passive, self.passive_on, STRETCH))
        words = self.tr(
            "Left out: it stays in the recording and on the curves, and counts no longer. The report says so."
        )
        body.addWidget(Text(theme, words, 14, token="text2", wrap=True))
        quick = QHBoxLayout()
        self.buttons: list[Button] = []
        for reason in (self.tr("pain"), self.tr("other movement"), self.tr("trial")):
            button = Button(theme, reason, "plain", height_px=40)
            button.clicked.connect(lambda _=False, reason=reason: self._keep(reason))
            quick.addWidget(button)
            self.buttons.append(button)
        quick.addStretch(1)
        body.addLayout(quick)
        self.line = QLineEdit(placeholderText=self.tr("Another reason"))
        self.line.setAccessibleName(self.tr("Another reason"))
        self.line.textChanged.connect(self._written)
        self._take = Button(theme, self.tr("Leave it out"), "plain")
        self._take.clicked.connect(lambda: self._keep(self.line.text().strip()))
        self._close = Button(theme, self.tr("Keep it in"), "plain")
        self._close.clicked.connect(self.close_sheet)
        body.addLayout(in_line((self.line, 1), self._take, self._close))

    def begin(self, number: int) -> None:
        self._number = number
        self.title.setText(self.tr("Is repetition {number} passive, or left out?").format(number=number))
        self.line.clear()
        self._written("")
        self.open()

    def _written(self, text: str) -> None:
        """Who writes a reason means it; without one nothing is left out by Enter."""
        self._take.setEnabled(bool(text.strip()))
        self.set_default(self._take if text.strip() else self._close)

    def _keep(self, reason: str, *, and_after: bool = False) -> None:
        if reason:
            self.close_sheet()
            self.kept.emit(self._number, reason, and_after)
