"""One recording of one row by all methods, and many of them side by side."""

from __future__ import annotations

import multiprocessing
import sys
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from typing import TypeVar

from threadpoolctl import threadpool_limits
from tqdm import tqdm

from carpus.core.simulation.recording import render_cached
from tests.accuracy.carpus import run_on_blobs, run_on_pictures
from tests.accuracy.scenarios import REPORT_SEEDS, Scenario
from tests.accuracy.scores import Mode, Run
from tests.accuracy.simplest import simplest_run
from tests.simulation.measurements import measurement_sequence

BLOB_SECONDS, PICTURE_SECONDS = 8.0, 7.0


@dataclass(frozen=True, slots=True)
class Job:
    """One recording of one row by all methods."""

    scenario: Scenario
    seed: int
    mode: Mode


def run_job(job: Job) -> list[Run]:
    """Carpus and the simplest thing on one recording."""
    with threadpool_limits(1):
        if job.mode == "blobs":
            sequence = measurement_sequence(job.scenario.spec(job.seed, BLOB_SECONDS))
            carpus, begin_s = run_on_blobs(job.scenario, sequence)
            simplest = simplest_run(job.scenario, sequence, begin_s)
        else:
            spec = job.scenario.spec(job.seed, PICTURE_SECONDS)
            folder = render_cached(spec)
            carpus, sequence, begin_s = run_on_pictures(job.scenario.name, spec, folder)
            simplest = simplest_run(job.scenario, sequence, begin_s, folder)
        return [carpus, simplest]


def make_jobs(scenarios: Sequence[Scenario], seeds: int, pictures: int, first: int = REPORT_SEEDS) -> list[Job]:
    """``pictures`` rendered recordings of every row that wants them, these first: they take longest; of every other,
    and where no pictures are asked for of all, ``seeds`` simulated measurements. Seeds of a row from ``first`` on."""
    out = [
        Job(scenario, seed, "pictures")
        for scenario in scenarios
        if scenario.pictures
        for seed in scenario.seeds(pictures, first)[:pictures]
    ]
    by_blobs = [scenario for scenario in scenarios if not (scenario.pictures and pictures)]
    return out + [Job(scenario, seed, "blobs") for scenario in by_blobs for seed in scenario.seeds(seeds, first)]


_Job = TypeVar("_Job")
_Done = TypeVar("_Done")


def side_by_side(work: Callable[[_Job], _Done], jobs: Sequence[_Job], processes: int) -> list[_Done]:
    """What becomes of all jobs, in their order; progress goes to stderr."""
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(processes, mp_context=context) as pool:
        return list(tqdm(pool.map(work, jobs), total=len(jobs), file=sys.stderr))


def all_runs(jobs: Sequence[Job], processes: int) -> list[Run]:
    """Runs of all jobs, in their order."""
    return [run for runs in side_by_side(run_job, jobs, processes) for run in runs]
