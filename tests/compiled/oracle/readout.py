"""What is read off the palm, in NumPy."""

from __future__ import annotations

import numpy as np

from carpus.core.model import so3
from carpus.core.model.hand import clinical_angles
from carpus.core.model.types import FloatArray, Side
from carpus.core.tracking.filter.hand_geometry import ZERO_CUP, PalmGeometry
from carpus.core.tracking.filter.palm_state import POSE, SHAPE, SIZE, SKIN, TURN, PalmEstimate, PalmView
from carpus.core.tracking.filter.readout import WristAxes
from carpus.core.tracking.filter.soft_tissue import CUPPING_DISCS


def axes_of(known: WristAxes, estimate: PalmEstimate) -> FloatArray:
    """Axes (3, 3) as the shape has turned them since they were worked out."""
    return np.asarray(known.axes @ so3.exp(known.sensitivity @ (estimate.value[SHAPE] - known.shape_m)))


def read_wrist(
    known: WristAxes,
    disc_m: FloatArray,
    estimate: PalmEstimate,
    start: FloatArray | None,
    stays: FloatArray | None,
    side: Side,
) -> tuple[FloatArray, ...]:
    """Axes, rotation as shown, place, rate, angles with their standard deviations, ZYZ angles."""
    axes = axes_of(known, estimate)
    position = estimate.position_m + estimate.rotation_w2_w0 @ (disc_m[0] + estimate.shape_m[0] + estimate.skin_m[0])
    rotation = axes.T @ estimate.rotation_w2_w0 @ axes
    error = np.zeros((3, SIZE))
    error[:, TURN], error[:, SHAPE] = axes.T, (np.eye(3) - rotation.T) @ known.sensitivity
    turn_covariance = error @ estimate.covariance @ error.T
    if stays is not None:
        turn_covariance = turn_covariance + axes.T @ stays @ axes
    shown = rotation if start is None else start @ rotation
    angles, by_turn, zyz = clinical_angles.compute_wrist_angles(shown, side)
    sd = np.sqrt(np.maximum(np.vecdot(by_turn @ turn_covariance, by_turn), 0.0))
    return axes, shown, position, axes.T @ estimate.rate_rad_s, angles, sd, zyz


def seat_fingers(
    known: WristAxes, disc_m: FloatArray, estimate: PalmEstimate, view: PalmView, side: Side, metacarpal_m: float
) -> tuple[FloatArray, ...]:
    """The numbers of a ``PalmGeometry``, then how the camera sees it and how surely."""
    axes = axes_of(known, estimate)
    error = np.zeros((3, SIZE))
    error[:, TURN], error[:, SHAPE] = np.eye(3), axes @ known.sensitivity
    disc_m = disc_m + estimate.shape_m
    disc_m[CUPPING_DISCS, 1:] += estimate.skin_m[CUPPING_DISCS, 1:]
    cup, cup_sd = ZERO_CUP.copy(), ZERO_CUP.copy()
    cup[-2:] = -estimate.skin_m[CUPPING_DISCS, 2] / metacarpal_m
    down = SKIN.start + 3 * CUPPING_DISCS + 2
    cup_sd[-2:] = np.sqrt(estimate.covariance[down, down]) / metacarpal_m
    palm = PalmGeometry.from_discs(disc_m, axes, side, cup, cup_sd)
    body_cam = view.rotation_w0_cam @ estimate.rotation_w2_w0
    to_camera = np.zeros((6, 6))
    to_camera[:3, :3], to_camera[3:, 3:] = view.rotation_w0_cam, body_cam
    pose = to_camera @ estimate.covariance[POSE[:, None], POSE] @ to_camera.T
    turn = body_cam @ (error @ estimate.covariance @ error.T) @ body_cam.T
    seat = view.to_camera(estimate, palm.axes, palm.origin_m)
    return palm.axes, palm.origin_m, palm.disc_m, palm.cup_rad, palm.cup_sd_rad, *seat, pose, turn
