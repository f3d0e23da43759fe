"""Finds the damaged JPEG pictures on which the OpenNI2 library dies.

It skips over a marker's segment without looking whether the picture goes that far, and then reads whatever memory
follows. Other damage it survives. Needed only after it has died: see :class:`core.capture.oni_source.OniSource`.
"""

from __future__ import annotations

import re
from pathlib import Path

from carpus.core.capture.oni_check import OniStream

START, END, SCAN = 0xD8, 0xD9, 0xDA
_MARKER = re.compile(rb"\xff+([^\x00\xff])")
_ALONE = frozenset({0x01, *range(0xD0, 0xD8)})
"""Markers without a segment; the reader goes on behind them."""
_SKIPPED = frozenset({0xDC, 0xFE, *range(0xE0, 0xF0)})
"""Segments that are skipped, by the length they tell."""
_READ = frozenset({0xC4, 0xCC, 0xDB, 0xDD, SCAN, 0xC0, 0xC1, 0xC2, 0xC9, 0xCA})
"""Segments that are read byte by byte, which stops at the picture's end."""


def kills_library(jpeg: bytes) -> bool:
    """Whether a segment that is skipped reaches beyond the picture's end.

    >>> kills_library(bytes.fromhex("ffd8 ffe0 0010 4a46"))
    True
    >>> kills_library(bytes.fromhex("0000 ffe0 0010 4a46"))
    False
    """
    if jpeg[:2] != bytes((0xFF, START)):
        return False
    position = 2
    while (found := _MARKER.search(jpeg, position)) is not None:
        marker, position = found[1][0], found.end()
        if marker in _ALONE:
            continue
        if marker not in _SKIPPED and marker not in _READ:
            return False
        length = int.from_bytes(jpeg[position : position + 2], "big")
        if marker in _SKIPPED and position + max(length, 2) > len(jpeg):
            return len(jpeg) - position >= 2
        position += max(length, 2)
    return False


def deadly_pictures(path: Path, stream: OniStream) -> tuple[int, ...]:
    """Positions in the file of the pictures on which the library dies."""
    with path.open("rb") as file:
        deadly = []
        for position, size in zip(stream.position.tolist(), stream.size_bytes.tolist(), strict=True):
            file.seek(position)
            if kills_library(file.read(size)):
                deadly.append(position)
    return tuple(deadly)
