"""The session file against the published contract, by plain h5py; this table is written by hand from the contract."""

from __future__ import annotations

import json
from datetime import datetime
from pathlib import Path
from uuid import UUID

import h5py
import numpy as np
import pytest

from carpus.core.hand.protocols import HAND21, WRIST6, MarkerProtocol
from carpus.core.session.values import motion_of
from carpus.core.session.writer import SessionWriter
from tests.session.samples import CAMERA, make_calibration, make_frame, make_header, time_of

N = 40
WRIST_MARKERS = ["WRIST", "CMC1", "MCP2", "MCP3", "MCP4", "MCP5"]
HAND_MARKERS = [
    "WRIST", "CMC1", "MCP1", "IP1", "TIP1",
    "MCP2", "PIP2", "DIP2", "TIP2",
    "MCP3", "PIP3", "DIP3", "TIP3",
    "MCP4", "PIP4", "DIP4", "TIP4",
    "MCP5", "PIP5", "DIP5", "TIP5",
]  # fmt: skip
JOINTS = [
    "CMC1_extension", "CMC1_abduction", "MCP1_flexion", "MCP1_abduction", "IP1_flexion",
    "MCP2_abduction", "MCP2_flexion", "PIP2_flexion",
    "MCP3_abduction", "MCP3_flexion", "PIP3_flexion",
    "MCP4_abduction", "MCP4_flexion", "PIP4_flexion",
    "MCP5_abduction", "MCP5_flexion", "PIP5_flexion",
]  # fmt: skip
ANGLES = ["deviation", "flexion", "pronosupination"]


def contract(m: int, j: int, d: int, e: int) -> dict[str, tuple[tuple[int, ...], str, str]]:
    """Path: shape, unit, which names."""
    wrist = {
        "position": ((N, 3), "m", ""),
        "velocity": ((N, 3), "m/s", ""),
        "w0_turn": ((N, 3), "rad", ""),
        "rotation": ((N, 3, 3), "1", ""),
        "angular_velocity": ((N, 3), "rad/s", ""),
        "angles": ((N, 3), "rad", "angles"),
        "angles_sd": ((N, 3), "rad", "angles"),
        "angles_zyz": ((N, 3), "rad", "zyz"),
    }
    joints = {
        "angles": ((N, j), "rad", "joints"),
        "angles_sd": ((N, j), "rad", "joints"),
        "velocity": ((N, j), "rad/s", "joints"),
        "position": ((N, m, 3), "m", "markers"),
    }
    table = {
        "/calibration/clicks": ((m, 2), "px", "markers"),
        "/calibration/marker_position": ((m, 3), "m", "markers"),
        "/calibration/rotation": ((3, 3), "1", ""),
        "/calibration/translation": ((3,), "m", ""),
        "/frames/timestamp": ((N,), "s", ""),
        "/frames/status": ((N,), "1", ""),
        "/markers/position_camera": ((N, m, 3), "m", "markers"),
        "/markers/measured": ((N, m, 2), "px", "markers"),
        "/markers/measured_depth": ((N, m), "m", "markers"),
        "/detections/frame": ((d,), "1", ""),
        "/detections/pixel": ((d, 2), "px", ""),
        "/detections/depth": ((d,), "m", ""),
        "/detections/depth_sd": ((d,), "m", ""),
        "/detections/area": ((d,), "px^2", ""),
        "/detections/similarity": ((d,), "1", ""),
        "/quality/dropped_frames": ((N,), "1", ""),
        "/quality/measured_share": ((N, j or 3), "1", "joints" if j else "angles"),
        "/quality/nis": ((N,), "1", ""),
        "/events/time": ((e,), "s", ""),
        "/events/kind": ((e,), "", ""),
        "/events/text": ((e,), "", ""),
    }
    for where in ("", "/smoothed"):
        table |= {f"{where}/wrist/{name}": row for name, row in wrist.items()}
        if j:
            table |= {f"{where}/joints/{name}": row for name, row in joints.items()}
    return table


def write(path: Path, protocol: MarkerProtocol) -> Path:
    frames = [make_frame(row, protocol) for row in range(N)]
    with SessionWriter.create(path, make_header(protocol), CAMERA, make_calibration(protocol)) as writer:
        for frame in frames:
            writer.append(frame)
        writer.add_event(time_of(3), "note", "Schmerz am Daumen: 3°")
        writer.add_event(time_of(9), "repetition")
        writer.write_smoothed(motion_of(list(reversed(frames))))
    return path


@pytest.fixture(params=[WRIST6, HAND21], ids=lambda protocol: protocol.name)
def protocol(request: pytest.FixtureRequest) -> MarkerProtocol:
    return request.param


def test_every_path_has_its_shape_unit_description_and_names(tmp_path: Path, protocol: MarkerProtocol) -> None:
    names = {
        "angles": ANGLES,
        "zyz": ["alpha", "beta", "gamma"],
        "joints": JOINTS,
        "markers": WRIST_MARKERS if protocol is WRIST6 else HAND_MARKERS,
    }
    blobs = sum(len(make_frame(row, protocol).detections) for row in range(N))
    table = contract(len(names["markers"]), 17 if protocol is HAND21 else 0, blobs, 2)
    with h5py.File(write(tmp_path / "s.h5", protocol), "r") as file:
        for path, (shape, unit, named) in table.items():
            dataset = file[path]
            assert dataset.shape == shape, path
            assert dataset.attrs["unit"] == unit, path
            assert len(dataset.attrs["description"]) > 5, path
            if named:
                assert list(dataset.attrs["names"]) == names[named], path
            else:
                assert "names" not in dataset.attrs, path
        assert list(file["/markers"].attrs["names"]) == names["markers"]
        assert list(file["/wrist"].attrs["names"]) == ANGLES
        if protocol is HAND21:
            assert list(file["/joints"].attrs["names"]) == JOINTS
        else:
            assert "/joints" not in file


