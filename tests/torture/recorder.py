"""A program that records until it is killed: the live engine with a real tracker, looking back, and raw pictures.

``python -m tests.torture.recorder FOLDER [--raw] [--played] [--jumping-clock] [--seconds N]``. It notes the time of
the newest frame that was tracked in ``FOLDER/taken`` before anything can be lost of it, until its recording is told to
end, and its children's numbers in ``FOLDER/children``.
"""

from __future__ import annotations

import argparse
import json
import multiprocessing
import os
import struct
import time
import uuid
from collections.abc import Callable, Iterator
from pathlib import Path
from threading import Event

import numpy as np

from carpus.core.capture.files.raw import RawWriter
from carpus.core.capture.playback_sources import PacedSource
from carpus.core.capture.source import FrameSource, SourceInfo
from carpus.core.model.types import Detections, Frame, Region, TrackedFrame
from carpus.core.pipeline.live import LiveSession
from carpus.core.pipeline.measurement import LivePipeline, RecordedSession
from carpus.core.pipeline.smoothing import SmoothingProcess, TrackedHand
from carpus.core.pipeline.track import FramePipeline
from carpus.core.session.journal import RecordingJournal
from carpus.core.tracking.filter.settings import TrackerSettings
from carpus.core.tracking.tracker import Tracker
from tests.capture.oni_samples import color_picture
from tests.capture.played import PlayedSource
from tests.pipeline.live_fakes import make_tracked_frame
from tests.session.samples import make_header
from tests.tracking.hands import CAMERA, DT_S, Pose, blobs, calibration

BLOBS = 300


class Blobs:
    """A detector that knows the blobs of every frame."""

    def __init__(self) -> None:
        rng = np.random.default_rng(4)
        turns = 30.0 * np.sin(2.0 * np.pi * 0.4 * DT_S * np.arange(BLOBS))
        self._blobs = [blobs(Pose(np.array([0.0, turn, 0.0])), rng) for turn in turns]

    def detect(self, frame: Frame, _region: object = None) -> Detections:
        return self._blobs[frame.index % BLOBS]

    def compute_search_region(self, *_: object) -> Region:
        return Region(0, 0, CAMERA.width_px, CAMERA.height_px)


class Camera:
    """30 pictures a second without end."""

    def __init__(self) -> None:
        self.info = SourceInfo("torture", CAMERA, False, None, 30.0)
        self._pictures = [np.tile(color_picture(number), (10, 10, 1)) for number in range(4)]
        self._closed = Event()

    def frames(self) -> Iterator[Frame]:
        index = 0
        while not self._closed.is_set():
            yield Frame(index, 10.0 + index / 30.0, self._pictures[index % 4], None, 1e-3)
            index += 1

    def close(self) -> None:
        self._closed.set()


def jumping_clock() -> None:
    """The computer's clock goes back and forth by hours, as nobody's does; the recording must not care."""
    real, began = time.time, time.monotonic()
    time.time = lambda: real() + 7200.0 * np.sign(np.sin(5.0 * (time.monotonic() - began)))  # type: ignore[method-assign]


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=Path)
    parser.add_argument("--raw", action="store_true")
    parser.add_argument("--played", action="store_true")
    parser.add_argument("--jumping-clock", action="store_true")
    parser.add_argument("--seconds", type=float, default=600.0)
    told = parser.parse_args()
    if told.jumping_clock:
        jumping_clock()
    source: FrameSource = PlayedSource(400) if told.played else Camera()
    live = LiveSession(PacedSource(source))
    taken = os.open(told.folder / "taken", os.O_RDWR | os.O_CREAT)
    looker = None if told.played else SmoothingProcess(TrackedHand(calibration(), CAMERA, TrackerSettings()))
    pipeline: Callable[[Frame], TrackedFrame] = make_tracked_frame
    if looker is not None:
        pipeline = FramePipeline(Blobs(), Tracker(calibration(), CAMERA, TrackerSettings()))  # type: ignore[arg-type]
        live_pipeline = LivePipeline(pipeline, 10.0)
        live_pipeline.on_steps = looker.add_steps
        pipeline = live_pipeline

    ending = Event()

    def noted(frame: Frame) -> TrackedFrame:
        row = pipeline(frame)
        if not ending.is_set():
            os.pwrite(taken, struct.pack("<dq", frame.timestamp_s, 1), 0)
        return row

    def open_session() -> RecordedSession:
        header = make_header(session_id=uuid.uuid4())
        return RecordedSession(RecordingJournal(told.folder / "s.journal", header, CAMERA, calibration()), looker)

    pictures = (lambda: RawWriter(told.folder / "s.carpusraw", source.info)) if told.raw else None
    live.start_tracking(noted)
    live.start_recording(open_session, pictures)
    live.start()
    while looker is not None and looker.pid is None:
        time.sleep(0.01)
    children = [child.pid for child in multiprocessing.active_children()]
    (told.folder / "children").write_text(json.dumps(children))
    while os.fstat(taken).st_size == 0:  # a kill before the first picture has nothing to lose
        time.sleep(0.01)
    print("begun", flush=True)
    end_s = time.monotonic() + told.seconds
    kinds: list[str] = []
    while time.monotonic() < end_s and "source_failed" not in kinds and "source_ended" not in kinds:
        kinds += [event.kind for event in live.drain_events()]
        time.sleep(0.02)
    ending.set()  # the camera goes on while the recording is stored
    live.stop_recording()
    live.stop()
    counters = live.counters()
    print(json.dumps({"kinds": kinds, "captured": counters.captured, "dropped": counters.dropped}), flush=True)


if __name__ == "__main__":
    main()
