"""Flexion of a finger at MCP, by depth, where the disc that would show it is hidden.

A fist seen from above hides the discs past the knuckles, and what is left is a surface: where the finger is not, the
camera sees past it (free space). Each angle of a grid is weighed by how the readings lie to the back of the proximal
phalanx it would have. Neighbouring frames err alike, so that one is given little weight.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from carpus.core.model.types import FINGER_SAMPLE_STEP_PX, FloatArray, SurfaceSamples
from carpus.core.tracking.filter.digit_filter import OBSERVED, DigitView
from carpus.core.tracking.filter.hand_geometry import FLEXION_SLOT, N_DIGITS, N_SLOTS
from carpus.core.tracking.filter.mixture_filter import Linearisation, ModeMixture, update_mixture

_LENGTH, _FAN, _START, _HEIGHT = N_SLOTS, N_SLOTS + 3, slice(N_SLOTS + 5, N_SLOTS + 8), N_SLOTS + 8
_DOWN = np.array([1.0, 1.0, -1.0])

SURFACE_SD_M, STEEP_SURFACE_SD_M = 0.005, 0.010  # Of a reading about the surface it lies on, and where that is steep:
MIN_FACING_SHARE = 0.5  # where less of it faces the camera
# A reading past the finger costs most, one before it may be another finger, and none says least.
MAX_COST_BEHIND, MAX_COST_IN_FRONT, NO_READING_COST = 6.0, 2.5, 1.2
MIN_SD_RAD, MAX_SD_RAD = 0.14, 0.45  # Of one frame; beyond the second it is not used.
CORRELATED_FRAMES = 8.0  # so many frames err as one
# shares of the proximal phalanx's length, at which its back is searched
SAMPLE_POSITIONS = np.array([0.35, 0.6, 0.85, 1.05])
# The angles (Q,) that are weighed: all that MCP can do, in steps far below what one frame tells.
FLEXION_GRID_RAD = np.radians(np.arange(-20.0, 112.5, 5.0))


@dataclass(frozen=True, slots=True)
class KnuckleFlexion:
    """Flexion ``value_rad`` (5,) at MCP with ``variance_rad2`` (5,), NaN where depth says nothing."""

    value_rad: FloatArray
    variance_rad2: FloatArray

    @staticmethod
    def none() -> KnuckleFlexion:
        """Return no measurement."""
        return KnuckleFlexion(np.full(N_DIGITS, np.nan), np.ones(N_DIGITS))

    @property
    def is_any(self) -> bool:
        return bool(np.isfinite(self.value_rad).any())


def estimate_knuckle_flexion(
    chains: list[int],
    mean: FloatArray,
    root_m: FloatArray,
    view: DigitView,
    samples: SurfaceSamples,
) -> KnuckleFlexion:
    """Estimate the flexion at MCP of the fingers ``chains`` from depth readings.

    Parameters
    ----------
    chains : list of int
        Fingers.
    mean : (5, n)
        States of the digits.
    root_m : (5, 3)
        Discs under which they begin.
    view : DigitView
        From W2 to the camera.
    samples : SurfaceSamples
        Depth readings about the fingers.
    """
    state = mean[chains][:, OBSERVED]
    azimuth = (state[:, _FAN] + state[:, 0])[:, None]
    sin, cos = np.sin(FLEXION_GRID_RAD), np.cos(FLEXION_GRID_RAD)
    along, normal = np.empty((2, len(chains), FLEXION_GRID_RAD.size, 3))
    along[..., 0], along[..., 1], along[..., 2] = cos * np.cos(azimuth), cos * np.sin(azimuth), -sin
    normal[..., 0], normal[..., 1], normal[..., 2] = sin * np.cos(azimuth), sin * np.sin(azimuth), cos
    knuckle = root_m[chains] + state[:, _START] * _DOWN
    back = knuckle[:, None] + state[:, _HEIGHT, None, None] * normal
    reach = SAMPLE_POSITIONS * state[:, _LENGTH, None]
    image = view.observe(back[:, :, None] + reach[:, None, :, None] * along[:, :, None])  # (A, Q, P, 3)
    behind_m = _read_depth_m(samples, image[..., :2]) - image[..., 2]
    stray_m = np.where(-(normal @ view.rotation[2]) > MIN_FACING_SHARE, SURFACE_SD_M, STEEP_SURFACE_SD_M)
    cost = np.minimum(
        0.5 * (behind_m / stray_m[..., None]) ** 2, np.where(behind_m > 0.0, MAX_COST_BEHIND, MAX_COST_IN_FRONT)
    )
    total = np.where(np.isfinite(behind_m), cost, NO_READING_COST).sum(axis=-1)
    weight = np.exp(total.min(axis=-1, keepdims=True) - total)
    weight /= weight.sum(axis=-1, keepdims=True)
    value = weight @ FLEXION_GRID_RAD
    variance = (weight * (FLEXION_GRID_RAD - value[:, None]) ** 2).sum(axis=-1)
    is_measured = variance < MAX_SD_RAD**2
    chains, out = np.array(chains)[is_measured], KnuckleFlexion.none()
    out.value_rad[chains] = value[is_measured]
    out.variance_rad2[chains] = CORRELATED_FRAMES * np.maximum(variance[is_measured], MIN_SD_RAD**2)
    return out


def update_by_knuckle_flexion(mixture: ModeMixture, flexion: KnuckleFlexion) -> ModeMixture:
    """Update the digits by the flexion that depth shows."""
    chains, _, size = mixture.mean.shape
    slope = np.zeros((chains, 1, size))
    slope[:, 0, FLEXION_SLOT] = 1.0
    nothing = np.zeros((chains, 1, 1))
    linearised = Linearisation(np.zeros((chains, 1)), slope, nothing, np.zeros((chains, size)))
    return update_mixture(mixture, linearised, flexion.value_rad[:, None], flexion.variance_rad2[:, None]).mixture


def _read_depth_m(samples: SurfaceSamples, pixel: FloatArray) -> FloatArray:
    """Read the depth nearest to pixels (..., 2), NaN where there is none within a step."""
    cell = np.rint(samples.pixel / FINGER_SAMPLE_STEP_PX).astype(np.int64)
    low = cell.min(axis=0) - 1
    columns, rows = cell.max(axis=0) - low + 2
    grid = np.full((rows, columns), np.nan)
    grid[cell[:, 1] - low[1], cell[:, 0] - low[0]] = samples.depth_m
    at = np.rint(pixel / FINGER_SAMPLE_STEP_PX).astype(np.int64) - low
    column, row = np.clip(at[..., 0], 0, columns - 1), np.clip(at[..., 1], 0, rows - 1)
    return np.asarray(grid[row, column])
