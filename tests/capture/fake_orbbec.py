"""OrbbecSDK without a camera: its own player, in place of the bus, plays a recording made here.

The recording is a ROS bag as the library stores it, written from the format's description, so that pictures, lenses
and unplugging are the library's own. The camera is taken away, and not found, while there is
a file ``unplugged`` in a folder.
"""

from __future__ import annotations

import struct
import threading
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import cv2
import numpy as np

from carpus.core.capture.devices.orbbec import import_sdk

SERIAL, NAME = "CL8FX00000A", "Orbbec Femto Bolt"
FRAMES, PERIOD_US, FIRST_US = 90, 33_333, 5_000_000
COLOR_SIZE_PX, DEPTH_SIZE_PX = (1280, 960), (320, 288)
COLOR_FX, DEPTH_FX, SHIFT_MM = 1050.0, 250.0, 15.0
BENT = (0.12, -0.03, 0.001, 0.002, 0.01, -0.08, 0.02, 0.005)
"""k1 k2 p1 p2 k3 k4 k5 k6 of the colour lens, which moves its edges by several pixels."""
EDGE_PX, NEAR_MM = 60, 700
"""In the depth picture nothing is left of this column, and a plane right of it."""
_IMAGE = ("sensor_msgs/Image", "060021388200f6f0f447d0fcd9c64743")
_PROFILE = ("custom_msg/OBStreamProfileInfo", "0123456789abcdef0123456789abcdef")
_PROPERTY = ("custom_msg/OBProperty", "0123456789abcdef0123456789abcdef")
_DEVICE = ("custom_msg/OBDeviceInfo", "afef5328bb4abebd1a309e1ea8b26b3a")
_RATIONAL = 4
_FORMATS = {"mjpg": 5, "mono16": 8}
_COLOR, _DEPTH = 2, 3


class Bag:
    """A ROS bag, version 2.0, of one chunk."""

    def __init__(self) -> None:
        self._chunk = bytearray()
        self._connections: list[bytes] = []
        self._index: list[list[tuple[int, int]]] = []

    def topic(self, name: str, kind: tuple[str, str]) -> int:
        """A new topic with its type and that one's hash; its number."""
        number = len(self._connections)
        about = _fields(topic=name.encode(), type=kind[0].encode(), md5sum=kind[1].encode(), message_definition=b"-")
        self._connections.append(_record(_fields(op=b"\x07", conn=_u32(number), topic=name.encode()), about))
        self._chunk += self._connections[-1]
        self._index.append([])
        return number

    def write(self, topic: int, at_us: int, message: bytes) -> None:
        """One message."""
        self._index[topic].append((at_us, len(self._chunk)))
        self._chunk += _record(_fields(op=b"\x02", conn=_u32(topic), time=_stamp(at_us)), message)

    def save(self, path: Path) -> None:
        """Write all of it."""
        magic, length = b"#ROSBAG V2.0\n", 4096
        body = _record(_fields(op=b"\x05", compression=b"none", size=_u32(len(self._chunk))), bytes(self._chunk))
        for number, entries in enumerate(self._index):
            head = _fields(op=b"\x04", ver=_u32(1), conn=_u32(number), count=_u32(len(entries)))
            body += _record(head, b"".join(_stamp(at_us) + _u32(place) for at_us, place in entries))
        times = [at_us for entries in self._index for at_us, _ in entries]
        info = _record(
            _fields(
                op=b"\x06",
                ver=_u32(1),
                chunk_pos=_u64(len(magic) + length),
                start_time=_stamp(min(times)),
                end_time=_stamp(max(times)),
                count=_u32(len(self._index)),
            ),
            b"".join(_u32(number) + _u32(len(entries)) for number, entries in enumerate(self._index)),
        )
        about = _fields(
            op=b"\x03",
            index_pos=_u64(len(magic) + length + len(body)),
            conn_count=_u32(len(self._connections)),
            chunk_count=_u32(1),
        )
        first = _record(about, b" " * (length - 8 - len(about)))
        path.write_bytes(magic + first + body + b"".join(self._connections) + info)


