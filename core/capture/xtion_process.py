"""The capture process: owns the OpenNI2 library, so that whatever kills or hangs it does not take Carpus along.

One thread makes every call of the library. A second one only listens to the owner; when the owner is gone it ends
the process at once, even from within a call. Pictures are checked, copied once into a shared ring and announced
through the pipe. This module loads no NumPy: the process starts fast.

Ring: bounded. A recording waits for a free slot, so nothing is lost. A camera does not wait: with no slot free the
picture is dropped and counted with the next one.
"""

from __future__ import annotations

import ctypes
import os
import queue
import signal
import threading
import time
from collections import deque
from collections.abc import Mapping
from multiprocessing.connection import Connection
from multiprocessing.shared_memory import SharedMemory

from carpus.core.capture.openni2 import (
    CallFailed,
    Context,
    Device,
    DeviceState,
    Picture,
    PixelFormat,
    Sensor,
    Stream,
    StreamProperty,
    VideoMode,
)
from carpus.core.capture.xtion_messages import (
    Alive,
    Arrived,
    Broken,
    CameraPlan,
    Command,
    Ended,
    ExposureSet,
    FilePlan,
    Free,
    LockExposure,
    Plan,
    Report,
    Ring,
    Stop,
    Trouble,
)
from carpus.core.capture.xtion_opening import (
    GaveUp,
    open_camera,
    open_unchanged,
    start_recording,
    survivable_name,
    without_deadly,
)
from carpus.core.errors import (
    CameraLost,
    DriverFailed,
    DriverMissing,
    RecordingDamaged,
)

WAIT_MS = 200
END_WAIT_MS = 20
ALIVE_EVERY_S = 1.0
FILE_SILENCE_S = 3.0
CAMERA_SILENCE_S = 3.0
CAMERA_WARM_UP_S = 6.0
"""Time to the first picture after opening."""
BYTES_PER_PIXEL: dict[int, int] = {PixelFormat.RGB888: 3, PixelFormat.DEPTH_1_MM: 2, PixelFormat.DEPTH_100_UM: 2}


def run(link: Connection, plan: Plan, ring: Ring) -> None:
    """Entry of the process: serve ``plan`` until its end, a :class:`Stop`, or the death of the owner."""
    # an interrupt from the keyboard reaches both processes; the owner decides what it means
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    commands: queue.SimpleQueue[Command] = queue.SimpleQueue()
    threading.Thread(target=_listen, args=(link, commands), name="owner", daemon=True).start()
    link.send(Alive())
    report: Report = Ended()
    # the library's threads call back and copy until the very end: what they use lives as long as the process
    held: list[object] = []
    try:
        _serve(link, commands, plan, ring, held)
    except GaveUp as failure:
        report = Trouble(failure.fault, failure.detail)
    except DriverMissing as fault:
        report = Trouble(DriverMissing, fault.detail)
    except CallFailed as failure:
        report = Trouble(DriverFailed, f"{failure.call}: {failure.reason}")
    except (BrokenPipeError, ConnectionResetError):
        os._exit(0)
    try:
        link.send(report)
        link.close()
    finally:
        # threads of the library still run; leaving without any clean-up is the one safe way out
        os._exit(0)


def _listen(link: Connection, commands: queue.SimpleQueue[Command]) -> None:
    try:
        while True:
            commands.put(link.recv())
    except (EOFError, OSError):
        os._exit(0)


def _serve(link: Connection, commands: queue.SimpleQueue[Command], plan: Plan, ring: Ring, held: list[object]) -> None:
    library = Context()
    memory = SharedMemory(ring.name)
    happened = _Happened()
    held += (library, memory, happened)
    library.watch(happened.on_state, happened.on_gone)
    if isinstance(plan, FilePlan):
        file = open_unchanged(plan)
        path: str | None = plan.path
        if plan.deadly:
            file, path = without_deadly(file, plan.deadly, lambda: link.send(Alive())), None
        device = library.open(survivable_name(path, file))
        opened = start_recording(device, plan)
    else:
        device, opened = open_camera(library, plan)
    link.send(opened)
    loop = _Loop(link, commands, library, device, ring, memory, happened, opened.modes)
    try:
        if isinstance(plan, FilePlan):
            loop.play(dict(plan.last_number))
        else:
            loop.watch()
    finally:
        if isinstance(plan, CameraPlan):
            device.close()


class _Happened:
    """Facts noted by the library's own threads."""

    def __init__(self) -> None:
        self.ended = threading.Event()
        self.gone = threading.Event()
        self.uri = ""

    def on_state(self, _uri: str, state: int) -> None:
        if state == DeviceState.END_OF_FILE:
            self.ended.set()

    def on_gone(self, uri: str) -> None:
        if uri == self.uri:
            self.gone.set()


