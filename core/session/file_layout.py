"""A session by the schema: a new file with header, calibration and datasets, and the columns that rows become."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from dataclasses import asdict
from typing import Any

import h5py
import numpy as np

from carpus.core.calibration.result import Calibration
from carpus.core.model.camera import Camera
from carpus.core.model.hand.dorsal_surface import TABLE_ROWS
from carpus.core.model.types import SurfaceSamples, TrackedFrame
from carpus.core.session import schema
from carpus.core.session.schema import Field, TableLayout
from carpus.core.session.values import Event, Motion, Repetitions, SessionHeader

ROWS_AT_ONCE = 1024
"""Frames written together: whole chunks of every dataset, so that none is compressed twice."""
_CHUNK_ROWS = {"N": ROWS_AT_ONCE, "D": 4096, "E": 32, "C": 1 << 20, "B": 1 << 20}
READINGS = (*schema.SURFACE_FIELDS, *schema.FINGER_FIELDS)
_READING_ROWS = 256
"""Chunk rows of the depth samples, which are many in each frame."""
_GZIP_LEVEL = 1
"""Higher levels make files a hundredth smaller and take much longer."""


def build_empty_session(header: SessionHeader, camera: Camera, calibration: Calibration) -> bytes:
    """Return a session file without rows, as bytes."""
    with h5py.File("session", "w", driver="core", backing_store=False, libver="earliest") as file:
        layout = TableLayout(header.protocol, header.joint_names)
        # write the attributes of ``/`` and ``/camera``
        is_inverse = camera.distortion_model == "inverse_brown_conrady"
        values = {
            "format": schema.FORMAT,
            # files that an older Carpus would misread have a version that it refuses
            "format_version": schema.LENS_VERSION if is_inverse and camera.is_distorted else schema.FORMAT_VERSION,
            "protocol": header.protocol.name,
            "complete": True,  # it gets its name only then
        }
        for name in schema.ROOT_ATTRIBUTES:
            file.attrs[name] = values[name] if name in values else getattr(header, name)
        group = file.create_group("/camera")
        entries = asdict(camera) | {"sensor": json.dumps(camera.sensor.to_dict(), sort_keys=True)}
        for name, value in zip(schema.CAMERA_ATTRIBUTES, entries.values(), strict=True):
            group.attrs[name] = value
        write_calibration(file, layout, calibration)
        for field in filter(layout.has, schema.ROW_FIELDS):
            create_dataset(file, field, layout)
        for group_name, names in layout.group_names().items():
            file[group_name].attrs["names"] = names
        file.flush()
        return bytes(file.id.get_file_image())


def write_calibration(file: h5py.File, layout: TableLayout, calibration: Calibration) -> None:
    """Write the datasets of ``/calibration``, and the verdict as its attributes."""
    verdict = calibration.verdict
    surface = calibration.surface
    other_values = {
        "clicks_px": calibration.clicks.pixel,
        "residual_m": verdict.residual_mm * 1e-3,
        "surface": np.full((TABLE_ROWS, 5), np.nan) if surface is None else surface.to_table(),
    }
    for field in schema.CALIBRATION_FIELDS:
        name = field.attribute
        value = other_values[name] if name in other_values else getattr(calibration, name)
        dataset = create_checked_dataset(file, field.path, check_shape(field, value, layout.row_shape(field)))
        write_attributes(dataset, field, layout)
    # JSON has no NaN
    known = [{name: value for name, value in asdict(each).items() if value == value} for each in verdict.findings]
    straight = np.array(calibration.clicks.straight_fingers, dtype=np.uint8)
    values = (verdict.hand_length_mm * 1e-3, np.radians(verdict.tilt_deg), verdict.distance_m, verdict.frames_used)
    for name, value in zip(schema.VERDICT_ATTRIBUTES, (*values, json.dumps(known), straight), strict=True):
        file["/calibration"].attrs[name] = value


def create_smoother_datasets(file: h5py.File, layout: TableLayout) -> None:
    """Create the datasets of the smoother's result, still empty."""
    for field in filter(layout.has, schema.SMOOTHED_FIELDS):
        create_dataset(file, field, layout)
    for group, names in layout.group_names().items():
        if "/smoothed" + group in file:
            file["/smoothed" + group].attrs["names"] = names


def create_dataset(file: h5py.File, field: Field, layout: TableLayout) -> h5py.Dataset:
    """Create the dataset of a field, still empty; compressed, except images, which are so already."""
    row = layout.row_shape(field)
    packing: dict[str, Any] = {"compression": "gzip", "compression_opts": _GZIP_LEVEL, "shuffle": True}
    dataset = file.create_dataset(
        field.path,
        shape=(0, *row),
        maxshape=(None, *row),
        chunks=(_READING_ROWS if field in READINGS else _CHUNK_ROWS[str(field.shape[0])], *row),
        fletcher32=True,
        dtype=field.h5_dtype,
        fillvalue=None if field.dtype == "text" else field.fill,
        **({} if field in schema.RAW_STREAMS else packing),
    )
    write_attributes(dataset, field, layout)
    return dataset


