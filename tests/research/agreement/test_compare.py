"""A session against references whose difference is known: shift, turn, offset, readings, and what cannot be used."""

from __future__ import annotations

import csv
import json
import math
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest

from carpus.core.formats import c3d, trc
from carpus.core.model import so3
from carpus.core.model.errors import ReferenceUnreadable, ReferenceUnsuited
from carpus.core.model.hand.protocols import WRIST_ANGLES
from carpus.core.research.agreement.agreement_files import format_comparison
from carpus.core.research.agreement.compare import MIN_MATCH, _check_match, compare_session, comparison_remarks
from carpus.core.research.agreement.reference import Reference, read_reference
from carpus.core.research.agreement.time_alignment import AlignmentCurves, ClockShift, find_shift, with_residual_drift
from carpus.core.results.session_results import compute_session_results
from carpus.core.session.values import Session
from tests.commands import Command
from tests.formats.takes import build_take, store_session
from tests.ui.fakes import session as flexing
from tests.ui.printed import count_pages, read_words


@pytest.fixture(scope="module")
def session() -> Session:
    """Flexion to and fro, 30 frames a second, all of it tracked."""
    made = flexing(seconds=26.0)
    return replace(made, status=np.zeros(len(made), dtype=np.int64))


def other_session(session: Session, shift_s: float, offset_deg: float = 0.0, rate_hz: float = 100.0) -> Reference:
    """The session's own curve at another rate, later by ``shift_s``."""
    time_s = session.timestamp_s - session.timestamp_s[0]
    there_s = np.arange(max(0.0, shift_s), time_s[-1] + min(0.0, shift_s), 1.0 / rate_hz)
    own = session.motion.angles_rad
    angles = {
        name: np.interp(there_s - shift_s, time_s, own[:, k]) + math.radians(offset_deg)
        for k, name in enumerate(WRIST_ANGLES)
    }
    return Reference(Path("other.mot"), "angles", there_s - there_s[0] + 100.0, angles)


def test_compare_finds_shift_and_offset(session: Session) -> None:
    """A reference that began so many of its samples earlier: what was before does not matter."""
    reference, later = other_session(session, 0.0, offset_deg=-3.0), 34
    angles = {name: np.concatenate((np.full(later, v[0]), v)) for name, v in reference.angles_rad.items()}
    times_s = np.arange(len(angles["flexion"])) / 100.0 + 100.0
    found = compare_session(session, replace(reference, time_s=times_s, angles_rad=angles))
    assert found.shift.lag_s == pytest.approx(later / 100, abs=0.004)
    flexion = next(one for one in found.pairs if one.name == "flexion").figures_deg
    assert flexion.bias == pytest.approx(3.0, abs=0.05)
    assert flexion.sd < 0.5
    assert flexion.correlation > 0.999


def test_compare_opposite_sign_is_remarked(session: Session) -> None:
    right = other_session(session, 0.0)
    turned = replace(right, angles_rad=dict(right.angles_rad) | {"flexion": -right.angles_rad["flexion"]})
    found = compare_session(session, turned)
    assert found.shift.lag_s == pytest.approx(0.0, abs=0.01)
    flexion = next(one for one in found.pairs if one.name == "flexion").figures_deg
    assert flexion.correlation < -0.99
    assert flexion.icc < 0.0, "not flattered"
    assert any(remark.startswith("flexion: ") and "opposite sign" in remark for remark in found.remarks)
    assert "opposite sign" in format_comparison(found)[0]
    assert [remark for remark in found.angle_remarks("flexion") if "opposite" in remark]
    assert not [remark for remark in found.angle_remarks("deviation") if "opposite" in remark]
    assert not any("opposite" in remark for remark in compare_session(session, right).remarks)


def test_compare_wrong_unit_is_remarked(session: Session) -> None:
    right, factor = other_session(session, 0.0), math.pi / 180.0
    found = compare_session(
        session, replace(right, angles_rad={name: factor * v for name, v in right.angles_rad.items()})
    )
    assert any(remark.startswith("flexion: the reference moves") for remark in found.remarks)
    flexion = next(one for one in found.pairs if one.name == "flexion")
    assert np.ptp(flexion.reference_rad) == pytest.approx(factor * np.ptp(flexion.measured_rad), rel=0.02)
    assert not any("as far as Carpus" in remark for remark in compare_session(session, right).remarks)


def test_compare_whole_turns_agree(session: Session) -> None:
    right = other_session(session, 0.0)
    wrapped = {name: np.mod(v, 2.0 * math.pi) for name, v in right.angles_rad.items()}
    for angles in (wrapped, {name: v + 4.0 * math.pi for name, v in right.angles_rad.items()}):
        found = compare_session(session, replace(right, angles_rad=angles), lag_s=0.0)
        assert all(one.figures_deg.largest_difference < 2.0 for one in found.pairs)
    late = compare_session(session, right, lag_s=0.4)
    assert (late.shift.lag_s, late.pairs[1].name) == (0.4, "flexion")
    assert late.pairs[1].figures_deg.sd > 5.0, "the lag that was given is used"


