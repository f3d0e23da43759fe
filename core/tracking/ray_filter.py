"""The unscented filter of thumb and fingers: five small filters side by side, given the palm.

A finger tells next to nothing about the palm, so each ray is filtered for itself in the frame of the palm as
corrected a moment before (what the palm's own error adds to a joint's is added when it is read). Each ray's state
holds its joints, their rates and the constants of its anatomy, so the sharpening of the anatomy and what its
error does to the angles are part of the filter. Motion modes run per ray: one finger may move while others rest.
Arrays lead with the ray (5) and, in a belief, the mode (K).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from core.camera import Camera
from core.tracking.hand_geometry import (
    CONSTANTS,
    DISCS,
    RAYS,
    SLOTS,
    ray_discs_m,
    ray_frames,
    ray_joints_m,
    slope_by_constants,
)
from core.tracking.unscented import Spread, weights_for
from core.types import FloatArray

PINNINGS = 2
"""How often the line of a ray found far from where it was expected is drawn again about what its discs say."""
_FLOOR = 1e-14
_SEEN = {
    False: np.arange(SLOTS + CONSTANTS),
    True: np.concatenate((np.arange(SLOTS), np.arange(2 * SLOTS, 2 * SLOTS + CONSTANTS))),
}
_SLOT = np.arange(SLOTS)
_ROLL = 4
_BENT = np.arange(SLOTS + 1)
_OTHER_CONSTANT = np.delete(np.arange(CONSTANTS), _ROLL)
_BENT_STATE, _OTHER_STATE = np.append(_SLOT, SLOTS + _ROLL), SLOTS + _OTHER_CONSTANT

_BENT_OF = {has_rates: np.asarray(seen[_BENT_STATE]) for has_rates, seen in _SEEN.items()}
_OTHER_OF = {has_rates: np.asarray(seen[_OTHER_STATE]) for has_rates, seen in _SEEN.items()}


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

    @property
    def bent(self) -> NDArray[np.int64]:
        """Joints and roll, in which the discs' places bend."""
        return _BENT_OF[self.has_rates]

    @property
    def other(self) -> NDArray[np.int64]:
        """The constants but for the roll."""
        return _OTHER_OF[self.has_rates]


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
class Forgetting:
    """What becomes of slots that nothing shows: share ``keep_rate`` (5, 5) kept of the rate, variance ``angle2`` (5, 5)
    and ``rate2`` (5, 5) gained."""

    keep_rate: FloatArray
    angle2: FloatArray
    rate2: FloatArray


class RayMotion:
    """How the rays may move between two frames: constant rates or, as in the papers, random walks.

    ``density`` (5, 5) by ray and slot: variance per second of the rate (constant rate) or of the angle (random walk);
    ``scales`` (K,) of its root by mode; ``drift`` (5, 11) variance per second of the constants, skin over bone.
    """

    def __init__(self, density: FloatArray, scales: FloatArray, drift: FloatArray, layout: RayLayout) -> None:
        self._density, self._scales, self._drift, self._layout = density, scales, drift, layout
        self._dt_s = math.nan
        self._forward = self._noise = self._modes = drift

    def _set_step(self, dt_s: float) -> None:
        """Transition (n, n) and noise of a step; frames come evenly, so the last ones mostly serve again."""
        if self._dt_s == dt_s:
            return
        layout, density = self._layout, self._density
        forward = np.eye(layout.size)
        noise = np.zeros((2, RAYS, layout.size, layout.size))
        angle, rate = _SLOT, SLOTS + _SLOT
        if layout.has_rates:
            forward[angle, rate] = dt_s
            noise[0][:, angle, angle] = density * (dt_s**3 / 3.0)
            noise[0][:, angle, rate] = noise[0][:, rate, angle] = density * (0.5 * dt_s**2)
            noise[0][:, rate, rate] = density * dt_s
        else:
            noise[0][:, angle, angle] = density * dt_s
        constant = np.arange(layout.constants.start, layout.constants.stop)
        noise[1][:, constant, constant] = self._drift * dt_s
        self._forward, self._noise = forward, noise
        self._modes = noise[0][:, None] * (self._scales**2)[:, None, None] + noise[1][:, None]
        self._dt_s = dt_s

    def predicted(self, beliefs: RayBeliefs, dt_s: float, forgetting: Forgetting | None) -> RayBeliefs:
        """The beliefs ``dt_s`` later."""
        self._set_step(dt_s)
        forward = self._forward if forgetting is None else self._fading(forgetting)[:, None]
        mean = (forward @ beliefs.mean[..., None])[..., 0]
        covariance = forward @ beliefs.covariance @ np.swapaxes(forward, -1, -2)
        covariance += self._modes
        if forgetting is not None:
            self._spread(covariance, forgetting)
        return RayBeliefs(mean, covariance, beliefs.probability)

    def step(self, dt_s: float, scale: FloatArray, forgetting: Forgetting | None) -> tuple[FloatArray, FloatArray]:
        """Transition and noise (5, n, n) of a step with the noise's root scaled by ``scale`` (5,)."""
        self._set_step(dt_s)
        forward = np.repeat(self._forward[None], RAYS, axis=0) if forgetting is None else self._fading(forgetting)
        noise = self._noise[0] * (scale**2)[:, None, None] + self._noise[1]
        if forgetting is not None:
            self._spread(noise[:, None], forgetting)
        return forward, noise

    def _fading(self, forgetting: Forgetting) -> FloatArray:
        forward = np.repeat(self._forward[None], RAYS, axis=0)
        if self._layout.has_rates:
            forward[:, SLOTS + _SLOT, SLOTS + _SLOT] = forgetting.keep_rate
            forward[:, _SLOT, SLOTS + _SLOT] = forgetting.keep_rate * self._dt_s
        return forward

    def _spread(self, covariance: FloatArray, forgetting: Forgetting) -> None:
        covariance[..., _SLOT, _SLOT] += forgetting.angle2[:, None]
        if self._layout.has_rates:
            covariance[..., SLOTS + _SLOT, SLOTS + _SLOT] += forgetting.rate2[:, None]


