"""Depth of the still hand: registration of depth to colour, and the surface of the back of the hand."""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray

from carpus.core.calibration.result import Calibration
from carpus.core.detection import appearance
from carpus.core.detection.appearance import MarkerAppearance
from carpus.core.model.camera import Camera
from carpus.core.model.hand.dorsal_surface import DorsalSurface, fit_dorsal_surface
from carpus.core.model.types import FloatArray, Frame

_CORNERS = 4
"""WRIST, CMC1, MCP2 and MCP3 come first in every protocol's palm."""


SURFACE_MARGIN_PX = 14.0
"""Margin around the markers for readings of the back of the hand."""
MIN_READING_SHARE = 0.5
"""Share of the still frames that must have a reading at a pixel."""


def estimate_back_surface(
    calibration: Calibration, still_frames: Sequence[Frame], camera: Camera
) -> DorsalSurface | None:
    """Fit the surface over capitate and metacarpals 2 and 3 to the mean depth of the still frames.

    None if too little of it was seen.
    """
    corner = calibration.marker_position_w0_m[list(calibration.clicks.protocol.palm[:_CORNERS])]
    in_camera = corner @ calibration.rotation_w0_cam.T + calibration.translation_w0_cam_m
    pixel = camera.distort(camera.project(in_camera))
    left, top = np.maximum(pixel.min(axis=0) - SURFACE_MARGIN_PX, 0.0).astype(int).tolist()
    right, bottom = (pixel.max(axis=0) + SURFACE_MARGIN_PX).astype(int).tolist()
    cut = [
        frame.depth_raw[top : bottom + 1, left : right + 1].astype(np.float64) * frame.depth_unit_m
        for frame in still_frames
        if frame.depth_raw is not None
    ]
    if not cut or cut[0].size == 0:
        return None
    depth = np.stack(cut)
    count = (depth > 0.0).sum(axis=0)
    row, column = np.nonzero(count >= max(1.0, MIN_READING_SHARE * len(cut)))
    depth_m = depth[:, row, column].sum(axis=0) / count[row, column]
    seen_px = camera.undistort(np.stack((column + left, row + top), axis=1).astype(np.float64))
    point = camera.backproject(seen_px, depth_m)
    in_w0 = (point - calibration.translation_w0_cam_m) @ calibration.rotation_w0_cam
    return fit_dorsal_surface(in_w0, corner)


Image = NDArray[np.float32]


COMPARED_WIDTH_PX = 640
"""Image width at which the outlines are compared."""
MAX_OFFSET_PX = 40
"""Largest offset that is searched."""
MARKER_MARGIN_PX = 80
"""Margin around the markers that is searched."""
SKIN_RADIUS_PX = 14
"""Skin lies within this distance of a marker."""
MIN_SKIN_PX = 50
"""Fewer pixels of skin give no result."""
HAND_ABOVE_M = 0.02
"""Depths nearer than this to the markers are the hand; in between in part."""
GROUND_BELOW_M = 0.04
"""Depths farther than this below the markers are the ground."""
MIN_CORRELATION = 0.7
"""Below it the skin does not stand out well enough."""
MIN_CORRELATION_GAIN = 0.08
"""Gain in correlation for an offset to count."""
MIN_OFFSET_PX = 8.0
"""The sensor's shadow beside the hand alone moves the outline by up to this."""


