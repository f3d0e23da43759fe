"""A wrong or missing marker put right at any picture, and the session tracked again from there."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QPushButton, QSizePolicy, QWidget

from carpus.core.results.figures import SessionFigures, session_figures
from carpus.core.results.seen import JointCurves, joint_curves, session_curves
from carpus.core.rounding import written
from carpus.core.session.marker_doubts import NameDoubt
from carpus.core.session.values import Session
from carpus.core.types import ByteImage, FloatArray, TrackStatus
from carpus.ui import numbers
from carpus.ui.background import Background
from carpus.ui.controls.button import ENTER, Button
from carpus.ui.controls.card import Card, KeyCaps
from carpus.ui.controls.layouts import STRETCH, Fitted, empty, fill, in_column, in_line, scrolled
from carpus.ui.controls.text import MEDIUM, REGULAR, SEMIBOLD, ElidedText, Sign, StateText, Text
from carpus.ui.correct.picture import CorrectionPicture
from carpus.ui.correct.places import Places
from carpus.ui.figures import figure_of
from carpus.ui.keys import KEYS, bind_screen
from carpus.ui.marker_words import finger_of, marker_name
from carpus.ui.playback.pictures import RowReader, plain_ground
from carpus.ui.playback.transport import Scrubber, Transport, clock_words
from carpus.ui.plot.session import HandPlot, SessionChart, SessionPlot
from carpus.ui.theme import GAP_PX, MARGIN_PX, Theme, is_tight

if TYPE_CHECKING:
    from carpus.core.records.corrections import Corrections

ARROWS = {
    Qt.Key.Key_Left: (-1.0, 0.0), Qt.Key.Key_Right: (1.0, 0.0), Qt.Key.Key_Up: (0.0, -1.0), Qt.Key.Key_Down: (0.0, 1.0),
}  # fmt: skip
BIG_STEP_PX = 10.0
FAR_MM = 8.0
"""Further than this from where the others expect it a marker is worth a look."""


class CorrectScreen(Fitted):
    """``wanted`` carries the session's identity and the corrections; ``done`` asks to go back; ``told`` a fault."""

    wanted = Signal(str, object)
    done = Signal()
    told = Signal(object)

    def __init__(self, theme: Theme, background: Background, store: Corrections) -> None:
        super().__init__()
        self._theme = theme
        self._caps = KeyCaps(theme, [])
        self._session_id = ""
        self._session: Session | None = None
        self._figures: SessionFigures | None = None
        self._joints: JointCurves | None = None
        self._finger = 0
        """Whose curves are shown; 0 for the wrist."""
        self.places: Places | None = None
        self._time_s = np.empty(0)
        self.row = 0
        self._spots: FloatArray = np.empty((0, 2))
        self.current = ""
        self.picture = CorrectionPicture(theme)
        self.reader = RowReader(background, self, store.moment, self._show_moment, self.told.emit)
        self.transport = Transport(theme)
        self.time = Text(theme, "", 14, MEDIUM)
        self.scrubber = Scrubber(theme)
        self.curves = SessionChart(theme)
        self.curves.show_single(True)
        self.step = StateText(theme)
        self.title = Text(theme, "", 28, SEMIBOLD, wrap=True)
        self.hint = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.although = Button(theme, self.tr("Track again although &doubtful"), "quiet", height_px=32)
        self.although.hide()
        self.rows: dict[str, MarkerRow] = {}
        self._rows = in_column(gap=0)
        self.next_doubtful = Button(
            theme, self.tr("Next doubtful picture"), "quiet", hint=KEYS["correct_doubtful"], height_px=36
        )
        self.hide_button = Button(
            theme, self.tr("Not to be seen here"), "quiet", hint=KEYS["correct_hide"], height_px=36
        )
        self.primary = Button(theme, self.tr("Track again from here"), "primary", hint=ENTER)
        self.cancel = Button(theme, self.tr("Cancel"), height_px=52)
        self.cancel.setToolTip(self.tr("Back to the review (Esc)"))
        self._lay_out()
        self._connect()

    def _lay_out(self) -> None:
        left = in_column((self.picture, 452), gap=8)
        left.addLayout(in_line(self._caps, STRETCH))
        player = Card(self._theme, 0)
        line = in_line(self.transport, 32, STRETCH, self.time, 8, (self.scrubber, 6), 8, gap=4, margins=(12, 7, 16, 7))
        player.body.addLayout(line)
        fill(left, player, (self.curves, 200))
        right = in_column(self.step, self.title, self.hint, gap=8, margins=(0, 0, 0, 0))
        card = Card(self._theme, 16)
        card.body.addWidget(Text(self._theme, self.tr("At this picture: distance to its place"), 14, SEMIBOLD))
        column = in_column(self._rows, STRETCH)
        card.body.addWidget(scrolled(column), 1)
        fill(right, (card, 1), in_line(self.hide_button, STRETCH), self.next_doubtful, self.although)
        right.addLayout(in_line((self.primary, 1), self.cancel, gap=12))
        self._column = QWidget()
        self._column.setLayout(right)
        in_line((left, 1), self._column, gap=MARGIN_PX, margins=(MARGIN_PX, GAP_PX, MARGIN_PX, GAP_PX), within=self)
        self._theme.changed.connect(self._fit)
        self._fit()

    def _say_keys(self) -> None:
        """What a key does, of those that do something here."""
        said = [
            (self.tr("Drag"), self.tr("move a name")), (KEYS["correct_hide"], self.tr("not to be seen here")),
            (f"{KEYS['correct_back']} {KEYS['correct_on']}", self.tr("picture")),
            (KEYS["correct_undo"], self.tr("undo")),
        ]  # fmt: skip
        if self._doubtful().size:
            said.append((KEYS["correct_doubtful"], self.tr("next doubtful")))
        self._caps.set_keys(said)

    def _fit(self) -> None:
        self._say_keys()
        tight = is_tight(self, self._theme)
        self._column.setFixedWidth(self._theme.px(376))
        self.curves.setVisible(not tight and self.height() >= 600 * self._theme.text_scale)
        self.next_doubtful.setVisible(bool(self._doubtful().size) and not self.although.isVisibleTo(self))
        self.primary.set_face(self.primary.text(), hint="" if tight else ENTER)

    def _connect(self) -> None:
        self.picture.dropped.connect(self.put)
        self.picture.chosen.connect(self.choose)
        self.picture.missed.connect(self._clicked_beside)
        self.scrubber.sought.connect(self._seek)
        self.transport.stepped.connect(self.go_on)
        self.curves.cursor_moved.connect(self._seek)
        self.primary.clicked.connect(self._go)
        self.cancel.clicked.connect(self.leave)
        self.hide_button.clicked.connect(self.hide_current)
        self.next_doubtful.clicked.connect(self.go_to_doubtful)
        self.although.clicked.connect(self._track_again)
        for button in (self.hide_button, self.next_doubtful, self.although):
            button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        actions = {
            "correct_back": lambda: self.go_on(-1), "correct_on": lambda: self.go_on(1),
            "correct_hide": self.hide_current, "correct_undo": self.undo, "correct_doubtful": self.go_to_doubtful,
        }  # fmt: skip
        bind_screen(self, actions)

    # --- life ---------------------------------------------------------------------------------------------
    def begin(self, session_id: str, session: Session, row: int) -> None:
        self._session_id, self._session = session_id, session
        self.places = Places(session)
        self._figures = session_figures(session)
        self._curves, self._joints = session_curves(session), joint_curves(session)
        self._time_s = self._curves.time_s
        self.current = ""
        empty(self._rows)
        self.rows = {}
        for name in self.places.markers:
            line = MarkerRow(self._theme, marker_name(name))
            line.clicked.connect(lambda _=False, name=name: self.choose(name))
            line.nudged.connect(self._nudge)
            self.rows[name] = line
            self._rows.addWidget(line)
        self.picture.clear(self.tr("Reading the picture…"))
        self.picture.set_hand_area(session.calibration.clicks.pixel)
        self.row = -1
        joint = self._figures.exercise.joint
        self._show_curves(figure_of(joint).finger if joint and self._joints is not None else 0)
        self.scrubber.show_session(float(self._time_s[-1]), self._figures.repetitions, -1)
        self.reader.begin(session_id)
        self.show_row(row)
        self._fit()
        self.setFocus(Qt.FocusReason.OtherFocusReason)

    def _show_curves(self, finger: int) -> None:
        if self._session is None or self._figures is None:
            return
        self._finger = finger
        shown = (self._curves, self._figures.exercise, self._figures.repetitions, -1)
        hand = finger and self._joints is not None
        self.curves.show_plot(HandPlot(*shown, joints=self._joints, finger=finger) if hand else SessionPlot(*shown))
        if self.row >= 0:
            self.curves.set_time(float(self._time_s[self.row]))

    def _doubtful(self) -> np.ndarray:
        if self._session is None:
            return np.empty(0, dtype=int)
        doubted = self._session.markers.doubted.any(axis=1) | (self._session.status == TrackStatus.DOUBTFUL)
        return np.flatnonzero(doubted)

    # --- time ---------------------------------------------------------------------------------------------

    def show_row(self, row: int) -> None:
        if self._session is None:
            return
        row = int(np.clip(row, 0, len(self._session) - 1))
        if row != self.row:
            self.row = row
            self._spots = np.empty((0, 2))
            self.curves.set_time(float(self._time_s[row]))
            self.time.setText(clock_words(float(self._time_s[row]), float(self._time_s[-1])))
            self.scrubber.show_time(float(self._time_s[row]))
            self.reader.ask(row)
        self._refresh()

    def go_on(self, pictures: int) -> None:
        self.show_row(self.row + pictures)

    def _seek(self, time_s: float) -> None:
        if self._session is not None:
            self.show_row(int(np.clip(np.searchsorted(self._time_s, time_s), 0, len(self._time_s) - 1)))

    def go_to_doubtful(self) -> None:
        """The next picture that is doubtful and not next to this one."""
        rows = self._doubtful()
        if not rows.size:
            return
        begins = rows[np.flatnonzero(np.diff(rows, prepend=-9) > 1)]
        after = begins[begins > self.row]
        self.show_row(int(after[0] if after.size else begins[0]))

    def _show_moment(self, row: int, moment: tuple[ByteImage | None, FloatArray]) -> None:
        if row != self.row or self._session is None or self.places is None:
            return  # the one that is shown follows
        picture_rgb, self._spots = moment
        self.picture.show_frame(plain_ground(self._session.camera) if picture_rgb is None else picture_rgb)
        self.picture.show_moment(self.places, row, self._spots, has_picture=picture_rgb is not None)
        self._refresh()

    # --- what a person says -------------------------------------------------------------------------------
    def choose(self, name: str) -> None:
        self.current = name
        if finger_of(name) != self._finger and self._joints is not None:
            self._show_curves(finger_of(name))
        self._refresh()

    def put(self, name: str, pixel: FloatArray) -> None:
        if self.places is not None:
            self.places.put(self.row, name, pixel, self._spots)
            self.choose(name)

    def _clicked_beside(self, pixel: FloatArray) -> None:
        """With a name chosen in the list, a click is its place."""
        if self.current:
            self.put(self.current, pixel)

    def _nudge(self, key: int, big: bool) -> None:
        """An arrow moves the chosen marker, from where it is or where the model has it."""
        if self.places is None or not self.current:
            return
        number = self.places.markers.index(self.current)
        start = self.places.now(self.row)[number]
        if not np.isfinite(start).all():
            start = self.places.modelled(self.row)[number]
        if np.isfinite(start).all():
            step = (BIG_STEP_PX if big else 1.0) * np.array(ARROWS[Qt.Key(key)])
            self.places.put(self.row, self.current, start + step, np.empty((0, 2)))
            self._refresh()

    def hide_current(self) -> None:
        if self.places is not None and self.current:
            self.places.hide(self.row, self.current)
            self._refresh()

    def undo(self) -> None:
        if self.places is not None:
            row = self.places.undo()
            if row >= 0:
                self.show_row(row)
                self._refresh()

    def leave(self) -> None:
        """Esc: let go of what is dragged, else back to the review."""
        if not self.picture.cancel_drag():
            self.done.emit()

    def _go(self) -> None:
        """What the primary says: mend what is plainly wrong with the names, else track again."""
        if self.places is None or not self.places.corrections():
            return
        found = self.places.doubt()
        if found is None:
            self._track_again()
        elif found[1].exchanged is not None:
            self.places.exchange(found[0], *found[1].exchanged)
            self.show_row(found[0])
        elif found[0] != self.row:
            self.show_row(found[0])
        else:
            self.undo()

    def _track_again(self) -> None:
        if self.places is not None and self.places.corrections():
            self.wanted.emit(self._session_id, self.places.corrections())

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter) and self.primary.isEnabled():
            self._go()
        elif event.key() in ARROWS and self.current:
            self._nudge(event.key(), bool(event.modifiers() & Qt.KeyboardModifier.ShiftModifier))
        else:
            super().keyPressEvent(event)

    # --- showing ------------------------------------------------------------------------------------------
    def _refresh(self) -> None:
        places, session = self.places, self._session
        if places is None or session is None or self.row < 0:
            return
        at = numbers.clock_tenths(float(self._time_s[self.row]))
        doubtful = bool(session.markers.doubted[self.row].any()) or session.status[self.row] == TrackStatus.DOUBTFUL
        changed = places.changed(self.row)
        state = self.tr("Doubtful at {time}") if doubtful else self.tr("Picture at {time}")
        self.step.show_state("warn" if doubtful else "none", state.format(time=at))
        name = marker_name(self.current) if self.current else ""
        self.title.setText(
            self.tr("Put “{marker}” on its disc").format(marker=name) if name else self.tr("Which name is wrong?")
        )
        if self.picture.has_picture:
            self.hint.setText(self.tr("Drag a name in the picture, or choose it below and click its disc."))
        elif self.picture.image is None:  # it is being read
            self.hint.clear()
        else:
            pattern = self.tr("No pictures stored: the {count} blue spots of this moment. Drag a name to its spot.")
            self.hint.setText(pattern.format(count=len(self._spots)))
        now = places.now(self.row)
        for number, (marker, line) in enumerate(self.rows.items()):
            seen = bool(np.isfinite(now[number]).all())
            off = places.off_mm(self.row, marker)
            was = places.off_mm(self.row, marker, as_tracked=True) if marker in changed else math.nan
            line.show_line(off, was, seen=seen, changed=marker in changed, chosen=marker == self.current, far_mm=FAR_MM)
        self.hide_button.setEnabled(bool(self.current))
        self.picture.current = self.current
        self.picture.heads = [at]
        if changed:
            words = [marker_name(marker) for marker in changed]
            self.picture.heads.append(self.tr("Changed here: {markers}").format(markers=", ".join(words)))
        self.picture.update()
        some = bool(places.corrections())
        self.primary.setEnabled(some)
        first = places.corrections()[0].row if some else 0
        again = self.tr("Track again from {time}").format(time=numbers.clock_tenths(float(self._time_s[first])))
        found = places.doubt()
        self.although.setVisible(found is not None)
        self.next_doubtful.setVisible(bool(self._doubtful().size) and found is None)
        if found is not None:
            self._show_doubt(*found)
        else:
            self.primary.set_face(again if some else self.tr("Nothing changed yet"))
        self.setAccessibleName(self.title.text())

    def _show_doubt(self, row: int, doubt: NameDoubt) -> None:
        """In place of what was asked: what is wrong with the names, and what mends it."""
        at = numbers.clock_tenths(float(self._time_s[row]))
        self.step.show_state("warn", self.tr("Look at the names at {time}").format(time=at))
        if doubt.exchanged is not None:
            one, other = (marker_name(name) for name in doubt.exchanged)
            self.title.setText(self.tr("“{one}” and “{other}” look exchanged").format(one=one, other=other))
            self.hint.setText(self.tr("So the angles would be wrong from there on. Let the two change places?"))
            self.primary.set_face(self.tr("Change the two names"))
            return
        words = self.tr("“{marker}” cannot be there").format(marker=marker_name(doubt.alone))
        self.title.setText(words)
        far = self.tr("It lies {size} mm from where the other discs let it be. It may be another disc, or no disc.")
        self.hint.setText(far.format(size=written(1000.0 * doubt.off_m)))
        here = row == self.row
        self.primary.set_face(self.tr("Take the last step back") if here else self.tr("Show that picture"))


