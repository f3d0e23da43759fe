"""The check card: what it knows is measured, a camera that is off is told, and the doctor knows the last verdict."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from datetime import UTC, datetime, timedelta
from pathlib import Path

import numpy as np
import pytest

from carpus.app.__main__ import main
from carpus.app.settings import load_settings
from carpus.core.calibration.camera.printed_sheet import PAPER_MM, Paper, SheetDisc, SheetLine, SheetText
from carpus.core.calibration.card.card import (
    DIMENSIONS,
    CardReading,
    card_sheets,
    verdict_sentence,
)
from carpus.core.calibration.card.checks import (
    CardCheck,
    add_check,
    checks_path,
    examine_cameras,
    read_checks,
)
from carpus.core.calibration.card.measure import CardMeasurement, measure_card
from carpus.core.capture.calibrated_source import new_calibration_path
from carpus.core.capture.camera_info import StoredCalibration, write_camera_info
from carpus.core.capture.files.raw import RawWriter
from carpus.core.capture.source import SourceInfo
from carpus.core.model.camera import Camera
from carpus.core.model.errors import CardNotVisible
from carpus.core.model.types import Frame
from tests.studio import LENS, Studio, card_scene

NOW = datetime(2026, 11, 20, 9, tzinfo=UTC)


@pytest.fixture(scope="module")
def shown() -> list[Frame]:
    """The card as a camera with a right depth sees it, every half second."""
    studio, scene = Studio(seed=8, depth_scale_error=0.0), card_scene()
    return [studio.frame(scene, k, 100.0 + 0.5 * k) for k in range(6)]


def scale_depth(frames: Sequence[Frame], share: float) -> list[Frame]:
    """The same with depth off by a share."""
    return [replace(frame, depth_unit_m=frame.depth_unit_m * share) for frame in frames]


def check(day: int, angle: float = 0.6, length: float = 0.8, scale: float = 1.0) -> CardCheck:
    measured = np.array([one.true_value for one in DIMENSIONS])
    measured[0] += angle
    measured[3] += length
    reading = CardReading(measured, np.full(6, 0.1), scale, np.nan, 0)
    return CardCheck((NOW + timedelta(days=day)).isoformat(), "77", reading, "x")


def test_card_of_a_good_camera_is_within_tolerance(shown: list[Frame]) -> None:
    reading = measure_card(shown, LENS, "card")
    assert reading.frames_used == len(shown)
    assert reading.has_valid_angles
    assert reading.has_valid_lengths
    assert reading.scale == pytest.approx(1.0, abs=0.003)
    assert reading.distance_m == pytest.approx(0.59, abs=0.03)


def test_card_live_counts_steady_frames_only(shown: list[Frame]) -> None:
    watch = CardMeasurement(LENS, only_steady=True)
    seen = [watch.process_frame(frame) for frame in shown[:3]]
    assert [look.frames_used for look in seen if look is not None] == [1, 2, 3]
    last = seen[-1]
    assert last is not None
    assert last.pixel is not None
    assert last.steady_s == pytest.approx(1.0)
    blank = replace(shown[0], timestamp_s=101.5, color_rgb=np.full_like(shown[0].color_rgb, 200))
    gone = watch.process_frame(blank)
    assert gone is not None
    assert (gone.pixel, gone.steady_s) == (None, pytest.approx(1.0))
    away = replace(shown[3], timestamp_s=102.0, depth_unit_m=shown[3].depth_unit_m * 1.1)
    moved = watch.process_frame(away)
    assert moved is not None
    assert (moved.has_moved, moved.frames_used, moved.steady_s) == (True, 1, 0.0)
    with pytest.raises(CardNotVisible):
        watch.compute_reading("card")


def test_card_depth_or_focal_length_error_is_out_of_tolerance(shown: list[Frame]) -> None:
    reading = measure_card(scale_depth(shown, 0.98), LENS, "card")
    assert reading.scale == pytest.approx(0.98, abs=0.004)
    assert not reading.has_valid_lengths
    assert reading.has_valid_angles, "a pure scale leaves angles right"
    wide = Camera(1.05 * LENS.fx_px, 1.05 * LENS.fy_px, LENS.cx_px, LENS.cy_px, distortion=LENS.distortion)
    assert not measure_card(shown, wide, "card").has_valid_lengths


def test_card_incomplete_is_refused(shown: list[Frame]) -> None:
    hidden = [replace(frame, color_rgb=frame.color_rgb.copy()) for frame in shown]
    for frame in hidden:
        frame.color_rgb[:200] = 230
    with pytest.raises(CardNotVisible, match=f"0 of {len(shown)}"):
        measure_card(hidden, LENS, "card")


@pytest.mark.parametrize("paper", PAPER_MM)
def test_card_sheets_fit_the_paper_and_fold(paper: Paper) -> None:
    for sheet in card_sheets(paper):
        discs = [mark for mark in sheet.items if isinstance(mark, SheetDisc)]
        assert len(discs) == 3
        lines = [end for mark in sheet.items if isinstance(mark, SheetLine) for end in (mark.from_mm, mark.to_mm)]
        assert min(min(end) for end in lines) > 5.0
        assert max(x for x, _ in lines) < sheet.width_mm - 5.0
        assert max(y for _, y in lines) < sheet.height_mm - 5.0
        assert any(isinstance(mark, SheetText) and "100 mm" in mark.text for mark in sheet.items)


LINE_OF_0_2_0 = (
    '{"when": "2026-11-21T09:00:00+00:00", "serial": "77", "angle_error_deg": 0.6, "length_error_mm": 0.8, '
    '"scale": 1.0, "measured": [30.6, 50.0, 90.0, 80.8, 120.0, 25.0], "sd": [0.1, 0.1, 0.1, 0.1, 0.1, 0.1], '
    '"calibrated": "x", "most_angle_deg": 2.0, "most_length_mm": 2.5}'
)


def test_read_checks_of_a_damaged_file_returns_the_others(tmp_path: Path) -> None:
    path = checks_path(tmp_path, "77")
    add_check(path, check(0))
    with path.open("ab") as file:
        file.write(b"[" * 100_000 + b'\n{"measured": [1], "sd": [1]}\n' + LINE_OF_0_2_0.encode() + b'\n{"when": "202')
    add_check(path, check(2))
    kept = read_checks(path)
    assert [one.checked_at[:10] for one in kept] == ["2026-11-20", "2026-11-21", "2026-11-22"]
    assert [one.reading.angle_error_deg for one in kept] == pytest.approx([0.6] * 3)
    assert path.stat().st_mode & 0o077 == 0


def test_examine_cameras_names_age_of_calibration_and_check(tmp_path: Path) -> None:
    assert [finding.state for finding in examine_cameras(tmp_path, NOW)] == ["warning"]
    path = new_calibration_path(tmp_path, "77", NOW)
    path.parent.mkdir()
    write_camera_info(path, LENS, calibration=StoredCalibration("77", NOW.isoformat(), 1.0, 0.0, 0.2, 20))
    (never,) = examine_cameras(tmp_path, NOW + timedelta(days=2))
    assert (never.state, never.observation) == ("warning", "calibrated 2 days ago, never checked")
    add_check(checks_path(tmp_path, "77"), check(3))
    (good,) = examine_cameras(tmp_path, NOW + timedelta(days=5))
    assert (good.name, good.state, good.remedy) == ("Camera 77", "good", "")
    assert good.observation == f"calibrated 5 days ago, checked 2 days ago: {verdict_sentence(check(3).reading)}"
    (old,) = examine_cameras(tmp_path, NOW + timedelta(days=11))
    assert old.state == "warning"
    assert "older than 7 days" in old.remedy
    add_check(checks_path(tmp_path, "77"), check(12, scale=1.02))
    (out,) = examine_cameras(tmp_path, NOW + timedelta(days=12))
    assert out.state == "bad"
    since = NOW + timedelta(days=12, hours=1)
    made = StoredCalibration("77", since.isoformat(), 1.0, 0.0, 0.2, 20)
    write_camera_info(new_calibration_path(tmp_path, "77", since), LENS, calibration=made)
    (later,) = examine_cameras(tmp_path, since)
    assert (later.state, later.remedy) == ("warning", "Run: carpus check-card: it has been calibrated since.")


@pytest.mark.usefixtures("qapp")
def test_check_card_command_prints_measures_and_saves(
    shown: list[Frame], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pdf = tmp_path / "card.pdf"
    assert main(["check-card", "--card", str(pdf)]) == 0
    assert len(re.findall(rb"/Type /Page\b", pdf.read_bytes())) == 2
    for k, share in enumerate((1.0, 1.02)):
        path = tmp_path / f"{k}.carpusraw"
        info = SourceInfo("Xtion", LENS, True, None, 2.0, {"serial": "77"}, recorded=check(k).checked_at)
        with RawWriter(path, info) as writer:
            for frame in scale_depth(shown, share):
                writer.append_frame(frame)
        capsys.readouterr()
        assert main(["check-card", str(path)]) == int(share != 1.0)
        said = capsys.readouterr()
        assert ("within tolerance" in said.out) == (share == 1.0)
        assert ("calibrate the camera" in said.err) == (share != 1.0)
    kept = read_checks(checks_path(load_settings().data_folder, "77"))
    assert [one.reading.has_valid_lengths for one in kept] == [True, False]
    assert main(["check-card", str(path)]) == 1, "still out"
    assert len(read_checks(checks_path(load_settings().data_folder, "77"))) == 2, "the same recording counts once"


def test_printing_and_measuring_at_once_is_wrong_usage(tmp_path: Path) -> None:
    assert main(["check-card", str(tmp_path), "--card", str(tmp_path / "c.pdf")]) == 2
