"""What a camera sees of thumb and fingers, and what that tells, in NumPy."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from carpus.core.compiled.digit_images import (
    ACROSS_M,
    DEPTH_STAYS_M,
    INHERITED,
    NARROW2,
)
from carpus.core.compiled.digits import BENT, OTHER
from carpus.core.model import so3
from carpus.core.model.types import FloatArray
from carpus.core.tracking.association.palm_association import CENTRE_SHIFT_SHARE, MIN_WHOLE_AREA_SHARE
from carpus.core.tracking.digits.digit_association import (
    MERGED_SD_SHARE,
    MIN_MERGED_AREA_RATIO,
    MIN_VISIBLE_PROBABILITY,
    SKIN_SD_PX,
    DigitAssignment,
    DigitScene,
)
from carpus.core.tracking.digits.digit_readout import DigitBase
from carpus.core.tracking.filter.digit_filter import (
    DIGIT_SIZE,
    OBSERVED,
    DigitLinearisation,
    DigitSigmaPoints,
    DigitView,
    digit_sigma_weights,
)
from carpus.core.tracking.filter.hand_geometry import (
    CROWDED_PX,
    CROWDED_RADII,
    N_DIGITS,
    N_DISCS,
    N_SLOTS,
    is_crowded,
)
from carpus.core.tracking.filter.settings import TrackerSettings
from carpus.core.tracking.filter.unscented import UnscentedParameters
from tests.compiled.oracle.palm import camera_slope


def linearise_images(points: DigitSigmaPoints, view: DigitView, scaling: UnscentedParameters) -> DigitLinearisation:
    """Statistical linear regression of the discs' images on the joints, and their slope by the constants."""
    count, weights = BENT.size, digit_sigma_weights(scaling)
    image = view.observe(points.disc_m).reshape(N_DIGITS, 2 * count + 1, 3 * N_DISCS)
    value: FloatArray = weights.mean @ image
    plus, minus = image[:, 1 : count + 1], image[:, count + 1 :]
    half = (plus - minus) * (0.5 / weights.scale)  # (5, 6, 9): slope in the axes of the root
    # The even part of the spread is what nothing linear can follow.
    bend = 0.5 * (plus + minus) - value[:, None]
    middle = image[:, :1] - value[:, None]
    error = 2.0 * weights.covariance[1] * (np.swapaxes(bend, 1, 2) @ bend)
    error += weights.covariance[0] * (np.swapaxes(middle, 1, 2) @ middle)
    by_place = camera_slope(view.camera, image[:, 0].reshape(N_DIGITS, N_DISCS, 3))
    by_constants = ((by_place @ view.rotation) @ points.by_constants).reshape(N_DIGITS, 3 * N_DISCS, -1)
    own = half - points.along @ np.swapaxes(by_constants, 1, 2)
    slope = np.zeros((N_DIGITS, 3 * N_DISCS, DIGIT_SIZE))
    slope[:, :, OBSERVED[BENT]] = np.swapaxes(own, 1, 2) @ points.unroot
    slope[:, :, OBSERVED[OTHER]] = by_constants
    whole = slope @ points.covariance @ np.swapaxes(slope, 1, 2) + error
    centre = points.disc_m[:, 0] @ view.rotation.T + view.translation_m
    return DigitLinearisation(value, slope, error, points.mean, whole, centre, by_place)


def compute_inherited(
    covariance: FloatArray, base: DigitBase, linearised: DigitLinearisation, normal: FloatArray
) -> FloatArray:
    """Covariance (5, 5, 5) that the slots inherit from the turn of W2 and from depths that stay wrong."""
    camera, joints = base.view.camera, covariance[:, :N_SLOTS, :N_SLOTS]
    unit = np.empty((N_DIGITS, N_DISCS, 3, 1))
    unit[..., :2, 0] = linearised.centre_m[..., 2:] / (np.array([camera.fx_px, camera.fy_px]) * ACROSS_M)
    unit[..., 2, 0] = 1.0 / DEPTH_STAYS_M
    slope = linearised.slope[..., :N_SLOTS] * unit.reshape(N_DIGITS, 9, 1)
    across = np.swapaxes(slope, 1, 2)
    doubt = INHERITED * np.linalg.inv(joints + NARROW2 * np.eye(N_SLOTS))
    response = np.linalg.solve(across @ slope + doubt, across)
    root_m = base.palm.disc_m[1:, None] @ base.view.rotation.T + base.view.translation_m
    turned = response @ (linearised.by_place @ so3.skew(root_m - linearised.centre_m) * unit).reshape(N_DIGITS, 9, 3)
    in_camera = normal @ base.view.rotation.T
    moved = -in_camera[..., 2:] * in_camera
    moved[..., 2] += 1.0
    seen = linearised.by_place @ moved[..., None] * (DEPTH_STAYS_M * unit)
    by_disc = (response.reshape(N_DIGITS, N_SLOTS, N_DISCS, 1, 3) @ seen[:, None])[..., 0, 0]
    return np.asarray(turned @ base.turn_covariance @ np.swapaxes(turned, 1, 2) + by_disc @ np.swapaxes(by_disc, 1, 2))


