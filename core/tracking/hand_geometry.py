"""The five digits of an articulated hand as the filter sees them: thumb first, then fingers 2 to 5.

Every digit has five joint slots and eleven constants, so that all five are computed together. Slots of the thumb:
its five angles; of a finger: MCP abduction, MCP flexion, PIP flexion, and by how much DIP flexion exceeds two
thirds of PIP flexion (zero where the end joint is coupled, hand paper section 2); the fifth is not used.
Constants as in :mod:`core.hand.anatomy_prior`. Lengths in metres, axes of a right hand in W unless said otherwise.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from carpus.core import so3
from carpus.core.calibration.result import Calibration
from carpus.core.hand.kinematics import DIP_PER_PIP
from carpus.core.hand.protocols import DIGITS, PALM_MARKERS, MarkerProtocol, joint_discs
from carpus.core.types import FloatArray, Side

CHAINS, SLOTS, CONSTANTS = 5, 5, 11
DISCS = 3
"""Discs of a digit that move against the palm."""

# The first disc that moves with a slot: 0 the first of the digit's three; 3 none.
_FIRST_DISC = np.array([[0, 0, 1, 1, 2], *([0, 0, 1, 2, 3],) * 4])
SHOWS = np.arange(DISCS) >= _FIRST_DISC[..., None]
"""(5, 5, 3) whether a disc moves with a slot."""

NO_CUP = np.zeros(CHAINS)
"""No metacarpal has flexed."""
_DOWN = np.array([1.0, 1.0, -1.0])
_AXES = np.arange(3)
_DISC = np.arange(DISCS)
_PAST = np.tri(DISCS)[..., None]
"""(3, 3, 1) whether a disc (row) moves with a bone."""


# Rows: slots, fan and roll; columns: azimuth, then of a finger the pitches of its segments and of its discs'
# normals, of a thumb CMC abduction, MCP flexion, MCP abduction, IP flexion, half of it, roll.
_THUMB_PHASES = np.array(
    [
        [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0],
        [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0],
        [0.0, 0.0, 0.0, 0.0, 1.0, 0.5, 0.0],
        [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
    ]
)
_TO_DIP = 1.0 + DIP_PER_PIP
_FINGER_PHASES = np.array(
    [
        [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [0.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0],
        [0.0, 0.0, 1.0, _TO_DIP, 0.5, 1.0 + 0.5 * DIP_PER_PIP, _TO_DIP],
        [0.0, 0.0, 0.0, 1.0, 0.0, 0.5, 1.0],
        [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    ]
)
_ANGULAR = [*range(SLOTS), SLOTS + 3, SLOTS + 4]
"""Slots, fan and roll in joints and constants side by side."""


def _of_state(phases: FloatArray) -> FloatArray:
    spread = np.zeros((SLOTS + CONSTANTS, phases.shape[1]))
    spread[_ANGULAR] = phases
    return spread


_FINGER_PHASES = _of_state(_FINGER_PHASES)
# Flexion and abduction of the thumb turn downwards; azimuth, MCP abduction and roll do not.
_FINGER_TURNS = _FINGER_PHASES * np.array([1.0, -1.0, -1.0, -1.0, -1.0, -1.0, -1.0])
_TURNS = np.stack((_of_state(_THUMB_PHASES) * np.array([1.0, -1.0, -1.0, 1.0, -1.0, -1.0, 1.0]), *(_FINGER_TURNS,) * 4))


def digit_discs_m(root_m: FloatArray, state: FloatArray, chains: list[int] | None = None) -> FloatArray:
    """Discs (R, S, 3, 3) in W of all digits, or of some in their order, for S states (R, S, 16) of slots and constants
    side by side.

    ``root_m`` (R, 3) discs CMC1 and MCP2 to MCP5, under which the digits begin. The chains of
    :mod:`core.hand.kinematics` written for speed: every digit bends in a plane of its own azimuth, the thumb's rolled;
    a turn in a plane is a complex factor.
    """
    turn = np.exp(1j * (state @ (_TURNS if chains is None else _TURNS[chains])))
    thumbs = 1 if chains is None or chains[0] == 0 else 0
    level, up = np.zeros((*state.shape[:2], DISCS), dtype=np.complex128), np.empty((*state.shape[:2], DISCS))
    level.real[thumbs:], up[thumbs:] = _finger_arcs(state[thumbs:], turn[thumbs:])
    if thumbs:
        level.real[0], level.imag[0], up[0] = _thumb_arc(state[0], turn[0])
    level *= turn[..., :1]
    out = np.empty((*up.shape, 3))
    out[..., 0], out[..., 1], out[..., 2] = level.real, level.imag, up
    out += (root_m[:, None] + state[..., SLOTS + 5 : SLOTS + 8] * _DOWN)[..., None, :]
    return out


def _finger_arcs(state: FloatArray, turn: NDArray[np.complex128]) -> tuple[FloatArray, FloatArray]:
    """How far ahead and how high over the knuckle the discs (F, S, 3) of fingers are."""
    arc = np.cumsum(state[..., SLOTS : SLOTS + DISCS] * turn[..., 1:4], axis=-1)
    arc += (1j * state[..., SLOTS + 8 :]) * turn[..., 4:]
    return arc.real, arc.imag


def _thumb_arc(state: FloatArray, turn: NDArray[np.complex128]) -> tuple[FloatArray, FloatArray, FloatArray]:
    """How far ahead, aside and up from CMC1 the discs (S, 3) of the thumb are, for states (S, 16).

    In the axes of the metacarpal (its direction, dorsal normal, flexion axis), rolled, then raised.
    """
    mc, pp, dp = state[:, SLOTS], state[:, SLOTS + 1 : SLOTS + 2], state[:, SLOTS + 2]
    height = 1j * state[:, SLOTS + 8 :]
    # IP1 and TIP1: along the proximal phalanx, and along its normal.
    bent = np.empty((len(state), 2), dtype=np.complex128)
    bent[:, 0], bent[:, 1] = height[:, 1] * turn[:, 5], (dp + height[:, 2]) * turn[:, 4]
    bent += pp
    straight = bent.real * turn[:, 3:4]
    in_plane = (straight.real + 1j * bent.imag) * turn[:, 2:3]
    over = np.empty((len(state), DISCS), dtype=np.complex128)
    over[:, 0] = state[:, SLOTS + 8]
    over.real[:, 1:], over.imag[:, 1:] = in_plane.imag, straight.imag
    over *= turn[:, 6:]
    raised = np.empty(over.shape, dtype=np.complex128)
    raised.real = mc[:, None]
    raised.real[:, 1:] += in_plane.real
    raised.imag = over.real
    raised *= turn[:, 1:2]
    return raised.real, over.imag, raised.imag


CROWDED_RADII, CROWDED_PX = 2.4, 0.5
"""Centres of discs nearer than so many radii stray by so much: their edges run together."""


def is_crowded(pixel: FloatArray, radius_px: FloatArray, radii: float) -> NDArray[np.bool_]:
    """Which discs of each digit (5, 3) nearly touch the one before or after, from their middles (5, 3, 2) and the
    radius (5, 3) of a large disc there: nearer than so many ``radii``, their edges blur into one."""
    near = ((pixel[:, 1:] - pixel[:, :-1]) ** 2).sum(axis=-1) < (radii * radius_px[:, 1:]) ** 2
    out = np.zeros(radius_px.shape, dtype=bool)
    out[:, 1:], out[:, :-1] = near, near
    out[:, 1] |= near[:, 0]
    return out


@dataclass(frozen=True, slots=True)
class DigitFrames:
    """Unit ``direction`` of the three bones and ``normal`` of the three discs of each digit, both (5, 3, 3) in W."""

    direction: FloatArray
    normal: FloatArray


def digit_frames(state: FloatArray) -> DigitFrames:
    """Directions and normals for states (5, 16) of slots and constants."""
    both = np.empty((2, CHAINS, DISCS, 3))
    phase = state[1:] @ _FINGER_PHASES
    sin, cos = np.sin(phase), np.cos(phase)
    azimuth_cos, azimuth_sin = cos[:, :1], sin[:, :1]
    both[0, 1:, :, 0] = cos[:, 1:4] * azimuth_cos
    both[0, 1:, :, 1] = cos[:, 1:4] * azimuth_sin
    both[0, 1:, :, 2] = -sin[:, 1:4]
    both[1, 1:, :, 0] = sin[:, 4:] * azimuth_cos
    both[1, 1:, :, 1] = sin[:, 4:] * azimuth_sin
    both[1, 1:, :, 2] = cos[:, 4:]
    # One thumb: plain numbers are quicker than arrays of one.
    extension, abduction, flexion, aside, bend = state[0, :SLOTS].tolist()
    azimuth, roll = float(state[0, SLOTS + 3]) + extension, float(state[0, SLOTS + 4])
    c0, s0, c1, s1 = math.cos(azimuth), math.sin(azimuth), math.cos(abduction), math.sin(abduction)
    c2, s2, c3, s3 = math.cos(flexion), math.sin(flexion), math.cos(aside), math.sin(aside)
    cr, sr = math.cos(roll), math.sin(roll)

    def placed(x: float, y: float, z: float) -> tuple[float, float, float]:
        over, across = cr * y - sr * z, sr * y + cr * z
        ahead = x * c1 + over * s1
        return ahead * c0 - across * s0, ahead * s0 + across * c0, over * c1 - x * s1

    phalanx, lifted = (c3 * c2, -c3 * s2, s3), (s2, c2, 0.0)

    def in_phalanx(along: float, up: float) -> tuple[float, float, float]:
        return placed(*(along * a + up * b for a, b in zip(phalanx, lifted, strict=True)))

    cb, sb = math.cos(bend), math.sin(bend)
    both[:, 0] = (
        (placed(1.0, 0.0, 0.0), placed(*phalanx), in_phalanx(cb, -sb)),
        (placed(0.0, 1.0, 0.0), in_phalanx(math.sin(0.5 * bend), math.cos(0.5 * bend)), in_phalanx(sb, cb)),
    )
    return DigitFrames(both[0], both[1])


def digit_joints_m(root_m: FloatArray, state: FloatArray, frames: DigitFrames) -> FloatArray:
    """Joint centres (5, 4, 3) of each digit in W, from its root's to the tip, for states (5, 16)."""
    joints = np.empty((CHAINS, DISCS + 1, 3))
    joints[:, 0] = root_m + state[:, SLOTS + 5 : SLOTS + 8] * _DOWN
    joints[:, 1:] = state[:, SLOTS : SLOTS + 3, None] * frames.direction
    return np.asarray(np.cumsum(joints, axis=1, out=joints))


