"""Storage of a camera's calibration."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from datetime import datetime
from pathlib import Path

from carpus.core.calibration.camera.calibrate import CameraCalibration
from carpus.core.capture.calibrated_source import new_calibration_path
from carpus.core.capture.camera_info import StoredCalibration, write_camera_info
from carpus.core.model.dates import to_iso
from carpus.core.platform.durable import write_fault


def to_stored_calibration(
    calibration: CameraCalibration, serial: str, when: datetime, source_settings: Mapping[str, str] | None = None
) -> StoredCalibration:
    """Return the values that are stored of a calibration.

    ``source_settings``: depth that was corrected already is included.
    """
    scale, offset_m = (1.0, 0.0) if calibration.depth is None else (calibration.depth.scale, calibration.depth.offset_m)
    before = source_settings or {}
    old_scale = float(before.get("depth_scale_corrected", 1.0))
    old_offset_m = 1e-3 * float(before.get("depth_offset_corrected_mm", 0.0))
    found = calibration.intrinsics
    offset_m = old_scale * offset_m + old_offset_m
    error_px, views = found.reprojection_error_px, len(found.used_views)
    return StoredCalibration(serial, to_iso(when), old_scale * scale, offset_m, error_px, views)


def write_calibration(path: Path, calibration: CameraCalibration, stored: StoredCalibration) -> Path:
    """Write the camera file. Raises :class:`OutputExists` or :class:`OutputNotWritable`."""
    try:
        path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    except OSError as cause:
        raise write_fault(path, cause) from cause
    registered = None if calibration.depth is None else calibration.depth.is_registered
    name = stored.serial or "carpus"
    camera = replace(calibration.intrinsics.camera, sensor=calibration.previous_camera.sensor)
    write_camera_info(path, camera, camera_name=name, registered=registered, calibration=stored)
    return path


def save_calibration(data_folder: Path, calibration: CameraCalibration, stored: StoredCalibration) -> Path:
    """Save it for its camera; earlier ones stay."""
    when = datetime.fromisoformat(stored.calibrated)
    return write_calibration(new_calibration_path(data_folder, stored.serial, when), calibration, stored)
