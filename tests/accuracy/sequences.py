"""Recordings as measurements with true names: simulated as such, or found by the detector on rendered pictures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from carpus.core.model.camera import Camera
from carpus.core.model.types import Detections, FloatArray
from carpus.core.simulation.truth import Truth
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


def label_blobs(blobs: Detections, disc_px: FloatArray, visible_share: FloatArray) -> NDArray[np.int64]:
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


def enough_inside(palm_px: FloatArray, camera: Camera) -> NDArray[np.bool_]:
    """Frames (N,) with three discs of the palm (N, 6, 2) inside the picture: without, nothing can be known."""
    inside = ((palm_px >= 0.0) & (palm_px <= [camera.width_px - 1, camera.height_px - 1])).all(axis=-1)
    return np.asarray(inside.sum(axis=1) >= LEAST_DISCS)


def select_scored_frames(truth: Truth, begin_s: float) -> NDArray[np.bool_]:
    """Frames (N,) after ``begin_s`` in which something can be known."""
    palm_px = truth.marker_px[:, list(truth.spec.marker_protocol.palm)]
    return np.asarray((truth.timestamp_s > begin_s) & enough_inside(palm_px, truth.camera))


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


def split_measurements(sequence: MeasurementSequence) -> tuple[FloatArray, FloatArray]:
    """Measured pixels and depths (N, M, 3) by true name, NaN where not seen, and their errors."""
    truth = sequence.truth
    true = np.concatenate((truth.marker_px, truth.marker_position_cam_m[..., 2:]), axis=-1)
    measured = np.full(true.shape, np.nan)
    for i, (blobs, labels) in enumerate(zip(sequence.detections, sequence.marker, strict=True)):
        names = true_names(labels, true.shape[1])
        seen = np.flatnonzero(names >= 0)
        measured[i, seen, :2] = blobs.pixel[names[seen]]
        measured[i, seen, 2] = blobs.depth_m[names[seen]]
    return measured, measured - true


@dataclass(frozen=True, slots=True)
class NamesTaken:
    """Of F frames and M markers (F, M): there to be seen, measured, measured by another thing's blob."""

    present: NDArray[np.bool_]
    taken: NDArray[np.bool_]
    wrong: NDArray[np.bool_]

    @property
    def missed(self) -> int:
        """Discs that were there and not taken."""
        return int((self.present & ~self.taken).sum())

    @property
    def shown(self) -> int:
        return int(self.present.sum())


def names_taken(
    measured_px: FloatArray, blobs: Sequence[Detections], labels: Sequence[NDArray[np.int64]], frames: NDArray[np.bool_]
) -> NamesTaken:
    """What was taken in the scored ``frames`` (N,), by the pixels (N, M, 2) of the measurements, NaN for none, and the
    true markers of every frame's blobs."""
    rows = np.flatnonzero(frames)
    taken = np.isfinite(measured_px[rows, :, 0])
    present = np.array([np.isin(np.arange(taken.shape[1]), labels[i]) for i in rows])
    wrong = np.zeros(taken.shape, dtype=bool)
    for k, marker in np.argwhere(taken):
        i = rows[k]
        wrong[k, marker] = (
            labels[i][int(np.abs(blobs[i].pixel - measured_px[i, marker]).sum(axis=1).argmin())] != marker
        )
    return NamesTaken(present, taken, wrong)
