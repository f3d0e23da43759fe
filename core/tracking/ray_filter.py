"""The unscented filter of thumb and fingers: five small filters side by side, given the palm.

A finger tells next to nothing about the palm, so each ray is filtered for itself in the frame of the palm as
corrected a moment before (what the palm's own error adds to a joint's is added when it is read). Each ray's state
holds its joints, their rates and the constants of its anatomy, so the sharpening of the anatomy and what its
error does to the angles are part of the filter. Motion modes run per ray: one finger may move while others rest.
Arrays lead with the ray (5) and, in a belief, the mode (K).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from core.camera import Camera
from core.tracking.hand_geometry import CONSTANTS, DISCS, RAYS, SLOTS, ray_discs_m
from core.tracking.unscented import Spread, weights_for
from core.types import FloatArray

_FLOOR = 1e-14
_SEEN = {
    False: np.arange(SLOTS + CONSTANTS),
    True: np.concatenate((np.arange(SLOTS), np.arange(2 * SLOTS, 2 * SLOTS + CONSTANTS))),
}
_DIAGONAL = np.arange(SLOTS + CONSTANTS)


@dataclass(frozen=True, slots=True)
class RayLayout:
    """Where joints, their rates (constant-rate model only) and constants stand in a ray's state."""

    has_rates: bool

    @property
    def joints(self) -> slice:
        return slice(0, SLOTS)

    @property
    def rates(self) -> slice:
        return slice(SLOTS, 2 * SLOTS if self.has_rates else SLOTS)

    @property
    def constants(self) -> slice:
        return slice(self.rates.stop, self.rates.stop + CONSTANTS)

    @property
    def size(self) -> int:
        return int(self.constants.stop)

    @property
    def seen(self) -> NDArray[np.int64]:
        """States on which the discs depend: joints and constants."""
        return _SEEN[self.has_rates]


@dataclass(frozen=True, slots=True)
class RayBeliefs:
    """Gaussians: ``mean`` (5, K, n), ``covariance`` (5, K, n, n), mode ``probability`` (5, K)."""

    mean: FloatArray
    covariance: FloatArray
    probability: FloatArray

    def merged(self) -> tuple[FloatArray, FloatArray]:
        """Mean (5, n) and covariance (5, n, n) over the modes."""
        if self.probability.shape[1] == 1:
            return self.mean[:, 0], self.covariance[:, 0]
        share = self.probability[:, None]
        mean = (share @ self.mean)[:, 0]
        apart = self.mean - mean[:, None]
        n = mean.shape[-1]
        inner = (share @ self.covariance.reshape(RAYS, -1, n * n)).reshape(RAYS, n, n)
        return mean, inner + np.swapaxes(apart, 1, 2) @ (apart * self.probability[..., None])


def mixed(beliefs: RayBeliefs, switch: FloatArray) -> RayBeliefs:
    """Each mode's start from all modes (interacting multiple model); ``switch`` (K, K) from row to column."""
    if switch.shape[0] == 1:
        return beliefs
    joint = switch * beliefs.probability[:, :, None]
    predicted = joint.sum(axis=1)
    share = np.swapaxes(joint / predicted[:, None, :], 1, 2)  # (5, to, from)
    mean = share @ beliefs.mean
    apart = beliefs.mean[:, None, :, :] - mean[:, :, None, :]  # (5, to, from, n)
    n = mean.shape[-1]
    inner = (share @ beliefs.covariance.reshape(RAYS, -1, n * n)).reshape(*mean.shape, n)
    between = np.swapaxes(apart, -1, -2) @ (apart * share[..., None])
    return RayBeliefs(mean, inner + between, predicted)


@dataclass(frozen=True, slots=True)
class RayNoise:
    """What moves a ray between two frames, as variances per second (continuous densities).

    ``motion`` (K, 5, 5) by mode, ray and slot: of the acceleration (constant rate) or of the rate (random walk);
    ``constants`` (5, 11) slow drift of the anatomy, skin over bone.
    """

    motion: FloatArray
    constants: FloatArray


