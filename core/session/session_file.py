"""Reading of session files by the schema, in the reading process (:mod:`core.session.reader`)."""

from __future__ import annotations

import contextlib
import json
import logging
from collections.abc import Iterator, Sequence
from functools import cached_property
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from numpy.typing import NDArray

from carpus.core.calibration.result import Calibration, CalibrationFinding, Clicks, Verdict
from carpus.core.model import errors
from carpus.core.model.camera import DISTORTION_COEFFICIENT_COUNTS, Camera
from carpus.core.model.dates import moment_from_timestamp, to_iso
from carpus.core.model.depth_sensor import ASSUMED_SENSOR, parse_sensor
from carpus.core.model.errors import CarpusFault
from carpus.core.model.hand.dorsal_surface import DorsalSurface
from carpus.core.model.hand.protocols import get_protocol
from carpus.core.model.phrase import phrase
from carpus.core.model.types import Detections
from carpus.core.session import schema
from carpus.core.session.checks import (
    CHECKSUM_ATTRIBUTE,
    MAX_DURATION_S,
    ContentError,
    check_detections,
    check_header,
    check_structure,
    check_values,
    compute_checksum,
    damage_error,
)
from carpus.core.session.schema import Column, Field, TableLayout
from carpus.core.session.values import (
    DetectionTable,
    EncodedImages,
    Event,
    MarkerSeries,
    Motion,
    QualitySeries,
    RepetitionRow,
    Repetitions,
    Session,
    SessionHeader,
    SessionOutline,
    VerificationResult,
)

log = logging.getLogger(__name__)


def read_session(path: Path) -> Session:
    """Read a session; raises :class:`SessionUnreadable`.

    Detections and images are read by :func:`read_detections` and :func:`read_raw_chunk`.
    """
    with open_session(path) as file:
        return SessionFile(path, file).read_session()


def read_outline(path: Path) -> SessionOutline:
    """Read header, length and state of a session, without its data."""
    with open_session(path) as file:
        return SessionFile(path, file).read_outline()


def read_detections(path: Path) -> DetectionTable:
    """Read the detections of every frame of a session."""
    with open_session(path) as file:
        source = SessionFile(path, file)
        pixel, depth, depth_sd, area, similarity = (source.read_array(field) for field in schema.DETECTION_FIELDS)
        blobs = Detections(pixel, depth, depth_sd, area, similarity)
        check_detections(blobs)
        readings = (*schema.SURFACE_FIELDS, *schema.FINGER_FIELDS)
        kept = [source.read_array(field) if field.path in file else np.empty((0, 0)) for field in readings]
        return DetectionTable(source.read_array(schema.DETECTION_FRAME), blobs, (kept[0], kept[1]), (kept[2], kept[3]))


def verify(path: Path) -> VerificationResult:
    """Verify a session by its chunk checksums and its SHA-256.

    Raises
    ------
    SessionUnreadable
        The file is damaged.
    SessionChanged
        It was changed after it was finished.
    """
    session = read_session(path)
    with open_session(path) as file:
        seal = str(file.attrs.get(CHECKSUM_ATTRIBUTE, ""))
        if seal and seal != compute_checksum(file):
            raise errors.SessionChanged(path)
    if not seal:
        read_detections(path)
    return VerificationResult(len(session), bool(seal))


def has_raw(path: Path) -> bool:
    """Return whether the session has stored images."""
    with open_session(path) as file:
        return all(field.path in file for field in (*schema.RAW_STREAMS, *schema.RAW_ENDS))


def raw_depth_unit_m(path: Path) -> float:
    """Return metres per count of the stored depth images."""
    with open_session(path) as file:
        return float(file["/raw"].attrs[schema.RAW_DEPTH_UNIT])


