"""A visible blue spot that belongs to no marker while a marker near it is hidden or doubtful."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from carpus.core.model.camera import Camera
from carpus.core.model.fault_text import marker_name
from carpus.core.model.types import FloatArray, MarkerLabel, TrackedFrame, TrackStatus
from carpus.ui.kit.translate import tr, translate_phrase
from carpus.ui.screens.live.status_light import AMBER_AFTER_S, StatusLight

MAX_DISTANCE_M = 0.03
"""A spot may be a marker if it is this near to the marker's expected place."""
_SAME_BLOB_PX = 1.5

Choice = Literal["disc", "spot", "none"]


@dataclass(frozen=True, slots=True)
class MarkerDoubt:
    """A doubtful marker in frame ``frame_index``.

    Attributes
    ----------
    assigned_px : ndarray (2,)
        Spot assigned to the marker, NaN while it is hidden.
    other_px : ndarray (2,)
        Spot that may be the marker, NaN if only the marker itself is doubtful.
    """

    marker: str
    assigned_px: FloatArray
    other_px: FloatArray
    frame_index: int = -1

    @property
    def has_other(self) -> bool:
        return bool(np.isfinite(self.other_px).all())

    @property
    def is_hidden(self) -> bool:
        return not np.isfinite(self.assigned_px).all()

    def answer(self, choice: Choice) -> MarkerLabel:
        """Return the label that follows from a person's choice."""
        disc = () if self.is_hidden else (_to_pair(self.assigned_px),)
        spot = _to_pair(self.other_px)
        if choice == "spot":
            return MarkerLabel(self.frame_index, self.marker, spot, disc)
        return MarkerLabel(self.frame_index, self.marker, None, (spot,) if choice == "disc" else (*disc, spot))


def _to_pair(pixel: FloatArray) -> tuple[float, float]:
    return float(pixel[0]), float(pixel[1])


def find_doubt(frame: TrackedFrame | None, markers: Sequence[str], camera: Camera) -> MarkerDoubt | None:
    """Return the doubt of a frame: of a doubtful marker, else of a hidden one near an unused spot."""
    if frame is None or frame.status == TrackStatus.LOST or len(frame.marker_measured_px) != len(markers):
        return None
    measured, place = frame.marker_measured_px, frame.marker_predicted_px
    hidden = ~np.isfinite(measured[:, 0])
    unused = _find_unused_blobs(frame)
    for rows in (np.flatnonzero(frame.doubted), np.flatnonzero(hidden)):
        nearest: list[tuple[float, int, FloatArray]] = []
        for k in rows:
            at = measured[k] if np.isfinite(measured[k]).all() else place[k]
            if not np.isfinite(at).all() or not len(unused):
                continue
            distance = np.linalg.norm(unused - at, axis=1)
            reach_px = MAX_DISTANCE_M * camera.fx_px / max(float(frame.marker_position_cam_m[k, 2]), 0.2)
            if distance.min() <= reach_px:
                nearest.append((float(distance.min()), int(k), unused[int(distance.argmin())]))
        if nearest:
            _, row, spot = min(nearest, key=lambda one: one[0])
            return MarkerDoubt(markers[row], measured[row], spot, frame.index)
    if frame.doubted.any():
        first = int(np.flatnonzero(frame.doubted)[0])
        return MarkerDoubt(markers[first], measured[first], np.full(2, np.nan), frame.index)
    return None


class SteadyDoubt:
    """Shows or hides a question only after 0.3 s, so that it does not flicker."""

    def __init__(self) -> None:
        self._shown: MarkerDoubt | None = None
        self._wanted = ""
        self._since_s = math.nan

    def update(self, doubt: MarkerDoubt | None, now_s: float) -> MarkerDoubt | None:
        """Return the question to show at ``now_s``, given that of the newest frame."""
        wanted = doubt.marker if doubt is not None else ""
        if wanted == (self._shown.marker if self._shown is not None else ""):
            self._shown, self._since_s = doubt, math.nan
        elif wanted != self._wanted or math.isnan(self._since_s):
            self._since_s = now_s
        elif now_s - self._since_s >= AMBER_AFTER_S - 1e-9:
            self._shown = doubt
        self._wanted = wanted
        return self._shown

    def clear(self) -> None:
        """Hide the question at once, after an answer."""
        self._shown, self._wanted, self._since_s = None, "", math.nan


def marker_in_sentence(marker: str) -> str:
    """Return the name of a marker within a sentence."""
    return marker_name(marker, translate_phrase)


def question_light(doubt: MarkerDoubt) -> StatusLight:
    """Return the tracking light while a question is open."""
    lower = marker_in_sentence(doubt.marker)
    if not doubt.has_other:
        words = tr("Check the {marker}").format(marker=lower)
        return StatusLight("warn", tr("Uncertain"), words)
    if doubt.is_hidden:
        return StatusLight("warn", tr("Another blue spot is here"), tr("Is it the {marker}?").format(marker=lower))
    return StatusLight("warn", tr("Uncertain"), tr("Which blue spot is the {marker}?").format(marker=lower))


def _find_unused_blobs(frame: TrackedFrame) -> FloatArray:
    """Return spots (S, 2) assigned to no marker and not rejected by a person."""
    seen = frame.detections.pixel[~frame.is_rejected]
    taken = frame.marker_measured_px[np.isfinite(frame.marker_measured_px[:, 0])]
    if not len(seen) or not len(taken):
        return seen
    free = np.linalg.norm(seen[:, None] - taken[None], axis=-1).min(axis=1) > _SAME_BLOB_PX
    return np.asarray(seen[free])
