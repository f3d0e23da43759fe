"""One frame's walk: picture -> blobs -> names -> belief -> angles."""

from __future__ import annotations

from core.detection.detector import Detector
from core.tracking.tracker import Tracker
from core.types import Frame, TrackedFrame


class FrameWalk:
    """Detector and tracker of one calibrated hand; call it with each frame in order."""

    def __init__(self, detector: Detector, tracker: Tracker) -> None:
        self.detector = detector
        self.tracker = tracker

    def __call__(self, frame: Frame) -> TrackedFrame:
        """Track one frame. Without a prediction the whole picture is searched."""
        expected = self.tracker.expect(frame.timestamp_s)
        region = None
        if expected is not None:
            region = self.detector.region_about(expected.pixel, expected.covariance_px2, expected.depth_m)
        blobs = self.detector.detect(frame, region)
        if region is not None and self.tracker.would_miss(blobs):
            blobs = self.detector.detect(frame, None)
        return self.tracker.step(frame.index, frame.timestamp_s, blobs, frame.dropped_before)
