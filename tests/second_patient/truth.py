"""The true values, and the session file that holds them (interface 4)."""

from __future__ import annotations

import json
import uuid
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

import h5py
import numpy as np
from numpy.typing import NDArray

from carpus.core.calibration.result import Calibration, Clicks, Verdict
from carpus.core.model.camera import Camera
from carpus.core.model.hand.protocols import MarkerProtocol, get_protocol
from carpus.core.model.types import Detections, FloatArray, KinematicState, Side, TrackedFrame, TrackStatus
from carpus.core.session.values import new_header
from carpus.core.session.writer import SessionWriter
from tests.second_patient.camera import Hung
from tests.second_patient.discs import NAMES
from tests.second_patient.motions import Motion, Row
from tests.second_patient.patient import Patient, frame_of_discs
from tests.second_patient.skeleton import Bone, Placed

VISIBLE_SHARE = "/simulation/visible_share"
SEEN_SHARE = 0.35
_PALM_NEEDED = 3
_STEP_S = 1e-3
_LEAST_BETA_RAD = np.radians(3.0)


@dataclass(frozen=True, slots=True, repr=False)
class Truth:
    """N frames, M discs of the protocol, 21 finger angles (0 with ``wrist6``).

    The wrist is the fixed unit (capitate, metacarpals 2 and 3), its neutral pose the first frame; W0 stands on the
    discs of that frame. ``position_m`` (N, 3) of the WRIST disc and ``rotation_w2_w0`` (N, 3, 3) of the bones;
    ``angles_rad`` (N, 3) clinical; ``joint_angles_rad`` (N, J) of the bones, those of ring and little finger against
    their own metacarpals; ``disc_position_cam_m`` (N, M, 3) centres on the skin; ``disc_pixel`` (N, M, 2) as a lens
    without distortion sees them; ``visible_share`` (N, M); ``cup_rad`` (N, 2) flexion of metacarpals 4 and 5.
    """

    side: Side
    protocol: MarkerProtocol
    camera: Camera
    timestamp_s: FloatArray
    position_m: FloatArray
    velocity_m_s: FloatArray
    rotation_w2_w0: FloatArray
    angular_velocity_rad_s: FloatArray
    angles_rad: FloatArray
    joint_angles_rad: FloatArray
    joint_velocity_rad_s: FloatArray
    joint_position_w0_m: FloatArray
    disc_position_cam_m: FloatArray
    disc_pixel: FloatArray
    visible_share: FloatArray
    cup_rad: FloatArray
    marker_position_w0_m: FloatArray
    rotation_w0_cam: FloatArray
    translation_w0_cam_m: FloatArray


