"""Joint centres, finger tips and paper discs for given joint angles.

Clinical reference 2 and 3.2. Closed form of the Denavit-Hartenberg chains: a long finger is a direction in the palm
plane (abduction) and a planar chain below it; the thumb is that with a rolled plane after the metacarpal. All poses at
once. Angles are (..., 17), order of :func:`core.model.hand.protocols.joint_angle_names`, DIP = 2/3 PIP; or (..., 21),
DIP free. Points are (..., 21, 3) in the order of ``hand21``, metres, in the wrist frame W of the anatomy's own side.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from carpus.core.model.hand.anatomy import HandAnatomy
from carpus.core.model.hand.protocols import PALM_SITES, SITES
from carpus.core.model.types import FloatArray

DIP_PER_PIP = 2.0 / 3.0  # DIP flexion over PIP flexion of a healthy finger moving freely (hand paper, section 2)

SEGMENTS = ("palm", "MC1", "PP1", "DP1") + tuple(f"{bone}{k}" for k in (2, 3, 4, 5) for bone in ("PP", "MP", "DP"))

_PALM = list(PALM_SITES)


@dataclass(frozen=True, slots=True)
class SegmentFrames:
    """The bones as a renderer needs them, in the order of ``SEGMENTS``.

    Joint centres ``start_m`` and ``end_m`` (..., 16, 3) and the unit ``dorsal_normal`` (..., 16, 3), all in W. The palm
    runs from WRIST to MCP3.
    """

    start_m: FloatArray
    end_m: FloatArray
    dorsal_normal: FloatArray


def joint_centres(anatomy: HandAnatomy, angles_rad: FloatArray) -> FloatArray:
    """Return joint centres and tips, (..., 21, 3) in W.

    >>> from carpus.core.model.hand.anatomy import anatomy_from_size
    >>> straight = joint_centres(anatomy_from_size(0.180, 0.080, arch=0.0, skin_offsets=False), np.zeros(17))
    >>> straight[SITES.index("TIP2")].round(4)
    array([0.1674, 0.0277, 0.    ])
    """
    out = np.empty((*angles_rad.shape[:-1], 21, 3))
    out[..., _PALM, :] = anatomy.palm_joint_m
    thumb = _Thumb.from_angles(anatomy.fan_rad[0], anatomy.thumb_roll_rad, anatomy.thumb_length_m, angles_rad[..., :5])
    out[..., 2:5, :] = anatomy.palm_joint_m[1] + thumb.joints @ thumb.metacarpal
    finger = _Finger.from_angles(anatomy.fan_rad[1:], anatomy.finger_length_m, finger_angles(angles_rad))
    _finger_view(out)[..., 1:, :] = finger.place_points(anatomy.palm_joint_m[2:], finger.along, finger.up)
    return _mirror_to_side(anatomy, out)


def disc_centres(anatomy: HandAnatomy, angles_rad: FloatArray) -> FloatArray:
    """Return centres of the paper discs on the skin, (..., 21, 3) in W.

    The discs of WRIST, CMC1 and MCP2 to MCP5 stay with the palm; MCP1 stays with the first metacarpal as those of the
    fingers stay with theirs; IP1, PIP and DIP stand on the bisector of the dorsal normals of the two segments that meet
    there; TIP stands on the normal of the last segment.
    """
    hand = anatomy
    out = np.empty((*angles_rad.shape[:-1], 21, 3))
    out[..., _PALM, :] = hand.palm_disc_m
    out[..., 2:5, :] = thumb_discs(
        hand.palm_joint_m[1],
        hand.fan_rad[0],
        hand.thumb_roll_rad,
        hand.thumb_length_m,
        hand.thumb_offset_m,
        angles_rad[..., :5],
    )
    _finger_view(out)[..., 1:, :] = finger_discs(
        hand.palm_joint_m[2:], hand.fan_rad[1:], hand.finger_length_m, hand.finger_offset_m, finger_angles(angles_rad)
    )
    return _mirror_to_side(hand, out)


def finger_angles(angles_rad: FloatArray) -> FloatArray:
    """Return abduction, MCP, PIP and DIP flexion of fingers 2 to 5, (..., 4, 4)."""
    per_finger = (angles_rad.shape[-1] - 5) // 4
    angles = angles_rad[..., 5:].reshape(*angles_rad.shape[:-1], 4, per_finger)
    if per_finger == 4:
        return angles
    return np.concatenate((angles, DIP_PER_PIP * angles[..., 2:]), axis=-1)


def finger_discs(
    knuckle_m: FloatArray, fan_rad: FloatArray, length_m: FloatArray, offset_m: FloatArray, angles_rad: FloatArray
) -> FloatArray:
    """Return discs PIP, DIP, TIP of right long fingers, (..., 3 discs, 3) in W.

    All leading shapes broadcast: ``knuckle_m`` (..., 3) MCP joint centre; ``fan_rad`` (...); ``length_m`` (..., 3) PP
    MP DP; ``offset_m`` (..., 3) of the three discs; ``angles_rad`` (..., 4) abduction, MCP, PIP, DIP flexion.
    """
    finger = _Finger.from_angles(fan_rad, length_m, angles_rad)
    normal_pitch = finger.pitch + 0.0
    normal_pitch[..., :2] = 0.5 * (finger.pitch[..., :2] + finger.pitch[..., 1:])
    along = finger.along + offset_m * np.sin(normal_pitch)
    up = finger.up + offset_m * np.cos(normal_pitch)
    return finger.place_points(knuckle_m, along, up)


def thumb_discs(
    cmc_m: FloatArray,
    fan_rad: float | FloatArray,
    roll_rad: float | FloatArray,
    length_m: FloatArray,
    offset_m: FloatArray,
    angles_rad: FloatArray,
) -> FloatArray:
    """Return discs MCP1, IP1, TIP1 of a right thumb, (..., 3 discs, 3) in W.

    All leading shapes broadcast: ``cmc_m`` (..., 3) CMC joint centre; ``fan_rad`` rho1 and ``roll_rad`` tau (...);
    ``length_m`` (..., 3) MC PP DP; ``offset_m`` (..., 3) of the three discs; ``angles_rad`` (..., 5).
    """
    thumb = _Thumb.from_angles(fan_rad, roll_rad, length_m, angles_rad)
    half = 0.5 / np.cos(0.5 * angles_rad[..., 4, None])
    stand = thumb.normals.copy()
    stand[..., 1, :] = half * (thumb.normals[..., 1, :] + thumb.normals[..., 2, :])
    discs = (thumb.joints + offset_m[..., None] * stand) @ thumb.metacarpal
    return np.asarray(cmc_m[..., None, :] + discs)


def segment_frames(anatomy: HandAnatomy, angles_rad: FloatArray) -> SegmentFrames:
    """Return start, end and dorsal normal of the palm and of every bone of the fingers."""
    shape = angles_rad.shape[:-1]
    joints = joint_centres(anatomy, angles_rad)
    start, end = np.empty((*shape, 16, 3)), np.empty((*shape, 16, 3))
    wrist, mcp3 = SITES.index("WRIST"), SITES.index("MCP3")
    start[..., 0, :], end[..., 0, :] = joints[..., wrist, :], joints[..., mcp3, :]
    start[..., 1:4, :], end[..., 1:4, :] = joints[..., 1:4, :], joints[..., 2:5, :]
    start[..., 4:, :] = _finger_view(joints)[..., :3, :].reshape(*shape, 12, 3)
    end[..., 4:, :] = _finger_view(joints)[..., 1:, :].reshape(*shape, 12, 3)

    normal = np.empty((*shape, 16, 3))
    normal[..., 0, :] = (0.0, 0.0, 1.0)
    thumb = _Thumb.from_angles(anatomy.fan_rad[0], anatomy.thumb_roll_rad, anatomy.thumb_length_m, angles_rad[..., :5])
    normal[..., 1:4, :] = thumb.normals @ thumb.metacarpal
    finger = _Finger.from_angles(anatomy.fan_rad[1:], anatomy.finger_length_m, finger_angles(angles_rad))
    dorsal = finger.place_points(np.zeros(3), np.sin(finger.pitch), np.cos(finger.pitch))
    normal[..., 4:, :] = dorsal.reshape(*shape, 12, 3)
    return SegmentFrames(start, end, _mirror_to_side(anatomy, normal))


@dataclass(frozen=True, slots=True)
class _Finger:
    """Long fingers in their own planes, arrays (..., 1) and (..., 3 segments).

    ``pitch`` of each segment below the palm plane; ``along`` and ``up`` the ends of the segments from the MCP joint.
    """

    cos_azimuth: FloatArray
    sin_azimuth: FloatArray
    pitch: FloatArray
    along: FloatArray
    up: FloatArray

    @staticmethod
    def from_angles(fan_rad: FloatArray, length_m: FloatArray, angles_rad: FloatArray) -> _Finger:
        azimuth = (fan_rad + angles_rad[..., 0])[..., None]
        pitch = np.cumsum(angles_rad[..., 1:], axis=-1)
        along = np.cumsum(length_m * np.cos(pitch), axis=-1)
        up = -np.cumsum(length_m * np.sin(pitch), axis=-1)
        return _Finger(np.cos(azimuth), np.sin(azimuth), pitch, along, up)

    def place_points(self, knuckle_m: FloatArray, along: FloatArray, up: FloatArray) -> FloatArray:
        """Return points (..., 3, 3) in W from their places in the finger's plane."""
        knuckle = knuckle_m[..., None, :]
        x = knuckle[..., 0] + self.cos_azimuth * along
        y = knuckle[..., 1] + self.sin_azimuth * along
        return np.stack((x, y, knuckle[..., 2] + up), axis=-1)


