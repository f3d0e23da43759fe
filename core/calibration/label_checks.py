"""Checks of marker labels.

The palm: all 720 ways to label its six markers are compared, since a shift of all labels (WRIST clicked on the MCP5) is
still a palm to a check of exchanged pairs.

The digits: at the neutral pose fingers lie side by side. Flexion shortens the line of a finger in the image but does
not turn it aside; only wrong labels make it turn back, cross another line or jump to a neighbour.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations, pairwise, permutations

import numpy as np
from numpy.typing import NDArray

from carpus.core.model.hand.anatomy import REFERENCE_LENGTH_M, anatomy_from_size
from carpus.core.model.hand.kinematics import disc_centres
from carpus.core.model.hand.protocols import PALM_MARKERS, WRIST6, MarkerProtocol
from carpus.core.model.types import FloatArray, Side

_THUMB = 1
_OTHER_SIDE: dict[Side, Side] = {"right": "left", "left": "right"}


MAX_TURN_DEG = 50.0
"""A finger's line turns by less at each marker."""
MAX_THUMB_TURN_DEG = 75.0
"""The same for the thumb, whose base is free."""
MAX_LENGTH: tuple[float, ...] = (1.25, 0.85, 0.62, 0.45)
"""Longest segments of a finger, wrist to tip, over the distance from WRIST to MCP3."""
MAX_THUMB_LENGTH: tuple[float, ...] = (0.6, 0.95, 0.75, 0.62)
"""The same for the thumb."""
SHORT_LENGTH = 0.08
"""Shorter segments on that scale have no direction to check."""
LENGTH_WEIGHT = 4.0
"""Penalty for each such length too much; a crossing costs 1."""
TURN_PENALTY_DEG = 45.0
"""So much turn beyond the limit costs 1."""
ORDER_WEIGHT = 1.5
"""Penalty for an MCP out of order."""
MIN_DOUBTFUL_PENALTY = 1.2
"""Labels are questioned from here on: two bent fingers may cross once."""


@dataclass(frozen=True, slots=True)
class _FingerLines:
    """Lines of a protocol: chain of each digit, segments, pairs that should not cross, the four MCPs."""

    chains: dict[int, tuple[int, ...]]
    segments: tuple[tuple[int, int, int], ...]
    crossing_pairs: tuple[tuple[int, int], ...]
    knuckles: tuple[int, ...]


@lru_cache(maxsize=4)
def _finger_lines(protocol: MarkerProtocol) -> _FingerLines:
    chains = protocol.chains
    segments = tuple((a, b, digit) for digit, chain in chains.items() for a, b in pairwise(chain))
    # Segments of one finger, or from the wrist, cannot be checked for crossing; a thumb may lie on the palm.
    crossing_pairs = tuple(
        (i, j)
        for (i, (start, _, digit)), (j, (other_start, _, other_digit)) in combinations(enumerate(segments), 2)
        if digit != other_digit
        and start != other_start
        and not (_THUMB in (digit, other_digit) and 0 in (start, other_start))
    )
    return _FingerLines(chains, segments, crossing_pairs, protocol.rows(("MCP2", "MCP3", "MCP4", "MCP5")))


@dataclass(frozen=True, slots=True)
class LabelFault:
    """Labels that are exchanged (``swapped``, two of equal length), or a ``misplaced`` one."""

    swapped: tuple[tuple[str, ...], tuple[str, ...]] = ((), ())
    misplaced: str = ""


