"""The recording on the live screen: start by key, countdown or still hand; pause, notes, stop; live repetitions."""

from __future__ import annotations

import math
import time
from array import array
from collections import deque
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QObject, Signal

from carpus.core.measures.motion_range import MIN_FURTHER_RAD
from carpus.core.measures.repetitions import find_repetitions
from carpus.core.measures.signals import MAX_ANGLE_SD_RAD, MAX_FILLED_GAP_S, SETTLING_S, resample_evenly
from carpus.core.model.hand.exercises import FLEXION, PRONOSUPINATION, Exercise
from carpus.core.model.hand.forearm_rotation import pronosupination_from_palm_down, to_clinical_wrist_angles
from carpus.core.model.hand.protocols import MarkerProtocol
from carpus.core.model.types import FloatArray, TrackedFrame, TrackStatus
from carpus.core.pipeline.live_values import StartMode
from carpus.core.records.session_setup import SessionSetup
from carpus.core.results.repetition_rows import ACTIVE, PASSIVE
from carpus.ui.charts.history import History
from carpus.ui.kit.background import Background
from carpus.ui.picture.movement_guide import ExerciseSnapshot, RecordingState
from carpus.ui.words.finger_angles import FINGER_ANGLES, FINGERS, FingerAngle, estimate_finger_angles, find_finger_angle

if TYPE_CHECKING:
    from carpus.core.pipeline.measurement import MeasurementController

MIN_RECORDING_S = 3.0
"""A recording that is stopped sooner asks for confirmation."""
TIMED_PARTS = 10
"""Marks of progress for an exercise that goes by time."""


