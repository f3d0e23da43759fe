"""Which blob is which disc of thumb and fingers, the palm being known.

First every disc by itself, eq. (12) of the wrist paper resolved for all discs at once; a disc that is turned away or
was hidden a moment ago is less likely to be seen. Then digit by digit: where the discs of one are not
jointly compatible, all ways to name them are weighed jointly. A blob larger than its disc is one of two discs that the
picture does not resolve, and measures both.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

from carpus.core.compiled.digit_images import (
    STEEPEST_RAD,
    STEEPEST_SD_RAD,
    compute_disc_odds,
    compute_tilts,
    measure_assigned_discs,
)
from carpus.core.compiled.digits import place_digits
from carpus.core.model.types import FloatArray
from carpus.core.tracking.association import association
from carpus.core.tracking.association.association import is_jointly_compatible
from carpus.core.tracking.association.palm_association import CENTRE_SHIFT_SHARE, MIN_WHOLE_AREA_SHARE, Measurements
from carpus.core.tracking.filter.digit_filter import ANATOMY, DIGIT_SIZE, OBSERVED, DigitLinearisation, DigitView
from carpus.core.tracking.filter.hand_geometry import (
    CROWDED_PX,
    CROWDED_RADII,
    N_DIGITS,
    N_DISCS,
    N_SLOTS,
    SLOT_MOVES_DISC,
)
from carpus.core.tracking.filter.joint_limits import LIMIT_SD_RAD, compute_limit_excess
from carpus.core.tracking.filter.mixture_filter import ModeMixture, Update, partial_update_shares, update_mixture
from carpus.core.tracking.filter.settings import TrackerSettings

_SLOT = np.arange(N_SLOTS)
_LOG_2_PI = float(np.log(2.0 * np.pi))


SKIN_SD_PX = 0.1
"""So far a disc on a finger strays from where the model has it, besides the noise of its centre."""
MIN_VISIBLE_PROBABILITY = 0.5
"""With less than this chance a disc was hidden a moment ago."""
EXPECTED_CLUTTER = 3.0
"""Other blobs expected in a picture."""
MAX_LINEAR_SD_RAD = math.radians(10.0)
"""A joint expected less surely may be far from where h was linearised."""
BEYOND_LIMIT_SD = 1.5
"""So many standard deviations beyond its reach a joint surely is not."""
MIN_MERGED_AREA_RATIO = 1.25
"""So many times as large as its disc seen square a blob holds a neighbour's too: of single ones 99.9 % are smaller."""
MERGED_SD_SHARE = 0.5
"""Where along such a blob either disc lies is unsure by this share of what lies between them and its centre."""
MAX_CANDIDATES = 4
"""Blobs that each disc may be, where a digit's names are weighed jointly."""
NO_DEPTH_PENALTY = 14.0
"""So much further off, in squared standard deviations, one counts there without its depth."""


@dataclass(frozen=True, slots=True)
class DigitAssignment:
    """``assigned`` (5, 3) blob of every disc or -1, ``with_depth`` (5, 3) whether its depth is believed."""

    assigned: NDArray[np.int64]
    with_depth: NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class UpdatedDigits:
    """The digits corrected by the blobs as named; ``measured`` and ``variance`` (5, 9) what they were corrected by."""

    assignment: DigitAssignment
    update: Update
    measured: FloatArray
    variance: FloatArray


@dataclass(frozen=True, slots=True)
class DigitScene:
    """One frame before the fingers are named.

    ``covariance`` (5, n, n) of the digits; ``linearised`` h; ``spread`` (5, 9, 9) covariance of the discs' images, the
    palm's error included; ``palm_covariance`` that error alone; ``visible`` (5, 3) chance that each disc is to be seen;
    ``free`` (D,) blobs that are not the palm's; ``area_px`` (D,) of the blobs, ``whole_px`` (5, 3) of each disc where
    nothing hides it and ``disc_m2`` (5, 3) its area, NaN where not known yet; ``noise_factor`` (5, 9);
    ``learning_share``
    share of what is said of the anatomy that is believed; ``has_discs`` (5,) digits that carry discs at all.
    """

    covariance: FloatArray
    linearised: DigitLinearisation
    spread: FloatArray
    palm_covariance: FloatArray
    visible: FloatArray
    blobs: Measurements
    free: NDArray[np.bool_]
    area_px: FloatArray
    whole_px: FloatArray
    disc_m2: FloatArray
    noise_factor: FloatArray
    resolution_px2: float
    view: DigitView
    learning_share: float
    has_discs: NDArray[np.bool_]


def associate_digits(estimates: ModeMixture, scene: DigitScene, settings: TrackerSettings) -> UpdatedDigits:
    """Names and corrects all digits."""
    names = _associate_separately(scene, settings)
    return check_jointly(update_digits(estimates, scene, names, settings), estimates, scene, settings)


