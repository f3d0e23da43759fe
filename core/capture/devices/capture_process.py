"""The owner's side of a capture process."""

from __future__ import annotations

import threading
import time
from collections import deque
from multiprocessing.shared_memory import SharedMemory
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carpus.core.capture.devices.capture_child import (
    CaptureCommand,
    CaptureReport,
    DeviceOpened,
    FaultReport,
    ImageArrived,
    ReleaseSlot,
    ServeFunction,
    SharedSlotPool,
    Signal,
    run,
)
from carpus.core.capture.video_mode import Sensor, VideoMode
from carpus.core.model.errors import DriverFailed
from carpus.core.model.phrase import phrase
from carpus.core.platform.child_process import ChildProcess

SLOTS = 8
"""Slots for a recording, which waits for a free one."""
START_TIMEOUT_S = 30.0
"""A busy computer may take long to start a process; this is not the driver's fault."""
REPORT_TIMEOUT_S = 4.5
"""The process reports each second; silent for longer, it is stuck in the driver."""
STOP_TIMEOUT_S = 3.0
POLL_S = 0.1
"""How often a wait checks whether it is cancelled."""


class CaptureProcess:
    """Running capture process and the memory shared with it; to be called by one thread at a time."""

    def __init__(self, serve: ServeFunction, plan: object, subject: str, slot_bytes: int, slots: int = SLOTS) -> None:
        self._subject = subject
        self._memory = SharedMemory(create=True, size=slots * slot_bytes)
        self._slot_bytes = slot_bytes
        self._deferred_reports: deque[CaptureReport] = deque()
        self._closed = False
        pool = SharedSlotPool(self._memory.name, slots, slot_bytes)
        try:
            self._child = ChildProcess(run, serve, plan, pool, name="capture")
        except BaseException:
            self._release_memory()
            raise
        self._link = self._child.link

    @property
    def pid(self) -> int:
        return self._child.pid

    def receive_opened(self, closing: threading.Event, timeout_s: float) -> DeviceOpened | None:
        """Wait until the device is open; None if ``closing`` is set."""
        if self.receive_report(closing, START_TIMEOUT_S) is None:
            return None
        while (report := self.receive_report(closing, timeout_s)) is not None:
            if isinstance(report, DeviceOpened):
                return report
            if isinstance(report, ImageArrived):
                self.release_slot(report)  # came before its mode was known
        return None

    def receive_report(self, closing: threading.Event, timeout_s: float = REPORT_TIMEOUT_S) -> CaptureReport | None:
        """Wait for the next report; None if ``closing`` is set. Raises the fault that ended the process."""
        deadline = time.monotonic() + timeout_s
        while not closing.is_set():
            try:
                if self._deferred_reports or self._link.poll(POLL_S):
                    report: CaptureReport = (
                        self._deferred_reports.popleft() if self._deferred_reports else self._link.recv()
                    )
                    if isinstance(report, FaultReport):
                        raise report.fault(self._subject, report.detail)
                    return report
            except (EOFError, OSError) as cause:
                raise DriverFailed(self._subject, self._child.describe_exit()) from cause
            if time.monotonic() > deadline:
                raise DriverFailed(self._subject, phrase("no answer for {patience_s} s", patience_s=f"{timeout_s:g}"))
        return None

    def view_image(self, arrived: ImageArrived, mode: VideoMode) -> NDArray[Any]:
        """Return a view of the image in the pool buffer, valid until :meth:`release_slot`.

        Returns
        -------
        ndarray
            Colour (H, W, 3) uint8 or depth (H, W) uint16.
        """
        offset = arrived.slot * self._slot_bytes
        height, width = mode.height_px, mode.width_px
        if arrived.sensor == Sensor.COLOR:
            return np.ndarray((height, width, 3), np.uint8, self._memory.buf, offset)
        return np.ndarray((height, width), np.uint16, self._memory.buf, offset)

    def release_slot(self, arrived: ImageArrived) -> None:
        self.send_command(ReleaseSlot(arrived.slot))

    def send_command(self, command: CaptureCommand) -> None:
        """Send a command; a dead process is noticed by the next :meth:`receive_report`."""
        try:
            self._link.send(command)
        except OSError:
            return

    def close(self, *, gently: bool) -> None:
        """End the process; ``gently`` lets it release the camera. May be called twice."""
        if self._closed:
            return
        if gently:
            self.send_command(Signal.STOP)
            deadline = time.monotonic() + STOP_TIMEOUT_S
            while self._child.is_alive and time.monotonic() < deadline:
                self.discard_images()  # so that the process does not block on the pipe
                time.sleep(0.02)
        self._child.end()
        self._release_memory()

    def discard_images(self) -> None:
        """Discard the queued images, which are old; other reports are kept."""
        try:
            while self._link.poll(0):
                report: CaptureReport = self._link.recv()
                if isinstance(report, ImageArrived):
                    self.release_slot(report)
                else:
                    self._deferred_reports.append(report)
        except (EOFError, OSError):
            return  # the next receive_report raises the cause

    def _release_memory(self) -> None:
        self._closed = True
        self._memory.close()
        self._memory.unlink()
