"""The six discs of the card in pictures, and what a check of some seconds says."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from carpus.core.calibration.candidates import marker_candidates
from carpus.core.calibration.card.card import (
    CHECK_S,
    FIGURES,
    MOST_ANGLE_DEG,
    MOST_LENGTH_MM,
    CardReading,
    disc_places_m,
    figures_of,
)
from carpus.core.camera import Camera
from carpus.core.detection.settings import DetectionSettings
from carpus.core.errors import CardMissing
from carpus.core.phrase import phrase
from carpus.core.types import Detections, FloatArray, Frame

# How far off the card's figures may be: the fixed limits, or what the sensor states of itself where that is more.
#
# What stays of a sensor's error as long as the card lies (its bumps, its pattern) no number of pictures takes away: of
# a camera with wide bumps a right one is several degrees off on a face as small as the wedge's. Of a sensor whose
# neighbours share the step to which depth is rounded, a part of that step stays too, since nothing moves.
LIMIT_SD = 3.0
"""A right camera is beyond this many standard deviations in one figure of 370."""
_ROUNDED_SHARE = 0.4
"""Of one reading's standard deviation: what rounding leaves of a disc that lies still (simulated, 120 pictures)."""
_STEP_M = 1e-5


def figures_sd(places_m: FloatArray, camera: Camera) -> FloatArray:
    """Standard deviation (6,) of the card's figures, degrees and millimetres, from what stays of the depth error of the
    discs at (6, 3) in camera axes."""
    depth_m = places_m[:, 2]
    rounded_m = 0.0 if camera.sensor.averages else _ROUNDED_SHARE * camera.sensor.reading_sd_m(depth_m)
    sd_m = np.hypot(camera.sensor.flat_stays_sd_m(depth_m), rounded_m)
    covariance = np.outer(sd_m, sd_m) * _alike(places_m, camera)
    rays = places_m / depth_m[:, None]
    right = figures_of(places_m)
    slope = np.empty((len(FIGURES), len(places_m)))
    for k, ray in enumerate(rays):
        moved = places_m.copy()
        moved[k] += _STEP_M * ray
        slope[:, k] = (figures_of(moved) - right) / _STEP_M
    return np.asarray(np.sqrt(np.einsum("ij,jk,ik->i", slope, covariance, slope)))


def limits_for(places_m: FloatArray, camera: Camera) -> tuple[float, float]:
    """Largest error of an angle (degrees) and of a length (millimetres) that a right camera may show."""
    sd = LIMIT_SD * figures_sd(places_m, camera)
    angles = max(sd[k] for k, figure in enumerate(FIGURES) if figure.kind == "angle")
    lengths = max(sd[k] for k, figure in enumerate(FIGURES) if figure.kind == "length")
    return max(MOST_ANGLE_DEG, float(angles)), max(MOST_LENGTH_MM, float(lengths))


def _alike(places_m: FloatArray, camera: Camera) -> FloatArray:
    """How far the error that stays is the same at two discs (6, 6): wholly at one place, not at all where they are
    further apart than the sensor says."""
    reach_px = camera.sensor.stays_px
    if reach_px <= 0.0:
        return np.eye(len(places_m))
    pixel = camera.project(places_m)
    apart_px = np.linalg.norm(pixel[:, None] - pixel[None], axis=-1)
    return np.asarray(np.exp(-2.0 * (apart_px / reach_px) ** 2))


LOOK_EVERY_S = 0.25
"""Pictures in a row have the same pattern in their depth: more of them say little more."""
FEWEST_PICTURES = 5
_MOST_BLOBS = 8
_MOST_MISFIT_M = 0.015
"""Root mean square over all distances between discs: more is not the card."""
_MOST_MOVED_M = 0.02
"""From one look to the next, of any disc: more is no noise."""
_LONGEST_GAP_S = 1.5
"""Time between two looks that counts: longer, and nobody knows what was in between."""


@dataclass(frozen=True, slots=True)
class CardLook:
    """What one picture shows: ``pixel`` of the discs A to F (6, 2), None where they are not all seen; ``blue`` discs of
    any kind; ``seconds`` of steady pictures so far and how many ``pictures`` count; ``moved``: it lies elsewhere than
    before, and all begins again."""

    pixel: FloatArray | None
    blue: int
    seconds: float
    pictures: int
    moved: bool = False


