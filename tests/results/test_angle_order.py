"""The ISB's order as an option of report and window: same turns, other angles, never mixed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from carpus.core.model.hand.clinical_angles import isb_from_rotation, rotation_from_angles
from carpus.core.results.motion_curves import motion_columns
from carpus.core.results.progress import compare_ranges
from carpus.core.results.ranges import isb_sd_rad, with_angle_order
from carpus.ui.words.session import method_words
from tests.ui.fakes import NOW, figures_once, session


def test_with_angle_order_isb_reads_same_rotations() -> None:
    made = session(exercise="FREE", motion="mixed", lost=[(20.0, 22.0)])
    turned, known = with_angle_order(made, "isb"), np.isfinite(made.motion.angles_rad).all(axis=1)
    assert known.any()
    assert np.array_equal(np.isfinite(turned.motion.angles_rad).all(axis=1), known)
    assert np.array_equal(np.isfinite(turned.motion.angles_sd_rad).all(axis=1), known)
    table = motion_columns(made, made.motion)
    for k, name in enumerate(("deviation", "flexion", "pronosupination")):
        assert np.allclose(np.degrees(turned.motion.angles_rad[:, k]), table[f"isb_{name}_deg"], equal_nan=True)
    # R = Ry(flexion) Rz(deviation) Rx(turning), by another library.
    order = turned.motion.angles_rad[known][:, [1, 0, 2]]
    again = Rotation.from_euler("YZX", order).as_matrix()
    assert np.allclose(again, made.motion.rotation_w2_w0[known], atol=1e-9)
    assert with_angle_order(made, "zyx") is made
    with pytest.raises(ValueError, match="isb"):
        with_angle_order(turned, "zyx")


@pytest.mark.parametrize("pose_deg", [(20.0, 60.0, 0.0), (-15.0, -40.0, 25.0)])
def test_isb_sd_matches_many_draws(pose_deg: tuple[float, float, float]) -> None:
    sd = np.radians([0.4, 0.9, 1.2])
    pose = np.radians(pose_deg)
    drawn = pose + np.random.default_rng(3).normal(0.0, sd, (20_000, 3))
    angles = isb_from_rotation(rotation_from_angles(drawn, "left"), "left")
    found = isb_sd_rad(rotation_from_angles(pose[None], "left"), sd[None], "left")[0]
    assert found == pytest.approx(angles.std(axis=0), rel=0.03)


def test_report_states_angle_order_and_orders_never_compare() -> None:
    plain = figures_once(session(session_id="before"))
    other = figures_once(with_angle_order(session(when=NOW), "isb"))
    assert "ISB" in method_words(other, 6, compared=False)
    assert "ISB" not in method_words(plain, 6, compared=False)
    assert {item.verdict for item in compare_ranges(plain, other)} == {"not_judged"}
    assert all("angle_order" in item.reasons for item in compare_ranges(plain, other))
    alike = replace(plain, angle_order="isb")
    assert all("angle_order" not in item.reasons for item in compare_ranges(alike, other))
