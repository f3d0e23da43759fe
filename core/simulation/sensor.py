"""What the Xtion makes of a scene: its colour noise and chroma, its structured-light depth.

Depth (clinical reference 7.2): disparity d = f b / z is found by matching a 9 x 9 window and given in steps of
1/8 pixel; with f b = 43.1 px m a step is 2.85e-3 z^2 and the whole standard deviation half a step, 1.425e-3 z^2.
"""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from carpus.core.simulation.appearance import READ_NOISE_ELECTRONS, Appearance
from carpus.core.simulation.spec import RandomStream, RecordingSpec
from carpus.core.simulation.trace import FloatImage
from carpus.core.types import ByteImage, DepthImage

DISPARITY_PX_M = 575.0 * 0.075
"""Focal length of the depth camera in pixels times the baseline in metres."""
DISPARITY_STEP_PX = 1.0 / 8.0

# Noise before rounding to steps: sqrt(0.5^2 - 1/12) steps in all, a part of it a pattern that stays.
_TEMPORAL_STEPS, _FIXED_STEPS = 0.37, 0.17
_WINDOW_PX = 9
_EDGE_DISPARITY_PX = 0.9
"""A window in which disparity differs by more than this holds two surfaces."""
_EDGE_JITTER_PX = 1.6
_NEAREST_M, _FARTHEST_M = 0.40, 3.5
_DEPTH_COUNTS_PER_M = 5000.0

_WHITE = 65535


def _gamma_table() -> ByteImage:
    """The sRGB curve from 16-bit linear to 8 bits."""
    light = np.linspace(0.0, 1.0, _WHITE + 1)
    curve = np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1.0 / 2.4) - 0.055)
    return np.asarray(np.round(255.0 * curve), dtype=np.uint8)


_GAMMA = _gamma_table()


class ColorSensor:
    """Turns linear light into the 8-bit picture of the camera; one per recording."""

    def __init__(self, spec: RecordingSpec, looks: Appearance) -> None:
        self._seed = spec.seed
        self._looks = looks
        self._noisy = spec.sensor_noise

    def expose(self, color: FloatImage, frame: int) -> ByteImage:
        """(H, W, 3) linear to RGB uint8: lens blur, Bayer filter, shot and read noise, demosaicing,
        gamma, YUV 4:2:2 and back.

        The noise depends on seed and frame number alone."""
        if not self._noisy:
            return _GAMMA[_counts16(color)]
        light = np.asarray(cv2.GaussianBlur(color, (0, 0), self._looks.blur_px), dtype=np.float32)
        # One colour per pixel, as under a Bayer filter: green on the diagonal of red and blue.
        raw = light[..., 1].copy()
        raw[0::2, 0::2] = light[0::2, 0::2, 0]
        raw[1::2, 1::2] = light[1::2, 1::2, 2]
        raw = np.maximum(raw, np.float32(0.0))
        rng = np.random.default_rng([self._seed, RandomStream.COLOR_NOISE, frame])
        electrons = self._looks.electrons
        variance = raw / np.float32(electrons) + np.float32((READ_NOISE_ELECTRONS / electrons) ** 2)
        raw += rng.standard_normal(raw.shape, dtype=np.float32) * np.sqrt(variance)
        whole = cv2.demosaicing(_counts16(raw), cv2.COLOR_BayerRGGB2RGB)
        return _through_yuv422(_GAMMA[whole])


def _counts16(light: FloatImage) -> NDArray[np.uint16]:
    return np.asarray(np.clip(light * np.float32(_WHITE), 0.0, _WHITE).astype(np.uint16))


def _through_yuv422(rgb: ByteImage) -> ByteImage:
    """Two neighbours in a row share their chroma, as in the camera's UYVY stream."""
    ycc = cv2.cvtColor(rgb, cv2.COLOR_RGB2YCrCb)
    chroma = ycc[..., 1:].astype(np.uint16)
    shared = ((chroma[:, 0::2] + chroma[:, 1::2] + 1) >> 1).astype(np.uint8)
    ycc[:, 0::2, 1:] = shared
    ycc[:, 1::2, 1:] = shared
    return np.asarray(cv2.cvtColor(ycc, cv2.COLOR_YCrCb2RGB), dtype=np.uint8)


def depth_scale(spec: RecordingSpec) -> float:
    """Measured over true depth of the simulated unit, within ``spec.depth_scale_error`` of 1."""
    if not spec.sensor_noise:
        return 1.0
    return 1.0 + spec.depth_scale_error * float(spec.random(RandomStream.DEPTH_NOISE).uniform(-1.0, 1.0))


