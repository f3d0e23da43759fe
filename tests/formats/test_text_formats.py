"""CSV, TRC, MOT, JSON and BIDS: numbers as in the session, missing as missing, and the rules of each format."""

from __future__ import annotations

import csv
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from carpus.core.formats import bids_motion, csv_tables, json_measures, mot, trc
from carpus.core.formats.export import ExportRequest, export_sessions
from carpus.core.model.errors import OutputExists
from carpus.core.model.hand.protocols import HAND21, WRIST_ANGLES
from carpus.core.model.types import TrackStatus
from carpus.core.session.reader import read_session
from tests.formats.takes import build_take, hand_take, stopping, store_session, wrist_take
from tests.ui.fakes import session as flexing


def read_rows(path: Path) -> list[dict[str, str]]:
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def numbers(rows: list[dict[str, str]], column: str) -> np.ndarray:
    return np.array([float(row[column]) if row[column] else np.nan for row in rows])


def test_csv_wrist_one_row_per_frame(tmp_path: Path) -> None:
    take = wrist_take(tmp_path)
    written = csv_tables.write(take, tmp_path / "out")
    assert {path.name for path in written} == {
        *(f"one.{name}.for-programs.csv" for name in ("wrist", "markers", "events", "repetitions", "measures")),
        "one.csv.json",
    }
    rows, motion = read_rows(tmp_path / "out" / "one.wrist.for-programs.csv"), take.session.motion
    assert len(rows) == len(take.session)
    for k, name in enumerate(WRIST_ANGLES):
        assert np.allclose(
            numbers(rows, f"filter_{name}_deg"), np.degrees(motion.angles_rad[:, k]), atol=6e-4, equal_nan=True
        )
        sd = np.degrees(motion.angles_sd_rad[:, k])
        assert np.allclose(numbers(rows, f"filter_{name}_sd_deg"), sd, atol=6e-4, equal_nan=True)
    assert [row["status"] for row in rows] == [TrackStatus(s).name.lower() for s in take.session.status]
    lost = [row for row in rows if row["status"] == "lost"]
    assert {lost[0][name] for name in lost[0] if name not in ("timestamp_s", "status")} == {""}
    events = read_rows(tmp_path / "out" / "one.events.for-programs.csv")
    assert [(event["kind"], event["text"]) for event in events] == [("repetition", "1"), ("note", "Mrs Miller, pain")]
    assert float(events[0]["since_start_s"]) == pytest.approx(0.1, abs=1e-5)


def test_csv_joints_and_markers_one_row_each(tmp_path: Path) -> None:
    take = hand_take(tmp_path)
    csv_tables.write(take, tmp_path / "out")
    session = take.session
    joints = read_rows(tmp_path / "out" / "one.joints.for-programs.csv")
    names = session.header.joint_names
    assert len(joints) == len(session) * len(names)
    assert [row["joint"] for row in joints[: len(names)]] == list(names)
    markers = read_rows(tmp_path / "out" / "one.markers.for-programs.csv")
    assert len(markers) == len(session) * 21
    motion, seen = session.motion, session.markers
    for rows, column, values in (
        (joints, "filter_angle_deg", np.degrees(motion.joint_angles_rad)),
        (joints, "filter_sd_deg", np.degrees(motion.joint_angles_sd_rad)),
        (joints, "filter_velocity_deg_s", np.degrees(motion.joint_velocity_rad_s)),
        (markers, "u_px", seen.measured_px[..., 0]),
        (markers, "v_px", seen.measured_px[..., 1]),
        (markers, "depth_mm", 1e3 * seen.measured_depth_m),
        *((markers, f"filter_{axis}_mm", 1e3 * seen.position_cam_m[..., k]) for k, axis in enumerate("xyz")),
        *((markers, f"filter_joint_{axis}_mm", 1e3 * motion.joint_position_m[..., k]) for k, axis in enumerate("xyz")),
    ):
        assert np.isfinite(values).any()
        assert np.allclose(numbers(rows, column), values.ravel(), atol=6e-4, equal_nan=True), column
    about = json.loads((tmp_path / "out" / "one.csv.json").read_text(encoding="utf-8"))
    assert set(about["tables"]["one.markers.for-programs.csv"]) == set(markers[0])
    assert set(about["tables"]["one.joints.for-programs.csv"]) == set(joints[0])


def opensim_cells(line: str) -> list[str]:
    """As OpenSim 4.6 takes a row apart: what comes before each tab, and what is left if there is anything."""
    *cells, rest = line.split("\t")
    return [*cells, rest] if rest else cells


