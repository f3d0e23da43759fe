"""A visible blue spot that belongs to no marker while a marker near it is hidden or doubtful."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from carpus.core.model.camera import Camera
from carpus.core.model.fault_text import marker_name
from carpus.core.model.types import FloatArray, TrackedFrame, TrackStatus
from carpus.ui.kit.translate import tr, translate_phrase
from carpus.ui.screens.live.status_light import StatusLight

MAX_DISTANCE_M = 0.03
"""A spot may be a marker if it is this near to the marker's expected place."""
_SAME_BLOB_PX = 1.5


@dataclass(frozen=True, slots=True)
class MarkerDoubt:
    """A hidden or doubtful marker, and whether another spot may be it."""

    marker: str
    is_hidden: bool
    has_other: bool


def find_doubt(frame: TrackedFrame | None, markers: Sequence[str], camera: Camera) -> MarkerDoubt | None:
    """Return the doubt of a frame: of a doubtful marker, else of a hidden one near an unused spot."""
    if frame is None or frame.status == TrackStatus.LOST or len(frame.marker_measured_px) != len(markers):
        return None
    measured, place = frame.marker_measured_px, frame.marker_predicted_px
    hidden = ~np.isfinite(measured[:, 0])
    unused = _find_unused_blobs(frame)
    for rows in (np.flatnonzero(frame.doubted), np.flatnonzero(hidden)):
        nearest: list[tuple[float, int]] = []
        for k in rows:
            at = measured[k] if np.isfinite(measured[k]).all() else place[k]
            if not np.isfinite(at).all() or not len(unused):
                continue
            distance = np.linalg.norm(unused - at, axis=1)
            reach_px = MAX_DISTANCE_M * camera.fx_px / max(float(frame.marker_position_cam_m[k, 2]), 0.2)
            if distance.min() <= reach_px:
                nearest.append((float(distance.min()), int(k)))
        if nearest:
            row = min(nearest)[1]
            return MarkerDoubt(markers[row], bool(hidden[row]), has_other=True)
    if frame.doubted.any():
        first = int(np.flatnonzero(frame.doubted)[0])
        return MarkerDoubt(markers[first], bool(hidden[first]), has_other=False)
    return None


def make_doubt_light(doubt: MarkerDoubt | None) -> StatusLight:
    """Return the tracking light of a doubt; a good one without words for none."""
    if doubt is None:
        return StatusLight("good", "", "")
    name = marker_name(doubt.marker, translate_phrase)
    if not doubt.has_other:
        return StatusLight("warn", tr("Uncertain"), tr("Check the {marker}").format(marker=name))
    if doubt.is_hidden:
        return StatusLight("warn", tr("Another blue spot is here"), tr("Is it the {marker}?").format(marker=name))
    return StatusLight("warn", tr("Uncertain"), tr("Which blue spot is the {marker}?").format(marker=name))


def _find_unused_blobs(frame: TrackedFrame) -> FloatArray:
    """Return spots (S, 2) assigned to no marker and not rejected by a person."""
    seen = frame.detections.pixel[~frame.is_rejected]
    taken = frame.marker_measured_px[np.isfinite(frame.marker_measured_px[:, 0])]
    if not len(seen) or not len(taken):
        return seen
    free = np.linalg.norm(seen[:, None] - taken[None], axis=-1).min(axis=1) > _SAME_BLOB_PX
    return np.asarray(seen[free])
