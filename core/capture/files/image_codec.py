"""Encoded images: depth as lossless PNG, colour as JPEG or lossless PNG, whole or in tiles.

In tiles only the region that is needed has to be decoded. Layout, little-endian: u16 width, u16 height, u32 size of
each tile, row by row, then the tiles. A tile of zeros has no bytes. JPEG's blocks are of 8 pixels, so a colour image is
the same in tiles as whole.
"""

from __future__ import annotations

import math
import struct
import zlib
from collections.abc import Callable
from functools import lru_cache
from itertools import accumulate, pairwise, product
from pathlib import Path
from typing import Any, Generic, TypeVar

import cv2
import numpy as np
from numpy.typing import NDArray

from carpus.core.model.errors import FrameDamaged, RecordingUnreadable
from carpus.core.model.phrase import phrase
from carpus.core.model.types import ByteImage, DepthImage, Region

JPEG_QUALITY = 95
_JPEG = [cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY, cv2.IMWRITE_JPEG_SAMPLING_FACTOR, 0x111111]
"""No chroma subsampling, so that the markers' edges keep their colour."""
_PNG = [cv2.IMWRITE_PNG_COMPRESSION, 1, cv2.IMWRITE_PNG_STRATEGY, cv2.IMWRITE_PNG_STRATEGY_RLE]
"""Fast; areas that are black or without depth cost next to nothing, and noise has no repetitions to search for."""


def encode_color(color_rgb: ByteImage, *, lossless: bool = False) -> bytes:
    """Encode a colour image (H, W, 3) as JPEG of quality 95, or as PNG."""
    bgr = cv2.cvtColor(color_rgb, cv2.COLOR_RGB2BGR)
    return _encode(".png", bgr, _PNG) if lossless else _encode(".jpg", bgr, _JPEG)


def encode_depth(depth_raw: DepthImage) -> bytes:
    """Encode a depth image (H, W) uint16 as PNG."""
    return _encode(".png", depth_raw, _PNG)


def decode_color(data: bytes | memoryview) -> ByteImage | None:
    """Decode a colour image, read-only; None if it is not one."""
    picture = _decode(data, cv2.IMREAD_COLOR_RGB)
    return picture if picture is not None and picture.ndim == 3 and picture.dtype == np.uint8 else None


def decode_depth(data: bytes | memoryview) -> DepthImage | None:
    """Decode a depth image, read-only; None if it is not one."""
    picture = _decode(data, cv2.IMREAD_UNCHANGED)
    return picture if picture is not None and picture.ndim == 2 and picture.dtype == np.uint16 else None


def _encode(kind: str, picture: NDArray[Any], options: list[int]) -> bytes:
    done, data = cv2.imencode(kind, picture, options)
    assert done
    return data.tobytes()


def _decode(data: bytes | memoryview, flags: int) -> NDArray[Any] | None:
    if not data:
        return None
    try:
        picture: NDArray[Any] | None = cv2.imdecode(np.frombuffer(data, np.uint8), flags)
    except cv2.error:
        return None
    if picture is not None:
        picture.flags.writeable = False
    return picture


TILE_PX = 80
"""Smaller tiles cost more bytes and calls, larger ones more pixels that are not needed."""
MAX_IMAGE_BYTES = 1 << 27
_SIZE = struct.Struct("<HH")

AnyImage = TypeVar("AnyImage", bound=NDArray[Any])


@lru_cache(maxsize=4)
def _tile_slices(width: int, height: int) -> tuple[tuple[slice, slice], ...]:
    rows, columns = ([slice(begin, begin + TILE_PX) for begin in range(0, size, TILE_PX)] for size in (height, width))
    return tuple(product(rows, columns))


def pack_tiles(image: NDArray[Any], encode: Callable[[Any], bytes]) -> bytes:
    """Return the tiles of an image, each encoded by ``encode``."""
    height, width = image.shape[:2]
    each = (image[row, column] for row, column in _tile_slices(width, height))
    tiles = [encode(tile) if tile.any() else b"" for tile in each]
    return b"".join((_SIZE.pack(width, height), struct.pack(f"<{len(tiles)}I", *map(len, tiles)), *tiles))


