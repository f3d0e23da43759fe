"""Forward kinematics against the reference's numbers and against plain Denavit-Hartenberg chains."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from carpus.core.model.hand.anatomy import HandAnatomy, anatomy_from_size
from carpus.core.model.hand.clinical_angles import wrist_axes
from carpus.core.model.hand.kinematics import DIP_PER_PIP, disc_centres, joint_centres, segment_frames
from carpus.core.model.hand.protocols import HAND21, PALM_MARKERS, joint_angle_names
from carpus.core.model.types import FloatArray, Side

# Reference 3.4: HL 180, HB 80, no offsets, millimetres, right hand.
ZERO_MM = {
    "CMC1": (13.1, 15.7, 0), "MCP1": (52.3, 38.3, 0), "IP1": (82.8, 55.9, 0), "TIP1": (107.5, 70.1, 0),
    "MCP2": (80.5, 20.1, 0), "PIP2": (124.4, 23.9, 0), "DIP2": (150.0, 26.2, 0), "TIP2": (167.4, 27.7, 0),
    "MCP3": (80.3, 0, 0), "PIP3": (128.2, 0, 0), "DIP3": (158.8, 0, 0), "TIP3": (178.2, 0, 0),
    "MCP4": (73.6, -16.5, 0), "PIP4": (117.4, -20.3, 0), "DIP4": (147.0, -22.9, 0), "TIP4": (166.1, -24.6, 0),
    "MCP5": (66.2, -32.2, 0), "PIP5": (102.4, -38.5, 0), "DIP5": (123.1, -42.2, 0), "TIP5": (139.6, -45.1, 0),
}  # fmt: skip
FLEXED_MM = {
    "CMC1": (13.1, 15.7, 0), "MCP1": (41.5, 39.5, -25.9), "IP1": (64.1, 46.9, -52.0), "TIP1": (81.3, 38.1, -72.8),
    "MCP2": (80.5, 20.1, 0), "PIP2": (113.7, 25.9, -28.3), "DIP2": (109.3, 25.2, -53.7), "TIP2": (96.2, 22.8, -64.9),
    "MCP3": (80.3, 0, 0), "PIP3": (114.1, 0, -33.9), "DIP3": (106.2, 0, -63.4), "TIP3": (90.3, 0, -74.6),
    "MCP4": (73.6, -16.5, 0), "PIP4": (101.6, -20.4, -33.6), "DIP4": (91.5, -19.0, -61.6),
    "TIP4": (75.0, -16.7, -71.2), "MCP5": (66.2, -32.2, 0), "PIP5": (86.3, -38.7, -30.1),
    "DIP5": (77.8, -35.9, -49.2), "TIP5": (63.4, -31.2, -56.2),
}  # fmt: skip
FLEXED_DEG = [10, 35, 20, 5, 30, 5, 40, 60, 0, 45, 60, -3, 50, 60, -8, 55, 60]
ZERO_RAD = np.zeros(17)
FLEXED_RAD = np.radians(FLEXED_DEG)
SIDES: tuple[Side, ...] = ("right", "left")


@pytest.mark.parametrize("side", SIDES)
@pytest.mark.parametrize(
    ("angles_rad", "table"), [(ZERO_RAD, ZERO_MM), (FLEXED_RAD, FLEXED_MM)], ids=["zero", "flexed"]
)
def test_worked_example_of_the_reference(
    side: Side, angles_rad: FloatArray, table: dict[str, tuple[float, ...]]
) -> None:
    hand = anatomy_from_size(0.180, 0.080, arch=0.0, skin_offsets=False, side=side)
    mirror = np.array([1.0, 1.0 if side == "right" else -1.0, 1.0])
    for points in (joint_centres(hand, angles_rad), disc_centres(hand, angles_rad)):
        assert np.array_equal(points[0], np.zeros(3))
        for marker, place in table.items():
            found_mm = points[HAND21.markers.index(marker)] * 1e3
            assert found_mm == pytest.approx(mirror * place, abs=0.1), marker


def _dh(theta: float, d: float, a: float, alpha_deg: float) -> FloatArray:
    """Standard Denavit-Hartenberg step Rz(theta) Tz(d) Tx(a) Rx(alpha)."""
    ct, st = np.cos(theta), np.sin(theta)
    ca, sa = np.cos(np.radians(alpha_deg)), np.sin(np.radians(alpha_deg))
    return np.array(
        [[ct, -st * ca, st * sa, a * ct], [st, ct * ca, -ct * sa, a * st], [0.0, sa, ca, d], [0.0, 0.0, 0.0, 1.0]]
    )


def _to_base(place: FloatArray) -> tuple[FloatArray, float]:
    theta = float(np.arctan2(place[1], place[0]))
    return _dh(theta, place[2], float(np.hypot(place[0], place[1])), 0.0), theta


def _chain(base: FloatArray, rows: list[tuple[float, float, float]]) -> list[FloatArray]:
    """Frames after each row (theta, a, alpha), the base first."""
    frames = [base]
    for theta, a, alpha_deg in rows:
        frames.append(frames[-1] @ _dh(theta, 0.0, a, alpha_deg))
    return frames


def _oracle(hand: HandAnatomy, angles: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Joints (21, 3), discs (21, 3) and bone normals (16, 3) by 4x4 chains, table 3.2, one pose of 21 angles."""
    joints, discs = np.zeros((21, 3)), np.zeros((21, 3))
    joints[[0, 1, 5, 9, 13, 17]], discs[[0, 1, 5, 9, 13, 17]] = hand.palm_joint_m, hand.palm_disc_m
    normals = [np.array([0.0, 0.0, 1.0])]

    q1, q2, q3, q4, q5 = angles[:5]
    base, theta0 = _to_base(hand.palm_joint_m[1])
    mc, pp, dp = hand.thumb_length_m
    tau_deg = float(np.degrees(hand.thumb_roll_rad))
    rows = [
        (q1 + hand.fan_rad[0] - theta0, 0.0, -90.0),
        (q2, mc, -tau_deg),
        (q3, 0.0, 90.0),
        (q4, pp, -90.0),
        (q5, dp, 0.0),
    ]
    frames = _chain(base, rows)
    bones = [frames[2], frames[4], frames[5]]  # MC1, PP1, DP1: x along the bone, y palmar
    bone_normals = [-bone[:3, 1] for bone in bones]
    joints[2:5] = [bone[:3, 3] for bone in bones]
    bisector = bone_normals[1] + bone_normals[2]
    stands = [bone_normals[0], bisector / np.linalg.norm(bisector), bone_normals[2]]
    discs[2:5] = joints[2:5] + hand.thumb_offset_m[:, None] * np.array(stands)
    normals += bone_normals

    for i in range(4):
        abduction, mcp, pip, dip = angles[5 + 4 * i : 9 + 4 * i]
        base, theta0 = _to_base(hand.palm_joint_m[2 + i])
        lengths = hand.finger_length_m[i]
        rows = [(abduction + hand.fan_rad[1 + i] - theta0, 0.0, -90.0)]
        rows += [(q, length, 0.0) for q, length in zip((mcp, pip, dip), lengths, strict=True)]
        bones = _chain(base, rows)[2:]
        bone_normals = [-bone[:3, 1] for bone in bones]
        places = slice(6 + 4 * i, 9 + 4 * i)
        joints[places] = [bone[:3, 3] for bone in bones]
        pairs = [bone_normals[0] + bone_normals[1], bone_normals[1] + bone_normals[2], bone_normals[2]]
        stands = [pair / np.linalg.norm(pair) for pair in pairs]
        discs[places] = joints[places] + hand.finger_offset_m[i][:, None] * np.array(stands)
        normals += bone_normals

    mirror = np.array([1.0, 1.0 if hand.side == "right" else -1.0, 1.0])
    return joints * mirror, discs * mirror, np.array(normals) * mirror


