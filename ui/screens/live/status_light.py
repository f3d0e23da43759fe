"""The tracking light: one colour, shape, word and remedy for the state of tracking."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from carpus.core.model.hand.protocols import PALM_MARKERS
from carpus.core.model.rounding import format_rounded
from carpus.core.model.types import Frame, TrackedFrame, TrackStatus
from carpus.core.pipeline.live_values import LiveCounters, TrackedView
from carpus.ui.charts.history import MarkerVisibility
from carpus.ui.kit.translate import tr
from carpus.ui.words.marker_words import finger_name, marker_title, occlusion_remedy

Rank = Literal["good", "warn", "bad", "idle"]
AMBER_AFTER_S = 0.3
GREEN_AFTER_S = 0.5


@dataclass(frozen=True, slots=True)
class StatusLight:
    """Rank, state and remedy of the tracking light."""

    rank: Rank
    state: str
    remedy: str


MIN_TRACKABLE = 3
"""Markers needed to locate the hand."""


def wrist_light(frame: TrackedFrame | None, markers: Sequence[str], forearm_moved: bool) -> StatusLight:
    """Return the light for one frame with six markers, without any delay."""
    if frame is None:
        return StatusLight("idle", tr("Waiting for the camera image"), "")
    if frame.status == TrackStatus.LOST:
        return StatusLight("bad", tr("Hand not visible"), tr("Hold the hand flat under the camera"))
    hidden = [
        name for name, pixel in zip(markers, frame.marker_measured_px, strict=True) if not math.isfinite(pixel[0])
    ]
    if len(markers) - len(hidden) < MIN_TRACKABLE or frame.status == TrackStatus.PREDICTED:
        return StatusLight("warn", tr("Too few markers visible"), tr("Turn the back of the hand to the camera"))
    if len(hidden) == 1:
        return StatusLight(
            "warn", tr("{marker} occluded").format(marker=marker_title(hidden[0])), occlusion_remedy(hidden[0])
        )
    if hidden:
        words = tr("{count} markers occluded").format(count=len(hidden))
        return StatusLight("warn", words, tr("Turn the back of the hand to the camera"))
    if frame.status == TrackStatus.DOUBTFUL:
        return StatusLight(
            "warn", tr("Uncertain"), tr("Markers do not match the hand: hold the hand flat for a moment")
        )
    if forearm_moved:
        return StatusLight("warn", tr("Forearm moved"), tr("Lay the forearm back where it was"))
    if not np.isfinite(frame.kinematics.angles_rad).any():
        return StatusLight("idle", tr("No angle yet"), tr("Hold the hand flat for a moment"))
    return StatusLight("good", tr("Hand tracked well"), tr("All {count} markers visible").format(count=len(markers)))


class SteadyLight:
    """Delays changes of the light: amber after 0.3 s, green after 0.5 s, red at once.

    Words of the same rank change only when they have lasted as long.
    """

    def __init__(self) -> None:
        self._shown: StatusLight | None = None
        self._wanted: StatusLight | None = None
        self._since_s = math.nan

    def update(self, status_light: StatusLight, now_s: float) -> StatusLight:
        """Return the light to show at ``now_s``, given that of the frame."""
        if self._shown is None or status_light.rank in ("bad", "idle") or self._shown.rank == "idle":
            self._shown = self._wanted = status_light
            return status_light
        if status_light == self._shown:
            self._wanted = status_light
            return status_light
        if self._wanted is None or status_light.rank != self._wanted.rank or self._wanted == self._shown:
            self._since_s = now_s
        self._wanted = status_light
        delay_s = GREEN_AFTER_S if status_light.rank == "good" else AMBER_AFTER_S
        if now_s - self._since_s >= delay_s - 1e-9:
            self._shown = status_light
        return self._shown


MIN_PALM_MARKERS = 3
_DISTAL_JOINTS = ("PIP", "DIP", "TIP", "IP")


def hand_light(frame: TrackedFrame | None, visibility: Mapping[str, MarkerVisibility]) -> StatusLight:
    """Return the light of the whole hand, from the same visibility as its map."""
    if frame is None:
        return StatusLight("idle", tr("Waiting for the camera image"), "")
    if frame.status == TrackStatus.LOST:
        return StatusLight("bad", tr("Hand not visible"), tr("Hold the hand flat under the camera"))
    hidden = [name for name, state in visibility.items() if state == "hidden"]
    partly = [name for name, state in visibility.items() if state == "partly"]
    palm = sum(name in PALM_MARKERS for name in hidden)
    if len(PALM_MARKERS) - palm < MIN_PALM_MARKERS or frame.status == TrackStatus.PREDICTED:
        return StatusLight("warn", tr("Too few markers visible"), tr("Turn the back of the hand to the camera"))
    if frame.status == TrackStatus.DOUBTFUL:
        return StatusLight(
            "warn", tr("Uncertain"), tr("Markers do not match the hand: hold the hand flat for a moment")
        )
    if not hidden and partly:
        return StatusLight("warn", _partly_words(partly), remedy_words(partly))
    if not hidden and not np.isfinite(frame.kinematics.joint_angles_rad).any():
        return StatusLight("idle", tr("No angle yet"), tr("Hold the hand flat for a moment"))
    if not hidden:
        count = len(visibility)
        return StatusLight("good", tr("Hand tracked well"), tr("All {count} markers visible").format(count=count))
    return StatusLight("warn", occlusion_words(hidden), remedy_words(hidden))


def occlusion_words(hidden: Sequence[str]) -> str:
    """Describe hidden markers: ``Ring tip hidden``, ``Thumb hidden``, ``7 markers hidden``."""
    if len(hidden) == 1:
        return tr("{marker} occluded").format(marker=marker_title(hidden[0]))
    fingers = {name[-1] for name in hidden if name not in PALM_MARKERS}
    if len(fingers) == 1 and all(name not in PALM_MARKERS for name in hidden):
        (finger,) = fingers
        if finger == "1":
            return tr("Thumb occluded")
        return tr("{finger} finger occluded").format(finger=finger_name(finger))
    if all(name.rstrip("12345") in _DISTAL_JOINTS for name in hidden):
        return tr("Fingertips occluded")
    return tr("{count} markers occluded").format(count=len(hidden))


def remedy_words(hidden: Sequence[str]) -> str:
    """Return what to do about hidden markers; the palm first, since tracking needs it."""
    palm = [name for name in hidden if name in PALM_MARKERS]
    if len(palm) == 1:
        return occlusion_remedy(palm[0])
    if palm:
        return tr("Turn the back of the hand to the camera")
    if all(name[-1] == "1" for name in hidden):
        return tr("Turn the thumb side up")
    if len(hidden) == 1 and hidden[0].startswith("TIP"):
        return tr("Raise the hand")
    return tr("Turn the back of the fingers to the camera")


def _partly_words(poor: Sequence[str]) -> str:
    if len(poor) == 1:
        return tr("{marker} often occluded").format(marker=marker_title(poor[0]))
    return tr("{count} markers often occluded").format(count=len(poor))


LAG_S, CAUGHT_UP_S = 1.0, 0.4
"""The light reports a lag above the first value until it is below the second."""
MIN_WAITING_FRAMES = 15
"""Half a second of frames after a stop is not worth a message."""


class TrackingLag:
    """Lag of tracking behind the camera, and missing frames of a recording."""

    def __init__(self) -> None:
        self.lag_s = 0.0
        """0 while the values are current."""
        self.missing_frames = 0
        """Frames of this recording that were dropped or never came."""
        self._missing_before: int | None = None
        self._max_waiting = 0

    def reset(self) -> None:
        self.missing_frames, self._missing_before, self._max_waiting = 0, None, 0

    def update(self, newest: Frame | None, view: TrackedView | None) -> bool:
        """Update the lag with the newest and the newest tracked frame; return True if it is too large."""
        late_s = 0.0 if newest is None or view is None else newest.timestamp_s - view.tracked.timestamp_s
        self.lag_s = late_s if late_s > (CAUGHT_UP_S if self.lag_s else LAG_S) else 0.0
        return self.lag_s > 0.0

    def count_missing(self, counters: LiveCounters) -> None:
        lost = counters.dropped + counters.missing
        if self._missing_before is None:
            self._missing_before = lost
        self.missing_frames = lost - self._missing_before

    def catch_up_progress(self, counters: LiveCounters) -> tuple[int, int] | None:
        """Return frames done and in all after a stop; None if hardly any are left."""
        waiting = counters.frames_waiting
        self._max_waiting = max(self._max_waiting, waiting)
        if self._max_waiting < MIN_WAITING_FRAMES or not waiting:
            return None
        return self._max_waiting - waiting, self._max_waiting


def lag_light(lag: TrackingLag, *, recording: bool) -> StatusLight:
    """Return the light while tracking lags behind."""
    if lag.missing_frames and recording:
        words = tr("{count} frames are missing: close other programs")
        return StatusLight("warn", tr("The computer is too busy"), words.format(count=lag.missing_frames))
    kept = tr("The computer is busy; every frame is saved")
    words = tr("Values are {seconds} s behind").format(seconds=format_rounded(lag.lag_s))
    return StatusLight("idle", words, kept if recording else tr("The computer is busy"))


def catch_up_words(counters: LiveCounters) -> str:
    """Return how long catching up takes, for the button that stopped."""
    if not math.isfinite(counters.tracking_lag_s):
        return tr("Analysing…")
    return tr("Analysing: {seconds} s left").format(seconds=max(1, math.ceil(counters.tracking_lag_s)))
