"""From picture to angles: picture -> blobs -> assigned to discs -> state estimate -> angles."""

from __future__ import annotations

from typing import Generic, Protocol, TypeVar

from carpus.core.detection.detector import Detector
from carpus.core.detection.surface_samples import SamplingSettings, finger_samples, part_read, surface_samples
from carpus.core.session.values import Event, Session
from carpus.core.types import SPOT_SAID, Detections, FloatArray, Frame, Region, SpotAnswer, TrackedFrame


class Expected(Protocol):
    """Where to look: pixels (M, 2) with covariance (M, 2, 2), depths (M,); ``back_px`` (C, 2) of the discs that
    span the surface of the back of the hand, ``finger_px`` (F, 2) of those about the fingers."""

    @property
    def pixel(self) -> FloatArray: ...

    @property
    def covariance_px2(self) -> FloatArray: ...

    @property
    def depth_m(self) -> FloatArray: ...

    @property
    def back_px(self) -> FloatArray: ...

    @property
    def finger_px(self) -> FloatArray: ...


class Seen(Protocol):
    """A frame, or one whose pictures are unpacked where they are looked at."""

    @property
    def index(self) -> int: ...

    @property
    def timestamp_s(self) -> float: ...

    @property
    def dropped_before(self) -> int: ...

    def seen(self, part: Region | None) -> Frame:
        """The frame for who looks at a part of its pictures alone, None for all of them."""
        ...


class HandTracker(Protocol):
    """Follows one calibrated hand through frames in order of time."""

    def begin_at_neutral(self, at_s: float | None = None) -> None:
        """Start (again) from the calibrated pose."""
        ...

    def expect(self, timestamp_s: float) -> Expected | None:
        """Where to look at that time; None for the whole picture."""
        ...

    def would_miss(self, blobs: Detections) -> bool:
        """Whether blobs of a narrowed search are too few, so that the rest is worth a look."""
        ...

    def step(
        self,
        index: int,
        timestamp_s: float,
        detections: Detections,
        dropped_before: int = 0,
    ) -> TrackedFrame:
        """The frame's result from its blobs."""
        ...


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
