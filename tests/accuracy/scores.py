"""What one method made of one recording, and many such runs as the figures of one line of the table."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from carpus.core.model.types import FloatArray, TrackStatus
from tests.accuracy.readings import INSIDE_SD, Reading, longest_each_s

Mode = Literal["blobs", "pictures"]
"""Simulated measurements, or rendered pictures through the whole of Carpus."""

CARPUS, SIMPLEST = "Carpus", "simplest"


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


@dataclass(frozen=True, slots=True)
class Score:
    """Runs of one method pooled over all their frames; arrays have one value for each of C columns, degrees.

    ``rmse``, ``p95`` of the errors; ``inside`` share of frames with the truth within two stated sds, ``worst_inside``
    of the worst recording, all columns together; ``sd_over_rmse`` mean
    stated sd over the RMSE. ``tracked`` share of the frames, ``wrong`` share of the measurements taken,
    ``longest_wrong_s`` of any marker, ``longest_untracked_s`` though enough discs showed, ``ends_lost`` recordings.
    """

    recordings: int
    rmse: FloatArray
    p95: FloatArray
    inside: FloatArray
    worst_inside: float
    sd_over_rmse: FloatArray
    tracked: float
    wrong: float
    longest_wrong_s: float
    longest_untracked_s: float
    ends_lost: int


def score(runs: Sequence[Run], columns: Sequence[str], *, smoothed: bool = False) -> Score | None:
    """The figures of runs of one method; None when there are none (or none that look back)."""
    pairs = [(run, run.smoothed if smoothed else run.causal) for run in runs]
    kept = [(run, estimate) for run, estimate in pairs if estimate is not None]
    if not kept:
        return None
    names = list(dict.fromkeys(columns))
    series = [[i for i, name in enumerate(columns) if name == one] for one in names]

    def by_column(of: Callable[[Estimate], FloatArray]) -> list[FloatArray]:
        """All finite values of each column over all runs."""
        every = [of(estimate) for _, estimate in kept]
        return [np.concatenate([_finite(values[:, some]) for values in every]) for some in series]

    error = by_column(lambda e: e.error_deg)
    sd = by_column(lambda e: np.where(np.isfinite(e.error_deg), e.sd_deg, np.nan))
    inside = by_column(_inside)
    rmse = np.array([np.sqrt(np.mean(values**2)) if values.size else np.nan for values in error])
    whole = [_mean(_finite(_inside(estimate))) for _, estimate in kept]
    status = np.concatenate([run.status for run, _ in kept])
    return Score(
        recordings=len(kept),
        rmse=rmse,
        p95=np.array([np.quantile(np.abs(values), 0.95) if values.size else np.nan for values in error]),
        inside=np.array([_mean(values) for values in inside]),
        worst_inside=float(np.min(whole)),
        sd_over_rmse=np.array([_mean(values) for values in sd]) / rmse,
        tracked=float(np.mean(status == TrackStatus.TRACKED)),
        wrong=sum(run.wrong for run, _ in kept) / max(1, sum(run.taken for run, _ in kept)),
        longest_wrong_s=max(run.longest_wrong_s for run, _ in kept),
        longest_untracked_s=max(run.longest_untracked_s for run, _ in kept),
        ends_lost=sum(run.ends_lost for run, _ in kept),
    )


def _inside(estimate: Estimate) -> FloatArray:
    """1 where the truth is within two sds, 0 where not, NaN where nothing is stated."""
    stated = np.isfinite(estimate.error_deg) & np.isfinite(estimate.sd_deg)
    return np.where(stated, np.abs(estimate.error_deg) <= INSIDE_SD * estimate.sd_deg, np.nan)


def _finite(values: FloatArray) -> FloatArray:
    return np.asarray(values[np.isfinite(values)])


def _mean(values: FloatArray) -> float:
    return float(values.mean()) if values.size else float("nan")
