"""The printed chessboard: corners and edge widths in a frame, selection and coverage of its views, next instruction."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import cv2
import numpy as np

from carpus.core.calibration.camera.printed_sheet import PAPER_MM, Paper, PrintedSheet, SheetBox, SheetText, ruler_items
from carpus.core.model.camera import Camera
from carpus.core.model.phrase import Phrase, phrase
from carpus.core.model.types import ByteImage, DepthImage, FloatArray, Frame

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


MIN_VIEWS = 12
FIELDS = (6, 4)
"""Fields of the image across and down."""
MIN_FIELDS = 18
MIN_TILT_DEG = 15.0
"""A board with less tilt is as good as frontal."""
MAX_TILT_DEG = 60.0
MIN_TILT_SIDES = 3
MIN_DISTANCE_RATIO = 1.4
"""Farthest over nearest board below which depth offset and scale cannot be separated."""
MIN_NEW_VIEW_PX = 18.0
"""A view whose corners moved less since another one adds nothing."""
MAX_MOTION_PX = 1.0
"""From one camera frame to the next at 30 fps: more blurs the corners."""

TiltSide = Literal["left", "right", "top", "bottom"]
TILT_SIDES: tuple[TiltSide, ...] = ("left", "right", "top", "bottom")


@dataclass(frozen=True, slots=True)
class BoardView:
    """One view: the board's tilt off frontal, the nearer side if tilted, and the depth image."""

    detected: DetectedBoard
    tilt_deg: float
    nearer_side: TiltSide | None
    distance_m: float
    depth_raw: DepthImage | None = None
    depth_unit_m: float = 1e-3


@dataclass(frozen=True, slots=True)
class ViewCoverage:
    """Coverage of the views: corners in each field (down, across), tilted sides, distances."""

    view_count: int
    corners_in_field: np.ndarray
    sides: frozenset[TiltSide]
    nearest_m: float
    farthest_m: float

    @property
    def field_count(self) -> int:
        """Number of fields with a corner."""
        return int(np.count_nonzero(self.corners_in_field))

    @property
    def is_near_and_far(self) -> bool:
        """True if depth offset and scale can be separated."""
        return self.farthest_m >= MIN_DISTANCE_RATIO * self.nearest_m

    @property
    def missing_view_count(self) -> int:
        """Number of views that are still wanted from a live camera."""
        return max(WANTED_VIEWS - self.view_count, 0)

    @property
    def missing_text(self) -> str:
        """First thing that is missing, empty if nothing is."""
        if self.view_count < MIN_VIEWS:
            return f"{self.view_count} different pictures of the board, {MIN_VIEWS} needed"
        if self.field_count < MIN_FIELDS:
            return f"board in {self.field_count} of {math.prod(FIELDS)} fields of the picture, {MIN_FIELDS} needed"
        if len(self.sides) < MIN_TILT_SIDES:
            tilted = " and ".join(side for side in TILT_SIDES if side in self.sides) or "none"
            return f"tilted by {MIN_TILT_DEG:g}° with these sides nearer: {tilted}; {MIN_TILT_SIDES} sides needed"
        return ""

    def next_instruction(self) -> Phrase | None:
        """Return what to do next with the board until there are enough views, else None."""
        empty = np.argwhere(self.corners_in_field == 0)
        if len(empty) and self.field_count < MIN_FIELDS:
            return phrase("Move the board to the {place}", place=_place_name(*empty[0].tolist()))
        if len(self.sides) < MIN_TILT_SIDES:
            side = next(side for side in TILT_SIDES if side not in self.sides)
            return phrase("Tilt the board: {side} nearer", side=side_name(side))
        if not self.is_near_and_far:
            near = self.nearest_m <= NEAR_BOARD_M or self.nearest_m * MIN_DISTANCE_RATIO < FAR_BOARD_M
            return phrase("Move the board further away") if near else phrase("Move the board nearer")
        return phrase("Show the board in other positions and at other tilts") if self.missing_view_count else None


def side_name(side: TiltSide) -> Phrase:
    """Return the edge of the board as a person holds it."""
    return {
        "left": phrase("left edge"), "right": phrase("right edge"), "top": phrase("upper edge"),
        "bottom": phrase("lower edge"),
    }[side]  # fmt: skip


