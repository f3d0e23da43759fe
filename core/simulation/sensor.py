"""Sensor models: colour noise and chroma, and the depth image of each kind of sensor.

Structured light of the Xtion (clinical reference 7.2): disparity d = f b / z comes from matching a 9 x 9 window, in
steps of 1/8 pixel. With f b = 43.1 px m a step is 2.85e-3 z^2 and the standard deviation half a step, 1.425e-3 z^2.
"""

from __future__ import annotations

from abc import ABC, abstractmethod

import cv2
import numpy as np
from numpy.typing import NDArray

from carpus.core.model.camera import Camera
from carpus.core.model.types import ByteImage, DepthImage
from carpus.core.simulation.appearance import READ_NOISE_ELECTRONS, Appearance
from carpus.core.simulation.spec import RandomStream, RecordingSpec
from carpus.core.simulation.sphere_tracing import FloatImage

DISPARITY_PX_M = 575.0 * 0.075
"""Focal length of the depth camera (px) times the baseline (m)."""
DISPARITY_STEP_PX = 1.0 / 8.0

# Noise before rounding to steps: sqrt(0.5^2 - 1/12) steps in all, a part of it a pattern that stays.
_TEMPORAL_STEPS, _FIXED_STEPS = 0.37, 0.17
_WINDOW_PX = 9
_EDGE_DISPARITY_PX = 0.9
"""A window with a larger range of disparity holds two surfaces."""
_EDGE_JITTER_PX = 1.6
_NEAREST_M, _FARTHEST_M = 0.40, 3.5
_DEPTH_COUNTS_PER_M = 5000.0

_WHITE = 65535


def _gamma_table() -> ByteImage:
    """Return the sRGB curve from 16-bit linear to 8 bits."""
    light = np.linspace(0.0, 1.0, _WHITE + 1)
    curve = np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1.0 / 2.4) - 0.055)
    return np.asarray(np.round(255.0 * curve), dtype=np.uint8)


_GAMMA = _gamma_table()


class ColorSensor:
    """Colour camera of one recording."""

    def __init__(self, spec: RecordingSpec, appearance: Appearance) -> None:
        self._seed = spec.seed
        self._appearance = appearance
        self._noisy = spec.sensor_noise

    def expose(self, color: FloatImage, frame: int) -> ByteImage:
        """Return RGB uint8 of linear light (H, W, 3).

        Lens blur, Bayer filter, shot and read noise, demosaicing, gamma, YUV 4:2:2. The noise depends on seed and frame
        only.
        """
        if not self._noisy:
            return _GAMMA[_to_16_bit(color)]
        light = np.asarray(cv2.GaussianBlur(color, (0, 0), self._appearance.blur_px), dtype=np.float32)
        # One colour per pixel, as under a Bayer filter: green on the diagonal of red and blue.
        raw = light[..., 1].copy()
        raw[0::2, 0::2] = light[0::2, 0::2, 0]
        raw[1::2, 1::2] = light[1::2, 1::2, 2]
        raw = np.maximum(raw, np.float32(0.0))
        rng = np.random.default_rng([self._seed, RandomStream.COLOR_NOISE, frame])
        electrons = self._appearance.electrons
        variance = raw / np.float32(electrons) + np.float32((READ_NOISE_ELECTRONS / electrons) ** 2)
        raw += rng.standard_normal(raw.shape, dtype=np.float32) * np.sqrt(variance)
        whole = cv2.demosaicing(_to_16_bit(raw), cv2.COLOR_BayerRGGB2RGB)
        # share the chroma of two neighbours in a row, as in the camera's UYVY stream
        ycc = cv2.cvtColor(_GAMMA[whole], cv2.COLOR_RGB2YCrCb)
        chroma = ycc[..., 1:].astype(np.uint16)
        shared = ((chroma[:, 0::2] + chroma[:, 1::2] + 1) >> 1).astype(np.uint8)
        ycc[:, 0::2, 1:] = shared
        ycc[:, 1::2, 1:] = shared
        return np.asarray(cv2.cvtColor(ycc, cv2.COLOR_YCrCb2RGB), dtype=np.uint8)


def _to_16_bit(light: FloatImage) -> NDArray[np.uint16]:
    return np.asarray(np.clip(light * np.float32(_WHITE), 0.0, _WHITE).astype(np.uint16))


