"""The detector: one picture and, where there is one, a predicted region to blobs with centres and depths."""

from __future__ import annotations

import math
from statistics import median

import cv2
import numpy as np
from numpy.typing import NDArray

from carpus.core.camera import Camera
from carpus.core.detection import appearance
from carpus.core.detection.appearance import MarkerAppearance, is_blue, paper_mask
from carpus.core.detection.blobs import (
    DEPTH_IQR_M,
    DEPTH_VALID_SHARE,
    EDGE_SD_M,
    EDGE_STEP_M,
    MIN_CORE,
    MIN_READINGS,
    MIN_RIM,
    PAPER_HIGH,
    PAPER_LOW,
    SLOPE_SHARE,
    Outline,
    blob_depths,
    outlines,
    refined_centres,
)
from carpus.core.detection.components import (
    BLURRED_EDGE_PX,
    LONG_AXIS_RADII,
    LONG_SIDE_RADII,
    MAX_PARTS,
    SPLIT_ROUNDS,
    Components,
    components,
)
from carpus.core.detection.settings import DetectionSettings
from carpus.core.detection.stencil import Stencil, packed, stencil_for, unpacked, window_pixels
from carpus.core.kernels.choice import NOTHING, Kernels, in_c
from carpus.core.types import ByteImage, Detections, FloatArray, Frame, Region

REGION_SD = 4.0
"""A disc is looked for within so many standard deviations of where it is expected."""
MAX_UNSURE_PX = 120.0
"""However little is known of where a disc is, it is looked for no further away."""
COARSE = 4
"""Without a prediction the hand is looked for in a picture so many times smaller."""
SKIN_LEVEL = 128
"""Of 255: what is of skin's colour from here on."""
PAPER_LEVEL = 96
"""Of 255: what is of paper's colour from here on, in that picture."""
USUAL_DEPTH_M = 0.7
"""Distance of the hand where none is read."""

_SIMILARITY_BINS = 16
_NEAREST_M = 0.2
"""No hand is held nearer to a camera."""


