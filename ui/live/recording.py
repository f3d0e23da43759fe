"""The recording on the live screen: begun by a key, counted down or over a still hand; paused, noted in, stopped."""

from __future__ import annotations

import math
import time
from collections import deque
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QObject, Signal

from carpus.core.pipeline.live_values import StartMode
from carpus.core.records.set_up import SetUp
from carpus.core.results.repetition_rows import ACTIVE, PASSIVE
from carpus.core.types import FloatArray, SpotAnswer, TrackStatus
from carpus.ui.background import Background
from carpus.ui.figures import FIGURES, FINGERS, Figure
from carpus.ui.live.counting import RunningCount
from carpus.ui.patient.guide import RecordingState
from carpus.ui.plot.history import History

if TYPE_CHECKING:
    from carpus.core.pipeline.measuring import SourceMeasuring

HASTY_S = 3.0
"""So soon after a recording began nobody is taken to mean its end without being asked."""


class Recording(QObject):
    """One after the other on a source. ``changed`` when its state, or what is counted down to it, is another;
    ``begun`` or ``not_begun`` with a fault; ``stopping``, then ``stopped`` with
    the session, or ``stop_failed`` with a fault."""

    changed = Signal()
    begun = Signal()
    not_begun = Signal(object)
    stopped = Signal(str)
    stop_failed = Signal(object)
    stopping = Signal()
    hasty = Signal()
    """A person ends a recording that has only just begun: is it meant?"""

    def __init__(self, background: Background, history: History) -> None:
        super().__init__()
        self._background, self._history = background, history
        self.measuring: SourceMeasuring | None = None
        self.set_up: SetUp | None = None
        self.count: RunningCount | None = None
        self.start_mode: StartMode = "key"
        self.beginning = Beginning()
        self.left_s = 0
        """Seconds that are still counted down."""
        self.camera_lost = self.passive = self._rests = False
        self.under_way = False
        """Whether it is being started or stopped, which waits for the disk."""
        self._begun_at_s = -HASTY_S

    def open(self, measuring: SourceMeasuring, set_up: SetUp) -> None:
        self.measuring, self.set_up, self.count = measuring, set_up, None
        self.camera_lost = self.under_way = self._rests = False
        self._arm()

    @property
    def state(self) -> RecordingState:
        feed = self.measuring.feed if self.measuring else None
        if feed is None or not feed.recording or (self.under_way and self.count is None):
            return "off"  # also while it is being started: nothing can be noted in it yet
        return "paused" if feed.paused or self.camera_lost else "recording"

    @property
    def storing(self) -> bool:
        """Whether it is being stored: nobody needs to stop it once more."""
        return self.under_way and self.count is not None

    @property
    def plays(self) -> bool:
        """Whether the source is a stored recording, which plays from its first picture."""
        return self.measuring is not None and self.measuring.starts_with_recording

    @property
    def recorded_s(self) -> float:
        return self.count.recorded_s if self.count else 0.0

    @property
    def repetitions(self) -> int:
        return self.count.repetitions if self.count else 0

    @property
    def now_s(self) -> float:
        """Its own time, 0 before the first picture."""
        now = self._history.now_s
        return now if math.isfinite(now) else 0.0

    # --- how it begins ------------------------------------------------------------------------------------
    def toggle(self) -> None:
        """Start, or stop and go to the review: the same on every source. A hasty end asks; what is counted down is
        taken back."""
        if self.measuring is None or self.under_way:
            return
        if self.measuring.feed.recording:
            if time.monotonic() - self._begun_at_s < HASTY_S:
                self.hasty.emit()
            else:
                self.stop()
        elif self.beginning.counts:
            self.beginning.stop()
            self._show_left()
        elif self.start_mode == "countdown" and not self.plays and len(self._history):
            self.beginning.count(self.now_s)
            self._show_left()
        else:
            self._record()

    def _record(self) -> None:
        assert self.measuring is not None
        assert self.set_up is not None
        set_up = self.set_up
        self.beginning.stop()
        self.under_way = True

        def begun(_: object) -> None:
            self.under_way = self.passive = False
            self._begun_at_s = time.monotonic()
            self.count = RunningCount(set_up.exercise, set_up.protocol)
            self._history.set_home()
            self.begun.emit()
            self.changed.emit()

        def failed(fault: Exception) -> None:
            self.under_way = False
            self.changed.emit()
            self.not_begun.emit(fault)

        self._background.run(self.measuring.start_recording, begun, failed, self)

    def rest(self, *, on: bool) -> None:
        """Between two exercises of a set nothing begins by itself."""
        if on != self._rests:
            self._rests = on
            self._arm()

    def set_camera_lost(self, *, lost: bool) -> None:
        self.camera_lost = lost
        self._arm()
        self.changed.emit()

    def _arm(self) -> None:
        """A hand that lies still begins from now on, where that is wanted."""
        self.beginning.stop()
        if self.start_mode == "still" and not (self.plays or self._rests or self.camera_lost):
            self.beginning.wait()

    def look_for_start(self) -> None:
        """One look at the hand while a recording may begin without a hand at the keyboard."""
        history, set_up = self._history, self.set_up
        if self.measuring is None or self.measuring.feed.recording or self.under_way or not len(history):
            return
        fingers = FINGERS[1:] if set_up is not None and set_up.protocol.has_fingers else ()
        bent = [history.figure_value(FIGURES.index(Figure(finger, "middle")))[0] for finger in fingers]
        angles = np.array([*history.angles_deg, *bent], dtype=float)
        if self.beginning.take(angles if history.status == TrackStatus.TRACKED else None, self.now_s):
            self._record()
        self._show_left()

    def _show_left(self) -> None:
        """The seconds on the button, as soon as they change."""
        left_s = self.beginning.left_s(self.now_s)
        if left_s != self.left_s:
            self.left_s = left_s
            self.changed.emit()

    # --- while it runs, and its end -----------------------------------------------------------------------
    def toggle_pause(self) -> None:
        if self.measuring is not None and self.measuring.feed.recording and not (self.camera_lost or self.storing):
            feed = self.measuring.feed
            (feed.resume_recording if feed.paused else feed.pause_recording)()
            self.changed.emit()

    def note(self, kind: str, text: str) -> bool:
        """Write something down at this moment; whether it could be."""
        return self.measuring is not None and self.measuring.feed.add_event(kind, text)

    def answer_spot(self, answer: SpotAnswer) -> None:
        if self.measuring is not None:
            self.measuring.answer_spot(answer)

    def say_way(self, *, passive: bool) -> None:
        if self.note(PASSIVE if passive else ACTIVE, ""):
            self.passive = passive
            if self.count is not None:
                self.count.say_way(self.now_s, passive=passive)
            self.changed.emit()

    def stop(self) -> None:
        """Close the file in the background; the answer leads to the review."""
        if self.measuring is None or self.under_way or not self.measuring.feed.recording:
            return
        self.under_way = True
        self.changed.emit()
        self.stopping.emit()

        def failed(fault: Exception) -> None:
            self.under_way = False
            self.changed.emit()
            self.stop_failed.emit(fault)

        def done(session_id: object) -> None:
            self.under_way, self.count = False, None
            self.changed.emit()
            self.stopped.emit(str(session_id))

        self._background.run(self.measuring.stop_recording, done, failed, self)


