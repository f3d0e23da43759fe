"""The consistency test: when what is seen contradicts what is stated. No disc in plain sight is dropped in silence.

A disc that goes unused although a blob lies at its place, or innovations that stay outside their bounds, make a frame
doubtful: the stated standard deviations grow, and the screen says which disc it is.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from carpus.core.model.camera import Camera
from carpus.core.model.types import Detections, FloatArray

MAX_UNUSED_S = 0.3
"""For so long a disc may go unused while a blob lies at its place,"""
GATE_M, GATE_DEPTH_M = 0.010, 0.015
"""within so much across the line of sight and in depth: what skin and sensor stray by at most."""
NIS_AVERAGING_S = 0.3
"""Over which innovations are averaged,"""
MAX_MEAN_NIS = 2.5
"""and how large they may be on average for each component."""
UNUSED_SD_FACTOR = 1.5
"""The standard deviations, by this factor."""


@dataclass(frozen=True, slots=True)
class Inconsistency:
    """``doubted`` (M,) markers in question; ``sd_factor`` factor on the standard deviations, 1 without doubt."""

    doubted: NDArray[np.bool_]
    sd_factor: float

    @property
    def is_any(self) -> bool:
        return self.sd_factor > 1.0


class ConsistencyTest:
    """Remembers for how long each disc has gone unused, and how large the innovations have been lately."""

    def __init__(self, markers: int) -> None:
        self._unused_s = np.zeros(markers)
        self._mean_nis = 1.0

    def reset(self) -> None:
        """The hand is lost, or begins anew: nothing is contradicted."""
        self._unused_s[:] = 0.0
        self._mean_nis = 1.0

    def update(
        self, dt_s: float, is_unused: NDArray[np.bool_], nis: float, dof: int, worst_marker: int
    ) -> Inconsistency:
        """The doubt after one more frame. ``is_unused`` (M,) discs passed over while a blob lies there, ``nis`` with
        ``dof`` of all that was measured, ``worst_marker`` the marker that contributes most."""
        self._unused_s = np.where(is_unused, self._unused_s + dt_s, 0.0)
        if dof and math.isfinite(nis):
            weight = 1.0 - math.exp(-dt_s / NIS_AVERAGING_S)
            self._mean_nis += weight * (nis / dof - self._mean_nis)
        doubted = self._unused_s > MAX_UNUSED_S
        widens = UNUSED_SD_FACTOR if doubted.any() else 1.0
        if self._mean_nis > MAX_MEAN_NIS:
            widens = max(widens, math.sqrt(self._mean_nis))
            doubted = doubted.copy()
            doubted[worst_marker] = True
        return Inconsistency(doubted, widens)


def find_unused_markers(
    disc_cam_m: FloatArray,
    assigned: NDArray[np.int64],
    blobs: Detections,
    camera: Camera,
) -> NDArray[np.bool_]:
    """Markers (M,) without a blob although one that is nobody's lies at their place ``disc_cam_m`` (M, 3).

    ``assigned`` (M,) of all ``blobs``, as a camera without distortion would see them, that of every marker or -1.
    """
    out = np.zeros(assigned.size, dtype=bool)
    is_named = assigned >= 0
    named = assigned[is_named]
    if named.size in (assigned.size, len(blobs)):
        return out
    missing, unassigned = np.flatnonzero(~is_named), np.delete(np.arange(len(blobs)), named)
    apart_px = blobs.pixel[unassigned] - camera.project(disc_cam_m[missing])[:, None]
    depth_m, blob_depth_m = disc_cam_m[missing, 2, None], blobs.depth_m[unassigned]
    near = np.hypot(apart_px[..., 0], apart_px[..., 1]) < GATE_M * camera.fx_px / depth_m
    deep = np.abs(blob_depth_m - depth_m) < GATE_DEPTH_M
    out[missing] = (near & (deep | ~np.isfinite(blob_depth_m))).any(axis=1)
    return out
