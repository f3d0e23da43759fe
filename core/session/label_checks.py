"""Where a person says that markers are in a stored picture (and what a session tracked again says of that), and names
that are plainly wrong: two exchanged, or one where it cannot be.

The palm is as calibrated and does not bend: its names are judged by laying it on them. A finger's discs lie no further
from each other than on the straight finger, and fingers seen from above cross less with the right names than with two
exchanged. What is merely unusual is not spoken of.
"""

from __future__ import annotations

import json
import math
from collections.abc import Collection, Mapping
from contextlib import suppress
from dataclasses import dataclass
from datetime import datetime
from functools import lru_cache
from itertools import combinations, pairwise

import numpy as np
from numpy.typing import NDArray

from carpus.core.calibration.label_checks import find_crossings
from carpus.core.model import so3
from carpus.core.model.hand.protocols import MarkerProtocol
from carpus.core.model.types import FloatArray
from carpus.core.session.values import Session

SAME_BLOB_PX = 6.0
"""A place this near to a blob means the blob."""
MIN_PALM_MARKERS = 3
MAX_FIT_ERROR_M = 0.004
_NOWHERE = np.full(2, np.nan)


@dataclass(frozen=True, slots=True)
class Correction:
    """What a person said of picture ``row``: places (u, v) by marker, None for one that is not to be seen there."""

    row: int
    places: Mapping[str, tuple[float, float] | None]


def predict_marker_px(session: Session, row: int, places: FloatArray, number: int) -> FloatArray:
    """Where (2,) in picture ``row`` the other discs of the palm at ``places`` (M, 2) expect marker ``number``.

    The palm as calibrated is laid on the others by their depths; of a disc on a finger, and where fewer than three
    others have a depth, it is where the model has it. NaN where nothing is known.
    """
    camera, markers = session.camera, session.markers
    model_m = markers.position_cam_m[row]
    own = camera.distort(camera.project(model_m[number][None]))[0] if np.isfinite(model_m[number]).all() else _NOWHERE
    palm = list(session.header.protocol.palm)
    if number not in palm:
        return own
    others = [k for k in palm if k != number and np.isfinite(places[k]).all()]
    depth_m = np.array([_marker_depth_m(session, row, k) for k in others])
    known = np.isfinite(depth_m)
    if np.count_nonzero(known) < MIN_PALM_MARKERS:
        return own
    seen_m = camera.backproject(camera.undistort(places[others][known]), depth_m[known])
    shape_m = session.calibration.marker_position_w0_m
    at_m = _map_by_palm(shape_m[np.array(others)[known]], seen_m, shape_m[number])
    return np.asarray(camera.distort(camera.project(at_m[None]))[0])


def _map_by_palm(shape_m: FloatArray, seen_m: FloatArray, point_m: FloatArray) -> FloatArray:
    """Where a point (3,) of the shape lies when its discs (K, 3) are laid on what is seen of them (K, 3). One disc that
    none of the others agrees with is left out: it has a wrong place itself."""
    rotation, shift, misfit_m = _fit_rigid(shape_m, seen_m)
    count = len(shape_m)
    if misfit_m > MAX_FIT_ERROR_M and count > MIN_PALM_MARKERS:
        without = [_fit_rigid(shape_m[np.arange(count) != k], seen_m[np.arange(count) != k]) for k in range(count)]
        best = min(without, key=lambda one: one[2])
        if best[2] < 0.5 * misfit_m:
            rotation, shift, _ = best
    return np.asarray(rotation @ point_m + shift)


def _fit_rigid(shape_m: FloatArray, seen_m: FloatArray) -> tuple[FloatArray, FloatArray, float]:
    """Rotation and shift that lay a shape on what is seen, and the root mean square of what is left, metres."""
    rotation, shift = so3.fit_rigid_transform(shape_m, seen_m)
    left_m = shape_m @ rotation.T + shift - seen_m
    return rotation, shift, float(np.sqrt((left_m**2).sum(axis=1).mean()))


def _marker_depth_m(session: Session, row: int, number: int) -> float:
    measured = float(session.markers.measured_depth_m[row, number])
    return measured if np.isfinite(measured) else float(session.markers.position_cam_m[row, number, 2])


IndexArray = NDArray[np.int64]

MAX_PALM_MISFIT_M = 0.005
"""Root mean square beyond which the palm's names are asked about; discs on moving skin stay below it."""
MAX_PALM_OFFSET_M = 0.012
"""Further than this from where the other discs of the palm expect it no disc of the palm lies."""
MAX_STRETCH, STRETCH_MARGIN_M = 1.4, 0.010
"""A finger that bends stretches the way from disc to disc over its back by no more than this."""

CROSSING_WEIGHT, MIN_SWAP_GAIN = 0.15, 0.12
"""What a crossing counts as against length, and what an exchange of two names must gain to be spoken of."""

_THUMB = 1

EXTENDED_SHARE = 0.8
"""Share of its length from which on a finger counts as seen at length."""


