"""What the papers draw of a movement: path with the hand's axes, velocities, ZYZ, and the ways of the finger joints;
and the same as one table.

Wrist paper, figures 3, 5 and 6; hand paper, figures 2 and 3. Places in millimetres and the stored W0, angles in
degrees, seconds; unknown is NaN.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from carpus.core.hand.clinical_angles import isb_from_rotation, zyz_with_sd
from carpus.core.hand.sites import WRIST_ANGLES
from carpus.core.measures.forearm import rotation_in_place
from carpus.core.measures.signals import BoolArray
from carpus.core.results.seen import best_motion
from carpus.core.session.values import Motion, Session
from carpus.core.types import FloatArray, Side, TrackStatus


@dataclass(frozen=True, slots=True)
class MotionCurves:
    """N frames. ``time_s`` (N,) after the first; ``predicted`` (N,); ``position_mm`` and ``velocity_mm_s`` (N, 3) of
    the wrist in W0, ``turning_deg_s`` (N, 3) about the hand's axes, ``axes`` (N, 3, 3) columns X, Y, Z of W2 in W0;
    ``zyz_deg`` and ``zyz_sd_deg`` (N, 3), ``zyz_sum_deg`` (N,) alpha + gamma; ``joint_mm`` (N, M, 3) the joints and
    tips by ``joint_names`` in W0, M 0 for the wrist alone; ``joint_seen`` (N, M) whether the disc there has a blob."""

    side: Side
    time_s: FloatArray
    predicted: BoolArray
    position_mm: FloatArray
    velocity_mm_s: FloatArray
    turning_deg_s: FloatArray
    axes: FloatArray
    zyz_deg: FloatArray
    zyz_sd_deg: FloatArray
    zyz_sum_deg: FloatArray
    joint_names: tuple[str, ...]
    joint_mm: FloatArray
    joint_seen: BoolArray


def motion_curves(session: Session) -> MotionCurves:
    """Of the smoother's result where there is one; nothing where the hand was lost."""
    motion, side = best_motion(session), session.header.hand
    count = motion.joint_position_m.shape[1]
    zyz, sd, total = zyz_with_sd(motion.rotation_w2_w0, motion.angles_sd_rad, side)
    return MotionCurves(
        side=side,
        time_s=session.timestamp_s - session.timestamp_s[:1],
        predicted=np.asarray(session.status) == TrackStatus.PREDICTED,
        position_mm=1e3 * motion.position_m,
        velocity_mm_s=1e3 * motion.velocity_m_s,
        turning_deg_s=np.degrees(motion.angular_velocity_rad_s),
        axes=rotation_in_place(motion.rotation_w2_w0, motion.w0_turn_rad),
        zyz_deg=np.degrees(zyz),
        zyz_sd_deg=np.degrees(sd),
        zyz_sum_deg=np.degrees(total),
        joint_names=session.header.protocol.markers[:count],
        joint_mm=1e3 * motion.joint_position_m,
        joint_seen=np.isfinite(session.markers.measured_px[:, :count, 0]),
    )


@dataclass(frozen=True, slots=True)
class CurveColumn:
    """One curve: ``name`` with its unit at the end, ``values`` (N,)."""

    name: str
    values: FloatArray


def motion_columns(session: Session, motion: Motion | None = None) -> tuple[CurveColumn, ...]:
    """Every curve of a session by its filter or its smoother, ``motion``; without it the smoother's where it ran."""
    return tuple(_columns(session, best_motion(session) if motion is None else motion))


def hand_axes(session: Session) -> FloatArray:
    """The hand's axes (N, 3, 3), columns X, Y and Z of W2, in the stored W0, to be drawn along the path."""
    motion = best_motion(session)
    return rotation_in_place(motion.rotation_w2_w0, motion.w0_turn_rad)


def _columns(session: Session, motion: Motion) -> Iterator[CurveColumn]:
    side = session.header.hand
    for axis, letter in enumerate("xyz"):
        yield CurveColumn(f"position_{letter}_mm", 1e3 * motion.position_m[:, axis])
    for axis, letter in enumerate("xyz"):
        yield CurveColumn(f"velocity_{letter}_mm_s", 1e3 * motion.velocity_m_s[:, axis])
    for axis, letter in enumerate("xyz"):
        yield CurveColumn(f"angular_velocity_{letter}_deg_s", np.degrees(motion.angular_velocity_rad_s[:, axis]))
    zyz, sd, total = zyz_with_sd(motion.rotation_w2_w0, motion.angles_sd_rad, side)
    for k, name in enumerate(("alpha", "beta", "gamma")):
        yield CurveColumn(f"zyz_{name}_deg", np.degrees(zyz[:, k]))
        yield CurveColumn(f"zyz_{name}_sd_deg", np.degrees(sd[:, k]))
    yield CurveColumn("zyz_alpha_plus_gamma_deg", np.degrees(total))
    isb = np.degrees(isb_from_rotation(motion.rotation_w2_w0, side))
    for k, name in enumerate(WRIST_ANGLES):
        yield CurveColumn(f"isb_{name}_deg", isb[:, k])
    for m, marker in enumerate(session.header.protocol.markers[: motion.joint_position_m.shape[1]]):
        for axis, letter in enumerate("xyz"):
            yield CurveColumn(f"joint_{marker}_{letter}_mm", 1e3 * motion.joint_position_m[:, m, axis])