def check_jointly(
    found: UpdatedDigits, estimates: ModeMixture, scene: DigitScene, settings: TrackerSettings
) -> UpdatedDigits:
    """The digits as found, or where one's names are not jointly compatible or would be where they cannot be, anew."""
    names = found.assignment
    nis, dof = found.update.nis.tolist(), found.update.dof.tolist()
    doubtful = [r for r in range(N_DIGITS) if not is_jointly_compatible(nis[r], dof[r], settings.association)]
    if doubtful:
        assigned, with_depth = names.assigned.copy(), names.with_depth.copy()
        assigned[doubtful] = -1
        for chain in doubtful:
            others = np.setdiff1d(np.flatnonzero(scene.free), assigned.ravel())
            assigned[chain], with_depth[chain] = _associate_digit_jointly(chain, scene, others, settings)
        names = DigitAssignment(assigned, with_depth)
        found = update_digits(estimates, scene, names, settings)
    back = (names.assigned >= 0) & (scene.visible < MIN_VISIBLE_PROBABILITY)
    if not back.any() and not (names.assigned[0, 2] >= 0 > names.assigned[0, 1]):
        return found
    impossible = _find_impossible_markers(found, scene) | _find_lone_markers(names, scene)
    return remove_markers(impossible, found, estimates, scene, settings) if impossible.any() else found


def remove_markers(
    is_removed: NDArray[np.bool_],
    found: UpdatedDigits,
    estimates: ModeMixture,
    scene: DigitScene,
    settings: TrackerSettings,
) -> UpdatedDigits:
    """The digits corrected anew without the names of some ``is_removed`` (5, 3)."""
    names = DigitAssignment(
        np.where(is_removed, -1, found.assignment.assigned), found.assignment.with_depth & ~is_removed
    )
    return update_digits(estimates, scene, names, settings)


def _find_lone_markers(names: DigitAssignment, scene: DigitScene) -> NDArray[np.bool_]:
    """Discs (5, 3) further out than the first that stand without the one before them on a digit that may be far from
    where it is expected: those that come back alone, and the end of the thumb, whose joints can bring it anywhere. Any
    blob would do for them."""
    is_named = names.assigned >= 0
    lone = is_named & (is_named.sum(axis=1) == 1)[:, None] & (scene.visible < MIN_VISIBLE_PROBABILITY)
    lone[:, 0] = False
    lone[0, 2] |= is_named[0, 2] & ~is_named[0, 1]
    if not lone.any():
        return np.asarray(lone)
    return np.asarray(lone & find_far_digits(scene.covariance, is_named)[:, None])


