"""Which discs the camera sees, from simple geometry: tilt, picture's edge, bones as capsules in the way."""

from __future__ import annotations

import math

import numpy as np

from carpus.core.model.hand.kinematics import SEGMENTS
from carpus.core.model.hand.protocols import SITES
from carpus.core.model.types import FloatArray
from carpus.core.simulation.disturbances import PassingRod
from carpus.core.simulation.scene import HandPose, Scene

LARGEST_TILT_RAD = math.radians(75.0)

_BONE_RADIUS_M = 0.008
"""Of finger bones with their flesh, for a hand 180 mm long."""


def _own_bones() -> np.ndarray:
    """(21, 15) whether a bone (all of SEGMENTS but the palm) ends or begins under a disc."""
    own = np.zeros((21, 15), dtype=bool)
    for row, name in enumerate(SITES):
        if name in ("WRIST",):
            continue
        digit, joint = (row - 1) // 4, (row - 1) % 4
        for bone in (joint - 1, joint):
            if 0 <= bone < 3:
                own[row, 3 * digit + bone] = True
    return own


_OWN = _own_bones()
assert len(SEGMENTS) == 16


def coarse_visibility(
    scene: Scene, pose: HandPose, time_s: FloatArray, thing: PassingRod | None
) -> tuple[FloatArray, FloatArray]:
    """Visible share, 0 or 1, and cosine of the tilt to the ray, both (N, 21)."""
    normals = scene.marker_normals_w0(pose) @ scene.rotation_w0_cam.T
    discs = scene.to_camera(scene.markers_w0_m(pose))
    towards = -discs / np.linalg.norm(discs, axis=-1, keepdims=True)
    facing = np.sum(normals * towards, axis=-1)
    pixel = scene.camera.project(discs)
    reach_px = scene.patient.marker_radius_m * scene.camera.fx_px / discs[..., 2]
    size = np.array([scene.camera.width_px, scene.camera.height_px])
    inside = ((pixel > 0.5 * reach_px[..., None]) & (pixel < size - 1 - 0.5 * reach_px[..., None])).all(axis=-1)
    seen = (facing > math.cos(LARGEST_TILT_RAD)) & inside
    if scene.spec.marker_protocol.has_fingers:
        seen &= ~_behind_bones(scene, pose, discs, normals, towards)
    if thing is not None:
        seen &= ~_behind_thing(scene, thing, time_s, discs, towards)
    return seen.astype(np.float64), np.maximum(facing, 0.0)


def _behind_bones(
    scene: Scene, pose: HandPose, discs: FloatArray, normals: FloatArray, towards: FloatArray
) -> np.ndarray:
    frames = scene.bones_w(pose)
    turn = scene.rotation_w0_cam @ pose.rotation_w2_w0
    place = scene.to_camera(pose.position_m)

    def seen_from_camera(point: FloatArray) -> FloatArray:
        return np.asarray(point[:, 1:] @ turn.transpose(0, 2, 1) + place[:, None])

    a, b = seen_from_camera(frames.start_m), seen_from_camera(frames.end_m)
    start = discs + 0.002 * normals
    gap = line_gap(start[:, :, None], towards[:, :, None], a[:, None], b[:, None])
    hidden = (gap < _BONE_RADIUS_M * scene.patient.size) & ~_OWN
    return np.asarray(hidden.any(axis=-1))


def _behind_thing(
    scene: Scene, thing: PassingRod, time_s: FloatArray, discs: FloatArray, towards: FloatArray
) -> np.ndarray:
    hidden = np.zeros(discs.shape[:2], dtype=bool)
    for i, t in enumerate(time_s):
        ends = thing.end_points_w0_m(float(t))
        if ends is not None:
            a, b = scene.to_camera(ends)
            hidden[i] = line_gap(discs[i], towards[i], a, b) < thing.radius_m
    return hidden


def line_gap(start: FloatArray, direction: FloatArray, a: FloatArray, b: FloatArray) -> FloatArray:
    """Smallest distance of rays (unit directions) to segments a-b, broadcast over leading axes."""
    along = b - a
    offset = start - a
    d_along = np.sum(direction * along, axis=-1)
    length2 = np.maximum(np.sum(along * along, axis=-1), 1e-12)
    offset_along = np.sum(offset * along, axis=-1)
    offset_d = np.sum(offset * direction, axis=-1)
    determinant = np.maximum(length2 - d_along**2, 1e-12)
    s = np.clip((offset_along - offset_d * d_along) / determinant, 0.0, 1.0)
    t = np.maximum(s * d_along - offset_d, 0.0)
    s = np.clip((t * d_along + offset_along) / length2, 0.0, 1.0)
    t = np.maximum(s * d_along - offset_d, 0.0)
    gap = offset + t[..., None] * direction - s[..., None] * along
    return np.asarray(np.linalg.norm(gap, axis=-1))
