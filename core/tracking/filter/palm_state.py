"""State of the palm: pose and velocities of the fixed unit, the discs' places, skin and surface.

The fixed unit of the hand is capitate, second and third metacarpal (clinical reference 10): the wrist's angles mean it.
Each disc has a calibrated place on it that goes on being measured (``SHAPE``) and may leave that place as the skin
glides, the arch closes or a metacarpal flexes (``SKIN``), for a while. So has the back of the hand as a surface:
``SURFACE`` is what its calibration was wrong by, as a turn about X and Y and a height, ``RELIEF`` by how much it has
come to differ since. ``CALIBRATION_ERROR``, shape and surface, is constant, and less with every motion.

Symbols of the papers: T position, v velocity, R rotation, omega angular velocity, P covariance. Orientation stays a
matrix; its error is a rotation vector d in the moving frame, R_true = R Exp(d).

Measured for a marker are its pixel u, v (eq. (2), (3) of the wrist paper) and the depth z of its disc along the
camera's axis, as in the initialisation (13). h is nonlinear in the pose, so it is linearised through sigma points of
the pose (10), (11); in the discs' places it is all but linear, and its slope is the derivative.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np

from carpus.core.compiled.palm import reset_errors
from carpus.core.model import so3
from carpus.core.model.camera import Camera
from carpus.core.model.types import FloatArray
from carpus.core.tracking.filter.mixture_filter import ModeMixture

N_PALM_DISCS = 6
POSITION, VELOCITY, TURN, RATE = slice(0, 3), slice(3, 6), slice(6, 9), slice(9, 12)
SHAPE = slice(12, 12 + 3 * N_PALM_DISCS)
SURFACE = slice(SHAPE.stop, SHAPE.stop + 3)
CALIBRATION_ERROR = slice(SHAPE.start, SURFACE.stop)
SKIN = slice(SURFACE.stop, SURFACE.stop + 3 * N_PALM_DISCS)
RELIEF = slice(SKIN.stop, SKIN.stop + 3)
SOFT_TISSUE = slice(SKIN.start, RELIEF.stop)
RIGID_MOTION = slice(0, 12)
SIZE = RELIEF.stop
POSE = np.r_[POSITION, TURN]


@dataclass(frozen=True, slots=True)
class PalmEstimate:
    """Gaussian over the palm's state.

    ``rotation_w2_w0`` (3, 3), all other numbers as ``value`` (n,), zero where the turn would stand, and the
    ``covariance`` (n, n) of the error vector.
    """

    rotation_w2_w0: FloatArray
    value: FloatArray
    covariance: FloatArray

    @property
    def position_m(self) -> FloatArray:
        """Position T (3,) in W0 of the point of the fixed unit that lay under WRIST at the neutral pose."""
        return self.value[POSITION]

    @property
    def velocity_m_s(self) -> FloatArray:
        """Velocity v (3,) in W0."""
        return self.value[VELOCITY]

    @property
    def rate_rad_s(self) -> FloatArray:
        """Angular velocity omega (3,) in W2."""
        return self.value[RATE]

    @property
    def shape_m(self) -> FloatArray:
        """Corrections (6, 3) to the discs' calibrated places on the fixed unit."""
        return self.value[SHAPE].reshape(N_PALM_DISCS, 3)

    @property
    def skin_m(self) -> FloatArray:
        """Displacements (6, 3) of the discs from those places for now."""
        return self.value[SKIN].reshape(N_PALM_DISCS, 3)

    def add_error(self, error: FloatArray, covariance: FloatArray) -> Self:
        """Return the estimate with an error vector (n,) added to its mean, and another covariance."""
        value = self.value + error
        value[TURN] = 0.0
        return type(self)(self.rotation_w2_w0 @ so3.exp(error[TURN]), value, covariance)

    def compute_error(self, other: PalmEstimate) -> FloatArray:
        """Return the error vector (n,) from this mean to another's; inverse of :meth:`add_error`."""
        error = other.value - self.value
        error[TURN] = so3.log(self.rotation_w2_w0.T @ other.rotation_w2_w0)
        return error


_MIN_SD_M = 1e-5  # keeps the covariance positive definite where nothing has moved yet


@dataclass(frozen=True, slots=True)
class InitialSd:
    """Standard deviations at the start; the joints' are the fingers'."""

    position_m: float = 0.001
    velocity_m_s: float = 0.02
    turn_rad: float = 0.01
    rate_rad_s: float = 0.2
    joint_rates_rad_s: float = 0.3


def initial_estimate(sd: InitialSd, calibration_covariance: FloatArray) -> PalmEstimate:
    """Return a hand at rest at the neutral pose, its discs where they were calibrated.

    ``calibration_covariance`` (21, 21) of the calibration's error.
    """
    covariance = np.zeros((SIZE, SIZE))
    for part, own in (
        (POSITION, sd.position_m),
        (VELOCITY, sd.velocity_m_s),
        (TURN, sd.turn_rad),
        (RATE, sd.rate_rad_s),
    ):
        covariance[part, part] = own**2 * np.eye(3)
    covariance[CALIBRATION_ERROR, CALIBRATION_ERROR] = calibration_covariance
    covariance[SKIN, SKIN] = _MIN_SD_M**2 * np.eye(SKIN.stop - SKIN.start)
    covariance[RELIEF, RELIEF] = _MIN_SD_M**2 * np.eye(3)
    return PalmEstimate(np.eye(3), np.zeros(SIZE), covariance)


ZERO_ERROR = np.zeros((1, SIZE))


@dataclass(frozen=True, slots=True)
class PalmView:
    """A palm of known geometry before a camera of known pose (g_w0c of the wrist paper).

    ``palm_m`` (6, 3) calibrated places of the discs on the fixed unit. ``depth_bias`` (6, 18): by how much each number
    of the shape moves the depths less than the discs' places say, because those of the calibration were as wrong.
    """

    camera: Camera
    rotation_w0_cam: FloatArray
    translation_w0_cam_m: FloatArray
    palm_m: FloatArray
    depth_bias: FloatArray

    def discs_cam_m(self, estimate: PalmEstimate) -> FloatArray:
        """Return the disc centres (6, 3) in camera axes."""
        place = self.palm_m + estimate.shape_m + estimate.skin_m
        in_w0 = place @ estimate.rotation_w2_w0.T + estimate.position_m
        return np.asarray(in_w0 @ self.rotation_w0_cam.T + self.translation_w0_cam_m)

    def to_camera(
        self, estimate: PalmEstimate, axes: FloatArray, origin_m: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Transform a palm's ``axes`` (3, 3) at ``origin_m`` (3,) from the tracked body to camera axes."""
        body_cam = self.rotation_w0_cam @ estimate.rotation_w2_w0
        origin = body_cam @ origin_m + self.rotation_w0_cam @ estimate.position_m + self.translation_w0_cam_m
        return body_cam @ axes, origin


def reset_error(nominal: PalmEstimate, mixture: ModeMixture) -> tuple[PalmEstimate, ModeMixture]:
    """Move the nominal estimate to the mixture's mean; return it and the mixture as errors from there."""
    rotation, value, covariance, errors = reset_errors(nominal, mixture)
    reset = ModeMixture(errors, mixture.covariance, mixture.probability)
    return PalmEstimate(rotation, value, covariance), reset