class Detector:
    """Finds blobs of the learnt colour. Keeps no memory between pictures."""

    def __init__(self, looks: MarkerAppearance, camera: Camera, settings: DetectionSettings) -> None:
        self._looks = looks
        self._camera = camera
        self._settings = settings
        coarse = looks.paper_histogram.reshape(_SIMILARITY_BINS, 2, _SIMILARITY_BINS, 2).sum(axis=(1, 3))
        self._reference = np.sqrt(coarse.ravel())
        self._cell, self._is_skin, self._is_paper = _by_hue_and_saturation(looks, settings)
        self._least_area = settings.least_area * looks.least_share
        self._most_area = settings.most_area * looks.most_share
        self._first_cell = self._reference.size * np.arange(settings.most_blobs)[:, None]

    def region_about(self, pixel: FloatArray, covariance_px2: FloatArray, depth_m: FloatArray) -> Region:
        """Rectangle that holds all predicted discs (M, 2) with their uncertainty (M, 2, 2)."""
        disc_px_m, region_sd = self._camera.fx_px * self._settings.marker_radius_m, REGION_SD
        if (kernels := in_c()) is not None:
            bounds = np.empty(4)
            kernels.discs_reach(
                len(pixel), *map(np.ascontiguousarray, (pixel, covariance_px2, depth_m)), disc_px_m, region_sd,
                MAX_UNSURE_PX, _NEAREST_M, bounds,
            )  # fmt: skip
            return self._region(*bounds.tolist())
        variance = np.maximum(covariance_px2.diagonal(axis1=1, axis2=2), 0.0)
        reach = np.minimum(region_sd * np.sqrt(variance), MAX_UNSURE_PX)
        reach += (2.2 * disc_px_m / np.maximum(depth_m, _NEAREST_M) + 3.0)[:, None]
        return self._region(*(pixel - reach).min(axis=0).tolist(), *(pixel + reach).max(axis=0).tolist())

    def _region(self, left: float, top: float, right: float, bottom: float) -> Region:
        return Region(math.floor(left), math.floor(top), math.ceil(right) + 1, math.ceil(bottom) + 1).clipped(
            self._camera.width_px, self._camera.height_px
        )

    def detect(self, frame: Frame, region: Region | None = None) -> Detections:
        """Blobs inside a region, or in the whole picture when there is none."""
        height, width = frame.color_rgb.shape[:2]
        region = self._hand_region(frame.color_rgb) if region is None else region.clipped(width, height)
        if region is None or region.is_empty:
            return Detections.none()
        if (kernels := in_c()) is not None:
            return self._detected(kernels, frame, region)
        color = frame.color_rgb[region.top : region.bottom, region.left : region.right]
        hsv = appearance.to_hsv(color)
        mask = paper_mask(hsv, self._looks, self._settings)
        blobs = components(mask, lambda centre_px: self._radius_at(frame, region, centre_px))
        area = blobs.area_px
        ratio = area / (np.pi * blobs.radius_px**2)
        fits = np.flatnonzero((ratio >= self._least_area) & (ratio <= self._most_area))
        if fits.size == 0:
            return Detections.none()
        if fits.size > self._settings.most_blobs:
            fits = fits[np.argsort(-area[fits], kind="stable")[: self._settings.most_blobs]]
        return self._measure(frame, region, color, hsv, blobs, fits)

    def _radius_at(self, frame: Frame, region: Region, centre_px: FloatArray) -> FloatArray:
        """Radius in pixels (B,) of a disc facing the camera at the depth of each place; NaN-free."""
        scale = self._camera.fx_px * self._looks.radius_m
        if frame.depth_raw is None:
            return np.full(len(centre_px), scale / USUAL_DEPTH_M)
        radius = []
        for u, v in centre_px.tolist():
            depth_m = frame.depth_raw.item(round(v) + region.top, round(u) + region.left) * frame.depth_unit_m
            radius.append(scale / (depth_m if depth_m > _NEAREST_M else USUAL_DEPTH_M))
        return np.array(radius)

    def _measure(
        self, frame: Frame, region: Region, color: ByteImage, hsv: ByteImage, blobs: Components, fits: NDArray[np.int64]
    ) -> Detections:
        settings, labels = self._settings, blobs.labels
        own, rough_px = blobs.label[fits], blobs.centre_px[fits]
        radius_px = median(blobs.radius_px[fits].tolist())
        stencil = stencil_for(radius_px, self._camera.sensor.edge_px)
        pixels, inside, middle = window_pixels(stencil, rough_px, labels.shape)
        outline = outlines(labels.reshape(-1).take(pixels), own, inside, stencil)
        similarity, skin_share = self._likeness(packed(hsv).take(pixels), outline, stencil)
        offset, area = refined_centres(unpacked(packed(color).take(pixels)), outline, stencil, settings)
        centre = middle + offset
        centre[:, 0] += region.left
        centre[:, 1] += region.top
        if frame.depth_raw is None:
            depth = depth_sd = np.full(own.size, np.nan)
        else:
            raw = frame.depth_raw[region.top : region.bottom, region.left : region.right].reshape(-1)
            core = outline.mine[:, stencil.core]
            depth, depth_sd = blob_depths(
                raw.take(pixels[:, stencil.near]), core, frame.depth_unit_m, settings, self._camera.sensor
            )
        # Those that look like a disc and lie on skin.
        return Detections(centre, depth, depth_sd, area, similarity).only(
            (similarity >= self._looks.least_similarity) & (skin_share >= self._settings.skin_share)
        )

    def _detected(self, kernels: Kernels, frame: Frame, region: Region) -> Detections:
        """All of it in C, where sums are of double precision."""
        settings, sensor, raw = self._settings, self._camera.sensor, frame.depth_raw
        left, top, most = region.left, region.top, settings.most_blobs
        seen = *frame.color_rgb.shape[:2], frame.color_rgb, NOTHING if raw is None else raw, raw is not None
        shape = region.bottom - top, region.right - left
        labels, look = np.empty(shape, dtype=np.int32), np.empty(shape, dtype=np.uint16)
        own, found = np.empty(most, dtype=np.int32), np.empty(1, dtype=np.int32)
        rough_px, radius_px = np.empty((most, 2)), np.empty(most)
        kernels.blobs_found(
            *seen, frame.depth_unit_m, left, top, shape[1], shape[0], self._is_paper, int(self._looks.darkest_value),
            self._camera.fx_px * self._looks.radius_m, USUAL_DEPTH_M, _NEAREST_M,
            LONG_SIDE_RADII, LONG_AXIS_RADII, BLURRED_EDGE_PX, SPLIT_ROUNDS, MAX_PARTS,
            self._least_area, self._most_area, most, labels, look, own, rough_px, radius_px, found,
        )  # fmt: skip
        if not (count := found.item()):
            return Detections.none()
        stencil = stencil_for(median(radius_px[:count].tolist()), sensor.edge_px)
        centre, (area, similarity, depth, depth_sd) = np.empty((count, 2)), np.empty((4, count))
        kernels.blobs_measured(
            count, own[:count], rough_px[:count], left, top, *shape, labels, look, *seen,
            frame.depth_unit_m, stencil.row.size, stencil.row, stencil.column, stencil.reach,
            stencil.core.stop, stencil.near.stop, stencil.rim.start, stencil.rim.stop, stencil.wedge, stencil.pick,
            self._cell, self._is_skin, self._reference.size, self._reference,
            PAPER_LOW, PAPER_HIGH, MIN_RIM, MIN_CORE,
            DEPTH_IQR_M, DEPTH_VALID_SHARE, MIN_READINGS,
            EDGE_STEP_M, EDGE_SD_M, SLOPE_SHARE,
            sensor.reading.fixed_m, sensor.reading.square_per_m, sensor.patch_px, sensor.averages,
            self._looks.least_similarity, settings.skin_share, centre, area, similarity, depth, depth_sd, found,
        )  # fmt: skip
        kept = found.item()
        return Detections(centre[:kept], depth[:kept], depth_sd[:kept], area[:kept], similarity[:kept])

    def _likeness(self, hsv: NDArray[np.uint32], outline: Outline, stencil: Stencil) -> tuple[FloatArray, FloatArray]:
        """Bhattacharyya coefficient (B,) of each blob's colours to the reference; share (B,) of skin in its rim.

        ``hsv`` (B, P) windows, packed.
        """
        look = hsv.view(np.uint16)[:, ::2]  # hue and saturation
        skin = self._is_skin.take(look[:, stencil.rim]) & outline.rim
        skin_share = skin.sum(axis=1) / np.maximum(outline.rim.sum(axis=1), 1)
        cells, total = self._reference.size, hsv.shape[0]
        cell = self._cell.take(look) + self._first_cell[:total]
        counts = np.bincount(cell.ravel(), outline.mine.ravel(), total * cells).reshape(total, cells)
        area = np.maximum(outline.mine.sum(axis=1), 1)
        return np.sqrt(counts) @ self._reference / np.sqrt(area), skin_share

    def _hand_region(self, color_rgb: ByteImage) -> Region | None:
        """Rectangle about the skin and paper of the largest hand-like region, None when there is no paper."""
        coarse = COARSE
        small = cv2.resize(color_rgb, None, fx=1 / coarse, fy=1 / coarse, interpolation=cv2.INTER_AREA)
        hsv = appearance.to_hsv(np.asarray(small, dtype=np.uint8))
        paper = appearance.back_project(hsv, self._looks.paper_lookup) >= PAPER_LEVEL
        if not paper.any():
            return None
        skin = appearance.back_project(hsv, self._looks.skin_lookup) >= SKIN_LEVEL
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
        ).clipped(color_rgb.shape[1], color_rgb.shape[0])


def _by_hue_and_saturation(
    looks: MarkerAppearance, settings: DetectionSettings
) -> tuple[NDArray[np.uint8], NDArray[np.bool_], NDArray[np.uint8]]:
    """For each pair of hue and saturation, read as one number of two bytes: its cell of the coarse histogram, whether
    it is likelier on skin than on paper, and 1 where it is of the paper's colour."""
    bins = appearance.BINS
    number = np.arange(1 << 16)
    every = np.stack((number & 255, number >> 8, number & 0), axis=1).astype(np.uint8)[None]
    hue, saturation = np.minimum((number & 255) * bins // 180, bins - 1), (number >> 8) * bins // 256
    cell = ((hue >> 1) * _SIMILARITY_BINS + (saturation >> 1)).astype(np.uint8)
    return cell, looks.skin_lookup[hue, saturation] >= SKIN_LEVEL, is_blue(every, looks, settings)[0] >> 7
