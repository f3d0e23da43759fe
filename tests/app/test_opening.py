"""The practice patient: its still hand at once, its movement played once it is drawn, and what its whole hand does."""

from __future__ import annotations

import threading
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from carpus.app.desktop.practice import PracticeRenderer, practice_spec, render_practice_start
from carpus.core.capture.playback_sources import PracticeSource
from carpus.core.capture.source import is_simulated
from carpus.core.model.errors import CarpusFault
from carpus.core.model.hand.exercises import get_exercise
from carpus.core.records.session_setup import SessionSetup
from carpus.core.simulation import recording
from carpus.core.simulation.recording import SimulatedRecording
from carpus.ui.shell.source_opener import OpeningCancelledError, Progress
from tests.capture.test_playback_sources import Take
from tests.pipeline.live_fakes import wait_until
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


def test_practice_movement_is_played_once_rendered_and_then_the_next() -> None:
    drawn = Drawn()
    assert not drawn.patient.can_move
    drawn.go_on.release()
    wait_until(lambda: drawn.patient.can_move)
    drawn.takes.choose("WRIST_RU")
    assert not drawn.patient.can_move, "the second is not drawn yet"
    drawn.go_on.release()
    wait_until(lambda: drawn.patient.can_move)
    assert drawn.asked == ["WRIST_FE", "WRIST_RU"]


def test_rendering_stops_when_its_source_is_closed() -> None:
    drawn = Drawn()
    drawn.patient.close()
    drawn.go_on.release()
    assert drawn.ended.wait(60.0)
    wait_until(lambda: "practice takes" not in [one.name for one in threading.enumerate()])
    assert drawn.asked == ["WRIST_FE"]


def test_opening_frames_equal_the_first_of_the_recording(monkeypatch: pytest.MonkeyPatch) -> None:
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
