"""The unscented filter of thumb and fingers: five small filters side by side, given the palm.

A finger tells next to nothing about the palm, so each digit is filtered for itself in the frame of the palm as
corrected a moment before (what the palm's own error adds to a joint's is added when it is read). Each digit's state
holds its joints, their rates and the constants of its anatomy, so the sharpening of the anatomy and what its
error does to the angles are part of the filter. Motion modes run per digit: one finger may move while others rest.
Arrays lead with the digit (5) and, in an estimate, the mode (K).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from carpus.core.camera import Camera
from carpus.core.compiled import digit_images, digits
from carpus.core.tracking.hand_geometry import CHAINS, CONSTANTS, SLOTS
from carpus.core.tracking.kernel import Linearisation, ModeMixture, predicted
from carpus.core.tracking.unscented import Spread, Weights, weights_for
from carpus.core.types import FloatArray

_SLOT = np.arange(SLOTS)

JOINTS, RATES = slice(0, SLOTS), slice(SLOTS, 2 * SLOTS)
ANATOMY = slice(RATES.stop, RATES.stop + CONSTANTS)
"""Where joints, their rates and the constants of the anatomy stand in a digit's state."""
DIGIT_SIZE = ANATOMY.stop
SEEN = np.r_[JOINTS, ANATOMY]
"""States on which the discs depend."""


@dataclass(frozen=True, slots=True)
class Forgetting:
    """What becomes of slots that nothing shows: share ``keep_rate`` (5, 5) kept of the rate, variance ``angle2`` (5, 5)
    and ``rate2`` (5, 5) gained."""

    keep_rate: FloatArray
    angle2: FloatArray
    rate2: FloatArray


class DigitMotion:
    """How the digits may move between two frames: constant rates, pushed by white accelerations.

    ``density`` (5, 5) by digit and slot: variance per second of the rate; ``scales`` (K,) of its root by mode;
    ``drift`` (5, 11) variance per second of the constants, skin over bone. Slots with a ``stationary2`` (5, 5), their
    variance in the long run, have no rate: they return to zero within ``settles_s``.
    """

    def __init__(
        self, density: FloatArray, scales: FloatArray, drift: FloatArray, stationary2: FloatArray, settles_s: float
    ) -> None:
        self._stationary2, self._settles_s = stationary2, settles_s
        self._dt_s = math.nan
        self._forward = self._modes = drift
        self._noise = drift, drift
        angle, rate, constant = _SLOT, SLOTS + _SLOT, np.arange(ANATOMY.start, ANATOMY.stop)
        self._still = np.repeat(np.eye(DIGIT_SIZE)[None], CHAINS, axis=0)
        # By dt cubed over three, squared over two, and by dt: of the rates' noise, and of the constants'.
        self._by_dt = np.zeros((4, CHAINS, DIGIT_SIZE, DIGIT_SIZE))
        self._by_dt[0][:, angle, angle] = density
        self._by_dt[1][:, angle, rate] = self._by_dt[1][:, rate, angle] = density
        self._by_dt[2][:, rate, rate] = density
        self._by_dt[3][:, constant, constant] = drift
        self._scales2 = (scales**2)[:, None, None]

    def _set_step(self, dt_s: float) -> None:
        """Transition (n, n) and noise of a step; frames come evenly, so the last ones mostly serve again."""
        if self._dt_s == dt_s:
            return
        forward, angle = self._still.copy(), _SLOT
        forward[:, angle, SLOTS + angle] = dt_s
        keep = np.where(self._stationary2 > 0.0, math.exp(-dt_s / self._settles_s), 1.0)
        forward[:, angle, angle] = keep
        pushed = self._by_dt[0] * (dt_s**3 / 3.0)
        pushed += self._by_dt[1] * (0.5 * dt_s**2)
        pushed += self._by_dt[2] * dt_s
        drifted = self._by_dt[3] * dt_s
        drifted[:, angle, angle] = self._stationary2 * (1.0 - keep**2)
        self._forward, self._noise = forward, (pushed, drifted)
        self._modes = pushed[:, None] * self._scales2
        self._modes += drifted[:, None]
        self._dt_s = dt_s

    def predicted(
        self, estimates: ModeMixture, dt_s: float, forgetting: Forgetting | None, switch: FloatArray | None = None
    ) -> ModeMixture:
        """The estimates ``dt_s`` later, their modes mixed before by ``switch`` (K, K)."""
        self._set_step(dt_s)
        if forgetting is None:
            return predicted(estimates, self._forward, self._modes, switch)
        noise = self._modes.copy()
        self._spread(noise, forgetting)
        return predicted(estimates, self._fading(forgetting), noise, switch)

    def step(self, dt_s: float, scale: FloatArray, forgetting: Forgetting | None) -> tuple[FloatArray, FloatArray]:
        """Transition and noise (5, n, n) of a step with the noise's root scaled by ``scale`` (5,)."""
        self._set_step(dt_s)
        forward = self._forward.copy() if forgetting is None else self._fading(forgetting)
        noise = self._noise[0] * (scale**2)[:, None, None] + self._noise[1]
        if forgetting is not None:
            self._spread(noise[:, None], forgetting)
        return forward, noise

    def _fading(self, forgetting: Forgetting) -> FloatArray:
        forward = self._forward.copy()
        forward[:, SLOTS + _SLOT, SLOTS + _SLOT] = forgetting.keep_rate
        forward[:, _SLOT, SLOTS + _SLOT] = forgetting.keep_rate * self._dt_s
        return forward

    def _spread(self, covariance: FloatArray, forgetting: Forgetting) -> None:
        covariance[..., _SLOT, _SLOT] += forgetting.angle2[:, None]
        covariance[..., SLOTS + _SLOT, SLOTS + _SLOT] += forgetting.rate2[:, None]


@dataclass(frozen=True, slots=True)
class DigitPoints:
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


def bent_weights(spread: Spread) -> Weights:
    """Weights of the points."""
    return weights_for(digits.BENT.size, spread)


def spread_points(mean: FloatArray, covariance: FloatArray, root_disc_m: FloatArray, spread: Spread) -> DigitPoints:
    """Sigma points of states (5, n) with covariances (5, n, n); ``root_disc_m`` (5, 3) discs under which they begin."""
    found = digits.spread_points(mean, covariance, root_disc_m, bent_weights(spread).scale)
    return DigitPoints(*found, mean, covariance)


@dataclass(frozen=True, slots=True)
class DigitView:
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


@dataclass(frozen=True, slots=True)
class DigitsLinearisation(Linearisation):
    """What the camera should see: u, v, z of the three discs in turn, (5, 9), linearised.

    ``spread`` (5, 9, 9) covariance of the images, slope and error together. ``centre_m`` (5, 3, 3) the discs in camera
    axes; ``by_place`` (5, 3, 3, 3) derivative of the images by that.
    """

    spread: FloatArray
    centre_m: FloatArray
    by_place: FloatArray


def digits_linearised(points: DigitPoints, view: DigitView, spread: Spread) -> DigitsLinearisation:
    """Statistical linear regression of the discs' images on the joints, and their slope by the constants."""
    value, slope, error, whole, centre_m, by_place = digit_images.linearise_images(points, view, bent_weights(spread))
    return DigitsLinearisation(value, slope, error, points.mean, whole, centre_m, by_place)
