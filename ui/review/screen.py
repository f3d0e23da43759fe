"""The review: picture and curves in step, repetitions to correct, range of motion, on to the report."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import datetime, timedelta

import numpy as np
from PySide6.QtCore import QEvent, QObject, Qt, QTimer, Signal
from PySide6.QtGui import QPainter, QResizeEvent
from PySide6.QtWidgets import QBoxLayout, QScrollArea, QWidget

from carpus.core.hand.exercises import FLEXION, SIDES
from carpus.core.measures.by_hand import HandValue, of_session
from carpus.core.results.camera_said import UNKNOWN_CAMERA, CameraSaid
from carpus.core.results.figures import SessionFigures, session_figures
from carpus.core.results.hand_cutout import drawn_angle
from carpus.core.results.motion_curves import MotionCurves, motion_curves
from carpus.core.results.progress import limits_of, other_hand_of, previous_of
from carpus.core.results.repetition_rows import PASSIVE, RepetitionChoices
from carpus.core.results.seen import JointCurves, ReportCurves, joint_curves, session_curves
from carpus.core.results.side_by_side import partner_of
from carpus.core.session.values import Session
from carpus.core.types import ByteImage, FloatArray, TrackStatus
from carpus.ui import numbers, terms
from carpus.ui.background import Background
from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Card
from carpus.ui.controls.column import ScrolledColumn
from carpus.ui.controls.field import ChoiceButton, Choices
from carpus.ui.controls.layouts import STRETCH, in_column, in_line
from carpus.ui.controls.text import REGULAR, SEMIBOLD, ElidedText, Text
from carpus.ui.controls.tooltip import plain_tooltip
from carpus.ui.controls.words_table import WordsTable
from carpus.ui.figures import FINGERS, figure_of
from carpus.ui.keys import Keys, bind
from carpus.ui.marker_words import finger_name
from carpus.ui.picture.photo import label_size, paint_label
from carpus.ui.picture.view import PictureView
from carpus.ui.plot.motion import MotionKind, MotionPlot
from carpus.ui.plot.session import HandPlot, SessionPlot, row_at, value_at
from carpus.ui.plot.session_view import EDGES_S, CurveView
from carpus.ui.plot.ways import finger_ways, wrist_way
from carpus.ui.plot.ways_view import WaysView
from carpus.ui.ports import SessionStore, StoredResult
from carpus.ui.report.active_passive import active_passive
from carpus.ui.report.further_rows import further_rows, further_title
from carpus.ui.report.hand_rows import column_heads, finger_rows, limits_words
from carpus.ui.report.main_figure import main_figure
from carpus.ui.report.tables import column_names, repetition_words, table_rows
from carpus.ui.report.words import corrected_words
from carpus.ui.review.film import STILL, FilmSheet, FilmWanted, paint_angle
from carpus.ui.review.player import Player
from carpus.ui.review.reason import ReasonSheet
from carpus.ui.review.results import ResultChoice
from carpus.ui.review.skeleton import modelled_px, paint_palm, paint_skeleton, paint_trails
from carpus.ui.review.tables import FurtherTable, HandTable, RangeTable
from carpus.ui.theme import GAP_PX, MARGIN_PX, Theme, is_tight
from carpus.ui.tour.bubble import LEAST_SCREEN_PX, BubbleView
from carpus.ui.translate import inside

PLAY_EVERY_MS = 40
WRIST = -1
"""Instead of a finger's number: the wrist's three angles."""
TRAIL_S = 1.0
"""How far back the way of the fingertips is drawn."""
EDGE_STEP_S = 0.1
LEAST_TABLE_PX = 84
"""The head of the table and two rows."""


@dataclass(frozen=True, slots=True)
class Reviewed:
    """What the background reads for one session."""

    session: Session
    choices: RepetitionChoices
    history: Sequence[SessionFigures]
    camera: CameraSaid
    results: Sequence[StoredResult] = ()
    by_hand: Sequence[HandValue] = ()


class ReviewScreen(QWidget):
    """``report`` and ``export`` carry the session's identity, ``beside`` with it that of the session to be held against
    it; ``told`` a fault; ``again`` asks for another set; ``arrived`` when a session is on the screen; ``correct``
    carries the session and the row whose markers are to be put right, ``result`` another result of the recording,
    ``film`` a repetition to be written as a film."""

    report = Signal(str)
    beside = Signal(str, str)
    export = Signal(str)
    again = Signal()
    correct = Signal(str, object, int)
    result = Signal(str)
    film = Signal(FilmWanted)
    told = Signal(object)
    arrived = Signal()

    def __init__(self, theme: Theme, keys: Keys, background: Background, store: SessionStore) -> None:
        super().__init__()
        self._theme, self._background, self._store = theme, background, store
        self._session: Session | None = None
        self._session_id = ""
        self._choices = RepetitionChoices()
        self._history: Sequence[SessionFigures] = ()
        self._partner: SessionFigures | None = None
        self._camera = UNKNOWN_CAMERA
        self._by_hand: Sequence[HandValue] = ()
        self._curves: ReportCurves | None = None
        self._joints: JointCurves | None = None
        self._motion: MotionCurves | None = None
        self._modelled_px: FloatArray | None = None
        self.figures: SessionFigures | None = None
        self._time_s = 0.0
        self._current = -1
        self._row = -1
        self._asked_row = -1
        self.picture = PictureView(theme, (480, 360))
        self.picture.overlay = self._paint_overlay
        self.curves = CurveView(theme)
        self.ways = WaysView(theme)
        self.ways.hide()
        self.player = Player(theme)
        self.table = RangeTable(theme)
        self.hand_table = HandTable(theme)
        self.further = FurtherTable(theme)
        self.ways_said = Text(theme, "", 16, SEMIBOLD, wrap=True)
        self.ways_table = WordsTable(theme)
        self.ways_note = Text(theme, "", 12, REGULAR, "text2", wrap=True)
        self.limits = Text(theme, "", 12, REGULAR, "text2", wrap=True)
        fingers: list[tuple[object, str]] = [(0, self.tr("All fingers"))]
        fingers += [(finger, finger_name(str(finger))) for finger in FINGERS]
        self.finger = Choices(theme, [*fingers, (WRIST, self.tr("Wrist"))])
        self.notes = Text(theme, "", 14, REGULAR, wrap=True)
        self.title = Text(theme, self.tr("Range of motion"), 16, SEMIBOLD)
        self.title.setMinimumWidth(1)
        self.count = ElidedText(theme, "", 14, REGULAR, "text2")  # one line: what it says comes when all has its place
        self.again_button = Button(theme, self.tr("Another set"), "quiet", icon="plus")
        self.count_button = Button(theme, self.tr("Do not count"), "quiet")
        self.count_button.setFocusPolicy(Qt.FocusPolicy.TabFocus)  # Space stays with the player after a click
        self.count_button.setToolTip(self.tr("The session stays, and is compared with none. Can be taken back."))
        self.beside_button = Button(theme, self.tr("Side by side…"), "quiet")
        self.beside_button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.export_button = Button(theme, self.tr("Export…"), hint="Ctrl+E")
        self.report_button = Button(
            theme, self.tr("Make report"), "primary", icon="file-text", hint="Ctrl+P", height_px=44
        )
        self.correct_button = Button(theme, self.tr("Put markers right…"), "plain", height_px=36)
        self.correct_button.setParent(self.picture)
        self.correct_button.setProperty("floats", True)
        self.correct_button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.correct_button.setToolTip(self.tr("A marker is wrong or missing here (Shift+F10)"))
        self.angle_button = ChoiceButton(theme, self.tr("Angle"), height_px=36)
        self.angle_button.setToolTip(self.tr("The angle drawn on the picture (A)"))
        self.angle_button.toggled.connect(lambda _: self.picture.update())
        self.angle_button.toggled.connect(lambda _: self._place_button())
        self.film_button = Button(theme, self.tr("Film…"), "plain", height_px=36)
        self.film_button.setToolTip(self.tr("This repetition as a film, or this picture, of the hand alone (F)"))
        for button in (self.angle_button, self.film_button):
            button.setParent(self.picture)
            button.setProperty("floats", True)
            button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
            button.hide()
        self.correct_button.hide()
        self.picture.installEventFilter(self)
        self.results = ResultChoice(theme)
        self.bubble = BubbleView(theme, wide=True)
        self._is_hand = False
        self.reason = ReasonSheet(self, theme)
        self.film_sheet = FilmSheet(self, theme)
        self._lay_out()
        self._connect(keys)
        # At once, and again when every part has taken its new size.
        theme.changed.connect(self._fit)
        theme.changed.connect(self._fit_again)
        self._timer = QTimer(self)
        self._timer.setInterval(PLAY_EVERY_MS)
        self._timer.timeout.connect(self._play_on)

    def _lay_out(self) -> None:
        top = in_line((self.picture, 480), gap=GAP_PX)
        right = in_column(self.finger, gap=8)
        both = (self.ways_said, self.ways_table, self.ways_note)
        for hidden in (self.finger, self.hand_table, self.limits, self.further, *both):
            hidden.hide()  # until a session of the whole hand is shown
        right.addWidget(self.curves, 1)
        right.addWidget(self.ways, 1)
        top.addLayout(right, 736)
        card = self._card = Card(self._theme, 20)
        said = self._said = QBoxLayout(QBoxLayout.Direction.LeftToRight)
        said.setSpacing(12)
        said.addWidget(self.title)
        said.addWidget(self.count, 1)
        head = in_line(
            STRETCH,
            self.count_button,
            self.beside_button,
            self.again_button,
            self.export_button,
            self.report_button,
            gap=12,
        )
        card.body.setContentsMargins(24, 4, 16, 4)
        card.body.setSpacing(4)
        card.body.addLayout(said)
        card.body.addLayout(head)
        self._scroll = QScrollArea()
        tables = ScrolledColumn()
        below = self._below = in_column(gap=4, margins=(0, 0, 0, 0), within=tables)
        both = (self.ways_said, self.ways_table, self.ways_note)
        for widget in (self.table, self.hand_table, *both, self.further, self.limits, self.notes, self.results):
            below.addWidget(widget)
        below.addStretch(1)
        self._scroll.setWidget(tables)
        self._scroll.setWidgetResizable(True)
        self._scroll.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        card.body.addWidget(self._scroll)
        in_column(
            (top, 1),
            self.player,
            self.bubble,
            card,
            gap=12,
            margins=(MARGIN_PX, GAP_PX, MARGIN_PX, GAP_PX),
            within=self,
        )

    def resizeEvent(self, event: QResizeEvent) -> None:
        self._fit()

    def _fit_again(self) -> None:
        QTimer.singleShot(0, self, self._fit)
        QTimer.singleShot(0, self, self._place_button)

    def _fit(self) -> None:
        """The table takes the rows it has; with large text it scrolls and the curves keep a panel."""
        self.bubble.give_room(self.height() >= LEAST_SCREEN_PX * self._theme.text_scale)
        tight = is_tight(self, self._theme)
        self.curves.show_single(tight)
        self.report_button.set_face(self.report_button.text(), hint="" if tight else "Ctrl+P")
        self.export_button.set_face(self.export_button.text(), hint="" if tight else "Ctrl+E")
        self.again_button.set_face(self.again_button.text(), icon="" if tight else "plus")
        self.finger.buttons()[0].setVisible(not tight)
        if tight and self._joints is not None and self.figures is not None and self._finger == 0:
            self.finger.choose(figure_of(self.figures.exercise.joint).finger)  # five panels have no room
            self._refresh()
            return
        most = self.height() * (0.36 if tight else 0.42 if self._is_hand else 0.48)
        needed = 0 if self.table.isHidden() else self.table.sizeHint().height()
        fewest, beside = LEAST_TABLE_PX * self._theme.text_scale, QBoxLayout.Direction.LeftToRight
        # With large text what was left out, and why, has a line of its own where the table can spare one.
        self._said.setDirection(QBoxLayout.Direction.TopToBottom if tight else beside)
        room = self._room()
        if room < fewest:
            self._said.setDirection(beside)
            room = self._room()
        if self._is_hand:  # always more than there is room for: its place is known before it is read
            self._scroll.setFixedHeight(round(max(min(most, room), fewest)))
            return
        for shown in (self.ways_said, self.ways_table, self.ways_note):
            if not shown.isHidden():
                needed += shown.sizeHint().height() + self._below.spacing()
        if self.further.rows:
            needed += self.further.sizeHint().height() + self._below.spacing()
        if self.results.buttons:
            needed += self.results.sizeHint().height() + self._below.spacing()
        # A line for notes, also while nobody knows yet whether there are any: nothing jumps when they are read.
        needed += self.notes.fontMetrics().height() + 2 * self._below.spacing()
        self._scroll.setFixedHeight(round(max(min(needed + 2, most, room), fewest)))

    def _connect(self, keys: Keys) -> None:
        self.curves.cursor_moved.connect(self.seek)
        self.curves.edges_moved.connect(self._take_edges)
        self.curves.told.connect(self.told)
        self.finger.chosen.connect(lambda _: self._refresh())
        for button in self.finger.buttons():
            button.setFocusPolicy(Qt.FocusPolicy.TabFocus)  # a click must leave Space and the arrows to the player
        self.player.sought.connect(self.seek)
        self.player.stepped.connect(self.step)
        self.player.play_toggled.connect(self.toggle_play)
        self.player.view_chosen.connect(lambda _: self._refresh())
        self.player.repetition_wanted.connect(self.toggle_left_out)
        self.reason.kept.connect(self._leave_out)
        self.report_button.clicked.connect(lambda: self.report.emit(self._session_id))
        self.export_button.clicked.connect(lambda: self.export.emit(self._session_id))
        self.again_button.clicked.connect(self.again)
        self.count_button.clicked.connect(self.toggle_counted)
        self.beside_button.clicked.connect(self._ask_beside)
        self.correct_button.clicked.connect(self.correct_here)
        self.film_button.clicked.connect(self.ask_film)
        self.film_sheet.wanted.connect(self._film)
        self.results.chosen.connect(self.result)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setProperty("shows_own_focus", True)
        actions = {
            "play": self.toggle_play, "frame_back": lambda: self.step(-1), "frame_on": lambda: self.step(1),
            "repetition_back": lambda: self.go_to_repetition(self._current - 1),
            "repetition_on": lambda: self.go_to_repetition(self._current + 1),
            "leave_out": self.toggle_left_out, "next_view": self.player.next_view,
            "edge_back": lambda: self.nudge_edge(-EDGE_STEP_S),
            "edge_on": lambda: self.nudge_edge(EDGE_STEP_S), "report": self.report_button.click,
            "export": self.export_button.click, "plot_in": self.curves.zoom_in, "plot_out": self.curves.zoom_out,
            "plot_all": self.curves.show_all, "correct": self.correct_here, "beside": self.beside_button.click,
            "angle": self.angle_button.click, "film": self.ask_film,
        }  # fmt: skip
        for name, action in actions.items():
            bind(self, keys, name, action)

    # --- life ---------------------------------------------------------------------------------------------
    def begin(
        self, patient_id: str, session_id: str, *, may_repeat: bool = False, whole_hand: bool | None = None
    ) -> None:
        """Read a session in the background, then show it. ``whole_hand`` where that is known: then everything has its
        place at once."""
        self._session_id = session_id
        self._session = None
        self.curves.clear()
        if whole_hand is not None:
            self._lay_out_for(whole_hand)
        self.again_button.setVisible(may_repeat)
        self.picture.clear(self.tr("Reading the session…"))
        store = self._store

        def read() -> Reviewed:
            session, choices = store.session(session_id), store.choices(session_id)
            history, camera = store.history(patient_id), store.camera(session)
            by_hand = of_session(store.by_hand(patient_id), session.header.hand, session.header.when.date())
            return Reviewed(session, choices, history, camera, tuple(store.results_of(session_id)), by_hand)

        self._background.run(read, self._show, self.told.emit, self)
        self.setFocus(Qt.FocusReason.OtherFocusReason)

    def _session_words(self) -> str:
        """What was done, with which hand and when, and the figure that the list of sessions names."""
        assert self.figures is not None
        of = self.figures
        hand = inside(terms.hand_name(of.side))
        what = f"{terms.exercise_name(of.exercise.id)}, {hand} · {numbers.short_date(of.when)} {of.when:%H:%M}"
        return " · ".join(filter(None, (what, main_figure(of))))

    def end(self) -> None:
        """Stop playing."""
        self._stop()

    @property
    def saved_at(self) -> datetime | None:
        """When the session on the screen was over and stored; None while none is."""
        if self.figures is None or self._session is None:
            return None
        return self.figures.when + timedelta(seconds=self.figures.duration_s)

    @property
    def shown(self) -> bool:
        """Whether a session is on the screen."""
        return self._session is not None

    def _show(self, reviewed: Reviewed) -> None:
        session = reviewed.session
        if session.header.session_id != self._session_id:
            return  # another one was asked for meanwhile
        self._session, self._choices, self._history = session, reviewed.choices, reviewed.history
        self._camera, self._by_hand = reviewed.camera, reviewed.by_hand
        self._curves = session_curves(session)
        self._joints = joint_curves(session)
        self._motion = motion_curves(session)
        is_hand = self._joints is not None
        self._modelled_px = modelled_px(session.camera, session.markers.position_cam_m) if is_hand else None
        self._show_parts(is_hand)
        self._row = self._asked_row = -1
        self.picture.clear("")
        self.picture.set_hand_area(session.calibration.clicks.pixel)
        self.results.show_results(reviewed.results, self._session_id)
        self.correct_button.show()
        self.angle_button.show()
        self.film_button.hide()  # until there is a picture of it
        self._place_button()
        self._compute()
        all_of_them = self.figures.repetitions if self.figures else ()
        counted = (n for n, repetition in enumerate(all_of_them) if repetition.counts)
        self._current = next(counted, 0 if all_of_them else -1)  # also where all are passive: they have films too
        self._refresh()
        self.seek(all_of_them[self._current].start_s if all_of_them else 0.0)
        self.arrived.emit()

    def _lay_out_for(self, whole_hand: bool) -> None:
        """The places of a session that is still being read, with nothing of the one before."""
        self._joints = self.figures = self._motion = None
        self._show_parts(whole_hand)
        self.count.setText("\N{NO-BREAK SPACE}")
        self.limits.setText("\n")
        self.hand_table.show_rows((), ())
        self._fit()

    def _show_parts(self, whole_hand: bool) -> None:
        self._is_hand = whole_hand
        for widget in (self.finger, self.hand_table, self.limits):
            widget.setVisible(whole_hand)
        self.table.setVisible(not whole_hand)
        policy = Qt.ScrollBarPolicy
        self._scroll.setVerticalScrollBarPolicy(policy.ScrollBarAlwaysOn if whole_hand else policy.ScrollBarAsNeeded)

    def _compute(self) -> None:
        if self._session is not None:
            figures = session_figures(self._session, self._choices, limits_of(self._history))
            self.figures = replace(figures, camera=self._camera)

    def _refresh(self) -> None:
        figures, curves = self.figures, self._curves
        if figures is None or curves is None:
            return
        plot = self._plot(curves, figures)
        self.curves.show_plot(plot)
        self._show_ways()
        self.player.show_session(plot.end_s, figures.repetitions, self._current)
        previous, other = previous_of(self._history, figures), other_hand_of(self._history, figures)
        if self._joints is None:
            self.table.show_rows(column_names(figures, previous, other), table_rows(figures, previous, other))
        else:
            self.hand_table.show_rows(column_heads(figures, previous, other), finger_rows(figures, previous, other))
            self.limits.setText(limits_words(figures))
            self.picture.update()
        self.table.setVisible(self._joints is None and bool(self.table.rows))
        self._show_active_passive(figures)
        rows = further_rows(figures, previous)
        day = numbers.day_beside(previous.when, figures.when) if previous is not None else ""
        self.further.show_rows(further_title(figures), day, rows)
        if rows and self._is_hand:  # what the exercise is about comes first
            self._below.removeWidget(self.further)
            last = self._below.count() - 1  # before the stretch, after what explains the table
            self._below.insertWidget(0 if figures.exercise.is_task else last, self.further)
        said = " · ".join(filter(None, (repetition_words(figures), corrected_words(figures).rstrip("."))))
        self.count.setText(said)
        self.title.setText(self._session_words())
        self.count.setToolTip(plain_tooltip(said))
        said = "  ".join(f"{numbers.clock(time_s)} “{text}”" for time_s, text in figures.notes)
        words = [self.tr("Notes: {notes}").format(notes=said)] if said else []
        if figures.pain:
            pains = ", ".join(str(pain) for pain in figures.pain)
            words.append(self.tr("Pain (0–10): {pains}").format(pains=pains))
        self.notes.setText("  ".join(words))
        self.notes.setVisible(bool(words))
        self._show_partner(figures)
        counts = self.tr("Let it count again") if figures.not_counted else self.tr("Do not count")
        self.count_button.set_face(counts)
        self._fit()

    def _room(self) -> int:
        """What is left for the tables when all else keeps its least height; the card must not be pushed together."""
        whole, width = self.layout(), self.width()
        assert whole is not None
        self._card.body.activate()  # its line may just have become two, and its widget keeps the height it had before
        whole.invalidate()  # the text may just have become larger
        least = whole.minimumHeightForWidth(width) if whole.hasHeightForWidth() else whole.minimumSize().height()
        return self.height() - (least - self._scroll.minimumHeight())

    def _show_active_passive(self, figures: SessionFigures) -> None:
        """The table of what was active, passive and measured by hand, where there is more than the first."""
        found = active_passive(figures, self._by_hand)
        if found is not None:
            self.ways_said.setText(found.said)
            self.ways_table.show_rows(found.heads, found.rows)
            self.ways_note.setText(found.note)
        for place, widget in enumerate((self.ways_said, self.ways_table, self.ways_note)):
            self._below.removeWidget(widget)  # what was done both ways is the first to be read
            self._below.insertWidget(place if figures.passive is not None else place + 2, widget)
        self.ways_table.setVisible(found is not None)
        self.ways_said.setVisible(found is not None and bool(found.said))
        self.ways_note.setVisible(found is not None and bool(found.note))

    def _show_partner(self, figures: SessionFigures) -> None:
        """What the session is best held against; without one the button says so."""
        self._partner = partner_of(self._history, figures)
        self.beside_button.setEnabled(self._partner is not None)
        words = self.tr("No other session of this exercise yet.")
        if self._partner is not None:
            words = self.tr("Beside the {hand} of {day} (B)").format(
                hand=terms.hand_name(self._partner.side).lower(),
                day=numbers.day_beside(self._partner.when, figures.when),
            )
        self.beside_button.setToolTip(words)

    def _ask_beside(self) -> None:
        if self._partner is not None:
            self.beside.emit(self._session_id, self._partner.session_id)

    def _plot(self, curves: ReportCurves, figures: SessionFigures) -> SessionPlot:
        """The curves that are chosen."""
        shown = (curves, figures.exercise, figures.repetitions, self._current)
        if self._view in ("place", "zyz") and self._motion is not None:
            kind: MotionKind = "zyz" if self._view == "zyz" else "place"
            return MotionPlot(*shown, motion=self._motion, kind=kind)
        if self._joints is not None and self._finger != WRIST:
            return HandPlot(*shown, joints=self._joints, finger=self._finger)
        return SessionPlot(*shown, *figures.targets_deg)

    def _show_ways(self) -> None:
        """The ways instead of the curves, where those are chosen; of the wrist, or of a finger's joints."""
        on = self._view == "path" and self._motion is not None
        self.curves.setVisible(not on)
        self.ways.setVisible(on)
        self.finger.setVisible(self._is_hand and self._view in ("angles", "path"))
        if self._motion is None or not on:
            return
        if self._joints is None or self._finger == WRIST:
            self.ways.show_plot(wrist_way(self._motion), self.tr("Path of the wrist, with the hand’s axes"))
            return
        words = self.tr("Ways of the finger tips")
        if self._finger:
            words = self.tr("Ways of the joints: {finger}").format(finger=inside(finger_name(str(self._finger))))
        self.ways.show_plot(finger_ways(self._motion, self._finger), words)

    @property
    def _view(self) -> str:
        """``angles``, ``path``, ``place`` or ``zyz``."""
        return str(self.player.view.currentData())

    @property
    def _finger(self) -> int:
        value = self.finger.value()
        return value if isinstance(value, int) else 0

    # --- time ---------------------------------------------------------------------------------------------
    @property
    def time_s(self) -> float:
        """Seconds of the cursor."""
        return self._time_s

    @property
    def current(self) -> int:
        """The chosen repetition, from 0; -1 for none."""
        return self._current

    def seek(self, time_s: float) -> None:
        """Put the cursor on a time; the repetition under it becomes the current one."""
        if self._curves is None or self.figures is None or not len(self._curves.time_s):
            return
        self._time_s = float(np.clip(time_s, 0.0, self._curves.time_s[-1]))
        under = self._under(self._time_s)
        if under and self._current not in under:
            self._current = under[0]
            self._refresh()
        self.curves.set_time(self._time_s)
        self.ways.set_time(self._time_s)
        self.player.show_time(self._time_s)
        row = row_at(self._curves, self._time_s)
        if row != self._row:
            self._row = row
            self._ask_picture(row)
        self.picture.update()

    def step(self, frames: int) -> None:
        """Go some pictures on or back."""
        if self._curves is not None and len(self._curves.time_s):
            row = int(np.clip(row_at(self._curves, self._time_s) + frames, 0, len(self._curves.time_s) - 1))
            self.seek(float(self._curves.time_s[row]))

    def toggle_play(self) -> None:
        """Play from here, or stop."""
        if self._timer.isActive():
            self._stop()
        elif self._curves is not None:
            if self._time_s >= float(self._curves.time_s[-1]) - 1e-3:
                self.seek(0.0)
            self._timer.start()
            self.player.show_playing(True)

    def _stop(self) -> None:
        self._timer.stop()
        self.player.show_playing(False)

    def _play_on(self) -> None:
        assert self._curves is not None
        self.seek(self._time_s + 0.001 * PLAY_EVERY_MS * self.player.factor)
        if self._time_s >= float(self._curves.time_s[-1]) - 1e-6:
            self._stop()

    def go_to_repetition(self, number: int) -> None:
        """Make a repetition the current one and go to its start."""
        if self.figures is not None and 0 <= number < len(self.figures.repetitions):
            self._current = number
            self._refresh()
            self.seek(self.figures.repetitions[number].start_s)

    def correct_here(self) -> None:
        """A marker is wrong or missing in the picture shown."""
        if self._session is not None and self._row >= 0:
            self._stop()
            self.correct.emit(self._session_id, self._session, self._row)

    def _place_button(self) -> None:
        """In a row at the foot of the picture, the hand above it."""
        buttons = (self.correct_button, self.angle_button, self.film_button)
        room = self.picture.width() - 24
        words = self.tr("Put markers right…")
        for face, icon in ((words, ""), ("", "notebook-pen")):  # the sign alone where there is no room
            self.correct_button.set_face(face, icon=icon)
            for button in buttons:
                button.adjustSize()
            if sum(button.width() + 8 for button in buttons) <= room:
                break
        self.correct_button.setAccessibleName(words)
        top, right = self.picture.height() - buttons[0].height() - 12, self.picture.width() - 12
        for button in reversed(buttons[1:]):
            right -= button.width()
            button.move(right, top)
            right -= 8
        buttons[0].move(12, top)
        self.picture.keep_free(16 + round(label_size(self._theme, words).height()), buttons[0].height() + 12)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if watched is self.picture:
            if event.type() == QEvent.Type.Resize:
                self._place_button()
            elif event.type() == QEvent.Type.ContextMenu:
                self.correct_here()
                return True
        return False

    # --- film ---------------------------------------------------------------------------------------------
    def _rows(self) -> range:
        """Rows of the current repetition."""
        if self.figures is None or self._curves is None or self._current < 0:
            return range(0)
        one = self.figures.repetitions[self._current]
        first, last = np.searchsorted(self._curves.time_s, (one.start_s, one.end_s))
        return range(int(first), int(last))

    def ask_film(self) -> None:
        """Whether, and how fast, the current repetition becomes a film; only where its pictures were kept."""
        rows = self._rows()
        if self._curves is None or not rows or self.film_button.isHidden():
            return
        self._stop()
        doubtful = bool((self._curves.status[rows.start : rows.stop] == TrackStatus.DOUBTFUL).any())
        self.film_sheet.begin(self._current + 1, doubtful=doubtful)

    def _film(self, factor: float) -> None:
        rows, session, curves = self._rows(), self._session, self._curves
        if session is None or curves is None or self.figures is None or not rows:
            return
        if factor == STILL:
            rows = range(self._row, self._row + 1)
        rate_hz = factor * len(rows) / max(float(curves.time_s[rows.stop - 1] - curves.time_s[rows.start]), 1e-3)
        exercise, words = self.figures.exercise, {row: self._angle_words(row) for row in rows}
        if self.figures.repetitions[self._current].helped:  # it would pass for what the patient can do
            words = {row: said and self.tr("{angle}, passive").format(angle=said) for row, said in words.items()}
        if session.header.simulated:
            nobodys = self.tr("Simulated hand")
            words = {row: f"{said} · {nobodys}" if said else nobodys for row, said in words.items()}
        self.film.emit(
            FilmWanted(session, self._session_id, self._current + 1, rows, rate_hz, exercise, lambda row: words[row])
        )

    def _angle_words(self, row: int) -> str:
        """``Flexion 24° ± 2°``: the trained angle of a row that was measured, else nothing."""
        if self._curves is None or self.figures is None or self._curves.status[row] != TrackStatus.TRACKED:
            return ""
        exercise, joints = self.figures.exercise, self._joints
        if joints is not None and exercise.joint in joints.names:
            column = joints.names.index(exercise.joint)
            value, sd = float(joints.angles_deg[row, column]), float(joints.sds_deg[row, column])
            name = figure_of(exercise.joint).long_name
        else:
            column = FLEXION if exercise.angle is None else exercise.angle
            value, sd = float(self._curves.angles_deg[row, column]), float(self._curves.sds_deg[row, column])
            name = terms.movement_name(SIDES[column][0 if value >= 0 else 1])
        return f"{name} {numbers.with_spread(value, sd)}" if math.isfinite(value) else ""

    def _paint_angle(self, painter: QPainter, picture: PictureView) -> str:
        """The trained angle on the picture; what is said of it, or why it is not drawn."""
        assert self._session is not None
        assert self.figures is not None
        found = drawn_angle(self._session, self._row, self.figures.exercise)
        if found is not None:
            paint_angle(painter, found, picture.to_screen)
            return self._angle_words(self._row) if self._joints is not None else ""
        if self._session.status[self._row] != TrackStatus.TRACKED:
            return self.tr("Not measured here")
        return self.tr("Towards the camera: measured, not drawn")

    # --- corrections --------------------------------------------------------------------------------------
    def toggle_left_out(self) -> None:
        """Leave the current repetition out or let it count as passive (asks which), or take that back."""
        if self.figures is None or self._current < 0:
            return
        if reason := self.figures.repetitions[self._current].reason:
            reasons = {n: words for n, words in self._choices.left_out.items() if n != self._current}
            if reason == PASSIVE:  # also where that was said while it was measured
                reasons[self._current] = ""
            self._choose(replace(self._choices, left_out=reasons))
        else:
            self.reason.begin(self._current + 1)

    def toggle_counted(self) -> None:
        """Let the whole session count no more, or again."""
        if self._session is not None:
            self._choose(replace(self._choices, not_counted=not self._choices.not_counted))
            self.arrived.emit()

    def _leave_out(self, reason: str, and_after: bool = False) -> None:
        assert self.figures is not None
        last = len(self.figures.repetitions) if and_after else self._current + 1
        reasons = {**self._choices.left_out, **dict.fromkeys(range(self._current, last), reason)}
        self._choose(replace(self._choices, left_out=reasons))

    def _take_edges(self, number: int, start_s: float, end_s: float) -> None:
        self._choose(replace(self._choices, edges_s={**self._choices.edges_s, number: (start_s, end_s)}))

    def nudge_edge(self, by_s: float) -> None:
        """Move the edge of the current repetition that is nearer to the cursor."""
        if self.figures is None or self._current < 0:
            return
        repetition = self.figures.repetitions[self._current]
        start_s, end_s = repetition.start_s, repetition.end_s
        if abs(self._time_s - start_s) <= abs(self._time_s - end_s):
            start_s = min(max(0.0, start_s + by_s), end_s - EDGES_S)
        else:
            end_s = max(end_s + by_s, start_s + EDGES_S)
        self._take_edges(self._current, start_s, end_s)

    def _choose(self, choices: RepetitionChoices) -> None:
        self._choices = choices
        self._compute()
        self._refresh()
        store, session_id = self._store, self._session_id
        self._background.run(lambda: store.keep_choices(session_id, choices), lambda _: None, self.told.emit, self)

    # --- picture ------------------------------------------------------------------------------------------
    def _ask_picture(self, row: int) -> None:
        """One picture at a time is read; the newest wish follows when it has come."""
        if self._asked_row >= 0:
            return
        self._asked_row = row
        store, session_id = self._store, self._session_id

        def shown(picture: ByteImage | None) -> None:
            asked, self._asked_row = self._asked_row, -1
            if session_id != self._session_id or self._session is None:
                return  # another session is being read
            if picture is not None:
                self.film_button.show()
                self.picture.show_frame(picture)
                if self._row != asked:
                    self._ask_picture(self._row)
            elif self.picture.image is None:
                self._show_empty()

        self._background.run(lambda: store.picture(session_id, row), shown, self.told.emit, self)

    def _show_empty(self) -> None:
        """No pictures were kept: a plain ground of the camera's size under the marks."""
        assert self._session is not None
        camera = self._session.camera
        self.picture.show_frame(np.full((camera.height_px, camera.width_px, 3), 34, np.uint8))

    def _paint_overlay(self, painter: QPainter, picture: PictureView) -> None:
        if self._session is None or self._curves is None or self.figures is None or self._row < 0:
            return
        measured = self._session.markers.measured_px[self._row]
        camera, places = self._session.camera, self._session.markers.position_cam_m[self._row]
        modelled = modelled_px(camera, places)
        spots = np.where(np.isfinite(measured), measured, modelled)
        if self._modelled_px is not None:
            self._paint_hand(painter, picture, spots, np.isfinite(measured[:, 0]))
        else:
            paint_palm(painter, picture, spots, np.isfinite(measured[:, 0]))
        said = self._paint_angle(painter, picture) if self.angle_button.isChecked() else ""
        self._paint_labels(painter, picture, said)

    def _paint_hand(self, painter: QPainter, picture: PictureView, spots: FloatArray, seen: np.ndarray) -> None:
        """Skeleton, and the way of the fingertips in the second before."""
        assert self._session is not None
        assert self._modelled_px is not None
        assert self._curves is not None
        times = self._curves.time_s
        recent = slice(int(np.searchsorted(times, times[self._row] - TRAIL_S)), self._row + 1)
        all_seen = np.isfinite(self._session.markers.measured_px[recent, :, 0])
        finger, protocol = max(self._finger, 0), self._session.header.protocol
        paint_trails(painter, picture, protocol, self._modelled_px[recent], all_seen, finger)
        paint_skeleton(painter, picture, protocol, spots, seen, finger)

    def _under(self, time_s: float) -> list[int]:
        """Numbers of the repetitions that a time is in."""
        repetitions = self.figures.repetitions if self.figures is not None else ()
        return [n for n, rep in enumerate(repetitions) if rep.start_s - 1e-6 <= time_s <= rep.end_s + 1e-6]

    def _clock_words(self) -> str:
        """``Repetition 3 of 8 · 00:12.0``, the time alone between the repetitions."""
        clock = numbers.clock_tenths(self._time_s)
        if self.figures is None or self._current not in self._under(self._time_s):
            return clock
        pattern = self.tr("Repetition {number} of {count} · {time}")
        return pattern.format(number=self._current + 1, count=len(self.figures.repetitions), time=clock)

    def _paint_labels(self, painter: QPainter, picture: PictureView, said: str) -> None:
        """Repetition and time, at the right what is measured, or below it where there is no room; then what is ``said``
        of the angle that is drawn."""
        plate = paint_label(painter, self._theme, self._clock_words(), 12, 12)
        words = self._measured_words()
        left, top = picture.width() - label_size(self._theme, words).width() - 12, 12.0
        if left < plate.right() + 2:
            left, top = 12.0, plate.bottom() + 4
        if words:
            plate = paint_label(painter, self._theme, words, left, top)
        if said:
            paint_label(painter, self._theme, said, 12, plate.bottom() + 4)

    def _measured_words(self) -> str:
        """Of the whole hand how many discs are hidden, of the wrist its angle at the cursor."""
        assert self._session is not None
        assert self._curves is not None
        assert self.figures is not None
        if self._joints is not None:
            hidden = int((~np.isfinite(self._session.markers.measured_px[self._row, :, 0])).sum())
            return self.tr("{count} markers hidden").format(count=hidden) if hidden else ""
        column = FLEXION if self.figures.exercise.angle is None else self.figures.exercise.angle
        value, sd = value_at(self._curves, column, self._time_s)
        if not math.isfinite(value):
            return ""
        return f"{terms.movement_name(SIDES[column][0 if value >= 0 else 1])} {numbers.with_spread(value, sd)}"
