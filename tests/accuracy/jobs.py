"""One recording of one row by all methods, and many of them side by side."""

from __future__ import annotations

import multiprocessing
import sys
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from typing import TypeVar

from threadpoolctl import threadpool_limits
from tqdm import tqdm

from carpus.core.simulation.recording import render_cached
from tests.accuracy.carpus import run_on_blobs, run_on_pictures
from tests.accuracy.scenarios import Scenario
from tests.accuracy.scores import Mode, Run
from tests.accuracy.simplest import simplest_run
from tests.simulation.measurements import measurement_sequence

BLOB_SECONDS, PICTURE_SECONDS = 8.0, 7.0


Job = tuple[Scenario, int, Mode]
"""A row, its seed, and whether it is rendered."""


def run_job(job: Job) -> list[Run]:
    """Carpus and the simplest thing on one recording."""
    row, seed, mode = job
    with threadpool_limits(1):
        if mode == "blobs":
            sequence = measurement_sequence(row.spec(seed, BLOB_SECONDS))
            carpus, begin_s = run_on_blobs(row, sequence)
            return [carpus, simplest_run(row, sequence, begin_s)]
        spec = row.spec(seed, PICTURE_SECONDS)
        folder = render_cached(spec)
        carpus, sequence, begin_s = run_on_pictures(row.name, spec, folder)
        return [carpus, simplest_run(row, sequence, begin_s, folder)]


def make_jobs(rows: Sequence[Scenario], seeds: int, pictures: int) -> list[Job]:
    """``pictures`` rendered recordings of every row that wants them, these first: they take longest; of every other,
    and where no pictures are asked for of all, ``seeds`` simulated measurements."""
    out: list[Job] = [
        (row, seed, "pictures") for row in rows if row.pictures for seed in row.seeds(pictures)[:pictures]
    ]
    by_blobs = [row for row in rows if not (row.pictures and pictures)]
    return out + [(row, seed, "blobs") for row in by_blobs for seed in row.seeds(seeds)]


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