def find_label_fault(protocol: MarkerProtocol, side: Side, plan: FloatArray) -> LabelFault | None:
    """Find what is wrong with the labels of a plan view (M, 2), y up; None if nothing is."""
    lines = _finger_lines(protocol)
    current = _label_penalty(lines, side, plan)
    if current < MIN_DOUBTFUL_PENALTY:
        return None
    best = np.inf
    rows: tuple[tuple[int, ...], tuple[int, ...]] = ((0,), (0,))
    fingers = [chain[1:] for digit, chain in lines.chains.items() if digit != _THUMB]
    single = [((i,), (j,)) for i, j in combinations(range(len(plan)), 2)]
    for one, other in (*single, *combinations(fingers, 2)):
        trial = plan.copy()
        trial[[*one, *other]] = plan[[*other, *one]]
        value = _label_penalty(lines, side, trial)
        if value < best - 1e-9:
            best, rows = value, (one, other)
    names = protocol.markers
    exchanged = LabelFault((tuple(names[i] for i in rows[0]), tuple(names[i] for i in rows[1])))
    if best < MIN_DOUBTFUL_PENALTY:
        return exchanged
    # No exchange explains it all: one marker may lie outside the hand.
    marker, without = _find_misplaced_marker(lines, side, plan)
    is_misplaced = without < MIN_DOUBTFUL_PENALTY or best >= current - MIN_DOUBTFUL_PENALTY
    return LabelFault(misplaced=names[marker]) if is_misplaced else exchanged


def _find_misplaced_marker(lines: _FingerLines, side: Side, plan: FloatArray) -> tuple[int, float]:
    """Return the marker whose removal leaves the least penalty, and that penalty."""
    penalty = np.full(len(plan), np.inf)
    for chain in lines.chains.values():
        for place in range(1, len(chain)):
            trial = plan.copy()
            before = plan[chain[place - 1]]
            is_last = place + 1 == len(chain)
            after = before + 0.5 * (before - plan[chain[place - 2]]) if is_last else plan[chain[place + 1]]
            trial[chain[place]] = 0.5 * (before + after)
            penalty[chain[place]] = min(penalty[chain[place]], _label_penalty(lines, side, trial))
    return int(np.argmin(penalty)), float(penalty.min())


def _label_penalty(lines: _FingerLines, side: Side, plan: FloatArray) -> float:
    """Return the penalty of the labels, 0 for a usual hand."""
    size = float(np.median([np.hypot(*(plan[k] - plan[0])) for k in lines.knuckles]))
    if not size > 0.0:
        return 0.0
    penalty = 0.0
    for digit, chain in lines.chains.items():
        steps = np.diff(plan[list(chain)], axis=0)
        length = np.hypot(steps[:, 0], steps[:, 1])
        max_length = np.array(MAX_THUMB_LENGTH if digit == _THUMB else MAX_LENGTH)
        penalty += float(np.maximum(length / size - max_length, 0.0).sum()) * LENGTH_WEIGHT
        along = (steps[:-1] * steps[1:]).sum(axis=1)
        across = steps[:-1, 0] * steps[1:, 1] - steps[:-1, 1] * steps[1:, 0]
        turn_deg = np.degrees(np.abs(np.arctan2(across, along)))
        base_deg = MAX_THUMB_TURN_DEG if digit == _THUMB else MAX_TURN_DEG
        limit_deg = np.array([base_deg] * 2 + [MAX_TURN_DEG])
        # A very short segment, as of a finger along the line of sight, has no direction to check.
        weight = np.clip(np.minimum(length[:-1], length[1:]) / (SHORT_LENGTH * size), 0.0, 1.0)
        penalty += float((weight * np.maximum(turn_deg - limit_deg, 0.0)).sum()) / TURN_PENALTY_DEG
    start, end = (plan[[segment[end] for segment in lines.segments]] for end in (0, 1))
    penalty += float(find_crossings(start, end, np.array(lines.crossing_pairs, dtype=np.int64).reshape(-1, 2)).sum())
    ray = plan[list(lines.knuckles)] - plan[0]
    turn = ray[:-1, 0] * ray[1:, 1] - ray[:-1, 1] * ray[1:, 0]
    is_ordered = turn < 0.0 if side == "right" else turn > 0.0
    return penalty + ORDER_WEIGHT * int(np.count_nonzero(~is_ordered))


