"""What may be called a change."""

from __future__ import annotations

import math

import pytest

from carpus.core.measures.change_limits import MeasuredLimit, RetestStudy, change_limit_rad
from carpus.core.model.hand.protocols import WRIST_ANGLES, joint_angle_names


def test_change_limit_equals_the_reference() -> None:
    limits = {"flexion": 10, "deviation": 8, "pronosupination": 15, "TAM": 22}
    limits |= {"MCP2_flexion": 12, "PIP5_flexion": 12, "MCP3_abduction": 8}
    limits |= {"CMC1_extension": 15, "MCP1_flexion": 15, "MCP1_abduction": 15, "IP1_flexion": 15}
    assert {name: round(math.degrees(change_limit_rad(name))) for name in limits} == limits
    assert all(change_limit_rad(name) > 0.0 for name in (*WRIST_ANGLES, *joint_angle_names(dip_free=True)))
    with pytest.raises(KeyError):
        change_limit_rad("elbow")


@pytest.mark.parametrize(
    ("people", "mdc95_deg", "limit_deg"), [(9, 4.2, None), (10, 4.2, 5.0), (10, 4.0, 4.0), (12, 4.9, 5.0)]
)
def test_study_limit_needs_ten_people_and_rounds_up(people: int, mdc95_deg: float, limit_deg: float | None) -> None:
    limit = MeasuredLimit("flexion", "flexion", people, 1.5, (1.0, 2.0), mdc95_deg, (3.0, 6.0))
    study = RetestStudy("wrist6", "WRIST_FE", "zyx", "2026-11-01", people, 2 * people, 2, (limit,))
    assert study.limit_deg("flexion", "flexion") == limit_deg
    assert study.limit_deg("flexion", "extension") is None
    assert study.is_in_force == (people >= 10)
