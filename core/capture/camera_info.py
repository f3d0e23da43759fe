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
from carpus.core.model.depth_sensor import ASSUMED, ASSUMED_SENSOR, DepthSensor, parse_sensor
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
    """Calibration measured on a printed board.

    Attributes
    ----------
    serial : str
        Serial number of the camera.
    calibrated : str
        Time of the calibration, ISO 8601 with zone.
    depth_scale, depth_offset_m : float
        Measured depth = scale * true depth + offset; 1 and 0 if depth was not checked.
    error_px : float
        Reprojection error of the board's corners.
    pictures : int
        Number of images of the board.
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
            raise CameraFileUnreadable(path, phrase("much too long for a camera calibration"))
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
    registered, mirrored, simulated = (_parse_flag(path, content, key) for key in ("registered", "mirrored", SIMULATED))
    calibration, unit_m = _parse_calibration(path, content), _parse_depth_unit_m(path, content)
    return CameraInfo(_parse_camera(path, content), registered, mirrored, bool(simulated), calibration, unit_m)


def write_camera_info(
    path: Path,
    camera: Camera,
    *,
    camera_name: str = "carpus",
    registered: bool | None = None,
    mirrored: bool | None = None,
    simulated: bool = False,
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
    if simulated:
        content[SIMULATED] = True
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


def _parse_camera(path: Path, content: dict[str, Any]) -> Camera:
    said = content.get("distortion_model", _DEFAULT_MODEL)
    model = next((known for known in DISTORTION_COEFFICIENT_COUNTS if known == said), None)
    if model is None:
        raise CameraFileUnreadable(
            path,
            phrase(
                "distortion_model {said}, {coefficients} expected",
                said=said,
                coefficients=" or ".join(DISTORTION_COEFFICIENT_COUNTS),
            ),
        )
    width, height = (_parse_size(path, content, key) for key in ("image_width", "image_height"))
    k = _parse_numbers(path, content, "camera_matrix")
    if len(k) != 9:
        raise CameraFileUnreadable(path, phrase("camera_matrix has {count} numbers, 9 expected", count=len(k)))
    fx, skew, cx, zero, fy, cy, *last = k
    if fx <= 0.0 or fy <= 0.0 or [skew, zero, *last] != [0.0, 0.0, 0.0, 0.0, 1.0]:
        raise CameraFileUnreadable(path, phrase("camera_matrix is not [fx, 0, cx, 0, fy, cy, 0, 0, 1]"))
    if not all(_FOCAL_LENGTH_RANGE[0] <= f / width <= _FOCAL_LENGTH_RANGE[1] for f in (fx, fy)):
        raise CameraFileUnreadable(
            path,
            phrase(
                "fx {fx} and fy {fy} are no camera's with pictures {width} pixels wide",
                fx=f"{fx:g}",
                fy=f"{fy:g}",
                width=width,
            ),
        )
    distortion = (
        _parse_numbers(path, content, "distortion_coefficients") if "distortion_coefficients" in content else []
    )
    wanted = DISTORTION_COEFFICIENT_COUNTS[model]
    if len(distortion) not in (0, 4, 5, wanted):
        raise CameraFileUnreadable(
            path,
            phrase(
                "distortion_coefficients has {count} numbers, {wanted} expected", count=len(distortion), wanted=wanted
            ),
        )
    lens = (*distortion, *[0.0] * (wanted - len(distortion)))
    camera = Camera(fx, fy, cx, cy, width, height, lens, "file", _parse_sensor(path, content), model)
    if not _is_distortion_invertible(camera):
        raise CameraFileUnreadable(
            path,
            phrase("distortion_coefficients are no lens’s: points do not find back to their places"),
        )
    return camera


def _is_distortion_invertible(camera: Camera) -> bool:
    """Return whether distorting the undistorted pixels returns them, up to the outer tenth."""
    across, down = (np.linspace(0.1, 0.9, 5) * size for size in (camera.width_px, camera.height_px))
    pixel = np.stack(np.meshgrid(across, down), axis=-1).reshape(-1, 2)
    with np.errstate(all="ignore"):
        off_px = np.abs(camera.distort(camera.undistort(pixel)) - pixel).max()
    return bool(off_px <= _MAX_ROUND_TRIP_PX)


def _parse_sensor(path: Path, content: dict[str, Any]) -> DepthSensor:
    said = content.get(_SENSOR)
    if said is None:
        return ASSUMED_SENSOR
    try:
        return parse_sensor(said)
    except ValueError as cause:
        raise CameraFileUnreadable(path, f"{_SENSOR}: {cause}") from cause


def _parse_calibration(path: Path, content: dict[str, Any]) -> StoredCalibration | None:
    said = content.get(_CALIBRATION)
    if said is None:
        return None
    try:
        out = StoredCalibration(
            str(said["serial"]),
            str(said["calibrated"]),
            float(said["depth_scale"]),
            float(said["depth_offset_m"]),
            float(said["error_px"]),
            int(said["pictures"]),
        )
        if not is_moment(out.calibrated):
            raise ValueError(out.calibrated)
    except (KeyError, TypeError, ValueError, OverflowError) as cause:
        raise CameraFileUnreadable(
            path, phrase("{calibration} is not as Carpus writes it", calibration=_CALIBRATION)
        ) from cause
    if not (_SCALE_RANGE[0] <= out.depth_scale <= _SCALE_RANGE[1] and abs(out.depth_offset_m) <= _MAX_OFFSET_M):
        raise CameraFileUnreadable(
            path, phrase("{calibration} has depth that no camera reads", calibration=_CALIBRATION)
        )
    return out


def _parse_size(path: Path, content: dict[str, Any], key: str) -> int:
    value = content.get(key)
    if isinstance(value, bool) or not isinstance(value, int) or not 0 < value <= _MAX_SIDE_PX:
        raise CameraFileUnreadable(path, phrase("{key} is not a number of pixels", key=key))
    return value


def _parse_depth_unit_m(path: Path, content: dict[str, Any]) -> float | None:
    value = content.get("depth_unit_m")
    if value is None:
        return None
    try:  # YAML 1.1 takes 1e-3 for a word
        unit_m = math.nan if isinstance(value, bool) else float(value)
    except (TypeError, ValueError):
        unit_m = math.nan
    if not _DEPTH_UNIT_RANGE_M[0] <= unit_m <= _DEPTH_UNIT_RANGE_M[1]:
        raise CameraFileUnreadable(path, phrase("depth_unit_m is not metres per count, as 0.001 or 0.0002"))
    return unit_m


def _parse_flag(path: Path, content: dict[str, Any], key: str) -> bool | None:
    value = content.get(key)
    if value is None or isinstance(value, bool):
        return value
    raise CameraFileUnreadable(path, phrase("{key} is neither true nor false", key=key))


def _parse_numbers(path: Path, content: dict[str, Any], key: str) -> list[float]:
    block = content.get(key)
    data = block.get("data") if isinstance(block, dict) else None
    if not isinstance(data, list):
        raise CameraFileUnreadable(path, phrase("{key} has no data", key=key))
    try:
        # YAML 1.1 takes 1e-05 for a word, so words are read as numbers too
        numbers = [float(value) for value in data if not isinstance(value, bool)]
    except (TypeError, ValueError) as cause:
        raise CameraFileUnreadable(path, phrase("{key} holds something that is not a number", key=key)) from cause
    if len(numbers) != len(data) or not all(math.isfinite(value) for value in numbers):
        raise CameraFileUnreadable(path, phrase("{key} holds something that is not a number", key=key))
    return numbers


def sidecar_path(path: Path) -> Path:
    """Return the camera file of a recording: ``NAME.camera_info.yaml`` beside ``NAME.oni``."""
    return path.with_name(path.stem + ".camera_info.yaml")
