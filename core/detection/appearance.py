"""What the markers look like today: learnt from the clicked discs, so it follows light, paper and skin.

Hue and saturation hardly change when the light on a disc does; brightness does, and is left out.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import cv2
import numpy as np
from numpy.typing import NDArray

from carpus.core.compiled.blobs import BlobWindows, mask_paper
from carpus.core.detection.components import Components, find_components
from carpus.core.detection.settings import DetectionSettings
from carpus.core.detection.stencil import get_stencil
from carpus.core.model.assignment import assign_nearest
from carpus.core.model.camera import Camera
from carpus.core.model.types import ByteImage, FloatArray, Frame

SMALL_RADIUS_M = 0.004
"""Radius of the small paper discs (reference 2)."""
PAPER_SHARE = 0.5
"""A pixel belongs to a marker when its colour is so much likelier on paper than on the skin around."""
MIN_BRIGHTNESS_SHARE = 0.25
"""Brightness below this share of the clicked markers' is no marker."""
MIN_SIMILARITY = 0.5
"""That a blob needs, as long as the clicked discs do not show that it is less."""
MAX_CLICK_DISTANCE_RADII = 2.2
"""A disc is found so far from its click: about 10 px at 0.7 m."""
PAPER_CORE_RADII = 0.8
"""Up to here a disc's pixels are paper; those at its edge more paper than skin."""
MAX_LEARNING_ROUNDS = 3
"""At most; the colours have settled before."""
DEFAULT_RADIUS_PX = 5.0
"""Of a disc where there is no depth."""

BINS = 32
"""Bins of hue (of 180) and of saturation (of 256)."""
_HUE_WIDTH = 180 / BINS
_RANGES = [0.0, 180.0, 0.0, 256.0]


def to_hsv(color_rgb: ByteImage) -> ByteImage:
    """Hue 0-179, saturation and value 0-255 of an RGB picture."""
    return np.asarray(cv2.cvtColor(color_rgb, cv2.COLOR_RGB2HSV), dtype=np.uint8)


def compute_histogram(hsv: ByteImage, mask: NDArray[np.bool_], smooth_bins: float = 0.0) -> FloatArray:
    """Normalised histogram (BINS, BINS) of the masked pixels; hue wraps round when smoothed."""
    pixels = hsv[mask]
    hue = np.minimum((pixels[:, 0] / _HUE_WIDTH).astype(np.int64), BINS - 1)
    saturation = pixels[:, 1].astype(np.int64) * BINS // 256
    counts = np.bincount(hue * BINS + saturation, minlength=BINS * BINS).reshape(BINS, BINS).astype(np.float64)
    if smooth_bins > 0.0:
        wrapped = np.concatenate((counts[-4:], counts, counts[:4]))
        blurred = cv2.GaussianBlur(wrapped, (0, 0), smooth_bins, borderType=cv2.BORDER_REPLICATE)
        counts = np.asarray(blurred, dtype=np.float64)[4:-4]
    total = counts.sum()
    return np.asarray(counts / total if total > 0 else counts)


def backproject_histogram(hsv: ByteImage, lookup: NDArray[np.float32]) -> ByteImage:
    """Value 0-255 of the bin of every pixel; ``lookup`` (BINS, BINS) holds 0 to 255."""
    return np.asarray(cv2.calcBackProject([hsv], [0, 1], lookup, _RANGES, 1.0), dtype=np.uint8)


def compute_bhattacharyya(a: FloatArray, b: FloatArray) -> FloatArray:
    """Bhattacharyya coefficient of normalised histograms (..., n), 0 for none in common, 1 for equal.

    >>> float(bhattacharyya(np.array([0.5, 0.5]), np.array([0.5, 0.5])))
    1.0
    """
    return np.asarray(np.sum(np.sqrt(a * b), axis=-1))


@dataclass(frozen=True, slots=True)
class MarkerAppearance:
    """Colours of paper and skin and the discs' size.

    ``paper_histogram`` (BINS, BINS) is the reference of the Bhattacharyya coefficient; ``paper_lookup`` and
    ``skin_lookup`` (BINS, BINS) are 0-255 tables for back-projection: how much likelier than the other a
    colour is; ``min_brightness`` 0-255; ``radius_m`` of most of the clicked discs, large or small ones (reference 2);
    ``min_area_share`` and ``max_area_share`` of the ideal area of such a disc facing the camera that the clicked ones
    showed (some are of the other size, some turned away); ``min_similarity`` that a blob needs.
    """

    paper_histogram: FloatArray
    paper_lookup: NDArray[np.float32]
    skin_lookup: NDArray[np.float32]
    min_brightness: float
    radius_m: float
    min_area_share: float
    max_area_share: float
    min_similarity: float