def _place_name(down: int, across: int) -> Phrase:
    """Return the name of a field's place in the image."""
    columns = {(True, False): 0, (False, True): 2}
    column = columns.get((across < FIELDS[0] // 3, across >= FIELDS[0] - FIELDS[0] // 3), 1)
    row = columns.get((down == 0, down == FIELDS[1] - 1), 1)
    return (
        (phrase("top left"), phrase("top"), phrase("top right")),
        (phrase("left"), phrase("centre"), phrase("right")),
        (phrase("bottom left"), phrase("bottom"), phrase("bottom right")),
    )[row][column]


def to_board_view(
    detected: DetectedBoard, camera: Camera, depth_raw: DepthImage | None, depth_unit_m: float
) -> BoardView | None:
    """Return the view of a detected board; ``camera`` may be a guess. None for an impossible pose."""
    points, pixel = detected.board.corners_m, camera.undistort(detected.pixel)
    is_solved, rotation_vector, translation = cv2.solvePnP(points, pixel, camera.matrix, np.zeros(5))
    if not is_solved:
        return None
    rotation = np.asarray(cv2.Rodrigues(rotation_vector)[0], dtype=np.float64)
    normal = rotation[:, 2] if rotation[2, 2] > 0.0 else -rotation[:, 2]
    centre = rotation @ detected.board.outline_m.mean(axis=0) + np.ravel(translation)
    if centre[2] <= 0.0:
        return None
    away = centre / np.linalg.norm(centre)
    tilt_deg = math.degrees(math.acos(float(np.clip(normal @ away, -1.0, 1.0))))
    if tilt_deg > MAX_TILT_DEG:
        return None
    lean = normal - (normal @ away) * away
    # Away from the camera the normal leans opposite to the far side: a plane with n_x > 0 is nearer at +x.
    across: TiltSide = "right" if lean[0] > 0.0 else "left"
    down: TiltSide = "bottom" if lean[1] > 0.0 else "top"
    nearer_side: TiltSide | None = across if abs(lean[0]) >= abs(lean[1]) else down
    if tilt_deg < MIN_TILT_DEG:
        nearer_side = None
    return BoardView(detected, tilt_deg, nearer_side, float(centre[2]), depth_raw, depth_unit_m)


def corner_motion_px(one: DetectedBoard, other: DetectedBoard) -> float:
    """Return the RMS distance of the corners."""
    return float(np.sqrt(np.mean(np.sum((one.pixel - other.pixel) ** 2, axis=1))))


def assess_views(views: Sequence[BoardView], width_px: int, height_px: int) -> ViewCoverage:
    """Return the coverage of the views."""
    count = np.zeros((FIELDS[1], FIELDS[0]), dtype=np.int64)
    for view in views:
        across = np.clip(view.detected.pixel[:, 0] * FIELDS[0] / width_px, 0, FIELDS[0] - 1).astype(int)
        down = np.clip(view.detected.pixel[:, 1] * FIELDS[1] / height_px, 0, FIELDS[1] - 1).astype(int)
        np.add.at(count, (down, across), 1)
    sides = frozenset(view.nearer_side for view in views if view.nearer_side is not None)
    distances = [view.distance_m for view in views]
    return ViewCoverage(len(views), count, sides, min(distances, default=math.nan), max(distances, default=math.nan))


RejectReason = Literal["", "dark", "no_board", "too_tilted", "moving", "blurred", "known"]
"""Reason why a view was not kept, empty if it was."""
MIN_BRIGHTNESS = 70.0
"""The brightest tenth of an image below this needs more light."""
WANTED_VIEWS = 30
"""Views wanted from a live camera: more than needed, as each takes three seconds and the focal length is then known to
0.1 %."""
NEAR_BOARD_M, FAR_BOARD_M = 0.55, 0.85
"""A board nearer than the first is shown farther away next, and one near the second not."""


@dataclass(frozen=True, slots=True)
class BoardFrame:
    """Result of searching one frame for the board."""

    detected: DetectedBoard | None
    reject_reason: RejectReason


SEARCH_INTERVAL_S = 0.12
"""Detection takes a while, and successive frames show the same."""
_CAMERA_FPS = 30.0
_MAX_MOTION_GAP_S = 0.4
MAX_VIEWS = 64


class ViewCollector:
    """Collects still and new views of the board; ``camera`` is a guess for tilt and distance.

    A view is kept if the board's pose is new and it has not moved since the frame before, if there is one just before.
    """

    def __init__(self, camera: Camera, board: Board = CHESSBOARD) -> None:
        self._camera, self._board = camera, board
        self.views: list[BoardView] = []
        self._last: tuple[float, DetectedBoard] | None = None
        self._last_search_s = float("-inf")

    @property
    def coverage(self) -> ViewCoverage:
        return assess_views(self.views, self._camera.width_px, self._camera.height_px)

    def add(self, frame: Frame) -> bool:
        """Process a frame and return whether its view was kept."""
        result = self.process_frame(frame)
        return result is not None and not result.reject_reason

    def process_frame(self, frame: Frame) -> BoardFrame | None:
        """Search a frame for the board; None if it comes too soon after the last one."""
        if frame.timestamp_s - self._last_search_s < SEARCH_INTERVAL_S or len(self.views) >= MAX_VIEWS:
            return None
        self._last_search_s = frame.timestamp_s
        found = find_board(frame.color_rgb, self._board)
        before, self._last = self._last, None if found is None else (frame.timestamp_s, found)
        if found is None:
            brightness = float(np.percentile(frame.color_rgb[::8, ::8].max(axis=2), 90))
            return BoardFrame(None, "dark" if brightness < MIN_BRIGHTNESS else "no_board")
        view = to_board_view(found, self._camera, frame.depth_raw, frame.depth_unit_m)
        if view is None:
            return BoardFrame(found, "too_tilted")
        is_new = all(corner_motion_px(found, kept.detected) >= MIN_NEW_VIEW_PX for kept in self.views)
        reason: RejectReason = "" if is_new else "known"
        if edge_width_px(frame.color_rgb, found) > MAX_EDGE_WIDTH_PX:
            reason = "blurred"
        if before is not None and frame.timestamp_s - before[0] <= _MAX_MOTION_GAP_S:
            camera_frames = (frame.timestamp_s - before[0]) * _CAMERA_FPS
            if corner_motion_px(found, before[1]) / camera_frames > MAX_MOTION_PX:
                reason = "moving"
        if not reason:
            self.views.append(view)
        return BoardFrame(found, reason)
