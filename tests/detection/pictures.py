"""Small pictures of discs on a shaded, skin-like ground, made without the program's own renderer."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache

import cv2
import numpy as np

from carpus.core.model.camera import Camera
from carpus.core.model.types import ByteImage, FloatArray, Frame

CAMERA = Camera(525.0, 525.0, 159.5, 119.5, width_px=320, height_px=240)
DISTANCE_M = 0.7
UNIT_M = 1.0 / 5000.0
RADIUS_PX = 525.0 * 0.006 / DISTANCE_M

SKIN = (205, 155, 130)
DARK_SKIN = (105, 70, 52)
TABLE = (95, 92, 88)
PAPERS = {
    "blue": (35, 80, 165),
    "green": (40, 140, 75),
    "red": (185, 30, 45),
    "violet": (120, 50, 150),
    "yellow": (220, 200, 40),
}
PALM_PX = np.array([[160.3, 190.2], [128.6, 172.8], [124.1, 100.7], [146.8, 92.4], [168.2, 97.9], [188.5, 110.1]])
"""Where the discs lie unless told otherwise: a right palm, fingers up."""
_FINE = 8


@dataclass(frozen=True, slots=True)
class Look:
    """Light, camera and surfaces of a picture. ``shading`` is the brightness lost from left to right over the
    hand, ``noise`` the standard deviation of each value, ``chroma`` whether colour is halved across (4:2:2)."""

    paper: tuple[int, int, int] = PAPERS["blue"]
    skin: tuple[int, int, int] = SKIN
    table: tuple[int, int, int] = TABLE
    light: float = 1.0
    shading: float = 0.3
    noise: float = 3.0
    chroma: bool = True


@dataclass(frozen=True, slots=True)
class Extra:
    """Something else in the picture: a disc of a colour with its radius, anywhere."""

    pixel: tuple[float, float]
    radius_px: float
    color: tuple[int, int, int]


def _cover(shape: tuple[int, int], centre: FloatArray, radii: tuple[float, float]) -> tuple[slice, slice, FloatArray]:
    """Share of each pixel that an upright ellipse covers, by sub-pixels; only the part of the picture around it."""
    half_u, half_v = int(radii[0]) + 2, int(radii[1]) + 2
    left, top = max(int(centre[0]) - half_u, 0), max(int(centre[1]) - half_v, 0)
    right, bottom = min(int(centre[0]) + half_u + 2, shape[1]), min(int(centre[1]) + half_v + 2, shape[0])
    fine = (np.arange(_FINE) + 0.5) / _FINE - 0.5
    u = (np.arange(left, right)[:, None] + fine).ravel() - centre[0]
    v = (np.arange(top, bottom)[:, None] + fine).ravel() - centre[1]
    inside = (u / radii[0]) ** 2 + (v[:, None] / radii[1]) ** 2 <= 1.0
    share = inside.reshape(bottom - top, _FINE, right - left, _FINE).mean(axis=(1, 3))
    return slice(top, bottom), slice(left, right), share


@lru_cache(maxsize=1)
def _hand() -> tuple[slice, slice, FloatArray]:
    """The hand: an ellipse of skin in the middle of the picture."""
    return _cover((CAMERA.height_px, CAMERA.width_px), np.array([156.0, 140.0]), (80.0, 95.0))


def picture(
    discs_px: FloatArray,
    look: Look | None = None,
    rng: np.random.Generator | None = None,
    *,
    radius_px: float = RADIUS_PX,
    squeeze: float = 1.0,
    extras: Iterable[Extra] = (),
) -> ByteImage:
    """A hand (an ellipse of skin on a table) with discs; ``squeeze`` narrows them across, as tilted ones are."""
    look = look or Look()
    shape = (CAMERA.height_px, CAMERA.width_px)
    paint = np.empty((*shape, 3))
    paint[:] = look.table
    rows, columns, share = _hand()
    paint[rows, columns] += share[..., None] * (np.array(look.skin) - paint[rows, columns])
    for extra in extras:
        rows, columns, share = _cover(shape, np.array(extra.pixel), (extra.radius_px, extra.radius_px))
        paint[rows, columns] += share[..., None] * (np.array(extra.color) - paint[rows, columns])
    for disc in discs_px:
        rows, columns, share = _cover(shape, disc, (squeeze * radius_px, radius_px))
        paint[rows, columns] += share[..., None] * (np.array(look.paper) - paint[rows, columns])
    light = look.light * (1.0 - look.shading * (np.arange(shape[1]) - 76.0) / 160.0)
    paint *= light[None, :, None]
    if rng is not None:
        paint += look.noise * rng.normal(size=paint.shape)
    color = np.clip(np.rint(paint), 0, 255).astype(np.uint8)
    if not look.chroma:
        return color
    yuv = cv2.cvtColor(color, cv2.COLOR_RGB2YCrCb)
    paired = yuv[:, :, 1:].reshape(shape[0], shape[1] // 2, 2, 2).mean(axis=2)
    yuv[:, :, 1:] = np.rint(np.repeat(paired, 2, axis=1)).astype(np.uint8)
    return np.asarray(cv2.cvtColor(yuv, cv2.COLOR_YCrCb2RGB))


def depth_picture(rng: np.random.Generator | None = None, distance_m: float = DISTANCE_M) -> FloatArray:
    """Hand at a distance, table 5 cm behind it, in metres with the sensor's noise and steps."""
    shape = (CAMERA.height_px, CAMERA.width_px)
    depth = np.full(shape, distance_m + 0.05)
    rows, columns, share = _hand()
    depth[rows, columns] = np.where(share > 0.5, distance_m, depth[rows, columns])
    if rng is not None:
        step = 2.85e-3 * depth**2
        depth = np.rint((depth + 1.425e-3 * depth**2 * rng.normal(size=shape)) / step) * step
    return depth


def frame(color: ByteImage, depth_m: FloatArray | None, index: int = 0) -> Frame:
    raw = None if depth_m is None else np.clip(np.rint(np.nan_to_num(depth_m) / UNIT_M), 0, 65535).astype(np.uint16)
    return Frame(index, 100.0 + index / 30.0, color, raw, UNIT_M)


def match_blobs(found_px: FloatArray, true_px: FloatArray) -> FloatArray:
    """Error (D, 2) of the found centre nearest to each true one."""
    nearest = np.linalg.norm(found_px[None] - true_px[:, None], axis=-1).argmin(axis=1)
    return np.asarray(found_px[nearest] - true_px)
