"""Measurement of the check card in frames, and the limits of the sensor."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from carpus.core.calibration.candidates import find_marker_candidates
from carpus.core.calibration.card.card import (
    CHECK_S,
    DIMENSIONS,
    DISCS,
    MAX_ANGLE_ERROR_DEG,
    MAX_LENGTH_ERROR_MM,
    CardReading,
    disc_positions_m,
    measure_dimensions,
)
from carpus.core.detection.appearance import DetectionSettings
from carpus.core.model.camera import Camera
from carpus.core.model.errors import CardNotVisible
from carpus.core.model.phrase import phrase
from carpus.core.model.types import Detections, FloatArray, Frame

# Tolerance of the card's dimensions: the fixed limits, or those of the sensor if they are wider.
#
# Averaging does not remove the constant part of a sensor's error (bumps, pattern) while the card lies still: a good
# camera with wide bumps is several degrees off on a face as small as the wedge's. If neighbouring pixels share the step
# to which depth is rounded, a part of that step stays too.
LIMIT_SDS = 3.0
"""A camera within tolerance exceeds it in one dimension of 370."""
_ROUNDING_SHARE = 0.4
"""Share of a reading's sd that rounding leaves of a disc at rest (simulated, 120 frames)."""
_STEP_M = 1e-5


def dimensions_sd(positions_m: FloatArray, camera: Camera) -> FloatArray:
    """Return the sd (6,) of the dimensions from the depth error that averaging leaves, discs (6, 3)."""
    depth_m = positions_m[:, 2]
    rounded_m = 0.0 if camera.sensor.averages else _ROUNDING_SHARE * camera.sensor.reading_sd_m(depth_m)
    sd_m = np.hypot(camera.sensor.flat_bias_sd_m(depth_m), rounded_m)
    covariance = np.outer(sd_m, sd_m) * _error_correlation(positions_m, camera)
    rays = positions_m / depth_m[:, None]
    dimensions = measure_dimensions(positions_m)
    slope = np.empty((len(DIMENSIONS), len(positions_m)))
    for k, ray in enumerate(rays):
        moved = positions_m.copy()
        moved[k] += _STEP_M * ray
        slope[:, k] = (measure_dimensions(moved) - dimensions) / _STEP_M
    return np.asarray(np.sqrt(np.einsum("ij,jk,ik->i", slope, covariance, slope)))


def card_limits(positions_m: FloatArray, camera: Camera) -> tuple[float, float]:
    """Return the largest errors of an angle (degrees) and a length (mm) within tolerance."""
    sd = LIMIT_SDS * dimensions_sd(positions_m, camera)
    angles = max(sd[k] for k, dimension in enumerate(DIMENSIONS) if dimension.kind == "angle")
    lengths = max(sd[k] for k, dimension in enumerate(DIMENSIONS) if dimension.kind == "length")
    return max(MAX_ANGLE_ERROR_DEG, float(angles)), max(MAX_LENGTH_ERROR_MM, float(lengths))


def _error_correlation(positions_m: FloatArray, camera: Camera) -> FloatArray:
    """Return the correlation (6, 6) of the constant depth error between the discs."""
    reach_px = camera.sensor.stays_px
    if reach_px <= 0.0:
        return np.eye(len(positions_m))
    pixel = camera.project(positions_m)
    apart_px = np.linalg.norm(pixel[:, None] - pixel[None], axis=-1)
    return np.asarray(np.exp(-2.0 * (apart_px / reach_px) ** 2))


SEARCH_INTERVAL_S = 0.25
"""Successive frames share their depth pattern: more of them add little."""
MIN_FRAMES = 5
_MAX_BLOBS = 8
_MAX_MISFIT_M = 0.015
"""Limit of the RMS error of all distances between discs."""
_MAX_MOTION_M = 0.02
"""Motion of a disc between two frames that is no noise."""
_MAX_GAP_S = 1.5
"""Longer gaps between two frames do not count as time at rest."""


@dataclass(frozen=True, slots=True)
class CardFrame:
    """Result of one frame: pixels (6, 2) of discs A to F, None if they are not all found.

    ``blue_count`` counts blue spots of any kind. ``has_moved``: the card moved, and the measurement starts again.
    """

    pixel: FloatArray | None
    blue_count: int
    steady_s: float
    frames_used: int
    has_moved: bool = False


