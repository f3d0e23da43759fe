"""Values and texts of the camera calibration: progress, result and storage."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from carpus.core.calibration.camera.board import (
    CHESSBOARD,
    FIELDS,
    MIN_FIELDS,
    MIN_TILT_SIDES,
    TILT_SIDES,
    Board,
    RejectReason,
    ViewCoverage,
    side_name,
)
from carpus.core.calibration.camera.calibrate import (
    FAIR_ERROR_PX,
    GOOD_ERROR_PX,
    MAX_REGISTRATION_ERROR_PX,
    CameraCalibration,
    DepthCheck,
)
from carpus.core.calibration.camera.printed_sheet import RULER_MM, Paper
from carpus.core.model.rounding import format_rounded
from carpus.ui.kit import numbers
from carpus.ui.kit.icons import State
from carpus.ui.kit.translate import tr, translate_phrase


def view_fault_words(lack: RejectReason) -> str:
    """Say what an image of the board lacks; empty if nothing."""
    return {
        "": "",
        "dark": tr("The image is too dark: add light."),
        "no_board": tr("The board is not visible: show the whole board, flat, in even light."),
        "too_tilted": tr("Tilt the board less: the camera sees it almost edge-on."),
        "moving": tr("Hold still."),
        "blurred": tr("The image is blurred: hold the board still, or add light."),
        "known": tr("Image taken. Move the board to another position."),
    }[lack]


def progress_rows(judgement: ViewCoverage) -> list[tuple[State, str]]:
    """Return state and text of places, tilts and distances."""
    missing = [side for side in TILT_SIDES if side not in judgement.sides]
    places = tr("Positions: {count} of {all} fields ({least} needed)").format(
        count=judgement.field_count, all=FIELDS[0] * FIELDS[1], least=MIN_FIELDS
    )
    tilts = (
        tr("Tilts: {side} missing").format(side=translate_phrase(side_name(missing[0])))
        if missing
        else tr("Tilts: all sides")
    )
    away = tr("Distance: near and far missing")
    if judgement.is_near_and_far:
        near, far = (format_rounded(100 * one) for one in (judgement.nearest_m, judgement.farthest_m))
        away = tr("Distance: {near}–{far} cm").format(near=near, far=far)
    reached = (
        judgement.field_count >= MIN_FIELDS,
        len(judgement.sides) >= MIN_TILT_SIDES,
        judgement.is_near_and_far,
    )
    return [("good" if one else "partly", words) for one, words in zip(reached, (places, tilts, away), strict=True)]


def button_words(progress: BoardProgress | None) -> str:
    """Return the text of the primary button: what it does, or what it waits for."""
    if progress is None:
        return tr("Calculate · show the board")
    left = progress.judgement.missing_view_count
    if left > 0:
        one = tr("Calculate · 1 more image") if left == 1 else tr("Calculate · {count} more images")
        return one.format(count=left)
    return tr("Calculate · more positions and tilts") if progress.judgement.missing_text else tr("Calculate")


def headline(calibration: CameraCalibration) -> tuple[str, str]:
    """Return the result in a sentence, and what it means."""
    error_px = calibration.intrinsics.reprojection_error_px
    if error_px > FAIR_ERROR_PX:
        return (
            tr("Not good enough: reprojection error {error} px.").format(error=numbers.format_fixed(error_px, 1)),
            tr("Nothing was changed. Glue the board onto something flat and stiff. Take the images again "
               "in good light."),
        )  # fmt: skip
    if calibration.depth is not None and not calibration.depth.is_registered:
        return (
            tr("Depth and colour are misaligned by {apart} px.").format(apart=_offset_px(calibration.depth)),
            tr("Nothing was changed. Turn on depth registration in the camera settings."),
        )
    return (
        tr("The camera is calibrated. {depth}").format(depth=depth_words(calibration.depth)),
        tr("The reprojection error is {error} pixels.").format(error=numbers.format_fixed(error_px, 2)),
    )


def depth_words(depth: DepthCheck | None) -> str:
    """Say by how much depth was wrong."""
    if depth is None:
        return tr("Depth was not checked.")
    share, shift = 100.0 * (depth.scale - 1.0), 1e3 * depth.offset_m
    if abs(share) < 0.05 and abs(shift) < 0.5:
        return tr("Depth is correct.")
    pattern = tr("Depth was {share} % too large.") if share > 0 else tr("Depth was {share} % too small.")
    return pattern.format(share=numbers.format_fixed(abs(share), 1))


def _offset_px(depth: DepthCheck) -> str:
    return numbers.format_fixed(float(np.hypot(*depth.registration_error_px)), 1)


def result_rows(calibration: CameraCalibration) -> list[tuple[State, str, str, str]]:
    """Return state, quantity, value and comment of each result."""
    error_px, depth = calibration.intrinsics.reprojection_error_px, calibration.depth
    good, fair = (numbers.format_fixed(limit, 1) for limit in (GOOD_ERROR_PX, FAIR_ERROR_PX))
    lands = (
        tr("good: below {limit} px").format(limit=good) if error_px <= GOOD_ERROR_PX
        else tr("fair: below {limit} px").format(limit=fair) if error_px <= FAIR_ERROR_PX
        else tr("poor: above {limit} px").format(limit=fair)
    )  # fmt: skip
    focal_px, focal_sd_px = calibration.intrinsics.camera.fx_px, calibration.intrinsics.focal_sd_px
    focal = f"{numbers.format_fixed(focal_px, 1)} ± {numbers.format_fixed(focal_sd_px, 1)} px"
    rows: list[tuple[State, str, str, str]] = [
        (
            "good" if error_px <= FAIR_ERROR_PX else "bad",
            tr("Reprojection error"),
            f"{numbers.format_fixed(error_px, 2)} px",
            lands,
        ),
        (
            "good",
            tr("Focal length"),
            focal,
            tr("{px} px before").format(px=numbers.format_fixed(calibration.previous_camera.fx_px, 1)),
        ),
    ]
    if depth is None:
        return [*rows, ("warn", tr("Depth"), numbers.UNKNOWN, tr("too few images with depth values of the board"))]
    scale = f"{numbers.format_signed(100 * (depth.scale - 1.0), 2)} ± {numbers.format_fixed(100 * depth.scale_sd, 2)} %"
    registered = tr("good: below {most} px").format(most=format_rounded(MAX_REGISTRATION_ERROR_PX))
    return [
        *rows,
        ("good", tr("Depth scale"), scale, tr("corrected") if calibration.is_usable else ""),
        (
            "good" if depth.is_registered else "bad",
            tr("Depth–colour alignment"),
            tr("{apart} px apart").format(apart=_offset_px(depth)),
            registered if depth.is_registered else tr("depth registration is off"),
        ),
    ]


def storage_words(result: BoardResult) -> str:
    """Say where the calibration will be stored; empty if it is unusable."""
    if not result.calibration.is_usable:
        return ""
    if not result.serial:
        return tr(
            "This camera reports no serial number, so its calibration cannot be saved here. IT support can write it "
            "to a camera file with “carpus calibrate-camera --output” and enter that file in the settings."
        )
    words = tr("Saved for the camera with serial number {serial}. Values of earlier sessions do not change.")
    return words.format(serial=result.serial)


@dataclass(frozen=True, slots=True)
class BoardChoice:
    """Paper of a board, and its measured ruler."""

    paper: Paper = "a4"
    ruler_mm: float = RULER_MM

    @property
    def board(self) -> Board:
        return replace(CHESSBOARD, square_m=CHESSBOARD.square_m * self.ruler_mm / RULER_MM)


@dataclass(frozen=True, slots=True)
class BoardProgress:
    """Fault of the newest image, progress so far, and the next step (empty when complete)."""

    lack: RejectReason
    judgement: ViewCoverage
    step: str


@dataclass(frozen=True, slots=True)
class BoardResult:
    """Calibration before it is saved; ``serial`` is empty for a camera without one."""

    calibration: CameraCalibration
    serial: str

    @property
    def is_usable(self) -> bool:
        return self.calibration.is_usable and bool(self.serial)
