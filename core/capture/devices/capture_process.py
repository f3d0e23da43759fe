"""The capture process: runs a camera's driver, so that a crash or a hang there does not affect Carpus.

One thread makes every call of the driver. A second one listens to the owner; when the owner is gone the process ends
at once, even from within a call. Images are copied once into a shared pool of slots and announced through the pipe;
all other messages go through the pipe.

The pool is bounded. A recording waits for a free slot, so nothing is lost. A camera does not wait: without a
free slot the image is dropped, which shows as a gap in the image numbers.
"""

from __future__ import annotations

import os
import queue
import threading
import time
from collections import deque
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from enum import Enum, auto
from multiprocessing.connection import Connection
from multiprocessing.shared_memory import SharedMemory
from typing import TYPE_CHECKING, Any

import numpy as np

from carpus.core.capture.source import Lens, Sensor, VideoMode
from carpus.core.model import errors
from carpus.core.model.errors import CarpusFault
from carpus.core.model.phrase import phrase
from carpus.core.model.types import Frame
from carpus.core.platform.child_process import ChildProcess, end_with_owner

if TYPE_CHECKING:
    from carpus.core.capture.frame_assembly import FrameAssembler  # OpenCV, which the process of an Xtion does not need

SIZE_PX, FPS = (640, 480), 30
"""Largest size of the images, and their rate."""


@dataclass(frozen=True, slots=True)
class CameraConfig:
    """Which camera to open and how.

    ``uri`` is an OpenNI2 address or a serial number, empty for any; ``serial`` that of a camera that was open before;
    ``models`` names by USB vendor and product; ``make_context`` makes the library's context in the capture process,
    None for the real bus.
    """

    uri: str = ""
    serial: str = ""
    models: Mapping[tuple[str, str], str] = field(default_factory=dict)
    make_context: Callable[[], Any] | None = None


@dataclass(frozen=True, slots=True)
class SharedSlotPool:
    """Shared memory of ``slots`` images of at most ``slot_bytes``."""

    name: str
    slots: int
    slot_bytes: int


class Signal(Enum):
    """Messages without content."""

    HEARTBEAT = auto()  # the process is up and not stuck in the driver
    ENDED = auto()  # the recording has ended, or the process was asked to stop
    LOCK_EXPOSURE = auto()  # command: lock exposure and white balance
    STOP = auto()  # command: close the device and end


@dataclass(frozen=True, slots=True)
class DeviceOpened:
    """Message: the device is open and streams ``modes``.

    ``settings`` goes into the session; ``mirrored`` names sensors. ``lens`` if the driver states it, else
    ``field_of_view_rad`` if known.
    """

    modes: Mapping[Sensor, VideoMode]
    settings: Mapping[str, str]
    lens: Lens | None = None
    depth_unit_m: float = 1e-3
    mirrored: frozenset[Sensor] = frozenset()
    field_of_view_rad: tuple[float, float] | None = None


@dataclass(frozen=True, slots=True)
class ImageArrived:
    """Message: an image is in ``slot`` until :class:`ReleaseSlot`; a missing ``number`` was dropped."""

    sensor: Sensor
    slot: int
    number: int
    timestamp_us: int


@dataclass(frozen=True, slots=True)
class ExposureLocked:
    """Message: exposure and white balance are locked, if the camera can."""

    is_locked: bool


@dataclass(frozen=True, slots=True)
class FaultReport:
    """Message: the process ends with this fault."""

    fault: type[CarpusFault]
    detail: str


@dataclass(frozen=True, slots=True)
class ReleaseSlot:
    """Command: the slot may be overwritten."""

    slot: int


CaptureReport = DeviceOpened | ImageArrived | ExposureLocked | FaultReport | Signal
CaptureCommand = ReleaseSlot | Signal


POLL_MS = 200
HEARTBEAT_S = 1.0
STREAM_TIMEOUT_S = 3.0
WARM_UP_S = 6.0
"""Time to the first image after opening."""


