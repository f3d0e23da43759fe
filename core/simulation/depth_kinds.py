"""The depth pictures of each kind of sensor: the one place that knows which class renders which kind."""

from __future__ import annotations

from typing import Protocol

from carpus.core.camera import Camera
from carpus.core.simulation.active_stereo import ActiveStereo
from carpus.core.simulation.sensor import SimulatedDepth
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.simulation.time_of_flight import TimeOfFlight
from carpus.core.simulation.trace import FloatImage
from carpus.core.types import DepthImage


class DepthPictures(Protocol):
    """Turns true depth into the registered depth picture; one per recording."""

    def measure(self, depth_m: FloatImage, frame: int, color: FloatImage | None = None) -> DepthImage:
        """(H, W) true metres, and (H, W, 3) linear light, to counts of 1/5000 m, 0 where there is no reading."""
        ...


def depth_pictures(spec: RecordingSpec, camera: Camera) -> DepthPictures:
    """What the sensor of ``camera`` makes of depth."""
    shape, sensor = (camera.height_px, camera.width_px), camera.sensor
    if sensor.kind == "active stereo":
        return ActiveStereo(spec, sensor, shape, camera.fx_px)
    if sensor.kind == "time of flight":
        return TimeOfFlight(spec, sensor, shape, camera.fx_px)
    return SimulatedDepth(spec, shape)
