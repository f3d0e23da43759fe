"""The board's corners in one picture."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

import cv2
import numpy as np

from carpus.core.calibration.camera.board import Board, charuco_board
from carpus.core.types import ByteImage, FloatArray

LEAST_CORNERS = 8
"""Of a ChArUco board that is partly out of the picture."""
_CODE_WINDOW_PX = 3
"""Half the window of the fine search beside codes: a larger one would reach them."""
_SHARPEST_SHARE = 0.35
"""Half the window of the fine search over the distance between corners: more would reach the next corner."""


@dataclass(frozen=True, slots=True)
class FoundBoard:
    """``corner`` (K,) numbers of the board's corners and ``pixel`` (K, 2) where they are."""

    board: Board
    corner: np.ndarray
    pixel: FloatArray


def find_board(color_rgb: ByteImage, boards: Sequence[Board]) -> FoundBoard | None:
    """The first of ``boards`` that is seen, None where none is."""
    gray = np.asarray(cv2.cvtColor(color_rgb, cv2.COLOR_RGB2GRAY), dtype=np.uint8)
    for board in boards:
        found = _charuco(gray, board) if board.pattern == "charuco" else _chessboard(gray, board)
        if found is not None:
            return found
    return None


def _chessboard(gray: ByteImage, board: Board) -> FoundBoard | None:
    size = (board.columns - 1, board.rows - 1)
    flags = cv2.CALIB_CB_ADAPTIVE_THRESH | cv2.CALIB_CB_NORMALIZE_IMAGE | cv2.CALIB_CB_FAST_CHECK
    there, pixel = cv2.findChessboardCorners(gray, size, flags=flags)
    if not there:
        return None
    grid = np.asarray(pixel, dtype=np.float32).reshape(size[1], size[0], 2)
    steps = (np.linalg.norm(np.diff(grid, axis=axis), axis=-1).min() for axis in (0, 1))
    half = int(np.clip(_SHARPEST_SHARE * min(steps), 2, 7))
    return FoundBoard(board, np.arange(board.corner_count), _fine(gray, grid.reshape(-1, 1, 2), half))


def _fine(gray: ByteImage, rough: np.ndarray, half_px: int) -> FloatArray:
    """Corners (K, 2) to a fraction of a pixel."""
    criteria = (cv2.TERM_CRITERIA_EPS | cv2.TERM_CRITERIA_MAX_ITER, 40, 1e-3)
    fine = cv2.cornerSubPix(gray, rough, (half_px, half_px), (-1, -1), criteria)
    return np.asarray(fine, dtype=np.float64).reshape(-1, 2)


def _charuco(gray: ByteImage, board: Board) -> FoundBoard | None:
    # A cell of a code has three or four pixels: twice enlarged, twice as many codes are read.
    large = cv2.resize(gray, None, fx=2, fy=2, interpolation=cv2.INTER_LANCZOS4)
    pixel, corner, _, _ = _detector(board).detectBoard(large)
    if corner is None or len(corner) < LEAST_CORNERS:  # type: ignore[redundant-expr]  # OpenCV gives None
        return None
    numbers = np.asarray(corner).ravel().astype(np.int64)
    rough = (np.asarray(pixel, dtype=np.float32).reshape(-1, 1, 2) + 0.5) / 2.0 - 0.5
    return FoundBoard(board, numbers, _fine(gray, rough.astype(np.float32), _CODE_WINDOW_PX))


@cache
def _detector(board: Board) -> cv2.aruco.CharucoDetector:
    parameters = cv2.aruco.DetectorParameters()
    parameters.perspectiveRemovePixelPerCell = 8
    parameters.perspectiveRemoveIgnoredMarginPerCell = 0.33  # blurred cells speak in their middle
    return cv2.aruco.CharucoDetector(charuco_board(board), cv2.aruco.CharucoParameters(), parameters)