def predicted(
    beliefs: RayBeliefs,
    noise: RayNoise,
    dt_s: float,
    layout: RayLayout,
    fade: FloatArray,
    unseen_growth: FloatArray,
) -> RayBeliefs:
    """The beliefs ``dt_s`` later. ``fade`` (5, 5) share of each slot's rate that is kept, 1 while it is seen;
    ``unseen_growth`` (5, 5) variance that each angle gains for not being seen."""
    q, r, c = layout.joints, layout.rates, layout.constants
    mean, p = beliefs.mean.copy(), beliefs.covariance.copy()
    slot, constant = np.arange(SLOTS), np.arange(c.start, c.stop)
    motion = np.swapaxes(noise.motion, 0, 1)  # (5, K, 5)
    if layout.has_rates:
        mean[..., r] *= fade[:, None]
        p[..., r, :] *= fade[:, None, :, None]
        p[..., :, r] *= fade[:, None, None, :]
        mean[..., q] += dt_s * mean[..., r]
        p[..., q, :] += dt_s * p[..., r, :]
        p[..., :, q] += dt_s * p[..., :, r]
        p[..., slot, slot] += motion * (dt_s**3 / 3.0)
        p[..., slot, SLOTS + slot] += motion * (0.5 * dt_s**2)
        p[..., SLOTS + slot, slot] += motion * (0.5 * dt_s**2)
        p[..., SLOTS + slot, SLOTS + slot] += motion * dt_s
    else:
        p[..., slot, slot] += motion * dt_s
    p[..., slot, slot] += unseen_growth[:, None]
    p[..., constant, constant] += noise.constants[:, None] * dt_s
    return RayBeliefs(mean, p, beliefs.probability)


@dataclass(frozen=True, slots=True)
class RayPoints:
    """Sigma points of a Gaussian over the seen states and their discs in W.

    ``disc_m`` (5, S, 3, 3), the centre point first; ``root`` (5, 16, 16) lower Cholesky factor; ``mean`` (5, n) and
    ``covariance`` (5, n, n) of the state about which they stand.
    """

    disc_m: FloatArray
    root: FloatArray
    mean: FloatArray
    covariance: FloatArray


def spread_points(
    mean: FloatArray, covariance: FloatArray, root_disc_m: FloatArray, layout: RayLayout, spread: Spread
) -> RayPoints:
    """Sigma points of states (5, n) with covariances (5, n, n); ``root_disc_m`` (5, 3) discs under which rays begin."""
    seen = layout.seen
    weights = weights_for(seen.size, spread)
    p = covariance[:, seen[:, None], seen]
    p[:, _DIAGONAL, _DIAGONAL] += _FLOOR
    root: FloatArray = np.asarray(np.linalg.cholesky(p), dtype=np.float64)
    offset = np.zeros((RAYS, 2 * seen.size + 1, seen.size))
    columns = np.swapaxes(root, 1, 2) * weights.scale
    offset[:, 1 : seen.size + 1] = columns
    offset[:, seen.size + 1 :] = -columns
    offset += mean[:, None, seen]
    return RayPoints(ray_discs_m(root_disc_m, offset), root, mean, covariance)


@dataclass(frozen=True, slots=True)
class RayView:
    """From W2 of a right hand to the pictures: ``rotation`` (3, 3) and ``translation_m`` (3,) into camera axes."""

    rotation: FloatArray
    translation_m: FloatArray
    camera: Camera

    def observe(self, point_m: FloatArray) -> FloatArray:
        """Pixel u, v and depth z of points (..., 3) of W2."""
        out: FloatArray = point_m @ self.rotation.T
        out += self.translation_m
        camera, z = self.camera, out[..., 2]
        out[..., 0] *= camera.fx_px / z
        out[..., 0] += camera.cx_px
        out[..., 1] *= camera.fy_px / z
        out[..., 1] += camera.cy_px
        return out

    def slope(self, centre_m: FloatArray) -> FloatArray:
        """Derivative (..., 3, 3) of u, v, z by the place of points (..., 3) in camera axes."""
        x, y, z = np.moveaxis(centre_m, -1, 0)
        out = np.zeros((*centre_m.shape, 3))
        out[..., 0, 0] = self.camera.fx_px / z
        out[..., 1, 1] = self.camera.fy_px / z
        out[..., 0, 2] = -out[..., 0, 0] * x / z
        out[..., 1, 2] = -out[..., 1, 1] * y / z
        out[..., 2, 2] = 1.0
        return out