def _random_hand(rng: np.random.Generator, side: Side) -> HandAnatomy:
    average = anatomy_from_size(rng.uniform(0.13, 0.20), side=side)
    arrays = [
        field.name for field in dataclasses.fields(average) if isinstance(getattr(average, field.name), np.ndarray)
    ]
    shaken = {name: rng.uniform(0.8, 1.2, getattr(average, name).shape) * getattr(average, name) for name in arrays}
    return dataclasses.replace(average, thumb_roll_rad=rng.uniform(0.6, 1.5), **shaken)


@pytest.mark.parametrize("side", SIDES)
def test_closed_form_equals_the_chains(side: Side) -> None:
    rng = np.random.default_rng(20)
    for _ in range(20):
        hand = _random_hand(rng, side)
        angles = rng.uniform(-2.0, 2.0, (5, 21))
        joints, discs, frames = joint_centres(hand, angles), disc_centres(hand, angles), segment_frames(hand, angles)
        for pose in range(5):
            by_chain = _oracle(hand, angles[pose])
            assert np.allclose(joints[pose], by_chain[0], atol=1e-12, rtol=0.0)
            assert np.allclose(discs[pose], by_chain[1], atol=1e-12, rtol=0.0)
            assert np.allclose(frames.dorsal_normal[pose], by_chain[2], atol=1e-12, rtol=0.0)


