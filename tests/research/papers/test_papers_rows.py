"""The rows of the papers' method stand on the recordings that Carpus has in the same rows."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from carpus.core.model.types import TrackStatus
from tests.accuracy.hand21_table import hand_jobs
from tests.accuracy.jobs import BLOB_SECONDS, jobs_for
from tests.accuracy.papers import HAND_ROWS, HEAD, WRIST_ROWS, PaperJob, lines_of, paper_jobs, paper_runs
from tests.accuracy.readings import read_figures


def test_recordings_are_those_of_carpus() -> None:
    jobs = paper_jobs(WRIST_ROWS, HAND_ROWS, 2)
    carpus = [job.scenario.spec(job.seed, BLOB_SECONDS) for job in jobs_for(WRIST_ROWS, 2, 0)]
    carpus += [job.row.spec(job.number) for job in hand_jobs(HAND_ROWS, 4, 0)]
    assert all(job.spec in carpus for job in jobs)
    assert len(jobs) == 2 * (len(WRIST_ROWS) + len(HAND_ROWS))


def test_row_of_wrist_and_one_of_hand() -> None:
    by_name = {row.name: row for row in WRIST_ROWS}
    wrist = paper_jobs([by_name["deviation ±25°"]], [], 1)[0]
    hand = paper_jobs([], [HAND_ROWS[0]], 1)[0]
    short = [PaperJob(job.row, replace(job.spec, seconds=4.0)) for job in (wrist, hand)]
    as_written, runs = zip(*map(paper_runs, short), strict=True)
    assert read_figures([runs[0].wrist], (0,)).rmse < 2.0
    assert np.mean(runs[0].status == TrackStatus.TRACKED) > 0.9
    assert runs[0].joints is None
    assert runs[1].joints is not None
    assert np.isfinite(read_figures([runs[1].joints], range(21)).rmse)
    assert read_figures([as_written[0].wrist], (2,)).rmse > read_figures([runs[0].wrist], (2,)).rmse
    lines = list(lines_of([*as_written, *runs]))
    assert [line[:2] for line in lines] == [
        ["deviation ±25°", "as written"],
        ["deviation ±25°", "palm as measured"],
        [f"{HAND_ROWS[0].name}, whole hand", "as written"],
        [f"{HAND_ROWS[0].name}, whole hand", "palm as measured"],
    ]
    assert all(len(line) == len(HEAD) for line in lines)
