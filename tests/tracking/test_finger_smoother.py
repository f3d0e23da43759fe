"""Looking back at the fingers piece by piece, as a running recording does, gives what looking back at once gives."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import pytest

from carpus.core.model.hand.protocols import joint_angle_names
from carpus.core.model.types import FloatArray
from carpus.core.pipeline.track import restart_at_neutral
from carpus.core.simulation.spec import RecordingSpec
from tests.accuracy.carpus import build_tracker, calibrate_tracker
from tests.simulation.measurements import MeasurementSequence, measurement_sequence
from tests.suites import few

RECORDED_S, PIECE_S, LAG_S = 1.5, 1.25, 1.25
SPEC = RecordingSpec(seed=77, protocol="hand21", motion="fist", seconds=5.5, range_share=0.5, hand_length_mm=185.0)


@lru_cache(maxsize=1)
def sequence() -> MeasurementSequence:
    return measurement_sequence(SPEC)


def smooth_recording(*, in_pieces: bool) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Times (N,), joint angles (N, 17) and their sds, of what is recorded from ``RECORDED_S`` on."""
    blobs = sequence()
    times = blobs.truth.timestamp_s - blobs.truth.timestamp_s[0]
    tracker, neutral_ends_s = calibrate_tracker(blobs)
    rows: dict[float, tuple[FloatArray, FloatArray]] = {}

    def track_frames(until_s: float) -> None:
        steps = list(tracker.record.history)
        for step, moment in zip(steps, tracker.smooth(), strict=True):
            if RECORDED_S <= step.timestamp_s - blobs.truth.timestamp_s[0] < until_s:
                rows.setdefault(step.timestamp_s, (moment.joint_angles_rad, moment.joint_angles_sd_rad))
        tracker.record.discard_before(blobs.truth.timestamp_s[0] + until_s)

    due_s = RECORDED_S + PIECE_S + LAG_S
    every = range(len(times))
    for i in restart_at_neutral(every, tracker, neutral_ends_s, lambda row: float(blobs.truth.timestamp_s[row])):
        if times[i] < RECORDED_S and in_pieces:
            tracker.pop_steps()
        tracker.predict_measurement(float(blobs.truth.timestamp_s[i]))
        tracker.step(i, float(blobs.truth.timestamp_s[i]), blobs.detections[i])
        if in_pieces and times[i] >= due_s:
            track_frames(due_s - LAG_S)
            due_s += PIECE_S
    track_frames(np.inf)
    values = list(rows.values())
    return np.array(list(rows)), np.array([v[0] for v in values]), np.array([v[1] for v in values])


def test_smoothing_in_pieces_is_as_good_as_at_once() -> None:
    names = joint_angle_names()
    truth = sequence().truth
    at_s, whole, whole_sd = smooth_recording(in_pieces=False)
    pieces_at_s, pieces, _ = smooth_recording(in_pieces=True)
    assert np.array_equal(at_s, pieces_at_s)
    true = truth.joint_angles_rad[np.isin(truth.timestamp_s, at_s)]
    bending = [i for i, name in enumerate(names) if "flexion" in name]
    error_deg = np.degrees([np.sqrt(np.mean((found - true)[:, bending] ** 2)) for found in (whole, pieces)])
    assert error_deg[1] < 1.4 * error_deg[0] + 0.2
    assert np.median(np.abs(pieces - whole)[:, bending] / whole_sd[:, bending]) < 0.35


def test_smoother_record_next_piece_starts_where_the_last_ended() -> None:
    blobs = sequence()
    tracker, times_s = build_tracker(blobs), blobs.truth.timestamp_s
    for i in range(6):
        tracker.step(i, float(times_s[i]), blobs.detections[i])
    assert len(tracker.smooth()) == 6
    tracker.record.discard_before(float(times_s[4]))
    kept = tracker.record.pop_steps(None)
    assert [step.timestamp_s for step in kept.steps] == times_s[4:6].tolist()
    assert len(kept.fingers) == 2
    assert kept.finger_start is not None
    assert kept.finger_start.timestamp_s == times_s[3]
    assert not kept.finger_start.is_lost
    tracker.record.append_steps(kept)
    assert len(tracker.smooth()) == 2


@pytest.mark.parametrize("gap_s", few([0.4, 2.5, 0.25, 1.0], 2))
def test_finger_smoother_gaps_keep_joints_within_limits(gap_s: float) -> None:
    """A busy computer measures few pictures: what a rate had done by then must not be taken for turns of a joint."""
    blobs = sequence()
    times = blobs.truth.timestamp_s
    tracker, _ = calibrate_tracker(blobs)
    kept = [i for i in range(len(times)) if times[i] < times[0] + 2.0]
    while (after := int(np.searchsorted(times, times[kept[-1]] + gap_s))) < len(times) - 1:
        kept += [after, after + 1]
    live = [tracker.step(i, float(times[i]), blobs.detections[i]).kinematics.joint_angles_rad for i in kept]
    back = [moment.joint_angles_rad for moment in tracker.smooth()]
    truth = blobs.truth.joint_angles_rad[kept]
    bending = [i for i, name in enumerate(joint_angle_names()) if "flexion" in name]
    for found in (np.array(live), np.array(back)):
        assert np.degrees(np.nanmax(np.abs(found))) < 130.0
        assert np.degrees(np.nanmedian(np.abs(found - truth)[:, bending])) < 4.0
