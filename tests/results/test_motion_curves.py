"""What is drawn of a movement is what the session holds, the same as its table."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from carpus.core.results.motion_curves import motion_columns, motion_curves
from tests.ui.fakes import session
from tests.ui.hand_fakes import hand_session


def test_curves_and_table_agree() -> None:
    made = hand_session(exercise="REACH_GRASP", motion="reach_grasp", lost=[(5.0, 6.0)])
    curves = motion_curves(made)
    table = {column.name: column.values for column in motion_columns(made, made.motion)}
    for axis, letter in enumerate("xyz"):
        pairs = (
            (curves.position_mm, f"position_{letter}_mm"),
            (curves.velocity_mm_s, f"velocity_{letter}_mm_s"),
            (curves.turning_deg_s, f"angular_velocity_{letter}_deg_s"),
        )
        for values, name in pairs:
            assert np.allclose(values[:, axis], table[name], equal_nan=True)
    for k, name in enumerate(("alpha", "beta", "gamma")):
        assert np.allclose(curves.zyz_deg[:, k], table[f"zyz_{name}_deg"], equal_nan=True)
        assert np.allclose(curves.zyz_sd_deg[:, k], table[f"zyz_{name}_sd_deg"], equal_nan=True)
    tip = curves.joint_names.index("TIP3")
    assert np.allclose(curves.joint_mm[:, tip, 2], table["joint_TIP3_z_mm"], equal_nan=True)
    gone = (curves.time_s >= 5.0) & (curves.time_s < 6.0)
    assert np.isnan(curves.position_mm[gone]).all()
    assert np.isnan(curves.joint_mm[gone]).all()


def test_the_axes_are_those_of_the_hand_in_the_frame_of_the_places() -> None:
    made = session()
    turn = np.tile([0.0, 0.0, 0.2], (len(made), 1))
    curves = motion_curves(replace(made, motion=replace(made.motion, w0_turn_rad=turn)))
    angle = np.arctan2(curves.axes[0, 1, 0], curves.axes[0, 0, 0])
    plain = np.arctan2(made.motion.rotation_w2_w0[0, 1, 0], made.motion.rotation_w2_w0[0, 0, 0])
    assert abs(angle - plain - 0.2) < 1e-3
    assert curves.joint_names == ()
