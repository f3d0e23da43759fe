"""Joint limits as soft constraints: pseudo-measurements that pull, not walls that clip.

Clinical reference 4.1. An angle's Gaussian is multiplied by the probability that the joint can be there, a step of 3
degrees' standard deviation at either limit, and replaced by the Gaussian of the same mean and variance. Far inside
nothing happens; beyond a limit it acts as a measurement of the limit with that standard deviation; an angle of which
nothing is known ends up spread over its range.
"""

from __future__ import annotations

import math

import numpy as np

from carpus.core.compiled.digits import apply_limits
from carpus.core.model.hand.anatomy import ABDUCTION_LIMIT_RAD, HARD_LIMITS_RAD
from carpus.core.model.hand.kinematics import DIP_PER_PIP
from carpus.core.model.types import FloatArray
from carpus.core.tracking.filter.hand_geometry import N_DIGITS, N_SLOTS
from carpus.core.tracking.filter.mixture_filter import ModeMixture

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
    found = apply_limits(estimates, slot_limits_rad(slots), _DIRECTION, LIMIT_SD_RAD, LIMIT_GATE_SD)
    return estimates if found is None else ModeMixture(*found, estimates.probability)
