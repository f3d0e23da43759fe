"""Geometry of an articulated hand: the palm, and five digits, thumb first, then fingers 2 to 5.

Every digit has five joint slots and eleven constants, so that all five are computed together. Slots of the thumb: its
five angles; of a finger: MCP abduction, MCP flexion, PIP flexion, and by how much DIP flexion exceeds two thirds of PIP
flexion (zero where the DIP joint is coupled, hand paper section 2); the fifth is not used. Constants as in
:mod:`core.model.hand.anatomy_prior`. Lengths in metres, axes of a right hand in W unless said otherwise.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from carpus.core.calibration.result import Calibration
from carpus.core.model.hand.kinematics import DIP_PER_PIP
from carpus.core.model.hand.protocols import DIGITS, PALM_MARKERS, MarkerProtocol
from carpus.core.model.types import FloatArray, Side

N_DIGITS, N_SLOTS, N_CONSTANTS = 5, 5, 11
N_DISCS = 3  # of a digit that move against the palm
FLEXION_SLOT = 1  # of a finger's MCP flexion

# The first disc that moves with a slot: 0 the first of the digit's three; 3 none.
_FIRST_DISC = np.array([[0, 0, 1, 1, 2], *([0, 0, 1, 2, 3],) * 4])
SLOT_MOVES_DISC = np.arange(N_DISCS) >= _FIRST_DISC[..., None]  # (5, 5, 3)

ZERO_CUP = np.zeros(N_DIGITS)  # no metacarpal has flexed
# Centres of discs nearer than so many radii stray by so much: their edges run together.
CROWDED_RADII, CROWDED_PX = 2.4, 0.5


def is_crowded(pixel: FloatArray, radius_px: FloatArray) -> NDArray[np.bool_]:
    """Return which discs of each digit (5, 3) nearly touch the one before or after.

    ``pixel`` (5, 3, 2) of their centres, ``radius_px`` (5, 3) of a large disc there.
    """
    near = ((pixel[:, 1:] - pixel[:, :-1]) ** 2).sum(axis=-1) < (CROWDED_RADII * radius_px[:, 1:]) ** 2
    out = np.zeros(radius_px.shape, dtype=bool)
    out[:, 1:], out[:, :-1] = near, near
    out[:, 1] |= near[:, 0]
    return out


@dataclass(frozen=True, slots=True)
class PalmGeometry:
    """The palm as refined so far, in the axes of the tracked body (W0 as calibrated).

    ``axes`` (3, 3) maps W of a right hand into the body: for a left hand it mirrors; ``origin_m`` (3,) the WRIST disc
    in the body; ``disc_m`` (6, 3) the palm's discs in W of a right hand, those of ring and little finger as their
    metacarpals carry them. ``cup_rad`` (5,) by how much each digit's metacarpal has flexed, ``cup_sd_rad`` (5,).
    """

    axes: FloatArray
    origin_m: FloatArray
    disc_m: FloatArray
    cup_rad: FloatArray
    cup_sd_rad: FloatArray

    @staticmethod
    def from_discs(
        palm_body_m: FloatArray,
        axes: FloatArray,
        side: Side,
        cup_rad: FloatArray = ZERO_CUP,
        cup_sd_rad: FloatArray = ZERO_CUP,
    ) -> PalmGeometry:
        """Return the geometry of palm discs (6, 3) and the axes (3, 3) of W as columns, both in the body."""
        if side == "left":
            axes = axes * np.array([1.0, -1.0, 1.0])
        return PalmGeometry(axes, palm_body_m[0], (palm_body_m - palm_body_m[0]) @ axes, cup_rad, cup_sd_rad)


@dataclass(frozen=True, slots=True)
class JointState:
    """Joint angles (J,), standard deviations and rates (NaN in the papers' model).

    Joint centres and tips (M, 3) in W2 of the hand's own side; the digits' discs (5, 3, 3) in camera axes.
    """

    angles_rad: FloatArray
    sd_rad: FloatArray
    rate_rad_s: FloatArray
    joint_w2_m: FloatArray
    disc_cam_m: FloatArray


@dataclass(frozen=True, slots=True)
class JointAngleMap:
    """Map from slots to the joint angles of some digits: ``weight[j] @ slots[chain[j]]``."""

    chain: np.ndarray
    weight: FloatArray

    @staticmethod
    def from_digits(dip_free: bool, digits: Sequence[int] = DIGITS) -> JointAngleMap:
        rows = [(0, np.eye(N_SLOTS)[slot]) for slot in range(5) if 1 in digits]
        for chain in (digit - 1 for digit in DIGITS[1:] if digit in digits):
            rows += [(chain, np.eye(N_SLOTS)[slot]) for slot in range(3)]
            if dip_free:
                rows.append((chain, np.array([0.0, 0.0, DIP_PER_PIP, 1.0, 0.0])))
        return JointAngleMap(np.array([chain for chain, _ in rows]), np.array([weight for _, weight in rows]))

    def compute_angles(self, slots: FloatArray) -> FloatArray:
        """Return joint angles (..., J) of slots (..., 5, 5)."""
        return np.asarray(np.vecdot(slots[..., self.chain, :], self.weight))

    def compute_variances(self, covariance: FloatArray) -> FloatArray:
        """Return variances (J,) from covariances (5, 5, 5) of the slots."""
        return np.asarray(np.vecdot((self.weight[:, None] @ covariance[self.chain])[:, 0], self.weight))


_PALM = MarkerProtocol("palm", PALM_MARKERS)


def palm_calibration(calibration: Calibration) -> Calibration:
    """Return the calibration of the discs that move with the palm, whatever else is on the hand."""
    clicks = calibration.clicks
    if not clicks.protocol.has_fingers:
        return calibration
    rows = np.array(clicks.protocol.palm)
    return replace(
        calibration,
        clicks=replace(clicks, protocol=_PALM, pixel=clicks.pixel[rows]),
        marker_position_w0_m=calibration.marker_position_w0_m[rows],
        marker_covariance_w0_m2=calibration.marker_covariance_w0_m2[rows],
    )
