"""Reader of C3D in all six encodings: PC, SGI and DEC, integer and float (user guide of c3d.org)."""

from __future__ import annotations

import math
import struct
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from carpus.core.model.errors import ReferenceUnreadable
from carpus.core.model.phrase import phrase
from carpus.core.model.types import FloatArray

BLOCK = 512
INTEL, DEC, SGI = 84, 85, 86
MAX_BYTES = 1 << 31
_METRES = {"mm": 1e-3, "m": 1.0, "cm": 1e-2, "dm": 1e-1, "in": 0.0254}


@dataclass(frozen=True, slots=True)
class PointTrack:
    """Points of another program: ``time_s`` (K,), ``names`` (P,), ``position_m`` (K, P, 3) with NaN for none."""

    time_s: FloatArray
    names: tuple[str, ...]
    position_m: FloatArray
    unit: str


def read_c3d(path: Path) -> PointTrack:
    """Read the points of a C3D file. Raises :class:`ReferenceUnreadable`."""
    try:
        if path.stat().st_size > MAX_BYTES:
            raise ReferenceUnreadable(path, phrase("larger than 2 GB"))
        content = path.read_bytes()
    except OSError as cause:
        raise ReferenceUnreadable(path, cause.strerror or "") from cause
    try:
        if len(content) < 2 * BLOCK or content[1] != 0x50:
            raise ReferenceUnreadable(path, "no C3D")
        at = (content[0] - 1) * BLOCK
        processor = content[at + 3]
        if processor not in (INTEL, DEC, SGI):
            raise ReferenceUnreadable(path, phrase("unknown processor type {processor}", processor=processor))
        order = ">" if processor == SGI else "<"
        parameters = _read_parameters(content, at, order, processor == DEC)
        point = parameters["POINT"]
        used = int(point["USED"][0])
        scale = float(point["SCALE"][0])
        rate_hz = float(point["RATE"][0])
        first, last = (value & 0xFFFF for value in struct.unpack_from(f"{order}HH", content, 6))
        analog = struct.unpack_from(f"{order}H", content, 4)[0]
        begin = (int(point.get("DATA_START", [0])[0]) & 0xFFFF or struct.unpack_from(f"{order}H", content, 16)[0]) - 1
        is_float = scale < 0.0
        word = 4 if is_float else 2
        row_bytes = (4 * used + analog) * word
        if not used or rate_hz <= 0.0 or not np.isfinite(rate_hz):
            raise ReferenceUnreadable(path, phrase("no points, or no rate stated"))
        stored_rows = (len(content) - begin * BLOCK) // row_bytes
        frames = min(_frame_count(parameters, last - first + 1), stored_rows)
        if frames < 1:
            raise ReferenceUnreadable(path, phrase("no frames"))
        raw = np.frombuffer(content, np.uint8, frames * row_bytes, begin * BLOCK).reshape(frames, row_bytes)
        values = _to_numbers(raw[:, : 4 * used * word], order, processor == DEC, is_float).reshape(frames, used, 4)
        place = values[..., :3] if is_float else values[..., :3] * np.float32(scale)
        unit = str(point.get("UNITS", ["mm"])[0]).strip().lower() or "mm"
        if unit not in _METRES:
            raise ReferenceUnreadable(path, phrase("unit {unit}", unit=unit))
        known = values[..., 3] >= 0.0
        place_m = np.where(known[..., None], place.astype(np.float64) * _METRES[unit], np.nan)
        names = [str(name).strip() for k in ("", *map(str, range(2, 99))) for name in point.get(f"LABELS{k}", [])]
        names = (names + [f"point {k + 1}" for k in range(used)][len(names) :])[:used]
        return PointTrack(np.arange(frames) / rate_hz, tuple(names), zeros_to_nan(place_m), unit)
    except (ValueError, IndexError, KeyError, struct.error, OverflowError) as cause:
        raise ReferenceUnreadable(path, phrase("damaged, or not C3D")) from cause


def zeros_to_nan(position_m: FloatArray) -> FloatArray:
    """Replace positions (K, P, 3) that are 0, 0, 0 (markers that were not seen) by NaN."""
    return np.where((position_m == 0.0).all(axis=-1, keepdims=True), np.nan, position_m)


def _frame_count(parameters: Mapping[str, Mapping[str, list[Any]]], by_header: int) -> int:
    """Return the number of frames, also where the header's 16 bits do not hold it."""
    trial = parameters.get("TRIAL", {})
    ends = [trial.get(f"ACTUAL_{which}_FIELD", []) for which in ("START", "END")]
    if all(len(end) >= 2 for end in ends):
        start, end = (int(end[0]) % 65536 + 65536 * (int(end[1]) % 65536) for end in ends)
        return end - start + 1
    if "LONG_FRAMES" in parameters["POINT"]:
        return int(parameters["POINT"]["LONG_FRAMES"][0])
    return by_header


def _read_parameters(content: bytes, at: int, order: str, dec: bool) -> dict[str, dict[str, list[Any]]]:
    end = min(len(content), at + BLOCK * content[at + 2])
    groups: dict[int, str] = {}
    found: dict[int, dict[str, list[Any]]] = {}
    here, left = at + 4, end - at
    while here + 2 < end:
        length, number = struct.unpack_from("bb", content, here)
        length = abs(length)
        if not length or not number:
            break
        name = content[here + 2 : here + 2 + length].decode("ascii", "replace").strip().upper()
        here += 2 + length
        step = struct.unpack_from(f"{order}h", content, here)[0]
        if number < 0:
            groups[-number] = name
        else:
            values, size = _read_values(content, here + 2, order, dec)
            left -= size
            if left < 0:  # values that lie over each other: a small file must not become a large one
                raise ValueError("more values than the section holds")
            found.setdefault(number, {})[name] = values
        if step <= 0:
            break
        here += step
    out: dict[str, dict[str, list[Any]]] = {}
    for number, parameters in found.items():
        out.setdefault(groups.get(number, ""), {}).update(parameters)
    return out


def _read_values(content: bytes, here: int, order: str, dec: bool) -> tuple[list[Any], int]:
    """Return a parameter's values and their bytes. Raises ValueError if the file does not hold them."""
    kind, dimensions = struct.unpack_from("bB", content, here)
    shape = list(content[here + 2 : here + 2 + dimensions])
    here += 2 + dimensions
    count = math.prod(shape)
    size = count * abs(kind)
    if here + size > len(content):
        raise ValueError("values beyond the end")
    if kind == -1:
        data = content[here : here + count]
        width = shape[0] if shape else 1
        if len(shape) < 2:
            return [data.decode("utf-8", "replace")], size
        return [data[k : k + width].decode("utf-8", "replace") for k in range(0, count, max(width, 1))], size
    raw = np.frombuffer(content, np.uint8, size, here)
    if kind == 1:
        return list(raw.tolist()), size
    return list(_to_numbers(raw, order, dec, kind == 4).tolist()), size


def _to_numbers(raw: np.ndarray, order: str, dec: bool, is_float: bool) -> np.ndarray:
    """Convert bytes (..., count) to 16-bit integers or 32-bit floats of the writing machine."""
    raw = np.ascontiguousarray(raw)
    if not is_float:
        return raw.view(f"{order}i2").astype(np.float32)
    if not dec:
        return raw.view(f"{order}f4").astype(np.float32)
    words = raw.view("<u2").astype(np.uint32)  # DEC: the upper half comes first, and the exponent counts from 128 + 1
    bits = (words[..., ::2] << 16) | words[..., 1::2]
    return np.where((bits & 0x7F80_0000) == 0, 0.0, bits.view(np.float32) / 4.0).astype(np.float32)
