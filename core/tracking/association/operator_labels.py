"""Labels that a person gave to blobs, applied before association.

A blob that is no marker is left out before blobs are associated; one that is a marker is associated as labelled. A blob
is followed from frame to frame, so that its label goes on holding while it moves, and for a while after it went out of
sight.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from carpus.core.model.types import BoolArray, Detections, FloatArray

MAX_STEP_PX = 8.0  # no further a blob is followed from frame to frame
RETURN_GATE_PX = 12.0  # so near to where it was, in the image or beside its marker, a blob that comes back is the same
MAX_HIDDEN_S = 0.5  # out of sight for so long, what comes out there later may be a marker
LABEL_TIMEOUT_S = 0.5  # so long a label waits for a frame that shows its blob
SAME_POSITION_PX = 0.5  # a blob so near to the one that was followed is that blob


def follow_blob(place_px: FloatArray, blobs_px: FloatArray) -> tuple[FloatArray, bool]:
    """Return where the blob of the frame before (2,) is among a frame's (D, 2), and whether it is seen."""
    if len(blobs_px):
        distance = np.linalg.norm(blobs_px - place_px, axis=1)
        if distance.min() <= MAX_STEP_PX:
            return blobs_px[int(distance.argmin())], True
    return place_px, False


class RejectedBlob:
    """A blob that a person said is not a marker, row ``marker`` of the protocol."""

    def __init__(self, marker: int, pixel: FloatArray) -> None:
        self.marker = marker
        self._pixel, self._offset_px = pixel, np.full(2, np.nan)  # the offset is known once the blob is found
        self._seen_s = math.inf  # until its first frame
        self._was_seen = True

    def is_valid(self, time_s: float) -> bool:
        """Return whether the rejection still holds."""
        return time_s - self._seen_s <= MAX_HIDDEN_S

    def find(self, time_s: float, pixel: FloatArray, predicted_px: FloatArray, is_measured: BoolArray) -> int:
        """Return which of the blobs it is, -1 for none.

        Parameters
        ----------
        time_s : float
            Time of the frame.
        pixel : (D, 2)
            The frame's blobs.
        predicted_px : (M, 2)
            Where the markers are predicted.
        is_measured : (M,)
            Markers measured a moment ago: they keep the blobs that are nearer to them.
        """
        if self._was_seen:
            self._seen_s = time_s
        if not len(pixel):
            self._was_seen = False
            return -1
        marker_px = predicted_px[self.marker]
        guesses = [self._pixel] if self._was_seen else [self._pixel, marker_px + self._offset_px]
        gate_px = MAX_STEP_PX if self._was_seen else RETURN_GATE_PX
        distance = np.min([np.linalg.norm(pixel - one, axis=1) for one in guesses if np.isfinite(one).all()], axis=0)
        others = predicted_px[is_measured & np.isfinite(predicted_px).all(axis=1)]
        if len(others):
            nearest = np.linalg.norm(pixel[:, None] - others[None], axis=-1).min(axis=1)
            distance = np.where(nearest < distance, math.inf, distance)
        best = int(distance.argmin())
        self._was_seen = bool(distance[best] <= gate_px)
        if not self._was_seen:
            return -1
        self._pixel = pixel[best]
        if np.isfinite(marker_px).all():
            self._offset_px = self._pixel - marker_px
        return best


@dataclass(slots=True)
class _WaitingLabel:
    """A marker whose blob has had no turn yet: where that was last, and since when it is hidden, NaN for not."""

    marker: int
    pixel: FloatArray
    hidden_since_s: float = math.nan


@dataclass(frozen=True, slots=True)
class LabelledDetections:
    """The blobs of a frame that may be markers, and the marker of which a person has just labelled the blob.

    ``is_rejected`` (D,) tells which of all blobs were left out.
    """

    detections: Detections
    is_rejected: BoolArray
    marker: int | None


class OperatorLabels:
    """Remembers a person's labels of ``count`` markers, and finds the blobs again in every frame."""

    def __init__(self, count: int) -> None:
        self._waiting: list[_WaitingLabel] = []
        self._rejected: list[RejectedBlob] = []
        self._is_measured = np.zeros(count, dtype=bool)

    def add(self, marker: int, pixel: FloatArray) -> None:
        """Add that the blob at a pixel (2,) of the next frame is this marker."""
        self._waiting.append(_WaitingLabel(marker, pixel))

    def reject(self, marker: int, pixel: FloatArray) -> None:
        """Add that the blob at a pixel (2,) of the next frame is not this marker, and none."""
        self._rejected.append(RejectedBlob(marker, pixel))
        self._is_measured[marker] = False

    def follow(self, measured_px: FloatArray) -> None:
        """Take the markers measured in a frame, (M, 2) NaN where not: they keep the blobs nearer to them."""
        self._is_measured = np.isfinite(measured_px[:, 0])

    def apply_labels(
        self, timestamp_s: float, detections: Detections, predict_px: Callable[[], FloatArray]
    ) -> LabelledDetections:
        """Apply the labels to the blobs of a frame.

        ``predict_px`` gives where the markers should be (M, 2), NaN while the hand is lost.
        """
        label = self._pop_label(timestamp_s, detections.pixel)
        is_rejected = np.zeros(len(detections), dtype=bool)
        self._rejected = [one for one in self._rejected if one.is_valid(timestamp_s)]
        for one in self._rejected:
            blob = one.find(timestamp_s, detections.pixel, predict_px(), self._is_measured)
            if blob >= 0:
                is_rejected[blob] = True
        rest = detections.subset(~is_rejected) if self._rejected else detections
        is_left = (
            label is not None
            and len(rest) > 0
            and np.linalg.norm(rest.pixel - label.pixel, axis=1).min() <= SAME_POSITION_PX
        )
        return LabelledDetections(rest, is_rejected, label.marker if label is not None and is_left else None)

    def _pop_label(self, timestamp_s: float, blobs_px: FloatArray) -> _WaitingLabel | None:
        """Follow the blobs of the labels; return the first that is seen: a frame is associated with one new label."""
        waiting, self._waiting = self._waiting, []
        first = None
        for one in waiting:
            one.pixel, is_seen = follow_blob(one.pixel, blobs_px)
            if is_seen and first is None:
                first = one
                self._is_measured[one.marker] = False
                continue
            if is_seen:
                one.hidden_since_s = math.nan
            elif math.isnan(one.hidden_since_s):
                one.hidden_since_s = timestamp_s
            if is_seen or timestamp_s - one.hidden_since_s < LABEL_TIMEOUT_S:
                self._waiting.append(one)
        return first