class CaptureChannel:
    """The driver's connection to the owner: publishes images and reports, receives commands.

    ``lock_exposure`` is called to lock exposure and white balance. It returns whether the camera can, or None if that
    is reported later.
    """

    def __init__(self, link: Connection, commands: queue.SimpleQueue[CaptureCommand], pool: SharedSlotPool) -> None:
        self._link = link
        self._commands = commands
        self._pool = pool
        self._memory = SharedMemory(pool.name)
        assert self._memory.buf is not None
        self._pixels = self._memory.buf
        self._free = list(reversed(range(pool.slots)))
        self._last_sent = time.monotonic()
        self._last_image_s: dict[Sensor, float] = {}
        self._retained: list[object] = []
        self.is_stopping = False
        self.lock_exposure: Callable[[], bool | None] = lambda: False

    @property
    def has_free_slot(self) -> bool:
        return bool(self._free)

    def retain(self, *objects: object) -> None:
        """Keep objects alive until the process ends, since the driver's threads may use them until then."""
        self._retained += objects

    def send(self, report: CaptureReport) -> None:
        self._link.send(report)
        self._last_sent = time.monotonic()

    def send_heartbeat(self) -> None:
        """Tell the owner once a second that the driver is not stuck."""
        if time.monotonic() - self._last_sent > HEARTBEAT_S:
            self.send(Signal.HEARTBEAT)

    def run(self, sensors: Iterable[Sensor], unplugged: threading.Event, forward_images: Callable[[], None]) -> None:
        """Run the loop of a camera, whose ``sensors`` must deliver images, until it is to stop.

        The driver's threads set ``unplugged``; ``forward_images`` waits briefly for images, notes and publishes them.
        """
        self._last_image_s = dict.fromkeys(sensors, time.monotonic() + WARM_UP_S - STREAM_TIMEOUT_S)
        while not self.is_stopping:
            self.handle_commands(block=False)
            if unplugged.is_set():
                raise errors.CameraLost("", phrase("unplugged"))
            forward_images()
            if time.monotonic() - min(self._last_image_s.values()) > STREAM_TIMEOUT_S:
                raise errors.CameraLost("", phrase("no frames for {seconds} s", seconds=f"{STREAM_TIMEOUT_S:g}"))
            self.send_heartbeat()

    def note_image(self, sensor: Sensor) -> None:
        """Note that a sensor delivers images, even if this one cannot be used."""
        self._last_image_s[sensor] = time.monotonic()

    def publish(self, sensor: Sensor, number: int, timestamp_us: int, image: memoryview) -> None:
        """Copy one image (contiguous bytes) and announce it; dropped if no slot is free or it is too large."""
        if self._free and image.nbytes <= self._pool.slot_bytes:
            slot = self._free.pop()  # the one freed last: what is never needed takes no memory
            start = slot * self._pool.slot_bytes
            self._pixels[start : start + image.nbytes] = image
            self.send(ImageArrived(sensor, slot, number, timestamp_us))

    def handle_commands(self, *, block: bool) -> None:
        """Carry out the owner's commands; with ``block`` wait briefly for one."""
        while True:
            try:
                command = self._commands.get(timeout=POLL_MS / 1000) if block else self._commands.get_nowait()
            except queue.Empty:
                return
            block = False
            if isinstance(command, ReleaseSlot):
                self._free.append(command.slot)
            elif command is Signal.LOCK_EXPOSURE:
                done = self.lock_exposure()
                if done is not None:
                    self.send(ExposureLocked(done))
            elif command is Signal.STOP:
                self.is_stopping = True


ServeFunction = Callable[[CaptureChannel, Any], None]
"""A driver's code: serves a camera until ``channel.is_stopping``; raises a :class:`CarpusFault` or DriverMissing."""


def run(link: Connection, serve: ServeFunction, plan: object, pool: SharedSlotPool) -> None:
    """Serve a camera until it ends, :attr:`Signal.STOP` comes, or the owner dies (entry point of the process)."""
    end_with_owner()
    commands: queue.SimpleQueue[CaptureCommand] = queue.SimpleQueue()
    threading.Thread(target=_receive_commands, args=(link, commands), name="commands", daemon=True).start()
    link.send(Signal.HEARTBEAT)
    report: CaptureReport = Signal.ENDED
    channel = CaptureChannel(link, commands, pool)
    try:
        serve(channel, plan)
    except CarpusFault as fault:
        report = FaultReport(type(fault), fault.detail)
    except (BrokenPipeError, ConnectionResetError):
        os._exit(0)
    try:
        link.send(report)
        link.close()
    finally:
        # threads of the driver still run; leaving without any clean-up is the one safe way out
        os._exit(0)


def _receive_commands(link: Connection, commands: queue.SimpleQueue[CaptureCommand]) -> None:
    with suppress(EOFError, OSError):
        while True:
            commands.put(link.recv())


# --- the owner's side ---
START_TIMEOUT_S = 30.0
"""A busy computer may take long to start a process; this is not the driver's fault."""
REPORT_TIMEOUT_S = 4.5
"""The process reports each second; silent for longer, it is stuck in the driver."""
STOP_TIMEOUT_S = 3.0
POLL_S = 0.1
"""How often a wait checks whether it is cancelled."""


class CaptureProcess:
    """Running capture process and the memory shared with it; to be called by one thread at a time."""

    def __init__(self, serve: ServeFunction, plan: object, subject: str, slot_bytes: int, slots: int) -> None:
        self._subject = subject
        self._memory = SharedMemory(create=True, size=slots * slot_bytes)
        self._slot_bytes = slot_bytes
        self._deferred_reports: deque[CaptureReport] = deque()
        self._modes: Mapping[Sensor, VideoMode] = {}
        self._closed = False
        pool = SharedSlotPool(self._memory.name, slots, slot_bytes)
        try:
            self._child = ChildProcess(run, serve, plan, pool, name="capture")
        except BaseException:
            self._release_memory()
            raise
        self._link = self._child.link

    def receive_opened(self, closing: threading.Event, timeout_s: float) -> DeviceOpened | None:
        """Wait until the device is open; None if ``closing`` is set."""
        if self.receive_report(closing, START_TIMEOUT_S) is None:
            return None
        while (report := self.receive_report(closing, timeout_s)) is not None:
            if isinstance(report, DeviceOpened):
                self._modes = report.modes
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
                raise errors.DriverFailed(self._subject, self._child.describe_exit()) from cause
            if time.monotonic() > deadline:
                silence = phrase("no answer for {patience_s} s", patience_s=f"{timeout_s:g}")
                raise errors.DriverFailed(self._subject, silence)
        return None

    def read_image(self, arrived: ImageArrived, assembler: FrameAssembler) -> list[Frame]:
        """Read an image out of its slot into the assembler, release the slot, return the frames that are complete."""
        mode, is_color = self._modes[arrived.sensor], arrived.sensor == Sensor.COLOR
        shape = (mode.height_px, mode.width_px, 3) if is_color else (mode.height_px, mode.width_px)
        place = arrived.slot * self._slot_bytes
        image = np.ndarray(shape, np.uint8 if is_color else np.uint16, self._memory.buf, place)
        frames = assembler.add(arrived.sensor, arrived.timestamp_us, arrived.number, image)
        self.release_slot(arrived)
        return frames

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
