"""A RealSense recording (``.db3``, older ones ``.bag``) as a source of frames, played by the maker's library in a
process of its own."""

from __future__ import annotations

import sqlite3
import threading
from collections.abc import Iterator
from contextlib import closing
from dataclasses import replace
from pathlib import Path

from carpus.core.capture.capture_link import ANSWER_S, CaptureProcess
from carpus.core.capture.capture_messages import Arrived, Ended, Opened
from carpus.core.capture.frame_assembly import Assembler, Layout, camera_of_lens
from carpus.core.capture.realsense import require_library, sensor_named
from carpus.core.capture.realsense_plans import FilePlan
from carpus.core.capture.realsense_process import serve
from carpus.core.capture.source import SourceInfo
from carpus.core.capture.video_mode import Sensor
from carpus.core.errors import RecordingDamaged
from carpus.core.types import Frame

LARGEST_BYTES = 1920 * 1080 * 3
SLOTS = 4
OPEN_S = 20.0
"""A long recording is indexed before its first picture comes."""
WAITING_PICTURES = 64
"""How far apart in the file colour and depth of one moment may lie."""


class RealSenseRecording:
    """Frames of a recording, all of them, in order, as fast as they are read; depth is laid on colour.

    Opening it plays up to the first picture. :meth:`frames` may be repeated, one walk at a time. Raises
    :class:`ExtraMissing` without the library, :class:`RecordingDamaged` or :class:`RecordingUnsupported`.
    """

    def __init__(self, path: Path) -> None:
        require_library()
        self._path = path
        self._closing = threading.Event()
        self._lock = threading.Lock()
        self._count = color_count(path)
        self._process: CaptureProcess | None = None
        self._ready: tuple[CaptureProcess, Opened] | None = None
        opened = self._open()
        assert opened is not None
        self._info = self._describe(opened)

    @property
    def info(self) -> SourceInfo:
        """Facts about the recording."""
        return self._info

    def frames(self) -> Iterator[Frame]:
        """All frames from the first on; a walk under way ends when another begins."""
        if self._ready is None and self._open() is None:
            return
        assert self._ready is not None
        (process, opened), self._ready = self._ready, None
        try:
            yield from self._play(process, opened)
        finally:
            with self._lock:
                process.close(gently=False)

    def close(self) -> None:
        """End playback; may be called twice, and while another thread waits for a frame."""
        self._closing.set()
        self._end()

    def _open(self) -> Opened | None:
        """Start the process anew; None when closed meanwhile."""
        self._end()
        if self._closing.is_set():
            return None
        plan = FilePlan(str(self._path.resolve()))
        process = CaptureProcess(serve, plan, str(self._path), LARGEST_BYTES, SLOTS)
        self._process = process
        try:
            with self._lock:
                opened = process.wait_open(self._closing, OPEN_S)
        except BaseException:
            self._end()
            raise
        if opened is not None:
            self._ready = process, opened
        return opened

    def _end(self) -> None:
        with self._lock:
            if self._process is not None:
                self._process.close(gently=False)
            self._process = self._ready = None

    def _play(self, process: CaptureProcess, opened: Opened) -> Iterator[Frame]:
        size = opened.modes[Sensor.COLOR].width_px, opened.modes[Sensor.COLOR].height_px
        layout = Layout(size, size if Sensor.DEPTH in opened.modes else None, depth_unit_m=opened.depth_unit_m)
        assembler = Assembler(layout, 1e6 / opened.modes[Sensor.COLOR].fps, WAITING_PICTURES)
        while True:
            with self._lock:
                if process is not self._process:
                    return
                report = process.report(self._closing, ANSWER_S)
                if report is None:
                    return
                frames: list[Frame] = []
                if isinstance(report, Arrived):
                    take = assembler.color if report.sensor == Sensor.COLOR else assembler.depth
                    pixels = process.pixels(report, opened.modes[report.sensor])
                    frames = take(report.timestamp_us, report.number, pixels)
                    process.free(report)
            if isinstance(report, Ended):
                yield from assembler.finish()
                return
            yield from frames

    def _describe(self, opened: Opened) -> SourceInfo:
        color = opened.modes[Sensor.COLOR]
        assert opened.lens is not None
        camera = camera_of_lens((color.width_px, color.height_px), opened.lens)
        sensor = sensor_named(opened.settings, camera.fx_px)
        settings = {"format": f"RealSense {self._path.suffix.lower()}", **opened.settings}
        has_depth = Sensor.DEPTH in opened.modes
        return SourceInfo(
            self._path.name, replace(camera, sensor=sensor), has_depth, self._count, float(color.fps), settings
        )


def color_count(path: Path) -> int | None:
    """How many colour pictures a ``.db3`` holds; None of another file. Raises :class:`RecordingDamaged`.

    The library takes any file for empty or waits on it for ever; what is no database is told here.
    """
    if path.suffix.lower() != ".db3":
        return None
    try:
        with closing(sqlite3.connect(f"{path.resolve().as_uri()}?mode=ro", uri=True)) as base:
            query = (
                "SELECT count(*) FROM messages JOIN topics ON topics.id = topic_id "
                "WHERE topics.name LIKE '%/Color_0/image/metadata'"
            )
            (count,) = base.execute(query).fetchone()
    except sqlite3.Error as cause:
        raise RecordingDamaged(path, str(cause)) from cause
    return int(count) or None
