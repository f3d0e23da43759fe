"""What the live screen tells a second view of the same moment, about ten times a second."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

RecordingState = Literal["off", "recording", "paused"]


@dataclass(frozen=True, slots=True)
class Glance:
    """One look at the hand; degrees, unknown is NaN.

    ``at_s`` on a clock that never stands still. ``value_deg`` of the trained angle with its sign, ``sure`` whether it
    is measured now; ``hand_seen`` whether at least the hand is, where the trained joint is not. ``wrist_deg``
    deviation, flexion, pro/supination and ``bent_deg`` the mean bending of the fingers, for exercises without a
    trained angle. ``done`` full repetitions of ``asked``; ``found`` as they
    are counted now, of which one may still turn out to be none. ``starts_s``: seconds that are still counted down
    to the recording, 0 for none.
    """

    at_s: float
    value_deg: float = math.nan
    sure: bool = False
    hand_seen: bool = False
    wrist_deg: tuple[float, float, float] = (math.nan, math.nan, math.nan)
    bent_deg: float = math.nan
    state: RecordingState = "off"
    done: int = 0
    asked: int = 0
    found: int = 0
    starts_s: int = 0
