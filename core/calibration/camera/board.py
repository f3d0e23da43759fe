"""Printed boards (chessboard, ChArUco) and the detection of their corners and edge widths."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from typing import Literal

import cv2
import numpy as np

from carpus.core.calibration.camera.printed_sheet import (
    PAPER_MM,
    Paper,
    PrintedSheet,
    SheetBox,
    SheetItem,
    SheetText,
    ruler_items,
)
from carpus.core.model.phrase import phrase
from carpus.core.model.types import ByteImage, FloatArray

Pattern = Literal["chessboard", "charuco"]
_DICTIONARY = cv2.aruco.DICT_4X4_50
PAGE_MARGIN_MM = 12.0
"""Many printers leave this margin white, and hands hold the paper there."""
_CODE_CELLS = 6
"""Cells of a code along one side, with its black border."""


@dataclass(frozen=True, slots=True)
class Board:
    """Board of ``columns`` x ``rows`` squares; ``code_m`` is the side of a ChArUco code."""

    pattern: Pattern
    columns: int
    rows: int
    square_m: float
    code_m: float = 0.0

    @property
    def corner_count(self) -> int:
        return (self.columns - 1) * (self.rows - 1)

    @property
    def corners_m(self) -> FloatArray:
        """Inner corners (C, 3) in the board's plane, row by row; x along a row, y down, z = 0."""
        x, y = np.meshgrid(np.arange(1, self.columns), np.arange(1, self.rows))
        flat = np.stack((x.ravel(), y.ravel(), np.zeros(x.size)), axis=-1)
        return np.asarray(flat * self.square_m, dtype=np.float64)

    @property
    def outline_m(self) -> FloatArray:
        """Corners (4, 3) of the whole board."""
        w, h = self.columns * self.square_m, self.rows * self.square_m
        return np.array([[0.0, 0.0, 0.0], [w, 0.0, 0.0], [w, h, 0.0], [0.0, h, 0.0]])

    def name(self) -> str:
        facts = {"columns": self.columns, "rows": self.rows, "size": f"{self.square_m * 1e3:g}"}
        if self.pattern == "chessboard":
            return phrase("chessboard {columns} x {rows}, squares of {size} mm", **facts)
        return phrase("ChArUco board {columns} x {rows}, squares of {size} mm", **facts)


CHESSBOARD = Board("chessboard", 10, 7, 0.025)
CHARUCO = Board("charuco", 7, 5, 0.035, 0.027)
BOARDS: dict[Pattern, Board] = {"chessboard": CHESSBOARD, "charuco": CHARUCO}
"""Both fit A4 and Letter with a white border."""


@cache
def charuco_board(board: Board) -> cv2.aruco.CharucoBoard:
    """Return OpenCV's description of a ChArUco board."""
    codes = cv2.aruco.getPredefinedDictionary(_DICTIONARY)
    return cv2.aruco.CharucoBoard((board.columns, board.rows), board.square_m, board.code_m, codes)


def create_board_sheet(board: Board, paper: Paper) -> PrintedSheet:
    """Place the board on a landscape sheet with a ruler."""
    height_mm, width_mm = PAPER_MM[paper]
    left_mm = 0.5 * (width_mm - board.columns * board.square_m * 1e3)
    items = board_items(board, left_mm, PAGE_MARGIN_MM + 0.3 * (height_mm - PAPER_MM["a4"][0]))
    facts = {"name": board.name(), "square": f"{board.square_m * 1e3:g} mm"}
    words = phrase("Carpus camera board: {name}. Glue it flat on a stiff board. Squares: {square}.", **facts)
    bottom_mm = height_mm - PAGE_MARGIN_MM
    text = SheetText(words, 25.0, bottom_mm - 0.8, 8.0)
    return PrintedSheet(width_mm, height_mm, (*items, *ruler_items(25.0, bottom_mm - 8.5), text))


