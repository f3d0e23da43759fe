"""What the second patient promises: true values that fit its pictures, skin and bones as stated, and its apartness."""

from __future__ import annotations

import ast
import dataclasses
import json
from pathlib import Path

import cv2
import numpy as np
import pytest

from carpus.core.calibration.clicks_file import read_clicks
from carpus.core.capture.files.tum import TumFolder
from carpus.core.model.hand.clinical_angles import wrist_axes
from carpus.core.model.hand.protocols import HAND21, PALM_MARKERS
from carpus.core.pipeline.track import TrackSettings, track_recording
from carpus.core.session.reader import read_session
from tests.second_patient import recording
from tests.second_patient.discs import NAMES, PALM, disc_points, full_bend
from tests.second_patient.look import Look, color_of, depth_of, look_of
from tests.second_patient.motions import ROWS, Row, motion_of, row_named
from tests.second_patient.patient import made_patient
from tests.second_patient.recording import CLICKS_FILE, TRUTH_FILE, Take, kept_recording, recorded, take_of
from tests.second_patient.sensor import COUNTS_PER_M, DISPARITY_PX_M, STEP_PX, exposed, read_depth, sensor_of
from tests.second_patient.skeleton import Bone, placed_bones, rest_posture
from tests.sources import ROOT, SOURCES, nodes

pytestmark = pytest.mark.xdist_group("second patient")
"""To grow a person costs more than all else that is done with one: each is grown once.

It is a ruler for ``make accuracy``, which no change of the program bends: most is looked at thoroughly only."""
CUPPED = row_named("hand: power grip, cupped palm")


@pytest.fixture(scope="module")
def take() -> Take:
    """A right hand in a power grip."""
    return take_of(CUPPED, 12)


def look_at(take: Take) -> Look:
    return look_of(take.patient, take.hung, take.seed)


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


def test_discs_are_in_the_protocols_order() -> None:
    assert HAND21.markers == NAMES
    assert PALM_MARKERS == PALM


