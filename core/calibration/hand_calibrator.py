"""From the clicks on a frame to a calibration and the start of tracking."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from carpus.core.calibration.calibrate import (
    CalibrationOutcome,
    CalibrationSettings,
    MeasuredHand,
    calibrate_hand,
    check_hand_length,
)
from carpus.core.calibration.candidates import find_marker_at_click, find_marker_candidates, find_nearest_blob
from carpus.core.calibration.label_proposal import propose_labels
from carpus.core.calibration.result import ALL_STRAIGHT, Calibration, Clicks
from carpus.core.detection.appearance import DetectionSettings, estimate_radius_px
from carpus.core.model.camera import Camera
from carpus.core.model.hand.protocols import MarkerProtocol
from carpus.core.model.types import Detections, FloatArray, Frame, Side

SAME_MARKER_PX = 3.0
"""Pixels closer than this are on the same marker."""

BeginTracking = Callable[[CalibrationOutcome, Sequence[Frame]], None]
"""Called with the chosen outcome and its frames, the clicked one first."""


@dataclass(frozen=True, slots=True)
class CalibrationFrames:
    """Source of the frames; ``still_frames`` returns the frame to click on, then its neighbours in time."""

    is_live: bool
    current_frame: Callable[[], Frame | None]
    still_frames: Callable[[], Sequence[Frame]]


@dataclass(frozen=True, slots=True)
class FoundMarker:
    """A blob for a marker: centre (2,) and width in pixels; not ``is_sure`` if another label fits nearly as well."""

    pixel: FloatArray
    width_px: float
    is_sure: bool = True


class HandCalibrator:
    """One calibration, from the frozen frame to the start of tracking.

    ``previous_straight_fingers`` are the fingers, thumb to little, that could fully extend last time;
    ``last_length_mm`` is the hand length of an earlier session, NaN for none.
    """

    def __init__(
        self,
        frames: CalibrationFrames,
        camera: Camera,
        side: Side,
        protocol: MarkerProtocol,
        detection: DetectionSettings,
        settings: CalibrationSettings,
        begin_tracking: BeginTracking,
        last_length_mm: float = float("nan"),
        previous_straight_fingers: tuple[bool, ...] = ALL_STRAIGHT,
    ) -> None:
        self.current_frame, self._still_frames = frames.current_frame, frames.still_frames
        self.is_live, self.side, self.protocol = frames.is_live, side, protocol
        self.previous_straight_fingers = previous_straight_fingers
        self._camera, self._detection, self._settings = camera, detection, settings
        self._begin_tracking, self._last_length_mm = begin_tracking, last_length_mm
        self._held_frames: Sequence[Frame] = ()
        self._candidates = Detections.none()
        self._outcomes: list[tuple[CalibrationOutcome, Sequence[Frame]]] = []

    def freeze_frame(self) -> Frame:
        """Freeze a frame and find its marker candidates, so that clicks snap at once."""
        self._held_frames = tuple(self._still_frames())
        self._candidates = find_marker_candidates(self._held_frames[0], self._camera, self._detection)
        return self._held_frames[0]

    def candidate_px(self) -> FloatArray:
        """Return the pixels (D, 2) of all marker candidates in the held frame."""
        return self._candidates.pixel

    def hand_area(self) -> FloatArray | None:
        """Return the corners (2, 2) of the box of all candidates; None if there are too few."""
        if len(self._candidates) < len(self.protocol.palm):
            return None
        return np.stack((self._candidates.pixel.min(axis=0), self._candidates.pixel.max(axis=0)))

    def find_marker(self, pixel: FloatArray) -> FoundMarker | None:
        """Return the blob at or near a pixel (2,) of the held frame."""
        if not self._held_frames:
            return None
        frame, detection = self._held_frames[0], self._detection
        radius_px = float(estimate_radius_px(frame, pixel[None], self._camera, detection)[0])
        found = find_nearest_blob(self._candidates, pixel, radius_px, detection)
        if not len(found):
            found = find_marker_at_click(frame, pixel, self._camera, detection)
        if not len(found):
            return None
        return FoundMarker(found.pixel[0], _width_px(found, 0))

    def propose_labels(self, named: Mapping[str, FloatArray]) -> Mapping[str, FoundMarker]:
        """Propose labels for the held frame's blobs other than those already ``named``; runs in the background."""
        blobs, markers = self._candidates, self.protocol.markers
        known: dict[int, int] = {}
        for name, pixel in named.items():
            distance = np.linalg.norm(blobs.pixel - pixel, axis=1)
            if distance.size and distance.min() < SAME_MARKER_PX:
                known[markers.index(name)] = int(distance.argmin())
        found = propose_labels(blobs, self._camera, self.side, self.protocol, known)
        return {
            name: FoundMarker(blobs.pixel[blob], _width_px(blobs, blob), bool(is_sure))
            for name, blob, is_sure in zip(markers, found.blob.tolist(), found.is_sure, strict=True)
            if blob >= 0 and name not in named
        }

    def assess(self, clicks: Clicks, start_angles_rad: FloatArray) -> MeasuredHand:
        """Calibrate and assess the result; runs in the background."""
        held = self._held_frames
        outcome = calibrate_hand(clicks, held, self._camera, self._settings, self._detection, start_angles_rad)
        outcome = check_hand_length(outcome, self._last_length_mm)
        self._outcomes.append((outcome, held))
        return outcome

    def start_tracking(self, calibration: Calibration) -> None:
        """Start tracking with one of the calibrations assessed before."""
        outcome, held = next(pair for pair in reversed(self._outcomes) if pair[0].calibration is calibration)
        self._begin_tracking(outcome, held)


def _width_px(blobs: Detections, number: int) -> float:
    """Return the diameter of a disc with the blob's area."""
    return 2.0 * float(np.sqrt(blobs.area_px[number] / np.pi))