def find_far_digits(covariance: FloatArray, named: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Digits (5,) whose discs (5, 3) that are seen may find their joints far from where they were expected, with
    covariances (5, n, n)."""
    shown = (SLOT_MOVES_DISC & named[:, None, :]).any(axis=-1)
    return np.asarray((shown & (covariance[:, _SLOT, _SLOT] > MAX_LINEAR_SD_RAD**2)).any(axis=1))


def is_beyond_limits(mean: FloatArray, covariance: FloatArray) -> NDArray[np.bool_]:
    """Digits (5,) bent surely beyond their limits, by means (5, n) and covariances (5, n, n)."""
    sd = np.sqrt(np.diagonal(covariance, axis1=1, axis2=2)[:, :N_SLOTS] + LIMIT_SD_RAD**2)
    return np.asarray((np.abs(compute_limit_excess(mean[:, :N_SLOTS])) > BEYOND_LIMIT_SD * sd).any(axis=1))


def _find_impossible_markers(found: UpdatedDigits, scene: DigitScene) -> NDArray[np.bool_]:
    """Discs (5, 3) that were hidden a moment ago and are where, if they were there, they could not be seen, or where
    no finger can reach."""
    back = (found.assignment.assigned >= 0) & (scene.visible < MIN_VISIBLE_PROBABILITY)
    chains = np.flatnonzero(back.any(axis=1))
    if not chains.size:
        return back
    mean, covariance = found.update.mixture.merge()
    _, normal, _, _ = place_digits(mean[:, OBSERVED], np.zeros((N_DIGITS, 3)))
    tilt, bend = compute_tilts(normal, covariance, scene.linearised, scene.view)
    hidden = tilt - STEEPEST_RAD > BEYOND_LIMIT_SD * np.sqrt(bend + STEEPEST_SD_RAD**2)
    return back & (hidden | is_beyond_limits(mean, covariance)[:, None])


def _associate_separately(scene: DigitScene, settings: TrackerSettings) -> DigitAssignment:
    if not len(scene.blobs):
        return DigitAssignment(np.full((N_DIGITS, N_DISCS), -1), np.zeros((N_DIGITS, N_DISCS), dtype=bool))
    names = settings.association
    densities = association.log_densities(
        scene.resolution_px2 / EXPECTED_CLUTTER, association.DEPTH_OUTLIER_PROBABILITY, names
    )
    assumed = math.log(names.prior_marker / names.prior_clutter)
    odds, with_depth = compute_disc_odds(scene, densities, names.gate_sd**2, association.LOG_IMPOSSIBLE, assumed)
    found = association.assign_blobs(odds)
    believed = with_depth[np.arange(found.size), found] & (found >= 0)
    return DigitAssignment(found.reshape(N_DIGITS, N_DISCS), believed.reshape(N_DIGITS, N_DISCS))


def measurements_from_assignment(
    scene: DigitScene, names: DigitAssignment, settings: TrackerSettings
) -> tuple[FloatArray, FloatArray]:
    """What the blobs as named measure (5, 9), NaN where there is none, and its variance (5, 9)."""
    return measure_assigned_discs(
        scene,
        names,
        settings.noise.pixel_sd_px**2 + SKIN_SD_PX**2,
        settings.marker_radius_m,
        (CENTRE_SHIFT_SHARE, MIN_WHOLE_AREA_SHARE),
        (CROWDED_RADII, CROWDED_PX),
        (MIN_VISIBLE_PROBABILITY, MIN_MERGED_AREA_RATIO, MERGED_SD_SHARE),
    )


def update_digits(
    estimates: ModeMixture, scene: DigitScene, names: DigitAssignment, settings: TrackerSettings
) -> UpdatedDigits:
    """All digits corrected by the blobs as named."""
    measured, variance = measurements_from_assignment(scene, names, settings)
    update = update_mixture(
        estimates,
        scene.linearised,
        measured,
        variance,
        scene.palm_covariance,
        partial_update_shares(DIGIT_SIZE, ANATOMY, scene.learning_share),
    )
    return UpdatedDigits(names, update, measured, variance)


def _associate_digit_jointly(
    chain: int, scene: DigitScene, blobs: NDArray[np.int64], settings: TrackerSettings
) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
    """Most probable names (3,) of one digit's discs among ``blobs``, and whether the depths are believed."""
    value, spread = scene.linearised.value[chain], scene.spread[chain]
    nothing = np.full(N_DISCS, -1, dtype=np.int64), np.zeros(N_DISCS, dtype=bool)
    if not blobs.size:
        return nothing
    candidates: list[list[tuple[int, bool]]] = []
    for disc in range(N_DISCS):
        rows = slice(3 * disc, 3 * disc + 3)
        off = scene.blobs.value[blobs] - value[rows]
        sd2 = np.diagonal(spread[rows, rows]) + scene.blobs.variance[blobs]
        pixel2 = (off[:, :2] ** 2 / sd2[:, :2]).sum(axis=1)
        whole2 = pixel2 + off[:, 2] ** 2 / sd2[:, 2]
        gate2 = settings.association.gate_sd**2
        flat2 = pixel2 + NO_DEPTH_PENALTY
        near = blobs[np.argsort(np.where(np.isfinite(whole2), np.minimum(whole2, flat2), flat2))]
        order = {int(b): i for i, b in enumerate(blobs)}
        own: list[tuple[int, bool]] = [(-1, False)]
        for blob in near[:MAX_CANDIDATES]:
            i = order[int(blob)]
            if pixel2[i] > 2.0 * gate2:
                continue
            if np.isfinite(whole2[i]) and whole2[i] <= 2.0 * gate2:
                own.append((int(blob), True))
            else:
                own.append((int(blob), False))
        candidates.append(own)
    ways = [way for way in product(*candidates) if len({b for b, _ in way if b >= 0}) == sum(b >= 0 for b, _ in way)]
    assigned = np.array([[b for b, _ in way] for way in ways])
    depth = np.array([[d for _, d in way] for way in ways])
    named = assigned >= 0
    used = np.repeat(named[..., None], 3, axis=-1)
    used[..., 2] = depth
    used = used.reshape(-1, 9)
    variance = np.where(named[..., None], scene.blobs.variance[np.maximum(assigned, 0)], 1.0).reshape(-1, 9)
    variance = np.where(used, variance * scene.noise_factor[chain], 1.0)
    measured = np.where(named[..., None], scene.blobs.value[np.maximum(assigned, 0)], 0.0).reshape(-1, 9)
    unit = np.where(used, 1.0 / np.sqrt(variance), 0.0)
    s = spread * (unit[:, :, None] * unit[:, None, :]) + np.eye(9)
    off = np.where(used, measured - value, 0.0) * unit
    nis = np.einsum("wi,wi->w", off, np.linalg.solve(s, off[..., None])[..., 0])
    log_normal = -0.5 * (nis + np.linalg.slogdet(s)[1] + used.sum(axis=1) * _LOG_2_PI) + np.sum(
        np.log(np.where(used, unit, 1.0)), axis=1
    )
    by_seen = np.log(scene.visible[chain] / (1.0 - scene.visible[chain]))
    per_blob = float(np.log(scene.resolution_px2 / EXPECTED_CLUTTER))
    with_depth = float(np.log(settings.association.depth_range_m))
    without = np.where(
        np.isfinite(scene.blobs.value[np.maximum(assigned, 0), 2]), np.log(association.DEPTH_OUTLIER_PROBABILITY), 0.0
    )
    clutter = per_blob + np.where(depth, with_depth, without)
    score = log_normal + np.sum(np.where(named, by_seen + clutter, 0.0), axis=1)
    best = int(np.argmax(score))
    return assigned[best], depth[best]
