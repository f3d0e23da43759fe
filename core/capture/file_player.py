"""A recording played by its maker's library in the capture process, one walk at a time."""

from __future__ import annotations

import threading
from collections import Counter
from collections.abc import Generator, Mapping
from pathlib import Path

from carpus.core.capture.capture_link import ANSWER_S, SLOTS, CaptureProcess
from carpus.core.capture.capture_messages import Arrived, Ended, Opened
from carpus.core.capture.capture_process import Serve
from carpus.core.capture.frame_assembly import Assembler
from carpus.core.capture.video_mode import Sensor, VideoMode
from carpus.core.types import Frame

WAITING_PICTURES = 64
"""How far apart in the file colour and depth of one moment may lie."""


class FilePlayer:
    """Plays ``path`` by ``serve``; pictures have at most ``slot_bytes``, ``slots`` of them wait.

    :meth:`open` starts a process and ends the one before; :meth:`frames` then walks through its pictures once.
    """

    def __init__(self, serve: Serve, path: Path, slot_bytes: int, slots: int = SLOTS) -> None:
        self._serve, self._path, self._slot_bytes, self._slots = serve, path, slot_bytes, slots
        self._closing = threading.Event()
        self._lock = threading.Lock()
        self._process: CaptureProcess | None = None
        self.arrived: Counter[Sensor] = Counter()

    def open(self, plan: object, open_s: float) -> Opened | None:
        """What the library found in the file, at most ``open_s`` after the process is up; None when closed meanwhile.
        Raises the fault that ended the process."""
        self.stop()
        if self._closing.is_set():
            return None
        process = CaptureProcess(self._serve, plan, str(self._path), self._slot_bytes, self._slots)
        self._process = process
        self.arrived = Counter()
        try:
            with self._lock:
                opened = process.wait_open(self._closing, open_s)
        except BaseException:
            self.stop()
            raise
        if opened is None:
            self.stop()  # closed while the process was being made: that close did not see it
        return opened

    def frames(self, assembler: Assembler, modes: Mapping[Sensor, VideoMode]) -> Generator[Frame, None, bool]:
        """Frames of what was opened last; at the end whether all of the file was walked through. ``arrived`` counts
        pictures. A walk ends early when another file, or the same once more, is opened, or at :meth:`close`."""
        process = self._process
        if process is None:
            return False
        try:
            while True:
                with self._lock:
                    if process is not self._process:
                        return False
                    report = process.report(self._closing, ANSWER_S)
                    if report is None:
                        return False
                    frames: list[Frame] = []
                    if isinstance(report, Arrived):
                        self.arrived[report.sensor] += 1
                        take = assembler.color if report.sensor == Sensor.COLOR else assembler.depth
                        pixels = process.pixels(report, modes[report.sensor])
                        frames = take(report.timestamp_us, report.number, pixels)
                        process.free(report)
                if isinstance(report, Ended):
                    yield from assembler.finish()
                    return True
                yield from frames
        finally:
            with self._lock:
                process.close(gently=False)

    def close(self) -> None:
        """End playback; may be called twice, and while another thread waits for a frame."""
        self._closing.set()
        self.stop()

    def stop(self) -> None:
        """End the process that runs, and with it a walk under way; another may be opened."""
        with self._lock:
            if self._process is not None:
                self._process.close(gently=False)
                self._process = None
