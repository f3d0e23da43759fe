"""Two sessions side by side: the answer first, then both in step, their mean repetitions, and the differences."""

from __future__ import annotations

import math
from typing import Protocol

import numpy as np
from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QComboBox, QVBoxLayout, QWidget

from carpus.core.hand.exercises import SIDES
from carpus.core.results.figures import SessionFigures
from carpus.core.results.mean_repetition import Quantity
from carpus.core.results.repetition_rows import ShownRepetition
from carpus.core.results.side_by_side import InStep, Step, in_step, ordered
from carpus.core.session.values import Session
from carpus.core.types import ByteImage
from carpus.ui import numbers, terms
from carpus.ui.background import Background
from carpus.ui.beside.mean_card import MeanCard
from carpus.ui.beside.picture import BesidePicture
from carpus.ui.beside.player import BesidePlayer
from carpus.ui.beside.shown import Shown, Watched, kinds, shown, sign_of
from carpus.ui.beside.table import BesideTable
from carpus.ui.beside.words import doubts, other_hand_words, picture_words, quantity_name, unfair_words
from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Card
from carpus.ui.controls.column import ScrolledColumn, scroll_area
from carpus.ui.controls.layouts import STRETCH, in_column, in_line
from carpus.ui.controls.progress_bar import ThinBar
from carpus.ui.controls.text import REGULAR, SEMIBOLD, ElidedText, Sign, Text, caption, heading
from carpus.ui.controls.tooltip import plain_tooltip
from carpus.ui.figures import figure_of, with_side
from carpus.ui.keys import Keys, bind
from carpus.ui.theme import GAP_PX, MARGIN_PX, Theme, is_tight
from carpus.ui.verdicts import limit_words

PLAY_EVERY_MS = 40
NARROW_PX = 1180
"""Below it the pictures are smaller, and the curves have no room for their title."""
NO_LIMIT_PX = 16_777_215
TASKS = 4
"""Both are read, and of both the figures are worked out."""


class PairStore(Protocol):
    """What two sessions side by side need of the store; each is called in the background."""

    def session(self, session_id: str) -> Session: ...

    def figures_of(self, session_id: str) -> SessionFigures:
        """Its figures, with what a person left out or moved."""
        ...

    def picture(self, session_id: str, row: int) -> ByteImage | None: ...


