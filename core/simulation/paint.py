"""The colours on the skin: mottled flesh, knuckles, nails, sleeve, and round spots of paper."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from carpus.core.camera import Camera
from carpus.core.simulation.appearance import Appearance
from carpus.core.simulation.trace import Box, FloatImage, box_around
from carpus.core.types import FloatArray

_EDGE_ON = 0.02
_LARGEST_SAG_M, _HIDING_GAP_M = 0.004, 0.004


@dataclass(frozen=True, slots=True)
class Patch:
    """A round piece of blue paper in camera axes; ``normal`` towards the camera, ``bend`` 0 flat to 1 like the skin."""

    center_m: FloatArray
    normal: FloatArray
    radius_m: float
    color: FloatArray
    bend: float


_BAND_EDGE_M = np.float32(0.0012)
_RING_M, _RING_SHARE, _RING_AWAY_M = 0.002, 0.5, 0.011
"""Half width of a ring, its place on the bone, and how far from the bone it may lie."""
_KNUCKLES = (2, 3, 6, 7, 10, 11, 14, 15, 18, 19)
_NAILS = (4, 8, 12, 16, 20)
_KNUCKLE_RADIUS_M, _NAIL_RADIUS_M = 0.006, 0.0048
_KNUCKLE_TINT = np.array([0.05, 0.13, 0.12], dtype=np.float32)
_NAIL_TINT = np.array([1.10, 1.12, 1.16], dtype=np.float32)


def spot_on(
    camera: Camera, box: Box, points: FloatImage, center_m: FloatArray, radius_m: float
) -> tuple[tuple[slice, slice], FloatImage] | None:
    """Where in ``points`` (over ``box``, camera axes) the surface lies within a radius of a point, and how much of
    each of those pixels; None when that is outside the box."""
    around = box_around(camera, center_m[None], np.array([radius_m]), margin_px=2.0)
    around = Box(
        max(around.top, box.top),
        min(around.bottom, box.bottom),
        max(around.left, box.left),
        min(around.right, box.right),
    )
    if around.bottom - around.top < 3 or around.right - around.left < 3:
        return None
    place = around.within(box)
    away = np.linalg.norm(points[place] - center_m.astype(np.float32), axis=-1)
    along_v, along_u = np.gradient(away)
    # Within half a pixel of the edge the spot fills part of a pixel.
    share = np.clip(0.5 - (away - radius_m) / np.maximum(np.hypot(along_u, along_v), 1e-5), 0.0, 1.0)
    return place, share.astype(np.float32)


def patch_on(
    camera: Camera, rays: tuple[FloatImage, FloatImage], depth_m: FloatImage, patch: Patch
) -> tuple[tuple[slice, slice], FloatImage, FloatImage] | None:
    """Where a paper patch shows in the whole picture: rows and columns, share of each pixel, depth of the paper.

    ``rays`` are the rays' x and y where z is 1. Paper is stiffer than skin: between its tangent plane and the skin
    under it, it goes ``patch.bend`` of the way; it lies on skin that rises. Whatever stands clearly before it hides it.
    """
    box = box_around(camera, patch.center_m[None], np.array([patch.radius_m]), margin_px=2.0)
    if box.bottom - box.top < 3 or box.right - box.left < 3:
        return None
    rows, columns = box.slices
    x, y = rays[0][None, columns], rays[1][rows, None]
    n, c = patch.normal, patch.center_m
    toward = n[0] * x + n[1] * y + n[2]
    if float(toward.max()) > -_EDGE_ON:
        return None
    plane = (float(c @ n) / toward).astype(np.float32)
    behind = depth_m[rows, columns]
    gap = behind - plane
    z = plane + np.where(gap > 0.0, np.float32(patch.bend) * np.minimum(gap, _LARGEST_SAG_M), gap)
    away = np.sqrt((x * z - c[0]) ** 2 + (y * z - c[1]) ** 2 + (z - c[2]) ** 2)
    along_v, along_u = np.gradient(away)
    share = np.clip(0.5 - (away - patch.radius_m) / np.maximum(np.hypot(along_u, along_v), 1e-5), 0.0, 1.0)
    share *= gap > -_HIDING_GAP_M
    return (rows, columns), share.astype(np.float32), z.astype(np.float32)


def lay(image: FloatImage, place: tuple[slice, slice], share: FloatImage, color: FloatArray) -> None:
    """Cover a place of ``image`` with a colour, by share."""
    inner = image[place]
    inner += share[..., None] * (color.astype(np.float32) - inner)


def painted_skin(looks: Appearance, points: FloatImage, discs_cam_m: FloatArray, hand_axes: FloatArray) -> FloatImage:
    """Albedo (H, W, 3) of bare skin; ``discs_cam_m`` (21, 3) tell where knuckles and nails are, ``hand_axes``
    (3, 3) fix the mottling to the hand."""
    coarse = points[::2, ::2]
    size = (points.shape[1], points.shape[0])
    local = (coarse - discs_cam_m[0].astype(np.float32)) @ hand_axes.astype(np.float32)
    waves = np.zeros(coarse.shape[:2], dtype=np.float32)
    for direction in looks.mottling:
        waves += np.sin(local @ direction.astype(np.float32))
    mottled = np.float32(1.0) + np.float32(0.016) * waves
    red = np.zeros_like(waves)
    for row in _KNUCKLES:
        red += _ball(coarse, discs_cam_m[row], _KNUCKLE_RADIUS_M)
    full = cv2.resize(np.dstack((mottled, np.minimum(red, 1.0))), size, interpolation=cv2.INTER_LINEAR)
    tint = np.float32(1.0) - full[..., 1:] * _KNUCKLE_TINT
    return np.asarray(looks.skin.astype(np.float32) * full[..., :1] * tint, dtype=np.float32)


def _ball(points: FloatImage, center_m: FloatArray, radius_m: float) -> FloatImage:
    offset = points - center_m.astype(np.float32)
    return np.asarray(np.exp(np.einsum("hwi,hwi->hw", offset, offset) * np.float32(-0.5 / radius_m**2)))


def paint_nails(
    albedo: FloatImage, camera: Camera, box: Box, points: FloatImage, discs_cam_m: FloatArray, size: float
) -> None:
    """Nails are a little lighter than the skin around them."""
    for row in _NAILS:
        spot = spot_on(camera, box, points, discs_cam_m[row], _NAIL_RADIUS_M * size)
        if spot is not None:
            place, share = spot
            albedo[place] *= 1.0 + share[..., None] * (_NAIL_TINT - 1.0)


def dress(
    albedo: FloatImage, looks: Appearance, points: FloatImage, is_forearm: np.ndarray, wrist_m: FloatArray,
    forearm_axis: FloatArray,
) -> None:  # fmt: skip
    """Sleeve and what else is worn round the forearm; ``forearm_axis`` points to the hand."""
    if not looks.bands:
        return
    to_wrist = (points - wrist_m.astype(np.float32)) @ forearm_axis.astype(np.float32)
    for band in looks.bands:
        along = to_wrist + np.float32(band.from_m)
        share = np.clip(0.5 - along / _BAND_EDGE_M, 0.0, 1.0) * is_forearm
        if np.isfinite(band.to_m):
            share *= np.clip(0.5 + (to_wrist + np.float32(band.to_m)) / _BAND_EDGE_M, 0.0, 1.0)
        folds = (
            1.0 + 0.06 * np.sin(along * 310.0 + 9.0 * np.sin(along * 41.0)) if band.is_cloth else np.ones_like(along)
        )
        stuff = band.color.astype(np.float32) * folds[..., None]
        albedo += share[..., None] * (stuff - albedo)


def paint_ring(albedo: FloatImage, points: FloatImage, color: FloatArray, bone_m: FloatArray, size: float) -> None:
    """A ring round the first bone of a finger, from joint to joint (2, 3)."""
    along_m = bone_m[1] - bone_m[0]
    length = float(np.linalg.norm(along_m))
    offset = points - bone_m[0].astype(np.float32)
    along = offset @ (along_m / length).astype(np.float32)
    away = np.sqrt(np.maximum(np.einsum("hwi,hwi->hw", offset, offset) - along * along, 0.0))
    share = np.clip(0.5 + (_RING_M - np.abs(along - np.float32(_RING_SHARE * length))) / _BAND_EDGE_M, 0.0, 1.0)
    share *= away < _RING_AWAY_M * size
    albedo += share[..., None].astype(np.float32) * (color.astype(np.float32) - albedo)
