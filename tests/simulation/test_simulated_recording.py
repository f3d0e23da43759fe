"""A recording on disk: reproducible, readable, honest about its times; kept once rendered."""

from __future__ import annotations

import dataclasses
import errno
import hashlib
import json
from pathlib import Path

import numpy as np
import pytest

from carpus.core.capture.files.tum import TumFolder
from carpus.core.model.errors import OutputExists
from carpus.core.simulation.disturbances import sample_false_blobs
from carpus.core.simulation.recording import (
    render_cached,
    sample_clicks,
    simulate,
)
from carpus.core.simulation.scene import Scene
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.simulation.truth import compute_truth
from tests.rendered import read_truth
from tests.simulation.measurements import measurement_sequence

SPEC = RecordingSpec(
    seed=21, hand="left", motion="mixed", seconds=0.9, false_blobs=2, hidden_share=0.2, dropped_share=0.15, fps=15.0
)


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("simulated") / "one"
    simulate(SPEC, folder)
    return folder


def digests(folder: Path) -> dict[str, str]:
    return {
        str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }


def test_simulate_same_spec_gives_the_same_bytes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Rendered here or by processes; where these can share nothing one renders all."""
    short = dataclasses.replace(SPEC, seconds=0.2)
    simulate(short, tmp_path / "a", workers=1)
    simulate(short, tmp_path / "again", workers=2)
    a = digests(tmp_path / "a")
    assert digests(tmp_path / "again") == a

    def refuse(*_: object, **__: object) -> None:
        raise OSError(errno.EROFS, "Read-only file system")

    monkeypatch.setattr("multiprocessing.synchronize.SemLock.__init__", refuse)
    simulate(short, tmp_path / "alone", workers=2)
    assert digests(tmp_path / "alone") == a


def test_simulate_recording_reads_back_with_true_times(recording: Path) -> None:
    truth = read_truth(SPEC, recording)
    source = TumFolder(recording)
    frames = list(source.frames())
    assert len(frames) == len(truth.timestamp_s)
    assert source.info.camera.fx_px == pytest.approx(truth.camera.fx_px)
    np.testing.assert_allclose([frame.timestamp_s for frame in frames], truth.timestamp_s, atol=1e-6)
    assert [frame.dropped_before for frame in frames] == truth.dropped_before.tolist()
    assert truth.dropped_before.sum() > 0
    for frame in frames:
        assert frame.depth_raw is not None
        assert frame.color_rgb.shape == (480, 640, 3)
    lines = [line.split() for line in (recording / "depth.txt").read_text().splitlines() if not line.startswith("#")]
    delay = np.array([float(time) for time, _ in lines]) - truth.timestamp_s
    assert 0.001 < delay.mean() < 0.008


def test_simulated_clicks_have_the_error_of_a_person(recording: Path) -> None:
    content = json.loads((recording / "calibration.json").read_text())
    truth = read_truth(SPEC, recording)
    assert content["hand"] == "left"
    assert content["protocol"] == "wrist6"
    assert tuple(content["markers"]) == SPEC.marker_protocol.markers
    off = np.linalg.norm(np.array(list(content["markers"].values())) - truth.marker_px[0], axis=1)
    assert 0.2 < off.max() < 5.0
    exact = compute_truth(Scene(dataclasses.replace(SPEC, click_error_px=0.0)))
    np.testing.assert_allclose(sample_clicks(exact).pixel, exact.marker_px[0], atol=0.051)


def test_simulate_folder_of_other_files_is_refused(tmp_path: Path) -> None:
    (tmp_path / "P-1").mkdir()
    with pytest.raises(OutputExists):
        simulate(SPEC, tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["P-1"]


def test_render_cached_renders_once(tmp_path: Path) -> None:
    spec = RecordingSpec(seed=30, seconds=0.1, motion="rest")
    calls: list[int] = []
    first = render_cached(spec, lambda done, _: calls.append(done), cache=tmp_path)
    assert calls == [1, 2, 3]
    second = render_cached(spec, lambda done, _: calls.append(done), cache=tmp_path)
    assert calls == [1, 2, 3]
    assert first == second


def test_false_blobs_have_the_wanted_number_clear_of_markers() -> None:
    scene = Scene(RecordingSpec(seed=3, seconds=20.0, false_blobs=2))
    blobs = sample_false_blobs(scene)
    times = np.arange(0.0, 20.0, 0.05)
    count = sum((times >= b.start_s) & (times <= b.end_s) for b in blobs)
    assert np.mean(count) == pytest.approx(2.0, abs=0.01)
    assert {blob.place for blob in blobs} == {"table", "air", "skin"}
    discs = scene.patient.anatomy.palm_disc_m
    for blob in blobs:
        if blob.place == "skin":
            assert np.linalg.norm(discs - blob.center_m, axis=1).min() > 0.0149


def test_simulated_measurements_are_truth_with_noise() -> None:
    spec = RecordingSpec(
        seed=5, motion="mixed", seconds=20.0, false_blobs=2, hidden_share=0.1, dropped_share=0.02, depth_scale_error=0.0
    )
    sequence = measurement_sequence(spec)
    truth = sequence.truth
    errors, depth_errors, false_count, hidden = [], [], 0, 0
    for i, (blobs, marker) in enumerate(zip(sequence.detections, sequence.marker, strict=True)):
        real = marker >= 0
        assert len(set(marker[real].tolist())) == real.sum()
        errors.append(blobs.pixel[real] - truth.marker_px[i, marker[real]])
        depth_errors.append(blobs.depth_m[real] - truth.marker_position_cam_m[i, marker[real], 2])
        false_count += int((~real).sum())
        missing = np.setdiff1d(np.arange(6), marker)
        np.testing.assert_array_equal(truth.visible_share[i, missing], 0.0)
        hidden += len(missing)
    frames = len(truth.timestamp_s)
    assert 0.02 < np.concatenate(errors).std() < 0.4
    assert 0.3e-3 < np.concatenate(depth_errors).std() < 2e-3
    assert 1.3 < false_count / frames <= 2.1
    assert 0.06 < hidden / frames / 6 < 0.16
    assert len(sequence.detections[0]) >= 6
    np.testing.assert_array_equal(truth.angles_rad, compute_truth(Scene(spec)).angles_rad)
