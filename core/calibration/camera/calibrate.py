"""Camera calibration: intrinsics by Zhang's method (OpenCV), depth error and registration.

A depth reading is compared with the distance of the board's plane at its pixel: measured = scale * true + offset +
slope_u * du + slope_v * dv, where the slopes are the change of the plane's distance per pixel. A registration error du,
dv shows on a tilted board only.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import datetime
from pathlib import Path

import cv2
import numpy as np

from carpus.core.calibration.camera.board import (
    MIN_DISTANCE_RATIO,
    BoardView,
    ViewCoverage,
    assess_views,
)
from carpus.core.capture.calibrated_source import new_calibration_path
from carpus.core.capture.camera_info import StoredCalibration, write_camera_info
from carpus.core.model.camera import Camera
from carpus.core.model.dates import to_iso
from carpus.core.model.depth_sensor import DepthSensor
from carpus.core.model.errors import BoardNotVisible, BoardUnfit, BoardViewsTooSimilar
from carpus.core.model.phrase import phrase
from carpus.core.model.rounding import format_rounded
from carpus.core.model.types import FloatArray
from carpus.core.platform.durable import write_fault

MAX_REGISTRATION_ERROR_PX = 2.0
"""With a larger error depth is read beside the markers."""
MIN_DEPTH_VIEWS = 6
MIN_OFFSET_SDS = 2.0
"""A smaller offset is none."""
_STEP_PX = 4
_BOARD_MARGIN_PX = 6
"""Excluded along the board's edge: a depth window there holds two surfaces."""
_MIN_READINGS = 200
_ITERATIONS, _TRIM_SDS = 3, 3.5
_MAX_DEPTH_ERROR_SHARE = 0.2
"""Readings further off are not of the board."""


@dataclass(frozen=True, slots=True)
class DepthCheck:
    """Measured against true depth, with standard deviations.

    The offset is 0, its standard deviation NaN, if none is significant. ``registration_error_px`` (2,) is the offset of
    depth against colour.
    """

    scale: float
    scale_sd: float
    offset_m: float
    offset_sd_m: float
    registration_error_px: FloatArray
    registration_sd_px: float
    view_count: int

    @property
    def is_registered(self) -> bool:
        """True if depth lies on colour well enough to be read under a marker."""
        return float(np.linalg.norm(self.registration_error_px)) <= MAX_REGISTRATION_ERROR_PX

    def sentence(self) -> str:
        """Return one sentence for people.

        >>> DepthCheck(0.996, 0.001, 0.0, float("nan"), np.zeros(2), 0.1, 20).sentence()
        'Depth reads 0.4 % too short.'
        """
        share = 100.0 * (self.scale - 1.0)
        if abs(share) < 0.05 and abs(self.offset_m) < 0.5e-3:
            return "Depth reads right."
        shift = f" and {format_rounded(abs(self.offset_m) * 1e3, 1)} mm too {'long' if self.offset_m > 0 else 'short'}"
        shift = shift if math.isfinite(self.offset_sd_m) else ""
        return f"Depth reads {format_rounded(abs(share), 1)} % too {'long' if share > 0 else 'short'}{shift}."


def estimate_depth_error(views: Sequence[BoardView], intrinsics: Intrinsics, sensor: DepthSensor) -> DepthCheck | None:
    """Compare depth with the board's plane over all used views; None if too few have depth."""
    poses = zip(intrinsics.board_rotation_vector, intrinsics.board_translation_m, strict=True)
    blocks = [
        _depth_readings(views[k], intrinsics.camera, *pose)
        for k, pose in zip(intrinsics.used_views, poses, strict=True)
    ]
    known = [block for block in blocks if block is not None]
    if len(known) < MIN_DEPTH_VIEWS:
        return None
    middle = np.array([np.median(block[:, 1]) for block in known])
    with_offset = bool(middle.max() >= MIN_DISTANCE_RATIO * middle.min())
    values, sd = _fit_with_sd(known, with_offset, sensor)
    if with_offset and abs(values[3]) < MIN_OFFSET_SDS * sd[3]:
        # An uncertain offset only makes the scale less certain.
        values, sd = _fit_with_sd(known, False, sensor)
        with_offset = False
    offset, offset_sd = (float(values[3]), float(sd[3])) if with_offset else (0.0, math.nan)
    apart_sd = float(sd[1:3].max())
    # An error of the focal length changes every true distance by the same share.
    scale_sd = math.hypot(float(sd[0]), intrinsics.focal_sd_px / intrinsics.camera.fx_px)
    return DepthCheck(float(values[0]), scale_sd, offset, offset_sd, values[1:3], apart_sd, len(known))