@pytest.mark.parametrize("kind", ["c3d", "trc"])
def test_compare_points_are_aligned_rigidly(session: Session, kind: str, tmp_path: Path) -> None:
    turn = so3.exp(np.array([0.4, -1.1, 0.3]))
    # A palm that is one rigid body, as optical discs on a splint are, moved as the session's angles say.
    calibration = session.calibration
    body = calibration.marker_position_w0_m[:6]
    rotation = session.motion.rotation_w2_w0
    place_w0 = np.einsum("nij,mj->nmi", rotation, body)
    cam = place_w0 @ calibration.rotation_w0_cam.T + calibration.translation_w0_cam_m
    rigid = replace(session, markers=replace(session.markers, position_cam_m=cam))
    elsewhere = cam @ turn.T + (0.5, -2.0, 1.0)
    theirs = replace(
        rigid, markers=replace(session.markers, position_cam_m=elsewhere), motion=session.motion, path=tmp_path / "s.h5"
    )
    writer = c3d if kind == "c3d" else trc
    writer.write(build_take(theirs, "s"), tmp_path)
    found = compare_session(rigid, read_reference(tmp_path / f"s.{kind}"))
    assert found.alignment.residual_m < 5e-4
    flexion = next(one for one in found.pairs if one.name == "flexion").figures_deg
    assert abs(flexion.bias) < 2.5, "the neutral pose is where the first half second is"
    assert flexion.sd < 0.7
    assert flexion.correlation > 0.999


def test_compare_table_with_column_map_agrees(session: Session, tmp_path: Path) -> None:
    path = tmp_path / "optical.csv"
    time_s = session.timestamp_s - session.timestamp_s[0]
    with path.open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, delimiter=";")
        table.writerow(["Zeit", "FlexExt", "other"])
        for t, angle in zip(time_s, np.degrees(session.motion.angles_rad[:, 1]), strict=True):
            table.writerow([f"{t:.4f}".replace(".", ","), f"{-angle:.4f}".replace(".", ","), "1"])
    found = compare_session(session, read_reference(path, {"time": "Zeit", "flexion": "-FlexExt"}))
    (flexion,) = found.pairs
    assert flexion.figures_deg.rmse < 0.02
    assert any("other" in reason for reason in found.unused)
    assert any("deviation" in reason for reason in found.unused)
    with pytest.raises(ReferenceUnreadable, match="NoSuch"):
        read_reference(path, {"time": "Zeit", "flexion": "NoSuch"})


def test_compare_goniometer_readings_agree(session: Session, tmp_path: Path) -> None:
    held = np.zeros_like(session.motion.angles_rad)
    time_s = session.timestamp_s - session.timestamp_s[0]
    held[:, 1] = np.radians(10.0 * np.floor(time_s / 2.0))
    still = replace(session, motion=replace(session.motion, angles_rad=held))
    path = tmp_path / "goniometer.csv"
    rows = [f"{'flexion' if k else 'extension'},{10 * k - 2},{2 * k + 1}" for k in range(6)]
    path.write_text("angle,reading_deg,time_s\n" + "\n".join([*rows, "flexion,20,6.0", "toe,3,1"]), encoding="utf-8")
    found = compare_session(still, read_reference(path), figures=compute_session_results(still))
    (flexion,) = found.pairs
    assert flexion.figures_deg.count == 6
    assert flexion.measured_rad[1:] == pytest.approx(np.radians([10.0, 20, 30, 40, 50]), abs=1e-3)
    # Five readings 2 degrees low, and an extension of -2 read as flexion of 2: all by their sign.
    assert np.degrees(flexion.measured_rad - flexion.reference_rad).round(2).tolist() == [-2.0, 2.0, 2.0, 2.0, 2.0, 2.0]
    assert found.excluded_count == 1
    assert any("not still" in reason for reason in found.unused)
    assert any("toe" in reason for reason in found.unused)
    assert found.shift is None


def test_compare_forearm_goniometer_counts_from_thumb_up(session: Session, tmp_path: Path) -> None:
    held = np.zeros_like(session.motion.angles_rad)
    time_s = session.timestamp_s - session.timestamp_s[0]
    held[:, 2] = np.radians(30.0 * np.floor(time_s / 4.0))  # palm down, 30 and 60 degrees up from there
    still = replace(session, motion=replace(session.motion, angles_rad=held))
    path = tmp_path / "goniometer.csv"
    rows = [f"pronation,{90 - 30 * k},{4 * k + 2}" for k in range(3)]
    path.write_text("angle,reading_deg,time_s\n" + "\n".join(rows), encoding="utf-8")
    (turned,) = compare_session(still, read_reference(path), figures=compute_session_results(still)).pairs
    assert np.degrees(turned.measured_rad - turned.reference_rad) == pytest.approx([0.0, 0.0, 0.0], abs=1e-6)
    assert np.degrees(turned.reference_rad) == pytest.approx([0.0, 30.0, 60.0]), "a pair has the angle of the files"


