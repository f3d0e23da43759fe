"""Lays out a new session file by the schema: header, calibration, and the datasets that will grow."""

from __future__ import annotations

import json
import os
from dataclasses import asdict
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from carpus.core.calibration.result import Calibration
from carpus.core.camera import Camera
from carpus.core.hand.back_surface import TABLE_ROWS
from carpus.core.session import schema
from carpus.core.session.schema import Field, TableLayout
from carpus.core.session.values import Repetitions, SessionHeader

_CHUNK_ROWS = {"N": 1024, "D": 32768, "E": 32, "C": 1 << 23, "B": 1 << 23}
"""Large: most flushes then fill chunks that are there already and leave HDF5's index alone. Up to 64 chunks the index
of a dataset is one node, changed by one write; 64 x 1024 rows are 36 minutes at 30 frames a second."""


READINGS = (*schema.SURFACE_FIELDS, *schema.FINGER_FIELDS)
_SURFACE_ROWS = 512
"""Of the readings on the back of the hand, which are many for each frame."""


def new_file(path: Path) -> h5py.File:
    """An empty HDF5 file, for its owner only; one that is there already is a FileExistsError.

    The oldest format has no checksums that a kill would leave wrong; without the chunk cache rows go to the file
    when they are written, before the index that makes them visible.
    """
    os.close(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600))
    return h5py.File(path, "w", libver="earliest", rdcc_nbytes=0)


def write_header(file: h5py.File, header: SessionHeader, camera: Camera) -> None:
    """The attributes of ``/`` and ``/camera``."""
    values = {
        "format": schema.FORMAT,
        "format_version": version_for(camera),
        "protocol": header.protocol.name,
        "complete": False,
    }
    for name in schema.ROOT_ATTRIBUTES:
        file.attrs[name] = values[name] if name in values else getattr(header, name)
    group = file.create_group("/camera")
    told = asdict(camera) | {"sensor": json.dumps(camera.sensor.as_mapping(), sort_keys=True)}
    for name, value in zip(schema.CAMERA_ATTRIBUTES, told.values(), strict=True):
        group.attrs[name] = value


def version_for(camera: Camera) -> int:
    """Of the format: what an older Carpus would misread has a version that it refuses."""
    is_inverse = camera.distortion_model == "inverse_brown_conrady" and camera.is_distorted
    return schema.LENS_VERSION if is_inverse else schema.FORMAT_VERSION


def write_calibration(file: h5py.File, layout: TableLayout, calibration: Calibration) -> None:
    """The datasets of ``/calibration`` and the verdict as its attributes."""
    verdict = calibration.verdict
    surface = calibration.surface
    elsewhere = {
        "clicks_px": calibration.clicks.pixel,
        "residual_m": verdict.residual_mm * 1e-3,
        "surface": np.full((TABLE_ROWS, 5), np.nan) if surface is None else surface.as_table(),
    }
    for field in schema.CALIBRATION_FIELDS:
        value = elsewhere[field.attribute] if field.attribute in elsewhere else getattr(calibration, field.attribute)
        describe(create_checked(file, field.path, checked(field, value, layout.row_shape(field))), field, layout)
    findings = json.dumps([_known(asdict(finding)) for finding in verdict.findings])
    straight = np.array(calibration.clicks.straight_fingers, dtype=np.uint8)
    said = (verdict.hand_length_mm * 1e-3, np.radians(verdict.tilt_deg), verdict.distance_m, verdict.frames_used)
    for name, value in zip(schema.VERDICT_ATTRIBUTES, (*said, findings, straight), strict=True):
        file["/calibration"].attrs[name] = value


