"""Bindings to the OpenNI2 C library: types, calls and statuses.

One thread makes all calls. The library can crash its process (a close in the wrong order, a bad file), so it is used in
a process of its own, see :mod:`core.capture.devices.openni2_camera`. There is no seeking: in the builds that systems
ship, the call never returns.
"""

from __future__ import annotations

import ctypes
import os
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from ctypes import POINTER, byref, c_char, c_char_p, c_float, c_int, c_uint16, c_uint64, c_void_p
from dataclasses import dataclass
from enum import IntEnum
from pathlib import Path
from typing import Any

from carpus.core.capture.source import Sensor, VideoMode
from carpus.core.model.errors import DriverMissing

API_VERSION = 2002
LIBRARY_NAMES = {"win32": ("OpenNI2.dll",)}
LINUX_NAMES = ("libOpenNI2.so.0", "libOpenNI2.so")
SETTLE_S = 0.08
"""Pause between stopping streams and destroying them.

The drivers do not wait for their own threads, which may be 10 ms (player) or 33 ms (dummy device) behind and then
touch freed memory.
"""


class Status(IntEnum):
    """Return values of a call that are asked for."""

    OK = 0
    TIME_OUT = 102


class DeviceProperty(IntEnum):
    """Properties of a device."""

    FIRMWARE_VERSION = 0
    DRIVER_VERSION = 1
    SERIAL_NUMBER = 3
    IMAGE_REGISTRATION = 5


class StreamProperty(IntEnum):
    """Properties of a stream."""

    HORIZONTAL_FOV = 1
    VERTICAL_FOV = 2
    VIDEO_MODE = 3
    MIRRORING = 7
    AUTO_WHITE_BALANCE = 100
    AUTO_EXPOSURE = 101


class OpenNI2Error(Exception):
    """Failed call of the library; ``reason`` is the library's own text."""

    def __init__(self, call: str, status: int, reason: str) -> None:
        super().__init__(f"{call}: {status}: {reason}")
        self.call = call
        self.status = status
        self.reason = reason


class _Version(ctypes.Structure):
    _fields_ = [("major", c_int), ("minor", c_int), ("maintenance", c_int), ("build", c_int)]


class _VideoMode(ctypes.Structure):
    _fields_ = [("pixel_format", c_int), ("width", c_int), ("height", c_int), ("fps", c_int)]


class _SensorInfo(ctypes.Structure):
    _fields_ = [("sensor", c_int), ("mode_count", c_int), ("modes", POINTER(_VideoMode))]


class _DeviceInfo(ctypes.Structure):
    _fields_ = [
        ("uri", c_char * 256),
        ("vendor", c_char * 256),
        ("name", c_char * 256),
        ("vendor_id", c_uint16),
        ("product_id", c_uint16),
    ]


class VideoFrame(ctypes.Structure):
    """One image of a stream; ``address`` is in the library's memory, valid until it is released."""

    _fields_ = [
        ("size_bytes", c_int),
        ("address", c_void_p),
        ("sensor", c_int),
        ("timestamp_us", c_uint64),
        ("index", c_int),
        ("width_px", c_int),
        ("height_px", c_int),
        ("mode", _VideoMode),
        ("is_cropped", c_int),
        ("crop_x_px", c_int),
        ("crop_y_px", c_int),
        ("stride_bytes", c_int),
    ]


_DeviceCallback = ctypes.CFUNCTYPE(None, POINTER(_DeviceInfo), c_void_p)
_StateCallback = ctypes.CFUNCTYPE(None, POINTER(_DeviceInfo), c_int, c_void_p)


class _Callbacks(ctypes.Structure):
    _fields_ = [("connected", _DeviceCallback), ("disconnected", _DeviceCallback), ("state", _StateCallback)]


