"""C3D: markers of a session, and points of other programs in all six encodings (user guide of c3d.org).

Written are millimetres in camera axes, the residual above 0 for a seen marker, 0 predicted, -1 none: header, parameters
and data in blocks of 512 bytes, Intel order, float. Of the libraries, ezc3d 1.7 stops at 65,535 frames and swaps the
bytes of residual and camera mask. Read are PC, SGI and DEC, integer and float.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from carpus.core.formats.export_item import (
    CAMERA_AXES,
    ExportItem,
    UniformTimes,
    is_measured,
    joint_centres_cam_m,
    repetition_events,
)
from carpus.core.formats.output_files import open_new_file
from carpus.core.model.errors import ReferenceUnreadable
from carpus.core.model.phrase import phrase
from carpus.core.model.types import FloatArray
from carpus.core.session.values import Event, Session

BLOCK = 512
INTEL, DEC, SGI = 84, 85, 86
RESIDUAL_STEP_MM = 0.05
"""One count of a residual; negative in POINT:SCALE, which means float."""
MAX_RESIDUAL_COUNT = 127
CAMERA_MASK = 1
"""Carpus has one camera."""
MAX_HEADER_COUNT = 65535
MAX_DIMENSION = 255
"""Longest dimension of a parameter."""
MAX_TEXT_BYTES = 96
JOINT_PREFIX = "J_"
MAX_BYTES = 1 << 31
_METRES = {"mm": 1e-3, "m": 1.0, "cm": 1e-2, "dm": 1e-1, "in": 0.0254}


@dataclass(frozen=True, slots=True)
class C3dPoints:
    """P points over K frames: ``position_mm`` (K, P, 3), NaN for none.

    ``residual_mm`` (K, P) is above 0 for a seen marker, else 0.
    """

    labels: tuple[str, ...]
    descriptions: tuple[str, ...]
    position_mm: FloatArray
    residual_mm: FloatArray


def write(take: ExportItem, folder: Path) -> list[Path]:
    """Write ``NAME.c3d``; return its path."""
    path = folder / f"{take.name}.c3d"
    even = take.times
    points = build_points(take.session, even)
    with open_new_file(path) as file:
        # lay out header and parameters, twice to know where the data begin
        first = b"".join(_parameter_groups(take, even, points, 0))
        blocks = -(-(len(first) + 4 + 1) // BLOCK)
        data_block = 2 + blocks
        parameters = b"".join(_parameter_groups(take, even, points, data_block))
        section = struct.pack("<BBBB", 1, 0x50, blocks, INTEL) + parameters
        head = _header(len(points.labels), len(even), even.rate_hz, data_block) + section.ljust(blocks * BLOCK, b"\0")
        file.write(head)
        for some in _point_data(points):
            file.write(some)
        file.write(b"\0" * (-file.tell() % BLOCK))
    return [path]


def build_points(session: Session, times: UniformTimes) -> C3dPoints:
    """Return the markers, then the joint centres of the whole hand, which are computed."""
    names = session.header.protocol.markers
    discs = times.interpolate(session.markers.position_cam_m)
    nearest = times.row_index
    seen = is_measured(session)[nearest] & (nearest >= 0)[:, None] if len(nearest) else np.zeros((0, len(names)), bool)
    residual = model_residual_mm(session)[nearest] if len(nearest) else np.zeros((0, len(names)))
    # What was seen has a residual, however well it fits.
    residual = np.where(seen, np.maximum(np.nan_to_num(residual, nan=RESIDUAL_STEP_MM), RESIDUAL_STEP_MM), 0.0)
    labels, words = names, tuple(f"paper disc {name} on the skin" for name in names)
    if session.header.joint_names:
        joints = times.interpolate(joint_centres_cam_m(session))
        discs = np.concatenate((discs, joints), axis=1)
        residual = np.concatenate((residual, np.zeros(joints.shape[:2])), axis=1)
        labels += tuple(f"{JOINT_PREFIX}{name}" for name in names)
        words += tuple(f"{'finger tip' if 'TIP' in name else 'joint centre'} {name}, computed" for name in names)
    return C3dPoints(labels, words, 1e3 * discs, residual)


def model_residual_mm(session: Session) -> FloatArray:
    """Return the distance (N, M) of the model's marker from the blob, across the line of sight."""
    place, camera = session.markers.position_cam_m, session.camera
    ideal = camera.project(np.where(place[..., 2:] > 0.0, place, np.nan))
    pixel = camera.distort(np.nan_to_num(ideal).reshape(-1, 2)).reshape(ideal.shape)
    off_px = np.linalg.norm(pixel - session.markers.measured_px, axis=-1)
    return np.asarray(1e3 * off_px * place[..., 2] / math.sqrt(camera.fx_px * camera.fy_px))


