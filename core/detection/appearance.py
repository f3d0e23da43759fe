"""Appearance of the markers, learnt from the clicked discs, so it follows light, paper and skin.

Hue and saturation hardly change when the light on a disc does; brightness does, and is left out.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import cv2
import numpy as np
from numpy.typing import NDArray

from carpus.core.compiled.blobs import BlobWindows, mask_paper
from carpus.core.detection.blobs import Components, find_components, get_stencil
from carpus.core.model.camera import Camera
from carpus.core.model.types import ByteImage, FloatArray, Frame

SMALL_RADIUS_M = 0.004  # radius of the small paper discs (reference 2)
PAPER_SHARE = 0.5  # a pixel is paper when its colour is so much likelier on paper than on the skin around
MIN_BRIGHTNESS_SHARE = 0.25  # of the clicked markers' brightness; what is darker is no marker
MIN_SIMILARITY = 0.5  # of a blob, as long as the clicked discs do not show that it is less
MAX_CLICK_DISTANCE_RADII = 2.2  # a disc is found so far from its click: about 10 px at 0.7 m
PAPER_CORE_RADII = 0.8  # up to here a disc's pixels are paper; those at its edge more paper than skin
MAX_LEARNING_ROUNDS = 3  # the colours have settled before
DEFAULT_RADIUS_PX = 5.0  # of a disc where there is no depth

BINS = 32  # of hue (of 180) and of saturation (of 256)
_HUE_WIDTH = 180 / BINS
_RANGES = [0.0, 180.0, 0.0, 256.0]


def to_hsv(color_rgb: ByteImage) -> ByteImage:
    """Return hue 0-179, saturation and value 0-255 of an RGB image."""
    return np.asarray(cv2.cvtColor(color_rgb, cv2.COLOR_RGB2HSV), dtype=np.uint8)


def compute_histogram(hsv: ByteImage, mask: NDArray[np.bool_], smooth_bins: float = 0.0) -> FloatArray:
    """Return the normalised histogram (BINS, BINS) of the masked pixels.

    Hue wraps round when smoothed.
    """
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
    """Return the value 0-255 of the bin of every pixel; ``lookup`` (BINS, BINS) holds 0 to 255."""
    return np.asarray(cv2.calcBackProject([hsv], [0, 1], lookup, _RANGES, 1.0), dtype=np.uint8)


def compute_bhattacharyya(a: FloatArray, b: FloatArray) -> FloatArray:
    """Return the Bhattacharyya coefficient of normalised histograms (..., n), 0 to 1.

    >>> float(compute_bhattacharyya(np.array([0.5, 0.5]), np.array([0.5, 0.5])))
    1.0
    """
    return np.asarray(np.sum(np.sqrt(a * b), axis=-1))


@dataclass(frozen=True, slots=True)
class DetectionSettings:
    """Settings of the detection.

    Attributes
    ----------
    marker_radius_m : float
        Radius of the paper markers.
    min_skin_share : float
        Share of a blob's rim that must be skin or paper, so that the blob lies on a hand.
    min_area_ratio, max_area_ratio : float
        Limits of a blob's area over that of a marker at its depth, relative to the ratios learnt at calibration.
    max_blobs : int
        Blobs returned of one frame; the largest are kept.
    """

    marker_radius_m: float = 0.006
    min_skin_share: float = 0.25
    min_area_ratio: float = 0.12
    max_area_ratio: float = 2.2
    max_blobs: int = 48


@dataclass(frozen=True, slots=True)
class MarkerAppearance:
    """Colours of paper and skin and the discs' size.

    ``paper_histogram`` (BINS, BINS) is the reference of the Bhattacharyya coefficient; ``paper_lookup`` and
    ``skin_lookup`` (BINS, BINS) are 0-255 tables for back-projection: how much likelier than the other a colour is;
    ``min_brightness`` 0-255; ``radius_m`` of most of the clicked discs, large or small ones (reference 2);
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
    """Return the pixels (H, W) within a radius of a centre (u, v)."""
    v, u = np.ogrid[: shape[0], : shape[1]]
    return np.asarray((u - centre_px[0]) ** 2 + (v - centre_px[1]) ** 2 <= radius_px**2)


