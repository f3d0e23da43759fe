"""Thumb and fingers in NumPy: every digit bends in a plane of its own azimuth, the thumb's rolled; a turn in a plane is
a complex factor. Poses hold slots and constants side by side."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.special import erfcx

from carpus.core.compiled.digits import BENT, FLOOR, OTHER
from carpus.core.model import so3
from carpus.core.model.hand.kinematics import DIP_PER_PIP
from carpus.core.model.types import FloatArray
from carpus.core.tracking.filter.digit_filter import (
    OBSERVED,
    DigitSigmaPoints,
    digit_sigma_weights,
)
from carpus.core.tracking.filter.hand_geometry import N_CONSTANTS, N_DIGITS, N_DISCS, N_SLOTS
from carpus.core.tracking.filter.mixture_filter import ModeMixture
from carpus.core.tracking.filter.unscented import UnscentedParameters

_DOWN = np.array([1.0, 1.0, -1.0])
_AXES = np.arange(3)
_DISC = np.arange(N_DISCS)
_PAST = np.tri(N_DISCS)[..., None]
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
_DIP_PER_PIP = 1.0 + DIP_PER_PIP
_FINGER_PHASES = np.array(
    [
        [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [0.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0],
        [0.0, 0.0, 1.0, _DIP_PER_PIP, 0.5, 1.0 + 0.5 * DIP_PER_PIP, _DIP_PER_PIP],
        [0.0, 0.0, 0.0, 1.0, 0.0, 0.5, 1.0],
        [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    ]
)
_ANGULAR = [*range(N_SLOTS), N_SLOTS + 3, N_SLOTS + 4]
"""Slots, fan and roll in joints and constants side by side."""


def _of_state(phases: FloatArray) -> FloatArray:
    spread = np.zeros((N_SLOTS + N_CONSTANTS, phases.shape[1]))
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
    :mod:`core.model.hand.kinematics` written for speed: every digit bends in a plane of its own azimuth, the thumb's
    rolled;
    a turn in a plane is a complex factor.
    """
    turn = np.exp(1j * (state @ (_TURNS if chains is None else _TURNS[chains])))
    thumbs = 1 if chains is None or chains[0] == 0 else 0
    level, up = np.zeros((*state.shape[:2], N_DISCS), dtype=np.complex128), np.empty((*state.shape[:2], N_DISCS))
    level.real[thumbs:], up[thumbs:] = _finger_arcs(state[thumbs:], turn[thumbs:])
    if thumbs:
        level.real[0], level.imag[0], up[0] = _thumb_arc(state[0], turn[0])
    level *= turn[..., :1]
    out = np.empty((*up.shape, 3))
    out[..., 0], out[..., 1], out[..., 2] = level.real, level.imag, up
    out += (root_m[:, None] + state[..., N_SLOTS + 5 : N_SLOTS + 8] * _DOWN)[..., None, :]
    return out


def _finger_arcs(state: FloatArray, turn: NDArray[np.complex128]) -> tuple[FloatArray, FloatArray]:
    """How far ahead and how high over the knuckle the discs (F, S, 3) of fingers are."""
    arc = np.cumsum(state[..., N_SLOTS : N_SLOTS + N_DISCS] * turn[..., 1:4], axis=-1)
    arc += (1j * state[..., N_SLOTS + 8 :]) * turn[..., 4:]
    return arc.real, arc.imag


def _thumb_arc(state: FloatArray, turn: NDArray[np.complex128]) -> tuple[FloatArray, FloatArray, FloatArray]:
    """How far ahead, aside and up from CMC1 the discs (S, 3) of the thumb are, for states (S, 16).

    In the axes of the metacarpal (its direction, dorsal normal, flexion axis), rolled, then raised.
    """
    mc, pp, dp = state[:, N_SLOTS], state[:, N_SLOTS + 1 : N_SLOTS + 2], state[:, N_SLOTS + 2]
    height = 1j * state[:, N_SLOTS + 8 :]
    # IP1 and TIP1: along the proximal phalanx, and along its normal.
    bent = np.empty((len(state), 2), dtype=np.complex128)
    bent[:, 0], bent[:, 1] = height[:, 1] * turn[:, 5], (dp + height[:, 2]) * turn[:, 4]
    bent += pp
    straight = bent.real * turn[:, 3:4]
    in_plane = (straight.real + 1j * bent.imag) * turn[:, 2:3]
    over = np.empty((len(state), N_DISCS), dtype=np.complex128)
    over[:, 0] = state[:, N_SLOTS + 8]
    over.real[:, 1:], over.imag[:, 1:] = in_plane.imag, straight.imag
    over *= turn[:, 6:]
    raised = np.empty(over.shape, dtype=np.complex128)
    raised.real = mc[:, None]
    raised.real[:, 1:] += in_plane.real
    raised.imag = over.real
    raised *= turn[:, 1:2]
    return raised.real, over.imag, raised.imag


@dataclass(frozen=True, slots=True)
class DigitFrames:
    """Unit ``direction`` of the three bones and ``normal`` of the three discs of each digit, both (5, 3, 3) in W."""

    direction: FloatArray
    normal: FloatArray


