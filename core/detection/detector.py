"""The detector: one picture and, where there is one, a predicted region to blobs with centres and depths."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from core.camera import Camera
from core.detection import color_histogram
from core.detection.appearance import MarkerAppearance, paper_mask
from core.detection.blobs import Outline, blob_depths, outlines, refined_centres
from core.detection.components import Components, components
from core.detection.settings import DetectionSettings
from core.detection.stencil import stencil_for, window_pixels
from core.types import ByteImage, Detections, FloatArray, Frame

_COARSE = 4
"""The hand's region is looked for in a picture this many times smaller."""
_SIMILARITY_BINS = 16
_SATURATION_SHIFT = 3  # 256 levels to 32 bins
_SKIN_LEVEL = 128


@dataclass(frozen=True, slots=True)
class Region:
    """Rectangle of the picture, pixels; ``right`` and ``bottom`` are just outside."""

    left: int
    top: int
    right: int
    bottom: int

    def clipped(self, width: int, height: int) -> Region:
        return Region(max(self.left, 0), max(self.top, 0), min(self.right, width), min(self.bottom, height))

    @property
    def is_empty(self) -> bool:
        return self.right - self.left < 8 or self.bottom - self.top < 8


class Detector:
    """Finds blobs of the learnt colour. Keeps no memory between pictures."""

    def __init__(self, looks: MarkerAppearance, camera: Camera, settings: DetectionSettings) -> None:
        self._looks = looks
        self._camera = camera
        self._settings = settings
        coarse = looks.paper_histogram.reshape(_SIMILARITY_BINS, 2, _SIMILARITY_BINS, 2).sum(axis=(1, 3))
        self._reference = np.sqrt(coarse.ravel())
        self._is_skin = looks.skin_lookup.ravel() >= _SKIN_LEVEL
        bins = color_histogram.BINS
        self._hue_bin = np.minimum(np.arange(256) * bins // 180, bins - 1)

    def region_about(self, pixel: FloatArray, covariance_px2: FloatArray, depth_m: FloatArray) -> Region:
        """Rectangle that holds all predicted discs (M, 2) with their uncertainty (M, 2, 2)."""
        sd = np.sqrt(np.maximum(np.diagonal(covariance_px2, axis1=-2, axis2=-1), 0.0))
        radius = self._camera.fx_px * self._settings.marker_radius_m / np.maximum(depth_m, 0.2)
        margin = np.minimum(self._settings.region_sd * sd, 120.0) + 2.2 * radius[:, None] + 3.0
        low, high = (pixel - margin).min(axis=0), (pixel + margin).max(axis=0)
        return Region(
            int(np.floor(low[0])), int(np.floor(low[1])), int(np.ceil(high[0])) + 1, int(np.ceil(high[1])) + 1
        ).clipped(self._camera.width_px, self._camera.height_px)

    def detect(self, frame: Frame, region: Region | None = None) -> Detections:
        """Blobs inside a region, or in the whole picture when there is none."""
        height, width = frame.color_rgb.shape[:2]
        region = self._hand_region(frame.color_rgb) if region is None else region.clipped(width, height)
        if region is None or region.is_empty:
            return Detections.none()
        color = frame.color_rgb[region.top : region.bottom, region.left : region.right]
        hsv = color_histogram.to_hsv(color)
        mask = paper_mask(hsv, self._looks, self._settings)
        blobs = components(mask, lambda centre_px: self._radius_at(frame, region, centre_px))
        full, area = np.pi * blobs.radius_px**2, blobs.area_px
        fits = np.flatnonzero(
            (area >= self._settings.least_area * self._looks.least_share * full)
            & (area <= self._settings.most_area * self._looks.most_share * full)
        )
        if fits.size == 0:
            return Detections.none()
        if fits.size > self._settings.most_blobs:
            fits = fits[np.argsort(-area[fits])[: self._settings.most_blobs]]
        return self._measure(frame, region, color, hsv, blobs, fits)

    def _radius_at(self, frame: Frame, region: Region, centre_px: FloatArray) -> FloatArray:
        """Radius in pixels (B,) of a disc facing the camera at the depth of each place; NaN-free."""
        usual_m = 0.7
        depth_m = np.full(centre_px.shape[0], usual_m)
        if frame.depth_raw is not None and centre_px.shape[0]:
            column = np.rint(centre_px[:, 0]).astype(np.int64) + region.left
            row = np.rint(centre_px[:, 1]).astype(np.int64) + region.top
            there = frame.depth_raw[row, column] * frame.depth_unit_m
            depth_m = np.where(there > 0.2, there, usual_m)
        return np.asarray(self._camera.fx_px * self._settings.marker_radius_m / depth_m)

    def _measure(
        self,
        frame: Frame,
        region: Region,
        color: ByteImage,
        hsv: ByteImage,
        blobs: Components,
        fits: NDArray[np.int64],
    ) -> Detections:
        settings, labels = self._settings, blobs.labels
        own, rough_px = blobs.label[fits], blobs.centre_px[fits]
        stencil = stencil_for(float(np.median(blobs.radius_px[fits])))
        pixels, inside, middle = window_pixels(stencil, rough_px, labels.shape)
        outline = outlines(labels.reshape(-1)[pixels], own, inside, stencil)
        similarity, skin_share = self._likeness(hsv.reshape(-1, 3)[pixels], outline)
        window = color.reshape(-1, 3)[pixels].astype(np.float32)
        offset, area = refined_centres(window, outline, inside, stencil)
        centre = middle + offset + (region.left, region.top)
        if frame.depth_raw is None:
            depth = np.full(own.size, np.nan)
            depth_sd = depth
        else:
            raw = frame.depth_raw[region.top : region.bottom, region.left : region.right]
            depth, depth_sd = blob_depths(raw.reshape(-1)[pixels], outline.core, frame.depth_unit_m, stencil, settings)
        keep = (similarity >= self._looks.least_similarity) & (skin_share >= settings.skin_share)
        return Detections(centre[keep], depth[keep], depth_sd[keep], area[keep], similarity[keep])

    def _likeness(self, hsv: ByteImage, outline: Outline) -> tuple[FloatArray, FloatArray]:
        """Bhattacharyya coefficient (B,) of each blob's colours to the reference; share (B,) of skin in its rim.

        ``hsv`` (B, P, 3) windows.
        """
        bins = color_histogram.BINS
        hue = self._hue_bin[hsv[..., 0]]
        saturation = hsv[..., 1] >> _SATURATION_SHIFT
        skin = self._is_skin[hue * bins + saturation] & outline.rim
        skin_share = skin.sum(axis=1) / np.maximum(outline.rim.sum(axis=1), 1)
        coarse = (hue >> 1) * _SIMILARITY_BINS + (saturation >> 1)
        blob, pixel = np.nonzero(outline.mine)
        cells = _SIMILARITY_BINS**2
        total = hsv.shape[0]
        counts = np.bincount(blob * cells + coarse[blob, pixel], minlength=total * cells).reshape(total, cells)
        shares = counts / np.maximum(counts.sum(axis=1, keepdims=True), 1)
        return np.asarray(np.sqrt(shares) @ self._reference), np.asarray(skin_share)

    def _hand_region(self, color_rgb: ByteImage) -> Region | None:
        """Rectangle about the skin and paper of the largest hand-like region, None when there is no paper."""
        small = cv2.resize(color_rgb, None, fx=1 / _COARSE, fy=1 / _COARSE, interpolation=cv2.INTER_AREA)
        hsv = color_histogram.to_hsv(np.asarray(small, dtype=np.uint8))
        paper = color_histogram.back_project(hsv, self._looks.paper_lookup) >= 96
        if not paper.any():
            return None
        skin = color_histogram.back_project(hsv, self._looks.skin_lookup) >= _SKIN_LEVEL
        near_skin = cv2.dilate(skin.astype(np.uint8), np.ones((7, 7), np.uint8)) > 0
        row, column = np.nonzero(paper & near_skin)
        if row.size == 0:
            return None
        margin = 4
        return Region(
            int((column.min() - margin) * _COARSE),
            int((row.min() - margin) * _COARSE),
            int((column.max() + 1 + margin) * _COARSE),
            int((row.max() + 1 + margin) * _COARSE),
        ).clipped(color_rgb.shape[1], color_rgb.shape[0])
