"""What the simulated recordings show that tests share: each is rendered once a run, by the fixture ``rendered``."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from carpus.core.simulation.spec import RecordingSpec

Rendered = Callable[[RecordingSpec], Path]
"""Gives the folder with the recording of a spec; nobody writes into it."""

FLEXION = RecordingSpec(seed=2, seconds=0.8)
REPEATED_FLEXION = RecordingSpec(seed=4, motion="flexion", seconds=2.5, speed_hz=1.2, range_share=0.6)
DEVIATION = RecordingSpec(seed=1, motion="deviation", seconds=1.0, speed_hz=1.2)
LEFT_DEVIATION = RecordingSpec(seed=5, motion="deviation", seconds=1.3, speed_hz=0.9, hand="left", distance_m=0.68)
