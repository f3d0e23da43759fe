"""What the second patient promises: true values that fit its pictures, skin and bones as stated, and its apartness."""

from __future__ import annotations

import ast
from pathlib import Path

import numpy as np
import pytest

from carpus.core.calibration.clicks_file import read_clicks
from carpus.core.capture.files.tum import TumFolder
from carpus.core.model.hand.clinical_angles import wrist_axes
from carpus.core.model.hand.protocols import HAND21, PALM_MARKERS, joint_angle_names
from carpus.core.pipeline.track import TrackSettings, track_recording
from carpus.core.session.reader import read_session
from tests.second_patient import recording
from tests.second_patient.discs import NAMES, PALM
from tests.second_patient.motions import ROWS, Row
from tests.second_patient.recording import CLICKS_FILE, Take, record_take
from tests.sources import ROOT, SOURCES, nodes

pytestmark = pytest.mark.xdist_group("second patient")
"""To grow a person costs more than all else that is done with one: each is grown once.

It is a ruler for ``make accuracy``, which no change of the program bends: most is looked at thoroughly only."""
CUPPED, QUIET, RESTING = (
    next(row for row in ROWS if row.name == name)
    for name in ("hand: power grip, cupped palm", "wrist, nothing glides", "rest, fingers open and close")
)
ANGLES = joint_angle_names(dip_free=True)


@pytest.fixture(scope="module")
def take() -> Take:
    """A right hand in a power grip."""
    return Take(CUPPED, 12)


def imported(path: Path) -> set[str]:
    names: set[str] = set()
    for node in nodes(path):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            names |= {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)}
    return names


@SOURCES
def test_program_knows_nothing_of_second_patient_nor_it_of_first() -> None:
    for folder in ("app", "core", "ui", "resources", "installer"):
        for path in (ROOT / folder).rglob("*"):
            if path.suffix in (".py", ".toml", ".json", ".sh"):
                assert "second_patient" not in path.read_text(encoding="utf-8"), path
    for path in Path(__file__).parent.glob("*.py"):
        first = {name for name in imported(path) if "simulation" in name}
        assert not first, path


def test_settings_are_not_chosen_on_it() -> None:
    """Only the accuracy table and its own tests use it."""
    users = {
        str(path.relative_to(ROOT))
        for path in (ROOT / "tests").rglob("*.py")
        if "second_patient" in path.read_text(encoding="utf-8")
        and any(name.startswith("tests.second_patient") for name in imported(path))
    }
    allowed = ("tests/second_patient/", "tests/accuracy/second", "tests/test_accuracy_guard.py")
    assert users
    assert not {user for user in users if not user.startswith(allowed)}


def test_palm_and_neutral_frame_are_as_the_contract_says(take: Take) -> None:
    assert (HAND21.markers, PALM_MARKERS) == (NAMES, PALM)
    truth = take.truth
    palm = truth.disc_position_cam_m[0, list(truth.protocol.palm)]
    axes = wrist_axes(palm, dorsal_direction=np.array([0.0, 0.0, -1.0]))
    assert np.allclose(axes, truth.rotation_w0_cam, atol=1e-6)
    assert np.allclose(truth.rotation_w2_w0[0], np.eye(3), atol=1e-9)
    assert np.allclose(truth.angles_rad[0], 0.0, atol=1e-9)
    assert np.allclose(truth.marker_position_w0_m[0], 0.0, atol=1e-12)


@pytest.mark.thorough
def test_truth_goes_round(take: Take) -> None:
    """WRIST by the wrist's pose; with a rigid palm every disc of the palm."""
    truth = take.truth
    wrist = truth.translation_w0_cam_m + truth.position_m @ truth.rotation_w0_cam.T
    assert np.allclose(wrist, truth.disc_position_cam_m[:, 0], atol=1e-9)
    rigid = Take(QUIET, 12).truth
    carried = rigid.position_m[:, None] + np.einsum("nij,mj->nmi", rigid.rotation_w2_w0, rigid.marker_position_w0_m)
    cam = rigid.translation_w0_cam_m + carried @ rigid.rotation_w0_cam.T
    assert np.abs(cam - rigid.disc_position_cam_m).max() < 2e-5
    assert np.abs(np.degrees(rigid.angles_rad)).max() > 20.0


