"""A recording to a session file and again from that file: complete, equal, and nothing half-written left behind."""

from __future__ import annotations

import hashlib
import json
import shutil
from dataclasses import dataclass, replace
from pathlib import Path

import h5py
import numpy as np
import pytest

from carpus.core.calibration.calibrate import CalibrationSettings
from carpus.core.calibration.clicks_file import read_clicks
from carpus.core.calibration.result import Clicks, Verdict
from carpus.core.capture.files.image_codec import encode_color, encode_depth
from carpus.core.capture.files.raw import RawRecording, RawWriter
from carpus.core.capture.files.tum import DEPTH_UNIT_M, TumFolder
from carpus.core.model.errors import (
    DiskFull,
    FrameDamaged,
    OutputExists,
    RecordingEmpty,
    SessionUnreadable,
)
from carpus.core.model.types import FloatArray
from carpus.core.pipeline.track import TrackReport, TrackSettings, restart_at_neutral, retrack_session, track_recording
from carpus.core.platform.version import __version__
from carpus.core.session.reader import read_session
from carpus.core.session.values import EncodedImages
from carpus.core.session.writer import SessionWriter
from carpus.core.simulation.recording import CLICKS_FILE
from carpus.core.simulation.truth import Truth
from carpus.core.tracking.filter.settings import TrackerSettings
from tests.rendered import LEFT_DEVIATION, Rendered, read_truth
from tests.session.samples import add_pictures, make_frame


@dataclass(frozen=True)
class Made:
    """A simulated recording, its truth, and the session tracked from it."""

    folder: Path
    truth: Truth
    session: Path
    report: TrackReport
    told: list[tuple[int, int | None]]
    """How far it was, and of how many."""

    @property
    def clicks(self) -> Clicks:
        return read_clicks(self.folder / CLICKS_FILE, 640, 480)


@pytest.fixture(scope="module")
def made(rendered: Rendered, tmp_path_factory: pytest.TempPathFactory) -> Made:
    folder, session = rendered(LEFT_DEVIATION), tmp_path_factory.mktemp("track") / "session.h5"
    clicks = read_clicks(folder / CLICKS_FILE, 640, 480)
    told: list[tuple[int, int | None]] = []
    said = {"exercise": "radial and ulnar", "subject_id": "P-7"}
    report = track(folder, clicks, session, progress=lambda *at: told.append(at), **said)
    return Made(folder, read_truth(LEFT_DEVIATION, folder), session, report, told)


def track(folder: Path, clicks: Clicks, output: Path, settings: TrackSettings | None = None, **kwargs) -> TrackReport:  # type: ignore[no-untyped-def]
    source = TumFolder(folder)
    try:
        return track_recording(source, clicks, output, settings or TrackSettings(), **kwargs)
    finally:
        source.close()


def retrack_again(made: Made, output: Path, settings: TrackSettings | None = None) -> TrackReport:
    return retrack_session(made.session, output, settings or TrackSettings())


def angles(path: Path, group: str = "wrist") -> FloatArray:
    with h5py.File(path) as file:
        return np.asarray(file[f"{group}/angles"])


