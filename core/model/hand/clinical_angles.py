"""The wrist frame W of the palm's discs, and its rotation as clinical angles.

Clinical reference 1.1 to 1.4. ``sign`` is +1 for a right hand and -1 for a left one. All angles in radians.
"""

from __future__ import annotations

import math

import numpy as np

from carpus.core.model.types import FloatArray, Side

WRIST, CMC1, MCP2, MCP3, MCP4, MCP5 = range(6)
_PLANE = [WRIST, MCP2, MCP3, MCP4, MCP5]


def wrist_axes(palm_m: FloatArray, dorsal_direction: FloatArray) -> FloatArray:
    """Return the axes of W as columns (..., 3, 3), in the frame of the given discs.

    X from WRIST to MCP3; Z the normal of the least-squares plane through WRIST and MCP2..MCP5, made perpendicular to X;
    Y = Z x X.

    Parameters
    ----------
    palm_m : (..., 6, 3)
        Palm discs.
    dorsal_direction : (3,)
        Z is turned to this side.
    """
    x = palm_m[..., MCP3, :] - palm_m[..., WRIST, :]
    x = x / np.linalg.norm(x, axis=-1, keepdims=True)
    plane = palm_m[..., _PLANE, :]
    centred = plane - plane.mean(axis=-2, keepdims=True)
    _, vectors = np.linalg.eigh(np.swapaxes(centred, -1, -2) @ centred)
    normal = vectors[..., :, 0]
    side = np.where(normal @ dorsal_direction < 0.0, -1.0, 1.0)
    normal = normal * side[..., None]
    z = normal - np.sum(normal * x, axis=-1, keepdims=True) * x
    z = z / np.linalg.norm(z, axis=-1, keepdims=True)
    return np.stack((x, np.cross(z, x), z), axis=-1)