@dataclass(frozen=True, slots=True)
class _Thumb:
    """The thumb from the CMC joint on, in the axes of its metacarpal.

    ``metacarpal`` (..., 3, 3): rows are the metacarpal's direction, its dorsal normal and the flexion axis, in W.
    ``joints`` (..., 3, 3): MCP1, IP1, TIP1 and ``normals`` (..., 3, 3) of MC1, PP1, DP1, components in those axes.
    """

    metacarpal: FloatArray
    joints: FloatArray
    normals: FloatArray

    @staticmethod
    def from_angles(
        fan_rad: float | FloatArray, roll_rad: float | FloatArray, length_m: FloatArray, angles_rad: FloatArray
    ) -> _Thumb:
        azimuth = fan_rad + angles_rad[..., 0]
        c0, s0 = np.cos(azimuth), np.sin(azimuth)
        c1, c2, c3, c4 = np.moveaxis(np.cos(angles_rad[..., 1:]), -1, 0)
        s1, s2, s3, s4 = np.moveaxis(np.sin(angles_rad[..., 1:]), -1, 0)
        ct, st = np.cos(roll_rad), np.sin(roll_rad)
        shape = np.broadcast_shapes(c0.shape, np.shape(ct), length_m.shape[:-1])

        # Rows 1 and 2 of the table: swing in the palm plane, palmar abduction, roll by tau.
        metacarpal = np.empty((*shape, 3, 3))
        metacarpal[..., 0, 0], metacarpal[..., 0, 1], metacarpal[..., 0, 2] = c1 * c0, c1 * s0, -s1
        metacarpal[..., 1, 0] = ct * s1 * c0 - st * s0
        metacarpal[..., 1, 1] = ct * s1 * s0 + st * c0
        metacarpal[..., 1, 2] = ct * c1
        metacarpal[..., 2, 0] = -ct * s0 - st * s1 * c0
        metacarpal[..., 2, 1] = ct * c0 - st * s1 * s0
        metacarpal[..., 2, 2] = -st * c1

        # Rows 3 to 5: MCP flexion, MCP abduction about the new dorsal normal, IP flexion.
        x, y, z = c2 * c3, -s2 * c3, s3  # direction of PP1
        normals = np.zeros((*shape, 3, 3))
        normals[..., 0, 1] = 1.0
        normals[..., 1, 0], normals[..., 1, 1] = s2, c2
        normals[..., 2, 0], normals[..., 2, 1], normals[..., 2, 2] = s4 * x + c4 * s2, s4 * y + c4 * c2, s4 * z

        mc, pp, dp = np.moveaxis(length_m, -1, 0)
        joints = np.zeros((*shape, 3, 3))
        joints[..., 0, 0] = mc
        joints[..., 1, 0], joints[..., 1, 1], joints[..., 1, 2] = mc + pp * x, pp * y, pp * z
        joints[..., 2, 0] = joints[..., 1, 0] + dp * (c4 * x - s4 * s2)
        joints[..., 2, 1] = joints[..., 1, 1] + dp * (c4 * y - s4 * c2)
        joints[..., 2, 2] = joints[..., 1, 2] + dp * c4 * z
        return _Thumb(metacarpal, joints, normals)


def _finger_view(points: FloatArray) -> FloatArray:
    """Return the points of fingers 2 to 5 as a view (..., 4 fingers, 4 points, 3)."""
    return points[..., 5:, :].reshape(*points.shape[:-2], 4, 4, 3)


def _mirror_to_side(anatomy: HandAnatomy, vectors: FloatArray) -> FloatArray:
    if anatomy.side == "left":
        vectors[..., 1] *= -1.0
    return vectors