def slope_by_constants(state: FloatArray, frames: DigitFrames, joints_m: FloatArray) -> FloatArray:
    """Derivative (5, 3 discs, 3, 11) of the discs in W by the constants, for states (5, 16)."""
    slope = np.zeros((CHAINS, DISCS, 3, CONSTANTS))
    slope[..., :DISCS] = np.swapaxes(frames.direction[:, None] * _PAST, 2, 3)
    slope[:, _DISC, :, 8 + _DISC] = np.swapaxes(frames.normal, 0, 1)
    slope[..., _AXES, 5 + _AXES] = _DOWN
    lever = joints_m[:, 1:] + state[:, SLOTS + 8 :, None] * frames.normal - joints_m[:, :1]
    slope[..., 0, 3] = -lever[..., 1]
    slope[..., 1, 3] = lever[..., 0]
    slope[0, :, :, 4] = lever[0] @ so3.skew(frames.direction[0, 0])
    return slope


@dataclass(frozen=True, slots=True)
class PalmInBody:
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
    def of(
        palm_body_m: FloatArray,
        axes: FloatArray,
        side: Side,
        cup_rad: FloatArray = NO_CUP,
        cup_sd_rad: FloatArray = NO_CUP,
    ) -> PalmInBody:
        """From the palm's discs (6, 3) and the axes (3, 3) of W as columns, both in the body."""
        if side == "left":
            axes = axes * np.array([1.0, -1.0, 1.0])
        return PalmInBody(axes, palm_body_m[0], (palm_body_m - palm_body_m[0]) @ axes, cup_rad, cup_sd_rad)


