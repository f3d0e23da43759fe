"""The capture process: owns a camera's driver, so that whatever kills or hangs it does not take Carpus along.

One thread makes every call of the driver. A second one only listens to the owner; when the owner is gone the process
ends at once, even from within a call. Pictures are copied once into a shared ring and announced through the
pipe, by which process and owner tell each other everything else.

Ring: bounded. A recording waits for a free slot, so nothing is lost. A camera does not wait: with no slot free the
picture is dropped, and its number is missing.
"""

from __future__ import annotations

import os
import queue
import threading
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from multiprocessing.connection import Connection
from multiprocessing.shared_memory import SharedMemory
from typing import Any

from carpus.core.capture.devices.usb_devices import UsbCamera
from carpus.core.capture.video_mode import Lens, Sensor, VideoMode
from carpus.core.model.errors import (
    CameraBusy,
    CameraLost,
    CameraMismatch,
    CameraMissing,
    CameraPermission,
    CarpusFault,
    DriverFailed,
    DriverMissing,
)
from carpus.core.platform.child_process import end_with_owner


@dataclass(frozen=True, slots=True)
class CameraConfig:
    """Open a live camera: the first, or the one with this serial number; ``models`` names what may be plugged in, by
    USB vendor and product; ``uri`` is OpenNI2's address of the one to open, empty for any.

    ``make_context`` makes the library's context in the capture process; None: the one of the real bus. A stand-in
    puts a
    software device of the library there, which is then found, opened and read like a camera.
    """

    serial: str = ""
    size_px: tuple[int, int] = (640, 480)
    fps: int = 30
    models: Mapping[tuple[str, str], str] = field(default_factory=dict)
    make_context: Callable[[], Any] | None = None
    uri: str = ""


@dataclass(frozen=True, slots=True)
class RingBuffer:
    """The shared memory: ``slots`` pictures of at most ``slot_bytes``."""

    name: str
    slots: int
    slot_bytes: int


@dataclass(frozen=True, slots=True)
class Heartbeat:
    """The process is up and not stuck in the driver."""


@dataclass(frozen=True, slots=True)
class DeviceOpened:
    """The device is open and its streams run; ``modes`` are those of the pictures that come through the ring.

    ``settings`` goes into the session; ``lens`` where the driver knows it, else perhaps the ``field_of_view_rad``.
    """

    modes: Mapping[Sensor, VideoMode]
    mirrored: Mapping[Sensor, bool]
    field_of_view_rad: tuple[float, float] | None
    settings: Mapping[str, str]
    lens: Lens | None = None
    depth_unit_m: float = 1e-3


@dataclass(frozen=True, slots=True)
class ImageArrived:
    """A picture lies in ``slot`` until :class:`ReleaseSlot` gives it back; a ``number`` that is missing was dropped."""

    sensor: Sensor
    slot: int
    number: int
    timestamp_us: int


@dataclass(frozen=True, slots=True)
class ExposureLocked:
    """Exposure and white balance are held from now on; ``is_locked`` whether the camera can."""

    is_locked: bool


@dataclass(frozen=True, slots=True)
class StreamEnded:
    """The recording is over, or the process was asked to stop."""


@dataclass(frozen=True, slots=True)
class FaultReport:
    """The process gives up; ``fault`` and ``detail`` say why."""

    fault: type[CarpusFault]
    detail: str


@dataclass(frozen=True, slots=True)
class ReleaseSlot:
    """To the process: ``slot`` may be written again."""

    slot: int


@dataclass(frozen=True, slots=True)
class LockExposure:
    """To the process: keep exposure and white balance as they are."""


@dataclass(frozen=True, slots=True)
class StopCapture:
    """To the process: close the device and end."""


CaptureReport = Heartbeat | DeviceOpened | ImageArrived | ExposureLocked | StreamEnded | FaultReport
CaptureCommand = ReleaseSlot | LockExposure | StopCapture


POLL_MS = 200
HEARTBEAT_S = 1.0
MAX_SILENCE_S = 3.0
WARM_UP_S = 6.0
"""Time to the first picture after opening."""


class CaptureFailed(Exception):
    """Ends the process with a fault for the owner."""

    def __init__(self, fault: type[CarpusFault], detail: str) -> None:
        super().__init__(detail)
        self.fault = fault
        self.detail = detail


class StreamWatchdog:
    """When each picture sensor of a camera was last heard: it may warm up, then none may fall silent."""

    def __init__(self, sensors: Iterable[Sensor]) -> None:
        self._last_s = dict.fromkeys(sensors, time.monotonic() + WARM_UP_S - MAX_SILENCE_S)

    def reset(self, sensor: Sensor) -> None:
        self._last_s[sensor] = time.monotonic()

    def check(self) -> None:
        """Raises :class:`CaptureFailed` where one has been silent for too long."""
        for sensor, last_s in self._last_s.items():
            if time.monotonic() - last_s > MAX_SILENCE_S:
                raise CaptureFailed(CameraLost, f"no {sensor.name.lower()} pictures for {MAX_SILENCE_S:g} s")


