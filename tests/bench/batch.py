"""Recordings tracked a minute, against the processes that track them."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

from carpus.app.batch.places import Place
from carpus.app.batch.processes import cores, outcomes
from carpus.app.batch.work import Task
from carpus.core.pipeline.track import TrackSettings
from carpus.core.simulation.recording import CLICKS_FILE, cached_recording
from carpus.core.simulation.spec import RecordingSpec

SECONDS, EACH = 6.0, 4


def report() -> Iterator[str]:
    """Measure and tell, line by line: so many recordings for each process, from one process to one a core."""
    recording = cached_recording(RecordingSpec(seed=7, motion="flexion", seconds=SECONDS))
    yield f"Recordings of {SECONDS:g} s (six discs, looked back at) tracked a minute; start of the processes included"
    one = 0.0
    for count in sorted({1, *(n for n in (2, 4, 8, 16, 32, 64) if n < cores()), cores()}):
        with tempfile.TemporaryDirectory() as name:
            tasks = [
                Task(
                    Place(recording, recording / CLICKS_FILE, Path(name) / f"{number}.h5", f"{number}"), TrackSettings()
                )
                for number in range(EACH * count)
            ]
            begin_s = time.perf_counter()
            done = list(outcomes(tasks, count))
            a_minute = 60.0 * len(done) / (time.perf_counter() - begin_s)
        faults = [each.said for each in done if each.result != "tracked"]
        if faults:
            yield f"{count} processes: {len(faults)} faults, {faults[0]}"
            continue
        one = one or a_minute
        yield f"{count} of {cores()} cores: {a_minute:.1f} recordings a minute, {a_minute / one:.2f} of one core's"
