"""Cut-out of the hand from a frame, and the position of its trained angle there.

Pixels of the colour frame. Everything further than a few centimetres from the hand, located by the tracked markers,
becomes flat grey, so face and room are never visible; without a tracked hand there is no image.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np

from carpus.core.model import so3
from carpus.core.model.hand.exercises import DEVIATION, FLEXION, Exercise
from carpus.core.model.types import ByteImage, FloatArray, TrackStatus
from carpus.core.results.valid_data import motion_estimate
from carpus.core.session.values import Session

MARGIN_M = 0.03
"""Kept around the hand."""
FINGER_SHARE, THUMB_SHARE, ARM_SHARE = 1.25, 0.9, 0.5
"""Without markers on the fingers: reach of the fingers beyond the MCP joints, of the thumb beside its base, and kept
length of the forearm, relative to the distance from WRIST to MCP3."""
BACKGROUND_GREY = 34
MAX_TILT_DEG = 20.0
"""Between a movement's axis and the line of sight; beyond it an angle in the image looks too small."""


@dataclass(frozen=True, slots=True)
class AngleOverlay:
    """Angle in the image: 0 from ``vertex`` to ``zero``, the current angle to ``hand``; pixels (2,)."""

    vertex: FloatArray
    zero: FloatArray
    hand: FloatArray


@dataclass(frozen=True, slots=True)
class HandCutout:
    """Part of a frame with the hand; ``left_px`` and ``top_px`` are its position in the frame."""

    image: ByteImage
    left_px: int
    top_px: int


def markers_px(session: Session, row: int) -> FloatArray:
    """Return marker positions (M, 2) in pixels: measured, else projected from the model; NaN while lost."""
    out = np.array(session.markers.measured_px[row], dtype=float)
    places = session.markers.position_cam_m[row]
    hidden = ~np.isfinite(out).all(axis=1) & np.isfinite(places).all(axis=1)
    if hidden.any():
        out[hidden] = session.camera.distort(session.camera.project(places[hidden]))
    return out


def _hand_outline(session: Session, row: int) -> tuple[FloatArray, float] | None:
    """Return points (K, 2) around the hand and the margin in pixels, None while the hand is lost."""
    spots, depth = markers_px(session, row), session.markers.position_cam_m[row][:, 2]
    names = session.header.protocol.markers
    if session.status[row] == TrackStatus.LOST or not np.isfinite(spots).all() or not np.isfinite(depth).any():
        return None
    at = dict(zip(names, spots, strict=True))
    wrist, middle = at["WRIST"], at["MCP3"]
    palm = float(np.linalg.norm(middle - wrist))
    points = [*spots, wrist + ARM_SHARE * (wrist - middle)]
    for k in (2, 3, 4, 5):
        if f"TIP{k}" not in at:
            along = at[f"MCP{k}"] - wrist
            points.append(at[f"MCP{k}"] + FINGER_SHARE * palm * along / max(float(np.linalg.norm(along)), 1.0))
    if "TIP1" not in at:
        away = at["CMC1"] - at["MCP5"]
        side = away / max(float(np.linalg.norm(away)), 1.0)
        points += [at["CMC1"] + THUMB_SHARE * palm * side, at["MCP2"] + THUMB_SHARE * palm * side]
    return np.array(points), MARGIN_M * float(session.camera.matrix[0, 0]) / float(np.nanmedian(depth))


def cut_out_hand(frame: ByteImage, session: Session, row: int) -> HandCutout | None:
    """Cut the hand out of a frame; None if it was lost or is outside."""
    found = _hand_outline(session, row)
    if found is None:
        return None
    points, margin = found
    mask = np.zeros(frame.shape[:2], np.uint8)
    hull = cv2.convexHull(points.astype(np.float32)).astype(np.int32)
    cv2.fillConvexPoly(mask, hull, 1)
    cv2.polylines(mask, [hull], True, 1, thickness=max(2 * round(margin), 1))
    left, top, width, height = cv2.boundingRect(mask)
    if not width:
        return None
    part = np.s_[top : top + height, left : left + width]
    return HandCutout(np.where(mask[part][..., None] > 0, frame[part], np.uint8(BACKGROUND_GREY)), left, top)


def angle_overlay(session: Session, row: int, exercise: Exercise) -> AngleOverlay | None:
    """Return where the trained angle lies in the image, None if it is not in its plane or not measured."""
    if session.status[row] != TrackStatus.TRACKED:
        return None
    spots = dict(zip(session.header.protocol.markers, markers_px(session, row), strict=True))
    places = dict(zip(session.header.protocol.markers, session.markers.position_cam_m[row], strict=True))
    if exercise.angle in (DEVIATION, FLEXION) and session.calibration.start_angles_rad[exercise.angle] == 0.0:
        return _wrist_overlay(session, row, exercise.angle, spots["WRIST"], spots["MCP3"])
    joint = exercise.joint.partition("_")
    names = {"MCP": ("WRIST", "MCP", "PIP"), "PIP": ("MCP", "PIP", "DIP")}.get(joint[0][:3])
    if names is None or joint[2] != "flexion" or not session.header.joint_names:
        return None
    before, at, after = (name if name == "WRIST" else f"{name}{joint[0][3:]}" for name in names)
    if not np.isfinite([places[name] for name in (before, at, after)]).all():
        return None
    normal = np.cross(places[at] - places[before], places[after] - places[at])
    size = float(np.linalg.norm(normal))
    if size < 1e-9 or not _is_facing_camera(normal / size):
        return None
    along = spots[at] - spots[before]
    length = float(np.linalg.norm(spots[after] - spots[at]))
    return AngleOverlay(spots[at], spots[at] + length * along / max(float(np.linalg.norm(along)), 1.0), spots[after])


def _wrist_overlay(
    session: Session, row: int, angle: int, wrist_px: FloatArray, knuckle_px: FloatArray
) -> AngleOverlay | None:
    motion = motion_estimate(session)
    to_camera = session.calibration.rotation_w0_cam @ so3.exp(np.nan_to_num(motion.w0_turn_rad[row]))
    axis = to_camera[:, 1 if angle == FLEXION else 2]
    if not np.isfinite(wrist_px).all() or not np.isfinite(knuckle_px).all() or not _is_facing_camera(axis):
        return None
    length = 1.6 * float(np.linalg.norm(knuckle_px - wrist_px))
    ends = []
    for direction in (to_camera[:, 0], to_camera @ motion.rotation_w2_w0[row][:, 0]):
        flat = direction[:2]
        ends.append(wrist_px + length * flat / max(float(np.linalg.norm(flat)), 1e-9))
    return AngleOverlay(wrist_px, ends[0], ends[1])


def _is_facing_camera(axis_cam: FloatArray) -> bool:
    """Return whether a movement about an axis (3,) in camera axes lies in the image plane."""
    return abs(float(axis_cam[2])) >= math.cos(math.radians(MAX_TILT_DEG))