ROW_PX = 34
MOVES = (Qt.Key.Key_Left, Qt.Key.Key_Right, Qt.Key.Key_Up, Qt.Key.Key_Down)


class MarkerRow(QPushButton):
    """``nudged`` carries an arrow key, and whether Shift was held."""

    nudged = Signal(int, bool)

    def __init__(self, theme: Theme, name: str) -> None:
        super().__init__()
        self._theme, self._name = theme, name
        self._sign = Sign(theme, "good", 18, (18, 20))
        self._said, self._value = ElidedText(theme, name, 14, MEDIUM), Text(theme, "", 14, REGULAR)
        self._value.setObjectName("value")
        row = in_line(gap=10, margins=(8, 0, 8, 0), within=self)
        for part in (self._sign, self._said, self._value):
            part.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
            row.addWidget(part, int(part is self._said))
        self.on_enter = "pass"
        self.setCheckable(True)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        theme.changed.connect(self.updateGeometry)

    def show_line(
        self, off_mm: float, was_mm: float, *, seen: bool, changed: bool, chosen: bool, far_mm: float
    ) -> None:
        """``off_mm`` from its place now, ``was_mm`` before a change; NaN where nobody knows."""
        now = self.tr("{size} mm").format(size=numbers.fixed(off_mm, 1)) if math.isfinite(off_mm) else "–"
        if not seen:
            now = self.tr("hidden")
        if changed and math.isfinite(was_mm):
            now = self.tr("{now}, was {size} mm").format(now=now, size=written(was_mm))
        far = seen and math.isfinite(off_mm) and off_mm > far_mm
        self._sign.show_sign("warn" if far else "predicted" if changed else "partly" if not seen else "good")
        self._value.setText(now)
        self._said.set_look("text", SEMIBOLD if chosen else MEDIUM)
        self.setChecked(chosen)
        self.setAccessibleName(f"{self._name}, {now}")
        self.setToolTip(f"{self._name}, {now}")

    def sizeHint(self) -> QSize:
        return QSize(300, self._theme.px(ROW_PX))

    def minimumSizeHint(self) -> QSize:
        return QSize(200, self._theme.px(ROW_PX))

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() in MOVES and self.isChecked():
            self.nudged.emit(event.key(), bool(event.modifiers() & Qt.KeyboardModifier.ShiftModifier))
        elif event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            event.ignore()  # Enter tracks again, wherever the keyboard is
        else:
            super().keyPressEvent(event)
