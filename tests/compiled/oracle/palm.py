"""How the palm moves and is seen, in NumPy as the formulas stand in the papers."""

from __future__ import annotations

import math

import numpy as np
from scipy.linalg import solve_triangular

from carpus.core.model import so3
from carpus.core.model.camera import Camera
from carpus.core.model.types import FloatArray
from carpus.core.tracking.filter.mixture_filter import ModeMixture, mode_transition_matrix
from carpus.core.tracking.filter.motion import PalmMotion
from carpus.core.tracking.filter.palm_state import (
    POSE,
    POSITION,
    RATE,
    RIGID_MOTION,
    SHAPE,
    SIZE,
    SOFT_TISSUE,
    TURN,
    VELOCITY,
    PalmEstimate,
    PalmView,
)
from carpus.core.tracking.filter.soft_tissue import HOME, WRIST, DigitSpeeds
from carpus.core.tracking.filter.unscented import SigmaWeights
from tests.compiled.oracle.mixture import merged

DISCS, FLOOR = np.arange(6), 1e-14
_OF_WRIST, _OF_THUMB, _OF_KNUCKLES = slice(0, 3), slice(3, 6), slice(6, 18)
_OF_DISC = 3 * DISCS[:, None, None] + np.arange(3)[:, None]  # (6, 3, 1): each disc's own u, v, z
_BY_SHAPE, _BY_SKIN = (first + 3 * DISCS[:, None, None] + np.arange(3) for first in (SHAPE.start, SOFT_TISSUE.start))


def right_jacobian(turn_rad: FloatArray) -> FloatArray:
    """Jr (3, 3) of one turn (3,), with Exp(t + d) = Exp(t) Exp(Jr d) to first order."""
    x, y, z = turn_rad.tolist()
    angle2 = x * x + y * y + z * z
    if angle2 < 1e-6:
        b, c = 0.5 - angle2 / 24.0, 1.0 / 6.0 - angle2 / 120.0
    else:
        angle = math.sqrt(angle2)
        b, c = (1.0 - math.cos(angle)) / angle2, (angle - math.sin(angle)) / (angle2 * angle)
    d = 1.0 - c * angle2
    return np.array(
        [
            [d + c * x * x, c * x * y + b * z, c * x * z - b * y],
            [c * x * y - b * z, d + c * y * y, c * y * z + b * x],
            [c * x * z + b * y, c * y * z - b * x, d + c * z * z],
        ]
    )


def camera_slope(camera: Camera, image: FloatArray) -> FloatArray:
    """Derivative (..., 3, 3) of pixel u, v and depth z by the place in camera axes, at u, v, z (..., 3)."""
    z = image[..., 2]
    out = np.zeros((*image.shape, 3))
    out[..., 0, 0], out[..., 1, 1] = camera.fx_px / z, camera.fy_px / z
    out[..., 0, 2] = (camera.cx_px - image[..., 0]) / z
    out[..., 1, 2] = (camera.cy_px - image[..., 1]) / z
    out[..., 2, 2] = 1.0
    return out


def switch_modes(motion: PalmMotion, rate_rad_s: FloatArray, dt_s: float, digits: DigitSpeeds) -> FloatArray:
    """Probability (K, K) to go from row to column mode."""
    tissue, turning_rad_s = motion.tissue, float(np.linalg.norm(rate_rad_s))
    rates = tissue.rates.copy()
    if tissue.is_joint_driven:
        rates[HOME, 1:] += tissue.leaving_per_rad * max(turning_rad_s, *digits)
    elif tissue.count > 1:
        rates[: tissue.resting, WRIST] *= 0.2 + min(turning_rad_s / tissue.turning_rad_s, 3.0)
    total = rates.sum(axis=1)
    leave = -np.expm1(-total * dt_s)
    by_tissue = rates * (leave / np.maximum(total, 1e-12))[:, None]
    np.fill_diagonal(by_tissue, 1.0 - leave)
    out: FloatArray = by_tissue[motion.tissue_of[:, None], motion.tissue_of]
    scales, resting = motion.scales.size, motion.scales.size * tissue.resting
    out[:resting, :resting] *= np.kron(
        mode_transition_matrix(scales, motion.dwell_s, dt_s), np.ones((tissue.resting,) * 2)
    )
    out[resting:, :resting] /= scales
    return out


