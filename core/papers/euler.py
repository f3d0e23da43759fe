"""Rotations by the papers' Euler angles: R = Rz(psi) Ry(theta) Rx(phi), the order ZYX of the hand paper (section 2).

The wrist paper's own order, ZYZ, has no value at the neutral pose, where its filter starts: of alpha and gamma only
the sum is defined there. Both papers' filters are therefore run in the order of the second.
"""

from __future__ import annotations

import numpy as np

from carpus.core.hand import clinical_angles
from carpus.core.types import FloatArray


def rotation_of(euler_rad: FloatArray) -> FloatArray:
    """R (..., 3, 3) of psi, theta, phi (..., 3)."""
    return clinical_angles.rotation_from_angles(euler_rad, "right")


def euler_near(rotation: FloatArray, near_rad: FloatArray) -> FloatArray:
    """psi, theta, phi (..., 3) of rotations (..., 3, 3), whole turns chosen to lie nearest to ``near_rad`` (..., 3)."""
    raw = clinical_angles.angles_from_rotation(rotation, "right")
    return np.asarray(raw + 2.0 * np.pi * np.round((near_rad - raw) / (2.0 * np.pi)))


def body_turn_by_euler(euler_rad: FloatArray) -> FloatArray:
    """(3, 3): the turn d of R Exp(d), in W2, that a small change of psi, theta, phi (3,) makes."""
    _, theta, phi = euler_rad
    s, c = np.sin((theta, phi)), np.cos((theta, phi))
    return np.array([[-s[0], 0.0, 1.0], [c[0] * s[1], c[1], 0.0], [c[0] * c[1], -s[1], 0.0]])
