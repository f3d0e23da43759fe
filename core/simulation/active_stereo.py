"""What a pair of eyes with a spot projector makes of a scene: bumps that stay, thick edges, a band that one eye misses.

Depth (Grunnet-Jepsen et al., "Tuning depth cameras for best performance"): disparity d = f b / z by matching a window,
with a standard deviation of 0.08 pixel over a plane. Most of it stays from picture to picture: the spots lie as they
lie, and the matching errs with the fraction of a pixel of the disparity (subpixel non-linearity).
"""

from __future__ import annotations

import cv2
import numpy as np

from carpus.core.depth_sensor import DepthSensor
from carpus.core.simulation.sensor import counts, depth_scale, flecks, in_shadow, window_noise
from carpus.core.simulation.spec import RandomStream, RecordingSpec
from carpus.core.simulation.trace import FloatImage
from carpus.core.types import DepthImage

DISPARITY_STEP_PX = 1.0 / 32.0
_EDGE_DISPARITY_PX = 0.9
_LOST_SHARE = 1e-3


class ActiveStereo:
    """Turns true depth into the depth picture laid on colour, of focal length ``color_focal_px``; one per recording."""

    def __init__(self, spec: RecordingSpec, sensor: DepthSensor, shape: tuple[int, int], color_focal_px: float) -> None:
        rng = np.random.default_rng([spec.seed, RandomStream.DEPTH_NOISE, 2, 0])
        self._seed = spec.seed
        self._noisy = spec.sensor_noise
        self._scale = depth_scale(spec)
        self._sensor, self._shape = sensor, shape
        self._product_px_m = sensor.focal_px * sensor.baseline_m
        self._enlarged = color_focal_px / sensor.focal_px
        self._window_px = round(sensor.patch_px) | 1
        stays_px = sensor.stays.square_per_m * self._product_px_m
        whole_px = sensor.reading.square_per_m * self._product_px_m
        self._temporal_px = float(np.sqrt(max(whole_px**2 - stays_px**2, 0.0)))
        # Two patterns that take turns as the disparity goes through a pixel: a surface that moves nearer finds another.
        self._patterns = [np.float32(stays_px) * window_noise(rng, shape, self._window_px) for _ in range(2)]
        self._second_eye = 1 if rng.random() < 0.5 else -1

    def measure(self, depth_m: FloatImage, frame: int, color: FloatImage | None = None) -> DepthImage:
        """(H, W) true metres to counts of 1/5000 m, 0 where there is no reading.

        The noise depends on seed and frame number alone; the projector brings its own light."""
        if not self._noisy:
            return counts(depth_m)
        rng = np.random.default_rng([self._seed, RandomStream.DEPTH_NOISE, 2, 1 + frame])
        disparity = np.float32(self._product_px_m) / depth_m
        width = self._window_px
        # The window matches what is in front wherever it holds enough of it: the hand is half a window thicker.
        reach = 2 * (width // 4) + 1
        thick = cv2.dilate(disparity, cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (reach, reach)))
        spread = thick - cv2.erode(disparity, np.ones((reach, reach), np.uint8))
        at_edge = spread > _EDGE_DISPARITY_PX
        smooth = cv2.blur(disparity, (width, width))
        inner = cv2.dilate(at_edge.astype(np.uint8), np.ones((width, width), np.uint8)).astype(bool)
        seen = np.where(inner, disparity, smooth)
        seen = np.where(at_edge & (flecks(rng, self._shape) > -0.5), thick, seen)
        turn = np.float32(2.0 * np.pi) * disparity
        seen = seen + self._patterns[0] * np.cos(turn) + self._patterns[1] * np.sin(turn)
        seen = seen + np.float32(self._temporal_px) * window_noise(rng, self._shape, width)
        seen = np.round(seen / np.float32(DISPARITY_STEP_PX)) * np.float32(DISPARITY_STEP_PX)
        depth = np.float32(self._product_px_m * self._scale) / np.maximum(seen, np.float32(1.0))
        lost = at_edge & (flecks(rng, self._shape) > 0.9)
        lost |= in_shadow(disparity * np.float32(self._enlarged), self._second_eye)
        lost |= (depth < self._sensor.nearest_m) | (depth > self._sensor.farthest_m)
        lost |= rng.random(self._shape, dtype=np.float32) < _LOST_SHARE
        depth = np.round(depth * 1000.0) / 1000.0
        return np.where(lost, np.uint16(0), counts(depth))
