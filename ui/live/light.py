"""The tracking light: what the camera sees or the computer lacks, in one colour, one shape, one word, one remedy."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from carpus.core.hand.protocols import PALM_MARKERS
from carpus.core.pipeline.live_values import LiveCounters, TrackedView
from carpus.core.rounding import written
from carpus.core.types import Frame, TrackedFrame, TrackStatus
from carpus.ui.marker_words import finger_name, hidden_remedy, marker_name
from carpus.ui.plot.history import Seen
from carpus.ui.translate import inside, tr

Rank = Literal["good", "warn", "bad", "idle"]
AMBER_AFTER_S = 0.3
GREEN_AFTER_S = 0.5


@dataclass(frozen=True, slots=True)
class Lamp:
    """What the light shows."""

    rank: Rank
    state: str
    remedy: str


TRACKABLE = 3
"""Discs that tell where the hand is."""


def lamp_for(frame: TrackedFrame | None, markers: Sequence[str], forearm_moved: bool) -> Lamp:
    """The light for one frame as it stands, without any delay."""
    if frame is None:
        return Lamp("idle", tr("Waiting for the first picture"), "")
    if frame.status == TrackStatus.LOST:
        return Lamp("bad", tr("Hand not visible"), tr("Hold the hand flat under the camera"))
    hidden = [
        name for name, pixel in zip(markers, frame.marker_measured_px, strict=True) if not math.isfinite(pixel[0])
    ]
    if len(markers) - len(hidden) < TRACKABLE or frame.status == TrackStatus.PREDICTED:
        return Lamp("warn", tr("Too few markers seen"), tr("Turn the back of the hand to the camera"))
    if len(hidden) == 1:
        return Lamp("warn", tr("{marker} hidden").format(marker=marker_name(hidden[0])), hidden_remedy(hidden[0]))
    if hidden:
        words = tr("{count} markers hidden").format(count=len(hidden))
        return Lamp("warn", words, tr("Turn the back of the hand to the camera"))
    if frame.status == TrackStatus.DOUBTFUL:
        return Lamp("warn", tr("Doubtful"), tr("What is seen does not fit: hold the hand flat for a moment"))
    if forearm_moved:
        return Lamp("warn", tr("Arm moved"), tr("Lay the forearm back where it was"))
    if not np.isfinite(frame.moment.angles_rad).any():
        return Lamp("idle", tr("No angle known yet"), tr("Hold the hand flat for a moment"))
    return Lamp("good", tr("Tracking well"), tr("All {count} markers seen").format(count=len(markers)))


class SteadyLight:
    """Keeps the light from flickering: amber only after 0.3 s, green only after 0.5 s, red at once.

    Words of the same rank change at once only when what they say has lasted as long.
    """

    def __init__(self) -> None:
        self._shown: Lamp | None = None
        self._wanted: Lamp | None = None
        self._since_s = math.nan

    def show(self, lamp: Lamp, now_s: float) -> Lamp:
        """What to show at ``now_s`` when the frame says ``lamp``."""
        if self._shown is None or lamp.rank in ("bad", "idle") or self._shown.rank == "idle":
            self._shown = self._wanted = lamp
            return lamp
        if lamp == self._shown:
            self._wanted = lamp
            return lamp
        if self._wanted is None or lamp.rank != self._wanted.rank or self._wanted == self._shown:
            self._since_s = now_s
        self._wanted = lamp
        delay_s = GREEN_AFTER_S if lamp.rank == "good" else AMBER_AFTER_S
        if now_s - self._since_s >= delay_s - 1e-9:
            self._shown = lamp
        return self._shown


LEAST_PALM = 3
_ENDS = ("PIP", "DIP", "TIP", "IP")


def hand_lamp(frame: TrackedFrame | None, seen: Mapping[str, Seen]) -> Lamp:
    """The tracking light of the whole hand, from the same state as its map; that state does not flicker."""
    if frame is None:
        return Lamp("idle", tr("Waiting for the first picture"), "")
    if frame.status == TrackStatus.LOST:
        return Lamp("bad", tr("Hand not visible"), tr("Hold the hand flat under the camera"))
    hidden = [name for name, state in seen.items() if state == "hidden"]
    partly = [name for name, state in seen.items() if state == "partly"]
    palm = sum(name in PALM_MARKERS for name in hidden)
    if len(PALM_MARKERS) - palm < LEAST_PALM or frame.status == TrackStatus.PREDICTED:
        return Lamp("warn", tr("Too few markers seen"), tr("Turn the back of the hand to the camera"))
    if frame.status == TrackStatus.DOUBTFUL:
        return Lamp("warn", tr("Doubtful"), tr("What is seen does not fit: hold the hand flat for a moment"))
    if not hidden and partly:
        return Lamp("warn", _partly_words(partly), remedy(partly))
    if not hidden and not np.isfinite(frame.moment.joint_angles_rad).any():
        return Lamp("idle", tr("No angle known yet"), tr("Hold the hand flat for a moment"))
    if not hidden:
        return Lamp("good", tr("Tracking well"), tr("All {count} markers seen").format(count=len(seen)))
    return Lamp("warn", hidden_words(hidden), remedy(hidden))


def hidden_words(hidden: Sequence[str]) -> str:
    """``Ring tip hidden``, ``Thumb hidden``, ``Finger ends hidden``, ``7 markers hidden``."""
    if len(hidden) == 1:
        return tr("{marker} hidden").format(marker=marker_name(hidden[0]))
    fingers = {name[-1] for name in hidden if name not in PALM_MARKERS}
    if len(fingers) == 1 and all(name not in PALM_MARKERS for name in hidden):
        (finger,) = fingers
        if finger == "1":
            return tr("Thumb hidden")
        return tr("{finger} finger hidden").format(finger=finger_name(finger))
    if all(name.rstrip("12345") in _ENDS for name in hidden):
        return tr("Finger ends hidden")
    return tr("{count} markers hidden").format(count=len(hidden))


def remedy(hidden: Sequence[str]) -> str:
    """What to do; the palm first, since without it nothing is tracked."""
    palm = [name for name in hidden if name in PALM_MARKERS]
    if len(palm) == 1:
        return hidden_remedy(palm[0])
    if palm:
        return tr("Turn the back of the hand to the camera")
    if all(name[-1] == "1" for name in hidden):
        return tr("Turn the thumb side up")
    if len(hidden) == 1 and hidden[0].startswith("TIP"):
        return tr("Raise the hand")
    return tr("Turn the back of the fingers to the camera")


def map_words(seen: Mapping[str, Seen], *, infers_ends: bool = False) -> str:
    """The sentence beside the hand map: what is hidden, and what to do, or that end joints are only inferred."""
    hidden = [name for name, state in seen.items() if state == "hidden"]
    partly = [name for name, state in seen.items() if state == "partly"]
    if not hidden and not partly:
        if infers_ends:
            return tr("All markers seen. End joints are not measured: they follow the middle joints.")
        return tr("All markers seen, every joint is measured.")
    poor = hidden or partly
    words = hidden_words(poor) if hidden else _partly_words(poor)
    sentence = tr("{what}: {remedy}.").format(what=words, remedy=inside(remedy(poor)))
    return f"{sentence} {tr('Hidden joints do not count.')}" if hidden else sentence


def _partly_words(poor: Sequence[str]) -> str:
    if len(poor) == 1:
        return tr("{marker} seen now and then").format(marker=marker_name(poor[0]))
    return tr("{count} markers seen now and then").format(count=len(poor))


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
        """Pictures of this recording that never came, or for which there was no room any more."""
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
        lost = counters.dropped + counters.missing
        if self._left_out_before is None:
            self._left_out_before = lost
        self.left_out = lost - self._left_out_before

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
    words = tr("The figures are {seconds} s late").format(seconds=written(behind.late_s))
    return Lamp("idle", words, kept if recording else tr("The computer is busy"))


def words_left(counters: LiveCounters) -> str:
    """How long catching up takes, on the button that stopped."""
    if not math.isfinite(counters.catching_up_s):
        return tr("Catching up…")
    return tr("Catching up: {seconds} s left").format(seconds=max(1, math.ceil(counters.catching_up_s)))
