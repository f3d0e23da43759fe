"""What is drawn of a movement is what the session holds, the same as its table."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.spatial.transform import Rotation

from carpus.core.results.motion_curves import compute_motion_curves, motion_columns
from tests.ui.fakes import session
from tests.ui.hand_fakes import hand_session


def test_motion_curves_match_session() -> None:
    made = hand_session(exercise="REACH_GRASP", motion="reach_grasp", lost=[(5.0, 6.0)])
    curves, motion = compute_motion_curves(made), made.motion
    table = motion_columns(made, made.motion)
    stored_tip_m = motion.joint_position_m[:, made.header.protocol.markers.index("TIP3")]
    for stored, name in (
        (1e3 * motion.position_m, "position_{}_mm"),
        (1e3 * motion.velocity_m_s, "velocity_{}_mm_s"),
        (np.degrees(motion.angular_velocity_rad_s), "angular_velocity_{}_deg_s"),
        (1e3 * stored_tip_m, "joint_TIP3_{}_mm"),
    ):
        told = np.column_stack([table[name.format(letter)] for letter in "xyz"])
        assert np.allclose(told, stored, equal_nan=True), name
    zyz = np.column_stack([table[f"zyz_{name}_deg"] for name in ("alpha", "beta", "gamma")])
    known = np.isfinite(zyz).all(axis=1)
    turned = Rotation.from_euler("ZYZ", zyz[known], degrees=True).as_matrix()
    assert np.allclose(turned, motion.rotation_w2_w0[known], atol=1e-9)
    gone = (curves.time_s >= 5.0) & (curves.time_s < 6.0)
    assert np.isnan(curves.position_mm[gone]).all()
    assert np.isnan(curves.joint_mm[gone]).all()


def test_motion_curves_axes_are_of_hand_in_w0() -> None:
    made = session()
    turn = np.tile([0.0, 0.0, 0.2], (len(made), 1))
    curves = compute_motion_curves(replace(made, motion=replace(made.motion, w0_turn_rad=turn)))
    angle = np.arctan2(curves.axes[0, 1, 0], curves.axes[0, 0, 0])
    plain = np.arctan2(made.motion.rotation_w2_w0[0, 1, 0], made.motion.rotation_w2_w0[0, 0, 0])
    assert abs(angle - plain - 0.2) < 1e-3
    assert curves.joint_names == ()
