"""The live screen: arranges picture, path, number, curves and light, and pulls the newest values by a timer."""

from __future__ import annotations

import math
import time
from typing import TYPE_CHECKING

from PySide6.QtCore import QEvent, QObject, Qt, QTimer, Signal
from PySide6.QtWidgets import QHBoxLayout, QLayout, QWidget

from carpus.core.hand.protocols import PROTOCOLS
from carpus.core.pipeline.live_values import LiveCounters, TrackedView
from carpus.core.records.set_up import SetUp
from carpus.ui.background import Background
from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Line
from carpus.ui.controls.layouts import STRETCH, Fitted, fill, in_column, in_line
from carpus.ui.controls.progress_bar import ThinBar
from carpus.ui.controls.text import SEMIBOLD, Text
from carpus.ui.figures import figure_of
from carpus.ui.keys import bind_screen
from carpus.ui.live.controls import Controls
from carpus.ui.live.doubt import doubt_lamp, doubt_of
from carpus.ui.live.hand_map import HandMap
from carpus.ui.live.light import Behind, Lamp, SteadyLight, behind_lamp, hand_lamp, lamp_for, words_left
from carpus.ui.live.notes import NoteSheet, PainSheet
from carpus.ui.live.number_card import NumberCard, Reading
from carpus.ui.live.on_picture import OnPicture
from carpus.ui.live.question import SpotQuestion
from carpus.ui.live.readings import Readings
from carpus.ui.live.recording import Recording
from carpus.ui.patient.guide import Glance
from carpus.ui.picture.view import HAND_ROOM, PALM_ROOM, PictureView
from carpus.ui.plot.chart import Chart
from carpus.ui.plot.finger_curves import FingerCurves
from carpus.ui.plot.history import History
from carpus.ui.plot.live_curves import LiveCurves
from carpus.ui.plot.ways import PathView
from carpus.ui.theme import GAP_PX, MARGIN_PX, Theme, is_tight
from carpus.ui.tour.bubble import LEAST_SCREEN_PX, BubbleView

if TYPE_CHECKING:  # it reads and writes files
    from carpus.core.pipeline.measuring import SourceMeasuring

LOOK_EVERY_MS = 8
"""So often the screen looks for a new picture: the curves are as old as this, not as the time between two drawings."""
DRAW_AFTER_MS = 25
"""Never sooner after the last drawing; what arrives in between is in the curves, not drawn on its own."""
DRAWING_SHARE = 0.5
"""At most this part of a processor goes to drawing: on a slow computer fewer drawings, not fewer pictures tracked."""
STORING_EVERY_MS = 500
"""While what was recorded is stored, which is waited for, and needs the processor."""
TICK_EVERY_MS = 40
"""So often figures and state go on where no pictures come."""
VALUES_EVERY = 3
SLOW_EVERY = 30
WRIST_COLUMNS, HAND_COLUMNS = (520, 696), (440, 776)
GLANCE_EVERY_S = 0.09
STALE_S = 0.4
"""Without a new picture for so long, what was tracked last is not the hand of now."""


