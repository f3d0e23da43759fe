"""The live screen: arranges picture, path, number, curves and light, and pulls the newest values by a timer."""

from __future__ import annotations

import math
import time
from dataclasses import replace
from functools import partial

import numpy as np
from PySide6.QtCore import QEvent, QObject, QRectF, Qt, QTimer, Signal
from PySide6.QtGui import QPainter, QResizeEvent
from PySide6.QtWidgets import QHBoxLayout, QVBoxLayout, QWidget

from carpus.core.hand.protocols import PROTOCOLS
from carpus.core.measures.validity import LARGEST_SD_RAD
from carpus.core.pipeline.live_values import LiveCounters, StartMode, TrackedView
from carpus.core.records.exercise_sets import next_part
from carpus.core.records.set_up import SetUp
from carpus.core.results.repetition_rows import ACTIVE, PASSIVE
from carpus.core.types import TrackedFrame, TrackStatus
from carpus.ui.background import Background
from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Line, Surface
from carpus.ui.controls.progress_bar import ThinBar
from carpus.ui.controls.text import SEMIBOLD, Text
from carpus.ui.figures import FIGURES, FINGERS, Figure, figure_of
from carpus.ui.keys import Keys, bind
from carpus.ui.live.beginning import Beginning
from carpus.ui.live.behind import Behind, behind_lamp, words_left
from carpus.ui.live.counting import RunningCount
from carpus.ui.live.doubt import Chosen, Doubt, SteadyDoubt, doubt_lamp, doubt_of
from carpus.ui.live.glance import Glance, RecordingState
from carpus.ui.live.hand_map import HandMap
from carpus.ui.live.hand_words import hand_lamp
from carpus.ui.live.light import Lamp, SteadyLight, lamp_for
from carpus.ui.live.light_view import LightView
from carpus.ui.live.notes import NoteSheet, PainSheet
from carpus.ui.live.number_card import NumberCard, Reading
from carpus.ui.live.question import SpotQuestion, paint_question
from carpus.ui.marker_words import long_finger_name
from carpus.ui.picture import overlay, skeleton
from carpus.ui.picture.view import HAND_ROOM, PALM_ROOM, PictureView
from carpus.ui.plot.card import PlotCard
from carpus.ui.plot.finger_curves import FingerCurves
from carpus.ui.plot.history import History
from carpus.ui.plot.live_curves import LiveCurves
from carpus.ui.plot.path_view import PathView
from carpus.ui.ports import Measuring
from carpus.ui.theme import GAP_PX, MARGIN_PX, Theme, is_tight
from carpus.ui.tour.bubble import LEAST_SCREEN_PX, BubbleView
from carpus.ui.translate import inside

LOOK_EVERY_MS = 8
"""So often the screen looks for a new picture: the curves are as old as this, not as the time between two drawings."""
DRAW_AFTER_MS = 25
"""Never sooner after the last drawing; what arrives in between is in the curves, not drawn on its own."""
DRAWING_SHARE = 0.5
"""At most this part of a processor goes to drawing: on a slow computer fewer drawings, not fewer pictures tracked."""
TICK_EVERY_MS = 40
"""So often figures and state go on where no pictures come."""
VALUES_EVERY = 3
SLOW_EVERY = 30
HASTY_S = 3.0
"""So soon after a recording began nobody is taken to mean its end without being asked."""
WRIST_COLUMNS, HAND_COLUMNS = (520, 696), (440, 776)

GLANCE_EVERY_S = 0.09
TIMED_MARKS = 10
"""What goes by time is told in so many parts."""
STALE_S = 0.4
"""Without a new picture for so long, what was tracked last is not the hand of now."""


