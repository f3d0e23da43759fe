"""The ten lines of a researcher: track, read, compare with the truth."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import sys
from itertools import product
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
import pytest

import carpus
from carpus.app.python_api import HandFrame, ProposedClicks
from carpus.core.model.errors import CalibrationImpossible, ExtraMissing, SessionsMissing, SettingsInvalid
from carpus.core.model.hand.protocols import get_protocol
from tests.rendered import FLEXION, REPEATED_FLEXION, Rendered

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def folder(rendered: Rendered) -> Path:
    return rendered(REPEATED_FLEXION)


@pytest.fixture(scope="module")
def frames(folder: Path) -> list[HandFrame]:
    return list(carpus.track(folder, folder / "calibration.json"))


CLICKS = ProposedClicks("right", "wrist6", {name: [1.0, 2.0] for name in get_protocol("wrist6").markers}, {})
PICTURE = np.zeros((4, 4, 3), dtype=np.uint8)
USUAL: dict[str, dict[str, Any]] = {
    "track": {"path": "r", "clicks": CLICKS},
    "write_session": {"path": "r", "clicks": CLICKS, "output": "x.h5"},
    "open_session": {"path": "s.h5"},
    "simulate": {"folder": "r"},
    "export": {"sessions": "s.h5", "folder": "out"},
    "compare": {"session": "s.h5", "reference": "r.csv"},
    "propose_clicks": {"frame": PICTURE},
}
"""What each function may be given."""

SETTINGS = [
    ({"dip": "fre"}, "dip is 'fre', 'coupled' or 'free' expected"),
    ({"use_depth": "no"}, "use_depth is 'no', True or False expected"),
    ({"profile": "brsk"}, "profile is 'brsk', 'slow' or 'standard' or 'brisk' expected"),
    ({"filter": "papers"}, "filter is 'papers', 'default' or 'paper' expected"),
    ({"lost_after_s": "long"}, "lost_after_s is 'long'"),
    ({"lost_after_s": -1}, "lost_after_s = -1, from 0"),
    ({"filter": "paper", "dip": "free"}, "the papers' filter knows no dip"),
]
NO_PATH = [None, 5, b"x", [None], {}, "a\0b"]
OF_A_FUNCTION = [
    ("simulate", {"second": 3.0}, "second"),
    ("simulate", {"seconds": "long"}, "seconds is 'long', a number expected"),
    ("simulate", {"motion": 3}, "motion is 3"),
    ("compare", {"smoothed": "no"}, "smoothed is 'no'"),
    ("compare", {"most_shift_s": -1}, "most_shift_s is -1, from 0 to 3600 expected"),
    ("compare", {"lag_s": 1e9}, "lag_s is"),
    ("compare", {"drift_percent": 11.0}, "drift_percent is 11.0, from -10 to 10"),
    ("compare", {"radians": "no"}, "radians is 'no', True or False"),
    ("compare", {"markers": ["a"]}, "markers is ['a'], a mapping"),
    ("compare", {"markers": {"MCP9": "a"}}, "a name in markers is 'MCP9'"),
    ("compare", {"columns": {"flexoin": "a"}}, "a name in columns is 'flexoin', 'time' or 'deviation' or 'flexion'"),
    ("compare", {"columns": {"flexion": 2}}, "columns['flexion'] is 2, a text"),
    ("compare", {"columns": "flexion"}, "columns is 'flexion'"),
    ("export", {"deidentified": "no"}, "deidentified is 'no', True or False"),
    ("export", {"formats": "xyz"}, "formats is 'xyz', 'csv' or"),
    ("export", {"formats": ["xls"]}, "xls"),
    ("export", {"formats": [5]}, "formats is 5"),
    ("write_session", {"subject_id": 5}, "subject_id is 5, a text"),
    ("write_session", {"exercise": None}, "exercise is None, a text"),
    ("write_session", {"exercise": "WRIST_XX"}, "exercise is 'WRIST_XX', 'WRIST_FE' or"),
    ("propose_clicks", {"hand": np.array(["right", "left"])}, "hand is array"),
    ("propose_clicks", {"hand": "middle"}, "hand is 'middle', 'right' or 'left' expected"),
    ("propose_clicks", {"depth": np.zeros((2, 2), dtype=np.uint16)}, "depth is no"),
    *(
        ("propose_clicks", {"frame": picture}, "frame is no recording and no picture (H, W, 3) uint8")
        for picture in (5, np.zeros((4, 4), np.uint8), np.zeros((4, 4, 3)), np.zeros((0, 0, 3), np.uint8))
    ),
]


def refused(function: str, wrong: dict[str, Any], said: str) -> None:
    """In one sentence, at once."""
    with pytest.raises(SettingsInvalid, match=re.escape(said)):
        getattr(carpus, function)(**USUAL[function] | wrong)


@pytest.mark.parametrize(("wrong", "said"), SETTINGS)
def test_wrong_setting_is_refused(wrong: dict[str, Any], said: str) -> None:
    for function in ("track", "write_session"):
        refused(function, wrong, said)


@pytest.mark.parametrize(("function", "wrong", "said"), OF_A_FUNCTION)
def test_wrong_value_is_refused(function: str, wrong: dict[str, Any], said: str) -> None:
    refused(function, wrong, said)


def test_non_path_argument_is_refused() -> None:
    for function, usual in USUAL.items():
        for name, value in product(usual, NO_PATH):
            if function != "propose_clicks":
                refused(function, {name: [value] if name == "sessions" else value}, ", a path expected")


def test_python_api_loads_modules_only_when_used(folder: Path) -> None:
    script = "import sys, carpus; print(*dir(carpus)); print('numpy' in sys.modules)\n"
    script += "session = carpus.open_session(sys.argv[1])\n"
    script += "print(len(session), session.header.hand, 'PySide6' in sys.modules)\n"
    script += "print({'cv2', 'scipy.optimize', 'pandas', 'carpus.core.tracking.tracker'} & set(sys.modules))\n"
    script += "import multiprocessing; print(multiprocessing.active_children())"
    command = [sys.executable, "-c", script, str(folder / "truth.h5")]
    listed, loaded, opened, costly, processes = subprocess.run(
        command, cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout.splitlines()
    assert listed.split() == sorted(
        [
            "__version__",
            "track",
            "write_session",
            "open_session",
            "open_sessions",
            "simulate",
            "propose_clicks",
            "export",
            "compare",
        ]
    )
    assert loaded == "False"
    assert opened.split() == ["74", "right", "False"]
    assert (costly, processes) == ("set()", "[]"), "the first session opens in half a second"


def test_papers_filter_in_python_equals_the_command(rendered: Rendered, tmp_path: Path) -> None:
    folder = rendered(FLEXION)
    frames = list(carpus.track(folder, folder / "calibration.json", filter="paper"))
    session = carpus.write_session(folder, folder / "calibration.json", tmp_path / "paper.h5", filter="paper")
    assert [frame.wrist.flexion_deg for frame in frames] == np.degrees(session.motion.angles_rad[:, 1]).tolist()
    settings = json.loads(session.header.parameters)["settings"]
    assert settings["paper"] is not None
    assert (settings["smooth"], session.smoothed) == (False, None), "the papers do not look back"
    assert np.isnan(frames[-1].wrist.angular_velocity_deg_s).all(), "white noise in the papers' model"


def test_session_is_written_with_velocities_and_repetitions(
    folder: Path, frames: list[HandFrame], tmp_path: Path
) -> None:
    clicks = folder / "calibration.json"
    session = carpus.write_session(folder, clicks, tmp_path / "s.h5", exercise="WRIST_FE", subject_id="P-1")
    assert session.smoothed is not None
    assert np.array([frame.wrist.velocity_m_s for frame in frames]) == pytest.approx(session.motion.velocity_m_s)
    turning = np.array([frame.wrist.angular_velocity_deg_s for frame in frames])
    assert np.radians(turning) == pytest.approx(session.motion.angular_velocity_rad_s)
    tables = session.tables()
    assert len(tables["repetitions"]) == len(session.repetitions.rows) >= 1
    wrist, repetitions = tables["wrist"], tables["repetitions"]
    assert wrist.index.name == "time"
    assert wrist.index.total_seconds()[-1] == pytest.approx(session.timestamp_s[-1] - session.timestamp_s[0], abs=1e-5)
    assert wrist.attrs["units"]["filter_flexion_deg"] == "deg"
    assert wrist.attrs["units"]["smoother_velocity_x_mm_s"] == "mm/s"
    assert len(wrist["filter_flexion_deg"].resample("500ms").mean()) == 10
    assert repetitions.index.total_seconds().tolist() == pytest.approx(repetitions["start_s"].tolist(), abs=1e-5)
    assert repetitions.attrs["units"]["peak_speed_deg_s"] == "deg/s"


@pytest.mark.parametrize("protocol", ["wrist6", "hand21"])
def test_markers_are_proposed_and_can_be_tracked_with(protocol: str, tmp_path: Path) -> None:
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
    assert set(tables) == {"wrist", "markers", "events", "repetitions", "measures"}
    assert np.allclose(tables["wrist"]["filter_flexion_deg"], np.degrees(session.motion.angles_rad[:, 1]))
    assert len(tables["markers"]["marker"]) == 6 * len(session)
    assert {row.unit for row in session.measures()} >= {"deg"}
    assert session.provenance()["of"]["recording_id"] == session.header.recording_id


def test_session_repr_has_ten_lines_and_a_picture(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    session = carpus.open_session(folder / "truth.h5")
    assert len(repr(session).splitlines()) <= 10
    assert "wrist6" in repr(session)
    assert "data:image/png;base64," in session._repr_html_()
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    assert "wrist6" in session._repr_html_(), "without matplotlib the lines alone"


def test_frame_and_labelled_arrays_hold_the_angles_with_units(folder: Path) -> None:
    session = carpus.open_session(folder / "truth.h5")
    flexion = np.degrees(session.motion.angles_rad[:, 1])
    frame, arrays = session.to_dataframe("filter"), session.to_xarray("filter")
    assert np.array_equal(frame["flexion_deg"], flexion)
    assert frame.attrs["units"]["flexion_sd_deg"] == "deg"
    assert np.array_equal(arrays["flexion"], flexion)
    assert arrays["flexion"].attrs["units"] == "deg"
    assert arrays["time"].attrs["units"] == "s"
    shape = {"time": len(session), "marker": 6, "axis": 3}
    assert dict(arrays["marker_position"].sizes) == shape
    with pytest.raises(SettingsInvalid, match="which did not run"):
        session.to_xarray("smoother")


def test_plot_has_a_line_and_a_band_for_each_angle(folder: Path) -> None:
    matplotlib.use("Agg")
    session = carpus.open_session(folder / "truth.h5")
    axes = session.plot()
    assert [line.get_label() for line in axes.lines] == ["deviation", "flexion", "pronosupination"]
    assert len(axes.collections) == 3
    (line,) = session.plot(["flexion"], ax=axes.figure.add_subplot()).lines
    assert np.array_equal(line.get_ydata(), np.degrees(session.motion.angles_rad[:, 1]))
    with pytest.raises(SettingsInvalid, match="there is no angle called 'flexoin'"):
        session.plot(["flexoin"])


def test_study_is_one_table_and_warns_of_an_unreadable_file(folder: Path, tmp_path: Path) -> None:
    (tmp_path / "good.h5").write_bytes((folder / "truth.h5").read_bytes())
    (tmp_path / "bad.h5").write_bytes(b"no session")
    with pytest.warns(UserWarning, match="bad.h5"):
        study = carpus.open_sessions(tmp_path)
    with pytest.raises(SessionsMissing):
        carpus.open_sessions([])
    assert set(study["session"]) == {"good"}
    assert study["key"].is_unique
    assert all(re.fullmatch(r"[a-z0-9_]+", key) for key in study["key"])
    assert study.set_index("key")["mean"]["flexion_arc"] > 10.0
    assert str(study["recorded"].dt.tz) == "UTC"


def test_missing_pandas_is_reported_in_a_sentence(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(ExtraMissing) as raised:
        carpus.open_session(folder / "truth.h5").tables()
    said = "\n".join(raised.value.__notes__)
    assert "A required Python package is not installed: pandas." in said
    assert "pip install 'carpus[research]'" in said


def test_page_of_the_interface_runs_from_top_to_bottom(
    folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(carpus, "simulate", lambda into, **_: shutil.copytree(folder, into), raising=False)
    page = (ROOT / "resources" / "api.md").read_text(encoding="utf-8")
    for block in re.findall(r"```python\n(.*?)```", page, re.DOTALL):
        shorter = block.replace("range(1, 5)", "range(1, 2)").replace("range(5)", "range(2)")
        exec(compile(shorter, "api.md", "exec"), {})
    assert (tmp_path / "progress.png").stat().st_size > 5000
    assert list((tmp_path / "exported").glob("*.c3d"))


def test_export_and_compare_in_ten_lines(folder: Path, tmp_path: Path) -> None:
    done = carpus.export(folder / "truth.h5", tmp_path, ["mot", "c3d"])
    assert {path.suffix for path in done.files} >= {".mot", ".c3d"}
    found = carpus.compare(folder / "truth.h5", tmp_path / "truth.mot")
    assert max(pair.figures_deg.rmse for pair in found.pairs) < 0.1
    given = carpus.compare(folder / "truth.h5", tmp_path / "truth.mot", lag_s=0.1, drift_percent=1.0).shift
    assert (given.lag_s, given.is_given, given.drift) == (0.1, True, pytest.approx(0.01))


def test_help_loads_neither_numpy_nor_tracker() -> None:
    script = """
import sys
from carpus.app.__main__ import main
for words in (["--help"], ["track", "--help"], ["results", "--help"]):
    try:
        main(words)
    except SystemExit:
        print({"numpy", "cv2", "carpus.core.tracking.tracker"} & set(sys.modules))
"""
    done = subprocess.run([sys.executable, "-c", script], cwd=ROOT, capture_output=True, text=True, check=True)
    assert [line for line in done.stdout.splitlines() if line.startswith(("set", "{"))] == ["set()"] * 3
