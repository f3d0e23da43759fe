"""Markers put right by a person: what was false is left out, what was missing is added, the old result stays."""

from __future__ import annotations

import json
import math
import threading
from contextlib import closing
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from carpus.core.calibration.calibrate import CalibrationSettings
from carpus.core.model.errors import MarkersNotCorrectable, OutputExists
from carpus.core.model.hand.protocols import HAND21
from carpus.core.model.types import FloatArray
from carpus.core.pipeline.correction import (
    CorrectionTask,
    correct,
    correct_in_process,
    find_lost_corrections,
    load_task,
    with_added_detections,
)
from carpus.core.pipeline.track import (
    NeutralNoise,
    TrackSettings,
    format_parameters,
    noise_from_neutral,
    restart_at_neutral,
)
from carpus.core.records.corrections import compare_results
from carpus.core.session.label_checks import (
    CORRECTED,
    Correction,
    predict_marker_px,
    read_corrections,
    summarize_corrections,
)
from carpus.core.session.reader import read_detections, read_session
from carpus.core.session.values import Session, new_header
from carpus.core.session.writer import SessionWriter
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.tracking.tracker import Tracker
from tests.accuracy.carpus import measure_still_hand
from tests.simulation.measurements import measurement_sequence
from tests.tracking.hands import CAMERA, blobs, calibration, discs_cam_m, swing

FPS, SECONDS, WRONG_FROM = 30.0, 4.0, 60
MCP3 = 3
FALSE_PX = (60.0, 40.0)
"""Where the blue spot lies that is no disc, from the knuckle as it is at the start."""
LONG_AGO = datetime(2024, 11, 20, 11, 36, tzinfo=UTC)
"""Files say the second in which they were made, and nobody corrects within one."""


@dataclass(frozen=True)
class Stored:
    """A session in which a spot beside the hand was taken for the middle knuckle from one picture on."""

    path: Path
    truth_deg: FloatArray
    false_px: FloatArray
    disc_px: FloatArray


def wrongly_tracked(folder: Path) -> Stored:
    rng, motion = np.random.default_rng(4), swing(1, 30.0, 0.5)
    calibrated, settings = calibration(), TrackSettings()
    path = folder / "session.h5"
    learnt = NeutralNoise(0.15, 1.0, -np.inf)
    header = new_header(
        hand="right", protocol=calibrated.clicks.protocol, subject_id="Linden 42",
        exercise="WRIST_FE", parameters=format_parameters(settings, {}, learnt), now=LONG_AGO,
    )  # fmt: skip
    tracker = Tracker(calibrated, CAMERA, learnt.adapt_settings(settings.tracker))
    writer = SessionWriter.create(path, header, CAMERA, calibrated)
    false_px = calibrated.clicks.pixel[MCP3] + FALSE_PX
    for row in range(round(SECONDS * FPS)):
        time_s = row / FPS
        seen = [false_px] if row >= WRONG_FROM else []
        frame = tracker.step(row, time_s, blobs(motion(time_s), rng, false_px=seen))
        if row >= WRONG_FROM:
            measured = frame.marker_measured_px.copy()
            measured[MCP3] = frame.detections.pixel[np.linalg.norm(frame.detections.pixel - false_px, axis=1).argmin()]
            frame = replace(frame, marker_measured_px=measured)
        writer.append(frame)
    writer.add_event(1.0, "note", "hurts a little")
    writer.close()
    truth = np.array([motion(row / FPS).angles_deg for row in range(round(SECONDS * FPS))])
    disc_px = CAMERA.project(discs_cam_m(motion(WRONG_FROM / FPS)))[MCP3]
    return Stored(path, truth, false_px, disc_px)


@pytest.fixture(scope="module")
def stored(tmp_path_factory: pytest.TempPathFactory) -> Stored:
    return wrongly_tracked(tmp_path_factory.mktemp("correction"))


def task(stored: Stored, output: Path, *corrections: Correction) -> CorrectionTask:
    return load_task(stored.path, output, corrections, initials="MK")


def make_correction(stored: Stored) -> Correction:
    return Correction(WRONG_FROM, {"MCP3": (float(stored.disc_px[0]), float(stored.disc_px[1]))})


@pytest.fixture(scope="module")
def right(stored: Stored) -> Path:
    """Put right, in a process of its own that says how far it is and leaves the old file as it is."""
    path, seen = stored.path.with_name("right.h5"), list[tuple[int, int]]()
    before = stored.path.read_bytes()
    assert correct_in_process(
        task(stored, path, make_correction(stored)), lambda at, of: seen.append((at, of)), threading.Event()
    )
    assert seen[-1][1] == round(SECONDS * FPS)
    assert len(read_session(path))
    assert stored.path.read_bytes() == before
    return path


def test_correction_empty_changes_nothing(stored: Stored, tmp_path: Path) -> None:
    correct(task(stored, tmp_path / "new.h5"))
    before, after = read_session(stored.path), read_session(tmp_path / "new.h5")
    np.testing.assert_allclose(after.motion.angles_rad, before.motion.angles_rad, atol=1e-9)


