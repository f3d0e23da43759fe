"""Recordings tracked a minute, against the processes that track them; frames a second and core of one that is raw."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Iterator
from itertools import islice
from pathlib import Path

from carpus.app.batch.tracking_task import TrackingTask
from carpus.app.batch.worker_pool import count_cores, run_tasks
from carpus.app.sources import TrackingInput
from carpus.core.calibration.clicks_file import read_clicks
from carpus.core.calibration.result import Clicks
from carpus.core.capture.files.raw import RawRecording, RawWriter
from carpus.core.capture.files.tum import TumFolder
from carpus.core.pipeline.track import TrackSettings, track_recording
from carpus.core.simulation.recording import CLICKS_FILE, render_cached
from carpus.core.simulation.spec import RecordingSpec
from tests.bench.tracking import make_pipeline

SECONDS, EACH = 6.0, 4
LONGER_S = 20.0
WANTED = 300.0


def _tracked(path: Path, clicks: Clicks, number: int) -> int:
    output = path.with_name(f"{number}.h5")
    settings = TrackSettings()
    return track_recording(RawRecording(path), clicks, output, settings, path=path).frames


def track_raw() -> Iterator[str]:
    """The second of two walks through a raw recording of the wrist, beside tracking its frames unpacked before."""
    recording = render_cached(RecordingSpec(seed=7, motion="flexion", seconds=LONGER_S))
    clicks = read_clicks(recording / CLICKS_FILE, 640, 480)
    with tempfile.TemporaryDirectory() as name:
        path, packing_s = Path(name) / "r.carpusraw", 0.0
        source = TumFolder(recording)
        with RawWriter(path, source.info) as writer:
            for frame in source.frames():
                begin_s = time.process_time()
                writer.append_frame(frame)
                packing_s += time.process_time() - begin_s
        _tracked(path, clicks, 0)  # loads what is loaded once
        begin_s = time.process_time()
        count = _tracked(path, clicks, 1)
        whole_s = time.process_time() - begin_s
        frames = list(islice(RawRecording(path).frames(), 240))
        pipeline, still_until_s = make_pipeline(recording, frames)
        moving = [frame for frame in frames if frame.timestamp_s > still_until_s]
        begin_s = time.process_time()
        for frame in moving:
            pipeline(frame)
        alone_ms = 1e3 * (time.process_time() - begin_s) / len(moving)
    each_ms = 1e3 * whole_s / count
    yield (
        f"Raw recording of the wrist, {count} frames, looked back at: {count / whole_s:.0f} frames a "
        f"second and core ({WANTED:.0f} wanted), {each_ms:.2f} ms each; tracking alone {alone_ms:.2f} ms; packing "
        f"{1e3 * packing_s / count:.1f} ms"
    )


def report() -> Iterator[str]:
    """Measure and tell, line by line: so many recordings for each process, from one process to one a core."""
    yield from track_raw()
    recording = render_cached(RecordingSpec(seed=7, motion="flexion", seconds=SECONDS))
    yield f"Recordings of {SECONDS:g} s (six discs, looked back at) tracked a minute; start of the processes included"
    one = 0.0
    for count in sorted({1, *(n for n in (2, 4, 8, 16, 32, 64) if n < count_cores()), count_cores()}):
        with tempfile.TemporaryDirectory() as name:
            tasks = [
                TrackingTask(
                    TrackingInput(recording, recording / CLICKS_FILE, Path(name) / f"{number}.h5", f"{number}"),
                    TrackSettings(),
                )
                for number in range(EACH * count)
            ]
            begin_s = time.perf_counter()
            done = list(run_tasks(tasks, count))
            a_minute = 60.0 * len(done) / (time.perf_counter() - begin_s)
        faults = [each.messages for each in done if each.result != "tracked"]
        if faults:
            yield f"{count} processes: {len(faults)} faults, {faults[0]}"
            continue
        one = one or a_minute
        yield f"{count} of {count_cores()} cores: {a_minute:.1f} recordings a minute, {a_minute / one:.2f} of one core's"  # noqa: E501
