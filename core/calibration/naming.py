"""Names for the discs of a flat hand, proposed from where its blobs lie to each other: a person confirms them.

The average hand in several postures is laid over the blobs by turning, shifting and scaling it in the plane of the
picture, in metres where depth is known; then every finger is let turn and stretch by itself. The back of the hand
faces the camera, so the side decides which of two mirror images it is.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from carpus.core.calibration.name_checks import average_palm, misfit, misfit_without, names_fit
from carpus.core.camera import Camera
from carpus.core.hand.anatomy import anatomy_from_size
from carpus.core.hand.kinematics import disc_centres
from carpus.core.hand.protocols import SITES, MarkerProtocol, joint_angle_names
from carpus.core.types import Detections, FloatArray, Side

IntArray = NDArray[np.int64]


REFERENCE_HAND_M = 0.180
"""Length of the average hand that is laid over the blobs."""
MIN_SCALE = 0.62
"""With :data:`MAX_SCALE`: hands 112 to 225 mm long."""
MAX_SCALE = 1.25
"""Largest scale of the average hand."""
GATE_M = 0.016
"""Reach of the first, rough laying-over, for a hand of the average length."""
REFINED_FITS = 24
"""So many of the best rough fits are refined; more only cost time."""
CLOSE_M = 0.011
"""A disc farther from where the fitted hand has it is not given its name."""
SURE_M = 0.006
"""By so much another disc must be farther away than the named one."""
NO_PALM_MISFIT = 0.12
"""Share of the palm's size from which one of its discs is something else: simulated hands leave up to 0.05, discs
stuck 4 mm off up to 0.12."""
OFF_THE_HAND_M = 0.030
"""A disc farther from the depth of the others lies on something else."""
USUAL_DEPTH_M = 0.7
"""Distance of the hand where no depth is read."""


@dataclass(frozen=True, slots=True)
class NameProposal:
    """``blob`` (M,) index of the blob proposed for each marker, -1 for none; ``is_sure`` (M,) where no other name is
    nearly as good; ``misfit_m`` (M,) how far the blob lies from where the average hand has it, NaN without one.
    """

    blob: IntArray
    is_sure: NDArray[np.bool_]
    misfit_m: FloatArray


def propose_names(
    blobs: Detections,
    camera: Camera,
    side: Side,
    protocol: MarkerProtocol,
    known: Mapping[int, int] | None = None,
) -> NameProposal:
    """Names for the blobs of a flat, neutral hand with its back to the camera.

    ``known``: blobs (values) that a person has named already (keys, rows of ``protocol``); they keep their names and
    decide between hands that fit alike. Without a likely hand nothing but these is named.
    """
    fixed = dict(known or {})
    rows = np.array(protocol.sites)
    place = _in_picture_plane(blobs, camera, USUAL_DEPTH_M)
    fits = _rough_fits(place, rows, side, fixed)
    chains = [np.array(chain[1:]) for chain in protocol.chains.values()]
    refined = [_refined(place, fit, fixed, chains) for fit in fits]
    if not refined:
        return _only(fixed, rows.size)
    best = min(refined, key=lambda one: one.cost)
    if np.count_nonzero(best.blob >= 0) < max(4, rows.size // 2):
        return _only(fixed, rows.size)
    sure = best.is_sure.copy()
    for other in refined:
        # Another hand that explains the blobs nearly as well: where it disagrees, nothing is sure.
        if other.cost < best.cost + 0.5:
            sure &= other.blob == best.blob
    if not protocol.has_fingers and (best.blob >= 0).all():
        # Six discs of the other hand, turned round, may lie within reach too: then a person looks at each name.
        plan = np.stack((place[best.blob].real, place[best.blob].imag), axis=1)
        sure &= names_fit(side, plan)
    sure[list(fixed)] = True
    blob = _of_one_palm(best.blob, place, blobs.depth_m, fixed, side, protocol)
    return NameProposal(blob, sure & (blob >= 0), np.where(blob >= 0, best.misfit_m, np.nan))


def _of_one_palm(
    blob: IntArray,
    place: FloatArray,
    depth_m: FloatArray,
    fixed: Mapping[int, int],
    side: Side,
    protocol: MarkerProtocol,
) -> IntArray:
    """Names (M,) without those on spots that lie where no palm has the disc, which is not in the picture; a person's
    own names stay. Four discs fit too many things to say which of them is odd."""
    out, rows = blob.copy(), np.array(protocol.palm)
    free = np.array([row not in fixed for row in rows])
    while np.count_nonzero(out[rows] >= 0) > 4:
        named = out[rows] >= 0
        spots = out[rows[named]]
        off_m = np.abs(depth_m[spots] - np.median(depth_m[spots]))
        if (off_m > OFF_THE_HAND_M).any():
            badness = off_m
        else:
            average, plan = average_palm(side)[named], np.stack((place[spots].real, place[spots].imag), axis=1)
            if misfit(average, plan) < NO_PALM_MISFIT:
                break
            badness = 1.0 - misfit_without(average, plan)
        badness = np.where(free[named], badness, -1.0)
        if badness.max() < 0.0:
            break
        out[rows[named][int(badness.argmax())]] = -1
    return out


def _only(fixed: Mapping[int, int], count: int) -> NameProposal:
    blob = np.full(count, -1, dtype=np.int64)
    blob[list(fixed)] = list(fixed.values())
    return NameProposal(blob, blob >= 0, np.full(count, np.nan))


def _in_picture_plane(blobs: Detections, camera: Camera, usual_depth_m: float) -> FloatArray:
    """Places (D,) as complex numbers x - iy in metres, x right and y down in the camera's axes."""
    known = np.isfinite(blobs.depth_m)
    usual_m = float(np.median(blobs.depth_m[known])) if known.any() else usual_depth_m
    point = camera.back_project(camera.undistort(blobs.pixel), np.where(known, blobs.depth_m, usual_m))
    return np.asarray(point[:, 0] - 1j * point[:, 1])


