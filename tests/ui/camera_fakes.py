"""A calibration and checks as the screens of the camera show them: simulated pictures, figures made up."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np

from carpus.core.calibration.camera.board import CHESSBOARD, FIELDS, ViewCollector, ViewCoverage, create_board_sheet
from carpus.core.calibration.camera.calibrate import CameraCalibration, DepthCheck, Intrinsics
from carpus.core.calibration.card.card import DIMENSIONS, CardReading
from carpus.core.calibration.card.checks import CardCheck, CheckStatus
from carpus.core.calibration.card.measure import CardMeasurement
from carpus.core.model.camera import DEFAULT_CAMERA
from carpus.core.model.types import Frame
from carpus.ui.words.camera_calibration import BoardProgress, BoardResult
from carpus.ui.words.camera_check import CardProgress
from tests.studio import LENS, Studio, card_scene, poses, render_texture
from tests.ui.fakes import NOW


@cache
def board_progress() -> tuple[Frame, BoardProgress]:
    """Two pictures of the board, the newest with what follows."""
    studio, gathering = Studio(seed=2), ViewCollector(DEFAULT_CAMERA)
    placed = poses(render_texture(create_board_sheet(CHESSBOARD, "a4")))[2:4]
    frames = [studio.frame([one], k, float(k)) for k, one in enumerate(placed)]
    look = [gathering.process_frame(frame) for frame in frames][-1]
    return frames[-1], BoardProgress(
        look.reject_reason, gathering.coverage, gathering.coverage.next_instruction() or ""
    )


def board_result() -> BoardResult:
    """A camera whose depth read too short."""
    corners = np.full((FIELDS[1], FIELDS[0]), 80)
    found = Intrinsics(LENS, 0.5, 0.6, 0.21, np.zeros((20, 3)), np.zeros((20, 3)), tuple(range(20)))
    depth = DepthCheck(0.996, 0.001, 0.0006, 0.0003, np.array([0.9, 0.6]), 0.1, 20)
    judged = ViewCoverage(20, corners, frozenset(("left", "right", "top", "bottom")), 0.47, 0.84)
    return BoardResult(CameraCalibration(DEFAULT_CAMERA, found, depth, judged, CHESSBOARD.name()), "1210130114")


def checked(*, out: bool = False) -> CheckStatus:
    """A camera that was checked today; with ``out`` its depth is 2.6 % off since."""
    scale = 1.026 if out else 1.0
    measured = np.array([one.true_value * (scale if one.kind == "length" else 1.0) + 0.3 for one in DIMENSIONS])
    reading = CardReading(measured, np.full(6, 0.2), scale, 0.6, 30)
    return CheckStatus("1210130114", 31.0, 0.1, CardCheck(NOW.isoformat(), "1210130114", reading))


@cache
def card_progress() -> tuple[Frame, CardProgress]:
    """The card under the simulated camera, some seconds in."""
    frame = Studio(seed=2, depth_scale_error=0.0).frame(card_scene(), 0, 0.0)
    look = CardMeasurement(LENS, only_steady=True).process_frame(frame)
    return replace(frame), CardProgress(look.pixel, look.blue_count, 8.4)