def digit_frames(state: FloatArray) -> DigitFrames:
    """Directions and normals for states (5, 16) of slots and constants."""
    both = np.empty((2, N_DIGITS, N_DISCS, 3))
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
    extension, abduction, flexion, aside, bend = state[0, :N_SLOTS].tolist()
    azimuth, roll = float(state[0, N_SLOTS + 3]) + extension, float(state[0, N_SLOTS + 4])
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
    joints = np.empty((N_DIGITS, N_DISCS + 1, 3))
    joints[:, 0] = root_m + state[:, N_SLOTS + 5 : N_SLOTS + 8] * _DOWN
    joints[:, 1:] = state[:, N_SLOTS : N_SLOTS + 3, None] * frames.direction
    return np.asarray(np.cumsum(joints, axis=1, out=joints))


def slope_by_constants(state: FloatArray, frames: DigitFrames, joints_m: FloatArray) -> FloatArray:
    """Derivative (5, 3 discs, 3, 11) of the discs in W by the constants, for states (5, 16)."""
    slope = np.zeros((N_DIGITS, N_DISCS, 3, N_CONSTANTS))
    slope[..., :N_DISCS] = np.swapaxes(frames.direction[:, None] * _PAST, 2, 3)
    slope[:, _DISC, :, 8 + _DISC] = np.swapaxes(frames.normal, 0, 1)
    slope[..., _AXES, 5 + _AXES] = _DOWN
    lever = joints_m[:, 1:] + state[:, N_SLOTS + 8 :, None] * frames.normal - joints_m[:, :1]
    slope[..., 0, 3] = -lever[..., 1]
    slope[..., 1, 3] = lever[..., 0]
    slope[0, :, :, 4] = lever[0] @ so3.skew(frames.direction[0, 0])
    return slope


def compute_digit_sigma_points(
    mean: FloatArray, covariance: FloatArray, root_disc_m: FloatArray, scaling: UnscentedParameters
) -> DigitSigmaPoints:
    """Sigma points of states (5, n) with covariances (5, n, n); ``root_disc_m`` (5, 3) discs under which they begin."""
    bent, other, scale = OBSERVED[BENT], OBSERVED[OTHER], digit_sigma_weights(scaling).scale
    root = np.linalg.cholesky(covariance[:, bent[:, None], bent] + FLOOR * np.eye(BENT.size))
    unroot = np.linalg.inv(root)
    along = unroot @ covariance[:, bent[:, None], other]
    step = np.empty((N_DIGITS, BENT.size, N_SLOTS + N_CONSTANTS))
    step[..., BENT], step[..., OTHER] = np.swapaxes(root, 1, 2) * scale, along * scale
    state = mean[:, OBSERVED]
    point = state[:, None] + np.concatenate((np.zeros_like(step[:, :1]), step, -step), axis=1)
    frames = digit_frames(state)
    by_constants = slope_by_constants(state, frames, digit_joints_m(root_disc_m, state, frames))[..., OTHER - N_SLOTS]
    return DigitSigmaPoints(
        digit_discs_m(root_disc_m, point), unroot, along, by_constants, frames.normal, mean, covariance
    )


def _softened(
    mean: FloatArray, variance: FloatArray, edge: FloatArray, soft_rad: float
) -> tuple[FloatArray, FloatArray]:
    """Mean and variance after multiplication by a soft step up at ``edge``."""
    total = variance + soft_rad**2
    z = (mean - edge) / np.sqrt(total)
    # phi(z) / Phi(z) without underflow: Phi(z) = exp(-z^2/2) erfcx(-z/sqrt 2) / 2.
    ratio = math.sqrt(2.0 / math.pi) / erfcx(np.maximum(-z, -20.0) * math.sqrt(0.5))
    return mean + variance * ratio / np.sqrt(total), variance - variance**2 * ratio * (z + ratio) / total


def apply_limits(
    mixture: ModeMixture, limits: FloatArray, direction: FloatArray, soft_rad: float, near_sd: float
) -> tuple[FloatArray, FloatArray] | None:
    """Means and covariances with the limits (5, 5, 2) of the angles heard; None where none is near."""
    angle = np.einsum("rks,rjs->rkj", mixture.mean[..., :N_SLOTS], direction)
    across = mixture.covariance[..., :N_SLOTS] @ np.swapaxes(direction, 1, 2)[:, None]  # (5, K, n, 5)
    shared = direction[:, None] @ across[..., :N_SLOTS, :]  # (5, K, 5, 5)
    variance = np.diagonal(shared, axis1=-2, axis2=-1)
    limits = limits[:, None]
    reach = near_sd * np.sqrt(variance + soft_rad**2)
    known = ((angle - reach < limits[..., 0]) | (angle + reach > limits[..., 1])) & (variance > 1e-9)
    if not known.any():
        return None
    lifted, narrowed = _softened(angle, variance, limits[..., 0], soft_rad)
    lowered, narrowed = _softened(-lifted, narrowed, -limits[..., 1], soft_rad)
    safe, narrowed = np.where(known, variance, 1.0), np.where(known, narrowed, 1.0)
    precision = np.where(known, np.maximum(1.0 / narrowed - 1.0 / safe, 0.0), 0.0)
    pull = np.where(known, -lowered / narrowed - angle / safe - precision * angle, 0.0)
    inner = np.eye(N_SLOTS) + precision[..., None] * shared
    gain = np.swapaxes(np.linalg.solve(np.swapaxes(inner, -1, -2), np.swapaxes(across, -1, -2)), -1, -2)
    return (
        mixture.mean + (gain @ pull[..., None])[..., 0],
        mixture.covariance - (gain * precision[..., None, :]) @ np.swapaxes(across, -1, -2),
    )
