"""Cost of storing: rows of a session, and raw pictures."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from carpus.core.capture.files.raw import RawWriter
from carpus.core.capture.files.tum import TumFolder
from carpus.core.records.recordings import write_session
from carpus.core.session.journal import RecordingJournal
from carpus.core.simulation.recording import render_cached
from tests.bench.timing import HEAD, Times, line
from tests.bench.tracking import ORDINARY, frames_of
from tests.session.samples import CAMERA, make_calibration, make_frame, make_header

ROWS, PICTURES = 1800, 60


def report() -> Iterator[str]:
    """Measure and tell, line by line."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        appended, closed = Times(), Times()
        rows = [make_frame(row) for row in range(ROWS)]
        journal = RecordingJournal(folder / "rows.journal", make_header(), CAMERA, make_calibration())
        for row in rows:
            with appended.measured():
                journal.append(row)
        journal.close()
        with closed.measured():
            session = write_session(journal.path)
        assert session is not None
        sizes = f"{session.stat().st_size / 1e6:.1f} MB from a journal of {journal.path.stat().st_size / 1e6:.1f} MB"
        yield f"Storing one minute of wrist rows: {sizes}"
        yield HEAD
        mean = float(np.mean(appended.cpu_ms))
        slowest = max(appended.wall_ms)
        yield line(
            "row of a session", appended.cpu_ms, note=f"mean {mean:.3f}; longest wait for the disk {slowest:.0f} ms"
        )
        yield line("the session of a journal, at once", closed.cpu_ms)
        recording = render_cached(ORDINARY, workers=2)
        pictures = Times()
        raw = RawWriter(folder / "raw.carpusraw", TumFolder(recording).info)
        for frame in frames_of(recording)[:PICTURES]:
            with pictures.measured():
                raw.append_frame(frame)
        raw.close()
        per_minute = (folder / "raw.carpusraw").stat().st_size / PICTURES * 1800 / 1e6
        yield line("raw colour and depth of a frame", pictures.cpu_ms, note=f"{per_minute:.0f} MB a minute")