@dataclass(frozen=True, slots=True)
class LabelDoubt:
    """``swapped`` names that stand in for each other, or ``misplaced`` one that is ``offset_m`` from where it can
    be."""

    swapped: tuple[str, str] | None = None
    misplaced: str = ""
    offset_m: float = math.nan


def find_label_doubt(session: Session, row: int, places: FloatArray, changed: Collection[str]) -> LabelDoubt | None:
    """What is plainly wrong with the names at ``places`` (M, 2) of picture ``row``, of which a person ``changed`` some;
    None when nothing is. Only what has to do with a changed one is told."""
    markers = list(session.header.protocol.markers)
    numbers = {markers.index(name) for name in changed}
    if not numbers:
        return None
    depth_m = _place_depths_m(session, row, places)
    pair, alone = _find_palm_doubt(session, row, places, depth_m, numbers)
    if pair is None and session.header.protocol.has_fingers:
        pair = _find_swapped_fingers(session, places, numbers, palm_too=alone is not None)
        if pair is None and alone is None:
            alone = _find_misplaced_finger(session, places, depth_m, numbers)
    if pair is not None:
        return LabelDoubt((markers[pair[0]], markers[pair[1]]))
    return None if alone is None else LabelDoubt(None, markers[alone[0]], alone[1])


def _place_depths_m(session: Session, row: int, places: FloatArray) -> FloatArray:
    """Depth (M,) at the places: what was measured of the disc that was there, else what is known of the marker."""
    before = session.markers.measured_px[row]
    measured = session.markers.measured_depth_m[row]
    model = session.markers.position_cam_m[row, :, 2]
    own = np.where(np.isfinite(measured), measured, model)
    known = own[np.isfinite(own)]
    out = np.where(np.isfinite(own), own, float(np.median(known)) if len(known) else math.nan)
    for number, place in enumerate(places):
        away = np.linalg.norm(before - place, axis=1)
        if np.isfinite(away).any() and np.nanmin(away) <= SAME_BLOB_PX:
            there = int(np.nanargmin(away))
            out[number] = measured[there] if np.isfinite(measured[there]) else out[number]
    return np.asarray(out)


def _find_palm_doubt(
    session: Session, row: int, places: FloatArray, depth_m: FloatArray, changed: set[int]
) -> tuple[tuple[int, int] | None, tuple[int, float] | None]:
    """Two of the palm's names that were exchanged, or one that is somewhere else and how far, metres."""
    palm = [k for k in session.header.protocol.palm if np.isfinite(places[k]).all() and np.isfinite(depth_m[k])]
    if len(palm) <= MIN_PALM_MARKERS or not changed & set(palm):
        return None, None
    camera, shape_m = session.camera, session.calibration.marker_position_w0_m
    seen_m = camera.backproject(camera.undistort(places[palm]), depth_m[palm])
    now_m = _fit_rigid(shape_m[palm], seen_m)[2]
    if now_m <= MAX_PALM_MISFIT_M:
        return None, None
    best_m, pair = now_m, (0, 0)
    for one, other in combinations(range(len(palm)), 2):
        order = np.arange(len(palm))
        order[[one, other]] = order[[other, one]]
        trial_m = _fit_rigid(shape_m[palm], seen_m[order])[2]
        if trial_m < best_m:
            best_m, pair = trial_m, (palm[one], palm[other])
    if best_m < 0.5 * now_m and best_m <= MAX_PALM_MISFIT_M and changed & set(pair):
        return pair, None
    off = []
    for number in sorted(changed & set(palm)):
        away_px = float(np.linalg.norm(places[number] - predict_marker_px(session, row, places, number)))
        off.append((away_px * float(depth_m[number]) / camera.fx_px, number))
    far_m, worst = max(off)
    return None, ((worst, far_m) if far_m > MAX_PALM_OFFSET_M else None)


def _find_swapped_fingers(
    session: Session, places: FloatArray, changed: set[int], *, palm_too: bool
) -> tuple[int, int] | None:
    """Two discs of different fingers that were exchanged: without that the lines of the fingers are clearly shorter."""
    protocol = session.header.protocol
    size_px = float(np.linalg.norm(places[protocol.markers.index("MCP3")] - places[0]))
    finger = {number: digit for digit, chain in protocol.chains.items() for number in chain[1:]}
    palm = set() if palm_too else set(protocol.palm)
    seen = [k for k in finger if np.isfinite(places[k]).all() and k not in palm]
    trials = []
    for number in sorted(changed & set(seen)) if size_px > 0.0 else ():
        for other in seen:
            trial = places.copy()
            trial[[number, other]] = places[[other, number]]
            if finger[other] == finger[number] and not _is_extended(session, trial, size_px, finger[number]):
                continue  # along a bent finger discs lie in any order
            # A thumb may lie across the palm.
            gain = _compute_tangle(protocol, places, size_px) - _compute_tangle(protocol, trial, size_px)
            gain *= 0.5 if _THUMB in (finger[number], finger[other]) else 1.0
            trials.append((gain, (min(number, other), max(number, other))))
    best, pair = max(trials, default=(0.0, (0, 0)))
    return pair if best > MIN_SWAP_GAIN else None


