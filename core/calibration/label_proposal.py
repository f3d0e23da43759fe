"""Label proposal for the markers of a flat hand; a person confirms them.

The average hand in several postures is fitted to the blobs by rotation, shift and scale in the image plane, in metres
where depth is known; then each finger may turn and stretch. The back of the hand faces the camera, so the side decides
which of two mirror images it is.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from carpus.core.calibration.label_checks import average_palm, is_plausible_palm, misfit, misfit_per_removed_marker
from carpus.core.model.camera import Camera
from carpus.core.model.hand.anatomy import anatomy_from_size
from carpus.core.model.hand.kinematics import disc_centres
from carpus.core.model.hand.protocols import SITES, MarkerProtocol, joint_angle_names
from carpus.core.model.types import Detections, FloatArray, Side

IntArray = NDArray[np.int64]


REFERENCE_HAND_M = 0.180
"""Length of the average hand that is fitted."""
MIN_SCALE = 0.62
"""With :data:`MAX_SCALE`: hands 112 to 225 mm long."""
MAX_SCALE = 1.25
"""Largest scale of the average hand."""
GATE_M = 0.016
"""Gate of the first, rough fit, for a hand of average length."""
MAX_REFINED_FITS = 24
"""Number of rough fits that are refined; more only cost time."""
MAX_FIT_DISTANCE_M = 0.011
"""A blob farther from the fitted marker does not get its label."""
MIN_LABEL_MARGIN_M = 0.006
"""Another blob must be farther away by this for a sure label."""
MAX_PROPOSED_MISFIT = 0.12
"""Palm misfit from which one of its markers is something else: simulated hands leave up to 0.05."""
MAX_DEPTH_OFFSET_M = 0.030
"""A blob farther from the depth of the others lies on something else."""
DEFAULT_DEPTH_M = 0.7
"""Distance of the hand if no depth is measured."""


@dataclass(frozen=True, slots=True)
class LabelProposal:
    """Proposed ``blob`` (M,) of each marker, -1 for none, and whether no other label is nearly as good.

    ``misfit_m`` (M,) is the distance of the blob from its place on the average hand, NaN without one.
    """

    blob: IntArray
    is_sure: NDArray[np.bool_]
    misfit_m: FloatArray


def propose_labels(
    blobs: Detections,
    camera: Camera,
    side: Side,
    protocol: MarkerProtocol,
    given_labels: Mapping[int, int] | None = None,
) -> LabelProposal:
    """Propose labels for the blobs of a flat, neutral hand with its back to the camera.

    ``given_labels`` are blobs (values) that a person has labelled (keys, rows of ``protocol``); they stay and decide
    between hands that fit alike. Without a likely hand only these are labelled.
    """
    fixed = dict(given_labels or {})
    rows = np.array(protocol.sites)
    # Positions are complex, x - iy in metres, with x right and y down in the camera.
    has_depth = np.isfinite(blobs.depth_m)
    median_m = float(np.median(blobs.depth_m[has_depth])) if has_depth.any() else DEFAULT_DEPTH_M
    point = camera.backproject(camera.undistort(blobs.pixel), np.where(has_depth, blobs.depth_m, median_m))
    position = point[:, 0] - 1j * point[:, 1]
    fits = _find_rough_fits(position, rows, side, fixed)
    chains = [np.array(chain[1:]) for chain in protocol.chains.values()]
    refined = sorted((_refine_fit(position, fit, fixed, chains) for fit in fits), key=lambda one: one.cost)
    if not refined or np.count_nonzero(refined[0].blob >= 0) < max(4, rows.size // 2):
        blob = np.full(rows.size, -1, dtype=np.int64)
        blob[list(fixed)] = list(fixed.values())
        return LabelProposal(blob, blob >= 0, np.full(rows.size, np.nan))
    best = refined[0]
    sure = best.is_sure.copy()
    for other in refined:
        # Another hand that explains the blobs nearly as well: where it disagrees, nothing is sure.
        if other.cost < best.cost + 0.5:
            sure &= other.blob == best.blob
    if not protocol.has_fingers and (best.blob >= 0).all():
        # Six markers of the other hand, rotated, may fit too: then a person checks each label.
        sure &= is_plausible_palm(side, np.stack((position[best.blob].real, position[best.blob].imag), axis=1))
    sure[list(fixed)] = True
    blob = _drop_implausible_palm_labels(best.blob, position, blobs.depth_m, fixed, side, protocol)
    return LabelProposal(blob, sure & (blob >= 0), np.where(blob >= 0, best.misfit_m, np.nan))


def _drop_implausible_palm_labels(
    blob: IntArray,
    position: FloatArray,
    depth_m: FloatArray,
    given_labels: Mapping[int, int],
    side: Side,
    protocol: MarkerProtocol,
) -> IntArray:
    """Remove labels (M,) from spots where no palm has the marker; a person's own labels stay.

    Four markers fit too many things to tell which of them is odd.
    """
    out, rows = blob.copy(), np.array(protocol.palm)
    free = np.array([row not in given_labels for row in rows])
    while np.count_nonzero(out[rows] >= 0) > 4:
        named = out[rows] >= 0
        spots = out[rows[named]]
        off_m = np.abs(depth_m[spots] - np.median(depth_m[spots]))
        if (off_m > MAX_DEPTH_OFFSET_M).any():
            badness = off_m
        else:
            average, plan = average_palm(side)[named], np.stack((position[spots].real, position[spots].imag), axis=1)
            if misfit(average, plan) < MAX_PROPOSED_MISFIT:
                break
            badness = 1.0 - misfit_per_removed_marker(average, plan)
        badness = np.where(free[named], badness, -1.0)
        if badness.max() < 0.0:
            break
        out[rows[named][int(badness.argmax())]] = -1
    return out


@dataclass(frozen=True, slots=True)
class _HandFit:
    """Posture fitted to the blobs: positions (M,), complex, and its scale."""

    position: FloatArray
    scale: float


@dataclass(frozen=True, slots=True)
class _LabelledFit:
    blob: IntArray
    is_sure: NDArray[np.bool_]
    misfit_m: FloatArray
    cost: float


@lru_cache(maxsize=4)
def _flat_postures(side: Side, reference_m: float) -> FloatArray:
    """Return positions (P, 21), complex x + iy in W, of the average hand in usual flat postures."""
    names = joint_angle_names()
    hand = anatomy_from_size(reference_m, side=side, nail_discs=True)
    out = []
    for spread in (-4.0, 4.0, 12.0):
        for thumb_extension, thumb_abduction in ((0.0, 5.0), (20.0, 10.0), (35.0, 25.0), (-10.0, 30.0)):
            angles = dict.fromkeys(names, 0.0)
            angles |= {"CMC1_extension": thumb_extension, "CMC1_abduction": thumb_abduction}
            angles |= {"MCP2_abduction": spread, "MCP4_abduction": -spread, "MCP5_abduction": -1.5 * spread}
            marker_m = disc_centres(hand, np.radians([angles[name] for name in names]))
            out.append(marker_m[:, 0] + 1j * marker_m[:, 1])
    return np.array(out)


def _find_rough_fits(
    position: FloatArray, rows: IntArray, side: Side, given_labels: Mapping[int, int]
) -> list[_HandFit]:
    """Return the best rough fits, best first: two markers of a posture on two blobs."""
    if position.size < 3:
        return []
    first, second = np.nonzero(~np.eye(position.size, dtype=bool))  # all ordered pairs of blobs
    found: list[tuple[float, _HandFit]] = []
    for posture in _flat_postures(side, REFERENCE_HAND_M)[:, rows]:
        for a, b in _anchor_pairs(rows, given_labels):
            starts, ends = first, second
            if a in given_labels and b in given_labels:
                starts, ends = np.array([given_labels[a]]), np.array([given_labels[b]])
            turn = (position[ends] - position[starts]) / (posture[b] - posture[a])
            scale = np.abs(turn)
            usable = (scale > MIN_SCALE) & (scale < MAX_SCALE)
            turn, start, scale = turn[usable], position[starts][usable], scale[usable]
            if not turn.size:
                continue
            placed = start[:, None] + turn[:, None] * (posture - posture[a])
            near2 = (np.abs(placed[:, :, None] - position).min(axis=2) / (GATE_M * scale[:, None])) ** 2
            # A marker counts the more the nearer a blob is; a hand of the usual size a little more.
            score = np.maximum(1.0 - near2, 0.0).sum(axis=1) - 2.0 * np.log(scale) ** 2
            for row, blob in given_labels.items():
                score -= 4.0 * (np.abs(placed[:, row] - position[blob]) > 2.0 * GATE_M)
            for i in np.argsort(-score)[:6]:
                found.append((float(score[i]), _HandFit(placed[i], float(scale[i]))))
    found.sort(key=lambda one: -one[0])
    return [fit for _, fit in found[:MAX_REFINED_FITS]]


def _anchor_pairs(rows: IntArray, given_labels: Mapping[int, int]) -> list[tuple[int, int]]:
    """Return pairs of markers, far apart, on which a posture is placed; given ones if there are two."""
    if len(given_labels) >= 2:
        named = list(given_labels)
        return [(named[0], other) for other in named[1:]]
    at = {int(row): i for i, row in enumerate(rows)}
    names = (("WRIST", "TIP3"), ("WRIST", "MCP3"), ("CMC1", "TIP4"), ("MCP2", "MCP5"), ("TIP2", "TIP5"))
    pairs = [(at.get(SITES.index(a), -1), at.get(SITES.index(b), -1)) for a, b in names]
    return [(a, b) for a, b in pairs if a >= 0 and b >= 0]


def _refine_fit(
    position: FloatArray, fit: _HandFit, given_labels: Mapping[int, int], chains: Sequence[IntArray]
) -> _LabelledFit:
    """Assign blobs by least distance, while first the whole hand and then each digit moves to them."""
    placed = fit.position
    reach = 2.2 * GATE_M * fit.scale
    for step in range(6):
        blob = _assign_blobs(position, placed, reach, given_labels)
        placed = _fit_similarity(placed, position, blob) if step < 3 else _fit_digits(placed, position, blob, chains)
        reach = max(0.7 * reach, MAX_FIT_DISTANCE_M * fit.scale)
    blob = _assign_blobs(position, placed, reach, given_labels)
    distance = np.abs(placed[:, None] - position)
    own = np.where(blob >= 0, distance[np.arange(blob.size), blob], np.nan)
    others = distance.copy()
    others[np.arange(blob.size)[blob >= 0], blob[blob >= 0]] = np.inf
    sure = (blob >= 0) & (others.min(axis=1, initial=np.inf) - own > MIN_LABEL_MARGIN_M * fit.scale)
    size = math.log(fit.scale)
    cost = float(np.where(blob >= 0, (own / (MAX_FIT_DISTANCE_M * fit.scale)) ** 2, 2.0).sum()) + 2.0 * size**2
    return _LabelledFit(blob, sure, own, cost)


def _assign_blobs(
    position: FloatArray, predicted: FloatArray, gate: float, given_labels: Mapping[int, int]
) -> IntArray:
    """Return the blob of each marker (M,), -1 if none is within the gate, by the least total cost."""
    from scipy.optimize import linear_sum_assignment  # a third of a second to load

    distance = np.abs(predicted[:, None] - position)
    cost = np.minimum(distance, gate) ** 2
    for row, blob in given_labels.items():
        cost[row, :] = cost[:, blob] = 4.0 * gate**2
        cost[row, blob] = -1.0
    markers, blobs = linear_sum_assignment(cost)
    out = np.full(predicted.size, -1, dtype=np.int64)
    near = distance[markers, blobs] < gate
    out[markers[near]] = blobs[near]
    for row, blob in given_labels.items():
        out[out == blob] = -1
        out[row] = blob
    return out


def _fit_similarity(predicted: FloatArray, position: FloatArray, blob: IntArray) -> FloatArray:
    """Fit the markers to their blobs by one rotation, shift and scale."""
    named = blob >= 0
    if np.count_nonzero(named) < 2:
        return predicted
    source, target = predicted[named], position[blob[named]]
    centre, middle = source.mean(), target.mean()
    spread = float((np.abs(source - centre) ** 2).sum())
    turn = ((target - middle) * np.conj(source - centre)).sum() / spread if spread > 0.0 else 1.0
    return np.asarray(middle + turn * (predicted - centre))


def _fit_digits(predicted: FloatArray, position: FloatArray, blob: IntArray, chains: Sequence[IntArray]) -> FloatArray:
    """Fit each digit by itself; its unassigned markers follow."""
    out = predicted.copy()
    if not chains:
        return _fit_similarity(predicted, position, blob)
    for chain in chains:
        named = chain[blob[chain] >= 0]
        if named.size >= 2:
            out[chain] = _fit_similarity(predicted[chain], position, blob[chain])
        elif named.size == 1:
            out[chain] += position[blob[named[0]]] - predicted[named[0]]
    return out
