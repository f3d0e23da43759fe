"""The printed chessboard, and the detection of its corners and edge widths."""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np

from carpus.core.calibration.camera.printed_sheet import PAPER_MM, Paper, PrintedSheet, SheetBox, SheetText, ruler_items
from carpus.core.model.phrase import phrase
from carpus.core.model.types import ByteImage, FloatArray

PAGE_MARGIN_MM = 12.0
"""Many printers leave this margin white, and hands hold the paper there."""


@dataclass(frozen=True, slots=True)
class Board:
    """Chessboard of ``columns`` x ``rows`` squares."""

    columns: int
    rows: int
    square_m: float

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
        size = f"{self.square_m * 1e3:g}"
        return phrase(
            "chessboard {columns} x {rows}, squares of {size} mm", columns=self.columns, rows=self.rows, size=size
        )


CHESSBOARD = Board(10, 7, 0.025)
"""It fits A4 and Letter with a white border."""


def create_board_sheet(board: Board, paper: Paper) -> PrintedSheet:
    """Place the board on a landscape sheet with a ruler."""
    height_mm, width_mm = PAPER_MM[paper]
    side_mm = board.square_m * 1e3
    left_mm = 0.5 * (width_mm - board.columns * side_mm)
    top_mm = PAGE_MARGIN_MM + 0.3 * (height_mm - PAPER_MM["a4"][0])
    black = [
        SheetBox(left_mm + side_mm * column, top_mm + side_mm * row, side_mm, side_mm)
        for row in range(board.rows)
        for column in range(board.columns)
        if (row + column) % 2 == 0
    ]
    facts = {"name": board.name(), "square": f"{side_mm:g} mm"}
    words = phrase("Carpus camera board: {name}. Glue it flat on a stiff board. Squares: {square}.", **facts)
    bottom_mm = height_mm - PAGE_MARGIN_MM
    text = SheetText(words, 25.0, bottom_mm - 0.8, 8.0)
    return PrintedSheet(width_mm, height_mm, (*black, *ruler_items(25.0, bottom_mm - 8.5), text))


_MAX_WINDOW_SHARE = 0.35
"""Half window of the corner refinement over the corner distance: the next corner stays outside."""


@dataclass(frozen=True, slots=True)
class DetectedBoard:
    """Board and the pixels (C, 2) of its inner corners."""

    board: Board
    pixel: FloatArray

    @property
    def grid_px(self) -> FloatArray:
        """Pixels (rows, columns, 2) of the inner corners."""
        return self.pixel.reshape(self.board.rows - 1, self.board.columns - 1, 2)


def find_board(color_rgb: ByteImage, board: Board) -> DetectedBoard | None:
    """Return the board if all of it is detected, with its corners to a fraction of a pixel."""
    gray = np.asarray(cv2.cvtColor(color_rgb, cv2.COLOR_RGB2GRAY), dtype=np.uint8)
    flags = cv2.CALIB_CB_ADAPTIVE_THRESH | cv2.CALIB_CB_NORMALIZE_IMAGE | cv2.CALIB_CB_FAST_CHECK
    is_found, pixel = cv2.findChessboardCorners(gray, (board.columns - 1, board.rows - 1), flags=flags)
    if not is_found:
        return None
    rough = np.asarray(pixel, dtype=np.float32).reshape(-1, 1, 2)
    grid = rough.reshape(board.rows - 1, board.columns - 1, 2)
    steps = (np.linalg.norm(np.diff(grid, axis=axis), axis=-1).min() for axis in (0, 1))
    half_px = int(np.clip(_MAX_WINDOW_SHARE * min(steps), 2, 7))
    criteria = (cv2.TERM_CRITERIA_EPS | cv2.TERM_CRITERIA_MAX_ITER, 40, 1e-3)
    fine = cv2.cornerSubPix(gray, rough, (half_px, half_px), (-1, -1), criteria)
    return DetectedBoard(board, np.asarray(fine, dtype=np.float64).reshape(-1, 2))


MAX_EDGE_WIDTH_PX = 5.0
"""A moving or blurred board has wider edges; at rest in good light they are about 3.5 wide."""
_EDGE_WINDOW_SHARE, _EDGE_WINDOW_PX = 0.3, (2, 6)
"""Half window around an edge over the corner distance, with its limits."""
_MIN_CONTRAST = 20.0


def edge_width_px(color_rgb: ByteImage, detected: DetectedBoard) -> float:
    """Measure the width of the edges, contrast over steepest slope; NaN if unknown.

    Half-way between two neighbouring corners there is an edge and nothing else. Edges along rows and along columns are
    needed: a lateral blur shows on upright ones only.
    """
    gray = np.asarray(cv2.cvtColor(color_rgb, cv2.COLOR_RGB2GRAY), dtype=np.float32)
    smooth = cv2.GaussianBlur(gray, (3, 3), 0.0)
    steep = np.hypot(cv2.Sobel(smooth, cv2.CV_32F, 1, 0, scale=0.125), cv2.Sobel(smooth, cv2.CV_32F, 0, 1, scale=0.125))
    medians = []
    for one, other in (
        (detected.grid_px[:, :-1], detected.grid_px[:, 1:]),
        (detected.grid_px[:-1], detected.grid_px[1:]),
    ):
        widths = []
        steps = np.linalg.norm(other - one, axis=-1).ravel()
        for (u, v), step in zip((0.5 * (one + other)).reshape(-1, 2), steps, strict=True):
            half = int(np.clip(_EDGE_WINDOW_SHARE * step, *_EDGE_WINDOW_PX))
            box = (slice(round(v) - half, round(v) + half + 1), slice(round(u) - half, round(u) + half + 1))
            if min(box[0].start, box[1].start) < 0 or smooth[box].shape != (2 * half + 1, 2 * half + 1):
                continue
            contrast = float(np.ptp(smooth[box]))
            if contrast >= _MIN_CONTRAST:
                widths.append(contrast / max(float(steep[box].max()), 1e-6))
        medians.append(float(np.median(widths)) if widths else math.nan)
    return max(medians) if not any(map(math.isnan, medians)) else math.nan
