"""Corrections of marker labels, and a check for labels that are clearly wrong: two swapped, or one misplaced.

The palm is rigid as calibrated: its labels are checked by fitting it to them. The markers of a finger are no farther
apart than on the straight finger, and fingers seen from above cross less with the right labels than with two swapped.
Labels that are merely unusual are not reported.
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
"""Places nearer to a blob than this mean the blob."""
MIN_PALM_MARKERS = 3
MAX_FIT_ERROR_M = 0.004
_NOWHERE = np.full(2, np.nan)


@dataclass(frozen=True, slots=True)
class Correction:
    """Corrected places (u, v) by marker in one frame; None for a marker that is not visible."""

    row: int
    places: Mapping[str, tuple[float, float] | None]


def predict_marker_px(session: Session, row: int, places: FloatArray, number: int) -> FloatArray:
    """Predict a marker's place from the other markers of the palm.

    The calibrated palm is fitted to the others by their depths. For a marker on a finger, and if fewer than three
    others have a depth, it is the place in the stored model.

    ``places`` (M, 2) are the pixels of all markers in frame ``row``, ``number`` is the index of the marker. Returns a
    pixel (2,), NaN if unknown.
    """
    camera, markers = session.camera, session.markers
    model_m = markers.position_cam_m[row]
    own = camera.distort(camera.project(model_m[number][None]))[0] if np.isfinite(model_m[number]).all() else _NOWHERE
    palm = list(session.header.protocol.palm)
    if number not in palm:
        return own
    others = [k for k in palm if k != number and np.isfinite(places[k]).all()]
    measured_depth_m = markers.measured_depth_m[row, others]
    depth_m = np.where(np.isfinite(measured_depth_m), measured_depth_m, markers.position_cam_m[row, others, 2])
    known = np.isfinite(depth_m)
    if np.count_nonzero(known) < MIN_PALM_MARKERS:
        return own
    measured_m = camera.backproject(camera.undistort(places[others][known]), depth_m[known])
    shape_m = session.calibration.marker_position_w0_m
    others_m = shape_m[np.array(others)[known]]
    rotation, shift, misfit_m = _fit_rigid(others_m, measured_m)
    if misfit_m > MAX_FIT_ERROR_M and len(others_m) > MIN_PALM_MARKERS:  # the place of one of them may be wrong
        each = range(len(others_m))
        without = [_fit_rigid(np.delete(others_m, k, axis=0), np.delete(measured_m, k, axis=0)) for k in each]
        best = min(without, key=lambda one: one[2])
        if best[2] < 0.5 * misfit_m:
            rotation, shift, _ = best
    position_m = rotation @ shape_m[number] + shift
    return np.asarray(camera.distort(camera.project(position_m[None]))[0])


def _fit_rigid(shape_m: FloatArray, measured_m: FloatArray) -> tuple[FloatArray, FloatArray, float]:
    """Return rotation and translation that fit a shape to its measurement, and the RMS residual in metres."""
    rotation, shift = so3.fit_rigid_transform(shape_m, measured_m)
    left_m = shape_m @ rotation.T + shift - measured_m
    return rotation, shift, float(np.sqrt((left_m**2).sum(axis=1).mean()))


IndexArray = NDArray[np.int64]

MAX_PALM_MISFIT_M = 0.005
"""RMS residual of correct labels of the palm: markers on moving skin stay below it."""
MAX_PALM_OFFSET_M = 0.012
"""A marker of the palm is no farther than this from the place that the others predict."""
MAX_STRETCH, STRETCH_MARGIN_M = 1.4, 0.010
"""A bending finger stretches the distance of its markers over its back by no more than this."""

CROSSING_WEIGHT, MIN_SWAP_GAIN = 0.15, 0.12
"""Weight of a crossing against length, and gain from which on a swap is reported."""

_THUMB = 1

EXTENDED_SHARE = 0.8
"""Share of its length from which on a finger counts as seen at full length."""


@dataclass(frozen=True, slots=True)
class LabelDoubt:
    """Doubt about labels: two ``swapped``, or one ``misplaced`` by ``offset_m``."""

    swapped: tuple[str, str] | None = None
    misplaced: str = ""
    offset_m: float = math.nan


def find_label_doubt(session: Session, row: int, places: FloatArray, changed: Collection[str]) -> LabelDoubt | None:
    """Return what is clearly wrong with the labels at ``places`` (M, 2), or None.

    Only doubts about a ``changed`` label are reported.
    """
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
    """Return the depth (M,) at the places: that of the blob there, else that known of the marker."""
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
    """Return two swapped labels of the palm, or one misplaced and its offset in metres."""
    palm = [k for k in session.header.protocol.palm if np.isfinite(places[k]).all() and np.isfinite(depth_m[k])]
    if len(palm) <= MIN_PALM_MARKERS or not changed & set(palm):
        return None, None
    camera, shape_m = session.camera, session.calibration.marker_position_w0_m
    measured_m = camera.backproject(camera.undistort(places[palm]), depth_m[palm])
    misfit_m = _fit_rigid(shape_m[palm], measured_m)[2]
    if misfit_m <= MAX_PALM_MISFIT_M:
        return None, None
    best_m, pair = misfit_m, (0, 0)
    for one, other in combinations(range(len(palm)), 2):
        order = np.arange(len(palm))
        order[[one, other]] = order[[other, one]]
        trial_m = _fit_rigid(shape_m[palm], measured_m[order])[2]
        if trial_m < best_m:
            best_m, pair = trial_m, (palm[one], palm[other])
    if best_m < 0.5 * misfit_m and best_m <= MAX_PALM_MISFIT_M and changed & set(pair):
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
    """Return two swapped markers of different fingers: without the swap the fingers' lines are clearly shorter."""
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
    """Return whether a finger is seen at nearly its whole length."""
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
    """Return a finger's marker farther from its neighbour than the finger allows, and by how many metres."""
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
    """Return the length of the fingers' lines, in lengths of the palm, plus their weighted crossings."""
    pieces, pairs = _finger_segments(protocol)
    start, end = places[pieces[:, 0]], places[pieces[:, 1]]
    length_px = float(np.nansum(np.linalg.norm(start - end, axis=1)))
    return length_px / size_px + CROSSING_WEIGHT * float(np.count_nonzero(find_crossings(start, end, pairs)))


