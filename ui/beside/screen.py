"""Two sessions side by side: the answer first, then both in step, and the differences."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import Qt, Signal

from carpus.core.results.side_by_side import SideBySide, ordered, side_by_side
from carpus.ui.background import Background
from carpus.ui.beside.picture import BesidePicture
from carpus.ui.beside.player import BesidePlayer, Together, Watched, ends_s, value_words
from carpus.ui.beside.table import DifferencesCard
from carpus.ui.beside.words import doubts, headline, keys_of, name_of, picture_words, unfair_words
from carpus.ui.controls.card import Card
from carpus.ui.controls.layouts import Fitted, in_column, in_line, page
from carpus.ui.controls.text import REGULAR, SEMIBOLD, Sign, Text, heading
from carpus.ui.keys import bind_screen
from carpus.ui.playback.transport import Playing
from carpus.ui.theme import GAP_PX, MARGIN_PX, Theme, is_tight

if TYPE_CHECKING:
    from carpus.core.records.library import Library


class BesideScreen(Fitted):
    """``told`` a fault; ``arrived`` when both sessions are on the screen."""

    told = Signal(object)
    arrived = Signal()

    def __init__(self, theme: Theme, background: Background, store: Library) -> None:
        super().__init__()
        self._theme, self._background, self._store = theme, background, store
        self.ids: tuple[str, str] = ("", "")
        """The sessions asked for; once they are shown in the order in which they stand."""
        self._affected, self._asked = "", 0
        self.both: SideBySide | None = None
        self.together: Together | None = None
        """What is on the screen, and how it is played; None while it is read."""
        self.playing = Playing(self)
        self.answer = heading(theme, wrap=True)
        self._basis = Text(theme, "", 16, REGULAR, "text2", wrap=True)
        self.pictures = tuple(BesidePicture(theme, background, store.picture) for _ in range(2))
        self.player = BesidePlayer(theme, self.playing)
        self._unfair = Text(theme, "", 14, SEMIBOLD, wrap=True)
        self._strip = Card(theme, 12, "warn_soft", "warn")
        self.differences = DifferencesCard(theme)
        self._lay_out()
        self._connect()
        theme.changed.connect(self._fit)
        theme.changed.connect(self._fit_soon)
        self._show_parts(reading=False)

    def _lay_out(self) -> None:
        line = in_line((Sign(self._theme, "warn"), 0, Qt.AlignmentFlag.AlignVCenter), (self._unfair, 1), gap=10)
        self._strip.body.addLayout(line)
        pictures = in_line(*((picture, 1) for picture in self.pictures), gap=12)
        margins = (MARGIN_PX, GAP_PX - 4, MARGIN_PX, GAP_PX)
        parts = (self.answer, self._basis, self._strip, (pictures, 5), self.player, self.differences)
        self._column = in_column(*parts, gap=12, margins=margins)
        self._column.addStretch(0)
        in_column(page(self._column), margins=(0, 0, 0, 0), within=self)

    def _fit(self) -> None:
        """With large text smaller pictures."""
        tight = is_tight(self, self._theme)
        self.player.show_tight(tight)
        self._basis.setVisible(bool(self._basis.text()) and not tight)  # the table says it too
        least = 180 if tight else 240
        for picture in self.pictures:
            picture.setMinimumSize(round(least * 4 / 3), least)

    def _connect(self) -> None:
        for picture in self.pictures:
            picture.failed.connect(self.told)
            picture.failed.connect(self.playing.stop)
        self.differences.followed.currentIndexChanged.connect(lambda _: self._compare())
        self.differences.mirror_button.toggled.connect(lambda _: self._show_place())
        self.playing.moved.connect(lambda _: self._show_place())
        self.player.transport.stepped.connect(self.step)
        self.player.sought.connect(self._seek_in)
        actions = {
            "play": self.playing.toggle, "frame_back": lambda: self.step(-1), "frame_on": lambda: self.step(1),
            "repetition_back": lambda: self.go_to_repetition(-1), "repetition_on": lambda: self.go_to_repetition(1),
            "mirror": self.differences.mirror_button.click,
        }  # fmt: skip
        bind_screen(self, actions)

    # --- life ---------------------------------------------------------------------------------------------
    def begin(self, session_ids: tuple[str, str], affected: str = "") -> None:
        """Read two sessions in the background, then show them; ``affected`` is the patient's hand."""
        self.playing.open(-1.0)
        self.ids, self._affected = session_ids, affected
        self.both = self.together = None
        self._say(self.tr("Reading both sessions…"))
        for picture in self.pictures:
            picture.open(None, self.tr("Reading the session…"))
        self._show_parts(reading=True)
        self.setFocus(Qt.FocusReason.OtherFocusReason)
        self._asked += 1
        asked, store = self._asked, self._store

        def read() -> list[Watched]:
            return [Watched.of(store.session(one), store.figures_of(one)) for one in session_ids]

        def failed(fault: Exception) -> None:
            if asked == self._asked:
                self._say(self.tr("Nothing is compared: one of the two sessions could not be read."))
                self._show_parts(reading=False)
                self.told.emit(fault)

        self._background.run(read, lambda both: self._show(both) if asked == self._asked else None, failed, self)

    def _show(self, watched: list[Watched]) -> None:
        one, other = watched
        first, _ = ordered(one.figures, other.figures, self._affected)  # type: ignore[arg-type]
        both = (one, other) if first is one.figures else (other, one)
        self.ids = (both[0].session.header.session_id, both[1].session.header.session_id)
        for picture, of in zip(self.pictures, both, strict=True):
            picture.open(of.session)
        self.together = Together.of(both)
        self.both = side_by_side(both[0].figures, both[1].figures)
        self.differences.begin(self.both)
        self._compare()
        self.playing.end_s = self.together.step.end_s
        self.player.show_names((name_of(self.both.first, self.both.second), name_of(self.both.second, self.both.first)))
        self.playing.seek(self.together.step.starts_s[0] if self.together.step.starts_s else 0.0)
        self._show_parts(reading=False)
        self._show_place()
        self._fit_soon()
        self.arrived.emit()

    def _show_parts(self, *, reading: bool) -> None:
        ready = self.together is not None
        for widget in (self.player, *self.pictures):
            widget.setVisible(ready or reading)  # everything has its place at once
        self.player.setEnabled(ready)
        self.differences.setVisible(ready)
        self._strip.setVisible(ready and bool(self._unfair.text()))
        self._column.setStretch(self._column.count() - 1, 0 if ready or reading else 1)
        self._fit()

    # --- what is said -------------------------------------------------------------------------------------
    def _say(self, answer: str, basis: str = "", unfair: str = "") -> None:
        self.answer.setText(answer)
        self._basis.setText(basis)
        self._unfair.setText(unfair)

    def _compare(self) -> None:
        if self.both is None:
            return
        keys = keys_of(str(self.differences.followed.currentData() or ""))
        self.both = side_by_side(self.both.first, self.both.second, keys)
        self._say(*headline(self.both), unfair_words(self.both) or " ".join(doubts(self.both)))
        self._strip.setVisible(bool(self._unfair.text()))
        self.differences.show_differences(self.both)
        self._fit()
        self._fit_soon()

    # --- time ---------------------------------------------------------------------------------------------
    def _seek_in(self, place: int, time_s: float) -> None:
        if self.together is not None:
            step = self.together.step
            self.playing.seek(step.when_second(time_s) if place else step.when_first(time_s))

    def step(self, pictures: int) -> None:
        if self.together is not None:
            self.playing.seek(self.playing.time_s + pictures * self.together.period_s())

    def go_to_repetition(self, by: int) -> None:
        if self.together is not None:
            self.playing.seek(self.together.next_start(self.playing.time_s, by))

    def _show_place(self) -> None:
        together, time_s = self.together, self.playing.time_s
        if together is None:
            return
        currents = (together.current(0, time_s), together.current(1, time_s))
        for place, picture in enumerate(self.pictures):
            watched, other = together.watched[place], together.watched[1 - place]
            picture.set_mirrored(self.differences.mirror_button.isChecked() and watched.figures.side == "left")
            picture.show_row(together.row(place, time_s))
            name = picture_words(watched.figures, other.figures, self._affected, mirrored=picture.mirrored)
            number = currents[place] + 1
            repetition = self.tr("Repetition {number}").format(number=number) if number else ""
            picture.show_words(name, repetition, value_words(watched, picture.row))
        self.player.show_places(together.step.at(time_s), currents, ends_s(together.watched), together.repetitions)
