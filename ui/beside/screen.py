"""Two sessions side by side: the answer first, then both in step, their mean repetitions, and the differences."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, TypeVar

from PySide6.QtCore import QObject, Qt, Signal, SignalInstance

from carpus.core.results.side_by_side import Step, ordered
from carpus.core.session.values import Session
from carpus.ui.background import Background
from carpus.ui.beside.differences import DifferencesCard, MeanCard
from carpus.ui.beside.picture import BesidePicture
from carpus.ui.beside.player import BesidePlayer, Together, ends_s
from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Card
from carpus.ui.controls.layouts import Fitted, in_column, in_line, page
from carpus.ui.controls.progress_bar import ThinBar
from carpus.ui.controls.text import REGULAR, SEMIBOLD, Sign, Text, heading
from carpus.ui.keys import Keys, bind_screen
from carpus.ui.playback.transport import Playing
from carpus.ui.report.beside_shown import Shown, Watched, shown, value_words
from carpus.ui.report.beside_words import doubts, headline, picture_words, unfair_words
from carpus.ui.theme import GAP_PX, MARGIN_PX, Theme, is_tight

if TYPE_CHECKING:
    from carpus.core.records.library import Library

NARROW_PX = 1180
"""Below it the pictures are smaller, and the curves have no room for their title."""


class BesideScreen(Fitted):
    """``report`` and ``export`` ask for what is shown on paper and as tables, ``other`` for another session in place of
    the second; ``told`` a fault; ``arrived`` when both sessions are on the screen."""

    report = Signal(object)
    export = Signal(object)
    other = Signal()
    told = Signal(object)
    arrived = Signal()

    def __init__(self, theme: Theme, keys: Keys, background: Background, store: Library) -> None:
        super().__init__()
        self._theme = theme
        self.ids: tuple[str, str] = ("", "")
        """The sessions asked for; once they are shown in the order in which they stand."""
        self._affected, self._finger = "", 0
        self._watched: tuple[Watched, Watched] | None = None
        self.shown: Shown | None = None
        """What is on the screen; None while it is read."""
        self.together: Together | None = None
        """How both are played."""
        self.playing = Playing(self)
        self.reader = PairReader(self, background, store)
        self.answer = heading(theme, wrap=True)
        self._basis = Text(theme, "", 16, REGULAR, "text2", wrap=True)
        self._other_button = Button(theme, self.tr("Compare with &another…"))
        self.report_button = Button(theme, self.tr("Report"), "primary", icon="file-text", hint="Ctrl+P", height_px=44)
        self._bar = ThinBar(theme, self.tr("How far reading is"))
        self.pictures = (
            BesidePicture(theme, background, store.picture), BesidePicture(theme, background, store.picture)
        )  # fmt: skip
        self.mean = MeanCard(theme)
        self.player = BesidePlayer(theme, self.playing)
        self._unfair = Text(theme, "", 14, SEMIBOLD, wrap=True)
        self._strip = Card(theme, 12, "warn_soft", "warn")
        self.differences = DifferencesCard(theme, keys)
        self._lay_out()
        self._connect(keys)
        theme.changed.connect(self._fit)
        theme.changed.connect(self._fit_soon)
        self._show_parts(reading=False)

    # --- layout -------------------------------------------------------------------------------------------
    def _lay_out(self) -> None:
        said = in_column(self.answer, self._basis, gap=2)
        head = in_line((said, 1), gap=12)
        for button in (self._other_button, self.report_button):
            head.addWidget(button, 0, Qt.AlignmentFlag.AlignTop)
        line = in_line((Sign(self._theme, "warn"), 0, Qt.AlignmentFlag.AlignVCenter), (self._unfair, 1), gap=10)
        self._strip.body.setContentsMargins(16, 8, 16, 8)
        self._strip.body.addLayout(line)
        one, other = self.pictures
        self._top = in_line((one, 324), (other, 324), GAP_PX - 12, (self.mean, 556), gap=12)
        self._column = in_column(
            head,
            self._bar,
            self._strip,
            (self._top, 5),
            self.player,
            (self.differences, 5),
            gap=12,
            margins=(MARGIN_PX, GAP_PX - 4, MARGIN_PX, GAP_PX),
        )
        self._column.addStretch(0)
        in_column(page(self._column), margins=(0, 0, 0, 0), within=self)

    def _fit(self) -> None:
        """With large text smaller pictures and fewer words at the buttons."""
        tight = is_tight(self, self._theme)
        self.player.show_tight(tight)
        self._basis.setVisible(bool(self._basis.text()) and not tight)  # the table says it too
        self._other_button.set_face(self.tr("&Another…") if tight else self.tr("Compare with &another…"))
        self.report_button.set_face(self.report_button.text(), hint="" if tight else "Ctrl+P")
        narrow = tight or self.width() < NARROW_PX * self._theme.text_scale
        self.mean.title.setVisible(not narrow)
        least = 180 if narrow else 240
        for picture in self.pictures:
            picture.setMinimumSize(round(least * 4 / 3), least)
        self.differences.fit(tight=tight, shown=self.shown is not None)
        self._column.setStretchFactor(self._top, 2 if tight else 5)

    def _connect(self, keys: Keys) -> None:
        differences = self.differences
        self.reader.went_on.connect(lambda done: self._bar.show_progress(done, TASKS))
        self.reader.read.connect(self._show_first_pictures)
        self.reader.ready.connect(self._show)
        self.reader.failed.connect(self._fail)
        for picture in self.pictures:
            picture.failed.connect(self.told)
            picture.failed.connect(self.playing.stop)
        self.mean.chosen.connect(self._show_place)
        self.mean.sought.connect(self._seek_share)
        differences.followed.currentIndexChanged.connect(lambda _: self._compare())
        differences.mirror_button.toggled.connect(lambda _: self._mirror())
        self.playing.moved.connect(lambda _: self._show_place())
        self.player.transport.stepped.connect(self.step)
        self.player.step_chosen.connect(lambda _: self._keep_in_step())
        self.player.sought.connect(self._seek_in)
        self._other_button.clicked.connect(self.other)
        self.report_button.clicked.connect(lambda: self._hand_over(self.report))
        differences.export_button.clicked.connect(lambda: self._hand_over(self.export))
        actions = {
            "play": self.playing.toggle, "frame_back": lambda: self.step(-1), "frame_on": lambda: self.step(1),
            "repetition_back": lambda: self.go_to_repetition(-1), "repetition_on": lambda: self.go_to_repetition(1),
            "mirror": differences.mirror_button.click, "export": differences.export_button.click,
            "report": self.report_button.click,
        }  # fmt: skip
        bind_screen(self, keys, actions)

    def _hand_over(self, signal: SignalInstance) -> None:
        if self.shown is not None:
            self.playing.stop()
            signal.emit(self.shown)

    # --- life ---------------------------------------------------------------------------------------------
    def begin(self, session_ids: tuple[str, str], affected: str = "", finger: int = 0) -> None:
        """Read two sessions in the background, then show them; ``affected`` is the patient's hand, ``finger`` the one
        that was looked at, if any."""
        self.playing.open(-1.0)
        self.ids, self._affected, self._finger = session_ids, affected, finger
        self._watched = self.shown = self.together = None
        self.answer.setText(self.tr("Reading both sessions…"))
        self._basis.setText("")
        self._unfair.setText("")
        self._bar.show_progress(0, TASKS)
        self.differences.clear()
        self.mean.show_means(None)
        for picture in self.pictures:
            picture.open(None, self.tr("Reading the session…"))
        self._show_parts(reading=True)
        self.setFocus(Qt.FocusReason.OtherFocusReason)
        self.reader.begin(session_ids)

    def _fail(self, fault: Exception) -> None:
        self.answer.setText(self.tr("Nothing is compared: one of the two sessions could not be read."))
        self._basis.setText("")
        self._show_parts(reading=False)
        self.told.emit(fault)

    def _show_parts(self, *, reading: bool) -> None:
        ready = self.shown is not None
        self._bar.setVisible(reading)
        for widget in (self.player, self.differences, self.mean, *self.pictures):
            widget.setVisible(ready or reading)  # everything has its place at once
        for control in (self.player, self.differences.followed, self.differences.mirror_button):
            control.setEnabled(ready)
        self._fit()
        self._strip.setVisible(ready and bool(self._unfair.text()))
        for button in (self.report_button, self.differences.export_button):
            button.setEnabled(ready)
        self._other_button.setEnabled(not reading)
        self._column.setStretch(self._column.count() - 1, 0 if ready or reading else 1)

    def _show_first_pictures(self, sessions: tuple[Session, Session]) -> None:
        """As soon as both are read, the right hand and the newer one first; the figures follow."""
        for picture, session in zip(self.pictures, sessions, strict=True):
            picture.open(session)
            if len(session):
                picture.reader.ask(0)

    def _show(self, watched: tuple[Watched, Watched]) -> None:
        one, other = watched
        first, _ = ordered(one.figures, other.figures, self._affected)  # type: ignore[arg-type]
        self._watched = (one, other) if first is one.figures else (other, one)
        self.ids = tuple(of.session.header.session_id for of in self._watched)  # type: ignore[assignment]
        for picture, of in zip(self.pictures, self._watched, strict=True):
            if picture.session is not of.session:
                picture.open(of.session)
        self.differences.show_sessions(self._watched)
        self._compare()
        self._keep_in_step(at_start=True)
        self._show_parts(reading=False)
        self._mirror()
        self._fit()
        self.arrived.emit()

    # --- what is said -------------------------------------------------------------------------------------
    def _compare(self) -> None:
        if self._watched is None:
            return
        what = self.differences.followed.currentData()
        now = self.shown = shown(*self._watched, what if isinstance(what, str) else "")
        answer, basis = headline(now.both)
        self.answer.setText(answer)
        self._basis.setText(basis)
        self._unfair.setText(unfair_words(now.both) or " ".join(doubts(now.both)))
        self._strip.setVisible(bool(self._unfair.text()))
        self.differences.show_differences(now)
        self.mean.show_means(now, self._finger)
        self._show_place()
        self._fit()
        self._fit_soon()

    def _mirror(self) -> None:
        if self._watched is None:
            return
        for picture, watched in zip(self.pictures, self._watched, strict=True):
            picture.set_mirrored(self.differences.mirror_button.isChecked() and watched.figures.side == "left")
        self._show_place()

    # --- time ---------------------------------------------------------------------------------------------
    def _keep_in_step(self, *, at_start: bool = False) -> None:
        """Another way to keep both in step: the first stays where it is."""
        if self._watched is None or self.shown is None:
            return
        before, time_s = self.together, self.playing.time_s
        at_s = before.step.at(time_s)[0] if before is not None else 0.0
        step: Step = {"start": "start", "time": "time"}.get(str(self.player.step.currentData()), "part")  # type: ignore[assignment]
        now = self.together = Together.of(self._watched, step)
        self.playing.end_s = now.step.end_s
        self.player.show_names(self.shown.names)
        starts = now.step.starts_s
        self.playing.seek((starts[0] if starts else 0.0) if at_start else now.step.when_first(at_s))

    def _seek_in(self, place: int, time_s: float) -> None:
        if self.together is not None:
            step = self.together.step
            self.playing.seek(step.when_second(time_s) if place else step.when_first(time_s))

    def _seek_share(self, share: float) -> None:
        """A place in the mean repetition was pointed at: there in the repetition that is shown."""
        if self.together is not None:
            self.playing.seek(self.together.at_share(self.playing.time_s, share))

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
            picture.show_row(together.row(place, time_s))
            watched, other = together.watched[place], together.watched[1 - place]
            name = picture_words(watched.figures, other.figures, self._affected, mirrored=picture.mirrored)
            number = currents[place] + 1
            repetition = self.tr("Repetition {number}").format(number=number) if number else ""
            picture.show_words(name, repetition, value_words(watched, self.mean.quantity, picture.row))
        self.mean.curves.show_shares((together.share(0, time_s), together.share(1, time_s)))
        self.player.show_places(together.step.at(time_s), currents, ends_s(together.watched), together.repetitions)


TASKS = 4
"""Both are read, and of both the figures are worked out."""
Found = TypeVar("Found")


class PairReader(QObject):
    """``went_on`` carries how many of :data:`TASKS` are done, ``read`` both sessions, ``ready`` both watched,
    ``failed`` the fault that ended it."""

    went_on = Signal(int)
    read = Signal(object)
    ready = Signal(object)
    failed = Signal(object)

    def __init__(self, owner: QObject, background: Background, store: Library) -> None:
        super().__init__(owner)
        self._background, self._store = background, store
        self._round = 0
        self._sessions: list[Session] = []
        self._watched: list[Watched] = []

    def begin(self, session_ids: tuple[str, str]) -> None:
        """Read these; what still comes of others is for nobody."""
        self._round += 1
        self._sessions, self._watched = [], []
        for session_id in session_ids:
            self._run(lambda one=session_id: self._store.session(one), self._take_session)  # type: ignore[misc]

    def _run(self, work: Callable[[], Found], done: Callable[[Found], None]) -> None:
        number = self._round

        def came(found: Found) -> None:
            if number == self._round:
                done(found)

        def failed(fault: Exception) -> None:
            if number == self._round:
                self._round += 1  # what else is under way is for nobody any more
                self.failed.emit(fault)

        self._background.run(work, came, failed, self)

    def _take_session(self, session: Session) -> None:
        self._sessions.append(session)
        self.went_on.emit(len(self._sessions))
        if len(self._sessions) == 2:
            self.read.emit(tuple(self._sessions))
            for one in self._sessions:
                self._run(lambda one=one: self._watch(one), self._take_watched)  # type: ignore[misc]

    def _watch(self, session: Session) -> Watched:
        return Watched.of(session, self._store.figures_of(session.header.session_id))

    def _take_watched(self, one: Watched) -> None:
        self._watched.append(one)
        self.went_on.emit(len(self._sessions) + len(self._watched))
        if len(self._watched) == 2:
            self.ready.emit(tuple(self._watched))
