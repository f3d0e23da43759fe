"""The looking-back process gives what looking back here gives, and costs a session nothing else when it fails."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import fields
from functools import lru_cache
from pathlib import Path

import numpy as np
import pytest

from carpus.core.calibration.calibrate import CalibrationSettings
from carpus.core.model.errors import SmoothingFailed
from carpus.core.pipeline import smoothing
from carpus.core.pipeline.smoothing import ChunkedSmoother, SmoothingProcess, TrackedHand
from carpus.core.pipeline.track import noise_from_neutral, restart_at_neutral
from carpus.core.platform.child_process import NICENESS
from carpus.core.session.values import Motion, stack_states
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.tracking.filter.settings import TrackerSettings
from carpus.core.tracking.tracker import FilterSteps, Tracker
from tests.accuracy.carpus import measure_still_hand
from tests.pipeline.live_fakes import wait_until
from tests.simulation.measurements import MeasurementSequence, measurement_sequence

PIECE_S, LAG_S = 1.5, 1.0
FIELDS = fields(Motion)
BEGIN = 40
"""Recording starts in the middle of a movement, so that what was believed before counts."""


@pytest.fixture(autouse=True)
def patience(monkeypatch: pytest.MonkeyPatch) -> None:
    """A loaded computer may take long to start a process; whether it is done in time is not what is tested."""
    monkeypatch.setattr(smoothing, "FINISH_TIMEOUT_S", 150.0)


@lru_cache(maxsize=1)
def sequence() -> MeasurementSequence:
    return measurement_sequence(
        RecordingSpec(seed=77, protocol="hand21", motion="fist", seconds=6.0, range_share=0.5, hand_length_mm=185.0)
    )


@lru_cache(maxsize=1)
def hand_and_start() -> tuple[TrackedHand, float]:
    hand, neutral_ends_s = measure_still_hand(sequence(), CalibrationSettings())
    assert hand.calibration is not None
    settings = noise_from_neutral(hand.noise, neutral_ends_s, TrackerSettings()).adapt_settings(TrackerSettings())
    return TrackedHand(hand.calibration, sequence().truth.camera, settings), neutral_ends_s


def track_hand() -> TrackedHand:
    return hand_and_start()[0]


def live_tracker(each: Callable[[Tracker], None]) -> Tracker:
    """Tracks the whole sequence and calls ``each`` after every frame."""
    hand, neutral_ends_s = hand_and_start()
    tracker, times_s = Tracker(hand.calibration, hand.camera, hand.settings), sequence().truth.timestamp_s
    for i in restart_at_neutral(range(len(times_s)), tracker, neutral_ends_s, lambda row: float(times_s[row])):
        tracker.predict_measurement(float(times_s[i]))
        tracker.step(i, float(times_s[i]), sequence().detections[i])
        each(tracker)
    return tracker


@lru_cache(maxsize=1)
def steps() -> tuple[FilterSteps, ...]:
    """What a live tracker hands over after each frame recorded."""
    kept: list[FilterSteps] = []
    live_tracker(lambda tracker: kept.append(tracker.pop_steps()))
    return tuple(kept[BEGIN:])


def times_s() -> list[float]:
    return [step.timestamp_s for kept in steps() for step in kept.steps]


def assert_same(found: Motion, expected: Motion) -> None:
    for one in FIELDS:
        np.testing.assert_allclose(
            getattr(found, one.name), getattr(expected, one.name), rtol=0, atol=1e-9, err_msg=one.name
        )


@contextmanager
def begin_smoothing() -> Iterator[SmoothingProcess]:
    """A process that runs and has been sent nothing but the hand."""
    running = SmoothingProcess(track_hand(), chunk_s=PIECE_S, lag_s=LAG_S)
    try:
        wait_until(lambda: running.pid is not None)
        yield running
    finally:
        running.cancel()


@lru_cache(maxsize=1)
def smooth_locally() -> tuple[int, Motion]:
    """How many pieces there are, and their motion, without a process."""
    here = ChunkedSmoother(track_hand(), PIECE_S, LAG_S)
    pieces = [piece for kept in steps() for piece in here.add_steps(kept)]
    pieces += here.finish()
    return len(pieces), join_pieces([piece.motion for piece in pieces])


def join_pieces(motions: Sequence[Motion]) -> Motion:
    return Motion(**{one.name: np.concatenate([getattr(motion, one.name) for motion in motions]) for one in FIELDS})


def select_rows(motion: Motion, rows: slice) -> Motion:
    return Motion(**{one.name: getattr(motion, one.name)[rows] for one in FIELDS})


def test_smoothing_process_equals_local_smoother() -> None:
    """Behind the tracking, until it is waited for."""
    own = os.getpriority(os.PRIO_PROCESS, 0)
    count, expected = smooth_locally()
    assert count >= 3
    with begin_smoothing() as running:
        pid = running.pid
        assert pid is not None

        def niceness() -> list[int]:
            return [os.getpriority(os.PRIO_PROCESS, int(task.name)) for task in Path(f"/proc/{pid}/task").iterdir()]

        if sys.platform.startswith("linux"):  # only here a thread has a niceness of its own
            wait_until(lambda: max(niceness()) == min(own + NICENESS, 19))
            assert os.getpriority(os.PRIO_PROCESS, pid) == own, "the thread that does what is left at the end"
        for kept in steps():
            running.add_steps(kept)
        with pytest.raises(SmoothingFailed, match="2 frames missing"):  # never handed over
            running.finish([*times_s(), 1e6, 2e6])
        motion = running.finish(times_s())
    assert_same(motion, expected)
    assert np.isfinite(motion.joint_angles_rad).mean() > 0.9


def test_smoothing_process_pop_and_finish_give_all_frames() -> None:
    """Every third frame is recorded, as if there had been pauses."""
    every_third = slice(2, None, 3)
    recorded, out = times_s()[every_third], []
    with begin_smoothing() as running:
        for number, kept in enumerate(steps()):
            running.add_steps(kept)
            if number == 120:
                wait_until(lambda: running.has_results)
                early = running.pop_smoothed(recorded[: number // 3])
                assert early is not None
                out.append(early)
                assert not running.has_results or running.pop_smoothed([]) is None
        given = len(out[0].position_m)
        assert 0 < given < 40
        out.append(running.finish(recorded[given:]))
    assert_same(join_pieces(out), select_rows(smooth_locally()[1], every_third))


def test_smoother_steps_one_by_one_equal_tracker_history() -> None:
    count = [0]

    def begin_recording(tracker: Tracker) -> None:
        count[0] += 1
        if count[0] <= BEGIN:
            tracker.pop_steps()

    there = live_tracker(begin_recording)
    whole = ChunkedSmoother(track_hand(), 1e6, 1e6)
    assert not any(whole.add_steps(kept) for kept in steps())
    (rest,) = whole.finish()
    assert rest.timestamp_s.tolist() == times_s()
    assert_same(rest.motion, stack_states(there.smooth()))


@pytest.mark.parametrize(
    ("blow", "limit", "said"),
    [
        (signal.SIGKILL, {}, "SIGKILL"),
        (signal.SIGSTOP, {"FINISH_TIMEOUT_S": 0.2}, "0.2 s"),
        (signal.SIGSTOP, {"MAX_WAITING": 50}, "50 frames behind"),
    ],
    ids=["killed", "does not answer", "too much waits"],
)
def test_smoothing_process_dead_or_hanging_raises_at_finish(
    blow: signal.Signals, limit: dict[str, float], said: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name, value in limit.items():
        monkeypatch.setattr(smoothing, name, value)
    with begin_smoothing() as running:
        assert running.pid is not None
        os.kill(running.pid, blow)
        for kept in steps():
            running.add_steps(kept)
        assert len(running._waiting) <= smoothing.MAX_WAITING
        assert not running._waiting or "MOST_WAITING" not in limit, "nothing is kept for it any more"
        with pytest.raises(SmoothingFailed, match=said):
            running.finish(times_s())
        assert not running._thread.is_alive()


def test_smoothing_process_failed_start_raises_at_finish(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(_process: object) -> None:
        raise OSError("no process left")

    monkeypatch.setattr("multiprocessing.context.SpawnProcess.start", refuse)
    running = SmoothingProcess(track_hand())
    running.add_steps(steps()[0])
    with pytest.raises(SmoothingFailed) as told:
        running.finish(times_s())
    assert "no process left" in told.value.detail


def test_smoothing_process_fault_is_one_line(capfd: pytest.CaptureFixture[str]) -> None:
    with begin_smoothing() as running:
        running.add_steps("no steps")  # type: ignore[arg-type]
        running.add_steps(steps()[0])
        with pytest.raises(SmoothingFailed) as told:
            running.finish(times_s())
    assert "AttributeError" in told.value.detail
    assert capfd.readouterr().err == ""
