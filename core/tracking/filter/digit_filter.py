"""The unscented filter of thumb and fingers: five small filters side by side, given the palm.

A finger tells next to nothing about the palm, so each digit is filtered by itself in the frame of the palm as updated a
moment before (what the palm's own error adds to a joint's is added when it is read). Each digit's state holds its
joints, their rates and the constants of its anatomy, so the sharpening of the anatomy and what its error does to the
angles are part of the filter. Motion modes run per digit: one finger may move while others rest. Arrays lead with the
digit (5) and, in an estimate, the mode (K).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from carpus.core.compiled import digit_images, digits, mixture
from carpus.core.model import so3
from carpus.core.model.camera import Camera
from carpus.core.model.hand.anatomy import ABDUCTION_LIMIT_RAD, HARD_LIMITS_RAD
from carpus.core.model.hand.kinematics import DIP_PER_PIP
from carpus.core.model.types import FloatArray
from carpus.core.tracking.filter.hand_geometry import N_CONSTANTS, N_DIGITS, N_DISCS, N_SLOTS, PalmGeometry
from carpus.core.tracking.filter.mixture_filter import (
    Linearisation,
    ModeMixture,
    SigmaWeights,
    UnscentedParameters,
    compute_weights,
)

JOINTS, RATES = slice(0, N_SLOTS), slice(N_SLOTS, 2 * N_SLOTS)
# Rows of joints, their rates and the constants of the anatomy in a digit's state.
ANATOMY = slice(RATES.stop, RATES.stop + N_CONSTANTS)
DIGIT_SIZE = ANATOMY.stop
OBSERVED = np.r_[JOINTS, ANATOMY]  # rows on which the discs depend


def _find_diagonal(row: int, column: int, count: int) -> slice:
    """Return the places of a diagonal in a matrix (n, n) stored row by row."""
    first = row * DIGIT_SIZE + column
    return slice(first, first + count * (DIGIT_SIZE + 1), DIGIT_SIZE + 1)


_JOINTS, _RATES = _find_diagonal(0, 0, N_SLOTS), _find_diagonal(N_SLOTS, N_SLOTS, N_SLOTS)
_JOINTS_BY_RATES, _RATES_BY_JOINTS = _find_diagonal(0, N_SLOTS, N_SLOTS), _find_diagonal(N_SLOTS, 0, N_SLOTS)
_CONSTANTS = _find_diagonal(ANATOMY.start, ANATOMY.start, N_CONSTANTS)


@dataclass(frozen=True, slots=True)
class Forgetting:
    """Prediction of slots that nothing shows.

    Share ``keep_rate`` (5, 5) kept of the rate, variance ``angle2`` (5, 5) and ``rate2`` (5, 5) gained.
    """

    keep_rate: FloatArray
    angle2: FloatArray
    rate2: FloatArray


class DigitMotion:
    """Motion model of the digits: constant rates, driven by white accelerations.

    ``density`` (5, 5) by digit and slot: variance per second of the rate; ``scales`` (K,) of its root by mode;
    ``drift`` (5, 11) variance per second of the constants, skin over bone. Slots with a ``stationary2`` (5, 5), their
    variance in the long run, have no rate: they return to zero within ``settles_s``.
    """

    def __init__(
        self, density: FloatArray, scales: FloatArray, drift: FloatArray, stationary2: FloatArray, settles_s: float
    ) -> None:
        self.density, self.drift = density, drift
        self.stationary2, self.settles_s = stationary2, settles_s
        self._scales2 = np.tile(scales**2, (N_DIGITS, 1))

    def predict(
        self, estimates: ModeMixture, dt_s: float, forgetting: Forgetting | None, switch: FloatArray | None = None
    ) -> ModeMixture:
        """Predict the estimates ``dt_s`` ahead, their modes mixed before by ``switch`` (K, K)."""
        step = self.compute_transition(dt_s, self._scales2, forgetting)
        return ModeMixture(*mixture.predict_modes(estimates, *step, switch))

    def compute_transition(
        self, dt_s: float, scale2: FloatArray, forgetting: Forgetting | None
    ) -> tuple[FloatArray, FloatArray]:
        """Return F (5, n, n) and Q (5, K, n, n), the density ``scale2`` (5, K) times as large.

        Rates stay, pushed all along the step by a white acceleration of density q: Q holds q dt^3 / 3, q dt^2 / 2 and
        q dt. Slots with a variance in the long run return to zero (Ornstein-Uhlenbeck); constants drift.
        """
        pushed = scale2[:, :, None] * self.density[:, None]
        settled = np.where(self.stationary2 > 0.0, math.exp(-dt_s / self.settles_s), 1.0)
        forward, noise = np.zeros((N_DIGITS, DIGIT_SIZE**2)), np.zeros((*scale2.shape, DIGIT_SIZE**2))
        forward[:, :: DIGIT_SIZE + 1] = 1.0
        forward[:, _JOINTS], forward[:, _JOINTS_BY_RATES] = settled, dt_s
        noise[..., _JOINTS] = pushed * (dt_s**3 / 3.0) + (self.stationary2 * (1.0 - settled**2))[:, None]
        noise[..., _JOINTS_BY_RATES] = noise[..., _RATES_BY_JOINTS] = pushed * (0.5 * dt_s**2)
        noise[..., _RATES] = pushed * dt_s
        noise[..., _CONSTANTS] = (self.drift * dt_s)[:, None]
        if forgetting is not None:
            forward[:, _JOINTS_BY_RATES] *= forgetting.keep_rate
            forward[:, _RATES] = forgetting.keep_rate
            noise[..., _JOINTS] += forgetting.angle2[:, None]
            noise[..., _RATES] += forgetting.rate2[:, None]
        shape = DIGIT_SIZE, DIGIT_SIZE
        return forward.reshape(N_DIGITS, *shape), noise.reshape(*scale2.shape, *shape)


@dataclass(frozen=True, slots=True)
class DigitSigmaPoints:
    """Sigma points of a Gaussian over joints and constants, their discs in W.

    The points stand along the first six columns of the Cholesky factor, the joints' and the roll's: in these the discs'
    places are nonlinear. In the other constants they are all but linear. ``unroot`` (5, 6, 6) inverse of the factor,
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


