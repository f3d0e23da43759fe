"""Copy of a session file without frames, which can be imported again with the same results."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

from carpus.core.formats.export_item import ExportItem
from carpus.core.formats.export_provenance import reproject_pixels
from carpus.core.model.camera import Camera
from carpus.core.model.types import TrackedFrame, TrackStatus
from carpus.core.results.repetition_rows import compute_repetitions
from carpus.core.session.reader import read_detections
from carpus.core.session.values import DetectionTable, iter_states
from carpus.core.session.writer import SessionWriter


def write(take: ExportItem, folder: Path) -> list[Path]:
    """Write ``NAME.h5`` with its own checksum; return its path. Raises :class:`OutputExists`."""
    path = folder / f"{take.name}.h5"
    session = take.session
    folder.mkdir(parents=True, exist_ok=True)
    with SessionWriter.create(path, session.header, session.camera, session.calibration) as writer:
        for frame in _tracked_frames(take):
            writer.append(frame)
        for event in session.events:
            writer.add_event(event.time_s, event.kind, event.text)
        if session.smoothed is not None and len(session):
            writer.write_motion(session.smoothed)
        if len(session):
            writer.write_repetitions(compute_repetitions(session))
    return [path]


def _tracked_frames(take: ExportItem) -> Iterator[TrackedFrame]:
    session = take.session
    markers, quality = session.markers, session.quality
    table = read_detections(session.path)
    if take.source_camera is not None and take.source_camera != session.camera:
        table = _move_detections(table, take.source_camera, session.camera)
    count = len(session.header.protocol.markers)
    no_pixel = np.full((count, 2), np.nan)
    for row, moment in enumerate(iter_states(session.motion)):
        yield TrackedFrame(
            index=row,
            timestamp_s=float(session.timestamp_s[row]),
            status=TrackStatus(int(session.status[row])),
            kinematics=moment,
            marker_position_cam_m=markers.position_cam_m[row],
            marker_predicted_px=no_pixel,
            marker_measured_px=markers.measured_px[row],
            marker_measured_depth_m=markers.measured_depth_m[row],
            detections=table.get_frame(row),
            dropped_before=int(quality.dropped_before[row]),
            measured_share=quality.measured_share[row],
            nis=float(quality.nis[row]),
            nis_dof=int(quality.nis_dof[row]),
            doubted=markers.doubted[row],
        )


def _move_detections(table: DetectionTable, old: Camera, new: Camera) -> DetectionTable:
    """Reproject detections to the camera of the copy."""
    surface, fingers = ((reproject_pixels(pixel, old, new), depth) for pixel, depth in (table.surface, table.fingers))
    blobs = replace(table.blobs, pixel=reproject_pixels(table.blobs.pixel, old, new))
    return DetectionTable(table.frame, blobs, surface, fingers)
