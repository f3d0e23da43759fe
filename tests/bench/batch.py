"""Recordings tracked a minute, against the processes that track them; frames a second and core of one that is raw."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

from carpus.app.batch.tracking_task import TrackingTask
from carpus.app.batch.worker_pool import count_cores, run_tasks
from carpus.app.sources import TrackingInput
from carpus.core.calibration.clicks_file import read_clicks
from carpus.core.capture.files.raw import RawRecording, RawWriter
from carpus.core.capture.files.tum import TumFolder
from carpus.core.pipeline.track import TrackSettings, track_recording
from carpus.core.simulation.recording import CLICKS_FILE, render_cached
from carpus.core.simulation.spec import RecordingSpec

SECONDS, EACH, LONGER_S, WANTED = 6.0, 4, 20.0, 300.0


def track_raw() -> str:
    """The second of two walks through a raw recording of the wrist: the first loads what is loaded once."""
    recording = render_cached(RecordingSpec(seed=7, motion="flexion", seconds=LONGER_S))
    clicks = read_clicks(recording / CLICKS_FILE, 640, 480)
    with tempfile.TemporaryDirectory() as name:
        path, source = Path(name) / "r.carpusraw", TumFolder(recording)
        with RawWriter(path, source.info) as writer:
            for frame in source.frames():
                writer.append_frame(frame)
        for number in range(2):
            begin_s = time.process_time()
            output = path.with_name(f"{number}.h5")
            count = track_recording(RawRecording(path), clicks, output, TrackSettings(), path=path).frames
    speed = count / (time.process_time() - begin_s)
    return f"Raw recording of the wrist, smoothed: {speed:.0f} frames a second and core ({WANTED:.0f} wanted)"


def report() -> Iterator[str]:
    """Measure and tell, line by line: so many recordings for each process, with one process and one a core."""
    yield track_raw()
    recording = render_cached(RecordingSpec(seed=7, motion="flexion", seconds=SECONDS))
    yield f"Recordings of {SECONDS:g} s (six discs, smoothed) tracked a minute; start of the processes included"
    for count in sorted({1, count_cores()}):
        with tempfile.TemporaryDirectory() as name:
            outputs = [Path(name) / f"{number}.h5" for number in range(EACH * count)]
            inputs = [TrackingInput(recording, recording / CLICKS_FILE, output, output.stem) for output in outputs]
            begin_s = time.perf_counter()
            done = list(run_tasks([TrackingTask(one, TrackSettings()) for one in inputs], count))
            a_minute = 60.0 * len(done) / (time.perf_counter() - begin_s)
        faults = [each.messages for each in done if each.result != "tracked"]
        yield f"{count} of {count_cores()} cores: {a_minute:.1f} recordings a minute, {len(faults)} faults {faults[:1]}"
