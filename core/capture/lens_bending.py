"""Depth laid on what an ideal lens would see, bent to where the real colour lens shows it."""

from __future__ import annotations

from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from carpus.core.camera import Camera


class LensBending:
    """Takes depth (H, W) of ``camera`` without its distortion to colour pictures with it, whose pixels are ``shrink``
    as wide. Readings are moved, never mixed: a mean would lie between a finger and the table. Without a reading: 0."""

    def __init__(self, camera: Camera, shrink: int = 1) -> None:
        self._maps: tuple[NDArray[np.float32], NDArray[np.float32]] | None = None
        if camera.is_distorted or shrink > 1:
            across, down = (np.arange(side // shrink) for side in (camera.width_px, camera.height_px))
            # half-pixel centres: the middle of a pixel lies at a whole number
            grid = np.stack(np.meshgrid(across, down), axis=-1).reshape(-1, 2).astype(np.float64)
            ideal = camera.undistort((grid + 0.5) * shrink - 0.5).reshape(len(down), len(across), 2)
            self._maps = ideal[..., 0].astype(np.float32), ideal[..., 1].astype(np.float32)

    def bend(self, depth: NDArray[Any]) -> NDArray[Any]:
        """Depth (H, W) uint16 as the real lens shows it, (H / shrink, W / shrink)."""
        if self._maps is None:
            return depth
        return np.asarray(
            cv2.remap(depth, *self._maps, cv2.INTER_NEAREST, borderMode=cv2.BORDER_CONSTANT, borderValue=0)
        )
