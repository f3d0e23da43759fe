"""The .oni file format, version 1.0.1.0: records, names, codecs. Little-endian, packed.

A file is a header and a chain of records; a record is a header, fields, and a payload. Streams are nodes:
added, given properties, ready, then data in time order, removed; ``END`` closes the file.
Depth is packed as differences of indices into a table of the picture's own values ("16zT"), or of values.
"""

from __future__ import annotations

import struct
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from carpus.core.types import DepthImage

FILE_MAGIC = b"NI10"
FILE_VERSION = (1, 0, 1, 0)
OLDEST_VERSION = (1, 0, 0, 4)
FILE_HEADER = struct.Struct("<4sBBHIQI")
"""magic, version in four parts, greatest timestamp (microseconds), greatest node id."""

RECORD_MAGIC = 0x0052494E
RECORD_HEADER = struct.Struct("<IIIIIQ")
"""magic, type, node id, size of header and fields, size of payload, position of the record that this one replaces."""
OLD_RECORD_HEADER = struct.Struct("<IIIIII")
"""The same before version 1.0.1.0, with 32-bit positions."""

NODE_ADDED_FIELDS = struct.Struct("<I4sIQQQ")
"""After the name: node type, codec, pictures, least and greatest timestamp, position of the seek table."""
NEW_DATA_FIELDS = struct.Struct("<QI")
"""timestamp (microseconds), picture number from 1."""
DATA_BEGIN_FIELDS = struct.Struct("<IQ")
SEEK_ENTRY = struct.Struct("<QIQ")


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
    """Kinds of nodes; only these three carry pictures."""

    DEPTH = 2
    IMAGE = 3
    IR = 5


class Codec:
    """How payloads are packed; four letters."""

    RAW = b"NONE"
    JPEG = b"JPEG"
    DEPTH_TABLE = b"16zT"
    DEPTH_PLAIN = b"16zP"


MAP_OUTPUT_MODE = "xnMapOutputMode"
CROPPING = "xnCropping"
PIXEL_FORMAT_1 = "xnPixelFormat"
PIXEL_FORMAT_2 = "oniPixelFormat"
FRAME_SIZE = "oniRequiredFrameSize"
MIRROR = "xnMirror"
FIELD_OF_VIEW = "xnFOV"
MAX_DEPTH = "xnDeviceMaxDepth"


MAX_VALUES = 0x8000
"""An index written in full has 15 bits."""
SMALL = 6
"""Differences up to this take half a byte."""
MEDIUM = 63
"""Differences up to this take a byte after the escape."""
UNCHANGED = 0x66
"""Two pixels without change."""
LONGEST_RUN = 15


def encode_depth(depth_raw: DepthImage) -> bytes:
    """Pack one depth picture (H, W) without loss.

    Count and table of the values, first index, then for each pixel d = index before - index now: |d| <= 6 half a
    byte (d + 6), two pixels a byte; k times two unchanged pixels 0xE0 + k; else an escape (0xFF, or 0xF in the
    lower half of a begun byte) with 192 + d for |d| <= 63, or the index itself in two bytes, high byte first.
    """
    flat = np.ascontiguousarray(depth_raw).ravel()
    present = np.zeros(1 << 16, bool)
    present[flat] = True
    values = np.flatnonzero(present)
    if len(values) > MAX_VALUES:
        raise ValueError(f"{len(values)} different depths, at most {MAX_VALUES} can be packed")
    place = np.zeros(1 << 16, np.int32)
    place[values] = np.arange(len(values), dtype=np.int32)
    index = place[flat]
    head = struct.pack("<H", len(values)) + values.astype("<u2").tobytes() + struct.pack("<H", int(index[0]))
    return head + _differences(index).tobytes()


