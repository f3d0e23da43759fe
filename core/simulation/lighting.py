"""Light on traced surfaces: shading, darker corners, the shadow of the hand on the table."""

from __future__ import annotations

import cv2
import numpy as np

from carpus.core.camera import Camera
from carpus.core.simulation.appearance import Appearance
from carpus.core.simulation.trace import FloatImage, TracedSurface
from carpus.core.types import FloatArray

_GLOSS, _GLOSS_POWER = 0.05, 24
_SHADOW_STRENGTH = 0.8
_CORNER_DEPTH_M = 0.02
_COARSE = 3


def shaded_skin(albedo: FloatImage, normal: FloatImage, corners: FloatImage, looks: Appearance) -> FloatImage:
    """Linear colour (H, W, 3) of skin under lamp and ambient light, with a faint gloss."""
    facing_lamp = np.clip(normal @ looks.light_cam.astype(np.float32), 0.0, 1.0)
    # Light scattered inside the skin softens the terminator.
    lambert = np.float32(0.85) * facing_lamp + np.float32(0.15) * np.sqrt(facing_lamp)
    half = looks.light_cam + np.array([0.0, 0.0, -1.0])
    half = (half / np.linalg.norm(half)).astype(np.float32)
    gloss = np.float32(_GLOSS) * np.clip(normal @ half, 0.0, 1.0) ** _GLOSS_POWER
    facing = (np.float32(0.65) + np.float32(0.35) * np.clip(-normal[..., 2], 0.0, 1.0)) * corners
    out = np.empty_like(albedo)
    for channel in range(3):
        lamp, ambient = np.float32(looks.lamp[channel]), np.float32(looks.ambient[channel])
        out[..., channel] = albedo[..., channel] * (lambert * lamp + facing * ambient) + gloss * lamp
    return out


def corner_light(skin: TracedSurface, background_m: FloatImage) -> FloatImage:
    """Share of the ambient light that reaches each pixel: less where its neighbourhood is nearer to the camera."""
    around = np.where(skin.coverage > 0.5, skin.depth_m, background_m)
    small = around
    if min(around.shape) > 1:  # of a hand about to leave the picture one column may be left
        small = cv2.resize(around, None, fx=0.5, fy=0.5, interpolation=cv2.INTER_AREA)
    soft = cv2.GaussianBlur(small, (0, 0), 4.0)
    deeper = np.clip((small - soft) / _CORNER_DEPTH_M, 0.0, 1.0)
    size = (around.shape[1], around.shape[0])
    return np.asarray(1.0 - 0.5 * cv2.resize(deeper, size, interpolation=cv2.INTER_LINEAR), dtype=np.float32)


def shadow_on_table(
    camera: Camera, skin: TracedSurface, to_lamp: FloatArray, table_normal: FloatArray, table_point_m: FloatArray
) -> FloatImage:
    """Share of the lamp's light (H, W) that the table gets; softer the higher the hand is above it."""
    v, u = np.nonzero(skin.coverage[::_COARSE, ::_COARSE] > 0.5)
    z = skin.depth_m[::_COARSE, ::_COARSE][v, u].astype(np.float64)
    shape = (camera.height_px // _COARSE, camera.width_px // _COARSE)
    small = np.zeros(shape, dtype=np.float32)
    softness_px = 2.0
    if z.size:
        pixel = np.stack((u * _COARSE + skin.box.left, v * _COARSE + skin.box.top), axis=-1).astype(np.float64)
        points = camera.back_project(pixel, z)
        height = (points - table_point_m) @ table_normal
        ground = points - to_lamp * (height / (to_lamp @ table_normal))[:, None]
        spot = np.round(camera.project(ground) / _COARSE).astype(np.int64)
        inside = (spot >= 0).all(axis=1) & (spot[:, 0] < shape[1]) & (spot[:, 1] < shape[0])
        small[spot[inside, 1], spot[inside, 0]] = 1.0
        softness_px += 0.12 * float(np.median(height)) / float(np.median(z)) * camera.fx_px / _COARSE
    soft = cv2.GaussianBlur(cv2.dilate(small, np.ones((3, 3), np.uint8)), (0, 0), softness_px)
    whole = cv2.resize(soft, (camera.width_px, camera.height_px), interpolation=cv2.INTER_LINEAR)
    return np.asarray(1.0 - _SHADOW_STRENGTH * np.minimum(whole, 1.0), dtype=np.float32)
