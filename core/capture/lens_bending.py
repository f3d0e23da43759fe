"""Depth laid on what an ideal lens would see, bent to where the real colour lens shows it."""

from __future__ import annotations

from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from carpus.core.camera import Camera

NODE_PX = 8
"""Straightening a strong lens takes many rounds: it is done at each eighth pixel, and straight in between. The library
that goes between counts in 1/32: eighths are exact."""


def straight_pixels(camera: Camera, shrink: int = 1) -> NDArray[np.float32]:
    """Where an ideal lens would show what this one shows at its pixels, (H, W, 2); ``shrink`` of its pixels, across
    and down, are one of the picture asked about, whose middle is meant."""
    width, height = camera.width_px // shrink, camera.height_px // shrink
    across, down = (np.arange(0, side + NODE_PX, NODE_PX, dtype=np.float64) for side in (width, height))
    # half-pixel centres: the middle of a pixel lies at a whole number
    nodes = (np.stack(np.meshgrid(across, down), axis=-1).reshape(-1, 2) + 0.5) * shrink - 0.5
    straight = camera.undistort(nodes).reshape(len(down), len(across), 2).astype(np.float32)
    u, v = np.meshgrid(np.arange(width, dtype=np.float32), np.arange(height, dtype=np.float32))
    return np.asarray(cv2.remap(straight, u / NODE_PX, v / NODE_PX, cv2.INTER_LINEAR), dtype=np.float32)


class LensBending:
    """Takes depth (H, W) of ``camera`` without its distortion to colour pictures with it, whose pixels are ``shrink``
    as wide. Readings are moved, never mixed: a mean would lie between a finger and the table. Without a reading: 0."""

    def __init__(self, camera: Camera, shrink: int = 1) -> None:
        self._maps: tuple[NDArray[np.float32], NDArray[np.float32]] | None = None
        if camera.is_distorted or shrink > 1:
            ideal = straight_pixels(camera, shrink)
            self._maps = np.ascontiguousarray(ideal[..., 0]), np.ascontiguousarray(ideal[..., 1])

    def bend(self, depth: NDArray[Any]) -> NDArray[Any]:
        """Depth (H, W) uint16 as the real lens shows it, (H / shrink, W / shrink)."""
        if self._maps is None:
            return depth
        return np.asarray(
            cv2.remap(depth, *self._maps, cv2.INTER_NEAREST, borderMode=cv2.BORDER_CONSTANT, borderValue=0)
        )