def test_correction_replaces_false_blob_from_its_frame_on(stored: Stored, right: Path) -> None:
    session = read_session(right)
    taken = session.markers.measured_px[WRONG_FROM:]
    distance = np.linalg.norm(taken - stored.false_px, axis=-1)
    assert np.nanmin(distance) > 20.0
    assert np.isfinite(taken[:, MCP3]).all(axis=1).mean() > 0.95
    assert find_lost_corrections(session, read_detections(right), [make_correction(stored)]) == ()
    for motion in (session.motion, session.smoothed):
        assert motion is not None
        error_deg = np.degrees(motion.angles_rad[WRONG_FROM + 10 :]) - stored.truth_deg[WRONG_FROM + 10 :]
        assert np.abs(error_deg).max() < 6.0
    old = read_session(stored.path)
    np.testing.assert_allclose(session.motion.angles_rad[:WRONG_FROM], old.motion.angles_rad[:WRONG_FROM], atol=1e-9)


def test_correction_result_names_origin_and_keeps_notes(stored: Stored, right: Path) -> None:
    old, new = read_session(stored.path), read_session(right)
    assert new.header.origin == old.header.session_id
    assert new.header.recording_id == old.header.recording_id
    assert new.header.session_id != old.header.session_id
    assert ("note", "hurts a little") in [(event.kind, event.text) for event in new.events]
    (said,) = [event for event in new.events if event.kind == CORRECTED]
    assert said.time_s == pytest.approx(WRONG_FROM / FPS)
    told = json.loads(said.text)
    assert told["by"] == "MK"
    assert told["markers"]["MCP3"] == pytest.approx(stored.disc_px, abs=0.1)
    assert summarize_corrections(old) is None
    since = summarize_corrections(new)
    assert since is not None
    assert since.first_corrected_s == pytest.approx(WRONG_FROM / FPS, abs=0.01)
    assert (since.markers, since.initials, since.corrected_at.isoformat()) == (("MCP3",), "MK", new.header.created)
    ((read, by),) = read_corrections(new)
    assert (read.row, by) == (WRONG_FROM, "MK")
    assert read.places["MCP3"] == pytest.approx(stored.disc_px, abs=0.1)


def test_lost_correction_is_reported(stored: Stored, tmp_path: Path) -> None:
    """A person may put a knuckle where no knuckle can be: the tracker does not follow, and it is said."""
    nowhere = Correction(WRONG_FROM, {"MCP3": (40.0, 440.0)})
    correct(task(stored, tmp_path / "new.h5", nowhere))
    path = tmp_path / "new.h5"
    assert find_lost_corrections(read_session(path), read_detections(path), [nowhere]) == ("MCP3",)


def test_correction_not_visible_takes_no_blob(stored: Stored, tmp_path: Path) -> None:
    hidden = Correction(WRONG_FROM, {"MCP3": None})
    correct(task(stored, tmp_path / "new.h5", hidden))
    session = read_session(tmp_path / "new.h5")
    assert not np.isfinite(session.markers.measured_px[WRONG_FROM, MCP3]).any()
    assert find_lost_corrections(session, read_detections(tmp_path / "new.h5"), [hidden]) == ()
    assert np.nanmin(np.linalg.norm(session.markers.measured_px[WRONG_FROM:] - stored.false_px, axis=-1)) > 20.0


def test_correct_in_process_stop_leaves_nothing_and_passes_faults(stored: Stored, tmp_path: Path) -> None:
    stopping = threading.Event()
    stopping.set()
    assert not correct_in_process(task(stored, tmp_path / "new.h5"), lambda *_: None, stopping)
    assert list(tmp_path.iterdir()) == []
    (tmp_path / "there.h5").write_bytes(b"x")
    with pytest.raises(OutputExists):
        correct_in_process(task(stored, tmp_path / "there.h5"), lambda *_: None, threading.Event())


def test_correction_session_without_detections_raises(stored: Stored, tmp_path: Path) -> None:
    session = read_session(stored.path)
    writer = SessionWriter.create(tmp_path / "empty.h5", session.header, CAMERA, session.calibration)
    writer.close()
    with pytest.raises(MarkersNotCorrectable):
        load_task(tmp_path / "empty.h5", tmp_path / "new.h5", ())


DIP3 = HAND21.markers.index("DIP3")
OUT_OF_SIGHT = range(80, 90)


