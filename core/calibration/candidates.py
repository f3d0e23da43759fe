"""Discs of a held picture before anything is known of today's colours: what a click can snap to."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import cv2
import numpy as np

from core.camera import Camera
from core.detection import color_histogram
from core.detection.appearance import REACH, expected_radius_px, learn_appearance
from core.detection.components import components
from core.detection.detector import Detector
from core.detection.settings import DetectionSettings
from core.types import Detections, FloatArray, Frame

_BLUE = ((90, 60, 30), (130, 255, 255))
"""Lowest and highest hue, saturation and value of blue paper in any usual light (OpenCV's scales)."""
_TINGED_BLUE = ((85, 50, 25), (145, 255, 255))
"""The same of discs so small that they take on some of the skin; with it a sleeve falls into specks."""
_FEWEST = 3
"""Fewer blue spots are not taken for a marked hand."""
_WINDOW_RADII = 8.0
_MOST_ALIKE = 0.55
"""Bhattacharyya coefficient of a clicked spot to what lies around it, above which it is no paper."""


def marker_candidates(frame: Frame, camera: Camera, settings: DetectionSettings) -> Detections:
    """Every blue disc-sized blob of a picture, exactly placed; none where fewer than three are seen.

    A first, wide search for blue shows what today's paper and skin look like; the detector then finds the discs.
    """
    hsv = color_histogram.to_hsv(frame.color_rgb)
    blue = cv2.inRange(hsv, *(np.array(limit) for limit in _BLUE))
    opened = cv2.morphologyEx(blue, cv2.MORPH_OPEN, np.ones((3, 3), np.uint8))
    spots = _disc_sized(opened, 0.3, frame, camera, settings)
    if len(spots) < _FEWEST:
        tinged = cv2.inRange(hsv, *(np.array(limit) for limit in _TINGED_BLUE))
        spots = _disc_sized(tinged, 0.2, frame, camera, settings)
    if len(spots) < _FEWEST:
        return Detections.none()
    looks, _ = learn_appearance(frame, spots, camera, settings)
    return Detector(looks, camera, settings).detect(frame)


def _disc_sized(mask: Any, least_area: float, frame: Frame, camera: Camera, settings: DetectionSettings) -> FloatArray:
    """Middles (B, 2) of the mask's components that are as large as a disc there, or ``least_area`` of it."""
    found = components((mask > 0).astype(np.uint8), lambda at: _radii_px(frame, at, camera, settings))
    full = np.pi * found.radius_px**2
    return found.centre_px[(found.area_px > least_area * full) & (found.area_px < 2.0 * full)]


def disc_at(frame: Frame, pixel: FloatArray, camera: Camera, settings: DetectionSettings) -> Detections:
    """The disc that covers a pixel (2,), whatever its colour: one blob, or none.

    Only a small window is looked at. A spot that looks like all that lies around it is no disc.
    """
    radius_px = expected_radius_px(frame, pixel, camera, settings)
    half = _WINDOW_RADII * radius_px
    height, width = frame.color_rgb.shape[:2]
    left, top = (int(max(0.0, value - half)) for value in pixel)
    right, bottom = int(min(width, pixel[0] + half + 1)), int(min(height, pixel[1] + half + 1))
    if right - left < half or bottom - top < half:
        return Detections.none()
    depth = None if frame.depth_raw is None else np.ascontiguousarray(frame.depth_raw[top:bottom, left:right])
    color = np.ascontiguousarray(frame.color_rgb[top:bottom, left:right])
    part, corner = replace(frame, color_rgb=color, depth_raw=depth), np.array([left, top], dtype=np.float64)
    looks, centre = learn_appearance(part, (pixel - corner)[None], camera, settings)
    if not np.isfinite(centre).all():
        return Detections.none()
    hsv = color_histogram.to_hsv(color)
    v, u = np.ogrid[: color.shape[0], : color.shape[1]]
    squared = (u - centre[0, 0]) ** 2 + (v - centre[0, 1]) ** 2
    ring = (squared > (1.5 * radius_px) ** 2) & (squared < (3.0 * radius_px) ** 2)
    around = color_histogram.histogram(hsv, ring, smooth_bins=1.2)
    if color_histogram.bhattacharyya(looks.paper_histogram.ravel(), around.ravel()) > _MOST_ALIKE:
        return Detections.none()
    window = Detector(looks, camera, settings).region_about(centre, np.zeros((1, 2, 2)), np.array([0.5]))
    return _nearest(_moved(Detector(looks, camera, settings).detect(part, window), corner), pixel, radius_px)


def snapped(blobs: Detections, pixel: FloatArray, radius_px: float) -> Detections:
    """The blob within a click's reach of a pixel (2,), the nearest one: one blob, or none."""
    return _nearest(blobs, pixel, radius_px)


def _radii_px(frame: Frame, centre_px: FloatArray, camera: Camera, settings: DetectionSettings) -> FloatArray:
    return np.array([expected_radius_px(frame, at, camera, settings) for at in centre_px])


def _nearest(blobs: Detections, pixel: FloatArray, radius_px: float) -> Detections:
    distance = np.linalg.norm(blobs.pixel - pixel, axis=1)
    if not distance.size or float(distance.min()) > REACH * radius_px:
        return Detections.none()
    one = slice(int(distance.argmin()), int(distance.argmin()) + 1)
    return Detections(
        blobs.pixel[one], blobs.depth_m[one], blobs.depth_sd_m[one], blobs.area_px[one], blobs.similarity[one]
    )


def _moved(blobs: Detections, corner_px: FloatArray) -> Detections:
    return replace(blobs, pixel=blobs.pixel + corner_px)
