"""A picture as a grid of tiles, each packed by itself: only what is looked at needs to be unpacked.

Layout, little-endian: u16 width, u16 height, u32 size of each tile, row by row, then the tiles. One that is all
zero has no byte. JPEG's blocks are of 8 pixels, so a colour picture is the same by tiles as it is whole.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Callable
from functools import lru_cache
from itertools import accumulate, pairwise, product
from pathlib import Path
from typing import Any, Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from carpus.core.errors import RecordingUnreadable
from carpus.core.phrase import phrase
from carpus.core.types import Region

SIDE_PX = 80
"""Smaller ones cost more bytes and calls, larger ones more pixels that nobody looks at."""
MOST_BYTES = 1 << 27
_SIZE = struct.Struct("<HH")

AnyImage = TypeVar("AnyImage", bound=NDArray[Any])


@lru_cache(maxsize=4)
def _tiles(width: int, height: int) -> tuple[tuple[slice, slice], ...]:
    rows, columns = ([slice(begin, begin + SIDE_PX) for begin in range(0, size, SIDE_PX)] for size in (height, width))
    return tuple(product(rows, columns))


def packed(picture: NDArray[Any], encode: Callable[[Any], bytes]) -> bytes:
    """The picture's tiles, each as ``encode`` packs it."""
    height, width = picture.shape[:2]
    each = (picture[row, column] for row, column in _tiles(width, height))
    tiles = [encode(tile) if tile.any() else b"" for tile in each]
    return b"".join((_SIZE.pack(width, height), struct.pack(f"<{len(tiles)}I", *map(len, tiles)), *tiles))


class Tiled(Generic[AnyImage]):
    """A packed picture. ``blank`` is an empty one of its kind, ``decode`` the inverse of what packed its tiles.

    Raises :class:`RecordingUnreadable`, which names ``path``, here or where a tile is unpacked.
    """

    def __init__(
        self, path: Path, data: bytes, blank: AnyImage, decode: Callable[[memoryview], AnyImage | None]
    ) -> None:
        self._path, self._decode, self._data = path, decode, memoryview(data)
        if len(data) < _SIZE.size:
            raise self._damaged()
        width, height = _SIZE.unpack_from(data)
        shape = (height, width, *blank.shape[2:])
        if not 0 < math.prod(shape) * blank.itemsize <= MOST_BYTES:
            raise self._damaged()
        self._tiles = _tiles(width, height)
        self._columns = -(-width // SIDE_PX)
        first = _SIZE.size + 4 * len(self._tiles)
        if first > len(data):
            raise self._damaged()
        ends = [*accumulate(struct.unpack_from(f"<{len(self._tiles)}I", data, _SIZE.size), initial=first)]
        if ends[-1] != len(data):
            raise self._damaged()
        self._bounds = [*pairwise(ends)]
        self._picture: Any = np.zeros(shape, blank.dtype)
        given: Any = self._picture.view()
        given.flags.writeable = False
        self._given: AnyImage = given

    @property
    def size_px(self) -> tuple[int, int]:
        """Width and height."""
        height, width = self._picture.shape[:2]
        return width, height

    def seen(self, part: Region | None) -> AnyImage:
        """The picture, read-only, unpacked at least within ``part``, or all of it."""
        width, height = self.size_px
        part = Region(0, 0, width, height) if part is None else part.clipped(width, height)
        for row in range(part.top // SIDE_PX, -(-part.bottom // SIDE_PX)):
            for column in range(part.left // SIDE_PX, -(-part.right // SIDE_PX)):
                number = row * self._columns + column
                begin, end = self._bounds[number]
                if begin < end:
                    self._unpack(number, self._data[begin:end])
                    self._bounds[number] = (end, end)
        return self._given

    def _unpack(self, number: int, data: memoryview) -> None:
        tile, place = self._decode(data), self._picture[self._tiles[number]]
        if tile is None or tile.shape != place.shape:
            raise self._damaged()
        place[:] = tile

    def _damaged(self) -> RecordingUnreadable:
        return RecordingUnreadable(self._path, phrase("not a picture"))
