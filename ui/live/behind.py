"""A computer that is too busy: how late the figures are, that nothing is lost, and how long catching up takes."""

from __future__ import annotations

import math

from carpus.core.pipeline.live_values import LiveCounters, TrackedView
from carpus.core.types import Frame
from carpus.ui.live.light import Lamp
from carpus.ui.translate import tr

BEHIND_S, CAUGHT_UP_S = 1.0, 0.4
"""From so late on the newest picture is shown by itself and the light says so, until it is less than the second."""
FEW_WAITING = 15
"""Half a second of pictures at a stop: not worth a word."""


class Behind:
    """How far what was tracked is behind what the camera sees; of one recording after the other."""

    def __init__(self) -> None:
        self.late_s = 0.0
        """0 while the figures are of now."""
        self.left_out = 0
        """Pictures of this recording for which there was no room any more."""
        self._left_out_before: int | None = None
        self._most_waiting = 0

    def begin(self) -> None:
        self.left_out, self._left_out_before, self._most_waiting = 0, None, 0

    def look(self, newest: Frame | None, view: TrackedView | None) -> bool:
        """Whether the figures are late, by the newest picture and the newest that was tracked."""
        late_s = 0.0 if newest is None or view is None else newest.timestamp_s - view.tracked.timestamp_s
        self.late_s = late_s if late_s > (CAUGHT_UP_S if self.late_s else BEHIND_S) else 0.0
        return self.late_s > 0.0

    def count(self, counters: LiveCounters) -> None:
        """What the session says of the recording that runs."""
        if self._left_out_before is None:
            self._left_out_before = counters.dropped
        self.left_out = counters.dropped - self._left_out_before

    def catching_up(self, counters: LiveCounters) -> tuple[int, int] | None:
        """After a stop: pictures done and in all; None when there is next to nothing left to do."""
        waiting = counters.waiting_tracking
        self._most_waiting = max(self._most_waiting, waiting)
        if self._most_waiting < FEW_WAITING or not waiting:
            return None
        return self._most_waiting - waiting, self._most_waiting


def behind_lamp(behind: Behind, *, recording: bool) -> Lamp:
    """What the tracking light says instead of what the camera saw a while ago."""
    if behind.left_out and recording:
        words = tr("{count} pictures are missing: close other programs")
        return Lamp("warn", tr("The computer is too busy"), words.format(count=behind.left_out))
    kept = tr("The computer is busy; every picture is kept")
    words = tr("The figures are {seconds} s late").format(seconds=f"{behind.late_s:.0f}")
    return Lamp("idle", words, kept if recording else tr("The computer is busy"))


def words_left(counters: LiveCounters) -> str:
    """How long catching up takes, on the button that stopped."""
    if not math.isfinite(counters.catching_up_s):
        return tr("Catching up…")
    return tr("Catching up: {seconds} s left").format(seconds=max(1, math.ceil(counters.catching_up_s)))
