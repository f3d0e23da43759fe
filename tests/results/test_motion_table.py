"""The papers' curves in a table, against the session they are of."""

from __future__ import annotations

import csv
from dataclasses import replace
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from carpus.core.formats import csv_tables
from carpus.core.results.motion_curves import motion_columns
from tests.formats.takes import take_of
from tests.ui.fakes import session
from tests.ui.hand_fakes import hand_session


def test_path_velocities_and_joints_are_those_of_the_session() -> None:
    made = hand_session(exercise="REACH_GRASP", motion="reach_grasp")
    table = {column.name: column.values for column in motion_columns(made, made.motion)}
    assert np.allclose(table["position_z_mm"], 1e3 * made.motion.position_m[:, 2], equal_nan=True)
    assert np.allclose(table["velocity_x_mm_s"], 1e3 * made.motion.velocity_m_s[:, 0], equal_nan=True)
    tip = made.header.protocol.markers.index("TIP3")
    assert np.allclose(table["joint_TIP3_y_mm"], 1e3 * made.motion.joint_position_m[:, tip, 1], equal_nan=True)


def test_zyz_turns_back_into_the_rotation_wherever_it_is_given() -> None:
    made = session()
    table = {column.name: column.values for column in motion_columns(made, made.motion)}
    zyz = np.column_stack([table[f"zyz_{name}_deg"] for name in ("alpha", "beta", "gamma")])
    known = np.isfinite(zyz[:, 0])
    assert known.mean() > 0.8
    turned = Rotation.from_euler("ZYZ", zyz[known], degrees=True).as_matrix()
    assert np.allclose(turned, made.motion.rotation_w2_w0[known], atol=1e-9)
    assert (table["zyz_alpha_sd_deg"][known] <= 30.0).all()
    assert np.isfinite(zyz[:, 1]).all(), "beta is known also where the other two are not"
    assert np.isfinite(table["zyz_alpha_plus_gamma_deg"]).mean() > 0.95


def test_the_curves_are_exported(tmp_path: Path) -> None:
    made = replace(session(), path=tmp_path / "s.h5")
    written = csv_tables.write(take_of(made, "s"), tmp_path)
    assert written[0].name == "s.wrist.csv"
    with written[0].open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == len(made)
    for name in ("position_x_mm", "zyz_beta_sd_deg", "isb_flexion_deg", "angular_velocity_z_deg_s"):
        assert f"filter_{name}" in rows[0]
    assert float(rows[10]["filter_position_x_mm"]) == round(1e3 * float(made.motion.position_m[10, 0]), 3)
