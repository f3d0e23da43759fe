"""What the practice patient does in exercises of the whole hand."""

from __future__ import annotations

import math

import numpy as np

from carpus.app.desktop.practice import practice_spec
from carpus.core.hand.protocols import HAND21
from carpus.core.library.set_up import PRACTICE_PATIENT, SetUp
from carpus.core.measures.reach import find_reaches
from carpus.core.measures.signals import even_signal, low_pass
from carpus.core.output.exercises import exercise_named
from carpus.core.simulation.recording import SimulatedPictures
from carpus.core.simulation.truth import Truth


def truth_of(exercise: str) -> Truth:
    set_up = SetUp(PRACTICE_PATIENT, "Practice", "right", exercise_named(exercise), 3, math.nan, math.nan)
    return SimulatedPictures(practice_spec(set_up)).truth


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
