"""Read and write camera intrinsics (ROS camera calibration YAML)."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import yaml

from carpus.core.model.camera import DISTORTION_COEFFICIENT_COUNTS, Camera, DistortionModel
from carpus.core.model.dates import is_moment
from carpus.core.model.depth_sensor import ASSUMED, ASSUMED_SENSOR, parse_sensor
from carpus.core.model.errors import CameraFileUnreadable, OutputExists
from carpus.core.model.phrase import phrase
from carpus.core.model.types import SIMULATED
from carpus.core.platform.durable import open_private, write_fault

CAMERA_FILE = "camera_info.yaml"
_DEFAULT_MODEL: DistortionModel = "plumb_bob"
_MAX_BYTES = 1_000_000
_MAX_SIDE_PX = 100_000
_SCALE_RANGE, _MAX_OFFSET_M = (0.8, 1.25), 0.1
_DEPTH_UNIT_RANGE_M = (1e-5, 1e-2)
_MAX_ROUND_TRIP_PX = 2.0
_FOCAL_LENGTH_RANGE = (0.2, 10.0)
"""Focal length over image width: fields of view of 136 to 6 degrees."""


_CALIBRATION = "carpus_calibration"
_SENSOR = "depth_sensor"


@dataclass(frozen=True, slots=True)
class StoredCalibration:
    """Calibration of the camera ``serial`` on a printed board, at a time (ISO 8601 with zone).

    Measured depth = scale * true depth + offset; 1 and 0 if depth was not checked. ``error_px`` is the reprojection
    error of the board's corners, ``pictures`` the number of its images.
    """

    serial: str
    calibrated: str
    depth_scale: float = 1.0
    depth_offset_m: float = 0.0
    error_px: float = 0.0
    pictures: int = 0


@dataclass(frozen=True, slots=True)
class CameraInfo:
    """Content of a camera calibration file.

    ``registered``, ``mirrored`` and ``depth_unit_m`` (metres per count) are None if the file does not state them.
    """

    camera: Camera
    registered: bool | None = None
    mirrored: bool | None = None
    simulated: bool = False
    calibration: StoredCalibration | None = None
    depth_unit_m: float | None = None


def read_camera_info(path: Path) -> CameraInfo:
    """Read a ROS camera calibration file; raises :class:`CameraFileUnreadable`."""
    try:
        with path.open("rb") as file:
            data = file.read(_MAX_BYTES + 1)
        if len(data) > _MAX_BYTES:
            raise CameraFileUnreadable(path, phrase("too long for a camera calibration"))
        content = yaml.safe_load(data.decode("utf-8-sig"))
    except OSError as cause:
        raise CameraFileUnreadable(path, cause.strerror or phrase("cannot be opened")) from cause
    except UnicodeDecodeError as cause:
        raise CameraFileUnreadable(path, phrase("not a text file")) from cause
    except yaml.YAMLError as cause:
        mark = getattr(cause, "problem_mark", None)
        raise CameraFileUnreadable(path, "not YAML" + (f", line {mark.line + 1}" if mark else "")) from cause
    except (ValueError, RecursionError) as cause:
        raise CameraFileUnreadable(path, phrase("not YAML")) from cause
    if not isinstance(content, dict):
        raise CameraFileUnreadable(path, phrase("not a camera calibration"))
    try:
        flags = {key: content.get(key) for key in ("registered", "mirrored", SIMULATED)}
        for key, value in flags.items():
            if value is not None and not isinstance(value, bool):
                raise ValueError(phrase("{key} is neither true nor false", key=key))
        camera, calibration, unit_m = _parse_camera(content), _parse_calibration(content), _parse_depth_unit_m(content)
    except ValueError as cause:
        raise CameraFileUnreadable(path, cause.args[0]) from cause
    return CameraInfo(camera, flags["registered"], flags["mirrored"], bool(flags[SIMULATED]), calibration, unit_m)


def write_camera_info(
    path: Path,
    camera: Camera,
    *,
    camera_name: str = "carpus",
    registered: bool | None = None,
    mirrored: bool | None = None,
    calibration: StoredCalibration | None = None,
) -> None:
    """Write the camera as a ROS camera calibration file; an existing file is kept."""
    k = [camera.fx_px, 0.0, camera.cx_px, 0.0, camera.fy_px, camera.cy_px, 0.0, 0.0, 1.0]
    content: dict[str, Any] = {
        "image_width": camera.width_px,
        "image_height": camera.height_px,
        "camera_name": camera_name,
        "camera_matrix": _format_matrix(3, 3, k),
        "distortion_model": camera.distortion_model,
        "distortion_coefficients": _format_matrix(1, len(camera.distortion), list(camera.distortion)),
        "rectification_matrix": _format_matrix(3, 3, [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]),
        "projection_matrix": _format_matrix(3, 4, [*k[0:3], 0.0, *k[3:6], 0.0, *k[6:9], 0.0]),
    }
    for name, value in (("registered", registered), ("mirrored", mirrored)):
        if value is not None:
            content[name] = value
    if camera.sensor.origin != ASSUMED:
        content[_SENSOR] = camera.sensor.to_dict()
    if calibration is not None:
        content[_CALIBRATION] = asdict(calibration)
    text = yaml.safe_dump(content, sort_keys=False, default_flow_style=None, width=120)
    try:
        with open(path, "x", encoding="utf-8", opener=open_private) as file:
            file.write(text)
    except FileExistsError as cause:
        raise OutputExists(path) from cause
    except OSError as cause:
        raise write_fault(path, cause) from cause


def rescale_camera(camera: Camera, size_px: tuple[int, int]) -> Camera | None:
    """Return the camera for images scaled to ``size_px``; None if the aspect ratio differs."""
    width, height = size_px
    if size_px == (camera.width_px, camera.height_px):
        return camera
    if width * camera.height_px != height * camera.width_px:
        return None
    scale = width / camera.width_px
    return replace(
        camera,
        fx_px=camera.fx_px * scale,
        fy_px=camera.fy_px * scale,
        cx_px=(camera.cx_px + 0.5) * scale - 0.5,
        cy_px=(camera.cy_px + 0.5) * scale - 0.5,
        width_px=width,
        height_px=height,
    )


def _format_matrix(rows: int, columns: int, data: list[float]) -> dict[str, Any]:
    return {"rows": rows, "cols": columns, "data": [float(value) for value in data]}


def _parse_camera(content: dict[str, Any]) -> Camera:
    model_name = content.get("distortion_model", _DEFAULT_MODEL)
    model = next((each for each in DISTORTION_COEFFICIENT_COUNTS if each == model_name), None)
    if model is None:
        models = " or ".join(DISTORTION_COEFFICIENT_COUNTS)
        raise ValueError(
            phrase("distortion_model {said}, {coefficients} expected", said=model_name, coefficients=models)
        )
    sides: list[int] = []
    for key in ("image_width", "image_height"):
        side = content.get(key)
        if isinstance(side, bool) or not isinstance(side, int) or not 0 < side <= _MAX_SIDE_PX:
            raise ValueError(phrase("{key} is not a number of pixels", key=key))
        sides.append(side)
    width, height = sides
    k = _parse_numbers(content, "camera_matrix")
    if len(k) != 9:
        raise ValueError(phrase("camera_matrix has {count} numbers, 9 expected", count=len(k)))
    fx, skew, cx, zero, fy, cy, *last = k
    if fx <= 0.0 or fy <= 0.0 or [skew, zero, *last] != [0.0, 0.0, 0.0, 0.0, 1.0]:
        raise ValueError(phrase("camera_matrix is not [fx, 0, cx, 0, fy, cy, 0, 0, 1]"))
    if not all(_FOCAL_LENGTH_RANGE[0] <= f / width <= _FOCAL_LENGTH_RANGE[1] for f in (fx, fy)):
        values = {"fx": f"{fx:g}", "fy": f"{fy:g}", "width": width}
        raise ValueError(phrase("fx {fx} and fy {fy} do not fit a frame width of {width} pixels", **values))
    distortion = _parse_numbers(content, "distortion_coefficients") if "distortion_coefficients" in content else []
    wanted = DISTORTION_COEFFICIENT_COUNTS[model]
    if len(distortion) not in (0, 4, 5, wanted):
        counts = {"count": len(distortion), "wanted": wanted}
        raise ValueError(phrase("distortion_coefficients has {count} numbers, {wanted} expected", **counts))
    try:
        sensor = parse_sensor(content[_SENSOR]) if content.get(_SENSOR) is not None else ASSUMED_SENSOR
    except ValueError as cause:
        raise ValueError(f"{_SENSOR}: {cause}") from cause
    lens = (*distortion, *[0.0] * (wanted - len(distortion)))
    camera = Camera(fx, fy, cx, cy, width, height, lens, "file", sensor, model)
    # distorting the undistorted pixels returns them, up to the outer tenth of the image
    across, down = (np.linspace(0.1, 0.9, 5) * size for size in (width, height))
    pixel = np.stack(np.meshgrid(across, down), axis=-1).reshape(-1, 2)
    with np.errstate(all="ignore"):
        off_px = np.abs(camera.distort(camera.undistort(pixel)) - pixel).max()
    if not off_px <= _MAX_ROUND_TRIP_PX:
        raise ValueError(phrase("distortion_coefficients do not describe a lens: they cannot be inverted"))
    return camera


def _parse_calibration(content: dict[str, Any]) -> StoredCalibration | None:
    block = content.get(_CALIBRATION)
    if block is None:
        return None
    try:
        calibration = StoredCalibration(
            str(block["serial"]),
            str(block["calibrated"]),
            float(block["depth_scale"]),
            float(block["depth_offset_m"]),
            float(block["error_px"]),
            int(block["pictures"]),
        )
        if not is_moment(calibration.calibrated):
            raise ValueError(calibration.calibrated)
    except (KeyError, TypeError, ValueError, OverflowError) as cause:
        raise ValueError(phrase("{calibration} is not in the format of Carpus", calibration=_CALIBRATION)) from cause
    is_scale = _SCALE_RANGE[0] <= calibration.depth_scale <= _SCALE_RANGE[1]
    if not (is_scale and abs(calibration.depth_offset_m) <= _MAX_OFFSET_M):
        raise ValueError(phrase("{calibration} has an impossible depth", calibration=_CALIBRATION))
    return calibration


def _parse_depth_unit_m(content: dict[str, Any]) -> float | None:
    value = content.get("depth_unit_m")
    if value is None:
        return None
    try:  # YAML 1.1 takes 1e-3 for a word
        unit_m = math.nan if isinstance(value, bool) else float(value)
    except (TypeError, ValueError):
        unit_m = math.nan
    if not _DEPTH_UNIT_RANGE_M[0] <= unit_m <= _DEPTH_UNIT_RANGE_M[1]:
        raise ValueError(phrase("depth_unit_m is not metres per count, as 0.001 or 0.0002"))
    return unit_m


def _parse_numbers(content: dict[str, Any], key: str) -> list[float]:
    block = content.get(key)
    data = block.get("data") if isinstance(block, dict) else None
    if not isinstance(data, list):
        raise ValueError(phrase("{key} has no data", key=key))
    try:
        # YAML 1.1 takes 1e-05 for a word, so words are read as numbers too
        numbers = [float(value) for value in data if not isinstance(value, bool)]
    except (TypeError, ValueError):
        numbers = []
    if len(numbers) != len(data) or not all(math.isfinite(value) for value in numbers):
        raise ValueError(phrase("{key} contains a value that is not a number", key=key))
    return numbers


def sidecar_path(path: Path) -> Path:
    """Return the camera file of a recording: ``NAME.camera_info.yaml`` beside ``NAME.oni``."""
    return path.with_name(path.stem + ".camera_info.yaml")
