"""Checks of a session file: of its structure, for values that no hand and no clock can have, and its checksum.

HDF5 follows links into other files, reads any file as external storage and allocates whatever a shape claims. All of
that is rejected before a value is read (hard links, storage inside the file, declared types and sizes).

The checksum of a finished session is one SHA-256 over its whole content, so that any later change shows. Each chunk
also has a checksum (HDF5's Fletcher32), which finds a flipped bit when values are read. The SHA-256 also covers texts,
attributes and names. It has no key: whoever changes a file on purpose can compute it again.
"""

from __future__ import annotations

import hashlib
import itertools
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from numpy.typing import NDArray

from carpus.core.calibration.result import Calibration
from carpus.core.model.errors import SessionUnreadable
from carpus.core.model.phrase import phrase
from carpus.core.model.types import Detections
from carpus.core.session import schema
from carpus.core.session.schema import Field
from carpus.core.session.values import Session, SessionHeader


class ContentError(Exception):
    """Raised with a text for content of a session file that cannot be; its reader names the file."""


def damage_error(place: str) -> ContentError:
    """Return the error for a part of a session file, by its path or name."""
    return ContentError(phrase("damaged: {value}", value=place))


MAX_OBJECTS = 400
"""Groups and datasets of one file; the schema has fewer than 100."""
MAX_DEPTH = 6
_PLAIN_LAYOUTS = (h5py.h5d.COMPACT, h5py.h5d.CONTIGUOUS, h5py.h5d.CHUNKED)
_PLAIN_FILTERS = (h5py.h5z.FILTER_FLETCHER32, h5py.h5z.FILTER_DEFLATE, h5py.h5z.FILTER_SHUFFLE)
MAX_COMPRESSION_RATIO = 1032
"""Largest ratio of the gzip format."""
_KINDS = {"f": "f", "u": "iu", "i": "iu", "t": "SO", "r": "V"}
_FIELDS = {field.path: field for field in schema.ALL_FIELDS}
_ENDS_OF_RAW = {field.path for field in schema.RAW_STREAMS}


def check_structure(file: h5py.File, size_bytes: int) -> None:
    """Raise :class:`ContentError` unless the file contains only plain groups and datasets of the schema's size."""
    whole = bool(file.attrs.get("complete", False))
    seen: set[tuple[int, int]] = set()
    waiting: list[tuple[str, h5py.h5g.GroupID, int]] = [("", h5py.h5g.open(file.id, b"/"), 0)]
    declared = 0
    while waiting:
        place, group, depth = waiting.pop()
        names = list(itertools.islice(group, MAX_OBJECTS + 1))
        if depth > MAX_DEPTH or len(names) + len(seen) > MAX_OBJECTS:  # perhaps without an end
            raise damage_error(place)
        for name in names:
            inside = f"{place}/{name.decode('utf-8', 'replace')}"
            if group.links.get_info(name).type != h5py.h5l.TYPE_HARD:
                raise damage_error(inside)
            info = h5py.h5o.get_info(group, name)
            key = (info.fileno, info.addr)
            if key in seen or (inside in _FIELDS and info.type != h5py.h5o.TYPE_DATASET):
                raise damage_error(inside)
            seen.add(key)
            if info.type == h5py.h5o.TYPE_GROUP:
                waiting.append((inside, h5py.h5g.open(group, name), depth + 1))
            elif info.type == h5py.h5o.TYPE_DATASET:
                dataset = h5py.Dataset(h5py.h5d.open(group, name))
                plan = dataset.id.get_create_plist()
                filters = [plan.get_filter(number)[0] for number in range(plan.get_nfilters())]
                is_inside = plan.get_layout() in _PLAIN_LAYOUTS and plan.get_external_count() == 0
                if not is_inside or not set(filters) <= set(_PLAIN_FILTERS):
                    raise damage_error(inside)
                if inside in _FIELDS:
                    declared += _check_size(_FIELDS[inside], dataset, size_bytes, whole=whole)
    if declared > MAX_COMPRESSION_RATIO * size_bytes + 65536:
        raise damage_error("/")


def _check_size(field: Field, dataset: h5py.Dataset, file_bytes: int, *, whole: bool) -> int:
    """Return the bytes that reading a dataset takes; raises if type, axes or size are not as declared."""
    kind, shape = dataset.dtype.kind, dataset.shape
    is_text = kind != "O" or h5py.check_string_dtype(dataset.dtype) is not None
    if kind not in _KINDS[field.dtype[0]] or not is_text or shape is None or len(shape) != len(field.shape):
        raise damage_error(field.path)
    claimed = math.prod(int(length) for length in shape) * dataset.dtype.itemsize
    stored = int(dataset.id.get_storage_size())
    if dataset.chunks is not None and field.shape[0] in schema.GROWING_AXES and not whole:
        # A flush that was cut short leaves rows announced whose chunk is not there; they are not read.
        claimed = min(claimed, count_stored_rows(dataset) * math.prod(map(int, shape[1:])) * dataset.dtype.itemsize)
        if math.prod(dataset.chunks) * dataset.dtype.itemsize > 1 << 27:
            raise damage_error(field.path)
    packed = MAX_COMPRESSION_RATIO if dataset.compression else 1
    if stored > file_bytes or claimed > packed * max(stored, 0) + 4096:
        raise damage_error(field.path)
    return 0 if field.path in _ENDS_OF_RAW else claimed


