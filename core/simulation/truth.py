"""The true values of a simulated recording, one row for every frame that was kept."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from core.camera import Camera
from core.hand.protocols import HAND21
from core.simulation.scene import HandPose, Scene
from core.simulation.spec import RecordingSpec
from core.simulation.trouble import FrameTimes, frame_times
from core.types import FloatArray

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
    """Rows of ``hand21`` that the protocol of a spec has, in its order."""
    return [HAND21.markers.index(name) for name in spec.marker_protocol.markers]


def truth_of(scene: Scene, times: FrameTimes | None = None) -> Truth:
    """True values at the colour pictures' times; velocities are derivatives of the motion, not differences of
    frames."""
    spec = scene.spec
    times = frame_times(spec) if times is None else times
    t = times.color_s
    pose, before, after = scene.pose(t), scene.pose(t - _STEP_S), scene.pose(t + _STEP_S)
    rows = protocol_rows(spec)
    discs_w0 = scene.discs_w0_m(pose)[:, rows]
    discs_cam = scene.to_camera(discs_w0)
    fingers = spec.marker_protocol.has_fingers
    joint_velocity = (after.joint_angles_rad - before.joint_angles_rad) / (2.0 * _STEP_S)
    empty = np.empty((len(t), 0))
    return Truth(
        spec=spec,
        camera=scene.camera,
        timestamp_s=np.round(RECORDING_EPOCH_S + t, 6),
        time_s=t,
        dropped_before=times.dropped_before,
        position_m=pose.position_m,
        velocity_m_s=(after.position_m - before.position_m) / (2.0 * _STEP_S),
        rotation_w2_w0=pose.rotation_w2_w0,
        angular_velocity_rad_s=_turn_rate(before, after),
        angles_rad=pose.angles_rad,
        joint_names=scene.motion.joint_names if fingers else (),
        joint_angles_rad=pose.joint_angles_rad if fingers else empty,
        joint_velocity_rad_s=joint_velocity if fingers else empty,
        joint_position_w0_m=scene.joints_w0_m(pose)[:, rows],
        disc_position_cam_m=discs_cam,
        disc_pixel=scene.camera.project(discs_cam),
        visible_share=np.full((len(t), len(rows)), np.nan),
        marker_position_w0_m=scene.discs_w0_m(scene.pose(np.zeros(1)))[0, rows],
        rotation_w0_cam=scene.rotation_w0_cam,
        translation_w0_cam_m=scene.translation_w0_cam_m,
    )


def _turn_rate(before: HandPose, after: HandPose) -> FloatArray:
    """Angular velocity in W2 from two rotations a small step apart; (N, 3) rad/s."""
    turn = before.rotation_w2_w0.transpose(0, 2, 1) @ after.rotation_w2_w0
    skew = 0.5 * (turn - turn.transpose(0, 2, 1))
    return np.asarray(np.stack((skew[:, 2, 1], skew[:, 0, 2], skew[:, 1, 0]), axis=-1) / (2.0 * _STEP_S))