@dataclass(frozen=True, slots=True)
class JointMoment:
    """Joint angles (J,), standard deviations and rates (NaN in the papers' model); joint centres and tips (M, 3) in
    W2 of the hand's own side; the digits' discs (5, 3, 3) in camera axes."""

    angles_rad: FloatArray
    sd_rad: FloatArray
    rate_rad_s: FloatArray
    joint_w2_m: FloatArray
    disc_cam_m: FloatArray


@dataclass(frozen=True, slots=True)
class JointReading:
    """From the digits' slots to the joint angles of some digits: angle j is ``weight[j] @ slots[chain[j]]``."""

    chain: np.ndarray
    weight: FloatArray

    @staticmethod
    def of(dip_free: bool, digits: Sequence[int] = DIGITS) -> JointReading:
        rows = [(0, np.eye(SLOTS)[slot]) for slot in range(5) if 1 in digits]
        for chain in (digit - 1 for digit in DIGITS[1:] if digit in digits):
            rows += [(chain, np.eye(SLOTS)[slot]) for slot in range(3)]
            if dip_free:
                rows.append((chain, np.array([0.0, 0.0, DIP_PER_PIP, 1.0, 0.0])))
        return JointReading(np.array([chain for chain, _ in rows]), np.array([weight for _, weight in rows]))

    def angles(self, slots: FloatArray) -> FloatArray:
        """Joint angles (..., J) of slots (..., 5, 5)."""
        return np.asarray(np.sum(slots[..., self.chain, :] * self.weight, axis=-1))

    def variances(self, covariance: FloatArray) -> FloatArray:
        """Variances (J,) from covariances (5, 5, 5) of the slots."""
        return np.asarray(np.einsum("ji,jik,jk->j", self.weight, covariance[self.chain], self.weight))


def direct_markers(protocol: MarkerProtocol, dip_free: bool) -> np.ndarray:
    """Rows (J, 2) of the discs at each joint and next past it, which measure it directly."""
    return np.array([protocol.rows(joint_discs(name)) for name in protocol.joint_names(dip_free)])


_PALM = MarkerProtocol("palm", PALM_MARKERS)


def palm_of(calibration: Calibration) -> Calibration:
    """The calibration of the discs that move with the palm, whatever else is on the hand."""
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
