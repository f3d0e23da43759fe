"""What a time-of-flight camera makes of a scene: white noise by the light that comes back, flying pixels, light that
comes by another way.

A reading mixes the light of all that its pixel holds: between a finger and the table it lies between both. The noise
falls with the light that comes back, so dark skin is noisier (Tolgyessy et al. 2021); light that reached the surface by
way of the table or another finger makes the way longer (multipath), by some millimetres that change slowly over the
picture.
"""

from __future__ import annotations

import cv2
import numpy as np

from carpus.core.depth_sensor import DepthSensor
from carpus.core.simulation.sensor import counts, depth_scale, flecks, in_shadow
from carpus.core.simulation.spec import RandomStream, RecordingSpec
from carpus.core.simulation.trace import FloatImage
from carpus.core.types import DepthImage

COLOR_BASELINE_M = 0.032
"""Between the depth and the colour camera: what colour alone sees has no depth."""
_MULTIPATH_M, _MULTIPATH_SD_M = 0.003, 0.0009
_MULTIPATH_CELL_PX = 80
_PIXEL_STAYS_M = 0.0004
_EDGE_M = 0.012
"""A pixel that holds surfaces further apart than this flies."""
_LOST_SHARE = 2e-4
_BRIGHT = 0.5
"""Share of light given back at which the noise is the law's; less than a tenth of it gives no better reading."""
_DARKEST = 0.05


class TimeOfFlight:
    """Turns true depth into the depth picture laid on colour, of focal length ``color_focal_px``; one per recording."""

    def __init__(self, spec: RecordingSpec, sensor: DepthSensor, shape: tuple[int, int], color_focal_px: float) -> None:
        rng = np.random.default_rng([spec.seed, RandomStream.DEPTH_NOISE, 3, 0])
        self._seed = spec.seed
        self._noisy = spec.sensor_noise
        self._scale = depth_scale(spec)
        self._sensor, self._shape = sensor, shape
        self._color_px_m = COLOR_BASELINE_M * color_focal_px
        self._side = 1 if rng.random() < 0.5 else -1
        self._patch_px = max(round(sensor.patch_px), 1)
        height, width = shape
        cells = rng.standard_normal((height // _MULTIPATH_CELL_PX + 2, width // _MULTIPATH_CELL_PX + 2))
        slow = cv2.resize(cells.astype(np.float32), (width, height), interpolation=cv2.INTER_CUBIC)
        slow = slow * np.float32(_MULTIPATH_SD_M / float(np.std(slow)))
        own = np.float32(_PIXEL_STAYS_M) * self._noise(rng)
        self._longer_m = np.float32(_MULTIPATH_M * rng.uniform()) + slow + own

    def measure(self, depth_m: FloatImage, frame: int, color: FloatImage | None = None) -> DepthImage:
        """(H, W) true metres to counts of 1/5000 m, 0 where there is no reading.

        ``color`` (H, W, 3) linear light: how much of its light each thing gives back; without it all is bright. The
        noise depends on seed, frame number and this alone."""
        if not self._noisy:
            return counts(depth_m)
        rng = np.random.default_rng([self._seed, RandomStream.DEPTH_NOISE, 3, 1 + frame])
        around = np.ones((3, 3), np.uint8)
        flying = cv2.dilate(depth_m, around) - cv2.erode(depth_m, around) > _EDGE_M
        seen = np.where(flying, cv2.blur(depth_m, (3, 3)), depth_m)
        sd_m = self._sensor.reading_sd_m(depth_m.astype(np.float64)).astype(np.float32) * self._dimness(color)
        depth = np.float32(self._scale) * (seen + self._longer_m + sd_m * self._noise(rng))
        lost = flying & (flecks(rng, self._shape) > 0.9)
        lost |= in_shadow(np.float32(self._color_px_m) / depth_m, self._side)
        lost |= (depth < self._sensor.nearest_m) | (depth > self._sensor.farthest_m)
        lost |= rng.random(self._shape, dtype=np.float32) < _LOST_SHARE
        depth = np.round(depth * 1000.0) / 1000.0
        return np.where(lost, np.uint16(0), counts(depth))

    def _noise(self, rng: np.random.Generator) -> FloatImage:
        """Noise (H, W) of standard deviation 1, shared by the few pixels of one reading."""
        white = rng.standard_normal(self._shape, dtype=np.float32)
        width = self._patch_px
        return np.asarray(cv2.blur(white, (width, width)) * np.float32(width))

    def _dimness(self, color: FloatImage | None) -> FloatImage:
        """Factor (H, W) on the noise. The camera brings its own, infrared light, which dyes let through: what is bright
        in any colour is bright in it, and how bright the room is does not count."""
        if color is None:
            return np.ones(self._shape, dtype=np.float32)
        brightest = color.max(axis=-1)
        given_back = brightest / max(float(np.percentile(brightest[::8, ::8], 95)), 1e-6)
        return np.asarray(_BRIGHT / np.clip(given_back, _DARKEST, None), dtype=np.float32).clip(0.7, 4.0)