def disc_mask(shape: tuple[int, ...], centre_px: FloatArray, radius_px: float) -> NDArray[np.bool_]:
    """Pixels (H, W) within a radius of a centre (u, v)."""
    v, u = np.ogrid[: shape[0], : shape[1]]
    return np.asarray((u - centre_px[0]) ** 2 + (v - centre_px[1]) ** 2 <= radius_px**2)


def estimate_radius_px(frame: Frame, pixel: FloatArray, camera: Camera, settings: DetectionSettings) -> float:
    """Radius of a disc facing the camera at the depth found about ``pixel``; a guess where there is none."""
    if frame.depth_raw is None:
        return DEFAULT_RADIUS_PX
    near = disc_mask(frame.depth_raw.shape, pixel, 12.0)
    depth_raw = frame.depth_raw[near]
    depth_raw = depth_raw[depth_raw > 0]
    if depth_raw.size == 0:
        return DEFAULT_RADIUS_PX
    return float(camera.fx_px * settings.marker_radius_m / (float(np.median(depth_raw)) * frame.depth_unit_m))


def learn_appearance(
    frame: Frame, click_px: FloatArray, camera: Camera, settings: DetectionSettings
) -> tuple[MarkerAppearance, FloatArray]:
    """Learn from clicks (M, 2) near the discs; also the discs' rough centres (M, 2), NaN where none was found.

    First the colours right under the clicks, most of which are paper, against the ring around them, most of
    which is not; then again from the discs so found, until they settle.
    """
    hsv = to_hsv(frame.color_rgb)
    shape = hsv.shape[:2]
    radius_px = np.array([estimate_radius_px(frame, click, camera, settings) for click in click_px])
    on_paper = np.zeros(shape, dtype=bool)
    ring = np.zeros(shape, dtype=bool)
    for click, radius in zip(click_px, radius_px, strict=True):
        on_paper |= disc_mask(shape, click, 0.6 * radius)
        ring |= disc_mask(shape, click, 5.0 * radius) & ~disc_mask(shape, click, 2.4 * radius)
    ring &= ~on_paper
    centre = np.full(click_px.shape, np.nan)
    looks = _learn_colors(hsv, on_paper, ring, settings)
    middle_radius, size = float(np.median(radius_px)), 1.0
    for _ in range(MAX_LEARNING_ROUNDS):
        blobs = _find_paper_blobs(hsv, looks, middle_radius * size)
        found = _match_blobs_to_clicks(click_px, MAX_CLICK_DISTANCE_RADII * radius_px, blobs)
        if not np.any(found >= 0):
            break
        centre = np.full(click_px.shape, np.nan)
        there = found >= 0
        centre[there], radius = _measure_discs(frame.color_rgb, blobs, found[there], middle_radius * size)
        size = _estimate_size_ratio(radius / radius_px[there], settings)
        on_paper, around = np.zeros(shape, dtype=bool), np.zeros(shape, dtype=bool)
        for point, reach in zip(centre[there], radius, strict=True):
            on_paper |= disc_mask(shape, point, PAPER_CORE_RADII * reach)
            around |= disc_mask(shape, point, 2.2 * reach) & ~disc_mask(shape, point, 1.45 * reach)
        looks = _learn_colors(hsv, on_paper, around & ~_dilate(blobs.labels > 0), settings)
    looks = replace(looks, radius_m=size * settings.marker_radius_m)
    return _learn_limits(looks, hsv, centre, size * radius_px), centre


def _find_paper_blobs(hsv: ByteImage, looks: MarkerAppearance, radius_px: float) -> Components:
    return find_components(
        build_paper_mask(hsv, classify_paper_colors(looks), looks.min_brightness),
        lambda at: np.full(len(at), radius_px),
    )


def _estimate_size_ratio(ratio: FloatArray, settings: DetectionSettings) -> float:
    """Radius of most discs over that of the large ones, from the measured ratios (B,), which blur changes."""
    small = SMALL_RADIUS_M / settings.marker_radius_m
    return small if float(np.median(ratio)) < np.sqrt(small) else 1.0


