"""What the simulated recordings show that tests share: each is rendered once a run, by the fixture ``rendered``."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import h5py
import numpy as np

from carpus.core.simulation.recording import TRUTH_FILE
from carpus.core.simulation.scene import Scene
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.simulation.truth import VISIBLE_SHARE_PATH, Truth, compute_truth

Rendered = Callable[[RecordingSpec], Path]
"""Gives the folder with the recording of a spec; nobody writes into it."""

FLEXION = RecordingSpec(seed=2, seconds=0.8)
REPEATED_FLEXION = RecordingSpec(
    seed=5, motion="flexion", seconds=4.9, fps=15.0, speed_hz=0.6, repetitions=2, range_share=0.6,
    hand_length_mm=188.0, skin_tone=1, light="bright", sleeve="grey", distance_m=0.64, click_error_px=1.0,
)  # fmt: skip
DEVIATION = RecordingSpec(seed=1, motion="deviation", seconds=1.0, speed_hz=1.2)
LEFT_DEVIATION = RecordingSpec(seed=5, motion="deviation", seconds=1.3, speed_hz=0.9, hand="left", distance_m=0.68)

WHOLE_HAND = RecordingSpec(
    seed=5, protocol="hand21", motion="fist", seconds=5.0, fps=15.0, speed_hz=0.6, repetitions=2, range_share=0.5,
    hand_length_mm=192.0, skin_tone=1, light="bright", sleeve="grey", distance_m=0.64, click_error_px=1.0,
)  # fmt: skip


def read_truth(spec: RecordingSpec, folder: Path) -> Truth:
    """The true values of a recording made earlier from the same spec."""
    with h5py.File(folder / TRUTH_FILE, "r") as file:
        seen = np.asarray(file[VISIBLE_SHARE_PATH][()], dtype=np.float64)
    return replace(compute_truth(Scene(spec)), visible_share=seen)