class TiledImage(Generic[AnyImage]):
    """Image in encoded tiles.

    ``blank`` is an empty image of the same kind, ``decode`` decodes a tile. Raises :class:`RecordingUnreadable` with
    ``path``, here or when a tile is decoded.
    """

    def __init__(
        self, path: Path, data: bytes, blank: AnyImage, decode: Callable[[memoryview], AnyImage | None]
    ) -> None:
        self._path, self._decode, self._data = path, decode, memoryview(data)
        if len(data) < _SIZE.size:
            raise self._decode_error()
        width, height = _SIZE.unpack_from(data)
        shape = (height, width, *blank.shape[2:])
        if not 0 < math.prod(shape) * blank.itemsize <= MAX_IMAGE_BYTES:
            raise self._decode_error()
        self._tiles = _tile_slices(width, height)
        self._columns = -(-width // TILE_PX)
        first = _SIZE.size + 4 * len(self._tiles)
        if first > len(data):
            raise self._decode_error()
        ends = [*accumulate(struct.unpack_from(f"<{len(self._tiles)}I", data, _SIZE.size), initial=first)]
        if ends[-1] != len(data):
            raise self._decode_error()
        self._bounds = [*pairwise(ends)]
        self._image: Any = np.zeros(shape, blank.dtype)
        given: Any = self._image.view()
        given.flags.writeable = False
        self._read_only_view: AnyImage = given

    @property
    def size_px(self) -> tuple[int, int]:
        height, width = self._image.shape[:2]
        return width, height

    def decode(self, region: Region | None) -> AnyImage:
        """Return the image, read-only, decoded at least within the region; None for all of it."""
        width, height = self.size_px
        region = Region(0, 0, width, height) if region is None else region.clip(width, height)
        for row in range(region.top // TILE_PX, -(-region.bottom // TILE_PX)):
            for column in range(region.left // TILE_PX, -(-region.right // TILE_PX)):
                number = row * self._columns + column
                begin, end = self._bounds[number]
                if begin < end:
                    tile, place = self._decode(self._data[begin:end]), self._image[self._tiles[number]]
                    if tile is None or tile.shape != place.shape:
                        raise self._decode_error()
                    place[:] = tile
                    self._bounds[number] = (end, end)
        return self._read_only_view

    def _decode_error(self) -> RecordingUnreadable:
        return RecordingUnreadable(self._path, phrase("not an image"))


_PNG_START = b"\x89PNG\r\n\x1a\n"
_GREY_TYPES = (0, 4)


def read_color(path: Path) -> ByteImage:
    """Read a colour image (H, W, 3) uint8 RGB, read-only."""
    data = _read_checked_bytes(path)
    if data.startswith(_PNG_START):
        bits, color_type = data[24], data[25]
        if color_type in _GREY_TYPES:
            raise FrameDamaged(path, phrase("a grey image instead of a colour image"))
        if bits > 8:
            raise FrameDamaged(path, phrase("{bits} bits per colour instead of 8", bits=bits))
    return _decode_or_raise(path, data, cv2.IMREAD_COLOR_RGB)


def read_depth(path: Path) -> DepthImage:
    """Read a depth image (H, W) uint16, read-only."""
    depth = _decode_or_raise(path, _read_checked_bytes(path), cv2.IMREAD_UNCHANGED)
    if depth.ndim != 2:
        raise FrameDamaged(path, phrase("a colour image instead of a 16-bit depth image"))
    if depth.dtype != np.uint16:
        raise FrameDamaged(path, phrase("a depth image of {value} bits instead of 16", value=8 * depth.dtype.itemsize))
    return depth


def _read_checked_bytes(path: Path) -> bytes:
    """Return the bytes of a file; all checksums of a PNG are verified.

    A decoder may fill a damaged rest with grey.
    """
    try:
        data = path.read_bytes()
    except FileNotFoundError as cause:
        raise FrameDamaged(path, phrase("missing")) from cause
    except OSError as cause:
        raise FrameDamaged(path, cause.strerror or phrase("cannot be opened")) from cause
    if not data:
        raise FrameDamaged(path, phrase("empty file"))
    if data.startswith(_PNG_START) and not _is_png_complete(data):
        raise FrameDamaged(path, phrase("truncated or altered"))
    return data


def _is_png_complete(data: bytes) -> bool:
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


def _decode_or_raise(path: Path, data: bytes, flags: int) -> NDArray[Any]:
    picture = _decode(data, flags)
    if picture is None:
        raise FrameDamaged(path, phrase("not an image"))
    return picture