def estimate_radius_px(frame: Frame, pixel: FloatArray, camera: Camera, settings: DetectionSettings) -> FloatArray:
    """Return the radius (M,) of discs facing the camera at the depth about pixels (M, 2); a default without depth."""
    radius_px = np.full(len(pixel), DEFAULT_RADIUS_PX)
    if frame.depth_raw is None:
        return radius_px
    half = 12
    for i, place in enumerate(pixel):
        left, top = np.maximum(np.floor(place).astype(int) - half, 0)
        window = frame.depth_raw[top : top + 2 * half + 2, left : left + 2 * half + 2]
        depth_raw = window[disc_mask(window.shape, place - (left, top), half) & (window > 0)]
        if depth_raw.size:
            depth_m = float(np.median(depth_raw)) * frame.depth_unit_m
            radius_px[i] = camera.fx_px * settings.marker_radius_m / depth_m
    return radius_px


def learn_appearance(
    frame: Frame, click_px: FloatArray, camera: Camera, settings: DetectionSettings
) -> tuple[MarkerAppearance, FloatArray]:
    """Learn the appearance of the discs near clicks (M, 2).

    First the colours right under the clicks, most of which are paper, against the ring around them, most of which is
    not; then again from the discs so found, until they settle. Return also the rough centres (M, 2) of the discs, NaN
    where none was found.
    """
    hsv = to_hsv(frame.color_rgb)
    shape = hsv.shape[:2]
    radius_px = estimate_radius_px(frame, click_px, camera, settings)
    is_paper, ring = np.zeros(shape, dtype=bool), np.zeros(shape, dtype=bool)
    for click, radius in zip(click_px, radius_px, strict=True):
        is_paper |= disc_mask(shape, click, 0.6 * radius)
        ring |= disc_mask(shape, click, 5.0 * radius) & ~disc_mask(shape, click, 2.4 * radius)
    centre = np.full(click_px.shape, np.nan)
    appearance = _learn_colors(hsv, is_paper, ring & ~is_paper, settings)
    median_radius, size = float(np.median(radius_px)), 1.0
    small = SMALL_RADIUS_M / settings.marker_radius_m
    for _ in range(MAX_LEARNING_ROUNDS):
        blobs = _find_paper_blobs(hsv, appearance, median_radius * size)
        blob = _match_blobs_to_clicks(click_px, MAX_CLICK_DISTANCE_RADII * radius_px, blobs)
        is_found = blob >= 0
        if not is_found.any():
            break
        # By unmixing at the edges: while the paper's colours are only partly known a blob is smaller than its disc.
        windows = BlobWindows(blobs.subset(blob[is_found]), get_stencil(median_radius * size))
        centre = np.full(click_px.shape, np.nan)
        centre[is_found], area = windows.locate_centres(frame.color_rgb)
        measured_px = np.sqrt(area / np.pi)
        # Most discs are large or small ones; blur changes the ratio.
        size = small if float(np.median(measured_px / radius_px[is_found])) < np.sqrt(small) else 1.0
        is_paper, ring = np.zeros(shape, dtype=bool), np.zeros(shape, dtype=bool)
        for point, radius in zip(centre[is_found], measured_px, strict=True):
            is_paper |= disc_mask(shape, point, PAPER_CORE_RADII * radius)
            ring |= disc_mask(shape, point, 2.2 * radius) & ~disc_mask(shape, point, 1.45 * radius)
        near_blob = cv2.dilate((blobs.labels > 0).astype(np.uint8), np.ones((3, 3), np.uint8)) > 0
        appearance = _learn_colors(hsv, is_paper, ring & ~near_blob, settings)
    appearance = replace(appearance, radius_m=size * settings.marker_radius_m)
    return _learn_limits(appearance, hsv, centre, size * radius_px), centre


