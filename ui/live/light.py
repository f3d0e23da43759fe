"""The tracking light: what the camera sees, in one colour, one shape, one word and one remedy."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from carpus.core.types import TrackedFrame, TrackStatus
from carpus.ui.marker_words import hidden_remedy, marker_name
from carpus.ui.translate import tr

Rank = Literal["good", "warn", "bad", "idle"]
AMBER_AFTER_S = 0.3
GREEN_AFTER_S = 0.5


@dataclass(frozen=True, slots=True)
class Lamp:
    """What the light shows."""

    rank: Rank
    state: str
    remedy: str


def lamp_for(frame: TrackedFrame | None, markers: Sequence[str], forearm_moved: bool, trackable: int = 3) -> Lamp:
    """The light for one frame as it stands, without any delay."""
    if frame is None:
        return Lamp("idle", tr("Waiting for the first picture"), "")
    if frame.status == TrackStatus.LOST:
        return Lamp("bad", tr("Hand lost"), tr("Hold the hand flat under the camera"))
    hidden = [
        name for name, pixel in zip(markers, frame.marker_measured_px, strict=True) if not math.isfinite(pixel[0])
    ]
    if len(markers) - len(hidden) < trackable or frame.status == TrackStatus.PREDICTED:
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
