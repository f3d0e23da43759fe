"""Which pictures of the board are worth keeping, and whether together they are enough."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import cv2
import numpy as np

from carpus.core.calibration.camera.board import Board
from carpus.core.calibration.camera.find_board import FoundBoard
from carpus.core.camera import Camera
from carpus.core.types import DepthImage, FloatArray

FEWEST_VIEWS = 12
FIELDS = (6, 4)
"""The picture's fields across and down."""
FEWEST_FIELDS = 18
LEAST_TILT_DEG = 15.0
"""A board less tilted than this is as good as straight."""
MOST_TILT_DEG = 60.0
FEWEST_SIDES = 3
NEAR_FAR_RATIO = 1.4
"""Farthest over nearest board below which a shift of depth cannot be told from its scale."""
NEW_PX = 18.0
"""A picture in which the corners have moved less than this since a kept one says nothing new."""
MOST_MOTION_PX = 1.0
"""From one camera picture to the next, at 30 a second: more blurs the corners."""

Side = Literal["left", "right", "top", "bottom"]
SIDES: tuple[Side, ...] = ("left", "right", "top", "bottom")


@dataclass(frozen=True, slots=True)
class BoardView:
    """One kept picture. ``tilt_deg`` of the board off the straight view and the ``nearer`` side where it is tilted;
    ``distance_m`` of its middle; the depth picture that belongs to it, None without one."""

    found: FoundBoard
    tilt_deg: float
    nearer: Side | None
    distance_m: float
    depth_raw: DepthImage | None = None
    depth_unit_m: float = 1e-3


@dataclass(frozen=True, slots=True)
class Judgement:
    """What is there: number of views, corners in each field (down, across), sides the board was tilted to."""

    views: int
    corners_in_field: np.ndarray
    sides: frozenset[Side]
    nearest_m: float
    farthest_m: float

    @property
    def fields(self) -> int:
        """Fields of the picture in which a corner has been."""
        return int(np.count_nonzero(self.corners_in_field))

    @property
    def is_near_and_far(self) -> bool:
        """Whether a shift of the depth can be told from its scale."""
        return self.farthest_m >= NEAR_FAR_RATIO * self.nearest_m

    @property
    def missing(self) -> str:
        """The first thing that is missing, as a person would say it; empty when nothing is."""
        if self.views < FEWEST_VIEWS:
            return f"{self.views} different pictures of the board, {FEWEST_VIEWS} needed"
        if self.fields < FEWEST_FIELDS:
            return f"board in {self.fields} of {math.prod(FIELDS)} fields of the picture, {FEWEST_FIELDS} needed"
        if len(self.sides) < FEWEST_SIDES:
            tilted = " and ".join(side for side in SIDES if side in self.sides) or "none"
            return f"tilted by {LEAST_TILT_DEG:g}° with these sides nearer: {tilted}; {FEWEST_SIDES} sides needed"
        return ""

    @property
    def next_step(self) -> str:
        """What to do next with the board in the hand; empty when all is there."""
        if not self.missing:
            return ""
        if len(self.sides) < FEWEST_SIDES and self.views >= FEWEST_VIEWS // 2:
            side = next(side for side in SIDES if side not in self.sides)
            return f"Tilt the board: {side} edge nearer to the camera."
        empty = np.argwhere(self.corners_in_field == 0)
        if len(empty) and self.fields < FEWEST_FIELDS:
            down, across = empty[0]
            vertical = ("top", "upper part", "lower part", "bottom")[int(down)]
            horizontal = "left" if across < FIELDS[0] // 3 else "right" if across >= 2 * FIELDS[0] // 3 else "middle"
            return f"Move the board to the {vertical}, {horizontal}."
        return "Move the board to another place, tilt it another way, nearer or farther."


def view_of(found: FoundBoard, camera: Camera, depth_raw: DepthImage | None, depth_unit_m: float) -> BoardView | None:
    """What a picture shows; ``camera`` may be a rough guess. None where the board cannot stand like that."""
    points = found.board.corners_m[found.corner]
    there, turn, shift = cv2.solvePnP(points, camera.undistort(found.pixel), camera.matrix, np.zeros(5))
    if not there:
        return None
    rotation = np.asarray(cv2.Rodrigues(turn)[0], dtype=np.float64)
    normal = rotation[:, 2] if rotation[2, 2] > 0.0 else -rotation[:, 2]
    centre = rotation @ found.board.outline_m.mean(axis=0) + shift.ravel()
    if centre[2] <= 0.0:
        return None
    away = centre / np.linalg.norm(centre)
    tilt_deg = math.degrees(math.acos(float(np.clip(normal @ away, -1.0, 1.0))))
    if tilt_deg > MOST_TILT_DEG:
        return None
    lean = normal - (normal @ away) * away
    return BoardView(found, tilt_deg, _nearer(lean) if tilt_deg >= LEAST_TILT_DEG else None, float(centre[2]),
                depth_raw, depth_unit_m)  # fmt: skip


def _nearer(lean: FloatArray) -> Side:
    """The side that is nearer, of the part of the normal, away from the camera, across the line of sight."""
    # Away from the camera the normal leans towards the far side's opposite: a plane with n_x > 0 is nearer at +x.
    if abs(lean[0]) >= abs(lean[1]):
        return "right" if lean[0] > 0.0 else "left"
    return "bottom" if lean[1] > 0.0 else "top"


def is_new(found: FoundBoard, kept: Sequence[BoardView]) -> bool:
    """Whether the board stands elsewhere or otherwise than in every kept picture."""
    return all(moved_px(found, view.found) >= NEW_PX for view in kept)


def moved_px(one: FoundBoard, other: FoundBoard) -> float:
    """How far the corners seen in both lie apart (root mean square); infinite where there is none."""
    _, a, b = np.intersect1d(one.corner, other.corner, return_indices=True)
    if not len(a):
        return math.inf
    return float(np.sqrt(np.mean(np.sum((one.pixel[a] - other.pixel[b]) ** 2, axis=1))))


def judge(views: Sequence[BoardView], width_px: int, height_px: int) -> Judgement:
    """Whether these pictures are enough, and different enough."""
    count = np.zeros((FIELDS[1], FIELDS[0]), dtype=np.int64)
    for view in views:
        across = np.clip(view.found.pixel[:, 0] * FIELDS[0] / width_px, 0, FIELDS[0] - 1).astype(int)
        down = np.clip(view.found.pixel[:, 1] * FIELDS[1] / height_px, 0, FIELDS[1] - 1).astype(int)
        np.add.at(count, (down, across), 1)
    sides = frozenset(view.nearer for view in views if view.nearer is not None)
    distances = [view.distance_m for view in views]
    return Judgement(len(views), count, sides, min(distances, default=math.nan), max(distances, default=math.nan))


def board_of(views: Sequence[BoardView]) -> Board:
    """The board of all views."""
    return views[0].found.board
