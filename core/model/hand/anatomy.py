"""One subject's hand: lengths, fan directions, skin offsets, joint limits.

Clinical reference 2, 3.3 and 4.1. Everything is written for a RIGHT hand in the wrist frame W (origin WRIST marker, X
to the MCP3 marker, Z out of the back of the hand, Y radial); a left hand is the mirror image diag(1, -1, 1), so angles
keep their clinical sign.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from carpus.core.model.hand.clinical_angles import wrist_axes
from carpus.core.model.hand.protocols import PALM_SITES, SITES
from carpus.core.model.types import FloatArray, Side

BREADTH_SHARE = 0.45  # hand breadth over hand length where only the length is known (reference 3.3)

REFERENCE_LENGTH_M = 0.180  # hand length for which the offsets and the arch of the reference are given

# Buchholz 1992 (reference 3.3): shares of hand length, the lateral place a share of hand breadth.
_PALM_X_SHARE = np.array([0.0, 0.073, 0.447, 0.446, 0.409, 0.368])  # WRIST CMC1 MCP2 MCP3 MCP4 MCP5
_PALM_Y_SHARE = np.array([0.0, 0.196, 0.251, 0.0, -0.206, -0.402])
_THUMB_SHARE = np.array([0.251, 0.196, 0.158])  # MC1 PP1 DP1
_FINGER_SHARE = np.array([[0.245, 0.143, 0.097], [0.266, 0.170, 0.108], [0.244, 0.165, 0.107], [0.204, 0.117, 0.093]])
_NAIL_SHARE_THUMB, _NAIL_SHARE_FINGER = 0.8, 0.7

# Reference 2 and 3.2, for a hand 180 mm long.
_ARCH_M = np.array([0.0, -0.010, 0.0, 0.0, -0.002, -0.006])  # palm discs over the plane WRIST MCP2 MCP3
_PALM_OFFSET_M = np.array([0.015, 0.010, 0.011, 0.011, 0.011, 0.011])
_THUMB_OFFSET_M = np.array([0.009, 0.007, 0.005])  # MCP1 IP1 TIP1
_FINGER_OFFSET_M = np.array([0.0075, 0.0055, 0.005])  # PIP DIP TIP
_FAN_RAD = np.radians([30.0, 5.0, 0.0, -5.0, -10.0])
_THUMB_ROLL_RAD = math.radians(60.0)

# Of an extended finger to either side; shrinks with the cosine of MCP flexion (reference 3.2).
ABDUCTION_LIMIT_RAD = math.radians(30.0)

# Limits of the model by joint angle, generous so that hypermobility is not cut (reference 4.1).
HARD_LIMITS_RAD: dict[str, tuple[float, float]] = {
    name: (math.radians(low), math.radians(high))
    for name, low, high in (
        ("CMC1_extension", -30.0, 45.0),
        ("CMC1_abduction", -15.0, 70.0),
        ("MCP1_flexion", -25.0, 90.0),
        ("MCP1_abduction", -15.0, 25.0),
        ("IP1_flexion", -35.0, 100.0),
        *((f"MCP{k}_abduction", -30.0, 30.0) for k in (2, 3, 4, 5)),
        *((f"MCP{k}_flexion", -45.0, 110.0) for k in (2, 3, 4, 5)),
        *((f"PIP{k}_flexion", -15.0, 125.0) for k in (2, 3, 4, 5)),
        *((f"DIP{k}_flexion", -15.0, 100.0) for k in (2, 3, 4, 5)),
    )
}


@dataclass(frozen=True, slots=True)
class HandAnatomy:
    """The constants of one hand, metres and radians, canonical right hand in W.

    ``palm_disc_m`` (6, 3) discs of WRIST CMC1 MCP2 MCP3 MCP4 MCP5, WRIST at the origin; ``palm_joint_m`` (6, 3)
    joint centres under them, which move with the palm as the discs do; ``fan_rad`` (5,) direction in the palm
    plane of the thumb's metacarpal (rho1) and of fingers 2 to 5 at abduction zero; ``thumb_roll_rad`` tau;
    ``thumb_length_m`` (3,) MC1 PP1 DP1; ``finger_length_m`` (4, 3) PP MP DP of fingers 2 to 5, the last one up to
    the TIP marker; ``thumb_offset_m`` (3,) height of the discs MCP1 IP1 TIP1 over the joint centres, and
    ``finger_offset_m`` (4, 3) of PIP DIP TIP, along the dorsal normal. All offsets zero and ``palm_joint_m`` equal
    to ``palm_disc_m``: the chain of the papers.
    """

    hand_length_m: float
    hand_breadth_m: float
    palm_disc_m: FloatArray
    palm_joint_m: FloatArray
    fan_rad: FloatArray
    thumb_roll_rad: float
    thumb_length_m: FloatArray
    finger_length_m: FloatArray
    thumb_offset_m: FloatArray
    finger_offset_m: FloatArray
    side: Side = "right"

    def __post_init__(self) -> None:
        shapes = {
            "palm_disc_m": (6, 3), "palm_joint_m": (6, 3), "fan_rad": (5,), "thumb_length_m": (3,),
            "finger_length_m": (4, 3), "thumb_offset_m": (3,), "finger_offset_m": (4, 3),
        }  # fmt: skip
        for name, shape in shapes.items():
            value = np.array(getattr(self, name), dtype=np.float64)
            if value.shape != shape:
                raise ValueError(f"{name}: shape {value.shape}, expected {shape}")
            value.flags.writeable = False
            object.__setattr__(self, name, value)

    @property
    def skin_offset_m(self) -> FloatArray:
        """Height of each disc over its joint centre, (21,) in the order of ``hand21``."""
        offset = np.empty(len(SITES))
        offset[list(PALM_SITES)] = self.palm_disc_m[:, 2] - self.palm_joint_m[:, 2]
        offset[2:5] = self.thumb_offset_m
        offset[5:].reshape(4, 4)[:, 1:] = self.finger_offset_m
        return offset


def anatomy_from_size(
    hand_length_m: float,
    hand_breadth_m: float | None = None,
    *,
    side: Side = "right",
    arch: float = 1.0,
    skin_offsets: bool = True,
    nail_discs: bool = False,
) -> HandAnatomy:
    """Return the average hand of that size (Buchholz 1992, reference 3.3).

    ``arch`` scales the typical height of the palm's arch (0: all palm discs in one plane). ``skin_offsets=False`` is
    the papers' chain, discs in the joints. The last segment ends at the finger tip, as in the worked example of the
    reference (3.4); with ``nail_discs`` it ends under a disc on the nail, 0.7 of DP (thumb 0.8, reference 2).

    >>> anatomy_from_size(0.180, 0.080, arch=0.0, skin_offsets=False).palm_disc_m[2].round(4)
    array([0.0805, 0.0201, 0.    ])
    """
    breadth_m = BREADTH_SHARE * hand_length_m if hand_breadth_m is None else hand_breadth_m
    size = hand_length_m / REFERENCE_LENGTH_M
    discs = np.column_stack((_PALM_X_SHARE * hand_length_m, _PALM_Y_SHARE * breadth_m, arch * size * _ARCH_M))
    discs = discs @ palm_axes(discs, side="right")
    offset_size = size if skin_offsets else 0.0
    joints = discs - np.outer(offset_size * _PALM_OFFSET_M, [0.0, 0.0, 1.0])
    thumb, finger = _THUMB_SHARE * hand_length_m, _FINGER_SHARE * hand_length_m
    if nail_discs:
        thumb = thumb * [1.0, 1.0, _NAIL_SHARE_THUMB]
        finger = finger * [1.0, 1.0, _NAIL_SHARE_FINGER]
    return HandAnatomy(
        hand_length_m=hand_length_m,
        hand_breadth_m=breadth_m,
        palm_disc_m=discs,
        palm_joint_m=joints,
        fan_rad=_FAN_RAD,
        thumb_roll_rad=_THUMB_ROLL_RAD,
        thumb_length_m=thumb,
        finger_length_m=finger,
        thumb_offset_m=offset_size * _THUMB_OFFSET_M,
        finger_offset_m=offset_size * np.tile(_FINGER_OFFSET_M, (4, 1)),
        side=side,
    )


def palm_axes(palm_disc_m: FloatArray, side: Side) -> FloatArray:
    """Return the axes of W as columns (3, 3) for palm discs (6, 3) in any frame."""
    wrist, _, mcp2, mcp3, _, mcp5 = palm_disc_m
    dorsal = np.cross(mcp3 - wrist, mcp2 - mcp5)
    return wrist_axes(palm_disc_m, dorsal_direction=dorsal if side == "right" else -dorsal)
