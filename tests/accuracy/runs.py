"""What one method made of one recording, in the form that is scored."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from carpus.core.model.types import FloatArray, TrackStatus
from tests.accuracy.readings import Reading, longest_each_s

Mode = Literal["blobs", "pictures"]
"""Simulated measurements, or rendered pictures through the whole of Carpus."""

CARPUS, SIMPLEST, INFORMED = "Carpus", "simplest", "informed"


@dataclass(frozen=True, slots=True)
class Estimate:
    """Errors of the angles (N, A) and their stated standard deviations (N, A), degrees; NaN where none is stated."""

    error_deg: FloatArray
    sd_deg: FloatArray


@dataclass(frozen=True, slots=True)
class Run:
    """One recording by one method.

    ``smoothed`` None where it does not look back; ``status`` (N,) as in a session; ``taken`` measurements were taken
    for a marker, ``wrong`` of them another thing's, for at most ``longest_wrong_s`` on end; ``longest_untracked_s`` it
    was not tracked while four discs of the palm showed; the therapist's ``reading``,
    live, where they were looked at.
    """

    scenario: str
    seed: int
    mode: Mode
    method: str
    causal: Estimate
    smoothed: Estimate | None
    status: NDArray[np.int64]
    taken: int
    wrong: int
    longest_wrong_s: float
    longest_untracked_s: float
    reading: Reading | None = None

    @property
    def ends_lost(self) -> bool:
        return bool(self.status[-1] == TrackStatus.LOST)


def degrees_between(angles_rad: FloatArray, true_rad: FloatArray) -> FloatArray:
    """Differences of angles in degrees, -180 to 180."""
    return np.asarray(np.degrees((angles_rad - true_rad + np.pi) % (2.0 * np.pi) - np.pi))


def longest_s(wrong: NDArray[np.bool_], time_s: FloatArray) -> float:
    """Longest time on end that a marker (M) was wrong over frames (N, M), from its first to its last such frame."""
    return float(longest_each_s(wrong, time_s).max())