def truth_of(row: Row, patient: Patient, motion: Motion, hung: Hung, time_s: FloatArray, stamp_s: FloatArray) -> Truth:
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
    before, after = (motion.at(time_s + step) for step in (-_STEP_S, _STEP_S))
    velocity = (patient.discs_m(after, [wrist]) - patient.discs_m(before, [wrist]))[:, 0] / (2.0 * _STEP_S)
    swing = np.swapaxes(_fixed(patient, patient.placed(before)), 1, 2) @ _fixed(patient, patient.placed(after))
    spin = np.stack(
        (swing[:, 2, 1] - swing[:, 1, 2], swing[:, 0, 2] - swing[:, 2, 0], swing[:, 1, 0] - swing[:, 0, 1]), 1
    )
    spin = spin / (4.0 * _STEP_S) @ (turn0.T @ axes)
    has_fingers = protocol.has_fingers
    cam = hung.to_camera(disc[:, rows])
    empty = np.empty((len(time_s), 0))
    return Truth(
        side=patient.side,
        protocol=protocol,
        camera=hung.camera,
        timestamp_s=stamp_s,
        position_m=(disc[:, wrist] - disc0[wrist]) @ axes,
        velocity_m_s=velocity @ axes,
        rotation_w2_w0=rotation,
        angular_velocity_rad_s=spin,
        angles_rad=clinical(rotation, patient.side),
        joint_angles_rad=posture.fingers if has_fingers else empty,
        joint_velocity_rad_s=(after.fingers - before.fingers) / (2.0 * _STEP_S) if has_fingers else empty,
        joint_position_w0_m=(joint_centres(patient, placed)[:, rows] - disc0[wrist]) @ axes,
        disc_position_cam_m=cam,
        disc_pixel=hung.camera.project(cam),
        visible_share=np.full((len(time_s), len(rows)), np.nan),
        cup_rad=posture.cup[:, None] * patient.person.cup_rad,
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


def _zyz(rotation: FloatArray) -> FloatArray:
    """ZYZ angles (3,) of the first paper, NaN near the neutral pose."""
    beta = np.arccos(np.clip(rotation[2, 2], -1.0, 1.0))
    if beta < _LEAST_BETA_RAD:
        return np.full(3, np.nan)
    return np.array([np.arctan2(rotation[1, 2], rotation[0, 2]), beta, np.arctan2(rotation[2, 1], -rotation[2, 0])])


def write_truth(path: Path, truth: Truth, clicks_px: FloatArray, told: dict[str, object]) -> None:
    """Write a session file of true values; ``told`` says what was simulated."""
    parameters = json.dumps({"second_patient": told})
    header = new_header(
        hand=truth.side,
        protocol=truth.protocol,
        exercise=str(told["row"]),
        parameters=parameters,
        dip_free=True,
        now=datetime.fromtimestamp(float(truth.timestamp_s[0]), UTC),
        session_id=uuid.uuid5(uuid.NAMESPACE_OID, parameters + truth.side),
    )
    markers = len(truth.marker_position_w0_m)
    calibration = Calibration(
        clicks=Clicks(truth.side, truth.protocol, clicks_px),
        marker_position_w0_m=truth.marker_position_w0_m,
        rotation_w0_cam=truth.rotation_w0_cam,
        translation_w0_cam_m=truth.translation_w0_cam_m,
        marker_covariance_w0_m2=np.zeros((markers, 3, 3)),
        start_angles_rad=np.zeros(3),
        verdict=Verdict(
            residual_mm=np.zeros(markers),
            hand_length_mm=float("nan"),
            tilt_deg=float(np.degrees(np.arccos(min(1.0, abs(float(truth.rotation_w0_cam[2, 2])))))),
            distance_m=float(truth.translation_w0_cam_m[2]),
            frames_used=1,
            findings=(),
        ),
    )
    with SessionWriter.create(path, header, truth.camera, calibration) as writer:
        for i in range(len(truth.timestamp_s)):
            writer.append(_row(truth, i))
    with h5py.File(path, "r+") as file:
        for name, data, unit, text in (
            (VISIBLE_SHARE, truth.visible_share, "1", "share of each disc's paper that the camera sees"),
            ("/simulation/cup", truth.cup_rad, "rad", "flexion of metacarpals 4 and 5 against the fixed unit"),
        ):
            dataset = file.create_dataset(name, data=data)
            dataset.attrs["unit"], dataset.attrs["description"] = unit, text
        file[VISIBLE_SHARE].attrs["names"] = list(truth.protocol.markers)


def read_visible_share(path: Path) -> FloatArray:
    """(N, M) as :func:`write_truth` stored it."""
    with h5py.File(path, "r") as file:
        return np.asarray(file[VISIBLE_SHARE][()], dtype=np.float64)


def seen(truth: Truth) -> NDArray[np.bool_]:
    """Which discs (N, M) the camera sees well enough to measure."""
    return np.asarray(truth.visible_share > SEEN_SHARE)


def _row(truth: Truth, i: int) -> TrackedFrame:
    visible = seen(truth)[i]
    joints = truth.joint_angles_rad.shape[1]
    palm = int(visible[list(truth.protocol.palm)].sum())
    return TrackedFrame(
        index=i,
        timestamp_s=float(truth.timestamp_s[i]),
        status=TrackStatus.TRACKED if palm >= _PALM_NEEDED else TrackStatus.PREDICTED,
        kinematics=KinematicState(
            position_m=truth.position_m[i],
            velocity_m_s=truth.velocity_m_s[i],
            w0_turn_rad=np.zeros(3),
            rotation_w2_w0=truth.rotation_w2_w0[i],
            angular_velocity_rad_s=truth.angular_velocity_rad_s[i],
            angles_rad=truth.angles_rad[i],
            angles_sd_rad=np.zeros(3),
            angles_zyz_rad=_zyz(truth.rotation_w2_w0[i]),
            joint_angles_rad=truth.joint_angles_rad[i],
            joint_angles_sd_rad=np.zeros(joints),
            joint_velocity_rad_s=truth.joint_velocity_rad_s[i],
            joint_position_m=truth.joint_position_w0_m[i],
        ),
        marker_position_cam_m=truth.disc_position_cam_m[i],
        marker_predicted_px=truth.disc_pixel[i],
        marker_predicted_cov_px2=np.zeros((len(visible), 2, 2)),
        marker_measured_px=np.where(visible[:, None], truth.camera.distort(truth.disc_pixel[i]), np.nan),
        marker_measured_depth_m=np.where(visible, truth.disc_position_cam_m[i, :, 2], np.nan),
        detections=Detections.none(),
        dropped_before=0,
        measured_share=np.full(joints or 3, np.nan),
        nis=float("nan"),
        nis_dof=0,
    )
