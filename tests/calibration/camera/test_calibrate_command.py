"""``carpus calibrate-camera``: the board as PDF, a recording to a camera file, and what later recordings make of
it."""

from __future__ import annotations

import re
from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pytest

from carpus.app.__main__ import main
from carpus.app.settings import load_settings
from carpus.app.sources import open_recording
from carpus.core.capture.calibrated_source import (
    CalibratedSource,
    compute_correction_table,
    load_stored_calibration,
    new_calibration_path,
    with_stored_calibration,
)
from carpus.core.capture.camera_info import StoredCalibration, read_camera_info, write_camera_info
from carpus.core.capture.files.raw import RawWriter
from carpus.core.capture.source import SourceInfo
from carpus.core.model.camera import DEFAULT_CAMERA
from carpus.core.model.errors import CameraFileUnreadable
from carpus.core.model.names import CAMERAS_FOLDER
from carpus.core.model.types import Frame
from carpus.core.pipeline.track import describe_source
from carpus.core.simulation.sensor import depth_scale
from tests.calibration.camera.printed import ShownSheets
from tests.studio import LENS, Studio

SERIAL = "1206-77"


@pytest.fixture(scope="module")
def recording(shown: list[Frame], tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The board as the live camera's raw recording has it."""
    path = tmp_path_factory.mktemp("board") / "board.carpusraw"
    with RawWriter(path, SourceInfo("camera", DEFAULT_CAMERA, True, None, 1.0, {"serial": SERIAL})) as writer:
        for frame in shown:
            writer.append_frame(frame)
    return path


def stored(data_folder: Path, serial: str, day: int, scale: float = 1.0, offset_m: float = 0.0) -> None:
    when = datetime(2026, 11, day, 9, tzinfo=UTC)
    path = new_calibration_path(data_folder, serial, when)
    path.parent.mkdir(parents=True, exist_ok=True)
    kept = StoredCalibration(serial, when.isoformat(), scale, offset_m, 0.2, 20)
    write_camera_info(path, LENS, calibration=kept)


@pytest.mark.usefixtures("qapp")
def test_calibrate_command_board_page_has_its_size(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pdf = tmp_path / "board.pdf"
    assert main(["calibrate-camera", "--board", str(pdf), "--paper", "letter"]) == 0
    box = re.search(rb"/MediaBox \[0 0 ([\d.]+) ([\d.]+)\]", pdf.read_bytes())
    assert box is not None
    np.testing.assert_allclose([float(one) * 25.4 / 72.0 for one in box.groups()], [279.4, 215.9], atol=0.4)
    assert "100 %" in capsys.readouterr().out
    assert main(["calibrate-camera", "--board", str(pdf)]) == 1
    assert "A file with this name already exists" in capsys.readouterr().err


def test_calibrate_command_writes_a_file_that_is_used(
    recording: Path, studio: Studio, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    output = tmp_path / "camera_info.yaml"
    assert main(["calibrate-camera", str(recording), "--output", str(output)]) == 0
    said = capsys.readouterr().out
    assert f"Saved for camera {SERIAL}" in said
    assert main(["calibrate-camera", str(recording), "--output", str(output)]) == 1, "no file is replaced"
    info = read_camera_info(output)
    assert info.camera.fx_px == pytest.approx(LENS.fx_px, rel=0.003)
    assert info.registered is True
    assert info.calibration is not None
    assert info.calibration.depth_scale == pytest.approx(depth_scale(studio.spec), abs=0.002)

    folder = load_settings().data_folder
    again = open_recording(recording, data_folder=folder)
    assert again.info.camera.fx_px == info.camera.fx_px
    facts = describe_source(again.info)
    assert facts["intrinsics"] == "calibration"
    assert facts["calibrated"] == info.calibration.calibrated
    assert float(facts["calibration_age_days"]) == pytest.approx(0.0, abs=0.1)
    # what was corrected already is not corrected twice by a second calibration
    assert open_recording(recording).info.camera.origin != "calibration"


def test_calibrate_command_without_board_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "empty.carpusraw"
    source = ShownSheets(Studio(), [[], []])
    with RawWriter(path, source.info) as writer:
        for frame in source.frames():
            writer.append_frame(frame)
    assert main(["calibrate-camera", str(path)]) == 1
    said = capsys.readouterr().err.splitlines()
    assert len(said) == 1
    assert "calibration board is not visible" in said[0]


def test_stored_calibration_newest_of_the_camera_is_used(tmp_path: Path) -> None:
    stored(tmp_path, SERIAL, 3, scale=1.01)
    stored(tmp_path, SERIAL, 9, scale=1.02)
    stored(tmp_path, SERIAL + "-b", 12, scale=1.03)
    for scale, path in zip(
        (1.02, 1.01), sorted((tmp_path / CAMERAS_FOLDER).glob(f"{SERIAL}_*"), reverse=True), strict=True
    ):
        found = load_stored_calibration(tmp_path, SERIAL)
        assert found is not None
        assert found.calibration is not None
        assert found.calibration.depth_scale == scale
        path.write_text("torn")


@pytest.mark.parametrize("origin", ["file", "calibration"])
def test_calibrated_source_keeps_own_intrinsics(tmp_path: Path, origin: str) -> None:
    stored(tmp_path, SERIAL, 3)
    source = ShownSheets(Studio(), [[]], SERIAL)
    assert isinstance(with_stored_calibration(source, tmp_path), CalibratedSource)
    camera = LENS if origin == "file" else with_stored_calibration(source, tmp_path).info.camera
    source.info = type(source.info)("x", camera, True, 1, 30.0, source.info.settings)
    assert with_stored_calibration(source, tmp_path) is source


def test_calibrated_source_corrects_depth_to_a_tenth_mm() -> None:
    made = StoredCalibration(SERIAL, "2026-11-20T08:00:00+00:00", 1.02, 0.004)
    table = compute_correction_table(made, 0.001)
    true_m = np.array([0.45, 0.6, 1.0, 3.0])
    measured = np.round((1.02 * true_m + 0.004) * 1000).astype(int)
    np.testing.assert_allclose(table[measured] * 1e-4, true_m, atol=0.55e-3)
    assert table[0] == 0


@pytest.mark.parametrize("line", ["depth_scale: 7.0", "depth_scale: many", "depth_offset_m: .nan"])
def test_stored_calibration_implausible_is_refused(tmp_path: Path, line: str) -> None:
    stored(tmp_path, SERIAL, 3, scale=1.01, offset_m=0.002)
    (path,) = (tmp_path / CAMERAS_FOLDER).iterdir()
    name = line.split(":")[0]
    path.write_text(re.sub(rf"{name}: [-\d.]+", line, path.read_text()))
    with pytest.raises(CameraFileUnreadable):
        read_camera_info(path)