@pytest.mark.filterwarnings("error")
def test_compare_empty_reference_is_refused(session: Session) -> None:
    unknown = {"flexion": np.full(900, np.nan)}
    for times_s, angles in ((np.empty(0), {"flexion": np.empty(0)}), (np.arange(900) / 30.0, unknown)):
        with pytest.raises(ReferenceUnsuited, match="overlap"):
            compare_session(session, Reference(Path("x.mot"), "angles", times_s, angles))


def test_compare_another_movement_is_refused(session: Session) -> None:
    rng = np.random.default_rng(2)
    noise = {"flexion": np.cumsum(rng.normal(size=3000)) * 0.01}
    with pytest.raises(ReferenceUnsuited):
        compare_session(session, Reference(Path("x.mot"), "angles", np.arange(3000) / 100.0, noise), max_shift_s=0.2)
    with pytest.raises(ReferenceUnsuited, match="palm markers"):
        compare_session(
            session, Reference(Path("x.c3d"), "points", np.arange(9.0), points_m={"WRIST": np.zeros((9, 3))})
        )


def test_compare_command_writes_tables_and_plots_with_limit(tmp_path: Path, command: Command) -> None:
    path, out = store_session(tmp_path, frames=90, moving=True), tmp_path / "out"
    done = command("compare", path, path, "--limit", "5", "--output", out)
    assert done.code == 0
    content = json.loads((out / "one-against-one.agreement.json").read_text(encoding="utf-8"))
    assert {row["angle"] for row in content["angles"]} == set(WRIST_ANGLES)
    assert len(content["provenance"]["reference"]["sha256"]) == 64
    assert (out / "one-against-one.agreement.csv").exists()
    assert "Limit        flexion agrees within 5°" in done.out.splitlines()
    for name in WRIST_ANGLES:
        picture = cv2.imread(str(out / f"one-against-one.{name}.png"))
        assert picture.shape == (960, 2240, 3)
        assert min(picture[:, :1120].std(), picture[:, 1120:].std()) > 5.0, "two plots are drawn"
    words = read_words(out / "one-against-one.pdf")
    for piece in ("Flexion–extension", "RMSE", "Reference", "Limit", "hatched: within the limit you set"):
        assert piece in words
    assert count_pages(out / "one-against-one.pdf") == len(WRIST_ANGLES)


@pytest.mark.parametrize("name", ["x.c3d", "x.trc", "x.mot", "x.csv", "x.xyz"])
@pytest.mark.parametrize("content", [b"", b"nonsense\n1,2\n", bytes(range(256)) * 8])
def test_reference_invalid_file_is_refused(name: str, content: bytes, tmp_path: Path) -> None:
    (tmp_path / name).write_bytes(content)
    with pytest.raises(ReferenceUnreadable):
        read_reference(tmp_path / name)


def test_compare_drift_over_minutes_is_accepted() -> None:
    time_s, there_s = np.arange(0.0, 70.0, 1 / 30), np.arange(0.0, 70.0, 0.01)
    mine, other = np.sin(np.pi * time_s), np.sin(np.pi * there_s / 0.98)
    curves = AlignmentCurves(time_s, mine[:, None], there_s, other[:, None], ignores_sign=True)
    shift = find_shift(curves, 10.0)
    assert abs(shift.match) < MIN_MATCH
    _check_match(Reference(Path("x.mot"), "angles"), curves, with_residual_drift(curves, shift))
    noise = replace(curves, reference_values=np.random.default_rng(0).normal(size=curves.reference_values.shape))
    with pytest.raises(ReferenceUnsuited):
        _check_match(Reference(Path("x.mot"), "angles"), noise, with_residual_drift(noise, find_shift(noise, 10.0)))


def test_compare_opposed_curves_remark_a_larger_shift() -> None:
    against = ClockShift(
        -0.5, -0.98, ((1.0, 0.97),), has_more_rivals=True, same_sign_shift=(1.0, 0.97), max_shift_s=10.0
    )
    said = comparison_remarks((), against)
    assert any("more than 10 s" in remark and "+1.00 s (0.970)" in remark for remark in said)
    assert any(remark.endswith("…") for remark in said)
    assert not any(
        "time shift is more than" in remark
        for remark in comparison_remarks((), replace(against, match=0.98, same_sign_shift=None))
    )
