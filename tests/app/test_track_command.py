"""What ``carpus track`` says on the side, and streams; that nothing goes out unless a person chose it."""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Sequence
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
import pytest

from carpus import __version__
from carpus.app.commands import track_one
from carpus.core.capture.source import FrameSource
from carpus.core.detection.appearance import DetectionSettings
from carpus.core.model.hand.protocols import HAND21, WRIST6, MarkerProtocol
from carpus.core.model.types import TrackedFrame
from carpus.core.pipeline.track import NeutralNoise, TrackSettings, format_parameters
from carpus.core.session.reader import read_session
from carpus.core.session.values import new_header
from carpus.core.session.writer import SessionWriter
from carpus.core.tracking.filter.settings import FingerSettings, TrackerSettings
from tests.commands import Command
from tests.rendered import FLEXION, Rendered
from tests.session.samples import CAMERA, make_calibration


def store_recording(
    path: Path, protocol: MarkerProtocol = WRIST6, version: str = __version__, kinds: Sequence[str] = (), **header: Any
) -> Path:
    """A session without a frame, with events of these kinds."""
    made = replace(new_header(hand="right", protocol=protocol, **header), software_version=version)
    writer = SessionWriter.create(path, made, CAMERA, make_calibration(protocol))
    for kind in kinds:
        writer.add_event(1.0, kind, "words")
    writer.close()
    return path


def run_track(settings: TrackSettings) -> str:
    """As a session keeps them."""
    return format_parameters(settings, {}, NeutralNoise(0.1, 1.0, 0.0))


@pytest.mark.parametrize(
    ("options", "dip", "on_skin"),
    [((), "free", False), (("--dip", "coupled"), "coupled", False), (("--discs", "on-skin"), "free", True)],
)
def test_retracked_session_keeps_its_joints_and_markers(
    options: tuple[str, ...], dip: str, on_skin: bool, tmp_path: Path, command: Command
) -> None:
    settings = TrackSettings(tracker=TrackerSettings(dip="free", fingers=FingerSettings(skin_offsets=False)))
    session = store_recording(tmp_path / "s.h5", HAND21, "0", dip_free=True, parameters=run_track(settings))
    assert command("track", session, "--output", tmp_path / "again.h5", "--no-smooth", *options).code == 0
    again = read_session(tmp_path / "again.h5").header
    told = json.loads(again.parameters)["settings"]["tracker"]
    assert (told["dip"], told["fingers"]["skin_offsets"]) == (dip, on_skin)
    assert ("DIP3_flexion" in again.joint_names) == (dip == "free")


def test_retracked_session_keeps_settings_and_reports_differences(tmp_path: Path, command: Command) -> None:
    tracker = TrackerSettings(profile="slow", mode_scales=(1.0,), use_depth=False)
    before = TrackSettings(tracker=tracker, detection=DetectionSettings(min_area_ratio=0.2), smooth=False)
    session = store_recording(tmp_path / "session.h5", parameters=run_track(before))
    done = command("track", session, "--output", tmp_path / "same.h5")
    assert done.code == 0
    old, same = read_session(session).header, read_session(tmp_path / "same.h5").header
    assert json.loads(same.parameters)["settings"] == json.loads(old.parameters)["settings"]
    assert (same.origin, same.recording_id, same.recorded) == (old.session_id, old.recording_id, old.recorded)
    assert "same settings as before" in done.out
    assert old.session_id in done.out
    done = command("track", session, "--output", tmp_path / "brisk.h5", "--profile", "brisk", "--depth")
    assert done.code == 0
    assert "tracker.profile brisk (was slow)" in done.out
    assert "tracker.use_depth True (was False)" in done.out
    other = json.loads(read_session(tmp_path / "brisk.h5").header.parameters)["settings"]["tracker"]
    assert (other["profile"], other["mode_scales"], other["use_depth"]) == ("brisk", [1.0], True)