def count_stored_rows(dataset: h5py.Dataset) -> int:
    """Return the rows for which a growing dataset has chunks; its shape may claim more."""
    step, *row = dataset.chunks
    chunk_bytes = step * math.prod(row) * dataset.dtype.itemsize + (4 if dataset.fletcher32 else 0)
    return int(dataset.id.get_storage_size()) // chunk_bytes * int(step) if chunk_bytes else int(dataset.shape[0])


MAX_DURATION_S = 86_400.0
MAX_TIME_S = 1e11
"""Times of a recording count from anywhere, but no clock counts for 3000 years."""
MAX_ANGLE_RAD = 2.0 * math.pi
MAX_POSITION_M = 100.0
MAX_SD_RAD = 1e3
MAX_PIXEL = float(1 << 16)
ROTATION_TOLERANCE = 1e-3
MAX_COVARIANCE_M2, COVARIANCE_TOLERANCE_M2 = 1.0, 1e-9
MAX_TEXT_CHARACTERS, MAX_PARAMETERS_CHARACTERS = 200, 1 << 20
MAX_PARAMETERS_DEPTH = 40
STATUS_COUNT = 4
_OWN_TEXTS = ("session_id", "recording_id", "subject_id", "recorded", "created")


def check_header(header: SessionHeader, parameters: object) -> None:
    """Raise :class:`ContentError` for texts that cannot be a pseudonym, an exercise or settings."""
    for name in (*_OWN_TEXTS, "exercise", "software_version", "origin"):
        text: str = getattr(header, name)
        is_missing = name == "session_id" and not text.strip()
        if is_missing or len(text) > MAX_TEXT_CHARACTERS or not (text.isprintable() or name == "origin"):
            raise damage_error(name)
    if _depth(parameters) > MAX_PARAMETERS_DEPTH or len(header.parameters) > MAX_PARAMETERS_CHARACTERS:
        raise damage_error("parameters")


def _depth(value: object) -> int:
    inside = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    return 1 + max(map(_depth, inside), default=0)


def check_values(session: Session) -> None:
    """Raise :class:`ContentError` for impossible numbers; NaN stands for unknown, and compares as neither."""
    times_s = session.timestamp_s
    if not np.isfinite(times_s).all() or (np.abs(times_s) > MAX_TIME_S).any() or (np.diff(times_s) <= 0.0).any():
        raise damage_error("/frames/timestamp")
    if len(times_s) and times_s[-1] - times_s[0] > MAX_DURATION_S:
        raise ContentError(phrase("times span more than a day: damaged, or a clock jumped"))
    limits: list[tuple[str, NDArray[Any], float, float]] = [
        ("/frames/status", session.status, 0, STATUS_COUNT - 1),
        ("/markers/position_camera", session.markers.position_cam_m, -MAX_POSITION_M, MAX_POSITION_M),
        ("/calibration/marker_position", session.calibration.marker_position_w0_m, -MAX_POSITION_M, MAX_POSITION_M),
        ("/calibration/translation", session.calibration.translation_w0_cam_m, -MAX_POSITION_M, MAX_POSITION_M),
    ]
    for group, motion in (("", session.motion), ("/smoothed", session.smoothed)):
        if motion is not None:
            limits += [
                (f"{group}/wrist/angles", motion.angles_rad, -MAX_ANGLE_RAD, MAX_ANGLE_RAD),
                (f"{group}/joints/angles", motion.joint_angles_rad, -MAX_ANGLE_RAD, MAX_ANGLE_RAD),
                (f"{group}/wrist/angles_sd", motion.angles_sd_rad, 0.0, MAX_SD_RAD),
                (f"{group}/joints/angles_sd", motion.joint_angles_sd_rad, 0.0, MAX_SD_RAD),
                (f"{group}/wrist/position", motion.position_m, -MAX_POSITION_M, MAX_POSITION_M),
                (f"{group}/joints/position", motion.joint_position_m, -MAX_POSITION_M, MAX_POSITION_M),
            ]
    for path, values, low, high in limits:
        if ((values < low) | (values > high)).any():
            raise damage_error(path)
    camera = session.camera
    numbers = (camera.fx_px, camera.fy_px, camera.cx_px, camera.cy_px, *camera.distortion)
    is_camera = all(map(math.isfinite, numbers)) and min(camera.fx_px, camera.fy_px) > 0.0
    if not is_camera or not 1 <= min(camera.width_px, camera.height_px) <= 1 << 16:
        raise damage_error("/camera")
    if not all(math.isfinite(event.time_s) for event in session.events):
        raise damage_error("/events/time")


