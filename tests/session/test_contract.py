"""The session file against the published contract, by plain h5py; this table is written by hand from the contract."""

from __future__ import annotations

import json
from datetime import datetime
from pathlib import Path
from typing import NamedTuple
from uuid import UUID

import h5py
import numpy as np
import pytest

from carpus.core.model.hand.protocols import HAND21, WRIST6, MarkerProtocol
from carpus.core.platform.version import __version__
from carpus.core.session.values import stack_states
from tests.session.samples import (
    CAMERA,
    begin_session,
    compute_time,
    make_calibration,
    make_frame,
    make_header,
    write_once,
)

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


class Row(NamedTuple):
    """What the contract says of a dataset, and what of a frame it holds."""

    shape: tuple[int, ...]
    unit: str
    names: str = ""
    of_frame: str = ""


def contract(m: int, j: int, d: int, e: int) -> dict[str, Row]:
    wrist = {
        "position": Row((N, 3), "m", "", "position_m"),
        "velocity": Row((N, 3), "m/s", "", "velocity_m_s"),
        "w0_turn": Row((N, 3), "rad", "", "w0_turn_rad"),
        "rotation": Row((N, 3, 3), "1", "", "rotation_w2_w0"),
        "angular_velocity": Row((N, 3), "rad/s", "", "angular_velocity_rad_s"),
        "angles": Row((N, 3), "rad", "angles", "angles_rad"),
        "angles_sd": Row((N, 3), "rad", "angles", "angles_sd_rad"),
        "angles_zyz": Row((N, 3), "rad", "zyz", "angles_zyz_rad"),
    }
    joints = {
        "angles": Row((N, j), "rad", "joints", "joint_angles_rad"),
        "angles_sd": Row((N, j), "rad", "joints", "joint_angles_sd_rad"),
        "velocity": Row((N, j), "rad/s", "joints", "joint_velocity_rad_s"),
        "position": Row((N, m, 3), "m", "markers", "joint_position_m"),
    }
    table = {
        "/calibration/clicks": Row((m, 2), "px", "markers"),
        "/calibration/marker_position": Row((m, 3), "m", "markers"),
        "/calibration/rotation": Row((3, 3), "1"),
        "/calibration/translation": Row((3,), "m"),
        "/frames/timestamp": Row((N,), "s", "", "timestamp_s"),
        "/frames/status": Row((N,), "1", "", "status"),
        "/markers/position_camera": Row((N, m, 3), "m", "markers", "marker_position_cam_m"),
        "/markers/measured": Row((N, m, 2), "px", "markers", "marker_measured_px"),
        "/markers/measured_depth": Row((N, m), "m", "markers", "marker_measured_depth_m"),
        "/detections/frame": Row((d,), "1"),
        "/detections/pixel": Row((d, 2), "px"),
        "/detections/depth": Row((d,), "m"),
        "/detections/depth_sd": Row((d,), "m"),
        "/detections/area": Row((d,), "px^2"),
        "/detections/similarity": Row((d,), "1"),
        "/quality/dropped_frames": Row((N,), "1", "", "dropped_before"),
        "/quality/measured_share": Row((N, j or 3), "1", "joints" if j else "angles", "measured_share"),
        "/quality/nis": Row((N,), "1", "", "nis"),
        "/events/time": Row((e,), "s"),
        "/events/kind": Row((e,), ""),
        "/events/text": Row((e,), ""),
    }
    for where in ("", "/smoothed"):
        table |= {f"{where}/wrist/{name}": row for name, row in wrist.items()}
        if j:
            table |= {f"{where}/joints/{name}": row for name, row in joints.items()}
    return table


@write_once
def write(path: Path, protocol: MarkerProtocol) -> Path:
    frames = [make_frame(row, protocol) for row in range(N)]
    with begin_session(path, make_header(protocol), N) as writer:
        writer.add_event(compute_time(3), "note", "Schmerz am Daumen: 3°")
        writer.add_event(compute_time(9), "repetition")
        writer.write_motion(stack_states(list(reversed(frames))))
    return path