@dataclass(frozen=True, slots=True)
class RayPoints:
    """Sigma points of a Gaussian over joints and constants, their discs in W.

    The points stand along the first six columns of the Cholesky factor, the joints' and the roll's: what bends the
    discs' places. In the other constants these are all but linear. ``unroot`` (5, 6, 6) inverse of the factor,
    ``along`` (5, 6, 10) by how much the other constants go with each column; ``disc_m`` (5, 13, 3, 3), the centre
    first; ``by_constants`` (5, 3, 3, 10) derivative there; ``normal`` (5, 3, 3) of the discs; ``mean`` (5, n) and
    ``covariance`` (5, n, n) of the state.
    """

    disc_m: FloatArray
    unroot: FloatArray
    along: FloatArray
    by_constants: FloatArray
    normal: FloatArray
    mean: FloatArray
    covariance: FloatArray


def spread_points(
    mean: FloatArray, covariance: FloatArray, root_disc_m: FloatArray, layout: RayLayout, spread: Spread
) -> RayPoints:
    """Sigma points of states (5, n) with covariances (5, n, n); ``root_disc_m`` (5, 3) discs under which rays begin."""
    bent, other = layout.bent, layout.other
    block = covariance[:, bent[:, None], bent]
    block[:, _BENT, _BENT] += _FLOOR
    root = np.asarray(np.linalg.cholesky(block), dtype=np.float64)
    unroot = np.asarray(np.linalg.inv(root), dtype=np.float64)
    along = unroot @ covariance[:, bent[:, None], other]
    scale = weights_for(_BENT.size, spread).scale
    point = np.repeat(mean[:, None, layout.seen], 2 * _BENT.size + 1, axis=1)
    step = np.empty((RAYS, _BENT.size, SLOTS + CONSTANTS))
    step[..., _BENT_STATE], step[..., _OTHER_STATE] = np.swapaxes(root, 1, 2) * scale, along * scale
    point[:, 1 : _BENT.size + 1] += step
    point[:, _BENT.size + 1 :] -= step
    state = point[:, 0]
    frames = ray_frames(state)
    by_constants = slope_by_constants(state, frames, ray_joints_m(root_disc_m, state, frames))[..., _OTHER_CONSTANT]
    return RayPoints(ray_discs_m(root_disc_m, point), unroot, along, by_constants, frames.normal, mean, covariance)


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

    def slope(self, image: FloatArray) -> FloatArray:
        """Derivative (..., 3, 3) of u, v, z by the place in camera axes, at u, v, z (..., 3)."""
        camera, z = self.camera, image[..., 2]
        out = np.zeros((*image.shape, 3))
        out[..., 0, 0] = camera.fx_px / z
        out[..., 1, 1] = camera.fy_px / z
        out[..., 0, 2] = (camera.cx_px - image[..., 0]) / z
        out[..., 1, 2] = (camera.cy_px - image[..., 1]) / z
        out[..., 2, 2] = 1.0
        return out