def _point_data(points: C3dPoints, batch_rows: int = 4096) -> Iterator[bytes]:
    for begin in range(0, len(points.position_mm), batch_rows):
        place = points.position_mm[begin : begin + batch_rows]
        known = np.asarray(np.isfinite(place).all(axis=-1))
        counts = np.ceil(points.residual_mm[begin : begin + batch_rows] / RESIDUAL_STEP_MM - 1e-9)
        counts = np.clip(counts, 0, MAX_RESIDUAL_COUNT)
        word = np.where(counts > 0, CAMERA_MASK * 256 + counts, 0.0)
        out = np.zeros((*known.shape, 4), dtype="<f4")
        out[..., :3] = np.where(known[..., None], place, 0.0)
        out[..., 3] = np.where(known, word, -1.0)
        yield out.tobytes()


def _header(points: int, frames: int, rate_hz: float, data_block: int) -> bytes:
    head = struct.pack(
        "<BBHHHHHfHHf",
        2, 0x50, points, 0, 1, min(max(frames, 1), MAX_HEADER_COUNT), 0, -RESIDUAL_STEP_MM, data_block, 0, rate_hz,
    )  # fmt: skip
    out = bytearray(head.ljust(BLOCK, b"\0"))
    struct.pack_into("<H", out, 2 * 149, 12345)  # labels of events have four letters
    return bytes(out)


def _parameter_groups(take: ExportItem, times: UniformTimes, points: C3dPoints, data_block: int) -> Iterator[bytes]:
    session, header = take.session, take.session.header
    frames = len(times)
    yield _group(1, "POINT", "three-dimensional points")
    yield _integers(1, "USED", [len(points.labels)])
    yield _floats(1, "SCALE", [-RESIDUAL_STEP_MM])
    yield _floats(1, "RATE", [times.rate_hz])
    yield _integers(1, "DATA_START", [data_block])
    yield _integers(1, "FRAMES", [min(frames, MAX_HEADER_COUNT)])
    yield _floats(1, "LONG_FRAMES", [float(frames)])
    yield _texts(1, "LABELS", points.labels)
    yield _texts(1, "DESCRIPTIONS", points.descriptions)
    yield _text(1, "UNITS", "mm", as_list=True)
    yield _text(1, "X_SCREEN", "+X")
    yield _text(1, "Y_SCREEN", "-Y")
    yield _group(2, "ANALOG", "none")
    yield _integers(2, "USED", [0])
    yield _floats(2, "RATE", [0.0])
    yield _floats(2, "GEN_SCALE", [1.0])
    yield _floats(2, "SCALE", [])
    yield _integers(2, "OFFSET", [])
    yield _group(3, "FORCE_PLATFORM", "none")
    yield _integers(3, "USED", [0])
    yield _group(4, "TRIAL", "length of long recordings")
    yield _integers(4, "ACTUAL_START_FIELD", [1, 0])
    yield _integers(4, "ACTUAL_END_FIELD", [frames & 0xFFFF, frames >> 16])
    yield _floats(4, "CAMERA_RATE", [times.rate_hz])
    yield _group(5, "SUBJECTS", "pseudonym")
    yield _integers(5, "USED", [1])
    yield _integers(5, "IS_STATIC", [0])
    yield _texts(5, "NAMES", [header.subject_id or "unknown"])
    yield _group(6, "MANUFACTURER", "program")
    made_by = take.provenance["made_by"]
    yield _text(6, "COMPANY", "Carpus")
    yield _text(6, "SOFTWARE", "Carpus")
    yield _text(6, "VERSION_LABEL", made_by["version"])
    yield from _events((*session.events, *repetition_events(take)), header.hand, times.start_s)
    yield _group(8, "CARPUS", "of what, by what")
    texts = {
        "FRAME": CAMERA_AXES,
        "RESIDUALS": "above 0 seen, 0 predicted or computed, -1 not known",
        "ESTIMATE": "filter",
        "SAMPLING": "even, on the line between two pictures",
        "HAND": header.hand,
        "PROTOCOL": header.protocol.name,
        "EXERCISE": header.exercise,
        "REVISION": made_by["revision"],
        "SESSION_ID": header.session_id,
        "RECORDING_ID": header.recording_id,
        "RECORDED": take.provenance.get("recorded", ""),
        "MADE": take.provenance.get("made", ""),
        "SESSION_SHA256": take.provenance["of"].get("session_sha256", ""),
        "REC_SHA256": take.provenance["of"].get("recording_sha256", ""),
        "SETTINGS_SHA256": take.provenance["tracked_by"]["settings_sha256"],
        "INTRINSICS": f"{session.camera.origin}: fx {session.camera.fx_px:.3f} fy {session.camera.fy_px:.3f} "
        f"cx {session.camera.cx_px:.3f} cy {session.camera.cy_px:.3f}",
    }
    for name, text in texts.items():
        if text:
            yield _text(8, name, text)
    yield b"\0\0"


