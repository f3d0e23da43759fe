"""What ``carpus track`` says on the side."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from tqdm import tqdm

from app.__main__ import main
from core.hand.protocols import HAND21, WRIST6, MarkerProtocol
from core.pipeline.track import Learnt, TrackSettings, parameters_json
from core.session.reader import read_session
from core.session.values import new_header
from core.session.writer import SessionWriter
from core.tracking.finger_settings import FingerSettings
from core.tracking.settings import TrackerSettings
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
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(tqdm, "monitor_interval", 0)  # the bar's own thread would outlive the test
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
    options: tuple[str, ...], dip: str, on_skin: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tqdm, "monitor_interval", 0)  # the bar's own thread would outlive the test
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
