"""Layout of a new session file by the schema: header, calibration and datasets."""

from __future__ import annotations

import json
from dataclasses import asdict
from typing import Any

import h5py
import numpy as np

from carpus.core.calibration.result import Calibration
from carpus.core.model.camera import Camera
from carpus.core.model.hand.dorsal_surface import TABLE_ROWS
from carpus.core.session import schema
from carpus.core.session.columns import check_shape
from carpus.core.session.schema import Field, TableLayout
from carpus.core.session.values import Repetitions, SessionHeader

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
        create_growing_datasets(file, layout)
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


def create_growing_datasets(file: h5py.File, layout: TableLayout) -> None:
    """Create every dataset of rows, still empty."""
    detections = (schema.DETECTION_FRAME, *schema.DETECTION_FIELDS, schema.DETECTION_COUNT)
    for field in (*schema.FRAME_FIELDS, *detections, *READINGS, *schema.EVENT_FIELDS):
        if layout.has(field):
            create_dataset(file, field, layout)
    for group, names in layout.group_names().items():
        file[group].attrs["names"] = names


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