@pytest.fixture(params=[WRIST6, HAND21], ids=lambda protocol: protocol.name)
def protocol(request: pytest.FixtureRequest) -> MarkerProtocol:
    return request.param


def test_session_file_datasets_have_shape_unit_and_names(tmp_path: Path, protocol: MarkerProtocol) -> None:
    names = {
        "angles": ANGLES,
        "zyz": ["alpha", "beta", "gamma"],
        "joints": JOINTS,
        "markers": WRIST_MARKERS if protocol is WRIST6 else HAND_MARKERS,
    }
    blobs = sum(len(make_frame(row, protocol).detections) for row in range(N))
    table = contract(len(names["markers"]), 17 if protocol is HAND21 else 0, blobs, 2)
    with h5py.File(write(tmp_path / "s.h5", protocol), "r") as file:
        for path, (shape, unit, named, _) in table.items():
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


def test_session_file_has_root_attributes(tmp_path: Path) -> None:
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
        assert said["software_version"] == __version__
        assert json.loads(said["parameters"]) == {"profile": "standard"}
        assert bool(said["complete"]) is True
        assert said["origin"] == "earlier.h5"
        camera = file["/camera"].attrs
        assert [float(camera[name]) for name in ("fx", "fy", "cx", "cy")] == [570.25, 571.5, 314.0, 235.5]
        assert (int(camera["width"]), int(camera["height"])) == (640, 480)
        np.testing.assert_array_equal(camera["distortion"], CAMERA.distortion)


def test_session_file_texts_have_no_mark_that_octave_refuses(tmp_path: Path) -> None:
    """Its ``load`` gives up a whole file for one dataset that is marked as UTF-8."""
    with h5py.File(write(tmp_path / "s.h5", WRIST6), "r") as file:
        marked: list[str] = []
        file.visititems(
            lambda name, one: (
                marked.append(name)
                if isinstance(one, h5py.Dataset) and one.dtype.kind == "S" and one.id.get_type().get_cset()
                else None
            )
        )
    assert marked == []


def test_session_file_values_are_in_their_datasets(tmp_path: Path) -> None:
    frames = [make_frame(row, HAND21) for row in range(N)]
    with h5py.File(write(tmp_path / "s.h5", HAND21), "r") as file:
        assert file["/frames/timestamp"].dtype == np.float64
        for path, (*_, attribute) in contract(len(HAND_MARKERS), len(JOINTS), 0, 0).items():
            if not attribute or path.startswith("/smoothed"):
                continue
            of_moment = path.startswith(("/wrist", "/joints"))
            expected = [getattr(frame.kinematics if of_moment else frame, attribute) for frame in frames]
            np.testing.assert_array_equal(file[path][()], expected, err_msg=path)
            if of_moment:
                np.testing.assert_array_equal(file["/smoothed" + path][()], file[path][()][::-1], err_msg=path)
        calibration = make_calibration(HAND21)
        np.testing.assert_array_equal(file["/calibration/clicks"], calibration.clicks.pixel)
        np.testing.assert_array_equal(file["/calibration/marker_position"], calibration.marker_position_w0_m)
        np.testing.assert_array_equal(file["/calibration/rotation"], calibration.rotation_w0_cam)
        np.testing.assert_array_equal(file["/calibration/translation"], calibration.translation_w0_cam_m)
        rows = [row for row, frame in enumerate(frames) for _ in range(len(frame.detections))]
        np.testing.assert_array_equal(file["/detections/frame"][()], rows)
        names = {"pixel": "pixel", "depth": "depth_m", "depth_sd": "depth_sd_m", "area": "area_px"}
        for name, attribute in (names | {"similarity": "similarity"}).items():
            stored = np.concatenate([getattr(frame.detections, attribute) for frame in frames])
            np.testing.assert_array_equal(file[f"/detections/{name}"][()], stored)
        assert file["/events/time"][()].tolist() == [compute_time(3), compute_time(9)]
        assert file["/events/kind"].asstr("utf-8")[()].tolist() == ["note", "repetition"]
        assert file["/events/text"].asstr("utf-8")[()].tolist() == ["Schmerz am Daumen: 3°", ""]
