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
from carpus.core.child_process import end_with_owner
from carpus.core.errors import (
    CameraBusy,
    CameraLost,
    CameraMissing,
    CameraPermission,
    CarpusFault,
    DriverFailed,
    DriverMissing,
    OtherCamera,
)


@dataclass(frozen=True, slots=True)
class CameraPlan:
    """Open a live camera: the first, or the one with this serial number; ``models`` names what may be plugged in, by
    USB vendor and product; ``uri`` is OpenNI2's address of the one to open, empty for any.

    ``context`` makes the library's context in the capture process; None: the one of the real bus. A stand-in puts a
    software device of the library there, which is then found, opened and read like a camera.
    """

    serial: str = ""
    size_px: tuple[int, int] = (640, 480)
    fps: int = 30
    models: Mapping[tuple[str, str], str] = field(default_factory=dict)
    context: Callable[[], Any] | None = None
    uri: str = ""


@dataclass(frozen=True, slots=True)
class Ring:
    """The shared memory: ``slots`` pictures of at most ``slot_bytes``."""

    name: str
    slots: int
    slot_bytes: int


@dataclass(frozen=True, slots=True)
class Alive:
    """The process is up and not stuck in the driver."""


@dataclass(frozen=True, slots=True)
class Opened:
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
class Arrived:
    """A picture lies in ``slot`` until :class:`Free` gives it back; a ``number`` that is missing was dropped."""

    sensor: Sensor
    slot: int
    number: int
    timestamp_us: int


@dataclass(frozen=True, slots=True)
class ExposureSet:
    """Exposure and white balance are held from now on; ``done`` whether the camera can."""

    done: bool


@dataclass(frozen=True, slots=True)
class Ended:
    """The recording is over, or the process was asked to stop."""


@dataclass(frozen=True, slots=True)
class Trouble:
    """The process gives up; ``fault`` and ``detail`` say why."""

    fault: type[CarpusFault]
    detail: str


@dataclass(frozen=True, slots=True)
class Free:
    """To the process: ``slot`` may be written again."""

    slot: int


@dataclass(frozen=True, slots=True)
class LockExposure:
    """To the process: keep exposure and white balance as they are."""


@dataclass(frozen=True, slots=True)
class Stop:
    """To the process: close the device and end."""


Report = Alive | Opened | Arrived | ExposureSet | Ended | Trouble
Command = Free | LockExposure | Stop


WAIT_MS = 200
ALIVE_EVERY_S = 1.0
CAMERA_SILENCE_S = 3.0
CAMERA_WARM_UP_S = 6.0
"""Time to the first picture after opening."""


class GaveUp(Exception):
    """Ends the process with a fault for the owner."""

    def __init__(self, fault: type[CarpusFault], detail: str) -> None:
        super().__init__(detail)
        self.fault = fault
        self.detail = detail


class Heard:
    """When each picture sensor of a camera was last heard: it may warm up, then none may fall silent."""

    def __init__(self, sensors: Iterable[Sensor]) -> None:
        self._last_s = dict.fromkeys(sensors, time.monotonic() + CAMERA_WARM_UP_S - CAMERA_SILENCE_S)

    def picture_of(self, sensor: Sensor) -> None:
        self._last_s[sensor] = time.monotonic()

    def check(self) -> None:
        """Raises :class:`GaveUp` where one has been silent for too long."""
        for sensor, last_s in self._last_s.items():
            if time.monotonic() - last_s > CAMERA_SILENCE_S:
                raise GaveUp(CameraLost, f"no {sensor.name.lower()} pictures for {CAMERA_SILENCE_S:g} s")


