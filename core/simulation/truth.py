"""True values of a simulated recording, stored as a session file ``truth.h5``."""

from __future__ import annotations

import math
import uuid
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import Path

import h5py
import numpy as np
from numpy.typing import NDArray

from carpus.core.calibration.result import Calibration, Clicks, Verdict
from carpus.core.model.camera import Camera
from carpus.core.model.hand.clinical_angles import angles_from_rotation, compute_wrist_angles
from carpus.core.model.types import Detections, FloatArray, KinematicState, Side, TrackedFrame, TrackStatus
from carpus.core.session.values import new_header
from carpus.core.session.writer import SessionWriter
from carpus.core.simulation.disturbances import FrameTimes, sample_frame_times
from carpus.core.simulation.scene import HandPose, Scene
from carpus.core.simulation.spec import RecordingSpec

RECORDING_EPOCH_S = 1_700_000_000.0
"""First timestamp of a recording: large, as that of a real one."""

_STEP_S = 1e-4


@dataclass(frozen=True, slots=True)
class Truth:
    """True values of N frames, M markers of the protocol and J finger angles (0 for ``wrist6``).

    Attributes
    ----------
    timestamp_s, time_s : (N,) as in the recording, and after its first frame
    dropped_before : (N,) frames dropped before each frame
    position_m, velocity_m_s : (N, 3) of W2 in W0
    rotation_w2_w0 : (N, 3, 3)
    angular_velocity_rad_s : (N, 3) in W2
    angles_rad : (N, 3) deviation, flexion, pronosupination
    joint_angles_rad, joint_velocity_rad_s : (N, J)
    joint_position_w0_m, marker_position_cam_m : (N, M, 3)
    marker_px : (N, M, 2) projection of the markers
    visible_share : (N, M) of each marker's paper area, NaN where nothing was rendered
    marker_position_w0_m : (M, 3) at the neutral pose
    rotation_w0_cam, translation_w0_cam_m : (3, 3), (3,) neutral pose
    """

    spec: RecordingSpec
    camera: Camera
    timestamp_s: FloatArray
    time_s: FloatArray
    dropped_before: NDArray[np.int64]
    position_m: FloatArray
    velocity_m_s: FloatArray
    rotation_w2_w0: FloatArray
    angular_velocity_rad_s: FloatArray
    angles_rad: FloatArray
    joint_names: tuple[str, ...]
    joint_angles_rad: FloatArray
    joint_velocity_rad_s: FloatArray
    joint_position_w0_m: FloatArray
    marker_position_cam_m: FloatArray
    marker_px: FloatArray
    visible_share: FloatArray
    marker_position_w0_m: FloatArray
    rotation_w0_cam: FloatArray
    translation_w0_cam_m: FloatArray


def compute_truth(scene: Scene, times: FrameTimes | None = None) -> Truth:
    """Compute the true values at the colour images' times; velocities are derivatives of the motion."""
    spec = scene.spec
    times = sample_frame_times(spec) if times is None else times
    t = times.color_s
    axes, origin = scene.marker_frame()
    pose = scene.pose(t)
    current, before, after = (
        _change_frame(at, axes, origin, spec.hand) for at in (pose, scene.pose(t - _STEP_S), scene.pose(t + _STEP_S))
    )
    turn = before.rotation_w2_w0.transpose(0, 2, 1) @ after.rotation_w2_w0
    skew = 0.5 * (turn - turn.transpose(0, 2, 1))
    rows = list(spec.marker_protocol.sites)
    markers_cam = scene.to_camera(scene.markers_w0_m(pose)[:, rows])
    joint_names = spec.marker_protocol.joint_names(spec.dip == "free")
    columns = [scene.motion.joint_names.index(name) for name in joint_names]
    joint_velocity = (after.joint_angles_rad - before.joint_angles_rad) / (2.0 * _STEP_S)
    return Truth(
        spec=spec,
        camera=scene.camera,
        timestamp_s=np.round(RECORDING_EPOCH_S + t, 6),
        time_s=t,
        dropped_before=times.dropped_before,
        position_m=current.position_m,
        velocity_m_s=(after.position_m - before.position_m) / (2.0 * _STEP_S),
        rotation_w2_w0=current.rotation_w2_w0,
        angular_velocity_rad_s=np.stack((skew[:, 2, 1], skew[:, 0, 2], skew[:, 1, 0]), axis=-1) / (2.0 * _STEP_S),
        angles_rad=current.angles_rad,
        joint_names=joint_names,
        joint_angles_rad=pose.joint_angles_rad[:, columns],
        joint_velocity_rad_s=joint_velocity[:, columns],
        joint_position_w0_m=(scene.joints_w0_m(pose)[:, rows] - origin) @ axes,
        marker_position_cam_m=markers_cam,
        marker_px=scene.camera.project(markers_cam),
        visible_share=np.full((len(t), len(rows)), np.nan),
        marker_position_w0_m=(scene.markers_w0_m(scene.pose(np.zeros(1)))[0, rows] - origin) @ axes,
        rotation_w0_cam=scene.rotation_w0_cam @ axes,
        translation_w0_cam_m=scene.to_camera(origin),
    )