@pytest.fixture(scope="module")
def hand(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A whole hand of which a disc is covered from one picture on, and something blue goes with it."""
    seen = measurement_sequence(RecordingSpec(seed=61, protocol="hand21", motion="abduction", seconds=4.5))
    measured, neutral_ends_s = measure_still_hand(seen, CalibrationSettings())
    assert measured.calibration is not None
    path, settings, truth = tmp_path_factory.mktemp("hand") / "hand.h5", TrackSettings(), seen.truth
    learnt = noise_from_neutral(measured.noise, neutral_ends_s, settings.tracker)
    header = new_header(
        hand="right", protocol=measured.calibration.clicks.protocol, subject_id="Linden 42",
        exercise="FINGER_ABDUCTION", parameters=format_parameters(settings, {}, learnt), dip_free=False,
    )  # fmt: skip
    tracker = Tracker(measured.calibration, truth.camera, learnt.adapt_settings(settings.tracker))
    times_s = truth.timestamp_s.tolist()
    with closing(SessionWriter.create(path, header, truth.camera, measured.calibration)) as writer:
        for row in restart_at_neutral(range(len(times_s)), tracker, neutral_ends_s, times_s.__getitem__):
            spots, is_it = seen.detections[row], seen.marker[row] == DIP3
            if row >= WRONG_FROM:
                spots = replace(spots, pixel=spots.pixel + np.where(is_it[:, None], (-2.0, 2.0), 0.0))
            writer.append(tracker.step(row, times_s[row], spots.subset(~is_it) if row in OUT_OF_SIGHT else spots))
    return path


def run_correction(hand: Path, output: Path, *corrections: Correction) -> Session:
    correct(load_task(hand, output, corrections))
    return read_session(output)


def test_correction_false_finger_blob_leaves_other_fingers_unchanged(hand: Path, tmp_path: Path) -> None:
    before = read_session(hand)
    assert np.isfinite(before.markers.measured_px[OUT_OF_SIGHT.stop + 5 :, DIP3]).all()
    after = run_correction(hand, tmp_path / "new.h5", Correction(WRONG_FROM, {"DIP3": None}))
    assert not np.isfinite(after.markers.measured_px[WRONG_FROM:, DIP3]).any()
    size_deg = np.degrees(np.abs(after.motion.joint_angles_rad - before.motion.joint_angles_rad)).max(axis=0)
    changed = {name for name, size in zip(after.header.joint_names, size_deg, strict=True) if size > 0.1}
    assert changed == {name for name in changed if "3" in name} != set(), size_deg
    found = compare_results(before, after)
    assert found.lost_markers == ("DIP3",)
    assert "3" in found.max_difference_angle


def test_correction_several_of_one_frame_hold(hand: Path, tmp_path: Path) -> None:
    """In one correction or in two; the last that is said of a marker counts."""
    names = [f"{joint}{finger}" for joint in ("PIP", "DIP") for finger in (2, 3, 4, 5)]
    place = tuple(read_session(hand).markers.measured_px[WRONG_FROM, DIP3].tolist())
    several = (
        Correction(WRONG_FROM, dict.fromkeys(names[:5]) | {"DIP3": place}),
        Correction(WRONG_FROM, dict.fromkeys(names[5:])),
    )
    after = run_correction(hand, tmp_path / "new.h5", *several)
    rows = [HAND21.markers.index(name) for name in names]
    assert not np.isfinite(after.markers.measured_px[WRONG_FROM : WRONG_FROM + 15, rows]).any()
    ((said, _),) = read_corrections(after)
    assert said.places == dict.fromkeys(names)
    assert find_lost_corrections(after, read_detections(tmp_path / "new.h5"), [said]) == ()


@pytest.mark.parametrize(
    "wrong", [{"row": -1}, {"row": 10_000}, {"places": {"NOSE": None}}, {"places": {"DIP3": (math.nan, 3.0)}}]
)
def test_correction_of_unknown_frame_or_marker_raises(hand: Path, tmp_path: Path, wrong: dict[str, Any]) -> None:
    with pytest.raises(MarkersNotCorrectable):
        run_correction(hand, tmp_path / "new.h5", replace(Correction(WRONG_FROM, {"DIP3": None}), **wrong))
    assert list(tmp_path.iterdir()) == []


def test_correction_missing_marker_is_added_without_depth() -> None:
    found = blobs(swing(1, 0.0, 1.0)(0.0), hidden=[MCP3])
    place = CAMERA.project(discs_cam_m(swing(1, 0.0, 1.0)(0.0)))[MCP3]
    more = with_added_detections(found, np.array([place, found.pixel[0] + 1.0]))
    assert len(more) == len(found) + 1
    assert more.pixel[-1] == pytest.approx(place)
    assert np.isnan(more.depth_m[-1])


def test_predict_marker_px_uses_other_markers(stored: Stored) -> None:
    session = read_session(stored.path)
    places, model_m = session.markers.measured_px[WRONG_FROM], session.markers.position_cam_m.copy()
    model_m[WRONG_FROM, MCP3] += 0.03  # the model that followed the false spot
    session = replace(session, markers=replace(session.markers, position_cam_m=model_m))
    expected = predict_marker_px(session, WRONG_FROM, places, MCP3)
    assert expected == pytest.approx(stored.disc_px, abs=4.0)
    assert np.linalg.norm(places[MCP3] - expected) > 40.0
