"""The consistency test: measurements that contradict the estimate.

A marker that goes unused although a blob lies at its place, or innovations that stay outside their bounds, make a frame
doubtful: the stated standard deviations grow, and the screen says which marker it is.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from carpus.core.model.camera import Camera
from carpus.core.model.types import Detections, FloatArray

MAX_UNUSED_S = 0.3  # a marker may go unused for so long while a blob lies at its place,
# within so much across the line of sight and in depth: the most that skin and sensor stray by
GATE_M, GATE_DEPTH_M = 0.010, 0.015
NIS_AVERAGING_S = 0.3  # over which innovations are averaged
MAX_MEAN_NIS = 2.5  # for each degree of freedom
UNUSED_SD_FACTOR = 1.5  # on the standard deviations while a marker goes unused


@dataclass(frozen=True, slots=True)
class Inconsistency:
    """``doubted`` (M,) markers in question; ``sd_factor`` on the standard deviations, 1 without doubt."""

    doubted: NDArray[np.bool_]
    sd_factor: float

    @property
    def is_any(self) -> bool:
        return self.sd_factor > 1.0


class ConsistencyTest:
    """Averages the NIS, and counts for how long each marker has gone unused."""

    def __init__(self, markers: int) -> None:
        self._unused_s = np.zeros(markers)
        self._mean_nis = 1.0

    def reset(self) -> None:
        """Start again after the track was lost or initiated."""
        self._unused_s[:] = 0.0
        self._mean_nis = 1.0

    def update(
        self, dt_s: float, is_unused: NDArray[np.bool_], nis: float, dof: int, worst_marker: int
    ) -> Inconsistency:
        """Return the inconsistency after one more frame.

        Parameters
        ----------
        dt_s : float
            Time since the last frame.
        is_unused : (M,)
            Markers without a blob although one lies there.
        nis, dof : float, int
            Normalised innovation squared of all measurements and its degrees of freedom.
        worst_marker : int
            The marker that contributes most to the NIS.
        """
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
    """Find the markers (M,) without a blob although an unassigned one lies at their place.

    Parameters
    ----------
    disc_cam_m : (M, 3)
        Estimated positions in camera axes.
    assigned : (M,)
        Blob of every marker or -1.
    blobs : Detections
        All blobs, undistorted.
    camera : Camera
        The colour camera.
    """
    out = np.zeros(assigned.size, dtype=bool)
    is_assigned = assigned >= 0
    used = assigned[is_assigned]
    if used.size in (assigned.size, len(blobs)):
        return out
    without_blob, unassigned = np.flatnonzero(~is_assigned), np.delete(np.arange(len(blobs)), used)
    offset_px = blobs.pixel[unassigned] - camera.project(disc_cam_m[without_blob])[:, None]
    depth_m, blob_depth_m = disc_cam_m[without_blob, 2, None], blobs.depth_m[unassigned]
    is_near = np.hypot(offset_px[..., 0], offset_px[..., 1]) < GATE_M * camera.fx_px / depth_m
    is_at_depth = np.abs(blob_depth_m - depth_m) < GATE_DEPTH_M
    out[without_blob] = (is_near & (is_at_depth | ~np.isfinite(blob_depth_m))).any(axis=1)
    return out
