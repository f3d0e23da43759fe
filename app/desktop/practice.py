"""The practice patient: its movements, rendered while a person looks and clicks.

The still hand is rendered first, within a second.
"""

from __future__ import annotations

import math
import os
import threading
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from carpus.core.capture.files.tum import TumFolder
from carpus.core.capture.playback_sources import PracticeSource
from carpus.core.capture.source import FrameSource
from carpus.core.model.errors import CarpusFault
from carpus.core.records.session_setup import PRACTICE_REPETITIONS, SessionSetup
from carpus.core.simulation.hand_motion import STILL_S
from carpus.core.simulation.spec import RecordingSpec
from carpus.ui.shell.source_opener import OpeningCancelledError, Progress

_SPEED_HZ, _RANGE_SHARE, _SECONDS = 0.4, 0.8, 9.0
_MOTION_OVERRIDES: dict[str, dict[str, Any]] = {
    "opposition": {"seconds": 11.5, "repetitions": 4, "range_share": 1.0},
    "reach_grasp": {"speed_hz": 0.3, "repetitions": 2, "range_share": 0.6},
}
"""Opposition must touch each finger; a reach must be slow enough for 15 frames a second."""
_FPS = 15.0
"""Half the frames of a real camera: they are rendered before the first report."""
_TILT_DEG, _HAND_TILT_DEG = 4.0, {"right": 11.0, "left": 8.0}
"""The thumb's markers face sideways: tilt that side up as far as the calibration allows."""


def practice_spec(set_up: SessionSetup) -> RecordingSpec:
    """Return a short recording with now and then a hidden marker or a false blue spot."""
    exercise = set_up.exercise
    usual = RecordingSpec(
        seed=5,
        hand=set_up.side,
        protocol=set_up.protocol.name,
        motion=exercise.simulated_motion,
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
    return replace(usual, **_MOTION_OVERRIDES.get(exercise.simulated_motion, {}))


def practice_play_count(set_up: SessionSetup) -> int:
    """Return how often the recording is played for all repetitions of the set-up."""
    return max(1, math.ceil(set_up.repetitions / (practice_spec(set_up).repetitions or 1)))


def render_practice(set_up: SessionSetup, progress: Callable[[int, int], None]) -> tuple[FrameSource, float]:
    """Return the recording as a source, and the seconds for which it is still at its start."""
    from carpus.core.simulation.recording import render_cached

    folder = render_cached(practice_spec(set_up), progress, workers=os.cpu_count() or 1)
    return TumFolder(folder), STILL_S - 1.0 / _FPS


def render_practice_start(set_up: SessionSetup) -> tuple[FrameSource, float] | None:
    """Return the still part of the recording; None if all of it was rendered before."""
    from carpus.core.simulation.recording import SimulatedSource, is_cached

    if is_cached(practice_spec(set_up)):
        return None
    return SimulatedSource(practice_spec(set_up), STILL_S), STILL_S - 1.0 / _FPS


class PracticeRenderer:
    """Renders the patient's exercises one after the other in a thread."""

    def __init__(
        self,
        patient: PracticeSource,
        render: Callable[[SessionSetup, Progress], tuple[FrameSource, float]],
        set_ups: Mapping[str, SessionSetup],
        rendered: Mapping[str, FrameSource],
        progress: Progress,
        on_fault: Callable[[Exception], None],
    ) -> None:
        self._patient, self._render, self._set_ups = patient, render, set_ups
        self._progress, self._on_fault = progress, on_fault
        self._rendered = dict(rendered)
        self._chosen_exercise = next(iter(set_ups))
        self._lock = threading.Lock()

    def start(self) -> None:
        """Start rendering what is missing."""
        if len(self._rendered) < len(self._set_ups):
            # No daemon: one that still draws while the program ends would be cut off in the middle, which aborts it.
            threading.Thread(target=self._run, name="practice takes", daemon=False).start()

    def choose(self, exercise: str) -> None:
        """Play an exercise next, as soon as it is rendered."""
        with self._lock:
            self._chosen_exercise = exercise
            self._patient.set_next_recording(self._rendered.get(exercise))

    def _run(self) -> None:
        self._patient.still_hand_shown.wait()  # the first picture before all others: drawing takes every core
        try:
            for name, set_up in self._set_ups.items():
                if name in self._rendered:
                    continue
                self._report_progress(0, 1)
                take, _ = self._render(set_up, self._report_progress)
                with self._lock:
                    self._rendered[name] = take
                    if name == self._chosen_exercise:
                        self._patient.set_next_recording(take)
        except OpeningCancelledError:
            return
        except CarpusFault as fault:
            self._on_fault(fault)

    def _report_progress(self, done: int, total: int) -> None:
        if self._patient.is_closed:
            raise OpeningCancelledError
        self._progress(done, total)
