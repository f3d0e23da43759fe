"""The true values of a take."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from carpus.core.model.camera import Camera
from carpus.core.model.hand.protocols import MarkerProtocol, get_protocol
from carpus.core.model.types import FloatArray, Side
from tests.second_patient.camera import Hung
from tests.second_patient.discs import NAMES
from tests.second_patient.motions import Motion, Row
from tests.second_patient.patient import Patient, frame_of_discs
from tests.second_patient.skeleton import Bone, Placed


@dataclass(frozen=True, slots=True, repr=False)
class Truth:
    """N frames, M discs of the protocol, 21 finger angles (0 with ``wrist6``).

    The wrist is the fixed unit (capitate, metacarpals 2 and 3), its neutral pose the first frame; W0 stands on the
    discs of that frame. ``position_m`` (N, 3) of the WRIST disc and ``rotation_w2_w0`` (N, 3, 3) of the bones;
    ``angles_rad`` (N, 3) clinical; ``joint_angles_rad`` (N, J) of the bones, those of ring and little finger against
    their own metacarpals; ``disc_position_cam_m`` (N, M, 3) centres on the skin; ``disc_pixel`` (N, M, 2) as a lens
    without distortion sees them; ``visible_share`` (N, M) of each disc's paper.
    """

    side: Side
    protocol: MarkerProtocol
    camera: Camera
    timestamp_s: FloatArray
    position_m: FloatArray
    rotation_w2_w0: FloatArray
    angles_rad: FloatArray
    joint_angles_rad: FloatArray
    joint_position_w0_m: FloatArray
    disc_position_cam_m: FloatArray
    disc_pixel: FloatArray
    visible_share: FloatArray
    marker_position_w0_m: FloatArray
    rotation_w0_cam: FloatArray
    translation_w0_cam_m: FloatArray


def compute_truth(
    row: Row, patient: Patient, motion: Motion, hung: Hung, time_s: FloatArray, stamp_s: FloatArray
) -> Truth:
    """True values at times (N,) after the first; nothing is rendered, so what is visible is still unknown."""
    protocol = get_protocol(row.protocol)
    rows = [NAMES.index(name) for name in protocol.markers]
    posture = motion.at(time_s)
    placed = patient.placed(posture)
    disc = patient.discs_m(posture)
    turn0 = _fixed(patient, placed)[0]
    disc0 = patient.discs_m(motion.at(np.zeros(1)))[0]
    axes = frame_of_discs(disc0, turn0[:, 2])
    wrist = NAMES.index("WRIST")
    rotation = axes.T @ _fixed(patient, placed) @ turn0.T @ axes
    cam = hung.to_camera(disc[:, rows])
    return Truth(
        side=patient.side,
        protocol=protocol,
        camera=hung.camera,
        timestamp_s=stamp_s,
        position_m=(disc[:, wrist] - disc0[wrist]) @ axes,
        rotation_w2_w0=rotation,
        angles_rad=clinical(rotation, patient.side),
        joint_angles_rad=posture.fingers if protocol.has_fingers else np.empty((len(time_s), 0)),
        joint_position_w0_m=(joint_centres(patient, placed)[:, rows] - disc0[wrist]) @ axes,
        disc_position_cam_m=cam,
        disc_pixel=hung.camera.project(cam),
        visible_share=np.full((len(time_s), len(rows)), np.nan),
        marker_position_w0_m=(disc0[rows] - disc0[wrist]) @ axes,
        rotation_w0_cam=hung.turn @ axes,
        translation_w0_cam_m=hung.to_camera(disc0[wrist]),
    )


def _fixed(patient: Patient, placed: Placed) -> FloatArray:
    """Turns (N, 3, 3) of the fixed unit in the room, mirrored for a left hand."""
    mirror = np.diag(patient.mirror)
    return mirror @ placed.turn[:, Bone.FIXED] @ mirror


def joint_centres(patient: Patient, placed: Placed) -> FloatArray:
    """Joint centres under the discs and the ends of the last links, in the room (N, 21, 3): the last link ends under
    the disc on the nail."""
    person = patient.person
    out = np.empty((len(placed.turn), len(NAMES), 3))
    joint = placed.joint_m
    out[:, 0] = joint[:, Bone.FIXED]
    out[:, 1:4] = joint[:, Bone.MC1 : Bone.MC1 + 3]
    out[:, 4] = joint[:, Bone.DP1] + 0.8 * person.thumb_m[2] * placed.turn[:, Bone.DP1, :, 0]
    for ray in range(4):
        first = Bone.PP2 + 3 * ray
        out[:, 5 + 4 * ray : 8 + 4 * ray] = joint[:, first : first + 3]
        out[:, 8 + 4 * ray] = joint[:, first + 2] + 0.74 * person.finger_m[ray, 2] * placed.turn[:, first + 2, :, 0]
    return patient.mirror * out


def clinical(rotation: FloatArray, side: Side) -> FloatArray:
    """Deviation, flexion, pro-supination (N, 3) of rotations (N, 3, 3), + radial, + flexion, + supination."""
    sign = 1.0 if side == "right" else -1.0
    return np.stack(
        (
            sign * np.arctan2(rotation[:, 1, 0], rotation[:, 0, 0]),
            np.arcsin(np.clip(-rotation[:, 2, 0], -1.0, 1.0)),
            sign * np.arctan2(rotation[:, 2, 1], rotation[:, 2, 2]),
        ),
        axis=1,
    )