class RecordingController(QObject):
    """Starts and stops recordings on a source.

    Signals: ``changed`` state or countdown; ``started`` or ``start_failed`` with a fault; ``stopping``, then
    ``stopped`` with the session id or ``stop_failed`` with a fault.
    """

    changed = Signal()
    started = Signal()
    start_failed = Signal(object)
    stopped = Signal(str)
    stop_failed = Signal(object)
    stopping = Signal()
    early_stop_requested = Signal()
    """Emitted when a recording is stopped that has only just started."""

    def __init__(self, background: Background, history: History) -> None:
        super().__init__()
        self._background, self._history = background, history
        self.measuring: MeasurementController | None = None
        self.set_up: SessionSetup | None = None
        self.counter: RepetitionCounter | None = None
        self.start_mode: StartMode = "key"
        self.start_trigger = StartTrigger()
        self.countdown_s = 0
        """Seconds left in the countdown."""
        self.camera_lost = self.is_passive = self._is_resting = False
        self.is_hand_resting: Callable[[], bool] = lambda: False
        """Whether a simulated hand cannot move yet: a recording would show a still hand."""
        self.is_busy = False
        """True while it starts or stops, which waits for the disk."""
        self._started_at_s = -MIN_RECORDING_S

    def set_source(self, measuring: MeasurementController, set_up: SessionSetup) -> None:
        self.measuring, self.set_up, self.counter = measuring, set_up, None
        self.camera_lost = self.is_busy = self._is_resting = False
        self._arm_start_trigger()

    @property
    def state(self) -> RecordingState:
        feed = self.measuring.feed if self.measuring else None
        if feed is None or not feed.is_recording or (self.is_busy and self.counter is None):
            return "off"  # also while it is being started: nothing can be noted in it yet
        return "paused" if feed.is_paused or self.camera_lost else "recording"

    @property
    def is_storing(self) -> bool:
        """True while the recording is being stored."""
        return self.is_busy and self.counter is not None

    @property
    def is_playback(self) -> bool:
        """True for a stored recording, which plays from its first frame."""
        return self.measuring is not None and self.measuring.is_playback

    @property
    def duration_s(self) -> float:
        return self.counter.duration_s if self.counter else 0.0

    @property
    def repetitions(self) -> int:
        return self.counter.repetitions if self.counter else 0

    @property
    def time_s(self) -> float:
        """Time of the recording, 0 before the first frame."""
        now = self._history.end_s
        return now if math.isfinite(now) else 0.0

    # --- how it begins ------------------------------------------------------------------------------------
    def toggle(self) -> None:
        """Start, stop, or cancel the countdown; an early stop asks for confirmation."""
        if self.measuring is None or self.is_busy:
            return
        if self.measuring.feed.is_recording:
            if time.monotonic() - self._started_at_s < MIN_RECORDING_S:
                self.early_stop_requested.emit()
            else:
                self.stop()
        elif self.is_hand_resting():
            return
        elif self.start_trigger.is_counting:
            self.start_trigger.stop()
            self._update_countdown()
        elif self.start_mode == "countdown" and not self.is_playback and len(self._history):
            self.start_trigger.start_countdown(self.time_s)
            self._update_countdown()
        else:
            self._record()

    def _record(self) -> None:
        assert self.measuring is not None
        assert self.set_up is not None
        set_up = self.set_up
        self.start_trigger.stop()
        self.is_busy = True

        def on_started(_: object) -> None:
            self.is_busy = self.is_passive = False
            self._started_at_s = time.monotonic()
            self.counter = RepetitionCounter(set_up.exercise, set_up.protocol)
            self._history.set_home()
            self.started.emit()
            self.changed.emit()

        def on_failed(fault: Exception) -> None:
            self.is_busy = False
            self.changed.emit()
            self.start_failed.emit(fault)

        self._background.run(self.measuring.start_recording, on_started, on_failed, self)

    def set_resting(self, *, resting: bool) -> None:
        """Disable the automatic start between two exercises of a set."""
        if resting != self._is_resting:
            self._is_resting = resting
            self._arm_start_trigger()

    def set_camera_lost(self, *, lost: bool) -> None:
        self.camera_lost = lost
        self._arm_start_trigger()
        self.changed.emit()

    def _arm_start_trigger(self) -> None:
        """Wait for a still hand, if that is the start mode."""
        self.start_trigger.stop()
        if self.start_mode == "still" and not (self.is_playback or self._is_resting or self.camera_lost):
            self.start_trigger.start_waiting()

    def check_start_trigger(self) -> None:
        """Start the recording if the countdown or the still hand says so."""
        history = self._history
        if self.measuring is None or self.measuring.feed.is_recording or self.is_busy or not len(history):
            return
        if self.is_hand_resting():
            return
        angles = np.array([*history.angles_deg, *(value for value, _, _ in self._finger_flexions_deg())], dtype=float)
        if self.start_trigger.update(angles if history.status == TrackStatus.TRACKED else None, self.time_s):
            self._record()
        self._update_countdown()

    def _update_countdown(self) -> None:
        left_s = self.start_trigger.remaining_s(self.time_s)
        if left_s != self.countdown_s:
            self.countdown_s = left_s
            self.changed.emit()

    # --- while it runs, and its end -----------------------------------------------------------------------
    def toggle_pause(self) -> None:
        if (
            self.measuring is not None
            and self.measuring.feed.is_recording
            and not (self.camera_lost or self.is_storing)
        ):
            feed = self.measuring.feed
            (feed.resume_recording if feed.is_paused else feed.pause_recording)()
            self.changed.emit()

    def add_event(self, kind: str, text: str) -> bool:
        """Add an event at this moment; return False if nothing is recorded."""
        return self.measuring is not None and self.measuring.feed.add_event(kind, text)

    def set_passive(self, *, passive: bool) -> None:
        if self.add_event(PASSIVE if passive else ACTIVE, ""):
            self.is_passive = passive
            if self.counter is not None:
                self.counter.set_passive(self.time_s, passive=passive)
            self.changed.emit()

    def stop(self) -> None:
        """Stop and store the recording in the background."""
        if self.measuring is None or self.is_busy or not self.measuring.feed.is_recording:
            return
        self.is_busy = True
        self.changed.emit()
        self.stopping.emit()

        def on_failed(fault: Exception) -> None:
            self.is_busy = False
            self.changed.emit()
            self.stop_failed.emit(fault)

        def on_stopped(session_id: object) -> None:
            self.is_busy, self.counter = False, None
            self.changed.emit()
            self.stopped.emit(str(session_id))

        self._background.run(self.measuring.stop_recording, on_stopped, on_failed, self)

    # --- what the patient's view draws --------------------------------------------------------------------
    def exercise_snapshot(self, *, is_current: bool) -> ExerciseSnapshot:
        """Return the present state of the trained angle, whichever angle is shown.

        ``is_current`` is False if the last tracked frame is old.
        """
        history, set_up, state, now_s = self._history, self.set_up, self.state, time.monotonic()
        done, asked = self.repetitions, set_up.repetitions if set_up else 0
        if set_up is not None and set_up.set_run is not None and set_up.set_run.part.seconds:
            done, asked = int(TIMED_PARTS * self.duration_s / set_up.set_run.part.seconds), TIMED_PARTS
        if set_up is None or self.camera_lost or not is_current:
            return ExerciseSnapshot(now_s, state=state, done=done, asked=asked, is_late=True)
        deviation, flexion, turned = (float(value) for value in history.angles_deg)
        seen = history.status == TrackStatus.TRACKED
        angle = set_up.exercise.angle
        value, sd, measured = math.nan, math.nan, seen
        if set_up.protocol.has_fingers and set_up.exercise.joint:
            value, sd, measured = history.angle_value(FINGER_ANGLES.index(find_finger_angle(set_up.exercise.joint)))
        elif angle is not None:
            value, sd = float(history.angles_deg[angle]), float(history.sds_deg[angle])
            if angle == PRONOSUPINATION:  # the patient's hand is drawn from where it lies, palm down
                value = math.degrees(float(pronosupination_from_palm_down(np.radians(value))))
        bent_deg = [bent for bent, _, known in self._finger_flexions_deg() if known]
        return ExerciseSnapshot(
            now_s, value,
            is_measured=measured and seen and math.isfinite(value) and sd <= math.degrees(MAX_ANGLE_SD_RAD),
            is_hand_visible=seen,
            wrist_deg=(deviation, flexion, turned),
            mean_flexion_deg=sum(bent_deg) / len(bent_deg) if bent_deg else math.nan,
            state=state, done=done, asked=asked, found_count=self.counter.found_count if self.counter else 0,
            countdown_s=self.countdown_s,
        )  # fmt: skip

    def _finger_flexions_deg(self) -> list[tuple[float, float, bool]]:
        """Return value, sd and whether it is measured of each long finger's PIP joint; none for the wrist alone."""
        if self.set_up is None or not self.set_up.protocol.has_fingers:
            return []
        columns = (FINGER_ANGLES.index(FingerAngle(finger, "middle")) for finger in FINGERS[1:])
        return [self._history.angle_value(column) for column in columns]


