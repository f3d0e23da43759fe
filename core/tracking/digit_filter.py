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
from carpus.core.kernels.choice import in_c
from carpus.core.tracking.hand_geometry import (
    CHAINS,
    CONSTANTS,
    DISCS,
    SLOTS,
    digit_discs_m,
    digit_frames,
    digit_joints_m,
    slope_by_constants,
)
from carpus.core.tracking.kernel import Linearisation, ModeMixture, predicted
from carpus.core.tracking.unscented import Spread, Weights, weights_for
from carpus.core.types import FloatArray

FLOOR = 1e-14
_SLOT = np.arange(SLOTS)
_ROLL = 4
_BENT = np.arange(SLOTS + 1)
_OTHER_CONSTANT = np.delete(np.arange(CONSTANTS), _ROLL)
_BENT_STATE, _OTHER_STATE = np.append(_SLOT, SLOTS + _ROLL), SLOTS + _OTHER_CONSTANT

JOINTS, RATES = slice(0, SLOTS), slice(SLOTS, 2 * SLOTS)
ANATOMY = slice(RATES.stop, RATES.stop + CONSTANTS)
"""Where joints, their rates and the constants of the anatomy stand in a digit's state."""
DIGIT_SIZE = ANATOMY.stop
SEEN = np.r_[JOINTS, ANATOMY]
"""States on which the discs depend."""
_BENT_AT, _OTHER_AT = SEEN[_BENT_STATE], SEEN[_OTHER_STATE]


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

    @staticmethod
    def to_be_filled(mean: FloatArray | None = None, covariance: FloatArray | None = None) -> DigitPoints:
        """Before a kernel has worked them out."""
        bends, others = _BENT.size, _OTHER_CONSTANT.size
        return DigitPoints(
            np.empty((CHAINS, 2 * bends + 1, DISCS, 3)),
            np.empty((CHAINS, bends, bends)),
            np.empty((CHAINS, bends, others)),
            np.empty((CHAINS, DISCS, 3, others)),
            np.empty((CHAINS, DISCS, 3)),
            np.empty((CHAINS, DIGIT_SIZE)) if mean is None else mean,
            np.empty((CHAINS, DIGIT_SIZE, DIGIT_SIZE)) if covariance is None else covariance,
        )

    @property
    def parts(self) -> tuple[FloatArray, ...]:
        """What a kernel fills in."""
        return self.disc_m, self.unroot, self.along, self.by_constants, self.normal


def bent_weights(spread: Spread) -> Weights:
    """Weights of the points."""
    return weights_for(_BENT.size, spread)


def spread_points(mean: FloatArray, covariance: FloatArray, root_disc_m: FloatArray, spread: Spread) -> DigitPoints:
    """Sigma points of states (5, n) with covariances (5, n, n); ``root_disc_m`` (5, 3) discs under which they begin."""
    if (kernels := in_c()) is not None:
        points = DigitPoints.to_be_filled(mean, covariance)
        kernels.digits_spread(mean, covariance, root_disc_m, FLOOR, bent_weights(spread).scale, *points.parts)
        return points
    bent, other = _BENT_AT, _OTHER_AT
    block = covariance[:, bent[:, None], bent]
    block[:, _BENT, _BENT] += FLOOR
    root = np.asarray(np.linalg.cholesky(block), dtype=np.float64)
    unroot = np.asarray(np.linalg.inv(root), dtype=np.float64)
    along = unroot @ covariance[:, bent[:, None], other]
    scale = weights_for(_BENT.size, spread).scale
    point = np.repeat(mean[:, None, SEEN], 2 * _BENT.size + 1, axis=1)
    step = np.empty((CHAINS, _BENT.size, SLOTS + CONSTANTS))
    step[..., _BENT_STATE], step[..., _OTHER_STATE] = np.swapaxes(root, 1, 2) * scale, along * scale
    point[:, 1 : _BENT.size + 1] += step
    point[:, _BENT.size + 1 :] -= step
    state = point[:, 0]
    frames = digit_frames(state)
    by_constants = slope_by_constants(state, frames, digit_joints_m(root_disc_m, state, frames))[..., _OTHER_CONSTANT]
    return DigitPoints(digit_discs_m(root_disc_m, point), unroot, along, by_constants, frames.normal, mean, covariance)


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
    count = _BENT.size
    weights = weights_for(count, spread)
    if (kernels := in_c()) is not None:
        camera, seen = view.camera, 3 * DISCS
        linearised = DigitsLinearisation(
            np.empty((CHAINS, seen)), np.empty((CHAINS, seen, DIGIT_SIZE)), np.empty((CHAINS, seen, seen)), points.mean,
            np.empty((CHAINS, seen, seen)), np.empty((CHAINS, DISCS, 3)), np.empty((CHAINS, DISCS, 3, 3)),
        )  # fmt: skip
        kernels.digits_linearised(
            points.disc_m, points.unroot, points.along, points.by_constants, points.covariance, view.rotation,
            view.translation_m, camera.fx_px, camera.fy_px, camera.cx_px, camera.cy_px, weights.numbers,
            linearised.value, linearised.slope, linearised.error, linearised.spread, linearised.centre_m,
            linearised.by_place,
        )  # fmt: skip
        return linearised
    image = view.observe(points.disc_m).reshape(CHAINS, 2 * count + 1, 3 * DISCS)
    value: FloatArray = weights.mean @ image
    plus, minus = image[:, 1 : count + 1], image[:, count + 1 :]
    half = (plus - minus) * (0.5 / weights.scale)  # (5, 6, 9): slope in the axes of the root
    # The even part of the spread is what nothing linear can follow.
    bend = 0.5 * (plus + minus) - value[:, None]
    error = (2.0 * weights.covariance[1]) * (np.swapaxes(bend, 1, 2) @ bend)
    middle = image[:, :1] - value[:, None]
    error += weights.covariance[0] * (np.swapaxes(middle, 1, 2) @ middle)
    by_place = view.camera.slope(image[:, 0].reshape(CHAINS, DISCS, 3))
    by_constants = ((by_place @ view.rotation) @ points.by_constants).reshape(CHAINS, 3 * DISCS, -1)
    own = half - points.along @ np.swapaxes(by_constants, 1, 2)
    slope = np.zeros((CHAINS, 3 * DISCS, DIGIT_SIZE))
    slope[:, :, _BENT_AT] = np.swapaxes(own, 1, 2) @ points.unroot
    slope[:, :, _OTHER_AT] = by_constants
    spread_out = slope @ points.covariance @ np.swapaxes(slope, 1, 2) + error
    centre = points.disc_m[:, 0] @ view.rotation.T + view.translation_m
    return DigitsLinearisation(value, slope, error, points.mean, spread_out, centre, by_place)