_SIGNATURES: dict[str, tuple[Any, list[Any]]] = {
    "oniInitialize": (c_int, [c_int]),
    "oniGetVersion": (_Version, []),
    "oniGetExtendedError": (c_char_p, []),
    "oniGetDeviceList": (c_int, [POINTER(POINTER(_DeviceInfo)), POINTER(c_int)]),
    "oniReleaseDeviceList": (c_int, [POINTER(_DeviceInfo)]),
    "oniRegisterDeviceCallbacks": (c_int, [POINTER(_Callbacks), c_void_p, POINTER(c_void_p)]),
    "oniDeviceOpen": (c_int, [c_char_p, POINTER(c_void_p)]),
    "oniDeviceClose": (c_int, [c_void_p]),
    "oniDeviceGetInfo": (c_int, [c_void_p, POINTER(_DeviceInfo)]),
    "oniDeviceGetSensorInfo": (POINTER(_SensorInfo), [c_void_p, c_int]),
    "oniDeviceCreateStream": (c_int, [c_void_p, c_int, POINTER(c_void_p)]),
    "oniDeviceEnableDepthColorSync": (c_int, [c_void_p]),
    "oniDeviceSetProperty": (c_int, [c_void_p, c_int, c_void_p, c_int]),
    "oniDeviceGetProperty": (c_int, [c_void_p, c_int, c_void_p, POINTER(c_int)]),
    "oniDeviceIsImageRegistrationModeSupported": (c_int, [c_void_p, c_int]),
    "oniStreamDestroy": (None, [c_void_p]),
    "oniStreamStart": (c_int, [c_void_p]),
    "oniStreamStop": (None, [c_void_p]),
    "oniStreamSetProperty": (c_int, [c_void_p, c_int, c_void_p, c_int]),
    "oniStreamGetProperty": (c_int, [c_void_p, c_int, c_void_p, POINTER(c_int)]),
    "oniStreamReadFrame": (c_int, [c_void_p, POINTER(POINTER(VideoFrame))]),
    "oniFrameRelease": (None, [POINTER(VideoFrame)]),
    "oniWaitForAnyStream": (c_int, [POINTER(c_void_p), c_int, POINTER(c_int), c_int]),
}


@dataclass(frozen=True, slots=True)
class DeviceInfo:
    """Device as the library lists it."""

    uri: str
    vendor: str
    name: str
    vendor_id: int
    product_id: int


def load_library() -> ctypes.CDLL:
    """Load the library and set all signatures.

    It is searched by the system's loader, then in the vendors' folders (``OPENNI2_REDIST64``, ``OPENNI2_REDIST``).

    Raises
    ------
    DriverMissing
        No library was found, or it lacks a function.
    """
    names = LIBRARY_NAMES.get(sys.platform, LINUX_NAMES)
    folders = [os.environ[key] for key in ("OPENNI2_REDIST64", "OPENNI2_REDIST") if os.environ.get(key)]
    candidates = [*names, *(str(Path(folder) / name) for folder in folders for name in names)]
    complaint = ""
    for candidate in candidates:
        try:
            library = ctypes.CDLL(candidate)
        except OSError as cause:
            complaint = complaint or str(cause)
            continue
        try:
            for name, (result, arguments) in _SIGNATURES.items():
                function = getattr(library, name)
                function.restype = result
                function.argtypes = arguments
        except AttributeError as cause:
            raise DriverMissing(candidate, str(cause)) from cause
        return library
    raise DriverMissing(names[0], complaint)


def library_version() -> str:
    """Return the version of the library; to be called in a process of its own.

    If the thread that loaded the library has ended, the call ends the process.
    """
    return _read_version(load_library())


def _read_version(library: ctypes.CDLL) -> str:
    found = library.oniGetVersion()
    return f"{found.major}.{found.minor}.{found.maintenance}.{found.build}"


