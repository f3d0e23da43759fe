"""The practice patient: which simulated take belongs to a set-up, rendered once and kept in the user's cache."""

from __future__ import annotations

import os
from collections.abc import Callable

from core.capture.source import FrameSource
from core.capture.tum import TumFolder
from core.output.exercises import DEVIATION, FLEXION, PRONOSUPINATION
from core.simulation.motions import STILL_S
from core.simulation.recording import cached_recording
from core.simulation.spec import RecordingSpec
from ui.ports import SetUp

_MOTION = {FLEXION: "flexion", DEVIATION: "deviation", PRONOSUPINATION: "pronosupination", None: "mixed"}
_HAND_MOTION = {
    "FIST_COMPOSITE": "fist",
    "FIST_HOOK": "hook",
    "FINGER_ABAD": "abduction",
    "THUMB_OPP": "thumb",
    "FREE_HAND": "fingers",
}
_SPEED_HZ, _RANGE_SHARE, _REPETITIONS, _SECONDS = 0.36, 0.8, 10, 30.0
_TILT_DEG, _HAND_TILT_DEG = 4.0, 11.0
"""The thumb's discs face sideways: for them the thumb side is turned up."""
_READ_AHEAD = 8


def practice_spec(set_up: SetUp, seconds: float = _SECONDS) -> RecordingSpec:
    """A take of half a minute: ten repetitions, now and then a hidden marker, a false blue spot."""
    exercise = set_up.exercise
    return RecordingSpec(
        seed=5,
        hand=set_up.side,
        protocol=exercise.protocol.name,
        motion=_HAND_MOTION.get(exercise.id, _MOTION[exercise.angle]),
        seconds=seconds,
        speed_hz=_SPEED_HZ,
        repetitions=_REPETITIONS,
        range_share=_RANGE_SHARE,
        hand_length_mm=188.0,
        skin_tone=1,
        light="bright",
        sleeve="grey",
        distance_m=0.64,
        yaw_deg=3.0,
        tilt_deg=_HAND_TILT_DEG if exercise.protocol.has_fingers else _TILT_DEG,
        hidden_share=0.02,
        false_blobs=0.4,
    )


def practice_take(
    set_up: SetUp, progress: Callable[[int, int], None], seconds: float = _SECONDS
) -> tuple[FrameSource, float]:
    """The take as a source, and how long it is still at its start."""
    folder = cached_recording(practice_spec(set_up, seconds), progress, workers=os.cpu_count() or 1)
    return TumFolder(folder, read_ahead=_READ_AHEAD), STILL_S - 1.0 / 30.0