def create_repetitions(file: h5py.File, layout: TableLayout, repetitions: Repetitions) -> None:
    """Create the table of repetitions."""
    rows = [tuple(getattr(row, column.attribute) for column in schema.REPETITION_COLUMNS) for row in repetitions.rows]
    rows = [(*row[:-1], row[-1].encode()[: schema.REPETITION_DTYPE["reason"].itemsize]) for row in rows]
    table = create_checked_dataset(file, schema.REPETITIONS.path, np.array(rows, dtype=schema.REPETITION_DTYPE))
    write_attributes(table, schema.REPETITIONS, layout)
    for name in ("unit", "description"):
        table.attrs[f"column_{name}s"] = [getattr(column, name) for column in schema.REPETITION_COLUMNS]
    table.attrs[schema.REPETITION_ANGLE] = repetitions.angle


def create_checked_dataset(file: h5py.File, path: str, data: Any) -> h5py.Dataset:
    """Create a dataset that is written once, in chunks with checksums."""
    if not data.size:
        return file.create_dataset(path, data=data)
    chunks = (min(len(data), _CHUNK_ROWS["N"]), *data.shape[1:])
    return file.create_dataset(path, data=data, chunks=chunks, fletcher32=True)


def write_attributes(dataset: h5py.Dataset, field: Field, layout: TableLayout) -> None:
    """Write unit, description and names of a dataset."""
    dataset.attrs["unit"] = field.unit
    dataset.attrs["description"] = field.description
    if field.label_axis:
        dataset.attrs["names"] = layout.names(field.label_axis)


Blocks = dict[str, Any]
"""Rows to add, an array for the path of each dataset. ``/detections/frame`` counts from the first frame of the
blocks.
"""


def build_frame_blocks(layout: TableLayout, frames: Sequence[TrackedFrame]) -> Blocks:
    """Return the columns of frames with their detections and depth samples."""
    blobs = [frame.detections for frame in frames]
    counts = np.array([len(some) for some in blobs])
    total = int(counts.sum())
    found: Blocks = {
        schema.DETECTION_FRAME.path: np.repeat(np.arange(len(frames)), counts),
        schema.DETECTION_COUNT.path: counts,
    }
    for field in schema.DETECTION_FIELDS:
        data = np.concatenate([getattr(some, field.attribute) for some in blobs])
        found[field.path] = check_shape(field, data, (total, *layout.row_shape(field)))
    for field in schema.SURFACE_FIELDS:
        found[field.path] = _fill_readings(field, [some.surface for some in blobs])
    for field in schema.FINGER_FIELDS if layout.protocol.has_fingers else ():
        found[field.path] = _fill_readings(field, [some.fingers for some in blobs])
    for field in filter(layout.has, schema.FRAME_FIELDS):
        of = [frame.kinematics for frame in frames] if field in schema.MOTION_FIELDS else frames
        values = [getattr(one, field.attribute) for one in of]
        found[field.path] = check_shape(field, values, (len(frames), *layout.row_shape(field)))
    return found


def build_motion_blocks(layout: TableLayout, motion: Motion) -> Blocks:
    """Return the columns of the smoother's result."""
    count = len(motion.position_m)
    return {
        field.path: check_shape(field, getattr(motion, field.attribute), (count, *layout.row_shape(field)))
        for field in filter(layout.has, schema.SMOOTHED_FIELDS)
    }


def build_event_blocks(event: Event) -> Blocks:
    """Return one event as columns, in as many rows as its text needs."""
    rows = [Event(event.time_s, event.kind, part) for part in _split_text(event.text)]
    found = {}
    for field in schema.EVENT_FIELDS:
        values = [getattr(row, field.attribute) for row in rows]
        cells = [value.encode() if isinstance(value, str) else value for value in values]
        found[field.path] = np.array(cells, dtype=field.h5_dtype)
    return found


def check_shape(field: Field, value: Any, shape: tuple[int, ...]) -> Any:
    """Return the value as an array of the field's type; raises ValueError if its shape is wrong."""
    data = np.asarray(value, dtype=field.h5_dtype)
    if data.shape != shape:
        raise ValueError(f"{field.path} got {data.shape}, {shape} expected")
    return data


def _fill_readings(field: Field, readings: Sequence[SurfaceSamples | None]) -> Any:
    """Return the depth samples of some frames, padded to the same number."""
    row_shape = tuple(size for size in field.shape[1:] if isinstance(size, int))
    out = np.full((len(readings), *row_shape), field.fill, dtype=field.h5_dtype)
    for row, some in zip(out, readings, strict=True):
        if some is not None:
            value = getattr(some, field.attribute)
            row[: len(value)] = value
    return out


def _split_text(text: str) -> Iterator[str]:
    """Yield pieces of a text that fit into a row, cut between characters."""
    rest = text.encode("utf-8", "replace")
    while True:
        part = rest[: schema.TEXT_BYTES].decode("utf-8", "ignore")
        yield part
        rest = rest[len(part.encode()) :]
        if not rest:
            return
