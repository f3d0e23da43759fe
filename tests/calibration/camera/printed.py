"""A recording of printed sheets as a source."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from carpus.core.capture.source import SourceInfo
from carpus.core.model.camera import Camera
from carpus.core.model.types import Frame
from tests.studio import Placed, Studio


class ShownSheets:
    """A recording of sheets, one frame a second, as a source."""

    def __init__(self, studio: Studio, shown: Sequence[Sequence[Placed]], serial: str = "", fps: float = 1.0) -> None:
        settings = {"serial": serial} if serial else {}
        guess = Camera(525.0, 525.0, 319.5, 239.5)
        self.info = SourceInfo("studio", guess, True, len(shown), fps, settings)
        self._studio, self._shown, self._fps = studio, shown, fps

    def frames(self) -> Iterator[Frame]:
        for k, sheets in enumerate(self._shown):
            yield self._studio.frame(sheets, k, 100.0 + k / self._fps)

    def close(self) -> None:
        """Nothing is open."""