def _change_frame(pose: HandPose, axes: FloatArray, origin_m: FloatArray, side: Side) -> HandPose:
    """Express a pose in another W, given by its axes and origin in the bones' W."""
    if not origin_m.any():
        return pose
    rotation = axes.T @ pose.rotation_w2_w0 @ axes
    position = (pose.rotation_w2_w0 @ origin_m + pose.position_m - origin_m) @ axes
    angles = angles_from_rotation(rotation, side)
    return replace(pose, rotation_w2_w0=rotation, position_m=position, angles_rad=angles)


MIN_VISIBLE_SHARE = 0.35
"""A marker with a smaller visible share is not measured."""
VISIBLE_SHARE_PATH = "/simulation/visible_share"
_MIN_PALM_MARKERS = 3


def write_truth(path: Path, truth: Truth, clicks: Clicks) -> None:
    """Write the true values as a session file, reproducible byte for byte.

    ``parameters`` is the JSON of the spec, standard deviations are zero, and the visible markers are measured.
    """
    spec = truth.spec
    header = new_header(
        hand=spec.hand,
        protocol=spec.marker_protocol,
        exercise=spec.motion,
        parameters=spec.to_json(),
        dip_free=spec.dip == "free",
        now=datetime.fromtimestamp(float(truth.timestamp_s[0]), UTC),
        session_id=uuid.uuid5(uuid.NAMESPACE_OID, spec.to_json()),
    )
    with SessionWriter.create(path, header, truth.camera, _true_calibration(truth, clicks)) as writer:
        for i in range(len(truth.timestamp_s)):
            writer.append(_true_frame(truth, i))
    with h5py.File(path, "r+") as file:
        dataset = file.create_dataset(VISIBLE_SHARE_PATH, data=truth.visible_share)
        dataset.attrs["unit"] = "1"
        dataset.attrs["description"] = "share of each disc's paper that the camera sees"
        dataset.attrs["names"] = list(spec.marker_protocol.markers)


def _true_calibration(truth: Truth, clicks: Clicks) -> Calibration:
    normal = truth.rotation_w0_cam[:, 2]
    verdict = Verdict(
        residual_mm=np.zeros(len(truth.marker_position_w0_m)),
        hand_length_mm=float("nan"),
        tilt_deg=math.degrees(math.acos(min(1.0, abs(float(normal[2]))))),
        distance_m=float(truth.translation_w0_cam_m[2]),
        frames_used=1,
        findings=(),
    )
    return Calibration(
        clicks=clicks,
        marker_position_w0_m=truth.marker_position_w0_m,
        rotation_w0_cam=truth.rotation_w0_cam,
        translation_w0_cam_m=truth.translation_w0_cam_m,
        marker_covariance_w0_m2=np.zeros((len(truth.marker_position_w0_m), 3, 3)),
        start_angles_rad=np.zeros(3),
        verdict=verdict,
    )


def _true_frame(truth: Truth, i: int) -> TrackedFrame:
    spec = truth.spec
    joints = truth.joint_angles_rad.shape[1]
    visible = truth.visible_share[i] > MIN_VISIBLE_SHARE
    pixel = np.where(visible[:, None], truth.marker_px[i], np.nan)
    depth = np.where(visible, truth.marker_position_cam_m[i, :, 2], np.nan)
    palm_seen = int(visible[list(spec.marker_protocol.palm)].sum())
    return TrackedFrame(
        index=i,
        timestamp_s=float(truth.timestamp_s[i]),
        status=TrackStatus.TRACKED if palm_seen >= _MIN_PALM_MARKERS else TrackStatus.PREDICTED,
        kinematics=KinematicState(
            position_m=truth.position_m[i],
            velocity_m_s=truth.velocity_m_s[i],
            w0_turn_rad=np.zeros(3),
            rotation_w2_w0=truth.rotation_w2_w0[i],
            angular_velocity_rad_s=truth.angular_velocity_rad_s[i],
            angles_rad=truth.angles_rad[i],
            angles_sd_rad=np.zeros(3),
            angles_zyz_rad=compute_wrist_angles(truth.rotation_w2_w0[i], spec.hand)[2],
            joint_angles_rad=truth.joint_angles_rad[i],
            joint_angles_sd_rad=np.zeros(joints),
            joint_velocity_rad_s=truth.joint_velocity_rad_s[i],
            joint_position_m=truth.joint_position_w0_m[i],
        ),
        marker_position_cam_m=truth.marker_position_cam_m[i],
        marker_predicted_px=truth.marker_px[i],
        marker_measured_px=pixel,
        marker_measured_depth_m=depth,
        detections=Detections.none(),
        dropped_before=int(truth.dropped_before[i]),
        measured_share=np.full(joints or 3, np.nan),
        nis=float("nan"),
        nis_dof=0,
    )
