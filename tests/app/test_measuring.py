"""The session that is smoothed while it grows: as good as smoothed whole, and it keeps no more than half a minute."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from app.desktop import measuring
from app.desktop.measuring import LiveWalk, SmoothedSession
from core.errors import RecordingEmpty
from core.pipeline.frame_walk import FrameWalk
from core.session.reader import read_session
from core.session.writer import SessionWriter
from core.tracking.settings import TrackerSettings
from core.tracking.tracker import Tracker
from core.types import Detections, Frame
from tests.session.samples import make_header
from tests.tracking.hands import CAMERA, DT_S, Pose, blobs, calibration

FRAMES = 600
NO_PICTURE = np.zeros((1, 1, 3), np.uint8)


class Blobs:
    """A detector that knows the blobs of every frame."""

    def __init__(self) -> None:
        rng = np.random.default_rng(4)
        turns = 30.0 * np.sin(2.0 * np.pi * 0.4 * DT_S * np.arange(FRAMES))
        self._blobs = [blobs(Pose(np.array([0.0, turn, 0.0])), rng) for turn in turns]

    def detect(self, frame: Frame, _region: object = None) -> Detections:
        return self._blobs[frame.index]

    def region_about(self, *_: object) -> object:
        return object()


def frames() -> Iterator[Frame]:
    for index in range(FRAMES):
        yield Frame(index, 10.0 + DT_S * index, NO_PICTURE, None, 1e-3)


def live_walk() -> LiveWalk:
    tracker = Tracker(calibration(), CAMERA, TrackerSettings())
    return LiveWalk(FrameWalk(Blobs(), tracker), neutral_ends_s=10.0)  # type: ignore[arg-type]


def open_session(path: Path, walk: LiveWalk | None) -> SmoothedSession:
    return SmoothedSession(SessionWriter.create(path, make_header(), CAMERA, calibration()), walk)


def recorded(path: Path, monkeypatch: pytest.MonkeyPatch, piece_s: float) -> int:
    """Records rows 30 to 559, pausing from 200 to 259; the largest number of steps that was kept."""
    monkeypatch.setattr(measuring, "SMOOTHING_PIECE_S", piece_s)
    walk, session, most = live_walk(), open_session(path, None), 0
    session.discard()
    session = open_session(path, walk)
    for frame in frames():
        if frame.index == 30:
            walk.keeping = True
        tracked = walk(frame)
        if 30 <= frame.index < 560 and not 200 <= frame.index < 260:
            session.append(tracked)
            for piece in session._pieces:
                piece.result()  # real time leaves it the time
        most = max(most, len(walk._walk.tracker.history))
    session.close()
    return most


def test_smoothed_in_pieces_is_as_good_as_smoothed_whole(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    whole_steps = recorded(tmp_path / "whole.h5", monkeypatch, 1e6)
    piece_steps = recorded(tmp_path / "pieces.h5", monkeypatch, 4.0)
    whole, pieces = read_session(tmp_path / "whole.h5"), read_session(tmp_path / "pieces.h5")
    assert whole.smoothed is not None
    assert pieces.smoothed is not None
    assert len(pieces.smoothed.angles_rad) == len(pieces.timestamp_s) == 470
    sd_rad = whole.smoothed.angles_sd_rad
    # What differs is the palm's shape, slowly learnt: four seconds know less of it than the whole session.
    assert np.abs((pieces.smoothed.angles_rad - whole.smoothed.angles_rad) / sd_rad).max() < 0.25
    ratio = pieces.smoothed.angles_sd_rad / sd_rad
    assert ratio.min() > 0.95
    assert ratio.max() < 1.25, "less known, and so stated; here with pieces much shorter than in use"
    assert whole_steps == 571
    assert piece_steps < (4.0 + 5.0 + 2.0) / DT_S + 61


def test_nothing_is_kept_while_nothing_is_recorded() -> None:
    walk = live_walk()
    for frame in frames():
        walk(frame)
    assert len(walk._walk.tracker.history) <= 1


def test_a_session_without_a_frame_is_none(tmp_path: Path) -> None:
    session = open_session(tmp_path / "empty.h5", live_walk())
    with pytest.raises(RecordingEmpty):
        session.close()
    assert list(tmp_path.iterdir()) == []


def test_a_note_from_before_the_first_picture_is_kept_with_the_first_row(tmp_path: Path) -> None:
    walk, session = live_walk(), open_session(tmp_path / "early.h5", None)
    session.add_event(float("nan"), "note", "strap loose")
    rows = [walk(frame) for frame in list(frames())[:3]]
    for row in rows:
        session.append(row)
    session.close()
    events = read_session(tmp_path / "early.h5").events
    assert [(event.time_s, event.kind, event.text) for event in events] == [
        (pytest.approx(rows[0].timestamp_s), "note", "strap loose")
    ]