def record(path: Path) -> None:
    """A recording of a plane with an edge, as the library stores one."""
    bag = Bag()
    topics = {each: bag.topic(f"/cam/sensor_{each}/frameType_{each}", _IMAGE) for each in (_COLOR, _DEPTH)}
    width, height = COLOR_SIZE_PX
    ramp = np.tile(np.linspace(40, 200, width)[None, :, None], (height, 1, 3)).astype(np.uint8)
    color = cv2.imencode(".jpg", ramp)[1].tobytes()
    depth = np.zeros(DEPTH_SIZE_PX[::-1], "<u2")
    depth[:, EDGE_PX:] = NEAR_MM
    for number in range(1, FRAMES + 1):
        at_us = FIRST_US + number * PERIOD_US
        bag.write(topics[_DEPTH], at_us, _image(at_us, number, "mono16", DEPTH_SIZE_PX, depth.tobytes()))
        bag.write(topics[_COLOR], at_us + 500, _image(at_us + 500, number, "mjpg", COLOR_SIZE_PX, color))
    k1, k2, p1, p2, k3, k4, k5, k6 = BENT
    for stream, stored, size_px, fx, bent, shift_mm in (
        (_COLOR, "mjpg", COLOR_SIZE_PX, COLOR_FX, (k1, k2, k3, k4, k5, k6, p1, p2), 0.0),
        (_DEPTH, "mono16", DEPTH_SIZE_PX, DEPTH_FX, (0.0,) * 8, SHIFT_MM),
    ):
        middle = ((size_px[0] - 1) / 2, (size_px[1] - 1) / 2)
        message = _head(FIRST_US) + bytes([stream, _FORMATS[stored]]) + struct.pack("<9f", 1, 0, 0, 0, 1, 0, 0, 0, 1)
        message += struct.pack("<3f", shift_mm, 0, 0) + struct.pack("<3H", *size_px, 30)
        message += struct.pack("<4f", fx, fx, *middle) + struct.pack("<8f", *bent) + bytes([_RATIONAL])
        bag.write(bag.topic(f"/cam/streamProfileType_{stream}", _PROFILE), FIRST_US, message)
    version = struct.pack("<d", 2.0)
    message = _head(FIRST_US) + _u32(0) + _u32(len(version)) + version + _u32(len(version))
    bag.write(bag.topic("/cam/property", _PROPERTY), FIRST_US, message)
    message = _head(FIRST_US) + _text(NAME) + _text(NAME) + _text("") + struct.pack("<2H", 0x2BC5, 0x066B)
    message += b"".join(map(_text, ("1-1", SERIAL, "1.0.9", "0.1", "2.0.0", "USB3.2")))
    message += struct.pack("<HB", 0, 1) + _text("") + _text("")
    bag.write(bag.topic("/cam/deviceInfo", _DEVICE), FIRST_US, message)
    bag.save(path)


class FakeDeviceList:
    """The library's list of devices; every method is one of its own."""

    def __init__(self, devices: Mapping[str, Any], state: Any = None) -> None:
        self._devices, self._state = list(devices.items()), state

    def get_count(self) -> int:
        return len(self._devices)

    def get_device_name_by_index(self, _index: int) -> str:
        return NAME

    def get_device_serial_number_by_index(self, index: int) -> str:
        return self._devices[index][0]

    def query_device_access_state(self, _index: int) -> Any:
        return self._state

    def get_device_by_index(self, index: int) -> Any:
        return self._devices[index][1]


class FakeContext:
    """The library's context; every method is one of its own."""

    def __init__(self, devices: Mapping[str, Any], folder: Path) -> None:
        self._devices, self._folder = devices, folder

    def query_devices(self) -> FakeDeviceList:
        return FakeDeviceList(self._devices)

    def set_device_changed_callback(self, changed: Callable[[Any, Any], None]) -> None:
        threading.Thread(target=self._watch, args=(changed,), daemon=True).start()

    def _watch(self, changed: Callable[[Any, Any], None]) -> None:
        while not (self._folder / "unplugged").exists():
            time.sleep(0.01)
        changed(FakeDeviceList(self._devices), FakeDeviceList({}))


def plug_in(folder: Path, bag: Path) -> FakeContext:
    """A context with the camera, unless it is unplugged."""
    ob = import_sdk()
    devices = {} if (folder / "unplugged").exists() else {SERIAL: ob.PlaybackDevice(str(bag))}
    return FakeContext(devices, folder)


def _image(at_us: int, number: int, encoding: str, size_px: tuple[int, int], data: bytes) -> bytes:
    width, height = size_px
    message = _head(at_us) + _u32(height) + _u32(width) + _text(encoding) + b"\0" + _u32(2 * width)
    message += _u32(len(data)) + data + struct.pack("<f", 0.0) + _u64(number) + 3 * _u64(at_us)
    return message + _u32(0) + _u32(0) + bytes([16 if encoding == "mono16" else 8])


def _head(at_us: int) -> bytes:
    return _u32(0) + _stamp(at_us) + _text("")


def _fields(**values: bytes) -> bytes:
    named = [key.encode() + b"=" + value for key, value in values.items()]
    return b"".join(_u32(len(each)) + each for each in named)


def _record(head: bytes, data: bytes) -> bytes:
    return _u32(len(head)) + head + _u32(len(data)) + data


def _stamp(at_us: int) -> bytes:
    return struct.pack("<2I", at_us // 1_000_000, at_us % 1_000_000 * 1000)


def _text(text: str) -> bytes:
    return _u32(len(text)) + text.encode()


def _u32(number: int) -> bytes:
    return struct.pack("<I", number)


def _u64(number: int) -> bytes:
    return struct.pack("<Q", number)
