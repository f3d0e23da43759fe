"""Labels that a person gave to blobs, applied before association.

A blob that is no marker is left out before blobs are associated; one that is a marker is associated as labelled. A blob
is followed from frame to frame, so that its label goes on holding while it moves, and for a while after it went out of
sight.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from carpus.core.model.types import BoolArray, Detections, FloatArray, MarkerLabel

MAX_STEP_PX = 8.0  # no further a blob is followed from frame to frame
RETURN_GATE_PX = 12.0  # so near to where it was, in the image or beside its marker, a blob that comes back is the same
MAX_HIDDEN_S = 0.5  # out of sight for so long, what comes out there later may be a marker
KEPT_FRAMES = 60  # in which a labelled blob is searched
LABEL_TIMEOUT_S = 0.5  # so long a label waits for a frame that shows its blob
SAME_POSITION_PX = 0.5  # a blob so near to the one that was followed is that blob


class RecentBlobs:
    """The blobs of the last frames, in which one labelled a moment ago is followed to the newest."""

    def __init__(self, step_px: float = MAX_STEP_PX) -> None:
        self._step_px = step_px
        self._frames: deque[tuple[int, FloatArray]] = deque(maxlen=KEPT_FRAMES)

    def add_frame(self, index: int, pixel: FloatArray) -> None:
        """Remember the blobs (D, 2) of a frame."""
        self._frames.append((index, pixel))

    def locate(self, frame_index: int, pixel: FloatArray) -> FloatArray | None:
        """Return the newest position (2,) of the blob at ``pixel`` in an older frame; None when lost."""
        place = np.asarray(pixel, dtype=np.float64)
        for index, blobs in self._frames:
            if index < frame_index or not len(blobs):
                continue
            distance = np.linalg.norm(blobs - place, axis=1)
            if distance.min() <= self._step_px:
                place = blobs[int(distance.argmin())]
        if not self._frames or not len(self._frames[-1][1]):
            return None
        return place if np.linalg.norm(self._frames[-1][1] - place, axis=1).min() < 1e-6 else None


class RejectedBlob:
    """A blob that a person said at ``time_s`` is not a marker, row ``marker`` of the protocol."""

    def __init__(self, marker: int, pixel: FloatArray, offset_px: FloatArray, time_s: float) -> None:
        self.marker = marker
        self._pixel, self._offset_px = pixel, offset_px
        self._seen_s = time_s
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


@dataclass(frozen=True, slots=True)
class LabelledBlob:
    """A label whose blob is seen: ``blob`` of the frame is the protocol's ``marker``."""

    label: MarkerLabel
    marker: int
    blob: int


@dataclass(frozen=True, slots=True)
class _PendingLabel:
    """A label whose blobs were searched in vain ``since_s``, NaN for not yet."""

    label: MarkerLabel
    since_s: float = math.nan


@dataclass(frozen=True, slots=True)
class LabelledDetections:
    """The blobs of a frame that may be markers, and the one that a person has just labelled.

    ``is_rejected`` (D,) tells which of all blobs were left out.
    """

    detections: Detections
    is_rejected: BoolArray
    labelled: LabelledBlob | None


class OperatorLabels:
    """Remembers a person's labels, and finds the blobs again in every frame."""

    def __init__(self, markers: Sequence[str]) -> None:
        self._markers = markers
        self._recent = RecentBlobs()
        self._pending: list[_PendingLabel] = []
        self._rejected: list[RejectedBlob] = []
        self._is_measured = np.zeros(len(markers), dtype=bool)

    def add(self, label: MarkerLabel) -> None:
        """Add a label of this or an earlier frame, from the next frame on."""
        self._pending.append(_PendingLabel(label))

    def follow(self, measured_px: FloatArray) -> None:
        """Take the markers measured in a frame, (M, 2) NaN where not: they keep the blobs nearer to them."""
        self._is_measured = np.isfinite(measured_px[:, 0])

    def apply_labels(
        self, index: int, timestamp_s: float, detections: Detections, predict_px: Callable[[], FloatArray]
    ) -> LabelledDetections:
        """Apply the labels to the blobs of a frame.

        ``predict_px`` gives where the markers should be (M, 2), NaN while the hand is lost.
        """
        self._recent.add_frame(index, detections.pixel)
        label = self._apply_pending(index, timestamp_s, predict_px)
        is_rejected = np.zeros(len(detections), dtype=bool)
        self._rejected = [one for one in self._rejected if one.is_valid(timestamp_s)]
        for one in self._rejected:
            blob = one.find(timestamp_s, detections.pixel, predict_px(), self._is_measured)
            if blob >= 0:
                is_rejected[blob] = True
        rest = detections.subset(~is_rejected) if self._rejected else detections
        labelled = None
        if label is not None and label.pixel is not None and len(rest):
            distance_px = np.linalg.norm(rest.pixel - label.pixel, axis=1)
            blob = int(distance_px.argmin())
            if distance_px[blob] <= SAME_POSITION_PX:
                labelled = LabelledBlob(label, self._markers.index(label.marker), blob)
        return LabelledDetections(rest, is_rejected, labelled)

    def _apply_pending(
        self, index: int, timestamp_s: float, predict_px: Callable[[], FloatArray]
    ) -> MarkerLabel | None:
        """Apply the rejections of every label whose blobs are seen; return the first that names a marker.

        A frame is associated with one new label; the next one has its turn in the next frame.
        """
        pending, self._pending = self._pending, []
        first: MarkerLabel | None = None
        for one in pending:
            label = self._locate_label(one.label)
            if label is None:
                since_s = timestamp_s if math.isnan(one.since_s) else one.since_s
                if timestamp_s - since_s < LABEL_TIMEOUT_S and one.label.marker in self._markers:
                    self._pending.append(replace(one, since_s=since_s))
                continue
            label = replace(label, frame_index=index)
            if label.pixel is not None and first is not None:
                self._pending.append(replace(one, label=replace(label, rejected_px=()), since_s=math.nan))
                label = replace(label, pixel=None)
            elif label.pixel is not None:
                first = label
            if not label.rejected_px and label.pixel is None:
                continue
            marker = self._markers.index(label.marker)
            for place in label.rejected_px:
                pixel = np.array(place)
                offset_px = pixel - predict_px()[marker]
                self._rejected.append(RejectedBlob(marker, pixel, offset_px, timestamp_s))
            self._is_measured[marker] = False
        return first

    def _locate_label(self, label: MarkerLabel) -> MarkerLabel | None:
        """Return the label with its blobs where they lie in the newest frame; None while its marker is not seen."""
        if label.marker not in self._markers:
            return None

        def locate(place: tuple[float, float]) -> tuple[float, float] | None:
            found = self._recent.locate(label.frame_index, np.array(place))
            return None if found is None else (float(found[0]), float(found[1]))

        pixel = None if label.pixel is None else locate(label.pixel)
        rejected = tuple(spot for one in label.rejected_px if (spot := locate(one)) is not None)
        if pixel is None and (label.pixel is not None or not rejected):
            return None
        return replace(label, pixel=pixel, rejected_px=rejected)