def _fit_with_sd(blocks: Sequence[FloatArray], with_offset: bool, sensor: DepthSensor) -> tuple[FloatArray, FloatArray]:
    """Fit, with jackknife standard deviations over the views: readings of one view share their error."""
    count = len(blocks)
    others = np.array([_fit_robust([*blocks[:k], *blocks[k + 1 :]], with_offset, sensor) for k in range(count)])
    spread = others - others.mean(axis=0)
    sd = np.sqrt((count - 1) / count * np.sum(spread**2, axis=0))
    return _fit_robust(blocks, with_offset, sensor), np.asarray(sd)


def _design_matrix(block: FloatArray, with_offset: bool) -> FloatArray:
    """Return the columns of the fit: true depth, both slopes, 1 for an offset."""
    return np.column_stack((block[:, 1:4], np.ones(len(block)))) if with_offset else block[:, 1:4]


def _fit_robust(blocks: Sequence[FloatArray], with_offset: bool, sensor: DepthSensor) -> FloatArray:
    """Fit weighted least squares without outliers; each view has the same weight."""
    design = np.concatenate([_design_matrix(block, with_offset) for block in blocks])
    measured = np.concatenate([block[:, 0] for block in blocks])
    share = np.concatenate([np.full(len(block), 1.0 / math.sqrt(len(block))) for block in blocks])
    sd = sensor.reading_sd_m(design[:, 0])
    kept = np.ones(len(measured), dtype=bool)
    values: FloatArray = np.zeros(design.shape[1])
    for _ in range(_ITERATIONS):
        weight = (share / sd)[kept]
        found = np.linalg.lstsq(design[kept] * weight[:, None], measured[kept] * weight, rcond=None)[0]
        values = np.asarray(found, dtype=np.float64)
        off = (measured - design @ values) / sd
        spread = 1.4826 * float(np.median(np.abs(off[kept])))
        kept = np.abs(off) <= _TRIM_SDS * max(spread, 1e-9)
    return values


def _depth_readings(
    view: BoardView, camera: Camera, rotation_vector: FloatArray, translation_m: FloatArray
) -> FloatArray | None:
    """Return rows (R, 4) of measured and true depth and the slopes along u and v, inside the board."""
    if view.depth_raw is None:
        return None
    rotation = np.asarray(cv2.Rodrigues(rotation_vector)[0], dtype=np.float64)
    outline = view.detected.board.outline_m @ rotation.T + translation_m
    inside = np.zeros((camera.height_px, camera.width_px), np.uint8)
    corners = camera.distort(camera.project(outline))
    cv2.fillConvexPoly(inside, np.round(corners).astype(np.int32), 1)
    edge = 2 * _BOARD_MARGIN_PX + 1
    kernel = np.ones((edge, edge), np.uint8)
    inside = np.asarray(cv2.erode(inside, kernel, borderType=cv2.BORDER_CONSTANT, borderValue=0))
    v, u = np.nonzero(inside[::_STEP_PX, ::_STEP_PX])
    u, v = u * _STEP_PX, v * _STEP_PX
    measured = view.depth_raw[v, u] * view.depth_unit_m
    pixel = np.stack((u, v), axis=-1).astype(np.float64)
    normal = rotation[:, 2]
    height = float(normal @ translation_m)

    def plane_distance_m(pixel_at: FloatArray) -> FloatArray:
        ideal = camera.undistort(pixel_at)
        return np.asarray(height / (camera.backproject(ideal, np.ones(len(pixel_at))) @ normal))

    true = plane_distance_m(pixel)
    slopes = [0.5 * (plane_distance_m(pixel + step) - plane_distance_m(pixel - step)) for step in np.eye(2)]
    rows = np.column_stack((measured, true, *slopes))
    kept = (measured > 0.0) & (np.abs(measured - true) < _MAX_DEPTH_ERROR_SHARE * true)
    return rows[kept] if np.count_nonzero(kept) >= _MIN_READINGS else None