def test_other_version_and_removed_setting_are_reported(tmp_path: Path, command: Command) -> None:
    parameters = json.loads(run_track(TrackSettings()))
    parameters["settings"]["tracker"]["oracle"] = 3
    session = store_recording(tmp_path / "session.h5", version="0.0.9", parameters=json.dumps(parameters))
    done = command("track", session, "--output", tmp_path / "again.h5")
    assert done.code == 0
    assert "was 0.0.9" in done.out
    assert "no settings any more: tracker.oracle" in done.out


def test_live_labels_of_an_older_session_are_not_applied_again_and_reported(tmp_path: Path, command: Command) -> None:
    session = store_recording(tmp_path / "session.h5", kinds=("spot_said", "note", "spot_said"), version="0.2.0")
    done = command("track", session, "--output", tmp_path / "again.h5")
    assert (done.code, "labels given while measuring (2) are not applied again" in done.err) == (0, True)
    assert [event.kind for event in read_session(tmp_path / "again.h5").events] == ["note"]
    assert [event.kind for event in read_session(session).events] == ["spot_said", "note", "spot_said"]
    assert "labels" not in command("track", tmp_path / "again.h5", "--output", tmp_path / "third.h5").err


@pytest.mark.parametrize(
    ("options", "day", "doubted"),
    [
        ((), datetime.fromtimestamp(1.7e9, UTC), True),
        (("--recorded", "2023-04-05T14:30+02:00"), datetime.fromisoformat("2023-04-05T14:30+02:00"), False),
    ],
)
def test_motion_onset_is_asked_or_read_from_file_and_reported(
    options: tuple[str, ...], day: datetime, doubted: bool, rendered: Rendered, tmp_path: Path, command: Command
) -> None:
    folder = Path(shutil.copytree(rendered(FLEXION), tmp_path / "r"))
    times = [line.split()[0] for line in (folder / "rgb.txt").read_text("utf-8").splitlines() if line[0] != "#"]
    for name in ("rgb.txt", "depth.txt"):  # as a camera's own clock has it
        lines = (folder / name).read_text(encoding="utf-8").splitlines()
        moved = [line if line.startswith("#") else _later(line, 100.0 - float(times[0])) for line in lines]
        (folder / name).write_text("\n".join(moved), encoding="utf-8")
    os.utime(folder, (1.7e9, 1.7e9))
    words = ("track", folder, "--calibration", folder / "calibration.json", "--no-smooth", *options)
    done = command(*words, "--output", tmp_path / "a.h5")
    assert (done.code, "does not say when the hand moved" in done.err) == (0, doubted)
    one = read_session(tmp_path / "a.h5").header
    assert one.recording_time == day
    if doubted:
        assert command(*words, "--output", tmp_path / "b.h5").code == 0
        two = read_session(tmp_path / "b.h5").header
        assert one.recording_id == two.recording_id
        assert one.session_id != two.session_id


def _later(line: str, shift_s: float) -> str:
    time_s, name = line.split(maxsplit=1)
    return f"{float(time_s) + shift_s:.6f} {name}"


class Heard:
    """Stands for the outlets, which ``tests/pipeline`` reads back from another process."""

    frames: ClassVar[list[TrackedFrame]] = []
    has_listener = staticmethod(lambda _: False)

    def __init__(self, _clicks: object, rate_hz: float, **_: object) -> None:
        assert rate_hz == pytest.approx(30.0, abs=0.5)

    def on_frame(self, frame: TrackedFrame) -> None:
        self.frames.append(frame)


def test_stream_gets_the_tracked_frames_of_a_paced_recording(
    rendered: Rendered, tmp_path: Path, command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("carpus.core.pipeline.lsl_stream.SampleStream", Heard)
    paced: list[FrameSource] = []
    monkeypatch.setattr(track_one, "PacedSource", lambda source: paced.append(source) or source)
    done = command("track", rendered(FLEXION), "--output", tmp_path / "s.h5", "--stream", "--no-smooth")
    assert (done.code, "no program receives the stream" in done.err) == (0, True), done.err
    session = read_session(tmp_path / "s.h5")
    assert len(paced) == 1, "as fast as the frames were taken"
    assert len(session) == len(Heard.frames) == 24
    heard = np.array([frame.kinematics.angles_rad for frame in Heard.frames])
    np.testing.assert_allclose(heard, session.motion.angles_rad)
