"""Where the joints, finger tips and paper discs are for given joint angles (clinical reference 2 and 3.2).

Closed form of the Denavit-Hartenberg chains: a long finger is a direction in the palm plane (abduction) and a
planar chain below it; the thumb is that with a rolled plane after the metacarpal. All poses at once.

Angles are (..., 17), order of :func:`core.hand.protocols.joint_angle_names`, DIP = 2/3 PIP; or (..., 21), DIP free.
Points are (..., 21, 3) in the order of ``hand21``, metres, in the wrist frame W of the anatomy's own side.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core.hand.anatomy import HandAnatomy
from core.hand.protocols import HAND21
from core.types import FloatArray

DIP_PER_PIP = 2.0 / 3.0
"""DIP flexion over PIP flexion of a healthy finger moving freely (hand paper, section 2)."""

SEGMENTS = ("palm", "MC1", "PP1", "DP1") + tuple(f"{bone}{k}" for k in (2, 3, 4, 5) for bone in ("PP", "MP", "DP"))

_PALM = list(HAND21.palm)


@dataclass(frozen=True, slots=True)
class SegmentFrames:
    """The bones as a renderer needs them, order of ``SEGMENTS``: joint centres ``start_m`` and ``end_m``
    (..., 16, 3) and the unit ``dorsal_normal`` (..., 16, 3), all in W. The palm runs from WRIST to MCP3."""

    start_m: FloatArray
    end_m: FloatArray
    dorsal_normal: FloatArray


def joint_centres(anatomy: HandAnatomy, angles_rad: FloatArray) -> FloatArray:
    """Joint centres and tips, (..., 21, 3) in W.

    >>> from core.hand.anatomy import anatomy_from_size
    >>> straight = joint_centres(anatomy_from_size(0.180, 0.080, arch=0.0, skin_offsets=False), np.zeros(17))
    >>> straight[HAND21.markers.index("TIP2")].round(4)
    array([0.1674, 0.0277, 0.    ])
    """
    out = np.empty((*angles_rad.shape[:-1], 21, 3))
    out[..., _PALM, :] = anatomy.palm_joint_m
    thumb = _Thumb.at(anatomy, angles_rad)
    out[..., 2:5, :] = anatomy.palm_joint_m[1] + thumb.joints @ thumb.metacarpal
    finger = _Finger.at(anatomy, angles_rad)
    _put_fingers(out, anatomy, finger, finger.along, finger.up)
    return _on_its_side(anatomy, out)


def disc_centres(anatomy: HandAnatomy, angles_rad: FloatArray) -> FloatArray:
    """Centres of the paper discs on the skin, (..., 21, 3) in W.

    The discs of WRIST, CMC1 and MCP2 to MCP5 stay with the palm; MCP1 stays with the first metacarpal as those of
    the fingers stay with theirs; IP1, PIP and DIP stand on the bisector of the dorsal normals of the two segments
    that meet there; TIP stands on the normal of the last segment.
    """
    out = np.empty((*angles_rad.shape[:-1], 21, 3))
    out[..., _PALM, :] = anatomy.palm_disc_m
    thumb = _Thumb.at(anatomy, angles_rad)
    discs = thumb.joints + anatomy.thumb_offset_m[:, None] * thumb.disc_normals(angles_rad[..., 4])
    out[..., 2:5, :] = anatomy.palm_joint_m[1] + discs @ thumb.metacarpal
    finger = _Finger.at(anatomy, angles_rad)
    along = finger.along + anatomy.finger_offset_m * np.sin(finger.disc_pitch)
    up = finger.up + anatomy.finger_offset_m * np.cos(finger.disc_pitch)
    _put_fingers(out, anatomy, finger, along, up)
    return _on_its_side(anatomy, out)


def segment_frames(anatomy: HandAnatomy, angles_rad: FloatArray) -> SegmentFrames:
    """Start, end and dorsal normal of the palm and of every bone of the fingers."""
    shape = angles_rad.shape[:-1]
    joints = joint_centres(anatomy, angles_rad)
    start, end = np.empty((*shape, 16, 3)), np.empty((*shape, 16, 3))
    wrist, mcp3 = HAND21.markers.index("WRIST"), HAND21.markers.index("MCP3")
    start[..., 0, :], end[..., 0, :] = joints[..., wrist, :], joints[..., mcp3, :]
    start[..., 1:4, :], end[..., 1:4, :] = joints[..., 1:4, :], joints[..., 2:5, :]
    rays = joints[..., 5:, :].reshape(*shape, 4, 4, 3)
    start[..., 4:, :] = rays[..., :3, :].reshape(*shape, 12, 3)
    end[..., 4:, :] = rays[..., 1:, :].reshape(*shape, 12, 3)

    normal = np.empty((*shape, 16, 3))
    normal[..., 0, :] = (0.0, 0.0, 1.0)
    thumb = _Thumb.at(anatomy, angles_rad)
    normal[..., 1:4, :] = thumb.normals @ thumb.metacarpal
    finger = _Finger.at(anatomy, angles_rad)
    sine = np.sin(finger.pitch)
    dorsal = np.stack((finger.cos_azimuth * sine, finger.sin_azimuth * sine, np.cos(finger.pitch)), axis=-1)
    normal[..., 4:, :] = dorsal.reshape(*shape, 12, 3)
    return SegmentFrames(start, end, _on_its_side(anatomy, normal))


@dataclass(frozen=True, slots=True)
class _Finger:
    """Fingers 2 to 5 in their own planes, arrays (..., 4, 1) and (..., 4, 3 segments).

    ``pitch`` of each segment below the palm plane; ``along`` and ``up`` the ends of the segments from the MCP joint;
    ``disc_pitch`` pitch of the bisectors on which PIP and DIP discs stand, and of the last segment for TIP.
    """

    cos_azimuth: FloatArray
    sin_azimuth: FloatArray
    pitch: FloatArray
    disc_pitch: FloatArray
    along: FloatArray
    up: FloatArray

    @staticmethod
    def at(anatomy: HandAnatomy, angles_rad: FloatArray) -> _Finger:
        per_finger = (angles_rad.shape[-1] - 5) // 4
        angles = angles_rad[..., 5:].reshape(*angles_rad.shape[:-1], 4, per_finger)
        azimuth = (anatomy.fan_rad[1:] + angles[..., 0])[..., None]
        pip = angles[..., 2]
        dip = angles[..., 3] if per_finger == 4 else DIP_PER_PIP * pip
        pitch, disc_pitch = np.empty((2, *angles.shape[:-1], 3))
        pitch[..., 0] = angles[..., 1]
        pitch[..., 1] = pitch[..., 0] + pip
        pitch[..., 2] = pitch[..., 1] + dip
        disc_pitch[..., :2] = 0.5 * (pitch[..., :2] + pitch[..., 1:])
        disc_pitch[..., 2] = pitch[..., 2]
        along = np.cumsum(anatomy.finger_length_m * np.cos(pitch), axis=-1)
        up = -np.cumsum(anatomy.finger_length_m * np.sin(pitch), axis=-1)
        return _Finger(np.cos(azimuth), np.sin(azimuth), pitch, disc_pitch, along, up)


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
    def at(anatomy: HandAnatomy, angles_rad: FloatArray) -> _Thumb:
        turned = angles_rad[..., :5] + (anatomy.fan_rad[0], 0.0, 0.0, 0.0, 0.0)
        c0, c1, c2, c3, c4 = np.moveaxis(np.cos(turned), -1, 0)
        s0, s1, s2, s3, s4 = np.moveaxis(np.sin(turned), -1, 0)
        ct, st = np.cos(anatomy.thumb_roll_rad), np.sin(anatomy.thumb_roll_rad)

        # Rows 1 and 2 of the table: swing in the palm plane, palmar abduction, roll by tau.
        metacarpal = np.empty((*angles_rad.shape[:-1], 3, 3))
        metacarpal[..., 0, 0], metacarpal[..., 0, 1], metacarpal[..., 0, 2] = c1 * c0, c1 * s0, -s1
        metacarpal[..., 1, 0] = ct * s1 * c0 - st * s0
        metacarpal[..., 1, 1] = ct * s1 * s0 + st * c0
        metacarpal[..., 1, 2] = ct * c1
        metacarpal[..., 2, 0] = -ct * s0 - st * s1 * c0
        metacarpal[..., 2, 1] = ct * c0 - st * s1 * s0
        metacarpal[..., 2, 2] = -st * c1

        # Rows 3 to 5: MCP flexion, MCP abduction about the new dorsal normal, IP flexion.
        x, y, z = c2 * c3, -s2 * c3, s3  # direction of PP1
        normals = np.zeros((*angles_rad.shape[:-1], 3, 3))
        normals[..., 0, 1] = 1.0
        normals[..., 1, 0], normals[..., 1, 1] = s2, c2
        normals[..., 2, 0], normals[..., 2, 1], normals[..., 2, 2] = s4 * x + c4 * s2, s4 * y + c4 * c2, s4 * z

        mc, pp, dp = anatomy.thumb_length_m
        joints = np.zeros((*angles_rad.shape[:-1], 3, 3))
        joints[..., 0, 0] = mc
        joints[..., 1, 0], joints[..., 1, 1], joints[..., 1, 2] = mc + pp * x, pp * y, pp * z
        joints[..., 2, 0] = joints[..., 1, 0] + dp * (c4 * x - s4 * s2)
        joints[..., 2, 1] = joints[..., 1, 1] + dp * (c4 * y - s4 * c2)
        joints[..., 2, 2] = joints[..., 1, 2] + dp * c4 * z
        return _Thumb(metacarpal, joints, normals)

    def disc_normals(self, ip_flexion_rad: FloatArray) -> FloatArray:
        """Normals on which the discs MCP1, IP1, TIP1 stand, (..., 3, 3) in the axes of the metacarpal."""
        normals = self.normals.copy()
        half = 0.5 / np.cos(0.5 * ip_flexion_rad)[..., None]
        normals[..., 1, :] = half * (normals[..., 1, :] + normals[..., 2, :])
        return normals


def _put_fingers(out: FloatArray, anatomy: HandAnatomy, finger: _Finger, along: FloatArray, up: FloatArray) -> None:
    """Write PIP, DIP, TIP of fingers 2 to 5 from their places in the finger's plane (..., 4, 3)."""
    rays = out[..., 5:, :].reshape(*out.shape[:-2], 4, 4, 3)[..., 1:, :]
    knuckle = anatomy.palm_joint_m[2:, None, :]
    rays[..., 0] = knuckle[..., 0] + finger.cos_azimuth * along
    rays[..., 1] = knuckle[..., 1] + finger.sin_azimuth * along
    rays[..., 2] = knuckle[..., 2] + up


def _on_its_side(anatomy: HandAnatomy, vectors: FloatArray) -> FloatArray:
    if anatomy.side == "left":
        vectors[..., 1] *= -1.0
    return vectors
