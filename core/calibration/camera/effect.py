"""What a calibration says beyond its numbers: where corners land, what was off before, and what that did to a hand."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np

from carpus.core import so3
from carpus.core.calibration.camera.calibrate import CameraCalibration, Intrinsics
from carpus.core.calibration.camera.views import BoardView, board_pose
from carpus.core.camera import Camera
from carpus.core.types import FloatArray

CELLS = (13, 9)
"""Across and down, of the map of where corners land."""
HAND_LENGTH_M, FLEXION_DEG, AT_M = 0.184, 60.0, 0.65
"""The hand on which the effect is told: how long, how far bent, how far away."""
_PALM_M = np.array([[-0.035, 0.0, 0.0], [0.035, 0.0, 0.0], [-0.04, 0.09, 0.0], [0.0, 0.1, 0.0], [0.04, 0.09, 0.0]])


@dataclass(frozen=True, slots=True)
class Effect:
    """``map_px`` (9, 13, 2) mean distance of corners from where the calibration has them, NaN where there were none;
    ``before_px`` the same over all corners with the intrinsics used so far (root mean square); ``bend_px`` by which the
    lens bends lines at most; by how much an angle of 60° read too much before, and a hand of 184 mm too long."""

    map_px: FloatArray
    before_px: float
    bend_px: float
    angle_more_deg: float
    length_more_mm: float


def effect_of(made: CameraCalibration, views: Sequence[BoardView]) -> Effect:
    """What the calibration changes against what the source said of itself."""
    found, before = made.intrinsics, made.before
    more_deg, more_mm = _on_a_hand(made)
    return Effect(_map(found, views), _error_px(before, found, views), _bend_px(found.camera), more_deg, more_mm)


def _map(found: Intrinsics, views: Sequence[BoardView]) -> FloatArray:
    camera = found.camera
    total, count = np.zeros((CELLS[1], CELLS[0], 2)), np.zeros((CELLS[1], CELLS[0], 1))
    poses = dict(zip(found.used, zip(found.board_turn, found.board_shift_m, strict=True), strict=True))
    for k, view in enumerate(views):  # also what did not count in the end: the guidance has counted its corners
        seen = view.found
        pose = poses.get(k) or board_pose(seen, camera)
        if pose is None:
            continue
        turn, shift = pose
        at = _projected(camera, seen.board.corners_m[seen.corner], turn, shift)
        across = np.clip(seen.pixel[:, 0] * CELLS[0] / camera.width_px, 0, CELLS[0] - 1).astype(int)
        down = np.clip(seen.pixel[:, 1] * CELLS[1] / camera.height_px, 0, CELLS[1] - 1).astype(int)
        np.add.at(total, (down, across), seen.pixel - at)
        np.add.at(count, (down, across), 1.0)
    return np.where(count > 0, total / np.maximum(count, 1.0), np.nan)


def _error_px(camera: Camera, found: Intrinsics, views: Sequence[BoardView]) -> float:
    squares: list[FloatArray] = []
    for k in found.used:
        seen = views[k].found
        pose = board_pose(seen, camera)
        if pose is not None:
            at = _projected(camera, seen.board.corners_m[seen.corner], *pose)
            squares.append(np.asarray(np.sum((seen.pixel - at) ** 2, axis=1)))
    return math.sqrt(float(np.concatenate(squares).mean())) if squares else math.nan


def _projected(camera: Camera, points_m: FloatArray, turn: FloatArray, shift_m: FloatArray) -> FloatArray:
    rotation = np.asarray(cv2.Rodrigues(np.ravel(turn))[0], dtype=np.float64)
    return camera.distort(camera.project(points_m @ rotation.T + np.ravel(shift_m)))


def _bend_px(camera: Camera) -> float:
    u, v = np.meshgrid(np.linspace(0, camera.width_px - 1, 17), np.linspace(0, camera.height_px - 1, 13))
    pixel = np.stack((u.ravel(), v.ravel()), axis=-1)
    return float(np.linalg.norm(camera.undistort(pixel) - pixel, axis=1).max())


def _on_a_hand(made: CameraCalibration) -> tuple[float, float]:
    """Degrees by which a bend read too much, and millimetres by which a hand read too long."""
    scale, offset_m = (1.0, 0.0) if made.depth is None else (made.depth.scale, made.depth.offset_m)
    centre = np.array([0.03, -0.02, AT_M])
    bend = math.radians(FLEXION_DEG)
    turn = np.array([[1.0, 0.0, 0.0], [0.0, math.cos(bend), -math.sin(bend)], [0.0, math.sin(bend), math.cos(bend)]])

    def read(points: FloatArray) -> FloatArray:
        pixel = made.before.undistort(made.intrinsics.camera.distort(made.intrinsics.camera.project(points)))
        return made.before.back_project(pixel, scale * points[:, 2] + offset_m)

    flat, bent = read(_PALM_M + centre), read(_PALM_M @ turn.T + centre)
    rotation, _ = so3.rigid(flat, bent)
    angle = math.degrees(math.acos(float(np.clip(0.5 * (np.trace(rotation) - 1.0), -1.0, 1.0))))
    hand = read(np.array([[0.0, -0.5 * HAND_LENGTH_M, 0.0], [0.0, 0.5 * HAND_LENGTH_M, 0.0]]) + centre)
    length_m = float(np.linalg.norm(hand[1] - hand[0]))
    return angle - FLEXION_DEG, 1e3 * (length_m - HAND_LENGTH_M)