@pytest.mark.thorough
def test_skin_is_closed_and_faces_outwards(take: Take) -> None:
    skin = take.patient.skin
    assert 2000 < len(skin.triangle) < 12000
    assert np.allclose(skin.weight.sum(axis=1), 1.0)
    edges = np.sort(skin.triangle[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    _, count = np.unique(edges, axis=0, return_counts=True)
    # Open only where the forearm ends.
    ends = np.unique(edges, axis=0)[count == 1]
    assert (skin.corner_m[ends][..., 0] < -0.15).all()
    a, b, c = (skin.corner_m[skin.triangle[:, i]] for i in range(3))
    outward = np.sum(np.cross(b - a, c - a) * skin.normal[skin.triangle[:, 0]], axis=1)
    assert np.mean(outward > 0.0) > 0.99


@pytest.mark.thorough
def test_discs_lie_on_the_surface_that_is_drawn(take: Take) -> None:
    stuck, look = np.ones(len(NAMES), dtype=bool), look_at(take)
    for t in (0.0, 1.6, 3.0):
        body = take.patient.body(take.motion.at(np.array([t])))
        depth = depth_of(take.patient, take.hung, look, body)
        share = color_of(take.patient, take.hung, look, body, stuck).visible_share
        cam = take.hung.to_camera(body.disc_m)
        near = np.round(take.hung.pixel(cam)).astype(int)
        slant = np.abs(np.sum((body.disc_normal @ take.hung.turn.T) * cam, axis=1)) / np.linalg.norm(cam, axis=1)
        told = share > 0.9
        assert told.sum() >= 6
        for i in np.flatnonzero(told & (slant > 0.6)):
            # Half a pixel on slanting skin, and the paper's own middle on a finger.
            assert abs(depth[near[i, 1], near[i, 0]] - cam[i, 2]) < 0.0012, (t, NAMES[i])


@pytest.mark.thorough
def test_paper_has_its_middle_where_the_truth_says() -> None:
    """The blue pixels of each disc that faces the camera, averaged, against the disc's true place."""
    take = take_of(row_named("wrist, nothing glides"), 12)
    stuck, look = np.isin(NAMES, PALM), look_at(take)
    body = take.patient.body(take.motion.at(np.zeros(1)))
    bare = color_of(take.patient, take.hung, look, body, np.zeros(len(NAMES), dtype=bool)).light
    with_paper = color_of(take.patient, take.hung, look, body, stuck).light
    change = np.abs(with_paper - bare).sum(axis=2)
    count, label, _, _ = cv2.connectedComponentsWithStats((change > 1e-4).astype(np.uint8))
    assert count == 7
    for name in ("WRIST", "MCP2", "MCP3", "MCP4"):
        true = take.hung.pixel(take.hung.to_camera(body.disc_m[NAMES.index(name)]))
        u, v = np.round(true).astype(int)
        rows, columns = np.nonzero(label == label[v, u])
        weight = change[rows, columns]
        middle = np.array([weight @ columns, weight @ rows]) / weight.sum()
        # Paper that bends with a knuckle shows its far half narrower: some tenths of a pixel.
        assert np.linalg.norm(middle - true) < 0.45, name


def test_palm_and_neutral_frame_are_as_the_contract_says(take: Take) -> None:
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
    rigid = take_of(row_named("wrist, nothing glides"), 12).truth
    carried = rigid.position_m[:, None] + np.einsum("nij,mj->nmi", rigid.rotation_w2_w0, rigid.marker_position_w0_m)
    cam = rigid.translation_w0_cam_m + carried @ rigid.rotation_w0_cam.T
    assert np.abs(cam - rigid.disc_position_cam_m).max() < 2e-5
    assert np.abs(np.degrees(rigid.angles_rad)).max() > 20.0
    step = np.diff(rigid.position_m, axis=0) / np.diff(rigid.timestamp_s)[:, None]
    assert np.allclose(step, 0.5 * (rigid.velocity_m_s[1:] + rigid.velocity_m_s[:-1]), atol=2e-3)
    swing = np.swapaxes(rigid.rotation_w2_w0[:-1], 1, 2) @ rigid.rotation_w2_w0[1:]
    rate = np.stack((swing[:, 2, 1], swing[:, 0, 2], swing[:, 1, 0]), axis=1) / np.diff(rigid.timestamp_s)[:, None]
    assert np.allclose(rate, 0.5 * (rigid.angular_velocity_rad_s[1:] + rigid.angular_velocity_rad_s[:-1]), atol=0.05)


def test_fingers_angles_are_the_chains_of_the_reference(take: Take) -> None:
    """From the joint centres alone, read in W0 carried by the fixed unit (ring and little: by their metacarpals)."""
    truth, patient = take.truth, take.patient
    index = [NAMES.index(name) for name in ("MCP2", "PIP2", "DIP2", "TIP2")]
    link = np.diff(truth.joint_position_w0_m[:, index], axis=1)
    link = np.einsum("nji,nkj->nki", truth.rotation_w2_w0, link)
    pitch = -np.arctan2(link[..., 2], np.hypot(link[..., 0], link[..., 1]) * np.sign(link[..., 0]))
    bend = np.unwrap(np.column_stack((pitch[:, 0], np.diff(np.unwrap(pitch, axis=1), axis=1))), axis=0)
    names = [HAND21_ANGLES.index(name) for name in ("MCP2_flexion", "PIP2_flexion", "DIP2_flexion")]
    assert np.allclose(bend, truth.joint_angles_rad[:, names], atol=1e-6)
    azimuth = np.arctan2(link[0, 0, 1], link[0, 0, 0]) - patient.person.fan_rad[1]
    assert azimuth == pytest.approx(truth.joint_angles_rad[0, HAND21_ANGLES.index("MCP2_abduction")], abs=1e-6)


HAND21_ANGLES = ("CMC1_extension", "CMC1_abduction", "MCP1_flexion", "MCP1_abduction", "IP1_flexion") + tuple(
    name.format(k)
    for k in (2, 3, 4, 5)
    for name in ("MCP{}_abduction", "MCP{}_flexion", "PIP{}_flexion", "DIP{}_flexion")
)


@pytest.mark.thorough
def test_grip_moves_metacarpals_4_and_5_and_never_the_fixed_unit(take: Take) -> None:
    open_hand = take.motion.at(np.zeros(1))
    gripped = dataclasses.replace(open_hand, cup=np.ones(1))
    before, after = take.patient.placed(open_hand), take.patient.placed(gripped)
    assert np.array_equal(before.turn[:, Bone.FIXED], after.turn[:, Bone.FIXED])
    assert np.array_equal(before.joint_m[:, Bone.PP2], after.joint_m[:, Bone.PP2])
    assert np.array_equal(before.joint_m[:, Bone.PP3], after.joint_m[:, Bone.PP3])
    for bone, low, high in ((Bone.MC4, 9.9, 12.1), (Bone.MC5, 17.9, 20.1)):
        drop = before.turn[0, bone].T @ after.turn[0, bone, :, 0]
        assert low < np.degrees(np.arcsin(-drop[2])) < high
    assert after.joint_m[0, Bone.PP5, 2] < before.joint_m[0, Bone.PP5, 2] - 0.010
    assert np.degrees(take.truth.cup_rad).max(axis=0) == pytest.approx(
        np.degrees(take.patient.person.cup_rad), rel=0.02
    )


@pytest.mark.thorough
@pytest.mark.parametrize("seed", [3, 12, 13])
def test_skin_glides_as_far_as_was_drawn_and_settles(seed: int) -> None:
    motion = motion_of("mixed", seed)
    patient = made_patient(seed, "right", motion.at(np.zeros(1)))
    # In the axes of the straight hand's bones, from the discs as the truth has them.
    for name, (low, high) in {"WRIST": (3, 8), "CMC1": (2, 5), "MCP1": (2, 4), "MCP2": (2, 6), "MCP5": (2, 6)}.items():
        posture, bone = full_bend(name)
        row = NAMES.index(name)
        placed = placed_bones(patient.person, posture, np.eye(3))
        disc = disc_points(patient.person, patient.skin, patient.stuck, posture, np.eye(3))[:, row]
        local = np.einsum("nji,nj->ni", placed.turn[:, bone], disc - placed.joint_m[:, bone])
        rest = placed_bones(patient.person, rest_posture(), np.eye(3)).turn[0, bone]
        along = patient.stuck.path[row].along if bone != Bone.MC1 else rest.T @ patient.stuck.path[row].along
        glide = 1e3 * float((local[1] - local[0]) @ along)
        assert glide == pytest.approx(1e3 * patient.person.glide_m[name], abs=0.3)
        assert low - 0.3 < glide < high + 0.3
    # Most of a knuckle's glide is over by 45 degrees of the 90: it saturates.
    posture, _ = full_bend("MCP3")
    half = dataclasses.replace(posture, fingers=0.5 * posture.fingers)
    row = NAMES.index("MCP3")
    straight, full = patient.discs_m(posture)[:, row]
    middle = patient.discs_m(half)[1, row]
    assert np.linalg.norm(middle - straight) > 0.45 * np.linalg.norm(full - straight)


@pytest.mark.thorough
def test_rigid_palm_is_rigid() -> None:
    take = take_of(row_named("pro/supination, rigid palm"), 12)
    disc = take.truth.disc_position_cam_m
    apart = np.linalg.norm(disc[:, :, None] - disc[:, None], axis=-1)
    assert np.ptp(apart, axis=0).max() < 5e-5


@pytest.mark.thorough
def test_left_mirrors_right() -> None:
    right, left = (take_of(CUPPED, 12, side) for side in ("right", "left"))
    mirror = np.array([1.0, -1.0, 1.0])
    assert np.allclose(right.truth.angles_rad, left.truth.angles_rad, atol=1e-9)
    assert np.array_equal(right.truth.joint_angles_rad, left.truth.joint_angles_rad)
    assert np.allclose(right.truth.marker_position_w0_m * mirror, left.truth.marker_position_w0_m, atol=1e-9)
    assert np.allclose(right.truth.joint_position_w0_m * mirror, left.truth.joint_position_w0_m, atol=1e-9)
    assert np.linalg.det(left.truth.rotation_w0_cam) == pytest.approx(1.0)
    now = left.motion.at(np.zeros(1))
    body = left.patient.body(now)
    cam = left.hung.to_camera(body.disc_m)
    depth = depth_of(left.patient, left.hung, look_at(left), body)
    u, v = np.round(left.hung.pixel(cam[NAMES.index("MCP3")])).astype(int)
    assert abs(depth[v, u] - cam[NAMES.index("MCP3"), 2]) < 0.0012
    # A left thumb is on the right of the picture.
    assert left.truth.disc_pixel[0, NAMES.index("MCP1"), 0] > left.truth.disc_pixel[0, NAMES.index("MCP3"), 0]
    assert right.truth.disc_pixel[0, NAMES.index("MCP1"), 0] < right.truth.disc_pixel[0, NAMES.index("MCP3"), 0]


@pytest.mark.thorough
def test_depth_noise_follows_its_law() -> None:
    shape = (240, 320)
    for distance_m in (0.6, 0.9):
        sensor = sensor_of(31, shape)
        flat = np.full(shape, distance_m, dtype=np.float32)
        read = np.array([read_depth(sensor, flat, i) for i in range(12)]).astype(float)
        known = read > 0
        assert known.mean() > 0.98
        disparity = COUNTS_PER_M * sensor.scale * DISPARITY_PX_M / np.where(known, read, np.nan)
        # Given in eighths of a pixel, but for the rounding of the file's counts.
        off = np.abs(disparity / STEP_PX - np.round(disparity / STEP_PX))
        assert np.nanmax(off) * STEP_PX < 0.6 * DISPARITY_PX_M / (COUNTS_PER_M * distance_m**2) + 1e-3
        spread = np.nanstd(disparity - np.nanmean(disparity, axis=0), axis=0)
        expected = np.hypot(sensor.disparity_sd_px, STEP_PX / np.sqrt(12.0))
        assert np.sqrt(np.nanmean(spread**2)) == pytest.approx(expected, rel=0.2)
        # Neighbours share their noise, far ones do not.
        noise = np.nan_to_num(disparity - np.nanmean(disparity, axis=0))
        near, far = (np.mean(noise[..., step:] * noise[..., :-step]) / np.mean(noise**2) for step in (1, 12))
        assert near > 0.5
        assert abs(far) < 0.06


@pytest.mark.thorough
def test_depth_has_holes_where_the_projector_is_hidden() -> None:
    sensor = sensor_of(31, (120, 160))
    scene = np.full((120, 160), 0.8, dtype=np.float32)
    scene[40:80, 60:100] = 0.65
    read = read_depth(sensor, scene, 0)
    shadow = int(np.floor(DISPARITY_PX_M / 0.65 - DISPARITY_PX_M / 0.8))
    beside, other = read[45:75, 101 : 100 + shadow], read[45:75, 30:50]
    assert (beside == 0).mean() > 0.8
    assert (other == 0).mean() < 0.05


@pytest.mark.thorough
def test_colour_noise_grows_with_the_light() -> None:
    sensor = sensor_of(31, (120, 160))
    spread = []
    for light in (0.05, 0.4):
        flat = np.full((120, 160, 3), light, dtype=np.float32)
        pictures = np.array([exposed(sensor, flat, i) for i in range(10)]).astype(float)
        linear = (pictures / 255.0) ** 2.2
        spread.append(linear.std(axis=0)[40:80, 60:100].mean())
        assert pictures[0][60, 80].mean() > pictures[0][2, 2].mean()
    assert spread[1] > 1.5 * spread[0]


@pytest.mark.thorough
@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.name)
def test_second_patient_starts_still_and_stays_in_frame(row: Row, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(recording, "FPS", 10.0)
    truth = take_of(row, 12 + ROWS.index(row) % 2).truth
    still = truth.timestamp_s - truth.timestamp_s[0] < 0.6
    assert np.count_nonzero(still) >= 5
    assert np.degrees(np.abs(truth.angles_rad[still])).max() < 0.6
    assert np.linalg.norm(truth.position_m[still], axis=1).max() < 0.001
    assert (truth.disc_pixel > 6.0).all()
    assert (truth.disc_pixel < np.array([633.0, 473.0])).all()
    assert np.isfinite(truth.joint_angles_rad).all()
    assert 0.6 < truth.translation_w0_cam_m[2] < 0.85


@pytest.mark.thorough
def test_recording_tracks_and_its_truth_compares(tmp_path: Path) -> None:
    folder = tmp_path / "take"
    truth = recorded(take_of(row_named("rest, fingers open and close"), 12, seconds=0.9), folder)
    assert json.loads((folder / CLICKS_FILE).read_text())["protocol"] == "wrist6"
    stored = read_session(folder / TRUTH_FILE)
    assert np.allclose(stored.motion.angles_rad, truth.angles_rad)
    assert np.allclose(stored.timestamp_s, truth.timestamp_s)
    wrist = stored.calibration.translation_w0_cam_m + stored.motion.position_m @ stored.calibration.rotation_w0_cam.T
    assert np.allclose(wrist, stored.markers.position_cam_m[:, 0], atol=1e-4)
    output = tmp_path / "session.h5"
    source = TumFolder(folder)
    track_recording(source, read_clicks(folder / CLICKS_FILE), output, TrackSettings())
    session = read_session(output)
    assert np.mean(session.status == 0) > 0.9
    assert np.allclose(session.timestamp_s, truth.timestamp_s)
    assert np.degrees(np.sqrt(np.nanmean((session.motion.angles_rad - truth.angles_rad) ** 2))) < 6.0


@pytest.mark.thorough
def test_second_patient_recording_matches_truth(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A motion that is drawn of other data beside another checkout is no recording of this one."""
    monkeypatch.setattr("platformdirs.user_cache_dir", lambda *_, **__: str(tmp_path))
    row = next(row for row in ROWS if row.motion == "grasp")
    folder, _ = kept_recording(row, 12, seconds=0.1)
    assert kept_recording(row, 12, seconds=0.1)[0] == folder
    monkeypatch.setattr(recording, "motion_of", lambda name, seed: motion_of(name, seed + 1))
    assert kept_recording(row, 12, seconds=0.1)[0] != folder
