"""What may be called a change."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from carpus.core.hand.protocols import WRIST_ANGLES, joint_angle_names
from carpus.core.measures.change import MeasuredLimit, MeasuredMean, RetestStudy, change_between, change_limit_rad

BEFORE = MeasuredMean(math.radians(40.0), 5, "right", "wrist6", "WRIST_FE")


def after(mean_deg: float) -> MeasuredMean:
    return replace(BEFORE, mean_rad=math.radians(mean_deg))


def test_every_angle_has_a_limit() -> None:
    for name in (*WRIST_ANGLES, *joint_angle_names(dip_free=True), "TAM"):
        assert 8.0 <= round(math.degrees(change_limit_rad(name)), 6) <= 22.0, name


def test_limits_of_the_reference() -> None:
    limits = {"flexion": 10, "deviation": 8, "pronosupination": 15, "TAM": 22}
    limits |= {"MCP2_flexion": 12, "PIP5_flexion": 12, "MCP3_abduction": 8}
    limits |= {"CMC1_extension": 15, "MCP1_flexion": 15, "MCP1_abduction": 15, "IP1_flexion": 15}
    assert {name: round(math.degrees(change_limit_rad(name))) for name in limits} == limits
    with pytest.raises(KeyError):
        change_limit_rad("elbow")


@pytest.mark.parametrize(("mean_deg", "beyond"), [(49.9, False), (50.1, True), (29.9, True), (30.1, False)])
def test_only_above_the_limit(mean_deg: float, beyond: bool) -> None:
    change = change_between(BEFORE, after(mean_deg), "flexion")
    assert not change.obstacles
    assert (abs(change.difference_rad) > change.limit_rad) == beyond
    assert math.degrees(change.difference_rad) == pytest.approx(mean_deg - 40.0)


@pytest.mark.parametrize(
    ("before", "other", "obstacle"),
    [
        (BEFORE, replace(after(90.0), side="left"), "side"),
        (BEFORE, replace(after(90.0), protocol="hand21"), "protocol"),
        (BEFORE, replace(after(90.0), exercise="WRIST_RU"), "exercise"),
        (BEFORE, replace(after(90.0), repetitions=2), "few_repetitions_after"),
        (replace(BEFORE, repetitions=1), after(90.0), "few_repetitions_before"),
        (BEFORE, after(math.nan), "unknown"),
    ],
)
def test_what_does_not_compare_is_no_change(before: MeasuredMean, other: MeasuredMean, obstacle: str) -> None:
    assert change_between(before, other, "flexion").obstacles == (obstacle,)


@pytest.mark.parametrize(
    ("people", "mdc95_deg", "limit_deg"), [(9, 4.2, None), (10, 4.2, 5.0), (10, 4.0, 4.0), (12, 4.9, 5.0)]
)
def test_a_clinics_own_limit_is_of_ten_people_and_whole_degrees_upwards(
    people: int, mdc95_deg: float, limit_deg: float | None
) -> None:
    limit = MeasuredLimit("flexion", "flexion", people, 1.5, (1.0, 2.0), mdc95_deg, (3.0, 6.0))
    study = RetestStudy("wrist6", "WRIST_FE", "zyx", "2026-11-01", people, 2 * people, 2, (limit,))
    assert study.limit_deg("flexion", "flexion") == limit_deg
    assert study.limit_deg("flexion", "extension") is None
    assert study.in_force == (people >= 10)