def digest(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def test_track_recording_writes_complete_session(made: Made) -> None:
    count = len(made.truth.timestamp_s)
    assert made.report.frames == made.report.tracked == count
    assert made.report.verdict.is_good
    assert made.told == [(k, count) for k in range(1, count + 1)]
    with h5py.File(made.session) as file:
        assert file.attrs["complete"]
        assert file.attrs["hand"] == "left"
        assert file.attrs["protocol"] == "wrist6"
        assert file.attrs["subject_id"] == "P-7"
        assert file.attrs["exercise"] == "radial and ulnar"
        assert file.attrs["software_version"] == __version__
        assert np.array_equal(file["frames/timestamp"], made.truth.timestamp_s), "times as in the recording"
        assert set(np.asarray(file["frames/status"])) == {0}
        for name in ("wrist/position", "wrist/velocity", "wrist/rotation", "wrist/angular_velocity", "wrist/angles"):
            assert np.isfinite(file[name]).all()
            assert file[name].shape[0] == count
            assert np.isfinite(file[f"smoothed/{name}"]).all()
        assert np.asarray(file["detections/frame"]).max() == count - 1
        assert np.isfinite(file["calibration/marker_position"]).all()
        wrist_m = file["wrist/position"][()] @ file["calibration/rotation"][()].T + file["calibration/translation"][()]
        assert np.abs(wrist_m - file["markers/position_camera"][:, 0]).max() < 1e-6, "also where the skin glides"
        parameters = json.loads(str(file.attrs["parameters"]))
        assert parameters["settings"]["tracker"]["tissue"]["lasts_s"] > 0.0


def test_track_recording_angles_match_truth(made: Made) -> None:
    truth = np.degrees(made.truth.angles_rad)
    error = np.degrees(angles(made.session)) - truth
    assert np.sqrt((error**2).mean(axis=0)) == pytest.approx([0.0, 0.0, 0.0], abs=1.5)
    assert np.sqrt((error[:, 0] ** 2).mean()) < 0.5
    assert np.ptp(truth[:, 0]) > 10.0, "the hand did move"


def test_track_recording_smoothed_angles_are_nearer(made: Made) -> None:
    truth = made.truth.angles_rad
    filtered, smoothed = (angles(made.session, group) - truth for group in ("wrist", "smoothed/wrist"))
    assert np.sqrt((smoothed**2).mean()) < np.sqrt((filtered**2).mean())


def test_retrack_from_detections_gives_equal_angles(made: Made, tmp_path: Path) -> None:
    report = retrack_again(made, tmp_path / "again.h5")
    assert (report.frames, report.tracked) == (made.report.frames, made.report.tracked)
    for group in ("wrist", "smoothed/wrist"):
        assert np.array_equal(angles(tmp_path / "again.h5", group), angles(made.session, group))
    with h5py.File(made.session) as old, h5py.File(tmp_path / "again.h5") as new:
        assert new.attrs["complete"]
        assert new.attrs["origin"] == old.attrs["session_id"]
        assert new.attrs["session_id"] != old.attrs["session_id"]
        for name in ("subject_id", "hand", "protocol", "exercise"):
            assert new.attrs[name] == old.attrs[name]
        assert np.array_equal(new["markers/measured"], old["markers/measured"], equal_nan=True)
        assert np.array_equal(new["detections/pixel"], old["detections/pixel"])
    retrack_session(tmp_path / "again.h5", tmp_path / "third.h5", TrackSettings())
    assert np.array_equal(angles(tmp_path / "third.h5"), angles(made.session)), "and again from that"


def test_track_lazy_frames_give_equal_session(made: Made, tmp_path: Path) -> None:
    source = TumFolder(made.folder)
    with RawWriter(tmp_path / "r.carpusraw", source.info, lossless=True) as writer:
        for frame in source.frames():
            writer.append_frame(frame)
    raw = RawRecording(tmp_path / "r.carpusraw")
    track_recording(raw, made.clicks, tmp_path / "new.h5", TrackSettings())
    with h5py.File(made.session) as old, h5py.File(tmp_path / "new.h5") as new:
        for name in ("wrist/angles", "smoothed/wrist/angles", "detections/pixel", "detections/depth", "surface/depth"):
            np.testing.assert_array_equal(new[name], old[name])


def test_retrack_keeps_old_file_and_uses_new_settings(made: Made, tmp_path: Path) -> None:
    before = digest(made.session)
    colour_only = replace(TrackSettings(), tracker=TrackerSettings(use_depth=False), smooth=False)
    retrack_again(made, tmp_path / "colour.h5", colour_only)
    assert digest(made.session) == before
    assert not np.allclose(angles(tmp_path / "colour.h5"), angles(made.session))
    assert read_session(tmp_path / "colour.h5").smoothed is None
    with pytest.raises(OutputExists):
        retrack_again(made, tmp_path / "colour.h5")


def test_track_recording_existing_output_raises(made: Made, tmp_path: Path) -> None:
    output = tmp_path / "session.h5"
    output.write_bytes(b"someone's own")
    with pytest.raises(OutputExists):
        track(made.folder, made.clicks, output)
    assert output.read_bytes() == b"someone's own"


def test_track_recording_without_frames_raises(made: Made, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(TumFolder, "frames", lambda _: iter(()))
    with pytest.raises(RecordingEmpty):
        track(made.folder, made.clicks, tmp_path / "s.h5")
    assert list(tmp_path.iterdir()) == []


def copy_session(made: Made, to: Path) -> Path:
    shutil.copytree(made.folder, to)
    return to


def test_track_recording_damaged_image_leaves_no_output(made: Made, tmp_path: Path) -> None:
    folder = copy_session(made, tmp_path / "damaged")
    pictures = sorted((folder / "rgb").iterdir())
    pictures[len(pictures) // 2].write_bytes(pictures[0].read_bytes()[:400])
    (tmp_path / "out").mkdir()
    with pytest.raises(FrameDamaged):
        track(folder, made.clicks, tmp_path / "out" / "session.h5")
    assert list((tmp_path / "out").iterdir()) == []


@pytest.mark.parametrize("why", [KeyboardInterrupt, DiskFull])
def test_track_recording_stopped_or_full_disk_leaves_no_output(
    why: type[BaseException], made: Made, tmp_path: Path
) -> None:
    """The recording is still there; what a full disk took is given back."""

    def stop(done: int, _total: int | None) -> None:
        if done == 20:
            raise why

    with pytest.raises(why):
        track(made.folder, made.clicks, tmp_path / "session.h5", progress=stop)
    assert list(tmp_path.iterdir()) == []


def test_retrack_keeps_header_and_set_up(made: Made, tmp_path: Path) -> None:
    """Where the hand was at the start, what was aimed at, that it was simulated; and a poor verdict stops nothing."""
    aims, start = {"repetitions": 7, "targets_deg": [20.0, None]}, np.radians([0.0, 20.0, 0.0])
    settings = replace(TrackSettings(), calibration=CalibrationSettings(min_distance_m=2.0), smooth=False)
    verdicts: list[Verdict] = []
    first = tmp_path / "s.h5"
    report = track(
        made.folder, made.clicks, first, settings, on_verdict=verdicts.append, start_angles_rad=start, set_up=aims
    )
    assert [[finding.kind for finding in verdict.findings] for verdict in verdicts] == [["distance"]]
    assert report.frames == len(made.truth.timestamp_s)
    assert np.degrees(angles(first)[:15].mean(axis=0)) == pytest.approx([0.0, 20.0, 0.0], abs=1.0)
    assert np.allclose(read_session(first).calibration.start_angles_rad, start)
    with_pictures = tmp_path / "p.h5"
    keep_pictures(made.folder, first, with_pictures)
    for origin, form in ((first, None), (with_pictures, "session")):
        again = origin.with_suffix(".again.h5")
        retrack_session(origin, again, settings)
        session = read_session(again)
        header = session.header
        assert json.loads(header.parameters)["source"].get("format") == form
        assert (header.is_simulated, header.set_up, header.targets_deg[0]) == (True, aims, 20.0)
        assert np.isnan(header.targets_deg[1])
        assert not replace(header, parameters=json.dumps({"source": {"format": "tum"}})).is_simulated
        assert session.smoothed is None
        assert form or np.array_equal(angles(again), angles(first))


def keep_pictures(folder: Path, session: Path, output: Path) -> None:
    """A session with the head of another and the pictures that one was tracked from."""
    stored = read_session(session)
    writer, pictures = SessionWriter.create(output, stored.header, stored.camera, stored.calibration), []
    for frame in TumFolder(folder).frames():
        assert frame.depth_raw is not None
        pictures.append(EncodedImages(encode_color(frame.color_rgb, lossless=True), encode_depth(frame.depth_raw)))
        writer.append(replace(make_frame(frame.index), timestamp_s=frame.timestamp_s))
    writer.close()
    add_pictures(output, pictures, DEPTH_UNIT_M)


@pytest.mark.parametrize(
    ("place", "value"),
    [
        ("/calibration/rotation", 1e9), ("/calibration/translation", np.nan), ("/calibration/marker_position", np.nan),
        ("/calibration/marker_covariance", -1.0), ("/calibration/start_angles", np.inf), ("/detections/pixel", np.nan),
        ("/detections/depth_sd", -1e300), ("/detections/similarity", np.inf),
    ],
)  # fmt: skip
def test_retrack_invalid_calibration_or_detections_raise(place: str, value: float, made: Made, tmp_path: Path) -> None:
    damaged = tmp_path / "damaged.h5"
    shutil.copy(made.session, damaged)
    with h5py.File(damaged, "r+") as file:
        values = file[place][...]
        values.flat[values.size // 2] = value
        file[place][...] = values
    with pytest.raises(SessionUnreadable, match="damaged"):
        retrack_session(damaged, tmp_path / "again.h5", TrackSettings())
    assert not list(tmp_path.glob("again*"))


def test_restart_at_neutral_once_after_still_frames() -> None:
    """The still frames made the calibration; what they say must not be counted again."""
    log: list[float | str] = []

    class Begun:
        def begin_at_neutral(self) -> None:
            log.append("begun")

    for time_s in restart_at_neutral([0.0, 0.1, 0.2, 0.3, 0.4], Begun(), 0.2, lambda time_s: time_s):  # type: ignore[arg-type]
        log.append(time_s)
    assert log == [0.0, 0.1, 0.2, "begun", 0.3, 0.4]