@dataclass(frozen=True, slots=True)
class RayForecast:
    """What the camera should see, linearised statistically: y = ``value`` + ``slope`` (x - ``about``) + error.

    ``value`` (5, 9) u, v, z of the three discs in turn; ``slope`` (5, 9, n); ``error`` (5, 9, 9) covariance of what
    the line misses; ``about`` (5, n); ``spread`` (5, 9, 9) covariance of the images, both parts together.
    """

    value: FloatArray
    slope: FloatArray
    error: FloatArray
    about: FloatArray
    spread: FloatArray


def forecast(points: RayPoints, view: RayView, layout: RayLayout, spread: Spread) -> RayForecast:
    """Statistical linear regression of the discs' images on the state."""
    seen = layout.seen
    count = seen.size
    weights = weights_for(count, spread)
    image = view.observe(points.disc_m).reshape(RAYS, 2 * count + 1, 3 * DISCS)
    value: FloatArray = weights.mean @ image
    plus, minus = image[:, 1 : count + 1], image[:, count + 1 :]
    half = (plus - minus) * (0.5 / weights.scale)  # (5, 16, 9): slope in the axes of the root
    # The even part of the spread is what no line can follow.
    bend = 0.5 * (plus + minus) - value[:, None]
    middle = image[:, :1] - value[:, None]
    error = 2.0 * weights.covariance[1] * (np.swapaxes(bend, 1, 2) @ bend)
    error += weights.covariance[0] * (np.swapaxes(middle, 1, 2) @ middle)
    slope = np.zeros((RAYS, 3 * DISCS, layout.size))
    slope[:, :, seen] = np.swapaxes(np.linalg.solve(np.swapaxes(points.root, 1, 2), half), 1, 2)
    return RayForecast(value, slope, error, points.mean, error + np.swapaxes(half, 1, 2) @ half)


@dataclass(frozen=True, slots=True)
class RayUpdate:
    """Corrected beliefs, ``nis`` (5,) with ``dof`` (5,) components, ``residual`` (5, 9) of each component in its own
    standard deviations (0 where nothing was measured)."""

    beliefs: RayBeliefs
    nis: FloatArray
    dof: NDArray[np.int64]
    residual: FloatArray


def corrected(
    beliefs: RayBeliefs, line: RayForecast, measured: FloatArray, variance: FloatArray, extra: FloatArray | None = None
) -> RayUpdate:
    """Kalman correction of every ray and mode by ``measured`` (5, 9), NaN where there is nothing, of ``variance``
    (5, 9); ``extra`` (5, 9, 9) covariance that all measurements of a ray share, such as the palm's."""
    used = np.isfinite(measured)
    unit = np.where(used, 1.0 / np.sqrt(np.where(used, variance, 1.0)), 0.0)
    slope = line.slope * unit[..., None]
    common = line.error if extra is None else line.error + extra
    own = common * (unit[:, :, None] * unit[:, None, :])
    diagonal = np.arange(3 * DISCS)
    own[:, diagonal, diagonal] += 1.0
    guess = (slope[:, None] @ (beliefs.mean - line.about[:, None])[..., None])[..., 0]
    value = (np.where(used, measured - line.value, 0.0) * unit)[:, None] - guess
    cross = slope[:, None] @ beliefs.covariance  # (5, K, 9, n)
    s = cross @ np.swapaxes(slope, 1, 2)[:, None] + own[:, None]
    inverse = np.linalg.inv(s)
    gain_t = inverse @ cross
    mean = beliefs.mean + (value[..., None, :] @ gain_t)[..., 0, :]
    covariance = beliefs.covariance - np.swapaxes(gain_t, -1, -2) @ cross
    covariance = 0.5 * (covariance + np.swapaxes(covariance, -1, -2))
    surprise = (inverse @ value[..., None])[..., 0]
    nis = np.sum(value * surprise, axis=-1)
    log_likelihood = -0.5 * (nis + np.linalg.slogdet(s)[1])
    log_weight = np.log(beliefs.probability) + log_likelihood
    weight = np.exp(log_weight - log_weight.max(axis=1, keepdims=True))
    weight = np.maximum(weight / weight.sum(axis=1, keepdims=True), 1e-6)
    weight = weight / weight.sum(axis=1, keepdims=True)
    residual = surprise / np.sqrt(np.diagonal(inverse, axis1=-2, axis2=-1))
    return RayUpdate(
        RayBeliefs(mean, covariance, weight),
        np.sum(weight * nis, axis=1),
        used.sum(axis=1),
        np.where(used, np.sum(weight[..., None] * residual, axis=1), 0.0),
    )
