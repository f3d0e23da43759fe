"""The first pictures of a simulated recording, each drawn when it is asked for: there at once, and stored nowhere."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice

from carpus.core.capture.source import SourceInfo
from carpus.core.simulation.recording import SimulatedPictures
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.types import SIMULATED, Frame


class FirstPictures:
    """The pictures of the first ``seconds`` as a source: the same ones that the whole recording begins with."""

    def __init__(self, spec: RecordingSpec, seconds: float) -> None:
        self._pictures = SimulatedPictures(spec)
        self._count = int((self._pictures.times.color_s < seconds).sum())
        camera = self._pictures.truth.camera
        self.info = SourceInfo(spec.cache_key, camera, True, self._count, spec.fps, {SIMULATED: "yes"})

    def frames(self) -> Iterator[Frame]:
        """Drawn one after the other."""
        return islice(self._pictures.frames(), self._count)

    def close(self) -> None:
        """Nothing is held."""