class Outlet:
    """What a driver's code in the capture process hands pictures and reports to, and hears commands from.

    ``lock_exposure`` is called when exposure and white balance are to stay as they are; it answers whether the camera
    can, or None where that is reported later.
    """

    def __init__(self, link: Connection, commands: queue.SimpleQueue[Command], ring: Ring) -> None:
        self._link = link
        self._commands = commands
        self._ring = ring
        self._memory = SharedMemory(ring.name)
        assert self._memory.buf is not None
        self._pixels = self._memory.buf
        self._free = list(reversed(range(ring.slots)))
        self._last_sent = time.monotonic()
        self._held: list[object] = []
        self.stopping = False
        self.lock_exposure: Callable[[], bool | None] = lambda: False

    @property
    def has_room(self) -> bool:
        """Whether the next picture finds a slot."""
        return bool(self._free)

    def hold(self, *kept: object) -> None:
        """A driver's threads call back and copy until the very end: what they use lives as long as the process."""
        self._held += kept

    def send(self, report: Report) -> None:
        self._link.send(report)
        self._last_sent = time.monotonic()

    def stay_alive(self) -> None:
        """Tell the owner now and then that the driver is not stuck."""
        if time.monotonic() - self._last_sent > ALIVE_EVERY_S:
            self.send(Alive())

    def watch(self, sensors: Iterable[Sensor], gone: threading.Event, pass_on: Callable[[Heard], None]) -> None:
        """The loop of every camera, until it is to stop: ``pass_on`` waits a moment for pictures, hands on what came
        and notes which sensor was heard; ``gone`` is set by the driver's own threads when the camera was unplugged."""
        heard = Heard(sensors)
        while not self.stopping:
            self.obey(block=False)
            if gone.is_set():
                raise GaveUp(CameraLost, "unplugged")
            pass_on(heard)
            heard.check()
            self.stay_alive()

    def put(self, sensor: Sensor, number: int, timestamp_us: int, picture: memoryview) -> None:
        """Copy one picture (contiguous bytes) and announce it; dropped when no slot is free or it is too large."""
        if self._free and picture.nbytes <= self._ring.slot_bytes:
            slot = self._free.pop()  # the one freed last: what is never needed takes no memory
            start = slot * self._ring.slot_bytes
            self._pixels[start : start + picture.nbytes] = picture
            self.send(Arrived(sensor, slot, number, timestamp_us))

    def obey(self, *, block: bool) -> None:
        """Carry out what the owner asked for; with ``block`` wait a moment for it."""
        while True:
            try:
                command = self._commands.get(timeout=WAIT_MS / 1000) if block else self._commands.get_nowait()
            except queue.Empty:
                return
            block = False
            if isinstance(command, Free):
                self._free.append(command.slot)
            elif isinstance(command, LockExposure):
                done = self.lock_exposure()
                if done is not None:
                    self.send(ExposureSet(done))
            elif isinstance(command, Stop):
                self.stopping = True


Serve = Callable[[Outlet, Any], None]
"""A driver's code: serves a plan until its end or ``outlet.stopping``; raises :class:`GaveUp` or DriverMissing."""


def run(link: Connection, serve: Serve, plan: object, ring: Ring) -> None:
    """Entry of the process: serve ``plan`` until its end, a :class:`Stop`, or the death of the owner."""
    end_with_owner()
    commands: queue.SimpleQueue[Command] = queue.SimpleQueue()
    threading.Thread(target=_listen, args=(link, commands), name="commands", daemon=True).start()
    link.send(Alive())
    report: Report = Ended()
    outlet = Outlet(link, commands, ring)
    try:
        serve(outlet, plan)
    except GaveUp as failure:
        report = Trouble(failure.fault, failure.detail)
    except DriverMissing as fault:
        report = Trouble(DriverMissing, fault.detail)
    except (BrokenPipeError, ConnectionResetError):
        os._exit(0)
    try:
        link.send(report)
        link.close()
    finally:
        # threads of the driver still run; leaving without any clean-up is the one safe way out
        os._exit(0)


def _listen(link: Connection, commands: queue.SimpleQueue[Command]) -> None:
    with suppress(EOFError, OSError):
        while True:
            commands.put(link.recv())


_BUSY = ("busy", "in use", "errno=16")
_NO_RIGHTS = ("permission", "access denied", "usb_status_access", "errno=13")


def why_unlisted(seen: Sequence[UsbCamera], listed: Sequence[str] = ()) -> GaveUp:
    """Of the cameras ``seen`` on the bus the driver lists only ``listed`` (in words), and the wanted is not among them.

    The bus does not tell the serial numbers that drivers tell: a camera that is not listed may be the wanted one.
    """
    if len(seen) > len(listed):
        for camera in seen:
            if not camera.may_open:
                return GaveUp(CameraPermission, str(camera.node))
        for camera in seen:
            if camera.is_claimed:
                return GaveUp(CameraBusy, camera.name)
        return GaveUp(DriverFailed, f"{seen[0].name} is plugged in, but the driver does not see it")
    return GaveUp(OtherCamera, ", ".join(listed)) if listed else GaveUp(CameraMissing, "")


def why_not_opened(reason: str, seen: Sequence[UsbCamera]) -> GaveUp:
    """The driver could not open a camera it lists, for this reason in its own words. Who holds it is no help here: the
    driver that failed may have taken it itself."""
    said = reason.lower()
    if any(word in said for word in _BUSY):
        return GaveUp(CameraBusy, reason)
    locked = [str(camera.node) for camera in seen if not camera.may_open]
    if locked or any(word in said for word in _NO_RIGHTS):
        return GaveUp(CameraPermission, locked[0] if locked else reason)
    return GaveUp(DriverFailed, reason)