def test_trc_matches_opensim(tmp_path: Path) -> None:
    take = wrist_take(tmp_path)
    trc.write(take, tmp_path / "out")
    lines = (tmp_path / "out" / "one.trc").read_text(encoding="utf-8").split("\n")
    head = dict(zip(lines[1].split("\t"), lines[2].split("\t"), strict=True))
    assert (head["Units"], float(head["DataRate"]), head["NumMarkers"]) == ("mm", 30.0, "6")
    assert int(head["NumFrames"]) == len(take.session) == len(lines) - 7
    markers = take.session.header.protocol.markers
    assert lines[3].split("\t")[2::3] == list(markers)
    assert lines[4].split("\t")[2:] == [f"{axis}{m}" for m in range(1, 7) for axis in "XYZ"]
    assert lines[5] == ""
    cells = [opensim_cells(line) for line in lines[6:-1]]
    assert {len(row) for row in cells} == {2 + 3 * 6}
    assert any(not cell for row in cells for cell in row), "one in five is lost: empty cells"
    assert [row[0] for row in cells] == [str(k + 1) for k in range(len(cells))]
    assert np.allclose([float(row[1]) for row in cells], np.arange(len(cells)) / 30.0, atol=1e-6)
    place = np.array([[float(cell) if cell else np.nan for cell in row[2:]] for row in cells]).reshape(-1, 6, 3)
    cam_mm = 1e3 * take.session.markers.position_cam_m
    up = np.stack((cam_mm[..., 0], -cam_mm[..., 2], cam_mm[..., 1]), axis=-1)
    assert np.allclose(place, up, atol=1e-3, equal_nan=True)
    about = json.loads((tmp_path / "out" / "one.trc.json").read_text(encoding="utf-8"))
    rotation = np.array(about["rotation_trc_from_camera"])
    assert np.allclose(cam_mm @ rotation.T, up, equal_nan=True)
    assert np.linalg.det(rotation) == pytest.approx(1.0)


def test_mot_has_angles_in_degrees(tmp_path: Path) -> None:
    take = hand_take(tmp_path)
    mot.write(take, tmp_path / "out")
    lines = (tmp_path / "out" / "one.mot").read_text(encoding="utf-8").split("\n")
    end = lines.index("endheader")
    labels = lines[end + 1].split("\t")
    assert labels[:5] == ["time", "wrist_deviation_l", "wrist_flexion_l", "wrist_pronosupination_l", "cmc1_extension_l"]
    assert f"nColumns={len(labels)}" in lines[:end]
    assert f"nRows={len(take.session)}" in lines[:end]
    assert "inDegrees=yes" in lines[:end]
    table = np.array([[float(cell) for cell in line.split("\t")] for line in lines[end + 2 : -1]])
    motion = take.session.motion
    angles = np.degrees(np.column_stack((motion.angles_rad, motion.joint_angles_rad)))
    assert np.allclose(table[:, 1:], angles, atol=1e-4, equal_nan=True)
    assert np.isnan(table[4, 1:]).all(), "a lost frame stays lost"


def test_json_measures_are_standard_json(tmp_path: Path) -> None:
    take = build_take(flexing())
    (path,) = json_measures.write(take, tmp_path / "out")

    def refuse(text: str) -> None:
        raise AssertionError(text)

    content = json.loads(path.read_text(encoding="utf-8"), parse_constant=refuse)
    assert content["session"]["subject_id"] == take.session.header.subject_id
    (arc,) = [row for row in content["measures"] if (row["measure"], row["of"]) == ("arc", "flexion")]
    assert arc["unit"] == "deg"
    assert arc["mean"] == take.results.find("flexion", "arc").mean  # type: ignore[union-attr]
    assert len(content["provenance"]["tracked_by"]["settings_sha256"]) in (0, 64)
    assert content["provenance"]["camera"]["fx_px"] == take.session.camera.fx_px


def test_bids_passes_validator_rules(tmp_path: Path) -> None:
    one, two = store_session(tmp_path), store_session(tmp_path, HAND21, name="two")
    export_sessions([ExportRequest.from_file(one), ExportRequest.from_file(two)], tmp_path / "set", ["bids"])
    command = [sys.executable, "-c", "import sys, bids_validator_deno as b; sys.exit(b.cli())"]
    done = subprocess.run(
        [*command, str(tmp_path / "set"), "--format", "json"], capture_output=True, text=True, check=False, timeout=120
    )
    issues = json.loads(done.stdout)["issues"]["issues"]
    assert [issue for issue in issues if issue["severity"] == "error"] == []
    for _ in range(2):
        with pytest.raises(OutputExists):
            export_sessions([ExportRequest.from_file(one)], tmp_path / "set", ["bids"])
        (tmp_path / "set" / "dataset_description.json").unlink(missing_ok=True)  # of a killed export there is none yet
    assert not list((tmp_path / "set").rglob("*_run-2_*"))


def test_bids_other_files_stay(tmp_path: Path) -> None:
    (tmp_path / "sub-notes.txt").touch()
    (tmp_path / "sub-other" / "ses-1" / "anat").mkdir(parents=True)
    done = export_sessions([ExportRequest.from_file(store_session(tmp_path))], tmp_path, ["bids"])
    assert (bool(done.files), done.refused) == (True, ())


