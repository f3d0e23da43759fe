"""The live screen: frame, number, curves and light, updated by a timer."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QPainter
from PySide6.QtWidgets import QHBoxLayout, QLayout, QWidget

from carpus.core.model.hand.protocols import PROTOCOLS
from carpus.core.pipeline.live_values import LiveCounters, TrackedView
from carpus.core.records.session_setup import SessionSetup
from carpus.ui.charts.finger_curves import FingerCurves
from carpus.ui.charts.history import History, MarkerVisibility
from carpus.ui.charts.live_curves import LiveCurves
from carpus.ui.kit.background import Background
from carpus.ui.kit.button import Button
from carpus.ui.kit.card import Separator, progress_bar
from carpus.ui.kit.keys import bind_screen_keys
from carpus.ui.kit.layouts import STRETCH, FittedWidget, column_layout, fill, row_layout
from carpus.ui.kit.text import SEMIBOLD, Text
from carpus.ui.kit.theme import GAP_PX, MARGIN_PX, Theme, is_tight
from carpus.ui.picture.movement_guide import ExerciseSnapshot
from carpus.ui.picture.overlay import paint_tracked_hand
from carpus.ui.picture.view import HAND_AREA_FACTOR, PALM_AREA_FACTOR, FrameView
from carpus.ui.screens.live.controls import NoteDialog, PainDialog, RecordingControls
from carpus.ui.screens.live.number_card import NumberCard, Reading, current_reading
from carpus.ui.screens.live.recording import RecordingController
from carpus.ui.screens.live.status_light import (
    StatusLight,
    SteadyLight,
    TrackingLag,
    catch_up_words,
    hand_light,
    lag_light,
    marker_light,
)
from carpus.ui.screens.tour.bubble import MIN_SCREEN_PX, BubbleView
from carpus.ui.words.finger_angles import find_finger_angle

if TYPE_CHECKING:  # it reads and writes files
    from carpus.core.pipeline.measurement import MeasurementController

CHECK_EVERY_MS = 8
"""Interval of the checks for a new frame, which limits the delay of the curves."""
MIN_DRAW_INTERVAL_MS = 25
"""Frames that arrive sooner are in the curves, but are not drawn on their own."""
MAX_DRAWING_SHARE = 0.5
"""Largest share of a processor for drawing: a slow computer draws less often, and tracks all frames."""
STORING_INTERVAL_MS = 500
"""Drawing interval while a recording is stored, which needs the processor."""
MAX_TICK_INTERVAL_MS = 40
"""Drawing interval without new frames."""
VALUES_EVERY = 3
SLOW_EVERY = 30
WRIST_COLUMNS, HAND_COLUMNS = (520, 696), (440, 776)
SNAPSHOT_EVERY_S = 0.09
STALE_S = 0.4
"""Without a new frame for this long, the last tracked one is not current."""


class LiveScreen(FittedWidget):
    """Screen while measuring.

    ``recording_changed`` (state, seconds) and ``counters_changed`` feed the top bar; ``event_received`` carries
    events of the source and faults.
    """

    recording_changed = Signal(str, float)
    counters_changed = Signal(LiveCounters)
    event_received = Signal(object)
    snapshot_taken = Signal(ExerciseSnapshot)
    """State of the trained angle, as often as the values change."""

    def __init__(self, theme: Theme, background: Background) -> None:
        super().__init__()
        self._theme = theme
        self.history = History(PROTOCOLS[0])
        self.recording = RecordingController(background, self.history)
        self._steady_light, self._steady_doubt, self._lag = SteadyLight(), SteadyLight(), TrackingLag()
        self._tracked_view: TrackedView | None = None
        self._draw_count = 0
        self._drawn_at_s, self._drawn_cpu_s = -math.inf, 0.0
        self._drawing_ms: float | None = 0.0
        self._new_frame_at_s = self._snapshot_at_s = -math.inf
        self._is_whole_hand = False
        self.stage = QWidget()
        """Everything but the bar below: messages cover this part, and the light stays visible."""
        self.picture = FrameView(theme)
        self.picture.overlay = self._paint_overlay
        self.number_card = NumberCard(theme)
        self.curves = LiveCurves(theme, self.history)
        self.finger_curves = FingerCurves(theme, self.history)
        self.controls = RecordingControls(theme, self.recording)
        self.speeds_button = Button(theme, self.tr("Speeds"), hint="F4", height_px=32)
        self.patient_view_button = Button(theme, self.tr("Patient’s view"), icon="monitor", height_px=32)
        self.course_label = Text(theme, "", 16, SEMIBOLD, wrap=True)
        """Part of a running set of exercises, and the remaining rest."""
        self.course_label.hide()
        self.catch_up_bar = progress_bar(self.tr("Progress of the analysis"))
        self.catch_up_bar.hide()
        self.bubble = BubbleView(theme, wide=True, keys=False)
        self.note_dialog = NoteDialog(self.stage, theme)
        self.pain_dialog = PainDialog(self.stage, theme)
        self._build_layout()
        self._connect()
        theme.changed.connect(self._fit)
        self._timer = QTimer(self, timerType=Qt.TimerType.PreciseTimer, interval=CHECK_EVERY_MS)
        self._timer.timeout.connect(self.draw_if_due)

    def _build_layout(self) -> None:
        right = column_layout(self.number_card, (self.curves, 1), (self.finger_curves, 1), gap=12)
        self._columns = columns = QHBoxLayout(self.stage)
        columns.setContentsMargins(MARGIN_PX, GAP_PX, MARGIN_PX, 12)
        columns.setSpacing(GAP_PX)
        fill(columns, (self.picture, 520), (right, 696))
        on_picture = [
            (button, 0, Qt.AlignmentFlag.AlignTop) for button in (self.speeds_button, self.patient_view_button)
        ]
        for button, *_ in on_picture:
            button.setProperty("floats", True)
            button.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        row_layout(STRETCH, *on_picture, gap=8, margins=(0, 8, 8, 0), parent=self.picture)
        whole = column_layout(
            (self.stage, 1), _with_margins(self.course_label, 8), gap=0, margins=(0, 0, 0, 0), parent=self
        )
        fill(whole, _with_margins(self.bubble, 4), self.catch_up_bar, Separator(self._theme), self.controls)

    def _connect(self) -> None:
        recording, controls = self.recording, self.controls
        controls.note_button.clicked.connect(lambda: self.note_dialog.open_note(passive=recording.is_passive))
        controls.pain_button.clicked.connect(lambda: self.pain_dialog.open())
        controls.pause_button.clicked.connect(recording.toggle_pause)
        controls.main_button.clicked.connect(recording.toggle)
        self.note_dialog.note_entered.connect(lambda words: recording.add_event("note", words))
        self.note_dialog.passive_changed.connect(lambda passive: recording.set_passive(passive=passive))
        self.pain_dialog.pain_entered.connect(self._add_pain)
        self.speeds_button.clicked.connect(self.toggle_speeds)
        recording.started.connect(lambda: self._lag.start_recording())
        recording.start_failed.connect(self.event_received)
        recording.stopping.connect(controls.show_storing)
        for ended in (recording.stopped, recording.stop_failed):
            ended.connect(self.catch_up_bar.hide)
        picture, number = self.picture, self.number_card
        # Named keys of ui/kit/keys.py: Space starts and stops a recording.
        actions = {
            "record": recording.toggle, "pedal": recording.toggle, "note": controls.note_button.click,
            "pain": controls.pain_button.click, "pause": recording.toggle_pause,
            "whole_picture": lambda: picture.set_whole(not picture.is_whole),
            "next_angle": lambda: self.show_angle(number.reading.with_next_angle()),
            "next_finger": lambda: self.show_angle(number.reading.with_next_finger()),
            "speeds": self.toggle_speeds, "patient_view": self.patient_view_button.click,
        }  # fmt: skip
        self.finger_curves.angle_chosen.connect(lambda figure: self.show_angle(Reading(figure=figure)))
        bind_screen_keys(self, actions)

    def _fit(self) -> None:
        """Show the curves of the wrist or of the fingers."""
        tight, hand = is_tight(self, self._theme), self._is_whole_hand
        self.curves.setVisible(not hand)
        self.finger_curves.setVisible(hand)
        for place, share in enumerate(HAND_COLUMNS if hand else WRIST_COLUMNS):
            self._columns.setStretch(place, share)
        self.bubble.set_room(self.height() >= MIN_SCREEN_PX * self._theme.text_scale and not (tight and hand))
        self.curves.show_single(tight)
        self.controls.fit(tight=tight)

    # --- life ---------------------------------------------------------------------------------------------
    def open_source(
        self,
        measuring: MeasurementController,
        set_up: SessionSetup,
        is_hand_resting: Callable[[], bool] = lambda: False,
    ) -> None:
        """Show a source; it cannot be recorded while ``is_hand_resting``."""
        exercise, calibration = set_up.exercise, measuring.calibration
        self.history.clear(set_up.protocol, exercise, None if calibration is None else calibration.start_angles_rad)
        self.number_card.exercise = exercise
        self._is_whole_hand = set_up.protocol.has_fingers
        self._steady_light, self._steady_doubt, self._lag = SteadyLight(), SteadyLight(), TrackingLag()
        self._tracked_view = None
        self.recording.set_source(measuring, set_up)
        self.recording.is_hand_resting = is_hand_resting
        self.curves.set_exercise(exercise, set_up.target_positive_deg, set_up.target_negative_deg)
        angle = 1 if exercise.angle is None else exercise.angle
        self.show_angle(Reading(angle=angle, figure=find_finger_angle(exercise.joint) if self._is_whole_hand else None))
        self.controls.reset()
        self._fit()
        waits, plays = self.tr("Waiting for the camera image"), self.tr("The recording plays from its first frame")
        self.picture.clear(plays if self.recording.is_playback else waits)
        room = HAND_AREA_FACTOR if self._is_whole_hand else PALM_AREA_FACTOR
        self.picture.set_hand_area(None if calibration is None else calibration.clicks.pixel, room)
        self._timer.start()
        self.setFocus(Qt.FocusReason.OtherFocusReason)

    def close_source(self) -> None:
        self._timer.stop()
        self.recording.measuring = None
        self.recording_changed.emit("off", 0.0)

    def toggle_speeds(self) -> None:
        """Show the curves of speeds in place of those of angles, or angles again."""
        shows_speeds = not self.curves.is_showing_speeds
        self.curves.show_speeds(shows_speeds)
        self.finger_curves.show_speeds(shows_speeds)
        self.speeds_button.set_label(self.tr("Angles") if shows_speeds else self.tr("Speeds"))

    def show_angle(self, reading: Reading) -> None:
        reading = reading.with_targets(self.recording.set_up)
        if reading.figure is not None:
            self.finger_curves.set_angle(reading.figure, reading.target_positive_deg)
        self.number_card.show_reading(reading)
        if reading.figure is not None and self.recording.measuring is not None and len(self.history):
            self.number_card.show_reading(current_reading(reading, self.history, self.recording))

    def set_camera_lost(self, lost: bool) -> None:
        """Show that the camera was lost or is back; nothing old stays on the screen meanwhile."""
        self.recording.set_camera_lost(lost=lost)
        self.finger_curves.set_waiting(lost)
        if lost:
            self.picture.clear(self.tr("No image"))
            self._tracked_view = None

    def set_patient_view(self, is_open: bool) -> None:
        self.patient_view_button.set_label(self.patient_view_button.text(), icon="check" if is_open else "monitor")
        words = self.tr("Close the patient’s view") if is_open else self.tr("Open the patient’s view")
        self.patient_view_button.setAccessibleName(words)

    def _add_pain(self, score: int) -> None:
        if self.recording.add_event("pain", str(score)):
            self.controls.show_pain(score)

    # --- drawing ------------------------------------------------------------------------------------------
    def draw_if_due(self) -> None:
        """Draw as soon as there is a new frame, and now and then without one."""
        if self.recording.measuring is None:
            return
        since_ms = 1e3 * (time.monotonic() - self._drawn_at_s)
        if self._drawing_ms is None:  # the first look since: all that was asked for has been painted
            self._drawing_ms = 1e3 * (time.thread_time() - self._drawn_cpu_s)
        least_ms = STORING_INTERVAL_MS if self.recording.is_storing else MIN_DRAW_INTERVAL_MS
        if since_ms < max(least_ms, self._drawing_ms / MAX_DRAWING_SHARE):
            return
        is_new = self._is_new(self.recording.measuring.feed.current_view())
        if since_ms >= MAX_TICK_INTERVAL_MS or (is_new and not self.recording.camera_lost):
            self.draw()

    def _is_new(self, view: TrackedView | None) -> bool:
        return view is not None and (
            self._tracked_view is None or view.tracked.index != self._tracked_view.tracked.index
        )

    def draw(self) -> None:
        recording, measuring = self.recording, self.recording.measuring
        if measuring is None:
            return
        passed_s = min(time.monotonic() - self._drawn_at_s, 0.001 * STORING_INTERVAL_MS)
        self._drawn_at_s, self._drawn_cpu_s, self._drawing_ms = time.monotonic(), time.thread_time(), None
        feed, lost = measuring.feed, recording.camera_lost
        fresh = feed.frames_since(self.history.last_index)
        self.history.append(fresh)
        if fresh:
            self._new_frame_at_s = self._drawn_at_s
        begin = feed.first_recorded_index
        if recording.counter is not None and begin is not None and not feed.is_paused:
            recording.counter.append([tracked for tracked in fresh if tracked.index >= begin])
        view, newest = feed.current_view(), feed.current_frame()
        is_new, behind = self._is_new(view), self._lag.update(newest, view)
        if behind and newest is not None and not lost:
            self.picture.show_frame(newest.color_rgb)
        if view is not None and is_new and fresh and not lost:
            self._tracked_view = view
            if not behind:
                self.picture.show_frame(view.frame.color_rgb)
            self.current_chart().draw()
        if fresh and not lost:
            recording.check_start_trigger()
        if lost:
            self.history.add_waiting_time(passed_s)
            self.current_chart().draw()
        if self._draw_count % VALUES_EVERY == 0 or recording.is_storing:
            self._show_values()
        if self._drawn_at_s - self._snapshot_at_s >= SNAPSHOT_EVERY_S:
            self._snapshot_at_s = self._drawn_at_s
            self.snapshot_taken.emit(self.exercise_snapshot())
        if self._draw_count % SLOW_EVERY == 0:
            self._show_counters()
        self._draw_count += 1
        for event in feed.drain_events():
            self.event_received.emit(event)

    def current_chart(self) -> FingerCurves | LiveCurves:
        return self.finger_curves if self._is_whole_hand else self.curves

    def exercise_snapshot(self) -> ExerciseSnapshot:
        """Return the state of the trained angle, whichever angle is shown."""
        stale = time.monotonic() - self._new_frame_at_s > STALE_S
        return self.recording.exercise_snapshot(is_current=not (self._lag.lag_s or stale))

    def _show_values(self) -> None:
        recording, measuring = self.recording, self.recording.measuring
        if measuring is None:
            return
        self.current_chart().update_values()
        self.controls.light_view.show_light(self._current_light(measuring))
        if recording.is_storing:  # how long it takes until all that waits is tracked
            counters = measuring.feed.counters()
            left = self._lag.catch_up_progress(counters)
            self.catch_up_bar.setVisible(left is not None)
            self.controls.show_storing(catch_up_words(counters) if left else "")
            if left is not None:
                self.catch_up_bar.setRange(0, max(left[1], 1))
                self.catch_up_bar.setValue(left[0])
        self.number_card.show_reading(current_reading(self.number_card.reading, self.history, recording))
        self.recording_changed.emit(recording.state, recording.duration_s)

    def _current_light(self, measuring: MeasurementController) -> StatusLight:
        """Return the light: of the camera, else of the computer, a doubtful marker, or the start."""
        recording, calibration, view = self.recording, measuring.calibration, self._tracked_view
        if recording.camera_lost:
            return StatusLight("bad", self.tr("No image"), self.tr("Plug the camera in again"))
        markers = calibration.clicks.protocol.markers if calibration else ()
        frame = None if view is None else view.tracked
        if self._is_whole_hand:
            lamp = hand_light(frame, self.history.marker_visibility())
        else:
            pure = recording.set_up is not None and recording.set_up.exercise.is_forearm_fixed
            pixels = () if frame is None else zip(markers, frame.marker_measured_px, strict=True)
            seen: dict[str, MarkerVisibility] = {
                name: "seen" if math.isfinite(pixel[0]) else "hidden" for name, pixel in pixels
            }
            now = hand_light(frame, seen, has_forearm_moved=pure and self.history.has_forearm_moved())
            lamp = self._steady_light.update(now, recording.time_s)
        if self._lag.lag_s:
            return lag_light(self._lag, recording=recording.state != "off")
        doubt = self._steady_doubt.update(marker_light(frame, markers, measuring.camera), recording.time_s)
        if doubt.state and lamp.rank in ("good", "warn"):
            return doubt
        if lamp.rank == "good" and recording.is_hand_resting():
            return StatusLight(
                "idle", self.tr("Preparing the simulated hand"), self.tr("Recording can start in a moment")
            )
        if lamp.rank == "good" and recording.countdown_s:
            return StatusLight("good", self.tr("Starts in {seconds}").format(seconds=recording.countdown_s), "")
        if lamp.rank == "good" and recording.start_trigger.is_waiting and recording.state == "off":
            return StatusLight("good", lamp.state, self.tr("Starts automatically when the hand is still"))
        return lamp

    def _paint_overlay(self, painter: QPainter, picture: FrameView) -> None:
        """Paint markers and model of the tracked view, unless the frame is newer."""
        measuring, set_up = self.recording.measuring, self.recording.set_up
        if self._tracked_view is None or measuring is None or set_up is None or self._lag.lag_s:
            return
        frame, camera = self._tracked_view.tracked, measuring.camera
        paint_tracked_hand(painter, frame, set_up.protocol, camera, picture.to_screen)

    def _show_counters(self) -> None:
        measuring, count = self.recording.measuring, self.recording.counter
        if measuring is None:
            return
        counters = measuring.feed.counters()
        self._lag.count_missing(counters)
        self.counters_changed.emit(counters)
        if count is not None:
            before = count.repetitions
            if count.update_count() > before:
                measuring.feed.notify_listener("repetition", count.last_end_s)
        self.controls.refresh()


def _with_margins(widget: QWidget, below_px: int) -> QLayout:
    return row_layout(widget, margins=(MARGIN_PX, 0, MARGIN_PX, below_px))