def find_crossings(start: FloatArray, end: FloatArray, pairs: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Select the ``pairs`` (K, 2) of segments, from ``start`` to ``end`` (P, 2), that cross."""

    def orientation(a: FloatArray, b: FloatArray, c: FloatArray) -> FloatArray:
        return np.asarray((b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0]))

    a, b, c, d = start[pairs[:, 0]], end[pairs[:, 0]], start[pairs[:, 1]], end[pairs[:, 1]]
    return np.asarray(
        (orientation(a, b, c) * orientation(a, b, d) < 0.0) & (orientation(c, d, a) * orientation(c, d, b) < 0.0)
    )


_PALM_PERMUTATIONS = np.array(list(permutations(range(len(PALM_MARKERS)))))


GOOD_PALM_MISFIT = 0.08
"""Share of the palm's size below which its labels are accepted.

Hands differ from the average by up to 0.05; the next best labelling of a right palm leaves 0.25.
"""
BETTER_LABELS_SHARE = 0.6
"""Another labelling must leave less than this share of the misfit."""


def find_shifted_labels(side: Side, palm_plan: FloatArray) -> tuple[str, ...]:
    """Return the wrong labels of a palm, empty if no other labelling fits clearly better.

    ``palm_plan`` (6, 2) is the plan view in the order of ``PALM_MARKERS``. Each label is followed by the right one for
    its marker: WRIST, MCP5 means that the marker clicked as WRIST is MCP5. Two labels are exchanged.
    """
    misfits = misfit(average_palm(side), palm_plan[_PALM_PERMUTATIONS])
    best = int(misfits.argmin())
    if misfits[0] < GOOD_PALM_MISFIT or misfits[best] > BETTER_LABELS_SHARE * misfits[0]:
        return ()
    if misfits[best] > misfit(average_palm(_OTHER_SIDE[side]), palm_plan):
        return ()  # the labels are in order, but on the other hand
    right_label = np.argsort(_PALM_PERMUTATIONS[best])  # of the marker clicked under each label
    wrong: list[int] = []
    for label in range(len(right_label)):
        while right_label[label] != label and label not in wrong:
            wrong.append(label)
            label = int(right_label[label])
    return tuple(PALM_MARKERS[i] for i in wrong)


def is_plausible_palm(side: Side, palm_plan: FloatArray) -> bool:
    """Return whether six proposed labels fit a palm of this hand better than any other, or the other hand."""
    misfits, others = (misfit(average_palm(one), palm_plan[_PALM_PERMUTATIONS]) for one in (side, _OTHER_SIDE[side]))
    return bool(misfits[0] < GOOD_PALM_MISFIT and misfits[0] == misfits.min() < others.min())


@lru_cache(maxsize=8)
def _average_plan(protocol: MarkerProtocol, side: Side) -> FloatArray:
    """Return the plan view (M, 2) of the average hand, m."""
    markers = disc_centres(anatomy_from_size(REFERENCE_LENGTH_M), np.zeros(17))[list(protocol.sites)]
    return markers[:, :2] * (1.0, 1.0 if side == "right" else -1.0)


def average_palm(side: Side) -> FloatArray:
    """Return the plan view (6, 2) of the average palm in the order of ``PALM_MARKERS``, m."""
    return _average_plan(WRIST6, side)


def misfit(average: FloatArray, plan: FloatArray) -> FloatArray:
    """Return the residual share (...) of the best similarity (no mirror) of plan views (..., M, 2)."""
    axes = np.array([1.0, 1j])
    source, target = (average - average.mean(axis=0)) @ axes, (plan - plan.mean(axis=-2, keepdims=True)) @ axes
    factor = target @ source.conj() / np.vdot(source, source)
    off = np.linalg.norm(target - factor[..., None] * source, axis=-1)
    return np.asarray(off / np.maximum(np.linalg.norm(target, axis=-1), 1e-12))


def misfit_per_removed_marker(average: FloatArray, plan: FloatArray) -> FloatArray:
    """Return the misfit (M,) that is left without each marker."""
    each = range(len(plan))
    return np.array([misfit(np.delete(average, k, axis=0), np.delete(plan, k, axis=0)) for k in each])


GOOD_SIDE_MISFIT = 0.05
"""Misfit below which the side is accepted: hands differ by up to so much."""
OTHER_SIDE_SHARE = 0.6
"""The other hand must leave less than this share of the misfit to be more likely."""


def plan_view(point_cam_m: FloatArray) -> FloatArray:
    """Project camera points (M, 3) to a plan view (M, 2), y up."""
    return np.stack((point_cam_m[:, 0], -point_cam_m[:, 1]), axis=1)


def is_other_side(protocol: MarkerProtocol, side: Side, plan: FloatArray) -> bool:
    """Return whether the markers are clearly the other hand's, not this one's with two labels swapped."""
    average = _average_plan(protocol, side)
    own_misfit, mirrored = misfit(average, plan), misfit(_average_plan(protocol, _OTHER_SIDE[side]), plan)
    if own_misfit < GOOD_SIDE_MISFIT or mirrored >= OTHER_SIDE_SHARE * own_misfit:
        return False
    pairs = np.array(list(combinations(range(len(plan)), 2)))
    swapped = np.repeat(plan[None], len(pairs), axis=0)
    which = np.arange(len(pairs))[:, None]
    swapped[which, pairs] = plan[pairs[:, ::-1]]
    return bool(mirrored < misfit(average, swapped).min())


QUESTIONED_MISFIT = 0.08
"""Misfit from which an unlabelled spot may replace a marker."""
BETTER_SPOT_SHARE = 0.6
"""A spot that replaces a marker must leave less than this share of the misfit."""
MAX_PALM_MISFIT = 0.17
"""Hands differ by up to 0.05, markers placed 4 mm off by up to 0.12."""
PALM_MARGIN_SHARE = 0.18
"""Spots within this share of the palm's length lie on the palm: one marker too many."""
MAX_SPARE_SPOTS = 2
"""More spots are the markers of a whole hand, or a pattern."""
SAME_SPOT_PX = 4.0
"""A spot within this distance of a marker is that marker."""
MAX_DEPTH_OFFSET_M = 0.06
"""A spot farther from the depth of the palm lies on something else."""
SAME_MARKER_RADII = 1.6
"""A spot within so many radii of a marker may be the marker itself."""


@dataclass(frozen=True, slots=True)
class OddMarker:
    """Marker of the palm in question, or a spare spot; rows, -1 for none.

    ``is_spot_better``: the spot makes a better palm than the marker.
    """

    marker: int
    spot: int
    is_spot_better: bool


def find_odd_marker(side: Side, palm_plan: FloatArray, spots_plan: FloatArray) -> OddMarker | None:
    """Find an odd marker of a palm (6, 2) among the unlabelled spots (S, 2), plan views."""
    average = average_palm(side)
    own_misfit = misfit(average, palm_plan)
    best = (float(own_misfit), -1, -1)
    if own_misfit >= QUESTIONED_MISFIT:
        for marker in range(len(palm_plan)):
            for spot in range(len(spots_plan)):
                other = palm_plan.copy()
                other[marker] = spots_plan[spot]
                best = min(best, (float(misfit(average, other)), marker, spot))
    if best[0] < BETTER_SPOT_SHARE * own_misfit:
        return OddMarker(best[1], best[2], is_spot_better=True)
    if own_misfit >= MAX_PALM_MISFIT:
        return OddMarker(int(misfit_per_removed_marker(average, palm_plan).argmin()), -1, is_spot_better=False)
    margin_m = PALM_MARGIN_SHARE * float(np.linalg.norm(palm_plan[3] - palm_plan[0]))
    spare = []
    for number, spot in enumerate(spots_plan):
        away = palm_plan - spot
        angles = np.sort(np.arctan2(away[:, 1], away[:, 0]))
        is_surrounded = np.diff(np.append(angles, angles[0] + 2.0 * np.pi)).max() < np.pi
        if is_surrounded or np.linalg.norm(away, axis=1).min() < margin_m:
            spare.append(number)
    return OddMarker(-1, spare[0], is_spot_better=False) if 0 < len(spare) <= MAX_SPARE_SPOTS else None