def _differences(index: NDArray[np.int32]) -> NDArray[np.uint8]:
    """The coded stream after the first index (P,)."""
    step = index[:-1] - index[1:]
    count = len(step)
    if count == 0:
        return np.empty(0, np.uint8)
    small = np.abs(step) <= SMALL
    where = np.arange(count)
    last_escape = np.maximum.accumulate(np.where(small, -1, where))
    second = small & ((where - last_escape) % 2 == 0)
    first = small & ~second
    pair = np.flatnonzero(second)
    alone = np.flatnonzero(first & ~np.append(second[1:], False))
    escape = np.flatnonzero(~small)

    # up to three bytes stand at each pixel; NONE marks those that are not written
    none = np.int32(-1)
    out = np.full((count, 3), none)
    out[pair, 0] = ((step[pair - 1] + SMALL) << 4) | (step[pair] + SMALL)
    begun = np.zeros(count, bool)
    begun[escape] = np.append(False, first[:-1])[escape]
    half = np.where(begun[escape], (step[escape - 1] + SMALL) << 4 | 0x0F, 0xFF)
    out[escape, 0] = half
    far = np.abs(step[escape]) > MEDIUM
    out[escape, 1] = np.where(far, index[escape + 1] >> 8, 192 + step[escape])
    out[escape, 2] = np.where(far, index[escape + 1] & 0xFF, none)
    if len(alone) and alone[-1] == count - 1:
        out[-1, 0] = ((step[-1] + SMALL) << 4) | 0x0D
    stream = out[out >= 0]

    return _pack_runs(stream, np.isin(np.flatnonzero(out.ravel() >= 0), pair * 3))


def _pack_runs(stream: NDArray[np.int32], is_pair: NDArray[np.bool_]) -> NDArray[np.uint8]:
    """Replace each run of unchanged pairs by its length, at most 15 at a time."""
    still = is_pair & (stream == UNCHANGED)
    if not still.any():
        return stream.astype(np.uint8)
    where = np.arange(len(stream))
    before_run = np.maximum.accumulate(np.where(still, -1, where))
    in_run = np.where(still, where - before_run, 0)
    ends = still & ((in_run % LONGEST_RUN == 0) | ~np.append(still[1:], False))
    length = (in_run - 1) % LONGEST_RUN + 1
    coded = np.where(ends, 0xE0 + length, stream)
    packed: NDArray[np.uint8] = coded[~still | ends].astype(np.uint8)
    return packed


def decode_depth(data: bytes, codec: bytes, shape: tuple[int, int]) -> DepthImage | None:
    """One depth picture (H, W) as :func:`encode_depth` packs it, packed without a table, or not at all; None where it
    is damaged."""
    count = shape[0] * shape[1]
    if codec == Codec.RAW:
        return np.frombuffer(data, "<u2").reshape(shape) if len(data) == 2 * count else None
    try:
        values, at = _table(data) if codec == Codec.DEPTH_TABLE else (None, 0)
        index = _indices(data[at + 2 :], *struct.unpack_from("<H", data, at))
        depth = index if values is None else values[index]
        return depth.astype(np.uint16).reshape(shape)
    except (IndexError, ValueError, struct.error):
        return None


def _table(data: bytes) -> tuple[NDArray[np.uint16], int]:
    (count,) = struct.unpack_from("<H", data)
    return np.frombuffer(data, "<u2", count, 2), 2 + 2 * count


def _meaning() -> tuple[NDArray[np.int32], NDArray[np.uint8]]:
    """Of each byte (256, 2): the two steps of the index that it holds, and how many pixels each is good for."""
    byte = np.arange(256, dtype=np.int32)
    step = np.stack((SMALL - (byte >> 4), SMALL - (byte & 0x0F)), 1)
    times = np.ones((256, 2), np.uint8)
    times[(byte & 0x0F) == 0x0D, 1] = 0
    step[0xE0:0xFF], times[0xE0:0xFF] = 0, np.stack((2 * (byte[0xE0:0xFF] - 0xE0), 0 * byte[0xE0:0xFF]), 1)
    times[0xFF, 0] = 0
    return step, times


_STEP, _TIMES = _meaning()


def _indices(data: bytes, first: int) -> NDArray[np.int32]:
    """The index of each pixel (P,): steps summed up since the last index that was written in full."""
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

    # the second step of an escape is in the byte behind it, or begins anew there; what is behind it is none of its own
    step, times = _STEP[coded], _TIMES[coded]
    step[escape, 1] = np.where(behind < 0x80, 0, 192 - behind)
    times[escape + 1] = 0
    times[far + 2] = 0
    kept = np.flatnonzero(times)
    index, times = np.cumsum(step.ravel()[kept], dtype=np.int32), times.ravel()[kept]
    anew = np.searchsorted(kept, 2 * far + 1)
    written = behind[behind < 0x80] << 8 | coded[far + 2]
    index += np.repeat(np.append(first, written - index[anew]), np.diff([0, *anew, len(index)])).astype(np.int32)
    if len(index) and index.min() < 0:
        raise IndexError("an index below nothing")
    return np.append(np.int32(first), np.repeat(index, times))
