"""Recordings as measurements with true names: simulated as such, or found by the detector on rendered pictures."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from carpus.core.session.reader import read_detections
from carpus.core.simulation.truth import Truth
from carpus.core.types import Detections, FloatArray
from tests.simulation.measurements import MeasurementSequence

OWN_PX = 6.0
"""A blob's middle further than this from a disc's is not that disc's, even half covered."""
LEAST_SEEN = 0.1
LEAST_DISCS = 3
ENOUGH_DISCS = 4
"""So many discs of the palm are enough to find it anew."""


def true_names(labels: NDArray[np.int64], markers: int) -> NDArray[np.int64]:
    """Blob of every marker (M,) from the marker of every blob (D,); -1 for none."""
    taken = np.full(markers, -1, dtype=np.int64)
    real = np.flatnonzero(labels >= 0)
    taken[labels[real]] = real
    return taken


def markers_of(blobs: Detections, disc_px: FloatArray, visible_share: FloatArray) -> NDArray[np.int64]:
    """Marker of every blob (D,), -1 for none: the disc (M, 2) whose middle is nearest, each disc's nearest blob."""
    gap = np.linalg.norm(blobs.pixel[:, None] - disc_px[None], axis=-1)
    gap = np.where((gap < OWN_PX) & (visible_share > LEAST_SEEN), gap, np.inf)
    labels = np.full(len(blobs), -1, dtype=np.int64)
    for marker in range(disc_px.shape[0]):
        if len(blobs) and np.isfinite(gap[:, marker].min()):
            blob = int(gap[:, marker].argmin())
            if gap[blob].argmin() == marker:
                labels[blob] = marker
    return labels


def detected_sequence(truth: Truth, session: Path) -> MeasurementSequence:
    """The blobs that a session of a simulated recording holds, named by the truth."""
    table = read_detections(session)
    blobs = tuple(table.of_frame(i) for i in range(len(truth.timestamp_s)))
    labels = tuple(markers_of(b, truth.disc_pixel[i], truth.visible_share[i]) for i, b in enumerate(blobs))
    return MeasurementSequence(truth, blobs, labels)


def scored_frames(truth: Truth, begin_s: float) -> NDArray[np.bool_]:
    """Frames (N,) after ``begin_s`` with three discs of the palm inside the picture: without, nothing can be known."""
    camera = truth.camera
    palm = truth.disc_pixel[:, list(truth.spec.marker_protocol.palm)]
    inside = ((palm >= 0.0) & (palm <= [camera.width_px - 1, camera.height_px - 1])).all(axis=-1)
    return np.asarray((truth.timestamp_s > begin_s) & (inside.sum(axis=1) >= LEAST_DISCS))


def longest_untracked_s(sequence: MeasurementSequence, tracked: NDArray[np.bool_]) -> float:
    """Longest time on end that the hand was not tracked (N,) though the blobs of four discs of its palm were there."""
    palm = np.array(sequence.truth.spec.marker_protocol.palm)
    could = np.array([np.isin(palm, names).sum() >= ENOUGH_DISCS for names in sequence.marker])
    longest, since = 0.0, None
    for now_s, missed in zip(sequence.truth.timestamp_s, could & ~tracked, strict=True):
        if since is not None:
            longest = max(longest, float(now_s - since))
        since = (now_s if since is None else since) if missed else None
    return longest


def without_false(sequence: MeasurementSequence) -> MeasurementSequence:
    """The blobs of true markers only."""
    kept = [np.flatnonzero(labels >= 0) for labels in sequence.marker]
    blobs = tuple(
        Detections(b.pixel[rows], b.depth_m[rows], b.depth_sd_m[rows], b.area_px[rows], b.similarity[rows])
        for b, rows in zip(sequence.detections, kept, strict=True)
    )
    names = tuple(labels[rows] for labels, rows in zip(sequence.marker, kept, strict=True))
    return MeasurementSequence(sequence.truth, blobs, names)


def measured_and_errors(sequence: MeasurementSequence) -> tuple[FloatArray, FloatArray]:
    """Measured pixels and depths (N, M, 3) by true name, NaN where not seen, and their errors."""
    truth = sequence.truth
    true = np.concatenate((truth.disc_pixel, truth.disc_position_cam_m[..., 2:]), axis=-1)
    measured = np.full(true.shape, np.nan)
    for i, (blobs, labels) in enumerate(zip(sequence.detections, sequence.marker, strict=True)):
        names = true_names(labels, true.shape[1])
        seen = np.flatnonzero(names >= 0)
        measured[i, seen, :2] = blobs.pixel[names[seen]]
        measured[i, seen, 2] = blobs.depth_m[names[seen]]
    return measured, measured - true


def wrongly_taken(measured_px: FloatArray, sequence: MeasurementSequence) -> NDArray[np.bool_]:
    """Whether the blob taken for a marker, by its pixel (N, M, 2), NaN for none, is another thing's."""
    wrong = np.zeros(measured_px.shape[:2], dtype=bool)
    for i, marker in np.argwhere(np.isfinite(measured_px[..., 0])):
        gap = np.abs(sequence.detections[i].pixel - measured_px[i, marker]).sum(axis=1)
        wrong[i, marker] = sequence.marker[i][int(gap.argmin())] != marker
    return wrong
