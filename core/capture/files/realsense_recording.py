"""A RealSense recording (``.db3``) as a source of frames, played by the maker's library in a process of its own."""

from __future__ import annotations

import sqlite3
import threading
from collections.abc import Iterator, Mapping
from contextlib import closing
from dataclasses import replace
from pathlib import Path

from carpus.core.capture.devices.capture_child import DeviceOpened, ImageArrived, ServeFunction, StreamEnded
from carpus.core.capture.devices.capture_process import REPORT_TIMEOUT_S, CaptureProcess
from carpus.core.capture.devices.realsense import find_sensor, require_library, serve
from carpus.core.capture.frame_assembly import FILE_PAIRING_LIMIT, FrameAssembler, StreamLayout, camera_from_lens
from carpus.core.capture.source import SourceInfo
from carpus.core.capture.video_mode import Sensor, VideoMode
from carpus.core.model.errors import RecordingDamaged
from carpus.core.model.types import Frame

MAX_IMAGE_BYTES = 1920 * 1080 * 3
SLOTS = 4
OPEN_TIMEOUT_S = 20.0
"""A long recording is indexed before its first image comes."""


class FilePlayer:
    """Player of a file in a capture process; at most :data:`SLOTS` images wait.

    :meth:`open` starts a process and ends the one before; :meth:`frames` then plays it once.
    """

    def __init__(self, serve: ServeFunction, path: Path, slot_bytes: int) -> None:
        self._serve, self._path, self._slot_bytes = serve, path, slot_bytes
        self._closing = threading.Event()
        self._lock = threading.Lock()
        self._process: CaptureProcess | None = None

    def open(self, plan: object, timeout_s: float) -> DeviceOpened | None:
        """Open the file in a new process; None if closed meanwhile. Raises the fault that ended the process."""
        self._stop()
        if self._closing.is_set():
            return None
        process = CaptureProcess(self._serve, plan, str(self._path), self._slot_bytes, SLOTS)
        self._process = process
        try:
            with self._lock:
                opened = process.receive_opened(self._closing, timeout_s)
        except BaseException:
            self._stop()
            raise
        if opened is None:
            self._stop()  # closed while the process was being made: that close did not see it
        return opened

    def frames(self, assembler: FrameAssembler, modes: Mapping[Sensor, VideoMode]) -> Iterator[Frame]:
        """Yield the frames of the file opened last, until it is opened again or :meth:`close`."""
        process = self._process
        if process is None:
            return
        try:
            while True:
                with self._lock:
                    if process is not self._process:
                        return
                    report = process.receive_report(self._closing, REPORT_TIMEOUT_S)
                    if report is None:
                        return
                    frames: list[Frame] = []
                    if isinstance(report, ImageArrived):
                        take = assembler.add_color if report.sensor == Sensor.COLOR else assembler.add_depth
                        pixels = process.view_image(report, modes[report.sensor])
                        frames = take(report.timestamp_us, report.number, pixels)
                        process.release_slot(report)
                if isinstance(report, StreamEnded):
                    yield from assembler.finish()
                    return
                yield from frames
        finally:
            with self._lock:
                process.close(gently=False)

    def close(self) -> None:
        """End playback; may be called twice, and while another thread waits for a frame."""
        self._closing.set()
        self._stop()

    def _stop(self) -> None:
        with self._lock:
            if self._process is not None:
                self._process.close(gently=False)
                self._process = None


class RealSenseRecording:
    """Frames of a recording, in order, as fast as they are read; depth is registered to colour.

    Opening it plays up to the first image. :meth:`frames` may be repeated, one pass at a time.

    Raises
    ------
    ExtraMissing
        The library is not installed.
    RecordingDamaged, RecordingUnsupported
        The file cannot be played.
    """

    def __init__(self, path: Path) -> None:
        require_library()
        self._path = path
        self._count = count_color_frames(path)
        self._player = FilePlayer(serve, path, MAX_IMAGE_BYTES)
        opened = self._opened = self._open()
        assert opened is not None
        self._info = self._build_info(opened)

    @property
    def info(self) -> SourceInfo:
        return self._info

    def frames(self) -> Iterator[Frame]:
        """Yield all frames from the first on; a pass in progress ends when another begins."""
        opened, self._opened = self._opened or self._open(), None
        if opened is None:
            return
        color = opened.modes[Sensor.COLOR]
        size_px = color.width_px, color.height_px
        layout = StreamLayout(
            size_px, size_px if Sensor.DEPTH in opened.modes else None, depth_unit_m=opened.depth_unit_m
        )
        yield from self._player.frames(FrameAssembler(layout, 1e6 / color.fps, FILE_PAIRING_LIMIT), opened.modes)

    def close(self) -> None:
        """End playback; may be called twice, and while another thread waits for a frame."""
        self._opened = None
        self._player.close()

    def _open(self) -> DeviceOpened | None:
        return self._player.open(self._path.resolve(), OPEN_TIMEOUT_S)

    def _build_info(self, opened: DeviceOpened) -> SourceInfo:
        color = opened.modes[Sensor.COLOR]
        assert opened.lens is not None
        camera = camera_from_lens((color.width_px, color.height_px), opened.lens)
        sensor = find_sensor(opened.settings, camera.fx_px)
        settings = {"format": "RealSense .db3", **opened.settings}
        has_depth = Sensor.DEPTH in opened.modes
        return SourceInfo(
            self._path.name, replace(camera, sensor=sensor), has_depth, self._count, float(color.fps), settings
        )


def count_color_frames(path: Path) -> int | None:
    """Return the number of colour images of a ``.db3``; None if unknown. Raises :class:`RecordingDamaged`.

    The library takes any file for an empty recording or waits on it for ever; a file that is no database is found here.
    """
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
