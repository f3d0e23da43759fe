"""Coupled end joints have one meaning: two thirds of the middle joint, in the angles and in the joint centres."""

from __future__ import annotations

import numpy as np
import pytest

from carpus.core.session.values import Motion
from tests.measures.tracked import tracked


def test_joint_centres_coupled_dip_bend_by_two_thirds_of_pip() -> None:
    take = tracked("hook", 4.0, 0.4, discs="hand21")
    for motion in (take.causal, take.smoothed):
        bends_as_coupled(motion, list(take.truth.joint_names))


def bends_as_coupled(motion: Motion, names: list[str]) -> None:
    assert motion.joint_angles_rad.shape[1] == 17, "coupled"
    known = np.isfinite(motion.joint_angles_rad).all(axis=1)
    angles = np.degrees(motion.joint_angles_rad[known])
    for finger in (2, 3, 4, 5):
        rows = [5 + 4 * (finger - 2) + k for k in range(4)]  # MCPk, PIPk, DIPk, TIPk of the whole hand's markers
        bones = np.diff(motion.joint_position_m[known][:, rows], axis=1)
        middle, end = bones[:, 1], bones[:, 2]
        cosine = np.vecdot(middle, end) / np.linalg.norm(middle, axis=1) / np.linalg.norm(end, axis=1)
        shown = np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0)))
        pip = angles[:, names.index(f"PIP{finger}_flexion")]
        assert pip.max() > 40.0
        assert shown == pytest.approx(np.abs(2.0 / 3.0 * pip), abs=0.5)
