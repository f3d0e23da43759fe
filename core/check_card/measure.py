"""The six discs of the card in pictures, and what a check of some seconds says."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable

import numpy as np

from carpus.core.calibration.candidates import marker_candidates
from carpus.core.camera import Camera
from carpus.core.check_card.card import disc_places_m, figures_of
from carpus.core.check_card.reading import CardReading
from carpus.core.detection.settings import DetectionSettings
from carpus.core.errors import CardMissing
from carpus.core.types import Detections, FloatArray, Frame

CHECK_S = 30.0
LOOK_EVERY_S = 0.25
"""Pictures in a row have the same pattern in their depth: more of them say little more."""
FEWEST_PICTURES = 5
_MOST_BLOBS = 8
_MOST_MISFIT_M = 0.015
"""Root mean square over all distances between discs: more is not the card."""


def measure_card(
    frames: Iterable[Frame], camera: Camera, subject: str, settings: DetectionSettings | None = None
) -> CardReading:
    """Measure the card over the first 30 s of frames.

    Raises :class:`CardMissing` where its six discs are seen in fewer than five pictures.
    """
    chosen = settings or DetectionSettings()
    places: list[FloatArray] = []
    looked, first_s, last_s = 0, math.nan, -math.inf
    for frame in frames:
        first_s = frame.timestamp_s if math.isnan(first_s) else first_s
        if frame.timestamp_s - first_s > CHECK_S:
            break
        if frame.depth_raw is None or frame.timestamp_s - last_s < LOOK_EVERY_S:
            continue
        last_s = frame.timestamp_s
        looked += 1
        found = card_discs(marker_candidates(frame, camera, chosen), camera)
        if found is not None:
            places.append(found)
    if len(places) < FEWEST_PICTURES:
        raise CardMissing(subject, f"all six discs in {len(places)} of {looked} pictures")
    each = np.array([figures_of(one) for one in places])
    middle = np.median(np.array(places), axis=0)
    ratio = _distances(middle) @ _distances(disc_places_m()) / np.sum(_distances(disc_places_m()) ** 2)
    distance_m = float(np.linalg.norm(middle.mean(axis=0)))
    return CardReading(figures_of(middle), each.std(axis=0, ddof=1), float(ratio), distance_m, len(places), looked)


def card_discs(found: Detections, camera: Camera) -> FloatArray | None:
    """The six discs (6, 3) in camera axes, named by the distances between them; None where they are not all there."""
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
    return None if misfit[k] > _MOST_MISFIT_M else np.asarray(points[orders[k]])


def _table(points: FloatArray) -> FloatArray:
    """All distances (P, P) between points."""
    return np.asarray(np.linalg.norm(points[:, None] - points[None], axis=-1))


def _distances(points: FloatArray) -> FloatArray:
    """The distances between points, each once."""
    return np.asarray(_table(points)[np.triu_indices(len(points), 1)])
