"""The calibration finds the simulated camera: its lens, its depth, and says when the pictures are not enough."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import cv2
import numpy as np
import pytest

from carpus.core.calibration.camera.board import (
    CHESSBOARD,
    MIN_VIEWS,
    PAGE_MARGIN_MM,
    WANTED_VIEWS,
    BoardView,
    ViewCollector,
    assess_views,
    create_board_sheet,
)
from carpus.core.calibration.camera.calibrate import CameraCalibration, calibrate_camera
from carpus.core.calibration.camera.printed_sheet import PAPER_MM, Paper, SheetBox, SheetLine, SheetText
from carpus.core.model.camera import DEFAULT_CAMERA
from carpus.core.model.errors import BoardNotVisible, BoardUnfit, BoardViewsTooSimilar, CarpusFault
from carpus.core.model.types import FloatArray, Frame
from tests.studio import LENS, Studio, build_held_sheet, render_texture


def check_lens(made: CameraCalibration, middle_px: float) -> None:
    camera = made.intrinsics.camera
    assert camera.fx_px == pytest.approx(LENS.fx_px, rel=0.003)
    assert camera.fy_px == pytest.approx(LENS.fy_px, rel=0.003)
    assert camera.cx_px == pytest.approx(LENS.cx_px, abs=middle_px)
    assert camera.cy_px == pytest.approx(LENS.cy_px, abs=middle_px)
    # Everywhere in the picture, the bend of the lens included.
    u, v = np.meshgrid(np.linspace(20, 620, 9), np.linspace(20, 460, 7))
    pixel = np.stack((u.ravel(), v.ravel()), axis=-1)
    rays = [lens.backproject(lens.undistort(pixel), np.ones(len(pixel))) for lens in (camera, LENS)]
    turned = np.linalg.lstsq(rays[0], rays[1], rcond=None)[0]  # the whole camera turned is no fault of the lens
    assert np.abs(rays[0] @ turned - rays[1]).max() * LENS.fx_px < 1.0


def test_solve_intrinsics_is_within_three_permille(made: CameraCalibration) -> None:
    check_lens(made, middle_px=0.003 * 640)
    assert made.intrinsics.reprojection_error_px < 0.3
    assert abs(made.intrinsics.camera.fx_px - LENS.fx_px) < 4.0 * made.intrinsics.focal_sd_px


def test_check_depth_finds_registration_error_and_offset(made: CameraCalibration, gathered: ViewCollector) -> None:
    def moved(view: BoardView) -> BoardView:
        assert view.depth_raw is not None
        depth = np.roll(view.depth_raw, 3, axis=1)
        far = np.where(depth > 0, depth + round(0.006 / view.depth_unit_m), 0).astype(np.uint16)
        return replace(view, depth_raw=far)

    before = made.depth
    after = calibrate_camera([moved(view) for view in gathered.views], DEFAULT_CAMERA, "studio").depth
    assert before is not None
    assert after is not None
    np.testing.assert_allclose(after.registration_error_px - before.registration_error_px, [-3.0, 0.0], atol=0.5)
    assert not after.is_registered
    assert after.offset_m == pytest.approx(0.006, abs=0.0025)


def shift_corners(view: BoardView, pixel: FloatArray) -> BoardView:
    return replace(view, detected=replace(view.detected, pixel=pixel))


def bend_board(view: BoardView) -> BoardView:
    pixel = view.detected.pixel
    return shift_corners(view, pixel + 8.0 * np.sin(np.arange(len(pixel)) * 2.1)[:, None] * [1.0, -1.0])


UNFIT: dict[str, tuple[Callable[[list[BoardView]], list[BoardView]], type[CarpusFault], str | None]] = {
    "no board": (lambda _: [], BoardNotVisible, None),
    "too few": (lambda views: views[: MIN_VIEWS - 1], BoardViewsTooSimilar, f"{MIN_VIEWS} needed"),
    "not tilted": (lambda views: [replace(view, nearer_side=None) for view in views], BoardViewsTooSimilar, "tilted"),
    "one corner": (
        lambda views: [shift_corners(view, view.detected.pixel * 0.4) for view in views],
        BoardViewsTooSimilar,
        "fields",
    ),
    "bent": (lambda views: [bend_board(view) for view in views], BoardUnfit, None),
}


@pytest.mark.parametrize("case", UNFIT)
def test_solve_intrinsics_insufficient_views_are_refused(case: str, gathered: ViewCollector) -> None:
    change, fault, said = UNFIT[case]
    with pytest.raises(fault, match=said):
        calibrate_camera(change(gathered.views), DEFAULT_CAMERA, "studio")


def test_view_collector_rejected_frame_has_a_reason(shown: list[Frame]) -> None:
    def look(*frames: Frame) -> list[str]:
        gathering = ViewCollector(DEFAULT_CAMERA)
        out = []
        for k, frame in enumerate(frames):
            told = gathering.process_frame(replace(frame, timestamp_s=0.2 * k))
            assert told is not None
            out.append(told.reject_reason)
        return out

    def with_color(frame: Frame, color: np.ndarray) -> Frame:
        return replace(frame, color_rgb=np.ascontiguousarray(color))

    blurred = with_color(shown[0], cv2.blur(shown[0].color_rgb, (9, 1)))
    dark = with_color(shown[0], shown[0].color_rgb // 8)
    assert look(shown[0], shown[0], shown[1]) == ["", "known", "moving"]
    assert look(blurred) == ["blurred"]
    assert look(with_color(dark, np.zeros_like(dark.color_rgb))) == ["dark"]


def test_next_instruction_names_what_is_missing(gathered: ViewCollector) -> None:
    whole = gathered.coverage
    assert assess_views([], 640, 480).next_instruction() == "Move the board to the top left"
    for change, instruction in (
        ({"sides": frozenset({"top", "bottom"})}, "Tilt the board: left edge nearer"),
        ({"nearest_m": 0.5, "farthest_m": 0.5}, "Move the board further away"),
        ({"nearest_m": 0.8, "farthest_m": 0.8}, "Move the board nearer"),
        ({"view_count": WANTED_VIEWS - 1}, "Show the board in other positions and at other tilts"),
        ({"view_count": WANTED_VIEWS}, None),
    ):
        assert replace(whole, **change).next_instruction() == instruction  # type: ignore[arg-type]


def test_board_view_nearer_side_is_right(studio: Studio) -> None:
    texture = render_texture(create_board_sheet(CHESSBOARD, "a4"))
    placed = build_held_sheet(texture, (0.0, 0.0, 0.55), 30.0, 90.0, 0.0)
    gathering = ViewCollector(DEFAULT_CAMERA)
    assert gathering.add(studio.frame([placed], 0, 0.0))
    left, right = (placed.rotation[2] @ [x, 0.1, 0.0] + placed.shift_m[2] for x in (0.0, 0.29))
    assert gathering.views[0].nearer_side == ("left" if left < right else "right")
    assert gathering.views[0].tilt_deg == pytest.approx(30.0, abs=2.0)


@pytest.mark.parametrize("paper", PAPER_MM)
def test_board_sheet_fits_the_paper_with_margin(paper: Paper) -> None:
    sheet = create_board_sheet(CHESSBOARD, paper)
    boxes = [mark for mark in sheet.items if isinstance(mark, SheetBox)]
    foot_mm = max(box.top_mm + box.height_mm for box in boxes)
    assert min(box.left_mm for box in boxes) >= PAGE_MARGIN_MM
    assert min(box.top_mm for box in boxes) >= PAGE_MARGIN_MM
    assert max(box.left_mm + box.width_mm for box in boxes) <= sheet.width_mm - PAGE_MARGIN_MM
    for mark in sheet.items:  # ruler and words: beside the board, not on it, and where every printer prints
        if isinstance(mark, SheetLine):
            (left, top), (right, bottom) = mark.from_mm, mark.to_mm
        elif isinstance(mark, SheetText):
            em_mm = mark.size_pt * 0.3528
            left, right = mark.x_mm, mark.x_mm + 0.6 * em_mm * len(mark.text)
            top, bottom = mark.y_mm - 0.75 * em_mm, mark.y_mm + 0.25 * em_mm
        else:
            continue
        assert foot_mm + 1.0 < top <= bottom <= sheet.height_mm - PAGE_MARGIN_MM
        assert PAGE_MARGIN_MM <= left <= right <= sheet.width_mm - PAGE_MARGIN_MM