class _Loop:
    """Hands pictures from the library to the owner."""

    def __init__(
        self,
        link: Connection,
        commands: queue.SimpleQueue[Command],
        library: Context,
        device: Device,
        ring: Ring,
        memory: SharedMemory,
        happened: _Happened,
        modes: Mapping[Sensor, VideoMode],
    ) -> None:
        self._link = link
        self._commands = commands
        self._library = library
        self._streams = list(device.streams)
        self._ring = ring
        assert memory.buf is not None
        self._base = ctypes.addressof(ctypes.c_char.from_buffer(memory.buf))
        self._free = deque(range(ring.slots))
        self._happened = happened
        self._happened.uri = device.info().uri
        self._modes = modes
        self._overrun = dict.fromkeys(modes, 0)
        self._last_sent = time.monotonic()
        self._stopping = False

    def play(self, last_number: dict[Sensor, int]) -> None:
        """A recording: the next picture only when there is room for it."""
        heard = time.monotonic()
        waiting = dict(last_number)
        while waiting and not self._stopping:
            self._obey(block=not self._free)
            if not self._free:
                heard = time.monotonic()
                continue
            ended = self._happened.ended.is_set()
            ready = self._library.wait(self._streams, END_WAIT_MS if ended else WAIT_MS)
            if ready is not None:
                heard = time.monotonic()
                stream = self._streams[ready]
                if self._take(stream) >= waiting.get(stream.sensor, 0):
                    waiting.pop(stream.sensor, None)
            elif ended:
                return
            elif time.monotonic() - heard > FILE_SILENCE_S:
                raise GaveUp(RecordingDamaged, f"no picture for {FILE_SILENCE_S:g} s")
            self._stay_alive()

    def watch(self) -> None:
        """A camera: the newest picture of each stream, whenever there is one."""
        heard = dict.fromkeys(self._modes, time.monotonic() + CAMERA_WARM_UP_S - CAMERA_SILENCE_S)
        while not self._stopping:
            self._obey(block=False)
            if self._happened.gone.is_set():
                raise GaveUp(CameraLost, "unplugged")
            if self._library.wait(self._streams, WAIT_MS) is not None:
                # the wait names the older stream; reading only that one would starve the other
                for stream in self._streams:
                    if self._library.wait([stream], 0) is not None:
                        self._take(stream)
                        heard[stream.sensor] = time.monotonic()
            for sensor, last in heard.items():
                if time.monotonic() - last > CAMERA_SILENCE_S:
                    raise GaveUp(CameraLost, f"no {sensor.name.lower()} pictures for {CAMERA_SILENCE_S:g} s")
            self._stay_alive()

    def _take(self, stream: Stream) -> int:
        """Pass one picture on; its number, 0 when there was none."""
        sensor = stream.sensor
        with stream.read() as picture:
            if picture is None:
                return 0
            size = agreed_size(picture, self._modes[sensor])
            if size is None or size > self._ring.slot_bytes:
                self._send(Broken(sensor, picture.index))
            elif not self._free:
                self._overrun[sensor] += 1
            else:
                slot = self._free.popleft()
                ctypes.memmove(self._base + slot * self._ring.slot_bytes, picture.address, size)
                self._send(Arrived(sensor, slot, picture.index, picture.timestamp_us, self._overrun[sensor]))
                self._overrun[sensor] = 0
            return picture.index

    def _obey(self, *, block: bool) -> None:
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
                self._send(ExposureSet(command.locked, self._set_automatic(not command.locked)))
            elif isinstance(command, Stop):
                self._stopping = True

    def _set_automatic(self, on: bool) -> bool:
        color = next(stream for stream in self._streams if stream.sensor == Sensor.COLOR)
        keys = (StreamProperty.AUTO_EXPOSURE, StreamProperty.AUTO_WHITE_BALANCE)
        done = [color.set_int(key, int(on)) for key in keys]
        return all(done)

    def _stay_alive(self) -> None:
        if time.monotonic() - self._last_sent > ALIVE_EVERY_S:
            self._send(Alive())

    def _send(self, report: Report) -> None:
        self._link.send(report)
        self._last_sent = time.monotonic()


def agreed_size(picture: Picture, mode: VideoMode) -> int | None:
    """Bytes that may be read of ``picture``: None unless size, format and stride are those of its stream.

    A damaged recording yields any width and height with any number of bytes behind them.
    """
    row = mode.width_px * BYTES_PER_PIXEL.get(mode.pixel_format, 0)
    size = row * mode.height_px
    agreed = (
        size > 0
        and picture.address != 0
        and not picture.is_cropped
        and picture.pixel_format == mode.pixel_format
        and (picture.width_px, picture.height_px) == (mode.width_px, mode.height_px)
        and picture.stride_bytes == row
        and picture.size_bytes == size
    )
    return size if agreed else None
