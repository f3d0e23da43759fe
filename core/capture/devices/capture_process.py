"""The owner's end of a capture process: starts it, listens to it, ends it."""

from __future__ import annotations

import threading
import time
from collections import deque
from multiprocessing.shared_memory import SharedMemory
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carpus.core.capture.devices.capture_child import (
    Arrived,
    Command,
    Free,
    Opened,
    Report,
    Ring,
    Serve,
    Stop,
    Trouble,
    run,
)
from carpus.core.capture.video_mode import Sensor, VideoMode
from carpus.core.child_process import ChildProcess
from carpus.core.errors import DriverFailed
from carpus.core.phrase import phrase

SLOTS = 8
"""Pictures of a recording, which waits."""
START_S = 30.0
"""A loaded computer may take long to start a process; this is not the driver's fault."""
ANSWER_S = 4.5
"""The process reports each second; silent for longer, it is stuck in the driver."""
STOP_S = 3.0
LOOK_S = 0.1
"""How often a wait looks whether it is still wanted."""


class CaptureProcess:
    """A running capture process, in which ``serve`` carries out ``plan``, and the memory it shares.

    One thread at a time calls it.
    """

    def __init__(self, serve: Serve, plan: object, subject: str, slot_bytes: int, slots: int = SLOTS) -> None:
        self._subject = subject
        self._memory = SharedMemory(create=True, size=slots * slot_bytes)
        self._slot_bytes = slot_bytes
        self._kept: deque[Report] = deque()
        self._closed = False
        ring = Ring(self._memory.name, slots, slot_bytes)
        try:
            self._child = ChildProcess(run, serve, plan, ring, name="capture")
        except BaseException:
            self._release()
            raise
        self._link = self._child.link

    @property
    def pid(self) -> int:
        return self._child.pid

    def wait_open(self, closing: threading.Event, open_s: float) -> Opened | None:
        """What was opened, at most ``open_s`` after the process is up; None when ``closing``."""
        if self.report(closing, START_S) is None:
            return None
        while (report := self.report(closing, open_s)) is not None:
            if isinstance(report, Opened):
                return report
            if isinstance(report, Arrived):
                self.free(report)  # came before its mode was known
        return None

    def report(self, closing: threading.Event, patience_s: float = ANSWER_S) -> Report | None:
        """The next report; None when ``closing``. Raises the fault that ended the process."""
        deadline = time.monotonic() + patience_s
        while not closing.is_set():
            try:
                if self._kept or self._link.poll(LOOK_S):
                    report: Report = self._kept.popleft() if self._kept else self._link.recv()
                    if isinstance(report, Trouble):
                        raise report.fault(self._subject, report.detail)
                    return report
            except (EOFError, OSError) as cause:
                raise DriverFailed(self._subject, self._child.describe_death()) from cause
            if time.monotonic() > deadline:
                raise DriverFailed(self._subject, phrase("no answer for {patience_s} s", patience_s=f"{patience_s:g}"))
        return None

    def pixels(self, arrived: Arrived, mode: VideoMode) -> NDArray[Any]:
        """The picture in the ring, a view that lives until :meth:`free`: (H, W, 3) uint8 or (H, W) uint16."""
        offset = arrived.slot * self._slot_bytes
        height, width = mode.height_px, mode.width_px
        if arrived.sensor == Sensor.COLOR:
            return np.ndarray((height, width, 3), np.uint8, self._memory.buf, offset)
        return np.ndarray((height, width), np.uint16, self._memory.buf, offset)

    def free(self, arrived: Arrived) -> None:
        self.tell(Free(arrived.slot))

    def tell(self, command: Command) -> None:
        """Pass a command on; a dead process is noticed by the next :meth:`report`."""
        try:
            self._link.send(command)
        except OSError:
            return

    def close(self, *, gently: bool) -> None:
        """End the process, ``gently`` so that a camera is given back; may be called twice."""
        if self._closed:
            return
        if gently:
            self.tell(Stop())
            deadline = time.monotonic() + STOP_S
            while self._child.is_alive and time.monotonic() < deadline:
                self._drain()
                time.sleep(0.02)
        self._child.end()
        self._release()

    def discard(self) -> None:
        """Forget the pictures that wait: they are old. Other reports are kept."""
        try:
            while self._link.poll(0):
                report: Report = self._link.recv()
                if isinstance(report, Arrived):
                    self.free(report)
                else:
                    self._kept.append(report)
        except (EOFError, OSError):
            return  # the next look for a report tells why

    def _drain(self) -> None:
        """Read on, so that the process is not stuck in a full pipe."""
        try:
            while self._link.poll(0):
                self._link.recv()
        except (EOFError, OSError):
            return

    def _release(self) -> None:
        self._closed = True
        self._memory.close()
        self._memory.unlink()