def move_palm(
    motion: PalmMotion, rate_rad_s: FloatArray, dt_s: float, unseen: FloatArray | None, digits: DigitSpeeds
) -> tuple[FloatArray, ...]:
    """F (12, 12) and Q (K, 12, 12) of what moves, shares kept (K, n), Q of the tissue (K, r, r), switch, rotation."""
    noise, tissue, scales2 = motion.noise, motion.tissue, (motion.scale_of**2)[:, None, None]
    turned, on_the_way = so3.exp(rate_rad_s * dt_s), right_jacobian(rate_rad_s * dt_s)
    moving = np.eye(RIGID_MOTION.stop)
    moving[POSITION, VELOCITY] = dt_s * np.eye(3)
    moving[TURN, TURN], moving[TURN, RATE] = turned.T, dt_s * on_the_way
    driven = np.zeros((motion.modes, RIGID_MOTION.stop, RIGID_MOTION.stop))
    for place, speed, q, along, unscaled in (
        (POSITION, VELOCITY, noise.acceleration_density, np.eye(3), np.zeros((3, 3))),
        (TURN, RATE, noise.turn_acceleration_density, on_the_way, np.zeros((3, 3)) if unseen is None else unseen),
    ):
        more = np.maximum(motion.unseen_scale**2 - scales2, 0.0)
        across = along @ unscaled
        driven[:, place, place] = q * dt_s**3 / 3.0 * (scales2 * (along @ along.T) + more * (across @ across.T))
        driven[:, place, speed] = q * dt_s**2 / 2.0 * (scales2 * along + more * across)
        driven[:, speed, place] = np.swapaxes(driven[:, place, speed], 1, 2)
        driven[:, speed, speed] = q * dt_s * (scales2 * np.eye(3) + more * unscaled)
    fading = dt_s / tissue.lasts_s
    if tissue.is_joint_driven:
        turning_rad_s = float(np.linalg.norm(rate_rad_s))
        speeds = np.full(SOFT_TISSUE.stop - SOFT_TISSUE.start, max(turning_rad_s, *digits))
        speeds[_OF_WRIST], speeds[_OF_THUMB], speeds[_OF_KNUCKLES] = turning_rad_s, digits.thumb, digits.fingers
        fading += dt_s / tissue.lasts_rad * speeds
    soft = np.exp(-fading)
    kept = np.ones((motion.modes, SIZE))
    kept[:, SOFT_TISSUE] = soft[motion.tissue_of]
    relaxing = tissue.stationary * (1.0 - soft[:, :, None] * soft[:, None, :])
    switch = switch_modes(motion, rate_rad_s, dt_s, digits)
    return moving, driven, kept, relaxing[motion.tissue_of], switch, turned


def see_palm(
    estimate: PalmEstimate, mixture: ModeMixture, view: PalmView, weights: SigmaWeights
) -> tuple[FloatArray, ...]:
    """Value (1, 18), slope (1, 18, n) and error (1, 18, 18) of h; each disc's mean (6, 3) and covariance (6, 3, 3)."""
    root = np.linalg.cholesky(estimate.covariance[POSE[:, None], POSE] + FLOOR * np.eye(POSE.size))
    offset = weights.scale * np.concatenate((np.zeros((1, POSE.size)), root.T, -root.T))
    place = view.palm_m + estimate.shape_m + estimate.skin_m
    turned = estimate.rotation_w2_w0 @ so3.exp(offset[:, 3:])
    in_w0 = place @ np.swapaxes(turned, 1, 2) + (estimate.position_m + offset[:, :3])[:, None]
    image = in_w0 @ view.rotation_w0_cam.T + view.translation_w0_cam_m
    image[..., :2] = view.camera.project(image)
    flat = image.reshape(len(image), -1)
    value = weights.mean @ flat
    plus, minus = flat[1 : POSE.size + 1], flat[POSE.size + 1 :]
    half, bend, middle = (plus - minus) * (0.5 / weights.scale), 0.5 * (plus + minus) - value, flat[0] - value
    error = 2.0 * weights.covariance[1] * (bend.T @ bend) + weights.covariance[0] * np.outer(middle, middle)
    slope = np.zeros((value.size, SIZE))
    slope[:, POSE] = solve_triangular(root, half, lower=True, trans="T", check_finite=False).T
    by_place = camera_slope(view.camera, image[0]) @ (view.rotation_w0_cam @ estimate.rotation_w2_w0)
    slope[_OF_DISC, _BY_SHAPE] = slope[_OF_DISC, _BY_SKIN] = by_place
    slope[2::3, SHAPE] -= view.depth_bias
    value[2::3] -= view.depth_bias @ estimate.value[SHAPE]
    mean = (value + slope @ (mixture.probability[0] @ mixture.mean[0])).reshape(-1, 3)
    whole = (slope @ estimate.covariance @ slope.T + error).reshape(6, 3, 6, 3)
    return value[None], slope[None], error[None], mean, whole[DISCS, :, DISCS, :]


def reset_errors(nominal: PalmEstimate, mixture: ModeMixture) -> tuple[FloatArray, ...]:
    """Rotation, value and covariance of the estimate moved to the mixture's mean; the modes' means from there."""
    mean, covariance = merged(mixture)
    apart = mixture.mean - mean[:, None]
    apart[..., TURN] += 0.5 * (mixture.mean[..., TURN] @ so3.skew(mean[0, TURN]))
    moved = nominal.add_error(mean[0], covariance[0])
    return moved.rotation_w2_w0, moved.value, moved.covariance, apart
