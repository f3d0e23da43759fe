"""What the screen of the board is told, and what it asks for."""

from __future__ import annotations

from dataclasses import dataclass, replace

from carpus.core.calibration.camera.board import BOARDS, Board, Pattern
from carpus.core.calibration.camera.calibrate import CameraCalibration
from carpus.core.calibration.camera.effect import Effect
from carpus.core.calibration.camera.sheet import RULER_MM, Paper
from carpus.core.calibration.camera.views import GuidanceStep, Judgement, Look
from carpus.core.types import FloatArray, Frame


@dataclass(frozen=True, slots=True)
class BoardChoice:
    """Which board on which paper, how long its ruler was measured, and whether before the simulated camera."""

    pattern: Pattern = "chessboard"
    paper: Paper = "a4"
    ruler_mm: float = RULER_MM
    practice: bool = False

    @property
    def board(self) -> Board:
        board, share = BOARDS[self.pattern], self.ruler_mm / RULER_MM
        return replace(board, square_m=board.square_m * share, code_m=board.code_m * share)


@dataclass(frozen=True, slots=True)
class BoardProgress:
    """How far the showing of the board is: the newest ``look``, all that was kept, the next ``step``, and where the
    board is wanted (4, 2) in the picture, None for nowhere in particular; ``asked`` so many pictures. ``frame`` is the
    one that was looked at: its corners are drawn on it and on no other."""

    look: Look
    judgement: Judgement
    step: GuidanceStep
    target: FloatArray | None
    corner_count: int
    asked: int
    frame: Frame


@dataclass(frozen=True, slots=True)
class BoardResult:
    """A calibration before it is kept. ``camera`` and ``serial`` name it, ``serial`` empty where nobody knows which it
    is; ``since`` the day of the calibration used so far, empty for the maker's own values."""

    made: CameraCalibration
    effect: Effect
    camera: str
    serial: str
    since: str = ""
    simulated: bool = False
    may_use: bool = True