COUNTDOWN_S = 3.0
STILL_S, STILL_DEG = 1.5, 4.0
"""A hand is still if its angles stay within this range for this long.

It is less than the smallest movement and more than the noise of the tracker.
"""
MAX_MOVEMENT_DEG = 2.0 * STILL_DEG
"""A larger movement cancels the countdown."""


class StartTrigger:
    """Waits for a still hand or counts down, by the time of the frames."""

    def __init__(self) -> None:
        self.is_waiting = False
        self._start_time_s = math.nan
        self._is_watching = False
        self._recent_angles: deque[tuple[float, FloatArray]] = deque()

    def stop(self) -> None:
        self.is_waiting, self._start_time_s = False, math.nan
        self._recent_angles.clear()

    def start_waiting(self) -> None:
        self.stop()
        self.is_waiting = True

    def start_countdown(self, now_s: float) -> None:
        self.stop()
        self._start_time_s, self._is_watching = now_s + COUNTDOWN_S, False

    @property
    def is_counting(self) -> bool:
        return math.isfinite(self._start_time_s)

    def remaining_s(self, now_s: float) -> int:
        """Return the whole seconds left in the countdown, 0 without one."""
        return max(1, math.ceil(self._start_time_s - now_s)) if self.is_counting else 0

    def update(self, angles_deg: FloatArray | None, now_s: float) -> bool:
        """Take the angles of a frame (None if not tracked); return True if the recording starts now."""
        if self.is_counting and not self._is_watching:
            begins = now_s >= self._start_time_s
        elif self.is_waiting or self.is_counting:
            moved_deg = self._recent_change_deg(angles_deg, now_s)
            if self.is_counting and not moved_deg <= MAX_MOVEMENT_DEG:
                self.start_waiting()
            elif self.is_waiting and moved_deg <= STILL_DEG and now_s - self._recent_angles[0][0] >= 0.9 * STILL_S:
                self.is_waiting, self._start_time_s, self._is_watching = False, now_s + COUNTDOWN_S, True
            begins = self.is_counting and now_s >= self._start_time_s
        else:
            return False
        if begins:
            self.stop()
        return begins

    def _recent_change_deg(self, angles_deg: FloatArray | None, now_s: float) -> float:
        """Return the range of the recent angles; infinite if the hand was not visible."""
        if angles_deg is None or not np.isfinite(angles_deg).any():
            self._recent_angles.clear()
            return math.inf
        self._recent_angles.append((now_s, angles_deg))
        while now_s - self._recent_angles[0][0] > STILL_S:
            self._recent_angles.popleft()
        seen = np.array([angles for _, angles in self._recent_angles])
        return float(np.nanmax(seen.max(axis=0) - seen.min(axis=0)))


_ZERO_START_ANGLES = np.zeros(3)