def read_raw_chunk(path: Path, first_row: int, max_bytes: int) -> Sequence[EncodedImages]:
    """Return the stored images from a row on, at most ``max_bytes`` but at least one; none at the end."""
    with open_session(path) as file:
        source = SessionFile(path, file)
        ends = [source.read_raw_ends(number) for number in range(len(schema.RAW_ENDS))]
        color, depth = (file[field.path] for field in schema.RAW_STREAMS)
        images: list[EncodedImages] = []
        total_bytes = 0
        for row in range(first_row, len(ends[0])):
            color_at, depth_at = (int(each[row - 1]) if row else 0 for each in ends)
            color_to, depth_to = (int(each[row]) for each in ends)
            total_bytes += color_to - color_at + depth_to - depth_at
            if images and total_bytes > max_bytes:
                break
            images.append(EncodedImages(color[color_at:color_to].tobytes(), depth[depth_at:depth_to].tobytes()))
        return images


def read_raw_color(path: Path, row: int) -> bytes:
    """Return the stored colour image of a row; empty if there is none."""
    return next((one.color for one in read_raw_chunk(path, row, 0)), b"")


@contextlib.contextmanager
def open_session(path: Path) -> Iterator[h5py.File]:
    """Open a session file that this version reads; any failure inside becomes :class:`SessionUnreadable`."""
    if not path.is_file():
        if not path.exists():
            raise errors.SessionMissing(path)
        raise errors.SessionUnreadable(path, phrase("a folder") if path.is_dir() else phrase("not a file"))
    try:
        with h5py.File(path, "r") as file:
            check_structure(file, path.stat().st_size)
            if file.attrs.get("format") != schema.FORMAT:
                raise errors.SessionUnreadable(path, phrase("an HDF5 file, but not a session"))
            version = _format_version(file)
            if not 1 <= version <= schema.NEWEST_VERSION:
                text = phrase(
                    "format version {version}, but this version of Carpus reads up to {format_version}",
                    version=version,
                    format_version=schema.NEWEST_VERSION,
                )
                raise errors.SessionUnreadable(path, text)
            yield file
    except BlockingIOError as cause:
        raise errors.SessionUnreadable(path, phrase("still being recorded")) from cause
    except CarpusFault:
        raise
    except ContentError as cause:
        raise errors.SessionUnreadable(path, cause.args[0]) from cause
    except MemoryError as cause:
        raise errors.SessionUnreadable(path, phrase("damaged: reading it needs too much memory")) from cause
    except Exception as cause:  # a damaged file may make the library and the code above it raise anything
        # The library's own message helps developers only.
        log.info("reading %s: %s", path, cause)
        raise errors.SessionUnreadable(
            path, phrase("damaged") if h5py.is_hdf5(path) else phrase("not a session file")
        ) from cause


def _format_version(file: h5py.File) -> int:
    return int(file.attrs.get("format_version", 0))


