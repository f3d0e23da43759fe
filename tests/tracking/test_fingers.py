"""Thumb and fingers tracked on simulated measurements: what is seen is right, what is hidden is said to be unsure."""

from __future__ import annotations

import functools
from dataclasses import replace

import numpy as np
import pytest

from carpus.core.model.hand.anatomy import HARD_LIMITS_RAD
from carpus.core.model.hand.protocols import HAND21
from carpus.core.model.types import FloatArray, TrackedFrame, TrackStatus
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.tracking.digits.digit_association import DigitAssignment, DigitScene, measurements_from_assignment
from carpus.core.tracking.digits.finger_model import FingerModel
from carpus.core.tracking.filter.digit_filter import ANATOMY, DIGIT_SIZE
from carpus.core.tracking.filter.hand_geometry import palm_calibration
from carpus.core.tracking.filter.palm_state import InitialSd, initial_estimate
from carpus.core.tracking.filter.predicted_measurement import measurements_from_blobs
from carpus.core.tracking.filter.readout import Readout
from carpus.core.tracking.filter.settings import TrackerSettings
from carpus.core.tracking.finger_filter import DigitFrame, DigitPosterior, FingerFilter
from carpus.core.tracking.hand_filter import HandFilter
from tests.accuracy.carpus import build_tracker, calibrate_sequence
from tests.simulation.measurements import MeasurementSequence, measurement_sequence

SPEC = RecordingSpec(seed=61, protocol="hand21", motion="fist", seconds=4.5, speed_hz=0.4)


@functools.cache
def sequence() -> MeasurementSequence:
    return measurement_sequence(SPEC)


def track_frames(hidden: dict[int, tuple[int, ...]], count: int = 60) -> tuple[list[TrackedFrame], MeasurementSequence]:
    """The hand tracked, with some markers taken away in some frames."""
    seen = sequence()
    tracker = build_tracker(seen)
    times = seen.truth.timestamp_s
    return [
        tracker.step(i, float(times[i]), seen.detections[i].subset(~np.isin(seen.marker[i], hidden.get(i, ()))))
        for i in range(count)
    ], seen


def test_fingers_reacquired_hand_keeps_learnt_lengths() -> None:
    seen = sequence()
    tracker, times_s = build_tracker(seen), seen.truth.timestamp_s
    for row in range(60):
        before = tracker.step(row, float(times_s[row]), seen.detections[row])
    fingers = tracker._filter.fingers
    assert fingers is not None
    learnt = fingers._mean[:, ANATOMY].copy()
    tracker.drop_track(before.timestamp_s)
    assert tracker.is_lost
    np.testing.assert_array_equal(fingers._mean[:, ANATOMY], learnt)
    after = tracker.step(60, float(times_s[60]), seen.detections[60])
    assert after.status is TrackStatus.TRACKED
    np.testing.assert_allclose(after.kinematics.angles_rad, before.kinematics.angles_rad, atol=0.03)


def update_digits_once(place_m: float, off_px: tuple[float, float]) -> tuple[DigitPosterior, FloatArray]:
    """The fingers of the first picture on a palm known to ``place_m``, their discs off to the sides in turn, and how
    far they go on from neutral (5, n)."""
    seen, settings = sequence(), TrackerSettings()
    known = calibrate_sequence(seen)
    fingers = FingerFilter(known, seen.truth.camera, settings)
    view = HandFilter(known, seen.truth.camera, settings).view
    estimate = initial_estimate(InitialSd(position_m=place_m, turn_rad=1e-4), 1e-8 * np.eye(21))
    base = Readout(palm_calibration(known), view.camera, 6e-3).compute_base(estimate, view)
    blobs, marker = seen.detections[0], seen.marker[0]
    pixel = blobs.pixel + np.column_stack((np.choose(marker % 2, off_px), np.zeros(marker.size)))
    found = measurements_from_blobs(replace(blobs, pixel=pixel), 5.0, settings, seen.truth.camera.sensor)
    picture = DigitFrame(0.0, base, found, blobs.area_px, ~np.isin(marker, HAND21.palm))
    trial = fingers.update(fingers.predict(0.0), picture)
    return trial, trial.update.update.mixture.merge()[0] - fingers.model.neutral_mixture().merge()[0]