def _is_extended(session: Session, places: FloatArray, size_px: float, finger: int) -> bool:
    """Whether a finger is seen at nearly its whole length."""
    protocol, shape_m = session.header.protocol, session.calibration.marker_position_w0_m
    chain = list(protocol.chains[finger][1:])
    if not np.isfinite(places[chain]).all():
        return False
    palm_m = float(np.linalg.norm(shape_m[protocol.markers.index("MCP3")] - shape_m[0]))
    seen = float(np.linalg.norm(np.diff(places[chain], axis=0), axis=1).sum()) / size_px
    whole = float(np.linalg.norm(np.diff(shape_m[chain], axis=0), axis=1).sum()) / palm_m
    return seen >= EXTENDED_SHARE * whole


def _find_misplaced_finger(
    session: Session, places: FloatArray, depth_m: FloatArray, changed: set[int]
) -> tuple[int, float] | None:
    """A finger's disc that is further from its neighbour than the finger is long, and by how much, metres."""
    shape_m, camera = session.calibration.marker_position_w0_m, session.camera
    flat_m = camera.backproject(camera.undistort(places), depth_m)[:, :2]
    for chain in session.header.protocol.chains.values():
        for one, other in pairwise(chain[1:]):
            apart_m = float(np.linalg.norm(flat_m[one] - flat_m[other]))
            more_m = apart_m - MAX_STRETCH * float(np.linalg.norm(shape_m[one] - shape_m[other])) - STRETCH_MARGIN_M
            if more_m > 0.0 and {one, other} & changed:
                return (other if other in changed else one), more_m
    return None


def _compute_tangle(protocol: MarkerProtocol, places: FloatArray, size_px: float) -> float:
    """How long the fingers' lines are, in lengths from the wrist to the middle knuckle, and how often they cross."""
    pieces, pairs = _finger_segments(protocol)
    start, end = places[pieces[:, 0]], places[pieces[:, 1]]
    length_px = float(np.nansum(np.linalg.norm(start - end, axis=1)))
    return length_px / size_px + CROSSING_WEIGHT * float(np.count_nonzero(find_crossings(start, end, pairs)))


@lru_cache(maxsize=4)
def _finger_segments(protocol: MarkerProtocol) -> tuple[IndexArray, IndexArray]:
    """Pieces (P, 2) of the fingers' lines as rows of markers, and pairs (K, 2) of pieces of different fingers that
    share no disc."""
    ends = [(a, b, digit) for digit, chain in protocol.chains.items() for a, b in pairwise(chain)]
    pairs = [
        (i, j)
        for i, j in combinations(range(len(ends)), 2)
        if ends[i][2] != ends[j][2] and not set(ends[i][:2]) & set(ends[j][:2])
    ]
    return np.array([(a, b) for a, b, _ in ends]), np.array(pairs, dtype=np.int64).reshape(-1, 2)


CORRECTED = "corrected"
"""The event of a corrected session: when, which markers, and who."""


@dataclass(frozen=True, slots=True)
class CorrectionSummary:
    """``corrected_at`` the session was tracked again, ``first_corrected_s`` seconds after its first frame the first
    picture that was put
    right, ``markers`` their names, ``initials`` the initials of who did, empty for unknown."""

    corrected_at: datetime
    first_corrected_s: float
    markers: tuple[str, ...]
    initials: str = ""


def correction_to_json(correction: Correction, initials: str) -> str:
    """The text of the event."""
    places = {
        name: None if place is None else [round(place[0], 1), round(place[1], 1)]
        for name, place in correction.places.items()
    }
    return json.dumps({"markers": places} | ({"by": initials} if initials else {}), sort_keys=True)


def read_corrections(session: Session) -> tuple[tuple[Correction, str], ...]:
    """All that was put right in a session, each with the initials of who did; a text that cannot be read says only
    when."""
    out = []
    for event in session.events:
        if event.kind != CORRECTED or not len(session):
            continue
        places: dict[str, tuple[float, float] | None] = {}
        by = ""
        with suppress(ValueError, TypeError, AttributeError, IndexError):
            told = json.loads(event.text)
            by = str(told.get("by", ""))
            places = {
                str(name): None if place is None else (float(place[0]), float(place[1]))
                for name, place in told.get("markers", {}).items()
            }
        row = int(abs(session.timestamp_s - event.time_s).argmin())
        out.append((Correction(row, places), by))
    return tuple(sorted(out, key=lambda one: one[0].row))


def summarize_corrections(session: Session) -> CorrectionSummary | None:
    """Since when a session stands corrected; None for one as measured."""
    said = read_corrections(session)
    if not said:
        return None
    names = dict.fromkeys(name for correction, _ in said for name in correction.places)
    people = dict.fromkeys(by for _, by in said if by)
    start_s = float(session.timestamp_s[0])
    return CorrectionSummary(
        datetime.fromisoformat(session.header.created),
        float(session.timestamp_s[said[0][0].row]) - start_s,
        tuple(names),
        ", ".join(people),
    )