def board_items(board: Board, left_mm: float, top_mm: float) -> tuple[SheetItem, ...]:
    """Return black squares and codes, with the first square's corner at a place."""
    side = board.square_m * 1e3
    black = [
        SheetBox(left_mm + side * column, top_mm + side * row, side, side)
        for row in range(board.rows)
        for column in range(board.columns)
        if (row + column) % 2 == 0
    ]
    return (*black, *_code_boxes(board, left_mm, top_mm)) if board.pattern == "charuco" else tuple(black)


def _code_boxes(board: Board, left_mm: float, top_mm: float) -> list[SheetBox]:
    charuco = charuco_board(board)
    codes = charuco.getDictionary()
    out = []
    cell = board.code_m * 1e3 / _CODE_CELLS
    for number, corners in zip(np.ravel(np.asarray(charuco.getIds())), charuco.getObjPoints(), strict=True):
        x, y = left_mm + float(corners[0][0]) * 1e3, top_mm + float(corners[0][1]) * 1e3
        image = cv2.aruco.generateImageMarker(codes, int(number), _CODE_CELLS)
        for row, line in enumerate(np.asarray(image) == 0):
            # neighbouring cells as one box: viewers may show a white hairline between two
            edges = np.flatnonzero(np.diff(np.concatenate(([0], line.astype(np.int8), [0]))))
            for start, end in edges.reshape(-1, 2):
                out.append(SheetBox(x + cell * float(start), y + cell * row, cell * float(end - start), cell))
    return out


MIN_CORNERS = 8
"""Of a ChArUco board that is partly outside the image."""
_CODE_WINDOW_PX = 3
"""Half window of the corner refinement beside codes: a larger one would reach them."""
_MAX_WINDOW_SHARE = 0.35
"""Half window of the corner refinement over the corner distance: the next corner stays outside."""


@dataclass(frozen=True, slots=True)
class DetectedBoard:
    """Numbers (K,) of the detected corners and their pixels (K, 2)."""

    board: Board
    corner_ids: np.ndarray
    pixel: FloatArray


def find_board(color_rgb: ByteImage, boards: Sequence[Board]) -> DetectedBoard | None:
    """Return the first of the boards that is detected, None if there is none."""
    gray = np.asarray(cv2.cvtColor(color_rgb, cv2.COLOR_RGB2GRAY), dtype=np.uint8)
    for board in boards:
        found = _find_charuco(gray, board) if board.pattern == "charuco" else _find_chessboard(gray, board)
        if found is not None:
            return found
    return None


def _find_chessboard(gray: ByteImage, board: Board) -> DetectedBoard | None:
    size = (board.columns - 1, board.rows - 1)
    flags = cv2.CALIB_CB_ADAPTIVE_THRESH | cv2.CALIB_CB_NORMALIZE_IMAGE | cv2.CALIB_CB_FAST_CHECK
    is_found, pixel = cv2.findChessboardCorners(gray, size, flags=flags)
    if not is_found:
        return None
    grid = np.asarray(pixel, dtype=np.float32).reshape(size[1], size[0], 2)
    steps = (np.linalg.norm(np.diff(grid, axis=axis), axis=-1).min() for axis in (0, 1))
    half = int(np.clip(_MAX_WINDOW_SHARE * min(steps), 2, 7))
    return DetectedBoard(board, np.arange(board.corner_count), _refine_corners(gray, grid.reshape(-1, 1, 2), half))


def _refine_corners(gray: ByteImage, rough: np.ndarray, half_px: int) -> FloatArray:
    """Refine corners (K, 2) to a fraction of a pixel."""
    criteria = (cv2.TERM_CRITERIA_EPS | cv2.TERM_CRITERIA_MAX_ITER, 40, 1e-3)
    fine = cv2.cornerSubPix(gray, rough, (half_px, half_px), (-1, -1), criteria)
    return np.asarray(fine, dtype=np.float64).reshape(-1, 2)


