"""The depth codec of .oni files against a decoder written from the description."""

from __future__ import annotations

import struct

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from carpus.core.capture.files.oni_format import Codec, decode_depth
from tests.capture.oni_writer import encode_depth


def decode(data: bytes, pixels: int) -> list[int]:
    """Pixel by pixel, by the description of the format."""
    (count,) = struct.unpack_from("<H", data)
    table = struct.unpack_from(f"<{count}H", data, 2)
    position = 2 + 2 * count
    (index,) = struct.unpack_from("<H", data, position)
    position += 2
    out = [table[index]]
    while position < len(data):
        byte = data[position]
        position += 1
        if 0xE0 <= byte < 0xFF:
            out += [table[index]] * (2 * (byte - 0xE0))
            continue
        if byte != 0xFF:
            index -= (byte >> 4) - 6
            out.append(table[index])
            low = byte & 0x0F
            if low == 0x0D:
                continue
            if low != 0x0F:
                index -= low - 6
                out.append(table[index])
                continue
        if data[position] & 0x80:
            index -= data[position] - 192
            position += 1
        else:
            index = data[position] << 8 | data[position + 1]
            position += 2
        out.append(table[index])
    assert len(out) == pixels
    return out


def pictures() -> list[NDArray[np.uint16]]:
    rng = np.random.default_rng(1)
    return [
        np.full((48, 64), 700, np.uint16),
        np.full((1, 1), 9, np.uint16),
        np.array([[1, 2]], np.uint16),
        rng.integers(0, 30000, (40, 50)).astype(np.uint16),
        (np.cumsum(rng.integers(-9, 10, (48, 64)), 1) + 3000).astype(np.uint16),
        np.repeat(rng.integers(0, 4, 100), rng.integers(1, 80, 100)).astype(np.uint16)[None],
    ]


def assert_comes_back(picture: NDArray[np.uint16]) -> None:
    """By the decoder above and by Carpus's own."""
    assert decode(encode_depth(picture), picture.size) == picture.ravel().tolist()
    read = decode_depth(encode_depth(picture), Codec.DEPTH_TABLE, picture.shape)
    assert read is not None
    assert read.dtype == np.uint16
    assert np.array_equal(read, picture)


@pytest.mark.parametrize("picture", pictures(), ids=lambda picture: f"{picture.shape}")
def test_oni_depth_encoded_image_matches_independent_decoder(picture: NDArray[np.uint16]) -> None:
    assert_comes_back(picture)


@settings(max_examples=200, deadline=None)
@given(st.lists(st.tuples(st.integers(0, 400), st.integers(1, 40)), min_size=1, max_size=40))
def test_oni_depth_any_runs_are_decoded(runs: list[tuple[int, int]]) -> None:
    assert_comes_back(np.repeat([value for value, _ in runs], [length for _, length in runs]).astype(np.uint16)[None])


def test_oni_depth_unchanged_pixels_take_one_byte_for_thirty() -> None:
    flat = encode_depth(np.full((1, 3001), 700, np.uint16))
    assert len(flat) == 2 + 2 + 2 + 100


def test_oni_depth_too_many_values_raise() -> None:
    with pytest.raises(ValueError, match="32769"):
        encode_depth(np.arange(32769, dtype=np.uint16)[None])


def test_oni_depth_without_table_decodes_values() -> None:
    values = np.array([[0, 1, 2, 3, 9, 300, 3, 3, 3, 3, 3, 0]], np.uint16)
    table = np.arange(301, dtype=np.uint16)
    with_all = encode_depth(np.append(table, values)[None])
    assert np.array_equal(decode_depth(with_all, Codec.DEPTH_TABLE, (1, 313)), np.append(table, values)[None])
    without = with_all[2 + 2 * len(table) :]
    assert np.array_equal(decode_depth(without, Codec.DEPTH_PLAIN, (1, 313)), np.append(table, values)[None])


def test_oni_depth_raw_is_decoded() -> None:
    picture = pictures()[3]
    read = decode_depth(picture.astype("<u2").tobytes(), Codec.RAW, (40, 50))
    assert np.array_equal(read, picture)  # type: ignore[arg-type]
    assert decode_depth(picture.tobytes()[:-2], Codec.RAW, (40, 50)) is None


@settings(max_examples=300, deadline=None)
@given(st.binary(max_size=300), st.sampled_from([Codec.DEPTH_TABLE, Codec.DEPTH_PLAIN, Codec.RAW]))
def test_oni_depth_any_bytes_give_image_or_none(data: bytes, codec: bytes) -> None:
    read = decode_depth(data, codec, (4, 5))
    assert read is None or read.shape == (4, 5)


@pytest.mark.parametrize("lost", [1, 2, 3, 40])
def test_oni_depth_truncated_is_none(lost: int) -> None:
    picture = pictures()[3]
    assert decode_depth(encode_depth(picture)[:-lost], Codec.DEPTH_TABLE, (40, 50)) is None
