"""What ``carpus track`` says on the side."""

from __future__ import annotations

import argparse
import json
import os
import shutil
from datetime import UTC, datetime
from pathlib import Path

import h5py
import pytest

from carpus import __version__
from carpus.app.__main__ import main
from carpus.app.commands import track
from carpus.app.settings import load_settings, settings_folder
from carpus.core.detection.settings import DetectionSettings
from carpus.core.hand.exercises import EXERCISES
from carpus.core.hand.protocols import HAND21, WRIST6, MarkerProtocol
from carpus.core.pipeline.track import Learnt, TrackSettings, parameters_json
from carpus.core.session.reader import read_session
from carpus.core.session.values import new_header
from carpus.core.session.writer import SessionWriter
from carpus.core.tracking.finger_settings import FingerSettings
from carpus.core.tracking.settings import TrackerSettings
from tests.rendered import FLEXION, Rendered
from tests.session.samples import CAMERA, make_calibration


@pytest.mark.parametrize(("option", "warned"), [("--depth", False), ("--no-depth", True)])
def test_colour_alone_is_warned_of(
    option: str, warned: bool, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    missing = tmp_path / "none"
    arguments = ["track", str(missing), "--calibration", str(missing), "--output", str(tmp_path / "out.h5"), option]
    assert main(arguments) == 1
    said = capsys.readouterr().err
    assert ("mirror image" in said) == warned
    assert str(missing) in said


@pytest.mark.parametrize(
    ("protocol", "option", "warned"),
    [(HAND21, "--no-depth", True), (HAND21, "--depth", False), (WRIST6, "--no-depth", False)],
)
def test_fingers_by_colour_alone_are_called_an_experiment(
    protocol: MarkerProtocol,
    option: str,
    warned: bool,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    session, output = tmp_path / "session.h5", tmp_path / "again.h5"
    header = new_header(hand="right", protocol=protocol, software_version="0")
    SessionWriter.create(session, header, CAMERA, make_calibration(protocol)).close()
    main(["track", str(session), "--output", str(output), option])
    assert ("experimental" in capsys.readouterr().err) == warned


@pytest.mark.parametrize(
    ("options", "dip", "on_skin"),
    [((), "free", False), (("--dip", "coupled"), "coupled", False), (("--discs", "on-skin"), "free", True)],
)
def test_a_session_tracked_again_keeps_its_end_joints_and_its_discs_unless_told(
    options: tuple[str, ...], dip: str, on_skin: bool, tmp_path: Path
) -> None:
    session, output = tmp_path / "session.h5", tmp_path / "again.h5"
    tracker = TrackerSettings(dip="free", fingers=FingerSettings(skin_offsets=False))
    parameters = parameters_json(TrackSettings(tracker=tracker), {}, Learnt(0.1, 1.0, 0.0))
    header = new_header(hand="right", protocol=HAND21, software_version="0", dip_free=True, parameters=parameters)
    SessionWriter.create(session, header, CAMERA, make_calibration(HAND21)).close()
    assert main(["track", str(session), "--output", str(output), "--no-smooth", *options]) == 0
    again = read_session(output).header
    told = json.loads(again.parameters)["settings"]["tracker"]
    assert (told["dip"], told["fingers"]["skin_offsets"]) == (dip, on_skin)
    assert ("DIP3_flexion" in again.joint_names) == (dip == "free")


def a_session(path: Path, settings: TrackSettings, version: str = __version__) -> Path:
    parameters = parameters_json(settings, {}, Learnt(0.1, 1.0, 0.0))
    header = new_header(hand="right", protocol=WRIST6, software_version=version, parameters=parameters)
    SessionWriter.create(path, header, CAMERA, make_calibration()).close()
    return path


def test_a_session_is_tracked_again_as_it_was_and_what_differs_is_said(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    detection = DetectionSettings(least_area=0.2)
    tracker = TrackerSettings(profile="slow", mode_scales=(1.0,), use_depth=False)
    before = TrackSettings(tracker=tracker, detection=detection, smooth=False)
    session = a_session(tmp_path / "session.h5", before)
    assert main(["track", str(session), "--output", str(tmp_path / "same.h5")]) == 0
    said = capsys.readouterr().out
    old, same = read_session(session).header, read_session(tmp_path / "same.h5").header
    assert json.loads(same.parameters)["settings"] == json.loads(old.parameters)["settings"]
    assert (same.origin, same.recording_id, same.recorded) == (old.session_id, old.recording_id, old.recorded)
    assert "same settings as before" in said
    assert old.session_id in said
    assert main(["track", str(session), "--output", str(tmp_path / "brisk.h5"), "--profile", "brisk", "--depth"]) == 0
    said = capsys.readouterr().out
    assert "tracker.profile brisk (was slow)" in said
    assert "tracker.use_depth True (was False)" in said
    other = json.loads(read_session(tmp_path / "brisk.h5").header.parameters)["settings"]["tracker"]
    assert (other["profile"], other["mode_scales"], other["use_depth"]) == ("brisk", [1.0], True)


def test_another_version_and_a_setting_that_is_gone_are_said(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    session = a_session(tmp_path / "session.h5", TrackSettings(), version="0.0.9")
    with h5py.File(session, "r+") as file:
        parameters = json.loads(str(file.attrs["parameters"]))
        parameters["settings"]["tracker"]["oracle"] = 3
        file.attrs.modify("parameters", json.dumps(parameters))
    assert main(["track", str(session), "--output", str(tmp_path / "again.h5")]) == 0
    said = capsys.readouterr().out
    assert "was 0.0.9" in said
    assert "tracker.oracle no longer there" in said


def test_a_recording_is_tracked_with_the_settings_of_the_person(tmp_path: Path) -> None:
    (settings_folder() / "settings.toml").parent.mkdir(parents=True, exist_ok=True)
    (settings_folder() / "settings.toml").write_text('[tracker]\nprofile = "slow"\n', encoding="utf-8")
    arguments = argparse.ArgumentParser()
    track.add_arguments(arguments)
    own = load_settings().track
    assert own.tracker.profile == "slow"
    told = arguments.parse_args(["r", "--output", "o"])
    assert track.settings_from(told, own).tracker.profile == "slow"
    told = arguments.parse_args(["r", "--output", "o", "--profile", "brisk"])
    assert track.settings_from(told, own).tracker.profile == "brisk"


def test_an_unknown_exercise_is_refused_and_the_names_are_in_the_help(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    arguments = ["track", str(tmp_path), "--output", str(tmp_path / "o.h5"), "--exercise", "WRIST_EF"]
    with pytest.raises(SystemExit) as refused:
        main(arguments)
    assert refused.value.code == 2
    assert "WRIST_FE" in capsys.readouterr().err
    with pytest.raises(SystemExit):
        main(["track", "--help"])
    said = " ".join(capsys.readouterr().out.split())
    assert all(exercise.id in said for exercise in EXERCISES)


@pytest.mark.parametrize(
    ("options", "day", "doubted"),
    [((), datetime.fromtimestamp(1.7e9, UTC), True), (("--recorded", "2023-04-05T14:30+02:00"), None, False)],
)
def test_when_the_hand_moved_is_asked_or_taken_from_the_file_and_said(
    options: tuple[str, ...],
    day: datetime | None,
    doubted: bool,
    rendered: Rendered,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    folder = Path(shutil.copytree(rendered(FLEXION), tmp_path / "r"))
    times = [line.split()[0] for line in (folder / "rgb.txt").read_text("utf-8").splitlines() if line[0] != "#"]
    for name in ("rgb.txt", "depth.txt"):  # as a camera's own clock has it
        lines = (folder / name).read_text(encoding="utf-8").splitlines()
        moved = [line if line.startswith("#") else _later(line, 100.0 - float(times[0])) for line in lines]
        (folder / name).write_text("\n".join(moved), encoding="utf-8")
    os.utime(folder, (1.7e9, 1.7e9))
    command = ["track", str(folder), "--calibration", str(folder / "calibration.json"), "--no-smooth"]
    for name in ("a.h5", "b.h5"):
        assert main([*command, "--output", str(tmp_path / name), *options]) == 0
    assert ("does not say when the hand moved" in capsys.readouterr().err) == doubted
    one, two = (read_session(tmp_path / name).header for name in ("a.h5", "b.h5"))
    assert one.when == (day or datetime.fromisoformat("2023-04-05T14:30+02:00"))
    assert one.recording_id == two.recording_id
    assert one.session_id != two.session_id


def _later(line: str, shift_s: float) -> str:
    time_s, name = line.split(maxsplit=1)
    return f"{float(time_s) + shift_s:.6f} {name}"
