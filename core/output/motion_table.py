"""The curves of the papers' figures as one table: path of the wrist, velocities, ZYZ, and the joints' ways in W0.

Wrist paper, figures 3, 5 and 6; hand paper, figures 2 and 3. Places in millimetres and the stored W0, angles in
degrees; unknown is NaN.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from carpus.core.hand.clinical_angles import isb_from_rotation, zyz_with_sd
from carpus.core.hand.sites import WRIST_ANGLES
from carpus.core.measures.forearm import rotation_in_place
from carpus.core.output.range_rows import best_motion
from carpus.core.session.values import Motion, Session
from carpus.core.types import FloatArray


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
