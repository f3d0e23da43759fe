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
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from enum import Enum, auto
from multiprocessing.connection import Connection
from multiprocessing.shared_memory import SharedMemory
from typing import Any

from carpus.core.capture.devices.usb_devices import UsbCamera
from carpus.core.capture.video_mode import Lens, Sensor, VideoMode
from carpus.core.model import errors
from carpus.core.model.errors import CarpusFault
from carpus.core.model.phrase import phrase
from carpus.core.platform.child_process import end_with_owner

SIZE_PX, FPS = (640, 480), 30
"""Largest size of the images, and their rate."""


@dataclass(frozen=True, slots=True)
class CameraConfig:
    """Which camera to open and how.

    Attributes
    ----------
    uri : str
        OpenNI2 address, or serial number; empty for any.
    serial : str
        Serial number of a camera that was open before, else empty.
    models : mapping
        Name by USB vendor and product.
    make_context : callable, optional
        Makes the library's context in the capture process; None for the real bus.
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


class StreamWatchdog:
    """Fails if a sensor stops delivering images after its warm-up."""

    def __init__(self, sensors: Iterable[Sensor]) -> None:
        self._last_s = dict.fromkeys(sensors, time.monotonic() + WARM_UP_S - STREAM_TIMEOUT_S)

    def reset(self, sensor: Sensor) -> None:
        self._last_s[sensor] = time.monotonic()

    def check(self) -> None:
        """Raise a :class:`CarpusFault` if a sensor has been silent for too long."""
        for last_s in self._last_s.values():
            if time.monotonic() - last_s > STREAM_TIMEOUT_S:
                raise errors.CameraLost("", phrase("no frames for {seconds} s", seconds=f"{STREAM_TIMEOUT_S:g}"))


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

    def run(
        self, sensors: Iterable[Sensor], unplugged: threading.Event, forward_images: Callable[[StreamWatchdog], None]
    ) -> None:
        """Run the loop of a camera until it is to stop.

        Parameters
        ----------
        sensors : iterable of Sensor
            Sensors that must deliver images.
        unplugged : threading.Event
            Set by the driver's threads when the camera was unplugged.
        forward_images : callable
            Waits briefly for images, publishes them and resets the watchdog of their sensor.
        """
        watchdog = StreamWatchdog(sensors)
        while not self.is_stopping:
            self.handle_commands(block=False)
            if unplugged.is_set():
                raise errors.CameraLost("", phrase("unplugged"))
            forward_images(watchdog)
            watchdog.check()
            self.send_heartbeat()

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


_BUSY_WORDS = ("busy", "in use", "errno=16")
_PERMISSION_WORDS = ("permission", "access denied", "usb_status_access", "errno=13")


def camera_unlisted_error(connected: Sequence[UsbCamera], listed: Sequence[str] = ()) -> CarpusFault:
    """Return why the driver does not list the wanted camera.

    The bus does not state the serial numbers that drivers do: an unlisted camera may be the wanted one.

    Parameters
    ----------
    connected : sequence of UsbCamera
        Cameras on the bus.
    listed : sequence of str
        Cameras that the driver lists.
    """
    if len(connected) > len(listed):
        for camera in connected:
            if not camera.can_open:
                return errors.CameraPermission("", str(camera.node))
        for camera in connected:
            if camera.is_claimed:
                return errors.CameraBusy("", camera.name)
        name = connected[0].name
        return errors.DriverFailed("", phrase("{name} is plugged in, but the driver does not see it", name=name))
    return errors.CameraMismatch("", ", ".join(listed)) if listed else errors.CameraMissing("", "")


def camera_open_error(reason: str, connected: Sequence[UsbCamera]) -> CarpusFault:
    """Return why the driver could not open a listed camera, from its own error message.

    Which driver claims the camera is no help: the driver that failed may have claimed it itself.
    """
    text = reason.lower()
    if any(word in text for word in _BUSY_WORDS):
        return errors.CameraBusy("", reason)
    locked = [str(camera.node) for camera in connected if not camera.can_open]
    if locked or any(word in text for word in _PERMISSION_WORDS):
        return errors.CameraPermission("", locked[0] if locked else reason)
    return errors.DriverFailed("", reason)
