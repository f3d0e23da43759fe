"""What the practice patient does in exercises of the whole hand."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from carpus.app.desktop.sources import practice_spec
from carpus.core.calibration.settings import CalibrationSettings
from carpus.core.hand.exercises import exercise_named
from carpus.core.hand.protocols import HAND21
from carpus.core.measures.reach import find_reaches
from carpus.core.measures.signals import even_signal, low_pass
from carpus.core.records.set_up import PRACTICE_PATIENT, SetUp
from carpus.core.simulation.recording import SimulatedPictures
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.simulation.truth import Truth
from carpus.core.types import Side
from tests.accuracy.carpus import measured_hand
from tests.simulation.measurements import measurement_sequence


def spec_of(exercise: str, side: Side = "right") -> RecordingSpec:
    set_up = SetUp(PRACTICE_PATIENT, "Practice", side, exercise_named(exercise), 3, math.nan, math.nan)
    return practice_spec(set_up)


def truth_of(exercise: str) -> Truth:
    return SimulatedPictures(spec_of(exercise)).truth


@pytest.mark.parametrize("side", ["right", "left"])
def test_its_hand_lies_as_flat_as_the_calibration_asks(side: Side) -> None:
    still = replace(spec_of("FIST_COMPOSITE", side), hidden_share=0.0)
    calibrated, _ = measured_hand(measurement_sequence(still), CalibrationSettings())
    assert calibrated.verdict.is_good
    assert calibrated.verdict.tilt_deg < CalibrationSettings().most_tilt_deg - 1.0


def test_its_thumb_touches_every_finger_tip() -> None:
    joints = truth_of("THUMB_OPP").joint_position_w0_m
    thumb = joints[:, HAND21.markers.index("TIP1")]
    for finger in (2, 3, 4, 5):
        away = np.linalg.norm(joints[:, HAND21.markers.index(f"TIP{finger}")] - thumb, axis=1)
        assert away.min() < 0.015


def test_it_reaches_out_and_back_twice() -> None:
    truth = truth_of("REACH_GRASP")
    time_s = truth.timestamp_s - truth.timestamp_s[0]
    reaches = find_reaches(low_pass(even_signal(time_s, truth.position_m)))
    assert [reach.outward for reach in reaches] == [True, False, True, False]
    assert all(0.2 < reach.path.length_m < 0.3 for reach in reaches)
