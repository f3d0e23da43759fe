"""Pictures in tiles: the same as whole, unpacked where they are looked at, and damage is told."""

from __future__ import annotations

from functools import partial
from pathlib import Path

import numpy as np
import pytest

from carpus.core.capture.files.image_codec import (
    TILE_PX,
    TiledImage,
    decode_color,
    encode_color,
    pack_tiles,
)
from carpus.core.model.errors import RecordingUnreadable
from carpus.core.model.types import ByteImage, Region

WIDTH, HEIGHT = 250, 130
COLOR, DEPTH = np.empty((0, 0, 3), np.uint8), np.empty((0, 0), np.uint16)


def noisy_color() -> ByteImage:
    return np.random.default_rng(3).integers(1, 256, (HEIGHT, WIDTH, 3), dtype=np.uint8)


def color_from(data: bytes) -> TiledImage[ByteImage]:
    return TiledImage(Path("take"), data, COLOR, decode_color)


def test_tiled_jpeg_equals_whole_jpeg() -> None:
    color = noisy_color()
    back = color_from(pack_tiles(color, encode_color)).decode(None)
    np.testing.assert_array_equal(back, decode_color(encode_color(color)))
    assert not back.flags.writeable


@pytest.mark.parametrize(
    "part",
    [
        Region(0, 0, 1, 1), Region(79, 79, 81, 81), Region(160, 80, 240, 130), Region(-50, 100, 20, 900),
        Region(240, 0, 250, 130), Region(-20, -20, -5, -5), Region(300, 10, 400, 20),
    ],
)  # fmt: skip
def test_tiled_image_decodes_only_the_region(part: Region) -> None:
    color = noisy_color()
    tiled = color_from(pack_tiles(color, partial(encode_color, lossless=True)))
    seen = tiled.decode(part)
    inside = np.s_[max(part.top, 0) : max(part.bottom, 0), max(part.left, 0) : max(part.right, 0)]
    np.testing.assert_array_equal(seen[inside], color[inside])
    columns = min(part.right, WIDTH) // TILE_PX - max(part.left, 0) // TILE_PX + 1
    assert seen.any(axis=-1).sum() <= max(columns, 0) * TILE_PX * HEIGHT
    np.testing.assert_array_equal(tiled.decode(None), color)


@pytest.mark.parametrize(
    "damaged",
    [
        lambda data: b"",
        lambda data: data[:40],
        lambda data: data[:-1],
        lambda data: data + b"x",
        lambda data: b"\xff\xff\xff\xff" + data[4:],
        lambda data: data[:36] + bytes(len(data) - 36),
        lambda data: b"\xfb" + data[1:],  # a column wider
    ],
)
def test_tiled_image_invalid_data_raises(damaged: object) -> None:
    data = pack_tiles(noisy_color(), encode_color)
    with pytest.raises(RecordingUnreadable, match="take"):
        color_from(damaged(data)).decode(None)  # type: ignore[operator]
