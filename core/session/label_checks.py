"""Corrections of marker labels."""

from __future__ import annotations

import json
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from datetime import datetime

import numpy as np

from carpus.core.model import so3
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


CORRECTED = "corrected"
"""Event of a corrected session: when, which markers, and who."""


@dataclass(frozen=True, slots=True)
class CorrectionSummary:
    """Summary of a session's corrections: when it was tracked again, which markers were corrected, and by whom.

    ``first_corrected_s`` is the time of the first corrected frame since the start.
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
