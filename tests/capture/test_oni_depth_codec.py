"""The depth codec of .oni files against a decoder written from the description."""

from __future__ import annotations

import struct

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from carpus.core.capture.files.oni_format import Codec, decode_depth


def decode(data: bytes) -> list[int]:
    """Pixel by pixel, by the description of the format."""
    (count,) = struct.unpack_from("<H", data)
    table = dict(enumerate(struct.unpack_from(f"<{count}H", data, 2)))
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
    return out


STEPS = st.integers(0x00, 0xCC).filter(lambda byte: byte & 0x0F <= 0x0D).map(lambda byte: bytes([byte]))
RUNS = st.integers(0xE0, 0xEF).map(lambda byte: bytes([byte]))
ESCAPES = st.builds(
    lambda half, near, far: bytes([half]) + far[:2] if far else bytes([half, near]),
    st.sampled_from([0x0F, 0x6F, 0xCF, 0xFF]),
    st.integers(129, 255),
    st.none() | st.integers(0, 0x2FF).map(lambda index: index.to_bytes(2, "big")),
)
TABLE = (np.arange(0x300) * 7 + 500).astype("<u2")


@settings(max_examples=100, deadline=None)
@given(st.lists(STEPS | RUNS | ESCAPES, max_size=60), st.sampled_from([0, 100, 0x2FF]))
def test_oni_depth_any_stream_matches_independent_decoder(parts: list[bytes], first: int) -> None:
    index = first.to_bytes(2, "little") + b"".join(parts)
    data = len(TABLE).to_bytes(2, "little") + TABLE.tobytes() + index
    try:
        expected = decode(data)
    except KeyError:
        assert decode_depth(data, Codec.DEPTH_TABLE, (1, 1)) is None
        return
    shape = (1, len(expected))
    np.testing.assert_array_equal(decode_depth(data, Codec.DEPTH_TABLE, shape), [expected])
    np.testing.assert_array_equal(decode_depth(index, Codec.DEPTH_PLAIN, shape), (np.array([expected]) - 500) // 7)


@settings(max_examples=100, deadline=None)
@given(st.binary(max_size=300), st.sampled_from([Codec.DEPTH_TABLE, Codec.DEPTH_PLAIN, Codec.RAW]))
def test_oni_depth_any_bytes_give_image_or_none(data: bytes, codec: bytes) -> None:
    read = decode_depth(data, codec, (4, 5))
    assert read is None or read.shape == (4, 5)
