"""From the clicks on a picture to a calibration, and to the start of tracking."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from carpus.core.calibration.calibrate import CalibrationOutcome, calibrate, compared_with_last_time
from carpus.core.calibration.candidates import disc_at, marker_candidates, snapped
from carpus.core.calibration.naming import propose_names
from carpus.core.calibration.result import ALL_STRAIGHT, Calibration, Clicks
from carpus.core.camera import Camera
from carpus.core.detection.appearance import expected_radius_px
from carpus.core.hand.protocols import MarkerProtocol
from carpus.core.pipeline.track import TrackSettings
from carpus.core.types import Detections, FloatArray, Frame, Side
from carpus.ui.ports import FoundMarker, Judged, ProposedMarker, VerdictLimits

SAME_DISC_PX = 3.0
"""Nearer than this two places are the same disc."""

Begin = Callable[[CalibrationOutcome, Sequence[Frame]], None]
"""Called with the chosen outcome and the pictures it was made from, the clicked one first."""


@dataclass(frozen=True, slots=True)
class Pictures:
    """Where the calibration's pictures come from; ``still``: the picture to click on, then its neighbours in time."""

    is_live: bool
    newest: Callable[[], Frame | None]
    still: Callable[[], Sequence[Frame]]


class HandCalibrator:
    """One calibration, from the held picture to the start of tracking.

    ``last_length_mm`` of the same hand in an earlier session, NaN for none.
    """

    def __init__(
        self,
        pictures: Pictures,
        camera: Camera,
        side: Side,
        protocol: MarkerProtocol,
        settings: TrackSettings,
        begin: Begin,
        last_length_mm: float = float("nan"),
        last_straight_fingers: tuple[bool, ...] = ALL_STRAIGHT,
    ) -> None:
        self._last_straight_fingers = last_straight_fingers
        self._pictures, self._camera, self._settings, self._begin = pictures, camera, settings, begin
        self._side, self._protocol, self._last_length_mm = side, protocol, last_length_mm
        self._held: Sequence[Frame] = ()
        self._candidates = Detections.none()
        self._outcomes: list[tuple[CalibrationOutcome, Sequence[Frame]]] = []

    @property
    def side(self) -> Side:
        return self._side

    @property
    def protocol(self) -> MarkerProtocol:
        return self._protocol

    @property
    def limits(self) -> VerdictLimits:
        limits = self._settings.calibration
        return VerdictLimits(
            limits.least_distance_m, limits.most_tilt_deg, limits.most_residual_mm, limits.hand_length_mm
        )

    @property
    def last_straight_fingers(self) -> tuple[bool, ...]:
        """What was said of this hand last time, thumb to little."""
        return self._last_straight_fingers

    @property
    def is_live(self) -> bool:
        return self._pictures.is_live

    def newest_frame(self) -> Frame | None:
        return self._pictures.newest()

    def hold(self) -> Frame:
        """Fix the picture, and find all blue discs on it, so that clicks snap at once."""
        self._held = tuple(self._pictures.still())
        settings = self._settings
        self._candidates = marker_candidates(self._held[0], self._camera, settings.detection)
        return self._held[0]

    def discs_seen(self) -> int:
        """How many spots of the held picture look like discs of paper."""
        return len(self._candidates)

    def discs_px(self) -> FloatArray:
        return self._candidates.pixel

    def hand_area(self) -> FloatArray | None:
        """Box of the blue discs: corners (2, 2); None when hardly any is seen."""
        if len(self._candidates) < len(self._protocol.palm):
            return None
        return np.stack((self._candidates.pixel.min(axis=0), self._candidates.pixel.max(axis=0)))

    def marker_at(self, pixel: FloatArray) -> FoundMarker | None:
        if not self._held:
            return None
        frame, detection = self._held[0], self._settings.detection
        radius_px = expected_radius_px(frame, pixel, self._camera, detection)
        found = snapped(self._candidates, pixel, radius_px, detection)
        if not len(found):
            found = disc_at(frame, pixel, self._camera, detection)
        if not len(found):
            return None
        return FoundMarker(found.pixel[0], _width_px(found, 0))

    def propose(self, named: Mapping[str, FloatArray]) -> Mapping[str, ProposedMarker]:
        """Names for the discs found when the picture was held."""
        blobs, markers = self._candidates, self._protocol.markers
        known: dict[int, int] = {}
        for name, pixel in named.items():
            distance = np.linalg.norm(blobs.pixel - pixel, axis=1)
            if distance.size and distance.min() < SAME_DISC_PX:
                known[markers.index(name)] = int(distance.argmin())
        found = propose_names(blobs, self._camera, self._side, self._protocol, known)
        return {
            name: ProposedMarker(blobs.pixel[blob], _width_px(blobs, blob), bool(is_sure))
            for name, blob, is_sure in zip(markers, found.blob.tolist(), found.is_sure, strict=True)
            if blob >= 0 and name not in named
        }

    def judge(self, clicks: Clicks, start_angles_rad: FloatArray) -> Judged:
        """Measure and judge; called in the background."""
        held, settings = self._held, self._settings
        outcome = calibrate(clicks, held, self._camera, settings.calibration, settings.detection, start_angles_rad)
        outcome = compared_with_last_time(outcome, self._last_length_mm)
        self._outcomes.append((outcome, held))
        return Judged(outcome.verdict, outcome.calibration)

    def begin(self, calibration: Calibration) -> None:
        """Start tracking from one of the calibrations judged here."""
        outcome, held = next(pair for pair in reversed(self._outcomes) if pair[0].calibration is calibration)
        self._begin(outcome, held)


def _width_px(blobs: Detections, number: int) -> float:
    """Width of a round disc of a blob's area."""
    return 2.0 * float(np.sqrt(blobs.area_px[number] / np.pi))
