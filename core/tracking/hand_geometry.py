"""The five rays of an articulated hand as the filter sees them: thumb first, then fingers 2 to 5.

Every ray has five joint slots and eleven constants, so that all five are computed together. Slots of the thumb:
its five angles; of a finger: MCP abduction, MCP flexion, PIP flexion, and by how much DIP flexion exceeds two
thirds of PIP flexion (zero where the end joint is coupled, hand paper section 2); the fifth is not used.
Constants as in :mod:`core.hand.ray_fitting`. Lengths in metres, axes of a right hand in W unless said otherwise.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core.hand.anatomy import HandAnatomy
from core.hand.kinematics import DIP_PER_PIP, finger_discs, thumb_discs
from core.hand.protocols import HAND21
from core.hand.wrist_frame import wrist_axes
from core.types import FloatArray, Side

RAYS, SLOTS, CONSTANTS = 5, 5, 11
DISCS = 3
"""Discs of a ray that move against the palm."""

RAY_MARKERS = np.array([[HAND21.markers.index(name) for name in ray] for ray in (
    ("MCP1", "IP1", "TIP1"), *((f"PIP{k}", f"DIP{k}", f"TIP{k}") for k in (2, 3, 4, 5))
)])  # fmt: skip
"""Places (5, 3) of the rays' discs in ``hand21``."""

_DOWN = np.array([1.0, 1.0, -1.0])
_DORSAL = np.array([0.0, 0.0, 1.0])


def ray_discs_m(root_m: FloatArray, joints_rad: FloatArray, constants: FloatArray) -> FloatArray:
    """Discs (5, ..., 3, 3) of all rays in W for joints (5, ..., 5) and constants (5, ..., 11).

    ``root_m`` (5, 3) discs CMC1 and MCP2 to MCP5, under which the rays begin.
    """
    lead = joints_rad.shape[1:-1]
    root = root_m.reshape(RAYS, *(1,) * len(lead), 3) + constants[..., 5:8] * _DOWN
    out = np.empty((RAYS, *lead, DISCS, 3))
    thumb = constants[0]
    out[0] = thumb_discs(root[0], thumb[..., 3], thumb[..., 4], thumb[..., :3], thumb[..., 8:], joints_rad[0])
    finger = constants[1:]
    angles = joints_rad[1:, ..., :4].copy()
    angles[..., 3] += DIP_PER_PIP * angles[..., 2]
    out[1:] = finger_discs(root[1:], finger[..., 3], finger[..., :3], finger[..., 8:], angles)
    return out


def ray_facing(joints_rad: FloatArray, constants: FloatArray) -> FloatArray:
    """Unit normals (5, 3, 3) of the rays' discs in W for joints (5, 5) and constants (5, 11)."""
    lifted = constants.copy()
    lifted[:, 8:] = 1.0
    bare = constants.copy()
    bare[:, 8:] = 0.0
    nowhere = np.zeros((RAYS, 3))
    return ray_discs_m(nowhere, joints_rad, lifted) - ray_discs_m(nowhere, joints_rad, bare)


@dataclass(frozen=True, slots=True)
class PalmInBody:
    """The palm as refined so far, in the axes of the tracked body (W0 as calibrated).

    ``axes`` (3, 3) maps W of a right hand into the body: for a left hand it mirrors; ``origin_m`` (3,) the WRIST disc
    in the body; ``disc_m`` (6, 3) the palm's discs in W of a right hand.
    """

    axes: FloatArray
    origin_m: FloatArray
    disc_m: FloatArray

    @staticmethod
    def of(palm_body_m: FloatArray, side: Side) -> PalmInBody:
        """From the palm's discs (6, 3) in the body."""
        axes = wrist_axes(palm_body_m, _DORSAL)
        if side == "left":
            axes = axes * np.array([1.0, -1.0, 1.0])
        return PalmInBody(axes, palm_body_m[0], (palm_body_m - palm_body_m[0]) @ axes)


@dataclass(frozen=True, slots=True)
class JointReading:
    """From the rays' slots to the 17 (21) joint angles: angle j is ``weight[j] @ slots[ray[j]]``."""

    ray: np.ndarray
    weight: FloatArray

    @staticmethod
    def of(dip_free: bool) -> JointReading:
        rows = [(0, np.eye(SLOTS)[slot]) for slot in range(5)]
        for ray in range(1, RAYS):
            rows += [(ray, np.eye(SLOTS)[slot]) for slot in range(3)]
            if dip_free:
                rows.append((ray, np.array([0.0, 0.0, DIP_PER_PIP, 1.0, 0.0])))
        return JointReading(np.array([ray for ray, _ in rows]), np.array([weight for _, weight in rows]))

    def angles(self, slots: FloatArray) -> FloatArray:
        """Joint angles (..., J) of slots (..., 5, 5)."""
        return np.asarray(np.sum(slots[..., self.ray, :] * self.weight, axis=-1))

    def variances(self, covariance: FloatArray) -> FloatArray:
        """Variances (J,) from covariances (5, 5, 5) of the slots."""
        return np.asarray(np.einsum("ji,jik,jk->j", self.weight, covariance[self.ray], self.weight))


def slots_of(angles_rad: FloatArray) -> FloatArray:
    """Slots (..., 5, 5) of 17 or 21 joint angles (..., J)."""
    lead, per_finger = angles_rad.shape[:-1], (angles_rad.shape[-1] - 5) // 4
    slots = np.zeros((*lead, RAYS, SLOTS))
    slots[..., 0, :] = angles_rad[..., :5]
    slots[..., 1:, :per_finger] = angles_rad[..., 5:].reshape(*lead, 4, per_finger)
    if per_finger == 4:
        slots[..., 1:, 3] -= DIP_PER_PIP * slots[..., 1:, 2]
    return slots


def anatomy_at(hand: HandAnatomy, palm: PalmInBody, constants: FloatArray) -> HandAnatomy:
    """The hand with the palm and the constants (5, 11) as refined so far."""
    from dataclasses import replace

    from core.hand.anatomy_prior import with_constants

    return with_constants(replace(hand, palm_disc_m=palm.disc_m), constants)
