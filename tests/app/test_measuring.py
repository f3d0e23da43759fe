"""The session that is looked back at while it grows: as good as looked back at whole, and whole without it."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from carpus.core.model.errors import DiskFull, RecordingEmpty
from carpus.core.model.types import Detections, Frame, Region, TrackedFrame
from carpus.core.pipeline import measurement, smoothing
from carpus.core.pipeline.measurement import LivePipeline, RecordedSession
from carpus.core.pipeline.smoothing import CHUNK_S, SmoothingProcess, TrackedHand
from carpus.core.pipeline.track import (
    SMOOTHING_FAILED,
    FramePipeline,
)
from carpus.core.session.journal import RecordingJournal
from carpus.core.session.reader import read_outline, read_session
from carpus.core.session.values import Session
from carpus.core.tracking.filter.settings import TrackerSettings
from carpus.core.tracking.tracker import FilterSteps, Tracker
from tests.pipeline.live_fakes import wait_until
from tests.session.samples import make_header
from tests.tracking.hands import CAMERA, DT_S, Pose, blobs, calibration

FRAMES = 600
NO_PICTURE = np.zeros((1, 1, 3), np.uint8)


@pytest.fixture(autouse=True, scope="module")
def patience() -> Iterator[None]:
    """A loaded computer may take long to start a process; whether it is done in time is not what is tested."""
    with pytest.MonkeyPatch.context() as patient:
        patient.setattr(smoothing, "FINISH_TIMEOUT_S", 150.0)
        yield


@cache
def all_blobs() -> tuple[Detections, ...]:
    rng = np.random.default_rng(4)
    turns = 30.0 * np.sin(2.0 * np.pi * 0.4 * DT_S * np.arange(FRAMES))
    return tuple(blobs(Pose(np.array([0.0, turn, 0.0])), rng) for turn in turns)


class Blobs:
    """A detector that knows the blobs of every frame."""

    def detect(self, frame: Frame, _region: object = None) -> Detections:
        return all_blobs()[frame.index]

    def compute_search_region(self, *_: object) -> Region:
        return Region(0, 0, CAMERA.width_px, CAMERA.height_px)


def frames() -> Iterator[Frame]:
    for index in range(FRAMES):
        yield Frame(index, 10.0 + DT_S * index, NO_PICTURE, None, 1e-3)


def live_pipeline() -> LivePipeline:
    tracker = Tracker(calibration(), CAMERA, TrackerSettings())
    return LivePipeline(FramePipeline(Blobs(), tracker), neutral_ends_s=10.0)  # type: ignore[arg-type]


def open_session(path: Path, looker: SmoothingProcess | None) -> RecordedSession:
    return RecordedSession(RecordingJournal(path.with_suffix(".journal"), make_header(), CAMERA, calibration()), looker)


def begin_looking_back(piece_s: float = CHUNK_S) -> SmoothingProcess:
    return SmoothingProcess(TrackedHand(calibration(), CAMERA, TrackerSettings()), chunk_s=piece_s)


@cache
def walk_session() -> list[tuple[TrackedFrame, FilterSteps]]:
    """Every frame as tracked, and its steps."""
    pipeline, kept = live_pipeline(), list[FilterSteps]()
    pipeline.on_steps = kept.append
    return list(zip([pipeline(frame) for frame in frames()], kept, strict=True))


def record_session(
    path: Path, piece_s: float, at_row: Callable[[SmoothingProcess, int], None] = lambda *_: None
) -> None:
    """Records rows 30 to 559, pausing from 200 to 259; ``at_row`` is called before every frame."""
    looker = begin_looking_back(piece_s)
    session = open_session(path, looker)
    for row, (tracked, kept) in enumerate(walk_session()):
        at_row(looker, row)
        if row >= 30:
            looker.add_steps(kept)
        if 30 <= row < 560 and not 200 <= row < 260:
            session.append(tracked)
    session.close()


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Session:
    """Looked back at once, when all of it is there."""
    path = tmp_path_factory.mktemp("whole") / "whole.h5"
    record_session(path, 1e6)
    return read_session(path)


def test_smoothed_in_pieces_is_as_good_as_smoothed_whole(whole: Session, tmp_path: Path) -> None:
    def come(looker: SmoothingProcess, row: int) -> None:
        if row == 500:  # stored while rows still come
            wait_until(lambda: looker.has_results)

    record_session(tmp_path / "pieces.h5", CHUNK_S, come)
    pieces = read_session(tmp_path / "pieces.h5")
    assert len(pieces.smoothed.angles_rad) == len(pieces.timestamp_s) == 470
    sd_rad = whole.smoothed.angles_sd_rad
    # What differs is the palm's shape, slowly learnt: a piece knows less of it than the whole session.
    assert np.abs((pieces.smoothed.angles_rad - whole.smoothed.angles_rad) / sd_rad).max() < 0.25
    ratio = pieces.smoothed.angles_sd_rad / sd_rad
    assert ratio.min() > 0.95
    assert ratio.max() < 1.25, "less known, and so stated"


def test_killed_smoothing_leaves_the_tracked_session_complete(
    whole: Session, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    def kill(looker: SmoothingProcess, row: int) -> None:
        if row == 400:
            wait_until(lambda: looker.pid is not None)
            os.kill(looker.pid or 0, signal.SIGKILL)

    record_session(tmp_path / "killed.h5", CHUNK_S, kill)
    killed = read_session(tmp_path / "killed.h5")
    assert killed.smoothed is None
    np.testing.assert_array_equal(killed.motion.angles_rad, whole.motion.angles_rad)
    assert np.isfinite(killed.motion.angles_rad).all()
    (event,) = killed.events
    assert event.kind == SMOOTHING_FAILED
    assert "SIGKILL" in event.text
    (line,) = caplog.records
    assert "Smoothing of this session failed" in line.getMessage()
    assert "killed.h5" in line.getMessage()
    assert line.exc_info is None


def test_session_without_frame_is_none(tmp_path: Path) -> None:
    session = open_session(tmp_path / "empty.h5", begin_looking_back())
    with pytest.raises(RecordingEmpty):
        session.close()
    assert list(tmp_path.iterdir()) == []


def test_note_before_the_first_frame_is_stored_with_the_first_row(tmp_path: Path) -> None:
    pipeline, session = live_pipeline(), open_session(tmp_path / "early.h5", None)
    session.add_event(float("nan"), "note", "strap loose")
    rows = [pipeline(frame) for frame in list(frames())[:3]]
    for row in rows:
        session.append(row)
    session.add_event(rows[1].timestamp_s, "note", "elbow lifted")
    session.close()
    events = read_session(tmp_path / "early.h5").events
    assert [(event.time_s, event.kind, event.text) for event in events] == [
        (pytest.approx(rows[0].timestamp_s), "note", "strap loose"),
        (pytest.approx(rows[1].timestamp_s), "note", "elbow lifted"),
    ]


def test_recorded_session_full_disk_is_retried_at_end(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    tries: list[Path] = []

    def fill(*_: object) -> None:
        tries.append(tmp_path)
        raise DiskFull(tmp_path)

    monkeypatch.setattr(measurement, "ROWS_AT_ONCE", 5)
    recording = open_session(tmp_path / "session.h5", None)
    with monkeypatch.context() as full:
        full.setattr(measurement.SessionDraft, "read", fill)
        for row in range(20):
            recording.append(walk_session()[row][0])
    recording.close()
    assert len(tries) == 1
    assert read_outline(tmp_path / "session.h5").frames == 20
    assert [entry.name for entry in tmp_path.iterdir()] == ["session.h5"]
