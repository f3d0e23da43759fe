"""Picks the pictures of the board out of a recording or a live camera, one frame at a time."""

from __future__ import annotations

import math
from collections.abc import Sequence

from carpus.core.calibration.camera.board import BOARDS, MOST_EDGE_PX, Board, FoundBoard, edge_px, find_board
from carpus.core.calibration.camera.views import (
    MOST_MOTION_PX,
    BoardView,
    Judgement,
    Lack,
    Look,
    is_dark,
    is_new,
    judge,
    moved_px,
    view_of,
)
from carpus.core.camera import Camera
from carpus.core.types import Frame

LOOK_EVERY_S = 0.12
"""Finding the board takes a while, and two pictures in a row show the same."""
_CAMERA_FPS = 30.0
_JUST_BEFORE_S = 0.4
MOST_VIEWS = 64


class Gathering:
    """Keeps the still and new pictures of the board.

    ``camera`` is a rough guess for tilt and distance. A picture is kept when the board stands elsewhere than in every
    kept one and has not moved since the picture before; without one just before nobody knows, and it is kept.
    """

    def __init__(self, camera: Camera, boards: Sequence[Board] = tuple(BOARDS.values())) -> None:
        self._camera, self._boards = camera, tuple(boards)
        self._views: list[BoardView] = []
        self._last: tuple[float, FoundBoard] | None = None
        self._looked_s = float("-inf")
        self.looked, self.seen = 0, 0
        self._by_hand, self._undone = False, 0

    @property
    def views(self) -> Sequence[BoardView]:
        """What was kept."""
        return self._views

    @property
    def judgement(self) -> Judgement:
        """Whether it is enough."""
        return judge(self._views, self._camera.width_px, self._camera.height_px)

    def add(self, frame: Frame) -> bool:
        """Look at a frame; whether it was kept."""
        look = self.look(frame)
        return look is not None and look.kept

    def look(self, frame: Frame) -> Look | None:
        """Look at a frame and say what it lacks; None where it comes too soon after the last one."""
        self._obey()
        if frame.timestamp_s - self._looked_s < LOOK_EVERY_S or len(self._views) >= MOST_VIEWS:
            return None
        self._looked_s = frame.timestamp_s
        self.looked += 1
        found = find_board(frame.color_rgb, self._boards)
        before, self._last = self._last, None if found is None else (frame.timestamp_s, found)
        if found is None:
            return Look(None, "dark" if is_dark(frame.color_rgb) else "no_board")
        self.seen += 1
        self._boards = (found.board,)  # one board per calibration, and no time lost on the others
        view = view_of(found, self._camera, frame.depth_raw, frame.depth_unit_m)
        if view is None:
            return Look(found, "too_tilted")
        edge, motion = edge_px(frame.color_rgb, found), _motion_px(found, frame.timestamp_s, before)
        lack: Lack = "blurred" if edge > MOST_EDGE_PX else "" if is_new(found, self._views) else "known"
        lack = "moving" if motion > MOST_MOTION_PX else lack
        kept = not lack or (self._by_hand and lack != "known")
        if kept:
            self._views.append(view)
            self._by_hand, lack = False, ""
        return Look(found, lack, edge, motion, view.tilt_deg, view.distance_m, kept)

    def take(self) -> None:
        """Keep the next picture of the board even if it moves or is blurred; may be called from another thread."""
        self._by_hand = True

    def undo(self) -> None:
        """Leave out the picture that was kept last; may be called from another thread, and counts at the next look."""
        self._undone += 1

    def _obey(self) -> None:
        while self._undone:
            self._undone -= 1
            del self._views[-1:]


def _motion_px(found: FoundBoard, now_s: float, before: tuple[float, FoundBoard] | None) -> float:
    """How far the corners move from one picture of the camera to the next; NaN where nobody knows."""
    if before is None or now_s - before[0] > _JUST_BEFORE_S:
        return math.nan
    return moved_px(found, before[1]) / ((now_s - before[0]) * _CAMERA_FPS)
