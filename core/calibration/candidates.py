"""Marker candidates in a frozen frame, before the appearance of markers is learnt."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from carpus.core.detection import appearance
from carpus.core.detection.appearance import (
    MAX_CLICK_DISTANCE_RADII,
    DetectionSettings,
    disc_mask,
    estimate_radius_px,
    learn_appearance,
)
from carpus.core.detection.blobs import find_components
from carpus.core.detection.detector import Detector
from carpus.core.model.camera import Camera
from carpus.core.model.types import ByteImage, Detections, FloatArray, Frame

PAPER_HSV_RANGE: tuple[tuple[int, ...], ...] = ((90, 60, 30), (130, 255, 255))
"""Lowest and highest hue, saturation and value of blue paper in usual light (OpenCV's scales)."""
TINGED_HSV_RANGE: tuple[tuple[int, ...], ...] = ((85, 50, 25), (145, 255, 255))
"""The same for markers so small that they mix with the skin; a sleeve falls into specks."""
MIN_AREA_RATIO = 0.3
"""Area of a spot over that of a marker."""
MIN_TINGED_AREA_RATIO = 0.2
"""The same for a tinged spot."""
MAX_CANDIDATES = 400
"""Cloth of the paper's hue has more spots than there are markers."""
MIN_CANDIDATES = 3
"""Fewer spots are no marked hand."""
CLICK_WINDOW_RADII = 8.0
"""Half width of the search around a click."""
MAX_BACKGROUND_SIMILARITY = 0.6
"""Bhattacharyya coefficient of spot and surroundings above which it is no paper."""
MIN_CHROMA = 24.0
"""Strongest less weakest channel of 255: paper in a dim room has 60, a dark pullover up to 15."""
MIN_VALUE = 60.0
"""Strongest channel of a spot: 90 on paper in a dim room; the hue of darker spots is random."""
MIN_COLOUR_CONTRAST = 50.0
"""RGB distance of most of the surrounding ring: 65 in a dim room, in cloth rarely 45."""
MIN_CHROMA_SHARE = 0.35
"""All markers are of one paper: spots with less of the median chroma are none."""


def find_marker_candidates(frame: Frame, camera: Camera, settings: DetectionSettings) -> Detections:
    """Detect all blue blobs of a marker's size in a frame; none if fewer than three are found.

    A first, wide search for blue shows the appearance of paper and skin; the detector then finds the markers.
    """
    hsv = appearance.to_hsv(frame.color_rgb)
    blue = cv2.inRange(hsv, *(np.array(limit) for limit in PAPER_HSV_RANGE))
    opened = cv2.morphologyEx(blue, cv2.MORPH_OPEN, np.ones((3, 3), np.uint8))
    spots = _find_marker_sized_spots(opened, MIN_AREA_RATIO, frame, camera, settings)
    spots = spots[is_paper(spots, frame, hsv, camera, settings)]
    if len(spots) < MIN_CANDIDATES:
        tinged = cv2.inRange(hsv, *(np.array(limit) for limit in TINGED_HSV_RANGE))
        spots = _find_marker_sized_spots(tinged, MIN_TINGED_AREA_RATIO, frame, camera, settings)
        spots = spots[is_paper(spots, frame, hsv, camera, settings)]
    if len(spots) < MIN_CANDIDATES:
        return Detections.none()
    marker_appearance, _ = learn_appearance(frame, spots, camera, settings)
    # Cloth of the paper's hue has more spots than there are markers, which must not crowd these out.
    found = Detector(marker_appearance, camera, replace(settings, max_blobs=MAX_CANDIDATES)).detect(frame)
    kept = is_paper(found.pixel, frame, hsv, camera, settings)
    return found.subset(kept) if np.count_nonzero(kept) >= MIN_CANDIDATES else Detections.none()


def is_paper(
    pixel: FloatArray, frame: Frame, hsv: ByteImage, camera: Camera, settings: DetectionSettings
) -> NDArray[np.bool_]:
    """Select the spots (B, 2) that have a colour unlike their surroundings, and about as much as the others.

    Dark cloth falls into specks whose hue is blue by chance; they have hardly any chroma.
    """
    chroma = np.zeros(len(pixel))
    for i, (centre, radius_px) in enumerate(
        zip(pixel, estimate_radius_px(frame, pixel, camera, settings), strict=True)
    ):
        others = pixel[(np.abs(pixel - centre).max(axis=1) < 4.0 * radius_px) & (np.arange(len(pixel)) != i)]
        chroma[i] = _chroma(frame.color_rgb, hsv, centre, radius_px, others)
    is_coloured = chroma >= MIN_CHROMA
    usual = float(np.median(chroma[is_coloured])) if is_coloured.any() else 0.0
    return np.asarray(is_coloured & (chroma >= MIN_CHROMA_SHARE * usual))


def _chroma(
    color_rgb: ByteImage, hsv: ByteImage, centre_px: FloatArray, radius_px: float, neighbours_px: FloatArray
) -> float:
    """Return the chroma of a spot, 0 if it looks like its surroundings."""
    half = int(3.0 * radius_px) + 2
    left, top = (max(0, round(float(value)) - half) for value in centre_px)
    rows, columns = slice(top, top + 2 * half + 1), slice(left, left + 2 * half + 1)
    rgb, part = color_rgb[rows, columns].astype(np.float64), hsv[rows, columns]
    shape, centre = part.shape[:2], centre_px - (left, top)
    spot = disc_mask(shape, centre, 0.7 * radius_px)
    ring = disc_mask(shape, centre, 2.6 * radius_px) & ~disc_mask(shape, centre, 1.6 * radius_px)
    for other in neighbours_px:  # the two markers of a fingertip nearly touch
        ring &= ~disc_mask(shape, other - (left, top), 1.3 * radius_px)
    if not spot.any() or not ring.any():
        return 0.0
    step = np.linalg.norm(rgb[ring] - np.median(rgb[spot], axis=0), axis=1)
    spot_histogram, ring_histogram = (
        appearance.compute_histogram(part, mask, smooth_bins=1.2).ravel() for mask in (spot, ring)
    )
    similarity = appearance.compute_bhattacharyya(spot_histogram, ring_histogram)
    if np.quantile(step, 0.7) < MIN_COLOUR_CONTRAST or similarity > MAX_BACKGROUND_SIMILARITY:
        return 0.0
    if np.median(rgb[spot].max(axis=1)) < MIN_VALUE:
        return 0.0
    return float(np.median(rgb[spot].max(axis=1) - rgb[spot].min(axis=1)))


def _find_marker_sized_spots(
    mask: Any, min_area_ratio: float, frame: Frame, camera: Camera, settings: DetectionSettings
) -> FloatArray:
    """Return the centres (B, 2) of the mask's components that have about a marker's area."""
    found = find_components((mask > 0).astype(np.uint8), lambda at: estimate_radius_px(frame, at, camera, settings))
    full = np.pi * found.radius_px**2
    return found.centre_px[(found.area_px > min_area_ratio * full) & (found.area_px < 2.0 * full)]


def find_marker_at_click(frame: Frame, pixel: FloatArray, camera: Camera, settings: DetectionSettings) -> Detections:
    """Detect the marker that covers a pixel (2,), whatever its colour: one blob, or none.

    Only a small window is searched. A spot that looks like its surroundings is no marker.
    """
    radius_px = float(estimate_radius_px(frame, pixel[None], camera, settings)[0])
    half = CLICK_WINDOW_RADII * radius_px
    height, width = frame.color_rgb.shape[:2]
    left, top = (int(max(0.0, value - half)) for value in pixel)
    right, bottom = int(min(width, pixel[0] + half + 1)), int(min(height, pixel[1] + half + 1))
    if right - left < half or bottom - top < half:
        return Detections.none()
    depth = None if frame.depth_raw is None else np.ascontiguousarray(frame.depth_raw[top:bottom, left:right])
    color = np.ascontiguousarray(frame.color_rgb[top:bottom, left:right])
    part, corner = replace(frame, color_rgb=color, depth_raw=depth), np.array([left, top], dtype=np.float64)
    marker_appearance, centre = learn_appearance(part, (pixel - corner)[None], camera, settings)
    if not np.isfinite(centre).all():
        return Detections.none()
    hsv = appearance.to_hsv(color)
    shape = color.shape[:2]
    ring = disc_mask(shape, centre[0], 3.0 * radius_px) & ~disc_mask(shape, centre[0], 1.5 * radius_px)
    around = appearance.compute_histogram(hsv, ring, smooth_bins=1.2).ravel()
    similarity = appearance.compute_bhattacharyya(marker_appearance.paper_histogram.ravel(), around)
    if similarity > MAX_BACKGROUND_SIMILARITY:
        return Detections.none()
    if not is_paper(centre + corner, frame, appearance.to_hsv(frame.color_rgb), camera, settings).all():
        return Detections.none()
    detector = Detector(marker_appearance, camera, settings)
    found = detector.detect(part, detector.compute_search_region(centre, np.zeros((1, 2, 2)), np.array([0.5])))
    return find_nearest_blob(replace(found, pixel=found.pixel + corner), pixel, radius_px, settings)


def find_nearest_blob(
    blobs: Detections, pixel: FloatArray, radius_px: float, settings: DetectionSettings
) -> Detections:
    """Return the nearest blob within a click's reach of a pixel (2,): one blob, or none."""
    distance = np.linalg.norm(blobs.pixel - pixel, axis=1)
    if not distance.size or float(distance.min()) > MAX_CLICK_DISTANCE_RADII * radius_px:
        return Detections.none()
    return blobs.subset(np.arange(distance.size) == distance.argmin())
