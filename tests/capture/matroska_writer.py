"""Writes Matroska files of the form of an Azure Kinect's, byte by byte: no library that also reads them has a part."""

from __future__ import annotations

import struct
from collections.abc import Iterable, Sequence
from pathlib import Path

SCALE_NS = 1000
"""Times in the file are microseconds."""


def track(number: int, name: str, size_px: tuple[int, int], fourcc: bytes, bits: int) -> bytes:
    """An entry of a video track: ``fourcc`` MJPG for colour, b16g for depth and infrared."""
    width, height = size_px
    header = struct.pack("<IiiHH4sIiiII", 40, width, height, 1, bits, fourcc, width * height * bits // 8, 0, 0, 0, 0)
    about = _number("D7", number) + _number("73C5", number) + _number("83", 1) + _number("9C", 0)
    about += _text("536E", name) + _text("86", "V_MS/VFW/FOURCC") + _element("63A2", header)
    about += _number("23E383", 33_333_333) + _element("E0", _number("B0", width) + _number("BA", height))
    return _element("AE", about)


def write(
    path: Path,
    tracks: Sequence[bytes],
    blocks: Iterable[tuple[int, int, bytes]],
    *,
    files: Sequence[tuple[str, bytes]] = (),
    tags: Sequence[tuple[str, str]] = (),
    duration_us: float = 0.0,
) -> None:
    """``blocks``: time in microseconds, track and picture; ``files`` are attached."""
    out = _element("1549A966", _number("2AD7B1", SCALE_NS) + _element("4489", struct.pack(">d", duration_us)))
    out += _element("1654AE6B", b"".join(tracks))
    attached = [
        _text("466E", name) + _text("4660", "application/octet-stream") + _element("465C", data) + _number("46AE", 7)
        for name, data in files
    ]
    out += _element("1941A469", b"".join(_element("61A7", each) for each in attached)) if attached else b""
    simple = [
        _element("63C0", b"") + _element("67C8", _text("45A3", name) + _text("4487", said)) for name, said in tags
    ]
    out += _element("1254C367", b"".join(_element("7373", each) for each in simple)) if simple else b""
    for at_us, number, picture in blocks:
        block = bytes([0x80 | number]) + struct.pack(">h", 0) + b"\x80" + picture
        out += _element("1F43B675", _number("E7", at_us) + _element("A3", block))
    head = b"".join(_number(key, value) for key, value in (("4286", 1), ("42F7", 1), ("42F2", 4), ("42F3", 8)))
    head += _text("4282", "matroska") + _number("4287", 4) + _number("4285", 2)
    path.write_bytes(_element("1A45DFA3", head) + _element("18538067", out))


def _element(key: str, data: bytes) -> bytes:
    return bytes.fromhex(key) + (len(data) | 1 << 56).to_bytes(8, "big") + data


def _number(key: str, value: int) -> bytes:
    return _element(key, value.to_bytes(8, "big"))


def _text(key: str, text: str) -> bytes:
    return _element(key, text.encode())