def _measure_discs(
    color_rgb: ByteImage, blobs: Components, found: NDArray[np.int64], radius_px: float
) -> tuple[FloatArray, FloatArray]:
    """Centres (B, 2) and radii (B,) of the discs under the blobs ``found``, by unmixing at their edges.

    While the paper's colours are only partly known a blob is smaller than its disc.
    """
    centre, area = BlobWindows(blobs.subset(found), get_stencil(radius_px)).locate_centres(color_rgb)
    return centre, np.sqrt(area / np.pi)


def _learn_limits(
    looks: MarkerAppearance, hsv: ByteImage, centre: FloatArray, radius_px: FloatArray
) -> MarkerAppearance:
    """The appearance with what the found discs reach by it: share of area, likeness to the reference."""
    there = np.isfinite(centre[:, 0])
    blobs = _find_paper_blobs(hsv, looks, float(np.median(radius_px)))
    found = _match_blobs_to_clicks(centre[there], MAX_CLICK_DISTANCE_RADII * radius_px[there], blobs)
    found = found[found >= 0]
    if found.size == 0:
        return looks
    ratio = blobs.area_px[found] / (np.pi * np.median(radius_px) ** 2)
    reached = [
        float(
            compute_bhattacharyya(compute_histogram(hsv, blobs.labels == label).ravel(), looks.paper_histogram.ravel())
        )
        for label in blobs.label[found]
    ]
    # Half of what the least alike of the clicked discs reaches: a blob in other light still counts.
    least = min(MIN_SIMILARITY, 0.5 * min(reached))
    return replace(looks, min_area_share=float(ratio.min()), max_area_share=float(ratio.max()), min_similarity=least)


def classify_paper_colors(appearance: MarkerAppearance) -> NDArray[np.uint8]:
    """255 for each look (65536,), hue + 256 saturation, that is likelier on paper, else 0."""
    likely = backproject_histogram(HUE_SATURATION_CODES[None], appearance.paper_lookup)[0]
    return np.asarray(255 * (likely > 255.0 * PAPER_SHARE), dtype=np.uint8)


def build_paper_mask(hsv: ByteImage, is_paper: NDArray[np.uint8], darkest_value: float) -> ByteImage:
    """255 where a pixel has a look of the paper and is lit, speckle removed."""
    return np.asarray(
        cv2.morphologyEx(mask_paper(hsv, is_paper, darkest_value), cv2.MORPH_OPEN, _CROSS), dtype=np.uint8
    )


_CODE = np.arange(1 << 16)
HUE_SATURATION_CODES = np.stack((_CODE & 255, _CODE >> 8, 0 * _CODE), axis=1).astype(np.uint8)
"""Hue and saturation of each look (65536, 3)."""
_CROSS = cv2.getStructuringElement(cv2.MORPH_CROSS, (3, 3))


def _dilate(mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
    return np.asarray(cv2.dilate(mask.astype(np.uint8), np.ones((3, 3), np.uint8)) > 0)


def _learn_colors(
    hsv: ByteImage, on_paper: NDArray[np.bool_], ring: NDArray[np.bool_], settings: DetectionSettings
) -> MarkerAppearance:
    paper = compute_histogram(hsv, on_paper, smooth_bins=1.2)
    skin = compute_histogram(hsv, ring, smooth_bins=1.2)
    floor = 0.02 / paper.size  # a colour never seen is neither
    paper_share = paper / (paper + skin + floor)
    skin_share = skin / (paper + skin + floor)
    value = hsv[..., 2][on_paper]
    darkest = MIN_BRIGHTNESS_SHARE * float(np.median(value)) if value.size else 0.0
    return MarkerAppearance(
        paper,
        (255.0 * paper_share).astype(np.float32),
        (255.0 * skin_share).astype(np.float32),
        darkest,
        settings.marker_radius_m,
        1.0,
        1.0,
        MIN_SIMILARITY,
    )


def _match_blobs_to_clicks(click_px: FloatArray, reach_px: FloatArray, blobs: Components) -> NDArray[np.int64]:
    """Disc-sized blob of every click (M,), -1 when none is within its reach; each blob once, nearest overall."""
    full = np.pi * blobs.radius_px**2
    fits = (blobs.area_px > 0.2 * full) & (blobs.area_px < 3.0 * full)
    distance = np.linalg.norm(click_px[:, None] - blobs.centre_px[None], axis=-1)
    return assign_nearest(np.where(fits, distance, np.inf), reach_px)
