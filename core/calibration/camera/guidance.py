"""What to do with the board in the hand: what this picture lacks, and where to hold the board next."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import cv2
import numpy as np

from carpus.core.calibration.camera.board import Board, Pattern
from carpus.core.calibration.camera.find_board import FoundBoard
from carpus.core.calibration.camera.views import (
    FEWEST_FIELDS,
    FEWEST_SIDES,
    FIELDS,
    NEAR_FAR_RATIO,
    SIDES,
    Judgement,
    Side,
)
from carpus.core.camera import Camera
from carpus.core.types import ByteImage, FloatArray

Lack = Literal["", "dark", "no_board", "too_tilted", "moving", "blurred", "known"]
"""Why a picture was not kept; empty when it was, or when nothing is wrong."""
DARK = 70.0
"""The brightest tenth of a picture below this: more light."""
ASKED_VIEWS: dict[Pattern, int] = {"chessboard": 30, "charuco": 44}
"""So many are asked for before a live camera: more than must be, since each costs a person three seconds, and with them
the focal length is known to 0.1 %. A ChArUco board has half the corners."""
WORKING_M, NEAR_M, FAR_M = 0.6, 0.48, 0.85
"""Where the board is best held: usually, near and far."""
ASKED_TILT_DEG = 36.0
_MARGIN_PX = 14.0


@dataclass(frozen=True, slots=True)
class Look:
    """What one picture shows of the board. ``edge_px`` width of its edges, ``motion_px`` from one picture of the
    camera to the next, ``tilt_deg`` and ``distance_m``: NaN where not known. ``kept``: this picture counts."""

    found: FoundBoard | None
    lack: Lack
    edge_px: float = math.nan
    motion_px: float = math.nan
    tilt_deg: float = math.nan
    distance_m: float = math.nan
    kept: bool = False


@dataclass(frozen=True, slots=True)
class GuidanceStep:
    """What to do next: hold the board at a ``field`` (down, across) of the picture, tilt it with a ``side`` nearer, go
    ``near`` or ``far``; ``done`` when all is there."""

    kind: Literal["place", "tilt", "near", "far", "done"]
    field: tuple[int, int] | None = None
    side: Side | None = None


def is_dark(color_rgb: ByteImage) -> bool:
    """Whether a picture has too little light to find a board in it."""
    return float(np.percentile(color_rgb[::8, ::8].max(axis=2), 90)) < DARK


def next_step(
    judgement: Judgement,
    last: FoundBoard | None = None,
    size_px: tuple[int, int] = (640, 480),
    asked: int = ASKED_VIEWS["chessboard"],
) -> GuidanceStep:
    """Whole area first, then the tilts, then near and far, then ``asked`` pictures in all; near places come first."""
    empty, side = np.argwhere(judgement.corners_in_field == 0), _missing_side(judgement)
    if judgement.fields < FEWEST_FIELDS:
        return GuidanceStep("place", _nearest(empty, last, size_px), side)
    if len(judgement.sides) < FEWEST_SIDES:
        return GuidanceStep("tilt", side=side)
    if not judgement.is_near_and_far:
        near = judgement.nearest_m <= 1.15 * NEAR_M or judgement.nearest_m * NEAR_FAR_RATIO < FAR_M
        return GuidanceStep("far" if near else "near")
    if judgement.views >= asked:
        return GuidanceStep("done")
    thin = empty if len(empty) else np.argwhere(judgement.corners_in_field == judgement.corners_in_field.min())
    # In a place where it has been before, the board must at least be tilted another way to say something new.
    return GuidanceStep("place", _nearest(thin, last, size_px), side or SIDES[judgement.views % len(SIDES)])


def _nearest(fields: np.ndarray, last: FoundBoard | None, size_px: tuple[int, int]) -> tuple[int, int]:
    """The field (down, across) of these that is nearest to where the board is."""
    here = _field_of(last, size_px)
    down, across = min(fields.tolist(), key=lambda one: (math.hypot(one[0] - here[0], one[1] - here[1]), one))
    return int(down), int(across)


def _field_of(found: FoundBoard | None, size_px: tuple[int, int]) -> tuple[float, float]:
    """Where the board is among the fields; the middle where it is not seen."""
    if found is None:
        return (0.5 * (FIELDS[1] - 1), 0.5 * (FIELDS[0] - 1))
    u, v = found.pixel.mean(axis=0)
    return (float(v) * FIELDS[1] / size_px[1] - 0.5, float(u) * FIELDS[0] / size_px[0] - 0.5)


def _missing_side(judgement: Judgement) -> Side | None:
    return next((side for side in SIDES if side not in judgement.sides), None)


def target_outline(step: GuidanceStep, board: Board, camera: Camera) -> FloatArray | None:
    """Corners (4, 2) in the picture of the board as the step wants it held, all of it in the picture; None for none."""
    if step.kind == "done":
        return None
    away_m = {"near": NEAR_M, "far": FAR_M}.get(step.kind, WORKING_M)
    rotation = _tilted(step.side) if step.kind in ("place", "tilt") else np.eye(3)
    flat = board.outline_m - board.outline_m.mean(axis=0)
    middle = np.array([0.5 * camera.width_px, 0.5 * camera.height_px])
    if step.field is not None:
        down, across = step.field
        middle = np.array([(across + 0.5) * camera.width_px / FIELDS[0], (down + 0.5) * camera.height_px / FIELDS[1]])
    pixel = camera.project(flat @ rotation.T + camera.back_project(middle, np.asarray(away_m)))
    for _ in range(3):  # moved until all of it is in the picture; perspective changes its size only a little
        low, high = pixel.min(axis=0), pixel.max(axis=0)
        size = np.array([camera.width_px, camera.height_px], dtype=np.float64)
        middle = middle + np.maximum(_MARGIN_PX - low, 0.0) - np.maximum(high - size + _MARGIN_PX, 0.0)
        pixel = camera.project(flat @ rotation.T + camera.back_project(middle, np.asarray(away_m)))
    return np.asarray(pixel)


def _tilted(side: Side | None) -> FloatArray:
    """Rotation (3, 3) of a board whose ``side`` is nearer."""
    angle = math.radians(ASKED_TILT_DEG)
    turn = {"left": (0.0, -angle, 0.0), "right": (0.0, angle, 0.0), "top": (angle, 0.0, 0.0),
            "bottom": (-angle, 0.0, 0.0)}.get(side or "", (0.0, 0.0, 0.0))  # fmt: skip
    return np.asarray(cv2.Rodrigues(np.array(turn))[0], dtype=np.float64)
