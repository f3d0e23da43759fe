"""Sources with stored camera data: a camera calibration, and the name given to a camera without a serial number."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import replace
from datetime import UTC, datetime
from itertools import chain, count
from pathlib import Path

import numpy as np

from carpus.core.capture.camera_info import CameraInfo, StoredCalibration, read_camera_info
from carpus.core.capture.source import SERIAL, SERIAL_GIVEN, FrameSource, SourceInfo
from carpus.core.model.dates import is_moment
from carpus.core.model.errors import CarpusFault
from carpus.core.model.names import CAMERAS_FOLDER, file_stem
from carpus.core.model.types import DepthImage, Frame
from carpus.core.platform.durable import make_private_folder, replace_text

SUFFIX = ".camera_info.yaml"
ORIGIN = "calibration"
_DEPTH_STEP_M = 1e-4
"""Step of corrected depth: 16 bits reach 6.5 m."""
_MAX_COUNT = 65535
_REPLACEABLE_ORIGINS = ("default", "driver", "factory")


class CalibratedSource:
    """Source with stored facts of its camera, and depth corrected by a calibration if there is one."""

    def __init__(self, source: FrameSource, info: SourceInfo, calibration: StoredCalibration | None = None) -> None:
        self._source, self.info = source, info
        is_exact = calibration and calibration.depth_scale == 1.0 and calibration.depth_offset_m == 0.0
        self._calibration = None if is_exact else calibration

    def frames(self) -> Iterator[Frame]:
        calibration, tables = self._calibration, dict[float, DepthImage]()
        for frame in self._source.frames():
            if frame.depth_raw is None or calibration is None:
                yield frame
                continue
            unit_m = frame.depth_unit_m
            if unit_m not in tables:
                tables[unit_m] = compute_correction_table(calibration, unit_m)
            depth = tables[unit_m][frame.depth_raw]
            depth.flags.writeable = False
            yield replace(frame, depth_raw=depth, depth_unit_m=_DEPTH_STEP_M)

    def close(self) -> None:
        self._source.close()


def compute_correction_table(calibration: StoredCalibration, unit_m: float) -> DepthImage:
    """Return true depth (65536,) in steps of 0.1 mm for each count of ``unit_m``; 0 (no reading) stays 0."""
    measured_m = np.arange(_MAX_COUNT + 1) * unit_m
    true_m = (measured_m - calibration.depth_offset_m) / calibration.depth_scale
    counts = np.round(true_m / _DEPTH_STEP_M)
    return np.where((counts < 1) | (counts > _MAX_COUNT) | (measured_m == 0.0), 0, counts).astype(np.uint16)


def with_stored_calibration(source: FrameSource, data_folder: Path) -> FrameSource:
    """Return the source with the newest stored calibration of its camera.

    The source itself is returned if there is none, if its camera is unknown, or if it has measured intrinsics.
    """
    serial = source.info.serial
    if not serial or source.info.camera.origin not in _REPLACEABLE_ORIGINS:
        return source
    info = load_stored_calibration(data_folder, serial)
    size = (source.info.camera.width_px, source.info.camera.height_px)
    if info is None or info.calibration is None or (info.camera.width_px, info.camera.height_px) != size:
        return source
    calibration, recorded = info.calibration, source.info.recorded
    measured = datetime.fromisoformat(recorded) if is_moment(recorded) else datetime.now(UTC)
    settings = {
        **source.info.settings,
        "calibrated": calibration.calibrated,
        "calibration_age_days": f"{age_days(calibration.calibrated, measured):.1f}",
        "calibration_error_px": f"{calibration.error_px:.2f}",
        "depth_scale_corrected": f"{calibration.depth_scale:.5f}",
        "depth_offset_corrected_mm": f"{calibration.depth_offset_m * 1e3:.2f}",
    }
    camera = replace(info.camera, origin=ORIGIN, sensor=source.info.camera.sensor)
    return CalibratedSource(source, replace(source.info, camera=camera, settings=settings), calibration)


def load_stored_calibration(data_folder: Path, serial: str) -> CameraInfo | None:
    """Return the newest readable calibration of a camera, or None."""
    for path in sorted((data_folder / CAMERAS_FOLDER).glob(f"{file_stem(serial)}_*{SUFFIX}"), reverse=True):
        try:
            info = read_camera_info(path)
        except CarpusFault:
            continue  # a damaged file must not keep anybody from measuring; the doctor names it
        if info.calibration is not None and info.calibration.serial == serial:
            return info
    return None


def new_calibration_path(data_folder: Path, serial: str, time: datetime) -> Path:
    """Return a free path for a calibration made at a time; names sort by time."""
    first = data_folder / CAMERAS_FOLDER / f"{file_stem(serial)}_{time.astimezone(UTC):%Y-%m-%d_%H%M%S}{SUFFIX}"
    stem = first.name.removesuffix(SUFFIX)
    further = (first.with_name(f"{stem}_{number:03d}{SUFFIX}") for number in count(2))  # in the same second
    return next(path for path in chain((first,), further) if not path.exists())


def age_days(moment: str, now: datetime) -> float:
    """Return the days from a stored time until now; NaN if it is not a time."""
    if not is_moment(moment):
        return float("nan")
    return (now - datetime.fromisoformat(moment)).total_seconds() / 86400.0


MAX_NAME_CHARACTERS = 40
_NAMES_FILE = "names.json"


def with_given_name(source: FrameSource, data_folder: Path) -> FrameSource:
    """Return the source under the name given to its kind of camera.

    The source itself is returned if the camera has a serial number or no name was given.
    """
    if source.info.serial:
        return source
    name = _load_names(data_folder).get(source.info.name, "")
    settings = {**source.info.settings, SERIAL: name, SERIAL_GIVEN: "yes"}
    return CalibratedSource(source, replace(source.info, settings=settings)) if name else source


def normalize_name(text: str) -> str:
    r"""Return a name as it is stored: printable, single spaces, of limited length.

    >>> normalize_name("  room 3\t left ")
    'room 3 left'
    """
    words = "".join(letter if letter.isprintable() else " " for letter in text).split()
    return " ".join(words)[:MAX_NAME_CHARACTERS].strip()


def save_camera_name(data_folder: Path, kind: str, name: str) -> str:
    """Save a name for cameras of a kind that have no serial number; return the stored name.

    A name that another kind has gets the kind added, so that each keeps its own calibration.

    Raises
    ------
    OutputNotWritable, DiskFull
        The name could not be stored.
    """
    path = data_folder / CAMERAS_FOLDER / _NAMES_FILE
    others = {other: taken for other, taken in _load_names(data_folder).items() if other != kind}
    stored_name = normalize_name(name)
    if stored_name in others.values():
        of_kind = f" ({normalize_name(kind)[: MAX_NAME_CHARACTERS // 2]})"
        stored_name = normalize_name(stored_name[: MAX_NAME_CHARACTERS - len(of_kind)] + of_kind)
    names = {**others, kind: stored_name}
    make_private_folder(path.parent)
    replace_text(path, json.dumps(names, ensure_ascii=False))
    return stored_name


def _load_names(data_folder: Path) -> dict[str, str]:
    try:
        known = json.loads((data_folder / CAMERAS_FOLDER / _NAMES_FILE).read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError):
        return {}
    if not isinstance(known, dict):
        return {}
    return {str(kind): tidy for kind, name in known.items() if isinstance(name, str) and (tidy := normalize_name(name))}