@dataclass(frozen=True, slots=True)
class _LaidHand:
    """A posture laid over the blobs: places (M,) of the markers, complex, and the scale it took."""

    place: FloatArray
    scale: float


@dataclass(frozen=True, slots=True)
class _Named:
    blob: IntArray
    is_sure: NDArray[np.bool_]
    misfit_m: FloatArray
    cost: float


@lru_cache(maxsize=4)
def _postures(side: Side, reference_m: float) -> FloatArray:
    """Places (P, 21), complex x + iy in W, of the discs of the average hand in usual flat postures."""
    names = joint_angle_names()
    hand = anatomy_from_size(reference_m, side=side, nail_discs=True)
    out = []
    for spread in (-4.0, 4.0, 12.0):
        for thumb_extension, thumb_abduction in ((0.0, 5.0), (20.0, 10.0), (35.0, 25.0), (-10.0, 30.0)):
            angles = dict.fromkeys(names, 0.0)
            angles |= {"CMC1_extension": thumb_extension, "CMC1_abduction": thumb_abduction}
            angles |= {"MCP2_abduction": spread, "MCP4_abduction": -spread, "MCP5_abduction": -1.5 * spread}
            disc = disc_centres(hand, np.radians([angles[name] for name in names]))
            out.append(disc[:, 0] + 1j * disc[:, 1])
    return np.array(out)


def _rough_fits(place: FloatArray, rows: IntArray, side: Side, fixed: Mapping[int, int]) -> list[_LaidHand]:
    """The likeliest ways to lay a posture over the blobs, best first: two of its discs on two of the blobs."""
    if place.size < 3:
        return []
    first, second = (grid.ravel() for grid in np.meshgrid(np.arange(place.size), np.arange(place.size), indexing="ij"))
    apart = first != second
    first, second = first[apart], second[apart]
    found: list[tuple[float, _LaidHand]] = []
    for posture in _postures(side, REFERENCE_HAND_M)[:, rows]:
        for a, b in _pairs(rows, fixed):
            ends = _ends(a, b, first, second, fixed)
            turn = (place[ends[1]] - place[ends[0]]) / (posture[b] - posture[a])
            scale = np.abs(turn)
            usable = (scale > MIN_SCALE) & (scale < MAX_SCALE)
            turn, start, scale = turn[usable], place[ends[0]][usable], scale[usable]
            if not turn.size:
                continue
            laid = start[:, None] + turn[:, None] * (posture - posture[a])
            near2 = (np.abs(laid[:, :, None] - place).min(axis=2) / (GATE_M * scale[:, None])) ** 2
            # A marker counts the more the nearer a blob is; a hand of the usual size a little more.
            score = np.maximum(1.0 - near2, 0.0).sum(axis=1) - 2.0 * np.log(scale) ** 2
            for row, blob in fixed.items():
                score -= 4.0 * (np.abs(laid[:, row] - place[blob]) > 2.0 * GATE_M)
            for i in np.argsort(-score)[:6]:
                found.append((float(score[i]), _LaidHand(laid[i], float(scale[i]))))
    found.sort(key=lambda one: -one[0])
    return [fit for _, fit in found[:REFINED_FITS]]