def _find_charuco(gray: ByteImage, board: Board) -> DetectedBoard | None:
    # A cell of a code has three or four pixels: enlarged twice, twice as many codes are read.
    large = cv2.resize(gray, None, fx=2, fy=2, interpolation=cv2.INTER_LANCZOS4)
    pixel, corner, _, _ = _charuco_detector(board).detectBoard(large)
    if corner is None or len(corner) < MIN_CORNERS:  # type: ignore[redundant-expr]  # OpenCV gives None
        return None
    numbers = np.asarray(corner).ravel().astype(np.int64)
    rough = (np.asarray(pixel, dtype=np.float32).reshape(-1, 1, 2) + 0.5) / 2.0 - 0.5
    return DetectedBoard(board, numbers, _refine_corners(gray, rough.astype(np.float32), _CODE_WINDOW_PX))


@cache
def _charuco_detector(board: Board) -> cv2.aruco.CharucoDetector:
    parameters = cv2.aruco.DetectorParameters()
    parameters.perspectiveRemovePixelPerCell = 8
    parameters.perspectiveRemoveIgnoredMarginPerCell = 0.33  # blurred cells are certain in their middle only
    return cv2.aruco.CharucoDetector(charuco_board(board), cv2.aruco.CharucoParameters(), parameters)


MAX_EDGE_WIDTH_PX = 5.0
"""A moving or blurred board has wider edges; at rest in good light they are about 3.5 wide."""
_EDGE_WINDOW_SHARE, _EDGE_WINDOW_PX = 0.3, (2, 6)
"""Half window around an edge over the corner distance, with its limits."""
_MIN_CONTRAST = 20.0


def edge_width_px(color_rgb: ByteImage, detected: DetectedBoard) -> float:
    """Measure the width of the edges, contrast over steepest slope; NaN if unknown.

    Half-way between two neighbouring corners there is an edge and nothing else.
    """
    gray = np.asarray(cv2.cvtColor(color_rgb, cv2.COLOR_RGB2GRAY), dtype=np.float32)
    smooth = cv2.GaussianBlur(gray, (3, 3), 0.0)
    steep = np.hypot(cv2.Sobel(smooth, cv2.CV_32F, 1, 0, scale=0.125), cv2.Sobel(smooth, cv2.CV_32F, 0, 1, scale=0.125))
    widths = [_median_edge_width_px(smooth, steep, *_edge_midpoints(detected, along)) for along in ("row", "column")]
    return max(widths) if not any(map(math.isnan, widths)) else math.nan


def _median_edge_width_px(smooth: np.ndarray, gradient: np.ndarray, midpoints: FloatArray, steps: FloatArray) -> float:
    """Return the median width of the edges at the midpoints."""
    widths = []
    for (u, v), step in zip(midpoints, steps, strict=True):
        half = int(np.clip(_EDGE_WINDOW_SHARE * step, *_EDGE_WINDOW_PX))
        box = (slice(round(v) - half, round(v) + half + 1), slice(round(u) - half, round(u) + half + 1))
        if min(box[0].start, box[1].start) < 0 or smooth[box].shape != (2 * half + 1, 2 * half + 1):
            continue
        contrast = float(np.ptp(smooth[box]))
        if contrast >= _MIN_CONTRAST:
            widths.append(contrast / max(float(gradient[box].max()), 1e-6))
    return float(np.median(widths)) if widths else math.nan


def _edge_midpoints(detected: DetectedBoard, along: Literal["row", "column"]) -> tuple[FloatArray, FloatArray]:
    """Return midpoints (E, 2) and distances (E,) of neighbouring corners of a row or column.

    Both are needed: a lateral blur shows on upright edges only.
    """
    across = detected.board.columns - 1
    place = {int(corner): pixel for corner, pixel in zip(detected.corner_ids, detected.pixel, strict=True)}
    step = 1 if along == "row" else across
    pairs = [
        (place[corner], place[corner + step])
        for corner in place
        if corner + step in place and (along == "column" or (corner + 1) % across)
    ]
    if not pairs:
        return np.empty((0, 2)), np.empty(0)
    one, other = np.array(pairs).transpose(1, 0, 2)
    return 0.5 * (one + other), np.asarray(np.linalg.norm(other - one, axis=1))