class CardMeasurement:
    """Measures the card frame by frame.

    With ``only_steady`` only time counts in which the card is found at rest, for a live camera; else the first 30 s.
    """

    def __init__(self, camera: Camera, *, only_steady: bool = False) -> None:
        self._camera, self._only_steady = camera, only_steady
        self._positions: list[FloatArray] = []
        self._frames_searched, self._first_s, self._last_s, self._measured_s = 0, math.nan, -math.inf, 0.0

    @property
    def is_done(self) -> bool:
        return self._measured_s >= CHECK_S

    def process_frame(self, frame: Frame) -> CardFrame | None:
        """Search a frame for the card; None without depth or too soon after the last one."""
        now_s = frame.timestamp_s
        self._first_s = now_s if math.isnan(self._first_s) else self._first_s
        if frame.depth_raw is None or now_s - self._last_s < SEARCH_INTERVAL_S:
            return None
        since_s, self._last_s = now_s - self._last_s, now_s
        blobs = find_marker_candidates(frame, self._camera, DetectionSettings())
        self._frames_searched += 1
        found = find_card_discs(blobs, self._camera)
        moved = False
        if found is not None:
            if self._only_steady and self._positions and np.abs(found[0] - self._positions[-1]).max() > _MAX_MOTION_M:
                moved, self._positions, self._frames_searched, self._measured_s = True, [], 1, 0.0
            elif self._positions and since_s < _MAX_GAP_S:
                self._measured_s += since_s
            self._positions.append(found[0])
        if not self._only_steady:
            self._measured_s = now_s - self._first_s
        return CardFrame(None if found is None else found[1], len(blobs), self._measured_s, len(self._positions), moved)

    def compute_reading(self, subject: str) -> CardReading:
        """Compute the result. Raises :class:`CardNotVisible` with fewer than five frames."""
        if len(self._positions) < MIN_FRAMES:
            counts = {"count": len(self._positions), "looked": self._frames_searched}
            raise CardNotVisible(subject, phrase("all six markers visible in {count} of {looked} frames", **counts))
        each = np.array([measure_dimensions(one) for one in self._positions])
        middle = np.median(np.array(self._positions), axis=0)
        once = np.triu_indices(len(DISCS), 1)
        measured, true = (_distance_matrix(points)[once] for points in (middle, disc_positions_m()))
        scale = measured @ true / np.sum(true**2)
        distance_m = float(np.linalg.norm(middle.mean(axis=0)))
        sd = each.std(axis=0, ddof=1)
        return CardReading(
            measure_dimensions(middle), sd, float(scale), distance_m, len(self._positions),
            *card_limits(middle, self._camera),
        )  # fmt: skip


def measure_card(frames: Iterable[Frame], camera: Camera, subject: str) -> CardReading:
    """Measure the card over the first 30 s. Raises :class:`CardNotVisible` with fewer than five frames."""
    measurement = CardMeasurement(camera)
    first_s = math.nan
    for frame in frames:
        first_s = frame.timestamp_s if math.isnan(first_s) else first_s
        if frame.timestamp_s - first_s > CHECK_S:
            break
        measurement.process_frame(frame)
    return measurement.compute_reading(subject)


def find_card_discs(blobs: Detections, camera: Camera) -> tuple[FloatArray, FloatArray] | None:
    """Identify the six discs by their distances: (6, 3) in the camera, (6, 2) pixels; None if incomplete."""
    usable = np.flatnonzero(np.isfinite(blobs.depth_m))
    if len(usable) < 6:
        return None
    best = usable[np.argsort(-blobs.similarity[usable])][:_MAX_BLOBS]
    points = camera.backproject(camera.undistort(blobs.pixel[best]), blobs.depth_m[best])
    true = _distance_matrix(disc_positions_m())
    measured = _distance_matrix(points)
    orders = np.array(list(itertools.permutations(range(len(best)), 6)))
    off = measured[orders[:, :, None], orders[:, None, :]] - true
    misfit = np.sqrt(np.mean(off**2, axis=(1, 2)))
    k = int(np.argmin(misfit))
    if misfit[k] > _MAX_MISFIT_M:
        return None
    return np.asarray(points[orders[k]]), np.asarray(blobs.pixel[best][orders[k]])


def _distance_matrix(points: FloatArray) -> FloatArray:
    """Return all distances (P, P) between points."""
    return np.asarray(np.linalg.norm(points[:, None] - points[None], axis=-1))