def depth_scale(spec: RecordingSpec) -> float:
    """Return measured over true depth, within ``spec.depth_scale_error`` of 1."""
    if not spec.sensor_noise:
        return 1.0
    return 1.0 + spec.depth_scale_error * float(spec.generator(RandomStream.DEPTH_NOISE).uniform(-1.0, 1.0))


class SimulatedDepthSensor(ABC):
    """Depth camera of one recording, registered to colour; the noise depends on seed and frame only."""

    def __init__(self, spec: RecordingSpec, camera: Camera) -> None:
        self._seed = spec.seed
        self._noisy = spec.sensor_noise
        self._scale = depth_scale(spec)
        self._shape = (camera.height_px, camera.width_px)
        self._sensor, self._color_focal_px = camera.sensor, camera.fx_px

    def measure(self, depth_m: FloatImage, frame: int, color: FloatImage | None = None) -> DepthImage:
        """Return counts of 1/5000 m, 0 without a reading, of true metres (H, W).

        ``color`` (H, W, 3) linear light tells how much each surface returns; without it all is bright.
        """
        return self._measure(depth_m, frame, color) if self._noisy else to_depth_counts(depth_m)

    @abstractmethod
    def _measure(self, depth_m: FloatImage, frame: int, color: FloatImage | None) -> DepthImage:
        """Return the noisy counts."""


class StructuredLightSensor(SimulatedDepthSensor):
    """Structured-light depth camera of one recording, with its own scale and pattern."""

    def __init__(self, spec: RecordingSpec, camera: Camera) -> None:
        super().__init__(spec, camera)
        rng = np.random.default_rng([spec.seed, RandomStream.DEPTH_NOISE, 1, 0])
        self._fixed_pattern = np.float32(_FIXED_STEPS * DISPARITY_STEP_PX) * window_noise(rng, self._shape, _WINDOW_PX)
        self._shadow_side = 1 if rng.random() < 0.5 else -1

    def _measure(self, depth_m: FloatImage, frame: int, color: FloatImage | None) -> DepthImage:
        rng = np.random.default_rng([self._seed, RandomStream.DEPTH_NOISE, frame])
        disparity = np.float32(DISPARITY_PX_M) / depth_m
        window = np.ones((5, 5), np.uint8)
        spread = cv2.dilate(disparity, window) - cv2.erode(disparity, window)
        at_edge = spread > _EDGE_DISPARITY_PX
        smooth = cv2.blur(disparity, (7, 7))
        jitter = [np.float32(_EDGE_JITTER_PX) * fleck_noise(rng, self._shape) for _ in range(2)]
        v, u = np.indices(self._shape, dtype=np.float32)
        jittered = cv2.remap(
            disparity, u + jitter[0], v + jitter[1], cv2.INTER_NEAREST, borderMode=cv2.BORDER_REPLICATE
        )
        wide = cv2.dilate(at_edge.astype(np.uint8), np.ones((3, 3), np.uint8)).astype(bool)
        mixed = cv2.blur(disparity, (3, 3))
        chance = fleck_noise(rng, self._shape)
        measured = np.where(wide, np.where(chance > 0.9, mixed, jittered), smooth)
        wobble_px = np.float32(_TEMPORAL_STEPS * DISPARITY_STEP_PX) * window_noise(rng, self._shape, _WINDOW_PX)
        measured = measured + self._fixed_pattern + wobble_px
        measured = np.round(measured / np.float32(DISPARITY_STEP_PX)) * np.float32(DISPARITY_STEP_PX)
        depth = np.float32(DISPARITY_PX_M * self._scale) / np.maximum(measured, 1.0)
        lost = at_edge & (fleck_noise(rng, self._shape) > 0.35)
        lost |= is_in_shadow(disparity, self._shadow_side)
        return _to_depth_image(depth, lost, (_NEAREST_M, _FARTHEST_M), 2e-4, rng)


def _to_depth_image(
    depth_m: FloatImage, lost: NDArray[np.bool_], range_m: tuple[float, float], share: float, rng: np.random.Generator
) -> DepthImage:
    """Return readings (H, W) in whole millimetres, without lost ones, those out of range, and a random share."""
    lost = lost | (depth_m < range_m[0]) | (depth_m > range_m[1])
    lost |= rng.random(lost.shape, dtype=np.float32) < share
    return np.where(
        lost, np.uint16(0), to_depth_counts(np.asarray(np.round(depth_m * 1000.0) / 1000.0, dtype=np.float32))
    )


