"""The second camera's pictures: colour through a warm, vignetting lens; depth by structured light, law of its own.

Depth law: disparity d = ``DISPARITY_PX_M`` / z, read with noise of ``disparity_sd_px`` (drawn for each unit) that
neighbours share over some pixels, and given in steps of ``STEP_PX``. Along edges a reading belongs to either surface
or to a mixture; where the projector cannot shine, at grazing skin and now and then anywhere, there is none.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from carpus.core.model.types import ByteImage, DepthImage, FloatArray
from tests.second_patient.look import FloatImage

DISPARITY_PX_M = 568.0 * 0.0748
STEP_PX = 1.0 / 8.0
COUNTS_PER_M = 5000.0
_PATCH_PX = (1.9, 1.2)
"""Reach of what neighbours share, along and across the rows."""
_EDGE_PX = 1.4
_GRAZING = 0.030
"""Depth may change so much from pixel to pixel, metres, before a surface grazes the light."""
_BANK = 5


@dataclass(frozen=True, slots=True, repr=False)
class Sensor:
    """One unit: its lens, its colours and its depth, and the noise that it draws on."""

    gain: FloatArray
    falloff: FloatImage
    blur_px: float
    shot: float
    read: float
    chroma_blur_px: float
    disparity_sd_px: float
    pattern_px: FloatImage
    scale: float
    bank: tuple[FloatImage, ...]
    patch: tuple[FloatImage, ...]
    seed: int


def make_sensor(seed: int, shape: tuple[int, int]) -> Sensor:
    """The unit of a seed for pictures of ``shape``."""
    rng = np.random.default_rng([seed, 1709])
    v, u = np.mgrid[0 : shape[0], 0 : shape[1]]
    away = np.hypot((u - 0.5 * shape[1]) / (0.5 * shape[1]), (v - 0.5 * shape[0]) / (0.5 * shape[1]))
    falloff = (1.0 - float(rng.uniform(0.10, 0.32)) * away**2).astype(np.float32)
    warm = float(rng.uniform(-0.10, 0.12))
    gain = float(rng.uniform(0.85, 1.15)) * np.array([1.0 + warm, 1.0 + float(rng.uniform(-0.04, 0.04)), 1.0 - warm])
    bank = tuple(rng.standard_normal((*shape, 3), dtype=np.float32) for _ in range(_BANK))
    patch = tuple(_patches(rng.standard_normal(shape, dtype=np.float32)) for _ in range(_BANK))
    pattern = 0.045 * _patches(rng.standard_normal(shape, dtype=np.float32))
    return Sensor(
        gain,
        falloff,
        float(rng.uniform(0.45, 0.75)),
        float(rng.uniform(1.5e-4, 5e-4)),
        float(rng.uniform(0.8e-3, 2.2e-3)),
        float(rng.uniform(0.6, 1.1)),
        float(rng.uniform(0.055, 0.10)),
        pattern.astype(np.float32),
        1.0 + float(np.clip(rng.normal(0.0, 0.003), -0.006, 0.006)),
        bank,
        patch,
        seed,
    )


def _patches(white: FloatImage) -> FloatImage:
    """Noise of sd 1 that neighbours share."""
    soft = cv2.GaussianBlur(white, (0, 0), sigmaX=_PATCH_PX[0], sigmaY=_PATCH_PX[1])
    return np.asarray(soft / soft.std(), dtype=np.float32)


def _gamma() -> ByteImage:
    light = np.linspace(0.0, 1.0, 4096)
    return np.round(255.0 * np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)).astype(
        np.uint8
    )


_GAMMA = _gamma()


def expose(sensor: Sensor, light: FloatImage, frame: int) -> ByteImage:
    """(H, W, 3) linear light as 8-bit colour, red first."""
    rng = np.random.default_rng([sensor.seed, 1801, frame])
    seen = cv2.GaussianBlur(
        light * (sensor.falloff[..., None] * sensor.gain.astype(np.float32)), (0, 0), sensor.blur_px
    )
    noise = _rolled(sensor.bank, rng)
    seen = seen + noise * np.sqrt(np.float32(sensor.shot) * np.maximum(seen, 0.0) + np.float32(sensor.read**2))
    eight = _GAMMA[np.clip(seen * 4095.0, 0.0, 4095.0).astype(np.uint16)]
    split = cv2.cvtColor(eight, cv2.COLOR_RGB2YCrCb)
    half = cv2.resize(split[..., 1:], (split.shape[1] // 2, split.shape[0] // 2), interpolation=cv2.INTER_AREA)
    half = cv2.GaussianBlur(half, (0, 0), 0.5 * sensor.chroma_blur_px)
    split[..., 1:] = cv2.resize(half, (split.shape[1], split.shape[0]), interpolation=cv2.INTER_LINEAR)
    return np.asarray(cv2.cvtColor(split, cv2.COLOR_YCrCb2RGB))


def read_depth(sensor: Sensor, depth_m: FloatImage, frame: int) -> DepthImage:
    """(H, W) true depth as the unit gives it, 5000 counts a metre, 0 for no reading."""
    rng = np.random.default_rng([sensor.seed, 1901, frame])
    shape = depth_m.shape
    disparity = (DISPARITY_PX_M / depth_m).astype(np.float32)
    noise, jump_u, jump_v, dice = (_rolled(sensor.patch, rng) for _ in range(4))
    v, u = np.indices(shape, dtype=np.float32)
    read = cv2.remap(
        disparity,
        u + _EDGE_PX * jump_u,
        v + 0.6 * _EDGE_PX * jump_v,
        cv2.INTER_NEAREST,
        borderMode=cv2.BORDER_REPLICATE,
    )
    high = cv2.dilate(disparity, np.ones((5, 5), np.uint8))
    low = cv2.erode(disparity, np.ones((5, 5), np.uint8))
    edge = high - low > 1.2
    mixed = edge & (dice > 0.9)
    read = np.where(mixed, cv2.blur(disparity, (3, 3)), read)
    read = read + np.float32(sensor.disparity_sd_px) * noise + sensor.pattern_px
    steps = np.round(read / STEP_PX) * STEP_PX
    out = np.round(COUNTS_PER_M * sensor.scale * DISPARITY_PX_M / steps)
    # The projector stands to the left: what a nearer thing hides from it, further left, is dark.
    column = u + disparity
    dark = column < np.maximum.accumulate(column, axis=1) - 1.0
    slope = np.maximum(np.abs(np.gradient(depth_m, axis=0)), np.abs(np.gradient(depth_m, axis=1)))
    blind = dark | (edge & (dice < -1.1)) | ((slope > _GRAZING) & (dice < 0.3)) | (noise * dice > 6.5)
    return np.where(blind, 0, out).astype(np.uint16)


def _rolled(bank: tuple[FloatImage, ...], rng: np.random.Generator) -> FloatImage:
    """One of the drawn noises, shifted: new for every frame without being drawn for it."""
    one = bank[int(rng.integers(len(bank)))]
    down, right, flip = int(rng.integers(one.shape[0])), int(rng.integers(one.shape[1])), int(rng.integers(2))
    return np.roll(one, (down, right), axis=(0, 1)) * np.float32(1 - 2 * flip)