GOOD_ERROR_PX, FAIR_ERROR_PX, MAX_ERROR_PX = 0.3, 0.6, 1.2
"""Root mean square distance of a corner from its reprojection."""
MAX_FOCAL_SD_SHARE = 0.002
"""With a less certain focal length the views were too similar."""
_OUTLIER_FACTOR = 3.0
_MIN_VIEWS_KEPT = 10


@dataclass(frozen=True, slots=True)
class Intrinsics:
    """Camera model with its standard deviations.

    ``reprojection_error_px`` is the RMS over all corners; the board's pose in each used view is (V, 3) rotation vectors
    and translations.
    """

    camera: Camera
    focal_sd_px: float
    principal_point_sd_px: float
    reprojection_error_px: float
    board_rotation_vector: FloatArray
    board_translation_m: FloatArray
    used_views: tuple[int, ...]

    @property
    def error_text(self) -> str:
        """Quality of the fit in words."""
        for limit, words in ((GOOD_ERROR_PX, "good"), (FAIR_ERROR_PX, "fair")):
            if self.reprojection_error_px <= limit:
                return f"{words}: below {limit:g} px"
        return f"poor: above {FAIR_ERROR_PX:g} px"


def solve_intrinsics(views: Sequence[BoardView], width_px: int, height_px: int, subject: str) -> Intrinsics:
    """Estimate intrinsics and distortion (k1, k2, p1, p2) from the views. Raises as :func:`calibrate_camera`."""
    fit, view_error_px = _fit_intrinsics(views, range(len(views)), width_px, height_px)
    # Views with a blurred image or a bent board are excluded.
    kept = np.flatnonzero(view_error_px <= _OUTLIER_FACTOR * float(np.median(view_error_px))).tolist()
    if _MIN_VIEWS_KEPT <= len(kept) < len(views):
        fit, _ = _fit_intrinsics(views, kept, width_px, height_px)
    if fit.reprojection_error_px > MAX_ERROR_PX or not math.isfinite(fit.reprojection_error_px):
        sizes = {"error_px": format_rounded(fit.reprojection_error_px, 1), "most_px": f"{MAX_ERROR_PX:g}"}
        raise BoardUnfit(subject, phrase("reprojection error {error_px} px, at most {most_px} px accepted", **sizes))
    if fit.focal_sd_px > MAX_FOCAL_SD_SHARE * fit.camera.fx_px:
        share = format_rounded(100.0 * fit.focal_sd_px / fit.camera.fx_px, 1)
        raise BoardViewsTooSimilar(subject, phrase("the focal length is uncertain by {share} %", share=share))
    return fit


def _fit_intrinsics(
    views: Sequence[BoardView], used_views: Sequence[int], width_px: int, height_px: int
) -> tuple[Intrinsics, FloatArray]:
    """Return the intrinsics of the used views, and the RMS error (U,) of each."""
    some = [views[k].detected for k in used_views]
    points = [found.board.corners_m.astype(np.float32) for found in some]
    pixels = [found.pixel.astype(np.float32).reshape(-1, 1, 2) for found in some]
    guess = np.array([[width_px * 0.82, 0.0, 0.5 * (width_px - 1)], [0.0, width_px * 0.82, 0.5 * (height_px - 1)],
                      [0.0, 0.0, 1.0]])  # fmt: skip
    # On a lens of 60 degrees k3 cannot be separated from k2, and would bend the corners of the image.
    flags = cv2.CALIB_FIX_K3 | cv2.CALIB_USE_INTRINSIC_GUESS
    error, k, bend, turns, shifts, sd, _, view_error = cv2.calibrateCameraExtended(
        points, pixels, (width_px, height_px), guess, np.zeros(5), flags=flags
    )
    sd = np.asarray(sd).ravel()
    k1, k2, p1, p2, k3 = (float(value) for value in np.asarray(bend).ravel()[:5])
    camera = Camera(
        float(k[0, 0]), float(k[1, 1]), float(k[0, 2]), float(k[1, 2]), width_px, height_px, (k1, k2, p1, p2, k3),
        origin="calibration",
    )  # fmt: skip
    board_turn, board_shift_m = (np.array([np.ravel(one) for one in each]) for each in (turns, shifts))
    focal_sd_px, middle_sd_px = float(max(sd[0], sd[1])), float(max(sd[2], sd[3]))
    found = Intrinsics(camera, focal_sd_px, middle_sd_px, float(error), board_turn, board_shift_m, tuple(used_views))
    return found, np.asarray(view_error, dtype=np.float64).ravel()