def wrist_axes_sensitivity(palm_m: FloatArray, dorsal_direction: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the axes (3, 3) and their turn per metre of each disc coordinate (3, 18), in W."""
    step_m = 1e-5
    moved = np.broadcast_to(palm_m, (19, 6, 3)).reshape(19, 18).copy()
    moved[np.arange(1, 19), np.arange(18)] += step_m
    axes = wrist_axes(moved.reshape(19, 6, 3), dorsal_direction)
    turned = axes[0].T @ axes[1:]
    vee = 0.5 * np.stack(
        (turned[:, 2, 1] - turned[:, 1, 2], turned[:, 0, 2] - turned[:, 2, 0], turned[:, 1, 0] - turned[:, 0, 1])
    )
    return axes[0], vee / step_m


ZYZ_MIN_BETA_RAD = math.radians(3.0)  # below this beta only alpha + gamma is defined (reference 1.4)
ZYZ_MAX_SD_RAD = math.radians(30.0)  # an alpha or gamma known worse than this is not given


def side_sign(side: Side) -> float:
    """Return +1 for the right hand, -1 for the left."""
    return 1.0 if side == "right" else -1.0


def angles_from_rotation(rotation_w2_w0: FloatArray, side: Side) -> FloatArray:
    """Return deviation (+ radial), flexion (+), pro/supination (+ supination), (..., 3).

    ZYX Euler angles psi, theta, phi of R = Rz(psi) Ry(theta) Rx(phi) with clinical signs.

    >>> angles_from_rotation(np.eye(3), "right")
    array([0., 0., 0.])
    """
    r = rotation_w2_w0
    s = side_sign(side)
    psi = np.arctan2(r[..., 1, 0], r[..., 0, 0])
    theta = np.arcsin(np.clip(-r[..., 2, 0], -1.0, 1.0))
    phi = np.arctan2(r[..., 2, 1], r[..., 2, 2])
    return np.stack((s * psi, theta + 0.0, s * phi), axis=-1)


def rotation_from_angles(angles_rad: FloatArray, side: Side) -> FloatArray:
    """Return R (..., 3, 3) of angles (..., 3); inverse of :func:`angles_from_rotation`."""
    s = side_sign(side)
    psi, theta, phi = s * angles_rad[..., 0], angles_rad[..., 1], s * angles_rad[..., 2]
    cz, sz, cy, sy, cx, sx = np.cos(psi), np.sin(psi), np.cos(theta), np.sin(theta), np.cos(phi), np.sin(phi)
    rows = (
        np.stack((cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx), axis=-1),
        np.stack((sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx), axis=-1),
        np.stack((-sy, cy * sx, cy * cx), axis=-1),
    )
    return np.stack(rows, axis=-2)


def angle_rates_matrix(rotation_w2_w0: FloatArray, side: Side) -> FloatArray:
    """Return the derivative (..., 3, 3) of the clinical angles for a small turn d in W2, R Exp(d).

    Grows without bound as flexion nears 90 degrees (noise gain 1/cos theta, reference 1.2).
    """
    angles = angles_from_rotation(rotation_w2_w0, "right")
    theta, phi = angles[..., 1], angles[..., 2]
    s = side_sign(side)
    sx, cx = np.sin(phi), np.cos(phi)
    c = np.cos(theta)
    c = np.where(np.abs(c) < 1e-6, 1e-6, c)
    t = s * np.sin(theta) / c
    out = np.zeros((*rotation_w2_w0.shape[:-2], 3, 3))
    out[..., 0, 1] = s * sx / c
    out[..., 0, 2] = s * cx / c
    out[..., 1, 1] = cx
    out[..., 1, 2] = -sx
    out[..., 2, 0] = s
    out[..., 2, 1] = sx * t
    out[..., 2, 2] = cx * t
    return out


def isb_from_rotation(rotation_w2_w0: FloatArray, side: Side) -> FloatArray:
    """Return deviation, flexion, pro/supination (..., 3) in the order of the ISB.

    Flexion about the forearm's axis first, deviation about the floating axis, turning about the hand's (reference 1.3;
    Wu 2005). Not to be mixed with :func:`angles_from_rotation` between sessions.

    >>> pose = rotation_from_angles(np.radians([20.0, 60.0, 0.0]), "right")
    >>> np.degrees(isb_from_rotation(pose, "right")).round(1)
    array([  9.8,  61.5, -17.5])
    """
    r = rotation_w2_w0
    s = side_sign(side)
    deviation = np.arcsin(np.clip(r[..., 1, 0], -1.0, 1.0))
    flexion = np.arctan2(-r[..., 2, 0], r[..., 0, 0])
    turning = np.arctan2(-r[..., 1, 2], r[..., 1, 1])
    return np.stack((s * deviation, flexion + 0.0, s * turning), axis=-1)


def zyz_with_sd(
    rotation_w2_w0: FloatArray, angles_sd_rad: FloatArray, side: Side
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return ZYZ angles (..., 3) where defined, their sds (..., 3), and alpha + gamma (...,).

    ``angles_sd_rad`` (..., 3) of the clinical angles, taken as independent. Near the neutral pose alpha and gamma drown
    in the uncertainty of the pose while beta and their sum stay known: they are NaN where their sd passes 30 degrees.
    Beta has no sign: within its sd of zero it is too large.
    """
    r = rotation_w2_w0
    sine = np.hypot(r[..., 0, 2], r[..., 1, 2])
    beta = np.arctan2(sine, r[..., 2, 2])
    alpha = np.arctan2(r[..., 1, 2], r[..., 0, 2])
    gamma = np.arctan2(r[..., 2, 1], -r[..., 2, 0])
    is_finite = np.asarray(np.isfinite(r).all(axis=(-2, -1)))[..., None, None]
    inverse = np.linalg.inv(np.where(is_finite, angle_rates_matrix(r, side), np.eye(3)))
    turn = inverse @ (np.square(angles_sd_rad)[..., None] * np.swapaxes(inverse, -1, -2))
    cg, sg, cb = np.cos(gamma), np.sin(gamma), np.cos(beta)
    safe = np.maximum(sine, 1e-9)
    zero = np.zeros_like(beta)
    by_turn = np.stack(
        (
            np.stack((-cg / safe, sg / safe, zero), -1),
            np.stack((sg, cg, zero), -1),
            np.stack((cg * cb / safe, -sg * cb / safe, np.ones_like(beta)), -1),
        ),
        axis=-2,
    )
    variance = np.einsum("...ij,...jk,...ik->...i", by_turn, turn, by_turn)
    sd = np.sqrt(np.maximum(variance, 0.0))
    is_defined = np.isfinite(beta) & (sd[..., [0, 2]] <= ZYZ_MAX_SD_RAD).all(axis=-1)
    is_known = np.stack((is_defined, np.isfinite(beta), is_defined), axis=-1)
    zyz = np.where(is_known, np.stack((alpha, beta, gamma), axis=-1), np.nan)
    total = np.arctan2(r[..., 1, 0] - r[..., 0, 1], r[..., 0, 0] + r[..., 1, 1])
    return zyz, np.where(is_known, sd, np.nan), total


def compute_wrist_angles(rotation_w2_w0: FloatArray, side: Side) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return clinical angles (3,), their derivatives (3, 3) by a small turn, and ZYZ angles (3,).

    As :func:`angles_from_rotation` and :func:`angle_rates_matrix` for one rotation (3, 3) in plain numbers: arrays of
    one number cost ten times as much. Alpha, beta, gamma of the wrist paper are NaN where beta < 3 degrees.
    """
    (r00, _, r02), (r10, _, r12), (r20, r21, r22) = rotation_w2_w0.tolist()
    s = side_sign(side)
    psi, theta, phi = math.atan2(r10, r00), math.asin(min(max(-r20, -1.0), 1.0)), math.atan2(r21, r22)
    sx, cx = math.sin(phi), math.cos(phi)
    c = math.cos(theta)
    c = 1e-6 if abs(c) < 1e-6 else c
    t = s * math.sin(theta) / c
    rates = np.array([[0.0, s * sx / c, s * cx / c], [0.0, cx, -sx], [s, sx * t, cx * t]])
    beta = math.atan2(math.hypot(r02, r12), r22)
    zyz = (math.nan,) * 3
    if beta >= ZYZ_MIN_BETA_RAD:
        zyz = (math.atan2(r12, r02), beta, math.atan2(r21, -r20))
    return np.array((s * psi, theta + 0.0, s * phi)), rates, np.array(zyz)
