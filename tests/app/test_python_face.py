"""The ten lines of a researcher: track, read, compare with the truth."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import carpus
from carpus.core.errors import CalibrationImpossible, SettingsInvalid
from carpus.core.session.reader import read_session

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("face") / "recording"
    truth = carpus.simulate(out, motion="flexion", seconds=2.0, seed=4)
    assert len(truth.time_s) == 60
    return out


def test_frames_come_as_values_and_agree_with_the_truth(folder: Path) -> None:
    frames = list(carpus.track(folder, folder / "calibration.json"))
    truth = read_session(folder / "truth.h5")
    assert [frame.time_s for frame in frames] == truth.timestamp_s.tolist()
    assert {frame.status for frame in frames} == {"tracked"}
    flexion = np.array([frame.wrist.flexion_deg for frame in frames])
    sd = np.array([frame.wrist.flexion_sd_deg for frame in frames])
    error = np.abs(flexion - np.degrees(truth.motion.angles_rad[:, 1]))
    assert error.max() < 3.0
    assert (error < 3.0 * sd).mean() > 0.9
    assert frames[0].marker_names == ("WRIST", "CMC1", "MCP2", "MCP3", "MCP4", "MCP5")
    assert frames[-1].marker_position_cam_m.shape == (6, 3)


def test_an_unknown_setting_is_named(folder: Path) -> None:
    with pytest.raises(SettingsInvalid, match="profil"):
        next(carpus.track(folder, folder / "calibration.json", profil="slow"))
    with pytest.raises(SettingsInvalid, match="second"):
        carpus.simulate(folder.parent / "other", second=3.0)
    with pytest.raises(AttributeError):
        _ = carpus.no_such_thing  # type: ignore[attr-defined]


def test_a_session_opens_and_nothing_of_the_window_is_loaded(folder: Path) -> None:
    program = (
        "import sys, carpus\n"
        "if __name__ == '__main__':\n"
        f"    session = carpus.open_session({str(folder / 'truth.h5')!r})\n"
        "    print(len(session), session.header.hand, 'PySide6' in sys.modules)\n"
    )
    script = folder.parent / "read.py"
    script.write_text(program, encoding="utf-8")
    done = subprocess.run([sys.executable, str(script)], cwd=ROOT, capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["60", "right", "False"]


@pytest.mark.parametrize("protocol", ["wrist6", "hand21"])
def test_the_discs_are_proposed_and_can_be_tracked_with(protocol: str, tmp_path: Path) -> None:
    recording = tmp_path / "recording"
    carpus.simulate(recording, protocol=protocol, motion="flexion", seconds=0.4, seed=4)
    found = carpus.propose_clicks(recording, hand="right", protocol=protocol)
    told = json.loads((recording / "calibration.json").read_text(encoding="utf-8"))["markers"]
    assert len(found.markers) >= 0.8 * len(told)
    off = {name: float(np.hypot(*np.subtract(found.markers[name], told[name]))) for name in found.markers}
    assert max(off.values()) < 8.0, "a click is a few pixels off, a disc has ten"
    if not found.complete:
        with pytest.raises(CalibrationImpossible, match=next(name for name in told if name not in found.markers)):
            found.clicks()
        return
    found.write(tmp_path / "clicks.json")
    frames = [frame.wrist.flexion_deg for frame in carpus.track(recording, tmp_path / "clicks.json")]
    assert frames == [frame.wrist.flexion_deg for frame in carpus.track(recording, found)]


def test_tables_measures_and_provenance_of_a_session(folder: Path) -> None:
    session = carpus.open_session(folder / "truth.h5")
    tables = session.tables()
    assert set(tables) == {"wrist", "markers", "events", "measures"}
    assert np.allclose(tables["wrist"]["flexion_deg"], np.degrees(session.motion.angles_rad[:, 1]))
    assert len(tables["markers"]["marker"]) == 6 * len(session)
    assert {row.unit for row in session.measures()} >= {"deg"}
    assert session.provenance()["of"]["recording_id"] == session.header.recording_id


def test_export_and_compare_in_ten_lines(folder: Path, tmp_path: Path) -> None:
    done = carpus.export(folder / "truth.h5", tmp_path, ["mot", "c3d"])
    assert {path.suffix for path in done.files} >= {".mot", ".c3d"}
    found = carpus.compare(folder / "truth.h5", tmp_path / "truth.mot")
    assert max(pair.figures_deg.rmse for pair in found.pairs) < 0.1
    with pytest.raises(ValueError, match="xls"):
        carpus.export(folder / "truth.h5", tmp_path / "other", ["xls"])


def test_the_page_of_python_names_every_function_and_its_lines_compile() -> None:
    page = (ROOT / "resources" / "api.md").read_text(encoding="utf-8")
    for name in set(carpus.__all__) - {"__version__"}:
        assert f"`{name}(" in page or f"carpus.{name}(" in page, name
    (lines,) = [part.split("```")[0] for part in page.split("```python")[1:]]
    compile(lines, "api.md", "exec")
    called = set(re.findall(r"carpus\.(\w+)\(", lines))
    assert called <= set(carpus.__all__)
