"""The six discs of the card in pictures, and what a check of some seconds says."""

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
    MAX_ANGLE_ERROR_DEG,
    MAX_LENGTH_ERROR_MM,
    CardReading,
    disc_positions_m,
    measure_dimensions,
)
from carpus.core.detection.settings import DetectionSettings
from carpus.core.model.camera import Camera
from carpus.core.model.errors import CardNotVisible
from carpus.core.model.phrase import phrase
from carpus.core.model.types import Detections, FloatArray, Frame

# How far off the card's figures may be: the fixed limits, or what the sensor states of itself where that is more.
#
# What stays of a sensor's error as long as the card lies (its bumps, its pattern) no number of pictures takes away: of
# a camera with wide bumps a right one is several degrees off on a face as small as the wedge's. Of a sensor whose
# neighbours share the step to which depth is rounded, a part of that step stays too, since nothing moves.
LIMIT_SDS = 3.0
"""A right camera is beyond this many standard deviations in one figure of 370."""
_ROUNDING_SHARE = 0.4
"""Of one reading's standard deviation: what rounding leaves of a disc that lies still (simulated, 120 pictures)."""
_STEP_M = 1e-5


def dimensions_sd(positions_m: FloatArray, camera: Camera) -> FloatArray:
    """Standard deviation (6,) of the card's figures, degrees and millimetres, from what stays of the depth error of the
    discs at (6, 3) in camera axes."""
    depth_m = positions_m[:, 2]
    rounded_m = 0.0 if camera.sensor.averages else _ROUNDING_SHARE * camera.sensor.reading_sd_m(depth_m)
    sd_m = np.hypot(camera.sensor.flat_bias_sd_m(depth_m), rounded_m)
    covariance = np.outer(sd_m, sd_m) * _error_correlation(positions_m, camera)
    rays = positions_m / depth_m[:, None]
    right = measure_dimensions(positions_m)
    slope = np.empty((len(DIMENSIONS), len(positions_m)))
    for k, ray in enumerate(rays):
        moved = positions_m.copy()
        moved[k] += _STEP_M * ray
        slope[:, k] = (measure_dimensions(moved) - right) / _STEP_M
    return np.asarray(np.sqrt(np.einsum("ij,jk,ik->i", slope, covariance, slope)))


def card_limits(positions_m: FloatArray, camera: Camera) -> tuple[float, float]:
    """Largest error of an angle (degrees) and of a length (millimetres) that a right camera may show."""
    sd = LIMIT_SDS * dimensions_sd(positions_m, camera)
    angles = max(sd[k] for k, figure in enumerate(DIMENSIONS) if figure.kind == "angle")
    lengths = max(sd[k] for k, figure in enumerate(DIMENSIONS) if figure.kind == "length")
    return max(MAX_ANGLE_ERROR_DEG, float(angles)), max(MAX_LENGTH_ERROR_MM, float(lengths))


def _error_correlation(positions_m: FloatArray, camera: Camera) -> FloatArray:
    """How far the error that stays is the same at two discs (6, 6): wholly at one place, not at all where they are
    further apart than the sensor says."""
    reach_px = camera.sensor.stays_px
    if reach_px <= 0.0:
        return np.eye(len(positions_m))
    pixel = camera.project(positions_m)
    apart_px = np.linalg.norm(pixel[:, None] - pixel[None], axis=-1)
    return np.asarray(np.exp(-2.0 * (apart_px / reach_px) ** 2))


SEARCH_INTERVAL_S = 0.25
"""Pictures in a row have the same pattern in their depth: more of them say little more."""
MIN_FRAMES = 5
_MAX_BLOBS = 8
_MAX_MISFIT_M = 0.015
"""Root mean square over all distances between discs: more is not the card."""
_MAX_MOTION_M = 0.02
"""From one look to the next, of any disc: more is no noise."""
_MAX_GAP_S = 1.5
"""Time between two looks that counts: longer, and nobody knows what was in between."""


@dataclass(frozen=True, slots=True)
class CardFrame:
    """What one picture shows: ``pixel`` of the discs A to F (6, 2), None where they are not all seen; ``blue_count``
    discs of
    any kind; ``steady_s`` of steady pictures so far and how many ``frames_used`` count; ``has_moved``: it lies
    elsewhere than
    before, and all begins again."""

    pixel: FloatArray | None
    blue_count: int
    steady_s: float
    frames_used: int
    has_moved: bool = False


class CardMeasurement:
    """Looks at the card in one frame after the other. With ``only_steady`` only time counts in which the card is seen
    and
    lies still, as before a live camera; else the first 30 s, as of a recording."""

    def __init__(self, camera: Camera, settings: DetectionSettings | None = None, *, only_steady: bool = False) -> None:
        self._camera, self._settings, self._only_steady = camera, settings or DetectionSettings(), only_steady
        self._positions: list[FloatArray] = []
        self._frames_searched, self._first_s, self._last_s, self._measured_s = 0, math.nan, -math.inf, 0.0

    @property
    def is_done(self) -> bool:
        return self._measured_s >= CHECK_S

    def process_frame(self, frame: Frame) -> CardFrame | None:
        """Look at a frame; None where it has no depth or comes too soon after the last one."""
        now_s = frame.timestamp_s
        self._first_s = now_s if math.isnan(self._first_s) else self._first_s
        if frame.depth_raw is None or now_s - self._last_s < SEARCH_INTERVAL_S:
            return None
        since_s, self._last_s = now_s - self._last_s, now_s
        blobs = find_marker_candidates(frame, self._camera, self._settings)
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
        """What was measured. Raises :class:`CardNotVisible` where the six discs were seen in fewer than five
        pictures."""
        if len(self._positions) < MIN_FRAMES:
            raise CardNotVisible(
                subject,
                phrase(
                    "all six discs in {count} of {looked} pictures",
                    count=len(self._positions),
                    looked=self._frames_searched,
                ),
            )
        each = np.array([measure_dimensions(one) for one in self._positions])
        middle = np.median(np.array(self._positions), axis=0)
        ratio = (
            _pairwise_distances(middle)
            @ _pairwise_distances(disc_positions_m())
            / np.sum(_pairwise_distances(disc_positions_m()) ** 2)
        )
        distance_m = float(np.linalg.norm(middle.mean(axis=0)))
        sd = each.std(axis=0, ddof=1)
        return CardReading(
            measure_dimensions(middle), sd, float(ratio), distance_m, len(self._positions), self._frames_searched,
            *card_limits(middle, self._camera),
        )  # fmt: skip


def measure_card(
    frames: Iterable[Frame], camera: Camera, subject: str, settings: DetectionSettings | None = None
) -> CardReading:
    """Measure the card over the first 30 s of frames.

    Raises :class:`CardNotVisible` where its six discs are seen in fewer than five pictures.
    """
    watch = CardMeasurement(camera, settings)
    first_s = math.nan
    for frame in frames:
        first_s = frame.timestamp_s if math.isnan(first_s) else first_s
        if frame.timestamp_s - first_s > CHECK_S:
            break
        watch.process_frame(frame)
    return watch.compute_reading(subject)


def find_card_discs(blobs: Detections, camera: Camera) -> tuple[FloatArray, FloatArray] | None:
    """The six discs, (6, 3) in camera axes and (6, 2) in the picture, named by the distances between them; None where
    they are not all there."""
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
    """All distances (P, P) between points."""
    return np.asarray(np.linalg.norm(points[:, None] - points[None], axis=-1))


def _pairwise_distances(points: FloatArray) -> FloatArray:
    """The distances between points, each once."""
    return np.asarray(_distance_matrix(points)[np.triu_indices(len(points), 1)])