def check_calibration(path: Path, calibration: Calibration) -> None:
    """Raise :class:`SessionUnreadable` for a calibration from which no hand can be tracked."""
    turn, spread = calibration.rotation_w0_cam, calibration.marker_covariance_w0_m2
    known = (turn, calibration.translation_w0_cam_m, calibration.marker_position_w0_m, calibration.start_angles_rad)
    good = all(np.isfinite(values).all() for values in known)
    good = good and bool(np.abs(turn @ turn.T - np.eye(3)).max() < ROTATION_TOLERANCE and np.linalg.det(turn) > 0.0)
    good = good and bool((np.abs(calibration.start_angles_rad) <= MAX_ANGLE_RAD).all())
    if good and len(spread) and not np.isnan(spread).all():
        good = bool(np.isfinite(spread).all() and np.abs(spread).max() <= MAX_COVARIANCE_M2)
        good = good and float(np.linalg.eigvalsh(spread).min()) >= -COVARIANCE_TOLERANCE_M2
    if not good:
        raise SessionUnreadable(path, phrase("damaged: the calibration in it does not describe a hand"))


def check_detections(detections: Detections) -> None:
    """Raise :class:`ContentError` for impossible blobs; a depth may be unknown."""
    good = bool((np.abs(detections.pixel) <= MAX_PIXEL).all())  # NaN is not
    good = good and bool(np.isfinite(detections.area_px).all() and np.isfinite(detections.similarity).all())
    for values in (detections.depth_m, detections.depth_sd_m):
        good = good and not bool(((values < 0.0) | (values > MAX_POSITION_M)).any())
    if not good:
        raise damage_error("/detections")


CHECKSUM_ATTRIBUTE = "seal"
PREFIX = "sha256:"
_BLOCK_BYTES = 1 << 23


def compute_checksum(file: h5py.File, known: Mapping[str, str] | None = None) -> str:
    """Return the checksum of a file; datasets with ``known`` digests are not read again."""
    known = known or {}
    whole = hashlib.sha256()
    paths: list[str] = []
    file.visit(paths.append)
    for place in ("/", *(f"/{path}" for path in sorted(paths))):
        thing = file[place]
        whole.update(f"{place}\n".encode())
        for name in sorted(thing.attrs):
            if (place, name) != ("/", CHECKSUM_ATTRIBUTE):
                whole.update(f"@{name} {_serialize_attribute(thing.attrs[name])}\n".encode())
        if isinstance(thing, h5py.Dataset):
            digest = known.get(place) or hash_dataset(thing)
            dtype = "text" if thing.dtype.kind == "O" else thing.dtype.newbyteorder("<").str
            whole.update(f"={dtype} {tuple(map(int, thing.shape))} {digest}\n".encode())
    return PREFIX + whole.hexdigest()


def hash_dataset(dataset: h5py.Dataset) -> str:
    """Return the SHA-256 of all values of a dataset, read in pieces."""
    digest = hashlib.sha256()
    if dataset.shape == ():
        digest.update(to_bytes(np.asarray(dataset[()])))
        return digest.hexdigest()
    row_bytes = max(1, int(np.prod(dataset.shape[1:])) * dataset.dtype.itemsize)
    step = max(1, _BLOCK_BYTES // row_bytes)
    if dataset.chunks:
        step = max(dataset.chunks[0], step // dataset.chunks[0] * dataset.chunks[0])
    for begin in range(0, dataset.shape[0], step):
        digest.update(to_bytes(np.asarray(dataset[begin : begin + step])))
    return digest.hexdigest()


def to_bytes(values: np.ndarray) -> bytes:
    """Return values as bytes for hashing."""
    if values.dtype.kind != "O":
        return np.ascontiguousarray(values).astype(values.dtype.newbyteorder("<"), copy=False).tobytes()
    texts = [text if isinstance(text, bytes) else str(text).encode() for text in values.ravel().tolist()]
    return b"".join(b"%d:%s" % (len(text), text) for text in texts)


def _serialize_attribute(value: Any) -> str:
    """Return an attribute as text, the same for every way of storing the same value."""
    if isinstance(value, bytes):
        return repr(value.decode("utf-8", "replace"))
    if isinstance(value, np.ndarray):
        return "[" + ", ".join(_serialize_attribute(one) for one in value.ravel().tolist()) + "]"
    if isinstance(value, np.generic):
        return _serialize_attribute(value.item())
    return repr(value)