class BesideScreen(QWidget):
    """``report`` and ``export`` ask for what is shown on paper and as tables, ``other`` for another session in place of
    the second; ``told`` a fault; ``arrived`` when both sessions are on the screen."""

    report = Signal(object)
    export = Signal(object)
    other = Signal()
    told = Signal(object)
    arrived = Signal()

    def __init__(self, theme: Theme, keys: Keys, background: Background, store: PairStore) -> None:
        super().__init__()
        self._theme, self._background, self._store = theme, background, store
        self._round = 0
        self._ids: tuple[str, str] = ("", "")
        self._affected = ""
        self._watched: tuple[Watched, Watched] | None = None
        self._shown: Shown | None = None
        self._step: InStep | None = None
        self._player_s = 0.0
        self._rows = [-1, -1]
        self._asked = [False, False]
        self.answer = heading(theme, wrap=True)
        self.basis = Text(theme, "", 16, REGULAR, "text2", wrap=True)
        self.other_button = Button(theme, self.tr("Compare with &another…"))
        self.report_button = Button(theme, self.tr("Report"), "primary", icon="file-text", hint="Ctrl+P", height_px=44)
        self.bar = ThinBar(theme, self.tr("How far reading is"))
        self.pictures = (BesidePicture(theme), BesidePicture(theme))
        self.mean = MeanCard(theme)
        self.player = BesidePlayer(theme)
        self.unfair = Text(theme, "", 14, SEMIBOLD, wrap=True)
        self.title = Text(theme, self.tr("Differences"), 20, SEMIBOLD)
        self.facts = ElidedText(theme, "", 14, REGULAR, "text2")
        self.followed = QComboBox()
        self.followed.setAccessibleName(self.tr("What is compared"))
        self.followed.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToContents)
        self.followed.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.mirror_button = Button(theme, self.tr("&Mirror"), "quiet", hint=keys["mirror"])
        self.mirror_button.setCheckable(True)
        self.mirror_button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.mirror_button.setToolTip(self.tr("Show the left hand as it would look as a right one"))
        self.export_button = Button(theme, self.tr("Export…"), hint="Ctrl+E")
        self.table = BesideTable(theme)
        self.limits = caption(theme, wrap=True)
        self._strip = Card(theme, 12, "warn_soft", "warn")
        self._card = Card(theme, 20)
        self._lay_out()
        self._connect(keys)
        theme.changed.connect(self._fit)
        theme.changed.connect(self._fit_soon)
        self._timer = QTimer(self)
        self._timer.setInterval(PLAY_EVERY_MS)
        self._timer.timeout.connect(self._play_on)
        self._show_parts(reading=False)

    # --- layout -------------------------------------------------------------------------------------------
    def _lay_out(self) -> None:
        said = in_column(self.answer, self.basis, gap=2)
        head = in_line((said, 1), gap=12)
        for button in (self.other_button, self.report_button):
            head.addWidget(button, 0, Qt.AlignmentFlag.AlignTop)
        line = in_line((Sign(self._theme, "warn"), 0, Qt.AlignmentFlag.AlignVCenter), (self.unfair, 1), gap=10)
        self._strip.body.setContentsMargins(16, 8, 16, 8)
        self._strip.body.addLayout(line)
        self._top = in_line(gap=12)
        for picture in self.pictures:
            self._top.addWidget(picture, 324)
        self._top.addSpacing(GAP_PX - 12)
        self._top.addWidget(self.mean, 556)
        title = self._title_row = in_line(gap=12)
        title.addLayout(in_column(self.title, self.facts, gap=0), 1)
        for widget in (self.followed, self.mirror_button, self.export_button):
            title.addWidget(widget)
        self._card.body.setContentsMargins(24, 10, 16, 10)
        self._card.body.setSpacing(4)
        self._card.body.addLayout(title)
        self._host = ScrolledColumn()
        in_column(self.table, self.limits, STRETCH, gap=8, margins=(0, 0, 8, 0), within=self._host)
        self._scroll = scroll_area(self._host, Qt.FocusPolicy.TabFocus)  # so that keys scroll it
        self._scroll.setAccessibleName(self.tr("Differences"))
        self._card.body.addWidget(self._scroll, 1)
        whole = in_column(
            head,
            self.bar,
            self._strip,
            (self._top, 5),
            self.player,
            (self._card, 5),
            gap=12,
            margins=(MARGIN_PX, GAP_PX - 4, MARGIN_PX, GAP_PX),
            within=self,
        )
        whole.addStretch(0)

    def resizeEvent(self, event: QResizeEvent) -> None:
        self._fit()

    def _fit_soon(self) -> None:
        """Again when every part has taken its new size."""
        QTimer.singleShot(0, self, self._fit)

    def _fit(self) -> None:
        """With large text smaller pictures and fewer words at the buttons."""
        tight = is_tight(self, self._theme)
        self.player.show_tight(tight)
        self.basis.setVisible(bool(self.basis.text()) and not tight)  # the table says it too
        self.other_button.set_face(self.tr("&Another…") if tight else self.tr("Compare with &another…"))
        self.report_button.set_face(self.report_button.text(), hint="" if tight else "Ctrl+P")
        self.export_button.set_face(self.export_button.text(), hint="" if tight else "Ctrl+E")
        narrow = tight or self.width() < NARROW_PX * self._theme.text_scale
        self.mean.title.setVisible(not narrow)
        least = 180 if narrow else 240
        for picture in self.pictures:
            picture.setMinimumSize(round(least * 4 / 3), least)
        self._scroll.setMinimumHeight(self._theme.px(70))
        needed = self._host.sizeHint().height()
        if self._host.hasHeightForWidth():
            needed = self._host.heightForWidth(max(self._scroll.width() - 16, 1))
        margins = self._card.body.contentsMargins()
        around = self._title_row.sizeHint().height() + self._card.body.spacing() + margins.top() + margins.bottom()
        self._card.setMaximumHeight(max(needed, self._theme.px(70)) + around + 4 if self._shown else NO_LIMIT_PX)
        layout = self.layout()
        assert isinstance(layout, QVBoxLayout)
        layout.setStretchFactor(self._top, 2 if tight else 5)

    def _connect(self, keys: Keys) -> None:
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setProperty("shows_own_focus", True)
        self.mean.quantity.currentIndexChanged.connect(lambda _: self._show_plot())
        self.mean.sought.connect(self._seek_share)
        self.followed.currentIndexChanged.connect(lambda _: self._compare())
        self.player.stepped.connect(self.step)
        self.player.play_toggled.connect(self.toggle_play)
        self.player.step_chosen.connect(lambda _: self._keep_in_step())
        self.player.sought.connect(self._seek_in)
        self.mirror_button.toggled.connect(lambda _: self._mirror())
        self.other_button.clicked.connect(self.other)
        self.report_button.clicked.connect(lambda: self._hand_over(self.report))
        self.export_button.clicked.connect(lambda: self._hand_over(self.export))
        actions = {
            "play": self.toggle_play, "frame_back": lambda: self.step(-1), "frame_on": lambda: self.step(1),
            "repetition_back": lambda: self.go_to_repetition(-1), "repetition_on": lambda: self.go_to_repetition(1),
            "mirror": self.mirror_button.click, "export": self.export_button.click,
            "report": self.report_button.click,
        }  # fmt: skip
        for name, action in actions.items():
            bind(self, keys, name, action)

    def _hand_over(self, signal) -> None:  # type: ignore[no-untyped-def]
        if self._shown is not None:
            self._stop()
            signal.emit(self._shown)

    # --- life ---------------------------------------------------------------------------------------------
    @property
    def shown(self) -> Shown | None:
        """What is on the screen; None while it is read."""
        return self._shown

    @property
    def ids(self) -> tuple[str, str]:
        """The sessions asked for; once they are shown in the order in which they stand."""
        return self._ids

    @property
    def player_s(self) -> float:
        """The player's time."""
        return self._player_s

    @property
    def in_step(self) -> InStep | None:
        """How both are played."""
        return self._step

    def begin(self, session_ids: tuple[str, str], affected: str = "") -> None:
        """Read two sessions in the background, then show them; ``affected`` is the patient's hand."""
        self._stop()
        self._round += 1
        number, self._ids, self._affected = self._round, session_ids, affected
        self._watched = self._shown = self._step = None
        self._rows, self._asked = [-1, -1], [False, False]
        self.answer.setText(self.tr("Reading both sessions…"))
        self.basis.setText("")
        self.bar.show_progress(0, TASKS)
        self.table.show_rows((), ())
        self.mean.curves.show_plot(None)
        for words in (self.facts, self.limits, self.unfair):
            words.setText("")
        for box in (self.mean.quantity, self.followed):
            box.blockSignals(True)
            box.clear()
            box.blockSignals(False)
        self.followed.hide()
        self.mirror_button.hide()
        for picture in self.pictures:
            picture.begin(None, self.tr("Reading the session…"))
        self._show_parts(reading=True)
        self.setFocus(Qt.FocusReason.OtherFocusReason)
        store, found = self._store, dict[str, Session]()
        watched: list[Watched] = []

        def failed(fault: Exception) -> None:
            if number == self._round:
                self._round += 1  # what else is under way is for nobody any more
                self._fail()
                self.told.emit(fault)

        def read(session_id: str, session: Session) -> None:
            if number == self._round:
                found[session_id] = session
                self.bar.show_progress(len(found), TASKS)
                if len(found) == len(session_ids):
                    self._show_first_pictures([found[one] for one in session_ids])
                    for one in session_ids:
                        measure(one)

        def measure(session_id: str) -> None:
            def work() -> Watched:
                return Watched.of(found[session_id], store.figures_of(session_id))

            def done(one: Watched) -> None:
                if number == self._round:
                    watched.append(one)
                    self.bar.show_progress(len(found) + len(watched), TASKS)
                    if len(watched) == len(session_ids):
                        self._show(watched[0], watched[1])

            self._background.run(work, done, failed, self)

        for session_id in session_ids:
            self._background.run(
                lambda one=session_id: store.session(one),  # type: ignore[misc]
                lambda session, one=session_id: read(one, session),  # type: ignore[misc]
                failed,
                self,
            )

    def end(self) -> None:
        """Stop playing."""
        self._stop()

    def _fail(self) -> None:
        self.answer.setText(self.tr("Nothing is compared: one of the two sessions could not be read."))
        self.basis.setText("")
        self._show_parts(reading=False)

    def _show_parts(self, *, reading: bool) -> None:
        ready = self._shown is not None
        self.bar.setVisible(reading)
        for widget in (self.player, self._card, self.mean, *self.pictures):
            widget.setVisible(ready or reading)  # everything has its place at once
        for control in (self.player, self.mean.quantity, self.followed, self.mirror_button):
            control.setEnabled(ready)
        self._fit()
        self._strip.setVisible(ready and bool(self.unfair.text()))
        for button in (self.report_button, self.export_button):
            button.setEnabled(ready)
        self.other_button.setEnabled(not reading)
        layout = self.layout()
        assert isinstance(layout, QVBoxLayout)
        layout.setStretch(layout.count() - 1, 0 if ready or reading else 1)

    def _show_first_pictures(self, sessions: list[Session]) -> None:
        """As soon as both are read, the right hand and the newer one first; the figures follow."""
        for place, session in enumerate(sessions):
            self.pictures[place].begin(session)
            if len(session):
                self._ask_picture(place, 0)

    def _show(self, one: Watched, other: Watched) -> None:
        first, _ = ordered(one.figures, other.figures, self._affected)  # type: ignore[arg-type]
        self._watched = (one, other) if first is one.figures else (other, one)
        self._ids = tuple(watched.session.header.session_id for watched in self._watched)  # type: ignore[assignment]
        self._rows, self._asked = [-1, -1], [False, False]
        for picture, watched in zip(self.pictures, self._watched, strict=True):
            if picture.session is not watched.session:
                picture.begin(watched.session)
        self.followed.blockSignals(True)
        self.followed.clear()
        for value, words in kinds(*self._watched):
            self.followed.addItem(words, value)
        self.followed.blockSignals(False)
        self.followed.setVisible(self.followed.count() > 0)
        sides = [watched.figures.side for watched in self._watched]
        self.mirror_button.setVisible("left" in sides)
        self.mirror_button.blockSignals(True)
        self.mirror_button.setChecked(sides[0] != sides[1])
        self.mirror_button.blockSignals(False)
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
        what = self.followed.currentData()
        now = self._shown = shown(*self._watched, what if isinstance(what, str) else "")
        answer, basis = now.head
        self.answer.setText(answer)
        self.basis.setText(basis)
        self.unfair.setText(unfair_words(now.both) or " ".join(doubts(now.both)))
        self._strip.setVisible(bool(self.unfair.text()))
        self.facts.setText(now.facts)
        self.facts.setToolTip(plain_tooltip(now.facts))
        self.table.show_rows(now.heads, now.rows)
        words = [limit_words(now.both.first.study)]
        if now.both.relation == "hands":
            words.append(other_hand_words())
        self.limits.setText(" ".join(words))
        box = self.mean.quantity
        box.blockSignals(True)
        box.clear()
        for quantity in now.quantities:
            box.addItem(quantity_name(quantity), quantity)
        box.setCurrentIndex(now.quantities.index(now.main_quantity))
        box.blockSignals(False)
        self._show_plot()
        self._fit()
        self._fit_soon()

    @property
    def quantity(self) -> Quantity:
        """The angle whose curves are shown."""
        assert self._shown is not None
        return self._shown.quantities[max(self.mean.quantity.currentIndex(), 0)]

    def _show_plot(self) -> None:
        if self._shown is not None:
            self.mean.curves.show_plot(self._shown.plot(self.quantity))
            self._show_place()

    # --- time ---------------------------------------------------------------------------------------------
    def _repetitions(self) -> tuple[tuple[ShownRepetition, ...], tuple[ShownRepetition, ...]]:
        assert self._watched is not None
        one, other = self._watched
        return one.figures.repetitions, other.figures.repetitions

    def _ends_s(self) -> tuple[float, float]:
        assert self._watched is not None
        one, other = (float(watched.seen.time_s[-1]) if len(watched.seen.time_s) else 0.0 for watched in self._watched)
        return one, other

    def _keep_in_step(self, *, at_start: bool = False) -> None:
        """Another way to keep both in step: the first stays where it is."""
        if self._watched is None or self._shown is None:
            return
        step: Step = {"start": "start", "time": "time"}.get(str(self.player.step.currentData()), "part")  # type: ignore[assignment]
        before = self._step
        at_s = before.at(self._player_s)[0] if before is not None else 0.0
        self._step = in_step(*self._repetitions(), self._ends_s(), step)
        self.player.show_sessions(self._shown.names, self._ends_s(), self._repetitions())
        starts = self._step.starts_s
        self.seek((starts[0] if starts else 0.0) if at_start else self._step.when_first(at_s))

    def seek(self, player_s: float) -> None:
        """Put both where they are at a moment of the player."""
        if self._step is not None:
            self._player_s = float(np.clip(player_s, 0.0, self._step.end_s))
            self._show_place()

    def _seek_in(self, place: int, time_s: float) -> None:
        """One of the two was put on a time."""
        if self._step is not None:
            self.seek(self._step.when_second(time_s) if place else self._step.when_first(time_s))

    def _seek_share(self, share: float) -> None:
        """A place in the mean repetition was pointed at: there in the repetition that is shown."""
        if self._step is None:
            return
        number = self._current(0)
        repetitions = self._repetitions()[0]
        if 0 <= number < len(repetitions):
            rep = repetitions[number]
            self.seek(self._step.when_first(rep.start_s + share * (rep.end_s - rep.start_s)))

    def step(self, pictures: int) -> None:
        """Go some pictures on or back."""
        if self._step is not None and self._watched is not None:
            times = self._watched[0].seen.time_s
            period_s = float(np.median(np.diff(times))) if len(times) > 1 else 1.0 / 30.0
            self.seek(self._player_s + pictures * period_s)

    def toggle_play(self) -> None:
        """Play from here, or stop."""
        if self._timer.isActive():
            self._stop()
        elif self._step is not None:
            if self._player_s >= self._step.end_s - 1e-3:
                self.seek(0.0)
            self._timer.start()
            self.player.show_playing(True)

    def _stop(self) -> None:
        self._timer.stop()
        self.player.show_playing(False)

    def _play_on(self) -> None:
        if self._step is None:
            self._stop()
            return
        self.seek(self._player_s + 0.001 * PLAY_EVERY_MS * self.player.factor)
        if self._player_s >= self._step.end_s - 1e-6:
            self._stop()

    def go_to_repetition(self, by: int) -> None:
        """The start of the next repetition, or of this one or the one before."""
        if self._step is None:
            return
        starts = self._step.starts_s or tuple(rep.start_s for rep in self._repetitions()[0])
        if by > 0:
            later = [start for start in starts if start > self._player_s + 1e-3]
            wanted = later[:1]
        else:
            earlier = [start for start in starts if start < self._player_s - 0.3]
            wanted = earlier[-1:] or list(starts[:1])
        if wanted:
            self.seek(wanted[0])

    def _current(self, place: int) -> int:
        """The repetition that one of the two is in, from 0; -1 between them."""
        assert self._step is not None
        time_s = self._step.at(self._player_s)[place]
        inside = [
            number
            for number, rep in enumerate(self._repetitions()[place])
            if rep.start_s - 1e-6 <= time_s <= rep.end_s + 1e-6
        ]
        return inside[-1] if inside else -1

    def _share(self, place: int) -> float:
        """How far one of the two is in its repetition; NaN between them."""
        assert self._step is not None
        number = self._current(place)
        if number < 0:
            return math.nan
        rep = self._repetitions()[place][number]
        time_s = self._step.at(self._player_s)[place]
        return min(max((time_s - rep.start_s) / max(rep.end_s - rep.start_s, 1e-6), 0.0), 1.0)

    # --- pictures -----------------------------------------------------------------------------------------
    def _show_place(self) -> None:
        if self._step is None or self._watched is None or self._shown is None:
            return
        times_s = self._step.at(self._player_s)
        for place in (0, 1):
            row = _row_at(self._watched[place].seen.time_s, times_s[place])
            if row != self._rows[place]:
                self._rows[place] = row
                self.pictures[place].show_row(row)
                if row >= 0:
                    self._ask_picture(place, row)
        self._show_words()
        self.mean.curves.show_shares((self._share(0), self._share(1)))
        currents = (self._current(0), self._current(1))
        self.player.show_places(times_s, currents, self._ends_s(), self._repetitions())

    def _show_words(self) -> None:
        assert self._watched is not None
        for place in (0, 1):
            picture, watched, other = self.pictures[place], self._watched[place], self._watched[1 - place]
            number = self._current(place)
            repetition = self.tr("Repetition {number}").format(number=number + 1) if number >= 0 else ""
            name = picture_words(watched.figures, other.figures, self._affected, mirrored=picture.mirrored)
            picture.show_words(name, repetition, self._value_words(watched, self._rows[place]))

    def _value_words(self, watched: Watched, row: int) -> str:
        """``Flexion 37° ± 2°`` where the angle was seen."""
        joint, angle = self.quantity
        values = watched.seen.of(self.quantity)
        value = sign_of(self.quantity) * float(values[row]) if 0 <= row < len(values) else math.nan
        if not math.isfinite(value):
            return self.tr("not seen")
        if joint:
            figure = figure_of(joint)
            said = with_side(value, figure.finger) if figure.row == "spread" else numbers.signed_degrees(value)
            return f"{figure.row_name} {said}"
        sd = float(np.degrees(watched.sds_rad[row, angle]))
        return f"{terms.movement_name(SIDES[angle][0 if value >= 0 else 1])} {numbers.with_spread(value, sd)}"

    def _mirror(self) -> None:
        if self._watched is None:
            return
        for picture, watched in zip(self.pictures, self._watched, strict=True):
            picture.set_mirrored(self.mirror_button.isChecked() and watched.figures.side == "left")
        self._show_words()

    def _ask_picture(self, place: int, row: int) -> None:
        """Of each one picture at a time is read; the newest wish follows when it has come."""
        if self._asked[place]:
            return
        self._asked[place] = True
        number, store, session = self._round, self._store, self.pictures[place].session
        if session is None:
            return
        session_id = session.header.session_id

        def came(picture: ByteImage | None) -> None:
            if number != self._round or self.pictures[place].session is not session:
                return  # others are shown meanwhile
            self._asked[place] = False
            if picture is not None or self.pictures[place].image is None:
                self.pictures[place].show_picture(picture)
            if self._rows[place] not in (row, -1):
                self._ask_picture(place, self._rows[place])

        def failed(fault: Exception) -> None:
            if number == self._round:
                self._asked[place] = True  # it would fail again with each picture
                self._stop()
                self.told.emit(fault)

        self._background.run(lambda: store.picture(session_id, row), came, failed, self)


def _row_at(time_s: np.ndarray, at_s: float) -> int:
    """Row of the frame nearest to a time; -1 without any."""
    if not len(time_s):
        return -1
    after = int(np.clip(np.searchsorted(time_s, at_s), 0, len(time_s) - 1))
    return after - 1 if after and at_s - time_s[after - 1] < time_s[after] - at_s else after
