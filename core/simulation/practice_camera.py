"""A simulated camera before which a board is shown, or a check card lies: to try both without a camera."""

from __future__ import annotations

import itertools
import math
import threading
from collections.abc import Iterator
from dataclasses import replace
from functools import cache

import cv2
import numpy as np

from carpus.core.calibration.camera.board import Board, Pattern, board_sheet
from carpus.core.calibration.card.card import (
    CARD_CORNER_MM,
    FOOT_CORNER_MM,
    SLOPE_DEG,
    SLOPE_MM,
    WEDGE_CORNER_MM,
    WIDTH_MM,
    card_sheet,
    wedge_sheet,
)
from carpus.core.camera import DEFAULT_CAMERA
from carpus.core.capture.calibrated import SERIAL
from carpus.core.capture.source import SourceInfo
from carpus.core.simulation.printed_sheets import LENS, PX_PER_MM, Placed, Studio, poses, texture_of
from carpus.core.types import SIMULATED, FloatArray, Frame


# The check card with its wedge before the simulator's camera.
def card_scene(distance_m: float = 0.6, tilt_deg: float = 4.0, turn_deg: float = 7.0) -> list[Placed]:
    """The flat sheet and both faces of the wedge, nearly straight under the camera."""
    card, wedge = texture_of(card_sheet("a4")), texture_of(wedge_sheet("a4"))
    tilt = np.asarray(cv2.Rodrigues(np.array([math.radians(tilt_deg), 0.0, 0.0]))[0])
    turn = np.asarray(cv2.Rodrigues(np.array([0.0, 0.0, math.radians(turn_deg)]))[0])
    # The sheet's x to the right, y down, z into the table: as the camera looks.
    rotation = np.asarray(tilt @ turn, dtype=np.float64)
    a_m = np.array([*CARD_CORNER_MM, 0.0]) / 1e3
    middle_m = a_m + np.array([0.04, 0.07, 0.0])
    shift = np.array([0.01, -0.005, distance_m]) - rotation @ middle_m
    low_edge_m = a_m + np.array([*FOOT_CORNER_MM, 0.0]) / 1e3
    left, top = (round(one * PX_PER_MM) for one in WEDGE_CORNER_MM)
    width, slope = (round(one * PX_PER_MM) for one in (WIDTH_MM, SLOPE_MM))
    faces = [
        (wedge[top : top + slope, left : left + width], SLOPE_DEG, low_edge_m),
        (wedge[top + slope : top + 2 * slope, left : left + width], -SLOPE_DEG, _ridge_m(low_edge_m)),
    ]
    out = [Placed(card, rotation, shift)]
    for texture, rise_deg, corner_m in faces:
        # Up, out of the sheet, is -z here: a face that rises along y turns about x by a negative angle.
        face = np.asarray(cv2.Rodrigues(np.array([-math.radians(rise_deg), 0.0, 0.0]))[0])
        turned = np.asarray(rotation @ face, dtype=np.float64)
        out.append(Placed(np.ascontiguousarray(texture), turned, rotation @ corner_m + shift))
    return out


def _ridge_m(low_edge_m: FloatArray) -> FloatArray:
    slope = math.radians(SLOPE_DEG)
    return low_edge_m + np.array([0.0, SLOPE_MM * math.cos(slope), -SLOPE_MM * math.sin(slope)]) / 1e3


PRACTICE_SERIAL = "practice"
NAME = "Simulated camera"
FPS = 5.0
_STILL_FRAMES = 8
"""The board is held so long in each place, after one picture on the way; it is drawn once for all of them."""
BOARD_DISTANCES_M: dict[Pattern, tuple[float, ...]] = {"chessboard": (0.5, 0.62, 0.8), "charuco": (0.42, 0.5, 0.62)}
DIFFERENT = 60
"""So many poses pass before place, distance and tilt come again together."""
_DEPTH_SCALE_ERROR, _SEED = 0.03, 21
_MOST_PICTURES = 24
"""Different pictures of the card; then they come again, as nothing moves."""


class PracticeCamera:
    """Frames without end, each some time after the one before, as a person holds still for as long as it takes;
    ``speed`` 2 waits half as long. Ends by :meth:`close`."""

    def __init__(self, pictures: Iterator[Frame], speed: float = 1.0) -> None:
        settings = {SERIAL: PRACTICE_SERIAL, SIMULATED: "yes"}
        self.info = SourceInfo(NAME, DEFAULT_CAMERA, True, None, FPS, settings)
        self._pictures = pictures
        self._pause_s = 1.0 / (FPS * speed)
        self._closed = threading.Event()

    def frames(self) -> Iterator[Frame]:
        """Frames until :meth:`close`."""
        for frame in self._pictures:
            if self._closed.wait(self._pause_s):
                return
            yield frame

    def close(self) -> None:
        """End; may be called twice and from another thread."""
        self._closed.set()


def board_camera(board: Board, speed: float = 1.0, seed: int = 5) -> PracticeCamera:
    """The board as a person shows it who does what is asked: everywhere, tilted to all sides, near and far."""
    return PracticeCamera(_board_frames(board, seed), speed)


def card_camera(speed: float = 1.0, seed: int = 9) -> PracticeCamera:
    """The check card as it lies under the camera."""
    return PracticeCamera(_card_frames(seed), speed)


def _board_frames(board: Board, seed: int) -> Iterator[Frame]:
    studio = _studio()
    texture = texture_of(board_sheet(board, "a4"))
    index = 0
    before: Placed | None = None
    for around in itertools.count(seed):
        for placed in poses(texture, DIFFERENT, BOARD_DISTANCES_M[board.pattern], around):
            on_the_way = [] if before is None else [(_between(before, placed), 1)]
            for shown, times in (*on_the_way, (placed, _STILL_FRAMES)):
                drawn = studio.frame([shown], index, index / FPS)
                for _ in range(times):
                    yield replace(drawn, index=index, timestamp_s=index / FPS)
                    index += 1
            before = placed


def _card_frames(seed: int) -> Iterator[Frame]:
    studio, scene = _studio(), card_scene(turn_deg=float(np.random.default_rng(seed).uniform(-12.0, 12.0)))
    made: list[Frame] = []
    for index in itertools.count():
        if len(made) < _MOST_PICTURES:
            made.append(studio.frame(scene, index, index / FPS))
        kept = made[index % _MOST_PICTURES]
        yield replace(kept, index=index, timestamp_s=index / FPS)


@cache
def _studio() -> Studio:
    """One for all: it keeps no state, and takes seconds to make."""
    return Studio(LENS, _SEED, _DEPTH_SCALE_ERROR)


def _between(one: Placed, other: Placed) -> Placed:
    """Half-way from one pose to the next."""
    away: FloatArray = np.ravel(cv2.Rodrigues(other.rotation @ one.rotation.T)[0])
    half = np.asarray(cv2.Rodrigues(0.5 * away)[0])
    return Placed(other.texture, half @ one.rotation, 0.5 * (one.shift_m + other.shift_m))