@dataclass(frozen=True, slots=True)
class RayForecast:
    """What the camera should see, linearised statistically: y = ``value`` + ``slope`` (x - ``about``) + error.

    ``value`` (5, 9) u, v, z of the three discs in turn; ``slope`` (5, 9, n); ``error`` (5, 9, 9) covariance of what
    the line misses; ``about`` (5, n); ``spread`` (5, 9, 9) covariance of the images, both parts together.
    ``centre_m`` (5, 3, 3) the discs in camera axes; ``by_place`` (5, 3, 3, 3) derivative of the images by that.
    """

    value: FloatArray
    slope: FloatArray
    error: FloatArray
    about: FloatArray
    spread: FloatArray
    centre_m: FloatArray
    by_place: FloatArray


def forecast(points: RayPoints, view: RayView, layout: RayLayout, spread: Spread) -> RayForecast:
    """Statistical linear regression of the discs' images on the joints, and their slope by the constants."""
    count = _BENT.size
    weights = weights_for(count, spread)
    image = view.observe(points.disc_m).reshape(RAYS, 2 * count + 1, 3 * DISCS)
    value: FloatArray = weights.mean @ image
    plus, minus = image[:, 1 : count + 1], image[:, count + 1 :]
    half = (plus - minus) * (0.5 / weights.scale)  # (5, 6, 9): slope in the axes of the root
    # The even part of the spread is what no line can follow.
    bend = 0.5 * (plus + minus) - value[:, None]
    error = (2.0 * weights.covariance[1]) * (np.swapaxes(bend, 1, 2) @ bend)
    middle = image[:, :1] - value[:, None]
    error += weights.covariance[0] * (np.swapaxes(middle, 1, 2) @ middle)
    by_place = view.slope(image[:, 0].reshape(RAYS, DISCS, 3))
    by_constants = ((by_place @ view.rotation) @ points.by_constants).reshape(RAYS, 3 * DISCS, -1)
    own = half - points.along @ np.swapaxes(by_constants, 1, 2)
    slope = np.zeros((RAYS, 3 * DISCS, layout.size))
    slope[:, :, layout.bent] = np.swapaxes(own, 1, 2) @ points.unroot
    slope[:, :, layout.other] = by_constants
    spread_out = slope @ points.covariance @ np.swapaxes(slope, 1, 2) + error
    centre = points.disc_m[:, 0] @ view.rotation.T + view.translation_m
    return RayForecast(value, slope, error, points.mean, spread_out, centre, by_place)


@dataclass(frozen=True, slots=True)
class RayUpdate:
    """Corrected beliefs, ``nis`` (5,) with ``dof`` (5,) components, ``residual`` (5, 9) of each component in its own
    standard deviations (0 where nothing was measured)."""

    beliefs: RayBeliefs
    nis: FloatArray
    dof: NDArray[np.int64]
    residual: FloatArray


def learning_shares(layout: RayLayout, learning: float) -> tuple[FloatArray, FloatArray]:
    """Shares of a correction that the mean (n,) and the covariance (n, n) take, the constants only ``learning``.

    Partial-update Schmidt-Kalman filter (Brink 2017): errors that stay with a disc come again in every picture, and
    believed in full they would bend the anatomy until it explains them.
    """
    mean = np.ones(layout.size)
    mean[layout.constants] = learning
    covariance = mean[:, None] + mean - mean[:, None] * mean
    return mean, covariance


def corrected(
    beliefs: RayBeliefs,
    line: RayForecast,
    measured: FloatArray,
    variance: FloatArray,
    palm_part: FloatArray,
    shares: tuple[FloatArray, FloatArray],
) -> RayUpdate:
    """Kalman correction of every ray and mode by ``measured`` (5, 9), NaN where there is nothing, of ``variance``
    (5, 9); ``palm_part`` (5, 9, 9) covariance that the palm's error gives them; ``shares`` of :func:`learning_shares`.

    That error is taken as new in every frame; what of it stays is added when the joints are read.
    """
    used = np.isfinite(measured)
    unit = np.where(used, 1.0 / np.sqrt(np.where(used, variance, 1.0)), 0.0)
    slope = line.slope * unit[..., None]
    own = (line.error + palm_part) * (unit[:, :, None] * unit[:, None, :])
    diagonal = np.arange(3 * DISCS)
    own[:, diagonal, diagonal] += 1.0
    guess = (slope[:, None] @ (beliefs.mean - line.about[:, None])[..., None])[..., 0]
    value = (np.where(used, measured - line.value, 0.0) * unit)[:, None] - guess
    cross = slope[:, None] @ beliefs.covariance  # (5, K, 9, n)
    s = cross @ np.swapaxes(slope, 1, 2)[:, None] + own[:, None]
    inverse = np.linalg.inv(s)
    gain_t = inverse @ cross
    mean = beliefs.mean + (value[..., None, :] @ gain_t)[..., 0, :] * shares[0]
    covariance = beliefs.covariance - (np.swapaxes(gain_t, -1, -2) @ cross) * shares[1]
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
