"""Picks the pictures of the board out of a recording or a live camera, one frame at a time."""

from __future__ import annotations

from collections.abc import Sequence

from carpus.core.camera import Camera
from carpus.core.camera_calibration.board import BOARDS, Board
from carpus.core.camera_calibration.find_board import FoundBoard, find_board
from carpus.core.camera_calibration.views import MOST_MOTION_PX, Judgement, View, is_new, judge, moved_px, view_of
from carpus.core.types import Frame

LOOK_EVERY_S = 0.12
"""Finding the board takes a while, and two pictures in a row show the same."""
_CAMERA_FPS = 30.0
_JUST_BEFORE_S = 0.4
MOST_VIEWS = 40


class Gathering:
    """Keeps the still and new pictures of the board.

    ``camera`` is a rough guess for tilt and distance. A picture is kept when the board stands elsewhere than in every
    kept one and has not moved since the picture before; without one just before nobody knows, and it is kept.
    """

    def __init__(self, camera: Camera, boards: Sequence[Board] = tuple(BOARDS.values())) -> None:
        self._camera, self._boards = camera, tuple(boards)
        self._views: list[View] = []
        self._last: tuple[float, FoundBoard] | None = None
        self._looked_s = float("-inf")
        self.looked, self.seen = 0, 0

    @property
    def views(self) -> Sequence[View]:
        """What was kept."""
        return self._views

    @property
    def judgement(self) -> Judgement:
        """Whether it is enough."""
        return judge(self._views, self._camera.width_px, self._camera.height_px)

    def add(self, frame: Frame) -> bool:
        """Look at a frame; whether it was kept."""
        if frame.timestamp_s - self._looked_s < LOOK_EVERY_S or len(self._views) >= MOST_VIEWS:
            return False
        self._looked_s = frame.timestamp_s
        self.looked += 1
        found = find_board(frame.color_rgb, self._boards)
        before, self._last = self._last, None if found is None else (frame.timestamp_s, found)
        if found is None:
            return False
        self.seen += 1
        self._boards = (found.board,)  # one board per calibration, and no time lost on the others
        if not _is_still(found, frame.timestamp_s, before) or not is_new(found, self._views):
            return False
        view = view_of(found, self._camera, frame.depth_raw, frame.depth_unit_m)
        if view is not None:
            self._views.append(view)
        return view is not None


def _is_still(found: FoundBoard, now_s: float, before: tuple[float, FoundBoard] | None) -> bool:
    if before is None or now_s - before[0] > _JUST_BEFORE_S:
        return True
    return moved_px(found, before[1]) <= MOST_MOTION_PX * (now_s - before[0]) * _CAMERA_FPS
