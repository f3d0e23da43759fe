"""The .oni file format, version 1.0.1.0: records, names and codecs; little-endian, packed.

A file is a header and a chain of records; a record is a header, fields, and a payload. Streams are nodes: added, given
properties, ready, then data in time order, removed; ``END`` closes the file. Depth is packed as differences of indices
into a table of the image's own values ("16zT"), or of values.
"""

from __future__ import annotations

import struct
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from carpus.core.model.types import DepthImage

FILE_MAGIC = b"NI10"
FILE_VERSION = (1, 0, 1, 0)
OLDEST_VERSION = (1, 0, 0, 4)
FILE_HEADER = struct.Struct("<4sBBHIQI")
"""magic, version in four parts, greatest timestamp (microseconds), greatest node id."""

RECORD_MAGIC = 0x0052494E
RECORD_HEADER = struct.Struct("<IIIIIQ")
"""magic, type, node id, size of header and fields, size of payload, position of the record that this one replaces."""
OLD_RECORD_HEADER = struct.Struct("<IIIIII")
"""Before version 1.0.1.0, with 32-bit positions."""

NEW_DATA_FIELDS = struct.Struct("<QI")
"""timestamp (microseconds), image number from 1."""


class RecordType(IntEnum):
    """Kinds of records."""

    NODE_ADDED_1_0_0_4 = 2
    INT_PROPERTY = 3
    REAL_PROPERTY = 4
    STRING_PROPERTY = 5
    GENERAL_PROPERTY = 6
    NODE_REMOVED = 7
    DATA_BEGIN = 8
    NODE_READY = 9
    NEW_DATA = 10
    END = 11
    NODE_ADDED_1_0_0_5 = 12
    NODE_ADDED = 13
    SEEK_TABLE = 14


class NodeType(IntEnum):
    """Kinds of nodes that carry images."""

    DEPTH = 2
    IMAGE = 3
    IR = 5


class Codec:
    """Codecs of payloads (four letters)."""

    RAW = b"NONE"
    JPEG = b"JPEG"
    DEPTH_TABLE = b"16zT"
    DEPTH_PLAIN = b"16zP"


MAP_OUTPUT_MODE = "xnMapOutputMode"
CROPPING = "xnCropping"
PIXEL_FORMAT_1 = "xnPixelFormat"
PIXEL_FORMAT_2 = "oniPixelFormat"
MIRROR = "xnMirror"
FIELD_OF_VIEW = "xnFOV"


SMALL_STEP = 6
"""Differences up to this take half a byte."""


def decode_depth(data: bytes, codec: bytes, shape: tuple[int, int]) -> DepthImage | None:
    """Decode one depth image (H, W); None if it is damaged.

    It holds count and table of the values (``16zT`` only), the first index, then for each pixel d = previous index -
    index: |d| <= 6 takes half a byte (d + 6), two pixels a byte; 2k unchanged pixels are 0xE0 + k; others are an escape
    (0xFF, or 0xF in the lower half of a byte) with 192 + d for |d| <= 63, or with the index in two bytes, high byte
    first.
    """
    count = shape[0] * shape[1]
    if codec == Codec.RAW:
        return np.frombuffer(data, "<u2").reshape(shape) if len(data) == 2 * count else None
    try:
        values, at = None, 0
        if codec == Codec.DEPTH_TABLE:
            (count,) = struct.unpack_from("<H", data)
            values, at = np.frombuffer(data, "<u2", count, 2), 2 + 2 * count
        index = _decode_indices(data[at + 2 :], *struct.unpack_from("<H", data, at))
        depth = index if values is None else values[index]
        return depth.astype(np.uint16).reshape(shape)
    except (IndexError, ValueError, struct.error):
        return None


def _build_byte_tables() -> tuple[NDArray[np.int32], NDArray[np.uint8]]:
    """Return for each byte the two index steps that it holds and the number of pixels of each, both (256, 2)."""
    byte = np.arange(256, dtype=np.int32)
    step = np.stack((SMALL_STEP - (byte >> 4), SMALL_STEP - (byte & 0x0F)), 1)
    times = np.ones((256, 2), np.uint8)
    times[(byte & 0x0F) == 0x0D, 1] = 0
    step[0xE0:0xFF], times[0xE0:0xFF] = 0, np.stack((2 * (byte[0xE0:0xFF] - 0xE0), 0 * byte[0xE0:0xFF]), 1)
    times[0xFF, 0] = 0
    return step, times


_BYTE_STEPS, _BYTE_COUNTS = _build_byte_tables()


def _decode_indices(data: bytes, first: int) -> NDArray[np.int32]:
    """Return the index of each pixel (P,): cumulative steps since the last index written in full."""
    coded = np.frombuffer(data, np.uint8)
    escapes, end = [], 0
    for place in np.flatnonzero(((coded & 0x0F) == 0x0F) & (coded != 0xEF)).tolist():
        if place >= end:  # else it is part of the escape before
            escapes.append(place)
            end = place + (2 if data[place + 1] & 0x80 else 3)
    if end > len(data):
        raise IndexError("an escape without its end")
    escape = np.array(escapes, np.int64)
    behind = coded[escape + 1].astype(np.int32)
    far = escape[behind < 0x80]

    # the second step of an escape is in the byte after it, or restarts there; the bytes after it have no steps
    step, times = _BYTE_STEPS[coded], _BYTE_COUNTS[coded]
    step[escape, 1] = np.where(behind < 0x80, 0, 192 - behind)
    times[escape + 1] = 0
    times[far + 2] = 0
    used = np.flatnonzero(times)
    index, times = np.cumsum(step.ravel()[used], dtype=np.int32), times.ravel()[used]
    restarts = np.searchsorted(used, 2 * far + 1)
    written = behind[behind < 0x80] << 8 | coded[far + 2]
    index += np.repeat(np.append(first, written - index[restarts]), np.diff([0, *restarts, len(index)])).astype(
        np.int32
    )
    if len(index) and index.min() < 0:
        raise IndexError("an index below nothing")
    return np.append(np.int32(first), np.repeat(index, times))