def test_kinematics_coupled_dip_follows_pip() -> None:
    rng = np.random.default_rng(21)
    hand = _random_hand(rng, "left")
    coupled = rng.uniform(-1.5, 1.5, (8, 17))
    free = np.zeros((8, 21))
    free_names = joint_angle_names(dip_free=True)
    for column, name in enumerate(joint_angle_names()):
        free[:, free_names.index(name)] = coupled[:, column]
        if name.startswith("PIP"):
            free[:, free_names.index(name.replace("PIP", "DIP"))] = DIP_PER_PIP * coupled[:, column]
    assert np.allclose(joint_centres(hand, coupled), joint_centres(hand, free), atol=1e-15)
    assert np.allclose(disc_centres(hand, coupled), disc_centres(hand, free), atol=1e-15)


@pytest.mark.parametrize("length_m", [0.130, 0.200])
def test_offsets_grow_with_the_hand(length_m: float) -> None:
    offset_mm = anatomy_from_size(length_m).skin_offset_m * 1e3 * 180.0 / (length_m * 1e3)
    expected = {"WRIST": 15, "CMC1": 10, "MCP1": 9, "IP1": 7, "TIP1": 5, "MCP3": 11, "PIP2": 7.5, "DIP5": 5.5}
    for marker, height in expected.items():
        assert offset_mm[HAND21.markers.index(marker)] == pytest.approx(height)


@pytest.mark.parametrize("arch", [0.0, 2.0])
def test_palm_discs_define_the_wrist_frame_they_are_given_in(arch: float) -> None:
    discs = anatomy_from_size(0.175, arch=arch).palm_disc_m
    assert np.allclose(wrist_axes(discs, np.array([0.0, 0.0, 1.0])), np.eye(3), atol=1e-12)
    assert np.allclose(discs[PALM_MARKERS.index("WRIST")], 0.0)
    assert np.allclose(discs[PALM_MARKERS.index("MCP3"), 1:], 0.0, atol=1e-12)


def test_arrays_are_checked_copied_and_read_only() -> None:
    lengths = np.full((4, 3), 0.02)
    hand = dataclasses.replace(anatomy_from_size(0.18), finger_length_m=lengths)
    lengths[:] = 1.0
    assert hand.finger_length_m[0, 0] == 0.02
    with pytest.raises(ValueError, match="read-only"):
        hand.finger_length_m[0, 0] = 1.0
    with pytest.raises(ValueError, match="finger_length_m"):
        dataclasses.replace(hand, finger_length_m=np.zeros((3, 3)))


def test_nail_discs_shorten_only_the_last_segment() -> None:
    whole, nail = anatomy_from_size(0.18), anatomy_from_size(0.18, nail_discs=True)
    assert np.allclose(nail.finger_length_m / whole.finger_length_m, [[1.0, 1.0, 0.7]] * 4)
    assert np.allclose(nail.thumb_length_m / whole.thumb_length_m, [1.0, 1.0, 0.8])
