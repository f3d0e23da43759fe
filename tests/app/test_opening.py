"""The practice patient: its still hand at once, its movement played once it is drawn, and what its whole hand does."""

from __future__ import annotations

import math
import threading
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from carpus.app.desktop.practice import PracticeRenderer, practice_spec, render_practice_start
from carpus.core.calibration.settings import CalibrationSettings
from carpus.core.capture.playback_sources import PracticeSource
from carpus.core.capture.source import is_simulated
from carpus.core.measures.reach import find_reaches
from carpus.core.measures.signals import low_pass, resample_evenly
from carpus.core.model.errors import CarpusFault, DiskFull
from carpus.core.model.hand.exercises import get_exercise
from carpus.core.model.hand.protocols import HAND21
from carpus.core.model.types import Side
from carpus.core.records.session_setup import PRACTICE_PATIENT, SessionSetup
from carpus.core.simulation import recording
from carpus.core.simulation.recording import SimulatedRecording
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.simulation.truth import Truth
from carpus.ui.shell.source_opener import OpeningCancelledError, Progress
from tests.accuracy.carpus import measured_hand
from tests.capture.test_practice import Take
from tests.pipeline.live_fakes import wait_until
from tests.simulation.measurements import measurement_sequence
from tests.ui.fakes import set_up

FIRST, SECOND = (replace(set_up("FIST_COMPOSITE"), exercise=get_exercise(name)) for name in ("WRIST_FE", "WRIST_RU"))
SET_UPS = {"WRIST_FE": FIRST, "WRIST_RU": SECOND}


class Drawn:
    """Draws when told; what was told meanwhile."""

    def __init__(self, fault: CarpusFault | None = None) -> None:
        self.go_on, self.begun, self.ended = threading.Semaphore(0), threading.Event(), threading.Event()
        self.fault, self.told, self.asked = fault, list[Any](), list[str]()
        self.patient = PracticeSource(Take(), 0.55, is_still_only=True)
        self.takes = PracticeRenderer(self.patient, self._draw, SET_UPS, {}, lambda *_: None, self.told.append)
        self.takes.start()
        assert not self.begun.wait(0.05), "the still hand is shown first: drawing takes every core"
        self.patient.still_hand_shown.set()
        assert self.begun.wait(60.0)

    def _draw(self, one: SessionSetup, progress: Progress) -> tuple[Take, float]:
        self.begun.set()
        self.asked.append(one.exercise.id)
        assert self.go_on.acquire(timeout=60.0)
        if self.fault is not None:
            self.ended.set()
            raise self.fault
        try:
            progress(1, 2)
        except OpeningCancelledError:
            self.ended.set()
            raise
        return Take(), 0.55


def test_movement_is_played_as_soon_as_it_is_drawn_and_next_one_after_it() -> None:
    drawn = Drawn()
    assert not drawn.patient.can_move
    drawn.go_on.release()
    wait_until(lambda: drawn.patient.can_move)
    drawn.takes.choose("WRIST_RU")
    assert not drawn.patient.can_move, "the second is not drawn yet"
    drawn.go_on.release()
    wait_until(lambda: drawn.patient.can_move)
    assert drawn.asked == ["WRIST_FE", "WRIST_RU"]


def test_drawing_ends_when_no_one_looks_any_more() -> None:
    drawn = Drawn()
    drawn.patient.close()
    drawn.go_on.release()
    assert drawn.ended.wait(60.0)
    wait_until(lambda: "practice takes" not in [one.name for one in threading.enumerate()])
    assert drawn.asked == ["WRIST_FE"]


def test_drawing_failure_is_reported() -> None:
    drawn = Drawn(DiskFull("cache"))
    drawn.go_on.release()
    wait_until(lambda: drawn.told)
    assert isinstance(drawn.told[0], DiskFull)


def test_beginning_is_what_whole_take_begins_with_and_dozen_frames(monkeypatch: pytest.MonkeyPatch) -> None:
    """A second of drawing, not a minute: the first live picture waits for nothing else."""
    whole = SimulatedRecording(practice_spec(FIRST))
    begun = render_practice_start(FIRST)
    assert begun is not None
    source, still_s = begun
    frames = list(source.frames())
    assert len(frames) <= 12 < len(whole)
    assert is_simulated(source.info)
    assert source.info.camera == whole.truth.camera
    for i, frame in ((0, frames[0]), (len(frames) - 1, frames[-1])):
        color, depth = whole.apply_sensor(i, whole.render_clean(i))
        np.testing.assert_array_equal(frame.color_rgb, color)
        np.testing.assert_array_equal(frame.depth_raw, depth)
    assert frames[-1].timestamp_s - frames[0].timestamp_s == pytest.approx(still_s, abs=1.0 / 15.0)
    monkeypatch.setattr(recording, "is_cached", lambda _: True)
    assert render_practice_start(FIRST) is None, "nothing to draw: the whole take is there"


def spec_of(exercise: str, side: Side = "right") -> RecordingSpec:
    return practice_spec(
        SessionSetup(PRACTICE_PATIENT, "Practice", side, get_exercise(exercise), 3, math.nan, math.nan)
    )


def truth_of(exercise: str) -> Truth:
    return SimulatedRecording(spec_of(exercise)).truth


@pytest.mark.parametrize("side", ["right", "left"])
def test_its_hand_lies_as_flat_as_the_calibration_asks(side: Side) -> None:
    still = replace(spec_of("FIST_COMPOSITE", side), hidden_share=0.0)
    calibrated, _ = measured_hand(measurement_sequence(still), CalibrationSettings())
    assert calibrated.verdict.is_good
    assert calibrated.verdict.tilt_deg < CalibrationSettings().most_tilt_deg - 1.0


def test_its_thumb_touches_every_finger_tip_and_it_reaches_out_and_back_twice() -> None:
    joints = truth_of("THUMB_OPP").joint_position_w0_m
    thumb = joints[:, HAND21.markers.index("TIP1")]
    for finger in (2, 3, 4, 5):
        away = np.linalg.norm(joints[:, HAND21.markers.index(f"TIP{finger}")] - thumb, axis=1)
        assert away.min() < 0.015
    truth = truth_of("REACH_GRASP")
    reaches = find_reaches(low_pass(resample_evenly(truth.timestamp_s - truth.timestamp_s[0], truth.position_m)))
    assert [reach.is_outward for reach in reaches] == [True, False, True, False]
    assert all(0.2 < reach.path.length_m < 0.3 for reach in reaches)