class LiveScreen(QWidget):
    """``recording_changed`` (state, seconds) and ``counted`` feed the top bar; ``stopped`` carries the session."""

    recording_changed = Signal(str, float)
    counted = Signal(LiveCounters)
    told = Signal(object)
    stopped = Signal(str)
    stop_failed = Signal(object)
    patient_wanted = Signal()
    """A person opens or closes the patient's own view."""
    glanced = Signal(Glance)
    """How the trained angle stands, as often as the figures change."""
    hasty = Signal()
    """A person ends a recording that has only just begun: is it meant?"""

    def __init__(self, theme: Theme, keys: Keys, background: Background) -> None:
        super().__init__()
        self._theme, self._background = theme, background
        self._measuring: Measuring | None = None
        self._set_up: SetUp | None = None
        self.history = History(PROTOCOLS[0])
        self._light = SteadyLight()
        self._steady_doubt = SteadyDoubt()
        self.doubt: Doubt | None = None
        self._count: RunningCount | None = None
        self._view: TrackedView | None = None
        self._overlay_on = True
        self._camera_lost = False
        self._stopping = self._passive = False
        self.start_mode: StartMode = "key"
        self._beginning = Beginning()
        self._behind = Behind()
        self._rests = False
        self._shown_left_s = 0
        self._tick = 0
        self._ticked_at_s, self._ticked_cpu_s = -math.inf, 0.0
        self._drawing_ms: float | None = 0.0
        self._started_at_s = -HASTY_S
        self._fresh_at_s = self._glanced_at_s = -math.inf
        self.stage = QWidget()
        """All but the bar below: what a message may cover while the light goes on speaking to the far eye."""
        self.picture = PictureView(theme)
        self.picture.overlay = self._paint_overlay
        self.question = SpotQuestion(self.picture, theme, keys)
        self.path = PathView(theme, self.history)
        self.number = NumberCard(theme)
        self.curves = LiveCurves(theme, self.history)
        self.fingers = FingerCurves(theme, self.history)
        self.hand_map = HandMap(theme)
        self._whole_hand = False
        self._side_on = False
        self._large = False
        self.light = LightView(theme)
        self.note = Button(theme, self.tr("Note"), "quiet", icon="notebook-pen", hint="F5")
        self.pain = Button(theme, self.tr("Pain"), "quiet", hint="F6")
        self.pause = Button(theme, self.tr("Pause"), icon="pause", hint="F7", height_px=52)
        self.main = Button(theme, "", "primary", height_px=56)
        self._research = True
        self.speeds = Button(theme, self.tr("Speeds"), "quiet", hint="F4", height_px=32)
        self.patient = Button(theme, self.tr("Patient’s view"), icon="monitor", height_px=32)
        self.course = Text(theme, "", 16, SEMIBOLD, wrap=True)
        self.course.hide()
        self.catching_up = ThinBar(theme, self.tr("Catching up"))
        self.catching_up.hide()
        self.bubble = BubbleView(theme, wide=True, keys=False)
        self.note_sheet = NoteSheet(self.stage, theme)
        self.pain_sheet = PainSheet(self.stage, theme)
        self._lay_out()
        self._connect(keys)
        self.picture.installEventFilter(self)
        theme.changed.connect(self._fit)
        self._timer = QTimer(self)
        self._timer.setTimerType(Qt.TimerType.PreciseTimer)
        self._timer.setInterval(LOOK_EVERY_MS)
        self._timer.timeout.connect(self.look)

    def _lay_out(self) -> None:
        left = QVBoxLayout()
        left.setSpacing(12)
        left.addWidget(self.picture, 390)
        left.addWidget(self.path, 242)
        left.addWidget(self.hand_map, 300)
        right = QVBoxLayout()
        right.setSpacing(12)
        right.addWidget(self.number)
        right.addWidget(self.curves, 1)
        right.addWidget(self.fingers, 1)
        self._columns = columns = QHBoxLayout()
        columns.setContentsMargins(MARGIN_PX, GAP_PX, MARGIN_PX, 12)
        columns.setSpacing(GAP_PX)
        columns.addLayout(left, 520)
        columns.addLayout(right, 696)
        self.speeds.setProperty("floats", True)  # over the corner of the curves that nothing is written in
        on_curves = QHBoxLayout(self.curves)
        on_curves.setContentsMargins(0, 4, 6, 0)
        on_curves.addStretch(1)
        on_curves.addWidget(self.speeds, 0, Qt.AlignmentFlag.AlignTop)
        self.patient.setProperty("floats", True)
        on_picture = QHBoxLayout(self.picture)
        on_picture.setContentsMargins(0, 8, 8, 0)
        on_picture.addStretch(1)
        on_picture.addWidget(self.patient, 0, Qt.AlignmentFlag.AlignTop)
        bottom = QHBoxLayout()
        bottom.setContentsMargins(0, 0, MARGIN_PX, 0)
        bottom.setSpacing(4)
        bottom.addWidget(self.light, 1)
        bottom.addSpacing(8)
        for button in (self.note, self.pain):
            bottom.addWidget(button)
        bottom.addSpacing(8)
        bottom.addWidget(self.pause)
        bottom.addSpacing(12)
        bottom.addWidget(self.main)
        self.stage.setLayout(columns)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(0, 0, 0, 0)
        whole.setSpacing(0)
        whole.addWidget(self.stage, 1)
        named = QHBoxLayout()
        named.setContentsMargins(MARGIN_PX, 0, MARGIN_PX, 8)
        named.addWidget(self.course)
        whole.addLayout(named)
        above = QHBoxLayout()
        above.setContentsMargins(MARGIN_PX, 0, MARGIN_PX, 4)
        above.addWidget(self.bubble)
        whole.addLayout(above)
        whole.addWidget(self.catching_up)
        whole.addWidget(Line(self._theme))
        bar = Surface(self._theme)
        bar.setLayout(bottom)
        whole.addWidget(bar)

    def _connect(self, keys: Keys) -> None:
        self.note.clicked.connect(lambda: self.note_sheet.begin(passive=self._passive))
        self.pain.clicked.connect(self.pain_sheet.begin)
        self.note_sheet.kept.connect(lambda words: self._add_event("note", words))
        self.note_sheet.moved.connect(self._keep_way)
        self.pain_sheet.kept.connect(self._keep_pain)
        self.pause.clicked.connect(self.toggle_pause)
        self.main.clicked.connect(self.toggle_recording)
        self.speeds.clicked.connect(self.toggle_speeds)
        self.patient.clicked.connect(self.patient_wanted)
        # The space bar (or the pedal that sends it) stops whatever has the keyboard: buttons are clicked by Enter here.
        for button in (self.note, self.pain, self.pause, self.main, self.speeds, self.patient):
            button.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setProperty("shows_own_focus", True)
        actions = {
            "record": self.toggle_recording, "pedal": self.toggle_recording, "note": self.note.click,
            "pain": self.pain.click, "pause": self.toggle_pause, "overlay": self.toggle_overlay,
            "whole_picture": self.toggle_whole,
            "speeds": self.toggle_speeds, "next_angle": self.next_angle, "next_finger": self.next_finger,
            "side_view": self.toggle_side, "patient_view": self.patient_wanted.emit,
            "large_view": self.toggle_large,
        }  # fmt: skip
        self.fingers.chosen.connect(self.choose_figure)
        self._shortcuts = {name: bind(self, keys, name, action) for name, action in actions.items()}
        self.question.chosen.connect(self._answer)
        self._answer_keys = {
            name: bind(self, keys, name, partial(self._answer_by_key, name))
            for name in ("answer_first", "answer_second", "answer_none")
        }
        self._arm_keys()

    def resizeEvent(self, event: QResizeEvent) -> None:
        self._fit()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """The question keeps its place on the picture."""
        if watched is self.picture and event.type() == QEvent.Type.Resize:
            QTimer.singleShot(0, self._place_question)  # when the picture has its new place
        return super().eventFilter(watched, event)

    def show_research(self, *, on: bool) -> None:
        """The path with its axes and the speeds, or neither; that the forearm lies still is watched all the same."""
        self._research = on
        if not on and self.curves.shows_speeds:
            self.toggle_speeds()
        self._shortcuts["speeds"].setEnabled(on)
        self._fit()

    def _fit(self) -> None:
        """With large text on a small screen, what is read from afar keeps its room and the path gives way."""
        tight = is_tight(self, self._theme)
        small = not self._large
        self.picture.setVisible(small)
        self.path.setVisible(small and not tight and not self._whole_hand and self._research)
        self.speeds.setVisible(self._research)
        self.hand_map.setVisible(small and not tight and self._whole_hand)
        self.curves.setVisible(small and not self._whole_hand)
        self.fingers.setVisible(small and self._whole_hand)
        for place, share in enumerate(HAND_COLUMNS if self._whole_hand else WRIST_COLUMNS):
            self._columns.setStretch(place, share if small or place else 0)
        for button in (self.note, self.pain, self.pause):
            button.setVisible(small)  # the light has the room; their keys go on working
        least_px = LEAST_SCREEN_PX * self._theme.text_scale
        self.bubble.give_room(self.height() >= least_px and not (tight and self._whole_hand))
        self.curves.show_single(tight)
        self._place_question()
        for button, hint in ((self.note, "F5"), (self.pain, "F6"), (self.pause, "F7")):
            button.set_face(button.text(), hint="" if tight else hint)
        self._show_buttons()

    # --- life ---------------------------------------------------------------------------------------------
    def begin(self, measuring: Measuring, set_up: SetUp) -> None:
        """Show a source whose tracking has begun."""
        self._measuring, self._set_up = measuring, set_up
        self.history.clear(set_up.protocol)
        self._whole_hand = set_up.protocol.has_fingers
        self._light = SteadyLight()
        self._steady_doubt = SteadyDoubt()
        self._open_question(None)
        self._count = None
        self._view = None
        self._behind = Behind()
        self._camera_lost = self._stopping = self._rests = False
        self._arm()
        self.curves.set_exercise(set_up.exercise, set_up.target_positive_deg, set_up.target_negative_deg)
        self.path.set_exercise(set_up.side, set_up.exercise.pure_wrist)
        angle = 1 if set_up.exercise.angle is None else set_up.exercise.angle
        figure = figure_of(set_up.exercise.joint) if self._whole_hand else None
        self.number.show_reading(self._targets(Reading(angle=angle, figure=figure)))
        self.pain.set_face(self.tr("Pain"), icon="")
        if figure is not None:
            self.choose_figure(figure)
        self.hand_map.set_side(set_up.side)
        self._fit()
        calibration = measuring.calibration
        stored = measuring.starts_with_recording
        waiting = self.tr("The recording plays from its first picture") if stored else self.tr("Waiting for a picture")
        self.picture.clear(waiting)
        room = HAND_ROOM if self._whole_hand else PALM_ROOM
        self.picture.set_hand_area(None if calibration is None else calibration.clicks.pixel, room)
        self._show_buttons()
        self._timer.start()
        self.setFocus(Qt.FocusReason.OtherFocusReason)

    def end(self) -> None:
        """Stop drawing and let go of the source."""
        self._timer.stop()
        self._measuring = None

    @property
    def recording_state(self) -> RecordingState:
        """What the pill says."""
        feed = self._measuring.feed if self._measuring else None
        if feed is None or not feed.recording or (self._stopping and self._count is None):
            return "off"  # also while it is being started: nothing can be noted in it yet
        return "paused" if feed.paused or self._camera_lost else "recording"

    @property
    def storing(self) -> bool:
        """Whether a recording is being stored: nobody needs to stop it once more."""
        return self._stopping and self._count is not None

    @property
    def recorded_s(self) -> float:
        """Seconds stored so far."""
        return self._count.recorded_s if self._count else 0.0

    @property
    def repetitions(self) -> int:
        """Full repetitions so far."""
        return self._count.repetitions if self._count else 0

    # --- commands -----------------------------------------------------------------------------------------
    def toggle_recording(self) -> None:
        """Start a recording, or stop and go to the review: the same on every source. A hasty end asks; what is counted
        down is taken back."""
        if self._measuring is None or self._set_up is None or self._stopping:
            return
        if self._measuring.feed.recording:
            if time.monotonic() - self._started_at_s < HASTY_S:
                self.hasty.emit()
            else:
                self.stop()
        elif self._beginning.counts:
            self._beginning.stop()
            self._show_start()
        elif self.start_mode == "countdown" and not self._measuring.starts_with_recording and len(self.history):
            self._beginning.count(self.now_s)
            self._show_start()
        else:
            self._record()

    def _record(self) -> None:
        assert self._measuring is not None
        self._beginning.stop()
        self._stopping = True
        self._background.run(self._measuring.start_recording, lambda _: self._started(), self._not_started, self)

    def rest(self, *, on: bool) -> None:
        """Between two exercises of a set nothing begins by itself."""
        if on != self._rests:
            self._rests = on
            self._arm()

    def _arm(self) -> None:
        """A hand that lies still begins from now on, where that is wanted."""
        self._beginning.stop()
        stored = self._measuring is not None and self._measuring.starts_with_recording
        if self.start_mode == "still" and not (stored or self._rests or self._camera_lost):
            self._beginning.wait()

    def _look_for_start(self) -> None:
        """One look at the hand while a recording may begin without a hand at the keyboard."""
        if self._measuring is None or self._measuring.feed.recording or self._stopping or not len(self.history):
            return
        history = self.history
        bent = [history.figure_value(FIGURES.index(Figure(finger, "middle")))[0] for finger in FINGERS[1:]]
        angles = np.array([*history.angles_deg, *(bent if self._whole_hand else ())], dtype=float)
        if self._beginning.take(angles if history.status == TrackStatus.TRACKED else None, self.now_s):
            self._record()
        self._show_start()

    def _show_start(self) -> None:
        """The seconds on the button, as soon as they change."""
        left_s = self._beginning.left_s(self.now_s)
        if left_s != self._shown_left_s:
            self._shown_left_s = left_s
            self._show_buttons()

    def _started(self) -> None:
        assert self._set_up is not None
        self._stopping = self._passive = False
        self._behind.begin()
        self._show_way()
        self._started_at_s = time.monotonic()
        self._count = RunningCount(self._set_up.exercise, self._set_up.protocol)
        self.history.set_home()
        self._show_buttons()

    def _not_started(self, fault: Exception) -> None:
        self._stopping = False
        self._show_buttons()
        self.told.emit(fault)

    def stop(self) -> None:
        """Close the file in the background; the answer leads to the review."""
        if self._measuring is None or self._stopping or not self._measuring.feed.recording:
            return
        self._stopping = True
        self._show_buttons()
        self.main.setEnabled(False)
        self.main.set_face(self.tr("Storing…"), icon="", hint="")

        def failed(fault: Exception) -> None:
            self._stopping = False
            self.catching_up.hide()
            self._show_buttons()
            self.stop_failed.emit(fault)

        def done(session_id: object) -> None:
            self._stopping = False
            self.catching_up.hide()
            self._count = None
            self._show_buttons()
            self.stopped.emit(str(session_id))

        self._background.run(self._measuring.stop_recording, done, failed, self)

    def toggle_pause(self) -> None:
        """Pause or go on."""
        if self._measuring is not None and self._measuring.feed.recording and not (self._camera_lost or self.storing):
            feed = self._measuring.feed
            (feed.resume_recording if feed.paused else feed.pause_recording)()
            self._show_buttons()

    def toggle_overlay(self) -> None:
        """Hide or show what is drawn on the picture."""
        self._overlay_on = not self._overlay_on
        self.picture.update()

    def toggle_whole(self) -> None:
        """Whole picture or hand area."""
        self.picture.show_whole(not self.picture.shows_whole)

    def toggle_large(self) -> None:
        """One figure and the light, to be read from across the room, or everything."""
        self._large = not self._large
        self.number.set_large(self._large)
        self._fit()

    def toggle_speeds(self) -> None:
        """Curves of the angles or of the speeds."""
        self.curves.show_speeds(not self.curves.shows_speeds)
        self.fingers.show_speeds(self.curves.shows_speeds)
        self.speeds.set_face(self.tr("Angles") if self.curves.shows_speeds else self.tr("Speeds"))

    def next_angle(self) -> None:
        """Show the next of the three angles of the wrist, or of a finger, as the big number."""
        reading = self.number.reading
        if reading.figure is not None:
            own = [figure for figure in FIGURES if figure.finger == reading.figure.finger]
            self.choose_figure(own[(own.index(reading.figure) + 1) % len(own)])
            return
        self.number.show_reading(self._targets(Reading(angle=(reading.angle + 1) % 3)))

    def next_finger(self) -> None:
        """Show the same angle of the next finger as the big number."""
        figure = self.number.reading.figure
        if figure is not None:
            self.choose_figure(Figure(figure.finger % len(FINGERS) + 1, figure.row))

    def choose_figure(self, figure: Figure) -> None:
        """Make an angle of a finger the big number."""
        reading = self._targets(Reading(figure=figure))
        self.fingers.set_figure(figure, reading.target_positive_deg)
        self.number.show_reading(reading)
        if self._measuring is not None and len(self.history):
            self.number.show_reading(self._reading())

    def toggle_side(self) -> None:
        """One finger from the side, or not."""
        self._side_on = not self._side_on
        self.picture.update()

    def set_camera_lost(self, lost: bool) -> None:
        """The camera went or came back; while it is gone nothing old is shown as if it were now."""
        self._camera_lost = lost
        self._arm()
        self.fingers.set_waiting(lost)
        self._show_buttons()
        if lost:
            self._steady_doubt.answered()
            self._open_question(None)
            self.picture.clear(self.tr("No picture"))
            self._view = None

    # --- which spot is which -------------------------------------------------------------------------------
    @property
    def now_s(self) -> float:
        """The recording's own time, 0 before the first picture."""
        now = self.history.now_s
        return now if math.isfinite(now) else 0.0

    def _open_question(self, doubt: Doubt | None) -> None:
        self.doubt = doubt
        if self.question.ask(doubt, self.now_s):
            self._arm_keys()
            self._place_question()

    def _place_question(self) -> None:
        """A question over the head of the picture takes the place of the button there, whose key goes on working."""
        self.question.place()
        self.patient.setVisible(self.question.isHidden() or self.question.y() > self.patient.geometry().bottom())

    def _arm_keys(self) -> None:
        """While a question stands its keys answer it, and do nothing else."""
        armed = [key for name, key in self._answer_keys.items() if self.question.key_of(name) is not None]
        for key in self._answer_keys.values():
            key.setEnabled(key in armed)
        for key in self._shortcuts.values():
            key.setEnabled(key.key() not in [one.key() for one in armed])

    def _answer_by_key(self, name: str) -> None:
        chosen = self.question.key_of(name)
        if chosen is not None and self.question.takes_answers(self.now_s):
            self._answer(chosen)

    def _answer(self, chosen: Chosen) -> None:
        """Tell the tracker what the person says, and go on."""
        doubt = self.question.doubt
        if doubt is None or self._measuring is None:
            return
        self._measuring.answer_spot(doubt.answer(chosen))
        self._steady_doubt.answered()
        self._open_question(None)
        self.picture.update()

    def _keep_pain(self, score: int) -> None:
        """Store it, and let the button say so until the next one."""
        if self._add_event("pain", str(score)):
            self.pain.set_face(self.tr("Pain {score} noted").format(score=score), icon="check")

    def _keep_way(self, passive: bool) -> None:
        """Who moves the hand from now on; the button says so while it is not the patient."""
        if self._add_event(PASSIVE if passive else ACTIVE, ""):
            self._passive = passive
            if self._count is not None:
                self._count.say_way(self.now_s, passive=passive)
            self._show_way()

    def _show_way(self) -> None:
        self.note.set_face(self.tr("Passive") if self._passive else self.tr("Note"))

    def _add_event(self, kind: str, text: str) -> bool:
        return self._measuring is not None and self._measuring.feed.add_event(kind, text)

    # --- drawing ------------------------------------------------------------------------------------------
    def look(self) -> None:
        """Draw as soon as there is a new picture, and go on without one now and then."""
        if self._measuring is None:
            return
        since_ms = 1e3 * (time.monotonic() - self._ticked_at_s)
        if self._drawing_ms is None:  # the first look since: all that was asked for has been painted
            self._drawing_ms = 1e3 * (time.thread_time() - self._ticked_cpu_s)
        if since_ms < max(DRAW_AFTER_MS, self._drawing_ms / DRAWING_SHARE):
            return
        view, shown = self._measuring.feed.newest(), self._view
        is_new = view is not None and (shown is None or view.tracked.index != shown.tracked.index)
        if since_ms >= TICK_EVERY_MS or (is_new and not self._camera_lost):
            self.tick()

    def tick(self) -> None:
        """Pull what is new and draw it."""
        if self._measuring is None:
            return
        self._ticked_at_s, self._ticked_cpu_s, self._drawing_ms = time.monotonic(), time.thread_time(), None
        feed = self._measuring.feed
        fresh = feed.tracked_since(self.history.last_index)
        self.history.append(fresh)
        if fresh:
            self._fresh_at_s = self._ticked_at_s
        begin = feed.recorded_from
        if self._count is not None and begin is not None and not feed.paused:
            self._count.append([tracked for tracked in fresh if tracked.index >= begin])
        view = feed.newest()
        is_new = view is not None and (self._view is None or view.tracked.index != self._view.tracked.index)
        newest = feed.newest_frame()
        behind = self._behind.look(newest, view)
        if behind and newest is not None and not self._camera_lost:
            self.picture.show_frame(newest.color_rgb)
        if view is not None and is_new and fresh and not self._camera_lost:
            self._view = view
            if not behind:
                self.picture.show_frame(view.frame.color_rgb)
            self.plots().draw()
        if fresh and not self._camera_lost:
            self._look_for_start()
        if self._camera_lost:
            self.history.wait(0.001 * TICK_EVERY_MS)
            self.plots().draw()
        if self._tick % VALUES_EVERY == 0:
            self._show_values()
        if self._ticked_at_s - self._glanced_at_s >= GLANCE_EVERY_S:
            self._glanced_at_s = self._ticked_at_s
            self.glanced.emit(self.glance())
        if self._tick % SLOW_EVERY == 0:
            self._show_slow()
        self._tick += 1
        for event in feed.drain_events():
            self.told.emit(event)

    def plots(self) -> PlotCard:
        """The curves that are shown: of the wrist or of the fingers."""
        return self.fingers if self._whole_hand else self.curves

    def _show_values(self) -> None:
        if self._whole_hand:
            self.fingers.refresh_values()
            self.hand_map.show_seen(self.history.seen(), infers_ends=self.history.infers)
        else:
            self.curves.refresh_values()
            self.path.draw()
        calibration = self._measuring.calibration if self._measuring else None
        markers = calibration.clicks.protocol.markers if calibration else ()
        frame = None if self._view is None or self._camera_lost else self._view.tracked
        pure = self._set_up is not None and self._set_up.exercise.pure_wrist
        if self._camera_lost:
            lamp = Lamp("bad", self.tr("No picture"), self.tr("Plug the camera in again"))
        else:
            if self._whole_hand:
                lamp = hand_lamp(frame, self.hand_map.seen)
            else:
                lamp = self._light.show(lamp_for(frame, markers, pure and self.history.forearm_moved()), self.now_s)
            doubt = doubt_of(frame, markers, self._measuring.camera) if self._measuring else None
            if self._behind.late_s:  # what is asked would be about a picture of a while ago
                self._steady_doubt.answered()
                doubt = None
            self._open_question(self._steady_doubt.show(doubt, self.now_s))
            if self._behind.late_s:
                lamp = behind_lamp(self._behind, recording=self.recording_state != "off")
            elif self.doubt is not None and lamp.rank in ("good", "warn"):
                lamp = doubt_lamp(self.doubt)
            elif lamp.rank == "good" and self._shown_left_s:
                lamp = Lamp("good", self.tr("Starts in {seconds}").format(seconds=self._shown_left_s), "")
            elif lamp.rank == "good" and self._beginning.waits and self.recording_state == "off":
                lamp = Lamp("good", lamp.state, self.tr("Starts by itself when the hand lies still"))
        self.light.show_lamp(lamp)
        self._show_catching_up()
        self.number.show_reading(self._reading())
        self.recording_changed.emit(self.recording_state, self.recorded_s)

    def _show_catching_up(self) -> None:
        """After a stop: how long it takes until all that waits is tracked."""
        if self._measuring is None or not self.storing:
            return
        counters = self._measuring.feed.counters()
        left = self._behind.catching_up(counters)
        self.catching_up.setVisible(left is not None)
        self.main.set_face(words_left(counters) if left else self.tr("Storing…"), icon="", hint="")
        if left is not None:
            self.catching_up.show_progress(*left)

    def set_patient_view(self, is_open: bool) -> None:
        """The patient's own view is there, or not."""
        self.patient.set_face(self.patient.text(), icon="check" if is_open else "monitor")
        words = self.tr("Close the patient’s view") if is_open else self.tr("Open the patient’s view")
        self.patient.setAccessibleName(words)

    def show_course(self, words: str) -> None:
        """Which part of a set it is, and how long the rest still is; empty outside a set."""
        self.course.setText(words)
        self.course.setVisible(bool(words))

    def glance(self) -> Glance:
        """The trained angle of this moment, whichever figure is the large one."""
        count, set_up, history = self._count, self._set_up, self.history
        state, now_s = self.recording_state, time.monotonic()
        done, asked = (count.repetitions if count else 0), (set_up.repetitions if set_up else 0)
        if set_up is not None and set_up.course is not None and set_up.course.part.seconds:
            done, asked = int(TIMED_MARKS * self.recorded_s / set_up.course.part.seconds), TIMED_MARKS
        if set_up is None or self._camera_lost or self._behind.late_s or now_s - self._fresh_at_s > STALE_S:
            return Glance(now_s, state=state, done=done, asked=asked)
        deviation, flexion, turned = (float(value) for value in history.angles_deg)
        seen = history.status == TrackStatus.TRACKED
        angle = set_up.exercise.angle
        value, sd, measured = math.nan, math.nan, seen
        if self._whole_hand and set_up.exercise.joint:
            value, sd, measured = history.figure_value(FIGURES.index(figure_of(set_up.exercise.joint)))
        elif angle is not None:
            value, sd = float(history.angles_deg[angle]), float(history.sds_deg[angle])
        sure = measured and seen and math.isfinite(value) and sd <= math.degrees(LARGEST_SD_RAD)
        bent = [history.figure_value(FIGURES.index(Figure(finger, "middle"))) for finger in FINGERS[1:]]
        bent_deg = [one for one, _, known in bent if known] if self._whole_hand else []
        return Glance(
            now_s, value, sure, seen, (deviation, flexion, turned),
            sum(bent_deg) / len(bent_deg) if bent_deg else math.nan, state, done, asked, count.found if count else 0,
            self._shown_left_s,
        )  # fmt: skip

    def _hand_reading(self, figure: Figure) -> Reading:
        column = FIGURES.index(figure)
        value, sd, measured = self.history.figure_value(column)
        inferred = self.history.inferred(column)
        known = (measured or inferred) and not self._camera_lost
        count, asked = self._count, self._set_up.repetitions if self._set_up else 0
        own = count is not None and count.joint == figure.joint
        done = count.repetitions if count else 0
        return self._targets(
            Reading(
                figure=figure,
                value_deg=value if known else math.nan,
                sd_deg=sd if known else math.nan,
                predicted=known and inferred,
                repetitions_done=done,
                repetitions_asked=asked,
                repetition_running=self.recording_state == "recording" and done < asked,
                speed_deg_s=self.history.figure_speed_deg_s(column) if known else math.nan,
                best_positive_deg=count.best_positive_deg if count and own else math.nan,
                best_at_least=bool(count and own and count.best_at_least),
            )
        )

    def _reading(self) -> Reading:
        if self.number.reading.figure is not None:
            return self._hand_reading(self.number.reading.figure)
        angle = self.number.reading.angle
        values, sds = self.history.angles_deg, self.history.sds_deg
        lost = self._camera_lost
        count, asked = self._count, self._set_up.repetitions if self._set_up else 0
        own = count is not None and count.angle == angle
        done = count.repetitions if count else 0
        return self._targets(
            Reading(
                angle=angle,
                value_deg=math.nan if lost else float(values[angle]),
                sd_deg=math.nan if lost else float(sds[angle]),
                predicted=not lost and self.history.status == TrackStatus.PREDICTED,
                doubtful=not lost and self.history.status == TrackStatus.DOUBTFUL,
                repetitions_done=done,
                repetitions_asked=asked,
                repetition_running=self.recording_state == "recording" and done < asked,
                speed_deg_s=math.nan
                if lost or self.history.status == TrackStatus.DOUBTFUL
                else float(self.history.speeds[1]),
                best_positive_deg=count.best_positive_deg if count and own else math.nan,
                best_negative_deg=count.best_negative_deg if count and own else math.nan,
            )
        )

    def _targets(self, reading: Reading) -> Reading:
        if self._set_up is None:
            return reading
        exercise = self._set_up.exercise
        if reading.figure is not None and reading.figure.joint != exercise.joint:
            return reading
        if reading.figure is None and reading.angle != exercise.angle:
            return reading
        return replace(
            reading,
            target_positive_deg=self._set_up.target_positive_deg,
            target_negative_deg=self._set_up.target_negative_deg,
        )

    def _show_slow(self) -> None:
        if self._measuring is not None:
            counters = self._measuring.feed.counters()
            self._behind.count(counters)
            self.counted.emit(counters)
        if self._count is not None:
            before = self._count.repetitions
            if self._count.count() > before and self._measuring is not None:
                self._measuring.feed.tell("repetition", self._count.last_end_s)
        self._show_buttons()

    def _show_buttons(self) -> None:
        state = self.recording_state
        recording = state != "off" and not self.storing  # what is stopped takes no more notes
        self.note.setEnabled(recording)
        self.pain.setEnabled(recording)
        self.pause.setEnabled(recording)
        if self._camera_lost:
            self.pause.setEnabled(False)  # nothing can go on without pictures
        paused = state == "paused" and not self._camera_lost
        self.pause.set_face(self.tr("Go on") if paused else self.tr("Pause"), icon="play" if paused else "pause")
        if not self._stopping:
            self.main.setEnabled(True)
            stored = self._measuring is not None and self._measuring.starts_with_recording
            words = self.tr("Play and record") if stored else self.tr("Record")
            if recording:
                follows = self._set_up is not None and next_part(self._set_up) is not None
                words = self.tr("Stop and go on") if follows else self.tr("Stop and review")
            elif self._shown_left_s:
                words = self.tr("Starts in {seconds}: not yet").format(seconds=self._shown_left_s)
            hint = self.tr("Space") if is_tight(self, self._theme) else self.tr("Space · pedal")
            self.main.set_face(words, icon="square" if recording else "", hint=hint)

    def _paint_overlay(self, painter: QPainter, picture: PictureView) -> None:
        if not self.question.covers_head:
            picture.paint_area_label(painter)
        if not self._overlay_on or self._view is None or self._measuring is None or self._behind.late_s:
            return
        calibration = self._measuring.calibration
        frame = self._view.tracked
        if self._whole_hand:
            self._paint_hand(painter, picture, frame)
            self._paint_question(painter, picture, frame)
            return
        overlay.paint_links(painter, frame, self._measuring.camera, picture.to_screen)
        overlay.paint_markers(painter, frame, picture.to_screen, picture.scale)
        asked = self.question.doubt is not None  # then the discs are what is to be looked at
        if self._research and calibration is not None and frame.status != TrackStatus.LOST and not asked:
            shown = QRectF(picture.rect())
            camera = self._measuring.camera
            overlay.paint_axes(painter, self._theme, frame, calibration, camera, picture.to_screen, shown)
        self._paint_question(painter, picture, frame)

    def _paint_question(self, painter: QPainter, picture: PictureView, frame: TrackedFrame) -> None:
        """What is asked about, as it lies in the picture shown."""
        asked, calibration = self.question.doubt, self._measuring.calibration if self._measuring else None
        if asked is None or calibration is None or self._measuring is None:
            return
        now = doubt_of(frame, calibration.clicks.protocol.markers, self._measuring.camera)
        if now is not None and now.marker == asked.marker and now.has_spot and now.hidden == asked.hidden:
            paint_question(painter, self._theme, now, picture, QRectF(self.question.geometry()))

    def _paint_hand(self, painter: QPainter, picture: PictureView, frame: TrackedFrame) -> None:
        assert self._measuring is not None
        assert self._set_up is not None
        skeleton.paint_skeleton(
            painter, frame, self._set_up.protocol, self._measuring.camera, picture.to_screen, picture.scale
        )
        figure = self.number.reading.figure
        if self._side_on and figure is not None:
            name = self.tr("Side · {finger}").format(finger=inside(long_finger_name(str(figure.finger))))
            skeleton.paint_side(
                painter,
                self._theme,
                frame,
                self._set_up.protocol,
                figure.finger,
                name,
                QRectF(picture.rect()),
                self._set_up.side,
            )