def _pairs(rows: IntArray, fixed: Mapping[int, int]) -> list[tuple[int, int]]:
    """Pairs of markers, far apart, on which a posture is laid; those already named where there are two."""
    if len(fixed) >= 2:
        named = list(fixed)
        return [(named[0], other) for other in named[1:]]
    at = {int(row): i for i, row in enumerate(rows)}
    names = (("WRIST", "TIP3"), ("WRIST", "MCP3"), ("CMC1", "TIP4"), ("MCP2", "MCP5"), ("TIP2", "TIP5"))
    pairs = [(at.get(SITES.index(a), -1), at.get(SITES.index(b), -1)) for a, b in names]
    return [(a, b) for a, b in pairs if a >= 0 and b >= 0]


def _ends(a: int, b: int, first: IntArray, second: IntArray, fixed: Mapping[int, int]) -> tuple[IntArray, IntArray]:
    """Blobs on which the markers a and b are laid."""
    if a in fixed and b in fixed:
        return np.array([fixed[a]]), np.array([fixed[b]])
    return first, second


def _refined(place: FloatArray, fit: _LaidHand, fixed: Mapping[int, int], chains: Sequence[IntArray]) -> _Named:
    """Named by the nearest overall; the whole hand, then each of its digits, moved to what was named."""
    laid = fit.place
    reach = 2.2 * GATE_M * fit.scale
    for step in range(6):
        blob = _assigned(place, laid, reach, fixed)
        laid = _moved(laid, place, blob) if step < 3 else _chains_moved(laid, place, blob, chains)
        reach = max(0.7 * reach, CLOSE_M * fit.scale)
    blob = _assigned(place, laid, reach, fixed)
    distance = np.abs(laid[:, None] - place)
    own = np.where(blob >= 0, distance[np.arange(blob.size), blob], np.nan)
    others = distance.copy()
    others[np.arange(blob.size)[blob >= 0], blob[blob >= 0]] = np.inf
    sure = (blob >= 0) & (others.min(axis=1, initial=np.inf) - own > SURE_M * fit.scale)
    size = math.log(fit.scale)
    cost = float(np.where(blob >= 0, (own / (CLOSE_M * fit.scale)) ** 2, 2.0).sum()) + 2.0 * size**2
    return _Named(blob, sure, own, cost)


def _assigned(place: FloatArray, laid: FloatArray, reach: float, fixed: Mapping[int, int]) -> IntArray:
    """Blob of every marker (M,), -1 where none is within ``reach``; each blob once, nearest overall."""
    from scipy.optimize import linear_sum_assignment  # a third of a second to load

    distance = np.abs(laid[:, None] - place)
    cost = np.minimum(distance, reach) ** 2
    for row, blob in fixed.items():
        cost[row, :] = cost[:, blob] = 4.0 * reach**2
        cost[row, blob] = -1.0
    markers, blobs = linear_sum_assignment(cost)
    out = np.full(laid.size, -1, dtype=np.int64)
    near = distance[markers, blobs] < reach
    out[markers[near]] = blobs[near]
    for row, blob in fixed.items():
        out[out == blob] = -1
        out[row] = blob
    return out


def _moved(laid: FloatArray, place: FloatArray, blob: IntArray) -> FloatArray:
    """The markers turned, shifted and scaled as one, so that the named ones lie on their blobs as well as they can."""
    named = blob >= 0
    if np.count_nonzero(named) < 2:
        return laid
    mine, theirs = laid[named], place[blob[named]]
    centre, middle = mine.mean(), theirs.mean()
    spread = float((np.abs(mine - centre) ** 2).sum())
    turn = ((theirs - middle) * np.conj(mine - centre)).sum() / spread if spread > 0.0 else 1.0
    return np.asarray(middle + turn * (laid - centre))


def _chains_moved(laid: FloatArray, place: FloatArray, blob: IntArray, chains: Sequence[IntArray]) -> FloatArray:
    """Each digit turned and stretched about its first named disc, the rest of it following."""
    out = laid.copy()
    if not chains:
        return _moved(laid, place, blob)
    for chain in chains:
        named = chain[blob[chain] >= 0]
        if named.size >= 2:
            out[chain] = _moved(laid[chain], place, blob[chain])
        elif named.size == 1:
            out[chain] += place[blob[named[0]]] - laid[named[0]]
    return out
