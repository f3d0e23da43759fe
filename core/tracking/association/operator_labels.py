"""Operator hints, a layer over association: what a person said of blue spots while measuring.

A spot that is no disc is left out before blobs are associated; one that is a marker is associated as said. A spot is
followed from picture to picture, so that what was said of it goes on holding while it moves, and for a while after it
went out of sight.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from carpus.core.model.types import BoolArray, Detections, FloatArray, MarkerLabel

MAX_STEP_PX = 8.0
"""No further a spot is followed from picture to picture."""
RETURN_GATE_PX = 12.0
"""So near to where it was, in the picture or beside its marker, a spot that comes back is the same."""
REJECTION_VALID_S = 60.0
"""After that a spot that is no disc is asked about again, if there is still something to ask."""
MAX_HIDDEN_S = 0.5
"""Where nobody will ask: out of sight for so long, what comes out there later may be a disc."""
KEPT_FRAMES = 60
"""In which a spot that was spoken of is looked for."""
LABEL_TIMEOUT_S = 0.5
"""So long an answer waits for a picture that shows its spot."""
SAME_POSITION_PX = 0.5
"""A blob so near to the spot that was followed is that spot."""


class RecentBlobs:
    """The spots of the last pictures: what was said of one, a moment ago, is found in the newest."""

    def __init__(self, step_px: float = MAX_STEP_PX) -> None:
        self._step_px = step_px
        self._frames: deque[tuple[int, FloatArray]] = deque(maxlen=KEPT_FRAMES)

    def add_frame(self, index: int, pixel: FloatArray) -> None:
        """Remember the spots (D, 2) of a picture."""
        self._frames.append((index, pixel))

    def locate(self, frame_index: int, pixel: FloatArray) -> FloatArray | None:
        """Where the spot that lay at ``pixel`` (2,) in picture ``frame_index`` lies in the newest; None when lost."""
        place = np.asarray(pixel, dtype=np.float64)
        for number, pixel in self._frames:
            if number < frame_index or not len(pixel):
                continue
            away = np.linalg.norm(pixel - place, axis=1)
            if away.min() <= self._step_px:
                place = pixel[int(away.argmin())]
        return place if len(self._frames) and len(self._frames[-1][1]) and self._is_seen(place) else None

    def _is_seen(self, place: FloatArray) -> bool:
        return bool(np.linalg.norm(self._frames[-1][1] - place, axis=1).min() < 1e-6)


class RejectedBlob:
    """A spot that a person said at ``time_s`` is not a marker, row ``marker`` of the protocol."""

    def __init__(
        self,
        marker: int,
        place_px: FloatArray,
        beside_px: FloatArray,
        time_s: float,
        *,
        is_asked_again: bool,
    ) -> None:
        self.marker = marker
        self._pixel, self._offset_px, self._is_asked_again = place_px, beside_px, is_asked_again
        self._labelled_s = self._seen_s = time_s
        self._was_seen = True

    def is_valid(self, time_s: float) -> bool:
        """Whether what was said of it still counts."""
        if self._is_asked_again:
            return time_s - self._labelled_s <= REJECTION_VALID_S
        return time_s - self._seen_s <= MAX_HIDDEN_S

    def find(self, time_s: float, pixel: FloatArray, predicted_px: FloatArray, is_measured: BoolArray) -> int:
        """Which of the spots (D, 2) it is, -1 for none. ``expected_px`` (M, 2) where the markers should be; those
        ``is_measured`` (M,) a moment ago keep the spots that are nearer to them."""
        if self._was_seen:
            self._seen_s = time_s
        if not len(pixel):
            self._was_seen = False
            return -1
        marker_px = predicted_px[self.marker]
        guesses = [self._pixel] if self._was_seen else [self._pixel, marker_px + self._offset_px]
        reach_px = MAX_STEP_PX if self._was_seen else RETURN_GATE_PX
        away = np.min([np.linalg.norm(pixel - guess, axis=1) for guess in guesses if np.isfinite(guess).all()], axis=0)
        claims = predicted_px[is_measured & np.isfinite(predicted_px).all(axis=1)]
        if len(claims):
            claimed = np.linalg.norm(pixel[:, None] - claims[None], axis=-1).min(axis=1)
            away = np.where(claimed < away, math.inf, away)
        best = int(away.argmin())
        self._was_seen = bool(away[best] <= reach_px)
        if not self._was_seen:
            return -1
        self._pixel = pixel[best]
        if np.isfinite(marker_px).all():
            self._offset_px = self._pixel - marker_px
        return best


@dataclass(frozen=True, slots=True)
class LabelledBlob:
    """An answer of which the spot is seen: ``blob`` of the picture is the protocol's ``marker``."""

    label: MarkerLabel
    marker: int
    blob: int


@dataclass(frozen=True, slots=True)
class _PendingLabel:
    """An answer whose spots were looked for in vain ``since_s``, NaN for not yet."""

    label: MarkerLabel
    is_asked_again: bool
    since_s: float = math.nan


@dataclass(frozen=True, slots=True)
class LabelledDetections:
    """The blobs of a picture that may be discs, which ``is_rejected`` (D,) of all were left out, and the one that a
    person
    has just named."""

    detections: Detections
    is_rejected: BoolArray
    labelled: LabelledBlob | None