class Context:
    """Initialised library, one per process until that ends."""

    def __init__(self) -> None:
        self.api = load_library()
        self.check("oniInitialize", self.api.oniInitialize(API_VERSION))
        self.version = _read_version(self.api)

    def check(self, call: str, status: int) -> None:
        if status != Status.OK:
            text = self.api.oniGetExtendedError() or b""
            raise OpenNI2Error(call, status, text.decode("utf-8", "replace").strip())

    def list_devices(self) -> list[DeviceInfo]:
        first, count = POINTER(_DeviceInfo)(), c_int()
        self.check("oniGetDeviceList", self.api.oniGetDeviceList(byref(first), byref(count)))
        try:
            return [_device_info(first[i]) for i in range(count.value)]
        finally:
            self.api.oniReleaseDeviceList(first)

    def register_disconnect_handler(self, on_disconnect: Callable[[str], None]) -> None:
        """Call ``on_disconnect`` with the URI of each unplugged device.

        It runs on a thread of the library: it may only note the fact and must not call the library.
        """

        def handle_disconnect(info: Any, _cookie: int | None) -> None:
            on_disconnect(info[0].uri.decode("utf-8", "replace"))

        # kept as an attribute: the library calls into it as long as it lives
        self._callbacks = _Callbacks(
            _DeviceCallback(_ignore_event), _DeviceCallback(handle_disconnect), _StateCallback(_ignore_event)
        )
        status = self.api.oniRegisterDeviceCallbacks(byref(self._callbacks), None, byref(c_void_p()))
        self.check("oniRegisterDeviceCallbacks", status)

    def open(self, uri: str | bytes) -> Device:
        """Open a device or a recording.

        A path must be plain ASCII and shorter than 256 bytes; others crash the library.
        """
        name = uri.encode() if isinstance(uri, str) else uri
        if not name.isascii() or len(name) >= 256:
            raise ValueError(f"not a name that OpenNI2 survives: {name!r}")
        handle = c_void_p()
        self.check("oniDeviceOpen", self.api.oniDeviceOpen(name, byref(handle)))
        return Device(self, handle)

    def poll_streams(self, streams: Sequence[Stream], timeout_ms: int) -> int | None:
        """Return the index of a stream that has an image; None after the timeout."""
        handles = (c_void_p * len(streams))(*[stream.handle for stream in streams])
        ready = c_int(-1)
        status = self.api.oniWaitForAnyStream(handles, len(streams), byref(ready), timeout_ms)
        if status == Status.TIME_OUT:
            return None
        self.check("oniWaitForAnyStream", status)
        return ready.value


class Device:
    """Open device or recording."""

    def __init__(self, context: Context, handle: c_void_p) -> None:
        self.context = context
        self.handle = handle
        self.streams: list[Stream] = []

    def read_info(self) -> DeviceInfo:
        found = _DeviceInfo()
        self.context.check("oniDeviceGetInfo", self.context.api.oniDeviceGetInfo(self.handle, byref(found)))
        return _device_info(found)

    def list_modes(self, sensor: Sensor) -> list[VideoMode]:
        """Return the modes of a sensor; empty if the device has no such sensor."""
        found = self.context.api.oniDeviceGetSensorInfo(self.handle, sensor)
        return [_video_mode(found[0].modes[i]) for i in range(found[0].mode_count)] if found else []

    def create_stream(self, sensor: Sensor) -> Stream:
        """Create a stream, not yet started.

        In lockstep playback a stream that is never started would consume images.
        """
        handle = c_void_p()
        status = self.context.api.oniDeviceCreateStream(self.handle, sensor, byref(handle))
        self.context.check("oniDeviceCreateStream", status)
        stream = Stream(self.context, handle, sensor)
        self.streams.append(stream)
        return stream

    def read_text(self, key: DeviceProperty) -> str:
        """Return a text property; empty if the device lacks it."""
        buffer = ctypes.create_string_buffer(256)
        size = c_int(len(buffer))
        status = self.context.api.oniDeviceGetProperty(self.handle, key, buffer, byref(size))
        return buffer.value.decode("utf-8", "replace") if status == Status.OK else ""

    def read_version(self, key: DeviceProperty) -> str:
        """Return a version property; empty if the device lacks it."""
        found = _Version()
        size = c_int(ctypes.sizeof(found))
        status = self.context.api.oniDeviceGetProperty(self.handle, key, byref(found), byref(size))
        return f"{found.major}.{found.minor}.{found.maintenance}.{found.build}" if status == Status.OK else ""

    def set_value(self, key: int, value: c_int | c_float) -> bool:
        """Set a property; return whether the device accepted it."""
        status = self.context.api.oniDeviceSetProperty(self.handle, key, byref(value), ctypes.sizeof(value))
        return bool(status == Status.OK)

    def can_register_depth(self) -> bool:
        """Return whether the device can register depth to colour."""
        return bool(self.context.api.oniDeviceIsImageRegistrationModeSupported(self.handle, 1))

    def enable_sync(self) -> bool:
        """Synchronise depth and colour; return whether the device can."""
        return bool(self.context.api.oniDeviceEnableDepthColorSync(self.handle) == Status.OK)

    def close(self) -> None:
        """Stop and destroy all streams, then close: the one order that the library survives."""
        for stream in self.streams:
            stream.stop()
        if self.streams:
            time.sleep(SETTLE_S)
        for stream in self.streams:
            stream.destroy()
        self.streams.clear()
        self.context.api.oniDeviceClose(self.handle)