def test_fingers_joint_centres_and_tips_match_the_truth() -> None:
    frames, seen = track_frames({})
    position = np.array([frame.kinematics.joint_position_m for frame in frames])
    off_mm = 1e3 * np.linalg.norm(position - seen.truth.joint_position_w0_m[: len(frames)], axis=-1)
    assert position.shape == (len(frames), len(HAND21.markers), 3)
    assert np.median(off_mm) < 3.0
    tips = [HAND21.markers.index(f"TIP{k}") for k in range(1, 6)]
    assert np.median(off_mm[:, tips]) < 3.0
    # Three fingers' widths from palm to tip: a model of bones of fixed length.
    bone = np.linalg.norm(position[:, 7] - position[:, 6], axis=-1)
    assert np.ptp(bone) < 0.002


def test_fingers_lost_hand_has_no_joints_until_found() -> None:
    everything = tuple(range(len(HAND21.markers)))
    frames, seen = track_frames(dict.fromkeys(range(20, 80), everything), count=100)
    lost = [frame for frame in frames if frame.status is TrackStatus.LOST]
    assert lost
    assert np.isnan(lost[-1].kinematics.joint_angles_rad).all()
    assert np.isnan(lost[-1].kinematics.joint_position_m).all()
    error_deg = np.degrees(np.abs(frames[-1].kinematics.joint_angles_rad - seen.truth.joint_angles_rad[99]))
    assert frames[-1].status is TrackStatus.TRACKED
    assert np.median(error_deg) < 3.0


def test_fingers_without_measurement_have_no_nis() -> None:
    everything = tuple(range(len(HAND21.markers)))
    frames, _ = track_frames({40: everything, 41: everything}, 44)
    assert [frame.status for frame in frames[40:42]] == [TrackStatus.PREDICTED] * 2
    assert [np.isfinite(frame.nis) for frame in frames[38:]] == [True, True, False, False, True, True]


def test_fingers_labelled_marker_restarts_its_digit_alone() -> None:
    """A person names a marker of the index finger: its joints are open again, the other digits go on."""
    seen, marker = sequence(), HAND21.markers.index("PIP2")
    times_s, row = seen.truth.timestamp_s, 40
    sd_rad = []
    for is_labelled in (False, True):
        tracker = build_tracker(seen)
        for earlier in range(row):
            tracker.step(earlier, float(times_s[earlier]), seen.detections[earlier])
        if is_labelled:
            tracker.labels.add(marker, seen.detections[row].pixel[seen.marker[row] == marker][0])
        sd_rad.append(tracker.step(row, float(times_s[row]), seen.detections[row]).kinematics.joint_angles_sd_rad)
    wider = sd_rad[1] / sd_rad[0] > 1.05
    is_index = np.array(["2_" in name for name in HAND21.joint_names()])
    assert wider[is_index].any()
    assert not wider[~is_index].any()


@pytest.mark.parametrize(("beyond_deg", "is_misread"), [(29.0, False), (31.0, True)])
def test_fingers_digit_30_degrees_beyond_is_misread(beyond_deg: float, is_misread: bool) -> None:
    model = FingerModel(calibrate_sequence(sequence()), sequence().truth.camera, TrackerSettings())
    bent = model.neutral_mixture()
    bent.mean[2, :, 2] = HARD_LIMITS_RAD["PIP3_flexion"][1] + np.radians(beyond_deg)
    bent.covariance[2] = 1e-8 * np.eye(DIGIT_SIZE)
    _, _, misread = model.apply_joint_limits(bent, bent)
    assert misread.tolist() == [False, False, is_misread, False, False]


CHAIN, PIP, DIP, TIP = 2, 0, 1, 2
RADIUS_PX, SETTINGS = 4.5, TrackerSettings()