class RepetitionCounter:
    """Collects recorded frames; counts once a second."""

    def __init__(self, exercise: Exercise, protocol: MarkerProtocol | None = None) -> None:
        self._protocol, self._exercise = protocol or exercise.protocol, exercise
        self.angle = FLEXION if exercise.angle is None else exercise.angle
        self.joint = exercise.joint
        self._figure = FINGER_ANGLES.index(find_finger_angle(exercise.joint)) if exercise.joint else -1
        self._counts = exercise.has_repetitions
        self._times, self._values, self._valid = array("d"), array("d"), array("b")
        self.repetitions = 0
        self.found_count = 0
        """Present count; a repetition may turn out to be none with later frames."""
        self.last_end_s = math.nan
        """End of the last repetition, on the clock of the frames."""
        self.duration_s = 0.0
        self.best_positive_deg = math.nan
        self.best_negative_deg = math.nan
        self._passive_spans_s: list[tuple[float, float]] = []
        self._max_hidden_rad = -math.inf
        self._last_visible_s, self._visible_again_s = math.inf, -math.inf

    @property
    def is_best_lower_bound(self) -> bool:
        """True if the trained joint may have moved further than the best value while hidden."""
        best_rad = math.radians(self.best_positive_deg) if math.isfinite(self.best_positive_deg) else 0.0
        return self._max_hidden_rad > best_rad + MIN_FURTHER_RAD

    def set_passive(self, time_s: float, *, passive: bool) -> None:
        """Exclude movements from a time on, while somebody else moves the hand."""
        if self._is_passive(time_s):
            self._passive_spans_s[-1] = (self._passive_spans_s[-1][0], time_s)
        if passive:
            self._passive_spans_s.append((time_s, math.inf))

    def _is_passive(self, time_s: float) -> bool:
        return any(start <= time_s < end for start, end in self._passive_spans_s)

    def append(self, frames: Sequence[TrackedFrame]) -> None:
        for frame, (value, sd, valid) in zip(frames, self._read_angles(frames), strict=True):
            if self._times and frame.timestamp_s <= self._times[-1]:
                continue
            if self._times:
                # A pause leaves a long step between two frames; it is not recorded time.
                self.duration_s += min(frame.timestamp_s - self._times[-1], 0.2)
            valid = valid and math.isfinite(value) and sd <= MAX_ANGLE_SD_RAD
            self._times.append(frame.timestamp_s)
            self._values.append(value)
            self._valid.append(valid)
            if self._is_passive(frame.timestamp_s):
                self._is_settling(frame.timestamp_s)
            elif valid and not self._is_settling(frame.timestamp_s):
                self._update_best(math.degrees(value))
            elif not valid and self._figure >= 0 and math.isfinite(value + sd):
                self._max_hidden_rad = max(self._max_hidden_rad, value + sd)

    def _is_settling(self, time_s: float) -> bool:
        """Tell whether the hand was hidden just before: such frames give no best value."""
        if time_s - self._last_visible_s > MAX_FILLED_GAP_S:
            self._visible_again_s = time_s
        self._last_visible_s = time_s
        return time_s - self._visible_again_s <= SETTLING_S

    def update_count(self) -> int:
        """Count full repetitions.

        For joints the tracked angle is used also while hidden, as in the review: a fist hides its own end.
        """
        if self._counts and len(self._times) > 2:
            valid = None if self._figure >= 0 else np.array(self._valid, dtype=bool)
            signal = resample_evenly(np.array(self._times), np.array(self._values), valid)
            every = find_repetitions(signal).repetitions if len(signal.time_s) else ()
            found = [one for one in every if not self._is_passive(0.5 * (one.start_s + one.end_s))]
            self.found_count = len(found)
            self.last_end_s = found[-1].end_s if found else math.nan
            self.repetitions = max(self.repetitions, self.found_count)  # what was done stays done
        return self.repetitions

    def _read_angles(self, frames: Sequence[TrackedFrame]) -> list[tuple[float, float, bool]]:
        """Return the trained angle, its sd (both in radians) and whether it was measured, per frame."""
        if self._figure >= 0 and frames and len(frames[0].kinematics.joint_angles_rad):
            _, value_deg, sd_deg, measured, _ = estimate_finger_angles(self._protocol, frames)
            column = self._figure
            value, sd = np.radians(value_deg[:, column]).tolist(), np.radians(sd_deg[:, column]).tolist()
            return list(zip(value, sd, measured[:, column].tolist(), strict=True))
        return [
            (
                float(
                    to_clinical_wrist_angles(frame.kinematics.angles_rad, self._exercise, _ZERO_START_ANGLES)[
                        self.angle
                    ]
                ),
                float(frame.kinematics.angles_sd_rad[self.angle]),
                frame.status == TrackStatus.TRACKED,
            )
            for frame in frames
        ]

    def _update_best(self, value_deg: float) -> None:
        turns = self.angle == PRONOSUPINATION and self._figure < 0  # it begins at 90 degrees of one direction
        if value_deg >= 0.0 or turns:
            self.best_positive_deg = float(np.fmax(self.best_positive_deg, value_deg))
        if value_deg < 0.0 or turns:
            self.best_negative_deg = float(np.fmin(self.best_negative_deg, value_deg))
