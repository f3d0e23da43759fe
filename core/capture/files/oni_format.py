"""The .oni file format, version 1.0.1.0: records, names, codecs. Little-endian, packed.

A file is a header and a chain of records; a record is a header, fields, and a payload. Streams are nodes:
added, given properties, ready, then data in time order, removed; ``END`` closes the file.
"""

from __future__ import annotations

import struct
from enum import IntEnum

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
