"""Lays a depth camera's pictures on those of the colour camera beside it."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from carpus.core.camera import Camera
from carpus.core.capture.lens_bending import LensBending, straight_pixels
from carpus.core.types import FloatArray

_NOTHING = np.iinfo(np.uint16).max


class DepthOnColor:
    """Moves each reading to where the colour camera sees it; the nearer of two wins, no reading is mixed with another.

    ``rotation`` and ``translation_m`` lead from the depth camera's axes into the colour camera's; ``shrink`` pixels of
    the colour camera, across and down, are one of the picture that is made.
    """

    def __init__(
        self, depth: Camera, color: Camera, rotation: FloatArray, translation_m: FloatArray, shrink: int = 1
    ) -> None:
        pixels = straight_pixels(depth).reshape(-1, 2).astype(np.float64)
        rays = depth.back_project(pixels, np.ones(len(pixels)))
        self._rays = (rays @ rotation.T).astype(np.float32)
        self._shift_mm = (translation_m * 1000.0).astype(np.float32)
        self._color = color
        self._footprint = max(1, math.ceil(color.fx_px / depth.fx_px - 0.05))
        """So many pixels of the colour picture, across and down, one of the depth picture covers."""
        self._bending = LensBending(color, shrink)

    def lay(self, depth_mm: NDArray[np.uint16]) -> NDArray[np.uint16]:
        """Depth (H, W), millimetres along the colour camera's axis, of depth (h, w), millimetres; 0: none."""
        width, height = self._color.width_px, self._color.height_px
        flat = depth_mm.reshape(-1)
        known = np.flatnonzero(flat)
        x, y, z = (self._rays[known] * flat[known, None].astype(np.float32) + self._shift_mm).T
        ahead = (z > 1.0) & (z < _NOTHING)
        x, y, z = x[ahead], y[ahead], z[ahead]
        order = np.argsort(-z)  # of what falls on one pixel the last that is written stays: the nearest
        x, y, z = x[order], y[order], z[order]
        begin = (self._footprint - 1) / 2.0
        u = np.rint(self._color.fx_px * x / z + self._color.cx_px - begin).astype(np.int64)
        v = np.rint(self._color.fy_px * y / z + self._color.cy_px - begin).astype(np.int64)
        readings = np.rint(z).astype(np.uint16)
        laid = np.full(height * width, _NOTHING, np.uint16)
        for down in range(self._footprint):
            for across in range(self._footprint):
                column, row = u + across, v + down
                inside = (column >= 0) & (column < width) & (row >= 0) & (row < height)
                place = row[inside] * width + column[inside]
                layer = np.full(height * width, _NOTHING, np.uint16)
                layer[place] = readings[inside]
                np.minimum(laid, layer, out=laid)
        laid[laid == _NOTHING] = 0
        bent: NDArray[np.uint16] = self._bending.bend(laid.reshape(height, width))
        return bent
