"""What one method made of one recording, and many such runs as the lines of a table."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from carpus.core.model.types import FloatArray, TrackStatus
from tests.accuracy.pages import rule_table
from tests.accuracy.readings import INSIDE_SD, Reading, ReadRow, longest_each_s
from tests.accuracy.scenarios import Scenario

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


_METHODS: tuple[tuple[str, str, bool], ...] = (
    ("Carpus, live", CARPUS, False),
    ("Carpus, looking back", CARPUS, True),
    ("simplest thing", SIMPLEST, False),
)
_NONE = "-"


@dataclass(frozen=True, slots=True)
class Row:
    """Runs that are pooled in one row; ``columns`` of their angles."""

    name: str
    mode: Mode
    columns: tuple[str, ...]
    runs: tuple[Run, ...]


def collect_rows(runs: Sequence[Run], scenarios: Sequence[Scenario]) -> Iterator[Row]:
    """Every scenario by measurements, then the pools, then the same by pictures."""
    for mode in ("blobs", "pictures"):
        mine = [run for run in runs if run.mode == mode]
        for scenario in scenarios:
            some = tuple(run for run in mine if run.scenario == scenario.name)
            if some:
                yield Row(scenario.name, mode, scenario.columns, some)
        for pool in dict.fromkeys(scenario.pool for scenario in scenarios if scenario.pool):
            members = [scenario for scenario in scenarios if scenario.pool == pool]
            some = tuple(run for run in mine if run.scenario in {member.name for member in members})
            if len(members) > 1 and some:
                yield Row(f"{pool}, pooled", mode, members[0].columns, some)


def read_rows(rows: Sequence[Row]) -> list[ReadRow]:
    """What a therapist reads live off Carpus, by every row."""
    out = []
    for row in rows:
        readings = tuple(run.reading for run in row.runs if run.method == CARPUS and run.reading is not None)
        columns = {
            name: tuple(i for i, one in enumerate(row.columns) if one == name) for name in dict.fromkeys(row.columns)
        }
        if readings:
            out.append(ReadRow(row.name if row.mode == "blobs" else f"{row.name} (pictures)", columns, readings))
    return out


def _three(values: FloatArray, digits: int = 2, factor: float = 1.0) -> str:
    if not np.isfinite(values).any():
        return _NONE
    return " / ".join(f"{factor * value:.{digits}f}" for value in values)


def _scores(row: Row) -> Iterator[tuple[str, Score]]:
    for label, method, smoothed in _METHODS:
        figures = score([run for run in row.runs if run.method == method], row.columns, smoothed=smoothed)
        if figures is not None:
            yield label, figures


def markdown(rows: Sequence[Row]) -> str:
    """One line for every row: RMSE of all methods, and how sure Carpus was of angles and names."""
    head = [
        "row", "recordings", "live", "live, 95th percentile", "looking back", "simplest thing", "within 2 sd, %",
        "mean sd / RMSE", "tracked, %", "wrong, %", "longest swap, s", "back after, s",
    ]  # fmt: skip
    lines = [head]
    for row in rows:
        found = dict(_scores(row))
        live = found.get("Carpus, live")
        if live is None:
            continue
        name = row.name if row.mode == "blobs" else f"{row.name} (pictures)"
        cells = [name, str(live.recordings), _three(live.rmse), _three(live.p95)]
        cells += [
            _three(found[label].rmse) if label in found else _NONE
            for label in ("Carpus, looking back", "simplest thing")
        ]
        cells += [
            _three(live.inside, 0, 100.0),
            _three(live.sd_over_rmse), f"{100 * live.tracked:.1f}", f"{100 * live.wrong:.2f}",
            f"{live.longest_wrong_s:.1f}", f"{live.longest_untracked_s:.1f}",
        ]  # fmt: skip
        lines.append(cells)
    return rule_table(lines)