def create_growing(file: h5py.File, layout: TableLayout, raw_depth_unit_m: float | None) -> dict[str, h5py.Dataset]:
    """Every dataset that grows while the session runs, still without rows; ``/raw`` only with a depth unit."""
    raw = (*schema.RAW_STREAMS, *schema.RAW_ENDS) if raw_depth_unit_m is not None else ()
    detections = (schema.DETECTION_FRAME, *schema.DETECTION_FIELDS, schema.DETECTION_COUNT)
    growing: dict[str, h5py.Dataset] = {}
    for field in (*schema.FRAME_FIELDS, *detections, *READINGS, *schema.EVENT_FIELDS, *raw):
        if layout.has(field):
            growing[field.path] = _create_growing(file, field, layout)
    for group, names in layout.group_names().items():
        file[group].attrs["names"] = names
    if raw_depth_unit_m is not None:
        file["/raw"].attrs[schema.RAW_DEPTH_UNIT] = raw_depth_unit_m
    return growing


def create_smoothed(file: h5py.File, layout: TableLayout) -> dict[str, h5py.Dataset]:
    """The datasets of the smoother's result, still without rows."""
    fields = [field for field in schema.SMOOTHED_FIELDS if layout.has(field)]
    growing = {field.path: _create_growing(file, field, layout) for field in fields}
    for group, names in layout.group_names().items():
        if "/smoothed" + group in file:
            file["/smoothed" + group].attrs["names"] = names
    return growing


def _create_growing(file: h5py.File, field: Field, layout: TableLayout) -> h5py.Dataset:
    row = layout.row_shape(field)
    dataset = file.create_dataset(
        field.path,
        shape=(0, *row),
        maxshape=(None, *row),
        chunks=(_SURFACE_ROWS if field in READINGS else _CHUNK_ROWS[str(field.shape[0])], *row),
        fletcher32=True,
        dtype=field.h5_dtype,
        fillvalue=None if field.dtype == "text" else field.fill,
        fill_time="never" if field in schema.RAW_STREAMS else "ifset",
    )
    describe(dataset, field, layout)
    return dataset


def create_repetitions(file: h5py.File, layout: TableLayout, repetitions: Repetitions) -> None:
    """The table of what was counted, a column for each of its figures."""
    rows = [tuple(getattr(row, column.attribute) for column in schema.REPETITION_COLUMNS) for row in repetitions.rows]
    rows = [(*row[:-1], row[-1].encode()[: schema.REPETITION_DTYPE["reason"].itemsize]) for row in rows]
    table = create_checked(file, schema.REPETITIONS.path, np.array(rows, dtype=schema.REPETITION_DTYPE))
    describe(table, schema.REPETITIONS, layout)
    for name in ("unit", "description"):
        table.attrs[f"column_{name}s"] = [getattr(column, name) for column in schema.REPETITION_COLUMNS]
    table.attrs[schema.REPETITION_ANGLE] = repetitions.angle


def create_checked(file: h5py.File, path: str, data: Any) -> h5py.Dataset:
    """A dataset that is written once, in chunks with check sums."""
    if not data.size:
        return file.create_dataset(path, data=data)
    chunks = (min(len(data), _CHUNK_ROWS["N"]), *data.shape[1:])
    return file.create_dataset(path, data=data, chunks=chunks, fletcher32=True)


def describe(dataset: h5py.Dataset, field: Field, layout: TableLayout) -> None:
    """Unit, description and names of a dataset."""
    dataset.attrs["unit"] = field.unit
    dataset.attrs["description"] = field.description
    if field.named_axis:
        dataset.attrs["names"] = layout.names(field.named_axis)


def checked(field: Field, value: Any, shape: tuple[int, ...]) -> Any:
    """``value`` as an array of the field's type; a wrong shape is a mistake of the caller and is not stretched."""
    data = np.asarray(value, dtype=field.h5_dtype)
    if data.shape != shape:
        raise ValueError(f"{field.path} got {data.shape}, {shape} expected")
    return data


def _known(facts: dict[str, Any]) -> dict[str, Any]:
    """Without NaN, which JSON does not have."""
    return {name: value for name, value in facts.items() if value == value}
