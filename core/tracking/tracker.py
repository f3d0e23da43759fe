"""The tracker: the only part of the pipeline that remembers.

A frame's blobs are screened by what a person said of them and associated with the discs that were predicted; they
update the state estimate, or the prediction is kept; the track is confirmed, coasted or given up; lost, or where too
little of it was where it should be, the hand is initiated anew. It reads no picture and writes no file.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from carpus.core.calibration.result import Calibration
from carpus.core.camera import Camera
from carpus.core.tracking.frame_result import FrameResults
from carpus.core.tracking.hand_filter import HandFilter, Posterior, Scan, as_ideal
from carpus.core.tracking.hand_geometry import palm_of
from carpus.core.tracking.operator_hints import Hinted, OperatorHints
from carpus.core.tracking.palm_smoother import FilterStep
from carpus.core.tracking.predicted_measurement import PredictedMeasurement
from carpus.core.tracking.readout import Readout
from carpus.core.tracking.settings import TrackerSettings
from carpus.core.tracking.smoother_record import KeptSteps, SmoothedHand, SmootherRecord
from carpus.core.tracking.track_manager import TrackManager, turned_rad
from carpus.core.types import Detections, FloatArray, Moment, SpotAnswer, TrackedFrame, TrackStatus


class Tracker:
    """Tracks one calibrated hand through frames in order of time."""

    def __init__(
        self, calibration: Calibration, camera: Camera, settings: TrackerSettings, *, keep_history: bool = True
    ) -> None:
        self.settings = settings
        self._keep_history = keep_history
        protocol = calibration.clicks.protocol
        self.markers = protocol.markers
        """Names of the discs, in the order of every row."""
        self._filter = HandFilter(calibration, camera, settings)
        self._manager = TrackManager(
            settings.holding, settings.finding.least, settings.lost_after_s, amid_digits=protocol.has_fingers
        )
        self._hints = OperatorHints(self.markers, settings.said)
        model = None if self._filter.fingers is None else self._filter.fingers.model
        self._results = FrameResults(protocol, self._filter.order, model, self._filter.readout, settings)
        palm = palm_of(calibration)
        self.record = SmootherRecord(
            SmoothedHand(
                self._filter.motion,
                self._filter.view,
                model,
                lambda: Readout(palm, settings.readout, camera, settings.marker_radius_m),
                self._results.lost_moment,
            )
        )

    def begin_at_neutral(self, at_s: float | None = None) -> None:
        """Start (again) from the calibrated pose, the hand at rest; at that time, or else with the next frame."""
        self._filter.begin_at_neutral()
        self._manager.begin_at_neutral(at_s)
        self._results.forget_doubt()

    @property
    def is_lost(self) -> bool:
        return self._manager.is_lost

    def hear(self, answer: SpotAnswer) -> None:
        """What a person says of the blue spots of a picture shown a moment ago, from the next frame on. To be called
        between frames, where they are tracked."""
        self._hints.hear(answer)

    def taken_up(self) -> list[SpotAnswer]:
        """The answers that the frames since the last call have taken up, with the spots as they lay there."""
        return self._hints.taken_up()

    def expect(self, timestamp_s: float) -> PredictedMeasurement | None:
        """Where to look at that time; None when the hand is lost."""
        if self.is_lost or self._manager.is_past(timestamp_s):
            return None
        return self._filter.predict(self._manager.since_last_s(timestamp_s))

    def would_miss(self, blobs: Detections) -> bool:
        """Whether blobs of a narrowed search are too few to hold the palm, so that the rest is worth a look."""
        return len(blobs) <= self.settings.holding.least_discs

    def step(self, index: int, timestamp_s: float, detections: Detections, dropped_before: int = 0) -> TrackedFrame:
        """Associate the blobs of one frame and update by them; the frame's result."""
        hinted = self._hints.screened(index, timestamp_s, detections, lambda: self._expected_px(timestamp_s))
        frame = self._tracked(index, timestamp_s, hinted, dropped_before)
        self._hints.hold(frame.marker_measured_px)
        if hinted.detections is not detections:
            frame = replace(frame, detections=detections, no_disc=hinted.no_disc)
        return frame

    def _tracked(self, index: int, timestamp_s: float, hinted: Hinted, dropped_before: int) -> TrackedFrame:
        """The frame's result of the blobs that may be discs."""
        ideal = as_ideal(hinted.detections, self._filter.view.camera)
        is_linked = self._manager.next_frame(timestamp_s)
        if self._manager.is_past(timestamp_s):
            self._lose(timestamp_s)
        if self.is_lost:
            is_linked = False
            self._initiate(ideal, timestamp_s)
        if self.is_lost:
            return self._lost(index, timestamp_s, hinted.detections, dropped_before)

        predicted, scan, said = self._predicted_as_hinted(hinted, ideal, timestamp_s)
        posterior = self._filter.update(predicted, scan)
        is_linked = is_linked and not said
        reacquired = self._reacquired(posterior, scan)
        if reacquired is not None:
            # A vague prediction has nothing against the place found: the smoother may go on through it.
            is_linked = is_linked and self._manager.is_vague(posterior.turn_sd_rad)
            posterior = reacquired
        elif self._manager.is_ambiguous(posterior.seen, posterior.turn_sd_rad):
            posterior = self._filter.update(predicted, scan.without_blobs())

        status = self._status_after(posterior, scan)
        if status is TrackStatus.LOST:
            return self._lost(index, timestamp_s, hinted.detections, dropped_before)
        steps = self._filter.accept(posterior, scan, is_seen=status is TrackStatus.TRACKED, linked=is_linked)
        if self._keep_history:
            self.record.append(*steps)
        joints = self._filter.joints(posterior)
        return self._results.told(index, status, posterior, scan, joints, hinted.detections, dropped_before)

    def _initiate(self, ideal: Detections, timestamp_s: float) -> None:
        """Begin a track where the blobs show a palm, wherever it was."""
        found = self._filter.find(ideal, self._manager.anyhow())
        if found is not None and self._manager.initiates(found, timestamp_s):
            self._filter.begin(self._filter.estimate_at(found))

    def _predicted_as_hinted(
        self, hinted: Hinted, ideal: Detections, timestamp_s: float
    ) -> tuple[PredictedMeasurement, Scan, bool]:
        """The prediction, what the frame brings, and whether a disc of the palm begins anew where a person has just
        said that it is."""
        named, dt_s = hinted.named, self._manager.since_last_s(timestamp_s)
        if named is not None:
            self._filter.look_anew(named)
        predicted = self._filter.predict(dt_s)
        scan = self._filter.scan(predicted, ideal, timestamp_s, dt_s)
        if named is None:
            return predicted, scan, False
        self._hints.take_up(named)
        self._results.forget_doubt()
        placed = self._filter.place_disc(named, predicted, scan)
        return (predicted, scan, False) if placed is None else (placed, scan, True)

    def _reacquired(self, posterior: Posterior, scan: Scan) -> Posterior | None:
        """The update from a place found without prediction, where too little of the palm is where it was predicted or
        the prediction was vague; None where that explains the frame no better."""
        manager, turn_sd_rad, seen = self._manager, posterior.turn_sd_rad, posterior.seen
        if not manager.looks_anew(seen, int(np.count_nonzero(posterior.unassigned)), turn_sd_rad):
            return None
        is_vague, rotation = manager.is_vague(turn_sd_rad), posterior.predicted.nominal.rotation_w2_w0
        ideal = scan.ideal if is_vague else scan.ideal.only(~posterior.is_finger)
        found = self._filter.find(ideal, manager.facing(rotation, scan.timestamp_s))
        if found is None or not (is_vague or found.count > seen):
            return None
        holding = self.settings.holding
        if found.count <= self.settings.finding.least and self._filter.is_against(found, posterior):
            return None
        is_expected = turned_rad(rotation, found.rotation_w2_w0) < holding.turn_slack_rad
        if is_vague and not (is_expected or manager.is_borne_out(found, scan.timestamp_s)):
            return None
        there = self._filter.update(self._filter.predicted_at(found, posterior.predicted), scan)
        is_agreed = (
            turn_sd_rad < holding.too_vague_rad
            and np.array_equal(there.palm.assigned, posterior.palm.assigned)
            and self._filter.fits(posterior)
        )
        if is_agreed or there.seen < max(holding.least_discs + 1, seen):
            return None
        manager.take_for(found)
        return there

    def _status_after(self, posterior: Posterior, scan: Scan) -> TrackStatus:
        """What becomes of the track."""
        if self._manager.is_refuted(posterior.seen, scan.timestamp_s):
            return TrackStatus.LOST
        self._filter.learn(posterior, scan.dt_s)
        fits = self._filter.fits(posterior)
        return self._manager.status_after(scan.timestamp_s, posterior.seen, fits=fits)

    def _lose(self, timestamp_s: float) -> None:
        self._filter.lose()
        self._manager.lose(timestamp_s)

    def _lost(self, index: int, timestamp_s: float, detections: Detections, dropped_before: int) -> TrackedFrame:
        self._lose(timestamp_s)
        if self._keep_history:
            self.record.append(FilterStep(timestamp_s, None, self._filter.motion.at_rest, False), None)
        return self._results.lost(index, timestamp_s, detections, dropped_before)

    def _expected_px(self, timestamp_s: float) -> FloatArray:
        """Where the markers should be in the picture (M, 2), NaN while the hand is lost."""
        expected = self.expect(timestamp_s)
        if expected is None:
            return np.full((len(self.markers), 2), np.nan)
        return self._filter.view.camera.distort(expected.pixel)

    def smoothed(self) -> list[Moment]:
        """Every frame so far in the light of all the others; needs the history kept."""
        return self.record.smoothed()

    def hand_over(self) -> KeptSteps:
        """Give up what :meth:`smoothed` needs of the frames so far, for another tracker of the same hand."""
        history = self.record.history
        return self.record.hand_over(self._filter.finger_start(history[-1].timestamp_s) if history else None)