def window_noise(rng: np.random.Generator, shape: tuple[int, int], width_px: int) -> FloatImage:
    """Return noise (H, W) of standard deviation 1, correlated over a matching window."""
    white = rng.standard_normal(shape, dtype=np.float32)
    return np.asarray(cv2.blur(white, (width_px, width_px)) * np.float32(width_px))


def fleck_noise(rng: np.random.Generator, shape: tuple[int, int]) -> FloatImage:
    """Return noise (H, W) of standard deviation about 1, in flecks of some pixels."""
    height, width = shape
    coarse = rng.standard_normal((height // 4 + 1, width // 4 + 1), dtype=np.float32)
    return np.asarray(1.4 * cv2.resize(coarse, (width, height), interpolation=cv2.INTER_LINEAR), dtype=np.float32)


def is_in_shadow(disparity: FloatImage, side: int) -> NDArray[np.bool_]:
    """Select pixels that a second eye or projector on ``side`` (1 or -1) cannot reach past a nearer surface.

    ``disparity`` (H, W) is in pixels of this image.
    """
    column = np.arange(disparity.shape[1], dtype=np.float32)[None]
    if side > 0:
        lit = column + disparity
        reached = np.maximum.accumulate(lit, axis=1)
        return np.asarray(reached > lit + 1.5)
    lit = column - disparity
    reached = np.minimum.accumulate(lit[:, ::-1], axis=1)[:, ::-1]
    return np.asarray(reached < lit - 1.5)


def to_depth_counts(depth_m: FloatImage) -> DepthImage:
    """Convert metres (H, W) to counts of 1/5000 m."""
    return np.clip(np.round(depth_m * _DEPTH_COUNTS_PER_M), 0.0, 65535.0).astype(np.uint16)


COLOR_BASELINE_M = 0.032
"""Between depth and colour camera: what only colour sees has no depth."""
_MULTIPATH_M, _MULTIPATH_SD_M = 0.003, 0.0009
_MULTIPATH_CELL_PX = 80
_PIXEL_PATTERN_SD_M = 0.0004
_EDGE_M = 0.012
"""A pixel with surfaces further apart mixes them (flying pixel)."""
_FLIGHT_LOST_SHARE = 2e-4
_REFERENCE_BRIGHTNESS = 0.5
"""Returned light at which the noise is nominal; below a tenth of it readings get no worse."""
_MIN_BRIGHTNESS = 0.05


class TimeOfFlightSensor(SimulatedDepthSensor):
    """Time-of-flight depth camera of one recording.

    A reading mixes the light of all surfaces in its pixel. Noise rises as less light returns, so dark skin is noisier
    (Tolgyessy et al. 2021). Light that arrives by way of the table or another finger lengthens the way (multipath) by
    some millimetres that vary slowly over the image.
    """

    def __init__(self, spec: RecordingSpec, camera: Camera) -> None:
        super().__init__(spec, camera)
        rng = np.random.default_rng([spec.seed, RandomStream.DEPTH_NOISE, 3, 0])
        self._side = 1 if rng.random() < 0.5 else -1
        self._patch_px = max(round(self._sensor.patch_px), 1)
        height, width = self._shape
        cells = rng.standard_normal((height // _MULTIPATH_CELL_PX + 2, width // _MULTIPATH_CELL_PX + 2))
        slow = cv2.resize(cells.astype(np.float32), (width, height), interpolation=cv2.INTER_CUBIC)
        slow = slow * np.float32(_MULTIPATH_SD_M / float(np.std(slow)))
        own = np.float32(_PIXEL_PATTERN_SD_M) * window_noise(rng, self._shape, self._patch_px)
        self._range_bias_m = np.float32(_MULTIPATH_M * rng.uniform()) + slow + own

    def _measure(self, depth_m: FloatImage, frame: int, color: FloatImage | None) -> DepthImage:
        rng = np.random.default_rng([self._seed, RandomStream.DEPTH_NOISE, 3, 1 + frame])
        around = np.ones((3, 3), np.uint8)
        flying = cv2.dilate(depth_m, around) - cv2.erode(depth_m, around) > _EDGE_M
        measured = np.where(flying, cv2.blur(depth_m, (3, 3)), depth_m)
        sd_m = self._sensor.reading_sd_m(depth_m.astype(np.float64)).astype(np.float32) * self._noise_factor(color)
        depth = np.float32(self._scale) * (
            measured + self._range_bias_m + sd_m * window_noise(rng, self._shape, self._patch_px)
        )
        lost = flying & (fleck_noise(rng, self._shape) > 0.9)
        lost |= is_in_shadow(np.float32(COLOR_BASELINE_M * self._color_focal_px) / depth_m, self._side)
        return _to_depth_image(depth, lost, (self._sensor.nearest_m, self._sensor.farthest_m), _FLIGHT_LOST_SHARE, rng)

    def _noise_factor(self, color: FloatImage | None) -> FloatImage:
        """Return the factor (H, W) on the noise from the reflectance in infrared.

        Dyes let infrared through: what is bright in any colour is bright in it. The light of the room does not count.
        """
        if color is None:
            return np.ones(self._shape, dtype=np.float32)
        brightest = color.max(axis=-1)
        given_back = brightest / max(float(np.percentile(brightest[::8, ::8], 95)), 1e-6)
        return np.asarray(_REFERENCE_BRIGHTNESS / np.clip(given_back, _MIN_BRIGHTNESS, None), dtype=np.float32).clip(
            0.7, 4.0
        )


_STEREO_STEP_PX = 1.0 / 32.0
_STEREO_LOST_SHARE = 1e-3


class ActiveStereoSensor(SimulatedDepthSensor):
    """Active stereo depth camera of one recording.

    Disparity f b / z by window matching, with a standard deviation of 0.08 pixel over a plane (Grunnet-Jepsen et al.,
    "Tuning depth cameras for best performance"). Most of it is constant: the projected spots stay, and matching errs
    with the fraction of the disparity (subpixel non-linearity). Edges are thick, and one eye misses a band beside them.
    """

    def __init__(self, spec: RecordingSpec, camera: Camera) -> None:
        super().__init__(spec, camera)
        rng = np.random.default_rng([spec.seed, RandomStream.DEPTH_NOISE, 2, 0])
        sensor = self._sensor
        self._product_px_m = sensor.focal_px * sensor.baseline_m
        self._enlarged = camera.fx_px / sensor.focal_px
        self._window_px = round(sensor.patch_px) | 1
        stays_px = sensor.stays.square_per_m * self._product_px_m
        whole_px = sensor.reading.square_per_m * self._product_px_m
        self._temporal_px = float(np.sqrt(max(whole_px**2 - stays_px**2, 0.0)))
        # Two patterns that take turns as the disparity goes through a pixel: a surface that moves nearer finds another.
        self._patterns = [np.float32(stays_px) * window_noise(rng, self._shape, self._window_px) for _ in range(2)]
        self._second_eye = 1 if rng.random() < 0.5 else -1

    def _measure(self, depth_m: FloatImage, frame: int, color: FloatImage | None) -> DepthImage:
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
        measured = np.where(inner, disparity, smooth)
        measured = np.where(at_edge & (fleck_noise(rng, self._shape) > -0.5), thick, measured)
        turn = np.float32(2.0 * np.pi) * disparity
        measured = measured + self._patterns[0] * np.cos(turn) + self._patterns[1] * np.sin(turn)
        measured = measured + np.float32(self._temporal_px) * window_noise(rng, self._shape, width)
        measured = np.round(measured / np.float32(_STEREO_STEP_PX)) * np.float32(_STEREO_STEP_PX)
        depth = np.float32(self._product_px_m * self._scale) / np.maximum(measured, np.float32(1.0))
        lost = at_edge & (fleck_noise(rng, self._shape) > 0.9)
        lost |= is_in_shadow(disparity * np.float32(self._enlarged), self._second_eye)
        return _to_depth_image(depth, lost, (self._sensor.nearest_m, self._sensor.farthest_m), _STEREO_LOST_SHARE, rng)


def create_depth_sensor(spec: RecordingSpec, camera: Camera) -> SimulatedDepthSensor:
    """Create the depth sensor of a camera."""
    models = {"active stereo": ActiveStereoSensor, "time of flight": TimeOfFlightSensor}
    return models.get(camera.sensor.kind, StructuredLightSensor)(spec, camera)
