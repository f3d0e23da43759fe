"""A RealSense recording (``.db3``) as a source of frames, played by the maker's library in a process of its own."""

from __future__ import annotations

import sqlite3
import threading
from collections.abc import Iterator
from contextlib import closing
from dataclasses import replace
from pathlib import Path

from carpus.core.capture.devices.cameras import require_package
from carpus.core.capture.devices.capture_process import CaptureProcess, DeviceOpened, ImageArrived, Signal
from carpus.core.capture.devices.process_camera import build_layout
from carpus.core.capture.devices.realsense import PACKAGE, find_sensor, serve
from carpus.core.capture.frame_assembly import FILE_PAIRING_LIMIT, FrameAssembler, camera_from_lens
from carpus.core.capture.source import Sensor, SourceInfo
from carpus.core.model.errors import RecordingDamaged
from carpus.core.model.types import Frame

MAX_IMAGE_BYTES = 1920 * 1080 * 3
SLOTS = 4
OPEN_TIMEOUT_S = 20.0
"""A long recording is indexed before its first image comes."""


class RealSenseRecording:
    """Frames of a recording, in order, as fast as they are read; depth is registered to colour.

    Opening it plays up to the first image; at most :data:`SLOTS` images wait. :meth:`frames` may be repeated, one pass
    at a time.

    Raises
    ------
    ExtraMissing
        The library is not installed.
    RecordingDamaged, RecordingUnsupported
        The file cannot be played.
    """

    def __init__(self, path: Path) -> None:
        require_package(PACKAGE)
        self._path = path
        self._closing, self._lock = threading.Event(), threading.Lock()
        self._process: CaptureProcess | None = None
        count = count_color_frames(path)
        opened = self._opened = self._open()
        assert opened is not None
        assert opened.lens is not None
        color = opened.modes[Sensor.COLOR]
        camera = camera_from_lens((color.width_px, color.height_px), opened.lens)
        camera = replace(camera, sensor=find_sensor(opened.settings, camera.fx_px))
        settings = {"format": "RealSense .db3", **opened.settings}
        self.info = SourceInfo(path.name, camera, Sensor.DEPTH in opened.modes, count, float(color.fps), settings)

    def frames(self) -> Iterator[Frame]:
        """Yield all frames from the first on; a pass in progress ends when another begins."""
        opened, self._opened = self._opened or self._open(), None
        process = self._process
        if opened is None or process is None:
            return
        assembler = FrameAssembler(build_layout(opened), 1e6 / opened.modes[Sensor.COLOR].fps, FILE_PAIRING_LIMIT)
        try:
            while True:
                with self._lock:
                    if process is not self._process:
                        return
                    report = process.receive_report(self._closing)
                    if report is None:
                        return
                    frames = process.read_image(report, assembler) if isinstance(report, ImageArrived) else []
                if report is Signal.ENDED:
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

    def _open(self) -> DeviceOpened | None:
        """Open the file in a new process and end the one before; None if closed meanwhile."""
        self._stop()
        if self._closing.is_set():
            return None
        process = self._process = CaptureProcess(serve, self._path.resolve(), str(self._path), MAX_IMAGE_BYTES, SLOTS)
        opened: DeviceOpened | None = None
        try:
            with self._lock:
                opened = process.receive_opened(self._closing, OPEN_TIMEOUT_S)
        finally:
            if opened is None:
                self._stop()  # a close while the process was being made did not see it
        return opened

    def _stop(self) -> None:
        with self._lock:
            if self._process is not None:
                self._process.close(gently=False)
                self._process = None


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