class Stream:
    """Stream of a device."""

    def __init__(self, context: Context, handle: c_void_p, sensor: Sensor) -> None:
        self.context = context
        self.handle = handle
        self.sensor = sensor

    def start(self) -> None:
        self.context.check("oniStreamStart", self.context.api.oniStreamStart(self.handle))

    def stop(self) -> None:
        """Stop the stream. Stop all streams of a device before destroying any, see :meth:`Device.close`."""
        self.context.api.oniStreamStop(self.handle)

    def destroy(self) -> None:
        self.context.api.oniStreamDestroy(self.handle)

    def read_mode(self) -> VideoMode:
        found = _VideoMode()
        size = c_int(ctypes.sizeof(found))
        status = self.context.api.oniStreamGetProperty(
            self.handle, StreamProperty.VIDEO_MODE, byref(found), byref(size)
        )
        self.context.check("oniStreamGetProperty", status)
        return _video_mode(found)

    def set_mode(self, mode: VideoMode) -> bool:
        return self._set(
            StreamProperty.VIDEO_MODE, _VideoMode(mode.pixel_format, mode.width_px, mode.height_px, mode.fps)
        )

    def get_value(self, key: int, found: c_int | c_float) -> float | None:
        """Return a property of the type of ``found``; None if the stream lacks it."""
        size = c_int(ctypes.sizeof(found))
        status = self.context.api.oniStreamGetProperty(self.handle, key, byref(found), byref(size))
        return found.value if status == Status.OK else None

    def set_int(self, key: StreamProperty, value: int) -> bool:
        """Set an integer property; return whether the stream accepted it."""
        return self._set(key, c_int(value))

    @contextmanager
    def read_frame(self) -> Iterator[VideoFrame | None]:
        """Yield the next image, released on leaving; only after :meth:`Context.poll_streams` returned this stream."""
        pointer = POINTER(VideoFrame)()
        status = self.context.api.oniStreamReadFrame(self.handle, byref(pointer))
        self.context.check("oniStreamReadFrame", status)
        if not bool(pointer):
            yield None
            return
        try:
            yield pointer[0]
        finally:
            self.context.api.oniFrameRelease(pointer)

    def _set(self, key: StreamProperty, value: c_int | _VideoMode) -> bool:
        status = self.context.api.oniStreamSetProperty(self.handle, key, byref(value), ctypes.sizeof(value))
        return bool(status == Status.OK)


def _ignore_event(*_: object) -> None:
    """Ignore a connected device, which the next listing shows, or a change of state."""


def _device_info(found: _DeviceInfo) -> DeviceInfo:
    uri, vendor, name = (text.decode("utf-8", "replace") for text in (found.uri, found.vendor, found.name))
    return DeviceInfo(uri, vendor, name, found.vendor_id, found.product_id)


def _video_mode(found: _VideoMode) -> VideoMode:
    return VideoMode(found.pixel_format, found.width, found.height, found.fps)
