"""How far a finger is bent at its knuckle, by depth, where the disc that would show it is hidden.

A fist seen from above hides the discs past the knuckles, and what is left is a surface: where the finger is not, the
camera sees past it (free space). Each angle of a grid is weighed by how the readings lie to the back of the proximal
phalanx it would have. Neighbouring frames err alike, so that what one says is taken for little.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from carpus.core.kernels.choice import in_c
from carpus.core.tracking.digit_filter import SEEN, DigitView
from carpus.core.tracking.hand_geometry import CHAINS, SLOTS
from carpus.core.tracking.kernel import Linearisation, ModeMixture, corrected
from carpus.core.types import FINGER_STEP_PX, FloatArray, SurfaceSamples

FLEXION = 1
"""The slot of a finger's flexion at the knuckle."""
_LENGTH, _FAN, _START, _HEIGHT = SLOTS, SLOTS + 3, slice(SLOTS + 5, SLOTS + 8), SLOTS + 8
_DOWN = np.array([1.0, 1.0, -1.0])


NEAR_M, STEEP_M = 0.005, 0.010
"""So far a reading strays from the surface it lies on, and where that is steep:"""
FACING_SHARE = 0.5
"""where less of it faces the camera."""
MAX_PAST, MAX_BEFORE, NOTHING = 6.0, 2.5, 1.2
"""A reading past the finger costs most, one before it may be another finger, and none says least."""
MIN_SD_RAD, MAX_SD_RAD = 0.14, 0.45
"""Of what one picture says; beyond the second it is not asked."""
ALIKE = 8.0
"""So many frames err as one."""
ALONG = (0.35, 0.6, 0.85, 1.05)
"""Shares of the proximal phalanx's length, at which its back is looked for."""
BENDS_RAD = np.radians(np.arange(-20.0, 112.5, 5.0))
"""The bends (Q,) that are weighed: all that a knuckle can do, in steps far below what one picture tells."""


@dataclass(frozen=True, slots=True)
class KnuckleBends:
    """Flexion ``value_rad`` (5,) at the knuckles with ``variance_rad2`` (5,), NaN where depth says nothing."""

    value_rad: FloatArray
    variance_rad2: FloatArray

    @staticmethod
    def none() -> KnuckleBends:
        """Depth says nothing of any."""
        return KnuckleBends(np.full(CHAINS, np.nan), np.ones(CHAINS))

    @property
    def is_any(self) -> bool:
        return bool(np.isfinite(self.value_rad).any())


def knuckle_bends(
    asked: list[int],
    mean: FloatArray,
    root_m: FloatArray,
    view: DigitView,
    samples: SurfaceSamples,
) -> KnuckleBends:
    """What the readings say of the digits ``asked`` (fingers), means (5, n), that begin under ``root_m`` (5, 3)."""
    out = KnuckleBends.none()
    bend_rad, share = BENDS_RAD, np.array(ALONG)
    if (kernels := in_c()) is not None:
        camera = view.camera
        kernels.knuckles_bent(
            len(asked), np.array(asked), mean, root_m, view.rotation, view.translation_m, camera.fx_px, camera.fy_px,
            camera.cx_px, camera.cy_px, len(samples.depth_m), samples.pixel, samples.depth_m, FINGER_STEP_PX,
            bend_rad.size, bend_rad, share.size, share, NEAR_M, STEEP_M, FACING_SHARE,
            MAX_PAST, MAX_BEFORE, NOTHING, MAX_SD_RAD, MIN_SD_RAD,
            ALIKE, out.value_rad, out.variance_rad2,
        )  # fmt: skip
        return out
    depth_at = _lattice(samples)
    sin, cos = np.sin(bend_rad), np.cos(bend_rad)
    for chain in asked:
        state = mean[chain, SEEN]
        azimuth = state[_FAN] + state[0]
        ahead = np.array([np.cos(azimuth), np.sin(azimuth), 0.0])
        up = np.array([0.0, 0.0, 1.0])
        knuckle = root_m[chain] + state[_START] * _DOWN
        along = cos[:, None] * ahead - sin[:, None] * up  # (Q, 3)
        normal = sin[:, None] * ahead + cos[:, None] * up
        reach = share * state[_LENGTH]
        place = knuckle + reach[None, :, None] * along[:, None] + state[_HEIGHT] * normal[:, None]  # (Q, P, 3)
        seen = view.observe(place)
        past_m = depth_at(seen[..., :2]) - seen[..., 2]
        facing = -(normal @ view.rotation.T)[:, 2]
        near_m = np.where(facing > FACING_SHARE, NEAR_M, STEEP_M)[:, None]
        cost = 0.5 * (past_m / near_m) ** 2
        cost = np.where(past_m > 0.0, np.minimum(cost, MAX_PAST), np.minimum(cost, MAX_BEFORE))
        total = np.where(np.isfinite(past_m), cost, NOTHING).sum(axis=1)
        weight = np.exp(total.min() - total)
        weight /= weight.sum()
        value = float(weight @ bend_rad)
        variance = float(weight @ (bend_rad - value) ** 2)
        if variance < MAX_SD_RAD**2:
            out.value_rad[chain] = value
            out.variance_rad2[chain] = ALIKE * max(variance, MIN_SD_RAD**2)
    return out


def with_bends(mixture: ModeMixture, bends: KnuckleBends) -> ModeMixture:
    """Digits corrected by what depth says of their knuckles."""
    chains, _, size = mixture.mean.shape
    slope = np.zeros((chains, 1, size))
    slope[:, 0, FLEXION] = 1.0
    nothing = np.zeros((chains, 1, 1))
    linearised = Linearisation(np.zeros((chains, 1)), slope, nothing, np.zeros((chains, size)))
    return corrected(mixture, linearised, bends.value_rad[:, None], bends.variance_rad2[:, None]).mixture


def _lattice(samples: SurfaceSamples) -> Callable[[FloatArray], FloatArray]:
    """Depth of the nearest reading to pixels (..., 2), NaN where there is none within a step."""
    cell = np.rint(samples.pixel / FINGER_STEP_PX).astype(np.int64)
    low = cell.min(axis=0)
    size = cell.max(axis=0) - low + 1
    grid = np.full((size[1] + 2, size[0] + 2), np.nan)
    grid[cell[:, 1] - low[1] + 1, cell[:, 0] - low[0] + 1] = samples.depth_m

    def depth_at(pixel: FloatArray) -> FloatArray:
        at = np.rint(pixel / FINGER_STEP_PX).astype(np.int64) - low + 1
        column, row = np.clip(at[..., 0], 0, size[0] + 1), np.clip(at[..., 1], 0, size[1] + 1)
        return np.asarray(grid[row, column])

    return depth_at