@lru_cache(maxsize=4)
def _finger_segments(protocol: MarkerProtocol) -> tuple[IndexArray, IndexArray]:
    """Return the segments (P, 2) of the fingers as marker indices, and the pairs (K, 2) that may cross."""
    ends = [(a, b, digit) for digit, chain in protocol.chains.items() for a, b in pairwise(chain)]
    pairs = [
        (i, j)
        for i, j in combinations(range(len(ends)), 2)
        if ends[i][2] != ends[j][2] and not set(ends[i][:2]) & set(ends[j][:2])
    ]
    return np.array([(a, b) for a, b, _ in ends]), np.array(pairs, dtype=np.int64).reshape(-1, 2)


CORRECTED = "corrected"
"""Event of a corrected session: when, which markers, and who."""


@dataclass(frozen=True, slots=True)
class CorrectionSummary:
    """Summary of a session's corrections.

    Attributes
    ----------
    corrected_at : datetime
        When the session was tracked again.
    first_corrected_s : float
        Time of the first corrected frame since the start.
    markers : tuple of str
        Corrected markers.
    initials : str
        Who corrected them, empty if unknown.
    """

    corrected_at: datetime
    first_corrected_s: float
    markers: tuple[str, ...]
    initials: str = ""


def correction_to_json(correction: Correction, initials: str) -> str:
    """Return a correction as the text of its event."""
    places = {
        name: None if place is None else [round(place[0], 1), round(place[1], 1)]
        for name, place in correction.places.items()
    }
    return json.dumps({"markers": places} | ({"by": initials} if initials else {}), sort_keys=True)


def read_corrections(session: Session) -> tuple[tuple[Correction, str], ...]:
    """Return all corrections of a session with the initials of who made them.

    Of a text that cannot be parsed only the time is known.
    """
    out = []
    for event in session.events:
        if event.kind != CORRECTED or not len(session):
            continue
        places: dict[str, tuple[float, float] | None] = {}
        by = ""
        with suppress(ValueError, TypeError, AttributeError, IndexError):
            content = json.loads(event.text)
            by = str(content.get("by", ""))
            places = {
                str(name): None if place is None else (float(place[0]), float(place[1]))
                for name, place in content.get("markers", {}).items()
            }
        row = int(abs(session.timestamp_s - event.time_s).argmin())
        out.append((Correction(row, places), by))
    return tuple(sorted(out, key=lambda one: one[0].row))


def summarize_corrections(session: Session) -> CorrectionSummary | None:
    """Summarise the corrections of a session; None if there are none."""
    corrections = read_corrections(session)
    if not corrections:
        return None
    names = dict.fromkeys(name for correction, _ in corrections for name in correction.places)
    people = dict.fromkeys(by for _, by in corrections if by)
    start_s = float(session.timestamp_s[0])
    return CorrectionSummary(
        datetime.fromisoformat(session.header.created),
        float(session.timestamp_s[corrections[0][0].row]) - start_s,
        tuple(names),
        ", ".join(people),
    )