def test_fingers_angles_are_the_chains_of_the_reference(take: Take) -> None:
    """From the joint centres alone, read in W0 carried by the fixed unit (ring and little: by their metacarpals)."""
    truth, patient = take.truth, take.patient
    index = [NAMES.index(name) for name in ("MCP2", "PIP2", "DIP2", "TIP2")]
    link = np.diff(truth.joint_position_w0_m[:, index], axis=1)
    link = np.einsum("nji,nkj->nki", truth.rotation_w2_w0, link)
    pitch = -np.arctan2(link[..., 2], np.hypot(link[..., 0], link[..., 1]) * np.sign(link[..., 0]))
    bend = np.unwrap(np.column_stack((pitch[:, 0], np.diff(np.unwrap(pitch, axis=1), axis=1))), axis=0)
    names = [ANGLES.index(name) for name in ("MCP2_flexion", "PIP2_flexion", "DIP2_flexion")]
    assert np.allclose(bend, truth.joint_angles_rad[:, names], atol=1e-6)
    azimuth = np.arctan2(link[0, 0, 1], link[0, 0, 0]) - patient.person.fan_rad[1]
    assert azimuth == pytest.approx(truth.joint_angles_rad[0, ANGLES.index("MCP2_abduction")], abs=1e-6)


@pytest.mark.thorough
def test_left_mirrors_right() -> None:
    right, left = (Take(CUPPED, 12, side) for side in ("right", "left"))
    mirror = np.array([1.0, -1.0, 1.0])
    assert np.allclose(right.truth.angles_rad, left.truth.angles_rad, atol=1e-9)
    assert np.array_equal(right.truth.joint_angles_rad, left.truth.joint_angles_rad)
    assert np.allclose(right.truth.marker_position_w0_m * mirror, left.truth.marker_position_w0_m, atol=1e-9)
    assert np.allclose(right.truth.joint_position_w0_m * mirror, left.truth.joint_position_w0_m, atol=1e-9)
    assert np.linalg.det(left.truth.rotation_w0_cam) == pytest.approx(1.0)
    # A left thumb is on the right of the picture.
    assert left.truth.disc_pixel[0, NAMES.index("MCP1"), 0] > left.truth.disc_pixel[0, NAMES.index("MCP3"), 0]
    assert right.truth.disc_pixel[0, NAMES.index("MCP1"), 0] < right.truth.disc_pixel[0, NAMES.index("MCP3"), 0]


@pytest.mark.thorough
@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.name)
def test_second_patient_starts_still_and_stays_in_frame(row: Row, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(recording, "FPS", 10.0)
    truth = Take(row, 12 + ROWS.index(row) % 2).truth
    still = truth.timestamp_s - truth.timestamp_s[0] < 0.6
    assert np.count_nonzero(still) >= 5
    assert np.degrees(np.abs(truth.angles_rad[still])).max() < 0.6
    assert np.linalg.norm(truth.position_m[still], axis=1).max() < 0.001
    assert (truth.disc_pixel > 6.0).all()
    assert (truth.disc_pixel < np.array([633.0, 473.0])).all()
    assert np.isfinite(truth.joint_angles_rad).all()
    assert 0.6 < truth.translation_w0_cam_m[2] < 0.85


@pytest.mark.thorough
def test_recording_is_tracked_like_its_truth(tmp_path: Path) -> None:
    folder = tmp_path / "take"
    truth = record_take(Take(RESTING, 12, seconds=0.9), folder)
    output = tmp_path / "session.h5"
    source = TumFolder(folder)
    track_recording(source, read_clicks(folder / CLICKS_FILE), output, TrackSettings())
    session = read_session(output)
    assert np.mean(session.status == 0) > 0.9
    assert np.allclose(session.timestamp_s, truth.timestamp_s)
    assert np.degrees(np.sqrt(np.nanmean((session.motion.angles_rad - truth.angles_rad) ** 2))) < 6.0