def _events(happened: Sequence[Event], hand: str, start_s: float) -> Iterator[bytes]:
    events = sorted(happened, key=lambda event: event.time_s)
    yield _group(7, "EVENT", "what happened")
    yield _integers(7, "USED", [min(len(events), 32767)])
    for place in range(0, len(events), MAX_DIMENSION):
        some: Sequence[Event] = events[place : place + MAX_DIMENSION]
        suffix = "" if not place else str(place // MAX_DIMENSION + 1)
        side = "Right" if hand == "right" else "Left"
        yield _texts(7, f"CONTEXTS{suffix}", [side] * len(some))
        yield _texts(7, f"LABELS{suffix}", [event.kind for event in some])
        yield _texts(7, f"DESCRIPTIONS{suffix}", [event.text for event in some])
        times = [value for event in some for value in divmod(max(event.time_s - start_s, 0.0), 60.0)]
        yield _parameter(7, f"TIMES{suffix}", 4, (2, len(some)), np.array(times, dtype="<f4").tobytes())


def _group(number: int, name: str, words: str) -> bytes:
    text, description = name.encode(), words.encode()
    return (
        struct.pack("<bb", len(text), -number)
        + text
        + struct.pack("<HB", 3 + len(description), len(description))
        + description
    )


def _parameter(number: int, name: str, kind: int, shape: tuple[int, ...], data: bytes) -> bytes:
    text = name.encode()
    body = struct.pack("<bB", kind, len(shape)) + bytes(shape) + data + b"\0"
    return struct.pack("<bb", len(text), number) + text + struct.pack("<H", 2 + len(body)) + body


def _integers(number: int, name: str, values: Sequence[int]) -> bytes:
    shape = () if len(values) == 1 else (len(values),)
    return _parameter(number, name, 2, shape, struct.pack(f"<{len(values)}H", *values))


def _floats(number: int, name: str, values: Sequence[float]) -> bytes:
    shape = () if len(values) == 1 else (len(values),)
    return _parameter(number, name, 4, shape, struct.pack(f"<{len(values)}f", *values))


def _text(number: int, name: str, text: str, as_list: bool = False) -> bytes:
    data = _to_bytes(text, MAX_DIMENSION)
    return _parameter(number, name, -1, (len(data), 1) if as_list else (len(data),), data)


def _texts(number: int, name: str, texts: Sequence[str]) -> bytes:
    each = [_to_bytes(text, MAX_TEXT_BYTES) for text in texts]
    length = max(map(len, each), default=0)
    data = b"".join(one.ljust(length) for one in each)
    return _parameter(number, name, -1, (length, len(each)), data)


def _to_bytes(text: str, max_bytes: int) -> bytes:
    """Encode a text on one line, cut between letters."""
    data = " ".join(text.split()).encode()[:max_bytes]
    return data.decode("utf-8", "ignore").encode()


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