def test_bids_columns_match_channels(tmp_path: Path) -> None:
    take = hand_take(tmp_path)
    written = bids_motion.write(take, tmp_path / "set")
    (motion,) = [path for path in written if path.name.endswith("_motion.tsv")]
    with motion.with_name(motion.name.replace("_motion.", "_channels.")).open(encoding="utf-8") as file:
        channels = list(csv.DictReader(file, delimiter="\t"))
    table = [line.split("\t") for line in motion.read_text(encoding="utf-8").splitlines()]
    assert {len(row) for row in table} == {len(channels)}
    assert len({channel["name"] for channel in channels}) == len(channels)
    about = json.loads(motion.with_suffix(".json").read_text(encoding="utf-8"))
    assert about["MotionChannelCount"] == len(channels)
    for kind in ("POS", "ORNT", "VEL", "JNTANG", "LATENCY"):
        assert about[f"{kind}ChannelCount"] == sum(channel["type"] == kind for channel in channels)
    assert about["SamplingFrequency"] == 30.0
    names = [channel["name"] for channel in channels]
    column = [row[names.index("MCP2_flexion")] for row in table]
    joint = take.session.header.joint_names.index("MCP2_flexion")
    wanted = np.degrees(take.session.motion.joint_angles_rad[:, joint])
    found = np.array([np.nan if cell == "n/a" else float(cell) for cell in column])
    assert np.allclose(found, wanted, atol=1e-5, equal_nan=True)
    assert [float(row[0]) for row in table] == pytest.approx(np.arange(len(table)) / 30.0, abs=2e-6)


def test_csv_columns_state_estimate_and_sign(tmp_path: Path) -> None:
    for take, name in ((build_take(flexing()), "wrist"), (hand_take(tmp_path), "hand")):
        out = tmp_path / name
        csv_tables.write(take, out)
        said = json.loads((out / "one.csv.json").read_text(encoding="utf-8"))["tables"]
        assert all(text for table in said.values() for text in table.values())
        estimates = {"filter", "smoother"} if take.session.smoothed is not None else {"filter"}
        head = list(read_rows(out / "one.wrist.for-programs.csv")[0])
        assert {column.split("_")[0] for column in head[2:]} == estimates
        assert {
            f"{one}_{part}" for one in estimates for part in ("flexion_deg", "zyz_beta_deg", "isb_flexion_deg")
        } < set(head)
        assert len(set(head)) == len(head)
        for row in read_rows(out / "one.measures.for-programs.csv"):
            assert row["positive"]
            assert row["estimate"] in estimates
            joint = row["of"][:3] in ("CMC", "MCP", "PIP", "DIP", "IP1")
            assert not (joint and row["measure"] in ("flexion", "extension")), "of a joint: largest and smallest"
    rows = {(row["measure"], row["of"]): row for row in read_rows(out / "one.measures.for-programs.csv")}
    assert rows["largest", "MCP2_flexion"]["positive"] == rows["smallest", "MCP2_flexion"]["positive"] == "flexed"
    assert "index finger" in rows["smallest", "CMC1_extension"]["positive"]


def test_repetitions_are_in_every_capable_format(tmp_path: Path) -> None:
    take = build_take(read_session(stopping(tmp_path)), "stops")
    figures = take.results
    for module in (csv_tables, json_measures, bids_motion):
        module.write(take, tmp_path / "out")
    table = read_rows(tmp_path / "out" / "stops.repetitions.for-programs.csv")
    content = json.loads((tmp_path / "out" / "stops.measures.json").read_text(encoding="utf-8"))
    assert len(table) == len(content["repetitions"]) == len(figures.repetitions) == 3
    for row, told, shown in zip(table, content["repetitions"], figures.repetitions, strict=True):
        assert shown.row is not None
        assert (row["angle"], row["positive"], row["estimate"], row["counted"]) == (
            "flexion",
            "flexed",
            "filter",
            "yes",
        )
        for name in ("start_s", "peak_s", "end_s", "movement_time_s", "sparc", "pauses", "movement_units"):
            assert float(row[name]) == pytest.approx(getattr(shown.row, name), abs=6e-4)
            assert told[name] == pytest.approx(getattr(shown.row, name))
        for name in ("angle", "arc", "arc_sd", "peak_speed", "peak_speed_sd"):
            unit = "_s" if "speed" in name else ""
            turned = np.degrees(getattr(shown.row, f"{name}_rad{unit}"))
            assert float(row[f"{name}_deg{unit}"]) == pytest.approx(turned, abs=6e-4, nan_ok=True)
        assert float(row["arc_deg"]) == pytest.approx(50.0, abs=0.2)
        assert (row["pauses"], float(row["pause_time_s"])) == ("1.000", pytest.approx(0.74, abs=0.05))
        assert float(row["sparc"]) == pytest.approx(0.5 * (-3.62 - 1.40), abs=0.1)
    (events,) = (tmp_path / "out").rglob("*_events.tsv")
    with events.open(encoding="utf-8") as file:
        lines = [line for line in csv.DictReader(file, delimiter="\t") if line["trial_type"] == "repetition"]
    for line, row in zip(lines, table, strict=True):
        assert float(line["onset"]) == pytest.approx(float(row["start_s"]), abs=1e-3)
        assert float(line["duration"]) == pytest.approx(float(row["end_s"]) - float(row["start_s"]), abs=1e-3)
        assert (float(line["peak"]), line["counted"]) == (pytest.approx(float(row["peak_s"]), abs=1e-3), "yes")