COUNT_S = 3.0
STILL_S, STILL_DEG = 1.5, 4.0
"""A hand lies still whose angles have stayed within this for so long: less than the smallest movement, more than the
tracker's noise."""
TWITCH_DEG = 2.0 * STILL_DEG
"""A hand that goes so far while it is counted down does not lie still any more."""


class Beginning:
    """``waits`` for a hand that lies still, or counts down; all by the time of the pictures, in seconds."""

    def __init__(self) -> None:
        self.waits = False
        self._begins_s = math.nan
        self._watches = False
        self._lately: deque[tuple[float, FloatArray]] = deque()

    def stop(self) -> None:
        self.waits, self._begins_s = False, math.nan
        self._lately.clear()

    def wait(self) -> None:
        self.stop()
        self.waits = True

    def count(self, now_s: float) -> None:
        self.stop()
        self._begins_s, self._watches = now_s + COUNT_S, False

    @property
    def counts(self) -> bool:
        return math.isfinite(self._begins_s)

    def left_s(self, now_s: float) -> int:
        """Whole seconds that are still counted, 0 where nothing is."""
        return max(1, math.ceil(self._begins_s - now_s)) if self.counts else 0

    def take(self, angles_deg: FloatArray | None, now_s: float) -> bool:
        """One look at the hand, its angles or None where it is not surely seen; whether the recording begins now.

        Angles that are not known (NaN) are not looked at.
        """
        if self.counts and not self._watches:
            begins = now_s >= self._begins_s
        elif self.waits or self.counts:
            moved_deg = self._moved_deg(angles_deg, now_s)
            if self.counts and not moved_deg <= TWITCH_DEG:
                self.wait()
            elif self.waits and moved_deg <= STILL_DEG and now_s - self._lately[0][0] >= 0.9 * STILL_S:
                self.waits, self._begins_s, self._watches = False, now_s + COUNT_S, True
            begins = self.counts and now_s >= self._begins_s
        else:
            return False
        if begins:
            self.stop()
        return begins

    def _moved_deg(self, angles_deg: FloatArray | None, now_s: float) -> float:
        """By how much the angles differed lately; infinite where the hand was not seen."""
        if angles_deg is None or not np.isfinite(angles_deg).any():
            self._lately.clear()
            return math.inf
        self._lately.append((now_s, angles_deg))
        while now_s - self._lately[0][0] > STILL_S:
            self._lately.popleft()
        seen = np.array([angles for _, angles in self._lately])
        return float(np.nanmax(seen.max(axis=0) - seen.min(axis=0)))
