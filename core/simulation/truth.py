"""The true values of a simulated recording, one row for every frame that was kept."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from carpus.core.camera import Camera
from carpus.core.hand.clinical_angles import angles_from_rotation
from carpus.core.simulation.scene import HandPose, Scene
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.simulation.trouble import FrameTimes, frame_times
from carpus.core.types import FloatArray, Side

RECORDING_EPOCH_S = 1_700_000_000.0
"""Time stamps of a recording start here, as of a real one: large numbers, not zero."""

_STEP_S = 1e-4


@dataclass(frozen=True, slots=True)
class Truth:
    """N frames, M markers of the protocol, J finger angles (0 for ``wrist6``).

    ``timestamp_s`` (N,) as in the recording and ``time_s`` (N,) after its first frame; ``position_m``,
    ``velocity_m_s`` (N, 3) of W2 in W0; ``rotation_w2_w0`` (N, 3, 3); ``angular_velocity_rad_s`` (N, 3) in W2;
    ``angles_rad`` (N, 3) deviation, flexion, pronosupination; ``joint_angles_rad``, ``joint_velocity_rad_s`` (N, J);
    ``joint_position_w0_m``, ``disc_position_cam_m`` (N, M, 3); ``disc_pixel`` (N, M, 2) their projection;
    ``visible_share`` (N, M) of each disc's paper area that the camera sees, NaN where nothing was rendered;
    ``dropped_before`` (N,). Neutral pose: ``marker_position_w0_m`` (M, 3), ``rotation_w0_cam`` (3, 3),
    ``translation_w0_cam_m`` (3,).
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
    disc_position_cam_m: FloatArray
    disc_pixel: FloatArray
    visible_share: FloatArray
    marker_position_w0_m: FloatArray
    rotation_w0_cam: FloatArray
    translation_w0_cam_m: FloatArray


def protocol_rows(spec: RecordingSpec) -> list[int]:
    """Rows of the sites that the protocol of a spec uses, in its order."""
    return list(spec.marker_protocol.sites)


def truth_of(scene: Scene, times: FrameTimes | None = None) -> Truth:
    """True values at the colour pictures' times; velocities are derivatives of the motion, not differences of
    frames."""
    spec = scene.spec
    times = frame_times(spec) if times is None else times
    t = times.color_s
    axes, origin = scene.disc_frame()
    pose = scene.pose(t)
    now, before, after = (
        _in_frame(at, axes, origin, spec.hand) for at in (pose, scene.pose(t - _STEP_S), scene.pose(t + _STEP_S))
    )
    rows = protocol_rows(spec)
    discs_cam = scene.to_camera(scene.discs_w0_m(pose)[:, rows])
    joint_names = spec.marker_protocol.joint_names(spec.dip == "free")
    columns = [scene.motion.joint_names.index(name) for name in joint_names]
    joint_velocity = (after.joint_angles_rad - before.joint_angles_rad) / (2.0 * _STEP_S)
    return Truth(
        spec=spec,
        camera=scene.camera,
        timestamp_s=np.round(RECORDING_EPOCH_S + t, 6),
        time_s=t,
        dropped_before=times.dropped_before,
        position_m=now.position_m,
        velocity_m_s=(after.position_m - before.position_m) / (2.0 * _STEP_S),
        rotation_w2_w0=now.rotation_w2_w0,
        angular_velocity_rad_s=_turn_rate(before, after),
        angles_rad=now.angles_rad,
        joint_names=joint_names,
        joint_angles_rad=pose.joint_angles_rad[:, columns],
        joint_velocity_rad_s=joint_velocity[:, columns],
        joint_position_w0_m=(scene.joints_w0_m(pose)[:, rows] - origin) @ axes,
        disc_position_cam_m=discs_cam,
        disc_pixel=scene.camera.project(discs_cam),
        visible_share=np.full((len(t), len(rows)), np.nan),
        marker_position_w0_m=(scene.discs_w0_m(scene.pose(np.zeros(1)))[0, rows] - origin) @ axes,
        rotation_w0_cam=scene.rotation_w0_cam @ axes,
        translation_w0_cam_m=scene.to_camera(origin),
    )


def _in_frame(pose: HandPose, axes: FloatArray, origin_m: FloatArray, side: Side) -> HandPose:
    """The pose told in another W, given by axes and origin in the bones' W."""
    if not origin_m.any():
        return pose
    rotation = axes.T @ pose.rotation_w2_w0 @ axes
    position = (pose.rotation_w2_w0 @ origin_m + pose.position_m - origin_m) @ axes
    angles = angles_from_rotation(rotation, side)
    return replace(pose, rotation_w2_w0=rotation, position_m=position, angles_rad=angles)


def _turn_rate(before: HandPose, after: HandPose) -> FloatArray:
    """Angular velocity in W2 from two rotations a small step apart; (N, 3) rad/s."""
    turn = before.rotation_w2_w0.transpose(0, 2, 1) @ after.rotation_w2_w0
    skew = 0.5 * (turn - turn.transpose(0, 2, 1))
    return np.asarray(np.stack((skew[:, 2, 1], skew[:, 0, 2], skew[:, 1, 0]), axis=-1) / (2.0 * _STEP_S))