def test_attributes(tmp_path: Path) -> None:
    with h5py.File(write(tmp_path / "s.h5", WRIST6), "r") as file:
        said = file.attrs
        assert said["format"] == "carpus-session"
        assert said["format_version"] == 2
        assert UUID(said["recording_id"]) == UUID(said["session_id"]), "the first result of its recording"
        assert datetime.fromisoformat(said["recorded"]).utcoffset() is not None
        assert UUID(said["session_id"]) == UUID("12345678-1234-5678-1234-567812345678")
        assert said["subject_id"] == "Linden 42"
        created = datetime.fromisoformat(said["created"])
        assert created.utcoffset() is not None
        assert created.timestamp() == datetime.fromisoformat("2026-11-13T16:30:00+01:00").timestamp()
        assert (said["hand"], said["protocol"], said["exercise"]) == ("left", "wrist6", "wrist flexion")
        assert said["software_version"] == "0.1.0"
        assert json.loads(said["parameters"]) == {"profile": "standard"}
        assert bool(said["complete"]) is True
        assert said["origin"] == "earlier.h5"
        camera = file["/camera"].attrs
        assert [float(camera[name]) for name in ("fx", "fy", "cx", "cy")] == [570.25, 571.5, 314.0, 235.5]
        assert (int(camera["width"]), int(camera["height"])) == (640, 480)
        np.testing.assert_array_equal(camera["distortion"], CAMERA.distortion)


ROW_OF = {
    "/frames/timestamp": "timestamp_s",
    "/frames/status": "status",
    "/wrist/position": "position_m",
    "/wrist/velocity": "velocity_m_s",
    "/wrist/w0_turn": "w0_turn_rad",
    "/wrist/rotation": "rotation_w2_w0",
    "/wrist/angular_velocity": "angular_velocity_rad_s",
    "/wrist/angles": "angles_rad",
    "/wrist/angles_sd": "angles_sd_rad",
    "/wrist/angles_zyz": "angles_zyz_rad",
    "/joints/angles": "joint_angles_rad",
    "/joints/angles_sd": "joint_angles_sd_rad",
    "/joints/velocity": "joint_velocity_rad_s",
    "/joints/position": "joint_position_m",
    "/markers/position_camera": "marker_position_cam_m",
    "/markers/measured": "marker_measured_px",
    "/markers/measured_depth": "marker_measured_depth_m",
    "/quality/dropped_frames": "dropped_before",
    "/quality/measured_share": "measured_share",
    "/quality/nis": "nis",
}


def test_every_number_is_where_it_belongs(tmp_path: Path) -> None:
    frames = [make_frame(row, HAND21) for row in range(N)]
    with h5py.File(write(tmp_path / "s.h5", HAND21), "r") as file:
        for path, attribute in ROW_OF.items():
            of_moment = path.startswith(("/wrist", "/joints"))
            for row, frame in enumerate(frames):
                expected = getattr(frame.moment if of_moment else frame, attribute)
                np.testing.assert_array_equal(file[path][row], expected, err_msg=path)
            if of_moment:
                np.testing.assert_array_equal(file["/smoothed" + path][()], file[path][()][::-1], err_msg=path)
        calibration = make_calibration(HAND21)
        np.testing.assert_array_equal(file["/calibration/clicks"], calibration.clicks.pixel)
        np.testing.assert_array_equal(file["/calibration/marker_position"], calibration.marker_position_w0_m)
        np.testing.assert_array_equal(file["/calibration/rotation"], calibration.rotation_w0_cam)
        np.testing.assert_array_equal(file["/calibration/translation"], calibration.translation_w0_cam_m)
        for row, frame in enumerate(frames):
            mine = file["/detections/frame"][()] == row
            for name in ("pixel", "depth", "depth_sd", "area", "similarity"):
                attribute = {"depth": "depth_m", "depth_sd": "depth_sd_m", "area": "area_px"}.get(name, name)
                stored = file[f"/detections/{name}"][()][mine]
                np.testing.assert_array_equal(stored, getattr(frame.detections, attribute))
        assert file["/events/time"][()].tolist() == [time_of(3), time_of(9)]
        assert file["/events/kind"].asstr()[()].tolist() == ["note", "repetition"]
        assert file["/events/text"].asstr()[()].tolist() == ["Schmerz am Daumen: 3°", ""]


def test_the_times_are_those_of_the_recording_to_the_last_bit(tmp_path: Path) -> None:
    with h5py.File(write(tmp_path / "s.h5", WRIST6), "r") as file:
        times = file["/frames/timestamp"][()]
    assert times.dtype == np.float64
    assert times.tolist() == [time_of(row) for row in range(N)]


def test_free_end_joints_have_their_own_angles(tmp_path: Path) -> None:
    path = tmp_path / "s.h5"
    header = make_header(HAND21, dip_free=True)
    with SessionWriter.create(path, header, CAMERA, make_calibration(HAND21)) as writer:
        writer.append(make_frame(0, HAND21, joints=21))
    with h5py.File(path, "r") as file:
        assert file["/joints/angles"].shape == (1, 21)
        names = list(file["/joints/angles"].attrs["names"])
    assert names[:5] == JOINTS[:5]
    assert names[5:9] == ["MCP2_abduction", "MCP2_flexion", "PIP2_flexion", "DIP2_flexion"]
    assert len(names) == 21