class CardWatch:
    """Looks at the card in one frame after the other. With ``steady`` only time counts in which the card is seen and
    lies still, as before a live camera; else the first 30 s, as of a recording."""

    def __init__(self, camera: Camera, settings: DetectionSettings | None = None, *, steady: bool = False) -> None:
        self._camera, self._settings, self._steady = camera, settings or DetectionSettings(), steady
        self._places: list[FloatArray] = []
        self._looked, self._first_s, self._last_s, self._seen_s = 0, math.nan, -math.inf, 0.0

    @property
    def done(self) -> bool:
        return self._seen_s >= CHECK_S

    def look(self, frame: Frame) -> CardLook | None:
        """Look at a frame; None where it has no depth or comes too soon after the last one."""
        now_s = frame.timestamp_s
        self._first_s = now_s if math.isnan(self._first_s) else self._first_s
        if frame.depth_raw is None or now_s - self._last_s < LOOK_EVERY_S:
            return None
        since_s, self._last_s = now_s - self._last_s, now_s
        blobs = marker_candidates(frame, self._camera, self._settings)
        self._looked += 1
        found = card_blobs(blobs, self._camera)
        moved = False
        if found is not None:
            if self._steady and self._places and np.abs(found[0] - self._places[-1]).max() > _MOST_MOVED_M:
                moved, self._places, self._looked, self._seen_s = True, [], 1, 0.0
            elif self._places and since_s < _LONGEST_GAP_S:
                self._seen_s += since_s
            self._places.append(found[0])
        if not self._steady:
            self._seen_s = now_s - self._first_s
        return CardLook(None if found is None else found[1], len(blobs), self._seen_s, len(self._places), moved)

    def reading(self, subject: str) -> CardReading:
        """What was measured. Raises :class:`CardMissing` where the six discs were seen in fewer than five pictures."""
        if len(self._places) < FEWEST_PICTURES:
            raise CardMissing(
                subject,
                phrase("all six discs in {count} of {looked} pictures", count=len(self._places), looked=self._looked),
            )
        each = np.array([figures_of(one) for one in self._places])
        middle = np.median(np.array(self._places), axis=0)
        ratio = _distances(middle) @ _distances(disc_places_m()) / np.sum(_distances(disc_places_m()) ** 2)
        distance_m = float(np.linalg.norm(middle.mean(axis=0)))
        sd = each.std(axis=0, ddof=1)
        return CardReading(
            figures_of(middle), sd, float(ratio), distance_m, len(self._places), self._looked,
            *limits_for(middle, self._camera),
        )  # fmt: skip


def measure_card(
    frames: Iterable[Frame], camera: Camera, subject: str, settings: DetectionSettings | None = None
) -> CardReading:
    """Measure the card over the first 30 s of frames.

    Raises :class:`CardMissing` where its six discs are seen in fewer than five pictures.
    """
    watch = CardWatch(camera, settings)
    first_s = math.nan
    for frame in frames:
        first_s = frame.timestamp_s if math.isnan(first_s) else first_s
        if frame.timestamp_s - first_s > CHECK_S:
            break
        watch.look(frame)
    return watch.reading(subject)


def card_blobs(found: Detections, camera: Camera) -> tuple[FloatArray, FloatArray] | None:
    """The six discs, (6, 3) in camera axes and (6, 2) in the picture, named by the distances between them; None where
    they are not all there."""
    usable = np.flatnonzero(np.isfinite(found.depth_m))
    if len(usable) < 6:
        return None
    best = usable[np.argsort(-found.similarity[usable])][:_MOST_BLOBS]
    points = camera.back_project(camera.undistort(found.pixel[best]), found.depth_m[best])
    true = _table(disc_places_m())
    measured = _table(points)
    orders = np.array(list(itertools.permutations(range(len(best)), 6)))
    off = measured[orders[:, :, None], orders[:, None, :]] - true
    misfit = np.sqrt(np.mean(off**2, axis=(1, 2)))
    k = int(np.argmin(misfit))
    if misfit[k] > _MOST_MISFIT_M:
        return None
    return np.asarray(points[orders[k]]), np.asarray(found.pixel[best][orders[k]])


def _table(points: FloatArray) -> FloatArray:
    """All distances (P, P) between points."""
    return np.asarray(np.linalg.norm(points[:, None] - points[None], axis=-1))


def _distances(points: FloatArray) -> FloatArray:
    """The distances between points, each once."""
    return np.asarray(_table(points)[np.triu_indices(len(points), 1)])