def shared_px2(gap_px: float) -> float:
    """What two discs have in common."""
    half = 0.5 * gap_px
    return float(2.0 * RADIUS_PX**2 * np.arccos(half / RADIUS_PX) - 2.0 * half * np.sqrt(RADIUS_PX**2 - half**2))


def build_scene(gap_px: float, blob_of: int) -> tuple[DigitScene, DigitAssignment, FloatArray]:
    """A finger whose last two discs lie so near that one blob, named ``blob_of``, is both; and where they are (2, 2).
    They are expected a little further on."""
    trial, _ = update_digits_once(1e-4, (0.0, 0.0))
    scene, names = trial.scene, trial.update.assignment
    value = scene.linearised.value.reshape(5, 3, 3).copy()
    along = value[CHAIN, TIP, :2] - value[CHAIN, DIP, :2]
    value[CHAIN, TIP, :2] = value[CHAIN, DIP, :2] + gap_px * along / np.linalg.norm(along)
    place = value[CHAIN, DIP:, :2].copy()
    value[CHAIN, DIP:, :2] += [0.4, -0.3]
    assigned, with_depth = names.assigned.copy(), names.with_depth.copy()
    blob = assigned[CHAIN, blob_of]
    assigned[CHAIN, DIP + TIP - blob_of], with_depth[CHAIN, DIP + TIP - blob_of] = -1, False
    blobs, area_px = scene.blobs.value.copy(), np.full(len(scene.blobs), np.pi * RADIUS_PX**2)
    blobs[blob, :2] = place.mean(axis=0)
    area_px[blob] = 2.0 * np.pi * RADIUS_PX**2 - shared_px2(gap_px)
    whole_px = np.full((5, 3), np.pi * RADIUS_PX**2)
    near = replace(
        scene,
        linearised=replace(scene.linearised, value=value.reshape(5, 9)),
        blobs=replace(scene.blobs, value=blobs),
        area_px=area_px,
        whole_px=whole_px,
        disc_m2=whole_px * (value[..., 2] / scene.view.camera.fx_px) ** 2,
        visible=np.full((5, 3), 0.98),
    )
    return near, DigitAssignment(assigned, with_depth), place


def measure_scene(scene: DigitScene, names: DigitAssignment) -> tuple[FloatArray, FloatArray]:
    """What is measured of the discs (5, 3, 3), and how surely."""
    measured, variance = measurements_from_assignment(scene, names, SETTINGS)
    return measured.reshape(5, 3, 3), np.sqrt(variance.reshape(5, 3, 3))


@pytest.mark.parametrize("gap_px", [4.0, 6.0, 8.0])
@pytest.mark.parametrize("blob_of", [DIP, TIP])
def test_merged_blob_measures_both_discs(gap_px: float, blob_of: int) -> None:
    scene, names, place = build_scene(gap_px, blob_of)
    measured, sd = measure_scene(scene, names)
    off, stated = np.abs(measured[CHAIN, DIP:, :2] - place), sd[CHAIN, DIP:, :2]
    assert (off < 0.4 * gap_px).all(), "nearer than the blob's own centre"
    assert (off < 2.0 * stated).all()
    assert (stated > 0.2 * gap_px).all(), "a blob of two discs is as sure of neither as of one"
    assert sd[CHAIN, blob_of, 2] > 4e-3, "its depth may be the other's"
    assert np.isnan(measured[CHAIN, DIP + TIP - blob_of, 2])


def test_single_blob_measures_its_disc_alone() -> None:
    scene, names, _ = build_scene(6.0, DIP)
    blob = names.assigned[CHAIN, DIP]
    just_large = scene.area_px.copy()
    just_large[blob] = 1.2 * scene.whole_px[CHAIN, DIP]
    for one in (replace(scene, area_px=just_large), replace(scene, visible=np.full((5, 3), 0.3))):
        measured, sd = measure_scene(one, names)
        assert measured[CHAIN, DIP, :2] == pytest.approx(scene.blobs.value[blob, :2])
        assert (sd[CHAIN, DIP, :2] < 1.0).all()
        assert np.isnan(measured[CHAIN, TIP]).all()
