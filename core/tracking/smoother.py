"""Smoothing, written once: every frame's estimate in the light of all that came after.

Rauch, Tung and Striebel's recursion. What the numbers of a chain mean is the trajectory's: the palm's and the fingers'
are :mod:`core.tracking.palm_smoother` and :mod:`core.tracking.finger_smoother`. Where a track was lost and begun anew,
the two stretches are smoothed each by itself.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar

from carpus.core.tracking.kernel import rts_step
from carpus.core.types import FloatArray

Estimate = TypeVar("Estimate")


@dataclass(frozen=True, slots=True)
class Passage:
    """From one frame of C chains to the next, about the earlier one's filtered mean: its ``covariance``, the step's
    ``forward`` and ``noise`` (C, n, n), how far the later smoothed mean lies from the predicted one, ``apart`` (C, n),
    and the ``later_covariance`` (C, n, n)."""

    covariance: FloatArray
    forward: FloatArray
    noise: FloatArray
    apart: FloatArray
    later_covariance: FloatArray


class Trajectory(Protocol[Estimate]):
    """Frames as a filter has left them, in order of time."""

    def __len__(self) -> int: ...

    def filtered(self, frame: int) -> Estimate | None:
        """What was believed after a frame; None where nothing was known."""

    def seconds_on(self, frame: int) -> float | None:
        """Time to the next frame; None where that one does not follow from this one."""

    def passage(self, frame: int, now: Estimate, later: Estimate, dt_s: float) -> Passage:
        """From the estimate of a frame to the smoothed one of the next."""

    def moved(self, now: Estimate, correction: FloatArray, covariance: FloatArray) -> Estimate:
        """An estimate moved by a ``correction`` (C, n), with another ``covariance`` (C, n, n)."""


class Smoother(Generic[Estimate]):
    """Smooths one trajectory."""

    def __init__(self, trajectory: Trajectory[Estimate]) -> None:
        self._trajectory = trajectory

    def backwards(self) -> Iterator[tuple[int, Estimate | None]]:
        """Every frame with its smoothed estimate, None where nothing was known; the last frame first."""
        later: Estimate | None = None
        for frame in reversed(range(len(self._trajectory))):
            later = self._before(frame, later)
            yield frame, later

    def _before(self, frame: int, later: Estimate | None) -> Estimate | None:
        """The smoothed estimate of a frame from that of the next."""
        now, dt_s = self._trajectory.filtered(frame), self._trajectory.seconds_on(frame)
        if now is None or later is None or dt_s is None:
            return now
        if dt_s <= 0.0:
            return later  # the same moment: nothing lies between
        passage = self._trajectory.passage(frame, now, later, dt_s)
        correction, covariance = rts_step(
            passage.covariance, passage.forward, passage.noise, passage.apart, passage.later_covariance
        )
        return self._trajectory.moved(now, correction, covariance)
