"""A calibration and checks as the screens of the camera show them: simulated pictures, figures made up."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np

from carpus.core.calibration.camera.board import CHESSBOARD, board_sheet
from carpus.core.calibration.camera.calibrate import CameraCalibration, DepthCheck, Intrinsics
from carpus.core.calibration.camera.effect import CELLS, Effect
from carpus.core.calibration.camera.views import FIELDS, Gathering, Judgement, next_step, target_outline
from carpus.core.calibration.card.card import FIGURES, CardReading
from carpus.core.calibration.card.checks import CardCheck, CheckStatus
from carpus.core.calibration.card.measure import CardWatch
from carpus.core.camera import DEFAULT_CAMERA
from carpus.core.simulation.practice_camera import LENS, Studio, card_scene, poses, texture_of
from carpus.core.types import Frame
from carpus.ui.words.camera_calibration import BoardProgress, BoardResult
from carpus.ui.words.camera_check import CardProgress
from tests.ui.fakes import NOW


@cache
def board_progress() -> tuple[Frame, BoardProgress]:
    """Five pictures of the board, the newest with what follows."""
    studio, gathering = Studio(seed=2), Gathering(DEFAULT_CAMERA, [CHESSBOARD])
    placed = poses(texture_of(board_sheet(CHESSBOARD, "a4")))[2:4]
    frames = [studio.frame([one], k, float(k)) for k, one in enumerate(placed)]
    looks = [gathering.look(frame) for frame in frames]
    look, judgement = looks[-1], gathering.judgement
    step = next_step(judgement, look.found)
    target = target_outline(step, CHESSBOARD, DEFAULT_CAMERA)
    return frames[-1], BoardProgress(look, judgement, step, target, CHESSBOARD.corner_count, 30, frames[-1])


def board_result(*, poor: bool = False) -> BoardResult:
    """A camera whose depth read too short; with ``poor`` pictures of a bent board."""
    rng = np.random.default_rng(3)
    off = rng.normal(0.0, 0.12 if not poor else 0.5, (CELLS[1], CELLS[0], 2))
    off[0, :2] = np.nan
    corners = np.full((FIELDS[1], FIELDS[0]), 80)
    corners[0, 0] = 0
    error = 0.84 if poor else 0.21
    found = Intrinsics(LENS, 0.5, 0.6, error, np.zeros((20, 3)), np.zeros((20, 3)), tuple(range(20)))
    depth = DepthCheck(0.996, 0.001, 0.0006, 0.0003, np.array([0.9, 0.6]), 0.1, 0.0011, 20)
    judged = Judgement(20, corners, frozenset(("left", "right", "top", "bottom")), 0.47, 0.84)
    made = CameraCalibration(DEFAULT_CAMERA, found, depth, judged, CHESSBOARD.name())
    return BoardResult(made, Effect(off, 0.92, 10.4, 0.2, -0.8), "Xtion PRO LIVE", "1210130114", "18 Apr 2026")


def checked(*, out: bool = False) -> CheckStatus:
    """A camera that was checked today; with ``out`` its depth is 2.6 % off since."""
    scale = 1.026 if out else 1.0
    measured = np.array([one.true * (scale if one.kind == "length" else 1.0) + 0.3 for one in FIGURES])
    reading = CardReading(measured, np.full(6, 0.2), scale, 0.6, 30, 30)
    return CheckStatus("1210130114", 31.0, 0.1, CardCheck(NOW.isoformat(), "1210130114", reading))


@cache
def card_progress() -> tuple[Frame, CardProgress]:
    """The card under the simulated camera, some seconds in."""
    frame = Studio(seed=2, depth_scale_error=0.0).frame(card_scene(), 0, 0.0)
    look = CardWatch(LENS, steady=True).look(frame)
    return replace(frame), CardProgress(look.pixel, look.blue, 8.4)
