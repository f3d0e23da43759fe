"""From picture to angles: picture -> blobs -> assigned to discs -> state estimate -> angles."""

from __future__ import annotations

from typing import Generic, TypeVar

from carpus.core.capture.files.raw import PackedFrame
from carpus.core.detection.detector import Detector
from carpus.core.detection.surface_samples import SamplingSettings, finger_samples, part_read, surface_samples
from carpus.core.papers.tracker import PaperTracker
from carpus.core.session.values import Event, Session
from carpus.core.tracking.tracker import Tracker
from carpus.core.types import SPOT_SAID, Frame, SpotAnswer, TrackedFrame

Seen = Frame | PackedFrame
"""A frame, or one whose pictures are unpacked where they are looked at."""
HandTracker = Tracker | PaperTracker
"""Follows one calibrated hand through frames in order of time."""
AnyTracker = TypeVar("AnyTracker", bound=HandTracker)


class FramePipeline(Generic[AnyTracker]):
    """Detector and tracker of one calibrated hand; call it with each frame in order."""

    def __init__(self, detector: Detector, tracker: AnyTracker, sampling: SamplingSettings) -> None:
        self.detector = detector
        self.tracker = tracker
        self.sampling = sampling

    def __call__(self, given: Seen) -> TrackedFrame:
        """Track one frame. Without a prediction the whole picture is searched."""
        expected = self.tracker.expect(given.timestamp_s)
        region = part = None
        if expected is not None:
            region = self.detector.region_about(expected.pixel, expected.covariance_px2, expected.depth_m)
            if not isinstance(given, Frame):  # a live picture is whole already
                part = part_read(region, expected.back_px, expected.finger_px, self.sampling)
        frame = given.seen(part)
        blobs = self.detector.detect(frame, region)
        if region is not None and self.tracker.would_miss(blobs):
            frame = given.seen(None)
            blobs = self.detector.detect(frame, None)
        if expected is not None:
            blobs = blobs.with_readings(
                surface_samples(frame, expected.back_px, self.sampling),
                finger_samples(frame, expected.finger_px, self.sampling),
            )
        return self.tracker.step(frame.index, frame.timestamp_s, blobs, frame.dropped_before)


NOT_LOOKED_BACK = "not_looked_back"
"""The event of a session that is stored as tracked, though looking back was asked for."""


def notes_in(session: Session) -> list[Event]:
    """Its events, but for what only that tracking of it met."""
    return [event for event in session.events if event.kind != NOT_LOOKED_BACK]


def answers_in(session: Session) -> dict[int, list[SpotAnswer]]:
    """What was said of blue spots, by the row of the picture that took it up."""
    out: dict[int, list[SpotAnswer]] = {}
    for event in session.events:
        if event.kind == SPOT_SAID and len(session):
            row = int(abs(session.timestamp_s - event.time_s).argmin())
            answer = SpotAnswer.of_text(event.text, row)
            if answer is not None:
                out.setdefault(row, []).append(answer)
    return out