class CaptureOutlet:
    """What a driver's code in the capture process hands pictures and reports to, and hears commands from.

    ``lock_exposure`` is called when exposure and white balance are to stay as they are; it answers whether the camera
    can, or None where that is reported later.
    """

    def __init__(self, link: Connection, commands: queue.SimpleQueue[CaptureCommand], ring: RingBuffer) -> None:
        self._link = link
        self._commands = commands
        self._ring = ring
        self._memory = SharedMemory(ring.name)
        assert self._memory.buf is not None
        self._pixels = self._memory.buf
        self._free = list(reversed(range(ring.slots)))
        self._last_sent = time.monotonic()
        self._retained: list[object] = []
        self.is_stopping = False
        self.lock_exposure: Callable[[], bool | None] = lambda: False

    @property
    def has_free_slot(self) -> bool:
        """Whether the next picture finds a slot."""
        return bool(self._free)

    def retain(self, *objects: object) -> None:
        """A driver's threads call back and copy until the very end: what they use lives as long as the process."""
        self._retained += objects

    def send(self, report: CaptureReport) -> None:
        self._link.send(report)
        self._last_sent = time.monotonic()

    def send_heartbeat(self) -> None:
        """Tell the owner now and then that the driver is not stuck."""
        if time.monotonic() - self._last_sent > HEARTBEAT_S:
            self.send(Heartbeat())

    def run(
        self, sensors: Iterable[Sensor], unplugged: threading.Event, forward_images: Callable[[StreamWatchdog], None]
    ) -> None:
        """The loop of every camera, until it is to stop: ``forward_images`` waits a moment for pictures, hands on
        what came
        and notes which sensor was heard; ``unplugged`` is set by the driver's own threads when the camera was
        unplugged."""
        heard = StreamWatchdog(sensors)
        while not self.is_stopping:
            self.handle_commands(block=False)
            if unplugged.is_set():
                raise CaptureFailed(CameraLost, "unplugged")
            forward_images(heard)
            heard.check()
            self.send_heartbeat()

    def publish(self, sensor: Sensor, number: int, timestamp_us: int, image: memoryview) -> None:
        """Copy one picture (contiguous bytes) and announce it; dropped when no slot is free or it is too large."""
        if self._free and image.nbytes <= self._ring.slot_bytes:
            slot = self._free.pop()  # the one freed last: what is never needed takes no memory
            start = slot * self._ring.slot_bytes
            self._pixels[start : start + image.nbytes] = image
            self.send(ImageArrived(sensor, slot, number, timestamp_us))

    def handle_commands(self, *, block: bool) -> None:
        """Carry out what the owner asked for; with ``block`` wait a moment for it."""
        while True:
            try:
                command = self._commands.get(timeout=POLL_MS / 1000) if block else self._commands.get_nowait()
            except queue.Empty:
                return
            block = False
            if isinstance(command, ReleaseSlot):
                self._free.append(command.slot)
            elif isinstance(command, LockExposure):
                done = self.lock_exposure()
                if done is not None:
                    self.send(ExposureLocked(done))
            elif isinstance(command, StopCapture):
                self.is_stopping = True


ServeFunction = Callable[[CaptureOutlet, Any], None]
"""A driver's code: serves a plan until its end or ``outlet.is_stopping``; raises :class:`CaptureFailed` or
DriverMissing."""


def run(link: Connection, serve: ServeFunction, plan: object, ring: RingBuffer) -> None:
    """Entry of the process: serve ``plan`` until its end, a :class:`StopCapture`, or the death of the owner."""
    end_with_owner()
    commands: queue.SimpleQueue[CaptureCommand] = queue.SimpleQueue()
    threading.Thread(target=_receive_commands, args=(link, commands), name="commands", daemon=True).start()
    link.send(Heartbeat())
    report: CaptureReport = StreamEnded()
    outlet = CaptureOutlet(link, commands, ring)
    try:
        serve(outlet, plan)
    except CaptureFailed as failure:
        report = FaultReport(failure.fault, failure.detail)
    except DriverMissing as fault:
        report = FaultReport(DriverMissing, fault.detail)
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


_BUSY_WORDS = ("busy", "in use", "errno=16")
_PERMISSION_WORDS = ("permission", "access denied", "usb_status_access", "errno=13")


def camera_unlisted_error(connected: Sequence[UsbCamera], listed: Sequence[str] = ()) -> CaptureFailed:
    """Of the cameras ``connected`` on the bus the driver lists only ``listed`` (in words), and the wanted is not
    among them.

    The bus does not tell the serial numbers that drivers tell: a camera that is not listed may be the wanted one.
    """
    if len(connected) > len(listed):
        for camera in connected:
            if not camera.can_open:
                return CaptureFailed(CameraPermission, str(camera.node))
        for camera in connected:
            if camera.is_claimed:
                return CaptureFailed(CameraBusy, camera.name)
        return CaptureFailed(DriverFailed, f"{connected[0].name} is plugged in, but the driver does not see it")
    return CaptureFailed(CameraMismatch, ", ".join(listed)) if listed else CaptureFailed(CameraMissing, "")


def camera_open_error(reason: str, connected: Sequence[UsbCamera]) -> CaptureFailed:
    """The driver could not open a camera it lists, for this reason in its own words. Who holds it is no help here: the
    driver that failed may have taken it itself."""
    said = reason.lower()
    if any(word in said for word in _BUSY_WORDS):
        return CaptureFailed(CameraBusy, reason)
    locked = [str(camera.node) for camera in connected if not camera.can_open]
    if locked or any(word in said for word in _PERMISSION_WORDS):
        return CaptureFailed(CameraPermission, locked[0] if locked else reason)
    return CaptureFailed(DriverFailed, reason)