class SessionFile:
    """Open session file: its header, and its datasets checked against the schema."""

    def __init__(self, path: Path, file: h5py.File) -> None:
        self._path = path
        self._file = file
        self._header = self._read_header()
        self.layout = TableLayout(self._header.protocol, self._header.joint_names)

    def read_session(self) -> Session:
        frames = {
            field.attribute: self.read_array(field)
            for field in schema.FRAME_FIELDS
            if field not in schema.MOTION_FIELDS
        }
        session = Session(
            path=self._path,
            header=self._header,
            camera=self._read_camera(),
            calibration=self._read_calibration(),
            timestamp_s=frames["timestamp_s"],
            status=frames["status"],
            motion=self._read_motion(schema.MOTION_FIELDS),
            markers=MarkerSeries(
                frames["marker_position_cam_m"],
                frames["marker_measured_px"],
                frames["marker_measured_depth_m"],
                frames["doubted"].astype(bool),
            ),
            quality=QualitySeries(frames["dropped_before"], frames["measured_share"], frames["nis"], frames["nis_dof"]),
            events=tuple(map(Event, *(self._read_list(field) for field in schema.EVENT_FIELDS))),
            smoothed=self._read_motion(schema.SMOOTHED_FIELDS) if "/smoothed" in self._file else None,
            recovered=str(self._file.attrs.get(schema.RECOVERED, "")),
            repetitions=self._read_repetitions(),
        )
        check_values(session)
        return session

    def _read_repetitions(self) -> Repetitions | None:
        path = schema.REPETITIONS.path
        if path not in self._file:
            return None
        table = self._file[path]
        missing = {column.name for column in schema.REPETITION_COLUMNS} - set(table.dtype.names or ())
        columns = [column for column in schema.REPETITION_COLUMNS if column.name not in missing]
        dtype = np.dtype([(column.name, column.dtype) for column in columns])
        if table.dtype != dtype or table.ndim != 1 or not missing <= {"at_least"}:  # which is from later
            raise damage_error(path)
        rows = [
            RepetitionRow(
                **{"at_least": False}
                | {one.attribute: _to_python(one, value) for one, value in zip(columns, row, strict=True)}
            )
            for row in table[()].tolist()
        ]
        return Repetitions(str(table.attrs[schema.REPETITION_ANGLE]), tuple(rows))

    def read_outline(self) -> SessionOutline:
        frames = self._rows["N"]
        times = self._file["/frames/timestamp"]
        duration_s = float(times[frames - 1] - times[0]) if frames else 0.0
        if not 0.0 <= duration_s <= MAX_DURATION_S:
            raise damage_error("/frames/timestamp")
        return SessionOutline(
            header=self._header,
            frames=frames,
            duration_s=duration_s,
            recovered=str(self._file.attrs.get(schema.RECOVERED, "")),
            size_bytes=self._path.stat().st_size,
        )

    def read_array(self, field: Field) -> NDArray[Any]:
        """Return a dataset of the schema's type and shape, read-only; a missing optional one is unknown."""
        expected = self.layout.row_shape(field)
        if field.shape[0] in schema.GROWING_AXES:
            expected = (self._rows[str(field.shape[0])], *expected)
        if field.path not in self._file:
            if not field.optional:
                raise ContentError(phrase("no dataset {path}", path=field.path))
            return np.full(expected, field.fill, dtype=field.h5_dtype)
        dataset = self._file[field.path]
        data = dataset[()]
        kinds = {"f": "f", "u": "iu", "i": "iu", "t": "SO"}[field.dtype[0]]
        if data.shape != expected or data.dtype.kind not in kinds:
            raise damage_error(field.path)
        array: NDArray[Any] = data if data.dtype.kind == "O" else data.astype(field.h5_dtype, copy=False)
        array.setflags(write=False)
        return array

    def read_raw_ends(self, number: int) -> NDArray[Any]:
        """Return the ends of each frame's images in a stream, checked, since they are used as indices."""
        ends = self.read_array(schema.RAW_ENDS[number])
        length = self._file[schema.RAW_STREAMS[number].path].shape[0]
        if len(ends) and (ends[0] < 0 or (np.diff(ends) < 0).any() or ends[-1] > length):
            raise damage_error(schema.RAW_ENDS[number].path)
        return ends

    def _read_list(self, field: Field) -> list[Any]:
        values = self.read_array(field).tolist()
        return [value.decode("utf-8") if isinstance(value, bytes) else value for value in values]

    def _read_attribute(self, name: str) -> Any:
        if name not in self._file.attrs:
            raise ContentError(phrase("no attribute {name}", name=name))
        return self._file.attrs[name]

    def _read_header(self) -> SessionHeader:
        try:
            protocol = get_protocol(str(self._read_attribute("protocol")))
        except errors.ProtocolUnknown as cause:
            raise ContentError(phrase("marker set {subject}", subject=cause.subject)) from cause
        hand = str(self._read_attribute("hand"))
        if hand not in ("right", "left"):
            raise ContentError(phrase("hand {hand}", hand=f"{hand!r}"))
        joints = tuple(map(str, self._file["/joints"].attrs["names"])) if protocol.has_fingers else ()
        if protocol.has_fingers and joints not in (protocol.joint_names(False), protocol.joint_names(True)):
            raise ContentError(
                phrase("{count} joint angles whose names differ from {name}", count=len(joints), name=protocol.name)
            )
        if _format_version(self._file) == 1:  # the times are the date if they count from 1970, else that of the file
            first = self._file["/frames/timestamp"][:1]
            moment = moment_from_timestamp(float(first[0])) if len(first) else None
            recorded = str(self._read_attribute("created")) if moment is None else to_iso(moment)
            recording_id = str(self._file.attrs.get("origin", "") or self._read_attribute("session_id"))
        else:
            recorded, recording_id = (str(self._read_attribute(name)) for name in ("recorded", "recording_id"))
        names = ("session_id", "subject_id", "created", "exercise", "software_version", "parameters")
        header = SessionHeader(
            **{name: str(self._read_attribute(name)) for name in names},
            hand="right" if hand == "right" else "left",
            protocol=protocol,
            origin=str(self._file.attrs.get("origin", "")),
            joint_names=joints,
            recorded=recorded,
            recording_id=recording_id,
        )
        check_header(header, json.loads(header.parameters))
        return header

    @cached_property
    def _rows(self) -> dict[str, int]:
        """Length of each growing axis."""
        if not self._read_attribute("complete"):
            raise errors.SessionUnfinished(self._path)
        paths = ("/frames/timestamp", "/detections/frame", "/events/time", *(f.path for f in schema.RAW_STREAMS))
        lengths = (self._file[path].shape[0] if path in self._file else 0 for path in paths)
        return dict(zip(schema.GROWING_AXES, lengths, strict=True))

    def _read_motion(self, fields: tuple[Field, ...]) -> Motion:
        rows = self._rows["N"]
        nothing = {2: (rows, 0), 3: (rows, 0, 3)}
        values = {
            field.attribute: self.read_array(field) if self.layout.has(field) else np.empty(nothing[len(field.shape)])
            for field in fields
        }
        return Motion(**values)

    def _read_camera(self) -> Camera:
        attributes = self._file["/camera"].attrs
        model = str(attributes.get("distortion_model", "plumb_bob"))
        lens = tuple(float(value) for value in attributes["distortion"])
        known = next(
            (one for one, count in DISTORTION_COEFFICIENT_COUNTS.items() if (one, count) == (model, len(lens))), None
        )
        if known is None:
            raise ContentError(phrase("distortion {model} with {count} coefficients", model=model, count=len(lens)))
        try:
            sensor = (
                parse_sensor(json.loads(attributes["depth_sensor"])) if "depth_sensor" in attributes else ASSUMED_SENSOR
            )
        except ValueError as cause:
            raise ContentError(phrase("damaged: depth sensor, {cause}", cause=cause)) from cause
        return Camera(
            fx_px=float(attributes["fx"]),
            fy_px=float(attributes["fy"]),
            cx_px=float(attributes["cx"]),
            cy_px=float(attributes["cy"]),
            width_px=int(attributes["width"]),
            height_px=int(attributes["height"]),
            distortion=lens,
            origin=str(attributes.get("origin", "file")),
            sensor=sensor,
            distortion_model=known,
        )

    def _read_calibration(self) -> Calibration:
        arrays = {field.attribute: self.read_array(field) for field in schema.CALIBRATION_FIELDS}
        clicks_px, residual_m = arrays.pop("clicks_px"), arrays.pop("residual_m")
        surface = DorsalSurface.from_table(arrays.pop("surface"))
        attributes = self._file["/calibration"].attrs
        facts = json.loads(attributes.get("findings", "[]"))
        findings = [CalibrationFinding(**(fact | {"markers": tuple(fact.get("markers", ()))})) for fact in facts]
        unknown = float("nan")
        verdict = Verdict(
            residual_mm=residual_m * 1e3,
            hand_length_mm=float(attributes.get("hand_length_m", unknown)) * 1e3,
            tilt_deg=float(np.degrees(attributes.get("tilt_rad", unknown))),
            distance_m=float(attributes.get("distance_m", unknown)),
            frames_used=int(attributes.get("frames_used", 0)),
            findings=tuple(findings),
        )
        straight = tuple(map(bool, attributes.get("straight_fingers", ())))
        clicks = Clicks(self._header.hand, self._header.protocol, clicks_px, straight)
        return Calibration(clicks=clicks, verdict=verdict, surface=surface, **arrays)


def _to_python(column: Column, value: Any) -> Any:
    if isinstance(value, bytes):
        return value.decode("utf-8", "replace")
    return bool(value) if column.dtype == "u1" else value
