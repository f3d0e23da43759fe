"""Curves of the papers: path with the hand's axes, velocities, ZYZ angles and joint paths; also as a table.

Wrist paper, figures 3, 5 and 6; hand paper, figures 2 and 3. Positions in millimetres in W0, angles in degrees; unknown
is NaN, and unseen stretches are never filled in.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from carpus.core.measures.motion_range import flexion_weights
from carpus.core.measures.signals import BoolArray, valid_wrist_angles
from carpus.core.measures.wrist_centre import rotation_in_w0
from carpus.core.model.hand.clinical_angles import isb_from_rotation, zyz_with_sd
from carpus.core.model.hand.protocols import WRIST_ANGLES
from carpus.core.model.types import FloatArray, Side, TrackStatus
from carpus.core.results.measure import is_total_active_motion, wrist_angle_index
from carpus.core.results.ranges import flexion_joints
from carpus.core.results.valid_data import (
    JointCurves,
    clinical_angles_rad,
    joint_curves,
    motion_estimate,
    palm_in_view,
)
from carpus.core.session.values import Motion, Session


@dataclass(frozen=True, slots=True)
class MotionCurves:
    """Curves over N frames.

    ``time_s`` (N,) after the first frame; ``position_mm`` and ``velocity_mm_s`` (N, 3) of the wrist in W0;
    ``angular_velocity_deg_s`` (N, 3) about the hand's axes; ``axes`` (N, 3, 3), columns X, Y, Z of W2 in W0;
    ``zyz_deg`` and ``zyz_sd_deg`` (N, 3), ``zyz_sum_deg`` (N,) alpha + gamma; ``joint_mm`` (N, M, 3) joints and tips in
    W0, M = 0 for the wrist alone; ``is_joint_seen`` (N, M) the marker there has a blob.
    """

    side: Side
    time_s: FloatArray
    is_predicted: BoolArray
    position_mm: FloatArray
    velocity_mm_s: FloatArray
    angular_velocity_deg_s: FloatArray
    axes: FloatArray
    zyz_deg: FloatArray
    zyz_sd_deg: FloatArray
    zyz_sum_deg: FloatArray
    joint_names: tuple[str, ...]
    joint_mm: FloatArray
    is_joint_seen: BoolArray


def compute_motion_curves(session: Session, motion: Motion | None = None) -> MotionCurves:
    """Compute the curves, by default smoothed if there is a smoother's result; NaN where the hand was lost."""
    motion, side = motion or motion_estimate(session), session.header.hand
    count = motion.joint_position_m.shape[1]
    zyz, sd, total = zyz_with_sd(motion.rotation_w2_w0, motion.angles_sd_rad, side)
    return MotionCurves(
        side=side,
        time_s=session.timestamp_s - session.timestamp_s[:1],
        is_predicted=np.asarray(session.status) == TrackStatus.PREDICTED,
        position_mm=1e3 * motion.position_m,
        velocity_mm_s=1e3 * motion.velocity_m_s,
        angular_velocity_deg_s=np.degrees(motion.angular_velocity_rad_s),
        axes=rotation_in_w0(motion.rotation_w2_w0, motion.w0_turn_rad),
        zyz_deg=np.degrees(zyz),
        zyz_sd_deg=np.degrees(sd),
        zyz_sum_deg=np.degrees(total),
        joint_names=session.header.protocol.markers[:count],
        joint_mm=1e3 * motion.joint_position_m,
        is_joint_seen=np.isfinite(session.markers.measured_px[:, :count, 0]),
    )


def motion_columns(session: Session, motion: Motion) -> dict[str, FloatArray]:
    """Return every curve (N,) by the filter or smoother, ``motion``, by a name that ends with the unit."""
    curves, isb = compute_motion_curves(session, motion), isb_from_rotation(motion.rotation_w2_w0, session.header.hand)
    out: dict[str, FloatArray] = {}
    for pattern, values in (
        ("position_{}_mm", curves.position_mm),
        ("velocity_{}_mm_s", curves.velocity_mm_s),
        ("angular_velocity_{}_deg_s", curves.angular_velocity_deg_s),
    ):
        out |= {pattern.format(letter): values[:, axis] for axis, letter in enumerate("xyz")}
    for k, name in enumerate(("alpha", "beta", "gamma")):
        out |= {f"zyz_{name}_deg": curves.zyz_deg[:, k], f"zyz_{name}_sd_deg": curves.zyz_sd_deg[:, k]}
    out["zyz_alpha_plus_gamma_deg"] = curves.zyz_sum_deg
    out |= {f"isb_{name}_deg": np.degrees(isb[:, k]) for k, name in enumerate(WRIST_ANGLES)}
    for m, marker in enumerate(curves.joint_names):
        out |= {f"joint_{marker}_{letter}_mm": curves.joint_mm[:, m, axis] for axis, letter in enumerate("xyz")}
    return out


def visible_angle_deg(session: Session, name: str) -> FloatArray:
    """Return an angle (N,) in degrees by its name in files: of the wrist, a joint, or ``TAM3``.

    NaN where it was not seen well enough to be measured, or if the session does not have it.
    """
    if (angle := wrist_angle_index(name)) >= 0:
        motion = motion_estimate(session)
        angles_rad = clinical_angles_rad(session)
        valid = valid_wrist_angles(palm_in_view(session), angles_rad, motion.angles_sd_rad)
        return np.degrees(np.where(valid, angles_rad, np.nan))[:, angle]
    joints = joint_curves(session)
    if joints is not None and is_total_active_motion(name):
        return _total_flexion_deg(joints, int(name.removeprefix("TAM")))
    if joints is None or name not in joints.names:
        return np.full(len(session), np.nan)
    column = joints.names.index(name)
    return np.where(joints.is_valid[:, column], joints.angles_deg[:, column], np.nan)


def _total_flexion_deg(joints: JointCurves, finger: int) -> FloatArray:
    """Return the total flexion (N,) of a finger where all its joints were seen.

    A DIP joint without a marker is two thirds of the PIP joint.
    """
    names, inferred = flexion_joints(finger, joints.names)
    if not set(names) <= set(joints.names):
        return np.full(len(joints.time_s), np.nan)
    columns = [joints.names.index(name) for name in names]
    bend = np.where(joints.is_valid[:, columns], np.maximum(joints.angles_deg[:, columns], 0.0), np.nan)
    return np.asarray(bend @ flexion_weights(len(columns), inferred=inferred))
