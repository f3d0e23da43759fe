"""The detector: one frame and, where there is one, a predicted region to blobs with centres and depths."""

from __future__ import annotations

import math
from dataclasses import dataclass
from statistics import median

import cv2
import numpy as np
from numpy.typing import NDArray

from carpus.core.compiled.blobs import BlobWindows
from carpus.core.detection.appearance import (
    BINS,
    DetectionSettings,
    MarkerAppearance,
    backproject_histogram,
    build_paper_mask,
    classify_paper_colors,
    to_hsv,
)
from carpus.core.detection.blobs import find_components, get_stencil
from carpus.core.model.camera import Camera
from carpus.core.model.types import ByteImage, DepthImage, Detections, FloatArray, Frame, Region

REGION_SD = 4.0  # a disc is searched within so many standard deviations of where it is predicted,
MAX_SEARCH_RADIUS_PX = 120.0  # but no further away
COARSE_FACTOR = 4  # without a prediction the hand is searched in an image so many times smaller
SKIN_LEVEL = 128  # of 255: skin colour from here on
PAPER_LEVEL = 96  # of 255: paper colour from here on, in that image
DEFAULT_DEPTH_M = 0.7  # distance of the hand where none is read

_SIMILARITY_BINS = 16
_MIN_DEPTH_M = 0.2  # no hand is held nearer to a camera


@dataclass(frozen=True, slots=True)
class ColorTable:
    """Tables by colour code, hue + 256 saturation.

    Its ``cell`` (65536,) of the coarse histogram, and whether it ``is_skin`` (65536,) rather than paper;
    ``root_of_share`` (256,) of each cell in the paper's histogram.
    """

    cell: NDArray[np.uint8]
    is_skin: NDArray[np.bool_]
    root_of_share: FloatArray


class Detector:
    """Finds blobs of the learnt colour. Keeps no memory between frames."""

    def __init__(self, appearance: MarkerAppearance, camera: Camera, settings: DetectionSettings) -> None:
        self._appearance = appearance
        self._camera = camera
        self._settings = settings
        self._table, self._is_paper = _build_color_table(appearance), classify_paper_colors(appearance)
        self._min_area = settings.min_area_ratio * appearance.min_area_share
        self._max_area = settings.max_area_ratio * appearance.max_area_share

    def compute_search_region(self, pixel: FloatArray, covariance_px2: FloatArray, depth_m: FloatArray) -> Region:
        """Return the rectangle that holds all predicted discs (M, 2), of covariance (M, 2, 2) and at depths (M,)."""
        disc_px_m, region_sd = self._camera.fx_px * self._settings.marker_radius_m, REGION_SD
        variance = np.maximum(covariance_px2.diagonal(axis1=1, axis2=2), 0.0)
        reach = np.minimum(region_sd * np.sqrt(variance), MAX_SEARCH_RADIUS_PX)
        reach += (2.2 * disc_px_m / np.maximum(depth_m, _MIN_DEPTH_M) + 3.0)[:, None]
        (left, top), (right, bottom) = (pixel - reach).min(axis=0).tolist(), (pixel + reach).max(axis=0).tolist()
        region = Region(math.floor(left), math.floor(top), math.ceil(right) + 1, math.ceil(bottom) + 1)
        return region.clip(self._camera.width_px, self._camera.height_px)

    def detect(self, frame: Frame, region: Region | None = None) -> Detections:
        """Return the blobs inside a region, or in the whole image when there is none."""
        height, width = frame.color_rgb.shape[:2]
        region = self._find_hand_region(frame.color_rgb) if region is None else region.clip(width, height)
        if region is None or region.is_empty:
            return Detections.none()
        if frame.depth_raw is not None and frame.depth_raw.shape != (height, width):
            raise ValueError("the depth picture is not of the size of the colour picture")
        rows, columns = slice(region.top, region.bottom), slice(region.left, region.right)
        color = frame.color_rgb[rows, columns]
        raw = None if frame.depth_raw is None else frame.depth_raw[rows, columns]
        hsv, sensor = to_hsv(color), self._camera.sensor
        mask = build_paper_mask(hsv, self._is_paper, self._appearance.min_brightness)
        blobs = find_components(
            mask, lambda at: self._estimate_radius(raw, frame.depth_unit_m, at), self._min_area, self._max_area
        )
        if not blobs.label.size:
            return Detections.none()
        if blobs.label.size > self._settings.max_blobs:
            blobs = blobs.subset(np.argsort(-blobs.area_px, kind="stable")[: self._settings.max_blobs])
        windows = BlobWindows(blobs, get_stencil(median(blobs.radius_px.tolist()), sensor.edge_px))
        similarity, skin_share = windows.compare_colors(hsv, self._table)
        centre, area = windows.locate_centres(color)
        centre += (region.left, region.top)
        if raw is None:
            depth = depth_sd = np.full(blobs.label.size, np.nan)
        else:
            depth, depth_sd = windows.read_depths(raw, frame.depth_unit_m, sensor)
        # Those that look like a disc and lie on skin.
        return Detections(centre, depth, depth_sd, area, similarity).subset(
            (similarity >= self._appearance.min_similarity) & (skin_share >= self._settings.min_skin_share)
        )

    def _estimate_radius(self, raw: DepthImage | None, unit_m: float, centre_px: FloatArray) -> FloatArray:
        """Return the radius in pixels (B,) of a disc facing the camera at the depth of each place."""
        scale = self._camera.fx_px * self._appearance.radius_m
        if raw is None:
            return np.full(len(centre_px), scale / DEFAULT_DEPTH_M)
        column, row = np.rint(centre_px).astype(np.int64).T
        depth_m = raw[row, column] * unit_m
        return np.asarray(scale / np.where(depth_m > _MIN_DEPTH_M, depth_m, DEFAULT_DEPTH_M))

    def _find_hand_region(self, color_rgb: ByteImage) -> Region | None:
        """Return the rectangle about the paper on skin, None when there is no paper."""
        coarse = COARSE_FACTOR
        small = cv2.resize(color_rgb, None, fx=1 / coarse, fy=1 / coarse, interpolation=cv2.INTER_AREA)
        hsv = to_hsv(np.asarray(small, dtype=np.uint8))
        paper = backproject_histogram(hsv, self._appearance.paper_lookup) >= PAPER_LEVEL
        if not paper.any():
            return None
        skin = backproject_histogram(hsv, self._appearance.skin_lookup) >= SKIN_LEVEL
        near_skin = cv2.dilate(skin.astype(np.uint8), np.ones((7, 7), np.uint8)) > 0
        row, column = np.nonzero(paper & near_skin)
        if row.size == 0:
            return None
        margin = 4
        return Region(
            int((column.min() - margin) * coarse),
            int((row.min() - margin) * coarse),
            int((column.max() + 1 + margin) * coarse),
            int((row.max() + 1 + margin) * coarse),
        ).clip(color_rgb.shape[1], color_rgb.shape[0])


def _build_color_table(appearance: MarkerAppearance) -> ColorTable:
    code = np.arange(1 << 16)
    hue, saturation = np.minimum((code & 255) * BINS // 180, BINS - 1), (code >> 8) * BINS // 256
    coarse = appearance.paper_histogram.reshape(_SIMILARITY_BINS, 2, _SIMILARITY_BINS, 2).sum(axis=(1, 3))
    return ColorTable(
        ((hue >> 1) * _SIMILARITY_BINS + (saturation >> 1)).astype(np.uint8),
        appearance.skin_lookup[hue, saturation] >= SKIN_LEVEL,
        np.sqrt(coarse.ravel()),
    )
