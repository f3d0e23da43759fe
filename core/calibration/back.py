"""The surface of the back of the hand, learnt from the depth pictures of the still hand at the start."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from carpus.core.calibration.result import Calibration
from carpus.core.camera import Camera
from carpus.core.hand.back_surface import BackSurface, BackSurfaceSettings, back_surface_from
from carpus.core.types import Frame

_CORNERS = 4
"""WRIST, CMC1, MCP2 and MCP3 come first in every protocol's palm."""


@dataclass(frozen=True, slots=True)
class BackSettings:
    """Readings are taken as far as ``margin_px`` around the discs, where a share ``often`` of the pictures had one;
    ``surface`` through them."""

    margin_px: float = 14.0
    often: float = 0.5
    surface: BackSurfaceSettings = field(default_factory=BackSurfaceSettings)


def surface_of(
    calibration: Calibration, still: Sequence[Frame], camera: Camera, settings: BackSettings
) -> BackSurface | None:
    """The surface over capitate, second and third metacarpal, from the mean of the still frames' depths; None where
    too little of it was seen."""
    corner = calibration.marker_position_w0_m[list(calibration.clicks.protocol.palm[:_CORNERS])]
    in_camera = corner @ calibration.rotation_w0_cam.T + calibration.translation_w0_cam_m
    pixel = camera.distort(camera.project(in_camera))
    left, top = np.maximum(pixel.min(axis=0) - settings.margin_px, 0.0).astype(int).tolist()
    right, bottom = (pixel.max(axis=0) + settings.margin_px).astype(int).tolist()
    cut = [
        frame.depth_raw[top : bottom + 1, left : right + 1].astype(np.float64) * frame.depth_unit_m
        for frame in still
        if frame.depth_raw is not None
    ]
    if not cut or cut[0].size == 0:
        return None
    depth = np.stack(cut)
    count = (depth > 0.0).sum(axis=0)
    row, column = np.nonzero(count >= max(1.0, settings.often * len(cut)))
    depth_m = depth[:, row, column].sum(axis=0) / count[row, column]
    seen_px = camera.undistort(np.stack((column + left, row + top), axis=1).astype(np.float64))
    point = camera.back_project(seen_px, depth_m)
    in_w0 = (point - calibration.translation_w0_cam_m) @ calibration.rotation_w0_cam
    return back_surface_from(in_w0, corner, settings.surface)
