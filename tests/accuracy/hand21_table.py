"""``python -m tests.accuracy --group hand``: the joints of the whole hand against simulated truth."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from threadpoolctl import threadpool_limits

from carpus.core.model.types import FloatArray
from tests.accuracy.hand21 import (
    ANGLES,
    JOINT_GROUPS,
    REPORT_SEEDS,
    HandRun,
    HandScenario,
    run_on_blobs,
    run_on_pictures,
)
from tests.accuracy.jobs import side_by_side
from tests.accuracy.pages import rule_table
from tests.accuracy.readings import mean, rms
from tests.accuracy.readings_table import WRIST_COLUMNS, ReadRow
from tests.accuracy.scores import Mode

MOST_RMSE_DEG = {
    "joints": {"MCP flexion": 2.5, "PIP flexion": 3.0, "DIP flexion": 3.0},
    "skin": {"MCP flexion": 3.5, "PIP flexion": 4.0, "DIP flexion": 4.0},
}
MOST_RMSE_ALWAYS = {"thumb MCP": 3.0, "thumb IP": 4.0, "abduction": 2.0}
READ_JOINTS = ("MCP flexion", "PIP flexion", "thumb CMC")
"""Groups of joints of which the therapist's columns are told."""


@dataclass(frozen=True, slots=True)
class Figures:
    """One group of angles over runs, degrees: RMSE, mean stated sd and share within two sds, of what was seen and of
    what was hidden, and of all; ``back`` RMSE of what was seen when looking back."""

    rmse: float
    sd: float
    inside: float
    hidden_inside: float
    all_inside: float
    back: float
    back_inside: float

    @property
    def sd_over_rmse(self) -> float:
        return self.sd / self.rmse


@dataclass(frozen=True, slots=True)
class HandJob:
    """One recording of one row."""

    row: HandScenario
    number: int
    mode: Mode
    first_seed: int = REPORT_SEEDS


def hand_job_done(job: HandJob) -> HandRun:
    """The recording tracked."""
    run = run_on_blobs if job.mode == "blobs" else run_on_pictures
    with threadpool_limits(1):
        return run(job.row, job.row.spec(job.number, job.first_seed))


def hand_jobs(rows: Sequence[HandScenario], seeds: int, pictures: int, first_seed: int = REPORT_SEEDS) -> list[HandJob]:
    """As :func:`tests.accuracy.jobs.make_jobs`: pictures where a row wants them, else simulated measurements."""
    out = [HandJob(row, i, "pictures", first_seed) for row in rows if row.pictures for i in range(pictures)]
    by_blobs = [row for row in rows if not (row.pictures and pictures)]
    return out + [
        HandJob(row, i, "blobs", first_seed) for row in by_blobs for i in range(max(1, seeds * row.weight // 2))
    ]


def all_hand_runs(jobs: Sequence[HandJob], processes: int) -> list[HandRun]:
    """Runs of all jobs, in their order."""
    return side_by_side(hand_job_done, jobs, processes)


def figures(runs: Sequence[HandRun], group: str) -> Figures:
    """The figures of one group of joints."""
    columns = [ANGLES.index(name) for name in JOINT_GROUPS[group]]

    def pooled(values: Sequence[FloatArray]) -> FloatArray:
        return np.concatenate([value[:, columns].ravel() for value in values])

    seen = pooled([run.seen for run in runs]).astype(bool)
    compared = pooled([run.compared for run in runs]).astype(bool)
    error, sd = pooled([run.joint_deg for run in runs]), pooled([run.joint_sd_deg for run in runs])
    back, back_sd = pooled([run.smoothed_deg for run in runs]), pooled([run.smoothed_sd_deg for run in runs])
    known = compared & np.isfinite(error) & np.isfinite(back)
    shown, hidden = known & seen, known & ~seen
    inside, back_inside = np.abs(error) <= 2.0 * sd, np.abs(back) <= 2.0 * back_sd
    return Figures(
        rms(error[shown]),
        mean(sd[shown]),
        mean(inside[shown]),
        mean(inside[hidden]),
        mean(inside[known]),
        rms(back[shown]),
        mean(back_inside[known]),
    )


def wrist_rmse(runs: Sequence[HandRun]) -> FloatArray:
    """RMSE (3,) of the wrist's angles, degrees."""
    error = np.concatenate([run.wrist_deg for run in runs])
    return np.asarray(np.sqrt(np.nanmean(error**2, axis=0)))


def disc_mm(runs: Sequence[HandRun]) -> FloatArray:
    """Median and 95th percentile of the discs' errors."""
    return np.asarray(np.percentile(np.concatenate([run.disc_mm for run in runs]), (50.0, 95.0)))


def _by_row(
    runs: Sequence[HandRun], rows: Sequence[HandScenario]
) -> Iterator[tuple[HandScenario, Mode, list[HandRun]]]:
    for row in rows:
        for mode in ("blobs", "pictures"):
            mine = [run for run in runs if run.scenario == row.name and run.mode == mode]
            if mine:
                yield row, mode, mine


def markdown(runs: Sequence[HandRun], rows: Sequence[HandScenario]) -> str:
    """One line for every row: RMSE of joints while seen, hidden ones with what was said of them."""
    head = [
        "row",
        "recordings",
        *JOINT_GROUPS,
        "hidden joints: RMSE, stated sd",
        "within 2 sd, %",
        "wrist",
        "discs, mm",
    ]
    lines = [head]
    for row, mode, mine in _by_row(runs, rows):
        found = [figures(mine, group) for group in JOINT_GROUPS]
        hidden = [np.concatenate([_hidden(value, run) for run, value in pairs]) for pairs in (
            [(run, run.joint_deg) for run in mine], [(run, run.joint_sd_deg) for run in mine]
        )]  # fmt: skip
        cells = [row.name if mode == "blobs" else f"{row.name} (pictures)", str(len(mine))]
        cells += [f"{f.rmse:.1f}" for f in found]
        cells.append(f"{rms(hidden[0]):.0f}, {mean(hidden[1]):.0f}")
        cells.append(f"{100 * min(f.all_inside for f in found):.0f} to {100 * max(f.all_inside for f in found):.0f}")
        cells.append(" / ".join(f"{v:.1f}" for v in wrist_rmse(mine)))
        cells.append(" / ".join(f"{v:.1f}" for v in disc_mm(mine)))
        lines.append(cells)
    return rule_table(lines)


def _hidden(values: FloatArray, run: HandRun) -> FloatArray:
    return np.asarray(values[~run.seen & np.isfinite(run.joint_deg)])


def read_rows(runs: Sequence[HandRun], rows: Sequence[HandScenario]) -> list[ReadRow]:
    """What a therapist reads, wrist and joints of every row."""
    groups = {name: tuple(ANGLES.index(one) for one in JOINT_GROUPS[name]) for name in READ_JOINTS}
    out = []
    for row, mode, mine in _by_row(runs, rows):
        name = f"21 discs, {row.name}" + ("" if mode == "blobs" else " (pictures)")
        out.append(ReadRow(f"{name}: wrist", WRIST_COLUMNS, tuple(run.wrist_reading for run in mine)))
        out.append(ReadRow(f"{name}: joints", groups, tuple(run.joint_reading for run in mine)))
    return out
