"""Exercises of the simulated patient, tracked and looked back at, with their truth."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import pytest

from carpus.core.calibration.calibrate import CalibrationSettings
from carpus.core.model.types import FloatArray
from carpus.core.pipeline.track import noise_from_neutral, restart_at_neutral
from carpus.core.session.values import Motion, stack_states
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.simulation.truth import Truth
from carpus.core.tracking.filter.settings import TrackerSettings
from carpus.core.tracking.tracker import Tracker
from tests.accuracy.carpus import measure_still_hand
from tests.simulation.measurements import measurement_sequence

ONE_PROCESS = pytest.mark.xdist_group("tracked exercises")
"""Of all tests that ask for tracked exercises: else each process tracks them."""


@dataclass(frozen=True)
class Tracked:
    """``causal`` and ``smoothed`` motion of one simulated exercise, and ``status`` (N,)."""

    truth: Truth
    causal: Motion
    smoothed: Motion
    status: FloatArray


def track_simulated(
    motion: str,
    seconds: float,
    speed_hz: float,
    seed: int = 1,
    share: float = 1.0,
    discs: str = "wrist6",
    stops: bool = False,
) -> Tracked:
    """Track simulated measurements as a recording is tracked; with ``stops`` of a patient who moves in pieces."""
    spec = RecordingSpec(
        seed=seed,
        motion=motion,
        seconds=seconds,
        speed_hz=speed_hz,
        range_share=share,
        pain_limited=stops,
        protocol=discs,  # type: ignore[arg-type]
    )
    return _tracked(spec)


@lru_cache(maxsize=32)
def _tracked(spec: RecordingSpec) -> Tracked:
    sequence = measurement_sequence(spec)
    hand, neutral_ends_s = measure_still_hand(sequence, CalibrationSettings())
    assert hand.calibration is not None
    settings = TrackerSettings()
    learnt = noise_from_neutral(hand.noise, neutral_ends_s, settings)
    tracker = Tracker(hand.calibration, sequence.truth.camera, learnt.adapt_settings(settings))
    times = sequence.truth.timestamp_s
    frames = [
        tracker.step(i, float(times[i]), sequence.detections[i], int(sequence.truth.dropped_before[i]))
        for i in restart_at_neutral(range(len(times)), tracker, neutral_ends_s, lambda row: float(times[row]))
    ]
    status = np.array([int(frame.status) for frame in frames])
    return Tracked(sequence.truth, stack_states(frames), stack_states(tracker.smooth()), status)