def _find_paper_blobs(hsv: ByteImage, appearance: MarkerAppearance, radius_px: float) -> Components:
    mask = build_paper_mask(hsv, classify_paper_colors(appearance), appearance.min_brightness)
    return find_components(mask, lambda pixel: np.full(len(pixel), radius_px))


def _learn_limits(
    appearance: MarkerAppearance, hsv: ByteImage, centre: FloatArray, radius_px: FloatArray
) -> MarkerAppearance:
    """Add to the appearance the share of area and the similarity that the found discs reach."""
    is_found = np.isfinite(centre[:, 0])
    blobs = _find_paper_blobs(hsv, appearance, float(np.median(radius_px)))
    blob = _match_blobs_to_clicks(centre[is_found], MAX_CLICK_DISTANCE_RADII * radius_px[is_found], blobs)
    blob = blob[blob >= 0]
    if blob.size == 0:
        return appearance
    share = blobs.area_px[blob] / (np.pi * np.median(radius_px) ** 2)
    paper = appearance.paper_histogram.ravel()
    similarity = [
        float(compute_bhattacharyya(compute_histogram(hsv, blobs.labels == label).ravel(), paper))
        for label in blobs.label[blob]
    ]
    return replace(
        appearance,
        min_area_share=float(share.min()),
        max_area_share=float(share.max()),
        # Half of the least of the clicked discs: a blob in other light still counts.
        min_similarity=min(MIN_SIMILARITY, 0.5 * min(similarity)),
    )


def classify_paper_colors(appearance: MarkerAppearance) -> NDArray[np.uint8]:
    """Return 255 for each colour code (65536,) that is likelier on paper, else 0."""
    likely = backproject_histogram(HUE_SATURATION_CODES[None], appearance.paper_lookup)[0]
    return np.asarray(255 * (likely > 255.0 * PAPER_SHARE), dtype=np.uint8)


def build_paper_mask(hsv: ByteImage, is_paper: NDArray[np.uint8], darkest_value: float) -> ByteImage:
    """Return 255 where a pixel has a colour of the paper and is lit, speckle removed."""
    return np.asarray(
        cv2.morphologyEx(mask_paper(hsv, is_paper, darkest_value), cv2.MORPH_OPEN, _CROSS), dtype=np.uint8
    )


_CODE = np.arange(1 << 16)
# hue and saturation of each colour code (65536, 3)
HUE_SATURATION_CODES = np.stack((_CODE & 255, _CODE >> 8, 0 * _CODE), axis=1).astype(np.uint8)
_CROSS = cv2.getStructuringElement(cv2.MORPH_CROSS, (3, 3))


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
    """Return the disc-sized blob of every click (M,), -1 when none is near; each blob once."""
    full = np.pi * blobs.radius_px**2
    fits = (blobs.area_px > 0.2 * full) & (blobs.area_px < 3.0 * full)
    distance = np.linalg.norm(click_px[:, None] - blobs.centre_px[None], axis=-1)
    return assign_nearest(np.where(fits, distance, np.inf), reach_px)


def assign_nearest(distance: FloatArray, max_distance: FloatArray) -> NDArray[np.int64]:
    """Return the column assigned one to one to every row (R,), -1 for none, at the least total distance.

    Parameters
    ----------
    distance : (R, C)
        Distance of every row from every column.
    max_distance : (R,)
        Assignments that are farther than the row's own are dropped.
    """
    from scipy.optimize import linear_sum_assignment  # a third of a second to load

    far = distance > max_distance[:, None]
    rows, columns = linear_sum_assignment(np.where(far, 1e6, distance))
    out = np.full(len(distance), -1, dtype=np.int64)
    near = ~far[rows, columns]
    out[rows[near]] = columns[near]
    return out
