"""Compact raw recordings: only the hand and its surroundings, the rest black and without depth."""

from __future__ import annotations

from collections import deque
from dataclasses import replace

import numpy as np

from carpus.core.model.camera import Camera
from carpus.core.model.hand.protocols import MarkerProtocol
from carpus.core.model.types import Frame, Region, TrackedFrame, TrackStatus

MARGIN_SHARE = {False: 1.5, True: 0.6}
"""Margin around the markers as a share of their box: for the palm alone up to the fingertips and beyond, for the whole
hand about a hand's breadth.
"""
MIN_MARGIN_PX = 48.0
STALE_S = 0.5
"""A hand seen longer ago may have left the region."""
MAX_REGIONS = 2048
"""More than a minute of regions: longer than a frame waits for a slow disk."""


class HandRegions:
    """Image regions of the hand over time; updated by the tracking thread, read by the writing thread."""

    def __init__(self, camera: Camera, protocol: MarkerProtocol) -> None:
        self._camera, self._protocol = camera, protocol
        self._regions: deque[tuple[float, Region | None]] = deque(maxlen=MAX_REGIONS)

    def update(self, tracked: TrackedFrame) -> None:
        self._regions.append((tracked.timestamp_s, compute_hand_region(tracked, self._camera, self._protocol)))

    def find_region(self, time_s: float) -> Region | None:
        """Return the region of the hand at a time; None if the hand is lost or was not tracked recently."""
        for known_s, area in reversed(self._regions.copy()):
            if known_s <= time_s:
                return area if time_s - known_s <= STALE_S else None
        return None

    def crop(self, frame: Frame) -> Frame:
        """Return a frame without what lies outside the region of the hand at its time."""
        return mask_outside(frame, self.find_region(frame.timestamp_s))


def compute_hand_region(tracked: TrackedFrame, camera: Camera, protocol: MarkerProtocol) -> Region | None:
    """Return the image region of the hand and its surroundings; None if the hand is lost."""
    places = tracked.marker_position_cam_m
    known_m = places[np.isfinite(places).all(axis=1)]
    if tracked.status is TrackStatus.LOST or len(known_m) < len(protocol.palm) or (known_m[:, 2] < 0.1).any():
        return None
    pixel = camera.distort(camera.project(known_m))
    seen = tracked.marker_measured_px[np.isfinite(tracked.marker_measured_px).all(axis=1)]
    pixel = np.concatenate((pixel, seen))
    low, high = pixel.min(axis=0), pixel.max(axis=0)
    reach = max(MARGIN_SHARE[protocol.has_fingers] * float((high - low).max()), MIN_MARGIN_PX)
    left, top = np.clip(low - reach, 0.0, [camera.width_px, camera.height_px]).astype(int).tolist()
    right, bottom = np.clip(np.ceil(high + reach), 0.0, [camera.width_px, camera.height_px]).astype(int).tolist()
    return Region(left, top, right, bottom) if right - left > 1 and bottom - top > 1 else None


def mask_outside(frame: Frame, region: Region | None) -> Frame:
    """Return the frame with black colours and no depth outside the region."""
    if region is None:
        return frame
    part = np.s_[region.top : region.bottom, region.left : region.right]
    color = np.zeros_like(frame.color_rgb)
    color[part] = frame.color_rgb[part]
    depth = None
    if frame.depth_raw is not None:
        depth = np.zeros_like(frame.depth_raw)
        depth[part] = frame.depth_raw[part]
    return replace(frame, color_rgb=color, depth_raw=depth)