def digit_sigma_weights(scaling: UnscentedParameters) -> SigmaWeights:
    """Return the weights of a digit's sigma points."""
    return compute_weights(digits.BENT.size, scaling)


def draw_sigma_points(
    mean: FloatArray, covariance: FloatArray, root_disc_m: FloatArray, scaling: UnscentedParameters
) -> DigitSigmaPoints:
    """Draw sigma points of states (5, n), on the discs ``root_disc_m`` (5, 3) under which they begin."""
    found = digits.compute_digit_sigma_points(mean, covariance, root_disc_m, digit_sigma_weights(scaling).scale)
    return DigitSigmaPoints(*found, mean, covariance)


@dataclass(frozen=True, slots=True)
class DigitView:
    """View of the digits: ``rotation`` (3, 3) and ``translation_m`` (3,) from W2 into camera axes."""

    rotation: FloatArray
    translation_m: FloatArray
    camera: Camera

    def observe(self, point_m: FloatArray) -> FloatArray:
        """Return pixel u, v and depth z of points (..., 3) of W2."""
        out: FloatArray = point_m @ self.rotation.T
        out += self.translation_m
        camera, z = self.camera, out[..., 2]
        out[..., 0] *= camera.fx_px / z
        out[..., 0] += camera.cx_px
        out[..., 1] *= camera.fy_px / z
        out[..., 1] += camera.cy_px
        return out


@dataclass(frozen=True, slots=True)
class DigitLinearisation(Linearisation):
    """Predicted u, v, z of the three discs in turn, (5, 9), linearised.

    ``image_covariance`` (5, 9, 9), slope and error together. ``centre_m`` (5, 3, 3) the discs in camera axes;
    ``by_place`` (5, 3, 3, 3) derivative of the images by that.
    """

    image_covariance: FloatArray
    centre_m: FloatArray
    by_place: FloatArray


def linearise_digits(points: DigitSigmaPoints, view: DigitView, scaling: UnscentedParameters) -> DigitLinearisation:
    """Linearise the discs' images: regression on the joints, derivative by the constants."""
    value, slope, error, whole, centre_m, by_place = digit_images.linearise_images(
        points, view, digit_sigma_weights(scaling)
    )
    return DigitLinearisation(value, slope, error, points.mean, whole, centre_m, by_place)