def measured_as_named(
    scene: DigitScene, names: DigitAssignment, settings: TrackerSettings
) -> tuple[FloatArray, FloatArray]:
    """What the blobs as named measure (5, 9), NaN where there is none, and its variance (5, 9)."""
    noise = settings.noise
    blob = np.maximum(names.assigned, 0)
    is_named = names.assigned >= 0
    if len(scene.blobs):
        measured = np.where(is_named[..., None], scene.blobs.value[blob], np.nan)
        variance = np.where(is_named[..., None], scene.blobs.variance[blob], 1.0)
        measured[..., 2] = np.where(names.with_depth, measured[..., 2], np.nan)
        # Now that the disc is known, so is the size it would have if it were whole.
        missing = MIN_WHOLE_AREA_SHARE - scene.area_px[blob] / scene.whole_px
        wander_px = CENTRE_SHIFT_SHARE * np.sqrt(scene.whole_px / np.pi) * np.maximum(missing, 0.0)
        expected = scene.linearised.value.reshape(N_DIGITS, N_DISCS, 3)
        radius_px = settings.marker_radius_m * scene.view.camera.fx_px / expected[..., 2]
        crowded_px = np.where(is_crowded(expected[..., :2], radius_px, CROWDED_RADII), CROWDED_PX, 0.0)
        own = (noise.pixel_sd_px**2 + SKIN_SD_PX**2 + wander_px**2 + crowded_px**2)[..., None]
        variance[..., :2] = np.where(np.isfinite(own) & is_named[..., None], own, variance[..., :2])
        _measure_unresolved(scene, names.assigned, measured, variance)
    else:
        measured, variance = np.full((N_DIGITS, N_DISCS, 3), np.nan), np.ones((N_DIGITS, N_DISCS, 3))
    return measured.reshape(N_DIGITS, 9), variance.reshape(N_DIGITS, 9) * scene.noise_factor


def _measure_unresolved(
    scene: DigitScene, assigned: NDArray[np.int64], measured: FloatArray, variance: FloatArray
) -> None:
    """Blobs larger than their discs measure a neighbour without a blob of its own as well (unresolved measurements,
    Koch and van Keuk 1997): ``measured`` and ``variance`` (5, 3, 3) are changed in place.

    Two discs side by side cover more than one by as much of a disc as their middles lie apart in diameters, all but;
    either lies half of that from the centre, along the line on which they are expected, as surely as that is known. The
    depth is of either. A disc that was hidden a moment ago may have been given any blob.
    """
    expected, spread = scene.linearised.value.reshape(N_DIGITS, N_DISCS, 3), scene.image_covariance
    face_px = scene.disc_m2 * (scene.view.camera.fx_px / expected[..., 2]) ** 2
    area_px = scene.area_px[np.maximum(assigned, 0)]
    alone = (assigned < 0) & scene.has_discs[:, None]
    known = (assigned >= 0) & (scene.visible >= MIN_VISIBLE_PROBABILITY)
    for chain, disc in np.argwhere(known & (area_px > MIN_MERGED_AREA_RATIO * face_px)).tolist():
        other = next((d for d in (disc + 1, disc - 1) if 0 <= d < N_DISCS and alone[chain, d]), None)
        if other is None:
            continue
        alone[chain, other] = False
        face = face_px[chain, disc]
        radius_px = math.sqrt(face / math.pi)
        half_px = radius_px * min((area_px[chain, disc] - scene.whole_px[chain, disc]) / face, 2.0)
        gap = expected[chain, other, :2] - expected[chain, disc, :2]
        unsure2 = sum(
            spread[chain, i, i] + spread[chain, j, j] - 2.0 * spread[chain, i, j]
            for i, j in ((3 * disc, 3 * other), (3 * disc + 1, 3 * other + 1))
        )
        shift = gap * (half_px / math.sqrt(gap @ gap + unsure2))
        stray2 = half_px**2 * (1.0 + MERGED_SD_SHARE**2) - shift @ shift
        measured[chain, other, :2] = measured[chain, disc, :2] + shift
        variance[chain, other, :2] = variance[chain, disc, :2] + stray2
        measured[chain, disc, :2] -= shift
        variance[chain, disc, :2] += stray2
        variance[chain, disc, 2] += (2.0 * half_px * expected[chain, disc, 2] / scene.view.camera.fx_px) ** 2
