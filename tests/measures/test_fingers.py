"""Ranges of finger joints and TAM: what is hidden does not count and is told; figures against a known motion."""

from __future__ import annotations

import math

import numpy as np
import pytest

from carpus.core.measures.motion_range import (
    JointTrack,
    joint_range,
    joint_track,
    total_active_motion,
    valid_joints,
    visible_joints,
)
from carpus.core.measures.repetitions import Repetition
from carpus.core.model.hand.exercises import get_exercise
from carpus.core.model.hand.protocols import HAND21, joint_angle_names
from carpus.core.results.ranges import measure_joint_ranges

TIME_S = np.arange(0.0, 12.0, 1.0 / 30.0)
REPETITIONS = tuple(Repetition(4.0 * k, 4.0 * k + 4.0, 1.0) for k in range(3))
WAVE = 0.5 - 0.5 * np.cos(2.0 * math.pi * TIME_S / 4.0)
"""Three slow repetitions from 0 to 1 and back, each at 1 after 2 s."""
FULL = np.ones(len(TIME_S), dtype=bool)
SD_DEG = 2.0


def make_track(name: str, angle_deg: np.ndarray, valid: np.ndarray = FULL, sd_deg: float = SD_DEG) -> JointTrack:
    return joint_track(name, TIME_S, np.radians(angle_deg), np.full(len(TIME_S), math.radians(sd_deg)), valid)


def make_repetition(start_s: float, end_s: float) -> np.ndarray:
    """Frames of a part of every repetition."""
    return (np.mod(TIME_S, 4.0) >= start_s) & (np.mod(TIME_S, 4.0) < end_s)


def test_joint_range_occluded_angle_is_excluded_and_limited() -> None:
    hidden = make_repetition(1.5, 2.5)
    angle = np.where(hidden, 120.0, 80.0 * WAVE)
    found = joint_range(make_track("PIP3_flexion", angle, ~hidden), REPETITIONS)
    largest_seen = float((80.0 * WAVE[~hidden]).max())
    assert math.degrees(found.maximum.best) == pytest.approx(largest_seen, abs=1.0)
    assert found.top_limited
    assert not found.bottom_limited


@pytest.mark.parametrize(("share", "repetitions"), [(0.33, 3), (0.27, 0)])
def test_joint_range_repetition_needs_three_tenths_visible(share: float, repetitions: int) -> None:
    seen = make_repetition(0.0, 4.0 * share)
    assert joint_range(make_track("PIP3_flexion", 80.0 * WAVE, seen), REPETITIONS).repetitions == repetitions


def test_joint_range_visible_repetitions_stand_for_an_occluded_one() -> None:
    four = (*REPETITIONS, Repetition(12.0, 16.0, 1.0))
    time_s = np.arange(0.0, 16.0, 1.0 / 30.0)
    angle = np.radians(80.0 * (0.5 - 0.5 * np.cos(2.0 * math.pi * time_s / 4.0)))
    valid = ~((time_s > 1.2) & (time_s < 2.8))
    joint = joint_track("PIP3_flexion", time_s, angle, np.full(len(time_s), math.radians(SD_DEG)), valid)
    found = joint_range(joint, four)
    assert found.repetitions == 3
    assert np.degrees(found.arc.values) == pytest.approx([80.0] * 3, abs=0.5)
    assert not found.top_limited
    assert joint_range(joint, four[:3]).top_limited
    total = total_active_motion([joint, joint], four, inferred=False)
    assert np.degrees(total.arc.values) == pytest.approx([160.0] * 3, abs=1.0)
    assert not total.top_limited


def test_joint_range_occluded_between_extremes_is_not_limited() -> None:
    hidden = make_repetition(0.8, 1.2)
    found = joint_range(make_track("PIP3_flexion", 80.0 * WAVE, ~hidden), REPETITIONS)
    assert math.degrees(found.arc.mean) == pytest.approx(80.0, abs=0.5)
    assert not found.top_limited
    assert not found.bottom_limited


def test_joint_range_never_visible_is_unknown() -> None:
    found = joint_range(make_track("PIP3_flexion", 80.0 * WAVE, ~FULL), REPETITIONS)
    assert math.isnan(found.arc.mean)
    assert found.top_limited
    total = total_active_motion([make_track("MCP3_flexion", 60.0 * WAVE, ~FULL)] * 2, REPETITIONS, inferred=True)
    assert math.isnan(total.arc.mean)
    assert total.top_limited


@pytest.mark.parametrize(("lowest_deg", "deficit_deg"), [(12.0, 12.0), (-15.0, 0.0)])
def test_total_active_motion_is_flexion_less_deficit(lowest_deg: float, deficit_deg: float) -> None:
    joints = [
        make_track("MCP3_flexion", 70.0 * WAVE),
        make_track("PIP3_flexion", lowest_deg + (90.0 - lowest_deg) * WAVE),
        make_track("DIP3_flexion", 50.0 * WAVE),
    ]
    found = total_active_motion(joints, REPETITIONS, inferred=False)
    assert math.degrees(found.maximum.mean) == pytest.approx(210.0, abs=0.5)
    assert math.degrees(found.arc.mean) == pytest.approx(210.0 - deficit_deg, abs=0.8)
    assert not found.top_limited


def test_total_active_motion_inferred_dip_adds_two_thirds_of_the_pip() -> None:
    joints = [make_track("MCP3_flexion", 60.0 * WAVE, sd_deg=1.0), make_track("PIP3_flexion", 90.0 * WAVE, sd_deg=3.0)]
    found = total_active_motion(joints, REPETITIONS, inferred=True)
    assert math.degrees(found.arc.mean) == pytest.approx(60.0 + 90.0 * 5.0 / 3.0, abs=0.8)
    assert math.degrees(found.arc.measurement_sd) >= math.hypot(1.0, 5.0) - 1e-6


def test_visible_joints_need_both_markers() -> None:
    names = joint_angle_names(True)
    px = np.zeros((1, 21, 2))
    px[0, HAND21.markers.index("DIP4")] = np.nan
    seen = visible_joints(names, HAND21.markers, px)[0]
    unseen = {name for name, is_seen in zip(names, seen, strict=True) if not is_seen}
    assert unseen == {"PIP4_flexion", "DIP4_flexion"}


def test_valid_joints_exclude_uncertain_and_predicted_samples() -> None:
    seen = np.ones((3, 1), dtype=bool)
    sd = np.radians([[2.0], [2.0], [20.0]])
    assert valid_joints(np.array([0, 1, 0]), seen, np.zeros((3, 1)), sd)[:, 0].tolist() == [True, False, False]


def test_finger_measures_are_of_its_own_joints() -> None:
    names = (
        "MCP1_flexion",
        "IP1_flexion",
        *(f"{joint}{finger}_flexion" for finger in (2, 3) for joint in ("MCP", "PIP")),
    )
    tracks = {name: make_track(name, 10.0 * (k + 1) * WAVE) for k, name in enumerate(names)}
    rows = measure_joint_ranges(tracks, REPETITIONS, get_exercise("FIST_COMPOSITE"))
    arcs = {row.subject: row.mean for row in rows if row.quantity == "arc"}
    totals = {"TAM1": 10.0 + 20.0, "TAM2": 30.0 + 40.0 * 5.0 / 3.0, "TAM3": 50.0 + 60.0 * 5.0 / 3.0}
    assert arcs == pytest.approx(totals | {name: 10.0 * (k + 1) for k, name in enumerate(names)}, abs=0.8)
    assert not any(row.is_lower_bound for row in rows)
