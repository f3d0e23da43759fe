"""Comparison of two sessions: the result, synchronised frames, the differences."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import Qt, Signal

from carpus.core.results.side_by_side import SessionPair, compare_pair, order_pair
from carpus.ui.kit.background import Background
from carpus.ui.kit.card import Card
from carpus.ui.kit.keys import bind_screen_keys
from carpus.ui.kit.layouts import FittedWidget, column_layout, row_layout, scroll_page
from carpus.ui.kit.text import REGULAR, SEMIBOLD, Icon, Text, heading
from carpus.ui.kit.theme import GAP_PX, MARGIN_PX, Theme, is_tight
from carpus.ui.picture.playback_controls import PlaybackClock
from carpus.ui.screens.beside.differences_card import DifferencesCard
from carpus.ui.screens.beside.frame_view import ComparisonFrameView
from carpus.ui.screens.beside.player import (
    ComparedSession,
    ComparisonPlayer,
    PlaybackAlignment,
    durations_s,
    value_words,
)
from carpus.ui.screens.beside.words import doubts, headline, measure_keys, picture_words, session_name, unfair_words

if TYPE_CHECKING:
    from carpus.core.records.library import Library


class ComparisonScreen(FittedWidget):
    """Comparison of two sessions.

    Signals: ``fault_raised``, ``sessions_shown``.
    """

    fault_raised = Signal(object)
    sessions_shown = Signal()

    def __init__(self, theme: Theme, background: Background, store: Library) -> None:
        super().__init__()
        self._theme, self._background, self._store = theme, background, store
        self.session_ids: tuple[str, str] = ("", "")
        """The requested sessions; once shown, in the order on the screen."""
        self._affected_side, self._request_number = "", 0
        self.comparison: SessionPair | None = None
        self.alignment: PlaybackAlignment | None = None
        """The sessions on the screen and their playback; None while they are read."""
        self.playing = PlaybackClock(self)
        self.answer = heading(theme, wrap=True)
        self._basis = Text(theme, "", 16, REGULAR, "text2", wrap=True)
        self.frame_views = tuple(ComparisonFrameView(theme, background, store.read_frame) for _ in range(2))
        self.player = ComparisonPlayer(theme, self.playing)
        self._unfair = Text(theme, "", 14, SEMIBOLD, wrap=True)
        self._strip = Card(theme, 12, "warn_soft", "warn")
        self.differences = DifferencesCard(theme)
        self._build_layout()
        self._connect()
        theme.changed.connect(self._fit)
        theme.changed.connect(self._fit_soon)
        self._show_sections(reading=False)

    def _build_layout(self) -> None:
        line = row_layout((Icon(self._theme, "warn"), 0, Qt.AlignmentFlag.AlignVCenter), (self._unfair, 1), gap=10)
        self._strip.body.addLayout(line)
        pictures = row_layout(*((picture, 1) for picture in self.frame_views), gap=12)
        margins = (MARGIN_PX, GAP_PX - 4, MARGIN_PX, GAP_PX)
        parts = (self.answer, self._basis, self._strip, (pictures, 5), self.player, self.differences)
        self._column = column_layout(*parts, gap=12, margins=margins)
        self._column.addStretch(0)
        column_layout(scroll_page(self._column), margins=(0, 0, 0, 0), parent=self)

    def _fit(self) -> None:
        """Use smaller frames with large text."""
        tight = is_tight(self, self._theme)
        self.player.show_tight(tight)
        self._basis.setVisible(bool(self._basis.text()) and not tight)  # the table says it too
        least = 180 if tight else 240
        for picture in self.frame_views:
            picture.setMinimumSize(round(least * 4 / 3), least)

    def _connect(self) -> None:
        for picture in self.frame_views:
            picture.read_failed.connect(self.fault_raised)
            picture.read_failed.connect(self.playing.stop)
        self.differences.measure_choice.currentIndexChanged.connect(lambda _: self._compare())
        self.differences.mirror_button.toggled.connect(lambda _: self._show_time())
        self.playing.time_changed.connect(lambda _: self._show_time())
        self.player.transport.stepped.connect(self.step_frames)
        self.player.time_requested.connect(self._jump_to_time)
        actions = {
            "play": self.playing.toggle,
            "frame_back": lambda: self.step_frames(-1),
            "frame_on": lambda: self.step_frames(1),
            "repetition_back": lambda: self.jump_to_repetition(-1),
            "repetition_on": lambda: self.jump_to_repetition(1),
            "mirror": self.differences.mirror_button.click,
        }
        bind_screen_keys(self, actions)

    # --- life ---------------------------------------------------------------------------------------------
    def load_sessions(self, session_ids: tuple[str, str], affected_side: str = "") -> None:
        """Read two sessions in the background and show them; ``affected_side`` is the patient's hand."""
        self.playing.open(-1.0)
        self.session_ids, self._affected_side = session_ids, affected_side
        self.comparison = self.alignment = None
        self._show_answer(self.tr("Reading both sessions…"))
        for picture in self.frame_views:
            picture.set_session(None, self.tr("Reading the session…"))
        self._show_sections(reading=True)
        self.setFocus(Qt.FocusReason.OtherFocusReason)
        self._request_number += 1
        asked, store = self._request_number, self._store

        def read() -> list[ComparedSession]:
            return [ComparedSession.from_figures(store.session(one), store.results_by_id(one)) for one in session_ids]

        def on_failed(fault: Exception) -> None:
            if asked == self._request_number:
                self._show_answer(self.tr("No comparison: one of the two sessions could not be read."))
                self._show_sections(reading=False)
                self.fault_raised.emit(fault)

        self._background.run(
            read, lambda both: self._show_sessions(both) if asked == self._request_number else None, on_failed, self
        )

    def _show_sessions(self, watched: list[ComparedSession]) -> None:
        one, other = watched
        first, _ = order_pair(one.figures, other.figures, self._affected_side)  # type: ignore[arg-type]
        both = (one, other) if first is one.figures else (other, one)
        self.session_ids = (both[0].session.header.session_id, both[1].session.header.session_id)
        for picture, of in zip(self.frame_views, both, strict=True):
            picture.set_session(of.session)
        self.alignment = PlaybackAlignment.from_sessions(both)
        self.comparison = compare_pair(both[0].figures, both[1].figures)
        self.differences.show_choices(self.comparison)
        self._compare()
        self.playing.end_s = self.alignment.step.end_s
        self.player.show_names(
            (
                session_name(self.comparison.first, self.comparison.second),
                session_name(self.comparison.second, self.comparison.first),
            )
        )
        self.playing.set_time(self.alignment.step.starts_s[0] if self.alignment.step.starts_s else 0.0)
        self._show_sections(reading=False)
        self._show_time()
        self._fit_soon()
        self.sessions_shown.emit()

    def _show_sections(self, *, reading: bool) -> None:
        ready = self.alignment is not None
        for widget in (self.player, *self.frame_views):
            widget.setVisible(ready or reading)  # everything has its place at once
        self.player.setEnabled(ready)
        self.differences.setVisible(ready)
        self._strip.setVisible(ready and bool(self._unfair.text()))
        self._column.setStretch(self._column.count() - 1, 0 if ready or reading else 1)
        self._fit()

    # --- texts -------------------------------------------------------------------------------------------
    def _show_answer(self, answer: str, basis: str = "", unfair: str = "") -> None:
        self.answer.setText(answer)
        self._basis.setText(basis)
        self._unfair.setText(unfair)

    def _compare(self) -> None:
        if self.comparison is None:
            return
        keys = measure_keys(str(self.differences.measure_choice.currentData() or ""))
        self.comparison = compare_pair(self.comparison.first, self.comparison.second, keys)
        self._show_answer(
            *headline(self.comparison), unfair_words(self.comparison) or " ".join(doubts(self.comparison))
        )
        self._strip.setVisible(bool(self._unfair.text()))
        self.differences.show_differences(self.comparison)
        self._fit()
        self._fit_soon()

    # --- time ---------------------------------------------------------------------------------------------
    def _jump_to_time(self, which: int, time_s: float) -> None:
        if self.alignment is not None:
            step = self.alignment.step
            self.playing.set_time(step.player_time_of_second(time_s) if which else step.player_time_of_first(time_s))

    def step_frames(self, frames: int) -> None:
        if self.alignment is not None:
            self.playing.set_time(self.playing.time_s + frames * self.alignment.frame_period_s())

    def jump_to_repetition(self, direction: int) -> None:
        if self.alignment is not None:
            self.playing.set_time(self.alignment.next_start(self.playing.time_s, direction))

    def _show_time(self) -> None:
        together, time_s = self.alignment, self.playing.time_s
        if together is None:
            return
        currents = (together.current_repetition(0, time_s), together.current_repetition(1, time_s))
        for place, picture in enumerate(self.frame_views):
            watched, other = together.sessions[place], together.sessions[1 - place]
            picture.set_mirrored(self.differences.mirror_button.isChecked() and watched.figures.side == "left")
            picture.show_row(together.frame_row(place, time_s))
            name = picture_words(watched.figures, other.figures, self._affected_side, mirrored=picture.is_mirrored)
            number = currents[place] + 1
            repetition = self.tr("Repetition {number}").format(number=number) if number else ""
            picture.show_words(name, repetition, value_words(watched, picture.row))
        self.player.show_times(
            together.step.recording_times(time_s), currents, durations_s(together.sessions), together.repetitions
        )
