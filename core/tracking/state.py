"""The filter's state: wrist pose and velocities, finger joints, and their joint covariance.

Symbols of the papers: T position, v velocity, R rotation, omega angular velocity, theta joints, P covariance.
Orientation stays a matrix; its error is a turn d in the moving frame, R_true = R Exp(d).
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Self

import numpy as np
from numpy.typing import NDArray

from core import so3
from core.types import FloatArray


@dataclass(frozen=True, slots=True)
class StateLayout:
    """Where each quantity stands in the error vector.

    ``has_rates``: angular velocity and joint velocities are states (constant-rate model); without them
    the state is the papers' T, v, R, theta. ``shape_count``: numbers that describe the hand's geometry and
    are refined while it moves.
    """

    joint_count: int = 0
    has_rates: bool = True
    shape_count: int = 0

    position: slice = field(init=False, repr=False, compare=False)
    velocity: slice = field(init=False, repr=False, compare=False)
    turn: slice = field(init=False, repr=False, compare=False)
    rate: slice = field(init=False, repr=False, compare=False)
    joints: slice = field(init=False, repr=False, compare=False)
    joint_rates: slice = field(init=False, repr=False, compare=False)
    shape: slice = field(init=False, repr=False, compare=False)
    size: int = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        # Worked out once: every step of the filter asks for them many times.
        rates = (3, self.joint_count) if self.has_rates else (0, 0)
        lengths = {"position": 3, "velocity": 3, "turn": 3, "rate": rates[0]}
        lengths |= {"joints": self.joint_count, "joint_rates": rates[1], "shape": self.shape_count}
        end = 0
        for name, length in lengths.items():
            object.__setattr__(self, name, slice(end, end + length))
            end += length
        object.__setattr__(self, "size", end)

    @property
    def moving(self) -> slice:
        """The states that a step of the motion changes: all but the shape."""
        return slice(0, self.shape.start)

    @property
    def seen(self) -> NDArray[np.int64]:
        """Indices of the states on which a measurement depends: position, turn, joints, shape."""
        return np.asarray(np.r_[0:3, 6:9, self.joints.start : self.joints.stop, self.shape.start : self.shape.stop])


@dataclass(frozen=True, slots=True)
class Belief:
    """Gaussian over the state; leading axes (...) hold several, such as sigma points.

    ``position_m``, ``velocity_m_s`` (..., 3) of W2 in W0; ``rotation_w2_w0`` (..., 3, 3);
    ``rate_rad_s`` (..., 3) in W2; ``joints_rad`` and ``joint_rates_rad_s`` (..., J);
    ``shape`` (..., S) corrections to the calibrated geometry, see the geometry used;
    ``covariance`` (..., n, n) of the error vector of :class:`StateLayout`.
    """

    position_m: FloatArray
    velocity_m_s: FloatArray
    rotation_w2_w0: FloatArray
    rate_rad_s: FloatArray
    joints_rad: FloatArray
    joint_rates_rad_s: FloatArray
    shape: FloatArray
    covariance: FloatArray

    def moved(self, error: FloatArray, layout: StateLayout, covariance: FloatArray | None = None) -> Self:
        """The belief with its mean moved by an error vector (..., n)."""
        has_rates = layout.has_rates
        return type(self)(
            self.position_m + error[..., layout.position],
            self.velocity_m_s + error[..., layout.velocity],
            self.rotation_w2_w0 @ so3.exp(error[..., layout.turn]),
            self.rate_rad_s + error[..., layout.rate] if has_rates else self.rate_rad_s,
            self.joints_rad + error[..., layout.joints],
            self.joint_rates_rad_s + error[..., layout.joint_rates] if has_rates else self.joint_rates_rad_s,
            self.shape + error[..., layout.shape],
            self.covariance if covariance is None else covariance,
        )

    def error_to(self, other: Belief, layout: StateLayout) -> FloatArray:
        """Error vector (..., n) that moves this mean to the other's; inverse of :meth:`moved`."""
        swapped = np.swapaxes(self.rotation_w2_w0, -1, -2)
        parts = [
            other.position_m - self.position_m,
            other.velocity_m_s - self.velocity_m_s,
            so3.log(swapped @ other.rotation_w2_w0),
        ]
        if layout.has_rates:
            parts.append(other.rate_rad_s - self.rate_rad_s)
        parts.append(other.joints_rad - self.joints_rad)
        if layout.has_rates:
            parts.append(other.joint_rates_rad_s - self.joint_rates_rad_s)
        parts.append(other.shape - self.shape)
        return np.concatenate(parts, axis=-1)


@dataclass(frozen=True, slots=True)
class InitialSd:
    """Standard deviations at the start."""

    position_m: float = 0.001
    velocity_m_s: float = 0.02
    turn_rad: float = 0.01
    rate_rad_s: float = 0.2
    joints_rad: float = 0.1
    joint_rates_rad_s: float = 0.3


def resting_belief(
    layout: StateLayout,
    sd: InitialSd,
    *,
    position_m: FloatArray | None = None,
    rotation_w2_w0: FloatArray | None = None,
    joints_rad: FloatArray | None = None,
    shape_covariance: FloatArray | None = None,
) -> Belief:
    """A hand at rest at the neutral pose (or the pose given), its shape as calibrated."""
    j = layout.joint_count
    diagonal = np.zeros(layout.size)
    diagonal[layout.position] = sd.position_m
    diagonal[layout.velocity] = sd.velocity_m_s
    diagonal[layout.turn] = sd.turn_rad
    diagonal[layout.rate] = sd.rate_rad_s
    diagonal[layout.joints] = sd.joints_rad
    diagonal[layout.joint_rates] = sd.joint_rates_rad_s
    covariance = np.diag(diagonal**2)
    if shape_covariance is not None:
        covariance[layout.shape, layout.shape] = shape_covariance
    return Belief(
        np.zeros(3) if position_m is None else position_m,
        np.zeros(3),
        np.eye(3) if rotation_w2_w0 is None else rotation_w2_w0,
        np.zeros(3),
        np.zeros(j) if joints_rad is None else joints_rad,
        np.zeros(j),
        np.zeros(layout.shape_count),
        covariance,
    )
