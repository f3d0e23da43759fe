"""How far a finger is bent at its knuckle, by depth, where the disc that would show it is hidden.

A fist seen from above hides the discs past the knuckles, and what is left is a surface: where the finger is not, the
camera sees past it (free space). Each angle of a grid is weighed by how the readings lie to the back of the proximal
phalanx it would have. Neighbouring frames err alike, so that what one says is taken for little.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

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


@dataclass(frozen=True, slots=True)
class FingerDepthSettings:
    """``near_m``: how far a reading strays from the surface it lies on, ``steep_m`` where that is steep; a reading past
    the finger costs up to ``most_past``, one before it, which may be another finger, up to ``most_before``, none
    ``nothing``. ``least_sd_rad`` of what one picture says, ``most_sd_rad`` beyond which it is not asked; ``alike``
    frames err as one. The back of the proximal phalanx is looked for at ``along``, shares of its length, for bends
    from ``straightest_deg`` to ``most_bent_deg`` in steps of ``step_deg``; it is steep where less than
    ``facing_share`` of it faces the camera."""

    near_m: float = 0.005
    steep_m: float = 0.010
    most_past: float = 6.0
    most_before: float = 2.5
    nothing: float = 1.2
    least_sd_rad: float = 0.14
    most_sd_rad: float = 0.45
    alike: float = 8.0
    along: tuple[float, ...] = (0.35, 0.6, 0.85, 1.05)
    straightest_deg: float = -20.0
    most_bent_deg: float = 110.0
    step_deg: float = 5.0
    facing_share: float = 0.5


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
    settings: FingerDepthSettings,
) -> KnuckleBends:
    """What the readings say of the digits ``asked`` (fingers), means (5, n), that begin under ``root_m`` (5, 3)."""
    out = KnuckleBends.none()
    bend_rad, share = _grid_rad(settings), np.array(settings.along)
    if (kernels := in_c()) is not None:
        camera = view.camera
        kernels.knuckles_bent(
            len(asked), np.array(asked), mean, root_m, view.rotation, view.translation_m, camera.fx_px, camera.fy_px,
            camera.cx_px, camera.cy_px, len(samples.depth_m), samples.pixel, samples.depth_m, FINGER_STEP_PX,
            bend_rad.size, bend_rad, share.size, share, settings.near_m, settings.steep_m, settings.facing_share,
            settings.most_past, settings.most_before, settings.nothing, settings.most_sd_rad, settings.least_sd_rad,
            settings.alike, out.value_rad, out.variance_rad2,
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
        near_m = np.where(facing > settings.facing_share, settings.near_m, settings.steep_m)[:, None]
        cost = 0.5 * (past_m / near_m) ** 2
        cost = np.where(past_m > 0.0, np.minimum(cost, settings.most_past), np.minimum(cost, settings.most_before))
        total = np.where(np.isfinite(past_m), cost, settings.nothing).sum(axis=1)
        weight = np.exp(total.min() - total)
        weight /= weight.sum()
        value = float(weight @ bend_rad)
        variance = float(weight @ (bend_rad - value) ** 2)
        if variance < settings.most_sd_rad**2:
            out.value_rad[chain] = value
            out.variance_rad2[chain] = settings.alike * max(variance, settings.least_sd_rad**2)
    return out


@lru_cache(maxsize=2)
def _grid_rad(settings: FingerDepthSettings) -> FloatArray:
    """The bends (Q,) that are weighed."""
    end_deg = settings.most_bent_deg + 0.5 * settings.step_deg
    return np.asarray(np.radians(np.arange(settings.straightest_deg, end_deg, settings.step_deg)))


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
