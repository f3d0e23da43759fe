"""The practice patient: what it does in each exercise, whose still hand takes a second to draw and whose movement is
drawn while a person looks and clicks."""

from __future__ import annotations

import math
import os
import threading
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from carpus.core.capture.files.tum import TumFolder
from carpus.core.capture.paced import PracticeSource
from carpus.core.capture.source import FrameSource
from carpus.core.errors import CarpusFault
from carpus.core.records.set_up import PRACTICE_REPETITIONS, SetUp
from carpus.core.simulation.hand_motion import STILL_S
from carpus.core.simulation.spec import RecordingSpec
from carpus.ui.opening import NobodyWaitsError, Progress

_SPEED_HZ, _RANGE_SHARE, _SECONDS = 0.4, 0.8, 9.0
_OTHERWISE: dict[str, dict[str, Any]] = {
    "opposition": {"seconds": 11.5, "repetitions": 4, "range_share": 1.0},
    "reach_grasp": {"speed_hz": 0.3, "repetitions": 2, "range_share": 0.6},
}
"""A touch of each finger, which falls short of none; reaches that so few pictures can follow."""
_FPS = 15.0
"""Few pictures: they are drawn before the first report can be made. A real camera has 30 a second."""
_TILT_DEG, _HAND_TILT_DEG = 4.0, {"right": 11.0, "left": 8.0}
"""The thumb's discs face sideways: for them the thumb side is turned up, as far as the verdict allows."""
_READ_AHEAD = 8


def practice_spec(set_up: SetUp) -> RecordingSpec:
    """A short take: three repetitions, now and then a hidden marker, a false blue spot."""
    exercise = set_up.exercise
    usual = RecordingSpec(
        seed=5,
        hand=set_up.side,
        protocol=set_up.protocol.name,
        motion=exercise.motion,
        seconds=_SECONDS,
        fps=_FPS,
        speed_hz=_SPEED_HZ,
        repetitions=PRACTICE_REPETITIONS,
        range_share=_RANGE_SHARE,
        hand_length_mm=188.0,
        skin_tone=1,
        light="bright",
        sleeve="grey",
        distance_m=0.64,
        yaw_deg=3.0,
        tilt_deg=_HAND_TILT_DEG[set_up.side] if set_up.protocol.has_fingers else _TILT_DEG,
        hidden_share=0.02,
    )
    return replace(usual, **_OTHERWISE.get(exercise.motion, {}))


def practice_times(set_up: SetUp) -> int:
    """How often the take is played until the patient has done what is asked."""
    return max(1, math.ceil(set_up.repetitions / (practice_spec(set_up).repetitions or 1)))


def practice_take(set_up: SetUp, progress: Callable[[int, int], None]) -> tuple[FrameSource, float]:
    """The take as a source, and how long it is still at its start."""
    from carpus.core.simulation.recording import cached_recording

    folder = cached_recording(practice_spec(set_up), progress, workers=os.cpu_count() or 1)
    return TumFolder(folder, read_ahead=_READ_AHEAD), STILL_S - 1.0 / _FPS


def practice_beginning(set_up: SetUp) -> tuple[FrameSource, float] | None:
    """The same hand in the same place, as long as it is still; None where the whole take was drawn before."""
    from carpus.core.simulation.recording import FirstPictures, is_cached

    if is_cached(practice_spec(set_up)):
        return None
    return FirstPictures(practice_spec(set_up), STILL_S), STILL_S - 1.0 / _FPS


class TakesDrawn:
    """Draws the practice patient's takes one after the other, in a thread of its own that ends with the patient."""

    def __init__(
        self,
        patient: PracticeSource,
        draw: Callable[[SetUp, Progress], tuple[FrameSource, float]],
        set_ups: Mapping[str, SetUp],
        drawn: Mapping[str, FrameSource],
        progress: Progress,
        tell: Callable[[Exception], None],
    ) -> None:
        self._patient, self._draw, self._set_ups = patient, draw, set_ups
        self._progress, self._tell = progress, tell
        self._drawn = dict(drawn)
        self._chosen = next(iter(set_ups))
        self._turn = threading.Lock()

    def start(self) -> None:
        """Begin with what is not there yet."""
        if len(self._drawn) < len(self._set_ups):
            # No daemon: one that still draws while the program ends would be cut off in the middle, which aborts it.
            threading.Thread(target=self._run, name="practice takes", daemon=False).start()

    def choose(self, exercise: str) -> None:
        """The exercise that the patient does next, as soon as it is drawn."""
        with self._turn:
            self._chosen = exercise
            self._patient.play_next(self._drawn.get(exercise))

    def _run(self) -> None:
        self._patient.shown.wait()  # the first picture before all others: drawing takes every core
        try:
            for name, set_up in self._set_ups.items():
                if name in self._drawn:
                    continue
                self._on_the_way(0, 1)
                take, _ = self._draw(set_up, self._on_the_way)
                with self._turn:
                    self._drawn[name] = take
                    if name == self._chosen:
                        self._patient.play_next(take)
        except NobodyWaitsError:
            return
        except CarpusFault as fault:
            self._tell(fault)

    def _on_the_way(self, done: int, total: int) -> None:
        if self._patient.is_closed:
            raise NobodyWaitsError
        self._progress(done, total)