class SimulatedDepth:
    """Turns true depth into the registered depth picture; one per recording, which has its own scale and pattern."""

    def __init__(self, spec: RecordingSpec, shape: tuple[int, int]) -> None:
        rng = np.random.default_rng([spec.seed, RandomStream.DEPTH_NOISE, 1, 0])
        self._seed = spec.seed
        self._noisy = spec.sensor_noise
        self._scale = depth_scale(spec)
        self._shape = shape
        self._fixed = np.float32(_FIXED_STEPS * DISPARITY_STEP_PX) * window_noise(rng, self._shape, _WINDOW_PX)
        self._shadow_side = 1 if rng.random() < 0.5 else -1

    def measure(self, depth_m: FloatImage, frame: int, color: FloatImage | None = None) -> DepthImage:
        """(H, W) true metres to counts of 1/5000 m, 0 where there is no reading.

        The noise depends on seed and frame number alone; the light in ``color`` plays no part."""
        if not self._noisy:
            return counts(depth_m)
        rng = np.random.default_rng([self._seed, RandomStream.DEPTH_NOISE, frame])
        disparity = np.float32(DISPARITY_PX_M) / depth_m
        window = np.ones((5, 5), np.uint8)
        spread = cv2.dilate(disparity, window) - cv2.erode(disparity, window)
        at_edge = spread > _EDGE_DISPARITY_PX
        smooth = cv2.blur(disparity, (7, 7))
        wobble = [np.float32(_EDGE_JITTER_PX) * flecks(rng, self._shape) for _ in range(2)]
        v, u = np.indices(self._shape, dtype=np.float32)
        torn = cv2.remap(disparity, u + wobble[0], v + wobble[1], cv2.INTER_NEAREST, borderMode=cv2.BORDER_REPLICATE)
        wide = cv2.dilate(at_edge.astype(np.uint8), np.ones((3, 3), np.uint8)).astype(bool)
        mixed = cv2.blur(disparity, (3, 3))
        chance = flecks(rng, self._shape)
        seen = np.where(wide, np.where(chance > 0.9, mixed, torn), smooth)
        wobble_px = np.float32(_TEMPORAL_STEPS * DISPARITY_STEP_PX) * window_noise(rng, self._shape, _WINDOW_PX)
        seen = seen + self._fixed + wobble_px
        seen = np.round(seen / np.float32(DISPARITY_STEP_PX)) * np.float32(DISPARITY_STEP_PX)
        depth = np.float32(DISPARITY_PX_M * self._scale) / np.maximum(seen, 1.0)
        lost = at_edge & (flecks(rng, self._shape) > 0.35)
        lost |= in_shadow(disparity, self._shadow_side)
        lost |= (depth < _NEAREST_M) | (depth > _FARTHEST_M)
        lost |= rng.random(self._shape, dtype=np.float32) < 2e-4
        # The sensor itself speaks in whole millimetres.
        depth = np.round(depth * 1000.0) / 1000.0
        return np.where(lost, np.uint16(0), counts(depth))


def window_noise(rng: np.random.Generator, shape: tuple[int, int], width_px: int) -> FloatImage:
    """Noise (H, W) of standard deviation 1, correlated over a matching window."""
    white = rng.standard_normal(shape, dtype=np.float32)
    return np.asarray(cv2.blur(white, (width_px, width_px)) * np.float32(width_px))


def flecks(rng: np.random.Generator, shape: tuple[int, int]) -> FloatImage:
    """Noise (H, W) of standard deviation about 1, in flecks of some pixels."""
    height, width = shape
    coarse = rng.standard_normal((height // 4 + 1, width // 4 + 1), dtype=np.float32)
    return np.asarray(1.4 * cv2.resize(coarse, (width, height), interpolation=cv2.INTER_LINEAR), dtype=np.float32)


def in_shadow(disparity: FloatImage, side: int) -> NDArray[np.bool_]:
    """Pixels that a second eye or a projector, beside the camera on ``side`` (1 or -1), cannot reach past a nearer
    surface; ``disparity`` (H, W) in pixels of this picture."""
    column = np.arange(disparity.shape[1], dtype=np.float32)[None]
    if side > 0:
        lit = column + disparity
        reached = np.maximum.accumulate(lit, axis=1)
        return np.asarray(reached > lit + 1.5)
    lit = column - disparity
    reached = np.minimum.accumulate(lit[:, ::-1], axis=1)[:, ::-1]
    return np.asarray(reached < lit - 1.5)


def counts(depth_m: FloatImage) -> DepthImage:
    """Metres (H, W) in counts of 1/5000 m."""
    return np.clip(np.round(depth_m * _DEPTH_COUNTS_PER_M), 0.0, 65535.0).astype(np.uint16)