def estimate_depth_offset_px(frame: Frame, marker_appearance: MarkerAppearance, marker_px: FloatArray) -> float:
    """Estimate the offset of depth against colour in pixels; 0 if there is none or it is unknown.

    ``marker_px`` (M, 2) are the markers in the colour image.
    """
    if frame.depth_raw is None or not len(marker_px):
        return 0.0
    scale = COMPARED_WIDTH_PX / frame.color_rgb.shape[1]
    size = (COMPARED_WIDTH_PX, round(frame.color_rgb.shape[0] * scale))
    color = np.asarray(cv2.resize(frame.color_rgb, size, interpolation=cv2.INTER_AREA), dtype=np.uint8)
    raw = cv2.resize(frame.depth_raw, size, interpolation=cv2.INTER_NEAREST)
    depth_m = np.asarray(raw, dtype=np.float32) * np.float32(frame.depth_unit_m)
    spots = np.clip(np.rint(marker_px * scale), 0, np.array(size) - 1).astype(np.int64)
    left, top = np.maximum(spots.min(axis=0) - MARKER_MARGIN_PX, 0)
    right, bottom = np.minimum(spots.max(axis=0) + MARKER_MARGIN_PX, size)
    hand = _hand_probability(depth_m, spots)
    if hand is None:
        return 0.0
    # Ground is ground wherever depth lies: further from any hand than it may be beside colour.
    reached = cv2.dilate((hand > 0.05).astype(np.uint8), np.ones((2 * MAX_OFFSET_PX + 1,) * 2, np.uint8))
    skin = _skin_probability(color, marker_appearance, spots, reached == 0)[top:bottom, left:right]
    if skin.std() < 0.05 or hand[top:bottom, left:right].std() < 0.05:
        return 0.0
    reach = MAX_OFFSET_PX
    wide = cv2.copyMakeBorder(hand, reach, reach, reach, reach, cv2.BORDER_REPLICATE)
    wide = wide[top : bottom + 2 * reach, left : right + 2 * reach]
    correlation = cv2.matchTemplate(wide, skin, cv2.TM_CCOEFF_NORMED)
    v, u = np.unravel_index(int(correlation.argmax()), correlation.shape)
    best, current = float(correlation[v, u]), float(correlation[reach, reach])
    offset = float(np.hypot(u - reach, v - reach))
    is_off = best >= MIN_CORRELATION and best - current >= MIN_CORRELATION_GAIN and offset > MIN_OFFSET_PX
    return offset / scale if is_off else 0.0


def _skin_probability(
    color_rgb: NDArray[np.uint8],
    marker_appearance: MarkerAppearance,
    spots: NDArray[np.int64],
    ground: NDArray[np.bool_],
) -> Image:
    """Return the probability (H, W) of skin, as around the markers, or paper, against ground."""
    hsv = appearance.to_hsv(color_rgb)
    paper = np.asarray(appearance.backproject_histogram(hsv, marker_appearance.paper_lookup) >= 128, dtype=np.float32)
    near = np.zeros(paper.shape, dtype=np.uint8)
    for u, v in spots.tolist():
        cv2.circle(near, (u, v), SKIN_RADIUS_PX, 1, -1)
    skin = (near > 0) & (cv2.dilate(paper, np.ones((5, 5), np.uint8)) == 0)
    if min(np.count_nonzero(skin), np.count_nonzero(ground)) < MIN_SKIN_PX:
        return np.zeros(paper.shape, dtype=np.float32)
    lab = cv2.GaussianBlur(cv2.cvtColor(color_rgb, cv2.COLOR_RGB2LAB), (0, 0), 1.0)
    hue = lab[..., 1:].astype(np.float32)  # without lightness: the hand's shadow is ground
    gain = _negative_log_likelihood(hue, hue[ground]) - _negative_log_likelihood(hue, hue[skin])
    return _blur(np.maximum(1.0 / (1.0 + np.exp(-np.clip(gain, -8.0, 8.0))), paper))


def _negative_log_likelihood(hue: Image, sample: Image) -> FloatArray:
    """Return that (H, W) of a normal distribution through the sample (N, 2), up to a constant."""
    away = hue - sample.mean(axis=0)
    spread = np.cov(sample.T) + 2.0 * np.eye(2)
    squared = np.einsum("hwi,ij,hwj->hw", away, np.linalg.inv(spread).astype(np.float32), away)
    return np.asarray(0.5 * (np.minimum(squared, 50.0) + np.log(np.linalg.det(spread))))


def _hand_probability(depth_m: Image, spots: NDArray[np.int64]) -> Image | None:
    """Return the probability (H, W) of being as near as the markers; None without their depth."""
    at_discs = [depth_m[max(v - 5, 0) : v + 6, max(u - 5, 0) : u + 6] for u, v in spots.tolist()]
    middle = [float(np.median(patch[patch > 0.0])) for patch in at_discs if (patch > 0.0).any()]
    if not middle:
        return None
    share = np.clip((float(np.median(middle)) + GROUND_BELOW_M - depth_m) / (HAND_ABOVE_M + GROUND_BELOW_M), 0.0, 1.0)
    return _blur(np.where(depth_m > 0.0, share, 0.0))


def _blur(image: FloatArray) -> Image:
    return np.asarray(cv2.GaussianBlur(image.astype(np.float32), (0, 0), 2.0), dtype=np.float32)
