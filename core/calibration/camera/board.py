"""The printed boards: a chessboard, and a ChArUco board that may be partly out of the picture."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Literal

import cv2
import numpy as np

from carpus.core.calibration.camera.sheet import PAPER_MM, Mark, Paper, PrintedSheet, SheetBox, SheetText, ruler
from carpus.core.phrase import phrase
from carpus.core.types import FloatArray

Pattern = Literal["chessboard", "charuco"]
_DICTIONARY = cv2.aruco.DICT_4X4_50
EDGE_MM = 12.0
"""Nothing is printed nearer to the edge of the paper: many printers leave it white, and hands hold it there."""
_CODE_CELLS = 6
"""Cells of a code along one side, its black border included."""


@dataclass(frozen=True, slots=True)
class Board:
    """``columns`` x ``rows`` squares of ``square_m``; ``code_m`` the side of a code in a white square of a ChArUco
    board."""

    pattern: Pattern
    columns: int
    rows: int
    square_m: float
    code_m: float = 0.0

    @property
    def corner_count(self) -> int:
        """Inner corners."""
        return (self.columns - 1) * (self.rows - 1)

    @property
    def corners_m(self) -> FloatArray:
        """All inner corners (C, 3) in the board's plane, row by row; x along a row, y down, z = 0."""
        x, y = np.meshgrid(np.arange(1, self.columns), np.arange(1, self.rows))
        flat = np.stack((x.ravel(), y.ravel(), np.zeros(x.size)), axis=-1)
        return np.asarray(flat * self.square_m, dtype=np.float64)

    @property
    def outline_m(self) -> FloatArray:
        """Corners (4, 3) of all squares together."""
        w, h = self.columns * self.square_m, self.rows * self.square_m
        return np.array([[0.0, 0.0, 0.0], [w, 0.0, 0.0], [w, h, 0.0], [0.0, h, 0.0]])

    def name(self) -> str:
        """As in a table."""
        facts = {"columns": self.columns, "rows": self.rows, "size": f"{self.square_m * 1e3:g}"}
        if self.pattern == "chessboard":
            return phrase("chessboard {columns} x {rows}, squares of {size} mm", **facts)
        return phrase("ChArUco board {columns} x {rows}, squares of {size} mm", **facts)


CHESSBOARD = Board("chessboard", 10, 7, 0.025)
CHARUCO = Board("charuco", 7, 5, 0.035, 0.027)
BOARDS: dict[Pattern, Board] = {"chessboard": CHESSBOARD, "charuco": CHARUCO}
"""Both fit A4 and Letter with a white border, so that one size serves everywhere."""


@cache
def charuco_board(board: Board) -> cv2.aruco.CharucoBoard:
    """OpenCV's description of a ChArUco board."""
    codes = cv2.aruco.getPredefinedDictionary(_DICTIONARY)
    return cv2.aruco.CharucoBoard((board.columns, board.rows), board.square_m, board.code_m, codes)


def board_sheet(board: Board, paper: Paper) -> PrintedSheet:
    """The board on a sheet that lies on its side, with a ruler under it."""
    height_mm, width_mm = PAPER_MM[paper]
    marks = board_marks(board, *_placed(board, width_mm, height_mm))
    square = f"{board.square_m * 1e3:g} mm"
    said = SheetText(
        phrase(
            "Carpus camera board: {name}. Glue it flat on a stiff board. Squares: {square}.",
            name=board.name(),
            square=square,
        ),
        25.0,
        height_mm - EDGE_MM - 0.8,
        8.0,
    )
    return PrintedSheet(width_mm, height_mm, (*marks, *ruler(25.0, height_mm - EDGE_MM - 8.5), said))


def _placed(board: Board, width_mm: float, height_mm: float) -> tuple[float, float]:
    left = 0.5 * (width_mm - board.columns * board.square_m * 1e3)
    return left, EDGE_MM + 0.3 * (height_mm - PAPER_MM["a4"][0])


def board_marks(board: Board, left_mm: float, top_mm: float) -> tuple[Mark, ...]:
    """Black squares, and the codes in the white ones, with the first square's corner at a place."""
    side = board.square_m * 1e3
    black = [
        SheetBox(left_mm + side * column, top_mm + side * row, side, side)
        for row in range(board.rows)
        for column in range(board.columns)
        if (row + column) % 2 == 0
    ]
    return (*black, *_codes(board, left_mm, top_mm)) if board.pattern == "charuco" else tuple(black)


def _codes(board: Board, left_mm: float, top_mm: float) -> list[SheetBox]:
    described = charuco_board(board)
    codes = described.getDictionary()
    out = []
    cell = board.code_m * 1e3 / _CODE_CELLS
    for number, corners in zip(np.ravel(np.asarray(described.getIds())), described.getObjPoints(), strict=True):
        x, y = left_mm + float(corners[0][0]) * 1e3, top_mm + float(corners[0][1]) * 1e3
        picture = cv2.aruco.generateImageMarker(codes, int(number), _CODE_CELLS)
        for row, line in enumerate(np.asarray(picture) == 0):
            # neighbours as one box: between two a viewer may show a hair of white
            edges = np.flatnonzero(np.diff(np.concatenate(([0], line.astype(np.int8), [0]))))
            for start, end in edges.reshape(-1, 2):
                out.append(SheetBox(x + cell * float(start), y + cell * row, cell * float(end - start), cell))
    return out