class LiveScreen(Fitted):
    """``recording_changed`` (state, seconds) and ``counted`` feed the top bar; ``told`` carries events of the source
    and faults of commands."""

    recording_changed = Signal(str, float)
    counted = Signal(LiveCounters)
    told = Signal(object)
    patient_wanted = Signal()
    """A person opens or closes the patient's own view."""
    glanced = Signal(Glance)
    """How the trained angle stands, as often as the figures change."""

    def __init__(self, theme: Theme, background: Background) -> None:
        super().__init__()
        self._theme = theme
        self.history = History(PROTOCOLS[0])
        self.recording = Recording(background, self.history)
        self.readings = Readings(self.history, self.recording)
        self._light, self._behind = SteadyLight(), Behind()
        self._view: TrackedView | None = None
        self._tick = 0
        self._ticked_at_s, self._ticked_cpu_s = -math.inf, 0.0
        self._drawing_ms: float | None = 0.0
        self._fresh_at_s = self._glanced_at_s = -math.inf
        self._whole_hand = self._large = False
        self._research = True
        self.stage = QWidget()
        """All but the bar below: what a message may cover while the light goes on speaking to the far eye."""
        self.picture = PictureView(theme)
        self.question = SpotQuestion(self.picture, theme, self, lambda: self.recording.now_s)
        self.on_picture = OnPicture(theme, self.picture, self.question, self.recording)
        self.path = PathView(theme, self.history)
        self.number = NumberCard(theme)
        self.curves = LiveCurves(theme, self.history)
        self.fingers = FingerCurves(theme, self.history)
        self.hand_map = HandMap(theme)
        self.controls = Controls(theme, self.recording)
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
        self._connect()
        self.picture.installEventFilter(self)
        theme.changed.connect(self._fit)
        self._timer = QTimer(self, timerType=Qt.TimerType.PreciseTimer, interval=LOOK_EVERY_MS)
        self._timer.timeout.connect(self.look)

    def _lay_out(self) -> None:
        left = in_column((self.picture, 390), (self.path, 242), (self.hand_map, 300), gap=12)
        right = in_column(self.number, (self.curves, 1), (self.fingers, 1), gap=12)
        self._columns = columns = QHBoxLayout(self.stage)
        columns.setContentsMargins(MARGIN_PX, GAP_PX, MARGIN_PX, 12)
        columns.setSpacing(GAP_PX)
        fill(columns, (left, 520), (right, 696))
        # Over the corner of the curves that nothing is written in, and over the picture.
        for button, host, top_px, right_px in ((self.speeds, self.curves, 4, 6), (self.patient, self.picture, 8, 8)):
            button.setProperty("floats", True)
            in_line(STRETCH, (button, 0, Qt.AlignmentFlag.AlignTop), margins=(0, top_px, right_px, 0), within=host)
        whole = in_column((self.stage, 1), _between_margins(self.course, 8), gap=0, margins=(0, 0, 0, 0), within=self)
        fill(whole, _between_margins(self.bubble, 4), self.catching_up, Line(self._theme), self.controls)

    def _connect(self) -> None:
        recording, controls = self.recording, self.controls
        controls.note.clicked.connect(lambda: self.note_sheet.begin(passive=recording.passive))
        controls.pain.clicked.connect(self.pain_sheet.begin)
        controls.pause.clicked.connect(recording.toggle_pause)
        controls.main.clicked.connect(recording.toggle)
        self.note_sheet.kept.connect(lambda words: recording.note("note", words))
        self.note_sheet.moved.connect(lambda passive: recording.say_way(passive=passive))
        self.pain_sheet.kept.connect(self._keep_pain)
        self.speeds.clicked.connect(self.toggle_speeds)
        self.patient.clicked.connect(self.patient_wanted)
        for button in (self.speeds, self.patient):
            button.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        recording.begun.connect(lambda: self._behind.begin())
        recording.not_begun.connect(self.told)
        recording.stopping.connect(controls.say_storing)
        for ended in (recording.stopped, recording.stop_failed):
            ended.connect(self.catching_up.hide)
        picture, number = self.picture, self.number
        actions = {
            "record": recording.toggle, "pedal": recording.toggle, "note": controls.note.click,
            "pain": controls.pain.click, "pause": recording.toggle_pause, "overlay": self.on_picture.toggle,
            "whole_picture": lambda: picture.show_whole(not picture.shows_whole), "speeds": self.toggle_speeds,
            "next_angle": lambda: self.choose(number.reading.with_next_angle()),
            "next_finger": lambda: self.choose(number.reading.with_next_finger()),
            "side_view": self.on_picture.toggle_side, "patient_view": self.patient_wanted.emit,
            "large_view": self.toggle_large,
        }  # fmt: skip
        self.fingers.chosen.connect(lambda figure: self.choose(Reading(figure=figure)))
        self._shortcuts = bind_screen(self, actions)
        self.question.other_keys = list(self._shortcuts.values())
        self.question.changed.connect(self._place_question)
        self.question.answered.connect(recording.answer_spot)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """The question keeps its place on the picture."""
        if watched is self.picture and event.type() == QEvent.Type.Resize:
            QTimer.singleShot(0, self._place_question)  # when the picture has its new place
        return super().eventFilter(watched, event)

    def _place_question(self) -> None:
        """A question over the head of the picture takes the place of the button there, whose key goes on working."""
        self.question.place()
        self.patient.setVisible(self.question.isHidden() or self.question.y() > self.patient.geometry().bottom())

    def show_research(self, *, on: bool) -> None:
        """The path with its axes and the speeds, or neither; that the forearm lies still is watched all the same."""
        self._research = self.on_picture.research = on
        if not on and self.curves.shows_speeds:
            self.toggle_speeds()
        self._shortcuts["speeds"].setEnabled(on)
        self._fit()

    def _fit(self) -> None:
        """With large text on a small screen, what is read from afar keeps its room and the path gives way."""
        tight = is_tight(self, self._theme)
        small, hand = not self._large, self._whole_hand
        self.picture.setVisible(small)
        self.path.setVisible(small and not tight and not hand and self._research)
        self.speeds.setVisible(self._research)
        self.hand_map.setVisible(small and not tight and hand)
        self.curves.setVisible(small and not hand)
        self.fingers.setVisible(small and hand)
        for place, share in enumerate(HAND_COLUMNS if hand else WRIST_COLUMNS):
            self._columns.setStretch(place, share if small or place else 0)
        self.bubble.give_room(self.height() >= LEAST_SCREEN_PX * self._theme.text_scale and not (tight and hand))
        self.curves.show_single(tight)
        self._place_question()
        self.controls.fit(tight=tight, large=self._large)

    # --- life ---------------------------------------------------------------------------------------------
    def begin(self, measuring: SourceMeasuring, set_up: SetUp) -> None:
        exercise, calibration = set_up.exercise, measuring.calibration
        self.history.clear(set_up.protocol, exercise, None if calibration is None else calibration.start_angles_rad)
        self.number.exercise = exercise
        self._whole_hand = set_up.protocol.has_fingers
        self._light, self._behind, self._view = SteadyLight(), Behind(), None
        self.on_picture.view = None
        self.question.withdraw()
        self.recording.open(measuring, set_up)
        self.curves.set_exercise(exercise, set_up.target_positive_deg, set_up.target_negative_deg)
        self.path.set_exercise(set_up.side, exercise.pure_wrist)
        angle = 1 if exercise.angle is None else exercise.angle
        self.choose(Reading(angle=angle, figure=figure_of(exercise.joint) if self._whole_hand else None))
        self.controls.begin()
        self.hand_map.set_side(set_up.side)
        self._fit()
        waits, plays = self.tr("Waiting for a picture"), self.tr("The recording plays from its first picture")
        self.picture.clear(plays if self.recording.plays else waits)
        room = HAND_ROOM if self._whole_hand else PALM_ROOM
        self.picture.set_hand_area(None if calibration is None else calibration.clicks.pixel, room)
        self._timer.start()
        self.setFocus(Qt.FocusReason.OtherFocusReason)

    def end(self) -> None:
        self._timer.stop()
        self.recording.measuring = None
        self.recording_changed.emit("off", 0.0)

    def toggle_large(self) -> None:
        """One figure and the light, to be read from across the room, or everything."""
        self._large = not self._large
        self.number.set_large(self._large)
        self._fit()

    def toggle_speeds(self) -> None:
        self.curves.show_speeds(not self.curves.shows_speeds)
        self.fingers.show_speeds(self.curves.shows_speeds)
        self.speeds.set_face(self.tr("Angles") if self.curves.shows_speeds else self.tr("Speeds"))

    def choose(self, reading: Reading) -> None:
        reading = self.readings.with_targets(reading)
        self.on_picture.figure = reading.figure
        if reading.figure is not None:
            self.fingers.set_figure(reading.figure, reading.target_positive_deg)
        self.number.show_reading(reading)
        if reading.figure is not None and self.recording.measuring is not None and len(self.history):
            self.number.show_reading(self.readings.now(reading))

    def set_camera_lost(self, lost: bool) -> None:
        """The camera went or came back; while it is gone nothing old is shown as if it were now."""
        self.recording.set_camera_lost(lost=lost)
        self.fingers.set_waiting(lost)
        if lost:
            self.question.withdraw()
            self.picture.clear(self.tr("No picture"))
            self._view = self.on_picture.view = None

    def set_patient_view(self, is_open: bool) -> None:
        self.patient.set_face(self.patient.text(), icon="check" if is_open else "monitor")
        words = self.tr("Close the patient’s view") if is_open else self.tr("Open the patient’s view")
        self.patient.setAccessibleName(words)

    def show_course(self, words: str) -> None:
        """Which part of a set it is, and how long the rest still is; empty outside a set."""
        self.course.say(words)

    def _keep_pain(self, score: int) -> None:
        if self.recording.note("pain", str(score)):
            self.controls.noted_pain(score)

    # --- drawing ------------------------------------------------------------------------------------------
    def look(self) -> None:
        """Draw as soon as there is a new picture, and go on without one now and then."""
        if self.recording.measuring is None:
            return
        since_ms = 1e3 * (time.monotonic() - self._ticked_at_s)
        if self._drawing_ms is None:  # the first look since: all that was asked for has been painted
            self._drawing_ms = 1e3 * (time.thread_time() - self._ticked_cpu_s)
        least_ms = STORING_EVERY_MS if self.recording.storing else DRAW_AFTER_MS
        if since_ms < max(least_ms, self._drawing_ms / DRAWING_SHARE):
            return
        is_new = self._is_new(self.recording.measuring.feed.newest())
        if since_ms >= TICK_EVERY_MS or (is_new and not self.recording.camera_lost):
            self.tick()

    def _is_new(self, view: TrackedView | None) -> bool:
        return view is not None and (self._view is None or view.tracked.index != self._view.tracked.index)

    def tick(self) -> None:
        recording, measuring = self.recording, self.recording.measuring
        if measuring is None:
            return
        passed_s = min(time.monotonic() - self._ticked_at_s, 0.001 * STORING_EVERY_MS)
        self._ticked_at_s, self._ticked_cpu_s, self._drawing_ms = time.monotonic(), time.thread_time(), None
        feed, lost = measuring.feed, recording.camera_lost
        fresh = feed.tracked_since(self.history.last_index)
        self.history.append(fresh)
        if fresh:
            self._fresh_at_s = self._ticked_at_s
        begin = feed.recorded_from
        if recording.count is not None and begin is not None and not feed.paused:
            recording.count.append([tracked for tracked in fresh if tracked.index >= begin])
        view, newest = feed.newest(), feed.newest_frame()
        is_new, behind = self._is_new(view), self._behind.look(newest, view)
        self.on_picture.late = behind
        if behind and newest is not None and not lost:
            self.picture.show_frame(newest.color_rgb)
        if view is not None and is_new and fresh and not lost:
            self._view = self.on_picture.view = view
            if not behind:
                self.picture.show_frame(view.frame.color_rgb)
            self.plots().draw()
        if fresh and not lost:
            recording.look_for_start()
        if lost:
            self.history.wait(passed_s)
            self.plots().draw()
        if self._tick % VALUES_EVERY == 0 or recording.storing:
            self._show_values()
        if self._ticked_at_s - self._glanced_at_s >= GLANCE_EVERY_S:
            self._glanced_at_s = self._ticked_at_s
            self.glanced.emit(self.glance())
        if self._tick % SLOW_EVERY == 0:
            self._show_slow()
        self._tick += 1
        for event in feed.drain_events():
            self.told.emit(event)

    def plots(self) -> Chart:
        return self.fingers if self._whole_hand else self.curves

    def glance(self) -> Glance:
        """The trained angle of this moment, whichever figure is the large one."""
        stale = time.monotonic() - self._fresh_at_s > STALE_S
        return self.readings.glance(is_now=not (self._behind.late_s or stale))

    def _show_values(self) -> None:
        measuring = self.recording.measuring
        if measuring is None:
            return
        if self._whole_hand:
            self.fingers.refresh_values()
            self.hand_map.show_seen(self.history.seen(), infers_ends=self.history.infers)
        else:
            self.curves.refresh_values()
            self.path.draw()
        self.controls.light.show_lamp(self._lamp(measuring))
        if self.recording.storing:  # how long it takes until all that waits is tracked
            counters = measuring.feed.counters()
            left = self._behind.catching_up(counters)
            self.catching_up.setVisible(left is not None)
            self.controls.say_storing(words_left(counters) if left else "")
            if left is not None:
                self.catching_up.show_progress(*left)
        self.number.show_reading(self.readings.now(self.number.reading))
        self.recording_changed.emit(self.recording.state, self.recording.recorded_s)

    def _lamp(self, measuring: SourceMeasuring) -> Lamp:
        """What the light says: of the camera, else of the computer, of a question, of how it begins."""
        recording, calibration, view = self.recording, measuring.calibration, self._view
        if recording.camera_lost:
            return Lamp("bad", self.tr("No picture"), self.tr("Plug the camera in again"))
        markers = calibration.clicks.protocol.markers if calibration else ()
        frame = None if view is None else view.tracked
        if self._whole_hand:
            lamp = hand_lamp(frame, self.hand_map.seen)
        else:
            pure = recording.set_up is not None and recording.set_up.exercise.pure_wrist
            now = lamp_for(frame, markers, pure and self.history.forearm_moved())
            lamp = self._light.show(now, recording.now_s)
        if self._behind.late_s:  # what is asked would be about a picture of a while ago
            self.question.withdraw()
            return behind_lamp(self._behind, recording=recording.state != "off")
        doubt = self.question.look(doubt_of(frame, markers, measuring.camera))
        if doubt is not None and lamp.rank in ("good", "warn"):
            return doubt_lamp(doubt)
        if lamp.rank == "good" and recording.left_s:
            return Lamp("good", self.tr("Starts in {seconds}").format(seconds=recording.left_s), "")
        if lamp.rank == "good" and recording.beginning.waits and recording.state == "off":
            return Lamp("good", lamp.state, self.tr("Starts by itself when the hand lies still"))
        return lamp

    def _show_slow(self) -> None:
        measuring, count = self.recording.measuring, self.recording.count
        if measuring is None:
            return
        counters = measuring.feed.counters()
        self._behind.count(counters)
        self.counted.emit(counters)
        if count is not None:
            before = count.repetitions
            if count.count() > before:
                measuring.feed.tell("repetition", count.last_end_s)
        self.controls.refresh()


def _between_margins(widget: QWidget, below_px: int) -> QLayout:
    return in_line(widget, margins=(MARGIN_PX, 0, MARGIN_PX, below_px))