@dataclass(frozen=True, slots=True)
class CameraCalibration:
    """Result of a camera calibration; ``previous_camera`` is the source's, ``depth`` None without depth."""

    previous_camera: Camera
    intrinsics: Intrinsics
    depth: DepthCheck | None
    coverage: ViewCoverage
    board: str

    @property
    def is_usable(self) -> bool:
        """True if corners reproject fairly and depth, if there is any, lies on colour.

        Otherwise sessions would be measured worse than before.
        """
        fits = self.intrinsics.reprojection_error_px <= FAIR_ERROR_PX
        return fits and (self.depth is None or self.depth.is_registered)


def calibrate_camera(views: Sequence[BoardView], previous_camera: Camera, subject: str) -> CameraCalibration:
    """Calibrate from the collected views.

    Raises :class:`BoardNotVisible` without a board, :class:`BoardViewsTooSimilar` with too few or similar views,
    :class:`BoardUnfit` if the corners are not those of a flat board.
    """
    if not views:
        raise BoardNotVisible(subject, phrase("in none of the images"))
    coverage = assess_views(views, previous_camera.width_px, previous_camera.height_px)
    if coverage.missing_text:
        raise BoardViewsTooSimilar(subject, coverage.missing_text)
    intrinsics = solve_intrinsics(views, previous_camera.width_px, previous_camera.height_px, subject)
    depth = estimate_depth_error(views, intrinsics, previous_camera.sensor)
    return CameraCalibration(previous_camera, intrinsics, depth, coverage, views[0].detected.board.name())


def format_calibration(calibration: CameraCalibration) -> list[str]:
    """Return the result as lines for people."""
    found, before, depth = calibration.intrinsics, calibration.previous_camera, calibration.depth
    camera, focal = found.camera, f"{format_rounded(found.camera.fx_px, 1)} x {format_rounded(found.camera.fy_px, 1)}"
    middle = f"{format_rounded(camera.cx_px, 1)}, {format_rounded(camera.cy_px, 1)}"
    was_focal = f"{format_rounded(before.fx_px, 1)} x {format_rounded(before.fy_px, 1)}"
    was_middle = f"{format_rounded(before.cx_px, 1)}, {format_rounded(before.cy_px, 1)}"
    coverage = calibration.coverage
    near, far = (format_rounded(distance_m * 100) for distance_m in (coverage.nearest_m, coverage.farthest_m))
    out = [
        f"Board: {calibration.board}, {len(found.used_views)} pictures, {near} to {far} cm away",
        f"Lines land within {format_rounded(found.reprojection_error_px, 2)} px ({found.error_text})",
        f"Focal length: {focal} ± {format_rounded(found.focal_sd_px, 1)} px (was {was_focal})",
        f"Middle of the picture: {middle} ± {format_rounded(found.principal_point_sd_px, 1)} px (was {was_middle})",
    ]
    if depth is None:
        return [*out, "Depth: not checked, too few images with depth on the board"]
    shift = f"shift {depth.offset_m * 1e3:+.1f} ± {format_rounded(depth.offset_sd_m * 1e3, 1)} mm"
    shift = shift if math.isfinite(depth.offset_sd_m) else "no sure shift"
    scale = f"{100.0 * (depth.scale - 1.0):+.2f} ± {format_rounded(100.0 * depth.scale_sd, 2)} %"
    distance_px = float((depth.registration_error_px**2).sum() ** 0.5)
    judged = (
        f"good: below {MAX_REGISTRATION_ERROR_PX:g} px" if depth.is_registered else "depth and colour are not aligned"
    )
    error = f"{format_rounded(distance_px, 1)} ± {format_rounded(depth.registration_sd_px, 1)} px"
    return [*out, f"{depth.sentence()} Scale {scale}, {shift}", f"Colour and depth: {error} apart ({judged})"]


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