class OperatorLabels:
    """Remembers what a person said, and finds the spots again in every picture."""

    def __init__(self, markers: Sequence[str]) -> None:
        self._markers = markers
        self._recent = RecentBlobs()
        self._pending: list[_PendingLabel] = []
        self._applied: list[MarkerLabel] = []
        self._rejected: list[RejectedBlob] = []
        self._is_measured = np.zeros(len(markers), dtype=bool)

    def add(self, label: MarkerLabel, *, is_asked_again: bool = True) -> None:
        """Something said of a picture shown a moment ago, from the next picture on; after a while the person is asked
        again, or never."""
        self._pending.append(_PendingLabel(label, is_asked_again))

    def pop_applied(self) -> list[MarkerLabel]:
        """The answers taken up since the last call, with the spots as they lay in the picture that took them."""
        out, self._applied = self._applied, []
        return out

    def mark_applied(self, labelled: LabelledBlob) -> None:
        """The spot was associated as said."""
        self._applied.append(labelled.label)

    def follow(self, measured_px: FloatArray) -> None:
        """Which markers a picture was measured by, (M, 2) NaN where not: they keep the spots nearer to them."""
        self._is_measured = np.isfinite(measured_px[:, 0])

    def apply_labels(
        self, index: int, timestamp_s: float, detections: Detections, predict_px: Callable[[], FloatArray]
    ) -> LabelledDetections:
        """A picture in the light of what was said; ``expected_px`` (M, 2) where its markers should be, NaN while the
        hand is lost."""
        self._recent.add_frame(index, detections.pixel)
        heard = self._apply_pending(index, timestamp_s, predict_px)
        no_disc = self._find_rejected(timestamp_s, detections.pixel, predict_px)
        left = detections.subset(~no_disc) if self._rejected else detections
        return LabelledDetections(left, no_disc, None if heard is None else self._find_labelled(heard, left.pixel))

    def _apply_pending(
        self, index: int, timestamp_s: float, expected_px: Callable[[], FloatArray]
    ) -> MarkerLabel | None:
        """Take up what is no disc of every answer whose spots are seen, and the first that names one: a picture is
        associated with one name that is new, and the next takes its turn in the next."""
        waiting, self._pending = self._pending, []
        named: MarkerLabel | None = None
        for one in waiting:
            now = self._locate_label(one.label)
            if now is None:
                since_s = timestamp_s if math.isnan(one.since_s) else one.since_s
                if timestamp_s - since_s < LABEL_TIMEOUT_S and one.label.marker in self._markers:
                    self._pending.append(replace(one, since_s=since_s))
                continue
            now = replace(now, frame_index=index)
            if now.pixel is not None and named is not None:
                self._pending.append(replace(one, label=replace(now, rejected_px=()), since_s=math.nan))
                now = replace(now, pixel=None)
            elif now.pixel is not None:
                named = now
            if now.rejected_px or now.pixel is not None:
                self._add_rejected(replace(one, label=now), timestamp_s, expected_px)
        return named

    def _locate_label(self, answer: MarkerLabel) -> MarkerLabel | None:
        """The answer with its spots where they lie in the newest picture; None while the spot it names is not seen."""
        if answer.marker not in self._markers:
            return None

        def locate(place: tuple[float, float]) -> tuple[float, float] | None:
            found = self._recent.locate(answer.frame_index, np.array(place))
            return None if found is None else (float(found[0]), float(found[1]))

        place = None if answer.pixel is None else locate(answer.pixel)
        others = tuple(spot for one in answer.rejected_px if (spot := locate(one)) is not None)
        if place is None and (answer.pixel is not None or not others):
            return None
        return replace(answer, pixel=place, rejected_px=others)

    def _add_rejected(self, said: _PendingLabel, time_s: float, expected_px: Callable[[], FloatArray]) -> None:
        answer = said.label
        marker = self._markers.index(answer.marker)
        for place in answer.rejected_px:
            place_px = np.array(place)
            beside_px = place_px - expected_px()[marker]
            self._rejected.append(RejectedBlob(marker, place_px, beside_px, time_s, is_asked_again=said.is_asked_again))
        self._is_measured[marker] = False
        if answer.pixel is None:
            self._applied.append(answer)

    def _find_rejected(self, timestamp_s: float, pixel: FloatArray, expected_px: Callable[[], FloatArray]) -> BoolArray:
        """Which spots (D, 2) a person said are none of the markers they were asked about."""
        out = np.zeros(len(pixel), dtype=bool)
        self._rejected = [one for one in self._rejected if one.is_valid(timestamp_s)]
        for one in self._rejected:
            found = one.find(timestamp_s, pixel, expected_px(), self._is_measured)
            if found >= 0:
                out[found] = True
        return out

    def _find_labelled(self, heard: MarkerLabel, pixel: FloatArray) -> LabelledBlob | None:
        """The blob (D, 2) that was shown, if it is one of those left."""
        if heard.pixel is None or not len(pixel):
            return None
        away_px = np.linalg.norm(pixel - heard.pixel, axis=1)
        blob = int(away_px.argmin())
        return (
            LabelledBlob(heard, self._markers.index(heard.marker), blob) if away_px[blob] <= SAME_POSITION_PX else None
        )
