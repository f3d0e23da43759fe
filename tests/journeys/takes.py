"""A short take of the simulated patient for the journeys, rendered once for all of them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import lru_cache
from pathlib import Path

from carpus.core.calibration.clicks_file import read_clicks
from carpus.core.capture.files.tum import TumFolder
from carpus.core.capture.source import FrameSource
from carpus.core.model.types import FloatArray, Frame
from carpus.core.records.session_setup import SessionSetup
from carpus.core.simulation.motions import STILL_S
from carpus.core.simulation.recording import CLICKS_FILE
from tests.rendered import REPEATED_FLEXION

Take = Callable[[SessionSetup, Callable[[int, int], None]], tuple[FrameSource, float]]

SPEED = 1.5
"""How much faster than recorded everything plays."""
RANGE_DEG = 0.6 * 50.0
"""Reached to both sides, less up to 6 % by which the patient stops short of each target."""


class Unpacked:
    """A take whose pictures have been unpacked before: it is played through again and again."""

    def __init__(self, folder: Path) -> None:
        source = TumFolder(folder)
        self.info = source.info
        self._frames = list(source.frames())
        source.close()

    def frames(self) -> Iterator[Frame]:
        return iter(self._frames)

    def close(self) -> None:
        """It stays in memory for the next journey."""


unpacked = lru_cache(maxsize=1)(Unpacked)


def build_take(folder: Path, fps: float = REPEATED_FLEXION.fps) -> Take:
    """What :func:`app.compose.compose` takes instead of the practice patient's half minute."""
    return lambda _set_up, _progress: (unpacked(folder), STILL_S - 1.0 / fps)


def read_take_clicks(folder: Path) -> FloatArray:
    """A person's clicks (6, 2) on the still hand."""
    return read_clicks(folder / CLICKS_FILE).pixel
