"""Picture files of a stored recording: bytes to arrays, or a typed fault; never half a picture."""

from __future__ import annotations

import struct
import zlib
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from carpus.core.errors import PictureDamaged
from carpus.core.phrase import phrase
from carpus.core.types import ByteImage, DepthImage

_PNG_START = b"\x89PNG\r\n\x1a\n"
_GREY_TYPES = (0, 4)


def read_color(path: Path) -> ByteImage:
    """Colour picture (H, W, 3) uint8 RGB, read-only."""
    data = _checked_bytes(path)
    if data.startswith(_PNG_START):
        bits, color_type = data[24], data[25]
        if color_type in _GREY_TYPES:
            raise PictureDamaged(path, phrase("grey, a colour picture is expected"))
        if bits > 8:
            raise PictureDamaged(path, phrase("{bits} bits per colour, 8 are expected", bits=bits))
    return _decoded(path, data, cv2.IMREAD_COLOR_RGB)


def read_depth(path: Path) -> DepthImage:
    """Depth picture (H, W) uint16, read-only."""
    depth = _decoded(path, _checked_bytes(path), cv2.IMREAD_UNCHANGED)
    if depth.ndim != 2:
        raise PictureDamaged(path, phrase("in colour, a depth picture of 16 bits is expected"))
    if depth.dtype != np.uint16:
        raise PictureDamaged(
            path, phrase("{value} bits, a depth picture of 16 bits is expected", value=8 * depth.dtype.itemsize)
        )
    return depth


def _checked_bytes(path: Path) -> bytes:
    """The file's bytes; of a PNG every checksum is compared, for a decoder may fill a damaged rest with grey."""
    try:
        data = path.read_bytes()
    except FileNotFoundError as cause:
        raise PictureDamaged(path, phrase("missing")) from cause
    except OSError as cause:
        raise PictureDamaged(path, cause.strerror or phrase("cannot be opened")) from cause
    if not data:
        raise PictureDamaged(path, phrase("empty file"))
    if data.startswith(_PNG_START) and not _png_is_whole(data):
        raise PictureDamaged(path, phrase("cut off or altered"))
    return data


def _png_is_whole(data: bytes) -> bool:
    view = memoryview(data)
    at = len(_PNG_START)
    while at + 12 <= len(data):
        length, name = struct.unpack_from(">I4s", data, at)
        end = at + 8 + length
        if end + 4 > len(data) or zlib.crc32(view[at + 4 : end]) != struct.unpack_from(">I", data, end)[0]:
            return False
        if name == b"IEND":
            return True
        at = end + 4
    return False


def _decoded(path: Path, data: bytes, flags: int) -> NDArray[Any]:
    try:
        picture = cv2.imdecode(np.frombuffer(data, np.uint8), flags)
    except cv2.error as cause:
        raise PictureDamaged(path, phrase("not a picture")) from cause
    if picture is None:
        raise PictureDamaged(path, phrase("not a picture"))
    picture.setflags(write=False)
    return picture
