"""The live session with the real journal and session file, read back by plain h5py."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
import pytest

from carpus.core.model.errors import DiskFull, OutputExists
from carpus.core.pipeline import measurement
from carpus.core.pipeline.live import LiveSession
from carpus.core.pipeline.measurement import RecordedSession
from carpus.core.session.journal import RecordingJournal
from carpus.core.session.reader import read_outline
from tests.pipeline.live_fakes import ControlledSource, make_tracked_frame, wait_until
from tests.session.samples import CAMERA, make_calibration, make_frame, make_header


def begin(path: Path) -> RecordedSession:
    return RecordedSession(RecordingJournal(path, make_header(), CAMERA, make_calibration()), None)


def test_recorded_session_becomes_complete_file(tmp_path: Path) -> None:
    source, path = ControlledSource(dropped_before=1), tmp_path / "session.journal"
    with LiveSession(source) as live:
        live.start_tracking(make_tracked_frame)
        live.start_recording(lambda: begin(path))
        for count in range(1, 41):
            source.let(1)
            wait_until(lambda count=count: live.counters().tracked == count)
        live.add_event("note", "elbow lifted")
        assert live.stop_recording() == tmp_path / "session.h5"
        assert live.drain_events() == []
    with h5py.File(tmp_path / "session.h5") as file:
        assert file.attrs["complete"]
        np.testing.assert_allclose(file["frames/timestamp"][:], 100.0 + np.arange(40) / 30.0)
        assert (file["quality/dropped_frames"][:] == 1).all()
        assert file["events/text"].asstr()[:].tolist() == ["elbow lifted"]
        assert file["events/time"][0] == pytest.approx(100.0 + 39 / 30.0)
    assert [entry.name for entry in tmp_path.iterdir()] == ["session.h5"]


def test_recorded_session_existing_journal_is_kept(tmp_path: Path) -> None:
    path = tmp_path / "session.journal"
    path.write_bytes(b"mine")
    with LiveSession(ControlledSource()) as live, pytest.raises(OutputExists):
        live.start_recording(lambda: begin(path))
    assert path.read_bytes() == b"mine"
    assert [entry.name for entry in tmp_path.iterdir()] == ["session.journal"]


def test_recorded_session_full_disk_is_retried_at_end(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    tries: list[Path] = []

    def fill(*_: object) -> None:
        tries.append(tmp_path)
        raise DiskFull(tmp_path)

    monkeypatch.setattr(measurement, "ROWS_AT_ONCE", 5)
    recording = begin(tmp_path / "session.journal")
    with monkeypatch.context() as full:
        full.setattr(measurement.SessionDraft, "read", fill)
        for row in range(20):
            recording.append(make_frame(row))
    recording.close()
    assert len(tries) == 1
    assert read_outline(tmp_path / "session.h5").frames == 20
    assert [entry.name for entry in tmp_path.iterdir()] == ["session.h5"]