@dataclass(frozen=True, slots=True)
class DigitBase:
    """The palm as just updated, on which the fingers sit.

    ``view`` from W2 of a right hand to the camera. In camera axes: ``pose_covariance`` (6, 6) of the tracked body's
    position and turn; ``turn_covariance`` (3, 3) of the axes of W2, calibration error included.
    """

    palm: PalmGeometry
    view: DigitView
    pose_covariance: FloatArray
    turn_covariance: FloatArray

    def compute_image_covariance(self, linearised: DigitLinearisation) -> FloatArray:
        """Return the covariance (5, 9, 9) of the discs' images by the palm's error alone."""
        by_pose = np.empty((N_DIGITS, N_DISCS, 3, 6))
        by_pose[..., :3] = linearised.by_place
        by_pose[..., 3:] = linearised.by_place @ so3.skew(self.view.translation_m - linearised.centre_m)
        flat = by_pose.reshape(N_DIGITS, 3 * N_DISCS, 6)
        return np.asarray(flat @ self.pose_covariance @ np.swapaxes(flat, 1, 2))


# Joint limits as soft constraints (clinical reference 4.1): pseudo-measurements that pull, not walls that clip. An
# angle's Gaussian is multiplied by the probability that the joint can be there, a step of 3 degrees' standard deviation
# at either limit, and replaced by the Gaussian of the same mean and variance. Far inside nothing happens; beyond a
# limit it acts as a measurement of the limit with that standard deviation; an angle of which nothing is known ends up
# spread over its range.
_NAMES = (
    ("CMC1_extension", "CMC1_abduction", "MCP1_flexion", "MCP1_abduction", "IP1_flexion"),
    *((f"MCP{k}_abduction", f"MCP{k}_flexion", f"PIP{k}_flexion", f"DIP{k}_flexion", "") for k in (2, 3, 4, 5)),
)
_WIDE = (-1e3, 1e3)
_LIMITS = np.array([[HARD_LIMITS_RAD.get(name, _WIDE) for name in chain] for chain in _NAMES])  # (5, 5, 2)
_DIRECTION = np.broadcast_to(np.eye(N_SLOTS), (N_DIGITS, N_SLOTS, N_SLOTS)).copy()
_DIRECTION[1:, 3, 2] = DIP_PER_PIP

# Standard deviation (5, 5) of an angle of which only its limits are known.
RANGE_SD_RAD = np.where(_LIMITS[..., 1] < 1e2, (_LIMITS[..., 1] - _LIMITS[..., 0]) / math.sqrt(12.0), 0.0)

MID_RANGE_RAD = np.where(_LIMITS[..., 1] < 1e2, _LIMITS.mean(axis=-1), 0.0)
MID_RANGE_RAD[1:, 3] = 0.0
"""Slots (5, 5) in the middle of their range; the end joint as the coupling has it."""

LIMIT_SD_RAD = math.radians(3.0)  # standard deviation of the step at a limit
LIMIT_GATE_SD = 3.0  # from a limit, in standard deviations of angle and step together, from which on it pulls


def slot_limits_rad(slots: FloatArray) -> FloatArray:
    """Return limits (5, 5, 2) of the angles at slots (5, 5); abduction shrinks as the finger bends."""
    limits = _LIMITS.copy()
    reach = ABDUCTION_LIMIT_RAD * np.maximum(np.cos(slots[1:, 1]), 0.0)
    limits[1:, 0, 0], limits[1:, 0, 1] = -reach, reach
    return limits


def compute_limit_excess(slots: FloatArray) -> FloatArray:
    """Return by how much (5, 5) the angles lie beyond their limits; 0 inside, negative below."""
    angles = np.vecdot(_DIRECTION, slots[:, None])
    limits = slot_limits_rad(slots)
    return np.asarray(np.maximum(angles - limits[..., 1], 0.0) + np.minimum(angles - limits[..., 0], 0.0))


def apply_soft_limits(estimates: ModeMixture, slots: FloatArray) -> ModeMixture:
    """Apply the limits to the estimates; ``slots`` (5, 5) are the merged joints.

    Each angle's pull is found by itself, then all pulls of a digit act together, as measurements with independent
    errors.
    """
    found = digits.apply_limits(estimates, slot_limits_rad(slots), _DIRECTION, LIMIT_SD_RAD, LIMIT_GATE_SD)
    return estimates if found is None else ModeMixture(*found, estimates.probability)
